"""Many superimposed positions: every joint lettered, without collisions."""

from __future__ import annotations

from functools import cache
from itertools import combinations, permutations, product

import numpy as np
import pytest
from doors import (
    DIMENSION,
    FRAME,
    MAX_LABELS,
    POSITIONS_PRIMES as PRIMES,
    TRAJECTORY,
    UNDER_LABEL,
    Alternatives,
    Arc,
    BlockOptions,
    BlockSpec,
    BlockStyle,
    Disc,
    DrawingItem as Item,
    Fill,
    Paths,
    Pen,
    Picture,
    PlanKind,
    PointName,
    Positions,
    Sizes,
    Solution,
    Stroke,
    Text,
    Thinned,
    Views,
    clearest_position,
    crank_cycle_of,
    densest,
    get_language,
    is_clear,
    kinematics_sheets,
    lint,
    maker_of,
    positions_written as written,
    problem_loads as loads,
    series_picture,
    writings_of,
)
from worked import DEAD, SIX, drawn_sheets, problem_of

from benchmarks.generator import random_problem
from benchmarks.sheets import positions_of as drawn_driver_positions

ALL_ROUND = [30.0 * k for k in range(12)]
SOME = [150.0 + 10.0 * k for k in range(12)]  # the six-link mechanism does not go all round
TWELVE = tuple(range(12))


@cache
def solved(name: str) -> Solution:
    positions = SOME if name == "levers/six-link" else ALL_ROUND
    return Solution(problem_of(name), positions=positions, views=Views.for_paper("A1", 12))


@cache
def drawn(name: str) -> Picture:
    solution = solved(name)
    return series_picture(solution, clearest_position(solution, TWELVE), TWELVE)


def positions_of(name: str) -> Positions:
    solution = solved(name)
    return Positions(solution, clearest_position(solution, TWELVE), TWELVE, 5.0)


def strokes(items: tuple[Item, ...], tag: str) -> list[Item]:
    return [i for i in items if isinstance(i, (Stroke, Arc)) and i.tag.startswith(tag)]


# Labels -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", SIX)
def test_no_label_of_twelve_positions_is_in_the_way(name: str) -> None:
    items = drawn(name).items
    assert lint(items) == []
    assert not [
        i for i in items if isinstance(i, Fill) and i.tag == UNDER_LABEL
    ]  # no line is broken


@pytest.mark.parametrize("name", SIX)
def test_every_point_has_its_letter_in_every_position(name: str) -> None:
    """Every point has a label in every position; points in one place share a label.

    If there are too many for their area, only every third and the bold one are left, and for a
    centre of mass only the bold one.
    """
    positions = positions_of(name)
    third = {str(positions.main), *map(str, TWELVE[::3])}
    labels = [w.name for w in writings_of(drawn(name).items)]
    for point in positions.points:
        own = [
            label.removeprefix(f"point {point} ") for label in labels if f"point {point} " in label
        ]
        numbers = [number for label in own for number in label.split(",")]
        left = {number for number in numbers if number not in PRIMES}
        if point in positions.solution.problem.centres and left != {*map(str, TWELVE)}:
            assert left == {str(positions.main)}
            continue
        if left == third:
            continue
        assert sorted(n for n in numbers if n not in PRIMES) == sorted(map(str, TWELVE))
        places = np.asarray([positions.at(point, k) for k in TWELVE])
        apart = np.abs(places[:, None] - places[None, :])
        together = len(TWELVE) - len(own) + sum(label in PRIMES for label in own)
        assert together <= np.sum(apart[np.triu_indices(12, 1)] < 0.5)


@pytest.mark.parametrize("name", SIX)
def test_letters_are_of_the_standard_heights(name: str) -> None:
    texts = [item for item in drawn(name).items if isinstance(item, Text)]
    assert {text.height for text in texts} <= {5.0, 3.5, 2.5, 1.8}
    for writing in writings_of(drawn(name).items):
        assert max(run.height for run in writing.runs) >= 2.5


