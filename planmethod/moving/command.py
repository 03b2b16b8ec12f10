"""What the commands ask of files with ``[point]``."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from planmethod.moving.reader import load_point
from planmethod.moving.record import record
from planmethod.moving.text import text


def solve_point(
    path: Path, variant: str | None, *, all_variants: bool, as_json: bool, lang: str
) -> Iterator[dict[str, Any] | str]:
    """Yield what ``solve`` says of a moving point, for each variant: a record, or a text.

    Raises
    ------
    ProblemError
    """
    problems = [load_point(path, variant)]
    if all_variants:
        names = problems[0].variants
        problems = [load_point(path, name) for name in names] or problems
    for problem in problems:
        yield record(problem) if as_json else text(problem, lang)
