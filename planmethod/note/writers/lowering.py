"""A document lowered to the few nodes that writers set (узлы вывода).

Kinds of node that are compositions of others become them here, once for all writers: numbers of
headings, steps, formulas and sources, references to them, captions, the lines of a title page,
what must stay with the next node.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum
from itertools import zip_longest
from typing import TypeAlias, assert_never

from msgspec import Struct, field

from planmethod.note import document
from planmethod.note.document import Document, DrawableView, Equation, PageBreak, Table
from planmethod.note.formula import Node as FormulaNode, Rich, parse
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.formulas import (
    SentencePart,
    pieces,
    sole_formula,
    units_of,
    without_control_characters,
)


class TextKind(Enum):
    """Kind of a text, which determines how it is set (вид текста)."""

    PARAGRAPH = "paragraph"
    CAPTION = "caption"
    ITEM = "item"
    STEP = "step"
    SOURCE = "source"
    NOTE = "note"


class Cover(Struct, frozen=True):
    """Title page (титульный лист), its lines as they are printed.

    Attributes
    ----------
    title : Rich
        The theme.
    organisation : tuple of Rich
        Above.
    work : Rich
        In large letters.
    subject : tuple of Rich
        Below the work.
    designation : Rich
    signatures : tuple of Rich
        Author, group, checker.
    footer : Rich
        Place and year.
    """

    title: Rich
    organisation: tuple[Rich, ...]
    work: Rich
    subject: tuple[Rich, ...]
    designation: Rich
    signatures: tuple[Rich, ...]
    footer: Rich

    @property
    def lines(self) -> Iterator[Rich]:
        """Lines from above, for writers that have no pages."""
        last = (self.designation, self.footer)
        lines = (*self.organisation, self.work, *self.subject, *self.signatures, *last)
        return (line for line in lines if line)


class Heading(Struct, frozen=True):
    """Heading (заголовок): of the document (level 0), a chapter (1), its parts (2, 3).

    ``is_structural``: in the middle of a new page, as an introduction is.
    """

    text: Rich
    level: int
    number: str = ""
    is_structural: bool = False

    @property
    def numbered_text(self) -> Rich:
        """The text behind its number."""
        return f"{self.number} {self.text}" if self.number else self.text


class Text(Struct, frozen=True):
    """Lines of a text (текст); several have only steps.

    Attributes
    ----------
    lines : tuple of Rich
    kind : TextKind
    mark : Rich
        Number of a step or a source, label of an item; empty where a step continues.
    introduces_next : bool
        It must stay with the next node.
    """

    lines: tuple[Rich, ...]
    kind: TextKind
    mark: Rich = ""
    introduces_next: bool = False

    @property
    def text(self) -> Rich:
        """All lines as one."""
        return " ".join(self.lines)


class DisplayedFormula(Struct, frozen=True):
    """A formula on a line of its own, with the number beside it."""

    text: Rich
    number: str = ""


class DisplayedEquations(Struct, frozen=True):
    """Vector equations one under another, with the number beside them."""

    equations: tuple[Equation, ...]
    number: str = ""


class NamedTable(Struct, frozen=True):
    """A table with its name (with the number), and the line above its continuation."""

    table: Table
    name: Rich = ""
    continuation: Rich = ""


class NamedFigure(Struct, frozen=True):
    """A picture with its caption, and with its name: the caption behind the number."""

    view: DrawableView
    caption: Rich = ""
    name: Rich = ""


class ContentsList(Struct, frozen=True):
    """Contents (содержание): their own heading, and the headings that they list."""

    title: Rich
    headings: tuple[Heading, ...]


LoweredNode: TypeAlias = (
    Cover
    | Heading
    | Text
    | DisplayedFormula
    | DisplayedEquations
    | NamedTable
    | NamedFigure
    | ContentsList
    | PageBreak
)
"""Closed union: a writer matches it and ends in `assert_never`, so mypy names what it forgot."""


class LoweredDocument(Struct, frozen=True):
    """Nodes of a document as writers set them, in reading order.

    Attributes
    ----------
    nodes : tuple of LoweredNode
    units : frozenset of str
        Letters of units in the language of the document.
    is_note : bool
        It has a title page or contents.
    sentences : dict
        Sentences that were divided (`divide`).
    """

    nodes: tuple[LoweredNode, ...]
    units: frozenset[str]
    is_note: bool
    sentences: dict[tuple[Rich, bool], list[SentencePart]] = field(default_factory=dict)

    @property
    def title(self) -> Rich:
        """Title for the properties of a file; empty without one."""
        for node in self.nodes:
            match node:
                case Cover(title=title, work=work):
                    return title or work
                case Heading(text, 0):
                    return text
                case _:
                    pass
        return ""

    def divide(self, text: Rich, *, symbols: bool = False) -> list[SentencePart]:
        """Return a sentence as words and formulas in turn (`pieces`), divided once."""
        found = self.sentences.get((text, symbols))
        if found is None:
            found = pieces(parse(without_control_characters(text)), self.units, symbols=symbols)
            self.sentences[text, symbols] = found
        return found


def kind_of(node: LoweredNode) -> tuple[type[LoweredNode], TextKind | None]:
    """Return the kind of a node, and of a text: consecutive ones of a kind may form a list."""
    return type(node), node.kind if isinstance(node, Text) else None


def lower(written: Document | LoweredDocument, language: Language) -> LoweredDocument:
    """Return a document in the nodes that writers set.

    A document that several writers take is lowered once, so that its sentences are divided once.

    Raises
    ------
    LayoutError
        A text refers to a missing key.
    """
    if isinstance(written, LoweredDocument):
        return written
    written = document.resolve_references(written)
    is_note = any(isinstance(n, document.TitlePage | document.Contents) for n in written.nodes)
    nodes = tuple(_lower_nodes(written, language.document, is_note=is_note))
    return LoweredDocument(nodes, units_of(language.note["units"]), is_note)


def _lower_nodes(written: Document, texts: MessageTable, *, is_note: bool) -> Iterator[LoweredNode]:
    step = 0
    after_each = zip_longest(document.numbers_of(written), written.nodes[1:])
    for (node, number), after in after_each:
        leads = _introduces_next_node(node, after)
        match node:
            case document.Title(text):
                yield Heading(text, 0)
            case document.TitlePage():
                yield _cover(node, texts)
            case document.Contents():
                headings = (
                    Heading(text, level, number)
                    for level, number, text in document.headings_of(written)
                )
                yield ContentsList(texts.contents, tuple(headings))
            case PageBreak():
                yield node
            case document.StructuralHeading(title):
                step = 0
                yield Heading(title, 1, is_structural=True)
            case document.Chapter(title):
                step = 0 if is_note else step
                yield Heading(title, 1, number)
            case document.Part(title):
                step = 0 if is_note else step
                yield Heading(title, 2, number)
            case document.Subpart(title):
                yield Heading(title, 3, number)
            case document.Caption(text):
                yield Text((text,), TextKind.CAPTION)
            case document.Paragraph(text):
                yield Text((text,), TextKind.PARAGRAPH, introduces_next=leads)
            case document.Item(text, label):
                yield Text((text,), TextKind.ITEM, label, leads)
            case document.Step(lines, continues):
                step += not continues
                yield Text(lines, TextKind.STEP, "" if continues else str(step), leads)
            case document.Formula(text):
                yield DisplayedFormula(text, number)
            case document.Equations(equations) if any(one.number for one in equations):
                yield from (DisplayedEquations((one,), one.number) for one in equations)
            case document.Equations(equations):
                yield DisplayedEquations(equations, number)
            case Table(name=name):
                title = texts.table.format(number=number, text=name) if name else ""
                again = texts.continued.format(number=number) if name else ""
                yield NamedTable(node, title, again)
            case document.Figure(view, caption):
                name = texts.figure.format(number=number, text=caption) if number else caption
                yield NamedFigure(view, caption, name)
            case document.References(entries):
                for k, entry in enumerate(entries, 1):
                    yield Text((entry,), TextKind.SOURCE, str(k))
            case document.Note(text):
                yield Text((text,), TextKind.NOTE)
            case _:
                assert_never(node)


def _cover(page: document.TitlePage, texts: MessageTable) -> Cover:
    theme = texts.theme.format(title=page.title) if page.title else ""
    signatures = (
        texts[key].format(**{key: text})
        for key in ("author", "group", "checker")
        if (text := getattr(page, key))
    )
    return Cover(
        page.title,
        page.organisation,
        page.work,
        tuple(text for text in (page.subject, theme) if text),
        page.designation,
        tuple(signatures),
        " ".join(filter(None, (page.place, page.year))),
    )


def _introduces_next_node(node: document.Node, after: document.Node | None) -> bool:
    """Return whether the text of a node introduces the next node, and must stay with it."""
    match node:
        case document.Paragraph(text) | document.Item(text):
            last = text
        case document.Step(lines):
            last = lines[-1]
        case _:
            return False
    if after is None:
        return False
    return isinstance(after, document.Formula | document.Equations) or last.endswith(":")


# Pages --------------------------------------------------------------------------------------------


class StepPart(Struct, frozen=True):
    """A line of a step on pages (строка шага): a text, or a formula for a line of its own."""

    text: Rich
    formula: tuple[FormulaNode, ...] = ()
    introduces_next: bool = False


def step_parts(step: Text, written: LoweredDocument) -> Iterator[StepPart]:
    """Yield the lines of a step, its number before the first; one that is a formula alone as such.

    The first line stays a text, as it has the number.
    """
    alone = [sole_formula(written.divide(line)) for line in step.lines]
    for k, line in enumerate(step.lines):
        if k and alone[k]:
            yield StepPart(line, alone[k])
            continue
        lead = "" if k or not step.mark else f"{step.mark})\u00a0"
        is_last = k + 1 == len(step.lines)
        leads = step.introduces_next if is_last else bool(alone[k + 1]) or line.endswith(":")
        yield StepPart(f"{lead}{line}", introduces_next=leads)


def marked_text(node: Text) -> Rich:
    """Return a text of pages behind its mark: a paragraph, an item, a source."""
    if node.kind is TextKind.ITEM:
        return f"{node.mark}\u2002{node.text}" if node.mark else f"–\u00a0{node.text}"
    return f"{node.mark}.\u00a0{node.text}" if node.mark else node.text
