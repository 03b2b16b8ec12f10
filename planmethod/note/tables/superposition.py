"""Velocities as sums of those that each driver alone gives, as a table (наложение)."""

# no messages: the texts are in the catalogues

from __future__ import annotations

from planmethod.note.document import Table, computed_text, table_of_columns
from planmethod.note.formula import Rich
from planmethod.note.wording import MessageTable
from planmethod.solved.solution import Solution
from planmethod.solved.superposition import parts_by_driver


def superposition_table(solution: Solution, texts: MessageTable, index: int) -> Table:
    """Return the velocities that each driver alone gives, and their sums."""
    parts = parts_by_driver(solution)
    name, moves, total = texts["superposition_columns"]
    units, rows = texts["units"], list[list[Rich]]()
    for point in moving_points(solution):
        letter = solution.problem.lettered(point)
        for axis in ("real", "imag"):
            values = [
                float(getattr(one.points[point].velocity[index], axis))
                for one in (*parts.values(), solution)
            ]
            symbol = f"v_{{{letter}{'x' if axis == 'real' else 'y'}}}, {units['m/s']}"
            rows.append([symbol, *(computed_text(value, texts) for value in values)])
    for link in solution.problem.mechanism.links:
        values = [float(one.links[link].omega[index]) for one in (*parts.values(), solution)]
        if any(values):
            symbol = f"ω_{{{link}}}, {units['1/s']}"
            rows.append([symbol, *(computed_text(value, texts) for value in values)])
    heads = [name, *(moves.format(link=link) for link in parts), total]
    return table_of_columns([list(column) for column in zip(heads, *rows, strict=True)], repeated=1)


def moving_points(solution: Solution) -> list[str]:
    """Return the names of the points that are not fixed."""
    velocity = solution.construction.kinematics.velocity
    return [name for name, at in velocity.named.items() if velocity.point[at] != velocity.pole]
