"""Velocity and acceleration plans as drawn: pole, vectors, letters, traces, error ellipses."""

from __future__ import annotations

from cmath import phase
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from math import atan2, cos, hypot, isfinite, pi, sin, sqrt, tau
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct import steps
from planmethod.construct.steps import LineName, PointName, Similar, Step
from planmethod.mechanism.model import FRAME
from planmethod.note.document import plain_text
from planmethod.note.narrate.naming import direction_text, plan_letters
from planmethod.note.wording import Language
from planmethod.plans.model import FACTS, Plan, PlanKind, Relation, Vector
from planmethod.render.ink.drawing import Arc, Disc, Fill, Ink, Item, Pen, Stroke, Text
from planmethod.render.ink.pens import drawn_once, pens_in_use
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import NAMING, NAMING_OF_MANY, NEAREST, Label
from planmethod.render.labels.label_column import label_merged_letters, merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.collinear import drawn_vectors
from planmethod.render.pictures.lettered import (
    ENLARGED,
    clip_to_circle,
    detail_mark,
    detail_picture,
    lettered,
    placed_in,
    points_within,
    radius_of,
    vector_pen,
)
from planmethod.render.symbols import unit, vector_arrow
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.extents import extent, plan_extent
from planmethod.solved.legibility import FEW, DetailView
from planmethod.solved.reading import Reals, memoized
from planmethod.solved.solution import Solution

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.solved.errors.spread import Errors


SIGMAS = 2
"""Half axes of an ellipse, in sigmas: it contains 86 % of drawings."""

ELLIPSE_ENLARGEMENTS = (5, 2, 1)
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
        enlarged=ELLIPSE_ENLARGEMENTS if scheme else (1,),
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
        if across[point] * times > pens_in_use().width(Pen.THIN):
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


Shown: TypeAlias = bool | tuple[str, ...]
"""All traces, none, or those of the steps that make the points with these letters."""


class PictureStyle(Struct, frozen=True):
    """Style of the picture of a scheme or plan.

    ``letter_height``, mm, is that of the letters of the points. ``errors`` draws the ellipses of
    the drafting error around the points; ``traces`` are those of the construction; ``hatched``
    hatches the triangles of the similarity theorem; ``named`` names the vectors where there is
    space.
    """

    letter_height: float = 5.0
    errors: bool = False
    traces: Shown = False
    hatched: bool = False
    named: bool = True


USUAL_STYLE = PictureStyle()
"""Style of a picture alone."""

TRACE = "trace"
"""Tag of a trace."""

NOTCH, EXTENSION, CORNER = 8.0, 5.0, 2.5
"""Half a notch of the scheme, the extension of a line beyond an intersection, and the sides of a
right angle, mm."""

_NAMES = 2.5  # height of the name of a direction, mm
_LEGS = 1.6  # least length of the legs of a right angle, in sides of its sign
_ZERO_LENGTH = 0.5  # mm: a shorter vector gives its line no direction on the paper
_RIGHT = 1e-6  # cosine of the angle between lines that were drawn as a right one


def shown_traces(solution: Solution, requested: Shown | None, *, has_space: bool) -> Shown:
    """Return the shown traces: those of the layout, else of the file.

    By default the traces of a single position are shown if the sheet has ``has_space`` for them.
    """
    said = solution.problem.sheet.traces if requested is None else requested
    return has_space and len(solution.positions) == 1 if said is None else said


def scheme_traces(solution: Solution, index: int, factor: float, shown: Shown) -> list[Item]:
    """Return the notches of the construction of the scheme's points, mm, reduced by ``factor``."""
    items: list[Item] = []
    for step in _steps(solution, PlanKind.POSITION) if shown else ():
        if _is_shown(shown, [step.out]):
            for needle in _needles(step, solution):
                way = complex(solution.paper.vector(needle, PointName(step.out))[index])
                at = complex(solution.paper.point(step.out)[index])
                items.append(_notch(at - way, at, NOTCH * factor))
    return items


