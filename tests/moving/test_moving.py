"""The moving point against derivatives that mpmath takes by differences, to 50 digits."""

from __future__ import annotations

import json
import math
from typing import Any

import mpmath
import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    ExitCode,
    cli,
    moving_reader_load as load,
    moving_record_record as record,
    reader_loads as loads,
)
from worked import PROBLEMS

K11 = sorted((PROBLEMS / "point").glob("k11-*.toml"))

AT_ZERO = {
    # vx, vy, ax, ay of the fourteen problems at t = 0, by hand from the series of the factors
    1: (3, 4, 3, 0),
    2: (6, 8, 0, 8),
    3: (12, 5, 0, 0),
    4: (9, 12, -9, 0),
    5: (15, 8, 0, -8),
    6: (0, 16, -12, 0),
    7: (-21, 0, 0, -20),
    8: (24, -7, 24, 0),
    9: (24, 10, 24, 10),
    10: (18, 24, 18, 24),
    11: (3, 4, -3, 4),
    12: (0, 9, 12, -9),
    13: (8, 0, 0, 15),
    14: (16, 12, 0, 0),
}

MATHS: dict[str, Any] = {
    **{name: getattr(mpmath, name) for name in ("sin", "cos", "exp", "sqrt", "pi", "e")},
    "ln": mpmath.log,
    "log": mpmath.log,
    "lg": mpmath.log10,
    "abs": mpmath.fabs,
    "tg": mpmath.tan,
    "tan": mpmath.tan,
    "ctg": mpmath.cot,
    "cot": mpmath.cot,
    "sh": mpmath.sinh,
    "ch": mpmath.cosh,
    "th": mpmath.tanh,
    "sinh": mpmath.sinh,
    "cosh": mpmath.cosh,
    "tanh": mpmath.tanh,
    **dict.fromkeys(("asin", "arcsin"), mpmath.asin),
    **dict.fromkeys(("acos", "arccos"), mpmath.acos),
    **dict.fromkeys(("atan", "arctan", "arctg"), mpmath.atan),
}


def referee(x: Any, y: Any, at: float) -> dict[str, float]:
    """Return the motion by mpmath's own derivatives."""
    with mpmath.workdps(50):
        t = mpmath.mpf(at)
        (x0, x1, x2), (y0, y1, y2) = ([mpmath.diff(f, t, n) for n in range(3)] for f in (x, y))
        v, a = mpmath.hypot(x1, y1), mpmath.hypot(x2, y2)
        cross = abs(x1 * y2 - y1 * x2)
        found = {"x": x0, "y": y0, "vx": x1, "vy": y1, "v": v, "ax": x2, "ay": y2, "a": a}
        found |= {"a_tangential": (x1 * x2 + y1 * y2) / v, "a_normal": cross / v}
        if cross > 1e-20:
            found["rho"] = v**3 / cross
        return {name: float(value) for name, value in found.items()}


def python(formula: str) -> Any:
    """Return a formula of the tests' own as a function of mpmath."""
    code = compile(formula.replace("^", "**"), "formula", "eval")
    return lambda t: mpmath.mpf(1) * eval(code, {"__builtins__": {}}, {**MATHS, "t": t})


def rows(point: str, **more: Any) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = record(loads(f"[point]\n{point}", name="p", **more))["point"]
    return found


def agrees(got: dict[str, Any], wanted: dict[str, float], share: float = 1e-12) -> None:
    scale = max(abs(wanted["v"]), abs(wanted["a"]), 1.0)
    for name, value in wanted.items():
        assert got[name] == pytest.approx(value, rel=share, abs=share * scale), name


def test_all_fourteen_are_here() -> None:
    assert [path.stem for path in K11] == [f"k11-{n:02}" for n in range(1, 15)]
    for path in K11:
        problem = load(path)
        assert problem.title
        assert problem.source


