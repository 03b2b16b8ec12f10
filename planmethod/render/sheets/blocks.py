"""Kinds of blocks that a composition may name: the function and the keys of each.

A new kind is one function, its line in the table of its subject and one in `BLOCKS`. The makers of
the kinematics are imported at once; those of the other subjects when a composition names one, since
they import forces, machines and the turn of a crank.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

import numpy as np
from msgspec import Struct

from planmethod.plans.model import PlanKind
from planmethod.render.layout.block import Block, Column
from planmethod.render.sheets import results, views
from planmethod.render.sheets.model import BlockStyle
from planmethod.solved.solution import Solution

Maker: TypeAlias = Callable[[Solution, Sequence[int], BlockStyle], Block]
"""From a solution and the positions of a sheet to a block."""

Makers: TypeAlias = Callable[[], Mapping[str, Maker]]
"""Imports the makers of a subject, by the names of their kinds."""


class BlockKind(Struct, frozen=True):
    """Kind of block: its maker, and the keys of a composition that it uses.

    ``each``: there is one for every force plan, whose consecutive blocks form a group.
    """

    makers: Makers
    keys: tuple[str, ...]
    each: bool = False


OF_CYCLE = frozenset(
    {
        "turn-statement", "kinematic-diagrams", "hodograph", "graphs", "turn-table",
        "flywheel-diagrams", "machine-statement", "machine-table", "moment-table", "energy-table",
        "drive-chain",
        "load-diagram", "flywheel-works", "flywheel-masses",
    }
)  # fmt: skip
"""Kinds that number the positions of the cycle, regardless of the positions of a sheet."""

OF_POSITIONS = frozenset(
    {
        "scheme", "plan", "chosen-plans", "calculation", "results", "measured-results",
        "transfers", "transfer-table", "analytic", "senses", "cycle-statement", "balance-diagram",
        "reaction-diagram", "hodographs", "cycle-reactions", "centres", "centres-tables",
        "superposition", "superposition-table",
    }
)  # fmt: skip
"""Kinds that number the positions of a sheet."""


def has_forces(kind: str) -> bool:
    """Return whether the blocks of a kind need forces."""
    return BLOCKS[kind].makers in (_forces, _friction, _cycle, _flywheel, _run_up)


def maker_of(kind: str) -> Maker:
    """Return the maker of the blocks of a kind."""
    return BLOCKS[kind].makers()[kind]


# Makers by subject -------------------------------------------------------------------------------


def _kinematics() -> Mapping[str, Maker]:
    return {
        "scheme": _scheme,
        "statement": views.statement_block,
        "plan": _plan,
        "equations": views.equations_block,
        "calculation": views.calculation_block,
        "results": results.results_block,
        "text": views.text_block,
    }


def _transfers() -> Mapping[str, Maker]:
    from planmethod.render.sheets import turn

    return {
        "transfers": turn.formulas_block,
        "transfer-table": turn.transfer_table,
    }


def _analytic() -> Mapping[str, Maker]:
    from planmethod.render.sheets import analytic

    return {"analytic": analytic.analytic_block}


def _centres() -> Mapping[str, Maker]:
    from planmethod.render.sheets import centres

    return {"centres": centres.scheme_block, "centres-tables": centres.table_blocks}


def _superposition() -> Mapping[str, Maker]:
    from planmethod.render.sheets import superposition

    return {
        "superposition": superposition.plans_block,
        "superposition-table": superposition.table_blocks,
    }


def _senses() -> Mapping[str, Maker]:
    from planmethod.render.sheets import senses

    return {"senses": senses.senses_block}


def _structure() -> Mapping[str, Maker]:
    from planmethod.render.sheets import structure

    return {
        "structure-scheme": structure.scheme_block,
        "structure-groups": structure.groups_block,
        "structure-tables": structure.tables_block,
        "structure-formulas": structure.formulas_block,
    }


def _synthesis() -> Mapping[str, Maker]:
    from planmethod.render.sheets import synthesis

    return {
        "synthesis": synthesis.synthesis_view,
        "synthesis-formulas": synthesis.formulas_block,
        "synthesis-steps": synthesis.steps_block,
        "synthesis-sizes": synthesis.sizes_block,
        "synthesis-check": synthesis.check_block,
    }


def _scheme(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    if len(solution.positions) == 1:
        return views.scheme_view(solution, position_indices, style)
    return views.scheme_views(solution, position_indices, style)


def _plan(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    still = style.entry.of is PlanKind.VELOCITY and not np.any(solution.driven[1])
    if style.entry.droppable and still:  # an empty plan
        return Column([])
    if len(solution.positions) == 1:
        return views.plan_view(solution, position_indices, style)
    return views.plan_views(solution, position_indices, style)


def _forces() -> Mapping[str, Maker]:
    from planmethod.render.sheets import forces, graphs

    return {
        "loads": forces.loads_view,
        "load-statement": forces.statement_block,
        "load-curves": graphs.load_curves,
        "cut": forces.cut_view,
        "force-equations": forces.equations_block,
        "force-plan": forces.plan_view,
        "link-cut": forces.link_cut_view,
        "link-plan": forces.link_plan_view,
        "lever": forces.lever_view,
        "lever-equation": forces.lever_block,
        "reactions": forces.reactions_block,
    }


def _friction() -> Mapping[str, Maker]:
    from planmethod.render.sheets import forces

    return {
        "friction-text": forces.friction_text,
        "friction-cut": forces.friction_cut_view,
        "friction-equations": forces.friction_equations_block,
        "friction-plan": forces.friction_plan_view,
        "friction-table": forces.friction_table,
    }


def _cycle() -> Mapping[str, Maker]:
    from planmethod.render.sheets import cycle

    return {
        "cycle-statement": cycle.statement_block,
        "balance-diagram": cycle.balance_diagram,
        "reaction-diagram": cycle.reaction_diagram,
        "hodographs": cycle.hodographs,
        "cycle-reactions": cycle.reactions_table,
    }


def _turn() -> Mapping[str, Maker]:
    from planmethod.render.sheets import graphs, turn

    return {
        "graphs": graphs.graphs_view,
        "turn-statement": turn.turn_statement,
        "kinematic-diagrams": turn.diagrams_view,
        "chosen-plans": turn.chosen_plans,
        "hodograph": turn.hodograph_view,
        "turn-table": turn.turn_table,
        "deviations": turn.deviations_table,
    }


def _measured() -> Mapping[str, Maker]:
    return {"measured-results": results.measured_table}


def _flywheel() -> Mapping[str, Maker]:
    from planmethod.render.sheets import flywheel

    return {
        "machine-statement": flywheel.statement_block,
        "flywheel-diagrams": flywheel.diagrams_view,
        "flywheel-works": flywheel.works_view,
        "flywheel-masses": flywheel.masses_view,
        "machine-table": flywheel.machine_table,
        "moment-table": flywheel.moment_table,
        "energy-table": flywheel.energy_table,
        "drive-chain": flywheel.chain_block,
        "flywheel-calculation": flywheel.calculation_block,
        "speed-diagram": flywheel.speed_diagram,
        "load-diagram": flywheel.load_diagrams,
        "flywheel": flywheel.wheel_view,
    }


def _run_up() -> Mapping[str, Maker]:
    from planmethod.render.sheets import flywheel

    return {
        "run-up-text": flywheel.run_up_text,
        "run-up-diagrams": flywheel.run_up_diagrams,
        "run-up-tables": flywheel.run_up_tables,
    }


def _balancing() -> Mapping[str, Maker]:
    from planmethod.render.sheets import balancing

    return {
        "balancing-text": balancing.balancing_text,
        "balanced-scheme": balancing.scheme_view,
        "mass-polygons": balancing.polygon_views,
        "inertia-hodographs": balancing.hodograph_views,
        "balancing-tables": balancing.tables,
    }


# Kinds and their keys ----------------------------------------------------------------------------

_VIEW = ("title", "title_height", "letter", "height", "position")
_TEXT = ("title", "height", "width")
_DIAGRAM = ("title", "title_height", "letter", "height", "width")
_FORCES = ("title_height", "letter", "height", "position")
_FORCE_TEXT = ("height", "width", "position")

BLOCKS: dict[str, BlockKind] = {
    "scheme": BlockKind(_kinematics, (*_VIEW, "traces", "hatched")),
    "statement": BlockKind(_kinematics, _TEXT),
    "plan": BlockKind(_kinematics, ("of", *_VIEW, "per_row", "traces", "hatched")),
    "equations": BlockKind(_kinematics, ("of", *_TEXT)),
    "calculation": BlockKind(_kinematics, ("of", "title", "height", "position")),
    "results": BlockKind(_kinematics, (*_TEXT, "columns")),
    "transfers": BlockKind(_transfers, ("of", "title", "height", "position")),
    "transfer-table": BlockKind(_transfers, _TEXT),
    "analytic": BlockKind(_analytic, (*_TEXT, "position")),
    "centres": BlockKind(_centres, _VIEW),
    "centres-tables": BlockKind(_centres, (*_TEXT, "position")),
    "superposition": BlockKind(_superposition, _VIEW),
    "superposition-table": BlockKind(_superposition, (*_TEXT, "position")),
    "text": BlockKind(_kinematics, ("text", *_TEXT)),
    "senses": BlockKind(_senses, ("of", *_VIEW[:3], "position")),
    "structure-scheme": BlockKind(_structure, ("title_height", "letter", "width")),
    "structure-groups": BlockKind(_structure, ("title_height", "letter", "height", "width")),
    "structure-tables": BlockKind(_structure, ("title_height", "height", "width")),
    "structure-formulas": BlockKind(_structure, ("title_height", "height", "width")),
    "loads": BlockKind(_forces, _VIEW),
    "load-statement": BlockKind(_forces, (*_TEXT, "position")),
    "load-curves": BlockKind(_forces, (*_FORCES, "width")),
    "cut": BlockKind(_forces, _FORCES, each=True),
    "force-equations": BlockKind(_forces, _FORCE_TEXT, each=True),
    "force-plan": BlockKind(_forces, _FORCES, each=True),
    "link-cut": BlockKind(_forces, _FORCES, each=True),
    "link-plan": BlockKind(_forces, _FORCES, each=True),
    "lever": BlockKind(_forces, _VIEW),
    "lever-equation": BlockKind(_forces, (*_TEXT, "position")),
    "reactions": BlockKind(_forces, (*_TEXT, "position")),
    "friction-text": BlockKind(_friction, (*_TEXT, "position")),
    "friction-cut": BlockKind(_friction, _FORCES, each=True),
    "friction-equations": BlockKind(_friction, _FORCE_TEXT, each=True),
    "friction-plan": BlockKind(_friction, _FORCES, each=True),
    "friction-table": BlockKind(_friction, (*_TEXT, "position")),
    "cycle-statement": BlockKind(_cycle, _TEXT),
    "balance-diagram": BlockKind(_cycle, _DIAGRAM),
    "reaction-diagram": BlockKind(_cycle, _DIAGRAM[1:], each=True),
    "hodographs": BlockKind(_cycle, (*_DIAGRAM, "per_row")),
    "turn-statement": BlockKind(_turn, _TEXT),
    "kinematic-diagrams": BlockKind(_turn, _DIAGRAM),
    "chosen-plans": BlockKind(_turn, ("of", "positions", "per_row", *_VIEW[:-1])),
    "hodograph": BlockKind(_turn, ("of", *_DIAGRAM)),
    "graphs": BlockKind(_turn, ("asked", *_VIEW[:-1], "per_row")),
    "measured-results": BlockKind(_measured, _TEXT),
    "turn-table": BlockKind(_turn, _TEXT),
    "deviations": BlockKind(_turn, _TEXT),
    "machine-statement": BlockKind(_flywheel, _TEXT),
    "flywheel-diagrams": BlockKind(_flywheel, _VIEW[:-1]),
    "flywheel-works": BlockKind(_flywheel, _VIEW[:-1]),
    "flywheel-masses": BlockKind(_flywheel, ("letter",)),
    "machine-table": BlockKind(_flywheel, _TEXT),
    "moment-table": BlockKind(_flywheel, _TEXT),
    "energy-table": BlockKind(_flywheel, _TEXT),
    "drive-chain": BlockKind(_flywheel, _TEXT[1:]),
    "flywheel-calculation": BlockKind(_flywheel, _TEXT),
    "speed-diagram": BlockKind(_flywheel, _DIAGRAM),
    "load-diagram": BlockKind(_flywheel, _DIAGRAM),
    "run-up-text": BlockKind(_run_up, _TEXT),
    "run-up-diagrams": BlockKind(_run_up, _DIAGRAM),
    "run-up-tables": BlockKind(_run_up, _TEXT),
    "balancing-text": BlockKind(_balancing, _TEXT),
    "balanced-scheme": BlockKind(_balancing, _VIEW),
    "mass-polygons": BlockKind(_balancing, _DIAGRAM),
    "inertia-hodographs": BlockKind(_balancing, _DIAGRAM),
    "balancing-tables": BlockKind(_balancing, _TEXT),
    "flywheel": BlockKind(_flywheel, _DIAGRAM),
    "synthesis": BlockKind(_synthesis, ("title_height", "letter", "height")),
    "synthesis-formulas": BlockKind(_synthesis, _TEXT[1:]),
    "synthesis-steps": BlockKind(_synthesis, _TEXT[1:]),
    "synthesis-sizes": BlockKind(_synthesis, _TEXT[1:]),
    "synthesis-check": BlockKind(_synthesis, _TEXT[1:]),
    "cycle-reactions": BlockKind(_cycle, _TEXT),
}
