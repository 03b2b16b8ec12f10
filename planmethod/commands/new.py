"""Command ``new``: a commented problem file of a family."""

from __future__ import annotations

from pathlib import Path

import click
from msgspec import Struct

from planmethod.commands.command import command
from planmethod.commands.output import reject_unknown, write_new
from planmethod.languages import translate
from planmethod.options import (
    PathType,
    UsageError,
    argument,
    force_option,
    lang_option,
    option,
    variant_option,
)


class NewOptions(Struct, frozen=True, kw_only=True):
    """Options of ``new``."""

    family: str | None = argument(required=False, metavar="[FAMILY|TASK]")
    file: Path | None = argument(required=False, type=PathType(dir_okay=False))
    show: bool = option("--list", is_flag=True, help="List the families of templates.")
    force: bool = force_option()
    variant: str | None = variant_option("Use the values of this variant of the task.")
    lang: str = lang_option()


@command(NewOptions)
def new(options: NewOptions) -> None:
    """Write a commented problem file of a FAMILY, or a shipped TASK, ready to edit.

    Families: planmethod new --list. Tasks: planmethod tasks.
    """
    from planmethod.problem import FAMILIES, OTHER_FAMILIES, template

    family, variant, lang = options.family, options.variant, options.lang
    known = (*FAMILIES, *OTHER_FAMILIES)
    if options.show or family is None:
        from planmethod.note.wording import get_language

        width, meanings = max(map(len, known)), get_language(lang).families
        for name in known:
            click.echo(f"{name.ljust(width)}  {meanings[name]}")
        if not options.show:
            raise UsageError("give one of these families: planmethod new FAMILY [FILE]")
        return
    wanted = "-".join(family.casefold().split())
    template_name = next((one for one in known if one.casefold() == wanted), None)
    if template_name is not None:
        if variant is not None:
            raise UsageError("{} is a template and has no variants: omit --variant", template_name)
        path = options.file or Path(f"{template_name}.toml")
        write_new(path, template(template_name, lang), force=options.force)
        return
    from planmethod.problem.tasks import tasks, text_for

    task = next((task for task in tasks() if task.name.casefold() == wanted), None)
    if task is None:
        names = (*known, *(task.name for task in tasks()))
        phrase = "no task {!r}" if any(map(str.isdigit, family)) else "no family {!r}"
        reject_unknown(phrase, family, names, "planmethod new --list, planmethod tasks")
        return
    if variant is not None:
        none = "" if task.variants else translate("none")
        reject_unknown("no variant {!r}", variant, task.variants, none)
    stem = task.name if variant is None else f"{task.name}-{variant}"
    write_new(options.file or Path(f"{stem}.toml"), text_for(task, variant), force=options.force)
