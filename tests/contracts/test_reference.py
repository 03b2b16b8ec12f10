"""`planmethod solve --json` on the textbooks' mechanisms: the numbers and the shape."""

from __future__ import annotations

import cmath
import json
import math
from functools import cache
from typing import Any

import newton
import pytest
from click.testing import CliRunner
from doors import PlanKind, cli, pole_letter
from worked import SIX, exact_values, path_of, problem_of

POINT = ("x", "y", "vx", "vy", "v", "ax", "ay", "a")
KIND = {"x": "m", "y": "m", "vx": "m/s", "vy": "m/s", "v": "m/s"}
"""Unit of a column; the others are accelerations."""

SLIDING = {
    "linkages/ex1": {"guide": ("C", "3", "0")},
    "linkages/ex3": {"kulisa": ("B", "3", "2"), "guide": ("E", "5", "0")},
    "levers/six-link": {"CL": ("H", "4", "2"), "yy": ("H", "5", "0")},
    "levers/task12": {"F": ("B", "3", "2"), "E": ("E", "5", "4"), "K": ("E", "5", "0")},
    "press/press": {"kulisa": ("A", "3", "2"), "guide": ("B", "5", "0")},
    "press/press-stone": {
        "kulisa": ("A", "3", "2"),
        "N": ("B", "4", "3"),
        "guide": ("B", "5", "0"),
    },
}
"""Names of pairs in the exact values, and in the record: point, of, to."""


@cache
def solved(name: str) -> dict[str, Any]:
    run = CliRunner().invoke(cli, ["solve", str(path_of(name)), "--json"])
    assert run.exit_code == 0, run.output
    record: dict[str, Any] = json.loads(run.stdout)
    return record


@cache
def position(name: str) -> dict[str, Any]:
    (one,) = solved(name)["positions"]
    assert isinstance(one, dict)
    return one


def near(got: float, wanted: float, largest: float) -> bool:
    """Return whether a value agrees to 1e-9 relative; an exact 0, to 1e-9 of the largest."""
    return abs(got - wanted) <= 1e-9 * (abs(wanted) if wanted != 0 else largest)


@pytest.mark.parametrize("name", SLIDING)
def test_points_agree_with_the_exact_values(name: str) -> None:
    wanted = exact_values()[name]["points"]
    got = position(name)["points"]
    assert set(wanted) <= set(got)
    largest: dict[str, float] = {}
    for values in wanted.values():
        for key in POINT:
            unit = KIND.get(key, "m/s²")
            largest[unit] = max(largest.get(unit, 0.0), abs(values[key]))
    wrong = [
        (point, key, got[point][key], values[key])
        for point, values in wanted.items()
        for key in POINT
        if not near(got[point][key], values[key], largest[KIND.get(key, "m/s²")])
    ]
    assert wrong == []


@pytest.mark.parametrize("name", SLIDING)
def test_links_agree_with_the_exact_values(name: str) -> None:
    wanted = exact_values()[name]["links"]
    got = position(name)["links"]
    assert set(wanted) == set(got)
    for key in ("omega", "epsilon"):
        largest = max(abs(link[key]) for link in wanted.values())
        for link, values in wanted.items():
            assert near(got[link][key], values[key], largest), (link, key)


@pytest.mark.parametrize("name", SLIDING)
def test_sliding_agrees_with_the_exact_values(name: str) -> None:
    wanted = exact_values()[name]["sliding"]
    got = {(r["point"], r["of"], r["to"]): r for r in position(name)["relative"]}
    assert set(SLIDING[name].values()) == set(got)
    v = max(pair["v"] for pair in wanted.values())
    a = max(max(pair["a_coriolis"], pair["a_rel"]) for pair in wanted.values())
    for pair, values in wanted.items():
        found = got[SLIDING[name][pair]]
        assert near(found["v"], values["v"], v)
        assert near(found["a_coriolis"], values["a_coriolis"], a)
        assert near(found["a_rel"], values["a_rel"], a)


def test_the_unprinted_example_agrees_with_newtons_method() -> None:
    problem = problem_of("linkages/ex2")
    entry = position("linkages/ex2")
    points, links = entry["points"], entry["links"]
    pose = {
        link: (
            points[problem.bodies[link].axis[0]]["x"] + 1e-3,  # type: ignore[index]
            points[problem.bodies[link].axis[0]]["y"] - 1e-3,  # type: ignore[index]
            math.radians(links[link]["phi_deg"]) + 1e-3,
        )
        for link in problem.mechanism.links
    }
    wanted = newton.solve(problem, 30.0, pose)
    v_size = max(abs(v) for v in wanted.velocity.values())
    a_size = max(abs(a) for a in wanted.acceleration.values())
    for (_, name), place in wanted.position.items():
        one = points[name]
        assert complex(one["x"], one["y"]) == pytest.approx(place, abs=1e-12)
        v = wanted.velocity[next(key for key in wanted.velocity if key[1] == name)]
        a = wanted.acceleration[next(key for key in wanted.acceleration if key[1] == name)]
        assert abs(complex(one["vx"], one["vy"]) - v) <= 1e-9 * v_size
        assert abs(complex(one["ax"], one["ay"]) - a) <= 1e-9 * a_size
    for link in problem.mechanism.links:
        assert near(links[link]["omega"], wanted.omega[link], 40.0)
        assert near(links[link]["epsilon"], wanted.epsilon[link], 600.0)
    # The file says: B is to the left of the line from A to C, D to the left of the line from C to B
    a_, b, c, d = (complex(points[p]["x"], points[p]["y"]) for p in "ABCD")
    assert ((c - a_).conjugate() * (b - a_)).imag > 0
    assert ((b - c).conjugate() * (d - c)).imag > 0
    assert abs(b - d) == pytest.approx(0.11)
    assert abs(c - d) == pytest.approx(0.11)


