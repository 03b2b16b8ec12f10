"""Command ``protocol``: description of the construction, step by step."""

from __future__ import annotations

from pathlib import Path

import click
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import write_text
from planmethod.commands.problems import LoadedProblem, finish, for_each_problem, language_of
from planmethod.options import (
    DraftingOptions,
    PathType,
    PlanRequest,
    Positions,
    ProblemChoice,
    analytic_option,
    basename,
    centres_option,
    option,
    position_option,
    positions_option,
    problem_lang_option,
)


class ProtocolOptions(Struct, frozen=True, kw_only=True):
    """Options of ``protocol``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    phi: Positions | None = positions_option()
    drafting: DraftingOptions = field(default_factory=DraftingOptions)
    out: Path | None = option(
        "-o",
        "--out",
        type=PathType(file_okay=False),
        help="Folder for a text file. Default: print to the terminal.",
    )
    position: int | None = position_option(
        "Number of the position, from 0. Default: the calculated position of the project, or 0."
    )
    analytic: bool = analytic_option()
    centres: bool = centres_option()
    form: str = option(
        "--format",
        type=click.Choice(["text", "md"]),
        default="text",
        show_default=True,
        help="Plain text, or Markdown with LaTeX formulas.",
    )
    lang: str | None = problem_lang_option()


@command(ProtocolOptions)
def protocol(options: ProtocolOptions) -> None:
    """Describe the construction step by step, as in the explanatory note."""
    from planmethod.note.wording import get_language

    if options.form == "md":
        from planmethod.note.writers.markdown import markdown_document as write
    else:
        from planmethod.note.writers.terminal import plain_document as write

    request = PlanRequest(
        phi=options.phi,
        drafting=options.drafting,
        position=options.position,
        analytic=options.analytic,
        centres=options.centres,
    )

    def write_protocol(item: LoadedProblem) -> None:
        kind, problem = item.kind, item.problem
        language = get_language(language_of(problem, options.lang))
        kind.reject_options(problem, request)
        text = write(kind.protocol_document(problem, language, request), language) + "\n"
        name = f"{basename(problem)}-protocol.{'txt' if options.form == 'text' else options.form}"
        write_text(text, None if options.out is None else str(options.out / name))

    finish(for_each_problem(options.choice, write_protocol))
