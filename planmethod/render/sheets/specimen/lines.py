"""Specimens of the lines (GOST 2.303) and of the lettering: every letter on its grid."""

# Cyrillic letters: the letters themselves, one by one

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping, Sequence
from itertools import accumulate, islice
from math import radians

from msgspec import Struct

from planmethod.note.formula import escape
from planmethod.note.numbers import Notation
from planmethod.note.wording import Language
from planmethod.render import symbols
from planmethod.render.control.texts import GRID
from planmethod.render.frame import Furniture, paper_format, sheet_frame
from planmethod.render.ink.drawing import (
    HEIGHTS,
    Arc,
    Drawing,
    Item,
    Pen,
    Stroke,
    Text,
    stroke_lines,
)
from planmethod.render.ink.lettering import OutlineLettering, in_use
from planmethod.render.ink.pens import pens_in_use
from planmethod.render.ink.typeset import line_step, typeset
from planmethod.render.layout.block import Align, Column, Lines, fit_text, heading
from planmethod.render.layout.groups import EDGE
from planmethod.render.layout.text_blocks import TableColumn, TableForm, table_block
from planmethod.render.sheets.specimen.symbols import Clause, SymbolCell, drawn_grid
from planmethod.render.symbols import SIZES
from planmethod.render.symbols.marks import (
    SMALL_CIRCLE,
    axis_line,
    centre_lines,
    kinked_line,
    pitch_circle,
    wavy_line,
)

LINES_PAPER = "A3"
SAMPLE = 74.0
"""Length of a sample, mm."""

COLUMNS = (62.0, 84.0, 31.0, 38.0, 170.0)
ROW, HEAD = 12.5, 13.0
"""Widths of the columns, heights of the rows, mm."""

TEXT = 3.5
RULE = Clause("2.303")
RULES_PER_ROW = 6
"""Pictures of rules in a row."""


class LineType(Struct, frozen=True):
    """One type of line, by its name in ``line_names`` of ``specimens`` (тип линии)."""

    name: str
    pen: Pen


TYPES: tuple[LineType, ...] = (
    LineType("main", Pen.MAIN),
    LineType("resultant", Pen.RESULTANT),
    LineType("component", Pen.COMPONENT),
    LineType("thin", Pen.THIN),
    LineType("hatch", Pen.HATCH),
    LineType("wavy", Pen.BREAK),
    LineType("kinked", Pen.BREAK),
    LineType("hidden", Pen.HIDDEN),
    LineType("axis", Pen.AXIS),
    LineType("thick_axis", Pen.THICK_AXIS),
    LineType("phantom", Pen.PHANTOM),
)
"""The lines of the sheets, in the order of GOST 2.303."""


def length_text(value: float, notation: Notation) -> str:
    """Return the text of a length with one decimal."""
    return notation.number(f"{round(value, 1):g}")


def sample(kind: LineType, start: complex) -> list[Item]:
    """Return a line of the type, 74 mm from ``start`` to the right."""
    end = start + SAMPLE
    if kind.pen is Pen.BREAK:
        drawn = kinked_line if kind.name == "kinked" else wavy_line
        return drawn(start, end, tag="sample")
    return [Stroke((start, end), kind.pen, tag="sample")]


def measured_dashes(items: Sequence[Item], notation: Notation) -> str:
    """Return stroke and gap of a dashed sample, measured on its items; a dash if none."""
    (line,) = (item for item in items if isinstance(item, Stroke))
    pieces = stroke_lines(line)
    if len(pieces) < 2:
        return "–"
    longest = max(abs(piece[-1] - piece[0]) for piece in pieces)
    long = [piece for piece in pieces if abs(piece[-1] - piece[0]) > longest / 2]
    gap = long[1][0] - long[0][-1]
    return f"{length_text(longest, notation)}; {length_text(abs(gap), notation)}"


