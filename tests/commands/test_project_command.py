"""The course project from the command line: files, one set of decisions, whole or not at all."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import docx
import openpyxl
import pytest
from click.testing import CliRunner, Result
from worked import ROOT

from planmethod.cli import cli
from planmethod.errors import ExitCode
from planmethod.problem.model import PROJECT_PARTS

FILES = ROOT / "tests" / "data" / "projects"
NAMES = ("shaper", "crusher", "engine", "homework")
PARTS = {
    "shaper": ["kinematics", "forces", "flywheel", "gears", "note"],
    "crusher": ["kinematics", "forces", "note"],
    "engine": ["kinematics", "forces", "flywheel", "note"],
    "homework": ["kinematics", "note"],
}


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, ["project", *args])


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Return what makes a project, once, and returns its folder."""

    @cache
    def folder(name: str) -> Path:
        out = tmp_path_factory.mktemp("out")
        done = run(str(FILES / f"{name}.toml"), "-o", str(out))
        assert done.exit_code == 0, done.output
        return out / name

    return folder


def record(folder: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((folder / "project.json").read_text("utf-8"))
    return found


def text_of(path: Path) -> str:
    if shutil.which("pdftotext") is None:
        pytest.skip("needs pdftotext")
    return subprocess.run(
        ["pdftotext", "-raw", "-enc", "UTF-8", str(path), "-"],
        capture_output=True,
        encoding="utf-8",
        check=True,
    ).stdout


# Files -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_a_project_has_the_files_of_its_parts(name: str, made: Callable[[str], Path]) -> None:
    folder = made(name)
    told = record(folder)
    assert [part["name"] for part in told["parts"]] == PARTS[name]
    *sheets, note = told["parts"]
    for number, part in enumerate(sheets, 1):
        assert part["files"] == [f"{number}-{part['name']}.pdf"]
        assert part["sheets"] >= 1
    assert note["files"] == ["note.docx", "note.pdf"]
    listed = [file for part in told["parts"] for file in part["files"]]
    assert sorted(path.name for path in folder.iterdir()) == sorted(
        [*listed, "project.pdf", "numbers.xlsx", "project.json"]
    )


@pytest.mark.parametrize("name", NAMES)
def test_the_record_has_what_was_decided(name: str, made: Callable[[str], Path]) -> None:
    told = record(made(name))
    assert (told["schema"], told["problem"]) == (1, name)
    assert [one["number"] for one in told["positions"]] == list(range(len(told["positions"])))
    assert 0 <= told["calculated"] < len(told["positions"])
    assert set(told["scales"]) == {"mu_l", "mu_v", "mu_a", "mu_F"}
    assert (told["scales"]["mu_F"] is None) == (name == "homework")
    assert (told["strokes"] is None) == (name == "homework")
    if told["strokes"]:
        assert set(told["strokes"]) == {"working_deg", "idle_deg", "K_v", "by"}
        assert told["strokes"]["K_v"] >= 1.0


# One set of decisions ----------------------------------------------------------------------------


def decimal(text: str) -> float:
    return float(text.replace(",", ".").replace("−", "-"))


def scales_beside(text: str, names: str, letter: str) -> set[float]:
    """Return the scales that stand under views of some names."""
    found = re.findall(rf"(?:{names})[^\n]*\n(?:[^\nμ]*\n)?μ{letter} = ([\d,]+)", text)
    return {decimal(number) for number in found}


@pytest.mark.parametrize("name", NAMES)
def test_all_outputs_say_the_same(name: str, made: Callable[[str], Path]) -> None:
    """One numbering, one scale for each kind of plan, one value for each quantity."""
    folder = made(name)
    told = record(folder)
    scales = told["scales"]
    sheets = [text_of(folder / f) for part in told["parts"][:-1] for f in part["files"]]
    linkage = sheets[: len(told["parts"]) - 1 - ("gears" in PARTS[name])]
    whole, note = text_of(folder / "project.pdf"), text_of(folder / "note.pdf")
    word = "\n".join(p.text for p in docx.Document(str(folder / "note.docx")).paragraphs)

    # Numbers of sheets: those of the files are those of the set.
    numbers = [int(n) for text in sheets for n in re.findall(r"^Лист (\d+)", text, re.M)]
    count = sum(part["sheets"] for part in told["parts"] if "sheets" in part)
    assert whole.count("\f") == count
    if count > 1:
        assert numbers == list(range(1, count + 1))
        assert re.search(rf"Листов {count}$", sheets[0], re.M)

    # Scales of the plans, wherever they stand.
    for text in [*linkage, whole.partition("Картина")[0]]:
        assert scales_beside(text, "Планы? скоростей|Рычаг", "v") <= {scales["mu_v"]}
        assert scales_beside(text, "Планы? ускорений", "a") <= {scales["mu_a"]}
        assert scales_beside(text, "План сил", "F") <= {scales["mu_F"]}
    assert scales_beside(sheets[0], "Планы? скоростей", "v") == {scales["mu_v"]}
    for text in (note, word):
        for key, number in re.findall(r"\bμ_?(l|v|a|F) = ([\d,]+)[^\n]*$", text, re.M):
            if key == "l":
                assert decimal(number) == scales["mu_l"]

    # Positions and values: the workbook beside the table on the sheet.
    book = openpyxl.load_workbook(folder / "numbers.xlsx")
    rows = list(book.worksheets[0].iter_rows(values_only=True))
    head, values = rows[0], rows[1:]
    assert [row[0] for row in values] == [one["number"] for one in told["positions"]]
    for row, one in zip(values, told["positions"], strict=True):
        assert (row[1] - one["phi_deg"]) % 360.0 == pytest.approx(0.0, abs=1e-6) or (
            row[1] - one["phi_deg"]
        ) % 360.0 == pytest.approx(360.0, abs=1e-6)
    assert len(head) > 4
    at = values[told["calculated"]]
    first = [f"{value:.4g}".replace(".", ",") for value in at[2:4]]
    assert any(text in sheets[0] for text in first)


def test_commands_take_the_decisions_of_the_project(made: Callable[[str], Path]) -> None:
    told = record(made("shaper"))
    done = CliRunner().invoke(cli, ["solve", str(FILES / "shaper.toml"), "--json"])
    assert done.exit_code == 0, done.output
    found = json.loads(done.stdout)
    assert [round(p["phi_deg"] % 360.0, 6) for p in found["positions"]] == [
        round(p["phi_deg"] % 360.0, 6) for p in told["positions"]
    ]
    plans = found["positions"][0]["plans"]
    assert {plans[kind]["mu"] for kind in ("position",)} == {told["scales"]["mu_l"]}
    assert plans["velocity"]["mu"] == told["scales"]["mu_v"]
    assert plans["acceleration"]["mu"] == told["scales"]["mu_a"]


def test_a_table_that_a_command_leaves_out_is_told(tmp_path: Path) -> None:
    done = CliRunner().invoke(
        cli, ["structure", str(FILES / "shaper.toml"), "--no-drawing", "--lang", "en"]
    )
    assert done.exit_code == 0
    assert "[gears] is left out; planmethod project draws it." in done.stderr


# Options -----------------------------------------------------------------------------------------


def test_parts_position_and_formats_are_asked_for(tmp_path: Path) -> None:
    out = str(tmp_path)
    done = run(
        str(FILES / "homework.toml"),
        "-o",
        out,
        "--parts",
        "kinematics",
        "--format",
        "svg",
        "--json",
    )
    assert done.exit_code == 0, done.output
    told = json.loads(done.stdout)
    assert [part["files"] for part in told["parts"]] == [["1-kinematics.svg"]]
    assert told == record(tmp_path / "homework")
    names = {path.name for path in (tmp_path / "homework").iterdir()}
    assert names == {"1-kinematics.svg", "numbers.xlsx", "project.json"}


def test_an_earlier_project_is_replaced_and_other_files_stay(tmp_path: Path) -> None:
    folder = tmp_path / "homework"
    args = (str(FILES / "homework.toml"), "-o", str(tmp_path), "--parts", "kinematics")
    assert run(*args, "--format", "svg").exit_code == 0
    (folder / "mine.txt").write_text("mine")
    assert run(*args, "--format", "pdf").exit_code == 0
    assert {path.name for path in folder.iterdir()} == {
        "1-kinematics.pdf", "project.pdf", "numbers.xlsx", "project.json", "mine.txt",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("args", "code", "said"),
    [
        (("homework.toml", "--parts", "forces"), ExitCode.USAGE, "has no part 'forces'"),
        (("homework.toml", "--parts", "sheets"), ExitCode.USAGE, "'sheets' is not one of"),
        (("homework.toml", "--position", "3"), ExitCode.PROBLEM, "there is no position 3"),
        (("none.toml",), ExitCode.PROBLEM, "none.toml"),
    ],
)
def test_what_is_asked_wrongly_is_told(
    args: tuple[str, ...], code: ExitCode, said: str, tmp_path: Path
) -> None:
    done = run(str(FILES / args[0]), *args[1:], "-o", str(tmp_path), "--lang", "en")
    assert done.exit_code == code
    assert said in done.stderr
    assert not any(tmp_path.iterdir())


def test_a_train_alone_is_no_project(tmp_path: Path) -> None:
    done = run(str(ROOT / "problems/gears/gears-ex2.toml"), "-o", str(tmp_path), "--lang", "en")
    assert done.exit_code == ExitCode.USAGE
    assert "a project is that of a linkage" in done.stderr


# Whole or not at all -----------------------------------------------------------------------------


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_where_a_part_fails_nothing_is_written(jobs: str, tmp_path: Path) -> None:
    text = (FILES / "homework.toml").read_text("utf-8")
    train = "[gears]\nwheels = { 1 = 20, 2 = 21 }\nmeshes = [{ of = [1, 2] }]\nn = { 1 = 1 }\n"
    file = tmp_path / "my.toml"
    file.write_text(text + train + '[sheet]\npaper = "A4"\n[stamp]\ntitle = "x"\n', "utf-8")
    out = tmp_path / "out"
    done = run(str(file), "-o", str(out), "--jobs", jobs, "--lang", "en")
    if done.exit_code == 0:
        pytest.skip("both parts fit A4")
    assert done.exit_code != 0
    assert re.search(r"(kinematics|gears) is not made, nothing is written: ", done.stderr)
    assert not out.exists()


@pytest.mark.skipif(sys.platform == "win32" or os.geteuid() == 0, reason="root writes everywhere")
def test_a_folder_that_cannot_be_written_to_is_told(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    done = run(str(FILES / "homework.toml"), "-o", str(tmp_path), "--lang", "en")
    tmp_path.chmod(0o700)
    assert done.exit_code == ExitCode.USAGE
    assert "no permission" in done.stderr


def test_a_file_in_the_way_leaves_everything_as_it_was(tmp_path: Path) -> None:
    folder = tmp_path / "homework"
    (folder / "project.json").mkdir(parents=True)
    done = run(str(FILES / "homework.toml"), "-o", str(tmp_path), "--lang", "en")
    assert done.exit_code == ExitCode.USAGE
    assert "it is a directory" in done.stderr
    assert [path.name for path in folder.iterdir()] == ["project.json"]


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of a POSIX shell")
def test_a_closed_pipe_is_no_error(tmp_path: Path) -> None:
    command = (
        f"{sys.executable} -m planmethod project {FILES}/homework.toml -o {tmp_path} "
        "--parts kinematics --json; echo code $? >&2"
    )
    done = subprocess.run(
        f"({command}) | true", shell=True, capture_output=True, encoding="utf-8", cwd=ROOT
    )
    assert "code 0" in done.stderr, done.stderr
    assert "Traceback" not in done.stderr


def test_the_parts_of_the_option_are_those_of_the_table() -> None:
    help_text = CliRunner().invoke(cli, ["project", "--help"]).output
    assert all(part in help_text for part in PROJECT_PARTS)
