"""Gear trains: read, solved in fractions, described, drawn (зубчатые механизмы)."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path

    from planmethod.gears.model import GearProblem
    from planmethod.task import Task


def load(path: str | Path, *, variant: str | None = None) -> Task[GearProblem]:
    """Read the file of a gear train.

    Raises
    ------
    ProblemError
        With every fault of the file.

    Examples
    --------
    >>> import planmethod
    >>> train = planmethod.gears.load("problems/gears/gears-ex2.toml").solve()
    >>> train.to_columns(["omega"])["omega"].round(2)
    array([  5.24,  -7.85, -39.27,  13.09,   0.  ,  -7.85])
    """
    from planmethod.gears.kind import GearTrains
    from planmethod.task import Task

    return Task.load(GearTrains(), path, variant)
