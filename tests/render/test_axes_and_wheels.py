"""Axes cross by strokes; wheels, racks and cams touch where they mesh."""

from __future__ import annotations

import cmath
from itertools import pairwise
from math import isclose, pi, tau

import pytest
from cases import each
from doors import (
    ROLLER,
    SIZES,
    SYMBOLS_GROUND as GROUND,
    Arc,
    Disc,
    DrawingItem as Item,
    Ink,
    Pen,
    PenSet,
    Stroke,
    arc_spans,
    axis_line,
    bell_profile,
    cam,
    carrier_profile,
    centre_lines,
    kinked_line,
    mesh_front,
    pitch_circle,
    rack_front,
    rest_on_cam,
    ring_profile,
    stroke_lines,
    wavy_line,
    wheel_profile,
)
from shapely import LineString, Point, Polygon


def pieces(items: list[Item]) -> list[LineString]:
    """Return the lines that the pens draw on the paper."""
    return [
        LineString([(p.real, p.imag) for p in path])
        for item in items
        if isinstance(item, Stroke)
        for path in stroke_lines(item)
    ]


def inked(items: list[Item], place: complex, room: float = 0.9) -> bool:
    """Return whether a place is in a stroke, at least ``room`` mm from its ends."""
    here = Point(place.real, place.imag)
    return any(
        piece.distance(here) < 1e-6
        and min(Point(end).distance(here) for end in piece.coords) >= room
        for piece in pieces(items)
    )


@each("halves", range(18, 160))
def test_centre_lines_cross_in_strokes(halves: int) -> None:
    radius, centre = halves / 2, 3 + 4j
    items = centre_lines(centre, radius)
    pens = {item.pen for item in items if isinstance(item, Stroke)}
    if len(items) == 2:
        assert inked(items[:1], centre)
        assert inked(items[1:], centre)
    else:  # drawn from the centre outwards: all of them begin there with a stroke
        ends = [item.points[0] for item in items if isinstance(item, Stroke)]
        assert ends.count(centre) >= 2
    assert pens == {Pen.AXIS}
    reach = max(abs(p - centre) for item in items if isinstance(item, Stroke) for p in item.points)
    assert 2.0 <= reach - radius <= 5.0


def test_an_axis_too_short_for_its_pattern_is_solid() -> None:
    for length, pen in ((13.9, Pen.THIN), (14.1, Pen.AXIS)):
        (line,) = axis_line(0j, length + 0j)
        assert isinstance(line, Stroke)
        assert line.pen is pen
        assert len(pieces([line])) == (1 if pen is Pen.THIN else 3)


def test_centre_lines_of_small_circles_are_solid() -> None:
    for radius in (1.5, 5.9, 8.9):  # strokes do not fit on both sides of the last one
        one, two = centre_lines(0j, radius)
        assert isinstance(one, Stroke)
        assert isinstance(two, Stroke)
        assert one.pen is two.pen is Pen.THIN
    (small,) = pitch_circle(0j, 5.9)
    assert isinstance(small, Arc)
    assert small.pen is Pen.THIN


@pytest.mark.parametrize("place", [3.0, 10.5, 20.0, 31.0, 40.0])
def test_an_axis_is_crossed_in_a_stroke(place: float) -> None:
    items = axis_line(0j, 60 + 0j, place + 0j)
    met = [i for i in items if isinstance(i, Stroke) and place + 0j in i.points]
    assert inked(items, place + 0j) or len(met) == 2


@each("radius", [6.0, 9.0, 14.5, 22.0, 61.0])
@each("angle", [0.0, 1.0, pi, -2.0])
def test_a_pitch_circle_is_touched_in_a_stroke(radius: float, angle: float) -> None:
    (circle,) = pitch_circle(1j, radius, touch=1j + cmath.rect(radius, angle))
    assert isinstance(circle, Arc)
    start, turn = arc_spans(circle)[0]
    off = (angle - start) % tau
    assert off == pytest.approx(turn / 2)


@pytest.mark.parametrize("internal", [False, True])
def test_pitch_circles_touch_in_the_pitch_point(internal: bool) -> None:
    items = mesh_front(0j, 9.0, 12 + 16j, internal=internal)
    first, second = (i for i in items if isinstance(i, Arc) and i.pen is Pen.AXIS)
    (dot,) = (i for i in items if isinstance(i, Disc) and i.ink is Ink.BLACK)
    for circle in (first, second):
        assert abs(dot.centre - circle.centre) == pytest.approx(circle.radius)
    apart = abs(first.centre - second.centre)
    sign = -1 if internal else 1
    assert apart == pytest.approx(second.radius + sign * first.radius)
    # One line through both centres, crossed in both by a stroke.
    axis = [i for i in items if isinstance(i, Stroke) and abs((i.points[1] - i.points[0]).imag) > 9]
    for centre in (first.centre, second.centre):
        met = [i for i in axis if centre in i.points]
        assert inked(items, centre) or len(met) == 2
    rims = [i for i in items if isinstance(i, Arc) and i.pen is Pen.MAIN]
    assert len(rims) == internal
    assert all(rim.radius > second.radius for rim in rims)


