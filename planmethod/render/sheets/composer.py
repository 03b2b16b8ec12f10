"""One composer of sheets (компоновка листов): the proposals of a kind are put on paper and framed.

Every kind of problem has a `Strategy`, which determines the order in which papers, scales and
blocks are tried. The composer takes the first proposal that fits, draws its pages with frame and
title block, and gives advice if none fits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from math import inf
from types import MappingProxyType
from typing import Protocol, TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.scale import Scale, next_scale
from planmethod.errors import LayoutError
from planmethod.languages import translate
from planmethod.paper import BASIC, Format, paper_format
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Scales
from planmethod.problem.records import KindProblem
from planmethod.render.frame import Furniture, merged, sheet_frame
from planmethod.render.ink.drawing import Bounds, Drawing, Item, Span, View
from planmethod.render.ink.lettering import lettering, using
from planmethod.render.ink.pens import PenSet, using_pens
from planmethod.render.layout.block import Block, DrawingArea
from planmethod.render.layout.cuttings import box_at
from planmethod.render.layout.groups import EDGE, GAP, Group, Placed
from planmethod.render.layout.pack import pack

Box: TypeAlias = tuple[float, float]


class Sizes(Struct, frozen=True):
    """Letter heights and widths of a sheet, mm (высота шрифта, ширина столбца).

    ``letter``: letters of views; ``title``: names of views; ``text``: everything else; ``column``:
    the width that texts are set to; ``row``: height of the rows of tables, if not the default;
    ``boxes``: sizes of the views, if not those of the format.
    """

    letter: float
    title: float
    text: float
    column: float
    row: float = 7.0
    boxes: tuple[tuple[PlanKind, Box], ...] = ()

    def scaled(self, fraction: float) -> Sizes:
        """Return the sizes with columns and boxes a part as wide and high."""
        boxes = tuple(
            (kind, (fraction * wide, fraction * high)) for kind, (wide, high) in self.boxes
        )
        return replace(self, column=fraction * self.column, boxes=boxes)


class ViewBlock(Struct, frozen=True):
    """A view among the blocks of a sheet (вид), of a kind and in a scale: a scheme, a diagram."""

    block: Block
    name: str
    scale: Scale | None

    @property
    def width(self) -> float:
        """Width, mm."""
        return self.block.width

    @property
    def height(self) -> float:
        """Height, mm."""
        return self.block.height

    def place(self, corner: complex) -> list[Item]:
        """Return the items of the view."""
        return self.block.place(corner)

    def views(self, items: Sequence[Item], corner: complex) -> list[View]:
        """Return the records of the view, or views, whose items were placed at a corner."""
        box = box_at(self, corner)
        return [view_of(self.name, self.scale, box, self.spans(items, corner))]

    def spans(self, items: Sequence[Item], corner: complex) -> Iterable[Span]:
        """Return the segments that are measured on the view, whose items were placed."""
        return ()


def view_of(name: str, scale: Scale | None, box: Bounds, spans: Iterable[Span]) -> View:
    """Return the record of a view in a box of the sheet."""
    if scale is None:
        return View(name, box)
    letter = scale.symbol.removeprefix("mu_")
    return View(name, box, f"μ_{{{letter}}}", scale.per_mm, tuple(spans))


class TrialPaper(Struct, frozen=True):
    """Paper that sheets are tried on; with ``is_required`` no other is permitted."""

    format: Format
    furniture: Furniture
    is_required: bool = False

    @property
    def name(self) -> str:
        """Name of the format."""
        return self.format.name

    @property
    def title(self) -> float:
        """Height of the letters of titles, mm: one on a sheet."""
        return 5.0 if self.format.like in ("A3", "A4") else 7.0

    def using_pens(self) -> AbstractContextManager[PenSet]:
        """Return the context of drawing with the pens of the format."""
        return using_pens(PenSet.of(self.format))

    def drawing_area(self, number: int = 1) -> DrawingArea:
        """Return the drawing area of a sheet by its number, counted from 1."""
        return self.furniture.drawing_area(self.format, number)

    def continued(self, name: str) -> DrawingArea:
        """Return the area of a continuation sheet of another format, with the small title block."""
        return replace(self.furniture, form=SMALL).drawing_area(paper_format(name), 2)


FULLEST = 0.82
"""Part of the area that blocks claim at most: no sheet of the textbook's tasks has over 0.78."""

