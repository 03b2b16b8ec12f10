"""One reading of a program in every position: points and numbers as columns; the driver."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.arithmetic import Arithmetic, Number
from planmethod.construct.evaluate import Trace, extend_trace
from planmethod.construct.steps import LineName, Name, PointName, Step
from planmethod.problem.model import CamDrive, Drive, LawPiece, OtherDrive

Complexes = npt.NDArray[np.complex128]
Reals = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]
Result = TypeVar("Result")
Arguments = ParamSpec("Arguments")
Memory = TypeVar("Memory", bound="Memoizing")


Column = TypeVar("Column", bound=npt.NDArray[Any])


def fixed(values: Column) -> Column:
    """Return a read-only array: results are kept and shared."""
    if values.flags.writeable:
        values = values.view()
        values.flags.writeable = False
    return values


class Reading(Struct, frozen=True):
    """A program read in one arithmetic (прочтение программы).

    Attributes
    ----------
    trace : Trace
        Values of every step, a single one if it is the same in all positions.
    count : int
        Positions.
    """

    trace: Trace
    count: int

    @property
    def value(self) -> Mapping[Name, Number]:
        """Values of the steps as the arithmetic has them."""
        return self.trace.value

    def point(self, name: Name) -> Complexes:
        """Return a point, mm (at unit scales m, m/s, m/s², N), ndarray of shape (n,)."""
        return self._column(np.asarray(self.value[name], dtype=complex))

    def number(self, name: Name) -> Reals:
        """Return a number in its unit, ndarray of shape (n,)."""
        return self._column(np.asarray(self.value[name], dtype=float))

    def _column(self, value: npt.NDArray[Any]) -> npt.NDArray[Any]:
        shape = (self.count,)
        return fixed(value) if value.shape == shape else np.broadcast_to(value, shape)

    def vector(self, tail: PointName, head: PointName) -> Complexes:
        """Return a segment as a vector, ndarray of shape (n,)."""
        return np.asarray(self.point(head) - self.point(tail), dtype=complex)

    def line_vector(self, line: LineName) -> Complexes:
        """Return a vector along a line, ndarray of shape (n,)."""
        along = np.asarray(self.value[line][1], dtype=complex)
        return np.broadcast_to(along, (self.count,))

    def origin(self, line: LineName) -> Complexes:
        """Return a point of a line, mm, ndarray of shape (n,)."""
        through = np.asarray(self.value[line][0], dtype=complex)
        return np.broadcast_to(through, (self.count,))

    def has(self, name: Name) -> Flags:
        """Return where there is a value, and no division by zero; ndarray of shape (n,)."""
        value = self.value[name]
        parts = value if isinstance(value, tuple) else (value,)
        there = [np.isfinite(np.asarray(part, dtype=complex)) for part in parts]
        return np.broadcast_to(np.all(np.broadcast_arrays(*there), axis=0), (self.count,))

    def part(self, chosen: slice) -> Reading:
        """Return the reading of some of the positions."""
        trace = self.trace
        value, margin = _Part(trace.value, chosen), _Part(trace.margin, chosen)
        return Reading(Trace(value, margin), len(range(self.count)[chosen]))

    def extend(
        self, steps: Iterable[Step], data: Mapping[str, Number], arithmetic: Arithmetic
    ) -> Reading:
        """Return a reading with further steps, read in the same arithmetic."""
        return Reading(extend_trace(self.trace, steps, data, arithmetic), self.count)


class _Part(Mapping[Name, Number]):
    """Values of some of the positions, cut out on request."""

    def __init__(self, values: Mapping[Name, Number], chosen: slice) -> None:
        self._whole, self._chosen = values, chosen
        self._known: dict[Name, Number] = {}

    def __getitem__(self, name: Name) -> Number:
        if name not in self._known:
            self._known[name] = _part(self._whole[name], self._chosen)
        return self._known[name]

    def __iter__(self) -> Iterator[Name]:
        return iter(self._whole)

    def __len__(self) -> int:
        return len(self._whole)


def _part(value: Number, chosen: slice) -> Number:
    """Return a value of some positions; of a line both of its."""
    if isinstance(value, tuple):
        return tuple(_part(one, chosen) for one in value)
    return value[chosen] if np.ndim(value) else value


class Memoizing:
    """Mixin that memoizes derived results for each instance (память результатов)."""

    def __init__(self) -> None:
        self._worked_out: dict[Any, Any] = {}

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for another process: memoized results are computed again there."""
        return vars(self) | {"_worked_out": {}}

    def compute_once(
        self, function: Callable[..., Result], *arguments: Any, **named: Any
    ) -> Result:
        """Return the result of a function of this object, computed at the first call."""
        key = (function, arguments, *named.items())
        if key not in self._worked_out:
            self._worked_out[key] = function(self, *arguments, **named)
        made: Result = self._worked_out[key]
        return made


