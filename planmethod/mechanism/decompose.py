"""Graphs behind the structural analysis: matching, strong components, rigidity, contours.

A mechanism is written as a system of equations with coefficients not yet known: only which unknown
appears in which equation. A link has three unknowns, a shared moving point two; a point of a link
gives two equations, a prismatic pair two. All structural properties of a mechanism follow from this
bipartite graph.
"""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Hashable, Iterable, Mapping, Sequence

Node = Hashable


class Matching:
    """Matching of equations with unknowns that grows one equation at a time (паросочетание).

    An unknown is any hashable; an equation is an index into `supports`, the unknowns that stand
    in it.
    """

    def __init__(self) -> None:
        self.supports: list[tuple[Node, ...]] = []
        self.equation_of: dict[Node, int] = {}
        self._held: dict[int, Node] = {}  # the same the other way round

    def add(self, support: Sequence[Node]) -> bool:
        """Add an equation if an augmenting path gives it an unknown of its own."""
        self.supports.append(tuple(support))
        if self._augment(len(self.supports) - 1):
            return True
        self.supports.pop()
        return False

    def pop(self) -> None:
        """Take the last equation back."""
        self.supports.pop()
        del self.equation_of[self._held.pop(len(self.supports))]

    def reach(self, support: Sequence[Node]) -> set[Node]:
        """Unknowns that an equation could take over by alternating paths."""
        seen = set(support)
        queue = deque(support)
        while queue:
            equation = self.equation_of.get(queue.popleft())
            if equation is None:
                continue
            for unknown in self.supports[equation]:
                if unknown not in seen:
                    seen.add(unknown)
                    queue.append(unknown)
        return seen

    def _augment(self, start: int) -> bool:
        # Breadth first and without recursion: the shortest path, and no limit on its length.
        came: dict[Node, int] = {}
        queue = deque([start])
        while queue:
            equation = queue.popleft()
            for unknown in self.supports[equation]:
                if unknown in came:
                    continue
                came[unknown] = equation
                holder = self.equation_of.get(unknown)
                if holder is None:
                    self._shift(unknown, came, start)
                    return True
                queue.append(holder)
        return False

    def _shift(self, free: Node, previous: Mapping[Node, int], start: int) -> None:
        unknown = free
        while True:
            equation = previous[unknown]
            before = self._held.get(equation)
            self.equation_of[unknown], self._held[equation] = equation, unknown
            if equation == start:
                return
            assert before is not None
            unknown = before


class Rigidity:
    """Independent constraints between bodies of the plane (независимые связи).

    Laman's count for bars and joints: a set of constraints is independent when no part of it has
    more constraints than its unknowns less three, because a part that floats as a whole keeps the
    three freedoms of a rigid body. A matching alone overlooks that: two links with two common
    points match perfectly when both are joined to one hinge. The count is tested by adding every
    constraint together with three more copies of itself (the pebble game).
    """

    def __init__(self) -> None:
        self._matching = Matching()

    def add(self, support: Sequence[Node]) -> set[Node]:
        """Add a constraint; return the unknowns of the part that has it already, if any."""
        blocked = self._test(support)
        if blocked:
            return blocked
        self._matching.add(support)
        return set()

    def fixes(self, support: Sequence[Node]) -> bool:
        """Return whether one more constraint on these unknowns would be redundant."""
        return bool(self._test(support))

    def _test(self, support: Sequence[Node]) -> set[Node]:
        added = 0
        blocked: set[Node] = set()
        for _ in range(4):
            if not self._matching.add(support):
                blocked = self._matching.reach(support)
                break
            added += 1
        for _ in range(added):
            self._matching.pop()
        return blocked


