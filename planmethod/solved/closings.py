"""Which of the two closings of a group is meant (способ сборки групп).

A rule compares the two candidate places of its point; the side it picks at the first asked
position of the file that can be assembled (without any, at the first of 0, 10, ... degrees)
holds for every position, or tells which branch of the
motion is kept. So a position computed alone and the same one in a batch agree, and no closing
depends on the one before it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import partial
from typing import assert_never

import numpy as np
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import evaluate
from planmethod.construct.program import Program
from planmethod.construct.steps import PointName
from planmethod.errors import Fault, ProblemError
from planmethod.languages import say
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import Prismatic, Revolute
from planmethod.mechanism.structure import Structure, analyse
from planmethod.plans.build import Construction, build, draw_positions
from planmethod.plans.closing import Closing
from planmethod.plans.draft import Draft, cis
from planmethod.plans.motion.position import (
    has_two_closings,
    inner_point,
    lead_point,
    parallelogram,
)
from planmethod.problem.model import Problem, Rule, Where
from planmethod.problem.names import told_length, told_place
from planmethod.solved.changes import changes
from planmethod.solved.failures import Cause, Failure, Place, PositionError
from planmethod.solved.impossible import explain
from planmethod.solved.reading import Complexes, Reading, Reals

_Tried = tuple[Draft, Program, Reading]  # a closing of a group, and how it turned out

TIE = 1e-9
"""Share of the mechanism's size below which two closings are the same."""


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

    It is made once for a problem: positions, scales and hands are readings of it.

    Raises
    ------
    StructureError, ProblemError, AssemblyError
        When the mechanism cannot be analysed or assembled.
    """
    structure = analyse(problem.mechanism)
    return build(problem, structure, choose_closings(problem, structure))


def choose_closings(problem: Problem, structure: Structure) -> dict[tuple[str, ...], Closing]:
    """Return the closing of every group that has two.

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
    for group in structure.groups:
        placed = draw_positions(problem, done, choice).points()
        own = {point: None for link in group.links for point in problem.bodies[link].points}
        mine = [
            _from_joint(problem, group, rules[point])
            for point in own
            if point in rules and point not in placed
        ]
        used.update(rule.point for rule in mine)
        done.append(group)
        if not has_two_closings(group):
            continue
        choice[group.links] = Closing()
        both = [
            _try(problem, done, {**choice, group.links: Closing(sign)}, positions)
            for sign in (1, -1)
        ]
        late = [_late(rule, both[0][0]) for rule in mine] + [
            _unkept(problem, rule, group) for rule in mine
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
                        _said(rule, problem.unit),
                        _said(mine[0], problem.unit),
                        ", ".join(group.links),
                    ),
                    "Keep the one that is meant",
                )
                for rule, closing in zip(mine, judged, strict=True)
                if closing.side != judged[0].side
            ]
        else:
            untold = _untold(problem, group) if group.signature == "RPR" else None
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


def _late(rule: Rule, draft: Draft) -> Fault | None:
    """Return the fault of a rule that compares with a point which is placed only later."""
    missing = [name for name in rule.refs if name not in draft.points()]
    if not missing:
        return None
    return Fault(
        f"assembly.{rule.point}",
        say(
            "{} is placed after {}, so it cannot tell its place",
            say(" and ").join(missing),
            rule.point,
        ),
        "Compare with a fixed point or with one that an earlier group places",
    )


def _unkept(problem: Problem, rule: Rule, group: AssurGroup) -> Fault | None:
    """Return the fault of a rule that asks to keep what its group cannot keep."""
    path, links = f"assembly.{rule.point}.keep", ", ".join(group.links)
    if rule.continuous and group.signature == "RPR":
        return Fault(
            path,
            say("links {} close by a slotted link, which keeps its side", links),
            'Leave keep = "continuous" out',
        )
    if rule.where is not Where.PARALLEL:
        return None
    found = parallelogram(problem, group) if group.signature == "RRR" else None
    if found is None:
        return Fault(
            path,
            say("links {} are no two sides of a quadrilateral of four joints", links),
            'Leave keep = "parallel" out, and say which closing is meant',
        )
    if found.is_one:
        return None
    said = "; ".join(
        say(
            "{} = {} and {} = {}",
            one,
            told_length(a, problem.unit, 10),
            two,
            told_length(b, problem.unit, 10),
        )
        for (one, a), (two, b) in (found.sides[:2], found.sides[2:])
    )
    return Fault(
        path,
        say("the opposite sides of a parallelogram are equal, and here {}", said),
        'Correct the lengths, or say keep = "continuous" with the closing that is meant',
    )


