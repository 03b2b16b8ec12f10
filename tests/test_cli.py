"""Commands, their exit codes and their output."""

from __future__ import annotations

import csv
import io
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from cases import thinned
from click.testing import CliRunner, Result
from doors import (
    LANGUAGES_LANGUAGES as LANGUAGES,
    MACHINES,
    OTHER_FAMILIES,
    PROBLEM_FAMILIES as FAMILIES,
    PROJECT_PARTS,
    PartName,
    cli,
    kinds_load,
    output_write as write,
    part_drawings,
    problem_load as load,
    settle,
)
from worked import NOT_CLOSED, ROOT, path_of

EX1, EX2, EX3 = (str(path_of(f"linkages/ex{n}")) for n in (1, 2, 3))
VARIANTS = str(path_of("levers/task12-variants"))
COMMANDS = ("sheet", "solve", "structure", "protocol", "new")
OF_PROBLEMS = ("sheet", "solve", "structure", "protocol")

FAULTY = """
title = "Ошибка"
[frame]
A = [0.0, 0.0]
[links.1]
points = ["A", "B"]
AB = -0.1
[driver]
link = "1"
phi = 0
omega = 1
"""


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def faulty(tmp_path: Path) -> str:
    path = tmp_path / "faulty.toml"
    path.write_text(FAULTY, "utf-8")
    return str(path)


@pytest.fixture
def open_chain(tmp_path: Path) -> str:
    path = tmp_path / "apart.toml"
    path.write_text('title = "Не собирается"' + NOT_CLOSED, "utf-8")
    return str(path)


def run(*args: str) -> Result:
    """Run a command in this process; an exception that would reach the user fails the test."""
    return CliRunner().invoke(cli, list(args), catch_exceptions=False)


def process(*args: str) -> subprocess.CompletedProcess[str]:
    """Run a command as a user does."""
    return subprocess.run(
        [sys.executable, str(ROOT / "cli.py"), *args],
        capture_output=True,
        encoding="utf-8",
        timeout=120,
        env={**os.environ, "PYTHONIOENCODING": "utf-8"},
    )


def files(folder: Path | str) -> list[str]:
    return sorted(path.name for path in Path(folder).iterdir())


# Help ---------------------------------------------------------------------------------------------


def test_help_names_every_command() -> None:
    shown = run("--help")
    assert shown.exit_code == 0
    for name in COMMANDS:
        assert f"  {name} " in shown.output
    assert run("-h").output == shown.output


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help(command: str) -> None:
    shown = run(command, "--help")
    assert shown.exit_code == 0
    assert shown.output.startswith(f"Usage: cli {command} ")
    assert run(command, "-h").output == shown.output


def test_version() -> None:
    shown = run("--version")
    assert shown.exit_code == 0
    assert "0.2.0" in shown.output


def test_the_launcher_is_the_same_command() -> None:
    shown = process("solve", EX1, "--json")
    assert shown.returncode == 0
    assert shown.stderr == ""
    assert shown.stdout == run("solve", EX1, "--json").stdout


# Exit codes ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("command", OF_PROBLEMS)
def test_a_problem_is_done_with_code_0(command: str) -> None:
    done = run(command, EX1)
    assert done.exit_code == 0
    assert done.output


@pytest.mark.parametrize(
    "args",
    [
        ("nonsense",),
        ("solve",),
        ("solve", EX1, "--nonsense"),
        ("solve", EX1, "--json", "--csv"),
        ("solve", EX1, "--ruler", "0"),
        ("solve", EX1, "--ruler", "-1"),
        ("solve", EX1, "--ruler", "fine"),
        ("solve", EX1, "--lang", "de"),
        ("solve", VARIANTS, "--variant", "А", "--all-variants"),
        ("protocol", EX1, "--position", "-1"),
        ("protocol", EX1, "--position", "1"),
        ("sheet", EX1, "--format", "dwg"),
        ("sheet", EX1, "--format", ""),
        ("sheet", EX1, "--paper", "A9"),
        ("sheet", EX1, "--stamp", "author"),
        ("sheet", EX1, "--stamp", "autor=Иванов"),
        ("sheet", EX1, "--dpi", "10000"),
        ("new", "nonsense"),
        ("new",),
    ],
    ids=" ".join,
)
def test_wrong_usage_is_code_2(args: tuple[str, ...]) -> None:
    refused = run(*args)
    assert refused.exit_code == 2
    assert "Error: " in refused.output
    assert "Traceback" not in refused.output
    assert not Path("out").exists()


