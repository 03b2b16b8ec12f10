"""Times and errors of every way of evaluating a problem's program."""

# no messages: a document for developers

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
from planmethod.construct.condition import as_scalar
from planmethod.construct.evaluate import evaluate
from planmethod.construct.multiprecision import Precise
from planmethod.errors import AssemblyError
from planmethod.plans.legend import ZERO, Quantity, QuantityKind
from planmethod.problem.model import Problem
from planmethod.solved.many.sweep import Sweep
from planmethod.solved.quantities import quantities_of
from planmethod.solved.selfcheck import verify
from planmethod.solved.solution import Solution


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

CHECKED_POSITIONS = 60
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


def spread(count: int, limit: int = CHECKED_POSITIONS) -> Array:
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
    return [r.label for r in whole.all if r.kind is not QuantityKind.DIRECTION]


def row_error(right: Array, results: Array) -> float:
    """Return the largest error of a batch, each row in units of its own largest value."""
    size = np.abs(right).max(axis=1)
    some = size > 1e-12 * size.max()
    error = np.abs(results.astype(float) - right).max(axis=1)
    return float((error[some] / size[some]).max())


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
                _hand_error(drawn),
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
        if r.kind not in LINES and r.name != ZERO
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


LINES = (QuantityKind.DIRECTION, QuantityKind.UNIT)


def _exact(value: Number) -> Number:
    return value.item() if hasattr(value, "item") else value


def _hand_error(solution: Solution) -> float:
    """Return the largest error of the ruler readings in units of the largest of its kind."""
    worst = 0.0
    for letter, part in (("v", "velocity"), ("a", "acceleration")):
        exact = {name: abs(getattr(m, part)[0]) for name, m in solution.points.items()}
        size = max(exact.values()) or 1.0
        read = {name: solution.read_off(f"{letter}_{name}")[0] for name in exact}
        worst = max(worst, *(abs(read[name] - value) / size for name, value in exact.items()))
    return float(worst)