def memoized(
    function: Callable[Concatenate[Memory, Arguments], Result],
) -> Callable[Concatenate[Memory, Arguments], Result]:
    """Memoize a function's result on its first argument, for the lifetime of that object."""

    @wraps(function)
    def remember(of: Memory, /, *arguments: Arguments.args, **named: Arguments.kwargs) -> Result:
        return of.compute_once(function, *arguments, **named)

    return remember


_JUMP_TOLERANCE = 1e-12 * 2 * np.pi  # rad before a jump that are after it: rounding of its angle
_NEAR_DEG = 1e-3
_ZERO_RATE = 1e-14  # of the stroke: rounding error of the angle in a rate that is zero


def driven(drive: Drive, positions: Reals) -> tuple[Reals, float | Reals, float | Reals]:
    """Return place, rate and acceleration of the driving link.

    Parameters
    ----------
    positions : ndarray of shape (n,)
        Of the driver: what its link has itself, or angles of the cam, degrees.

    Returns
    -------
    place : ndarray of shape (n,)
        Degrees, or m.
    rate, acceleration : float or ndarray of shape (n,)
        1/s and 1/s², or m/s and m/s²: of each position where a cam's follower drives.
    """
    if drive.cam_drive is None:
        return positions, drive.rate, drive.acceleration
    way, first, second = follower_motion(drive.cam_drive, positions)
    place = drive.cam_drive.lowest + (np.degrees(way) if drive.cam_drive.turns else way)
    return place, first * drive.rate, second * drive.rate**2 + first * drive.acceleration


def other_place(drive: Drive, follower: OtherDrive, positions: Reals) -> Reals:
    """Return the place of another driving link while the first is in given positions.

    In the positions of the file, and in those where rules of assembly hold, it is where these have
    it. Otherwise both move evenly from their first positions.

    Returns
    -------
    ndarray of shape (n,)
        Degrees, or m.
    """
    listed, own = np.asarray(drive.positions), np.asarray(follower.positions)
    if len(own) == len(listed) > 1 and np.array_equal(positions, listed):
        return own  # also where the first stands while this one moves
    if follower.assembly_positions:
        listed = np.append(listed, drive.assembly_positions)
        own = np.append(own, follower.assembly_positions)
    way = (positions - listed[0]) * (np.pi / 180.0 if drive.is_crank else 1.0)
    time = way / drive.rate if drive.rate else np.zeros(positions.shape)
    moved = own[0] + follower.rate * time * (1.0 if follower.pivot is None else 180.0 / np.pi)
    if len(own) < 2 or len(own) != len(listed):
        return np.asarray(moved)
    off = np.abs(positions[:, np.newaxis] - listed)
    nearest = np.argmin(off, axis=1)
    return np.asarray(np.where(off.min(axis=1) < 1e-9, own[nearest], moved))


def follower_motion(cam: CamDrive, positions: Reals) -> Reals:
    """Return way, v_q and a_q of a follower, m or rad, shape (3, n); after a jump."""
    turned = np.radians(positions) % (2 * np.pi)
    starts = np.array([piece.start for piece in cam.pieces])
    which = np.searchsorted(starts, turned + _JUMP_TOLERANCE, side="right") - 1
    found = np.empty((3, *turned.shape))
    for k in np.unique(which):
        here = which == k
        found[:, here] = _on(cam.pieces[k], turned[here] - starts[k])
    size = max(abs(piece.powers[0]) + abs(piece.size) for piece in cam.pieces)
    found[1, np.abs(found[1]) < _ZERO_RATE * size] = 0.0
    return found


def _on(piece: LawPiece, x: Reals) -> Reals:
    """Return the way on a piece and both its derivatives, shape (3, n)."""
    power = np.polynomial.Polynomial(piece.powers)
    turn = piece.rate * x + piece.phase
    wave = piece.size * np.array(
        [np.sin(turn), piece.rate * np.cos(turn), -(piece.rate**2) * np.sin(turn)]
    )
    return np.asarray(wave + np.array([power(x), power.deriv()(x), power.deriv(2)(x)]))


def near_piece(drive: Drive, position: float) -> float:
    """Return the start of a piece of the cam's law that a position is at but for rounding, degrees.

    A follower that has rested leaves its place so slowly that the root of its rate is rough.
    """
    for piece in drive.cam_drive.pieces if drive.cam_drive is not None else ():
        start = float(np.degrees(piece.start))
        away = (position - start + 180.0) % 360.0 - 180.0
        if abs(away) < _NEAR_DEG:
            return position - away if start else round((position - away) / 360.0) * 360.0
    return position
