"""The counts over shipped problems."""

from __future__ import annotations

from pathlib import Path

from click.testing import CliRunner

from benchmarks.shipped import main

SHORT_ROD = """
[frame]
A = [0.0, 0.0]
guides.x-x = { through = "A", angle = 0 }
[links.1]
points = ["A", "B"]
AB = 0.03
[links.2]
points = ["B", "C"]
BC = 0.02
[links.3]
points = ["C"]
slides = { on = "x-x" }
[driver]
link = "1"
phi = 90
omega = 10
[assembly]
C = "right of B"
"""


def test_an_unsolved_problem_is_named_and_counted(tmp_path: Path) -> None:
    bad = tmp_path / "short.toml"
    bad.write_text(SHORT_ROD, encoding="utf-8")
    train = "problems/gears/gears-ex1.toml"
    told = CliRunner().invoke(main, [str(bad), train, "--positions", "1"]).output
    assert "short: Cannot place C" in told
    assert "2 files, 2 problems with their variants, 1 unsolved." in told
    assert "| 2 | 1 | 1 | 1 |" in told  # a sheet that is not drawn is an error


def test_random_mechanisms_are_written_and_looked_over(tmp_path: Path) -> None:
    asked = ["--seed", "5", "--positions", "1", "--written", str(tmp_path)]
    told = CliRunner().invoke(main, asked).output
    assert (tmp_path / "random-5.toml").is_file()
    assert "1 files, 1 problems with their variants, 0 unsolved." in told
    assert "| 1 | 1 | 1 | 0 |" in told
