"""Command ``audit``: printed values beside the exact and the measured ones."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from planmethod.commands.output import LocalizedCommand, write_text
from planmethod.commands.problems import LoadedProblem, finish, for_each_problem, guarded
from planmethod.options import UsageError, lang_option, problem_options, ruler_option

if TYPE_CHECKING:
    from planmethod.problem.records import KindProblem


@click.command(cls=LocalizedCommand)
@problem_options
@ruler_option
@lang_option
@click.option(
    "-o",
    "--out",
    "file",
    metavar="FILE",
    help="Markdown file. Default: the terminal.",
)
@guarded
def audit(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    ruler: float,
    lang: str,
    file: str | None,
) -> None:
    """Compare what the sources print with the exact values and with the ruler's."""
    from planmethod.note.audit import AuditDocument

    if file is not None and file.lower().endswith(".toml"):
        raise UsageError("-o would write over the problem file {}; name another one", file)
    audits: list[tuple[KindProblem, Any]] = []

    def compare(item: LoadedProblem) -> None:
        audits.append((item.problem, item.kind.audited(item.problem, ruler)))

    # A faulty problem ends the command here: the document is written whole or not at all.
    finish(for_each_problem(problems, variant, all_variants, compare))
    write_text(AuditDocument(lang, ruler).markdown(audits), file)
