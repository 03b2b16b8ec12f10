"""Formulas with numbers beside a plan: what a student computes from the segments he read."""

from __future__ import annotations

from planmethod.construct.steps import PointName
from planmethod.note.letters import segment
from planmethod.note.numbers import UNITS_RU, russian, significant, trimmed
from planmethod.plans.leads import Turning
from planmethod.plans.model import Known, PlanKind, Vector, VectorEquation, VectorKind
from planmethod.plans.solution import Solution
from planmethod.problem.model import Convention

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

    def lines(self) -> list[str]:
        """Return one formula a line, in the order of the construction."""
        result = [self._vector(vector) for vector in self.plan.vectors]
        turnings = self.solution.construction.kinematics.turnings
        result += [
            self._turning(link, read)
            for (kind, link), read in turnings.items()
            if kind is self.kind
        ]
        return result

    # Vectors ---------------------------------------------------------------------------------

    def _read(self, tail: PointName, head: PointName) -> float:
        """Return a segment as the hand reads it, mm."""
        return float(self.solution.hand.ruled(self._laid(tail, head)))

    def _laid(self, tail: PointName, head: PointName) -> float:
        """Return a segment as it lies on the hand's own plan, mm."""
        s = self.solution
        ends = s.complexes(s.by_hand, head) - s.complexes(s.by_hand, tail)
        return float(abs(ends[self.index]))

    def _vector(self, vector: Vector) -> str:
        ends = (vector.tail, vector.head)
        letters = segment(self.solution.problem, self.plan, *ends)
        source = self._source(vector)
        if source is not None:
            mm = self._laid(*ends)
            value = f"{_found(self.mu * mm)} {self.unit}"
            return f"{vector.symbol} = {source}{value};  {letters} = {_found(mm)} мм"
        length, scale = self._read(*ends), f"μ_{{{LETTER[self.kind]}}}"
        value = f"{_found(self.mu * length)} {self.unit}"
        if self.solution.problem.scales.convention is Convention.MM_PER_UNIT:
            quotient = f"{_given(length)}/{_given(1.0 / self.mu)}"
            return f"{vector.symbol} = {letters}/{scale} = {quotient} = {value}"
        return f"{vector.symbol} = {scale}·{letters} = {_given(self.mu)}·{_given(length)} = {value}"

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
            for relative in self.solution.construction.kinematics.relatives.values():
                if (relative.a_start, relative.a_turned) == (vector.tail, vector.head):
                    index = vector.symbol.partition("_")[2]
                    return f"2ω_{{{relative.to}}}·v_{index} = "
        if vector.note.startswith("∥"):
            return ""
        return self._about(vector)

    def _components(self, vector: Vector) -> tuple[Vector, ...] | None:
        """Return the components of an absolute vector when all are known beforehand."""
        if vector.kind is not VectorKind.ABSOLUTE or vector.note:
            return None
        ends = (vector.tail, vector.head)
        for equation in self.plan.equations:
            if (equation.left.tail, equation.left.head) == ends and _is_known(equation):
                return equation.right
        return None

    def _about(self, vector: Vector) -> str | None:
        """Return the formula of a component of turning about a point: omega·l, omega²·l, eps·l."""
        bodies = self.solution.problem.bodies
        note = vector.note.replace("_{", "").replace("}", "")
        arrow = note.partition("→")
        ends = (arrow[0].strip(), arrow[2].strip())
        if vector.kind is not VectorKind.NORMAL:
            letters = note.partition(" ")[2]
            cuts = [(letters[:k], letters[k:]) for k in range(1, len(letters))]
            ends = next(
                (c for c in cuts if any(set(c) <= set(b.points) for b in bodies.values())), ends
            )
        for link, body in bodies.items():
            if set(ends) <= set(body.points) and ends[0] != ends[1]:
                return self._formula(vector, link, ends)
        normal = vector.kind is VectorKind.NORMAL
        turning = self.solution.construction.kinematics.turnings
        for (_, link), read in turning.items():
            if normal and {read.joint, read.place} == set(ends):
                return self._formula(vector, link, ends)
        return None

    def _formula(self, vector: Vector, link: str, ends: tuple[str, str]) -> str:
        arm = f"l_{{{ends[0]}{ends[1]}}}"
        if vector.kind is VectorKind.NORMAL:
            return f"ω_{{{link}}}^{{2}}·{arm} = "
        letter = "ω" if self.kind is PlanKind.VELOCITY else "ε"
        return f"{letter}_{{{link}}}·{arm} = "

    # Turning ---------------------------------------------------------------------------------

    def _turning(self, link: str, read: Turning) -> str:
        s, kin = self.solution, self.solution.construction.kinematics
        velocity = self.kind is PlanKind.VELOCITY
        table, letter, unit = (kin.omega, "ω", "1/s") if velocity else (kin.epsilon, "ε", "1/s²")
        value = float(s.reals(s.by_hand, table[link])[self.index])
        component = self.mu * self._read(read.start, read.head)
        ends = (read.start, read.head)
        symbol = next((v.symbol for v in self.plan.vectors if (v.tail, v.head) == ends), "0")
        arm = f"l_{{{read.place}{read.joint}}}"
        if not value:
            return f"{letter}_{{{link}}} = {symbol}/{arm} = 0"
        sense = "против часовой стрелки" if value > 0 else "по часовой стрелке"
        numbers = f"{_found(component)}/{russian(trimmed(abs(component / value), 4))}"
        found = f"{_found(abs(value))} {UNITS_RU[unit]} ({sense})"
        return f"{letter}_{{{link}}} = {symbol}/{arm} = {numbers} = {found}"


def _is_known(equation: VectorEquation) -> bool:
    """Tell whether every term is known before the plan is drawn."""
    return all(term.known is Known.BOTH for term in equation.right)


def calculation(solution: Solution, kind: PlanKind, index: int) -> list[str]:
    """Return the formulas of one plan in one position as rich text."""
    return Calculation(solution, kind, index).lines()
