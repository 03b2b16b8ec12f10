"""Command ``defence``: questions for the defence of a work, and the answers to them."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import click
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import show
from planmethod.commands.project_context import load_noted
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


class DefenceOptions(Struct, frozen=True, kw_only=True):
    """Options of ``defence``."""

    problem: Path = problem_argument()
    variant: str | None = variant_option()
    position: int | None = position_option()
    seed: int = option(
        "--seed",
        type=click.IntRange(0, 2**31 - 1),
        default=0,
        show_default=True,
        help="Number that determines the choice of questions: another one for each student.",
    )
    count: int | None = option(
        "--count",
        type=click.IntRange(1, 1000),
        help="Number of questions. Default: one of each kind, at least 50 if the work gives them.",
    )
    formats: tuple[str, ...] = option(
        "--format",
        read=partial(read_names, known=("docx", "pdf", "md"), empty_message=NO_FORMAT),
        default="docx,pdf",
        show_default=True,
        help="docx,pdf,md.",
    )
    moodle: bool = option("--moodle", is_flag=True, help="Also write the questions as Moodle XML.")
    out: Path = out_option()
    paper: PaperRequest = field(default_factory=PaperRequest)
    shown: bool = open_option()


@command(DefenceOptions)
def defence(options: DefenceOptions) -> None:
    """Write questions for the defence about your own numbers and sheets, and the answers.

    Each question names the sheet, the view and the zone where its answer is seen. Writes NAME-
    defence and NAME-defence-answers into OUT.
    """
    from planmethod.defence.case import Case
    from planmethod.defence.files import defence_files
    from planmethod.defence.pack import draw_pack
    from planmethod.render.backends.output import write_all

    settled, out = options.paper.resolve(), options.out
    work = load_noted(options.problem, options.variant, options.position, settled)
    case = Case(work)
    questions = draw_pack(case, seed=options.seed, count=options.count)
    name = f"{basename(work.problem)}-defence"
    files = defence_files(questions, case, name, options.formats, moodle=options.moodle)
    write_all(out, files, output_root=out)
    for file in files:
        click.echo(str(out / file))
    if options.shown:
        show(out / next(iter(files)))
