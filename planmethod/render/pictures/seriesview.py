"""The scheme in several positions: one of them bold, every joint lettered, the extreme ones."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from enum import IntEnum
from functools import cached_property
from math import ceil, radians

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.cycle import radius_names
from planmethod.note.narrate.naming import point_name
from planmethod.plans.draft import cis
from planmethod.plans.model import PlanKind
from planmethod.render.ink.drawing import Arc, Disc, Item, Pen, Stroke, stroke_lines
from planmethod.render.ink.pens import drawn_once
from planmethod.render.ink.typeset import ink_bounds, typeset
from planmethod.render.labels import BUSY, SERIES, Label, Placed, place_labels
from planmethod.render.labels.model import untidiness
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.paths import Paths
from planmethod.render.pictures.planview import (
    USUAL_STYLE,
    Ellipses,
    PictureStyle,
    error_ellipses,
)
from planmethod.render.pictures.scheme import Scheme
from planmethod.render.pictures.schemeview import (
    SchemeView,
    axis_labels,
    ends_of,
    letter_links,
    letter_points,
    nearness,
    small,
    special_points,
)
from planmethod.render.pictures.wheels import contacts
from planmethod.render.symbols import DIMENSION, angle_dimension, dimension
from planmethod.solved.legibility import FEW, MAX_LABELS, MERGE_DISTANCE, densest
from planmethod.solved.solution import Solution
from planmethod.solved.turn.extremes import (
    PRIMES,
    ExtremesConstruction,
    Locus,
    extreme_construction,
)

EXTREME = "extreme position"
"""Tag of the lines of its construction."""

_NOTCH = 7.0  # mm of an arc to both sides of the line that it cuts
_RIGHT = 2.5  # mm: sides of the sign of a right angle
_LEVELS = np.arange(12.0, 60.0, 3.0)  # mm from the guide to the dimension of the stroke
_DIMENSION_CLEARANCE = 2.5  # mm: a closer dimension line crowds a line of the scheme


def construction_items(
    construction: ExtremesConstruction, height: float
) -> tuple[list[Item], list[Label]]:
    """Return thin lines and the names of the radii, mm of the scheme.

    The links drawn in these positions are the radii and tangents themselves.
    """
    items: list[Item] = []
    labels: list[Label] = []
    pivot = construction.place(construction.pivot)
    crank, total, less = radius_names(construction)
    for k, prime in enumerate(PRIMES):
        pin, end = (
            construction.place(f"{construction.pin}{prime}"),
            construction.place(f"{construction.end}{prime}"),
        )
        if construction.locus is Locus.TANGENTS:
            centre = construction.place(construction.centre)
            along, inward = ((p - pin) / abs(p - pin) for p in (centre, pivot))
            corner = (along * _RIGHT, (along + inward) * _RIGHT, inward * _RIGHT)
            items.append(Stroke(tuple(pin + one for one in corner), Pen.THIN, tag=EXTREME))
            name, ends = crank, (pivot, pin)
        else:
            radius, turn = abs(end - pivot), float(np.angle(end - pivot))
            half = min(_NOTCH / radius, radians(30.0))
            items.append(Arc(pivot, radius, turn - half, turn + half, Pen.THIN, EXTREME))
            name = total if construction.sum_arcs[k] else less
            ends = (pivot + 0.25 * (end - pivot), end)
        if k and construction.locus is Locus.TANGENTS:
            continue  # both radii are the crank's
        labels.append(
            Label(typeset(name, height), sum(ends) / 2, segment=ends, gap=0.8,
                  prefer=1j * (ends[1] - ends[0]), name=f"{EXTREME} {k}", style=BUSY)
        )  # fmt: skip
    return items, labels


def stroke_items(
    paths: Paths, ends: tuple[complex, complex], lines: list[Item], height: float
) -> tuple[list[Item], list[Label]]:
    """Return the dimension of the output's stroke H or swing ψ, and its letter.

    ``ends`` are its point in the extreme positions, mm of the scheme; the dimension is placed where
    it crosses the fewest lines.
    """
    output = paths.output
    assert output is not None
    link, point = output
    slide = next((s for s in paths.solution.problem.slides.values() if s.slider == link), None)
    there = ends_of(lines)
    steps = np.linspace(0.0, 1.0, 15)
    if slide is not None:
        outs = np.concatenate([_LEVELS, -_LEVELS]) * 1j * cis(slide.angle)
        places = ends[0] + (ends[1] - ends[0]) * steps + outs[:, None]
        costs = nearness(places, there, _DIMENSION_CLEARANCE).sum(axis=1) + 0.05 * np.abs(outs)
        out = complex(outs[int(np.argmin(costs))])
        along = (ends[0] + out, ends[1] + out)
        label = Label(typeset("H", height), sum(along) / 2, along, out, gap=0.8, priority=3,
                      name=f"{DIMENSION} H", style=BUSY)  # fmt: skip
        return dimension(*ends, out, tag=label.name), [label]
    centre = paths.pivot(point)
    assert centre is not None
    turns = np.unwrap(np.angle(paths.of(point) - centre))
    low, high = float(turns.min()), float(turns.max())
    radii = np.linspace(0.3, 0.75, 10) * abs(ends[0] - centre)
    places = centre + radii[:, None] * np.exp(1j * (low + (high - low) * steps))
    best = float(radii[int(np.argmin(nearness(places, there, _DIMENSION_CLEARANCE).sum(axis=1)))])
    middle = cis(float(np.degrees(low + high)) / 2)
    label = Label(typeset("ψ", height), centre + best * middle, prefer=middle, gap=0.8, priority=3,
                  name=f"{DIMENSION} ψ", style=BUSY)  # fmt: skip
    return angle_dimension(centre, best, low, high, tag=label.name), [label]


POSITION_PRIMES = ("′", "″")
"""Marks of the extreme positions, in the order of the driver's motion."""

