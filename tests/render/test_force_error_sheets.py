"""The sheet of forces with drafting errors: ellipses at vertices, sigmas in the tables."""

from __future__ import annotations

import re
from decimal import Decimal
from functools import cache
from itertools import product

import numpy as np
import pytest
from cases import thinned
from doors import (
    DASH,
    DRAFTING_PROFILES as PROFILES,
    START,
    TAG,
    BlockOptions,
    BlockSpec,
    BlockStyle,
    Disc,
    Drawing,
    DrawnForces,
    Errors,
    ForceReading,
    Pen,
    Severity,
    Solution,
    Stroke,
    angle_label,
    balance_columns,
    composition,
    drafting_of,
    drawn_edges,
    drawn_forces,
    find_overlap_shifts,
    get_language,
    guided_at,
    inspect,
    is_couple,
    kinematics_sheets,
    moment_label,
    reaction_columns,
    reactions_block,
    size_label,
    solution_record as record,
    statics_of,
    vertex_ellipses,
    wording,
)
from loaded import loaded_problem
from test_ellipses import middle, spread
from test_error_sheets import number, rounded
from test_forces_sheet import as_on, loaded_template, shown, views
from texts import result_tables
from worked import drawn_sheets, path_of, problem_of

from planmethod import loads

RU = get_language("ru")

LOADED = ("levers/six-link", "levers/task12", "press/press", "press/press-stone")
NEAR_DEAD = (230.0, 240.0, 250.0)


@cache
def reading_of(
    name: str, profile: str = "board", positions: tuple[float, ...] | None = None, index: int = 0
) -> ForceReading:
    views_of = composition("forces").views_for("A1", 1)
    hand = PROFILES[profile]
    return ForceReading(
        Solution(problem_of(name), positions=positions, profile=hand, views=views_of), index
    )


def errors_in(sheets: list[Drawing]) -> list[str]:
    found = [f for sheet in sheets for f in inspect(sheet)]
    return [f.describe("en") for f in found if f.severity is Severity.ERROR]


def ellipses_in(sheet: Drawing) -> list[Stroke]:
    return [item for item in sheet.items if isinstance(item, Stroke) and item.tag == TAG]


# Whole sheets -------------------------------------------------------------------------------------


@pytest.mark.dear
@pytest.mark.parametrize(
    ("name", "profile"),
    [
        *((name, "board") for name in LOADED),
        *product(thinned(LOADED, 2), [other for other in PROFILES if other != "board"]),
    ],
)
def test_the_lint_finds_no_faults(name: str, profile: str) -> None:
    one = profile == "board" and name in thinned(LOADED, 2)
    alone = ((True, False), (False, True)) if one else ()
    for errors, sigma in ((True, True), *alone):
        sheets = kinematics_sheets(
            problem_of(name), layout="forces", errors=errors, sigma=sigma, profile=PROFILES[profile]
        )
        assert errors_in(sheets) == []
        (sheet,) = sheets
        text = shown(sheet)
        motion = 2 * len(views(sheet, "acceleration"))  # with the velocity plan, if it fits
        plans = len(views(sheet, "forces")) + motion
        assert text.count("Эллипсы погрешностей") == (plans if errors else 0)
        assert ("±σ" in text) == sigma  # the lever has its expected error without them
        assert ("(точные значения)" in text) != sigma
        assert bool(ellipses_in(sheet)) == (errors and profile != "cad") or profile == "cad"


@pytest.mark.parametrize("name", ["sine", "swinging-block", "slider-crank", "driving-slider"])
def test_other_dyads_and_a_driving_slider(name: str) -> None:
    centre, link, at = {
        "sine": ("A", "3", "B"),
        "swinging-block": ("D", "3", "C"),
        "slider-crank": ("S2", "3", "B"),
        "driving-slider": ("B", "3", "O"),
    }[name]
    sheets = kinematics_sheets(
        loaded_template(name, centre, link, at), layout="forces", errors=True, sigma=True
    )
    assert errors_in(sheets) == []
    assert ellipses_in(sheets[0])


