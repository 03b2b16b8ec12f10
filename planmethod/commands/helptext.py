"""Help and errors of the command line in the language that is spoken; their words are click's own.

Click looks its sentences up by `gettext`, by which name its modules import it; here they are looked
up in the catalogues of messages, as all others are. Help of commands and options is written in
English where they are, and translated when it is shown.
"""

from __future__ import annotations

import copy
import inspect

import click
from click import core, exceptions, formatting, parser, termui, types

from planmethod.languages import say, translated


def _of_number(one: str, many: str, count: int) -> str:
    return translated(one if count == 1 else many)


class _Kind(str):
    """What a path is called, "file": translated when it is told, and few runs tell it."""

    __slots__ = ()

    def title(self) -> str:
        """Return it as it begins a sentence."""
        return translated(str(self)).title()

    def upper(self) -> str:
        """Return it as it stands for a value."""
        return translated(str(self)).upper()


def _kind_or_sentence(text: str) -> str:
    return translated(text) if " " in text else _Kind(text)


# The sentences of `decorators` are help.
for _module in (core, exceptions, formatting, parser, termui, types):
    for _name, _look_up in (("_", translated), ("ngettext", _of_number)):
        if hasattr(_module, _name):
            setattr(_module, _name, _look_up)
types._ = _kind_or_sentence  # type: ignore[attr-defined, assignment]


class Spoken(click.Command):
    """Command whose help is in the language that is spoken."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments, short options by their long names.

        Click looks for a short one among the long ones first, and words and translates a message
        that there is none.
        """
        options = [param.opts for param in self.params if isinstance(param, click.Option)]
        long = {name: max(names, key=len) for names in options for name in names}
        end = args.index("--") if "--" in args else len(args)
        words = [*(long.get(a, a) for a in args[:end]), *args[end:]]
        if not ctx.resilient_parsing:
            self._refuse_repeated(ctx, words)
        return super().parse_args(ctx, words)

    def _refuse_repeated(self, ctx: click.Context, words: list[str]) -> None:
        """Refuse an option of one value that is given twice; click takes the last silently."""
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
                continue  # a flag that is given twice says nothing else
            if option.is_flag:
                said = say("give {} or {}, not both", max(option.opts), max(option.secondary_opts))
            else:
                listed = ", ".join(
                    " ".join(one) if isinstance(one, tuple) else one for one in values
                )
                said = say(
                    "{0} is given {1} time{1:||s}: {2}. Give it once.",
                    max(option.opts, key=len),
                    len(values),
                    listed,
                )
            raise click.UsageError(said, ctx)

    def get_help(self, ctx: click.Context) -> str:
        """Return the help, of the options as well."""
        told = self._translated()
        told.params = [_translated(param, ctx) for param in self.get_params(ctx)]
        told.add_help_option = False  # it is among them
        return super(Spoken, told).get_help(ctx)

    def collect_usage_pieces(self, ctx: click.Context) -> list[str]:
        """Return what follows the command where it is told how to call it."""
        return [translated(piece) for piece in super().collect_usage_pieces(ctx)]

    def _translated(self) -> Spoken:
        told = copy.copy(self)
        told.help = translated(inspect.cleandoc(self.help or ""))
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
        told.help = translated(told.help)
    if not (isinstance(told, click.Option) and told.is_flag):
        told.metavar = translated(param.make_metavar(ctx))
    return told
