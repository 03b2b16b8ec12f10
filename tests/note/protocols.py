"""Solutions and texts that the tests of the note share."""

from __future__ import annotations

import re
from functools import cache

from doors import TERMINAL_WIDTH as WIDTH, Solution, problem_loads as loads, width
from texts import protocol
from worked import problem_of

from benchmarks.generator import random_problem

LANGUAGES = ("ru", "en")

INTERNAL = re.compile(
    r"line\d|~|\bNone\b|\bnan\b|\binf\b|[va]:\S|mu_|omega_|epsilon_|angle_|\||[_^]\{|\{|\}|\\"
)
"""Strings that a reader must never see: internal names, markup, values that are not numbers."""


@cache
def worked(name: str) -> Solution:
    return Solution(problem_of(name))


@cache
def drawn(seed: int) -> Solution:
    return Solution(loads(random_problem(seed)[0], name=f"random-{seed}"))


@cache
def told(name: str, lang: str) -> str:
    """Return a protocol in one line, spaces made single."""
    return flat(protocol(worked(name), lang=lang))


def flat(text: str) -> str:
    return re.sub(r"\s+", " ", text)


def assert_readable(text: str) -> None:
    found = INTERNAL.search(text)
    assert found is None, text[max(0, found.start() - 60) : found.end() + 30]
    wide = [line for line in text.splitlines() if width(line) > WIDTH]
    assert not wide
    assert not [line for line in text.splitlines() if line != line.rstrip()]