def plan_traces(
    solution: Solution, kind: PlanKind, index: int, at: Mapping[PointName, complex], shown: Shown
) -> tuple[list[Item], list[Label]]:
    """Return the traces on a plan whose points lie at ``at``, mm, and the names of directions."""
    plan = solution.construction.plan(kind)
    letters = plan_letters(solution.problem, plan)
    items: list[Item] = []
    labels: list[Label] = []
    for step in _steps(solution, kind) if shown else ():
        own = [plain_text(letter) for letter in letters.get(PointName(str(step.out)), ())]
        if not own or not _is_shown(shown, own):
            continue
        if isinstance(step, steps.Similar):
            items += _corner_of_triangle(step, at)
        elif isinstance(step, steps.IntersectLines):
            for line in (step.first, step.second):
                ray = _Ray.of(solution, plan, index, line, step.out)
                if ray is not None and {ray.start, ray.head} <= set(at):
                    items += [*ray.extend(at), *ray.right_angle(at)]
                    labels += ray.names(at)
    return items, labels


def _is_shown(shown: Shown, letters: Iterable[str]) -> bool:
    return shown if isinstance(shown, bool) else not set(shown).isdisjoint(letters)


def _steps(solution: Solution, kind: PlanKind) -> Iterator[Step]:
    for section in solution.construction.sections:
        if section.kind is kind:
            yield from section.steps


def _needles(step: Step, solution: Solution) -> tuple[PointName, ...]:
    """Return the centres of the compass for a point of the scheme."""
    construction = solution.construction
    match step:
        case steps.LayOffLength(out=out, origin=origin, line=line) if (
            out in construction.draft.marked
        ):
            drawn = construction.step(line)
            return (origin,) if isinstance(drawn, steps.AtAngle) and drawn.to is not None else ()
        case steps.IntersectCircles(centre1=one, centre2=two):
            return one, two
        case steps.IntersectLineCircle(centre=centre):
            return (centre,)
        case _:
            return ()


def _notch(centre: complex, at: complex, half: float) -> Arc:
    radius, turn = abs(at - centre), phase(at - centre)
    by = min(half / radius, pi / 6)
    return Arc(centre, radius, turn - by, turn + by, Pen.THIN, TRACE)


def _corner_of_triangle(step: steps.Similar, at: Mapping[PointName, complex]) -> list[Item]:
    """Return the notches of the construction of a triangle's corner from the two others."""
    b, c, corner = (at.get(point) for point in (step.plan_b, step.plan_c, step.out))
    if b is None or c is None or corner is None:
        return []
    off = abs(((corner - b) * (c - b).conjugate()).imag)
    if off <= _ZERO_LENGTH * abs(c - b):
        return []  # on the line of the two, laid off by one length
    return [_notch(end, corner, NOTCH / 2) for end in (b, c)]


class _Ray(Struct, frozen=True):
    """Direction of an unknown vector, and the vector that was laid off before it.

    ``direction`` is the direction of its line, a unit vector; ``before`` the tail of the previous
    vector, if the line is perpendicular to it.
    """

    start: PointName
    head: PointName
    direction: complex
    vector: Vector | None
    before: PointName | None

    @classmethod
    def of(
        cls, solution: Solution, plan: Plan, index: int, line: LineName, head: PointName
    ) -> _Ray | None:
        """Return the ray of an intersected line, or None for a line that was there before."""
        step = solution.construction.step(line)
        if not isinstance(step, steps.Parallel | steps.Perpendicular):
            return None
        along = unit(complex(solution.paper.line_vector(line)[index]))
        ends = {(vector.tail, vector.head): vector for vector in plan.vectors}
        before = next((tail for tail, end in ends if end == step.through), None)
        if before is not None:
            way = complex(solution.paper.vector(before, step.through)[index])
            if abs((way * along.conjugate()).real) > _RIGHT * abs(way):
                before = None
        return cls(step.through, head, along, ends.get((step.through, head)), before)

    def _ends(self, at: Mapping[PointName, complex]) -> tuple[complex, complex]:
        """Return the start of its vector and its direction, a unit vector."""
        start, way = at[self.start], at[self.head] - at[self.start]
        return start, unit(way) if abs(way) > _ZERO_LENGTH else self.direction

    def extend(self, at: Mapping[PointName, complex]) -> list[Item]:
        """Return the line beyond the intersection; to both sides of it without a vector."""
        start, way = self._ends(at)
        head = at[self.head]
        short = abs(head - start) <= _ZERO_LENGTH
        return [
            Stroke((head - way * EXTENSION * short, head + way * EXTENSION), Pen.THIN, tag=TRACE)
        ]

    def right_angle(self, at: Mapping[PointName, complex]) -> list[Item]:
        """Return the sign of the right angle with the previous vector."""
        if self.before is None or self.before not in at:
            return []
        start, way = self._ends(at)
        back = at[self.before] - start
        if min(abs(back), abs(at[self.head] - start)) < _LEGS * CORNER:
            return []
        one, two = unit(back) * CORNER, way * CORNER
        corner = (start + one, start + one + two, start + two)
        return [Stroke(corner, Pen.THIN, tag=TRACE)]

    def names(self, at: Mapping[PointName, complex]) -> list[Label]:
        """Return the label of the line's direction at its end: ``⊥ CB``."""
        told = None if self.vector is None else self.vector.direction
        if told is None or told.relation not in (Relation.PERPENDICULAR, Relation.PARALLEL):
            return []
        end = at[self.head] + self._ends(at)[1] * EXTENSION
        way = self._ends(at)[1]
        return [Label(typeset(direction_text(told), _NAMES), end, prefer=way, gap=0.8)]


