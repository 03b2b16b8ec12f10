"""Sheet of a synthesis (лист синтеза): the construction, its steps, sizes and what was measured."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import degrees, radians, tau
from typing import Any

from msgspec import Struct

from planmethod.construct.scale import Scale
from planmethod.construct.steps import LineName, MeetCircles, MeetLineCircle, PointName
from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, say
from planmethod.note.narrate.given import NBSP
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.wording import Language, language
from planmethod.problem.model import Convention, Problem
from planmethod.render import symbols
from planmethod.render.control.unused import largest_empty
from planmethod.render.frame.titleblock import rectangle
from planmethod.render.ink.drawing import Arc, Bounds, Drawing, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.labels.spots import shared_spots
from planmethod.render.layout.block import (
    Block,
    Column,
    Line,
    Picture,
    heading,
    paragraph,
)
from planmethod.render.layout.cuttings import Group, Packed
from planmethod.render.layout.pack import Placed
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.pictures.lettered import lettered
from planmethod.render.sheets.composer import (
    Blank,
    Laid,
    LaidPage,
    Misfit,
    Sizes,
    Viewed,
    compose,
    packed,
)
from planmethod.render.symbols import arrowhead
from planmethod.synthesis.drawn import Drawn, arc_over
from planmethod.synthesis.model import place
from planmethod.synthesis.text import (
    SynthesisNarrator,
    check_rows,
    given_facts,
    point_name,
    size_rows,
)

SIZES = Sizes(5.0, 5.0, 3.5, 175.0, row=6.5)
"""Sizes of letters, and of the texts over the title block."""

_BEYOND = 9.0  # mm: construction lines go on beyond their points
_TICK = 5.0  # mm: half of an arc that marks a point
_ANGLE = 0.6  # radius of the arc of an angle as a part of the shorter of its sides
_MOST_ANGLE = 45.0  # mm: that radius at most
_SAME = 0.8  # mm: points so near have one label


def synthesis_sheet(
    drawn: Drawn,
    problem: Problem,
    asked: Mapping[str, Any],
    checks: Mapping[str, Any],
    *,
    fields: Mapping[str, str] | None = None,
) -> Drawing:
    """Draw a synthesis on a sheet (лист синтеза).

    Parameters
    ----------
    problem : Problem
        Its settings of the sheet and its title block.
    asked, checks : mapping
        The options, and the values measured on the mechanism.
    fields : mapping, optional
        Texts of the title block that outrank the problem's.

    Raises
    ------
    LayoutError
        The content does not fit the paper.
    """
    words = language(problem.sheet.lang or LANGUAGES[0])
    strategy = _Synthesis(drawn, asked, checks, words)
    misfit = Misfit(
        lambda paper, advice: LayoutError(
            "{}: the construction does not fit {}. {}", drawn.synthesis.kind, paper, advice
        ),
        say("Take another --paper."),
    )
    (sheet,) = compose(problem, strategy, misfit, fields=fields)
    return sheet


class _Synthesis(Struct, frozen=True):
    """Search for the sheet of a synthesis, by smaller letters, then coarser scales."""

    drawn: Drawn
    asked: Mapping[str, Any]
    checks: Mapping[str, Any]
    words: Language

    formats = ("A3",)

    def proposals(self, papers: Sequence[Blank]) -> Iterator[_Orders]:
        """Yield the blocks at letters and scales; the steps are left out at last."""
        drawn, words = self.drawn, self.words
        title = words.synthesis["titles"][drawn.synthesis.kind]
        for paper in papers:
            for heights in ((SIZES.text, 2.5), (SIZES.text, 2.5), (SIZES.text, 2.5, 0.0)):
                view = _view(drawn, words)
                for height in heights:
                    texts = _texts(drawn, self.asked, self.checks, words, height)
                    yield _Orders(paper, view, texts, title, is_cut_down=not height)
                drawn = drawn.coarser()


class _Orders(Struct, frozen=True):
    """View and its texts in two reading orders (`Proposal`)."""

    paper: Blank
    view: Viewed
    texts: Sequence[Block]
    title: str
    is_cut_down: bool

    def laid(self) -> Laid | None:
        """Return the sheet with the measurements after the steps, or beside the view.

        The one that leaves the smaller empty rectangle is chosen.
        """
        view, room = self.view, self.paper.room()
        told, measured, sizes = self.texts
        made: list[tuple[float, int, list[Placed]]] = []
        for blocks in ((view, told, measured, sizes), (view, measured, told, sizes)):
            whole = Group(tuple(Packed(block, block is not view) for block in blocks))
            placed = packed(whole, room)
            if placed is not None:
                items: list[Item] = [rectangle(room.stamp, Pen.FRAME, "")]
                items += [item for block, corner in placed for item in block.place(corner)]
                left, low, right, high = largest_empty(items, room.inner)
                made.append(((right - left) * (high - low), len(made), placed))
        if not made:
            return None
        return Laid([LaidPage(min(made)[2], self.title, (self.is_cut_down, 0, 0))])


def _view(drawn: Drawn, words: Language) -> Viewed:
    """Return the construction with its name and scale."""
    scale = Scale("mu_l", drawn.mu, "m")
    said = scale_inscription(scale, Convention.UNIT_PER_MM, words.say)
    name = Line(typeset(words.synthesis.construction, SIZES.title))
    under = Column([name, Line(typeset(said, SIZES.text))], gap=2.5, align="centre")
    return Viewed(
        Column([_picture(drawn, words), under], gap=5.0, align="centre"), "position", scale
    )


def _texts(
    drawn: Drawn, asked: Mapping[str, Any], checks: Mapping[str, Any], words: Language, told: float
) -> list[Block]:
    """Return the given data and the steps, ``told`` mm high (none at 0), measurements, sizes."""
    said = words.synthesis
    facts = words.note.given.format(given="; ".join(given_facts(asked, words)))
    first: list[Block] = [paragraph(facts, SIZES.text, SIZES.column)]
    if told:
        steps = [
            paragraph(f"{k}) {_kept(sentence)}", told, SIZES.column)
            for k, sentence in enumerate(SynthesisNarrator(drawn, words).sentences(), 1)
        ]
        first.append(Column([heading(said.steps_title, SIZES.text), *steps], gap=0.6 * told))
    blocks: list[Block] = [Column(first, gap=6.0)]
    rows = [f"{name}:{NBSP}{value}" for name, value in check_rows(checks, words)]
    measured = paragraph(";\n".join(rows) + ".", SIZES.text, SIZES.column)
    blocks.append(Column([heading(said.measured, SIZES.text), measured], gap=3.0))
    columns = zip(said["columns"], zip(*size_rows(drawn, words), strict=True), strict=True)
    sizes = table_block(
        [TableColumn(head, tuple(values)) for head, values in columns],
        SIZES.text, width=SIZES.column, units="none", row_height=SIZES.row,
    )  # fmt: skip
    blocks.append(Column([heading(said.lengths, SIZES.text), sizes], gap=3.0))
    return blocks


def _kept(sentence: str) -> str:
    """Return a sentence whose last word is never alone on a line."""
    return NBSP.join(sentence.rsplit(" ", 1))


# The construction --------------------------------------------------------------------------------


def _picture(drawn: Drawn, words: Language) -> Picture:
    """Return the construction with the mechanism in its positions."""
    ink = _Ink(drawn)
    angle, letter = ink.angle(words)
    items = symbols.before_links([*ink.construction(), *angle, *ink.mechanism()])
    return lettered(list(items), [*ink.labels(), *letter])


class _Ink:
    """Lines and letters of a construction, mm."""

    def __init__(self, drawn: Drawn) -> None:
        self.drawn = drawn
        left, low, right, high = self.drawn.extent(self.drawn.paper)
        room = 1.5 * _BEYOND
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
            beyond = _BEYOND / radius
            sweep = min(tau, sweep + 2 * beyond)
            yield from self._arc(middle, radius, start - beyond, start - beyond + sweep)
        whole = {centre for centre, *_ in circles}
        for step in self.drawn.synthesis.board.steps:
            if isinstance(step, MeetCircles):
                centres: tuple[PointName, ...] = (step.centre1, step.centre2)
            elif isinstance(step, MeetLineCircle):
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
        ways = [self.drawn.way(line, p) for p in points]
        if max(ways) - min(ways) > 1.0:
            ends = (start + along * (min(ways) - _BEYOND), start + along * (max(ways) + _BEYOND))
            yield from self._clipped(ends)

    def _arc(self, centre: complex, radius: float, start: float, end: float) -> Iterator[Item]:
        count = max(8, min(2000, int(radius * (end - start) / 1.5)))
        turns = (start + (end - start) * k / count for k in range(count + 1))
        yield from self._clipped([centre + cmath.rect(radius, turn) for turn in turns])

    def angle(self, words: Language) -> tuple[list[Item], list[Label]]:
        """Return the arc of the angle between the dead positions with arrowheads, its size."""
        if not self.drawn.synthesis.theta:
            return [], []
        vertex, *ends = (self.at(name) for name in self.drawn.synthesis.theta)
        sides = [end - vertex for end in ends]
        radius = min(_MOST_ANGLE, _ANGLE * min(map(abs, sides)))
        turned = cmath.phase(sides[1] / sides[0])
        first, last = (sides[0], sides[1]) if turned > 0.0 else (sides[1], sides[0])
        start = cmath.phase(first)
        middle = cmath.rect(1.0, start + abs(turned) / 2)
        arc = Arc(vertex, radius, start, start + abs(turned), Pen.THIN, "theta")
        heads = (
            [
                *arrowhead(
                    vertex + radius * first / abs(first), -1j * first / abs(first), length=3.0
                ),
                *arrowhead(vertex + radius * last / abs(last), 1j * last / abs(last), length=3.0),
            ]
            if radius * abs(turned) > 8.0
            else []
        )
        size = words.say.given(round(degrees(abs(turned)), 2))
        letter = Label(typeset(f"θ = {size}°", SIZES.text), vertex + radius * middle,
                       prefer=middle, gap=1.2, name="theta", manner=BUSY)  # fmt: skip
        return [arc, *heads], [letter]

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
                yield from symbols.stone(self.at(pin), angle=way * 180.0 / cmath.pi, pin=False)
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
        groups = shared_spots([(self.at(name), [name]) for name in self.drawn.shown], near=_SAME)
        middle = complex(self.box[0] + self.box[2], self.box[1] + self.box[3]) / 2
        return [
            Label(
                typeset(", ".join(map(point_name, names)), SIZES.letter),
                at,
                prefer=(at - middle) * cmath.exp(1j * radians(10.0)),
                gap=2.6,
                manner=BUSY,
            )
            for at, names in groups
        ]
