"""Why a plan cannot be closed: the step that failed, in the words and numbers of the drawing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.construct.evaluate import Trace, limit_of
from planmethod.construct.program import Program
from planmethod.construct.steps import (
    AtAngle,
    Join,
    LineName,
    MeetCircles,
    MeetLineCircle,
    MeetLines,
    Parallel,
    Perpendicular,
    PointName,
    Similar,
    Step,
    Touch,
    operands,
)
from planmethod.plans.model import FACTS, PlanKind
from planmethod.problem.model import Problem


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
    problem: Problem,
    program: Program,
    trace: Trace,
    positions: npt.NDArray[np.float64],
    *,
    unit_scales: bool = False,
) -> str:
    """Say which step fails at the first position that fails, with its numbers and what to check.

    Parameters
    ----------
    unit_scales : bool
        The trace was read at unit scales: lengths are metres, not millimetres of a plan.
    """
    first = failing(program, trace, len(positions))
    bad = np.flatnonzero(first >= 0)
    if not bad.size:
        return f"{problem.name}: a value is not finite although every step exists."
    index = int(bad[0])
    step = program.steps[int(first[index])]
    place = problem.drive.coordinate.told(f"{positions[index] + 0.0:.12g}")
    where = f"position {index + 1} ({place})"
    alike = int((first == first[index]).sum()) - 1
    more = f" The same holds at {alike} more of {len(positions)} positions." if alike else ""
    if bad.size - 1 > alike:
        more += f" Other steps fail at {bad.size - 1 - alike} positions."
    length = "m" if unit_scales else "mm"

    def real(key: Any) -> float:
        value = np.asarray(trace.value[key], dtype=float)
        return float(value if value.ndim == 0 else value[index])

    def point(key: PointName) -> complex:
        value = np.asarray(trace.value[key], dtype=complex)
        return complex(value if value.ndim == 0 else value[index])

    ends = _without_length(step, program, point)
    if ends is not None:
        p, q = ends
        return (
            f"Cannot go on at {where}: {p} and {q} coincide, so that the line {p}{q} has no "
            "direction. The mechanism stands in a dead position there; ask another one." + more
        )
    return _sentence(step, where, length, real, point) + more


def _without_length(
    step: Step, program: Program, point: Callable[[PointName], complex]
) -> tuple[PointName, PointName] | None:
    """Return two points that coincide and should have given a line of a step its direction."""
    steps = {other.out: other for other in program.steps}
    for name, kind in operands(step):
        line = steps[name]
        while kind is LineName and not isinstance(line, Join):
            if not isinstance(line, Parallel | Perpendicular | AtAngle) or line.to is None:
                break
            line = steps[line.to]
        if isinstance(line, Join) and point(line.tail) == point(line.head):
            return line.tail, line.head
    return None


def _sentence(step: Step, where: str, unit: str, real: Any, point: Any) -> str:
    if step.out.startswith(FACTS[PlanKind.FORCE].prefix):
        return (
            f"Cannot close the force plan at {where}: the mechanism stands in a dead position, "
            "where no forces balance the loads. Ask another position."
        )
    match step:
        case MeetCircles(out, a, r, b, q, _):
            gap, one, two = abs(point(b) - point(a)), real(r), real(q)
            arcs = f"arcs from {a} ({one:.4g} {unit}) and {b} ({two:.4g} {unit})"
            if gap == 0 and one == two:
                return (
                    f"Cannot place {out} at {where}: {arcs} coincide, {a} and {b} being at one "
                    "place. This dead position is a change point: the mechanism may go on either "
                    "way. Ask another one."
                )
            miss = max(gap - one - two, abs(one - two) - gap)
            return (
                f"Cannot place {out} at {where}: {arcs} do not meet, |{a}{b}| = {gap:.4g} {unit}. "
                f"Check l_{a}{out}, l_{b}{out}. The arcs miss by {miss:.4g} {unit}."
            )
        case MeetLineCircle(out, _, a, r, _):
            return (
                f"Cannot place {out} at {where}: the arc from {a} ({real(r):.4g} {unit}) does not "
                f"reach the guide of {out}. Check l_{a}{out} and the place of the guide."
            )
        case Touch(out, a, r, b, _):
            gap = abs(point(b) - point(a))
            return (
                f"Cannot turn the slotted link about {a} at {where}: its line stands off {a} by "
                f"{real(r):.4g} {unit}, but {b} is only {gap:.4g} {unit} away. Check the offset."
            )
        case MeetLines(out, _, _):
            if ":" not in out:
                return (
                    f"Cannot place {out} at {where}: its two guides are parallel. "
                    "Ask another position, or check their angles."
                )
            plan = "velocity" if out.startswith("v:") else "acceleration"
            return (
                f"Cannot close the {plan} plan at {where}: the rays that meet in "
                f"{_letter(out)} are parallel, the mechanism stands in a dead position. Ask "
                "another position: there the velocities are not determined by the driver."
            )
        case Similar(out, _, _, _, one, two):
            return (
                f"Cannot find {_letter(out)} by similarity at {where}: {one} and {two} of its "
                "triangle coincide. Ask another position."
            )
        case _:
            return (
                f"Step {step.out} is impossible at {where}: two points that give a direction "
                "coincide there. Ask another position."
            )


def _letter(plan_point: str) -> str:
    return plan_point.split(":")[-1].lower()
