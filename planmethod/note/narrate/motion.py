"""The sentences of the velocity and acceleration plans (планы скоростей и ускорений)."""

from __future__ import annotations

from planmethod.construct.steps import Compute, LayOff, LineName, NumberName, PointName, Similar
from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.formulas import NOTHING, Formulas
from planmethod.note.narrate.letters import SIGN
from planmethod.note.narrate.naming import SCALE_KIND, Names
from planmethod.note.plaintext import given, plain_text
from planmethod.plans.model import PlanKind, Relation, Vector, VectorKind
from planmethod.plans.motion.leads import Relative
from planmethod.solved.solution import Solution

COLLINEAR = 1e-9
"""Ratio of the across to the along part below which three points of a link lie on one line."""


class MotionVoice:
    """Tells the steps that lay vectors off and read them."""

    def __init__(self, solution: Solution, names: Names, say: Formulas) -> None:
        self.solution, self.names, self.say, self.words = solution, names, say, names.words
        self.kin = names.kin
        self._values = {
            number: motion.kind
            for motion in (self.kin.velocity, self.kin.acceleration)
            for number in motion.segments.values.values()
        }

    def direction(self, line: LineName, ray: Vector | None) -> tuple[str, float]:
        """Return base and angle of a line; the equation's own note says them best."""
        stated = None if ray is None else ray.direction
        if stated is not None and stated.relation in SIGN:
            across = stated.relation is Relation.ACROSS
            return self.names.base(stated), 90.0 if across else 0.0
        found = self.names.direction(line)
        return self.names.axis(found.base), found.angle

    def coincide(self, point: PointName) -> str:
        """Return in brackets the further points that a plan point stands for."""
        others = self.names.others(point)
        return self.words.meet_coincide.format(points=", ".join(others)) if others else ""

    def lay_off(self, step: LayOff) -> list[str]:
        """Tell a vector laid off from what is known of it."""
        names, words = self.names, self.words
        vector, made = names.vector(step.origin, step.out), names.step[step.length]
        plan = names.plan_of(step.out)
        assert isinstance(made, Compute) and plan is not None
        segment = names.segment(step.origin, step.out)
        length = abs(self.say.number(step.length))
        symbol = plain_text(vector.symbol) if vector else segment
        point = names.point(step.out)
        if length < NOTHING:
            of = names.of(step.origin)
            return [words.zero_length.format(symbol=symbol, point=point, of=of)]
        lines = self.say.laid(made, f"({segment})", plan.kind, vector)
        direction, sense = self._sense(step, made, vector)
        text = words.lay_off_vector.format(
            of=names.of(step.origin),
            direction=direction,
            segment=segment,
            length=given(length, words, 4),
            sense=sense,
            point=point,
            coincide=self.coincide(step.out),
        )
        return [*lines, text]

    def _sense(self, step: LayOff, made: Compute, vector: Vector | None) -> tuple[str, str]:
        """Return direction and sense of a vector that is laid off."""
        words, names = self.words, self.names
        value, known = self.say.number(step.length), self.names.step[made.powers[0][0]]
        powers = known.powers if isinstance(known, Compute) else ()
        if vector is not None and vector.kind is VectorKind.NORMAL:
            assert vector.direction is not None
            place, joint = vector.direction.points
            base = words.parallel.format(base=names.axis(place + joint))
            return words.sense_normal.format(base=base, tail=place, head=joint), ""
        base, angle = self.direction(step.along, vector)
        template = words.perpendicular if abs(angle) == 90.0 else words.parallel
        direction = template.format(base=base)
        turning = next(
            (n for n, _ in powers if n in (*self.kin.omega.values(), *self._epsilons)),
            None,
        )
        if turning is None:
            return direction, "" if value > 0 else words.backwards
        said = {"sense": self._turn(self.say.number(turning))}
        symbol = names.symbol(turning)
        if vector is not None and vector.kind is VectorKind.CORIOLIS:
            speed = next(n for n, _ in powers if n in self._speeds)
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

    def compute(self, step: Compute) -> list[str]:
        """Tell a number that is a result; one that is laid off is told there."""
        for kind, table in (
            (PlanKind.VELOCITY, self.kin.omega),
            (PlanKind.ACCELERATION, self.kin.epsilon),
        ):
            if step.out in table.values():
                return self._turning(step, kind)
        if not self.is_value(step):
            return []
        plan = self._values[step.out]
        text = self.say.read(step, plan)
        for relative in self.kin.relatives.values():
            if relative.to == FRAME and step.out in (relative.speed, self._along(relative)):
                # On a fixed guide the relative motion is the whole one.
                ends = (relative.start, relative.head)
                if plan is PlanKind.ACCELERATION:
                    assert relative.a_turned is not None and relative.a_head is not None
                    ends = (relative.a_turned, relative.a_head)
                vector, whole = self.names.vector(*ends), self.names.symbol(step.out)
                own = plain_text(vector.symbol) if vector else whole
                return [text.replace(whole, f"{whole} = {own}", 1) if own != whole else text]
        return [text]

    def is_value(self, step: Compute) -> bool:
        """Tell whether a step is what a segment of a plan stands for, by its length."""
        return step.out in self._values and step.powers[0][0] in SCALE_KIND

    def _along(self, relative: Relative) -> NumberName | None:
        """Return the number of a relative acceleration."""
        return self.solution.legend[relative.label("ar")].size

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
            unit = self.solution.legend[str(step.out)].kind.unit
            said = {"place": read.place, "joint": read.joint, "link": link, "sense": sense}
            lines = [
                self.say.formula(symbol, sides, abs(value), unit, more),
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

    def similar(self, step: Similar) -> list[str]:
        """Tell a point found by similarity."""
        names, words, say = self.names, self.words, self.say
        point, coincide = names.point(step.out), self.coincide(step.out)
        b, c = names.point(step.plan_b), names.point(step.plan_c)
        link_b, link_c = say.place(step.link_b), say.place(step.link_c)
        ratio = (say.place(step.link_s) - link_b) / (link_c - link_b)
        side = abs(say.number(step.side))
        if abs(ratio) < COLLINEAR or side == 0:
            return [words.similar_same.format(point=point, other=b, coincide=coincide)]
        if abs(ratio - 1) < COLLINEAR:
            return [words.similar_same.format(point=point, other=c, coincide=coincide)]

        def part(start: PointName) -> str:
            made = names.step[self._length(start, step.out)]
            assert isinstance(made, Compute)
            segment = f"({names.segment(start, step.out)})"
            return say.formula(segment, say.product(made.powers), abs(say.number(made.out)), "mm")

        first = part(step.plan_b)
        said = {"point": point, "coincide": coincide}
        if abs(ratio.imag) >= COLLINEAR * abs(ratio):
            link = f"{step.link_b}{step.link_c}{step.link_s}"
            text = words.similar_triangle.format(plan=f"{b}{c}{point}", link=link, **said)
            return [first + ",", part(step.plan_c) + ".", text]
        said |= {"of": names.of(step.plan_b), "part": names.segment(step.plan_b, step.out)}
        if 0 < ratio.real < 1:
            return [first + ".", words.similar_on.format(segment=f"{b}{c}", **said)]
        ends = (f"{b}{c}", c) if ratio.real > 1 else (f"{c}{b}", b)
        return [
            first + ".",
            words.similar_beyond.format(segment=ends[0], beyond=ends[1], **said),
        ]

    def _length(self, tail: PointName, head: PointName) -> NumberName:
        """Return the number of a segment's length."""
        motions = (self.kin.velocity, self.kin.acceleration)
        lengths = next(m.segments for m in motions if (tail, head) in m.segments.lengths)
        return lengths.drawn((tail, head))

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
        if vector.direction is None:
            return plain_text(vector.symbol)
        return self.names.base(vector.direction)