BESIDE_VIEW = 60.0
"""Width, and height, of the names and letters beside a view at most, mm."""

SMALL = "2a"
"""Form of the title block of continuation sheets."""

Concessions: TypeAlias = tuple[bool, int, int]
"""Concessions: whether blocks are left out, letter heights skipped, level of ungrouping."""


class PageLayout(Struct, frozen=True):
    """Blocks of one sheet with their upper left corners.

    ``title`` is its name, if it has one of its own; ``paper`` its format, if not the common one.
    """

    placed: Sequence[Placed]
    title: str = ""
    concessions: Concessions = (False, 0, 0)
    paper: str = ""
    is_continuation: bool = False


class SheetLayout(Struct, frozen=True):
    """Sheets that fit, and the scales of their views, units per mm by name.

    ``paper`` is theirs, if it is a larger one than the proposed.
    """

    pages: Sequence[PageLayout]
    scales: Mapping[str, float] = MappingProxyType({})
    paper: TrialPaper | None = None

    def is_no_worse_than(self, old: SheetLayout) -> bool:
        """Return whether it has no more pages than another, as large, and no more concessions."""
        pairs = zip(self.pages, old.pages, strict=False)
        kept = [one for one in old.pages if not one.is_continuation]
        same = [one.paper for one in self.pages] in (
            [one.paper for one in old.pages],
            [one.paper for one in kept],  # the texts of continuation sheets are on the others
        )
        return same and all(one.concessions <= two.concessions for one, two in pairs)


class Proposal(Protocol):
    """Blocks at certain scales for a paper."""

    @property
    def paper(self) -> TrialPaper:
        """Paper of the blocks."""

    def arrange(self) -> SheetLayout | None:
        """Return the sheets, or None where the blocks have no room on the paper."""


class Strategy(Protocol):
    """Search strategy for the sheets of a kind of problem (стратегия компоновки)."""

    @property
    def formats(self) -> Sequence[str]:
        """Formats to try in turn if none is requested."""

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[Proposal]:
        """Yield the proposals to try, the best first."""


class NoFitAdvice(Struct, frozen=True):
    """Error and advice if no proposal fits on any paper.

    ``error`` makes the error from a paper and an advice; ``less`` advises what to reduce if a
    larger paper is not available; ``scales`` are those of the file, which may be too fine.
    ``fits_paper`` tries a paper; if it is None, the next paper is suggested untried.
    """

    error: Callable[[str, str], LayoutError]
    less: str
    scales: Scales | None = None
    fits_paper: Callable[[str], bool] | None = None

    def advice(self, formats: Sequence[str], tried: TrialPaper) -> str:
        """Return the advice: coarser scales, a larger paper than the tried one, or less content."""
        given, fits = self.scales, self.fits_paper
        has_scales = given and any(mu is not None for mu in (given.mu_l, given.mu_v, given.mu_a))
        if has_scales and not (fits and tried.is_required):
            return translate("Use coarser scales in [scales], or omit them.")
        sides = sorted((tried.format.width, tried.format.height))
        for name in (*formats, *BASIC):
            larger = paper_format(name)
            short, long = sorted((larger.width, larger.height))
            if short >= sides[0] and long >= sides[1] and short * long > sides[0] * sides[1]:
                if fits and tried.is_required and not fits(name):
                    continue
                if has_scales:
                    return translate("Use --paper {}, or coarser scales in [scales].", name)
                if tried.is_required and name in formats:
                    return translate("Use --paper {}, or omit it.", name)
                return translate("Use --paper {}.", name)
        return (
            translate("Use coarser scales in [scales], or omit them.") if has_scales else self.less
        )