def lines_sheet(fields: Mapping[str, str], language: Language) -> Drawing:
    """Draw every line type with its width, dashes and use (лист типов линий)."""
    texts = {
        "title": language.specimens.lines,
        "material": RULE.describe(language.specimens),
        "scale": "1:1",
        **fields,
    }
    items, inner, *_ = sheet_frame(
        LINES_PAPER, texts, Furniture(graph_26=False, lang=language.lang)
    )
    sheet = Drawing(420.0, 297.0, texts["title"], items)
    middle = (inner[0] + inner[2]) / 2
    s = length_text(sheet.pens.s, language.notation)
    head = heading(language.specimens.lines_head.format(s=s), 7.0)
    sheet.extend(head.place(complex(middle - head.width / 2, inner[3] - 5.0)))
    corner = complex(middle - sum(COLUMNS) / 2, inner[3] - 16.0)
    sheet.extend(_table(corner, language))
    below = corner - 1j * (HEAD + ROW * len(TYPES) + 5.0)
    width, height = sum(COLUMNS) / RULES_PER_ROW, (below.imag - inner[1] - 5.0) / 2
    cells = rule_cells(language.notation)
    sheet.extend(
        drawn_grid(
            cells, below, language.specimens, columns=RULES_PER_ROW, width=width, height=height
        )
    )
    return sheet


def _table(corner: complex, language: Language) -> list[Item]:
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

    def fill_cell(text: str, column: int, row: int, align: Align = "left") -> None:
        box = (edges[column], levels[row + 1], edges[column + 1], levels[row])
        items.extend(fit_text(text, box, (TEXT, 2.5), align=align, pad=2.5, tag="table"))

    for column, text in enumerate(language.specimens["columns_lines"]):
        fill_cell(text, column, 0, "centre")
    for row, kind in enumerate(TYPES, 1):
        drawn = sample(kind, complex(edges[1] + (COLUMNS[1] - SAMPLE) / 2, levels[row] - ROW / 2))
        items += drawn
        fill_cell(language.specimens["line_names"][kind.name], 0, row)
        fill_cell(_width(kind.pen, language.notation), 2, row, "centre")
        fill_cell(measured_dashes(drawn, language.notation), 3, row, "centre")
        fill_cell(language.specimens["line_uses"][kind.name], 4, row)
    return items


def _width(pen: Pen, notation: Notation) -> str:
    """Return the width of a pen, marked (s) for a main line."""
    pens = pens_in_use()
    width = notation.number(f"{pens.width(pen):g}")
    return f"{width} (s)" if pens.width(pen) == pens.s else width


# Rules -------------------------------------------------------------------------------------------


def rule_cells(notation: Notation) -> list[SymbolCell]:
    """Return the rules for crossings and ends of lines, each with its picture."""
    return [*_crossings(notation), *_dashed(), *_meanings()]


def _crossings(notation: Notation) -> Iterator[SymbolCell]:
    """Yield axes that cross and touch."""
    yield SymbolCell(
        "axes_cross",
        RULE,
        (Arc(0j, 12.0), *centre_lines(0j, 12.0)),
    )
    small = SMALL_CIRCLE / 2 - 1.0
    yield SymbolCell(
        "small_circle",
        RULE,
        (Arc(0j, small), *centre_lines(0j, small)),
        size=length_text(SMALL_CIRCLE, notation),
    )
    touch = 9 + 0j
    yield SymbolCell(
        "circles_touch",
        RULE,
        (
            *pitch_circle(0j, 9.0, touch=touch),
            *pitch_circle(20 + 0j, 11.0, touch=touch),
            *axis_line(-12, 34, 0j, 20 + 0j),
        ),
    )


