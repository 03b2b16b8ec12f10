"""Output of ``solve --compare``: a student's own numbers beside the exact ones."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.check.checking import Variants, check_works
from planmethod.check.pages.student import compared_document, unread_lines
from planmethod.check.submissions import read_works
from planmethod.commands.problems import language_of_file
from planmethod.errors import Fault, ProblemError
from planmethod.note.wording import get_language
from planmethod.note.writers.terminal import plain_document
from planmethod.problem.source import parse, read_source


def compare(problem: Path, work: Path, variant: str | None, lang: str | None) -> None:
    """Print the answers of a work with the exact values, without verdicts.

    Raises
    ------
    ProblemError
        The problem file says that they are not compared before handing in, or is faulty.
    """
    if parse(read_source(problem), name=str(problem)).get("compare") is False:
        hint = "Submit your work; planmethod check compares it."
        fault = Fault(
            "compare", "this task does not allow comparing answers before submission", hint
        )
        raise ProblemError(str(problem), [fault])
    checked = list(check_works(Variants(problem, default=variant), read_works(work)))
    language = get_language(language_of_file(problem, lang))
    click.echo(plain_document(compared_document(checked, language), language))
    for line, _ in unread_lines(checked, language):
        click.echo(line, err=True)
