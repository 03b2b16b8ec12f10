"""Functions of the angle turned as Chebyshev polynomials, piece by piece (кусочные многочлены)."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.solved.reading import Reals

NODES = 16
"""Nodes of a piece, the roots of a Chebyshev polynomial: none lies on an edge of the piece."""

TOLERANCE = 1e-12
"""Last coefficients of an accepted piece, relative to the function's size."""

_LEVELS = 8  # times that a piece is halved at the most
_SAMPLES = 24  # parts of a piece among whose ends a root is looked for
_HALVINGS = 46

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
