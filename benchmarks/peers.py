"""The peers of the speed benchmark: the same four-bar by compiled code and by another library.

A = (0, 0), D = (0.4, 0), AB = 0.1, BC = 0.35, CD = 0.3 (m), C to the left of the directed line
B -> D; the crank turns at a constant 10 1/s. A solution has 20 rows, one column per position:
x y, vx vy, ax ay of B and of C, then cos sin, omega, epsilon of link 2 (B -> C) and of link 3
(D -> C).

Peers that cannot run here (no compiler, no library) are left out; `missing` lists them.
"""

from __future__ import annotations

import ctypes
import importlib
import math
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]

PEERS = 2
"""Number of peers: compiled C and pylinkage."""

ROWS = 20
OMEGA = 10.0  # 1/s
FRAME, CRANK, COUPLER, ROCKER = 0.4, 0.1, 0.35, 0.3  # m
COMPILERS = ("cc", "gcc", "clang")
FLAGS = ("-std=c11", "-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math")
SOURCE = Path(__file__).with_name("fourbar.c")


@dataclass(frozen=True)
class Peer:
    """A peer that solves the four-bar.

    Attributes
    ----------
    name : str
        Name in a table.
    computes : str
        Results and method.
    rows : tuple of int
        Rows of the 20 of a solution that its answer has, in its order.
    run : callable
        From crank angles (degrees) to an array of ``len(rows)`` rows, or None where the peer
        needs equally spaced angles and these are not. An array of angles is examined when it is
        first met: to ask about other angles, give another array. The answer may be overwritten
        by the next call.
    """

    name: str
    computes: str
    rows: tuple[int, ...]
    run: Callable[[Floats], Floats | None]

    def error(self, phi: Floats, expected: Floats) -> float | None:
        """Return the error of the answer against a solution known to be right.

        Parameters
        ----------
        phi : array of float
            Crank angles, degrees.
        expected : array of float
            All 20 rows at these angles.

        Returns
        -------
        float or None
            The largest difference, each row in units of its own largest value; None where the
            peer does not answer.
        """
        answer = self.run(phi)
        if answer is None:
            return None
        right = expected[list(self.rows)]
        scale = np.max(np.abs(right), axis=1, keepdims=True)
        return float(np.max(np.abs(answer - right) / np.where(scale > 0.0, scale, 1.0)))


Call: TypeAlias = Callable[[], Floats]


def peers() -> list[Peer]:
    """Return the peers that can run here, warmed up."""
    return list(_found()[0])


def missing() -> list[str]:
    """Return a sentence for each peer that cannot run here."""
    return list(_found()[1])


class _Unavailable(Exception):  # noqa: N818 - a finding, not an error
    """A missing requirement, named in a sentence."""


@cache
def _found() -> tuple[tuple[Peer, ...], tuple[str, ...]]:
    """Look for the peers: those found, and sentences on the others."""
    found: list[Peer] = []
    absent: list[str] = []
    searches = (_compiled, _pylinkage)
    assert len(searches) == PEERS
    for search in searches:
        try:
            found += search()
        except _Unavailable as reason:
            absent.append(str(reason))
    return tuple(found), tuple(absent)


def _remembering(prepare: Callable[[Floats], Call | None]) -> Callable[[Floats], Floats | None]:
    """Return a run that prepares a call once per array of angles, so that calls cost nothing else.

    Parameters
    ----------
    prepare : callable
        From angles to a call that solves them, None if it cannot.
    """
    met: Floats | None = None
    call: Call | None = None

    def run(phi: Floats) -> Floats | None:
        nonlocal met, call
        if phi is not met:
            met, call = phi, prepare(phi)
        return None if call is None else call()

    return run


def _spacing(phi: Floats) -> tuple[float, float] | None:
    """Return the first angle and the step if the angles are equally spaced, else None."""
    if not phi.size:
        return None
    start, end = float(phi[0]), float(phi[-1])
    step = (end - start) / (phi.size - 1) if phi.size > 1 else 0.0
    slack = 8.0 * np.finfo(np.float64).eps * max(abs(start), abs(end))
    even = start + step * np.arange(phi.size)
    return (start, step) if np.all(np.abs(phi - even) <= slack) else None


# --- compiled C ----------------------------------------------------------------------------------


