"""Which of the two closings of a group is meant (способ сборки групп).

A rule compares the two candidate places of its point; the side it picks at the first asked
position of the file that can be assembled holds for every position. So a position computed alone
and the same one in a batch agree, and no closing depends on the one before it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import assert_never

import numpy as np
import numpy.typing as npt

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.program import Program
from planmethod.construct.steps import PointName
from planmethod.errors import AssemblyError, Fault, ProblemError
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.structure import Structure
from planmethod.plans.build import draw_positions
from planmethod.plans.draft import Draft
from planmethod.plans.motion.position import has_two_closings, inner_point
from planmethod.problem.model import Problem, Rule, Where
from planmethod.solved.impossible import explain

TIE = 1e-9
"""Share of the mechanism's size below which two closings are the same."""


def drive_data(
    problem: Problem, draft: Draft, positions: npt.NDArray[np.float64]
) -> dict[str, complex | float | npt.NDArray[np.float64]]:
    """Return the data of a program at unit scales: a millimetre of the plan is then a metre."""
    drive = problem.drive
    data: dict[str, complex | float | npt.NDArray[np.float64]] = dict(draft.numbers)
    data.update(draft.places)
    data.update(mu_l=1.0, mu_v=1.0, mu_a=1.0)
    if drive.is_crank:
        data["phi"] = positions
        data[f"omega_{drive.link}"] = drive.rate
        data[f"epsilon_{drive.link}"] = drive.acceleration
    else:
        data.update(s=positions, v=drive.rate, a=drive.acceleration)
    return data


