"""Settings of a department: reading, marks, and every fault."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner
from doors import (
    DEFAULT,
    KEYS,
    MARKS_PROFILES as PROFILES,
    POLICIES,
    VALUES,
    ExitCode,
    Settings,
    SettingsError,
    cli,
    command_of,
    drafting,
    load_settings as load,
)
from worked import ROOT

DOCS = (ROOT / "docs" / "reference" / "settings.md").read_text("utf-8")
(EXAMPLE,) = re.findall(r"(?s)```toml [^\n]*\n(.*?)```", DOCS)
"""All keys with their defaults and what they mean."""


def read(folder: Path, text: str) -> Settings:
    path = folder / "department.toml"
    path.write_text(text, encoding="utf-8")
    return load(path)


def faults(folder: Path, text: str) -> list[str]:
    with pytest.raises(SettingsError) as caught:
        read(folder, text)
    assert caught.value.exit_code is ExitCode.USAGE
    return [str(fault) for fault in caught.value.faults]


def test_an_empty_file_and_the_one_of_the_documentation_are_the_defaults(tmp_path: Path) -> None:
    assert read(tmp_path, "\ufeff") == read(tmp_path, EXAMPLE) == DEFAULT == Settings()


@pytest.mark.parametrize("folder", ["docs", "docs/ru"])
def test_the_page_on_grading_is_right(
    folder: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its file changes the tolerances as it says, and its faults are reported as it shows."""
    page = (ROOT / folder / "how-to" / "set-up-grading.md").read_text("utf-8")
    (example,) = re.findall(r'(?ms)^```toml title="department.toml"\n(.*?)^```$', page)
    assert read(tmp_path, example).policy == "wider"
    monkeypatch.chdir(tmp_path)
    (tmp_path / "problems").symlink_to(ROOT / "problems")
    (commands,) = re.findall(r"(?ms)^```text\n(.*?)^```$", page)
    key, group = (shlex.split(line)[1:] for line in commands.splitlines())
    command_of(group[0]).make_context(group[0], group[1:])
    lang = "ru" if folder.endswith("ru") else "en"
    for words in (key, [word for word in key if word not in ("--settings", "department.toml")]):
        printed = CliRunner().invoke(cli, ["--lang", lang, *words])
        assert printed.exit_code == 0
        (shown,) = re.findall(r"(?m)^v_B1 +(\S+ ± \S+)", printed.output)
        assert shown in page
    printed_faults = re.findall(r"(?ms)^```\nError: department.toml: (.*?)^```$", page)
    assert len(printed_faults) == (1 if lang == "en" else 0)
    for faults_of in printed_faults:
        told = faults(tmp_path, "departement = 0.05\ncap = 10\n")
        assert [line.strip() for line in faults_of.splitlines()[1:]] == told


def test_every_key_is_a_field_read_and_documented(tmp_path: Path) -> None:
    assert set(Settings.__struct_fields__) == set(KEYS)
    assert set(re.findall(r"(?m)^(?:# )?(\w+) = .*[^ ] +# [a-z]", EXAMPLE)) == set(KEYS)
    told = Settings(
        k=3.0,
        cap=0.2,
        floor_mm=1.0,
        floor_share=0.01,
        near=2.0,
        near_share=0.5,
        inherited_share=0.9,
        inconsistent_share=0.8,
        unseen_share=0.7,
        sense_share=0.25,
        department=0.04,
        policy="wider",
        profile="coarse",
        ruler_mm=1.0,
        values="never",
        marks=((0.6, "зачтено"), (0.0, "не зачтено")),
    )
    assert all(getattr(told, key) != getattr(DEFAULT, key) for key in KEYS)
    text = ""
    for key in KEYS:
        value = getattr(told, key)
        said = [list(pair) for pair in value] if key == "marks" else value
        text += f"{key} = {said!r}\n"
    assert read(tmp_path, text) == told


