"""``solve`` in many positions: tables in blocks, arrays, requested columns, empty cells."""

from __future__ import annotations

import csv
import io
import os
import shutil
import sys
import zipfile
from pathlib import Path
from typing import Any

import click
import numpy as np
import pytest
from click.testing import CliRunner, Result
from doors import (
    COMMANDS,
    MOTION,
    POSITIONS_BLOCK as BLOCK,
    POSITIONS_SAMPLE as SAMPLE,
    Cause,
    Failure,
    Gaps,
    ModelProblem as Problem,
    Place,
    Solution,
    Sweep,
    bar,
    cli,
    csv_rows,
    evenly,
    large_table,
    many_positions as many,
    positions_examine as examine,
    problem_load as load,
)
from msgspec.structs import replace
from worked import DEAD, path_of

EX1, EX2, EX3 = (str(path_of(f"linkages/ex{n}")) for n in (1, 2, 3))
SIX_LINK = str(path_of("levers/six-link"))
VARIANTS = str(path_of("levers/task12-variants"))

SPOILT = "179.999"
TURN = load(Path(EX1)).drive.coordinate


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("dead.toml").write_text(DEAD, "utf-8")
    Path("faulty.toml").write_text(DEAD.replace("AB = 1.0", "AB = -1.0"), "utf-8")


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, list(args), catch_exceptions=False)


def done(*args: str) -> str:
    result = run(*args)
    assert result.exit_code == 0, result.output
    return result.stdout


def refused(code: int, *args: str) -> str:
    """Run a command that is rejected; return its message, in one line."""
    before = sorted(path.name for path in Path().iterdir())
    result = run(*args)
    assert result.exit_code == code, result.output
    assert sorted(path.name for path in Path().iterdir()) == before
    return " ".join(result.stderr.split())


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def arrays(*args: str) -> dict[str, Any]:
    assert done("solve", *args, "--npz", "a.npz") == "a.npz\n"
    with np.load("a.npz") as found:
        return dict(found)


# Arrays -------------------------------------------------------------------------------------------


def test_arrays_are_the_columns_of_the_table() -> None:
    found = arrays(EX3, "--phi", "0:360:10")
    table = rows(done("solve", EX3, "--phi", "0:360:10", "--csv"))
    assert found["phi_deg"].tolist() == [10.0 * k for k in range(36)]
    assert found["reason"].dtype == np.int16
    assert found["reason"].tolist() == [-1] * 36
    assert found["reasons"].tolist() == []
    named = [row.name for row in Sweep(load(Path(EX3))).rows]
    assert list(found) == ["phi_deg", *named, "reason", "reasons"]
    for name in ("B.x", "E.vx", "E.ax", "3.omega", "4.epsilon"):
        wanted = np.array([float(row[name]) for row in table])
        assert found[name] == pytest.approx(wanted, rel=1e-12, abs=1e-12 * np.abs(wanted).max())


def test_arrays_of_the_files_own_positions() -> None:
    assert arrays(EX1)["phi_deg"].tolist() == list(load(Path(EX1)).drive.positions)


def test_positions_of_a_slider_are_called_s() -> None:
    done("new", "driving-slider", "d.toml")
    found = arrays("d.toml")
    assert found["s"].tolist() == list(load(Path("d.toml")).drive.positions)
    assert "phi_deg" not in found


def test_the_same_arrays_are_the_same_bytes() -> None:
    arrays(EX3, "--phi", "0:360:10")
    first = Path("a.npz").read_bytes()
    os.utime("a.npz", (1, 1))
    arrays(EX3, "--phi", "0:360:10")
    assert Path("a.npz").read_bytes() == first
    with zipfile.ZipFile("a.npz") as whole:
        for member in whole.infolist():
            assert member.date_time == (1980, 1, 1, 0, 0, 0)
            assert member.create_system == 3


def test_variants_share_a_file() -> None:
    found = arrays(VARIANTS, "--all-variants", "--ask", "v_D,omega_3")
    assert {name.partition(":")[0] for name in found} == set("АБВГДЕ")
    assert found["А:phi_deg"].tolist() == [60.0]
    assert found["В:phi_deg"].tolist() == [240.0]
    assert "А:3.omega" in found and "А:D.vx" in found and "А:reason" in found
    one = arrays(VARIANTS, "--variant", "В", "--ask", "v_D,omega_3")
    assert one["3.omega"] == found["В:3.omega"]


