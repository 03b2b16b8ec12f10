"""The sentences of a program's steps: one match over the closed union of steps."""

from __future__ import annotations

from typing import assert_never

from planmethod.construct.steps import (
    AtAngle,
    Compute,
    Given,
    Join,
    Known,
    LayOff,
    LineName,
    Measure,
    MeasureAlong,
    MeetCircles,
    MeetLineCircle,
    MeetLines,
    Name,
    NumberName,
    Parallel,
    Perpendicular,
    PointName,
    Side,
    Similar,
    Step,
    Touch,
)
from planmethod.mechanism.model import FRAME
from planmethod.note.equations import note_text
from planmethod.note.formulas import NOTHING, TURNING_UNIT, UNIT, Formulas
from planmethod.note.naming import Names
from planmethod.note.plaintext import NO_BREAK, fixed, given, plain_text
from planmethod.plans.model import PlanKind, Vector, VectorKind
from planmethod.plans.solution import Solution

COLLINEAR = 1e-9
"""Ratio of the across to the along part below which three points of a link lie on one line."""


class Narrator:
    """Tells the steps of one position in order (рассказчик).

    A step's lines are formulas and sentences. Numbers that are only laid off are computed where
    they are laid off, and lines that only carry a length are named there: their own steps say
    nothing.
    """

    def __init__(self, solution: Solution, names: Names, index: int) -> None:
        self.solution, self.names, self.words = solution, names, names.words
        self.say = Formulas(solution, names, index)
        self.kin = names.kin
        self.laid: set[tuple[PointName, PointName]] = set()
        self.computed: set[tuple[PointName, PointName]] = set()
        self._told: set[Name] = set()
        self._drawers: dict[LineName, set[type[Step]]] = {}
        for step in names.construction.program.steps:
            for line in _carriers(step):
                self._drawers.setdefault(line, set()).add(type(step))

    def tell(self, step: Step) -> list[str]:
        """Return the lines that tell a step; none when another step tells it."""
        match step:
            case Given() | Known():
                return []
            case Join() | Parallel() | Perpendicular() | AtAngle():
                return self._line(step)
            case LayOff(out, origin, along, length):
                if out in self.names.letters:
                    return self._lay_off_vector(step)
                return self._lay_off(out, origin, along, length)
            case MeetLines(out, first, second):
                return [self._meet(out, first, second)]
            case MeetLineCircle():
                return self._arc_and_line(step)
            case MeetCircles():
                return self._two_arcs(step)
            case Touch():
                return self._touch(step)
            case Similar():
                return self._similar(step)
            case Measure(_, tail, head):
                return [self._measure(tail, head)]
            case MeasureAlong(_, tail, head, _):
                return [self._measure(tail, head)]
            case Compute():
                return self._compute(step)
            case _:
                assert_never(step)

    # Lines -----------------------------------------------------------------------------------

    def _line(self, step: Join | Parallel | Perpendicular | AtAngle) -> list[str]:
        words, names = self.words, self.names
        guide = names.guide(step.out)
        if guide is not None and isinstance(step, AtAngle):
            return [self._guide(step, guide)]
        if not self._drawers.get(step.out, set()) & {MeetLines, MeetLineCircle}:
            return []
        if isinstance(step, Join):
            return [words.draw_join.format(base=names.direction(step.out).base) + "."]
        ray = names.ray(step.out)
        base, angle = self._direction(step.out, ray)
        of = names.of(step.through)
        if angle in (0.0, 180.0):
            text = words.draw_parallel.format(of=of, base=base)
        elif abs(angle) == 90.0:
            text = words.draw_perpendicular.format(of=of, base=base)
        else:
            text = words.draw_at_angle.format(of=of, base=base, angle=given(abs(angle), words))
        if ray is not None:
            text += words.carries.format(symbol=plain_text(ray.symbol))
        return [text + "."]

    def _direction(self, line: LineName, ray: Vector | None) -> tuple[str, float]:
        """Return base and angle of a line; the equation's own note says them best."""
        if ray is not None and ray.note[:1] in ("⊥", "∥"):
            sign, _, base = note_text(self.names, ray.note).partition(" ")
            return base, 90.0 if sign == "⊥" else 0.0
        found = self.names.direction(line)
        return self.names.axis(found.base), found.angle

    def _relation(self, line: LineName) -> str:
        """Return a drawn line in the genitive, its direction as in the equation."""
        step, ray = self.names.step[line], self.names.ray(line)
        if ray is None or isinstance(step, Join):
            return self.names.line(line)
        assert isinstance(step, Parallel | Perpendicular | AtAngle)
        note = note_text(self.names, ray.note)
        return self.words.line_through.format(of=self.names.of(step.through), direction=note)

    def _guide(self, step: AtAngle, guide: str) -> str:
        angle = given(self.names.value_of(step.angle), self.words)
        if step.through not in self.names.guides:
            point = self.names.point(step.through)
            return self.words.draw_guide.format(point=point, angle=angle, guide=guide)
        place = self.say.place(step.through)
        x, y = (given(value, self.words, 5) for value in (place.real, place.imag))
        return self.words.draw_guide_at.format(x=x, y=y, angle=angle, guide=guide)

    # Position plan ---------------------------------------------------------------------------

    def _length(self, name: NumberName, ends: tuple[PointName, PointName] | None = None) -> str:
        """Return a length of the drawing: computed when it is first used, afterwards its value.

        ``ends`` of a length that is laid off name it; one counted from the beginning of a guide
        has no name.
        """
        step, names = self.names.step[name], self.names
        equals = f"{NO_BREAK}={NO_BREAK}"
        number = given(abs(self.say.number(name)), self.words, 5)
        value = f"{number}{NO_BREAK}{self.say.unit('mm')}"
        symbol = "" if _is_coordinate(name) else names.symbol(name)
        if ends is not None:
            symbol = "" if ends[0] in names.guides else names.segment(*ends)
        if name in self._told or not isinstance(step, Compute):
            return f"{symbol}{equals}{value}" if symbol else value
        self._told.add(name)
        metres = None
        if ends is not None and _is_distance(name, ends):
            metres = f"l_{names.axis(symbol)}"
        sides = self.say.product(step.powers, step.factor, called=metres)
        return equals.join([*([symbol] if symbol else []), *sides, value])

    def _lay_off(
        self, out: PointName, origin: PointName, along: LineName, length: NumberName
    ) -> list[str]:
        names, words = self.names, self.words
        point, value = names.point(out), self.say.number(length)
        if abs(value) < NOTHING:
            symbol = names.symbol(length)
            return [words.zero_length.format(symbol=symbol, point=point, of=names.of(origin))]
        step = names.step[along]
        if isinstance(step, AtAngle) and step.angle == "phi" and step.to is None and value > 0:
            return [
                words.lay_off_at.format(
                    of=names.of(origin),
                    symbol=names.symbol(step.angle),
                    angle=given(self.say.number(step.angle), words),
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

    def _side(self, side: Side) -> str:
        return self.words.left if side is Side.LEFT else self.words.right

    def _two_arcs(self, step: MeetCircles) -> list[str]:
        text = self.words.two_arcs.format(
            one=self.names.point(step.centre1),
            first=self._length(step.radius1),
            two=self.names.point(step.centre2),
            second=self._length(step.radius2),
            side=self._side(step.side),
            point=self.names.point(step.out),
        )
        return [text]

    def _arc_and_line(self, step: MeetLineCircle) -> list[str]:
        course = self.say.course(step.line) * step.way.value
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

    def _touch(self, step: Touch) -> list[str]:
        text = self.words.touch.format(
            centre=self.names.point(step.centre),
            radius=self._length(step.radius),
            source=self.names.point(step.source),
            side=self._side(step.side),
            point=self.names.point(step.out),
        )
        return [text]

    # Velocity and acceleration plans ---------------------------------------------------------

    def _coincide(self, point: PointName) -> str:
        others = self.names.others(point)
        return self.words.meet_coincide.format(points=", ".join(others)) if others else ""

    def _meet(self, out: PointName, first: LineName, second: LineName) -> str:
        return self.words.meet.format(
            first=self._relation(first),
            second=self._relation(second),
            point=self.names.point(out),
            coincide=self._coincide(out),
        )

    def _lay_off_vector(self, step: LayOff) -> list[str]:
        names, words = self.names, self.words
        vector, compute = names.vector(step.origin, step.out), names.step[step.length]
        plan = names.plan_of(step.out)
        assert isinstance(compute, Compute) and plan is not None
        self.laid.add((step.origin, step.out))
        segment = names.segment(step.origin, step.out)
        length = abs(self.say.number(step.length))
        symbol = plain_text(vector.symbol) if vector else segment
        point = names.point(step.out)
        if length < NOTHING:
            of = names.of(step.origin)
            return [words.zero_length.format(symbol=symbol, point=point, of=of)]
        lines = self.say.laid(compute, f"({segment})", plan.kind, vector)
        direction, sense = self._sense(step, compute, vector)
        text = words.lay_off_vector.format(
            of=names.of(step.origin),
            direction=direction,
            segment=segment,
            length=given(length, words, 4),
            sense=sense,
            point=point,
            coincide=self._coincide(step.out),
        )
        return [*lines, text]

    def _sense(self, step: LayOff, compute: Compute, vector: Vector | None) -> tuple[str, str]:
        """Return direction and sense of a vector that is laid off."""
        words, names = self.words, self.names
        value = self.say.number(step.length)
        if vector is not None and vector.kind is VectorKind.NORMAL:
            place, _, joint = (
                text.strip() for text in note_text(names, vector.note).partition("→")
            )
            base = words.parallel.format(base=names.axis(place + joint))
            return words.sense_normal.format(base=base, tail=place, head=joint), ""
        base, angle = self._direction(step.along, vector)
        template = words.perpendicular if abs(angle) == 90.0 else words.parallel
        direction = template.format(base=base)
        turning = next(
            (n for n, _ in compute.powers if n in (*self.kin.omega.values(), *self._epsilons)),
            None,
        )
        if turning is None:
            return direction, "" if value > 0 else words.backwards
        said = {"sense": self._turn(self.say.number(turning))}
        symbol = names.symbol(turning)
        if vector is not None and vector.kind is VectorKind.CORIOLIS:
            speed = next(n for n, _ in compute.powers if n in self._speeds)
            relative = names.symbol(speed)
            return direction, words.sense_coriolis.format(relative=relative, omega=symbol, **said)
        return direction, words.sense_of.format(symbol=symbol, **said)

    @property
    def _epsilons(self) -> tuple[NumberName, ...]:
        return tuple(self.kin.epsilon.values())

    @property
    def _speeds(self) -> tuple[NumberName, ...]:
        return tuple(relative.speed for relative in self.kin.relatives.values())

    def _turn(self, value: float) -> str:
        return self.words.ccw if value > 0 else self.words.cw

    def _measure(self, tail: PointName, head: PointName) -> str:
        on_plan = tail in self.names.letters
        template = self.words.measure if on_plan else self.words.measure_drawing
        return template.format(
            segment=self.names.segment(tail, head),
            length=given(self.say.read(tail, head), self.words, 5),
            exact=fixed(self.say.true_length(tail, head), self.words),
        )

    def _compute(self, step: Compute) -> list[str]:
        """Tell a number that is a result; one that is laid off is told there."""
        for kind, table in (
            (PlanKind.VELOCITY, self.kin.omega),
            (PlanKind.ACCELERATION, self.kin.epsilon),
        ):
            if step.out in table.values():
                return self._turning(step, kind)
        for relative in self.kin.relatives.values():
            if relative.speed == step.out:
                self.computed.add((relative.start, relative.head))
                value = abs(self.say.number(step.out))
                exact = self.say.exactly(abs(self.say.exact(step.out)))
                sides = self.say.product(step.powers, step.factor)
                symbol, unit = self.names.symbol(step.out), UNIT[PlanKind.VELOCITY]
                if relative.to == FRAME:  # on a fixed guide the relative velocity is the whole one
                    whole = self.names.absolute(relative.head)
                    symbol = f"{whole} = {symbol}" if whole else symbol
                return [self.say.formula(symbol, sides, value, unit, exact + ".")]
        return []

    def _turning(self, step: Compute, kind: PlanKind) -> list[str]:
        words, link = self.words, self.names.owner(step.out)
        symbol, value = self.names.symbol(step.out), self.say.number(step.out)
        read = self.kin.turnings[kind, link]
        segment = self.names.segment(read.start, read.head)
        if value == 0:
            lines = [words.turning_zero.format(symbol=symbol, segment=segment)]
        else:
            sense = self._turn(value)
            exact = self.say.exactly(abs(self.say.exact(step.out)))
            sides = self.say.product(step.powers, step.factor)
            more = f"{exact}, {sense}."
            said = {"place": read.place, "joint": read.joint, "link": link, "sense": sense}
            lines = [
                self.say.formula(symbol, sides, abs(value), TURNING_UNIT[kind], more),
                words.turning.format(segment=f"({segment})", **said),
            ]
        table = self.kin.omega if kind is PlanKind.VELOCITY else self.kin.epsilon
        letter = symbol[0]
        for other, number in table.items():
            if number == step.out and other != link and self._same_group(link, other):
                own = plain_text(f"{letter}_{{{other}}}")
                lines.append(
                    words.shared_turning.format(link=other, other=link, symbol=own, same=symbol)
                )
        return lines

    def _same_group(self, one: str, other: str) -> bool:
        structure = self.solution.structure
        return structure.group_of(one) == structure.group_of(other)

    def _similar(self, step: Similar) -> list[str]:
        names, words, say = self.names, self.words, self.say
        point, coincide = names.point(step.out), self._coincide(step.out)
        b, c = names.point(step.plan_b), names.point(step.plan_c)
        link_b, link_c = say.place(step.link_b), say.place(step.link_c)
        ratio = (say.place(step.link_s) - link_b) / (link_c - link_b)
        side = say.read(step.plan_b, step.plan_c)
        if abs(ratio) < COLLINEAR or side == 0:
            return [words.similar_same.format(point=point, other=b, coincide=coincide)]
        if abs(ratio - 1) < COLLINEAR:
            return [words.similar_same.format(point=point, other=c, coincide=coincide)]
        whole = f"({names.segment(step.plan_b, step.plan_c)})"
        span = self._drawn(step.link_b, step.link_c, read=step.read_span)

        def part(start: PointName, corner: PointName) -> str:
            arm = self._drawn(corner, step.link_s, read=step.read_arm)
            link = names.axis(f"{corner}{step.link_s}")
            base = names.axis(f"{step.link_b}{step.link_c}")
            sides = say.fraction(
                [(whole, side, 1, False), (link, arm, 1, False), (base, span, -1, False)]
            )
            segment = f"({names.segment(start, step.out)})"
            return say.formula(segment, sides, side * arm / span, "mm")

        first = part(step.plan_b, step.link_b)
        said = {"point": point, "coincide": coincide}
        if abs(ratio.imag) >= COLLINEAR * abs(ratio):
            link = f"{step.link_b}{step.link_c}{step.link_s}"
            text = words.similar_triangle.format(plan=f"{b}{c}{point}", link=link, **said)
            return [first + ",", part(step.plan_c, step.link_c) + ".", text]
        said |= {"of": names.of(step.plan_b), "part": names.segment(step.plan_b, step.out)}
        if 0 < ratio.real < 1:
            return [first + ".", words.similar_on.format(segment=f"{b}{c}", **said)]
        ends = (f"{b}{c}", c) if ratio.real > 1 else (f"{c}{b}", b)
        return [
            first + ".",
            words.similar_beyond.format(segment=ends[0], beyond=ends[1], **said),
        ]

    def _drawn(self, tail: PointName, head: PointName, *, read: bool) -> float:
        """Return a segment of the drawing, mm: read with the ruler, or given by its length."""
        return self.say.read(tail, head) if read else self.say.true_length(tail, head)

    # After a group ---------------------------------------------------------------------------

    def readings(self, kind: PlanKind, made: set[PointName]) -> list[str]:
        """Return the quantities read off a plan whose segments end in the points just made."""
        plan = self.names.construction.plan(kind)
        lines = []
        for vector in plan.vectors:
            ends = (vector.tail, vector.head)
            if vector.head in made and ends not in self.laid | self.computed:
                lines.append(self.say.scaled(vector, kind))
        return lines

    def without_coriolis(self, made: set[PointName]) -> list[str]:
        """Return which Coriolis accelerations vanish because the guide does not turn."""
        lines = []
        for relative in self.kin.relatives.values():
            if relative.a_head not in made or relative.to in self.kin.omega:
                continue
            head = self.names.vector(relative.start, relative.head)
            if head is None:
                continue
            index = self._index(relative.start, relative.head)
            symbol = plain_text(f"a^{{k}}_{{{index}}}")
            if relative.to == FRAME:
                lines.append(
                    self.words.no_coriolis_frame.format(symbol=symbol, guide=self._track(head))
                )
            else:
                lines.append(self.words.no_coriolis_link.format(symbol=symbol, link=relative.to))
        return lines

    def _index(self, start: PointName, head: PointName) -> str:
        """Return the index of a relative velocity as its equation has it: ``CC0``."""
        plan = self.names.construction.plan(PlanKind.VELOCITY)
        for equation in plan.equations:
            for term in equation.right:
                if term.kind is VectorKind.SLIDING and (term.tail, term.head) == (start, head):
                    return term.symbol.partition("_{")[2].rstrip("}")
        return self.names.point(head)

    def _track(self, vector: Vector) -> str:
        return note_text(self.names, vector.note).partition(" ")[2] or plain_text(vector.symbol)


def _carriers(step: Step) -> tuple[LineName, ...]:
    """Return the lines on which a step puts its point."""
    if isinstance(step, LayOff):
        return (step.along,)
    if isinstance(step, MeetLines):
        return (step.first, step.second)
    if isinstance(step, MeetLineCircle):
        return (step.line,)
    return ()


def _is_distance(name: NumberName, ends: tuple[PointName, PointName]) -> bool:
    """Tell whether a coordinate of a point is its distance from another: no foot is between."""
    return name[1:3] in ("x_", "y_") and not any("~" in end or ":" in end for end in ends)


def _is_coordinate(name: NumberName) -> bool:
    """Tell whether a length has no ends to be called by: an offset or a coordinate."""
    return name == "|s|" or name[1:3] in ("x_", "y_", "e_")
