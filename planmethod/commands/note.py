"""Command ``note``: the explanatory note of a project or of one homework."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.output import LocalizedCommand, show
from planmethod.commands.problems import guarded
from planmethod.commands.project_context import load_project, note_options
from planmethod.commands.sheet_options import PaperRequest, sheet_options
from planmethod.options import BadParameter, basename, open_option, out_option, position_option

FORMATS = ("docx", "pdf")


def read_formats(ctx: click.Context, param: click.Parameter, value: str) -> tuple[str, ...]:
    """Return the formats of a note of a comma-separated list."""
    names = tuple(dict.fromkeys(n.strip().lower() for n in value.split(",") if n.strip()))
    for name in names:
        if name not in FORMATS:
            raise BadParameter("{!r} is not one of {}", name, ", ".join(FORMATS))
    if not names:
        raise BadParameter("no format given; choose from {}", ", ".join(FORMATS))
    return names


@click.command(cls=LocalizedCommand)
@click.argument("problem", metavar="PROBLEM", type=click.Path(path_type=Path, readable=False))
@click.option("--variant", metavar="NAME", help="Variant of the problem file.")
@position_option
@click.option(
    "--format",
    "formats",
    callback=read_formats,
    default="docx,pdf",
    show_default=True,
    help="docx,pdf.",
)
@note_options
@out_option
@sheet_options
@open_option
@guarded
def note(
    problem: Path,
    variant: str | None,
    position: int | None,
    formats: tuple[str, ...],
    template: Path | None,
    frame: bool,
    out: Path,
    request: PaperRequest,
    shown: bool,
) -> None:
    """Write the explanatory note of a project, or of one homework, for Word and as PDF."""
    from planmethod.project.notes import NoteOptions, note_files
    from planmethod.render.backends.output import write_all

    settled = request.resolve()
    project = load_project(problem, variant, position, settled)
    options = NoteOptions(settled.fields, template, frame)
    files = note_files(project, f"{basename(project.problem)}-note", options, formats)
    write_all(out, files, output_root=out)
    for name in files:
        click.echo(str(out / name))
    if shown:
        show(out / next(iter(files)))
