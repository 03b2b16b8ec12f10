"""The scheme as a view of the sheet: the drawn mechanism with its letters, numbers and arrows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field, replace
from itertools import pairwise
from math import ceil, inf

import numpy as np

from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.given import point_name, solution_peak
from planmethod.note.numbers import is_nothing
from planmethod.plans.draft import cis
from planmethod.plans.legend import QuantityKind
from planmethod.plans.model import PlanKind
from planmethod.record import dataclass
from planmethod.render.ink.drawing import Arc, Item, Pen, Stroke
from planmethod.render.ink.extent import arc_points, ink_bounds
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label, Placed, place_labels
from planmethod.render.labels.tidy import untidiness
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.ellipses import Ellipses, error_ellipses
from planmethod.render.pictures.extremes import construction_items
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.positions import Positions
from planmethod.render.pictures.scheme import Scheme
from planmethod.render.pictures.traces import Shown, scheme_traces
from planmethod.render.symbols import SIZES, angle_of, before_links, turn_arrow
from planmethod.solved.reading import remembered
from planmethod.solved.solution import Solution
from planmethod.solved.turn.construction import extreme_construction


@dataclass(slots=True)
class _View:
    """A drawn scheme and what is written on it."""

    scheme: Scheme
    arrows: list[Item] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)

    def items(self, marks: Sequence[Item] = ()) -> list[Item]:
        """Return what is drawn, in order; ``marks`` are the joints of other positions."""
        s = self.scheme
        mechanism = before_links([*s.bodies, *s.lines, *s.corners, *marks, *s.joints])
        return [*s.guides, *mechanism, *self.arrows]


def _letter_points(view: _View, points: Sequence[str] | None = None) -> None:
    scheme = view.scheme
    for point in scheme.named if points is None else points:
        place = scheme.at(point)
        lines = scheme.directions(place)
        view.labels.append(
            Label(
                typeset(point_name(point), scheme.letter_height),
                place,
                prefer=-sum(lines, 0j) if lines else 1 + 1j,
                gap=1.5 * scheme.factor + 1.2,
                priority=1,
                name=f"point {point}",
            )
        )


SMALL = 3.5
"""Height of the smaller letters of a scheme, mm."""

_LETTER = 6.0  # room of an axis's letter between the joints of other positions, mm


def _letter_axes(view: _View, others: Sequence[complex] = ()) -> None:
    """Letter the ends of the guides' axes, but for an end that lies on a link.

    ``others`` are the joints in other positions, among which a letter would be lost.
    """
    scheme = view.scheme
    for label, low, high in scheme.axis_ends:
        names = label.split("-")
        if len(names) != 2:
            continue
        ends = [(names[0], low, low - high), (names[1], high, high - low)]
        free = [
            min([scheme.clearance(end), *(abs(end - place) - _LETTER for place in others)])
            for _, end, _ in ends
        ]
        for (text, place, away), room in zip(ends, free, strict=True):
            if room > 4.0 or room == max(free):
                view.labels.append(
                    Label(typeset(text, scheme.letter_height), place, prefer=away, gap=1.0)
                )


def _letter_links(view: _View, others: Sequence[Item] = (), *, senses: bool = True) -> None:
    """Put the links' numbers down, and circular arrows for the senses of omega and epsilon.

    Among the lines of ``others``, the other positions, only the driver has arrows.
    """
    scheme = view.scheme
    for link in scheme.solution.problem.mechanism.links:
        view.labels.append(scheme.link_label(link, 5.5 * scheme.factor))
        if senses and (not others or link == scheme.solution.problem.drive.link):
            _senses(view, link, others)


def _senses(view: _View, link: str, others: Sequence[Item] = ()) -> None:
    """Draw the arrows of a link, among the lines of other positions where these leave room."""
    scheme = view.scheme
    motion = scheme.solution.links[link]
    problem = scheme.solution.problem
    body = problem.bodies[link].points
    if link in problem.slides and len(body) == 1:
        return  # the stone turns with the link that it slides on: one arrow for both
    part = scheme.longest(link)
    if part is None:
        return
    pivot = next((p for p in body if p in problem.bodies[FRAME].points), None)
    places = _turning(view, part, None if pivot is None else scheme.at(pivot))
    kinds = (
        (QuantityKind.OMEGA, float(motion.omega[scheme.index])),
        (QuantityKind.EPSILON, float(motion.epsilon[scheme.index])),
    )
    for (kind, value), (centre, radius, turn) in zip(kinds, places, strict=True):
        if is_nothing(value, solution_peak(scheme.solution, kind)):
            continue
        sense = 1 if value > 0 else -1
        middle, sweep = turn, min(SWEEP, np.degrees(ARC * scheme.factor / radius))
        # The tail, where the letter is, looks for room; a single arrow goes on crossing its link.
        around = [*others, *scheme.bodies, *scheme.lines, *scheme.joints, *view.arrows]
        beyond = np.degrees(scheme.letter_height / radius)
        most, enough = (180.0, inf) if others else (0.25 * sweep, 0.8 * scheme.letter_height)
        middle += _roomy(centre, radius, turn - sense * (sweep / 2 + beyond), around, most, enough)
        view.arrows += turn_arrow(
            centre,
            radius,
            sense,
            middle=middle,
            sweep=sweep,
            length=3.5 * scheme.factor,
            tag=f"{kind.sign} {link}",
        )
        # The letter goes on behind the tail of its own arc.
        aim = cis(middle - sense * sweep / 2)
        view.labels.append(
            Label(
                typeset(f"{kind.sign}_{{{link}}}", SMALL if others else scheme.letter_height),
                centre + radius * aim,
                prefer=-1j * sense * aim,
                gap=0.8,
                priority=2,
                name=f"{kind.sign} {link}",
            )
        )


SWEEP, ARC = 70.0, 24.0
"""Most that an arrow of ω or ε turns by, degrees, and its length before ``factor``, mm."""

_LEAST, _BETWEEN, _OFF = 9.0, 11.0, 5.0
"""Least radius of such an arrow, between two about one centre, and to a joint, before ``factor``,
mm."""


def _turning(
    view: _View, part: tuple[complex, complex], pivot: complex | None
) -> tuple[tuple[complex, float, float], ...]:
    """Return where the arrows of ω and of ε cross a link: centre, radius, direction in degrees.

    Two arrows never stand side by side, where their letters would be taken one for the other: about
    a pivot they have radii well apart, on another link they cross it on both sides of their centre.
    Both keep clear of the joints, points and stones on the link, and of the arrows of other links.
    """
    scheme = view.scheme
    start, end = (
        part if pivot is None or abs(part[1] - pivot) > abs(part[0] - pivot) else part[::-1]
    )
    start = start if pivot is None else pivot
    length, along, f = abs(end - start), angle_of(end - start), scheme.factor
    problem = scheme.solution.problem
    pins = [(scheme.at(p), _OFF * f) for p in scheme.named]
    arcs = [item for item in view.arrows if isinstance(item, Arc)]
    pins += [(p, 2 * _OFF * f) for arc in arcs for p in arc_points(arc)[::4]]
    for slide in problem.slides.values():
        place = scheme.base(slide) if problem.is_block(slide) else scheme.at(slide.pin)
        pins.append((place, (_OFF + SIZES.slider_length / 2) * f))

    def room(way: float) -> float:
        place = start + (end - start) / length * way
        return min(abs(place - pin) - off for pin, off in pins)

    ways = np.linspace(0.0, length, max(12, int(length)))
    if pivot is not None:
        near = [way for way in ways if way >= (_LEAST + _OFF) * f]
        first = next(
            (way for way in near if room(way) >= 0.0), max(near, key=room, default=ways[-1])
        )
        far = [way for way in near if way >= first + _BETWEEN * f]
        second = next((way for way in far if room(way) >= 0.0), first + _BETWEEN * f)
        return (start, float(first), along), (start, float(second), along)
    radius = (_LEAST - 1.0) * f
    middles = [way for way in ways if radius <= way <= length - radius] or [length / 2]
    best = max(
        middles,
        key=lambda way: (
            min(room(way - radius), room(way + radius), 0.0) - 0.01 * abs(way - 0.45 * length)
        ),
    )
    centre = start + (end - start) / length * best
    return (centre, radius, along), (centre, radius, along + 180.0)


def _roomy(
    centre: complex,
    radius: float,
    turn: float,
    items: Sequence[Item],
    most: float,
    enough: float = inf,
) -> float:
    """Return how far to turn about a centre from a direction to where a letter has room, deg.

    ``most`` is the furthest, degrees; more room than ``enough`` is not looked for, mm.
    """
    lines = [pair for item in items if isinstance(item, Stroke) for pair in pairwise(item.points)]
    ends = np.asarray(lines)
    ways = ends[:, 1] - ends[:, 0] + 1e-9
    turns = (0.0, *(sign * k * 7.5 for k in range(1, 25) for sign in (1, -1) if k * 7.5 <= most))

    def room(by: float) -> float:
        place = centre + radius * cis(turn + by)
        part = np.clip(((place - ends[:, 0]) / ways).real, 0.0, 1.0)
        free = float(np.abs(place - ends[:, 0] - ways * part).min())
        return round(min(free, enough) - abs(by) / 180.0, 3)

    return max(turns, key=room)


def _draw_angle(view: _View) -> None:
    """Show the crank's angle phi from the horizontal."""
    scheme = view.scheme
    drive = scheme.solution.problem.drive
    if drive.pivot is None:
        return
    phi = float(scheme.solution.positions[scheme.index]) % 360.0
    if phi < 8 or phi > 352:
        return
    centre, radius = scheme.at(drive.pivot), 6.0 * scheme.factor + 2
    support = angle_of(scheme.free_direction(centre)) % 360.0
    if support < phi:
        radius = (SIZES.support_height + SIZES.hatch_stroke + 4.0) * scheme.factor
        pins = [scheme.at(p) for p in scheme.solution.problem.bodies[drive.link].points]
        if max(abs(pin - centre) for pin in pins) < radius + 4.0:
            return  # no room for an arc around the support: the statement tells the angle
    scheme.guides.append(Stroke((centre, centre + radius + 6), Pen.THIN, tag="phi"))
    scheme.guides += turn_arrow(centre, radius, 1, middle=phi / 2, sweep=phi, length=2.5, tag="phi")
    view.labels.append(
        Label(
            typeset(f"φ_{{{drive.link}}}", SMALL),
            centre + radius * cis(phi / 2),
            prefer=cis(phi / 2),
            gap=1.0,
            name="phi",
        )
    )


