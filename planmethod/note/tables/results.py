"""Result tables for the terminal (таблицы результатов)."""

from __future__ import annotations

import math

from planmethod.note.narrate.given import told
from planmethod.note.narrate.naming import Names
from planmethod.note.narrate.scales import common_scale, scale_inscription
from planmethod.note.numbers import with_unit
from planmethod.note.plaintext import (
    columns_text,
    fixed,
    found,
    given,
    heading,
    plain_text,
    spoken,
    table,
    wrap,
)
from planmethod.note.tables.sigmas import Sigmas, levelled
from planmethod.note.wording import Words, language, wording
from planmethod.plans.legend import TURNING, Quantity, QuantityKind
from planmethod.plans.model import FACTS, MOTION, PlanKind
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Segment, Solution

FEW = 3
"""Most positions that are shown each with tables of its own."""


def result_tables(solution: Solution, lang: str = "ru", *, sigma: bool = False) -> str:
    """Return the results of a solution as aligned text of at most 100 columns.

    Up to three positions have tables of their own; more are rows of common tables.

    Parameters
    ----------
    solution : Solution
    lang : str
        ``ru`` or ``en``.
    sigma : bool
        Show how far the drawing may be off beside every value that is read, and what contributes
        most to it in each of a few positions.

    Raises
    ------
    UnknownLanguageError
    """
    words = wording(lang)
    name = solution.problem.title or solution.problem.name
    variant = f" ({solution.problem.variant})" if solution.problem.variant else ""
    lines = wrap(name + variant)
    lines += wrap(words.formula.format(formula=solution.structure.formula), rest="  ")
    every = range(len(solution.positions))
    scales = (common_scale(solution, kind, every, language(words.lang)) for kind in MOTION)
    lines += wrap(f"{words.scales}: {'; '.join(map(plain_text, scales))}", rest="  ")
    sigmas = Sigmas(solution, words, asked=sigma)
    if len(solution.positions) > FEW:
        lines += ["", *_many(solution, words, sigmas)]
    else:
        for index in range(len(solution.positions)):
            lines += ["", *heading(position_line(solution, words, index)), ""]
            lines += position_tables(solution, words, index, sigmas)
            lines += _forces(solution, words, index, sigmas)
            lines += _causes(solution, words, index) if sigma else []
    if solution.problem.cycle is not None:
        from planmethod.note.tables.turn import cycle_tables

        lines += ["", *cycle_tables(solution, language(words.lang))]
    if solution.problem.machine is not None:
        from planmethod.note.tables.machine import machine_tables

        lines += ["", *machine_tables(solution, words)]
    if solution.problem.balancing is not None:
        from planmethod.note.tables.balancing import balancing_tables

        lines += ["", *balancing_tables(solution, words)]
    ruler = given(solution.hand.ruler, words)
    lines += ["", *wrap(words.hand_note.format(ruler=ruler)), words.sense_note, *sigmas.notes()]
    return "\n".join(lines)


def _forces(solution: Solution, words: Words, index: int, sigmas: Sigmas) -> list[str]:
    if solution.problem.dynamics is None:
        return []
    from planmethod.note.tables.forces import forces_tables

    return ["", *forces_tables(solution, words, index, sigmas)]


def _causes(solution: Solution, words: Words, index: int) -> list[str]:
    from planmethod.note.tables.causes import Causes

    lines = Causes(Names(solution, words)).lines(index)
    return ["", *lines] if lines else []


def scale_texts(solution: Solution, words: Words, index: int) -> list[str]:
    """Return the scales of a position as ``μ_v = 0,05 (м/с)/мм``, or in mm per unit."""
    say, convention = language(words.lang).say, solution.problem.scales.convention
    scales = (solution.own_scale(kind, index) for kind in MOTION)
    return [plain_text(scale_inscription(scale, convention, say)) for scale in scales]


def position_line(solution: Solution, words: Words, index: int) -> str:
    """Return which position is told: its number and the driver's place."""
    coordinate = solution.problem.drive.coordinate
    value = given(float(solution.positions[index]), words)
    count = len(solution.positions)
    return (words.position if count > 1 else words.one_position).format(
        number=index,
        count=count,
        symbol=plain_text(coordinate.symbol),
        value=with_unit(value, words["units"][coordinate.unit]),
    )


# One position ----------------------------------------------------------------------------------


