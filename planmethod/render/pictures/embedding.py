"""Places of joints for a picture without scale (укладка структурной схемы).

A structural scheme shows only which links are joined, so its joints may be anywhere: they are
placed on a grid so that bars do not cross, angles are open and bars have similar lengths. Places
are complex, in grid units, y up; the frame is the row y = 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from random import Random
from typing import TypeAlias

import numpy as np
from msgspec import Struct, field
from numpy.typing import NDArray

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
