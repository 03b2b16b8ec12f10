"""Every column, mistake and sentence of a moving point, from its place as a function of time."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from functools import cache
from math import cos, exp, hypot, isnan, pi, radians, sin
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from cases import each
from click.testing import CliRunner
from doors import PointQuantities, cli, derived_values, drawn_interval, reader_loads as loads

TIMES = (0.3, 0.9, 1.7)
Place = Callable[[float], complex]
Law = tuple[str, Place, dict[str, Callable[[float], Any]]]


def turned(angle: float) -> complex:
    return complex(cos(angle), sin(angle))


def rolling(
    radius: float, r: float, angle: float, track: float, phi: Callable[[float], float]
) -> Law:
    """Return a wheel on the x axis, or on (within) a circle: as its keys and its places say."""
    keys = f"radius = {radius}, r = {r}, angle = {angle}"

    def centre(t: float) -> complex:
        if not track:
            return complex(-radius * phi(t), radius)
        start = pi / 2 if track > 0 else -pi / 2
        return abs(radius + track) * turned(start + phi(t) * radius / (radius + track))

    def touch(t: float) -> complex:
        own = centre(t)
        return own - 1j * radius if not track else abs(track) * own / abs(own)

    own = {"C": centre, "P": touch, "turn": phi}
    return keys, lambda t: centre(t) + r * turned(phi(t) + radians(angle)), own


LINE = rolling(0.5, 0.3, 20, 0.0, lambda t: t - 2 * t * t)
ON = rolling(0.5, 0.7, -40, 1.0, lambda t: -2 * t * t + t**3)
WITHIN = rolling(0.5, 0.5, 110, -2.0, lambda t: 2 * t * t)
LAWS: dict[str, Law] = {
    "plane": (
        'x = "3*t*exp(t/2)"\ny = "-4*t/(t^2 + 1)"',
        lambda t: complex(3 * t * exp(t / 2), -4 * t / (t * t + 1)), {},
    ),
    "polar": (
        'r = "1 + t^2"\nphi = "t^3 - 2*t"',
        lambda t: (1 + t * t) * turned(t**3 - 2 * t),
        {"r": lambda t: 1 + t * t, "phi": lambda t: t**3 - 2 * t},
    ),
    "circle": (
        's = "t^3 - 2*t"\nradius = 2', lambda t: 2 * turned((t**3 - 2 * t) / 2), {},
    ),
    "line": (f'wheel = {{ {LINE[0]} }}\nphi = "t - 2*t^2"', *LINE[1:]),
    "on": (f'wheel = {{ {ON[0]}, on = 1 }}\nphi = "-2*t^2 + t^3"', *ON[1:]),
    "within": (f'wheel = {{ {WITHIN[0]}, within = 2 }}\nphi = "2*t^2"', *WITHIN[1:]),
    "planet": (
        'wheel = { radius = 0.2, r = 0.3, angle = 30, arm = 0.5 }\ntheta = "t^2"\n'
        'phi = "5*t - t^3"',
        lambda t: 0.5 * turned(t * t) + 0.3 * turned(5 * t - t**3 + pi / 6),
        {"C": lambda t: 0.5 * turned(t * t), "turn": lambda t: 5 * t - t**3},
    ),
}  # fmt: skip


def rates(of: Callable[[float], Any], t: float) -> tuple[Any, Any, Any]:
    """Return a function with two derivatives by central differences of the fourth order."""
    h = 1e-3
    a, b, c, d, e = (of(t + k * h) for k in (-2, -1, 0, 1, 2))
    return c, (a - 8 * b + 8 * d - e) / (12 * h), (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h * h)


def columns(name: str, t: float) -> dict[str, float]:
    """Return what the record should have at a moment."""
    _, place, own = LAWS[name]
    z, v, a = rates(place, t)
    along = v / abs(v)
    found = {"t": t, "x": z.real, "y": z.imag, "vx": v.real, "vy": v.imag, "v": abs(v)}
    found |= {"ax": a.real, "ay": a.imag, "a": abs(a)}
    parts = a / along
    found |= {"a_tangential": parts.real, "a_normal": abs(parts.imag)}
    found["rho"] = abs(v) ** 2 / abs(parts.imag)
    if "r" in own:
        out = turned(own["phi"](t))
        found |= {"r": own["r"](t), "phi": own["phi"](t)}
        found |= {"v_r": (v / out).real, "v_phi": (v / out).imag}
        found |= {"a_r": (a / out).real, "a_phi": (a / out).imag}
    if "C" in own:
        phi, omega, epsilon = rates(own["turn"], t)
        centre, moved, _ = rates(own["C"], t)
        found |= {"phi": phi, "omega": omega, "epsilon": epsilon}
        touch = centre + 1j * moved / omega  # where v_C + ω × CP = 0
        if "P" in own:
            assert touch == pytest.approx(own["P"](t), abs=1e-6)
        found |= {"xC": centre.real, "yC": centre.imag, "xP": touch.real, "yP": touch.imag}
        span = lambda t: own["C"](t) / own["C"](TIMES[0])  # noqa: E731
        if name != "line":
            whole, rate, bend = rates(span, t)
            found["omega_H"] = (rate / whole).imag
            found["epsilon_H"] = ((bend - rate * rate / whole) / whole).imag
    return found


@cache
def solved(name: str) -> tuple[list[dict[str, Any]], dict[str, Any], str, str, PointQuantities]:
    """Return rows and legend of the record, the texts of one and of many moments, the questions."""
    text = f"[point]\n{LAWS[name][0]}\nt = {list(TIMES)}\n"
    many = text.replace(f"t = {list(TIMES)}", "t = { from = 0.2, to = 1.2, count = 6 }")
    with TemporaryDirectory() as folder:
        path, other = Path(folder) / "p.toml", Path(folder) / "q.toml"
        path.write_text(text, "utf-8")
        other.write_text(many, "utf-8")
        words = (["--json", path], ["--lang", "en", path], ["--lang", "en", other])
        record, few, table = (
            CliRunner().invoke(cli, ["solve", *map(str, one)]).stdout for one in words
        )
    found = json.loads(record)
    return found["point"], found["legend"], few, table, PointQuantities(loads(text, name="p"))


def close(value: float, share: float = 1e-6) -> Any:
    return pytest.approx(value, rel=share, abs=share)


@each("name", LAWS)
def test_a_row_of_the_record_has_the_rates_of_the_place(name: str) -> None:
    rows, legend, *_ = solved(name)
    for t, row in zip(TIMES, rows, strict=True):
        due = columns(name, t)
        assert [*row] == [*legend]
        assert set(row) == set(due)
        for key, value in due.items():
            assert row[key] == close(value), (key, t)


@each("name", LAWS)
def test_a_table_of_moments_has_the_columns_of_each_moment(name: str) -> None:
    _, _, _, table, _ = solved(name)
    assert re.findall(r"(?m)^Polar coordinates|^Rolling wheel", table) == (
        ["Polar coordinates"] if name == "polar" else [] if name in ("plane", "circle")
        else ["Rolling wheel"]
    )  # fmt: skip
    heads: list[str] = []
    seen = 0
    for line in table.splitlines():
        if re.match(r" *t +\S", line):
            heads = [re.sub("[_^ⁿ,]", "", one.split(",")[0]) for one in re.split(r" {2,}", line)]
        cells = line.split()
        if heads and cells and re.fullmatch(r"[01](\.\d)?", cells[0]) and len(cells) > 2:
            due = columns(name, float(cells[0]))
            assert len(cells) == len(heads) or heads[0] == ""
            for head, cell in zip([x for x in heads if x], cells, strict=True):
                key = {"aτ": "a_tangential", "a": "a", "ρ": "rho", "vr": "v_r", "vφ": "v_phi",
                       "ar": "a_r", "aφ": "a_phi", "φ": "phi", "ω": "omega", "ε": "epsilon",
                       "ωH": "omega_H", "εH": "epsilon_H"}.get(head, head)  # fmt: skip
                if key == "a" and "a" in heads and heads.index("a") != len(heads) - 1:
                    continue  # the heads a and aⁿ are alike here
                shown = float(cell.replace("−", "-").replace("·10", "e"))
                assert shown == pytest.approx(due[key], rel=6e-3, abs=6e-3), (head, line)
                seen += 1
    assert seen >= 6 * 8


def test_a_mistake_has_the_number_that_its_name_says() -> None:
    """K1 to K6, with the parts, the roots and the degrees worked out here."""
    text = '[point]\nx = "3*sin(t)"\ny = "2*t^2 + cos(t)"\nt = [0.4, 1.1]\n'
    figures = PointQuantities(loads(text, name="p"))
    for k, t in enumerate((0.4, 1.1)):
        v = complex(3 * cos(t), 4 * t - sin(t))
        a = complex(-3 * sin(t), 4 - cos(t))
        parts = a / (v / abs(v))
        right = {"v": abs(v), "a": abs(a), "a_tau": parts.real, "a_n": abs(parts.imag)}
        right["rho"] = abs(v) ** 2 / abs(parts.imag)
        turn = radians(1) * t
        w = complex(3 * cos(turn), 4 * t - sin(turn))
        b = complex(-3 * sin(turn), 4 - cos(turn))
        across = b / (w / abs(w))
        changes: list[tuple[str, dict[str, float]]] = [
            ("K1", {"a_tau": right["a_n"], "a_n": right["a_tau"]}),
            ("K2", {"a_tau": right["a"], "a_n": right["a"]}),
            ("K2", {"a_tau": right["a"]}),
            ("K2", {"a_n": right["a"]}),
            ("K3", {"v": abs(v) ** 2, "a": abs(a) ** 2}),
            ("K3", {"v": abs(v) ** 2}),
            ("K3", {"a": abs(a) ** 2}),
            ("K4", {"v": abs(v.real + v.imag), "a": abs(a.real + a.imag)}),
            ("K4", {"v": abs(v.real + v.imag)}),
            ("K4", {"a": abs(a.real + a.imag)}),
            ("K5", {"rho": abs(v) / abs(parts.imag)}),
            ("K6", {"v": abs(w), "a": abs(b), "a_tau": across.real, "a_n": abs(across.imag),
                    "rho": abs(w) ** 2 / abs(across.imag)}),
        ]  # fmt: skip
        found = list(figures.mistaken())
        assert [one.code for one in found] == [code for code, _ in changes]
        for mistake, (_, change) in zip(found, changes, strict=True):
            for name, value in right.items():
                assert mistake.read(name, k) == close(change.get(name, value), 1e-9), mistake.code
                own = figures.quantity(name, k)
                assert own is not None and own.value == close(value, 1e-9)
                assert own.signed == (name == "a_tau")


def test_a_quantity_follows_from_the_answers_that_it_hangs_on() -> None:
    figures = PointQuantities(loads('[point]\nx = "t"\ny = "t^2"\nt = 1\n', name="p"))
    own = {"vx": 3.0, "vy": -4.0, "ax": 5.0, "ay": 12.0, "v": 2.0, "a": 13.0}
    own |= {"a_tau": -5.0, "a_n": 8.0}
    names = [*own, "rho"]
    related = figures.relations(names, 0)

    def found(name: str, answers: dict[str, float] = own) -> dict[frozenset[str], float]:
        told = derived_values(related, name, answers)
        return {frozenset(by): value for value, by in told if by != ("v",)}

    parts = ("vx", "vy", "ax", "ay")
    wanted: dict[str, list[tuple[float, tuple[str, ...]]]] = {
        "v": [(5.0, ("vx", "vy"))],
        "a": [(13.0, ("ax", "ay")), (89**0.5, ("a_tau", "a_n"))],
        "a_n": [
            (12.0, ("a", "a_tau")),
            (28.0, (*parts, "v")),
            (11.2, parts),
            (4 / 9, ("v", "rho")),
        ],
        "a_tau": [(-16.5, (*parts, "v")), (-6.6, parts)],
        "rho": [(0.5, ("v", "a_n")), (1 / 7, (*parts, "v"))],
    }
    own["rho"] = 9.0
    for name, ways in wanted.items():
        assert found(name) == {frozenset(by): close(value) for value, by in ways}, name
    by_leg = found("a_n", {"a": 1.0, "a_tau": 5.0})
    assert by_leg[frozenset(("a", "a_tau"))] == 0.0
    divided = found("rho", {"v": 2.0, "a_n": 0.0})
    assert isnan(divided[frozenset(("v", "a_n"))])


REASONS = {
    "the formulas of the coordinates have no value": ('x = "ln(t - 1)"\ny = "t"', 0),
    "the velocity is undefined": ('x = "sqrt(t)"\ny = "t"', 2),
    "no second derivative": ('x = "t"\ny = "t^1.5"', 5),
    "the point is at rest": ('x = "t^2"\ny = "t^3"', 8),
    "not curved here": ('x = "t"\ny = "t^3"', 10),
}


def test_of_each_moment_as_much_is_said_as_there_is_and_why_there_is_no_more(
    tmp_path: Path,
) -> None:
    path = tmp_path / "p.toml"
    for reason, (law, count) in REASONS.items():
        path.write_text(f"[point]\n{law}\nt = 0\n", "utf-8")
        text = CliRunner().invoke(cli, ["solve", "--lang", "en", str(path)]).stdout
        moment = text[text.index("At the moment") :].splitlines()[1:]
        assert [one for one in REASONS if one in text] == [reason]
        said = [line for line in moment if line.startswith("     ") and " = " in line]
        assert len(said) == count, text
        path.write_text(f"[point]\n{law}\nt = {{ from = 0, to = 2, count = 5 }}\n", "utf-8")
        text = CliRunner().invoke(cli, ["solve", "--lang", "en", str(path)]).stdout
        told = [line for line in text.splitlines() if reason in line]
        due = 3 if reason.startswith("the formulas") else 1
        assert len(told) == due and "t = 0:" in told[0]


def test_the_interval_that_is_drawn_is_the_given_one_or_surrounds_the_moment() -> None:
    def course(keys: str) -> Any:
        return drawn_interval(loads(f'[point]\nx = "5*cos(t)"\ny = "5*sin(t)"\n{keys}\n', name="p"))

    assert course("t = 0\nshow = [0.5, 2]").interval == (0.5, 2)
    assert course("t = [0.5, 3]").interval == (0.5, 3)
    low, high = course("t = 4").interval
    assert 4 - low == pytest.approx(high - 4)
    assert 0.5 <= high - 4 <= 1.0  # v/a is 1 s
    for keys, own in (("t = [0, 1]", [0, 1]), ("t = [0, 0.37, 1]", [0, 0.37, 1])):
        marks = course(keys).marks.columns["t"]
        assert list(marks) == sorted(marks)
        assert {*own} <= {*marks} and 8 <= len(marks) <= 13
        shown = [float(marks[k]) for k in course(keys).shown]
        assert shown == own
    many = course("t = { from = 0, to = 1, count = 61 }")
    assert len(many.marks.columns["t"]) <= 25 and len(many.shown) == 1
    dense = many.path.columns["t"]
    assert (dense[0], dense[-1]) == (0.0, 1.0) and (dense[1:] > dense[:-1]).all()
    assert hypot(many.path.columns["x"][0] - 5, many.path.columns["y"][0]) < 1e-9


def test_a_function_ends_at_zero_also_where_rounding_leaves_a_little(tmp_path: Path) -> None:
    """0.1·3 − 0.3 is 5.6e-17: logarithms of it are undefined, roots are 0 without a velocity."""
    path = tmp_path / "p.toml"
    for formula, reason in (
        ("ln({})", "position undefined"),
        ("lg({})", "position undefined"),
        ("sqrt({})", "velocity undefined"),
        ("({})^0.5", "velocity undefined"),
        ("({})^1.5", "acceleration undefined"),
        ("abs({})", "velocity undefined"),
    ):
        text = f'[point]\nx = "{formula.format("0.1*t - 0.3")}"\ny = "t"\nt = 3\n'
        path.write_text(text, "utf-8")
        record = CliRunner().invoke(cli, ["solve", "--json", str(path)]).stdout
        (row,) = json.loads(record)["point"]
        assert row["reason"] == reason, formula
        assert (row["x"] is None) == (reason == "position undefined")
        assert row["x"] is None or row["x"] == 0.0