@pytest.mark.parametrize("command", OF_PROBLEMS)
def test_a_faulty_file_is_code_3(command: str, faulty: str) -> None:
    refused = run(command, faulty)
    assert refused.exit_code == 3
    assert "links.1" in refused.output
    assert not Path("out").exists()


@pytest.mark.parametrize("command", OF_PROBLEMS)
def test_a_missing_file_is_code_3(command: str) -> None:
    refused = run(command, "absent.toml")
    assert refused.exit_code == 3
    assert "absent.toml" in refused.output
    refused = run(command, ".")
    assert refused.exit_code == 3


def test_an_unknown_variant_is_code_3() -> None:
    refused = run("solve", VARIANTS, "--variant", "Ж")
    assert refused.exit_code == 3
    assert "Ж" in refused.output


@pytest.mark.parametrize("command", ["sheet", "solve", "protocol"])
def test_an_impossible_assembly_is_code_4(command: str, open_chain: str) -> None:
    refused = run(command, open_chain)
    assert refused.exit_code == 4
    assert (
        "Error: Cannot place C at phi = 60 deg: arcs from B (0.2 m) and D (0.05 m) do not "
        "meet, |BD| = 0.3606 m. Check l_BC, l_DC. The arcs miss by 0.1106 m, by 0.25 m at "
        "most over a turn (at phi = 180 deg).\n"
    ) in refused.output
    assert not Path("out").exists()


def test_the_structure_of_an_impossible_assembly_is_printed(open_chain: str) -> None:
    told = run("structure", open_chain, "--no-drawing")
    assert told.exit_code == 0
    assert "I(0,1) → II(2,3)" in told.output


# Several problems ---------------------------------------------------------------------------------


def test_a_faulty_problem_does_not_stop_the_others(faulty: str, open_chain: str) -> None:
    done = run("solve", EX1, faulty, open_chain, EX3, "--json")
    assert done.exit_code == 3
    records = json.loads(done.stdout)
    assert [record["problem"] for record in records] == ["ex1", "ex3"]
    # All files are read before the first is solved: a fault in a file is met first.
    assert run("solve", open_chain, faulty, EX1, "--json").exit_code == 3
    assert run("solve", EX1, open_chain, "--json").exit_code == 4


def test_sheets_of_the_others_are_drawn(faulty: str) -> None:
    done = run("sheet", EX1, faulty, EX2, "--format", "svg")
    assert done.exit_code == 3
    assert files("out") == ["ex1.svg", "ex2.svg"]


def test_two_problems_are_a_list_and_one_is_an_object() -> None:
    assert [r["problem"] for r in json.loads(run("solve", EX1, EX3, "--json").stdout)] == [
        "ex1",
        "ex3",
    ]
    assert json.loads(run("solve", EX1, "--json").stdout)["problem"] == "ex1"


def test_tables_of_two_problems_follow_each_other() -> None:
    both = run("solve", EX1, EX3).output
    assert both.index("Кривошипно-ползунный механизм") < both.index("Рычажный механизм")


# Variants -----------------------------------------------------------------------------------------


def test_one_variant() -> None:
    record = json.loads(run("solve", VARIANTS, "--variant", "В", "--json").stdout)
    assert record["variant"] == "В"
    assert record["positions"][0]["phi_deg"] == 240.0


def test_all_variants_have_files_of_their_own() -> None:
    done = run("sheet", VARIANTS, "--all-variants", "--format", "svg")
    assert done.exit_code == 0
    wanted = [f"task12-variants-{v}.svg" for v in "АБВГДЕ"]
    assert files("out") == sorted(wanted)
    assert done.output.split() == [str(Path("out") / name) for name in wanted]
    assert len({(Path("out") / name).read_bytes() for name in wanted}) == 6


def test_all_variants_of_a_file_without_any_is_the_file() -> None:
    assert json.loads(run("solve", EX1, "--all-variants", "--json").stdout)["problem"] == "ex1"