_MARK = 0.7  # radius of the circle at a joint in another position, mm
_MIN_MARK = 0.45  # the same where circles would overlap, mm


EVERY = 3
"""Step of the positions that keep their letters if the space is insufficient for all."""


class Thinned(IntEnum):
    """Letters left out of many positions (прореживание), each level including the previous ones.

    The main position and the extreme ones keep their letters.
    """

    NONE = 0
    CENTRES = 1
    """Centres of mass are lettered only in the main position."""
    POINTS = 2
    """The points between driver and output are lettered in every third position."""
    ENDS = 3
    """The points of the driver and the output, too."""
    BETWEEN = 4
    """The points between are lettered only in the main position."""
    ALL = 5
    """All are."""


class SharedPlace(Struct):
    """One place of a point and the numbers of the positions in which it is there."""

    place: complex
    numbers: list[str]
    is_main: bool = False


class Positions:
    """The other positions of a scheme.

    Parameters
    ----------
    solution : Solution
    main : int
        The position that the scheme shows in main lines.
    overlay : tuple of int
        The positions that are shown.
    letter_height : float, mm
    """

    def __init__(
        self, solution: Solution, main: int, overlay: tuple[int, ...], letter_height: float
    ) -> None:
        s = self.solution = solution
        self.main, self.overlay, self.letter_height = main, overlay, letter_height
        self.paths = Paths(s)
        self._shared_places: dict[str, list[SharedPlace]] = {}
        extremes = self.paths.extremes if shows_extremes(s, self.overlay) else ()
        # The extreme positions after the others, so that links have the same length in all of them.
        at = [*s.positions.tolist(), *extremes]
        self.shown = s.with_positions(at).drawn_at(s.scales) if extremes else s
        self.numbers = {k: str(k) for k in self.overlay}
        first = len(s.positions)
        self.numbers |= {
            first + k: prime
            for k, prime in zip(range(len(extremes)), POSITION_PRIMES, strict=False)
        }

    @property
    def ends(self) -> tuple[complex, complex] | None:
        """Places of the output's point in two extreme positions, where both are shown, mm."""
        shown = [index for index, number in self.numbers.items() if number in POSITION_PRIMES]
        output = self.paths.output
        if output is None or len(shown) < len(POSITION_PRIMES):
            return None
        one, two = (self.at(output[1], index) for index in shown)
        return one, two

    @property
    def points(self) -> list[str]:
        """Moving points in the order of the links."""
        bodies = self.solution.problem.bodies
        named = [p for link, body in bodies.items() if link != FRAME for p in body.points]
        return [p for p in dict.fromkeys(named) if p not in bodies[FRAME].points]

    def at(self, point: str, index: int) -> complex:
        """Return the place of a point in a position, mm."""
        trace = self.shown.paper
        return complex(trace.point(PointName(point))[index])

    def shared_places(self, point: str) -> list[SharedPlace]:
        """Return the places of a point, those that coincide on the paper joined."""
        if point not in self._shared_places:
            self._shared_places[point] = self._merge_places(point)
        return self._shared_places[point]

    def _merge_places(self, point: str) -> list[SharedPlace]:
        found: list[SharedPlace] = []
        for index, number in self.numbers.items():
            if number in POSITION_PRIMES and point not in self._turning:
                continue
            place = self.at(point, index)
            spot = next((s for s in found if abs(s.place - place) < MERGE_DISTANCE), None)
            if spot is None:
                spot = SharedPlace(place, [])
                found.append(spot)
            spot.numbers.append(number)
            if index == self.main:
                spot.place, spot.is_main = place, True
        return found

    def places(self) -> list[complex]:
        """Return the places of all moving points in the other positions, mm."""
        return [
            self.at(p, index) for p in self.points for index in self.numbers if index != self.main
        ]

    @cached_property
    def _turning(self) -> set[str]:
        """Points that are lettered in the extreme positions: of the driver and of the output."""
        drive = self.solution.problem.drive
        ends = [p for p in self.solution.problem.bodies[drive.link].points if p in self.points]
        output = self.paths.output
        return {*ends[:1], *([output[1]] if output else [])}

    # Lines -----------------------------------------------------------------------------------

    def lines(self) -> list[Item]:
        """Return the links in the other positions and the lines that the points move along."""
        items: list[Item] = []
        for index in self.numbers:
            if index != self.main:
                items += self._links(index)
        places = {p: [self.at(p, index) for index in self.numbers] for p in self.points}
        shown = np.array([place for own in places.values() for place in own])
        for point, own in places.items():
            items += self.paths.lines(point, shown, np.array(own))
        return items

    def _links(self, index: int) -> Iterable[Item]:
        """Return the lines of the links in a position: thin, dash-dot-dot in an extreme one.

        Rods end at their stones, which are drawn where the positions are few.
        """
        pen = Pen.PHANTOM if self.numbers[index] in POSITION_PRIMES else Pen.PALE
        scheme = Scheme(self.shown, index, self.letter_height, pen=pen)
        problem = self.solution.problem
        for link in problem.mechanism.links:
            if link not in contacts(problem):
                scheme.draw_link(link)
        for slide in problem.slides.values():
            if slide.host != FRAME and slide.slider not in contacts(problem):
                scheme.draw_slider(slide)
        stones = [item for item in scheme.slider_items if isinstance(item, Stroke)]
        few = len(self.overlay) <= FEW
        return map(_thin_if_too_short, [*scheme.lines, *(stones if few else ())])

    def marks(self, thinned: Thinned = Thinned.NONE) -> list[Item]:
        """Return the joints in the other positions: small circles, smaller where they are dense.

        Centres of mass without letters there have no circles.
        """
        items: list[Item] = []
        left_out = self.solution.problem.centres if thinned >= Thinned.CENTRES else frozenset()
        for point in self.points:
            if point in left_out:
                continue
            places = [spot.place for spot in self.shared_places(point) if not spot.is_main]
            apart = min((abs(p - q) for k, p in enumerate(places) for q in places[:k]), default=9.0)
            radius = min(_MARK, max(_MIN_MARK, 0.45 * apart))
            for place in places:
                items += [Disc(place, radius), Arc(place, radius, pen=Pen.THIN)]
        return items

    # Letters ---------------------------------------------------------------------------------

    def labels(
        self, height: float, *, every: int = 1, thinned: Thinned = Thinned.NONE
    ) -> list[Label]:
        """Return the letters of all points in all positions, or in each ``every``-th.

        The bold position has larger letters. A point that does not move has its letter once,
        without numbers.
        """
        labels: list[Label] = []
        for point in self.points:
            spots = self.shared_places(point)
            step = every * self._step(point, thinned)
            ways = self.paths.outward(point, [spot.place for spot in spots])
            for spot, way in zip(spots, ways, strict=True):
                numbers = [
                    n for n in spot.numbers if n in POSITION_PRIMES or (step and not int(n) % step)
                ]
                if spot.is_main and str(self.main) not in numbers:
                    numbers.append(str(self.main))
                if numbers:
                    shown = [] if len(spots) == 1 else numbers
                    labels.append(self._label(point, spot, shown, way, height))
        return labels

    def _step(self, point: str, thinned: Thinned) -> int:
        """Return the step of positions in which a point has letters; 0 for the main one alone."""
        if point in self.solution.problem.centres and thinned >= Thinned.CENTRES:
            return 0
        if point in self._turning:
            last, first = Thinned.ALL, Thinned.ENDS
        else:
            last, first = Thinned.BETWEEN, Thinned.POINTS
        return 0 if thinned >= last else EVERY if thinned >= first else 1

    def _label(
        self,
        point: str,
        spot: SharedPlace,
        numbers: Sequence[str],
        direction: complex,
        height: float,
    ) -> Label:
        size = max(height, self.letter_height) if spot.is_main else height
        return Label(
            typeset(written(point, numbers, is_main=spot.is_main), size),
            spot.place,
            prefer=direction,
            gap=1.5 if spot.is_main else 1.0,
            priority=1 if spot.is_main else 0,
            name=f"point {point} {','.join(numbers)}",
            style=SERIES,
            series=point,
        )


