"""Blocks of the turn of a crank: diagrams, hodographs, tables, transfer functions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec import Struct

from planmethod.construct.scale import Scale, choose_scale
from planmethod.mechanism.model import FRAME
from planmethod.note.document import Caption, Formula
from planmethod.note.narrate.cycle import (
    cycle_facts,
    diagram_scales,
    drawn_notes,
    output_name,
)
from planmethod.note.narrate.naming import Formulas, Names, point_name, scale_inscription
from planmethod.note.narrate.statement import given_facts
from planmethod.note.narrate.transfers import TransferNarrator
from planmethod.note.numbers import half_up
from planmethod.note.tables.cycle import Columns, cycle_columns, deviation_columns, deviations_title
from planmethod.note.tables.errors import transfer_series
from planmethod.plans.model import FACTS, PlanKind
from planmethod.problem.model import Convention
from planmethod.render.frame import STAMP_WIDTH
from planmethod.render.layout.block import (
    Alternatives,
    Block,
    Column,
    Picture,
    Row,
    make_alternatives,
    paragraph,
)
from planmethod.render.layout.text_blocks import TableColumn, TableForm, blocks_of, table_block
from planmethod.render.pictures.diagram import polar_picture
from planmethod.render.pictures.kinematic import kinematic_picture
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import columns_of, table_width, with_note
from planmethod.render.sheets.views import (
    LARGER,
    PlanViewBlock,
    at_scales,
    named,
    plan_grid,
    shown_position,
    stated,
)
from planmethod.solved.cycle_forces import without_corners
from planmethod.solved.quantities import transfers_of
from planmethod.solved.reading import Complexes, Reals, memoized
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import TURN, CrankCycle, crank_cycle_of
from planmethod.solved.turn.diagrams import diagrams_of

SIDE = 0.5
"""Side of a hodograph as a part of the width of a text."""

MAX_SIDE = 150.0
"""Largest side of a hodograph of a project at the scale of its plans, mm."""

SMALL = 0.6
"""Share of `MAX_SIDE` below which it is drawn larger than the plans, at a scale of its own."""

_NARROW = 0.05  # width over length below which a hodograph counts as a straight line


def turn_statement(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return "Дано", "Определить" and the facts found for the turn."""
    language = style.language
    facts = given_facts(solution.problem, language, [float(crank_cycle_of(solution).zero)])
    found = "; ".join(cycle_facts(crank_cycle_of(solution), language)) + "."
    return stated(facts[1:], language.cycle.wanted, style, found)


def _output_text(turn: CrankCycle, style: BlockStyle) -> str:
    output = turn.output
    phrase: str = style.language.cycle["of"][output.unit]
    return phrase.format(name=output_name(output))


