from __future__ import annotations

import time
from itertools import combinations

import numpy as np
import pytest
from doors import (
    LABELS_SERIES as SERIES,
    NAMING,
    UNDER_LABEL,
    Arc,
    Bounds,
    Disc,
    DrawingItem as Item,
    Fill,
    Floats,
    LabelsLabel as Label,
    LabelStyle,
    Pen,
    Placed,
    Stroke,
    Text,
    crossing,
    inside,
    lettering,
    lint,
    paper,
    place_labels,
    revolute,
    segment_label,
    slider,
    typeset,
    using,
)
from hypothesis import given, settings, strategies as st
from msgspec.structs import replace
from numpy.typing import NDArray
from shapely import LineString, box
from worked import forget_cached

BOUNDS = (0.0, 0.0, 200.0, 150.0)

Places = NDArray[np.intp]


def apart(one: Bounds, two: Bounds) -> bool:
    return one[2] <= two[0] or two[2] <= one[0] or one[3] <= two[1] or two[3] <= one[1]


def label(markup: str, anchor: complex, prefer: complex = 0j) -> Label:
    return Label(typeset(markup, 3.5), anchor, prefer=prefer)


def within(bounds: Bounds, limits: Bounds) -> bool:
    low, high = zip(bounds[:2], limits[:2], strict=True), zip(bounds[2:], limits[2:], strict=True)
    return all(b >= m - 1e-9 for b, m in low) and all(b <= m + 1e-9 for b, m in high)


def middle(placed: Placed) -> complex:
    x0, y0, x1, y1 = placed.bounds
    return complex((x0 + x1) / 2, (y0 + y1) / 2)


@pytest.mark.parametrize("direction", [1, -1, 1j, -1j, 1 + 1j, -1 - 1j])
def test_a_free_label_looks_the_preferred_way(direction: complex) -> None:
    (placed,) = place_labels([label("B", 50 + 50j, direction)], [], BOUNDS)
    way = middle(placed) - (50 + 50j)
    assert (way * complex(direction).conjugate()).real > 0.8 * abs(way) * abs(direction)
    assert placed.free
    assert placed.leader is None


def test_a_label_keeps_its_gap() -> None:
    wide = Label(typeset("B_{3}", 5), 50 + 50j, gap=4.0, prefer=1 + 0j)
    (placed,) = place_labels([wide], [], BOUNDS)
    assert placed.bounds[0] == pytest.approx(54)


def test_a_label_avoids_lines_arcs_and_texts() -> None:
    items: list[Item] = [
        Stroke((50 + 50j, 100 + 50j)),
        Stroke((50 + 50j, 80 + 90j)),
        Arc(50 + 50j, 6),
        Text(56 + 44j, "занято", 5),
    ]
    (placed,) = place_labels([label("B", 50 + 50j, 1 + 0.4j)], items, BOUNDS)
    assert placed.free
    assert lint([*items, *placed.items()]) == []


def test_a_line_is_crossed_only_if_no_place_is_free() -> None:
    narrow = (0.0, 0.0, 12.0, 12.0)
    grid: list[Item] = [Stroke((complex(x, 0), complex(x, 12))) for x in range(13)]
    (placed,) = place_labels([label("B", 6 + 6j)], grid, narrow)
    assert not placed.free
    assert within(placed.bounds, narrow)


@pytest.mark.parametrize("prefer", [1j, -1j])
def test_a_segment_label_is_beside_the_middle_on_the_requested_side(prefer: complex) -> None:
    wanted = segment_label("2", 20 + 50j, 120 + 50j, 5, prefer=prefer)
    (placed,) = place_labels([wanted], [Stroke((20 + 50j, 120 + 50j))], BOUNDS)
    assert middle(placed).real == pytest.approx(70)
    assert (middle(placed).imag - 50) * prefer.imag > 0
    assert placed.leader is None


def test_a_segment_label_gives_way_along_the_segment() -> None:
    bar = Stroke((70 + 30j, 70 + 70j))
    wanted = segment_label("2", 20 + 50j, 120 + 50j, 5)
    (placed,) = place_labels([wanted], [Stroke((20 + 50j, 120 + 50j)), bar], BOUNDS)
    assert placed.free
    assert abs(middle(placed).real - 70) < 20


