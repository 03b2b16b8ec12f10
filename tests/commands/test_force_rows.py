"""Forces in ``solve --csv``, ``--npz`` and ``--ask``: against `Statics`, and gaps."""

from __future__ import annotations

import csv
import io
import random
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mechanisms
import numpy as np
import numpy.typing as npt
import pytest
from click.testing import CliRunner, Result
from doors import (
    IntersectLines,
    Solution,
    Statics,
    StepsStep as Step,
    cli,
    construct_evaluate as evaluate,
    drawn_forces,
    impossible,
    many_positions as many,
    problem_load as load,
    statics_of,
    symbolic,
)
from loaded import loaded_text
from worked import DEAD, ROOT, path_of

from benchmarks.generator import random_problem

EX1 = str(path_of("linkages/ex1"))
SIX_LINK = str(path_of("levers/six-link"))
TASK12 = str(path_of("levers/task12"))
PRESS = str(path_of("press/press"))

SLIDER = """
[[loads]]
link = "2"
at = "B"
force = 8
angle = 60
"""

BY_POSITION = """
[[loads]]
link = "1"
couple = { over = "position", values = [1, 5, 2, 7] }
"""

TWO = """
[variants.А]
dynamics.links.5.mass = 10
[variants.Б]
dynamics.links.5.mass = 0
driver.phi = 200
"""

COUPLE = '[[loads]]\nlink = "3"\ncouple = 5\n'


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("slider.toml").write_text(mechanisms.SLIDER + SLIDER, "utf-8")
    Path("by-position.toml").write_text(mechanisms.CRANK + BY_POSITION, "utf-8")
    Path("dead.toml").write_text(DEAD + COUPLE, "utf-8")
    for seed in (2, 11):
        text, pose = random_problem(seed)
        text = loaded_text(text, pose, random.Random(f"loads {seed}"))
        Path(f"random-{seed}.toml").write_text(text, "utf-8")
    variants = Path(TASK12).read_text("utf-8") + TWO
    Path("two.toml").write_text(variants, "utf-8")


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, list(args), catch_exceptions=False)


def done(*args: str) -> str:
    result = run(*args)
    assert result.exit_code == 0, result.output
    return result.stdout


def refused(code: int, *args: str) -> str:
    result = run(*args)
    assert result.exit_code == code, result.output
    return " ".join(result.stderr.split())


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def arrays(*args: str) -> dict[str, Any]:
    assert done("solve", *args, "--npz", "a.npz") == "a.npz\n"
    with np.load("a.npz") as found:
        return dict(found)


def exact(statics: Statics) -> Iterator[tuple[str, npt.NDArray[Any]]]:
    """Yield the columns of the exact values."""
    for planned, r in zip(statics.board.reactions, statics.reactions, strict=True):
        pair = f"{r.joint}.{r.on}-{r.by}"
        yield f"F.{pair}.x", r.force.real
        yield f"F.{pair}.y", r.force.imag
        yield f"F.{pair}", np.abs(r.force)
        if planned.couple is not None:
            yield f"M.{pair}", r.moment
    quantity = "moment" if statics.solution.problem.drive.is_crank else "force"
    yield f"driving.{quantity}", statics.balance
    assert statics.lever is not None
    yield f"lever.{quantity}", statics.lever


def read(statics: Statics) -> Iterator[tuple[str, npt.NDArray[Any]]]:
    """Yield the columns of values read with the ruler."""
    drawn = drawn_forces(statics)
    for r in statics.reactions:
        yield f"F.{r.joint}.{r.on}-{r.by}.read", drawn.read(f"F_{r.on}_{r.by}")
    quantity = "moment" if statics.solution.problem.drive.is_crank else "force"
    yield f"driving.{quantity}.read", drawn.read("balance")
    yield f"lever.{quantity}.read", drawn.read("lever")


def is_force(name: str) -> bool:
    """Return whether a column is of a force, not of a point (one is called F), link or plan."""
    return re.match(r"(driving|lever)\.(moment|force)|[FM]\.[^.]+\.[^.]+-", name) is not None


FILES = [SIX_LINK, TASK12, PRESS, "slider.toml", "random-2.toml", "random-11.toml"]


