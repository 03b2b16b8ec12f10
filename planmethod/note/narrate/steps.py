"""The sentences of a program's steps: one match over the closed union of steps."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import assert_never

from planmethod.construct import steps
from planmethod.construct.steps import LineName, Name, NumberName, PointName, Step, operands
from planmethod.note.narrate.equations import direction_note
from planmethod.note.narrate.formulas import SHORTEST_MM, Formulas
from planmethod.note.narrate.motion import MotionNarrator
from planmethod.note.narrate.naming import Names
from planmethod.note.plaintext import NO_BREAK, fixed, given
from planmethod.note.wording import Language
from planmethod.plans.dimensions import DimensionKind
from planmethod.plans.model import PlanKind
from planmethod.solved.solution import Solution

COORDINATES = (DimensionKind.ALONG, DimensionKind.ACROSS)


class PositionNarrator:
    """Tells the steps that draw the mechanism."""

    def __init__(self, names: Names, say: Formulas) -> None:
        self.names, self.say, self.words = names, say, names.words
        self._told: set[Name] = set()
        draft = names.construction.draft
        self._dimensions, self._feet = draft.dimensions, draft.feet

    def guide(self, step: steps.AtAngle, guide: str) -> str:
        """Tell a guide of the frame."""
        angle = given(self.names.value_of(step.angle), self.words)
        if step.through not in self.names.guides:
            point = self.names.point(step.through)
            return self.words.draw_guide.format(point=point, angle=angle, guide=guide)
        place = self.say.place(step.through)
        x, y = (given(value, self.words, 5) for value in (place.real, place.imag))
        return self.words.draw_guide_at.format(x=x, y=y, angle=angle, guide=guide)

    def lay_off(self, step: steps.LayOff) -> list[str]:
        """Tell a length laid off on the drawing."""
        out, origin, along, length = step.out, step.origin, step.along, step.length
        names, words = self.names, self.words
        point, value = names.point(out), self.say.number(length)
        if abs(value) < SHORTEST_MM:
            symbol = names.symbol(length)
            return [words.zero_length.format(symbol=symbol, point=point, of=names.of(origin))]
        line = names.step[along]
        if (
            isinstance(line, steps.AtAngle)
            and line.angle == "phi"
            and line.to is None
            and value > 0
        ):
            return [
                words.lay_off_at.format(
                    of=names.of(origin),
                    symbol=names.symbol(line.angle),
                    angle=given(self.say.number(line.angle), words),
                    length=self._length(length, (origin, out)),
                    point=point,
                )
            ]
        direction, sense = self._course(along, origin, value)
        text = words.lay_off.format(
            of=names.of(origin),
            direction=direction,
            length=self._length(length, (origin, out)),
            sense=sense,
            point=point,
        )
        return [text]

    def _length(self, name: NumberName, ends: tuple[PointName, PointName] | None = None) -> str:
        """Return a length of the drawing: computed when it is first used, afterwards its value.

        ``ends`` of a length that is laid off name it; one counted from the beginning of a guide
        has no name.
        """
        step, names = self.names.step[name], self.names
        equals = f"{NO_BREAK}={NO_BREAK}"
        number = given(abs(self.say.number(name)), self.words, 5)
        value = f"{number}{NO_BREAK}{self.say.unit('mm')}"
        symbol = "" if self._is_coordinate(name) else names.symbol(name)
        if ends is not None:
            symbol = "" if ends[0] in names.guides else names.segment(*ends)
        if name in self._told or not isinstance(step, steps.Compute):
            return f"{symbol}{equals}{value}" if symbol else value
        self._told.add(name)
        metres = None
        if ends is not None and self._is_distance(name, ends):
            metres = f"l_{names.axis(symbol)}"
        sides = self.say.product(step.powers, step.factor, called=metres)
        return equals.join([*([symbol] if symbol else []), *sides, value])

    def _course(self, line: LineName, origin: PointName, value: float) -> tuple[str, str]:
        """Return which way a signed length is laid off: along what, and in which sense."""
        words, found = self.words, self.names.direction(line)
        base, angle = found.base, found.angle
        forward = value > 0
        if found.start is not None and found.end is not None and found.start == origin:
            if forward == (angle == 0.0):
                return words.along.format(base=base), ""
            back = self.names.point(found.end) + self.names.point(found.start)
            return words.beyond.format(base=back, point=self.names.point(origin)), ""
        if angle in (0.0, 180.0):
            same = forward == (angle == 0.0)
            return words.parallel.format(base=base), "" if same else words.backwards
        if abs(angle) == 90.0:
            left = forward == (angle > 0)
            side = (words.to_left if left else words.to_right).format(base=base)
            return words.perpendicular.format(base=base), side
        if not forward:
            angle = angle - 180.0 if angle > 0 else angle + 180.0
        side = (words.to_left if angle > 0 else words.to_right).format(base=base)
        return words.at_angle.format(angle=given(abs(angle), words), base=base), side

    def _sign(self, step: steps.MeetCircles | steps.MeetLineCircle) -> float:
        return 1.0 if step.branch is None else self.say.number(step.branch)

    def _side(self, side: float) -> str:
        return self.words.left if side > 0 else self.words.right

    def two_arcs(self, step: steps.MeetCircles) -> list[str]:
        """Tell the meeting of two arcs."""
        text = self.words.two_arcs.format(
            one=self.names.point(step.centre1),
            first=self._length(step.radius1),
            two=self.names.point(step.centre2),
            second=self._length(step.radius2),
            side=self._side(step.side.value * self._sign(step)),
            point=self.names.point(step.out),
        )
        return [text]

    def arc_and_line(self, step: steps.MeetLineCircle) -> list[str]:
        """Tell the meeting of an arc and a line."""
        course = self.say.course(step.line) * step.way.value * self._sign(step)
        words = self.words
        if abs(course.real) >= abs(course.imag):
            which = words.rightmost if course.real > 0 else words.leftmost
        else:
            which = words.upper if course.imag > 0 else words.lower
        text = words.arc_and_line.format(
            centre=self.names.point(step.centre),
            radius=self._length(step.radius),
            line=self.names.line(step.line),
            way=which,
            point=self.names.point(step.out),
        )
        return [text]

    def touch(self, step: steps.Touch) -> list[str]:
        """Tell a tangent."""
        text = self.words.touch.format(
            centre=self.names.point(step.centre),
            radius=self._length(step.radius),
            source=self.names.point(step.source),
            side=self._side(step.side.value),
            point=self.names.point(step.out),
        )
        return [text]

    def _is_distance(self, name: NumberName, ends: tuple[PointName, PointName]) -> bool:
        """Tell whether a coordinate of a point is its distance from another: no foot is between."""
        dimension, names = self._dimensions.get(name), self.names
        between = any(end in self._feet or end in names.guides for end in ends)
        return dimension is not None and dimension.kind in COORDINATES and not between

    def _is_coordinate(self, name: NumberName) -> bool:
        """Tell whether a length has no ends to be called by: an offset or a coordinate."""
        dimension = self._dimensions.get(name)
        return dimension is not None and dimension.kind is not DimensionKind.LENGTH


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
        return self.motion.is_reading(step)

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
