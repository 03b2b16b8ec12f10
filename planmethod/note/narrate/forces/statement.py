"""The statement of the force analysis: what is given, what to find (Дано, Определить)."""

from __future__ import annotations

from planmethod.note.narrate.given import given
from planmethod.note.numbers import Notation
from planmethod.note.wording import Language
from planmethod.plans.forces.loads import Applied, LoadKind
from planmethod.plans.forces.polygons import ForcePlan, reaction_symbol
from planmethod.problem.load_records import Dynamics
from planmethod.solved.forces.reading import FAINT_SHARE, ForceReading


def link_names(links: tuple[str, ...]) -> str:
    """Return links as a title has them: ``4–5``."""
    return "–".join(links)


def plan_title(reading: ForceReading, plan: ForcePlan, words: Language) -> str:
    """Return what is cut free: ``Группа звеньев 4–5``, ``Начальное звено 1``."""
    is_driver = plan.links == (reading.solution.problem.drive.link,)
    title = words.sheets.cut_driver if is_driver else words.sheets.cut_group
    return title.format(links=link_names(plan.links))


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
        is_none = abs(statics.reactions[k].force[reading.index]) <= FAINT_SHARE * reading.peak
        letter = "M" if is_none else "l"
        symbols.append(reaction_symbol(contact.joint.on, contact.joint.by, letter=letter))
    return ", ".join([*symbols, say.symbol(reading.balancing_symbol)])
