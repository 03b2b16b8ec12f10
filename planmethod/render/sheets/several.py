"""Views of several positions: schemes over one another, plans in rows, each with its number."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from planmethod.note.narrate.cycle import extremes_named
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.narrate.statement import point_name
from planmethod.note.numbers import with_unit
from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Row, Spacer
from planmethod.render.pictures.paths import Paths
from planmethod.render.pictures.positions import PRIMES, shows_extremes
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.render.pictures.seriesview import series_picture
from planmethod.render.pictures.traces import shown_traces
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import position_text
from planmethod.render.sheets.views import (
    plan_with_details,
    plans_viewed,
    shown_position,
    with_scale,
)
from planmethod.solved.scaling import BETWEEN, column_widths, per_row
from planmethod.solved.sheet_estimate import FEW
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import crank_cycle_of

CAPTION = 3.5
"""Height of the letters of one of many plans, and of its caption, mm."""


def scheme_view(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> ViewBlock:
    """Return the scheme of many positions: one in full, the others thin."""
    bold, kind = shown_position(solution, position_indices, style), PlanKind.POSITION
    letter, errors = style.letter, style.options.errors
    traces = shown_traces(solution, style.entry.traces, has_space=style.options.traces)
    if len(position_indices) > 1:
        picture = series_picture(
            solution,
            bold,
            tuple(position_indices),
            letter_height=letter,
            errors=errors,
            turn=style.options.turn,
            traces=traces,
        )
    else:
        picture = scheme_picture(solution, bold, letter_height=letter, errors=errors, traces=traces)
    said = _extremes(solution, position_indices, style)
    block = with_scale(solution, kind, picture, style, position_indices, said)
    return ViewBlock(block, kind.value, solution.scales[kind])


def _extremes(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> list[str]:
    """Return the notes on the extreme positions of a scheme that shows both."""
    if not shows_extremes(solution, position_indices):
        return []
    paths = Paths(solution)
    if paths.output is None or len(paths.extremes) < len(PRIMES):
        return []
    letter = point_name(paths.output[1])
    names = ", ".join(f"{letter}{prime}" for prime in PRIMES)
    whole = paths.driver_path.closed and solution.problem.drive.revolves and not style.options.turn
    return extremes_named(crank_cycle_of(solution) if whole else None, names, style.language)


def plan_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the plans of several positions in rows, drawn like those of one."""
    kind = style.entry.of
    assert kind is not None
    if style.entry.position is not None:
        position_indices = (style.entry.position,)
    step, language = style.entry.per_row, style.language
    alike = _group_repeated(solution, position_indices)
    shown, errors = tuple(alike), style.options.errors
    pictures = plan_grid(solution, kind, shown, language, in_row=step, errors=errors, repeats=alike)
    return plans_viewed(solution, pictures, shown, style)


def _group_repeated(solution: Solution, position_indices: Sequence[int]) -> dict[int, list[int]]:
    """Return positions with those of the cycle's second turn at the same crank angle."""
    found: dict[float, list[int]] = {}
    two = solution.repeated > 1 and solution.problem.drive.goes_round
    for i in position_indices:
        place = round(float(solution.positions[i]) % 360.0, 6) % 360.0 if two else float(i)
        found.setdefault(place, []).append(i)
    return {numbers[0]: numbers for numbers in found.values()}


def plan_grid(
    solution: Solution,
    kind: PlanKind,
    position_indices: Sequence[int],
    language: Language,
    *,
    in_row: int | None = None,
    errors: bool = False,
    repeats: Mapping[int, Sequence[int]] = MappingProxyType({}),
) -> list[Block]:
    """Return the plans of many positions in rows and columns, each with its number.

    There is a layout for each number of plans in a row, the usual one first; ``in_row`` selects
    one. ``repeats`` are the numbers of all positions that share the plan of one.
    """
    coordinate, notation = solution.problem.drive.coordinate, language.notation
    cells: list[Block] = []
    common = solution.has_common(kind)
    convention = solution.problem.scales.convention
    for i in position_indices:
        own_numbers, unit = repeats.get(i, (i,)), notation.units[coordinate.unit]
        places = dict.fromkeys(position_text(solution, k, notation) for k in own_numbers)
        values = ", ".join(with_unit(place, unit) for place in places)
        phrase = f"{', '.join(map(str, own_numbers))}: {coordinate.symbol} = {values}"
        own = solution.plan_scale(kind, i)
        caption: Block = Line(typeset(phrase, CAPTION))
        if own != solution.scales[kind] or not common:
            scale = Line(typeset(scale_inscription(own, convention, notation), CAPTION))
            caption = Column([caption, scale], gap=2.0, align="centre")
        picture = plan_with_details(
            solution, kind, i, language, letter_height=CAPTION, errors=errors
        )[0]
        cells.append(Column([picture, caption], gap=3.0, align="centre"))
    count, usual = len(cells), in_row or per_row(len(cells))
    steps = (usual,) if in_row else (usual, 4, 3, 2, 1) if count <= FEW else (usual, 4, 3)
    return [_rows(cells, step) for step in dict.fromkeys(min(step, count) for step in steps)]


def _rows(cells: Sequence[Block], step: int) -> Block:
    """Return blocks in rows of ``step``, in columns if these are not much wider."""
    columns = column_widths([cell.width for cell in cells], step)
    if columns:
        wide = [Spacer(width, 0.0) for width in columns]
        cells = [Column([c, wide[k % step]], 0.0, "centre") for k, c in enumerate(cells)]
    found = range(0, len(cells), step)
    return Column([Row(cells[k : k + step], gap=BETWEEN, align="bottom") for k in found], BETWEEN)