def choose_closings(problem: Problem, structure: Structure) -> dict[tuple[str, ...], int]:
    """Return the closing (+1 or -1) of every group that has two.

    Raises
    ------
    ProblemError
        When a group that needs a rule has none, or a rule is about a point it cannot move; all
        such faults at once.
    AssemblyError
        When a group closes at no asked position, or neither closing satisfies its rule.
    """
    positions = np.asarray(problem.drive.positions, dtype=float)
    rules = {rule.point: rule for rule in problem.assembly}
    choice: dict[tuple[str, ...], int] = {}
    faults: list[Fault] = []
    used: set[str] = set()
    done: list[AssurGroup] = []
    for group in structure.groups:
        placed = draw_positions(problem, done, choice).points()
        own = {point: None for link in group.links for point in problem.bodies[link].points}
        mine = [rules[point] for point in own if point in rules and point not in placed]
        used.update(rule.point for rule in mine)
        done.append(group)
        if not has_two_closings(group):
            continue
        both = [_try(problem, done, {**choice, group.links: sign}, positions) for sign in (1, -1)]
        late = [_late(rule, both[0][0]) for rule in mine]
        if any(late):
            choice[group.links] = 1
            faults += [fault for fault in late if fault is not None]
        elif mine:
            signs = [_judge(problem, rule, both, positions) for rule in mine]
            choice[group.links] = signs[0]
            faults += [
                Fault(
                    f"assembly.{rule.point}",
                    f"'{_said(rule)}' and '{_said(mine[0])}' ask for different closings of links "
                    f"{', '.join(group.links)}",
                    "Keep the one that is meant",
                )
                for rule, sign in zip(mine, signs, strict=True)
                if sign != signs[0]
            ]
        elif group.signature == "RPR":
            choice[group.links] = 1
        else:
            choice[group.links] = 1
            faults.append(_missing(group, both))
    for rule in problem.assembly:
        if rule.point not in used:
            faults.append(
                Fault(
                    f"assembly.{rule.point}",
                    f"{rule.point} belongs to the frame or to the driving link: it has one place",
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
        f"{' and '.join(missing)} is placed after {rule.point}, so it cannot tell its place",
        "Compare with a fixed point or with one that an earlier group places",
    )


def _try(
    problem: Problem,
    groups: list[AssurGroup],
    choice: Mapping[tuple[str, ...], int],
    positions: npt.NDArray[np.float64],
) -> tuple[Draft, Program, Trace]:
    draft = draw_positions(problem, groups, choice)
    program = draft.b.program()
    return draft, program, evaluate(program, drive_data(problem, draft, positions), Float64())


def _score(rule: Rule, draft: Draft, trace: Trace) -> npt.NDArray[np.float64]:
    """Return how well a closing satisfies a rule, m or m²: the larger the better, > 0 satisfied."""

    def at(name: str) -> npt.NDArray[np.complex128]:
        return np.asarray(trace.value[PointName(name)], dtype=complex)

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
        case Where.NEAR:
            return np.asarray(-abs(p - (rule.at - draft.origin)))
        case _:
            assert_never(rule.where)


def _said(rule: Rule) -> str:
    """Return a rule in the words of the file: ``C right of B``, ``C left of AD``."""
    match rule.where:
        case Where.NEAR:
            return f"{rule.point} near [{rule.at.real:g}, {rule.at.imag:g}]"
        case Where.ABOVE | Where.BELOW:
            words = rule.where.value
        case _:
            words = f"{rule.where.value.removesuffix(' of')} of"
    return f"{rule.point} {words} {''.join(rule.refs)}"


def _judge(
    problem: Problem,
    rule: Rule,
    both: list[tuple[Draft, Program, Trace]],
    positions: npt.NDArray[np.float64],
) -> int:
    scores = [
        np.broadcast_to(_score(rule, draft, trace), positions.shape) for draft, _, trace in both
    ]
    able = np.flatnonzero(np.isfinite(scores[0]) & np.isfinite(scores[1]))
    if not able.size:
        _, program, trace = both[0]
        raise AssemblyError(explain(problem, program, trace, positions, unit_scales=True))
    name = "phi" if problem.drive.is_crank else "s"
    found = list(_places(problem, both, int(able[0])))[:-1]
    size = max(abs(point - found[0]) for point in found)
    apart = abs(_at(both[0][2], rule.point, positions) - _at(both[1][2], rule.point, positions))
    # A dead position tells the closings of nothing: the next one that is asked does.
    distinct = able[apart[able] > TIE * size]
    if not distinct.size:
        raise AssemblyError(
            f"{problem.name}: at {name} = {positions[able[0]]:g} both closings put {rule.point} at "
            "one place: the mechanism stands in a dead position, from which it may go on either "
            "way. Ask another position."
        )
    first = int(distinct[0])
    plus, minus = float(scores[0][first]), float(scores[1][first])
    where = f"{name} = {positions[first]:g}"
    said = _said(rule)
    if abs(plus - minus) <= TIE * size:
        raise ProblemError(
            problem.name,
            [
                Fault(
                    f"assembly.{rule.point}",
                    f"'{said}' does not tell the two closings apart at {where}: both give "
                    f"{plus:.6g} m",
                    "Compare with another point or with a directed line",
                )
            ],
        )
    sign = 1 if plus > minus else -1
    if rule.where is not Where.NEAR and max(plus, minus) <= 0:
        raise AssemblyError(
            f"'{said}' holds for neither closing at {where}: they miss it by {-plus:.6g} m and "
            f"{-minus:.6g} m. Check the lengths or the rule assembly.{rule.point}."
        )
    return sign


def _at(trace: Trace, point: str, positions: npt.NDArray[np.float64]) -> npt.NDArray[np.complex128]:
    place = np.asarray(trace.value[PointName(point)], dtype=complex)
    return np.asarray(np.broadcast_to(place, positions.shape), dtype=complex)


def _places(
    problem: Problem, both: list[tuple[Draft, Program, Trace]], at: int
) -> Iterator[complex]:
    for _, _, trace in both:
        for body in problem.bodies.values():
            for point in body.points:
                value = trace.value.get(PointName(point))
                if value is not None:
                    place = complex(np.ravel(value)[at if np.size(value) > 1 else 0])
                    if math.isfinite(place.real):
                        yield place
    yield 1e-300 + 0j


def _missing(group: AssurGroup, both: list[tuple[Draft, Program, Trace]]) -> Fault:
    """Return the fault of a group whose closing nobody chose, with both ways to say it."""
    c = inner_point(group)
    places = []
    for draft, _, trace in both:
        values = np.ravel(np.asarray(trace.value[PointName(c)], dtype=complex)) + draft.origin
        able = values[np.isfinite(values)]
        places.append(f"({able[0].real:.4g}, {able[0].imag:.4g})" if able.size else "nowhere")
    return Fault(
        f"assembly.{c}",
        f"links {', '.join(group.links)} close in two ways, with {c} at {places[0]} or at "
        f"{places[1]} m, and no rule says which",
        f'Add {c} = "right of ..." (or left of, above, below, or {{ near = [x, y] }}) '
        "to [assembly]",
    )