@pytest.mark.parametrize("name", SIX)
def test_fixed_points_and_links_are_named_once(name: str) -> None:
    problem = problem_of(name)
    shown = [w.shown for w in writings_of(drawn(name).items)]
    for link in problem.mechanism.links:
        alone = [w for w in writings_of(drawn(name).items) if w.shown == link and "@" in w.name]
        assert len(alone) == 1
    for point in problem.bodies["0"].points:
        assert shown.count(point) == 1
    assert len([text for text in shown if text[0] == "ω"]) == 1


@pytest.mark.parametrize("name", SIX)
def test_leader_lines_do_not_cross_their_neighbours(name: str) -> None:
    from shapely import LineString

    leaders = [
        LineString([(z.real, z.imag) for z in item.points])
        for item in drawn(name).items
        if isinstance(item, Stroke)
        and item.pen is Pen.THIN
        and not item.tag
        and len(item.points) == 2
    ]
    crossed = sum(one.crosses(two) for one, two in combinations(leaders, 2))
    # Thirteen places of two points lie within 25 mm in the six-link mechanism.
    assert crossed <= (0.2 if name == "levers/six-link" else 0.07) * len(leaders)


def test_letters_are_thinned_step_by_step() -> None:
    """Centres of mass go first, then all but every third; bold and extreme positions stay."""
    positions = positions_of("levers/task12")
    count = [len(positions.labels(2.5, thinned=thinned)) for thinned in Thinned]
    assert count == sorted(count, reverse=True) and count[0] > count[-1]
    for thinned in Thinned:
        named = [label.name for label in positions.labels(2.5, thinned=thinned)]
        for point in positions.points:
            own = [name for name in named if name.startswith(f"point {point} ")]
            assert any(str(positions.main) in name.split(" ")[2].split(",") for name in own)
        assert any("′" in name for name in named)
        if thinned >= Thinned.CENTRES:
            centres = [n for n in named if n.split(" ")[1] in positions.solution.problem.centres]
            assert len(centres) == len({n.split(" ")[1] for n in centres})


@pytest.mark.parametrize("name", SIX)
def test_no_part_of_a_scheme_is_overfull(name: str) -> None:
    writings = [w for w in writings_of(drawn(name).items) if w.name.startswith("point ")]
    count, _ = densest([complex(w.ink.centroid.x, w.ink.centroid.y) for w in writings])
    assert count <= MAX_LABELS + 4


def test_a_point_that_stays_has_its_letter_once() -> None:
    assert written("P", []) == "P"


def test_the_densest_square_is_found() -> None:
    row = [complex(10 * k, 0) for k in range(20)]
    assert densest(row)[0] == 5 and densest([]) == (0, 0j)
    assert densest([*row, 100 + 1j, 101 + 1j])[0] == 7


def test_the_same_again() -> None:
    again = [Solution(problem_of("linkages/ex1"), positions=ALL_ROUND) for _ in range(2)]
    one, two = (series_picture(solution, 2, TWELVE).items for solution in again)
    assert one == two


def test_of_many_positions_every_other_one_has_a_letter() -> None:
    positions = [15.0 * k for k in range(24)]
    solution = Solution(problem_of("linkages/ex1"), positions=positions)
    items = series_picture(solution, 4, tuple(range(24))).items
    shown = {part for w in writings_of(items) for part in w.shown.split(", ")}
    assert {"B0", "B2", "B22"} <= shown
    assert not {"B1", "B23"} & shown
    assert lint(items) == []


@pytest.mark.parametrize(
    ("point", "numbers", "bold", "text"),
    [
        ("B", ["3"], False, "B_{3}"),
        ("B", ["3", "9"], True, "B_{3}, B_{9}"),
        ("B", ["0", "′"], False, "B_{0}, B′"),
        ("S3", ["4"], False, "4"),
        ("S3", ["4", "8"], False, "4, 8"),
        ("S3", ["4"], True, "S_{3}"),
        ("S3", ["4", "8"], True, "S_{3} (4, 8)"),
    ],
)
def test_the_label_of_a_point_has_its_position_numbers(
    point: str, numbers: list[str], bold: bool, text: str
) -> None:
    assert written(point, numbers, is_main=bold) == text