def components(graph: Mapping[Node, Iterable[Node]]) -> list[list[Node]]:
    """Strongly connected components, by Tarjan without recursion (сильные компоненты)."""
    index: dict[Node, int] = {}
    low: dict[Node, int] = {}
    open_nodes: list[Node] = []
    is_open: set[Node] = set()
    found: list[list[Node]] = []
    for root in graph:
        if root in index:
            continue
        work = [(root, iter(graph[root]))]
        index[root] = low[root] = len(index)
        open_nodes.append(root)
        is_open.add(root)
        while work:
            node, successors = work[-1]
            for after in successors:
                if after not in index:
                    index[after] = low[after] = len(index)
                    open_nodes.append(after)
                    is_open.add(after)
                    work.append((after, iter(graph[after])))
                    break
                if after in is_open:
                    low[node] = min(low[node], index[after])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    component = []
                    while True:
                        last = open_nodes.pop()
                        is_open.discard(last)
                        component.append(last)
                        if last == node:
                            break
                    found.append(component)
    return found


def blocks(
    equations: Sequence[Sequence[Node]], size: Mapping[Node, int], rank: Mapping[Node, int]
) -> list[list[Node]] | None:
    """Irreducible blocks of a square system, in an order in which they can be solved.

    Parameters
    ----------
    equations : sequence of sequences
        Unknown nodes that appear in each equation.
    size : mapping
        How many scalar unknowns a node has.
    rank : mapping
        Blocks that do not depend on each other are sorted by their lowest rank; a block of nodes
        without a rank comes as early as possible.

    Returns
    -------
    list of lists, or None
        Nodes of each block (Dulmage and Mendelsohn's fine decomposition); None when the system
        has no perfect matching.
    """
    if len(equations) != sum(size.values()):
        return None
    matching = Matching()
    for support in equations:
        if not matching.add([(node, i) for node in support for i in range(size[node])]):
            return None
    # A node needs the other nodes of the equations that are matched with it.
    needs: dict[Node, set[Node]] = {node: set() for node in size}
    for unknown, equation in matching.equation_of.items():
        assert isinstance(unknown, tuple)
        needs[unknown[0]].update(equations[equation])
    for node, others in needs.items():
        others.discard(node)
    order = {node: i for i, node in enumerate(size)}
    found = components({node: sorted(needs[node], key=order.__getitem__) for node in size})
    home = {node: i for i, block in enumerate(found) for node in block}
    waits = [
        {home[n] for node in block for n in needs[node]} - {i} for i, block in enumerate(found)
    ]
    waiting: list[list[int]] = [[] for _ in found]
    for i, wait in enumerate(waits):
        for before in wait:
            waiting[before].append(i)
    first = [min((rank[node] for node in block if node in rank), default=-1) for block in found]
    ready = [(first[i], i) for i, wait in enumerate(waits) if not wait]
    heapq.heapify(ready)
    ordered = []
    while ready:
        _, done = heapq.heappop(ready)
        ordered.append(found[done])
        for i in waiting[done]:
            waits[i].discard(done)
            if not waits[i]:
                heapq.heappush(ready, (first[i], i))
    return ordered


def contours(edges: Sequence[tuple[Node, Node]]) -> list[list[tuple[Node, Node]]]:
    """Independent closed contours, as short as can be (минимальный базис контуров).

    Horton's algorithm: shortest cycles through every node and edge, the shortest taken first as
    long as they are independent modulo 2. The lengths do not depend on the order of the edges.
    """
    around: dict[Node, list[tuple[Node, int]]] = {}
    for i, (a, b) in enumerate(edges):
        around.setdefault(a, []).append((b, i))
        around.setdefault(b, []).append((a, i))
    candidates: set[int] = set()
    for root in around:
        paths = {root: 0}
        queue = deque([root])
        while queue:
            node = queue.popleft()
            for other, i in around[node]:
                if other not in paths:
                    paths[other] = paths[node] | 1 << i
                    queue.append(other)
        for i, (a, b) in enumerate(edges):
            if a in paths and not paths[a] & paths[b]:
                candidates.add(paths[a] ^ paths[b] ^ 1 << i)
    basis: dict[int, int] = {}
    found = []
    for cycle in sorted(candidates, key=lambda bits: (bits.bit_count(), bits)):
        rest = cycle
        while rest and rest.bit_length() in basis:
            rest ^= basis[rest.bit_length()]
        if rest:
            basis[rest.bit_length()] = rest
            found.append([edge for i, edge in enumerate(edges) if cycle >> i & 1])
    return found
