"""Time against error: every way of reading a program, each beside how wrong it is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.bench.clock import Timing, clock
from planmethod.bench.peers import peers
from planmethod.bench.scenes import FOURBAR_ROWS, chain, fourbar, slotted
from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.condition import plain
from planmethod.construct.evaluate import evaluate
from planmethod.construct.referee import Precise
from planmethod.plans.legend import ZERO, Quantity, QuantityKind
from planmethod.problem.model import Problem
from planmethod.solved.many.sweep import Sweep
from planmethod.solved.results import results_of
from planmethod.solved.solution import Solution

Array = npt.NDArray[Any]

JUDGED = 60
"""Positions of a batch that the referee judges, evenly spread."""

RIGHT = 60
"""Digits of the referee that the errors are counted from."""

SIZES = (12, 10_000, 1_000_000)
"""Numbers of positions of the table of peers."""


@dataclass(frozen=True, slots=True)
class Reading:
    """One way of reading a program: its time for a position, and its error.

    Attributes
    ----------
    error : float
        Largest error of a row in units of the row's own largest value.
    """

    name: str
    scene: str
    positions: int
    seconds: float
    error: float

    @property
    def per_position(self) -> float:
        """Seconds for one position."""
        return self.seconds / self.positions


def turn(count: int) -> Array:
    """Return equally spaced angles over one turn, degrees."""
    return np.arange(count) * (360.0 / count)


def _spread(count: int) -> Array:
    return np.unique(np.linspace(0, count - 1, min(count, JUDGED)).astype(int))


def _right(problem: Problem, results: Sequence[Quantity], position: float) -> list[Number]:
    """Return results of one position by the referee."""
    solution = Solution(problem, positions=[position])
    whole = results_of(solution.construction)
    program = whole.program.needed_for([result.name for result in results])
    data = {**solution.data(), **whole.numbers}
    referee = Precise(RIGHT)
    lifted = {name: referee.lift(np.ravel(value)[0]) for name, value in data.items()}
    value = evaluate(program, lifted, referee).value
    return [plain(value[result.name]) for result in results]


@cache
def right_rows(scene: str, count: int) -> tuple[Array, Array]:
    """Return the rows of the four-bar or the slotted link in some positions of a turn, exactly.

    Returns
    -------
    chosen : ndarray of int
        Which of ``count`` positions.
    rows : ndarray of shape (k, len(chosen))
        Rounded from 60 digits.
    """
    problem, asked = scene_of(scene)
    solution = Solution(problem, positions=[0.0])
    results = results_of(solution.construction).choose(asked)
    chosen, angles = _spread(count), turn(count)
    columns = []
    for i in chosen:
        column: list[float] = []
        for result, value in zip(results, _right(problem, results, angles[i]), strict=True):
            column.append(float(value.real))
            if not result.kind.is_number:
                column.append(float(value.imag))
        columns.append(column)
    return chosen, np.array(columns).T


def scene_of(scene: str) -> tuple[Problem, Sequence[str] | None]:
    """Return a scene's problem and what is asked of it (directions as unit vectors)."""
    if scene == "four-bar":
        return fourbar(), FOURBAR_ROWS
    problem = slotted()
    whole = results_of(Solution(problem, positions=[0.0]).construction)
    return problem, [r.label for r in whole.all if r.kind is not QuantityKind.DIRECTION]


def row_error(scene: str, count: int, found: Array) -> float:
    """Return the largest error of a batch, each row in units of its own largest value."""
    chosen, right = right_rows(scene, count)
    size = np.abs(right).max(axis=1)
    some = size > 1e-12 * size.max()
    error = np.abs(found[:, chosen].astype(float) - right).max(axis=1)
    return float((error[some] / size[some]).max())


