"""Formulas with numbers beside a plan: what a student computes from the segments he read."""

from __future__ import annotations

from planmethod.construct.steps import PointName
from planmethod.note.numbers import UNITS_RU, russian, significant, trimmed
from planmethod.plans.leads import Turning
from planmethod.plans.model import PlanKind, Vector, VectorKind
from planmethod.plans.solution import Solution, plain

UNIT = {PlanKind.VELOCITY: "m/s", PlanKind.ACCELERATION: "m/s²"}
LETTER = {PlanKind.VELOCITY: "v", PlanKind.ACCELERATION: "a"}


def _given(value: float) -> str:
    return russian(trimmed(value, 5))


def _found(value: float) -> str:
    return russian(significant(value))


class Calculation:
    """Lines of rich text for one plan in one position (расчёт к плану)."""

    def __init__(self, solution: Solution, kind: PlanKind, index: int) -> None:
        self.solution, self.kind, self.index = solution, kind, index
        self.plan = solution.construction.plan(kind)
        self.mu = solution.scales[kind].per_mm
        self.unit = UNITS_RU[UNIT[kind]]

    def segment(self, tail: PointName, head: PointName) -> str:
        """Return a segment in letters: ``(bc)``."""
        return "(" + "".join(self._letter(end) for end in (tail, head)) + ")"

    def _letter(self, point: PointName) -> str:
        name = plain(self.plan, point)
        head, _, tail = name.partition("_")
        if tail:
            return f"{head}_{{{tail}}}"
        return f"{name[:1]}_{{{name[1:]}}}" if name[1:] else name

    def read(self, tail: PointName, head: PointName) -> float:
        """Return a segment as the hand reads it, mm."""
        s = self.solution
        ends = (s.complexes(s.by_hand, head) - s.complexes(s.by_hand, tail))[self.index]
        return float(s.hand.ruled(abs(ends)))

    def lines(self) -> list[str]:
        """Return one formula a line, in the order of the construction."""
        result = [self._vector(vector) for vector in self.plan.vectors]
        turning = self.solution.construction.kinematics.turnings
        for (kind, link), read in turning.items():
            if kind is self.kind:
                result.append(self._turning(link, read))
        return [line for line in result if line]

    def _vector(self, vector: Vector) -> str:
        length = self.read(vector.tail, vector.head)
        if vector.kind is VectorKind.NORMAL or vector.kind is VectorKind.CORIOLIS:
            return self._laid_off(vector)
        product = f"{_given(self.mu)}·{_given(length)}"
        scale = f"μ_{{{LETTER[self.kind]}}}"
        segment = self.segment(vector.tail, vector.head)
        value = _found(self.mu * length)
        return f"{vector.symbol} = {scale}·{segment} = {product} = {value} {self.unit}"

    def _laid_off(self, vector: Vector) -> str:
        """Return a component that was computed before it was laid off."""
        s = self.solution
        laid = abs(s.complexes(s.by_hand, vector.head) - s.complexes(s.by_hand, vector.tail))
        mm = float(laid[self.index])
        value = _found(self.mu * mm)
        source = self._source(vector)
        return f"{vector.symbol} = {source}{value} {self.unit};  {_found(mm)} мм"

    def _source(self, vector: Vector) -> str:
        """Return the formula of a normal or Coriolis component, with an equals sign after it."""
        kin = self.solution.construction.kinematics
        if vector.kind is VectorKind.CORIOLIS:
            for relative in kin.relatives.values():
                if (relative.a_start, relative.a_turned) == (vector.tail, vector.head):
                    index = vector.symbol.partition("_")[2]
                    return f"2ω_{{{relative.to}}}·v_{index} = "
        for link in self.solution.problem.mechanism.links:
            points = self.solution.problem.bodies[link].points
            joint, _, place = (part.strip() for part in vector.note.partition("→"))
            plan = kin.acceleration.point
            if (link, joint) in plan and (link, place) in plan and place in points:
                return f"ω_{{{link}}}^{{2}}·l_{{{joint}{place}}} = "
        return ""

    def _turning(self, link: str, read: Turning) -> str:
        s, kin = self.solution, self.solution.construction.kinematics
        table, letter, unit = (
            (kin.omega, "ω", "1/s")
            if self.kind is PlanKind.VELOCITY
            else (kin.epsilon, "ε", "1/s²")
        )
        value = float(s.reals(s.by_hand, table[link])[self.index])
        component = self.mu * self.read(read.start, read.head)
        symbol = next(
            v.symbol for v in self.plan.vectors if (v.tail, v.head) == (read.start, read.head)
        )
        arm = f"l_{{{read.place}{read.joint}}}"
        metres = abs(component / value) if value else 0.0
        sense = "против часовой стрелки" if value > 0 else "по часовой стрелке"
        numbers = f"{_found(component)}/{_found(metres)} = " if value else ""
        said = f" ({sense})" if value else ""
        found = f"{_found(abs(value))} {UNITS_RU[unit]}{said}"
        return f"{letter}_{{{link}}} = {symbol}/{arm} = {numbers}{found}"


def calculation(solution: Solution, kind: PlanKind, index: int) -> list[str]:
    """Return the formulas of one plan in one position as rich text."""
    return Calculation(solution, kind, index).lines()