def _thin_if_too_short(item: Item) -> Item:
    """Return a line too short to show its pattern as a thin line (GOST 2.303)."""
    if not isinstance(item, Stroke) or item.pen is not Pen.PHANTOM:
        return item
    return replace(item, pen=Pen.THIN) if len(stroke_lines(item)) < 2 else item


def shows_extremes(solution: Solution, position_indices: Sequence[int]) -> bool:
    """Return whether the extreme positions are shown: among few they would look like two more."""
    return len(position_indices) > FEW or solution.problem.cycle is not None


def written(point: str, numbers: Sequence[str], *, is_main: bool = False) -> str:
    """Return the letters of a point in some positions: ``B_{3}, B_{9}``, ``B′``.

    ``B`` alone without numbers; ``3, 9`` of a point with an index, ``S_{5}′`` with its letter.
    """
    if not numbers:
        return point_name(point)
    if len(point) > 1:
        if is_main:
            return point_name(point) + (f" ({', '.join(numbers)})" if len(numbers) > 1 else "")
        # A number alone is read with the others of its series, a prime alone looks like dirt.
        return ", ".join(point_name(point) + n if n in POSITION_PRIMES else n for n in numbers)
    return ", ".join(point + n if n in POSITION_PRIMES else f"{point}_{{{n}}}" for n in numbers)


