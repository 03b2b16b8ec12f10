"""Option ``--watch``: a command done again whenever one of its problem files is saved."""

from __future__ import annotations

import contextlib
import functools
import io
import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, TypeVar

import click

from planmethod.commands.output import write_drawings

F = TypeVar("F", bound=Callable[..., Any])

PAUSE = 0.15
"""Pause between two checks of the files, s."""


def watch_option(*, draws: bool = False) -> Callable[[F], F]:
    """Add ``--watch`` to a command whose files are its argument ``problems``.

    Errors of a file are printed as usual, and the next saving is awaited; Ctrl+C ends.

    Parameters
    ----------
    draws : bool
        Whether the errors are also drawn in place of the sheet.
    """

    def add(command: F) -> F:
        @functools.wraps(command)
        def again(*args: Any, watch: bool, problems: tuple[Path, ...], **kwargs: Any) -> None:
            if not watch:
                command(*args, problems=problems, **kwargs)
            while watch:
                seen = stamps(problems)
                said = io.StringIO()
                try:
                    with contextlib.redirect_stderr(said):
                        command(*args, problems=problems, **kwargs)
                except SystemExit:  # the next saving may fix the error
                    if draws:
                        _write_notice(said.getvalue(), problems, **kwargs)
                click.echo(said.getvalue(), nl=False, err=True)
                sys.stdout.flush()
                while stamps(problems) == seen:
                    time.sleep(PAUSE)

        option = click.option("--watch", is_flag=True, help="Do it again whenever a file is saved.")
        return option(again)  # type: ignore[return-value]

    return add


def _write_notice(
    message: str,
    problems: tuple[Path, ...],
    *,
    out: Path,
    formats: tuple[str, ...],
    variant: str | None = None,
    one_file: str | None = None,
    **_: object,
) -> None:
    """Write the errors in place of the sheet of the only problem."""
    if len(problems) > 1 or one_file is not None:
        return
    from planmethod.render.sketch import notice

    name = problems[0].stem if variant is None else f"{problems[0].stem}-{variant}"
    write_drawings([notice(message)], out, name, formats)


def stamps(paths: Iterable[Path]) -> list[tuple[int, int] | None]:
    """Return times and sizes of files; None for a missing one."""
    found: list[tuple[int, int] | None] = []
    for path in paths:
        try:
            state = path.stat()
        except OSError:  # an editor may be just replacing it
            found.append(None)
        else:
            found.append((state.st_mtime_ns, state.st_size))
    return found
