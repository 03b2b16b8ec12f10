"""Lines start, end and turn with strokes, and their lengths stay within the standard."""

from __future__ import annotations

from cmath import exp
from itertools import pairwise
from math import pi, tau

import pytest
from cases import each
from doors import (
    HEIGHTS,
    PENS,
    Arc,
    Dashes,
    Pen,
    PenSet,
    PlanKind,
    Solution,
    Stroke,
    arc_spans,
    closes,
    dash_spans,
    dashed,
    frame_paper_format,
    plan_picture,
    stroke_lines,
    sweep,
)
from worked import problem_of

DASHED = [style.dashes for style in PENS.values() if style.dashes]
LENGTHS = [0.01, 1.0, 3.9, 5.4, 5.6, 13.9, 14.1, 15.0, 27.3, 100.0, 333.3, 1189.0]


def length(line: tuple[complex, ...]) -> float:
    return sum(abs(b - a) for a, b in pairwise(line))


@each(
    "paper, s",
    [("A4", 0.6), ("A3", 0.8), ("A4x3", 0.8), ("A3:portrait", 0.8), ("A2", 0.8), ("A1", 1.0),
     ("A2x3", 1.0), ("A0", 1.0), ("A1x4", 1.0)],
)  # fmt: skip
def test_every_pen_has_a_width_by_the_format(paper: str, s: float) -> None:
    assert set(PENS) == set(Pen)
    pens = PenSet.of(frame_paper_format(paper))
    vectors = {Pen.RESULTANT: 0.7, Pen.RELATIVE: 0.7, Pen.COMPONENT: 0.5}
    vectors |= {Pen.FINE_RESULTANT: 0.5, Pen.FINE_RELATIVE: 0.5}
    assert {pens.width(pen) for pen in (Pen.MAIN, Pen.FRAME)} == {s}
    assert all(pens.width(pen) == pytest.approx(part * s) for pen, part in vectors.items())
    assert s / 2 <= pens.width(Pen.THICK_AXIS) <= 2 * s / 3
    # GOST 2.303: a third to a half; to the hundredth of a millimetre.
    thin = set(Pen) - {Pen.MAIN, Pen.FRAME, Pen.THICK_AXIS, *vectors}
    assert all(max(0.25, s / 3 - 0.005) <= pens.width(pen) <= s / 2 for pen in thin)
    assert list(HEIGHTS) == sorted(HEIGHTS)


def test_colours_can_be_read_on_white_and_are_used_only_in_colour() -> None:
    for pen in Pen:
        linear = [
            part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4
            for part in (one / 255 for one in PenSet(is_coloured=True).colour(pen))
        ]
        light = sum(k * part for k, part in zip((0.2126, 0.7152, 0.0722), linear, strict=True))
        assert 1.05 / (light + 0.05) >= 4.5, pen  # the contrast of WCAG 2.1
        assert len(set(PenSet().colour(pen))) == 1
    used = {pen: PenSet(is_coloured=True).colour(pen) for pen in Pen}
    assert used[Pen.MAIN] == used[Pen.FRAME] == used[Pen.LETTER] == (0, 0, 0)
    roles = (Pen.MAIN, Pen.RESULTANT, Pen.RELATIVE, Pen.COMPONENT, Pen.THIN)
    assert len({used[pen] for pen in roles}) == len(roles)


@each("dashes", DASHED)
@each("total", LENGTHS)
def test_open_line_starts_and_ends_with_a_stroke(dashes: Dashes, total: float) -> None:
    spans = dash_spans(total, dashes)
    assert spans[0][0] == 0.0
    assert spans[-1][1] == total
    assert all(a[1] < b[0] for a, b in pairwise(spans))
    lengths = [b - a for a, b in spans]
    strokes = lengths[:: 1 + len(dashes.inside)]
    assert max(strokes) - min(strokes) < 1e-9
    if len(spans) > 1:
        assert strokes[0] >= dashes.min_stroke - 1e-9
        assert strokes[0] < 2.0 * dashes.stroke
        whole = [b[0] - a[1] for a, b in pairwise(spans)]
        dots = len(dashes.inside)
        gap = (dashes.gap - dots * dashes.dot) / (dots + 1)
        assert whole == pytest.approx([gap] * len(whole))
    else:
        assert total < 2.0 * dashes.min_stroke + dashes.gap


# GOST 2.303: least and greatest stroke, least and greatest gap, dots in a gap.
NORMS = {
    Pen.AXIS: (5, 30, 3, 5, 1),
    Pen.THICK_AXIS: (3, 8, 3, 4, 1),
    Pen.PHANTOM: (5, 30, 4, 6, 2),
    Pen.HIDDEN: (2, 8, 1, 2, 0),
}


@pytest.mark.parametrize("pen", NORMS)
def test_dashes_are_those_of_the_standard_on_every_length(pen: Pen) -> None:
    least, most, narrow, wide, dots = NORMS[pen]
    dashes = PENS[pen].dashes
    assert dashes
    assert narrow <= dashes.gap <= wide
    shown = 0
    for tenths in range(50, 4000, 7):
        spans = dash_spans(tenths / 10, dashes)
        if len(spans) == 1:
            continue
        shown += 1
        assert (len(spans) - 1) % (dots + 1) == 0
        assert all(least - 1e-9 <= b - a <= most for a, b in spans[:: dots + 1])
    assert shown > 500


