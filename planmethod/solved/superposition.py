"""Velocities of a mechanism with several drivers as sums: one driver moves at a time (наложение).

Velocities are linear in the rates of the drivers. Accelerations are not: they contain products of
two rates, so that they have no such parts.
"""

from __future__ import annotations

from collections.abc import Mapping

from msgspec.structs import replace

from planmethod.solved.reading import memoized, other_place
from planmethod.solved.solution import Solution


@memoized
def parts_by_driver(solution: Solution) -> Mapping[str, Solution]:
    """Return the mechanism with one driver moving and the others at rest, by driving link.

    Without masses and loads; in the same positions, assembled in the same way.
    """
    problem, drive = solution.problem, solution.problem.drive
    positions = (*drive.positions, *solution.positions.tolist())
    others = []
    for other in drive.other_drives:
        listed = other.positions * (len(drive.positions) if len(other.positions) == 1 else 1)
        places = other_place(drive, other, solution.positions)
        if len(other.positions) == 1:
            listed = (other.positions[0], *listed[1:])
        others.append(replace(other, positions=(*listed, *places.tolist()), acceleration=0.0))
    found: dict[str, Solution] = {}
    for link in drive.links:
        moved = [other if other.link == link else replace(other, rate=0.0) for other in others]
        rate = drive.rate if drive.link == link else 0.0
        one = replace(
            drive, positions=positions, rate=rate, acceleration=0.0, other_drives=tuple(moved)
        )
        alone = Solution(replace(problem, drive=one, dynamics=None, published=(), answers=()))
        found[link] = alone.with_positions(solution.positions)
    return found
