"""Proportions of the types of lettering (GOST 2.304-81, tables 1 and 2)."""

from __future__ import annotations

from collections.abc import Mapping
from math import radians, tan
from types import MappingProxyType

from msgspec import Struct


class Proportions(Struct, frozen=True):
    """Measures of a type of lettering, in line thicknesses d.

    Attributes
    ----------
    cap : int
        Height h of capitals; d is h/cap.
    small : int
        Height c of small letters.
    tail : int
        Depth of the tails of small letters below the base line.
    gap : int
        Gap a between letters.
    line_step : int
        Least step b of base lines.
    word_gap : int
        Least gap e between words.
    """

    cap: int
    small: int
    tail: int
    gap: int = 2
    line_step: int = 17
    word_gap: int = 6


TYPES: Mapping[str, Proportions] = MappingProxyType(
    {
        "A": Proportions(cap=14, small=10, tail=4, line_step=22),
        "B": Proportions(cap=10, small=7, tail=3),
    }
)
"""Types of lettering by the Latin letter of their name (типы А и Б)."""

SLANT = tan(radians(15.0))
"""Lean of slanted letters to the right per unit of height: about 75° to the base line."""
