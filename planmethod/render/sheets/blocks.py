"""Kinds of blocks that a composition may name: for each the function that makes it, and its keys.

A new kind is one function and one line here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from types import MappingProxyType
from typing import TypeAlias

from msgspec import Struct

from planmethod.render.layout.block import Block
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.results import results_block
from planmethod.render.sheets.texts import (
    calculation_block,
    equations_block,
    statement_block,
    text_block,
)
from planmethod.render.sheets.views import plan_view, scheme_view
from planmethod.solved.solution import Solution

Maker: TypeAlias = Callable[[Solution, Sequence[int], Manner], Block]
"""From a solution and the positions of a sheet to a block."""


class BlockKind(Struct, frozen=True):
    """Kind of block: what makes it, and the keys of a composition file that it listens to.

    ``each``: there is one for every force plan, whose blocks in a row stand together.
    """

    make: Maker
    keys: tuple[str, ...]
    each: bool = False


def _late(home: str, name: str) -> Maker:
    """Return a maker of a module of `planmethod.render.sheets`, imported when first needed."""

    def make(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
        maker: Maker = getattr(import_module(f"planmethod.render.sheets.{home}"), name)
        return maker(solution, indices, manner)

    return make


def _by_number(one: Maker, name: str) -> Maker:
    """Return a maker of one position that has another, of `sheets.several`, for several."""
    several = _late("several", name)

    def make(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
        return (one if len(solution.positions) == 1 else several)(solution, indices, manner)

    return make


_VIEW = ("title", "title_height", "letter", "height", "position")
_TEXT = ("title", "height", "width")
_DIAGRAM = ("title", "title_height", "letter", "height", "width")
_FORCES = ("title_height", "letter", "height", "position")
_FORCE_TEXT = ("height", "width", "position")

BLOCKS: Mapping[str, BlockKind] = MappingProxyType(
    {
        "scheme": BlockKind(_by_number(scheme_view, "scheme_view"), (*_VIEW, "traces")),
        "statement": BlockKind(statement_block, _TEXT),
        "plan": BlockKind(_by_number(plan_view, "plan_view"), ("of", *_VIEW, "per_row", "traces")),
        "equations": BlockKind(equations_block, ("of", *_TEXT)),
        "calculation": BlockKind(calculation_block, ("of", "title", "height", "position")),
        "results": BlockKind(results_block, (*_TEXT, "columns")),
        "text": BlockKind(text_block, ("text", *_TEXT)),
        "loads": BlockKind(_late("forces", "loads_view"), _VIEW),
        "load-statement": BlockKind(_late("forces", "statement_block"), (*_TEXT, "position")),
        "load-curves": BlockKind(_late("loads", "load_curves"), (*_FORCES, "width")),
        "cut": BlockKind(_late("forces", "cut_view"), _FORCES, each=True),
        "force-equations": BlockKind(_late("forces", "equations_block"), _FORCE_TEXT, each=True),
        "force-plan": BlockKind(_late("forces", "plan_view"), _FORCES, each=True),
        "lever": BlockKind(_late("forces", "lever_view"), _VIEW),
        "lever-equation": BlockKind(_late("forces", "lever_block"), (*_TEXT, "position")),
        "reactions": BlockKind(_late("reactions", "reactions_block"), (*_TEXT, "position")),
        "cycle-statement": BlockKind(_late("cycle", "statement_block"), _TEXT),
        "balance-diagram": BlockKind(_late("cycle", "balance_diagram"), _DIAGRAM),
        "reaction-diagram": BlockKind(_late("cycle", "reaction_diagram"), _DIAGRAM[1:], each=True),
        "hodographs": BlockKind(_late("cycle", "hodographs"), (*_DIAGRAM, "per_row")),
        "turn-statement": BlockKind(_late("turn", "turn_statement"), _TEXT),
        "kinematic-diagrams": BlockKind(_late("turn", "diagrams_view"), _DIAGRAM),
        "chosen-plans": BlockKind(_late("turn", "chosen_plans"), ("of", *_VIEW[:-1])),
        "hodograph": BlockKind(_late("turn", "hodograph_view"), ("of", *_DIAGRAM)),
        "measured-results": BlockKind(_late("measured", "measured_table"), _TEXT),
        "turn-table": BlockKind(_late("turn", "turn_table"), _TEXT),
        "deviations": BlockKind(_late("turn", "deviations_table"), _TEXT),
        "machine-statement": BlockKind(_late("flywheel", "statement_block"), _TEXT),
        "flywheel-diagrams": BlockKind(_late("flywheel", "diagrams_view"), _VIEW[:-1]),
        "machine-table": BlockKind(_late("flywheel", "machine_table"), _TEXT),
        "flywheel-calculation": BlockKind(_late("flywheel", "calculation_block"), _TEXT),
        "speed-diagram": BlockKind(_late("flywheel", "speed_diagram"), _DIAGRAM),
        "load-diagram": BlockKind(_late("flywheel", "load_diagrams"), _DIAGRAM),
        "run-up-text": BlockKind(_late("runup", "run_up_text"), _TEXT),
        "run-up-diagrams": BlockKind(_late("runup", "run_up_diagrams"), _DIAGRAM),
        "run-up-tables": BlockKind(_late("runup", "run_up_tables"), _TEXT),
        "balancing-text": BlockKind(_late("balancing", "balancing_text"), _TEXT),
        "balanced-scheme": BlockKind(_late("balancing", "scheme_view"), _VIEW),
        "mass-polygons": BlockKind(_late("balancing", "polygon_views"), _DIAGRAM),
        "inertia-hodographs": BlockKind(_late("balancing", "hodograph_views"), _DIAGRAM),
        "balancing-tables": BlockKind(_late("balancing", "tables"), _TEXT),
        "flywheel": BlockKind(_late("flywheel", "wheel_view"), _DIAGRAM),
        "cycle-reactions": BlockKind(_late("cycletable", "reactions_table"), _TEXT),
    }
)