@remembered
def scheme_picture(
    solution: Solution,
    index: int,
    *,
    letter_height: float = 5.0,
    overlay: tuple[int, ...] = (),
    errors: bool = False,
    turn: bool = False,
    bare: bool = False,
    traces: Shown = False,
) -> Picture:
    """Return the scheme in one position as a picture, mm.

    The positions of ``overlay`` are there in thin lines, their points lettered and numbered; the
    arrows of the links but the driver's, and its angle, are left to the single position.
    ``errors`` draws the ellipses of the drafting error around the moving points, ``turn`` the
    construction of the extreme positions. ``bare`` leaves out what tells of the motion: arrows, the
    angle of the driver, letters of the axes. ``traces`` is told by
    `planmethod.render.pictures.traces`.
    """
    scheme = Scheme(solution, index, letter_height)
    scheme.draw()
    scheme.draw_joints()
    scheme.guides += scheme_traces(solution, index, scheme.factor, traces)
    view = _View(scheme)
    many = len(overlay) > 1
    ellipses = error_ellipses(solution, PlanKind.POSITION, index) if errors else Ellipses()
    if many:
        positions = Positions(solution, index, overlay, letter_height)
        return _many_picture(view, positions, ellipses, turn=turn)
    _letter_points(view)
    if not bare:
        _letter_axes(view)
    _letter_links(view, senses=not bare)
    if not bare:
        _draw_angle(view)
    # The ellipses after the joints, whose white would cover them.
    items = [*view.items(), *ellipses.strokes]
    return lettered(items, view.labels, clear=ellipses.grounds)


