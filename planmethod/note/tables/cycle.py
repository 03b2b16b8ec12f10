"""Tables of the crank's cycle: by positions, and the errors of the diagrams (таблицы цикла)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from planmethod.note.document import (
    Caption,
    Chapter,
    Node,
    Paragraph,
    Step,
    steps_of,
    table_of_quantities,
)
from planmethod.note.narrate.cycle import (
    acceleration_parts,
    cycle_facts,
    diagram_steps,
    extreme_steps,
    output_symbol,
)
from planmethod.note.numbers import format_column, in_heads, is_noise, significant
from planmethod.note.wording import Language
from planmethod.problem.machine_records import (
    OF_LINKS,
    OF_POINTS,
    Differentiation,
    GraphQuantity,
    graph_quantities,
)
from planmethod.problem.quantities import TRANSFERS, QuantityKind
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import crank_cycle_of
from planmethod.solved.turn.diagrams import (
    Deviation,
    Diagrams,
    deviations_by_hand,
    diagrams_of,
    natural_size_over,
    quantities_over,
    sigmas,
    values_over,
)
from planmethod.solved.turn.extremes import extreme_construction

Columns = list[tuple[str, str, tuple[str, ...]]]
"""Columns of a table: head (rich text), unit of SI or none, cells (rich text)."""


def cycle_columns(diagrams: Diagrams, language: Language) -> Columns:
    """Return the table of a turn by positions: the path, both transfer functions, v and a."""
    turn, notation = diagrams.cycle, language.notation
    turns = turn.output.slide is None
    symbol = output_symbol(turn.output)
    shares = diagrams.fractions[np.argsort(turn.numbers)]
    one, two = diagrams.rates(shares)
    speed, gain, even = diagrams.speeds(shares)
    index = symbol.partition("_")[2]
    kinds = OF_LINKS if turns else OF_POINTS
    place, ratio, rate, ratio_2, rate_2 = kinds
    v, a = rate.symbol, rate_2.symbol
    found: list[tuple[str, QuantityKind, str, Reals]] = [
        (symbol, place, "rad" if turns else "m", diagrams.path(shares)),
        (f"{v}_{{q}}", ratio, "" if turns else "m", one),
        (f"{a}_{{q}}", ratio_2, "" if turns else "m", two),
        (f"{v}_{index}", rate, rate.unit, speed),
    ]
    if turn.solution.problem.drive.acceleration:
        found.append((acceleration_parts(turn.output)[0], rate_2, rate_2.unit, even))
    found.append((f"{a}_{index}", rate_2, rate_2.unit, gain))
    at = turn.at(shares).tolist()
    places = (
        map(notation.crank_angle, at)
        if turn.range is None
        else (notation.number(f"{p:.2f}") for p in at)
    )
    columns: Columns = [
        (language.note.number, "", tuple(str(k) for k in range(diagrams.count))),
        ("φ", "deg", tuple(places)),
    ]
    for head, kind, unit, values in found:
        limit = natural_size_over(turn, kind)
        texts = format_column([0.0 if is_noise(x, limit) else x for x in values.tolist()])
        columns.append((head, unit, tuple(map(notation.number, texts))))
    return columns


def transfer_columns(diagrams: Diagrams, language: Language) -> Columns:
    """Return the transfer functions of all points and links by positions, exact."""
    turn = diagrams.cycle
    velocity, crank = turn.unit.construction.kinematics.velocity, turn.unit.problem.drive.link
    moving = [name for name, at in velocity.named.items() if velocity.point[at] != velocity.pole]
    omega = turn.unit.construction.kinematics.omega
    turning = [k for k in turn.unit.problem.mechanism.links if k in omega and k != crank]
    known = graph_quantities(moving, turn.unit.problem.mechanism.links, crank).values()
    chosen = [
        one
        for kind in TRANSFERS
        for one in known
        if one.kind is kind and not one.axis and one.of in (*moving, *turning)
    ]
    return _columns_over(diagrams, chosen, language)


def graph_columns(diagrams: Diagrams, language: Language) -> Columns:
    """Return what ``[cycle] graphs`` asks for by positions."""
    turn = diagrams.cycle
    return _columns_over(diagrams, quantities_over(turn, turn.task.graphs), language)


def _columns_over(
    diagrams: Diagrams, chosen: Sequence[GraphQuantity], language: Language
) -> Columns:
    turn, notation = diagrams.cycle, language.notation
    at = turn.at(diagrams.fractions[np.argsort(turn.numbers)])
    columns = cycle_columns(diagrams, language)[:2]
    for one in chosen:
        texts = format_column(values_over(turn, one, at).tolist())
        columns.append((one.symbol, one.unit, tuple(map(notation.number, texts))))
    return columns


def deviation_columns(
    diagrams: Diagrams,
    language: Language,
    methods: Sequence[Differentiation] = tuple(Differentiation),
) -> Columns:
    """Return the errors of v and a by several methods: drawn exactly, and with the ruler."""
    texts, notation = language.cycle, language.notation
    exactly, ruled = deviations_by_hand(diagrams, tuple(methods))
    rows: list[tuple[str, str, Deviation | None, Deviation]] = [
        (texts["ways"][way.value], letter, exactly[way, letter], ruled[way, letter])
        for way in methods
        for letter in "va"
    ]
    if diagrams.plans is not None:
        for letter, off in zip("va", diagrams.plans, strict=True):
            rows.append((texts.from_plans, letter, None, off))

    told = []
    for way in methods:  # a curve that is drawn by eye has no stroke of a known error
        spread = () if way is Differentiation.CURVE else sigmas(diagrams, way)
        told += [notation.number(significant(float(np.sqrt(np.nanmean(x**2))), 2)) for x in spread]
    told += ["—"] * (len(rows) - len(told))

    def column(number: int, name: str) -> tuple[str, ...]:
        found = [row[number] for row in rows]
        return tuple(
            notation.number(significant(getattr(one, name), 3))
            if isinstance(one, Deviation)
            else "—"
            for one in found
        )

    return [
        (texts.way, "", tuple(row[0] for row in rows)),
        (texts.diagram, "", tuple(row[1] for row in rows)),
        (texts["greatest"][0].format(), "", column(2, "maximum")),
        (texts["mean"][0].format(), "", column(2, "rms")),
        (texts["greatest"][1].format(), "", column(3, "maximum")),
        (texts["mean"][1].format(), "", column(3, "rms")),
        (texts.sigma, "", tuple(told)),
    ]


def deviations_title(solution: Solution, language: Language) -> str:
    """Return what the table of deviations is called."""
    return language.cycle.deviations.format(
        ruler=language.notation.as_input(solution.profile.ruler)
    )


def cycle_tables(solution: Solution, language: Language) -> Iterator[Node]:
    """Yield the turn: facts, table by positions, deviations."""
    turn, diagrams, texts = crank_cycle_of(solution), diagrams_of(solution), language.cycle
    yield Chapter(str(texts["title"][turn.solution.problem.drive.mover]), numbered=False)
    yield Paragraph("; ".join(cycle_facts(turn, language)) + ".")
    for title, columns in (
        (texts.table, cycle_columns(diagrams, language)),
        (texts.transfers, transfer_columns(diagrams, language)),
        *([(texts.asked, graph_columns(diagrams, language))] if turn.task.graphs else ()),
        (deviations_title(solution, language), deviation_columns(diagrams, language)),
    ):
        yield Caption(title)
        yield table_of_quantities(in_heads(columns, language.notation), repeated=2)


def cycle_steps(solution: Solution, language: Language) -> Iterator[Step]:
    """Yield how extremes and diagrams of a turn are made, and what they give."""
    diagrams = diagrams_of(solution)
    made = extreme_construction(solution)
    return steps_of(
        [*extreme_steps(diagrams.cycle, made, language), *diagram_steps(diagrams, language)]
    )
