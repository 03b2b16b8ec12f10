"""Files of linkages: the whole problem, or as much of an unfinished one as can be drawn."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from planmethod.arguments import of_type, text as words
from planmethod.errors import Fault, PlanMethodError, ProblemError
from planmethod.languages import translate
from planmethod.problem.source import parse, read_source

if TYPE_CHECKING:
    from planmethod.problem.file_node import FileNode
    from planmethod.problem.model import CamDrive, GearDrive, Problem
    from planmethod.solved.partial_mechanism import MechanismPart
    from planmethod.solved.view_space import Views


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
    from planmethod.project.parts import PART_KINDS

    for kind in PART_KINDS.values():
        if kind.table in table:
            try:
                kind.load(path, variant)
            except ProblemError as error:
                found += [fault for fault in error.faults if fault not in found]
    return found


def loads(text: str, *, name: str, variant: str | None = None) -> Problem:
    """Read the same from a text; ``name`` replaces the stem of the file name."""
    words("text", text)
    words("name", name)
    if variant is not None:
        words("variant", variant)
    return read_table(parse(text, name=name), name=name, variant=variant)


def read_table(
    table: Mapping[str, Any], *, name: str, source: str = "", variant: str | None = None
) -> Problem:
    """Read the same from the table that the text would give; ``source`` is its file."""
    from planmethod.problem.reader import read_parsed

    source = source or name
    return _posed(read_parsed(table, source=source, name=name, variant=variant, train=_driven))


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


def reading_warnings(problem: Problem) -> Iterator[object]:
    """Yield the warnings about a problem as read: unlikely numbers, its working stroke."""
    from planmethod.problem.plausibility import names_results, unlikely

    yield from unlikely(problem)
    if problem.synthesis is not None and not names_results(problem):
        yield translate(
            '[synthesis] is not used: no number of the file names a result, as O1A = "l_O1A" does.'
        )
    if problem.cycle is not None and problem.cycle.working is not None:
        yield from _working_stroke_warnings(problem)


def rounded(problem: Problem, step: str | float) -> Problem:
    """Return a problem whose sizes by the coordinates of a figure are rounded.

    Parameters
    ----------
    step : str or float
        A length with its unit, ``1mm``, or in the unit of the file.

    Raises
    ------
    ProblemError
        A size becomes zero.
    """
    from planmethod.problem.reader import apply_variant

    table = apply_variant(problem.source_table, {("drawn", "round"): step})
    read = read_table(table, name=problem.name, source=problem.source_file)
    return replace(read, variant=problem.variant)


def rounding_note(problem: Problem) -> str:
    """Return a sentence on the sizes that rounding changed, and the points that it moved."""
    from planmethod.problem.names import UNITS, format_length, joined, segment
    from planmethod.solved.drawn_shift import shifts

    shown = None if problem.drawn is None else problem.drawn.shown
    if shown is None or shown.step is None:
        return ""
    unit = problem.unit
    changes = [
        f"{joined(*map(segment, size.path))} {size.exact * UNITS[unit]:.6g} → "
        f"{format_length(size.value, unit, 10)}"
        for size in shown.sizes
        if abs(size.value - size.exact) > 1e-12
    ]
    step = format_length(shown.step, unit, 6)
    if not changes:
        return translate("rounding to {} changes no size.", step)
    moved = [f"{p} {format_length(off, unit, 2)}" for p, off in shifts(problem).items()]
    sentence = translate("rounded to {}: {}.", step, ", ".join(changes))
    if moved:
        sentence += " " + translate(
            "In the position of the figure points move: {}.", ", ".join(moved)
        )
    return sentence


def _working_stroke_warnings(problem: Problem) -> Iterator[object]:
    """Yield the warning that the loads do not do their work on the working stroke."""
    from planmethod.note.document import plain_text
    from planmethod.solved.solution import Solution
    from planmethod.solved.turn.cycle import crank_cycle_of

    with contextlib.suppress(PlanMethodError):  # reported where the positions are solved
        turn = crank_cycle_of(Solution(problem))
        loads, strokes = turn.contradicting, turn.strokes
        if loads is not None and strokes is not None and problem.cycle is not None:
            yield translate(
                '[cycle] working = "{}" makes the stroke of {:.2f}° the working stroke, but '
                "{} does its work on the other stroke, of {:.2f}°. Correct one of them.",
                getattr(problem.cycle.working, "value", ""),
                strokes.working_deg,
                plain_text(loads.partition(" ")[2]),
                strokes.idle_deg,
            )


def unused_table_warnings(problem: Problem) -> Iterator[object]:
    """Yield the warnings about tables of other kinds of problem, which are not used."""
    if not problem.tables:
        return
    from planmethod.project.parts import PART_KINDS

    drawn = {kind.table for kind in PART_KINDS.values()}
    for table in problem.tables:
        if table not in drawn:
            yield translate("[{}] is ignored; write it into a separate file.", table)
        elif {"gears": problem.drive.gear_drive, "cam": problem.drive.cam_drive}.get(table) is None:
            yield translate("[{}] is ignored; planmethod project draws it.", table)


def _posed(problem: Problem) -> Problem:
    """Return a problem with the positions that its output or ``[cycle]`` determines."""
    if problem.drive.is_determined:
        from planmethod.solved.turn.determined import pose

        problem = pose(problem)
    if problem.cycle is not None:
        from planmethod.solved.turn.extremes import number_positions

        problem = number_positions(problem)
    return problem


def _driven(file: FileNode, driver: FileNode) -> GearDrive | CamDrive:
    if "train" in driver:
        from planmethod.gears.results import driven

        return driven(file, driver)
    from planmethod.cams.results import read_follower_drive

    return read_follower_drive(file)
