"""A tape as a C function, compiled by the system's compiler and kept in the user's cache."""

from __future__ import annotations

import ctypes
import hashlib
import itertools
import os
import platform
import shutil
import stat
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from planmethod.compiled.source import BINARY, EQUAL, used_by
from planmethod.compiled.tape import Guard, Ref, Tape

BLOCK = 512
"""Positions between two checks of the margins."""

BUFFER_PADDING = 24
"""Doubles between buffers: places a page apart push each other out of the cache."""

OPERATIONS_PER_LOOP = 200
"""Operations of one loop: longer ones are slower."""

ROWS_PER_LOOP = 20
"""Rows that one loop writes: more streams than that go slower through the memory."""

OPERATION_WEIGHTS = {"cosd": 30, "sind": 0, "atan2": 30}
"""Operations that one of these comes to; a sine comes with its cosine."""

GUARDS_PER_WORD = 63
"""Guards in one word of the margins that do not hold."""

FEW = 64
"""Positions below which a table of angles does not pay."""

_HEAD = (
    f"""#define BLOCK {BLOCK}
#define FEW {FEW}
#define EQUAL {EQUAL}
"""
    + """#include <math.h>
#include <stdint.h>
#include <string.h>
#if defined(__clang__)
#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define INDEPENDENT _Pragma("GCC ivdep")
#endif
static inline double least(double a, double b) { return a < b || a != a ? a : b; }
static inline double most(double a, double b) { return a > b || a != a ? a : b; }
/* Cosine and sine of degrees: the rest of a quarter turn, exact, by the polynomials of fdlibm. */
static inline void turn(double degrees, double *cosine, double *sine)
{
    const double quarter = rint(degrees * (1.0 / 90.0));
    const double r = (degrees - quarter * 90.0) * (M_PI / 180.0), z = r * r, half = 0.5 * z;
    const double s = r + r * z * (-1.66666666666666324348e-01 + z * (8.33333333332248946124e-03
        + z * (-1.98412698298579493134e-04 + z * (2.75573137070700676789e-06
        + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
    const double p = z * z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03
        + z * (2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07
        + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
    const double w = 1.0 - half, c = w + (((1.0 - w) - half) + p);
    const double turns = quarter - 4.0 * floor(quarter * 0.25);
    const double along = fabs(turns - 2.0) - 1.0, across = 1.0 - fabs(turns - 1.0);
    *cosine = c * along - s * across;
    *sine = s * along + c * across;
}
/* The same of n degrees x of a row of so many: by a table where the steps of the row are equal. */
static void turned(const double *x, long n, const double *row, long many, double *table,
                   double *cosine, double *sine)
{
    const long last = (many < BLOCK ? many : BLOCK) - 1;
    const double step = (row[last] - row[0]) / (double)(last + !last);
    double *c = table + 1, *s = c + BLOCK, along, across;
    uint64_t uneven = last < FEW;
    for (int i = 0; i < (int)n; i++)
        uneven |= fabs((x[i] - x[0]) - (double)i * step) < EQUAL ? 0 : UINT64_C(1);
    if (uneven) {
        INDEPENDENT
        for (int i = 0; i < (int)n; i++) turn(x[i], cosine + i, sine + i);
        return;
    }
    if (table[0] != step) {
        INDEPENDENT
        for (int i = 0; i < BLOCK; i++) turn((double)i * step, c + i, s + i);
        table[0] = step;
    }
    turn(x[0], &along, &across);
    INDEPENDENT
    for (int i = 0; i < (int)n; i++) { /* what rounding makes of the steps is corrected */
        const double rest = ((x[i] - x[0]) - (double)i * step) * (M_PI / 180.0);
        const double u = c[i] * along - s[i] * across, v = c[i] * across + s[i] * along;
        cosine[i] = u - v * rest;
        sine[i] = v + u * rest;
    }
}
static inline double angle(double y, double x)
{
    const double a = fabs(x), b = fabs(y), small = a < b ? a : b, large = a < b ? b : a;
    const int far = small > 0.41421356237309503 * large; /* above the tangent of 22.5 degrees */
    const double over = far ? large + small : large;
    const double t = (far ? small - large : small) / (over == 0.0 ? 1.0 : over), z = t * t;
    const double p = z * (3.33333333333329318027e-01 + z * (-1.99999999998764832476e-01
        + z * (1.42857142725034663711e-01 + z * (-1.11111104054623557880e-01
        + z * (9.09088713343650656196e-02 + z * (-7.69187620504482999495e-02
        + z * (6.66107313738753120669e-02 + z * (-5.83357013379057348645e-02
        + z * (4.97687799461593236017e-02 + z * (-3.65315727442169155270e-02
        + z * 1.62858201153657823623e-02))))))))));
    const double u = (far ? M_PI_4 : 0.0) + (t - t * p);
    const double v = a < b ? M_PI_2 - u : u;
    return copysign(x < 0.0 ? M_PI - v : v, y);
}
static inline double degrees(double radians)
{
    const double d = radians * (180.0 / M_PI);
    return d <= -180.0 ? 180.0 : d;
}
"""
)


