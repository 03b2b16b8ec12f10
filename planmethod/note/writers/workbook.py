"""Workbooks with the same bytes for the same content (книги XLSX)."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from io import BytesIO
from typing import TYPE_CHECKING, Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from msgspec import Struct

if TYPE_CHECKING:
    from openpyxl import Workbook

_CLOCK = rb"(<dcterms:(?:created|modified)[^>]*>)[^<]*"
_CONTROL = "[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]"
LONGEST = 1000
WIDEST, NUMBER = 60, 7
"""Letters in the widest column, and in a number."""

LINE = 15.0
"""Height of a line, points."""


class Filled(Struct, frozen=True):
    """A cell with a ground: its value, and the colour as RRGGBB."""

    value: Any
    colour: str


def new_workbook() -> Workbook:
    """Return a workbook without sheets."""
    from openpyxl import Workbook

    book = Workbook()
    book.remove(book.active)
    return book


def add_sheet(
    book: Workbook,
    title: str,
    header: Sequence[str],
    rows: Sequence[Sequence[Any]],
    *,
    formats: Mapping[int, str] | None = None,
    frozen: int = 1,
    row: int = 1,
) -> Any:
    """Write a table into a sheet, which is made where there is none of its name.

    Parameters
    ----------
    rows : sequence of sequences
        Numbers, texts, None, or `Filled`. A text is never a formula.
    formats : mapping of int to str
        Number formats of columns, counted from 0.
    frozen : int
        Columns that stay in sight, with the head of a table in the first row.
    row : int
        Of the head.
    """
    sheet = book[title] if title in book.sheetnames else book.create_sheet(title)
    looks = _CellStyles(sheet)
    for column, text in enumerate(header, 1):
        looks.write(row, column, text, colour="EEEEEE", bold=True)
    for down, values in enumerate(rows, row + 1):
        for column, value in enumerate(values, 1):
            form = (formats or {}).get(column - 1, "General")
            if isinstance(value, Filled):
                looks.write(down, column, value.value, colour=value.colour, form=form)
            elif value is not None and value != "":
                looks.write(down, column, value, form=form)
    _widen(sheet, header, rows, row)
    if row == 1:
        sheet.freeze_panes = sheet.cell(2, frozen + 1)
        sheet.page_setup.orientation, sheet.page_setup.paperSize = "landscape", 9
        sheet.page_setup.fitToWidth, sheet.page_setup.fitToHeight = 1, 0
        sheet.sheet_properties.pageSetUpPr.fitToPage = True
        sheet.print_title_rows = "1:1"
    else:
        sheet.print_title_rows = None  # a page of one table would have the head of the other
    return sheet


def add_bars(
    sheet: Any,
    title: str,
    columns: tuple[int, int],
    rows: tuple[int, int],
    corner: str,
    *,
    lying: bool = False,
) -> None:
    """Add a picture of bars to a sheet.

    Parameters
    ----------
    columns : (int, int)
        Columns of the labels under the bars, and of their lengths, from 1.
    rows : (int, int)
        The head of a table and its last row.
    corner : str
        Cell of the upper left corner.
    lying : bool
        Bars from left to right, the first at the top; else from below.
    """
    from openpyxl.chart import BarChart, Reference

    chart = BarChart()
    chart.type, chart.title, chart.legend = "bar" if lying else "col", title, None
    head, last = rows
    names, lengths = columns
    chart.add_data(Reference(sheet, lengths, head, lengths, last), titles_from_data=True)
    chart.set_categories(Reference(sheet, names, head + 1, names, last))
    chart.gapWidth, chart.height = 40, 5.0
    chart.x_axis.delete = chart.y_axis.delete = False
    chart.y_axis.scaling.min = 0
    if lying:
        chart.x_axis.scaling.orientation = "maxMin"
        chart.y_axis.scaling.max = 1
        chart.height = max(5.0, 0.55 * (last - head))  # cm
    sheet.add_chart(chart, corner)


class _CellStyles:
    """Puts values into the cells of a sheet; every style is made once, since that is slow."""

    def __init__(self, sheet: Any) -> None:
        self._sheet = sheet
        self._made: dict[tuple[Any, ...], Any] = {}

    def write(
        self,
        row: int,
        column: int,
        value: Any,
        *,
        colour: str = "",
        form: str = "General",
        bold: bool = False,
    ) -> None:
        """Put a value into a cell."""
        if isinstance(value, float) and not math.isfinite(value):
            return  # no workbook holds it
        cell = self._sheet.cell(row, column)
        is_text = isinstance(value, str)
        # Set as text whatever it looks like: a name that begins with "=" stays one, in Excel too.
        is_quoted = is_text and value[:1] in ("=", "+", "-", "@", "'")
        cell.value = re.sub(_CONTROL, " ", value)[:LONGEST] if is_text else value
        if is_text:
            cell.data_type = "s"
        look = (is_text, is_quoted, colour, form, bold)
        if look not in self._made:
            self._dress(cell, *look)
            self._made[look] = cell._style
        cell._style = self._made[look]

    @staticmethod
    def _dress(
        cell: Any, is_text: bool, is_quoted: bool, colour: str, form: str, bold: bool
    ) -> None:
        from openpyxl.styles import Alignment, Font, PatternFill

        left = {"horizontal": "left", "indent": 1} if is_text else {}
        cell.alignment = Alignment(vertical="top", wrap_text=is_text, **left)
        cell.number_format = "General" if is_text else form
        cell.quotePrefix = is_quoted
        if bold:
            cell.font = Font(bold=True)
        if colour:
            cell.fill = PatternFill("solid", fgColor=colour)


def _widen(sheet: Any, header: Sequence[str], rows: Sequence[Sequence[Any]], row: int) -> None:
    """Fit columns to the width of their content, up to a limit, and rows to their height."""
    from openpyxl.utils import get_column_letter

    shown = [[v.value if isinstance(v, Filled) else v for v in values] for values in rows]
    for column, head in enumerate(header):
        longest = max(len(word) for word in [*head.split(), ""])
        for value in (values[column] for values in shown):
            longest = max(longest, len(value) if isinstance(value, str) else NUMBER)
        dimension = sheet.column_dimensions[get_column_letter(column + 1)]
        before = dimension.width if dimension.customWidth else 0.0
        dimension.width = max(before, min(WIDEST, longest * 1.1 + 2.0))
    widths = [sheet.column_dimensions[get_column_letter(c + 1)].width for c in range(len(header))]
    # Not every program fits rows to wrapped texts by itself.
    for number, cells in enumerate([header, *shown], row):
        texts = [(v, width) for v, width in zip(cells, widths, strict=True) if isinstance(v, str)]
        lines = max((-(-1.15 * len(text) // width) for text, width in texts), default=1)
        if lines > 1:
            sheet.row_dimensions[number].height = LINE * min(lines, 25)


def saved(book: Workbook, values: Mapping[str, Mapping[str, float]] | None = None) -> bytes:
    """Return the file of a workbook, without the time at which it was made.

    Parameters
    ----------
    values : mapping, optional
        Values of formulas by title of the sheet and address, for programs that do not calculate.
    """
    file = BytesIO()
    book.save(file)
    fixed = BytesIO()
    places = {f"xl/worksheets/sheet{k}.xml": t for k, t in enumerate(book.sheetnames, 1)}
    with ZipFile(file) as old, ZipFile(fixed, "w", ZIP_DEFLATED) as new:
        for name in old.namelist():
            data = old.read(name)
            known = (values or {}).get(places.get(name, ""))
            if known:
                data = _with_values(data, known)
            if name == "docProps/core.xml":
                data = re.sub(_CLOCK, rb"\g<1>1980-01-01T00:00:00Z", data)
            entry = ZipInfo(name)  # of 1980
            entry.compress_type = ZIP_DEFLATED
            new.writestr(entry, data)
    return fixed.getvalue()


_EMPTY_VALUE = rb'(<c r="([A-Z]+[0-9]+)"[^>]*><f[^>]*>[^<]*</f>)(?:<v ?/>|<v></v>)'


def _with_values(data: bytes, known: Mapping[str, float]) -> bytes:
    """Return a sheet whose formulas have their values."""

    def filled(cell: re.Match[bytes]) -> bytes:
        value = known.get(cell[2].decode())
        return cell[0] if value is None else cell[1] + f"<v>{value!r}</v>".encode()

    return re.sub(_EMPTY_VALUE, filled, data)
