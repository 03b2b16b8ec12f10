"""What a language must be able to say of a machine and its flywheel."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class MachineWording:
    """Letters, names and sentences of the flywheel's sheet in one language, rich text.

    Attributes
    ----------
    letters : mapping
        Of the quantities: ``M`` and ``A`` of the side that changes, by whether it resists or
        drives, and of the constant one; ``T``, ``J``, ``J_f``, ``J_crank``, ``omega``, ``lever``.
    """

    letters: Mapping[str, str]
    wanted: str
    means: Mapping[str, str]
    sides: Mapping[str, str]
    source_signs: str

    diagrams: str
    by_middle: str
    by_trapezoid: str
    speed: str
    load: str
    over_stroke: str
    table: str
    sizes: Mapping[str, str]
    calculation: str
    title: str

    read: str
    construction: str
    exact: str
    parts: str
    slopes: str
    method: str
    positions: str
    pencil: str
    reached: str
    extreme: str
    not_needed: str
    held: str
    lever_agrees: str
    steps: tuple[str, ...]
