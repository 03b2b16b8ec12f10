"""The key for a terminal, for marking on paper, and as a workbook (ключ на экране и на бумаге)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from msgspec import Struct

from planmethod.check.key import Key
from planmethod.check.model import KeyEntry
from planmethod.check.pages.overlay import LETTERING
from planmethod.check.pages.remarks import (
    AnswerFormatter,
    displayed_value,
    place_letters,
    scale_letters,
    segment_letters,
    unsigned,
)
from planmethod.note.document import (
    Caption,
    Document,
    Item,
    Node,
    Note,
    Paragraph,
    Table,
    Title,
    plain_text,
    table_of_columns,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.pdf import pdf_document
from planmethod.note.writers.workbook import add_sheet, new_workbook, saved
from planmethod.plans.model import FACTS
from planmethod.render.backends.pdf import registered

UNSEEN = "*"
"""Sign of an answer that the drawing does not show, in cells too small for words."""


class KeyRow(Struct, frozen=True):
    """One variant in one position (строка ключа группы)."""

    key: Key
    position: int
    entries: Mapping[str, KeyEntry]


class KeyPage(Struct, frozen=True):
    """The key of a group in a language.

    Attributes
    ----------
    keys : tuple of Key
        Of one problem, one for each variant.
    language : Language
    """

    keys: tuple[Key, ...]
    language: Language

    @property
    def texts(self) -> MessageTable:
        """Words of the key."""
        key: MessageTable = self.language.check["key"]
        return key

    @property
    def formatter(self) -> AnswerFormatter:
        """Formatter of the numbers."""
        return AnswerFormatter(self.language)

    @property
    def title(self) -> Rich:
        """Heading, with the variant where there is one alone."""
        problem = self.keys[0].problem
        title = f"{self.texts.title}: {escape(problem.title or problem.name)}"
        if len(self.keys) == 1 and self.keys[0].variant:
            title += f". {self.texts.variant.format(variant=escape(self.keys[0].variant))}"
        return title

    def rows(self) -> list[KeyRow]:
        """Return variants and positions."""
        found: dict[tuple[int, int], dict[str, KeyEntry]] = {}
        for number, key in enumerate(self.keys):
            for entry in key.entries:
                found.setdefault((number, entry.position), {})[entry.label] = entry
        return [KeyRow(self.keys[number], at, entries) for (number, at), entries in found.items()]

    def scales(self) -> str:
        """Return the scales as a sentence, rich text: variants that have the same ones together.

        Empty for a problem without plans.
        """
        if not any(key.scales for key in self.keys):
            return ""
        whose: dict[str, list[str]] = {}
        for key in self.keys:
            whose.setdefault(format_scales(key.scales, self.language), []).append(key.variant or "")
        if len(whose) == 1:
            return self.texts.scales.format(scales=next(iter(whose)))
        parts = (f"{', '.join(names)}: {text}" for text, names in whose.items())
        return self.texts.scales.format(scales=". ".join(parts))

    def hidden(self) -> list[str]:
        """Return the mistakes that no answer shows, a line each: code, name, variants."""
        whose: dict[str, list[Key]] = {}
        for key in self.keys:
            for code in key.hidden:
                whose.setdefault(code, []).append(key)
        lines = []
        for code, keys in whose.items():
            known = self.language.check["mistakes"].get(code)
            found = {place for key in keys for place in key.hidden[code] if place}
            places = [place_letters(place) for place in sorted(found)]
            line = f"{code}: {known.name if known else code}"
            line += f" ({', '.join(places)})" if places else ""
            if len(keys) < len(self.keys):
                names = ", ".join(str(key.variant) for key in keys)
                line += f" — {self.texts.variant.format(variant=names)}"
            lines.append(line)
        return lines

    def note(self) -> str:
        """Return what the tolerance is."""
        if not any(key.scales for key in self.keys):
            return self.texts.computed
        return self.texts.note.format(unseen=self.texts.unseen)

    # Cells -------------------------------------------------------------------------------------

    def line(self, entry: KeyEntry) -> list[str]:
        """Return an answer as the cells of a row, rich text, see `MessageTable.columns`."""
        speech = self.formatter
        return [
            speech.letters(entry),
            speech.value(entry),
            speech.unit(entry),
            segment_letters(entry.segment) if entry.segment else "",
            "" if entry.mm is None else speech.mm(entry.mm, unit=False),
            speech.sense(entry.sense),
            speech.points(entry.points),
            self.texts.zero if entry.zero else "" if entry.is_visible else self.texts.unseen,
        ]

    def cell(self, entry: KeyEntry | None) -> tuple[str, str]:
        """Return an answer in two short lines: the value, and its segment and sense."""
        if entry is None:
            return "", ""
        speech = self.formatter
        mm = "" if entry.mm is None else speech.mm(entry.mm)
        sign = speech.sense(entry.sense)
        return (
            speech.value(entry) + ("" if entry.is_visible else UNSEEN),
            " ".join(part for part in (mm, sign) if part),
        )

    def head(self, entry: KeyEntry) -> str:
        """Return the head of an answer's column: its letters and unit."""
        unit = self.formatter.unit(entry)
        return f"{self.formatter.letters(entry)}, {unit}" if unit else self.formatter.letters(entry)

    def lead(self, row: KeyRow) -> str:
        """Return what a row begins with: variant, and position where there are several."""
        several = len({r.position for r in self.rows()}) > 1
        lead = [row.key.variant] if row.key.variant else []
        lead += [self.texts.position.format(position=row.position)] if several else []
        return ", ".join(lead) or "—"

    def columns(self) -> list[KeyEntry]:
        """Return the answers, one entry for each label, in the requested order."""
        found: dict[str, KeyEntry] = {}
        for row in self.rows():
            for label, entry in row.entries.items():
                found.setdefault(label, entry)
        return list(found.values())

    @property
    def has_unseen(self) -> bool:
        """True if the drawing does not show one of the answers."""
        return any(not entry.is_visible for key in self.keys for entry in key.entries)

    @property
    def is_single(self) -> bool:
        """True for one variant in one position."""
        return len(self.rows()) == 1


