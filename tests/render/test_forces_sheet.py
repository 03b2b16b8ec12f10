"""The sheet of the force analysis: every load and reaction, plans to scale, equations, table."""

from __future__ import annotations

import re
from cmath import phase
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from importlib.resources import files
from itertools import combinations, pairwise
from math import degrees

import pytest
from click.testing import CliRunner
from doors import (
    ARM,
    FORCE,
    PLAN_BOX,
    Acting,
    Bounds,
    ComparedNumber,
    Drawing,
    DrawingItem as Item,
    Equation,
    ExitCode,
    Fill,
    ForceArm,
    ForceReading,
    LeverReading,
    ModelProblem as Problem,
    PageLayout,
    ProblemError,
    Scale,
    Scales,
    Severity,
    SheetLayout,
    Solution,
    Spacer,
    Stroke,
    Term,
    Text,
    View,
    ViewBlock,
    arm_items,
    arrows_distance as distance,
    cli,
    composition,
    drawn_edges,
    equation_block,
    force_unknowns,
    format_column,
    get_language,
    grow_scales,
    inspect,
    kinematics_sheets,
    lever_beside_plans,
    on_action,
    paper_of,
    place_force_arrows,
    reaction_symbol,
    read_composition,
    shipped_text,
    significant,
    statement,
)
from lettered import lever_lines, load_lines, moment_lines
from msgspec.structs import replace
from worked import drawn_sheets, path_of, problem_of

from planmethod import loads

RU = get_language("ru")

LOADED = ("levers/six-link", "levers/task12", "press/press")

EXTRA = """
[dynamics]
[dynamics.links.2]
mass = 5
centre = "{centre}"
inertia = 0.1
[[loads]]
name = "F_{{c}}"
link = "{link}"
at = "{at}"
force = 500
angle = 200
[[loads]]
name = "M_{{c}}"
link = "2"
couple = 20
"""


def loaded_template(name: str, centre: str, link: str, at: str, **changes: str) -> Problem:
    """Return a template of the program with loads."""
    text = (files("planmethod.problem") / "templates" / f"{name}.toml").read_text("utf-8")
    for old, new in changes.items():
        text = re.sub(rf"(?m)^{old} = .*$", f"{old} = {new}", text)
    return loads(
        text.split("[stamp]")[0] + EXTRA.format(centre=centre, link=link, at=at), name=name
    )


@cache
def sheet_of(name: str) -> Drawing:
    (sheet,) = drawn_sheets(name, layout="forces")
    return sheet


@cache
def reading_of(name: str) -> ForceReading:
    """Return the forces at the scales of the sheet."""
    reading = ForceReading(as_on(sheet_of(name), problem_of(name)), 0)
    per_mm = {view.scale: view.per_mm for view in sheet_of(name).views}
    assert reading.plan_scale(len(reading.plans) - 1).per_mm == per_mm["μ_{F}"]
    return reading


def as_on(sheet: Drawing, problem: Problem) -> Solution:
    """Return the solution at the scales that a sheet chose for its room."""
    solution = Solution(problem, views=composition("forces").views_for(paper_of(sheet), 1))
    per_mm = {view.kind: view.per_mm for view in sheet.views}
    scales = {
        kind: replace(mu, per_mm=per_mm.get(kind.value, mu.per_mm))
        for kind, mu in solution.scales.items()
    }
    return solution.drawn_at(scales)


def compared_balances(reading: ForceReading) -> ComparedNumber:
    """Return the result of the lever beside that of the force plans."""
    series = lever_beside_plans(reading.statics)
    assert series is not None
    return series[reading.index]


def within(items: Sequence[Item], box: Bounds) -> Iterator[Item]:
    for item in items:
        if isinstance(item, (Stroke, Fill)):
            ends = item.points
            if all(_inside(p, box) for p in ends):
                yield item


def _inside(place: complex, box: Bounds) -> bool:
    slack = 1e-6
    across = box[0] - slack <= place.real <= box[2] + slack
    return across and box[1] - slack <= place.imag <= box[3] + slack


