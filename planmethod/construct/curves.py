"""Functions of the angle over a cycle: where they are zero or greatest, and as polynomials.

A function is either computed exactly at each place, or it is a `Piecewise` polynomial. A polynomial
also has a derivative and an integral, and finds its own roots by halving: they cost little there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

import numpy as np
import numpy.typing as npt
from msgspec import Struct

Reals = npt.NDArray[np.float64]

Function = Callable[[Reals], Reals]
"""From places, ndarray of shape (n,), to values of the same shape; NaN: there is none."""

_PARTS = 32
_ROUNDS = 11  # a quarter of a degree over 32^11 is less than the spacing of binary fractions
_TOP_ROUNDS = 6  # near its top a smooth function is flat: more rounds would follow its rounding
_VERTEX = 1 / 6  # share of the first bracket to both sides of a top where a parabola is laid


def crossings(values: Reals) -> npt.NDArray[np.intp]:
    """Return the indices k between which and k + 1 a row of values changes its sign.

    A zero counts with the value before it; a gap (NaN) is not a change.
    """
    there = np.flatnonzero(values)
    signs = np.sign(values[there])
    return np.asarray(there[1:][signs[1:] * signs[:-1] < 0.0] - 1)


def roots(function: Function, places: Reals) -> Reals:
    """Return where a function changes its sign between neighbours of some places, in order."""
    k = crossings(function(places))
    return roots_between(by_rows(function), places[k], places[k + 1])


def root(function: Function, low: float, high: float) -> float:
    """Return the place where a function changes its sign between two places."""
    return float(roots_between(by_rows(function), np.array([low]), np.array([high]))[0])


def roots_between(function: Function, low: Reals, high: Reals) -> Reals:
    """Return the places where a function changes its sign, each between two of different signs.

    NaN counts with the sign at ``low``: the change is at the edge of the function's domain.

    Parameters
    ----------
    function : callable
        From places, ndarray of shape (m, k), a row for each pair, to values of that shape.
    low, high : ndarray of shape (m,)
    """
    if not len(low):
        return low
    row, end = np.arange(len(low)), high
    sign = np.sign(function(high[:, np.newaxis]))
    for _ in range(_ROUNDS):
        wide = np.abs(high - low) > 4 * np.spacing(np.abs(high))
        if not wide.any():
            break
        places = np.linspace(low, high, _PARTS + 1, axis=-1)
        there = np.sign(function(places)) == sign
        k = np.where(there.any(axis=-1), np.maximum(np.argmax(there, axis=-1), 1), _PARTS)
        low, high = np.where(wide, [places[row, k - 1], places[row, k]], [low, high])
    one, two = np.abs(function(np.stack([low, high], axis=-1))).T
    return np.where(sign[:, 0] == 0.0, end, np.where(one <= two, low, high))


def by_rows(function: Function) -> Function:
    """Return a function that takes places of any shape, as `tops` and `roots_between` need it."""
    return lambda places: function(places.ravel()).reshape(places.shape)


def top(
    function: Function, low: float, high: float, *, samples: int = _PARTS
) -> tuple[float, float]:
    """Return the place and the size of the greatest value between two places.

    The interval is first divided into ``samples`` parts: enough that one of them holds the
    greatest.
    """
    at, size = tops(by_rows(function), np.array([low]), np.array([high]), samples=samples)
    return float(at[0]), float(size[0])


def tops(
    function: Function, low: Reals, high: Reals, *, samples: int = _PARTS
) -> tuple[Reals, Reals]:
    """Return the same for several pairs of places, which are processed together.

    Parameters
    ----------
    function : callable
        From places, ndarray of shape (m, k), a row for each pair, to values of that shape.
    low, high : ndarray of shape (m,)

    Returns
    -------
    places, sizes : ndarray of shape (m,)
    """
    row, vertex = np.arange(len(low)), _VERTEX * 2 * (high - low) / samples
    for parts in (samples, *[_PARTS] * (_TOP_ROUNDS - 1)):
        places = np.linspace(low, high, parts + 1, axis=-1)
        values = np.nan_to_num(function(places), nan=-np.inf)
        k = np.argmax(values, axis=-1)
        at, size = places[row, k], values[row, k]
        low, high = places[row, np.maximum(k - 1, 0)], places[row, np.minimum(k + 1, parts)]
    # Within rounding of its value the place of a smooth top is found from its surroundings.
    before, here, after = function(np.stack([at - vertex, at, at + vertex], axis=-1)).T
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = before - 2 * here + after
        off = np.where(bend < 0, vertex * (before - after) / (2 * bend), 0.0)
    inside = np.isfinite(off) & (np.abs(off) < vertex)
    moved = at + np.where(inside, off, 0.0)
    there = function(moved[:, np.newaxis])[:, 0]
    taken = inside & (there >= size - 1e-12)
    return np.where(taken, moved, at), np.where(taken, np.maximum(there, size), size)


NODES = 16
"""Nodes of a piece, the roots of a Chebyshev polynomial: none lies on an edge of the piece."""

TOLERANCE = 1e-12
"""Last coefficients of an accepted piece, relative to the function's size."""

