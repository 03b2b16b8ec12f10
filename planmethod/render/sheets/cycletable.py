"""Table of the forces over the cycle: reactions and balances by positions (таблица за цикл)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.note.compared import ComparedNumber, sense_of
from planmethod.note.force_series import balance_series, lever_beside_plans
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.narrate.statement import NBSP
from planmethod.note.numbers import Notation, decimals_of, format_column, half_up
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.render.layout.block import Block, Column, paragraph
from planmethod.render.layout.tables import TableCell, TableColumn, table_block
from planmethod.render.sheets.guides import angle_text
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import position_columns, table_width
from planmethod.solved.cycle import Cycle, cycle
from planmethod.solved.forces.reading import NEGLIGIBLE_FRACTION
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution


def reactions_table(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the table of reactions and of the balance by positions."""
    forces = cycle(solution)
    height, width = style.text(min(style.sizes.text, 3.5)), table_width(style)
    language = style.language
    columns = position_columns(solution, position_indices, language)
    for k in range(len(forces.joints)):
        columns += _reaction_columns(forces, k, position_indices, language.notation)
    columns += cycle_balance_columns(solution, position_indices, language)
    title = style.entry.title or language.sheets.cycle_reactions
    table = table_block(columns, height, max_width=width, leading=2, title=title)
    return Column([table, paragraph(_drawn_at(solution, language), height, table.width)], gap=3.0)


def _drawn_at(solution: Solution, language: Language) -> str:
    """Return the note on the scales of the plans of all positions, and on their reading."""
    convention = solution.problem.scales.convention
    scales = [*solution.scales.values(), statics_of(solution).scale]
    told = (scale_inscription(scale, convention, language.notation) for scale in scales)
    phrase = "; ".join(text.replace(" ", NBSP) for text in told)
    notation = language.notation
    ruler = f"{notation.as_input(solution.ruler_arithmetic.ruler)}{NBSP}{notation.units['mm']}"
    return language.sheets.cycle_note.format(scales=phrase, ruler=ruler)


def _reaction_columns(
    forces: Cycle, which: int, position_indices: Sequence[int], notation: Notation
) -> list[TableColumn]:
    """Return size and direction of a reaction, and of a guide its moment about the pin."""
    joint, statics = forces.joints[which], statics_of(forces.solution)
    values = [complex(joint.force[i]) for i in position_indices]
    nothing = [
        abs(v) <= NEGLIGIBLE_FRACTION * statics.largest(i)
        for v, i in zip(values, position_indices, strict=True)
    ]
    sizes = format_column([0.0 if nil else abs(v) for v, nil in zip(values, nothing, strict=True)])
    angles = [
        "—" if nil else angle_text(v, notation) for v, nil in zip(values, nothing, strict=True)
    ]
    by = forces.solution.problem.mechanism.called(joint.by)
    index = reaction_symbol(joint.on, by, letter="")
    columns = [
        TableColumn(
            reaction_symbol(joint.on, by),
            tuple(map(notation.number, sizes)),
            unit=notation.units["N"],
        ),
        TableColumn(f"φ{index}", tuple(angles), unit=notation.in_head("deg")),
    ]
    moments = [float(joint.moment[i]) for i in position_indices]
    lengths = [length for _, _, length in forces.solution.problem.lengths]
    least = [
        NEGLIGIBLE_FRACTION * statics.largest(i) * max(lengths, default=1.0)
        for i in position_indices
    ]
    none = [abs(m) <= small for m, small in zip(moments, least, strict=True)]
    if not all(none):
        texts = format_column(
            [0.0 if nil else abs(m) for m, nil in zip(moments, none, strict=True)]
        )
        cells = tuple(
            TableCell(notation.number(text), 0 if nil else (1 if m > 0 else -1))
            for text, m, nil in zip(texts, moments, none, strict=True)
        )
        columns.append(TableColumn(f"M{index}", cells, unit=notation.units["N·m"]))
    return columns


def cycle_balance_columns(
    solution: Solution, position_indices: Sequence[int], language: Language
) -> list[TableColumn]:
    """Return the balance: exact, by both methods, their difference and its expected size.

    The difference is between the numbers of the table.
    """
    statics, said, notation = statics_of(solution), language.sheets, language.notation
    plans, both = balance_series(statics), lever_beside_plans(statics)
    unit = notation.units[plans.unit]

    def column(head: str, texts: Sequence[str], *, sense: bool = plans.turns) -> TableColumn:
        cells = []
        for text in texts:
            size = text.removeprefix("-") if sense else text
            cells.append(TableCell(notation.number(size), sense_of(float(text)) if sense else None))
        return TableColumn(head, tuple(cells), unit=unit)

    def chosen(values: Reals | Sequence[float]) -> list[float]:
        return [float(values[i]) for i in position_indices]

    exact = column(notation.symbol(plans.symbol), format_column(chosen(plans.exact)))
    if both is None:
        return [exact]
    texts = format_column([*chosen(both.exact), *chosen(both.read)])
    pairs = list(zip(texts[: len(position_indices)], texts[len(position_indices) :], strict=True))
    printed = [ComparedNumber(float(one), float(two)) for one, two in pairs]
    differences = [
        _rounded(one.size_off if both.turns else one.off, *pair)
        for one, pair in zip(printed, pairs, strict=True)
    ]
    shares = tuple(notation.number(one.percent_text()) for one in printed)
    return [
        exact,
        column(said.cycle_plans, texts[: len(position_indices)]),
        column(said.cycle_lever, texts[len(position_indices) :]),
        column("Δ", differences, sense=False),
        TableColumn("Δ", shares, unit="%"),
        column("σ_{Δ}", format_column(chosen(both.sigma), 2), sense=False),
    ]


def _rounded(difference: float, one: str, two: str) -> str:
    """Return the difference of two printed numbers with their common decimals; a 0 has none."""
    decimals = min(decimals_of(text) for text in (one, two) if float(text) or one == two)
    return f"{half_up(difference, decimals) + 0.0:.{decimals}f}"
