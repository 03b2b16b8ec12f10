"""Kinds of problem beside linkages: the table that tells them, the package that solves them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, Protocol

from planmethod.problem.source import parse, read_source


class KindProblem(Protocol):
    """A problem of such a kind; its package knows more of it."""

    @property
    def name(self) -> str:
        """Name of the problem."""


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of problem (вид задачи).

    Attributes
    ----------
    table : str
        The table of the problem file that tells it.
    package : str
        Where its functions are: ``load(path, *, variant)``, ``record(problem, lang)``,
        ``solved_text(problem, lang)``, and of mechanisms ``structure_record(problem)``,
        ``structure_text(problem, lang)``. It is imported when one of them is called.
    """

    table: str
    package: str

    def load(self, path: Path, variant: str | None) -> KindProblem:
        """Read a problem file."""
        problem: KindProblem = self._function("load")(path, variant=variant)
        return problem

    def record(self, problem: KindProblem, lang: str) -> dict[str, Any]:
        """Return what ``solve --json`` prints."""
        told: dict[str, Any] = self._function("record")(problem, lang)
        return told

    def solved_text(self, problem: KindProblem, lang: str) -> str:
        """Return what ``solve`` prints."""
        return str(self._function("solved_text")(problem, lang))

    def structure_record(self, problem: KindProblem) -> dict[str, Any] | None:
        """Return what ``structure --json`` prints; None for what has no structure."""
        told: dict[str, Any] | None = None
        if hasattr(import_module(self.package), "structure_record"):
            told = self._function("structure_record")(problem)
        return told

    def structure_text(self, problem: KindProblem, lang: str) -> str | None:
        """Return what ``structure`` prints; None for what has no structure."""
        if not hasattr(import_module(self.package), "structure_text"):
            return None
        return str(self._function("structure_text")(problem, lang))

    def _function(self, name: str) -> Any:
        return getattr(import_module(self.package), name)


KINDS = (Kind("gears", "planmethod.gears"), Kind("point", "planmethod.moving"))
"""All of them; a file that has links is a linkage whatever else it has."""

_HEAD = re.compile(r"^[ \t]*\[?[ \t]*[\"']?(" + "|".join(k.table for k in KINDS) + r")\b", re.M)


def kind_of(path: Path) -> Kind | None:
    """Return the kind of a problem file; None for a linkage.

    Raises
    ------
    ProblemError
        The file cannot be read, or is not TOML.
    """
    text = read_source(path)
    if _HEAD.search(text) is None:  # a linkage is not parsed twice
        return None
    table = parse(text, name=str(path))
    if "links" in table:
        return None
    return next((kind for kind in KINDS if kind.table in table), None)
