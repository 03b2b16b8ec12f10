"""Command ``form``: the workbook that students fill in (бланк ответов)."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.problems import finish, for_each_problem, language_of
from planmethod.options import (
    PathType,
    ProblemChoice,
    UsageError,
    basename,
    option,
    out_option,
    problem_lang_option,
)

if TYPE_CHECKING:
    from planmethod.commands.check import KeyQuestion

MAX_STUDENTS = 500


class FormOptions(Struct, frozen=True, kw_only=True):
    """Options of ``form``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    out: Path = out_option()
    students: int | None = option(
        "--students",
        type=click.IntRange(1, MAX_STUDENTS),
        help="Number of forms to write, numbered. Default: one unnumbered form.",
    )
    names: Path | None = option(
        "--names",
        type=PathType(dir_okay=False),
        metavar="FILE",
        help="Text file with a name in each line: write a form for each student.",
    )
    lang: str | None = problem_lang_option()

    def recipients(self) -> list[str]:
        """Return whom the forms are for, or their numbers."""
        if self.students is not None and self.names is not None:
            raise UsageError("give --students or --names, not both")
        if self.names is not None:
            return _read_names(self.names)
        return [str(number) for number in range(1, (self.students or 0) + 1)]


@command(FormOptions)
def form(options: FormOptions) -> None:
    """Write an XLSX form for students: the questions without the answers.

    Only the cells of the answers can be edited. Senses and units are chosen from lists, and the
    form compares mm × μ with the value. planmethod check reads the filled-in forms.
    """
    from planmethod.check.form import FormHead, fingerprint_of, form_of
    from planmethod.check.marks import DEFAULT
    from planmethod.commands.check import key_question, keys_ahead
    from planmethod.render.backends.output import write

    who, out = options.recipients(), options.out

    def write_form(question: KeyQuestion) -> None:
        key, problem = question.key, question.key.problem
        fingerprint = fingerprint_of(problem)
        for number, student in enumerate(who or [""], 1):
            tail = f"-{number:0{len(str(len(who)))}}" if who else ""
            path = out / f"{basename(problem)}-form{tail}.xlsx"
            head = FormHead(
                problem=problem.name,
                variant=problem.variant,
                fingerprint=fingerprint,
                student=student,
                title=problem.title,
                lang=language_of(problem, options.lang),
            )
            write(path, form_of(key.entries, head), output_root=out)
            click.echo(str(path))

    act = partial(key_question, settings=DEFAULT, lang=None, mistakes=False)
    ahead = partial(keys_ahead, settings=DEFAULT)
    finish(for_each_problem(options.choice, act, on_result=write_form, act_on_many=ahead))


def _read_names(path: Path) -> list[str]:
    """Return the names of the students, one in each line of a text."""
    from planmethod.check.submissions.cells import read_bytes
    from planmethod.check.submissions.table import decoded

    lines = decoded(read_bytes(path), path).splitlines()
    found = [" ".join(line.split()) for line in lines if line.strip()]
    if not 0 < len(found) <= MAX_STUDENTS:
        raise UsageError("{}: {} names; 1 to {} are expected", path, len(found), MAX_STUDENTS)
    return found
