"""Diagrams of tabulated loads over their independent variable (диаграммы нагрузок)."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, floor

import numpy as np
from msgspec.structs import replace

from planmethod.construct.scale import Scale, choose_scale
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.narrate.statement import point_name
from planmethod.problem.load_records import Couple, Interpolation, Load, Over, SizeTable
from planmethod.problem.model import Convention
from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column
from planmethod.render.pictures.diagram import Abscissae, Curve, Mark, Ordinates, diagram_picture
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.views import named, shown_position
from planmethod.solved.forces.loads import abscissae, acting, closed, external, in_time, read
from planmethod.solved.solution import Solution

_MAX_WIDTH, _MAX_HEIGHT = 0.5, 0.15
"""Largest width and height of a diagram, parts of the width of a column."""

_NUMBERS = 6
"""Largest number of steps between the numbers of the axis of abscissae."""


def load_curves(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the diagrams of loads over angles, coordinates and strokes, with a position's value.

    Where a load does not act, no value is marked.
    """
    dynamics, index = solution.problem.dynamics, shown_position(solution, position_indices, style)
    assert dynamics is not None
    blocks: list[Block] = []
    for number, load in enumerate(dynamics.loads):
        if not isinstance(load.size, SizeTable) or load.size.over is Over.POSITION:
            continue
        same = [one for one in external(solution, dynamics, load.link) if one.name == load.name]
        acts = any(one.force[index] if one.point else one.couple[index] for one in same)
        table = _from_zero(in_time(solution, load.size, number))
        if table.over is Over.PHI and load.phase is not None:
            table = _limited(table, acting(solution, load, 0.0, table.turn))
        at = float(abscissae(solution, load, number)[index])
        at = at % table.turn if table.over is Over.PHI else at
        blocks.append(_diagram(solution, load, table, at if acts else None, style))
    return Column(blocks, gap=8.0)


def _diagram(
    solution: Solution, load: Load | Couple, table: SizeTable, now: float | None, style: BlockStyle
) -> Block:
    notation, (letter, unit) = style.language.notation, _over(solution, load, table)
    column, start, span = style.width(style.sizes.column), table.at[0], table.at[-1] - table.at[0]
    across = choose_scale((span, 0.0), (_MAX_WIDTH * column, 1.0))
    reach = max(*table.values, 0.0) - min(*table.values, 0.0)
    up = choose_scale((0.0, reach), (1.0, _MAX_HEIGHT * column))
    step = choose_scale((span, 0.0), (_NUMBERS, 1.0))
    first, last = ceil(start / step - 1e-9), floor((start + span) / step + 1e-9)
    ticks = [step * k for k in range(first, last + 1)]
    marks: list[tuple[Mark, complex]] = []
    found: list[Item] = []
    if now is not None:
        value = float(read(table, np.array(now))) / up
        foot = min(max(now - start, 0.0), span) / across
        marks.append((Mark.RING, complex(foot, value)))
        found.append(Stroke((foot, complex(foot, value), 1j * value), Pen.THIN, tag="found"))
    symbol, newtons = ("F", "N") if isinstance(load, Load) else ("M", "N·m")
    picture = diagram_picture(
        Abscissae(
            letter,
            tuple((tick - start) / across for tick in ticks),
            tuple(notation.as_input(tick) for tick in ticks),
            typeset(letter, style.letter).width + 5.0,
        ),
        Ordinates(f"{load.name}, {notation.units[newtons]}", up, notation),
        [Curve("", _parts(table, across, up))],
        marks,
        letter_height=style.letter,
        name=f"load {load.name}",
        construction=found,
    )
    scales = [Scale(f"mu_{symbol}", up, newtons)]
    scales += [Scale(f"mu_{letter[0]}", across, unit)] if unit else []
    text = "; ".join(scale_inscription(one, Convention.UNIT_PER_MM, notation) for one in scales)
    title = style.language.sheets.load_curve.format(name=load.name)
    return named(picture, title, [text], style)


def _from_zero(table: SizeTable) -> SizeTable:
    """Return a table over a turn with rows from zero on; other tables are unchanged."""
    if table.over is not Over.PHI:
        return table
    whole, turn = closed(table), table.turn
    start = whole.at[0] % turn
    end = start + whole.at[-1] - whole.at[0]
    rows = [
        (start + at - whole.at[0], value) for at, value in zip(whole.at, whole.values, strict=True)
    ]
    if start and turn < end:
        cut = (turn, float(read(whole, np.array(turn - start + whole.at[0]))))
        rows = (
            [(cut[0] - turn, cut[1])]
            + [(at - turn, value) for at, value in rows if at > turn]
            + [row for row in rows if row[0] < turn]
            + [cut]
        )
    return replace(table, at=tuple(at for at, _ in rows), values=tuple(value for _, value in rows))


def _limited(table: SizeTable, spans: Sequence[tuple[float, float]]) -> SizeTable:
    """Return a table over the turn that is zero where its load does not act."""
    first, last = table.at[0], table.at[-1]
    rows = [(first, 0.0)]
    for start, end in spans:
        low, high = max(start, first), min(end, last)
        ends = [(one, float(read(table, np.array(one)))) for one in (low, high)]
        inside = [row for row in zip(table.at, table.values, strict=True) if low < row[0] < high]
        rows += [(low, 0.0), ends[0], *inside, ends[1], (high, 0.0)]
    rows.append((last, 0.0))
    kept = [row for k, row in enumerate(rows) if not k or row != rows[k - 1]]
    return replace(table, at=tuple(at for at, _ in kept), values=tuple(size for _, size in kept))


def _over(solution: Solution, load: Load | Couple, table: SizeTable) -> tuple[str, str]:
    """Return the letter and unit of a table's variable; no unit for a fraction of the stroke."""
    if table.over in (Over.PHI, Over.S):
        coordinate = solution.problem.drive.coordinate
        return coordinate.symbol, coordinate.unit
    assert isinstance(load, Load), "a couple has no point"
    point = point_name(load.at)
    if table.over in (Over.X, Over.Y):
        return f"{table.over.value}_{{{point}}}", "m"
    return f"s_{{{point}}}/H", ""


def _parts(table: SizeTable, x_scale: float, y_scale: float) -> tuple[tuple[complex, ...], ...]:
    """Return the unbroken parts of a curve, mm: it ends where the table jumps."""
    rows = list(zip(table.at, table.values, strict=True))
    if table.interpolation is Interpolation.STEP:
        ends = [*table.at[1:], table.at[-1]]
        broken = [[(at, value), (end, value)] for (at, value), end in zip(rows, ends, strict=True)]
    else:
        broken = [[]]
        for row in rows:
            if broken[-1] and broken[-1][-1][0] == row[0]:
                broken.append([])
            broken[-1].append(row)
    return tuple(
        tuple(complex((at - table.at[0]) / x_scale, value / y_scale) for at, value in part)
        for part in broken
        if len(part) > 1
    )
