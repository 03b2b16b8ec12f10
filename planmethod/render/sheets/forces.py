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
from planmethod.note.narrate.forces.resultants import kept_lines, shift_lines
from planmethod.note.narrate.forces.statement import link_names, plan_title, statement, wanted
from planmethod.note.narrate.given import unbroken
from planmethod.note.narrate.letters import direction_text
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.numbers import Notation
from planmethod.note.plaintext import plain_text
from planmethod.plans.forces.polygons import Share
from planmethod.plans.model import PlanKind
from planmethod.render.forces.cut import cut_picture, inner_picture, loads_picture
from planmethod.render.forces.ellipses import vertex_ellipses
from planmethod.render.forces.leverpicture import lever_picture
from planmethod.render.forces.polygon import (
    NO_ELLIPSES,
    START,
    apart,
    drawn_edges,
    polygon_picture,
    start_place,
)
from planmethod.render.ink.drawing import Disc, Item, Span
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Row, heading
from planmethod.render.layout.nodes import TextNode, blocks_of
from planmethod.render.pictures.ellipses import told_ellipses
from planmethod.render.sheets.composer import Viewed
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.texts import stated
from planmethod.render.sheets.views import named, shown_position
from planmethod.solved.forces.lever import LeverReading
from planmethod.solved.forces.reading import ForceReading, force_reading
from planmethod.solved.solution import Solution


def _reading(solution: Solution, indices: Sequence[int], manner: Manner) -> ForceReading:
    return force_reading(solution, shown_position(solution, indices, manner))


# Views -------------------------------------------------------------------------------------------


class ForcePlanViewed(Viewed, frozen=True):
    """A force plan among the blocks of a sheet: the reactions are measured on it."""

    reading: ForceReading
    number: int
    say: Notation

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
                plain_text(self.say.symbol(edge.symbol)),
                reading.index if many else None,
                shift + beside + reading.corner(self.number, edge.tail),
                shift + beside + reading.corner(self.number, edge.head),
            )
            for edge, beside in zip(edges, apart(reading, self.number), strict=True)
            if edge.symbol not in known
        )


def scheme_of(
    reading: ForceReading, picture: Block, title: str, manner: Manner, *said: str
) -> Viewed:
    """Return a picture at the scale of the position plan, with its title and notes."""
    solution, kind = reading.solution, PlanKind.POSITION
    scale, convention = solution.scales[kind], solution.problem.scales.convention
    told = [scale_inscription(scale, convention, manner.words.say), *said]
    return Viewed(named(picture, title, told, manner), kind.value, scale)


def loads_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Viewed:
    """Return the scheme with all loads."""
    reading = _reading(solution, indices, manner)
    said, picture = manner.words.sheets, loads_picture(reading, manner.letter, manner.words.say)
    return scheme_of(reading, picture, manner.entry.title or said.loads, manner, said.not_to_scale)


def cut_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Viewed:
    """Return a structural group, or the driver, cut free with all forces on it."""
    reading, number = _reading(solution, indices, manner), manner.entry.number
    words = manner.words
    title = plan_title(reading, reading.plans[number], words)
    picture: Block = cut_picture(reading, number, manner.letter, words.say)
    inner = inner_picture(reading, number, manner.letter, words.say)
    if inner is not None:
        link, apart_from = inner
        said = words.sheets.cut_link.format(link=link)
        below = Line(typeset(said, manner.text(manner.sizes.text)))
        beside = Column([apart_from, below], gap=3.0, align="centre")
        picture = Row([picture, beside], gap=10.0, align="centre")
    return scheme_of(reading, picture, title, manner)