def format_scales(scales: Mapping[str, float], language: Language) -> str:
    """Return scales as rich text: ``μ_{v} = 0,05 (м/с)/мм``."""
    notation = language.notation
    units = {facts.scale: facts.unit for facts in FACTS.values()}
    shown = []
    millimetre = notation.units["mm"]
    for name, per_mm in scales.items():
        unit = notation.units.get(units.get(name, ""), "")
        of = f"({unit})" if "/" in unit or "·" in unit else unit
        value = notation.as_input(per_mm, zero_limit=0.0)
        shown.append(f"{scale_letters(name)} = {value} {of}/{millimetre}")
    return "; ".join(shown)


def key_document(keys: Sequence[Key], language: Language) -> Document:
    """Return the key as a document: one table, of several variants a row for each."""
    return Document.of(_nodes(KeyPage(tuple(keys), language)))


def key_pdf(keys: Sequence[Key], language: Language) -> bytes:
    """Return the key as PDF: a standing page for one variant, lying ones for several."""
    page = KeyPage(tuple(keys), language)
    return pdf_document(
        Document.of(_nodes(page)),
        language,
        title=plain_text(page.title),
        font=registered(LETTERING),
        wide=not page.is_single,
    )


def _nodes(page: KeyPage) -> Iterator[Node]:
    yield Title(page.title)
    if scales := page.scales():
        yield Paragraph(scales)
    if page.is_single:
        lines = tuple(tuple(page.line(entry)) for entry in page.keys[0].entries)
        yield Table(tuple(page.texts.columns), lines)
    else:
        yield table_of_columns(_columns(page), repeated=1)
        if page.has_unseen:
            yield Note(f"{UNSEEN} — {page.texts.unseen}.")
    yield Paragraph(page.note())
    if hidden := page.hidden():
        yield Caption(page.texts.hidden)
        yield from map(Item, hidden)


def _columns(page: KeyPage) -> Iterator[list[str]]:
    """Yield the columns of a group's table: variants, and each answer."""
    rows = page.rows()
    yield [page.texts["rows"][0], *(page.lead(row) for row in rows)]
    for entry in page.columns():
        cells = (page.cell(row.entries.get(entry.label)) for row in rows)
        yield [page.head(entry), *("; ".join(filter(None, cell)) for cell in cells)]


def key_xlsx(keys: Sequence[Key], language: Language) -> bytes:
    """Return the key as a workbook: a row for each answer of each variant."""
    page = KeyPage(tuple(keys), language)
    quantity, value, unit, segment, mm, sense, points, note = page.texts["columns"]
    exact, _, tolerance = value.partition(" ± ")
    header = [
        *page.texts["rows"], quantity, exact, f"± {tolerance}", unit, segment, mm, sense, points,
        note,
    ]  # fmt: skip
    rows = []
    for row in page.rows():
        for entry in row.entries.values():
            cells = [plain_text(cell) for cell in page.line(entry)]
            rows.append(
                [
                    row.key.variant,
                    row.position,
                    entry.label,
                    displayed_value(unsigned(entry), entry) / entry.per,
                    entry.tolerance / entry.per,
                    cells[2],
                    cells[3],
                    entry.mm,
                    cells[5],
                    entry.points,
                    cells[7],
                ]
            )
    book = new_workbook()
    formats = {3: "0.0000", 4: "0.0000", 7: "0.0", 9: "0.##"}
    add_sheet(book, page.texts.sheet, header, rows, formats=formats, frozen=3)
    if hidden := page.hidden():
        lines: list[list[Any]] = [[plain_text(line)] for line in hidden]
        add_sheet(book, page.texts.sheet_hidden, [page.texts.hidden], lines, frozen=0)
    return saved(book)
