"""Several problems in one command: a message on one of them names it."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from doors import cli, named
from worked import NOT_CLOSED, PROBLEMS, path_of

EX1 = str(path_of("linkages/ex1"))
APART = "Cannot place C at phi = 60 deg"


@pytest.fixture
def apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A file whose variants cannot be assembled."""
    monkeypatch.chdir(tmp_path)
    Path("apart.toml").write_text(NOT_CLOSED + VARIANTS, "utf-8")
    return "apart.toml"


VARIANTS = """
[variants.X]
links.2.BC = 0.21
[variants.Y]
links.2.BC = 0.22
"""


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, [*args, "--lang", "en"])


def said(*args: str) -> list[str]:
    done = run(*args)
    assert done.exit_code == 4, done.output
    return [line for line in done.stderr.splitlines() if APART in line]


@pytest.mark.parametrize("command", ["solve", "sheet", "protocol", "lint", "sketch"])
def test_the_one_of_several_that_fails_is_named(command: str, apart: str) -> None:
    assert said(command, apart, EX1)[0].startswith(f"Error: apart.toml: {APART}")
    assert said(command, apart)[0].startswith(f"Error: {APART}")
    first, second = said(command, apart, "--all-variants")
    assert first.startswith(f"Error: apart-X: {APART}")
    assert second.startswith(f"Error: apart-Y: {APART}")


def test_a_wrong_call_names_the_problem_that_it_is_wrong_for(apart: str) -> None:
    train = str(PROBLEMS / "gears/gears-ex1.toml")
    done = run("sheet", train, EX1, "--layout", "forces")
    assert done.exit_code == 2
    assert "gears-ex1" in done.stderr


def test_a_message_that_names_its_file_is_not_prefixed() -> None:
    names = ("a/ex1.toml", "ex1")
    assert named("ex1: too large", names) == "ex1: too large"
    assert named("the sheet of a/ex1.toml", names) == "the sheet of a/ex1.toml"
    assert named("ex10: too large", names) == "a/ex1.toml: ex10: too large"
    assert named("ex1-A is too large", names) == "a/ex1.toml: ex1-A is too large"
    assert named("too large", ()) == "too large"
