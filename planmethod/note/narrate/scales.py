"""Scales as they are inscribed (масштабы)."""

from __future__ import annotations

from planmethod.construct.scale import Scale
from planmethod.note.numbers import Notation
from planmethod.problem.model import Convention


def scale_inscription(scale: Scale, convention: Convention, notation: Notation) -> str:
    """Return a scale as rich text: ``μ_v = 0,05 (м/с)/мм`` or ``μ_v = 20 мм/(м/с)``.

    What has no unit, as a ratio, has ``1/мм`` or ``мм``.
    """
    letter = scale.symbol.removeprefix("mu_")
    unit, mm = notation.in_head(scale.unit) if scale.unit else "1", notation.units["mm"]
    grouped = f"({unit})" if "/" in unit or "·" in unit else unit
    if convention is Convention.MM_PER_UNIT:
        return f"μ_{{{letter}}} = {notation.as_input(1.0 / scale.per_mm, zero_limit=0.0)} {mm}" + (
            f"/{grouped}" if scale.unit else ""
        )
    return f"μ_{{{letter}}} = {notation.as_input(scale.per_mm, zero_limit=0.0)} {grouped}/{mm}"
