"""Pictures with letters around them, and enlarged views of short segments (выносные элементы)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from planmethod.construct.steps import PointName
from planmethod.errors import LayoutError
from planmethod.plans.model import Plan, PlanKind, Vector, VectorKind, is_component
from planmethod.render.ink.drawing import (
    HEIGHTS,
    Arc,
    Bounds,
    Disc,
    Fill,
    Ink,
    Item,
    Pen,
    Stroke,
    Text,
)
from planmethod.render.ink.typeset import ink_bounds, typeset
from planmethod.render.labels import (
    NEAREST,
    SIDE_GAP,
    Label,
    Placed,
    Segment,
    place_labels,
    spare_labels,
)
from planmethod.render.labels.label_column import label_merged_letters, merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.collinear import drawn_vectors
from planmethod.render.symbols import vector_arrow
from planmethod.render.symbols.marks import hatch
from planmethod.solved.legibility import ROUND, DetailView, circle_radius

MARGINS = (26.0, 60.0)
"""Margins around a picture for its letters, mm: the larger if the smaller has no free place."""

LONGEST = 50_000.0
"""Largest width or height of a picture that is drawn, mm. The longest sheet has 2523, but trial
scales may be finer, and plans next to a dead position are many times larger."""


def reject_oversized(left: float, low: float, right: float, high: float) -> None:
    """Reject a picture that fits no paper before time and memory are spent on it.

    Raises
    ------
    LayoutError
        It is wider or higher than `LONGEST`, or its size is not a number.
    """
    if not max(right - left, high - low) <= LONGEST:
        raise LayoutError(
            "a picture of {:.3g} × {:.3g} m does not fit any paper. Use coarser scales in "
            "[scales], or omit them.",
            (right - left) / 1e3,
            (high - low) / 1e3,
        )


def lettered(
    items: Sequence[Item],
    labels: Sequence[Label],
    *,
    clear: Sequence[Item] = (),
    welcome: Sequence[Label] = (),
    segments: Sequence[Segment] = (),
) -> Picture:
    """Return a picture of items with their labels in free places around them.

    The labels keep clear of the invisible items of ``clear`` as long as there is space. ``welcome``
    are labels that are left out if they have no free place within the picture or next to it.
    ``segments`` are explained by `place_labels`.
    """
    left, low, right, high = ink_bounds(items)
    reject_oversized(left, low, right, high)
    for hidden in (clear, ()) if clear else ((),):
        for room in MARGINS:
            bounds = (left - room, low - room, right + room, high + room)
            placed = place_labels(labels, [*items, *hidden], bounds, segments=segments)
            if all(label.free for label in placed):
                break
        else:
            continue
        break
    whole = [*items, *(item for label in placed for item in label.items())]
    left, low, right, high = ink_bounds(whole)
    for label in spare_labels(
        welcome,
        [*whole, *clear, *map(_keep_out_area, placed)],
        (left, low - _LABEL_SPACE, right, high + _LABEL_SPACE),
    ):
        whole += label.items()
    return Picture(tuple(whole), ink_bounds(whole))


_LABEL_SPACE = 3.2
"""Space above and below a picture for its optional labels, mm: the height of one with its gap."""

_HATCH_STEP = 3.0
"""Distance of the lines of hatching, mm."""


def with_hatching(picture: Picture, outlines: Sequence[Sequence[complex]]) -> Picture:
    """Return a picture with hatched areas, whose lines keep clear of everything else on it."""
    occupied = [
        *(item for item in picture.items if not isinstance(item, Text)),
        *(_box(ink_bounds([item])) for item in picture.items if isinstance(item, Text)),
    ]
    lines = [
        line
        for outline in outlines
        for line in hatch(outline, step=_HATCH_STEP, obstacles=occupied)
    ]
    return Picture((*lines, *picture.items), picture.bounds)


def _box(bounds: Bounds) -> Fill:
    left, low, right, high = bounds
    return Fill(
        (complex(left, low), complex(right, low), complex(right, high), complex(left, high))
    )


def _keep_out_area(placed: Placed) -> Fill:
    """Return the area around a label that must stay free for it to be read alone.

    Above and below it, a line between two inscriptions would read as the bar of a fraction.
    """
    left, low, right, high = placed.bounds
    return _box((left - SIDE_GAP, low - _LABEL_SPACE, right + SIDE_GAP, high + _LABEL_SPACE))


ENLARGED = "enlarged"
"""First word of the tag of the circle around a view, before the number of its knot; the tag of the
circle on the plan ends in ``place``."""


def radius_of(detail_view: DetailView, at: Mapping[PointName, complex]) -> float:
    """Return the radius of the view of a knot, mm."""
    ends = (abs(at[end] - detail_view.centre) for pair in detail_view.ends for end in pair)
    return max(ends) * detail_view.times + ROUND


def placed_in(detail_view: DetailView, at: Mapping[PointName, complex]) -> dict[PointName, complex]:
    """Return the places of the points of a plan on the view of a knot, mm from its middle."""
    return {name: (place - detail_view.centre) * detail_view.times for name, place in at.items()}


def points_within(detail_view: DetailView, at: Mapping[PointName, complex]) -> set[PointName]:
    """Return the points of a plan in the circle of a knot."""
    radius = circle_radius(detail_view, at)
    return {name for name, place in at.items() if abs(place - detail_view.centre) < radius}


def detail_mark(
    detail_view: DetailView, at: Mapping[PointName, complex], letter: str, height: float
) -> tuple[Item, Label]:
    """Return the circle around a knot on its plan, and its letter, larger than those of points."""
    radius = circle_radius(detail_view, at)
    circle = Arc(
        detail_view.centre, radius, pen=Pen.THIN, tag=f"{ENLARGED} {detail_view.number} place"
    )
    name = f"{ENLARGED} {detail_view.number}"
    inscription = typeset(letter, letter_of_view(height))
    return circle, Label(inscription, detail_view.centre, gap=radius + 1.0, name=name)


def letter_of_view(height: float) -> float:
    """Return the height of a view's letter, mm: the next to that of points (GOST 2.305).

    Examples
    --------
    >>> letter_of_view(3.5), letter_of_view(5.0)
    (5.0, 7.0)
    """
    return next(larger for larger in HEIGHTS if larger > height)


def vector_pen(vector: Vector, kind: PlanKind, *, fine: bool = False) -> Pen:
    """Return the pen of a vector of a plan; ``fine`` of one of many plans."""
    if is_component(vector, kind):
        return Pen.COMPONENT
    if vector.kind is VectorKind.ABSOLUTE:
        return Pen.FINE_RESULTANT if fine else Pen.RESULTANT
    return Pen.FINE_RELATIVE if fine else Pen.RELATIVE


def detail_picture(
    plan: Plan,
    detail_view: DetailView,
    at: Mapping[PointName, complex],
    letters: Mapping[PointName, list[str]],
    height: float,
    names: Sequence[Label],
) -> Picture:
    """Return the enlarged view of a knot of a plan, its middle at the origin, mm.

    Parameters
    ----------
    at : mapping
        Places of the points of the plan, mm from its pole.
    names : sequence of Label
        Names of the vectors without a name on the plan.
    """
    radius = radius_of(detail_view, at)
    places = placed_in(detail_view, at)
    items: list[Item] = [Arc(0j, radius, pen=Pen.THIN, tag=f"{ENLARGED} {detail_view.number}")]
    drawn: list[Segment] = []
    for vector, ends in drawn_vectors(plan, places):
        inside = clip_to_circle(*ends, radius)
        if inside is None:
            continue
        drawn.append(inside)
        pen = vector_pen(vector, plan.kind)
        if abs(inside[1] - ends[1]) < 1e-9:
            items += vector_arrow(*inside, pen=pen, tag=vector.kind.value)
        else:
            items.append(Stroke(inside, pen, tag=vector.kind.value))
    near = [name for name in letters if name in places and abs(places[name]) < radius - 1.0]
    spots = merge_letters((places[name], letters[name]) for name in near)
    items += [Disc(place, 0.7, Ink.BLACK) for place, _ in spots]
    points = label_merged_letters(spots, height, f"{ENLARGED} {detail_view.number}:", style=NEAREST)
    return lettered(items, [*points, *names], segments=drawn)


def clip_to_circle(tail: complex, head: complex, radius: float) -> tuple[complex, complex] | None:
    """Return the part of a segment within a circle about the origin, or None."""
    way = head - tail
    if abs(way) < 1e-9:
        return None
    middle = -(tail * way.conjugate()).real / abs(way) ** 2
    room = radius**2 - abs(tail + way * middle) ** 2
    if room <= 0.0:
        return None
    half = room**0.5 / abs(way)
    low, high = max(0.0, middle - half), min(1.0, middle + half)
    return (tail + way * low, tail + way * high) if low < high else None
