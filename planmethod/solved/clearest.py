"""Which of several positions shows a mechanism best."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from planmethod.plans.model import PlanKind
from planmethod.solved.enlarging import short_readings
from planmethod.solved.reading import remembered
from planmethod.solved.scaling import median
from planmethod.solved.solution import Solution

_APART = 0.3  # sine of the least angle between joined links of the clearest one
_SMALL = 0.15  # part of its usual size that a velocity has in the clearest one at least


@remembered
def clearest_position(solution: Solution, indices: tuple[int, ...]) -> int:
    """Return the position that shows the mechanism best.

    Of those in which no two joined links stand nearly in one line, and no vector of the velocity
    plan nearly vanishes, as it does where the output turns back, one in which the fewest segments
    are too short to be read well; of such the furthest from a dead position.
    """
    chosen = list(indices)
    plan = solution.construction.plan(PlanKind.VELOCITY)
    sizes = np.abs([solution.si.vector(v.tail, v.head)[chosen] for v in plan.vectors])
    usual = [median(size[size > 0.0]) if size.any() else 0.0 for size in sizes]
    moving = np.all(sizes >= _SMALL * np.asarray(usual)[:, None], axis=0)
    apart = np.ones(len(chosen), dtype=bool)
    axes = {
        link: np.exp(1j * np.radians(motion.phi_deg[chosen]))
        for link, motion in solution.links.items()
        if len(solution.problem.bodies[link].points) > 1
    }
    for joint in solution.problem.mechanism.revolutes:
        for one, two in combinations([link for link in joint.links if link in axes], 2):
            apart &= np.abs((axes[one] * np.conj(axes[two])).imag) > _APART
    good = (moving.astype(int) + apart).tolist()
    short = (-short_readings(solution.construction, solution.paper)[chosen]).tolist()
    margins = solution.margin[chosen].tolist()
    return max(zip(good, short, margins, indices, strict=True), key=lambda one: one[:3])[3]