MIN_HEIGHT = 2.5
"""Height of the letters of many positions where larger ones do not fit, mm."""

UNTIDY = 0.03
"""`untidiness` per label from which smaller letters are used."""

MAX_LETTERED = 14
"""Largest number of positions that all have letters; with twice as many, every other one, and so
on."""

MARGIN = 40.0
"""Margin around many positions for their letters, mm."""


@drawn_once
def series_picture(
    solution: Solution,
    index: int,
    overlay: tuple[int, ...],
    style: PictureStyle = USUAL_STYLE,
    *,
    turn: bool = False,
    added: tuple[tuple[Item, ...], tuple[Label, ...]] = ((), ()),
) -> Picture:
    """Return the scheme in one position and others over it as a picture, mm.

    The positions of ``overlay`` are there in thin lines, their points lettered and numbered, in
    smaller letters where larger do not fit; the arrows of the links but the driver's, and its
    angle, are left to schemes of one position. ``turn`` draws the construction of the extreme
    positions; ``added`` is that of `scheme_picture`.
    """
    view, letter_height = SchemeView.drawn(solution, index, style), style.letter_height
    ellipses = error_ellipses(solution, PlanKind.POSITION, index) if style.errors else Ellipses()
    positions = Positions(solution, index, overlay, letter_height)
    scheme, size = view.scheme, small(letter_height)
    fixed = solution.problem.bodies[FRAME].points
    letter_points(view, [point for point in scheme.named if point in fixed])
    view.labels += axis_labels(view.scheme, positions.places())
    others = [*positions.lines(), *added[0]]
    letter_links(view, others)
    special = special_points(scheme)
    scheme.guides += special[0]
    view.labels += special[1]
    own = [replace(label, style=BUSY) for label in (*view.labels, *added[1])]
    construction = extreme_construction(solution) if turn else None
    if construction is not None:
        lines, radii = construction_items(construction, size)
        others, own = [*others, *lines], [*own, *radii]
    if positions.ends is not None:
        before = [*others, *view.items()]
        lines, letters = stroke_items(positions.paths, positions.ends, before, size)
        others, own = [*others, *lines], [*own, *letters]
    every = ceil(len(positions.overlay) / MAX_LETTERED)
    thinned = _thinned(positions, own, size, every)
    items = [*others, *view.items(marks=positions.marks(thinned)), *ellipses.strokes]
    left, low, right, high = ink_bounds(items)
    bounds = (left - MARGIN, low - MARGIN, right + MARGIN, high + MARGIN)
    tries: list[list[Placed]] = []
    heights = (size, max(MIN_HEIGHT, 0.5 * letter_height))
    for height in heights:
        labels = [*own, *positions.labels(height, every=every, thinned=thinned)]
        last = height == heights[-1]
        tries.append(
            place_labels(labels, [*items, *ellipses.grounds], bounds, may_interrupt_lines=last)
        )
        if untidiness(tries[-1]) <= UNTIDY * len(labels):
            break
    placed = min(tries, key=untidiness)
    whole = [*items, *(item for label in placed for item in label.items())]
    return Picture(tuple(whole), ink_bounds(whole))


def _thinned(
    positions: Positions, fixed_labels: Sequence[Label], height: float, every: int
) -> Thinned:
    """Return the level of thinning at which the letters fit their area."""
    there = [label.anchor for label in fixed_labels]
    for thinned in Thinned:
        labels = positions.labels(height, every=every, thinned=thinned)
        if densest([*there, *(label.anchor for label in labels)])[0] <= MAX_LABELS:
            break
    return thinned