def _dashed() -> Iterator[SymbolCell]:
    """Yield dashed lines with corners and without ends."""
    yield SymbolCell(
        "dashed_corners",
        RULE,
        (Stroke((-18 - 9j, 18 - 9j, 18 + 9j, -18 + 9j), Pen.HIDDEN, closed=True),),
    )
    yield SymbolCell("dashed_closed", RULE, (Arc(0j, 12.0, pen=Pen.HIDDEN),))
    heads: list[Item] = [*symbols.straight_arrow(-15, 15)]
    for k, pen in enumerate((Pen.COMPONENT, Pen.RESULTANT, Pen.RESULTANT), 1):
        tip, length = 15 - 6.5j * k, 30.0 if k < 3 else 6.0
        heads += symbols.vector_arrow(tip - length, tip, pen=pen)
    yield SymbolCell("arrow", Clause("2.307"), tuple(heads))


def _meanings() -> Iterator[SymbolCell]:
    """Yield lines in use."""
    end = 20 + 3j
    yield SymbolCell(
        "broken",
        RULE,
        (
            *symbols.link(-18 - 3j, end),
            *symbols.revolute(-18 - 3j),
            *wavy_line(end + 5j, end - 5j, wave=5.0),
        ),
    )
    ways = [cmath.rect(22.0, radians(turn)) for turn in (65.0, 115.0, 90.0)]
    yield SymbolCell(
        "extreme",
        RULE,
        (
            *(Stroke((0j, way), Pen.PHANTOM) for way in ways[:2]),
            *symbols.link(0j, ways[2]),
            *symbols.fixed_pivot(0j),
            *symbols.revolute(ways[2]),
        ),
    )
    edge = SIZES.slider_length / 2
    yield SymbolCell(
        "guide_axis",
        RULE,
        (
            *symbols.guide_plates(0j, length=22.0),
            *axis_line(-edge, -edge - 17),
            *axis_line(edge, edge + 17),
            *symbols.slider(0j),
            *symbols.revolute(0j),
        ),
    )


LETTERING_PAPER = "A2"
HEIGHT = 14.0
"""Height h of the letters on the grid, mm."""

ALPHABETS = (
    "АБВГДЕЁЖЗИЙКЛМНОПРСТУФХЦЧШЩЪЫЬЭЮЯ",
    "абвгдеёжзийклмнопрстуфхцчшщъыьэюя",
    "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789",
    "abcdefghijklmnopqrstuvwxyzΓΔΘΛΞΠΣΦΨΩ",
    "αβγδεζηθικλμνξοπρστυφχψω.,:;!?-–—+−±×·=",
    "<>≤≥≈≠√∞∠⊥∥№→∅°′″()[]{}/%&«»∑∫∂∇²³ⁿ₁₂△",
)
"""Letters and signs that the lettering has, whatever the language of the sheet."""


class Measured(Struct, frozen=True):
    """A measure of the letters in parts of h: its sign, by the standard, on the ink."""

    symbol: str
    nominal: float
    actual: float


def measured_proportions(lettering: OutlineLettering) -> list[Measured]:
    """Return the proportions of a lettering measured on its outlines (размеры шрифта)."""
    kind = lettering.style.proportions

    def ink(text: str) -> tuple[float, float, float, float]:
        return lettering.ink(text, 1.0)

    def wide(text: str) -> float:
        # The lean of slanted letters is not part of their width.
        left, low, right, high = ink(text)
        return right - left - lettering.style.lean * (high - low - lettering.line)

    gap = wide("HH") - 2 * wide("H")
    words = wide("H H") - 2 * wide("H")
    cap = kind.cap
    return [
        Measured("h", 1.0, ink("H")[3]),
        Measured("c", kind.small / cap, ink("x")[3]),
        Measured("a", kind.gap / cap, gap),
        Measured("b", kind.line_step / cap, lettering.line_step),
        Measured("e", kind.word_gap / cap, words),
        Measured("d", 1.0 / cap, ink("−")[3] - ink("−")[1]),
    ]


