"""Command ``new``: a commented problem file of a family."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.helptext import Spoken
from planmethod.commands.output import refuse_unknown, write_new
from planmethod.commands.problems import guarded
from planmethod.languages import say
from planmethod.options import lang_option


@click.command(cls=Spoken)
@click.argument("family", required=False)
@click.argument("file", required=False, type=click.Path(path_type=Path, dir_okay=False))
@click.option("--list", "show", is_flag=True, help="List the families.")
@click.option("--force", is_flag=True, help="Write over an existing file.")
@lang_option
@guarded
def new(family: str | None, file: Path | None, show: bool, force: bool, lang: str) -> None:
    """Write a commented problem file of a FAMILY, ready to edit."""
    from planmethod.problem import FAMILIES, OTHER_FAMILIES, template

    known = (*FAMILIES, *OTHER_FAMILIES)
    if show or family is None:
        from planmethod.note.wording import language

        width, meanings = max(map(len, known)), language(lang).families
        for name in known:
            click.echo(f"{name.ljust(width)}  {meanings[name]}")
        if not show:
            raise click.UsageError(say("give one of these families: planmethod new FAMILY [FILE]"))
        return
    refuse_unknown("no family {!r}", family, known)
    write_new(file or Path(f"{family}.toml"), template(family), force=force)
