"""Command line: the commands by name, and the last safety nets; no geometry here.

What a command does not need it does not import: a command's module is imported when the command is
called, and the imports of the work stand in its functions.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any

import click

from planmethod.commands.output import settle_process
from planmethod.errors import ExitCode

COMMANDS = (
    "sheet",
    "solve",
    "structure",
    "protocol",
    "live",
    "animate",
    "sketch",
    "audit",
    "lint",
    "specimen",
    "layouts",
    "new",
    "tasks",
    "synthesize",
    "teeth",
    "check",
    "bench",
    "form",
    "batch",
)
"""Names of the commands; each is a function of the module of its name in `planmethod.commands`."""


class Commands(Mapping[str, click.Command]):
    """Commands by name, each imported when it is first looked up."""

    def __getitem__(self, name: str) -> click.Command:
        if name not in COMMANDS:
            raise KeyError(name)
        command: click.Command = getattr(import_module(f"planmethod.commands.{name}"), name)
        return command

    def __iter__(self) -> Iterator[str]:
        return iter(COMMANDS)

    def __len__(self) -> int:
        return len(COMMANDS)


LAZY: Any = Commands()


@click.group(context_settings={"help_option_names": ["-h", "--help"]}, commands=LAZY)
@click.version_option(package_name="planmethod")
def cli() -> None:
    """Draw and compute linkages by the graphical plan method (метод планов)."""


def main() -> None:
    """Run the command line; no traceback reaches a user."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # a Russian console has no Greek or arrows
    settle_process()
    try:
        cli()
    except SystemExit as end:
        # click exits with 1 when the reader closes the pipe: that is not a finding.
        closed = "PacifyFlushWrapper" in type(sys.stdout).__name__
        sys.exit(ExitCode.DONE if closed and end.code == 1 else end.code)
    except BrokenPipeError:
        sys.exit(ExitCode.DONE)
    except OSError as error:
        click.echo(f"Error: cannot write the output: {error.strerror or error}.", err=True)
        sys.exit(ExitCode.USAGE)
    except Exception as error:  # the last safety net
        click.echo(
            f"Error: planmethod failed inside ({type(error).__name__}: {error}). Please report the "
            "problem file and the command.",
            err=True,
        )
        sys.exit(ExitCode.SELF_CHECK)
