"""Arrays in one file that NumPy loads, the same bytes for the same arrays."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Iterator
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from planmethod.languages import WRITTEN, speaking
from planmethod.note.records.spreadsheet import driver_of
from planmethod.solved.many.gaps import GappedSweep

FIRST_DAY = (1980, 1, 1, 0, 0, 0)
"""Time of every member: the earliest that the format has."""


def write_arrays(file: BinaryIO, named: Iterable[tuple[str, npt.NDArray[Any]]]) -> None:
    """Write arrays as ``numpy.savez`` does, one after another, with no time of day in the file."""
    with zipfile.ZipFile(file, "w") as whole:
        for name, array in named:
            member = zipfile.ZipInfo(f"{name}.npy", FIRST_DAY)
            member.create_system = 3  # the same on every system
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
