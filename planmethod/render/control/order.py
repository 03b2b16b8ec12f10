"""Norm control of the order of a sheet: titles, edges, pens, arrowheads, numbers."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from types import MappingProxyType

from planmethod.paper import FORMATS, STAMP_HEIGHT, STAMP_WIDTH
from planmethod.plans.model import VectorKind
from planmethod.render.control.remarks import Finding
from planmethod.render.control.texts import Writing, box_contains
from planmethod.render.frame import STAMP
from planmethod.render.ink.drawing import Bounds, Drawing, Fill, Item, Pen, Stroke, Text, View
from planmethod.render.ink.pens import HEAD_FRACTION, PenSet
from planmethod.render.ink.typeset import ink_bounds
from planmethod.render.layout.groups import CLEAR
from planmethod.render.pictures.paths import TRAJECTORY
from planmethod.render.symbols import DIMENSION, FORCE, PLAN_FORCE

ROW = 1.0
"""Difference of the base lines of two titles that are on one line, mm."""

FLUSH = 0.5
"""Difference of two edges that are flush, mm."""

_ABOVE = 30.0  # mm over the title block: a table there is above it

PENS_OF: Mapping[str, frozenset[Pen]] = MappingProxyType(
    {
        "link": frozenset({Pen.MAIN, Pen.PALE, Pen.THIN, Pen.PHANTOM, Pen.HIDDEN}),
        VectorKind.ABSOLUTE.value: frozenset({Pen.RESULTANT, Pen.FINE_RESULTANT, Pen.COMPONENT}),
        VectorKind.RELATIVE.value: frozenset({Pen.RELATIVE, Pen.FINE_RELATIVE}),
        VectorKind.NORMAL.value: frozenset({Pen.COMPONENT}),
        VectorKind.TANGENTIAL.value: frozenset({Pen.COMPONENT}),
        VectorKind.CORIOLIS.value: frozenset({Pen.COMPONENT}),
        VectorKind.SLIDING.value: frozenset({Pen.COMPONENT, Pen.RELATIVE, Pen.FINE_RELATIVE}),
        "similar": frozenset({Pen.THIN}),
        DIMENSION: frozenset({Pen.THIN}),
        TRAJECTORY: frozenset({Pen.THIN}),
    }
)
"""Pens of lines by the first word of their tags."""

_ARROWS = frozenset({*(kind.value for kind in VectorKind), FORCE, PLAN_FORCE})

# After a sign of equality, or a whole cell of a table: other dots are those of dates, of titles of
# standards, of numbers of formulas.
_NUMBER = re.compile(r"(?:^|[=≈] ?)([−-]?\d+(?:([.,])\d+)?(e[+-]?\d+)?|-?nan|-?inf)(?=$| |[;°])")


def find_disorder(drawing: Drawing, writings: Sequence[Writing]) -> Iterator[Finding]:
    """Find disorder on a sheet."""
    yield from titles_off_the_row(drawing)
    yield from tables_off_the_edge(drawing)
    yield from pens_of_another_weight(drawing)
    yield from heads_too_long(drawing.items)
    yield from numbers_in_two_formats(writings)


# Rows and edges -----------------------------------------------------------------------------------


def list_first_titles(drawing: Drawing) -> list[tuple[View, Text]]:
    """Return the views of the first row, from the left, with the first letters of their titles.

    Nothing but the frame is above such a view. A title is the highest inscription of its view.
    """
    texts = [item for item in drawing.items if isinstance(item, Text) and item.text.strip()]
    others = [item for item in texts if STAMP not in item.tag.split()]
    found = []
    for view in sorted(drawing.views, key=lambda view: view.box[0]):
        left, _, right, high = view.box
        boxes = (other.box for other in drawing.views if other is not view)
        if any(box[0] < right and left < box[2] and box[1] >= high - 1.0 for box in boxes):
            continue
        if any(left < item.at.real < right and item.at.imag > high for item in others):
            continue
        own = [item for item in texts if box_contains(view.box, item.at)]
        if own:
            top = max(own, key=lambda item: (round(item.at.imag + item.height, 3), -item.at.real))
            found.append((view, top))
    return found


def titles_off_the_row(drawing: Drawing) -> Iterator[Finding]:
    """Find titles of the first row that are lower, or of other letters, than the highest one.

    A title just under a graph of the upper corner cannot be higher.
    """
    titles = list_first_titles(drawing)
    if not titles:
        return
    _, first = max(titles, key=lambda title: title[1].at.imag)
    for view, title in titles:
        off = first.at.imag - title.at.imag
        if off > ROW and not _is_under_a_graph(drawing, view, title):
            yield Finding("PM-D20", title.at, off, ROW, {"shown": title.text}, view.kind)
        elif abs(title.height - first.height) > 0.01:
            facts = {"shown": title.text, "advice": "height"}
            yield Finding("PM-D20", title.at, title.height, first.height, facts, view.kind)


def _is_under_a_graph(drawing: Drawing, view: View, title: Text) -> bool:
    """Return whether a graph in the upper corner of the sheet is just over the title of a view."""
    left, _, right, _ = view.box
    boxes = (
        ink_bounds([item])
        for item in drawing.items
        if isinstance(item, Stroke) and item.closed and item.tag == STAMP
    )
    high = title.at.imag + title.height
    return any(
        box[0] < right and left < box[2] and -ROW < box[1] - high < CLEAR + ROW for box in boxes
    )


def table_offset(drawing: Drawing) -> float:
    """Return the distance of the right edge of the lowest table from the title block's, mm."""
    found = _tables_at_the_edge(drawing)
    return min(found, key=lambda one: one[1][1])[0] if found else 0.0