def _compiled() -> list[Peer]:
    """Compile the C source and return its two functions."""
    library = _library()
    number, count, address = ctypes.c_double, ctypes.c_long, ctypes.c_void_p
    libm, table = library.fourbar_libm, library.fourbar_table
    libm.argtypes, libm.restype = [address, count, number, address], None
    table.argtypes, table.restype = [number, number, count, number, address], None

    def at_any(phi: Floats) -> Call:
        angles = np.ascontiguousarray(phi, dtype=np.float64)
        out = _touched(angles.size)
        asked = (_pointer(angles), angles.size, OMEGA, _pointer(out))

        def call() -> Floats:
            libm(*asked)
            return out

        return call

    def at_even(phi: Floats) -> Call | None:
        spacing = _spacing(phi)
        if spacing is None:
            return None
        out = _touched(phi.size)
        asked = (*spacing, phi.size, OMEGA, _pointer(out))

        def call() -> Floats:
            table(*asked)
            return out

        return call

    everything = tuple(range(ROWS))
    return [
        Peer(
            "C, libm",
            "all 20 rows: a scalar loop, sine and cosine of the C library",
            everything,
            _remembering(at_any),
        ),
        Peer(
            "C, table",
            "all 20 rows at equal steps: a vectorised loop, a table of angles and their addition",
            everything,
            _remembering(at_even),
        ),
    ]


def _library() -> ctypes.CDLL:
    """Compile the source into a temporary folder and load it."""
    compiler = next(filter(None, map(shutil.which, COMPILERS)), None)
    if compiler is None:
        raise _Unavailable(f"No C compiler was found ({', '.join(COMPILERS)}).")
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        target = Path(folder) / "fourbar.so"
        command = [compiler, *FLAGS, "-shared", "-fPIC", "-o", str(target), str(SOURCE), "-lm"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            said = (done.stderr.strip() or "no message").splitlines()[0]
            raise _Unavailable(f"{compiler} did not compile {SOURCE.name}: {said}")
        try:
            return ctypes.CDLL(str(target))
        except OSError as reason:
            raise _Unavailable(f"The compiled {SOURCE.name} was not loaded: {reason}") from reason


def _pointer(values: Floats) -> ctypes.c_void_p:
    """Return the address of an array's numbers; it keeps the array alive."""
    return values.ctypes.data_as(ctypes.c_void_p)


def _touched(n: int) -> Floats:
    """Return memory for a solution with every page written to, at no cost to the calls."""
    return np.full((ROWS, n), np.nan)


# --- pylinkage -----------------------------------------------------------------------------------


def _pylinkage() -> list[Peer]:
    """Return pylinkage's compiled simulation loop.

    It is `pylinkage.solver.simulate`, what `Linkage.step_fast` calls, on the arrays that
    `linkage_to_solver_data` makes of a linkage: "direct access to the solver" in its
    documentation. It steps the crank by equal angles from where it stands, and puts C at the
    intersection nearest to where C was.
    """
    lost: list[str] = []
    for name in ("pylinkage", "numba"):
        try:
            importlib.import_module(name)
        except ImportError:
            lost.append(name)
    if lost:
        raise _Unavailable(f"{' and '.join(lost)} cannot be imported: pylinkage is not compared.")
    try:
        peer = _stepping()
        peer.run(np.array([20.0, 21.0]))  # compiles
    except (ImportError, AttributeError, TypeError) as reason:
        raise _Unavailable(f"pylinkage is not the version known here (1.3): {reason}.") from reason
    return [peer]


def _stepping() -> Peer:
    """Return pylinkage's simulation loop on the four-bar."""
    components = importlib.import_module("pylinkage.components")
    actuators = importlib.import_module("pylinkage.actuators")
    dyads = importlib.import_module("pylinkage.dyads")
    simulation = importlib.import_module("pylinkage.simulation")
    solver = importlib.import_module("pylinkage.solver")
    simulate = solver.simulate

    def prepare(phi: Floats) -> Call | None:
        spacing = _spacing(phi)
        if spacing is None:
            return None
        start, step = map(math.radians, spacing)
        n = phi.size
        fixed_a = components.Ground(0.0, 0.0)
        fixed_d = components.Ground(FRAME, 0.0)
        crank = actuators.Crank(  # starts a step earlier: it moves, then returns its position
            fixed_a, radius=CRANK, angular_velocity=1.0, initial_angle=start - step
        )
        pair = dyads.RRRDyad(  # starts at the upper intersection, to the left of B -> D
            crank.output, fixed_d, distance1=COUPLER, distance2=ROCKER
        )
        linkage = simulation.Linkage([fixed_a, fixed_d, crank, pair])
        data = solver.linkage_to_solver_data(linkage)
        before = data.positions.copy()
        fixed = (
            data.constraints,
            data.joint_types,
            data.parent_indices,
            data.constraint_offsets,
            data.solve_order,
            n,
            step,
        )
        positions = data.positions

        def call() -> Floats:
            positions[:] = before  # the loop leaves them where it ended
            path = simulate(positions, *fixed)
            return cast("Floats", path.reshape(n, 8)[:, 4:].T)  # a view: x y of B and of C

        return call

    return Peer(
        "pylinkage, numba",
        "4 rows at equal steps, the points B and C only: a compiled loop, step by step",
        (0, 1, 6, 7),
        _remembering(prepare),
    )
