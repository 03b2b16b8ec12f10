"""Letters of the plans as the drawing and the note write them (rich text)."""

from __future__ import annotations

from planmethod.construct.steps import PointName
from planmethod.note.numbers import Notation
from planmethod.plans.model import Direction, Plan, Relation, is_primed, pole_letter
from planmethod.problem.model import Problem

SIGN = {Relation.PARALLEL: "∥", Relation.PERPENDICULAR: "⊥"}


def plan_letters(problem: Problem, plan: Plan) -> dict[PointName, list[str]]:
    """Return the letters of every plan point; those of the pole begin with the pole's own."""
    primed = is_primed(problem, plan.kind)
    letters = {
        at: [_primed(letter) if primed else letter for letter in text.split(", ")]
        for at, text in plan.letters.items()
    }
    if plan.pole is not None:
        letters[plan.pole] = [pole_letter(problem, plan.kind), *letters.get(plan.pole, [])]
    return letters


def _primed(letter: str) -> str:
    head, brace, tail = letter.partition("_{")
    return f"{head}′_{{{tail}" if brace else f"{head}′"


def mark(*points: str) -> str:
    """Return names of mechanism points in rich text: ``mark("O3", "A")`` gives ``O_{3}A``."""
    return "".join(f"{name[:1]}_{{{name[1:]}}}" if name[1:] else name for name in points)


def pair_letters(name: str) -> str:
    """Return the designation of a pair as rich text: ``O1(0,3)`` gives ``O_{1}(0,3)``."""
    point, bracket, links = name.partition("(")
    return f"{mark(point)}{bracket}{links}"


def direction_text(direction: Direction | None, say: Notation | None = None) -> str:
    """Return a direction as it stands under a term, in rich text: ``⊥ BC``, ``C → B``, ``= 0``.

    ``say`` writes the degrees of an angle in a language.
    """
    if direction is None:
        return ""
    base = direction.guide or mark(*direction.points)
    match direction.relation:
        case Relation.ZERO:
            return "= 0"
        case Relation.TOWARDS:
            return " → ".join(mark(point) for point in direction.points)
        case Relation.ANGLED:
            degrees = f"{direction.angle:.4g}"
            return f"∠ {say.number(degrees) if say else degrees}° {base}"
        case Relation.PARALLEL | Relation.PERPENDICULAR:
            return f"{SIGN[direction.relation]} {base}"