@each("number", AT_ZERO)
def test_the_fourteen_answers(number: int) -> None:
    (row,) = record(load(K11[number - 1]))["point"]
    vx, vy, ax, ay = AT_ZERO[number]
    v, cross = math.hypot(vx, vy), abs(vx * ay - vy * ax)
    wanted = {"t": 0, "vx": vx, "vy": vy, "v": v, "ax": ax, "ay": ay, "a": math.hypot(ax, ay)}
    wanted |= {"a_tangential": (vx * ax + vy * ay) / v, "a_normal": cross / v}
    for name, value in wanted.items():
        assert row[name] == pytest.approx(value, rel=1e-12, abs=1e-12), name
    if cross:
        assert row["rho"] == pytest.approx(v**3 / cross, rel=1e-12)
        assert "reason" not in row
    else:
        assert (row["rho"], row["reason"]) == (None, "straight")


@each("number", AT_ZERO)
@pytest.mark.parametrize("at", [0.0, 0.37, 2.5])
def test_the_fourteen_against_derivatives_of_mpmath(number: int, at: float) -> None:
    problem = load(K11[number - 1])
    x, y = (problem.formulas[key].text for key in "xy")
    (row,) = rows(f'x = "{x}"\ny = "{y}"\nt = {at}')
    agrees(row, referee(python(x), python(y), at))


@pytest.mark.parametrize("name", sorted(MATHS))
def test_every_function(name: str) -> None:
    formula = f"{name}*t" if name in ("pi", "e") else f"{name}(0.3 + t/7)"
    (row,) = rows(f'x = "{formula}"\ny = "t^3 - 2*t"\nt = 0.9')
    agrees(row, referee(python(formula), python("t^3 - 2*t"), 0.9))


@pytest.mark.parametrize(
    "formula",
    [
        "-t^2",
        "(-t)^2",
        "2^-t",
        "2^t^2",
        "t**0.5",
        "t^(-3)",
        "t^t",
        "(t - 3)^3",
        "(t - 3)^4/t",
        "1 - 2 - t",
        "8/4/t",
        "--t + -+-3*t",
        ".5*t + 1.e1 + 2E-1*t",
        "5",
        "abs(t - 3)*t",
        "1/(1 + 1/(1 + 1/t))",
        "e^(-t/2)*sin(2*pi*t)",
    ],
)
def test_the_grammar_reads_as_mathematics_does(formula: str) -> None:
    (row,) = rows(f'x = "{formula}"\ny = "t^2 + t"\nt = 1.3')
    agrees(row, referee(python(formula), python("t^2 + t"), 1.3))


def test_the_tangential_part_has_the_sign_of_speeding_up() -> None:
    slow, fast = rows('x = "-t^2"\ny = "t^3"\nt = [-2, 2]')
    assert slow["a_tangential"] == pytest.approx(-fast["a_tangential"])
    assert fast["a_tangential"] > 0


# Where something does not exist ------------------------------------------------------------------


def test_a_point_at_rest_has_no_tangent() -> None:
    for point in (
        'x = "t^2"\ny = "t^3"\nt = 0',
        'x = "cos(t)"\ny = "0.3 + 2*cos(t)"\nt = "pi"',
        'x = "sin(pi*t)"\ny = "1"\nt = 0.5',
        'x = "cos(10*pi*t/3)"\ny = "1"\nt = 0.3',
        'x = "(t - 0.3)^2"\ny = "(10*t - 3)^2"\nt = { from = 0.3, to = 0.9, step = 1 }',
    ):
        (row,) = rows(point)
        assert row["reason"] == "at rest"
        assert (row["v"], row["vx"], row["vy"]) == (0.0, 0.0, 0.0)
        assert [row[k] for k in ("a_tangential", "a_normal", "rho")] == [None] * 3
        assert row["a"] > 0


def test_a_straight_line_is_recognized_in_spite_of_rounding() -> None:
    found = rows('x = "0.1*sin(t)"\ny = "0.3*sin(t) + 7"\nt = { from = 0.1, to = 1.5, count = 57 }')
    assert {row["reason"] for row in found} == {"straight"}
    assert {row["a_normal"] for row in found} == {0.0}
    assert {row["rho"] for row in found} == {None}


def test_small_curvature_is_not_taken_for_zero() -> None:
    (row,) = rows('x = "t"\ny = "1e-9*t^2"\nt = 1')
    assert row["rho"] == pytest.approx(5e8, rel=1e-9)


