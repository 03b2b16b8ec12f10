"""The flywheel: errors of its construction by the number of positions, and costs."""

from __future__ import annotations

from planmethod.bench.clock import clock
from planmethod.problem.load_records import Ordinates
from planmethod.problem.model import Problem
from planmethod.record import dataclass
from planmethod.solved.machine.flywheel import Flywheel
from planmethod.solved.machine.runup import RunUp

COUNTS = (12, 24, 36, 72, 144)
"""Positions of a cycle."""

WAYS = tuple((way, method) for method in ("wittenbauer", "mertsalov") for way in Ordinates)
"""How the work is integrated, and which tangents are drawn."""


@dataclass(frozen=True, slots=True)
class Constructed:
    """J_f by construction without a pencil, less the exact one, %.

    ``off`` has a number for each of `WAYS`; ``count`` is None of the whole curves.
    """

    count: int | None
    off: tuple[float, ...]


def constructed(wheel: Flywheel) -> list[Constructed]:
    """Measure the constructions by so many positions, and on the whole curves."""
    delta, exact = wheel.machine.delta, wheel.exact.inertia
    slopes = {"wittenbauer": (1.0 + delta, 1.0 - delta), "mertsalov": (1.0, 1.0)}

    def off(value: float) -> float:
        return 100.0 * (value / exact - 1.0)

    found = [
        Constructed(
            count,
            tuple(
                off(wheel.by_points(count, way, slopes[method]).tangents.inertia)
                for way, method in WAYS
            ),
        )
        for count in COUNTS
    ]
    whole = tuple(
        off(wheel.tangents(*slopes[method], wheel.middle_speed).inertia) for _, method in WAYS
    )
    return [*found, Constructed(None, whole)]


def costs(problem: Problem) -> list[tuple[str, float]]:
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
