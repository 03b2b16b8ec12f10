"""Failed step of a plan that cannot be closed, with its numbers."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from msgspec.structs import replace

from planmethod.construct import steps
from planmethod.construct.evaluate import Trace, limit_of
from planmethod.construct.program import Program
from planmethod.construct.steps import LineName, NumberName, PointName, Step, operands
from planmethod.plans.assembly_mode import Start
from planmethod.plans.draft import Draft
from planmethod.plans.model import PlanKind
from planmethod.solved.failures import Cause, Failure, Place
from planmethod.solved.reading import Reading, Reals


def failing(program: Program, trace: Trace, count: int) -> npt.NDArray[np.int64]:
    """Return for each position the number of the first step that fails, or -1.

    Returns
    -------
    ndarray of shape (count,)
    """
    first = np.full(count, -1)
    for number, step in enumerate(program.steps):
        if step.out not in trace.margin:
            continue
        margin = np.broadcast_to(np.asarray(trace.margin[step.out], dtype=float), (count,))
        first[(first < 0) & ~(margin > limit_of(step))] = number
    return first


def explain(
    draft: Draft,
    program: Program,
    reading: Reading,
    positions: Reals,
    read_at: Callable[[Reals], Reading] | None = None,
) -> Failure:
    """Return which step fails at the first position that fails, with its numbers.

    Parameters
    ----------
    draft : Draft
        From which the program comes.
    reading : Reading
        At unit scales.
    read_at : callable, optional
        Reads the same in other positions: with it, arcs that do not meet are measured over a turn.
    """
    problem = draft.problem
    first = failing(program, reading.trace, reading.count)
    bad = np.flatnonzero(first >= 0)
    if not bad.size:
        place = Place.of(problem, positions, 0)
        return Failure(Cause.NOT_FINITE, place, problem=problem.name)
    index = int(bad[0])
    step = program.steps[int(first[index])]
    alike = int((first == first[index]).sum()) - 1

    def real(key: NumberName) -> float:
        return float(reading.number(key)[index])

    def point(key: PointName) -> complex:
        return complex(reading.point(key)[index])

    place = Place.of(problem, positions, index)
    ends = _without_length(step, program, point)
    if ends is not None:
        found = Failure(Cause.NO_DIRECTION, place, points=ends)
    else:
        found = _failure(step, place, draft, real, point)
    if found.cause in (Cause.ARCS, Cause.ARC):
        miss = float(_misses(step, reading)[index])
        found = replace(found, lengths=(*found.lengths, miss))
        if read_at is not None and problem.drive.goes_round:
            over_turn = np.nan_to_num(_misses(step, read_at(_TURN)), nan=-np.inf)
            k = int(np.argmax(over_turn))
            if over_turn[k] >= miss:  # or all of it lies between the degrees
                found = replace(found, over_cycle=(float(over_turn[k]), float(_TURN[k])))
    return replace(found, same_count=alike, other_count=bad.size - 1 - alike, count=len(positions))


_TURN = np.arange(0.0, 360.0)  # where arcs are measured that do not meet, degrees


def _misses(step: Step, reading: Reading) -> Reals:
    """Return by how much two arcs, or an arc and a line, miss each other, m, shape (n,).

    NaN where a line has no direction or an earlier step found no point.
    """
    with np.errstate(invalid="ignore"):
        if isinstance(step, steps.IntersectLineCircle):
            start, along = reading.value[step.line]
            away = reading.point(step.centre) - start
            distance = np.abs((np.conj(along / np.abs(along)) * away).imag)
            return np.asarray(distance - reading.number(step.radius))
        assert isinstance(step, steps.IntersectCircles)
        one, two = reading.number(step.radius1), reading.number(step.radius2)
        gap = np.abs(reading.point(step.centre2) - reading.point(step.centre1))
        return np.asarray(np.maximum(gap - one - two, np.abs(one - two) - gap))


def _without_length(
    step: Step, program: Program, point: Callable[[PointName], complex]
) -> tuple[PointName, PointName] | None:
    """Return two points that coincide and should have given a line of a step its direction."""
    made = {other.out: other for other in program.steps}
    for name, kind in operands(step):
        line = made[name]
        while kind is LineName and not isinstance(line, steps.Join):
            if (
                not isinstance(line, steps.Parallel | steps.Perpendicular | steps.AtAngle)
                or line.to is None
            ):
                break
            line = made[line.to]
        if isinstance(line, steps.Join) and point(line.tail) == point(line.head):
            return line.tail, line.head
    return None


def _failure(
    step: Step,
    place: Place,
    draft: Draft,
    real: Callable[[NumberName], float],
    point: Callable[[PointName], complex],
) -> Failure:
    plan = draft.plans.get(step.out, PlanKind.POSITION)
    if plan is PlanKind.FORCE:
        if (pushes := draft.letters.get(PointName(step.out))) is not None:
            return Failure(Cause.NO_ARM, place, pushes)
        return Failure(Cause.FORCES, place)
    letter = draft.letters.get(PointName(step.out), str(step.out))
    match step:
        case steps.IntersectCircles(out, a, r, b, q, _):
            gap, one, two = abs(point(b) - point(a)), real(r), real(q)
            cause = Cause.SAME_ARCS if gap == 0 and one == two else Cause.ARCS
            return Failure(cause, place, out, (a, b), (one, two, gap))
        case steps.IntersectLineCircle(out, _, a, r, _):
            return Failure(Cause.ARC, place, out, (a,), (real(r),))
        case steps.Touch(_, a, r, b, _):
            return Failure(Cause.TANGENT, place, "", (a, b), (real(r), abs(point(b) - point(a))))
        case steps.TriadPose():
            start = draft.branches[step.start[2]]
            assert isinstance(start, Start)
            links, closing = next(
                (links, one) for links, one in draft.choice.items() if one.tracked is start.tracked
            )
            reach = (closing.start, *(start.tracked.places[k] for k in (0, -1)))
            return Failure(Cause.NOT_HELD, place, ", ".join(links), reach=reach)
        case steps.IntersectLines(out) if any(one.point == out for one in draft.special.values()):
            return Failure(Cause.LEGS, place, out)
        case steps.IntersectLines():
            cause = Cause.GUIDES if plan is PlanKind.POSITION else Cause.RAYS
            return Failure(cause, place, letter, plan=plan)
        case steps.Similar(_, _, _, _, one, two):
            return Failure(Cause.SIMILAR, place, letter, (one, two))
        case _:
            return Failure(Cause.STEP, place, step.out)
