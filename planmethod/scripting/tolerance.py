"""How tolerances of sizes spread the results of a mechanism (анализ допусков).

The linear part is by derivatives: differences of the fourth order. The samples are solved as they
are, so they show where the linear part does not hold.
"""

# no messages: for programs in Python

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.arguments import above_zero, number_of, texts
from planmethod.errors import ArgumentError
from planmethod.problem.model import Problem
from planmethod.scripting.grid import Grid
from planmethod.solved.many.columns import data_frame
from planmethod.solved.reading import Reals

_STEP = 1e-3
"""Part of a size by which it is moved for the derivatives."""

_WEIGHTS = {1: 8.0 / 12.0, 2: -1.0 / 12.0}
"""Weights of differences over one step and two to each side."""

_LEAST_SAMPLES, _MOST_SAMPLES = 2, 1_000_000


class Tolerance:
    """Spread of results over the tolerances of sizes (разброс результатов).

    Parameters
    ----------
    problem : Problem
    positions : array_like of shape (n,)
    limits : mapping of str to (float, float)
        Each number of the file, by the name of its parameter: its value, and the largest deviation
        to both sides, SI and degrees.
    names : iterable of str
        Results by the names of `Solution.to_columns`.
    samples : int
        Mechanisms that are tried, whose deviations are uniform and independent.
    seed : int
        Start of the random numbers: the same seed gives the same samples.

    Attributes
    ----------
    nominal, worst, sigma : dict of str to ndarray of shape (n,)
        Results without deviations; the largest deviation by derivatives, Σ|∂/∂l|·Δl; its standard
        deviation by derivatives, for uniform deviations.
    sampled, lowest, highest : dict of str to ndarray of shape (n,)
        Standard deviation, least and greatest result of the samples; NaN if one of them cannot be
        assembled.
    sensitivity : dict of str to dict of str to ndarray of shape (n,)
        Derivatives of each result by each number.

    Examples
    --------
    >>> import planmethod
    >>> m = planmethod.Mechanism.from_file("problems/linkages/ex3.toml")
    >>> found = m.tolerance({"AB": 0.0001, "CD": 0.0002}, ["x_E"])
    >>> found
    Tolerance(ex3: l_AB ± 0.0001, l_CD ± 0.0002; x_E ± 0.000147)
    """

    def __init__(
        self,
        problem: Problem,
        positions: npt.ArrayLike,
        limits: Mapping[str, tuple[float, float]],
        names: Iterable[str],
        *,
        samples: int = 1000,
        seed: int = 0,
    ) -> None:
        self.problem = problem
        self.limits = {name: above_zero(name, limit) for name, (_, limit) in limits.items()}
        values = {name: float(value) for name, (value, _) in limits.items()}
        asked = list(texts("names", names))
        count = number_of("samples", samples, _MOST_SAMPLES + 1)
        if count < _LEAST_SAMPLES:
            raise ArgumentError(
                "{}: expected at least {}, got {}.", "samples", _LEAST_SAMPLES, count
            )
        random = np.random.default_rng(seed)
        columns = {
            name: value + self.limits[name] * random.uniform(-1.0, 1.0, count)
            for name, value in values.items()
        }
        spread = Grid(problem, positions, columns)
        found, moved = spread.results(asked), self._differences(values, positions, asked)
        self.positions = spread.positions
        self.nominal = {name: own[0] for name, own in moved.items()}
        self.sensitivity = {name: self._derivatives(name, own) for name, own in moved.items()}
        self.worst, self.sigma = dict[str, Reals](), dict[str, Reals]()
        for name, slopes in self.sensitivity.items():
            parts = np.array([np.abs(slope) * self.limits[by] for by, slope in slopes.items()])
            self.worst[name] = parts.sum(axis=0)
            self.sigma[name] = np.sqrt((parts**2 / 3.0).sum(axis=0))
        off = {name: _difference(name, own, self.nominal[name]) for name, own in found.items()}
        self.sampled = {name: own.std(axis=0) for name, own in off.items()}
        self.lowest = {name: self.nominal[name] + own.min(axis=0) for name, own in off.items()}
        self.highest = {name: self.nominal[name] + own.max(axis=0) for name, own in off.items()}

    def _differences(
        self, values: Mapping[str, float], positions: npt.ArrayLike, names: list[str]
    ) -> dict[str, Reals]:
        """Return results without deviations, then with each number moved over its four steps."""
        rows = [dict(values)]
        self._steps = {name: _STEP * (abs(value) or 1.0) for name, value in values.items()}
        for name, step in self._steps.items():
            for times in _WEIGHTS:
                rows += [{**values, name: values[name] + way * times * step} for way in (1, -1)]
        samples = {name: np.array([row[name] for row in rows]) for name in values}
        return Grid(self.problem, positions, samples).results(names)

    def _derivatives(self, name: str, results: Reals) -> dict[str, Reals]:
        """Return the derivatives of a result by each number."""
        found: dict[str, Reals] = {}
        rows = iter(results[1:])
        for by, step in self._steps.items():
            total = np.zeros(results.shape[1:])
            for weight in _WEIGHTS.values():
                ahead, back = next(rows), next(rows)
                total += weight * _difference(name, ahead, back)
            found[by] = total / step
        return found

    def to_columns(self) -> dict[str, Reals]:
        """Return columns with a row for each position: results, their spread and derivatives."""
        columns = {self.problem.drive.coordinate.column: self.positions}
        for name, own in self.nominal.items():
            parts = ("worst", "sigma", "sampled", "lowest", "highest")
            columns |= {name: own, **{f"{name}.{one}": getattr(self, one)[name] for one in parts}}
            columns |= {f"{name}/{by}": slope for by, slope in self.sensitivity[name].items()}
        return columns

    def to_frame(self) -> Any:
        """Return the same as a table of pandas.

        Raises
        ------
        OutputError
            pandas is not installed.
        """
        return data_frame(self.to_columns())

    def __repr__(self) -> str:
        sizes = ", ".join(f"{name} ± {limit:g}" for name, limit in self.limits.items())
        spread = ", ".join(f"{name} ± {own.max():.3g}" for name, own in self.worst.items())
        return f"Tolerance({self.problem.name}: {sizes}; {spread})"


def _difference(name: str, one: Reals, two: Reals) -> Reals:
    """Return the difference of two results; of directions within half a turn."""
    off = np.asarray(one - two)
    if name.startswith("phi"):
        return np.asarray((off + 180.0) % 360.0 - 180.0)
    return off
