"""Vector equations with the textbook's underlines and directions (векторные уравнения)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from planmethod.note.document import Equation, Term
from planmethod.note.formula import Rich
from planmethod.note.narrate.letters import SIGN
from planmethod.note.narrate.naming import Names
from planmethod.note.plaintext import input_text
from planmethod.plans.forces.polygons import Edge
from planmethod.plans.model import Direction, Relation, Vector, VectorEquation


def direction_note(names: Names, direction: Direction | None) -> str:
    """Return a direction, links called as their lengths are: ``⊥ BC``."""
    if direction is None:
        return ""
    match direction.relation:
        case Relation.ZERO:
            return "= 0"
        case Relation.TOWARDS:
            return " → ".join(direction.points)
        case Relation.ANGLED:
            angle = input_text(float(f"{direction.angle:.4g}"), names.texts)
            return f"∠ {angle}° {''.join(direction.points)}"
        case Relation.PARALLEL | Relation.PERPENDICULAR:
            return f"{SIGN[direction.relation]} {names.base(direction)}"


Directed: TypeAlias = Callable[[Direction | None], Rich]
"""Function that writes a direction: `letters.direction_text`, or `direction_note` of names."""


def equation_of(equation: VectorEquation, directed: Directed) -> Equation:
    """Return a vector equation as a reader has it."""
    left, *right = (term_of(one, directed) for one in (equation.left, *equation.right))
    return Equation((left,), tuple(right))


def term_of(term: Vector | Edge, directed: Directed) -> Term:
    """Return a term: its symbol, its known parts, its direction."""
    return Term(term.symbol, term.known.value, directed(term.direction))
