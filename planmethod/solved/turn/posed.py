"""Positions of the driver determined by an output, as roots (положение, заданное выходом).

The rules select an assembly in the position that is sought, so every assembly that exists in some
position is tried, and a root counts if the rules select that assembly there.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64
from planmethod.construct.curves import by_rows, crossings, roots_between, tops
from planmethod.construct.steps import PointName
from planmethod.errors import AssemblyError, Fault, PlanMethodError, ProblemError
from planmethod.languages import translate
from planmethod.problem.keys import EXTREMES, GOING
from planmethod.problem.machine_records import Zero
from planmethod.problem.model import OutputPositionKind, OutputPositions, Problem
from planmethod.problem.names import UNITS, format_length, split_pair
from planmethod.solved.failures import PositionError
from planmethod.solved.reading import Flags, Reading, Reals
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import SAMPLES, TURN, CrankCycle, Extreme
from planmethod.solved.turn.given_rates import find_rates

_TRIES = 36  # positions of a turn in which it is tried how the groups close
_SLIDER_TRIES = 120
_SINGULAR_OFFSET = 0.0931  # degrees off round numbers, at which singular places are common
_SAME = 1e-7  # degrees, or share of the way of a slider, within which two roots are one
_ROUNDING = 1e-15  # share of the range within which a round position is as good as the root
_OFF = 1e-6  # share of the range of the output that a root may miss it by


DriverPositions = list[tuple[float, float]]
"""Positions of the driver, each with the sense in which the output goes there: 1, -1 or 0."""


def pose_driver(problem: Problem) -> Problem:
    """Return a problem of one driver with the position and the rates that follow.

    Raises
    ------
    ProblemError, AssemblyError
        As of `placed_by_output` and `find_rates`.
    """
    placed = placed_by_output(problem)
    known = all(np.isfinite(placed.drive.positions))
    return find_rates(placed) if known else placed


def placed_by_output(problem: Problem) -> Problem:
    """Return a problem with the positions that its output determines.

    Raises
    ------
    ProblemError
        Several positions fit and no ``root`` selects one, or the groups have no assembly that the
        file's rules allow.
    AssemblyError
        The output never reaches the value.
    """
    posed = problem.drive.posed
    if posed is None:
        return problem
    ways, trouble = assemblies_of(problem)
    if isinstance(trouble, ProblemError | PositionError) and not ways:
        raise trouble
    if not ways:  # a mechanism that has no plans has no positions
        return problem
    first: list[tuple[Solution, float, float]] = []
    for solution in ways:
        for position, going in _roots(solution, posed, 0):
            if not in_first_mode(solution, np.array([position])).all():
                continue  # the motion continues like this, but the rules do not hold there
            position = position % TURN if problem.drive.is_crank else position
            at = closed_at(problem, position)
            if at is not None and sides_of(at) == sides_of(solution):
                first.append((at, position, going))
    chosen = _chosen(problem, posed, 0, [(p, going) for _, p, going in first], ways)
    solution = next(s for s, p, _ in first if p == chosen)
    positions = [chosen]
    for index in range(1, len(posed.values)):
        found = _roots(solution, posed, index)
        positions.append(_chosen(problem, posed, index, found, [solution]))
    return replace(problem, drive=replace(problem.drive, positions=tuple(positions)))


def closed_at(problem: Problem, position: float) -> Solution | None:
    """Return the mechanism as its rules close it in a position; None where they do not."""
    drive = replace(problem.drive, positions=(position,))
    try:
        return Solution(replace(problem, drive=drive))
    except PlanMethodError:
        return None


def assemblies_of(problem: Problem) -> tuple[list[Solution], PlanMethodError | None]:
    """Return the assemblies that the rules select, and the error where they select none."""
    ways: dict[object, Solution] = {}
    trouble: PlanMethodError | None = None
    count = _TRIES if problem.drive.is_crank else _SLIDER_TRIES
    for position in positions_between(problem, count):
        drive = replace(problem.drive, positions=(float(position),))
        try:
            solution = Solution(replace(problem, drive=drive))
        except PlanMethodError as error:
            trouble = error
            continue
        ways.setdefault(repr(sides_of(solution)), solution)
    if not ways:  # the error in the first position that can be assembled
        drive = replace(
            problem.drive, positions=tuple(positions_between(problem, SAMPLES).tolist())
        )
        try:
            Solution(replace(problem, drive=drive))
        except PlanMethodError as error:
            trouble = error
    return list(ways.values()), trouble


def sides_of(solution: Solution) -> list[tuple[tuple[str, ...], int, bool]]:
    """Return how the groups of a solution close."""
    choice = solution.construction.draft.choice
    return sorted((links, one.side, one.parallel) for links, one in choice.items())


def positions_between(problem: Problem, count: int, turns: int = 1) -> Reals:
    """Return positions over turns, ``count`` in each, or over the whole range of a slider."""
    if problem.drive.is_crank:
        return _SINGULAR_OFFSET + TURN * np.arange(count * turns + 1) / count
    sizes = [abs(length) for _, _, length in problem.lengths]
    sizes += [abs(place) for body in problem.bodies.values() for place in body.points.values()]
    reach = sum(sizes)
    return np.linspace(-reach, reach, count + 1) * (1.0 + 1e-3 * _SINGULAR_OFFSET)


def in_first_mode(solution: Solution, positions: Reals) -> Flags:
    """Return where a motion has its first assembly modes, for which the rules are evaluated."""
    kept = np.ones(positions.shape, dtype=bool)
    for closing in solution.construction.draft.choice.values():
        kept &= closing.branch(positions) > 0
    return kept


def _value(solution: Solution, posed: OutputPositions, index: int) -> Callable[[Reals], Reals]:
    """Return a function that gives the output in positions of the driver: m or degrees."""
    read = output_reader(solution, posed, index)
    return lambda at: read(solution.with_positions(at.tolist()).read(Float64()))


def output_reader(
    solution: Solution, posed: OutputPositions, index: int
) -> Callable[[Reading], Reals]:
    """Return a function that gives the output of a reading: m or degrees.

    The angle between links is signed, from the first to the second; a distance from a line, too.
    """
    draft = solution.construction.draft

    def angle(reading: Reading) -> Reals:
        return np.asarray(np.degrees(np.angle(reading.line_vector(draft.axes[posed.of]))))

    def between(reading: Reading) -> Reals:
        one, two = (
            reading.line_vector(draft.axis(link)) * way
            for link, way in _rays(solution.problem, posed)
        )
        return np.asarray(np.degrees(np.angle(two * np.conj(one))))

    def place(reading: Reading) -> Reals:
        at = reading.point(PointName(posed.of)) + draft.origin
        return np.asarray(at.real if posed.by is OutputPositionKind.X else at.imag)

    def length(reading: Reading) -> Reals:
        one, two = split_pair(posed.of) or ("", "")
        return np.abs(reading.vector(PointName(one), PointName(two)))

    def line_distance(reading: Reading) -> Reals:
        point, _, line = posed.extremes[index].partition(" on ")
        one, two = split_pair(line) or ("", "")
        along = reading.vector(PointName(one), PointName(two))
        off = reading.vector(PointName(one), PointName(point))
        return np.asarray((off * np.conj(along)).imag / np.abs(along))

    told = {
        OutputPositionKind.LENGTH: length,
        OutputPositionKind.PHI: angle,
        OutputPositionKind.BETWEEN: between,
        OutputPositionKind.LINE: line_distance,
    }
    return told.get(posed.by, place)


def _rays(problem: Problem, posed: OutputPositions) -> list[tuple[str, float]]:
    """Return two links with the sense of each own axis in which it leads from their common pin.

    Links without one have the angle of their axes as the file directs them.
    """
    one, two = posed.of.split("_")
    bodies = problem.bodies
    pins = {*bodies[one].points} & {*bodies[two].points}
    return [
        (link, -1.0 if (axis := bodies[link].axis) is not None and axis[1] in pins else 1.0)
        for link in (one, two)
    ]


def period_of(problem: Problem, posed: OutputPositions) -> float:
    """Return after how many degrees a value is the same; of no angle infinity.

    A slider's axis is its guide, and has no sense.
    """
    if posed.by is OutputPositionKind.PHI:
        return TURN
    if posed.by is not OutputPositionKind.BETWEEN:
        return np.inf
    lettered = [problem.bodies[link].axis is not None for link in posed.of.split("_")]
    return TURN if all(lettered) else TURN / 2


def _roots(solution: Solution, posed: OutputPositions, index: int) -> DriverPositions:
    """Return the positions in which the output has a given value."""
    if posed.by is OutputPositionKind.EXTREME:
        return _extreme(CrankCycle(solution), posed, index)
    target = posed.values[index]
    crank, period = solution.problem.drive.is_crank, period_of(solution.problem, posed)
    grid = positions_between(
        solution.problem, SAMPLES if crank else 3 * SAMPLES, solution.closing_turns
    )
    whole = TURN * solution.closing_turns
    sense = -1.0 if solution.problem.drive.rate < 0 else 1.0
    value = _value(solution, posed, index)
    if posed.by is OutputPositionKind.STROKE:
        turn = CrankCycle(solution)
        start, end = _ends(turn)
        value, target = turn.values, start.value + target * (end.value - start.value)
        if posed.values[index] in (0.0, 1.0):
            return [((start, end)[int(posed.values[index])].phi % whole, 0.0)]
        sense = -sense if end.value < start.value else sense
    found: DriverPositions = []
    # An angle of two links has no sign: both ways of it are looked for.
    for one in {target, -target} if posed.by is OutputPositionKind.BETWEEN else (target,):

        def off(positions: Reals, one: float = one) -> Reals:
            return missed_by(value(positions) - one, period)

        found += [(at % whole if crank else at, sense * going) for at, going in _zeros(off, grid)]
    return found


def missed_by(off: Reals, period: float) -> Reals:
    """Return differences from a target, of angles within half a period."""
    half = period / 2
    return off if np.isinf(period) else (off + half) % period - half


def _zeros(off: Callable[[Reals], Reals], grid: Reals) -> DriverPositions:
    """Return the zeros of a function and whether it grows there; 0 where it only touches zero.

    A change of sign by a jump, of an angle by a turn, is none.
    """
    looks, rows = off(grid), by_rows(off)
    size = float(np.nanmax(np.abs(looks))) if np.isfinite(looks).any() else 0.0

    k = crossings(looks)
    brackets = [np.stack([grid[k], grid[k + 1], np.sign(looks[k + 1] - looks[k])])]
    touching: DriverPositions = []
    # Between neighbours it may touch zero, or pass it and return. All such places are looked at
    # together: where the output stays as it is, each position is one of them.
    near, signs = np.abs(looks), np.sign(looks)
    one = np.arange(len(grid) - 1)
    before = np.where(one == 0, len(grid) - 2, one - 1)  # of a turn the last but one
    same = (signs[before] == signs[one]) & (signs[one] == signs[one + 1]) & (signs[one] != 0.0)
    least = near[one] <= np.minimum(near[before], near[one + 1])
    low = grid[one[same & least]] - (grid[1] - grid[0])
    high, sign = grid[one[same & least] + 1], signs[one[same & least]]
    there = np.isfinite(off(low)) if low.size else np.zeros(0, dtype=bool)
    low, high, sign = low[there], high[there], sign[there]
    if low.size:
        at, beyond = tops(lambda places: -sign[:, np.newaxis] * rows(places), low, high)
        twice = beyond > 1e-12 * size
        brackets += [np.stack([low, at, -sign])[:, twice], np.stack([at, high, sign])[:, twice]]
        touching = [(float(place), 0.0) for place in at[~twice & (-beyond <= _OFF * size)]]
    low, high, going = np.concatenate(brackets, axis=1)
    if not low.size:
        return touching
    at = roots_between(rows, low, high)
    round_one = np.round(at, 6)  # 90 degrees, not its rounded value
    missed, of_round = np.abs(off(at)), np.abs(off(round_one))
    is_round = of_round <= np.maximum(missed, _ROUNDING * size)
    at = np.where(is_round & (np.abs(round_one - at) < _SAME), round_one, at)
    kept = missed <= _OFF * size
    return [*touching, *zip(at[kept].tolist(), going[kept].tolist(), strict=True)]


def _ends(cycle: CrankCycle) -> tuple[Extreme, Extreme]:
    """Return the extreme that ``zero`` names, by default the usual one, and the other one."""
    if cycle.ends is None:
        why = cycle.why_no_stroke
        raise _unknown(
            cycle.solution, translate("the output has no stroke: {}", why.value if why else "")
        )
    return cycle.ends if cycle.task.zero is Zero.USUAL else cycle.ends_from_zero


def _extreme(cycle: CrankCycle, posed: OutputPositions, index: int) -> DriverPositions:
    """Return the position at a given angle of the crank after an extreme."""
    where, after = posed.extremes[index], cycle.sense * posed.values[index]
    if where in EXTREMES:
        phi = np.array([one.phi for one in cycle.extremes])
        if not phi.size:
            raise _unknown(cycle.solution, "the output has no extreme position")
        place = cycle.read(phi).point(PointName(cycle.output.point))
        along = place.real if where in ("left", "right") else place.imag
        chosen = phi[int(np.argmin(along) if where in ("left", "lower") else np.argmax(along))]
    else:
        chosen = _ends(cycle)[1 if where == "other" else 0].phi
    return [(float(chosen + after) % cycle.period, 0.0)]


def _unknown(solution: Solution, message: str) -> ProblemError:
    drive = solution.problem.drive
    assert drive.posed is not None
    hint = "Name the output: [cycle] output = ..., or give the angle of the crank"
    return ProblemError(solution.problem.name, [Fault(f"driver.{drive.posed.key}", message, hint)])


def _chosen(
    problem: Problem,
    posed: OutputPositions,
    index: int,
    candidates: DriverPositions,
    assemblies: list[Solution],
) -> float:
    """Return the one position that is meant."""
    drive, phrase = problem.drive, output_phrase(posed, index, problem)
    candidates = sorted(candidates)
    kept = [
        one for k, one in enumerate(candidates) if not k or one[0] - candidates[k - 1][0] > _SAME
    ]
    if not kept:
        reached = ""
        if posed.of:
            every = np.concatenate([_reached(way, posed, index) for way in assemblies])
            every = np.abs(every) if posed.by is OutputPositionKind.BETWEEN else every
            ends = [value_text(posed, float(end(every)), problem) for end in (np.nanmin, np.nanmax)]
            reached = translate(
                ": {} ranges from {} to {} in these assemblies", posed.key, ends[0], ends[1]
            )
        raise AssemblyError(
            "{}: {} is not reached{}. Check driver.{}, the lengths, and whether the rules "
            "of [assembly] hold in this position.",
            problem.name,
            phrase,
            reached,
            posed.key,
        )
    if posed.nearest_to is not None:
        asked, whole = posed.nearest_to, TURN * assemblies[0].closing_turns if index else TURN
        if not drive.is_crank:
            return min((p for p, _ in kept), key=lambda p: abs(p - asked))
        half = whole / 2
        return min((p for p, _ in kept), key=lambda p: abs((p - asked + half) % whole - half))
    ways_of = GOING.get(posed.by.value, ("", ""))
    if posed.going:
        kept = [one for one in kept if one[1] == (1.0 if posed.going == ways_of[0] else -1.0)]
        phrase = translate("{}, going {},", phrase, posed.going)
    if posed.number and posed.number <= len(kept):
        return kept[posed.number - 1][0]
    if len(kept) == 1 and not posed.number:
        return kept[0][0]
    per = 1.0 if drive.is_crank else UNITS[problem.unit]
    places = [f"{p * per:.5g}" for p, _ in kept]
    name = drive.coordinate.name
    text = ", ".join(f"{name} = {place}" for place in places) or translate("no position")
    senses = [going for _, going in kept]
    near = ", ".join(f'root = "near {place}"' for place in places)
    if posed.number:
        message = translate(
            "{} matches {}: position {} of them does not exist", phrase, text, posed.number
        )
        raise ProblemError(
            problem.name, [Fault("driver.root", message, translate("Give one of {}", near))]
        )
    hint = translate("Give one of {}", near) if places else "Omit root to see the positions"
    if ways_of[0] and senses in ([1.0, -1.0], [-1.0, 1.0]):
        one, two = ways_of[:: 1 if senses[0] > 0 else -1]
        hint = translate(
            'Give root = "going {}" for the first or root = "going {}" for the second', one, two
        )
    message = translate("{} matches {}, but one position is required", phrase, text)
    raise ProblemError(problem.name, [Fault("driver.root", message, hint)])


def output_phrase(posed: OutputPositions, index: int, problem: Problem) -> str:
    """Return a given position of the output as the file has it: ``x_B = 120 mm``."""
    if posed.by is OutputPositionKind.EXTREME:
        phrase = f"at = extreme {posed.extremes[index]} {posed.values[index]:+g}"
        return phrase.replace(" +0", "").strip()
    if posed.by is OutputPositionKind.LINE:
        return f"at = {posed.extremes[index]}"
    return f"{posed.key} = {value_text(posed, posed.values[index], problem)}"


def _reached(solution: Solution, posed: OutputPositions, index: int) -> Reals:
    """Return the values of the output in all sampled positions."""
    grid = positions_between(solution.problem, SAMPLES, solution.closing_turns)
    grid = grid if index else grid[in_first_mode(solution, grid)]
    return _value(solution, posed, index)(grid)


def value_text(posed: OutputPositions, value: float, problem: Problem) -> str:
    """Return a value of the output in the file's units, as text."""
    if posed.by in (OutputPositionKind.X, OutputPositionKind.Y, OutputPositionKind.LENGTH):
        return format_length(value, problem.unit, 5)
    return translate(
        "{:.5g} deg"
        if posed.by in (OutputPositionKind.PHI, OutputPositionKind.BETWEEN)
        else "{:.5g}",
        value,
    )
