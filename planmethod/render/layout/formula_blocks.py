"""Scalar formulas as blocks of a sheet: their equalities under one another, and their breaks."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Sequence
from functools import partial

from planmethod.render.ink.typeset import line_step, split_words, typeset
from planmethod.render.layout.block import SIGNS, Line, Lines, paragraph

OPERATORS = SIGNS | {"=", "-", "·", "→"}
"""Signs that a formula may be broken at; the sign is repeated on the next line."""

INDENT = 5.0
"""Indent of the further lines of a formula, mm."""


_WORD = re.compile(r"(?<![{\\])\b[^\W\d_]{4,} ")


def formula_block(
    markup: str, height: float = 3.5, *, width: float | None = None, equals: float = 0.0
) -> Line | Lines:
    r"""Return a scalar formula as rich text, fractions with a line (расчётная формула).

    For instance ``ω_{2} = \frac{v_{CB}}{l_{BC}} = \frac{1,55}{0,1} = 15,5 с^{-1}``. A formula
    wider than ``width`` mm is broken at a sign of `OPERATORS` that stands between spaces; the sign
    is repeated on the next line (GOST 2.105), which begins under the first sign of equality, or
    `INDENT` mm to the right. A product that is too wide is broken between factors, with the sign ×.
    Without such a sign in reach it is broken at a space; a fraction that is too wide is set in one
    line.

    Parameters
    ----------
    equals : float, mm
        Place of the first sign of equality: the left side is moved to it.
    """
    whole = typeset(markup, height, built=True)
    lead = max(0.0, equals - equals_at(markup, height)) if equals else 0.0
    if width is None or lead + whole.width <= width:
        return Line(whole.shifted_by(lead))
    if not equals and _WORD.search(markup):  # a sentence with an equality in it
        return paragraph(markup, height, width)
    indent = equals or INDENT
    room = width - indent - typeset("=  =", height).width  # between the signs of a line
    words = [
        one for word in split_words(markup, built=True) for one in _factors(word, height, room)
    ]
    if any(typeset(word, height, built=True).width > width - INDENT for word in words):
        words = split_words(markup)
    lines = _broken_formula(words, height, (width - lead, width - indent))
    first, *others = (typeset(line, height, built=True) for line in lines)
    return Lines(
        (first.shifted_by(lead), *(one.shifted_by(indent) for one in others)), line_step(height)
    )


ALIGNED = 5.0
"""Widest left side, in heights of letters, whose sign of equality is under that of the others."""


def equals_at(markup: str, height: float) -> float:
    """Return where the first sign of equality of a formula is, mm; 0 where it has none."""
    left, sign, _ = markup.partition(" = ")
    return typeset(f"{left} ", height, built=True).width if sign else 0.0


def formula_blocks(
    formulas: Iterable[str], height: float = 3.5, *, width: float | None = None
) -> list[Line | Lines]:
    """Return the formulas of a calculation, their first signs of equality under one another."""
    texts = list(formulas)
    places = [equals_at(text, height) for text in texts]
    shared = max((place for place in places if place <= ALIGNED * height), default=0.0)
    return [
        formula_block(text, height, width=width, equals=shared if 0.0 < place <= shared else 0.0)
        for text, place in zip(texts, places, strict=True)
    ]


def _width(words: Sequence[str], height: float, count: int) -> float:
    return typeset(" ".join(words[:count]), height, built=True).width


def _broken_formula(words: Sequence[str], height: float, widths: tuple[float, float]) -> list[str]:
    """Fill lines greedily, breaking after an operator; the next line starts with it again.

    ``widths`` are those of the first line and of the others.
    """
    lines: list[str] = []
    rest = list(words)
    while rest:
        every = range(len(rest) + 1)
        room = widths[bool(lines)]
        full = bisect_right(every, room, lo=2, key=partial(_width, rest, height)) - 1
        if full == len(rest):
            lines.append(" ".join(rest))
            break
        # A sign at the very start was repeated from the line before: no progress to break there.
        cuts = [k for k in range(1, full) if rest[k] in OPERATORS]
        cuts = [k for k in cuts[len(lines) == 0 :] if rest[k] == "="] or cuts
        if cuts:
            if rest[cuts[-1]] == "·":
                rest[cuts[-1]] = "×"
            lines.append(" ".join(rest[: cuts[-1] + 1]))
            rest = rest[cuts[-1] :]
        else:
            lines.append(" ".join(rest[:full]))
            rest = rest[full:]
    return [line.replace(" · ", "·") for line in lines]


def _factors(word: str, height: float, width: float) -> list[str]:
    """Return a product that is wider than its line as its factors and the signs between them."""
    if typeset(word, height, built=True).width <= width:
        return [word]
    pieces, depth = [""], 0
    for sign in word:
        depth += (sign in "{(") - (sign in "})")
        if sign == "·" and not depth:
            pieces += [sign, ""]
        else:
            pieces[-1] += sign
    return pieces
