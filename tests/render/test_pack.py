"""Packing: order, groups, the cost of a cutting, boxes that stay free."""

from __future__ import annotations

from itertools import combinations, pairwise

import pytest
from doors import (
    CLEAR,
    EDGE,
    GAP,
    Alternatives,
    Arrange,
    Bounds,
    DrawingArea,
    Group,
    LayoutItem,
    Spacer,
    TableColumn,
    largest_empty_fraction,
    pack,
    table_block,
)
from hypothesis import given, settings, strategies as st

INNER: Bounds = (20.0, 5.0, 589.0, 415.0)  # A2
STAMP: Bounds = (404.0, 5.0, 589.0, 60.0)
AREA = DrawingArea(INNER, STAMP)
LEFT: Bounds = (20.0, 401.0, 90.0, 415.0)  # graph 26 in the upper left corner
RIGHT: Bounds = (575.0, 345.0, 589.0, 415.0)  # and in the upper right one, turned


def part(width: float, height: float, *, text: bool = False) -> LayoutItem:
    return LayoutItem(Spacer(width, height), text)


def boxes(
    whole: Group, inner: Bounds = INNER, taken: tuple[Bounds, ...] = ()
) -> list[Bounds] | None:
    """Return the boxes of the blocks, in reading order."""
    placed = pack(whole, DrawingArea(inner, STAMP, taken))
    if placed is None:
        return None
    return [
        (at.real, at.imag - block.height, at.real + block.width, at.imag) for block, at in placed
    ]


def gap(one: Bounds, two: Bounds) -> float:
    """Return the white between two boxes in the direction that has more; negative on overlap."""
    across = max(one[0] - two[2], two[0] - one[2])
    along = max(one[1] - two[3], two[1] - one[3])
    return max(across, along)


def hull(some: list[Bounds]) -> Bounds:
    left, low, right, high = zip(*some, strict=True)
    return min(left), min(low), max(right), max(high)


def check(found: list[Bounds], inner: Bounds = INNER, taken: tuple[Bounds, ...] = ()) -> None:
    for box in found:
        assert box[0] >= inner[0] + EDGE - 1e-6
        assert box[1] >= inner[1] + EDGE - 1e-6
        assert box[2] <= inner[2] - EDGE + 1e-6
        assert box[3] <= inner[3] - EDGE + 1e-6
    for one, two in combinations(found, 2):
        assert gap(one, two) >= GAP - 1e-6
    for one in found:
        assert gap(one, STAMP) >= GAP / 2 - 1e-6
        assert all(gap(one, box) >= CLEAR - 1e-6 for box in taken)


ONE_POSITION = Group(
    (
        Group((part(150, 110), part(175, 24, text=True))),
        Group((part(100, 90), part(60, 60, text=True), part(150, 75, text=True))),
        Group((part(140, 100), part(70, 85, text=True), part(150, 105, text=True))),
        part(260, 28),
    )
)


def test_blocks_keep_clear_of_each_other_and_of_the_frame() -> None:
    found = boxes(ONE_POSITION)
    assert found is not None
    check(found)


def test_the_last_block_is_on_the_title_block_and_a_wide_low_one_beside_it() -> None:
    wide, high = (
        Group((*ONE_POSITION.members[:-1], last)) for last in (part(300, 28), part(260, 130))
    )
    for whole, right, low in (
        (wide, STAMP[0] - GAP / 2, INNER[1] + EDGE),
        (high, INNER[2] - EDGE, STAMP[3] + GAP / 2),
    ):
        found = boxes(whole)
        assert found is not None
        check(found)
        assert found[-1][1] == pytest.approx(low)
        assert found[-1][2] == pytest.approx(right)


def test_no_block_is_among_those_of_a_group() -> None:
    found = boxes(ONE_POSITION)
    assert found is not None
    groups = [found[:2], found[2:5], found[5:8]]
    for one, two in combinations(groups, 2):
        assert gap(hull(one), hull(two)) >= GAP - 1e-6


def together(arrange: Arrange) -> list[Bounds]:
    texts = Group((part(60, 60, text=True), part(150, 75, text=True)), arrange)
    found = boxes(Group((part(250, 180), texts, part(180, 20))))
    assert found is not None
    return found


def test_texts_under_one_another_have_one_left_edge() -> None:
    _, one, two, _ = together("column")
    assert one[0] == pytest.approx(two[0])
    assert one[1] - two[3] == pytest.approx(GAP)


def test_texts_side_by_side_have_one_upper_edge() -> None:
    _, one, two, _ = together("row")
    assert one[3] == pytest.approx(two[3])
    assert two[0] - one[2] == pytest.approx(GAP)


