"""Formulas with numbers beside a plan: what a student computes from the segments he read."""

from __future__ import annotations

import math

from planmethod.construct.steps import Compute, NumberName, PointName, Similar
from planmethod.note.narrate.letters import mark, segment
from planmethod.note.wording import Language
from planmethod.plans.model import (
    FACTS,
    Known,
    PlanKind,
    Relation,
    Vector,
    VectorEquation,
    VectorKind,
)
from planmethod.plans.motion.leads import Relative, Turning
from planmethod.problem.model import Convention
from planmethod.solved.solution import Solution

TURNING = {PlanKind.VELOCITY: ("ω", "1/s"), PlanKind.ACCELERATION: ("ε", "1/s²")}


class Calculation:
    """Lines of rich text for one plan in one position (расчёт к плану)."""

    def __init__(self, solution: Solution, kind: PlanKind, index: int, words: Language) -> None:
        self.solution, self.kind, self.index, self.words = solution, kind, index, words
        self._given, self._found = words.say.short, words.say.found
        self.plan = solution.construction.plan(kind)
        self.kin = solution.construction.kinematics
        motion = self.kin.velocity if kind is PlanKind.VELOCITY else self.kin.acceleration
        self.segments = motion.segments
        self.mu = solution.scales[kind].per_mm
        self.unit = words.say.units[FACTS[kind].unit]

    def lines(self) -> list[str]:
        """Return one formula a line, in the order in which each becomes known."""
        turnings = {
            (read.start, read.head): (link, read)
            for (kind, link), read in self.kin.turnings.items()
            if kind is self.kind
        }
        similar = {
            step.out: step
            for step in self.solution.construction.program.steps
            if isinstance(step, Similar) and step.out.startswith(FACTS[self.kind].prefix)
        }
        result: list[str] = []
        for vector in self.plan.vectors:
            if vector.head in similar and vector.kind is VectorKind.ABSOLUTE:
                result.append(self._similar(similar[vector.head]))
            result.append(self._vector(vector))
            if (vector.tail, vector.head) in turnings:
                result += self._turning(*turnings.pop((vector.tail, vector.head)))
        for link, read in turnings.values():  # of segments that another vector draws
            result += self._turning(link, read)
        return result

    def _mm(self, value: float) -> str:
        """Return a length on the drawing: no pencil lays off less than a tenth of a millimetre."""
        return self.words.say.number(f"{value:.1f}")

    # Numbers ---------------------------------------------------------------------------------

    def _read(self, tail: PointName, head: PointName) -> float:
        """Return a segment as the hand reads it or laid it off, mm."""
        return abs(self._number(self.segments.drawn((tail, head))))

    def _number(self, name: NumberName) -> float:
        return float(self.solution.by_hand.number(name)[self.index])

    def _distance(self, p: str, q: str) -> float:
        """Return the distance of two places of the mechanism as the hand knows it, m."""
        s = self.solution
        for body in s.problem.bodies.values():
            if p in body.points and q in body.points:
                return abs(body.points[q] - body.points[p])
        read = s.construction.draft.measured_before(p, q)
        return abs(self._number(read)) * s.scales[PlanKind.POSITION].per_mm

    def _length(self, p: str, q: str) -> str:
        """Return a length's symbol with the letters in the order of the statement."""
        named = {name for _, name, _ in self.solution.problem.lengths}
        first, second = (q, p) if f"{q}{p}" in named else (p, q)
        return f"l_{{{first}{second}}}"

    def _measured_arm(self, arm: str, letters: str, metres: float) -> str:
        """Return how an arm that no given length tells follows from the drawing."""
        scale = self.solution.scales[PlanKind.POSITION].per_mm
        mm, unit = self._mm(metres / scale), self.words.say.units["m"]
        found = f"{self._given(round(metres, 9))} {unit}"
        if self.solution.problem.scales.convention is Convention.MM_PER_UNIT:
            return f"{arm} = ({letters})/μ_{{l}} = {mm}/{self._given(1.0 / scale)} = {found}"
        return f"{arm} = μ_{{l}}·({letters}) = {self._given(scale)}·{mm} = {found}"

    def _letters(self, tail: PointName, head: PointName) -> str:
        return segment(self.solution.problem, self.plan, tail, head)

    # Vectors ---------------------------------------------------------------------------------

    def _vector(self, vector: Vector) -> str:
        ends = (vector.tail, vector.head)
        letters, mm = self._letters(*ends), self._read(*ends)
        if not math.isfinite(mm):
            return f"{vector.symbol} {self.words.sheets.unreadable}"
        source = self._source(vector)
        if source is not None:
            value = f"{self._found(self.mu * mm)} {self.unit}"
            segment_mm = f"{self._mm(mm)} {self.words.say.units['mm']}"
            return f"{vector.symbol} = {source}{value};  {letters} = {segment_mm}"
        scale = f"μ_{{{FACTS[self.kind].letter}}}"
        value = f"{self._found(self.mu * mm)} {self.unit}"
        if self.solution.problem.scales.convention is Convention.MM_PER_UNIT:
            quotient = f"{self._mm(mm)}/{self._given(1.0 / self.mu)}"
            return f"{vector.symbol} = {letters}/{scale} = {quotient} = {value}"
        product = f"{self._given(self.mu)}·{self._mm(mm)}"
        return f"{vector.symbol} = {scale}·{letters} = {product} = {value}"

    def _source(self, vector: Vector) -> str | None:
        """Return the formula of a vector that is computed before it is laid off, or None.

        The formula ends in an equals sign; it is empty for the given motion of a driving slider.
        """
        known = self._components(vector)
        if known is not None:
            return self._source(known[0]) if len(known) == 1 else None
        if vector.known is not Known.BOTH:
            return None
        if vector.kind is VectorKind.CORIOLIS:
            for relative in self.kin.relatives.values():
                if (relative.a_start, relative.a_turned) == (vector.tail, vector.head):
                    return self._coriolis(vector, relative)
        made = self.solution.construction.step(self.segments.drawn((vector.tail, vector.head)))
        if not isinstance(made, Compute):
            return None
        if vector.direction is not None and vector.direction.relation is Relation.ALONG:
            return ""
        return self._about(vector)

    def _coriolis(self, vector: Vector, relative: Relative) -> str:
        omega = abs(self._number(self.kin.omega[relative.to]))
        speed = abs(self._number(relative.speed))
        symbols = f"2ω_{{{relative.to}}}·v_{vector.symbol.partition('_')[2]}"
        return f"{symbols} = 2·{self._found(omega)}·{self._found(speed)} = "

    def _components(self, vector: Vector) -> tuple[Vector, ...] | None:
        """Return the components of an absolute vector when all are known beforehand."""
        if vector.kind is not VectorKind.ABSOLUTE or vector.direction:
            return None
        ends = (vector.tail, vector.head)
        for equation in self.plan.equations:
            if (equation.left.tail, equation.left.head) == ends and _is_known(equation):
                return equation.right
        return None

    def _about(self, vector: Vector) -> str | None:
        """Return the formula of a component of turning about a point: omega·l, omega²·l, eps·l."""
        bodies = self.solution.problem.bodies
        if vector.direction is None or len(vector.direction.points) != 2:
            return None
        ends = vector.direction.points
        for link, body in bodies.items():
            if set(ends) <= set(body.points) and ends[0] != ends[1]:
                return self._formula(vector, link, ends)
        for (_, link), read in self.kin.turnings.items():
            if vector.kind is VectorKind.NORMAL and {read.joint, read.place} == set(ends):
                return self._formula(vector, link, ends)
        return None

    def _formula(self, vector: Vector, link: str, ends: tuple[str, ...]) -> str:
        p, q = ends
        arm, metres = self._length(p, q), self._given(round(self._distance(p, q), 9))
        velocity = self.kind is PlanKind.VELOCITY
        normal = vector.kind is VectorKind.NORMAL
        letter = "ω" if velocity or normal else "ε"
        table = self.kin.omega if velocity or normal else self.kin.epsilon
        driven = link == self.solution.problem.drive.link
        written = self._given if driven else self._found
        value = written(abs(self._number(table[link]))) if link in table else "0"
        if normal:
            return f"ω_{{{link}}}^{{2}}·{arm} = {value}^{{2}}·{metres} = "
        return f"{letter}_{{{link}}}·{arm} = {value}·{metres} = "

    def _similar(self, step: Similar) -> str:
        """Return how a point is found by the similarity theorem."""
        s, b, c = step.link_s, step.link_b, step.link_c
        drawn = [self.solution.by_hand.point(p)[self.index] for p in (s, b, c)]
        arm, span = drawn[0] - drawn[1], drawn[2] - drawn[1]
        if abs((arm * span.conjugate()).imag) > 1e-9 * abs(arm) * abs(span):
            letters = [self._letters(step.plan_b, p)[1:-1] for p in (step.plan_c, step.out)]
            first = self._letters(step.plan_b, step.plan_b)[1:-1]
            half = first[: len(first) // 2]
            figure = half + letters[0].removeprefix(half) + letters[1].removeprefix(half)
            return f"△{figure} ∼ △{mark(b, c, s)}"
        made = self.solution.construction.step(self.segments.drawn((step.plan_b, step.out)))
        assert isinstance(made, Compute)
        lengths = [abs(self._number(name)) for name, _ in made.powers[1:]]
        whole = self._read(step.plan_b, step.plan_c)
        found, given = (self._letters(step.plan_b, p) for p in (step.out, step.plan_c))
        ratio = f"{mark(b, s)}/{mark(b, c)}"
        if not (lengths[1] and math.isfinite(whole)):
            return f"{found} = {given}·{ratio} {self.words.sheets.unreadable}"
        numbers = f"{self._mm(whole)}·{self._mm(lengths[0])}/{self._mm(lengths[1])}"
        result = f"{self._mm(whole * lengths[0] / lengths[1])} {self.words.say.units['mm']}"
        return f"{found} = {given}·{ratio} = {numbers} = {result}"

    # Turning ---------------------------------------------------------------------------------

    def _turning(self, link: str, read: Turning) -> list[str]:
        letter, unit = TURNING[self.kind]
        table = self.kin.omega if self.kind is PlanKind.VELOCITY else self.kin.epsilon
        value = self._number(table[link])
        component = self.mu * self._read(read.start, read.head)
        ends = (read.start, read.head)
        symbol = next((v.symbol for v in self.plan.vectors if (v.tail, v.head) == ends), "0")
        arm = self._length(read.place, read.joint)
        lines = []
        given = read.place in self.solution.problem.bodies[link].points
        metres = self._distance(read.place, read.joint)
        if not given and self.kind is PlanKind.VELOCITY:
            lines.append(self._measured_arm(arm, mark(read.joint, read.place), metres))
        if not value:
            lines.append(f"{letter}_{{{link}}} = {symbol}/{arm} = 0")
        elif not math.isfinite(value):
            lines.append(f"{letter}_{{{link}}} = {symbol}/{arm} {self.words.sheets.unreadable}")
        else:
            sense = self.words.note.ccw if value > 0 else self.words.note.cw
            numbers = f"{self._found(component)}/{self._given(round(metres, 9))}"
            found = f"{self._found(abs(value))} {self.words.say.units[unit]} ({sense})"
            lines.append(f"{letter}_{{{link}}} = {symbol}/{arm} = {numbers} = {found}")
        others = [k for k, name in table.items() if name == table[link] and k != link]
        lines += [f"{letter}_{{{other}}} = {letter}_{{{link}}}" for other in others]
        return lines


def _is_known(equation: VectorEquation) -> bool:
    """Tell whether every term is known before the plan is drawn."""
    return all(term.known is Known.BOTH for term in equation.right)


def calculation(solution: Solution, kind: PlanKind, index: int, words: Language) -> list[str]:
    """Return the formulas of one plan in one position as rich text."""
    return Calculation(solution, kind, index, words).lines()
