"""Results as a document: tables of one position or of many (таблицы результатов)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import chain

import numpy as np

from planmethod.languages import choose_language
from planmethod.note.compared import DASH, Series
from planmethod.note.document import (
    Caption,
    Chapter,
    Document,
    Item,
    Node,
    Note,
    Paragraph,
    Table,
    computed_text,
    fixed,
    input_text,
    localized,
    table_of_columns,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.narrate.naming import Names, scale_inscription
from planmethod.note.narrate.statement import reading_notes
from planmethod.note.numbers import with_unit
from planmethod.note.tables.errors import (
    ErrorColumns,
    levelled,
    motion_series,
    quantity_series,
    relative_series,
    segment_series,
)
from planmethod.note.tables.superposition import moving_points, superposition_table
from planmethod.note.wording import Language, MessageTable, get_language
from planmethod.note.writers.html import html_part
from planmethod.plans.build import kinds_on
from planmethod.plans.model import FACTS, MOTION, RATES, PlanKind
from planmethod.problem.model import OtherDrive, Problem
from planmethod.problem.quantities import OF_PLANS, SLIDINGS, TURNING, TURNINGS, QuantityKind
from planmethod.solved.reading import Reals, other_place
from planmethod.solved.solution import Solution

FEW = 3
"""Most positions that are shown each with tables of its own."""


def results_document(solution: Solution, language: Language, *, sigma: bool = False) -> Document:
    """Return the results of a solution.

    Up to three positions have tables of their own; more are rows of common tables.

    Parameters
    ----------
    solution : Solution
    language : Language
    sigma : bool
        Show the drafting error beside every reading, and its largest causes in each of a few
        positions.
    """
    return Document.of(
        _results(solution, language, ErrorColumns(solution, language, enabled=sigma))
    )


def results_part(solution: Solution) -> str:
    """Return the results as a notebook shows them, in the language of the environment."""
    lang = choose_language(())
    return html_part(results_document(solution, get_language(lang)), lang)


def _results(solution: Solution, language: Language, sigmas: ErrorColumns) -> Iterator[Node]:
    note, every = language.note, range(len(solution.positions))
    convention = solution.problem.scales.convention
    yield Paragraph(heading_of(solution.problem))
    yield from reading_notes(solution.problem, language)
    yield Item(note.formula.format(formula=solution.structure.formula))
    common = (solution.scales[kind] for kind in MOTION if solution.has_common(kind))
    scales = (scale_inscription(scale, convention, language.notation) for scale in common)
    yield Item(f"{note.scales}: {'; '.join(scales)}")
    if len(every) > FEW:
        yield from _many(solution, language, sigmas)
    else:
        for index in every:
            yield Chapter(position_line(solution, note, index), numbered=False)
            yield from position_tables(solution, language, index, sigmas)
            if sigmas.enabled:
                yield from _causes(solution, note, index)
    yield from further_tables(solution, language)
    yield Paragraph(note.hand_note.format(ruler=input_text(solution.ruler_arithmetic.ruler, note)))
    yield Paragraph(note.sense_note)
    yield from sigmas.notes()


def heading_of(problem: Problem) -> Rich:
    """Return the name of a problem and of its variant."""
    variant = f" ({problem.variant})" if problem.variant else ""
    return escape((problem.title or problem.name) + variant)


def further_tables(solution: Solution, language: Language) -> Iterator[Node]:
    """Yield what the file asks for besides: a turn of the crank, a machine, its balancing."""
    if solution.problem.cycle is not None:
        from planmethod.note.tables.cycle import cycle_tables

        yield from cycle_tables(solution, language)
    if solution.problem.machine is not None:
        from planmethod.note.accounts.machine import machine_results

        yield from machine_results(solution, language)
    if solution.problem.balancing is not None:
        from planmethod.note.accounts.machine import balancing_results

        yield from balancing_results(solution, language)


def _causes(solution: Solution, note: MessageTable, index: int) -> Iterator[Node]:
    from planmethod.note.tables.causes import ErrorCauses

    yield from ErrorCauses(Names(solution, note)).nodes(index)


def scale_texts(solution: Solution, language: Language, index: int) -> list[Rich]:
    """Return the scales of a position as ``μ_{v} = 0,05 (м/с)/мм``, or in mm per unit."""
    convention = solution.problem.scales.convention
    scales = (solution.plan_scale(kind, index) for kind in MOTION)
    return [scale_inscription(scale, convention, language.notation) for scale in scales]


def other_places(solution: Solution, index: int) -> list[tuple[OtherDrive, float]]:
    """Return the other driving links with their places in a position, degrees or m."""
    drive = solution.problem.drive
    return [
        (other, round(float(other_place(drive, other, solution.positions)[index]), 9))
        for other in drive.other_drives
    ]


def position_line(solution: Solution, texts: MessageTable, index: int) -> Rich:
    """Return which position is meant: its number and the driver's place."""
    coordinate = solution.problem.drive.coordinate
    value = input_text(solution.problem.display_position(float(solution.positions[index])), texts)
    count = len(solution.positions)
    places = with_unit(value, texts["units"][coordinate.unit])
    for other, place in other_places(solution, index):
        own = other.coordinate
        shown = with_unit(input_text(place, texts), texts["units"][own.unit])
        places += f"; {own.symbol} = {shown}"
    return (texts.position if count > 1 else texts.one_position).format(
        number=index, count=count, symbol=coordinate.symbol, value=places
    )