# Positions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("phi", "wanted"),
    [
        ("20", [20.0]),
        ("-20.5", [-20.5]),
        ("0,30,60", [0.0, 30.0, 60.0]),
        ("0:360:90", [0.0, 90.0, 180.0, 270.0]),
        ("0:100:30", [0.0, 30.0, 60.0, 90.0]),
        ("90:0:-45", [90.0, 45.0]),
        ("0:0.3:0.1", [0.0, 0.1, 0.2]),
        ("5,0:20:10", [5.0, 0.0, 10.0]),
        (" 7 , 8 ", [7.0, 8.0]),
        ("1e2", [100.0]),
    ],
)
def test_other_positions(phi: str, wanted: list[float]) -> None:
    done = run("solve", EX1, "--phi", phi, "--json")
    assert done.exit_code == 0
    got = [entry["phi_deg"] for entry in json.loads(done.stdout)["positions"]]
    assert got == pytest.approx(wanted, abs=1e-12)


@pytest.mark.parametrize(
    ("phi", "message"),
    [
        ("north", "'north' is neither a number nor from:to:step"),
        ("0,5", None),  # two positions, no decimal comma
        ("", "'' is neither a number nor from:to:step"),
        ("1,,2", "'' is neither a number nor from:to:step"),
        ("0:360", "'0:360' is not from:to:step with a step that is not 0"),
        ("0:360:0", "'0:360:0' is not from:to:step with a step that is not 0"),
        ("0:1:2:3", "is not from:to:step"),
        ("0:360:-30", "'0:360:-30' gives 0 positions"),
        ("30:30:10", "'30:30:10' gives 0 positions"),
        ("0:1e8:1", "gives 100000000 positions"),
        ("0:600000:1,0:600000:1", "more than 1000000 positions"),
        ("nan", "'nan' is neither a number nor from:to:step"),
        ("inf", "'inf' is neither a number nor from:to:step"),
        ("1e12", "'1e12' is out of range"),
        ("20°", "'20°' is neither a number nor"),
    ],
)
def test_bad_positions(phi: str, message: str | None) -> None:
    done = run("solve", EX1, "--phi", phi, "--json")
    if message is None:
        assert [p["phi_deg"] for p in json.loads(done.stdout)["positions"]] == [0.0, 5.0]
        return
    assert done.exit_code == 2
    assert message in done.output.replace("\n", " ")


def test_positions_of_a_driving_slider_are_metres() -> None:
    run("new", "driving-slider", "d.toml")
    (asked,) = (load(Path("d.toml")).drive.positions[0],)
    record = json.loads(run("solve", "d.toml", "--json", "--phi", repr(asked)).stdout)
    assert record["positions"][0]["s"] == asked
    assert "phi_deg" not in record["positions"][0]


def test_a_ruler() -> None:
    record = json.loads(run("solve", EX1, "--ruler", "1", "--json").stdout)
    assert record["positions"][0]["hand"]["ruler"] == 1.0
    segment = record["positions"][0]["plans"]["velocity"]["segments"]["b-c"]
    assert segment["read"] == 31.0


# Tables -------------------------------------------------------------------------------------------


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_csv_to_the_terminal_is_the_record() -> None:
    done = run("solve", EX3, "--phi", "20,50", "--csv")
    assert done.exit_code == 0
    table = rows(done.stdout)
    record = json.loads(run("solve", EX3, "--phi", "20,50", "--json").stdout)
    assert len(table) == 2
    for row, entry in zip(table, record["positions"], strict=True):
        assert float(row["phi_deg"]) == entry["phi_deg"]
        for point, values in entry["points"].items():
            for key, value in values.items():
                assert float(row[f"{point}.{key}"]) == pytest.approx(value, rel=1e-15, abs=0)
        for link, values in entry["links"].items():
            for key, value in values.items():
                assert float(row[f"{link}.{key}"]) == value


def test_csv_to_a_file() -> None:
    done = run("solve", EX1, "--csv", "table.csv")
    assert done.exit_code == 0
    assert done.output == "table.csv\n"
    assert Path("table.csv").read_text("utf-8") == run("solve", EX1, "--csv", "-").stdout