# Values -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("file", FILES, ids=lambda file: Path(file).stem)
def test_the_table_has_the_forces_exact_and_read(file: str) -> None:
    table = rows(done("solve", file, "--csv"))
    statics = statics_of(Solution(load(Path(file))))
    wanted = dict(exact(statics)) | dict(read(statics))
    assert {name for name in table[0] if is_force(name)} == set(wanted)
    for name, values in wanted.items():
        assert [float(row[name]) for row in table] == (values + 0.0).tolist()


@pytest.mark.parametrize("file", FILES, ids=lambda file: Path(file).stem)
def test_arrays_and_requested_columns_equal_the_table(file: str) -> None:
    table = rows(done("solve", file, "--csv"))
    found = arrays(file)
    asked = rows(done("solve", file, "--ask", "forces", "--csv"))
    wanted = dict(exact(statics_of(Solution(load(Path(file))))))
    big = max(np.abs(values).max() for values in wanted.values())
    assert [name for name in found if is_force(name)] == list(wanted)
    assert list(asked[0])[2:] == list(wanted)
    for name, values in wanted.items():
        assert np.abs(found[name] - values).max() <= 1e-12 * big
        for k, row in enumerate(asked):
            assert abs(float(row[name]) - values[k]) <= 1e-12 * big
    motion = [name for name in table[0] if name in found and not is_force(name)]
    assert "B.x" in motion


def test_names_of_the_columns() -> None:
    (row,) = rows(done("solve", SIX_LINK, "--csv"))
    last = list(row)[list(row).index("F.H.4-2.x") :]
    assert last[:5] == ["F.H.4-2.x", "F.H.4-2.y", "F.H.4-2", "F.H.4-2.read", "M.H.4-2"]
    assert last[-4:] == [
        "driving.moment",
        "driving.moment.read",
        "lever.moment",
        "lever.moment.read",
    ]
    assert not any(name.startswith("M.B") for name in row)  # a hinge has no moment
    assert not any(is_force(name) for name in rows(done("solve", EX1, "--csv"))[0])
    assert not any(is_force(name) for name in arrays(EX1))


def test_the_documents_name_them_as_they_are() -> None:
    page = (ROOT / "docs" / "reference" / "json-and-csv.md").read_text("utf-8")
    text = page.partition("## CSV and NPZ")[2].partition("\n## ")[0]
    (row,) = rows(done("solve", TASK12, "--csv"))
    lines = re.findall(r"(?m)^- (`[^(]*?) \(`--ask (.*?)`\)", text)
    assert len(lines) == 4
    for columns, label in lines:
        (asked,) = rows(done("solve", TASK12, "--ask", label, "--csv"))
        names = re.findall(r"`(.*?)`", columns)
        assert list(asked)[2:] == names
        assert set(names) <= set(row)
    readings = {f"{name}.read" for name in ("F.B.2-1", "driving.moment", "lever.moment")}
    assert readings <= set(row)
    assert readings <= set(re.findall(r"`(.*?)`", text))


def test_requested_forces_on_a_terminal() -> None:
    text = done("solve", TASK12, "--ask", "M_dr,v_B,F_B_2/1")
    head = text.splitlines()[2].split()
    assert head[3:] == ["driving.moment", "B.vx", "B.vy", "F.B.2-1.x", "F.B.2-1.y", "F.B.2-1"]
    assert "2484" in text
    assert "−2481" in text


def test_variants_in_one_file() -> None:
    table = rows(done("solve", "two.toml", "--all-variants", "--ask", "M_dr", "--csv"))
    whole = rows(done("solve", "two.toml", "--all-variants", "--csv"))
    found = arrays("two.toml", "--all-variants", "--ask", "M_dr,F_B_2/1")
    assert [row["variant"] for row in table] == ["А", "Б"]
    for row, same in zip(table, whole, strict=True):
        problem = load(Path("two.toml"), variant=row["variant"])
        (balance,) = Statics(Solution(problem)).balance
        assert float(same["driving.moment"]) == balance
        assert float(row["driving.moment"]) == pytest.approx(balance, rel=1e-12)
        mine = found[f"{row['variant']}:driving.moment"]
        assert mine.tolist() == pytest.approx([balance], rel=1e-12)
    assert table[0]["driving.moment"] != table[1]["driving.moment"]


