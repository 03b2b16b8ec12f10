"""Tables of a sheet: results, and values measured on the plans (таблица результатов)."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from math import copysign, inf

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import Name, operands
from planmethod.note.compared import (
    DASH,
    DRAWN,
    MAX_PERCENT,
    ComparedNumber,
    Series,
    as_long,
    sigma_text,
)
from planmethod.note.narrate.digits import (
    MOST_DIGITS,
    RULED,
    PrintedNumber,
    PrintedNumbers,
    decimals_of_step,
    ruler_steps,
)
from planmethod.note.numbers import Notation, decimals_of, significant, to_decimals
from planmethod.note.tables.errors import motion_series, relative_numbers, relative_series
from planmethod.note.wording import Language
from planmethod.plans.build import MOTION_KINDS
from planmethod.plans.model import PlanKind
from planmethod.problem.quantities import QuantityKind
from planmethod.render.frame import STAMP_WIDTH
from planmethod.render.layout.block import Block, Column, make_alternatives, paragraph
from planmethod.render.layout.groups import EDGE
from planmethod.render.layout.text_blocks import TableCell, TableColumn, TableForm, table_block
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.views import drawn_positions, position_text, shown_position
from planmethod.solved.legibility import FEW, MOST_PARTS
from planmethod.solved.reading import memoized
from planmethod.solved.solution import Solution


def value_column(
    series: Series,
    position_indices: Sequence[int],
    notation: Notation,
    *,
    sigma: bool,
    is_single: bool,
    printed: PrintedNumber | None = None,
) -> TableColumn:
    """Return the exact values of a quantity, their senses beside them, by positions.

    With ``sigma`` they have their errors beside them, and a single position (``is_single``) has
    rows for the read value, for its deviation, and for its error. The read value has the digits
    that the calculation has ``printed``.
    """
    values, cells = series.displayed(series.exact, position_indices), list[TableCell]()
    texts = series.texts(values)
    for i, text, value in zip(position_indices, texts, values, strict=True):
        error, mark = series.error(i) if sigma else (0.0, "")
        written = notation.number(as_long(text, abs(value), error))
        if error and not is_single:
            written += f" ± {notation.number(sigma_text(error))}{mark}"
        cells.append(TableCell(written, series.sense(value)))
    if sigma and is_single:
        cells += _read_cells(series, position_indices[0], texts[0], notation, printed)
    return TableColumn(series.symbol, tuple(cells), unit=unit_text(series, notation))


def unit_text(series: Series, notation: Notation) -> str:
    """Return the unit of a quantity below its symbol; empty for a ratio."""
    return notation.units[series.unit] if series.unit else ""


def _read_cells(
    series: Series, index: int, like: str, notation: Notation, printed: PrintedNumber | None
) -> list[TableCell]:
    """Return the value read on the plans, its deviation, and the error.

    ``like``: the exact value's text, whose decimals the read one has if no calculation has it.
    """
    room = 0 if series.turns else None  # for the sign of other values of the column
    one = series[index].unless_lost()
    read = one.text_beside(like, signed=not series.turns)
    one, read = _as_printed(series, one, read, printed)
    text, *others = notation.numbers(
        read,
        one.percent_text(limit=MAX_PERCENT),
        one.sigma_text,
    )
    return [TableCell(text, series.sense(one.read)), *(TableCell(other, room) for other in others)]


def result_columns(
    solution: Solution,
    position_indices: Sequence[int],
    language: Language,
    *,
    sigma: bool = False,
    kinds: Collection[str] = (),
) -> list[TableColumn]:
    """Return the columns of the result table: v, ω, a, ε with values and senses.

    ``kinds`` are the shown quantities. Default: all. With ``sigma`` a single position has rows for
    the read value and its error, and the values of many positions have their errors beside them.
    """
    shown = [kind for kind in MOTION_KINDS if not kinds or kind.symbol in kinds]
    every = motion_series(solution, *shown)
    if len(solution.positions) > 1 and QuantityKind.VELOCITY in shown:
        every += relative_series(solution, PlanKind.VELOCITY)
    return columns_of(every, solution, position_indices, language, sigma=sigma)


def columns_of(
    every: Sequence[Series],
    solution: Solution,
    position_indices: Sequence[int],
    language: Language,
    *,
    sigma: bool,
) -> list[TableColumn]:
    """Return the columns of quantities, those of the positions before them."""
    alone, texts = len(solution.positions) == 1, language.sheets
    printed = _printed(solution, position_indices[0]) if alone and sigma else {}
    columns = [
        value_column(
            one, position_indices, language.notation,
            sigma=sigma, is_single=alone, printed=printed.get(one.label),
        )
        for one in every
    ]  # fmt: skip
    if not alone:
        return [*position_columns(solution, position_indices, language), *columns]
    rows = (texts.exact, texts.read, "Δ, %", "±σ")
    return [TableColumn("", rows), *columns] if sigma else columns


def _printed(solution: Solution, index: int) -> dict[str, PrintedNumber]:
    """Return the numbers of a calculation as it prints them, by the labels of the quantities."""
    steps = {step.out: step for step in solution.construction.program.steps}
    of = PrintedNumbers(solution, steps, index).of
    found = {
        one.label: of(one.size) for one in solution.construction.legend if one.size is not None
    }
    relative = relative_numbers(solution, PlanKind.VELOCITY)
    return found | {symbol: of(number) for symbol, number in relative.items()}


def position_columns(
    solution: Solution, position_indices: Sequence[int], language: Language
) -> list[TableColumn]:
    """Return the columns of the numbers of positions, and of the driver's positions."""
    coordinate = solution.problem.drive.coordinate
    asked = tuple(position_text(solution, i, language.notation) for i in position_indices)
    return [
        TableColumn(language.note.number, tuple(str(i) for i in position_indices), min_width=8.0),
        TableColumn(coordinate.symbol, asked, unit=language.notation.in_head(coordinate.unit)),
    ]


