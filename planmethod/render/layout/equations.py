"""Vector equations with underlines and notes, and formula lines, as blocks (уравнения).

A vector equation of the plan method marks under every term the knowledge before the plan is drawn:
one line under a term whose direction alone is known, two under one that is fully known, and below
the lines the direction itself::

    v_C   =   v_B  +  v_CB
    ───       ═══     ────
   ∥ x-x     ⊥ AB     ⊥ BC
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from functools import cached_property, partial

from msgspec import Struct

from planmethod.note.document import Equation, Term
from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.ink.typeset import (
    Inscription,
    index_height,
    line_step,
    smaller_heights,
    split_words,
    typeset,
    vector_markup,
)
from planmethod.render.layout.block import Line, Lines

_SIGN_GAP = 0.45  # of h: white on both sides of a sign
_UNDER_GAP = 0.3  # of h: from the ink of a term to its underline, and between two underlines
_NOTE_GAP = 0.4  # of h: from the underline to its note
_BETWEEN_NOTES = 0.6  # of h: least white between the notes of neighbours
_BETWEEN_ROWS = 0.9  # of h: white between the rows of an equation that was wrapped

OPERATORS = frozenset({"=", "+", "-", "−", "≈", "·", "±", "→"})
"""Signs that a formula may be broken at; the sign is repeated on the next line."""

INDENT = 5.0
"""Indent of the further lines of a formula, mm."""


class _Term(Struct, frozen=True):
    """Term of the equation, its note, and the place of its left edge in the row, mm."""

    inscription: Inscription
    note: Inscription
    underlines: int
    x: float = 0.0

    @property
    def middle(self) -> float:
        return self.x + self.inscription.width / 2

    @property
    def left(self) -> float:
        return min(self.x, self.middle - self.note.width / 2)

    @property
    def right(self) -> float:
        return max(self.x + self.inscription.width, self.middle + self.note.width / 2)


class _EquationRow(Struct, frozen=True):
    terms: tuple[_Term, ...]
    signs: tuple[tuple[float, Inscription], ...]

    @property
    def right(self) -> float:
        ends = [x + sign.width for x, sign in self.signs]
        return max([term.right for term in self.terms] + ends)


class EquationBlock(Struct, frozen=True, dict=True):
    """Vector equation as a block (векторное уравнение)."""

    rows: tuple[_EquationRow, ...]
    letter: float

    @cached_property
    def width(self) -> float:
        """Width, mm."""
        return max(row.right for row in self.rows)

    @cached_property
    def height(self) -> float:
        """Height, mm."""
        gaps = _BETWEEN_ROWS * self.letter * (len(self.rows) - 1)
        return sum(sum(self._levels(r)) for r in self.rows) + gaps

    def _levels(self, row: _EquationRow) -> tuple[float, float, float, float]:
        """Return the levels of a row, mm.

        Ink above the base line of the terms; from there down to the first underlines; on down to
        the base line of the notes; ink below that.
        """
        gap = _UNDER_GAP * self.letter
        above = max(term.inscription.ascent for term in row.terms)
        lines = max(term.underlines for term in row.terms)
        under = max(term.inscription.descent for term in row.terms) + gap
        noted = [term.note for term in row.terms if term.note.width]
        if not noted:
            return above, under, gap * max(0, lines - 1), 0.0
        rise = max(note.ascent for note in noted)
        drop = gap * max(0, lines - 1) + _NOTE_GAP * self.letter + rise
        return above, under, drop, max(note.descent for note in noted)

    def place(self, corner: complex) -> list[Item]:
        """Return letters, underlines and notes with the upper left corner at ``corner``, mm."""
        items: list[Item] = []
        for row in self.rows:
            above, under, drop, below = self._levels(row)
            base = corner - 1j * above
            for term in row.terms:
                items += term.inscription.at(base + term.x)
                for k in range(term.underlines):
                    left = base + term.x - 1j * (under + k * _UNDER_GAP * self.letter)
                    items.append(Stroke((left, left + term.inscription.width), Pen.THIN))
                if term.note.width:
                    items += term.note.at(base + term.middle - 1j * (under + drop), anchor="centre")
            for x, sign in row.signs:
                items += sign.at(base + x)
            corner = base - 1j * (under + drop + below + _BETWEEN_ROWS * self.letter)
        return items


def equation_block(
    equation: Equation, height: float = 5.0, *, width: float | None = None
) -> EquationBlock:
    """Return a vector equation with underlines and notes (векторное уравнение).

    A sum equal to zero (уравнение равновесия) has its name before it.

    Parameters
    ----------
    equation : Equation
    height : float, mm
        Cap height of the terms; that of the notes is an index's, but 2.5 at least.
    width : float, mm, optional
        Greatest width. A longer equation goes on in a second row at a ``+``, which is repeated
        there; when even single terms are too wide, the letters shrink to the next GOST height.
    """
    vectors = [_vector(term) for term in (*equation.left, *equation.right)]
    plus = ["+" for _ in vectors]
    if equation.right:
        return _fit_equation(vectors, ["", "=", *plus[2:]], height, width, hangs=True)
    whole = [Term(equation.name), *vectors, Term("0")]
    return _fit_equation(whole, ["", "=", *plus[1:], "="], height, width, hangs=False)


def _vector(term: Term) -> Term:
    """Return a term with the bar of a vector."""
    return Term(vector_markup(term.symbol), term.underlines, term.direction)


def _fit_equation(
    equation_terms: Sequence[Term],
    signs: Sequence[str],
    height: float,
    width: float | None,
    *,
    hangs: bool,
) -> EquationBlock:
    """Return terms, each with the sign before it, in letters that shrink until they fit."""
    for size in smaller_heights(height):
        small = max(2.5, index_height(size))
        terms = [
            _Term(typeset(term.symbol, size), typeset(term.direction, small), term.underlines)
            for term in equation_terms
        ]
        block = EquationBlock(_rows(terms, signs, size, width, hangs=hangs), size)
        if width is None or block.width <= width:
            break
    return block


def _rows(
    terms: Sequence[_Term], signs: Sequence[str], size: float, width: float | None, *, hangs: bool
) -> tuple[_EquationRow, ...]:
    """Return terms in rows; where the equation ``hangs``, later rows begin under its right side."""
    setter = _RowSetter(size)
    rows: list[_EquationRow] = []
    indent = 0.0
    for k, (term, sign) in enumerate(zip(terms, signs, strict=True)):
        last = k == len(terms) - 1
        if (
            width is not None
            and k > (1 if hangs else 0)
            and setter.reach(term, sign, last=last) > width
        ):
            setter.sign(sign)
            rows.append(setter.row())
            setter = _RowSetter(size, start=indent)
        if sign:
            setter.sign(sign)
        setter.add(term)
        if hangs and k == 1:
            # Under the first term after the sign "=", or further left if the note there sticks out.
            indent = max(0.0, setter.sign_x)
    return (*rows, setter.row())


class _RowSetter:
    """Put terms and signs from left to right so that neither letters nor notes collide."""

    def __init__(self, size: float, start: float = 0.0) -> None:
        self.size = size
        self.terms: list[_Term] = []
        self.signs: list[str] = []
        self.start = start
        self.placed: list[tuple[float, Inscription]] = []
        self.pending: str | None = None
        self.sign_x = 0.0

    def sign(self, text: str) -> None:
        self.pending = text

    def _next(self, term: _Term, sign: str | None) -> tuple[_Term, float]:
        """Return the term at its place and the x of the sign before it."""
        gap = _SIGN_GAP * self.size
        room = self._set(sign).width + 2 * gap if sign else 0.0
        overhang = max(0.0, (term.note.width - term.inscription.width) / 2)
        if not self.terms:
            lead = room - gap if sign else 0.0
            return self._at(term, max(self.start + lead, self.start + overhang)), self.start
        before = self.terms[-1]
        end = before.x + before.inscription.width
        x = max(end + room, self.start + overhang)
        if before.note.width and term.note.width:
            x = max(x, before.right + _BETWEEN_NOTES * self.size + overhang)
        middle = (end + x) / 2
        return self._at(term, x), middle - (room - 2 * gap) / 2

    def _at(self, term: _Term, x: float) -> _Term:
        return _Term(term.inscription, term.note, term.underlines, x)

    def _set(self, sign: str) -> Inscription:
        return typeset(sign, self.size)

    def reach(self, term: _Term, sign: str, *, last: bool) -> float:
        """Return the right end of the row with one more term, mm."""
        placed, _ = self._next(term, sign)
        tail = 0.0 if last else self._set("+").width + _SIGN_GAP * self.size
        return max(placed.right, placed.x + placed.inscription.width + tail)

    def add(self, term: _Term) -> None:
        placed, sign_x = self._next(term, self.pending)
        if self.pending:
            self.placed.append((sign_x, self._set(self.pending)))
            self.sign_x = sign_x
        self.pending = None
        self.terms.append(placed)

    def row(self) -> _EquationRow:
        if self.pending:
            last = self.terms[-1]
            x = last.x + last.inscription.width + _SIGN_GAP * self.size
            self.placed.append((x, self._set(self.pending)))
        return _EquationRow(tuple(self.terms), tuple(self.placed))


def formula_block(markup: str, height: float = 3.5, *, width: float | None = None) -> Line | Lines:
    """Return a scalar formula as rich text (расчётная формула).

    For instance ``ω_{2} = v_{CB}/l_{BC} = 1,55/0,1 = 15,5 с^{-1}``. A formula wider than ``width``
    mm is broken at a sign of `OPERATORS` that stands between spaces; the sign is repeated on the
    next line (GOST 2.105), which is `INDENT` mm to the right. Without such a sign in reach it is
    broken at a space.
    """
    whole = typeset(markup, height)
    if width is None or whole.width <= width:
        return Line(whole)
    lines = _broken_formula(split_words(markup), height, width)
    set_lines = tuple(typeset(line, height) for line in lines)
    return Lines(set_lines, line_step(height), indent=INDENT)


def _width(words: Sequence[str], height: float, count: int) -> float:
    return typeset(" ".join(words[:count]), height).width


def _broken_formula(words: Sequence[str], height: float, width: float) -> list[str]:
    """Fill lines greedily, breaking after an operator; the next line starts with it again."""
    lines: list[str] = []
    rest = list(words)
    while rest:
        room = width - (INDENT if lines else 0.0)
        every = range(len(rest) + 1)
        full = bisect_right(every, room, lo=2, key=partial(_width, rest, height)) - 1
        if full == len(rest):
            lines.append(" ".join(rest))
            break
        # A sign at the very start was repeated from the line before: no progress to break there.
        cuts = [k for k in range(1, full) if rest[k] in OPERATORS]
        if cuts:
            lines.append(" ".join(rest[: cuts[-1] + 1]))
            rest = rest[cuts[-1] :]
        else:
            lines.append(" ".join(rest[:full]))
            rest = rest[full:]
    return lines
