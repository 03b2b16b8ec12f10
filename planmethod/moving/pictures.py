"""Pictures of a moving point: its trajectory with vectors, and the hodographs.

A picture is millimetres: the trajectory from its own origin, a hodograph from its pole.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import ceil, floor

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.scale import Scale, choose_scale, series_near
from planmethod.construct.steps import PointName
from planmethod.moving.construction import (
    POLES,
    Complexes,
    DrawnInterval,
    MomentConstruction,
    places_of,
)
from planmethod.moving.motion import Law, Motion, PointProblem
from planmethod.note.numbers import Notation, trimmed
from planmethod.problem.model import Convention
from planmethod.render.ink.drawing import Arc, Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import ink_bounds, typeset, vector_markup
from planmethod.render.labels import BUSY, Label
from planmethod.render.labels.label_column import merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.diagram import HODOGRAPH
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.planview import POLE
from planmethod.render.symbols import revolute, straight_arrow, vector_arrow

AXIS = "axis of coordinates"
OWN_PATH = "path"
"""Tag of the line that the problem asks for, as thick as a link: ``path M``."""

SMALL = 3.5
"""Height of the numbers of instants and of the letters of components, mm."""

_OVERSHOOT = 9.0  # mm: an axis extends beyond the drawing
_NEAR_ORIGIN = 25.0  # mm: an origin is within the picture or so far from it
_CLEARANCE = 6.0  # mm: between the picture and an axis beside it
_TICK = 1.0  # mm: half of a tick
_AXIS_NUMBER_SPACING = 14.0  # mm: between the numbers of an axis
_DOT = 0.8  # mm: a numbered instant
_MIN_VECTOR = 0.6  # mm: a shorter vector is not drawn
_CURVED = 45.0  # mm: a circle of curvature up to this radius is drawn
_MARGIN = 3.0  # mm: least room that letters take around a picture
_LONGEST, _SHORTEST = 45.0, 15.0  # mm: of the largest vector at the trajectory


def plan_scale(course: DrawnInterval, plan: str, box: tuple[float, float], requested: float | None,
               convention: Convention) -> Scale:  # fmt: skip
    """Return the scale at which the hodograph of ``plan``, v or a, fills a box with its pole."""
    names, unit = (f"{plan}x", f"{plan}y"), {"v": "m/s", "a": "m/s²"}[plan]
    marks = course.numbered(*names)
    extent = _extent([np.zeros(1, complex), marks[~np.isnan(marks)], *course.curves(*names)])
    return Scale(f"mu_{plan}", requested or _chosen(extent, box, convention), unit)


def _chosen(extent: tuple[float, float], box: tuple[float, float], convention: Convention) -> float:
    return choose_scale(extent, box, mm_per_unit=convention is Convention.MM_PER_UNIT)


def _extent(parts: Iterable[Complexes]) -> tuple[float, float]:
    places = np.concatenate(list(parts))
    return float(np.ptp(places.real)), float(np.ptp(places.imag))


def vector_scales(course: DrawnInterval, scales: Mapping[str, Scale]) -> dict[str, Scale]:
    """Return the scales of the vectors at the trajectory.

    They are the hodographs' unless the vectors would hide the trajectory, or be too short to see
    beside it.
    """
    found = dict(scales)
    for plan in "va":
        sizes = course.marks.columns[plan][list(course.shown)]
        peak = float(np.nanmax(sizes, initial=0.0))
        wanted = min(max(peak / scales[plan].per_mm, _SHORTEST), _LONGEST)
        if peak > 0.0 and wanted * scales[plan].per_mm != peak:
            per_mm = series_near(peak / wanted, up=wanted == _LONGEST)
            found[plan] = replace(scales[plan], per_mm=per_mm)
    return found


def length_scale(
    problem: PointProblem,
    course: DrawnInterval,
    scales: Mapping[str, Scale],
    box: tuple[float, float],
) -> Scale:
    """Return the scale at which the trajectory fills a box with the vectors at it."""
    if problem.scales.mu_l is not None:
        return Scale("mu_l", problem.scales.mu_l, "m")
    convention, scales = problem.scales.convention, vector_scales(course, scales)
    path = list(course.curves("x", "y"))
    here = course.numbered("x", "y")
    path.append(here[~np.isnan(here)])
    if problem.wheel is not None:
        corner = problem.wheel.radius * (1 + 1j)
        centre = places_of(course.marks, "xC", "yC")[list(course.shown)]
        path += [centre - corner, centre + corner]
    room = box
    for _ in range(8):
        per_mm = _chosen(_extent(path), room, convention)
        whole = [part / per_mm for part in path]
        for plan in "va":
            vectors = places_of(course.marks, f"{plan}x", f"{plan}y") / scales[plan].per_mm
            tips = here / per_mm + vectors
            whole.append(np.array([tips[k] for k in course.shown if not np.isnan(tips[k])]))
        wide, high = _extent(whole)
        if wide <= 1.05 * box[0] and high <= 1.05 * box[1]:
            break
        room = (0.8 * room[0], 0.8 * room[1])
    return Scale("mu_l", per_mm, "m")


# Trajectory ---------------------------------------------------------------------------------------


def trajectory_picture(
    problem: PointProblem,
    course: DrawnInterval,
    scales: Mapping[str, Scale],
    *,
    letter_height: float,
    notation: Notation,
    draft: bool = False,
) -> Picture:
    """Return the trajectory: axes, curve, numbered instants, vectors, the circle of curvature.

    ``draft``: without letters, in little more than the room that the lines take.
    """
    per_mm, marks = scales["l"].per_mm, course.marks
    here = course.numbered("x", "y") / per_mm
    items: list[Item] = []
    labels: list[Label] = []
    for k in course.shown:
        if problem.law is Law.ROLLING and not np.isnan(here[k]):
            rolling = _wheel(problem, marks, k, per_mm, letter_height)
            items += rolling[0]
            labels += rolling[1]
    if problem.wheel is not None and problem.wheel.track:
        items.append(Arc(0j, abs(problem.wheel.track) / per_mm, pen=Pen.THIN, tag="track"))
    items += _curve(course.curves("x", "y"), per_mm, f"{OWN_PATH} M")
    for number, k in enumerate(course.shown):
        if not np.isnan(here[k]):
            own = f"_{{{k}}}" if len(course.shown) > 1 else ""
            instant = _Instant(k, marks.values_at(k), complex(here[k]), own)
            vectors = _vectors_at(instant, scales, letter_height, parts=not number)
            items += vectors[0]
            labels += vectors[1]
            if number == 0:
                more = _curvature(instant, per_mm, letter_height)
                # A wheel has circles enough.
                items += more[0] if problem.wheel is None else more[0][1:]
                labels += more[1]
            labels.append(Label(typeset(f"M{own}", letter_height), instant.place, gap=2.2,
                                priority=2, name=f"point {k}"))  # fmt: skip
    items = [
        *_axes(items, ("x", "y"), letter_height, labels, scale=scales["l"], notation=notation),
        *items,
    ]
    items += _dots(here, labels, "instant")
    for k in course.shown:
        if not np.isnan(here[k]):
            items += revolute(complex(here[k]))
    return _roughly(items) if draft else lettered(items, labels)


def _roughly(items: Sequence[Item]) -> Picture:
    left, low, right, top = ink_bounds(items)
    return Picture(tuple(items), (left - _MARGIN, low - _MARGIN, right + _MARGIN, top + _MARGIN))


def _curve(parts: Iterable[Complexes], per_mm: float, tag: str) -> list[Item]:
    """Return the smooth parts of a curve; a part of negligible size on paper is left out."""
    drawn: list[Item] = []
    for part in parts:
        points = part / per_mm
        if max(_extent([points])) < 0.05:
            continue
        steps = np.abs(np.diff(points))
        kept = points[np.concatenate([[True], steps > 1e-6])]
        if len(kept) > 1:
            drawn.append(Stroke(tuple(map(complex, kept)), Pen.MAIN, tag=tag, smooth=True))
    return drawn


def _dots(places: Complexes, labels: list[Label], name: str) -> list[Item]:
    """Return the numbered instants; those in one place share one inscription."""
    numbered = [(complex(p), [str(k)]) for k, p in enumerate(places) if not np.isnan(p)]
    spots = merge_letters(numbered, near=0.5)
    if not spots:
        return []
    for n, (place, numbers) in enumerate(spots):
        before, after = spots[max(n - 1, 0)][0], spots[min(n + 1, len(spots) - 1)][0]
        text = ", ".join(numbers)
        side = 1j * (after - before)  # beside the curve
        labels.append(Label(typeset(text, SMALL), place, prefer=side, gap=1.4,
                            name=f"{name} {text}", style=BUSY))  # fmt: skip
    return [Disc(place, _DOT, Ink.BLACK, tag=name) for place, _ in spots]


class _Instant(Struct, frozen=True):
    """A numbered instant of a trajectory.

    It has the values of the motion, the place of the point, mm, and the index of its letters.
    """

    number: int
    values: Mapping[str, float]
    place: complex
    index: str

    def vector(self, plan: str) -> complex:
        """Return the velocity or acceleration, SI: ``v`` or ``a``."""
        return complex(self.values[f"{plan}x"], self.values[f"{plan}y"])


def _vectors_at(
    instant: _Instant, scales: Mapping[str, Scale], height: float, *, parts: bool
) -> tuple[list[Item], list[Label]]:
    """Return velocity, acceleration and, as ``parts``, its projections, all from the point."""
    v, a, here = instant.vector("v"), instant.vector("a"), instant.place
    along = v / abs(v) * instant.values["a_tangential"] if abs(v) > 0 else complex("nan")
    wanted = [(f"v{instant.index}", "v", v, True), (f"a{instant.index}", "a", a, True)]
    if (
        parts and min(abs(along), abs(a - along)) > _MIN_VECTOR * scales["a"].per_mm
    ):  # else it is the whole
        wanted += [("a^{τ}", "a", along, False), ("a^{n}", "a", a - along, False)]
    items: list[Item] = []
    labels: list[Label] = []
    for symbol, plan, vector, is_whole in wanted:
        size = vector / scales[plan].per_mm
        if not abs(size) > _MIN_VECTOR:
            continue
        pen, tag = (Pen.RESULTANT, "absolute") if is_whole else (Pen.COMPONENT, "normal")
        items += vector_arrow(here, here + size, pen=pen, tag=tag)
        if not is_whole:
            items.append(Stroke((here + size, here + a / scales["a"].per_mm), Pen.THIN, tag="aid"))
        labels.append(_letter(symbol, here, here + size, height, f"at {instant.number}: "))
    return items, labels


def _letter(symbol: str, tail: complex, head: complex, height: float, prefix: str) -> Label:
    """Return the letter of a vector, at its head."""
    markup = vector_markup(symbol)
    return Label(typeset(markup, height), head, prefer=head - tail, gap=1.6, priority=1,
                 name=f"{prefix}{symbol}", style=BUSY)  # fmt: skip


def _curvature(instant: _Instant, per_mm: float, height: float) -> tuple[list[Item], list[Label]]:
    """Return the circle of curvature with its centre, unless it is larger than the picture."""
    radius, here = instant.values["rho"] / per_mm, instant.place
    if not 3.0 < radius <= _CURVED:
        return [], []
    v, a = instant.vector("v"), instant.vector("a")
    normal = 1j * v / abs(v)
    centre = here + normal * np.sign((a * normal.conjugate()).real) * radius
    items: list[Item] = [
        Arc(centre, radius, pen=Pen.THIN, tag="circle of curvature"),
        Stroke((here, centre), Pen.THIN, tag="radius of curvature"),
        Disc(centre, _DOT, Ink.BLACK, tag="centre of curvature"),
    ]
    ends = (here, complex(centre))
    return items, [
        Label(typeset("K", height), complex(centre), gap=1.5, name="centre of curvature"),
        Label(typeset("ρ", height), sum(ends) / 2, ends, gap=1.2, name="radius of curvature"),
    ]


def _wheel(
    problem: PointProblem, marks: Motion, k: int, per_mm: float, height: float
) -> tuple[list[Item], list[Label]]:
    """Return the wheel, its carrier, its centre C, and the centre of velocities P with PM."""
    wheel = problem.wheel
    assert wheel is not None
    centre, touch, here = (
        complex(places_of(marks, f"x{of}", f"y{of}")[k]) / per_mm for of in ("C", "P", "")
    )
    radius = wheel.radius / per_mm
    items: list[Item] = [Arc(centre, radius, pen=Pen.THIN, tag="wheel")]
    labels: list[Label] = []
    own = f"_{{{k}}}" if marks.columns["t"].size and len(problem.times) > 1 else ""
    if abs(here - touch) > _MIN_VECTOR:
        items.append(Stroke((touch, here), Pen.THIN, tag="reach"))
    if abs(here - centre) > _MIN_VECTOR:
        items.append(Stroke((centre, here), Pen.THIN, tag="arm"))
    spots = [("C", centre), ("P", touch)]
    if wheel.arm:
        items.append(Stroke((0j, centre), Pen.THIN, tag="carrier"))
        spots.append(("O", 0j))
    for letter, place in spots:
        if np.isnan(place):
            continue  # no centre of velocities: the wheel does not turn
        items.append(Disc(place, _DOT, Ink.BLACK, tag=f"centre {letter}"))
        named = typeset(letter if letter == "O" else letter + own, height)
        labels.append(Label(named, place, gap=1.5, priority=1, name=f"{letter} {k}", style=BUSY))
    return items, labels


# Hodograph ----------------------------------------------------------------------------------------


def hodograph_picture(
    course: DrawnInterval,
    plan: str,
    built: MomentConstruction | None,
    scales: Mapping[str, Scale],
    *,
    letter_height: float,
    draft: bool = False,
) -> Picture:
    """Return the hodograph of ``plan``, v or a, with the construction of the first shown instant.

    Parts of the vector are thin; the chord of its neighbours replaces the tangent, from which
    the acceleration is read. ``draft`` is that of `trajectory_picture`.
    """
    per_mm, names = scales[plan].per_mm, (f"{plan}x", f"{plan}y")
    marks = course.numbered(*names) / per_mm
    items = _curve(course.curves(*names), per_mm, f"{HODOGRAPH} {plan}")
    labels: list[Label] = []
    pole = POLES[plan]
    if built is not None:
        more = _plan(built, plan, letter_height)
        items += more[0]
        labels += more[1]
    if plan == "v" and course.shown:
        k = course.shown[0]
        ends = marks[max(k - 1, 0) : k + 2]
        if len(ends) == 3 and not np.isnan(ends).any() and abs(ends[2] - ends[0]) > _MIN_VECTOR:
            chord = (complex(ends[0]), complex(ends[2]))
            items.append(Stroke(chord, Pen.THIN, tag="chord"))
    axes = [f"{plan}_{{x}}", f"{plan}_{{y}}"]
    items = [*_axes([*items, Disc(0j, 1.0)], axes, letter_height, labels), *items]
    items += _dots(marks, labels, f"{plan} instant")
    items.append(Disc(0j, 0.9, Ink.BLACK, tag=POLE))
    labels.append(Label(typeset(pole, letter_height), 0j, gap=1.6, priority=2, name=f"{plan} pole"))
    return _roughly(items) if draft else lettered(items, labels)


def _plan(built: MomentConstruction, plan: str, height: float) -> tuple[list[Item], list[Label]]:
    """Return the vectors of one plan, from its pole: parts thin, the whole one thick."""
    trace = built.read()

    def at(name: PointName) -> complex:
        return complex(np.ravel(trace.value[name])[0])

    items: list[Item] = []
    labels: list[Label] = []
    own = [vector for vector in built.vectors if vector.plan == plan]
    wholes = [(at(vector.tail), at(vector.head)) for vector in own if vector.is_resultant]
    for vector in own:
        tail, head = at(vector.tail), at(vector.head)
        same = any(abs(tail - one) < 0.5 and abs(head - two) < 0.5 for one, two in wholes)
        if np.isnan(head) or abs(head - tail) < _MIN_VECTOR or (same and not vector.is_resultant):
            continue
        pen, tag = Pen.RESULTANT, "absolute"
        if not vector.is_resultant:
            pen, tag = Pen.COMPONENT, "normal"
        items += vector_arrow(tail, head, pen=pen, tag=tag)
        size = height if vector.is_resultant else SMALL
        told, ends = typeset(vector_markup(vector.symbol), size), (tail, head)
        labels.append(Label(told, (tail + head) / 2, ends, gap=1.2, priority=1,
                            name=f"{plan}: {vector.symbol}"))  # fmt: skip
    return items, labels


# Axes ---------------------------------------------------------------------------------------------


def _crossing(low: float, high: float, pitch: float) -> float:
    """Return where an axis is crossed, mm: at zero, or at a number of it before the picture."""
    if low - _NEAR_ORIGIN <= 0.0 <= high + _NEAR_ORIGIN:
        return 0.0
    return pitch * floor((low - _CLEARANCE) / pitch)


def _axes(
    items: Sequence[Item], names: Sequence[str], height: float, labels: list[Label],
    *, scale: Scale | None = None, notation: Notation | None = None,
) -> list[Item]:  # fmt: skip
    """Return both axes around the drawing, with numbers where a scale is named.

    They cross at the origin; where that is far off, at a number of theirs beside the picture. Then
    both numbers of the crossing are drawn.
    """
    left, low, right, top = ink_bounds(items)
    pitch = _AXIS_NUMBER_SPACING  # mm
    if scale is not None:
        pitch = series_near(pitch * scale.per_mm, up=True) / scale.per_mm
    x0, y0 = _crossing(left, right, pitch), _crossing(low, top, pitch)
    left, right = min(left, x0), max(right, x0) + _OVERSHOOT
    low, top = min(low, y0), max(top, y0) + _OVERSHOOT
    drawn: list[Item] = []
    ways = ((1 + 0j, complex(left, y0), complex(right, y0), -1j),
            (1j, complex(x0, low), complex(x0, top), -1 + 0j))  # fmt: skip
    for name, (way, start, end, side) in zip(names, ways, strict=True):
        start -= 3.0 * way
        drawn += straight_arrow(start, end, tag=AXIS)
        labels.append(Label(typeset(name, height), end, prefer=side, gap=2.0, priority=3,
                            name=f"axis {name}"))  # fmt: skip
        if scale is None or notation is None:
            continue
        first, last = (float((p / way).real) for p in (start, end - 6.0 * way))
        for k in range(ceil(first / pitch), floor(last / pitch) + 1):
            place = way * (k * pitch) + (1j * y0 if way.real else x0)
            if not k and (x0, y0) == (0.0, 0.0) and way.imag:
                continue  # the zero of both axes
            drawn.append(Stroke((place - side * _TICK, place + side * _TICK), Pen.THIN, tag=AXIS))
            number = typeset(notation.number(trimmed(k * pitch * scale.per_mm, 4)), 2.5)
            labels.append(Label(number, place, prefer=side, gap=1.6, name=f"axis {name} {k}"))
    return drawn