def test_problems_with_and_without_loads() -> None:
    table = done("solve", EX1, TASK12, "--csv")
    first, _, second = table.partition("\nproblem,variant,")
    assert "driving" not in first
    assert "driving.moment" in second.splitlines()[0]
    found = arrays(EX1, TASK12)
    assert "task12:driving.moment" in found
    assert "ex1:driving.moment" not in found
    said = refused(2, "solve", EX1, TASK12, "--ask", "v_B,M_dr", "--npz", "b.npz")
    assert "ex1.toml: no result 'M_dr': the problem has no loads" in said
    assert not Path("b.npz").exists()


def test_unknown_forces() -> None:
    for form in (("--csv", "t.csv"), ("--npz", "a.npz"), ()):
        said = refused(2, "solve", TASK12, "--ask", "F_B_1/2", *form)
        assert "task12.toml: no result 'F_B_1/2'; did you mean 'F_B_2/1'?" in said


# Blocks -------------------------------------------------------------------------------------------


def test_a_large_table_is_the_small_ones_beside_each_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """All blocks have one scale of forces: readings do not depend on the blocks."""
    problem = load(Path(PRESS))
    whole = Solution(problem, positions=[float(k) for k in range(0, 360, 2)])
    wanted = dict(exact(statics_of(whole))) | dict(read(statics_of(whole)))
    monkeypatch.setattr(many, "BLOCK", 50)
    table = rows(done("solve", PRESS, "--phi", "0:360:2", "--csv"))
    assert len(table) == 180
    for name, values in wanted.items():
        found = np.array([float(row[name]) for row in table])
        near = np.abs(found - values) <= 1e-12 * np.abs(values).max()
        # A reading between two marks may go either way.
        assert near.mean() > 0.95 if name.endswith(".read") else near.all(), name


def test_a_given_scale_of_forces_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    Path("scaled.toml").write_text(mechanisms.SLIDER + SLIDER + "[scales]\nmu_F = 0.7\n", "utf-8")
    solution = Solution(load(Path("scaled.toml")))
    assert statics_of(solution).scale.per_mm == 0.7
    wanted = dict(read(statics_of(solution)))
    table = rows(done("solve", "scaled.toml", "--csv", "--partial"))
    for name, values in wanted.items():
        assert [float(row[name]) for row in table] == (values + 0.0).tolist()


# Where forces do not exist ------------------------------------------------------------------------


def test_a_dead_position_is_empty_in_every_form() -> None:
    for form in (("--csv",), ("--npz", "a.npz"), ("--ask", "forces")):
        said = refused(4, "solve", "dead.toml", "--phi", "45,180,90", *form)
        assert "at position 1 (phi = 180 deg)" in said
        assert said.endswith("give --partial with --json, --csv, --npz or --ask.")
    table = rows(run("solve", "dead.toml", "--phi", "45,180,90", "--csv", "--partial").stdout)
    assert [bool(row["driving.moment"]) for row in table] == [True, False, True]
    assert [bool(row["C.x"]) for row in table] == [True, False, True]
    assert (
        run("solve", "dead.toml", "--phi", "45,180,90", "--npz", "a.npz", "--partial").exit_code
        == 0
    )
    with np.load("a.npz") as found:
        assert np.isnan(found["F.B.2-1"]).tolist() == [False, True, False]
        assert np.isfinite(found["C.x"]).all()
        assert found["reason"].tolist() == [-1, 0, -1]


def test_places_without_forces_have_a_reason() -> None:
    """Without masses the forces of a place need no velocities: it is their plan that fails."""
    args = ("solve", "dead.toml", "--phi", "45,180,90", "--ask", "C,M_dr")
    said = refused(4, *args)
    assert "Cannot close the force plan at position 1 (phi = 180 deg)" in said
    result = run(*args, "--csv", "--partial")
    assert "1 of 3 positions is impossible and left empty. Cannot close the force" in result.stderr
    table = rows(result.stdout)
    assert float(table[1]["C.x"]) == pytest.approx(0.5)
    assert table[1]["driving.moment"] == ""
    assert table[1]["reason"].startswith("Cannot close the force plan: the mechanism is")
    assert table[0]["reason"] == ""


