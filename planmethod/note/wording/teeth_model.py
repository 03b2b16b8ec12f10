"""What a language must be able to say of the choice of teeth (слова подбора чисел зубьев)."""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.record import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class TeethWording:
    """Headings, columns and sentences in one language, templates of `str.format`.

    Attributes
    ----------
    schemes : mapping
        What the schemes are, with their formula of U.
    """

    title: str
    schemes: Mapping[str, str]
    wanted: str
    satellites: str
    modules: str
    bounds: str
    rings: str
    conditions: str
    carried: str
    found: str
    none: str
    columns: tuple[str, ...]
    file: str
