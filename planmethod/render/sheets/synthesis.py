"""Sheet of a synthesis (лист синтеза): the construction, its steps, sizes and what was measured."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import degrees, radians, tau
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.scale import Scale
from planmethod.construct.steps import IntersectCircles, IntersectLineCircle, LineName, PointName
from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, translate
from planmethod.note.document import Formula
from planmethod.note.narrate.naming import scale_inscription
from planmethod.note.narrate.statement import NBSP, unbroken
from planmethod.note.narrate.synthesis import given_data, point_name
from planmethod.note.synthesis.drawing import Drawn, arc_over, construction_of
from planmethod.note.synthesis.formulas import SynthesisFormulas
from planmethod.note.synthesis.text import (
    SynthesisNarrator,
    check_rows,
    size_rows,
)
from planmethod.note.synthesis.verification import measured_on
from planmethod.note.wording import Language, get_language
from planmethod.paper import STAMP_WIDTH
from planmethod.problem.model import Convention, Problem
from planmethod.render import symbols
from planmethod.render.control.sheet import largest_empty
from planmethod.render.frame import rectangle
from planmethod.render.ink.drawing import Bounds, Drawing, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.labels.label_column import merge_letters
from planmethod.render.layout.block import (
    Block,
    Column,
    Picture,
    heading,
    paragraph,
    titled,
)
from planmethod.render.layout.groups import Group, LayoutItem, Placed
from planmethod.render.layout.text_blocks import TableColumn, TableForm, blocks_of, table_block
from planmethod.render.pictures.lettered import lettered
from planmethod.render.sheets.composer import (
    NoFitAdvice,
    PageLayout,
    SheetLayout,
    Sizes,
    TrialPaper,
    ViewBlock,
    compose,
    pack_group,
)
from planmethod.render.sheets.model import BlockStyle
from planmethod.solved.solution import Solution
from planmethod.synthesis.model import place

SIZES = Sizes(5.0, 5.0, 3.5, 175.0, row=6.5)
"""Sizes of letters, and of the texts over the title block."""

_OVERSHOOT = 9.0  # mm: construction lines go on beyond their points
_TICK = 5.0  # mm: half of an arc that marks a point
_ANGLE = 0.6  # radius of the arc of an angle as a part of the shorter of its sides
_MAX_ANGLE_RADIUS = 45.0  # mm: that radius at most
_SAME = 0.8  # mm: points so near have one label


def synthesis_sheet(
    drawn: Drawn,
    problem: Problem,
    checks: Mapping[str, Any],
    *,
    fields: Mapping[str, str] | None = None,
) -> Drawing:
    """Draw a synthesis on a sheet (лист синтеза).

    Parameters
    ----------
    problem : Problem
        Its settings of the sheet and its title block.
    checks : mapping
        The values measured on the mechanism.
    fields : mapping, optional
        Texts of the title block that outrank the problem's.

    Raises
    ------
    LayoutError
        The content does not fit the paper.
    """
    language = get_language(problem.sheet.lang or LANGUAGES[0])
    strategy = _Synthesis(drawn, checks, language)
    misfit = NoFitAdvice(
        lambda paper, advice: LayoutError(
            "{}: the construction does not fit {}. {}", drawn.synthesis.kind, paper, advice
        ),
        translate("Choose another --paper."),
    )
    (sheet,) = compose(problem, strategy, misfit, fields=fields)
    return sheet


class _Synthesis(Struct, frozen=True):
    """Search for the sheet of a synthesis, by smaller letters, then coarser scales."""

    drawn: Drawn
    checks: Mapping[str, Any]
    language: Language

    formats = ("A3",)

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[_Orders]:
        """Yield the blocks at letters and scales; the steps are left out at last."""
        drawn, language = self.drawn, self.language
        title = language.synthesis["titles"][drawn.synthesis.kind]
        for paper in papers:
            for heights in ((SIZES.text, 2.5), (SIZES.text, 2.5), (SIZES.text, 2.5, 0.0)):
                with paper.using_pens():
                    view = _view(drawn, language, replace(SIZES, title=paper.title))
                for height in heights:
                    texts = _texts(drawn, self.checks, language, height)
                    yield _Orders(paper, view, texts, title, is_cut_down=not height)
                drawn = drawn.coarser()


class _Orders(Struct, frozen=True):
    """View and its texts in two reading orders (`Proposal`)."""

    paper: TrialPaper
    view: ViewBlock
    texts: Sequence[Block]
    title: str
    is_cut_down: bool

    def arrange(self) -> SheetLayout | None:
        """Return the sheet with the measurements after the steps, or beside the view.

        The one that leaves the smaller empty rectangle is chosen.
        """
        view, room = self.view, self.paper.drawing_area()
        told, formulas, measured, sizes = self.texts
        made: list[tuple[float, int, list[Placed]]] = []
        for blocks in (
            (view, told, formulas, measured, sizes),
            (view, measured, told, formulas, sizes),
            (view, formulas, told, measured, sizes),
        ):
            whole = Group(tuple(LayoutItem(block, block is not view) for block in blocks))
            placed = pack_group(whole, room)
            if placed is not None:
                items: list[Item] = [rectangle(room.stamp, Pen.FRAME, "")]
                items += [item for block, corner in placed for item in block.place(corner)]
                left, low, right, high = largest_empty(items, room.inner)
                made.append(((right - left) * (high - low), len(made), placed))
        if not made:
            return None
        return SheetLayout([PageLayout(min(made)[2], self.title, (self.is_cut_down, 0, 0))])


def _view(drawn: Drawn, language: Language, sizes: Sizes) -> ViewBlock:
    """Return the construction with its name and scale."""
    scale = Scale("mu_l", drawn.mu, "m")
    phrase = scale_inscription(scale, Convention.UNIT_PER_MM, language.notation)
    name, heights = language.synthesis.construction, (sizes.title, sizes.text)
    view = titled(_picture(drawn, language, sizes), name, [phrase], heights)
    return ViewBlock(view, "position", scale)


def _texts(
    drawn: Drawn, checks: Mapping[str, Any], language: Language, height: float
) -> list[Block]:
    """Return the given data with the steps, the formulas, the measurements, and the sizes.

    ``height`` is the letter height of formulas and steps, mm; 0 leaves the steps out.
    """
    told: list[Block] = [_data_block(drawn, language, SIZES)]
    if height:
        told.append(_steps(drawn, language, replace(SIZES, text=height), SIZES.text))
    formulas = _formulas(drawn, language, replace(SIZES, text=height or 2.5), SIZES.text)
    return [Column(told, gap=6.0), formulas, *_results(drawn, checks, language, SIZES)]


def _data_block(drawn: Drawn, language: Language, sizes: Sizes) -> Block:
    made = drawn.synthesis
    told = given_data(made.kind, made.options, language, letters=drawn.letters)
    facts = language.note.given.format(given=unbroken(text for _, text in told))
    return paragraph(facts, sizes.text, sizes.column)


def _formulas(drawn: Drawn, language: Language, sizes: Sizes, head: float) -> Block:
    lines = [Formula(line) for line in SynthesisFormulas(drawn, language).lines]
    told = Column([*blocks_of(lines, sizes.text, width=sizes.column)], gap=2.2)
    return Column([heading(language.synthesis.by_formulas, head), told], gap=3.0)


def _steps(drawn: Drawn, language: Language, sizes: Sizes, head: float) -> Block:
    steps = [
        paragraph(f"{k}) {_bind_last_word(sentence)}", sizes.text, sizes.column)
        for k, sentence in enumerate(SynthesisNarrator(drawn, language).sentences(), 1)
    ]
    return Column([heading(language.synthesis.steps_title, head), *steps], gap=0.6 * sizes.text)


def _results(
    drawn: Drawn, checks: Mapping[str, Any], language: Language, sizes: Sizes
) -> tuple[Block, Block]:
    """Return the measurements on the mechanism, and the table of sizes."""
    texts = language.synthesis
    rows = [f"{name}:{NBSP}{value}" for name, value in check_rows(checks, language)]
    measured = paragraph(";\n".join(rows) + ".", sizes.text, sizes.column)
    columns = zip(texts["columns"], zip(*size_rows(drawn, language), strict=True), strict=True)
    table = table_block(
        [TableColumn(head, tuple(values)) for head, values in columns],
        TableForm(sizes.text, units="none", row_height=SIZES.row / SIZES.text * sizes.text),
        width=STAMP_WIDTH,
    )
    return (
        Column([heading(texts.measured, sizes.text), measured], gap=3.0),
        Column([heading(texts.lengths, sizes.text), table], gap=3.0),
    )


# Blocks of the sheets of a linkage ---------------------------------------------------------------


def _drawn(solution: Solution, style: BlockStyle) -> tuple[Drawn, Sizes]:
    """Return the construction of a problem, and the sizes of a block."""
    if solution.problem.synthesis is None:
        raise LayoutError(
            "{}: a layout with a synthesis needs [synthesis] in the problem file. For example: "
            '[synthesis] kind = "slotted", K_v = 1.4, centres = 0.4.',
            solution.problem.name,
        )
    sizes = replace(
        style.sizes,
        letter=style.letter,
        title=style.title,
        text=style.text(style.sizes.text),
        column=style.width(style.sizes.column),
    )
    return construction_of(solution), sizes


def synthesis_view(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> ViewBlock:
    """Return the construction of the sizes of the mechanism."""
    drawn, sizes = _drawn(solution, style)
    return _view(drawn, style.language, sizes)


def formulas_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the given data of the synthesis, and the sizes by formulas."""
    drawn, sizes = _drawn(solution, style)
    formulas = _formulas(drawn, style.language, sizes, sizes.text)
    return Column([_data_block(drawn, style.language, sizes), formulas], gap=6.0)