def arrows(sheet: Drawing, view: View) -> list[tuple[str, complex]]:
    """Return the arrows of forces on a view: letters and vectors, mm."""
    found = []
    tags = ("force ", "plan-force ")
    items = [item for item in within(sheet.items, view.box) if item.tag.startswith(tags)]
    for shaft, head in zip(items[::2], items[1::2], strict=True):
        assert isinstance(shaft, Stroke) and isinstance(head, Fill) and shaft.tag == head.tag
        found.append((shaft.tag.partition("force ")[2], head.points[0] - shaft.points[0]))
    return found


def couples(sheet: Drawing, view: View) -> list[str]:
    heads = [i.tag for i in within(sheet.items, view.box) if isinstance(i, Fill)]
    return [tag.removeprefix("couple ") for tag in heads if tag.startswith("couple ")]


def views(sheet: Drawing, kind: str) -> list[View]:
    return [view for view in sheet.views if view.kind == kind]


def shown(sheet: Drawing) -> str:
    texts = " ".join(item.text for item in sheet.items if isinstance(item, Text))
    return re.sub(r"\s+", " ", texts)


def turned(one: complex, other: complex) -> float:
    """Return the angle between two vectors, degrees."""
    return abs(degrees(phase(one / other)))


# The whole sheet ----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LOADED)
def test_the_sheet_has_all_views_and_no_faults(name: str) -> None:
    sheet = sheet_of(name)
    # The loads, both groups and the driver; their force plans; the lever.
    assert [view.kind for view in sheet.views].count("position") == 4
    assert len(views(sheet, "forces")) == 3
    assert len(views(sheet, "velocity")) == 2  # the plan and the lever
    assert len(views(sheet, "acceleration")) == 1
    assert [f for f in inspect(sheet) if f.severity is Severity.ERROR] == []
    text = shown(sheet)
    for part in (
        "Силовой расчёт механизма",
        "Дано:",
        "Определить:",
        "Схема нагружения механизма",
        "Стрелки сил на схемах не в масштабе",
        "Группа звеньев 4–5",
        "Группа звеньев 2–3",
        "Начальное звено 1",
        "План сил группы звеньев 2–3",
        "План сил звена 1",
        "Рычаг Жуковского",
        "Реакции в кинематических парах",
        "Расхождение",
    ):
        assert part in text


@pytest.mark.parametrize("name", LOADED)
def test_each_plan_fills_its_view_and_the_scale_is_of_the_series(name: str) -> None:
    problem = problem_of(name)
    free = replace(problem, scales=replace(problem.scales, mu_F=None))
    reading = ForceReading(Solution(free), 0)
    inverse = name != "press/press"
    for number in range(len(reading.plans)):
        own = reading.plan_scale(number).per_mm
        value = 1.0 / own if inverse else own
        assert f"{value:.6e}".partition("e")[0] in ("1.000000", "2.000000", "2.500000", "4.000000",
                                                    "5.000000")  # fmt: skip
        edges = drawn_edges(reading, number)
        ends = [reading.corner(number, end) for edge in edges for end in (edge.tail, edge.head)]
        across, up = [p.real for p in ends], [p.imag for p in ends]
        width, height = max(across) - min(across), max(up) - min(up)
        assert width < PLAN_BOX[0] + 1.0 and height < PLAN_BOX[1] + 1.0
        assert max(width / PLAN_BOX[0], height / PLAN_BOX[1]) > 0.45


# Arrows -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LOADED)
def test_the_scheme_has_every_load_in_its_direction(name: str) -> None:
    sheet, reading = sheet_of(name), reading_of(name)
    view = views(sheet, "position")[0]
    drawn = dict(arrows(sheet, view))
    given = [one.applied for one in reading.statics.board.given]
    forces = {one.name: complex(one.force[0]) for one in given if one.point and one.force[0]}
    assert set(drawn) == set(forces)
    for letter, vector in drawn.items():
        assert turned(vector, forces[letter]) < 0.01
        assert abs(vector) == pytest.approx(22.0)
    assert sorted(couples(sheet, view)) == sorted(
        one.name for one in given if one.point is None and one.couple[0]
    )


