"""Times and errors of every way of evaluating a problem: programs, sheets, forces, the turn."""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.compiled import FEW
from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.drafting import PROFILES, Profile, RulerArithmetic
from planmethod.construct.dual import Precise, as_scalar
from planmethod.construct.evaluate import evaluate
from planmethod.errors import AssemblyError
from planmethod.plans.build import ZERO, Quantity
from planmethod.plans.forces.board import SCALE
from planmethod.problem.machine_records import Differentiation, Quadrature
from planmethod.problem.model import Problem
from planmethod.problem.quantities import Measure
from planmethod.solved.errors.forces import drawn_forces, size_label
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.errors.spread import SHORT, DrawnKind
from planmethod.solved.forces.statics import Statics, statics_of
from planmethod.solved.machine.flywheel import Flywheel
from planmethod.solved.machine.runup import RunUp
from planmethod.solved.many.sweep import Sweep
from planmethod.solved.quantities import quantities_of
from planmethod.solved.selfcheck import verify
from planmethod.solved.solution import EVERY, UNIT_SCALES, Solution
from planmethod.solved.turn.cycle import CrankCycle
from planmethod.solved.turn.diagrams import Deviation, Diagrams, deviations

DRAWS = 4000
SEED = 11


class Compared(Struct, frozen=True):
    """One problem drawn by one hand.

    Attributes
    ----------
    compared : int
        Quantities for which first order is valid and which are longer than three sigmas.
    minimum, maximum : float
        First-order sigma over the standard deviation of random sheets, over those quantities.
    nonlinear, short : int
        Quantities with the sigma of the sheets, first order being invalid; quantities
        shorter than three sigmas.
    """

    problem: str
    profile: str
    compared: int
    minimum: float
    maximum: float
    nonlinear: int
    short: int


def compare(problem: Problem, profile: Profile, *, draws: int = DRAWS) -> Compared:
    """Compare both ways of finding the drafting errors in every position of a problem."""
    solution = Solution(problem, profile=profile)
    drafting = drafting_of(solution)
    ratios: list[float] = []
    given_up = short = 0
    for i in range(len(solution.positions)):
        sheets = drafting.sample(i, draws=draws, seed=SEED)
        for label, spread in drafting.spreads.items():
            sigma, values = float(spread.sigma[i]), sheets[label]
            if sigma == 0:
                continue
            if (
                drafting.items[label].kind is DrawnKind.LENGTH
                and float(np.mean(values)) < SHORT * sigma
            ):
                short += 1
            elif spread.drawn[i]:
                given_up += 1
            else:
                ratios.append(sigma / float(np.std(values)))
    name = problem.name + (f" ({problem.variant})" if problem.variant else "")
    least, most = (min(ratios), max(ratios)) if ratios else (float("nan"), float("nan"))
    return Compared(name, profile.name, len(ratios), least, most, given_up, short)


def compare_all(problems: Sequence[Problem]) -> list[Compared]:
    """Compare every problem drawn by every hand."""
    return [compare(problem, profile) for problem in problems for profile in PROFILES.values()]


class Timing(Struct, frozen=True):
    """Median and spread of repeated runs, seconds."""

    median: float
    minimum: float
    maximum: float
    runs: int


def clock(
    act: Callable[[], object],
    *,
    enough: float = 0.4,
    min_runs: int = 5,
    timer: Callable[[], float] = time.perf_counter,
) -> Timing:
    """Time something warm: once to warm up, then until it has run long enough and often enough."""
    act()
    times: list[float] = []
    began = timer()
    while len(times) < min_runs or (timer() - began < enough and len(times) < 2000):
        start = timer()
        act()
        times.append(timer() - start)
    return Timing(statistics.median(times), min(times), max(times), len(times))


