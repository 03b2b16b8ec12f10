"""Blocks of the sheet with friction: circles and cones, corrected plans, efficiency (трение)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.errors import LayoutError
from planmethod.note.document import Caption, Paragraph
from planmethod.note.narrate.forces.common import lettered
from planmethod.note.narrate.forces.friction import FrictionNarrator, headed
from planmethod.note.narrate.forces.statement import plan_title
from planmethod.render.forces.friction import friction_picture, is_enlarged
from planmethod.render.frame.frame import STAMP_WIDTH
from planmethod.render.layout.block import Block, Column
from planmethod.render.layout.nodes import TextNode, blocks_of
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.sheets.forces import equations_of, plan_of, scheme_of
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import table_width
from planmethod.render.sheets.views import shown_position
from planmethod.solved.forces.friction import RubbedReading, rubbed_reading
from planmethod.solved.forces.reading import force_reading, require_dynamics
from planmethod.solved.solution import Solution


def _reading(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> RubbedReading:
    require_dynamics(solution.problem)
    assert solution.problem.dynamics is not None
    if solution.problem.dynamics.friction is None:
        raise LayoutError(
            "{}: a layout with friction needs [friction] in the problem file. For example: "
            "[friction] f = 0.1, f_pin = 0.1, radius = 0.01.",
            solution.problem.name,
        )
    return rubbed_reading(solution, shown_position(solution, position_indices, style))


def _make_narrator(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> FrictionNarrator:
    index = _reading(solution, position_indices, style).index
    return FrictionNarrator(lettered(force_reading(solution, index), style.language), sizes=True)


def friction_text(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the coefficients, circles and angles with their formulas, and the results."""
    narrator = _make_narrator(solution, position_indices, style)
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)
    nodes: list[TextNode] = [
        Caption(style.entry.title or narrator.texts.title),
        *map(Paragraph, narrator.given_lines()),
        *(
            Paragraph(f"{narrator.reach(pair)}; {narrator.size(pair)}")
            for pair in narrator.friction.pairs
        ),
        *narrator.nodes(),
    ]
    return Column(list(blocks_of(nodes, height, width=width)), gap=3.0)


def cut_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return a group cut free with the reactions that friction inclines."""
    reading, number = _reading(solution, position_indices, style), style.entry.number
    picture = friction_picture(reading, number, style.letter, style.language.notation)
    title = plan_title(reading, reading.plans[number], style.language)
    said = [style.language.friction.enlarged] if is_enlarged(reading) else []
    return scheme_of(reading, picture, title, style, *said)


def plan_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return a force plan with one correction for friction."""
    return plan_of(_reading(solution, position_indices, style), style)


def equations_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the equations of a force plan with one correction for friction."""
    return equations_of(_reading(solution, position_indices, style), style)


def friction_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the reactions without friction, corrected, and converged."""
    narrator = _make_narrator(solution, position_indices, style)
    columns = [TableColumn(headed(head), tuple(cells)) for head, *cells in narrator.columns()]
    width, title = table_width(style, STAMP_WIDTH), style.entry.title or narrator.texts.sheet_table
    return table_block(
        columns, style.text(style.sizes.text), width=width, units="none", title=title
    )
