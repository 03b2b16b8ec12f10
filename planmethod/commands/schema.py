"""Command ``schema``: the keys of problem files, as editors read them (схема файла задачи)."""

from __future__ import annotations

from pathlib import Path

import click
from msgspec import Struct

from planmethod.commands.command import command
from planmethod.commands.output import write_new
from planmethod.options import PathType, argument, force_option, lang_option


class SchemaOptions(Struct, frozen=True, kw_only=True):
    """Options of ``schema``."""

    file: Path | None = argument(required=False, type=PathType(dir_okay=False))
    force: bool = force_option()
    lang: str = lang_option()


@command(SchemaOptions)
def schema(options: SchemaOptions) -> None:
    """Print the JSON Schema of problem files, or write it into FILE.

    Editors use it to complete and explain keys. For VS Code with Even Better TOML, write it beside
    your problem files: planmethod schema planmethod.schema.json. The first line of each problem
    file is then: #:schema ./planmethod.schema.json
    """
    from planmethod.problem import schema_text

    text = schema_text(options.lang)
    if options.file is None:
        click.echo(text, nl=False)
    else:
        write_new(options.file, text, force=options.force)