class Packing(Struct, frozen=True):
    """Blocks in reading order for a paper, a group for each sheet (`Proposal`)."""

    paper: TrialPaper
    groups: Sequence[Group]
    concessions: Concessions = (False, 0, 0)
    scales: Mapping[str, float] = MappingProxyType({})

    def arrange(self) -> SheetLayout | None:
        """Return the sheets, or None if a group does not fit its sheet."""
        pages = []
        for number, group in enumerate(self.groups, 1):
            placed = pack_group(group, self.paper.drawing_area(number))
            if placed is None:
                return None
            pages.append(PageLayout(placed, concessions=self.concessions))
        return SheetLayout(pages, self.scales)


def pack_group(group: Group, area: DrawingArea) -> list[Placed] | None:
    """Return blocks in reading order with their upper left corners, or None if they do not fit.

    Raises
    ------
    LayoutError
        The group is empty.
    """
    left, low, right, high = area.inner
    parts = [part.alternatives for part in group.parts()]
    if not parts:
        raise LayoutError(
            "All blocks of the layout are empty for this problem. Graphs need --ask, "
            "quantities in their block, or [cycle] graphs; choose other blocks, or another "
            "layout."
        )
    if sum(min(map(claimed_area, ways)) for ways in parts) > free_area(area):
        return None
    space = right - left, high - low
    if not all(any(b.width < space[0] and b.height < space[1] for b in ways) for ways in parts):
        return None
    return pack(group, area)


def free_area(area: DrawingArea) -> float:
    """Return the area of a sheet that blocks may claim with half a gap around each, mm²."""
    left, low, right, high = area.inner
    stamp = (area.stamp[2] - area.stamp[0]) * (area.stamp[3] - area.stamp[1])
    return (right - left - EDGE + GAP) * (high - low - 2.0 * EDGE + GAP) - stamp


def claimed_area(block: Block) -> float:
    """Return the area of a block with half a gap around it, mm²; 0 for an empty one."""
    return (block.width + GAP) * (block.height + GAP) if block.height else 0.0


def grow_scales(
    layout: SheetLayout,
    turns: Iterable[str],
    requested: Scales,
    draw: Callable[[Mapping[str, float]], SheetLayout | None],
    area: float = inf,
) -> SheetLayout:
    """Return sheets with scales as large as fit (увеличение масштаба по свободному полю).

    Parameters
    ----------
    layout : SheetLayout
        The present sheets, with the free scales.
    turns : iterable of str
        Names of the scales to increase by a member of the series, in turn.
    requested : Scales
        Scales of the file, which determine the series of round numbers.
    draw : callable
        Draws the sheets at other scales, or returns None if they do not fit.
    area : float, mm²
        Area that the blocks of a single sheet may claim: what would exceed it is not drawn.

    Notes
    -----
    A larger view is accepted if it needs no more pages, no smaller letters and no more ungrouping.
    A scale that did not fit once is not tried again after others have grown.
    """
    refused = set()
    for key in turns:
        if key in refused:
            continue
        finer = next_scale(layout.scales[key], finer=True, mm_per_unit=requested.in_mm_per_unit)
        wish = {**layout.scales, key: finer}
        claims = _claimed_at(layout, key, layout.scales[key] / finer)
        tried = draw(wish) if claims <= FULLEST * area else None
        if tried is not None and tried.is_no_worse_than(layout):
            layout = replace(tried, scales=wish)
        else:
            refused.add(key)
    return layout


