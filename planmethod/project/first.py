"""Sheet 1 of a project: its scales are those of all (лист 1 проекта)."""

from __future__ import annotations

from functools import partial
from typing import Any

from msgspec.structs import replace

from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES
from planmethod.note.wording import language
from planmethod.problem.model import Problem
from planmethod.render.ink.drawing import Drawing
from planmethod.render.sheets.composition.reader import composition
from planmethod.render.sheets.kinematics import kinematics_sheets
from planmethod.render.sheets.model import Composition

SEVERAL = "project-kinematics"
"""Composition where a crank turns through its cycle."""

PAPER = "A1"
"""Format where none is asked for; what it has no room for goes on a further sheet."""

FURTHER = (
    "kinematic-diagrams",
    "hodograph",
    "measured-results",
    "turn-table",
    "deviations",
)
"""Kinds of blocks that the second of two sheets has."""


WIDER = 1.5
"""How many times larger the views are where plans and diagrams have a sheet each."""

FEW = 6
"""Most positions whose plans, diagrams and tables are tried on one sheet."""


def first_sheet(problem: Problem, **more: Any) -> list[Drawing]:
    """Return sheet 1 of a project, on two sheets where one has no room.

    Parameters
    ----------
    problem : Problem
        Settled: the scales are those of `plans_alone`.
    more
        Taken by `kinematics_sheets`.

    Raises
    ------
    LayoutError
        There is no room on two sheets either.
    """
    positions = problem.drive.positions
    if problem.cycle is None:
        return kinematics_sheets(problem, positions=positions, **more)
    made, paper = _composition(problem), problem.sheet.paper or PAPER
    draw = partial(kinematics_sheets, problem, paper=paper, positions=positions, **more)
    if len(positions) <= FEW:
        try:
            return draw(layout=made)
        except LayoutError:
            pass
    words = language(problem.sheet.lang or LANGUAGES[0])
    blocks = (replace(e, sheet=2) if e.kind in FURTHER else e for e in made.blocks)
    titles = {**made.titles, 2: words.project["titles"]["diagrams"]}
    return draw(layout=replace(made, blocks=tuple(blocks), titles=titles))


def plans_alone(problem: Problem) -> list[Drawing]:
    """Return what sheet 1 has of scheme and plans: its scales are those of the project.

    Raises
    ------
    LayoutError
    """
    positions = problem.drive.positions
    if problem.cycle is None:
        return kinematics_sheets(problem, positions=positions)
    made, paper = _composition(problem), problem.sheet.paper or PAPER
    some = tuple(entry for entry in made.blocks if entry.kind not in FURTHER)
    return kinematics_sheets(
        problem, layout=replace(made, blocks=some), paper=paper, positions=positions
    )


def _composition(problem: Problem) -> Composition:
    """Return the composition of sheet 1, its views as large as a sheet of plans alone bears."""
    made = composition(SEVERAL, problem.sheet.lang or LANGUAGES[0])
    sizes = {paper: own.with_boxes(WIDER) for paper, own in made.sizes.items()}
    return replace(made, sizes=sizes)