@pytest.mark.parametrize("name", LOADED)
def test_cut_links_have_loads_and_reactions_in_their_directions(name: str) -> None:
    sheet, reading = sheet_of(name), reading_of(name)
    for view, plan in zip(views(sheet, "position")[1:], reading.plans, strict=True):
        expected = {e.symbol: reading.drawn_direction(e) for e in reading.shown(plan)}
        drawn = dict(arrows(sheet, view))
        assert set(drawn) == set(expected)
        assert all(turned(vector, expected[letter]) < 0.01 for letter, vector in drawn.items())
        symbols = [RU.notation.symbol(couple.symbol) for couple in reading.couples(plan)]
        assert sorted(couples(sheet, view)) == sorted(symbols)


@pytest.mark.parametrize("name", LOADED)
def test_segments_of_the_plans_are_the_forces_to_scale(name: str) -> None:
    sheet, reading = sheet_of(name), reading_of(name)
    fine = ForceReading(Solution(problem_of(name), ruler=1e-7), 0)
    found = reading.statics.reactions
    called = reading.solution.problem.mechanism.called
    pairs = [(called(r.on), called(r.by)) for r in found]
    reactions = {
        reaction_symbol(*p): complex(r.force[0]) for p, r in zip(pairs, found, strict=True)
    }
    reactions |= {
        reaction_symbol(*p[::-1]): -complex(r.force[0]) for p, r in zip(pairs, found, strict=True)
    }
    loads_of = {g.applied.name: complex(g.applied.force[0]) for g in reading.statics.board.given}
    seen = set()
    for number, view in enumerate(views(sheet, "forces")):
        edges = {edge.symbol: edge for edge in drawn_edges(reading, number)}
        for letter, vector in arrows(sheet, view):
            edge = edges[letter]
            assert vector == pytest.approx(reading.drawn(number, edge), rel=1e-6)
            # Readings of the ruler enter the calculation; a fine ruler gives the force itself.
            assert abs(abs(vector) - reading.length(edge, number)) < 0.26
            exact = {**loads_of, **reactions}.get(letter, fine.force(edge))
            drawn = fine.drawn(number, edge) * fine.plan_scale(number).per_mm
            assert drawn == pytest.approx(exact, rel=1e-6)
            seen |= {letter} & ({*reactions} | {*loads_of})
        for span in view.spans:
            assert span.length > 0
    # A vector without its own letter is there by its components, or is the same line.
    for one, pair in zip(found, pairs, strict=True):
        symbols = {reaction_symbol(*pair), reaction_symbol(*pair[::-1])}
        lines = {
            edge.symbol
            for number in range(len(reading.plans))
            for edge in drawn_edges(reading, number)
        }
        parts = {f"F{share}_{symbol[2:]}" for symbol in symbols for share in ("^{n}", "^{τ}")}
        inner = {edge.symbol for plan in reading.plans for edge in plan.inner}
        assert abs(one.force[0]) < 1.0 or symbols & seen or parts & lines or symbols & inner


def test_vectors_on_one_line_are_drawn_apart_and_the_sheet_mentions_it() -> None:
    sheet = sheet_of("levers/task12")
    assert RU.sheets.apart in shown(sheet)
    view = views(sheet, "forces")[0]  # all of its forces are vertical
    shafts = [item for item in within(sheet.items, view.box) if item.tag.startswith("plan-force ")]
    lines = sorted({round(s.points[0].real, 2) for s in shafts if isinstance(s, Stroke)})
    assert len(lines) == 4
    assert min(b - a for a, b in pairwise(lines)) > 1.5


def test_arrows_at_one_point_do_not_overlap_and_each_begins_or_ends_there() -> None:
    down = [Acting(name, 0j, -1j) for name in "abe"]
    placed = place_force_arrows([*down, Acting("c", 0j, 1j), Acting("d", 0j, 1 + 0j)], [(0j, 50j)])
    for (_, one), (_, other) in combinations(placed, 2):
        middle = (one[0] + one[1]) / 2
        assert distance(middle, other) > 3.5
    for force, arrow in placed:
        assert turned(arrow[1] - arrow[0], force.direction) < 1e-6
        assert min(map(abs, arrow)) < 6.5
        tail, head = on_action(force, arrow)
        assert abs((tail.conjugate() * force.direction).imag) < 1e-9
        assert head - tail == pytest.approx(arrow[1] - arrow[0])


