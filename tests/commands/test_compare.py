"""A student's own numbers beside the exact ones (``solve --compare``)."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from doors import ExitCode, cli

EX3 = "problems/linkages/ex3.toml"


def run(*words: str | Path) -> Result:
    return CliRunner().invoke(cli, ["solve", *map(str, words)])


@pytest.fixture
def work(tmp_path: Path) -> Path:
    file = tmp_path / "my.csv"
    file.write_text("Величина;Значение\nv_D;3,4\na_E;80\nq_7;1\n", encoding="utf-8")
    return file


def test_own_numbers_are_printed_beside_the_exact_ones_without_a_verdict(work: Path) -> None:
    result = run(EX3, "--compare", work, "--lang", "en")
    assert result.exit_code == ExitCode.DONE
    rows = {line.split()[0]: line.split() for line in result.output.splitlines() if line.strip()}
    assert rows["v_D"][1:6:2] == ["3.4", "3.405", "−0.0049"]
    assert rows["a_E"][-1] == "−8.1"  # (80 - 87.07) / 87.07
    assert rows["q_7"][1:] == ["—"] * 4
    assert "no quantity 'q_7'" in result.output
    assert not {"wrong", "right", "near"} & set(result.output.split("\n\n")[0].split())


def test_a_train_is_compared_too(tmp_path: Path) -> None:
    file = tmp_path / "my.csv"
    file.write_text("Величина;Значение\nn_5;375\n", encoding="utf-8")
    result = run("problems/gears/gears-ex2.toml", "--compare", file)
    assert result.exit_code == ExitCode.DONE
    assert "−375" in result.output


def test_a_file_may_forbid_comparison_and_contradicting_options_are_rejected(
    work: Path, tmp_path: Path
) -> None:
    closed = tmp_path / "closed.toml"
    closed.write_text("compare = false\n" + Path(EX3).read_text("utf-8"), encoding="utf-8")
    result = run(closed, "--compare", work)
    assert result.exit_code == ExitCode.PROBLEM
    assert "compare" in result.output
    assert run(closed).exit_code == ExitCode.DONE
    assert run(EX3, "--compare", work, "--json").exit_code == ExitCode.USAGE
    closed.write_text("compare = 1\n" + Path(EX3).read_text("utf-8"), encoding="utf-8")
    assert run(closed).exit_code == ExitCode.PROBLEM
