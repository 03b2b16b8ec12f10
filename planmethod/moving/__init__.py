"""The moving point: law as formulas, velocity, acceleration, curvature (движение точки)."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path

    from planmethod.moving.motion import PointProblem
    from planmethod.task import Task


def load(path: str | Path, *, variant: str | None = None) -> Task[PointProblem]:
    """Read the file of a moving point.

    Raises
    ------
    ProblemError
        With every fault of the file.
    """
    from planmethod.moving.kind import MovingPoints
    from planmethod.task import Task

    return Task.load(MovingPoints(), path, variant)
