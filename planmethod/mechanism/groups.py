"""Assur groups: what the decomposition of a mechanism yields (структурные группы)."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TypeAlias

from msgspec import Struct

from planmethod.mechanism.decompose import contours
from planmethod.mechanism.model import Mechanism, Prismatic, Revolute

Joint: TypeAlias = Revolute | Prismatic

DYADS = ("RRR", "RRP", "RPR", "PRP", "RPP")
"""Dyads (двухповодковые группы II класса) in the order of Artobolevsky's kinds 1 to 5."""


class OuterLeg(Struct, frozen=True):
    """Leg of a group: a link with its outer joint (поводок).

    ``to`` is the link outside the group, already known, on the other side of the joint (the frame,
    the driver or a link of an earlier group).
    """

    link: str
    joint: Joint
    to: str


class AssurGroup(Struct, frozen=True):
    """Group of zero mobility when joined to the frame (структурная группа, группа Ассура).

    Attributes
    ----------
    signature : str
        For a dyad the letters of its joints, outer-inner-outer, written as Artobolevsky's kinds
        are: RRR, RRP, RPR, PRP, RPP (never PRR or PPR). For a larger group, which is described by
        its class, the letters of its outer joints, a hyphen, and those of its inner joints, each
        sorted: ``RRR-RRR``.
    links : tuple of str
        In file order.
    legs : tuple of OuterLeg
        Outer joints; for a dyad exactly two, in the order of ``links``.
    inner : tuple of Joint
        Joints between links of the group. A hinge of several links is listed as a whole, although
        links of later groups may share it.
    class_number, order : int
        Class and order (класс, порядок) as Artobolevsky has them: a dyad is class 2, order 2.
    kind : int or None
        Kind of a dyad (вид): RRR 1, RRP 2, RPR 3, PRP 4, RPP 5; None for other classes.
    """

    signature: str
    links: tuple[str, ...]
    legs: tuple[OuterLeg, ...]
    inner: tuple[Joint, ...]
    class_number: int
    order: int
    kind: int | None


class Triad(Struct, frozen=True):
    """A triad: its base link and the three legs (трёхповодковая группа III класса).

    Attributes
    ----------
    base : str
        The base link (базисное звено), which all legs hold.
    legs : tuple of (OuterLeg, Joint)
        Each leg (поводок) by its outer joint, and the joint by which it holds the base.
    """

    base: str
    legs: tuple[tuple[OuterLeg, Joint], ...]


def triad_of(group: AssurGroup) -> Triad | None:
    """Return base link and legs of a triad; None for other groups and for a leg with two guides.

    A leg that slides at both ends does not let the base link turn on its own.
    """
    if len(group.links) != 4 or len(group.legs) != 3 or len(group.inner) != 3:
        return None
    outer = {lead.link for lead in group.legs}
    base = next((link for link in group.links if link not in outer), "")
    inner = {
        link: joint
        for joint in group.inner
        if base in (own := links_of(joint))
        for link in own
        if link in outer
    }
    if len(inner) != 3:
        return None
    legs = tuple((lead, inner[lead.link]) for lead in group.legs)
    if any(letter_of(lead.joint) == letter_of(joint) == "P" for lead, joint in legs):
        return None
    return Triad(base, legs)


def links_of(joint: Joint) -> tuple[str, ...]:
    """Links that a joint joins (звенья пары)."""
    if isinstance(joint, Revolute):
        return joint.links
    return (joint.slider, joint.host)


def letter_of(joint: Joint) -> str:
    """R of a revolute joint (вращательная пара, В), P of a prismatic one (поступательная, П)."""
    return "R" if isinstance(joint, Revolute) else "P"


def joints_of_links(mechanism: Mechanism) -> dict[str, list[tuple[int, Joint]]]:
    """Return the joints of every link, each with its number among all of them."""
    found: dict[str, list[tuple[int, Joint]]] = {link: [] for link in mechanism.links}
    joints: tuple[Joint, ...] = (*mechanism.revolutes, *mechanism.prismatics)
    for number, joint in enumerate(joints):
        for link in dict.fromkeys(links_of(joint)):
            found.setdefault(link, []).append((number, joint))
    return found


def make_group(
    joints_of: Mapping[str, Sequence[tuple[int, Joint]]],
    links: Sequence[str],
    known: Mapping[str, int],
) -> AssurGroup:
    """Describe a group from its links and the links known before it (структурная группа).

    Parameters
    ----------
    joints_of : mapping
        See `joints_of_links`.
    links : sequence of str
        Links of the group, in file order.
    known : mapping of str to int
        Links known before it, and when they became known: a leg on a hinge of several known links
        is joined to the first of them.
    """
    own = tuple(links)
    leads: list[OuterLeg] = []
    inner: list[Joint] = []
    for _, joint in sorted(
        {number: joint for link in own for number, joint in joints_of[link]}.items()
    ):
        ends = links_of(joint)
        inside = [link for link in own if link in ends]
        outside = [link for link in ends if link in known]
        if outside:
            to = min(outside, key=known.__getitem__)
            leads += [OuterLeg(link, joint, to) for link in inside]
        elif len(inside) > 1:
            inner.append(joint)
    leads.sort(key=lambda lead: own.index(lead.link))
    outer_letters = [letter_of(lead.joint) for lead in leads]
    inner_letters = [letter_of(joint) for joint in inner for _ in range(_pairs(joint, own))]
    if len(own) == 2:
        first, last = sorted(outer_letters, reverse=True)
        signature = first + inner_letters[0] + last
        return AssurGroup(
            signature, own, tuple(leads), tuple(inner), 2, 2, DYADS.index(signature) + 1
        )
    signature = "".join(sorted(outer_letters)) + "-" + "".join(sorted(inner_letters))
    class_number = _class_of(own, inner)
    return AssurGroup(signature, own, tuple(leads), tuple(inner), class_number, len(leads), None)


def _pairs(joint: Joint, links: Collection[str]) -> int:
    return sum(link in links for link in links_of(joint)) - 1


def _class_of(links: Collection[str], inner: Sequence[Joint]) -> int:
    """Class of a group larger than a dyad.

    A movable closed contour of k sides makes class k (IV and higher); a contour of three links is
    rigid and counts as the rigid base link of class III, which every other group has. Contours
    are the independent ones, as short as can be.
    """
    edges = [
        (("link", link), ("joint", i))
        for i, joint in enumerate(inner)
        for link in links_of(joint)
        if link in links
    ]
    # In the graph of links and joints a contour has as many edges at its links as at its joints.
    return max((len(contour) // 2 for contour in contours(edges)), default=3)
