"""Ellipses of the drafting error around the points of a view (эллипсы погрешности)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import atan2, cos, hypot, sin, sqrt, tau
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.render.ink.drawing import Fill, Item, Pen, Stroke
from planmethod.render.ink.style import PENS
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.reading import Reals, memoized
from planmethod.solved.scaling import extent, plan_extent
from planmethod.solved.solution import Solution

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.solved.errors.spread import Errors

SIGMAS = 2
"""Half axes of an ellipse, in sigmas: it contains 86 % of drawings."""

ENLARGED = (5, 2, 1)
"""Enlargements of the ellipses of a scheme, to be visible beside the signs of its joints."""

READABLE = 0.5
"""Largest width of an ellipse as a part of its view: a larger one only hides the plan."""

CLUTTER = 0.25
"""Largest width of an enlarged ellipse as a part of its scheme."""

TAG = "ellipse"

_CORNERS = 64


class Ellipses(Struct, frozen=True):
    """Ellipses of one view, and the facts for its inscription.

    ``has_nonlinear`` means that some are dashed, ``has_oversized`` that some are larger than half
    of the view, ``undefined`` that linear error propagation gives no ellipse somewhere;
    ``enlarged`` is the enlargement of the ellipses relative to the view.
    """

    strokes: tuple[Stroke, ...] = ()
    enlarged: int = 1
    has_nonlinear: bool = False
    has_oversized: bool = False
    undefined: bool = False

    @property
    def grounds(self) -> list[Item]:
        """The insides of the ellipses, which letters should avoid."""
        return [Fill(stroke.points, tag=TAG) for stroke in self.strokes]


def half_axes(covariance: Reals) -> tuple[float, float, float]:
    """Return the half axes of the ellipse of one sigma and the direction of the longer one.

    Parameters
    ----------
    covariance : ndarray of shape (2, 2)
        Covariance of x and y, mm².

    Returns
    -------
    a, b : float, mm
        The longer one first; not finite where the covariance is not.
    turn : float, radians
    """
    xx, yy, xy = float(covariance[0, 0]), float(covariance[1, 1]), float(covariance[0, 1])
    mean, half = (xx + yy) / 2, (xx - yy) / 2
    spread = hypot(half, xy)
    return sqrt(mean + spread), sqrt(max(mean - spread, 0.0)), atan2(xy, half) / 2


def ellipse(centre: complex, covariance: Reals, pen: Pen = Pen.THIN) -> Stroke:
    """Return the ellipse of `SIGMAS` sigmas around a point, mm."""
    a, b, turn = half_axes(covariance)
    way = complex(cos(turn), sin(turn)) * SIGMAS
    steps = (tau * k / _CORNERS for k in range(_CORNERS))
    points = tuple(centre + way * complex(a * cos(t), b * sin(t)) for t in steps)
    return Stroke(points, pen, closed=True, tag=TAG)


@memoized
def error_ellipses(solution: Solution, kind: PlanKind, index: int) -> Ellipses:
    """Return the ellipses of a view's moving points in one position."""
    scheme, per_mm = kind is PlanKind.POSITION, solution.plan_scale(kind, index).per_mm
    construction, si = solution.construction, solution.si
    size = extent(construction, si, kind) if scheme else plan_extent(construction, si, kind, index)
    return shown_ellipses(
        drafting_of(solution),
        index,
        dict(_places(solution, kind, index)),
        max(size) / per_mm,
        enlarged=ENLARGED if scheme else (1,),
    )


def shown_ellipses(
    errors: Errors,
    index: int,
    places: Mapping[PointName, complex],
    size: float,
    *,
    magnification: float = 1.0,
    enlarged: Sequence[int] = (1,),
) -> Ellipses:
    """Return the ellipses around some points of a view in one position.

    Ellipses thinner than the pen, or larger than half of the view, are not drawn: in the latter
    case the drawing barely locates the point. Ellipses are dashed where linear error propagation is
    not valid.

    Parameters
    ----------
    errors : Errors
    index : int
        Number of the position.
    places : mapping of PointName to complex
        Places of the points on the drawing, mm.
    size : float, mm
        Size of the view.
    magnification : float
        Enlargement of the view relative to the drawing that ``errors`` belong to.
    enlarged : sequence of int
        Enlargements to choose from, the largest first; the last is 1.
    """
    found = {point: errors.ellipse(point, index) * magnification**2 for point in places}
    known = {point: each for point, each in found.items() if np.isfinite(each).all()}
    across = {point: 2 * SIGMAS * half_axes(each)[0] for point, each in known.items()}
    shown = [point for point in known if across[point] <= READABLE * size]
    widest = max((across[point] for point in shown), default=0.0)
    times = next(k for k in enlarged if k == 1 or k * widest <= CLUTTER * size)
    strokes: list[Stroke] = []
    for point in shown:
        if across[point] * times > PENS[Pen.THIN].width:
            pen = Pen.HIDDEN if errors.flag_unreliable(point)[index] else Pen.THIN
            stroke = ellipse(places[point], known[point] * times**2, pen)
            if not any(_coincide(stroke, other) for other in strokes):
                strokes.append(stroke)
    return Ellipses(
        tuple(strokes),
        times,
        has_nonlinear=any(stroke.pen is Pen.HIDDEN for stroke in strokes),
        has_oversized=len(shown) < len(known),
        undefined=len(known) < len(found),
    )


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
        yield point, complex(solution.paper.point(point)[index])


def _coincide(one: Stroke, two: Stroke) -> bool:
    """Return whether two ellipses would coincide on the drawing."""
    return all(abs(p - q) < 0.02 for p, q in zip(one.points, two.points, strict=True))


def ellipse_inscription(
    solution: Solution, kind: PlanKind, position_indices: Sequence[int], language: Language
) -> list[str]:
    """Return the lines that explain the ellipses of a view."""
    shown = [error_ellipses(solution, kind, i) for i in position_indices]
    return describe_ellipses(shown, solution.profile, language)


def describe_ellipses(shown: Sequence[Ellipses], profile: Profile, language: Language) -> list[str]:
    """Return the lines that explain some ellipses for a drafting profile."""
    texts = language.sheets
    hand = language.note["profiles"].get(profile.name, profile.name)
    if not any(view.strokes or view.has_oversized or view.undefined for view in shown):
        return [texts.ellipses_thin.format(sigmas=SIGMAS, profile=hand)]
    enlarged = max(view.enlarged for view in shown)
    head = texts.ellipses_enlarged if enlarged > 1 else texts.ellipses
    lines = [head.format(sigmas=SIGMAS, times=enlarged, profile=hand)]
    if any(view.has_nonlinear for view in shown):
        lines.append(texts.ellipses_strained)
    if any(view.has_oversized for view in shown):
        lines.append(texts.ellipses_large)
    if any(view.undefined for view in shown):
        lines.append(texts.ellipses_undefined)
    return lines
