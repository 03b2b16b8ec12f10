"""A machine and its flywheel in the results and the protocol (таблица маховика)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.document import Caption, Chapter, Item, Node, steps_of, table_of_quantities
from planmethod.note.narrate.machine import (
    MachineTeller,
    asks_run_up,
    course_columns,
    courses,
    run_up_lines,
)
from planmethod.note.narrate.reduction import ReductionTeller
from planmethod.note.wording import Language
from planmethod.solved.machine.drawing import drawing_of
from planmethod.solved.machine.flywheel import flywheel_of
from planmethod.solved.solution import Solution


def machine_teller(solution: Solution, words: Language) -> MachineTeller:
    """Return the narrator of the machine of a solution."""
    return MachineTeller(drawing_of(flywheel_of(solution), solution.profile), words)


def machine_steps(solution: Solution, words: Language) -> Iterator[Node]:
    """Yield the chapter of a protocol on the flywheel: how its diagrams are made."""
    tell = machine_teller(solution, words)
    yield Chapter(tell.said.title)
    yield from steps_of(tell.steps())


def machine_tables(solution: Solution, words: Language) -> Iterator[Node]:
    """Yield the table by positions, the formulas, the exact flywheel and its sizes."""
    tell = machine_teller(solution, words)
    yield Chapter(tell.said.table, numbered=False)
    yield table_of_quantities(tell.columns(), repeated=2)
    reduction = ReductionTeller(tell)
    for title, formulas, columns in (
        (tell.said.moments, [reduction.moment_formula()], reduction.moments()),
        (tell.said.energies, reduction.energy_formulas(), reduction.energy_columns()),
    ):
        yield Caption(title)
        yield from map(Item, formulas)
        yield table_of_quantities(columns, repeated=1)
    yield Caption(tell.said.calculation)
    lines = (*tell.formulas(), *tell.conclusions(), *tell.power_formulas(), *tell.motor_choice())
    yield from map(Item, lines)
    sizes = tell.sizes
    if sizes is not None:
        listed = "; ".join(tell.size_lines(sizes))
        yield Item(f"{tell.said['sizes'][sizes.shape.value]}: {listed}")
    if asks_run_up(tell):
        yield Chapter(tell.said.run_up, numbered=False)
        yield from map(Item, run_up_lines(tell))
        for title, course in courses(tell):
            yield Caption(title)
            yield table_of_quantities(course_columns(course, tell), repeated=1)
