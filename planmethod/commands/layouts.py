"""Command ``layouts``: the shipped compositions of sheets, to look at or to start from."""

from __future__ import annotations

from pathlib import Path

import click
from msgspec import Struct

from planmethod.commands.command import command
from planmethod.commands.output import reject_unknown, write_new
from planmethod.options import PathType, argument, force_option, lang_option


class LayoutsOptions(Struct, frozen=True, kw_only=True):
    """Options of ``layouts``."""

    name: str | None = argument(required=False)
    file: Path | None = argument(required=False, type=PathType(dir_okay=False))
    force: bool = force_option()
    lang: str = lang_option()


@command(LayoutsOptions)
def layouts(options: LayoutsOptions) -> None:
    """List the shipped sheet layouts, print the layout NAME, or write it into FILE.

    Edit the file and draw with it: planmethod sheet --layout FILE PROBLEM. The keys:
    docs/reference/layout-file.md.
    """
    from planmethod.render.sheets.compositions import SHIPPED, about, shipped_text

    name, lang = options.name, options.lang
    if name is None:
        width = max(map(len, SHIPPED))
        for shipped in SHIPPED:
            click.echo(f"{shipped.ljust(width)}  {about(shipped, lang)}")
        return
    reject_unknown("no layout {!r}", name, SHIPPED)
    if options.file is None:
        click.echo(shipped_text(name, lang), nl=False)
    else:
        write_new(options.file, shipped_text(name, lang), force=options.force)
