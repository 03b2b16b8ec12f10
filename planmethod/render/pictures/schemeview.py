"""The scheme as a view of the sheet: the drawn mechanism with its letters, numbers and arrows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field
from math import ceil

from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.given import point_name
from planmethod.plans.model import PlanKind
from planmethod.record import dataclass, replace
from planmethod.render.ink.drawing import Item
from planmethod.render.ink.extent import ink_bounds
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label, Placed, place_labels
from planmethod.render.labels.tidy import untidiness
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.ellipses import Ellipses, error_ellipses
from planmethod.render.pictures.extremes import construction_items, stroke_items
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.positions import Positions
from planmethod.render.pictures.scheme import Scheme
from planmethod.render.pictures.senses import SMALL, Senses
from planmethod.render.pictures.traces import Shown, scheme_traces
from planmethod.render.symbols import before_links
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


def _letter_links(view: _View, others: Sequence[Item] = (), *, senses: bool = True) -> list[Item]:
    """Put the links' numbers down, and circular arrows for the senses of omega and epsilon.

    Among the lines of ``others``, the other positions, only the driver has arrows; alone it has
    its angle, too. Return what letters keep clear of.
    """
    scheme, own = view.scheme, Senses(view.scheme, others)
    drive = scheme.solution.problem.drive.link
    if senses and not others:
        own.angle()
    for link in scheme.solution.problem.mechanism.links:
        view.labels.append(scheme.link_label(link, 5.5 * scheme.factor))
        if senses and (not others or link == drive):
            own.of(link)
    view.arrows += own.arrows
    view.labels += own.labels
    return own.clear


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
    added: tuple[tuple[Item, ...], tuple[Label, ...]] = ((), ()),
) -> Picture:
    """Return the scheme in one position as a picture, mm.

    The positions of ``overlay`` are there in thin lines, their points lettered and numbered; the
    arrows of the links but the driver's, and its angle, are left to the single position.
    ``errors`` draws the ellipses of the drafting error around the moving points, ``turn`` the
    construction of the extreme positions. ``bare`` leaves out what tells of the motion: arrows, the
    angle of the driver, letters of the axes. ``traces`` is told by
    `planmethod.render.pictures.traces`. ``added`` are more items and their letters.
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
    clear = _letter_links(view, senses=not bare)
    # The ellipses after the joints, whose white would cover them.
    items = [*view.items(), *added[0], *ellipses.strokes]
    return lettered(items, [*view.labels, *added[1]], clear=[*ellipses.grounds, *clear])


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
    if positions.ends is not None:
        before = [*others, *view.items()]
        lines, letters = stroke_items(positions.paths, positions.ends, before, SMALL)
        others, own = [*others, *lines], [*own, *letters]
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