@pytest.mark.parametrize(
    ("formula", "at", "reason", "last"),
    [
        ("ln(t)", "0", "position undefined", None),
        ("ln(cos(t))", '"pi/2"', "position undefined", None),
        ("sqrt(t - 1)", "0", "position undefined", None),
        ("1/t", "0", "position undefined", None),
        ("tg(t)", '"pi/2"', "position undefined", None),
        ("exp(exp(t))", "9", "position undefined", None),
        ("(-2)^t", "1", "position undefined", None),
        ("arcsin(t)", "2", "position undefined", None),
        ("sqrt(t)", "0", "velocity undefined", "y"),
        ("abs(t)", "0", "velocity undefined", "y"),
        ("t^1.5", "0", "acceleration undefined", "v"),
    ],
)
def test_a_missing_value_is_null_with_a_reason(
    formula: str, at: str, reason: str, last: str | None
) -> None:
    (row,) = rows(f'x = "{formula}"\ny = "t"\nt = {at}')
    names = [name for name in row if name not in ("t", "reason")]
    there = names[: names.index(last) + 1] if last else []
    assert row["reason"] == reason
    assert all(row[name] is not None for name in there if name != "x" or last)
    assert all(row[name] is None for name in names if name not in there and name != "y")
    json.dumps(row, allow_nan=False)


# Other laws --------------------------------------------------------------------------------------


def test_polar_coordinates() -> None:
    (row,) = rows('r = "2 + t^2"\nphi = "3*t"\nt = 0.7')
    r, phi = python("2 + t^2"), python("3*t")
    agrees(
        row, referee(lambda t: r(t) * mpmath.cos(phi(t)), lambda t: r(t) * mpmath.sin(phi(t)), 0.7)
    )
    assert row["v_r"] == pytest.approx(1.4)
    assert row["v_phi"] == pytest.approx(2.49 * 3)
    assert row["a_r"] == pytest.approx(2 - 2.49 * 9)
    assert row["a_phi"] == pytest.approx(2 * 1.4 * 3)


def test_a_natural_motion_along_a_circle_and_a_line() -> None:
    (row,) = rows('s = "t^3 - t"\nradius = 2\nt = 1')
    assert (row["x"], row["y"]) == (2.0, 0.0)
    assert row["v"] == pytest.approx(2, rel=1e-14)
    assert row["a_tangential"] == pytest.approx(6, rel=1e-14)
    assert row["a_normal"] == pytest.approx(2, rel=1e-14)
    assert row["rho"] == pytest.approx(2, rel=1e-14)
    (row,) = rows('s = "t^3 - t"\nt = 2')
    assert (row["x"], row["v"], row["a_tangential"], row["reason"]) == (6, 11, 12, "straight")


def test_moments_of_all_kinds() -> None:
    law = 'x = "t"\ny = "t^2"\nt = '

    def times(t: str) -> list[float]:
        return [row["t"] for row in rows(law + t)]

    assert times("2") == [2]
    assert times("[0, 3, 1]") == [0, 3, 1]
    assert times('"pi/2"') == [math.pi / 2]
    assert times("{ from = 0, to = 1, count = 3 }") == [0, 0.5, 1]
    assert times('{ from = 0, to = "2*pi", step = "pi" }') == [0, math.pi, 2 * math.pi]
    assert len(times("{ from = 0, to = 1, step = 0.1 }")) == 11


def test_a_variant_has_a_law_of_its_own() -> None:
    text = '[point]\nx = "t"\ny = "t^2"\nt = 1\n[published.v]\nvalue = 2.24\nwhat = "v"\n'
    text += '[variants.Б]\npoint.y = "t^3"\n'
    assert [item.what for item in loads(text, name="p").published] == ["v"]
    other = loads(text, name="p", variant="Б")
    assert other.published == ()
    (row,) = record(other)["point"]
    assert (row["vy"], row["ay"], record(other)["variant"]) == (3, 6, "Б")


# The command -------------------------------------------------------------------------------------


