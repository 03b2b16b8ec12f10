"""Equations, tables and protocols of trains: every cell agrees with its head."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import pytest
from cases import each, some
from click.testing import CliRunner
from doors import (
    ARROW_INSIDE,
    DRAFTING_PROFILES as PROFILES,
    Arc,
    ContactKind,
    Drawing,
    Fill,
    Pen,
    PlanRequest,
    SchemeData,
    Text,
    TrainMotion,
    answer,
    cli,
    draw,
    front,
    gears_construction_construct as construct,
    gears_reader_load as load,
    gears_sheet_drawings as drawings,
    get_language,
    read,
    results,
    solve_motion,
    text_equation_of as equation_of,
)
from msgspec.structs import replace
from trains import MAKERS, Made, bevel, mesh, solved, told
from worked import PROBLEMS

PLANAR = [maker for maker in MAKERS if maker is not bevel]
WITH_PICTURES = (*(f"gears-ex{k}" for k in range(1, 7)), "planetary-k10")
BOARD = PROFILES["board"]


def motion_of(name: str) -> TrainMotion:
    return solve_motion(load(PROBLEMS / f"gears/{name}.toml"))


def number(text: str) -> float:
    return float(text.replace("−", "-").replace(",", "."))


# Equations ----------------------------------------------------------------------------------------


@each("maker, seed", [(maker, seed) for maker in MAKERS for seed in range(some(40, 8))])
def test_equations_and_ratios_hold_for_the_speeds_of_the_textbook(
    maker: Callable[[random.Random], Made], seed: int, tmp_path: Path
) -> None:
    made = maker(random.Random(seed))
    motion = solved(tmp_path, made.text)

    def speed(found: re.Match[str]) -> str:
        label = found[1]
        value = made.speeds.get(motion.train.body_of[label])
        return f"F('{motion.speed(label) if value is None else value}')"

    for one in motion.train.meshes:
        equation, ratio = equation_of(motion, one)
        text = re.sub(r"n_\{([\w']+)\}", speed, equation).replace("·", "*").replace("−", "-")
        left, right = (eval(side, {"F": Fraction}) for side in text.split(" = "))
        assert left == right, equation
        symbol, _, shown = ratio.partition(" = ")
        below = motion.speed(one.second, one.carrier)
        if one.kind.value != "bevel" and below:
            due = motion.speed(one.first, one.carrier) / below
            assert Fraction(shown.replace("−", "-")) == due, ratio
        assert symbol.endswith(f"_{{{one.first}-{one.second}}}")


# The table of results -----------------------------------------------------------------------------


def rows_of(name: str, ruler: float) -> list[tuple[str, ...]]:
    motion = motion_of(name)
    picture = draw(motion)
    assert picture is not None
    drawn = construct(motion, picture)
    seen = read(drawn, replace(BOARD, ruler=ruler))
    return list(results(motion, drawn, seen, get_language("en")))


@each("name", WITH_PICTURES)
def test_the_difference_is_the_reading_less_the_exact_value_in_per_cent_of_the_exact_one(
    name: str,
) -> None:
    """With a ruler of 7 mm the differences are large: neither sign nor base is in doubt."""
    assert get_language("en").gears["sheet"].columns_results[2:] == ("Exact", "Read", "σ", "Δ, %")
    large = 0
    for _, _, exact, seen, _, off in rows_of(name, 7.0):
        if "—" in (seen, off):
            continue
        due = 100 * (number(seen) - number(exact)) / number(exact)
        assert number(off) == pytest.approx(due, abs=0.2)
        large += abs(due) > 5
    assert large or name == "planetary-k10"


@each("name", WITH_PICTURES)
def test_fraction_exact_value_and_reading_are_in_this_order(name: str) -> None:
    motion = motion_of(name)
    for head, fraction, exact, seen, sigma, _ in rows_of(name, 0.5):
        assert number(exact) == pytest.approx(float(Fraction(fraction.replace("−", "-"))), rel=1e-3)
        if seen != "—":
            assert abs(number(seen) - number(exact)) <= 3 * number(sigma) + 1e-9, head
        if head.startswith(("n_", "ω_")):
            label = re.search(r"\{(.+?)\}", head)
            assert label is not None
            in_file = motion.train.letter == head[0]
            factor = 1.0 if in_file else motion.train.factor
            assert number(exact) == pytest.approx(float(motion.speed(label[1])) * factor, rel=1e-3)
            assert head.endswith("rev/min" if head[0] == "n" else "1/s"), head


# The sheet ----------------------------------------------------------------------------------------


@dataclass
class Row:
    name: str
    cells: list[str]


def rows_on(drawing: Drawing, names: set[str]) -> Iterator[Row]:
    """Yield the rows of tables that begin with certain names."""
    runs = [item for item in drawing.items if isinstance(item, Text)]
    lines: dict[int, list[Text]] = {}
    for run in runs:
        lines.setdefault(round(run.at.imag * 2), []).append(run)
    for line in lines.values():
        line.sort(key=lambda run: run.at.real)
        for at, run in enumerate(line):
            if run.text in names:
                yield Row(run.text, [other.text for other in line[at + 1 : at + 4]])


@each("name", ["gears-ex1", "gears-ex2"])
def test_the_table_of_segments_has_heights_before_segments(name: str) -> None:
    motion = motion_of(name)
    picture = draw(motion)
    assert picture is not None
    drawn = construct(motion, picture)
    assert get_language("en").gears["sheet"].columns_segments[:3] == ("Segment", "y, mm", "Exact")
    (drawing,) = drawings(load(PROBLEMS / f"gears/{name}.toml"), PlanRequest())
    named = {f"{spot.base}{spot.letter}": spot for spot in drawn.spots}
    seen = list(rows_on(drawing, set(named)))
    assert seen
    for row in seen:
        spot = named[row.name]
        ratio = spot.height / spot.speed if spot.speed else None
        height, exact = map(number, row.cells[:2])
        if ratio is None:
            assert exact == 0.0
        elif spot.contact.kind is ContactKind.PITCH:
            # From the wheels alone: a pitch point is a radius away from the axis of its first one.
            first = spot.contact.of.split("-")[0]
            sizes, heights = motion.axes.sizes, motion.axes.heights
            mm = float(motion.train.unit_m * 1000) * 0.001 / float(problem_mu(drawing))
            centre = float(heights[motion.train.body_of[first]])
            assert abs(height - centre * mm) == pytest.approx(float(sizes[first]) * mm, abs=0.011)


def problem_mu(drawing: Drawing) -> float:
    (view,) = (view for view in drawing.views[:1])
    return view.per_mm


@pytest.mark.parametrize("count", [1, 3, 4])
def test_the_view_along_the_axes_has_all_planet_gears_of_the_file(
    count: int, tmp_path: Path
) -> None:
    text = (PROBLEMS / "gears/planetary-k10.toml").read_text("utf-8")
    (tmp_path / "k.toml").write_text(text.replace("[gears]", f"[gears]\nsatellites = {count}"))
    (sheet,) = drawings(load(tmp_path / "k.toml"), PlanRequest())
    mm = 0.02 / problem_mu(sheet)
    rims = [item for item in sheet.items if isinstance(item, Arc) and item.pen is Pen.AXIS]
    assert sum(abs(arc.radius - mm) < 1e-6 for arc in rims) == count


@each("maker, seed", [(maker, seed) for maker in PLANAR for seed in range(some(20, 4))])
def test_arrows_on_the_view_along_the_axes_turn_as_the_wheels_do(
    maker: Callable[[random.Random], Made], seed: int, tmp_path: Path
) -> None:
    made = maker(random.Random(300 + seed))
    motion = solved(tmp_path, made.text)
    items = front(SchemeData(motion, 1.0), 5.0, {}).items
    senses = [item for item in items if getattr(item, "tag", "") == "sense"]
    seen = set()
    for arc, head in zip(senses[::2], senses[1::2], strict=True):
        assert isinstance(arc, Arc)
        assert isinstance(head, Fill)
        tip, notch = head.points[0], head.points[2]
        turn = ((tip - arc.centre).conjugate() * (tip - notch)).imag
        for label, size in motion.axes.sizes.items():
            body = motion.train.body_of[label]
            radius, height = float(size) - ARROW_INSIDE, float(motion.axes.heights[body])
            if abs(radius - arc.radius) < 1e-6 and abs(height - arc.centre.imag) < 1e-6:
                speeds = {made.speeds.get(body, motion.speeds[body])}
                if len(speeds) == 1 and sum(s == size for s in motion.axes.sizes.values()) == 1:
                    assert turn * float(*speeds) > 0, (made.text, label)
                    seen.add(label)
    assert seen or len(set(motion.axes.sizes.values())) < len(motion.axes.sizes)


# Terminal and protocol ----------------------------------------------------------------------------


def run(*args: str) -> str:
    done = CliRunner().invoke(cli, [*args, "--lang", "en"])
    assert done.exit_code == 0, done.output
    return done.stdout


@each("name", ["gears-ex2", "gears-ex6", "planetary-k10"])
def test_the_excess_of_printed_values_over_exact_ones_is_in_per_cent(name: str) -> None:
    text = run("solve", str(PROBLEMS / f"gears/{name}.toml"))
    table = text.partition("Printed in the source\n")[2]
    assert re.match(r"quantity +printed +exact +difference, %\n", table)
    seen = 0
    for line in table.splitlines()[2:]:
        cells = line.split()
        if len(cells) != 4 or not re.fullmatch(r"−?[\d.]+", cells[3]):
            continue
        printed, exact, off = map(number, cells[1:])
        assert off == pytest.approx(100 * (printed - exact) / exact, rel=2e-3, abs=0.05)
        seen += abs(off) > 2
    assert seen


FOUND = re.compile(r"(\S+) = ([\dμπ(\[].*?) = (\S+)(?: (\S+))? \(exact (\S+), σ = (\S+)\)")


@each("name", WITH_PICTURES)
def test_formulas_of_the_protocol_give_their_results_from_the_readings(
    name: str, tmp_path: Path
) -> None:
    text = (PROBLEMS / f"gears/{name}.toml").read_text("utf-8")
    asked = motion_of(name)
    label = next(body for body in asked.train.bodies if body not in asked.train.fixed)
    other = "omega" if asked.train.unit == "n" else "n"
    text = text.replace('ask = ["W"', f'ask = ["W", "{other}_{label}"')
    path = tmp_path / f"{name}.toml"
    path.write_text(text, encoding="utf-8")
    said = run("protocol", str(path))
    said = re.sub(r"\s*\n +", "\n", said)
    said = re.sub(r"\n(?!\(|n|ω|U|\d)", " ", said)
    lengths = {
        found[1]: number(found[2]) for found in re.finditer(r"\((o[^()]*)\) = (−?[\d.]+) mm", said)
    }
    scale = re.search(r"(μ_?\S) = (\S+) (rev/min|1/s|s⁻¹)/mm", said)
    assert scale is not None
    count, letters = 0, set()
    for symbol, formula, value, unit, exact, sigma in FOUND.findall(said):
        shown = re.sub(r"\((o[^()]*)\)", lambda m: f"({lengths[m[1]]})", formula)
        shown = shown.replace(scale[1], str(number(scale[2]))).replace("π", str(math.pi))
        shown = shown.translate(str.maketrans("·−[]", "*-()"))
        room = max(number(sigma), 0.02 * abs(number(value)))
        assert eval(shown) == pytest.approx(number(value), abs=room), (symbol, formula)
        assert abs(number(value) - number(exact)) <= 3 * number(sigma) + 0.02 * abs(number(exact))
        if not symbol.startswith("U"):
            assert unit == ("rev/min" if symbol[0] == "n" else "1/s"), symbol
        letters.add(symbol[0])
        count += 1
    assert count >= 3
    assert {"n", "ω"} <= letters  # required in both units


def test_a_speed_requested_in_both_units_is_printed_in_each(tmp_path: Path) -> None:
    wheels = told({"1": 20, "2": 40}, [mesh("1", "2")], "n = { 1 = 300 }")
    motion = solved(tmp_path, wheels)
    assert answer(motion, "omega_1").value == pytest.approx(10 * math.pi)
    assert (answer(motion, "omega_1").unit, answer(motion, "n_1").unit) == ("1/s", "1/min")
    assert answer(motion, "n_2").value == -150