def table_width(style: BlockStyle, usual: float = inf) -> float:
    """Return the width of a table, mm: requested or usual, at least the title block's."""
    room = style.inside - 2 * EDGE
    return min(max(STAMP_WIDTH, style.width(min(usual, room))), room)


def results_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the table of results and, with sigmas, a note on its errors."""
    alone, sigma = len(solution.positions) == 1, style.options.sigma
    sigma = alone if sigma is None else sigma
    size = style.sizes.text
    height = style.text(size if len(position_indices) == 1 else min(size, 3.5))
    width = table_width(style)
    language, texts = style.language, style.language.sheets
    title = texts.results_exact
    if sigma:
        title = texts.results if alone else texts.results_sigma
    columns = result_columns(
        solution, position_indices, language, sigma=sigma, kinds=style.entry.columns
    )
    table = table_block(
        columns,
        TableForm(height, leading=(1 if sigma else 0) if alone else 2),
        max_width=width,
        width=STAMP_WIDTH,
        title=style.entry.title or title,
    )
    if not sigma:
        return table
    return with_note(table, columns, height, solution.profile.name, language)


def with_note(
    tables: Column,
    columns: Sequence[TableColumn],
    height: float,
    profile: str,
    language: Language,
) -> Column:
    """Return tables with a note on the errors in their columns, also on marked ones."""
    note = language.note
    text = language.sheets.sigma_note.format(profile=note["profiles"].get(profile, profile))
    if any(cell.text.endswith(DRAWN) for column in columns for cell in column.cells):
        text = f"{text} {note.drawn_note}"
    width = tables.width - _FROM_FRAME
    return Column([tables, paragraph(text, min(height, 3.5), width)], gap=3.0)


REPEATED = 45.0
"""Width that a part has beyond its share of the whole table, mm: repeated and uneven columns."""

MISREAD = 10.0
"""Error of a reading from which it is compared with the error to expect, per cent."""

_NOT_READ = "±"  # before the error that a table has in place of a reading

_FROM_FRAME = 2.0  # mm of white at the end of a line, where the table is flush with the frame


def measured_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return measured and exact values of every quantity, by positions; dashes of undrawn ones.

    If errors are requested, the exact values with their errors.
    """
    if style.options.sigma:
        return results_block(solution, position_indices, style)
    language = style.language
    columns, known = position_columns(solution, position_indices, language), list[str]()
    drawn, _ = drawn_positions(solution, position_indices, style)
    shown = shown_position(solution, position_indices, style)
    calculated = _Calculated(shown, _printed(solution, shown))
    relative = [(one, [one.symbol]) for one in relative_series(solution, PlanKind.VELOCITY)]
    lost = False
    for series, symbols in (*_once(solution), *relative):
        column = value_column(series, drawn, language.notation, sigma=False, is_single=False)
        column = replace(column, head=" = ".join(symbols))
        read = list[TableColumn]()
        if _is_measured(solution, series.label):
            read = _measured(
                series, _ReadDecimals(solution, series.label), column, drawn, calculated, language,
                with_errors=style.options.sigma is not False,
            )  # fmt: skip
            lost = lost or any(cell.text.startswith(_NOT_READ) for cell in read[0].cells)
        elif len(set(column.cells)) == 1:
            known.append(f"{column.head} = {_signed(column.cells[0])} {column.unit}")
            continue
        columns += [_with_dashes(one, drawn, position_indices) for one in (column, *read)]
    height = style.text(min(style.sizes.text, 3.5))
    title = style.entry.title or language.sheets.measured
    phrase = title.format(ruler=language.notation.as_input(solution.profile.ruler))
    below = [language.sheets.not_measurable] if lost else []
    if known:
        below.append(language.sheets.known.format(values="; ".join(known)))

    few = len(position_indices) <= FEW

    def table(width: float) -> Column:
        made = table_block(
            columns,
            TableForm(height, leading=2, row_height=2.0 * height, shrinks=few),
            max_width=width,
            width=STAMP_WIDTH,
            title=phrase,
        )
        return Column([made, *(paragraph(note, height, made.width) for note in below)], 3.0)

    usual = table(table_width(style))
    if few:
        return usual
    # Rows of many positions are high: there are parts beside and under one another.
    room, whole = style.inside - 2 * EDGE, table(inf).width
    shares = (whole / parts + REPEATED for parts in range(1, MOST_PARTS + 1))
    widths = [max(STAMP_WIDTH, min(share, room)) for share in shares]
    ways = {(way.width, way.height): way for way in (usual, *map(table, widths))}
    return make_alternatives(ways.values())


