"""Own check of a solution before anyone sees it (самопроверка)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING
from warnings import warn

import numpy as np
from msgspec.structs import replace

from planmethod.construct.steps import PointName
from planmethod.errors import DoubtWarning, PlanMethodError
from planmethod.languages import translate
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.plans.motion.position import has_two_modes, inner_point, parallelogram
from planmethod.problem.model import SAME_DEG, Problem
from planmethod.problem.plausibility import unlikely
from planmethod.solved.assembly_modes import drive_data
from planmethod.solved.failures import (
    NOT_REACHED,
    TURN,
    Cause,
    Contradiction,
    Doubt,
    Evenly,
    Failure,
    OmittedWarnings,
    Passed,
    Place,
    PositionError,
)
from planmethod.solved.forces.laws import only_in_positions
from planmethod.solved.quantities import SPOILT, WARN_RELATIVE_ERROR, error_bound
from planmethod.solved.reading import Complexes, Flags, Reals
from planmethod.solved.rules import changes
from planmethod.solved.solution import Solution

if TYPE_CHECKING:
    from planmethod.solved.forces.statics import Statics

MAX_NAMED = 5
"""Maximum number of doubtful positions that are named, the worst of them."""

NEAR = 1e-3
"""Margin below which a position is called next to a dead one."""

AT = 1e-7
"""Accuracy of a change point, relative to the driver's range."""

LEAST, FEW = 3, 72
"""Limits of the number of positions of a turn for which others without a dead one are suggested."""

STEP_FRACTIONS = (1 / 2, 1 / 3, 1 / 6, 1 / 12, 1 / 30)
"""Parts of a step by which position 0 is moved to come past dead positions."""

COUNTS = (8, 10, 16, 9, 15, 18)
"""Positions of a turn that are tried then."""

LIMIT = 1e-7
"""Largest closing error, relative to the largest value of its kind in the position."""


class SelfCheckError(PlanMethodError):
    """The plans of a solution contradict each other: an internal error (exit code 5)."""

    def __init__(self, contradiction: Contradiction) -> None:
        self.contradiction = contradiction
        super().__init__(str(contradiction))


def warnings(solution: Solution, *, forces: bool = False) -> list[Doubt | OmittedWarnings]:
    """Return the accuracy warnings for a user: one for each doubtful position.

    Of many positions the worst few are named and the rest counted. With ``forces`` the forces of a
    problem with loads have warnings of their own.
    """
    said: list[Doubt | OmittedWarnings] = []
    for found in (motion_doubts(solution), force_doubts(solution) if forces else []):
        worst = sorted(range(len(found)), key=lambda k: found[k].bound)[-MAX_NAMED:]
        said += [found[k] for k in sorted(worst)]
        if len(worst) < len(found):
            said.append(OmittedWarnings(len(found) - len(worst), len(solution.positions)))
    return said


def motion_doubts(solution: Solution) -> list[Doubt]:
    """Return all positions whose motion is doubtful."""
    return _list_doubts(solution, error_bound(solution), solution.margin)


def force_doubts(solution: Solution) -> list[Doubt]:
    """Return all positions whose forces are doubtful; none for a problem without loads."""
    if solution.problem.dynamics is None:
        return []
    from planmethod.solved.forces.statics import statics_of  # few files have any

    statics = statics_of(solution)
    return _list_doubts(solution, statics.bound, statics.margin, forces=True)


def _list_doubts(
    solution: Solution, estimate: Reals, margin: Reals, *, forces: bool = False
) -> list[Doubt]:
    return [
        Doubt(
            Place.of(solution.problem, solution.positions, i),
            bool(margin[i] < NEAR),
            float(margin[i]),
            float(estimate[i]),
            forces,
        )
        for i in map(int, np.flatnonzero((estimate > WARN_RELATIVE_ERROR) & np.isfinite(estimate)))
    ]


def accuracy_warnings(
    problem: Problem, positions: Sequence[float] | None = None, *, forces: bool = True
) -> Iterator[Doubt | OmittedWarnings]:
    """Yield the warnings of `warnings` for a problem that is solved elsewhere.

    Impossible or rejected positions are reported there.
    """
    with suppress(PlanMethodError):
        yield from warnings(Solution(problem, positions=positions), forces=forces)


def motion_warnings(problem: Problem, positions: Reals | None) -> Iterator[object]:
    """Yield the warnings of `changed_branches` and `kept_rates` of a problem solved elsewhere."""
    way = None if positions is None else [float(positions.min()), float(positions.max())]
    solution = Solution(problem, positions=way)
    yield from changed_branches(solution)
    yield from kept_rates(solution)


_SAME = 1e-9
"""Degrees, or m, within which a position is that of the file."""


