"""The sentences of the position plan: arcs, offsets, guides (план положений)."""

from __future__ import annotations

from planmethod.construct import steps
from planmethod.construct.steps import LineName, Name, NumberName, PointName
from planmethod.note.narrate.formulas import SHORTEST_MM, Formulas
from planmethod.note.narrate.naming import Names
from planmethod.note.plaintext import NO_BREAK, given
from planmethod.plans.dimensions import DimensionKind

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
