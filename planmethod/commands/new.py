"""Command ``new``: a commented problem file of a family."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.output import LocalizedCommand, reject_unknown, write_new
from planmethod.commands.problems import guarded
from planmethod.languages import translate
from planmethod.options import PathType, UsageError, lang_option


@click.command(cls=LocalizedCommand)
@click.argument("family", required=False, metavar="[FAMILY|TASK]")
@click.argument("file", required=False, type=PathType(dir_okay=False))
@click.option("--list", "show", is_flag=True, help="List the families.")
@click.option("--force", is_flag=True, help="Write over an existing file.")
@click.option("--variant", metavar="NAME", help="Variant of the task whose values are used.")
@lang_option
@guarded
def new(
    family: str | None,
    file: Path | None,
    show: bool,
    force: bool,
    variant: str | None,
    lang: str,
) -> None:
    """Write a commented problem file of a FAMILY, or a shipped TASK, ready to edit.

    Families: planmethod new --list. Tasks: planmethod tasks.
    """
    from planmethod.problem import FAMILIES, OTHER_FAMILIES, template

    known = (*FAMILIES, *OTHER_FAMILIES)
    if show or family is None:
        from planmethod.note.wording import get_language

        width, meanings = max(map(len, known)), get_language(lang).families
        for name in known:
            click.echo(f"{name.ljust(width)}  {meanings[name]}")
        if not show:
            raise UsageError("give one of these families: planmethod new FAMILY [FILE]")
        return
    wanted = "-".join(family.casefold().split())
    template_name = next((one for one in known if one.casefold() == wanted), None)
    if template_name is not None:
        if variant is not None:
            raise UsageError(
                "{} is a template and has no variants: leave out --variant", template_name
            )
        write_new(file or Path(f"{template_name}.toml"), template(template_name, lang), force=force)
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
    write_new(file or Path(f"{stem}.toml"), text_for(task, variant), force=force)