class Source(NamedTuple):
    """C source of a tape, and its constants and inputs.

    Attributes
    ----------
    text : str
        Source of ``run(frame)``.
    constants : tuple of float
    inputs : tuple of int
        Inputs of the tape that it reads, in order.
    """

    text: str
    constants: tuple[float, ...]
    inputs: tuple[int, ...]


def c_source(
    tape: Tape,
    results: Sequence[Ref],
    guards: Sequence[Guard],
    depends: Sequence[frozenset[int]],
) -> Source:
    """Print a tape as the source of a function.

    Its only argument is a frame of 64-bit integers: variants, positions; address of the results,
    doubles from row to row of them and from variant to variant; address of the first guards that
    do not hold (int16, or 0), and from variant to variant; address of the constants; and for every
    input its address and doubles from variant to variant and from position to position (0 or 1).

    Parameters
    ----------
    results, guards, depends
        As of `Blocks`.
    """
    words = -(-len(guards) // GUARDS_PER_WORD)
    lines = _Lines(tape, results, guards)
    needs = [
        [
            _bits(sum(1 << g % GUARDS_PER_WORD for g in one if g // GUARDS_PER_WORD == word))
            for word in range(words)
        ]
        for one in depends
    ]
    return Source(_wrap_function(lines, needs, words), tuple(lines.constants), tuple(lines.inputs))


# no messages: source of a program
class _Lines:
    """Lines of the loops while they are written."""

    def __init__(self, tape: Tape, results: Sequence[Ref], guards: Sequence[Guard]) -> None:
        self.tape = tape
        self.loops: list[list[str]] = []
        self.constants: dict[float, str] = {}
        self.inputs: list[int] = []
        self.turned: set[int] = set()  # inputs of which a cosine or a sine is taken
        self.buffers = 0
        self.watched: set[int] = set()  # words of the margins that earlier loops have checked
        self._home: dict[int, str] = {}  # where the next loops find a node
        needed = used_by(tape, [*results, *(guard.margin for guard in guards)])
        if (
            len(needed) <= OPERATIONS_PER_LOOP
        ):  # all of it fits in the nearest cache: quickest as written
            needed.sort()
        stages = _stages(tape, needed, results)
        last = {ref: k for k, stage in enumerate(stages) for n in stage for ref in _used(tape, n)}
        rows = _places(results)
        watching = _places([guard.margin for guard in guards])
        ending: list[list[str]] = [[] for _ in stages]  # buffers by the stage that reads them last
        free: list[str] = []
        for k, stage in enumerate(stages):
            self._begin_loop(stage)
            for number in stage:
                self._write(number)
                for row in rows.get(number, ()):
                    self._text.append(f"o{row}[i] = {self._name(number)};")
                    self._home.setdefault(number, f"o{row}")
                for place in watching.get(number, ()):
                    self._watch(number, place, guards[place].limit)
                if last.get(number, k) > k and number not in self._home:
                    if not free:
                        free.append(f"b{self.buffers}")
                        self.buffers += 1
                    self._home[number] = free.pop()
                    ending[last[number]].append(self._home[number])
                    self._text.append(f"{self._home[number]}[i] = {self._name(number)};")
            self._end_loop()
            free += ending[k]
        for row, ref in enumerate(results):
            if type(ref) is float:
                self._text.append(f"o{row}[i] = {self._name(ref)};")

    def _begin_loop(self, stage: Sequence[int]) -> None:
        """Begin a loop with no values computed yet."""
        nodes = [self.tape.nodes[number] for number in stage]
        self._divisors = Counter(node.operands[1] for node in nodes if node.kind == "div")
        self._said: dict[int, str] = {}
        self._turned: dict[str, int] = {}
        self._inverse: dict[str, str] = {}
        self._text: list[str] = []
        self._here: list[int] = []  # words of the margins that this loop checks
        self.loops.append(self._text)

    def _end_loop(self) -> None:
        """End a loop: keep the margins that do not hold."""
        for word in self._here:
            self._text.append(f"bad{word}[i] = g{word}; any{word} |= g{word};")
        self.watched.update(self._here)

    def _name(self, ref: Ref) -> str:
        """Return the name of an operand; a constant becomes a parameter."""
        if type(ref) is not int:
            return self.constants.setdefault(float(ref), f"k{len(self.constants)}")
        if ref not in self._said:
            self._text.append(f"const double t{ref} = {self._home[ref]}[i];")
            self._said[ref] = f"t{ref}"
        return self._said[ref]

    def _write(self, number: int) -> None:
        """Write an operation."""
        kind, refs = self.tape.nodes[number]
        if kind == "input":
            self._home[number] = f"x{len(self.inputs)}"
            self.inputs.append(int(refs[0]))
            return
        if kind in ("cosd", "sind") and _is_input(self.tape, refs[0]):
            k = self.inputs.index(int(self.tape.nodes[int(refs[0])].operands[0]))
            self.turned.add(k)
            self._home[number] = f"{kind[0]}{k}"
            self._said[number] = f"{kind[0]}{k}[i]"
            return
        names = [self._name(ref) for ref in refs]
        self._said[number] = f"t{number}"
        if kind in ("cosd", "sind"):
            if names[0] not in self._turned:
                at = self._turned[names[0]] = len(self._turned)
                self._text.append(f"double u{at}, v{at}; turn({names[0]}, &u{at}, &v{at});")
            self._said[number] = f"{'uv'[kind == 'sind']}{self._turned[names[0]]}"
            return
        phrase = _expression(kind, names)
        # One division for all by the same divisor; constants are divided by before the loop.
        if kind == "div" and (type(refs[1]) is float or self._divisors[refs[1]] > 1):
            if names[1] not in self._inverse:
                self._inverse[names[1]] = f"r{len(self._inverse)}"
                self._text.append(f"const double {self._inverse[names[1]]} = 1.0 / {names[1]};")
            phrase = f"{names[0]} * {self._inverse[names[1]]}"
        self._text.append(f"const double t{number} = {phrase};")

    def _watch(self, number: int, place: int, limit: float) -> None:
        """Note where the margin of a guard does not hold."""
        word, bit = divmod(place, GUARDS_PER_WORD)
        holds = f"{self._name(number)} > {self._name(float(limit))}"
        if word not in self._here:
            self._here.append(word)
            before = f"bad{word}[i]" if word in self.watched else "0"
            self._text.append(f"uint64_t g{word} = {before};")
        self._text.append(f"g{word} |= {holds} ? 0 : {_bits(1 << bit)};")


def _places(refs: Sequence[Ref]) -> dict[int, list[int]]:
    """Return the index of every node in a sequence."""
    found: dict[int, list[int]] = {}
    for place, ref in enumerate(refs):
        if type(ref) is int:
            found.setdefault(ref, []).append(place)
    return found


def _is_input(tape: Tape, ref: Ref) -> bool:
    return type(ref) is int and tape.nodes[ref].kind == "input"


def _used(tape: Tape, number: int) -> list[int]:
    kind, refs = tape.nodes[number]
    return [] if kind == "input" else [ref for ref in refs if type(ref) is int]


def _stages(tape: Tape, needed: Sequence[int], results: Sequence[Ref]) -> list[list[int]]:
    """Cut operations into loops."""
    rows = Counter(ref for ref in results if type(ref) is int)
    stages: list[list[int]] = [[]]
    weight = written = 0
    for number in needed:
        kind, refs = tape.nodes[number]
        own = 0 if kind == "cosd" and _is_input(tape, refs[0]) else OPERATION_WEIGHTS.get(kind, 1)
        if weight + own > OPERATIONS_PER_LOOP or written + rows[number] > ROWS_PER_LOOP:
            stages.append([])
            weight = written = 0
        stages[-1].append(number)
        weight += own
        written += rows[number]
    return stages


def _bits(number: int) -> str:
    return f"UINT64_C({number:#x})"


# no messages: source of a program
def _wrap_function(lines: _Lines, needs: Sequence[Sequence[str]], words: int) -> str:
    """Wrap the loop in a function, followed by the handling of margins that do not hold."""
    rows = range(len(needs))
    own = [f"const double k{k} = k[{k}];" for k in range(len(lines.constants))]
    own += [f"double e{k}[{BLOCK}];" for k in range(len(lines.inputs))]
    own += [f"double b{k}[{BLOCK + BUFFER_PADDING}];" for k in range(lines.buffers)]
    own += [f"uint64_t bad{w}[{BLOCK}];" for w in range(words)]
    turned = sorted(lines.turned)
    own += [f"double c{k}[BLOCK], s{k}[BLOCK], table{k}[2 * BLOCK + 1] = {{NAN}};" for k in turned]
    here = [f"double *o{row} = out + {row} * f[3];" for row in rows]
    here += [f"uint64_t any{w} = 0;" for w in range(words)]
    here += [f"memset(bad{w}, 0, sizeof bad{w});" for w in range(words) if w not in lines.watched]
    for k in range(len(lines.inputs)):
        address, variant, position = (f"f[{8 + 3 * k + j}]" for j in range(3))
        here += [
            f"const double *x{k} = (const double *){address} + v * {variant}, *y{k} = x{k};",
            f"(void)y{k}; if ({position}) x{k} += first;",
            f"else {{ for (long i = 0; i < n; i++) e{k}[i] = *x{k}; x{k} = e{k}; }}",
        ]
        if k in lines.turned:
            row = f"{position} ? y{k} : x{k}, {position} ? f[1] : n"
            here.append(f"turned(x{k}, n, {row}, table{k}, c{k}, s{k});")
    look = []
    if words:
        table = ", ".join(f"{{{', '.join(one)}}}" for one in needs)
        hit = " | ".join(f"(any{w} & need[{w}])" for w in range(words))
        here_too = " | ".join(f"(bad{w}[i] & need[{w}])" for w in range(words))
        look = [
            f"if ({' | '.join(f'any{w}' for w in range(words))}) {{",
            f"    static const uint64_t needs[{len(needs)}][{words}] = {{{table}}};",
            f"    for (long row = 0; row < {len(needs)}; row++) {{",
            "        const uint64_t *need = needs[row];",
            "        double *o = out + row * f[3];",
            f"        if ({hit}) for (long i = 0; i < n; i++) o[i] = {here_too} ? NAN : o[i];",
            "    }",
            "    if (failed) for (long i = 0; i < n; i++) {",
        ]
        for w in reversed(range(words)):  # the first guard last: it stays
            first = f"failed[i] = (int16_t)({GUARDS_PER_WORD * w} + __builtin_ctzll(bad{w}[i]));"
            look.append(f"        if (bad{w}[i]) {first}")
        look += ["    }", "}"]
    loops = [
        "INDEPENDENT\n        for (long i = 0; i < n; i++) {\n            "
        + _joined(loop, 12)
        + "\n        }"
        for loop in lines.loops
    ]
    return f"""{_HEAD}void run(const int64_t *f)
{{
    const double *k = (const double *)f[7];
    (void)k;
    {_joined(own, 4)}
    for (long v = 0; v < f[0]; v++) for (long first = 0; first < f[1]; first += {BLOCK}) {{
        const long n = f[1] - first < {BLOCK} ? f[1] - first : {BLOCK};
        double *out = (double *)f[2] + v * f[4] + first;
        int16_t *failed = f[5] ? (int16_t *)f[5] + v * f[6] + first : 0;
        (void)out;
        {_joined(here, 8)}
        {_joined(loops, 8)}
        if (failed) for (long i = 0; i < n; i++) failed[i] = -1;
        {_joined(look, 8)}
    }}
}}
"""


def _joined(lines: Sequence[str], indent: int) -> str:
    return ("\n" + " " * indent).join(lines)


def _expression(kind: str, refs: list[str]) -> str:
    if kind in BINARY:
        return f"{refs[0]} {BINARY[kind]} {refs[1]}"
    match kind:
        case "neg":
            return f"-{refs[0]}"
        case "at_zero":
            return f"{refs[0]} == 0.0 ? {refs[1]} : {refs[2]}"
        case "above":
            return f"{refs[0]} > {refs[1]} ? 1.0 : 0.0"
        case _:
            names = {"abs": "fabs", "min": "least", "max": "most", "atan2": "angle"}
            return f"{names.get(kind, kind)}({', '.join(refs)})"


Array = npt.NDArray[Any]

SWITCH = "PLANMETHOD_NATIVE"
"""Environment variable: ``0`` leaves the compiler alone."""

COMPILERS = ("cc", "gcc", "clang")

FLAGS = (
    "-std=gnu11", "-O3", "-fPIC", "-shared", "-w", "-fno-math-errno", "-fno-trapping-math",
    "-ffp-contract=fast", "-fno-ivopts",
)  # fmt: skip
"""A root is an instruction, several positions are done at a time, a product with a sum is rounded
once: results are those of NumPy to rounding. The last saves a third of the compiling."""

MACHINE_FLAG = "-march=native"

PATIENCE = 120
"""Seconds that a compiler is given."""

MAX_CACHE_BYTES = 32 * 2**20
"""Maximum size of the cached libraries, bytes; the least recently used ones are removed."""


class NotCompiledError(Exception):
    """Reason, as a sentence, why there is no library; NumPy does the work instead."""


class Native:
    """A compiled tape.

    Parameters
    ----------
    source : Source
    may_compile : bool
        Compile it if it is not in the cache yet.

    Raises
    ------
    NotCompiledError
    """

    def __init__(self, source: Source, *, may_compile: bool) -> None:
        self.source = source
        self._constants = np.array(source.constants)
        self._run: Callable[[ctypes.c_void_p], Any] = _library(
            source.text, may_compile=may_compile
        ).run
        self._run.restype = None

    @staticmethod
    def accepts(out: Array, failed: Array | None) -> bool:
        """Return whether buffers can be filled in place."""
        return _in_line(out, np.float64) and (failed is None or _in_line(failed, np.int16))

    def run(self, inputs: Sequence[Array], out: Array, failed: Array | None = None) -> None:
        """Fill ``out`` of shape (k, n) or (k, v, n); see `Blocks.run`.

        Parameters
        ----------
        inputs : sequence of ndarray of float64
            Arrays that broadcast with positions of shape (n,) or (v, n).
        """
        self.bound(inputs, out, failed)()

    def bound(
        self, inputs: Sequence[Array], out: Array, failed: Array | None = None
    ) -> Callable[[], None]:
        """Return a call that does `run` again and again in the same arrays."""
        shape = out.shape[1:] if out.ndim == 3 else (1, out.shape[1])
        frame = [*shape, out.ctypes.data, out.strides[0] // 8, out.strides[-2] // 8]
        frame += [0, 0] if failed is None else [failed.ctypes.data, failed.strides[0] // 2]
        frame.append(self._constants.ctypes.data)
        kept = []
        for number in self.source.inputs:
            column = np.asarray(inputs[number], dtype=np.float64)
            if column.ndim and column.shape[-1] > 1 and column.strides[-1] not in (0, 8):
                column = np.ascontiguousarray(column)
            kept.append(column)
            steps = [0, 0]  # of a missing axis, or of one along which nothing moves
            for axis in range(1, column.ndim + 1):
                steps[-axis] = column.strides[-axis] // 8 if column.shape[-axis] > 1 else 0
            frame += [column.ctypes.data, *steps]
        numbers = np.array(frame, np.int64)
        run, address = self._run, ctypes.c_void_p(numbers.ctypes.data)

        def call(_references: object = (kept, numbers, out, failed)) -> None:
            run(address)

        return call


def _in_line(array: Array, dtype: npt.DTypeLike) -> bool:
    size = array.dtype.itemsize
    return (
        array.dtype == dtype
        and array.dtype.isnative
        and (array.shape[-1] <= 1 or array.strides[-1] == size)
        and all(step % size == 0 for step in array.strides)
        and array.flags.aligned
        and array.flags.writeable
    )


def _machine() -> str:
    """Return what a library with machine-specific code depends on: the machine's instructions."""
    try:
        with Path("/proc/cpuinfo").open(encoding="utf-8") as info:
            said = [line for line in info.read(16384).splitlines() if line[:4] in ("flag", "Feat")]
    except OSError:
        said = [platform.processor()]
    return f"{sys.platform} {platform.machine()} {said[:1]}"


# no messages: reasons for developers, source of a program
def _folder() -> Path:
    """Return the folder of the libraries; made if it is not there.

    Raises
    ------
    NotCompiledError
        If it cannot be made, or others can write to it.
    """
    if not hasattr(os, "getuid"):
        raise NotCompiledError("compilation is not supported on this system")
    base = Path(os.environ.get("XDG_CACHE_HOME", ""))
    try:
        if not base.is_absolute():
            base = Path.home() / ("Library/Caches" if sys.platform == "darwin" else ".cache")
        folder = base / "planmethod" / "native"
        for one in (*reversed(folder.parents), folder):
            one.mkdir(mode=0o700, exist_ok=True)  # parents too, whatever the umask
        found = folder.lstat()
    except (OSError, RuntimeError) as error:
        raise NotCompiledError(f"its folder cannot be made: {error}") from error
    if not _mine(found, stat.S_ISDIR) or found.st_mode & 0o077:
        raise NotCompiledError(f"{folder} is open to others: make it yours alone (chmod 700)")
    return folder


def _mine(status: os.stat_result, kind: Callable[[int], bool]) -> bool:
    return kind(status.st_mode) and status.st_uid == os.getuid() and not status.st_mode & 0o022


# no messages: reasons for developers, source of a program
def _library(text: str, *, may_compile: bool) -> ctypes.CDLL:
    """Return a library from the cache, or a newly compiled one."""
    if os.environ.get(SWITCH) == "0":
        raise NotCompiledError(f"{SWITCH}=0 leaves the compiler alone")
    folder = _folder()
    phrase = "\0".join((text, *FLAGS, MACHINE_FLAG, _machine()))
    name = hashlib.sha256(phrase.encode()).hexdigest()[:40]
    try:
        for path in sorted(folder.glob(f"{name}-*.so")):
            library = _loaded(path)
            if library is not None:
                return library
            path.unlink(missing_ok=True)
    except OSError as error:
        raise NotCompiledError(f"{path}: {error.strerror}") from error
    if not may_compile:
        raise NotCompiledError("it has not been compiled yet")
    path = _compile(text, folder, name)
    library = _loaded(path)
    if library is None:
        raise NotCompiledError(f"{path} is not what was written: is the disk full?")
    return library


_ALIASES = itertools.count(1)


# no messages: reasons for developers, source of a program
def _loaded(path: Path) -> ctypes.CDLL | None:
    """Load a library; return None if its bytes do not match the hash in its name.

    The checked file is the loaded file: both use one descriptor, on systems that allow it.
    """
    number = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
    with open(number, "rb") as file:  # noqa: PTH123 - by its descriptor
        if not _mine(os.fstat(number), stat.S_ISREG):
            raise NotCompiledError(f"{path} is not a file of yours alone: remove it")
        if hashlib.file_digest(file, "sha256").hexdigest()[:40] != path.stem.partition("-")[2]:
            return None
        os.utime(number)
        own = f"/proc/self/fd/{number}"
        if Path(own).exists():
            # A name that was loaded once stays that library's: each time another one.
            own = own.replace("fd/", "fd/" + bin(next(_ALIASES))[2:].translate(_SLASHES))
        else:
            own = str(path)
        try:
            return ctypes.CDLL(own)
        except OSError as error:
            raise NotCompiledError(f"{path} was not loaded: {error}") from error


_SLASHES = {ord("0"): "/", ord("1"): "./"}


# no messages: reasons for developers, source of a program
def _compile(text: str, folder: Path, name: str) -> Path:
    """Compile a source to a file, atomically, and return it."""
    compiler = next(filter(None, map(shutil.which, COMPILERS)), None)
    if compiler is None:
        raise NotCompiledError(f"there is no C compiler ({', '.join(COMPILERS)})")
    try:
        with tempfile.TemporaryDirectory(dir=folder, ignore_cleanup_errors=True) as place:
            made, phrase = Path(place) / "tape.so", ""
            for flags in ((*FLAGS, MACHINE_FLAG), FLAGS):  # not every compiler knows the machine
                done = subprocess.run(
                    [compiler, *flags, "-o", str(made), "-x", "c", "-", "-lm"],
                    input=text, capture_output=True, encoding="utf-8", errors="replace",
                    timeout=PATIENCE, check=False,
                )  # fmt: skip
                if done.returncode == 0:
                    made.chmod(0o700)
                    with made.open("rb") as file:
                        os.fsync(file.fileno())
                        own = hashlib.file_digest(file, "sha256").hexdigest()[:40]
                    path = made.replace(folder / f"{name}-{own}.so")
                    break
                phrase = (done.stderr.strip() or "no message").splitlines()[0]
            else:
                raise NotCompiledError(f"{compiler} did not compile: {phrase}")
        _trim_cache(path)
        return path
    except (OSError, subprocess.SubprocessError) as error:
        raise NotCompiledError(f"{compiler} did not compile: {error}") from error


def _trim_cache(newest: Path) -> None:
    """Remove the least recently used libraries, down to `MAX_CACHE_BYTES`."""
    found = []
    for path in newest.parent.glob("*.so"):
        try:
            about = path.stat()
        except OSError:
            continue
        found.append((path == newest, about.st_mtime, about.st_size, path))
    size = 0
    for _, _, own, path in sorted(found, reverse=True):
        size += own
        if size > MAX_CACHE_BYTES and path != newest:
            path.unlink(missing_ok=True)
