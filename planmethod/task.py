"""A problem that is not a linkage, for a program: loaded, solved, drawn (задача в программе)."""

# no messages: for programs in Python

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np
import numpy.typing as npt

from planmethod.arguments import Named, chosen, of_type, text
from planmethod.kind import ProblemKind
from planmethod.languages import LANGUAGES
from planmethod.options import PlanRequest
from planmethod.problem.records import KindProblem, in_language
from planmethod.render.backends.sheet import Sheet
from planmethod.solved.many.columns import data_frame

P = TypeVar("P", bound=KindProblem)


class Task(Generic[P]):
    """Problem of a kind: a gear train, two wheels in mesh, a cam, a moving point (задача).

    Attributes
    ----------
    problem : KindProblem
        As it was read.

    Examples
    --------
    >>> import planmethod
    >>> cam = planmethod.cams.load("problems/cams/central.toml")
    >>> cam
    Task(central: cam)
    """

    def __init__(self, kind: ProblemKind[P], problem: P) -> None:
        self.kind, self.problem = kind, problem

    @classmethod
    def load(cls, kind: ProblemKind[P], path: str | Path, variant: str | None) -> Task[P]:
        """Read a problem file.

        Raises
        ------
        ProblemError, ArgumentError
        """
        path = Path(of_type("path", path, str | Path))
        return cls(kind, kind.load(path, None if variant is None else text("variant", variant)))

    def __repr__(self) -> str:
        return f"Task({self.problem.name}: {self.kind.table})"

    def solve(self) -> TaskSolution[P]:
        """Solve the problem.

        Raises
        ------
        PlanMethodError
            It has no solution.
        """
        return TaskSolution(self)

    def sheet(self, *, lang: str | None = None, fields: Mapping[str, str] | None = None) -> Sheet:
        """Draw the sheets.

        Parameters
        ----------
        lang : str, optional
            ``ru`` or ``en``. Default: that of the file.
        fields : mapping, optional
            Texts of the title block that outrank the file's.

        Raises
        ------
        ProblemError
            Such problems have no sheets.
        """
        problem = self.problem
        if lang is not None:
            problem = in_language(problem, chosen("lang", lang, LANGUAGES))
        return Sheet(self.kind.drawings(problem, PlanRequest(fields=dict(fields or {}))))


class TaskSolution(Generic[P]):
    """Solved problem of a kind (решение): its record, its table of results, its sheets.

    Attributes
    ----------
    record : dict
        The object of ``planmethod solve --json``.

    Examples
    --------
    >>> import planmethod
    >>> mesh = planmethod.meshing.load("problems/meshing/z12-30.toml").solve()
    >>> mesh.record["meshing"]["m"], mesh.to_columns(["z"])["z"]
    (5.0, array([12., 30.]))
    """

    def __init__(self, task: Task[P]) -> None:
        self.task = task
        self.record: dict[str, Any] = task.kind.record(task.problem, LANGUAGES[-1])

    def __repr__(self) -> str:
        return f"TaskSolution({self.task.problem.name}: {', '.join(self._columns)})"

    @cached_property
    def _columns(self) -> dict[str, npt.NDArray[Any]]:
        rows = self.task.kind.result_rows(self.task.problem)
        names = dict.fromkeys(name for row in rows for name in row)
        columns = {name: [row.get(name) for row in rows] for name in names}
        return Named({name: _array(own) for name, own in columns.items()}, "result")

    def to_columns(self, names: Iterable[str] | None = None) -> dict[str, npt.NDArray[Any]]:
        """Return the table of results by the names of JSON and CSV.

        Its rows are the positions of a cam, the moments of a point, the bodies of a train, both
        wheels of a mesh. A missing number is NaN.

        Raises
        ------
        UnknownNameError
        """
        return {name: self._columns[name] for name in (self._columns if names is None else names)}

    def to_frame(self, names: Iterable[str] | None = None) -> Any:
        """Return the same as a table of pandas.

        Raises
        ------
        OutputError
            pandas is not installed.
        """
        return data_frame(self.to_columns(names))

    def sheet(self, *, lang: str | None = None, fields: Mapping[str, str] | None = None) -> Sheet:
        """Draw the sheets: see `Task.sheet`."""
        return self.task.sheet(lang=lang, fields=fields)


def _array(values: list[Any]) -> npt.NDArray[Any]:
    """Return numbers as reals, NaN where there is none; other values as they are."""
    known = [one for one in values if one is not None and one != ""]
    if known and all(isinstance(one, int | float) and not isinstance(one, bool) for one in known):
        return np.array([np.nan if one in (None, "") else one for one in values], dtype=float)
    return np.array(values, dtype=object)