def sweeps(scene: str, counts: Sequence[int]) -> list[Reading]:
    """Time sweeps in float64 and float32, the output buffer passed in."""
    problem, asked = scene_of(scene)
    both = (np.dtype(np.float64), np.dtype(np.float32))
    return [
        _swept(scene, Sweep(problem, asked, dtype=dtype), count, dtype)
        for dtype in both
        for count in counts
    ]


def _swept(scene: str, sweep: Sweep, count: int, dtype: np.dtype[Any]) -> Reading:
    angles = turn(count).astype(dtype)
    out = None if count <= 40 else np.empty((len(sweep.rows), count), dtype)
    timing = clock(lambda: sweep.run(angles, out=out))
    error = row_error(scene, count, sweep.run(angles, out=out))
    return Reading(f"sweep, {dtype.name}", scene, count, timing.median, error)


def single_readings(scene: str) -> list[Reading]:
    """Time the step by step readings of one position: float64, referee, hand at several rulers."""
    problem, _ = scene_of(scene)
    position = 20.0
    solution = Solution(problem, positions=[position])
    found = [
        Reading(
            "step by step, float64",
            scene,
            1,
            clock(lambda: solution.read(Float64())).median,
            _trace_error(problem, solution, position, Float64()),
        ),
        Reading(
            "solve() from the problem, float64",
            scene,
            1,
            clock(lambda: Solution(problem, positions=[position]).points).median,
            _trace_error(problem, solution, position, Float64()),
        ),
    ]
    for digits in (16, 30, 50):
        found.append(
            Reading(
                f"referee, {digits} digits",
                scene,
                1,
                clock(lambda d=digits: _read(solution, Precise(d))).median,  # type: ignore[misc]
                _trace_error(problem, solution, position, Precise(digits)),
            )
        )
    for ruler in (0.1, 0.25, 0.5, 1.0):
        drawn = Solution(problem, positions=[position], ruler=ruler)
        found.append(
            Reading(
                f"the hand, ruler {ruler:g} mm",
                scene,
                1,
                clock(lambda s=drawn: s.read(s.hand, s.per_mm)).median,  # type: ignore[misc]
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
        r for r in results_of(solution.construction).all if r.kind not in LINES and r.name != ZERO
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
    """Return the largest error of what the hand finds in units of the largest of its kind."""
    worst = 0.0
    for letter, part in (("v", "velocity"), ("a", "acceleration")):
        exact = {name: abs(getattr(m, part)[0]) for name, m in solution.points.items()}
        size = max(exact.values()) or 1.0
        read = {name: solution.read_off(f"{letter}_{name}")[0] for name in exact}
        worst = max(worst, *(abs(read[name] - value) / size for name, value in exact.items()))
    return float(worst)


# Peers ------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Rival:
    """Somebody who solves the four-bar, at the sizes of the table.

    Attributes
    ----------
    seconds : dict of int to Timing
        By number of positions.
    error : dict of int to float
        As in `Reading`.
    """

    name: str
    computes: str
    seconds: dict[int, Timing]
    error: dict[int, float]


def rivals(sizes: Sequence[int] = SIZES, *, rounds: int = 3) -> list[Rival]:
    """Time this package and its peers on one four-bar, taking turns."""
    sweep = Sweep(fourbar(), FOURBAR_ROWS)
    angled = Sweep(fourbar(), [*(r for r in FOURBAR_ROWS if r[0] != "u"), "phi_2", "phi_3"])
    loose = Sweep(fourbar(), FOURBAR_ROWS)
    buffers = {n: np.empty((len(sweep.rows), n)) for n in sizes}
    more = {n: np.empty((len(angled.rows), n)) for n in sizes}
    angles = {n: turn(n) for n in sizes}
    shuffled = {n: np.random.default_rng(1).permutation(angles[n]) for n in sizes}

    def swept(n: int) -> Array:
        return sweep.run(angles[n], out=None if n <= 40 else buffers[n])

    def with_angles(n: int) -> Array:
        return angled.run(angles[n], out=None if n <= 40 else more[n])

    def uneven(n: int) -> Array:
        return loose.run(shuffled[n], out=None if n <= 40 else buffers[n])

    acts: list[tuple[str, str, Callable[[int], Array | None], tuple[int, ...]]] = [
        (
            "planmethod, sweep",
            "all points and links, 20 rows; directions as unit vectors",
            swept,
            tuple(range(20)),
        ),
        (
            "planmethod, sweep, phi in degrees",
            "all points and links, 18 rows; directions by the arc tangent",
            with_angles,
            (),
        ),
        ("planmethod, sweep, uneven phi", "20 rows, no table of angles", uneven, ()),
    ]
    for peer in peers():
        acts.append(
            (peer.name, peer.computes, lambda n, p=peer: p.run(angles[n]), peer.rows)  # type: ignore[misc]
        )
    times: dict[tuple[str, int], list[Timing]] = {}
    for _ in range(rounds):
        for n in sizes:
            for name, _, act, _ in acts:
                times.setdefault((name, n), []).append(
                    clock(lambda a=act, k=n: a(k), enough=0.25, least=3)  # type: ignore[misc]
                )
    found = []
    for name, computes, act, rows in acts:
        seconds = {n: sorted(times[name, n], key=lambda t: t.median)[rounds // 2] for n in sizes}
        error = {}
        for n in sizes if rows else ():
            answer = act(n)
            if answer is not None:
                chosen, right = right_rows("four-bar", n)
                part = right[list(rows)]
                gap = np.abs(answer[:, chosen] - part).max(axis=1)
                error[n] = float((gap / np.abs(part).max(axis=1)).max())
        found.append(Rival(name, computes, seconds, error))
    return found


# What grows with what ---------------------------------------------------------------------------


def by_positions(counts: Sequence[int]) -> list[tuple[int, float]]:
    """Return (positions, seconds) of a sweep of the slotted link."""
    problem, asked = scene_of("slotted-link")
    sweep = Sweep(problem, asked)
    found = []
    for n in counts:
        out = None if n <= 40 else np.empty((len(sweep.rows), n))
        angles = turn(n)
        found.append((n, clock(lambda a=angles, o=out: sweep.run(a, out=o)).median))  # type: ignore[misc]
    return found


def by_links(
    dyads: Sequence[int], *, count: int = 10_000
) -> list[tuple[int, int, float, float, float]]:
    """Return (links, steps, seconds to prepare, seconds for one position, for ``count``)."""
    found = []
    angles = turn(count)
    for k in dyads:
        problem = chain(k)
        ready = clock(lambda p=problem: Sweep(p), enough=0.2, least=3).median  # type: ignore[misc]
        sweep = Sweep(problem)
        out = np.empty((len(sweep.rows), count))
        one = clock(lambda s=sweep: s.run(angles[:1])).median  # type: ignore[misc]
        many = clock(lambda s=sweep, o=out: s.run(angles, out=o)).median  # type: ignore[misc]
        found.append((1 + 2 * k, sweep.steps, ready, one, many))
    return found


SCENES: tuple[tuple[str, tuple[str, ...] | None], ...] = (
    ("positions only", ("positions",)),
    ("one velocity", ("v_D",)),
    ("velocities", ("velocities",)),
    ("everything", None),
)
"""What scenes may ask for, least first."""


def by_scene(count: int = 10_000) -> list[tuple[str, int, int, float, float]]:
    """Return (what is asked, steps, operations, seconds for one position, for ``count``)."""
    problem = slotted()
    angles = turn(count)
    found = []
    for name, asked in SCENES:
        sweep = Sweep(problem, asked)
        out = np.empty((len(sweep.rows), count))
        one = clock(lambda s=sweep: s.run(angles[:1])).median  # type: ignore[misc]
        many = clock(lambda s=sweep, o=out: s.run(angles, out=o)).median  # type: ignore[misc]
        found.append((name, sweep.steps, sweep.operations, one, many))
    return found
