"""Blocks of the sheet with friction: circles and cones, corrected plans, efficiency (трение)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.errors import LayoutError
from planmethod.note.document import Caption, Paragraph
from planmethod.note.narrate.forces.common import lettered
from planmethod.note.narrate.forces.friction import FrictionTeller, headed
from planmethod.note.narrate.forces.statement import plan_title
from planmethod.render.forces.friction import friction_picture, is_enlarged
from planmethod.render.frame.frame import STAMP_WIDTH
from planmethod.render.layout.block import Block, Column
from planmethod.render.layout.nodes import TextNode, blocks_of
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.sheets.forces import equations_of, plan_of, scheme_of
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.results import table_width
from planmethod.render.sheets.views import shown_position
from planmethod.solved.forces.friction import RubbedReading, rubbed_reading
from planmethod.solved.forces.reading import force_reading, require_dynamics
from planmethod.solved.solution import Solution


def _reading(solution: Solution, indices: Sequence[int], manner: Manner) -> RubbedReading:
    require_dynamics(solution.problem)
    assert solution.problem.dynamics is not None
    if solution.problem.dynamics.friction is None:
        raise LayoutError(
            "{}: a layout with friction needs [friction] in the problem file. For example: "
            "[friction] f = 0.1, f_pin = 0.1, radius = 0.01.",
            solution.problem.name,
        )
    return rubbed_reading(solution, shown_position(solution, indices, manner))


def _teller(solution: Solution, indices: Sequence[int], manner: Manner) -> FrictionTeller:
    index = _reading(solution, indices, manner).index
    return FrictionTeller(lettered(force_reading(solution, index), manner.words), sizes=True)


def friction_text(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the coefficients, circles and angles with their formulas, and the results."""
    tell = _teller(solution, indices, manner)
    height, width = manner.text(manner.sizes.text), manner.width(manner.sizes.column)
    nodes: list[TextNode] = [
        Caption(manner.entry.title or tell.said.title),
        *map(Paragraph, tell.given()),
        *(Paragraph(f"{tell.reach(pair)}; {tell.size(pair)}") for pair in tell.friction.pairs),
        *tell.nodes(),
    ]
    return Column(list(blocks_of(nodes, height, width=width)), gap=3.0)


def cut_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return a group cut free with the reactions that friction inclines."""
    reading, number = _reading(solution, indices, manner), manner.entry.number
    picture = friction_picture(reading, number, manner.letter, manner.words.say)
    title = plan_title(reading, reading.plans[number], manner.words)
    said = [manner.words.friction.enlarged] if is_enlarged(reading) else []
    return scheme_of(reading, picture, title, manner, *said)


def plan_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return a force plan with one correction for friction."""
    return plan_of(_reading(solution, indices, manner), manner)


def equations_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the equations of a force plan with one correction for friction."""
    return equations_of(_reading(solution, indices, manner), manner)


def friction_table(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the reactions without friction, corrected, and converged."""
    tell = _teller(solution, indices, manner)
    columns = [TableColumn(headed(head), tuple(cells)) for head, *cells in tell.columns()]
    width, title = table_width(manner, STAMP_WIDTH), manner.entry.title or tell.said.sheet_table
    return table_block(
        columns, manner.text(manner.sizes.text), width=width, units="none", title=title
    )
