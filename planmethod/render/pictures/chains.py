"""Contents of a structural picture and places of its joints (кинематическая цепь, укладка)."""

from __future__ import annotations

from cmath import exp
from collections.abc import Iterable, Mapping, Sequence
from enum import Enum
from itertools import combinations, pairwise
from math import radians
from random import Random
from typing import TypeAlias

import numpy as np
from msgspec import Struct, field
from numpy.typing import NDArray

from planmethod.mechanism.groups import AssurGroup, Joint, driver_joint, links_of
from planmethod.mechanism.model import FRAME, Mechanism, Prismatic, Revolute
from planmethod.mechanism.structure import Structure, pairs
from planmethod.note.narrate.naming import pair_letters

Complexes: TypeAlias = NDArray[np.complex128]
Floats: TypeAlias = NDArray[np.float64]

_STARTS = 10  # random starts of the search; the first start is the wished order itself
_SWEEPS = 12
_STEP = 0.5
_ROWS = (1.0, 1.5, 2.0, 2.5, 3.0)

_CROSSING = 40.0
_CLOSE = 30.0  # per unit of missing distance
_MIN_NODE_GAP = 1.0  # between two joints
_MIN_BAR_GAP = 0.6  # between a joint and a bar of another link
_SHORTEST = 0.9
_ACUTE = 0.78  # cosine of the least angle between two bars in a joint
_ALTITUDE = 0.85  # least height of a triangle


class Bar(Struct, frozen=True):
    """Straight part of a link between two nodes (стержень); ``length`` is the length aimed at."""

    link: str
    start: str
    end: str
    length: float = 1.7


class SchemeGraph(Struct, frozen=True):
    """Graph to be embedded (граф структурной схемы).

    Attributes
    ----------
    nodes : tuple of str
        Nodes that may be placed freely.
    low : frozenset of str
        Nodes on the frame, in the row y = 0.
    between : mapping of str to (str, str, float)
        Nodes determined by two others: start + part·(end - start); each uses only earlier ones.
    bars : tuple of Bar
        A bar with a node on it is given as its two halves.
    faces : tuple of tuple of str
        Triangles (rigid links) whose inside stays empty.
    flat : frozenset of str
        Sliders on horizontal guides: bars should not leave them along the guide.
    wish : mapping of str to float
        Preferred x of a node: the order of formation.
    spread : frozenset of str
        Open joints, preferably far from the middle.
    """

    nodes: tuple[str, ...]
    low: frozenset[str] = frozenset()
    between: Mapping[str, tuple[str, str, float]] = field(default_factory=dict)
    bars: tuple[Bar, ...] = ()
    faces: tuple[tuple[str, ...], ...] = ()
    flat: frozenset[str] = frozenset()
    wish: Mapping[str, float] = field(default_factory=dict)
    spread: frozenset[str] = frozenset()


def places(graph: SchemeGraph, free: Mapping[str, complex]) -> dict[str, complex]:
    """Return the places of all nodes from those of the free ones, grid units."""
    found = dict(free)
    for name, (start, end, part) in graph.between.items():
        found[name] = found[start] + part * (found[end] - found[start])
    return found


def embed(graph: SchemeGraph) -> dict[str, complex]:
    """Find a place for every node (укладка графа), grid units.

    Coordinate descent over a grid from several starts; the best result counts. The same net gives
    the same places: the starts come from a fixed seed.
    """
    if len(graph.nodes) == 1:
        return places(graph, {graph.nodes[0]: 0j if graph.low else 1j})
    judge = _LayoutCost(graph)
    widest = max([*graph.wish.values(), 1.0]) + 1.0
    xs = np.arange(0.0, widest + 2.0 + 1e-9, _STEP)
    high = np.asarray(_ROWS if graph.low else (0.0, 0.5, *_ROWS))
    grid = (xs[:, None] + 1j * high[None, :]).ravel()
    row = xs.astype(np.complex128)
    random = Random(1)
    best: Complexes | None = None
    least = np.inf
    for start in range(_STARTS):
        free = np.array([_start(graph, name, random if start else None) for name in graph.nodes])
        free, cost = _descend(graph, judge, free, row, grid)
        if cost < least - 1e-6:
            best, least = free, cost
    assert best is not None
    return places(graph, {name: complex(z) for name, z in zip(graph.nodes, best, strict=True)})


def _start(graph: SchemeGraph, name: str, random: Random | None) -> complex:
    x = graph.wish.get(name, 0.0)
    y = 0.0 if name in graph.low else 1.5
    if random is not None:
        x += 3.0 * (random.random() - 0.5)
        y = 0.0 if name in graph.low else 1.0 + 2.0 * random.random()
    return complex(max(0.0, round(x / _STEP) * _STEP), round(y / _STEP) * _STEP)


