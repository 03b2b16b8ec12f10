"""Sheet of the kinematic analysis: scheme, velocity and acceleration plans, equations, tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np

from planmethod.construct.drafting import PROFILES, Profile
from planmethod.construct.scale import Scale
from planmethod.errors import LayoutError
from planmethod.note.calculation import calculation
from planmethod.note.given import (
    asked_links,
    asked_points,
    given,
    number,
    solution_peak,
    wanted,
)
from planmethod.note.letters import shown_letters
from planmethod.note.numbers import UNITS_RU, alike, is_nothing, russian
from planmethod.note.plaintext import plain_text
from planmethod.note.sigmas import DRAWN, label_of, marked, rounded_to, sigma_text
from planmethod.note.wording import wording
from planmethod.plans.model import PlanKind
from planmethod.plans.scaling import AS_HIGH, Views, own_scale
from planmethod.plans.selfcheck import verify
from planmethod.plans.solution import Reals, Solution
from planmethod.problem.model import Convention, Problem
from planmethod.render.block import Block, Column, Line, Row, heading, paragraph
from planmethod.render.drawing import Bounds, Disc, Drawing, Item, Span, View
from planmethod.render.ellipses import ellipse_inscription
from planmethod.render.equations import equation_block, formula_block
from planmethod.render.frame import paper_format, sheet_frame
from planmethod.render.pack import EDGE, pack
from planmethod.render.planview import POLE, plan_picture, plan_places
from planmethod.render.schemeview import scheme_picture
from planmethod.render.tables import Cell, TableColumn, table_block
from planmethod.render.typeset import typeset

PER_SHEET = (12, 6, 4, 2, 1)
"""Positions on one sheet: as many as fit; the others go on further sheets."""

MOST_POSITIONS = 120
"""Most positions drawn in one call: ten sheets of a dozen plans."""

PAPERS = ("A3", "A2", "A1", "A0")
"""Formats tried in turn when none is asked for."""

TITLES = {
    PlanKind.POSITION: "План положения механизма",
    PlanKind.VELOCITY: "План скоростей",
    PlanKind.ACCELERATION: "План ускорений",
}
MANY_TITLES = {
    PlanKind.POSITION: "Планы положений механизма",
    PlanKind.VELOCITY: "Планы скоростей",
    PlanKind.ACCELERATION: "Планы ускорений",
}


@dataclass(frozen=True, slots=True)
class Heights:
    """Letter heights of a sheet, mm (высота шрифта)."""

    letter: float
    title: float
    text: float


@dataclass(frozen=True, slots=True)
class Extras:
    """What a sheet shows of the drafting errors: ellipses around points, sigmas in the table."""

    errors: bool = False
    sigma: bool = False


HEIGHTS = {
    "A4": Heights(3.5, 3.5, 2.5),
    "A3": Heights(3.5, 5.0, 3.5),
    "A2": Heights(5.0, 5.0, 3.5),
    "A1": Heights(5.0, 7.0, 5.0),
    "A0": Heights(5.0, 7.0, 5.0),
}

NBSP = "\u00a0"

COLUMN_WIDTHS = {"A4": 82.0, "A3": 125.0, "A2": 180.0, "A1": 250.0, "A0": 280.0}
"""Width that texts and equations are set to, mm."""


def scale_inscription(scale: Scale, convention: Convention) -> str:
    """Return the inscription under a view: ``μ_v = 0,05 (м/с)/мм`` or ``μ_v = 20 мм/(м/с)``."""
    letter = scale.symbol.removeprefix("mu_")
    unit = UNITS_RU[scale.unit]
    grouped = f"({unit})" if "/" in unit else unit
    if convention is Convention.MM_PER_UNIT:
        return f"μ_{{{letter}}} = {number(1.0 / scale.per_mm)} мм/{grouped}"
    return f"μ_{{{letter}}} = {number(scale.per_mm)} {grouped}/мм"


@dataclass(frozen=True)
class Viewed:
    """A view among the blocks of a sheet (вид): it knows what is measured on it.

    ``indices`` are the positions whose plans it shows, in the order in which they are drawn.
    """

    block: Block
    solution: Solution
    kind: PlanKind
    indices: tuple[int, ...]

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

    def view(self, items: Sequence[Item], corner: complex) -> View:
        """Return what is told of the view whose items were placed at a corner."""
        left, top = corner.real, corner.imag
        scale = self.solution.scales[self.kind]
        letter = scale.symbol.removeprefix("mu_")
        poles = [item.centre for item in items if isinstance(item, Disc) and item.tag == POLE]
        return View(
            self.kind.value,
            (left, top - self.height, left + self.width, top),
            f"μ_{{{letter}}}",
            scale.per_mm,
            tuple(
                span
                for pole, index in zip(poles, self.indices, strict=False)
                for span in plan_spans(self.solution, self.kind, index, pole)
            ),
        )


def plan_spans(solution: Solution, kind: PlanKind, index: int, pole: complex) -> list[Span]:
    """Return the measured segments of a plan whose pole lies at ``pole`` on the sheet.

    A vector that is nothing beside the plan is zero by nature and no segment.
    """
    plan = solution.construction.plan(kind)
    at = plan_places(solution, kind, index)
    sizes = [abs(at[vector.head] - at[vector.tail]) for vector in plan.vectors]
    letters = shown_letters(solution.problem, plan)
    position = index if len(solution.positions) > 1 else None
    named = {
        frozenset((vector.tail, vector.head)): vector
        for vector, size in zip(plan.vectors, sizes, strict=True)
        if not is_nothing(size, max(sizes))
    }
    return [
        Span(
            plain_text(letters[vector.tail][0] + letters[vector.head][0]),
            position,
            pole + at[vector.tail],
            pole + at[vector.head],
        )
        for vector in named.values()
    ]


def _view(
    solution: Solution,
    kind: PlanKind,
    picture: Block,
    size: Heights,
    title: str,
    indices: Sequence[int],
    ellipses: Sequence[int] = (),
) -> Viewed:
    """Return a picture with its title and scale; ``ellipses`` are the positions that have them."""
    convention = solution.problem.scales.convention
    said = [scale_inscription(solution.scales[kind], convention)]
    said += ellipse_inscription(solution, kind, ellipses) if ellipses else []
    block = Column(
        [
            picture,
            Column(
                [
                    Line(typeset(title, size.title), underline=True),
                    *(Line(typeset(text, size.text)) for text in said),
                ],
                gap=2.5,
                align="centre",
            ),
        ],
        gap=5.0,
        align="centre",
    )
    return Viewed(block, solution, kind, tuple(indices))


def _statement(solution: Solution, size: Heights, width: float) -> Block:
    """Return "Дано" and "Определить"."""
    facts = given(solution.problem, list(solution.positions))
    said = "; ".join(fact.replace(" ", NBSP) for fact in facts)
    return Column(
        [
            paragraph(f"Дано: {said}.", size.text, width=width),
            paragraph(f"Определить: {wanted(solution)}.", size.text, width=width),
        ],
        gap=3.0,
    )


def _equations(solution: Solution, kind: PlanKind, size: Heights, width: float) -> Block:
    plan = solution.construction.plan(kind)
    title = "Уравнения скоростей" if kind is PlanKind.VELOCITY else "Уравнения ускорений"
    height = max(3.5, min(5.0, size.text))
    blocks: list[Block] = [heading(title, size.text)]
    blocks += [equation_block(e, height, width=width) for e in plan.equations]
    return Column(blocks, gap=4.0)


def _calculation(solution: Solution, kind: PlanKind, index: int, height: float) -> Block:
    """Return the formulas with the read segments."""
    lines = calculation(solution, kind, index)
    title = "Расчёт скоростей" if kind is PlanKind.VELOCITY else "Расчёт ускорений"
    return Column([heading(title, height), *(formula_block(x, height) for x in lines)], gap=2.2)


def _sense(value: float) -> int:
    return 0 if value == 0 else (1 if value > 0 else -1)


def _as_long(text: str, value: float, sigma: float) -> str:
    """Return an exact value with no fewer decimals than its error has."""
    longer = rounded_to(value, sigma) if value and sigma else text
    return longer if len(longer.partition(".")[2]) > len(text.partition(".")[2]) else text


def _sigma_rows(solution: Solution, symbol: str, name: str, index: int) -> tuple[Cell, Cell]:
    """Return what was read on the drawing, to the place of its error, and the error."""
    hand, which = solution.by_hand_results, symbol in "aε"
    read = float((hand.links if symbol in "ωε" else hand.points)[name][which][index])
    sigma, mark = marked(solution.drafting, label_of(symbol, name), index)
    turns = symbol in "ωε"
    return (
        Cell(russian(rounded_to(abs(read), sigma)), _sense(read) if turns else None),
        Cell(russian(sigma_text(sigma)) + mark, 0 if turns else None),
    )


def result_columns(
    solution: Solution, indices: Sequence[int], *, sigma: bool = False
) -> list[TableColumn]:
    """Return the columns of the result table: v, ω, a, ε with values and senses.

    With ``sigma`` a single position has rows for what was read and for its error, and the values
    of many have their errors beside them.
    """
    alone = len(solution.positions) == 1

    def column(symbol: str, name: str, unit: str, numbers: Reals) -> TableColumn:
        peak = solution_peak(solution, symbol)
        shown = [float(numbers[i]) for i in indices]
        shown = [0.0 if is_nothing(value, peak) else value for value in shown]
        texts = alike([abs(value) for value in shown])
        turns = symbol in "ωε"
        errors = [(0.0, "") for _ in shown]
        if sigma:
            errors = [marked(solution.drafting, label_of(symbol, name), i) for i in indices]
        cells = []
        for text, value, (error, mark) in zip(texts, shown, errors, strict=True):
            written = russian(_as_long(text, abs(value), error))
            if error and not alone:
                written += f" ± {russian(sigma_text(error))}{mark}"
            cells.append(Cell(written, _sense(value) if turns else None))
        if sigma and alone:
            cells += _sigma_rows(solution, symbol, name, indices[0])
        return TableColumn(f"{symbol}_{{{name}}}", tuple(cells), unit=UNITS_RU[unit])

    points, links = asked_points(solution), asked_links(solution)
    motions = [solution.points[name] for name in points]
    turnings = [solution.links[link] for link in links]
    columns = [
        column("v", name, "m/s", np.abs(motion.velocity))
        for name, motion in zip(points, motions, strict=True)
    ]
    columns += [
        column("ω", link, "1/s", turning.omega)
        for link, turning in zip(links, turnings, strict=True)
    ]
    columns += [
        column("a", name, "m/s²", np.abs(motion.acceleration))
        for name, motion in zip(points, motions, strict=True)
    ]
    columns += [
        column("ε", link, "1/s²", turning.epsilon)
        for link, turning in zip(links, turnings, strict=True)
    ]
    if sigma and alone:
        columns.insert(0, TableColumn("", ("точно", "снято", "±σ")))
    if not alone:
        drive = solution.problem.drive
        symbol, unit = (f"φ_{{{drive.link}}}", "°") if drive.is_crank else ("s", "м")
        asked = tuple(Cell(position_text(solution, i)) for i in indices)
        columns.insert(0, TableColumn(symbol, asked, unit=unit))
        columns.insert(0, TableColumn("№", tuple(Cell(str(i)) for i in indices), least=8.0))
    return columns


def _results(
    solution: Solution, indices: Sequence[int], height: float, width: float, *, sigma: bool
) -> Block:
    """Return the table of results and, with ``sigma``, what its errors are."""
    alone = len(solution.positions) == 1
    title = "Результаты (точные значения)"
    if sigma:
        title = "Результаты" if alone else "Результаты (точные значения ± погрешность построения σ)"
    columns = result_columns(solution, indices, sigma=sigma)
    table = table_block(
        columns,
        height,
        max_width=width,
        leading=(1 if sigma else 0) if alone else 2,
        title=title,
    )
    if not sigma:
        return table
    words, name = wording("ru"), solution.profile.name
    said = f"±σ — погрешность построения (СКО), {words.profiles.get(name, name)}."
    if any(cell.text.endswith(DRAWN) for column in columns for cell in column.cells):
        said += " " + words.drawn_note.format(count=solution.drafting.draws)
    return Column([table, paragraph(said, min(height, 3.5), table.width)], gap=3.0)


def position_text(solution: Solution, index: int) -> str:
    """Return a driver position as the sheet writes it: an angle within one turn, two decimals."""
    value = float(solution.positions[index])
    if not solution.problem.drive.is_crank:
        return number(value)
    return number(round(value % 360.0, 2) % 360.0)


def _grid(
    solution: Solution, kind: PlanKind, indices: Sequence[int], size: Heights, *, errors: bool
) -> Block:
    """Return the plans of many positions in rows, each with its number."""
    drive = solution.problem.drive
    cells: list[Block] = []
    convention = solution.problem.scales.convention
    for i in indices:
        value = position_text(solution, i)
        said = f"{i}: φ_{{{drive.link}}} = {value}°" if drive.is_crank else f"{i}: s = {value} м"
        own = own_scale(solution, kind, i)
        caption: Block = Line(typeset(said, 3.5))
        if own != solution.scales[kind]:
            scale = Line(typeset(scale_inscription(own, convention), 3.5))
            caption = Column([caption, scale], gap=2.0, align="centre")
        picture = plan_picture(solution, kind, i, letter_height=3.5, errors=errors)
        cells.append(Column([picture, caption], gap=3.0, align="centre"))
    per_row = {2: 2, 3: 3, 4: 4}.get(len(cells), 6 if len(cells) > 5 else 5)
    rows = [
        Row(cells[k : k + per_row], gap=6.0, align="bottom") for k in range(0, len(cells), per_row)
    ]
    ellipses = indices if errors else ()
    return _view(solution, kind, Column(rows, gap=6.0), size, MANY_TITLES[kind], indices, ellipses)


def _blocks(
    solution: Solution,
    indices: Sequence[int],
    paper: str,
    inside: float,
    extras: Extras,
    *,
    formulas: float | None,
) -> list[Block]:
    """Return the blocks of a sheet in reading order; ``formulas`` is their letter height, mm."""
    size = HEIGHTS[AS_HIGH.get(paper, paper)]
    column = COLUMN_WIDTHS[AS_HIGH.get(paper, paper)]
    result = _results(
        solution,
        indices,
        size.text if len(indices) == 1 else min(size.text, 3.5),
        min(max(185.0, 0.58 * inside), inside - 2 * EDGE),
        sigma=extras.sigma,
    )
    statement = _statement(solution, size, column)
    v, a = PlanKind.VELOCITY, PlanKind.ACCELERATION
    if len(solution.positions) == 1:
        errors, ellipses = extras.errors, tuple(indices) if extras.errors else ()
        scheme = scheme_picture(solution, indices[0], letter_height=size.letter, errors=errors)
        plans = {
            kind: _view(
                solution,
                kind,
                plan_picture(solution, kind, indices[0], letter_height=size.letter, errors=errors),
                size,
                TITLES[kind],
                indices,
                ellipses,
            )
            for kind in (v, a)
        }
        return [
            _view(
                solution,
                PlanKind.POSITION,
                scheme,
                size,
                TITLES[PlanKind.POSITION],
                indices,
                ellipses,
            ),
            statement,
            plans[v],
            _equations(solution, v, size, column),
            *([_calculation(solution, v, indices[0], formulas)] if formulas else []),
            plans[a],
            _equations(solution, a, size, column),
            *([_calculation(solution, a, indices[0], formulas)] if formulas else []),
            result,
        ]
    # The bold position is the one furthest from a dead position.
    bold = max(indices, key=lambda i: float(solution.margin[i]))
    scheme = scheme_picture(
        solution, bold, letter_height=size.letter, overlay=tuple(indices), errors=extras.errors
    )
    title, ellipses = MANY_TITLES[PlanKind.POSITION], (bold,) if extras.errors else ()
    return [
        _view(solution, PlanKind.POSITION, scheme, size, title, indices, ellipses),
        statement,
        _equations(solution, v, size, column),
        _equations(solution, a, size, column),
        _grid(solution, v, indices, size, errors=extras.errors),
        _grid(solution, a, indices, size, errors=extras.errors),
        result,
    ]


def stamp_fields(
    problem: Problem, sheet: int, sheets: int, extra: Mapping[str, str]
) -> dict[str, str]:
    """Return the texts of the title block: the defaults, the problem's, then the asked ones.

    The number of the sheet stays empty on a single one, as the standard has it; of several sheets
    the computed numbers outrank the file's.
    """
    numbers = {"sheet": str(sheet), "sheets": str(sheets)}
    fields = {"title": problem.title, "sheets": "1", **problem.stamp}
    fields.update(numbers if sheets > 1 else {})
    fields.update(extra)
    return {key: value for key, value in fields.items() if value}


@dataclass(frozen=True, slots=True)
class Page:
    """What is inside the frame of one sheet."""

    items: list[Item]
    views: list[View]


def _layouts(
    solution: Solution, indices: Sequence[int], paper: str, extras: Extras, *, forced: bool
) -> list[Page] | None:
    """Return the sheet that shows some positions, or None when they do not fit.

    The formulas shrink before they are left out. On a format that was asked for one position may
    take several sheets.
    """
    fmt = paper_format(paper)
    inside = fmt.inner[2] - fmt.inner[0]
    tries: list[tuple[int, float | None]] = [(1, 3.5), (1, 2.5), (1, None)]
    if forced and len(solution.positions) == 1:
        tries += [(2, 3.5), (2, 2.5), (3, 3.5), (3, 2.5), (3, None), (4, None)]
    for count, formulas in tries:
        blocks = _blocks(solution, indices, paper, inside, extras, formulas=formulas)
        parts = _divided(blocks, count, fmt.inner, fmt.stamp)
        if parts is not None:
            return parts
    return None


def _divided(
    blocks: Sequence[Block], count: int, inner: Bounds, stamp: Bounds
) -> list[Page] | None:
    """Return blocks put on so many sheets in reading order, the sheets as evenly full as can be."""
    areas = [block.width * block.height for block in blocks]

    def fullest(cuts: tuple[int, ...]) -> float:
        edges = (0, *cuts, len(blocks))
        return max(sum(areas[i:j]) for i, j in pairwise(edges))

    for cuts in sorted(combinations(range(1, len(blocks)), count - 1), key=fullest):
        parts = [blocks[i:j] for i, j in pairwise((0, *cuts, len(blocks)))]
        packed = [pack(part, inner, stamp) for part in parts]
        if None not in packed:
            return [_page(part, at) for part, at in zip(parts, packed, strict=True) if at]
    return None


def _page(blocks: Sequence[Block], corners: Sequence[complex]) -> Page:
    page = Page([], [])
    for block, corner in zip(blocks, corners, strict=True):
        items = block.place(corner)
        page.items.extend(items)
        if isinstance(block, Viewed):
            page.views.append(block.view(items, corner))
    return page


def _pages(
    solution: Solution,
    paper: str,
    per_sheet: int,
    fields: Mapping[str, str],
    extras: Extras,
    *,
    forced: bool,
) -> list[Drawing] | None:
    """Return the sheets with so many positions on each, or None when one does not fit."""
    count = len(solution.positions)
    if per_sheet > 1 and per_sheet // 2 >= count:
        return None
    layouts: list[Page] = []
    for start in range(0, count, per_sheet):
        indices = range(start, min(start + per_sheet, count))
        found = _layouts(solution, indices, paper, extras, forced=forced)
        if found is None:
            return None
        layouts += found
    fmt = paper_format(paper)
    sheets = []
    for page_number, page in enumerate(layouts, 1):
        told = stamp_fields(solution.problem, page_number, len(layouts), fields)
        drawing = Drawing(fmt.width, fmt.height, told.get("title", solution.problem.title))
        drawing.extend(sheet_frame(fmt, told)[0])
        drawing.extend(page.items)
        drawing.views.extend(page.views)
        sheets.append(drawing)
    return sheets


def kinematics_sheets(
    problem: Problem,
    *,
    paper: str | None = None,
    positions: Sequence[float] | None = None,
    ruler: float | None = None,
    profile: Profile = PROFILES["board"],
    fields: Mapping[str, str] | None = None,
    errors: bool = False,
    sigma: bool = False,
) -> list[Drawing]:
    """Draw the kinematic analysis: one sheet for each dozen of positions.

    Parameters
    ----------
    paper : str, optional
        Format; the smallest that the blocks fit when absent.
    positions : sequence of float, optional
        Other driver positions than the file's.
    ruler : float, mm, optional
        Step of the ruler with which the plans are read; the profile's when absent.
    profile : Profile
        How well the plans are drawn.
    fields : mapping, optional
        Texts of the title block that outrank the file's.
    errors : bool
        Draw the ellipses of the drafting error around the points of scheme and plans.
    sigma : bool
        Show the drafting errors of the results in their table.

    Raises
    ------
    LayoutError
        When the blocks fit no format, or not the asked one.
    """
    asked = problem.drive.positions if positions is None else tuple(positions)
    if len(asked) > MOST_POSITIONS:
        raise LayoutError(
            f"{problem.name}: sheets are drawn for at most {MOST_POSITIONS} positions, "
            f"{len(asked)} are asked. Ask fewer (--phi 0:360:30); for tables take solve --csv."
        )
    default = Views.for_problem(problem, len(asked)).paper
    extras = Extras(errors, sigma)
    papers = (paper_format(paper).name,) if paper else PAPERS[PAPERS.index(default) :]
    for name in papers:
        views = Views.for_paper(name, len(asked))
        solution = Solution(problem, positions=asked, ruler=ruler, profile=profile, views=views)
        verify(solution)
        for per_sheet in PER_SHEET if len(asked) > 1 else (1,):
            sheets = _pages(
                solution, name, per_sheet, fields or {}, extras, forced=paper is not None
            )
            if sheets is not None:
                return sheets
    scales = problem.scales
    given = any(mu is not None for mu in (scales.mu_l, scales.mu_v, scales.mu_a))
    advice = (
        "Take coarser scales in [scales], or leave them out"
        if given
        else (f"Take a larger format: one of {', '.join(PAPERS)}")
    )
    raise LayoutError(f"{problem.name}: the views do not fit {papers[-1]}. {advice}.")