def kept_rates(solution: Solution) -> Iterator[str]:
    """Yield a warning where what determines the driver's rates does not hold in all positions."""
    problem = solution.problem
    drive, own = problem.drive, problem.drive.positions[0]
    if drive.found_rates is None or (np.abs(solution.positions - own) <= _SAME).all():
        return
    if drive.output_rate is not None:
        key = drive.output_rate.key
    elif drive.actuator is not None:
        key = "v_" + "".join(drive.actuator)
    else:
        key = "torque" if drive.is_crank else "force"
    yield translate(
        "{} determines the rates of link {} at {} only; elsewhere they stay the same. "
        "Write each other position into the file as a variant.",
        key,
        drive.link,
        drive.coordinate.format_value(own, problem.unit, 5),
    )


def changed_branches(solution: Solution) -> list[Passed]:
    """Return the warnings about change points between the positions, group by group.

    The range is from the first position of the file, where the assembly modes are chosen, to all
    requested ones. A group that keeps a parallelogram or moves continuously needs no warning.
    """
    drive, draft = solution.problem.drive, solution.construction.draft
    way = np.append(solution.positions, (drive.assembly_positions or drive.positions)[0])
    low, high = float(way.min()), float(way.max())
    said = []
    for group in solution.structure.groups if high > low else ():
        closing = draft.choice.get(group.links)
        if closing is None or closing.parallel or closing.changes or not has_two_modes(group):
            continue
        high = min(high, low + drive.coordinate.turn)
        found = changes(
            draft,
            solution.construction.program,
            lambda s: drive_data(solution.problem, draft, s),
            group,
            (low, high),
        )
        # The motion reaches the last requested position but does not pass it.
        slack = AT * (high - low)
        passed = [place for place in found if low + slack < place < high - slack]
        if passed:
            said.append(_passed(solution, group, tuple(passed)))
    return said


def _passed(solution: Solution, group: AssurGroup, places: tuple[float, ...]) -> Passed:
    problem = solution.problem
    coordinate = problem.drive.coordinate
    if group.signature == "RPR":
        return Passed(group.links, places, coordinate, problem.unit)
    found = parallelogram(problem, group) if group.signature == "RRR" else None
    parallel = found is not None and found.is_one
    return Passed(group.links, places, coordinate, problem.unit, inner_point(group), parallel)


def _reject_spoilt(solution: Solution) -> None:
    spoilt = np.flatnonzero(~(error_bound(solution) <= SPOILT))
    if not spoilt.size:
        return
    i = int(spoilt[0])
    margin = float(solution.margin[i])
    raise PositionError(
        Failure(
            Cause.SPOILT_NEAR if margin < NEAR else Cause.SPOILT,
            Place.of(solution.problem, solution.positions, i),
            margin=margin,
            problem=solution.problem.name,
            same_count=spoilt.size - 1,
        )
    )


def verify(solution: Solution, *, forces: bool = False) -> None:
    """Check that links are rigid and that their points move as rigid bodies do.

    Every pair of points of a link keeps its distance, and the velocities and accelerations read
    from the plans obey ``v_Q - v_P = i·omega·PQ`` and ``a_Q - a_P = (i·epsilon - omega²)·PQ``.

    Parameters
    ----------
    forces : bool
        The forces of a problem with loads must exist, too, and be accurate enough.

    Raises
    ------
    SelfCheckError
        With the link, the position and the size of the contradiction.
    PositionError
        A position does not exist, or is so badly conditioned that its results are meaningless. Of
        positions that go round evenly it names others that do, without a dead one.
    """
    try:
        _verify(solution, forces=forces)
    except PositionError as error:
        instead = without_dead(solution, error.failure, forces=forces)
        if instead is None:
            raise
        raise PositionError(replace(error.failure, instead=instead)) from error


def without_dead(solution: Solution, failure: Failure, *, forces: bool) -> Evenly | None:
    """Return equally spaced positions without a dead one, to replace such positions that have one.

    None if the requested ones do not go round evenly, or if no others are found.

    Parameters
    ----------
    solution : Solution
        Solution in the requested positions.
    failure : Failure
        Failure of one of them.
    forces : bool
        The forces must exist in the others, too.
    """
    problem, positions = solution.problem, solution.positions
    given = problem.dynamics is not None and only_in_positions(problem.dynamics)
    most = FEW * max(problem.turns, 1)
    if failure.cause in NOT_REACHED or given or not LEAST <= len(positions) <= most:
        return None
    if not problem.drive.goes_round:
        return None
    steps = np.diff(positions)
    turns = round(float(np.abs(steps).sum() + abs(steps[0])) / TURN)
    even = turns > 0 and len(positions) % turns == 0
    if not even or np.ptp(np.append(np.abs(steps), TURN * turns / len(positions))) > SAME_DEG:
        return None
    count, first = len(positions) // turns, float(positions[0])
    turns = max(turns, solution.turns)
    ways = [(first + share * float(steps[0]), count) for share in STEP_FRACTIONS]
    ways += [(first, other) for other in COUNTS if other != count]
    for zero, other in ways:
        found = Evenly(round(zero % TURN, 9), other, turns)
        tried = found.first_angle + TURN / other * np.arange(other * turns)
        with suppress(PlanMethodError):
            _verify(solution.with_positions(tried), forces=forces)
            return found
    return None


