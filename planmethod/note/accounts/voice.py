"""The voice of an account: how sentences, formulas and tables become nodes (голос изложения).

An account describes a subject in sections. A section calls the methods of a `Voice`, which yield
nodes. The voice decides form, not content. In a note there are sentences, displayed formulas, named
tables and figures; in a protocol the same sentences are numbered steps; results and sheets have
only formulas and results, each on a line.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import Enum
from itertools import repeat
from typing import TypeAlias, assert_never

from msgspec import Struct

from planmethod.note.document import (
    Caption,
    Figure,
    Formula,
    Item,
    Node,
    Paragraph,
    Part,
    Step,
    Table,
    closed,
    table_of_quantities,
)
from planmethod.note.formula import Rich, inlined

Columns: TypeAlias = Iterable[tuple[Rich, Rich, Sequence[Rich]]]
"""Head, unit and cells of each column."""

_POINTS = re.compile(r"(?<![_{\w\\])(?=[A-Z]+\d)(?:[A-Z]\d*)++(?![\w}])")
"""Names of points with numbers, outside an index."""


def lettered(text: Rich) -> Rich:
    """Return rich text in which the number of a point is an index: ``O1A`` gives ``O_{1}A``."""
    return _POINTS.sub(lambda found: re.sub(r"\d+", r"_{\g<0>}", found[0]), text)


def sentences(*texts: Rich) -> Paragraph:
    """Return a paragraph of the non-empty sentences."""
    # In a line of text a built-up fraction would push the lines apart.
    return Paragraph(lettered(" ".join(inlined(text) for text in texts if text)))


def displayed(text: Rich, key: str = "") -> Formula:
    """Return a formula with a number."""
    return Formula(text, numbered=True, key=key)


def chain(lines: Iterable[Rich]) -> list[Formula]:
    """Return formulas one after another: semicolons between them, a full stop at the end."""
    return [Formula(text) for text in closed(list(lines))]


class VoiceForm(Enum):
    """Kind of document that an account is written for."""

    NOTE = "note"
    STEPS = "steps"
    ITEMS = "items"
    SHEET = "sheet"


class Voice(Struct, frozen=True):
    """Form of an account (голос).

    Attributes
    ----------
    form : VoiceForm
    illustrate : callable or None
        Returns the figure of a key with a caption. None: figures are left out.
    """

    form: VoiceForm
    illustrate: Callable[[str, Rich], Figure] | None = None

    @property
    def is_note(self) -> bool:
        """Whether tables and figures have numbers, which sentences refer to."""
        return self.form is VoiceForm.NOTE

    def reference(self, template: str, key: str) -> Rich:
        """Return a reference to a table or a figure, after a blank; empty outside a note."""
        return f" {template.format(key=key)}" if self.is_note else ""

    def part(self, title: Rich) -> Iterator[Node]:
        """Yield the heading of a section of a note or of a protocol, the name of one of a sheet."""
        if self.form in (VoiceForm.NOTE, VoiceForm.STEPS):
            yield Part(title)
        elif self.form is VoiceForm.SHEET:
            yield Caption(title)

    def statement(
        self,
        text: Rich,
        formulas: Sequence[Rich] = (),
        *,
        closing: Rich = "",
        numbered: bool = False,
        key: str = "",
    ) -> Iterator[Node]:
        """Yield a sentence and the formulas it leads to; in results and on sheets these alone.

        Parameters
        ----------
        text : Rich
        formulas : sequence of Rich
        closing : Rich
            End of the sentence after the formulas, which says what their letters are.
        numbered : bool
            Whether formulas have numbers in a note.
        key : str
            Of the last formula.
        """
        lines = [f"{line}," for line in formulas] if closing else closed(formulas)
        match self.form:
            case VoiceForm.NOTE:
                yield sentences(text)
                keys = ["" for _ in lines[1:]] + [key]
                yield from (Formula(*one) for one in zip(lines, repeat(numbered), keys))
                if closing:
                    yield sentences(closing)
            case VoiceForm.STEPS:
                lead = f"{text}:" if formulas and text[-1] not in ".:" else text
                yield Step((lead, *lines, *filter(None, [closing])))
            case VoiceForm.ITEMS:
                yield from map(Item, formulas)
            case VoiceForm.SHEET:
                yield from map(Formula, formulas)
            case _:
                assert_never(self.form)

    def results(self, *texts: Rich) -> Iterator[Node]:
        """Yield sentences that state results, each with a full stop; empty ones are left out."""
        stated = [text for text in texts if text]
        if not stated:
            return
        match self.form:
            case VoiceForm.NOTE:
                yield sentences(*stated)
            case VoiceForm.STEPS:
                yield Step(tuple(stated))
            case VoiceForm.ITEMS:
                yield from (Item(text.removesuffix(".")) for text in stated)
            case VoiceForm.SHEET:
                yield from (Paragraph(text.removesuffix(".")) for text in stated)
            case _:
                assert_never(self.form)

    def table(self, columns: Columns, name: Rich, key: str, *, repeated: int) -> Iterator[Node]:
        """Yield a table of quantities with its name; ``repeated`` columns name its rows."""
        table = table_of_quantities(columns, repeated=repeated)
        if self.is_note:
            yield Table(table.head, table.rows, 1, repeated, name=name, key=key)
        else:
            yield from (Caption(name), table)

    def figure(self, key: str, caption: Rich, text: Rich = "") -> Iterator[Node]:
        """Yield a figure after the sentence that refers to it, where there are figures."""
        if self.illustrate is not None:
            if text:
                yield sentences(text)
            yield self.illustrate(key, caption)


NOTE, STEPS, ITEMS, SHEET = map(Voice, VoiceForm)
"""Voices of a note without figures, of a protocol, of results, and of a sheet."""
