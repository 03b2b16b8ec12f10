"""Tables of a document of Word: grids, widths of columns, rows together (таблицы Word)."""

# no messages: XML of Word

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from docx.enum.table import WD_TABLE_ALIGNMENT
from docx.oxml import OxmlElement, parse_xml
from docx.oxml.ns import nsdecls, qn
from docx.shared import Mm
from docx.table import _Cell

from planmethod.note.document import Table
from planmethod.note.formula import Rich
from planmethod.note.writers.wordpages import clean_text
from planmethod.note.writers.wordstyles import MM_PER_POINT

PAD = 4.0
"""White at the sides of a cell, mm."""

STRIP = 17.0
"""Height of the row that names the continued table, points."""

MAX_UNCUT_ROWS = 5
"""Rows, with the head, up to which a table is not cut between pages."""


def grid(file: Any, rows: int, widths: Sequence[float], style: Any = None) -> Any:
    """Return an empty table with columns of given widths, mm."""
    table = file.add_table(rows, len(widths))
    if style is not None:
        table.style = style
    table.autofit = False
    table.alignment = WD_TABLE_ALIGNMENT.CENTER
    for column, width in zip(table._tbl.tblGrid.gridCol_lst, widths, strict=True):
        column.w = Mm(width)
    for row in table._tbl.tr_lst:
        for cell, width in zip(row.tc_lst, widths, strict=True):
            cell.width = Mm(width)
    return table


def rows_of(table: Any) -> list[list[Any]]:
    """Return the cells of a table, row by row, none of them merged."""
    return [[_Cell(cell, table) for cell in row.tc_lst] for row in table._tbl.tr_lst]


def head_repeats(table: Any) -> None:
    """Repeat the head of a table on each page, and forbid cutting a row."""
    for k, row in enumerate(table._tbl.tr_lst):
        properties = row.get_or_add_trPr()
        properties.append(OxmlElement("w:cantSplit"))
        if not k:
            properties.append(OxmlElement("w:tblHeader"))


def strip_above(table: Any) -> _Cell:
    """Put a low row without lines above the head of a table, which repeats as the head does.

    Its text appears at the top of each page of the table, wherever Word cuts it; return its cell.
    """
    columns = len(table._tbl.tblGrid.gridCol_lst)
    row = OxmlElement("w:tr")
    properties = row.get_or_add_trPr()
    properties.append(OxmlElement("w:cantSplit"))
    height = OxmlElement("w:trHeight")
    height.set(qn("w:val"), str(round(20 * STRIP)))
    height.set(qn("w:hRule"), "exact")
    properties.append(height)
    properties.append(OxmlElement("w:tblHeader"))
    cell = row.add_tc()
    cell.width = sum(column.w for column in table._tbl.tblGrid.gridCol_lst)
    cell.grid_span = columns
    borders = OxmlElement("w:tcBorders")
    for side in ("top", "left", "right"):
        line = OxmlElement(f"w:{side}")
        line.set(qn("w:val"), "nil")
        borders.append(line)
    cell.get_or_add_tcPr().append(borders)
    table._tbl.tr_lst[0].addprevious(row)
    return _Cell(cell, table)


def cover(paragraph: Any, width: float) -> None:
    """Hide the strip below a paragraph of one point under a white area of a width in mm.

    The first page of the table has its name instead.
    """
    run = paragraph.add_run()._r
    run.append(
        parse_xml(
            f'<w:pict {nsdecls("w")} xmlns:v="urn:schemas-microsoft-com:vml">'
            '<v:rect style="position:absolute;margin-left:0;margin-top:0;'
            f"width:{width / MM_PER_POINT:.1f}pt;height:{STRIP:g}pt;z-index:1;"
            "mso-position-horizontal-relative:text;mso-position-vertical-relative:text"
            '" fillcolor="white" stroked="f"/></w:pict>'
        )
    )


def row_keeps_with_next(row: int, rows: int) -> bool:
    """Return whether a row stays with the next: no page has the head or a last row alone."""
    return row + 1 < rows and (rows <= MAX_UNCUT_ROWS or row < 2 or row == rows - 2)


# Widths of columns --------------------------------------------------------------------------------


def needed_widths(table: Table, size: float) -> list[float]:
    """Return the least widths of columns, mm: words are not cut."""
    em, columns = size * MM_PER_POINT, zip(table.head, *table.rows, strict=True)
    return [max(_widest(text, em) for text in column) + PAD for column in columns]


def _widest(rich: Rich, em: float) -> float:
    return max((0.58 * em * len(word) for word in clean_text(rich).split()), default=0.0)


def line_width(rich: Rich, em: float) -> float:
    """Return the approximate width of a text on one line, mm."""
    return 0.55 * em * len(clean_text(rich))


def fill_width(needed: Sequence[float], available: float) -> list[float]:
    """Return widths that fill the available width, in proportion to the needed ones."""
    total = sum(needed)
    return [width * available / total for width in needed]


def parts_of_width(table: Table, size: float, available: float) -> Iterator[Table]:
    """Yield a table cut between its columns, each part with the leading ones."""
    needed, lead = needed_widths(table, size), table.repeated
    start = lead
    while start < len(needed):
        end, width = start, sum(needed[:lead])
        while end < len(needed) and (end == start or width + needed[end] <= available):
            width += needed[end]
            end += 1
        rows = (row[:lead] + row[start:end] for row in (table.head, *table.rows))
        head, *others = rows
        yield Table(head, tuple(others), table.names, lead)
        start = end
