"""Command ``tasks``: the shipped problem files by structure (банк задач)."""

from __future__ import annotations

from itertools import groupby

import click
from msgspec import Struct
from msgspec.structs import asdict

from planmethod.commands.command import command
from planmethod.commands.output import json_text
from planmethod.options import UsageError, json_option, lang_option, option


class TasksOptions(Struct, frozen=True, kw_only=True):
    """Options of ``tasks``."""

    group: str | None = option(
        "--group",
        metavar="GROUPS",
        help="Only tasks with these Assur groups in this order: RRR+RPR.",
    )
    search: str | None = option(
        "--search",
        metavar="WORDS",
        help="Only tasks with all these words in title, source or remarks.",
    )
    as_json: bool = json_option("Print the list as one JSON object.")
    lang: str = lang_option()


@command(TasksOptions)
def tasks(options: TasksOptions) -> None:
    """List the shipped tasks by structure; planmethod new TASK writes one of them.

    Assur groups are in the order of kinematic analysis, with a letter for each pair: R revolute,
    P prismatic. Pictures of the tasks: docs/reference/tasks.md.
    """
    from planmethod.languages import LANGUAGES
    from planmethod.note.wording import get_language
    from planmethod.problem.tasks import groups_of, tasks
    from planmethod.studio.bank import matches

    found, language = tasks(), get_language(options.lang)
    if options.group is not None:
        letters = {  # in whichever language they are typed
            said: letter
            for one in LANGUAGES
            for letter, said in get_language(one).note["letters"].items()
        }
        asked = groups_of("".join(letters.get(one, one) for one in options.group.upper()))
        known = sorted({signature for task in found for signature in task.groups})
        for signature in asked:
            if signature not in known:
                text = ", ".join(known)
                raise UsageError("no task has a group {!r}. Known: {}.", signature, text)
        found = tuple(task for task in found if task.has(asked))
    if options.search is not None:
        found = tuple(task for task in found if matches(task, options.search))
    if options.as_json:
        rows = [
            {**asdict(task), "structure": task.structure or None, "reading": task.reading or None}
            for task in found
        ]
        click.echo(json_text({"schema": 1, "tasks": rows}))
        return
    if not found:
        click.echo(language.tasks["none"], err=True)
    width = max((len(task.name) for task in found), default=0)
    for (kind, structure), some in groupby(found, lambda task: (task.kind, task.structure)):
        click.echo(structure or language.tasks[kind])
        for task in some:
            variants = f" ({' '.join(task.variants)})" if task.variants else ""
            mark = language.tasks.reading_mark if task.reading else ""
            click.echo(f"  {task.name.ljust(width)}  {task.title}{variants}{mark}")
    if any(task.reading for task in found):
        click.echo(language.tasks.readings)
