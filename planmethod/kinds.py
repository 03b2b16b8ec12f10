"""Kinds of problem: the files of linkages, and what else a file may be, by its tables."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from planmethod.arguments import of_type, text as words
from planmethod.cams.kind import Cams
from planmethod.errors import Fault, ProblemError
from planmethod.gears.involute.kind import Meshings
from planmethod.gears.kind import GearTrains
from planmethod.kind import ProblemKind
from planmethod.moving.kind import MovingPoints
from planmethod.problem.source import parse, read_source

if TYPE_CHECKING:
    from planmethod.problem.file_node import FileNode
    from planmethod.problem.model import CamDrive, GearDrive, Problem
    from planmethod.solved.partial_mechanism import MechanismPart
    from planmethod.solved.scaling import Views

KINDS: tuple[ProblemKind[Any], ...] = (GearTrains(), MovingPoints(), Meshings(), Cams())
"""Kinds beside linkages; a file that has links is a linkage whatever else it has."""

PROJECT_KINDS = tuple(kind for kind in KINDS if kind.is_of_project)
"""Kinds that a linkage's file may have as parts of its project."""

_HEAD = r"(?m)^[ \t]*(?:\[[ \t]*)?[\"']?(" + "|".join(k.table for k in KINDS) + r")\b"


def kind_of(path: Path) -> ProblemKind[Any] | None:
    """Return the kind of a problem file; None for a linkage.

    Raises
    ------
    ProblemError
        The file cannot be read, or is not TOML.
    """
    text = read_source(path)
    if re.search(_HEAD, text) is None:  # a linkage is not parsed twice
        return None
    table = parse(text, name=str(path))
    if "links" in table:
        return None
    return next((kind for kind in KINDS if kind.table in table), None)


# Linkages ----------------------------------------------------------------------------------------


def load(path: str | Path, *, variant: str | None = None) -> Problem:
    """Read the file of a linkage; a train or a cam of the same file may drive it.

    Raises
    ------
    ProblemError, ArgumentError

    Examples
    --------
    >>> import planmethod
    >>> problem = planmethod.load("problems/linkages/ex3-variants.toml", variant="2")
    >>> problem.drive.positions
    (40.0,)
    """
    path = Path(of_type("path", path, str | Path))
    (problem,) = load_each(path, (None if variant is None else words("variant", variant),))
    return problem


def load_each(path: str | Path, variants: Iterable[str | None]) -> Iterator[Problem]:
    """Read some variants of the file of a linkage, None for its main part: the file itself once.

    Raises
    ------
    ProblemError
        With every fault of the file: of the linkage, and of its wheels, meshing and cam.
    """
    from planmethod.problem.reader import load_each as read

    path, names = Path(path), tuple(variants)
    found = read(path, names, train=_driven)
    for name in names:
        try:
            problem = next(found)
        except ProblemError as error:
            raise type(error)(error.source, _with_other_faults(error.faults, path, name)) from error
        faults = _with_other_faults((), path, name) if problem.tables else []
        if faults:
            raise ProblemError(str(path), faults)
        yield _posed(problem)


def _with_other_faults(faults: Iterable[Fault], path: Path, variant: str | None) -> list[Fault]:
    """Return the faults of a linkage, and those of the other problems of its file."""
    found = [*faults]
    try:
        table = parse(read_source(path), name=str(path))
    except ProblemError:  # a file that is no TOML has this one fault
        return found
    for kind in PROJECT_KINDS:
        if kind.table in table:
            try:
                kind.load(path, variant)
            except ProblemError as error:
                found += [fault for fault in error.faults if fault not in found]
    return found


def loads(text: str, *, name: str, variant: str | None = None) -> Problem:
    """Read the same from a text; ``name`` replaces the stem of the file name."""
    from planmethod.problem.reader import loads as read

    words("text", text)
    words("name", name)
    if variant is not None:
        words("variant", variant)
    return _posed(read(text, name=name, variant=variant, train=_driven))


def part_of(path: Path, *, variant: str | None, views: Views) -> tuple[str, MechanismPart]:
    """Return the title of the file of a linkage, and as much of it as can be drawn.

    Raises
    ------
    ProblemError
        The file cannot be read at all.
    """
    from planmethod.problem.faults import Faults
    from planmethod.problem.file_node import FileNode
    from planmethod.problem.reader import with_table
    from planmethod.solved.partial_mechanism import MechanismPart, largest_part

    text = read_source(path)
    try:
        table = parse(text, name=str(path))
    except ProblemError as error:
        return "", MechanismPart(None, faults=error.faults, trouble=error)
    part = largest_part(
        with_table(FileNode(Faults(), table), path.parent).value,
        source=str(path),
        name=path.stem,
        variant=variant,
        train=_driven,
        views=views,
        posed=_posed,
    )
    faults = _with_other_faults(part.faults, path, variant)
    if len(faults) > len(part.faults):
        part = replace(part, faults=tuple(faults), trouble=ProblemError(str(path), faults))
    title = table.get("title")
    return title if isinstance(title, str) else "", part


def _posed(problem: Problem) -> Problem:
    """Return a problem with the positions that its output or ``[cycle]`` determines."""
    if problem.drive.posed is not None:
        from planmethod.solved.turn.posed import pose

        problem = pose(problem)
    if problem.cycle is not None:
        from planmethod.solved.turn.extremes import number_positions

        problem = number_positions(problem)
    return problem


def _driven(file: FileNode) -> GearDrive | CamDrive:
    if "train" in file["driver"]:
        from planmethod.gears.results import driven

        return driven(file)
    from planmethod.cams.results import read_follower_drive

    return read_follower_drive(file)