def test_a_far_label_gets_a_leader_line_that_ends_at_both() -> None:
    hedge: list[Item] = [Stroke((complex(40, y), complex(60, y))) for y in range(40, 61)]
    (placed,) = place_labels([label("B", 50 + 50j)], hedge, BOUNDS)
    assert placed.free
    assert placed.leader is not None
    start, end = placed.leader
    assert abs(start - 50 - 50j) < 1
    assert LineString([(end.real, end.imag), (end.real + 0.01, end.imag)]).distance(
        box(*placed.bounds)
    ) == pytest.approx(0.42, abs=0.02)
    assert isinstance(placed.items()[0], Stroke)


def name_of_vector(tail: complex, head: complex) -> Label:
    return Label(typeset("v_{B}", 3.5), (tail + head) / 2, (tail, head), gap=1.2, style=NAMING,
                 optional=True)  # fmt: skip


def hedge_beside(tail: complex, head: complex) -> list[Item]:
    """Return thin lines on both sides of a segment that leave no place for its name beside it."""
    off = (head - tail) / abs(head - tail) * 2.5j
    return [Stroke((tail + side, head + side), Pen.THIN) for side in (off, -off)]


def test_a_name_is_led_from_the_middle_part_of_its_vector() -> None:
    tail, head = 60 + 60j, 80 + 74j
    items = [Stroke((tail, head)), *hedge_beside(tail, head)]
    (placed,) = place_labels([name_of_vector(tail, head)], items, BOUNDS)
    assert placed.leader is not None
    assert min(abs(placed.leader[0] - end) for end in (tail, head)) > 4.0


def test_a_leader_crosses_no_arrowhead_and_no_vector() -> None:
    tail, head = 60 + 60j, 90 + 60j
    other = (50 + 68j, 100 + 68j)
    point = Fill((75 + 54j, 65 + 52j, 64 + 54j, 65 + 56j))  # the head of an arrow from the right
    items = [Stroke((tail, head)), *hedge_beside(tail, head), Stroke(other, Pen.THIN), point]
    (placed,) = place_labels([name_of_vector(tail, head)], items, BOUNDS, segments=[other])
    assert placed.leader is not None
    line = LineString([(end.real, end.imag) for end in placed.leader])
    assert not line.intersects(LineString([(50, 68), (100, 68)]))
    assert not line.intersects(box(64, 52, 75, 56))


def test_a_name_in_a_bundle_is_led_across_other_vectors_from_a_dot_on_its_own() -> None:
    tail, head = 60 + 60j, 110 + 60j
    around = [(5 + y * 1j, 190 + y * 1j) for y in (56, 58, 62, 64)]
    edge = (20 + 20j, 20 + 100j)  # the picture is high enough for the name
    items: list[Item] = [Stroke(line) for line in [(tail, head), *around, edge]]
    (placed,) = place_labels([name_of_vector(tail, head)], items, BOUNDS, segments=around)
    assert placed.leader is not None
    start, end = placed.leader
    assert abs(start.imag - 60) < 0.2
    assert not 56 < end.imag < 64
    dots = [item for item in placed.items() if isinstance(item, Disc)]
    assert [dot.centre for dot in dots] == [placed.leader[0]]
    assert dots[0].radius < 1.0  # touches no other line


def test_a_leader_does_not_begin_where_another_vector_is_as_near() -> None:
    tail, head = 60 + 60j, 110 + 60j
    beside = (55 + 60.4j, 96 + 60.4j)
    items = [Stroke((tail, head)), *hedge_beside(tail, head), Stroke(beside)]
    (placed,) = place_labels([name_of_vector(tail, head)], items, BOUNDS, segments=[beside])
    assert placed.leader is not None
    assert placed.leader[0].real > 96.4


def test_a_dotted_name_makes_the_picture_no_larger() -> None:
    tail, head = 60 + 60j, 110 + 60j
    around = [(5 + y * 1j, 190 + y * 1j) for y in (56, 58, 62, 64)]
    items: list[Item] = [Stroke(line) for line in [(tail, head), *around]]
    assert not place_labels([name_of_vector(tail, head)], items, BOUNDS, segments=around)


def test_a_name_that_needs_no_dot_has_none() -> None:
    tail, head = 60 + 60j, 110 + 60j
    (placed,) = place_labels([name_of_vector(tail, head)], [Stroke((tail, head))], BOUNDS)
    assert not any(isinstance(item, Disc) for item in placed.items())


