"""Sheet of the kinematic analysis: scheme, velocity and acceleration plans, equations, tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from planmethod.construct.drafting import PROFILES, Profile
from planmethod.errors import LayoutError
from planmethod.plans.model import PlanKind
from planmethod.plans.scaling import AS_HIGH, Views
from planmethod.plans.selfcheck import verify
from planmethod.plans.solution import Solution
from planmethod.problem.model import Problem
from planmethod.render.block import Block
from planmethod.render.drawing import Drawing
from planmethod.render.frame import paper_format, sheet_frame
from planmethod.render.pack import EDGE
from planmethod.render.planview import plan_picture
from planmethod.render.schemeview import scheme_picture
from planmethod.render.sheets.pages import Page, divided, stamp_fields
from planmethod.render.sheets.results import results_block
from planmethod.render.sheets.texts import calculation_block, equations_block, statement_block
from planmethod.render.sheets.views import (
    MANY_TITLES,
    TITLES,
    Heights,
    named_view,
    plan_grid,
)

PER_SHEET = (12, 6, 4, 2, 1)
"""Positions on one sheet: as many as fit; the others go on further sheets."""

MOST_POSITIONS = 120
"""Most positions drawn in one call: ten sheets of a dozen plans."""

PAPERS = ("A3", "A2", "A1", "A0")
"""Formats tried in turn when none is asked for."""


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

COLUMN_WIDTHS = {"A4": 82.0, "A3": 125.0, "A2": 180.0, "A1": 250.0, "A0": 280.0}
"""Width that texts and equations are set to, mm."""


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
    result = results_block(
        solution,
        indices,
        size.text if len(indices) == 1 else min(size.text, 3.5),
        min(max(185.0, 0.58 * inside), inside - 2 * EDGE),
        sigma=extras.sigma,
    )
    statement = statement_block(solution, size, column)
    v, a = PlanKind.VELOCITY, PlanKind.ACCELERATION
    if len(solution.positions) == 1:
        errors, ellipses = extras.errors, tuple(indices) if extras.errors else ()
        scheme = scheme_picture(solution, indices[0], letter_height=size.letter, errors=errors)
        plans = {
            kind: named_view(
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
            named_view(
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
            equations_block(solution, v, size, column),
            *([calculation_block(solution, v, indices[0], formulas)] if formulas else []),
            plans[a],
            equations_block(solution, a, size, column),
            *([calculation_block(solution, a, indices[0], formulas)] if formulas else []),
            result,
        ]
    # The bold position is the one furthest from a dead position.
    bold = max(indices, key=lambda i: float(solution.margin[i]))
    scheme = scheme_picture(
        solution, bold, letter_height=size.letter, overlay=tuple(indices), errors=extras.errors
    )
    title, ellipses = MANY_TITLES[PlanKind.POSITION], (bold,) if extras.errors else ()
    return [
        named_view(solution, PlanKind.POSITION, scheme, size, title, indices, ellipses),
        statement,
        equations_block(solution, v, size, column),
        equations_block(solution, a, size, column),
        plan_grid(solution, v, indices, size, errors=extras.errors),
        plan_grid(solution, a, indices, size, errors=extras.errors),
        result,
    ]


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
        parts = divided(blocks, count, fmt.inner, fmt.stamp)
        if parts is not None:
            return parts
    return None


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
