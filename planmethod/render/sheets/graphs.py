"""Graphs of any quantities over the turn, several curves on a diagram (графики за цикл)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from math import log

import numpy as np
from msgspec.structs import replace

from planmethod.construct.scale import Scale, choose_scale, next_scale
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.wording import Language
from planmethod.problem.graphs import OUTPUT, GraphQuantity
from planmethod.problem.model import Convention
from planmethod.render.ink.drawing import Pen
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Picture, Row, make_alternatives
from planmethod.render.pictures.diagram import Abscissae, Curve, Ordinates, diagram_picture
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import CrankCycle
from planmethod.solved.turn.diagrams import Diagrams, diagrams_of
from planmethod.solved.turn.series import quantities_over, values_over

HEIGHTS = (55.0, 70.0, 90.0, 120.0, 160.0)
"""Largest heights of the curves of a diagram, mm: the least one, and larger ones to fill space."""

PENS = (Pen.MAIN, Pen.THIN, Pen.HIDDEN, Pen.AXIS)
"""Lines of the curves of one diagram, in turn."""

LETTERS = {"x": "x, y", "phi": "φ", "v_q": "v_{q}", "u": "u", "a_q": "a_{q}", "epsilon_q": "ε_{q}",
           "v": "v", "omega": "ω", "a": "a", "epsilon": "ε"}  # fmt: skip
"""Name of the axis of a diagram with several curves."""

ZERO_TOLERANCE = 1e-12
"""Largest rounding error of a zero value, SI."""

MARKS = {"x": "l", "u": "u", "omega": "ω", "epsilon": "ε", "phi": "φ_{i}", "v_q": "vq", "a_q": "aq",
         "epsilon_q": "εq"}  # fmt: skip
"""Indices of the scales by the quantity of a diagram, where they are not its letter."""


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
    values = [_clean(values_over(turn, one, turn.at(shares))) for one in group]
    there = np.concatenate([[0.0], *(one[np.isfinite(one)] for one in values)])
    inverse = turn.solution.problem.scales.convention is Convention.MM_PER_UNIT
    height = float(np.ptp(there)) or 1.0
    first = group[0]
    per_mm = choose_scale((0.0, height), (1.0, tall), mm_per_unit=inverse)
    scale = Scale(f"mu_{MARKS.get(first.family, first.family)}", per_mm, first.unit)
    x = wide * diagrams.x(shares)
    curves: list[Curve] = []
    for one, row in zip(group, values, strict=True):
        if len(group) > 1 and not np.any(row):
            continue  # it coincides with the axis, and is listed in the heading
        parts = _parts(x, row / per_mm)
        same = next((k for k, other in enumerate(curves) if _coincide(other.parts, parts)), None)
        if same is None:
            curves.append(Curve(one.symbol, parts, PENS[len(curves)]))
        else:
            both = f"{curves[same].symbol} = {one.symbol}"
            curves[same] = Curve(both, curves[same].parts, curves[same].pen)
    names, at = turn.numbers, wide * diagrams.x(drawn)
    numbers = tuple(str(names[k % diagrams.count]) for k in range(len(at)))
    curves = curves or [Curve(first.symbol, _parts(x, values[0]))]
    shown = curves[0].symbol if len(curves) == 1 else LETTERS[first.family]
    picture = diagram_picture(
        Abscissae("φ", tuple(at.tolist()), numbers),
        Ordinates(
            f"{shown}, {notation.in_head(first.unit)}" if first.unit else shown, per_mm, notation
        ),
        curves if len(curves) > 1 else [Curve("", curves[0].parts)],
        letter_height=letter,
        name=f"graph {first.label}",
    )
    return picture, scale


def is_always_zero(diagrams: Diagrams, quantity: GraphQuantity) -> bool:
    """Return whether a quantity is always zero, such as a component along the other axis."""
    turn = diagrams.cycle
    size = np.abs(values_over(turn, quantity, turn.at(diagrams.fine)))
    return bool(np.nanmax(size, initial=0.0) <= ZERO_TOLERANCE)


def _clean(values: Reals) -> Reals:
    """Return values without the rounding noise about zero."""
    return np.where(np.abs(values) <= ZERO_TOLERANCE, 0.0, values)


def _parts(x: Reals, y: Reals) -> tuple[tuple[complex, ...], ...]:
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
