"""Command ``layouts``: the shipped compositions of sheets, to look at or to start from."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.output import LocalizedCommand, reject_unknown, write_new
from planmethod.commands.problems import guarded
from planmethod.options import PathType, lang_option


@click.command(cls=LocalizedCommand)
@click.argument("name", required=False)
@click.argument("file", required=False, type=PathType(dir_okay=False))
@click.option("--force", is_flag=True, help="Write over an existing file.")
@lang_option
@guarded
def layouts(name: str | None, file: Path | None, force: bool, lang: str) -> None:
    """List the shipped layouts of sheets, print the one called NAME, or write it into a FILE.

    Edit the file and draw with it: planmethod sheet --layout FILE PROBLEM. The keys:
    docs/layout.md.
    """
    from planmethod.render.sheets.compositions import SHIPPED, about, shipped_text

    if name is None:
        width = max(map(len, SHIPPED))
        for shipped in SHIPPED:
            click.echo(f"{shipped.ljust(width)}  {about(shipped, lang)}")
        return
    reject_unknown("no layout {!r}", name, SHIPPED)
    if file is None:
        click.echo(shipped_text(name, lang), nl=False)
    else:
        write_new(file, shipped_text(name, lang), force=force)