# Equations ----------------------------------------------------------------------------------------


def test_underlines_mark_known_terms() -> None:
    terms = (Term("F_{21}", 2), Term("F^{n}_{30}", 1, "∥ DC"), Term("F_{23}"))
    balance = Equation(terms, name="Σ_{2}\\bar{F}")
    items = equation_block(balance).place(0j)
    lines = [i for i in items if isinstance(i, Stroke) and not i.tag.startswith("part-of:")]
    assert len(lines) == 3
    texts = [i.text for i in items if isinstance(i, Text)]
    assert texts.count("=") == 2
    assert texts.count("+") == 2
    assert "0" in texts
    narrow = equation_block(balance, width=40.0)
    assert narrow.width <= 40.0
    assert narrow.height > equation_block(balance).height


def test_the_moments_of_the_textbook() -> None:
    reading = reading_of("levers/six-link")
    lines = moment_lines(reading, reading.plans[1])
    assert lines[0] == (
        "Σ_{2}M_{C} = Φ_{2}·h_{Φ2} + F_{24}·h_{F24} − G_{2}·h_{G2} − M_{Φ2} − F^{τ}_{21}·l_{BC} = 0"
    )
    assert lines[2].endswith("/0,3 = 3480 Н")
    assert (
        moment_lines(reading, reading.plans[2])[0]
        == "Σ_{1}M_{A} = F_{12}·h_{F12} − M_{Φ1} − M_{1д} = 0"
    )


def test_stated_data_and_the_computed_loads() -> None:
    reading = reading_of("levers/six-link")
    facts = [fact.text for fact in statement(reading, RU)]
    load = "F_{5C} = 6000 Н (в точке H звена 5, вниз)"
    for fact in ("m_{2} = 40 кг", "J_{S1} = 5 кг·м^{2}", "g = 9,81 м/с^{2}", load):
        assert fact in facts
    assert "G_{2} = m_{2}·g = 40·9,81 = 392,4 Н" in load_lines(reading)
    assert "M_{Φ1} = J_{S1}·ε_{1} = 5·80 = 400 Н·м" in load_lines(reading)
    assert force_unknowns(reading, RU.notation) == (
        "F_{42}, F_{56}, F_{45}, F_{21}, F_{36}, F_{23}, F_{16}, φ_{ij}, l_{42}, l_{56}, M_{1д}"
    )


# Table --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LOADED)
def test_the_table_has_every_reaction(name: str) -> None:
    sheet, reading = sheet_of(name), reading_of(name)
    written = shown(sheet)
    found = reading.statics.reactions
    sizes = format_column([abs(complex(one.force[0])) for one in found])
    for one, size in zip(found, sizes, strict=True):
        force = complex(one.force[0])
        on, by = map(reading.solution.problem.mechanism.called, (one.on, one.by))
        assert f"({on}–{by})" in written
        if abs(force) > 1.0:
            assert RU.notation.number(size) in written
            assert RU.notation.number(f"{degrees(phase(force)) % 360.0:.1f}") in written
    assert RU.notation.number(significant(abs(float(reading.statics.balance[0])))) in written
    both = compared_balances(reading)
    for value in (both.exact, both.read):
        assert RU.notation.number(significant(abs(value))) in written


# Lever --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LOADED)
def test_the_lever_is_in_balance(name: str) -> None:
    reading = ForceReading(Solution(problem_of(name), ruler=1e-7), 0)
    lever = LeverReading(reading)
    moments = [abs(one.force) * one.arm for one in lever.forces]
    moments += [one.lever_moment for one in lever.couples]
    assert sum(moments) == pytest.approx(0.0, abs=1e-6 * max(map(abs, moments)))
    both = compared_balances(reading)
    assert both.percent == pytest.approx(0.0, abs=1e-4)
    for one in lever.couples:
        if one.segment is not None:
            start, end = one.segment
            link = reading.place(one.joints[1]) - reading.place(one.joints[0])  # type: ignore
            assert abs((link.conjugate() * (end - start)).imag) < 1e-6 * abs(link) * abs(
                end - start
            )


