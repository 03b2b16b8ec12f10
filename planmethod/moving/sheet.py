"""Sheet of a moving point: trajectory, hodographs, formulas with numbers, tables (лист точки)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import combinations, pairwise
from typing import TypeAlias

import numpy as np
from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.construct.drafting import Profile
from planmethod.construct.scale import Scale, series_near
from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES
from planmethod.moving.construction import Construction, construct, read_hodograph
from planmethod.moving.course import Course, course_of
from planmethod.moving.model import PointProblem
from planmethod.moving.motion import COLUMNS, Motion
from planmethod.moving.pictures import (
    hodograph_picture,
    length_scale,
    plan_scale,
    trajectory_picture,
    vector_scales,
)
from planmethod.moving.text import LEGEND, head_of, law, moment, textbook
from planmethod.note.document import Formula, Note
from planmethod.note.narrate.given import unbroken
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.numbers import alike, significant
from planmethod.note.plaintext import plain_text
from planmethod.note.rounding import rounded_to, sigma_text
from planmethod.note.wording import Language, language
from planmethod.paper import Format
from planmethod.problem.model import Convention
from planmethod.render.frame.frame import STAMP_WIDTH, paper_format, sheet_frame
from planmethod.render.frame.furniture import Furniture, Room
from planmethod.render.frame.titleblock import merged
from planmethod.render.ink.drawing import Disc, Drawing, Item, Span
from planmethod.render.ink.lettering import lettering, using
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, heading, paragraph
from planmethod.render.layout.cuttings import Group, Part
from planmethod.render.layout.nodes import blocks_of
from planmethod.render.layout.pack import EDGE, Placed, pack
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.pictures.planview import POLE
from planmethod.render.sheets.views import Viewed

PAPERS = ("A3", "A2", "A1")
"""Formats tried in turn when none is asked for."""

LETTER, TITLE, TEXT = 5.0, 5.0, 3.5
"""Heights of letters on views, names of views, and texts, mm."""

TRAJECTORY_BOX, HODOGRAPH_BOX = (170.0, 125.0), (105.0, 95.0)
"""What trajectory and hodographs shall fill, mm, times the factors that are tried."""

FACTORS = (1.9, 1.6, 1.35, 1.15, 1.0, 0.87, 0.75, 0.65, 0.56, 0.48, 0.4, 0.32, 0.25)
COLUMN_WIDTHS = (120.0, 95.0)

TABLE_WIDTH = STAMP_WIDTH + 15.0

MOST_STEPS = 3
"""Most members of the series that a scale goes on by."""


class _Plan(Viewed, frozen=True):
    """Hodograph of a kind, with the plan of the told moment."""

    built: Construction | None
    plan: str

    def spans(self, items: Sequence[Item]) -> Iterator[Span]:
        """Yield the whole vector of the plan."""
        if self.built is None:
            return
        (pole,) = (one.centre for one in items if isinstance(one, Disc) and one.tag == POLE)
        trace = self.built.read()
        for vector in self.built.vectors:
            if vector.plan == self.plan and vector.is_whole:
                head = complex(np.ravel(trace.value[vector.head])[0])
                if abs(head) > 0.05:
                    yield Span(plain_text(vector.symbol), None, pole, pole + head)


_Pages: TypeAlias = tuple[tuple[Placed, ...], ...]


class _Laid(Struct, frozen=True):
    """Sheets: their blocks with the upper left corners that they were put at; the scales."""

    pages: _Pages
    scales: dict[str, Scale]


class _Sheet(Struct, frozen=True):
    """All that a sheet of a point shows, but for the sizes of its views."""

    problem: PointProblem
    course: Course
    profile: Profile
    words: Language
    views: dict[tuple[object, ...], Block] = field(default_factory=dict)

    def laid_out(self, rooms: Sequence[Room]) -> _Laid | None:
        """Return the blocks, the views as large as the paper bears; None when they do not fit.

        Of several sheets the first has the views.

        All views grow together first, then each as far as the others leave it room.
        """
        inner = rooms[0].inner

        def packed(scales: dict[str, Scale], column: float) -> _Laid | None:
            laid = None
            for draft in (True, False):  # placing letters takes long: first without
                parts = self.parts(scales, column, inner[2] - inner[0] - 2 * EDGE, draft=draft)
                pages = _on_pages(parts, rooms)
                if pages is None:
                    return None
                laid = _Laid(pages, scales)
            return laid

        tried: set[tuple[float, ...]] = set()
        for factor in FACTORS:
            scales = self.scales(factor)
            key = tuple(scale.per_mm for scale in scales.values())
            if key in tried:
                continue
            tried.add(key)
            for column in COLUMN_WIDTHS:
                laid = packed(scales, column)
                if laid is not None:
                    return self._grown(laid, partial(packed, column=column))
        return None

    def _grown(self, laid: _Laid, packed: Callable[[dict[str, Scale]], _Laid | None]) -> _Laid:
        """Return the blocks with every free scale as large as they bear."""
        asked = self.problem.scales
        inverse = asked.convention is Convention.MM_PER_UNIT
        for name, mu in (("l", asked.mu_l), ("v", asked.mu_v), ("a", asked.mu_a)):
            for _ in range(0 if mu is not None else MOST_STEPS):
                scale = laid.scales[name]
                finer = replace(scale, per_mm=_finer(scale.per_mm, inverse=inverse))
                larger = packed(laid.scales | {name: finer})
                if larger is None:
                    break
                laid = larger
        return laid

    def scales(self, factor: float) -> dict[str, Scale]:
        """Return the scales of views that are so many times as large as usual."""
        asked, found = self.problem.scales, dict[str, Scale]()
        box = (factor * HODOGRAPH_BOX[0], factor * HODOGRAPH_BOX[1])
        for plan, mu in (("v", asked.mu_v), ("a", asked.mu_a)):
            found[plan] = plan_scale(self.course, plan, box, mu, asked.convention)
        whole = (factor * TRAJECTORY_BOX[0], factor * TRAJECTORY_BOX[1])
        return found | {"l": length_scale(self.problem, self.course, found, whole)}

    def parts(
        self, scales: Mapping[str, Scale], column: float, room: float, *, draft: bool = False
    ) -> list[Part]:
        """Return the blocks in reading order."""
        course, said = self.course, self.words.point
        built = {
            k: made
            for k in course.shown
            if (made := construct(self.problem, course.marks, k, scales)) is not None
        }
        first = built.get(course.shown[0]) if course.shown else None
        parts = [Part(self._statement(column), text=True)]

        def trajectory() -> Block:
            own = vector_scales(course, scales)
            picture = trajectory_picture(
                self.problem, course, own, letter_height=LETTER, say=self.words.say, draft=draft
            )
            return self._named(picture, said.trajectory, [own[name] for name in "lva"])

        parts.append(
            Part(Viewed(self._kept("lva", scales, trajectory, draft), "trajectory", scales["l"]))
        )
        for plan, title, depends in (("v", said.hodograph_v, "lv"), ("a", said.hodograph_a, "va")):
            if plan == "a" and np.isnan(course.marks.columns["ax"]).all():
                continue

            def hodograph(plan: str = plan, title: str = title) -> Block:
                picture = hodograph_picture(
                    course, plan, first, scales, letter_height=LETTER, draft=draft
                )
                return self._named(picture, title, [scales[plan]])

            block = self._kept(depends, scales, hodograph, draft)
            parts.append(Part(_Plan(block, "hodograph", scales[plan], first, plan)))
        if course.shown:
            parts.append(Part(self._calculation(course.shown[0], column), text=True))
        if first is not None:
            parts.append(Part(self._read(first, course.shown[0]), text=True))
        return [*parts, Part(self._table(room, scales["v"]), text=False)]

    def _kept(
        self, names: str, scales: Mapping[str, Scale], make: Callable[[], Block], draft: bool
    ) -> Block:
        """Return a view that depends on some scales, made once for them."""
        key = (draft, names, *(scales[name].per_mm for name in names))
        if key not in self.views:
            self.views[key] = make()
        return self.views[key]

    def _named(self, picture: Block, title: str, scales: Sequence[Scale]) -> Block:
        convention, say = self.problem.scales.convention, self.words.say
        lines: list[Block] = [Line(typeset(title, TITLE), underline=True)]
        lines += [Line(typeset(scale_inscription(one, convention, say), TEXT)) for one in scales]
        return Column([picture, Column(lines, gap=2.5, align="centre")], gap=5.0, align="centre")

    def _statement(self, width: float) -> Block:
        """Return "Дано" and what is asked."""
        said, say = self.words.point, self.words.say
        decimal, times = say.decimal, self.problem.times
        facts = law(self.problem, self.words, lambda text: textbook(text, decimal))
        moments = said.moments.format(times="; ".join(map(say.given, times)))
        if len(times) > 3:
            ends = {"start": say.given(min(times)), "end": say.given(max(times))}
            moments = said.row.format(**ends, count=len(times))
        else:
            moments = unbroken([moments])
        # A formula is not broken within.
        whole = [
            unbroken([fact.text]) if isinstance(fact, Formula) else fact.text for fact in facts
        ]
        texts = [self.words.note.given.format(given="; ".join([*whole, moments])), said.wanted]
        return Column([paragraph(text, TEXT, width=width) for text in texts], gap=3.0)

    def _calculation(self, k: int, width: float) -> Block:
        """Return the formulas of one moment with their numbers."""
        time = self.words.say.given(float(self.course.marks.columns["t"][k]))
        blocks: list[Block] = [heading(self.words.point.at.format(time=time), TEXT, width=width)]
        nodes: list[Formula | Note] = []
        for node in moment(self.problem, self.course.marks, k, self.words):
            if nodes and _is_short(node) and _is_short(nodes[-1]):
                nodes[-1] = Formula(f"{nodes[-1].text};  {node.text}")  # two components
            else:
                nodes.append(node)
        return Column([*blocks, *blocks_of(nodes, TEXT, width=width)], gap=2.6)

    def _read(self, built: Construction, k: int) -> Block:
        """Return what the drawing gives beside the exact values, and its error."""
        whole = read_rows(built, self.course.marks, k, self.words, self.profile)
        rows, said = [row for row in whole if row[2] != "—"], self.words.point
        columns = [
            TableColumn(head, tuple(row[n] for row in rows)) for n, head in enumerate(said["read"])
        ]
        title = said.read_title.format(profile=self.words.note["profiles"][self.profile.name])
        return Column([Line(typeset(title, TEXT)), table_block(columns, TEXT, units="none")], 2.5)

    def _table(self, room: float, scale: Scale) -> Block:
        """Return the table of the numbered instants."""
        say, marks, said = self.words.say, self.course.marks, self.words.point
        count = len(marks.columns["t"])
        columns = [TableColumn("№", tuple(map(str, range(count))), least=6.0)]
        for name in COLUMNS:
            values = [float(value) + 0.0 for value in marks.columns[name]]
            whole = all(np.isfinite(values))
            told = alike(values) if whole else [significant(value) for value in values]
            cells = tuple("0" if not text.strip("-0.") else say.number(text) for text in told)
            if name == "t":
                cells = tuple(say.given(value) for value in values)
            unit = say.units[LEGEND[name].unit]
            columns.append(TableColumn(LEGEND[name].symbol, cells, unit, least=8.0))
        chords = read_hodograph(self.course, scale, self.profile)
        if len(chords.at) > 1:
            shown = ["—"] * count
            for k, value, sigma in zip(chords.at, chords.read, chords.sigma, strict=True):
                shown[k] = (
                    f"{say.number(rounded_to(value, sigma))} ± {say.number(sigma_text(sigma))}"
                )
            columns.append(TableColumn(said.chord, tuple(shown), say.units["m/s²"]))
        row = 6.0 if count > 8 else 7.0
        table = table_block(
            columns, TEXT, width=min(room, TABLE_WIDTH), units="below", leading=2, row_height=row
        )
        notes = [] if len(chords.at) < 2 else [paragraph(said.chord_note, 2.5, STAMP_WIDTH)]
        return Column([Line(typeset(said.table, TEXT)), table, *notes], gap=2.5)


def _is_short(node: Formula | Note) -> bool:
    """Tell whether a node is a formula without a calculation, of which two fit a line."""
    return isinstance(node, Formula) and node.text.count("=") == 1


def read_rows(
    built: Construction, marks: Motion, k: int, words: Language, profile: Profile
) -> Iterator[tuple[str, str, str, str]]:
    """Yield what the drawing gives beside the exact values, rich text: symbol, exact, read, σ."""
    ruled, sigma, say = built.ruled(profile.ruler), built.sigma(profile), words.say
    for name in built.results:
        exact = significant(float(marks.columns[name][k]) + 0.0)
        read = say.number(rounded_to(ruled[name], sigma[name])) if np.isfinite(ruled[name]) else "—"
        error = say.number(sigma_text(sigma[name])) if np.isfinite(sigma[name]) else "—"
        yield head_of(name, say), say.number(exact), read, error


def _on_pages(parts: Sequence[Part], rooms: Sequence[Room]) -> _Pages | None:
    """Return blocks on as many sheets as there are rooms; the views are on the first."""
    views = 1 + max(k for k, part in enumerate(parts) if isinstance(part.block, Viewed))
    for turns in combinations(range(views, len(parts)), len(rooms) - 1):
        edges = pairwise((0, *turns, len(parts)))
        pages = _packed([parts[start:end] for start, end in edges], rooms)
        if pages is not None:
            return pages
    return None


def _packed(runs: Sequence[Sequence[Part]], rooms: Sequence[Room]) -> _Pages | None:
    """Return blocks with their corners, a run on each sheet; None when one does not fit."""
    pages = []
    for room, run in zip(rooms, runs, strict=True):
        left, low, right, high = room.inner
        if sum(part.block.width * part.block.height for part in run) > (right - left) * (
            high - low
        ):
            return None
        placed = pack(Group(tuple(run)), room.inner, room.stamp, room.taken)
        if placed is None:
            return None
        pages.append(tuple(placed))
    return tuple(pages)


def _finer(per_mm: float, *, inverse: bool) -> float:
    """Return the next scale of the series, at which everything is larger."""
    if inverse:
        return 1.0 / series_near(1.01 / per_mm, up=True)
    return series_near(0.99 * per_mm, up=False)


def drawings(
    problem: PointProblem,
    *,
    fields: Mapping[str, str] | None = None,
    profile: Profile,
    before: int = 0,
    total: int | None = None,
) -> list[Drawing]:
    """Draw the motion of a point in the language of ``problem.sheet``; on A4 on several sheets.

    Parameters
    ----------
    fields : mapping, optional
        Texts of the title block that outrank the file's.
    profile : Profile
        How well it is drawn: the ruler and the errors of what is read.
    before, total : int
        Sheets of the set before this one, and of the whole set.

    Raises
    ------
    ProblemError
        The point is nowhere in the shown interval.
    LayoutError
        When everything fits no format, or not the asked one.
    """
    furniture = Furniture.of(problem.sheet, before=before, total=total)
    made = []
    with using(lettering(problem.sheet.lettering or "B")):
        fmt, laid = _laid_out(problem, course_of(problem), profile, furniture)
        for number, blocks in enumerate(laid.pages, 1):
            texts = merged(
                {"title": problem.title or problem.name, "sheets": "1"},
                problem.stamp,
                furniture.numbers(number, len(laid.pages)),
                fields or {},
            )
            drawing = Drawing(fmt.width, fmt.height, texts["title"])
            drawing.extend(sheet_frame(fmt, texts, furniture, sheet=number).items)
            for block, corner in blocks:
                items = block.place(corner)
                drawing.extend(items)
                if isinstance(block, Viewed):
                    drawing.views.append(block.view(items, corner))
            made.append(drawing)
    return made


def sheet_scales(problem: PointProblem, course: Course, profile: Profile) -> dict[str, Scale]:
    """Return the scales that the sheet is drawn at, by ``l``, ``v``, ``a``."""
    with using(lettering(problem.sheet.lettering or "B")):
        return _laid_out(problem, course, profile, Furniture.of(problem.sheet))[1].scales


def _laid_out(
    problem: PointProblem, course: Course, profile: Profile, furniture: Furniture
) -> tuple[Format, _Laid]:
    """Return the paper and the blocks on it."""
    sheet = _Sheet(problem, course, profile, language(problem.sheet.lang or LANGUAGES[0]))
    asked = problem.sheet.paper
    papers = (paper_format(asked).name,) if asked else PAPERS
    for name in papers:
        fmt = paper_format(name)
        for count in (1, 2, 3) if asked else (1,):
            laid = sheet.laid_out([furniture.room(fmt, k + 1) for k in range(count)])
            if laid is not None:
                return fmt, laid
    mu = problem.scales
    advice = "Leave --paper out." if asked else "Ask fewer moments, or a shorter show."
    if any(given is not None for given in (mu.mu_l, mu.mu_v, mu.mu_a)):
        advice = "Take coarser scales in [scales], or leave them out."
    raise LayoutError(
        "{}: the motion of the point does not fit {}. {}", problem.name, papers[-1], advice
    )