def diagrams_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the diagrams of s, v and a under one another."""
    diagrams, language = diagrams_of(solution), style.language
    picture = kinematic_picture(diagrams, style.letter, language.notation)
    title = language.cycle.diagrams.format(of=_output_text(diagrams.cycle, style))
    scales = diagram_scales(diagrams, language)
    notation = language.notation
    k = [
        f"K_{{{number}}} = {notation.as_input(half_up(pole, 2))} {notation.units['mm']}"
        for number, pole in enumerate(diagrams.poles, 1)
    ]
    lines = ["; ".join([*scales, *k]), *drawn_notes(diagrams, language)]
    block = named(picture, style.entry.title or title, lines, style)
    return ViewBlock(block, "diagram", diagrams.scales[0])


def chosen_plans(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the plans of the positions that the block names.

    Default: of as many as fit, evenly from 0 on; or of two, one of either stroke: after a sixth and
    two thirds of a turn.
    """
    kind, language = style.entry.of, style.language
    assert kind is not None
    every = len(solution.positions) // solution.repeated  # the second turn repeats the first
    two = dict.fromkeys((round(every / 6), round(2 * every / 3) % every))
    count = style.options.plans
    even = range(0, every, -(-every // count)) if count else two
    chosen = style.entry.positions or tuple(even)
    positions = {index: (index,) for index in chosen}
    pictures = plan_grid(solution, kind, positions, language, in_row=style.entry.per_row)
    if not count:  # the usual layout only: they grow, and must not displace the others
        pictures = pictures[:1]
    names, scale = language.sheets["views"][kind.value], solution.scales[kind]
    title = style.entry.title or names[len(chosen) > 1]
    phrase = scale_inscription(scale, solution.problem.scales.convention, language.notation)
    if len(chosen) < every:
        shown = ", ".join(map(str, chosen))
        phrase = f"{phrase}; {language.cycle.chosen.format(shown=shown, last=every - 1)}"
    blocks = [named(picture, title, [phrase], style) for picture in pictures]
    return make_alternatives(
        PlanViewBlock(block, kind.value, scale, solution, kind, chosen, use_ruler=True)
        for block in blocks
    )


# Hodographs --------------------------------------------------------------------------------------


def hodograph_point(turn: CrankCycle) -> str | None:
    """Return the point of the hodograph: a centre of mass not moving in a straight line.

    Otherwise another such point; None if all of them move along lines.
    """
    bodies, drive = turn.unit.problem.bodies, turn.unit.problem.drive.link
    own = [p for link in bodies if link not in (FRAME, drive) for p in bodies[link].points]
    plan = turn.unit.construction.kinematics.velocity
    reading = turn.read(turn.positions)
    wide = []
    for point in dict.fromkeys(own):
        if point in bodies[FRAME].points or point in bodies[drive].points:
            continue
        v = reading.point(plan.point[plan.named[point]])
        v = v[np.isfinite(v)]
        far = v[int(np.argmax(np.abs(v)))] if v.size else 0j
        if abs(far) and np.ptp((v * np.conj(far)).imag) > _NARROW * abs(far) ** 2:
            wide.append(point)
    return next((p for p in wide if p.startswith("S")), wide[0] if wide else None)


class Hodograph(Struct, frozen=True):
    """Hodograph of a point about one pole, in millimetres (годограф).

    ``parts`` are the unbroken parts of the curve, ``ends`` those of the vectors in the positions.
    """

    kind: PlanKind
    point: str
    scale: Scale
    parts: tuple[Complexes, ...]
    ends: Complexes

    def picture(self, letter: float) -> Picture:
        """Return it with letters of a height, mm."""
        name = f"{self.kind.value} {self.point}"
        return polar_picture(self.parts, self.ends, letter, name, FACTS[self.kind].pole)


@memoized
def _hodograph_of(solution: Solution, kind: PlanKind) -> tuple[str, Complexes, Complexes]:
    """Return the point, its curve, and the ends of its vectors in the positions; m/s or m/s²."""
    turn = crank_cycle_of(solution)
    point = hodograph_point(turn) or turn.output.point
    drive, kinematics = solution.problem.drive, turn.unit.construction.kinematics

    def vectors(positions: Reals) -> Complexes:
        reading = turn.read(positions)
        v, a = (
            reading.point(motion.point[motion.named[point]])
            for motion in (kinematics.velocity, kinematics.acceleration)
        )
        if kind is PlanKind.VELOCITY:
            return np.asarray(v * drive.rate, dtype=complex)
        return np.asarray(a * drive.rate**2 + v * drive.acceleration, dtype=complex)

    first, last = float(turn.positions[0]), float(turn.positions[-1])
    last = last if turn.range is not None else first + turn.sense * turn.period
    count = 360 * round(turn.period / TURN) + 1
    even, ends = np.linspace(first, last, count), vectors(turn.positions)
    (curve,) = without_corners(even, vectors(even)[np.newaxis], vectors)[1]
    return point, curve, ends


def hodograph(solution: Solution, kind: PlanKind, side: float) -> Hodograph:
    """Return the hodograph of velocities or accelerations that fills a square, its side in mm.

    In a project it has the scale of the plans, as a plan of all positions about one pole, unless it
    would be larger than `MAX_SIDE` or much smaller: then it fills a square of that side, whatever
    ``side`` is.
    """
    point, curve, ends = _hodograph_of(solution.origin, kind)
    there = np.concatenate([[0j], curve[np.isfinite(curve)], ends[np.isfinite(ends)]])
    size = (float(np.ptp(there.real)), float(np.ptp(there.imag)))
    inverse = solution.problem.scales.convention is Convention.MM_PER_UNIT
    facts = FACTS[kind]
    decided, common = solution.problem.scales.decided, solution.scales[kind]
    side = MAX_SIDE if decided else side
    own = Scale(facts.scale, choose_scale(size, (side, side), mm_per_unit=inverse), facts.unit)
    keeps = decided and SMALL * MAX_SIDE <= max(size) / common.per_mm <= MAX_SIDE
    scale = common if keeps else own
    gaps = np.flatnonzero(~np.isfinite(curve))
    parts = tuple(part[np.isfinite(part)] / scale.per_mm for part in np.split(curve, gaps))
    return Hodograph(kind, point, scale, parts, np.nan_to_num(ends) / scale.per_mm)


def hodograph_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the hodograph of velocities or accelerations of a point about one pole.

    It may be larger: the packer takes the size that fills the paper.
    """
    kind, language = style.entry.of, style.language
    assert kind is not None
    usual = SIDE * style.width(style.sizes.column)

    def view(side: float) -> ViewBlock:
        one = hodograph(solution, kind, side)
        title = language.cycle["hodograph"][kind.value].format(of=point_name(one.point))
        said = [scale_inscription(one.scale, solution.problem.scales.convention, language.notation)]
        block = named(one.picture(style.letter), style.entry.title or title, said, style)
        return ViewBlock(block, "hodograph", one.scale)

    return at_scales(view(times * usual) for times in LARGER)


# Tables ------------------------------------------------------------------------------------------


def _table(columns: Columns, lead: int, title: str, style: BlockStyle) -> Block:
    height, notation = style.text(style.sizes.text), style.language.notation
    made = [
        TableColumn(head, cells, unit=notation.in_head(unit) if unit else "")
        for head, unit, cells in columns
    ]
    title = style.entry.title or title
    form, width = TableForm(height, leading=lead), table_width(style)
    return table_block(made, form, max_width=width, width=STAMP_WIDTH, title=title)


def turn_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the table of the turn by positions."""
    diagrams = diagrams_of(solution)
    return _table(cycle_columns(diagrams, style.language), 2, style.language.cycle.table, style)


def deviations_table(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the deviations of the diagrams by every method."""
    diagrams = diagrams_of(solution)
    columns = deviation_columns(diagrams, style.language)
    return _table(columns, 2, deviations_title(solution, style.language), style)


def formulas_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the transfer functions' formulas from a plan, of one position only."""
    kind, transfers, texts = style.entry.of, transfers_of(solution), style.language.sheets
    assert kind is not None
    if transfers is None:
        return Column([])
    index = shown_position(solution, position_indices, style)
    names = Names(solution, style.language.note, on_sheet=True)
    told = TransferNarrator(Formulas(solution, names, index), transfers)
    height, width = style.text(min(3.5, style.sizes.text)), style.width(style.sizes.column)
    title = style.entry.title or texts["transfers"][kind.value]
    if len(solution.positions) > 1:
        title = texts.of_position.format(title=title, number=index)
    blocks = list(blocks_of([Caption(title)], height))
    formula, *sentence = (
        told.crank_acceleration_lines() if kind is PlanKind.ACCELERATION else []
    ) or [""]
    if formula:
        blocks += blocks_of([Formula(formula)], height)
        blocks += [paragraph(text, height, width) for text in sentence]
    blocks += blocks_of(map(Formula, told.formulas(kind)), height)
    whole, half = Column(blocks, gap=2.2), -(-len(blocks) // 2)
    parts = [Column(some, gap=2.2) for some in (blocks[:half], blocks[half:])]
    return Alternatives((whole, Row(parts, gap=2.0 * height)))


def transfer_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the table by positions; of a single one exact and read values with errors."""
    transfers, language = transfers_of(solution), style.language
    if transfers is None:
        return Column([])
    alone, texts = len(solution.positions) == 1, language.sheets
    columns = columns_of(
        transfer_series(transfers), solution, position_indices, language, sigma=alone
    )
    height = style.text(min(style.sizes.text, 3.5))
    table = table_block(
        columns,
        TableForm(height, leading=1 if alone else 2),
        max_width=table_width(style),
        title=style.entry.title or texts.transfer_table,
    )
    if not alone:
        return table
    return with_note(table, columns, height, solution.profile.name, language)
