"""Blocks of the balancing sheet: scheme, polygons, hodographs, tables (лист уравновешивания)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from planmethod.construct.scale import Scale, choose_scale
from planmethod.construct.steps import PointName
from planmethod.errors import LayoutError
from planmethod.note.document import Caption, Paragraph
from planmethod.note.narrate.balancing import COUNT, BalancingNarrator
from planmethod.note.narrate.forces.statement import mass_lines
from planmethod.note.narrate.naming import scale_inscription
from planmethod.note.narrate.statement import given_facts
from planmethod.paper import STAMP_WIDTH
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Convention
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.layout.block import Block, Column, Row
from planmethod.render.layout.text_blocks import (
    TableColumn,
    TableForm,
    TextNode,
    blocks_of,
    table_block,
)
from planmethod.render.pictures.diagram import polar_picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.planview import PictureStyle
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.views import named, stated
from planmethod.render.symbols import vector_arrow
from planmethod.solved.solution import Solution

_WEIGHT = 2.4  # mm: radius of a counterweight
_SPACING = 4.0  # mm: between collinear vectors of a polygon


def _make_narrator(solution: Solution, style: BlockStyle) -> BalancingNarrator:
    if solution.problem.balancing is None:
        raise LayoutError(
            "{}: a layout with balancing needs [balancing] in the problem file. For "
            'example: [balancing] method = "full".',
            solution.problem.name,
        )
    return BalancingNarrator(solution, style.language)


def balancing_text(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the given data, the masses, the counterweights and the forces with numbers."""
    narrator = _make_narrator(solution, style)
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)
    assert solution.problem.dynamics is not None
    facts = given_facts(solution.problem, style.language)
    facts += mass_lines(solution.problem, style.language)
    nodes: list[TextNode] = [
        Caption(style.entry.title or narrator.texts.balancing),
        *map(Paragraph, narrator.lines()),
    ]
    before = stated(facts, narrator.texts.balancing_wanted, style)
    return Column([before, *blocks_of(nodes, height, width=width)], gap=3.0)


def scheme_view(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> ViewBlock:
    """Return the scheme with its counterweights, all to scale."""
    narrator = _make_narrator(solution, style)
    index = position_indices[0]
    items: list[Item] = []
    labels = []
    for one in narrator.balancing.counterweights:
        if not one.mass:
            continue
        pivot, pin = (
            complex(solution.paper.point(PointName(point))[index]) for point in (one.pivot, one.pin)
        )
        place = pivot + one.place * (pin - pivot)
        items.append(Stroke((pivot, place), Pen.MAIN, tag=f"counterweight {one.link}"))
        items.append(Disc(place, _WEIGHT, Ink.BLACK, f"counterweight {one.link}"))
        labels.append(
            Label(
                typeset(f"m'_{{{one.link}}}", style.letter),
                place,
                prefer=place - pivot,
                gap=_WEIGHT + 1.2,
                name=f"counterweight {one.link}",
            )
        )
    scale = solution.scales[PlanKind.POSITION]
    told = [scale_inscription(scale, solution.problem.scales.convention, narrator.notation)]
    title = style.entry.title or narrator.texts.with_weights
    picture = scheme_picture(
        solution, index, PictureStyle(style.letter), driver_only=True,
        added=(tuple(items), tuple(labels)),
    )  # fmt: skip
    return ViewBlock(named(picture, title, told, style), "scheme", scale)


def polygon_views(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the polygons of m·r; collinear vectors are drawn below one another."""
    narrator = _make_narrator(solution, style)
    views: list[Block] = []
    for number, one in enumerate(narrator.balancing.counterweights):
        if not one.mass:
            continue
        made, per_mm, exact, _ = narrator.balancing.polygon(number, narrator.profile)
        corners = [complex(exact.point(name)[0]) for name in made.corners]
        straight = max(abs(z.imag) for z in corners) < _SPACING
        letters = [name for name, _ in one.terms] + [f"m'_{{{one.link}}} r"]
        items: list[Item] = []
        labels: list[Label] = []
        for k, (tail, head) in enumerate(zip(corners, [*corners[1:], corners[0]], strict=True)):
            shift = -2j * _SPACING * k if straight else 0j
            start, end = tail + shift, head + shift
            if straight and k:
                up = 2j * _SPACING
                items.append(Stroke((start + up, start), Pen.THIN, tag="polygon corner"))
            way = (end - start) / abs(end - start)
            items += vector_arrow(start, end, tag="polygon vector")
            labels.append(
                Label(
                    typeset(letters[k], style.letter),
                    (start + end) / 2.0,
                    segment=(start, end),
                    prefer=1j * way if way.real >= 0 else -1j * way,
                    gap=1.0,
                    name=f"polygon {one.link}: {k}",
                )
            )
        scale = Scale("mu_mr", per_mm, "kg·m")
        told = [scale_inscription(scale, Convention.UNIT_PER_MM, narrator.notation)]
        title = narrator.texts.polygon_of.format(link=one.link)
        views.append(
            ViewBlock(named(lettered(items, labels), title, told, style), "diagram", scale)
        )
    return Row(views, gap=16.0, align="bottom")


def hodograph_views(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the main vector of inertia before and after, in one scale."""
    narrator = _make_narrator(solution, style)
    curves = [np.append(curve, curve[0]) for curve in narrator.balancing.forces(360)]
    alone = narrator.balancing.largest[1] < 1e-6 * narrator.balancing.largest[0]
    side = (1.1 if alone else 0.68) * style.width(style.sizes.column)
    size = max(float(np.ptp(np.append(part, 0.0))) for c in curves for part in (c.real, c.imag))
    per_mm = choose_scale((size, 0.0), (side, 1.0))
    scale = Scale("mu_F", per_mm, "N")
    told = [scale_inscription(scale, Convention.UNIT_PER_MM, narrator.notation)]
    views: list[Block] = []
    ends = narrator.balancing.forces(COUNT)
    titles = (narrator.texts.before, narrator.texts.after)
    for title, curve, points in zip(titles, curves, ends, strict=True):
        if float(np.max(np.abs(curve))) < 1e-6 * size:
            continue  # fully balanced, as the text states
        name = f"force {len(views)}"
        drawn = np.asarray(curve / per_mm, dtype=complex)
        picture = polar_picture([drawn], np.asarray(points / per_mm), style.letter, name, "O")
        views.append(ViewBlock(named(picture, title, told, style), "hodograph", scale))
    return Row(views, gap=16.0, align="bottom")


def tables(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the counterweights, and the main vector by positions."""
    narrator = _make_narrator(solution, style)
    height = style.text(min(style.sizes.text, 3.5))
    made = []
    wholes = (
        (narrator.texts.weights_table, 1, [("№", *column[1:]) if not k else column
                                      for k, column in enumerate(narrator.weights())]),
        (narrator.texts.forces_table, 2, narrator.columns()),
    )  # fmt: skip
    for title, lead, columns in wholes:
        cells = [
            TableColumn(
                head,
                tuple(told),
                unit=narrator.notation.in_head(unit) if unit else "",
                min_width=9.0,
            )
            for head, unit, told in columns
        ]
        made.append(
            table_block(
                cells,
                TableForm(height, leading=lead, row_height=2.0 * height),
                width=STAMP_WIDTH,
                title=title,
            )
        )
    return Column(made, gap=6.0)
