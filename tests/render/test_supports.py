"""Supports and guides are in the space that links leave, and do not overlap."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from itertools import combinations, pairwise

import pytest
from cases import each
from doors import (
    SIZES,
    SYMBOLS_GROUND as GROUND,
    Arc,
    AssemblyError,
    DrawingItem as Item,
    Fill,
    Ink,
    Pen,
    PenSet,
    Scheme,
    Solution,
    Stroke,
    fixed_pivots,
    free_sides,
    place_supports,
    problem_loads as loads,
    scheme_picture,
    slider,
    support_half_width,
)
from shapely import LineString, Point, Polygon, union_all
from shapely.geometry.base import BaseGeometry
from worked import SIX, problem_of

from benchmarks.generator import random_problem

UNREACHED = {("levers/six-link", 40.0), ("levers/six-link", 75.0)}
"""Positions in which a mechanism cannot be assembled."""

DOWN, UP, LEFT = -1j, 1j, -1 + 0j


def bar(start: complex, end: complex) -> Stroke:
    return Stroke((start, end), tag="link 1")


def lines_of(items: Sequence[Item], pen: Pen | None = None) -> BaseGeometry:
    paths = [
        [(p.real, p.imag) for p in item.points]
        for item in items
        if isinstance(item, Stroke) and (pen is None or item.pen is pen)
    ]
    return union_all([LineString(path) for path in paths])


# Supports ----------------------------------------------------------------------------------------


def test_a_support_points_down_where_it_can() -> None:
    (support,) = place_supports([0j], [bar(0j, 30 + 20j)])
    assert (support.places, support.direction, support.factor) == ((0j,), DOWN, 1.0)
    (alone,) = place_supports([3 + 4j], [])
    assert alone.direction == DOWN


@pytest.mark.parametrize("way", [-1j, 1 - 2j, -1 - 3j])
def test_a_support_turns_away_from_a_link_below_it(way: complex) -> None:
    (support,) = place_supports([0j], [bar(0j, 40 * way / abs(way))])
    assert support.direction == UP
    ground = lines_of(support.items())
    link = LineString([(0.1 * way.real, 0.1 * way.imag), (40 * way.real, 40 * way.imag)])
    assert ground.distance(link) == 0.0 or ground.intersection(link).length < 0.2


def test_a_support_turns_aside_between_links_above_and_below() -> None:
    links = [bar(0j, 40j), bar(0j, -40j)]
    (support,) = place_supports([0j], links)
    assert support.direction == LEFT
    (other,) = place_supports([0j], [*links, bar(0j, -40 + 0j)])
    assert other.direction == 1


def test_a_line_that_passes_below_turns_the_support() -> None:
    (support,) = place_supports([0j], [bar(-30 - 8j, 30 - 8j), bar(0j, 30 + 0j)])
    assert support.direction == UP


@each("apart", [5.0, 7.0, 9.0, 12.0, 15.0, 18.0, 25.0])
@each("step", [0.0, 3.0, 5.5, 8.0, 12.0])
def test_supports_of_near_pivots_do_not_run_into_each_other(apart: float, step: float) -> None:
    pivots = [0j, complex(apart, step)]
    found = place_supports(pivots, [])
    assert sorted((p for s in found for p in s.places), key=abs) == pivots
    for one, two in combinations(found, 2):
        assert lines_of(one.items()).distance(lines_of(two.items())) > PenSet().width(Pen.MAIN)
    if step <= 5.5 and apart < 14:
        (common,) = found
        assert common.direction == DOWN


def test_one_base_under_two_pivots() -> None:
    legs, others, base, *hatching = fixed_pivots([0j, 7 + 2j], joints=False)
    for triangle, at in ((legs, 0j), (others, 7 + 2j)):
        assert isinstance(triangle, Stroke)
        left, top, right = triangle.points
        assert top == at
        assert left.imag == right.imag == -9
        assert right.real - left.real == pytest.approx(2 * support_half_width([0j, 7 + 2j]))
    assert isinstance(base, Stroke)
    assert sorted(p.real for p in base.points) == [-7, 14]
    assert all(isinstance(s, Stroke) and s.tag == GROUND for s in hatching)
    # 1 mm is left between the feet.
    assert 7 - 2 * support_half_width([0j, 7 + 2j]) == pytest.approx(1.0)
    assert support_half_width([0j, 40 + 0j]) == SIZES.support_width / 2
    assert support_half_width([0j]) == SIZES.support_width / 2


def test_pivots_one_over_the_other_look_away() -> None:
    low, high = place_supports([0j, 8j], [])
    assert {low.direction, high.direction} != {DOWN}
    assert lines_of(low.items()).distance(lines_of(high.items())) > PenSet().width(Pen.MAIN)


# Guides ------------------------------------------------------------------------------------------


def test_a_guide_leaves_out_the_plate_that_a_link_crosses() -> None:
    above, below = bar(0j, -20 + 30j), bar(0j, 20 - 30j)
    assert free_sides(0j, [], angle=0.0, length=22.0) == (1, -1)
    assert free_sides(0j, [above], angle=0.0, length=22.0) == (-1,)
    assert free_sides(0j, [below], angle=0.0, length=22.0) == (1,)
    assert free_sides(0j, [below], angle=180.0, length=22.0) == (-1,)
    assert free_sides(0j, [above, below], angle=0.0, length=22.0) == (1, -1)
    # A link that leaves between the plates crosses none.
    assert free_sides(0j, [bar(0j, 60 + 4j)], angle=0.0, length=22.0) == (1, -1)


# Schemes -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", SIX)
@each("turn", [None, 40.0, 75.0, 160.0, 200.0, 305.0])
def test_no_hatching_runs_over_links_or_neighbours(name: str, turn: float | None) -> None:
    solution = Solution(problem_of(name), positions=None if turn is None else [turn])
    try:
        picture = scheme_picture(solution, 0)
    except AssemblyError:
        assert (name, turn) in UNREACHED
        return
    items = list(picture.items)
    links = [i for i in items if isinstance(i, Stroke) and i.tag.startswith("link ")]
    hatching = [i for i in items if isinstance(i, Stroke) and i.tag == GROUND]
    assert hatching
    strip = lines_of(links).buffer(PenSet().width(Pen.MAIN) / 2)
    assert not lines_of(hatching).intersects(strip)
    # A slider or a joint that lies on hatching hides it.
    for k, item in enumerate(items):
        if isinstance(item, Fill) and item.ink is Ink.WHITE:
            body = LineString([(p.real, p.imag) for p in (*item.points, item.points[0])])
            after = [i for i in items[k:] if i in hatching]
            assert not after or not lines_of(after).intersects(body.buffer(-0.01))


@pytest.mark.parametrize("name", SIX)
def test_supports_of_the_shipped_schemes_are_free_of_other_items(name: str) -> None:
    scheme = Scheme(Solution(problem_of(name)), 0, 5.0)
    scheme.draw()
    scheme.draw_joints()
    links = lines_of(scheme.lines)
    for support in scheme.supports:
        feet = [i for i in support.items() if isinstance(i, Stroke) and len(i.points) == 2]
        assert lines_of(feet).distance(links) > 1.0
        (place,) = support.places
        assert scheme.free_direction(place) == support.direction
    for one, two in combinations(scheme.supports, 2):
        assert lines_of(one.items()).distance(lines_of(two.items())) > 2.0


def test_a_link_that_goes_on_through_a_joint_is_one_piece() -> None:
    """D is between the ends of link 2; a centre of mass beyond a joint is not an end of a link."""
    for name, point, across in (("levers/task-1", "D", -0.282 - 0.959j),):
        scheme = Scheme(Solution(problem_of(name)), 0, 5.0)
        scheme.draw()
        scheme.draw_joints()
        place = scheme.at(point)
        (half,) = (i for i in scheme.joints if isinstance(i, Arc) and abs(i.centre - place) < 1e-9)
        assert half.end - half.start == pytest.approx(cmath.pi)
        middle = cmath.rect(1.0, (half.start + half.end) / 2)
        assert (middle * across.conjugate()).real > 0.9
        own = [i for i in scheme.joints if isinstance(i, Stroke) and i.tag == "link 2"]
        assert any(abs(sum(i.points) / 2 - place) < 1e-9 for i in own)


def test_a_rod_is_welded_to_the_edge_of_its_block() -> None:
    """The slotted link 5 of task 12 is one piece with its slider: no part of it is inside."""
    scheme = Scheme(Solution(problem_of("levers/task12")), 0, 5.0)
    scheme.draw()
    block = next(one for one in scheme.blocks if abs(one.middle - scheme.at("E")) < 1e-9)
    wedges = [item for item in scheme.corners if isinstance(item, Fill)]
    assert len(wedges) == 2
    for wedge in wedges:
        way = (wedge.points[0] - block.middle) * block.direction.conjugate()
        assert abs(way.imag) == pytest.approx(block.width / 2)
    for item in scheme.lines:
        if isinstance(item, Stroke) and item.tag == "link 5":
            for point in item.points:
                way = (point - block.middle) * block.direction.conjugate()
                inside = min(block.length / 2 - abs(way.real), block.width / 2 - abs(way.imag))
                assert inside < 1e-6


def test_no_block_hides_another() -> None:
    """All white grounds of sliders and blocks are drawn before any of their outlines."""
    scheme = Scheme(Solution(problem_of("linkages/ex3")), 0, 5.0)
    scheme.draw()
    fills = [k for k, item in enumerate(scheme.slider_items) if isinstance(item, Fill)]
    outlines = [k for k, i in enumerate(scheme.slider_items) if isinstance(i, Stroke) and i.closed]
    white = [k for k in fills if scheme.slider_items[k].ink is Ink.WHITE]  # type: ignore[union-attr]
    assert max(white) < min(outlines)


def test_a_centre_of_mass_is_no_part_of_the_outline() -> None:
    scheme = Scheme(Solution(problem_of("levers/task12")), 0, 5.0)
    scheme.draw()
    scheme.draw_joints()
    assert "S3" in scheme.solution.problem.centres
    place = scheme.at("S3")
    thick = [i for i in scheme.lines if isinstance(i, Stroke) and i.pen is Pen.MAIN]
    assert min(abs(p - place) for i in thick for p in i.points) > 0.5
    quarters = [i for i in scheme.joints if isinstance(i, Fill) and i.points[0] == place]
    assert len(quarters) == 2


def test_no_rigid_corner_is_marked_inside_a_slider() -> None:
    other = Scheme(Solution(problem_of("levers/six-link")), 0, 5.0)
    other.draw()
    other.draw_joints()
    (corner,) = other.corners
    assert corner.tag == "link 2"


BENT = """
[frame]
A = [0.0, 0.0]
C = [-0.09, 0.18]

