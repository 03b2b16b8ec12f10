"""A machine, its flywheel and static balancing in the results and the protocol."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.document import Caption, Chapter, Item, Node, steps_of, table_of_quantities
from planmethod.note.narrate.balancing import BalancingNarrator, ReductionNarrator
from planmethod.note.narrate.machine import (
    MachineNarrator,
    course_columns,
    courses,
    has_run_up,
    run_up_lines,
)
from planmethod.note.numbers import in_heads
from planmethod.note.wording import Language
from planmethod.solved.machine.drawing import drawing_of
from planmethod.solved.machine.flywheel import flywheel_of
from planmethod.solved.solution import Solution


def machine_narrator(solution: Solution, language: Language) -> MachineNarrator:
    """Return the narrator of the machine of a solution."""
    return MachineNarrator(drawing_of(flywheel_of(solution), solution.profile), language)


def machine_steps(solution: Solution, language: Language) -> Iterator[Node]:
    """Yield the chapter of a protocol on the flywheel: how its diagrams are made."""
    narrator = machine_narrator(solution, language)
    yield Chapter(narrator.texts.title)
    yield from steps_of(narrator.steps())


def machine_tables(solution: Solution, language: Language) -> Iterator[Node]:
    """Yield the table by positions, the formulas, the exact flywheel and its sizes."""
    narrator = machine_narrator(solution, language)
    yield Chapter(narrator.texts.table, numbered=False)
    yield table_of_quantities(narrator.columns(), repeated=2)
    reduction = ReductionNarrator(narrator)
    for title, formulas, columns in (
        (narrator.texts.moments, [reduction.moment_formula()], reduction.moments()),
        (narrator.texts.energies, reduction.energy_formulas(), reduction.energy_columns()),
    ):
        yield Caption(title)
        yield from map(Item, formulas)
        yield table_of_quantities(columns, repeated=1)
    yield Caption(narrator.texts.calculation)
    lines = (
        *narrator.formulas(),
        *narrator.conclusions(),
        *narrator.power_formulas(),
        *narrator.motor_choice(),
    )
    yield from map(Item, lines)
    sizes = narrator.sizes
    if sizes is not None:
        listed = "; ".join(narrator.size_lines(sizes))
        yield Item(f"{narrator.texts['sizes'][sizes.shape.value]}: {listed}")
    if has_run_up(narrator):
        yield Chapter(narrator.texts.run_up, numbered=False)
        yield from map(Item, run_up_lines(narrator))
        for title, course in courses(narrator):
            yield Caption(title)
            yield table_of_quantities(course_columns(course, narrator), repeated=1)


def balancing_tables(solution: Solution, language: Language) -> Iterator[Node]:
    """Yield the counterweights with their numbers, and the main vector by positions."""
    narrator = BalancingNarrator(solution, language)
    yield Chapter(narrator.texts.balancing, numbered=False)
    yield from map(Item, narrator.lines())
    yield Caption(narrator.texts.forces_table)
    yield table_of_quantities(in_heads(narrator.columns(), narrator.notation), repeated=2)
