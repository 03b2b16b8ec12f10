"""Sentences of the steps of a construction: the one match over the union of steps (рассказчик).

Each kind of problem has its own narrator, which describes its drawing in its own way. Steps that
are drawn with compasses and ruler alike in every construction are described here, with the names
that the kind gives its points, lines and numbers (`Naming`).
"""

from __future__ import annotations

from typing import Protocol, TypeAlias, assert_never

from planmethod.construct import steps
from planmethod.construct.steps import LineName, NumberName, PointName, Step
from planmethod.note.document import fixed, input_text
from planmethod.note.formula import Rich
from planmethod.note.wording import MessageTable

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

    def exact_value(self, name: NumberName) -> float:
        """Return a number without the error of reading."""

    def line(self, name: LineName) -> Rich:
        """Return a drawn line in the genitive."""

    def direction_vector(self, name: LineName) -> complex:
        """Return a vector along a line of the exact drawing."""

    def length(self, name: NumberName) -> Rich:
        """Return a length that is taken in the compasses, with its unit."""


class StepNarrator:
    """Narrates steps; a step that another step describes gives no lines."""

    def narrate(self, step: Step) -> list[Rich]:
        """Return sentences and formulas of a step; none if another step describes it."""
        match step:
            case steps.GivenPoint():
                return self.describe_given_point(step)
            case steps.GivenNumber():
                return []
            case steps.Join() | steps.Parallel() | steps.Perpendicular() | steps.AtAngle():
                return self.describe_line(step)
            case steps.LayOffLength():
                return self.describe_laid_off_length(step)
            case steps.IntersectLines():
                return self.describe_intersection(step)
            case steps.IntersectLineCircle():
                return self.describe_arc_and_line(step)
            case steps.IntersectCircles():
                return self.describe_two_arcs(step)
            case steps.Touch():
                return self.describe_tangent(step)
            case steps.TriadPose():
                return self.describe_triad(step)
            case steps.Spot():
                return []  # described with its link
            case steps.Similar():
                return self.describe_similar_point(step)
            case steps.Measure() | steps.MeasureAlong():
                return self.describe_measured_segment(step)
            case steps.Compute():
                return self.describe_computed_number(step)
            case steps.Total():
                return self.describe_total(step)
            case steps.Carry() | steps.MeasureArm():
                return []  # of force plans, described with their forces
            case steps.MeasureAngle():
                return []  # added to a finished drawing, whose steps are described
            case _:
                assert_never(step)

    def describe_given_point(self, step: steps.GivenPoint) -> list[Rich]:
        """Describe a given point."""
        return []

    def describe_line(self, step: Line) -> list[Rich]:
        """Describe a line: most are described by the points found on them."""
        return []

    def describe_laid_off_length(self, step: steps.LayOffLength) -> list[Rich]:
        """Describe a length that is laid off."""
        return []

    def describe_intersection(self, step: steps.IntersectLines) -> list[Rich]:
        """Describe the intersection of two lines."""
        return []

    def describe_arc_and_line(self, step: steps.IntersectLineCircle) -> list[Rich]:
        """Describe the intersection of an arc and a line."""
        return []

    def describe_two_arcs(self, step: steps.IntersectCircles) -> list[Rich]:
        """Describe the intersection of two arcs."""
        return []

    def describe_tangent(self, step: steps.Touch) -> list[Rich]:
        """Describe a tangent."""
        return []

    def describe_triad(self, step: steps.TriadPose) -> list[Rich]:
        """Describe how three legs determine the pose of a link."""
        return []

    def describe_similar_point(self, step: steps.Similar) -> list[Rich]:
        """Describe a point found by similarity."""
        return []

    def describe_measured_segment(self, step: Reading) -> list[Rich]:
        """Describe a measured segment."""
        return []

    def describe_computed_number(self, step: steps.Compute) -> list[Rich]:
        """Describe a computed number."""
        return []

    def describe_total(self, step: steps.Total) -> list[Rich]:
        """Describe a sum: most are described with their results."""
        return []


class BoardNarrator(StepNarrator):
    """Narrates steps drawn with compasses and ruler alike in every construction."""

    def __init__(self, naming: Naming, texts: MessageTable) -> None:
        self.naming, self.texts = naming, texts

    def describe_intersection(self, step: steps.IntersectLines) -> list[Rich]:
        """Describe the intersection of two lines."""
        return [
            self.texts.meet.format(
                first=self.naming.line(step.first),
                second=self.naming.line(step.second),
                point=self.naming.point(step.out),
                coincide=self.coincide(step.out),
            )
        ]

    def coincide(self, point: PointName) -> Rich:
        """Return which other points are in the same place."""
        return ""

    def describe_arc_and_line(self, step: steps.IntersectLineCircle) -> list[Rich]:
        """Describe the intersection of an arc and a line."""
        texts, naming = self.texts, self.naming
        course = naming.direction_vector(step.line) * step.sense.value * self._sign(step.branch)
        if abs(course.real) >= abs(course.imag):
            which = texts.rightmost if course.real > 0 else texts.leftmost
        else:
            which = texts.upper if course.imag > 0 else texts.lower
        return [
            texts.arc_and_line.format(
                centre=naming.point(step.centre),
                radius=naming.length(step.radius),
                line=naming.line(step.line),
                way=which,
                point=naming.point(step.out),
            )
        ]

    def describe_two_arcs(self, step: steps.IntersectCircles) -> list[Rich]:
        """Describe the intersection of two arcs."""
        naming = self.naming
        return [
            self.texts.two_arcs.format(
                one=naming.point(step.centre1),
                first=naming.length(step.radius1),
                two=naming.point(step.centre2),
                second=naming.length(step.radius2),
                side=self._side(step.side.value * self._sign(step.branch)),
                point=naming.point(step.out),
            )
        ]

    def describe_tangent(self, step: steps.Touch) -> list[Rich]:
        """Describe a tangent."""
        naming = self.naming
        return [
            self.texts.touch.format(
                centre=naming.point(step.centre),
                radius=naming.length(step.radius),
                source=naming.point(step.source),
                side=self._side(step.side.value),
                point=naming.point(step.out),
            )
        ]

    def describe_measured_segment(self, step: Reading) -> list[Rich]:
        """Describe a measured segment."""
        return [
            self.measured(step).format(
                segment=self.naming.segment(step.tail, step.head),
                length=input_text(abs(self.naming.number(step.out)), self.texts, 5),
                exact=fixed(abs(self.naming.exact_value(step.out)), self.texts),
            )
        ]

    def measured(self, step: Reading) -> str:
        """Return the sentence for a reading."""
        return self.texts.measure

    def _sign(self, branch: NumberName | None) -> float:
        return 1.0 if branch is None else self.naming.number(branch)

    def _side(self, side: float) -> str:
        return self.texts.left if side > 0 else self.texts.right
