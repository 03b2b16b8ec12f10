"""Positions and rates that outputs or loads determine, of one driver or several (начальные звенья).

Each of several drivers gives one condition of the position, one of the rates and one of the
accelerations: its own coordinate, an output, or a load. Positions that outputs determine are roots
in all unknown coordinates at once. Rates are linear in those of the drivers: solutions in which one
driver moves at a time are their coefficients (наложение).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product

import numpy as np
import numpy.typing as npt
from msgspec.structs import asdict, replace

from planmethod.construct.arithmetic import Float64
from planmethod.errors import AssemblyError, Fault, PlanMethodError, ProblemError
from planmethod.languages import translate
from planmethod.mechanism.groups import triad_of
from planmethod.problem.model import Drive, FoundRates, OtherDrive, OutputPositionKind, Problem
from planmethod.problem.names import UNITS
from planmethod.solved.assembly_modes import structure_of
from planmethod.solved.failures import PositionError
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import TURN
from planmethod.solved.turn.given_rates import guide_of_point, output_motion, rates_of_output
from planmethod.solved.turn.posed import (
    closed_at,
    missed_by,
    output_phrase,
    output_reader,
    period_of,
    placed_by_output,
    pose_driver,
    sides_of,
)

_TRIES = (10, 36)  # positions of each driver in which it is tried how the groups close
_GRID_COUNT = 72  # positions of each driver from which roots are sought
_STARTS = 60
_NEWTON = 40
_STEP = 1e-5  # share of the range of a coordinate, by which derivatives are taken
_LEAP = 0.05  # share of the range that an iteration may move by
_SAME = 1e-7  # share of the range within which two roots are one
_OFF = 1e-10  # share of the range of the outputs that a root may miss them by
_DEAD = 1e-6
_ENOUGH = 1e-14
_CORRECTIONS = 60

Matrix = npt.NDArray[np.float64]


def pose(problem: Problem) -> Problem:
    """Return a problem with the positions and the rates that outputs or loads determine.

    Raises
    ------
    ProblemError
        Several positions fit and no ``root`` selects one, the rules of the file allow no assembly,
        or a load moves no inertia.
    AssemblyError
        The outputs do not reach their values, or are in a dead position.
    """
    if not problem.drive.other_drives:
        return pose_driver(problem)
    placed = _placed(problem)
    known = np.isfinite([one for drive in placed.drive.every for one in drive.positions]).all()
    return _accelerated(_rated(placed)) if known else placed


def with_drives(problem: Problem, drives: Sequence[Drive]) -> Problem:
    """Return a problem with other laws of its drivers, in their order."""
    first, *others = drives
    return replace(problem, drive=replace(first, other_drives=tuple(map(other_drive_of, others))))


def other_drive_of(drive: Drive) -> OtherDrive:
    """Return a driver as another one than the first."""
    if isinstance(drive, OtherDrive):
        return drive
    return OtherDrive(**asdict(replace(drive, other_drives=())))


# Positions -------------------------------------------------------------------------------------


def _placed(problem: Problem) -> Problem:
    """Return a problem with the positions that the outputs determine."""
    drives = problem.drive.every
    sought = [k for k, drive in enumerate(drives) if drive.posed is not None]
    if not sought:
        return problem
    found: list[list[float]] = [[] for _ in drives]
    for index in range(len(drives[sought[0]].positions)):
        single = [drive.at_index(index) for drive in drives]
        one = with_drives(problem, single)
        places = _by_one(one, sought[0]) if len(sought) == 1 else _by_all(one, sought)
        if places is None:
            return problem
        for own, place in zip(found, places, strict=True):
            own.append(place)
    return with_drives(
        problem,
        [replace(drive, positions=tuple(own)) for drive, own in zip(drives, found, strict=True)],
    )


def with_places(problem: Problem, places: Sequence[Sequence[float]]) -> Problem:
    """Return a problem in other positions of all its drivers, assembled in the same way.

    Parameters
    ----------
    places : sequence of sequences of float
        Degrees or m of each driver, in their order, as many of each. Their rates stay.
    """
    pairs = zip(problem.drive.every, places, strict=True)
    return with_drives(problem, [drive.in_other_positions(own) for drive, own in pairs])


def _by_one(problem: Problem, k: int) -> list[float] | None:
    """Return the positions where one of the drivers is sought, while the others stand."""
    drives = problem.drive.every
    still = [replace(drive, rate=0.0, acceleration=0.0) for drive in drives]
    first = Drive(**asdict(replace(drives[k], other_drives=())))
    others = [one for number, one in enumerate(still) if number != k]
    turned = with_drives(problem, [first, *others])
    links = [one.link for one in others]
    mechanism = replace(problem.mechanism, driver=first.link, other_drivers=tuple(links))
    try:
        (place,) = placed_by_output(replace(turned, mechanism=mechanism)).drive.positions
    except ProblemError as error:
        faults = [
            replace(fault, path=fault.path.replace("driver.", f"drivers[{k}].", 1))
            for fault in error.faults
        ]
        raise ProblemError(problem.name, faults) from error
    if not np.isfinite(place):
        return None
    return [place if number == k else one.positions[0] for number, one in enumerate(drives)]


def _by_all(problem: Problem, sought: Sequence[int]) -> list[float] | None:
    """Return the positions where outputs determine several drivers together."""
    drives = problem.drive.every
    known = [np.nan if k in sought else one.positions[0] for k, one in enumerate(drives)]
    if any(triad_of(group) is not None for group in structure_of(problem).groups):
        return _from_start(problem, sought, known)
    ways, trouble = _assemblies(problem, sought, known)
    if isinstance(trouble, ProblemError | PositionError) and not ways:
        raise trouble
    if not ways:  # a mechanism that has no plans has no positions
        return None
    found: list[list[float]] = []
    for solution in ways:
        # Off round numbers, at which singular places are common.
        starts_of_search = _grid(problem, sought, _GRID_COUNT)
        values = _outputs(solution, sought, known)
        for root in _roots(solution.problem, sought, known, values, starts_of_search):
            at = _closed(problem, root)
            if at is not None and sides_of(at) == sides_of(solution):
                found.append(root)
    return _chosen(problem, sought, found)


def _from_start(problem: Problem, sought: Sequence[int], known: Sequence[float]) -> list[float]:
    """Return the positions of drivers of a mechanism with a triad, by Newton from given places.

    A triad has up to six assemblies, between which it changes along a motion, so each place is
    assembled by the rules.
    """
    start = []
    for k in sought:
        posed = problem.drive.every[k].posed
        if posed is None or posed.nearest_to is None:
            hint = translate("For example: {}", 'root = "near 40"')
            message = "with a group of class III the search needs a start of each sought driver"
            fault = Fault(f"drivers[{k}].root", translate(message), hint)
            raise ProblemError(problem.name, [fault])
        start.append(posed.nearest_to)

    def values(places: Matrix) -> Matrix:
        rows = []
        for row in places.tolist():
            at = _closed(problem, _all_places(problem, sought, known, row))
            one = np.full((1, len(sought)), np.nan)
            rows.append(one if at is None else _outputs(at, sought, known)(np.array([row])))
        return np.concatenate(rows)

    found = _roots(problem, sought, known, values, np.array([start]))
    return _chosen(problem, sought, found)


def _closed(problem: Problem, places: Sequence[float]) -> Solution | None:
    """Return the mechanism as its rules close it in a position; None where they do not."""
    return closed_at(_at_places(problem, places), places[0])


def _all_places(
    problem: Problem, sought: Sequence[int], known: Sequence[float], places: Sequence[float]
) -> list[float]:
    """Return the places of all drivers, of cranks within a turn."""
    whole = list(known)
    for k, place in zip(sought, places, strict=True):
        whole[k] = place % TURN if problem.drive.every[k].is_crank else place
    return whole


def _at_places(problem: Problem, places: Sequence[float]) -> Problem:
    """Return a problem with its drivers in one position."""
    pairs = zip(problem.drive.every, places, strict=True)
    return with_drives(problem, [replace(one, positions=(at,)) for one, at in pairs])


def _spans(problem: Problem, sought: Sequence[int]) -> list[tuple[float, float]]:
    """Return the ranges of the sought coordinates, degrees or m."""
    sizes = [abs(length) for _, _, length in problem.lengths]
    sizes += [abs(place) for body in problem.bodies.values() for place in body.points.values()]
    reach = sum(sizes)
    cranks = [problem.drive.every[k].is_crank for k in sought]
    return [(0.0, TURN) if crank else (-reach, reach) for crank in cranks]


def _grid(problem: Problem, sought: Sequence[int], count: int) -> Matrix:
    """Return places of the sought drivers over their ranges, shape ((count + 1)^m, m).

    Those that the file names are among them.
    """
    rows = []
    for k, (low, high) in zip(sought, _spans(problem, sought), strict=True):
        posed = problem.drive.every[k].posed
        near = None if posed is None else posed.nearest_to
        even = low + (high - low) * (np.arange(count) + 0.2593) / count
        rows.append(np.sort(np.append(even, (low + high) / 2 if near is None else near)))
    return np.array(list(product(*rows)))


def _assemblies(
    problem: Problem, sought: Sequence[int], known: Sequence[float]
) -> tuple[list[Solution], PlanMethodError | None]:
    """Return the assemblies that the rules select, and the error where they select none."""
    ways: dict[object, Solution] = {}
    trouble: PlanMethodError | None = None
    for count in _TRIES:
        for row in _grid(problem, sought, count).tolist():
            try:
                solution = Solution(_at_places(problem, _all_places(problem, sought, known, row)))
            except PlanMethodError as error:
                trouble = error
                continue
            ways.setdefault(repr(sides_of(solution)), solution)
        if ways:
            break
    return list(ways.values()), trouble


def _outputs(
    solution: Solution, sought: Sequence[int], known: Sequence[float]
) -> Callable[[Matrix], Matrix]:
    """Return a function that gives the outputs, shape (n, m), in places of the same shape."""
    problem = solution.problem
    readers = [
        output_reader(solution, posed, 0)
        for posed in (problem.drive.every[k].posed for k in sought)
        if posed is not None
    ]

    def values(places: Matrix) -> Matrix:
        count = len(places)
        columns = [np.full(count, one) for one in known]
        for k, own in zip(sought, places.T, strict=True):
            columns[k] = own
        moved = with_drives(
            problem,
            [
                replace(drive, positions=tuple(own.tolist()))
                for drive, own in zip(problem.drive.every, columns, strict=True)
            ],
        )
        reading = Solution(moved, construction=solution.construction).read(Float64())
        return np.stack([read(reading) for read in readers], axis=1)

    return values


def _roots(
    problem: Problem,
    sought: Sequence[int],
    known: Sequence[float],
    values: Callable[[Matrix], Matrix],
    starts_of_search: Matrix,
) -> list[list[float]]:
    """Return the places of all drivers in which the outputs have their values, by Newton.

    Parameters
    ----------
    values : callable
        Gives the outputs, shape (n, m), in places of the sought drivers of the same shape.
    starts_of_search : ndarray of shape (count^m, m)
        Places from which roots are sought: a grid, or a single place.
    """
    found, drives = list[list[float]](), problem.drive.every
    posed = [one for one in (drives[k].posed for k in sought) if one is not None]
    ranges = np.array([high - low for low, high in _spans(problem, sought)])
    there = values(starts_of_search)
    if not np.isfinite(there).any():
        return []
    sizes = np.array([max(float(np.nanmax(np.abs(one))), 1e-300) for one in there.T])
    # An angle of two links has no sign: both ways of it are looked for.
    targets = product(*(
        sorted({one.values[0], -one.values[0]}) if one.by is OutputPositionKind.BETWEEN
        else one.values[:1]
        for one in posed
    ))  # fmt: skip
    periods = [period_of(problem, one) for one in posed]
    for target in targets:

        def missed(outputs: Matrix, target: tuple[float, ...] = target) -> Matrix:
            off = outputs - np.array(target)
            pairs = zip(off.T, periods, strict=True)
            return np.stack([missed_by(one, period) for one, period in pairs], axis=1)

        starts = starts_of_search[_least(np.sum((missed(there) / sizes) ** 2, axis=1), len(sought))]

        def off(places: Matrix, missed: Callable[[Matrix], Matrix] = missed) -> Matrix:
            return missed(values(places))

        for place in _newton(off, starts, ranges, sizes):
            whole = _all_places(problem, sought, known, place.tolist())
            if not any(_are_same(whole, other, drives, ranges.max()) for other in found):
                found.append(whole)
    return found


def _least(sizes: Reals, dimensions: int) -> npt.NDArray[np.intp]:
    """Return the places of a grid where a quantity is less than in their neighbours."""
    count = round(len(sizes) ** (1 / dimensions))
    whole = np.where(np.isfinite(sizes), sizes, np.inf).reshape((count,) * dimensions)
    least = np.isfinite(whole)
    for way in product((-1, 0, 1), repeat=dimensions):
        least &= whole <= np.roll(whole, way, axis=tuple(range(dimensions)))
    chosen = np.flatnonzero(least)
    return chosen[np.argsort(whole.ravel()[chosen])][:_STARTS]


def _newton(
    missed: Callable[[Matrix], Matrix], places: Matrix, ranges: Matrix, sizes: Matrix
) -> list[Matrix]:
    """Return the zeros of functions to which iterations from the places lead."""
    m, steps = places.shape[1], np.diag(_STEP * ranges)
    for _ in range(_NEWTON):
        n = len(places)
        if not n:
            return []
        around = [places, *(places + way for step in steps for way in (step, -step))]
        every = missed(np.concatenate(around)).reshape(2 * m + 1, n, -1)
        slopes = [(every[2 * k + 1] - every[2 * k + 2]) / (2 * steps[k, k]) for k in range(m)]
        jacobian = np.stack(slopes, axis=2)
        good = np.flatnonzero(np.isfinite(every).all(axis=(0, 2)))
        good = good[np.abs(np.linalg.det(jacobian[good])) > 0.0]
        if not good.size:
            return []
        move = -np.linalg.solve(jacobian[good], every[0][good][:, :, np.newaxis])[:, :, 0]
        longest = np.max(np.abs(move) / ranges, axis=1, initial=0.0)
        places = places[good] + move * np.minimum(1.0, _LEAP / np.maximum(longest, 1e-300))[:, None]
        if not (longest > 1e-13).any():
            break
    off = np.abs(missed(places)) / np.maximum(sizes, 1e-300)
    return list(places[(off <= _OFF).all(axis=1)])


def _are_same(
    one: Sequence[float], two: Sequence[float], drives: Sequence[Drive], size: float
) -> bool:
    """Return whether two positions are one."""
    apart = [
        abs(missed_by(np.array(p - q), TURN if drive.is_crank else np.inf))
        for p, q, drive in zip(one, two, drives, strict=True)
    ]
    return max(map(float, apart)) <= _SAME * size


def _chosen(problem: Problem, sought: Sequence[int], roots: list[list[float]]) -> list[float]:
    """Return the one position that is meant."""
    drives = problem.drive.every
    asked = [(k, posed) for k in sought if (posed := drives[k].posed) is not None]
    phrase = ", ".join(output_phrase(posed, 0, problem) for _, posed in asked)
    kept = sorted(roots)
    if not kept:
        raise AssemblyError(
            "{}: {} are not reached together. Check these values, the lengths, and whether the "
            "rules of [assembly] hold in this position.",
            problem.name,
            phrase,
        )
    near = [(k, posed.nearest_to) for k, posed in asked if posed.nearest_to is not None]
    if near:
        spans = dict(zip(sought, _spans(problem, sought), strict=True))

        def away(places: list[float]) -> float:
            total = 0.0
            for k, place in near:
                period = TURN if drives[k].is_crank else np.inf
                off = missed_by(np.array(places[k] - place), period)
                total += (float(off) / (spans[k][1] - spans[k][0])) ** 2
            return total

        return min(kept, key=away)
    number = max(posed.number for _, posed in asked)
    if 0 < number <= len(kept):
        return kept[number - 1]
    if len(kept) == 1 and not number:
        return kept[0]
    shown = "; ".join(
        ", ".join(_place_text(drives[k], places[k], problem) for k in sought) for places in kept
    )
    message = translate("{} matches {}, but one position is required", phrase, shown)
    per = 1.0 if drives[sought[0]].is_crank else UNITS[problem.unit]
    places = ", ".join(f'root = "near {places[sought[0]] * per:.5g}"' for places in kept)
    hint = translate("Give one of {}", places)
    raise ProblemError(problem.name, [Fault(f"drivers[{sought[0]}].root", message, hint)])


def _place_text(drive: Drive, place: float, problem: Problem) -> str:
    per = 1.0 if drive.is_crank else UNITS[problem.unit]
    letter = "phi" if drive.is_crank else "s"
    return f"{letter}_{drive.link} = {place * per:.5g}"


# Rates -----------------------------------------------------------------------------------------


def _is_rated(drive: Drive) -> bool:
    """Return whether an output determines the rates of a driver."""
    return drive.output_rate is not None or drive.actuator is not None


def _rated(problem: Problem) -> Problem:
    """Return a problem with the rates of its drivers that outputs determine."""
    drives = problem.drive.every
    if not any(map(_is_rated, drives)):
        return problem
    for number, drive in enumerate(drives):
        rate = drive.output_rate
        if rate is not None and rate.kind == "v" and guide_of_point(problem, rate.of) is None:
            message = translate("the velocity of {} has two components", rate.of)
            hint = translate("Give vx_{0} or vy_{0}.", rate.of)
            raise ProblemError(
                problem.name, [Fault(f"drivers[{number}].{rate.key}", message, hint)]
            )
    count = len(drives)
    columns = [_moving(problem, row, np.zeros(count)) for row in np.eye(count)]
    derivatives = np.array([[_motion(one, drive, k)[0] for one in columns]
                       for k, drive in enumerate(drives)])  # fmt: skip
    sizes = np.array([max(_motion(one, drive, k)[2] for one in columns)
                      for k, drive in enumerate(drives)])  # fmt: skip
    scaled = derivatives / np.maximum(sizes, 1e-300)[:, np.newaxis]
    scaled /= np.maximum(np.max(np.abs(scaled), axis=0), 1e-300)
    if not abs(np.linalg.det(scaled)) > _DEAD:
        raise AssemblyError(
            "{}: in this position {} do not determine the rates of links {}. "
            "Give another position, or the rates of the links.",
            problem.name,
            ", ".join(_rate_key(drive) for drive in drives if _is_rated(drive)),
            ", ".join(problem.drive.links),
        )
    speeds = [rates_of_output(one)[0] if _is_rated(one) else one.rate for one in drives]
    rates = np.linalg.solve(derivatives, np.array(speeds))
    even = _moving(problem, rates, np.zeros(count))
    rows, gains = np.eye(count), np.array([drive.acceleration for drive in drives])
    for k, drive in enumerate(drives):
        gain = rates_of_output(drive)[1] if _is_rated(drive) else None
        if gain is not None:
            rows[k], gains[k] = derivatives[k], gain - _motion(even, drive, k)[1]
    accelerations = np.linalg.solve(rows, gains)
    return with_drives(
        problem,
        [
            replace(
                drive,
                rate=float(rates[k]),
                acceleration=float(accelerations[k]),
                found_rates=FoundRates(derivatives=tuple(derivatives[k].tolist()))
                if _is_rated(drive) else None,
            )
            for k, drive in enumerate(drives)
        ],
    )  # fmt: skip


def _rate_key(drive: Drive) -> str:
    """Return the key of the rate of an output, or of an actuator."""
    if drive.output_rate is not None:
        return drive.output_rate.key
    return "v_" + "".join(drive.actuator or ())


def _motion(solution: Solution, drive: Drive, number: int) -> tuple[float, float, float]:
    """Return the rate and the acceleration that a driver gives, and the size of such rates."""
    if _is_rated(drive):
        return output_motion(solution, drive)
    own = solution.problem.drive.every[number]
    return own.rate, own.acceleration, 1.0


def _moving(problem: Problem, rates: Reals, accelerations: Reals) -> Solution:
    """Return the first position without loads, its drivers with given rates."""
    moved = [
        replace(drive, positions=drive.positions[:1], rate=float(rate), acceleration=float(gain))
        for drive, rate, gain in zip(problem.drive.every, rates, accelerations, strict=True)
    ]
    return Solution(replace(with_drives(problem, moved), dynamics=None))


def _accelerated(problem: Problem) -> Problem:
    """Return a problem whose drivers accelerate as their loads make them."""
    drives = problem.drive.every
    pushed = [k for k, drive in enumerate(drives) if drive.effort is not None]
    if not pushed:
        return problem
    from planmethod.solved.forces.statics import Statics  # motion needs no forces

    given = np.array([drives[k].effort for k in pushed], dtype=float)

    def balances(accelerations: Reals) -> Reals:
        moved = [replace(drive, positions=drive.positions[:1]) for drive in drives]
        for k, gain in zip(pushed, accelerations, strict=True):
            moved[k] = replace(moved[k], acceleration=float(gain))
        statics = Statics(Solution(with_drives(problem, moved)))
        others = [float(one[0]) for one in statics.other_balances.values()]
        every = [float(statics.balance[0]), *others]
        return np.array([every[k] for k in pushed])

    count = len(pushed)
    loads = balances(np.zeros(count))
    inertias = np.stack([balances(row) - loads for row in np.eye(count)], axis=1)
    size = np.max(np.abs(loads), initial=0.0)
    if np.linalg.matrix_rank(inertias, tol=_ENOUGH * size) != count:
        links = ", ".join(drives[k].link for k in pushed)
        hint = "Give masses that move, or the acceleration in place of the load."
        message = translate("no inertia is reduced to link {}", links)
        raise ProblemError(problem.name, [Fault("dynamics", message, translate(hint))])
    gains: Reals = np.asarray(np.linalg.solve(inertias, given - loads), dtype=float)
    for _ in range(_CORRECTIONS):  # this removes the rounding of a small difference
        missing = balances(gains) - given
        sizes = np.abs(given) + np.abs(loads) + np.abs(inertias) @ np.abs(gains)
        if not np.isfinite(missing).all() or (np.abs(missing) <= _ENOUGH * sizes).all():
            break
        step = np.linalg.solve(inertias, missing)
        if (np.abs(step) <= _ENOUGH * np.abs(gains)).all():
            break
        gains = gains - step
    found = list(drives)
    for row, k in enumerate(pushed):
        rates = drives[k].found_rates or FoundRates()
        if count == 1:
            rates = replace(rates, load=float(loads[0]), inertia=float(inertias[0, 0]))
        found[k] = replace(drives[k], acceleration=float(gains[row]), found_rates=rates)
    return with_drives(problem, found)
