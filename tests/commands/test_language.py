"""The language of commands' output: that of messages, or the one named in the file."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from doors import OWN_VARIABLE, SYSTEM_VARIABLES, cli

FOUR_BAR = """\
title = "Four-bar"
{sheet}
[frame]
A = [0.0, 0.0]
D = [0.3, 0.0]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = 0.25
[links.3]
points = ["D", "C"]
DC = 0.2
[driver]
link = "1"
phi = 60
omega = 10
[assembly]
C = "left of AD"
"""

TRAIN = """\
title = "Train"
{sheet}
[gears]
wheels = {{ 1 = 20, 2 = 40 }}
meshes = [{{ of = [1, 2] }}]
n = {{ 1 = 100 }}
module = 2
ask = ["n_2"]
"""

COMMANDS = (
    "solve problem.toml",
    "solve problem.toml --ask v_C",
    "protocol problem.toml",
    "structure problem.toml",
    "structure problem.toml --no-drawing",
    "check --key problem.toml",
    "check --key --moodle quiz.xml problem.toml",
    "check problem.toml work.json",
    "form problem.toml",
    "live problem.toml",
    "lint problem.toml",
    "sheet problem.toml --format svg",
    "sketch problem.toml --format svg",
    "solve train.toml",
    "protocol train.toml",
    "live train.toml",
)
OF_NO_PROBLEM = (
    "new --list",
    "new four-bar mine.toml",
    "layouts",
    "teeth --U 6",
    "synthesize slider-crank --stroke 0.2 --K_v 1.2 --offset 0.03",
)


def said(command: str, folder: Path) -> str:
    """Run a command; return its output and the texts that it writes."""
    before = {*folder.rglob("*")}
    done: Result = CliRunner().invoke(cli, command.split())
    assert done.exit_code in (0, 1), done.output
    written = sorted({*folder.rglob("*")} - before)
    texts = [path.read_bytes() for path in written if path.is_file()]
    for path in written:
        if path.is_file():
            path.unlink()
    return done.output + "".join(_text(data) for data in texts)


def _text(data: bytes) -> str:
    """Return the text of a file; that of a workbook's parts."""
    if data[:2] != b"PK":
        return data.decode("utf-8", "replace")
    import io
    import zipfile

    parts = zipfile.ZipFile(io.BytesIO(data))
    return "".join(parts.read(name).decode("utf-8", "replace") for name in parts.namelist())


def is_russian(text: str) -> bool:
    """Return whether a text has a Russian word of some letters; two letters may be a symbol."""
    return re.search("[а-яё]{4}", text, re.IGNORECASE) is not None


@pytest.fixture(autouse=True)
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in an empty folder, the environment naming no language."""
    monkeypatch.chdir(tmp_path)
    for name in (OWN_VARIABLE, *SYSTEM_VARIABLES):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "work.json").write_text(
        json.dumps({"student": "A", "answers": [{"what": "v_C", "value": 1.0}]})
    )
    return tmp_path


def write(place: Path, lang: str | None) -> None:
    """Write the problem files; they name a language, or none."""
    sheet = "" if lang is None else f'[sheet]\nlang = "{lang}"\n'
    (place / "problem.toml").write_text(FOUR_BAR.format(sheet=sheet))
    (place / "train.toml").write_text(TRAIN.format(sheet=sheet))


@pytest.mark.parametrize(
    ("environ", "of_file", "russian"),
    [
        ({}, None, False),
        ({"LANG": "de_DE.UTF-8"}, None, False),
        ({"LANG": "ru_RU.UTF-8"}, None, True),
        ({"LANG": "ru_RU.UTF-8"}, "en", False),
        ({"LANG": "en_US.UTF-8"}, "ru", True),
        ({"LANG": "ru_RU.UTF-8", OWN_VARIABLE: "en"}, "ru", False),
    ],
)
def test_output_is_in_the_language_named(
    place: Path,
    monkeypatch: pytest.MonkeyPatch,
    environ: dict[str, str],
    of_file: str | None,
    russian: bool,
) -> None:
    write(place, of_file)
    for name, value in environ.items():
        monkeypatch.setenv(name, value)
    for command in COMMANDS:
        assert is_russian(said(command, place)) is russian, command
    if of_file is None:
        for command in OF_NO_PROBLEM:
            assert is_russian(said(command, place)) is russian, command
    option = "en" if russian else "ru"
    assert is_russian(said(f"solve problem.toml --lang {option}", place)) is not russian
