"""What a language must be able to say of involute meshing (слова эвольвентного зацепления)."""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.record import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshingWording:
    """Headings, names and sentences of a pair of wheels, templates of `str.format`.

    Attributes
    ----------
    tan : str
        How the tangent is written.
    names : mapping
        What the quantities are, by their keys.
    conditions : mapping
        By `planmethod.gears.involute.blocking.LimitKind`; ``wheel`` is its number, ``value`` what
        is compared with ``bound``. In braces of their own stand indices.
    holds : mapping
        Whether a condition is kept.
    steps : mapping
        Headings of the protocol by the key of the quantity that they stand before.
    beside : mapping
        What the protocol says before a quantity.
    """

    tan: str
    title: str
    given: str
    ring: str
    shifts: Mapping[bool, str]
    names: Mapping[str, str]
    pair: str
    wheels: str
    columns: tuple[str, str, str, str]
    checked: str
    conditions: Mapping[str, str]
    holds: Mapping[bool, str]
    undercut: str
    cut_line: str
    missing: str
    units: Mapping[str, str]
    steps: Mapping[str, str]
    beside: Mapping[str, str]
    sheet: str
    meshing: str
    contour: str
    sliding: str
    table: str
