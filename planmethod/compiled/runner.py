"""A tape run for any number of positions by the quickest method for that number (прогон)."""

from __future__ import annotations

import math
import re
import threading
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from planmethod.compiled.registers import registers
from planmethod.compiled.source import (
    EQUAL,
    ImpossibleError,
    Straight,
    javascript,
    straight,
    used_by,
)
from planmethod.compiled.tape import Guard, Ref, Tape, TapeProgram
from planmethod.construct.arithmetic import unit_vectors
from planmethod.construct.steps import Name

if TYPE_CHECKING:
    from planmethod.compiled.native import Native


Array = npt.NDArray[Any]

BLOCK = 16384
"""Maximum number of positions in a block: enough that NumPy's call overhead is small."""

MIN_BLOCK = 2048
"""Minimum number of positions in a block: below it, call overhead outweighs the caches' gain."""

CACHE_BYTES = 16 * 2**20
"""Bytes of the buffers and rows in use at a time: about what the caches hold."""

UFUNC: dict[str, np.ufunc] = {
    "add": np.add,
    "sub": np.subtract,
    "mul": np.multiply,
    "div": np.divide,
    "neg": np.negative,
    "abs": np.abs,
    "sqrt": np.sqrt,
    "min": np.minimum,
    "max": np.maximum,
    "atan2": np.arctan2,
    "above": np.greater,
    "floor": np.floor,
}


class Blocks:
    """A tape made ready for arrays.

    Parameters
    ----------
    tape : Tape
    results : sequence of Ref
        Rows of the output.
    guards : sequence of Guard
        Margins to be watched.
    depends : sequence of frozenset of int
        Guards that each result depends on.
    dtype : dtype
        float64, or float32 for a picture.
    block : int, optional
        Positions in a block. Default: chosen by the number of values in use.

    Attributes
    ----------
    live : int
        Largest number of values of a position in use at a time: computed and not yet read for the
        last time.
    operations : int
        Calls for a block, guards not counted.
    """

    def __init__(
        self,
        tape: Tape,
        results: Sequence[Ref],
        guards: Sequence[Guard],
        depends: Sequence[frozenset[int]],
        *,
        dtype: npt.DTypeLike = np.float64,
        block: int | None = None,
    ) -> None:
        self.results, self.guards, self.depends = tuple(results), tuple(guards), tuple(depends)
        self.dtype = np.dtype(dtype)
        steps, self._buffers, self.live = _schedule(tape, self.results, self.guards)
        self.operations = sum(step.kind != "guard" for step in steps)
        self.block = block or _block(self.live * self.dtype.itemsize)
        self._code = _line(steps, len(self.results))
        self._own = threading.local()  # each thread turns angles with arrays of its own

    def run(
        self,
        inputs: Sequence[Array],
        out: Array,
        failed: npt.NDArray[np.int16] | None = None,
    ) -> None:
        """Fill ``out`` of shape (k, n); NaN where a step is impossible.

        Parameters
        ----------
        inputs : sequence of ndarray of shape (n,) or ()
        failed : ndarray of shape (n,), optional
            Filled with the number of the first guard that does not hold, or -1.
        """
        count = out.shape[1]
        angle = getattr(self._own, "angle", None)
        if angle is None:
            angle = self._own.angle = _Angle(self.block, self.dtype)
        buffers = [np.empty(min(self.block, count), self.dtype) for _ in range(self._buffers)]
        with np.errstate(all="ignore"):
            for start in range(0, count, self.block):
                stop = min(start + self.block, count)
                size = stop - start
                here = buffers if size == len(buffers[0]) else [b[:size] for b in buffers]
                rows = [row[start:stop] for row in out]
                missed: dict[int, Array] = {}
                self._code(
                    [column[start:stop] if column.ndim else column for column in inputs],
                    rows,
                    here,
                    angle,
                    lambda guard, margin, missed=missed: missed.setdefault(
                        guard, ~(margin > self.guards[guard].limit)
                    ),
                )
                for row, ref in zip(rows, self.results, strict=True):
                    if type(ref) is float:
                        row.fill(ref)
                if failed is not None:
                    failed[start:stop] = -1
                    for guard in sorted(missed, reverse=True):
                        failed[start:stop][missed[guard]] = guard
                for guard, mask in missed.items():
                    for row, needs in zip(rows, self.depends, strict=True):
                        if guard in needs:
                            row[mask] = np.nan


