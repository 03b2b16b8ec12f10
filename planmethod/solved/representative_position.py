"""The position that shows a mechanism best: drawn in full and calculated (расчётное)."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import numpy.typing as npt

from planmethod.construct.steps import PointName
from planmethod.plans.model import RATES, PlanKind
from planmethod.solved.detail_views import short_readings
from planmethod.solved.reading import Reals, memoized
from planmethod.solved.scaling import OUTLIER, median, sizes, typical
from planmethod.solved.solution import Solution

_MIN_SINE = 0.3  # sine of the least angle between joined links of the clearest one
_SMALL = 0.15  # part of its usual size that a velocity has in the clearest one at least
_JOINTS = 3.0  # mm of paper between two joints of a clear one
_MIN_VECTOR = 1.0  # mm that a vector of its plans has at least


def clear_position(solution: Solution) -> int:
    """Return the position to draw in full and calculate if the file does not specify it.

    See `clearest_position`; positions count from 0.
    """
    return clearest_position(solution, tuple(range(len(solution.positions))))


@memoized
def clearest_position(solution: Solution, indices: tuple[int, ...]) -> int:
    """Return the position that shows the mechanism best.

    No two of its joints lie within 3 mm of paper and no vector of its plans vanishes; if possible,
    no two joined links lie nearly in one line, no velocity nearly vanishes, as it does where the
    output turns back, and no plan is much larger than the others. Among several, it has the fewest
    segments too short to be read well; among those, it is the furthest from a dead position.
    """
    solution, chosen = solution.origin, list(indices)  # whatever scales a sheet tries
    clear = is_clear(solution)
    better = sum(f(solution)[chosen].astype(int) for f in (_moving, _links_angled, _usual))
    short = -short_readings(solution.construction, solution.paper)[chosen]
    ranked = zip(clear[chosen].tolist(), np.asarray(better).tolist(), short.tolist(),
                 solution.margin[chosen].tolist(), indices, strict=True)  # fmt: skip
    return max(ranked, key=lambda one: one[:4])[4]


@memoized
def is_clear(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no two joints lie together on the paper and no vector vanishes."""
    return _joints_separate(solution.origin) & _vectors_visible(solution.origin)


def _vectors(solution: Solution, kind: PlanKind) -> list[Reals]:
    """Return the sizes of the vectors of a plan that are ever something, in its unit."""
    plan = solution.construction.plan(kind)
    found = [np.abs(solution.si.vector(v.tail, v.head)) for v in plan.vectors]
    return [size for size in found if size.any()]


def _joints_separate(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions all joints that ever lie apart on the paper do so."""
    problem, paper = solution.problem, solution.paper
    names = {joint.point for joint in problem.mechanism.revolutes}
    names |= {slide.pin for slide in problem.slides.values()}
    places = [paper.point(PointName(name)) for name in sorted(names)]
    apart = np.ones(len(solution.positions), dtype=bool)
    for one, other in combinations(places, 2):
        distance = np.abs(one - other)
        if distance.max() >= _JOINTS:
            apart &= distance >= _JOINTS
    return apart


def _vectors_visible(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no vector of a plan vanishes, except those that mostly do."""
    seen = np.ones(len(solution.positions), dtype=bool)
    for kind in RATES:
        per_mm = solution.scales[kind].per_mm
        for size in _vectors(solution, kind):
            seen &= size >= min(_MIN_VECTOR * per_mm, _SMALL * median(size))
    return seen


def _moving(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no velocity is much smaller than it usually is."""
    found = [
        size >= _SMALL * median(size[size > 0]) for size in _vectors(solution, PlanKind.VELOCITY)
    ]
    return np.all(found, axis=0) if found else np.ones(len(solution.positions), dtype=bool)


def _links_angled(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no two joined links lie nearly in one line."""
    apart = np.ones(len(solution.positions), dtype=bool)
    axes = {
        link: np.exp(1j * np.radians(motion.phi_deg))
        for link, motion in solution.links.items()
        if len(solution.problem.bodies[link].points) > 1
    }
    for joint in solution.problem.mechanism.revolutes:
        for one, two in combinations([link for link in joint.links if link in axes], 2):
            apart &= np.abs((axes[one] * np.conj(axes[two])).imag) > _MIN_SINE
    return apart


def _usual(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no plan is much larger than the others."""
    usual = np.ones(len(solution.positions), dtype=bool)
    for kind in RATES:
        size = np.maximum(*sizes(solution.construction, solution.si, kind))
        usual &= size <= OUTLIER / 2 * typical(size)
    return usual
