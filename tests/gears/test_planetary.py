"""Design of planetary trains: variants against a search of their own, the sheet, faulty files."""

from __future__ import annotations

import json
from fractions import Fraction
from math import gcd, pi, radians, sin
from pathlib import Path
from typing import Any

import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    SCHEMES,
    PlanRequest,
    Stroke,
    TeethSpecification,
    Text,
    cli,
    gears_reader_load as load,
    gears_sheet_drawings as drawings,
    inspect,
    set_of,
    teeth_selection_choose as choose,
)

CARRIED = [one for one in SCHEMES if one.is_planetary]
RATIOS = {"ring": "6.5", "external-internal": "12", "two-external": "-12", "two-internal": "-20"}

RING = """
[gears]
wheels = { 1 = 21, 2 = 48, 3 = 117 }
meshes = [
  { of = [1, 2], kind = "external", carrier = "H" },
  { of = [2, 3], kind = "internal", carrier = "H" },
]
fixed = [3]
satellites = 3
module = 4
n = { 1 = 1 }
ask = ["U_1_H"]
"""


def written(tmp_path: Path, body: str) -> Path:
    path = tmp_path / "train.toml"
    path.write_text(body, encoding="utf-8")
    return path


def told(path: Path) -> dict[str, Any]:
    run = CliRunner().invoke(cli, ["solve", str(path), "--json"])
    assert run.exit_code == 0, run.output
    found: dict[str, Any] = json.loads(run.output)["gears"]["design"]
    return found


def searched(k: int, low: int = 17, most: int = 120, ring: int = 250) -> list[tuple[int, ...]]:
    """All sets of a ring with U = 6.5 within 2 per cent, by conditions of their own."""
    squared, found = sin(radians(20)) ** 2, []
    for one in range(low, most + 1):
        for two in range(low, most + 1):
            three = one + 2 * two
            if not low <= three <= ring or abs((1 + Fraction(three, one)) / 6.5 - 1) > 0.02:
                continue
            small, large = sorted((one, two))
            room = 4 - 2 * small * squared
            outside = room <= 0 or large * room <= small**2 * squared - 4
            inside = three * (2 * two * squared - 4) >= two**2 * squared - 4 and (
                2 * two * squared > 4 and three - two >= 8
            )
            apart = (one + two) * sin(pi / k) > two + 2
            if outside and inside and apart and (one + three) % k == 0:
                found.append((three, one, two))
    return sorted(found)


def test_variants_are_those_of_a_search_of_their_own(tmp_path: Path) -> None:
    body = RING + "design = { U = 6.5, k_min = 2, k_max = 4, count = 10 }"
    design = told(written(tmp_path, body))
    assert design["scheme"] == "ring"
    for k in (2, 3, 4):
        own = searched(k)
        assert design["found"][str(k)] == len(own)
        shown = [one for one in design["variants"] if one["satellites"] == k]
        sizes = [one["size"] for one in shown]
        assert sizes == [float(size) for size, *_ in own[: len(shown)]]
        assert {(o["size"], o["teeth"]["1"], o["teeth"]["2"]) for o in shown} <= set(own)
    assert design["place"] == 1 + [one[1:] for one in searched(3)].index((21, 48))
    (mine,) = (one for one in design["variants"] if one["is_own"])
    assert mine["size_mm"] == 117 * 4


def test_a_set_by_its_teeth_is_that_of_the_search() -> None:
    for scheme in SCHEMES:
        asked = RATIOS.get(scheme.name, "-3" if scheme.name == "pair" else "6")
        wanted = TeethSpecification(
            scheme, Fraction(asked), Fraction(2, 100), max_teeth=60, max_ring_teeth=120
        )
        chosen = choose(wanted, first=25)
        assert chosen.sets, scheme.name
        for one in chosen.sets:
            assert set_of(wanted, one.teeth) == one