def test_a_driver_at_rest_has_a_dash_for_the_lever() -> None:
    problem = loaded_template("four-bar", "B", "3", "C", omega="0")
    sheets = kinematics_sheets(problem, layout="forces", errors=True, sigma=True)
    assert errors_in(sheets) == []
    reading = ForceReading(Solution(problem), 0)
    columns = balance_columns(reading, RU, sigma=True)
    assert [cell.text for cell in columns[3].cells] == ["—", "—"]
    assert [cell.text for cell in columns[4].cells] == ["—", "—"]
    assert columns[2].cells[1].text != "—"
    entry = record(Solution(problem))["positions"][0]["forces"]
    assert "lever" not in entry and entry["driving"]["sigma"] > 0


def test_a_problem_without_any_force_has_no_errors_to_show() -> None:
    text = path_of("linkages/ex3").read_text("utf-8") + "\n[dynamics]\ngravity = false\n"
    sheets = kinematics_sheets(loads(text, name="free"), layout="forces", errors=True, sigma=True)
    assert errors_in(sheets) == []
    motion = [v.box for kind in ("velocity", "acceleration") for v in views(sheets[0], kind)]
    for ellipse in ellipses_in(sheets[0]):  # the plans of the position have theirs
        x, y = ellipse.points[0].real, ellipse.points[0].imag
        assert any(x0 <= x <= x1 and y0 <= y <= y1 for x0, y0, x1, y1 in motion)
    assert "*" not in shown(sheets[0])


