"""Transfer functions: derivatives by the coordinate of the driver (аналоги)."""

from __future__ import annotations

from planmethod.solved.reading import Reals, memoized
from planmethod.solved.solution import PointMotion, Solution


@memoized
def analogues(solution: Solution) -> tuple[dict[str, PointMotion], dict[str, tuple[Reals, Reals]]]:
    """Return first and second transfer functions in the positions of a solution (аналоги).

    Returns
    -------
    points : dict
        Motions at one radian (or metre) a second: velocity dx/dφ, acceleration d²x/dφ².
    links : dict
        dφ_i/dφ and d²φ_i/dφ², ndarrays of shape (n,).
    """
    unit = solution.at_unit_rate()
    return unit.points, {name: (one.omega, one.epsilon) for name, one in unit.links.items()}
