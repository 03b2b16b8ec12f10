"""A calculation as sheets of a workbook: cells with names and formulas (книга с формулами).

Every quantity is a row with its letter, its name, its unit, its formula, and its values: one, or
one for each position. The name is that of its cells, so that formulas read as on paper. The cells
of given data have a ground. Values are written beside the formulas, for programs that only show.
"""

from __future__ import annotations

import re
from math import isfinite
from typing import TYPE_CHECKING, Any, TypeAlias

from msgspec.structs import replace

from planmethod.note.calculation.expression import Expression
from planmethod.note.calculation.model import (
    CalculationChapter,
    Equations,
    Heading,
    LivingCalculation,
    Quantity,
)
from planmethod.note.document import plain_text
from planmethod.note.writers.formulatext import CellText, ReaderText, written
from planmethod.note.writers.workbook import new_workbook, saved

if TYPE_CHECKING:
    from openpyxl import Workbook

    from planmethod.note.wording import MessageTable

FIRST = 5
"""Column of the first value."""

GIVEN, COMPUTED, HEAD = "FFF2CC", "E2EFDA", "EEEEEE"
"""Grounds of inputs, of values of the program, and of heads."""

WIDTHS = {1: 13.0, 2: 15.0, 3: 9.0, 4: 46.0}
NUMBER = 12.5
FONT = "Calibri"
SCALE = 60
"""Scale of a printed sheet with positions, percent: ten of them on a page."""

SIGNIFICANT, NOISE = 6, 1e-9

Values: TypeAlias = dict[str, dict[str, float]]
"""Values of formulas by title of the sheet and cell: no workbook's library writes them."""

_FORBIDDEN = re.compile(r"[\[\]:*?/\\']")


def calculation_workbook(calculation: LivingCalculation, texts: MessageTable) -> bytes:
    """Return a workbook of a calculation alone."""
    book = new_workbook()
    values = add_calculation(book, calculation, texts)
    return saved(book, values)


def add_calculation(book: Workbook, calculation: LivingCalculation, texts: MessageTable) -> Values:
    """Add the chapters of a calculation to a workbook, one sheet each.

    Returns
    -------
    dict of str to dict of str to float
        Values of the formulas by title of the sheet and address, for `saved`.
    """
    values: Values = {}
    about = Heading(texts.about.format(), is_sentence=True)
    for number, chapter in enumerate(calculation.chapters):
        items = chapter.items if number else (about, *chapter.items)
        _ChapterSheet(book, replace(chapter, items=items), texts, values).write()
    book.calculation.fullCalcOnLoad = True
    return values