# One position ----------------------------------------------------------------------------------


def position_tables(
    solution: Solution, language: Language, index: int, sigmas: ErrorColumns | None = None
) -> Iterator[Node]:
    """Yield the tables of one position: points, links, sliding, segments of the plans, forces."""
    note = language.note
    sigmas = sigmas or ErrorColumns(solution, language, enabled=False)
    quantities = solution.quantities(QuantityKind.VELOCITY, QuantityKind.ACCELERATION)
    yield Caption(note.table_points)
    points = [
        [
            solution.problem.lettered(name),
            *(_place(solution, float(x), note) for x in (place.real, place.imag)),
            *sigmas.row(quantities[name], index),
        ]
        for name in moving_points(solution)
        for place in [solution.points[name].place[index]]
    ]
    yield sigmas.table(note["columns_points"], (4, 6), points)
    yield Caption(note.table_links)
    yield from _link_tables(solution, note, index, sigmas)
    quantities = solution.quantities(*SLIDINGS)
    called = solution.problem.mechanism.called
    sliding = [
        [
            note.sliding_row.format(point=one.point, of=one.of, to=called(one.to)),
            *sigmas.row(quantities[one.name], index),
        ]
        for one in solution.construction.kinematics.relatives.values()
    ]
    if sliding:
        yield Caption(note.table_sliding)
        yield sigmas.table(note["columns_sliding"], (2, 4, 6), sliding)
    for kind, scale in zip(MOTION, scale_texts(solution, language, index), strict=True):
        rows = _segments(solution, note, kind, index, sigmas)
        if not rows:
            continue
        plan = note["plans"][kind.value]
        yield Caption(note.table_segments.format(plan=plan[:1].lower() + plan[1:], scale=scale))
        if kind is PlanKind.POSITION:
            yield sigmas.table(note["columns_lengths"], (2,), rows)
        else:
            unit = note["units"][FACTS[kind].unit]
            head = [text.format(unit=unit) for text in note["columns_vectors"]]
            yield sigmas.table(head, (3,), rows, names=2)
    if solution.problem.drive.other_drives:
        yield Caption(note.superposition)
        yield superposition_table(solution, note, index)
    if solution.problem.dynamics is not None:
        from planmethod.note.tables.forces import forces_tables

        yield from forces_tables(solution, language, index, sigmas)
        if solution.problem.dynamics.friction is not None:
            from planmethod.note.tables.forces import friction_tables

            yield from friction_tables(solution, language, index)


def _place(solution: Solution, metres: float, texts: MessageTable) -> str:
    """Return a coordinate; far from the origin with enough digits to distinguish points."""
    draft = solution.construction.draft
    if draft.origin == 0:
        return computed_text(metres, texts)
    size = max(length for _, _, length in solution.problem.lengths)
    return localized(f"{metres:.{max(0, 4 - math.floor(math.log10(size)))}f}", texts)


def _link_tables(
    solution: Solution, texts: MessageTable, i: int, sigmas: ErrorColumns
) -> Iterator[Table]:
    """Yield the table of the links; with errors it is one of each of ω and ε: they are wide."""
    link, direction, read, sense = texts["columns_links"]
    links = [
        (name, {one.kind: quantity_series(solution, one) for one in quantities})
        for name, quantities in solution.quantities(*TURNING).items()
    ]
    turned = [known.get(QuantityKind.DIRECTION) for _, known in links]
    angles = [DASH if one is None else fixed(float(one.exact[i]), texts) for one in turned]
    leads = [[name, angle] for (name, _), angle in zip(links, angles, strict=True)]
    parts: list[tuple[list[Rich], list[list[Rich]]]] = []
    for kind in OF_PLANS:
        unit, turns = kind.written_unit, kind in TURNINGS
        symbol = f"{kind.symbol}, {texts['units'][unit]}" if unit else kind.symbol
        every = [known.get(kind) for _, known in links]
        senses = [[_sense(one, i, texts)] if turns else [] for one in every]
        cells = [[*sigmas.cells(one, i), *told] for one, told in zip(every, senses, strict=True)]
        parts.append(([symbol, read, *[sense] * turns], cells))
    if not sigmas.enabled:
        heads = (link, direction, *chain(*(head for head, _ in parts)))
        whole = zip(leads, *(cells for _, cells in parts), strict=True)
        yield sigmas.table(heads, (), [list(chain(*row)) for row in whole])
        return
    for k, (head, cells) in enumerate(parts):
        count = 2 if k == 0 else 1
        rows = [[*lead[:count], *row] for lead, row in zip(leads, cells, strict=True)]
        yield sigmas.table((*(link, direction)[:count], *head), (count + 1,), rows)