@pytest.mark.parametrize(("arrange", "axis"), [("row", 0), ("column", 1)])
def test_a_group_is_arranged_as_requested(arrange: Arrange, axis: int) -> None:
    members = (part(60, 40), part(50, 60), part(70, 30))
    whole = Group((Group(members, arrange), part(180, 30)))
    found = boxes(whole)
    assert found is not None
    for before, after in pairwise(found[:3]):
        if axis == 0:
            assert after[0] >= before[2] + GAP - 1e-6
        else:
            assert after[3] <= before[1] - GAP + 1e-6


def test_a_group_that_does_not_fit_gives_none() -> None:
    assert boxes(Group((part(600, 50), part(180, 20)))) is None
    assert boxes(Group((part(300, 300), part(300, 300), part(180, 20)))) is None
    row = Group((part(300, 50), part(300, 50)), "row")
    assert boxes(Group((row, part(180, 20)))) is None


def test_a_group_taken_apart_is_a_sequence_of_its_parts() -> None:
    inner = Group((part(1, 1), part(2, 2)))
    whole = Group((Group((inner, Group((part(3, 3),), "row")), "row"), part(4, 4)), "column")
    assert whole.flat() == Group(tuple(whole.parts()))
    assert whole.inner() == Group((inner, Group((part(3, 3),)), part(4, 4)))


# Boxes that stay free -----------------------------------------------------------------------------


@pytest.mark.parametrize("taken", [(LEFT,), (RIGHT,), (LEFT, RIGHT)])
def test_blocks_keep_clear_of_occupied_areas(taken: tuple[Bounds, ...]) -> None:
    found = boxes(ONE_POSITION, taken=taken)
    assert found is not None
    check(found, taken=taken)


@pytest.mark.parametrize(
    ("first", "arrange"), [(part(540, 280), "column"), (part(200, 395), "row")]
)
def test_a_block_in_the_corner_moves_down_or_aside(first: LayoutItem, arrange: Arrange) -> None:
    whole = Group((first, part(180, 30)), arrange)
    plain, moved = boxes(whole), boxes(whole, taken=(LEFT,))
    assert plain is not None
    assert moved is not None
    check(moved, taken=(LEFT,))
    assert moved[1] == plain[1]  # the others stay
    if arrange == "column":
        assert plain[0][3] > LEFT[1] - CLEAR
        assert moved[0][3] == pytest.approx(LEFT[1] - CLEAR, abs=10.0)
        assert moved[0][0] == plain[0][0]
    else:
        assert plain[0][0] < LEFT[2] + CLEAR <= moved[0][0]
        assert moved[0][3] == plain[0][3]


def test_titles_are_on_one_line_below_the_corner() -> None:
    """The block in the corner has no title on the line of others if these are beside its box."""
    whole = Group((part(100, 100), part(120, 200), part(180, 30)))
    plain, moved = boxes(whole), boxes(whole, taken=(LEFT,))
    assert plain is not None
    assert moved is not None
    check(moved, taken=(LEFT,))
    for found, top in ((plain, INNER[3] - EDGE), (moved, LEFT[1] - CLEAR)):
        assert [box[3] for box in found[:2]] == pytest.approx([top, top])


def test_titles_of_the_first_row_are_on_one_line() -> None:
    """A text that is read before a view is not put above it: its title would be lower."""
    texts = part(150, 40, text=True), part(150, 60, text=True)
    whole = Group((part(150, 150), *texts, part(160, 180), part(120, 160), part(180, 30)))
    found = boxes(whole)
    assert found is not None
    check(found)
    above = [box for box in found[:1] + found[3:5] if box[3] > 300]
    assert len(above) > 1
    assert len({round(box[3], 6) for box in above}) == 1


def test_white_is_under_the_blocks_of_a_column() -> None:
    """Texts follow their view at the usual distance, however much white there is."""
    group = Group((part(150, 100), part(150, 24, text=True)), "column")
    found = boxes(Group((group, part(140, 220), part(180, 30))))
    assert found is not None
    check(found)
    assert found[0][1] - found[1][3] == pytest.approx(GAP)
    assert found[0][0] == found[1][0]


def test_a_table_ends_at_the_edge_of_the_title_block() -> None:
    columns = [TableColumn(f"v_{k}", 8 * ("1",), width=26.0) for k in range(8)]
    for width in (100.0, 185.0, 208.0):
        table = table_block(columns[: int(width / 26.0)], width=width, title="Results")
        found = boxes(Group((part(150, 100), part(150, 90), LayoutItem(table))))
        assert found is not None
        left, _, right, _ = found[-1]
        assert left == STAMP[0] if width <= 185.0 else right == INNER[2]


