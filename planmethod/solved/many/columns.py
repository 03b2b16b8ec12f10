"""Results as named columns of numbers: in arrays, in a table of pandas (столбцы результатов).

A column has the name by which it is requested: ``omega_3``, ``phi_3``, a component ``x_E`` or
``vx_E``, the size of a vector ``v_E``, ``F_B_2/1``. Columns of CSV (``E.vx``) and keys of JSON mean
the same.
"""

# no messages: for programs in Python

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from planmethod.arguments import known, texts
from planmethod.compiled import Array
from planmethod.errors import OutputError
from planmethod.problem.model import Problem
from planmethod.problem.quantities import QuantityKey, QuantityNameError, parse_quantity
from planmethod.solved.many.rows import SweepRow
from planmethod.solved.many.sweep import Sweep

AXES = ("x", "y")


class Columns(Mapping[str, Array]):
    """Results by name, each an array of reals of one shape; NaN where a result does not exist.

    Parameters
    ----------
    problem : Problem
    rows : sequence of SweepRow
    values : ndarray of shape (k, ...)
    """

    def __init__(self, problem: Problem, rows: Sequence[SweepRow], values: Array) -> None:
        self._letters = problem.names_of_letters
        self._columns: dict[str, Array] = {}
        self._others: dict[str, str] = {}
        parts: dict[str, list[tuple[SweepRow, Array]]] = {}
        for row, own in zip(rows, values, strict=True):
            parts.setdefault(row.label, []).append((row, own))
        for label, several in parts.items():
            for (row, own), name in zip(several, _names(label, len(several)), strict=True):
                self._columns[name] = own
                self._others[row.name] = name
            if len(several) == 2 and not _is_place(label):
                self._columns[label] = np.hypot(several[0][1], several[1][1])
        self._keys = {name: self._key(name) for name in self._columns}

    def _key(self, name: str) -> QuantityKey | None:
        """Return the quantity of a name; None of a sliding pair, which has one spelling."""
        try:
            return parse_quantity(name).renamed(self._letters)
        except QuantityNameError:
            return None

    def __getitem__(self, name: str) -> Array:
        """Return the column of a name, in any of its spellings.

        Raises
        ------
        UnknownNameError
        """
        return self._columns[self._column_name(name)]

    def _column_name(self, name: str) -> str:
        if name in self._columns:
            return name
        if name in self._others:
            return self._others[name]
        key = self._key(name) if isinstance(name, str) else None
        alike = [own for own, other in self._keys.items() if key and other and key.is_same(other)]
        return alike[0] if alike else known("result", name, self._columns)

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def chosen(self, names: Iterable[str] | None) -> dict[str, Array]:
        """Return some columns, named as they are requested; a point ``E`` has two of them."""
        if names is None:
            return dict(self)
        found: dict[str, Array] = {}
        for name in texts("names", names):
            both = [f"{axis}_{name}" for axis in AXES]
            is_point = name not in self and all(one in self._columns for one in both)
            found |= {one: self[one] for one in (both if is_point else [name])}
        return found


def swept_columns(
    problem: Problem, positions: Any, names: Iterable[str] | None, *, forces: bool = False
) -> dict[str, Array]:
    """Return results of a problem in some positions, by name, ndarrays of shape (n,).

    Parameters
    ----------
    names : iterable of str, optional
        Default: everything of the motion, or of the forces.
    forces : bool

    Raises
    ------
    UnknownQuantityError
    """
    names = None if names is None else texts("names", names)
    asked = ["forces"] if forces and names is None else names
    sweep = Sweep(problem, asked, native=False)
    return Columns(problem, sweep.rows, sweep.run(positions)).chosen(names)


def _names(label: str, count: int) -> list[str]:
    """Return the names of the rows of a label: its components, and its size if there is a row."""
    if count == 1:
        return [label]
    if _is_place(label):
        return [f"{axis}_{label}" for axis in AXES]
    head, _, rest = label.partition("_")
    return [*(f"{head}{axis}_{rest}" for axis in AXES), label][:count]


def _is_place(label: str) -> bool:
    """Return whether a label is that of a point's place: the point alone."""
    return "_" not in label


def data_frame(columns: Mapping[str, Array], index: tuple[str, Array] | None = None) -> Any:
    """Return a table of pandas.

    Raises
    ------
    OutputError
        pandas is not installed.
    """
    try:
        import pandas  # optional: few programs have it
    except ImportError as error:
        raise OutputError(
            "to_frame() needs pandas: pip install pandas. to_columns() needs no library."
        ) from error
    rows = None if index is None else pandas.Index(index[1], name=index[0])
    return pandas.DataFrame(dict(columns), index=rows)
