"""Command ``schema``: the keys of problem files, as editors read them (схема файла задачи)."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.output import LocalizedCommand, write_new
from planmethod.commands.problems import guarded
from planmethod.options import PathType, lang_option


@click.command(cls=LocalizedCommand)
@click.argument("file", required=False, type=PathType(dir_okay=False))
@click.option("--force", is_flag=True, help="Write over an existing file.")
@lang_option
@guarded
def schema(file: Path | None, force: bool, lang: str) -> None:
    """Print the JSON Schema of problem files, or write it into a FILE.

    An editor completes and explains keys by it. In VS Code with Even Better TOML write it beside
    your problem files, planmethod schema planmethod.schema.json, and begin each of them with the
    line: #:schema ./planmethod.schema.json
    """
    from planmethod.problem import schema_text

    text = schema_text(lang)
    if file is None:
        click.echo(text, nl=False)
    else:
        write_new(file, text, force=force)
