"""Command ``lint``: norm control of the sheets (нормоконтроль)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

import click
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import json_text
from planmethod.commands.problems import LoadedProblem, finish, for_each_problem, language_of
from planmethod.commands.sheet_options import PaperRequest, ResolvedRequest
from planmethod.errors import ExitCode
from planmethod.options import (
    DraftingOptions,
    DrawingOptions,
    PlanRequest,
    Positions,
    ProblemChoice,
    UsageError,
    basename,
    jobs_option,
    json_option,
    layout_option,
    option,
    positions_option,
    structure_option,
)


class LintOptions(Struct, frozen=True, kw_only=True):
    """Options of ``lint``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    phi: Positions | None = positions_option()
    drafting: DraftingOptions = field(default_factory=DraftingOptions)
    paper: PaperRequest = field(default_factory=PaperRequest)
    layout: str | None = layout_option()
    errors: bool = option(
        "--errors", is_flag=True, help="Check sheets with the error ellipses of the drafting."
    )
    sigma: bool | None = option(
        "--sigma/--no-sigma",
        default=None,
        help="Check sheets with the drafting errors in the table of results.",
    )
    structural: bool = structure_option()
    strict: bool = option("--strict", is_flag=True, help="Exit with code 1 for warnings, too.")
    as_json: bool = json_option("Print the findings as one JSON object.")
    jobs: int = jobs_option()

    def reject_contradictions(self) -> None:
        """Reject options of the plans beside the structural sheet.

        Raises
        ------
        click.UsageError
        """
        plans = self.phi is not None or self.errors or self.sigma or self.layout is not None
        if self.structural and plans:
            raise UsageError(
                "--phi, --errors, --sigma and --layout apply to plans; the sheet of "
                "--structure has no plans"
            )

    def plan_request(self, fields: Mapping[str, str]) -> PlanRequest:
        """Return the request of the inspected sheets, with texts of the title block."""
        return PlanRequest(
            fields=fields,
            phi=self.phi,
            drafting=self.drafting,
            layout=self.layout,
            drawing=DrawingOptions(errors=self.errors, sigma=self.sigma),
            structural=self.structural,
        )


@command(LintOptions, findings="A sheet has a fault that is an error, or with --strict a warning.")
def lint(options: LintOptions) -> None:
    """Check the sheets against the drawing standards (нормоконтроль).

    The sheets of PROBLEM are drawn as by the commands sheet and structure, with the same options,
    but not written. For a file with [project] these are the sheets of the command project. Exit
    code 0 if the sheets need no correction, 1 if there are errors. The codes:
    docs/reference/lint-codes.md.
    """
    from planmethod.render.sheets.composition import composition

    options.reject_contradictions()
    if options.layout is not None:
        composition(options.layout)  # its faults are reported once, before any problem is drawn
    act = partial(inspect_problem, options=options, settings=options.paper.resolve())
    looked: list[tuple[dict[str, Any] | None, int]] = []
    code = for_each_problem(options.choice, act, jobs=options.jobs, on_result=looked.append)
    records = [record for record, _ in looked if record is not None]
    if records:
        whole: Any = records[0] if len(records) == 1 else records
        click.echo(json_text(whole))
    finish(code)
    finish(ExitCode.FINDINGS if any(marked for _, marked in looked) else ExitCode.DONE)


def inspect_problem(
    item: LoadedProblem, options: LintOptions, settings: ResolvedRequest
) -> tuple[dict[str, Any] | None, int]:
    """Inspect the sheets of a problem; return the record, if requested, and the error count."""
    from planmethod.render.control.remarks import Severity
    from planmethod.render.sheets.controlled import control_record, control_text, counted

    kind, problem = item.kind, settings.over(item.problem)
    request = options.plan_request(settings.fields)
    kind.reject_options(problem, request)
    what, sheets = kind.checked_sheets(problem, request)
    lang = language_of(problem, None)
    marked = counted(sheets, Severity.ERROR)
    if options.strict:
        marked += counted(sheets, Severity.WARNING)
    if options.as_json:
        return control_record(problem.name, problem.variant, what, sheets, lang), marked
    click.echo(control_text(basename(problem), sheets, lang))
    return None, marked
