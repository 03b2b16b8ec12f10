"""Blocks of the force analysis: loads, links cut free, force plans, lever, reactions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial

from planmethod.errors import LayoutError
from planmethod.note.compared import DASH, Series, as_long, percent_text, sense_of, sigma_text
from planmethod.note.document import Caption, Equations, Formula, Paragraph, plain_text
from planmethod.note.narrate.forces.lever import LeverNarrator
from planmethod.note.narrate.forces.loads import (
    ForceContext,
    FrictionNarrator,
    LoadNarrator,
    balance_equation,
    headed,
    lettered,
    shift_lines,
    unshifted_lines,
)
from planmethod.note.narrate.forces.moments import MomentNarrator, number_equations
from planmethod.note.narrate.forces.plan import ForcePlanNarrator
from planmethod.note.narrate.forces.springs import SpringNarrator
from planmethod.note.narrate.forces.statement import (
    force_unknowns,
    link_names,
    plan_title,
    statement,
)
from planmethod.note.narrate.naming import direction_text, point_name, scale_inscription
from planmethod.note.narrate.statement import unbroken
from planmethod.note.numbers import Notation, format_column
from planmethod.note.series import (
    angle_series,
    balance_series,
    lever_beside_plans,
    lever_series,
    moment_series,
    size_series,
)
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import Component, reaction_symbol
from planmethod.plans.model import PlanKind
from planmethod.render.forces.cut import cut_picture, inner_picture, link_picture, loads_picture
from planmethod.render.forces.friction import friction_picture, is_enlarged
from planmethod.render.forces.polygon import (
    LINK_START,
    NO_ELLIPSES,
    START,
    drawn_edges,
    find_overlap_shifts,
    lever_picture,
    link_edges,
    link_polygon_picture,
    overlap_shifts,
    polygon_picture,
    start_place,
    vertex_ellipses,
)
from planmethod.render.frame import STAMP_WIDTH
from planmethod.render.ink.drawing import Disc, Item, Span
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Row, heading
from planmethod.render.layout.groups import GAP
from planmethod.render.layout.text_blocks import (
    TableCell,
    TableColumn,
    TableForm,
    TextNode,
    blocks_of,
    table_block,
)
from planmethod.render.pictures.planview import describe_ellipses
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import table_width, with_note
from planmethod.render.sheets.views import named, shown_position, stated
from planmethod.render.symbols import angle_of
from planmethod.solved.forces.friction import RubbedReading, rubbed_reading
from planmethod.solved.forces.reading import (
    NEGLIGIBLE_FRACTION,
    ForceReading,
    Guided,
    LeverReading,
    force_reading,
    guides,
    require_dynamics,
)
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


class LinkPlanViewBlock(ViewBlock, frozen=True):
    """The force plan of one link among the blocks of a sheet: its inner reaction is measured."""

    reading: ForceReading
    number: int
    notation: Notation
    link: str

    def spans(self, items: Sequence[Item], corner: complex) -> Iterable[Span]:
        """Return the reaction that closes the plan."""
        reading, edges = self.reading, link_edges(self.reading, self.number, self.link)
        starts = [i.centre for i in items if isinstance(i, Disc) and i.tag == LINK_START]
        shift = starts[0] - reading.corner(self.number, edges[0].tail)
        index = reading.index if len(reading.solution.positions) > 1 else None
        beside = overlap_shifts(reading, self.number, edges)[-1]
        tail, head = (shift + beside + reading.corner(self.number, end) for end in edges[-1].ends)
        yield Span(plain_text(self.notation.symbol(edges[-1].symbol)), index, tail, head)


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


def _single_links(reading: ForceReading, number: int) -> list[str]:
    """Return the links of a group whose forces balance alone: there an inner reaction is found."""
    plan = reading.plans[number]
    links = [one.links[0] for one in plan.balances if len(one.links) == 1 < len(plan.links)]
    return [link for link in links if link_edges(reading, number, link)]


def link_cut_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return single links of a group with the reactions of their inner joints."""
    reading, number = _reading(solution, position_indices, style), style.entry.number
    language = style.language
    inner = inner_picture(reading, number, style.letter, language.notation)
    shown = "" if inner is None else inner[0]  # beside its group
    views = [
        scheme_of(
            reading,
            link_picture(reading, number, link, style.letter, language.notation),
            language.sheets.cut_link.format(link=link),
            style,
        )
        for link in _single_links(reading, number)
        if link != shown
    ]
    return _in_a_row(views)


def _in_a_row(views: Sequence[Block]) -> Block:
    """Return views beside each other; a single view stays a view, with its measured segments."""
    return views[0] if len(views) == 1 else Row(list(views), gap=GAP)


