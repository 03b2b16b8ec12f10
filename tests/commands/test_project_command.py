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
from docx.oxml.ns import qn
from doors import PROJECT_PARTS, ExitCode, cli
from worked import ROOT

FILES = ROOT / "tests" / "data" / "projects"
MATH = "{http://schemas.openxmlformats.org/officeDocument/2006/math}t"
NAMES = ("shaper", "crusher", "homework", "engine")
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
    """Return a function that makes a project, once, and returns its folder."""

    @cache
    def folder(name: str) -> Path:
        out = tmp_path_factory.mktemp("out")
        done = run(str(FILES / f"{name}.toml"), "-o", str(out), "--lang", "ru")
        assert done.exit_code == 0, done.output
        return out / name

    return folder


def record(folder: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((folder / "project.json").read_text("utf-8"))
    return found


def text_of(path: Path, *options: str) -> str:
    if shutil.which("pdftotext") is None:
        pytest.skip("needs pdftotext")
    return subprocess.run(
        ["pdftotext", *(options or ("-raw",)), "-enc", "UTF-8", str(path), "-"],
        capture_output=True,
        encoding="utf-8",
        check=True,
    ).stdout


# Files -------------------------------------------------------------------------------------------


@pytest.mark.dear
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
        [*listed, "project.pdf", "numbers.xlsx", "numbers.ipynb", "project.json"]
    )


@pytest.mark.dear
@pytest.mark.parametrize("name", NAMES)
def test_the_record_has_the_decisions(name: str, made: Callable[[str], Path]) -> None:
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


def words_of(path: Path) -> list[str]:
    """Return the paragraphs of a file of Word, those of its equations too."""
    body = docx.Document(str(path)).element.body
    letters = (qn("w:t"), MATH)
    return [
        "".join(run.text or "" for run in paragraph.iter() if run.tag in letters)
        for paragraph in body.iter(qn("w:p"))
    ]


@pytest.mark.usefixtures("russian")
@pytest.mark.dear
@pytest.mark.parametrize("name", NAMES)
def test_sheets_have_one_numbering(name: str, made: Callable[[str], Path]) -> None:
    folder = made(name)
    *sheets, _ = record(folder)["parts"]
    count = sum(part["sheets"] for part in sheets)
    found = [text_of(folder / file, "-layout") for part in sheets for file in part["files"]]
    whole = text_of(folder / "project.pdf", "-layout")
    assert [text.count("\f") for text in found] == [part["sheets"] for part in sheets]
    assert whole.count("\f") == count
    for text in ("".join(found), whole):
        numbers = re.findall(r"Лист +(\d*) *Листов *(\d*)", text)
        one = [("", "1")] if count == 1 else [("1", str(count))]
        assert numbers == one + [(str(k), "") for k in range(2, count + 1)]


@pytest.mark.usefixtures("russian")
@pytest.mark.dear
@pytest.mark.parametrize("name", NAMES)
def test_every_plan_has_the_scale_of_the_project(name: str, made: Callable[[str], Path]) -> None:
    """On every sheet, in all of them together, in the note for Word and as PDF."""
    folder = made(name)
    told = record(folder)
    scales = told["scales"]
    plans = {
        "v": (r"План(?:ы)? скоростей|Рычаг Жуковского", scales["mu_v"]),
        "a": (r"План(?:ы)? ускорений", scales["mu_a"]),
        "F": (r"План сил", scales["mu_F"]),
        "l": (r"План(?:ы)? положени[яй]|Схема нагружения|Группа звеньев", scales["mu_l"]),
    }
    *sheets, _ = told["parts"]
    linkage = [p for p in sheets if p["name"] in ("kinematics", "forces")]
    texts = [text_of(folder / file) for part in linkage for file in part["files"]]
    texts.append(text_of(folder / "note.pdf"))
    texts.append("\n".join(words_of(folder / "note.docx")))
    for text in texts:
        for letter, (names, scale) in plans.items():
            lines = rf"(?:{names})[^\n]*(?:\n[^\nμ=]*){{0,2}}\n?μ_?{letter} *= *([\d,]+)"
            assert {decimal(number) for number in re.findall(lines, text)} <= {scale}
    for letter, (_, scale) in plans.items():
        if scale is not None:
            everywhere = re.findall(rf"μ{letter} *= *([\d,]+)", "\n".join(texts))
            assert scale in map(decimal, everywhere)


