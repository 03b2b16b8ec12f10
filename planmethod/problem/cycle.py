"""The cycle that is looked at (цикл движения): ``[cycle]``."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from planmethod.languages import say
from planmethod.mechanism.model import FRAME
from planmethod.problem import fields
from planmethod.problem.cycle_records import CycleTask, PoleDistances, Zero
from planmethod.problem.fields import Faults
from planmethod.problem.flat import OwnReader, read_flat
from planmethod.problem.model import Body, Drive, Slide

_EXAMPLE = '[cycle] output = "B", zero = "extreme", count = 12'
_NAMED = {zero.value: zero for zero in Zero}


def read_cycle(
    faults: Faults,
    table: object,
    bodies: Mapping[str, Body],
    slides: Mapping[str, Slide],
    drive: Drive | None,
) -> CycleTask | None:
    """Read ``[cycle]``; None after a fault.

    Parameters
    ----------
    bodies, slides : mapping
        As far as the file has them.
    drive : Drive or None
        None where it has a fault of its own.
    """
    before = len(faults)
    entries = fields.read_table(faults, "cycle", table, _EXAMPLE)
    if entries is None:
        return None
    if drive is not None and not drive.is_crank:
        faults.add(
            "cycle",
            say("the driver, link {}, slides: it has no turn", drive.link),
            "A cycle is a turn of a crank. Delete [cycle], or let a crank drive.",
        )
    output = partial(_read_output, bodies=bodies, slides=slides, drive=drive)
    own: dict[str, OwnReader] = {"output": output, "zero": _read_zero, "pole": _read_pole}
    found = read_flat(faults, "cycle", entries, CycleTask, own)
    return None if len(faults) > before else CycleTask(**found)


def _read_zero(faults: Faults, path: str, value: object) -> Zero | float | None:
    if fields.is_number(value):
        return fields.read_angle(faults, path, value)
    if isinstance(value, str):
        word = fields.read_word(faults, path, value, _NAMED)
        return None if word is None else _NAMED[word]
    wanted = say(" or ").join(f'"{word}"' for word in _NAMED)
    faults.expected(path, say("{} or an angle in degrees", wanted), value)
    return None


def _read_pole(faults: Faults, path: str, value: object) -> PoleDistances:
    table = fields.read_table(faults, path, value, "pole = { v = 36, a = 36 }")
    return PoleDistances(**read_flat(faults, path, table or {}, PoleDistances))


def _read_output(
    faults: Faults,
    path: str,
    value: object,
    bodies: Mapping[str, Body],
    slides: Mapping[str, Slide],
    drive: Drive | None,
) -> str | None:
    """Read the output: a link, or a point of a link that moves along a guide of the frame."""
    if not isinstance(value, str):
        hint = say('Write output = "{}".', value) if isinstance(value, int) else ""
        faults.expected(path, "a point or a link", value, hint)
        return None
    moving = [link for link in bodies if link != FRAME]
    name = value if value in moving else fields.unmask(faults, path, value)
    if name in moving:
        if drive is not None and name == drive.link:
            faults.add(path, say("link {} drives", name), "The output is a link that is driven.")
            return None
        return name
    points = [point for link in moving for point in bodies[link].points]
    if name not in points:
        fields.report_unknown(
            faults, path, name, [*points, *moving], said="unknown point or link '{}'"
        )
        return None
    if guiding(name, bodies, slides) is None:
        links = [link for link in moving if name in bodies[link].points]
        faults.add(
            path,
            say("point {} moves along no guide of the frame", name),
            say("Name a point of a slider, or a link whose angle is meant: {}.", ", ".join(links)),
        )
        return None
    return name


def guiding(point: str, bodies: Mapping[str, Body], slides: Mapping[str, Slide]) -> Slide | None:
    """Return the slide on the frame of the link that a point belongs to; None without one."""
    for slide in slides.values():
        body = bodies.get(slide.slider)
        if slide.host == FRAME and body is not None and point in body.points:
            return slide
    return None
