"""Graphs of any quantities over the turn, and diagrams of tabulated loads."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from math import ceil, floor, log

import numpy as np
from msgspec.structs import replace

from planmethod.construct.scale import Scale, choose_scale, next_scale
from planmethod.note.narrate.naming import point_name, scale_inscription
from planmethod.note.wording import Language
from planmethod.problem.machine_records import OUTPUT, GraphQuantity
from planmethod.problem.model import Convention
from planmethod.problem.records import Couple, Interpolation, Load, Over, SizeTable
from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Picture, Row, make_alternatives
from planmethod.render.pictures.diagram import (
    Abscissae,
    Curve,
    Diagram,
    Mark,
    Ordinates,
    diagram_picture,
)
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.views import named, shown_position
from planmethod.solved.forces.laws import GivenLoads, acting, closed, in_time, read
from planmethod.solved.forces.loads import external
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import CrankCycle
from planmethod.solved.turn.diagrams import Diagrams, diagrams_of, quantities_over, values_over

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
    given = GivenLoads(solution)
    for load in dynamics.loads:
        if not isinstance(load.size, SizeTable) or load.size.over is Over.POSITION:
            continue
        same = [one for one in external(solution, dynamics, load.link) if one.name == load.name]
        acts = any(one.force[index] if one.point else one.couple[index] for one in same)
        table = _from_zero(in_time(solution, load, load.size))
        if table.over is Over.PHI and load.phase is not None:
            table = _limited(table, acting(solution, load, 0.0, table.turn))
        at = float(given.abscissae(load, load.size)[index])
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
    symbol = "F" if isinstance(load, Load) else "M"
    picture = diagram_picture(
        Diagram(
            Abscissae(
                letter,
                tuple((tick - start) / across for tick in ticks),
                tuple(notation.as_input(tick) for tick in ticks),
                typeset(letter, style.letter).width + 5.0,
            ),
            Ordinates(f"{load.name}, {notation.units[load.unit]}", up, notation),
            [Curve("", _table_parts(table, across, up))],
            marks,
            construction=found,
        ),
        letter_height=style.letter,
        name=f"load {load.name}",
    )
    scales = [Scale(f"mu_{symbol}", up, load.unit)]
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


def _table_parts(
    table: SizeTable, x_scale: float, y_scale: float
) -> tuple[tuple[complex, ...], ...]:
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


HEIGHTS = (55.0, 70.0, 90.0, 120.0, 160.0)
"""Largest heights of the curves of a diagram, mm: the least one, and larger ones to fill space."""

PENS = (Pen.MAIN, Pen.THIN, Pen.HIDDEN, Pen.AXIS)
"""Lines of the curves of one diagram, in turn."""


def graph_groups(turn: CrankCycle, labels: Sequence[str]) -> list[list[GraphQuantity]]:
    """Return the requested quantities by diagrams: of one kind, at most one for each line type.

    Raises
    ------
    UnknownQuantityError
    """
    found: dict[str, list[GraphQuantity]] = {}
    for one in quantities_over(turn, labels):
        found.setdefault(one.family, []).append(one)
    most = len(PENS)
    return [some[k : k + most] for some in found.values() for k in range(0, len(some), most)]


def graph_picture(
    diagrams: Diagrams,
    group: Sequence[GraphQuantity],
    letter: float,
    language: Language,
    *,
    tall: float = HEIGHTS[0],
    wide: float = 1.0,
) -> tuple[Picture, Scale]:
    """Return one diagram over the angle of the crank, and its scale of ordinates.

    Its curves are at most ``tall`` mm high; its axis is ``wide`` times as long as the usual one.
    """
    turn, notation = diagrams.cycle, language.notation
    shares, drawn = diagrams.fine, diagrams.fractions
    if turn.range is not None:
        shares, drawn = shares[1:-1], drawn[:-1]
    values = [values_over(turn, one, turn.at(shares)) for one in group]
    there = np.concatenate([[0.0], *(one[np.isfinite(one)] for one in values)])
    inverse = turn.solution.problem.scales.convention is Convention.MM_PER_UNIT
    height = float(np.ptp(there)) or 1.0
    first = group[0]
    per_mm = choose_scale((0.0, height), (1.0, tall), mm_per_unit=inverse)
    scale = Scale(f"mu_{first.scale_index}", per_mm, first.unit)
    x = wide * diagrams.x(shares)
    curves: list[Curve] = []
    for one, row in zip(group, values, strict=True):
        if len(group) > 1 and not np.any(row):
            continue  # it coincides with the axis, and is listed in the heading
        parts = _unbroken_parts(x, row / per_mm)
        same = next((k for k, other in enumerate(curves) if _coincide(other.parts, parts)), None)
        if same is None:
            curves.append(Curve(one.symbol, parts, PENS[len(curves)]))
        else:
            both = f"{curves[same].symbol} = {one.symbol}"
            curves[same] = Curve(both, curves[same].parts, curves[same].pen)
    names, at = turn.numbers, wide * diagrams.x(drawn)
    numbers = tuple(str(names[k % diagrams.count]) for k in range(len(at)))
    curves = curves or [Curve(first.symbol, _unbroken_parts(x, values[0]))]
    shown = curves[0].symbol if len(curves) == 1 else first.axis_symbol
    picture = diagram_picture(
        Diagram(
            Abscissae("φ", tuple(at.tolist()), numbers),
            Ordinates(
                f"{shown}, {notation.in_head(first.unit)}" if first.unit else shown,
                per_mm,
                notation,
            ),
            curves if len(curves) > 1 else [Curve("", curves[0].parts)],
        ),
        letter_height=letter,
        name=f"graph {first.label}",
    )
    return picture, scale


def is_always_zero(diagrams: Diagrams, quantity: GraphQuantity) -> bool:
    """Return whether a quantity is always zero, such as a component along the other axis."""
    turn = diagrams.cycle
    return not np.nan_to_num(values_over(turn, quantity, turn.at(diagrams.fine))).any()


def _unbroken_parts(x: Reals, y: Reals) -> tuple[tuple[complex, ...], ...]:
    """Return a curve's unbroken parts."""
    cuts = np.flatnonzero(np.diff(np.isfinite(y).astype(int))) + 1
    runs = np.split(np.arange(len(x)), cuts)
    return tuple(
        tuple(complex(x[k], y[k]) for k in run)
        for run in runs
        if np.isfinite(y[run[0]]) and len(run) > 1
    )


