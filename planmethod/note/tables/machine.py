"""A machine and its flywheel for the terminal and the protocol (таблица маховика)."""

from __future__ import annotations

from planmethod.note.narrate.machine import (
    MachineTeller,
    asks_run_up,
    course_columns,
    courses,
    run_up_lines,
)
from planmethod.note.plaintext import columns_text, heading, plain_text, wrap
from planmethod.note.wording import Words, language
from planmethod.solved.machine.drawing import drawing_of
from planmethod.solved.machine.flywheel import flywheel_of
from planmethod.solved.solution import Solution


def machine_teller(solution: Solution, words: Words) -> MachineTeller:
    """Return who tells the machine of a solution."""
    drawing = drawing_of(flywheel_of(solution), solution.profile)
    return MachineTeller(drawing, language(words.lang))


def machine_tables(solution: Solution, words: Words) -> list[str]:
    """Return the table by positions, the formulas, the exact flywheel and its sizes."""
    tell = machine_teller(solution, words)
    columns = [
        [plain_text(f"{head}, {unit}" if unit else head), *map(plain_text, cells)]
        for head, unit, cells in tell.columns()
    ]
    lines = [*heading(plain_text(tell.said.table)), "", *columns_text(columns, lead=2), ""]
    for line in (*tell.formulas(), *tell.conclusions()):
        lines += wrap(plain_text(line), rest="  ")
    sizes = tell.sizes
    if sizes is not None:
        told = "; ".join(tell.size_lines(sizes))
        lines += wrap(plain_text(f"{tell.said['sizes'][sizes.shape.value]}: {told}"), rest="  ")
    if asks_run_up(tell):
        lines += ["", *heading(plain_text(tell.said.run_up)), ""]
        for line in run_up_lines(tell):
            lines += wrap(plain_text(line), rest="  ")
        for title, course in courses(tell):
            rows = [
                [plain_text(f"{head}, {unit}"), *map(plain_text, cells)]
                for head, unit, cells in course_columns(course, tell)
            ]
            lines += ["", title, "", *columns_text(rows, lead=1)]
    return lines