@pytest.fixture
def _steep(monkeypatch: pytest.MonkeyPatch) -> None:
    """Force plans, and no others, need lines that meet under sixty degrees at least."""
    known = evaluate.limit_of

    def limit_of(step: Step) -> float:
        is_force = isinstance(step, IntersectLines) and step.out.startswith("f:")
        return 0.866 if is_force else known(step)

    for module in (evaluate, symbolic, impossible):
        monkeypatch.setattr(module, "limit_of", limit_of)


@pytest.mark.usefixtures("_steep")
def test_motion_is_printed_where_only_forces_do_not_exist(monkeypatch: pytest.MonkeyPatch) -> None:
    phi = "0:360:30"  # dead at 180 degrees, with flat force plans at some others
    for form in ((), ("--json",), ("--csv",), ("--npz", "a.npz"), ("--ask", "M_dr")):
        said = refused(4, "solve", "dead.toml", "--phi", "45,160,90", *form)
        assert "Error: Cannot close the force plan at position 1 (phi = 160 deg)" in said
        assert said.endswith("give --partial with --json, --csv, --npz or --ask.")
    assert run("solve", "dead.toml", "--phi", "45,160,90", "--ask", "a_C").exit_code == 0
    for block in (2048, 5):
        monkeypatch.setattr(many, "BLOCK", block)
        table = rows(run("solve", "dead.toml", "--phi", phi, "--csv", "--partial").stdout)
        kinds = [(bool(row["C.ax"]), bool(row["F.B.2-1"]), row["reason"][:20]) for row in table]
        assert kinds.count((True, True, "")) == 12 - 1 - flat(table)
        assert kinds.count((True, False, "Cannot close the for")) == flat(table) > 1
        assert kinds[6] == (False, False, "Cannot close the vel")
        for row in table:
            filled = {bool(cell) for name, cell in row.items() if is_force(name)}
            assert len(filled) == 1
    run("solve", "dead.toml", "--phi", phi, "--npz", "a.npz", "--partial")
    with np.load("a.npz") as found:
        empty = [not row["F.B.2-1"] for row in table]
        assert np.isnan(found["F.B.2-1"]).tolist() == empty
        assert (found["reason"] >= 0).tolist() == empty
        assert np.isnan(found["C.ax"]).tolist() == [k == 6 for k in range(12)]


def flat(table: list[dict[str, str]]) -> int:
    """Count the positions where the two links of the dyad meet under less than sixty degrees."""
    angles = [
        np.radians(float(row["3.phi_deg"]) - float(row["2.phi_deg"]))
        for row in table
        if row["2.phi_deg"]
    ]
    return int(np.sum(np.abs(np.sin(angles)) <= 0.866))


@pytest.mark.parametrize("form", [("--csv",), ("--npz", "a.npz"), ("--ask", "M_dr"), ()])
def test_loads_over_the_positions_of_the_file(form: tuple[str, ...]) -> None:
    assert run("solve", "by-position.toml", *form).exit_code == 0
    for more in ((), ("--partial",) if form else ()):
        said = refused(3, "solve", "by-position.toml", "--phi", "90,33", *form, *more)
        assert said.count("phi = 33 deg is not one of them") == 1
        assert "loads[0].couple.values" in said
    args = ("solve", "by-position.toml", "--phi", "90,33", "--ask", "v_C")
    assert run(*args).exit_code == 0


# Speed --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("asked", "wanted"), [("v_B,positions", False), ("M_dr", True)], ids=["motion", "forces"]
)
def test_results_of_the_motion_do_not_plan_forces(asked: str, wanted: bool) -> None:
    program = (
        "import sys\nfrom planmethod.cli import cli\n"
        "try:\n"
        f"    cli(['solve', {TASK12!r}, '--ask', {asked!r}, '--npz', 'a.npz'])\n"
        "except SystemExit as done:\n    assert not done.code, done.code\n"
        "print(*sorted(name for name in sys.modules if 'forces' in name))\n"
    )
    found = subprocess.run(
        [sys.executable, "-X", "utf8", "-c", program],
        capture_output=True,
        encoding="utf-8",
        timeout=120,
        check=True,
    )
    modules = {name.removeprefix("planmethod.") for name in found.stdout.splitlines()[-1].split()}
    for name in ("plans.forces.board", "plans.forces.dyads", "solved.forces.statics"):
        assert (name in modules) == wanted, name
