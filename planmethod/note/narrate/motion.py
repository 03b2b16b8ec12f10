"""The sentences of the velocity and acceleration plans (планы скоростей и ускорений)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from math import hypot, prod

from planmethod.construct.steps import (
    Compute,
    GivenNumber,
    LayOffLength,
    LineName,
    MeasureAlong,
    NumberName,
    PointName,
    Similar,
    Step,
)
from planmethod.mechanism.model import FRAME
from planmethod.note.document import input_text
from planmethod.note.formula import root
from planmethod.note.narrate.naming import SCALE_KIND, SHORTEST_MM, SIGN, Formulas, Names
from planmethod.plans.build import ZERO, Quantity
from planmethod.plans.model import FACTS, RATES, PlanKind, Relation, Vector, VectorKind
from planmethod.plans.motion.legs import Relative
from planmethod.problem.quantities import QuantityKind
from planmethod.solved.solution import Solution

UNDRAWN = 0.1
"""Part of a division of the ruler below which a segment is too small to be laid off."""

UNDRAWN = 0.1
"""Part of a division of the ruler below which a segment is too small to be laid off."""

COLLINEAR = 1e-9
"""Ratio of transverse to axial part below which three points of a link are collinear."""


class MotionNarrator:
    """Narrates the steps that lay vectors off and read them."""

    def __init__(self, solution: Solution, names: Names, formulas: Formulas) -> None:
        self.solution, self.names, self.formulas, self.texts = (
            solution,
            names,
            formulas,
            names.texts,
        )
        self.kinematics = names.kinematics
        self._values = {
            number: motion.kind
            for motion in (self.kinematics.velocity, self.kinematics.acceleration)
            for number in motion.segments.values.values()
        }

    def direction(self, line: LineName, ray: Vector | None) -> tuple[str, float]:
        """Return base and angle of a line; the equation's own note says them best."""
        stated = None if ray is None else ray.direction
        if stated is not None and stated.relation in SIGN:
            across = stated.relation is Relation.PERPENDICULAR
            return self.names.base(stated), 90.0 if across else 0.0
        found = self.names.direction(line)
        return self.names.axis(found.base), found.angle

    def coincide(self, point: PointName) -> str:
        """Return in brackets the further points that a plan point represents."""
        others = self.names.further_letters(point)
        return self.texts.meet_coincide.format(points=", ".join(others)) if others else ""

    def describe_laid_off_length(self, step: LayOffLength) -> list[str]:
        """Describe the laying off of a vector from its known data."""
        names, texts = self.names, self.texts
        vector, point = names.vector(step.origin, step.out), names.point(step.out)
        segment, length = (
            names.segment(step.origin, step.out),
            abs(self.formulas.number(step.length)),
        )
        if length < SHORTEST_MM:
            symbol, of = vector.symbol if vector else segment, names.of(step.origin)
            return [texts.zero_length.format(symbol=symbol, point=point, of=of)]
        if length < self.solution.profile.ruler * UNDRAWN:
            small = texts.small_length.format(
                segment=segment,
                length=input_text(length, texts, 2),
                point=point,
                of=names.of(step.origin),
                coincide=self.coincide(step.out),
            )
            return [*self.laid_off_formulas(step), small]
        direction, sense = self._sense(step, vector)
        text = texts.lay_off_vector.format(
            of=names.of(step.origin),
            direction=direction,
            segment=segment,
            length=input_text(length, texts, 4),
            sense=sense,
            point=point,
            coincide=self.coincide(step.out),
        )
        return [*self.laid_off_formulas(step), text]

    def laid_off_formulas(self, step: LayOffLength) -> list[str]:
        """Return the formulas of a vector that is laid off, and of its length."""
        plan, made = self.names.plan_of(step.out), self._length_step(step)
        assert plan is not None
        segment = self.names.segment(step.origin, step.out)
        vector = self.names.vector(step.origin, step.out)
        return self.formulas.laid_off_formulas(made, f"({segment})", plan.kind, vector)

    def _length_step(self, step: LayOffLength) -> Compute:
        made = self.names.step[step.length]
        assert isinstance(made, Compute)
        return made

    def _sense(self, step: LayOffLength, vector: Vector | None) -> tuple[str, str]:
        """Return direction and sense of a vector that is laid off."""
        texts, names = self.texts, self.names
        value = self.formulas.number(step.length)
        known = names.step[self._length_step(step).powers[0][0]]
        powers = known.powers if isinstance(known, Compute) else ()
        if vector is not None and vector.kind is VectorKind.NORMAL:
            assert vector.direction is not None
            place, joint = vector.direction.ends
            base = texts.parallel.format(base=names.axis(place + joint))
            return texts.sense_normal.format(base=base, tail=place, head=joint), ""
        base, angle = self.direction(step.line, vector)
        template = texts.perpendicular if abs(angle) == 90.0 else texts.parallel
        direction = template.format(base=base)
        turning = next(
            (n for n, _ in powers if n in (*self.kinematics.omega.values(), *self._epsilons)),
            None,
        )
        if turning is None:
            return direction, "" if value > 0 else texts.backwards
        said = {"sense": self._sense_word(self.formulas.number(turning))}
        symbol = names.symbol(turning)
        if vector is not None and vector.kind is VectorKind.CORIOLIS:
            speed = next(n for n, _ in powers if n in self._speeds)
            relative = names.symbol(speed)
            return direction, texts.sense_coriolis.format(relative=relative, omega=symbol, **said)
        return direction, texts.sense_of.format(symbol=symbol, **said)

    @property
    def _epsilons(self) -> tuple[NumberName, ...]:
        return tuple(self.kinematics.epsilon.values())

    @property
    def _speeds(self) -> tuple[NumberName, ...]:
        return tuple(relative.speed for relative in self.kinematics.relatives.values())

    def _sense_word(self, value: float) -> str:
        return self.texts.ccw if value > 0 else self.texts.cw

    def describe_computed_number(self, step: Compute) -> list[str]:
        """Describe a number that is a result; one that is laid off is described there.

        A reading is a formula of a list; another value is a sentence.
        """
        kind = self._rate_plan(step)
        if kind is not None:
            return self._turning_lines(step, kind)
        formulas = self.value(step)
        return formulas if self.is_reading(step) else [f"{formula}." for formula in formulas]

    def is_reading(self, step: Step) -> bool:
        """Return whether a step is the value of a segment that is read for it alone."""
        if not (isinstance(step, Compute) and self.is_value(step)):
            return False
        return not isinstance(self.names.step[step.powers[1][0]], MeasureAlong)

    @cached_property
    def _results(self) -> dict[NumberName, Quantity]:
        """Quantities that follow from others and are not segments, by their numbers."""
        drawn = {*self._values, *self._epsilons, *self.kinematics.omega.values()}
        steps = self.solution.construction.program.steps
        drawn |= {step.length for step in steps if isinstance(step, LayOffLength)}
        every = self.solution.legend.values()
        return {q.size: q for q in every if q.size is not None and q.size not in drawn}

    def _result(self, step: Compute, quantity: Quantity) -> str:
        """Return the formula of a quantity that follows from others."""
        value, sides = (
            self.formulas.number(step.out),
            self.formulas.product(step.powers, step.factor),
        )
        more = self.formulas.exactly(self.formulas.exact_value(step.out))
        return self.formulas.formula(quantity.symbol, sides, value, quantity.kind.unit, more)

    def _rate_plan(self, step: Compute) -> PlanKind | None:
        """Return the plan that gives a step as the rate of a link; None for other steps."""
        return next(
            (kind for kind in RATES if step.out in self.kinematics.rates(kind).values()), None
        )

    def result_formulas(self, step: Compute) -> list[str]:
        """Return the formulas of a number that is a result, without sentences."""
        kind = self._rate_plan(step)
        if kind is None:
            return self.value(step)
        equal_symbols = [own for _, own in self._equal_links(step, kind)]
        return [self._turning_formula(step, equal_symbols if self.formulas.is_short else ())]

    def value(self, step: Compute) -> list[str]:
        """Return the formula of the quantity that a segment's length represents, or of a result.

        Empty for other steps.
        """
        if step.out in self._results:
            return [self._result(step, self._results[step.out])]
        if not self.is_value(step):
            return []
        plan = self._values[step.out]
        text = self.formulas.quantity_from_segment(step, plan)
        for relative in self.kinematics.relatives.values():
            if relative.to == FRAME and step.out in (
                relative.speed,
                self._relative_acceleration(relative),
            ):
                # On a fixed guide the relative motion is the whole one.
                ends = (relative.start, relative.head)
                if plan is PlanKind.ACCELERATION:
                    assert relative.a_coriolis is not None and relative.a_head is not None
                    ends = (relative.a_coriolis, relative.a_head)
                vector, whole = self.names.vector(*ends), self.names.symbol(step.out)
                hidden = self.solution.problem.sheet.joint_equations  # no equation has it
                own = vector.symbol if vector and not hidden else whole
                return [text.replace(whole, f"{whole} = {own}", 1) if own != whole else text]
        return [text, *self._by_crank(step)]

    def _by_crank(self, step: Compute) -> list[str]:
        """Return the acceleration of the crank's pin by ω and ε, without the plan."""
        drive, motion, formulas = (
            self.solution.problem.drive,
            self.kinematics.acceleration,
            self.formulas,
        )
        link = drive.link
        if drive.pivot is None or link not in self.kinematics.epsilon:
            return []
        heads = [ends[1] for ends, number in motion.segments.values.items() if number == step.out]
        place = next((p for p in self.solution.problem.bodies[link].points
                      if motion.point.get((link, p)) in heads), "")  # fmt: skip
        made = self.names.step.get(NumberName(f"at_{place}"))
        if not isinstance(made, Compute):
            return []
        rates = [every[link] for every in (self.kinematics.omega, self.kinematics.epsilon)]
        sizes = [formulas.magnitude(rate) for rate in rates]
        if not sizes[1]:  # a cam's follower, in some positions
            return []
        roots = [
            root(f"{omega}^{{4}} + {epsilon}^{{2}}")
            for omega, epsilon in (
                (f"ω_{{{link}}}", f"ε_{{{link}}}"),
                map(formulas.operand, rates),
            )
        ]
        sides = [
            f"{side}·{one}"
            for side, one in zip(formulas.product(made.powers[1:]), roots, strict=True)
        ]
        arm = prod(formulas.magnitude(name) ** power for name, power in made.powers[1:])
        size = arm * hypot(sizes[0] ** 2, sizes[1])
        unit = FACTS[motion.kind].unit
        found = formulas.formula(self.names.symbol(step.out), sides, size, unit)
        return [f"{found} {self.texts.by_formula}"]

    def is_value(self, step: Compute) -> bool:
        """Return whether a step is the quantity that a plan segment's length represents."""
        return step.out in self._values and step.powers[0][0] in SCALE_KIND

    def _relative_acceleration(self, relative: Relative) -> NumberName | None:
        """Return the number of a relative acceleration."""
        return self.solution.legend[relative.label("ar")].size

    def _turning_lines(self, step: Compute, kind: PlanKind) -> list[str]:
        texts, link = self.texts, self.names.owner(step.out)
        symbol, value = self.names.symbol(step.out), self.formulas.number(step.out)
        read = self.kinematics.turnings[kind, link]
        segment = self.names.segment(read.start, read.head)
        if value == 0:
            lines = [texts.turning_zero.format(symbol=symbol, segment=segment)]
        else:
            sense = self._sense_word(value)
            said = {"place": read.place, "joint": read.joint, "link": link, "sense": sense}
            lines = [
                f"{self._turning_formula(step)}.",
                texts.turning.format(segment=f"({segment})", **said),
            ]
        group_of = self.solution.structure.group_of
        return lines + [
            texts.shared_turning.format(link=other, other=link, symbol=own, same=symbol)
            for other, own in self._equal_links(step, kind)
            if group_of(other) == group_of(link)
        ]

    def _turning_formula(self, step: Compute, equal_symbols: Sequence[str] = ()) -> str:
        """Return the rate of rotation of a link, and its sense unless it is zero.

        ``equal_symbols`` are the symbols of the links that turn so.
        """
        value = self.formulas.number(step.out)
        more = self.formulas.exactly(abs(self.formulas.exact_value(step.out)))
        sides = self.formulas.product(step.powers, step.factor)
        unit = self.solution.legend[str(step.out)].kind.unit
        more += f", {self._sense_word(value)}" if value else ""
        symbols = " = ".join([self.names.symbol(step.out), *equal_symbols])
        return self.formulas.formula(symbols, sides, self.formulas.result(step.out), unit, more)

    def known_rates(self, kind: PlanKind, links: Sequence[str]) -> list[str]:
        """Return the formulas of rotations that no step of a plan computes, links alike once.

        The slider of a guide on the crank turns with it.
        """
        table, found = self.kinematics.rates(kind), dict[NumberName, list[str]]()
        for link in links:
            number = table.get(link, NumberName(ZERO))  # of a crank with a constant speed
            if link in self.kinematics.omega and isinstance(
                self.names.step.get(number), GivenNumber
            ):
                found.setdefault(number, []).append(link)
        rate = QuantityKind.OMEGA if kind is PlanKind.VELOCITY else QuantityKind.EPSILON
        letter, texts = rate.symbol, list[str]()
        driving = self.solution.problem.drive.link
        for number, turning in found.items():
            value = self.formulas.number(number)
            is_driven = table.get(driving, ZERO) == number
            own = f"{letter}_{{{driving if is_driven else self.names.owner(number)}}}"
            symbols = " = ".join(f"{letter}_{{{link}}}" for link in turning)
            more = f", {self._sense_word(value)}" if value else ""
            result = self.formulas.result(number)
            texts.append(self.formulas.formula(symbols, [own], result, rate.unit, more))
        return texts

    def _equal_links(self, step: Compute, kind: PlanKind) -> list[tuple[str, str]]:
        """Return the other links that turn so, and the symbols of that."""
        table = self.kinematics.rates(kind)
        own, letter = self.names.owner(step.out), self.names.symbol(step.out)[0]
        others = [k for k, number in table.items() if number == step.out and k != own]
        return [(other, f"{letter}_{{{other}}}") for other in others]

    def describe_similar_point(self, step: Similar) -> list[str]:
        """Describe a point found by similarity."""
        names, texts = self.names, self.texts
        point, coincide = names.point(step.out), self.coincide(step.out)
        b, c = names.point(step.plan_b), names.point(step.plan_c)
        ratio, parts = self._ratio(step), self.parts(step)
        if abs(ratio) < COLLINEAR or self.formulas.number(step.side) == 0:
            return [texts.similar_same.format(point=point, other=b, coincide=coincide)]
        if abs(ratio - 1) < COLLINEAR:
            return [texts.similar_same.format(point=point, other=c, coincide=coincide)]
        said = {"point": point, "coincide": coincide}
        if len(parts) > 1:
            plan, link = self.triangles(step)
            text = texts.similar_triangle.format(plan=plan, link=link, **said)
            return [parts[0] + ",", parts[1] + ".", text]
        said |= {"of": names.of(step.plan_b), "part": names.segment(step.plan_b, step.out)}
        if 0 < ratio.real < 1:
            return [parts[0] + ".", texts.similar_on.format(segment=f"{b}{c}", **said)]
        ends = (f"{b}{c}", c) if ratio.real > 1 else (f"{c}{b}", b)
        return [
            parts[0] + ".",
            texts.similar_beyond.format(segment=ends[0], beyond=ends[1], **said),
        ]

    def _ratio(self, step: Similar) -> complex:
        """Return the vector to a point of a link over that along the side it is found from."""
        s, b, c = (self.formulas.place(point) for point in (step.link_s, step.link_b, step.link_c))
        return (s - b) / (c - b)

    def parts(self, step: Similar) -> list[str]:
        """Return the formulas of a point found by similarity: its distance from one end or two."""
        is_corner = abs(self._ratio(step).imag) > COLLINEAR * max(1.0, abs(self._ratio(step)))
        lines = []
        for start in (step.plan_b, step.plan_c)[: 1 + is_corner]:
            made = self.names.step[self._length(start, step.out)]
            assert isinstance(made, Compute)
            sides, length = self.formulas.product(made.powers), self.formulas.result(made.out)
            segment = f"({self.names.segment(start, step.out)})"
            lines.append(self.formulas.formula(segment, sides, length, "mm"))
        return lines

    def triangles(self, step: Similar) -> tuple[str, str]:
        """Return the similar triangles, on the plan and on the link, by their corners."""
        plan = map(self.names.point, (step.plan_b, step.plan_c, step.out))
        base = map(self.names.point, (step.link_b, step.link_c))
        _, third = self.names.ends(step.link_b, step.link_s)
        return "".join(plan), "".join((*base, third))

    def _length(self, tail_point: PointName, head_point: PointName) -> NumberName:
        """Return the number of a segment's length."""
        motions = (self.kinematics.velocity, self.kinematics.acceleration)
        lengths = next(
            m.segments for m in motions if (tail_point, head_point) in m.segments.lengths
        )
        return lengths.drawn((tail_point, head_point))

    def without_coriolis(self, points: set[PointName]) -> list[str]:
        """Return which Coriolis accelerations vanish because the guide does not turn."""
        lines = []
        for relative in self.kinematics.relatives.values():
            if relative.a_head not in points or relative.to in self.kinematics.omega:
                continue
            relative_vector = self.names.vector(relative.start, relative.head)
            if relative_vector is None:
                continue
            index = self._index(relative.start, relative.head)
            symbol = f"a^{{k}}_{{{index}}}"
            if relative.to == FRAME:
                lines.append(
                    self.texts.no_coriolis_frame.format(
                        symbol=symbol, guide=self._track(relative_vector)
                    )
                )
            else:
                lines.append(self.texts.no_coriolis_link.format(symbol=symbol, link=relative.to))
        return lines

    def _index(self, start_point: PointName, head_point: PointName) -> str:
        """Return the index of a relative velocity as its equation has it: ``CC0``."""
        plan = self.names.construction.plan(PlanKind.VELOCITY)
        for equation in plan.equations:
            for term in equation.right:
                if term.kind is VectorKind.SLIDING and (term.tail, term.head) == (
                    start_point,
                    head_point,
                ):
                    return term.symbol.partition("_{")[2].rstrip("}")
        return self.names.point(head_point)

    def _track(self, vector: Vector) -> str:
        if vector.direction is None:
            return vector.symbol
        return self.names.base(vector.direction)