def _going_on(problem: Problem, tried: _Tried, group: AssurGroup, closing: Closing) -> Closing:
    """Return a closing that changes sides where the motion goes through a change point."""
    draft, program, _ = tried
    turn, low = problem.drive.coordinate.turn, closing.start
    high = low + turn
    if not problem.drive.is_crank:
        way = sum(abs(length) for _, _, length in problem.lengths)
        low, high, turn = low - way, low + way, closing.turn
    found = changes(draft, program, lambda s: drive_data(problem, draft, s), group, low, high)
    return replace(closing, changes=found, turn=turn)


def _try(
    problem: Problem,
    groups: list[AssurGroup],
    choice: Mapping[tuple[str, ...], Closing],
    positions: Reals,
) -> _Tried:
    draft = draw_positions(problem, groups, choice)
    program = draft.b.program()
    return draft, program, _read(draft, program, positions)


def _read(draft: Draft, program: Program, positions: Reals) -> Reading:
    data = drive_data(draft.problem, draft, positions)
    return Reading(evaluate(program, data, Float64()), len(positions))


def _score(rule: Rule, draft: Draft, reading: Reading) -> Reals:
    """Return how well a closing satisfies a rule, m or m²: the larger the better, > 0 satisfied."""

    def at(name: str) -> Complexes:
        return reading.point(PointName(name))

    p = at(rule.point)
    match rule.where:
        case Where.RIGHT:
            return np.asarray((p - at(rule.refs[0])).real)
        case Where.LEFT:
            return np.asarray((at(rule.refs[0]) - p).real)
        case Where.ABOVE:
            return np.asarray((p - at(rule.refs[0])).imag)
        case Where.BELOW:
            return np.asarray((at(rule.refs[0]) - p).imag)
        case Where.LEFT_OF | Where.RIGHT_OF:
            start, end = at(rule.refs[0]), at(rule.refs[1])
            left = ((end - start).conjugate() * (p - start)).imag / abs(end - start)
            return np.asarray(left if rule.where is Where.LEFT_OF else -left)
        case Where.TOWARDS | Where.AWAY:
            end, start = at(rule.refs[0]), at(rule.refs[1])
            ahead = ((end - start).conjugate() * (p - start)).real / abs(end - start)
            return np.asarray(ahead if rule.where is Where.TOWARDS else -ahead)
        case Where.NEAR:
            return np.asarray(-abs(p - (rule.at - draft.origin)))
        case Where.PARALLEL:
            return np.full(np.shape(p), np.nan)  # which of the sides it is changes with the crank
        case _:
            assert_never(rule.where)


def _said(rule: Rule, unit: str) -> str:
    """Return a rule in the words of the file: ``C right of B``, ``C left of AD``."""
    match rule.where:
        case Where.NEAR:
            return say("{} near [{}]", rule.point, told_place(rule.at, unit))
        case Where.PARALLEL:
            return say("{} keep parallel", rule.point)
        case Where.TOWARDS | Where.AWAY:
            return f"{rule.point} {rule.where.value} {rule.refs[0]}"
        case Where.ABOVE | Where.BELOW:
            words = rule.where.value
        case _:
            words = f"{rule.where.value.removesuffix(' of')} of"
    return f"{rule.point} {words} {''.join(rule.refs)}"


def _judge(
    problem: Problem,
    rule: Rule,
    both: list[_Tried],
    positions: Reals,
) -> Closing:
    """Return the side that a rule asks for in the first position that tells the closings apart."""
    scores = [_score(rule, draft, reading) for draft, _, reading in both]
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
    said = _said(rule, problem.unit)
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
        raise ProblemError(problem.name, [_ambiguous(rule, both, first, place.driver)])
    if rule.where is not Where.NEAR and max(plus, minus) <= 0:
        missed = (-plus, -minus)
        raise PositionError(Failure(Cause.NEITHER, place, said, (rule.point,), missed))
    return Closing(1 if plus > minus else -1, start=float(positions[first]))


def _ambiguous(rule: Rule, both: list[_Tried], index: int, where: str) -> Fault:
    """Return the fault of a rule that both closings satisfy, with one that tells them apart."""
    draft = both[0][0]
    unit = draft.problem.unit
    places = [
        told_place(complex(reading.point(PointName(rule.point))[index]) + draft.origin, unit)
        for _, _, reading in both
    ]
    told = _telling(rule.point, both, slice(index, index + 1))
    words = told or [f"{{ near = [{place}] }}" for place in places]
    return Fault(
        f"assembly.{rule.point}",
        say(
            "'{}' holds for both closings at {}: with {} at ({}) and at ({}) {}",
            _said(rule, unit),
            where,
            rule.point,
            *places,
            say(unit),
        ),
        say("Say '{}' for the first or '{}' for the second", words[0], words[1]),
        tuple(told),
    )


