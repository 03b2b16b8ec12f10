"""Reactions of the guides in the record and in the tables of the terminal."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from doors import cli
from worked import path_of


def run(*args: str) -> str:
    file = str(path_of("levers/crosshead"))
    result = CliRunner().invoke(cli, ["solve", file, "--phi", "90,150", *args])
    assert result.exit_code == 0, result.output
    return result.output


def reactions(index: int) -> list[dict[str, Any]]:
    position = json.loads(run("--json"))["positions"][index]
    found: list[dict[str, Any]] = position["forces"]["reactions"]
    return found


def guide(index: int) -> dict[str, Any]:
    (found,) = (one for one in reactions(index) if "b" in one)
    return found


@pytest.mark.parametrize("index", [0, 1])
def test_only_a_guide_has_a_distance_and_a_point(index: int) -> None:
    one = guide(index)
    assert (one["joint"], one["on"], one["from"]) == ("C", "3", "0")
    assert one["b"] == pytest.approx(one["moment"] / one["fy"], rel=1e-12)
    assert one["point"] == pytest.approx([one["at"][0] + one["b"], one["at"][1]], abs=1e-12)
    assert [("b" in other, "point" in other) for other in reactions(index)].count((True, True)) == 1


def test_forces_at_edges_are_described_at_their_places() -> None:
    assert "edges" not in guide(0)
    one = guide(1)
    assert one["b"] < -0.04
    ahead, behind = one["edges"]
    assert ahead["fy"] + behind["fy"] == pytest.approx(one["fy"], rel=1e-12)
    about = sum((e["at"][0] - one["at"][0]) * e["fy"] for e in one["edges"])
    assert about == pytest.approx(one["moment"], rel=1e-12)
    assert ahead["at"][0] - behind["at"][0] == pytest.approx(0.08, rel=1e-12)
    assert ahead["fx"] == behind["fx"] == 0.0


def test_without_a_force_there_is_no_point() -> None:
    result = CliRunner().invoke(cli, ["solve", str(path_of("levers/task12")), "--json"])
    found = json.loads(result.output)["positions"][0]["forces"]["reactions"]
    (one,) = (r for r in found if (r["on"], r["from"]) == ("5", "0"))
    assert (one["b"], one["point"], one["f"]) == (None, None, 0.0)
    assert one["moment"] < -90.0


@pytest.mark.parametrize(
    ("lang", "column", "told"),
    [
        ("ru", "l, м", "C 3←0: равнодействующая вне ползуна длиной 0,08 м; на его краях"),
        ("en", "l, m", "C 3←0: the resultant is outside the slider 0.08 m long; at its edges"),
    ],
)
def test_the_table_has_a_column_and_a_line(lang: str, column: str, told: str) -> None:
    text = run("--lang", lang)
    flat = re.sub(r"\s+", " ", text)
    assert text.count(column) == 2
    assert flat.count(told) == 1
    sign = "," if lang == "ru" else "."
    for index in (0, 1):
        b = f"{guide(index)['b']:.5f}".replace("-", "−").replace(".", sign)
        assert b in text
    for letter, edge in zip(("F′", "F″"), guide(1)["edges"], strict=True):
        size = f"{abs(edge['fy']):.4g}".replace(".", sign)
        angle = f"{90 if edge['fy'] > 0 else 270},00".replace(",", sign)
        assert re.search(rf"{letter} = {re.escape(size)} \S+ \(φ = {re.escape(angle)}°\)", flat)


def test_a_couple_at_the_edges_is_described(tmp_path: Path) -> None:
    text = path_of("levers/task12").read_text("utf-8")
    text = text.replace('{ on = "y-y" }', '{ on = "y-y", length = 0.12 }')
    file = tmp_path / "t.toml"
    file.write_text(text, encoding="utf-8")
    output = CliRunner().invoke(cli, ["solve", str(file), "--lang", "ru"]).output
    flat = re.sub(r"\s+", " ", output)
    assert "E 5←0: сила равна нулю, есть только момент; на краях ползуна длиной 0,12 м" in flat
    assert flat.count("824,8 Н") == 2
