"""Assur groups, and the decomposition of a mechanism that yields them (структурные группы)."""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Collection, Hashable, Iterable, Mapping, Sequence
from typing import TypeAlias

from msgspec import Struct

from planmethod.mechanism.model import FRAME, Mechanism, Mesh, Prismatic, Revolute

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


Joint: TypeAlias = Revolute | Prismatic

TOOTHED = ("RZ", "PZ")
"""Groups of one link with a mesh: a wheel on its hinge, a rack on its guide."""

PASSIVE = "RR"
"""A crank that only repeats another one; it has two hinges and no freedom to find."""

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
        sorted: ``RRR-RRR``. A link that a mesh holds beside one lower pair has ``RZ`` (a wheel) or
        ``PZ`` (a rack): with the link that replaces the mesh it is a dyad.
    links : tuple of str
        In file order.
    legs : tuple of OuterLeg
        Outer joints; for a dyad exactly two, in the order of ``links``.
    inner : tuple of Joint
        Joints between links of the group. A hinge of several links is listed as a whole, although
        links of later groups may share it.
    class_number, order : int
        Class and order (класс, порядок) as Artobolevsky has them: a dyad is class 2, order 2. A
        wheel or a rack has those of the dyad that replaces it.
    kind : int or None
        Kind of a dyad (вид): RRR 1, RRP 2, RPR 3, PRP 4, RPP 5; None for other classes.
    mesh : str
        Pole of the mesh that holds a wheel or a rack.
    """

    signature: str
    links: tuple[str, ...]
    legs: tuple[OuterLeg, ...]
    inner: tuple[Joint, ...]
    class_number: int
    order: int
    kind: int | None
    mesh: str = ""

    @property
    def is_dyad(self) -> bool:
        """True for two links between two outer joints (двухповодковая группа)."""
        return self.signature in DYADS

    @property
    def is_toothed(self) -> bool:
        """True for a wheel or a rack that a mesh holds."""
        return self.signature in TOOTHED

    @property
    def is_passive(self) -> bool:
        """True for a crank that only repeats another one."""
        return self.signature == PASSIVE


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


def driver_joint(mechanism: Mechanism, driver: str) -> Joint:
    """Return the joint of a driving link with the frame."""
    joints: tuple[Joint, ...] = (*mechanism.revolutes, *mechanism.prismatics)
    return next(joint for joint in joints if {FRAME, driver} <= set(links_of(joint)))


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
    meshes: Iterable[Mesh] = (),
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
        is joined to the first of them. The leg of a wheel that rolls is joined to the link that
        replaces its contact, so that the others bear on that link as they do on the wheel.
    meshes : iterable of Mesh
        Meshes, one of which may hold a single link.
    """
    own, meshes = tuple(links), tuple(meshes)
    contacts = {mesh.carrier for mesh in meshes if mesh.rolls and {*mesh.links} & {*own}}
    leads: list[OuterLeg] = []
    inner: list[Joint] = []
    for _, joint in sorted(
        {number: joint for link in own for number, joint in joints_of[link]}.items()
    ):
        ends = links_of(joint)
        inside = [link for link in own if link in ends]
        outside = [link for link in ends if link in known]
        if outside:
            # The link in place of its contact bears a wheel that rolls.
            to = min(outside, key=lambda link: (link not in contacts, known[link]))
            leads += [OuterLeg(link, joint, to) for link in inside]
        elif len(inside) > 1:
            inner.append(joint)
    leads.sort(key=lambda lead: own.index(lead.link))
    outer_letters = [letter_of(lead.joint) for lead in leads]
    inner_letters = [letter_of(joint) for joint in inner for _ in range(_pairs(joint, own))]
    if len(own) == 1:
        letters = "".join(outer_letters)
        signature = letters if letters == PASSIVE else f"{letters}Z"
        held = (
            mesh.name
            for mesh in meshes
            if own[0] in mesh.links and {*mesh.joined} <= {*known, *own}
        )
        return AssurGroup(signature, own, tuple(leads), (), 2, 2, None, next(held, ""))
    if len(own) == 2 and len(leads) == 2 and len(inner_letters) == 1:
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
