"""A document for a reader, as data; rich text made plain."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, assert_never

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.errors import LayoutError
from planmethod.languages import choose_language
from planmethod.note.formula import (
    SPECIAL,
    Fraction,
    Index,
    Letters,
    Node as FormulaNode,
    Overline,
    Rich,
    Root,
    inline,
    parse,
)
from planmethod.note.numbers import rich_number, significant, trimmed

if TYPE_CHECKING:
    from planmethod.note.wording import MessageTable


_REFERENCE = r"\\ref\{([^{}]*)\}"


class Title(Struct, frozen=True):
    """Name of the document (заглавие)."""

    text: Rich


class TitlePage(Struct, frozen=True):
    """First page of a note (титульный лист); the words between its data are the writers'.

    Attributes
    ----------
    organisation : tuple of Rich
        Line by line, the largest first: the university, the chair.
    work : Rich
        Kind of work: ``Пояснительная записка``.
    subject : Rich
        What it belongs to: ``к курсовому проекту по теории механизмов и машин``.
    title : Rich
        Its theme.
    designation : Rich
        Designation of the document, ``ТММ.01.00.00 ПЗ``.
    author, group, checker : Rich
        Who did the work, of which group, and who checks it.
    place, year : Rich
    """

    organisation: tuple[Rich, ...] = ()
    work: Rich = ""
    subject: Rich = ""
    title: Rich = ""
    designation: Rich = ""
    author: Rich = ""
    group: Rich = ""
    checker: Rich = ""
    place: Rich = ""
    year: Rich = ""


class Contents(Struct, frozen=True):
    """Headings of the document with their pages (содержание), under a heading of its own."""


class PageBreak(Struct, frozen=True):
    """A page break: the next node begins on a new page (разрыв страницы)."""


class StructuralHeading(Struct, frozen=True):
    """Heading without a number, in the middle (структурный элемент): introduction, conclusion.

    It begins a new page.
    """

    title: Rich


class Chapter(Struct, frozen=True):
    """Heading of a chapter (глава); writers number chapters and the parts in them.

    ``numbered``: False for one that stands by itself, as a position in the results.
    """

    title: Rich
    numbered: bool = True


class Part(Struct, frozen=True):
    """Heading of a part of a chapter (раздел)."""

    title: Rich


class Subpart(Struct, frozen=True):
    """Heading of a part of a part (подраздел)."""

    title: Rich


class Caption(Struct, frozen=True):
    """Name of a list or of a table that follows (подзаголовок)."""

    text: Rich


class GivenFact(Struct, frozen=True):
    """A given fact (данное): its text, and the keys of the problem file that it states.

    Attributes
    ----------
    text : Rich
    data : mapping of str to object
        Dotted keys of the problem file with their values in the text: m, degrees, SI units, words
        of the file. The problem can be rebuilt from all its facts (`tests/rebuilt.py`).
    """

    text: Rich
    data: Mapping[str, Any] = field(default_factory=dict)


class Paragraph(Struct, frozen=True):
    """Sentences (абзац); ``facts``: what they say is given, as data, which no writer prints."""

    text: Rich
    facts: tuple[GivenFact, ...] = ()


class Item(Struct, frozen=True):
    """One of several short statements that follow one another, a line each (пункт).

    ``label``: text before it in a column of its own, such as its share of the total.
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
    """A formula on a line of its own (формула).

    ``numbered``: whether it has a number in its chapter, ``(2.1)``, on the right; ``key`` is the
    name by which texts refer to that number.
    """

    text: Rich
    numbered: bool = False
    key: str = ""


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

    ``right`` is empty where the sum of the left side is zero; ``name`` is the name of such a sum,
    for writers that put it before the sum. ``number`` is its own number, if it has one.
    """

    left: tuple[Term, ...]
    right: tuple[Term, ...] = ()
    name: Rich = ""
    number: Rich = ""


class Equations(Struct, frozen=True):
    """Vector equations one under another (система уравнений), with one number as a formula's."""

    equations: tuple[Equation, ...]
    numbered: bool = False
    key: str = ""