def test_problems_share_a_file() -> None:
    found = arrays(EX1, EX3, "--phi", "0,30")
    assert {name.partition(":")[0] for name in found} == {"ex1", "ex3"}
    assert found["ex3:E.x"].shape == (2,)
    both = arrays(EX1, VARIANTS, "--all-variants", "--ask", "positions")
    assert {"ex1:B.x", "task12-variants-Б:B.x"} <= set(both)


def test_problems_of_one_name_do_not_share_a_file() -> None:
    Path("deeper").mkdir()
    shutil.copy("dead.toml", "deeper/dead.toml")
    said = refused(2, "solve", "dead.toml", "deeper/dead.toml", "--npz", "a.npz")
    assert "two problems have the name dead" in said


def test_a_file_of_arrays_is_whole_or_not_there() -> None:
    assert "faulty" in refused(3, "solve", EX1, "faulty.toml", "--npz", "a.npz")
    assert refused(4, "solve", EX1, SIX_LINK, "--phi", "0", "--npz", "a.npz")
    Path("a.npz").write_text("before", "utf-8")
    refused(3, "solve", EX1, "faulty.toml", "--npz", "a.npz")
    assert Path("a.npz").read_text("utf-8") == "before"


def test_a_file_of_arrays_that_cannot_be_written() -> None:
    Path("taken").write_text("mine", "utf-8")
    Path("folder").mkdir()
    assert "it is a directory" in refused(2, "solve", EX1, "--npz", "folder")
    assert "a file, not a directory" in refused(2, "solve", EX1, "--npz", "taken/a.npz")
    assert "a file, not a directory" in refused(2, "solve", EX1, "--csv", "taken/a.csv")
    assert Path("taken").read_text("utf-8") == "mine"


def test_failed_arrays_leave_no_file(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*args: object, **kwargs: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np.lib.format, "write_array", broken)
    monkeypatch.setattr(zipfile.ZipFile, "writestr", broken)
    assert "no space left on the device" in refused(2, "solve", EX1, "--npz", "a.npz")


