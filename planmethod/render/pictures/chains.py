"""Contents of a structural picture: joints, sliders and links as shapes (кинематическая цепь).

A chain is the whole mechanism, its driver, or one group taken apart with its outer joints open.
Everything here follows from the graph; `embedding` finds the places.
"""

from __future__ import annotations

from cmath import exp
from collections.abc import Iterable, Mapping, Sequence
from enum import Enum
from itertools import pairwise
from math import radians

from msgspec import Struct

from planmethod.mechanism.describe import pairs
from planmethod.mechanism.groups import AssurGroup, Joint, links_of
from planmethod.mechanism.model import FRAME, Mechanism, Prismatic, Revolute
from planmethod.mechanism.structure import Structure
from planmethod.note.narrate.letters import pair_letters
from planmethod.render.pictures.embedding import Bar, SchemeGraph, places


class JointEnd(Enum):
    """Kind of the other side of a joint."""

    CHAIN = "chain"  # another link of the same picture
    FRAME = "frame"
    OPEN = "open"  # a link that the picture leaves out


class Pin(Struct, frozen=True):
    """Revolute joint in a picture (шарнир); ``to`` is the link left out when it is open."""

    node: str
    links: tuple[str, ...]
    joint_end: JointEnd
    text: str
    to: str = ""
    count: int = 1


class DrawnSlide(Struct, frozen=True):
    """Prismatic joint in a picture: the stone is a rectangle, the bar a line through it.

    ``node`` is that of the stone's own pin when the stone has nothing else (then ``pinned``).
    """

    node: str
    block: str
    bar: str
    joint_end: JointEnd
    text: str
    to: str = ""
    pinned: bool = False


class Shape(Struct, frozen=True):
    """Link in a picture (звено).

    Attributes
    ----------
    outline : tuple of str
        Nodes: none for a stone, two for a bar, three and more for a rigid polygon.
    on : str
        Node of a stone between the two ends of the bar; empty when there is none.
    tips : tuple of (str, str)
        Parts that run from the first node to a stone at the second and beyond.
    """

    link: str
    outline: tuple[str, ...]
    on: str = ""
    tips: tuple[tuple[str, str], ...] = ()


class Chain(Struct, frozen=True):
    """Links of a picture with their joints (кинематическая цепь).

    ``replacing``: links that replace higher pairs, drawn as such.
    """

    pins: tuple[Pin, ...]
    slides: tuple[DrawnSlide, ...]
    shapes: tuple[Shape, ...]
    graph: SchemeGraph
    replacing: frozenset[str] = frozenset()

    def shape(self, link: str) -> Shape:
        """Return the shape of a link."""
        return next(shape for shape in self.shapes if shape.link == link)


def mechanism_chain(mechanism: Mechanism, structure: Structure) -> Chain:
    """Return the chain of the whole mechanism."""
    seen: list[_ChainJoint] = []
    joints: tuple[Joint, ...] = (*mechanism.revolutes, *mechanism.prismatics)
    for joint in joints:
        ends = links_of(joint)
        own = tuple(link for link in ends if link != FRAME)
        far = (JointEnd.FRAME, mechanism.frame) if FRAME in ends else (JointEnd.CHAIN,)
        seen.append(_ChainJoint(joint, own, *far))
    rank = {mechanism.driver: 0.0}
    for k, group in enumerate(structure.groups):
        rank |= dict.fromkeys(group.links, k + 1.0)
    return _chain(mechanism, seen, rank)


def driver_chain(mechanism: Mechanism) -> Chain:
    """Return the driver with the frame (первичный механизм): one joint, the far end free."""
    driver = mechanism.driver
    joints: tuple[Joint, ...] = (*mechanism.revolutes, *mechanism.prismatics)
    first = next(joint for joint in joints if {FRAME, driver} <= set(links_of(joint)))
    chain = _chain(
        mechanism, [_ChainJoint(first, (driver,), JointEnd.FRAME, mechanism.frame)], {driver: 0.0}
    )
    if isinstance(first, Prismatic):
        return chain
    pin = chain.pins[0].node
    shape = Shape(driver, (pin, f"{pin}>"))
    net = SchemeGraph((pin,), low=frozenset((pin,)), bars=(Bar(driver, pin, f"{pin}>"),))
    return Chain(chain.pins, (), (shape,), net)


def group_chain(mechanism: Mechanism, group: AssurGroup) -> Chain:
    """Return a group taken apart, its outer joints open (структурная группа)."""
    outer: dict[Joint, list[str]] = {}
    to = {lead.joint: mechanism.called(lead.to) for lead in group.legs}
    for lead in group.legs:
        outer.setdefault(lead.joint, []).append(lead.link)
    seen = [
        _ChainJoint(joint, tuple(own), JointEnd.OPEN, to[joint]) for joint, own in outer.items()
    ]
    for joint in group.inner:
        own = tuple(link for link in links_of(joint) if link in group.links)
        seen.append(_ChainJoint(joint, own, JointEnd.CHAIN))
    rank = {link: 0.7 * k for k, link in enumerate(group.links)}
    return _chain(mechanism, seen, rank)


