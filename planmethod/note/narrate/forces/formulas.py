"""Formulas of the force analysis with numbers, as rich text (расчёт сил).

Arms are as the hand measures them with the ruler; the forces that it read on one plan go on into
the next. What is given and what a table shows is exact.
"""

from __future__ import annotations

import re

from planmethod.note.narrate.forces.resultants import shift_symbol
from planmethod.note.narrate.given import given
from planmethod.note.numbers import MINUS, Notation
from planmethod.note.wording import Language
from planmethod.plans.forces.board import Given
from planmethod.plans.forces.loads import Applied, LoadKind, Shift
from planmethod.plans.forces.polygons import Edge, ForcePlan, reaction_symbol
from planmethod.problem.load_records import Dynamics
from planmethod.problem.model import Convention
from planmethod.solved.forces.reading import NOTHING, ForceReading


def force_name(symbol: str) -> str:
    """Return the letters of a force without its indices' places: ``G_{2}`` gives ``G2``."""
    return re.sub(r"[_^{},]", "", symbol)


def arm_symbol(symbol: str) -> str:
    """Return the letter of a force's arm: ``h_{G2}``."""
    return f"h_{{{force_name(symbol)}}}"


def link_names(links: tuple[str, ...]) -> str:
    """Return links as a title has them: ``4–5``."""
    return "–".join(links)


def plan_title(reading: ForceReading, plan: ForcePlan, words: Language) -> str:
    """Return what is cut free: ``Группа звеньев 4–5``, ``Начальное звено 1``."""
    is_driver = plan.links == (reading.solution.problem.drive.link,)
    title = words.sheets.cut_driver if is_driver else words.sheets.cut_group
    return title.format(links=link_names(plan.links))


# Given -------------------------------------------------------------------------------------------


def statement(reading: ForceReading, words: Language) -> list[str]:
    """Return what is given: the mechanism, masses, moments of inertia, external loads."""
    problem, index, say = reading.solution.problem, reading.index, words.say
    dynamics = problem.dynamics
    assert dynamics is not None
    lines = given(problem, words, [float(reading.solution.positions[index])])
    lines += mass_lines(dynamics, say)
    for contact in reading.statics.contacts.values():
        if contact.length is not None:
            letter = reaction_symbol(contact.joint.on, contact.joint.by, letter="a")
            lines.append(f"{letter} = {say.given(contact.length)} {say.units['m']}")
    for one in _external(reading):
        size = abs(complex(one.force[index])) if one.point else abs(float(one.couple[index]))
        if size:
            unit = say.units["N" if one.point else "N·m"]
            lines.append(f"{one.name} = {say.short(size)} {unit}")
    return lines


def mass_lines(dynamics: Dynamics, say: Notation) -> list[str]:
    """Return the masses, the moments of inertia and the acceleration of free fall."""
    masses, units = dynamics.masses.items(), say.units
    lines = [
        f"m_{{{link}}} = {say.given(mass.mass)} {units['kg']}" for link, mass in masses if mass.mass
    ]
    for link, mass in masses:
        if mass.inertia:
            lines.append(f"J_{{S{link}}} = {say.short(mass.inertia)} {units['kg·m²']}")
    return [*lines, f"g = {say.given(dynamics.gravity)} {units['m/s²']}"]


def _external(reading: ForceReading) -> list[Applied]:
    loads = (given.applied for given in reading.statics.board.given)
    return [one for one in loads if one.kind is LoadKind.EXTERNAL]


def wanted(reading: ForceReading, say: Notation) -> str:
    """Return what is to be found, as one line of symbols."""
    statics = reading.statics
    symbols = [reaction_symbol(joint.on, joint.by) for joint in statics.reactions]
    for k, contact in statics.contacts.items():
        # Of a guide that gives a couple alone nobody can ask where its force acts.
        is_none = abs(statics.reactions[k].force[reading.index]) <= NOTHING * reading.peak
        letter = "M" if is_none else "l"
        symbols.append(reaction_symbol(contact.joint.on, contact.joint.by, letter=letter))
    return ", ".join([*symbols, say.symbol(reading.balancing_symbol)])