def _telling(point: str, both: list[_Tried], asked: slice) -> list[str]:
    """Return the rules, one for each closing, that tell them apart widest in all asked positions.

    Empty where none does: neither beside a point that does not depend on the closing, nor beside a
    line through two of them.
    """

    def at(reading: Reading, name: str) -> Complexes:
        return reading.point(PointName(name))[asked]

    def least(first: Complexes, second: Complexes) -> float:
        sides = np.minimum(first.real, second.real)
        return float(np.nanmin(sides)) if np.isfinite(sides).any() else 0.0

    (draft, _, one), (_, _, two) = both
    c, d = at(one, point), at(two, point)
    still = [
        p
        for p in sorted(draft.points())
        if p != point and np.array_equal(at(one, p), at(two, p), equal_nan=True)
    ]
    ways = (("right of", "left of", 1), ("above", "below", -1j))
    told = [
        (width, f"{more} {p}", f"{less} {p}")
        for p in still
        for first, second, turn in ways
        for more, less, sign in ((first, second, turn), (second, first, -turn))
        if (width := least((c - at(one, p)) * sign, (at(one, p) - d) * sign)) > 0
    ]
    # No point is between them: a line through two points may be.
    told = told or [
        (width, f"left of {p}{q}", f"right of {p}{q}")
        for p in still
        for q in still
        if (along := at(one, q) - at(one, p)).all()
        and (width := least((c - at(one, p)) / along / 1j, (at(one, p) - d) / along / 1j)) > 0
    ]
    return list(max(told, key=lambda pair: pair[0])[1:]) if told else []


def _places(problem: Problem, both: list[_Tried], at: int) -> Iterator[complex]:
    for _, _, reading in both:
        for body in problem.bodies.values():
            for point in body.points:
                if point in reading.value:
                    place = complex(reading.point(PointName(point))[at])
                    if math.isfinite(place.real):
                        yield place
    yield 1e-300 + 0j


def _outer(problem: Problem, group: AssurGroup, point: str) -> str | None:
    """Return the outer joint of a group on the link that a point belongs to."""
    for lead in group.leads:
        if isinstance(lead.joint, Revolute) and point in problem.bodies[lead.link].points:
            return lead.joint.point
    return None


def _from_joint(problem: Problem, group: AssurGroup, rule: Rule) -> Rule:
    """Return a rule that tells the way from a joint with that joint beside its point."""
    if rule.where not in (Where.TOWARDS, Where.AWAY):
        return rule
    joint = _outer(problem, group, rule.point)
    if joint is None or joint in (rule.point, *rule.refs):
        hint = "Compare with another point: right of, left of, above, below"
        said = _said(rule, problem.unit)
        message = say("'{}': there is no way from the joint {} to tell", said, joint or "")
        raise ProblemError(problem.name, [Fault(f"assembly.{rule.point}", message, hint)])
    return replace(rule, refs=(*rule.refs, joint))


def _untold(problem: Problem, group: AssurGroup) -> Rule | None:
    """Return what a slotted link does not tell: whether a point of it lies towards the other joint.

    None where the line runs on from the joint of its link, so that the stone is on that ray, and
    where nothing could lie on the other side: of a block and of a stone alone.
    """
    inner = group.inner[0]
    assert isinstance(inner, Prismatic)
    slide = problem.slides[inner.slider]
    ends = {lead.link: lead_point(lead) for lead in group.leads}
    host = problem.bodies[slide.host].points
    runs_on = ((slide.base - host[ends[slide.host]]) / cis(slide.angle)).real >= 0.0
    for link, other in ((slide.host, slide.slider), (slide.slider, slide.host)):
        joint, body = ends[link], problem.bodies[link].points
        if runs_on and (link == slide.host or len(host) > 1):
            continue
        for point in (point for point, at in body.items() if at != body[joint]):
            return Rule(point, Where.TOWARDS, (ends[other], joint))
    return None


def _missing(group: AssurGroup, both: list[_Tried], positions: Reals, untold: Rule | None) -> Fault:
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
    words = [] if untold else _telling(c, both, slice(None))
    if untold is not None:
        ahead = [_score(untold, draft, reading) for draft, _, reading in both]
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
