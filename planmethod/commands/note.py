"""Command ``note``: the explanatory note of a project or of one homework."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import click
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import show
from planmethod.commands.project_context import NotePages, load_noted
from planmethod.commands.sheet_options import PaperRequest
from planmethod.options import (
    NO_FORMAT,
    basename,
    open_option,
    option,
    out_option,
    position_option,
    problem_argument,
    read_names,
    variant_option,
)

FORMATS = ("docx", "pdf", "xlsx", "ipynb")


class NoteFileOptions(Struct, frozen=True, kw_only=True):
    """Options of ``note``."""

    problem: Path = problem_argument()
    variant: str | None = variant_option()
    position: int | None = position_option()
    formats: tuple[str, ...] = option(
        "--format",
        read=partial(read_names, known=FORMATS, empty_message=NO_FORMAT),
        default="docx,pdf",
        show_default=True,
        help="docx,pdf; xlsx and ipynb: its calculation with formulas, for Excel and for Python.",
    )
    pages: NotePages = field(default_factory=NotePages)
    out: Path = out_option()
    paper: PaperRequest = field(default_factory=PaperRequest)
    shown: bool = open_option()


@command(NoteFileOptions)
def note(options: NoteFileOptions) -> None:
    """Write the explanatory note of a project or a homework, as Word and PDF.

    Its calculation is also a workbook with formulas, and a notebook of Python.
    """
    from planmethod.project.notes import FORMATS as PAGES, NoteOptions, note_files
    from planmethod.render.backends.output import write_all

    settled, out = options.paper.resolve(), options.out
    project = load_noted(options.problem, options.variant, options.position, settled)
    pages = NoteOptions(settled.fields, options.pages.template, options.pages.frame)
    name = f"{basename(project.problem)}-note"
    texts = [fmt for fmt in options.formats if fmt in PAGES]
    files = note_files(project, name, pages, texts) if texts else {}
    if living := [fmt for fmt in options.formats if fmt not in PAGES]:
        from planmethod.project.calculation import calculation_files, calculation_of

        files |= calculation_files(calculation_of(project), name, project.language, living)
    write_all(out, files, output_root=out)
    for file in files:
        click.echo(str(out / file))
    if options.shown:
        show(out / next(iter(files)))