@pytest.mark.usefixtures("russian")
@pytest.mark.dear
@pytest.mark.parametrize("name", NAMES)
def test_every_quantity_has_one_value(name: str, made: Callable[[str], Path]) -> None:
    """The values that the note measures in the calculated position are in workbook and sheet."""
    folder = made(name)
    told = record(folder)
    head, *rows = (
        openpyxl.load_workbook(folder / "numbers.xlsx").worksheets[0].iter_rows(values_only=True)
    )
    assert [row[0] for row in rows] == [one["number"] for one in told["positions"]]
    for row, one in zip(rows, told["positions"], strict=True):
        off = (row[1] - one["phi_deg"] + 180.0) % 360.0 - 180.0
        assert off == pytest.approx(0.0, abs=1e-6)
    measured = dict(zip(head, rows[told["calculated"]], strict=True))
    line = re.compile(
        r"^v_?([A-Z]\w*) ?= ?(?:v_?\w+ ?= ?)?μ_?v·\(p\w+\) ?= ?[\d,]+·[\d,]+ ?= ?([\d,]+) м/с"
    )
    for lines in (text_of(folder / "note.pdf").splitlines(), words_of(folder / "note.docx")):
        found = [m for text in lines if (m := line.match(text.replace("\u00a0", " ")))]
        assert found
        for one_line in found:
            point, value = one_line.groups()
            key = f"v_{point}, м/с (по плану)"
            assert decimal(value) == pytest.approx(measured[key], rel=1e-3)
    if len(rows) > 1:
        sheet = text_of(folder / "1-kinematics.pdf").replace(" ", "")
        exact = next(key for key in head if key.startswith("v_"))
        assert f"{measured[exact]:.4g}".replace(".", ",") in sheet


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


def test_a_table_that_a_command_leaves_out_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "alone.toml"
    text = (FILES / "shaper.toml").read_text("utf-8")
    path.write_text(text.replace("[project]\ncalculated = 4\n", ""), "utf-8")
    done = CliRunner().invoke(cli, ["structure", str(path), "--no-drawing", "--lang", "en"])
    assert done.exit_code == 0
    assert "[gears] is ignored; planmethod project draws it." in done.stderr


# Options -----------------------------------------------------------------------------------------


def test_parts_position_and_formats_are_selected(tmp_path: Path) -> None:
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
    assert names == {"1-kinematics.svg", "numbers.xlsx", "numbers.ipynb", "project.json"}
    assert told["numbers"] == ["numbers.xlsx", "numbers.ipynb"]


def test_surplus_files_of_an_earlier_project_are_removed(tmp_path: Path) -> None:
    """Sheets of earlier choices do not remain beside the new ones."""
    folder = tmp_path / "homework"
    folder.mkdir()
    parts = [{"name": "kinematics", "files": ["1-kinematics.pdf"]},
             {"name": "forces", "files": ["2-forces.pdf", "../mine.txt"]}]  # fmt: skip
    (folder / "project.json").write_text(json.dumps({"problem": "homework", "parts": parts}))
    for name in ("1-kinematics.pdf", "2-forces.pdf", "project.pdf", "mine.txt", "../mine.txt"):
        (folder / name).write_text("earlier")
    asked = ("--parts", "kinematics", "--format", "svg")
    done = run(str(FILES / "homework.toml"), "-o", str(tmp_path), *asked)
    assert done.exit_code == 0, done.output
    assert {path.name for path in folder.iterdir()} == {
        "1-kinematics.svg", "numbers.xlsx", "numbers.ipynb", "project.json", "mine.txt",
    }  # fmt: skip
    assert (tmp_path / "mine.txt").exists()


def test_a_part_that_is_not_wanted_stops_no_other(tmp_path: Path) -> None:
    """A crank that rocks has a sheet of its kinematics, and no flywheel."""
    text = (FILES / "shaper.toml").read_text("utf-8")
    assert "O3B = 0.67\n" in text
    for old, new in ((r"BC = 0\.33\n", "BC = 0.015\n"), (r"force = \{.*", "force = 500"),
                     (r"(?s)\[project\].*", "")):  # fmt: skip
        text, changed = re.subn(old, new, text)
        assert changed == 1
    file = tmp_path / "my.toml"
    file.write_text(text, "utf-8")
    whole = run(str(file), "-o", str(tmp_path), "--lang", "en", "--parts", "flywheel")
    assert whole.exit_code == ExitCode.ASSEMBLY
    assert "a flywheel needs a crank that turns fully" in whole.stderr
    one = run(str(file), "-o", str(tmp_path), "--lang", "en", "--parts", "kinematics")
    assert one.exit_code == 0, one.output


