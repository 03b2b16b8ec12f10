"""Transfer functions: derivatives by the coordinate of the driver (аналоги)."""

from __future__ import annotations

from msgspec.structs import replace

from planmethod.problem.model import Problem
from planmethod.solved.reading import Reals, remembered
from planmethod.solved.solution import PointMotion, Solution


def at_unit_rate(problem: Problem) -> Problem:
    """Return a problem driven at one radian, or metre, a second: rates are analogues."""
    drive = replace(problem.drive, rate=1.0, acceleration=0.0)
    return replace(problem, drive=drive, dynamics=None)


@remembered
def analogues(solution: Solution) -> tuple[dict[str, PointMotion], dict[str, tuple[Reals, Reals]]]:
    """Return first and second transfer functions in the positions of a solution (аналоги).

    Returns
    -------
    points : dict
        Motions at one radian (or metre) a second: velocity dx/dφ, acceleration d²x/dφ².
    links : dict
        dφ_i/dφ and d²φ_i/dφ², ndarrays of shape (n,).
    """
    unit = Solution(at_unit_rate(solution.problem), positions=solution.positions.tolist())
    return unit.points, {name: (one.omega, one.epsilon) for name, one in unit.links.items()}
