"""The commands and their options, and the exit codes, from the declarations of click."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping
from typing import Any

import click

from planmethod.cli import COMMANDS, HELP, cli, command_of
from planmethod.commands.command import LocalizedCommand, answering
from planmethod.errors import EXIT_CODES
from planmethod.languages import look_up_translation, translate
from scripts.reference.markdown import code, prose, sentence, table, words


def commands_page(lang: str) -> str:
    """Return the commands by group, in the order of ``planmethod --help``."""
    said = words("commands", lang)
    parts: list[str] = []
    with answering(lang):
        for group, names in HELP.items():
            rows = [
                (f"[`{name}`](#{name})", prose(translate(text), lang))
                for name, text in names.items()
            ]
            parts += [f"## {translate(group)}", table(said["heads"], rows)]
            for name in names:
                parts += _command(name, lang, said)
        whole = click.Context(cli, info_name="planmethod")
        parts += [said["program"].strip(), _options(cli, whole, lang, said)]
    return "\n\n".join(parts)


def _command(name: str, lang: str, said: dict[str, Any]) -> Iterator[str]:
    """Yield the parts of a command."""
    one = command_of(name)
    parent = click.Context(cli, info_name="planmethod")
    context = click.Context(one, info_name=name, parent=parent)
    yield f"### {name}"
    first, *more = look_up_translation(inspect.cleandoc(one.help or "")).split("\n\n")
    yield prose(first, lang)
    usage = " ".join([context.command_path, *one.collect_usage_pieces(context)])
    yield f"```text\n{usage}\n```"
    yield from (prose(text, lang) for text in more)
    stated = any(said["code"] in " ".join(text.split()) for text in more)
    if isinstance(one, LocalizedCommand) and one.findings and not stated:
        yield f"{said['findings']} {prose(sentence(translate(one.findings)), lang)}"
    if options := _options(one, context, lang, said):
        yield options


def _options(one: click.Command, context: click.Context, lang: str, said: dict[str, Any]) -> str:
    """Return the table of a command's options."""
    rows = []
    for param in one.params:
        if isinstance(param, click.Option) and not param.hidden:
            meaning = _meaning(look_up_translation(param.help or ""), lang)
            rows.append((_spelling(param, context), meaning, _default(param, context, said)))
    return table(said["option_heads"], rows) if rows else ""


def _meaning(text: str, lang: str) -> str:
    """Return the help of an option; a list of values alone is code."""
    if text and " " not in text:
        return code(text.rstrip("."))
    return sentence(prose(text, lang)) if text else ""


def _spelling(param: click.Option, context: click.Context) -> str:
    """Return how an option is written, with its value."""
    flags = ", ".join(code(flag) for flag in (*param.opts, *param.secondary_opts))
    if param.is_flag:
        return flags
    return f"{flags} {code(look_up_translation(param.make_metavar(context)))}"


def _default(param: click.Option, context: click.Context, said: Mapping[str, str]) -> str:
    """Return the default that the help shows, and the range of a number."""
    extra = param.get_help_extra(context)
    if "required" in extra:
        return said["required"]
    found = str(extra.get("default", "")).strip("()")
    return "; ".join(code(one) for one in (found, str(extra.get("range", ""))) if one)


def exit_codes_page(lang: str) -> str:
    """Return the meanings of the exit codes, and what 1 means by command."""
    said = words("exit-codes", lang)
    with answering(lang):
        rows = [(str(int(one)), sentence(translate(text))) for one, text in EXIT_CODES.items()]
        found = [
            (f"[`{name}`](commands.md#{name})", prose(sentence(translate(one.findings)), lang))
            for name in COMMANDS
            if isinstance(one := command_of(name), LocalizedCommand) and one.findings
        ]
    by_command = table(said["command_heads"], found)
    return "\n\n".join([table(said["heads"], rows), said["findings"].strip(), by_command])
