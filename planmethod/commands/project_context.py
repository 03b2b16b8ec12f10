"""Project of a command: its file is read, its decisions are made and checked."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click
from msgspec import Struct
from msgspec.structs import replace

from planmethod.commands.problems import read_each
from planmethod.errors import ProblemError
from planmethod.languages import LANGUAGES
from planmethod.options import PlanRequest, UsageError, drawn_by, option, warn

if TYPE_CHECKING:
    from planmethod.commands.sheet_options import ResolvedRequest
    from planmethod.project.settle import Homework, Project


class NotePages(Struct, frozen=True, kw_only=True):
    """The template of the department, and the frames of the note's pages."""

    template: Path | None = option(
        "--template",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="FILE.docx",
        help="Word file with the page and the styles of the note.",
    )
    frame: bool = option(
        "--frame",
        is_flag=True,
        help="Draw frames and title blocks on the pages of the note (forms 2, 2a).",
    )


def load_project(
    path: Path, variant: str | None, position: int | None, request: ResolvedRequest
) -> Project:
    """Return the project of a file, with the sheet options of the command line.

    Parameters
    ----------
    position : int or None
        Number of the calculated position, if the command line has it.

    Raises
    ------
    PlanMethodError
        The file is faulty, or the mechanism cannot be assembled in a position.
    click.UsageError
        It is not a linkage.
    """
    from planmethod.kinds import kind_of
    from planmethod.linkages.solving import solution_of
    from planmethod.problem.machine_records import ProjectTask
    from planmethod.project.settle import settle, warn_of_separate_train

    kind = kind_of(path)
    kind.reject_as_project(path)
    (problem,) = read_each(kind, path, lambda: (variant,))
    problem = request.over(problem)
    if position is not None:
        task = replace(problem.project or ProjectTask(), calculated=position)
        problem = replace(problem, project=task)
    try:
        project = settle(problem, path)
    except ProblemError as error:
        if position is None or error.faults[0].path != "project.calculated":
            raise
        raise UsageError(
            "--position: {}. {}", error.faults[0].message, error.faults[0].hint
        ) from None
    solution_of(project.problem, None, drawn_by(None, None), forces=True)
    apart = warn_of_separate_train(project)
    if apart is not None:
        warn(project.problem, apart)
    return project


def load_noted(
    path: Path, variant: str | None, position: int | None, request: ResolvedRequest
) -> Project | Homework:
    """Return what a note is written of: the project of a linkage, or a homework of another kind.

    Raises
    ------
    PlanMethodError
        As `load_project`.
    click.UsageError
        A position is requested of a file without a linkage.
    """
    from planmethod.kinds import LINKAGES, kind_of
    from planmethod.project.settle import Homework

    kind = kind_of(path)
    if kind is LINKAGES:
        return load_project(path, variant, position, request)
    (problem,) = read_each(kind, path, lambda: (variant,))
    if position is not None:
        kind.reject_options(problem, PlanRequest(position=position))
    problem = request.over(problem)
    return Homework(problem, kind, problem.sheet.lang or LANGUAGES[0])
