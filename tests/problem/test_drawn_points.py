"""Sizes that follow from the coordinates of a drawn position, against mechanisms given by sizes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import each, sampled
from click.testing import CliRunner
from doors import (
    PointName,
    ProblemError,
    cli,
    drawn,
    get_language,
    plain_text,
    protocol_document,
    split_pair,
    statement_given_facts as given_facts,
)

import planmethod as pm
from benchmarks.rebuilt import rebuilt

SAME = 1e-9
FOUR_BAR = """
[frame]
A = [0, 0]
D = "drawn"
[links.1]
points = ["A", "B"]
[links.2]
points = ["B", "C", "K"]
[links.3]
points = ["D", "C"]
[driver]
link = "1"
omega = 10
[drawn]
points = { A = [0, 0], B = [0.03, 0.04], C = [0.15, 0.09], D = [0.2, 0], K = [0.1, 0.12] }
"""
AT = {"A": 0j, "B": 0.03 + 0.04j, "C": 0.15 + 0.09j, "D": 0.2 + 0j, "K": 0.1 + 0.12j}
SHIPPED = sorted(Path("problems/linkages").glob("*.toml"))
OTHER_DATA = {
    "assembly", "published", "answers", "compare", "scales", "cycle", "project", "letters",
    "machine", "variants", "dynamics", "loads", "balancing", "balancing_force", "friction",
    "bearings", "gears",
}  # fmt: skip


def places(problem: pm.Problem, positions: Any, names: Any) -> dict[str, Any]:
    solution = pm.Solution(problem, positions=positions)
    return {name: solution.place(PointName(name)) for name in names}


def faults(text: str) -> str:
    with pytest.raises(ProblemError) as caught:
        pm.loads(text, name="drawn")
    return str(caught.value)


def by_coordinates(problem: pm.Problem, table: dict[str, Any]) -> dict[str, Any]:
    """Return the table of a mechanism, with the coordinates of a position in place of sizes."""
    per = {"m": 1.0, "cm": 100.0, "mm": 1000.0, "in": 1 / 0.0254}[problem.unit]
    table = {key: value for key, value in table.items() if key not in OTHER_DATA}
    points = dict.fromkeys(p for body in problem.bodies.values() for p in body.points)
    at = places(problem, [float(problem.drive.positions[0])], points)
    for link in table["links"].values():
        for key in [*link]:
            if key not in ("points", "slides"):
                del link[key]
        link.get("slides", {}).pop("offset", None)
    table["frame"] |= dict.fromkeys(problem.bodies["0"].points, "drawn")
    for key in ("phi", "s"):
        table["driver"].pop(key, None)
    shown = {p: [float(z[0].real) * per, float(z[0].imag) * per] for p, z in at.items()}
    return {**table, "drawn": {"points": shown}}


@each("path", sampled(SHIPPED, 3))
def test_a_mechanism_that_is_given_by_coordinates_moves_as_the_one_given_by_sizes(
    path: Path,
) -> None:
    made = pm.Mechanism.from_file(path)
    problem, drive = made.problem, made.problem.drive
    found = problem.synthesis or problem.drawn or problem.mechanism.higher
    if found or drive.posed or drive.cam_drive or drive.gear_drive:
        pytest.skip("its sizes or its position have another source")
    again = pm.Mechanism.from_dict(by_coordinates(problem, made.to_dict()), name="again").problem
    assert again.drawn is not None and again.drawn.shown is not None
    assert again.drawn.position == pytest.approx(drive.positions[0], abs=1e-9)
    names = [*again.drawn.shown.places]
    one = places(problem, drive.positions, names)
    two = places(again, drive.positions, names)
    size = max(abs(z).max() for z in one.values())
    for name in names:
        assert np.nanmax(abs(one[name] - two[name])) < SAME * size, name


def test_the_position_the_sizes_and_the_assembly_are_those_of_the_coordinates() -> None:
    for below in (1, -1):
        text = FOUR_BAR.replace("0.09]", f"{0.09 * below}]")
        problem = pm.loads(text, name="drawn")
        expected = {**AT, "C": complex(0.15, 0.09 * below)}
        lengths = {name: length for _, name, length in problem.lengths}
        assert lengths.keys() == {"AB", "BC", "BK", "CK", "DC"}
        for name, length in lengths.items():
            assert length == pytest.approx(abs(expected[name[1]] - expected[name[0]]), rel=1e-15)
        assert problem.drive.positions == pytest.approx((np.degrees(np.angle(AT["B"])),))
        found = places(problem, problem.drive.positions, expected)
        for name, z in expected.items():
            assert abs(found[name][0] - z) < 1e-14, name


def test_velocities_satisfy_the_closed_contour_of_the_coordinates() -> None:
    solution = pm.Solution(pm.loads(FOUR_BAR, name="drawn"))
    ab, bc, dc = AT["B"], AT["C"] - AT["B"], AT["C"] - AT["D"]
    matrix = np.array([[(1j * bc).real, -(1j * dc).real], [(1j * bc).imag, -(1j * dc).imag]])
    rates = np.linalg.solve(matrix, [-(10j * ab).real, -(10j * ab).imag])
    assert solution.links["2"].omega[0] == pytest.approx(rates[0], rel=1e-12)
    assert solution.links["3"].omega[0] == pytest.approx(rates[1], rel=1e-12)
    v = 10j * ab + 1j * rates[0] * (AT["K"] - AT["B"])
    assert abs(solution.points["K"].velocity[0] - v) < 1e-12


def test_other_positions_start_from_the_drawn_one() -> None:
    text = FOUR_BAR.replace("omega = 10", "omega = 10\nphi = [20, 110]")
    problem = pm.loads(text, name="drawn")
    assert problem.drive.positions == (20.0, 110.0)
    assert problem.drive.assembly_positions == pytest.approx((np.degrees(np.angle(AT["B"])),))
    at = places(problem, problem.drive.positions, "BC")
    assert all(z.imag > 0 for z in at["C"])  # C stays above AD, as it is drawn


def test_a_given_length_stays_and_the_others_follow() -> None:
    text = FOUR_BAR.replace('"K"]\n', '"K"]\nBC = 0.1301\nK.side = "left of BC"\n')
    problem = pm.loads(text, name="drawn")
    lengths = {name: length for _, name, length in problem.lengths}
    assert lengths["BC"] == 0.1301
    assert lengths["BK"] == pytest.approx(abs(AT["K"] - AT["B"]))


def test_angles_of_lines_and_coordinates_determine_a_figure_together() -> None:
    text = FOUR_BAR.replace("D = [0.2, 0], ", "").replace("[drawn]\n", "[drawn]\nphi_3 = 90\n")
    text = text.replace('points = ["D", "C"]\n', 'points = ["D", "C"]\nDC = 0.09\n')
    problem = pm.loads(text, name="drawn")
    assert abs(problem.bodies["0"].points["D"] - 0.15) < SAME


def test_a_third_point_on_the_line_is_measured_along_it() -> None:
    for off in (0.0, 0.001):
        at = AT["B"] + (AT["C"] - AT["B"]) * complex(0.25, off)
        text = FOUR_BAR.replace("K = [0.1, 0.12]", f"K = [{at.real!r}, {at.imag!r}]")
        problem = pm.loads(text, name="drawn")
        assert "BK" not in {name for _, name, _ in problem.lengths}
        found = places(problem, problem.drive.positions, "K")
        assert abs(found["K"][0] - at) < 1e-15


SLIDER_CRANK = """
units = "mm"
[frame]
A = [0, 0]
guides.x-x = {{ through = {through}, angle = {angle} }}
[links.1]
points = ["A", "B"]
[links.2]
points = ["B", "C"]
[links.3]
points = ["C"]
slides = {{ on = "x-x" }}
[driver]
link = {driver}
[drawn]
points = {{ A = [0, 0], B = [30, 40], C = [150, -20] }}
"""


def test_a_pin_beside_its_guide_has_the_offset_that_is_drawn() -> None:
    text = SLIDER_CRANK.format(through='"A"', angle=0, driver='"1"\nomega = 5')
    problem = pm.loads(text, name="drawn")
    assert problem.slides["3"].offset == pytest.approx(-0.02)
    lengths = {name: x for _, name, x in problem.lengths}
    assert lengths["BC"] == pytest.approx(abs(complex(120, -60)) / 1000)


def test_a_drawn_guide_runs_through_the_pin() -> None:
    text = SLIDER_CRANK.format(through='"drawn"', angle=10, driver='"3"\nv = 0.2')
    problem = pm.loads(text, name="drawn")
    _, base, angle = problem.guides["x-x"]
    assert abs(base - (0.15 - 0.02j)) < 1e-15 and angle == 10.0
    assert problem.drive.positions == pytest.approx((0.0,))
    text = SLIDER_CRANK.format(through='"A"', angle='"drawn"', driver='"1"\nomega = 5')
    problem = pm.loads(text, name="drawn")
    assert problem.guides["x-x"][2] == pytest.approx(np.degrees(np.arctan2(-20, 150)))
    assert problem.slides["3"].offset == 0.0


def test_rounded_sizes_are_multiples_of_the_step_and_say_what_moved(tmp_path: Path) -> None:
    path = tmp_path / "fb.toml"
    path.write_text(FOUR_BAR, "utf-8")
    run = CliRunner().invoke(cli, ["--lang", "en", "solve", str(path), "--round", "1mm", "--json"])
    assert run.exit_code == 0, run.output
    assert "links.2.BK 0.106301 → 0.106 m" in run.stderr
    assert "points move: C" in run.stderr
    record = json.loads(run.stdout)
    shown = record["drawn"]
    assert shown["round"] == 0.001 and shown["points"]["B"] == [0.03, 0.04]
    for size in shown["sizes"]:
        assert size["value"] * 1000 == pytest.approx(round(size["value"] * 1000), abs=1e-9)
        assert abs(size["value"] - size["exact"]) <= 0.0005 + 1e-12
    at = record["positions"][0]["points"]
    for name, off in shown["moved"].items():
        there = complex(at[name]["x"], at[name]["y"])
        assert abs(there - AT[name]) == pytest.approx(off)
    assert shown["moved"].keys() == {"C", "K"}


def test_the_same_rounding_may_be_in_the_file() -> None:
    text = FOUR_BAR.replace("[drawn]\n", "[drawn]\nround = 0.001\n")
    lengths = {name: x for _, name, x in pm.loads(text, name="drawn").lengths}
    assert lengths == {"AB": 0.05, "BC": 0.13, "BK": 0.106, "CK": 0.058, "DC": 0.103}
    assert "BC = 0.13 m becomes zero" in faults(text.replace("0.001", "1"))


def test_round_without_coordinates_is_refused(tmp_path: Path) -> None:
    runner = CliRunner()
    run = runner.invoke(
        cli, ["--lang", "en", "solve", "problems/linkages/ex3.toml", "--round", "1mm"]
    )
    assert run.exit_code and "no sizes to round" in run.output
    path = tmp_path / "fb.toml"
    path.write_text(FOUR_BAR, "utf-8")
    run = runner.invoke(cli, ["--lang", "en", "solve", str(path), "--round", "one"])
    assert run.exit_code == 2 and "not a length such as 1mm" in run.output
    run = runner.invoke(cli, ["--lang", "en", "sketch", str(path), "--round", "1mm"])
    assert run.exit_code == 2 and "omit --round" in run.output


@pytest.mark.parametrize("lang", ["ru", "en"])
@pytest.mark.parametrize("step", ["", "round = 0.001\n"])
def test_the_given_data_rebuild_the_mechanism_and_the_protocol_derives_the_sizes(
    lang: str, step: str
) -> None:
    problem = pm.loads(FOUR_BAR.replace("[drawn]\n", f"[drawn]\n{step}"), name="drawn")
    language = get_language(lang)
    facts = [drawn(problem, language), *given_facts(problem, language)]
    keys = {key for fact in facts for key in fact.data}
    assert not any(key.startswith("links.") and key[-2:] in ("AB", "BC", "DC") for key in keys)
    assert "drawn.points.B" in keys
    again = rebuilt(facts)
    one = places(problem, problem.drive.positions, AT)
    two = places(again, again.drive.positions, AT)
    assert all(abs(one[name] - two[name]).max() < SAME for name in AT)
    protocol = protocol_document(pm.Solution(problem), language)
    text = str(protocol.to_text() if hasattr(protocol, "to_text") else protocol)
    assert "l_" in text and ("0,12" in text if lang == "ru" else "0.12" in text)
    assert any("l_{BC}" in str(fact.text) for fact in facts)
    assert plain_text(facts[0].text)


def test_coordinates_can_be_varied_in_python_and_by_variants() -> None:
    made = pm.Mechanism.from_toml(FOUR_BAR)
    moved = made.with_(C=(0.16, 0.08))
    lengths = {name: x for _, name, x in moved.problem.lengths}
    assert lengths["BC"] == pytest.approx(abs(0.16 + 0.08j - AT["B"]))
    grid = made.grid([20.0, 90.0], {"x_C": [0.15, 0.155, 0.16]})
    for k, x in enumerate((0.15, 0.155, 0.16)):
        alone = made.with_(x_C=x).solve([20.0, 90.0]).to_columns(["x_C"])["x_C"]
        np.testing.assert_allclose(grid["x_C"][k], alone, rtol=1e-12)
    text = FOUR_BAR + '[variants.2]\n"drawn.points.C" = [0.16, 0.08]\n"drawn.round" = "1mm"\n'
    found = {name: x for _, name, x in pm.loads(text, name="drawn", variant="2").lengths}
    assert found["BC"] == pytest.approx(0.136)


@each(
    "old, new, told",
    [
        ("D = [0.2, 0], ", "", "no length leads to it from D"),
        ("K = [0.1, 0.12]", "Q = [0.1, 0.12]", "no link has the point 'Q'"),
        ("K = [0.1, 0.12]", 'K = [0.1, "x"]', "drawn.points.K[1]"),
        ("K = [0.1, 0.12]", "K = [0.1, 0.12, 0]", "drawn.points.K"),
        ("C = [0.15, 0.09]", "C = [0.03, 0.04]", "B and C of link 2 are at the same place"),
        ('"K"]\n', '"K"]\nBC = 0.2\n', "BC = 0.2 m in [links.2], but the coordinates put B and C"),
        ('D = "drawn"', "D = [0.25, 0]", "[frame] has D 0.05 m away from there"),
        ("[drawn]\n", "[drawn]\nphi_BC = 60\n", "the coordinates give 22.62"),
        ("[drawn]\n", "[drawn]\nBC = 0.14\n", "the coordinates give 0.13"),
        ("[drawn]\n", "[drawn]\nphi_AB_BC = 10\n", "the coordinates give 30.51"),
        ("[drawn]\n", '[assembly]\nC = "below A"\n[drawn]\n', "show the contrary"),
        ("[drawn]\n", "[drawn]\nround = -1\n", "drawn.round"),
    ],
)
def test_contradictions_are_named_with_their_numbers(old: str, new: str, told: str) -> None:
    text = FOUR_BAR.replace(old, new)
    assert text != FOUR_BAR
    assert told in faults(text)


def test_coordinates_must_be_a_table_of_some_points() -> None:
    start = FOUR_BAR.partition("points = { A")[0]
    assert "drawn.points" in faults(start + "points = 3\n")
    assert "no points are given" in faults(start + "points = {}\n")
    assert "drawn" in faults(start + "round = 0.001\n")
    assert split_pair("AB") == ("A", "B")