@pytest.mark.parametrize("scheme", [one.name for one in CARRIED])
def test_a_written_set_is_compared_and_drawn(scheme: str, tmp_path: Path) -> None:
    path = tmp_path / "set.toml"
    args = ["teeth", "--scheme", scheme, "--U", RATIOS[scheme], "--z-max", "60"]
    run = CliRunner().invoke(cli, [*args, "--ring-max", "120", "--write", str(path), "2"])
    assert run.exit_code == 0, run.output
    design = told(path)
    assert design["place"] == 2
    assert abs(design["error"]) <= 0.02
    problem = load(path)
    (sheet,) = drawings(problem, PlanRequest())
    # The ratio, not the sheet, determines how short a velocity vector is: PM-D08.
    found = [f"{one.code} {one.message}" for one in inspect(sheet) if one.code != "PM-D08"]
    assert found == []
    texts = {one.text for one in sheet.items if isinstance(one, Text)}
    assert "3 *" in texts
    assert "Сравнение вариантов" in texts
    arms = {one.tag for one in sheet.items if isinstance(one, Stroke) and one.tag.endswith(" 2")}
    assert any(tag.startswith("link ") for tag in arms)  # the third planet gear has its arm


def test_labels_and_the_order_of_meshes_do_not_matter(tmp_path: Path) -> None:
    body = """
[gears]
wheels = { 7 = 117, 5 = 48, 4 = 21 }
meshes = [
  { of = [7, 5], kind = "internal", carrier = "C" },
  { of = [5, 4], kind = "external", carrier = "C" },
]
fixed = [7]
satellites = 3
n = { 4 = 1 }
design = { U = 6.5 }
"""
    design = told(written(tmp_path, body))
    (mine,) = (one for one in design["variants"] if one["is_own"])
    assert mine["teeth"] == {"1": 21, "2": 48, "3": 117}
    assert mine["value"] == pytest.approx(46 / 7)


@each("lang, word", [("ru", "габарит D/m = 117"), ("en", "D/m = 117")])
def test_texts_state_the_place_of_the_train(tmp_path: Path, lang: str, word: str) -> None:
    path = written(tmp_path, RING + "design = { U = 6.5 }")
    for command in ("solve", "protocol"):
        run = CliRunner().invoke(cli, [command, str(path), "--lang", lang])
        assert run.exit_code == 0, run.output
        assert word in " ".join(run.output.split())
    outside = written(tmp_path, RING + "design = { U = 9 }")
    assert told(outside)["place"] is None


def test_a_set_that_cannot_be_assembled_is_no_variant(tmp_path: Path) -> None:
    assert (21 + 117) % 4
    path = written(tmp_path, RING.replace("satellites = 3", "satellites = 4") + "design = { }")
    design = told(path)
    assert design["satellites"] == 4
    assert design["place"] is None
    assert gcd(21 + 117, 4) == 2


@each(
    "body, said",
    [
        (RING + "design = { U = 0 }", "gears.design.U"),
        (RING + "design = { k_min = 5, k_max = 4 }", "k_min = 5 is more than k_max = 4"),
        (RING + "design = { V = 4 }", "unknown key"),
        (RING + "design = 6.5", "gears.design"),
        (
            "[gears]\nwheels = { 1 = 20, 2 = 40 }\nmeshes = [{ of = [1, 2] }]\n"
            "n = { 1 = 1 }\ndesign = { }",
            "is not one of the planetary schemes",
        ),
        (
            RING.replace("fixed = [3]", "fixed = [1]").replace("n = { 1", "n = { 3")
            + "design = { U = 1.2 }",
            "is not one of the planetary schemes",
        ),
    ],
)
def test_a_faulty_design_is_reported(tmp_path: Path, body: str, said: str) -> None:
    run = CliRunner().invoke(cli, ["solve", str(written(tmp_path, body)), "--lang", "en"])
    assert run.exit_code == 3, run.output
    assert said in run.output