def _sense(series: Series | None, index: int, texts: MessageTable) -> str:
    (value,) = [0.0] if series is None else series.displayed(series.exact, [index])
    if not value:
        return DASH
    return texts.ccw if value > 0 else texts.cw


def _segments(
    solution: Solution, texts: MessageTable, kind: PlanKind, i: int, sigmas: ErrorColumns
) -> list[list[str]]:
    segments = [
        (one, [fixed(float(one.exact[i]), texts), input_text(float(one.read[i]), texts, 6),
               *sigmas.cell(one, i)])
        for one in segment_series(solution, kind)
    ]  # fmt: skip
    if kind is PlanKind.POSITION:
        return [[one.symbol.replace("-", ""), *lengths] for one, lengths in segments]
    names, rows = Names(solution, texts), []
    values = names.kinematics.motion(kind).segments
    vectors = solution.construction.plan(kind).vectors
    for vector, (_, lengths) in zip(vectors, segments, strict=True):
        number = solution.ruler_reading.number(values.known((vector.tail, vector.head)))
        value = computed_text(abs(float(number[i])), texts)
        name = names.segment(vector.tail, vector.head)
        rows.append([vector.symbol, name, *lengths, value])
    return rows


# Many positions --------------------------------------------------------------------------------


def _many(solution: Solution, language: Language, sigmas: ErrorColumns) -> Iterator[Node]:
    """Yield tables with a row for each position."""
    note, count = language.note, len(solution.positions)
    lead = lead_columns(solution.problem, solution.positions.tolist(), note)

    def table(title: Rich, columns: Sequence[Sequence[Rich]]) -> Iterator[Node]:
        if columns:
            yield Caption(title)
            yield table_of_columns([*lead, *columns], repeated=len(lead))

    def column(one: Series, values: Reals) -> list[Rich]:
        shown = one.displayed(values, range(count))
        return [one.symbol, *(computed_text(value, note) for value in shown)]

    places = []
    for name in moving_points(solution):
        place = solution.points[name].place
        for axis, values in (("x", place.real), ("y", place.imag)):
            cells = [_place(solution, float(value), note) for value in values]
            places.append([f"{axis}_{{{solution.problem.lettered(name)}}}", *cells])
    speeds, changes = (
        [*motion_series(solution, *kinds_on(plan)), *relative_series(solution, plan)]
        for plan in RATES
    )
    yield from table(note.many_places, places)
    for title, some in ((note.many_velocities, speeds), (note.many_accelerations, changes)):
        yield from table(title, [column(one, one.exact) for one in some])
        by_hand = note.many_by_hand.format(title=title)
        yield from table(by_hand, [column(one, one.read) for one in some])
    if solution.problem.dynamics is not None:
        from planmethod.note.tables.forces import forces_columns, resultant_notes

        yield from table(note.many_forces, forces_columns(solution, note))
        yield from map(Note, resultant_notes(solution, note))
    errors = []
    for one in (*speeds, *changes) if sigmas.enabled else ():
        cells = [cell for i in range(count) for cell in sigmas.cell(one, i)]
        errors.append([one.symbol, *levelled(cells)])
    yield from table(note.many_sigmas, errors)


def lead_columns(
    problem: Problem, positions: Sequence[float], texts: MessageTable
) -> list[list[Rich]]:
    """Return the columns that each part of a table of positions begins with: number and place."""
    coordinate = problem.drive.coordinate
    symbol = f"{coordinate.symbol}, {texts['units'][coordinate.unit]}"
    columns = [
        [texts.number, *map(str, range(len(positions)))],
        [symbol, *(input_text(problem.display_position(float(p)), texts) for p in positions)],
    ]
    for other in problem.drive.other_drives:
        own, places = other.coordinate, other_place(problem.drive, other, np.array(positions))
        head = f"{own.symbol}, {texts['units'][own.unit]}"
        columns.append([head, *(input_text(round(float(p), 9), texts) for p in places)])
    return columns