@pytest.mark.usefixtures("russian")
def test_numbers_have_heads_in_the_language_and_no_rounding(tmp_path: Path) -> None:
    done = run(str(FILES / "engine.toml"), "-o", str(tmp_path), "--parts", "flywheel")
    assert done.exit_code == 0, done.output
    book = openpyxl.load_workbook(tmp_path / "engine" / "numbers.xlsx")
    places, every = (list(sheet.iter_rows(values_only=True)) for sheet in book.worksheets[:2])
    heads = [str(head) for head in every[0]]
    assert {"№", "угол кривошипа, град", "v точки B, м/с", "F B.2-3, Н"} <= {*heads}
    assert not any(re.search(r"margin|_deg|\.v[xy]?$|position|exact|read", head) for head in heads)
    for head, rows in ((places[0], places[1:]), (every[0], every[1:])):
        for name, *values in zip(head, *rows, strict=True):
            assert all(not v or abs(v) > 1e-12 for v in values if isinstance(v, float)), name
    assert places[1][places[0].index("v_B, м/с")] == 0


def test_an_earlier_project_is_replaced_and_other_files_stay(tmp_path: Path) -> None:
    folder = tmp_path / "homework"
    args = (str(FILES / "homework.toml"), "-o", str(tmp_path), "--parts", "kinematics")
    assert run(*args, "--format", "svg").exit_code == 0
    (folder / "mine.txt").write_text("mine")
    assert run(*args, "--format", "pdf").exit_code == 0
    assert {path.name for path in folder.iterdir()} == {
        "1-kinematics.pdf", "project.pdf", "numbers.xlsx", "numbers.ipynb", "project.json",
        "mine.txt",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("args", "code", "said"),
    [
        (("homework.toml", "--parts", "forces"), ExitCode.USAGE, "has no part 'forces'"),
        (("homework.toml", "--parts", "sheets"), ExitCode.USAGE, "'sheets' is not one of"),
        (
            ("homework.toml", "--position", "3"),
            ExitCode.USAGE,
            "--position: position 3 does not exist",
        ),
        (("none.toml",), ExitCode.PROBLEM, "none.toml"),
    ],
)
def test_a_faulty_request_is_reported(
    args: tuple[str, ...], code: ExitCode, said: str, tmp_path: Path
) -> None:
    done = run(str(FILES / args[0]), *args[1:], "-o", str(tmp_path), "--lang", "en")
    assert done.exit_code == code
    assert said in done.stderr
    assert not any(tmp_path.iterdir())


def test_a_train_alone_is_no_project(tmp_path: Path) -> None:
    done = run(str(ROOT / "problems/gears/gears-ex2.toml"), "-o", str(tmp_path), "--lang", "en")
    assert done.exit_code == ExitCode.USAGE
    assert "a project needs a linkage" in done.stderr


# Whole or not at all -----------------------------------------------------------------------------


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_if_a_part_fails_no_file_is_written(jobs: str, tmp_path: Path) -> None:
    """A scheme of a metre does not fit A4."""
    scales = "\n[scales]\nmu_l = 0.0002\nmu_v = 0.01\nmu_a = 0.1\n"
    text = (FILES / "homework.toml").read_text("utf-8") + scales + '[sheet]\npaper = "A4"\n'
    file, out = tmp_path / "my.toml", tmp_path / "out"
    file.write_text(text, "utf-8")
    done = run(str(file), "-o", str(out), "--jobs", jobs, "--lang", "en")
    assert done.exit_code == ExitCode.USAGE
    assert re.search(
        r"kinematics cannot be made, and no files are written: .* do not fit A4", done.stderr
    )
    assert not out.exists()


@pytest.mark.skipif(sys.platform == "win32" or os.geteuid() == 0, reason="root writes everywhere")
def test_an_unwritable_folder_is_reported(tmp_path: Path) -> None:
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
