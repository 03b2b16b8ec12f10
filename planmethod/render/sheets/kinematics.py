"""Sheet of the kinematic analysis: scheme, velocity and acceleration plans, equations, tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from planmethod.construct.scale import Scale
from planmethod.errors import LayoutError
from planmethod.note.calculation import calculation
from planmethod.note.given import asked_links, asked_points, given, number, wanted
from planmethod.note.numbers import UNITS_RU, russian, significant
from planmethod.plans.model import PlanKind
from planmethod.plans.scaling import Views
from planmethod.plans.solution import Reals, Solution
from planmethod.problem.model import Convention, Problem
from planmethod.render.block import Block, Column, Line, Row, heading, paragraph
from planmethod.render.drawing import Drawing
from planmethod.render.equations import equation_block, formula_block
from planmethod.render.frame import paper_format, sheet_frame
from planmethod.render.pack import pack
from planmethod.render.planview import plan_picture
from planmethod.render.scheme import scheme_picture
from planmethod.render.tables import Cell, TableColumn, table_block
from planmethod.render.typeset import typeset

PER_SHEET = 12
"""Most positions on one sheet; more go on further sheets."""

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


HEIGHTS = {
    "A4": Heights(3.5, 3.5, 2.5),
    "A3": Heights(3.5, 5.0, 3.5),
    "A2": Heights(5.0, 5.0, 3.5),
    "A1": Heights(5.0, 7.0, 5.0),
    "A0": Heights(5.0, 7.0, 5.0),
}

NBSP = "\u00a0"

COLUMN_WIDTHS = {"A4": 170.0, "A3": 125.0, "A2": 180.0, "A1": 250.0, "A0": 280.0}
"""Width that texts and equations are set to, mm."""


def scale_inscription(scale: Scale, convention: Convention) -> str:
    """Return the inscription under a view: ``μ_v = 0,05 (м/с)/мм`` or ``μ_v = 20 мм/(м/с)``."""
    letter = scale.symbol.removeprefix("mu_")
    unit = UNITS_RU[scale.unit]
    grouped = f"({unit})" if "/" in unit else unit
    if convention is Convention.MM_PER_UNIT:
        return f"μ_{{{letter}}} = {number(1.0 / scale.per_mm)} мм/{grouped}"
    return f"μ_{{{letter}}} = {number(scale.per_mm)} {grouped}/мм"


def _view(solution: Solution, kind: PlanKind, picture: Block, size: Heights, title: str) -> Block:
    convention = solution.problem.scales.convention
    inscription = scale_inscription(solution.scales[kind], convention)
    return Column(
        [
            picture,
            Column(
                [
                    Line(typeset(title, size.title), underline=True),
                    Line(typeset(inscription, size.text)),
                ],
                gap=2.5,
                align="centre",
            ),
        ],
        gap=5.0,
        align="centre",
    )


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


def _calculation(solution: Solution, kind: PlanKind, index: int, size: Heights) -> Block:
    """Return the formulas with the read segments."""
    height = max(2.5, min(3.5, size.text))
    lines = calculation(solution, kind, index)
    title = "Расчёт скоростей" if kind is PlanKind.VELOCITY else "Расчёт ускорений"
    return Column([heading(title, size.text), *(formula_block(x, height) for x in lines)], gap=2.2)


def _sense(value: float) -> int:
    return 0 if value == 0 else (1 if value > 0 else -1)


def result_columns(solution: Solution, indices: Sequence[int]) -> list[TableColumn]:
    """Return the columns of the result table: v, ω, a, ε with values and senses."""

    def values(numbers: Reals, *, sense: bool) -> tuple[Cell, ...]:
        return tuple(
            Cell(
                russian(significant(abs(float(numbers[i])))),
                _sense(float(numbers[i])) if sense else None,
            )
            for i in indices
        )

    points, links = asked_points(solution), asked_links(solution)
    columns = []
    for name in points:
        v = np.abs(solution.points[name].velocity)
        columns.append(TableColumn(f"v_{{{name}}}", values(v, sense=False), unit=UNITS_RU["m/s"]))
    for link in links:
        omega = solution.links[link].omega
        columns.append(
            TableColumn(f"ω_{{{link}}}", values(omega, sense=True), unit=UNITS_RU["1/s"])
        )
    for name in points:
        a = np.abs(solution.points[name].acceleration)
        columns.append(TableColumn(f"a_{{{name}}}", values(a, sense=False), unit=UNITS_RU["m/s²"]))
    for link in links:
        epsilon = solution.links[link].epsilon
        columns.append(
            TableColumn(f"ε_{{{link}}}", values(epsilon, sense=True), unit=UNITS_RU["1/s²"])
        )
    if len(solution.positions) > 1:
        drive = solution.problem.drive
        symbol, unit = (f"φ_{{{drive.link}}}", "°") if drive.is_crank else ("s", "м")
        asked = tuple(Cell(number(float(solution.positions[i]))) for i in indices)
        columns.insert(0, TableColumn(symbol, asked, unit=unit))
        columns.insert(0, TableColumn("№", tuple(Cell(str(i)) for i in indices), least=8.0))
    return columns


def _grid(solution: Solution, kind: PlanKind, indices: Sequence[int], size: Heights) -> Block:
    """Return the plans of many positions in rows, each with its number."""
    drive = solution.problem.drive
    cells: list[Block] = []
    for i in indices:
        value = number(float(solution.positions[i]))
        said = f"φ_{{{drive.link}}} = {value}°" if drive.is_crank else f"s = {value} м"
        caption = Line(typeset(f"{i}: {said}", 3.5))
        picture = plan_picture(solution, kind, i, letter_height=3.5)
        cells.append(Column([picture, caption], gap=3.0, align="centre"))
    per_row = {2: 2, 3: 3, 4: 4}.get(len(cells), 6 if len(cells) > 5 else 5)
    rows = [
        Row(cells[k : k + per_row], gap=6.0, align="bottom") for k in range(0, len(cells), per_row)
    ]
    return _view(solution, kind, Column(rows, gap=6.0), size, MANY_TITLES[kind])


def _blocks(
    solution: Solution, indices: Sequence[int], paper: str, inside: float, *, full: bool
) -> list[Block]:
    """Return the blocks of a sheet in reading order; with ``full`` also the formulas."""
    size = HEIGHTS.get(paper, HEIGHTS["A1"])
    column = COLUMN_WIDTHS.get(paper, 180.0)
    result = table_block(
        result_columns(solution, indices),
        size.text if len(indices) == 1 else min(size.text, 3.5),
        max_width=max(185.0, 0.58 * inside),
        leading=2 if len(solution.positions) > 1 else 0,
        title="Результаты",
    )
    statement = _statement(solution, size, column)
    v, a = PlanKind.VELOCITY, PlanKind.ACCELERATION
    if len(solution.positions) == 1:
        scheme = scheme_picture(solution, indices[0], letter_height=size.letter)
        plans = {
            kind: _view(
                solution,
                kind,
                plan_picture(solution, kind, indices[0], letter_height=size.letter),
                size,
                TITLES[kind],
            )
            for kind in (v, a)
        }
        return [
            _view(solution, PlanKind.POSITION, scheme, size, TITLES[PlanKind.POSITION]),
            statement,
            plans[v],
            _equations(solution, v, size, column),
            *([_calculation(solution, v, indices[0], size)] if full else []),
            _equations(solution, a, size, column),
            plans[a],
            *([_calculation(solution, a, indices[0], size)] if full else []),
            result,
        ]
    scheme = scheme_picture(solution, indices[0], letter_height=size.letter, overlay=True)
    return [
        _view(solution, PlanKind.POSITION, scheme, size, MANY_TITLES[PlanKind.POSITION]),
        statement,
        _equations(solution, v, size, column),
        _equations(solution, a, size, column),
        _grid(solution, v, indices, size),
        _grid(solution, a, indices, size),
        result,
    ]


def stamp_fields(
    problem: Problem, sheet: int, sheets: int, extra: Mapping[str, str]
) -> dict[str, str]:
    """Return the texts of the title block: the defaults, the problem's, then the asked ones."""
    fields = {"title": problem.title, "sheet": str(sheet), "sheets": str(sheets)}
    fields.update(problem.stamp)
    fields.update(extra)
    return {key: value for key, value in fields.items() if value}


