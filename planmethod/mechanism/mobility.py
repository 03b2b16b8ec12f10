"""Mechanisms that do not follow their driver, refused with a reason (подвижность)."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable

from msgspec.structs import replace

from planmethod.errors import StructureError
from planmethod.languages import translate
from planmethod.mechanism.decompose import Node, Rigidity
from planmethod.mechanism.model import FRAME, Mechanism, Prismatic, Revolute


def reject_immovable(mechanism: Mechanism) -> None:
    """Reject a mechanism whose driver, connections or mobility are wrong.

    Raises
    ------
    StructureError
        With the links and numbers that are wrong and the next action.
    """
    _reject_unconnected(mechanism)
    _reject_driver(mechanism)
    _reject_sliding_contour(mechanism)
    n, p1 = len(mechanism.links), mechanism.lower_pairs
    mobility = 3 * n - 2 * p1
    if mobility == 1:
        return
    if mobility > 1:
        ends = [link for link in mechanism.links if _count_pairs(mechanism, link) == 1]
        ends = [link for link in ends if link != mechanism.driver]
        loose = ""
        if ends:
            loose = translate(
                "{0} {1:|has|have} only one pair. ", _name(ends).capitalize(), len(ends)
            )
        cause = translate(
            "pairs are missing. {}Give the links more common points or slides, or remove the loose "
            "links.",
            loose,
        )
    else:
        cause = translate(
            "there are too many pairs, or links are missing. Look for points given the same name "
            "by mistake and for slides given twice."
        )
        passive = _passive(mechanism) if not mobility else []
        if passive:
            more = translate(
                " A link that only repeats the motion of the others is passive, as the third crank "
                "of a parallelogram is: leave one such out. Without link {} W is 1.",
                translate(" or ").join(passive),
            )
            cause = f"{cause}{more}"
    text = "Mobility W = 3n - 2p1 = 3·{} - 2·{} = {}, but 1 driver is given: {}"
    raise StructureError(text, n, p1, mobility, cause)


def reject_unbalanced(mechanism: Mechanism) -> None:
    """Reject a mechanism of W = 1 with an overconstrained part and a loose one.

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
        "Mobility W = 3n - 2p1 = 1, but only by count: {0} {1:|has|have} too many pairs among "
        "themselves, while {2} {3:|has|have} too few and do not follow the driver. Check which "
        "links share a point or a slide, and move a pair from the first to the second.",
        _name(over),
        len(over),
        _name(loose),
        len(loose),
    )


def _reject_unconnected(mechanism: Mechanism) -> None:
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
            "{0} {1:|is|are} not connected with the frame by any chain of pairs. Check the "
            "names of the points: links are joined by points that share a name, by slides and "
            "by the points of [frame].",
            _name(lost).capitalize(),
            len(lost),
        )


def _reject_driver(mechanism: Mechanism) -> None:
    driver = mechanism.driver
    if driver not in mechanism.links:
        raise StructureError(
            "Driver {} is not among the moving links {}. Name one of them as the driving link.",
            driver,
            ", ".join(mechanism.links),
        )
    pairs = _pairs_with_frame(mechanism, driver)
    if len(pairs) == 1:
        return
    if pairs:
        raise StructureError(
            "Driver {} is joined with the frame by {} pairs ({}) and cannot move. Keep "
            "one of them.",
            driver,
            len(pairs),
            ", ".join(
                translate("point {}", pair.point)
                if isinstance(pair, Revolute)
                else translate("the slide of {}", pair.slider)
                for pair in pairs
            ),
        )
    others = sorted({link for ends in _joined(mechanism) if driver in ends for link in ends})
    beside = [link for link in mechanism.links if link in others and link != driver]
    able = [link for link in mechanism.links if len(_pairs_with_frame(mechanism, link)) == 1]
    raise StructureError(
        "Driver {} is not joined with the frame: its pairs are with {}. Drive a link that "
        "turns about a fixed point or slides on the frame: {}.",
        driver,
        _name(beside),
        _name(able),
    )


def _reject_sliding_contour(mechanism: Mechanism) -> None:
    classes = _Classes((FRAME, *mechanism.links))
    before: list[Prismatic] = []
    for pair in mechanism.prismatics:
        if not classes.join(pair.slider, pair.host):
            contour = _path(before, pair.slider, pair.host)
            raise StructureError(
                "{} form a contour of {} prismatic pairs only (PPP): it is not an Assur "
                "group, because its links do not turn and one pair repeats the constraints "
                "of the others on the angles. Make one of the pairs revolute.",
                _name(contour).capitalize(),
                len(contour),
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

    def join(self, one: str, two: str) -> bool:
        """Join two classes; False when they were one already."""
        a, b = self.find(one), self.find(two)
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


def _passive(mechanism: Mechanism) -> list[str]:
    """Return the two-hinge links that can be removed leaving the others with a definite motion.

    The lengths decide whether such a link is passive (пассивное звено).
    """
    found = []
    for link in mechanism.links:
        hinges = [one for one in mechanism.revolutes if link in one.links]
        slides = [one for one in mechanism.prismatics if link in (one.slider, one.host)]
        if link == mechanism.driver or slides or len(hinges) != 2:
            continue
        left = [
            replace(one, links=tuple(name for name in one.links if name != link))
            for one in mechanism.revolutes
        ]
        rest = replace(
            mechanism,
            links=tuple(name for name in mechanism.links if name != link),
            revolutes=tuple(one for one in left if len(one.links) > 1),
        )
        if len(rest.links) < 2:
            continue
        try:
            reject_immovable(rest)
            reject_unbalanced(rest)
        except StructureError:
            continue
        found.append(link)
    return found


def _order(link: str) -> tuple[int, str]:
    return (len(link), link)


def _joined(mechanism: Mechanism) -> list[tuple[str, ...]]:
    joined = [revolute.links for revolute in mechanism.revolutes]
    return joined + [(pair.slider, pair.host) for pair in mechanism.prismatics]


def _pairs_with_frame(mechanism: Mechanism, link: str) -> list[Revolute | Prismatic]:
    turning = [pair for pair in mechanism.revolutes if {FRAME, link} <= {*pair.links}]
    sliding = [pair for pair in mechanism.prismatics if {pair.slider, pair.host} == {FRAME, link}]
    return [*turning, *sliding]


def _count_pairs(mechanism: Mechanism, link: str) -> int:
    return sum(link in ends for ends in _joined(mechanism))


def _name(links: Collection[str]) -> str:
    moving = [link for link in links if link != FRAME]
    text = translate("link{0:||s} {1}", len(moving), ", ".join(moving))
    return text if len(moving) == len(links) else translate("the frame and {}", text)
