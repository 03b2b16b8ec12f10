"""Structure of a mechanism from its links and joints alone; mobility (структурный анализ)."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable, Sequence
from enum import Enum

from msgspec import Struct
from msgspec.structs import replace

from planmethod.errors import StructureError
from planmethod.languages import translate
from planmethod.mechanism.groups import (
    AssurGroup,
    Node,
    Rigidity,
    blocks,
    joints_of_links,
    make_group,
)
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
    n, p1, p2 = len(mechanism.links), mechanism.lower_pairs, len(mechanism.meshes)
    mobility, drivers = 3 * n - 2 * p1 - p2, len(mechanism.drivers)
    if mobility == drivers:
        return
    if mobility > drivers:
        ends = [link for link in mechanism.links if _count_pairs(mechanism, link) == 1]
        ends = [link for link in ends if link not in mechanism.drivers]
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
        able = _able(mechanism) if mobility == drivers + 1 and not ends else []
        if able:
            text = " Or give the motion of {} too: [[drivers]] is a list of driving links."
            cause += translate(text, translate(" or ").join(able))
    else:
        cause = translate(
            "the mechanism has too many pairs, or links are missing. Check for points with "
            "the same name and for slides given twice."
        )
        passive = passive_links(mechanism) if not mobility else []
        if passive:
            more = translate(
                " A link that only repeats the motion of the others is passive, as the third crank "
                "of a parallelogram is: leave one such out. Without link {} W is 1.",
                translate(" or ").join(passive),
            )
            cause = f"{cause}{more}"
    if p2:
        text = (
            "Mobility W = 3n - 2p1 - p2 = 3·{0} - 2·{1} - {2} = {3}, "
            "but {4} driver{4:||s} {4:|is|are} given: {5}"
        )
        raise StructureError(text, n, p1, p2, mobility, drivers, cause)
    text = (
        "Mobility W = 3n - 2p1 = 3·{0} - 2·{1} = {2}, but {3} driver{3:||s} {3:|is|are} given: {4}"
    )
    raise StructureError(text, n, p1, mobility, drivers, cause)


def _able(mechanism: Mechanism) -> list[str]:
    """Return the other links that could drive: those with one pair on the frame."""
    return [
        link
        for link in mechanism.links
        if link not in mechanism.drivers and len(_pairs_with_frame(mechanism, link)) == 1
    ]


def reject_unbalanced(mechanism: Mechanism) -> None:
    """Reject a mechanism of W = 1 with an overconstrained part and a loose one.

    Raises
    ------
    StructureError
        Naming the links of both.
    """
    drivers = mechanism.drivers
    turned = _Classes((FRAME, *mechanism.links))
    for driver in drivers:
        turned.join(FRAME, driver)
    driven = [{FRAME, driver} for driver in drivers]
    tight: set[Node] = set()
    sliding: list[Prismatic] = []
    for pair in mechanism.prismatics:
        if {pair.slider, pair.host} in driven:
            continue
        if not turned.join(pair.slider, pair.host):
            bridges = [(FRAME, driver) for driver in drivers]
            tight.update(_path(sliding, pair.slider, pair.host, bridges=bridges))
        sliding.append(pair)

    def place(link: str) -> tuple[Node, ...]:
        # Links joined by prismatic pairs alone turn together: one unknown for all of them. Frame
        # and driver, both known, are one body.
        body = FRAME if link in drivers else link
        return (("x", body), ("y", body), ("turn", turned.find(link)))

    rigidity = Rigidity()
    constraints: list[tuple[Node, ...]] = []
    for revolute in mechanism.revolutes:
        point = (("x of", revolute.point), ("y of", revolute.point))
        links = [
            link for link in revolute.links if link not in drivers or FRAME not in revolute.links
        ]
        for link in links:
            constraints += [(*place(link), *point)] * 2
    for pair in mechanism.prismatics:
        if {pair.slider, pair.host} not in driven:
            constraints.append(tuple(dict.fromkeys((*place(pair.slider), *place(pair.host)))))
    for mesh in mechanism.meshes:
        held = (node for link in mesh.joined for node in place(link))
        constraints.append(tuple(dict.fromkeys(held)))
    for constraint in constraints:
        for node in rigidity.add(constraint):
            if isinstance(node, tuple) and node[0] == "x":
                tight.add(node[1])
    if not tight:
        return
    loose = [
        link
        for link in mechanism.links
        if link not in drivers
        and not rigidity.fixes(tuple(dict.fromkeys((*place(link), *place(FRAME)))))
    ]
    if FRAME in tight:
        tight.update(drivers)
    over = [link for link in (FRAME, *mechanism.links) if link in tight]
    raise StructureError(
        "Mobility W = 3n - 2p1 = {4}, but only by count: {0} {1:|has|have} too many pairs among "
        "themselves, while {2} {3:|has|have} too few and do not follow the driver. Check which "
        "links share a point or a slide, and move a pair from the first to the second.",
        _name(over),
        len(over),
        _name(loose),
        len(loose),
        len(drivers),
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
    for driver in mechanism.drivers:
        _reject_one_driver(mechanism, driver)


def _reject_one_driver(mechanism: Mechanism, driver: str) -> None:
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
    pairs: Iterable[Prismatic], start: str, end: str, *, bridges: Sequence[tuple[str, str]] = ()
) -> list[str]:
    """Links of the shortest chain of prismatic pairs between two links."""
    edges = [(pair.slider, pair.host) for pair in pairs] + [*bridges]
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


def passive_links(mechanism: Mechanism) -> list[str]:
    """Return the two-hinge links that can be removed leaving the others with a definite motion.

    The lengths decide whether such a link is passive (пассивное звено).
    """
    found = []
    for link in mechanism.links:
        hinges = [one for one in mechanism.revolutes if link in one.links]
        slides = [one for one in mechanism.prismatics if link in (one.slider, one.host)]
        wheels = [one for one in mechanism.meshes if link in one.joined]
        if link in mechanism.drivers or slides or wheels or len(hinges) != 2:
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
    meshes = sum(link in mesh.links for mesh in mechanism.meshes)
    return sum(link in ends for ends in _joined(mechanism)) + meshes


def _name(links: Collection[str]) -> str:
    moving = [link for link in links if link != FRAME]
    text = translate("link{0:||s} {1}", len(moving), ", ".join(moving))
    return text if len(moving) == len(links) else translate("the frame and {}", text)


class Structure(Struct, frozen=True):
    """Result of the structural analysis (структурный анализ).

    Attributes
    ----------
    mobility : int
        W = 3n - 2p1 - p2 by Chebyshev.
    moving_links, lower_pairs, higher_pairs : int
        n, p1, p2 of the mechanism with its higher pairs and rollers, not of that which replaces it.
    spatial_mobility : int
        W of the spatial scheme, 6n - 5p1 - 2p4 (Somov and Malyshev); profiles touch along a line.
    redundant : int
        q = W0 + W_M - W_spatial (избыточные связи), W0 the number of drivers.
    local_mobility : int
        W_M, rollers that turn about themselves (местные подвижности).
    class_number : int
        Highest class of the groups; 1 when there is none.
    groups : tuple of AssurGroup
        In the order of kinematic analysis.
    driver_count : int
        W0.
    formula : str
        ``I(0,1) → II(2,3) → II(4,5)``.
    """

    mobility: int
    moving_links: int
    lower_pairs: int
    higher_pairs: int
    spatial_mobility: int
    redundant: int
    local_mobility: int
    class_number: int
    groups: tuple[AssurGroup, ...]
    formula: str
    driver_count: int = 1

    @property
    def force_order(self) -> tuple[AssurGroup, ...]:
        """Groups in the order of force analysis (порядок силового расчёта): the last first."""
        return self.groups[::-1]

    def group_of(self, link: str) -> AssurGroup | None:
        """Group that a link belongs to; None for the driver and the frame."""
        return next((group for group in self.groups if link in group.links), None)


def analyse(mechanism: Mechanism) -> Structure:
    """Decompose a mechanism into its driver and Assur groups (структурный анализ по Ассуру).

    Links (three unknowns each) and shared moving points (two each) on one side, points of links and
    prismatic pairs (two equations each) on the other make a square system as soon as frame and
    driver are known. The irreducible blocks of its Dulmage-Mendelsohn decomposition are the Assur
    groups. A point shared by k links is closed by the group that can reach it first, and links of
    later groups are joined to it.

    Parameters
    ----------
    mechanism : Mechanism
        One driver, joined with the frame by one pair.

    Returns
    -------
    Structure
        Groups in the order of kinematic analysis, groups that do not depend on each other in file
        order.

    Raises
    ------
    StructureError
        If links are not connected with the frame, the driver is not joined with it, W is not 1,
        prismatic pairs alone close a contour, or a part is overconstrained while another is loose.
    """
    active, rolling = mechanism.active, len(mechanism.rolling)
    reject_immovable(active)
    reject_unbalanced(active)
    groups = _groups(active)
    replaced = len(mechanism.higher)
    high = replaced + len(mechanism.meshes) - rolling
    local = sum(pair.roller != "" for pair in mechanism.higher)
    n = len(active.links) - replaced + local - rolling
    p1 = active.lower_pairs - 2 * replaced + local - rolling
    spatial = 6 * n - 5 * p1 - 2 * high
    parts = [driver_formula(mechanism)]
    parts += [f"{roman(group.class_number)}({','.join(group.links)})" for group in groups]
    passive = tuple(_repeating(mechanism, one.link) for one in mechanism.passive)
    return Structure(
        mobility=3 * n - 2 * p1 - high,
        moving_links=n,
        lower_pairs=p1,
        higher_pairs=high,
        spatial_mobility=spatial,
        redundant=len(mechanism.drivers) + local - spatial,
        local_mobility=local,
        class_number=max((group.class_number for group in groups), default=1),
        groups=(*groups, *passive),
        formula=" → ".join(parts),
        driver_count=len(mechanism.drivers),
    )


def _repeating(mechanism: Mechanism, link: str) -> AssurGroup:
    """Describe a passive link, which the plans place last."""
    known = {name: i for i, name in enumerate((FRAME, *mechanism.active.links))}
    return make_group(joints_of_links(mechanism), [link], known)


def driver_formula(mechanism: Mechanism) -> str:
    """Return the driving links in the structural formula: ``I(0,1)``, ``I(0,1) + I(0,4)``."""
    return " + ".join(f"I({mechanism.frame},{driver})" for driver in mechanism.drivers)


def roman(number: int) -> str:
    """Roman numeral of a class (римская цифра)."""
    text = ""
    for value, sign in ((50, "L"), (40, "XL"), (10, "X"), (9, "IX"), (5, "V"), (4, "IV"), (1, "I")):
        text += sign * (number // value)
        number %= value
    return text


def _groups(mechanism: Mechanism) -> tuple[AssurGroup, ...]:
    """Blocks of the system of links and moving points that remain when the driver is known."""
    given = (FRAME, *mechanism.drivers)
    size: dict[Node, int] = {
        ("link", link): 3 for link in mechanism.links if link not in mechanism.drivers
    }
    rank = {node: i for i, node in enumerate(size)}
    equations: list[tuple[Node, ...]] = []
    for revolute in mechanism.revolutes:
        point: tuple[Node, ...] = (("point", revolute.point),)
        if any(link in given for link in revolute.links):
            point = ()
        else:
            size[point[0]] = 2
        for link in revolute.links:
            if link not in given:
                equations += [(("link", link), *point)] * 2
    for pair in mechanism.prismatics:
        ends = tuple(("link", link) for link in (pair.slider, pair.host) if link not in given)
        if ends:
            equations += [ends] * 2
    for mesh in mechanism.meshes:
        ends = tuple(("link", link) for link in mesh.joined if link not in given)
        if ends:
            equations.append(ends)
    found = blocks(equations, size, rank)
    if found is None:  # the balance of links and pairs has been proved before
        raise StructureError("The links and pairs of the mechanism do not balance")
    groups = []
    order = {link: i for i, link in enumerate(mechanism.links)}
    joints_of, known = joints_of_links(mechanism), {link: i for i, link in enumerate(given)}
    for block in found:
        links = [str(node[1]) for node in block if isinstance(node, tuple) and node[0] == "link"]
        if links:  # otherwise a point that a known link carries to later groups
            links.sort(key=order.__getitem__)
            groups.append(make_group(joints_of, links, known, mechanism.meshes))
            known |= {link: len(known) + i for i, link in enumerate(links)}
    return tuple(groups)


class PairKind(Enum):
    """Relative motion in a pair (относительное движение)."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
    HIGHER = "higher"
    """Contact of profiles; not among `pairs`, which describe the replacing mechanism."""
    ROLLING = "rolling"
    """A wheel that rolls without sliding: one freedom, a lower pair by count."""


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
    mechanism = mechanism.active
    replacing = {pair.by for pair in mechanism.higher}
    replacing |= {mesh.carrier for mesh in mechanism.rolling}
    rows = [pair for pair in pairs(mechanism) if not replacing & set(pair.links)]
    for mesh in mechanism.meshes:
        kind = PairKind.ROLLING if mesh.rolls else PairKind.HIGHER
        rows.append(KinematicPair(mesh.name, mesh.name, mesh.links, kind))
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
    WHEEL = "wheel"
    """Колесо: rolls on the frame, or a planet: has a mesh and no pair with the frame."""


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
            if link in mechanism.drivers:
                role = Role.CRANK
            elif link in stones:
                role = Role.SLIDING_BLOCK
            elif link in partners:
                role = Role.SLOTTED_LINK
        else:
            motion = MotionKind.PLANE
            role = Role.SLIDING_BLOCK if link in stones else Role.ROD
            if any(link in mesh.links for mesh in mechanism.meshes if FRAME in mesh.links):
                role = Role.WHEEL
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
        small = [link for link in ends if count[link] == 2 and link not in mechanism.drivers]
        if small:
            stones.add(small[0])
            partners.update(link for link in ends if link != small[0])
        else:
            partners.update(ends)
    return stones, partners - stones
