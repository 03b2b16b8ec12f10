"""Exit codes of every command: done, findings, usage, a faulty file, an impossible assembly."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
import pytest
from cases import each
from click.testing import CliRunner, Result
from doors import (
    Document,
    ExitCode,
    KindProblem,
    Language,
    ProblemKind,
    ProgramError,
    cli,
    command_of,
)
from worked import NOT_CLOSED, path_of

EX1, EX2, EX3 = (str(path_of(f"linkages/ex{n}")) for n in (1, 2, 3))
VARIANTS = str(path_of("levers/task12-variants"))
LONG = "author=Константинопольский-Преображенский-Вознесенский-Архангельский"

FAULTY = """
title = "Faulty"
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

GROUP = """student;variant;quantity;value;unit
Ivanov;А;v D;0.74;m/s
Petrov;Щ;v D;1;m/s
"""

DONE, FINDINGS, USAGE, PROBLEM, ASSEMBLY, SELF_CHECK = list(ExitCode)

CASES: dict[str, dict[ExitCode, list[tuple[str, ...]]]] = {
    "solve": {
        DONE: [(EX1,)],
        USAGE: [(EX1, "--ruler", "0"), (EX1, "--json", "--csv")],
        PROBLEM: [("faulty.toml",), ("absent.toml",), (EX1, "faulty.toml"), ("faulty.toml", EX1)],
        ASSEMBLY: [("open.toml",), (EX1, "open.toml"), ("open.toml", EX1)],
    },
    "protocol": {
        DONE: [(EX1,)],
        USAGE: [(EX1, "--position", "1")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml",)],
    },
    "structure": {
        DONE: [("open.toml", "--no-drawing")],
        USAGE: [(EX1, "--nonsense")],
        PROBLEM: [("faulty.toml",)],
    },
    "sheet": {
        USAGE: [(EX1, "--format", "dwg"), (EX1, "--paper", "A9")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml",)],
    },
    "sketch": {
        DONE: [(EX1,)],
        USAGE: [(EX1, "--format", "dwg")],
        PROBLEM: [("absent.toml",), (EX1, "absent.toml"), ("absent.toml", EX1)],
        ASSEMBLY: [("open.toml",)],  # it is drawn, with a warning
    },
    "lint": {
        DONE: [(EX2,), (EX2, "--strict"), (EX1, "--phi", "30,60,90")],
        FINDINGS: [
            (EX1, "--phi", "30,60,90", "--strict"),  # warnings alone
            (EX2, "--stamp", LONG),
            (EX2, "--stamp", LONG, "--strict"),  # errors alone
            (EX2, EX1, "--stamp", LONG),
        ],
        USAGE: [(EX1, "--structure", "--phi", "30")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml",)],
    },
    "live": {
        USAGE: [(EX1, "--nonsense")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml",)],
    },
    "play": {
        DONE: [(EX1,)],
        USAGE: [(EX1, "--position", "99")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml",)],
    },
    "animate": {
        USAGE: [(EX1, "--format", "avi")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml",)],
    },
    "convert": {DONE: [(EX1,)], USAGE: [(EX1, "--nonsense")], PROBLEM: [("faulty.toml",)]},
    "defence": {
        USAGE: [(EX1, "--nonsense")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml",)],
    },
    "audit": {
        DONE: [(EX1,), ("open.toml",)],  # whose source prints no values
        USAGE: [(EX1, "--nonsense")],
        PROBLEM: [("faulty.toml",)],
    },
    "bench": {USAGE: [(EX1, "--nonsense")], PROBLEM: [("faulty.toml",)]},
    "batch": {
        USAGE: [(EX1, "--nonsense")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml", "--jobs", "1")],
    },
    "project": {
        USAGE: [(EX1, "--nonsense")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml",)],
    },
    "note": {
        USAGE: [(EX1, "--format", "odt")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml",)],
    },
    "form": {
        DONE: [(EX1, "-o", "form.xlsx")],
        USAGE: [(EX1, "--nonsense")],
        PROBLEM: [("faulty.toml",)],
        ASSEMBLY: [("open.toml",)],
    },
    "check": {
        DONE: [(EX3, "--key")],
        FINDINGS: [(VARIANTS, "group.csv")],  # one student's variant does not exist
        USAGE: [(EX3,), (EX3, "absent.csv")],
        PROBLEM: [("faulty.toml", "--key")],
        ASSEMBLY: [("open.toml", "--key")],
    },
    "variants": {
        FINDINGS: [
            (EX3, "--count", "30", "--tries", "20", "-o", "none.csv"),
            (EX3, "--count", "10", "--tries", "60", "--seed", "1", "-o", "fewer.csv"),
        ],
        USAGE: [(EX3, "-o", "t.xlsx"), (EX3, "--vary", "nothing")],
        PROBLEM: [("faulty.toml",)],
    },
    "teeth": {
        DONE: [("--scheme", "two-stage", "--U", "6")],
        FINDINGS: [("--scheme", "two-stage", "--U", "6.0001", "--within", "0")],
        USAGE: [("--scheme", "nonsense", "--U", "6")],
    },
    "synthesize": {
        DONE: [("slotted", "--K_v", "1.6", "--centres", "0.4", "--stroke", "0.3")],
        FINDINGS: [("three-angles", "--angles", "10,100;200,70;290,20")],  # they are not passed
        USAGE: [("nonsense",), ()],
        ASSEMBLY: [("slider-crank", "--stroke", "0.2", "--lambda", "1")],
    },
    "tasks": {DONE: [()], USAGE: [("--nonsense",)]},
    "layouts": {DONE: [()], USAGE: [("nonsense",)]},
    "schema": {DONE: [()], USAGE: [("--nonsense",)]},
    "specimen": {USAGE: [("--format", "dwg")]},
    "new": {DONE: [("four-bar",)], USAGE: [("nonsense",), ()]},
    "studio": {USAGE: [("--nonsense",)]},
}


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("faulty.toml").write_text(FAULTY, "utf-8")
    Path("open.toml").write_text(NOT_CLOSED, "utf-8")
    Path("group.csv").write_text(GROUP, "utf-8")


def run(*args: str) -> Result:
    return CliRunner(env={"PLANMETHOD_LANG": "en"}).invoke(cli, args)


def cases() -> Iterator[tuple[str, ExitCode, tuple[str, ...]]]:
    for command, codes in CASES.items():
        for code, every in codes.items():
            yield from ((command, code, args) for args in every)


@each("command, code, args", cases())
def test_a_command_ends_with_the_code_of_its_outcome(
    command: str, code: ExitCode, args: tuple[str, ...]
) -> None:
    done = run(command, *args)
    assert done.exit_code == code, done.output[-500:]


def test_every_command_has_cases_of_done_or_of_usage() -> None:
    assert {*CASES} == {*cli.list_commands(click.Context(cli))}
    assert all(USAGE in codes for codes in CASES.values())


def test_a_command_declares_when_it_finds_something() -> None:
    """The page of exit codes lists these commands, with what they declare."""
    declared = {name for name in CASES if getattr(command_of(name), "findings", "")}
    assert declared == {name for name, codes in CASES.items() if FINDINGS in codes}


def test_an_internal_error_has_its_code(monkeypatch: pytest.MonkeyPatch) -> None:
    def kind_of(path: Path) -> None:
        raise ProgramError("two readings of {} differ", path.name)

    monkeypatch.setattr("planmethod.kinds.kind_of", kind_of)
    done = run("solve", EX1)
    assert done.exit_code == SELF_CHECK and "two readings of ex1.toml differ" in done.output


def test_fewer_variants_than_requested_are_a_finding() -> None:
    (args,) = (one for one in CASES["variants"][FINDINGS] if "fewer.csv" in one)
    assert run("variants", *args).exit_code == FINDINGS
    found = Path("fewer.csv").read_text("utf-8-sig").splitlines()
    assert 1 < len(found) - 1 < 10


def test_the_code_of_many_problems_is_that_of_the_first_fault() -> None:
    """All files are read before the first is solved."""
    assert run("solve", EX1, "open.toml", "faulty.toml").exit_code == PROBLEM
    assert run("solve", EX1, "open.toml", EX3).exit_code == ASSEMBLY


class Belts(ProblemKind[KindProblem]):
    """A kind of problem that has no more than numbers."""

    table = "belt"

    def load(self, path: Path, variant: str | None) -> KindProblem:
        return KindProblem(name=path.stem, source_file=str(path))

    def record(self, problem: KindProblem, lang: str) -> dict[str, Any]:
        return {"u": 2.5}

    def solved_document(self, problem: KindProblem, language: Language) -> Document:
        return Document(())


def test_a_kind_with_only_numbers_refuses_all_else(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("planmethod.kinds.kind_of", lambda path: Belts())
    Path("belt.toml").write_text("[belt]\n", "utf-8")
    assert run("solve", "belt.toml", "--json").stdout == '{"u": 2.5}\n'
    refused = {
        "protocol": "no step-by-step protocol", "sheet": "no framed sheet", "live": "no live page",
        "play": "no construction to play",
        "lint": "no framed sheet", "audit": "no audit", "form": "no checking of answers",
    }  # fmt: skip
    for command, reason in refused.items():
        done = run(command, "belt.toml")
        assert done.exit_code == PROBLEM and reason in done.output, command
        assert run(command, "belt.toml", "--lang", "ru").exit_code == PROBLEM
    assert run("structure", "belt.toml").exit_code == USAGE
