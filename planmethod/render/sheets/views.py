"""Views of a sheet (виды): a picture with its name and scale, and its measured segments."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from planmethod.construct.scale import Scale
from planmethod.note.narrate.formulas import knot_letter, view_name
from planmethod.note.narrate.letters import shown_letters
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.numbers import is_nothing
from planmethod.note.plaintext import plain_text
from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.render.ink.drawing import Arc, Disc, Item, Span
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Row, shaped
from planmethod.render.pictures.ellipses import ellipse_inscription
from planmethod.render.pictures.enlarged import ENLARGED
from planmethod.render.pictures.planview import (
    POLE,
    knot_pictures,
    plan_picture,
    plan_places,
    vector_label,
)
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.render.pictures.traces import Shown, shown_traces
from planmethod.render.sheets.composer import Viewed
from planmethod.render.sheets.model import Manner
from planmethod.solved.clearest import clearest_position
from planmethod.solved.enlarging import least_shown
from planmethod.solved.solution import Solution

POINT = 1e-6
"""Length on a plan, mm, below which a segment is a rounding error of a mechanism at rest."""

NO_VIEWS: Mapping[int, complex] = MappingProxyType({})

LARGER = (1.0, 1.5, 2.2)
"""Enlargements of a polar diagram where there is space."""


class PlanViewed(Viewed, frozen=True):
    """Plans of some positions, in the order in which they are drawn."""

    solution: Solution
    kind: PlanKind
    indices: tuple[int, ...]
    by_hand: bool = False

    def spans(self, items: Sequence[Item], corner: complex) -> Iterable[Span]:
        """Return the segments of the plans."""
        poles = [item.centre for item in items if isinstance(item, Disc) and item.tag == POLE]
        views = {
            int(item.tag.split()[1]): item.centre
            for item in items
            if isinstance(item, Arc) and item.tag.startswith(ENLARGED) and item.tag[-1].isdigit()
        }
        for pole, index in zip(poles, self.indices, strict=False):
            yield from plan_spans(
                self.solution, self.kind, index, pole, by_hand=self.by_hand, views=views
            )


def plan_spans(
    solution: Solution,
    kind: PlanKind,
    index: int,
    pole: complex,
    *,
    by_hand: bool = False,
    views: Mapping[int, complex] = NO_VIEWS,
) -> list[Span]:
    """Return the measured segments of a plan whose pole lies at ``pole`` on the sheet.

    A vector negligible against the plan is zero by nature and is not a segment. ``views`` are the
    middles of the enlarged views by the numbers of their knots: their segments are measured there.
    """
    plan = solution.construction.plan(kind)
    at = plan_places(solution, kind, index, by_hand=by_hand)
    sizes = [abs(at[vector.head] - at[vector.tail]) for vector in plan.vectors]
    letters = shown_letters(solution.problem, plan)
    position = index if len(solution.positions) > 1 else None
    named = {
        frozenset((vector.tail, vector.head)): vector
        for vector, size in zip(plan.vectors, sizes, strict=True)
        if size > POINT and not is_nothing(size, max(sizes))
    }
    knots = [knot for knot in solution.knots_of(kind, index) if knot.number in views]
    shown = {frozenset(pair): knot for knot in knots for pair in knot.ends}
    spans: list[Span] = []
    alone, least = len(solution.positions) == 1, least_shown(solution.profile.ruler)
    for ends, vector in named.items():
        knot = shown.get(ends)
        if alone and knot is None and abs(at[vector.head] - at[vector.tail]) < least:
            continue  # listed as zero
        times, middle = (1.0, pole) if knot is None else (knot.times, views[knot.number])
        start, end = (
            middle + (at[point] - (0j if knot is None else knot.centre)) * times
            for point in (vector.tail, vector.head)
        )
        share = solution.scales[kind].per_mm / solution.own_scale(kind, index).per_mm
        name = plain_text(letters[vector.tail][0] + letters[vector.head][0])
        label = "" if knot is not None else vector_label(f"{kind.value} {index}", vector)
        spans.append(Span(name, position, start, end, share * times, label))
    return spans


def scheme_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Viewed:
    """Return the scheme in one position; `sheets.several` makes that of several."""
    (index,) = indices
    picture = scheme_picture(
        solution,
        index,
        letter_height=manner.letter,
        errors=manner.extras.errors,
        traces=shown_traces(solution, manner.entry.traces, room=manner.extras.traces),
    )
    kind = PlanKind.POSITION
    block = with_scale(solution, kind, picture, manner, indices)
    return Viewed(block, kind.value, solution.scales[kind])


def plan_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return a plan with its enlarged views; `sheets.several` makes those of several positions.

    It is drawn with the readings of the ruler, so that a ruler finds the numbers of the
    calculation; with error ellipses, which are around the exact points, it is exact.
    """
    kind = manner.entry.of
    assert kind is not None
    ways = plan_with_knots(
        solution, kind, indices[0], manner.words,
        letter_height=manner.letter, errors=manner.extras.errors,
        traces=shown_traces(solution, manner.entry.traces, room=manner.extras.traces),
    )  # fmt: skip
    return plans_viewed(solution, ways, indices, manner)


