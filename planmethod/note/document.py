"""A document: what a person reads, as data (документ).

Every kind of problem makes documents of these nodes; the writers of `planmethod.note.writers`, the
blocks of sheets and the pages of checking print them. Nothing here knows of pens, of line widths
or of a file format. Texts are rich text (`planmethod.note.formula`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, Protocol, TypeAlias

from msgspec import Struct

from planmethod.note.formula import Rich


class Title(Struct, frozen=True):
    """Name of the document (заглавие)."""

    text: Rich


class Chapter(Struct, frozen=True):
    """Heading of a chapter (глава); writers number chapters and the parts in them.

    ``numbered``: False for one that stands by itself, as a position in the results.
    """

    title: Rich
    numbered: bool = True


class Part(Struct, frozen=True):
    """Heading of a part of a chapter (раздел)."""

    title: Rich


class Caption(Struct, frozen=True):
    """Name of a list or of a table that follows (подзаголовок)."""

    text: Rich


class Paragraph(Struct, frozen=True):
    """Sentences (абзац)."""

    text: Rich


class Item(Struct, frozen=True):
    """One of several short statements that follow one another, a line each (пункт).

    ``label``: what stands before it in a column of its own, as its share of the whole.
    """

    text: Rich
    label: Rich = ""


class Step(Struct, frozen=True):
    """A step of a construction or of a calculation (шаг): sentences and formulas.

    Steps are numbered through the whole document; one that ``continues`` belongs to the last.
    """

    lines: tuple[Rich, ...]
    continues: bool = False


class Formula(Struct, frozen=True):
    """A formula on a line of its own (формула)."""

    text: Rich


class Term(Struct, frozen=True):
    """A term of a vector equation (член уравнения).

    Attributes
    ----------
    symbol : Rich
        Without the bar or the arrow of a vector: a writer knows how vectors are marked.
    underlines : int
        How much of it is known: its direction alone (1), or its magnitude, too (2).
    direction : Rich
        Written below it: ``⊥ BC``.
    """

    symbol: Rich
    underlines: int = 0
    direction: Rich = ""


class Equation(Struct, frozen=True):
    """A vector equation (векторное уравнение): sums of terms on both sides of the sign ``=``.

    ``right`` is empty where the sum of the left side is nothing; ``name`` is what such a sum is
    called, for writers that put it before the sum.
    """

    left: tuple[Term, ...]
    right: tuple[Term, ...] = ()
    name: Rich = ""


class Equations(Struct, frozen=True):
    """Vector equations one under another (система уравнений)."""

    equations: tuple[Equation, ...]


class Table(Struct, frozen=True):
    """A table (таблица).

    Attributes
    ----------
    head : tuple of Rich
    rows : tuple of tuple of Rich
    names : int
        Columns from the left that name what stands in the row; the others are numbers.
    repeated : int
        Leading columns that stand again before the rest of a table that is cut for its width; 0: it
        is not cut.
    right : tuple of int
        Columns of numbers among those that name.
    tones : tuple of str
        What a row says, where it is one of a few kinds: the word of a verdict; a writer may give
        the cell of column ``toned`` a ground by it.
    """

    head: tuple[Rich, ...]
    rows: tuple[tuple[Rich, ...], ...]
    names: int = 1
    repeated: int = 0
    right: tuple[int, ...] = ()
    tones: tuple[str, ...] = ()
    toned: int = 0

    @property
    def numbers(self) -> frozenset[int]:
        """Columns that are set to the right."""
        return frozenset((*range(self.names, len(self.head)), *self.right))

    def columns(self) -> Iterator[tuple[Rich, tuple[Rich, ...]]]:
        """Yield the head and the cells of each column."""
        yield from zip(self.head, zip(*self.rows, strict=True), strict=True)


class DrawableView(Protocol):
    """What can be drawn wherever a document is written (вид)."""

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, mm."""
        ...

    def svg(self) -> str:
        """Return an SVG element."""
        ...

    def draw(self, canvas: Any) -> None:
        """Draw on a canvas of reportlab whose unit is the millimetre, the lower left at zero."""
        ...


class Figure(Struct, frozen=True):
    """A picture (рисунок) and its caption; writers of plain text give the caption alone."""

    view: DrawableView
    caption: Rich = ""


class Note(Struct, frozen=True):
    """A remark to what stands above (примечание)."""

    text: Rich


Node: TypeAlias = (
    Title
    | Chapter
    | Part
    | Caption
    | Paragraph
    | Item
    | Step
    | Formula
    | Equations
    | Table
    | Figure
    | Note
)
"""Closed union: a writer matches it and ends in `assert_never`, so mypy names what it forgot."""


class Document(Struct, frozen=True):
    """Nodes in reading order."""

    nodes: tuple[Node, ...]

    @classmethod
    def of(cls, nodes: Iterable[Node]) -> Document:
        """Return a document of nodes."""
        return cls(tuple(nodes))


def table_of(head: Sequence[Rich], rows: Iterable[Sequence[Rich]], *, names: int = 1) -> Table:
    """Return a table of rows."""
    return Table(tuple(head), tuple(tuple(row) for row in rows), names)


def table_of_columns(columns: Iterable[Sequence[Rich]], *, repeated: int) -> Table:
    """Return a table of columns, the head of each first; it may be cut between them."""
    head, *rows = zip(*columns, strict=True)
    return Table(head, tuple(rows), 0, repeated)


def table_of_quantities(
    columns: Iterable[tuple[Rich, Rich, Sequence[Rich]]], *, repeated: int
) -> Table:
    """Return a table of columns of head, unit and cells: the unit stands in the head."""
    headed = ((f"{head}, {unit}" if unit else head, *cells) for head, unit, cells in columns)
    return table_of_columns(headed, repeated=repeated)


def step_of(lines: Sequence[Rich], *, continues: bool = False) -> Iterator[Step]:
    """Yield a step of lines; none where there is no line."""
    if lines:
        yield Step(tuple(lines), continues)


def steps_of(sentences: Iterable[Rich]) -> Iterator[Step]:
    """Yield a step for each sentence."""
    for sentence in sentences:
        yield Step((sentence,))