class _ChainJoint(Struct, frozen=True):
    """Joint of a picture: its links in the picture, and the other side."""

    joint: Joint
    links: tuple[str, ...]
    joint_end: JointEnd
    to: str = ""


def _chain(mechanism: Mechanism, joints: Sequence[_ChainJoint], rank: Mapping[str, float]) -> Chain:
    count = dict.fromkeys(rank, 0)
    for one in joints:
        for link in one.links:
            count[link] += 1
    pins = [
        Pin(
            one.joint.point,
            one.links,
            one.joint_end,
            pair_letters(one.joint.point),
            one.to,
            len(one.links) - (one.joint_end is JointEnd.CHAIN),
        )
        for one in joints
        if isinstance(one.joint, Revolute)
    ]
    slides = _slides(mechanism, joints, pins, count)
    shapes, between = _shapes(rank, pins, slides)
    net = _build_graph(pins, slides, shapes, between, rank)
    replacing = frozenset(pair.by for pair in mechanism.higher)
    return Chain(tuple(pins), tuple(slides), tuple(shapes), net, replacing)


def _slides(
    mechanism: Mechanism,
    chain_joints: Sequence[_ChainJoint],
    pins: Sequence[Pin],
    count: Mapping[str, int],
) -> list[DrawnSlide]:
    """Return for every prismatic pair its stone and the node of the rectangle."""
    names = {(p.point, frozenset(p.links)): p.name for p in pairs(mechanism)}
    taken: set[str] = set()
    bars: set[str] = set()
    found: dict[_ChainJoint, DrawnSlide] = {}
    sliding = [one for one in chain_joints if isinstance(one.joint, Prismatic)]
    # Stones on moving links first: a slider of the frame is also clear at a place of its own.
    for one in sorted(sliding, key=lambda one: one.joint_end is not JointEnd.CHAIN):
        joint = one.joint
        assert isinstance(joint, Prismatic)
        choices = [link for link in (joint.slider, joint.host) if link in one.links]
        free = [
            (link, pin.node)
            for link in choices
            for pin in pins
            if link in pin.links and count[link] == 2 and pin.node not in taken
            if one.joint_end is not JointEnd.FRAME or pin.joint_end is JointEnd.CHAIN
        ]
        name = names[joint.pin, frozenset(links_of(joint))]
        if free:
            stone, node = free[0]
        else:
            lone = [link for link in choices if link not in bars]
            stone = choices[0]
            if len(choices) == 2 and choices[1] in bars and len(lone) == 1:
                stone = choices[1]
            node = f"{name}|"
        taken.add(node)
        bar = next((link for link in choices if link != stone), "")
        bars.add(bar)
        text = "" if free else pair_letters(name)
        found[one] = DrawnSlide(node, stone, bar, one.joint_end, text, one.to, bool(free))
    return [found[one] for one in sliding]


def _shapes(
    links: Iterable[str], pins: Sequence[Pin], slides: Sequence[DrawnSlide]
) -> tuple[list[Shape], dict[str, tuple[str, str, float]]]:
    """Return the links' shapes and the nodes that lie on a bar between two others."""
    between: dict[str, tuple[str, str, float]] = {}
    fixed = {pin.node for pin in pins if pin.joint_end is JointEnd.FRAME}
    fixed |= {slide.node for slide in slides if slide.joint_end is JointEnd.FRAME}
    shapes: list[Shape] = []
    for link in links:
        through = [slide.node for slide in slides if slide.bar == link]
        solid = [pin.node for pin in pins if link in pin.links and pin.node not in through]
        solid += [s.node for s in slides if s.block == link and s.node not in solid]
        outline, on = tuple(solid), ""
        tips: list[tuple[str, str]] = []
        if len(solid) == 2 and len(through) == 1:
            stone = through[0]
            if stone not in fixed and stone not in between and not _rests_on(between, stone, solid):
                between[stone] = (solid[0], solid[1], 0.5)
                on = stone
                through = []
        if len(solid) == 1:
            outline = ()
        if not solid and len(through) > 1:
            # A link that is a bar in all its pairs: its legs meet in a corner of its own.
            solid = [f"{link}+"]
        tips = [(solid[0], stone) for stone in through]
        shapes.append(Shape(link, outline, on, tuple(tips)))
    return shapes, between


def _rests_on(
    between: Mapping[str, tuple[str, str, float]], node: str, ends: Iterable[str]
) -> bool:
    """Return whether the place of one of the ends follows from the node's."""
    queue = list(ends)
    while queue:
        end = queue.pop()
        if end == node:
            return True
        if end in between:
            queue += between[end][:2]
    return False