def test_no_errors_of_reactions_are_computed_without_the_options(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """No ellipse or error of a reaction is computed; only the error of the discrepancy is shown."""
    plain = drawn_sheets("press/press", layout="forces")
    asked: list[str] = []
    found = Errors.spread_of

    def spy(self: Errors, label: str) -> object:
        asked.append(label)
        return found(self, label)

    monkeypatch.setattr(Errors, "spread_of", spy)
    monkeypatch.setattr(DrawnForces, "ellipse", lambda *_: pytest.fail("asked"))
    again = kinematics_sheets(problem_of("press/press"), layout="forces")
    assert set(asked) <= {"difference"}
    assert [sheet.items for sheet in again] == [sheet.items for sheet in plain]


# Ellipses -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LOADED)
def test_every_ellipse_is_that_of_a_vertex(name: str) -> None:
    reading = reading_of(name)
    for k in range(len(reading.plans)):
        edges, shifts = drawn_edges(reading, k), find_overlap_shifts(reading, k)
        drawn = vertex_ellipses(reading, k)
        assert drawn.enlarged == 1
        for stroke in drawn.strokes:
            near = [
                drawn_forces(reading.statics).ellipse(end, 0) * reading.enlargement(k) ** 2
                for edge, shift in zip(edges, shifts, strict=True)
                for end in (edge.tail, edge.head)
                if abs(reading.corner(k, end) + shift - middle(stroke)) < 1e-6
            ]
            assert any(np.allclose(spread(stroke), each, rtol=1e-6, atol=1e-9) for each in near)


@pytest.mark.parametrize("name", LOADED)
def test_every_vertex_but_the_first_has_its_ellipse(name: str) -> None:
    """On a board none is thinner than the pen; each vertex has one, however many segments end."""
    reading = reading_of(name)
    for k in range(len(reading.plans)):
        edges = drawn_edges(reading, k)
        drawn = vertex_ellipses(reading, k)
        ends = {end for edge in edges for end in (edge.tail, edge.head)}
        free = {end for end in ends if not drawn_forces(reading.statics).ellipse(end, 0).any()}
        assert {reading.end(end) for end in free} <= {
            reading.end(end) for end in reading.statics.board.starts
        }
        assert len(drawn.strokes) <= len(ends) - len(free)
        if not drawn.has_oversized:
            corners = [reading.corner(k, end) for end in ends - free]
            places = {complex(round(place.real, 3), round(place.imag, 3)) for place in corners}
            assert len(drawn.strokes) >= len(places)


@pytest.mark.dear
@pytest.mark.parametrize("name", LOADED)
def test_the_disc_is_where_the_construction_begins(name: str) -> None:
    """It is the vertex without an error, from which the first force is laid off."""
    (sheet,) = kinematics_sheets(problem_of(name), layout="forces", errors=True)
    reading = ForceReading(as_on(sheet, problem_of(name)), 0)
    discs = [item for item in sheet.items if isinstance(item, Disc) and item.tag == START]
    assert len(discs) == len(reading.plans)
    for k, (plan, view, disc) in enumerate(
        zip(reading.plans, views(sheet, "forces"), discs, strict=True)
    ):
        ends = {end for edge in plan.polygon for end in (edge.tail, edge.head)}
        (start,) = ends & {*reading.statics.board.starts}
        first = drawn_edges(reading, k)[0]
        shaft = next(
            item
            for item in sheet.items
            if isinstance(item, Stroke)
            and item.tag == f"plan-force {first.symbol}"
            and view.box[0] < middle(item).real < view.box[2]
            and view.box[1] < middle(item).imag < view.box[3]
        )
        off = disc.centre - shaft.points[0]
        assert off == pytest.approx(
            reading.corner(k, start) - reading.corner(k, first.tail), abs=1e-6
        )


def test_dashed_are_vertices_where_first_order_does_not_hold() -> None:
    pens = set()
    for index in range(len(NEAR_DEAD)):
        reading = reading_of("levers/six-link", "board", NEAR_DEAD, index)
        strained = drafting_of(reading.solution).spreads["x_H"].drawn[index]
        for k in range(len(reading.plans)):
            drawn = vertex_ellipses(reading, k)
            assert drawn.has_nonlinear == any(s.pen is Pen.HIDDEN for s in drawn.strokes)
            if not strained:
                assert not drawn.has_nonlinear
            pens |= {stroke.pen for stroke in drawn.strokes}
    assert Pen.HIDDEN in pens


def test_an_ellipse_larger_than_half_the_plan_is_mentioned() -> None:
    (sheet,) = kinematics_sheets(
        problem_of("levers/six-link"), layout="forces", errors=True, positions=NEAR_DEAD[:1]
    )
    reading = reading_of("levers/six-link", "board", NEAR_DEAD[:1])
    hidden = [vertex_ellipses(reading, k).has_oversized for k in range(len(reading.plans))]
    assert shown(sheet).count("эллипсы больше половины плана не показаны") == sum(hidden) > 0


# Tables -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LOADED)
def test_columns_of_the_reactions(name: str) -> None:
    reading = reading_of(name)
    drawn, found = drawn_forces(reading.statics), reading.statics.reactions
    columns = {column.head: column for column in reaction_columns(reading, RU, sigma=True)}
    read, moment = columns[f"{RU.sheets.read}, Н"], columns.get("±σ, Н·м")
    assert (moment is not None) == any(is_couple(guided_at(reading, k)) for k in range(len(found)))
    for k, joint in enumerate(found):
        is_noise = abs(joint.force[0]) <= 1e-9 * max(abs(one.force[0]) for one in found)
        assert (columns["φ_{ij}, град"].cells[k].text == DASH) == is_noise
        for column, label in (
            (columns["±σ, Н"], size_label(joint)),
            (columns["±σ, град"], angle_label(joint)),
            (moment, moment_label(joint)),
        ):
            if column is None:
                continue
            if column is moment and not is_couple(guided_at(reading, k)):
                assert column.cells[k].text == DASH
                continue
            text = column.cells[k].text
            undirected = columns["φ_{ij}, град"].cells[k].text == DASH
            if label not in drawn.items or (label == angle_label(joint) and undirected):
                assert text == "—"
                continue
            spread_of = drawn.spreads[label]
            assert text.endswith("*") == bool(spread_of.drawn[0])
            sigma = float(spread_of.sigma[0])
            assert number(text) == (rounded(sigma) if sigma else 0)
        sigma = float(drawn.spreads[size_label(joint)].sigma[0])
        unit = Decimal(1).scaleb(rounded(sigma).normalize().adjusted())
        value = Decimal(float(drawn.read(size_label(joint))[0]))
        assert abs(number(read.cells[k].text) - value) <= unit / 2


def test_the_discrepancy_and_its_error_are_of_one_unit() -> None:
    reading = reading_of("levers/task12")
    _, exact, plans, lever, share = balance_columns(reading, RU, sigma=True)
    drawn = drawn_forces(reading.statics)
    assert exact.cells[1].text == "—"
    for column, label in ((plans, "balance"), (lever, "lever")):
        sigma = float(drawn.spreads[label].sigma[0])
        assert number(column.cells[1].text) == rounded(sigma)
        assert float(number(column.cells[0].text)) == pytest.approx(
            abs(float(drawn.read(label)[0])), abs=0.5 * float(rounded(sigma))
        )
    part = 100 * float(drawn.spreads["difference"].sigma[0]) / abs(float(drawn.read("balance")[0]))
    assert number(share.cells[1].text) == rounded(part)


@pytest.mark.parametrize("height", [5.0, 3.5])
@pytest.mark.parametrize("seed", [0, 2, 5, 9])
def test_the_table_is_no_wider_than_it_may_be(seed: int, height: float) -> None:
    problem, _ = loaded_problem(seed)
    solution = Solution(problem, positions=problem.drive.positions[:1])
    sizes = composition("forces").sizes_for("A1")
    entry = BlockSpec("reactions", heights=(height,))
    block = reactions_block(
        solution, [0], BlockStyle(entry, sizes, 811.0, BlockOptions(RU, sigma=True))
    )
    assert block.width == pytest.approx(185.0)


# Terminal and record ------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LOADED)
def test_table_and_record_have_the_same_errors(name: str) -> None:
    solution = Solution(problem_of(name))
    drawn = drawn_forces(statics_of(solution))
    entry = record(solution)["positions"][0]["forces"]
    text = result_tables(solution, "en", sigma=True)
    assert max(map(len, text.splitlines())) <= 100
    rows = [line.split() for line in text[text.index("Reactions") :].splitlines()]
    marks = False
    for joint, told in zip(statics_of(solution).reactions, entry["reactions"], strict=True):
        sigma = drawn.spreads[size_label(joint)]
        assert told["sigma"] == pytest.approx(float(sigma.sigma[0]))
        still = told["angle_deg"] is None
        assert (told["sigma_angle_deg"] is None) == still
        if not still:
            way = drawn.spreads[angle_label(joint)].sigma[0]
            assert told["sigma_angle_deg"] == pytest.approx(float(way))
        revolute = moment_label(joint) not in drawn.items
        assert (told["sigma_moment"] == 0.0 and told["read_moment"] == 0.0) or not revolute
        row = next(
            r
            for r in rows
            if r[:2]
            == [joint.joint, "←".join(map(solution.problem.mechanism.called, (joint.on, joint.by)))]
        )
        assert row[4].endswith("*") == bool(sigma.drawn[0])
        assert number(row[4].replace(".", ",")) == rounded(float(sigma.sigma[0]))
        marks = marks or bool(sigma.drawn[0])
        assert (size_label(joint) in entry["monte_carlo"]) == bool(sigma.drawn[0])
        rows.remove(row)
    assert (wording("en").drawn_note in text) or not marks
    assert entry["driving"]["sigma"] == pytest.approx(float(drawn.spreads["balance"].sigma[0]))
    assert entry["lever"]["hand"]["sigma_lever"] == pytest.approx(
        float(drawn.spreads["lever"].sigma[0])
    )
    plain = result_tables(solution, "en")
    assert not re.search(r"±", plain)
