"""Command ``sheet``: the framed sheet of the kinematic analysis."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Literal, Protocol

import click
from msgspec.structs import replace

from planmethod.commands.asked import Asked, sheet_options
from planmethod.commands.helptext import Spoken
from planmethod.commands.output import write_drawings, write_set
from planmethod.commands.problems import each, finish, guarded, refuse_plans, stem, tell_changes
from planmethod.commands.watch import watch_option
from planmethod.errors import LayoutError
from planmethod.options import (
    BadParameter,
    Positions,
    UsageError,
    drawing_options,
    drawn_by,
    format_option,
    jobs_option,
    layout_option,
    out_option,
    problem_options,
    reading_options,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from planmethod.construct.drafting import Profile
    from planmethod.kinds import Kind
    from planmethod.problem.head import KindProblem
    from planmethod.problem.model import Problem
    from planmethod.render.ink.drawing import Drawing


class _Draw(Protocol):
    """Draws the sheets of a problem as a part of a set."""

    def __call__(
        self, *, before: int = ..., total: int | None = ..., hand: Profile = ...
    ) -> list[Drawing]: ...


def read_name(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    """Return the name of a PDF file."""
    if value is not None and Path(value).suffix.lower() != ".pdf":
        raise BadParameter("{!r} does not end in .pdf", value)
    return value


def compacted(problem: Problem, positions: Sequence[float] | None) -> Problem:
    """Return a problem without its scales, which are for larger paper.

    Raises
    ------
    LayoutError
        More positions are asked than small paper has room for.
    """
    from planmethod.problem.model import Scales
    from planmethod.solved.room import FEW

    asked = problem.drive.positions if positions is None else positions
    if len(asked) > FEW:
        raise LayoutError(
            "{}: --compact is for at most {} positions, {} are asked. Ask fewer (--phi 30,150), or "
            "leave --compact out.",
            problem.name,
            FEW,
            len(asked),
        )
    return replace(problem, scales=Scales(convention=problem.scales.convention))


@click.command(cls=Spoken)
@problem_options
@reading_options
@out_option
@format_option("svg,pdf")
@sheet_options
@layout_option
@click.option(
    "--compact",
    is_flag=True,
    help="For a printer at home: several sheets of A4 (A3 with --paper), up to five positions, at "
    "scales of their own.",
)
@click.option(
    "--one-file",
    callback=read_name,
    metavar="NAME.pdf",
    help="All sheets in one PDF, numbered consecutively, not one PDF for each problem; "
    "by one process.",
)
@drawing_options
@jobs_option
@watch_option(draws=True)
@guarded
def sheet(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    phi: Positions | None,
    ruler: float | None,
    profile: str | None,
    out: Path,
    formats: tuple[str, ...],
    asked: Asked,
    layout: str | None,
    compact: bool,
    one_file: str | None,
    errors: bool,
    sigma: bool | None,
    dpi: int,
    dxf_text: Literal["text", "strokes"],
    jobs: int,
) -> None:
    """Draw the framed sheet: scheme, velocity and acceleration plans, equations, tables."""
    from planmethod.render.frame.furniture import Furniture
    from planmethod.render.sheets.composition.reader import composition
    from planmethod.render.sheets.kinematics import kinematics_sheets

    if compact:
        if layout is not None:
            raise UsageError("give --compact or --layout, not both")
        layout = "compact"
    if layout is not None:
        composition(layout)  # its faults are told once, before any problem is drawn
    positions = None if phi is None else phi.tolist()
    settled = asked.settle()

    hand = drawn_by(profile, ruler)
    # What a CAD program measures is drawn as such programs draw, if nobody wants another hand.
    cad = drawn_by(None, None, usual="cad") if profile is None and ruler is None else None

    def drawn(
        problem: Problem, *, before: int = 0, total: int | None = None, hand: Profile = hand
    ) -> list[Drawing]:
        return kinematics_sheets(
            compacted(problem, positions) if compact else problem,
            positions=positions,
            profile=hand,
            fields=asked.fields,
            furniture=Furniture.of(problem.sheet, before=before, total=total),
            errors=errors,
            sigma=sigma,
            layout=layout,
        )

    def drawn_other(
        kind: Kind,
        problem: KindProblem,
        *,
        before: int = 0,
        total: int | None = None,
        hand: Profile = hand,
    ) -> list[Drawing]:
        refuse_plans(kind, phi=phi is not None, layout=layout, errors=errors, sigma=bool(sigma))
        return kind.drawings(problem, fields=asked.fields, profile=hand, before=before, total=total)

    def written(
        problem: KindProblem,
        draw: _Draw,
        formats: Iterable[str],
        drawings: list[Drawing] | None = None,
    ) -> None:
        author = asked.author(problem)
        apart = [fmt for fmt in formats if fmt == "dxf" and cad is not None]
        for some in ([fmt for fmt in formats if fmt not in apart], apart):
            if some:
                made = draw(hand=cad) if some is apart and cad else drawings or draw()
                write_drawings(
                    made, out, stem(problem), some, dpi=dpi, author=author, dxf_text=dxf_text
                )

    whole: list[tuple[KindProblem, _Draw, list[Drawing]]] = []

    def take(problem: KindProblem, draw: _Draw) -> None:
        if one_file is None:
            written(problem, draw, formats)
            return
        draw = partial(draw, before=sum(len(some) for *_, some in whole))
        whole.append((problem, draw, draw()))

    def draw(problem: Problem) -> None:
        problem = settled(problem)
        tell_changes(problem, phi)
        take(problem, partial(drawn, problem))

    def draw_other(kind: Kind, problem: KindProblem) -> None:
        problem = settled(problem)
        take(problem, partial(drawn_other, kind, problem))

    jobs = jobs if one_file is None else 1
    code = each(problems, variant, all_variants, draw, draw_other, jobs=jobs)
    if one_file is not None and whole:
        # The first sheet says how many there are, which is known only now.
        first, draw_first, _ = whole[0]
        draw_first = partial(draw_first, total=sum(len(some) for *_, some in whole))
        whole[0] = (first, draw_first, draw_first())
        for one, draw_one, drawings in whole:
            written(one, draw_one, [fmt for fmt in formats if fmt != "pdf"], drawings)
        pages = [drawing for *_, drawings in whole for drawing in drawings]
        write_set(pages, out / one_file, author=asked.author(first))
    finish(code)
