"""Sheet of a moving point: trajectory, hodographs, formulas with numbers, tables (лист точки)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations, pairwise
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.construct.drafting import Profile
from planmethod.construct.scale import Scale
from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, translate
from planmethod.moving.construction import (
    DrawnInterval,
    MomentConstruction,
    construct,
    drawn_interval,
    read_hodograph,
)
from planmethod.moving.motion import COLUMNS, LEGEND, Motion, PointProblem
from planmethod.moving.pictures import (
    hodograph_picture,
    length_scale,
    plan_scale,
    trajectory_picture,
    vector_scales,
)
from planmethod.moving.text import given_facts, head_of, moment
from planmethod.note.compared import ComparedNumber
from planmethod.note.document import Formula, Note, plain_text
from planmethod.note.narrate.naming import scale_inscription
from planmethod.note.narrate.statement import unbroken
from planmethod.note.numbers import format_column, significant
from planmethod.note.wording import Language, get_language
from planmethod.paper import DEFAULT_SERIES, STAMP_WIDTH
from planmethod.render.frame import Furniture
from planmethod.render.ink.drawing import Disc, Drawing, Item, Span
from planmethod.render.ink.pens import pens_in_use
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, heading, paragraph, titled
from planmethod.render.layout.groups import EDGE, Group, LayoutItem
from planmethod.render.layout.text_blocks import TableColumn, TableForm, blocks_of, table_block
from planmethod.render.pictures.planview import POLE
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

SIZES = Sizes(5.0, 5.0, 3.5, 120.0)
"""Sizes of letters and texts."""

TRAJECTORY_BOX, HODOGRAPH_BOX = (170.0, 125.0), (105.0, 95.0)
"""Boxes of trajectory and hodographs, mm, before the factors that are tried."""

FACTORS = (1.9, 1.6, 1.35, 1.15, 1.0, 0.87, 0.75, 0.65, 0.56, 0.48, 0.4, 0.32, 0.25)
COLUMN_WIDTHS = (SIZES.column, 95.0)

TABLE_WIDTH = STAMP_WIDTH + 15.0

MAX_SCALE_STEPS = 3
"""Maximum number of members of the series by which a scale grows."""


class _Plan(ViewBlock, frozen=True):
    """Hodograph of a kind, with the plan of the described moment."""

    built: MomentConstruction | None
    plan: str

    def spans(self, items: Sequence[Item], corner: complex) -> Iterator[Span]:
        """Yield the whole vector of the plan."""
        if self.built is None:
            return
        (pole,) = (one.centre for one in items if isinstance(one, Disc) and one.tag == POLE)
        trace = self.built.read()
        for vector in self.built.vectors:
            if vector.plan == self.plan and vector.is_resultant:
                head = complex(np.ravel(trace.value[vector.head])[0])
                if abs(head) > 0.05:
                    yield Span(plain_text(vector.symbol), None, pole, pole + head)


class _Point(Struct, frozen=True):
    """Search for the sheets of a point: smaller and smaller views, on more sheets."""

    problem: PointProblem
    course: DrawnInterval
    profile: Profile
    language: Language
    cache: dict[tuple[object, ...], Block] = field(default_factory=dict)

    formats = DEFAULT_SERIES

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[_Sheets]:
        """Yield scales and text widths, for one sheet, then for several of the requested format.

        Of several sheets the first has the views.
        """
        for paper in papers:
            for count in (1, 2, 3) if paper.is_required else (1,):
                tried: set[tuple[float, ...]] = set()
                for factor in FACTORS:
                    scales = self.scales(factor)
                    key = tuple(scale.per_mm for scale in scales.values())
                    if key not in tried:
                        tried.add(key)
                        for column in COLUMN_WIDTHS:
                            yield _Sheets(self, paper, count, scales, column)

    def scales(self, factor: float) -> dict[str, Scale]:
        """Return the scales of views that are ``factor`` times as large as usual."""
        asked, found = self.problem.scales, dict[str, Scale]()
        box = (factor * HODOGRAPH_BOX[0], factor * HODOGRAPH_BOX[1])
        for plan, mu in (("v", asked.mu_v), ("a", asked.mu_a)):
            found[plan] = plan_scale(self.course, plan, box, mu, asked.convention)
        whole = (factor * TRAJECTORY_BOX[0], factor * TRAJECTORY_BOX[1])
        return found | {"l": length_scale(self.problem, self.course, found, whole)}

    def parts(
        self, scales: Mapping[str, Scale], column: float, width: float, head: float, *, draft: bool
    ) -> list[LayoutItem]:
        """Return the blocks in reading order, with titles in letters of a height ``head``, mm."""
        course, texts = self.course, self.language.point
        built = {
            k: made
            for k in course.shown
            if (made := construct(self.problem, course.marks, k, scales)) is not None
        }
        first = built.get(course.shown[0]) if course.shown else None
        parts = [LayoutItem(self._statement(column), text=True)]

        def trajectory() -> Block:
            own = vector_scales(course, scales)
            picture = trajectory_picture(
                self.problem,
                course,
                own,
                letter_height=SIZES.letter,
                notation=self.language.notation,
                draft=draft,
            )
            return self._named(picture, texts.trajectory, [own[name] for name in "lva"], head)

        parts.append(
            LayoutItem(
                ViewBlock(
                    self._cached("lva", scales, trajectory, draft, head), "trajectory", scales["l"]
                )
            )
        )
        for plan, title, depends in (
            ("v", texts.hodograph_v, "lv"),
            ("a", texts.hodograph_a, "va"),
        ):
            if plan == "a" and np.isnan(course.marks.columns["ax"]).all():
                continue

            def hodograph(plan: str = plan, title: str = title) -> Block:
                picture = hodograph_picture(
                    course, plan, first, scales, letter_height=SIZES.letter, draft=draft
                )
                return self._named(picture, title, [scales[plan]], head)

            block = self._cached(depends, scales, hodograph, draft, head)
            parts.append(LayoutItem(_Plan(block, "hodograph", scales[plan], first, plan)))
        if course.shown:
            parts.append(LayoutItem(self._calculation(course.shown[0], column), text=True))
        if first is not None:
            parts.append(LayoutItem(self._read(first, course.shown[0]), text=True))
        return [*parts, LayoutItem(self._table(width, scales["v"]), text=False)]

    def _cached(
        self,
        names: str,
        scales: Mapping[str, Scale],
        build: Callable[[], Block],
        draft: bool,
        title: float,
    ) -> Block:
        """Return a view that depends on some scales, made once for them."""
        key = (pens_in_use(), draft, title, names, *(scales[name].per_mm for name in names))
        if key not in self.cache:
            self.cache[key] = build()
        return self.cache[key]

    def _named(self, picture: Block, title: str, scales: Sequence[Scale], height: float) -> Block:
        convention, notation = self.problem.scales.convention, self.language.notation
        notes = [scale_inscription(one, convention, notation) for one in scales]
        return titled(picture, title, ["; ".join(notes)], (height, SIZES.text))

    def _statement(self, width: float) -> Block:
        """Return "Дано" and the required quantities."""
        said, facts = self.language.point, given_facts(self.problem, self.language)
        # A formula is not broken within.
        whole = {f"point.{key}" for key in self.problem.formulas} | {"point.t"}
        told = [unbroken([x.text]) if x.data.keys() & whole else x.text for x in facts]
        texts = [self.language.note.given.format(given="; ".join(told)), said.wanted]
        return Column([paragraph(text, SIZES.text, width=width) for text in texts], gap=3.0)

    def _calculation(self, k: int, width: float) -> Block:
        """Return the formulas of one moment with their numbers."""
        time = self.language.notation.as_input(float(self.course.marks.columns["t"][k]))
        blocks: list[Block] = [
            heading(self.language.point.at.format(time=time), SIZES.text, width=width)
        ]
        nodes: list[Formula | Note] = []
        for node in moment(self.problem, self.course.marks, k, self.language):
            if nodes and _is_short(node) and _is_short(nodes[-1]):
                nodes[-1] = Formula(f"{nodes[-1].text};  {node.text}")  # two components
            else:
                nodes.append(node)
        return Column([*blocks, *blocks_of(nodes, SIZES.text, width=width)], gap=2.6)

    def _read(self, built: MomentConstruction, k: int) -> Block:
        """Return the values of the drawing beside the exact ones, and its error."""
        whole = read_rows(built, self.course.marks, k, self.language, self.profile)
        rows, texts = [row for row in whole if row[2] != "—"], self.language.point
        columns = [
            TableColumn(head, tuple(row[n] for row in rows)) for n, head in enumerate(texts["read"])
        ]
        title = texts.read_title.format(profile=self.language.note["profiles"][self.profile.name])
        return Column(
            [
                Line(typeset(title, SIZES.text)),
                table_block(columns, TableForm(SIZES.text, units="none")),
            ],
            2.5,
        )

    def _table(self, width: float, scale: Scale) -> Block:
        """Return the table of the numbered instants."""
        notation, marks, texts = self.language.notation, self.course.marks, self.language.point
        count = len(marks.columns["t"])
        columns = [TableColumn("№", tuple(map(str, range(count))), min_width=6.0)]
        for name in COLUMNS:
            values = [float(value) + 0.0 for value in marks.columns[name]]
            whole = all(np.isfinite(values))
            told = format_column(values) if whole else [significant(value) for value in values]
            cells = tuple("0" if not text.strip("-0.") else notation.number(text) for text in told)
            if name == "t":
                cells = tuple(notation.as_input(value) for value in values)
            unit = notation.units[LEGEND[name].unit]
            columns.append(TableColumn(LEGEND[name].symbol, cells, unit, min_width=8.0))
        chords = read_hodograph(self.course, scale, self.profile)
        if len(chords.at) > 1:
            shown = ["—"] * count
            for n, k in enumerate(chords.at):
                one = chords.series[n]
                shown[k] = " ± ".join(notation.numbers(one.rounded_text, one.sigma_text))
            columns.append(TableColumn(texts.chord, tuple(shown), notation.units["m/s²"]))
        row = 6.0 if count > 8 else 7.0
        table = table_block(
            columns, TableForm(SIZES.text, leading=2, row_height=row), width=min(width, TABLE_WIDTH)
        )
        notes = [] if len(chords.at) < 2 else [paragraph(texts.chord_note, 2.5, STAMP_WIDTH)]
        return Column([Line(typeset(texts.table, SIZES.text)), table, *notes], gap=2.5)


def _is_short(node: Formula | Note) -> bool:
    """Return whether a node is a formula without a calculation; two of them fit on a line."""
    return isinstance(node, Formula) and node.text.count("=") == 1


def read_rows(
    built: MomentConstruction, marks: Motion, k: int, language: Language, profile: Profile
) -> Iterator[tuple[str, str, str, str]]:
    """Yield the values of the drawing beside the exact ones, rich text: symbol, exact, read, σ."""
    ruled, sigma, notation = built.ruled(profile.ruler), built.sigma(profile), language.notation
    for name in built.results:
        one = ComparedNumber(float(marks.columns[name][k]) + 0.0, ruled[name], sigma[name])
        exact, read, error = notation.numbers(*one.texts)
        yield head_of(name, notation), exact, read, error


class _Sheets(Struct, frozen=True):
    """Sheets of a point at certain scales (`Proposal`)."""

    of: _Point
    paper: TrialPaper
    count: int
    scales: Mapping[str, Scale]
    column: float

    def arrange(self) -> SheetLayout | None:
        """Return the sheets, each view as large as the others allow."""
        given, scales = self.of.problem.scales, self.scales
        laid = self._at({key: scale.per_mm for key, scale in scales.items()})
        if laid is None:
            return None
        free = (key for key in "lva" if getattr(given, f"mu_{key}") is None)
        turns = (key for key in free for _ in range(MAX_SCALE_STEPS))
        return grow_scales(laid, turns, given, self._at)

    def _at(self, per_mm: Mapping[str, float]) -> SheetLayout | None:
        """Return the sheets at some scales."""
        scales = {key: replace(self.scales[key], per_mm=mu) for key, mu in per_mm.items()}
        left, _, right, _ = self.paper.drawing_area().inner
        laid = None
        for draft in (True, False):  # placing letters is slow: first a draft
            width = right - left - 2 * EDGE
            parts = self.of.parts(scales, self.column, width, self.paper.title, draft=draft)
            views = 1 + max(k for k, part in enumerate(parts) if isinstance(part.block, ViewBlock))
            ways = (
                Packing(self.paper, [Group(tuple(parts[i:j])) for i, j in edges], scales=per_mm)
                for turns in combinations(range(views, len(parts)), self.count - 1)
                for edges in [pairwise((0, *turns, len(parts)))]
            )
            laid = next((found for one in ways if (found := one.arrange()) is not None), None)
            if laid is None:
                return None
        return laid


def drawings(problem: PointProblem, request: PlanRequest) -> list[Drawing]:
    """Draw the motion of a point in the language of ``problem.sheet``; on A4 on several sheets.

    Raises
    ------
    ProblemError
        The point is nowhere in the shown interval.
    LayoutError
        The content fits no format, or not the requested one.
    """
    furniture = Furniture.of(problem.sheet, before=request.before, total=request.total)
    strategy, title = (
        _strategy(problem, drawn_interval(problem), request.profile),
        problem.title or problem.name,
    )
    misfit = _no_space_advice(problem)
    return compose(
        problem, strategy, misfit, fields=request.fields, furniture=furniture, title=title
    )


def sheet_scales(
    problem: PointProblem, course: DrawnInterval, profile: Profile
) -> dict[str, Scale]:
    """Return the scales that the sheet is drawn at, by ``l``, ``v``, ``a``."""
    strategy = _strategy(problem, course, profile)
    _, laid = find_layout(problem, strategy, _no_space_advice(problem), Furniture.of(problem.sheet))
    usual = strategy.scales(1.0)
    return {key: replace(usual[key], per_mm=mu) for key, mu in laid.scales.items()}


def drawn_views(
    problem: PointProblem, profile: Profile, language: Language
) -> Iterator[tuple[str, str, Block]]:
    """Yield the views of the sheet for a note: key, title, picture at the scales of the sheet."""
    course = drawn_interval(problem)
    scales = sheet_scales(problem, course, profile)
    parts = _Point(problem, course, profile, language).parts(
        scales, SIZES.column, TABLE_WIDTH, SIZES.title, draft=False
    )
    views = [item.block for item in parts if isinstance(item.block, ViewBlock)]
    texts = language.point
    titles = {"trajectory": texts.trajectory, "hodograph_v": texts.hodograph_v,
              "hodograph_a": texts.hodograph_a}  # fmt: skip
    for view, (key, title) in zip(views, titles.items(), strict=False):
        assert isinstance(view.block, Column)
        yield key, title, view.block.blocks[1]


def _strategy(problem: PointProblem, course: DrawnInterval, profile: Profile) -> _Point:
    return _Point(problem, course, profile, get_language(problem.sheet.lang or LANGUAGES[0]))


def _no_space_advice(problem: PointProblem) -> NoFitAdvice:
    return NoFitAdvice(
        lambda paper, advice: LayoutError(
            "{}: the motion of the point does not fit {}. {}", problem.name, paper, advice
        ),
        translate("Request fewer moments, or a shorter show."),
        problem.scales,
    )
