"""What holds for the options of every command."""

from __future__ import annotations

import click
import pytest
from click.testing import CliRunner
from worked import path_of

from planmethod.cli import COMMANDS, cli, command_of

EX3 = str(path_of("linkages/ex3"))


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


@pytest.mark.parametrize("name", COMMANDS)
def test_an_option_that_is_given_twice_is_refused_with_both_values(name: str) -> None:
    for option in single(name):
        long = max(option.opts, key=len)
        first, second = ["ru", "en"] if long == "--lang" else ["17", "29"]
        done = CliRunner().invoke(cli, [name, f"{option.opts[0]}", first, f"{long}={second}"])
        assert done.exit_code == 2, (name, long, done.output)
        told = " ".join(done.output.split())
        assert f"{long} is given 2 times: {first}, {second}. Give it once." in told or (
            f"ключ {long} дан 2 раза: {first}, {second}. Дайте его один раз." in told
        )


def test_a_switch_is_not_on_and_off_and_twice_on_says_nothing_else() -> None:
    done = CliRunner().invoke(cli, ["sheet", EX3, "--sigma", "--no-sigma"])
    assert done.exit_code == 2
    assert "--sigma" in done.output
    assert "--no-sigma" in done.output
    command_of("sheet").make_context("sheet", [EX3, "--compact", "--compact"])


def test_fields_of_the_title_block_are_given_one_by_one() -> None:
    words = [EX3, "--stamp", "author=Иванов", "--stamp", "group=М-31"]
    context = command_of("sheet").make_context("sheet", words)
    assert context.params["stamp"] == {"author": "Иванов", "group": "М-31"}


def test_what_stands_after_two_dashes_is_no_option() -> None:
    context = command_of("solve").make_context("solve", ["--phi", "20", "--", "--phi", "30"])
    assert [str(path) for path in context.params["problems"]] == ["--phi", "30"]
