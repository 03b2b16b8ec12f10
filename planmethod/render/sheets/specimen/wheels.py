"""Cells of the specimen of symbols that show wheels and cams."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.render.sheets.specimen.cells import Clause, SymbolCell, letter, scheme
from planmethod.render.symbols import (
    bearing,
    guide_plates,
    link,
    revolute,
)
from planmethod.render.symbols.axes import axis_line
from planmethod.render.symbols.cams import cam, rest_on_cam, roller
from planmethod.render.symbols.gears import (
    bell_profile,
    carrier_profile,
    mesh_front,
    rack_front,
    ring_profile,
    wheel_front,
    wheel_profile,
)

GEARS = Clause("2.770")


def wheel_cells() -> Iterator[SymbolCell]:
    """Yield wheels from the front and from the side, racks and cams."""
    yield from _front()
    yield from _side()
    yield _cam()


def _front() -> Iterator[SymbolCell]:
    second = 22.5 + 0j
    yield SymbolCell(
        "mesh_front",
        GEARS,
        scheme(mesh_front(0j, 9.0, second), revolute(0j), revolute(second)),
        (
            letter("P", 9 + 0j, -1 + 1j, gap=1.2),
            letter("1", -6 + 6j, -1 + 1j),
            letter("2", 33 + 9j),
        ),
    )
    planet = 9j
    yield SymbolCell(
        "ring_front",
        GEARS,
        scheme(mesh_front(planet, 9.5, 0j, internal=True), revolute(planet), revolute(0j)),
        (letter("P", 18.5j, 1 - 2j, gap=2.4),),
    )
    yield SymbolCell(
        "rack",
        Clause("2.770", "38"),
        scheme(
            rack_front(-24 + 0j, 24 + 0j),
            wheel_front(13j, 13.0, touch=0j),
            revolute(13j),
        ),
        (letter("P", 0j, 1 + 1j, gap=1.4),),
    )


def _side() -> Iterator[SymbolCell]:
    yield SymbolCell(
        "mesh_side",
        GEARS,
        scheme(
            link(-16 + 0j, 10 + 0j, tag="link 1"),
            link(-10 + 20j, 16 + 20j, tag="link 2"),
            wheel_profile(0j, 8.0, tag="link 1"),
            wheel_profile(20j, 12.0, tag="link 2"),
            bearing(-10 + 0j),
            bearing(10 + 20j),
        ),
        (letter("1", -6j, 1), letter("2", 27j, 1)),
    )
    yield SymbolCell(
        "ring_side",
        GEARS,
        scheme(
            link(-28 + 0j, -8 + 0j, tag="link 2"),
            link(-5 + 12j, 20 + 12j, tag="link 1"),
            wheel_profile(12j, 8.0, tag="link 1"),
            bell_profile(0j, 20.0, web=-8.0, tag="link 2"),
            bearing(-18 + 0j),
            bearing(12 + 12j),
        ),
        (letter("1", 7j, 1, gap=1.4), letter("2", -8 + 12j, -1, gap=1.4)),
    )
    sun, planet, ring = 8.0, 6.0, 20.0
    pin = 1j * (sun + planet)
    yield SymbolCell(
        "planetary",
        GEARS,
        scheme(
            axis_line(0j, 12 + 0j),
            link(-22 + 0j, 0j, tag="link 1"),
            wheel_profile(0j, sun, tag="link 1"),
            wheel_profile(pin, planet, loose=True, tag="link 2"),
            ring_profile(0j, ring, support=4.0),
            carrier_profile(pin, 0j, reach=12.0, tag="link H"),
            link(12 + 0j, 30 + 0j, tag="link H"),
            bearing(-14 + 0j),
            bearing(22 + 0j),
        ),
        (
            letter("1", 5j, -1, gap=1.4),
            letter("2", pin + 4j, -1, gap=1.4),
            letter("3", 22j, -1, gap=1.4),
            letter("H", 12 + 8j, 1, gap=1.4),
        ),
    )


def _cam() -> SymbolCell:
    nose, base, lift = 0.95, 8.0, 6.0
    at = rest_on_cam(0j, 1j, base=base, lift=lift, nose=nose)
    return SymbolCell(
        "cam",
        GEARS,
        scheme(
            link(at, at + 20j, tag="link 2"),
            guide_plates(at + 12j, angle=90, length=8.0, width=3.2),
            cam(0j, base=base, lift=lift, nose=nose, tag="link 1"),
            revolute(0j),
            roller(at),
        ),
        (letter("1", 8 - 2j, 1, gap=1.4), letter("2", at + 19j, 1, gap=1.4)),
    )