class Table(Struct, frozen=True):
    """A table (таблица).

    Attributes
    ----------
    head : tuple of Rich
    rows : tuple of tuple of Rich
    names : int
        Number of columns from the left that name the row; the others are numbers.
    repeated : int
        Leading columns that are repeated before the rest of a table that is cut for its width; 0:
        it is not cut.
    right : tuple of int
        Columns of numbers among those that name.
    tones : tuple of str
        Kind of each row, such as the word of a verdict; a writer may colour the cell of column
        ``toned`` by it.
    name : Rich
        Where there is one, the table has a number: ``Таблица 1 – name`` above it.
    key : str
        Name by which texts refer to the number.
    """

    head: tuple[Rich, ...]
    rows: tuple[tuple[Rich, ...], ...]
    names: int = 1
    repeated: int = 0
    right: tuple[int, ...] = ()
    tones: tuple[str, ...] = ()
    toned: int = 0
    name: Rich = ""
    key: str = ""

    @property
    def numbers(self) -> frozenset[int]:
        """Columns that are set to the right."""
        return frozenset((*range(self.names, len(self.head)), *self.right))

    def columns(self) -> Iterator[tuple[Rich, tuple[Rich, ...]]]:
        """Yield the head and the cells of each column."""
        yield from zip(self.head, zip(*self.rows, strict=True), strict=True)


class DrawableView(Protocol):
    """A view that every writer of documents can draw (вид)."""

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

    def png(self, dpi: float) -> bytes:
        """Return a PNG file of the given resolution, dots per inch."""
        ...


class Figure(Struct, frozen=True):
    """A picture (рисунок) and its caption; writers of plain text give the caption alone.

    ``numbered``: whether the caption has a number, ``Рисунок 1 – caption``; ``key`` is the name by
    which texts refer to it.
    """

    view: DrawableView
    caption: Rich = ""
    numbered: bool = False
    key: str = ""


class References(Struct, frozen=True):
    """Numbered list of sources (список использованных источников), without its heading."""

    entries: tuple[Rich, ...]


class Note(Struct, frozen=True):
    """A remark on the node above (примечание)."""

    text: Rich