def link_plan_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the force plans of single links of a group, which find its inner reactions."""
    reading, number = _reading(solution, position_indices, style), style.entry.number
    language, scale = style.language, reading.plan_scale(style.entry.number)
    said = [scale_inscription(scale, solution.problem.scales.convention, language.notation)]
    views = []
    for link in _single_links(reading, number):
        picture = link_polygon_picture(reading, number, link, style.letter, language.notation)
        title = language.sheets.plan_of_link.format(links=link)
        apart = any(overlap_shifts(reading, number, link_edges(reading, number, link)))
        more = [language.sheets.apart] if apart else []
        block = named(picture, title, [*said, *more], style)
        views.append(
            LinkPlanViewBlock(block, "forces", scale, reading, number, language.notation, link)
        )
    return _in_a_row(views)


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
    springs = SpringNarrator(solution.problem, language).equations(solution, reading.index)
    return stated(
        statement(reading, language),
        texts.wanted.format(wanted=force_unknowns(reading, language.notation)),
        style,
        *(["\n".join([texts.computed_loads, *map(unbroken, loads)])] if loads else []),
        *([language.springs.computed.format(forces=unbroken(springs))] if springs else []),
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

    directed = partial(direction_text, notation=style.language.notation)
    balances = (balance_equation(balance, context, directed) for balance in plan.balances)
    number_equations(context)
    sums, of_forces = [Equations(tuple(balances))], moments(of_forces=True)
    numbered = bool(context.numbers)
    nodes: list[TextNode] = [
        *(sums if numbered else of_forces),
        *(of_forces if numbered else sums),
        *_results(context, number),
        *moments(of_forces=False),
        *map(Formula, voice.places()),
    ]
    return Column(list(blocks_of(nodes, height, width=width)), gap=3.0)


def _results(context: ForceContext, number: int) -> list[TextNode]:
    """Return the results of a force plan, one a line, or a note if all its forces are zero."""
    reading, texts = context.reading, context.language.sheets
    reactions = reading.plans[number].reactions
    if drawn_edges(reading, number):
        voice = ForcePlanNarrator(context, reading.plans[number], number)
        return [
            Paragraph(texts.from_plan),
            *(Formula(voice.force_text(edge)) for edge in reactions),
        ]
    wholes = (edge for edge in reactions if edge.component is Component.TOTAL)
    zeros = " = ".join(context.symbol(edge.symbol) for edge in wholes)
    return [Paragraph(texts.all_zero.format(zeros=zeros))]


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


def _friction_reading(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> RubbedReading:
    require_dynamics(solution.problem)
    assert solution.problem.dynamics is not None
    if solution.problem.dynamics.friction is None:
        raise LayoutError(
            "{}: a layout with friction needs [friction] in the problem file. For example: "
            "[friction] f = 0.1, f_pin = 0.1, radius = 0.01.",
            solution.problem.name,
        )
    return rubbed_reading(solution, shown_position(solution, position_indices, style))


def _make_narrator(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> FrictionNarrator:
    index = _friction_reading(solution, position_indices, style).index
    return FrictionNarrator(lettered(force_reading(solution, index), style.language), sizes=True)


def friction_text(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the coefficients, circles and angles with their formulas, and the results."""
    narrator = _make_narrator(solution, position_indices, style)
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)
    nodes: list[TextNode] = [
        Caption(style.entry.title or narrator.texts.title),
        *map(Paragraph, narrator.given_lines()),
        *(
            Paragraph(f"{narrator.reach(pair)}; {narrator.size(pair)}")
            for pair in narrator.friction.pairs
        ),
        *narrator.nodes(),
    ]
    return Column(list(blocks_of(nodes, height, width=width)), gap=3.0)


