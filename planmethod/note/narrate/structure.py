"""Structural analysis in plain text: pairs, mobility, Assur groups (структурный анализ)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.mechanism.describe import PairKind, kind_of_motion, pairs
from planmethod.mechanism.groups import AssurGroup, Joint, letter_of, links_of
from planmethod.mechanism.model import FRAME, Mechanism, Revolute
from planmethod.mechanism.structure import LOCAL_MOBILITY, WAYS_IN, Structure, roman
from planmethod.note.plaintext import heading, table, wrap
from planmethod.note.wording import Words, wording

_MINUS = str.maketrans("-", "−")


def structure_text(mechanism: Mechanism, structure: Structure, lang: str = "ru") -> str:
    """Tell the structural analysis of a mechanism with its numbers (структурный анализ).

    Raises
    ------
    UnknownLanguageError
    """
    words = wording(lang)
    lines = heading(words.structure_title, "═")
    lines += ["", words.pairs, *_pair_table(mechanism, words)]
    lines += ["", words.links, *_link_table(mechanism, words)]
    lines += ["", words.mobility, *_mobility(structure, words)]
    lines += ["", words.redundant, *_redundant(structure, words)]
    lines += ["", words.assur, *_primary(mechanism, words)]
    for group in structure.groups:
        lines += _group(group, words)
    order = [f"({','.join(group.links)})" for group in structure.groups]
    first = f"({FRAME},{mechanism.driver})"
    lines.append("")
    for text in (
        words.structural_formula.format(formula=structure.formula),
        words.kinematic_order.format(order=" → ".join([first, *order])),
        words.force_order.format(order=" → ".join([*order[::-1], first])),
        _static_counts(structure, words),
        words.mechanism_class.format(roman=roman(structure.class_number)),
    ):
        lines += wrap(text, rest="  ")
    return "\n".join(lines)


def _static_counts(structure: Structure, words: Words) -> str:
    """Return equations and unknowns of the force analysis: without friction as many as needed."""
    equations = 3 * structure.moving_links
    pairs = 2 * structure.lower_pairs + structure.higher_pairs
    unknowns = pairs + structure.mobility
    verdict = words.statically_determinate if equations == unknowns else words.statically_not
    return words.static_counts.format(
        n=structure.moving_links,
        equations=equations,
        pairs=pairs,
        w=_signed(structure.mobility),
        unknowns=unknowns,
        verdict=verdict,
    )


def local_letters(signature: str, words: Words) -> str:
    """Return a signature in the letters of a language: RPR is ВПВ in Russian."""
    return "".join(words["letters"].get(letter, letter) for letter in signature)


# Pairs and links -----------------------------------------------------------------------------


def _pair_table(mechanism: Mechanism, words: Words) -> list[str]:
    kinds = {PairKind.REVOLUTE: words.revolute, PairKind.PRISMATIC: words.prismatic}
    rows = [[pair.name, "–".join(pair.links), kinds[pair.kind], "1"] for pair in pairs(mechanism)]
    return table(words["columns_pairs"], rows, left=3)


def _link_table(mechanism: Mechanism, words: Words) -> list[str]:
    rows = [
        [row.link, words["roles"][row.role.value], words["motions"][row.motion.value]]
        for row in kind_of_motion(mechanism)
    ]
    return table(words["columns_link"], rows, left=3)


def _joint(joint: Joint, links: Sequence[str], words: Words) -> str:
    """Return a pair by its point, the letter of its kind and its links: ``B (В, 1–2)``."""
    point = joint.point if isinstance(joint, Revolute) else joint.pin
    return f"{point} ({words['letters'][letter_of(joint)]}, {'–'.join(links)})"


# Mobility ------------------------------------------------------------------------------------


def _mobility(structure: Structure, words: Words) -> list[str]:
    numbers = {
        "n": structure.moving_links,
        "p1": structure.lower_pairs,
        "p2": structure.higher_pairs,
        "w": _signed(structure.mobility),
    }
    return [words.mobility_counts.format(**numbers), words.chebyshev.format(**numbers)]


def _redundant(structure: Structure, words: Words) -> list[str]:
    w = _signed(structure.spatial_mobility)
    return [
        words.spatial.format(n=structure.moving_links, p1=structure.lower_pairs, w=w),
        words.reshetov.format(w=w, q=_signed(structure.redundant)),
    ]


def _signed(number: int) -> str:
    return str(number).translate(_MINUS)


# Groups --------------------------------------------------------------------------------------


def _counts(own: int, links: int, pairs: int, words: Words) -> str:
    """Return own mobility W and redundant constraints q of a part, with ``own`` drivers."""
    mobility = 3 * links - 2 * pairs
    redundant = own + LOCAL_MOBILITY - (6 * links - 5 * pairs)
    w = words.own_mobility.format(n=links, p=pairs, w=_signed(mobility))
    q = words.own_redundant.format(w0=own, n=links, p=pairs, q=_signed(redundant))
    return f"   {w};  {q}"


def _primary(mechanism: Mechanism, words: Words) -> list[str]:
    joints: tuple[Joint, ...] = (*mechanism.revolutes, *mechanism.prismatics)
    pair = next(joint for joint in joints if {FRAME, mechanism.driver} <= set(links_of(joint)))
    name = _joint(pair, (FRAME, mechanism.driver), words)
    text = words.primary.format(frame=FRAME, link=mechanism.driver, pair=name)
    return [*wrap(text), _counts(WAYS_IN, 1, 1, words)]


def _group(group: AssurGroup, words: Words) -> list[str]:
    links, letters = "–".join(group.links), local_letters(group.signature, words)
    if group.kind is not None:
        text = words.assur_group.format(links=links, letters=letters, kind=group.kind)
    else:
        class_number = roman(group.class_number)
        text = words.assur_higher.format(
            links=links, letters=letters, roman=class_number, order=group.order
        )
    outer = ", ".join(_joint(lead.joint, (lead.to, lead.link), words) for lead in group.leads)
    inner = ", ".join(_joint(joint, _inside(joint, group), words) for joint in group.inner)
    count = len(group.leads) + sum(len(_inside(joint, group)) - 1 for joint in group.inner)
    joints = [words.joint_outer.format(joints=outer), words.joint_inner.format(joints=inner)]
    return [
        *wrap(text),
        *wrap("; ".join(joints) + ".", first="   ", rest="   "),
        _counts(0, len(group.links), count, words),
    ]


def _inside(joint: Joint, group: AssurGroup) -> list[str]:
    return [link for link in group.links if link in links_of(joint)]


def group_title(group: AssurGroup, words: Words) -> str:
    """Return a group's heading: links, letters, class, order and kind."""
    links = "–".join(group.links)
    if group.kind is None:
        return words.higher_group.format(
            links=links, roman=roman(group.class_number), order=group.order
        )
    letters = local_letters(group.signature, words)
    return words.group.format(links=links, letters=letters, kind=group.kind)