class _ChapterSheet:
    """One sheet while it is written."""

    def __init__(
        self, book: Workbook, chapter: CalculationChapter, texts: MessageTable, values: Values
    ) -> None:
        from openpyxl.styles import Alignment, Font, PatternFill

        self.book, self.chapter, self.texts = book, chapter, texts
        title = _FORBIDDEN.sub(" ", plain_text(chapter.title))[:31]
        self.sheet: Any = book.create_sheet(title)
        self.values = values.setdefault(self.sheet.title, {})
        self.rows: dict[str, int] = {}
        self.row = 1
        self.bold = Font(name=FONT, bold=True)
        self.italic = Font(name=FONT, italic=True, color="555555")
        self.fills = {c: PatternFill("solid", fgColor=c) for c in (GIVEN, COMPUTED, HEAD)}
        self.wrapped = Alignment(wrap_text=True, vertical="top")
        self.top = Alignment(vertical="top")
        self.right = Alignment(vertical="top", horizontal="right")

    def write(self) -> None:
        """Write the chapter."""
        from openpyxl.utils import get_column_letter

        columns = FIRST + max(len(self.chapter.heads), 1)
        texts = self.texts
        heads = [texts.symbol, texts.name, texts.unit, texts.formula]
        heads += list(self.chapter.heads) or [texts.value]
        for column, head in enumerate(heads, 1):
            cell = self._text(self.row, column, plain_text(head), self.bold)
            cell.fill = self.fills[HEAD]
        self.row += 1
        for item in self.chapter.items:
            if isinstance(item, Heading):
                self._heading(item)
            elif isinstance(item, Quantity):
                self._quantity(item)
            else:
                columns = max(columns, FIRST + len(item.unknowns) + 1)
                self._equations(item)
        for column in range(1, columns + 1):
            letter = get_column_letter(column)
            self.sheet.column_dimensions[letter].width = WIDTHS.get(column, NUMBER)
        self.sheet.freeze_panes = self._address(2, FIRST)
        setup = self.sheet.page_setup
        setup.orientation, setup.paperSize = "landscape", 9
        if self.chapter.heads:
            setup.scale, setup.pageOrder = SCALE, "overThenDown"
            self.sheet.print_title_cols = "A:D"
        else:
            setup.fitToWidth, setup.fitToHeight = 1, 0
            self.sheet.sheet_properties.pageSetUpPr.fitToPage = True
        self.sheet.print_title_rows = "1:1"

    def _text(self, row: int, column: int, text: str, font: Any = None) -> Any:
        cell = self.sheet.cell(row, column)
        cell.value, cell.data_type = text, "s"
        cell.quotePrefix = text[:1] in ("=", "+", "-", "@", "'")
        cell.alignment = self.wrapped if column < FIRST else self.right
        if font is not None:
            cell.font = font
        return cell

    def _heading(self, item: Heading) -> None:
        cell = self._text(self.row, 1, plain_text(item.text),
                          self.italic if item.is_sentence else self.bold)  # fmt: skip
        cell.alignment = self.top
        if item.is_sentence:
            from openpyxl.styles import Alignment

            cell.alignment = Alignment(wrap_text=True, vertical="top")
            self.sheet.merge_cells(
                start_row=self.row, end_row=self.row, start_column=1, end_column=FIRST
            )
            width = sum(WIDTHS.values()) + NUMBER
            self.sheet.row_dimensions[self.row].height = 15.0 * -(-len(item.text) // int(width))
        self.row += 1

    def _address(self, row: int, column: int) -> str:
        from openpyxl.utils import get_column_letter

        return f"{get_column_letter(column)}{row}"

    def _quantity(self, one: Quantity) -> None:
        row, self.row = self.row, self.row + 1
        self.rows[one.name] = row
        self._text(row, 1, plain_text(one.symbol))
        self._text(row, 2, one.name)
        self._text(row, 3, plain_text(one.unit))
        shown = self._explanation(one)
        self._text(row, 4, shown)
        lines = -(-len(shown) // int(WIDTHS[4] - 1))
        if lines > 1:
            self.sheet.row_dimensions[row].height = 15.0 * min(lines, 12)
        for k, value in enumerate(one.values):
            self._cell(row, FIRST + k, value, one.formulas[k], one)
        self._define(one.name, row, FIRST, FIRST + len(one.values) - 1)

    def _explanation(self, one: Quantity) -> str:
        """Return what the column of formulas says of a quantity."""
        formulas = [formula for formula in one.formulas if formula is not None]
        parts = []
        if formulas:
            text = written(formulas[0], ReaderText())
            parts.append(text if one.formula is not None else f"{text} …")
            if len(set(formulas)) > 1:
                parts.append(self.texts.differs)
        if one.remark:
            parts.append(plain_text(one.remark))
        elif one.is_input:
            parts.append(self.texts.given)
        return "; ".join(parts)

    def _cell(
        self, row: int, column: int, value: float, formula: Expression | None, one: Quantity
    ) -> None:
        cell = self.sheet.cell(row, column)
        cell.number_format, cell.alignment = _number_format(one), self.top
        if formula is not None:
            cell.value = "=" + written(formula, self._dialect(row, column))
            if isfinite(value):
                self.values[cell.coordinate] = value
            return
        if isfinite(value):
            cell.value = value
            cell.fill = self.fills[GIVEN if one.is_input else COMPUTED]

    def _dialect(self, row: int, column: int) -> CellText:
        here = {name: self._address(at, column) for name, at in self.rows.items()}
        if column == FIRST:
            return CellText({}, here)
        before = {name: self._address(at, column - 1) for name, at in self.rows.items()}
        return CellText({**before, "": self._address(row, column - 1)}, here)

    def _define(self, name: str, row: int, first: int, last: int) -> None:
        from openpyxl.utils import quote_sheetname
        from openpyxl.workbook.defined_name import DefinedName

        ends = [self._fixed(row, column) for column in (first, last)]
        place = ends[0] if first == last else ":".join(ends)
        target = f"{quote_sheetname(self.sheet.title)}!{place}"
        self.book.defined_names[name] = DefinedName(name, attr_text=target)

    def _equations(self, item: Equations) -> None:
        """Write equations as a table of coefficients, and their solution by the inverse matrix."""
        count = len(item.unknowns)
        for k, unknown in enumerate(item.unknowns):
            cell = self._text(self.row, FIRST + k, plain_text(unknown.symbol), self.bold)
            cell.fill = self.fills[HEAD]
        self._text(self.row, FIRST + count, self.texts.right, self.bold).fill = self.fills[HEAD]
        top = self.row + 1
        for down, name in enumerate(item.names):
            row = top + down
            self._text(row, 4, plain_text(name))
            told = (*item.coefficients[down], item.right[down])
            for k, expression in enumerate(told):
                cell = self.sheet.cell(row, FIRST + k)
                cell.value = "=" + written(expression, CellText({}, {}))
        matrix = f"{self._fixed(top, FIRST)}:{self._fixed(top + count - 1, FIRST + count - 1)}"
        right = f"{self._fixed(top, FIRST + count)}:{self._fixed(top + count - 1, FIRST + count)}"
        self.row = top + count
        for k, unknown in enumerate(item.unknowns, 1):
            row, self.row = self.row, self.row + 1
            self._text(row, 1, plain_text(unknown.symbol))
            self._text(row, 2, unknown.name)
            self._text(row, 3, plain_text(unknown.unit))
            self._text(row, 4, self.texts.solution)
            cell = self.sheet.cell(row, FIRST)
            cell.value = f"=INDEX(MMULT(MINVERSE({matrix}),{right}),{k},1)"
            cell.number_format = _number_format(unknown)
            self.values[self._address(row, FIRST)] = unknown.values[0]
            self._define(unknown.name, row, FIRST, FIRST)

    def _fixed(self, row: int, column: int) -> str:
        from openpyxl.utils import get_column_letter

        return f"${get_column_letter(column)}${row}"


def _number_format(one: Quantity) -> str:
    """Return a format with six digits of the largest value; small numbers with a power of ten."""
    largest = max((abs(value) for value in one.values if isfinite(value)), default=0.0)
    if largest < NOISE:
        return "0.00000"  # what rounding leaves of a zero
    if all(value == int(value) for value in one.values if isfinite(value)):
        return "General"
    if not 1e-4 <= largest < 1e7:
        return "0.00000E+00"
    whole = len(str(int(largest))) if largest >= 1.0 else 0
    return "0." + "0" * max(1, SIGNIFICANT - whole)
