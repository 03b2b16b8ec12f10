"""Texts, tables and hodographs of a moving point: numbers in formulas, units, titles."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    DRAFTING_PROFILES as PROFILES,
    LEGEND,
    MOTION_COLUMNS as COLUMNS,
    PLANVIEW_POLE as POLE,
    POLAR,
    ROLLED,
    WORDING_LANGUAGES as LANGUAGES,
    Arc,
    Disc,
    Drawing,
    Fill,
    Motion,
    Pen,
    PlanRequest,
    PointProblem,
    Stroke,
    Text,
    View,
    cli,
    drawn_interval,
    get_language,
    hodograph_picture,
    inlined,
    moment,
    move,
    moving_construction_construct as construct,
    moving_given_facts,
    moving_sheet_drawings as drawings,
    plain_text,
    reader_loads as loads,
    sheet_sheet_scales as sheet_scales,
    trajectory_picture,
)
from msgspec.structs import replace

BOARD = PROFILES["board"]
LAWS = {
    "plane": 'x = "3*t*exp(t/2)"\ny = "4*t/(t^2 + 1)"',
    "polar": 'r = "1 + t^2"\nphi = "t^2 - 2*t"',
    "circle": 's = "t^3 - 2*t"\nradius = 2',
    "rolling": 'wheel = { radius = 0.5, r = 0.3, angle = 20 }\nphi = "t - 2*t^2"',
    "satellite": 'wheel = { radius = 0.2, r = 0.3, arm = 0.5 }\ntheta = "t^2"\nphi = "5*t"',
}


def of(law: str, t: str = "t = 0.9") -> Any:
    return loads(f"[point]\n{law}\n{t}\n", name="p")


def number(text: str) -> float:
    return float(text.replace("−", "-").replace(",", "."))


# Moments ------------------------------------------------------------------------------------------


def value_of(formula: str, names: dict[str, float] | None = None) -> float:
    """Return the value of a formula of numbers or of letters."""
    formula = formula.replace("a^{n}", "a_{n}")  # a letter, no power
    text = re.sub(r"\^\{([^{}]+)\}", r"**\1", inlined(formula)).replace("·", "*").replace("−", "-")
    text = re.sub(r"√(\([^√]*\))", r"(\1)**0.5", text)
    text = re.sub(r"\|([^|]*)\|", r"abs(\1)", text)
    text = text.replace("10**", "10.0**")
    for name, value in sorted((names or {}).items(), key=lambda pair: -len(pair[0])):
        text = re.sub(rf"(?<![\w.}}]){re.escape(name)}(?![\w{{])", f"({value!r})", text)
    return float(eval(text))


def moment_texts(problem: PointProblem, motion: Motion) -> list[str]:
    return [node.text for node in moment(problem, motion, 0, get_language("en"))]


@each("name", LAWS)
def test_formulas_of_a_moment_give_their_results_in_letters_and_in_numbers(name: str) -> None:
    problem = of(LAWS[name])
    motion = move(problem)
    value = {key: float(column[0]) for key, column in motion.columns.items()}
    letters = {"v": value["v"], "v_{x}": value["vx"], "v_{y}": value["vy"]}
    letters |= {"a": value["a"], "a_{x}": value["ax"], "a_{y}": value["ay"]}
    letters |= {"a_{n}": value["a_normal"]}
    seen = set()
    for line in moment_texts(problem, motion):
        symbol, *middle, last = line.split(" = ")
        shown = value_of(last.split(" ")[0])
        if len(middle) == 2:
            assert value_of(middle[1]) == pytest.approx(shown, rel=2e-3), line
            if "PM" not in middle[0]:
                assert value_of(middle[0], letters) == pytest.approx(shown, rel=2e-4), line
            seen.add(symbol)
    assert {"v", "a", "a^{τ}", "a^{n}", "ρ"} <= seen


def test_the_components_are_those_that_differences_give() -> None:
    """Central differences of the coordinates, apart from the formulas of the program."""
    problem, h = of(LAWS["plane"]), 1e-4
    x = [3 * t * np.exp(t / 2) for t in (0.9 - h, 0.9, 0.9 + h)]
    y = [4 * t / (t**2 + 1) for t in (0.9 - h, 0.9, 0.9 + h)]
    vx, vy = (x[2] - x[0]) / (2 * h), (y[2] - y[0]) / (2 * h)
    ax, ay = (x[2] - 2 * x[1] + x[0]) / h**2, (y[2] - 2 * y[1] + y[0]) / h**2
    told = {}
    for line in moment_texts(problem, move(problem)):
        told[line.split(" = ")[0]] = value_of(line.split(" = ")[-1].split(" ")[0])
    due = {"v_{x}": vx, "v_{y}": vy, "a_{x}": ax, "a_{y}": ay}
    due |= {"v": np.hypot(vx, vy), "a^{τ}": (vx * ax + vy * ay) / np.hypot(vx, vy)}
    due |= {"a^{n}": abs(vx * ay - vy * ax) / np.hypot(vx, vy)}
    for symbol, value in due.items():
        assert told[symbol] == pytest.approx(value, rel=2e-4), symbol


# Units --------------------------------------------------------------------------------------------

POWERS = {"m": (1, 0), "m/s": (1, -1), "m/s²": (1, -2), "s": (0, 1), "rad": (0, 0),
          "1/s": (0, -1), "1/s²": (0, -2)}  # fmt: skip


@each("name, long, quick", [
    ("polar", 'r = "2*(1 + t^2)"\nphi = "t^2 - 2*t"',
     'r = "1 + (2*t)^2"\nphi = "(2*t)^2 - 2*(2*t)"'),
    ("satellite", 'wheel = { radius = 0.4, r = 0.6, arm = 1 }\ntheta = "t^2"\nphi = "5*t + t^3"',
     'wheel = { radius = 0.2, r = 0.3, arm = 0.5 }\ntheta = "(2*t)^2"\nphi = "5*2*t + (2*t)^3"'),
])  # fmt: skip
def test_every_column_has_the_unit_that_it_scales_by(name: str, long: str, quick: str) -> None:
    """Twice as long, a column grows with the metre; in half the time with the second."""
    law = LAWS[name].replace('"5*t"', '"5*t + t^3"')
    base, wide = move(of(law)).columns, move(of(long)).columns
    fast = move(of(quick, "t = 0.45")).columns
    names = [column for column in (*COLUMNS, *POLAR, *ROLLED) if column in base]
    assert {"v", "a_normal", "rho"} <= set(names)
    for column in names:
        metre, second = POWERS[LEGEND[column].unit]
        value = float(base[column][0])
        assert float(wide[column][0]) == pytest.approx(value * 2.0**metre, rel=1e-9), column
        assert float(fast[column][0]) == pytest.approx(value * 0.5**second, rel=1e-9), column


def run(folder: Path, command: str, text: str) -> str:
    path = folder / "p.toml"
    path.write_text(text, encoding="utf-8")
    done = CliRunner().invoke(cli, [command, str(path), "--lang", "en"])
    assert done.exit_code == 0, done.output
    return done.stdout


def test_a_table_of_moments_has_each_number_under_its_head(tmp_path: Path) -> None:
    text = f"[point]\n{LAWS['polar']}\nt = {{ from = 0.1, to = 0.9, count = 5 }}\n"
    told, motion = run(tmp_path, "solve", text), move(loads(text, name="p"))
    own = {"t": "t", "x": "x, m", "y": "y, m", "v_x": "vx", "v_y": "vy", "a_x": "ax",
           "a_y": "ay", "a^τ": "a_tangential",
           "aⁿ": "a_normal", "ρ": "rho", "v_r": "v_r", "v_φ": "v_phi", "a_r": "a_r",
           "a_φ": "a_phi", "φ": "phi"}  # fmt: skip
    lines, seen = told.splitlines(), set()
    for at, line in enumerate(lines):
        if not re.match(r" *t\b", line):
            continue
        heads = re.split(r" {2,}", line.strip())
        for k, row in enumerate(lines[at + 2 : at + 7]):
            for head, cell in zip(heads, row.split(), strict=True):
                symbol, _, unit = head.partition(", ")
                key = own.get(symbol, symbol).partition(",")[0]
                exact = float(motion.columns[key][k])
                assert number(cell) == pytest.approx(exact, rel=5e-3, abs=2e-3), (head, row)
                assert not unit or unit.replace("s⁻¹", "1/s") == LEGEND[key].unit, head
                seen.add(symbol)
    assert {"v_x", "a^τ", "ρ", "v_φ", "a_r"} <= seen


def test_a_printed_value_has_its_excess_over_the_exact_one(tmp_path: Path) -> None:
    law = '[point]\nx = "3*t"\ny = "4*t"\nt = 1\n[published]\n'
    for printed, off in ((5.5, 0.5), (4.8, -0.2)):
        told = run(tmp_path, "solve", f'{law}v = {{ value = {printed}, what = "v" }}\n')
        heads, _, row = told[told.index("Printed") :].splitlines()[:3]
        assert heads.split() == ["Printed", "Quantity", "Source", "Exact", "Difference"]
        assert [number(cell) for cell in row.split()[2:]] == pytest.approx([printed, 5.0, off])


def test_the_result_of_the_chords_has_its_difference_from_the_exact_one(tmp_path: Path) -> None:
    told = run(tmp_path, "protocol", f"[point]\n{LAWS['plane']}\nt = 0.5\n")
    assert get_language("en").point["chords"] == (
        "№", "t, s", "a exact, m/s²", "a read", "σ", "difference",
    )  # fmt: skip
    rows = re.findall(r"^\d+ +(\S+) +(\S+) +(\S+) +(\S+) +(\S+)$", told, re.M)
    assert len(rows) > 3
    signs = set()
    for time, exact, seen, sigma, off in rows:
        t = number(time)
        assert number(off) == pytest.approx(
            number(seen) - number(exact), abs=0.05 * abs(number(exact))
        )
        assert number(off) * (number(seen) - number(exact)) >= 0 or abs(number(off)) < 0.02
        due = move(of(LAWS["plane"], f"t = {t!r}")).columns["a"][0]
        assert number(exact) == pytest.approx(float(due), rel=2e-3)
        assert 0 < number(sigma) < number(exact)
        signs.add(number(off) > 0)
    assert signs


# Hodographs ---------------------------------------------------------------------------------------


def within(drawing: Drawing, view: View) -> list[Any]:
    """Return the items that begin within a view."""
    left, low, right, top = view.box
    found = []
    for item in drawing.items:
        at = item.points[0] if isinstance(item, Stroke | Fill) else None
        at = getattr(item, "at", getattr(item, "centre", None)) if at is None else at
        if at is not None and left <= at.real <= right and low <= at.imag <= top:
            found.append(item)
    return found


@each("lang, name", [*zip(LANGUAGES, ("plane", "polar"), strict=True), ("en", "satellite")])
def test_a_hodograph_is_titled_by_the_vector_that_is_drawn_on_it(lang: str, name: str) -> None:
    problem = loads(f'[sheet]\nlang = "{lang}"\n[point]\n{LAWS[name]}\nt = 0.9\n', name="p")
    (drawing,) = drawings(problem, PlanRequest())
    words, motion = get_language(lang).point, move(problem)
    seen = []
    for view in drawing.views[1:]:
        items = within(drawing, view)
        said = " ".join(item.text for item in items if isinstance(item, Text))
        plan = next(p for p, title in (("v", words.hodograph_v), ("a", words.hodograph_a))
                    if title in said)  # fmt: skip
        seen.append(plan)
        assert view.scale == f"μ_{{{plan}}}"
        (span,) = view.spans
        whole = complex(*(float(motion.columns[f"{plan}{c}"][0]) for c in "xy"))
        assert (span.end - span.start) * view.per_mm == pytest.approx(whole, rel=1e-9)
        (pole,) = (i.centre for i in items if isinstance(i, Disc) and i.tag == POLE)
        tips = [i.points[0] - pole for i in items if isinstance(i, Fill) and i.tag == "absolute"]
        assert [tip * view.per_mm for tip in tips] == pytest.approx([whole], rel=1e-6)
        letters = {i.text for i in items if isinstance(i, Text)}
        assert {"v": "p", "a": "π"}[plan] in letters
    assert seen == ["v", "a"]


@each("name", LAWS)
def test_the_components_on_a_hodograph_add_up_to_its_vector(name: str) -> None:
    problem = of(LAWS[name])
    course = drawn_interval(problem)
    scales = sheet_scales(problem, course, BOARD)
    (k,) = course.shown
    built = construct(problem, course.marks, k, scales)
    motion = move(problem).columns
    for plan in "va":
        picture = hodograph_picture(course, plan, built, scales, letter_height=5.0)
        per_mm = scales[plan].per_mm
        whole = complex(float(motion[f"{plan}x"][0]), float(motion[f"{plan}y"][0])) / per_mm
        thick = [i for i in picture.items if isinstance(i, Stroke) and i.tag == "absolute"]
        thin = [i for i in picture.items if isinstance(i, Stroke) and i.tag == "normal"]
        assert [stroke.pen for stroke in thick] == [Pen.RESULTANT] or abs(whole) < 8.0
        assert thick[0].points[0] == pytest.approx(0j, abs=1e-9)
        assert all(stroke.pen in (Pen.COMPONENT, Pen.THIN) for stroke in thin)
        tips = [i.points[0] for i in picture.items if isinstance(i, Fill) and i.tag == "normal"]
        starts = [stroke.points[0] for stroke in thin]
        if name in ("plane", "polar"):
            assert any(abs(tip - whole) < 1e-6 for tip in tips)
            assert any(abs(start) < 1e-9 for start in starts)
        for start in starts:  # each begins at the pole or where another ends
            nearest = min((abs(start - tip) for tip in tips), default=1e9)
            assert min(abs(start), nearest) < 0.7  # shorter ones are left out
        if name == "plane":
            corner = complex(whole.real, 0.0)
            assert any(abs(tip - corner) < 1e-6 for tip in tips)


def test_the_chord_joins_the_instants_before_and_after_the_calculated_one() -> None:
    """In uniform circular motion it is perpendicular to the velocity, which bisects it."""
    problem = of('x = "2*cos(t)"\ny = "2*sin(t)"')
    course = drawn_interval(problem)
    scales = sheet_scales(problem, course, BOARD)
    picture = hodograph_picture(course, "v", None, scales, letter_height=5.0)
    (chord,) = (i for i in picture.items if isinstance(i, Stroke) and i.tag == "chord")
    velocity = 1j * np.exp(0.9j)
    across = (chord.points[1] - chord.points[0]) / velocity
    middle = sum(chord.points) / 2 / velocity
    assert abs(across.real) < 1e-6 * abs(across)
    assert abs(middle.imag) < 1e-6 * abs(middle)
    assert middle.real > 0 > -across.imag


@each("law, centre", [
    ('x = "2*cos(t)"\ny = "2*sin(t)"', 0j),
    ('x = "3 + 2*cos(t)"\ny = "1 - 2*sin(t)"', 3 + 1j),
])  # fmt: skip
def test_the_circle_of_curvature_of_a_circle_is_the_circle(law: str, centre: complex) -> None:
    problem = of(law)
    course = drawn_interval(problem)
    scales = dict(sheet_scales(problem, course, BOARD))
    per_mm = 0.1
    scales["l"] = replace(scales["l"], per_mm=per_mm)
    say = get_language("en").notation
    items = trajectory_picture(problem, course, scales, letter_height=5.0, notation=say).items
    (circle,) = (i for i in items if isinstance(i, Arc) and i.tag == "circle of curvature")
    (middle,) = (i for i in items if isinstance(i, Disc) and i.tag == "centre of curvature")
    assert circle.radius == pytest.approx(2 / per_mm)
    assert circle.centre == pytest.approx(centre / per_mm, abs=1e-6)
    assert middle.centre == pytest.approx(centre / per_mm, abs=1e-6)


@pytest.mark.parametrize(
    ("law", "shown"),
    [
        ("t**2 + 1", "t² + 1"),
        ("2*t^(1/2)", "2·t^(1/2)"),
        ("sqrt(t + 1)*cos(pi*t)", "√(t + 1)·cos(π·t)"),
    ],
)
def test_the_given_law_is_printed_as_in_a_textbook(law: str, shown: str) -> None:
    (fact, *_) = moving_given_facts(of(f'x = "{law}"\ny = "t"'), get_language("en"))
    assert plain_text(fact.text) == f"x = {shown} (m)"
    assert fact.data == {"point.x": law}
