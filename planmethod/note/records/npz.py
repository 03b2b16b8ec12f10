"""Arrays in one file that NumPy loads, the same bytes for the same arrays."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.steps import PointName
from planmethod.languages import WRITTEN, speaking
from planmethod.note.records.spreadsheet import driver_of
from planmethod.plans.legend import QuantityKind
from planmethod.problem.model import Problem
from planmethod.solved.many.gaps import GappedSweep
from planmethod.solved.many.variants import Batch
from planmethod.solved.quantities import BY_NAME
from planmethod.solved.reading import Reals
from planmethod.solved.solution import EVERY, Solution

SMALL = 2**16
"""Bytes of an array up to which its member is made at once."""

FIRST_DAY = (1980, 1, 1, 0, 0, 0)
"""Time of every member: the earliest that the format has."""


class SolvedArrays(Struct, frozen=True):
    """Results of few positions, all of which exist: rows of a table shared by many problems.

    ``columns`` are those of a sweep by name, the driver's positions the first; ``rows`` its own.
    """

    problem: Problem
    columns: Mapping[str, Reals]
    rows: slice

    def named(self, prefix: str) -> Iterator[tuple[str, npt.NDArray[Any]]]:
        """Yield the arrays by name, as `swept_arrays` does."""
        for name, values in self.columns.items():
            own = values[self.rows]
            yield prefix + name, own
        yield f"{prefix}reason", np.full(len(own), -1, np.int16)
        yield f"{prefix}reasons", _NO_REASONS


_NO_REASONS = np.array((), dtype=np.str_)


def solved_arrays(solution: Solution) -> SolvedArrays:
    """Return the results of a solution as a sweep of its positions has them."""
    return SolvedArrays(solution.problem, dict(_columns(solution)), EVERY)


def batch_arrays(batch: Batch) -> Iterator[SolvedArrays]:
    """Yield `solved_arrays` of each variant of a batch."""
    columns = dict(_columns(batch))
    for problem, own in zip(batch.problems, batch.rows, strict=True):
        yield SolvedArrays(problem, columns, own)


def _columns(solution: Solution) -> Iterator[tuple[str, Reals]]:
    """Yield the results of a solution by the names of a sweep's rows, no negative zeros."""
    yield driver_of(solution.problem), solution.positions + 0.0
    for quantity in solution.construction.legend:
        if quantity.kind in BY_NAME:
            continue
        if quantity.kind is QuantityKind.DIRECTION:
            values = [solution.exact(quantity)]
        elif quantity.kind.is_number:
            values = [solution.si.number(quantity.name)]
        else:
            at_home = quantity.kind is QuantityKind.PLACE
            name = PointName(quantity.name)
            vector = solution.place(name) if at_home else solution.si.point(name)
            values = [vector.real, vector.imag]
        yield from zip(quantity.columns, (value + 0.0 for value in values), strict=True)
    if solution.problem.dynamics is not None:
        yield from _forces(solution)


def _forces(solution: Solution) -> Iterator[tuple[str, Reals]]:
    from planmethod.solved.forces.quantities import force_row, moment_row  # few files have any
    from planmethod.solved.forces.statics import statics_of

    statics = statics_of(solution)
    for planned, joint in zip(statics.board.reactions, statics.reactions, strict=True):
        name, force = force_row(planned), joint.force
        yield from ((f"{name}.x", force.real + 0.0), (f"{name}.y", force.imag + 0.0))
        yield name, np.hypot(force.real, force.imag)
        if planned.couple is not None:
            yield moment_row(planned), joint.moment + 0.0
    quantity = solution.problem.drive.balancing.quantity
    yield f"driving.{quantity}", statics.balance + 0.0
    if statics.lever is not None:
        yield f"lever.{quantity}", statics.lever + 0.0


@lru_cache(maxsize=64)  # most arrays of many variants are alike
def _head(dtype: np.dtype[Any], shape: tuple[int, ...]) -> bytes:
    whole = io.BytesIO()
    told = {"descr": np.lib.format.dtype_to_descr(dtype), "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(whole, told)
    return whole.getvalue()


def write_arrays(file: BinaryIO, named: Iterable[tuple[str, npt.NDArray[Any]]]) -> None:
    """Write arrays as ``numpy.savez`` does, one after another, with no time of day in the file."""
    with zipfile.ZipFile(file, "w") as whole:
        for name, array in named:
            member = zipfile.ZipInfo(f"{name}.npy", FIRST_DAY)
            member.create_system = 3  # the same on every system
            if array.nbytes <= SMALL:
                whole.writestr(member, _head(array.dtype, array.shape) + array.tobytes())
                continue
            with whole.open(member, "w", force_zip64=True) as target:
                np.lib.format.write_array(target, np.ascontiguousarray(array), allow_pickle=False)


def swept_arrays(swept: GappedSweep, prefix: str = "") -> Iterator[tuple[str, npt.NDArray[Any]]]:
    """Yield the results of a sweep by name.

    ``phi_deg`` or ``s``; every row by its name (``B.x``, ``2.omega``), NaN where it does not exist;
    ``reason``, int16, -1 where every step exists, else an index into ``reasons``, the sentences.
    """
    count = len(swept.positions)
    out = np.empty((len(swept.names), count))
    for part in swept.parts():
        swept.fill(out[:, part], part)
    yield prefix + driver_of(swept.problem), swept.positions + 0.0
    for name, values in zip(swept.names, out, strict=True):
        yield prefix + name, values
    yield f"{prefix}reason", swept.gaps.reason
    with speaking(WRITTEN):  # as in a CSV
        sentences = swept.gaps.sentences
    yield f"{prefix}reasons", np.array(sentences, dtype=np.str_)
