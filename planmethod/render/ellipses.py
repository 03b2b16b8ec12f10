"""Ellipses of the drafting error around the points of a view (эллипсы погрешности)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import atan2, cos, sin, sqrt, tau

import numpy as np

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.wording import wording
from planmethod.plans.model import PlanKind
from planmethod.plans.scaling import extent, own_scale, plan_extent
from planmethod.plans.solution import Reals, Solution
from planmethod.render.drawing import Fill, Item, Pen, Stroke
from planmethod.render.style import PENS

SIGMAS = 2
"""Half axes of an ellipse, in sigmas: it holds 86 % of what is drawn."""

TAG = "ellipse"

_CORNERS = 64


@dataclass(frozen=True, slots=True)
class Ellipses:
    """Ellipses of one view, and what the view has to say about them.

    ``strained`` tells that some are dashed, ``too_large`` that some are larger than the view,
    ``undefined`` that first order gives no ellipse somewhere.
    """

    strokes: tuple[Stroke, ...] = ()
    strained: bool = False
    too_large: bool = False
    undefined: bool = False

    @property
    def grounds(self) -> list[Item]:
        """The insides of the ellipses, where no letter shall stand."""
        return [Fill(stroke.points, tag=TAG) for stroke in self.strokes]


def half_axes(covariance: Reals) -> tuple[float, float, float]:
    """Return the half axes of the ellipse of one sigma and the direction of the longer one.

    Parameters
    ----------
    covariance : ndarray of shape (2, 2)
        Of x and y, mm².

    Returns
    -------
    a, b : float, mm
        The longer one first; not finite where the covariance is not.
    turn : float, radians
    """
    xx, yy, xy = float(covariance[0, 0]), float(covariance[1, 1]), float(covariance[0, 1])
    mean, half = (xx + yy) / 2, (xx - yy) / 2
    spread = sqrt(half**2 + xy**2)
    return sqrt(mean + spread), sqrt(max(mean - spread, 0.0)), atan2(xy, half) / 2


def ellipse(centre: complex, covariance: Reals, pen: Pen = Pen.THIN) -> Stroke:
    """Return the ellipse of `SIGMAS` sigmas around a point, mm."""
    a, b, turn = half_axes(covariance)
    way = complex(cos(turn), sin(turn)) * SIGMAS
    steps = (tau * k / _CORNERS for k in range(_CORNERS))
    points = tuple(centre + way * complex(a * cos(t), b * sin(t)) for t in steps)
    return Stroke(points, pen, closed=True, tag=TAG)


@lru_cache(maxsize=512)
def error_ellipses(solution: Solution, kind: PlanKind, index: int) -> Ellipses:
    """Return the ellipses of a view's moving points in one position.

    What is thinner than the pen is not drawn, nor what is larger than the view itself: there the
    drawing does not say where the point is. Dashed are points whose every reading had to be found
    by random draws.
    """
    # A plan near a dead position is drawn smaller, and its ellipses with it.
    if kind is PlanKind.POSITION:
        share, size = 1.0, extent(solution, kind)
        per_mm = solution.scales[kind].per_mm
    else:
        per_mm = own_scale(solution, kind, index).per_mm
        share, size = solution.scales[kind].per_mm / per_mm, plan_extent(solution, kind, index)
    largest = max(size) / per_mm
    strokes: list[Stroke] = []
    too_large = undefined = False
    for point, place in _places(solution, kind, index):
        covariance = solution.drafting.ellipse(point, index) * share**2
        if not np.isfinite(covariance).all():
            undefined = True
            continue
        across = 2 * SIGMAS * half_axes(covariance)[0]
        too_large = too_large or across > largest
        if not PENS[Pen.THIN].width < across <= largest:
            continue
        pen = Pen.THIN if _holds(solution, point, index) else Pen.HIDDEN
        stroke = ellipse(place * share, covariance, pen)
        if not any(_alike(stroke, other) for other in strokes):
            strokes.append(stroke)
    strained = any(stroke.pen is Pen.HIDDEN for stroke in strokes)
    return Ellipses(tuple(strokes), strained, too_large, undefined)


def _places(solution: Solution, kind: PlanKind, index: int) -> Iterator[tuple[PointName, complex]]:
    """Yield the letter points of a plan, or the moving points of the mechanism, in order, mm."""
    if kind is PlanKind.POSITION:
        bodies = solution.problem.bodies
        fixed = bodies[FRAME].points
        names = {p for body in bodies.values() for p in body.points if p not in fixed}
        points = [PointName(name) for name in sorted(names)]
    else:
        plan = solution.construction.plan(kind)
        points = sorted(point for point in plan.letters if point != plan.pole)
    for point in points:
        yield point, complex(solution.complexes(solution.paper, point)[index])


def _holds(solution: Solution, point: PointName, index: int) -> bool:
    """Tell whether first order holds at a point: something taken from it is believed.

    A segment may be found by random draws only because it is short; its end is then known no worse
    for it, as another segment from there tells.
    """
    drafting = solution.drafting
    drawn = [
        bool(drafting.spreads[label].drawn[index])
        for label, item in drafting.items.items()
        if point in item.needs
    ]
    return not drawn or not all(drawn)


def _alike(one: Stroke, two: Stroke) -> bool:
    """Tell whether two ellipses would be drawn over each other."""
    return all(abs(p - q) < 0.02 for p, q in zip(one.points, two.points, strict=True))


def ellipse_inscription(solution: Solution, kind: PlanKind, indices: Sequence[int]) -> list[str]:
    """Return the lines that tell what the ellipses of a view are."""
    shown = [error_ellipses(solution, kind, i) for i in indices]
    words = wording("ru")
    name = solution.profile.name
    profile = words.profiles.get(name, name)
    if not any(view.strokes or view.too_large or view.undefined for view in shown):
        return [f"эллипсы погрешности {SIGMAS}σ тоньше линий ({profile})"]
    lines = [f"эллипсы погрешности: {SIGMAS}σ, {profile}"]
    if any(view.strained for view in shown):
        lines.append("штриховые: первый порядок не верен")
    large, undefined = any(v.too_large for v in shown), any(v.undefined for v in shown)
    if large or undefined:
        which = (["больше плана"] if large else []) + (["неопределённые"] if undefined else [])
        lines.append(f"эллипсы {' и '.join(which)} не показаны")
    return lines