@given(st.floats(0.0, 2 * np.pi), st.floats(12.0, 60.0))
def test_a_name_beside_its_vector_has_no_tick(turn: float, length: float) -> None:
    tail = 100 + 75j
    head = tail + length * complex(np.cos(turn), np.sin(turn))
    (placed,) = place_labels([name_of_vector(tail, head)], [Stroke((tail, head))], BOUNDS)
    assert placed.leader is None


def test_a_leader_may_start_inside_the_named_item() -> None:
    hedge: list[Item] = [Stroke((complex(40, y), complex(60, y))) for y in range(40, 61)]
    pin = [*slider(50 + 50j), *revolute(50 + 50j)]
    (placed,) = place_labels([label("B", 50 + 50j)], [*hedge, *pin], BOUNDS)
    assert placed.free
    assert placed.leader is not None


def test_no_label_inside_a_slider() -> None:
    wide = [*slider(50 + 50j, length=40, width=20), *revolute(50 + 50j)]
    (placed,) = place_labels([label("B", 50 + 50j)], wide, BOUNDS)
    assert placed.free
    assert apart(placed.bounds, (30, 40, 70, 60))


def test_labels_of_one_point_spread_around_it() -> None:
    many = [label(f"B_{{{k}}}", 60 + 60j, 1 + 1j) for k in range(8)]
    placed = place_labels(many, [], BOUNDS)
    assert all(p.free for p in placed)
    for one, two in combinations(placed, 2):
        assert apart(one.bounds, two.bounds)


def test_priority_takes_the_better_place() -> None:
    first, second = label("A", 60 + 60j, 1 + 0j), label("B", 60 + 60j, 1 + 0j)
    important = Label(second.inscription, second.anchor, prefer=1 + 0j, priority=1)
    a, b = place_labels([first, important], [], BOUNDS)
    alone = place_labels([second], [], BOUNDS)[0]
    assert b.at == alone.at
    assert a.at != b.at


def test_same_input_same_places() -> None:
    many = [label(f"P_{{{k}}}", 50 + 3 * k + 40j, 1j) for k in range(12)]
    lines: list[Item] = [Stroke((40 + 40j, 90 + 41j))]
    first = place_labels(many, lines, BOUNDS)
    forget_cached()
    assert place_labels(many, lines, BOUNDS) == first


def test_places_are_those_of_the_lettering_in_use() -> None:
    """Upright and slanted letters may be as wide, and yet the ink of other texts is elsewhere."""
    rng = np.random.default_rng(5)
    wanted = [label("B", 50 + 50j), label("A", 60 + 55j, 1j)]
    places = 45 + 25 * rng.random(40) + 1j * (40 + 25 * rng.random(40))
    upright, differ = lettering("B-upright"), 0
    for at in places:
        texts = [Text(complex(at), "8", 5.0), Text(complex(at) + 9 - 7j, "B", 7.0)]
        slanted = place_labels(wanted, texts, BOUNDS)
        with using(upright):
            after = place_labels(wanted, texts, BOUNDS)
            forget_cached()
            assert place_labels(wanted, texts, BOUNDS) == after
        differ += slanted != after
    assert differ


def test_a_style_equal_to_that_of_few_is_that_of_few() -> None:
    rng = np.random.default_rng(6)
    hedge: list[Item] = [Stroke((complex(40, y), complex(70, y))) for y in range(40, 61)]
    for at in 40 + 30 * rng.random(20) + 1j * (40 + 20 * rng.random(20)):
        few = [label("B", complex(at)), label("A", complex(at) + 3)]
        same = [replace(one, style=LabelStyle()) for one in few]
        found = [(one.at, one.ground) for one in place_labels(few, hedge, BOUNDS)]
        forget_cached()
        assert [(one.at, one.ground) for one in place_labels(same, hedge, BOUNDS)] == found


