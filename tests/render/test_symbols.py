from __future__ import annotations

import cmath
from itertools import pairwise
from math import isclose, pi, tau

import pytest
from cases import each
from doors import (
    ARROW,
    ROLLER,
    SIZES,
    Arc,
    Disc,
    DrawingItem as Item,
    Fill,
    Ink,
    Pen,
    PenSet,
    Stroke,
    arc_points,
    cam,
    rest_on_cam,
    stroke_lines,
    sweep,
    symbols,
    using_pens,
)
from hypothesis import given, strategies as st
from shapely import LineString, Point, Polygon

angles = st.floats(-180, 180)


def hatching(items: list[Item]) -> list[Stroke]:
    return [i for i in items if isinstance(i, Stroke) and i.pen is Pen.HATCH]


def fills(items: list[Item]) -> list[Fill]:
    return [i for i in items if isinstance(i, Fill)]


def test_revolute_pair_is_a_white_circle_of_3_mm() -> None:
    disc, arc = symbols.revolute(5 + 6j)
    assert isinstance(disc, Disc)
    assert isinstance(arc, Arc)
    assert (disc.ink, disc.radius, arc.radius) == (Ink.WHITE, 1.5, 1.5)
    assert isclose(sweep(arc), tau)


def test_a_fixed_pivot_is_on_a_hatched_base_of_14_mm() -> None:
    items = symbols.fixed_pivot(10 + 20j)
    legs, base = (i for i in items if isinstance(i, Stroke) and i.pen is Pen.MAIN)
    assert legs.points == pytest.approx((5.5 + 11j, 10 + 20j, 14.5 + 11j))
    assert base.points == pytest.approx((3 + 11j, 17 + 11j))
    assert all(p.imag <= 11 + 1e-9 for s in hatching(items) for p in s.points)
    assert isinstance(items[-1], Arc)  # the joint is drawn over the legs


@given(angles, st.sampled_from([0.6, 1.0, 1.5]))
def test_pivots_turn_and_scale(angle: float, factor: float) -> None:
    direction = cmath.rect(1, angle / 180 * pi)
    items = symbols.fixed_pivot(0j, direction=direction, factor=factor)
    base = next(i for i in items if isinstance(i, Stroke) and len(i.points) == 2)
    middle = (base.points[0] + base.points[1]) / 2
    assert middle == pytest.approx(9 * factor * direction)
    assert abs(base.points[1] - base.points[0]) == pytest.approx(14 * factor)
    for stroke in hatching(items):
        for p in stroke.points:
            beyond = (p / direction).real - 9 * factor
            assert -1e-6 <= beyond <= 3 * factor * 0.7072
            assert abs((p / direction).imag) <= 7 * factor + 1e-6


@given(angles, st.sampled_from([1, -1]), st.floats(6, 60))
def test_hatching_is_on_its_side_at_45_degrees_in_even_steps(
    angle: float, side: int, length: float
) -> None:
    end = cmath.rect(length, angle / 180 * pi)
    strokes = hatching(symbols.ground_line(0j, end, side=side))
    feet: list[float] = []
    for stroke in strokes:
        top, foot = (p / symbols.unit(end) for p in stroke.points)
        for p in (top, foot):
            assert -1e-9 <= p.real <= length + 1e-9
            assert p.imag * side >= -1e-9
        way = foot - top
        assert abs(way.real) == pytest.approx(abs(way.imag), abs=1e-9)
        assert abs(way) <= SIZES.hatch_stroke + 1e-9
        # Where the stroke, drawn on, meets the line: the clipped ones too are in step.
        feet.append(top.real - way.real / way.imag * top.imag)
    steps = [abs(b - a) for a, b in pairwise(feet)]
    assert len(strokes) >= 2 or length < 8
    assert all(step == pytest.approx(SIZES.hatch_step) for step in steps)


def test_hatching_leans_one_way_on_both_sides() -> None:
    for side in (1, -1):
        for stroke in hatching(symbols.ground_line(0j, 30 + 0j, side=side)):
            way = stroke.points[1] - stroke.points[0]
            assert way.real * way.imag > 0