POLE = "pole"
"""Tag of the disc at a plan's pole: one for each plan that is drawn."""

NAMES, SMALL_NAMES = 3.5, 2.5
"""Height of the names of vectors, and on plans of several positions, mm."""

LARGE_PLAN = 80.0
"""Larger side of a plan of few positions from which its vectors have the names of one, mm."""

NAMED, SMALL_NAMED = 5.0, 8.0
"""Length from which a vector has a name, and on a plan of several positions, mm: shorter ones are
identified by the letters of their ends."""


def similar_lines(solution: Solution, plan: Plan) -> list[tuple[PointName, PointName]]:
    """Return the sides of the figures similar to links that are not vectors of the plan."""
    drawn = {frozenset((v.tail, v.head)) for v in plan.vectors}
    pole = str(plan.pole)
    lines: dict[frozenset[PointName], tuple[PointName, PointName]] = {}
    for step in solution.construction.program.steps:
        if not isinstance(step, Similar) or step.out[:2] != pole[:2]:
            continue
        for side in ((step.plan_b, step.plan_c), (step.plan_b, step.out), (step.plan_c, step.out)):
            if frozenset(side) not in drawn:
                lines.setdefault(frozenset(side), side)
    return list(lines.values())


SIMILAR = "similar"
"""Tag of the sides of triangles of the similarity theorem."""

Triangle: TypeAlias = tuple[complex, complex, complex]


def similar_triangles(
    solution: Solution, kind: PlanKind, index: int, *, use_ruler: bool = False
) -> list[Triangle]:
    """Return the triangles of a plan that are similar to links, mm, or of the links on the scheme.

    Points on one line have none, and neither has a triangle that is too narrow to be hatched.
    """
    of_links = kind is PlanKind.POSITION
    prefix = FACTS[PlanKind.VELOCITY if of_links else kind].prefix
    at = {} if of_links else plan_places(solution, kind, index, use_ruler=use_ruler)
    found = []
    for step in solution.construction.program.steps:
        if not isinstance(step, Similar) or not step.out.startswith(prefix):
            continue
        names = (step.plan_b, step.plan_c, step.out)
        if of_links:
            names = (step.link_b, step.link_c, step.link_s)
            at = {name: complex(solution.paper.point(name)[index]) for name in names}
        b, c, corner = (at[name] for name in names)
        area = abs(((corner - b) * (c - b).conjugate()).imag)
        if area >= _NARROW * max(abs(c - b), abs(corner - b)) > 0.0:  # 0 of a link that translates
            found.append((b, c, corner))
    return found


_NARROW = 3.0
"""Least height of a hatched triangle, mm."""


def plan_places(
    solution: Solution, kind: PlanKind, index: int, *, use_ruler: bool = False
) -> dict[PointName, complex]:
    """Return the places of the points of a plan in one position, mm from its pole.

    ``use_ruler`` selects the plan drawn with the ruler, whose segments are those of the
    calculation; if one of its points cannot be drawn so, the exact plan.
    """
    plan = solution.construction.plan(kind)
    assert plan.pole is not None
    ends = {e for v in plan.vectors for e in (v.tail, v.head)} | set(plan.letters) | {plan.pole}
    for reading in (solution.ruler_reading, solution.paper) if use_ruler else (solution.paper,):
        at = {name: complex(reading.point(name)[index]) for name in ends}
        if all(isfinite(abs(place)) for place in at.values()):
            break
    return at


