"""Assur groups: what the decomposition of a mechanism yields (структурные группы)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from planmethod.mechanism.model import Prismatic, Revolute

Joint: TypeAlias = Revolute | Prismatic


@dataclass(frozen=True, slots=True)
class Lead:
    """Link of a group with the outer joint it hangs on (поводок).

    ``to`` is the link outside the group, already known, on the other side of the joint (the frame,
    the driver or a link of an earlier group).
    """

    link: str
    joint: Joint
    to: str


@dataclass(frozen=True, slots=True)
class AssurGroup:
    """Group of zero mobility when joined to the frame (структурная группа, группа Ассура).

    Attributes
    ----------
    signature : str
        For a dyad the letters of its joints, outer-inner-outer, written as Artobolevsky's kinds
        are: RRR, RRP, RPR, PRP, RPP (never PRR or PPR). For a larger group its class in words is
        all that is known: the letters of its outer and inner joints, sorted.
    links : tuple of str
        In file order.
    leads : tuple of Lead
        Outer joints; for a dyad exactly two, in the order of ``links``.
    inner : tuple of Joint
        Joints between links of the group.
    class_number, order : int
        Class and order (класс, порядок) as Artobolevsky has them: a dyad is class 2, order 2.
    kind : int or None
        Kind of a dyad (вид): RRR 1, RRP 2, RPR 3, PRP 4, RPP 5; None for other classes.
    """

    signature: str
    links: tuple[str, ...]
    leads: tuple[Lead, ...]
    inner: tuple[Joint, ...]
    class_number: int
    order: int
    kind: int | None
