"""Output of a command: texts, JSON, drawings, progress."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import msgspec
from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.options import FileOptions, UsageError

if TYPE_CHECKING:
    from planmethod.render.ink.drawing import Drawing


SPOOLED = 2**20
"""Letters of records that are kept in memory."""


def write_text(text: str, file: str | None, *, folder: Path | None = None) -> None:
    """Print a text, or write it to a file and print the name; ``folder`` is ``--out``."""
    if file is None or file == "-":
        click.echo(text, nl=not text.endswith("\n"))
        return
    from planmethod.render.backends.output import write

    write(Path(file), text.encode(), output_root=folder)
    click.echo(file)


def write_parts(parts: Iterable[str], file: str) -> None:
    """Print a long text part by part, or write it to a file, whole or not at all."""
    if file == "-":
        for part in parts:
            click.echo(part, nl=False)
        return
    from planmethod.render.backends.output import opened

    with opened(file) as target:
        for part in parts:
            target.write(part.encode())
    click.echo(file)


def reject_unknown(message: str, name: str, known: Sequence[str], choices: str = "") -> None:
    """Reject a name (``no layout {!r}``) with the nearest one; ``choices`` replaces a long list."""
    if name not in known:
        from difflib import get_close_matches

        near = get_close_matches(name, known, 1)
        near = near or [one for one in known if one.endswith(f"-{name}")]
        hint = translate("; did you mean {!r}?", near[0]) if near else "."
        listed = choices or ", ".join(known)
        raise UsageError("{}{} Known: {}.", translate(message, name), hint, listed)


def write_new(path: Path, text: str, *, force: bool, folder: Path | None = None) -> None:
    """Write a file to start from, over an existing one by ``force`` only."""
    if path.exists() and not force:
        raise UsageError("{} exists; name another file or give --force", path)
    from planmethod.render.backends.output import write

    write(path, text.encode(), output_root=folder)
    click.echo(str(path))


def write_drawings(
    drawings: Sequence[Drawing],
    out: Path,
    basename: str,
    formats: Iterable[str],
    *,
    author: str | None = None,
    file_options: FileOptions | None = None,
) -> list[Path]:
    """Write the sheets of a problem and return the files; all or none appear (`drawing_files`)."""
    from planmethod.render.backends.output import write

    files = drawing_files(drawings, basename, formats, author=author, file_options=file_options)
    for name, data in files.items():
        write(out / name, data, output_root=out)
    paths = [out / name for name in files]
    for path in paths:
        click.echo(str(path))
    return paths


def drawing_files(
    drawings: Sequence[Drawing],
    basename: str,
    formats: Iterable[str],
    *,
    author: str | None = None,
    file_options: FileOptions | None = None,
) -> dict[str, bytes]:
    """Return the files of sheets by their names.

    A format with pages has one file for all sheets, ``basename.pdf``; of the others each sheet
    has its own, ``basename.svg``, ``basename-2.svg``...
    """
    from planmethod.render.backends import PAGED, render, render_pages
    from planmethod.render.backends.canvas import Options

    file_options = file_options or FileOptions()
    options = Options(dpi=file_options.dpi, dxf_text=file_options.dxf_text)
    if author is not None:
        options = replace(options, author=author)
    files: dict[str, bytes] = {}
    for fmt in formats:
        if fmt in PAGED:
            files[f"{basename}.{fmt}"] = render_pages(drawings, fmt, options=options)
            continue
        for number, drawing in enumerate(drawings, 1):
            name = f"{basename}.{fmt}" if number == 1 else f"{basename}-{number}.{fmt}"
            files[name] = render(drawing, fmt, options=options)
    return files


def show(path: Path) -> None:
    """Open a written file in its default program, once in a run; report if none does."""
    opened = click.get_current_context().meta.setdefault("planmethod.opened", set())
    if path in opened:
        return
    opened.add(path)
    if click.launch(str(path)):
        text = "Note: no program of this system opens {}; open the file yourself."
        click.echo(translate(text, path), err=True)


def write_set(drawings: Sequence[Drawing], path: Path, *, author: str | None = None) -> None:
    """Write sheets as the pages of one PDF in the folder of ``--out``."""
    from planmethod.render.backends import render_pages
    from planmethod.render.backends.canvas import Options
    from planmethod.render.backends.output import write

    options = Options() if author is None else Options(author=author)
    write(path, render_pages(drawings, options=options), output_root=path.parent)
    click.echo(str(path))


def json_text(value: Any) -> str:
    """Return plain data as JSON in one line, in letters that the terminal's encoding has."""
    text = msgspec.json.format(msgspec.json.encode(value), indent=0).decode()
    if is_narrow():
        import json

        return json.dumps(json.loads(text))
    return text


class JsonTexts:
    """Records of many problems: a list of them is printed once all are there (записи).

    The texts wait in a file of the system, not in memory: those of ten thousand variants are 80 MB.
    """

    def __init__(self) -> None:
        self._count = 0

    def __enter__(self) -> JsonTexts:
        import tempfile

        self._file = tempfile.SpooledTemporaryFile(SPOOLED, "w+", encoding="utf-8", newline="")
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def add(self, text: str) -> None:
        """Take the text of one record."""
        self._file.write(", " * bool(self._count) + text)
        self._count += 1

    def echo(self) -> None:
        """Print the only record, or the list of several, if any."""
        if not self._count:
            return
        several = self._count > 1
        self._file.seek(0)
        click.echo("[" * several, nl=False)
        for part in iter(partial(self._file.read, SPOOLED), ""):
            click.echo(part, nl=False)
        click.echo("]" * several)


def is_narrow() -> bool:
    """Return whether the terminal's encoding has only some of the letters."""
    encoding = getattr(sys.stdout, "encoding", None)  # there may be no terminal at all
    return not (encoding or "").lower().startswith("utf")


def is_terminal(stream: object) -> bool:
    """Return whether a stream is a terminal; a closed one is None."""
    return stream is not None and bool(getattr(stream, "isatty", bool)())


@contextlib.contextmanager
def bar(length: int, *, long: bool) -> Iterator[Callable[[int], None]]:
    """Show the progress of long work on a terminal; call what it yields after every part."""
    if not long or not is_terminal(sys.stderr):
        yield lambda done: None
        return
    with click.progressbar(length=length, label="planmethod", file=sys.stderr) as shown:
        yield shown.update
