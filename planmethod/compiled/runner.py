"""A tape run for any number of positions by the quickest method for that number (прогон)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from planmethod.compiled.blocks import Blocks
from planmethod.compiled.javascript import javascript
from planmethod.compiled.pysource import ImpossibleError, Straight, straight
from planmethod.compiled.symbolic import TapeProgram
from planmethod.compiled.tape import Ref
from planmethod.construct.steps import Name

if TYPE_CHECKING:
    from planmethod.compiled.native import Native

Array = npt.NDArray[Any]

FEW = 40
"""Positions up to which a line of Python is quicker than NumPy's calls."""

MANY = 4096
"""Number of positions from which an earlier compiled library is looked for."""

PAYS = 30_000_000
"""Positions that take NumPy about as long as the compiler takes: from there on it is called."""


class Runner:
    """A program written on a tape and the requested results, prepared for running.

    Parameters
    ----------
    written : TapeProgram
    results : sequence of Ref
        Rows of the output.
    depends : sequence of frozenset of int
        Guards that each result depends on.
    dtype : dtype
        float64, or float32 for a picture.
    native : bool, optional
        Compile the tape with the system's C compiler now (True), or never use such code (False).
        Default: used from `MANY` positions on if it was compiled before, and compiled where that
        pays (`PAYS`).

    Attributes
    ----------
    uncompiled : str
        Reason why there is no machine code; empty if there is some.
    """

    def __init__(
        self,
        written: TapeProgram,
        results: Sequence[Ref],
        depends: Sequence[frozenset[int]],
        *,
        dtype: npt.DTypeLike = np.float64,
        native: bool | None = None,
    ) -> None:
        self.written, self._results, self._depends = written, tuple(results), tuple(depends)
        self._blocks = Blocks(written.tape, results, written.guards, depends, dtype=dtype)
        self._straight: Straight | None = None
        self._native: Native | None = None
        self._may_look = native is not False
        self._done = 0
        self.uncompiled = "it was not requested"
        if native:
            self.compile()

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the numbers that go in and come out."""
        return self._blocks.dtype

    @property
    def operations(self) -> int:
        """Real operations for one position, after folding."""
        return self._blocks.operations

    @property
    def live(self) -> int:
        """Most numbers of a position that are in use at a time."""
        return self._blocks.live

    @property
    def guards(self) -> tuple[Name, ...]:
        """Step of every margin that is watched."""
        return tuple(guard.step for guard in self.written.guards)

    def few(self, columns: Callable[[], Sequence[Array]], count: int) -> Array | None:
        """Return the results of a few positions, computed by the Python code.

        Parameters
        ----------
        columns : callable
            Returns the inputs, of shape (count,) or of one number each.

        Returns
        -------
        ndarray of shape (k, count) or None
            None where `run` is quicker, or must find which position is impossible.
        """
        if count > FEW or self._native is not None or self.dtype != np.float64:
            return None
        if self._straight is None:
            self._straight = straight(self.written.tape, self._results, self.written.guards)
        buffer = bytearray(8 * len(self._results) * count)
        given = [
            (value if value.shape == (count,) else np.broadcast_to(value, (count,))).tolist()
            for value in columns()
        ]
        try:
            self._straight(given, buffer)
        except (ImpossibleError, ArithmeticError, ValueError):
            return None
        return np.frombuffer(buffer).reshape(count, len(self._results)).T

    def expect(self, count: int) -> None:
        """Look for machine code if that many more positions justify it."""
        self._done += count
        if self._native is None and self._may_look and count >= MANY:
            self._load_native(may_compile=self._done >= PAYS)

    def run(
        self,
        columns: Sequence[Array],
        out: Array,
        failed: npt.NDArray[np.int16] | None = None,
    ) -> None:
        """Fill ``out`` of shape (k, n) or (k, v, n); NaN where a step is impossible.

        Parameters
        ----------
        columns : sequence of ndarray
            Inputs, which go together with an array of shape (n,) or (v, n).
        failed : ndarray of shape (n,) or (v, n), optional
            Filled with the number of the first guard that does not hold, or -1.
        """
        if self._native is not None and self._native.accepts(out, failed):
            self._native.run(columns, out, failed)
            return
        if out.ndim == 2:
            self._blocks.run(
                [_broadcast_row(column, out.shape[1]) for column in columns], out, failed
            )
            return
        count, size = out.shape[1:]
        wide = [np.broadcast_to(c, (count, (c.shape or (1,))[-1])) for c in columns]
        for i in range(count):
            mine = [_broadcast_row(c[i, 0] if c.shape[1] == 1 else c[i], size) for c in wide]
            self._blocks.run(mine, out[:, i], None if failed is None else failed[i])

    def accepts(self, out: Array, failed: Array | None) -> bool:
        """Return whether there is machine code that can fill these arrays."""
        return self._native is not None and self._native.accepts(out, failed)

    def bound(
        self, columns: Sequence[Array], out: Array, failed: npt.NDArray[np.int16] | None = None
    ) -> Callable[[], None]:
        """Return a call that does `run` again and again in the same arrays, which it `accepts`."""
        assert self._native is not None
        return self._native.bound(columns, out, failed)

    def compile(self) -> None:
        """Make machine code of the tape if it may be made and can be."""
        self._load_native(may_compile=True)

    def _load_native(self, *, may_compile: bool) -> None:
        """Take the machine code of the tape if there is any."""
        from planmethod.compiled.csource import c_source
        from planmethod.compiled.native import Native, NotCompiledError

        if self._native is not None or not self._may_look:
            return
        if self.dtype != np.float64:
            self.uncompiled = "single precision is NumPy's alone"
            return
        w = self.written
        try:
            source = c_source(w.tape, self._results, w.guards, self._depends)
            self._native = Native(source, may_compile=may_compile)
            self.uncompiled = ""
        except NotCompiledError as reason:
            self.uncompiled = str(reason)
            self._may_look = not may_compile

    def javascript(self) -> str:
        """Return the tape as a function of JavaScript of its inputs, ``run(x0, x1, ...)``.

        It returns an array of the results of one position and last the number of the first guard
        that does not hold, or -1; NaN for a result that depends on such a guard.
        """
        w = self.written
        return javascript(w.tape, self._results, w.guards, self._depends, len(w.inputs))


def _broadcast_row(column: Any, count: int) -> Any:
    """Return an input for each position of one variant, or one number for all."""
    return np.broadcast_to(column, (count,)) if column.ndim else column
