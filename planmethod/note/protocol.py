"""Protocol of a construction: its program in words, as a student's note tells it (протокол)."""

from __future__ import annotations

from planmethod.construct.steps import Compute, MeasureAlong, PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.equations import equation_lines
from planmethod.note.narrate.given import given as given_facts
from planmethod.note.narrate.naming import Names
from planmethod.note.narrate.steps import Narrator
from planmethod.note.narrate.structure import group_title
from planmethod.note.plaintext import NO_BREAK, Steps, given, heading, plain_text, wrap
from planmethod.note.tables.results import position_line, position_tables, scale_texts
from planmethod.note.tables.turn import cycle_protocol
from planmethod.note.wording import Words, language, wording
from planmethod.plans.build import Section
from planmethod.plans.model import PlanKind
from planmethod.solved.solution import Solution


def protocol(solution: Solution, *, lang: str = "ru", position: int = 0) -> str:
    """Tell the construction of one position step by step (протокол построения).

    Parameters
    ----------
    solution : Solution
    lang : str
        ``ru`` or ``en``.
    position : int
        Index into ``solution.positions``.

    Returns
    -------
    str
        Plain text, lines of at most 100 columns, ending in a newline.

    Raises
    ------
    UnknownLanguageError
    IndexError
        When there is no such position.
    """
    words = wording(lang)
    count = len(solution.positions)
    if not 0 <= position < count:
        raise IndexError(f"position {position} of {count}: expected 0 to {count - 1}")
    return "\n".join(_Writer(solution, words, position).write()) + "\n"


class _Writer(Steps):
    """Text of a protocol while it is being written."""

    def __init__(self, solution: Solution, words: Words, index: int) -> None:
        super().__init__(words)
        self.solution, self.words, self.index = solution, words, index
        self.names = Names(solution, words)
        self.narrator = Narrator(solution, self.names, index)

    def write(self) -> list[str]:
        words, problem = self.words, self.solution.problem
        self.lines += heading(f"{words.title_protocol}. {problem.title}", "═")
        if problem.source:
            self.lines += wrap(words.source.format(source=problem.source))
        self.lines.append(position_line(self.solution, words, self.index))
        self.lines.append(words.formula.format(formula=self.solution.structure.formula))
        facts = self._given()
        text = "; ".join(plain_text(line).replace(" ", NO_BREAK) for line in facts)
        self.lines += wrap(words.given.format(given=text))
        self.chapter(words.scales)
        scales = "; ".join(scale_texts(self.solution, words, self.index))
        self.item([words.scales_text.format(scales=scales)])
        self.item([words.ruler.format(ruler=given(self.solution.hand.ruler, words))])
        kind: PlanKind | None = None
        for section in self.names.construction.sections:
            if section.frame and not problem.bodies[FRAME].points:
                continue  # guides alone: each is drawn where it is used
            if section.kind is not kind:
                kind = section.kind
                self.chapter(words["plans"][kind.value])
                self._open_plan(kind)
            self._section(section)
        if problem.dynamics is not None:
            self._forces()
        self.chapter(words.title_results)
        self.lines += position_tables(self.solution, words, self.index)
        if problem.dynamics is not None:
            self._force_tables()
        if problem.cycle is not None:
            self.lines += ["", *cycle_protocol(self.solution, language(words.lang))]
        if problem.machine is not None:
            self._machine()
        if problem.balancing is not None:
            from planmethod.note.tables.balancing import balancing_tables

            self.lines += ["", *balancing_tables(self.solution, words)]
        return self.lines

    def _given(self) -> list[str]:
        """Return what the file gives for this position, masses and loads where forces are told."""
        lang = language(self.words.lang)
        if self.solution.problem.dynamics is None:
            position = float(self.solution.positions[self.index])
            return given_facts(self.solution.problem, lang, [position])
        from planmethod.note.narrate.forces.statement import statement
        from planmethod.solved.forces.reading import ForceReading

        return statement(ForceReading(self.solution, self.index), lang)

    # Content ---------------------------------------------------------------------------------

    def _open_plan(self, kind: PlanKind) -> None:
        if kind is PlanKind.POSITION:
            return
        words = self.words
        pole = self.names.construction.plan(kind).pole
        assert pole is not None
        fixed = self.names.others(pole)
        template = words.pole_fixed if fixed else words.pole
        self.item([template.format(pole=self.names.pole(kind), points=", ".join(fixed)) + "."])
        if kind is PlanKind.VELOCITY:
            self.item([words.equation_legend], more=True)

    def _title(self, section: Section) -> str:
        if section.frame:
            return self.words.frame
        if section.group is None:
            return self.words.driver.format(link=self.solution.problem.drive.link)
        return group_title(section.group, self.words)

    def _section(self, section: Section) -> None:
        words = self.words
        self.part(self._title(section))
        if section.frame:
            self._fixed_points()
        made = {PointName(step.out) for step in section.steps}
        if section.kind is not PlanKind.POSITION:
            self._equations(section.kind, made)
        if section.kind is PlanKind.VELOCITY:
            self.item(self._known_turning(section))
        if section.kind is PlanKind.ACCELERATION:
            self.item(self._constant_speed(section))
            self.item(self.narrator.motion.without_coriolis(made))
        measured, read = False, []
        for step in section.steps:
            told = self.narrator.tell(step)
            if self.narrator.is_reading(step):
                read += told
                continue
            told = [line if line.endswith((".", ",", ";")) else f"{line}." for line in told]
            self.item(told, more=measured and isinstance(step, Compute) and bool(told))
            measured = isinstance(step, MeasureAlong) or (measured and isinstance(step, Compute))
        self.item(self.narrator.undrawn(section.steps))
        if read:
            closed = [*(f"{line};" for line in read[:-1]), f"{read[-1]}."]
            self.item([words.read_off, *closed])

    def _forces(self) -> None:
        from planmethod.note.narrate.forces.protocol import tell_forces

        tell_forces(self, self.narrator.say, self.index)

    def _machine(self) -> None:
        from planmethod.note.tables.machine import machine_tables, machine_teller

        tell = machine_teller(self.solution, self.words)
        self.chapter(tell.said.title)
        for sentence in tell.steps():
            self.item([sentence])
        self.lines += ["", *machine_tables(self.solution, self.words)]

    def _force_tables(self) -> None:
        from planmethod.note.tables.forces import forces_tables

        self.lines += ["", *forces_tables(self.solution, self.words, self.index)]

    def _fixed_points(self) -> None:
        points = []
        for name in self.solution.problem.bodies[FRAME].points:
            place = self.narrator.say.place(PointName(name))
            x, y = (given(value, self.words, 5) for value in (place.real, place.imag))
            points.append(f"{name} ({x}; {y})")
        if points:
            self.item([self.words.fixed_points.format(points=", ".join(points))])

    def _equations(self, kind: PlanKind, made: set[PointName]) -> None:
        plan = self.names.construction.plan(kind)
        found = [e for e in plan.equations if e.left.head in made]
        if not found:
            return
        self.lines += [self.words.equations, ""]
        for equation in found:
            self.formulas(equation_lines(equation, self.names))

    def _constant_speed(self, section: Section) -> list[str]:
        drive = self.solution.problem.drive
        if section.group is not None or not drive.is_crank or drive.acceleration != 0:
            return []
        symbol = f"ω_{{{drive.link}}}"
        return [self.words.constant_speed.format(symbol=symbol, link=drive.link)]

    def _known_turning(self, section: Section) -> list[str]:
        """Return how the group's links turn when that is known before its plan is drawn."""
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
