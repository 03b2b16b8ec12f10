"""Output and help of a command in the current language; the option ``--watch``."""

from __future__ import annotations

import contextlib
import copy
import functools
import gettext
import inspect
import io
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import click
import msgspec
from msgspec.structs import replace

from planmethod.languages import WORDING, look_up_translation, speaking, translate
from planmethod.options import UsageError

if TYPE_CHECKING:
    from planmethod.render.ink.drawing import Drawing


DOMAIN = "click"
"""Domain of `gettext` of the sentences of click."""


@contextmanager
def answering(lang: str) -> Iterator[None]:
    """Use a language for a while, and have click use it."""
    domain, asked = gettext.textdomain(), os.environ.get("LANGUAGE")
    gettext.bindtextdomain(DOMAIN, str(WORDING))
    gettext.textdomain(DOMAIN)
    os.environ["LANGUAGE"] = lang  # the first that gettext looks at
    try:
        with speaking(lang):
            yield
    finally:
        gettext.textdomain(domain)
        if asked is None:
            del os.environ["LANGUAGE"]
        else:
            os.environ["LANGUAGE"] = asked


class LocalizedCommand(click.Command):
    """Command whose help is in the current language."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments, short options by their long names.

        Click searches for a short one among the long ones first, and translates a message that it
        is missing.
        """
        options = [param.opts for param in self.params if isinstance(param, click.Option)]
        long = {name: max(names, key=len) for names in options for name in names}
        end = args.index("--") if "--" in args else len(args)
        words = [*(long.get(a, a) for a in args[:end]), *args[end:]]
        if not ctx.resilient_parsing:
            self._reject_repeated(ctx, words)
        return super().parse_args(ctx, words)

    def _reject_repeated(self, ctx: click.Context, words: list[str]) -> None:
        """Reject an option of one value that is given twice; click takes the last silently."""
        single = {
            param.name: param
            for param in self.params
            if isinstance(param, click.Option) and not param.multiple and not param.count
        }
        told = copy.copy(self)
        told.params = [_repeatable(param) for param in self.params]
        given, _, _ = told.make_parser(ctx).parse_args(args=list(words))
        for name, values in given.items():
            option = single.get(name)
            if option is None or len(values) < 2 or (option.is_flag and len({*values}) < 2):
                continue  # a repeated flag has the same meaning
            if option.is_flag:
                phrase = translate(
                    "give {} or {}, not both", max(option.opts), max(option.secondary_opts)
                )
            else:
                listed = ", ".join(
                    " ".join(one) if isinstance(one, tuple) else one for one in values
                )
                phrase = translate(
                    "{0} is given {1} time{1:||s}: {2}. Give it once.",
                    max(option.opts, key=len),
                    len(values),
                    listed,
                )
            raise click.UsageError(phrase, ctx)

    def get_help(self, ctx: click.Context) -> str:
        """Return the help, of the options as well."""
        told = self._translated()
        told.params = [_translated(param, ctx) for param in self.get_params(ctx)]
        told.add_help_option = False  # it is among them
        return super(LocalizedCommand, told).get_help(ctx)

    def collect_usage_pieces(self, ctx: click.Context) -> list[str]:
        """Return the text after the command in its usage line."""
        return [look_up_translation(piece) for piece in super().collect_usage_pieces(ctx)]

    def _translated(self) -> LocalizedCommand:
        told = copy.copy(self)
        told.help = look_up_translation(inspect.cleandoc(self.help or ""))
        return told


def _repeatable(param: click.Parameter) -> click.Parameter:
    """Return a parameter that keeps all values it is given."""
    kept = copy.copy(param)
    if isinstance(kept, click.Option) and not kept.count:
        kept.multiple = True
    return kept


def _translated(param: click.Parameter, ctx: click.Context) -> click.Parameter:
    told = copy.copy(param)
    if isinstance(told, click.Option) and told.help:
        told.help = look_up_translation(told.help)
    if not (isinstance(told, click.Option) and told.is_flag):
        told.metavar = look_up_translation(param.make_metavar(ctx))
    return told


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
    dpi: int = 100,
    author: str | None = None,
    dxf_text: Literal["text", "strokes"] = "strokes",
) -> list[Path]:
    """Write the sheets of a problem and return the files; all or none appear (`drawing_files`)."""
    from planmethod.render.backends.output import write

    files = drawing_files(drawings, basename, formats, dpi=dpi, author=author, dxf_text=dxf_text)
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
    dpi: int = 100,
    author: str | None = None,
    dxf_text: Literal["text", "strokes"] = "strokes",
) -> dict[str, bytes]:
    """Return the files of sheets by their names.

    A format with pages has one file for all sheets, ``basename.pdf``; of the others each sheet
    has its own, ``basename.svg``, ``basename-2.svg``...
    """
    from planmethod.render.backends import PAGED, render, render_pages
    from planmethod.render.backends.canvas import Options

    options = Options(dpi=dpi, dxf_text=dxf_text)
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
