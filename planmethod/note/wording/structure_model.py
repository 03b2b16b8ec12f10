"""What a language must be able to say on the structural sheet (слова структурного листа)."""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.record import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class StructureWording:
    """Headings, tables, formulas and captions of the structural sheet in one language, rich text.

    As in `Wording`, every sentence is a template of `str.format`.
    """

    # Headings
    title: str
    scheme: str
    parts: str
    pairs: str
    links: str
    formulas: str

    # Tables; names by those of `planmethod.mechanism.describe`
    columns_pairs: tuple[str, ...]
    columns_links: tuple[str, ...]
    pair_kinds: Mapping[str, str]
    motions: Mapping[str, str]

    # Formulas; a no-break space keeps a line together
    counts: str
    chebyshev: str
    spatial: str
    redundant: str
    formula: str
    mechanism_class: str
    kinematic_order: str
    force_order: str

    # Captions of the parts
    primary: str
    group: str
    group_kind: str
    group_leads: Mapping[int, str]
