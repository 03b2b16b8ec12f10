"""Accuracy with which a drawing gives the values of a page (погрешность построения)."""

# no messages: numbers of a page

from __future__ import annotations

from typing import Any

import numpy as np

from planmethod.plans.model import RATES, PlanKind
from planmethod.render.live.scene import LiveScene
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.solution import Solution

TOLERANCE_SIGMAS = 2.5
"""Ratio of the tolerance of an answer to one standard deviation, as in the check of works."""

TOLERANCE_SHARE = 0.005
"""Least tolerance as a share of the value, as in the check of works."""

COUNT = 24
"""Number of positions in which the deviations are known; between them they are interpolated."""


def tolerances(scene: LiveScene) -> dict[str, Any]:
    """Return standard deviations of the drawn quantities over the range of the driver.

    Returns
    -------
    dict
        ``at`` has positions, ``sigma`` the deviations by the number of a quantity, None where
        there is none; ``times`` and ``share`` make a tolerance of them.
    """
    chosen = scene.able[:: max(1, len(scene.able) // COUNT)]
    if not chosen.size:
        return {"at": [], "sigma": {}, "times": TOLERANCE_SIGMAS, "share": TOLERANCE_SHARE}
    scales = {kind: scene.scales[kind] for kind in (PlanKind.POSITION, *RATES)}
    spreads = drafting_of(Solution(scene.problem, positions=chosen.tolist(), scales=scales)).spreads
    sigma = {
        number: [float(f"{one:.3g}") if np.isfinite(one) else None for one in spreads[label].sigma]
        for number, label in enumerate(one.label for one in scene.quantities)
        if label in spreads and spreads[label].sigma.any()
    }
    return {"at": [round(float(x), 9) for x in chosen], "sigma": sigma, "times": TOLERANCE_SIGMAS,
            "share": TOLERANCE_SHARE}  # fmt: skip
