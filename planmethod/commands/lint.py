"""Command ``lint``: norm control of the sheets (нормоконтроль)."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

import click
from msgspec import Struct

from planmethod.commands.output import LocalizedCommand, json_text
from planmethod.commands.problems import (
    LoadedProblem,
    finish,
    for_each_problem,
    guarded,
    language_of,
)
from planmethod.commands.sheet_options import PaperRequest, ResolvedRequest, sheet_options
from planmethod.errors import ExitCode
from planmethod.options import (
    Positions,
    UsageError,
    basename,
    drawn_by,
    jobs_option,
    layout_option,
    problem_options,
    reading_options,
)


class LintOptions(Struct, frozen=True, kw_only=True):
    """Sheets to inspect and form of the report; the options of the command."""

    request: ResolvedRequest
    phi: Positions | None
    ruler: float | None
    profile: str | None
    layout: str | None
    errors: bool
    sigma: bool | None
    structural: bool
    strict: bool
    as_json: bool


@click.command(cls=LocalizedCommand)
@problem_options
@reading_options
@sheet_options
@layout_option
@click.option("--errors", is_flag=True, help="With the error ellipses of the drafting.")
@click.option(
    "--sigma/--no-sigma", default=None, help="With the drafting errors in the table of results."
)
@click.option(
    "--structure", "structural", is_flag=True, help="The structural sheet, not the plans."
)
@click.option("--strict", is_flag=True, help="Exit with 1 for warnings, too.")
@click.option("--json", "as_json", is_flag=True, help="Print the findings as one JSON object.")
@jobs_option
@guarded
def lint(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    phi: Positions | None,
    ruler: float | None,
    profile: str | None,
    request: PaperRequest,
    layout: str | None,
    errors: bool,
    sigma: bool | None,
    structural: bool,
    strict: bool,
    as_json: bool,
    jobs: int,
) -> None:
    """Check the sheets against the drawing standards (нормоконтроль).

    PROBLEM is a problem file: its sheets are drawn as the commands sheet and structure draw them,
    with the same options, but not written; for a file with [project] all sheets that the command
    project draws. Exit code 0 if the sheets need no correction, 1 if there are errors. The codes:
    docs/normcontrol.md.
    """
    from planmethod.render.sheets.composition import composition

    if structural and (phi is not None or errors or sigma or layout is not None):
        raise UsageError(
            "--phi, --errors, --sigma and --layout are of the plans; the sheet of "
            "--structure has none"
        )
    if layout is not None:
        composition(layout)  # its faults are reported once, before any problem is drawn
    options = LintOptions(
        request=request.resolve(),
        phi=phi,
        ruler=ruler,
        profile=profile,
        layout=layout,
        errors=errors,
        sigma=sigma,
        structural=structural,
        strict=strict,
        as_json=as_json,
    )
    looked: list[tuple[dict[str, Any] | None, int]] = []
    act = partial(inspect_problem, options=options)
    code = for_each_problem(
        problems, variant, all_variants, act, jobs=jobs, on_result=looked.append
    )
    records = [record for record, _ in looked if record is not None]
    if records:
        whole: Any = records[0] if len(records) == 1 else records
        click.echo(json_text(whole))
    finish(code)
    finish(ExitCode.FINDINGS if any(marked for _, marked in looked) else ExitCode.DONE)


def inspect_problem(item: LoadedProblem, options: LintOptions) -> tuple[dict[str, Any] | None, int]:
    """Inspect the sheets of a problem; return the record, if requested, and the error count."""
    from planmethod.kind import PlanRequest
    from planmethod.render.control.remarks import Severity
    from planmethod.render.sheets.controlled import control_record, control_text, counted

    kind, problem = item.kind, options.request.over(item.problem)
    request = PlanRequest(
        profile=drawn_by(options.profile, options.ruler),
        fields=options.request.fields,
        phi=options.phi,
        layout=options.layout,
        errors=options.errors,
        sigma=options.sigma,
        structural=options.structural,
    )
    kind.reject_options(problem, request.of_linkages())
    what, sheets = kind.checked_sheets(problem, request)
    lang = language_of(problem, None)
    marked = counted(sheets, Severity.ERROR)
    if options.strict:
        marked += counted(sheets, Severity.WARNING)
    if options.as_json:
        return control_record(problem.name, problem.variant, what, sheets, lang), marked
    click.echo(control_text(basename(problem), sheets, lang))
    return None, marked
