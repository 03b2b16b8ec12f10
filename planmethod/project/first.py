"""Sheet 1 of a project: its scales are those of all (лист 1 проекта)."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES
from planmethod.note.wording import Language, language
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


def first_sheet(problem: Problem, **more: Any) -> list[Drawing]:
    """Return sheet 1 of a project, on two sheets where one has no room.

    Parameters
    ----------
    problem : Problem
        In the positions of the project.
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
    words = language(problem.sheet.lang or LANGUAGES[0])
    made, paper = composition(SEVERAL, words.lang), problem.sheet.paper or PAPER
    try:
        return kinematics_sheets(problem, layout=made, paper=paper, positions=positions, **more)
    except LayoutError:
        two = _on_two(made, words)
        return kinematics_sheets(problem, layout=two, paper=paper, positions=positions, **more)


def _on_two(made: Composition, words: Language) -> Composition:
    """Return a composition with diagrams and tables on a sheet of their own."""
    blocks = (replace(e, sheet=2) if e.kind in FURTHER else e for e in made.blocks)
    titles = {**made.titles, 2: words.project["titles"]["diagrams"]}
    return replace(made, blocks=tuple(blocks), titles=titles)
