"""The sentences of a program's steps: one match over the closed union of steps."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import assert_never

from planmethod.construct import steps
from planmethod.construct.steps import LineName, NumberName, PointName, Step, operands
from planmethod.note.narrate.equations import direction_note
from planmethod.note.narrate.formulas import Formulas
from planmethod.note.narrate.motion import MotionNarrator
from planmethod.note.narrate.naming import Names
from planmethod.note.narrate.positions import PositionNarrator
from planmethod.note.plaintext import fixed, given
from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.solved.solution import Solution


class Narrator:
    """Tells the steps of one position in order (рассказчик).

    A step's lines are formulas and sentences. Numbers that are only laid off are computed where
    they are laid off, and lines that only carry a length are named there: their own steps say
    nothing.
    """

    def __init__(self, solution: Solution, names: Names, index: int) -> None:
        self.names, self.words = names, names.words
        self.say = Formulas(solution, names, index)
        self.drawing = PositionNarrator(names, self.say)
        self.motion = MotionNarrator(solution, names, self.say)
        self._drawers: dict[LineName, set[type[Step]]] = {}
        for step in names.construction.program.steps:
            for line in _carriers(step):
                self._drawers.setdefault(line, set()).add(type(step))

        told = names.construction.program.steps
        self._told_later = {
            step.out
            for step, after in pairwise(told)
            if isinstance(step, steps.Measure)
            and step.tail in names.letters
            and step.out in (name for name, _ in operands(after))
        }

    def is_reading(self, step: Step) -> bool:
        """Tell whether a step is the value of a segment that is read for it alone."""
        if not (isinstance(step, steps.Compute) and self.motion.is_value(step)):
            return False
        return not isinstance(self.names.step[step.powers[1][0]], steps.MeasureAlong)

    def tell(self, step: Step) -> list[str]:
        """Return the lines that tell a step; none when another step tells it."""
        if not self.say.readable(step.out) and not self.is_reading(step):
            return self._unreadable(step)
        match step:
            case steps.Given() | steps.Known():
                return []
            case steps.Join() | steps.Parallel() | steps.Perpendicular() | steps.AtAngle():
                return self._line(step)
            case steps.LayOff():
                on_plan = step.out in self.names.letters
                return self.motion.lay_off(step) if on_plan else self.drawing.lay_off(step)
            case steps.MeetLines(out, first, second):
                return [self._meet(out, first, second)]
            case steps.MeetLineCircle():
                return self.drawing.arc_and_line(step)
            case steps.MeetCircles():
                return self.drawing.two_arcs(step)
            case steps.Touch():
                return self.drawing.touch(step)
            case steps.Similar():
                return self.motion.similar(step)
            case steps.Measure(out, tail, head) | steps.MeasureAlong(out, tail, head, _):
                return [] if out in self._told_later else [self._measure(out, tail, head)]
            case steps.Compute():
                return self.motion.compute(step)
            case steps.Carry() | steps.MeasureArm() | steps.Total():
                return []  # of force plans: ForcePlanNarrator tells them with their forces
            case _:
                assert_never(step)

    def write(self, step: Step) -> list[str]:
        """Return the formulas of a step of a velocity or acceleration plan, without sentences."""
        if not self.say.readable(step.out) and not self.is_reading(step):
            return self._unreadable(step)
        match step:
            case steps.LayOff():
                return self.motion.laid(step)
            case steps.Compute():
                return self.motion.found(step)
            case steps.Similar():
                parts, corners = self.motion.parts(step), self.motion.triangles(step)
                return parts if len(parts) == 1 else [" ∼ ".join(f"△{c}" for c in corners), *parts]
            case _:
                return []

    def _unreadable(self, step: Step) -> list[str]:
        """Tell a step that divides by what the ruler reads as 0; none of those that follow."""
        if not self._can(step):
            return []
        if isinstance(step, steps.Compute):
            below = [name for name, power in step.powers if power < 0]
            zero = ", ".join(self.names.symbol(n) for n in below if self.say.number(n) == 0)
            said = {"symbol": self.names.symbol(step.out), "divisor": zero}
        else:
            assert isinstance(step, steps.Similar), step  # no other step divides by what is read
            divisor = self.names.segment(step.link_b, step.link_c)
            said = {"symbol": self.names.point(step.out), "divisor": divisor}
        return [self.words.unreadable.format(**said)]

    def _can(self, step: Step) -> bool:
        """Tell whether the hand has all that a step uses."""
        return all(self.say.readable(name) for name, _ in operands(step))

    def undrawn(self, told: Iterable[Step]) -> list[str]:
        """Return which points of a plan cannot be drawn, for what they hang on is not readable."""
        points = [
            self.names.point(PointName(step.out))
            for step in told
            if step.out in self.names.letters and not self._can(step)
        ]
        return [self.words.unreadable_points.format(points=", ".join(points))] if points else []

    def _line(
        self, step: steps.Join | steps.Parallel | steps.Perpendicular | steps.AtAngle
    ) -> list[str]:
        words, names = self.words, self.names
        guide = names.guide(step.out)
        if guide is not None and isinstance(step, steps.AtAngle):
            return [self.drawing.guide(step, guide)]
        if not self._drawers.get(step.out, set()) & {steps.MeetLines, steps.MeetLineCircle}:
            return []
        if isinstance(step, steps.Join):
            return [words.draw_join.format(base=names.direction(step.out).base) + "."]
        ray = names.ray(step.out)
        base, angle = self.motion.direction(step.out, ray)
        of = names.of(step.through)
        if angle in (0.0, 180.0):
            text = words.draw_parallel.format(of=of, base=base)
        elif abs(angle) == 90.0:
            text = words.draw_perpendicular.format(of=of, base=base)
        else:
            text = words.draw_at_angle.format(of=of, base=base, angle=given(abs(angle), words))
        if ray is not None:
            text += words.carries.format(symbol=ray.symbol)
        return [text + "."]

    def _relation(self, line: LineName) -> str:
        """Return a drawn line in the genitive, its direction as in the equation."""
        step, ray = self.names.step[line], self.names.ray(line)
        if ray is None or isinstance(step, steps.Join):
            return self.names.line(line)
        assert isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle)
        note = direction_note(self.names, ray.direction)
        return self.words.line_through.format(of=self.names.of(step.through), direction=note)

    def _meet(self, out: PointName, first: LineName, second: LineName) -> str:
        return self.words.meet.format(
            first=self._relation(first),
            second=self._relation(second),
            point=self.names.point(out),
            coincide=self.motion.coincide(out),
        )

    def _measure(self, out: NumberName, tail: PointName, head: PointName) -> str:
        on_plan = tail in self.names.letters
        template = self.words.measure if on_plan else self.words.measure_drawing
        return template.format(
            segment=self.names.segment(tail, head),
            length=given(abs(self.say.number(out)), self.words, 5),
            exact=fixed(abs(self.say.exact(out)), self.words),
        )


def _carriers(step: Step) -> tuple[LineName, ...]:
    """Return the lines on which a step puts its point."""
    if isinstance(step, steps.LayOff):
        return (step.along,)
    if isinstance(step, steps.MeetLines):
        return (step.first, step.second)
    if isinstance(step, steps.MeetLineCircle):
        return (step.line,)
    return ()


def calculation(solution: Solution, kind: PlanKind, index: int, words: Language) -> list[str]:
    """Return the formulas of one plan in one position as rich text (расчёт к плану).

    One a line, in the order in which each becomes known: those that a protocol has.
    """
    narrator = Narrator(solution, Names(solution, words.note, on_sheet=True), index)
    sections = (section for section in solution.construction.sections if section.kind is kind)
    lines = (
        line for section in sections for step in section.steps for line in narrator.write(step)
    )
    return [line.rstrip(".") for line in lines]
