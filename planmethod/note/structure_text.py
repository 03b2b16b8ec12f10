"""Structural analysis in plain text: pairs, mobility, Assur groups (структурный анализ)."""

from __future__ import annotations

from planmethod.mechanism.groups import AssurGroup, Joint, links_of
from planmethod.mechanism.model import FRAME, Mechanism, Prismatic, Revolute
from planmethod.mechanism.structure import LOCAL_MOBILITY, WAYS_IN, Structure, roman
from planmethod.note.plaintext import heading, plain_text, table, wrap
from planmethod.note.wording import Wording, wording

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
        words.mechanism_class.format(roman=roman(structure.class_number)),
    ):
        lines += wrap(text, rest="  ")
    return "\n".join(lines)


def local_letters(signature: str, words: Wording) -> str:
    """Return a signature in the letters of a language: RPR is ВПВ in Russian."""
    return "".join(words.letters.get(letter, letter) for letter in signature)


# Pairs and links -----------------------------------------------------------------------------


def _pair_table(mechanism: Mechanism, words: Wording) -> list[str]:
    rows = []
    for revolute in mechanism.revolutes:
        one, *others = revolute.links
        rows += [[revolute.point, f"{one}–{other}", words.revolute, "1"] for other in others]
    for pair in mechanism.prismatics:
        rows.append([_name(pair, words), f"{pair.host}–{pair.slider}", words.prismatic, "1"])
    return table(words.columns_pairs, rows, left=3)


def _name(joint: Joint, words: Wording) -> str:
    """Return what a pair is called: its point, with the letter of its kind where it slides."""
    if isinstance(joint, Revolute):
        return joint.point
    return f"{joint.pin}{words.letters['P'].lower()}"


def _link_table(mechanism: Mechanism, words: Wording) -> list[str]:
    rows = [[FRAME, words.frame_name]]
    rows += [[link, _motion(mechanism, link, words)] for link in mechanism.links]
    return table(words.columns_link, rows, left=2)


def _motion(mechanism: Mechanism, link: str, words: Wording) -> str:
    """Return the kind of motion of a link as its pairs alone tell it."""
    if link in _translating(mechanism):
        return words.motion_translation
    for revolute in mechanism.revolutes:
        if link in revolute.links and FRAME in revolute.links:
            return words.motion_rotation.format(point=revolute.point)
    return words.motion_plane


def _translating(mechanism: Mechanism) -> set[str]:
    """Return the links joined with the frame by prismatic pairs alone: they do not turn."""
    found = {FRAME}
    for _ in mechanism.prismatics:
        for pair in mechanism.prismatics:
            if found & {pair.slider, pair.host}:
                found |= {pair.slider, pair.host}
    return found - {FRAME}


# Mobility ------------------------------------------------------------------------------------


def _mobility(structure: Structure, words: Wording) -> list[str]:
    numbers = {
        "n": structure.moving_links,
        "p1": structure.lower_pairs,
        "p2": structure.higher_pairs,
        "w": _signed(structure.mobility),
    }
    return [words.mobility_counts.format(**numbers), words.chebyshev.format(**numbers)]


def _redundant(structure: Structure, words: Wording) -> list[str]:
    w = _signed(structure.spatial_mobility)
    return [
        words.spatial.format(n=structure.moving_links, p1=structure.lower_pairs, w=w),
        words.reshetov.format(w=w, q=_signed(structure.redundant)),
    ]


def _signed(number: int) -> str:
    return str(number).translate(_MINUS)


# Groups --------------------------------------------------------------------------------------


def _counts(own: int, links: int, pairs: int, words: Wording) -> str:
    """Return own mobility W and redundant constraints q of a part, with ``own`` drivers."""
    mobility = 3 * links - 2 * pairs
    redundant = own + LOCAL_MOBILITY - (6 * links - 5 * pairs)
    w = words.own_mobility.format(n=links, p=pairs, w=_signed(mobility))
    q = words.own_redundant.format(w0=own, n=links, p=pairs, q=_signed(redundant))
    return f"   {w};  {q}"


def _primary(mechanism: Mechanism, words: Wording) -> list[str]:
    pair = next(
        joint
        for joint in (*mechanism.revolutes, *mechanism.prismatics)
        if {FRAME, mechanism.driver} <= set(links_of(joint))
    )
    text = words.primary.format(frame=FRAME, link=mechanism.driver, pair=_name(pair, words))
    return [*wrap(text), _counts(WAYS_IN, 1, 1, words)]


def _group(group: AssurGroup, words: Wording) -> list[str]:
    links, letters = "–".join(group.links), local_letters(group.signature, words)
    if group.kind is not None:
        text = words.assur_group.format(links=links, letters=letters, kind=group.kind)
    else:
        class_number = roman(group.class_number)
        text = words.assur_higher.format(
            links=links, letters=letters, roman=class_number, order=group.order
        )
    outer = ", ".join(
        f"{_name(lead.joint, words)} ({lead.to}–{lead.link})" for lead in group.leads
    )
    inner = ", ".join(
        f"{_name(joint, words)} ({'–'.join(_inside(joint, group))})" for joint in group.inner
    )
    pairs = len(group.leads) + sum(len(_inside(joint, group)) - 1 for joint in group.inner)
    joints = [words.joint_outer.format(joints=outer), words.joint_inner.format(joints=inner)]
    return [
        *wrap(text),
        *wrap("; ".join(joints) + ".", first="   ", rest="   "),
        _counts(0, len(group.links), pairs, words),
    ]


def _inside(joint: Revolute | Prismatic, group: AssurGroup) -> list[str]:
    return [link for link in group.links if link in links_of(joint)]


__all__ = ["local_letters", "plain_text", "structure_text"]
