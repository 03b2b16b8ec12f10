"""The scheme in several positions as a view of the sheet: one in full, the others thin."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

from msgspec.structs import replace

from planmethod.mechanism.model import FRAME
from planmethod.plans.model import PlanKind
from planmethod.render.ink.drawing import Item
from planmethod.render.ink.extent import ink_bounds
from planmethod.render.labels import BUSY, Label, Placed, place_labels
from planmethod.render.labels.candidates import untidiness
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.ellipses import Ellipses, error_ellipses
from planmethod.render.pictures.extremes import construction_items, stroke_items
from planmethod.render.pictures.positions import Positions, Thinned
from planmethod.render.pictures.schemeview import (
    SchemeView,
    axis_labels,
    letter_links,
    letter_points,
)
from planmethod.render.pictures.senses import small
from planmethod.render.pictures.special import special_points
from planmethod.render.pictures.traces import Shown
from planmethod.solved.label_density import MAX_LABELS, densest
from planmethod.solved.reading import memoized
from planmethod.solved.solution import Solution
from planmethod.solved.turn.construction import extreme_construction

MIN_HEIGHT = 2.5
"""Height of the letters of many positions where larger ones do not fit, mm."""

UNTIDY = 0.03
"""`untidiness` per label from which smaller letters are used."""

MAX_LETTERED = 14
"""Largest number of positions that all have letters; with twice as many, every other one, and so
on."""

MARGIN = 40.0
"""Margin around many positions for their letters, mm."""


@memoized
def series_picture(
    solution: Solution,
    index: int,
    overlay: tuple[int, ...],
    *,
    letter_height: float = 5.0,
    errors: bool = False,
    turn: bool = False,
    traces: Shown = False,
    added: tuple[tuple[Item, ...], tuple[Label, ...]] = ((), ()),
) -> Picture:
    """Return the scheme in one position and others over it as a picture, mm.

    The positions of ``overlay`` are there in thin lines, their points lettered and numbered, in
    smaller letters where larger do not fit; the arrows of the links but the driver's, and its
    angle, are left to schemes of one position. ``turn`` draws the construction of the extreme
    positions; ``errors``, ``traces`` and ``added`` are those of `scheme_picture`.
    """
    view = SchemeView.drawn(solution, index, letter_height, traces)
    ellipses = error_ellipses(solution, PlanKind.POSITION, index) if errors else Ellipses()
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