def plan_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return a force plan, or only its name if all its forces are zero."""
    return plan_of(_reading(solution, indices, manner), manner)


def plan_of(reading: ForceReading, manner: Manner) -> Block:
    """Return the force plan of a reading that a composition selects."""
    solution, number = reading.solution, manner.entry.number
    links, words = reading.plans[number].links, manner.words
    whose = words.sheets.plan_of_group if len(links) > 1 else words.sheets.plan_of_link
    title = whose.format(links=link_names(links))
    if not drawn_edges(reading, number):
        none = words.sheets.plan_none.format(title=title)
        return heading(none, manner.text(manner.sizes.text))
    scale = reading.own_scale(number)
    said = [scale_inscription(scale, solution.problem.scales.convention, words.say)]
    if any(apart(reading, number)):
        said.append(words.sheets.apart)
    ellipses = vertex_ellipses(reading, number) if manner.extras.errors else NO_ELLIPSES
    said += told_ellipses([ellipses], solution.profile, words) if manner.extras.errors else []
    picture = polygon_picture(reading, number, manner.letter, words.say, ellipses)
    block = named(picture, title, said, manner)
    return ForcePlanViewed(block, "forces", scale, reading, number, words.say)


def lever_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the Zhukovsky lever, or only its title if the driver is at rest."""
    reading = _reading(solution, indices, manner)
    words = manner.words
    title = manner.entry.title or words.sheets.lever
    if reading.statics.lever_at(reading.index) is None:
        return heading(title, manner.title)  # the text beside it gives the reason
    scale = LeverReading(reading).scale
    said = [
        words.sheets.lever_turned,
        scale_inscription(scale, solution.problem.scales.convention, words.say),
    ]
    block = named(lever_picture(reading, manner.letter, words.say), title, said, manner)
    return Viewed(block, PlanKind.VELOCITY.value, scale)


# Texts -------------------------------------------------------------------------------------------


def statement_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return "Дано" with masses and loads, "Определить", and the computed loads."""
    reading = _reading(solution, indices, manner)
    words, said = manner.words, manner.words.sheets
    loads = LoadNarrator(lettered(reading, words)).formulas()
    return stated(
        statement(reading, words),
        said.wanted.format(wanted=wanted(reading, words.say)),
        manner,
        *([said.computed_loads.format(loads=unbroken(loads))] if loads else []),
        *shift_lines(reading.statics, words.note),
        *kept_lines(reading.statics, words.note),
    )


def equations_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the equations of a force plan: moments with arms, forces, results of the plan."""
    return equations_of(_reading(solution, indices, manner), manner)


def equations_of(reading: ForceReading, manner: Manner) -> Block:
    """Return the equations of the force plan of a reading that a composition selects."""
    number, context = manner.entry.number, lettered(reading, manner.words)
    plan, voice = reading.plans[number], MomentNarrator(context, reading.plans[number])
    height, width = manner.text(manner.sizes.text), manner.width(manner.sizes.column)

    def moments(*, of_forces: bool) -> Iterator[Formula]:
        for one in plan.moments:
            if (one.force is not None) is of_forces:
                yield from map(Formula, voice.lines(one))

    directed = partial(direction_text, say=manner.words.say)
    balances = (balance_equation(balance, context, directed) for balance in plan.balances)
    nodes: list[TextNode] = [
        *moments(of_forces=True),
        Equations(tuple(balances)),
        Paragraph(_closing(context, number)),
        *moments(of_forces=False),
        *map(Formula, voice.places()),
    ]
    return Column(list(blocks_of(nodes, height, width=width)), gap=3.0)


def _closing(context: ForceContext, number: int) -> str:
    """Return the results of a force plan, or a note if all its forces are zero."""
    reading, said = context.reading, context.language.sheets
    reactions = reading.plans[number].reactions
    if drawn_edges(reading, number):
        voice = ForcePlanNarrator(context, reading.plans[number], number)
        return said.from_plan.format(found=unbroken([voice.closing(edge) for edge in reactions]))
    wholes = (edge for edge in reactions if edge.share is Share.WHOLE)
    return said.all_zero.format(zeros=" = ".join(context.symbol(edge.symbol) for edge in wholes))


def lever_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the equation of the lever, and its difference from the force plans."""
    reading = _reading(solution, indices, manner)
    height, width = manner.text(manner.sizes.text), manner.width(manner.sizes.column)
    told = [manner.words.sheets.lever_stands]
    if reading.statics.lever_at(reading.index) is not None:
        told = LeverNarrator(lettered(reading, manner.words)).lines()
    lines = blocks_of(map(Formula, told), height, width=width)
    title = [heading(manner.entry.title, height, width=width)] if manner.entry.title else []
    return Column([*title, *lines], gap=3.0)
