"""Blocks of the force analysis: loads, links cut free, force plans, lever."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial

from planmethod.note.document import Equations, Formula, Paragraph
from planmethod.note.narrate.forces.common import ForceContext, balance_equation, lettered
from planmethod.note.narrate.forces.lever import LeverNarrator
from planmethod.note.narrate.forces.loads import LoadNarrator
from planmethod.note.narrate.forces.moments import MomentNarrator
from planmethod.note.narrate.forces.plan import ForcePlanNarrator
from planmethod.note.narrate.forces.resultants import shift_lines, unshifted_lines
from planmethod.note.narrate.forces.statement import (
    force_unknowns,
    link_names,
    plan_title,
    statement,
)
from planmethod.note.narrate.letters import direction_text
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.narrate.statement import unbroken
from planmethod.note.numbers import Notation
from planmethod.note.plaintext import plain_text
from planmethod.plans.forces.polygons import Component
from planmethod.plans.model import PlanKind
from planmethod.render.forces.cut import cut_picture, inner_picture, loads_picture
from planmethod.render.forces.ellipses import vertex_ellipses
from planmethod.render.forces.leverpicture import lever_picture
from planmethod.render.forces.polygon import (
    NO_ELLIPSES,
    START,
    drawn_edges,
    find_overlap_shifts,
    polygon_picture,
    start_place,
)
from planmethod.render.ink.drawing import Disc, Item, Span
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Row, heading
from planmethod.render.layout.nodes import TextNode, blocks_of
from planmethod.render.pictures.ellipses import describe_ellipses
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.texts import stated
from planmethod.render.sheets.views import named, shown_position
from planmethod.solved.forces.lever import LeverReading
from planmethod.solved.forces.reading import ForceReading, force_reading
from planmethod.solved.solution import Solution


def _reading(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> ForceReading:
    return force_reading(solution, shown_position(solution, position_indices, style))


# Views -------------------------------------------------------------------------------------------


class ForcePlanViewBlock(ViewBlock, frozen=True):
    """A force plan among the blocks of a sheet: the reactions are measured on it."""

    reading: ForceReading
    number: int
    notation: Notation

    def spans(self, items: Sequence[Item], corner: complex) -> Iterable[Span]:
        """Return the reactions of the plan."""
        reading = self.reading
        edges = drawn_edges(reading, self.number)
        starts = [item.centre for item in items if isinstance(item, Disc) and item.tag == START]
        shift = starts[0] - start_place(reading, self.number)
        known = {edge.symbol for edge in reading.plans[self.number].polygon}
        known -= {edge.symbol for edge in reading.plans[self.number].reactions}
        many = len(reading.solution.positions) > 1
        return (
            Span(
                plain_text(self.notation.symbol(edge.symbol)),
                reading.index if many else None,
                shift + beside + reading.corner(self.number, edge.tail),
                shift + beside + reading.corner(self.number, edge.head),
            )
            for edge, beside in zip(edges, find_overlap_shifts(reading, self.number), strict=True)
            if edge.symbol not in known
        )


def scheme_of(
    reading: ForceReading, picture: Block, title: str, style: BlockStyle, *said: str
) -> ViewBlock:
    """Return a picture at the scale of the position plan, with its title and notes."""
    solution, kind = reading.solution, PlanKind.POSITION
    scale, convention = solution.scales[kind], solution.problem.scales.convention
    told = [scale_inscription(scale, convention, style.language.notation), *said]
    return ViewBlock(named(picture, title, told, style), kind.value, scale)


def loads_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> ViewBlock:
    """Return the scheme with all loads."""
    reading = _reading(solution, position_indices, style)
    texts, picture = (
        style.language.sheets,
        loads_picture(reading, style.letter, style.language.notation),
    )
    return scheme_of(reading, picture, style.entry.title or texts.loads, style, texts.not_to_scale)


def cut_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> ViewBlock:
    """Return a structural group, or the driver, cut free with all forces on it."""
    reading, number = _reading(solution, position_indices, style), style.entry.number
    language = style.language
    title = plan_title(reading, reading.plans[number], language)
    picture: Block = cut_picture(reading, number, style.letter, language.notation)
    inner = inner_picture(reading, number, style.letter, language.notation)
    if inner is not None:
        link, apart_from = inner
        phrase = language.sheets.cut_link.format(link=link)
        below = Line(typeset(phrase, style.text(style.sizes.text)))
        beside = Column([apart_from, below], gap=3.0, align="centre")
        picture = Row([picture, beside], gap=10.0, align="centre")
    return scheme_of(reading, picture, title, style)


def plan_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return a force plan, or only its name if all its forces are zero."""
    return plan_of(_reading(solution, position_indices, style), style)


