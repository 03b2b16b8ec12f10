"""Sigmas of numbers by their slopes, and half widths of random samples (разброс)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from planmethod.construct.dual import Dual, common_slopes
from planmethod.solved.errors.drawing import DrawnKind, DrawnQuantity
from planmethod.solved.reading import Reals

CENTRAL = (0.158655253931457, 0.841344746068543)
"""Quantiles of one sigma either side of the mean of a normal error."""

NOISE = 1e-12
"""Variance, relative to the largest, below which it is the rounding of a zero."""


def sigma_of(value: Dual) -> Reals:
    """Return the sigma of a number in every position."""
    # All causes, those that change nothing too, one after another: `sum` would add up a position
    # alone in another order than one of many.
    slope = value.slope
    sigma = 0.0 if slope is None else np.sqrt(np.add.accumulate(slope**2)[-1])
    return np.array(np.broadcast_to(sigma, value.value.shape), dtype=float)


def covariance_of(values: Sequence[Dual]) -> Reals:
    """Return how numbers err together, x and y of each place: shape (k, k, n)."""
    slopes, _ = common_slopes(*values)
    shape = np.broadcast_shapes((1, len(values[0].value)), *map(np.shape, slopes))
    rows = [
        np.broadcast_to(side, shape)
        for slope, value in zip(slopes, values, strict=True)
        for side in ((np.real(slope), np.imag(slope)) if np.iscomplexobj(value.value) else (slope,))
    ]
    products = np.array(rows)[:, None] * np.array(rows)[None]
    return np.asarray(np.add.accumulate(products, axis=2)[:, :, -1], dtype=float)


def root_of(spread: Reals) -> Reals:
    """Return the symmetric square roots of covariance matrices, shape (n, k, k).

    Of all roots it alone is the same whatever the signs of the eigenvectors are, and their turn
    where eigenvalues are equal: the last bit decides both, and the drawings of a lattice that are
    made with them, and their sigma by as much as 7 %.
    """
    size, turned = np.linalg.eigh(spread)
    size = np.where(size > NOISE * size[:, -1:], size, 0.0)
    return np.asarray((turned * np.sqrt(size)[:, None, :]) @ np.swapaxes(turned, -1, -2))


def half_widths(item: DrawnQuantity, rows: Reals) -> Reals:
    """Return `half_width` of every row; rows whose values all exist are processed together."""
    if not np.isfinite(rows).all():
        return np.array([half_width(item, row) for row in rows])
    if item.kind is DrawnKind.DIRECTION:
        rows = _unwound(rows)
    # Seven figures are sorted faster than sixteen, and whole rows than `np.quantile` parts them.
    ordered = np.sort(rows.astype(np.float32), axis=1)
    low, high = (_quantile(ordered, share) for share in CENTRAL)
    return (high - low) / 2


def _quantile(ordered: npt.NDArray[np.float32], fraction: float) -> Reals:
    """Return the quantile of every row."""
    k, part = divmod(fraction * (ordered.shape[1] - 1), 1.0)
    low, high = ordered[:, int(k)], ordered[:, int(k) + 1]
    return np.asarray(low + part * (high - low), dtype=float)


def half_width(item: DrawnQuantity, values: Reals) -> float:
    """Return half the interval of the middle 68 % of the random values that exist."""
    able = values[np.isfinite(values)]
    if not able.size:
        return float("nan")
    if item.kind is DrawnKind.DIRECTION:
        able = _unwound(able)
    low, high = np.quantile(able, CENTRAL)
    return float(high - low) / 2


def _unwound(degrees: Reals) -> Reals:
    """Return directions from their mean one, in (-180, 180]: those about 180 lie together."""
    ways = np.radians(degrees).astype(np.float32)
    across, along = (f(ways).sum(axis=-1, keepdims=True) for f in (np.sin, np.cos))
    off = degrees - np.degrees(np.arctan2(across, along))
    return np.asarray(off - 360.0 * np.rint(off / 360.0), dtype=float)