class _Angle:
    """Cosine and sine of a block of angles in degrees, by a table where the steps are equal."""

    def __init__(self, block: int, dtype: np.dtype[Any]) -> None:
        self.block, self.dtype = block, dtype
        self.step: float | None = None
        self.work: list[Array] = []
        self.spare: list[Array] = []

    def __call__(self, degrees: Array, cosine: Array, sine: Array) -> None:
        if degrees.ndim == 0:  # one angle for all positions
            unit = complex(unit_vectors(float(degrees)))
            cosine.fill(unit.real)
            sine.fill(unit.imag)
            return
        few = len(degrees) <= 64 or self.dtype != np.float64
        if few or not self._by_table(degrees, cosine, sine):
            self._each(degrees, cosine, sine)

    def _each(self, degrees: Array, cosine: Array, sine: Array) -> None:
        """Reduce every angle to its quadrant, exactly, and turn the rest back by it."""
        size = len(degrees)
        if not self.spare:
            self.spare = [np.empty(self.block, self.dtype) for _ in range(4)]
        quarter, rest, across, work = (array[:size] for array in self.spare)
        np.multiply(degrees, 1.0 / 90.0, quarter)
        np.rint(quarter, quarter)
        np.multiply(quarter, 90.0, rest)
        np.subtract(degrees, rest, rest)
        np.multiply(rest, np.pi / 180.0, rest)
        # The quarter turn modulo 4: its cosine is |q - 2| - 1, its sine 1 - |q - 1|.
        np.multiply(quarter, 0.25, work)
        np.floor(work, work)
        np.multiply(work, 4.0, work)
        np.subtract(quarter, work, quarter)
        np.subtract(quarter, 1.0, across)
        np.abs(across, across)
        np.subtract(1.0, across, across)
        np.subtract(quarter, 2.0, quarter)
        np.abs(quarter, quarter)
        np.subtract(quarter, 1.0, quarter)
        np.cos(rest, work)
        np.sin(rest, rest)
        np.multiply(work, quarter, cosine)
        np.multiply(rest, quarter, sine)
        np.multiply(rest, across, rest)
        np.multiply(work, across, work)
        np.subtract(cosine, rest, cosine)
        np.add(sine, work, sine)

    def _by_table(self, degrees: Array, cosine: Array, sine: Array) -> bool:
        """Turn a table of equal steps to where the block begins.

        The departure of the given angles from equal steps, by rounding, is corrected to first
        order, so the result belongs to the angles as they are given.
        """
        size = len(degrees)
        first, step = float(degrees[0]), float(degrees[-1] - degrees[0]) / (size - 1)
        # Rounded, so that the blocks of one sweep share a table, and the table depends on nothing
        # but the step: not on what was swept before.
        step = float(f"{step:.13g}")
        if any(abs(float(degrees[k]) - first - k * step) > EQUAL for k in (1, size // 2)):
            return False
        if step != self.step:
            self._make_table(step)
        turns, c, s, rest, work = (array[:size] for array in self.work)
        np.subtract(degrees, first, rest)
        np.subtract(rest, turns, rest)
        if not (rest.max() < EQUAL and rest.min() > -EQUAL):
            return False
        np.multiply(rest, np.pi / 180.0, rest)
        unit = complex(unit_vectors(first))
        np.multiply(c, unit.real, cosine)
        np.multiply(s, unit.imag, work)
        np.subtract(cosine, work, cosine)
        np.multiply(c, unit.imag, sine)
        np.multiply(s, unit.real, work)
        np.add(sine, work, sine)
        np.multiply(sine, rest, work)
        np.multiply(cosine, rest, rest)
        np.subtract(cosine, work, cosine)
        np.add(sine, rest, sine)
        return True

    def _make_table(self, step: float) -> None:
        self.step = step
        turns = np.arange(self.block) * step
        unit = unit_vectors(turns)
        self.work = [turns, unit.real.copy(), unit.imag.copy()]
        self.work += [np.empty(self.block), np.empty(self.block)]


# From the tape to a line of calls ---------------------------------------------------------------

Place = str
"""Place of an operand: ``x0`` an input, ``o3`` a row of the output, ``b2`` a buffer, ``k5`` a
constant."""


class _Step:
    """One call: operation, sources and destination; or a guard to check."""

    __slots__ = ("into", "kind", "sources")

    def __init__(self, kind: str, sources: Iterable[Any], into: Iterable[Place]) -> None:
        self.kind, self.sources, self.into = kind, tuple(sources), tuple(into)


def _block(in_use: int) -> int:
    """Return the positions of a block, given the bytes in use at a time for each position."""
    return max(MIN_BLOCK, min(BLOCK, CACHE_BYTES // max(in_use, 1) // 1024 * 1024))


def _schedule(
    tape: Tape, results: Sequence[Ref], guards: Sequence[Guard]
) -> tuple[list[_Step], int, int]:
    """Give every node a place: a row of the output if it is a result, else a buffer.

    A buffer is reused as soon as its value has been used for the last time.

    Returns
    -------
    steps : list of _Step
    buffers : int
    live : int
        See `Blocks`.
    """
    watch: dict[int, list[int]] = {}
    for place_of, guard in enumerate(guards):
        if type(guard.margin) is int:
            watch.setdefault(guard.margin, []).append(place_of)
    needed = used_by(tape, [*results, *(guard.margin for guard in guards)])
    last = dict.fromkeys(needed, -1)
    partner = _partners(tape, needed)
    for number in needed:
        if tape.nodes[number].kind != "input":
            for ref in tape.nodes[number].operands:
                if type(ref) is int:
                    last[ref] = number
    rows: dict[int, int] = {}
    for row, ref in enumerate(results):
        if type(ref) is int:
            rows.setdefault(ref, row)
    place: dict[int, Place] = {}
    free: list[int] = []
    count = live = most = 0
    steps: list[_Step] = []

    def allocate(node: int) -> Place:
        nonlocal count, live, most
        live += 1
        most = max(most, live)
        if node in rows:
            place[node] = f"o{rows[node]}"
        else:
            if not free:
                free.append(count)
                count += 1
            place[node] = f"b{free.pop()}"
        return place[node]

    def release(node: int) -> None:
        nonlocal live
        live -= not place[node].startswith("x")
        if place[node].startswith("b"):
            free.append(int(place[node][1:]))

    for number in needed:
        kind, refs = tape.nodes[number]
        read = () if kind == "input" else refs
        sources = [place[ref] if type(ref) is int else float(ref) for ref in read]
        dying = [ref for ref in dict.fromkeys(read) if type(ref) is int and last[ref] == number]
        if kind == "input":
            place[number] = f"x{refs[0]}"
        elif kind in ("cosd", "sind"):
            if number not in place:  # else made together with its partner
                other = partner[number]
                pair = (number, other) if kind == "cosd" else (other, number)
                steps.append(_Step("turn", sources, [allocate(n) for n in pair]))
                for made in pair:
                    if last.get(made, -1) < 0 and made not in watch:
                        release(made)
            for ref in dying:
                release(ref)
        else:
            # In place where an operand is used for the last time: one buffer less in the cache.
            if kind != "at_zero":
                for ref in dying:
                    release(ref)
            steps.append(_Step(kind, sources, [allocate(number)]))
            if kind == "at_zero":
                for ref in dying:
                    release(ref)
        for watching in watch.get(number, ()):
            limit = guards[watching].limit
            steps.append(_Step("guard", [place[number], watching, limit], []))
        if last[number] < 0 and kind not in ("input", "cosd", "sind"):
            release(number)
    for row, ref in enumerate(results):
        if type(ref) is int and rows[ref] != row:
            steps.append(_Step("copy", [f"o{rows[ref]}"], [f"o{row}"]))
        elif type(ref) is int and place[ref].startswith("x"):
            steps.append(_Step("copy", [place[ref]], [f"o{row}"]))
    return steps, max(count, 1), most


def _partners(tape: Tape, needed: list[int]) -> dict[int, int]:
    """Return for every cosine the node of its sine and vice versa; -1 where it is not needed."""
    of: dict[tuple[str, Ref], int] = {}
    for number in needed:
        kind, refs = tape.nodes[number]
        if kind in ("cosd", "sind"):
            of[kind, refs[0]] = number
    result: dict[int, int] = {}
    for (kind, ref), number in of.items():
        result[number] = of.get(("sind" if kind == "cosd" else "cosd", ref), -1 - number)
    return result


# no messages: source of a program
def _line(steps: list[_Step], rows: int) -> Callable[..., None]:
    """Compile the calls to one function; its source holds numbered places only."""
    constants: dict[float, str] = {}

    def operand_text(source: Any) -> str:
        if isinstance(source, float):
            return constants.setdefault(source, f"k{len(constants)}")
        return str(source)

    lines = []
    for step in steps:
        match step.kind:
            case "guard":
                margin, guard, limit = step.sources
                lines.append(f"if not least({margin}) > {limit!r}: fail({guard}, {margin})")
            case "turn":
                lines.append(
                    f"turn({operand_text(step.sources[0])}, {step.into[0]}, {step.into[1]})"
                )
            case "copy":
                lines.append(f"copyto({step.into[0]}, {operand_text(step.sources[0])})")
            case "at_zero":
                size, other, value = map(operand_text, step.sources)
                lines.append(f"copyto({step.into[0]}, {value})")
                lines.append(f"copyto({step.into[0]}, {other}, where={size} == 0.0)")
            case "degrees":
                (angle,), (into,) = map(operand_text, step.sources), step.into
                lines.append(f"multiply({angle}, {180.0 / math.pi!r}, {into})")
                # One place for both ends of the half turn; NaN hides none.
                lines.append(f"if not least({into}) > -180.0: ")
                lines[-1] += f"copyto({into}, 180.0, where={into} <= -180.0)"
            case kind:
                into = f"out={step.into[0]}" if kind in ("min", "max") else step.into[0]
                lines.append(f"{kind}({', '.join(map(operand_text, step.sources))}, {into})")
    text = "\n".join(f"    {line}" for line in lines or ["pass"])
    used = sorted(set(_names(text)))
    head = []
    for letter, source in (("x", "inputs"), ("o", "out"), ("b", "buffers")):
        head += [f"    {name} = {source}[{name[1:]}]" for name in used if name[0] == letter]
    source = "def run(inputs, out, buffers, turn, fail):\n" + "\n".join(head) + "\n" + text + "\n"
    namespace: dict[str, Any] = {f"{kind}": ufunc for kind, ufunc in UFUNC.items()}
    namespace |= {"multiply": np.multiply, "least": np.minimum.reduce, "copyto": np.copyto}
    namespace |= {name: np.asarray(value) for value, name in constants.items()}
    exec(compile(source, "<plan>", "exec"), namespace)  # source of our own making only
    made: Callable[..., None] = namespace["run"]
    return made


def _names(text: str) -> list[str]:
    return re.findall(r"\b[xob]\d+\b", text)


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
        from planmethod.compiled.native import Native, NotCompiledError, c_source

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

    def registers(self) -> dict[str, Any]:
        """Return the tape as plain data of its inputs; see `registers`."""
        w = self.written
        return registers(w.tape, self._results, w.guards, self._depends, len(w.inputs))

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
