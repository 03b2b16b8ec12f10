"""Own check of a solution before anyone sees it (самопроверка)."""

from __future__ import annotations

import numpy as np

from planmethod.construct.steps import PointName
from planmethod.errors import AssemblyError, PlanMethodError
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.plans.motion.position import inner_point, parallelogram
from planmethod.solved.changes import changes
from planmethod.solved.closings import drive_data
from planmethod.solved.reading import Complexes, Reals
from planmethod.solved.solution import Solution
from planmethod.solved.trust.conditioning import error_bound

DOUBTFUL = 1e-6
"""Bound of the relative error of the results from which a warning is given."""

SPOILT = 1e-2
"""Bound of the relative error from which a position is refused."""

MOST_NAMED = 5
"""Doubtful positions that are named, the worst of them."""

NEAR = 1e-3
"""Margin below which a position is called next to a dead one."""

AT = 1e-7
"""How well a change point is found, in parts of the driver's way."""

LIMIT = 1e-7
"""Largest closing error, as a share of the largest value of its kind in the position."""


class SelfCheckError(PlanMethodError):
    """The plans of a solution contradict each other: a mistake of ours (exit code 5)."""


def warnings(solution: Solution) -> list[str]:
    """Return what a user should know of the accuracy: a sentence for each doubtful position.

    Of many positions the worst few are named and the rest counted.
    """
    estimate = error_bound(solution)
    doubtful = np.flatnonzero(estimate > DOUBTFUL)
    named = doubtful
    if len(doubtful) > MOST_NAMED:
        named = np.sort(doubtful[np.argsort(estimate[doubtful])[-MOST_NAMED:]])
    said = [
        f"{_place(solution, i)} is {_nature(solution, i)}: the worst of its results is good to "
        f"about {estimate[i]:.0e} of its value."
        for i in map(int, named)
    ]
    if len(named) < len(doubtful):
        said.append(
            f"so are {len(doubtful) - len(named)} more of {len(estimate)} positions, less badly."
        )
    return said


def changed_branches(solution: Solution) -> list[str]:
    """Return what a user should know of change points between the positions: a sentence a group.

    The way goes from the first position of the file, where the closings are chosen, to all asked
    ones. A group that keeps a parallelogram or goes on continuously has nothing to be told of.
    """
    drive, draft = solution.problem.drive, solution.construction.draft
    way = np.append(solution.positions, drive.positions[0])
    low, high = float(way.min()), float(way.max())
    said = []
    for group in solution.structure.groups if high > low else ():
        closing = draft.choice.get(group.links)
        if closing is None or closing.parallel or closing.changes:
            continue
        high = min(high, low + drive.coordinate.turn)
        found = changes(
            draft,
            solution.construction.program,
            lambda s: drive_data(solution.problem, draft, s),
            group,
            low,
            high,
        )
        # What is asked last, the motion comes to and does not pass.
        slack = AT * (high - low)
        passed = [place for place in found if low + slack < place < high - slack]
        if passed:
            said.append(_change(solution, group, passed))
    return said


def _change(solution: Solution, group: AssurGroup, found: list[float]) -> str:
    places = " and ".join(dict.fromkeys(f"{round(place, 4) + 0.0:.10g}" for place in found))
    told = solution.problem.drive.coordinate.told
    text = (
        f"links {', '.join(group.links)} pass a change point at {told(places)}, from "
        "which the mechanism may go on either way: the side that was chosen in the first position "
        "is kept, so that one branch of the motion passes into another there."
    )
    if group.signature == "RPR":
        return text
    c = inner_point(group)
    ways = [f'{c} = {{ near = [x, y], keep = "continuous" }} for the motion that goes on smoothly']
    quadrilateral = parallelogram(solution.problem, group) if group.signature == "RRR" else None
    if quadrilateral is not None and quadrilateral.is_one:
        ways.insert(0, f'{c} = {{ keep = "parallel" }} for the parallelogram')
    return f"{text} Say in [assembly] {', '.join(ways)}."


