"""Many mechanisms in many positions: every sample of the sizes in every position (сетка)."""

# no messages: for programs in Python

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.arguments import numbers, texts
from planmethod.errors import ArgumentError
from planmethod.problem.model import Problem
from planmethod.solved.many.columns import Columns, data_frame
from planmethod.solved.many.sweep import Sweep
from planmethod.solved.reading import Reals

PAYS = 1_000_000
"""Results of one name from which a compiler pays."""


class Grid:
    """Results of samples of a mechanism, computed when they are requested (сетка результатов).

    Parameters
    ----------
    problem : Problem
    positions : array_like of shape (n,)
    samples : mapping of str to ndarray of shape (v,)
        Numbers of the file by the names of `Sweep.parameters`, SI and degrees: one sample each.

    Attributes
    ----------
    shape : tuple of int
        Samples and positions.

    Examples
    --------
    >>> import planmethod
    >>> m = planmethod.Mechanism.from_file("problems/linkages/ex3.toml")
    >>> grid = m.grid([0.0, 90.0, 180.0], AB=[0.06, 0.064, 0.07, 0.075])
    >>> grid
    Grid(ex3: 4 samples of l_AB × 3 positions)
    >>> grid["omega_3"].shape
    (4, 3)
    """

    def __init__(
        self, problem: Problem, positions: npt.ArrayLike, samples: Mapping[str, Reals]
    ) -> None:
        self.problem, self.positions = problem, numbers("positions", positions)
        try:
            columns = np.broadcast_arrays(*(np.atleast_1d(own) for own in samples.values()))
        except ValueError:
            told = ", ".join(f"{name}: {np.size(own)}" for name, own in samples.items())
            raise ArgumentError("The samples must be of one length, got {}.", told) from None
        if not columns or columns[0].ndim != 1:
            raise ArgumentError("Give lists of numbers, as in grid(positions, AB=[0.1, 0.2]).")
        self.samples = dict(zip(samples, columns, strict=True))
        self.shape = len(columns[0]), len(self.positions)
        self._found: dict[str, dict[str, Reals]] = {}  # by requested name: a point has two columns

    def __repr__(self) -> str:
        count, positions = self.shape
        names = ", ".join(self.samples)
        return f"Grid({self.problem.name}: {count} samples of {names} × {positions} positions)"

    def __getitem__(self, name: str) -> Reals:
        """Return a result of every sample in every position, ndarray of shape (v, n).

        NaN where a sample cannot be assembled. Names are those of `Solution.to_columns`.

        Raises
        ------
        UnknownQuantityError
        SweepError
            The file is faulty with one of the samples.
        """
        return next(iter(self.results([name]).values()))

    def results(self, names: Iterable[str]) -> dict[str, Reals]:
        """Return several results at once, which is quicker, ndarrays of shape (v, n)."""
        names = texts("names", names)
        missing = [name for name in names if name not in self._found]
        if missing:
            native = True if np.prod(self.shape) >= PAYS else None
            sweep = Sweep(self.problem, missing, varied=list(self.samples), native=native)
            sizes = {name: own[:, np.newaxis] for name, own in self.samples.items()}
            values = sweep.run(self.positions, sizes)
            columns = Columns(self.problem, sweep.rows, values)
            self._found |= {name: columns.chosen([name]) for name in missing}
        return {column: own for name in names for column, own in self._found[name].items()}

    def to_columns(self, names: Iterable[str]) -> dict[str, Reals]:
        """Return columns with a row for each position of each sample, the samples among them."""
        count = self.shape[1]
        own = {name: np.repeat(values, count) for name, values in self.samples.items()}
        driver = {self.problem.drive.coordinate.column: np.tile(self.positions, self.shape[0])}
        return own | driver | {name: one.ravel() for name, one in self.results(names).items()}

    def to_frame(self, names: Iterable[str]) -> Any:
        """Return the same as a table of pandas.

        Raises
        ------
        OutputError
            pandas is not installed.
        """
        return data_frame(self.to_columns(names))