@given(angles)
def test_slider_is_14_by_8_along_its_guide(angle: float) -> None:
    white, outline = symbols.slider(3 + 4j, angle=angle)
    assert isinstance(white, Fill)
    assert isinstance(outline, Stroke)
    assert white.ink is Ink.WHITE
    turn = cmath.rect(1, angle / 180 * pi)
    corners = [(p - 3 - 4j) / turn for p in outline.points]
    assert sorted({round(abs(c.real), 6) for c in corners}) == [7]
    assert sorted({round(abs(c.imag), 6) for c in corners}) == [4]


def test_a_sliding_block_has_its_guide_line_and_pin() -> None:
    items = symbols.sliding_block(0j, angle=30)
    assert isinstance(items[0], Fill)
    assert isinstance(items[-1], Arc)
    assert not any(isinstance(i, Disc) for i in symbols.sliding_block(0j, pin=False))


def test_guide_line_touches_the_slider() -> None:
    line = symbols.guide_line(10 + 10j, before=5, after=9)[0]
    assert isinstance(line, Stroke)
    assert line.points == pytest.approx((5 + 6j, 19 + 6j))


def test_plates_are_on_both_sides() -> None:
    items = symbols.guide_plates(0j)
    levels = {
        round(i.points[0].imag, 6) for i in items if isinstance(i, Stroke) and i.pen is Pen.MAIN
    }
    assert levels == {4, -4}


def test_rigid_corner_fills_the_angle_and_no_straight_one() -> None:
    (mark,) = symbols.rigid_corner(0j, 20 + 0j, 20j)
    assert isinstance(mark, Fill)
    assert mark.points == (0, 5, 5j)
    assert symbols.rigid_corner(0j, 20 + 0j, -20 + 0.1j) == []


def test_hatch_stays_inside_its_polygon() -> None:
    corners = (0j, 40 + 0j, 20 + 25j)
    strokes = symbols.hatch(corners)
    assert len(strokes) > 10
    for stroke in strokes:
        assert isinstance(stroke, Stroke)
        way = stroke.points[1] - stroke.points[0]
        assert way.real == pytest.approx(way.imag)
        for p in stroke.points:
            assert p.imag >= -1e-9
            assert p.imag <= 1.25 * p.real + 1e-9
            assert p.imag <= 1.25 * (40 - p.real) + 1e-9


def test_hatch_of_a_hollow_polygon_leaves_the_hollow_white() -> None:
    hollow = (0j, 20 + 0j, 20 + 20j, 10 + 5j, 20j)
    for stroke in symbols.hatch(hollow):
        assert isinstance(stroke, Stroke)
        middle = sum(stroke.points) / 2
        assert middle.imag <= 5 + 1.5 * abs(middle.real - 10) + 1e-6


@each("s", [0.6, 0.8, 1.0])
@each("pen", [Pen.RESULTANT, Pen.RELATIVE, Pen.COMPONENT])
def test_the_head_of_a_vector_is_in_proportion_to_its_pen(pen: Pen, s: float) -> None:
    with using_pens(PenSet(s)) as pens:
        line, head = symbols.vector_arrow(0j, 40 + 0j, pen=pen)
    assert isinstance(line, Stroke)
    assert isinstance(head, Fill)
    assert line.pen is head.pen is pen
    assert head.points[0] == 40
    back = head.points[1].real
    assert 40 - back == pytest.approx(8 * pens.width(pen))
    assert back < line.points[1].real < 40
    assert abs(head.points[1].imag) * 2 >= 2 * pens.width(pen)


@given(st.floats(0.31, 9.9), angles)
def test_short_vectors_get_smaller_heads(length: float, angle: float) -> None:
    head = cmath.rect(length, angle / 180 * pi)
    _, fill = symbols.vector_arrow(0j, head)
    assert isinstance(fill, Fill)
    assert max(abs((p - head).conjugate() * head) / length for p in fill.points) < length
    back = (fill.points[1] + fill.points[3]) / 2
    assert abs(head - back) <= length / 3 + 1e-9


def test_no_arrow_for_a_zero_vector() -> None:
    assert symbols.vector_arrow(1 + 1j, 1 + 1j) == []


@pytest.mark.parametrize("sense", [1, -1])
def test_circular_arrow_points_along_its_sense(sense: int) -> None:
    arc, head = symbols.turn_arrow(0j, 10, sense, middle=90, sweep=120)
    assert isinstance(arc, Arc)
    assert isinstance(head, Fill)
    tip, back = head.points[0], head.points[2]
    assert abs(tip) == pytest.approx(10)
    turn = (tip * back.conjugate()).imag
    assert turn * sense > 0
    assert sweep(arc) < 2 * pi / 3
    middle = cmath.rect(1, (arc.start + arc.end) / 2)
    assert middle.imag > 0.8