def _descend(
    graph: SchemeGraph, layout_cost: _LayoutCost, free: Complexes, row: Complexes, grid: Complexes
) -> tuple[Complexes, float]:
    """Move one node after another to its cheapest place until the cost no longer falls."""
    cost = float(layout_cost.costs(free[None, :])[0])
    for _ in range(_SWEEPS):
        before = cost
        for k, name in enumerate(graph.nodes):
            tries = np.repeat(free[None, :], len(row if name in graph.low else grid), axis=0)
            tries[:, k] = row if name in graph.low else grid
            costs = layout_cost.costs(tries)
            pick = int(np.argmin(np.round(costs, 6)))
            if costs[pick] < cost - 1e-6:
                free, cost = tries[pick], float(costs[pick])
        if cost > before - 1e-6:
            break
    return free, cost


class _LayoutCost:
    """Cost of many layouts at once (оценка укладки): arrays of shape (layouts, nodes)."""

    def __init__(self, graph: SchemeGraph) -> None:
        names = [*graph.nodes, *graph.between]
        index = {name: k for k, name in enumerate(names)}
        self.graph = graph
        self.weights = _weights(graph, index)
        self.starts = np.array([index[bar.start] for bar in graph.bars], dtype=int)
        self.ends = np.array([index[bar.end] for bar in graph.bars], dtype=int)
        self.lengths = np.array([bar.length for bar in graph.bars])
        ends = [{bar.start, bar.end} for bar in graph.bars]
        couples = list(combinations(range(len(graph.bars)), 2))
        apart = [(s, t) for s, t in couples if not ends[s] & ends[t]]
        self.separate_bars = np.array(apart, dtype=int).reshape(-1, 2)
        # Two bars that meet: +1 where the bar starts in the common node, -1 where it ends there.
        meet = [
            (s, t, _end_sign(graph.bars[s], node), _end_sign(graph.bars[t], node))
            for s, t in couples
            if graph.bars[s].link != graph.bars[t].link
            for node in ends[s] & ends[t]
        ]
        self.meet = np.array(meet, dtype=int).reshape(-1, 4)
        solid = [name for name in names if ">" not in name]
        pairs = [(index[a], index[b]) for a, b in combinations(solid, 2)]
        self.pairs = np.array(pairs, dtype=int).reshape(-1, 2)
        near = [
            (index[name], s)
            for name in names
            for s, bar in enumerate(graph.bars)
            if name not in ends[s] and not _is_collinear(graph, name, bar)
        ]
        self.near = np.array(near, dtype=int).reshape(-1, 2)
        self.flat = np.array(
            [s for s, bar in enumerate(graph.bars) if ends[s] & graph.flat], dtype=int
        )
        self.faces = [
            tuple(index[name] for name in (face[0], face[k], face[k + 1]))
            for face in graph.faces
            for k in range(1, len(face) - 1)
        ]
        inside = [
            (f, s, _end_sign(bar, node))
            for f, face in enumerate(self.faces)
            for s, bar in enumerate(graph.bars)
            for node in ends[s]
            if index[node] in face and not {index[n] for n in ends[s]} <= set(face)
        ]
        self.inside = inside
        wished = [name for name in graph.nodes if name in graph.wish]
        self.wished = np.array([index[name] for name in wished], dtype=int)
        self.wishes = np.array([graph.wish[name] for name in wished])
        self.high = np.array([index[n] for n in graph.nodes if n not in graph.low], dtype=int)
        self.open = np.array([index[n] for n in graph.nodes if n in graph.spread], dtype=int)

    def costs(self, free: Complexes) -> Floats:
        """Return the cost of each layout of the free nodes, an array of shape (layouts,)."""
        z = free @ self.weights.T
        a, b = z[:, self.starts], z[:, self.ends]
        way = b - a
        size = np.maximum(np.abs(way), 1e-9)
        total: Floats = 0.4 * ((size - self.lengths) ** 2).sum(axis=1)
        total += _CLOSE * np.maximum(0.0, _SHORTEST * self.lengths / 1.7 - size).sum(axis=1)
        total += self._crossings(a, b)
        total += self._angles(way / size)
        total += self._closeness(z, a, way, size)
        total += self._insides(z, a, b)
        steep = np.abs((way / size).imag[:, self.flat])
        total += 8.0 * np.maximum(0.0, 0.5 - steep).sum(axis=1)
        total += 0.06 * ((z.real[:, self.wished] - self.wishes) ** 2).sum(axis=1)
        total += 0.05 * ((z.imag[:, self.high] - 1.5) ** 2).sum(axis=1)
        if len(self.open):
            middle = z.mean(axis=1, keepdims=True)
            total -= 0.25 * np.abs(z[:, self.open] - middle).sum(axis=1)
        return total

    def _crossings(self, a: Complexes, b: Complexes) -> Floats:
        s, t = self.separate_bars[:, 0], self.separate_bars[:, 1]
        p, q, r, u = a[:, s], b[:, s], a[:, t], b[:, t]
        one = _turn(p, q, r) * _turn(p, q, u)
        two = _turn(r, u, p) * _turn(r, u, q)
        found: Floats = _CROSSING * ((one < 0) & (two < 0)).sum(axis=1)
        return found

    def _angles(self, directions: Complexes) -> Floats:
        s, t = self.meet[:, 0], self.meet[:, 1]
        u, v = directions[:, s] * self.meet[:, 2], directions[:, t] * self.meet[:, 3]
        cosine = (u * v.conjugate()).real
        acute = np.maximum(0.0, cosine - _ACUTE) / (1 - _ACUTE)
        # Two links in one straight line look like one link.
        straight = np.maximum(0.0, -cosine - 0.94) / 0.06
        found: Floats = (12.0 * acute + 1.5 * straight).sum(axis=1)
        return found

    def _closeness(self, z: Complexes, a: Complexes, vectors: Complexes, size: Floats) -> Floats:
        gaps = np.abs(z[:, self.pairs[:, 0]] - z[:, self.pairs[:, 1]])
        total: Floats = _CLOSE * np.maximum(0.0, _MIN_NODE_GAP - gaps).sum(axis=1)
        node, s = self.near[:, 0], self.near[:, 1]
        along = vectors[:, s] / size[:, s]
        from_start = (z[:, node] - a[:, s]) * along.conjugate()
        beyond = from_start.real - np.clip(from_start.real, 0.0, size[:, s])
        distance = np.hypot(beyond, from_start.imag)
        total += _CLOSE * np.maximum(0.0, _MIN_BAR_GAP - distance).sum(axis=1)
        return total

    def _insides(self, z: Complexes, a: Complexes, b: Complexes) -> Floats:
        total = np.zeros(len(z))
        for face in self.faces:
            p, q, r = (z[:, k] for k in face)
            longest = np.maximum.reduce([np.abs(q - p), np.abs(r - q), np.abs(p - r)])
            height = np.abs(_turn(p, q, r)) / np.maximum(longest, 1e-9)
            total += _CLOSE * np.maximum(0.0, _ALTITUDE - height)
        for f, s, sense in self.inside:
            p, q, r = (z[:, k] for k in self.faces[f])
            tail, head = (a[:, s], b[:, s]) if sense > 0 else (b[:, s], a[:, s])
            probe = tail + 0.2 * (head - tail)
            signs = np.sign([_turn(p, q, probe), _turn(q, r, probe), _turn(r, p, probe)])
            total += _CROSSING * (np.abs(signs.sum(axis=0)) > 2.5)
        return total


