"""The sentences of the steps of a linkage: position, velocities, accelerations."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

from planmethod.construct import steps
from planmethod.construct.steps import LineName, Name, NumberName, PointName, Step, operands
from planmethod.mechanism.groups import triad_of
from planmethod.mechanism.model import Revolute
from planmethod.note.document import NO_BREAK, input_text
from planmethod.note.narrate.meshes import MeshFormulas
from planmethod.note.narrate.motion import MotionNarrator
from planmethod.note.narrate.naming import SHORTEST_MM, Formulas, Names, direction_note
from planmethod.note.narrate.narrator import BoardNarrator, Line, Reading
from planmethod.note.wording import Language
from planmethod.plans.model import DimensionKind, PlanKind
from planmethod.plans.motion.groups import leg_place
from planmethod.plans.motion.position import link_of_axis
from planmethod.problem.names import UNITS
from planmethod.solved.solution import Solution

COORDINATES = (DimensionKind.ALONG, DimensionKind.ACROSS)


class PositionNarrator:
    """Narrates the steps that draw the mechanism."""

    def __init__(self, names: Names, formulas: Formulas) -> None:
        self.names, self.formulas, self.texts = names, formulas, names.texts
        self._told: set[Name] = set()
        draft = names.construction.draft
        self._dimensions, self._feet = draft.dimensions, draft.feet

    def guide(self, step: steps.AtAngle, guide: str) -> str:
        """Describe a guide of the frame."""
        angle = input_text(self.names.value_of(step.angle), self.texts)
        if step.through not in self.names.guides:
            point = self.names.point(step.through)
            return self.texts.draw_guide.format(point=point, angle=angle, guide=guide)
        place = self.formulas.place(step.through)
        x, y = (input_text(value, self.texts, 5) for value in (place.real, place.imag))
        return self.texts.draw_guide_at.format(x=x, y=y, angle=angle, guide=guide)

    def describe_laid_off_length(self, step: steps.LayOffLength) -> list[str]:
        """Describe a length laid off on the drawing."""
        out, origin, along, length = step.out, step.origin, step.line, step.length
        names, texts = self.names, self.texts
        point, value = names.point(out), self.formulas.number(length)
        if abs(value) < SHORTEST_MM:
            symbol = names.symbol(length)
            return [texts.zero_length.format(symbol=symbol, point=point, of=names.of(origin))]
        line = names.step[along]
        if (
            isinstance(line, steps.AtAngle)
            and line.angle in names.angles
            and line.to is None
            and value > 0
        ):
            return [
                texts.lay_off_at.format(
                    of=names.of(origin),
                    symbol=names.symbol(line.angle),
                    angle=input_text(self.formulas.number(line.angle), texts),
                    length=self.length(length, (origin, out)),
                    point=point,
                )
            ]
        direction, sense = self._direction_and_sense(along, origin, value)
        text = texts.lay_off.format(
            of=names.of(origin),
            direction=direction,
            length=self.length(length, (origin, out)),
            sense=sense,
            point=point,
        )
        return [text]

    def describe_triad(self, step: steps.TriadPose) -> list[str]:
        """Describe how a base link is found: it moves without one leg, which then fixes it."""
        names, texts, construction = self.names, self.texts, self.names.construction
        base = link_of_axis(step)
        group = construction.structure.group_of(base)
        assert group is not None
        triad, closing = triad_of(group), construction.draft.choice[group.links]
        assert triad is not None
        asked = [
            self._leg(leg, base, leg_place(*own))
            for leg, own in zip(step.legs, triad.legs, strict=True)
        ]
        third = closing.third
        one, two = (text for k, text in enumerate(asked) if k != third)
        points = list(construction.draft.problem.bodies[base].points)
        lead, joint = triad.legs[third]
        dropped = lead.link
        if isinstance(joint, Revolute) and isinstance(lead.joint, Revolute):
            dropped = names.axis(lead.joint.point + joint.point)
        told = [
            texts.hold.format(
                links="–".join((group.links[0], group.links[-1])),
                dropped=dropped,
                base=base,
                leading=texts.hold_by.format(one=one, two=two),
                asked=asked[third],
                points=", ".join(names.point(PointName(point)) for point in points),
            )
        ]
        if closing.other_places and self.formulas.position == closing.start:
            unit = construction.draft.problem.unit
            told.append(
                texts.hold_others.format(
                    point=names.point(PointName(closing.point)),
                    places="; ".join(
                        f"({input_text(z.real * UNITS[unit], texts)}; "
                        f"{input_text(z.imag * UNITS[unit], texts)})"
                        for z in closing.other_places
                    ),
                    nbsp=NO_BREAK,
                    unit=self.formulas.unit(unit),
                )
            )
        return told

    def _leg(self, leg: steps.Leg, base: str, place: str) -> str:
        """Return the condition that a leg imposes on a base link."""
        names, texts = self.names, self.texts
        if leg.line is not None:
            return texts.hold_line.format(point=names.point(PointName(place)))
        assert leg.centre is not None
        centre = names.point(leg.centre)
        if leg.radius is None:
            return texts.hold_through.format(base=base, centre=centre)
        point = names.point(PointName(place))
        return texts.hold_arc.format(point=point, radius=self.length(leg.radius), centre=centre)

    def length(self, name: NumberName, ends: tuple[PointName, PointName] | None = None) -> str:
        """Return a length of the drawing: computed when it is first used, afterwards its value.

        ``ends`` of a length that is laid off name it; one counted from the beginning of a guide
        has no name.
        """
        step, names = self.names.step[name], self.names
        equals = f"{NO_BREAK}={NO_BREAK}"
        number = input_text(abs(self.formulas.number(name)), self.texts, 5)
        value = f"{number}{NO_BREAK}{self.formulas.unit('mm')}"
        symbol = "" if self._is_coordinate(name) else names.symbol(name)
        if ends is not None:
            symbol = "" if ends[0] in names.guides else names.segment(*ends)
        if name in self._told or not isinstance(step, steps.Compute):
            return f"{symbol}{equals}{value}" if symbol else value
        self._told.add(name)
        metres = None
        if ends is not None and self._is_distance(name, ends):
            metres = f"l_{{{names.axis(symbol)}}}"
        sides = self.formulas.product(step.powers, step.factor, called=metres)
        return equals.join([*([symbol] if symbol else []), *sides, value])

    def _direction_and_sense(
        self, line: LineName, origin: PointName, value: float
    ) -> tuple[str, str]:
        """Return the line and the sense in which a signed length is laid off."""
        texts, found = self.texts, self.names.direction(line)
        base, angle = found.base, found.angle
        forward = value > 0
        if found.start is not None and found.end is not None and found.start == origin:
            if forward == (angle == 0.0):
                return texts.along.format(base=base), ""
            back = self.names.point(found.end) + self.names.point(found.start)
            return texts.beyond.format(base=back, point=self.names.point(origin)), ""
        if angle in (0.0, 180.0):
            same = forward == (angle == 0.0)
            return texts.parallel.format(base=base), "" if same else texts.backwards
        if abs(angle) == 90.0:
            left = forward == (angle > 0)
            side = (texts.to_left if left else texts.to_right).format(base=base)
            return texts.perpendicular.format(base=base), side
        if not forward:
            angle = angle - 180.0 if angle > 0 else angle + 180.0
        side = (texts.to_left if angle > 0 else texts.to_right).format(base=base)
        return texts.at_angle.format(angle=input_text(abs(angle), texts), base=base), side

    def _is_distance(self, name: NumberName, ends: tuple[PointName, PointName]) -> bool:
        """Return whether a coordinate of a point is its distance from another, without a foot."""
        dimension, names = self._dimensions.get(name), self.names
        between = any(end in self._feet or end in names.guides for end in ends)
        return dimension is not None and dimension.kind in COORDINATES and not between

    def _is_coordinate(self, name: NumberName) -> bool:
        """Return whether a length has no ends to name it: an offset or a coordinate."""
        dimension = self._dimensions.get(name)
        return dimension is not None and dimension.kind is not DimensionKind.LENGTH


class LinkageNaming:
    """Names of a linkage's drawing, a `planmethod.note.narrate.narrator.Naming`."""

    def __init__(self, names: Names, formulas: Formulas, drawing: PositionNarrator) -> None:
        self._names = names
        self.point, self.of, self.segment = names.point, names.of, names.segment
        self.direction_vector, self.number, self.exact_value = (
            formulas.direction_vector,
            formulas.number,
            formulas.exact_value,
        )
        self.length = drawing.length

    def line(self, name: LineName) -> str:
        """Return a drawn line in the genitive, one of a plan with its direction in the equation."""
        step, ray = self._names.step[name], self._names.ray(name)
        if ray is None or isinstance(step, steps.Join):
            return self._names.line(name)
        assert isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle)
        note = direction_note(self._names, ray.direction)
        return self._names.texts.line_through.format(of=self.of(step.through), direction=note)


