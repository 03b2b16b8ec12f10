"""``layouts`` and ``--layout``: from the list to a sheet drawn by a layout file of the user."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from doors import SHIPPED, ExitCode, cli, shipped_text
from worked import path_of

EX1 = str(path_of("linkages/ex1"))


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, args)


def test_the_list_states_the_purpose_of_each_layout() -> None:
    result = run("layouts")
    assert result.exit_code == ExitCode.DONE
    lines = result.output.splitlines()
    assert [line.split()[0] for line in lines] == list(SHIPPED)
    assert all(len(line.split()) > 3 for line in lines)


@pytest.mark.usefixtures("russian")
@pytest.mark.parametrize("name", SHIPPED)
def test_a_layout_is_printed_or_written(name: str, tmp_path: Path) -> None:
    assert run("layouts", name).output == shipped_text(name)
    path = tmp_path / "mine.toml"
    assert run("layouts", name, str(path)).exit_code == ExitCode.DONE
    assert path.read_text("utf-8") == shipped_text(name)
    again = run("layouts", name, str(path))
    assert again.exit_code == ExitCode.USAGE
    assert "--force" in again.output
    assert run("layouts", name, str(path), "--force").exit_code == ExitCode.DONE


def test_an_unknown_layout_names_the_nearest() -> None:
    result = run("layouts", "homwork")
    assert result.exit_code == ExitCode.USAGE
    assert "did you mean 'homework'?" in result.output


def test_the_written_default_draws_the_default(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(shipped_text("one-position"), "utf-8")
    drawn: list[bytes] = []
    for more in ((), ("--layout", "one-position"), ("--layout", str(path))):
        out = tmp_path / str(len(drawn))
        result = run("sheet", EX1, "--format", "svg", "-o", str(out), *more)
        assert result.exit_code == ExitCode.DONE, result.output
        drawn.append((out / "ex1.svg").read_bytes())
    assert drawn[0] == drawn[1] == drawn[2]


def test_sheets_of_a_file_are_numbered(tmp_path: Path) -> None:
    path = tmp_path / "two.toml"
    path.write_text(
        '[[blocks]]\nkind = "scheme"\n[[blocks]]\nkind = "results"\nsheet = 2\n', "utf-8"
    )
    result = run("sheet", EX1, "--layout", str(path), "--format", "svg", "-o", str(tmp_path))
    assert result.exit_code == ExitCode.DONE, result.output
    assert len(list(tmp_path.glob("ex1*.svg"))) == 2


@pytest.mark.parametrize("command", ["sheet", "lint"])
def test_a_faulty_file_is_reported_once(command: str, tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    path.write_text('grow = 1\n[[blocks]]\nkind = "sheme"\n', "utf-8")
    result = run(command, EX1, EX1, "--layout", str(path))
    assert result.exit_code == ExitCode.USAGE
    assert result.output.count("2 faults in the layout file") == 1
    assert "blocks[0].kind" in result.output
    assert "Did you mean 'scheme'?" in result.output


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("homwork", "neither a layout nor a file has this name. Did you mean 'homework'?"),
        ("nowhere.toml", "this file does not exist"),
    ],
)
def test_no_such_layout(name: str, message: str) -> None:
    result = run("sheet", EX1, "--layout", name)
    assert result.exit_code == ExitCode.USAGE
    assert message in result.output


def test_lint_looks_over_the_sheets_of_a_layout() -> None:
    result = run("lint", EX1, "--layout", "homework", "--lang", "en")
    assert result.exit_code == ExitCode.DONE, result.output
    assert "A2" in result.output
    refused = run("lint", EX1, "--layout", "homework", "--structure")
    assert refused.exit_code == ExitCode.USAGE
    assert "--layout" in refused.output
