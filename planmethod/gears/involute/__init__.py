"""Two wheels with involute teeth: sizes, limits, profiles, sheet (эвольвентное зацепление)."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path

    from planmethod.gears.involute.geometry import MeshingProblem
    from planmethod.task import Task


def load(path: str | Path, *, variant: str | None = None) -> Task[MeshingProblem]:
    """Read the file of a pair of wheels in mesh.

    Raises
    ------
    ProblemError
        With every fault of the file.
    """
    from planmethod.gears.involute.kind import Meshings
    from planmethod.task import Task

    return Task.load(Meshings(), path, variant)
