"""The statement of the forces over the cycle: "Дано" and "Определить" (rich text)."""

from __future__ import annotations

from planmethod.note.narrate.forces.formulas import mass_lines
from planmethod.note.narrate.given import given, point_name
from planmethod.note.numbers import RUSSIAN, UNITS_RU
from planmethod.plans.forces.polygons import BALANCING_FORCE, BALANCING_MOMENT, reaction_symbol
from planmethod.problem.load_records import Couple, Load, Over, Table
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.solution import Solution


def cycle_statement(solution: Solution) -> list[str]:
    """Return what is given for all positions: mechanism, masses, external loads."""
    problem = solution.problem
    assert problem.dynamics is not None
    lines = given(problem, [float(position) for position in solution.positions])
    lines += mass_lines(problem.dynamics)
    return [*lines, *(_load(solution, load) for load in problem.dynamics.loads)]


def _load(solution: Solution, load: Load | Couple) -> str:
    """Return a load: its size, or what it is a table of and how large it gets."""
    unit = UNITS_RU["N" if isinstance(load, Load) else "N·m"]
    if not isinstance(load.size, Table):
        return f"{load.name} = {RUSSIAN.short(load.size)} {unit}"
    largest = max(load.size.values, key=abs)
    match load.size.over:
        case Over.PHI:
            over = f"φ_{{{solution.problem.drive.link}}}"
        case Over.S:
            over = "s"
        case Over.X | Over.Y:
            assert isinstance(load, Load), "a couple has no point"
            over = f"{load.size.over.value}_{{{point_name(load.at)}}}"
        case Over.POSITION:
            over = "№"
    return f"{load.name} = {load.name}({over}), до {RUSSIAN.short(largest)} {unit}"


def cycle_wanted(solution: Solution) -> str:
    """Return what is to be found in all positions, as one line of symbols."""
    symbols = [reaction_symbol(joint.on, joint.by) for joint in statics_of(solution).reactions]
    crank = solution.problem.drive.is_crank
    return ", ".join([*symbols, BALANCING_MOMENT if crank else BALANCING_FORCE])