_LEVELS = 8  # times that a piece is halved at the most
_HALVINGS = 46
_SAMPLES = 24  # parts of a piece among whose ends a root is looked for

_UNIT = np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES)
_FIT_MATRIX = np.cos(np.outer(np.arange(NODES), np.arccos(_UNIT))) * (2.0 / NODES)
_FIT_MATRIX[0] /= 2.0


class Piecewise(Struct, frozen=True):
    """Functions of one argument on joining pieces, with jumps and kinks at their edges only.

    Attributes
    ----------
    edges : ndarray of shape (m + 1,)
        Increasing.
    terms : ndarray of shape (c, m, k)
        Chebyshev coefficients of k functions on each piece.
    """

    edges: Reals
    terms: Reals

    def __call__(self, at: npt.ArrayLike) -> Reals:
        """Return the values, ndarray of shape (n, k); on an edge those of the piece after it."""
        x = np.asarray(at, dtype=float)
        piece = np.clip(np.searchsorted(self.edges, x, side="right") - 1, 0, len(self.edges) - 2)
        low, high = self.edges[piece], self.edges[piece + 1]
        u = ((2.0 * x - low - high) / (high - low))[:, np.newaxis]
        one = two = np.zeros((len(x), self.terms.shape[2]))
        for row in self.terms[:0:-1]:
            one, two = row[piece] + 2.0 * u * one - two, one
        return np.asarray(self.terms[0][piece] + u * one - two, dtype=float)

    def value(self, at: npt.ArrayLike) -> Reals:
        """Return the values of the first function, ndarray of shape (n,)."""
        return self(at)[:, 0]

    def mixed(self, weights: npt.ArrayLike) -> Piecewise:
        """Return one function: these with their weights, added up."""
        return Piecewise(self.edges, self.terms @ np.asarray(weights, dtype=float)[:, np.newaxis])

    def plus(self, number: float) -> Piecewise:
        """Return the functions with a number added."""
        terms = self.terms.copy()
        terms[0] += number
        return Piecewise(self.edges, terms)

    @property
    def slope(self) -> Piecewise:
        """The derivatives."""
        half = np.diff(self.edges)[:, np.newaxis] / 2.0
        return Piecewise(self.edges, np.polynomial.chebyshev.chebder(self.terms) / half)

    @property
    def integral(self) -> Piecewise:
        """The integrals from the first edge, continuous."""
        half = np.diff(self.edges)[:, np.newaxis] / 2.0
        terms = np.polynomial.chebyshev.chebint(self.terms, lbnd=-1) * half
        ends = np.cumsum(terms.sum(axis=0), axis=0)  # every Chebyshev polynomial is 1 at 1
        terms[0, 1:] += ends[:-1]
        return Piecewise(self.edges, terms)

    @property
    def samples(self) -> Reals:
        """Arguments that come near to every feature of every piece, its edges among them."""
        parts = np.arange(_SAMPLES) / _SAMPLES
        inside = self.edges[:-1, np.newaxis] + np.diff(self.edges)[:, np.newaxis] * parts
        return np.append(inside.ravel(), self.edges[-1])

    def roots(self, level: float = 0.0) -> Reals:
        """Return the places where the first function passes a level, in order."""
        x = self.samples
        above = self.value(x) > level
        turns = np.flatnonzero(above[1:] != above[:-1])
        low, high, rises = x[turns], x[turns + 1], above[turns + 1]
        for _ in range(_HALVINGS if turns.size else 0):
            middle = (low + high) / 2.0
            after = (self.value(middle) > level) == rises
            low, high = np.where(after, low, middle), np.where(after, middle, high)
        return (low + high) / 2.0

    def peak(self) -> tuple[float, float]:
        """Return where the first function, a continuous one, is largest, and its value there."""
        x = self.samples
        best = int(np.argmax(self.value(x)))
        found, slope = [float(x[best])], self.slope.terms[:, :, 0]
        for piece in {max(best - 1, 0) // _SAMPLES, min(best // _SAMPLES, slope.shape[1] - 1)}:
            low, high = self.edges[piece : piece + 2].tolist()
            flat = np.polynomial.chebyshev.chebroots(slope[:, piece])
            real = flat[(np.abs(flat.imag) < 1e-9) & (np.abs(flat.real) < 1.0)].real
            found += ((low + high) / 2.0 + (high - low) / 2.0 * real).tolist()
        values = self.value(found)
        largest = int(np.argmax(values))
        return found[largest], float(values[largest])


def nodes(edges: Reals) -> Reals:
    """Return the nodes of every piece, ndarray of shape (m, NODES)."""
    low, high = edges[:-1, np.newaxis], edges[1:, np.newaxis]
    return (low + high) / 2.0 + (high - low) / 2.0 * _UNIT


def joined(curves: Iterable[Piecewise]) -> Piecewise:
    """Return the functions of several curves of the same pieces as one."""
    several = list(curves)
    degrees = max(len(one.terms) for one in several)
    padded = [np.pad(one.terms, ((0, degrees - len(one.terms)), (0, 0), (0, 0))) for one in several]
    return Piecewise(several[0].edges, np.concatenate(padded, axis=2))


def resolved(read: Callable[[Reals], Reals], edges: Reals, scale: Reals | None = None) -> Piecewise:
    """Return functions as polynomials, on pieces that are halved until they hold all digits.

    Parameters
    ----------
    read : callable
        Maps arguments of shape (n,) to values of shape (n, k).
    edges : ndarray of shape (m + 1,)
        Places of jumps, kinks and other cuts of the functions.
    scale : ndarray of shape (k,), optional
        Size of each function. Default: its own largest value.
    """
    todo = np.column_stack((edges[:-1], edges[1:]))
    done: list[tuple[float, float, Reals]] = []
    size = scale
    for level in range(_LEVELS + 1):
        at = np.concatenate([nodes(pair) for pair in todo])
        values = read(at.ravel()).reshape(*at.shape, -1)
        terms = np.einsum("cj,mjk->cmk", _FIT_MATRIX, values)
        if size is None:
            largest = np.max(np.abs(values), axis=(0, 1))
            size = np.where(largest > 0.0, largest, 1.0)
        tail = np.max(np.abs(terms[-2:]) / size, axis=(0, 2))
        rough = (tail > TOLERANCE) & (level < _LEVELS)
        done += [
            (low, high, terms[:, k]) for k, (low, high) in enumerate(todo.tolist()) if not rough[k]
        ]
        if not rough.any():
            break
        low, high = todo[rough].T
        middle = (low + high) / 2.0
        todo = np.concatenate((np.column_stack((low, middle)), np.column_stack((middle, high))))
    done.sort(key=lambda piece: piece[0])
    whole = np.array([*(piece[0] for piece in done), done[-1][1]])
    return Piecewise(whole, np.stack([piece[2] for piece in done], axis=1))


_Value = TypeVar("_Value", float, Reals)


def hermite(one: _Value, two: _Value, slope_1: _Value, slope_2: _Value, fraction: _Value) -> _Value:
    """Return a cubic with given ends and slopes, the step being 1."""
    rest = 1.0 - fraction
    ends = one * rest * rest * (1.0 + 2.0 * fraction) + two * fraction * fraction * (
        3.0 - 2.0 * fraction
    )
    return ends + slope_1 * fraction * rest * rest - slope_2 * fraction * fraction * rest


def turning_points(one: float, two: float, slope_1: float, slope_2: float) -> list[float]:
    """Return the end of a step, and where a cubic turns within it."""
    if slope_1 * slope_2 >= 0.0:
        return [1.0]
    a = 3.0 * (slope_1 + slope_2) - 6.0 * (two - one)
    b = 6.0 * (two - one) - 4.0 * slope_1 - 2.0 * slope_2
    found = np.roots([a, b, slope_1]) if a else np.array([-slope_1 / b])
    return [1.0, *(float(x.real) for x in found if abs(x.imag) < 1e-12 and 0.0 < x.real < 1.0)]
