"""Views of several positions: schemes over one another, plans in rows, each with its number."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from planmethod.note.narrate.given import point_name
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.narrate.turn import extremes_named
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
from planmethod.render.sheets.composer import Viewed
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.results import position_text
from planmethod.render.sheets.views import (
    plan_with_knots,
    plans_viewed,
    shown_position,
    with_scale,
)
from planmethod.solved.room import FEW
from planmethod.solved.scaling import BETWEEN, even_columns, per_row
from planmethod.solved.solution import Solution
from planmethod.solved.turn.turn import turn_of

CAPTION = 3.5
"""Height of the letters of one of many plans, and of its caption, mm."""


def scheme_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Viewed:
    """Return the scheme of many positions: one in full, the others thin."""
    bold, kind = shown_position(solution, indices, manner), PlanKind.POSITION
    letter, errors = manner.letter, manner.extras.errors
    traces = shown_traces(solution, manner.entry.traces, room=manner.extras.traces)
    if len(indices) > 1:
        picture = series_picture(
            solution,
            bold,
            tuple(indices),
            letter_height=letter,
            errors=errors,
            turn=manner.extras.turn,
            traces=traces,
        )
    else:
        picture = scheme_picture(solution, bold, letter_height=letter, errors=errors, traces=traces)
    said = _extremes(solution, indices, manner)
    block = with_scale(solution, kind, picture, manner, indices, said)
    return Viewed(block, kind.value, solution.scales[kind])


def _extremes(solution: Solution, indices: Sequence[int], manner: Manner) -> list[str]:
    """Return the notes on the extreme positions of a scheme that shows both."""
    if not shows_extremes(solution, indices):
        return []
    paths = Paths(solution)
    if paths.output is None or len(paths.extremes) < len(PRIMES):
        return []
    letter = point_name(paths.output[1])
    names = ", ".join(f"{letter}{prime}" for prime in PRIMES)
    whole = paths.course.closed and solution.problem.drive.revolves and not manner.extras.turn
    return extremes_named(turn_of(solution) if whole else None, names, manner.words)


def plan_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the plans of several positions in rows, drawn like those of one."""
    kind = manner.entry.of
    assert kind is not None
    if manner.entry.position is not None:
        indices = (manner.entry.position,)
    step, words = manner.entry.per_row, manner.words
    alike = _alike(solution, indices)
    shown, errors = tuple(alike), manner.extras.errors
    pictures = plan_grid(solution, kind, shown, words, in_row=step, errors=errors, alike=alike)
    return plans_viewed(solution, pictures, shown, manner)


def _alike(solution: Solution, indices: Sequence[int]) -> dict[int, list[int]]:
    """Return positions with those of the cycle's second turn at the same crank angle."""
    found: dict[float, list[int]] = {}
    two = solution.repeated > 1 and solution.problem.drive.goes_round
    for i in indices:
        place = round(float(solution.positions[i]) % 360.0, 6) % 360.0 if two else float(i)
        found.setdefault(place, []).append(i)
    return {numbers[0]: numbers for numbers in found.values()}


def plan_grid(
    solution: Solution,
    kind: PlanKind,
    indices: Sequence[int],
    words: Language,
    *,
    in_row: int | None = None,
    errors: bool = False,
    alike: Mapping[int, Sequence[int]] = MappingProxyType({}),
) -> list[Block]:
    """Return the plans of many positions in rows and columns, each with its number.

    There is a layout for each number of plans in a row, the usual one first; ``in_row`` selects
    one. ``alike`` are the numbers of all positions that share the plan of one.
    """
    coordinate, say = solution.problem.drive.coordinate, words.say
    cells: list[Block] = []
    common = solution.has_common(kind)
    convention = solution.problem.scales.convention
    for i in indices:
        own_numbers, unit = alike.get(i, (i,)), say.units[coordinate.unit]
        places = dict.fromkeys(position_text(solution, k, say) for k in own_numbers)
        values = ", ".join(with_unit(place, unit) for place in places)
        said = f"{', '.join(map(str, own_numbers))}: {coordinate.symbol} = {values}"
        own = solution.own_scale(kind, i)
        caption: Block = Line(typeset(said, CAPTION))
        if own != solution.scales[kind] or not common:
            scale = Line(typeset(scale_inscription(own, convention, say), CAPTION))
            caption = Column([caption, scale], gap=2.0, align="centre")
        picture = plan_with_knots(solution, kind, i, words, letter_height=CAPTION, errors=errors)[0]
        cells.append(Column([picture, caption], gap=3.0, align="centre"))
    count, usual = len(cells), in_row or per_row(len(cells))
    steps = (usual,) if in_row else (usual, 4, 3, 2, 1) if count <= FEW else (usual, 4, 3)
    return [_rows(cells, step) for step in dict.fromkeys(min(step, count) for step in steps)]


def _rows(cells: Sequence[Block], step: int) -> Block:
    """Return blocks in rows of ``step``, in columns if these are not much wider."""
    columns = even_columns([cell.width for cell in cells], step)
    if columns:
        wide = [Spacer(width, 0.0) for width in columns]
        cells = [Column([c, wide[k % step]], 0.0, "centre") for k, c in enumerate(cells)]
    found = range(0, len(cells), step)
    return Column([Row(cells[k : k + step], gap=BETWEEN, align="bottom") for k in found], BETWEEN)