def test_profiles_and_policies_are_those_there_are() -> None:
    assert set(PROFILES) == set(drafting.PROFILES)
    said = re.findall(r"(?m)^(?:policy|profile|values) = .* # (.*)$", EXAMPLE)
    assert set(re.findall(r'"(\w+)"', " ".join(said))) == {*PROFILES, *POLICIES, *VALUES}


@pytest.mark.parametrize(
    ("share", "mark"),
    [(1.0, "5"), (0.85, "5"), (0.8499, "4"), (0.7, "4"), (0.5, "3"), (0.4999, "2"), (0.0, "2")],
)
def test_the_mark_is_that_of_the_bound_reached(share: float, mark: str) -> None:
    assert DEFAULT.mark(share) == mark


def test_a_sum_that_is_not_exact_reaches_its_bound() -> None:
    share = 0.0
    for _ in range(10):
        share += 0.1
    assert share < 1.0
    assert Settings(marks=((1.0, "5"), (0.0, "2"))).mark(share) == "5"


def test_whole_numbers_are_marks_without_quotes(tmp_path: Path) -> None:
    assert read(tmp_path, "marks = [[0.5, 5], [0, 2]]").marks == ((0.5, "5"), (0.0, "2"))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("k = '2,5'", "k: expected a number of standard deviations, got the string '2,5'. Write "
         "2.5 without quotes."),
        ("near = 0.5", "near: expected a number of tolerances from 1 to 10, got 0.5. 1 for no "
         "answers that are near."),
        ("sense_share = true", "sense_share: expected a share, got the boolean true"),
        ("department = inf", "department: expected a share, got inf. The number must be finite."),
        ("policy = 'wide'", "policy: expected 'construction', 'department', 'wider' or "
         "'stricter', got the string 'wide'. Did you mean 'wider'?"),
        ("profile = 'cаd'", "profile: 'cаd' has the Cyrillic letter а (U+0430), expected the "
         "Latin letter 'a'. Type 'cad' in the Latin layout."),
        ("cap = 0.01\nfloor_share = 0.02", "cap: the cap is below floor_share. No answer "
                                           "could be graded: raise it."),
        ("ruler_mm = 0", "ruler_mm: expected a step of reading in mm from 0.01 to 5, got 0. A "
         "ruler has 0.5 or 1."),
        ("marks = []", "marks: expected 1 to 20 marks, got an empty list. For example: marks = "
         '[[0.85, "5"], [0.7, "4"], [0.5, "3"], [0, "2"]]'),
        ("marks = [5]", "marks[0]: expected [share, mark], got the integer 5. For example: marks "
         '= [[0.85, "5"], [0.7, "4"], [0.5, "3"], [0, "2"]]'),
        ("marks = [[0.5, '5'], [0.7, '4'], [0, '2']]", "marks[1]: '4' is from 0.7, the mark "
         "before it from 0.5. The best mark comes first."),
        ("marks = [[0.5, '5']]", "marks: the last mark is from 0.5, expected 0. Add the "
                                 "lowest mark: [0, \"2\"], or let '5' start at 0."),
        ("marks = [[85, '5'], [0, '2']]", "marks[0][0]: expected a share from 0 to 1, got 85. "
         "Shares are from 0 to 1: 0.05 for 5 %."),
        ("marks = [[0, ' ']]", 'marks[0][1]: the mark is empty. For example: marks = [[0.85, '
         '"5"], [0.7, "4"], [0.5, "3"], [0, "2"]]'),
        ("k = 2,5", "line 1, column 6: this is not TOML: expected newline or end of document "
         "after a statement. Write 2.5 with a decimal point, not 2,5."),
    ],
    ids=lambda value: value[:24],
)  # fmt: skip
def test_single_faults(text: str, said: str, tmp_path: Path) -> None:
    assert faults(tmp_path, text) == [said]


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(SettingsError, match=r"this file does not exist\. Check the path\."):
        load(tmp_path / "kafedra.toml")


def test_settings_need_no_numpy() -> None:
    code = "import sys, planmethod.check.marks; print('numpy' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "False"