def position_tables(
    solution: Solution, words: Words, index: int, sigmas: Sigmas | None = None
) -> list[str]:
    """Return the tables of one position: points, links, sliding, segments of the plans."""
    sigmas = sigmas or Sigmas(solution, words, asked=False)
    points = _points(solution, words, index, sigmas)
    parts = [
        (words.table_points, sigmas.table(sigmas.header(words["columns_points"], 4, 6), points)),
        (words.table_links, _link_tables(solution, words, index, sigmas)),
    ]
    sliding = _sliding(solution, words, index, sigmas)
    if sliding:
        header = sigmas.header(words["columns_sliding"], 2, 4, 6)
        parts.append((words.table_sliding, sigmas.table(header, sliding)))
    names = Names(solution, words)
    for kind, scale in zip(MOTION, scale_texts(solution, words, index), strict=True):
        plan = words["plans"][kind.value]
        title = words.table_segments.format(plan=plan[:1].lower() + plan[1:], scale=scale)
        rows = _segments(solution, names, kind, index, sigmas)
        if kind is PlanKind.POSITION:
            lines = sigmas.table(sigmas.header(words["columns_lengths"], 2), rows)
        else:
            unit = words["units"][FACTS[kind].unit]
            header = sigmas.header([text.format(unit=unit) for text in words["columns_vectors"]], 3)
            lines = sigmas.table(header, rows, left=2)
        if rows:
            parts.append((title, lines))
    lines = []
    for title, part in parts:
        lines += [*([""] if lines else []), title, *part]
    return lines


def moving_points(solution: Solution) -> list[str]:
    """Return the names of the points that are not fixed."""
    velocity = solution.construction.kinematics.velocity
    return [name for name, at in velocity.named.items() if velocity.point[at] != velocity.pole]


def _points(solution: Solution, words: Words, i: int, sigmas: Sigmas) -> list[list[str]]:
    rows, quantities = [], solution.quantities(QuantityKind.VELOCITY, QuantityKind.ACCELERATION)
    for name in moving_points(solution):
        place = solution.points[name].place[i]
        row = [name, *(_place(solution, float(x), words) for x in (place.real, place.imag))]
        for quantity in quantities[name]:
            row += _found(solution, quantity, i, sigmas)
        rows.append(row)
    return rows


def _found(solution: Solution, quantity: Quantity, i: int, sigmas: Sigmas) -> list[str]:
    """Return a quantity in one position: exact, as the hand finds it, and its error."""
    exact, read = solution.exact(quantity)[i], solution.read_off(quantity.label)[i]
    told = [found(float(value), sigmas.words) for value in (exact, read)]
    return [*told, *sigmas.cell(quantity.label, i)]


def _place(solution: Solution, metres: float, words: Words) -> str:
    """Return a coordinate; far from the origin with the digits that tell points apart."""
    draft = solution.construction.draft
    if draft.origin == 0:
        return found(metres, words)
    size = max(length for _, _, length in solution.problem.lengths)
    return spoken(f"{metres:.{max(0, 4 - math.floor(math.log10(size)))}f}", words)


def _link_tables(solution: Solution, words: Words, i: int, sigmas: Sigmas) -> list[str]:
    """Return the table of the links; with errors it is one of ω and one of ε: both are wide."""
    rows = _links(solution, words, i, sigmas)
    if not sigmas.asked:
        return table(words["columns_links"], rows)
    header = sigmas.header(words["columns_links"], 3, 6)
    one = sigmas.table(header[:6], [row[:6] for row in rows])
    two = sigmas.table((header[0], *header[6:]), [[row[0], *row[6:]] for row in rows])
    return [*one, "", *two]


def _links(solution: Solution, words: Words, i: int, sigmas: Sigmas) -> list[list[str]]:
    rows = []
    for name, quantities in solution.quantities(*TURNING).items():
        known = {quantity.kind: quantity for quantity in quantities}
        direction = known.pop(QuantityKind.DIRECTION, None)
        row = [name, "—"]
        if direction is not None:
            row[1] = fixed(float(solution.exact(direction)[i]), words)
        for kind in (QuantityKind.OMEGA, QuantityKind.EPSILON):
            if kind in known:
                row += _found(solution, known[kind], i, sigmas)
                row.append(_sense(solution.exact(known[kind])[i], words))
            else:
                row += ["—", "—", *sigmas.cell(None, i), "—"]
        rows.append(row)
    return rows


def _sense(value: float, words: Words) -> str:
    if abs(value) < 1e-12:
        return "—"
    return words.ccw if value > 0 else words.cw


