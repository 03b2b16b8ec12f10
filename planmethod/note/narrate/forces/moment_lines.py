"""Equations of moments with numbers, as rich text (уравнения моментов).

Arms are as the hand measures them on the position plan; forces that it read on one plan go on into
the next.
"""

from __future__ import annotations

from dataclasses import dataclass

from planmethod.note.narrate.forces.formulas import arm_symbol, signed_sum
from planmethod.note.narrate.given import point_name
from planmethod.note.numbers import MINUS, Notation
from planmethod.plans.forces.polygons import CoupleOn, Edge, ForcePlan, Moments
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Convention
from planmethod.solved.forces.reading import ForceReading


@dataclass(frozen=True, slots=True)
class MomentText:
    """An equation of moments told (уравнение моментов).

    Attributes
    ----------
    equation : str
        In letters, the found one with the sign that it has.
    arms : tuple of str
        ``h_{G2} = 20,5`` each, mm; none where no force has an arm.
    length : str
        The arm of the found force where it is measured, m; else empty.
    result : str
        The found force or couple with numbers; empty where it is nothing.
    value : float
        Moment of the found one as the hand has it, N·m or N times the arm's length; positive
        counter-clockwise.
    """

    equation: str
    arms: tuple[str, ...] = ()
    length: str = ""
    result: str = ""
    value: float = 0.0


def plan_moments(reading: ForceReading, plan: ForcePlan, say: Notation) -> list[str]:
    """Return the lines of all equations of moments of a plan."""
    return [line for equation in plan.moments for line in moment_lines(reading, equation, say)]


def moment_lines(reading: ForceReading, equation: Moments, say: Notation) -> list[str]:
    """Return an equation of moments, its arms, and what it gives; nothing where all is zero."""
    told = moment_text(reading, equation, say)
    if told is None:
        return []
    arms = f"{'; '.join(told.arms)} {say.units['mm']}"
    return [told.equation, *([arms] if told.arms else []), *([told.result] if told.result else [])]


def moment_text(
    reading: ForceReading, equation: Moments, say: Notation, head: str = ""
) -> MomentText | None:
    """Return an equation of moments told; None where there is no couple to be found.

    Parameters
    ----------
    head : str
        What the sum is called; ``Σ_{2,3}M_{A}`` when empty.
    """
    terms = _Terms(reading, say)
    for edge in equation.edges:
        terms.force(edge, reading.read(edge), reading.arm(edge, equation.about))
    for couple in equation.couples:
        terms.couple(couple)
    if not head:
        head = f"Σ_{{{','.join(equation.links)}}}M_{{{point_name(str(equation.about))}}}"
    if equation.force is not None:
        return _force_found(reading, equation, equation.force, terms, head)
    assert equation.couple is not None
    nothing = reading.is_no_couple(equation.couple)
    if nothing and terms.are_none:
        return None
    value = 0.0 if nothing else reading.read_number(equation.couple.moment)
    return terms.told(head, say.symbol(equation.couple.symbol), value, say.units["N·m"])


def _force_found(
    reading: ForceReading, equation: Moments, edge: Edge, terms: _Terms, head: str
) -> MomentText:
    nothing, about = reading.is_none(edge), equation.about
    if nothing and terms.are_none:
        return MomentText(f"{head} = 0: {edge.symbol} = 0")
    sense = 1.0 if reading.turns(edge, about) else -1.0
    letters, length, measured = _arm_length(reading, equation, edge, terms.say)
    value, unit = 0.0 if nothing else sense * reading.read(edge), terms.say.units["N"]
    return terms.told(head, edge.symbol, value, unit, (letters, length), measured)


def _arm_length(
    reading: ForceReading, equation: Moments, edge: Edge, say: Notation
) -> tuple[str, str, str]:
    """Return the letters and the length, m, of the arm of a tangential component.

    The third is how it was measured, where no given length tells it.
    """
    problem, ends = reading.solution.problem, (str(edge.at), str(equation.about))
    metres = say.short(reading.read_product(equation.arm))
    if len(equation.arm) == 1:
        named = {name for _, name, _ in problem.lengths}
        letters = "".join(ends[::-1] if "".join(ends[::-1]) in named else ends)
        return f"l_{{{letters}}}", metres, ""
    letters = f"l_{{{''.join(ends)}}}"
    length = say.ruled(reading.read_number(equation.arm[0][0]))
    factor = position_factor(reading, say)
    return letters, metres, f"{letters} = {length}{factor} = {metres} {say.units['m']}"


