"""The worked mechanisms of the textbooks, as files of the repository."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

from planmethod.problem import load
from planmethod.problem.model import Problem

ROOT = Path(__file__).resolve().parent.parent
PROBLEMS = ROOT / "problems"

SIX = (
    "linkages/ex1",
    "linkages/ex2",
    "linkages/ex3",
    "levers/six-link",
    "levers/task12",
    "press/press",
)
"""The six mechanisms, by path below problems/."""


def path_of(name: str) -> Path:
    return PROBLEMS / f"{name}.toml"


@cache
def problem_of(name: str) -> Problem:
    return load(path_of(name))


@cache
def exact_values() -> dict[str, Any]:
    """Exact values of five of the mechanisms, computed apart from the plans."""
    values: dict[str, Any] = json.loads((ROOT / "tests/data/exact.json").read_text("utf-8"))
    return values


def every_file() -> list[Path]:
    return sorted(PROBLEMS.rglob("*.toml"))