def plan_of(reading: ForceReading, style: BlockStyle) -> Block:
    """Return the force plan of a reading that a composition selects."""
    solution, number = reading.solution, style.entry.number
    links, language = reading.plans[number].links, style.language
    whose = language.sheets.plan_of_group if len(links) > 1 else language.sheets.plan_of_link
    title = whose.format(links=link_names(links))
    if not drawn_edges(reading, number):
        none = language.sheets.plan_none.format(title=title)
        return heading(none, style.text(style.sizes.text))
    scale = reading.plan_scale(number)
    said = [scale_inscription(scale, solution.problem.scales.convention, language.notation)]
    if any(find_overlap_shifts(reading, number)):
        said.append(language.sheets.apart)
    ellipses = vertex_ellipses(reading, number) if style.options.errors else NO_ELLIPSES
    said += (
        describe_ellipses([ellipses], solution.profile, language) if style.options.errors else []
    )
    picture = polygon_picture(reading, number, style.letter, language.notation, ellipses)
    block = named(picture, title, said, style)
    return ForcePlanViewBlock(block, "forces", scale, reading, number, language.notation)


def lever_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the Zhukovsky lever, or only its title if the driver is at rest."""
    reading = _reading(solution, position_indices, style)
    language = style.language
    title = style.entry.title or language.sheets.lever
    if reading.statics.lever_at(reading.index) is None:
        return heading(title, style.title)  # the text beside it gives the reason
    scale = LeverReading(reading).scale
    said = [
        language.sheets.lever_turned,
        scale_inscription(scale, solution.problem.scales.convention, language.notation),
    ]
    block = named(lever_picture(reading, style.letter, language.notation), title, said, style)
    return ViewBlock(block, PlanKind.VELOCITY.value, scale)


# Texts -------------------------------------------------------------------------------------------


def statement_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return "Дано" with masses and loads, "Определить", and the computed loads."""
    reading = _reading(solution, position_indices, style)
    language, texts = style.language, style.language.sheets
    loads = LoadNarrator(lettered(reading, language)).formulas()
    return stated(
        statement(reading, language),
        texts.wanted.format(wanted=force_unknowns(reading, language.notation)),
        style,
        *([texts.computed_loads.format(loads=unbroken(loads))] if loads else []),
        *shift_lines(reading.statics, language.note),
        *unshifted_lines(reading.statics, language.note),
    )


def equations_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the equations of a force plan: moments with arms, forces, results of the plan."""
    return equations_of(_reading(solution, position_indices, style), style)


def equations_of(reading: ForceReading, style: BlockStyle) -> Block:
    """Return the equations of the force plan of a reading that a composition selects."""
    number, context = style.entry.number, lettered(reading, style.language)
    plan, voice = reading.plans[number], MomentNarrator(context, reading.plans[number])
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)

    def moments(*, of_forces: bool) -> Iterator[Formula]:
        for one in plan.moments:
            if (one.force is not None) is of_forces:
                yield from map(Formula, voice.lines(one))

    directed = partial(direction_text, say=style.language.notation)
    balances = (balance_equation(balance, context, directed) for balance in plan.balances)
    nodes: list[TextNode] = [
        *moments(of_forces=True),
        Equations(tuple(balances)),
        Paragraph(_result_text(context, number)),
        *moments(of_forces=False),
        *map(Formula, voice.places()),
    ]
    return Column(list(blocks_of(nodes, height, width=width)), gap=3.0)


def _result_text(context: ForceContext, number: int) -> str:
    """Return the results of a force plan, or a note if all its forces are zero."""
    reading, texts = context.reading, context.language.sheets
    reactions = reading.plans[number].reactions
    if drawn_edges(reading, number):
        voice = ForcePlanNarrator(context, reading.plans[number], number)
        return texts.from_plan.format(
            found=unbroken([voice.force_text(edge) for edge in reactions])
        )
    wholes = (edge for edge in reactions if edge.component is Component.TOTAL)
    return texts.all_zero.format(zeros=" = ".join(context.symbol(edge.symbol) for edge in wholes))


def lever_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the equation of the lever, and its difference from the force plans."""
    reading = _reading(solution, position_indices, style)
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)
    told = [style.language.sheets.lever_stands]
    if reading.statics.lever_at(reading.index) is not None:
        told = LeverNarrator(lettered(reading, style.language)).lines()
    lines = blocks_of(map(Formula, told), height, width=width)
    title = [heading(style.entry.title, height, width=width)] if style.entry.title else []
    return Column([*title, *lines], gap=3.0)
