"""Letters of views that are too many or too few (плотность и полнота обозначений).

``PM-D17``  too many letters in one part of a scheme to be distinguished
``PM-D18``  vectors of a plan that have no name
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from planmethod.plans.model import PlanKind
from planmethod.render.control.misleading import box_contains, is_of_point
from planmethod.render.control.remarks import Facts, Finding
from planmethod.render.control.texts import Writing
from planmethod.render.ink.drawing import View
from planmethod.solved.label_density import MAX_LABELS, SIDE, densest

NAMED, NAMED_OF_SEVERAL = 5.0, 8.0
"""Length from which a vector has its name, and on a plan of several positions, mm."""

UNNAMED = 20.0
"""Largest share of a plan's vectors that may be without a name, per cent: where no place is free,
the letters of their ends name them."""

_ALLOWANCE = 4  # a square may have more letters than points, for letters lie beside the points


def find_crowded_schemes(writings: Sequence[Writing], views: Sequence[View]) -> Iterator[Finding]:
    """Find schemes with too many letters in one place: one finding for each, at the densest."""
    for view in views:
        if view.kind != PlanKind.POSITION.value:
            continue
        own = [w for w in writings if is_of_point(w.name) and box_contains(view.box, w.place)]
        count, where = densest([complex(w.ink.centroid.x, w.ink.centroid.y) for w in own])
        if count > MAX_LABELS + _ALLOWANCE:
            facts: Facts = {"side": SIDE}
            yield Finding(
                "PM-D17", where, float(count), float(MAX_LABELS + _ALLOWANCE), facts, view.kind
            )


def find_unnamed_vectors(writings: Sequence[Writing], views: Sequence[View]) -> Iterator[Finding]:
    """Find plans with too many vectors without a name: one finding for each plan."""
    there = {writing.name for writing in writings}
    for view in views:
        for position in dict.fromkeys(span.position for span in view.spans):
            least = NAMED if position is None else NAMED_OF_SEVERAL
            long = [
                span
                for span in view.spans
                if span.position == position and span.label and span.length >= least
            ]
            bare = [span for span in long if span.label not in there]
            share = 100.0 * len(bare) / max(len(long), 1)
            if share > UNNAMED:
                facts = {"segments": tuple((span.name, round(span.length, 3)) for span in bare)}
                where = (bare[0].start + bare[0].end) / 2
                yield Finding("PM-D18", where, share, UNNAMED, facts, view.kind, position)
