"""Words and numbers of the structural analysis as rich text (таблицы и формулы структуры)."""

from __future__ import annotations

from planmethod.mechanism.describe import PairKind, kind_of_motion, pairs
from planmethod.mechanism.groups import AssurGroup, links_of
from planmethod.mechanism.model import FRAME, Mechanism
from planmethod.mechanism.structure import LOCAL_MOBILITY, WAYS_IN, Structure, roman
from planmethod.note.narrate.structure import local_letters
from planmethod.note.wording import Language
from planmethod.render.layout.tables import TableColumn
from planmethod.render.pictures.chains import letters

NBSP = "\u00a0"


def pair_columns(mechanism: Mechanism, words: Language) -> list[TableColumn]:
    """Return the table of kinematic pairs (кинематические пары)."""
    rows, kinds = pairs(mechanism), words.structure["pair_kinds"]
    cells = (
        tuple(letters(pair.name) for pair in rows),
        tuple(" – ".join(pair.links) for pair in rows),
        tuple(kinds[pair.kind.value] for pair in rows),
        tuple("V" for _ in rows),
        tuple("1" for _ in rows),
    )
    return list(map(TableColumn, words.structure["columns_pairs"], cells))


def link_columns(mechanism: Mechanism, words: Language) -> list[TableColumn]:
    """Return the table of links (звенья)."""
    rows, every = kind_of_motion(mechanism), pairs(mechanism)
    own = ([letters(pair.name) for pair in every if row.link in pair.links] for row in rows)
    cells = (
        tuple(row.link for row in rows),
        tuple(words.note["roles"][row.role.value] for row in rows),
        tuple(words.structure["motions"][row.motion.value] for row in rows),
        tuple(map(", ".join, own)),
    )
    return list(map(TableColumn, words.structure["columns_links"], cells))


def formulas(mechanism: Mechanism, structure: Structure, words: Language) -> list[str]:
    """Return the formulas of the structural analysis as rich text (структурные формулы)."""
    said, low, spatial = words.structure, structure.lower_pairs, structure.spatial_mobility
    revolute = sum(pair.kind is PairKind.REVOLUTE for pair in pairs(mechanism))
    first = f"I({FRAME},{mechanism.driver})"
    steps = [f"{roman(group.class_number)}({','.join(group.links)})" for group in structure.groups]
    order, backwards = " → ".join([first, *steps]), " → ".join([*steps[::-1], first])
    counts = {"n": structure.moving_links, "low": low, "high": structure.higher_pairs}
    return [
        said.counts.format(revolute=revolute, prismatic=low - revolute, **counts),
        said.chebyshev.format(w=_signed(structure.mobility), **counts),
        said.spatial.format(w=_signed(spatial), **counts),
        said.redundant.format(
            ways=WAYS_IN, local=LOCAL_MOBILITY, w=_bracketed(spatial), q=structure.redundant
        ),
        said.formula.format(order=order),
        said.mechanism_class.format(roman=roman(structure.class_number)),
        said.kinematic_order.format(order=order),
        said.force_order.format(order=backwards),
    ]


def driver_caption(mechanism: Mechanism, words: Language) -> list[str]:
    """Return name, mobility and redundant constraints of the driver (первичный механизм)."""
    ends = {FRAME, mechanism.driver}
    kind = next(pair.kind for pair in pairs(mechanism) if set(pair.links) == ends)
    said = words.structure
    return [
        said.primary.format(
            kind=said["pair_kinds"][kind.value], links=_listed(FRAME, mechanism.driver)
        ),
        "W = 3·1 − 2·1 = 1".replace(" ", NBSP),
        "q = 1 − (6·1 − 5·1) = 0".replace(" ", NBSP),
    ]


def group_caption(group: AssurGroup, words: Language) -> list[str]:
    """Return class, order, kind, mobility and redundant constraints of a group."""
    n = len(group.links)
    p = len(group.leads) + sum(
        sum(link in group.links for link in links_of(joint)) - 1 for joint in group.inner
    )
    said, kind = words.structure, words.structure["group_leads"].get(str(len(group.leads)), "")
    if group.kind is not None:
        signature = local_letters(group.signature, words.note)
        kind = said.group_kind.format(kind=group.kind, letters=signature)
    named = said.group.format(
        roman=roman(group.class_number), order=group.order, kind=kind, links=_listed(*group.links)
    )
    return [
        named,
        f"W = 3·{n} − 2·{p} = {_signed(3 * n - 2 * p)}".replace(" ", NBSP),
        f"q = 0 − (6·{n} − 5·{p}) = {5 * p - 6 * n}".replace(" ", NBSP),
    ]


def _listed(*links: str) -> str:
    return f",{NBSP}".join(links)


def _signed(number: int) -> str:
    return f"−{-number}" if number < 0 else str(number)


def _bracketed(number: int) -> str:
    return f"({_signed(number)})" if number < 0 else str(number)
