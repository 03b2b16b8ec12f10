"""What other commands make of the file of a project."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from worked import ROOT

from planmethod.cli import cli
from planmethod.kinds import load
from planmethod.problem.model import Problem, Scales
from planmethod.project.first import first_scales
from planmethod.project.model import PartName, Project, ProjectPart
from planmethod.project.settle import settle
from planmethod.project.sheets import part_drawings
from planmethod.render.ink.drawing import Drawing
from planmethod.render.sheets.controlled import paper_of
from planmethod.solved.solution import Solution

SHAPER = ROOT / "tests/data/projects/shaper.toml"


def run(*words: object) -> Result:
    return CliRunner().invoke(cli, [str(word) for word in words])


@cache
def shaper() -> Project:
    return settle(load(SHAPER), SHAPER)


@pytest.fixture(scope="module")
def scaled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file with the scales of its project: given, they are not searched by every command."""
    path, scales = tmp_path_factory.mktemp("scaled") / "shaper.toml", shaper().scales
    lines = (f"mu_{of} = {getattr(scales, f'mu_{of}')!r}" for of in "lvaF")
    path.write_text("\n".join((SHAPER.read_text("utf-8"), "[scales]", *lines)), "utf-8")
    return path


def exact(number: int) -> str:
    """Return the speed of C in a position, as tables have it."""
    project = shaper()
    solution = Solution(project.problem, positions=[project.positions[number]])
    return f"{abs(complex(solution.points['C'].velocity[0])):.3g}".replace(".", ",")


# Own numbers -------------------------------------------------------------------------------------


@pytest.mark.parametrize("row", ["v C;0,5;", "v C;0,5;1"])
def test_own_numbers_are_of_the_calculated_position_if_they_say_no_other(
    row: str, scaled: Path, tmp_path: Path
) -> None:
    work = tmp_path / "my.csv"
    work.write_text(f"величина;значение;положение\n{row}\n", "utf-8")
    number = 4 if row.endswith(";") else 1
    told = run("solve", scaled, "--compare", work, "--lang", "ru")
    assert told.exit_code == 0, told.output
    assert exact(number) in told.stdout and exact(5 - number) not in told.stdout
    checked = run("check", scaled, work, "--json")
    (checked_work,) = json.loads(checked.stdout)
    answer, *_ = checked_work["answers"]
    assert answer["position"] == number


def test_of_an_exact_nothing_there_is_no_per_cent(scaled: Path, tmp_path: Path) -> None:
    work = tmp_path / "my.csv"
    work.write_text("величина;значение;положение\nv C;0,5;0\n", "utf-8")
    told = run("solve", scaled, "--compare", work, "--lang", "ru").stdout
    (row,) = (line for line in told.splitlines() if line.startswith("v_C"))
    assert row.endswith("—") and "10" not in row


def test_solve_prints_one_position_at_the_scales_of_all() -> None:
    """As the protocol and the sheet of all positions have it."""
    path = ROOT / "problems/linkages/ex3.toml"
    asked = (path, "--phi", "20,140,260", "--lang", "ru")
    whole, one = (run("solve", *asked, *more).stdout for more in ((), ("--position", "1")))
    scales = [line for line in whole.splitlines() if line.startswith("Масштабы")]
    assert scales[0] in one and "φ₁ = 140°" in one and "20,00" not in one
    record = json.loads(run("solve", *asked[:3], "--position", "2", "--json").stdout)
    assert [p["phi_deg"] for p in record["positions"]] == [260.0]
    for words, said in (
        (("--position", "3"), "ex3.toml — 2"),
        (("--position", "1", "--csv"), "--position сочетается"),
        (("--position", "1", "--compare", "my.csv"), "--compare"),
    ):
        refused = run("solve", *asked, *words)
        assert refused.exit_code == 2 and said in refused.stderr, words


# Norm control ------------------------------------------------------------------------------------


def test_lint_looks_over_the_sheets_of_the_project(
    scaled: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: dict[PartName, list[Drawing]] = {}

    def noted(project: Project, part: ProjectPart, fields: Mapping[str, str]) -> list[Drawing]:
        drawn[part.name] = part_drawings(project, part, fields)
        return drawn[part.name]

    monkeypatch.setattr("planmethod.project.sheets.part_drawings", noted)
    found = json.loads(run("lint", scaled, "--json").stdout)
    assert [*drawn] == [part.name for part in shaper().parts]
    sheets = [sheet for part in drawn.values() for sheet in part]
    assert found["kind"] == "project" and len(found["sheets"]) == len(sheets)
    assert [sheet["paper"] for sheet in found["sheets"]] == [*map(paper_of, sheets)]
    one = json.loads(run("lint", scaled, "--phi", "30", "--json").stdout)
    assert one["kind"] == "kinematics" and len(one["sheets"]) == 1


# What is left out --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "told"),
    [(("solve",), 0), (("structure",), 0), (("sheet",), 1), (("sheet", "--layout", "forces"), 0)],
)
def test_only_the_usual_sheet_says_which_parts_of_a_project_it_leaves_out(
    words: tuple[str, ...], told: int, scaled: Path, tmp_path: Path
) -> None:
    more = ("-o", tmp_path) if words[0] == "sheet" else ()
    done = run(words[0], scaled, *words[1:], *more, "--lang", "en")
    assert done.exit_code == 0, done.output
    assert done.stderr.count("[gears]") == told


# What is hardly meant ----------------------------------------------------------------------------


@pytest.mark.parametrize(("way", "warned"), [("left", False), ("right", True)])
def test_a_working_stroke_against_the_loads_is_warned_of(
    way: str, warned: bool, tmp_path: Path
) -> None:
    path = tmp_path / "way.toml"
    text = SHAPER.read_text("utf-8").replace("[cycle]", f'[cycle]\nworking = "{way}"')
    path.write_text(text, "utf-8")
    done = run("structure", path, "--no-drawing", "--lang", "ru")
    strokes = shaper().strokes
    assert done.exit_code == 0 and strokes is not None
    told = f'working = "right" называет рабочим ход на {strokes.idle_deg:.2f}°, а P совершает'
    assert (told in done.stderr) is warned


@pytest.mark.parametrize(
    ("kept", "said"), [("", "ни у одного звена нет ни массы"), ("3", "у звена 5 нет ни массы")]
)
def test_forces_without_masses_are_warned_of(kept: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "light.toml"
    text = SHAPER.read_text("utf-8").replace("mass = 50", "mass = 0")
    if not kept:
        text = text.replace("mass = 22", "mass = 0").replace("inertia = 0.9", "inertia = 0")
    path.write_text(text, "utf-8")
    done = run("structure", path, "--no-drawing", "--lang", "ru")
    assert said in done.stderr and "массы" not in run("structure", SHAPER, "--no-drawing").stderr


# What is decided for nothing ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "laid"),
    [(("structure", "--no-drawing"), 0), (("solve", "--ask", "v_C"), 0), (("solve",), 1)],
)
def test_what_needs_no_scales_lays_no_sheet_out(
    words: tuple[str, ...], laid: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[Problem] = []
    real = first_scales

    def counted(problem: Problem) -> Scales:
        calls.append(problem)
        return real(problem)

    monkeypatch.setattr("planmethod.project.settle.first_scales", counted)
    done = run(words[0], SHAPER, *words[1:])
    assert done.exit_code == 0 and len(calls) == laid
    if "--ask" in words:  # the positions are those of the project
        assert sum(line.strip()[:1].isdigit() for line in done.stdout.splitlines()) == 6
