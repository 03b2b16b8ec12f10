"""Command ``sheet``: the framed sheet of the kinematic analysis."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.commands.command import command
from planmethod.commands.output import show, write_drawings, write_set
from planmethod.commands.problems import LoadedProblem, finish, for_each_problem
from planmethod.commands.sheet_options import PaperRequest, ResolvedRequest
from planmethod.options import (
    BadParameter,
    DraftingOptions,
    DrawingOptions,
    FileOptions,
    PlanRequest,
    Positions,
    ProblemChoice,
    UsageError,
    basename,
    format_option,
    jobs_option,
    layout_option,
    open_option,
    option,
    out_option,
    position_option,
    positions_option,
    read_labels,
    warn_each,
    watch_option,
)

if TYPE_CHECKING:
    from planmethod.render.ink.drawing import Drawing


def read_name(value: str) -> str:
    """Return the name of a PDF file."""
    if Path(value).suffix.lower() != ".pdf":
        raise BadParameter("{!r} does not end in .pdf", value)
    return value


class SheetOptions(Struct, frozen=True, kw_only=True):
    """Options of ``sheet``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    phi: Positions | None = positions_option()
    drafting: DraftingOptions = field(default_factory=DraftingOptions)
    position: int | None = position_option()
    out: Path = out_option()
    formats: tuple[str, ...] = format_option("svg,pdf")
    paper: PaperRequest = field(default_factory=PaperRequest)
    layout: str | None = layout_option()
    quantities: tuple[str, ...] | None = option(
        "--ask",
        read=read_labels,
        metavar="LIST",
        help="Draw graphs of these quantities over the cycle: "
        "x_C,phi_3,v_q_C,u_31,omega_3,ay_C. Default layout: graphs.",
    )
    compact: bool = option(
        "--compact",
        is_flag=True,
        help="Home printing: several A4 sheets (A3 with --paper), up to five positions, "
        "with separate scales.",
    )
    one_file: str | None = option(
        "--one-file",
        read=read_name,
        metavar="NAME.pdf",
        help="Write all sheets into one PDF with consecutive numbers, in one process.",
    )
    drawing: DrawingOptions = field(default_factory=DrawingOptions)
    files: FileOptions = field(default_factory=FileOptions)
    jobs: int = jobs_option()
    shown: bool = open_option()
    watch: bool = watch_option()

    def order(self) -> SheetOrder:
        """Return the order for the sheets of every problem; report the faults of a layout once.

        Raises
        ------
        click.UsageError
            The options contradict each other.
        """
        layout = self._layout()
        settings = self.paper.resolve()
        request = PlanRequest(
            fields=settings.fields,
            phi=self.phi,
            drafting=self.drafting,
            position=self.position,
            layout=layout,
            quantities=self.quantities or (),
            compact=self.compact,
            drawing=self.drawing,
        )
        return SheetOrder(request, settings, self.out, self.formats, self.files)

    def _layout(self) -> str | None:
        from planmethod.render.sheets.composition import composition

        layout = self.layout
        if self.compact:
            if layout is not None:
                raise UsageError("give --compact or --layout, not both")
            layout = "compact"
        layout = "graphs" if self.quantities and layout is None else layout
        if layout is not None:
            made = composition(layout)
            if self.quantities and not any(entry.kind == "graphs" for entry in made.blocks):
                raise UsageError(
                    "--ask: layout {} has no block of kind graphs. Omit --layout, "
                    "or add such a block.",
                    layout,
                )
        return layout


class SheetOrder(Struct, frozen=True):
    """Sheets to be drawn of every problem, and their files (заказанные листы).

    Attributes
    ----------
    request : PlanRequest
    settings : ResolvedRequest
        Paper and title block.
    out : Path
        Folder of the files.
    formats : tuple of str
    files : FileOptions
    """

    request: PlanRequest
    settings: ResolvedRequest
    out: Path
    formats: tuple[str, ...]
    files: FileOptions


def write_notice(options: SheetOptions, message: str) -> None:
    """Write the errors in place of the sheet of the only problem."""
    (path, *others), variant = options.choice.problems, options.choice.variant
    if others or options.one_file is not None:
        return
    from planmethod.render.sketch import notice

    name = path.stem if variant is None else f"{path.stem}-{variant}"
    write_drawings([notice(message)], options.out, name, options.formats)


@command(SheetOptions, on_failure=write_notice)
def sheet(options: SheetOptions) -> None:
    """Draw the framed sheet: scheme, velocity and acceleration plans, equations, tables."""
    order = options.order()
    if options.one_file is not None:
        _draw_in_one_file(options, order, options.out / options.one_file)
        return
    files: list[Path] = []
    code = for_each_problem(
        options.choice, partial(draw, order=order), jobs=options.jobs, on_result=files.append
    )
    if options.shown and files:
        show(files[0])
    finish(code)


def _draw_in_one_file(options: SheetOptions, order: SheetOrder, path: Path) -> None:
    """Draw the sheets of all problems into one PDF; those of other formats are apart."""
    whole: list[tuple[LoadedProblem, int, list[Drawing]]] = []

    def draw_sheets(item: LoadedProblem) -> None:
        item = resolve_problem(item, order)
        before = sum(len(drawings) for *_, drawings in whole)
        whole.append((item, before, drawn_for(item, replace(order.request, before=before))))

    code = for_each_problem(options.choice, draw_sheets)
    if whole:
        # The first sheet has the number of sheets, which is known only now.
        total = sum(len(drawings) for *_, drawings in whole)
        first = whole[0][0]
        whole[0] = (first, 0, drawn_for(first, replace(order.request, total=total)))
        apart = tuple(fmt for fmt in order.formats if fmt != "pdf")
        for item, before, drawings in whole:
            request = replace(order.request, before=before, total=total if item is first else None)
            _write(item, replace(order, request=request, formats=apart), drawings)
        pages = [drawing for *_, drawings in whole for drawing in drawings]
        write_set(pages, path, author=order.settings.author(first.problem))
        if options.shown:
            show(path)
    finish(code)


def draw(item: LoadedProblem, order: SheetOrder) -> Path:
    """Draw and write the sheets of a problem; return the file to look at, a PDF if there is one."""
    files = _write(resolve_problem(item, order), order, None)
    return next((file for file in files if file.suffix == ".pdf"), files[0])


def resolve_problem(item: LoadedProblem, order: SheetOrder) -> LoadedProblem:
    """Return a problem with all settings of its sheets; print its warnings."""
    problem = item.kind.in_positions(order.settings.over(item.problem), order.request)
    warn_each(problem, item.kind.sheet_warnings(problem, order.request))
    return replace(item, problem=problem)


def drawn_for(item: LoadedProblem, request: PlanRequest) -> list[Drawing]:
    """Draw the sheets of a problem."""
    item.kind.reject_options(item.problem, request)
    return item.kind.drawings(item.problem, request)


def _write(item: LoadedProblem, order: SheetOrder, drawings: list[Drawing] | None) -> list[Path]:
    """Write the sheets of a problem, drawn now if they are not drawn yet; return the files."""
    request = order.request
    # A DXF alone, for CAD programs, has their accuracy, unless another one is requested. Beside
    # other files it is the same sheet: one designation, one set of numbers.
    if [*order.formats] == ["dxf"] and request.drafting == DraftingOptions():
        request = replace(request, drafting=DraftingOptions(profile="cad"))
    return write_drawings(
        drawings or drawn_for(item, request),
        formats=order.formats,
        out=order.out,
        basename=basename(item.problem),
        author=order.settings.author(item.problem),
        file_options=order.files,
    )
