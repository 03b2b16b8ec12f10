"""Random mechanisms, their structure counted again from the links and the points alone."""

from __future__ import annotations

import random
from functools import cache
from itertools import combinations

import numpy as np
import numpy.typing as npt
from doors import (
    FRAME,
    AssurGroup,
    Mechanism,
    MotionKind,
    Prismatic,
    Revolute,
    Role,
    Structure,
    StructureError,
    analyse,
    kind_of_motion,
    pairs,
    roman,
)

KINDS = {"RRR": 1, "RRP": 2, "RPR": 3, "PRP": 4, "RPP": 5}
Row = npt.NDArray[np.float64]
Pairs = list[tuple[str, str, str]]


def thrown(rng: random.Random) -> Mechanism:
    """Throw links and pairs together so that W = 1, each link joined to one that is there."""
    n = rng.choice((3, 5, 5, 7, 7, 9))
    names = rng.sample([str(k) for k in range(1, 20)], n)
    links, driver = [FRAME, *names], names[rng.randrange(n)]
    points = [[FRAME, driver]]
    slides: list[tuple[str, str]] = []
    for _ in range((3 * n - 1) // 2 - 1):
        first, other = rng.sample([x for x in links if x != driver] + [driver] * (n > 3), 2)
        if rng.random() < 0.2:
            if first == FRAME:
                first, other = other, first
            slides.append((first, other))
        elif rng.random() < 0.25:
            point = rng.choice(points)
            free = [x for x in links if x not in point and x != driver]
            point.append(rng.choice(free)) if free else points.append([first, other])
        else:
            points.append([first, other])
    return built(names, points, slides, driver, rng)


def joined(rng: random.Random) -> Mechanism:
    """Join dyads to the frame, to the driver and to the links of others; any order in the file."""
    count = rng.randrange(1, 6)
    names = rng.sample([str(k) for k in range(1, 20)], 2 * count + 1)
    driver, *others = rng.sample(names, len(names))
    known, points, slides = [FRAME, driver], [[FRAME, driver]], list[tuple[str, str]]()
    for k in range(count):
        own = others[2 * k : 2 * k + 2]
        first, last = rng.sample(known, 2)
        ends = [(own[0], first), (own[0], own[1]), (own[1], last)]
        for letter, pair in zip(rng.choice([*KINDS]), ends, strict=True):
            if letter == "P":
                slides.append(pair)
            else:  # sometimes in a point that the known link has already
                there = [x for x in points if pair[1] in x and not {*own} & {*x}]
                if pair[1] in known and there and rng.random() < 0.3:
                    rng.choice(there).append(pair[0])
                else:
                    points.append([*pair])
        known += own
    return built(names, points, slides, driver, rng)


def built(
    names: list[str],
    points: list[list[str]],
    slides: list[tuple[str, str]],
    driver: str,
    rng: random.Random,
) -> Mechanism:
    """Return a mechanism of points and slides in any order, the links of a point in the file's."""
    rank = [FRAME, *names]
    rng.shuffle(points)
    revolutes = tuple(
        Revolute(f"P{k}", tuple(sorted(point, key=rank.index))) for k, point in enumerate(points)
    )
    made = tuple(Prismatic(s, h, f"S{k}") for k, (s, h) in enumerate(slides))
    return Mechanism(tuple(names), revolutes, made, driver)


@cache
def mechanisms() -> list[tuple[Mechanism, Structure]]:
    """Return those of many random mechanisms that follow their driver."""
    rng, found = random.Random(20), []
    for k in range(700):
        made = thrown(rng) if k % 7 else joined(rng)
        try:
            found.append((made, analyse(made)))
        except StructureError:
            continue
    return found


def test_the_random_mechanisms_have_groups_of_all_sorts() -> None:
    seen = {group.signature for _, one in mechanisms() for group in one.groups}
    classes = {group.class_number for _, one in mechanisms() for group in one.groups}
    assert set(KINDS) <= seen
    assert {2, 3} <= classes
    assert max(len(one.groups) for _, one in mechanisms()) >= 3


def test_mobilities_are_those_of_the_counted_links_and_pairs() -> None:
    for made, found in mechanisms():
        n = len(made.links)
        p1 = sum(len(one.links) - 1 for one in made.revolutes) + len(made.prismatics)
        assert (found.moving_links, found.lower_pairs, found.higher_pairs) == (n, p1, 0)
        assert (found.mobility, found.local_mobility) == (1, 0)
        assert found.spatial_mobility == 6 * n - 5 * p1
        assert found.redundant == 1 - (6 * n - 5 * p1)
        assert found.class_number == max((one.class_number for one in found.groups), default=1)
        parts = [f"I(0,{made.driver})"]
        parts += [f"{roman(one.class_number)}({','.join(one.links)})" for one in found.groups]
        assert found.formula == " → ".join(parts)
        assert found.force_order == tuple(reversed(found.groups))


def own_joints(made: Mechanism) -> list[tuple[Revolute | Prismatic, tuple[str, ...], str]]:
    joints = [(one, one.links, "R") for one in made.revolutes]
    return [*joints, *((one, (one.slider, one.host), "P") for one in made.prismatics)]


def constraints(made: Mechanism, links: tuple[str, ...], known: set[str]) -> int:
    """Return how many pairs join links among themselves and with links that are known."""
    count = 0
    for _, ends, _ in own_joints(made):
        inside = sum(link in links for link in ends)
        if inside:
            count += inside if known & {*ends} else inside - 1
    return count


def test_a_group_is_the_smallest_set_of_links_that_the_known_ones_settle() -> None:
    """3 n = 2 p of it with the links before it, and of no part of it."""
    for made, found in mechanisms():
        known = {FRAME, made.driver}
        for group in found.groups:
            assert group.links == tuple(link for link in made.links if link in group.links)
            assert 3 * len(group.links) == 2 * constraints(made, group.links, known)
            for size in range(1, len(group.links)):
                for part in combinations(group.links, size):
                    assert 3 * size > 2 * constraints(made, part, known), (group, part)
            known |= {*group.links}
        assert known == {FRAME, *made.links}


def is_ready(made: Mechanism, group: AssurGroup, known: set[str]) -> bool:
    return 3 * len(group.links) == 2 * constraints(made, group.links, known)


def test_of_the_groups_that_can_be_next_the_first_of_the_file_is() -> None:
    several = 0
    for made, found in mechanisms():
        known, left = {FRAME, made.driver}, list(found.groups)
        while left:
            ready = [group for group in left if is_ready(made, group, known)]
            several += len(ready) > 1
            first = min(ready, key=lambda one: min(map(made.links.index, one.links)))
            assert left.pop(0) == first
            known |= {*first.links}
            assert all(found.group_of(link) is first for link in first.links)
    assert several > 10


def test_legs_and_inner_joints_are_those_of_the_points_and_slides() -> None:
    for made, found in mechanisms():
        known = [FRAME, made.driver]
        for group in found.groups:
            legs, inner, letters = [], [], ""
            for joint, ends, letter in own_joints(made):
                inside = [link for link in group.links if link in ends]
                outside = [link for link in known if link in ends]
                if inside and outside:  # to the link that was known first
                    legs += [(link, joint, outside[0], letter) for link in inside]
                elif len(inside) > 1:
                    inner.append(joint)
                    letters += letter * (len(inside) - 1)
            legs.sort(key=lambda one: group.links.index(one[0]))
            assert [(one.link, one.joint, one.to) for one in group.legs] == [x[:3] for x in legs]
            assert list(group.inner) == inner
            outer = "".join(sorted(one[3] for one in legs))
            if len(group.links) == 2:
                ways = {outer[::way][0] + letters + outer[::way][1] for way in (1, -1)}
                assert group.signature in ways & {*KINDS}
                assert (group.kind, group.class_number) == (KINDS[group.signature], 2)
            else:
                assert group.signature == f"{outer}-{''.join(sorted(letters))}"
                assert group.kind is None
                assert group.class_number >= 3
            assert group.order == len(legs)
            known += group.links


def test_the_table_of_pairs_has_each_pair_once_with_the_frame_or_the_first_link_before() -> None:
    for made, found in mechanisms():
        rows, rank = pairs(made), [FRAME, *made.links]
        assert len(rows) == found.lower_pairs
        assert len({row.name for row in rows}) == len(rows)
        due: Pairs = []
        for joint in made.revolutes:
            due += [(joint.point, joint.links[0], link) for link in joint.links[1:]]
        for slide in made.prismatics:
            one, other = sorted((slide.slider, slide.host), key=rank.index)
            due.append((slide.pin, one, other))
        assert [(row.point, *row.links) for row in rows] == due
        for row in rows:
            assert rank.index(row.links[0]) < rank.index(row.links[1])
            assert row.name in (row.point, f"{row.point}({','.join(row.links)})")


def rates_of(made: Mechanism) -> dict[str, Row]:
    """Return the rates of places and of turning at random places and the driver's rate 1."""
    rng = np.random.default_rng(5)
    number = {one: 3 * k for k, one in enumerate(made.links)}
    rows: list[Row] = []

    def row(one: str, at: complex, along: complex) -> Row:
        found = np.zeros(3 * len(number) + 1)
        if one != FRAME:
            k = number[one]
            found[k : k + 3] = along.real, along.imag, (1j * at * along.conjugate()).real
        return found

    def turn(one: str) -> Row:
        found = np.zeros(3 * len(number) + 1)
        if one != FRAME:
            found[number[one] + 2] = 1.0
        return found

    for joint in made.revolutes:
        at = complex(*rng.normal(size=2))
        for other in joint.links[1:]:
            rows += [row(joint.links[0], at, u) - row(other, at, u) for u in (1 + 0j, 1j)]
    for slide in made.prismatics:
        at, u = complex(*rng.normal(size=2)), complex(*rng.normal(size=2))
        rows.append(row(slide.slider, at, u) - row(slide.host, at, u))
        rows.append(turn(slide.slider) - turn(slide.host))
    rows.append(turn(made.driver))
    rows[-1][-1] = 1.0
    table = np.array(rows)
    rates: Row = np.asarray(np.linalg.lstsq(table[:, :-1], table[:, -1], rcond=None)[0], float)
    return {link: np.array(rates[k : k + 3]) for link, k in number.items()}


def test_a_link_translates_exactly_where_its_computed_rate_of_turning_is_zero() -> None:
    compared = 0
    for made, _ in mechanisms()[::3]:
        hinged = {x for one in made.revolutes if FRAME in one.links for x in one.links}
        rates = rates_of(made)
        if any(np.abs(one).max() < 1e-9 for one in rates.values()):
            continue  # a part that the frame holds fast: it has no motion to name
        still = {link for link, (_, _, turn) in rates.items() if abs(turn) < 1e-9}
        frame, *rows = kind_of_motion(made)
        assert (frame.link, frame.role) == (FRAME, Role.FRAME)
        assert [row.link for row in rows] == list(made.links)
        ends = [{one.slider, one.host} for one in made.prismatics]
        for row in rows:
            due = MotionKind.ROTATION if row.link in hinged else MotionKind.PLANE
            due = MotionKind.TRANSLATION if row.link in still else due
            assert row.motion is due, (made, row)
            if due is MotionKind.TRANSLATION:
                on_frame = {FRAME, row.link} in ends
                assert row.role is (Role.SLIDER if on_frame else Role.SLIDING_BLOCK)
            if due is MotionKind.ROTATION:
                assert (row.role is Role.CRANK) == (row.link == made.driver)
            compared += 1
    assert compared > 100
