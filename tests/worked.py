"""The worked mechanisms of the textbooks, as files of the repository."""

from __future__ import annotations

import hashlib
import json
import os
import pickle
import sys
from collections.abc import Callable, Sequence
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from doors import (
    LINKAGES,
    ModelProblem as Problem,
    kind_of,
    kinds_load as load_any,
    problem_load as load,
)

if TYPE_CHECKING:
    import pytest
    from doors import Drawing, Project, Solution

ROOT = Path(__file__).resolve().parent.parent
PROBLEMS = ROOT / "problems"

T = TypeVar("T")

shared: list[Path] = []
"""Folder of this test run for results that the workers share; empty before the run begins."""


def made_once(key: tuple[object, ...], make: Callable[[], T]) -> T:
    """Return the result for a key: one worker computes it, the others read its file."""
    if not shared:
        return make()
    file = shared[0] / hashlib.sha256(repr(key).encode()).hexdigest()
    if not file.exists():
        own = file.with_suffix(f".{os.getpid()}")
        own.write_bytes(pickle.dumps(make()))
        own.replace(file)
    made: T = pickle.loads(file.read_bytes())
    return made


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
def problem_of(name: str, variant: str | None = None) -> Problem:
    return load(path_of(name), variant=variant)


def forget_cached() -> None:
    """Clear the caches of the package's functions, as in a fresh process."""
    for name, module in [*sys.modules.items()]:
        if name.startswith("planmethod."):
            for own in vars(module).values():
                if isinstance(own, type(problem_of)):
                    own.cache_clear()


def drawn_sheets(
    name: str,
    positions: Sequence[float] | None = None,
    *,
    variant: str | None = None,
    **asked: Any,
) -> list[Drawing]:
    """Return the kinematic sheets of a file, drawn once: callers may not change them."""
    at = None if positions is None else tuple(positions)
    return _drawn(name, variant, at, tuple(sorted(asked.items())))


@lru_cache(maxsize=16)
def _drawn(
    name: str,
    variant: str | None,
    positions: tuple[float, ...] | None,
    asked: tuple[tuple[str, Any], ...],
) -> list[Drawing]:
    from doors import STYLES, kinematics_sheets, lettering

    def draw() -> list[Drawing]:
        return kinematics_sheets(problem_of(name, variant), positions=positions, **dict(asked))

    sheets = made_once((name, variant, positions, asked), draw)
    names = {style: name for name, style in STYLES.items()}
    for sheet in sheets:  # of a file it is a copy
        sheet.lettering = lettering(names[sheet.lettering.style])
    return sheets


@cache
def project_of(path: Path) -> Project:
    """Return the project of a file, settled once."""
    from doors import settle

    return made_once((path,), lambda: settle(load_any(path), path))


def solved_while(
    draw: Callable[[], list[Drawing]], patch: pytest.MonkeyPatch
) -> tuple[list[Drawing], Solution]:
    """Return the sheets and the last solution that was tried at their scales."""
    from doors import Linkage

    made: list[Solution] = []
    solved = Linkage.solved

    def kept(linkage: Linkage, *asked: Any) -> Solution:
        made.append(solved(linkage, *asked))
        return made[-1]

    patch.setattr(Linkage, "solved", kept)
    sheets = draw()
    drawn = {view.kind: view.per_mm for sheet in sheets for view in sheet.views}
    for solution in reversed(made):
        told = {kind.value: scale.per_mm for kind, scale in solution.scales.items()}
        if all(drawn.get(kind, mu) == mu for kind, mu in told.items()):
            return sheets, solution
    return sheets, made[-1]


@cache
def exact_values() -> dict[str, Any]:
    """Exact values of six of the files, computed apart from the plans."""
    values: dict[str, Any] = json.loads((ROOT / "tests/data/exact.json").read_text("utf-8"))
    return values


OWN_TESTS = ("press/press-turn", "machines/planer-drive", "linkages/five-bar")
"""Linkages that `every_file` leaves to their own tests."""


def every_file() -> list[Path]:
    """Return the files of all linkages but the textbooks' tasks, which are many.

    The tasks and problems of other kinds have their own tests, and so have the press in the twelve
    positions of its source, where one position of it is here, and linkages whose driver is
    determined by another part of the file: a train, or required motions of an output.
    """
    files = sorted({*PROBLEMS.rglob("*.toml")} - {*every_task(), *map(path_of, OWN_TESTS)})
    return [path for path in files if kind_of(path) is LINKAGES]


@cache
def every_task() -> list[Path]:
    """Return the files of the textbooks' tasks that are linkages."""
    return sorted([*PROBLEMS.glob("levers/task-*.toml"), *PROBLEMS.glob("linkages/2.*.toml")])


DEAD = """
title = "Мёртвое положение"
[frame]
A = [0.0, 0.0]
D = [3.0, 0.0]
[links.1]
points = ["A", "B"]
AB = 1.0
[links.2]
points = ["B", "C"]
BC = 1.5
[links.3]
points = ["D", "C"]
DC = 2.5
[driver]
link = "1"
phi = 45
omega = 10
[assembly]
C = "above B"
"""
"""At 180 degrees the connecting rod and the rocker are in one line."""

NOT_CLOSED = """
[frame]
A = [0.0, 0.0]
D = [0.4, 0.0]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = 0.2
[links.3]
points = ["D", "C"]
DC = 0.05
[driver]
link = "1"
phi = 60
omega = 10
[assembly]
C = "above D"
"""
"""A four-bar linkage whose links are too short to assemble."""