# Trajectories and extreme positions ---------------------------------------------------------------


def test_a_crank_pin_moves_on_a_circle_and_a_rocker_on_an_arc() -> None:
    items = drawn("linkages/ex2").items
    (circle,) = strokes(items, f"{TRAJECTORY} A")
    (arc,) = strokes(items, f"{TRAJECTORY} B")
    assert isinstance(circle, Arc)
    assert isinstance(arc, Arc)
    assert circle.end - circle.start == pytest.approx(2 * np.pi)
    assert arc.end - arc.start < 1.0
    assert circle.pen is arc.pen is Pen.THIN
    positions = positions_of("linkages/ex2")
    for k in TWELVE:
        assert abs(positions.at("B", k) - arc.centre) == pytest.approx(arc.radius)


def test_a_point_of_the_coupler_moves_on_a_smooth_curve_through_its_places() -> None:
    (curve,) = strokes(drawn("linkages/ex1").items, f"{TRAJECTORY} D")
    assert isinstance(curve, Stroke)
    places = np.asarray(curve.points)
    positions = positions_of("linkages/ex1")
    for k in TWELVE:
        assert np.abs(places - positions.at("D", k)).min() < 1e-9
    turns = np.angle(np.diff(places)[1:] / np.diff(places)[:-1])
    assert np.abs(turns).max() < np.radians(12)
    assert places[0] == pytest.approx(places[-1])


def test_a_point_in_straight_motion_has_no_line_of_its_own() -> None:
    assert strokes(drawn("linkages/ex1").items, f"{TRAJECTORY} C") == []


@pytest.mark.parametrize("seed", [96_001, 97_003, 97_004, 104_030])
def test_a_broken_line_of_a_point_ends_at_its_places_and_has_no_corners(seed: int) -> None:
    problem = loads(random_problem(seed)[0], name="random")
    solution = Solution(problem, positions=drawn_driver_positions(problem, 12))
    drawn = tuple(np.flatnonzero(solution.extents.on_scheme).tolist())
    positions = Positions(solution, drawn[0], drawn, 5.0)
    lines, strokes_seen = tuple(positions.lines()), 0
    for point in positions.points:
        places = np.array([positions.at(point, k) for k in positions.numbers])
        for line in strokes(lines, f"{TRAJECTORY} {point}"):
            if not isinstance(line, Stroke):
                continue
            way = np.array(line.points)
            strokes_seen += 1
            if abs(way[0] - way[-1]) > 0.1:  # not closed
                assert all(np.abs(places - end).min() < 0.1 for end in (way[0], way[-1]))
            chords = way[2:] - way[:-2]
            off = np.abs(((way[1:-1] - way[:-2]) * np.conj(chords)).imag / np.abs(chords)) / 4.0
            assert off.max(initial=0.0) < 0.08  # mm between the line and its curve
    assert strokes_seen


def test_extreme_positions_of_a_slider_crank() -> None:
    """Crank and coupler in one line: the slider furthest out at 0°, nearest at 180°."""
    low, high = Paths(solved("linkages/ex1")).extremes
    assert min(low, 360 - low) == pytest.approx(0.0, abs=0.01)
    assert high == pytest.approx(180.0, abs=0.01)


def test_extreme_positions_of_the_press_have_the_crank_across_the_rocker() -> None:
    positions = positions_of("press/press")
    for index in (12, 13):
        crank = positions.at("A", index) - positions.at("O1", index)
        rocker = positions.at("A", index) - positions.at("O3", index)
        assert abs((crank * rocker.conjugate()).real) < 0.01 * abs(crank) * abs(rocker)
    shown = {w.shown for w in writings_of(drawn("press/press").items)}
    assert {"A′", "A″"} <= shown


def test_extreme_positions_are_lines_with_two_dots() -> None:
    """GOST 2.303: dash-dot with two dots is for parts in extreme positions."""
    items = drawn("press/press").items
    shown = [i for i in items if isinstance(i, Stroke) and i.pen is Pen.PHANTOM]
    assert {i.tag for i in shown} == {"link 1", "link 3", "link 4"}
    assert len([i for i in items if isinstance(i, Stroke) and i.pen is Pen.PALE]) >= 11 * 3


