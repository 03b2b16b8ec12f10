"""Limits of the shifts: undercut, pointed teeth, contact ratio, interference (блокирующий контур).

Each limit is a margin that is not negative where it is kept. The curves of the blocking contour are
where margins vanish; shifts are chosen among those that keep all of them.
"""

from __future__ import annotations

from enum import Enum

import numpy as np
from msgspec import Struct

from planmethod.gears.involute.sizes import Pair, Reals, ShiftAim

STEP = 0.01
"""Chosen shifts are multiples of it."""

LOW, HIGH = -1.0, 1.5
"""Between them shifts are looked for."""

_HALVINGS = 60
_SAME = 1e-9  # difference of equal specific slidings


class LimitKind(Enum):
    """The fault that a limit prevents (вид ограничения)."""

    UNDERCUT = "undercut"
    TIP = "tip"
    OVERLAP = "overlap"
    INTERFERENCE = "interference"
    TIPS = "tips"
    BASE = "base"


class ProfileShiftLimit(Struct, frozen=True):
    """One limit (ограничение).

    Attributes
    ----------
    kind : LimitKind
    wheel : int or None
        0 or 1; None for a limit of the pair.
    min_value : float
        Least thickness at the tip in modules, or least contact ratio.
    hard : bool
        Beyond it the pair does not work; other limits are advice.
    """

    kind: LimitKind
    wheel: int | None
    min_value: float = 0.0
    hard: bool = False

    def value(self, pair: Pair) -> Reals:
        """Return the value compared with the limit: x, s_a/m, ε_α, ρ_p, d_a/m."""
        match self.kind:
            case LimitKind.UNDERCUT:
                return np.asarray(pair.x[self.wheel])
            case LimitKind.TIP:
                return np.asarray(pair.s_na[self.wheel] / pair.m)
            case LimitKind.OVERLAP:
                return pair.epsilon
            case LimitKind.INTERFERENCE:
                return np.asarray(pair.rho_p[self.wheel])
            case LimitKind.TIPS:
                return pair.tips
            case LimitKind.BASE:
                return np.asarray(np.abs(pair.d_a[self.wheel]) / pair.m)

    def bound(self, pair: Pair) -> Reals:
        """Return the limit itself: x_min, the least s_a/m or ε_α, ρ_l, d_b/m."""
        match self.kind:
            case LimitKind.UNDERCUT:
                return np.asarray(pair.x_min[self.wheel])
            case LimitKind.INTERFERENCE:
                return np.asarray(pair.rho_l[self.wheel])
            case LimitKind.TIPS:
                return np.asarray(0.0)
            case LimitKind.BASE:
                return np.asarray(np.abs(pair.d_b[self.wheel]) / pair.m)
            case _:
                return np.asarray(self.min_value)

    def margin(self, pair: Pair) -> Reals:
        """Return the margin to the limit, positive where it is met; NaN where no pair exists."""
        return np.asarray(self.value(pair) - self.bound(pair))


def limits(tip: float, overlap: float, *, internal: bool = False) -> tuple[ProfileShiftLimit, ...]:
    """Return all limits: those without which the pair does not work, then those of good use.

    The tips of an internal pair must not meet outside the mesh; its ring has no undercut.
    """
    wheels = (0, 1)
    return (
        *((ProfileShiftLimit(LimitKind.TIPS, None, hard=True),) if internal else ()),
        *(ProfileShiftLimit(LimitKind.INTERFERENCE, k, hard=True) for k in wheels),
        *(ProfileShiftLimit(LimitKind.TIP, k, hard=True) for k in wheels),
        ProfileShiftLimit(LimitKind.OVERLAP, None, 1.0, hard=True),
        *(ProfileShiftLimit(LimitKind.UNDERCUT, k) for k in wheels[: 1 if internal else 2]),
        *(ProfileShiftLimit(LimitKind.TIP, k, tip) for k in wheels),
        ProfileShiftLimit(LimitKind.OVERLAP, None, overlap),
    )


BASES = tuple(ProfileShiftLimit(LimitKind.BASE, k, hard=True) for k in (0, 1))
"""Limits beyond which a tooth has no involute: they bound the contour, not a real pair."""


def meets_limits(pair: Pair, required: tuple[ProfileShiftLimit, ...]) -> Reals:
    """Return where all of some limits are met."""
    with np.errstate(all="ignore"):
        return np.asarray(np.all([one.margin(pair) >= 0 for one in required], axis=0))


def candidate_shifts(total: float | None, side: int = 1) -> Reals:
    """Return all shifts that are compared, shape (2, ...).

    With ``total``, only those of that sum; with ``side`` -1, of that difference x₂ − x₁.
    """
    row = np.round(np.arange(round(LOW / STEP), round(HIGH / STEP) + 1) * STEP, 9)
    return np.stack([row, total - side * row] if total is not None else np.meshgrid(row, row))


def choose(
    pair: Pair,
    required: tuple[ProfileShiftLimit, ...],
    total: float | None = None,
    aim: ShiftAim = ShiftAim.BLOCKING,
) -> tuple[float, float] | None:
    """Return the shifts that meet all limits and are the best for an aim.

    All multiples of `STEP` from `LOW` to `HIGH` are compared, so that nothing is missed. The best
    shifts have the least maximum of specific sliding at the lower points, or the greatest contact
    ratio. For equal sliding x₁ is a multiple and x₂ follows from it.

    Parameters
    ----------
    total : float, optional
        Sum of the shifts, x₂ − x₁ of an internal pair, where the centre distance is given; then
        only x₁ is a multiple; for equal sliding neither is.

    Returns
    -------
    (float, float) or None
        None where no shifts meet all limits.
    """
    x = candidate_shifts(total, pair.side)
    if aim is ShiftAim.SLIDING:
        x = _equal(pair, x)
    every = pair.shifted(x)
    with np.errstate(all="ignore"):
        worst = np.max(np.abs(every.theta_p), axis=0)
        if aim is ShiftAim.OVERLAP:
            worst = -every.epsilon
        worst = np.where(meets_limits(every, required), worst, np.inf)
    worst = np.where(np.isnan(worst), np.inf, worst)
    if not np.any(np.isfinite(worst)):
        return None
    best = np.unravel_index(int(np.argmin(worst)), worst.shape)
    return float(x[0][best]), float(x[1][best])


def _equal(pair: Pair, x: Reals) -> Reals:
    """Return the shifts of equal sliding between neighbours of a grid, shape (2, n).

    Along the first axis of the grid the difference of the slidings changes its sign there.
    """

    def sliding_difference(at: Reals) -> Reals:
        with np.errstate(all="ignore"):
            one, two = np.abs(pair.shifted(at).theta_p)
        return np.asarray(one - two)

    here = sliding_difference(x)
    between = here[1:] * here[:-1] <= 0  # of NaN it is not
    low, high = x[:, :-1][:, between], x[:, 1:][:, between]
    start = sliding_difference(low)
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        is_low = sliding_difference(middle) * start > 0
        low, high = np.where(is_low, middle, low), np.where(is_low, high, middle)
    found = (low + high) / 2
    return np.asarray(
        found[:, np.abs(sliding_difference(found)) < _SAME]
    )  # no jump through infinity
