"""Command ``sheet``: the framed sheet of the kinematic analysis."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from planmethod.commands.output import write_drawings
from planmethod.commands.problems import each, finish, guarded, stem
from planmethod.options import (
    Positions,
    drawn_by,
    dxf_text_option,
    format_option,
    layout_option,
    out_option,
    problem_options,
    reading_options,
    stamp_option,
)

if TYPE_CHECKING:
    from planmethod.problem.model import Problem


@click.command()
@problem_options
@reading_options
@out_option
@format_option("svg,pdf")
@click.option("--paper", metavar="FORMAT", help="A4, A3, A2, A1; chosen to fit when absent.")
@stamp_option
@layout_option
@click.option("--errors", is_flag=True, help="Draw the error ellipses of the drafting, 2 sigma.")
@click.option("--sigma", is_flag=True, help="Show the drafting errors in the table of results.")
@click.option("--dpi", type=click.IntRange(30, 600), default=100, show_default=True, help="Of PNG.")
@dxf_text_option
@guarded
def sheet(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    phi: Positions | None,
    ruler: float | None,
    profile: str,
    out: Path,
    formats: tuple[str, ...],
    paper: str | None,
    stamp: dict[str, str],
    layout: str | None,
    errors: bool,
    sigma: bool,
    dpi: int,
    dxf_text: Literal["text", "strokes"],
) -> None:
    """Draw the framed sheet: scheme, velocity and acceleration plans, equations, tables."""
    from planmethod.render.sheets.composition.reader import composition
    from planmethod.render.sheets.kinematics import kinematics_sheets

    composed = None if layout is None else composition(layout)
    positions = None if phi is None else phi.tolist()

    def draw(problem: Problem) -> None:
        drawings = kinematics_sheets(
            problem,
            paper=paper,
            positions=positions,
            profile=drawn_by(profile, ruler),
            fields=stamp,
            errors=errors,
            sigma=sigma,
            layout=composed,
        )
        write_drawings(
            drawings,
            out,
            stem(problem),
            formats,
            dpi=dpi,
            author=stamp.get("author"),
            dxf_text=dxf_text,
        )

    finish(each(problems, variant, all_variants, draw))