def test_few_positions_have_no_extreme_ones_behind_them() -> None:
    few = Solution(problem_of("press/press"), positions=ALL_ROUND[1:4])
    items = series_picture(few, 0, (0, 1, 2)).items
    assert not [i for i in items if isinstance(i, Stroke) and i.pen is Pen.PHANTOM]


def test_the_stroke_is_dimensioned_between_the_extreme_positions() -> None:
    solution, items = solved("linkages/ex1"), drawn("linkages/ex1").items
    heads = [i.points[0] for i in items if isinstance(i, Fill) and i.tag == f"{DIMENSION} H"]
    stroke = crank_cycle_of(solution).stroke
    assert stroke is not None
    per_mm = solution.scales[PlanKind.POSITION].per_mm
    assert abs(heads[0] - heads[1]) * per_mm == pytest.approx(stroke, abs=1e-6)
    assert "H" in [w.shown for w in writings_of(items)]


def test_the_swing_is_dimensioned_from_one_extreme_position_to_the_other() -> None:
    solution, items = solved("levers/task-49"), drawn("levers/task-49").items
    (arc,) = (i for i in items if isinstance(i, Arc) and i.tag == f"{DIMENSION} ψ")
    swing = crank_cycle_of(solution).stroke
    assert swing is not None
    assert np.degrees(arc.end - arc.start) == pytest.approx(swing, abs=0.1)
    assert "ψ" in [w.shown for w in writings_of(items)]


def test_a_link_that_goes_on_has_no_extreme_position() -> None:
    solution = Solution(problem_of("linkages/ex1"), positions=[20.0, 30.0, 40.0, 50.0, 60.0])
    assert Paths(solution).extremes == ()


def test_an_output_that_reverses_where_another_group_does_not_assemble_has_no_extreme() -> None:
    text, _ = random_problem(99201)  # C turns back beyond every position of E
    problem = loads(text, name="random")
    solution = Solution(problem, positions=drawn_driver_positions(problem, 12))
    assert Paths(solution).extremes == ()
    assert len(series_picture(solution, 0, TWELVE).items) > 50


def test_positions_beyond_a_dead_one_leave_a_gap_in_the_line() -> None:
    problem = loads(DEAD, name="dead")
    drawn_at = [float(x) for x in problem.drive.positions]
    solution = Solution(problem, positions=[drawn_at[0], drawn_at[0] + 1.0])
    items = series_picture(solution, 0, (0, 1)).items
    assert all(np.isfinite(np.asarray(s.points)).all() for s in items if isinstance(s, Stroke))


# Joints and the sheet -----------------------------------------------------------------------------


@pytest.mark.parametrize("name", SIX)
def test_every_place_is_marked(name: str) -> None:
    positions = positions_of(name)
    # A joint on a link that goes through it is a half-circle.
    rounds = (i for i in drawn(name).items if isinstance(i, (Disc, Arc)) and i.radius < 2.0)
    discs = np.asarray([i.centre for i in rounds])
    for point in positions.points:
        if point in positions.solution.problem.centres:
            continue  # left out with their letters
        for k in TWELVE:
            assert np.abs(discs - positions.at(point, k)).min() < 0.5


@pytest.mark.parametrize("name", SIX)
def test_the_bold_position_is_not_in_one_line(name: str) -> None:
    solution = solved(name)
    bold = clearest_position(solution, TWELVE)
    for extreme in Paths(solution).extremes:
        assert abs((solution.positions[bold] - extreme + 180) % 360 - 180) > 5