def _sliding(solution: Solution, words: Words, i: int, sigmas: Sigmas) -> list[list[str]]:
    rows = []
    quantities = solution.quantities(
        QuantityKind.SLIDING, QuantityKind.CORIOLIS, QuantityKind.RELATIVE
    )
    for relative in solution.construction.kinematics.relatives.values():
        row = [words.sliding_row.format(point=relative.point, of=relative.of, to=relative.to)]
        for quantity in quantities[relative.name]:
            row += _found(solution, quantity, i, sigmas)
        rows.append(row)
    return rows


def _segments(
    solution: Solution, names: Names, kind: PlanKind, i: int, sigmas: Sigmas
) -> list[list[str]]:
    words, rows = names.words, []
    segments = solution.segments(kind)

    def lengths(segment: Segment) -> list[str]:
        return [*_lengths(segment, words, i), *sigmas.cell(f"{kind.value}.{segment.name}", i)]

    if kind is PlanKind.POSITION:
        return [[_joined(s), *lengths(s)] for s in segments]
    motions = (names.kin.velocity, names.kin.acceleration)
    values = next(motion.segments for motion in motions if motion.kind is kind)
    for vector, segment in zip(solution.construction.plan(kind).vectors, segments, strict=True):
        number = solution.by_hand.number(values.known((vector.tail, vector.head)))
        value = found(abs(float(number[i])), words)
        name = plain_text(names.segment(vector.tail, vector.head))
        rows.append([plain_text(vector.symbol), name, *lengths(segment), value])
    return rows


def _joined(segment: Segment) -> str:
    return segment.name.replace("-", "")


def _lengths(segment: Segment, words: Words, i: int) -> list[str]:
    exact, read = float(segment.exact[i]), float(segment.read[i])
    return [fixed(exact, words), given(read, words, 6)]


def _many_forces(solution: Solution, words: Words) -> list[list[str]]:
    if solution.problem.dynamics is None:
        return []
    from planmethod.note.tables.forces import forces_columns

    return forces_columns(solution, words)


def _resultants(solution: Solution, words: Words) -> list[str]:
    from planmethod.note.narrate.forces.resultants import kept_lines, shift_lines
    from planmethod.solved.forces.statics import statics_of

    said = [*shift_lines(statics_of(solution), words), *kept_lines(statics_of(solution), words)]
    return [line for text in said for line in wrap(plain_text(text))]


# Many positions --------------------------------------------------------------------------------


def _many(solution: Solution, words: Words, sigmas: Sigmas) -> list[str]:
    """Return tables with a row for each position."""
    coordinate = solution.problem.drive.coordinate
    symbol = f"{plain_text(coordinate.symbol)}, {words['units'][coordinate.unit]}"
    lead = [
        [words.number, *(str(i) for i in range(len(solution.positions)))],
        [symbol, *(given(float(p), words) for p in solution.positions)],
    ]

    def column(quantity: Quantity, values: Reals) -> list[str]:
        cells = [found(float(value), words) for value in values]
        return [plain_text(quantity.symbol), *cells]

    places = []
    for name in moving_points(solution):
        place = solution.points[name].place
        for axis, values in (("x", place.real), ("y", place.imag)):
            cells = [_place(solution, float(value), words) for value in values]
            places.append([plain_text(f"{axis}_{{{name}}}"), *cells])
    speeds = told(solution, QuantityKind.VELOCITY, QuantityKind.OMEGA)
    changes = told(solution, QuantityKind.ACCELERATION, QuantityKind.EPSILON)
    v, a = ([column(q, solution.exact(q)) for q in each] for each in (speeds, changes))
    read_v, read_a = (
        [column(q, solution.read_off(q.label)) for q in each] for each in (speeds, changes)
    )
    errors = []
    for quantity in (*speeds, *changes) if sigmas.asked else ():
        cells = [sigmas.cell(quantity.label, i)[0] for i in range(len(solution.positions))]
        errors.append([plain_text(quantity.symbol), *levelled(cells)])
    lines: list[str] = []
    for title, columns in (
        (words.many_places, places),
        (words.many_velocities, v),
        (words.many_by_hand.format(title=words.many_velocities), read_v),
        (words.many_accelerations, a),
        (words.many_by_hand.format(title=words.many_accelerations), read_a),
        (words.many_forces, _many_forces(solution, words)),
        (words.many_sigmas, errors),
    ):
        if columns:
            lines += [*([""] if lines else []), title, *columns_text([*lead, *columns], len(lead))]
        if columns and title == words.many_forces:
            lines += _resultants(solution, words)
    return lines
