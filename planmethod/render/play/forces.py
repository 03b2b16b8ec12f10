"""The force plans of a position played, each on a board of its own."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from planmethod.note.document import Step as ToldStep
from planmethod.note.narrate.forces.loads import ForceContext, balance_equation
from planmethod.note.narrate.forces.moments import number_equations
from planmethod.note.narrate.forces.plan import (
    DrawnForce,
    ForcePlanNarrator,
    titled_plans,
    told_plan,
)
from planmethod.note.narrate.naming import Formulas, direction_note
from planmethod.plans.forces.polygons import Edge, ForcePlan
from planmethod.plans.model import KnownParts
from planmethod.render.forces.polygon import drawn_edges, polygon_picture, start_place
from planmethod.render.ink.drawing import Item
from planmethod.render.play.appearing import Moments
from planmethod.render.play.playback import (
    Board,
    Dot,
    Mark,
    PlayedEquation,
    PlayedSection,
    PlayedStep,
    Role,
    Segment,
    xy,
)
from planmethod.render.play.strokes import EXTENSION, SHORTEST
from planmethod.render.symbols import PLAN_FORCE
from planmethod.solved.forces.reading import ForceReading

LETTER = 5.0
"""Height of the letters of forces, mm."""


def force_sections(
    formulas: Formulas, index: int, first: int
) -> tuple[list[PlayedSection], list[Board]]:
    """Return the sections of the force plans of a position, and their boards.

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
    sections, boards = list[PlayedSection](), list[Board]()
    for number, (plan, title) in enumerate(titled_plans(context)):
        player = _PlanPlayer(context, plan, number, first)
        section = player.section(title)
        if not section.steps:
            continue
        first += len(section.steps)
        sections.append(section)
        boards.append(player.board(section.title))
    return sections, boards


class _PlanPlayer:
    def __init__(self, context: ForceContext, plan: ForcePlan, number: int, first: int) -> None:
        self.context, self.plan, self.number, self.first = context, plan, number, first
        self.id = f"forces-{number}"
        self.reading = context.reading
        self.when: dict[Edge, int] = {}
        self.drawn: list[Edge] = []

    def board(self, title: str) -> Board:
        """Return the board of the plan, with the finished plan if there is one."""
        scale = ForcePlanNarrator(self.context, self.plan, self.number).inscription()
        if not self.when:
            return Board(self.id, title, scale)
        items, moments = self._finished()
        return Board(self.id, title, scale, items=items, appears=moments.each(items))

    def section(self, title: str) -> PlayedSection:
        """Return the section of the plan."""
        steps, equations = list[PlayedStep](), list[PlayedEquation]()
        for node, drawn in told_plan(self.context, self.plan, self.number):
            if isinstance(node, ToldStep):
                steps.append(self._step(node.lines, drawn, self.first + len(steps)))
        directed = partial(direction_note, self.context.names)
        for balance in self.plan.balances if self.when else ():
            equation = balance_equation(balance, self.context, directed)
            moments = tuple(self._moment(edge) for edge in balance.edges)
            if len(moments) == len(equation.left):
                equations.append(PlayedEquation(equation, moments))
        whole = f"{self.context.texts.title_plans}. {title}"
        return PlayedSection(whole, self.id, tuple(steps), tuple(equations))

    def _moment(self, edge: Edge) -> int:
        """Return the step that draws a force; forces of other equations are found by their ends."""
        ends = {edge.tail, edge.head}
        own = [step for one, step in self.when.items() if {one.tail, one.head} == ends]
        return max(own, default=-1)

    def _step(self, lines: Sequence[str], drawn: DrawnForce | None, number: int) -> PlayedStep:
        if drawn is None:
            return PlayedStep(tuple(lines))
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
                marks.append(Dot(xy(head), Role.RESULT, self.id, str(edge.head)))
            self.when.setdefault(edge, number)
        makes = () if drawn.step is None else (str(drawn.step.out),)
        return PlayedStep(tuple(lines), makes, tuple(marks))

    def _finished(self) -> tuple[tuple[Item, ...], Moments]:
        """Return the finished plan, and the steps that complete its forces."""
        notation, reading = self.context.notation, self.reading
        last = max(self.when.values(), default=self.first)
        begin = min(self.when.values(), default=self.first)
        tags, labels = dict[str, int](), dict[str, int]()
        for k, edge in enumerate(drawn_edges(reading, self.number)):
            symbol = notation.symbol(edge.symbol)
            step = self.when.get(edge, self._moment(edge))
            step = last if step < 0 else step
            tags[f"{PLAN_FORCE} {symbol}"] = step
            labels[f"plan {reading.index} {self.number} {k}: {symbol}"] = step
        picture = polygon_picture(reading, self.number, LETTER, notation)
        places = [(start_place(reading, self.number), begin)]
        return picture.items, Moments(places, tags, labels, {}, begin)