def test_csv_does_not_write_over_a_problem() -> None:
    """``--csv ex1.toml``: the file was meant to be solved."""
    shutil.copy(EX1, "ex1.toml")
    before = Path("ex1.toml").read_bytes()
    refused = run("solve", EX2, "--csv", "ex1.toml")
    assert refused.exit_code == 2
    assert "would overwrite the problem file ex1.toml" in refused.output
    assert Path("ex1.toml").read_bytes() == before
    assert files(".") == ["ex1.toml"]


def test_tables_in_two_languages() -> None:
    russian, english = (run("solve", EX1, "--lang", lang).output for lang in ("ru", "en"))
    assert russian != english == run("--lang", "en", "solve", EX1).output
    assert "Формула строения" in russian
    assert "Формула строения" not in english
    assert "Structural formula" in english
    for text in (russian, english):
        assert "I(0,1) → II(2,3)" in text


# Structure and protocol ---------------------------------------------------------------------------


def test_structure_as_text_drawing_and_object() -> None:
    done = run("structure", EX3)
    assert done.exit_code == 0
    assert "I(0,1) → II(2,3) → II(4,5)" in done.output
    assert files("out") == ["ex3-structure.svg"]
    assert done.output.endswith("ex3-structure.svg\n")
    record = json.loads(run("structure", EX3, "--json").stdout)
    assert set(record) == {"schema", "problem", "structure"}
    solved = json.loads(run("solve", EX3, "--json").stdout)
    assert record["structure"].items() >= solved["structure"].items()
    first, *others = record["structure"]["self_aligning"]["schemes"]
    assert first["A 0-1"] == "1v" and len(others) == 5
    assert set(first) == {row["pair"] for row in record["structure"]["pairs"]}


def test_structure_without_a_drawing() -> None:
    assert run("structure", EX3, "--no-drawing").exit_code == 0
    assert not Path("out").exists()


def test_structure_in_english() -> None:
    told = run("structure", EX3, "--no-drawing", "--lang", "en").output
    assert "Mobility" in told or "mobility" in told
    assert "RPR" in told


def test_a_protocol_of_a_position() -> None:
    told = run("protocol", EX1, "--phi", "60,90", "--position", "1").output
    assert "90°" in told
    assert told != run("protocol", EX1, "--phi", "60,90", "--position", "0").output


def test_a_protocol_in_a_file() -> None:
    done = run("protocol", EX1, "-o", "notes")
    assert done.exit_code == 0
    assert files("notes") == ["ex1-protocol.txt"]
    assert Path("notes/ex1-protocol.txt").read_text("utf-8") == run("protocol", EX1).output


def test_a_protocol_as_markdown() -> None:
    assert run("protocol", EX1, "--format", "md", "-o", "notes", "--lang", "ru").exit_code == 0
    assert Path("notes/ex1-protocol.md").read_text("utf-8").startswith("# Протокол")


# New ----------------------------------------------------------------------------------------------


def test_the_families_are_listed() -> None:
    shown = run("new", "--list")
    assert shown.exit_code == 0
    listed = [line.split()[0] for line in shown.output.splitlines()]
    assert listed == [*FAMILIES, *OTHER_FAMILIES]


@pytest.mark.parametrize("family", OTHER_FAMILIES)
def test_a_new_train_or_point_is_ready_to_solve(family: str) -> None:
    assert run("new", family, "mine.toml").exit_code == 0
    text = Path("mine.toml").read_text("utf-8")
    assert text.count("#") >= 5  # it is commented
    assert run("solve", "mine.toml", "--json").exit_code == 0
    Path("mine.toml").write_text(text.replace("# [v", "[v").replace('# "', '"'), "utf-8")
    assert run("solve", "mine.toml", "--variant", "B").exit_code == 0


@pytest.mark.parametrize("family", thinned(FAMILIES, 3))
def test_a_new_problem_is_ready_to_solve(family: str) -> None:
    done = run("new", family, "mine.toml")
    assert done.exit_code == 0
    assert done.output == "mine.toml\n"
    text = Path("mine.toml").read_text("utf-8")
    assert text.count("#") >= 5  # it is commented
    assert run("solve", "mine.toml", "--json").exit_code == 0
    assert run("structure", "mine.toml", "--no-drawing").exit_code == 0
    assert run("protocol", "mine.toml").exit_code == 0
    assert run("sheet", "mine.toml", "--format", "svg").exit_code == 0


