"""A sweep over positions that were checked first: its gaps and warnings (развёртка)."""

# no messages: for programs in Python

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property

import numpy as np

from planmethod.problem.model import Problem
from planmethod.solved.failures import Doubt, Failure, OmittedWarnings
from planmethod.solved.many.positions import Codes, Gaps, blocks, evenly, examine, failure_at
from planmethod.solved.many.sweep import Sweep
from planmethod.solved.reading import Reals

CHUNK = 16384
"""Positions that are swept in one go."""


class GappedSweep:
    """A sweep over positions that were checked first.

    Every position in which a step fails is found. The self-check of `selfcheck.verify` and the
    warnings, which need all steps, cover at most a thousand possible positions, evenly spread. If
    only some results are requested, positions whose motion is spoilt by rounding are warnings, not
    gaps; those whose forces are spoilt are gaps if forces are requested.

    Parameters
    ----------
    problem : Problem
    positions : ndarray of shape (n,)
    quantities : iterable of str, optional
        Labels of results. Default: everything.

    Attributes
    ----------
    sweep : Sweep
    gaps : Gaps
    warnings : tuple of str, Doubt or OmittedWarnings

    Raises
    ------
    UnknownQuantityError, StructureError, ProblemError, AssemblyError, SelfCheckError
    """

    def __init__(
        self, problem: Problem, positions: Reals, quantities: Iterable[str] | None = None
    ) -> None:
        labels = None if quantities is None else tuple(quantities)
        self.problem, self.positions = problem, positions
        # By NumPy: the printed values must not depend on a compiler's cache.
        self.sweep = Sweep(problem, labels, forces=problem.dynamics is not None, native=False)
        gaps = Gaps.of(self._failed(), self._failure_at)
        some = evenly(np.flatnonzero(gaps.reason < 0))
        looked = examine(problem, positions[some], numbers=some, forces=self.sweep.forces)
        self._found = len(gaps.failures)
        self.warnings: tuple[str | Doubt | OmittedWarnings, ...] = looked.warnings
        self.gaps = gaps.joined(some, looked.gaps if labels is None else looked.gaps.of_forces)
        if labels is not None:
            self.warnings = (*looked.spoilt, *looked.warnings)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the rows."""
        return tuple(row.name for row in self.sweep.rows)

    def parts(self) -> Iterator[slice]:
        """Yield the parts of the positions that are swept in one go."""
        return blocks(len(self.positions), CHUNK)

    def _failed(self) -> Codes:
        failed = np.empty(self.positions.shape, np.int16)
        work = np.empty((len(self.sweep.rows), CHUNK))
        for part in self.parts():
            here = self.positions[part]
            self.sweep.run(here, out=work[:, : len(here)], failed=failed[part])
        return failed

    def _failure_at(self, index: int) -> Failure:
        position = float(self.positions[index])
        found = self.sweep.failure(position) or failure_at(self.problem, position)
        return found.numbered(index, len(self.positions))

    def fill(self, out: Reals, part: slice) -> Reals:
        """Fill a buffer of shape (k, m) with the results of a part of the positions.

        NaN where a result does not exist, and no negative zeros.
        """
        self.sweep.run(self.positions[part], out=out)
        if len(self.gaps.failures) > self._found:
            reason, still = self.gaps.reason[part], ~self.gaps.moving[part]
            out[:, still & (reason >= self._found)] = np.nan
            pushed = np.array([row.is_force for row in self.sweep.rows])
            out[np.ix_(pushed, reason >= self._found)] = np.nan
        out += 0.0
        return out
