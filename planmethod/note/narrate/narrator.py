"""Sentences of the steps of a construction: the one match over the union of steps (рассказчик).

Each kind of problem has its own narrator, which describes its drawing in its own way. Steps that
are drawn with compasses and ruler alike in every construction are described here, with the names
that the kind gives its points, lines and numbers (`Naming`).
"""

from __future__ import annotations

from typing import Protocol, TypeAlias, assert_never

from planmethod.construct import steps
from planmethod.construct.steps import LineName, NumberName, PointName, Step
from planmethod.note.formula import Rich
from planmethod.note.plaintext import fixed, given
from planmethod.note.wording import Words

Line: TypeAlias = steps.Join | steps.Parallel | steps.Perpendicular | steps.AtAngle
Reading: TypeAlias = steps.Measure | steps.MeasureAlong


class Naming(Protocol):
    """Names of the parts of a construction, and their values read by hand (обозначения)."""

    def point(self, name: PointName) -> Rich:
        """Return the letter of a point."""

    def of(self, name: PointName) -> Rich:
        """Return a point in the genitive: "точки B", "полюса p"."""

    def segment(self, tail: PointName, head: PointName) -> Rich:
        """Return a segment by its ends: ``BC``."""

    def number(self, name: NumberName) -> float:
        """Return a number as the hand has it."""

    def exact(self, name: NumberName) -> float:
        """Return a number without the error of reading."""

    def line(self, name: LineName) -> Rich:
        """Return a drawn line in the genitive."""

    def course(self, name: LineName) -> complex:
        """Return a vector along a line of the exact drawing."""

    def length(self, name: NumberName) -> Rich:
        """Return a length that is taken in the compasses, with its unit."""


class StepNarrator:
    """Narrates steps; a step that another step describes gives no lines."""

    def tell(self, step: Step) -> list[Rich]:
        """Return sentences and formulas of a step; none if another step describes it."""
        match step:
            case steps.Given():
                return self.given(step)
            case steps.GivenNumber():
                return []
            case steps.Join() | steps.Parallel() | steps.Perpendicular() | steps.AtAngle():
                return self.line(step)
            case steps.LayOff():
                return self.lay_off(step)
            case steps.MeetLines():
                return self.meet(step)
            case steps.MeetLineCircle():
                return self.arc_and_line(step)
            case steps.MeetCircles():
                return self.two_arcs(step)
            case steps.Touch():
                return self.touch(step)
            case steps.Hold():
                return self.hold(step)
            case steps.Spot():
                return []  # described with its link
            case steps.Similar():
                return self.similar(step)
            case steps.Measure() | steps.MeasureAlong():
                return self.measure(step)
            case steps.Compute():
                return self.compute(step)
            case steps.Carry() | steps.MeasureArm() | steps.Total():
                return []  # of force plans, described with their forces; sums, with their results
            case _:
                assert_never(step)

    def given(self, step: steps.Given) -> list[Rich]:
        """Describe a given point."""
        return []

    def line(self, step: Line) -> list[Rich]:
        """Describe a line: most are described by the points found on them."""
        return []

    def lay_off(self, step: steps.LayOff) -> list[Rich]:
        """Describe a length that is laid off."""
        return []

    def meet(self, step: steps.MeetLines) -> list[Rich]:
        """Describe the intersection of two lines."""
        return []

    def arc_and_line(self, step: steps.MeetLineCircle) -> list[Rich]:
        """Describe the intersection of an arc and a line."""
        return []

    def two_arcs(self, step: steps.MeetCircles) -> list[Rich]:
        """Describe the intersection of two arcs."""
        return []

    def touch(self, step: steps.Touch) -> list[Rich]:
        """Describe a tangent."""
        return []

    def hold(self, step: steps.Hold) -> list[Rich]:
        """Describe how three legs determine the pose of a link."""
        return []

    def similar(self, step: steps.Similar) -> list[Rich]:
        """Describe a point found by similarity."""
        return []

    def measure(self, step: Reading) -> list[Rich]:
        """Describe a measured segment."""
        return []

    def compute(self, step: steps.Compute) -> list[Rich]:
        """Describe a computed number."""
        return []


class BoardNarrator(StepNarrator):
    """Narrates steps drawn with compasses and ruler alike in every construction."""

    def __init__(self, naming: Naming, words: Words) -> None:
        self.naming, self.words = naming, words

    def meet(self, step: steps.MeetLines) -> list[Rich]:
        """Describe the intersection of two lines."""
        return [
            self.words.meet.format(
                first=self.naming.line(step.first),
                second=self.naming.line(step.second),
                point=self.naming.point(step.out),
                coincide=self.coincide(step.out),
            )
        ]

    def coincide(self, point: PointName) -> Rich:
        """Return which other points are in the same place."""
        return ""

    def arc_and_line(self, step: steps.MeetLineCircle) -> list[Rich]:
        """Describe the intersection of an arc and a line."""
        words, naming = self.words, self.naming
        course = naming.course(step.line) * step.way.value * self._sign(step.branch)
        if abs(course.real) >= abs(course.imag):
            which = words.rightmost if course.real > 0 else words.leftmost
        else:
            which = words.upper if course.imag > 0 else words.lower
        return [
            words.arc_and_line.format(
                centre=naming.point(step.centre),
                radius=naming.length(step.radius),
                line=naming.line(step.line),
                way=which,
                point=naming.point(step.out),
            )
        ]

    def two_arcs(self, step: steps.MeetCircles) -> list[Rich]:
        """Describe the intersection of two arcs."""
        naming = self.naming
        return [
            self.words.two_arcs.format(
                one=naming.point(step.centre1),
                first=naming.length(step.radius1),
                two=naming.point(step.centre2),
                second=naming.length(step.radius2),
                side=self._side(step.side.value * self._sign(step.branch)),
                point=naming.point(step.out),
            )
        ]

    def touch(self, step: steps.Touch) -> list[Rich]:
        """Describe a tangent."""
        naming = self.naming
        return [
            self.words.touch.format(
                centre=naming.point(step.centre),
                radius=naming.length(step.radius),
                source=naming.point(step.source),
                side=self._side(step.side.value),
                point=naming.point(step.out),
            )
        ]

    def measure(self, step: Reading) -> list[Rich]:
        """Describe a measured segment."""
        return [
            self.measured(step).format(
                segment=self.naming.segment(step.tail, step.head),
                length=given(abs(self.naming.number(step.out)), self.words, 5),
                exact=fixed(abs(self.naming.exact(step.out)), self.words),
            )
        ]

    def measured(self, step: Reading) -> str:
        """Return the sentence for a reading."""
        return self.words.measure

    def _sign(self, branch: NumberName | None) -> float:
        return 1.0 if branch is None else self.naming.number(branch)

    def _side(self, side: float) -> str:
        return self.words.left if side > 0 else self.words.right
