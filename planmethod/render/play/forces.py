"""The force plans of a position played, each beside its links cut free, and the Zhukovsky lever."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial

from planmethod.construct.steps import PointName
from planmethod.note.document import Step as ToldStep
from planmethod.note.narrate.forces.lever import LeverNarrator, LeverPart
from planmethod.note.narrate.forces.loads import (
    ForceContext,
    FrictionNarrator,
    arm_symbol,
    balance_edges,
    balance_equation,
)
from planmethod.note.narrate.forces.moments import number_equations
from planmethod.note.narrate.forces.plan import (
    DrawnForce,
    ForcePlanNarrator,
    titled_plans,
    told_plan,
)
from planmethod.note.narrate.naming import Formulas, direction_note, scale_inscription
from planmethod.plans.forces.polygons import Edge, ForcePlan, Moments as MomentEquation
from planmethod.plans.model import KnownParts, PlanKind
from planmethod.render.forces.arrows import ACTION, ARM, COUPLE, ForceArm, arms_of
from planmethod.render.forces.cut import SHIFT, cut_picture
from planmethod.render.forces.friction import friction_picture
from planmethod.render.forces.polygon import (
    drawn_edges,
    lever_picture,
    polygon_picture,
    start_place,
)
from planmethod.render.ink.drawing import Item, Stroke, Text
from planmethod.render.play.appearing import ON, Moments
from planmethod.render.play.playback import (
    Board,
    Dot,
    Mark,
    PlayedEquation,
    PlayedSection,
    PlayedStep,
    Role,
    Segment,
    letter_height,
    xy,
)
from planmethod.render.play.strokes import EXTENSION, SHORTEST
from planmethod.render.symbols import FORCE, PLAN_FORCE
from planmethod.solved.forces.friction import RubbedReading, rubbed_reading
from planmethod.solved.forces.reading import ForceReading, LeverReading

Played = tuple[list[PlayedSection], list[Board]]
"""Sections and the boards that they add."""


def force_sections(formulas: Formulas, index: int, first: int) -> Played:
    """Return the sections of the force analysis of a position, and their boards.

    Parameters
    ----------
    formulas : Formulas
        Of the position.
    index : int
        Which position.
    first : int
        Number of the first step of these sections in the playback.

    Raises
    ------
    AssemblyError
        A force plan does not close.
    """
    context = ForceContext(ForceReading(formulas.solution, index), formulas)
    context.reading.statics.si  # noqa: B018 - an impossible step is reported first
    number_equations(context)
    sections, boards = _plans(context, first, context.texts.title_plans)
    first += sum(len(section.steps) for section in sections)
    statics = context.reading.statics
    if statics.lever_at(index) is not None:
        section, board = _Lever(context, first).played()
        if section.steps:
            sections.append(section)
            boards.append(board)
            first += len(section.steps)
    dynamics = formulas.solution.problem.dynamics
    if dynamics is not None and dynamics.friction is not None:
        more, added = _friction(context, formulas, first)
        sections += more
        boards += added
    return sections, boards


def _plans(context: ForceContext, first: int, chapter: str, name: str = "forces") -> Played:
    """Return the force plans, each as a section with two boards."""
    sections, boards = list[PlayedSection](), list[Board]()
    for number, (plan, title) in enumerate(titled_plans(context)):
        player = _PlanPlayer(context, plan, number, first, name)
        section = player.section(f"{chapter}. {title}")
        if not section.steps:
            continue
        first += len(section.steps)
        sections.append(section)
        boards += (player.board(section.title), player.cut_board(title))
    return sections, boards


def _friction(context: ForceContext, formulas: Formulas, first: int) -> Played:
    """Return the friction of the pairs on the scheme, then the force plans with one correction."""
    narrator, board = FrictionNarrator(context), PlanKind.POSITION.value
    sentences = [[narrator.texts.order, *narrator.given_lines()]]
    sentences += [[narrator.pair(pair)] for pair in narrator.friction.pairs]
    given = PlayedSection(narrator.texts.title, board, _worded(sentences))
    corrected = ForceContext(rubbed_reading(context.solution, context.reading.index), formulas)
    chapter = narrator.texts.corrected
    sections, boards = _plans(corrected, first + len(given.steps), chapter, "friction")
    results = _worded([line] for line in narrator.results())
    ended = [PlayedSection(narrator.texts.results, board, results)] if results else []
    return [given, *sections, *ended], boards


def _worded(sentences: Iterable[Sequence[str]]) -> tuple[PlayedStep, ...]:
    """Return steps of words alone."""
    return tuple(PlayedStep(tuple(lines)) for lines in sentences if lines)


class _PlanPlayer:
    """One force plan beside its links cut free, on which the arms are measured."""

    def __init__(
        self, context: ForceContext, plan: ForcePlan, number: int, first: int, name: str
    ) -> None:
        self.context, self.plan, self.number, self.first = context, plan, number, first
        self.id, self.cut = f"{name}-{number}", f"{name}-cut-{number}"
        self.reading = context.reading
        self.when: dict[Edge, int] = {}
        self.arms: list[tuple[ForceArm, int]] = []
        self._dots = set[PointName]()

    def board(self, title: str) -> Board:
        """Return the board of the plan, with the finished plan if there is one."""
        scale = ForcePlanNarrator(self.context, self.plan, self.number).inscription()
        if not self.when:
            return Board(self.id, title, scale)
        items, moments = self._finished()
        return Board(self.id, title, scale, items=items, appears=moments.each(items))

    def cut_board(self, title: str) -> Board:
        """Return the links cut free with all forces; an arm appears with its equation."""
        solution, reading = self.context.solution, self.reading
        bodies = solution.problem.bodies
        points = [PointName(point) for link in self.plan.links for point in bodies[link].points]
        height, notation = letter_height(map(reading.place, points)), self.context.notation
        picture = (
            friction_picture(reading, self.number, height, notation)
            if isinstance(reading, RubbedReading)
            else cut_picture(reading, self.number, height, notation)
        )
        items = picture.items
        moments = armed(items, self.arms, self.first)
        scale = solution.plan_scale(PlanKind.POSITION, reading.index)
        convention = solution.problem.scales.convention
        inscription = scale_inscription(scale, convention, notation)
        return Board(self.cut, title, inscription, items=items, appears=moments.each(items))

    def section(self, title: str) -> PlayedSection:
        """Return the section of the plan."""
        steps, equations = list[PlayedStep](), list[PlayedEquation]()
        for node, drawn in told_plan(self.context, self.plan, self.number):
            if isinstance(node, ToldStep):
                steps.append(self._step(node.lines, drawn, self.first + len(steps)))
        directed = partial(direction_note, self.context.names)
        for balance in self.plan.balances if self.when else ():
            equation = balance_equation(balance, self.context, directed)
            moments = map(self._moment, balance_edges(balance, self.context))
            equations.append(PlayedEquation(equation, tuple(moments)))
        return PlayedSection(title, self.id, tuple(steps), tuple(equations), self.cut)

    def _moment(self, edge: Edge) -> int:
        """Return the step that draws a force; forces of other equations are found by their ends.

        The reaction to a force has the same ends and its own step.
        """
        ends = {edge.tail, edge.head}
        own = {one: step for one, step in self.when.items() if {one.tail, one.head} == ends}
        same = [step for one, step in own.items() if one.symbol == edge.symbol]
        return max(same or own.values(), default=-1)

    def _step(
        self, lines: Sequence[str], drawn: DrawnForce | MomentEquation | None, number: int
    ) -> PlayedStep:
        if drawn is None:
            return PlayedStep(tuple(lines))
        if isinstance(drawn, MomentEquation):
            notation = self.context.notation
            found = arms_of(self.reading, [drawn], notation)
            self.arms += [(arm, number) for arm in found]
            arms = (Segment(xy(one.about), xy(one.base), Role.AID, self.cut) for one in found)
            return PlayedStep(tuple(lines), marks=tuple(arms))
        marks = list[Mark]()
        meets = drawn.step is None and len(drawn.edges) == 1
        for edge in drawn.edges:
            tail, head = (self.reading.corner(self.number, end) for end in (edge.tail, edge.head))
            span = abs(head - tail)
            if (
                meets
                and edge.known is not KnownParts.BOTH
                and edge.direction is not None
                and span > SHORTEST
            ):
                along = (head - tail) / span * EXTENSION
                marks.append(
                    Segment(xy(tail - along), xy(head + along), Role.CONSTRUCTION, self.id)
                )
                continue
            if span > SHORTEST:
                marks.append(Segment(xy(tail), xy(head), Role.RESULT, self.id))
                if edge.head not in self._dots:
                    marks.append(Dot(xy(head), Role.RESULT, self.id, str(edge.head)))
                    self._dots.add(edge.head)
            self.when.setdefault(edge, number)
        makes = () if drawn.step is None else (str(drawn.step.out),)
        return PlayedStep(tuple(lines), makes, tuple(marks))

    def _finished(self) -> tuple[tuple[Item, ...], Moments]:
        """Return the finished plan, and the steps that complete its forces."""
        notation, reading = self.context.notation, self.reading
        last = max(self.when.values(), default=self.first)
        begin = min(self.when.values(), default=self.first)
        tags, labels = dict[str, int](), dict[str, int]()
        corners = list[complex]()
        for k, edge in enumerate(drawn_edges(reading, self.number)):
            symbol = notation.symbol(edge.symbol)
            step = self.when.get(edge, self._moment(edge))
            step = last if step < 0 else step
            tags[f"{PLAN_FORCE} {symbol}"] = step
            labels[f"plan {reading.index} {self.number} {k}: {symbol}"] = step
            corners += [reading.corner(self.number, end) for end in (edge.tail, edge.head)]
        picture = polygon_picture(reading, self.number, letter_height(corners), notation)
        places = [(start_place(reading, self.number), begin)]
        return picture.items, Moments(places, tags, labels, {}, begin)


def armed(items: Sequence[Item], arms: Sequence[tuple[ForceArm, int]], first: int) -> Moments:
    """Return when the items of links with forces appear: arms with their equations.

    The lines of action of an arm follow it.
    """
    exact, labels, step = dict[Item, int](), dict[str, int](), first
    for item in items:
        if isinstance(item, Stroke) and item.tag.startswith(f"{ARM} "):
            symbol, about = item.tag.removeprefix(f"{ARM} "), item.points[0]
            own = [at for arm, at in arms if arm.symbol == symbol and abs(arm.about - about) <= ON]
            step = min(own, default=first)
            exact[item] = step
        elif isinstance(item, Stroke) and item.tag.startswith(ACTION):
            exact[item] = step
        elif isinstance(item, Text) and " arm: " in item.label:
            names = item.label.partition(" arm: ")[2].split()
            own = [at for arm, at in arms if arm_symbol(arm.symbol) in names]
            labels[item.label] = min(own, default=first)
    return Moments([], labels=labels, first=first, exact=exact)


class _Lever:
    """The Zhukovsky lever: the turned plan, the forces on it, their arms (рычаг Жуковского)."""

    id = "lever"

    def __init__(self, context: ForceContext, first: int) -> None:
        self.context, self.first = context, first
        self.narrator = LeverNarrator(context)
        self.lever: LeverReading = self.narrator.lever
        self.when: dict[LeverPart, int] = {}

    def played(self) -> tuple[PlayedSection, Board]:
        """Return the section of the lever and its board."""
        steps = list[PlayedStep]()
        for part, lines in self.narrator.steps():
            if lines:
                self.when.setdefault(part, self.first + len(steps))
                steps.append(PlayedStep(tuple(lines)))
        title, context = self.context.texts.title_lever, self.context
        convention = context.solution.problem.scales.convention
        scale = scale_inscription(self.lever.scale, convention, context.notation)
        plan = context.solution.construction.plan(PlanKind.VELOCITY)
        ends = [self.lever.place(end) for one in plan.vectors for end in (one.tail, one.head)]
        picture = lever_picture(context.reading, letter_height(ends), context.notation)
        items = picture.items
        board = Board(self.id, title, scale, items=items, appears=self._moments(items).each(items))
        source = PlanKind.VELOCITY.value
        return PlayedSection(title, self.id, tuple(steps), source=source), board

    def _moments(self, items: Sequence[Item]) -> Moments:
        """Return when the items appear: by the first words of their tags and names."""
        labels = dict(self._named(item.label for item in items if isinstance(item, Text)))
        exact: dict[Item, int] = {
            item: step
            for item in items
            if not isinstance(item, Text) and (step := self._step_of(item.tag, TAGS)) is not None
        }
        return Moments([], labels=labels, first=self.first, exact=exact)

    def _named(self, names: Iterable[str]) -> Iterator[tuple[str, int]]:
        prefix = f"lever {self.context.reading.index}"
        shifted = {one.letters[1] for one in self.lever.shifts}
        for name in names:
            own = name.removeprefix(prefix).lstrip(": ")
            part = "force" if own.removeprefix("point ") in shifted else own
            step = self._step_of(part, NAMES)
            if step is not None:
                yield name, step

    def _step_of(self, text: str, parts: Mapping[str, LeverPart]) -> int | None:
        part: LeverPart = next(
            (one for begin, one in parts.items() if text.startswith(begin)), "plan"
        )
        return self.when.get(part)


# no messages: first words of tags and names
TAGS: Mapping[str, LeverPart] = {
    f"{FORCE} ": "forces",
    SHIFT: "forces",
    "line of action": "forces",
    "right angle": "forces",
    COUPLE: "couples",
    f"{ARM} ": "arms",
    ACTION: "arms",
}
"""Parts of the lever by the tags of its items; other items are those of the plan."""

NAMES: Mapping[str, LeverPart] = {"force": "forces", "couple": "couples", "arm": "arms"}
"""Parts of the lever by the names of inscriptions, after that of the lever."""
