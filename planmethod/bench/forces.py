"""Force plans: time and error, and the lever compared with the force plans."""

# no messages: a document for developers

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.bench.speed import RIGHT, ReadSpeed, clock, places, spread, turns_round
from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.condition import as_scalar
from planmethod.construct.evaluate import evaluate
from planmethod.construct.multiprecision import Precise
from planmethod.plans.forces.board import SCALE
from planmethod.problem.model import Problem
from planmethod.solved.errors.forces import drawn_forces, size_label
from planmethod.solved.forces.statics import Statics, statics_of
from planmethod.solved.solution import EVERY, UNIT_SCALES, Solution

Array = npt.NDArray[Any]

CHECKED_POSITIONS = 12
"""Positions of a batch checked in high precision, evenly spread."""

DRAWS = 4000
SEED = 11

SI = {**UNIT_SCALES, SCALE: 1.0}


def forces_of(statics: Statics, value: Any) -> list[Number]:
    """Return the reactions and the balance of a trace."""
    found = [value[r.force.head] - value[r.force.tail] for r in statics.board.reactions]
    return [*found, value[statics.driving.balance]]


def error_of(statics: Statics, results: Sequence[Array]) -> float:
    """Return the largest error of a position in units of its largest force (and moment)."""
    worst = 0.0
    for i in spread(len(statics.solution.positions), CHECKED_POSITIONS):
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
            ReadSpeed(f"the hand, ruler {ruler:g} mm", name, 1, reading.median, _hand_error(drawn))
        )
    return found


def _precise_error(statics: Statics, results: Sequence[Number]) -> float:
    right = _reference_forces(statics, RIGHT)
    size = max(abs(as_scalar(force)) for force in right[:-1])
    return float(
        max(abs(as_scalar(a) - as_scalar(b)) for a, b in zip(results, right, strict=True)) / size
    )


def _hand_error(statics: Statics) -> float:
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