def _weights(graph: SchemeGraph, index: Mapping[str, int]) -> Floats:
    """Return the matrix from the free nodes to all nodes."""
    count = len(graph.nodes)
    rows: list[Floats] = list(np.eye(count))
    for start, end, part in graph.between.values():
        rows.append((1 - part) * rows[index[start]] + part * rows[index[end]])
    return np.array(rows)


def _end_sign(bar: Bar, node: str) -> int:
    return 1 if bar.start == node else -1


def _is_collinear(graph: SchemeGraph, name: str, bar: Bar) -> bool:
    """Return whether a node lies on the line of a bar by construction."""
    ends = {bar.start, bar.end}
    if name in graph.between and ends & set(graph.between[name][:2]):
        return True
    return any(name in graph.between[end][:2] for end in ends if end in graph.between)


def _turn(p: Complexes, q: Complexes, r: Complexes) -> Floats:
    """Return twice the signed area of the triangle p, q, r."""
    area: Floats = ((q - p).conjugate() * (r - p)).imag
    return area


def sort_around(names: Sequence[str], at: Mapping[str, complex]) -> tuple[str, ...]:
    """Return nodes in the order of their directions from their middle (обход контура)."""
    middle = sum(at[name] for name in names) / len(names)
    return tuple(sorted(names, key=lambda name: float(np.angle(at[name] - middle))))


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
    rank = dict.fromkeys(mechanism.drivers, 0.0)
    for k, group in enumerate(structure.groups):
        rank |= dict.fromkeys(group.links, k + 1.0)
    return _chain(mechanism, seen, rank)


def driver_chain(mechanism: Mechanism, driver: str) -> Chain:
    """Return a driver with the frame (первичный механизм): one joint, the far end free."""
    first = driver_joint(mechanism, driver)
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