# Shape -------------------------------------------------------------------------------------------


def test_structure_of_the_third_example() -> None:
    assert solved("linkages/ex3")["structure"] == {
        "mobility": 1,
        "moving_links": 5,
        "lower_pairs": 7,
        "higher_pairs": 0,
        "redundant": 6,
        "class": 2,
        "groups": [
            {"signature": "RPR", "class": 2, "order": 2, "kind": 3, "links": ["2", "3"]},
            {"signature": "RRP", "class": 2, "order": 2, "kind": 2, "links": ["4", "5"]},
        ],
        "formula": "I(0,1) → II(2,3) → II(4,5)",
        "frame": "0",
    }


NUMBERS = {
    "points": {*POINT},
    "links": {"phi_deg", "omega", "epsilon"},
}


@pytest.mark.parametrize("name", SIX)
def test_the_record_has_the_agreed_shape(name: str) -> None:
    whole = solved(name)
    problem = problem_of(name)
    own = {"synthesis"} if problem.synthesis is not None else set()
    assert set(whole) == {"schema", "problem", "structure", "positions"} | own
    assert whole["schema"] == 1
    assert whole["problem"] == path_of(name).stem
    for entry, asked in zip(whole["positions"], problem.drive.positions, strict=True):
        assert {"phi_deg", "margin", "points", "links", "relative", "plans"} <= set(entry)
        assert entry["phi_deg"] == asked
        assert isinstance(entry["margin"], float)
        assert entry["margin"] > 0
        for table, keys in NUMBERS.items():
            for values in entry[table].values():
                assert set(values) == keys
                assert all(type(value) is float for value in values.values())
        named = {point for body in problem.bodies.values() for point in body.points}
        assert named <= set(entry["points"])
        assert list(entry["links"]) == list(problem.mechanism.links)
        for pair in entry["relative"]:
            assert {"point", "of", "to", "v", "a_coriolis", "a_rel"} <= set(pair)
            assert all(
                type(value) is (str if key in ("point", "of", "to") else float)
                for key, value in pair.items()
            )
        plans = entry["plans"]
        assert set(plans) == {"position", "velocity", "acceleration"}
        assert plans["velocity"]["pole"] == "p"
        assert plans["acceleration"]["pole"] == pole_letter(problem, PlanKind.ACCELERATION)
        for plan in plans.values():
            assert type(plan["mu"]) is float
            assert plan["mu"] > 0
            for segment, values in plan["segments"].items():
                tail, sign, head = segment.partition("-")
                assert tail and sign and head, segment
                assert type(values["exact"]) is float
                assert type(values["read"]) is float


@pytest.mark.parametrize("name", SIX)
def test_the_parts_of_a_record_do_not_contradict_each_other(name: str) -> None:
    entry = position(name)
    for values in entry["points"].values():
        assert math.hypot(values["vx"], values["vy"]) == pytest.approx(values["v"], rel=1e-14)
        assert math.hypot(values["ax"], values["ay"]) == pytest.approx(values["a"], rel=1e-14)
    for kind, key in (("velocity", "v"), ("acceleration", "a")):
        plan = entry["plans"][kind]
        lengths = {segment: values["exact"] for segment, values in plan["segments"].items()}
        for point, values in entry["points"].items():
            letter = point[0].lower() + point[1:]
            drawn = lengths.get(f"{plan['pole']}-{letter}")
            if drawn is not None:
                assert drawn * plan["mu"] == pytest.approx(values[key], rel=1e-12)
    for pair in entry["relative"]:
        host = entry["links"].get(pair["to"], {"omega": 0.0})
        coriolis = 2 * abs(host["omega"]) * pair["v"]
        assert pair["a_coriolis"] == pytest.approx(coriolis, rel=1e-12, abs=1e-12)


def test_the_files_scales_are_the_plans_scales() -> None:
    plans = position("linkages/ex3")["plans"]
    mu = {name: plans[name]["mu"] for name in plans}
    assert mu == {"position": 0.002, "velocity": 0.05, "acceleration": 1.0}
    plans = position("levers/six-link")["plans"]  # mm per unit in this one: 250, 30, 2
    assert plans["position"]["mu"] == pytest.approx(1 / 250, rel=1e-15)
    assert plans["velocity"]["mu"] == pytest.approx(1 / 30, rel=1e-15)
    assert plans["acceleration"]["mu"] == 0.5


def test_coriolis_has_the_sense_of_the_relative_velocity_turned_along_omega() -> None:
    for name in ("linkages/ex3", "levers/six-link", "levers/task12", "press/press"):
        entry = position(name)
        for pair in entry["relative"]:
            if pair["a_coriolis"] == 0:
                continue
            v = complex(pair["vx"], pair["vy"])
            k = complex(pair["a_coriolis_x"], pair["a_coriolis_y"])
            turn = cmath.phase(k / v) * math.copysign(1.0, entry["links"][pair["to"]]["omega"])
            assert turn == pytest.approx(math.pi / 2, rel=1e-12)


def test_variants_have_their_name() -> None:
    file = str(path_of("levers/task12-variants"))
    run = CliRunner().invoke(cli, ["solve", file, "--all-variants", "--json"])
    assert run.exit_code == 0
    records = json.loads(run.stdout)
    asked = {r["variant"]: r["positions"][0]["phi_deg"] for r in records}
    assert asked == {"А": 60.0, "Б": 120.0, "В": 240.0, "Г": 300.0, "Д": 150.0, "Е": 30.0}
