"""Specimen of the lines (линии чертежа, GOST 2.303), format A3.

Every line is drawn with its own pen; what is written of its strokes is measured on what the pen
leaves on the paper.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate
from math import radians
from types import MappingProxyType

from planmethod.render.frame.frame import sheet_frame
from planmethod.render.frame.furniture import Furniture
from planmethod.render.ink.drawing import Arc, Drawing, Item, Pen, Stroke
from planmethod.render.ink.style import ARROW, PENS, S, stroke_lines
from planmethod.render.layout.block import Align, fit, heading
from planmethod.render.sheets.specimen.cells import Cell, drawn_grid
from planmethod.render.symbols import (
    SIZES,
    fixed_pivot,
    guide_plates,
    link,
    revolute,
    slider,
    vector_arrow,
)
from planmethod.render.symbols.axes import (
    SMALL_CIRCLE,
    axis_line,
    centre_lines,
    kinked_line,
    pitch_circle,
    wavy_line,
)

PAPER = "A3"
TITLE = "Типы линий"
SAMPLE = 74.0
"""Length of a sample, mm."""

COLUMNS = (62.0, 84.0, 31.0, 38.0, 170.0)
HEADS = ("Линия", "Начертание", "Толщина,\nмм", "Штрих;\nпросвет, мм", "Что ею чертят")
ROW, HEAD = 12.5, 13.0
"""Widths of the columns, what stands over them, heights of the rows, mm."""

TEXT = 3.5
RULE = "ГОСТ 2.303"
ACROSS = 6
"""Pictures of rules in a row."""


@dataclass(frozen=True, slots=True)
class LineType:
    """One type of line (тип линии)."""

    name: str
    pen: Pen
    use: str


TYPES: tuple[LineType, ...] = (
    LineType("сплошная основная", Pen.MAIN, "звенья, векторы планов, рамка, основная надпись"),
    LineType(
        "сплошная тонкая",
        Pen.THIN,
        "построения, составляющие векторов,\nвыноски, строки таблиц, траектории",
    ),
    LineType("сплошная тонкая", Pen.HATCH, "штриховка стойки и трёхпарных звеньев"),
    LineType("сплошная волнистая", Pen.BREAK, "обрыв звена"),
    LineType("сплошная тонкая\nс изломами", Pen.BREAK, "длинная линия обрыва"),
    LineType("штриховая", Pen.HIDDEN, "невидимые линии, звенья за пределами группы"),
    LineType("штрихпунктирная\nтонкая", Pen.AXIS, "осевые и центровые линии, оси направляющих"),
    LineType("штрихпунктирная\nутолщённая", Pen.THICK_AXIS, "обрабатываемые поверхности"),
    LineType(
        "штрихпунктирная\nс двумя точками",
        Pen.PHANTOM,
        "звенья в крайних и промежуточных положениях",
    ),
)
"""The lines of the sheets, in the order of GOST 2.303."""


def said(value: float) -> str:
    """Return a length as it is written on the sheet: one place, a comma."""
    return f"{round(value, 1):g}".replace(".", ",")


def sample(kind: LineType, start: complex) -> list[Item]:
    """Return a line of the type, 74 mm from ``start`` to the right."""
    end = start + SAMPLE
    if kind.pen is Pen.BREAK:
        drawn = kinked_line if "излом" in kind.name else wavy_line
        return drawn(start, end, tag="sample")
    return [Stroke((start, end), kind.pen, tag="sample")]


def measured(items: Sequence[Item]) -> str:
    """Return stroke and gap of a dashed sample, read from what its pen leaves; a dash if none."""
    (line,) = (item for item in items if isinstance(item, Stroke))
    pieces = stroke_lines(line)
    if len(pieces) < 2:
        return "–"
    longest = max(abs(piece[-1] - piece[0]) for piece in pieces)
    long = [piece for piece in pieces if abs(piece[-1] - piece[0]) > longest / 2]
    gap = long[1][0] - long[0][-1]
    return f"{said(longest)}; {said(abs(gap))}"


def lines_sheet(fields: Mapping[str, str] = MappingProxyType({})) -> Drawing:
    """Draw every line type with its width, dashes and use (лист типов линий)."""
    texts = {"title": TITLE, "material": "ГОСТ 2.303", "scale": "1:1", **fields}
    items, inner, *_ = sheet_frame(PAPER, texts, Furniture(graph_26=False))
    sheet = Drawing(420.0, 297.0, texts["title"], items)
    middle = (inner[0] + inner[2]) / 2
    head = heading(f"{TITLE}, s = {said(S)} мм", 7.0)
    sheet.extend(head.place(complex(middle - head.width / 2, inner[3] - 5.0)))
    corner = complex(middle - sum(COLUMNS) / 2, inner[3] - 16.0)
    sheet.extend(_table(corner))
    below = corner - 1j * (HEAD + ROW * len(TYPES) + 5.0)
    width, height = sum(COLUMNS) / ACROSS, (below.imag - inner[1] - 5.0) / 2
    sheet.extend(drawn_grid(rule_cells(), below, across=ACROSS, width=width, height=height))
    return sheet


def _table(corner: complex) -> list[Item]:
    """Return the table of the line types from its upper left corner."""
    edges = [corner.real, *(corner.real + x for x in accumulate(COLUMNS))]
    levels = [corner.imag, corner.imag - HEAD]
    levels += [levels[1] - ROW * (k + 1) for k in range(len(TYPES))]
    items: list[Item] = [
        Stroke((complex(edges[0], y), complex(edges[-1], y)), Pen.THIN, tag="table")
        for y in levels[2:-1]
    ]
    items += [
        Stroke((complex(x, levels[0]), complex(x, levels[-1])), tag="table") for x in edges[1:-1]
    ]
    items.append(Stroke((complex(edges[0], levels[1]), complex(edges[-1], levels[1])), tag="table"))
    outline = (
        complex(edges[0], levels[0]),
        complex(edges[-1], levels[0]),
        complex(edges[-1], levels[-1]),
        complex(edges[0], levels[-1]),
    )
    items.append(Stroke(outline, closed=True, tag="table"))

    def put(text: str, column: int, row: int, align: Align = "left") -> None:
        box = (edges[column], levels[row + 1], edges[column + 1], levels[row])
        items.extend(fit(text, box, (TEXT, 2.5), align=align, pad=2.5, tag="table"))

    for column, text in enumerate(HEADS):
        put(text, column, 0, "centre")
    for row, kind in enumerate(TYPES, 1):
        drawn = sample(kind, complex(edges[1] + (COLUMNS[1] - SAMPLE) / 2, levels[row] - ROW / 2))
        items += drawn
        put(kind.name, 0, row)
        put(_width(kind.pen), 2, row, "centre")
        put(measured(drawn), 3, row, "centre")
        put(kind.use, 4, row)
    return items


def _width(pen: Pen) -> str:
    """Return the width of a pen, and the part of s that it is where it is less."""
    width = PENS[pen].width
    return f"{said(width)} (s)" if width == S else said(width)


# Rules -------------------------------------------------------------------------------------------


def rule_cells() -> list[Cell]:
    """Return how lines meet, begin and end, each rule with its picture."""
    return [*_crossings(), *_dashed(), *_meanings()]


def _crossings() -> Iterator[Cell]:
    """Yield axes that cross and touch."""
    yield Cell(
        "Центр – пересечение\nштрихов",
        RULE,
        (Arc(0j, 12.0), *centre_lines(0j, 12.0)),
    )
    small = SMALL_CIRCLE / 2 - 1.0
    yield Cell(
        f"Диаметр менее {said(SMALL_CIRCLE)} мм:\nлинии сплошные",
        RULE,
        (Arc(0j, small), *centre_lines(0j, small)),
    )
    touch = 9 + 0j
    yield Cell(
        "Окружности касаются\nв штрихе",
        RULE,
        (
            *pitch_circle(0j, 9.0, touch=touch),
            *pitch_circle(20 + 0j, 11.0, touch=touch),
            *axis_line(-12, 34, 0j, 20 + 0j),
        ),
    )


def _dashed() -> Iterator[Cell]:
    """Yield dashed lines with corners and without ends."""
    yield Cell(
        "Углы штриховой\nлинии – штрихами",
        RULE,
        (Stroke((-18 - 9j, 18 - 9j, 18 + 9j, -18 + 9j), Pen.HIDDEN, closed=True),),
    )
    yield Cell("Замкнутая штриховая\nбез шва", RULE, (Arc(0j, 12.0, pen=Pen.HIDDEN),))
    heads: list[Item] = []
    for k, length in enumerate((2.5, 3.5, 5.0, 7.0)):
        tip = 15 - 6.5j * k
        pen = Pen.MAIN if length >= ARROW.length else Pen.THIN
        heads += vector_arrow(tip - 30, tip, pen=pen, length=length)
    yield Cell("Стрелка: одна форма\nпри любой длине", "ГОСТ 2.307", tuple(heads))


def _meanings() -> Iterator[Cell]:
    """Yield lines in use."""
    end = 20 + 3j
    yield Cell(
        "Обрыв звена",
        RULE,
        (
            *link(-18 - 3j, end),
            *revolute(-18 - 3j),
            *wavy_line(end + 5j, end - 5j, wave=5.0),
        ),
    )
    ways = [cmath.rect(22.0, radians(turn)) for turn in (65.0, 115.0, 90.0)]
    yield Cell(
        "Крайние положения –\nс двумя точками",
        RULE,
        (
            *(Stroke((0j, way), Pen.PHANTOM) for way in ways[:2]),
            *link(0j, ways[2]),
            *fixed_pivot(0j),
            *revolute(ways[2]),
        ),
    )
    edge = SIZES.slider_length / 2
    yield Cell(
        "Ось направляющей –\nот края ползуна",
        RULE,
        (
            *guide_plates(0j, length=22.0),
            *axis_line(-edge, -edge - 17),
            *axis_line(edge, edge + 17),
            *slider(0j),
            *revolute(0j),
        ),
    )
