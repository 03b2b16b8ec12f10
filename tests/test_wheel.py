"""The wheel: it has every file that the program reads, and the README is right about it."""

from __future__ import annotations

import re
import shlex
import tomllib
from importlib.metadata import requires
from pathlib import Path

import pytest
from doors import command_of
from worked import ROOT

from scripts.wheel import COMMANDS

PACKAGE = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))


def test_every_kind_of_file_of_the_package_goes_into_the_wheel() -> None:
    """A file of a kind that is not listed is there in a copy and absent where it is installed."""
    patterns = PACKAGE["tool"]["setuptools"]["package-data"]["planmethod"]
    kept = {Path(pattern).suffix or Path(pattern).name for pattern in patterns} | {".py"}
    kinds = {
        path.suffix or path.name
        for path in (ROOT / "planmethod").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert kinds <= kept


@pytest.mark.parametrize("line", COMMANDS[1:])
def test_each_line_tried_with_a_wheel_is_a_command(line: str) -> None:
    command, *rest = shlex.split(line)
    command_of(command).make_context(command, rest)


@pytest.mark.parametrize("name", ["README.md", "README.ru.md"])
def test_the_lines_tried_with_a_wheel_are_the_first_commands_of_the_readme(name: str) -> None:
    text = (ROOT / name).read_text("utf-8")
    told = [line for line in re.findall(r"(?m)^planmethod (.*?) *#", text) if "my.toml" in line]
    assert len(told) >= 5
    # No viewer is opened in a test.
    assert tuple(line.replace(" --open", "") for line in told[:5]) == COMMANDS[1:6]


@pytest.mark.parametrize("name", ["README.md", "README.ru.md"])
def test_the_readme_names_the_wheel_that_is_built(name: str) -> None:
    version = PACKAGE["project"]["version"]
    text = (ROOT / name).read_text("utf-8")
    assert f"planmethod-{version}-py3-none-any.whl" in text
    assert not re.search(r"(?m)^py -m pip install planmethod\b", text)


def test_packages_that_messages_advise_to_install_exist() -> None:
    """An index that does not have the program cannot install its extras."""
    known = {re.split(r"[\s;<>=]", one)[0] for one in requires("planmethod") or ()}
    known |= {one.partition("[")[0] for one in known}
    for path in (ROOT / "planmethod").rglob("*.py"):
        for name in re.findall(r"pip install '?([\w-]+)", path.read_text("utf-8")):
            assert name in known, (path, name)
