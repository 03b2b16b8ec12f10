"""Formulas of the force analysis with numbers, as rich text (расчёт сил).

Arms are as the hand measures them with the ruler; the forces that it read on one plan go on into
the next. What is given and what a table shows is exact.
"""

from __future__ import annotations

import re

from planmethod.construct.steps import PointName
from planmethod.note.given import given, number, point_name
from planmethod.note.numbers import MINUS, UNITS_RU, russian, significant, trimmed
from planmethod.plans.forcereading import ForceReading
from planmethod.plans.loads import Applied, LoadKind
from planmethod.plans.model import PlanKind
from planmethod.plans.polygons import (
    BALANCING_MOMENT,
    CoupleOn,
    Edge,
    ForcePlan,
    Moments,
    reaction_symbol,
)
from planmethod.problem.model import Convention

NEWTON, NEWTON_METRE = UNITS_RU["N"], UNITS_RU["N·m"]


def found(value: float) -> str:
    """Return a computed number, four digits of it."""
    return russian(significant(value))


def force_name(symbol: str) -> str:
    """Return the letters of a force without its indices' places: ``G_{2}`` gives ``G2``."""
    return re.sub(r"[_^{},]", "", symbol)


def arm_symbol(symbol: str) -> str:
    """Return the letter of a force's arm: ``h_{G2}``."""
    return f"h_{{{force_name(symbol)}}}"


def link_names(links: tuple[str, ...]) -> str:
    """Return links as a title has them: ``4–5``."""
    return "–".join(links)


def plan_title(reading: ForceReading, plan: ForcePlan) -> str:
    """Return what is cut free: ``Группа звеньев 4–5``, ``Начальное звено 1``."""
    if plan.links == (reading.solution.problem.drive.link,):
        return f"Начальное звено {plan.links[0]}"
    return f"Группа звеньев {link_names(plan.links)}"


# Given -------------------------------------------------------------------------------------------


def statement(reading: ForceReading) -> list[str]:
    """Return what is given: the mechanism, masses, moments of inertia, external loads."""
    problem, index = reading.solution.problem, reading.index
    dynamics = problem.dynamics
    assert dynamics is not None
    lines = given(problem, [float(reading.solution.positions[index])])
    for link, mass in dynamics.masses.items():
        if mass.mass:
            lines.append(f"m_{{{link}}} = {number(mass.mass)} кг")
    for link, mass in dynamics.masses.items():
        if mass.inertia:
            lines.append(f"J_{{S{link}}} = {short(mass.inertia)} кг·м^{{2}}")
    for contact in reading.statics.contacts.values():
        if contact.length is not None:
            letter = reaction_symbol(contact.joint.on, contact.joint.by, letter="a")
            lines.append(f"{letter} = {number(contact.length)} м")
    lines.append(f"g = {number(dynamics.gravity)} {UNITS_RU['m/s²']}")
    for one in _external(reading):
        size = abs(complex(one.force[index])) if one.point else abs(float(one.couple[index]))
        if size:
            unit = NEWTON if one.point else NEWTON_METRE
            lines.append(f"{one.name} = {short(size)} {unit}")
    return lines


def short(value: float) -> str:
    """Return a given number."""
    return russian(trimmed(value, 5))


def _external(reading: ForceReading) -> list[Applied]:
    loads = (given.applied for given in reading.statics.board.given)
    return [one for one in loads if one.kind is LoadKind.EXTERNAL]


def wanted(reading: ForceReading) -> str:
    """Return what is to be found, as one line of symbols."""
    edges = [edge for plan in reading.plans for edge in (*plan.wholes, *plan.polygon)]
    edges += [plan.inner for plan in reading.plans if plan.inner is not None]
    symbols = dict.fromkeys(
        edge.symbol for edge in edges if edge.known.value < 2 and "^" not in edge.symbol
    )
    for contact in reading.statics.contacts.values():
        symbols[reaction_symbol(contact.joint.on, contact.joint.by, letter="l")] = None
    if reading.statics.driving.moment is not None:
        symbols[BALANCING_MOMENT] = None
    return ", ".join(symbols)


