"""Views of a sheet (виды): a picture with its name and scale, and its measured segments."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from planmethod.construct.scale import Scale
from planmethod.note.narrate.formulas import detail_view_letter, view_name
from planmethod.note.narrate.letters import plan_letters
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.numbers import is_negligible
from planmethod.note.plaintext import plain_text
from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.render.ink.drawing import Arc, Disc, Item, Span
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Row, make_alternatives
from planmethod.render.pictures.detail_views import ENLARGED
from planmethod.render.pictures.ellipses import ellipse_inscription
from planmethod.render.pictures.planview import (
    POLE,
    detail_pictures,
    plan_picture,
    plan_places,
    vector_label,
)
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.render.pictures.traces import Shown, shown_traces
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.solved.detail_views import min_enlarged
from planmethod.solved.representative_position import clearest_position
from planmethod.solved.solution import Solution

POINT = 1e-6
"""Length on a plan, mm, below which a segment is a rounding error of a mechanism at rest."""

NO_VIEWS: Mapping[int, complex] = MappingProxyType({})

LARGER = (1.0, 1.5, 2.2)
"""Enlargements of a polar diagram where there is space."""


class PlanViewBlock(ViewBlock, frozen=True):
    """Plans of some positions, in the order in which they are drawn."""

    solution: Solution
    kind: PlanKind
    position_indices: tuple[int, ...]
    use_ruler: bool = False

    def spans(self, items: Sequence[Item], corner: complex) -> Iterable[Span]:
        """Return the segments of the plans."""
        poles = [item.centre for item in items if isinstance(item, Disc) and item.tag == POLE]
        views = {
            int(item.tag.split()[1]): item.centre
            for item in items
            if isinstance(item, Arc) and item.tag.startswith(ENLARGED) and item.tag[-1].isdigit()
        }
        for pole, index in zip(poles, self.position_indices, strict=False):
            yield from plan_spans(
                self.solution, self.kind, index, pole, use_ruler=self.use_ruler, views=views
            )


def plan_spans(
    solution: Solution,
    kind: PlanKind,
    index: int,
    pole: complex,
    *,
    use_ruler: bool = False,
    views: Mapping[int, complex] = NO_VIEWS,
) -> list[Span]:
    """Return the measured segments of a plan whose pole lies at ``pole`` on the sheet.

    A vector negligible against the plan is zero by nature and is not a segment. ``views`` are the
    middles of the enlarged views by the numbers of their knots: their segments are measured there.
    """
    plan = solution.construction.plan(kind)
    at = plan_places(solution, kind, index, use_ruler=use_ruler)
    sizes = [abs(at[vector.head] - at[vector.tail]) for vector in plan.vectors]
    letters = plan_letters(solution.problem, plan)
    position = index if len(solution.positions) > 1 else None
    named = {
        frozenset((vector.tail, vector.head)): vector
        for vector, size in zip(plan.vectors, sizes, strict=True)
        if size > POINT and not is_negligible(size, max(sizes))
    }
    knots = [
        detail_view
        for detail_view in solution.detail_views_at(kind, index)
        if detail_view.number in views
    ]
    shown = {frozenset(pair): detail_view for detail_view in knots for pair in detail_view.ends}
    spans: list[Span] = []
    alone, least = len(solution.positions) == 1, min_enlarged(solution.profile.ruler)
    for ends, vector in named.items():
        knot = shown.get(ends)
        if alone and knot is None and abs(at[vector.head] - at[vector.tail]) < least:
            continue  # listed as zero
        times, middle = (1.0, pole) if knot is None else (knot.times, views[knot.number])
        start, end = (
            middle + (at[point] - (0j if knot is None else knot.centre)) * times
            for point in (vector.tail, vector.head)
        )
        share = solution.scales[kind].per_mm / solution.plan_scale(kind, index).per_mm
        name = plain_text(letters[vector.tail][0] + letters[vector.head][0])
        label = "" if knot is not None else vector_label(f"{kind.value} {index}", vector)
        spans.append(Span(name, position, start, end, share * times, label))
    return spans


def scheme_view(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> ViewBlock:
    """Return the scheme in one position; `sheets.several` makes that of several."""
    (index,) = position_indices
    picture = scheme_picture(
        solution,
        index,
        letter_height=style.letter,
        errors=style.options.errors,
        traces=shown_traces(solution, style.entry.traces, has_space=style.options.traces),
    )
    kind = PlanKind.POSITION
    block = with_scale(solution, kind, picture, style, position_indices)
    return ViewBlock(block, kind.value, solution.scales[kind])


def plan_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return a plan with its enlarged views; `sheets.several` makes those of several positions.

    It is drawn with the readings of the ruler, so that a ruler finds the numbers of the
    calculation; with error ellipses, which are around the exact points, it is exact.
    """
    kind = style.entry.of
    assert kind is not None
    ways = plan_with_details(
        solution, kind, position_indices[0], style.language,
        letter_height=style.letter, errors=style.options.errors,
        traces=shown_traces(solution, style.entry.traces, has_space=style.options.traces),
    )  # fmt: skip
    return plans_viewed(solution, ways, position_indices, style)


