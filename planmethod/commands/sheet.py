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
from planmethod.commands.problems import (
    LoadedProblem,
    basename,
    finish,
    for_each_problem,
    guarded,
    message_name,
    reject_plan_options,
    warn,
    warn_of_accuracy,
    warn_of_change_points,
    warn_of_unused_tables,
    warn_of_wide_flywheel,
)
from planmethod.commands.sheet_options import PaperRequest, ResolvedRequest, sheet_options
from planmethod.errors import LayoutError
from planmethod.languages import translate
from planmethod.options import (
    BadParameter,
    Positions,
    UsageError,
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
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from planmethod.construct.drafting import Profile
    from planmethod.problem.model import Problem
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


MAX_SHEETS = 6
"""Maximum number of sheets of one problem without confirmation."""


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
        There are more positions than fit on small paper.
    """
    from planmethod.problem.model import Scales
    from planmethod.solved.legibility import FEW

    asked = problem.drive.positions if positions is None else positions
    if len(asked) > FEW:
        raise LayoutError(
            "{}: --compact is for at most {} positions, {} are requested. Request fewer "
            "(--phi 30,150), or omit --compact.",
            problem.name,
            FEW,
            len(asked),
        )
    return replace(problem, scales=Scales(convention=problem.scales.convention))


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
    item = replace(item, problem=options.request.over(item.problem))
    if item.kind is not None:
        return item
    if item.linkage.project is not None and options.layout is None:
        warn_of_unused_tables(item.linkage)
    if options.phi is not None or options.position is not None:
        # The decisions of a project apply to its own positions.
        item = replace(item, problem=replace(item.linkage, calculated=options.position))
    warn_of_change_points(item.linkage, options.phi)
    drawn = _drawn_positions(item.linkage, options)
    warn_of_accuracy(item.linkage, drawn, forces=_has_forces(options.layout))
    if options.layout is not None and options.phi is None:
        _warn_of_unused_positions(item.linkage, options.layout)
    if item.linkage.machine is not None and _has_flywheel(options.layout):
        from planmethod.solved.machine.flywheel import Flywheel

        warn_of_wide_flywheel(Flywheel(item.linkage))
    return item


def _drawn_positions(problem: Problem, options: SheetOptions) -> list[float] | None:
    """Return the positions of the sheets; None for those of the file."""
    if options.phi is not None:
        return [float(place) for place in options.phi]
    if options.layout is None or not problem.drive.goes_round:
        return None
    from planmethod.render.sheets.composition import composition

    if not composition(options.layout).cycle:
        return None
    from planmethod.solved.solution import Solution
    from planmethod.solved.turn.extremes import numbered_positions

    return [float(place) for place in numbered_positions(Solution(problem))]


def _warn_of_unused_positions(problem: Problem, layout: str) -> None:
    """Warn that the sheets of the cycle leave the positions of a file without [cycle] out."""
    from planmethod.render.sheets.composition import composition

    drive = problem.drive
    if problem.cycle is not None or not drive.goes_round or len(drive.positions) < 2:
        return
    if not composition(layout).cycle:
        return
    from planmethod.problem.model import SAME_DEG
    from planmethod.solved.solution import Solution
    from planmethod.solved.turn.extremes import numbered_positions

    positions = numbered_positions(Solution(problem)).tolist()
    apart = [abs((a - b + 180.0) % 360.0 - 180.0)
             for a, b in zip(positions, drive.positions, strict=False)]  # fmt: skip
    if len(positions) != len(drive.positions) or max(apart) > SAME_DEG:
        text = translate(
            "layout {} has the positions of the cycle, {} from {:.5g}° on, not the {} of "
            "driver.phi from {:.5g}° on. With [cycle] zero = {:g}, count = {} in place of phi all "
            "outputs have the same; --phi asks others.",
            layout,
            len(positions),
            positions[0],
            len(drive.positions),
            drive.positions[0],
            drive.positions[0],
            len(drive.positions),
        )
        warn(problem, text)


def _has_forces(layout: str | None) -> bool:
    """Return whether the sheets show forces, or results of them."""
    from planmethod.render.sheets.blocks import has_forces
    from planmethod.render.sheets.composition import composition

    return layout is not None and any(
        has_forces(entry.kind) for entry in composition(layout).blocks
    )


def _has_flywheel(layout: str | None) -> bool:
    """Return whether the sheets show the sizes of a flywheel."""
    from planmethod.render.sheets.composition import composition

    return layout is not None and any(
        entry.kind == "flywheel" for entry in composition(layout).blocks
    )


def drawn_for(
    item: LoadedProblem,
    options: SheetOptions,
    *,
    before: int = 0,
    total: int | None = None,
    profile: Profile | None = None,
) -> list[Drawing]:
    """Draw the sheets of a problem; ``before`` of the set of ``total`` go before them."""
    phi, errors, sigma, layout = options.phi, options.errors, options.sigma, options.layout
    fields = options.request.fields
    profile = profile or drawn_by(options.profile, options.ruler)
    kind = item.kind
    if kind is not None:
        reject_plan_options(
            kind,
            phi=phi is not None,
            position=options.position is not None,
            layout=layout,
            errors=errors,
            sigma=bool(sigma),
        )
        return kind.drawings(
            item.problem, fields=fields, profile=profile, before=before, total=total
        )
    from planmethod.render.frame import Furniture
    from planmethod.render.sheets.kinematics import kinematics_sheets

    problem, positions = item.linkage, None if phi is None else phi.tolist()
    if options.quantities and not problem.drive.goes_round:
        raise UsageError("--ask: {}: the driver slides and has no turn", message_name(problem))
    return kinematics_sheets(
        compacted(problem, positions) if options.compact else problem,
        positions=positions,
        profile=profile,
        fields=fields,
        furniture=Furniture.of(problem.sheet, before=before, total=total),
        errors=errors,
        sigma=sigma,
        layout=layout,
        most=None if options.all_positions or options.compact else MAX_SHEETS,
        asked=options.quantities,
    )


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