def load_lines(reading: ForceReading) -> list[str]:
    """Return the weights and the inertia forces and couples with their formulas."""
    solution, index = reading.solution, reading.index
    dynamics = solution.problem.dynamics
    assert dynamics is not None
    lines = []
    for given_load in reading.statics.board.given:
        one = given_load.applied
        mass = dynamics.masses.get(one.link)
        force, couple = abs(complex(one.force[index])), abs(float(one.couple[index]))
        if mass is None or not (force or couple):
            continue
        m, kg = f"m_{{{one.link}}}", short(mass.mass)
        match one.kind:
            case LoadKind.WEIGHT:
                formula = f"{m}·g = {kg}·{number(dynamics.gravity)}"
            case LoadKind.INERTIA:
                assert mass.centre is not None
                a = abs(complex(solution.points[mass.centre].acceleration[index]))
                formula = f"{m}·a_{{{mass.centre}}} = {kg}·{found(a)}"
            case LoadKind.INERTIA_COUPLE:
                epsilon = abs(float(solution.links[one.link].epsilon[index]))
                letter = f"J_{{S{one.link}}}"
                formula = f"{letter}·ε_{{{one.link}}} = {short(mass.inertia)}·{short(epsilon)}"
            case _:
                continue
        size, unit = (force, NEWTON) if one.point else (couple, NEWTON_METRE)
        lines.append(f"{one.name} = {formula} = {found(size)} {unit}")
    return lines


# Moments -----------------------------------------------------------------------------------------


def moment_lines(reading: ForceReading, equation: Moments) -> list[str]:
    """Return an equation of moments, its arms, and what it gives; nothing where all is zero."""
    about = point_name(str(equation.about))
    terms = _Terms(reading)
    for edge in equation.edges:
        terms.force(edge, reading.read(edge), reading.arm(edge, equation.about))
    for couple in equation.couples:
        terms.couple(couple)
    head = f"Σ_{{{','.join(equation.links)}}}M_{{{about}}}"
    if equation.force is not None:
        return _force_found(reading, equation.force, equation.about, terms, head)
    assert equation.couple is not None
    if reading.is_no_couple(equation.couple):
        return []
    value = reading.read_number(equation.couple.moment)
    return terms.lines(head, equation.couple.symbol, value, "", "", NEWTON_METRE)


def _force_found(
    reading: ForceReading, edge: Edge, about: PointName, terms: _Terms, head: str
) -> list[str]:
    if reading.is_none(edge):
        return [f"{head} = 0:  {edge.symbol} = 0"]
    sense = 1.0 if reading.arm(edge, about) > 0 else -1.0
    letters, length = _arm_length(reading, edge, about)
    value = sense * reading.read(edge)
    return terms.lines(head, edge.symbol, value, f"·{letters}", short(length), NEWTON)


def _arm_length(reading: ForceReading, edge: Edge, about: PointName) -> tuple[str, float]:
    """Return the letters and the length, m, of the arm of a tangential component."""
    solution = reading.solution
    body = solution.problem.bodies[edge.on].points
    ends = (str(edge.at), str(about))
    if all(end in body for end in ends):
        named = {name for _, name, _ in solution.problem.lengths}
        letters = "".join(ends[::-1] if "".join(ends[::-1]) in named else ends)
        return f"l_{{{letters}}}", abs(body[ends[1]] - body[ends[0]])
    length = float(solution.hand.ruled(abs(reading.place(edge.at) - reading.place(about))))
    return f"l_{{{''.join(ends)}}}", length * solution.scales[PlanKind.POSITION].per_mm