@pytest.mark.dear
@pytest.mark.parametrize("family", MACHINES)
def test_a_new_machine_is_one_from_the_loads_to_the_flywheel(family: str) -> None:
    """Its loads resist the machine (an engine's drive it), and its flywheel can be made."""
    assert run("new", family, "mine.toml").exit_code == 0
    text = Path("mine.toml").read_text("utf-8")
    done = run("solve", "mine.toml", "--json")
    assert done.exit_code == 0
    assert not done.stderr
    told = json.loads(done.stdout)["machine"]
    assert told["work_per_cycle"] > 0
    wheel = told["flywheel"]
    assert 0.1 < wheel["b"] / wheel["D"] < 0.3
    assert 0.2 < wheel["D"] < 1.2
    assert wheel["m"] < 500
    for layout in ("forces", "coursework"):
        drawn = run("sheet", "mine.toml", "--layout", layout, "--format", "svg")
        assert drawn.exit_code == 0, drawn.output
    varied = re.sub(r"# (\[variants|driver\.|loads\.)", r"\1", text)
    Path("mine.toml").write_text(varied, "utf-8")
    assert run("solve", "mine.toml", "--variant", "B").exit_code == 0


def test_a_new_project_has_all_parts_and_its_train_drives_the_crank() -> None:
    assert run("new", "project", "mine.toml").exit_code == 0
    path = Path("mine.toml")
    made = settle(kinds_load(path), path)
    absent = {"synthesis", "balancing", "note"}
    wanted = [part for part in PROJECT_PARTS if part not in absent]
    assert [part.name.value for part in made.parts] == wanted
    assert made.problem.drive.rate == pytest.approx(80 * math.pi / 30)
    wheels = path.read_text("utf-8")
    z = [int(found) for found in re.findall(r"\b[45] = (\d+)", wheels)]
    assert f"z = {z}" in wheels  # the meshing is that of the last pair
    (pair,) = (part for part in made.parts if part.name is PartName.MESHING)
    assert part_drawings(made, pair, {})
    assert made.strokes is not None and (made.strokes.K_v or 0.0) > 1


def test_a_new_problem_is_reported_in_the_current_language() -> None:
    for family in (*FAMILIES, *OTHER_FAMILIES):
        texts = {}
        for lang in LANGUAGES:
            assert run("new", family, f"{lang}.toml", "--lang", lang, "--force").exit_code == 0
            texts[lang] = Path(f"{lang}.toml").read_text("utf-8")
        assert not re.search("[а-яё]", texts["en"], re.IGNORECASE), family
        assert texts["en"].count("#") == texts["ru"].count("#")
        russian, english = map(tomllib.loads, (texts["ru"], texts["en"]))
        for texts_of in (russian, english):
            del texts_of["title"]
            texts_of.pop("stamp", None)
            for acting in texts_of.get("loads", ()):
                del acting["name"]
        assert russian == english, family


def test_a_new_problem_has_the_familys_name_and_overwrites_no_file() -> None:
    assert run("new", "four-bar").exit_code == 0
    assert files(".") == ["four-bar.toml"]
    Path("four-bar.toml").write_text("mine", "utf-8")
    refused = run("new", "four-bar")
    assert refused.exit_code == 2
    assert "four-bar.toml exists; name another file or give --force" in refused.output
    assert Path("four-bar.toml").read_text("utf-8") == "mine"
    assert run("new", "four-bar", "--force").exit_code == 0
    assert Path("four-bar.toml").read_text("utf-8") != "mine"


def test_a_mistyped_family_comes_with_the_nearest() -> None:
    refused = run("new", "fourbar")
    assert refused.exit_code == 2
    assert "no family 'fourbar'; did you mean 'four-bar'?" in refused.output
    assert "did you mean 'linkages-2.1.45'?" in run("new", "2.1.45").output


# Files --------------------------------------------------------------------------------------------


def test_sheets_are_written_to_the_requested_folder() -> None:
    done = run("sheet", EX1, "-o", "a/b", "--format", "SVG, pdf,svg")
    assert done.exit_code == 0
    assert files("a/b") == ["ex1.pdf", "ex1.svg"]
    assert set(done.output.split()) == {str(Path("a/b/ex1.svg")), str(Path("a/b/ex1.pdf"))}
    assert Path("a/b/ex1.pdf").read_bytes().startswith(b"%PDF-")


