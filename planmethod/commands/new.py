"""Command ``new``: a commented problem file of a family."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.problems import guarded
from planmethod.options import lang_option


@click.command()
@click.argument("family", required=False)
@click.argument("file", required=False, type=click.Path(path_type=Path, dir_okay=False))
@click.option("--list", "show", is_flag=True, help="List the families.")
@click.option("--force", is_flag=True, help="Write over an existing file.")
@lang_option
@guarded
def new(family: str | None, file: Path | None, show: bool, force: bool, lang: str) -> None:
    """Write a commented problem file of a FAMILY, ready to edit."""
    from planmethod.problem import FAMILIES, template

    if show or family is None:
        from planmethod.note.wording import language

        width, meanings = max(map(len, FAMILIES)), language(lang).families
        for name in FAMILIES:
            click.echo(f"{name.ljust(width)}  {meanings[name]}")
        if not show:
            raise click.UsageError("give one of these families: planmethod new FAMILY [FILE]")
        return
    if family not in FAMILIES:
        from difflib import get_close_matches

        near = get_close_matches(family, FAMILIES, 1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise click.UsageError(f"no family {family!r}{hint} Known: {', '.join(FAMILIES)}.")
    path = file or Path(f"{family}.toml")
    if path.exists() and not force:
        raise click.UsageError(f"{path} exists; name another file or give --force")
    from planmethod.render.backends.output import write

    write(path, template(family).encode())
    click.echo(str(path))
