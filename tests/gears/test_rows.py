"""Modules of the rows, radii of carriers, and a planetary stage before or behind a pair."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    GearProblem,
    ProblemError,
    answer,
    cli,
    compare,
    conditions,
    get_language,
    sentence,
    train_facts,
)
from trains import mesh, solved, told

WHEELS = {"1": 20, "2": 40, "2'": 25, "3": 85, "4": 13, "5": 20}
MESHES = [
    mesh("1", "2", carrier="H"),
    mesh("2'", "3", "internal", "H"),
    mesh("4", "5"),
]
REST = 'bodies = [["H", "4"]]\nfixed = ["3"]\nn = { 1 = -960 }\nsatellites = 3\n'
TRAIN = told(WHEELS, MESHES, REST)


def run(*args: str) -> str:
    result = CliRunner().invoke(cli, list(args))
    assert result.exit_code == 0, result.output
    return str(result.output)


# Modules ------------------------------------------------------------------------------------------


def test_rows_have_modules_of_their_own(tmp_path: Path) -> None:
    """Distances and radii are those of the row; ratios and teeth are as before."""
    by_row = 'module = { "1-2" = 4, "2\'-3" = 4, "5-4" = 6 }\n'
    motion = solved(tmp_path, TRAIN + by_row)
    assert motion.speeds == solved(tmp_path, TRAIN).speeds
    due = {"a_w_1_2": 120, "a_w_2'_3": 120, "a_w_4_5": 99, "r_4": 39, "r_5": 60, "r_3": 170}
    for name, value in due.items():
        assert answer(motion, name).exact == value, name
    facts = [fact.text for fact in train_facts(motion, get_language("ru"))]
    assert "m = 4 мм (колёса 1, 2, 2', 3)" in facts
    assert "m = 6 мм (колёса 4, 5)" in facts
    as_wheels = TRAIN.replace('"1" = 20', '"1" = { z = 20, m = 4 }')
    as_wheels = as_wheels.replace('"3" = 85', '"3" = { z = 85, m = 4 }')
    as_wheels = as_wheels.replace('"5" = 20', '"5" = { z = 20, m = 6 }')
    assert solved(tmp_path, as_wheels).axes == motion.axes


def test_coaxial_rows_of_different_modules_are_compared_by_radii(tmp_path: Path) -> None:
    """30 and 30 teeth of 2 mm come as far as 12 and 28 of 3 mm: 60 mm."""
    wheels, meshes = {"1": 30, "2": 30, "2'": 12, "3": 28}, [mesh("1", "2"), mesh("2'", "3")]
    rest = 'coaxial = [["1", "3"]]\nn = { 1 = 1 }\n'
    motion = solved(tmp_path, told(wheels, meshes, rest + 'module = { "1-2" = 2, "2\'-3" = 3 }'))
    (one,) = [c for c in conditions(motion) if c.name == "coaxiality"]
    assert (
        sentence(one, get_language("en")) == "Coaxiality (axis 2): r_1 + r_2 = r_3 + r_2' = 60 mm"
    )
    with pytest.raises(ProblemError, match="not coaxial"):
        solved(tmp_path, told(wheels, meshes, rest + "module = 2"))
    found = told({**wheels, "3": 28}, meshes, rest).replace(', "3" = 28', "")
    found += 'unknown = ["3"]\nmodule = { "1-2" = 2, "2\'-3" = 3 }\n'
    assert solved(tmp_path, found).axes.sizes["3"] == 28


@each(
    "module, said",
    [
        ('{ "1-2" = 4, "4-5" = 6 }', "the mesh 2'-3 has no module"),
        ('{ "1-4" = 4 }', "unknown mesh '1-4'"),
        ("0", "a module in mm"),
    ],
)
def test_modules_that_do_not_fit_the_rows_are_reported(
    module: str, said: str, tmp_path: Path
) -> None:
    with pytest.raises(ProblemError) as error:
        solved(tmp_path, f"{TRAIN}module = {module}\n")
    assert said in str(error.value)


def test_wheels_in_mesh_have_one_module(tmp_path: Path) -> None:
    text = TRAIN.replace('"5" = 20', '"5" = { z = 20, m = 6 }')
    with pytest.raises(ProblemError, match="6 mm, and 5 mm of other wheels in its row"):
        solved(tmp_path, text + 'module = { "1-2" = 4, "2\'-3" = 4, "4-5" = 5 }')


def test_a_rack_moves_by_the_module_of_its_row(tmp_path: Path) -> None:
    text = (
        "wheels = { 1 = 20, 2 = 40, 3 = 25 }\n"
        f'meshes = [ {mesh("1", "2")}, {{ of = ["3", "R"], kind = "rack" }} ]\n'
        'bodies = [["2", "3"]]\nomega = { 1 = 2 }\n'
    )
    motion = solved(tmp_path, text + 'module = { "1-2" = 4, "3-R" = 6 }')
    assert abs(answer(motion, "v_R").value or 0) == pytest.approx(0.006 * 25 / 2)


# Carriers -----------------------------------------------------------------------------------------

K10 = """
wheels = {{ 1 = {{ r = 0.07 }}, 2 = {{ r = 0.02 }}, 3 = {{ r = 0.03 }}, 4 = {arm}, 5 = {{ r = 0.06 }}, 6 = {{ r = 0.04 }} }}
meshes = [ {meshes} ]
bodies = [["4", "5"]]
omega = {{ 1 = 10, 3 = -10 }}
ask = ["omega_6", "omega_2", "omega_4", "r_4"]
"""  # noqa: E501
ARMS = ", ".join([mesh("1", "2", "internal", "4"), mesh("2", "3", "external", "4"),
                  mesh("5", "6", "internal")])  # fmt: skip


def k10(arm: str) -> str:
    return K10.format(arm=arm, meshes=ARMS)


def test_the_radius_of_a_carrier_is_given_and_checks_coaxiality(tmp_path: Path) -> None:
    motion = solved(tmp_path, k10("{ r = 0.05 }"))
    facts = [fact.text for fact in train_facts(motion, get_language("en"))]
    assert facts[:6] == [f"r_{{{k}}} = {r} m" for k, r in enumerate(
        ("0.07", "0.02", "0.03", "0.05", "0.06", "0.04"), 1)]  # fmt: skip
    assert [motion.speed(x) for x in "246"] == [25, 4, 6]
    assert answer(motion, "r_4").exact == 50
    sums = [sentence(c, get_language("en")) for c in conditions(motion) if c.name == "coaxiality"]
    assert "Coaxiality (axis 2): r_1 − r_2 = r_4 = 0.05" in sums
    with pytest.raises(ProblemError, match=r"r_4 = 0\.06 m, and the axis of 2 is 0\.05 m from it"):
        solved(tmp_path, k10("{ r = 0.06 }"))
    other = k10("{ r = 0.05 }").replace('"4" }', '"H" }').replace('["4", "5"]', '["H", "4", "5"]')
    assert 'carrier = "H"' in other
    assert answer(solved(tmp_path, other), "r_4").exact == 50
    for wrong in ("5", "{ z = 5 }", "{ r = 0.05, z = 5 }"):
        with pytest.raises(ProblemError, match="4 is a carrier and has no teeth"):
            solved(tmp_path, k10(wrong))


def test_a_carrier_of_wheels_with_teeth_has_a_radius_too(tmp_path: Path) -> None:
    text = TRAIN.replace('"5" = 20', '"5" = 20, H = { r = 0.12 }')
    motion = solved(tmp_path, text + "module = 4\n")
    sums = [sentence(c, get_language("en")) for c in conditions(motion)]
    assert "Coaxiality (axis 2): r_1 + r_2 = r_H = 120 mm" in sums
    solved(tmp_path, text.replace("0.12", "0.12000006") + "module = 4\n")
    with pytest.raises(ProblemError, match="not coaxial"):
        solved(tmp_path, text.replace("0.12", "0.12006") + "module = 4\n")
    for rest, said in (("module = 5\n", "is 0.15 m from it"), ("", "needs the module")):
        with pytest.raises(ProblemError, match=said):
            solved(tmp_path, text + rest)


def test_gears_are_given_in_centimetres(tmp_path: Path) -> None:
    path = tmp_path / "k10.toml"
    text = k10("{ r = 0.05 }")
    for metres in ("0.07", "0.02", "0.03", "0.05", "0.06", "0.04"):
        text = text.replace(metres, metres[-1])
    path.write_text(f'units = "cm"\n[gears]\n{text}', encoding="utf-8")
    found: dict[str, Any] = json.loads(run("solve", str(path), "--json"))["gears"]
    radii = {"1": 0.07, "2": 0.02, "3": 0.03, "4": 0.05, "5": 0.06, "6": 0.04}
    assert found["radii_m"] == pytest.approx(radii)
    assert found["asked"]["omega_6"]["value"] == 6


# Design -------------------------------------------------------------------------------------------


def designed(folder: Path, text: str) -> GearProblem:
    from doors import gears_reader_load as load

    path = folder / "train.toml"
    path.write_text(f"[gears]\n{text}", encoding="utf-8")
    return load(path)


@each("rest", ["", 'module = { "1-2" = 4, "2\'-3" = 4, "4-5" = 6 }\n'])
def test_the_planetary_stage_of_a_longer_train_is_compared(rest: str, tmp_path: Path) -> None:
    """It gives the same as alone, with any stages before or behind it."""
    text = TRAIN + "design = { U = 7.8 }\n" + rest
    problem = designed(tmp_path, text)
    alone = told({w: z for w, z in WHEELS.items() if w not in "45"}, MESHES[:2],
                 'fixed = ["3"]\nn = { 1 = -960 }\nsatellites = 3\n'
                 "design = { U = 7.8 }\n")  # fmt: skip
    both = []
    for one in (problem, designed(tmp_path, alone)):
        motion = solved(tmp_path, text if one is problem else alone)
        both.append(compare(one, motion))
    found, due = both
    assert found is not None
    assert due is not None
    assert (found.set_counts, found.file_set, found.variants) == (
        due.set_counts,
        due.file_set,
        due.variants,
    )
    assert found.file_set.ratio == Fraction(39, 5)
    assert found.module_m == (Fraction(4, 1000) if rest else None)
    if not rest:
        return
    designed(tmp_path, text)
    run("solve", str(tmp_path / "train.toml"))
    run("sheet", str(tmp_path / "train.toml"), "--format", "svg", "-o", str(tmp_path))
