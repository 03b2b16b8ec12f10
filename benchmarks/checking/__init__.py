"""Students who share nothing with the product, and how it checks them (независимые студенты)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from benchmarks.checking.judged import Judged, judge
from benchmarks.checking.report import students_section
from benchmarks.checking.tasks import PROBLEMS
from benchmarks.checking.works import make_group

DEVELOPMENT = 1
"""Seed to look at; reports take others, from 100 on."""


def students(
    seed: int, works: int, problems: Sequence[str] | None = None, keep: Path | None = None
) -> list[Judged]:
    """Return works of all problems, or some, with what the product says of each."""
    chosen = [one for one in PROBLEMS if not problems or one.name in problems]
    return list(judge((make_group(one, seed, works) for one in chosen), keep))


def section(seed: int, works: int) -> list[str]:
    """Return the tables, for ``planmethod bench --only checking --seed``."""
    return students_section(students(seed, works), seed)