def test_all_blocks_keep_clear_if_none_can_move() -> None:
    """The space of the corner's block is full: the strip beside the box is left free."""
    whole = Group((part(480, 395), part(50, 200), part(180, 30)))
    narrow = Group((part(270, 395), part(180, 30)))
    assert boxes(whole, taken=(LEFT,)) is None
    found = boxes(narrow, taken=(LEFT,))
    assert found is not None
    check(found, taken=(LEFT,))


@settings(deadline=None, max_examples=60)
@given(
    sizes=st.lists(
        st.tuples(st.floats(15, 220), st.floats(10, 150), st.booleans()), min_size=1, max_size=7
    ),
    cuts=st.sets(st.integers(1, 6), max_size=3),
    taken=st.sampled_from([(), (LEFT,), (RIGHT,), (LEFT, RIGHT)]),
)
def test_any_blocks_that_fit_are_apart(
    sizes: list[tuple[float, float, bool]], cuts: set[int], taken: tuple[Bounds, ...]
) -> None:
    parts = [part(width, height, text=text) for width, height, text in sizes]
    edges = [0, *sorted(cut for cut in cuts if cut < len(parts)), len(parts)]
    whole = Group(tuple(Group(tuple(parts[i:j])) for i, j in pairwise(edges)))
    found = boxes(whole, taken=taken)
    if found is not None:
        check(found, taken=taken)


# Columns ------------------------------------------------------------------------------------------

FORCES = Group(
    (
        Group((part(140, 90), part(150, 60, text=True))),
        Group((Group((part(90, 70), part(140, 50, text=True), part(100, 60))),)),
        Group((part(100, 60), part(120, 30, text=True))),
        part(180, 60),
    ),
    "columns",
)


def test_blocks_in_columns_have_common_left_edges_and_titles_on_one_line() -> None:
    found = boxes(FORCES)
    assert found is not None
    check(found)
    assert len({round(box[0], 6) for box in found[:-1]}) <= 4
    first = [box for box in found[:-1] if all(one[3] <= box[3] + 1e-6 for one in found)]
    assert len(first) >= 2
    # A text is under its view or beside it, never at the head of a column of its own.
    for view, text in ((0, 1), (2, 3), (5, 6)):
        assert found[text][1] < found[view][3]
        below = found[text][0] == pytest.approx(found[view][0])
        assert below or found[text][3] == pytest.approx(found[view][3])


def test_no_column_ends_between_a_text_and_the_view_that_it_leads_to() -> None:
    """Columns that part them would be fuller."""
    loads, cut, text, plan, lever = (
        part(wide, high, text=high == 60)
        for wide, high in ((150, 190), (90, 120), (90, 60), (150, 190), (150, 120))
    )
    group = Group((cut, text, plan))
    found = boxes(Group((Group((loads,)), group, Group((lever,)), part(180, 60)), "columns"))
    assert found is not None
    assert found[3][3] == pytest.approx(found[2][1] - GAP)


def test_columns_keep_clear_of_the_corner_and_begin_on_one_line_below_it() -> None:
    found = boxes(FORCES, taken=(LEFT,))
    assert found is not None
    check(found, taken=(LEFT,))
    assert max(box[3] for box in found) == pytest.approx(LEFT[1] - CLEAR)


def test_a_last_block_wider_than_the_sheet_does_not_fit_columns() -> None:
    assert boxes(Group((part(100, 100), part(575, 60)), "columns")) is None


@settings(deadline=None, max_examples=40)
@given(
    sizes=st.lists(
        st.tuples(st.floats(15, 220), st.floats(10, 150), st.booleans()), min_size=2, max_size=7
    ),
    cuts=st.sets(st.integers(1, 6), max_size=3),
    taken=st.sampled_from([(), (LEFT,), (RIGHT,), (LEFT, RIGHT)]),
)
def test_any_blocks_in_columns_are_apart(
    sizes: list[tuple[float, float, bool]], cuts: set[int], taken: tuple[Bounds, ...]
) -> None:
    *parts, last = [part(width, height, text=text) for width, height, text in sizes]
    edges = [0, *sorted(cut for cut in cuts if cut < len(parts)), len(parts)]
    groups = [Group(tuple(parts[i:j])) for i, j in pairwise(edges)]
    found = boxes(Group((*groups, last), "columns"), taken=taken)
    if found is not None:
        check(found, taken=taken)


# White --------------------------------------------------------------------------------------------