def steps_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the steps of the construction."""
    drawn, sizes = _drawn(solution, style)
    return _steps(drawn, style.language, sizes, sizes.text)


def sizes_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the table of the sizes of the mechanism."""
    drawn, sizes = _drawn(solution, style)
    return _results(drawn, measured_on(solution), style.language, sizes)[1]


def check_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the measurements on the mechanism."""
    drawn, sizes = _drawn(solution, style)
    return _results(drawn, measured_on(solution), style.language, sizes)[0]


def _bind_last_word(sentence: str) -> str:
    """Return a sentence whose last word is never alone on a line."""
    return NBSP.join(sentence.rsplit(" ", 1))


# The construction --------------------------------------------------------------------------------


def construction_picture(drawn: Drawn, language: Language, letter: float) -> Picture:
    """Return the construction with the mechanism in its positions, in letters of a height, mm."""
    return _picture(drawn, language, replace(SIZES, letter=letter, text=0.7 * letter))


def _picture(drawn: Drawn, language: Language, sizes: Sizes) -> Picture:
    ink = _Ink(drawn, sizes)
    angle, letter = ink.angle(language)
    items = symbols.before_links([*ink.construction(), *angle, *ink.mechanism()])
    return lettered(list(items), [*ink.labels(), *letter])


class _Ink:
    """Lines and letters of a construction, mm."""

    def __init__(self, drawn: Drawn, sizes: Sizes) -> None:
        self.drawn, self.sizes = drawn, sizes
        left, low, right, high = self.drawn.extent(self.drawn.paper)
        room = 1.5 * _OVERSHOOT
        self.box: Bounds = (left - room, low - room, right + room, high + room)

    def at(self, name: str) -> complex:
        return place(self.drawn.paper, name)

    def construction(self) -> Iterator[Item]:
        """Yield thin lines: those that are drawn, circles, and the arcs that mark points."""
        for line, points in self.drawn.on_line().items():
            yield from self._line(line, points)
        circles = self.drawn.synthesis.board.circles
        for centre, *points in circles:
            middle, radius, start, sweep = arc_over(self.drawn.paper, centre, points)
            beyond = _OVERSHOOT / radius
            sweep = min(tau, sweep + 2 * beyond)
            yield from self._arc(middle, radius, start - beyond, start - beyond + sweep)
        whole = {centre for centre, *_ in circles}
        for step in self.drawn.synthesis.board.steps:
            if isinstance(step, IntersectCircles):
                centres: tuple[PointName, ...] = (step.centre1, step.centre2)
            elif isinstance(step, IntersectLineCircle):
                centres = (step.centre,)
            else:
                continue
            for centre in centres:
                if centre not in whole:
                    yield from self._mark(centre, step.out)

    def _mark(self, centre: PointName, point: PointName) -> Iterator[Item]:
        way = self.at(point) - self.at(centre)
        radius = abs(way)
        if radius > _TICK:
            half = _TICK / radius
            yield from self._arc(
                self.at(centre), radius, cmath.phase(way) - half, cmath.phase(way) + half
            )

    def _line(self, line: LineName, points: Iterable[PointName]) -> Iterator[Item]:
        start, course = (complex(value) for value in self.drawn.paper.value[line])
        along = course / abs(course)
        ways = [self.drawn.distance_along(line, p) for p in points]
        if max(ways) - min(ways) > 1.0:
            ends = (
                start + along * (min(ways) - _OVERSHOOT),
                start + along * (max(ways) + _OVERSHOOT),
            )
            yield from self._clipped(ends)

    def _arc(self, centre: complex, radius: float, start: float, end: float) -> Iterator[Item]:
        count = max(8, min(2000, int(radius * (end - start) / 1.5)))
        turns = (start + (end - start) * k / count for k in range(count + 1))
        yield from self._clipped([centre + cmath.rect(radius, turn) for turn in turns])

    def angle(self, language: Language) -> tuple[list[Item], list[Label]]:
        """Return the arc of the angle between the dead positions with arrowheads, its size."""
        if not self.drawn.synthesis.theta:
            return [], []
        vertex, *ends = (self.at(name) for name in self.drawn.synthesis.theta)
        sides = [end - vertex for end in ends]
        radius = min(_MAX_ANGLE_RADIUS, _ANGLE * min(map(abs, sides)))
        turned = cmath.phase(sides[1] / sides[0])
        start = cmath.phase(sides[0] if turned > 0.0 else sides[1])
        middle = cmath.rect(1.0, start + abs(turned) / 2)
        arc = symbols.angle_dimension(vertex, radius, start, start + abs(turned), tag="theta")
        size = language.notation.as_input(round(degrees(abs(turned)), 2))
        letter = Label(typeset(f"θ = {size}°", self.sizes.text), vertex + radius * middle,
                       prefer=middle, gap=1.2, name="theta", style=BUSY)  # fmt: skip
        return arc, [letter]

    def _clipped(self, path: Iterable[complex]) -> Iterator[Item]:
        """Yield the parts of a thin line that are within the box."""
        import shapely

        whole = shapely.LineString([(p.real, p.imag) for p in path])
        within = shapely.line_merge(shapely.clip_by_rect(whole, *self.box))
        for part in shapely.get_parts(within):
            places = tuple(complex(x, y) for x, y in part.coords)
            if len(places) > 1:
                yield Stroke(places, Pen.THIN)

    def mechanism(self) -> Iterator[Item]:
        """Yield the mechanism in all its positions."""
        made = self.drawn.synthesis
        sliders = sorted((self.at(p) for pose in made.poses for p in pose.sliders),
                         key=lambda at: at.real)  # fmt: skip
        if sliders:
            low, high = sliders[0], sliders[-1]
            yield from symbols.guide_line(low, before=14.0, after=abs(high - low) + 14.0)
        for at in sliders:
            yield from symbols.slider(at)
        for pose in made.poses:
            for pin, foot in pose.stones:
                way = cmath.phase(self.at(pin) - self.at(foot))
                yield from symbols.sliding_block(
                    self.at(pin), angle=way * 180.0 / cmath.pi, pin=False
                )
        for pose in made.poses:
            for points in pose.links:
                yield from symbols.link(*map(self.at, points))
        for pivot in made.pivots:
            yield from symbols.fixed_pivot(self.at(pivot), direction=self._down(pivot))
        for pose in made.poses:
            for pin in (*pose.pins, *pose.sliders, *(pin for pin, _ in pose.stones)):
                yield from symbols.revolute(self.at(pin))

    def _down(self, pivot: str) -> complex:
        """Return the side of the support of a pivot: away from its links, up or down."""
        others = [
            self.at(q) - self.at(pivot)
            for pose in self.drawn.synthesis.poses
            for points in pose.links
            for pair in pairwise(points)
            for p, q in (pair, pair[::-1])
            if p == pivot
        ]
        rise = sum((way / (abs(way) or 1.0)).imag for way in others)
        return -1j if rise >= -1e-6 else 1j

    def labels(self) -> list[Label]:
        """Return the letters of the points; points in one place have one label."""
        groups = merge_letters(
            [(self.at(name), [name]) for name in self.drawn.points_on_sheet], near=_SAME
        )
        middle = complex(self.box[0] + self.box[2], self.box[1] + self.box[3]) / 2
        return [
            Label(
                typeset(
                    ", ".join(point_name(one, self.drawn.shown_letters) for one in names),
                    self.sizes.letter,
                ),
                at,
                prefer=(at - middle) * cmath.exp(1j * radians(10.0)),
                gap=2.6,
                style=BUSY,
            )
            for at, names in groups
        ]