def lettering_sheet(fields: Mapping[str, str], language: Language) -> Drawing:
    """Draw the specimen of the lettering in use (образец шрифта).

    ``fields`` are texts of the title block that outrank those of the specimen.
    """
    used, fmt = in_use(), paper_format(LETTERING_PAPER)
    said = language.specimens
    slope = said.slanted if used.style.slanted else said.upright
    title = said.lettering.format(kind=said["kinds"][used.style.kind], slope=slope)
    texts = {"title": title, "material": said.standard.format(number="2.304-81"), **fields}
    drawing = Drawing(fmt.width, fmt.height, title)
    items, inner, *_ = sheet_frame(fmt, texts, Furniture(graph_26=False, lang=language.lang))
    drawing.extend(items)
    left, top = inner[0] + EDGE, inner[3] - EDGE - 4.0
    d = HEIGHT * used.line
    step = used.style.proportions.line_step * d + 4 * d
    low = top - HEIGHT
    for row in ALPHABETS:
        drawing.extend(_on_grid(row, complex(left, low), inner[2] - EDGE))
        low -= step
    heights = [height for height in HEIGHTS if 2.5 <= height <= 10.0]
    samples = Column([_sample(said["samples"], height) for height in heights], gap=10.0)
    drawing.extend(samples.place(complex(left, low + HEIGHT)))
    table = _proportions(used, language)
    drawing.extend(table.place(complex(inner[2] - EDGE - table.width, low + HEIGHT - 10.0)))
    return drawing


def _sample(texts: Sequence[str], height: float) -> Column:
    """Return words and formulas of a sheet, their base lines a line step apart."""
    lines = [typeset(text, height) for text in texts]
    return Column([Lines(tuple(lines), line_step(height))])


def _on_grid(row: str, start: complex, right: float) -> Iterator[Item]:
    """Yield the letters of a row, each on its piece of the grid; the first ends at the margin."""
    used = in_use()
    kind = used.style.proportions
    d = HEIGHT * used.line
    room = right - start.real
    widths = [used.width(char, HEIGHT) for char in row]
    between = min(3.0 * d, (room - sum(widths)) / max(1, len(row) - 1))
    x = start.real
    for char, wide in zip(row, widths, strict=True):
        at = complex(x, start.imag)
        yield from _grid(at, wide, d, kind.cap, kind.tail)
        yield Text(at, char, HEIGHT, label=f"{char}@{x:.1f},{start.imag:.1f}")
        x += wide + between


def _grid(at: complex, wide: float, d: float, cap: int, tail: int) -> Iterator[Item]:
    """Yield the grid under a letter, whose step is the line thickness; it leans as the letter."""
    used = in_use()
    low, high = -tail * d, cap * d

    def place(x: float, y: float) -> complex:
        return at + complex(x + used.leaning(y, HEIGHT), y)

    for k in range(round(wide / d) + 1):
        yield Stroke((place(k * d, low), place(k * d, high)), Pen.PALE, tag=GRID)
    for k in range(-tail, cap + 1):
        pen = Pen.THIN if k in (0, cap) else Pen.PALE
        yield Stroke((place(0.0, k * d), place(wide, k * d)), pen, tag=GRID)


def _proportions(lettering: OutlineLettering, language: Language) -> Column:
    """Return the table of proportions: by the standard, and measured on the letters, mm."""
    measures = measured_proportions(lettering)
    cap = lettering.style.proportions.cap
    heights = list(islice((h for h in HEIGHTS if h >= 2.5), 5))
    texts, number = language.specimens, language.notation.number
    size, by_standard, found = texts["columns_measured"]
    columns = [
        TableColumn("", tuple(m.symbol for m in measures), min_width=8.0),
        TableColumn(size, tuple(texts["measures"][m.symbol] for m in measures)),
        TableColumn(by_standard, tuple(f"{round(m.nominal * cap)}/{cap} h" for m in measures)),
        TableColumn(found, tuple(number(f"{m.actual * cap:.2f}") + f"/{cap} h" for m in measures)),
    ]
    columns += [
        TableColumn(
            f"h = {number(f'{h:g}')}", tuple(number(f"{m.actual * h:.2f}") for m in measures)
        )
        for h in heights
    ]
    return table_block(columns, TableForm(3.5, units="none"), title=escape(texts.measured_title))
