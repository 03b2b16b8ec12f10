"""Sheet of a cam (лист «Проектирование кулачкового механизма»)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import asdict, replace

from planmethod.cams.construction import CamConstruction, CamReadings, construct
from planmethod.cams.design import CamDesign, design_of
from planmethod.cams.model import CamProblem, Contact
from planmethod.cams.pictures import CamView, diagrams_picture, region_picture
from planmethod.cams.profilepicture import profile_picture
from planmethod.cams.scales import (
    MIN_REGION_HEIGHT,
    CamScales,
    DiagramBox,
    diagram_scales,
    extent,
    region_height,
    scales_of,
)
from planmethod.cams.text import MM, checks, forces, given_facts, positions, positions_title, sizes
from planmethod.construct.drafting import PROFILES, Profile
from planmethod.construct.scale import Scale, next_scale, series_near
from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, translate
from planmethod.note.document import Table
from planmethod.note.formula import Rich
from planmethod.note.wording import Language, get_language
from planmethod.paper import STAMP_WIDTH
from planmethod.problem.model import Scales
from planmethod.render.frame import Furniture
from planmethod.render.ink.drawing import Drawing
from planmethod.render.layout.block import Block, Column, Picture, heading, paragraph, titled
from planmethod.render.layout.groups import EDGE, GAP, Group, LayoutItem
from planmethod.render.layout.pack import largest_hole
from planmethod.render.layout.text_blocks import TableColumn, TableForm, table_block
from planmethod.render.sheets.composer import (
    NoFitAdvice,
    Packing,
    SheetLayout,
    Sizes,
    TrialPaper,
    ViewBlock,
    compose,
    find_layout,
    grow_scales,
)

if TYPE_CHECKING:
    from planmethod.options import PlanRequest

TEXT_WIDTH = STAMP_WIDTH - 5.0


class CamTry(Struct, frozen=True):
    """Sizes of an attempt: diagrams as a fraction, region and profile in mm; letters."""

    fraction: float
    region: float
    profile: float
    sizes: Sizes


TRIES = (
    CamTry(0.5, 110.0, 300.0, Sizes(3.5, 5.0, 3.5, TEXT_WIDTH, 5.0)),
    CamTry(1.0, 160.0, 230.0, Sizes(5.0, 5.0, 3.5, TEXT_WIDTH, 6.0)),
    CamTry(0.9, 110.0, 170.0, Sizes(3.5, 5.0, 2.5, TEXT_WIDTH, 4.5)),
    CamTry(0.7, 90.0, 140.0, Sizes(3.5, 5.0, 2.5, TEXT_WIDTH, 4.5)),
    CamTry(0.5, 70.0, 110.0, Sizes(3.5, 3.5, 2.5, TEXT_WIDTH, 4.0)),
    CamTry(0.45, 45.0, 70.0, Sizes(2.5, 3.5, 2.5, TEXT_WIDTH, 3.8)),
)
"""Attempts in turn until everything fits, on a paper that has no room for columns."""

GROW = ("profile", "region", "s")
"""Scales that are enlarged in turn while the sheet fits."""


def drawings(problem: CamProblem, request: PlanRequest) -> list[Drawing]:
    """Draw the diagrams, the region, the profile, the pressure angle and the tables of a cam.

    Raises
    ------
    ProblemError
        No cam satisfies the requirements.
    LayoutError
        The content does not fit on the requested paper.
    """
    language = get_language(problem.sheet.lang or LANGUAGES[0])
    furniture = Furniture.of(problem.sheet, before=request.before, total=request.total)
    strategy = _Cam(design_of(problem), language, request.profile)
    title = problem.title or language.cam.sheet
    misfit = _no_space_advice(problem)
    return compose(
        problem, strategy, misfit, fields=request.fields, furniture=furniture, title=title
    )


def sheet_scales(problem: CamProblem) -> CamScales:
    """Return the scales that the sheet is drawn at; it is laid out at the first call."""
    kept = vars(problem)
    if "sheet_scales" not in kept:
        kept["sheet_scales"] = _laid_scales(problem)
    scales: CamScales = kept["sheet_scales"]
    return scales


def _laid_scales(problem: CamProblem) -> CamScales:
    language = get_language(problem.sheet.lang or LANGUAGES[0])
    strategy = _Cam(design_of(problem), language, PROFILES["board"])
    _, laid = find_layout(problem, strategy, _no_space_advice(problem), Furniture.of(problem.sheet))
    return CamScales(**laid.scales)


def _no_space_advice(problem: CamProblem) -> NoFitAdvice:
    return NoFitAdvice(
        lambda paper, advice: LayoutError(
            "{}: the cam, its diagrams and its tables do not fit {}. {}",
            problem.name,
            paper,
            advice,
        ),
        translate("Request fewer positions with count."),
    )


COLUMNS = Sizes(5.0, 7.0, 3.5, TEXT_WIDTH, 5.0)
"""Letters of a sheet in columns."""

ROOMY = ((5.0, 8.0), (5.0, 7.0), (5.0, 6.0), (5.0, 5.0), (3.5, 6.0), (3.5, 5.0))
"""Letters of the statement and rows of the tables, mm, the first that fit."""

LEFT = 112.0
"""Least width of the column of diagrams, mm."""

REGION = (0.42, 0.3)
"""Greatest parts of that column that the region takes: the second if the diagrams want room."""

RULES = 0.15
"""Least part of a paper that the profile takes, if there is a larger paper."""

_AROUND = 20.0  # mm: lines, numbers and letters on both sides of a profile


class CamColumns(Struct, frozen=True):
    """Diagrams and region at the left, the profile as large as fits, texts and tables at the right.

    The profile is chosen first: it rules the sheet, and the others fill what remains (`Proposal`).
    """

    of: _Cam
    paper: TrialPaper
    is_last: bool

    def arrange(self) -> SheetLayout | None:
        """Return the sheet, or None where the paper has no room for the columns."""
        area = self.paper.drawing_area()
        left, low, right, high = area.inner
        top = min([high, *(box[1] for box in area.reserved)])
        tall, wide = top - low - 2 * EDGE, right - left - 2 * EDGE - STAMP_WIDTH - 2 * GAP
        found = self._profile(wide - LEFT, tall)
        if found is None:
            return None
        scales, profile = found
        drawn = prod(side / scales.profile for side in extent(self.of.design))
        if not self.is_last and drawn < RULES * (right - left) * tall:
            return None
        room = wide - profile.width
        between = 2.0 * COLUMNS.letter + 14.0
        for part in REGION:
            scales, region = self._region(scales, room, part * tall)
            high = tall - (region.height + GAP if region else 0.0)
            box = DiagramBox(room, high - 2 * COLUMNS.title - 20.0 - between, 24.0, between)
            chosen = diagram_scales(self.of.design, box, scales)
            if chosen is not None:
                break
        else:
            return None
        is_seen = region_height(self.of.design, chosen) >= MIN_REGION_HEIGHT
        if region and not is_seen and not self.is_last:
            return None
        built = construct(self.of.design, chosen)
        diagrams = self.of.diagrams(built, COLUMNS)
        views = Group(tuple(map(LayoutItem, filter(None, (diagrams, region)))), "column")
        for text, row in ROOMY:
            texts, *_ = self.of.texts(built, replace(COLUMNS, text=text), None)
            _, *tables = self.of.texts(built, replace(COLUMNS, row=row), None)
            told = LayoutItem(texts, text=True)
            listed = LayoutItem(Column(tables, gap=4.0), text=True)
            laid: list[SheetLayout] = []
            for columns in (
                (views, Group((LayoutItem(profile), told), "column"), listed),
                (views, LayoutItem(profile), Group((told, listed), "column")),
            ):
                packing = Packing(self.paper, (Group(columns, "row"),), scales=asdict(chosen))
                if (one := packing.arrange()) is not None:
                    laid.append(one)
            if laid:
                return min(laid, key=lambda one: largest_hole(one.pages[0].placed, area))
        return None

    def _profile(self, wide: float, tall: float) -> tuple[CamScales, ViewBlock] | None:
        """Return the profile at the finest scale that fits, and scales with it."""
        if min(wide, tall) <= 2 * _AROUND:
            return None
        design, scales = self.of.design, scales_of(self.of.design)
        sides = zip(extent(design), (wide, tall), strict=True)
        finest = max(size / (room - _AROUND) for size, room in sides)
        scales = replace(scales, profile=series_near(finest, up=True))
        for _ in range(4):
            view = self.of.profile_view(construct(design, scales), COLUMNS)
            if view.width <= wide and view.height <= tall:
                return scales, view
            scales = replace(scales, profile=next_scale(scales.profile, finer=False))
        return None

    def _region(
        self, scales: CamScales, wide: float, tall: float
    ) -> tuple[CamScales, ViewBlock | None]:
        """Return the region at the finest scale that fits, and the scales with it."""
        scales = replace(scales, region=scales_of(self.of.design, region=tall).region / 2)
        for _ in range(12):
            view = self.of.region(construct(self.of.design, scales), COLUMNS)
            if view is None or (view.width <= wide and view.height <= tall):
                break
            scales = replace(scales, region=next_scale(scales.region, finer=False))
        return scales, view


class CamProposal(Struct, frozen=True):
    """The blocks at attempted sizes, enlarged into the free space (`Proposal`)."""

    of: _Cam
    paper: TrialPaper
    attempt: CamTry
    scales: CamScales

    def arrange(self) -> SheetLayout | None:
        """Return the sheet with the largest views that fit, or None."""

        def draw(
            wish: Mapping[str, float], readings: CamReadings | None = self.of.rough
        ) -> SheetLayout | None:
            scales = replace(self.scales, **wish)
            parts = tuple(self.of.parts(self.attempt, scales, readings))
            return Packing(self.paper, (Group(parts),), scales=asdict(scales)).arrange()

        own = {name: float(getattr(self.scales, name)) for name in GROW}
        laid = draw({})
        if laid is None:
            return None
        grown = grow_scales(replace(laid, scales=own), GROW, Scales(), draw)
        told = draw(grown.scales, None)
        if told is None or not told.is_no_worse_than(
            grown
        ):  # a line of text more than in the trial
            grown = replace(laid, scales=own)
            told = draw(own, None)
        return told and replace(told, scales={**laid.scales, **grown.scales})


class _Cam(Struct, frozen=True, dict=True):
    """Search for the sheet of a cam, by smaller views and letters."""

    design: CamDesign
    language: Language
    profile: Profile

    formats = ("A2", "A1")

    @cached_property
    def rough(self) -> CamReadings:
        """Readings at the first scales tried: their table has the same size as any other."""
        first = TRIES[0]
        scales = scales_of(self.design, first.fraction, first.region, first.profile)
        return CamReadings(construct(self.design, scales), self.language, self.profile)

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[CamColumns | CamProposal]:
        """Yield columns on every paper, then the blocks smaller and smaller on the last."""
        for paper in papers:
            yield CamColumns(self, paper, paper is papers[-1])
        paper = papers[-1]
        for tried in TRIES:
            scales = scales_of(self.design, tried.fraction, tried.region, tried.profile)
            yield CamProposal(self, paper, tried, scales)

    def parts(
        self, attempt: CamTry, scales: CamScales, readings: CamReadings | None
    ) -> Iterator[LayoutItem]:
        """Yield the blocks in reading order; ``readings`` are readings for a trial."""
        built, letters = construct(self.design, scales), attempt.sizes
        views = (self.diagrams, self.region, self.profile_view)
        yield from map(LayoutItem, filter(None, (view(built, letters) for view in views)))
        *lines, last = self.texts(built, letters, readings)
        yield LayoutItem(Column(lines, gap=2.0), text=True)
        yield LayoutItem(last, text=True)

    def diagrams(self, built: CamConstruction, letters: Sizes) -> ViewBlock:
        """Return the diagrams with their name and scales."""
        picture = diagrams_picture(CamView(built, self.language, letters.letter))
        return self._viewed(picture, "diagrams", built, letters, "sva")

    def region(self, built: CamConstruction, letters: Sizes) -> ViewBlock | None:
        """Return the region with its name and scale; None if no axis is constructed."""
        picture = region_picture(CamView(built, self.language, letters.letter))
        if picture is None:
            return None
        plate = self.design.problem.contact is Contact.FLAT
        arm = self.design.problem.oscillates
        name = ("swung" if arm else "plate") if plate else "region"
        return self._viewed(picture, name, built, letters, ("region",))

    def profile_view(self, built: CamConstruction, letters: Sizes) -> ViewBlock:
        """Return the profile with its name and scale."""
        picture = profile_picture(CamView(built, self.language, letters.letter))
        return self._viewed(picture, "profile", built, letters, ("profile",))

    def texts(
        self, built: CamConstruction, letters: Sizes, readings: CamReadings | None
    ) -> Iterator[Block]:
        """Yield the statement with the checks, the tables of sizes, readings, and positions."""
        said = self.language.cam
        facts = "; ".join(fact.text for fact in given_facts(self.design.problem, self.language))
        texts = [self.language.note.given.format(given=facts), *checks(self.design, self.language)]
        if self.design.problem.has_forces:
            texts += forces(self.design, self.language)
        yield Column([paragraph(text, letters.text, TEXT_WIDTH) for text in texts], gap=2.0)
        yield _table(sizes(self.design, self.language), letters, said.sizes)
        drawn = readings or CamReadings(built, self.language, self.profile)
        if built.results:
            yield _table(drawn.table(), letters, said.drawn)
        yield paragraph(drawn.deviation(), letters.text, TEXT_WIDTH)
        yield _table(
            positions(self.design, self.language),
            letters,
            positions_title(self.design, self.language),
        )

    def _viewed(
        self, picture: Picture, name: str, built: CamConstruction, letters: Sizes,
        scales: Sequence[str],
    ) -> ViewBlock:  # fmt: skip
        title: str = self.language.cam["views"][name]
        heights = letters.title, letters.text
        told = inscribe_scales(built.scales, scales, self.language)
        block = titled(picture, title, [told], heights, is_wrapped=True)
        kind, letter = ("diagram", "s") if name == "diagrams" else ("cam", "l")
        mu = Scale(f"mu_{letter}", getattr(built.scales, scales[0]), "m")
        return ViewBlock(block, kind, mu)


def inscribe_scales(scales: CamScales, names: Sequence[str], language: Language) -> Rich:
    """Return the inscription of the scales of a view: s, v, a of the diagrams, or that of lengths.

    ``names`` are the fields of ``scales``.
    """
    texts, notation = language.cam, language.notation

    def inscribed(of: str) -> Rich:
        symbol = f"μ_{{{of}}}" if of in "avs" else "μ_{l}"
        return texts.scale.format(symbol=symbol, value=notation.as_input(MM * getattr(scales, of)))

    told = [*map(inscribed, names)]
    if "s" in names:
        told.append(texts.scale_phi.format(degree=notation.as_input(scales.degree)))
    return "; ".join(told)


def _table(content: Table, letters: Sizes, title: str) -> Block:
    columns = [TableColumn(head, cells) for head, cells in content.columns()]
    table = table_block(
        columns, TableForm(letters.text, units="none", row_height=letters.row), width=STAMP_WIDTH
    )
    return Column([heading(title, letters.text, width=TEXT_WIDTH), table], gap=2.0)