Node: TypeAlias = (
    Title
    | TitlePage
    | Contents
    | PageBreak
    | StructuralHeading
    | Chapter
    | Part
    | Subpart
    | Caption
    | Paragraph
    | Item
    | Step
    | Formula
    | Equations
    | Table
    | Figure
    | References
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

    def _repr_html_(self) -> str:
        """Return what a notebook shows, in the language of the environment, else in Russian."""
        from pkgutil import resolve_name

        # Writers are in a higher layer: this one is found by name, as public names are.
        shown: str = resolve_name("planmethod.note.writers.html:html_part")(
            self, choose_language(())
        )
        return shown


def numbers_of(written: Document) -> Iterator[tuple[Node, str]]:
    """Yield the nodes, each with its number: ``2``, ``2.1``, ``3``; empty where it has none.

    Chapters, figures and tables are counted through the document; parts and formulas in the
    chapter, subparts in the part.
    """
    chapter = part = subpart = formula = figure = table = 0
    for node in written.nodes:
        number = ""
        match node:
            case Chapter(numbered=numbered):
                chapter, part, subpart, formula = chapter + numbered, 0, 0, formula * (not numbered)
                number = str(chapter) if numbered else ""
            case Part():
                part, subpart = part + 1, 0
                number = f"{chapter}.{part}"
            case Subpart():
                subpart += 1
                number = f"{chapter}.{part}.{subpart}"
            case Formula(numbered=True) | Equations(numbered=True):
                formula += 1
                number = f"{chapter}.{formula}" if chapter else str(formula)
            case Figure(numbered=True):
                figure += 1
                number = str(figure)
            case Table() if node.name:
                table += 1
                number = str(table)
        yield node, number


def headings_of(written: Document) -> Iterator[tuple[int, str, Rich]]:
    """Yield what contents list: the level of a heading from 1 on, its number, its text."""
    for node, number in numbers_of(written):
        match node:
            case StructuralHeading(title) | Chapter(title):
                yield 1, number, title
            case Part(title):
                yield 2, number, title
            case Subpart(title):
                yield 3, number, title


def lines_of(page: TitlePage, words: Mapping[str, Any]) -> Iterator[Rich]:
    """Yield the lines of a title page for writers that have no pages."""
    yield from page.organisation
    yield from (text for text in (page.work, page.subject) if text)
    for key in ("title", "author", "group", "checker"):
        if text := getattr(page, key):
            yield words["theme" if key == "title" else key].format(**{key: text})
    yield from (
        text for text in (page.designation, " ".join((page.place, page.year))) if text.strip()
    )


# no messages: mistakes in a program
def resolve_references(written: Document) -> Document:
    r"""Return a document with its references ``\ref{key}`` replaced by numbers.

    Writers do that before they write. A text names the kind itself: ``на рисунке \ref{scheme}``,
    ``по формуле (\ref{speed})``.

    Raises
    ------
    LayoutError
        When nothing numbered has the key.
    """
    numbers = {
        node.key: number
        for node, number in numbers_of(written)
        if isinstance(node, Formula | Equations | Figure | Table) and node.key and number
    }

    def resolved(text: Rich) -> Rich:
        return re.sub(_REFERENCE, number, text) if "\\ref{" in text else text

    def number(reference: re.Match[str]) -> str:
        if reference[1] not in numbers:
            raise LayoutError(
                "A text refers to '{}', but no numbered formula, figure or table has that key. "
                "Keys: {}.",
                reference[1],
                ", ".join(numbers) or "–",
            )
        return numbers[reference[1]]

    nodes = list[Node]()
    for node in written.nodes:
        match node:
            case Paragraph() | Item() | Note() | Formula() | Caption():
                nodes.append(replace(node, text=resolved(node.text)))
            case Step(lines):
                nodes.append(replace(node, lines=tuple(map(resolved, lines))))
            case _:
                nodes.append(node)
    return Document(tuple(nodes))


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
    """Return a table of columns of head, unit and cells, with the unit in the head."""
    headed = ((f"{head}, {unit}" if unit else head, *cells) for head, unit, cells in columns)
    return table_of_columns(headed, repeated=repeated)


def step_of(lines: Sequence[Rich], *, continues: bool = False) -> Iterator[Step]:
    """Yield a step of the lines, if there are any."""
    if lines:
        yield Step(tuple(lines), continues)


def steps_of(sentences: Iterable[Rich]) -> Iterator[Step]:
    """Yield a step for each sentence."""
    for sentence in sentences:
        yield Step((sentence,))


def closed(lines: Sequence[Rich]) -> list[Rich]:
    """Return the parts of a list with semicolons between them and a full stop at the end."""
    return [*(f"{line};" for line in lines[:-1]), *(f"{line}." for line in lines[-1:])]


NO_BREAK = "\N{NO-BREAK SPACE}"
"""Space at which a line is not cut; the finished text has plain spaces."""

_SUPER = dict(zip("0123456789-−nkr", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁻ⁿᵏʳ", strict=True))
_SUB = dict(zip("0123456789", "₀₁₂₃₄₅₆₇₈₉", strict=True))
_RATIO = "U"
"""Above it stands the carrier that a ratio is seen from, ``U^{H}_{13}``: no power of it."""


def plain_text(rich: str) -> str:
    """Return rich text as plain: ``ω_{2}`` gives ``ω₂``, ``a^{n}_{CB}`` gives ``aⁿ_CB``.

    A letter that has no raised one, ``τ``, follows a sign: ``a^τ_CB``.
    """
    return _nodes_text(inline(parse(rich))) if any(c in SPECIAL for c in rich) else rich


def _nodes_text(nodes: Iterable[FormulaNode]) -> str:
    text = ""
    for node in nodes:
        text += _node_text(node, is_ratio=text.endswith(_RATIO))
    return text


def _node_text(node: FormulaNode, *, is_ratio: bool = False) -> str:
    match node:
        case Letters(text):
            return text
        case Index(below, above, is_power):
            low = _nodes_text(below)
            lowered = "".join(_SUB[c] for c in low) if set(low) <= set(_SUB) else f"_{low}"
            high = _nodes_text(above)
            high = f"({high})" if "/" in high and not high.startswith("(") else high  # t^(1/2)
            is_carrier = high.startswith("(") or (is_ratio and high.isalnum())
            is_said = is_carrier or any(c.isalpha() and c not in _SUPER for c in high)
            raised = f"^{high}" if is_said else "".join(_SUPER.get(c, c) for c in high)
            return lowered + raised if is_power else raised + lowered
        case Overline(body):
            return _nodes_text(body)
        case Fraction() | Root():
            raise AssertionError  # the formula is in one line
        case _:
            assert_never(node)


def localized(text: str, texts: MessageTable) -> str:
    """Return a number with a decimal point as the language writes it."""
    return plain_text(rich_number(text, texts.decimal))


def computed_text(value: float, texts: MessageTable) -> str:
    """Return a result, four significant digits."""
    return localized(significant(value), texts)


def input_text(value: float, texts: MessageTable, digits: int | None = None) -> str:
    """Return a given number, no more digits than it has."""
    return localized(trimmed(value, digits), texts)


def fixed(value: float, texts: MessageTable, places: int = 2) -> str:
    """Return a number with ``places`` digits after the decimal sign."""
    return localized(f"{value + 0.0:.{places}f}", texts)