def test_the_largest_empty_rectangle() -> None:
    paper: Bounds = (0.0, 0.0, 100.0, 100.0)
    assert largest_empty_fraction([], paper) == pytest.approx(1.0)
    assert largest_empty_fraction([(0.0, 0.0, 100.0, 30.0)], paper) == pytest.approx(0.7)
    cross = [(40.0, 0.0, 60.0, 100.0), (0.0, 40.0, 100.0, 60.0)]
    assert largest_empty_fraction(cross, paper) == pytest.approx(0.16)


def test_a_block_takes_the_shape_that_fits() -> None:
    wide, high = Spacer(500.0, 160.0), Spacer(120.0, 250.0)
    others = [part(200.0, 300.0), part(180.0, 150.0)]
    placed = pack(Group((LayoutItem(Alternatives((wide, high))), *others)), AREA)
    assert placed is not None
    assert placed[0][0] is high
    assert pack(Group((LayoutItem(wide), *others)), AREA) is None


def test_a_block_may_be_beside_the_last_one_above_a_title_block_as_wide_as_the_sheet() -> None:
    inner, stamp = (20.0, 5.0, 205.0, 292.0), (20.0, 5.0, 205.0, 60.0)  # A4
    placed = pack(Group((part(80.0, 200.0), part(80.0, 200.0))), DrawingArea(inner, stamp))
    assert placed is not None
    assert all(corner.imag - block.height > stamp[3] for block, corner in placed)


@pytest.mark.parametrize(("grows", "wide"), [(True, 200.0), (False, 100.0)])
def test_growing_blocks_take_the_largest_size_that_fits(grows: bool, wide: float) -> None:
    ways = [Spacer(width, 0.8 * width) for width in (100.0, 200.0, 600.0)]
    picture = LayoutItem(Alternatives(tuple(ways), grows))
    whole = Group((Group((picture, part(250.0, 60.0))), part(180.0, 100.0)))
    found = boxes(whole)
    assert found is not None
    check(found)
    assert found[0][2] - found[0][0] == pytest.approx(wide)


@pytest.mark.parametrize("high", [250.0, 330.0])
def test_a_single_block_is_in_the_middle_beside_a_graph_too(high: float) -> None:
    """On an upright A3 the graph is along the right edge: a high block is left of it."""
    inner, stamp = (20.0, 5.0, 292.0, 415.0), (107.0, 5.0, 292.0, 60.0)
    graph = (278.0, 345.0, 292.0, 415.0)
    placed = pack(Group((part(160.0, high),)), DrawingArea(inner, stamp, (graph,)))
    assert placed is not None
    ((_, at),) = placed
    room = inner[2] if high < 280.0 else graph[0]
    assert at.real + 80.0 == pytest.approx((inner[0] + room) / 2)


def test_blocks_over_a_title_block_as_wide_as_the_sheet_begin_at_the_left() -> None:
    """White is at the right also over the last block, which is not a table."""
    inner, stamp = (20.0, 5.0, 205.0, 292.0), (20.0, 5.0, 205.0, 60.0)
    placed = pack(Group((part(90.0, 120.0), part(110.0, 60.0))), DrawingArea(inner, stamp, ()))
    assert placed is not None
    assert {at.real for _, at in placed} == {25.0}
    wide = pack(Group((part(70.0, 170.0), part(90.0, 180.0))), DrawingArea(inner, stamp, ()))
    assert wide is not None  # side by side, for they are too high
    (_, one), (_, two) = wide
    assert (one.real, two.real + 90.0) == (25.0, 200.0)


def test_the_last_text_over_a_wide_title_block_is_not_far_below_its_view() -> None:
    inner, stamp = (20.0, 5.0, 205.0, 292.0), (20.0, 5.0, 205.0, 60.0)
    placed = pack(Group((part(90.0, 80.0), part(160.0, 50.0))), DrawingArea(inner, stamp, ()))
    assert placed is not None
    (_, view), (_, text) = placed
    above, below = view.imag - 80.0 - text.imag, text.imag - 50.0 - stamp[3]
    assert above == pytest.approx(below, abs=GAP)
    assert above > 2 * GAP


def test_the_last_text_in_its_own_column_begins_at_the_top() -> None:
    inner, stamp = (20.0, 5.0, 205.0, 292.0), (20.0, 5.0, 205.0, 60.0)
    placed = pack(Group((part(70.0, 190.0), part(90.0, 120.0))), DrawingArea(inner, stamp, ()))
    assert placed is not None
    (_, view), (_, text) = placed
    assert text.real > view.real + 70.0
    assert text.imag == pytest.approx(view.imag)