def _is_measured(solution: Solution, label: str) -> bool:
    """Return whether a quantity is read with the ruler: a vector's segment, or a number from it.

    ``label`` is that of a quantity of the motion, or of a relative velocity.
    """
    quantity = solution.legend.get(label)
    if quantity is None:
        return relative_numbers(solution, PlanKind.VELOCITY)[label] in read_names(solution)
    if quantity.size is None:
        return False
    if quantity.kind.is_number:
        return quantity.size in read_names(solution)
    step = solution.construction.step
    return any(isinstance(step(name), RULED) for name, _ in operands(step(quantity.size)))


@memoized
def read_names(solution: Solution) -> frozenset[Name]:
    """Return the names of a construction that depend on ruler readings."""
    found: set[Name] = set()
    for step in solution.construction.program.steps:
        if isinstance(step, RULED) or not found.isdisjoint(name for name, _ in operands(step)):
            found.add(step.out)
    return frozenset(found)


def _signed(cell: TableCell) -> str:
    """Return a value with its sign, which a table shows by an arrow."""
    return f"−{cell.text}" if (cell.sense or 0) < 0 else cell.text


def _once(solution: Solution) -> list[tuple[Series, list[str]]]:
    """Return the reported quantities with their symbols, joining those with the same number."""
    found: dict[tuple[object, ...], tuple[Series, list[str]]] = {}
    for one in motion_series(solution, *MOTION_KINDS):
        of = solution.legend[one.label]
        found.setdefault((of.kind, of.size), (one, []))[1].append(one.symbol)
    return list(found.values())


class _Calculated(Struct, frozen=True):
    """The position whose calculation the sheet has, and its numbers as printed there."""

    index: int
    printed: Mapping[str, PrintedNumber]


