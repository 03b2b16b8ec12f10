"""Letters of the plans as the drawing and the note write them (rich text)."""

from __future__ import annotations

from planmethod.construct.steps import PointName
from planmethod.plans.model import Direction, Plan, PlanKind, Relation
from planmethod.problem.model import Convention, Problem

SIGN = {Relation.ALONG: "∥", Relation.ACROSS: "⊥"}


def _is_primed(problem: Problem, kind: PlanKind) -> bool:
    """Tell whether a plan's letters carry a prime: the acceleration plan of the mm/unit books."""
    return kind is PlanKind.ACCELERATION and problem.scales.convention is Convention.MM_PER_UNIT


def pole_letter(problem: Problem, kind: PlanKind) -> str:
    """Return the letter of the pole: p; π on the acceleration plan, or p′ in the mm/unit books."""
    if kind is PlanKind.VELOCITY:
        return "p"
    return "p′" if _is_primed(problem, kind) else "π"


def shown_letters(problem: Problem, plan: Plan) -> dict[PointName, list[str]]:
    """Return the letters of every plan point; those of the pole begin with the pole's own."""
    primed = _is_primed(problem, plan.kind)
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


def segment(problem: Problem, plan: Plan, tail: PointName, head: PointName) -> str:
    """Return a segment by its ends' first letters: ``(bc)``."""
    letters = shown_letters(problem, plan)
    return f"({letters[tail][0]}{letters[head][0]})"


def mark(*points: str) -> str:
    """Return names of mechanism points in rich text: ``mark("O3", "A")`` gives ``O_{3}A``."""
    return "".join(f"{name[:1]}_{{{name[1:]}}}" if name[1:] else name for name in points)


def direction_text(direction: Direction | None) -> str:
    """Return a direction as it stands under a term, in rich text: ``⊥ BC``, ``C → B``, ``= 0``."""
    if direction is None:
        return ""
    base = direction.guide or mark(*direction.points)
    match direction.relation:
        case Relation.STILL:
            return "= 0"
        case Relation.TOWARDS:
            return " → ".join(mark(point) for point in direction.points)
        case Relation.ANGLED:
            return f"∠ {direction.angle:.4g}° {base}"
        case Relation.ALONG | Relation.ACROSS:
            return f"{SIGN[direction.relation]} {base}"