def solve(*args: object) -> Any:
    return CliRunner().invoke(cli, ["solve", *map(str, args)])


def test_solve_prints_one_object_as_agreed() -> None:
    run = solve(K11[0], "--json")
    told = json.loads(run.output)
    names = "t x y vx vy v ax ay a a_tangential a_normal rho"
    assert list(told["point"][0]) == names.split()
    assert told["problem"] == "k11-01"
    assert told["point"][0]["a_tangential"] == pytest.approx(1.8, rel=1e-15)


def test_points_and_linkages_in_one_run() -> None:
    run = solve(K11[0], PROBLEMS / "linkages" / "ex3.toml", K11[13], "--json")
    assert run.exit_code == ExitCode.DONE
    assert sorted("point" in told for told in json.loads(run.output)) == [False, True, True]


@pytest.mark.parametrize("lang", ["ru", "en"])
def test_the_text_has_formulas_with_numbers(lang: str) -> None:
    run = solve(K11[0], "--lang", lang)
    assert run.exit_code == ExitCode.DONE
    said = run.output.replace(",", ".")
    assert "v = √(v_x² + v_y²) = √(3² + 4²) = 5 " in said
    assert "a^τ = (v_x·a_x + v_y·a_y)/v = (3·3 + 4·0)/5 = 1.8 " in said
    assert "ρ = v²/aⁿ = 5²/2.4 = 10.417 " in said
    assert "ρ → ∞" in solve(K11[2], "--lang", lang).output


@pytest.mark.usefixtures("russian")
def test_a_row_of_moments_is_a_table_of_the_width_of_a_terminal(tmp_path: Any) -> None:
    path = tmp_path / "row.toml"
    path.write_text(
        '[point]\nr = "t"\nphi = "t^2"\nt = { from = 0, to = 2, step = 0.25 }\n'
        '[published]\nv = { value = 1.1, what = "v", position = 0 }\nodd = { value = 3 }\n',
        encoding="utf-8",
    )
    run = solve(path)
    assert run.exit_code == ExitCode.DONE, run.output
    assert max(map(len, run.output.splitlines())) <= 100
    assert "a_φ, м/с²" in run.output
    assert "1,1" in run.output


def test_variants_are_solved_one_by_one(tmp_path: Any) -> None:
    path = tmp_path / "v.toml"
    path.write_text(
        '[point]\nx = "t"\ny = "t^2"\nt = 1\n'
        "[variants.A]\npoint.t = 2\n[variants.B]\npoint.t = 3\n",
        encoding="utf-8",
    )
    told = json.loads(solve(path, "--all-variants", "--json").output)
    assert [(one["variant"], one["point"][0]["t"]) for one in told] == [("A", 2), ("B", 3)]
    assert solve(path, "--all-variants", "--variant", "A").exit_code == ExitCode.USAGE
    assert solve(path, "--variant", "C").exit_code == ExitCode.PROBLEM


@pytest.mark.parametrize("option", [("--csv",), ("--phi", "20"), ("--sigma",), ("--ask", "v")])
def test_options_of_linkages_are_rejected(option: tuple[str, ...]) -> None:
    run = solve(K11[0], *option)
    assert run.exit_code == ExitCode.USAGE
    assert "k11-01" in run.output


def test_a_faulty_point_leaves_the_others_to_be_solved(tmp_path: Any) -> None:
    path = tmp_path / "bad.toml"
    path.write_text('[point]\nx = "3t"\ny = "t"\nt = 0\n', encoding="utf-8")
    run = solve(path, K11[0], "--json")
    assert run.exit_code == ExitCode.PROBLEM
    assert '"k11-01"' in run.output
    assert "character 2: expected an operator before 't'" in run.output


def test_one_moment_by_a_formula_makes_all_of_a_list_inexact() -> None:
    def blur(t: str) -> list[bool]:
        return [one > 0.0 for one in loads(f'[point]\ns = "t"\nt = {t}', name="p").blur]

    assert blur("[0.25, 0.5]") == [False, False]
    assert blur('[0.25, "1/2"]') == blur('{ from = 0.0, to = "1", count = 2 }') == [True, True]