def _build_graph(
    pins: Sequence[Pin],
    slides: Sequence[DrawnSlide],
    shapes: Sequence[Shape],
    between: Mapping[str, tuple[str, str, float]],
    rank: Mapping[str, float],
) -> SchemeGraph:
    """Return the graph to be embedded."""
    members: dict[str, list[str]] = {pin.node: list(pin.links) for pin in pins}
    for slide in slides:
        members.setdefault(slide.node, []).extend(x for x in (slide.block, slide.bar) if x)
    for shape in shapes:
        for start, _ in shape.tips:
            members.setdefault(start, [shape.link])
    everywhere: dict[str, tuple[str, str, float]] = {}
    while len(everywhere) < len(between):
        # A stone may lie between nodes that themselves lie between others: those first.
        everywhere |= {
            node: rule
            for node, rule in between.items()
            if all(end not in between or end in everywhere for end in rule[:2])
        }
    bars: list[Bar] = []
    faces: list[tuple[str, ...]] = []
    for shape in shapes:
        if shape.on:
            start, end = shape.outline
            bars += [Bar(shape.link, start, shape.on, 1.3), Bar(shape.link, shape.on, end, 1.3)]
        elif len(shape.outline) == 2:
            bars.append(Bar(shape.link, *shape.outline))
        elif shape.outline:
            ring = (*shape.outline, shape.outline[0])
            bars += [Bar(shape.link, a, b, 1.5) for a, b in pairwise(ring)]
            faces.append(shape.outline)
        for start, stone in shape.tips:
            tip = f"{shape.link}:{stone}>"
            everywhere[tip] = (start, stone, 1.4)
            bars += [Bar(shape.link, start, stone), Bar(shape.link, stone, tip, 0.6)]
    low = {pin.node for pin in pins if pin.joint_end is JointEnd.FRAME}
    low |= {slide.node for slide in slides if slide.joint_end is JointEnd.FRAME}
    wish = {
        node: 1.6 * sum(rank[link] for link in links) / len(links)
        for node, links in members.items()
    }
    every: tuple[Pin | DrawnSlide, ...] = (*pins, *slides)
    opened = {joint.node for joint in every if joint.joint_end is JointEnd.OPEN}
    return SchemeGraph(
        tuple(node for node in members if node not in between),
        frozenset(low),
        everywhere,
        tuple(bars),
        tuple(faces),
        frozenset(slide.node for slide in slides if slide.joint_end is JointEnd.FRAME),
        wish,
        frozenset(opened),
    )


def textbook_places(chain: Chain) -> dict[str, complex] | None:
    """Return the places that textbooks give to the joints of a group, grid units.

    There are such places for the five dyads and for the triad of revolute pairs.
    """
    if len(chain.shapes) == 2:
        return _dyad(chain)
    base = [shape for shape in chain.shapes if len(shape.outline) == 3 and not shape.on]
    bars = [shape for shape in chain.shapes if len(shape.outline) == 2 and not shape.on]
    if chain.slides or len(base) != 1 or len(base) + len(bars) != len(chain.shapes):
        return None
    corners = base[0].outline
    if any(pin.joint_end is JointEnd.OPEN for pin in chain.pins if pin.node in corners):
        return None
    # Three legs extend from the corners of the base link (трёхповодковая группа).
    found: dict[str, complex] = {}
    for corner, turn in zip(corners, (215.0, 90.0, -35.0), strict=True):
        found[corner] = 0.85 * exp(1j * radians(turn))
        for bar in bars:
            if corner in bar.outline:
                end = next(node for node in bar.outline if node != corner)
                found[end] = 2.2 * exp(1j * radians(turn - 14.0))
    return found if set(found) == set(chain.graph.nodes) else None


def _dyad(chain: Chain) -> dict[str, complex] | None:
    """Return the places of a dyad's joints, from the left to the right."""
    joints: tuple[Pin | DrawnSlide, ...] = (*chain.pins, *chain.slides)
    outer = [joint for joint in joints if joint.joint_end is JointEnd.OPEN]
    inner = next(joint for joint in joints if joint.joint_end is JointEnd.CHAIN)
    if len(outer) != 2 or len({joint.node for joint in outer}) != 2:
        return None
    outer.sort(key=lambda joint: isinstance(joint, DrawnSlide))
    first, last = outer
    if isinstance(inner, Pin) and inner.node not in (first.node, last.node):
        top = 1.1 + 1.25j if isinstance(last, Pin) else 1.2 + 1.0j
        return _complete_places(chain, {first.node: 0j, inner.node: top, last.node: 2.3 + 0j})
    if isinstance(inner, Pin):
        # The inner pin is on one of the sliders; the other is at the end of an arm.
        own, other = (first, last) if inner.node == first.node else (last, first)
        from_left = {own.node: 1.7 + 0j, other.node: 1.15j}
        mirrored = {own.node: 1.15j, other.node: 1.7 + 0j}
        return _complete_places(chain, from_left if own is last else mirrored)
    if isinstance(last, DrawnSlide):
        return _complete_places(chain, {last.node: 0j, inner.node: 1.5j})
    if inner.node in (first.node, last.node):
        return _complete_places(chain, {first.node: 0j, last.node: 1.7 + 1.15j})
    return None


def _complete_places(chain: Chain, free: dict[str, complex]) -> dict[str, complex] | None:
    """Return the places of all nodes if ``free`` has exactly the free ones, otherwise None."""
    return places(chain.graph, free) if set(free) == set(chain.graph.nodes) else None