@pytest.mark.parametrize("name", LOADED)
def test_each_arm_is_a_perpendicular_of_the_length_that_is_read(name: str) -> None:
    """On cut links and on the lever, each arm of the equations, none of other lengths."""
    reading, lever = reading_of(name), LeverReading(reading_of(name))
    read = [abs(force.arm) for force in lever.forces]
    for plan in reading.plans:
        for equation in plan.moments:
            read += [abs(reading.arm(edge, equation.about)) for edge in equation.edges]
    lines = [
        i for i in sheet_of(name).items if isinstance(i, Stroke) and i.tag.startswith(f"{ARM} ")
    ]
    lengths = [abs(line.points[1] - line.points[0]) for line in lines]
    for arm in filter(lambda one: one > 4.0, read):
        assert min(abs(length - arm) for length in lengths) < 0.3
    for length in lengths:
        assert min(abs(length - arm) for arm in read) < 0.3
    corners = [
        i.points for i in sheet_of(name).items if isinstance(i, Stroke) and "right angle" in i.tag
    ]
    assert len(corners) >= len(lines)
    assert all(abs(((a - b) / (c - b)).real) < 1e-9 for a, b, c in corners)


@pytest.mark.parametrize("name", LOADED)
def test_the_lever_has_the_forces_that_do_work(name: str) -> None:
    sheet, reading = sheet_of(name), reading_of(name)
    *_, view = views(sheet, "velocity")
    lever = LeverReading(reading)
    assert sorted(letter for letter, _ in arrows(sheet, view)) == sorted(
        one.symbol for one in lever.forces
    )
    symbols = [RU.notation.symbol(one.symbol) for one in lever.couples]
    assert sorted(couples(sheet, view)) == sorted(symbols)
    assert lever.couples[-1].symbol == reading.solution.problem.balancer.symbol
    both = compared_balances(reading)
    assert 0.0 < both.percent_size < 5.0


def test_a_driving_slider_is_balanced_by_a_force() -> None:
    problem = loaded_template("driving-slider", "B", "3", "O")
    reading = ForceReading(Solution(problem), 0)
    assert [edge.symbol for edge in reading.plans[-1].polygon][-2:] == [FORCE.symbol, "F_{10}"]
    both = compared_balances(reading)
    assert both.exact * both.read > 0
    apart, expected = lever_lines(reading)[-2:]
    assert apart.startswith("Расхождение")
    assert expected.startswith("Ожидаемая погрешность построения σ = ")
    assert " Н: " in expected
    (sheet,) = kinematics_sheets(problem, layout="forces")
    assert [f for f in inspect(sheet) if f.severity is Severity.ERROR] == []
    *_, view = views(sheet, "velocity")
    assert "F_{ур}" in [letter for letter, _ in arrows(sheet, view)]
    assert "F_ур" in [span.name for plan in views(sheet, "forces") for span in plan.spans]


def test_a_driver_at_rest_has_no_lever() -> None:
    problem = loaded_template("four-bar", "B", "3", "C", omega="0")
    (sheet,) = kinematics_sheets(problem, layout="forces")
    assert views(sheet, "velocity") == []
    assert RU.sheets.lever_stands.split(":")[0] in shown(sheet)


@pytest.mark.parametrize(
    ("name", "centre", "link", "at"),
    [("sine", "A", "3", "B"), ("swinging-block", "D", "3", "C"), ("slider-crank", "S2", "3", "B")],
)
def test_other_dyads_are_drawn(name: str, centre: str, link: str, at: str) -> None:
    problem = loaded_template(name, centre, link, at)
    (sheet,) = kinematics_sheets(problem, layout="forces")
    assert [f for f in inspect(sheet) if f.severity is Severity.ERROR] == []


# Positions, errors, command line ------------------------------------------------------------------


def test_every_position_has_a_sheet_of_its_own() -> None:
    positions = [0.0, 120.0]
    sheets = drawn_sheets("press/press", positions, layout="forces")
    assert len(sheets) == 2
    for phi, sheet in zip(positions, sheets, strict=True):
        assert f"= {phi:.0f}°" in shown(sheet)
        spans = [span for view in views(sheet, "forces") for span in view.spans]
        assert {span.position for span in spans} == {positions.index(phi)}


