"""A command of its record of options: its parameters, its help, its errors, ``--watch``."""

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
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import click
from msgspec import Struct

from planmethod.errors import PlanMethodError
from planmethod.languages import WORDING, look_up_translation, speaking, translate
from planmethod.options import fill_record, make_parameters

P = ParamSpec("P")
R = TypeVar("R", bound=Struct)


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
    """Command whose help is in the current language.

    Attributes
    ----------
    findings : str
        When its exit code is `ExitCode.FINDINGS`; empty if it never is.
    """

    findings: str = ""

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
                listed = ", ".join(_written(option, value) for value in values)
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


def _written(option: click.Option, value: object) -> str:
    """Return a value as it was written; one that was left out is the option's own."""
    if isinstance(value, tuple):
        return " ".join(value)
    return value if isinstance(value, str) else str(option.flag_value)


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


# A command of a record ---------------------------------------------------------------------------


def guarded(act: Callable[P, None]) -> Callable[P, None]:
    """Turn the package's errors into a message and an exit code."""

    @functools.wraps(act)
    def run(*args: P.args, **kwargs: P.kwargs) -> None:
        try:
            act(*args, **kwargs)
        except PlanMethodError as error:
            click.echo(translate("Error: {}", error), err=True)
            sys.exit(error.exit_code)

    return run


def command(
    record: type[R],
    *,
    on_failure: Callable[[R, str], None] | None = None,
    findings: str = "",
) -> Callable[[Callable[[R], None]], LocalizedCommand]:
    """Make a command of a function that takes a record of options.

    Its parameters are the options that the fields of the record declare, in their order; its help
    is the function's docstring. The package's errors end it with a message and an exit code.

    Parameters
    ----------
    record : type
        Where it has an option ``watch``, the files that are watched are its ``problems``.
    on_failure : callable, optional
        Receives the options and the errors of a run that is watched.
    findings : str, optional
        When the exit code is `ExitCode.FINDINGS`.
    """

    def decorate(act: Callable[[R], None]) -> LocalizedCommand:
        run = guarded(act)

        def call(**values: Any) -> None:
            options = fill_record(record, values)
            if not values.get("watch"):
                run(options)
            while values.get("watch"):
                _run_once(run, options, values["problems"], on_failure)

        made = LocalizedCommand(
            act.__name__, params=[*make_parameters(record)], callback=call, help=act.__doc__
        )
        made.findings = findings
        return made

    return decorate


PAUSE = 0.15
"""Pause between two checks of the files, s."""


def _run_once(
    run: Callable[[R], None],
    options: R,
    paths: Iterable[Path],
    on_failure: Callable[[R, str], None] | None,
) -> None:
    """Run a command, print its errors as usual, and wait until a file is saved; Ctrl+C ends."""
    seen = stamps(paths)
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said):
            run(options)
    except SystemExit:  # the next saving may fix the error
        if on_failure is not None:
            on_failure(options, said.getvalue())
    click.echo(said.getvalue(), nl=False, err=True)
    sys.stdout.flush()
    while stamps(paths) == seen:
        time.sleep(PAUSE)


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