class _Terms:
    """Known terms of an equation of moments: forces with arms on the drawing, and couples."""

    def __init__(self, reading: ForceReading) -> None:
        self.reading = reading
        self.forces: list[tuple[str, float, float]] = []
        self.couples: list[tuple[str, float]] = []

    def force(self, edge: Edge, size: float, arm: float) -> None:
        """Add a force, N, with its signed arm, mm."""
        if arm and not self.reading.is_none(edge):
            self.forces.append((edge.symbol, size, arm))

    def couple(self, couple: CoupleOn) -> None:
        """Add a couple."""
        if not self.reading.is_no_couple(couple):
            self.couples.append((couple.symbol, self.reading.read_number(couple.moment)))

    def lines(
        self, head: str, symbol: str, value: float, arm: str, divisor: str, unit: str
    ) -> list[str]:
        """Return the equation in letters, the arms, and the found value with numbers.

        ``value`` is positive where the unknown turns counter-clockwise; ``arm`` follows its symbol.
        """
        letters = [(a, f"{name}·{arm_symbol(name)}") for name, _, a in self.forces]
        letters += [(m, name) for name, m in self.couples]
        letters.append((value, f"{symbol}{arm}"))
        lines = [f"{head} = {signed_sum(letters)} = 0"]
        if self.forces:
            arms = (f"{arm_symbol(n)} = {russian(f'{abs(a):.1f}')}" for n, _, a in self.forces)
            lines.append(f"{'; '.join(arms)} мм")
        turn = -1.0 if value > 0 else 1.0
        said = self._numbers(turn)
        if divisor:
            said = f"({said})/{divisor}" if " " in said else f"{said}/{divisor}"
        return [*lines, f"{symbol} = {said} = {found(abs(value))} {unit}"]

    def _numbers(self, turn: float) -> str:
        scale = self.reading.solution.scales[PlanKind.POSITION].per_mm
        inverse = self.reading.solution.problem.scales.convention is Convention.MM_PER_UNIT
        products = [
            (turn * arm, f"{found(size)}·{russian(f'{abs(arm):.1f}')}")
            for _, size, arm in self.forces
        ]
        terms: list[tuple[float, str]] = []
        if products:
            inside = signed_sum(products)
            inside = f"({inside})" if len(products) > 1 or inside.startswith(MINUS) else inside
            factor = f"/{short(1.0 / scale)}" if inverse else f"·{short(scale)}"
            terms.append((1.0, inside + factor))
        terms += [(turn * moment, found(abs(moment))) for _, moment in self.couples]
        return signed_sum(terms) if terms else "0"


def signed_sum(terms: list[tuple[float, str]]) -> str:
    """Return terms with their signs; a positive one first, if there is any."""
    ordered = sorted(terms, key=lambda term: term[0] < 0)
    text = ""
    for value, term in ordered:
        sign = MINUS if value < 0 else "+"
        text += f" {sign} {term}" if text else (f"{MINUS}{term}" if value < 0 else term)
    return text


def plan_moments(reading: ForceReading, plan: ForcePlan) -> list[str]:
    """Return the lines of all equations of moments of a plan."""
    return [line for equation in plan.moments for line in moment_lines(reading, equation)]


def closing_lines(reading: ForceReading, plan: ForcePlan) -> list[str]:
    """Return what the force plan of some links gives: segments in mm, forces in N."""
    scale = reading.scale.per_mm
    inverse = reading.solution.problem.scales.convention is Convention.MM_PER_UNIT
    lines = []
    for edge in plan.reactions:
        if reading.is_none(edge):
            lines.append(f"{edge.symbol} = 0")
            continue
        millimetres = float(reading.solution.hand.ruled(abs(reading.vector(edge))))
        if not millimetres:
            lines.append(f"{edge.symbol} ≈ 0")
            continue
        mm = russian(f"{millimetres:.1f}")
        factor = f"{mm}/{short(1.0 / scale)}" if inverse else f"{mm}·{short(scale)}"
        lines.append(f"{edge.symbol} = {factor} = {found(millimetres * scale)} {NEWTON}")
    return lines
