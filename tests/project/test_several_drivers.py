"""Commands on mechanisms of several drivers: note, project, sheets, --phi, refusals."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    BlockSpec,
    Solution,
    Statics,
    cli,
    force_reading,
    get_language,
    kinds_load as load,
    note_document,
    plain_document,
    problem_loads as loads,
    settle,
    spread,
)
from two_driven import COUPLER_LOADS, FIVE_BAR

TEXT = FIVE_BAR + COUPLER_LOADS
LISTED = TEXT.replace("phi = 70", "phi = [70, 80]").replace("phi = 40", "phi = [40, 10]")


def run(*arguments: str) -> str:
    """Return the output of a command that succeeds."""
    done = CliRunner().invoke(cli, ["--lang", "en", *arguments])
    assert done.exit_code == 0, done.output
    return done.output


def file_of(folder: Path, text: str = TEXT) -> str:
    path = folder / "five-bar.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def note_text(folder: Path, text: str, lang: str) -> str:
    project = settle(load(Path(file_of(folder, text))))
    shown = plain_document(note_document(project, get_language(lang)), get_language(lang))
    return re.sub(r"\s+", " ", shown)


@each("lang", ["en", "ru"])
def test_the_note_describes_both_drivers(lang: str, tmp_path: Path) -> None:
    shown = note_text(tmp_path, TEXT, lang)
    statics = Statics(Solution(loads(TEXT, name="five-bar")))
    found = abs(float(statics.balance[0])), abs(float(statics.other_balances["4"][0]))
    comma = "," if lang == "ru" else "."
    for value in found:
        assert f"{value:#.4g}".replace(".", comma) in shown
    words = {
        "en": ("driving links 1 and 4", "Superposition of velocities", "crank 4 and frame 0"),
        "ru": ("начальных звеньев 1 и 4", "Наложение скоростей", "кривошип 4 и стойка 0"),
    }
    for phrase in (*words[lang], "I(0,1) + I(0,4) → II(2,3)"):
        assert phrase in shown.replace("\u00a0", " ")


def test_a_project_of_listed_positions_has_its_files_and_the_second_coordinate(
    tmp_path: Path,
) -> None:
    run("project", file_of(tmp_path, LISTED), "-o", str(tmp_path))
    made = {path.name for path in (tmp_path / "five-bar").iterdir()}
    assert {"1-kinematics.pdf", "2-forces.pdf", "note.pdf", "numbers.xlsx"} <= made
    assert "φ4 = 10°" in note_text(tmp_path, LISTED, "en").replace("φ_{4}", "φ4").replace("₄", "4")


def test_force_blocks_are_drawn_of_every_group_and_of_both_drivers() -> None:
    solution = Solution(loads(TEXT, name="five-bar"))
    reading = force_reading(solution, 0)
    blocks = spread([BlockSpec("force-plan")], solution)
    assert [block.number for block in blocks] == [*range(len(reading.plans))]
    assert [plan.links for plan in reading.plans][-2:] == [("4",), ("1",)]


def test_lists_of_both_drivers_are_those_of_the_file(tmp_path: Path) -> None:
    """--phi 70,80/40,10 gives what phi = [70, 80] and phi = [40, 10] give."""
    asked = json.loads(run("solve", file_of(tmp_path), "--phi", "70,80/40,10", "--json"))
    listed = json.loads(run("solve", file_of(tmp_path, LISTED), "--json"))
    for one, two in zip(asked["positions"], listed["positions"], strict=True):
        assert one["points"] == two["points"]
        assert one["links"] == two["links"]
        assert one["forces"] == two["forces"]


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ("70/40/10", r"3 lists for 2 driving links \(1, 4\)"),
        ("70,80/40", "have 2, 1 positions: give as many"),
        ("70/", "neither a number"),
    ],
)
def test_a_faulty_list_is_one_message(asked: str, message: str, tmp_path: Path) -> None:
    done = CliRunner().invoke(
        cli, ["--lang", "en", "solve", file_of(tmp_path), "--phi", asked], terminal_width=200
    )
    assert done.exit_code == 2
    assert re.search(message, " ".join(done.output.split()))


@each("layout", ["coursework", "graphs", "forces-cycle", "project-kinematics"])
def test_a_layout_of_a_cycle_is_refused_with_its_reason(layout: str, tmp_path: Path) -> None:
    done = CliRunner().invoke(
        cli, ["--lang", "en", "sheet", file_of(tmp_path), "--layout", layout, "-o", str(tmp_path)]
    )
    assert done.exit_code == 3
    assert "a cycle is a turn of one crank, but links 1, 4 drive" in " ".join(done.output.split())