def position_factor(reading: ForceReading, say: Notation) -> str:
    """Return what makes metres of millimetres of the position plan: ``·0,002``, ``/250``."""
    scale = reading.solution.scales[PlanKind.POSITION].per_mm
    inverse = reading.solution.problem.scales.convention is Convention.MM_PER_UNIT
    return f"/{say.short(1.0 / scale)}" if inverse else f"·{say.short(scale)}"


class _Terms:
    """Known terms of an equation of moments: forces with arms on the drawing, and couples."""

    def __init__(self, reading: ForceReading, say: Notation) -> None:
        self.reading, self.say = reading, say
        self.forces: list[tuple[str, float, float]] = []
        self.couples: list[tuple[str, float]] = []

    @property
    def are_none(self) -> bool:
        """Whether nothing known has a moment, on the paper at least."""
        return not self.forces and not self.couples

    def force(self, edge: Edge, size: float, arm: float) -> None:
        """Add a force, N, with its signed arm, mm."""
        if size and arm and not self.reading.is_none(edge):
            self.forces.append((edge.symbol, size, arm))

    def couple(self, couple: CoupleOn) -> None:
        """Add a couple."""
        if not self.reading.is_no_couple(couple):
            moment = self.reading.read_number(couple.moment)
            self.couples.append((self.say.symbol(couple.symbol), moment))

    def told(
        self,
        head: str,
        symbol: str,
        value: float,
        unit: str,
        arm: tuple[str, str] = ("", ""),
        measured: str = "",
    ) -> MomentText:
        """Return the equation in letters, the arms, and the found value with numbers.

        ``value`` is positive where the unknown turns counter-clockwise, zero where the known
        moments cancel; ``arm`` are the letters and the length of its own.
        """
        letters = [(a, f"{name}·{arm_symbol(name)}") for name, _, a in self.forces]
        letters += [(m, name) for name, m in self.couples]
        letters.append((value, "·".join(filter(None, (symbol, arm[0])))))
        turn = 1.0 if value < 0 else -1.0
        said = self._numbers(turn)
        if arm[1]:
            said = f"({said})/{arm[1]}" if " " in said else f"{said}/{arm[1]}"
        return MomentText(
            f"{head} = {signed_sum(letters)} = 0",
            tuple(f"{arm_symbol(n)} = {self.say.ruled(abs(a))}" for n, _, a in self.forces),
            measured,
            f"{symbol} ≈ 0" if self.are_none else f"{symbol} = {said} {self._result(value, unit)}",
            value,
        )

    def _result(self, value: float, unit: str) -> str:
        """Return what the numbers come to; near to nothing where the exact moments cancel."""
        if value:
            return f"= {self.say.found(abs(value))} {unit}"
        mu_l = self.reading.solution.scales[PlanKind.POSITION].per_mm
        moments = [size * arm * mu_l for _, size, arm in self.forces]
        moments += [moment for _, moment in self.couples]
        cancel = abs(sum(moments)) <= 1e-9 * max(map(abs, moments))
        return "= 0" if cancel else "≈ 0"

    def _numbers(self, turn: float) -> str:
        products = [
            (turn * arm, f"{self.say.found(size)}·{self.say.ruled(abs(arm))}")
            for _, size, arm in self.forces
        ]
        terms: list[tuple[float, str]] = []
        if products:
            inside = signed_sum(products)
            inside = f"({inside})" if len(products) > 1 or inside.startswith(MINUS) else inside
            terms.append((1.0, inside + position_factor(self.reading, self.say)))
        terms += [(turn * moment, self.say.found(abs(moment))) for _, moment in self.couples]
        return signed_sum(terms) if terms else "0"
