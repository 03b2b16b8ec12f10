"""Tables of the structural analysis: kinematic pairs and kinds of motion, without words."""

from __future__ import annotations

from enum import Enum

from msgspec import Struct

from planmethod.mechanism.model import FRAME, Mechanism


class PairKind(Enum):
    """Relative motion in a pair (относительное движение)."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
    HIGHER = "higher"
    """Contact of profiles; not among `pairs`, which describe the replacing mechanism."""


class KinematicPair(Struct, frozen=True):
    """Row of the table of pairs (кинематическая пара).

    Attributes
    ----------
    name : str
        Designation, unique in the mechanism: the point's letter, with the links after it where
        the letter is taken already: ``B``, ``B(2,3)``.
    point : str
        Point of the hinge, or pin of the slider.
    links : tuple of two str
        The frame first, then in file order.
    kind : PairKind
    """

    name: str
    point: str
    links: tuple[str, str]
    kind: PairKind


def stated_pairs(mechanism: Mechanism) -> list[KinematicPair]:
    """Kinematic pairs as the problem states them: higher pairs and rollers, not their replacements.

    Returns
    -------
    list of KinematicPair
        As many as p1 and p2 of `planmethod.mechanism.structure.Structure`.
    """
    replacing = {pair.by for pair in mechanism.higher}
    rows = [pair for pair in pairs(mechanism) if not replacing & set(pair.links)]
    for pair in mechanism.higher:
        carrier = pair.links[1]
        touching = (pair.links[0], pair.roller or carrier)
        rows.append(KinematicPair(pair.name, pair.name, touching, PairKind.HIGHER))
        if pair.roller:
            ends = (carrier, pair.roller)
            rows.append(KinematicPair(pair.at, pair.at, ends, PairKind.REVOLUTE))
    return rows


class MotionKind(Enum):
    """Kind of a link's motion (вид движения)."""

    FIXED = "fixed"
    ROTATION = "rotation"
    TRANSLATION = "translation"
    PLANE = "plane"


class Role(Enum):
    """Textbook name of a link (название звена)."""

    FRAME = "frame"
    """Стойка."""
    CRANK = "crank"
    """Кривошип: the driver that turns about a fixed point."""
    ROCKER = "rocker"
    """Коромысло."""
    SLIDER = "slider"
    """Ползун: slides on the frame."""
    ROD = "rod"
    """Шатун: has no pair with the frame."""
    SLIDING_BLOCK = "stone"
    """Камень: slides on a moving link."""
    SLOTTED_LINK = "slotted link"
    """Кулиса: turns about a fixed point and slides along its sliding block."""


class LinkKind(Struct, frozen=True):
    """Row of the table of links (движение звена)."""

    link: str
    motion: MotionKind
    role: Role


def pairs(mechanism: Mechanism) -> list[KinematicPair]:
    """Kinematic pairs for the table of pairs (кинематические пары).

    A point shared by k links gives k - 1 revolute pairs, each of the first link (the frame where
    it is among them) with another one. Prismatic pairs follow the revolute ones.

    Returns
    -------
    list of KinematicPair
        As many as `Mechanism.lower_pairs`.
    """
    order = {link: i for i, link in enumerate((FRAME, *mechanism.links))}
    found: list[tuple[str, tuple[str, str], PairKind]] = []
    for joint in mechanism.revolutes:
        first, *others = joint.links
        found += [(joint.point, (first, other), PairKind.REVOLUTE) for other in others]
    for pair in mechanism.prismatics:
        one, two = sorted((pair.slider, pair.host), key=order.__getitem__)
        found.append((pair.pin, (one, two), PairKind.PRISMATIC))
    rows: list[KinematicPair] = []
    taken: set[str] = set()
    for point, links, kind in found:
        printed = ",".join(map(mechanism.called, links))
        name = f"{point}({printed})" if point in taken else point
        taken.add(point)
        rows.append(KinematicPair(name, point, links, kind))
    return rows


def kind_of_motion(mechanism: Mechanism) -> list[LinkKind]:
    """Motion and textbook name of every link, the frame first (виды движения звеньев).

    Only the pairs are taken into account: a driven link on a fixed hinge is called a rocker, though
    with other lengths it might turn all the way round. When a slider and a moving link form a pair,
    the sliding block is the one without a third pair; if both have none, it is the one that the
    file calls the slider.
    """
    turning = {
        link for joint in mechanism.revolutes if FRAME in joint.links for link in joint.links
    }
    sliding = _translating(mechanism)
    on_frame = {
        link
        for pair in mechanism.prismatics
        if FRAME in (pair.slider, pair.host)
        for link in (pair.slider, pair.host)
    }
    stones, partners = _sliding_blocks(mechanism)
    rows = [LinkKind(FRAME, MotionKind.FIXED, Role.FRAME)]
    for link in mechanism.links:
        if link in sliding:
            motion = MotionKind.TRANSLATION
            role = Role.SLIDER if link in on_frame else Role.SLIDING_BLOCK
        elif link in turning:
            motion = MotionKind.ROTATION
            role = Role.ROCKER
            if link == mechanism.driver:
                role = Role.CRANK
            elif link in stones:
                role = Role.SLIDING_BLOCK
            elif link in partners:
                role = Role.SLOTTED_LINK
        else:
            motion = MotionKind.PLANE
            role = Role.SLIDING_BLOCK if link in stones else Role.ROD
        rows.append(LinkKind(link, motion, role))
    return rows


def _translating(mechanism: Mechanism) -> set[str]:
    """Links that prismatic pairs alone join with the frame."""
    found = {FRAME}
    grown = True
    while grown:
        grown = False
        for pair in mechanism.prismatics:
            ends = {pair.slider, pair.host}
            if len(ends & found) == 1:
                found |= ends
                grown = True
    return found - {FRAME}


def _sliding_blocks(mechanism: Mechanism) -> tuple[set[str], set[str]]:
    """Sliding blocks of the pairs between moving links, and the links that they slide on."""
    count = dict.fromkeys((FRAME, *mechanism.links), 0)
    for joint in mechanism.revolutes:
        for link in joint.links:
            count[link] += 1
    for pair in mechanism.prismatics:
        count[pair.slider] += 1
        count[pair.host] += 1
    stones: set[str] = set()
    partners: set[str] = set()
    for pair in mechanism.prismatics:
        ends = (pair.slider, pair.host)
        if FRAME in ends:
            continue
        small = [link for link in ends if count[link] == 2 and link != mechanism.driver]
        if small:
            stones.add(small[0])
            partners.update(link for link in ends if link != small[0])
        else:
            partners.update(ends)
    return stones, partners - stones