def _tables_at_the_edge(drawing: Drawing) -> list[tuple[float, Bounds]]:
    """Return the tables over the title block with their distances from its right edge, mm."""
    right = max(
        (ink_bounds([i])[2] for i in drawing.items if isinstance(i, Stroke) and i.tag == STAMP),
        default=drawing.width,
    )
    boxes = (
        ink_bounds([item])
        for item in drawing.items
        if isinstance(item, Stroke) and item.closed and item.tag == "table"
    )
    return [(right - box[2], box) for box in boxes if box[2] > right - STAMP_WIDTH]


def tables_off_the_edge(drawing: Drawing) -> Iterator[Finding]:
    """Find tables just over the title block that are not flush with it."""
    for off, box in _tables_at_the_edge(drawing):
        if abs(off) > FLUSH and box[1] < STAMP_HEIGHT + _ABOVE:
            yield Finding("PM-D21", complex(box[2], box[1]), abs(off), FLUSH, {})


# Pens and arrowheads ------------------------------------------------------------------------------


def pens_of_another_weight(drawing: Drawing) -> Iterator[Finding]:
    """Find lines thicker or thinner than their meaning and the format want: one for each meaning.

    A vector too small for its head is drawn with a thin line.
    """
    sizes = {(paper.width, paper.height): paper for paper in FORMATS.values()}
    paper = sizes.get((drawing.width, drawing.height))
    pens, told = drawing.pens if paper is None else PenSet.of(paper), set[str]()
    for item in drawing.items:
        meaning = item.tag.partition(" ")[0]
        permitted = PENS_OF.get(meaning)
        if permitted is None or not isinstance(item, Stroke) or meaning in told:
            continue
        widths = {pens.width(pen) for pen in permitted}
        widths |= {pens.width(Pen.THIN)} if meaning in _ARROWS else set()
        width = drawing.pens.width(item.pen)
        if min(abs(width - one) for one in widths) > 0.01:
            told.add(meaning)
            facts = {"thing": f"stroke {item.pen.value} {item.tag}".rstrip()}
            yield Finding("PM-D22", item.points[0], width, max(widths), facts)


def heads_too_long(items: Iterable[Item]) -> Iterator[Finding]:
    """Find vectors whose arrowhead takes more than a third of them."""
    for shaft, head in pairwise(items):
        if not isinstance(shaft, Stroke) or not isinstance(head, Fill) or len(head.points) != 4:
            continue
        if shaft.tag != head.tag or shaft.tag.partition(" ")[0] not in _ARROWS:
            continue
        tip, left, _, right = head.points
        length, vector = abs(tip - (left + right) / 2), abs(tip - shaft.points[0])
        if length > HEAD_FRACTION * vector + 0.05:
            yield Finding("PM-D23", tip, length, HEAD_FRACTION * vector, {})


# Numbers ------------------------------------------------------------------------------------------


def numbers_in_two_formats(writings: Sequence[Writing]) -> Iterator[Finding]:
    """Find numbers with another decimal sign than most, with an ``e``, or that are not numbers."""
    read = [
        (writing, found)
        for writing in writings
        if STAMP not in writing.runs[0].tag.split()
        for found in _NUMBER.finditer("".join(run.text for run in writing.runs))
    ]
    signs = [found[2] for _, found in read if found[2]]
    usual = max(sorted(set(signs)), key=signs.count, default="")
    for writing, found in read:
        if found[3] or not found[1][-1].isdigit() or (found[2] and found[2] != usual):
            yield Finding("PM-D24", writing.place, 1.0, 0.0, {"shown": found[1], "sign": usual})
