"""Command ``lint``: norm control of the sheets (нормоконтроль)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from planmethod.commands.asked import Asked, sheet_options
from planmethod.commands.helptext import Spoken
from planmethod.commands.output import json_text
from planmethod.commands.problems import each, finish, guarded, refuse_plans, stem
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
    from planmethod.kinds import Kind
    from planmethod.problem.head import KindProblem
    from planmethod.problem.model import Problem
    from planmethod.render.sheets.controlled import Controlled


@click.command(cls=Spoken)
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
    asked: Asked,
    layout: str | None,
    errors: bool,
    sigma: bool | None,
    structural: bool,
    strict: bool,
    as_json: bool,
    jobs: int,
) -> None:
    """Check the sheets and say what a norm inspector would mark (нормоконтроль).

    PROBLEM is a problem file: its sheets are drawn as the commands sheet and structure draw them,
    with the same options, and are not written. Exit code 0 when there is nothing to correct, 1 when
    there are errors. The codes: docs/normcontrol.md.
    """
    from planmethod.languages import LANGUAGES
    from planmethod.render.control.remarks import Severity
    from planmethod.render.sheets.composition.reader import composition
    from planmethod.render.sheets.control_report import control_record, control_text, counted
    from planmethod.render.sheets.controlled import (
        controlled_kinematics,
        controlled_structure,
        looked_over,
    )

    if structural and (phi is not None or errors or sigma or layout is not None):
        raise UsageError(
            "--phi, --errors, --sigma and --layout are of the plans; the sheet of "
            "--structure has none"
        )
    if layout is not None:
        composition(layout)  # its faults are told once, before any problem is drawn
    positions = None if phi is None else phi.tolist()
    settled = asked.settle()
    looked: list[tuple[dict[str, Any] | None, int]] = []

    def look(problem: Problem) -> tuple[dict[str, Any] | None, int]:
        problem = settled(problem)
        lang = problem.sheet.lang or LANGUAGES[0]
        if structural:
            sheets = controlled_structure(problem, fields=asked.fields)
        else:
            sheets = controlled_kinematics(
                problem,
                positions=positions,
                profile=drawn_by(profile, ruler),
                fields=asked.fields,
                errors=errors,
                sigma=sigma,
                layout=layout,
            )
        return tell(problem, "structure" if structural else "kinematics", sheets, lang)

    def look_other(kind: Kind, problem: KindProblem) -> tuple[dict[str, Any] | None, int]:
        refuse_plans(
            kind, phi=phi is not None, layout=layout, errors=errors, sigma=bool(sigma),
            structure=structural,
        )  # fmt: skip
        problem = settled(problem)
        drawings = kind.drawings(problem, fields=asked.fields, profile=drawn_by(profile, ruler))
        return tell(
            problem,
            kind.table,
            looked_over(drawings, kind.scales),
            problem.sheet.lang or LANGUAGES[0],
        )

    def tell(
        problem: KindProblem, kind: str, sheets: list[Controlled], lang: str
    ) -> tuple[dict[str, Any] | None, int]:
        marked = counted(sheets, Severity.ERROR)
        if strict:
            marked += counted(sheets, Severity.WARNING)
        if as_json:
            return control_record(problem.name, problem.variant, kind, sheets, lang), marked
        click.echo(control_text(stem(problem), sheets, lang))
        return None, marked

    code = each(problems, variant, all_variants, look, look_other, jobs=jobs, take=looked.append)
    records = [record for record, _ in looked if record is not None]
    if records:
        whole: Any = records[0] if len(records) == 1 else records
        click.echo(json_text(whole))
    finish(code)
    finish(ExitCode.FINDINGS if any(marked for _, marked in looked) else ExitCode.DONE)
