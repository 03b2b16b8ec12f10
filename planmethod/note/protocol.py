"""Protocol of a construction: its program in words, as in a student's note (протокол)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from planmethod.arguments import number_of, of_type, text
from planmethod.construct.steps import Compute, MeasureAlong, PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.document import (
    Caption,
    Chapter,
    Document,
    Equations,
    GivenFact,
    Node,
    Paragraph,
    Part,
    Step,
    Title,
    step_of,
    steps_of,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.narrate.equations import direction_note, equation_of
from planmethod.note.narrate.forces.common import closed
from planmethod.note.narrate.given import drawn, given_paragraph
from planmethod.note.narrate.given import given as given_facts
from planmethod.note.narrate.naming import Names
from planmethod.note.narrate.steps import Narrator
from planmethod.note.narrate.structure import group_title
from planmethod.note.narrate.transfers import TransferNarrator
from planmethod.note.plaintext import given
from planmethod.note.tables.results import position_line, position_tables, scale_texts
from planmethod.note.wording import Language, language
from planmethod.plans.build import Section
from planmethod.plans.model import PlanKind
from planmethod.solved.solution import Solution
from planmethod.solved.transfers import transfers_of


def document_of(solution: Solution, *, lang: str = "ru", position: int = 0) -> Document:
    """Describe the construction of a position step by step (протокол построения).

    Parameters
    ----------
    solution : Solution
    lang : str
        ``ru`` or ``en``.
    position : int
        Index into ``solution.positions``.

    Raises
    ------
    ArgumentError, UnknownLanguageError
        When there is no such position, or language.

    Examples
    --------
    >>> import planmethod
    >>> problem = planmethod.load("problems/linkages/ex3.toml")
    >>> told = planmethod.document(planmethod.solve(problem), lang="en")
    >>> from planmethod.note.document import Chapter
    >>> [node.title for node in told.nodes if isinstance(node, Chapter)][:3]
    ['Scales', 'Position plan', 'Velocity plan']

    Its writers are in `planmethod.note.writers`; a notebook shows it as it is.
    """
    of_type("solution", solution, Solution, "planmethod.solve()")
    number_of("position", position, len(solution.positions))
    return protocol_document(solution, language(text("lang", lang)), position)


def protocol_document(solution: Solution, words: Language, position: int = 0) -> Document:
    """Return the construction of one position step by step (протокол построения).

    Parameters
    ----------
    solution : Solution
    words : Language
    position : int
        Index into ``solution.positions``.

    Raises
    ------
    IndexError
        When there is no such position.
    """
    count = len(solution.positions)
    if not 0 <= position < count:
        raise IndexError(f"position {position} of {count}: expected 0 to {count - 1}")
    return Document.of(_Protocol(solution, words, position).nodes())


class _Protocol:
    """The chapters of a protocol of one position."""

    def __init__(self, solution: Solution, language: Language, index: int) -> None:
        self.solution, self.language, self.index = solution, language, index
        self.words = language.note
        self.names = Names(solution, self.words)
        self.narrator = Narrator(solution, self.names, index)

    def nodes(self) -> Iterator[Node]:
        """Yield all of it in order."""
        yield from self._head()
        yield from self._scales()
        kind: PlanKind | None = None
        for section in self.names.construction.sections:
            if section.frame and not self.solution.problem.bodies[FRAME].points:
                continue  # guides alone: each is drawn where it is used
            if section.kind is not kind:
                kind = section.kind
                yield from self._open_plan(kind)
            yield from self._section(section)
        yield from self._transfers()
        if self.solution.problem.dynamics is not None:
            from planmethod.note.narrate.forces.protocol import force_chapters

            yield from force_chapters(self.narrator.say, self.index)
        yield from self._results()

    def _transfers(self) -> Iterator[Node]:
        transfers, words = transfers_of(self.solution), self.words
        if transfers is None:
            return
        told = TransferNarrator(self.narrator.say, transfers)
        link = self.solution.problem.drive.link
        end = "" if transfers.steps.even else words.transfer_epsilon.format(link=link)
        yield Chapter(words.title_transfers)
        lead = words.transfer_first.format(link=link)
        yield Step((lead, *closed(told.formulas(PlanKind.VELOCITY))))
        lead = words.transfer_second.format(end=end)
        formula, *sentence = told.carried() or [""]
        if formula:
            yield Step((lead, f"{formula}.", *sentence))
        lead = words.read_off if formula else lead
        yield Step((lead, *closed(told.formulas(PlanKind.ACCELERATION))))

    def _head(self) -> Iterator[Node]:
        words, problem = self.words, self.solution.problem
        yield Title(f"{words.title_protocol}. {escape(problem.title)}")
        if problem.source:
            yield Paragraph(words.source.format(source=escape(problem.source)))
        yield Paragraph(position_line(self.solution, words, self.index))
        yield Paragraph(words.formula.format(formula=self.solution.structure.formula))
        facts = [drawn(problem, self.language), *self._given()]
        yield given_paragraph(facts, self.language)

    def _given(self) -> list[GivenFact]:
        """Return the given facts of this position, with masses and loads where forces follow."""
        if self.solution.problem.dynamics is None:
            position = float(self.solution.positions[self.index])
            return given_facts(self.solution.problem, self.language, [position])
        from planmethod.note.narrate.forces.statement import statement
        from planmethod.solved.forces.reading import ForceReading

        return statement(ForceReading(self.solution, self.index), self.language)

    def _scales(self) -> Iterator[Node]:
        yield Chapter(self.words.scales)
        scales = "; ".join(scale_texts(self.solution, self.language, self.index))
        yield Step((self.words.scales_text.format(scales=scales),))
        ruler = given(self.solution.hand.ruler, self.words)
        yield Step((self.words.ruler.format(ruler=ruler),))

    def _results(self) -> Iterator[Node]:
        solution, words = self.solution, self.language
        yield Chapter(self.words.title_results)
        yield from position_tables(solution, words, self.index)
        if solution.problem.cycle is not None:
            from planmethod.note.tables.turn import cycle_steps, cycle_tables

            yield from cycle_tables(solution, words)
            yield from cycle_steps(solution, words)
        if solution.problem.machine is not None:
            from planmethod.note.tables.machine import machine_steps, machine_tables

            yield from machine_steps(solution, words)
            yield from machine_tables(solution, words)
        if solution.problem.balancing is not None:
            from planmethod.note.tables.balancing import balancing_tables

            yield from balancing_tables(solution, words)

    # Plans of motion -------------------------------------------------------------------------

    def _open_plan(self, kind: PlanKind) -> Iterator[Node]:
        yield Chapter(self.words["plans"][kind.value])
        if kind is PlanKind.POSITION:
            return
        words = self.words
        pole = self.names.construction.plan(kind).pole
        assert pole is not None
        fixed = self.names.others(pole)
        template = words.pole_fixed if fixed else words.pole
        chosen = template.format(pole=self.names.pole(kind), points=", ".join(fixed)) + "."
        yield Step((chosen, words.equation_legend) if kind is PlanKind.VELOCITY else (chosen,))

    def _title(self, section: Section) -> str:
        if section.frame:
            return self.words.frame
        if section.group is None:
            return self.words.driver.format(link=self.solution.problem.drive.link)
        return group_title(section.group, self.words)

    def _section(self, section: Section) -> Iterator[Node]:
        yield Part(self._title(section))
        if section.frame:
            yield from steps_of(self._fixed_points())
        made = {PointName(step.out) for step in section.steps}
        if section.kind is not PlanKind.POSITION:
            yield from self._equations(section.kind, made)
        if section.kind is PlanKind.VELOCITY:
            yield from step_of(self._known_turning(section))
        if section.kind is PlanKind.ACCELERATION:
            yield from steps_of(self._constant_speed(section))
            yield from step_of(self.narrator.motion.without_coriolis(made))
        measured, read = False, []
        for step in section.steps:
            lines = self.narrator.tell(step)
            if self.narrator.is_reading(step):
                read += lines
                continue
            yield from step_of(lines, continues=measured and isinstance(step, Compute))
            measured = isinstance(step, MeasureAlong) or (measured and isinstance(step, Compute))
        yield from step_of(self.narrator.undrawn(section.steps))
        if read:
            yield Step((self.words.read_off, *closed(read)))

    def _fixed_points(self) -> list[Rich]:
        points = []
        for name in self.solution.problem.bodies[FRAME].points:
            place = self.narrator.say.place(PointName(name))
            x, y = (given(value, self.words, 5) for value in (place.real, place.imag))
            points.append(f"{name} ({x}; {y})")
        return [self.words.fixed_points.format(points=", ".join(points))] if points else []

    def _equations(self, kind: PlanKind, made: set[PointName]) -> Iterator[Node]:
        plan = self.names.construction.plan(kind)
        found = [e for e in plan.equations if e.left.head in made]
        if found:
            yield Caption(self.words.equations)
            directed = partial(direction_note, self.names)
            yield Equations(tuple(equation_of(equation, directed) for equation in found))

    def _constant_speed(self, section: Section) -> list[str]:
        drive = self.solution.problem.drive
        if section.group is not None or not drive.is_crank or drive.accelerates:
            return []
        symbol = f"ω_{{{drive.link}}}"
        return [self.words.constant_speed.format(symbol=symbol, link=drive.link)]

    def _known_turning(self, section: Section) -> list[str]:
        """Return the rotation of the group's links if it is known before their plan is drawn."""
        if section.group is None:
            return []
        lines, omega = [], self.names.kin.omega
        own = {step.out for step in section.steps}
        for link in section.group.links:
            if link not in omega:
                index = f"_{{{link}}}"
                lines.append(self.words.translating.format(link=link, index=index))
            elif omega[link] not in own:
                other = self.names.owner(omega[link])
                lines.append(
                    self.words.shared_turning.format(
                        link=link,
                        other=other,
                        symbol=f"ω_{{{link}}}",
                        same=f"ω_{{{other}}}",
                    )
                )
        return lines
