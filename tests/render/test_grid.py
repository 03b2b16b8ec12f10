"""Grid of a sheet: common left edges and upper lines, the last block, areas that stay free."""

from __future__ import annotations

from itertools import combinations

import pytest
from doors import GAP, CuttingsUnit as Unit, Leaf, Spacer, box_of, on_grid, overlap
from hypothesis import example, given, strategies as st


def unit(left: float, low: float, right: float, high: float, share: float) -> Unit:
    wide, tall = share * (right - left), share * (high - low)
    leaf = Leaf(0, Spacer(wide, tall), wide, tall, text=False)
    return leaf, (left, low, right, high)


def test_blocks_are_aligned_where_possible() -> None:
    column = [unit(20, 200, 150, 290, 0.5), unit(20, 100, 150, 190, 0.9), unit(20, 5, 150, 90, 0.7)]
    moved = [box_of(one) for one in on_grid(column, 400.0, 290.0, [])]
    assert len({round(box[0], 6) for box in moved}) == 1
    before = [box_of(one) for one in column]
    assert len({round(box[0], 6) for box in before}) == 3


def test_the_lines_of_the_last_block_are_lines_of_the_grid() -> None:
    over = unit(350, 200, 580, 400, 0.6)
    (moved,) = on_grid([over], 404.0, 400.0, [])
    assert box_of(moved)[0] == 404


def test_a_block_keeps_clear_of_reserved_areas() -> None:
    graph = (20.0, 401.0, 90.0, 415.0)
    one, two = unit(25, 300, 200, 410, 0.5), unit(210, 300, 400, 410, 0.9)
    for moved in on_grid([one, two], 404.0, 410.0, [graph]):
        assert not overlap(box_of(moved), graph, 3.0)


def test_a_wide_block_goes_beside_a_reserved_area_under_which_it_is_too_high() -> None:
    """Otherwise it is lower than its area, and those under it are outside of the frame."""
    graph = (20.0, 278.0, 90.0, 292.0)
    leaf = Leaf(0, Spacer(248, 78), 248, 78, text=False)
    over, under = (leaf, (25.0, 205.5, 410.0, 287.0)), unit(25, 10, 150, 196.5, 1.0)
    first, second = (box_of(one) for one in on_grid([over, under], 404.0, 287.0, [graph]))
    assert not overlap(first, graph, 2.9)
    assert first[1] >= 205.5 and second[1] >= 10.0


COLUMNS = st.lists(
    st.tuples(
        st.floats(20, 200),
        st.lists(st.tuples(st.floats(20, 120), st.floats(0.2, 1.0)), min_size=1, max_size=4),
    ),
    min_size=1,
    max_size=4,
)
"""Width of every column, height of every area of it, and the share that its block takes."""


@given(COLUMNS)
@example([(163.0, [(20.0, 0.75), (20.0, 0.2)])])  # the lower block is narrow enough to rise beside
def test_blocks_rise_in_their_columns_and_rows_have_one_line(
    columns: list[tuple[float, list[tuple[float, float]]]],
) -> None:
    units, start = [], 20.0
    for width, areas in columns:
        high = 400.0
        for height, share in areas:
            units.append(unit(start, high - height, start + width, high, share))
            high -= height + GAP
        start += width + GAP
    moved = on_grid(units, 150.0, 400.0, [])
    boxes = [box_of(one) for one in moved]
    for (_, area), box in zip(units, boxes, strict=True):
        assert area[0] - 1e-6 <= box[0] <= box[2] <= area[2] + 1e-6
        assert area[1] - 1e-6 <= box[1] <= box[3] <= 400.0 + 1e-6
    assert not any(overlap(one, two, GAP - 1e-3) for one, two in combinations(boxes, 2))
    first = [box[3] for (_, area), box in zip(units, boxes, strict=True) if area[3] == 400.0]
    assert first == pytest.approx([400.0] * len(columns))