def _coincide(one: Iterable[Iterable[complex]], two: Iterable[Iterable[complex]]) -> bool:
    """Return whether two curves would coincide on the drawing."""
    first, second = ([place for part in curve for place in part] for curve in (one, two))
    return len(first) == len(second) and all(
        abs(p - q) < 0.2 for p, q in zip(first, second, strict=True)
    )


def graph_labels(solution: Solution, style: BlockStyle) -> tuple[str, ...]:
    """Return the requested quantities: of the command line, the block or the file, possibly none.

    A block that selects only the output has it unless there are other requests.
    """
    task, own = solution.problem.cycle, style.entry.asked
    if not solution.problem.drive.goes_round:
        return ()
    of_file = task.graphs if task is not None else ()
    return style.options.quantities or (() if own == (OUTPUT,) else own) or of_file or own


def graphs_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the requested graphs, in one column or several; an empty block without a request.

    They may be larger: the packer takes what fills the paper.
    """
    labels = graph_labels(solution, style)
    if not labels:
        return Column([])
    diagrams = diagrams_of(solution)
    usual = diagrams.scales[-1]
    inverse = solution.problem.scales.in_mm_per_unit
    finer = coarser = usual.per_mm
    while finer > usual.per_mm / 1.5:
        finer = next_scale(finer, finer=True, mm_per_unit=inverse)
    while coarser < usual.per_mm * 1.5:
        coarser = next_scale(coarser, finer=False, mm_per_unit=inverse)
    ways: list[ViewBlock] = []
    for tall, per_mm in product(HEIGHTS, (usual.per_mm, finer, coarser)):
        ways += _arrangements(diagrams, labels, style, replace(usual, per_mm=per_mm), tall)
    # First the one that has the shape of the sheet.
    ways.sort(key=lambda way: (way.width > style.inside, abs(log(way.width / way.height / 1.4))))
    return make_alternatives(ways, grows=True)


def _arrangements(
    diagrams: Diagrams, labels: Sequence[str], style: BlockStyle, axis: Scale, tall: float
) -> Iterator[ViewBlock]:
    """Yield the graphs in one column or several, at a scale of the axis of φ and a height."""
    language, height = style.language, style.text(style.sizes.text)
    convention = diagrams.cycle.solution.problem.scales.convention
    wide = diagrams.scales[-1].per_mm / axis.per_mm
    cells: list[Block] = []
    scale = diagrams.scales[0]
    for group in graph_groups(diagrams.cycle, labels):
        picture, scale = graph_picture(
            diagrams, group, style.letter, language, tall=tall, wide=wide
        )
        name = str(language.cycle["graphs"][group[0].family])
        inscription = scale_inscription(scale, convention, language.notation)
        none = [f"{one.symbol} = 0" for one in group if is_always_zero(diagrams, one)]
        inscription = "; ".join([inscription, *(none if len(group) > 1 else ())])
        lines = [Line(typeset(text, height)) for text in (name, inscription)]
        cells.append(Column([Column(lines, gap=2.5, align="centre"), picture], gap=4.0,
                            align="centre"))  # fmt: skip
    title = Line(typeset(style.entry.title or language.cycle.graphs_title, style.title))
    said = Line(typeset(scale_inscription(axis, convention, language.notation), height))
    # With few graphs no row is left half empty.
    steps = [k for k in (1, 2, 3, 4) if len(cells) > 4 or len(cells) % k == 0]
    steps = [style.entry.per_row] if style.entry.per_row else steps
    for step in dict.fromkeys(min(k, len(cells)) for k in steps):
        rows = [Row(cells[k : k + step], gap=12.0) for k in range(0, len(cells), step)]
        head = Column([title, said], gap=2.5, align="centre")
        block = Column([head, *rows], gap=8.0, align="left")
        yield ViewBlock(block, "graphs", scale)