def _compose(
    solution: Solution, indices: Sequence[int], paper: str, fields: Mapping[str, str]
) -> Drawing | None:
    fmt = paper_format(paper)
    items, inner, stamp = sheet_frame(fmt, fields)
    inside = inner[2] - inner[0]
    packed = pack(_blocks(solution, indices, paper, inside, full=True), inner, stamp)
    if packed is None:
        packed = pack(_blocks(solution, indices, paper, inside, full=False), inner, stamp)
    if packed is None:
        return None
    drawing = Drawing(fmt.width, fmt.height, fields.get("title", solution.problem.title))
    drawing.extend(items)
    drawing.extend(packed)
    return drawing


def kinematics_sheets(
    problem: Problem,
    *,
    paper: str | None = None,
    positions: Sequence[float] | None = None,
    ruler: float = 0.5,
    fields: Mapping[str, str] | None = None,
) -> list[Drawing]:
    """Draw the kinematic analysis: one sheet for each dozen of positions.

    Parameters
    ----------
    paper : str, optional
        Format; the smallest that the blocks fit when absent.
    positions : sequence of float, optional
        Other driver positions than the file's.
    fields : mapping, optional
        Texts of the title block that outrank the file's.

    Raises
    ------
    LayoutError
        When the blocks fit no format, or not the asked one.
    """
    asked = problem.drive.positions if positions is None else tuple(positions)
    count = len(asked)
    pages = [range(k, min(k + PER_SHEET, count)) for k in range(0, count, PER_SHEET)]
    default = Views.for_problem(problem, count).paper
    papers = (paper,) if paper else PAPERS[PAPERS.index(default) :]
    for name in papers:
        views = Views.for_paper(paper_format(name).name, count)
        solution = Solution(problem, positions=asked, ruler=ruler, views=views)
        sheets = []
        for page, indices in enumerate(pages, 1):
            texts = stamp_fields(problem, page, len(pages), fields or {})
            sheet = _compose(solution, indices, paper_format(name).name, texts)
            if sheet is None:
                break
            sheets.append(sheet)
        else:
            return sheets
    raise LayoutError(
        f"{problem.name}: the views do not fit {papers[-1]} with the scales of the file. "
        "Take coarser scales in [scales], or leave them out."
    )
