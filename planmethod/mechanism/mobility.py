"""Mechanisms that do not follow their driver, refused with a reason (подвижность)."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable

from planmethod.errors import StructureError
from planmethod.mechanism.decompose import Node, Rigidity
from planmethod.mechanism.model import FRAME, Mechanism, Prismatic


def refuse_immovable(mechanism: Mechanism) -> None:
    """Refuse a mechanism whose driver, connections or mobility are wrong.

    Raises
    ------
    StructureError
        With the links and numbers that are wrong and the next action.
    """
    _refuse_unconnected(mechanism)
    _refuse_driver(mechanism)
    _refuse_sliding_contour(mechanism)
    n, p1 = len(mechanism.links), mechanism.lower_pairs
    mobility = 3 * n - 2 * p1
    if mobility == 1:
        return
    text = f"Mobility W = 3n - 2p1 = 3·{n} - 2·{p1} = {mobility}, but 1 driver is given: "
    if mobility > 1:
        ends = [link for link in mechanism.links if _count_pairs(mechanism, link) == 1]
        ends = [link for link in ends if link != mechanism.driver]
        text += "pairs are missing. "
        if ends:
            text += f"{_name(ends).capitalize()} {_have(ends)} only one pair. "
        text += "Give the links more common points or slides, or remove the loose links."
    else:
        text += "there are too many pairs, or links are missing. "
        text += "Look for points given the same name by mistake and for slides given twice."
    raise StructureError(text)


def refuse_unbalanced(mechanism: Mechanism) -> None:
    """Refuse a mechanism of W = 1 with an overconstrained part and a loose one.

    Raises
    ------
    StructureError
        Naming the links of both.
    """
    driver = mechanism.driver
    turned = _Classes((FRAME, *mechanism.links))
    turned.join(FRAME, driver)
    tight: set[Node] = set()
    sliding: list[Prismatic] = []
    for pair in mechanism.prismatics:
        if {pair.slider, pair.host} == {FRAME, driver}:
            continue
        if not turned.join(pair.slider, pair.host):
            tight.update(_path(sliding, pair.slider, pair.host, bridge=(FRAME, driver)))
        sliding.append(pair)

    def place(link: str) -> tuple[Node, ...]:
        # Links joined by prismatic pairs alone turn together: one unknown for all of them. Frame
        # and driver, both known, are one body.
        body = FRAME if link == driver else link
        return (("x", body), ("y", body), ("turn", turned.find(link)))

    rigidity = Rigidity()
    constraints: list[tuple[Node, ...]] = []
    for revolute in mechanism.revolutes:
        point = (("x of", revolute.point), ("y of", revolute.point))
        links = [link for link in revolute.links if link != driver or FRAME not in revolute.links]
        for link in links:
            constraints += [(*place(link), *point)] * 2
    for pair in mechanism.prismatics:
        if {pair.slider, pair.host} != {FRAME, driver}:
            constraints.append(tuple(dict.fromkeys((*place(pair.slider), *place(pair.host)))))
    for constraint in constraints:
        for node in rigidity.add(constraint):
            if isinstance(node, tuple) and node[0] == "x":
                tight.add(node[1])
    if not tight:
        return
    loose = [
        link
        for link in mechanism.links
        if link != driver
        and not rigidity.fixes(tuple(dict.fromkeys((*place(link), *place(FRAME)))))
    ]
    if FRAME in tight:
        tight.add(driver)
    over = [link for link in (FRAME, *mechanism.links) if link in tight]
    raise StructureError(
        f"Mobility W = 3n - 2p1 = 1, but only by count: {_name(over)} {_have(over)} too many pairs "
        f"among themselves, while {_name(loose)} {_have(loose)} too few and do not follow the "
        "driver. Check which links share a point or a slide, and move a pair from the first to "
        "the second."
    )


def _refuse_unconnected(mechanism: Mechanism) -> None:
    near: dict[str, set[str]] = {link: set() for link in (FRAME, *mechanism.links)}
    for ends in _joined(mechanism):
        for link in ends:
            near[link].update(ends)
    reached = {FRAME}
    queue = deque([FRAME])
    while queue:
        for link in near[queue.popleft()] - reached:
            reached.add(link)
            queue.append(link)
    lost = [link for link in mechanism.links if link not in reached]
    if lost:
        raise StructureError(
            f"{_name(lost).capitalize()} {_are(lost)} not connected with the frame by any chain of "
            "pairs. Check the names of the points: links are joined by points that share a name, "
            "by slides and by the points of [frame]."
        )


def _refuse_driver(mechanism: Mechanism) -> None:
    driver = mechanism.driver
    if driver not in mechanism.links:
        raise StructureError(
            f"Driver {driver} is not among the moving links {', '.join(mechanism.links)}. "
            "Name one of them as the driving link."
        )
    pairs = _pairs_with_frame(mechanism, driver)
    if len(pairs) == 1:
        return
    if pairs:
        raise StructureError(
            f"Driver {driver} is joined with the frame by {len(pairs)} pairs ({', '.join(pairs)}) "
            "and cannot move. Keep one of them."
        )
    others = sorted({link for ends in _joined(mechanism) if driver in ends for link in ends})
    beside = [link for link in mechanism.links if link in others and link != driver]
    able = [link for link in mechanism.links if len(_pairs_with_frame(mechanism, link)) == 1]
    raise StructureError(
        f"Driver {driver} is not joined with the frame: its pairs are with {_name(beside)}. "
        + f"Drive a link that turns about a fixed point or slides on the frame: {_name(able)}."
    )


def _refuse_sliding_contour(mechanism: Mechanism) -> None:
    classes = _Classes((FRAME, *mechanism.links))
    before: list[Prismatic] = []
    for pair in mechanism.prismatics:
        if not classes.join(pair.slider, pair.host):
            contour = _path(before, pair.slider, pair.host)
            raise StructureError(
                f"{_name(contour).capitalize()} close a contour of {len(contour)} prismatic pairs "
                "only (PPP): it is not an Assur group, because nothing in it turns and one pair "
                "repeats what the others say of the angles. Make one of the pairs revolute."
            )
        before.append(pair)


class _Classes:
    """Classes of links that turn together."""

    def __init__(self, links: Iterable[str]) -> None:
        self._head = {link: link for link in links}

    def find(self, link: str) -> str:
        while self._head[link] != link:
            link = self._head[link]
        return link

    def join(self, one: str, other: str) -> bool:
        """Join two classes; False when they were one already."""
        a, b = self.find(one), self.find(other)
        self._head[a] = b
        return a != b


def _path(
    pairs: Iterable[Prismatic], start: str, end: str, *, bridge: tuple[str, str] | None = None
) -> list[str]:
    """Links of the shortest chain of prismatic pairs between two links."""
    edges = [(pair.slider, pair.host) for pair in pairs] + ([bridge] if bridge else [])
    came = {start: start}
    queue = deque([start])
    while queue:
        link = queue.popleft()
        for edge in edges:
            if link in edge:
                other = edge[0] if edge[1] == link else edge[1]
                if other not in came:
                    came[other] = link
                    queue.append(other)
    path = [end]
    while path[-1] != start:
        path.append(came[path[-1]])
    return sorted(path, key=_order)


def _order(link: str) -> tuple[int, str]:
    return (len(link), link)


def _joined(mechanism: Mechanism) -> list[tuple[str, ...]]:
    joined = [revolute.links for revolute in mechanism.revolutes]
    return joined + [(pair.slider, pair.host) for pair in mechanism.prismatics]


def _pairs_with_frame(mechanism: Mechanism, link: str) -> list[str]:
    found = [
        f"point {revolute.point}"
        for revolute in mechanism.revolutes
        if FRAME in revolute.links and link in revolute.links
    ]
    return found + [
        f"the slide of {pair.slider}"
        for pair in mechanism.prismatics
        if {pair.slider, pair.host} == {FRAME, link}
    ]


def _count_pairs(mechanism: Mechanism, link: str) -> int:
    return sum(link in ends for ends in _joined(mechanism))


def _name(links: Collection[str]) -> str:
    named = ["the frame" if link == FRAME else link for link in links]
    moving = [link for link in named if link != "the frame"]
    text = f"link{'s' if len(moving) != 1 else ''} {', '.join(moving)}"
    return text if len(moving) == len(named) else f"the frame and {text}"


def _are(links: Collection[str]) -> str:
    return "is" if len(links) == 1 else "are"


def _have(links: Collection[str]) -> str:
    return "has" if len(links) == 1 else "have"
