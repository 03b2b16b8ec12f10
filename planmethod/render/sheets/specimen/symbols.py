"""Specimen of the scheme symbols (условные обозначения кинематических схем), format A2."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping
from math import radians

from planmethod.note.wording import Language
from planmethod.render import symbols
from planmethod.render.frame.frame import sheet_frame
from planmethod.render.frame.furniture import Furniture
from planmethod.render.ink.drawing import Bounds, Drawing, Item, Stroke
from planmethod.render.ink.style import ARROW
from planmethod.render.layout.block import Column, heading, paragraph
from planmethod.render.pictures.welds import BlockOutline, welded
from planmethod.render.sheets.specimen.cells import Clause, SymbolCell, drawn_grid, letter, scheme
from planmethod.render.sheets.specimen.wheels import GEARS, wheel_cells
from planmethod.render.symbols import SIZES
from planmethod.render.symbols.axes import axis_line

PAPER = "A2"
CELLS_PER_ROW, WIDTH, HEIGHT = 7, 79.0, 73.0
"""Cells in a row, and their size, mm."""


def symbols_sheet(fields: Mapping[str, str], language: Language) -> Drawing:
    """Draw every symbol at working size with its name (лист условных обозначений)."""
    said = language.specimens
    texts = {"title": said.symbols, "material": GEARS.describe(said), "scale": "1:1", **fields}
    items, inner, *_ = sheet_frame(PAPER, texts, Furniture(graph_26=False, lang=language.lang))
    sheet = Drawing(594.0, 420.0, texts["title"], items)
    middle = (inner[0] + inner[2]) / 2
    head = heading(said.symbols, 7.0)
    sheet.extend(head.place(complex(middle - head.width / 2, inner[3] - 6.0)))
    corner = complex(middle - CELLS_PER_ROW * WIDTH / 2, inner[3] - 19.0)
    cells = symbol_cells()
    sheet.extend(drawn_grid(cells, corner, said, columns=CELLS_PER_ROW, width=WIDTH, height=HEIGHT))
    sheet.extend(_sizes(corner, inner, language))
    return sheet


def _sizes(corner: complex, inner: Bounds, language: Language) -> list[Item]:
    """Return the sizes of the symbols, in the space that the grid leaves above the title block."""
    left = corner.real + 4 * WIDTH + 8.0
    high = corner.imag - 4 * HEIGHT - 7.0

    def join_sizes(*values: float) -> str:
        return "×".join(language.notation.number(f"{value:g}") for value in values)

    s = SIZES
    sizes = {
        "joint": join_sizes(s.joint),
        "support": join_sizes(s.support_height),
        "base": join_sizes(s.base),
        "hatch": join_sizes(s.hatch_step),
        "slider": join_sizes(s.slider_length, s.slider_width),
        "corner": join_sizes(s.corner),
        "arrow": join_sizes(ARROW.length, ARROW.width),
        "teeth": join_sizes(s.teeth),
        "mesh": join_sizes(s.mesh),
    }
    lines = [line.format(**sizes) for line in language.specimens["sizes"]]
    room = Column(
        [
            heading(language.specimens.sizes_title, 5.0),
            paragraph("\n".join(lines), 3.5, inner[2] - 8.0 - left),
        ],
        gap=3.5,
    )
    return room.place(complex(left, high))


def symbol_cells() -> list[SymbolCell]:
    """Return every symbol with its name and clause."""
    return [*_joints(), *_links(), *_sliders(), *_mobile(), *_drivers(), *wheel_cells()]


def polar(degrees: float, length: float = 1.0) -> complex:
    """Return a vector, mm."""
    return cmath.rect(length, radians(degrees))


def _joints() -> Iterator[SymbolCell]:
    """Yield links, the frame and the revolute pairs."""
    a, b = -16 - 5j, 16 + 5j
    yield SymbolCell(
        "link",
        Clause("2.770", "1"),
        scheme(symbols.link(a, b), symbols.revolute(a), symbols.revolute(b)),
        (letter("A", a, 1j), letter("B", b, 1j), letter("2", 0j, 1j, gap=1.5)),
    )
    yield SymbolCell("frame", Clause("2.770", "2"), scheme(symbols.ground_line(-18, 18)))
    tip = polar(55, 24)
    yield SymbolCell(
        "support",
        None,
        scheme(symbols.link(0j, tip, tag="link 1"), symbols.fixed_pivot(0j)),
        (letter("O", 0j, -1), letter("1", tip / 2, -1 + 1j, gap=1.5)),
    )
    yield SymbolCell(
        "support_turned",
        None,
        scheme(
            symbols.link(0j, polar(-60, 24), tag="link 1"), symbols.fixed_pivot(0j, direction=1j)
        ),
        (letter("O", 0j, -1), letter("1", polar(-60, 12), 1 + 1j, gap=1.5)),
    )
    pair = (0j, 8 + 0j)
    yield SymbolCell(
        "supports",
        None,
        scheme(
            symbols.link(pair[0], polar(125, 22), tag="link 1"),
            symbols.link(pair[1], 8 + polar(50, 24), tag="link 3"),
            symbols.fixed_pivots(pair),
        ),
        (letter("A", pair[0], -1), letter("D", pair[1], 1)),
    )
    yield SymbolCell(
        "revolute",
        Clause("2.770", "6", "a"),
        scheme(symbols.link(polar(215, 24), 0j, polar(-25, 22)), symbols.revolute(0j)),
        (
            letter("B", 0j, 1j),
            letter("1", polar(215, 12), -1 + 1j, gap=1.5),
            letter("2", polar(-25, 12), 1 + 1j, gap=1.5),
        ),
    )
    arms = (polar(205, 22), polar(-20, 22), polar(80, 18))
    yield SymbolCell(
        "double",
        Clause("2.770", "6", "b"),
        scheme(*(symbols.link(0j, arm) for arm in arms), symbols.revolute(0j, count=2)),
        (
            letter("C", 0j, -1j, gap=4.2),
            letter("2", arms[0] / 2, -1 + 1j, gap=1.5),
            letter("3", arms[1] / 2, 1 + 1j, gap=1.5),
            letter("4", arms[2] / 2, 1, gap=1.5),
        ),
    )
    along = polar(10)
    yield SymbolCell(
        "on_link",
        None,
        scheme(
            symbols.link(-24 * along, 24 * along),
            symbols.link(0j, polar(-75, 20)),
            symbols.revolute_on(0j, along),
        ),
        (
            letter("N", 0j, 1j, gap=2.0),
            letter("3", -14 * along, 1j, gap=1.5),
            letter("4", polar(-75, 11), 1, gap=1.5),
        ),
    )


def _links() -> Iterator[SymbolCell]:
    """Yield rigid joints and links with three pairs."""
    a, b = polar(180, 20), polar(40, 26)
    yield SymbolCell(
        "rigid",
        Clause("2.770", "5", "a"),
        scheme(
            symbols.link(a, 0j, b),
            symbols.rigid_corner(0j, a, b),
            symbols.revolute(a),
            symbols.revolute(b),
        ),
        (letter("A", a, 1j), letter("B", b, 1)),
    )
    corners = (-17 + 0j, 17 + 0j, -3 + 26j)
    letters = (
        letter("A", corners[0], -1j),
        letter("B", corners[1], -1j),
        letter("C", corners[2], 1j),
    )
    joints = [item for corner in corners for item in symbols.revolute(corner)]
    yield SymbolCell(
        "ternary_corners",
        None,
        scheme(symbols.rigid_polygon(*corners, marked=True), joints),
        letters,
    )
    yield SymbolCell(
        "ternary_hatched",
        None,
        scheme(symbols.rigid_polygon(*corners, hatched=True), joints),
        letters,
    )


def _sliders() -> Iterator[SymbolCell]:
    """Yield sliding pairs."""
    rod = polar(32, 30)
    axis = axis_line(-29, -SIZES.slider_length / 2), axis_line(SIZES.slider_length / 2, 29)
    yield SymbolCell(
        "slider",
        Clause("2.770", "6", "c"),
        scheme(
            *axis,
            symbols.guide_line(0j, before=13, after=13),
            symbols.slider(0j),
            symbols.link(rod, 0j, tag="link 4"),
            symbols.revolute(0j),
        ),
        (letter("E", 0j, 1j, gap=5), letter("4", rod * 0.7, 1j, gap=1.5)),
    )
    yield SymbolCell(
        "slider_between",
        Clause("2.770", "6", "c"),
        scheme(
            *axis,
            symbols.guide_plates(0j, length=24),
            symbols.slider(0j),
            symbols.link(40 + 6j, 0j, tag="link 4"),
            symbols.revolute(0j),
        ),
        (letter("E", -5 + 0j, 1j, gap=7),),
    )
    # An arm to a hinge and a rod, both in one piece with the slider, and a centre of mass.
    pin, tag = 9j, "link 5"
    block = BlockOutline(0j, 1 + 0j, SIZES.slider_length, SIZES.slider_width)
    rods = [Stroke((0j, end), tag=tag) for end in (pin, 29 + 0j)]
    bars, welds = welded(rods, tag, block, 1.0)
    yield SymbolCell(
        "slider_offset",
        None,
        scheme(
            axis[0],
            symbols.guide_line(0j, before=13, after=8),
            symbols.link(pin + polar(20, 28), pin, tag="link 4"),
            symbols.slider(0j),
            bars,
            welds,
            symbols.revolute(pin),
            symbols.mass_centre(18 + 0j),
        ),
        (
            letter("E", pin, 1j),
            letter("5", -5 + 4j, 1j, gap=1.5),
            letter("S_{5}", 18 + 0j, -1j, gap=2.4),
        ),
    )
    turn = 35.0
    bar = (polar(turn, -16), polar(turn, 30))
    yield SymbolCell(
        "stone",
        None,
        scheme(
            symbols.fixed_pivot(bar[0]),
            symbols.sliding_block(8 * polar(turn), angle=turn, pin=False),
            symbols.link(*bar, tag="link 3"),
            symbols.link(8 * polar(turn) + polar(-55, 20), 8 * polar(turn), tag="link 1"),
            symbols.revolute(8 * polar(turn)),
            symbols.revolute(bar[0]),
        ),
        (
            letter("C", bar[0], -1),
            letter("B", 8 * polar(turn), 1j, gap=5.5),
            letter("3", polar(turn, 24), 1j, gap=1.5),
            letter("1", 8 * polar(turn) + polar(-55, 12), 1, gap=1.5),
        ),
    )
    yield SymbolCell(
        "stone_swinging",
        None,
        scheme(
            symbols.fixed_pivot(0j),
            symbols.slider(0j, angle=20, factor=0.85),
            symbols.link(polar(200, 22), polar(20, 30), tag="link 2"),
            symbols.revolute(0j),
        ),
        (letter("C", -2j, -1, gap=5), letter("2", polar(20, 22), 1j, gap=1.5)),
    )


def _mobile() -> Iterator[SymbolCell]:
    """Yield the pairs of schemes without redundant constraints."""
    arms = (polar(215, 24), polar(-25, 22))
    for key, name in (("cylinder", "2c"), ("sphere", "3s")):
        joint = symbols.mobile_revolute(0j, name, opening=arms[1])
        yield SymbolCell(
            key, None, scheme(symbols.link(arms[0], 0j, arms[1]), joint),
            (letter("B", 0j, 1j, gap=3.5),),
        )  # fmt: skip
    for key, name in (("sleeve", "2c"), ("plate", "3pl")):
        yield SymbolCell(
            key,
            None,
            scheme(
                symbols.mobile_slider(0j, name),
                symbols.link(-24 + 0j, 24 + 0j, tag="link 3"),
                symbols.revolute(0j),
            ),
            (letter("E", 0j, 1j, gap=7), letter("3", 18 + 0j, 1j, gap=1.5)),
        )


def _drivers() -> Iterator[SymbolCell]:
    """Yield cranks, rockers and the arrows of the driver."""
    pin = polar(50, 15)
    yield SymbolCell(
        "crank",
        None,
        scheme(symbols.crank(0j, pin, path=True, tag="link 1")),
        (letter("O", 0j, 1 - 0.6j), letter("A", pin, symbols.unit(pin))),
    )
    yield SymbolCell(
        "driver_turning",
        None,
        scheme(
            symbols.crank(0j, pin * 1.4, tag="link 1"),
            symbols.turn_arrow(0j, 12, 1, middle=104, sweep=80),
        ),
        (letter("ω_{1}", polar(140, 12), -1, gap=1.5), letter("1", pin * 0.8, 1 - 1j, gap=1.5)),
    )
    yield SymbolCell(
        "driver_sliding",
        None,
        scheme(
            symbols.guide_line(0j, before=13, after=13),
            symbols.slider(0j),
            symbols.link(0j, polar(25, 28), tag="link 2"),
            symbols.revolute(0j),
            symbols.drive_arrow(-9 + 8j, 5 + 8j),
        ),
        (letter("v_{1}", -9 + 8j, -1, gap=1.0),),
    )
    yield SymbolCell(
        "rocker",
        None,
        scheme(symbols.rocker(0j, polar(85, 28), swing=(35.0, 28.0), tag="link 3")),
        (letter("D", 0j, 1), letter("C", polar(85, 28), 1j)),
    )
    shaft = (-20 + 0j, 20 + 0j)
    yield SymbolCell(
        "shaft",
        Clause("2.770", "7", "a"),
        scheme(symbols.link(*shaft, tag="link 1"), symbols.bearing(-12), symbols.bearing(12)),
    )
