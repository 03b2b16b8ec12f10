"""Other commands on the file of a project."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import pytest
import worked
from click.testing import CliRunner, Result
from doors import (
    KINDS_KINDS as KINDS,
    PART_KINDS,
    Drawing,
    ModelProblem as Problem,
    PartName,
    Project,
    ProjectPart,
    Scales,
    Solution,
    cli,
    first_scales,
    get_language,
    paper_of,
    part_drawings,
    plain_document,
    to_builtins,
)
from worked import ROOT

KINDS_BY_TABLE = {kind.table: kind for kind in KINDS}
SHAPER = ROOT / "tests/data/projects/shaper.toml"


def run(*words: object) -> Result:
    return CliRunner().invoke(cli, [str(word) for word in words])


def shaper() -> Project:
    return worked.project_of(SHAPER)


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
def test_own_numbers_belong_to_the_calculated_position_by_default(
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


def test_an_exact_zero_has_no_percentage(scaled: Path, tmp_path: Path) -> None:
    work = tmp_path / "my.csv"
    work.write_text("величина;значение;положение\nv C;0,5;0\n", "utf-8")
    told = run("solve", scaled, "--compare", work, "--lang", "ru").stdout
    (row,) = (line for line in told.splitlines() if line.startswith("v_C"))
    assert row.endswith("—") and "10" not in row


def test_solve_prints_one_position_at_the_scales_of_all() -> None:
    """The protocol and the sheet of all positions have the same scales."""
    path = ROOT / "problems/linkages/ex3.toml"
    asked = (path, "--phi", "20,140,260", "--lang", "ru")
    whole, one = (run("solve", *asked, *more).stdout for more in ((), ("--position", "1")))
    scales = [line for line in whole.splitlines() if line.startswith("Масштабы")]
    assert scales[0] in one and "φ₁ = 140°" in one and "20,00" not in one
    record = json.loads(run("solve", *asked[:3], "--position", "2", "--json").stdout)
    assert [p["phi_deg"] for p in record["positions"]] == [260.0]
    for words, said in (
        (("--position", "3"), "ex3.toml — 2"),
        (("--position", "1", "--csv"), "--position используется"),
        (("--position", "1", "--compare", "my.csv"), "--compare"),
    ):
        refused = run("solve", *asked, *words)
        assert refused.exit_code == 2 and said in refused.stderr, words


# Norm control ------------------------------------------------------------------------------------


@pytest.mark.dear
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


# Parts left out ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "told"),
    [(("solve",), 0), (("structure",), 0), (("sheet",), 1), (("sheet", "--layout", "forces"), 0)],
)
def test_only_the_default_sheet_lists_the_parts_of_a_project_that_it_leaves_out(
    words: tuple[str, ...], told: int, scaled: Path, tmp_path: Path
) -> None:
    more = ("-o", tmp_path) if words[0] == "sheet" else ()
    done = run(words[0], scaled, *words[1:], *more, "--lang", "en")
    assert done.exit_code == 0, done.output
    assert done.stderr.count("[gears]") == told


# Unlikely data ------------------------------------------------------------------------------------


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


# Unnecessary decisions ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "laid"),
    [(("structure", "--no-drawing"), 0), (("solve", "--ask", "v_C"), 0), (("solve",), 1)],
)
def test_a_command_without_scales_lays_out_no_sheet(
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


FAULTY = """\
title = "Four tables, four faults"
[project]
[frame]
A = [0.0, 0.0]
D = [0.3, 0.0]
[links.1]
points = ["A", "B"]
AB = -0.1
[links.2]
points = ["B", "C"]
BC = 0.25
[links.3]
points = ["D", "C"]
DC = 0.2
[driver]
link = "1"
phi = 60
omega = 10
[assembly]
C = "left of AD"
[gears]
wheels = { 1 = 20, 2 = "many" }
meshes = [{ of = [1, 2] }]
n = { 1 = 100 }
[meshing]
z = [14, 28]
m = 0
[cam]
follower = "translating"
contact = "roller"
stroke = -0.03
rise = 90
return = 100
law = "sine"
pressure = 30
"""


@pytest.mark.parametrize("has_links_fault", [True, False])
def test_every_command_reports_the_faults_of_all_tables_at_once(
    tmp_path: Path, has_links_fault: bool
) -> None:
    path = tmp_path / "faulty.toml"
    path.write_text(FAULTY if has_links_fault else FAULTY.replace("AB = -0.1", "AB = 0.1"), "utf-8")
    places = ["gears.wheels", "meshing.m", "cam.stroke"]
    places += ["links.1.AB"] if has_links_fault else []
    for command in (
        "solve", "solve --json", "sheet", "structure", "protocol", "sketch", "live", "form", "lint",
        "note", "project", "check --key", "animate", "batch", "audit",
    ):  # fmt: skip
        done = run(*command.split(), path)
        assert done.exit_code == 3, (command, done.output)
        for place in places:
            assert f"\n  {place}" in done.output, (command, place, done.output)
        lines = done.stderr.splitlines()
        assert len({*lines}) == len(lines), done.output


def test_solve_prints_the_numbers_of_all_parts(scaled: Path) -> None:
    parts = json.loads(run("solve", scaled, "--json").stdout)["parts"]
    for table, record in parts.items():
        alone = KINDS_BY_TABLE[table]
        part = next(one for one in shaper().parts if one.name.value == table)
        assert record == json.loads(json.dumps(to_builtins(alone.record(part.problem, "en"))))
    own = [part for part in shaper().parts if part.name in PART_KINDS]
    assert set(parts) == {part.name.value for part in own}
    told = run("solve", scaled).stdout
    for part in own:
        document = PART_KINDS[part.name].solved_document(part.problem, get_language("en"))
        assert plain_document(document, get_language("en")) in told