def friction_cut_view(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return a group cut free with the reactions that friction inclines."""
    reading, number = _friction_reading(solution, position_indices, style), style.entry.number
    picture = friction_picture(reading, number, style.letter, style.language.notation)
    title = plan_title(reading, reading.plans[number], style.language)
    said = [style.language.friction.enlarged] if is_enlarged(reading) else []
    return scheme_of(reading, picture, title, style, *said)


def friction_plan_view(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return a force plan with one correction for friction."""
    return plan_of(_friction_reading(solution, position_indices, style), style)


def friction_equations_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the equations of a force plan with one correction for friction."""
    return equations_of(_friction_reading(solution, position_indices, style), style)


def friction_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the reactions without friction, corrected, and converged."""
    narrator = _make_narrator(solution, position_indices, style)
    columns = [TableColumn(headed(head), tuple(cells)) for head, *cells in narrator.columns()]
    width, title = table_width(style, STAMP_WIDTH), style.entry.title or narrator.texts.sheet_table
    return table_block(
        columns, TableForm(style.text(style.sizes.text), units="none"), width=width, title=title
    )


_DASH = "—"


def angle_text(force: complex, notation: Notation) -> str:
    """Return the angle of a force from +x, degrees in [0, 360)."""
    return notation.number(f"{round(angle_of(force), 1) % 360.0 + 0.0:.1f}")


def place_columns(reading: ForceReading, notation: Notation) -> list[TableColumn]:
    """Return the distance l of each reaction from its joint, m, and moments without a force.

    There are cells for all reactions in their order; empty columns are left out.
    """
    numbers = range(len(reading.statics.reactions))
    found = [guided_at(reading, number) for number in numbers]
    columns = []
    if any(one is not None and one.b is not None for one in found):
        columns.append(
            TableColumn(
                f"l_{{ij}}, {notation.units['m']}", tuple(_distance(one, notation) for one in found)
            )
        )
    if any(is_couple(one) for one in found):
        columns.append(
            TableColumn(
                f"M_{{ij}}, {notation.units['N·m']}", tuple(_moment(one, notation) for one in found)
            )
        )
    return columns


def guided_at(reading: ForceReading, number: int) -> Guided | None:
    """Return the reaction of a guide; None of a hinge."""
    joint = reading.statics.reactions[number]
    called = reading.solution.problem.mechanism.called
    one = guides(reading).get(reaction_symbol(joint.on, called(joint.by)))
    return one if one is not None and one.number == number else None


def _distance(one: Guided | None, notation: Notation) -> str:
    if one is None or one.b is None:
        return _DASH
    return notation.computed(abs(one.b)) if one.b else "0"


def is_couple(one: Guided | None) -> bool:
    """Return whether a guide has a moment and no force."""
    return one is not None and one.is_negligible and not one.is_no_couple


def _moment(one: Guided | None, notation: Notation) -> TableCell:
    if one is None or not is_couple(one):
        return TableCell(_DASH)
    moment = float(one.contact.joint.moment[one.reading.index])
    return TableCell(notation.computed(abs(moment)), 1 if moment > 0 else -1)


def edges_table(
    reading: ForceReading, height: float, width: float, language: Language
) -> Block | None:
    """Return the table of the reactions at the edges of sliders; None where there are none."""
    found = [guided_at(reading, number) for number in reading.statics.contacts]
    bearing = [one for one in found if one is not None and one.edges]
    if not bearing:
        return None
    called = reading.solution.problem.mechanism.called
    pairs = tuple(
        f"{point_name(one.contact.joint.joint)} ({one.on}–{called(one.by)})" for one in bearing
    )
    texts, notation = language.sheets, language.notation
    lengths = tuple(notation.short(one.contact.length or 0.0) for one in bearing)
    columns = [
        TableColumn(texts.joint, pairs),
        TableColumn(f"a_{{ij}}, {notation.units['m']}", lengths),
    ]
    for number, primes in enumerate(("'", "''")):
        columns += _edge_columns(primes, [one.edges[number].force for one in bearing], notation)
    return table_block(
        columns, TableForm(height, units="none"), width=width, title=texts.reactions_edges
    )


def _edge_columns(primes: str, forces: Sequence[complex], notation: Notation) -> list[TableColumn]:
    sizes = tuple(map(notation.number, format_column([abs(force) for force in forces])))
    return [
        TableColumn(f"F^{{{primes}}}_{{ij}}, {notation.units['N']}", sizes),
        TableColumn(
            f"φ^{{{primes}}}_{{ij}}, {notation.in_head('deg')}",
            tuple(angle_text(force, notation) for force in forces),
        ),
    ]


def reactions_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the table of reactions, and the balancing moment by both methods."""
    reading = force_reading(solution, shown_position(solution, position_indices, style))
    height = style.text(style.sizes.text)
    width = table_width(style, STAMP_WIDTH)
    sigma, language = bool(style.options.sigma), style.language
    columns = reaction_columns(reading, language, sigma=sigma)
    texts = language.sheets
    title = style.entry.title or (texts.reactions if sigma else texts.reactions_exact)
    table = table_block(columns, TableForm(height, units="none"), width=width, title=title)
    edges = edges_table(reading, height, width, language)
    further = [] if edges is None else [edges]
    balances = balance_columns(reading, language, sigma=sigma)
    below = table_block(balances, TableForm(height, units="none"), width=width)
    tables = Column([table, *further, below], gap=4.0)
    if not sigma:
        return tables
    return with_note(tables, [*columns, *balances], height, solution.profile.name, language)


def reaction_columns(
    reading: ForceReading, language: Language, *, sigma: bool
) -> list[TableColumn]:
    """Return the columns of the reactions; sizes have no fewer decimals than their errors."""
    statics, index, notation = reading.statics, reading.index, language.notation
    reactions, called = statics.reactions, reading.solution.problem.mechanism.called
    every = [size_series(statics, one) for one in reactions]
    forces = [complex(one.force[index]) for one in reactions]
    none = [abs(force) <= NEGLIGIBLE_FRACTION * reading.peak for force in forces]
    shown = format_column(
        [0.0 if nil else abs(force) for force, nil in zip(forces, none, strict=True)]
    )
    errors = partial(sigma_column, index=index, notation=notation)
    places, more = place_columns(reading, notation), list[TableColumn]()
    if sigma:
        shown = [
            as_long(text, abs(force), one.error(index)[0])
            for text, force, one in zip(shown, forces, every, strict=True)
        ]
        read = tuple(notation.number(one[index].rounded_text) for one in every)
        more = [
            TableColumn(f"{language.sheets.read}, {notation.units['N']}", read),
            errors(every, "N"),
        ]
    pairs = list(zip(reactions, forces, none, strict=True))
    columns = [
        TableColumn(
            language.sheets.joint,
            tuple(f"{point_name(one.joint)} ({one.on}–{called(one.by)})" for one in reactions),
        ),
        TableColumn("F_{ij}", tuple(reaction_symbol(one.on, called(one.by)) for one in reactions)),
        TableColumn(f"F_{{ij}}, {notation.units['N']}", tuple(map(notation.number, shown))),
        *more,
        TableColumn(
            f"φ_{{ij}}, {notation.in_head('deg')}",
            tuple(DASH if nil else angle_text(force, notation) for _, force, nil in pairs),
        ),
    ]
    if not sigma:
        return [*columns, *places]
    angles = [None if nil else angle_series(statics, one) for one, _, nil in pairs]
    columns += [errors(angles, "deg"), *places]
    if any(column.head.startswith("M_") for column in places):
        columns.append(errors([_couple(reading, k) for k in range(len(reactions))], "N·m"))
    return columns


def _couple(reading: ForceReading, number: int) -> Series | None:
    """Return the moment of a reaction that has no force; None of others, which have no cell."""
    if not is_couple(guided_at(reading, number)):
        return None
    return moment_series(reading.statics, reading.statics.reactions[number])


def sigma_column(
    every: Sequence[Series | None], unit: str, *, index: int, notation: Notation
) -> TableColumn:
    """Return the column of one sigma of each quantity in a position; a dash for none."""
    cells = tuple(DASH if one is None else one[index].sigma_text for one in every)
    return TableColumn(f"±σ, {notation.in_head(unit)}", tuple(map(notation.number, cells)))


def balance_columns(reading: ForceReading, language: Language, *, sigma: bool) -> list[TableColumn]:
    """Return the driver's balancing force or moment: exact, by both methods, their difference.

    Those of other driving links follow, exact and by the force plans: the lever has them given.
    With ``sigma`` they have a row of errors; that of the difference is in per cent of the force
    plans, too, and numbers that were read end with the place of their error.
    """
    texts, notation, index = language.sheets, language.notation, reading.index
    plans, lever, both = (
        make(reading.statics) for make in (balance_series, lever_series, lever_beside_plans)
    )
    assert plans is not None
    exact, difference = float(plans.exact[index]), None if both is None else both[index]

    def column(head: str, value: float | None, series: Series | None = None) -> TableColumn:
        """Return a number without its sign, which a sense beside it has, and its error."""
        text, error, sense = DASH, DASH, None
        if value is not None:
            text = notation.computed(abs(value))
            sense = plans.sense(value) if value else None
        if sigma and series is not None:
            text, error = notation.numbers(series[index].size_text, series[index].sigma_text)
        cells = TableCell(text, sense), TableCell(error, None if sense is None else 0)
        return TableColumn(head, cells if sigma else cells[:1])

    read = None if lever is None else float(lever.read[index])
    share = error = DASH
    if difference is not None:
        share = notation.number(percent_text(difference.percent_size))
        if difference.percent is not None and difference.expected is not None:
            error = notation.number(sigma_text(difference.expected)) + difference.mark
    columns = [
        column(plans.head(notation), exact),
        column(texts.by_plans, float(plans.read[index]), plans),
        column(texts.by_lever, read, lever),
        TableColumn(texts.difference, (share, error) if sigma else (share,)),
    ]
    problem, statics = reading.solution.problem, reading.statics
    for other, driving in zip(problem.drive.other_drives, statics.other_driving, strict=True):
        letter, unit = problem.balancer_of(other), notation.in_head(other.balancing.unit)
        own = float(statics.other_balances[other.link][index])
        hand = reading.read_number(driving.balance)
        heads = f"{notation.symbol(letter)}, {unit}", texts.by_plans
        for head, value in zip(heads, (own, hand), strict=True):
            way = sense_of(value) if other.is_crank and value else None
            cell = TableCell(notation.computed(abs(value)), way)
            none = TableCell(DASH, None if way is None else 0)
            columns.append(TableColumn(head, (cell, none) if sigma else (cell,)))
    return [TableColumn("", (texts.value, "±σ")), *columns] if sigma else columns
