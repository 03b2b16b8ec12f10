"""Grid of a sheet: common left edges and upper lines, the last block, areas that stay free."""

from __future__ import annotations

from typing import TypeAlias

from doors import CuttingsUnit as Unit, Leaf, Spacer, box_of, on_grid, overlap
from hypothesis import given, strategies as st


def unit(left: float, low: float, right: float, high: float, share: float) -> Unit:
    wide, tall = share * (right - left), share * (high - low)
    leaf = Leaf(0, Spacer(wide, tall), wide, tall, text=False)
    return leaf, (left, low, right, high)


def test_blocks_are_aligned_where_possible() -> None:
    column = [unit(20, 200, 150, 290, 0.5), unit(20, 100, 150, 190, 0.9), unit(20, 5, 150, 90, 0.7)]
    moved = [box_of(one) for one in on_grid(column, 400 + 60j, [])]
    assert len({round(box[0], 6) for box in moved}) == 1
    before = [box_of(one) for one in column]
    assert len({round(box[0], 6) for box in before}) == 3


def test_the_lines_of_the_last_block_are_lines_of_the_grid() -> None:
    over = unit(350, 200, 580, 400, 0.6)
    (moved,) = on_grid([over], 404 + 120j, [])
    assert box_of(moved)[0] == 404


def test_a_block_keeps_clear_of_reserved_areas() -> None:
    graph = (20.0, 401.0, 90.0, 415.0)
    one, two = unit(25, 300, 200, 410, 0.5), unit(210, 300, 400, 410, 0.9)
    for moved in on_grid([one, two], 404 + 120j, [graph]):
        assert not overlap(box_of(moved), graph, 3.0)


Room: TypeAlias = tuple[float, float, float, float, float]
"""Left and lower side, width and height, and the share of them that the block takes."""

ROOMS = st.lists(
    st.tuples(
        st.floats(0, 300), st.floats(0, 300), st.floats(20, 200), st.floats(20, 200),
        st.floats(0.2, 1.0),
    ),
    min_size=1,
    max_size=8,
)  # fmt: skip


@given(ROOMS)
def test_every_block_stays_in_its_area(
    rooms: list[tuple[float, float, float, float, float]],
) -> None:
    units = [unit(x, y, x + w, y + h, share) for x, y, w, h, share in rooms]
    moved = on_grid(units, 150 + 150j, [])
    for (_, room), one in zip(units, moved, strict=True):
        box = box_of(one)
        assert room[0] - 1e-6 <= box[0]
        assert room[1] - 1e-6 <= box[1]
        assert box[2] <= room[2] + 1e-6
        assert box[3] <= room[3] + 1e-6
