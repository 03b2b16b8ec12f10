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
    own_positions = tuple(solution.positions.tolist())
    positions, listed_count = (*drive.positions, *own_positions), len(drive.positions)
    others, places = [], list[tuple[float, ...]]()
    for other in drive.other_drives:
        known = other.positions * (listed_count if len(other.positions) == 1 else 1)
        own = tuple(other_place(drive, other, solution.positions).tolist())
        places.append(own)
        others.append(replace(other, positions=(*known, *own), acceleration=0.0))
    found: dict[str, Solution] = {}
    for link in drive.links:
        moved = [other if other.link == link else replace(other, rate=0.0) for other in others]
        rate = drive.rate if drive.link == link else 0.0
        one = replace(
            drive, positions=positions, rate=rate, acceleration=0.0, other_drives=tuple(moved)
        )
        still = replace(problem, dynamics=None, published=(), answers=())
        alone = Solution(replace(still, drive=one))
        # Positions of the same first driver may differ by another: they are entries of lists.
        here = [replace(other, positions=own) for other, own in zip(moved, places, strict=True)]
        listed = replace(one, positions=own_positions, other_drives=tuple(here))
        found[link] = Solution(replace(still, drive=listed), construction=alone.construction)
    return found
