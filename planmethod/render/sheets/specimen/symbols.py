"""Specimen of the scheme symbols (условные обозначения кинематических схем)."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import radians
from typing import NamedTuple

from msgspec import Struct

from planmethod.note.wording import Language, MessageTable
from planmethod.render import symbols
from planmethod.render.frame import Furniture, sheet_frame
from planmethod.render.ink.drawing import Bounds, Drawing, Item, Pen, Stroke
from planmethod.render.ink.pens import ARROW, pens_in_use
from planmethod.render.ink.typeset import line_step, typeset
from planmethod.render.labels import Label
from planmethod.render.layout.block import Column, heading, paragraph
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.supports import BlockOutline, welded
from planmethod.render.symbols import (
    SIZES,
    bearing,
    before_links,
    guide_plates,
    link,
    revolute,
)
from planmethod.render.symbols.elements import (
    bell_profile,
    cam,
    carrier_profile,
    mesh_front,
    rack_front,
    rest_on_cam,
    ring_profile,
    roller,
    wheel_front,
    wheel_profile,
)
from planmethod.render.symbols.marks import axis_line
from planmethod.render.symbols.springs import damper, spring, torsion_spring

NUMBER, NAME, CLAUSE = 2.5, 3.5, 2.5
"""Heights of the letters of a cell, mm."""

EDGE = 3.0
"""White between the lines of a cell and its contents, mm."""


class Clause(NamedTuple):
    """Clause of a GOST; only numbers that were seen in it are given (пункт стандарта).

    ``paragraph`` is a, b, c for the first ones.
    """

    number: str
    item: str = ""
    paragraph: str = ""

    def describe(self, texts: MessageTable) -> str:
        """Return the standard and its clause in a language."""
        if not self.item:
            return texts.standard.format(number=self.number)
        item = self.item
        if self.paragraph:
            item += f", {texts.clause_letters['abc'.index(self.paragraph)]}"
        return texts.clause.format(number=self.number, item=item)


class SymbolCell(Struct, frozen=True):
    """One symbol with its letters (клетка).

    Attributes
    ----------
    name : str
        Key of its name in ``cells`` of a language's ``specimens``.
    clause : Clause or None
        The clause of the standard that it illustrates; None for practice of the course.
    items : tuple of Item
        The symbol in its own coordinates, mm, as drawn on a scheme.
    labels : tuple of Label
        Its letters, placed around it.
    size : str
        Size in its name, mm.
    """

    name: str
    clause: Clause | None
    items: tuple[Item, ...]
    labels: tuple[Label, ...] = ()
    size: str = ""


def letter(text: str, at: complex, prefer: complex = 1 + 1j, *, gap: float = 3.0) -> Label:
    """Return the letter of a point or the number of a link, 3.5 mm."""
    return Label(typeset(text, NAME), at, prefer=prefer, gap=gap)


def scheme(*parts: list[Item]) -> tuple[Item, ...]:
    """Return parts in order; hatching gives way to links."""
    return tuple(before_links([item for part in parts for item in part]))


def drawn_cell(cell: SymbolCell, number: int, box: Bounds, texts: MessageTable) -> list[Item]:
    """Return a cell in its box: number, picture in the middle, name and clause below it."""
    left, low, right, high = box
    middle, inner = (left + right) / 2, right - left - 2 * EDGE
    # Base lines are those of the grid, regardless of descenders.
    base = low + EDGE + 0.3 * CLAUSE
    name = texts["cells"][cell.name].format(size=cell.size)
    clause = texts.course if cell.clause is None else cell.clause.describe(texts)
    items = list(typeset(clause, CLAUSE).at(complex(middle, base), anchor="centre"))
    base += CLAUSE + 2.5
    for line in reversed(paragraph(name, NAME, inner).inscriptions):
        items += line.at(complex(middle, base), anchor="centre")
        base += line_step(NAME)
    picture = lettered(cell.items, cell.labels)
    room = (base - line_step(NAME) + NAME + EDGE, high - EDGE)
    corner = complex(middle - picture.width / 2, (sum(room) + picture.height) / 2)
    items += picture.place(corner)
    mark = typeset(str(number), NUMBER)
    return items + mark.at(complex(left + 1.5, high - 1.5 - NUMBER))


def drawn_grid(
    cells: Sequence[SymbolCell],
    corner: complex,
    texts: MessageTable,
    *,
    columns: int,
    width: float,
    height: float,
) -> list[Item]:
    """Return cells in rows from an upper left corner, with the lines between them, mm."""
    items: list[Item] = []
    sides: dict[tuple[complex, complex], None] = {}
    for k, cell in enumerate(cells):
        row, column = divmod(k, columns)
        left, high = corner.real + column * width, corner.imag - row * height
        box = (left, high - height, left + width, high)
        items += drawn_cell(cell, k + 1, box, texts)
        sides |= dict.fromkeys(_sides(box))
    return [*(Stroke(side, Pen.THIN, tag="grid") for side in sides), *items]


def _sides(box: Bounds) -> Iterable[tuple[complex, complex]]:
    x0, y0, x1, y1 = (round(value, 6) for value in box)
    yield complex(x0, y0), complex(x1, y0)
    yield complex(x0, y1), complex(x1, y1)
    yield complex(x0, y0), complex(x0, y1)
    yield complex(x1, y0), complex(x1, y1)


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


PAPER = "A2"
CELLS_PER_ROW, WIDTH, HEIGHT = 8, 70.0, 73.0
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

    s, head = SIZES, round(pens_in_use().head(Pen.RESULTANT), 1)
    sizes = {
        "joint": join_sizes(s.joint),
        "support": join_sizes(s.support_height),
        "base": join_sizes(s.base),
        "hatch": join_sizes(s.hatch_step),
        "slider": join_sizes(s.slider_length, s.slider_width),
        "corner": join_sizes(s.corner),
        "arrow": join_sizes(head, round(head * ARROW.width, 1)),
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
    return [
        *_joints(), *_links(), *_springs(), *_sliders(), *_mobile(), *_drivers(), *wheel_cells(),
    ]  # fmt: skip


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
            symbols.revolute_on(0j, -along),
        ),
        (
            letter("N", 0j, 1j, gap=2.0),
            letter("3", -14 * along, 1j, gap=1.5),
            letter("4", polar(-75, 11), 1, gap=1.5),
        ),
    )


def _springs() -> Iterator[SymbolCell]:
    """Yield a spring, a damper and a torsion spring."""
    ends = (-20 + 0j, 20 + 0j)
    joints = [item for end in ends for item in symbols.revolute(end)]
    letters = (letter("B", ends[0], -1j), letter("D", ends[1], -1j))
    yield SymbolCell("spring", None, scheme(spring(*ends), joints), letters)
    yield SymbolCell("damper", None, scheme(damper(*ends), joints), letters)
    a, b = polar(180, 20), polar(40, 26)
    links = symbols.link(a, 0j, b)
    spiral = torsion_spring(0j, a, b)
    joint = [item for at in (a, 0j, b) for item in symbols.revolute(at)]
    yield SymbolCell("torsion_spring", None, scheme(links, spiral, joint), (letter("B", 0j, -1j),))


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
            symbols.link(33 + 5j, 0j, tag="link 4"),
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