def _place(solution: Solution, i: int) -> str:
    place = solution.problem.drive.coordinate.told(f"{solution.positions[i]:.12g}")
    return f"position {i + 1} ({place})"


def _nature(solution: Solution, i: int) -> str:
    """Return why a position is badly conditioned."""
    margin = solution.margin[i]
    if margin < NEAR:
        return f"next to a dead position (margin {margin:.1e})"
    return "badly conditioned (its results hang on small differences of large values)"


def _refuse_spoilt(solution: Solution) -> None:
    spoilt = np.flatnonzero(~(error_bound(solution) <= SPOILT))
    if not spoilt.size:
        return
    i = int(spoilt[0])
    more = f" So do {spoilt.size - 1} other positions." if spoilt.size > 1 else ""
    near = solution.margin[i] < NEAR
    why = (
        f"stands so near a dead position (margin {solution.margin[i]:.1e}) that rounding"
        if near
        else "hangs on such small differences of large values that rounding"
    )
    raise AssemblyError(
        f"{solution.problem.name}: {_place(solution, i)} {why} spoils its results.{more} Ask a "
        "position further away."
    )


def verify(solution: Solution) -> None:
    """Check that links are rigid and that their points move as rigid bodies do.

    Every pair of points of a link keeps its distance, and the velocities and accelerations read
    from the plans obey ``v_Q - v_P = i·omega·PQ`` and ``a_Q - a_P = (i·epsilon - omega²)·PQ``.

    Raises
    ------
    SelfCheckError
        With the link, the position and the size of the contradiction.
    AssemblyError
        When a position is so badly conditioned that its results mean nothing.
    """
    _refuse_spoilt(solution)
    kin = solution.construction.kinematics
    for link, body in solution.problem.bodies.items():
        names = list(body.points)
        if link == FRAME or len(names) < 2:
            continue
        motion = solution.links[link]
        p = names[0]
        for q in names[1:]:
            one, two = ((link, p), (link, q))
            place = _between(solution, p, q)
            v = _difference(solution, kin.velocity.point[one], kin.velocity.point[two])
            a = _difference(solution, kin.acceleration.point[one], kin.acceleration.point[two])
            length = abs(body.points[q] - body.points[p])
            turn = 1j * motion.epsilon - motion.omega**2
            checks = (
                ("length", np.abs(place) - length, np.maximum(length, _largest(solution, "place"))),
                ("velocity", v - 1j * motion.omega * place, _largest(solution, "velocity")),
                ("acceleration", a - turn * place, _largest(solution, "acceleration")),
            )
            for what, error, size in checks:
                _judge(solution, f"{what} of {q} about {p} on link {link}", np.abs(error), size)


def _between(solution: Solution, p: str, q: str) -> Complexes:
    return _difference(solution, PointName(p), PointName(q))


def _difference(solution: Solution, p: PointName, q: PointName) -> Complexes:
    si = solution.si
    return np.asarray(si.point(q) - si.point(p), dtype=complex)


def _largest(solution: Solution, field: str) -> Reals:
    values = [np.abs(getattr(motion, field)) for motion in solution.points.values()]
    return np.asarray(np.max(values, axis=0), dtype=float)


def _judge(solution: Solution, what: str, error: Reals, size: Reals) -> None:
    # Near a dead position the plan magnifies rounding: there only gross errors are ours.
    limit = LIMIT * size / np.maximum(solution.margin, 1e-9)
    bad = np.flatnonzero(~(error <= np.maximum(limit, 1e-300)))
    if bad.size:
        i = int(bad[0])
        raise SelfCheckError(
            f"{solution.problem.name}: the {what} is off by {error[i]:.3g} (largest value "
            f"{size[i]:.3g}) at position {i + 1}. This is a fault of planmethod: please report it."
        )