SERIES_HEIGHTS = (SMALL, 2.5)
"""Heights of the letters of many positions, mm: the smaller ones where the larger find no room."""

UNTIDY = 0.03
"""More `untidiness` for each label is a reason to take the smaller letters."""

MOST = 14
"""Positions that all have letters; of twice as many every other one has, and so on."""

ROOM = 40.0
"""Room around many positions for their letters, mm."""


def _many_picture(view: _View, positions: Positions, ellipses: Ellipses, *, turn: bool) -> Picture:
    """Return the scheme with other positions behind it; smaller letters where larger do not fit."""
    scheme = view.scheme
    fixed = scheme.solution.problem.bodies[FRAME].points
    _letter_points(view, [point for point in scheme.named if point in fixed])
    _letter_axes(view, positions.places())
    others = positions.lines()
    _letter_links(view, others)
    own = [replace(label, manner=BUSY) for label in view.labels]
    construction = extreme_construction(scheme.solution) if turn else None
    if construction is not None:
        lines, radii = construction_items(construction, SMALL)
        others, own = [*others, *lines], [*own, *radii]
    items = [*others, *view.items(marks=positions.marks()), *ellipses.strokes]
    left, low, right, high = ink_bounds(items)
    bounds = (left - ROOM, low - ROOM, right + ROOM, high + ROOM)
    tries: list[list[Placed]] = []
    for height in SERIES_HEIGHTS:
        labels = [*own, *positions.labels(height, every=ceil(len(positions.overlay) / MOST))]
        last = height == SERIES_HEIGHTS[-1]
        tries.append(place_labels(labels, [*items, *ellipses.grounds], bounds, breaking=last))
        if untidiness(tries[-1]) <= UNTIDY * len(labels):
            break
    placed = min(tries, key=untidiness)
    whole = [*items, *(item for label in placed for item in label.items())]
    return Picture(tuple(whole), ink_bounds(whole))