def _claimed_at(layout: SheetLayout, key: str, times: float) -> float:
    """Return the area that the blocks of a single sheet claim with the views of a scale enlarged.

    Names and letters beside a view stay as they are. It is 0 of sheets that are not estimated.
    """
    page, *others = layout.pages
    if others or page.paper:
        return 0.0
    total = 0.0
    for block, _ in page.placed:
        is_larger = isinstance(block, ViewBlock) and block.scale and block.scale.symbol == key
        more = times - 1.0 if is_larger else 0.0
        wide, high = (
            side + more * max(0.0, side - BESIDE_VIEW) for side in (block.width, block.height)
        )
        total += (wide + GAP) * (high + GAP)
    return total


def compose(
    problem: KindProblem,
    strategy: Strategy,
    no_fit_advice: NoFitAdvice,
    *,
    fields: Mapping[str, str] | None = None,
    furniture: Furniture | None = None,
    title: str = "",
) -> list[Drawing]:
    """Return the sheets of a problem as drawings with frame and title block.

    Parameters
    ----------
    problem : KindProblem
        Problem with its settings of the sheet and its title block.
    strategy : Strategy
    no_fit_advice : NoFitAdvice
        Error and advice if no proposal fits.
    fields : mapping, optional
        Texts of the title block that outrank the file's.
    furniture : Furniture, optional
        Form of the title block and additional graphs. Default: the file's.
    title : str
        Title of the sheets. Default: the problem's.

    Raises
    ------
    LayoutError
        When the blocks fit no format, or not the requested one.
    """
    paper, laid = find_layout(
        problem, strategy, no_fit_advice, furniture or Furniture.of(problem.sheet)
    )
    titled = replace(problem, title=title) if title else problem
    with using(lettering(problem.sheet.lettering or "B")):
        return [
            _drawn(titled, paper, page, number, len(laid.pages), fields or {})
            for number, page in enumerate(laid.pages, 1)
        ]


def find_layout(
    problem: KindProblem, strategy: Strategy, no_fit_advice: NoFitAdvice, furniture: Furniture
) -> tuple[TrialPaper, SheetLayout]:
    """Return the first proposal that fits, and its paper.

    Raises
    ------
    LayoutError
        When none fits.
    """
    asked = problem.sheet.paper
    papers = [
        TrialPaper(paper_format(name), furniture, asked is not None)
        for name in ([asked] if asked else strategy.formats)
    ]
    with using(lettering(problem.sheet.lettering or "B")):
        for proposal in strategy.proposals(papers):
            with proposal.paper.using_pens():
                laid = proposal.arrange()
            if laid is not None:
                return laid.paper or proposal.paper, laid
    advice = no_fit_advice.advice(strategy.formats, papers[-1])
    raise no_fit_advice.error(papers[-1].name, advice)


def _drawn(
    problem: KindProblem,
    paper: TrialPaper,
    page: PageLayout,
    number: int,
    count: int,
    fields: Mapping[str, str],
) -> Drawing:
    """Return a page as a drawing."""
    fmt, furniture, title = paper.format, paper.furniture, problem.title
    layers = ({"title": page.title} if page.title else {}, fields)
    numbers = furniture.numbers(number, count)
    texts = merged({"title": title, "sheets": "1"}, problem.title_block, numbers, *layers)
    if page.paper:
        fmt = paper_format(page.paper)
    pens = PenSet.of(fmt, is_coloured=bool(problem.sheet.colour))
    if page.is_continuation:
        furniture = replace(furniture, form=SMALL)
    drawing = Drawing(fmt.width, fmt.height, texts.get("title", title), pens=pens)
    drawing.extend(sheet_frame(fmt, texts, furniture, sheet=number).items)
    for block, corner in page.placed:
        with using_pens(pens):
            items = block.place(corner)
        drawing.extend(items)
        if isinstance(block, ViewBlock):
            drawing.views.extend(block.views(items, corner))
    drawing.has_omissions, *_ = page.concessions
    drawing.is_continuation = page.is_continuation
    return drawing