def bars_along(items: list[Item]) -> list[float]:
    """Return the heights of the cross-bars, which are level here."""
    return sorted(
        item.points[0].imag
        for item in items
        if isinstance(item, Stroke)
        and item.tag != GROUND
        and isclose(item.points[0].imag, item.points[1].imag)
        and isclose(abs(item.points[0] - item.points[1]), SIZES.teeth)
    )


def test_cross_bars_of_meshing_wheels_are_apart_about_the_pitch_point() -> None:
    sun = wheel_profile(0j, 10.0, sides=(1,))
    planet = wheel_profile(16j, 6.0, loose=True)
    ring = ring_profile(0j, 22.0)
    lower, upper = bars_along(sun)[-1], bars_along(planet)[0]
    assert (lower + upper) / 2 == pytest.approx(10.0)
    assert upper - lower == pytest.approx(SIZES.mesh)
    top, over = bars_along(planet)[-1], bars_along(ring)[0]
    assert (top + over) / 2 == pytest.approx(22.0)
    # Between the lines of a mesh there is white, 0.8 mm at least.
    assert SIZES.mesh - PenSet().width(Pen.MAIN) >= 0.8
    assert any(isinstance(i, Stroke) and i.tag == GROUND for i in ring)


@pytest.mark.parametrize("web", [8.0, -8.0])
def test_a_ring_that_turns_comes_down_beside_its_mesh(web: float) -> None:
    (bell,) = bell_profile(0j, 22.0, web=web)
    assert isinstance(bell, Stroke)
    tooth, corner, foot = bell.points
    assert (corner, foot) == (web + 23j, web + 0j)
    assert tooth.real * web < 0


def test_a_loose_wheel_has_its_shaft_between_two_bars() -> None:
    hub = [y for y in bars_along(wheel_profile(0j, 8.0, loose=True)) if abs(y) < 2]
    assert hub == [-SIZES.mesh / 2, SIZES.mesh / 2]
    (disc, *_) = wheel_profile(0j, 8.0)
    assert isinstance(disc, Stroke)
    assert 0j in disc.points


@pytest.mark.parametrize("reach", [9.0, -9.0])
def test_a_carrier_comes_down_to_the_axis_beside_its_planet(reach: float) -> None:
    (arm,) = carrier_profile(5 + 16j, 5 + 0j, reach=reach)
    assert isinstance(arm, Stroke)
    assert arm.points[1:] == pytest.approx((5 + reach + 16j, 5 + reach + 0j))
    assert (arm.points[0] - 5).real * reach < 0


def test_a_rack_has_its_pitch_line_outside_its_body() -> None:
    body, *axis = rack_front(-20 + 0j, 20 + 0j)
    assert isinstance(body, Stroke)
    assert max(p.imag for p in body.points) < 0
    assert inked(axis, 0j) or len(axis) == 2


@pytest.mark.parametrize("nose", [0.0, 0.6, 1.57, 2.5, 4.0])
def test_a_roller_touches_its_cam(nose: float) -> None:
    (outline,) = cam(1 + 1j, nose=nose)
    assert isinstance(outline, Stroke)
    body = Polygon([(p.real, p.imag) for p in outline.points])
    at = rest_on_cam(1 + 1j, 1j, base=8.0, lift=6.0, nose=nose)
    assert at.real == pytest.approx(1.0)
    assert Point(at.real, at.imag).distance(body) == pytest.approx(ROLLER, abs=0.03)


def test_breaks_are_thin_and_end_where_they_should() -> None:
    for line in (*wavy_line(1 + 1j, 31 + 11j), *kinked_line(1 + 1j, 31 + 11j)):
        assert isinstance(line, Stroke)
        assert line.pen is Pen.BREAK
        assert line.points[0] == 1 + 1j
        assert line.points[-1] == pytest.approx(31 + 11j)
    (waves,) = wavy_line(0j, 48 + 0j)
    assert isinstance(waves, Stroke)
    signs = [p.imag > 0 for p in waves.points if abs(p.imag) > 0.05]
    assert sum(a != b for a, b in pairwise(signs)) >= 12
    (kinks,) = kinked_line(0j, 130 + 0j)
    assert isinstance(kinks, Stroke)
    assert len(kinks.points) == 2 + 3 * 4