def test_no_circular_arrow_at_rest() -> None:
    assert symbols.turn_arrow(0j, 10, 0) == []


def test_triangle_link() -> None:
    items = symbols.rigid_polygon(0j, 30 + 0j, 10 + 20j, hatched=True)
    assert hatching(items)
    assert isinstance(items[-1], Stroke)
    assert items[-1].closed


# Joints ------------------------------------------------------------------------------------------


def test_a_joint_of_three_links_has_a_ring_about_it() -> None:
    items = symbols.revolute(2 + 3j, count=2)
    arcs = [i for i in items if isinstance(i, Arc)]
    assert [(a.radius, a.pen) for a in arcs] == [(2.8, Pen.THIN), (1.5, Pen.MAIN)]
    discs = [i for i in items if isinstance(i, Disc)]
    assert max(d.radius for d in discs) == 2.8  # links end at the ring
    assert len([i for i in symbols.revolute(0j, count=3) if isinstance(i, Arc)]) == 3
    gap = SIZES.ring - (PenSet().width(Pen.MAIN) + PenSet().width(Pen.THIN)) / 2
    assert gap >= 0.7


@given(angles, st.sampled_from([1, -1]))
def test_a_joint_on_a_link_shows_on_one_side(angle: float, side: int) -> None:
    along = cmath.rect(7, angle / 180 * pi)
    white, half, piece = symbols.revolute_on(1 + 1j, along * side, tag="link 3")
    assert isinstance(white, Fill)
    assert isinstance(half, Arc)
    assert isinstance(piece, Stroke)
    assert white.ink is Ink.WHITE
    for point in (*white.points, *arc_points(half)):
        assert ((point - 1 - 1j) / along).imag * side >= -1e-9
    assert sweep(half) == pytest.approx(pi)
    assert piece.tag == "link 3"
    assert sum(piece.points) / 2 == pytest.approx(1 + 1j)
    # The visible part of the circle beside the link is as wide as the half of a joint.
    assert half.radius - PenSet().width(Pen.MAIN) / 2 == pytest.approx(SIZES.joint / 2)


def test_an_offset_slider_is_one_piece_with_its_arm() -> None:
    items = symbols.offset_slider(0j, 3 + 9j)
    assert any(isinstance(i, Stroke) and i.points == (0j, 3 + 9j) for i in items)
    assert isinstance(items[-1], Arc)
    assert items[-1].centre == 3 + 9j


def test_plates_on_one_side_only() -> None:
    items = symbols.guide_plates(0j, sides=(-1,))
    assert all(p.imag <= -4 for i in items if isinstance(i, Stroke) for p in i.points)


def test_a_bearing_leaves_the_shaft_free() -> None:
    shaft = LineString([(-20, 0), (20, 0)]).buffer(PenSet().width(Pen.MAIN) / 2)
    for item in symbols.bearing(0j):
        assert isinstance(item, Stroke)
        edge = LineString([(p.real, p.imag) for p in item.points])
        assert edge.distance(shaft) >= 0.8


# Links -------------------------------------------------------------------------------------------


def test_corners_of_a_triangle_are_marked() -> None:
    marks = fills(symbols.rigid_polygon(0j, 30 + 0j, 10 + 20j, marked=True))
    assert {mark.points[0] for mark in marks} == {0j, 30 + 0j, 10 + 20j}
    for mark in marks:
        assert (
            Polygon([(0, 0), (30, 0), (10, 20)])
            .buffer(1e-9)
            .contains(Polygon([(p.real, p.imag) for p in mark.points]))
        )


def test_a_crank_has_its_path_and_a_rocker_its_dead_positions() -> None:
    path, bar, *_ = symbols.crank(0j, 12 + 5j, path=True)
    assert isinstance(path, Arc)
    assert (path.radius, path.pen) == (13, Pen.THIN)
    assert isinstance(bar, Stroke)
    assert not any(isinstance(i, Arc) and i.tag == "path" for i in symbols.crank(0j, 12 + 5j))
    items = symbols.rocker(0j, 30j, swing=(20.0, 35.0))
    dead = [i for i in items if isinstance(i, Stroke) and i.pen is Pen.PHANTOM]
    turns = sorted(round(symbols.angle_of(i.points[1] / 1j)) for i in dead)
    assert turns == [-20, 35]
    assert all(len(stroke_lines(i)) > 1 for i in dead)


