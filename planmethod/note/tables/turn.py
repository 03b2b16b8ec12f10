"""Tables of the crank's cycle: by positions, and the errors of the diagrams (таблицы цикла)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from planmethod.construct.hand import Hand
from planmethod.note.document import (
    Caption,
    Chapter,
    Node,
    Paragraph,
    Step,
    steps_of,
    table_of_quantities,
)
from planmethod.note.narrate.turn import (
    acceleration_parts,
    diagram_steps,
    extreme_steps,
    output_symbol,
    turn_facts,
)
from planmethod.note.numbers import alike, in_heads, significant
from planmethod.note.wording import Language
from planmethod.problem.cycle_records import Differentiation
from planmethod.problem.graphs import GraphQuantity, graph_quantities
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution
from planmethod.solved.turn.construction import extreme_construction
from planmethod.solved.turn.diagrams import Deviation, Diagrams, deviations, diagrams_of, sigmas
from planmethod.solved.turn.series import quantities_over, values_over
from planmethod.solved.turn.turn import turn_of

Columns = list[tuple[str, str, tuple[str, ...]]]
"""Columns of a table: head (rich text), unit of SI or none, cells (rich text)."""


def cycle_columns(diagrams: Diagrams, words: Language) -> Columns:
    """Return the table of a turn by positions: the path, both transfer functions, v and a."""
    turn, say = diagrams.turn, words.say
    turns = turn.output.slide is None
    symbol = output_symbol(turn.output)
    shares = diagrams.shares[np.argsort(turn.numbers)]
    one, two = diagrams.rates(shares)
    speed, gain, even = diagrams.speeds(shares)
    index = symbol.partition("_")[2]
    v, a = ("ω", "ε") if turns else ("v", "a")
    units = ("1/s", "1/s²") if turns else ("m/s", "m/s²")
    found: list[tuple[str, str, Reals]] = [
        (symbol, "rad" if turns else "m", diagrams.path(shares)),
        (f"{v}_{{q}}", "" if turns else "m", one),
        (f"{a}_{{q}}", "" if turns else "m", two),
        (f"{v}_{index}", units[0], speed),
    ]
    if turn.solution.problem.drive.acceleration:
        found.append((acceleration_parts(turn.output)[0], units[1], even))
    found.append((f"{a}_{index}", units[1], gain))
    at = turn.at(shares).tolist()
    places = map(say.turned, at) if turn.range is None else (say.number(f"{p:.2f}") for p in at)
    columns: Columns = [
        (words.note.number, "", tuple(str(k) for k in range(diagrams.count))),
        ("φ", "deg", tuple(places)),
    ]
    for head, unit, values in found:
        peak = float(np.nanmax(np.abs(values), initial=0.0))
        texts = alike([0.0 if abs(x) <= 1e-9 * peak else float(x) for x in values])
        columns.append((head, unit, tuple(map(say.number, texts))))
    return columns


def transfer_columns(diagrams: Diagrams, words: Language) -> Columns:
    """Return the transfer functions of all points and links by positions, exact."""
    turn = diagrams.turn
    velocity, crank = turn.unit.construction.kinematics.velocity, turn.unit.problem.drive.link
    moving = [name for name, at in velocity.named.items() if velocity.point[at] != velocity.pole]
    omega = turn.unit.construction.kinematics.omega
    turning = [k for k in turn.unit.problem.mechanism.links if k in omega and k != crank]
    known = graph_quantities(moving, turn.unit.problem.mechanism.links, crank).values()
    chosen = [
        one
        for kind in ("v_q", "u", "a_q", "epsilon_q")
        for one in known
        if one.kind == kind and not one.axis and one.of in (*moving, *turning)
    ]
    return _columns_over(diagrams, chosen, words)


def graph_columns(diagrams: Diagrams, words: Language) -> Columns:
    """Return what ``[cycle] graphs`` asks for by positions."""
    turn = diagrams.turn
    return _columns_over(diagrams, quantities_over(turn, turn.task.graphs), words)


def _columns_over(diagrams: Diagrams, chosen: Sequence[GraphQuantity], words: Language) -> Columns:
    turn, say = diagrams.turn, words.say
    at = turn.at(diagrams.shares[np.argsort(turn.numbers)])
    columns = cycle_columns(diagrams, words)[:2]
    for one in chosen:
        values = values_over(turn, one, at)
        peak = float(np.nanmax(np.abs(values), initial=0.0))
        texts = alike([0.0 if abs(x) <= 1e-9 * peak else float(x) for x in values])
        columns.append((one.symbol, one.unit, tuple(map(say.number, texts))))
    return columns


def deviation_columns(
    diagrams: Diagrams, words: Language, ways: Sequence[Differentiation] = tuple(Differentiation)
) -> Columns:
    """Return the errors of v and a by several methods: drawn exactly, and with the ruler."""
    said, say = words.cycle, words.say
    hand = Hand(ruler=diagrams.turn.solution.profile.ruler)
    exactly, ruled = deviations(diagrams, ways), deviations(diagrams, ways, hand)
    rows: list[tuple[str, str, Deviation | None, Deviation]] = [
        (said["ways"][way.value], letter, exactly[way, letter], ruled[way, letter])
        for way in ways
        for letter in "va"
    ]
    if diagrams.plans is not None:
        for letter, off in zip("va", diagrams.plans, strict=True):
            rows.append((said.from_plans, letter, None, off))

    told = []
    for way in ways:  # a curve that is drawn by eye has no stroke of a known error
        spread = () if way is Differentiation.CURVE else sigmas(diagrams, way)
        told += [say.number(significant(float(np.sqrt(np.nanmean(x**2))), 2)) for x in spread]
    told += ["—"] * (len(rows) - len(told))

    def column(number: int, name: str) -> tuple[str, ...]:
        found = [row[number] for row in rows]
        return tuple(
            say.number(significant(getattr(one, name), 3)) if isinstance(one, Deviation) else "—"
            for one in found
        )

    return [
        (said.way, "", tuple(row[0] for row in rows)),
        (said.diagram, "", tuple(row[1] for row in rows)),
        (said["greatest"][0].format(), "", column(2, "most")),
        (said["mean"][0].format(), "", column(2, "rms")),
        (said["greatest"][1].format(), "", column(3, "most")),
        (said["mean"][1].format(), "", column(3, "rms")),
        (said.sigma, "", tuple(told)),
    ]


def deviations_title(solution: Solution, words: Language) -> str:
    """Return what the table of deviations is called."""
    return words.cycle.deviations.format(ruler=words.say.given(solution.profile.ruler))


def cycle_tables(solution: Solution, words: Language) -> Iterator[Node]:
    """Yield the turn: facts, table by positions, deviations."""
    turn, diagrams, said = turn_of(solution), diagrams_of(solution), words.cycle
    yield Chapter(str(said["title"][turn.solution.problem.drive.mover]), numbered=False)
    yield Paragraph("; ".join(turn_facts(turn, words)) + ".")
    for title, columns in (
        (said.table, cycle_columns(diagrams, words)),
        (said.transfers, transfer_columns(diagrams, words)),
        *([(said.asked, graph_columns(diagrams, words))] if turn.task.graphs else ()),
        (deviations_title(solution, words), deviation_columns(diagrams, words)),
    ):
        yield Caption(title)
        yield table_of_quantities(in_heads(columns, words.say), repeated=2)


def cycle_steps(solution: Solution, words: Language) -> Iterator[Step]:
    """Yield how extremes and diagrams of a turn are made, and what they give."""
    diagrams = diagrams_of(solution)
    made = extreme_construction(solution)
    return steps_of([*extreme_steps(diagrams.turn, made, words), *diagram_steps(diagrams, words)])