def plans_viewed(
    solution: Solution, pictures: Sequence[Block], indices: Sequence[int], manner: Manner
) -> Block:
    """Return the plans of some positions, in several layouts, under their name."""
    kind = manner.entry.of
    assert kind is not None
    blocks = [with_scale(solution, kind, picture, manner, indices) for picture in pictures]
    scale, by_hand = solution.scales[kind], not manner.extras.errors
    return shaped(
        PlanViewed(block, kind.value, scale, solution, kind, tuple(indices), by_hand)
        for block in blocks
    )


def plan_with_knots(
    solution: Solution,
    kind: PlanKind,
    index: int,
    words: Language,
    *,
    letter_height: float,
    errors: bool = False,
    traces: Shown = False,
) -> list[Block]:
    """Return a plan with its enlarged views, in all layouts, the smallest first."""
    knots, by_hand = solution.knots_of(kind, index), not errors
    letters = tuple(knot_letter(knot, words) for knot in knots)
    picture = plan_picture(
        solution, kind, index, letter_height=letter_height, errors=errors, by_hand=by_hand,
        traces=traces, knots=letters,
    )  # fmt: skip
    if not knots:
        return [picture]
    pictures = knot_pictures(solution, kind, index, letter_height=letter_height, by_hand=by_hand)
    views = [
        Column([Line(typeset(view_name(knot, words), letter_height)), one], 2.5, "centre")
        for knot, one in zip(knots, pictures, strict=True)
    ]
    ways: list[Block] = []
    for step in range(1, len(views) + 1):
        found = range(0, len(views), step)
        rows = Column([Row(views[k : k + step], 8.0, "centre") for k in found], 6.0, "centre")
        ways.append(Row([picture, rows], 8.0, "centre"))
        ways.append(Column([picture, rows], 6.0, "centre"))
    return sorted(ways, key=lambda way: way.width * way.height)


def shown_position(solution: Solution, indices: Sequence[int], manner: Manner) -> int:
    """Return the representative position: the requested or calculated one, else the clearest."""
    for asked in (manner.entry.position, solution.problem.calculated):
        if asked is not None and asked in indices:
            return asked
    return indices[0] if len(indices) == 1 else clearest_position(solution, tuple(indices))


def with_scale(
    solution: Solution,
    kind: PlanKind,
    picture: Block,
    manner: Manner,
    drawn: Sequence[int],
    more: Sequence[str] = (),
) -> Column:
    """Return a picture of the ``drawn`` positions with its name and scale.

    ``more`` are lines under the scale.
    """
    words = manner.words
    one, many = words.sheets["views"][kind.value]
    title = manner.entry.title or (one if len(drawn) == 1 else many)
    said = []
    if solution.has_common(kind):
        said.append(
            scale_inscription(solution.scales[kind], solution.problem.scales.convention, words.say)
        )
    said += more
    if manner.extras.errors:
        of_scheme = kind is PlanKind.POSITION  # which has ellipses in one position only
        shown = (shown_position(solution, drawn, manner),) if of_scheme else drawn
        said += ellipse_inscription(solution, kind, shown, words)
    return named(picture, title, said, manner)


def at_scales(ways: Iterable[Viewed]) -> Block:
    """Return a view with layouts at several scales, the usual one first."""
    found: dict[Scale | None, Viewed] = {}
    for way in ways:
        found.setdefault(way.scale, way)
    return shaped(found.values(), grows=True)


def named(picture: Block, title: str, said: Iterable[str | Block], manner: Manner) -> Column:
    """Return a picture under its name and notes, mostly lines of text (GOST 2.316)."""
    height = manner.text(manner.sizes.text)
    lines: list[Block] = [Line(typeset(title, manner.title))]
    lines += [Line(typeset(one, height)) if isinstance(one, str) else one for one in said]
    return Column([Column(lines, gap=2.5, align="centre"), picture], gap=5.0, align="centre")
