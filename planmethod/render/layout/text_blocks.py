"""Tables, vector equations, formula lines and texts as blocks of a sheet."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property, lru_cache
from itertools import accumulate, count, groupby
from typing import Literal, TypeAlias, assert_never

from msgspec import Struct
from msgspec.structs import replace

from planmethod.errors import LayoutError
from planmethod.note.document import (
    Caption,
    Equation,
    Equations,
    Formula,
    Item as DocumentItem,
    Note,
    Paragraph,
    Term,
)
from planmethod.render.ink.drawing import Bounds, Item, Pen, Stroke
from planmethod.render.ink.lettering import OutlineLettering, in_use
from planmethod.render.ink.typeset import (
    Inscription,
    index_height,
    smaller_heights,
    typeset,
    vector_markup,
)
from planmethod.render.layout.block import Block, Column as Stack, Line, heading, paragraph
from planmethod.render.layout.formula_blocks import formula_blocks
from planmethod.render.symbols import turn_sign

_SIGN_GAP = 0.45  # of h: white on both sides of a sign
_UNDER_GAP = 0.3  # of h: from the ink of a term to its underline, and between two underlines
_NOTE_GAP = 0.4  # of h: from the underline to its note
_BETWEEN_NOTES = 0.6  # of h: least white between the notes of neighbours
_BETWEEN_ROWS = 0.9  # of h: white between the rows of an equation that was wrapped


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
        return [item for _, part in self.parts(corner) for item in part]

    def parts(self, corner: complex) -> Iterator[tuple[int | None, list[Item]]]:
        """Yield the number of each term with its items; without a number, the signs of a row."""
        numbers = count()
        for row in self.rows:
            above, under, drop, below = self._levels(row)
            base = corner - 1j * above
            for term in row.terms:
                items = list(term.inscription.at(base + term.x))
                for k in range(term.underlines):
                    left = base + term.x - 1j * (under + k * _UNDER_GAP * self.letter)
                    items.append(Stroke((left, left + term.inscription.width), Pen.LETTER))
                if term.note.width:
                    items += term.note.at(base + term.middle - 1j * (under + drop), anchor="centre")
                yield next(numbers), items
            yield None, [item for x, sign in row.signs for item in sign.at(base + x)]
            corner = base - 1j * (under + drop + below + _BETWEEN_ROWS * self.letter)


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
    number = [Term(f"({equation.number})")] if equation.number else []
    if equation.right:
        signs = ["", *plus[1:]]
        signs[len(equation.left)] = "="
        signs += [" " for _ in number]
        return _fit_equation([*vectors, *number], signs, height, width, hangs=True)
    whole = [Term(equation.name), *vectors, Term("0"), *number]
    signs = ["", "=", *plus[1:], "=", *(" " for _ in number)]
    return _fit_equation(whole, signs, height, width, hangs=False)


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


UnitsAt: TypeAlias = Literal["below", "none"]

_PAD = 1.5  # white on both sides of a cell's text, mm
_SENSE_GAP = 1.2  # between a value and the sign of its sense, mm
_NUMBER = r"[-−+]?\d+(?P<fraction>[.,]\d+)?( ± \d+([.,]\d+)?)?\*?$"


class TableCell(Struct, frozen=True):
    """One value (графа): rich text and, for ω and ε, the sense.

    ``sense`` is +1 (counter-clockwise) or -1 (clockwise): a small circular arrow beside the value;
    0 keeps space for it, so that a column stays aligned; None does not.
    """

    text: str
    sense: int | None = None


class TableColumn(Struct, frozen=True):
    """Column of a table (столбец): its symbol, unit and values, one per row.

    ``width`` is the width aimed at, mm: values that do not fit shrink to the next GOST height,
    and if they still do not, the column grows. Without it the column is as wide as its text needs,
    ``min_width`` at least. ``joined``: a table is not cut between it and the column before.
    """

    head: str
    values: tuple[TableCell | str, ...]
    unit: str = ""
    width: float | None = None
    min_width: float = 12.0
    joined: bool = False

    @property
    def cells(self) -> tuple[TableCell, ...]:
        """The values, plain strings made into cells."""
        return tuple(v if isinstance(v, TableCell) else TableCell(v) for v in self.values)


class _Set(Struct, frozen=True):
    """Column with everything typeset: symbol, unit, values, and its width, mm."""

    source: TableColumn
    head: Inscription
    unit: Inscription
    values: tuple[Inscription, ...]
    width: float
    lefts: tuple[float, ...]  # left ends of the values from the middle of the column, mm
    sign: complex  # centre of the signs of sense from the middle (real) and their size (imag)


class TablePart(Struct, frozen=True, dict=True):
    """One table on the paper: a block (таблица)."""

    columns: tuple[_Set, ...]
    widths: tuple[float, ...]
    units: UnitsAt
    row_height: float

    @cached_property
    def width(self) -> float:
        """Width, mm."""
        return sum(self.widths)

    @cached_property
    def height(self) -> float:
        """Height, mm."""
        return sum(self._row_heights())

    def _head_rows(self) -> int:
        return 1 if self.units == "none" else 2

    def _row_heights(self) -> list[float]:
        values = zip(*(column.values for column in self.columns), strict=True)
        heads = [[c.head for c in self.columns], [c.unit for c in self.columns]]
        heads = heads[: self._head_rows()]
        return [max(map(self._min_row_height, row)) for row in [*heads, *map(list, values)]]

    def _min_row_height(self, text: Inscription) -> float:
        """Return the least height of a row with this text, which is centred by its cap height."""
        overhang = max(text.descent, text.ascent - text.height, 0.0)
        return max(self.row_height, text.height + 2 * overhang + 1.0)

    def place(self, corner: complex) -> list[Item]:
        """Return lines and texts with the upper left corner at ``corner``, mm."""
        xs = [corner.real, *(corner.real + w for w in accumulate(self.widths))]
        ys = [corner.imag, *(corner.imag - h for h in accumulate(self._row_heights()))]
        head_rows = self._head_rows()
        items = self._lines(xs, ys)
        if self.units == "below":
            for first, last in self._unit_spans():
                if self.columns[first].unit.runs:
                    box = (xs[first], ys[2], xs[last + 1], ys[1])
                    items += _centred(self.columns[first].unit, box)
        for k, column in enumerate(self.columns):
            bottom = ys[head_rows] if self._spans_head(k) else ys[1]
            items += _centred(column.head, (xs[k], bottom, xs[k + 1], ys[0]))
            for row in range(len(column.values)):
                top, bottom = ys[head_rows + row], ys[head_rows + row + 1]
                items += _value(column, row, (xs[k], bottom, xs[k + 1], top))
        return items

    def _spans_head(self, k: int) -> bool:
        """Return True when the head of a column, having no unit, takes both head rows."""
        return self.units != "none" and not self.columns[k].source.unit

    def _unit_spans(self) -> list[tuple[int, int]]:
        """Return first and last column of each unit cell; neighbours with one unit share it."""
        spans: list[tuple[int, int]] = []
        for _, group in groupby(range(len(self.columns)), lambda k: self.columns[k].source.unit):
            members = list(group)
            if self.columns[members[0]].source.unit:
                spans.append((members[0], members[-1]))
            else:
                spans += [(k, k) for k in members]
        return spans

    def _lines(self, xs: Sequence[float], ys: Sequence[float]) -> list[Item]:
        """Return thin inner lines, then the thick outline and the thick line under the head."""
        head = self._head_rows()
        joined = {k for first, last in self._unit_spans() for k in range(first + 1, last + 1)}
        items: list[Item] = []
        for k in range(1, len(xs) - 1):
            shares = self.units == "below" and k in joined
            for top, low in ((0, 1), (2, -1)) if shares else ((0, -1),):
                items.append(_line(complex(xs[k], ys[top]), complex(xs[k], ys[low])))
        for row in range(1, len(ys) - 1):
            if row == head:
                continue
            if row < head:
                # The line between symbols and units stops at heads that take both rows.
                for whole, group in groupby(range(len(self.columns)), self._spans_head):
                    members = list(group)
                    if not whole:
                        ends = (
                            complex(xs[members[0]], ys[row]),
                            complex(xs[members[-1] + 1], ys[row]),
                        )
                        items.append(_line(*ends))
            else:
                items.append(_line(complex(xs[0], ys[row]), complex(xs[-1], ys[row])))
        if head < len(ys) - 1:
            items.append(_line(complex(xs[0], ys[head]), complex(xs[-1], ys[head]), Pen.MAIN))
        corners = (
            complex(xs[0], ys[-1]),
            complex(xs[-1], ys[-1]),
            complex(xs[-1], ys[0]),
            complex(xs[0], ys[0]),
        )
        return [*items, Stroke(corners, Pen.MAIN, closed=True, tag="table")]


class TableForm(Struct, frozen=True):
    """Form of a table.

    Attributes
    ----------
    height, row_height : float, mm
        Cap height of heads and values, and height of the rows.
    units : {"below", "none"}
        Unit cells under the symbols, shared by neighbours, or none.
    leading : int
        Number of first columns (position number, φ) that are repeated in every part.
    shrinks : bool
        A table that is too wide has smaller letters if that makes it fit in one part.
    """

    height: float = 3.5
    units: UnitsAt = "below"
    leading: int = 0
    row_height: float = 8.0
    shrinks: bool = True


USUAL_FORM = TableForm()
"""Form of a table by default."""


def table_block(
    columns: Sequence[TableColumn],
    form: TableForm = USUAL_FORM,
    *,
    max_width: float | None = None,
    width: float | None = None,
    title: str = "",
) -> Stack:
    """Return a table of results as a block (таблица результатов).

    Parameters
    ----------
    columns : sequence of TableColumn
        All with the same number of values.
    form : TableForm
    max_width : float, mm, optional
        Greatest width. A wider table is first set one GOST height smaller, unless the form keeps
        its height, and if that does not do either, cut into parts one under another at the full
        height.
    width : float, mm, optional
        Width to stretch each part to, not beyond ``max_width``, for a table above the title block.
    title : str
        Rich text above the upper left corner.

    Raises
    ------
    LayoutError
        If columns is empty, columns have different numbers of values, or a single column with
        the leading ones is wider than ``max_width``.
    """
    _check(columns)
    limit = max_width if max_width is not None else width
    height, leading = form.height, form.leading
    parts = [_set_all(columns, height)]
    if limit is not None and _total(parts[0]) > limit + 1e-9:
        smaller = _set_all(columns, smaller_heights(height)[:2][-1])
        if form.shrinks and _total(smaller) <= limit + 1e-9:
            parts = [smaller]
        else:
            parts = _split(parts[0], limit, leading) or _split(smaller, limit, leading)
    target = max(min(width or 0.0, limit or 0.0), *map(_total, parts))
    blocks = [
        TablePart(part, _stretched(part, target), form.units, form.row_height) for part in parts
    ]
    body = Stack(blocks)
    if not title:
        return body
    return Stack([Line(typeset(title, height)), body], gap=2.0)


def _check(columns: Sequence[TableColumn]) -> None:
    counts = {len(column.values) for column in columns}
    if len(counts) != 1:
        text = ", ".join(f"{c.head}: {len(c.values)}" for c in columns) or "no columns"
        raise LayoutError("Cannot draw a table from columns of different lengths ({}).", text)


def _set_all(columns: Sequence[TableColumn], size: float) -> tuple[_Set, ...]:
    return tuple(_set_column(column, size) for column in columns)


def _set_column(column: TableColumn, size: float) -> _Set:
    """Typeset a column; with a width aimed at, try the smaller heights before it grows."""
    heights = smaller_heights(size) if column.width is not None else (size,)
    for height in heights:
        made = _set_at(column, height, in_use())
        if column.width is None or made.width <= column.width:
            break
    least = column.width if column.width is not None else column.min_width
    return replace(made, width=max(made.width, least))


@lru_cache(maxsize=1024)  # a sheet tries a table in many widths and arrangements
def _set_at(column: TableColumn, size: float, _lettering: OutlineLettering) -> _Set:
    values = tuple(typeset(cell.text, size) for cell in column.cells)
    head, unit = typeset(column.head, size), typeset(column.unit, size)
    signed = any(cell.sense is not None for cell in column.cells)
    sign = 1.4 * size if signed else 0.0
    tail = sign + _SENSE_GAP if signed else 0.0
    room = max((value.width for value in values), default=0.0)
    lefts = tuple(-(value.width + tail) / 2 for value in values)
    if all(re.match(_NUMBER, cell.text) for cell in column.cells):
        # Digits of one place are aligned under one another (GOST 2.105).
        wholes = [_integer_width(cell.text, size) for cell in column.cells]
        fractions = (v.width - w for v, w in zip(values, wholes, strict=True))
        room = max(wholes, default=0.0) + max(fractions, default=0.0)
        comma = max(wholes, default=0.0) - (room + tail) / 2
        lefts = tuple(comma - whole for whole in wholes)
    width = max(head.width, unit.width, room + tail) + 2 * _PAD
    sign_x = (room + tail) / 2 - sign / 2
    return _Set(column, head, unit, values, width, lefts, complex(sign_x, sign))


def _integer_width(number: str, size: float) -> float:
    return in_use().width(re.split("[., *]", number)[0], size)


def _total(part: Sequence[_Set]) -> float:
    return sum(column.width for column in part)


def _split(columns: tuple[_Set, ...], limit: float, leading: int) -> list[tuple[_Set, ...]]:
    """Cut into as few parts as the limit allows, of nearly equal width."""
    lead, room = columns[:leading], limit - _total(columns[:leading])
    rest: list[tuple[_Set, ...]] = []
    for column in columns[leading:]:
        together = rest.pop() if rest and column.source.joined else ()
        rest.append((*together, column))
    widest = max(map(_total, rest), default=0.0)
    if widest > room + 1e-9:
        raise LayoutError(
            "Cannot fit a table column of {:.1f} mm beside {:.1f} mm of leading columns "
            "into {:.1f} mm. Choose a larger paper format or fewer leading columns.",
            widest,
            limit - room,
            limit,
        )
    count = len(_filled(rest, room))
    tries = (widest + (room - widest) * k / 40 for k in range(40))
    even = next((w for w in tries if len(_filled(rest, w)) == count), room)
    return [(*lead, *part) for part in _filled(rest, even)]


def _filled(members: Sequence[tuple[_Set, ...]], space: float) -> list[tuple[_Set, ...]]:
    parts: list[tuple[_Set, ...]] = [()]
    for columns in members:
        if parts[-1] and _total(parts[-1]) + _total(columns) > space + 1e-9:
            parts.append(())
        parts[-1] += columns
    return parts


def _stretched(part: Sequence[_Set], target: float) -> tuple[float, ...]:
    """Return the column widths with spare width divided evenly."""
    spare = (target - _total(part)) / len(part)
    return tuple(column.width + spare for column in part)


def _line(start: complex, end: complex, pen: Pen = Pen.THIN) -> Stroke:
    return Stroke((start, end), pen, tag="table")


def _centred(text: Inscription, box: Bounds) -> list[Item]:
    middle = complex((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
    return text.at(middle - 1j * text.height / 2, anchor="centre", box=box)


def _value(column: _Set, row: int, box: Bounds) -> list[Item]:
    """Place a value and the sign of its sense."""
    value, cell = column.values[row], column.source.cells[row]
    middle = (box[0] + box[2]) / 2
    base = (box[1] + box[3] - value.height) / 2
    items = value.at(complex(middle + column.lefts[row], base), box=box)
    if cell.sense:
        centre = complex(middle + column.sign.real, base + value.height / 2)
        items += turn_sign(centre, column.sign.imag, cell.sense, tag="table")
    return items


TextNode: TypeAlias = Caption | Paragraph | DocumentItem | Note | Formula | Equations
"""Nodes of a text column; tables and figures are set by their own blocks."""


def blocks_of(
    nodes: Iterable[TextNode], height: float = 3.5, *, width: float | None = None
) -> Iterator[Block]:
    """Yield texts, formulas and equations as blocks, as wide as ``width`` mm at most."""
    for is_formula, group in groupby(nodes, lambda node: isinstance(node, Formula)):
        if is_formula:
            texts = [node.text for node in group if isinstance(node, Formula)]
            yield from formula_blocks(texts, height, width=width)
            continue
        for node in group:
            match node:
                case Caption(text):
                    yield heading(text, height)
                case Paragraph(text) | DocumentItem(text) | Note(text):
                    yield paragraph(text, height, width)
                case Equations(equations):
                    yield from (equation_block(one, height, width=width) for one in equations)
                case Formula():
                    pass  # grouped above
                case _:
                    assert_never(node)