def test_missing_masses_and_loads_are_reported() -> None:
    with pytest.raises(ProblemError, match=r"dynamics: missing.*\[dynamics\]"):
        drawn_sheets("linkages/ex1", layout="forces")
    result = CliRunner().invoke(cli, ["sheet", str(path_of("linkages/ex1")), "--layout", "forces"])
    assert result.exit_code == ExitCode.PROBLEM
    assert "Traceback" not in result.output
    assert "Give the masses in [dynamics]" in result.output


@pytest.mark.dear
@pytest.mark.parametrize("name", LOADED)
def test_norm_control_of_the_command_is_clean(name: str) -> None:
    result = CliRunner().invoke(cli, ["lint", str(path_of(name)), "--layout", "forces"])
    assert result.exit_code == ExitCode.DONE, result.output


def test_arms_that_a_reader_cannot_distinguish_are_left_to_the_equations() -> None:
    say = get_language("en").notation
    arms = [ForceArm(f"Q{k}", 0j, 10.0 + k + 5j, 10.0) for k in range(25)]
    items, labels = arm_items(arms[1:], [], 3.5, "lever", say)
    assert len(items) == len(labels) == 24
    assert arm_items(arms, [], 3.5, "lever", say) == ([], [])


@pytest.mark.dear
@pytest.mark.parametrize("number", [1, 37, 49])
def test_plans_are_drawn_smaller_before_they_are_left_out(number: int) -> None:
    """At their own size the plans do not fit A1 beside the forces; for two tasks the scheme is
    reduced, too."""
    (sheet,) = kinematics_sheets(problem_of(f"levers/task-{number}"), layout="forces")
    kinds = [view.kind for view in sheet.views]
    assert sheet.width == 841
    assert {"velocity", "acceleration"} <= {*kinds}


@pytest.mark.dear
@pytest.mark.parametrize("number", [14, 22, 49])
def test_the_view_of_a_group_and_its_force_plan_stand_together(number: int) -> None:
    """Views become smaller before groups are dissolved, and no column ends before a force plan."""
    (sheet,) = kinematics_sheets(problem_of(f"levers/task-{number}"), layout="forces")
    _, *cuts = views(sheet, "position")
    plans = views(sheet, "forces")
    for cut, plan in zip(cuts[-len(plans) :], plans, strict=True):
        one, two = cut.box, plan.box
        left, low = min(one[0], two[0]), min(one[1], two[1])
        right, top = max(one[2], two[2]), max(one[3], two[3])
        others = [view.box for view in sheet.views if view not in (cut, plan)]
        assert not [
            box
            for box in others
            if left < box[2] and box[0] < right and low < box[3] and box[1] < top
        ]


@pytest.mark.dear
def test_views_grow_into_the_white_of_the_sheet() -> None:
    """On A2 a group would be dissolved, and A1 has room for larger plans than the intended."""
    problem = problem_of("levers/task-22")
    usual = read_composition(shipped_text("forces").replace("grow = true", ""), name="mine.toml")
    (sheet,), (before,) = (kinematics_sheets(problem, layout=own) for own in ("forces", usual))
    assert sheet.width == before.width == 841
    for kind in ("velocity", "acceleration"):
        assert views(sheet, kind)[0].per_mm < views(before, kind)[0].per_mm


@pytest.mark.parametrize(("area", "drawn"), [(1e5, ["mu_v", "mu_l"]), (1.5e4, ["mu_l"])])
def test_no_sheet_is_drawn_whose_views_would_exceed_the_paper(
    area: float, drawn: list[str]
) -> None:
    scale = Scale("mu_v", 0.02, "m/s")
    page = PageLayout([(ViewBlock(Spacer(100.0, 100.0), "velocity", scale), 0j)])
    found: list[str] = []

    def draw(wish: Mapping[str, float]) -> None:
        found.extend(key for key in wish if wish[key] < 0.02)

    layout = SheetLayout([page], {"mu_v": 0.02, "mu_l": 0.02})
    assert grow_scales(layout, ["mu_v", "mu_l"], Scales(), draw, area) == layout
    assert found == drawn
