"""What a language must be able to say of gear trains (слова зубчатых механизмов)."""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.note.wording.gear_sheet_model import GearSheetWording
from planmethod.record import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class GearWording:
    """Headings, columns and sentences of gear trains in one language, templates of `str.format`.

    Attributes
    ----------
    kinds, conditions, reasons : mapping
        By kind of train, name of the condition, reason why a value does not exist.
    columns_* : tuple of str
        Heads of the tables.
    sheet : GearSheetWording
        Sheet and protocol.
    """

    sheet: GearSheetWording
    title: str
    structure: str
    kinds: Mapping[str, str]
    kind: str
    chebyshev: str
    by_meshes: str
    redundant: str
    carrier: str
    closing: str
    equations: str
    equation: str
    wheels: str
    columns_wheels: tuple[str, ...]
    speeds: str
    columns_speeds: tuple[str, ...]
    relative: str
    across: str
    rack: str
    tabular: str
    tabular_rows: tuple[str, ...]
    asked: str
    columns_asked: tuple[str, ...]
    checked: str
    conditions: Mapping[str, str]
    holds: Mapping[bool, str]
    picture: str
    scales: str
    columns_contacts: tuple[str, ...]
    columns_rays: tuple[str, ...]
    points: Mapping[str, str]
    no_picture: str
    published: str
    columns_published: tuple[str, ...]
    reasons: Mapping[str, str]
    units: Mapping[str, str]