def load_lines(reading: ForceReading, say: Notation) -> list[str]:
    """Return the weights and the inertia forces and couples with their formulas.

    A force of inertia that stands for its couple as well has the couple and its shift beside it.
    """
    lines, index, board = [], reading.index, reading.statics.board
    for load in board.given:
        one = load.applied
        if one.kind is LoadKind.EXTERNAL or not (one.force[index] or one.couple[index]):
            continue
        lines.append(load_formula(reading, one, abs(reading.read_load(load)), say))
        shift = board.shifts.get(one.link) if one.kind is LoadKind.INERTIA else None
        if shift is not None and shift.moment.couple[index]:
            lines += shift_formulas(reading, load, shift, say)
    return lines


def shift_formulas(reading: ForceReading, force: Given, shift: Shift, say: Notation) -> list[str]:
    """Return the couple that a shifted force of inertia stands for, and the shift, by the hand."""
    size, moment = abs(reading.read_load(force)), abs(reading.read_number(shift.couple))
    head = f"{shift_symbol(shift.link)} = {shift.moment.name}/{force.applied.name}"
    numbers = f"{say.found(moment)}/{say.found(size)}"
    length = say.found(moment / size) if size else "—"
    told = f"{head} = {numbers} = {length} {say.units['m']}"
    return [load_formula(reading, shift.moment, moment, say), told]


def load_formula(reading: ForceReading, one: Applied, size: float, say: Notation) -> str:
    """Return a weight, an inertia force or couple with its formula; ``size`` as the hand has it."""
    dynamics = reading.solution.problem.dynamics
    assert dynamics is not None
    mass = dynamics.masses[one.link]
    m, kg = f"m_{{{one.link}}}", say.short(mass.mass)
    match one.kind:
        case LoadKind.WEIGHT:
            formula = f"{m}·g = {kg}·{say.short(dynamics.gravity)}"
        case LoadKind.INERTIA:
            formula = f"{m}·a_{{{mass.centre}}} = {kg}·{say.short(size / mass.mass)}"
        case LoadKind.INERTIA_COUPLE:
            epsilon = say.short(size / mass.inertia)
            formula = f"J_{{S{one.link}}}·ε_{{{one.link}}} = {say.short(mass.inertia)}·{epsilon}"
        case LoadKind.EXTERNAL:
            raise TypeError(f"{one.name} is given, not computed")
    unit = say.units["N" if one.point else "N·m"]
    return f"{one.name} = {formula} = {say.found(size)} {unit}"


def signed_sum(terms: list[tuple[float, str]]) -> str:
    """Return terms with their signs; a positive one first, if there is any."""
    ordered = sorted(terms, key=lambda term: term[0] < 0)
    text = ""
    for value, term in ordered:
        sign = MINUS if value < 0 else "+"
        text += f" {sign} {term}" if text else (f"{MINUS}{term}" if value < 0 else term)
    return text


# Found -------------------------------------------------------------------------------------------


def closing_lines(reading: ForceReading, plan: ForcePlan, say: Notation) -> list[str]:
    """Return what the force plan of some links gives: segments in mm, forces in N."""
    return [closing_formula(reading, edge, say) for edge in plan.reactions]


def closing_formula(reading: ForceReading, edge: Edge, say: Notation) -> str:
    """Return a force read off its plan: ``F_{42} = 70,0/0,01 = 7000 Н``."""
    symbol = say.symbol(edge.symbol)
    if reading.is_none(edge):
        return f"{symbol} = 0"
    length = reading.length(edge)
    if not length:
        return f"{symbol} ≈ 0"
    size = f"{say.found(length * reading.scale.per_mm)} {say.units['N']}"
    return f"{symbol} = {scaled(say.ruled(length), reading, say)} = {size}"


def scaled(segment: str, reading: ForceReading, say: Notation) -> str:
    """Return a segment of a force plan times the scale, or over it: ``70,0/0,01``."""
    scale = reading.scale.per_mm
    if reading.solution.problem.scales.convention is Convention.MM_PER_UNIT:
        return f"{segment}/{say.short(1.0 / scale)}"
    return f"{segment}·{say.short(scale)}"
