"""Sheet 1 of a project: its scales are those of all (лист 1 проекта)."""

from __future__ import annotations

import contextlib
from functools import partial
from typing import Any

from msgspec.structs import replace

from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES
from planmethod.problem.model import Problem, Scales
from planmethod.render.ink.drawing import Drawing
from planmethod.render.sheets.composition.reader import composition
from planmethod.render.sheets.kinematics import kinematics_sheets, sheet_scales
from planmethod.render.sheets.model import Composition

SEVERAL = "project-kinematics"
"""Composition where a crank turns through its cycle."""

PAPER = "A1"
"""Default format."""

FEW = 6
"""Maximum number of positions whose plans, diagrams and tables are tried on one sheet."""


def first_sheet(problem: Problem, **more: Any) -> list[Drawing]:
    """Return sheet 1 of a project: plans on one, diagrams and tables on the next.

    With a few positions all are on one, if they fit; small paper needs more sheets.

    Parameters
    ----------
    problem : Problem
        With its decisions: its scales are those of `first_scales`.
    more
        Taken by `kinematics_sheets`.

    Raises
    ------
    LayoutError
        The content does not fit on any number of sheets.
    """
    positions = problem.drive.positions
    if problem.cycle is None:
        return kinematics_sheets(problem, positions=positions, **more)
    made, paper = _composition(problem), problem.sheet.paper or PAPER
    draw = partial(kinematics_sheets, problem, paper=paper, positions=positions, **more)
    if len(positions) <= FEW:
        blocks = tuple(replace(entry, sheet=1) for entry in made.blocks)
        with contextlib.suppress(LayoutError):
            one = draw(layout=replace(made, blocks=blocks))
            if len(one) == 1:
                return one
    return draw(layout=made)


def first_scales(problem: Problem) -> Scales:
    """Return the scales of a project: those of scheme and plans on a sheet of their own.

    Raises
    ------
    LayoutError
    """
    positions = problem.drive.positions
    if problem.cycle is None:
        return sheet_scales(problem, positions=positions)
    made = _composition(problem)
    plans = tuple(entry for entry in made.blocks if entry.sheet == 1)
    paper = replace(problem.sheet, paper=problem.sheet.paper or PAPER)
    one = replace(problem, sheet=paper)
    return sheet_scales(one, replace(made, blocks=plans), positions)


def _composition(problem: Problem) -> Composition:
    return composition(SEVERAL, problem.sheet.lang or LANGUAGES[0])
