"""Command line: the commands by name, and the last safety nets; no geometry here.

What a command does not need it does not import: a command's module is imported by its name when the
command is called, as click's documentation has it of lazily loaded subcommands, and the imports
that do the work are inside its functions.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import Any

import click

from planmethod.commands.command import LocalizedCommand, answering
from planmethod.errors import ExitCode
from planmethod.languages import LANGUAGES, choose_language, translate

HELP = {
    "Getting started": {
        "tasks": "list of the shipped textbook tasks",
        "new": "problem file from a template or a shipped task",
        "sketch": "scheme only, also of an unfinished file",
        "solve": "numerical results: tables, JSON, CSV",
        "sheet": "framed sheets: plans, equations, tables",
        "protocol": "step-by-step description of the construction",
        "project": "course project: all sheets, the note, the numbers",
        "note": "explanatory note, Word and PDF",
        "defence": "questions for the defence about your own sheets, with answers",
    },
    "More about a mechanism": {
        "structure": "mobility and Assur groups",
        "live": "interactive page: a slider moves the mechanism",
        "play": "page that draws the construction stroke by stroke",
        "studio": "the whole program on one page in the browser",
        "animate": "animation for slides: GIF and SVG",
        "synthesize": "dimensions of a mechanism, by construction",
        "teeth": "numbers of teeth for a gear ratio",
        "convert": "files of PMKS+, Linkage, pylinkage, Pyslvs; programs in Python",
    },
    "Checking": {
        "check": "grading of a student's or a group's answers",
        "form": "XLSX form for the students' answers",
        "variants": "equivalent variants of a task",
        "lint": "check of the sheets against drawing standards",
        "audit": "comparison of printed values with exact ones",
    },
    "Other commands": {
        "layouts": "list of the shipped sheet layouts",
        "schema": "JSON Schema of problem files, for editors",
        "specimen": "specimen sheets of symbols, lines and lettering",
        "batch": "sheets and answer keys of all variants, also on a cluster",
        "bench": "benchmark of speed and accuracy on your problems",
    },
}
"""Commands by group; each is the function of its name in the module of its name."""

COMMANDS = tuple(name for group in HELP.values() for name in group)


FIRST = """\
planmethod draws and computes a mechanism from a problem file. To start:

  planmethod new four-bar my.toml   write a problem file to fill in
  planmethod solve my.toml          print the results
  planmethod sheet my.toml          draw the sheets into the folder out

All commands: planmethod --help. One command: planmethod sheet --help."""
"""Text for a user who runs the program for the first time."""


def command_of(name: str) -> click.Command:
    """Import a command of `COMMANDS`: the function of its name in the module of its name."""
    command = getattr(import_module(f"planmethod.commands.{name}"), name)
    assert isinstance(command, click.Command), name
    return command


class Commanded(LocalizedCommand, click.Group):
    """Group of commands in the language of the command line; it imports them late."""

    def list_commands(self, _ctx: click.Context) -> list[str]:
        """Return the names of the commands."""
        return list(COMMANDS)

    def get_command(self, _ctx: click.Context, name: str) -> click.Command | None:
        """Return a command; None where there is no such command."""
        return command_of(name) if name in COMMANDS else None

    def format_commands(self, _ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write what the commands do, none of them imported."""
        for group, names in HELP.items():
            with formatter.section(translate(group)):
                formatter.write_dl(
                    [(name.ljust(10), translate(text)) for name, text in names.items()]
                )

    def main(self, args: Sequence[str] | None = None, *rest: Any, **more: Any) -> Any:
        """Run a command."""
        words = sys.argv[1:] if args is None else args
        with answering(choose_language(words)):
            return super().main(args, *rest, **more)


@click.group(
    cls=Commanded,
    context_settings={"help_option_names": ["-h", "--help"]},
    invoke_without_command=True,
)
@click.version_option(package_name="planmethod")
@click.option(
    "--lang",
    type=click.Choice(LANGUAGES),
    help="Language of messages and help; before or after the command.",
)
@click.pass_context
def cli(ctx: click.Context, lang: str | None) -> None:
    """Draw and compute linkages by the graphical plan method (метод планов)."""
    if lang is not None:
        ctx.default_map = {name: {"lang": lang} for name in COMMANDS}
    if ctx.invoked_subcommand is None:
        click.echo(translate(FIRST))


LESS = "Request fewer positions at once."


def main() -> None:
    """Run the command line; no traceback reaches a user."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # a Russian console has no Greek or arrows
    with answering(choose_language(sys.argv[1:])):
        _run()


def _run() -> None:
    try:
        code = cli(standalone_mode=False)  # else an interruption would be click's, and a finding
        sys.exit(code if isinstance(code, int) else ExitCode.DONE)
    except SystemExit as end:
        # click exits with 1 when the reader closes the pipe: that is not a finding.
        closed = "PacifyFlushWrapper" in type(sys.stdout).__name__
        sys.exit(ExitCode.DONE if closed and end.code == 1 else end.code)
    except click.ClickException as error:
        error.show()
        sys.exit(error.exit_code)
    except click.Abort as end:
        raise KeyboardInterrupt from end
    except BrokenPipeError:
        sys.exit(ExitCode.DONE)
    except UnicodeEncodeError as error:
        text = str(error.object)[max(0, error.start - 20) : error.end + 20]
        told = translate(
            "Error: '{}': an argument of the command line, or the name of a file, is not "
            "UTF-8. Type it again, or rename the file.",
            text,
        )
        click.echo(told, err=True)
        sys.exit(ExitCode.USAGE)
    except MemoryError:
        click.echo(translate("Error: there is not enough memory. {}", LESS), err=True)
        sys.exit(ExitCode.USAGE)
    except ImportError as error:
        told = translate(
            "Error: a part of the program cannot be loaded: {}. Reinstall planmethod with "
            "its dependencies; or there is not enough memory.",
            (str(error).strip() or type(error).__name__).splitlines()[-1],
        )
        click.echo(told, err=True)
        sys.exit(ExitCode.USAGE)
    except Exception as error:  # the last safety net
        from planmethod.render.backends.output import cause_of, unwritten

        if (cause := unwritten(error)) is not None:
            click.echo(translate("Error: cannot write the output: {}.", cause_of(cause)), err=True)
            sys.exit(ExitCode.USAGE)
        click.echo(
            translate(
                "Internal error in planmethod ({}: {}). Please report the problem file and "
                "the command.",
                type(error).__name__,
                error,
            ),
            err=True,
        )
        sys.exit(ExitCode.SELF_CHECK)
