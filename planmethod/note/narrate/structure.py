"""Structural analysis: pairs, links, formulas, Assur groups (структурный анализ)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from planmethod.mechanism.describe import PairKind, kind_of_motion, pairs
from planmethod.mechanism.groups import AssurGroup, Joint, letter_of, links_of
from planmethod.mechanism.model import FRAME, Mechanism, Revolute
from planmethod.mechanism.structure import LOCAL_MOBILITY, WAYS_IN, Structure, roman
from planmethod.note.document import Caption, Document, Item, Node, Step, Table, Title, table_of
from planmethod.note.formula import Rich
from planmethod.note.narrate.letters import pair_letters
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language, Words

NBSP = "\u00a0"


def structure_document(
    mechanism: Mechanism, structure: Structure, words: Language, notation: str | None = None
) -> Document:
    """Return the structural analysis of a mechanism with its numbers (структурный анализ).

    ``notation`` is that of the numbers of pairs: `pair_classes`.
    """
    return Document.of(_analysis(mechanism, structure, words, notation))


def _analysis(
    mechanism: Mechanism, structure: Structure, words: Language, notation: str | None
) -> Iterator[Node]:
    said = words.structure
    yield Title(said.title)
    yield Caption(said.pairs)
    yield pair_table(mechanism, words, lettered=True)
    yield Caption(said.links)
    yield link_table(mechanism, words)
    yield Caption(said.formulas)
    yield from map(Item, mobility_formulas(mechanism, structure, words, notation))
    yield Caption(said.parts)
    driver, *counts = driver_caption(mechanism, words)
    yield Step((driver, "; ".join(counts)))
    for group in structure.groups:
        named, *counts = group_caption(group, words)
        yield Step((named, _joints(mechanism, group, words.note), "; ".join(counts)))
    yield from map(Item, order_formulas(mechanism, structure, words))
    yield Item(_static_counts(structure, words.note))


# Pairs and links -----------------------------------------------------------------------------


def pair_table(mechanism: Mechanism, words: Language, *, lettered: bool = False) -> Table:
    """Return the table of kinematic pairs (кинематические пары).

    ``lettered``: with the letter of each kind, by which `group_caption` calls it.
    """
    kinds = {kind: words.structure["pair_kinds"][kind.value] for kind in PairKind}
    if lettered:
        signs = {PairKind.REVOLUTE: "R", PairKind.PRISMATIC: "P"}
        kinds = {kind: f"{kinds[kind]} ({words.note['letters'][signs[kind]]})" for kind in kinds}
    rows = (
        (
            pair_letters(pair.name),
            " – ".join(map(mechanism.called, pair.links)),
            kinds[pair.kind],
            "V",
            "1",
        )
        for pair in pairs(mechanism)
    )
    return table_of(words.structure["columns_pairs"], rows, names=4)


def link_table(mechanism: Mechanism, words: Language) -> Table:
    """Return the table of links (звенья)."""
    every, said = pairs(mechanism), words.structure
    rows = (
        (
            mechanism.called(row.link),
            words.note["roles"][row.role.value],
            said["motions"][row.motion.value],
            ", ".join(pair_letters(pair.name) for pair in every if row.link in pair.links),
        )
        for row in kind_of_motion(mechanism)
    )
    return table_of(said["columns_links"], rows, names=4)


# Formulas ------------------------------------------------------------------------------------


def pair_classes(notation: str | None, words: Language) -> dict[str, str]:
    """Return the indices of the numbers of lower and higher pairs, as ``[sheet] notation`` says."""
    said = words.structure["notation"]
    lower, higher = said[notation or said["usual"]]
    return {"lower": lower, "higher": higher}


def mobility_formulas(
    mechanism: Mechanism, structure: Structure, words: Language, notation: str | None = None
) -> Iterator[Rich]:
    """Yield mobility and redundant constraints of the whole (подвижность, избыточные связи)."""
    said, low, spatial = words.structure, structure.lower_pairs, structure.spatial_mobility
    revolute = sum(pair.kind is PairKind.REVOLUTE for pair in pairs(mechanism))
    indices = pair_classes(notation, words)
    counts = {"n": structure.moving_links, "low": low, "high": structure.higher_pairs, **indices}
    yield said.counts.format(revolute=revolute, prismatic=low - revolute, **counts)
    yield said.chebyshev.format(w=signed(structure.mobility), **counts)
    yield said.spatial.format(w=signed(spatial), **counts)
    yield said.redundant.format(
        ways=WAYS_IN, local=LOCAL_MOBILITY, w=_bracketed(spatial), q=signed(structure.redundant)
    )


def order_formulas(mechanism: Mechanism, structure: Structure, words: Language) -> Iterator[Rich]:
    """Yield the structural formula, the class, the orders of both analyses (формула строения)."""
    said = words.structure
    first = f"I({mechanism.frame},{mechanism.driver})"
    steps = [f"{roman(group.class_number)}({','.join(group.links)})" for group in structure.groups]
    order, backwards = " → ".join([first, *steps]), " → ".join([*steps[::-1], first])
    yield said.formula.format(order=order)
    yield said.mechanism_class.format(roman=roman(structure.class_number))
    yield said.kinematic_order.format(order=order)
    yield said.force_order.format(order=backwards)


def _static_counts(structure: Structure, words: Words) -> Rich:
    """Return equations and unknowns of the force analysis: without friction as many as needed."""
    equations = 3 * structure.moving_links
    reactions = 2 * structure.lower_pairs + structure.higher_pairs
    unknowns = reactions + structure.mobility
    verdict = words.statically_determinate if equations == unknowns else words.statically_not
    return words.static_counts.format(
        n=structure.moving_links,
        equations=equations,
        pairs=reactions,
        w=signed(structure.mobility),
        unknowns=unknowns,
        verdict=verdict,
    )


def signed(number: int) -> str:
    """Return a whole number with the sign of print."""
    return f"{MINUS}{-number}" if number < 0 else str(number)


def _bracketed(number: int) -> str:
    return f"({signed(number)})" if number < 0 else str(number)


# Groups --------------------------------------------------------------------------------------


def driver_caption(mechanism: Mechanism, words: Language) -> list[Rich]:
    """Return name, mobility and redundant constraints of the driver (первичный механизм)."""
    ends = {FRAME, mechanism.driver}
    kind = next(pair.kind for pair in pairs(mechanism) if set(pair.links) == ends)
    said = words.structure
    links = _listed(mechanism.frame, mechanism.driver)
    named = said.primary.format(kind=said["pair_kinds"][kind.value], links=links)
    return [named, *_counts(WAYS_IN, 1, 1)]


def group_caption(group: AssurGroup, words: Language) -> list[Rich]:
    """Return class, order, kind, mobility and redundant constraints of a group."""
    count = len(group.leads) + sum(len(_inside(joint, group)) - 1 for joint in group.inner)
    said, kind = words.structure, words.structure["group_leads"].get(str(len(group.leads)), "")
    if group.kind is not None:
        signature = local_letters(group.signature, words.note)
        kind = said.group_kind.format(kind=group.kind, letters=signature)
    named = said.group.format(
        roman=roman(group.class_number), order=group.order, kind=kind, links=_listed(*group.links)
    )
    return [named, *_counts(0, len(group.links), count)]


def _counts(drivers: int, n: int, p: int) -> list[Rich]:
    """Return own mobility W and redundant constraints q of a part, with so many drivers."""
    w, q = 3 * n - 2 * p, drivers + LOCAL_MOBILITY - (6 * n - 5 * p)
    lines = (f"W = 3·{n} − 2·{p} = {signed(w)}", f"q = {drivers} − (6·{n} − 5·{p}) = {signed(q)}")
    return [line.replace(" ", NBSP) for line in lines]


def _listed(*links: str) -> str:
    return f",{NBSP}".join(links)


def _joints(mechanism: Mechanism, group: AssurGroup, words: Words) -> Rich:
    """Return the outer and the inner pairs of a group."""
    outer, inner = group_joints(mechanism, group, words)
    told = (
        words.joint_outer.format(joints=", ".join(outer)),
        words.joint_inner.format(joints=", ".join(inner)),
    )
    return "; ".join(told) + "."


def group_joints(
    mechanism: Mechanism, group: AssurGroup, words: Words
) -> tuple[list[Rich], list[Rich]]:
    """Return the outer and the inner pairs of a group, each by point, kind and links."""
    called = mechanism.called
    outer = [_joint(lead.joint, (called(lead.to), lead.link), words) for lead in group.leads]
    inner = [_joint(joint, _inside(joint, group), words) for joint in group.inner]
    return outer, inner


def _joint(joint: Joint, links: Sequence[str], words: Words) -> Rich:
    """Return a pair by its point, the letter of its kind and its links: ``B (В, 1–2)``."""
    point = joint.point if isinstance(joint, Revolute) else joint.pin
    return f"{pair_letters(point)} ({words['letters'][letter_of(joint)]}, {'–'.join(links)})"


def _inside(joint: Joint, group: AssurGroup) -> list[str]:
    return [link for link in group.links if link in links_of(joint)]


def local_letters(signature: str, words: Words) -> str:
    """Return a signature in the letters of a language: RPR is ВПВ in Russian."""
    return "".join(words["letters"].get(letter, letter) for letter in signature)


def group_title(group: AssurGroup, words: Words) -> Rich:
    """Return a group's heading: links, letters, class, order and kind."""
    links = "–".join(group.links)
    if group.kind is None:
        return words.higher_group.format(
            links=links, roman=roman(group.class_number), order=group.order
        )
    letters = local_letters(group.signature, words)
    return words.group.format(links=links, letters=letters, kind=group.kind)


def links_of_group(group: AssurGroup, words: Words) -> Rich:
    """Return a group by its links alone: ``Группа 4–5``."""
    return words.plain_group.format(links="–".join(group.links))