def detail_views_in(
    solution: Solution, kind: PlanKind, index: int, at: Mapping[PointName, complex]
) -> tuple[DetailView, ...]:
    """Return the enlarged views of a plan in one position, about where its points are drawn."""
    return tuple(view.centred(at) for view in solution.detail_views_at(kind, index))


@memoized
def has_vectors_apart(
    solution: Solution, kind: PlanKind, index: int, *, use_ruler: bool = False
) -> bool:
    """Return whether a plan or its enlarged views have vectors beside others on their line."""
    plan = solution.construction.plan(kind)
    at = plan_places(solution, kind, index, use_ruler=use_ruler)
    views = [placed_in(knot, at) for knot in detail_views_in(solution, kind, index, at)]
    return any(
        ends[0] != places[vector.tail]
        for places in (at, *views)
        for vector, ends in drawn_vectors(plan, places)
    )


@drawn_once
def plan_picture(
    solution: Solution,
    kind: PlanKind,
    index: int,
    style: PictureStyle = USUAL_STYLE,
    *,
    use_ruler: bool = False,
    detail_letters: tuple[str, ...] = (),
) -> Picture:
    """Return a plan in one position as a picture, its own pole at the origin, mm.

    ``use_ruler`` is explained by `plan_places`. ``detail_letters`` are the letters of the enlarged
    views beside it, in their order. Cached, since a sheet is tried with fewer positions when it
    does not fit with more.
    """
    plan = solution.construction.plan(kind)
    assert plan.pole is not None
    at = plan_places(solution, kind, index, use_ruler=use_ruler)
    letter_height = style.letter_height
    ellipses = error_ellipses(solution, kind, index) if style.errors else Ellipses()
    left, directions = plan_traces(solution, kind, index, at, style.traces)
    items: list[Item] = [*ellipses.strokes, *left]
    for tail, head in similar_lines(solution, plan):
        if abs(at[head] - at[tail]) > 0.05:
            items.append(Stroke((at[tail], at[head]), Pen.THIN, tag=SIMILAR))
    drawn = drawn_vectors(plan, at)
    fine = len(solution.positions) > FEW
    for vector, ends in drawn:
        pen = vector_pen(vector, kind, fine=fine)
        items += vector_arrow(*ends, pen=pen, tag=vector.kind.value)
    radius = 0.9 * min(1.0, letter_height / 5.0 + 0.2)
    items.append(Disc(at[plan.pole], radius, Ink.BLACK, tag=POLE))
    enlarged = detail_views_in(solution, kind, index, at) if detail_letters else ()
    beside = enlarged if index in solution.small_plans[kind] else ()
    inside = {
        name for view in beside for name in points_within(view, at)
    }  # have their letters there
    whole = inside >= set(at)
    prefix = f"{kind.value} {index}"
    lettered_here = {name: at[name] for name in at if name == plan.pole or name not in inside}
    labels = [] if whole else _labels(solution, plan, lettered_here, letter_height, prefix)
    for detail_view, letter in zip(enlarged, detail_letters, strict=False):
        circle, label = detail_mark(detail_view, at, letter, letter_height)
        items.append(circle)
        labels.append(label)
    outer = [v for v in plan.vectors if style.named and not {v.tail, v.head} <= inside]
    names = vector_names(solution, plan, at, letter_height, prefix, outer)
    return lettered(
        items,
        [*labels, *names],
        clear=ellipses.grounds,
        welcome=directions,
        segments=[ends for _, ends in drawn],
    )


# A short leader line: plans of several positions are beside one another.
_NAMING_OF_FEW = replace(NAMING, far_rings=(3.0, 4.5, 6.0, 8.0, 10.0))


