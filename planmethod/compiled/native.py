"""A tape compiled by the system's C compiler and kept in the user's cache (машинный код).

A library is found by the hash of its source, of the flags and of the machine, and is called by that
and by the hash of its own bytes. It is loaded only from a folder that only the user can write to,
and only if its bytes match the hash; a library truncated by a full disk or a crash is compiled
again.
"""

# no messages: reasons for developers, source of a program

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
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.compiled.csource import Source

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
