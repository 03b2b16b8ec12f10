"""What a language must be able to say of the sheet and the protocol of gear trains."""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.record import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class GearSheetWording:
    """Titles, rich text, and sentences of steps, templates of `str.format` (лист и протокол).

    Attributes
    ----------
    kinds : mapping
        Names of meshes, by kind.
    inscriptions : mapping
        Inscriptions of scales, by scale.
    steps : mapping
        Sentences of the protocol, by kind of step.
    """

    scheme: str
    front: str
    linear: str
    angular: str
    results: str
    segments: str
    calculation: str
    inscriptions: Mapping[str, str]
    fixed: str
    by_coaxiality: str
    module: str
    columns_results: tuple[str, ...]
    columns_segments: tuple[str, ...]
    no_scheme: str
    kinds: Mapping[str, str]
    protocol: str
    given: str
    source: str
    pictures: str
    steps: Mapping[str, str]
    ruler: str