def test_places_are_the_same_however_few_are_compared_at_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A cam with its roller has a million places and lines: their memory is bounded by parts."""
    points = [100 + 75j + (10 + k) * np.exp(2.4j * k) for k in range(40)]
    spokes: list[Item] = [Stroke((100 + 75j, complex(z)), Pen.THIN) for z in points]
    labels = [of_a_series(k, complex(z)) for k, z in enumerate(points)]
    sizes: list[int] = []

    def compared(one: Floats, two: Floats, i: Places, j: Places) -> NDArray[np.bool_]:
        if i is not j:  # places with lines; leaders of placed labels are compared pair by pair
            sizes.append(len(i))
        return crossing(one, two, i, j)

    monkeypatch.setattr(paper, "crossing", compared)
    together, largest = place_labels(labels, spokes, BOUNDS), max(sizes)
    most = largest // 4
    monkeypatch.setattr(paper, "_PAIRS", most)
    sizes.clear()
    forget_cached()
    assert place_labels(labels, spokes, BOUNDS) == together
    assert max(sizes) <= most


def test_no_labels() -> None:
    assert place_labels([], [Stroke((0j, 1 + 1j))], BOUNDS) == []


places = st.builds(complex, st.floats(15, 185), st.floats(15, 135))
ways = st.builds(complex, st.floats(-40, 40), st.floats(-40, 40))


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.tuples(places, ways, st.booleans()), min_size=5, max_size=45),
    st.lists(st.tuples(places, ways), max_size=25),
)
def test_labels_never_overlap_however_crowded(
    wanted: list[tuple[complex, complex, bool]], drawn: list[tuple[complex, complex]]
) -> None:
    lines: list[Item] = [Stroke((a, a + way)) for a, way in drawn if abs(way) > 1]
    labels = [
        segment_label(f"v_{{{k}}}", at, at + way) if beside else label(f"B_{{{k}}}", at, way)
        for k, (at, way, beside) in enumerate(wanted)
    ]
    placed = place_labels(labels, lines, BOUNDS)
    for one, two in combinations(placed, 2):
        assert apart(one.bounds, two.bounds)
    assert all(within(p.bounds, BOUNDS) for p in placed)
    items = [*lines, *(item for p in placed for item in p.items())]
    told = {f.code for f in lint(items, BOUNDS)}
    assert "PM-D01" not in told
    assert "PM-D04" not in told
    if all(p.free for p in placed):
        assert told == set()


@given(places, ways, places, st.floats(0.1, 60), st.floats(0.1, 60))
def test_clipping_agrees_with_shapely(
    at: complex, way: complex, corner: complex, width: float, height: float
) -> None:
    end = at + way
    bounds = (corner.real, corner.imag, corner.real + width, corner.imag + height)
    segment = np.array([[[at.real, at.imag], [end.real, end.imag]]])
    (length,) = inside(segment, np.array([bounds]))
    common = LineString(segment[0]).intersection(box(*bounds))
    assert max(length, 0.0) == pytest.approx(common.length, abs=1e-6)


# Crowds -------------------------------------------------------------------------------------------


def of_a_series(k: int, anchor: complex) -> Label:
    return Label(
        typeset(f"B_{{{k}}}", 3.5), anchor, prefer=1 + 0j, gap=1.0, style=SERIES, series="B"
    )


def crossings(placed: list[Placed]) -> int:
    lines = [
        LineString([(z.real, z.imag) for z in label.leader]) for label in placed if label.leader
    ]
    return sum(one.crosses(two) for one, two in combinations(lines, 2))


@pytest.mark.parametrize("way", [1j, 1 + 0j, 1 + 2j])
def test_close_points_get_a_column_of_labels_in_their_order(way: complex) -> None:
    points = [90 + 70j + 1.2 * k * way / abs(way) for k in range(10)]
    dots: list[Item] = [Arc(z, 0.4) for z in points]
    placed = place_labels([of_a_series(k, z) for k, z in enumerate(points)], dots, BOUNDS)
    assert all(p.free for p in placed)
    assert crossings(placed) == 0
    assert lint([*dots, *(item for p in placed for item in p.items())], BOUNDS) == []
    if way == 1j:
        left = [p for p in placed if middle(p).real < 90]
        right = [p for p in placed if middle(p).real > 90]
        assert len({round(p.bounds[2], 6) for p in left}) <= 1
        assert len({round(p.bounds[0], 6) for p in right}) <= 1
        for side in (left, right):
            assert [middle(p).imag for p in side] == sorted(middle(p).imag for p in side)


def test_far_points_of_a_series_have_their_labels_beside_them() -> None:
    points = [40 + 30j + 12j * k for k in range(8)]
    placed = place_labels([of_a_series(k, z) for k, z in enumerate(points)], [], BOUNDS)
    assert all(p.free and p.leader is None for p in placed)
    assert all(p.bounds[0] == pytest.approx(41.0) for p in placed)  # all on the preferred side


def test_a_column_keeps_clear_of_existing_items() -> None:
    points = [90 + 70j + 1j * k for k in range(8)]
    wall: list[Item] = [Stroke((96 + 20j, 96 + 130j)), *slider(80 + 74j, length=12, width=16)]
    placed = place_labels([of_a_series(k, z) for k, z in enumerate(points)], wall, BOUNDS)
    assert all(p.free for p in placed)
    assert lint([*wall, *(item for p in placed for item in p.items())], BOUNDS) == []


def test_a_label_sends_another_away() -> None:
    """The second can only be in the gap that the first one took, the first has another."""
    hedge: list[Item] = [
        Stroke((complex(x, 20), complex(x, 130))) for x in (*range(20, 90), *range(100, 180))
    ]
    posts: list[Item] = [
        Stroke((complex(90, y), complex(100, y))) for y in (*range(20, 60), *range(66, 72))
    ]
    posts += [Stroke((complex(90, y), complex(100, y))) for y in range(78, 130)]
    first = Label(typeset("A", 3.5), 95 + 69j, prefer=-1j, style=SERIES, priority=1)
    second = Label(typeset("B", 3.5), 95 + 57j, prefer=1j, style=SERIES)
    placed = place_labels([first, second], [*hedge, *posts], BOUNDS)
    assert all(p.free for p in placed)


def test_a_crowded_label_breaks_thin_lines_before_thick_ones() -> None:
    wall: list[Item] = [
        *(Stroke((complex(x, 0), complex(x, 150)), Pen.THIN) for x in range(0, 200, 2)),
        *(Stroke((complex(0, y), complex(200, y)), Pen.MAIN) for y in range(0, 150, 9)),
    ]
    (placed,) = place_labels([of_a_series(1, 95 + 70j)], wall, BOUNDS)
    assert placed.ground
    assert not placed.free
    items = placed.items()
    whites = [item for item in items if isinstance(item, Fill)]
    assert [item.tag for item in whites] == [UNDER_LABEL]
    assert lint([*wall, *items], BOUNDS) == []
    (kept,) = place_labels([of_a_series(1, 95 + 70j)], wall, BOUNDS, may_interrupt_lines=False)
    assert not kept.ground
    assert not kept.free


def test_a_letter_at_the_end_of_a_long_leader_line_comes_near_on_a_thin_line() -> None:
    # Free white is 36 mm away: nearer there is a thin line every 5 mm, but no thick one.
    grid: list[Item] = [
        Stroke((complex(x, 0), complex(x, 150)), Pen.THIN) for x in range(62, 140, 4)
    ]
    letter = replace(label("O", 100 + 75j), style=SERIES)
    (placed,) = place_labels([letter], grid, BOUNDS)
    assert placed.ground
    assert placed.leader is None or abs(placed.leader[1] - placed.leader[0]) < 24
    heavy: list[Item] = [replace(line, pen=Pen.MAIN) for line in grid if isinstance(line, Stroke)]
    (far,) = place_labels([letter], heavy, BOUNDS)
    assert not far.ground
    assert far.leader is not None
    assert abs(far.leader[1] - far.leader[0]) > 30


def test_the_name_of_a_segment_is_not_at_another_one() -> None:
    manner = replace(SERIES, stranger=25.0)
    one, two = (50 + 50j, 80 + 50j), (50 + 62j, 80 + 62j)
    # There is no space under either: between them the upper one's name is nearer to its own.
    floor: list[Item] = [Stroke((complex(20, y), complex(110, y))) for y in (46, 48, 65, 67)]
    names = [
        replace(segment_label(text, *line), segment=line, style=manner)
        for text, line in (("F", one), ("G", two))
    ]
    placed = place_labels(names, floor, BOUNDS)
    for found, own, other in ((placed[0], one, two), (placed[1], two, one)):
        letters = box(*found.bounds)
        near, far = (letters.distance(LineString([(p.real, p.imag) for p in line]))
                     for line in (own, other))  # fmt: skip
        assert near < far


def test_a_hundred_labels_in_a_moment() -> None:
    points = [100 + 75j + 60 * np.exp(2j * np.pi * k / 97) * (1 - k % 4 / 5) for k in range(100)]
    spokes: list[Item] = [Stroke((100 + 75j, complex(z)), Pen.THIN) for z in points[::9]]
    labels = [of_a_series(k, complex(z)) for k, z in enumerate(points)]
    start = time.process_time()
    placed = place_labels(labels, spokes, BOUNDS)
    assert time.process_time() - start < 5.0
    for one, two in combinations(placed, 2):
        assert apart(one.bounds, two.bounds)
