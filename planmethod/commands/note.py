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

FORMATS = ("docx", "pdf")


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
        help="docx,pdf.",
    )
    pages: NotePages = field(default_factory=NotePages)
    out: Path = out_option()
    paper: PaperRequest = field(default_factory=PaperRequest)
    shown: bool = open_option()


@command(NoteFileOptions)
def note(options: NoteFileOptions) -> None:
    """Write the explanatory note of a project or a homework, as Word and PDF."""
    from planmethod.project.notes import NoteOptions, note_files
    from planmethod.render.backends.output import write_all

    settled, out = options.paper.resolve(), options.out
    project = load_noted(options.problem, options.variant, options.position, settled)
    pages = NoteOptions(settled.fields, options.pages.template, options.pages.frame)
    files = note_files(project, f"{basename(project.problem)}-note", pages, options.formats)
    write_all(out, files, output_root=out)
    for name in files:
        click.echo(str(out / name))
    if options.shown:
        show(out / next(iter(files)))
