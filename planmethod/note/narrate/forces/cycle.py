"""The statement of the forces over the cycle: what is given, what to find (Дано, Определить)."""

from __future__ import annotations

from planmethod.note.narrate.forces.statement import mass_lines
from planmethod.note.narrate.given import given, point_name
from planmethod.note.numbers import Notation
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.problem.load_records import Couple, Load, Over, Table
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.solution import Solution


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
    if not isinstance(load.size, Table):
        return f"{load.name} = {say.short(load.size)} {unit}"
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


def cycle_wanted(solution: Solution, say: Notation) -> str:
    """Return what is to be found in all positions, as one line of symbols."""
    symbols = [reaction_symbol(joint.on, joint.by) for joint in statics_of(solution).reactions]
    return ", ".join([*symbols, say.symbol(solution.problem.drive.balancing.symbol)])