def test_png() -> None:
    assert run("sheet", EX1, "--format", "png", "--dpi", "30").exit_code == 0
    assert Path("out/ex1.png").read_bytes().startswith(b"\x89PNG")


def test_the_paper_may_be_named_in_cyrillic() -> None:
    assert run("sheet", EX1, "--format", "svg", "--paper", "A2").exit_code == 0
    latin = Path("out/ex1.svg").read_bytes()
    for name in ("А2", "а2", "a2"):
        assert run("sheet", EX1, "--format", "svg", "--paper", name).exit_code == 0
        assert Path("out/ex1.svg").read_bytes() == latin
    assert b'width="594mm"' in latin


def test_an_unknown_format_is_reported_with_the_known_ones() -> None:
    refused = run("sheet", EX1, "--format", "svg,dwg")
    assert refused.exit_code == 2
    assert "'dwg' is not one of svg, pdf, png, dxf" in refused.output.replace("\n", " ")
    refused = run("sheet", EX1, "--paper", "A9")
    assert "Unknown paper format 'A9'. Choose A4, A3, A2, A1, A0" in refused.output


def test_a_field_of_the_title_block() -> None:
    done = run("sheet", EX1, "--format", "svg", "--stamp", "author=Сидоров", "--stamp", "sheet=7")
    assert done.exit_code == 0
    assert "Сидоров" in Path("out/ex1.svg").read_text("utf-8")
    refused = run("sheet", EX1, "--stamp", "autor=Сидоров")
    assert "author" in refused.output  # the nearest name


def test_a_file_in_the_place_of_the_folder() -> None:
    Path("taken").write_text("mine", "utf-8")
    refused = run("sheet", EX1, "-o", "taken")
    assert refused.exit_code == 2
    assert Path("taken").read_text("utf-8") == "mine"
    refused = run("sheet", EX1, "-o", "taken/deeper", "--format", "svg")
    assert refused.exit_code == 2
    assert "a part of the path is a file, not a directory" in refused.output


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_without_permission() -> None:
    Path("locked").mkdir(mode=0o555)
    refused = run("sheet", EX1, "-o", "locked", "--format", "svg")
    assert refused.exit_code == 2
    assert "no permission. Choose another directory with --out" in refused.output
    assert files("locked") == []


def test_a_name_that_is_a_folder() -> None:
    Path("out/ex1.svg").mkdir(parents=True)
    refused = run("sheet", EX1, "--format", "svg")
    assert refused.exit_code == 2
    assert "it is a directory" in refused.output


def test_no_file_is_left_of_a_sheet_that_failed(open_chain: str) -> None:
    assert run("sheet", open_chain, EX1, "--format", "svg,pdf").exit_code == 4
    assert files("out") == ["ex1.pdf", "ex1.svg"]


def test_writing_again_gives_the_same_bytes() -> None:
    run("sheet", EX1, "--format", "svg,pdf")
    before = {name: (Path("out") / name).read_bytes() for name in files("out")}
    run("sheet", EX1, "--format", "svg,pdf")
    assert {name: (Path("out") / name).read_bytes() for name in files("out")} == before


def test_write_creates_the_folders_of_a_file(tmp_path: Path) -> None:
    write(tmp_path / "x" / "y.txt", b"text")
    assert (tmp_path / "x" / "y.txt").read_bytes() == b"text"


# Processes ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("args", [("solve", EX1, "--json"), ("protocol", EX3), ("solve", EX3)])
@pytest.mark.skipif(sys.platform == "win32", reason="pipes of a POSIX shell")
def test_a_pipe_closed_by_its_reader_is_no_error(args: tuple[str, ...]) -> None:
    """Case: ``planmethod solve ... --json | head -c 10``."""
    many = ("--phi", "0:360:2") if args[0] == "solve" else ()
    with subprocess.Popen(
        [sys.executable, str(ROOT / "cli.py"), *args, *many],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env={**os.environ, "PYTHONIOENCODING": "utf-8"},
    ) as running:
        assert running.stdout is not None and running.stderr is not None
        assert len(running.stdout.read(10)) == 10
        running.stdout.close()
        said = running.stderr.read().decode()
        running.wait(timeout=60)
    assert said == ""


