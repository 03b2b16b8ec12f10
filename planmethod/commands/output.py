"""What a command puts out: text on the terminal, files, and a bar while it works."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import click


def put(text: str, file: str | None) -> None:
    """Print a text, or write it to a file and say so."""
    if file is None or file == "-":
        click.echo(text, nl=not text.endswith("\n"))
        return
    from planmethod.render.output import write

    write(Path(file), text.encode())
    click.echo(file)


def put_parts(parts: Iterable[str], file: str) -> None:
    """Print a long text part by part, or write it to a file, whole or not at all."""
    if file == "-":
        for part in parts:
            click.echo(part, nl=False)
        return
    from planmethod.render.output import opened

    with opened(file) as target:
        for part in parts:
            target.write(part.encode())
    click.echo(file)


def write_drawings(
    drawings: list[Any],
    out: Path,
    stem: str,
    formats: tuple[str, ...],
    *,
    dpi: int = 100,
    author: str | None = None,
    dxf_text: Literal["text", "strokes"] = "text",
) -> None:
    """Write drawings as ``stem.svg``, ``stem-2.svg``...; files appear only when all are made."""
    from planmethod.render.backends import render
    from planmethod.render.backends.canvas import Options
    from planmethod.render.output import write

    options = Options(dpi=dpi, dxf_text=dxf_text)
    if author is not None:
        options = replace(options, author=author)
    files = {
        out / (f"{stem}.{fmt}" if number == 1 else f"{stem}-{number}.{fmt}"): render(
            drawing, fmt, options=options
        )
        for number, drawing in enumerate(drawings, 1)
        for fmt in formats
    }
    for path, data in files.items():
        write(path, data)
    for path in files:
        click.echo(str(path))


def is_narrow() -> bool:
    """Tell whether the terminal's encoding has only some of the letters."""
    encoding = getattr(sys.stdout, "encoding", None)  # there may be no terminal at all
    return not (encoding or "").lower().startswith("utf")


def is_terminal(stream: object) -> bool:
    """Tell whether somebody reads a stream as it is written; a closed one is None."""
    return stream is not None and bool(getattr(stream, "isatty", bool)())


@contextlib.contextmanager
def bar(length: int, *, long: bool) -> Iterator[Callable[[int], None]]:
    """Show on a terminal how far a long work is; what it gives is told of every part done."""
    if not long or not is_terminal(sys.stderr):
        yield lambda done: None
        return
    with click.progressbar(length=length, label="planmethod", file=sys.stderr) as shown:
        yield shown.update
