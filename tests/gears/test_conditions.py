"""Printed conditions of trains: every sum, quotient and inequality against the teeth."""

from __future__ import annotations

import math
import random
import re
from fractions import Fraction
from math import gcd
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from cases import each, some
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    Condition,
    MeshKind,
    TrainMotion,
    _mesh_properly,
    conditions,
    gears_reader_load as load,
    get_language,
    judgement,
    sentence,
    solve_motion,
)
from trains import closed, mesh, planetary, solved, told
from worked import PROBLEMS

FILES = sorted((PROBLEMS / "gears").glob("*.toml"))
PER_M = {"m": Fraction(1), "cm": Fraction(100), "mm": Fraction(1000)}
TERM = re.compile(r"([−+]?) ?[zr]_([\w']+)")


def found(motion: TrainMotion, name: str) -> list[Condition]:
    return [one for one in conditions(motion) if one.name == name]


def sums(condition: Condition) -> list[list[tuple[int, str]]]:
    """Return the sums of a coaxiality as its sentence has them: signs and wheels."""
    (_, told) = sentence(condition, get_language("en")).split(": ", 1)
    return [
        [(-1 if sign == "−" else 1, wheel) for sign, wheel in TERM.findall(side)]
        for side in told.split(" = ")[:-1]
    ]


def assert_sums_are_ways(motion: TrainMotion, condition: Condition) -> None:
    """Each sum goes from axis to axis by meshes, and all are as high as the axis lies.

    Axes of an external mesh are the sum of the sizes apart, of an internal one their difference.
    The value of radii is in the unit of their file. The radius of a carrier is a way by itself.
    """
    train = motion.train
    per = Fraction(1) if train.toothed else PER_M[train.length_unit]
    sizes = {label: size * per for label, size in {**motion.axes.sizes, **train.arms}.items()}
    value = Fraction(condition.facts["value"])
    kinds = {frozenset((m.first, m.second)): m.kind.value for m in train.meshes}
    ways = sums(condition)
    assert len(ways) == 2
    assert ways[0] != ways[1]
    for way in ways:
        assert sum(sign * sizes[wheel] for sign, wheel in way) == value > 0, (way, value)
        if way == ways[-1] and [label for _, label in way] in [[arm] for arm in train.arms]:
            continue
        for (one, first), (other, second) in zip(way[::2], way[1::2], strict=True):
            kind = kinds[frozenset((first, second))]
            assert one * other == (1 if kind == "external" else -1), (way, kind)
            if kind == "internal":
                assert one * (sizes[first] - sizes[second]) > 0 or len(way) > 2


@each("path", FILES)
def test_coaxiality_of_the_worked_examples_adds_up(path: Path) -> None:
    motion = solve_motion(load(path))
    for condition in found(motion, "coaxiality"):
        assert_sums_are_ways(motion, condition)


@each("seed", range(some(60, 12)))
def test_coaxiality_of_random_sets_adds_up(seed: int, tmp_path: Path) -> None:
    for maker in (planetary, closed):
        motion = solved(tmp_path, maker(random.Random(seed)).text)
        assert found(motion, "coaxiality")
        for condition in found(motion, "coaxiality"):
            assert_sums_are_ways(motion, condition)


def test_coaxiality_names_the_wheels_of_both_ways_and_their_axis(tmp_path: Path) -> None:
    for name, axis, ways in (
        ("gears-ex1", "2", [{"1", "2"}, {"2'", "3"}]),
        ("gears-ex1", "4", [{"3'", "4"}, {"4", "5"}]),
        ("gears-ex2", "4", [{"5", "4"}, {"3", "4"}]),
        ("gears-ex4", "3", [{"1", "2", "3"}, {"3'", "4"}]),
    ):
        motion = solve_motion(load(PROBLEMS / f"gears/{name}.toml"))
        (one,) = (c for c in found(motion, "coaxiality") if c.facts["axis"] == axis)
        told = sorted(sorted({wheel for _, wheel in way}) for way in sums(one))
        assert told == sorted(map(sorted, ways))


def test_coaxiality_of_an_axis_below_the_main_one_is_printed_as_a_distance(tmp_path: Path) -> None:
    """Wheels 1, 1' drive 2 = H and 5' from beside: 30 + 20 = 22 + 28, no sum is negative."""
    wheels = {"1": 30, "2": 20, "5": 20, "4": 30, "3": 80, "1'": 22, "5'": 28}
    meshes = [mesh("1", "2"), mesh("5", "4", carrier="H"), mesh("4", "3", "internal", "H")]
    text = told(wheels, [*meshes, mesh("1'", "5'")], 'bodies = [["H", "2"]]\nn = { 1 = 50 }')
    motion = solved(tmp_path, text)
    assert motion.axes.heights["1"] < 0
    (beside,) = (c for c in found(motion, "coaxiality") if c.facts["axis"] == "1")
    assert beside.facts["value"] == "50"
    assert_sums_are_ways(motion, beside)
    assert {frozenset(way) for way in sums(beside)} == {
        frozenset({(1, "1"), (1, "2")}), frozenset({(1, "1'"), (1, "5'")})
    }  # fmt: skip


