"""Sheet of a cam (лист «Проектирование кулачкового механизма»)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import asdict, replace

from planmethod.cams.construction import CamConstruction, CamReadings, construct
from planmethod.cams.design import CamDesign, CamScales, scales_of
from planmethod.cams.model import CamProblem, Contact
from planmethod.cams.pictures import CamView, diagrams_picture, profile_picture, region_picture
from planmethod.cams.text import MM, checks, forces, given_facts, positions, sizes
from planmethod.construct.drafting import PROFILES, Profile
from planmethod.construct.scale import Scale
from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, translate
from planmethod.note.document import Table
from planmethod.note.formula import Rich
from planmethod.note.wording import Language, get_language
from planmethod.paper import STAMP_WIDTH
from planmethod.problem.model import Scales
from planmethod.render.frame import Furniture
from planmethod.render.ink.drawing import Drawing
from planmethod.render.layout.block import Block, Column, Picture, heading, paragraph
from planmethod.render.layout.groups import Group, LayoutItem
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
    CamTry(1.0, 180.0, 320.0, Sizes(5.0, 5.0, 3.5, TEXT_WIDTH, 6.0)),
    CamTry(0.9, 110.0, 300.0, Sizes(3.5, 5.0, 3.5, TEXT_WIDTH, 5.0)),
    CamTry(0.7, 90.0, 270.0, Sizes(3.5, 5.0, 3.5, TEXT_WIDTH, 5.0)),
    CamTry(0.5, 110.0, 300.0, Sizes(3.5, 5.0, 3.5, TEXT_WIDTH, 5.0)),
    CamTry(0.5, 110.0, 270.0, Sizes(3.5, 5.0, 3.5, TEXT_WIDTH, 5.0)),
    CamTry(1.0, 160.0, 230.0, Sizes(5.0, 5.0, 3.5, TEXT_WIDTH, 6.0)),
    CamTry(0.9, 130.0, 200.0, Sizes(3.5, 5.0, 3.5, TEXT_WIDTH, 5.0)),
    CamTry(0.9, 110.0, 170.0, Sizes(3.5, 5.0, 2.5, TEXT_WIDTH, 4.5)),
    CamTry(0.7, 90.0, 140.0, Sizes(3.5, 5.0, 2.5, TEXT_WIDTH, 4.5)),
    CamTry(0.5, 70.0, 110.0, Sizes(3.5, 3.5, 2.5, TEXT_WIDTH, 4.0)),
    CamTry(0.45, 45.0, 70.0, Sizes(2.5, 3.5, 2.5, TEXT_WIDTH, 3.8)),
)
"""Attempts in turn until everything fits."""

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
    strategy = _Cam(CamDesign(problem), language, request.profile)
    title = problem.title or language.cam.sheet
    misfit = _no_space_advice(problem)
    return compose(
        problem, strategy, misfit, fields=request.fields, furniture=furniture, title=title
    )


def sheet_scales(problem: CamProblem) -> CamScales:
    """Return the scales that the sheet is drawn at."""
    language = get_language(problem.sheet.lang or LANGUAGES[0])
    strategy = _Cam(CamDesign(problem), language, PROFILES["board"])
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

    formats = ("A1",)

    @cached_property
    def rough(self) -> CamReadings:
        """Readings at the first scales tried: their table has the same size as any other."""
        first = TRIES[0]
        scales = scales_of(self.design, first.fraction, first.region, first.profile)
        return CamReadings(construct(self.design, scales), self.language, self.profile)

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[CamProposal]:
        """Yield the blocks, smaller and smaller."""
        for paper, tried in product(papers, TRIES):
            scales = scales_of(self.design, tried.fraction, tried.region, tried.profile)
            yield CamProposal(self, paper, tried, scales)

    def parts(
        self, attempt: CamTry, scales: CamScales, readings: CamReadings | None
    ) -> Iterator[LayoutItem]:
        """Yield the blocks in reading order; ``readings`` are readings for a trial."""
        built, said, letters = construct(self.design, scales), self.language.cam, attempt.sizes
        view = CamView(built, self.language, letters.letter)
        yield LayoutItem(self._viewed(diagrams_picture(view), "diagrams", built, letters, "sva"))
        region = region_picture(view)
        if region is not None:
            plate = self.design.problem.contact is Contact.FLAT
            arm = self.design.problem.oscillates
            name = ("swung" if arm else "plate") if plate else "region"
            yield LayoutItem(self._viewed(region, name, built, letters, ("region",)))
        yield LayoutItem(
            self._viewed(profile_picture(view), "profile", built, letters, ("profile",))
        )
        facts = "; ".join(fact.text for fact in given_facts(self.design.problem, self.language))
        texts = [self.language.note.given.format(given=facts), *checks(self.design, self.language)]
        if self.design.problem.has_forces:
            texts += forces(self.design, self.language)
        lines: list[Block] = [paragraph(text, letters.text, TEXT_WIDTH) for text in texts]
        lines.append(_table(sizes(self.design, self.language), letters, said.sizes))
        drawn = readings or CamReadings(built, self.language, self.profile)
        if built.results:
            lines.append(_table(drawn.table(), letters, said.drawn))
        lines.append(paragraph(drawn.deviation(), letters.text, TEXT_WIDTH))
        yield LayoutItem(Column(lines, gap=2.0), text=True)
        yield LayoutItem(
            _table(positions(self.design, self.language), letters, said.positions), text=True
        )

    def _viewed(
        self, picture: Picture, name: str, built: CamConstruction, letters: Sizes,
        scales: Sequence[str],
    ) -> ViewBlock:  # fmt: skip
        texts, notation = self.language.cam, self.language.notation

        def inscribed(of: str) -> Rich:
            symbol = f"μ_{{{of}}}" if of in "avs" else "μ_{l}"
            return texts.scale.format(
                symbol=symbol, value=notation.as_input(MM * getattr(built.scales, of))
            )

        told = [inscribed(of) for of in scales]
        if name == "diagrams":
            told.append(texts.scale_phi.format(degree=notation.as_input(built.scales.degree)))
        title: str = texts["views"][name]
        wide = max(picture.width, 140.0)
        lines: list[Block] = [
            heading(title, letters.title, width=wide),
            paragraph("; ".join(told), letters.text, wide, align="centre"),
            picture,
        ]
        kind, letter = ("diagram", "s") if name == "diagrams" else ("cam", "l")
        mu = Scale(f"mu_{letter}", getattr(built.scales, scales[0]), "m")
        return ViewBlock(Column(lines, gap=2.5, align="centre"), kind, mu)


def _table(content: Table, letters: Sizes, title: str) -> Block:
    columns = [TableColumn(head, cells) for head, cells in content.columns()]
    table = table_block(
        columns, TableForm(letters.text, units="none", row_height=letters.row), width=STAMP_WIDTH
    )
    return Column([heading(title, letters.text, width=TEXT_WIDTH), table], gap=2.0)
