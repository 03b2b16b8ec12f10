"""The sentences of the force plans, made from their steps, and the chapters on forces."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from msgspec import Struct

from planmethod.construct.steps import (
    Carry,
    IntersectLines,
    LayOffLength,
    LineName,
    Name,
    Parallel,
    Perpendicular,
    PointName,
    Step,
)
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.note.document import (
    NO_BREAK,
    Caption,
    Chapter,
    Equations,
    Node,
    Part,
    Step as DocumentStep,
    closed,
    step_of,
)
from planmethod.note.narrate.forces.lever import LeverNarrator, thrust_lines
from planmethod.note.narrate.forces.loads import (
    ForceContext,
    FrictionNarrator,
    LoadNarrator,
    balance_equation,
    undetermined,
)
from planmethod.note.narrate.forces.moments import MomentNarrator, number_equations
from planmethod.note.narrate.naming import Formulas, direction_note, point_name, scale_inscription
from planmethod.note.narrate.structure import group_title, links_of_group
from planmethod.plans.forces.board import Reaction
from planmethod.plans.forces.lever import Thrust
from planmethod.plans.forces.polygons import (
    Component,
    CoupleOn,
    Edge,
    ForcePlan,
    LoadKind,
    Moments,
    reaction_symbol,
)
from planmethod.plans.model import Relation
from planmethod.solved.forces.reading import ForceReading


class DrawnForce(Struct, frozen=True):
    """Sentences of a force plan, with the step and the forces that they draw (рассказанное)."""

    lines: tuple[str, ...]
    step: Step | None = None
    edges: tuple[Edge, ...] = ()


class ForcePlanNarrator:
    """Tells one force plan in the order of its steps.

    Parameters
    ----------
    context : ForceContext
    plan : ForcePlan
    number : int
        Which of the plans of the solution.
    """

    def __init__(self, context: ForceContext, plan: ForcePlan, number: int) -> None:
        self.context, self.plan, self.number = context, plan, number
        self.scale = context.reading.plan_scale(number)
        self.reading, self.names = context.reading, context.names
        self.texts, self.note_texts = context.texts, context.note_texts
        self.statics = context.reading.statics
        start = self.statics.board.starts[number + 1]
        self._ends: dict[PointName, str] = {start: self.texts.of_start}
        self._begun = False
        self._drawn: list[Edge] = []

    def inscription(self) -> str:
        """Return the scale of the plan as inscribed under it."""
        convention = self.context.solution.problem.scales.convention
        return scale_inscription(self.scale, convention, self.context.notation)

    @property
    def _edges(self) -> tuple[Edge, ...]:
        return (*self.plan.polygon, *self.plan.inner)

    @property
    def is_unloaded(self) -> bool:
        """True if neither a force nor a couple acts on the links."""
        forces, couples = map(self.reading.is_negligible, self._edges), self.plan.couples
        return all(forces) and all(map(self.reading.is_no_couple, couples))

    # Cut free --------------------------------------------------------------------------------

    def freed(self) -> list[str]:
        """Return the reactions that replace the removed links."""
        texts = self.texts
        outer = [r for r in self.statics.board.reactions if self._is_outer(r)]
        reactions = ", ".join(self._reaction(reaction) for reaction in outer)
        drive = self.context.solution.problem.drive
        other = next((one for one in drive.other_drives if self.plan.links == (one.link,)), None)
        if other is not None:
            symbol = self.context.symbol(self.context.solution.problem.balancer_of(other))
            key = "force" if other.pivot is None else "moment"
            balancing = texts["and_balance"][key].format(symbol=symbol)
            freed = texts.freed_driver.format(reactions=reactions, balancing=balancing)
            return [freed, *self._known]
        if self.plan.links == (drive.link,):
            if (motor := self.statics.motor) is not None:
                one, two = map(self.statics.board.called, motor.links)
                freed = texts.freed_motor.format(reactions=reactions, one=one, two=two)
                return [freed, *self._motor_moments, *self._known]
            if self.statics.thrust is not None:
                freed = texts.freed_actuated.format(reactions=reactions)
                return [freed, *self._pushed, *self._known]
            symbol = self.context.symbol(self.reading.balancing_symbol)
            template = texts["and_balance"][self.reading.balancing.phrase_key]
            pushed = self.context.solution.problem.drive.pushed
            point = "" if pushed is None else point_name(pushed.at)
            balancing = template.format(symbol=symbol, point=point)
            freed = texts.freed_driver.format(reactions=reactions, balancing=balancing)
            return [freed, *self._known]
        lines = [texts.freed.format(reactions=reactions)]
        if self.is_unloaded:
            return lines
        for whole in self.plan.wholes:
            normal, tangential = self._components(whole)
            line = self.context.base(normal)
            symbols = {"whole": whole, "normal": normal, "tangential": tangential}
            said_of = {key: self.context.symbol(edge.symbol) for key, edge in symbols.items()}
            lines.append(texts.components.format(line=line, **said_of))
            lines += self._line_of_action(normal, tangential)
        return [*lines, *self._pushed, *self._motor_moments, *self._known]

    @property
    def _motor_moments(self) -> list[str]:
        """Links of the group on which a motor between moving links acts."""
        motor = self.statics.motor
        if motor is None:
            return []
        value = self.reading.read_number(motor.value)
        senses = self.context.language.note
        return [
            self.texts.motor.format(
                link=link,
                symbol=self.context.symbol(self.reading.balancing_symbol),
                sense=senses["ccw" if value * sign > 0 else "cw"],
            )
            for link, sign in zip(motor.links, (-1.0, 1.0), strict=True)
            if link in self.plan.links
        ]

    def _line_of_action(self, normal: Edge, tangential: Edge) -> list[str]:
        """Return how the radial force on teeth follows from the circumferential one."""
        for mesh in self.context.solution.problem.meshes:
            if mesh.pole != normal.at:
                continue
            symbols = [self.context.symbol(edge.symbol) for edge in (normal, tangential)]
            sizes = [self.context.computed(self.reading.read(e)) for e in (tangential, normal)]
            angle = self.context.short(mesh.alpha)
            formula = f"{symbols[0]} = {symbols[1]}·tg{NO_BREAK}α = {sizes[0]}·tg{NO_BREAK}{angle}°"
            formula += f" = {sizes[1]} {self.context.units['N']}"
            return [self.texts.line_of_action.format(formula=formula, angle=angle)]
        return []

    @property
    def _pushed(self) -> list[str]:
        """Points where the force of an actuator acts on the links, if it does."""
        thrust = self.statics.thrust
        if thrust is None:
            return []
        symbol = self.context.symbol(self.reading.balancing_symbol)
        line = "".join(map(point_name, thrust.ends))
        return [
            self.texts.thrust.format(
                symbol=symbol, line=line, link=link, point=point_name(str(force.at))
            )
            for link, force in thrust.pushes
            if link in self.plan.links
        ]

    def _is_outer(self, reaction: Reaction) -> bool:
        return reaction.on in self.plan.links and reaction.by not in self.plan.links

    def _reaction(self, reaction: Reaction) -> str:
        texts = self.texts
        by = texts.from_frame if reaction.by == FRAME else texts.from_link.format(link=reaction.by)
        symbol = self.context.symbol(reaction.force.symbol)
        return texts.reaction.format(symbol=symbol, by=by, point=reaction.joint)

    def _components(self, reaction: Edge) -> tuple[Edge, Edge]:
        """Return the normal and the tangential component of a reaction."""
        own = [e for e in self.plan.polygon if (e.on, e.at) == (reaction.on, reaction.at)]
        return (
            next(e for e in own if e.component is Component.NORMAL),
            next(e for e in own if e.component is Component.TANGENTIAL),
        )

    @property
    def _known(self) -> list[str]:
        """Reactions known from the preceding groups, with their sign."""
        links, told = self.plan.links, []
        for r in self.statics.board.reactions:
            if r.by not in links or r.on in links or self._is_zero(r):
                continue
            for letter in "F" if self._has_no_moment(r) else "FM":  # between moving links
                own = reaction_symbol(r.by, r.on, letter=letter)
                other = reaction_symbol(r.on, r.by, letter=letter)
                told.append(self.context.symbol(f"{own} = −{other}"))
        return [self.texts.passed_on.format(reactions=", ".join(told))] if told else []

    def _is_zero(self, reaction: Reaction) -> bool:
        """Return whether there is neither force nor moment in a joint."""
        at, tail, head = reaction.force.at, reaction.force.tail, reaction.force.head
        return self.reading.is_negligible(
            Edge("", reaction.on, at, tail, head)
        ) and self._has_no_moment(reaction)

    def _has_no_moment(self, reaction: Reaction) -> bool:
        """Return whether a joint has no moment."""
        if reaction.couple is None:
            return True
        return self.reading.is_no_couple(CoupleOn("", reaction.on, reaction.couple))

    # Steps -----------------------------------------------------------------------------------

    @property
    def _steps(self) -> list[Step]:
        """The steps that make a side of the plan."""
        ends = {end for edge in self._edges for end in (edge.tail, edge.head)}
        steps = self.statics.program.steps
        return [
            step
            for step in steps
            if step.out in ends and isinstance(step, LayOffLength | Carry | IntersectLines)
        ]

    def steps(self) -> Iterator[list[str]]:
        """Yield the sentences of the steps of drawing the plan, and the readings."""
        yield from (list(drawn.lines) for drawn in self.drawn())

    def drawn(self) -> Iterator[DrawnForce]:
        """Yield the steps of drawing the plan, and the readings; a step may have no sentence."""
        for step in self._steps:
            if isinstance(step, LayOffLength):
                edge = self._side(step.origin, step.out)
                yield DrawnForce(tuple(self._tangential(edge)), step, (edge,))
                if edge in self.plan.inner:
                    self._drawn.append(edge)
            elif isinstance(step, Carry):
                edge = self._side(step.origin, step.out)
                yield DrawnForce(tuple(self._carry(step)), step, (edge,))
            elif isinstance(step, IntersectLines):
                yield from self._meet(step)
        yield from self._closing()
        read = closed([self._read(edge) for edge in self.plan.reactions])
        yield DrawnForce((self.texts.read_off, *read))

    def _read(self, edge: Edge) -> str:
        text = self.force_text(edge)
        if self.reading.is_negligible(edge):
            return text
        return text + self.context.exactly(abs(self.reading.force(edge)))

    def force_text(self, edge: Edge) -> str:
        """Return a force read from its plan: ``F_{42} = 70,0/0,01 = 7000 Н``."""
        symbol, length = self.context.symbol(edge.symbol), self.reading.length(edge, self.number)
        if self.reading.is_negligible(edge):
            return f"{symbol} = 0"
        if not length:
            return f"{symbol} ≈ 0"
        numbers = self.context.scaled(self.context.measured(length), self.scale.per_mm)
        size = self.context.known(self.reading.read(edge))
        return f"{symbol} = {numbers} = {size} {self.context.units['N']}"

    def _tangential(self, edge: Edge) -> list[str]:
        """Return how a component or balancing force, known from moments, is laid off."""
        direction = edge.direction
        if direction is not None and direction.relation is Relation.ANGLED:
            return self._plot_vector(edge, self.context.direction_phrase(self.reading.force(edge)))
        if edge.component is Component.TANGENTIAL or direction is None:
            return self._plot_vector(
                edge, self.texts.way_tangent.format(line=self._base_line(edge))
            )
        along = direction.relation is Relation.PARALLEL
        template = self.texts.way_along if along else self.texts.way_tangent
        return self._plot_vector(edge, template.format(line=self.context.base(edge)))

    def _base_line(self, edge: Edge) -> str:
        """Return the line that a tangential component is perpendicular to."""
        if edge.direction is not None:
            return self.context.base(edge)
        normal = next(
            e
            for e in self.plan.polygon
            if (e.on, e.at, e.component) == (edge.on, edge.at, Component.NORMAL)
        )
        return self.context.base(normal)

    def _carry(self, step: Carry) -> list[str]:
        edge = self._side(step.origin, step.out)
        source = self._source(step)
        if source is not None:
            other = self.context.symbol(source.force.symbol)
            return self._plot_vector(
                edge, self.texts.way_back.format(other=other), back=edge.tail == step.out
            )
        thrust = self.statics.thrust
        if thrust is not None and {step.tail, step.head} == {*thrust.force.ends}:
            return self._plot_vector(
                edge, self._thrust_direction(thrust, edge), back=edge.tail == step.out
            )
        return self._plot_vector(edge, self._load_direction(step), back=edge.tail == step.out)

    def _thrust_direction(self, thrust: Thrust, edge: Edge) -> str:
        """Return the direction of the force of an actuator: from one of its ends to the other."""
        ends = list(map(point_name, thrust.ends))
        one, two = (self.reading.place(PointName(end)) for end in thrust.ends)
        if (self.reading.force(edge) * (two - one).conjugate()).real < 0:
            ends.reverse()
        return self.texts.way_thrust.format(line="".join(ends), first=ends[0], second=ends[1])

    def _side(self, one: PointName, two: PointName) -> Edge:
        """Return the side of the polygon between two points, whichever way it points."""
        return next(e for e in self._edges if {e.tail, e.head} == {one, two})

    def _source(self, step: Carry) -> Reaction | None:
        """Return the reaction that a step carries over from the plan of another group."""
        ends = {step.tail, step.head}
        return next(
            (
                reaction
                for reaction in self.statics.board.reactions
                if {reaction.force.tail, reaction.force.head} == ends
            ),
            None,
        )

    def _load_direction(self, step: Carry) -> str:
        """Return the direction of a load."""
        load = next(
            given
            for given in self.statics.board.given
            if given.force is not None
            and {given.force.tail, given.force.head} == {step.tail, step.head}
        )
        one = load.applied
        assert one.point is not None
        if one.kind is not LoadKind.INERTIA:
            return self.context.direction_phrase(complex(one.force[self.reading.index]))
        motion = self.names.kinematics.acceleration
        head = motion.point[motion.named[one.point]]
        return self.texts.way_against.format(
            segment=self.names.segment(motion.pole, head), acceleration=f"a_{{{one.point}}}"
        )

    def _plot_vector(self, edge: Edge, direction: str, *, back: bool = False) -> list[str]:
        """Return how a vector is laid off; no lines for a zero vector."""
        new, old = (edge.tail, edge.head) if back else (edge.head, edge.tail)
        symbol = self.context.symbol(edge.symbol)
        length = self.reading.length(edge, self.number)
        if self.reading.is_negligible(edge) or not length:
            self._ends[new] = self._ends[old]
            if self.reading.is_negligible(edge):
                return []
            return [self.texts.too_short.format(symbol=symbol)]
        template = self.texts.lay_before if back else self.texts.lay_off
        if not self._begun and not back:
            template = self.texts.lay_first
        said = {
            "of": self._ends[old],
            "way": direction,
            "symbol": symbol,
            "length": self._length(edge),
        }
        self._begun = True
        phrase = self.texts.of_tail if back else self.texts.of_head
        self._ends[new] = phrase.format(symbol=symbol)
        return [template.format(**said)]

    def _length(self, edge: Edge) -> str:
        """Return how the length of a force on the plan is computed."""
        context, newtons = self.context, self.context.known(self.reading.read(edge))
        formula = context.scaled(newtons, self.scale.per_mm, back=True)
        length = context.short(self.reading.length(edge, self.number), 4)
        return f"{formula} = {length} {context.units['mm']}"

    # Closing ---------------------------------------------------------------------------------

    def _meet(self, step: IntersectLines) -> Iterator[DrawnForce]:
        edges = [self._edge_on_line(line, step.out) for line in (step.first, step.second)]
        for edge in edges:
            start = edge.tail if edge.head == step.out else edge.head
            yield DrawnForce((self._line(edge, self._ends[start]),), edges=(edge,))
        self._ends[step.out] = self.texts.of_meeting
        self._drawn += edges
        vectors = [self._vector(edge) for edge in edges if not self.reading.is_negligible(edge)]
        text = self.texts.meet.format(plan=self._plan_of(0), vectors="; ".join(vectors))
        yield DrawnForce((text,) if vectors else (), step, tuple(edges))

    def _plan_of(self, number: int) -> str:
        """Return whose force plan one of the equations of forces is."""
        balance = self.plan.balances[min(number, len(self.plan.balances) - 1)]
        several = len(balance.links) > 1
        template = self.texts.plan_of_group if several else self.texts.plan_of_link
        counted = self.context.numbers.get(balance)
        by = self.texts.by_equation.format(number=counted) if counted else ""
        return template.format(links="–".join(balance.links)) + by

    def _edge_on_line(self, line: LineName, out: PointName) -> Edge:
        """Return the side of the plan on a line."""
        step = self.context.step[line]
        assert isinstance(step, Parallel | Perpendicular)
        ends = {step.through, out}
        return next(e for e in self._edges if e.direction and {e.tail, e.head} == ends)

    def _line(self, edge: Edge, of: str) -> str:
        assert edge.direction is not None
        base, angle = self.names.base(edge.direction), ""
        match edge.direction.relation:
            case Relation.PARALLEL:
                template = self.note_texts.draw_parallel
            case Relation.PERPENDICULAR:
                template = self.note_texts.draw_perpendicular
            case _:
                template = self.note_texts.draw_at_angle
                angle = self.context.short(edge.direction.angle, 4)
        symbol = self.context.symbol(edge.symbol)
        text = template.format(of=of, base=base, angle=angle)
        return f"{text}{self.note_texts.carries.format(symbol=symbol)}."

    def _vector(self, edge: Edge) -> str:
        return self.texts.vector.format(**self._span(edge))

    def _span(self, edge: Edge) -> dict[str, str]:
        return {
            "symbol": self.context.symbol(edge.symbol),
            "tail": self._ends[edge.tail],
            "head": self._ends[edge.head],
        }

    def _closing(self) -> Iterator[DrawnForce]:
        """Yield the forces that close a plan without a line of their own."""
        for edge in self.plan.reactions:
            if edge in self._drawn or self.reading.is_negligible(edge):
                continue
            same = self._same(edge)
            if edge in self.plan.wholes:
                text = self._total_text(edge)
            elif same:
                symbol = self.context.symbol(edge.symbol)
                text = self.texts.same.format(link=edge.on, symbol=symbol, same=same)
            elif edge in self.plan.inner:
                text = self.texts.inner.format(link=edge.on, **self._span(edge))
            else:
                text = self.texts.close.format(plan=self._plan_of(1), **self._span(edge))
            yield DrawnForce((text,), edges=(edge,))
            self._drawn.append(edge)

    def _total_text(self, edge: Edge) -> str:
        parts = [e for e in self._components(edge) if not self.reading.is_negligible(e)]
        text = " + ".join(self.context.symbol(part.symbol) for part in parts)
        if len(parts) == 1:
            return self.texts.whole_single.format(
                symbol=self.context.symbol(edge.symbol), part=text
            )
        return self.texts.whole.format(parts=text, **self._span(edge))

    def _same(self, edge: Edge) -> str:
        """Return the vector of the plan that a force is too, or ``−`` it; empty if none is.

        Rather one on the same link: so the equation of the link says it.
        """
        tail, head = self._ends[edge.tail], self._ends[edge.head]
        for other in sorted(self._drawn, key=lambda drawn: drawn.on != edge.on):
            ends = (self._ends[other.tail], self._ends[other.head])
            if ends in ((tail, head), (head, tail)):
                sign = "" if ends == (tail, head) else "−"
                return f"{sign}{self.context.symbol(other.symbol)}"
        return ""


def force_chapters(formulas: Formulas, index: int) -> Iterator[Node]:
    """Yield the chapters on forces of one position.

    Parameters
    ----------
    formulas : Formulas
        Of the position.
    index : int
        Which position.

    Raises
    ------
    AssemblyError
        Where a force plan does not close.
    """
    context = ForceContext(ForceReading(formulas.solution, index), formulas)
    context.reading.statics.si  # noqa: B018 - report first what cannot be drawn
    number_equations(context)
    yield from _loads(context)
    yield from _plans(context)
    yield from _lever(context)
    dynamics = formulas.solution.problem.dynamics
    if dynamics is not None and dynamics.friction is not None:
        yield from _friction(context, formulas)


def _loads(context: ForceContext) -> Iterator[Node]:
    texts, voice = context.texts, LoadNarrator(context)
    yield Chapter(texts.title_loads)
    if context.solution.problem.scales.mu_F is not None:
        yield DocumentStep((texts.scale.format(scale=voice.scale()),))
    for link in context.solution.problem.mechanism.links:
        yield DocumentStep(tuple(voice.link(link)))


def _plans(context: ForceContext) -> Iterator[Node]:
    said, words = context.texts, context.note_texts
    yield Chapter(said.title_plans)
    groups = tuple(reversed(context.solution.structure.groups))
    drive = context.solution.problem.drive
    ends = [words.driver.format(link=link) for link in (*drive.links[1:], drive.link)]
    titles = [*(links_of_group(group, words) for group in groups), *ends]
    frame = context.solution.problem.mechanism.frame
    order = ", ".join(title[:1].lower() + title[1:] for title in titles)
    lines = (said.order.format(order=order), said.indices.format(frame=frame))
    found = thrust_lines(context)
    yield DocumentStep((*lines, *found, *undetermined(groups, words)))
    for number, (plan, part) in enumerate(titled_plans(context)):
        yield Part(part)
        yield from _plan(context, plan, number)


def titled_plans(context: ForceContext) -> list[tuple[ForcePlan, str]]:
    """Return the force plans in the order of solving, each with its heading."""
    words, drive = context.note_texts, context.solution.problem.drive
    groups = reversed(context.solution.structure.groups)
    ends = [words.driver.format(link=link) for link in (*drive.links[1:], drive.link)]
    titles = [*(group_title(group, words) for group in groups), *ends]
    return list(zip(context.reading.plans, titles, strict=True))


def _plan(context: ForceContext, plan: ForcePlan, number: int) -> Iterator[Node]:
    yield from (node for node, _ in told_plan(context, plan, number))


def told_plan(
    context: ForceContext, plan: ForcePlan, number: int
) -> Iterator[tuple[Node, DrawnForce | Moments | None]]:
    """Yield the nodes on a force plan, each with its forces or its equation of moments."""
    voice, moments = ForcePlanNarrator(context, plan, number), MomentNarrator(context, plan)
    yield DocumentStep(tuple(voice.freed())), None
    if voice.is_unloaded:
        yield DocumentStep((context.texts.nothing,)), None
        return
    yield from ((node, None) for node in _balances(context, plan))
    if not _readable(context, *(end for edge in plan.polygon for end in (edge.tail, edge.head))):
        yield DocumentStep((context.texts.unreadable,)), None
        return
    for equation, lines in moments.before():
        yield from ((node, equation) for node in step_of(lines))
    if context.solution.problem.scales.mu_F is None:
        yield DocumentStep((context.texts.own_scale.format(scale=voice.inscription()),)), None
    for drawn in voice.drawn():
        yield from ((node, drawn) for node in step_of(drawn.lines))
    for equation, lines in moments.guides():
        yield from ((node, equation) for node in step_of(lines))


def _readable(context: ForceContext, *names: Name) -> bool:
    """Return whether the hand has all named values: not where it divides by zero."""
    hand, index = context.reading.statics.ruler_reading, context.reading.index
    return all(hand.has(name)[index] for name in names)


def _balances(context: ForceContext, plan: ForcePlan) -> Iterator[Node]:
    texts, directed = context.texts, partial(direction_note, context.names)
    for balance in plan.balances:
        template = texts.balance_link if len(balance.links) == 1 else texts.balance_group
        yield Caption(template.format(links="–".join(balance.links)))
        yield Equations((balance_equation(balance, context, directed),))


def _lever(context: ForceContext) -> Iterator[Node]:
    yield Chapter(context.texts.title_lever)
    lever = context.reading.statics.lever_at(context.reading.index)
    if lever is None:
        yield DocumentStep((context.texts.stands,))
    elif not _readable(context, lever.balance):
        yield DocumentStep((context.texts.unreadable,))
    else:
        for _, lines in LeverNarrator(context).steps():
            yield from step_of(lines)


def _friction(context: ForceContext, formulas: Formulas) -> Iterator[Node]:
    """Yield the friction of the pairs, and the force plans with one correction."""
    from planmethod.solved.forces.friction import rubbed_reading

    narrator, texts = FrictionNarrator(context), context.note_texts
    yield Chapter(narrator.texts.title)
    yield DocumentStep((narrator.texts.order, *closed(narrator.given_lines())))
    for pair in narrator.friction.pairs:
        yield DocumentStep((narrator.pair(pair),))
    corrected = ForceContext(rubbed_reading(context.solution, context.reading.index), formulas)
    driver = texts.driver.format(link=context.solution.problem.drive.link)
    yield Chapter(narrator.texts.corrected)
    groups: list[AssurGroup | None] = [*reversed(context.solution.structure.groups), None]
    for number, (plan, group) in enumerate(zip(corrected.reading.plans, groups, strict=True)):
        yield Part(driver if group is None else group_title(group, texts))
        yield from _plan(corrected, plan, number)
    yield Part(narrator.texts.results)
    yield from (DocumentStep((line,)) for line in (*narrator.results(), *narrator.cycle_lines()))