def plans_viewed(
    solution: Solution,
    pictures: Sequence[Block],
    position_indices: Sequence[int],
    style: BlockStyle,
) -> Block:
    """Return the plans of some positions, in several layouts, under their name."""
    kind = style.entry.of
    assert kind is not None
    blocks = [with_scale(solution, kind, picture, style, position_indices) for picture in pictures]
    scale, by_hand = solution.scales[kind], not style.options.errors
    return make_alternatives(
        PlanViewBlock(block, kind.value, scale, solution, kind, tuple(position_indices), by_hand)
        for block in blocks
    )


def plan_with_details(
    solution: Solution,
    kind: PlanKind,
    index: int,
    language: Language,
    *,
    letter_height: float,
    errors: bool = False,
    traces: Shown = False,
) -> list[Block]:
    """Return a plan with its enlarged views, in all layouts, the smallest first."""
    knots, by_hand = solution.detail_views_at(kind, index), not errors
    letters = tuple(detail_view_letter(detail_view, language) for detail_view in knots)
    picture = plan_picture(
        solution, kind, index, letter_height=letter_height, errors=errors, use_ruler=by_hand,
        traces=traces, detail_letters=letters,
    )  # fmt: skip
    if not knots:
        return [picture]
    pictures = detail_pictures(
        solution, kind, index, letter_height=letter_height, use_ruler=by_hand
    )
    views = [
        Column([Line(typeset(view_name(detail_view, language), letter_height)), one], 2.5, "centre")
        for detail_view, one in zip(knots, pictures, strict=True)
    ]
    ways: list[Block] = []
    for step in range(1, len(views) + 1):
        found = range(0, len(views), step)
        rows = Column([Row(views[k : k + step], 8.0, "centre") for k in found], 6.0, "centre")
        ways.append(Row([picture, rows], 8.0, "centre"))
        ways.append(Column([picture, rows], 6.0, "centre"))
    return sorted(ways, key=lambda way: way.width * way.height)


def shown_position(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> int:
    """Return the representative position: the requested or calculated one, else the clearest."""
    for asked in (style.entry.position, solution.problem.calculated):
        if asked is not None and asked in position_indices:
            return asked
    return (
        position_indices[0]
        if len(position_indices) == 1
        else clearest_position(solution, tuple(position_indices))
    )


def with_scale(
    solution: Solution,
    kind: PlanKind,
    picture: Block,
    style: BlockStyle,
    drawn: Sequence[int],
    more: Sequence[str] = (),
) -> Column:
    """Return a picture of the ``drawn`` positions with its name and scale.

    ``more`` are lines under the scale.
    """
    language = style.language
    one, many = language.sheets["views"][kind.value]
    title = style.entry.title or (one if len(drawn) == 1 else many)
    said = []
    if solution.has_common(kind):
        said.append(
            scale_inscription(
                solution.scales[kind], solution.problem.scales.convention, language.notation
            )
        )
    said += more
    if style.options.errors:
        of_scheme = kind is PlanKind.POSITION  # which has ellipses in one position only
        shown = (shown_position(solution, drawn, style),) if of_scheme else drawn
        said += ellipse_inscription(solution, kind, shown, language)
    return named(picture, title, said, style)


def at_scales(views: Iterable[ViewBlock]) -> Block:
    """Return a view with layouts at several scales, the usual one first."""
    found: dict[Scale | None, ViewBlock] = {}
    for way in views:
        found.setdefault(way.scale, way)
    return make_alternatives(found.values(), grows=True)


def named(picture: Block, title: str, notes: Iterable[str | Block], style: BlockStyle) -> Column:
    """Return a picture under its name and notes, mostly lines of text (GOST 2.316)."""
    height = style.text(style.sizes.text)
    lines: list[Block] = [Line(typeset(title, style.title))]
    lines += [Line(typeset(one, height)) if isinstance(one, str) else one for one in notes]
    return Column([Column(lines, gap=2.5, align="centre"), picture], gap=5.0, align="centre")
