"""Protocol of a construction: its program in words, as in a student's note (протокол)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from msgspec import Struct
from msgspec.structs import replace

from planmethod.arguments import number_of, of_type, text
from planmethod.construct.steps import (
    Compute,
    GivenPoint,
    MeasureAlong,
    PointName,
    Spot,
    Step as DrawnStep,
)
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
    closed,
    input_text,
    step_of,
    steps_of,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.narrate.equations import is_unjoined, known_directions
from planmethod.note.narrate.figure import figure_sentences
from planmethod.note.narrate.naming import (
    Names,
    direction_note,
)
from planmethod.note.narrate.sizes import laid_off_sizes
from planmethod.note.narrate.statement import drawn, given_facts as given_facts, given_paragraph
from planmethod.note.narrate.steps import Narrator
from planmethod.note.narrate.structure import group_title, mobility_formula
from planmethod.note.narrate.transfers import TransferNarrator
from planmethod.note.tables.results import position_line, position_tables, scale_texts
from planmethod.note.wording import Language, get_language
from planmethod.plans.build import Section
from planmethod.plans.model import PlanKind
from planmethod.solved.quantities import transfers_of
from planmethod.solved.solution import Solution


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
    return protocol_document(solution, get_language(text("lang", lang)), position)


def protocol_document(
    solution: Solution,
    language: Language,
    position: int = 0,
    *,
    analytic: bool = False,
    centres: bool = False,
) -> Document:
    """Return the construction of one position step by step (протокол построения).

    Parameters
    ----------
    solution : Solution
    language : Language
    position : int
        Index into ``solution.positions``.
    analytic : bool
        Whether it has the analytic method, too.
    centres : bool
        Whether it has the instant centres, too.

    Raises
    ------
    IndexError
        When there is no such position.
    """
    count = len(solution.positions)
    if not 0 <= position < count:
        raise IndexError(f"position {position} of {count}: expected 0 to {count - 1}")
    protocol = _Protocol(solution, language, position, analytic=analytic, centres=centres)
    return Document.of(protocol.nodes())


class DescribedNode(Struct, frozen=True):
    """A node of a protocol, and the steps of the program that it describes (рассказанное)."""

    node: Node
    steps: tuple[DrawnStep, ...] = ()


class DescribedSection(Struct, frozen=True):
    """A section of the plans as it is described: its titles, its nodes with their steps."""

    section: Section
    plan: str
    title: str
    nodes: tuple[DescribedNode, ...]


def described_sections(
    solution: Solution, language: Language, position: int
) -> tuple[Narrator, list[DescribedSection]]:
    """Return the sections of the plans of motion as described, and their narrator.

    Each step of the program is with one node: that of its own sentence, or the next one.
    """
    protocol = _Protocol(solution, language, position, analytic=False, centres=False)
    found = list[DescribedSection]()
    kind: PlanKind | None = None
    for section in protocol.names.construction.sections:
        if section.frame and not section.steps:
            continue
        opening = list[DescribedNode]()
        if section.kind is not kind:
            kind = section.kind
            nodes_of_plan = protocol.open_plan(kind)
            opening = [DescribedNode(node) for node in nodes_of_plan if isinstance(node, Step)]
        plan = language.note["plans"][section.kind.value]
        nodes = (*opening, *protocol.section_nodes(section))
        found.append(DescribedSection(section, plan, protocol.title(section), nodes))
    return protocol.narrator, found


class _Protocol:
    """The chapters of a protocol of one position."""

    def __init__(
        self, solution: Solution, language: Language, index: int, *, analytic: bool, centres: bool
    ) -> None:
        self.solution, self.language, self.index = solution, language, index
        self.analytic, self.centres = analytic, centres
        self.texts = language.note
        self.names = Names(solution, self.texts)
        self.narrator = Narrator(solution, self.names, index)

    def nodes(self) -> Iterator[Node]:
        """Yield all of it in order."""
        yield from self._head()
        if self.solution.problem.synthesis is not None:
            yield from self._synthesis()
        yield from self._scales()
        kind: PlanKind | None = None
        for section in self.names.construction.sections:
            if section.frame and not section.steps:
                continue
            if section.kind is not kind:
                kind = section.kind
                yield from self.open_plan(kind)
                if section.kind is PlanKind.POSITION and self.solution.problem.drawn is not None:
                    yield Part(self.texts.figure)
                    yield from steps_of(figure_sentences(self.solution, self.language))
            yield from self._section(section)
        yield from self._transfers()
        if self.centres:
            from planmethod.note.tables.centres import centres_chapter

            yield from centres_chapter(self.solution, self.index, self.language)
        if self.analytic:
            from planmethod.note.accounts.projections import analytic_chapter
            from planmethod.note.accounts.voice import STEPS

            yield from analytic_chapter(self.solution, self.index, self.language, STEPS)
        if self.solution.problem.dynamics is not None:
            from planmethod.note.narrate.forces.plan import force_chapters

            yield from force_chapters(self.narrator.formulas, self.index)
        yield from self._results()

    def _synthesis(self) -> Iterator[Node]:
        from planmethod.note.accounts.voice import STEPS
        from planmethod.note.synthesis.account import SynthesisAccount

        yield from SynthesisAccount.of(self.solution, self.language, STEPS).chapter()

    def _transfers(self) -> Iterator[Node]:
        transfers, texts = transfers_of(self.solution), self.texts
        if transfers is None:
            return
        told = TransferNarrator(self.narrator.formulas, transfers)
        link = self.solution.problem.drive.link
        end = "" if transfers.steps.even else texts.transfer_epsilon.format(link=link)
        yield Chapter(texts.title_transfers)
        lead = texts.transfer_first.format(link=link)
        yield Step((lead, *closed(told.formulas(PlanKind.VELOCITY))))
        lead = texts.transfer_second.format(end=end)
        formula, *sentence = told.crank_acceleration_lines() or [""]
        if formula:
            yield Step((lead, f"{formula}.", *sentence))
        lead = texts.read_off if formula else lead
        yield Step((lead, *closed(told.formulas(PlanKind.ACCELERATION))))

    def _head(self) -> Iterator[Node]:
        texts, problem = self.texts, self.solution.problem
        yield Title(f"{texts.title_protocol}. {escape(problem.title)}")
        if problem.source:
            yield Paragraph(texts.source.format(source=escape(problem.source)))
        yield Paragraph(position_line(self.solution, texts, self.index))
        yield Paragraph(texts.formula.format(formula=self.solution.structure.formula))
        notation = problem.sheet.notation
        if notation is not None:  # the file counts pairs
            yield Paragraph(mobility_formula(self.solution.structure, self.language, notation))
        facts = [drawn(problem, self.language), *self._given_facts()]
        yield given_paragraph(facts, self.language)

    def _given_facts(self) -> list[GivenFact]:
        """Return the given facts of this position, with masses and loads where forces follow."""
        if self.solution.problem.dynamics is None:
            position = float(self.solution.positions[self.index])
            return given_facts(self.solution.problem, self.language, [position])
        from planmethod.note.narrate.forces.statement import statement
        from planmethod.solved.forces.reading import ForceReading

        return statement(ForceReading(self.solution, self.index), self.language)

    def _scales(self) -> Iterator[Node]:
        yield Chapter(self.texts.scales)
        scales = "; ".join(scale_texts(self.solution, self.language, self.index))
        yield Step((self.texts.scales_text.format(scales=scales),))
        ruler = input_text(self.solution.ruler_arithmetic.ruler, self.texts)
        yield Step((self.texts.ruler.format(ruler=ruler),))

    def _results(self) -> Iterator[Node]:
        solution, language = self.solution, self.language
        yield Chapter(self.texts.title_results)
        yield from position_tables(solution, language, self.index)
        if solution.problem.cycle is not None:
            from planmethod.note.tables.cycle import cycle_steps, cycle_tables

            yield from cycle_tables(solution, language)
            yield from cycle_steps(solution, language)
        if solution.problem.machine is not None:
            from planmethod.note.accounts.machine import machine_chapter

            yield from machine_chapter(solution, language)
        if solution.problem.balancing is not None:
            from planmethod.note.accounts.machine import balancing_results

            yield from balancing_results(solution, language)

    # Plans of motion -------------------------------------------------------------------------

    def open_plan(self, kind: PlanKind) -> Iterator[Node]:
        """Yield the heading of a plan, and how its pole is chosen."""
        yield Chapter(self.texts["plans"][kind.value])
        if kind is PlanKind.POSITION:
            return
        texts = self.texts
        pole = self.names.construction.plan(kind).pole
        assert pole is not None
        fixed = self.names.further_letters(pole)
        template = texts.pole_fixed if fixed else texts.pole
        chosen = template.format(pole=self.names.pole(kind), points=", ".join(fixed)) + "."
        yield Step((chosen, texts.equation_legend) if kind is PlanKind.VELOCITY else (chosen,))

    def title(self, section: Section) -> str:
        """Return the heading of a section."""
        if section.frame:
            return self.texts.frame
        if section.group is None:
            links = self.solution.problem.drive.links
            if len(links) > 1:
                return self.texts.drivers.format(links=", ".join(links))
            return self.texts.driver.format(link=links[0])
        return group_title(section.group, self.texts)

    def _section(self, section: Section) -> Iterator[Node]:
        yield Part(self.title(section))
        yield from (one.node for one in self.section_nodes(section))

    def section_nodes(self, section: Section) -> Iterator[DescribedNode]:
        """Yield the nodes of a section under its heading, with the steps that they describe.

        A step without a sentence belongs to the next one that has some, or to the last.
        """
        waiting, last = list[DrawnStep](), None
        for node, step in self._described(section):
            if step is not None:
                waiting.append(step)
            if isinstance(step, Spot) and last is not None:  # described with its link
                last = replace(last, steps=(*last.steps, *waiting))
                waiting.clear()
            if node is None:
                continue
            if last is not None:
                yield last
            last = DescribedNode(node, tuple(waiting))
            waiting.clear()
        if last is not None:
            yield replace(last, steps=(*last.steps, *waiting))

    def _described(self, section: Section) -> Iterator[tuple[Node | None, DrawnStep | None]]:
        """Yield nodes and the steps before or with which they are; both where they are one's."""
        given = [step for step in section.steps if isinstance(step, GivenPoint) and section.frame]
        yield from ((None, step) for step in given)
        if section.frame:
            yield from ((node, None) for node in steps_of(self._fixed_points()))
        made = {PointName(step.out) for step in section.steps}
        if section.kind is not PlanKind.POSITION:
            if section.group is not None and is_unjoined(self.solution.problem, section.group):
                links = "–".join(section.group.links)
                yield Step((self.texts.unjoined.format(links=links),)), None
            yield from ((node, None) for node in self._equations(section.kind, made))
        if section.kind is PlanKind.VELOCITY:
            yield from ((node, None) for node in step_of(self._known_turning(section)))
        if section.kind is PlanKind.ACCELERATION:
            yield from ((node, None) for node in steps_of(self._constant_speed(section)))
            without = self.narrator.motion.without_coriolis(made)
            yield from ((node, None) for node in step_of(without))
        measured, read = False, []
        for step in section.steps:
            if step in given:
                continue
            lines = self.narrator.narrate(step)
            if self.narrator.is_reading(step):
                read += lines
                yield None, step
                continue
            continues = measured and isinstance(step, Compute)
            yield next(step_of(lines, continues=continues), None), step
            measured = isinstance(step, MeasureAlong) or continues
        yield from ((node, None) for node in step_of(self.narrator.undrawn(section.steps)))
        if read:
            yield Step((self.texts.read_off, *closed(read))), None

    def _fixed_points(self) -> list[Rich]:
        points = []
        for name in self.solution.problem.bodies[FRAME].points:
            place = self.narrator.formulas.place(PointName(name))
            x, y = (input_text(value, self.texts, 5) for value in (place.real, place.imag))
            points.append(f"{name} ({x}; {y})")
        lines = [self.texts.fixed_points.format(points=", ".join(points))] if points else []
        return [*lines, *laid_off_sizes(self.narrator.formulas)]

    def _equations(self, kind: PlanKind, points: set[PointName]) -> Iterator[Node]:
        found = [one for one in self.names.stated(kind) if one.head in points]
        if found:
            yield Caption(self.texts.equations)
            directed = partial(direction_note, self.names)
            known = known_directions(self.names.construction, self.solution.problem, kind)
            yield Equations(tuple(one.written(directed, known) for one in found))

    def _constant_speed(self, section: Section) -> list[str]:
        drive = self.solution.problem.drive
        if section.group is not None or not drive.is_crank or drive.accelerates:
            return []
        symbol = f"ω_{{{drive.link}}}"
        return [self.texts.constant_speed.format(symbol=symbol, link=drive.link)]

    def _known_turning(self, section: Section) -> list[str]:
        """Return the rotation of the group's links if it is known before their plan is drawn."""
        if section.group is None:
            return []
        lines, omega = [], self.names.kinematics.omega
        own = {step.out for step in section.steps}
        for link in section.group.links:
            if link not in omega:
                index = f"_{{{link}}}"
                lines.append(self.texts.translating.format(link=link, index=index))
            elif omega[link] not in own:
                other = self.names.owner(omega[link])
                lines.append(
                    self.texts.shared_turning.format(
                        link=link,
                        other=other,
                        symbol=f"ω_{{{link}}}",
                        same=f"ω_{{{other}}}",
                    )
                )
        return lines
