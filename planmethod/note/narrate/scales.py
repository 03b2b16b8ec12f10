"""Scales as they are inscribed (масштабы)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.construct.scale import Scale
from planmethod.note.numbers import Notation
from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Convention
from planmethod.solved.solution import Solution

NAMED = 12
"""Most positions that are named for having scales of their own."""


def common_scale(
    solution: Solution, kind: PlanKind, indices: Sequence[int], words: Language
) -> str:
    """Return the scale of most plans of a kind, and which positions have their own."""
    common = solution.scales[kind]
    said = scale_inscription(common, solution.problem.scales.convention, words.say)
    own = [str(i) for i in indices if solution.own_scale(kind, i) != common]
    named = ", ".join(own if len(own) <= NAMED else [*own[:NAMED], "…"])
    return said + words.sheets.but_for.format(numbers=named) if own else said


def scale_inscription(scale: Scale, convention: Convention, say: Notation) -> str:
    """Return a scale as rich text: ``μ_v = 0,05 (м/с)/мм`` or ``μ_v = 20 мм/(м/с)``."""
    letter = scale.symbol.removeprefix("mu_")
    unit, mm = say.in_head(scale.unit), say.units["mm"]
    grouped = f"({unit})" if "/" in unit or "·" in unit else unit
    if convention is Convention.MM_PER_UNIT:
        return f"μ_{{{letter}}} = {say.given(1.0 / scale.per_mm)} {mm}/{grouped}"
    return f"μ_{{{letter}}} = {say.given(scale.per_mm)} {grouped}/{mm}"