def vector_names(
    solution: Solution,
    plan: Plan,
    at: Mapping[PointName, complex],
    letter_height: float,
    prefix: str,
    vectors: Collection[Vector],
) -> list[Label]:
    """Return the names of vectors of a plan, the shortest first: they have the fewest places.

    Parameters
    ----------
    at : mapping
        Places of the points of the plan, mm.
    letter_height : float, mm
        Height of the letters of the points.
    vectors : collection of Vector
    """
    few = len(solution.positions) <= FEW  # whose plans have every name, on a leader if need be
    places = np.array([*at.values()])
    side = max(np.ptp(places.real), np.ptp(places.imag))
    large = letter_height > NAMES or (few and side >= LARGE_PLAN)
    height, named = NAMES if large else SMALL_NAMES, NAMED if large or few else SMALL_NAMED
    drawn = [(abs(ends[1] - ends[0]), vector, ends) for vector, ends in drawn_vectors(plan, at)]
    return [
        Label(
            typeset(f"\\bar{{{vector.symbol[0]}}}{vector.symbol[1:]}", height),
            sum(ends) / 2,
            ends,
            gap=1.2 if large else 1.05,
            name=vector_label(prefix, vector),
            priority=-1,
            style=NAMING if large else _NAMING_OF_FEW if few else NAMING_OF_MANY,
            optional=True,
        )
        for size, vector, ends in sorted(drawn, key=lambda one: one[0])
        if size >= named and vector in vectors
    ]


SHORTEST_NAMED = 3.0
"""A vector of a plan of several positions that is shorter needs no name, mm."""


@memoized
def names_all_vectors(solution: Solution, kind: PlanKind, style: PictureStyle) -> bool:
    """Return whether all vectors of the plans of many positions have names; True of few.

    Plans that are shown enlarged beside themselves have them there.
    """
    plan, by_hand = solution.construction.plan(kind), not style.errors
    count = len(solution.positions)
    for index in range(count if count > FEW else 0):
        if index in solution.small_plans[kind]:
            continue
        at = plan_places(solution, kind, index, use_ruler=by_hand)
        picture = plan_picture(solution, kind, index, style, use_ruler=by_hand, detail_letters=())
        written = {item.label for item in picture.items if isinstance(item, Text)}
        for vector in plan.vectors:
            label = vector_label(f"{kind.value} {index}", vector)
            if abs(at[vector.head] - at[vector.tail]) >= SHORTEST_NAMED and label not in written:
                return False
    return True


def vector_label(prefix: str, vector: Vector) -> str:
    """Return the name of the inscription that names a vector: ``velocity 0: v_{B}``."""
    return f"{prefix}: {vector.symbol}"


# A leader line may run through the circle of the view.
_IN_VIEW = replace(NAMING, thin_line_cost=7.0)
_THROUGH_VIEW = replace(NAMING_OF_MANY, thin_line_cost=7.0)


def detail_pictures(
    solution: Solution,
    kind: PlanKind,
    index: int,
    *,
    letter_height: float,
    use_ruler: bool,
    whole: Picture | None = None,
) -> list[Picture]:
    """Return the enlarged views of the knots of a position's plan.

    They name the vectors that the picture of the ``whole`` plan does not.
    """
    plan = solution.construction.plan(kind)
    at = plan_places(solution, kind, index, use_ruler=use_ruler)
    letters = plan_letters(solution.problem, plan)
    written = {item.label for item in whole.items if isinstance(item, Text)} if whole else set()
    here = f"{kind.value} {index}"
    unnamed = [v for v in plan.vectors if vector_label(here, v) not in written]
    pictures = []
    for detail_view in detail_views_in(solution, kind, index, at):
        places = placed_in(detail_view, at)
        own, radius = f"{ENLARGED} {detail_view.number}", radius_of(detail_view, at)
        names = [
            replace(
                name,
                style=_IN_VIEW if np.allclose(seen, name.segment) else _THROUGH_VIEW,
                segment=seen,
                anchor=sum(seen) / 2,
            )
            for name in vector_names(solution, plan, places, letter_height, own, unnamed)
            if name.segment is not None
            and (seen := clip_to_circle(*name.segment, radius)) is not None
            and abs(seen[1] - seen[0]) >= NAMED
        ]
        pictures.append(detail_picture(plan, detail_view, at, letters, letter_height, names))
    return pictures


def _labels(
    solution: Solution, plan: Plan, at: dict[PointName, complex], height: float, prefix: str
) -> list[Label]:
    """Return the letters; points that coincide on the paper share one inscription."""
    letters = plan_letters(solution.problem, plan)
    ordered = sorted(letters.items(), key=lambda pair: pair[0] != plan.pole)
    spots = merge_letters((at[name], own) for name, own in ordered if name in at)
    return label_merged_letters(spots, height, f"{prefix}:", style=NEAREST)