def test_too_many_numbers_for_one_file(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("planmethod.linkages.solving.MAX_NUMBERS", 1000)
    said = refused(2, "solve", EX3, "--phi", "0:360:1", "--npz", "a.npz")
    assert "the limit is 1000" in said and "--ask" in said
    assert "phi_deg" in arrays(EX3, "--phi", "0:360:1", "--ask", "omega_3")


# Requested columns --------------------------------------------------------------------------------


def test_requested_columns_keep_the_order_of_the_request() -> None:
    table = rows(done("solve", EX3, "--phi", "0:360:30", "--ask", "omega_3, v_E,B", "--csv"))
    assert list(table[0]) == ["position", "phi_deg", "3.omega", "E.vx", "E.vy", "B.x", "B.y"]
    whole = rows(done("solve", EX3, "--phi", "0:360:30", "--csv"))
    for row, wanted in zip(table, whole, strict=True):
        assert row["position"] == wanted["position"]
        assert row["phi_deg"] == wanted["phi_deg"]
        assert float(row["E.vx"]) == pytest.approx(float(wanted["E.vx"]), rel=1e-12, abs=1e-13)
        assert not any(cell.startswith("-0.0") and float(cell) == 0 for cell in row.values())


def test_requested_results_as_a_table() -> None:
    text = done("solve", EX3, "--phi", "0:360:90", "--ask", "v_E,omega_3", "--lang", "ru")
    assert "E.vx" in text and "3.omega" in text and "E.ax" not in text
    cells = [line.split() for line in text.splitlines()]
    assert ["1", "90", "−4,046", "0", "18,39"] in cells
    english = done("solve", EX3, "--phi", "0:360:90", "--ask", "v_E,omega_3", "--lang", "en")
    assert ["1", "90", "−4.046", "0", "18.39"] in [line.split() for line in english.splitlines()]
    assert max(map(len, text.splitlines())) <= 100


def test_whole_groups_may_be_requested() -> None:
    (row,) = rows(done("solve", EX1, "--ask", "velocities", "--csv"))
    assert "2.omega" in row and "B.vx" in row
    assert not {"B.x", "B.ax", "2.epsilon", "margin"} & set(row)


def test_requested_columns_of_variants_are_one_table() -> None:
    table = rows(done("solve", VARIANTS, "--all-variants", "--ask", "omega_3", "--csv"))
    assert [row["variant"] for row in table] == list("АБВГДЕ")


def test_an_unknown_result_comes_with_the_nearest() -> None:
    for form in (("--csv", "t.csv"), ("--npz", "a.npz"), ()):
        said = refused(2, "solve", EX3, "--ask", "v_E,omega3", *form)
        assert f"{EX3}: no result 'omega3'; did you mean 'omega_3'?" in said


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("--json", "--npz", "a.npz"), "give --json or --npz, not both"),
        (("--csv", "--npz", "a.npz"), "give --csv or --npz, not both"),
        (("--json", "--ask", "v_B"), "--json prints all results"),
        (("--json", "--partial", "--referee"), "--referee verifies only positions that exist"),
        (("--partial",), "--partial requires --json, --csv, --npz or --ask"),
        (("--npz", "b.toml"), "--npz would overwrite the problem file b.toml"),
        (("--npz", "-"), "--npz requires the name of a file"),
        (("--npz", ""), "--npz requires the name of a file"),
        (("--ask", " , "), "no result is named"),
        (("--phi", "0:2e6:1", "--json"), "more than 1000000 positions"),
        (("--phi", "0:2e6:1", "--csv", "t.csv"), "more than 1000000 positions"),
        (("--phi", "0:2e7:1", "--npz", "a.npz"), "gives 20000000 positions"),
        (
            ("--phi", "0:20000:1", "--ask", "v_B"),
            "a table of 20000 rows is too long for the terminal",
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_options_that_do_not_go_together(args: tuple[str, ...], message: str) -> None:
    assert message in refused(2, "solve", EX1, *args)


def test_a_range_shorter_than_its_step_is_one_position() -> None:
    assert [row["phi_deg"] for row in rows(done("solve", EX1, "--phi", "0:1e-12:1", "--csv"))] == [
        "0.0"
    ]


# Impossible positions -----------------------------------------------------------------------------


def test_an_error_suggests_partial_where_several_positions_are_requested() -> None:
    for form in ((), ("--csv",), ("--json",), ("--npz", "a.npz"), ("--ask", "omega_3")):
        several = refused(4, "solve", SIX_LINK, "--phi", "0:360:30", *form)
        assert "Cannot place C at position 0 (phi = 0 deg)" in several
        assert "The same holds at 5 more of 12 positions." in several
        assert several.endswith("give --partial with --json, --csv, --npz or --ask.")
        assert "--partial" not in refused(4, "solve", SIX_LINK, "--phi", "0", *form)


def test_other_commands_do_not_speak_of_partial() -> None:
    assert "--partial" not in refused(4, "protocol", SIX_LINK, "--phi", "0:360:30")


def warned(*args: str) -> tuple[str, str]:
    """Run a command that warns once; return its output and the warning."""
    result = run(*args)
    assert result.exit_code == 0, result.output
    (line,) = result.stderr.splitlines()
    assert line.startswith(f"Warning: {SIX_LINK}: 6 of 12 positions are impossible, left empty. ")
    assert "Cannot place C at position 0 (phi = 0 deg)" in line
    return result.stdout, line


def test_impossible_positions_are_empty_cells_with_a_reason() -> None:
    text, _ = warned("solve", SIX_LINK, "--phi", "0:360:30", "--csv", "--partial")
    table = rows(text)
    assert list(table[0])[-1] == "reason"
    whole = rows(done("solve", SIX_LINK, "--phi", "150:330:30", "--csv"))
    assert [row["position"] for row in table] == [str(k) for k in range(12)]
    for row in table[5:11]:
        assert row["reason"] == ""
        (same,) = [other for other in whole if other["phi_deg"] == row["phi_deg"]]
        assert {k: v for k, v in row.items() if k not in ("position", "reason")} == {
            k: v for k, v in same.items() if k != "position"
        }
    for row in (*table[:5], table[11]):
        told = "Cannot place C: arcs from B (0.3 m) and D (0.15 m) do not meet."
        assert row["reason"] == told
        filled = {name for name, cell in row.items() if cell}
        assert filled == {"position", "phi_deg", "reason"}


def test_impossible_positions_are_nan_with_a_reason() -> None:
    warned("solve", SIX_LINK, "--phi", "0:360:30", "--npz", "a.npz", "--partial")
    with np.load("a.npz") as found:
        assert found["reason"].tolist() == [0] * 5 + [-1] * 6 + [0]
        (sentence,) = found["reasons"].tolist()
        assert sentence.startswith("Cannot place C at position 0 (phi = 0 deg)")
        assert np.array_equal(np.isnan(found["C.x"]), found["reason"] >= 0)
        assert np.isfinite(found["B.x"]).all()  # the crank turns on


def test_requested_cells_that_exist_are_filled() -> None:
    args = ("solve", SIX_LINK, "--phi", "0:360:30", "--ask", "omega_3,B", "--partial")
    text, _ = warned(*args, "--csv")
    table = rows(text)
    assert table[0]["3.omega"] == "" and table[0]["B.x"] == "0.1"
    assert table[0]["reason"] and not table[6]["reason"]
    shown, _ = warned(*args)
    assert ["0", "0", "—", "0.1000", "0"] in [line.split() for line in shown.splitlines()]
    assert "Cannot place C at position 0" in shown


def test_no_note_is_printed_where_every_position_exists() -> None:
    result = run("solve", EX3, "--phi", "0:360:30", "--csv", "--partial")
    assert result.exit_code == 0 and result.stderr == ""
    table = rows(result.stdout)
    assert {row.pop("reason") for row in table} == {""}
    assert table == rows(done("solve", EX3, "--phi", "0:360:30", "--csv"))


@pytest.mark.parametrize("form", [("--csv",), ("--npz", "a.npz"), ("--ask", "omega_3")])
def test_a_turn_without_any_possible_position(form: tuple[str, ...]) -> None:
    result = run("solve", SIX_LINK, "--phi", "0,30", *form, "--partial")
    assert result.exit_code == 0
    assert "2 of 2 positions are impossible" in result.stderr
    if form == ("--csv",):
        header = list(rows(done("solve", SIX_LINK, "--phi", "150", "--csv"))[0])
        table = rows(result.stdout)
        assert list(table[0]) == [*header, "reason"]
        assert [row["C.x"] for row in table] == ["", ""]


def test_positions_that_rounding_spoils_are_impossible_too() -> None:
    phi = f"45,{SPOILT},90"
    for form in (("--csv",), ("--npz", "a.npz")):
        said = refused(4, "solve", "dead.toml", "--phi", phi, *form)
        assert "position 1 (phi = 179.999 deg) is so near a dead position" in said
        result = run("solve", "dead.toml", "--phi", phi, *form, "--partial")
        assert result.exit_code == 0
        assert "1 of 3 positions is impossible and left empty" in result.stderr
        assert "position 1 (phi = 179.999 deg) is so near" in result.stderr
    with np.load("a.npz") as found:
        assert found["reason"].tolist() == [-1, 0, -1]
        assert np.isnan(found["3.omega"]).tolist() == [False, True, False]


def test_a_doubt_about_the_requested_result_alone_is_a_warning() -> None:
    """The place is good although the velocity is not: a warning, no refusal."""
    result = run("solve", "dead.toml", "--phi", f"45,{SPOILT}", "--ask", "C", "--csv")
    assert result.exit_code == 0
    assert "position 1 (phi = 179.999 deg) is so near" in result.stderr
    assert float(rows(result.stdout)[1]["C.x"]) == pytest.approx(0.5, abs=1e-6)
    dead = run("solve", "dead.toml", "--phi", "45,180", "--ask", "C", "--csv")
    assert dead.exit_code == 0 and dead.stderr == ""
    assert "dead position" in refused(4, "solve", "dead.toml", "--phi", "45,180", "--ask", "v_C")


def test_an_impossible_mechanism_is_rejected_with_partial_too() -> None:
    Path("apart.toml").write_text(DEAD.replace("DC = 2.5", "DC = 0.1"), "utf-8")
    for form in (("--csv",), ("--npz", "a.npz"), ("--ask", "v_C")):
        said = refused(4, "solve", "apart.toml", "--phi", "0,30", *form, "--partial")
        assert "Cannot place C at phi = 45 deg" in said


# Blocks -------------------------------------------------------------------------------------------


def test_a_large_table_is_the_small_ones_beside_each_other(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Solved in blocks, with one set of scales."""
    problem, degrees = load(Path(EX3)), [float(k) for k in range(360)]
    header, wanted = csv_rows(Solution(problem, positions=degrees))
    monkeypatch.setattr(many, "BLOCK", 100)
    examined: list[int] = []

    def counted(problem: Problem, *, positions: list[float], **drawn: Any) -> Solution:
        examined.append(len(positions))
        return Solution(problem, positions=positions, **drawn)

    monkeypatch.setattr(many, "Solution", counted)
    gaps = examine(problem, np.radians(degrees)).gaps
    assert examined == [100, 100, 100, 60]
    large = large_table(problem, np.radians(degrees), gaps, ruler=0.5, partial=False)
    assert [len(rows) for rows in large.blocks()] == [100, 100, 100, 60]
    text = done("solve", EX3, "--phi", "0:360:1", "--csv", "-")
    found = list(csv.reader(io.StringIO(text)))
    assert found[0] == header
    assert [row[0] for row in found[1:]] == [str(k) for k in range(360)]
    numbers, table = np.array(found[1:], dtype=float), np.array(wanted, dtype=float)
    exact = [k for k, name in enumerate(header) if not name.endswith(".read")]
    size = np.abs(table).max(axis=0)
    assert (np.abs(numbers - table)[:, exact] <= 1e-12 * size[exact]).all()
    assert (numbers == table).mean() > 0.95  # a reading between two marks may go either way


def test_scales_that_are_given_are_kept() -> None:
    problem = load(Path(EX3))
    scales = Solution(problem, positions=[0.0, 30.0]).scales
    far = Solution(problem, positions=[270.0], scales=scales)
    assert far.scales == scales
    coarse = {kind: replace(scale, per_mm=2 * scale.per_mm) for kind, scale in scales.items()}
    other = Solution(problem, positions=[270.0], scales=coarse)
    assert other.scales == coarse
    for kind in MOTION:
        for one, two in zip(far.segments(kind), other.segments(kind), strict=True):
            assert two.exact == pytest.approx(one.exact / 2)


SAID_BY = ("solve", "solve --json", "solve --ask v_B", "sheet", "sheet --layout coursework",
           "protocol", "note", "lint")  # fmt: skip
"""Commands that need plans of all positions of a file."""


@pytest.mark.parametrize("command", SAID_BY)
def test_all_commands_report_a_cycle_without_a_dead_position(command: str) -> None:
    verb, *options = command.split()
    text = """
frame = { O = [0, 0], guides.x-x = { through = "O", angle = 0 } }
driver = { link = "1", phi = { from = 0, count = 12 }, omega = 4 }
assembly = { B = { rule = "right of A", keep = "continuous" } }
cycle = { zero = 0, count = 12 }
links.1 = { points = ["O", "A"], OA = 0.1 }
links.2 = { points = ["A", "B"], AB = 0.1 }
links.3 = { points = ["B"], slides = { on = "x-x" } }
"""
    Path("alike.toml").write_text(text, "utf-8")
    told = refused(4, verb, "alike.toml", *options)
    assert "With [cycle] zero = 15, count = 12, or with --phi 15:375:30," in told
    Path("alike.toml").write_text(text.replace("zero = 0", "zero = 15"), "utf-8")
    assert run("solve", "alike.toml").exit_code == 0


def test_a_large_table_is_checked_before_it_is_written() -> None:
    """The impossible positions lie in the last block."""
    phi = f"200:316:{116 / (BLOCK + 500):.6f}"
    said = refused(4, "solve", SIX_LINK, "--phi", phi, "--csv", "t.csv")
    number = int(said.partition("at position ")[2].split()[0])
    assert number > BLOCK
    assert f"more of {BLOCK + 500} positions. To leave such positions empty" in said
    result = run("solve", SIX_LINK, "--phi", phi, "--csv", "t.csv", "--partial")
    assert result.exit_code == 0 and result.stdout == "t.csv\n"
    with Path("t.csv").open(encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    assert [bool(row["C.x"]) for row in table] == [k < number for k in range(len(table))]
    assert [not row["reason"] for row in table] == [bool(row["C.x"]) for row in table]
    told = "Cannot place C: arcs from B (0.3 m) and D (0.15 m) do not meet."
    assert {row["reason"] for row in table} == {"", told}  # true for every row that has it


@pytest.mark.parametrize(
    ("phi", "note"),
    [
        ("0:330:30", "Note: --phi 0:330:30 is 11 positions without 330; 0:360:30 has it.\n"),
        ("5,60:90:30", "Note: --phi 60:90:30 is 1 position without 90; 60:120:30 has it.\n"),
        ("0:360:30", ""),  # the end is the beginning
        ("0:350:30", ""),  # no step meets the end
        ("0:90:1", ""),  # too many positions to count
    ],
)
def test_an_end_that_is_left_out_is_reported(phi: str, note: str) -> None:
    result = run("solve", EX3, "--phi", phi, "--ask", "v_E", "--csv")
    assert (result.exit_code, result.stderr) == (0, note)


def test_doubts_of_a_large_table_are_reported_together() -> None:
    near = ",".join(f"{180 + 0.015 * k:g}" for k in range(-8, 9) if k)
    phi = f"60:120:{60 / BLOCK},{near}"
    result = run("solve", "dead.toml", "--phi", phi, "--csv", "t.csv")
    assert result.exit_code == 0, result.output
    change, *lines = result.stderr.splitlines()
    assert "pass a change point at phi = 180 deg" in change
    assert len(lines) == 6
    for line in lines[:5]:
        number = int(line.partition("position ")[2].split()[0])
        assert BLOCK < number <= BLOCK + 16
        assert "next to a dead position" in line
    assert f"11 more of {BLOCK + 16} positions are affected, less badly." in lines[5]


def test_problems_in_one_large_table() -> None:
    count = BLOCK + 10
    result = run("solve", EX1, "faulty.toml", EX2, "--csv", "--phi", f"0:{count}:1")
    assert result.exit_code == 3
    lines = list(csv.reader(io.StringIO(result.stdout)))
    heads = [k for k, line in enumerate(lines) if line[:2] == ["problem", "variant"]]
    assert heads == [0, count + 1]
    assert {line[0] for line in lines[1 : count + 1]} == {"ex1"}
    assert {line[0] for line in lines[count + 2 :]} == {"ex2"}
    assert len(lines) == 2 * count + 2


def test_a_large_table_keeps_its_ruler() -> None:
    problem, positions = load(Path(EX1)), np.arange(0.0, 60.0, 1.0)
    gaps = examine(problem, positions).gaps
    table = large_table(problem, positions, gaps, ruler=2.0, partial=False)
    at = [k for k, name in enumerate(table.header) if name.endswith(".read")]
    read = np.array([[row[k] for k in at] for part in table.blocks() for row in part])
    header, small = csv_rows(Solution(problem, positions=positions.tolist(), ruler=2.0))
    assert tuple(header) == table.header
    assert read.tolist() == [[row[k] for k in at] for row in small]


# Parts --------------------------------------------------------------------------------------------


def test_gaps_are_listed_in_the_order_of_their_first_positions() -> None:
    codes = np.array([-1, 9, 2, 2, -1, 9, 9], np.int16)
    asked = []

    def tell(index: int) -> Failure:
        asked.append(index)
        return Failure(Cause.AT_LIMIT, Place(index + 1, 30.0 * index, TURN, "m", is_only=False))

    gaps = Gaps.of(codes, tell)
    assert asked == [1, 2]
    assert gaps.reason.tolist() == [-1, 0, 1, 1, -1, 0, 0]
    assert gaps.count == 5
    first = "Position 2 (phi = 30 deg) is at the limit of the possible ones. "
    assert gaps.sentences == (
        first + "The same holds at 2 more of 7 positions.",
        "Position 3 (phi = 60 deg) is at the limit of the possible ones. "
        "The same holds at 1 more of 7 positions.",
    )
    assert gaps.refusal() == gaps.sentences[0] + " Other steps fail at 2 positions."
    other = Gaps.of(np.array([-1, 0], np.int16), tell)
    joined = gaps.joined(np.array([0, 4]), other)
    assert joined.reason.tolist() == [-1, 0, 1, 1, 2, 0, 0]
    assert joined.failures == (*gaps.failures, *other.failures)
    nothing = Gaps.of(np.full(3, -1, np.int16), tell)
    assert nothing.count == 0 and not nothing.failures and not nothing.sentences


@pytest.mark.parametrize("cause", Cause)
def test_a_fact_shared_by_all_positions_of_a_cause_has_no_number_of_one(cause: Cause) -> None:
    """Radii hold for all; the place, the margin and distances between moving points do not."""
    facts = Failure(
        cause, Place(7, 30.5, TURN, "m", is_only=False), "C", ("A", "B"), (1.0, 2.0, 3.25, 4.5)
    )
    facts = replace(facts, margin=1e-9, problem="ex")
    if cause is Cause.NOT_HELD:
        facts = replace(facts, reach=(30.0, 10.0, 90.0))
    other = replace(facts, place=Place(8, 60.5, TURN, "m", is_only=False), margin=2e-9)
    moved = (1.0, 2.0, 6.25, 7.5) if cause is not Cause.TANGENT else (1.0, 5.0)
    other = replace(other, lengths=moved)
    own = cause not in (Cause.NOT_FINITE, Cause.COINCIDENT, Cause.NEITHER)
    if own:
        assert "position 7 (phi = 30.5 deg)" in str(facts).replace("Position", "position")
        assert str(facts.numbered(8, 9)) == str(facts).replace("osition 7 (", "osition 8 (")
        assert facts.general == other.general
    assert (str(facts) == str(other)) == (cause is Cause.NOT_FINITE)


@pytest.mark.parametrize("count", [0, 1, SAMPLE, SAMPLE + 1, 10 * SAMPLE])
def test_a_sample_is_even_and_has_both_ends(count: int) -> None:
    places = np.arange(count) * 3
    chosen = evenly(places)
    assert len(chosen) == min(count, SAMPLE)
    assert len(set(chosen.tolist())) == len(chosen)
    if count:
        assert chosen[0] == 0 and chosen[-1] == places[-1]
        assert np.ptp(np.diff(chosen)) <= 3 if count > 1 else True


def test_names_with_position_in_them_are_left_alone() -> None:
    Path("position 7.toml").write_text(DEAD, "utf-8")
    said = refused(4, "solve", "position 7.toml", "--phi", f"45,{SPOILT}", "--npz", "a.npz")
    assert "position 7.toml: position 1 (phi = 179.999 deg) is so near" in said


def test_a_bar_is_shown_on_a_terminal_only(monkeypatch: pytest.MonkeyPatch) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    for stream, long, shown in (
        (Terminal(), True, True),
        (Terminal(), False, False),
        (io.StringIO(), True, False),
    ):
        monkeypatch.setattr(sys, "stderr", stream)
        with bar(10, long=long) as tell:
            tell(4)
            tell(6)
        assert ("planmethod" in stream.getvalue()) == shown


def test_commands_are_those_that_are_listed() -> None:
    context = click.Context(cli)
    assert cli.list_commands(context) == list(COMMANDS)
    for name in COMMANDS:
        command = cli.get_command(context, name)
        assert command is not None
        assert command.name == name
        assert command.help
    assert cli.get_command(context, "__init__") is None
    assert "No such command 'problems'" in refused(2, "problems")