class Narrator(BoardNarrator):
    """Narrates the steps of one position in order (рассказчик).

    A step's lines are formulas and sentences. Numbers that are only laid off are computed where
    they are laid off, and lines that only carry a length are named there: their own steps give no
    lines. ``formulas`` writes formulas, where not in the usual way.
    """

    def __init__(
        self, solution: Solution, names: Names, index: int, say: Formulas | None = None
    ) -> None:
        self.names, self.formulas = names, say or Formulas(solution, names, index)
        self.drawing = PositionNarrator(names, self.formulas)
        super().__init__(LinkageNaming(names, self.formulas, self.drawing), names.texts)
        self.motion = MotionNarrator(solution, names, self.formulas)
        self.meshes = MeshFormulas(names, self.formulas)
        self._drawers: dict[LineName, set[type[Step]]] = {}
        for step in names.construction.program.steps:
            for line in _carriers(step):
                self._drawers.setdefault(line, set()).add(type(step))

        told = names.construction.program.steps
        self._narrated_later = {
            step.out
            for step, after in pairwise(told)
            if isinstance(step, steps.Measure)
            and step.tail in names.letters
            and step.out in (name for name, _ in operands(after))
        }

    def is_reading(self, step: Step) -> bool:
        """Return whether a step is the value of a segment that is read for it alone."""
        return self.motion.is_reading(step)

    def narrate(self, step: Step) -> list[str]:
        """Return the lines of a step; none if another step describes it."""
        if not self.formulas.readable(step.out) and not self.is_reading(step):
            return self._unreadable(step)
        return super().narrate(step)

    def describe_laid_off_length(self, step: steps.LayOffLength) -> list[str]:
        """Describe a vector of a plan, or a length of the drawing."""
        on_plan = step.out in self.names.letters
        return (
            self.motion.describe_laid_off_length(step)
            if on_plan
            else self.drawing.describe_laid_off_length(step)
        )

    def describe_similar_point(self, step: steps.Similar) -> list[str]:
        """Describe a point of a plan found by similarity."""
        return self.motion.describe_similar_point(step)

    def describe_triad(self, step: steps.TriadPose) -> list[str]:
        """Describe how a base link is found, and the other assemblies."""
        return self.drawing.describe_triad(step)

    def describe_intersection(self, step: steps.IntersectLines) -> list[str]:
        """Describe the intersection of two lines; for the special point, its purpose."""
        told = super().describe_intersection(step)
        for base, special in self.names.construction.draft.special.items():
            if special.point == step.out:
                point = self.names.point(step.out)
                told.append(self.texts.special_point.format(base=base, point=point))
        numbers = [f"({one.number})" for one in self.names.determining(step.out) if one.number]
        return [*told, *self.names.solved(numbers)]

    def describe_total(self, step: steps.Total) -> list[str]:
        """Describe the angle or rate that a mesh gives."""
        if not self.meshes.has(step.out):
            return []
        return [f"{line}." for line in self.meshes.lines(step.out)]

    def describe_computed_number(self, step: steps.Compute) -> list[str]:
        """Describe a computed number."""
        return self.motion.describe_computed_number(step)

    def coincide(self, point: PointName) -> str:
        """Return which other points of a plan are in the same place."""
        return self.motion.coincide(point)

    def describe_measured_segment(self, step: Reading) -> list[str]:
        """Describe a measured segment, unless its result does."""
        return [] if step.out in self._narrated_later else super().describe_measured_segment(step)

    def measured(self, step: Reading) -> str:
        """Return the sentence for a reading."""
        on_plan = step.tail in self.names.letters
        return self.texts.measure if on_plan else self.texts.measure_drawing

    def write(self, step: Step) -> list[str]:
        """Return the formulas of a step of a velocity or acceleration plan, without sentences."""
        if not self.formulas.readable(step.out) and not self.is_reading(step):
            return self._unreadable(step)
        match step:
            case steps.LayOffLength():
                return self.motion.laid_off_formulas(step)
            case steps.Compute():
                return self.motion.result_formulas(step)
            case steps.Total() if self.meshes.has(step.out):
                return self.meshes.lines(step.out)
            case steps.Similar():
                parts, corners = self.motion.parts(step), self.motion.triangles(step)
                return parts if len(parts) == 1 else [" ∼ ".join(f"△{c}" for c in corners), *parts]
            case _:
                return []

    def _unreadable(self, step: Step) -> list[str]:
        """Describe a step that divides by a reading of 0; not the steps that follow from it."""
        if not self._can(step):
            return []
        if isinstance(step, steps.Compute):
            below = [name for name, power in step.powers if power < 0]
            zero = ", ".join(self.names.symbol(n) for n in below if self.formulas.number(n) == 0)
            said = {"symbol": self.names.symbol(step.out), "divisor": zero}
        else:
            assert isinstance(step, steps.Similar), step  # no other step divides by a reading
            divisor = self.names.segment(step.link_b, step.link_c)
            said = {"symbol": self.names.point(step.out), "divisor": divisor}
        return [self.texts.unreadable.format(**said)]

    def _can(self, step: Step) -> bool:
        """Return whether the hand has all values that a step uses."""
        return all(self.formulas.readable(name) for name, _ in operands(step))

    def undrawn(self, section_steps: Iterable[Step]) -> list[str]:
        """Return the points of a plan that cannot be drawn, as they depend on unreadable values."""
        points = [
            self.names.point(PointName(step.out))
            for step in section_steps
            if step.out in self.names.letters and not self._can(step)
        ]
        return [self.texts.unreadable_points.format(points=", ".join(points))] if points else []

    def describe_line(self, step: Line) -> list[str]:
        """Describe a guide of the frame, or a line on which two points are found."""
        texts, names = self.texts, self.names
        guide = names.guide(step.out)
        if guide is not None and isinstance(step, steps.AtAngle):
            return [self.drawing.guide(step, guide)]
        if not self._drawers.get(step.out, set()) & {
            steps.IntersectLines,
            steps.IntersectLineCircle,
        }:
            return []
        if isinstance(step, steps.Join):
            return [texts.draw_join.format(base=names.direction(step.out).base) + "."]
        ray = names.ray(step.out)
        base, angle = self.motion.direction(step.out, ray)
        of = names.of(step.through)
        if angle in (0.0, 180.0):
            text = texts.draw_parallel.format(of=of, base=base)
        elif abs(angle) == 90.0:
            text = texts.draw_perpendicular.format(of=of, base=base)
        else:
            text = texts.draw_at_angle.format(of=of, base=base, angle=input_text(abs(angle), texts))
        if ray is not None:
            text += texts.carries.format(symbol=ray.symbol)
        return [text + "."]


def _carriers(step: Step) -> tuple[LineName, ...]:
    """Return the lines on which a step puts its point."""
    if isinstance(step, steps.LayOffLength):
        return (step.line,)
    if isinstance(step, steps.IntersectLines):
        return (step.first, step.second)
    if isinstance(step, steps.IntersectLineCircle):
        return (step.line,)
    return ()


def calculation(solution: Solution, kind: PlanKind, index: int, language: Language) -> list[str]:
    """Return the formulas of one plan in one position as rich text (расчёт к плану).

    One a line, in the order in which each becomes known: those that a protocol has.
    """
    narrator = Narrator(solution, Names(solution, language.note, on_sheet=True), index)
    sections = (section for section in solution.construction.sections if section.kind is kind)
    lines = list[str]()
    for section in sections:
        links = section.group.links if section.group is not None else ()
        lines += narrator.motion.known_rates(kind, links)
        lines += (line for step in section.steps for line in narrator.write(step))
    return [line.rstrip(".") for line in lines]