def test_no_traceback_reaches_a_user(faulty: str, open_chain: str) -> None:
    for args, code in (
        (("solve", faulty), 3),
        (("solve", open_chain), 4),
        (("solve", EX1, "--phi", "x"), 2),
        (("sheet", EX1, "--paper", "A9"), 2),
    ):
        done = process(*args)
        assert done.returncode == code
        assert done.stdout == ""
        assert "Traceback" not in done.stderr
        assert "Error: " in done.stderr


def test_an_internal_error_is_code_5(tmp_path: Path) -> None:
    """Any internal error is reported in one line."""
    done = subprocess.run(
        [
            sys.executable,
            "-c",
            "import sys, planmethod.problem.reader, planmethod.cli\n"
            "def load(*a, **k): raise KeyError('oops')\n"
            "planmethod.problem.reader.load_each = load\n"
            f"sys.argv = ['planmethod', 'solve', {EX1!r}]\n"
            "planmethod.cli.main()",
        ],
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == 5
    assert done.stderr == (
        "Internal error in planmethod (KeyError: 'oops'). Please report the problem file and "
        "the command.\n"
    )


@pytest.mark.parametrize("paper", ["A0", "A4x3", "A4x4", "A3x3", "A2x3", "A1x3"])
def test_other_formats_of_the_standard_are_drawn_or_rejected(paper: str) -> None:
    assert run("sheet", EX1, "--paper", paper, "--format", "svg").exit_code in (0, 2)


@pytest.mark.parametrize("paper", ["A4", "A3", "A2", "A1"])
def test_several_positions_on_every_format(paper: str) -> None:
    done = run("sheet", EX1, "--paper", paper, "--phi", "0,30", "--format", "svg")
    assert done.exit_code in (0, 2)


def test_a_sheet_of_too_many_positions_is_rejected_at_once() -> None:
    result = run("sheet", EX1, "--phi", "0:360:1")
    assert result.exit_code == 2
    assert "at most 120 positions, 360 are requested" in result.stderr
    assert "solve --csv" in result.stderr


def test_a_ruler_that_is_not_a_number() -> None:
    result = run("solve", EX1, "--ruler", "nan")
    assert result.exit_code == 2
    assert "'nan' is not a number" in result.stderr


def in_encoding(encoding: str, *commands: list[str]) -> subprocess.CompletedProcess[bytes]:
    """Run commands one after the other in one process until one fails."""
    program = (
        "import sys\n"
        "from planmethod.__main__ import main\n"
        f"for args in {commands!r}:\n"
        "    sys.argv = ['planmethod', *args]\n"
        "    try:\n"
        "        main()\n"
        "    except SystemExit as done:\n"
        "        if done.code:\n"
        "            raise\n"
    )
    return subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        check=False,
        env={**os.environ, "PYTHONIOENCODING": encoding, "PYTHONPATH": str(ROOT)},
    )


@pytest.mark.parametrize("encoding", ["cp1251", "cp866", "ascii"])
def test_consoles_with_few_letters(encoding: str) -> None:
    result = in_encoding(
        encoding,
        ["solve", EX1],
        ["protocol", EX1],
        ["structure", EX1, "--no-drawing"],
        ["solve", EX1, "--json"],
    )
    assert result.returncode == 0, result.stderr
    record = result.stdout[result.stdout.index(b"{") :]  # the json keeps its letters
    plans = json.loads(record)["positions"][0]["plans"]
    assert "π-c" in plans["acceleration"]["segments"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")
def test_a_full_device_is_reported() -> None:
    with Path("/dev/full").open("w") as full:
        result = subprocess.run(
            [sys.executable, str(ROOT / "cli.py"), "solve", EX1],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert result.returncode == 2
    assert result.stderr.startswith("Error: cannot write the output: no space left")


def test_variants_in_one_csv_are_distinguished() -> None:
    result = run("solve", VARIANTS, "--all-variants", "--csv")
    rows = list(csv.DictReader(result.stdout.splitlines()))
    assert [row["variant"] for row in rows] == ["А", "Б", "В", "Г", "Д", "Е"]
    assert {row["problem"] for row in rows} == {"task12-variants"}
