"""The statement of the force analysis: what is given, what to find (Дано, Определить)."""

from __future__ import annotations

from planmethod.note.narrate.given import As, given, point_name
from planmethod.note.numbers import Notation
from planmethod.note.wording import Language
from planmethod.plans.forces.loads import Applied, LoadKind
from planmethod.plans.forces.polygons import ForcePlan, reaction_symbol
from planmethod.problem.load_records import Couple, Dynamics, Load, Over, SizeTable
from planmethod.problem.model import Problem
from planmethod.solved.forces.reading import FAINT_SHARE, ForceReading
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.solution import Solution


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
    problem, index = reading.solution.problem, reading.index
    dynamics = problem.dynamics
    assert dynamics is not None
    lines = given(problem, words, [float(reading.solution.positions[index])])
    lines += mass_lines(problem, words)
    text = As(problem, words)
    for contact in reading.statics.contacts.values():
        if contact.length is not None:
            by = problem.mechanism.called(contact.joint.by)
            letter = reaction_symbol(contact.joint.on, by, letter="a")
            lines.append(f"{letter} = {text.metres(contact.length)}")
    paths = _paths(dynamics)
    for one in _external(reading):
        size = abs(complex(one.force[index])) if one.point else abs(float(one.couple[index]))
        if size:
            unit = "N" if one.point else "N·m"
            if one.name in paths:
                said = text.number(size, unit, paths[one.name])
            else:
                said = f"{words.say.found(size)} {words.say.units[unit]}"
            lines.append(f"{one.name} = {said}")
    return lines


def mass_lines(problem: Problem, words: Language) -> list[str]:
    """Return the masses, moments of inertia and the acceleration of free fall as the file has."""
    dynamics, text, lines = problem.dynamics, As(problem, words), []
    assert dynamics is not None
    for symbol, key, unit in (("m_{%s}", "mass", "kg"), ("J_{S%s}", "inertia", "kg·m²")):
        for link, mass in dynamics.masses.items():
            if value := getattr(mass, key):
                said = text.number(value, unit, f"dynamics.links.{link}.{key}")
                lines.append(f"{symbol % link} = {said}")
    return [*lines, f"g = {text.number(dynamics.gravity, 'm/s²', 'dynamics.gravity')}"]


def _paths(dynamics: Dynamics) -> dict[str, str]:
    """Return where the file has the size of each load that does not change, by its letter."""
    return {
        load.name: f"loads[{k}].{'force' if isinstance(load, Load) else 'couple'}"
        for k, load in enumerate(dynamics.loads)
        if not isinstance(load.size, SizeTable)
    }


def _external(reading: ForceReading) -> list[Applied]:
    loads = (given.applied for given in reading.statics.board.given)
    return [one for one in loads if one.kind is LoadKind.EXTERNAL]


def wanted(reading: ForceReading, say: Notation) -> str:
    """Return what is to be found, as one line of symbols."""
    statics, called = reading.statics, reading.solution.problem.mechanism.called
    symbols = [reaction_symbol(joint.on, called(joint.by)) for joint in statics.reactions]
    for k, contact in statics.contacts.items():
        # Of a guide that gives a couple alone nobody can ask where its force acts.
        is_none = abs(statics.reactions[k].force[reading.index]) <= FAINT_SHARE * reading.peak
        letter = "M" if is_none else "l"
        by = called(contact.joint.by)
        symbols.append(reaction_symbol(contact.joint.on, by, letter=letter))
    return ", ".join([*symbols, say.symbol(reading.balancing_symbol)])


def cycle_statement(solution: Solution, words: Language) -> list[str]:
    """Return what is given for all positions: mechanism, masses, external loads."""
    problem = solution.problem
    assert problem.dynamics is not None
    lines = given(problem, words, [float(position) for position in solution.positions])
    lines += mass_lines(problem, words)
    return [*lines, *(_load(solution, load, words) for load in problem.dynamics.loads)]


def _load(solution: Solution, load: Load | Couple, words: Language) -> str:
    """Return a load: its size, or what it is a table of and how large it gets."""
    say = words.say
    unit = say.units["N" if isinstance(load, Load) else "N·m"]
    if not isinstance(load.size, SizeTable):
        return f"{load.name} = {say.short(load.size)} {unit}"
    if load.size.like is not None:
        return like_line(load, words)
    largest = max(load.size.values, key=abs)
    match load.size.over:
        case Over.PHI:
            over = f"φ_{{{solution.problem.drive.link}}}"
        case Over.S:
            over = "s"
        case Over.X | Over.Y:
            assert isinstance(load, Load), "a couple has no point"
            over = f"{load.size.over.value}_{{{point_name(load.at)}}}"
        case Over.PATH | Over.STROKES:
            assert isinstance(load, Load), "a couple has no point"
            over = f"s_{{{point_name(load.at)}}}"
        case Over.POSITION:
            over = words.note.number
    name, index, end = load.name.partition("_{")
    peak = f"{name}_{{{end.removesuffix('}')}{' ' if index else ''}max}}"
    largest_told = f"{say.short(largest)} {unit}"
    return words.sheets.load_table.format(
        name=load.name, over=over, peak=peak, largest=largest_told
    )


def like_line(load: Load | Couple, words: Language) -> str:
    """Return whose indicator diagram a load has, and how much later (второй цилиндр)."""
    assert isinstance(load.size, SizeTable) and load.size.like is not None
    shift = f"{words.say.given(load.size.shift)}{words.say.units['deg']}"
    return words.sheets.load_like.format(name=load.name, other=load.size.like, shift=shift)


def cycle_wanted(solution: Solution, say: Notation) -> str:
    """Return what is to be found in all positions, as one line of symbols."""
    called = solution.problem.mechanism.called
    joints = statics_of(solution).reactions
    symbols = [reaction_symbol(joint.on, called(joint.by)) for joint in joints]
    return ", ".join([*symbols, say.symbol(solution.problem.drive.balancing.symbol)])
