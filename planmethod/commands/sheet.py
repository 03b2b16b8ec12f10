"""Command ``sheet``: the framed sheet of the kinematic analysis."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click
from msgspec import Struct
from msgspec.structs import replace

from planmethod.commands.output import (
    LocalizedCommand,
    show,
    watch_option,
    write_drawings,
    write_set,
)
from planmethod.commands.problems import LoadedProblem, finish, for_each_problem, guarded
from planmethod.commands.sheet_options import PaperRequest, ResolvedRequest, sheet_options
from planmethod.options import (
    BadParameter,
    Positions,
    UsageError,
    basename,
    drawing_options,
    drawn_by,
    format_option,
    jobs_option,
    layout_option,
    open_option,
    out_option,
    position_option,
    problem_options,
    read_labels,
    reading_options,
    warn_each,
)

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planmethod.construct.drafting import Profile
    from planmethod.kind import PlanRequest
    from planmethod.render.ink.drawing import Drawing


class SheetOptions(Struct, frozen=True, kw_only=True):
    """Settings of the sheets of every problem; the options of the command."""

    request: ResolvedRequest
    phi: Positions | None
    position: int | None = None
    ruler: float | None
    profile: str | None
    layout: str | None
    quantities: tuple[str, ...] = ()
    compact: bool = False
    errors: bool
    sigma: bool | None
    out: Path
    formats: tuple[str, ...]
    dpi: int
    dxf_text: Literal["text", "strokes"]
    all_positions: bool = False

    def plan_request(
        self, *, before: int = 0, total: int | None = None, profile: Profile | None = None
    ) -> PlanRequest:
        """Return the options of drawing a problem, with another profile if one is given."""
        from planmethod.kind import PlanRequest

        return PlanRequest(
            profile=profile or drawn_by(self.profile, self.ruler),
            fields=self.request.fields,
            before=before,
            total=total,
            phi=self.phi,
            position=self.position,
            layout=self.layout,
            quantities=self.quantities,
            compact=self.compact,
            errors=self.errors,
            sigma=self.sigma,
            all_positions=self.all_positions,
        )


def read_name(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    """Return the name of a PDF file."""
    if value is not None and Path(value).suffix.lower() != ".pdf":
        raise BadParameter("{!r} does not end in .pdf", value)
    return value


@click.command(cls=LocalizedCommand)
@problem_options
@reading_options
@position_option
@out_option
@format_option("svg,pdf")
@sheet_options
@layout_option
@click.option(
    "--ask",
    callback=read_labels,
    metavar="LIST",
    help="Graphs over the turn of these quantities: x_C,phi_3,v_q_C,u_31,omega_3,ay_C; on the "
    "layout graphs without --layout.",
)
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
@open_option
@watch_option(draws=True)
@guarded
def sheet(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    phi: Positions | None,
    position: int | None,
    ruler: float | None,
    profile: str | None,
    out: Path,
    formats: tuple[str, ...],
    request: PaperRequest,
    layout: str | None,
    ask: tuple[str, ...] | None,
    compact: bool,
    one_file: str | None,
    errors: bool,
    sigma: bool | None,
    dpi: int,
    dxf_text: Literal["text", "strokes"],
    all_positions: bool,
    jobs: int,
    shown: bool,
) -> None:
    """Draw the framed sheet: scheme, velocity and acceleration plans, equations, tables."""
    from planmethod.render.sheets.composition import composition

    if compact:
        if layout is not None:
            raise UsageError("give --compact or --layout, not both")
        layout = "compact"
    layout = "graphs" if ask and layout is None else layout
    if layout is not None:
        made = composition(layout)  # its faults are reported once, before any problem is drawn
        if ask and not any(entry.kind == "graphs" for entry in made.blocks):
            raise UsageError(
                "--ask: layout {} has no block of kind graphs. Leave --layout out, or add one.",
                layout,
            )
    options = SheetOptions(
        request=request.resolve(),
        phi=phi,
        position=position,
        ruler=ruler,
        profile=profile,
        layout=layout,
        quantities=ask or (),
        compact=compact,
        errors=errors,
        sigma=sigma,
        out=out,
        formats=formats,
        dpi=dpi,
        dxf_text=dxf_text,
        all_positions=all_positions,
    )
    if one_file is None:
        act = partial(draw, options=options)
        files: list[Path] = []
        code = for_each_problem(
            problems, variant, all_variants, act, jobs=jobs, on_result=files.append
        )
        if shown and files:
            show(files[0])
        finish(code)
        return
    whole: list[tuple[LoadedProblem, int, list[Drawing]]] = []

    def draw_sheets(item: LoadedProblem) -> None:
        item = resolve_problem(item, options)
        before = sum(len(drawings) for *_, drawings in whole)
        whole.append((item, before, drawn_for(item, options, before=before)))

    code = for_each_problem(problems, variant, all_variants, draw_sheets)
    if whole:
        # The first sheet has the number of sheets, which is known only now.
        total = sum(len(drawings) for *_, drawings in whole)
        first = whole[0][0]
        whole[0] = (first, 0, drawn_for(first, options, total=total))
        apart = [fmt for fmt in formats if fmt != "pdf"]
        for item, before, drawings in whole:
            named = total if item is first else None
            _write(item, options, apart, drawings, before=before, total=named)
        pages = [drawing for *_, drawings in whole for drawing in drawings]
        write_set(pages, out / one_file, author=options.request.author(first.problem))
        if shown:
            show(out / one_file)
    finish(code)


def draw(item: LoadedProblem, options: SheetOptions) -> Path:
    """Draw and write the sheets of a problem; return the file to look at, a PDF if there is one."""
    item = resolve_problem(item, options)
    files = _write(item, options, options.formats, None)
    return next((file for file in files if file.suffix == ".pdf"), files[0])


def resolve_problem(item: LoadedProblem, options: SheetOptions) -> LoadedProblem:
    """Return a problem with all settings of its sheets; print its warnings."""
    request = options.plan_request()
    problem = item.kind.in_positions(options.request.over(item.problem), request)
    warn_each(problem, item.kind.sheet_warnings(problem, request))
    return replace(item, problem=problem)


def drawn_for(
    item: LoadedProblem,
    options: SheetOptions,
    *,
    before: int = 0,
    total: int | None = None,
    profile: Profile | None = None,
) -> list[Drawing]:
    """Draw the sheets of a problem; ``before`` of the set of ``total`` go before them."""
    request = options.plan_request(before=before, total=total, profile=profile)
    item.kind.reject_options(item.problem, request.of_linkages())
    return item.kind.drawings(item.problem, request)


def _write(
    item: LoadedProblem,
    options: SheetOptions,
    formats: Iterable[str],
    drawings: list[Drawing] | None,
    *,
    before: int = 0,
    total: int | None = None,
) -> list[Path]:
    """Write the sheets of a problem, drawn now if they are not drawn yet; return the files."""
    formats = list(formats)
    # DXF, for CAD programs, has their accuracy, unless another one is requested.
    cad = None
    if "dxf" in formats and options.profile is None and options.ruler is None:
        cad = drawn_by(None, None, usual="cad")
        formats.remove("dxf")
    write = partial(
        write_drawings,
        out=options.out,
        basename=basename(item.problem),
        dpi=options.dpi,
        author=options.request.author(item.problem),
        dxf_text=options.dxf_text,
    )
    files: list[Path] = []
    if formats:
        files += write(
            drawings or drawn_for(item, options, before=before, total=total), formats=formats
        )
    if cad is not None:
        drawings = drawn_for(item, options, before=before, total=total, profile=cad)
        files += write(drawings, formats=["dxf"])
    return files
