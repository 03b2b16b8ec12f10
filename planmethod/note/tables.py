"""Result tables for the terminal (таблицы результатов)."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from planmethod.note.formulas import UNIT
from planmethod.note.given import asked_links, asked_points
from planmethod.note.naming import SCALE_SYMBOL, Names
from planmethod.note.plaintext import (
    columns_text,
    fixed,
    found,
    given,
    heading,
    plain_text,
    table,
    wrap,
)
from planmethod.note.wording import Wording, wording
from planmethod.plans.model import PlanKind
from planmethod.plans.solution import Segment, Solution
from planmethod.problem.model import Convention

FEW = 3
"""Most positions that are shown each with tables of its own."""


def result_tables(solution: Solution, lang: str = "ru") -> str:
    """Return the results of a solution as aligned text of at most 100 columns.

    Up to three positions have tables of their own; more are rows of common tables.

    Raises
    ------
    UnknownLanguageError
    """
    words = wording(lang)
    name = solution.problem.title or solution.problem.name
    variant = f" ({solution.problem.variant})" if solution.problem.variant else ""
    lines = wrap(name + variant)
    lines += wrap(words.formula.format(formula=solution.structure.formula), rest="  ")
    lines += wrap(f"{words.scales}: {'; '.join(scale_texts(solution, words))}", rest="  ")
    if len(solution.positions) > FEW:
        lines += ["", *_many(solution, words)]
    else:
        for index in range(len(solution.positions)):
            lines += ["", *heading(position_line(solution, words, index)), ""]
            lines += position_tables(solution, words, index)
    ruler = given(solution.hand.ruler, words)
    lines += ["", *wrap(words.hand_note.format(ruler=ruler)), words.sense_note]
    return "\n".join(lines)


def scale_texts(solution: Solution, words: Wording) -> list[str]:
    """Return the scales as ``μ_v = 0,05 (м/с)/мм``, or in mm per unit where the file says so."""
    texts = []
    for kind, scale in solution.scales.items():
        unit, mm = words.units[UNIT[kind]], words.units["mm"]
        inner = f"({unit})" if "/" in unit else unit
        if solution.problem.scales.convention is Convention.MM_PER_UNIT:
            value, per = 1.0 / scale.per_mm, f"{mm}/{inner}"
        else:
            value, per = scale.per_mm, f"{inner}/{mm}"
        texts.append(f"{SCALE_SYMBOL[kind]} = {given(value, words)} {per}")
    return texts


def position_line(solution: Solution, words: Wording, index: int) -> str:
    """Return which position is told: its number and the driver's place."""
    drive = solution.problem.drive
    template = words.position_crank if drive.is_crank else words.position_slider
    return template.format(
        number=index + 1,
        count=len(solution.positions),
        symbol=plain_text(f"φ_{{{drive.link}}}") if drive.is_crank else "s",
        value=given(float(solution.positions[index]), words),
    )


# One position ----------------------------------------------------------------------------------


def position_tables(solution: Solution, words: Wording, index: int) -> list[str]:
    """Return the tables of one position: points, links, sliding, segments of the plans."""
    parts = [
        (words.table_points, table(words.columns_points, _points(solution, words, index))),
        (words.table_links, table(words.columns_links, _links(solution, words, index))),
    ]
    sliding = _sliding(solution, words, index)
    if sliding:
        parts.append((words.table_sliding, table(words.columns_sliding, sliding)))
    titles = {
        PlanKind.POSITION: words.plan_position,
        PlanKind.VELOCITY: words.plan_velocity,
        PlanKind.ACCELERATION: words.plan_acceleration,
    }
    names = Names(solution, words)
    for kind, scale in zip(PlanKind, scale_texts(solution, words), strict=True):
        title = words.table_segments.format(
            plan=titles[kind][:1].lower() + titles[kind][1:], scale=scale
        )
        rows = _segments(solution, names, kind, index)
        if kind is PlanKind.POSITION:
            header = words.columns_lengths
            lines = table(header, rows)
        else:
            unit = words.units[UNIT[kind]]
            header = tuple(text.format(unit=unit) for text in words.columns_vectors)
            lines = table(header, rows, left=2)
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


def _points(solution: Solution, words: Wording, i: int) -> list[list[str]]:
    rows = []
    for name in moving_points(solution):
        point, (v, a) = solution.points[name], solution.by_hand_results.points[name]
        place = point.place[i]
        values = (abs(point.velocity[i]), v[i], abs(point.acceleration[i]), a[i])
        x, y = (_place(float(value), words) for value in (place.real, place.imag))
        rows.append([name, x, y, *(found(float(value), words) for value in values)])
    return rows


