"""Names of the points, lines and numbers of a construction for the reader."""

from __future__ import annotations

import re
from collections.abc import Iterator

from msgspec import Struct

from planmethod.construct import steps
from planmethod.construct.steps import LineName, Name, NumberName, PointName, Step
from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.letters import plan_letters
from planmethod.note.plaintext import input_text, plain_text
from planmethod.note.wording import MessageTable
from planmethod.plans.dimensions import DimensionKind
from planmethod.plans.model import (
    FACTS,
    MOTION,
    ZERO_VECTOR,
    Direction,
    Plan,
    PlanKind,
    Relation,
    Vector,
    VectorKind,
    pole_letter,
)
from planmethod.problem.model import Convention
from planmethod.solved.solution import Solution

_DIGITS = r"\d+"
SCALE_KIND = {FACTS[kind].scale: kind for kind in MOTION}
SCALE_SYMBOL = {kind: f"μ_{{{FACTS[kind].letter}}}" for kind in MOTION}


class LineDirection(Struct, frozen=True):
    """Direction of a drawn line: turned by ``angle`` degrees (in (-180, 180]) from ``base``."""

    base: str
    angle: float
    start: PointName | None = None
    end: PointName | None = None


class Names:
    """Names for the reader, of one solution in one language, as rich text (обозначения).

    Points of the plans are called by their letters, points of the mechanism by their own names,
    the feet of offsets by a prime, numbers by their symbols, lines by their parallels.

    Parameters
    ----------
    solution : Solution
    texts : MessageTable
    on_sheet : bool
        For formulas that are lettered: an index is lowered there, so that the ``3`` of ``O3`` is
        one as well, and no dash need keep the ends of a segment apart.
    """

    def __init__(self, solution: Solution, texts: MessageTable, *, on_sheet: bool = False) -> None:
        self.solution, self.texts, self.on_sheet = solution, texts, on_sheet
        self.construction = solution.construction
        self.kinematics = solution.construction.kinematics
        problem = solution.problem
        self.step: dict[Name, Step] = {step.out: step for step in self.construction.program.steps}
        self.letters: dict[PointName, list[str]] = {}
        self.poles: set[PointName] = set()
        for plan in self.construction.plans:
            for at, letters in plan_letters(problem, plan).items():
                self.letters[at] = letters
            assert plan.pole is not None
            self.poles.add(plan.pole)
        self.guides = {
            f"{slide.label}:0": problem.guide_name(slide.label)
            for slide in problem.slides.values()
            if slide.host == FRAME
        }
        self._given = {q + p: p + q for p, q in self._lengths()}
        self._slots: dict[str, str] = {}
        for slide in problem.slides.values():
            if slide.host != FRAME and slide.towards is None and slide.label == slide.through:
                known = self._slots.get(slide.label, slide.host)
                self._slots[slide.label] = slide.host if known == slide.host else ""
        self._auxiliary: dict[PointName, str] = {}
        self._roles = dict(self._number_roles())

    def _lengths(self) -> Iterator[tuple[str, str]]:
        """Yield the ends of every given length, in the order the problem writes them."""
        for body in self.solution.problem.bodies.values():
            points = list(body.points)
            for i, p in enumerate(points):
                for q in points[i + 1 :]:
                    yield (q, p) if self.construction.draft.has_length(q, p) else (p, q)

    # Points ----------------------------------------------------------------------------------

    def point(self, name: PointName) -> str:
        """Return a point's letter or name."""
        if name in self.letters:
            return self.letters[name][0]
        foot_of = self.construction.draft.feet.get(name)
        if foot_of is not None:
            return self._auxiliary_name(name, foot_of + "′")
        if isinstance(self.step.get(name), steps.Touch):
            return self._auxiliary_name(name, "T")
        return self.guides.get(name) or self._lowered(name)

    def _lowered(self, name: str) -> str:
        return re.sub(_DIGITS, r"_{\g<0>}", name) if self.on_sheet else name

    def _auxiliary_name(self, name: PointName, text: str) -> str:
        """Return the name of an auxiliary point, with primes that make it unique."""
        if name not in self._auxiliary:
            while text in self._auxiliary.values() or text in self.solution.points:
                text += "′"
            self._auxiliary[name] = text
        return self._auxiliary[name]

    def further_letters(self, name: PointName) -> list[str]:
        """Return the further letters of a plan point: of points that move alike."""
        return self.letters.get(name, [""])[1:]

    def of(self, name: PointName) -> str:
        """Return a point in the genitive: "точки b", "полюса p"."""
        texts = self.texts
        if name in self.poles:
            return texts.of_pole.format(point=self.point(name))
        if name in self.guides:
            return texts.of_guide_start.format(guide=self.guides[name])
        return texts.of_point.format(point=self.point(name))

    def segment(self, tail: PointName, head: PointName) -> str:
        """Return a segment by its ends: ``bc``, ``BC``, ``b–n_CB``."""
        one, two = self.point(tail), self.point(head)
        apart = "_" in plain_text(one + two) and not self.on_sheet
        return f"{one}–{two}" if apart else one + two

    # Lines -----------------------------------------------------------------------------------

    def axis(self, text: str) -> str:
        """Return the reader's name of a line of a link.

        Its letters are in the order in which its length was given (CB becomes BC); a line that
        is given by one point and an angle is called the guide of its link.
        """
        if text in self._slots:
            link = self._slots[text]
            return self.texts.slot_of.format(link=link) if link else self.texts.slot
        return self._given.get(text, text)

    def base(self, direction: Direction) -> str:
        """Return the reader's name of the line that defines a direction."""
        if direction.relation is Relation.ANGLED:
            return "".join(direction.points)
        return self.axis(direction.guide or "".join(direction.points))

    def direction(self, line: LineName) -> LineDirection:
        """Return the line from which another is rotated, and the angle."""
        step = self.step[line]
        match step:
            case steps.Join(_, tail, head):
                return LineDirection(self.point(tail) + self.point(head), 0.0, tail, head)
            case steps.Parallel(_, through, to):
                found = self.direction(to)
                if through == found.start:  # the same line drawn again
                    return found
                if through == found.end:  # produced beyond its end
                    back = found.base if found.start is None else self.segment(through, found.start)
                    return LineDirection(back, 180.0, through, found.start)
                return LineDirection(found.base, found.angle)
            case steps.Perpendicular(_, _, to):
                found = self.direction(to)
                return LineDirection(found.base, _reduced(found.angle + 90.0))
            case steps.AtAngle(_, _, None, angle):
                guide = self.guide(line)
                if guide is not None:
                    return LineDirection(guide, 0.0)
                if angle == self.solution.problem.drive.program_inputs[0]:
                    drive = self.solution.problem.bodies[self.solution.problem.drive.link]
                    if drive.axis is not None:
                        return LineDirection("".join(drive.axis), 0.0)
                return LineDirection(self.texts.x_axis, self.value_of(angle))
            case steps.AtAngle(_, _, to, angle):
                assert to is not None
                found = self.direction(to)
                return LineDirection(found.base, _reduced(found.angle + self.value_of(angle)))
            case _:
                raise TypeError(f"{step.out} is no line")

    def guide(self, line: LineName) -> str | None:
        """Return the name of the frame's guide that a line is, or None."""
        step = self.step[line]
        if not isinstance(step, steps.AtAngle) or step.to is not None:
            return None
        told = self.construction.draft.dimensions.get(step.angle)
        return None if told is None else self.solution.problem.guide_name(told.of[0])

    def value_of(self, angle: NumberName) -> float:
        """Return a given angle, degrees."""
        return self.construction.draft.numbers.get(angle, 0.0)

    def relation(self, line: LineName) -> str:
        """Return a line's direction in signs: ``⊥ BC``, ``∥ x-x``."""
        found = self.direction(line)
        if found.angle in (0.0, 180.0):
            return f"∥ {self.axis(found.base)}"
        if abs(found.angle) == 90.0:
            return f"⊥ {self.axis(found.base)}"
        angle = input_text(abs(found.angle), self.texts)
        return self.texts.at_angle.format(angle=angle, base=found.base)

    def line(self, line: LineName) -> str:
        """Return a drawn line in the genitive."""
        texts, step = self.texts, self.step[line]
        guide = self.guide(line)
        if guide is not None:
            return texts.line_guide.format(guide=guide)
        if isinstance(step, steps.Join):
            return texts.line_join.format(base=self.direction(line).base)
        assert isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle)
        return texts.line_through.format(of=self.of(step.through), direction=self.relation(line))

    # Numbers ---------------------------------------------------------------------------------

    def _number_roles(self) -> Iterator[tuple[NumberName, str]]:
        drive = self.solution.problem.drive
        yield NumberName("phi"), f"φ_{{{drive.link}}}"
        if not drive.is_crank:
            pin = self.solution.problem.slides[drive.link].pin
            yield NumberName("v"), f"v_{{{pin}}}"
            yield NumberName("a"), f"a_{{{pin}}}"
        for letter, table in (("ω", self.kinematics.omega), ("ε", self.kinematics.epsilon)):
            seen: set[NumberName] = set()
            for link, number in table.items():
                if self.owner(number) == link and number not in seen:
                    seen.add(number)
                    yield number, f"{letter}_{{{link}}}"
        for motion in (self.kinematics.velocity, self.kinematics.acceleration):
            for ends, number in motion.segments.lengths.items():
                yield number, f"({self.segment(*ends)})"
            for ends, number in motion.segments.values.items():
                whole = self.absolute(ends[1]) if ends[0] == motion.pole else ""
                vector = self.vector(*ends)
                if whole or vector is not None:
                    yield number, whole or (vector.symbol if vector else "")

    def owner(self, number: NumberName) -> str:
        """Return the link whose own angular velocity or acceleration a number is."""
        for (kind, link), _ in self.kinematics.turnings.items():
            if self.kinematics.rates(kind).get(link) == number:
                return link
        return self.solution.problem.drive.link

    def symbol(self, number: NumberName) -> str:
        """Return the symbol of a number: ``l_BC``, ``ω₂``, ``(bc)``, ``μ_v``."""
        if number in self._roles:
            return self._roles[number]
        if number in SCALE_KIND:
            return SCALE_SYMBOL[SCALE_KIND[number]]
        step = self.step[number]
        match step:
            case steps.Measure(_, tail, head) if tail not in self.letters:
                return self.segment(tail, head)
            case steps.Measure(_, tail, head) | steps.MeasureAlong(_, tail, head, _):
                return f"({self.segment(tail, head)})"
            case steps.Compute():
                return self._lowered(number.strip("|"))
            case _:
                told = self.construction.draft.dimensions.get(number)
                if told is not None and told.kind is DimensionKind.OFFSET:
                    return f"e_{{{told.of[0]}}}"  # without the link it is counted from
                letter, _, index = number.partition("_")
                return f"{letter}_{{{index}}}" if index else letter

    def is_inverse_scale(self) -> bool:
        """Return whether scales are written as millimetres per unit."""
        return self.solution.problem.scales.convention is Convention.MM_PER_UNIT

    # Vectors ---------------------------------------------------------------------------------

    def plan_of(self, point: PointName) -> Plan | None:
        """Return the velocity or acceleration plan that a point is on."""
        for plan in self.construction.plans:
            if point in plan.letters or point == plan.pole:
                return plan
        return None

    def vector(self, tail: PointName, head: PointName) -> Vector | None:
        """Return the vector that a segment shows, the one with a stated direction first."""
        plan = self.plan_of(tail)
        if plan is None:
            return None
        terms = [term for equation in plan.equations for term in equation.right]
        found = [v for v in (*plan.vectors, *terms) if (v.tail, v.head) == (tail, head)]
        stated = [v for v in found if v.direction not in (None, ZERO_VECTOR)]
        return next(iter(stated or found), None)

    def absolute(self, head: PointName) -> str:
        """Return the symbol of a point's whole velocity or acceleration, empty if it has none."""
        plan = self.plan_of(head)
        if plan is None:
            return ""
        vectors = [*(equation.left for equation in plan.equations), *plan.vectors]
        return next(
            (v.symbol for v in vectors if v.head == head and v.kind is VectorKind.ABSOLUTE),
            "",
        )

    def ray(self, line: LineName) -> Vector | None:
        """Return the unknown component that a line of a plan carries."""
        step = self.step[line]
        if not isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle):
            return None
        plan = self.plan_of(step.through)
        if plan is None:
            return None
        return next(
            (
                term
                for head in self._intersections(line)
                for equation in plan.equations
                for term in equation.right
                if (term.tail, term.head) == (step.through, head) and term.direction
            ),
            None,
        )

    def _intersections(self, line: LineName) -> Iterator[PointName]:
        for step in self.construction.program.steps:
            if line in (getattr(step, "first", None), getattr(step, "second", None)):
                yield PointName(step.out)

    def pole(self, kind: PlanKind) -> str:
        """Return the letter of a plan's pole."""
        return pole_letter(self.solution.problem, kind)


def _reduced(angle: float) -> float:
    """Return an angle in (-180, 180] degrees."""
    return 180.0 - (180.0 - angle) % 360.0