def _verify(solution: Solution, *, forces: bool) -> None:
    _reject_spoilt(solution)
    for what, error, size in _contradictions(solution):
        bad = np.flatnonzero(_is_too_large(solution, error, size))
        if bad.size:
            i = int(bad[0])
            place = Place.of(solution.problem, solution.positions, i)
            told = Contradiction(
                solution.problem.name, place, *what, float(error[i]), float(size[i])
            )
            raise SelfCheckError(told)
    if forces and solution.problem.dynamics is not None:
        from planmethod.solved.forces.statics import statics_of  # few files have any

        statics_of(solution).si  # noqa: B018 - it refuses what does not exist or is spoilt


def warn_of_doubts(solution: Solution) -> None:
    """Check a solution as the commands do, and warn who called a function of the package.

    Raises
    ------
    SelfCheckError, PositionError
        As of `verify`.
    """
    said: list[object] = [*unlikely(solution.problem)]
    if len(solution.positions):
        said += [*changed_branches(solution), *kept_rates(solution)]
        verify(solution)
        said += warnings(solution)
    for doubt in said:
        warn(f"{solution.problem.name}: {doubt}", DoubtWarning, stacklevel=3)


def judged_statics(solution: Solution) -> Statics:
    """Return the force analysis of a solution (силовой расчёт).

    Raises
    ------
    PositionError
        Where the motion does not exist; forces that do not exist, or that rounding spoils, are
        refused when they are read.

    Warns
    -----
    DoubtWarning
        Of positions whose forces are good to few digits.
    """
    from planmethod.solved.forces.statics import statics_of  # few files have any

    statics = statics_of(solution)
    with suppress(PlanMethodError):  # it is reported when the forces are read
        for doubt in force_doubts(solution):
            warn(f"{solution.problem.name}: {doubt}", DoubtWarning, stacklevel=2)
    return statics


def flag_rejected(solution: Solution) -> Flags:
    """Return the positions that `verify` or `warnings` would report, as flags; shape (n,)."""
    found = ~(error_bound(solution) <= WARN_RELATIVE_ERROR)
    for _, error, size in _contradictions(solution):
        found |= _is_too_large(solution, error, size)
    return found


def _contradictions(solution: Solution) -> Iterator[tuple[tuple[str, str, str, str], Reals, Reals]]:
    """Yield the compared values of a rigid link, their difference and the reference size."""
    kinematics = solution.construction.kinematics
    for link, body in solution.problem.bodies.items():
        names = list(body.points)
        if link == FRAME or len(names) < 2:
            continue
        motion = solution.links[link]
        p = names[0]
        for q in names[1:]:
            one, two = ((link, p), (link, q))
            place = _between(solution, p, q)
            v = _difference(
                solution, kinematics.velocity.point[one], kinematics.velocity.point[two]
            )
            a = _difference(
                solution, kinematics.acceleration.point[one], kinematics.acceleration.point[two]
            )
            length = solution.length(link, p, q)
            turn = 1j * motion.epsilon - motion.omega**2
            checks = (
                ("length", np.abs(place) - length, np.maximum(length, _largest(solution, "place"))),
                ("velocity", v - 1j * motion.omega * place, _largest(solution, "velocity")),
                ("acceleration", a - turn * place, _largest(solution, "acceleration")),
            )
            for what, error, size in checks:
                yield (what, q, p, link), np.abs(error), size


def _between(solution: Solution, p: str, q: str) -> Complexes:
    return _difference(solution, PointName(p), PointName(q))


def _difference(solution: Solution, p: PointName, q: PointName) -> Complexes:
    si = solution.si
    return np.asarray(si.point(q) - si.point(p), dtype=complex)


def _largest(solution: Solution, field: str) -> Reals:
    values = [np.abs(getattr(motion, field)) for motion in solution.points.values()]
    return np.asarray(np.max(values, axis=0), dtype=float)


def _is_too_large(solution: Solution, error: Reals, size: Reals) -> Flags:
    # Near a dead position the plan magnifies rounding: there only gross errors are ours.
    limit = LIMIT * size / np.maximum(solution.margin, 1e-9)
    return np.asarray(~(error <= np.maximum(limit, 1e-300)))
