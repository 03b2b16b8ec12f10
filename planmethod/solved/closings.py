"""Which of the two closings of a group is meant (способ сборки групп).

A rule compares the two candidate places of its point; the side it picks at the first asked
position of the file that can be assembled (without any, at the first of 0, 10, ... degrees)
holds for every position, or tells which branch of the
motion is kept. So a position computed alone and the same one in a batch agree, and no closing
depends on the one before it.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Generator, Iterator, Mapping
from functools import partial

import numpy as np
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import evaluate
from planmethod.construct.program import Program
from planmethod.construct.steps import PointName
from planmethod.errors import Fault, ProblemError
from planmethod.languages import say
from planmethod.mechanism.groups import AssurGroup, triad_of
from planmethod.mechanism.structure import Structure, analyse
from planmethod.plans.build import Construction, build, draw_more, draw_positions
from planmethod.plans.closing import Closing
from planmethod.plans.draft import Draft
from planmethod.plans.motion.position import (
    has_two_closings,
    inner_point,
)
from planmethod.problem.model import Problem, Rule, Where
from planmethod.problem.names import told_length, told_place
from planmethod.solved.assemblies import Assembled, best_third, choose
from planmethod.solved.changes import changes
from planmethod.solved.failures import Cause, Failure, Place, PositionError
from planmethod.solved.impossible import explain
from planmethod.solved.reading import Reading, Reals
from planmethod.solved.rules import (
    TIE,
    Tried,
    ambiguous_fault,
    from_joint,
    late_fault,
    rule_text,
    score_of,
    slotted_rule,
    telling_rules,
    unkept_fault,
)


def drive_data(
    problem: Problem, draft: Draft, positions: Reals
) -> dict[str, complex | float | Reals]:
    """Return the data of a program at unit scales: a millimetre of the plan is then a metre."""
    drive = problem.drive
    data: dict[str, complex | float | Reals] = dict(draft.numbers)
    data.update(draft.places)
    data.update({name: one.branch(positions) for name, one in draft.branches.items()})
    data.update(mu_l=1.0, mu_v=1.0, mu_a=1.0)
    data[drive.coordinate.name] = positions
    data.update(zip(drive.coordinate.rates, (drive.rate, drive.acceleration), strict=True))
    return data


def construct(problem: Problem) -> Construction:
    """Return the construction of a problem: its groups, their closings, its plans as one program.

    It is made once for a problem: positions, scales and hands are readings of it. That of the last
    few problems is kept: a command looks at one more than once.

    Raises
    ------
    StructureError, ProblemError, AssemblyError
        When the mechanism cannot be analysed or assembled.
    """
    for known, made in _KEPT:
        if known is problem:
            return made
    structure = analyse(problem.mechanism)
    made = build(problem, structure, choose_closings(problem, structure))
    _KEPT.append((problem, made))
    return made


_KEPT: deque[tuple[Problem, Construction]] = deque(maxlen=2)
"""The last problems, each itself and no other like it, and what is drawn of them."""


Wanted = tuple[Draft, Program, Reals]
"""A reading that is wanted: what is drawn, its program, the positions of the driver."""

Choosing = Generator[Wanted, Reading, dict[tuple[str, ...], Closing]]


def choose_closings(problem: Problem, structure: Structure) -> dict[tuple[str, ...], Closing]:
    """Return the closing of every group that has two: see `choosing`."""
    choice = choosing(problem, structure)
    try:
        wanted = next(choice)
        while True:
            wanted = choice.send(_read(*wanted))
    except StopIteration as end:
        chosen: dict[tuple[str, ...], Closing] = end.value
        return chosen


def choosing(problem: Problem, structure: Structure) -> Choosing:
    """Yield the readings that the choice of the closings wants, and return the closings.

    So one problem asks for its readings in turn, and many that are drawn alike are read together.

    Raises
    ------
    ProblemError
        When a group that needs a rule has none, a rule is about a point it cannot move, or one
        cannot be kept; all such faults at once. When both closings satisfy a rule.
    AssemblyError
        When a group closes at no asked position, or neither closing satisfies its rule.
    """
    positions = np.asarray(problem.drive.judged or problem.drive.positions, dtype=float)
    rules = {rule.point: rule for rule in problem.assembly}
    choice: dict[tuple[str, ...], Closing] = {}
    faults: list[Fault] = []
    used: set[str] = set()
    done: list[AssurGroup] = []
    drawn = draw_positions(problem, (), choice)
    for group in structure.groups:
        if done:
            drawn = draw_more(drawn, done[-1], dict(choice))
        placed = drawn.points()
        own = {point: None for link in group.links for point in problem.bodies[link].points}
        mine = [
            from_joint(problem, group, rules[point])
            for point in own
            if point in rules and point not in placed
        ]
        used.update(rule.point for rule in mine)
        done.append(group)
        if triad_of(group) is not None:
            choice[group.links], wrong = _assembled(problem, done, choice, mine, positions)
            faults += wrong
            continue
        if not has_two_closings(group):
            continue
        choice[group.links] = Closing()
        both: list[Tried] = []
        for sign in (1, -1):
            draft = draw_more(drawn, group, {**choice, group.links: Closing(sign)})
            program = draft.b.program()
            both.append((draft, program, (yield draft, program, positions)))
        late = [late_fault(rule, both[0][0]) for rule in mine] + [
            unkept_fault(problem, rule, group) for rule in mine
        ]
        if any(late):
            faults += [fault for fault in late if fault is not None]
        elif any(rule.where is Where.PARALLEL for rule in mine):
            choice[group.links] = Closing(parallel=True)
        elif mine:
            judged = [_judge(problem, rule, both, positions) for rule in mine]
            choice[group.links] = judged[0]
            if any(rule.continuous for rule in mine):
                choice[group.links] = _going_on(problem, both[0], group, judged[0])
            faults += [
                Fault(
                    f"assembly.{rule.point}",
                    say(
                        "'{}' and '{}' ask for different closings of links {}",
                        rule_text(rule, problem.unit),
                        rule_text(mine[0], problem.unit),
                        ", ".join(group.links),
                    ),
                    "Keep the one that is meant",
                )
                for rule, closing in zip(mine, judged, strict=True)
                if closing.side != judged[0].side
            ]
        else:
            untold = slotted_rule(problem, group) if group.signature == "RPR" else None
            if untold is None and group.signature == "RPR":
                continue
            try:
                faults.append(_missing(group, both, positions, untold))
            except PositionError:
                if not faults:  # else an earlier group may stand on the side that is not meant
                    raise
    for rule in problem.assembly:
        if rule.point not in used:
            faults.append(
                Fault(
                    f"assembly.{rule.point}",
                    say(
                        "{} belongs to the frame or to the driving link: it has one place",
                        rule.point,
                    ),
                    "Delete the rule, or name a point that a group places",
                )
            )
    if faults:
        raise ProblemError(problem.name, faults)
    return choice


def _assembled(
    problem: Problem,
    groups: list[AssurGroup],
    choice: Mapping[tuple[str, ...], Closing],
    rules: list[Rule],
    positions: Reals,
) -> tuple[Closing, list[Fault]]:
    """Return the assembly of a triad, the last of some groups, and what is wrong with its rules."""
    group = groups[-1]
    triad = triad_of(group)
    assert triad is not None

    def made(closing: Closing) -> Assembled:
        draft = draw_positions(problem, groups, {**choice, group.links: closing})
        program = draft.b.program()
        return Assembled(draft, program, lambda s: drive_data(problem, draft, s), group, triad)

    drawn = made(Closing())
    late = [late_fault(rule, drawn.draft) for rule in rules]
    late += [unkept_fault(problem, rule, group) for rule in rules]
    if any(late):
        return Closing(), [fault for fault in late if fault is not None]
    closing, faults = choose(drawn, rules, positions)
    if not faults:
        closing = replace(closing, third=best_third(made(closing), positions))
    return closing, faults


def _going_on(problem: Problem, tried: Tried, group: AssurGroup, closing: Closing) -> Closing:
    """Return a closing that changes sides where the motion goes through a change point."""
    draft, program, _ = tried
    turn, low = problem.drive.coordinate.turn, closing.start
    high = low + turn
    if not problem.drive.is_crank:
        way = sum(abs(length) for _, _, length in problem.lengths)
        low, high, turn = low - way, low + way, closing.turn
    found = changes(draft, program, lambda s: drive_data(problem, draft, s), group, low, high)
    return replace(closing, changes=found, turn=turn)


def _read(draft: Draft, program: Program, positions: Reals) -> Reading:
    data = drive_data(draft.problem, draft, positions)
    return Reading(evaluate(program, data, Float64()), len(positions))


def _judge(
    problem: Problem,
    rule: Rule,
    both: list[Tried],
    positions: Reals,
) -> Closing:
    """Return the side that a rule asks for in the first position that tells the closings apart."""
    scores = [score_of(rule, draft, reading) for draft, _, reading in both]
    able = np.flatnonzero(np.isfinite(scores[0]) & np.isfinite(scores[1]))
    if not able.size:
        raise PositionError(explain(*both[0], positions, partial(_read, *both[0][:2])))
    found = list(_places(problem, both, int(able[0])))[:-1]
    size = max(abs(point - found[0]) for point in found)
    one, two = (reading.point(PointName(rule.point)) for _, _, reading in both)
    apart = abs(one - two)
    # A dead position tells the closings of nothing: the next one that is asked does.
    distinct = able[apart[able] > TIE * size]
    if not distinct.size:
        place = Place.of(problem, positions, int(able[0]))
        raise PositionError(Failure(Cause.TOGETHER, place, rule.point, problem=problem.name))
    first = int(distinct[0])
    plus, minus = float(scores[0][first]), float(scores[1][first])
    place = Place.of(problem, positions, first)
    said = rule_text(rule, problem.unit)
    if abs(plus - minus) <= TIE * size:
        raise ProblemError(
            problem.name,
            [
                Fault(
                    f"assembly.{rule.point}",
                    say(
                        "'{}' does not tell the two closings apart at {}: both give {}",
                        said,
                        place.driver,
                        told_length(plus, problem.unit),
                    ),
                    "Compare with another point or with a directed line",
                )
            ],
        )
    if rule.where is not Where.NEAR and min(plus, minus) > TIE * size:
        raise ProblemError(problem.name, [ambiguous_fault(rule, both, first, place.driver)])
    if rule.where is not Where.NEAR and max(plus, minus) <= 0:
        missed = (-plus, -minus)
        raise PositionError(Failure(Cause.NEITHER, place, said, (rule.point,), missed))
    return Closing(1 if plus > minus else -1, start=float(positions[first]))


def _places(problem: Problem, both: list[Tried], at: int) -> Iterator[complex]:
    for _, _, reading in both:
        for body in problem.bodies.values():
            for point in body.points:
                if point in reading.value:
                    place = complex(reading.point(PointName(point))[at])
                    if math.isfinite(place.real):
                        yield place
    yield 1e-300 + 0j


def _missing(group: AssurGroup, both: list[Tried], positions: Reals, untold: Rule | None) -> Fault:
    """Return the fault of a group whose closing is not given, with both ways to say it.

    Raises
    ------
    PositionError
        The group closes in no position: a rule would not help.
    """
    c = inner_point(group) if untold is None else untold.point
    places = []
    for draft, _, reading in both:
        values = reading.point(PointName(c)) + draft.origin
        able = values[np.isfinite(values)]
        if not able.size:
            raise PositionError(explain(*both[0], positions, partial(_read, *both[0][:2])))
        places.append(told_place(complex(able[0]), both[0][0].problem.unit))
    hint = say(
        'Add {} = "right of ..." (or left of, above, below, or {{ near = [x, y] }}) to [assembly]',
        c,
    )
    words = [] if untold else telling_rules(c, both, slice(None))
    if untold is not None:
        ahead = [score_of(untold, draft, reading) for draft, _, reading in both]
        sides = [float(np.nansum(score)) for score in ahead]
        if sides[0] * sides[1] < 0:  # both lie to one side if far off the line
            words = [f"towards {untold.refs[0]}", f"away from {untold.refs[0]}"]
            words = words if sides[0] > 0 else words[::-1]
    if words:
        hint = say('Add {} = "{}" for the first or "{}" for the second to [assembly]', c, *words)
    return Fault(
        f"assembly.{c}",
        say(
            "links {} close in two ways, with {} at ({}) or at ({}) {}, and no rule says which",
            ", ".join(group.links),
            c,
            *places,
            say(both[0][0].problem.unit),
        ),
        hint,
        tuple(words),
    )