[links.1]
points = ["A", "B"]
AB = 0.19

[links.2]
points = ["C", "D"]
DC = 0.04

[links.3]
points = ["B", "D", "E"]
DB = 0.27
E = { vertex = "B", ray = "BD", angle = ANGLE, distance = 0.22 }

[driver]
link = "1"
phi = 20.0
omega = -14.0

[assembly]
D = { near = [-0.08, 0.14] }
"""


@pytest.mark.parametrize(("angle", "filled"), [(153.0, 0), (100.0, 0), (-100.0, 1), (-150.0, 0)])
def test_a_bend_at_a_joint_is_filled_where_no_other_link_leaves(angle: float, filled: int) -> None:
    """Link 1 is between the lines of link 3 for a positive angle; 150° leaves no place to fill."""
    scheme = Scheme(Solution(loads(BENT.replace("ANGLE", str(angle)), name="bent")), 0, 5.0)
    scheme.draw()
    scheme.draw_joints()
    place = scheme.at("B")
    corners = [i for i in scheme.corners if isinstance(i, Fill) and abs(i.points[0] - place) < 0.1]
    assert [corner.tag for corner in corners] == ["link 3"] * filled
    for corner in corners:  # its far side is seen beyond the joint
        side = lines_of([Stroke(corner.points[1:])])
        assert side.distance(Point(place.real, place.imag)) > SIZES.joint / 2 + 1.0
    through = [i for i in scheme.joints if isinstance(i, Stroke) and i.tag == "link 3"]
    assert len(through) == 1 - filled
    for piece in through:
        assert abs(piece.points[1] - place) < 0.1


def test_lines_of_a_link_that_meet_at_a_joint_are_one_body_and_touch_no_other_link() -> None:
    for seed in range(104000, 104024):
        scheme = Scheme(Solution(loads(random_problem(seed)[0], name="random")), 0, 5.0)
        scheme.draw()
        scheme.draw_joints()
        corners = [i for i in scheme.corners if isinstance(i, Fill) and i.tag.startswith("link")]
        for corner in corners:
            lines = [i for i in scheme.lines if i.tag.startswith("link")]
            area = Polygon([(p.real, p.imag) for p in corner.points])
            vertex = Point(corner.points[0].real, corner.points[0].imag)
            seen = area.difference(vertex.buffer(SIZES.joint / 2))
            others = lines_of([i for i in lines if i.tag != corner.tag])
            assert not seen.intersects(others), (seed, corner.tag)
        wedges = [i for i in scheme.corners if isinstance(i, Fill) and i.tag.startswith("weld")]
        of_rod: dict[complex, list[bool]] = {}
        for wedge in wedges:  # one of the two wedges of a rod is enough: none or both are crossed
            area = Polygon([(p.real, p.imag) for p in wedge.points])
            own = wedge.tag.removeprefix("weld of ")
            others = [i for i in scheme.lines if i.tag.startswith("link") and i.tag != own]
            crossed = area.intersection(lines_of(others)).length > 0.5
            of_rod.setdefault(wedge.points[0], []).append(crossed)
        assert all(len({*crossed}) == 1 for crossed in of_rod.values()), seed
        for joint in scheme.solution.problem.mechanism.revolutes:
            place = scheme.at(joint.point)
            for link in joint.links:
                blocks = [block for of, block in scheme.own_blocks if of == link]
                if any(block.area.distance(Point(place.real, place.imag)) == 0 for block in blocks):
                    continue  # its rods are welded to the edge
                ways = scheme.directions(place, [link])
                different = sum(all(abs(w - v) > 0.1 for v in ways[:k]) for k, w in enumerate(ways))
                closed = [i for i in scheme.lines if isinstance(i, Stroke) and i.closed]
                signs = [
                    *(
                        c
                        for c in corners
                        if c.tag == f"link {link}" and abs(c.points[0] - place) < 1
                    ),
                    *scheme.passing(link, place),
                    *(i for i in closed if min(abs(p - place) for p in i.points) < 0.1),
                ]
                assert len(signs) >= different - 1, (seed, joint.point, link)


def test_the_axis_of_a_guide_begins_at_the_slider() -> None:
    scheme = Scheme(Solution(problem_of("linkages/ex3")), 0, 5.0)
    scheme.draw()
    (outline,) = (i for i in slider(scheme.at("E")) if isinstance(i, Stroke))
    xs = sorted({round(p.real, 6) for p in outline.points})
    starts = sorted(round(g.points[0].real, 6) for g in scheme.guides if isinstance(g, Stroke))
    assert starts == xs
    assert all(a < b for a, b in pairwise(starts))
