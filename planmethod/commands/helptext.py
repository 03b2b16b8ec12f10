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

from planmethod.languages import translated


def _of_number(one: str, many: str, count: int) -> str:
    return translated(one if count == 1 else many)


for _module in (core, exceptions, formatting, parser, termui, types):
    for _name, _look_up in (("_", translated), ("ngettext", _of_number)):
        if hasattr(_module, _name):
            setattr(_module, _name, _look_up)


class Spoken(click.Command):
    """Command whose help is in the language that is spoken."""

    def get_help(self, ctx: click.Context) -> str:
        """Return the help, of the options as well."""
        told = self._translated()
        told.params = [_translated(param) for param in self.get_params(ctx)]
        told.add_help_option = False  # it is among them
        return super(Spoken, told).get_help(ctx)

    def get_short_help_str(self, limit: int = 45) -> str:
        """Return the beginning of the help."""
        return super(Spoken, self._translated()).get_short_help_str(limit)

    def _translated(self) -> Spoken:
        told = copy.copy(self)
        told.help = translated(inspect.cleandoc(self.help or ""))
        return told


def _translated(param: click.Parameter) -> click.Parameter:
    told = copy.copy(param)
    if isinstance(told, click.Option) and told.help:
        told.help = translated(told.help)
    return told
