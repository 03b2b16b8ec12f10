"""Claims on the options of every command."""

from __future__ import annotations

import re
from pathlib import Path

import click
import numpy as np
import pytest
from click.testing import CliRunner
from doors import (
    COMMANDS,
    BatchOptions,
    DrawingOptions,
    LintOptions,
    PlanRequest,
    ProblemChoice,
    ProtocolOptions,
    ResultRequest,
    SheetOptions,
    SolveOptions,
    argument,
    cli,
    command,
    command_of,
    fill_record,
    find_linkage_options,
    option,
)
from msgspec import Struct, field
from worked import path_of

EX1, EX3 = str(path_of("linkages/ex1")), str(path_of("linkages/ex3"))


def single(name: str) -> list[click.Option]:
    """Return the options of a command that take one value."""
    return [
        param
        for param in command_of(name).params
        if isinstance(param, click.Option)
        and not param.is_flag
        and not param.multiple
        and param.nargs == 1
    ]


def parsed(name: str, words: list[str]) -> click.Context:
    """Return the context of a command line; click keeps the names of the option for help."""
    names = cli.context_settings["help_option_names"]
    return command_of(name).make_context(name, words, help_option_names=names)


@pytest.mark.parametrize("name", COMMANDS)
def test_an_option_given_twice_is_rejected_with_both_values(name: str) -> None:
    for one in single(name):
        long = max(one.opts, key=len)
        first, second = ["ru", "en"] if long == "--lang" else ["17", "29"]
        done = CliRunner().invoke(cli, [name, f"{one.opts[0]}", first, f"{long}={second}"])
        assert done.exit_code == 2, (name, long, done.output)
        told = " ".join(done.output.split())
        assert f"{long} is given 2 times: {first}, {second}. Give it once." in told or (
            f"ключ {long} указан 2 раза: {first}, {second}. Укажите его один раз." in told
        )


def test_an_option_whose_value_may_be_left_out_is_given_once() -> None:
    done = CliRunner().invoke(cli, ["--lang", "en", "solve", EX3, "--csv", "o.csv", "--csv"])
    assert done.exit_code == 2
    assert "--csv is given 2 times: o.csv, -. Give it once." in " ".join(done.output.split())


def test_a_switch_is_not_both_on_and_off_and_may_be_repeated() -> None:
    done = CliRunner().invoke(cli, ["sheet", EX3, "--sigma", "--no-sigma"])
    assert done.exit_code == 2
    assert "--sigma" in done.output
    assert "--no-sigma" in done.output
    parsed("sheet", [EX3, "--compact", "--compact"])


def test_fields_of_the_title_block_are_given_one_by_one() -> None:
    words = [EX3, "--stamp", "author=Иванов", "--stamp", "group=М-31"]
    context = parsed("sheet", words)
    assert context.params["fields"] == {"author": "Иванов", "group": "М-31"}


def test_a_word_after_two_dashes_is_not_an_option() -> None:
    context = parsed("solve", ["--phi", "20", "--", "--phi", "30"])
    assert [str(path) for path in context.params["problems"]] == ["--phi", "30"]


@pytest.mark.parametrize(
    ("name", "record"),
    [
        ("batch", BatchOptions),
        ("lint", LintOptions),
        ("protocol", ProtocolOptions),
        ("sheet", SheetOptions),
        ("solve", SolveOptions),
    ],
)
def test_a_record_of_python_has_the_defaults_of_the_command_line(
    name: str, record: type[Struct]
) -> None:
    context = parsed(name, [EX3])
    choice = ProblemChoice(problems=(Path(EX3),))
    assert fill_record(record, context.params) == record(choice=choice)


def test_a_field_of_a_record_is_an_option_of_its_command() -> None:
    class Margins(Struct, frozen=True):
        left: int = option("--left", default=20, help="Binding margin, mm.")
        names: tuple[str, ...] = option("--names", read=lambda text: tuple(text.split(",")))

    class Paper(Struct, frozen=True):
        path: str = argument()
        margins: Margins = field(default_factory=Margins)
        is_wide: bool = option("--wide", is_flag=True)

    given: list[Paper] = []

    @command(Paper)
    def cut(paper: Paper) -> None:
        """Cut the paper."""
        given.append(paper)

    shown = CliRunner().invoke(cut, ["--help"]).output
    assert re.findall(r"--\w+", shown) == ["--left", "--names", "--wide", "--help"]
    assert "Binding margin, mm." in shown
    assert CliRunner().invoke(cut, ["a", "--names", "b,c"]).exit_code == 0
    assert given == [Paper(path="a", margins=Margins(names=("b", "c")))]
    assert Paper("a").margins.left == 20


def test_options_of_linkages_are_named_in_the_order_of_the_help() -> None:
    request = PlanRequest(
        phi=np.array([20.0]), position=0, layout="forces", drawing=DrawingOptions(sigma=False)
    )
    assert [*find_linkage_options(request)] == ["--phi", "--position", "--layout"]
    assert not [*find_linkage_options(ResultRequest(as_json=True))]


# --open ------------------------------------------------------------------------------------------


def launches(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return the list to which every file opened by the system is added."""
    launched: list[str] = []

    def launch(url: str) -> int:
        launched.append(url)
        return 0

    monkeypatch.setattr("click.launch", launch)
    return launched


@pytest.mark.parametrize(
    ("words", "shown"),
    [
        (["sheet", EX1, EX3, "--format", "svg"], "ex1.svg"),
        (["sheet", EX1, "--format", "svg,pdf"], "ex1.pdf"),
        (["sheet", EX1, EX3, "--format", "svg", "--jobs", "2"], "ex1.svg"),
        (["sheet", EX1, "--format", "dxf"], "ex1.dxf"),
        (["sheet", EX1, "--format", "pdf", "--one-file", "all.pdf"], "all.pdf"),
        (["live", EX1, EX3], "ex1-live.html"),
        (["play", EX1], "ex1-play.html"),
        (["sketch", EX1], "ex1-sketch.html"),
        (["project", EX1, "--parts", "kinematics"], "ex1/project.pdf"),
        (["note", EX1], "ex1-note.docx"),
    ],
)
def test_one_written_file_is_shown(
    words: list[str], shown: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    launched = launches(monkeypatch)
    done = CliRunner().invoke(cli, [*words, "-o", str(tmp_path), "--open"])
    assert done.exit_code == 0, done.output
    assert launched == [str(tmp_path / shown)]
    assert (tmp_path / shown).exists()


def test_a_file_without_a_viewer_is_written_and_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("click.launch", lambda url: 1)
    words = ["live", EX1, "-o", str(tmp_path), "--open", "--lang", "en"]
    done = CliRunner().invoke(cli, words)
    assert done.exit_code == 0
    page = tmp_path / "ex1-live.html"
    assert page.exists()
    assert f"no program of this system opens {page}" in done.stderr


def test_no_file_of_a_failing_problem_is_opened(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    launched = launches(monkeypatch)
    done = CliRunner().invoke(cli, ["sheet", "none.toml", "-o", str(tmp_path), "--open"])
    assert done.exit_code == 3
    assert not launched
