"""Command ``lint``: norm control of the sheets (нормоконтроль)."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from msgspec import Struct
from msgspec.structs import replace

from planmethod.commands.output import LocalizedCommand, json_text
from planmethod.commands.problems import (
    LoadedProblem,
    basename,
    finish,
    for_each_problem,
    guarded,
    language_of,
    reject_plan_options,
)
from planmethod.commands.sheet_options import PaperRequest, ResolvedRequest, sheet_options
from planmethod.errors import ExitCode
from planmethod.options import (
    Positions,
    UsageError,
    drawn_by,
    jobs_option,
    layout_option,
    problem_options,
    reading_options,
)

if TYPE_CHECKING:
    from planmethod.problem.model import Problem
    from planmethod.render.sheets.controlled import CheckedSheet


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
    from planmethod.render.control.remarks import Severity
    from planmethod.render.sheets.controlled import control_record, control_text, counted

    problem = options.request.over(item.problem)
    what, sheets = _inspected_sheets(replace(item, problem=problem), options)
    lang = language_of(problem, None)
    marked = counted(sheets, Severity.ERROR)
    if options.strict:
        marked += counted(sheets, Severity.WARNING)
    if options.as_json:
        return control_record(problem.name, problem.variant, what, sheets, lang), marked
    click.echo(control_text(basename(problem), sheets, lang))
    return None, marked


def _inspected_sheets(item: LoadedProblem, options: LintOptions) -> tuple[str, list[CheckedSheet]]:
    """Return the kind of the sheets of a problem, and the sheets with their remarks."""
    from planmethod.render.sheets.controlled import (
        check_drawings,
        controlled_kinematics,
        controlled_structure,
    )

    phi, errors, sigma, layout = options.phi, options.errors, options.sigma, options.layout
    fields, kind = options.request.fields, item.kind
    if kind is not None:
        reject_plan_options(
            kind, phi=phi is not None, layout=layout, errors=errors, sigma=bool(sigma),
            structure=options.structural,
        )  # fmt: skip
        hand = drawn_by(options.profile, options.ruler)
        drawings = kind.drawings(item.problem, fields=fields, profile=hand)
        return kind.table, check_drawings(drawings, kind.scales)
    usual = phi is None and layout is None and not errors and sigma is None
    if usual and _is_project(item.linkage) and not options.structural:
        return "project", _of_project(item, options)
    if options.structural:
        return "structure", controlled_structure(item.linkage, fields=fields)
    linkage = item.linkage
    if phi is not None:  # a project's decisions apply to its own positions
        linkage = replace(linkage, calculated=None)
    return "kinematics", controlled_kinematics(
        linkage,
        positions=None if phi is None else phi.tolist(),
        profile=drawn_by(options.profile, options.ruler),
        fields=fields,
        errors=errors,
        sigma=sigma,
        layout=layout,
    )


def _is_project(linkage: Problem) -> bool:
    """Return whether a file has [project], or parts of a project beside its linkage.

    A cam that drives the linkage is not such a part.
    """
    from planmethod.kinds import PROJECT_KINDS

    driving = set() if linkage.drive.cam_drive is None else {"cam"}
    parts = {kind.table for kind in PROJECT_KINDS} - driving
    return linkage.project is not None or bool(linkage.tables.keys() & parts)


def _of_project(item: LoadedProblem, options: LintOptions) -> list[CheckedSheet]:
    """Return the sheets of all parts of a project, as it draws them, inspected."""
    from planmethod.project.settle import settle
    from planmethod.project.sheets import numbered_set, part_drawings
    from planmethod.render.sheets.controlled import check_drawings

    project = settle(item.linkage, item.path)
    drawn = [part_drawings(project, part, options.request.fields) for part in project.parts]
    return [
        sheet
        for part, sheets in zip(project.parts, numbered_set(project, drawn), strict=True)
        for sheet in check_drawings(sheets, "[scales]" if part.kind is None else part.kind.scales)
    ]