def test_a_period_is_a_stroke_and_its_gap() -> None:
    assert Dashes(12.0, 5.0, 5.0, 1.0, 2).period == (12.0, -1.0, 1.0, -1.0, 1.0, -1.0)
    assert Dashes(12.0, 5.0, 4.0, 1.0).period == (12.0, -1.5, 1.0, -1.5)
    assert Dashes(4.0, 2.0, 1.5).period == (4.0, -1.5)


@pytest.mark.parametrize("dashes", DASHED)
def test_closed_line_has_no_seam(dashes: Dashes) -> None:
    total = 123.4
    spans = dash_spans(total, dashes, closed=True)
    first_gap = spans[1][0] - spans[0][1]
    assert total - spans[-1][1] == pytest.approx(first_gap)


@pytest.mark.parametrize("dashes", DASHED)
def test_corner_is_a_corner_of_one_stroke(dashes: Dashes) -> None:
    corner = 50 + 0j
    lines = dashed((0j, 20 + 0j, corner, 50 + 40j), dashes)
    assert lines[0][0] == 0j
    assert lines[-1][-1] == 50 + 40j
    assert sum(corner in line[1:-1] for line in lines) == 1
    assert all(20 + 0j not in (line[0], line[-1]) for line in lines)


def test_closed_polygon_is_cornered_by_strokes_all_round() -> None:
    corners = (0j, 60 + 0j, 60 + 40j, 40j)
    lines = dashed(corners, DASHED[0], closed=True)
    # The corner where the line begins is met by the first stroke and by the last.
    assert lines[0][0] == lines[-1][-1] == corners[0]
    for corner in corners[1:]:
        assert sum(corner in line[1:-1] for line in lines) == 1


def test_smooth_curve_is_dashed_by_its_length() -> None:
    hidden = PENS[Pen.HIDDEN].dashes
    assert hidden
    points = tuple(30 * exp(1j * k * pi / 180) for k in range(181))
    lines = dashed(points, hidden)
    assert [length(line) for line in lines] == pytest.approx([length(lines[0])] * len(lines))
    assert all(abs(abs(point) - 30) < 0.01 for line in lines for point in line)
    ring = dashed(tuple(30 * exp(1j * k * pi / 90) for k in range(180)), hidden, closed=True)
    assert [length(line) for line in ring] == pytest.approx([length(ring[0])] * len(ring))


def test_lines_without_length_leave_no_ink() -> None:
    for points in ((), (1 + 1j,), (1 + 1j, 1 + 1j)):
        assert dashed(points, DASHED[0]) == []
        assert dashed(points, DASHED[0], closed=True) == []
    assert dash_spans(0.0, DASHED[0]) == ()


def test_there_and_back_is_a_corner() -> None:
    lines = dashed((0j, 30 + 0j, 0j), DASHED[0])
    assert any(30 + 0j in line[1:-1] for line in lines)
    assert dashed((0j, 30 + 0j), DASHED[0], closed=True)


@pytest.mark.parametrize(
    ("start", "end", "turn"),
    [
        (0.0, tau, tau),
        (1.0, 1.0 - tau, tau),
        (0.0, 3 * tau, tau),
        (0.0, pi / 2, pi / 2),
        (pi / 2, 0.0, 3 * pi / 2),
        (-pi / 2, pi / 2, pi),
        (350 * pi / 180, 370 * pi / 180, 20 * pi / 180),
        (1.0, 1.0, 0.0),
    ],
)
def test_sweep_is_counter_clockwise(start: float, end: float, turn: float) -> None:
    assert sweep(Arc(0j, 5.0, start, end)) == pytest.approx(turn)


def test_pieces_of_solid_and_dashed_items() -> None:
    square = (0j, 40 + 0j, 40 + 40j, 40j)
    solid = Stroke(square, Pen.MAIN, closed=True)
    assert stroke_lines(solid) == [square]
    assert closes(solid)
    assert not closes(Stroke(square, Pen.HIDDEN, closed=True))
    assert arc_spans(Arc(0j, 5.0)) == [(0.0, tau)]
    assert arc_spans(Arc(0j, 5.0, 1.0, 1.0)) == []
    assert arc_spans(Arc(0j, 0.0)) == []
    # A circle below 12 mm: its centre line is solid.
    assert arc_spans(Arc(0j, 1.0, pen=Pen.AXIS)) == [(0.0, tau)]
    spans = arc_spans(Arc(0j, 40.0, 1.0, 3.0, Pen.AXIS))
    assert spans[0][0] == 1.0
    assert sum(spans[-1]) == pytest.approx(3.0)


def test_vectors_of_many_plans_have_finer_lines_of_the_same_colours() -> None:
    """Small plans are not clogged; a plan of few positions keeps the usual lines."""
    problem = problem_of("linkages/ex3")
    coloured = PenSet(is_coloured=True)
    for fine, usual in ((Pen.FINE_RESULTANT, Pen.RESULTANT), (Pen.FINE_RELATIVE, Pen.RELATIVE)):
        assert coloured.colour(fine) == coloured.colour(usual)
        assert coloured.width(fine) < coloured.width(usual)
        assert coloured.head(fine) < coloured.head(usual)
    for count, absolute in ((2, Pen.RESULTANT), (6, Pen.FINE_RESULTANT)):
        solution = Solution(problem, positions=[20.0 + 20.0 * k for k in range(count)])
        items = plan_picture(solution, PlanKind.VELOCITY, 0).items
        drawn = {i.pen for i in items if isinstance(i, Stroke) and i.tag == "absolute"}
        assert drawn == {absolute}