# Sets of planet gears -----------------------------------------------------------------------------

SETS = (
    ({"1": 20, "2": 40, "3": 100}, "internal"),
    ({"1": 18, "2": 36, "3": 90}, "internal"),
    ({"1": 40, "2": 20, "3": 80}, "internal"),
    ({"1": 30, "2": 24, "2'": 18, "3": 72}, "internal"),
    ({"1": 24, "2": 30, "2'": 42, "3": 96}, "internal"),
    ({"1": 30, "2": 40, "2'": 28, "3": 42}, "external"),
)


def set_of(folder: Path, wheels: dict[str, int], kind: str, count: int) -> TrainMotion:
    rim = "2'" if "2'" in wheels else "2"
    meshes = [mesh("1", "2", carrier="H"), mesh(rim, "3", kind, "H")]
    rest = f'satellites = {count}\nfixed = ["3"]\nn = {{ 1 = 1 }}'
    return solved(folder, told(wheels, meshes, rest))


def whole_of(wheels: dict[str, int], kind: str) -> int:
    """Return the textbook's number that k divides: z_1 + z_3, reduced for a double planet gear."""
    one, two, three = (wheels[label] for label in "123")
    rim = wheels.get("2'", two)
    sign = 1 if kind == "internal" else -1
    return abs(one * rim + sign * two * three) // gcd(two, rim)


def is_apart(wheels: dict[str, int], count: int) -> bool:
    """Return whether the tip circles of two neighbouring planet gears do not meet, m = 1."""
    centres = [complex(wheels["1"] + wheels["2"]) / 2 * 1j ** (4 * k / count) for k in (0, 1)]
    tip = (max(wheels["2"], wheels.get("2'", 0)) + 2) / 2
    return count == 1 or abs(centres[0] - centres[1]) > 2 * tip


@each("wheels, kind", SETS)
def test_assembly_and_neighbourhood_are_printed_with_true_numbers(
    wheels: dict[str, int], kind: str, tmp_path: Path
) -> None:
    whole = whole_of(wheels, kind)
    held = [k for k in range(1, 25) if whole % k == 0 and is_apart(wheels, k)]
    for count in range(1, 9):
        motion = set_of(tmp_path, wheels, kind, count)
        (assembly,) = found(motion, "assembly")
        (apart,) = found(motion, "neighbourhood")
        (most,) = found(motion, "satellites")
        assert assembly.is_satisfied == (whole % count == 0)
        assert apart.is_satisfied == is_apart(wheels, count)
        for lang in LANGUAGES:
            words = get_language(lang)
            said = sentence(assembly, words).replace(",", ".").replace(". k", ", k")
            numbers = re.search(r"(\d+)/(\d+) = ([\d.]+)", said)
            assert numbers is not None, said
            assert (int(numbers[1]), int(numbers[2])) == (whole, count)
            assert float(numbers[3]) == pytest.approx(whole / count, rel=1e-5)
            said = sentence(apart, words).replace(",", ".")
            left, right = map(float, re.findall(r"\d\.\d{4}", said))
            rim = max(wheels["2"], wheels.get("2'", 0))
            assert left == pytest.approx(math.sin(math.pi / count), abs=6e-5)
            assert right == pytest.approx((rim + 2) / (wheels["1"] + wheels["2"]), abs=6e-5)
            assert re.search(rf"k = {count}\b", said)
            if count > 1:  # the printed inequality is the one that is checked
                assert (left > right) == apart.is_satisfied
            assert re.search(rf" {held[-1]}\b", sentence(most, words))


def test_the_inequality_requires_a_greater_first_number(tmp_path: Path) -> None:
    (apart,) = found(set_of(tmp_path, *SETS[0], 3), "neighbourhood")
    english, russian = (sentence(apart, get_language(lang)) for lang in ("en", "ru"))
    assert re.search(r"sin\(π/k\) = 0\.8660 must be greater than .* = 0\.7000$", english)
    assert re.search(r"sin\(π/k\) = 0,8660 .*больше .* = 0,7000$", russian)


@each("z, least", [(12, 17), (16, 17)])
def test_undercutting_names_the_teeth_there_are_and_those_that_are_needed(
    z: int, least: int, tmp_path: Path
) -> None:
    motion = solved(tmp_path, told({"1": z, "2": 40}, [mesh("1", "2")], "n = { 1 = 1 }"))
    (one,) = found(motion, "undercutting")
    said = f"No undercutting: z_1 = {z}, at least {least} needed"
    assert sentence(one, get_language("en")) == said
    assert judgement(one, get_language("en")) == f"{said} – not met"
    motion = solved(tmp_path, told({"1": 17, "2": 40}, [mesh("1", "2")], "n = { 1 = 1 }"))
    assert not found(motion, "undercutting")