# Arrows ------------------------------------------------------------------------------------------


def test_every_arrowhead_has_one_shape() -> None:
    drawn = [
        *symbols.arrowhead(0j, 1 + 2j),
        *symbols.arrowhead(0j, -1j, length=2.5),
        *symbols.vector_arrow(0j, 40 + 0j),
        *symbols.vector_arrow(0j, 3 + 4j, pen=Pen.THIN),
        *symbols.turn_arrow(0j, 10, 1),
        *symbols.turn_sign(0j, 3.0, -1),
        *symbols.drive_arrow(0j, 20j),
    ]
    shapes = set()
    for head in fills(drawn):
        tip, left, notch, right = head.points
        middle = (left + right) / 2
        length = abs(tip - middle)
        shapes.add((round(abs(left - right) / length, 6), round(abs(notch - middle) / length, 6)))
    assert shapes == {(ARROW.width, ARROW.notch)}
    assert ARROW.width == pytest.approx(0.36, abs=0.04)  # about 20 degrees


# Hatching that gives way -------------------------------------------------------------------------


def test_hatching_gives_way_to_items_in_it() -> None:
    corners = (0j, 40 + 0j, 20 + 25j)
    joint = symbols.revolute(20 + 10j)
    free = symbols.hatch(corners)
    cut = symbols.hatch(corners, obstacles=joint)
    clear = Point(20, 10).buffer(1.5 + 0.7)
    assert any(shape(stroke).intersects(clear) for stroke in free)
    assert not any(shape(stroke).intersects(clear) for stroke in cut)
    area = Polygon([(p.real, p.imag) for p in corners]).buffer(1e-9)
    assert all(area.contains(shape(stroke)) for stroke in cut)


def test_only_hatching_is_cut() -> None:
    base = symbols.ground_line(0j, 30 + 0j)
    taken = symbols.occupied_area(symbols.link(15 + 5j, 15 - 5j))
    assert taken is not None
    kept = symbols.clipped(base, taken)
    assert kept[0] == base[0]
    assert len(hatching(kept)) >= len(hatching(base)) - 2
    assert not any(shape(stroke).intersects(taken.buffer(-1e-6)) for stroke in hatching(kept))
    assert all(shape(stroke).length >= 1.2 - 1e-9 for stroke in hatching(kept))
    assert symbols.occupied_area([]) is None


def test_the_frame_gives_way_to_links_and_not_to_its_own_lines() -> None:
    base = symbols.ground_line(0j, 30 + 0j)
    assert symbols.before_links(base) == base
    crossed = symbols.before_links([*base, *symbols.link(15 + 5j, 15 - 5j, tag="link 2")])
    assert len(hatching(crossed)) < len(hatching(base)) or hatching(crossed) != hatching(base)
    pale = Stroke((15 + 5j, 15 - 5j), Pen.PALE, tag="link 2")
    assert symbols.before_links([*base, pale]) == [*base, pale]


def shape(item: Item) -> LineString:
    assert isinstance(item, Stroke)
    return LineString([(p.real, p.imag) for p in item.points])


@given(st.floats(0.0, tau), st.floats(4.0, 12.0), st.floats(0.5, 8.0), angles)
def test_a_roller_that_rests_on_a_cam_touches_it(
    nose: float, base: float, lift: float, way: float
) -> None:
    """The outline between its 120 corners is 0.01 mm beside the cam."""
    up = cmath.exp(1j * way)
    at = rest_on_cam(1 + 2j, up, base=base, lift=lift, nose=nose)
    (outline,) = cam(1 + 2j, base=base, lift=lift, nose=nose)
    assert isinstance(outline, Stroke)
    disc = Polygon([(z.real, z.imag) for z in outline.points])
    assert disc.distance(Point(at.real, at.imag)) == pytest.approx(ROLLER, abs=0.1)
    assert abs(cmath.phase((at - 1 - 2j) / up)) < 1e-9
