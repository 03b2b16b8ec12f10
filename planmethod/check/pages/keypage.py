"""The key for a terminal, for a red pencil, and as a workbook (ключ на экране и на бумаге)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from planmethod.check.key import Key
from planmethod.check.model import KeyEntry
from planmethod.check.pages.keytable import UNSEEN, KeyPage
from planmethod.check.pages.pdf import NOTE, TEXT, Document
from planmethod.check.pages.speech import told
from planmethod.check.pages.workbook import add_sheet, new_workbook, saved
from planmethod.note.plaintext import NO_BREAK, columns_text, heading, plain_text, wrap
from planmethod.note.plaintext import table as text_table
from planmethod.note.wording.language import Language

SINGLE = (22.0, 36.0, 17.0, 21.0, 15.0, 14.0, 15.0, 46.0)
"""Widths of the columns of one variant, mm."""

WIDE = 273.0

COLUMN = 34.0
LEAD = 20.0


def key_text(keys: Sequence[Key], words: Language) -> str:
    """Return the key for a terminal."""
    page = KeyPage(tuple(keys), words)
    lines = heading(plain_text(page.title), "═")
    lines += [*wrap(plain_text(page.scales())), ""]
    if page.is_single:
        rows = [[plain_text(cell) for cell in page.line(e)] for e in page.keys[0].entries]
        lines += text_table(page.say.columns, rows)
    else:
        rows_of = page.rows()
        columns = [[page.say.rows[0], *(page.lead(row) for row in rows_of)]]
        for entry in page.columns():
            cells = [
                "; ".join(filter(None, page.cell(row.entries.get(entry.label)))) for row in rows_of
            ]
            columns.append([plain_text(page.head(entry)), *map(plain_text, cells)])
        lines += columns_text(columns, 1)
        lines += [f"{UNSEEN} — {page.say.unseen}."] if page.has_unseen else []
    lines += ["", *wrap(plain_text(page.note()))]
    if hidden := page.hidden():
        lines += ["", page.say.hidden]
        lines += [
            part for line in hidden for part in wrap(plain_text(line), first="  ", rest="    ")
        ]
    return "\n".join(line.replace(NO_BREAK, " ") for line in lines) + "\n"


def key_pdf(keys: Sequence[Key], words: Language) -> bytes:
    """Return the key as PDF: a standing page for one variant, lying ones for several."""
    page = KeyPage(tuple(keys), words)
    pdf = Document(plain_text(page.title), wide=not page.is_single)
    pdf.paragraph(page.title, 14.0)
    pdf.paragraph(page.scales(), NOTE)
    pdf.gap(4.0)
    if page.is_single:
        rows = [page.line(entry) for entry in page.keys[0].entries]
        pdf.table(page.say.columns, rows, SINGLE, right=(4,), size=TEXT)
    else:
        for part in _parts(page):
            pdf.table(*_matrix(page, part), size=NOTE)
            pdf.gap(5.0)
        if page.has_unseen:
            pdf.paragraph(f"{UNSEEN} — {page.say.unseen}.", NOTE)
    pdf.gap(3.0)
    pdf.paragraph(page.note(), NOTE)
    if hidden := page.hidden():
        pdf.heading(page.say.hidden)
        pdf.listed(hidden, NOTE)
    return pdf.close()


def _parts(page: KeyPage) -> Iterator[list[KeyEntry]]:
    """Cut the columns into tables that fit on a lying page, about as wide as each other."""
    columns = page.columns()
    most = int((WIDE - LEAD) // COLUMN)
    tables = -(-len(columns) // most)
    size = -(-len(columns) // max(1, tables))
    for start in range(0, len(columns), size):
        yield columns[start : start + size]


def _matrix(
    page: KeyPage, columns: Sequence[KeyEntry]
) -> tuple[list[str], list[list[str]], list[float]]:
    """Return head, rows and widths of a table with a column for each answer."""
    rows = []
    for row in page.rows():
        cells = [page.cell(row.entries.get(entry.label)) for entry in columns]
        rows.append([page.lead(row), *("; ".join(filter(None, cell)) for cell in cells)])
    width = min(48.0, (WIDE - LEAD) / len(columns))
    header = [page.say.rows[0], *(page.head(entry) for entry in columns)]
    return header, rows, [LEAD, *[width] * len(columns)]


def key_xlsx(keys: Sequence[Key], words: Language) -> bytes:
    """Return the key as a workbook: a row for each answer of each variant."""
    page = KeyPage(tuple(keys), words)
    quantity, value, unit, segment, mm, sense, points, note = page.say.columns
    exact, _, tolerance = value.partition(" ± ")
    header = [
        *page.say.rows, quantity, exact, f"± {tolerance}", unit, segment, mm, sense, points, note,
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
                    told(entry.exact, entry) / entry.per,
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
    add_sheet(book, page.say.sheet, header, rows, formats=formats, frozen=3)
    if hidden := page.hidden():
        lines: list[list[Any]] = [[plain_text(line)] for line in hidden]
        add_sheet(book, page.say.sheet_hidden, [page.say.hidden], lines, frozen=0)
    return saved(book)
