"""Specimen sheet of the lettering: every letter on the standard's grid, samples, proportions."""

# Cyrillic letters: the letters themselves, one by one

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from msgspec import Struct

from planmethod.note.formula import escape
from planmethod.note.wording import Language
from planmethod.render.control.texts import GRID
from planmethod.render.frame.frame import paper_format, sheet_frame
from planmethod.render.frame.furniture import Furniture
from planmethod.render.ink.drawing import Drawing, Item, Pen, Stroke, Text
from planmethod.render.ink.lettering import OutlineLettering, in_use
from planmethod.render.ink.style import HEIGHTS
from planmethod.render.ink.typeset import line_step, typeset
from planmethod.render.layout.block import Column, Lines
from planmethod.render.layout.pack import EDGE
from planmethod.render.layout.tables import TableColumn, table_block

PAPER = "A2"
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


def measured(lettering: OutlineLettering) -> list[Measured]:
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
    used, fmt = in_use(), paper_format(PAPER)
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
    measures = measured(lettering)
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
    return table_block(columns, 3.5, units="none", title=escape(texts.measured_title))
