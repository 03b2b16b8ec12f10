"""Cams by the plan method (кулачковые механизмы)."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path

    from planmethod.cams.model import CamProblem
    from planmethod.task import Task


def load(path: str | Path, *, variant: str | None = None) -> Task[CamProblem]:
    """Read the file of a cam.

    Raises
    ------
    ProblemError
        With every fault of the file.
    """
    from planmethod.cams.kind import Cams
    from planmethod.task import Task

    return Task.load(Cams(), path, variant)