def test_the_sheet_of_the_press_has_twelve_positions_on_one_scheme() -> None:
    (sheet,) = drawn_sheets("press/press", ALL_ROUND)
    assert (sheet.width, sheet.height) == (841.0, 594.0)
    shown = " ".join(w.shown for w in writings_of(sheet.items)).replace(",", " ").split()
    assert {"A′", "A″", "крайние", "H", "φр", "φх"} <= set(shown)  # given at the name of the view
    for letter in "AB":  # the driver's and the output's; N has every other one at most
        assert {f"{letter}{k}" for k in TWELVE} <= set(shown)
    of_n = {w.shown for w in writings_of(sheet.items) if w.name.startswith("point N ")}
    assert len(of_n) > 3
    assert all(shown.startswith("N") for shown in of_n)  # a number alone could be a link's
    assert lint(sheet.items) == []


@pytest.mark.parametrize("name", ["levers/task-49", "linkages/2.1.2"])
def test_the_scale_is_given_once_under_the_heading_of_the_plans(name: str) -> None:
    """And under a plan that is out of proportion its own."""
    positions = [30.0 * k for k in range(11)]
    solution = Solution(problem_of(name), positions=positions)
    (sheet,) = drawn_sheets(name, positions)
    for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION):
        (view,) = (v for v in sheet.views if v.kind == kind.value)
        left, low, right, high = view.box
        said = [
            item
            for item in sheet.items
            if isinstance(item, Text)
            and item.text == "μ"
            and left < item.at.real < right
            and low < item.at.imag < high
        ]
        own = [k for k in range(11) if solution.plan_scale(kind, k) != solution.scales[kind]]
        assert len(said) == 1 + len(own)
        assert bool(own) is (name == "levers/task-49")


def test_plans_of_one_position_on_a_sheet_are_named_as_one() -> None:
    """Three positions share two sheets, so that the last is alone."""
    sheets = kinematics_sheets(
        problem_of("linkages/ex3"), positions=[60.0, 120.0, 240.0], paper="A3"
    )
    texts = [{item.text for item in sheet.items if isinstance(item, Text)} for sheet in sheets]
    assert {"Планы положений механизма", "Планы скоростей", "Планы ускорений"} <= texts[0]
    assert {"План положения механизма", "План скоростей", "План ускорений"} <= texts[-1]


@pytest.mark.parametrize("name", ["linkages/2.1.19", "linkages/2.1.24"])
def test_no_link_covers_another_one_in_the_clearest_position(name: str) -> None:
    """Of two positions in which joints are apart it is the one with links apart."""
    solution, compared = solved(name), 0
    bodies = solution.problem.bodies

    def hidden(k: int) -> float:
        """Return the largest part of a link within 2 mm of another one."""
        lines = [
            (link, [complex(solution.paper.point(PointName(point))[k]) for point in pair])
            for link, body in bodies.items()
            if link != FRAME
            for pair in combinations(sorted(set(body.points) - solution.problem.centres), 2)
        ]
        parts = [0.0]
        for (one, (a, b)), (other, (c, d)) in permutations(lines, 2):
            if one != other:
                seen = [(a + (b - a) * t / 40 - c) / (d - c) * abs(d - c) for t in range(41)]
                on = [0 <= z.real <= abs(d - c) and abs(z.imag) < 2.0 for z in seen]
                parts.append(sum(on) / 41 * abs(b - a) / min(abs(b - a), abs(d - c)))
        return max(parts)

    covered = {k: hidden(k) for k in TWELVE}
    clear = is_clear(solution)
    for one, two in product(TWELVE, TWELVE):
        if clear[one] == clear[two] and covered[one] < 0.3 and covered[two] > 0.5:
            assert clearest_position(solution, (two, one)) == one
            compared += 1
    assert compared


def test_the_statement_of_many_positions_is_as_wide_as_its_column() -> None:
    """The list of positions is broken between them."""
    solution = Solution(
        problem_of("linkages/ex1"), positions=[30.0 * k + 7.1166 for k in range(12)]
    )
    entry, sizes = BlockSpec("statement", heights=(3.5,)), Sizes(5.0, 7.0, 5.0, 178.0)
    style = BlockStyle(entry, sizes, 816.0, BlockOptions(get_language("ru")))
    made = maker_of("statement")(solution, tuple(range(12)), style)
    assert isinstance(made, Alternatives)
    widths = sorted(way.width for way in made.blocks)
    assert widths[0] <= 125.0 < widths[1] <= 178.0