class _ReadDecimals(Struct, frozen=True):
    """Decimals of the readings of a quantity, by its label: those of a division of the ruler."""

    solution: Solution
    label: str

    def of(
        self, readings: Mapping[int, float], index: int, printed: PrintedNumber | None
    ) -> dict[int, int]:
        """Return the decimals of readings by positions; equal where plans have one scale.

        At the scale of position ``index`` they are those that its calculation has ``printed``, if
        that has other digits. The largest reading of a scale has at most four digits.
        """
        quantity = self.solution.legend.get(self.label)
        relative = relative_numbers(self.solution, PlanKind.VELOCITY)
        name = relative[self.label] if quantity is None else quantity.size
        assert name is not None
        steps = ruler_steps(self.solution, name).tolist()
        own = {i: decimals_of_step(steps[i]) for i in readings if steps[i]}
        if printed is not None and printed.is_measured and index in own and "e" not in printed.text:
            text = to_decimals(abs(readings[index]), own[index])
            if float(text) != printed.value:
                like, its = own[index], decimals_of(printed.text)
                own = {i: its if decimals == like else decimals for i, decimals in own.items()}
        largest = {d: max(abs(readings[i]) for i in own if own[i] == d) for d in own.values()}
        most = {d: decimals_of(significant(value, MOST_DIGITS)) for d, value in largest.items()}
        return {i: min(d, most[d]) for i, d in own.items()}


def _measured(
    series: Series,
    decimals: _ReadDecimals,
    exact: TableColumn,
    drawn: Sequence[int],
    calculated: _Calculated,
    language: Language,
    *,
    with_errors: bool,
) -> list[TableColumn]:
    """Return the measured values and their deviations, %, of the positions that are drawn.

    A misread value with a drafting error larger than itself has that error in place of the reading,
    if errors may be shown.
    A deviation is "—" where the exact value is zero.
    """
    notation, cells, off = language.notation, list[TableCell](), list[str]()
    printed = calculated.printed.get(series.label)
    every = {i: series.measured(i) for i in drawn}
    places = decimals.of({i: one.read for i, one in every.items()}, calculated.index, printed)
    for i, one in every.items():
        text = series.texts([one.read])[0]
        if i in places:
            own = printed if i == calculated.index else None
            one, _ = _as_printed(series, one, text, own)
            # The deviation is that of the printed number.
            one = replace(one, read=float(to_decimals(one.read, places[i])))
            text = to_decimals(abs(one.read) if series.turns else one.read, places[i])
        # Errors are found on request alone, and most readings are near enough without them.
        sigma = series.error(i)[0] if with_errors and one.percent_size > MISREAD else 0.0
        if sigma > abs(one.exact):
            cells.append(TableCell(f"{_NOT_READ}{notation.number(sigma_text(sigma))}"))
            off.append(f">{MAX_PERCENT:.0f}")
            continue
        cells.append(TableCell(notation.number(text), series.sense(one.read)))
        off += notation.numbers(one.percent_text())
    head = language.sheets.read_symbol.format(symbol=series.symbol)
    return [
        TableColumn(head, tuple(cells), unit=exact.unit, joined=True),
        TableColumn("Δ", tuple(off), unit="%", min_width=9.0, joined=True),
    ]


def _as_printed(
    series: Series, one: ComparedNumber, text: str, printed: PrintedNumber | None
) -> tuple[ComparedNumber, str]:
    """Return a reading and its text as the calculation has them, if it has: one number, one text.

    The sense of a rotation is beside its text.
    """
    if printed is None or not printed.is_measured or not one.read:
        return one, text
    sign = "-" if one.read < 0 and not series.turns else ""
    return replace(one, read=copysign(printed.value, one.read)), f"{sign}{printed.text}"


def _with_dashes(
    column: TableColumn, drawn: Sequence[int], position_indices: Sequence[int]
) -> TableColumn:
    """Return a column of positions that are drawn with a dash for each of the others."""
    cells = dict(zip(drawn, column.cells, strict=True))
    return replace(column, values=tuple(cells.get(i, TableCell(DASH)) for i in position_indices))