def clock_all(acts: Sequence[Callable[[], object]], *, rounds: int = 9) -> list[Timing]:
    """Time several functions in turns, so that other load of the machine affects all equally."""
    found: list[list[Timing]] = [[] for _ in acts]
    for _ in range(rounds):
        for own, act in zip(found, acts, strict=True):
            own.append(clock(act, enough=0.02, min_runs=3))
    return [sorted(own, key=lambda timing: timing.median)[rounds // 2] for own in found]


Array = npt.NDArray[Any]

CHECKED_MOTIONS = 60
"""Positions of a batch checked in high precision, evenly spread."""

RIGHT = 60
"""Digits of the referee that the errors are counted from."""


class ReadSpeed(Struct, frozen=True):
    """One way of reading a program: its time for a position, and its error.

    Attributes
    ----------
    error : float
        Largest error of a row in units of the row's own largest value; NaN if not checked.
    """

    name: str
    problem: str
    positions: int
    seconds: float
    error: float

    @property
    def per_position(self) -> float:
        """Seconds for one position."""
        return self.seconds / self.positions


def crank_angles(count: int) -> Array:
    """Return equally spaced angles over one turn, degrees."""
    return np.arange(count) * (360.0 / count)


def turns_round(problem: Problem) -> bool:
    """Return whether the driver is a crank that turns all round."""
    drive = problem.drive
    try:
        verify(Solution(problem, positions=(crank_angles(36) + drive.positions[0]).tolist()))
    except AssemblyError:
        return False
    return drive.is_crank


def places(problem: Problem, count: int) -> Array:
    """Return positions of the driver: round a turn, or those of the file over and over.

    Returns
    -------
    ndarray of shape (count,)
        Degrees, or metres of a slider.
    """
    if turns_round(problem):
        return crank_angles(count) + problem.drive.positions[0]
    return np.resize(np.array(problem.drive.positions), count)


def spread(count: int, limit: int = CHECKED_MOTIONS) -> Array:
    """Return the positions of a batch to check in high precision."""
    return np.unique(np.linspace(0, count - 1, min(count, limit)).astype(int))


def _right(problem: Problem, results: Sequence[Quantity], position: float) -> list[Number]:
    """Return results of one position by the referee."""
    solution = Solution(problem, positions=[position])
    whole = quantities_of(solution.construction)
    program = whole.program.needed_for([result.name for result in results])
    data = {**solution.data(), **whole.numbers}
    referee = Precise(RIGHT)
    lifted = {name: referee.lift(np.ravel(value)[0]) for name, value in data.items()}
    value = evaluate(program, lifted, referee).value
    return [as_scalar(value[result.name]) for result in results]


def right_rows(problem: Problem, labels: Sequence[str], positions: Array) -> Array:
    """Return the rows of a sweep, rounded from 60 digits: shape (rows, positions)."""
    results = quantities_of(Solution(problem).construction).choose(labels)
    columns = []
    for position in positions:
        column: list[float] = []
        for result, value in zip(results, _right(problem, results, position), strict=True):
            column.append(float(value.real))
            if not result.kind.is_number:
                column.append(float(value.imag))
        columns.append(column)
    return np.array(columns).T


def everything(problem: Problem) -> list[str]:
    """Return all quantities of a sweep, directions as unit vectors."""
    whole = quantities_of(Solution(problem).construction)
    return [r.label for r in whole.all if r.kind.measure is not Measure.ANGLE]


def row_error(right: Array, results: Array) -> float:
    """Return the largest error of a batch, each row in units of its own largest value."""
    size = np.abs(right).max(axis=1)
    some = size > 1e-12 * size.max()
    error = np.abs(results.astype(float) - right).max(axis=1)
    return float((error[some] / size[some]).max())


# no messages: a document for developers
def sweeps(
    problem: Problem, counts: Sequence[int], labels: Sequence[str] | None = None
) -> list[ReadSpeed]:
    """Time sweeps into buffers, taking turns: NumPy's blocks, machine code, float32, no work."""
    labels = everything(problem) if labels is None else labels
    machine = Sweep(problem, labels, native=True)
    kinds = [
        ("sweep, float64", Sweep(problem, labels, native=False)),
        ("sweep, machine code", machine),
        ("sweep, float32", Sweep(problem, labels, dtype=np.float32)),
    ]
    found = []
    for count in counts:
        batch = places(problem, count)
        right = right_rows(problem, labels, batch[spread(count)])
        acts: dict[str, Callable[[], Array | None]] = {}
        for name, sweep in kinds:
            if sweep is machine and machine.uncompiled:
                continue
            single = name.endswith("32")
            at = batch.astype(np.float32 if single else np.float64)
            out = np.empty((len(sweep.rows), count), at.dtype)
            some = out if count > FEW or sweep is machine else None
            acts[name] = partial(sweep.run, at, out=some)
            if sweep is machine:
                acts["sweep, bound call"] = machine.bind(at, out=out)
            elif not single:
                acts["its results stored, nothing computed"] = partial(out.fill, 1.0)
        for (name, act), timing in zip(acts.items(), clock_all(list(acts.values())), strict=True):
            answer = act()
            error = math.nan if answer is None else row_error(right, answer[:, spread(count)])
            found.append(ReadSpeed(name, problem.name, count, timing.median, error))
        if machine.uncompiled:
            name = f"sweep, machine code: {machine.uncompiled}"
            found.append(ReadSpeed(name, problem.name, count, math.nan, math.nan))
    return found


# no messages: a document for developers
def single_readings(problem: Problem) -> list[ReadSpeed]:
    """Time the step by step readings of one position: float64, referee, hand at several rulers."""
    position, name = problem.drive.positions[0], problem.name
    solution = Solution(problem, positions=[position])
    found = [
        ReadSpeed(
            "step by step, float64",
            name,
            1,
            clock(lambda: solution.read(Float64())).median,
            _trace_error(problem, solution, position, Float64()),
        ),
        ReadSpeed(
            "solve() from the problem, float64",
            name,
            1,
            clock(lambda: Solution(problem, positions=[position]).points).median,
            _trace_error(problem, solution, position, Float64()),
        ),
    ]
    for digits in (16, 30, 50):
        found.append(
            ReadSpeed(
                f"referee, {digits} digits",
                name,
                1,
                clock(lambda d=digits: _read(solution, Precise(d))).median,  # type: ignore[misc]
                _trace_error(problem, solution, position, Precise(digits)),
            )
        )
    for ruler in (0.1, 0.25, 0.5, 1.0):
        drawn = Solution(problem, positions=[position], ruler=ruler)
        found.append(
            ReadSpeed(
                f"the hand, ruler {ruler:g} mm",
                name,
                1,
                clock(lambda s=drawn: s.read(s.ruler_arithmetic, s.per_mm)).median,  # type: ignore[misc]
                _reading_error(drawn),
            )
        )
    return found


def _read(solution: Solution, arithmetic: Any) -> dict[Any, Number]:
    lifted = {n: arithmetic.lift(np.ravel(value)[0]) for n, value in solution.data().items()}
    return dict(evaluate(solution.construction.program, lifted, arithmetic).value)


def _trace_error(problem: Problem, solution: Solution, position: float, arithmetic: Any) -> float:
    """Return the largest error of a result in units of the largest result of its kind."""
    results = [
        r
        for r in quantities_of(solution.construction).all
        if r.kind.measure not in (Measure.ANGLE, Measure.DIRECTION) and r.name != ZERO
    ]
    right = _right(problem, results, position)
    found = _read(solution, arithmetic)
    worst = 0.0
    for kind in {r.kind for r in results}:
        pairs = [
            (value, found[r.name])
            for r, value in zip(results, right, strict=True)
            if r.kind is kind
        ]
        size = max(float(abs(value)) for value, _ in pairs)
        if size > 0:
            worst = max(worst, *(float(abs(value - _exact(got))) / size for value, got in pairs))
    return worst


def _exact(value: Number) -> Number:
    return value.item() if hasattr(value, "item") else value


def _reading_error(solution: Solution) -> float:
    """Return the largest error of the ruler readings in units of the largest of its kind."""
    worst = 0.0
    for letter, part in (("v", "velocity"), ("a", "acceleration")):
        exact = {name: abs(getattr(m, part)[0]) for name, m in solution.points.items()}
        size = max(exact.values()) or 1.0
        read = {name: solution.read_off(f"{letter}_{name}")[0] for name in exact}
        worst = max(worst, *(abs(read[name] - value) / size for name, value in exact.items()))
    return float(worst)


CHECKED_FORCES = 12
"""Positions of a batch checked in high precision, evenly spread."""


SI = {**UNIT_SCALES, SCALE: 1.0}


def forces_of(statics: Statics, value: Any) -> list[Number]:
    """Return the reactions and the balance of a trace."""
    found = [value[r.force.head] - value[r.force.tail] for r in statics.board.reactions]
    return [*found, value[statics.driving.balance]]


def error_of(statics: Statics, results: Sequence[Array]) -> float:
    """Return the largest error of a position in units of its largest force (and moment)."""
    worst = 0.0
    for i in spread(len(statics.solution.positions), CHECKED_FORCES):
        right = _reference_forces(statics, RIGHT, int(i))
        exact = [complex(as_scalar(value)) for value in right]
        size = max(abs(force) for force in exact[:-1])
        gaps = [abs(complex(row[i]) - v) for row, v in zip(results, exact, strict=True)]
        worst = max(worst, max(gaps[:-1]) / size, gaps[-1] / max(abs(exact[-1]), 1e-9 * size))
    return worst


def _reference_forces(statics: Statics, digits: int, index: int = 0) -> list[Number]:
    """Return the forces of a position in multiprecision arithmetic with a number of digits."""
    referee = Precise(digits)
    data = statics.data(SI, EVERY)
    at = {name: value[index] if np.ndim(value) else value for name, value in data.items()}
    lifted = {name: referee.lift(value) for name, value in at.items()}
    return forces_of(statics, evaluate(statics.program, lifted, referee).value)


def _batch(statics: Statics, trace: Any) -> list[Array]:
    shape = statics.solution.positions.shape
    return [np.broadcast_to(row, shape) for row in forces_of(statics, trace.value)]


def readings(problem: Problem, counts: Sequence[int]) -> list[ReadSpeed]:
    """Time the force plans, the motion alone, and the ruler readings."""
    found: list[ReadSpeed] = []
    for count in counts:
        solution = Solution(problem, positions=places(problem, count).tolist())
        statics = statics_of(solution)

        def read(s: Statics = statics) -> Any:
            return s.read(Float64(), SI)

        def read_motion(s: Solution = solution) -> Any:
            return s.read(Float64(), UNIT_SCALES)

        name = problem.name
        found += [
            ReadSpeed(
                "motion alone, step by step",
                name, count, clock(read_motion).median, float("nan"),
            ),
            ReadSpeed(
                "motion and force plans, step by step",
                name, count, clock(read).median, error_of(statics, _batch(statics, read())),
            ),
        ]  # fmt: skip
    return [*found, *_of_one(problem)]


# no messages: a document for developers
def _of_one(problem: Problem) -> list[ReadSpeed]:
    """Time the readings of one position: planning, high precision, ruler."""
    position = problem.drive.positions[0]
    solution = Solution(problem, positions=[position])
    statics, name = statics_of(solution), problem.name

    def precisely() -> list[Number]:
        return _reference_forces(statics, 50)

    found = [
        ReadSpeed(
            "force plans planned, from the solution",
            name, 1, clock(lambda: Statics(solution)).median, float("nan"),
        ),
        ReadSpeed(
            "referee, 50 digits",
            name, 1, clock(precisely).median, _precise_error(statics, precisely()),
        ),
    ]  # fmt: skip
    for ruler in (0.1, 0.5, 1.0):
        drawn = statics_of(Solution(problem, positions=[position], ruler=ruler))
        reading = clock(lambda s=drawn: s.read(s.solution.ruler_arithmetic, s.per_mm))  # type: ignore[misc]
        found.append(
            ReadSpeed(
                f"the hand, ruler {ruler:g} mm",
                name,
                1,
                reading.median,
                _force_reading_error(drawn),
            )
        )
    return found


def _precise_error(statics: Statics, results: Sequence[Number]) -> float:
    right = _reference_forces(statics, RIGHT)
    size = max(abs(as_scalar(force)) for force in right[:-1])
    return float(
        max(abs(as_scalar(a) - as_scalar(b)) for a, b in zip(results, right, strict=True)) / size
    )


def _force_reading_error(statics: Statics) -> float:
    """Return the largest error of a reaction's ruler reading, relative to the largest reaction."""
    sizes = [abs(joint.force[0]) for joint in statics.reactions]
    read = [drawn_forces(statics).read(size_label(joint))[0] for joint in statics.reactions]
    gaps = [abs(one - size) for one, size in zip(read, sizes, strict=True)]
    return float(max(gaps) / max(sizes))


class Discrepancy(Struct, frozen=True):
    """Lever minus force plans of one problem over a turn, as a board draughtsman has it.

    Attributes
    ----------
    positions : int
    minimum, maximum : float
        First-order sigma over that of random sheets (half of the middle 68 %).
    usual : (float, float)
        Smallest and largest sigma as a part of the largest balance of the turn.
    """

    problem: str
    positions: int
    minimum: float
    maximum: float
    usual: tuple[float, float]


def discrepancy(problem: Problem) -> Discrepancy:
    """Compare the expected discrepancy with random sheets.

    In twelve positions of a turn; in those of the file where the driver cannot turn all round.
    """
    around = places(problem, 12).tolist() if turns_round(problem) else None
    statics = statics_of(Solution(problem, positions=around))
    positions = statics.solution.positions
    sigma = drawn_forces(statics).discrepancy_sigma
    assert sigma is not None
    ratios = []
    for i in range(len(positions)):
        sheets = drawn_forces(statics).sample(i, draws=DRAWS, seed=SEED)["difference"]
        low, high = np.quantile(sheets, (0.16, 0.84))
        ratios.append(float(sigma[i]) / float((high - low) / 2))
    largest = float(np.abs(statics.balance).max())
    usual = float(sigma.min()) / largest, float(sigma.max()) / largest
    return Discrepancy(problem.name, len(positions), min(ratios), max(ratios), usual)


COUNTS = (12, 24, 36, 72, 144)
"""Positions of a turn."""

SWEPT = (12, 360, 36_000)
"""Positions of a turn that are timed."""

RULERS = (0.1, 0.5, 1.0)
"""Ruler steps for reading the path, mm."""


class Calculus(Struct, frozen=True):
    """Errors of graphical calculus with a number of positions, mm of the diagrams.

    ``v`` and ``a`` by chords, ``s`` integrated from exact velocities by middle ordinates;
    ``ruler_effect``: by how much a ruler moves v and a, at the most, for each of `RULERS`.
    """

    count: int
    v: Deviation
    a: Deviation
    s: Deviation
    ruler_effect: tuple[tuple[float, float], ...]


def turn_for(problem: Problem) -> CrankCycle | None:
    """Return the cycle of a problem; None without a fully rotating crank."""
    if not problem.drive.goes_round:
        return None
    turn = CrankCycle(Solution(problem))
    return None if turn.range is not None else turn


def calculus(turn: CrankCycle, count: int) -> Calculus:
    """Measure the errors of graphical differentiation and integration for a number of positions."""
    diagrams, way = Diagrams(turn, count), Differentiation.CHORDS
    found = deviations(diagrams, [way])
    s = Deviation.of(diagrams.integrated(), diagrams.exact(diagrams.fractions)[0])
    _, v, a = diagrams.drawn(way)
    moved = []
    for ruler in RULERS:
        _, read_v, read_a = diagrams.drawn(way, RulerArithmetic(ruler=ruler))
        moved.append((float(np.nanmax(np.abs(read_v - v))), float(np.nanmax(np.abs(read_a - a)))))
    return Calculus(count, found[way, "v"], found[way, "a"], s, tuple(moved))


def ruler_limit_count(rows: list[Calculus], which: int) -> int | None:
    """Return the smallest count at which the ruler affects v more than the construction errs."""
    return next((row.count for row in rows if row.ruler_effect[which][0] > row.v.maximum), None)


def _diagrams(turn: CrankCycle, count: int) -> None:
    Diagrams(turn, count).drawn(Differentiation.CHORDS)


def costs(problem: Problem) -> list[tuple[str, int, float]]:
    """Return times of a cycle, s: its characteristics, diagrams, exact positions."""
    turn = CrankCycle(Solution(problem))
    facts = clock(lambda: CrankCycle(Solution(problem)).pressure, min_runs=3).median
    found = [("range, extremes, pressure angle", 1, facts)]
    for count in (COUNTS[0], COUNTS[-1]):
        found.append(("diagrams by chords", count, clock(partial(_diagrams, turn, count)).median))
    for count in SWEPT:
        at = turn.at(np.arange(count) / count)
        found.append(("exact positions", count, clock(partial(turn.read, at)).median))
    return found


METHODS = tuple((way, method) for method in ("wittenbauer", "mertsalov") for way in Quadrature)
"""Methods: how the work is integrated, and which tangents are drawn."""


class Constructed(Struct, frozen=True):
    """J_f by construction without drafting errors, minus the exact one, %.

    ``off`` has a number for each of `METHODS`; ``count`` is None for the whole curves.
    """

    count: int | None
    off: tuple[float, ...]


def constructed(wheel: Flywheel) -> list[Constructed]:
    """Measure the constructions by numbers of positions, and on the whole curves."""
    delta, exact = wheel.machine.delta, wheel.exact.inertia
    slopes = {"wittenbauer": (1.0 + delta, 1.0 - delta), "mertsalov": (1.0, 1.0)}

    def off(value: float) -> float:
        return 100.0 * (value / exact - 1.0)

    found = [
        Constructed(
            count,
            tuple(
                off(wheel.by_points(count, way, slopes[method]).tangents.inertia)
                for way, method in METHODS
            ),
        )
        for count in COUNTS
    ]
    whole = tuple(
        off(wheel.tangents(*slopes[method], wheel.middle_speed).inertia) for _, method in METHODS
    )
    return [*found, Constructed(None, whole)]


def flywheel_costs(problem: Problem) -> list[tuple[str, float]]:
    """Return seconds, warm: the exact flywheel from the problem on, its check, a run-up."""
    found = [
        ("exact J_f, from the problem", clock(lambda: Flywheel(problem).exact).median),
        ("check by the equation of motion", clock(lambda: Flywheel(problem).integrated).median),
    ]
    if problem.machine is not None and problem.machine.motor is not None:
        found.append(
            ("run-up and steady motion", clock(lambda: RunUp(Flywheel(problem)).run_up).median)
        )
    return found
