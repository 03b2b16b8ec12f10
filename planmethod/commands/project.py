"""Command ``project``: all sheets of a course project, its note, its numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click
import msgspec
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import bar, drawing_files, json_text, show
from planmethod.commands.project_context import NotePages, load_project
from planmethod.commands.sheet_options import PaperRequest
from planmethod.errors import ExitCode, PlanMethodError
from planmethod.options import (
    FileOptions,
    UsageError,
    basename,
    dxf_text_option,
    format_option,
    jobs_option,
    json_option,
    message_name,
    open_option,
    option,
    out_option,
    position_option,
    problem_argument,
    read_names,
    variant_option,
    warn_each,
)
from planmethod.problem.machine_records import PROJECT_PARTS

if TYPE_CHECKING:
    from planmethod.project.notes import NoteOptions
    from planmethod.project.settle import PartFiles, Project, ProjectPart, SheetEntry
    from planmethod.render.ink.drawing import Drawing

Files = dict[str, bytes]

RECORD = "project.json"
NUMBERS = "numbers.xlsx"
NOTEBOOK = "numbers.ipynb"
ALL_SHEETS = "project.pdf"


class MadePart(Struct, frozen=True):
    """Files of one task of the work, and its sheets."""

    files: Files
    drawings: tuple[Drawing, ...] = ()


class WritingTask(Struct, frozen=True):
    """Output to write: the sheets of a part, all sheets, the note with their list, the numbers."""

    name: str
    basename: str = ""
    drawings: tuple[Drawing, ...] = ()
    sheets: tuple[SheetEntry, ...] = ()


class SheetFormats(Struct, frozen=True):
    """Formats of sheets, with author and resolution."""

    formats: tuple[str, ...]
    author: str | None
    dxf_text: Literal["text", "strokes"]


class ProjectOptions(Struct, frozen=True, kw_only=True):
    """Options of ``project``."""

    problem: Path = problem_argument()
    variant: str | None = variant_option()
    parts: tuple[str, ...] | None = option(
        "--parts",
        read=partial(
            read_names, known=PROJECT_PARTS, empty_message="no part is named; choose from {}"
        ),
        metavar="LIST",
        help="Only these parts: synthesis, kinematics, forces, flywheel, balancing, gears, "
        "meshing, cam, note.",
    )
    position: int | None = position_option()
    formats: tuple[str, ...] = format_option("pdf")
    out: Path = out_option()
    as_json: bool = json_option("Print the content of project.json.")
    pages: NotePages = field(default_factory=NotePages)
    paper: PaperRequest = field(default_factory=PaperRequest)
    dxf_text: Literal["text", "strokes"] = dxf_text_option()
    jobs: int = jobs_option()
    shown: bool = open_option()


@command(ProjectOptions)
def project(options: ProjectOptions) -> None:
    """Produce a course project: all sheets, the note and the numbers, with common decisions.

    Writes into OUT/<name of the file>: 1-kinematics.pdf, 2-forces.pdf ... one for each part of the
    file, project.pdf with all sheets, note.docx and note.pdf, numbers.xlsx, numbers.ipynb,
    project.json; all of them or none. Files of an earlier run that this run does not write again
    are removed.

    numbers.xlsx has the values of all positions and a sheet of formulas for each chapter, which
    Excel and LibreOffice calculate again; numbers.ipynb is the same calculation in Python.
    """
    from planmethod.project.notes import NoteOptions
    from planmethod.project.settle import project_record
    from planmethod.render.backends.output import write_all

    settled, out = options.paper.resolve(), options.out
    chosen = load_project(options.problem, options.variant, options.position, settled)
    wanted = _requested_parts(chosen, options.parts)
    written = SheetFormats(options.formats, settled.author(chosen.problem), options.dxf_text)
    if "flywheel" in wanted:
        from planmethod.solved.machine.chain import flywheel_warnings
        from planmethod.solved.machine.flywheel import Flywheel

        warn_each(chosen.problem, flywheel_warnings(Flywheel(chosen.problem)))
    note = NoteOptions(settled.fields, options.pages.template, options.pages.frame)
    made, files = _make_parts(chosen, wanted, note, written, options.jobs)
    name = basename(chosen.problem)
    record = project_record(chosen, made, name, numbers=(NUMBERS, NOTEBOOK))
    files[RECORD] = msgspec.json.format(msgspec.json.encode(record), indent=2) + b"\n"
    folder = out / name
    write_all(folder, files, obsolete=_stale(folder, name) - files.keys(), output_root=out)
    if options.as_json:
        click.echo(json_text(record))
    else:
        for file in files:
            click.echo(str(folder / file))
    if options.shown:
        pages = (ALL_SHEETS, *(file for file in files if file.endswith(".pdf")), *files)
        show(folder / next(file for file in pages if file in files))


# Request --------------------------------------------------------------------------------------


def _requested_parts(chosen: Project, parts: Sequence[str] | None) -> tuple[str, ...]:
    """Return the names of the parts to be made."""
    there = [part.name.value for part in chosen.parts]
    task = chosen.problem.project
    if task is None or not task.parts or "note" in task.parts:
        there.append("note")
    for name in parts or ():
        if name not in there:
            raise UsageError(
                "--parts: {} has no part {!r}. It has {}.",
                message_name(chosen.problem),
                name,
                ", ".join(there),
            )
    return tuple(name for name in there if parts is None or name in parts)


# Work --------------------------------------------------------------------------------------------


def _make_parts(
    chosen: Project,
    requested: Sequence[str],
    options: NoteOptions,
    written: SheetFormats,
    jobs: int,
) -> tuple[list[PartFiles], Files]:
    """Make the parts, and return their files and all files by name.

    All sheets are drawn, whichever are requested: they are numbered as one set. An unrequested one
    that cannot be drawn does not stop the others, and is not counted.
    """
    from planmethod.project.parts import PartName
    from planmethod.project.settle import PartFiles
    from planmethod.project.sheets import numbered_set, sheet_list

    parts = chosen.parts
    texts = ["note", NUMBERS] if "note" in requested else [NUMBERS]
    sheets = [part.name.value for part in parts]
    files: Files = {}
    named: list[PartFiles] = []
    names = {name: f"{number}-{name}" for number, name in enumerate(sheets, 1)}
    whole = set(sheets) <= set(requested) and "pdf" in written.formats
    shown = [name for name in sheets if name in requested]
    with bar(len(sheets) + len(texts) + len(shown) + whole, long=True) as done:
        drawn: dict[str, MadePart] = {}
        drawing = partial(draw, project=chosen, options=options, requested=tuple(requested))
        for name, one in _shared(drawing, sheets, jobs):
            drawn[name] = one
            done(1)
        numbered = numbered_set(chosen, [drawn[name].drawings for name in sheets])
        sets = {name: tuple(some) for name, some in zip(sheets, numbered, strict=True)}
        # The note is the slowest: with it first, all processes end together.
        listed = sheet_list(chosen, numbered)
        tasks: list[WritingTask] = [WritingTask(name, sheets=listed) for name in texts]
        tasks += [WritingTask(name, names[name], sets[name]) for name in shown]
        if whole:
            tasks.append(
                WritingTask(ALL_SHEETS, "project", tuple(d for some in numbered for d in some))
            )
        work = partial(write, project=chosen, options=options, formats=written,
                       requested=tuple(requested))  # fmt: skip
        for name, one in _shared(work, tasks, jobs):
            files |= one.files
            done(1)
            if name in sets or name == "note":
                count = len(sets.get(name, ()))
                named.append(PartFiles(PartName(name), tuple(one.files), count))
    order = [*PROJECT_PARTS]
    named.sort(key=lambda part: order.index(part.name.value))
    return named, _ordered(named, files)


def draw(
    task: str, *, project: Project, options: NoteOptions, requested: tuple[str, ...]
) -> tuple[str, MadePart]:
    """Draw the sheets of a part; none of an unrequested one that cannot be drawn."""
    from planmethod.project.sheets import part_drawings

    part: ProjectPart = next(part for part in project.parts if part.name.value == task)
    try:
        return task, MadePart({}, tuple(part_drawings(project, part, options.fields)))
    except PlanMethodError:
        if task in requested:
            raise
        return task, MadePart({})


def write(
    task: WritingTask,
    *,
    project: Project,
    options: NoteOptions,
    formats: SheetFormats,
    requested: tuple[str, ...],
) -> tuple[str, MadePart]:
    """Write the sheets of a part in all formats, all sheets together as PDF, the note, numbers."""
    if task.name == NUMBERS:
        from planmethod.project.calculation import calculation_files, calculation_of
        from planmethod.project.numbers import numbers_workbook

        calculation = calculation_of(project, requested)
        files = calculation_files(calculation, "numbers", project.language, ("ipynb",))
        return task.name, MadePart({NUMBERS: numbers_workbook(project, calculation), **files})
    if task.name == "note":
        from planmethod.project.notes import note_files

        return task.name, MadePart(note_files(project, "note", options, sheets=task.sheets))
    kinds = ("pdf",) if task.name == ALL_SHEETS else formats.formats
    return task.name, MadePart(
        drawing_files(
            task.drawings,
            task.basename,
            kinds,
            author=formats.author,
            file_options=FileOptions(dxf_text=formats.dxf_text),
        )
    )


def _ordered(named: Sequence[PartFiles], files: Files) -> Files:
    """Return files in the order of their parts, those of all of them behind."""
    first = [file for part in named if part.sheets for file in part.files]
    rest = [file for file in (ALL_SHEETS, *files) if file in files and file not in first]
    return {file: files[file] for file in dict.fromkeys([*first, *rest])}


def _shared(
    act: Callable[[Any], tuple[str, MadePart]], tasks: Sequence[Any], jobs: int
) -> Iterator[tuple[str, MadePart]]:
    """Yield the outcome of every task from ``jobs`` processes; a failure names its part."""
    from planmethod.commands.processes import in_processes

    several = jobs > 1 and len(tasks) > 1
    outcomes = in_processes(act, tasks, jobs) if several else iter([None] * len(tasks))
    for task, outcome in zip(tasks, outcomes, strict=True):
        name = task if isinstance(task, str) else task.name
        try:
            if not several:
                yield act(task)
                continue
            if outcome is None:
                raise PlanMethodError(
                    "its process was killed twice; perhaps it needs more memory than is available"
                )
            value = outcome.result()
            assert value is not None
            yield value
        except PlanMethodError as error:
            raise _named(name, error) from error


def _named(name: str, error: PlanMethodError) -> PlanMethodError:
    """Return an error that names the part that it is of."""
    told = PlanMethodError("{} cannot be made, and no files are written: {}", name, error)
    told.exit_code = ExitCode(error.exit_code)
    return told


# Files -------------------------------------------------------------------------------------------


def _stale(folder: Path, name: str) -> set[str]:
    """Return the files of an earlier project of the name, to be removed."""
    record = folder / RECORD
    if not record.is_file():
        return set()
    try:
        before = msgspec.json.decode(record.read_bytes())
        if before["problem"] != name:
            return set()
        files = {ALL_SHEETS, *(file for part in before["parts"] for file in part["files"])}
    except (OSError, ValueError, KeyError, TypeError):
        return set()
    return {file for file in files if isinstance(file, str) and Path(file).name == file}