def test_interference_is_judged_by_the_printed_numbers(tmp_path: Path) -> None:
    """z_3 - z_2, the ring first: from 8 on where the wheel has many teeth."""
    for ring, holds in ((47, False), (48, True), (60, True)):
        text = told({"1": 40, "3": ring}, [mesh("1", "3", "internal")], "n = { 1 = 1 }")
        (one,) = found(solved(tmp_path, text), "interference")
        said = sentence(one, get_language("en"))
        numbers = re.search(r"z_3 − z_1 = (\d+), at least (\d+) needed", said)
        assert numbers is not None, said
        assert int(numbers[1]) == ring - 40
        assert one.is_satisfied == holds == (int(numbers[1]) >= int(numbers[2]))


def ring_apart(z: tuple[int, int], x: tuple[float, float]) -> tuple[float, float]:
    """Return how far the ring's tips stay from N, and the tips from each other, by triangles.

    In modules and radians, in 30 digits; -inf where there are no such teeth.
    """
    with mpmath.workdps(30):
        alpha, (one, two), (x_1, x_2) = mpmath.radians(20), z, map(mpmath.mpf, x)

        def inv(angle: Any) -> Any:
            return mpmath.tan(angle) - angle

        lag = inv(alpha) + 2 * (x_2 - x_1) * mpmath.tan(alpha) / (two - one)
        if lag <= 0:
            return -math.inf, -math.inf
        working = mpmath.findroot(lambda t: inv(t) - lag, mpmath.mpf("0.4"))
        apart = mpmath.mpf(two - one) / 2 * mpmath.cos(alpha) / mpmath.cos(working)
        base = [teeth * mpmath.cos(alpha) / 2 for teeth in z]
        tip = [two / mpmath.mpf(2) + x_2 + 1 - apart, apart + one / mpmath.mpf(2) + x_1 - 1]
        if tip[0] < base[0] or tip[1] < base[1]:
            return -math.inf, -math.inf
        short = mpmath.sqrt(tip[1] ** 2 - base[1] ** 2) - apart * mpmath.sin(working)
        far = [mpmath.acos((tip[1]**2 - tip[0]**2 - apart**2) / (2 * tip[0] * apart)),
               mpmath.acos((apart**2 + tip[1]**2 - tip[0]**2) / (2 * tip[1] * apart))]  # fmt: skip
        turn = [teeth * (inv(mpmath.acos(b / t)) + angle)
                for teeth, b, t, angle in zip(z, base, tip, far, strict=True)]  # fmt: skip
        return float(short), float((turn[0] - turn[1] + (two - one) * lag) / one)


def test_inner_meshes_are_judged_by_the_reach_of_the_rings_tips(tmp_path: Path) -> None:
    """For 40 pairs, half of them without shifts, a train and a choice of teeth agree."""
    draw, judged = random.Random(46), set()
    for number in range(some(40, few=16)):
        z = draw.randint(12, 45)
        ring = z + draw.choice((draw.randint(5, 14), draw.randint(15, 150)))
        x = (0.0, 0.0) if number % 2 else (draw.uniform(-0.2, 0.8), draw.uniform(-0.2, 0.8))
        wheels = f"1 = {{ z = {z}, x = {x[0]} }}, 3 = {{ z = {ring}, x = {x[1]} }}"
        text = (
            f"wheels = {{ {wheels} }}\nmeshes = [ {mesh('1', '3', 'internal')} ]\nn = {{ 1 = 1 }}"
        )
        short, tips = ring_apart((z, ring), x)
        (one,) = found(solved(tmp_path, text), "interference")
        if number % 2:
            assert one.is_satisfied == (short >= 0 and ring - z >= 8), (z, ring)
            assert (
                bool(_mesh_properly(MeshKind.INTERNAL, np.array([z]), np.array([ring])))
                == one.is_satisfied
            )
        else:
            assert one.is_satisfied == (short >= 0 and tips >= 0), (z, ring, x)
            shown = (one.facts[x].replace("−", "-").replace("∞", "inf") for x in ("beyond", "tips"))
            assert [*map(float, shown)] == pytest.approx([short, tips], abs=6e-4)
        judged.add((number % 2, one.is_satisfied))
    assert len(judged) == 4


@each("wheel, ring, value", [(16, 74, "−0.584"), (17, 64, "−0.502"), (12, 250, None)])
def test_no_standard_ring_fits_a_wheel_of_few_teeth(
    wheel: int, ring: int, value: str | None, tmp_path: Path
) -> None:
    """√(r_a² − r_b²) − a_w·sin α of the ring is negative for every ring."""
    text = told({"1": wheel, "3": ring}, [mesh("1", "3", "internal")], "n = { 1 = 1 }")
    (one,) = found(solved(tmp_path, text), "interference")
    assert not one.is_satisfied
    said = judgement(one, get_language("en"))
    assert f"z_1 = {wheel}" in said
    assert said.endswith("not met")
    assert value is None or f"{value}·m" in said
