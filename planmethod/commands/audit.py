"""Command ``audit``: printed values beside the exact and the measured ones."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import write_text
from planmethod.commands.problems import LoadedProblem, finish, for_each_problem
from planmethod.options import ProblemChoice, UsageError, lang_option, option, ruler_option

if TYPE_CHECKING:
    from planmethod.problem.records import KindProblem


class AuditOptions(Struct, frozen=True, kw_only=True):
    """Options of ``audit``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    ruler: float = ruler_option(
        default=0.5, show_default=True, help="Ruler graduation for reading the plans, mm."
    )
    lang: str = lang_option()
    file: str | None = option(
        "-o",
        "--out",
        metavar="FILE",
        help="Markdown file to write. Default: print to the terminal.",
    )


@command(AuditOptions)
def audit(options: AuditOptions) -> None:
    """Compare values printed in the sources with exact values and ruler readings."""
    from planmethod.note.audit import AuditDocument

    ruler, file = options.ruler, options.file
    if file is not None and file.lower().endswith(".toml"):
        raise UsageError("-o would overwrite the problem file {}; name another one", file)
    audits: list[tuple[KindProblem, Any]] = []

    def compare(item: LoadedProblem) -> None:
        audits.append((item.problem, item.kind.audited(item.problem, ruler)))

    # A faulty problem ends the command here: the document is written whole or not at all.
    finish(for_each_problem(options.choice, compare))
    write_text(AuditDocument(options.lang, ruler).markdown(audits), file)