def _place(metres: float, words: Wording) -> str:
    return found(metres, words)


def _links(solution: Solution, words: Wording, i: int) -> list[list[str]]:
    rows = []
    for name, link in solution.links.items():
        omega, epsilon = solution.by_hand_results.links[name]
        row = [name, fixed(float(link.phi_deg[i]), words)]
        for exact, read in ((link.omega[i], omega[i]), (link.epsilon[i], epsilon[i])):
            row += [found(float(exact), words), found(float(read), words), _sense(exact, words)]
        rows.append(row)
    return rows


def _sense(value: float, words: Wording) -> str:
    if abs(value) < 1e-12:
        return "—"
    return words.ccw if value > 0 else words.cw


def _sliding(solution: Solution, words: Wording, i: int) -> list[list[str]]:
    rows = []
    hand = solution.by_hand_results.relatives
    for relative, read in zip(solution.relatives, hand, strict=True):
        row = [words.sliding_row.format(point=relative.point, of=relative.of, to=relative.to)]
        exact = (relative.velocity, relative.coriolis, relative.acceleration)
        for vector, length in zip(exact, read, strict=True):
            row += [found(abs(complex(vector[i])), words), found(float(length[i]), words)]
        rows.append(row)
    return rows


def _segments(solution: Solution, names: Names, kind: PlanKind, i: int) -> list[list[str]]:
    words, rows = names.words, []
    segments = solution.segments(kind)
    if kind is PlanKind.POSITION:
        return [[_joined(s), *_lengths(s, words, i)] for s in segments]
    mu = solution.scales[kind].per_mm
    for vector, segment in zip(solution.construction.plan(kind).vectors, segments, strict=True):
        value = found(mu * float(segment.read[i]), words)
        name = names.segment(vector.tail, vector.head)
        rows.append([plain_text(vector.symbol), name, *_lengths(segment, words, i), value])
    return rows


def _joined(segment: Segment) -> str:
    return segment.name.replace("-", "")


def _lengths(segment: Segment, words: Wording, i: int) -> list[str]:
    exact, read = float(segment.exact[i]), float(segment.read[i])
    return [fixed(exact, words), given(read, words)]


# Many positions --------------------------------------------------------------------------------


def _many(solution: Solution, words: Wording) -> list[str]:
    """Return tables with a row for each position."""
    drive, hand = solution.problem.drive, solution.by_hand_results
    symbol = plain_text(f"φ_{{{drive.link}}}, °") if drive.is_crank else f"s, {words.units['m']}"
    lead = [
        [words.number, *(str(i + 1) for i in range(len(solution.positions)))],
        [symbol, *(given(float(p), words) for p in solution.positions)],
    ]
    points, links = asked_points(solution), asked_links(solution)

    def column(head: str, values: Iterable[float]) -> list[str]:
        return [plain_text(head), *(found(float(value), words) for value in values)]

    places = []
    for name in moving_points(solution):
        place = solution.points[name].place
        places += [column(f"x_{{{name}}}", place.real), column(f"y_{{{name}}}", place.imag)]
    v = [column(f"v_{{{p}}}", np.abs(solution.points[p].velocity)) for p in points]
    v += [column(f"ω_{{{k}}}", solution.links[k].omega) for k in links]
    a = [column(f"a_{{{p}}}", np.abs(solution.points[p].acceleration)) for p in points]
    a += [column(f"ε_{{{k}}}", solution.links[k].epsilon) for k in links]
    read_v = [column(f"v_{{{p}}}", hand.points[p][0]) for p in points]
    read_v += [column(f"ω_{{{k}}}", hand.links[k][0]) for k in links]
    read_a = [column(f"a_{{{p}}}", hand.points[p][1]) for p in points]
    read_a += [column(f"ε_{{{k}}}", hand.links[k][1]) for k in links]
    lines: list[str] = []
    for title, columns in (
        (words.many_places, places),
        (words.many_velocities, v),
        (words.many_by_hand.format(title=words.many_velocities), read_v),
        (words.many_accelerations, a),
        (words.many_by_hand.format(title=words.many_accelerations), read_a),
    ):
        if columns:
            lines += [*([""] if lines else []), title, *columns_text([*lead, *columns], len(lead))]
    return lines
