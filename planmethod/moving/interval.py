"""Drawn part of a motion: the interval, its curve, the numbered instants."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from planmethod.construct.scale import series_near
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.moving.model import PointProblem
from planmethod.moving.motion import Motion, Undefined, move
from planmethod.moving.series import Reals

Complexes: TypeAlias = NDArray[np.complexfloating[Any, Any]]

DENSE = 4000
"""Number of sampled moments of the interval."""

BEND = np.radians(2.0)
"""Turn of the tangent between two points of a drawn curve."""

LEAST, MOST = 300, 1500
"""Points of a drawn curve."""

GREW = 6.0
"""Maximum ratio of velocity and acceleration to their means in an automatic interval."""

MAX_EXTENT_RATIO = 4.0
"""Extent of a curve, in usual extents, beyond which it is cut: it has a pole there."""

CORNER = np.radians(40.0)
"""Turn between two chords of a drawn curve from which it has a corner there: a cusp."""

MARKS = 10
"""Parts that an interval is divided into by numbered instants."""

MAX_MARKS = 25
MAX_SHOWN_MOMENTS = 3
"""Most moments of the file that have their vectors drawn."""


class DrawnInterval(Struct, frozen=True, eq=False):
    """The drawn part of a motion (показанный участок).

    Attributes
    ----------
    interval : (float, float), s
    path : Motion
        Moments along the drawn curves.
    marks : Motion
        The numbered instants; those of the file are among them, unless they are very many.
    shown : tuple of int
        Numbers of the instants that have vectors drawn; the first of them is explained in full.
    """

    interval: tuple[float, float]
    path: Motion
    marks: Motion
    shown: tuple[int, ...]

    def curves(self, x: str, y: str) -> Iterator[Complexes]:
        """Yield the smooth parts of a curve, SI: it breaks at poles and at corners."""
        places = places_of(self.path, x, y)
        places = np.where(self._is_undrawn(x, y), np.nan, places)
        for part in np.split(places, np.flatnonzero(np.isnan(places))):
            part = part[~np.isnan(part)]
            steps = np.diff(part)
            turns = np.abs(np.angle(steps[1:] * np.conj(steps[:-1])))
            ends = [0, *(np.flatnonzero(turns > CORNER) + 1), len(part) - 1]
            for start, end in pairwise(ends):
                if end > start:
                    yield part[start : end + 1]

    def numbered(self, x: str, y: str) -> Complexes:
        """Return the numbered instants on a curve, SI; NaN where it is cut."""
        places = places_of(self.marks, x, y)
        middle, reach = self._drawn_region(x, y)
        return np.where(np.abs(places - middle) > reach, np.nan, places)

    def unbroken(self, x: str, y: str, first: int, last: int) -> bool:
        """Return whether a curve runs without a break between two numbered instants."""
        start, end = (self.marks.columns["t"][k] for k in (first, last))
        times = self.path.columns["t"]
        return not self._is_undrawn(x, y)[(start <= times) & (times <= end)].any()

    def _is_undrawn(self, x: str, y: str) -> NDArray[np.bool_]:
        """Return where along the path a curve is not drawn: undefined, or near a pole."""
        places = places_of(self.path, x, y)
        middle, reach = self._drawn_region(x, y)
        lost: NDArray[np.bool_] = ~(np.abs(places - middle) <= reach)
        return lost

    def _drawn_region(self, x: str, y: str) -> tuple[complex, float]:
        """Return the middle of a curve, and the distance from it to which it is drawn, SI."""
        places = places_of(self.path, x, y)
        there = places[~np.isnan(places)]
        if not len(there):
            return 0j, 0.0
        middle = complex(np.median(there.real), np.median(there.imag))
        return middle, MAX_EXTENT_RATIO * float(np.percentile(np.abs(there - middle), 75))


def places_of(motion: Motion, x: str, y: str) -> Complexes:
    """Return two columns of a motion as complex numbers, SI."""
    found: Complexes = motion.columns[x] + 1j * motion.columns[y]
    return found


def drawn_interval(problem: PointProblem) -> DrawnInterval:
    """Return the part of a motion that is drawn.

    The file's ``show``, or from its first to its last moment; about a single moment an interval in
    which the velocity changes by about itself, within which everything exists.

    Raises
    ------
    ProblemError
        The point is nowhere in the interval.
    """
    interval = problem.show or _interval(problem)
    dense = at(problem, np.linspace(*interval, DENSE + 1))
    if np.isnan(dense.columns["x"]).all():
        phrase = translate(
            "the point is nowhere from t = {:g} s to {:g} s", interval[0], interval[1]
        )
        hint = "Give an interval in which the formulas have values: show = [0, 1]."
        raise ProblemError(problem.name, [Fault("point.show", phrase, hint)])
    ways = [places_of(dense, f"{plan}x", f"{plan}y") for plan in "va"]
    turned = max(map(_total_turning, [*ways, np.diff(ways[1])]))
    count = int(np.clip(turned / BEND, LEAST, MOST))
    numbered = _marks(problem, interval)
    grid = np.linspace(*interval, count + 1)
    apart = np.min(np.abs(grid[:, None] - numbered[None, :]), axis=1, initial=np.inf)
    times = np.sort(np.concatenate([numbered, grid[apart > 0.1 * (grid[1] - grid[0])]]))
    marks = at(problem, numbered)
    return DrawnInterval(interval, at(problem, times), marks, _shown_instants(problem, marks))


def _total_turning(directions: Complexes) -> float:
    """Return the total turning of a direction, radians; a cusp or a break adds nothing."""
    directions = directions[~np.isnan(directions)]
    turns = np.abs(np.angle(directions[1:] * np.conj(directions[:-1])))
    return float(np.sum(turns[turns < CORNER]))


def at(problem: PointProblem, times: Reals) -> Motion:
    """Return the motion at other moments than the file's."""
    told = dict(zip(problem.times, problem.blur, strict=True))
    moments = tuple(float(t) for t in times)
    return move(replace(problem, times=moments, blur=tuple(told.get(t, 0.0) for t in moments)))


def _marks(problem: PointProblem, interval: tuple[float, float]) -> Reals:
    """Return the numbered instants: a row of the file's, or round ones with the file's."""
    own = np.unique([t for t in problem.times if interval[0] <= t <= interval[1]])
    if len(own) > MAX_SHOWN_MOMENTS:
        return own[:: -(-len(own) // MAX_MARKS)]
    step = series_near((interval[1] - interval[0]) / MARKS, up=True)
    slack = 1e-6 * step
    first, last = np.ceil((interval[0] - slack) / step), np.floor((interval[1] + slack) / step)
    round_ones = np.array([float(f"{k * step:.12g}") + 0.0 for k in np.arange(first, last + 1)])
    apart = [t for t in round_ones if not len(own) or np.min(np.abs(own - t)) > 0.2 * step]
    return np.sort(np.concatenate([own, apart]))


def _shown_instants(problem: PointProblem, marks: Motion) -> tuple[int, ...]:
    """Return the instants that have vectors: the file's, of a long row one in the middle of it."""
    times = marks.columns["t"]
    if len(set(problem.times)) <= MAX_SHOWN_MOMENTS:
        found = [k for t in problem.times for k in np.flatnonzero(times == t)]
        return tuple(dict.fromkeys(int(k) for k in found))
    whole = [k for k, why in enumerate(marks.reasons) if why is None]
    some = whole or [k for k, why in enumerate(marks.reasons) if why is not Undefined.POSITION]
    return (some[len(some) // 3],) if some else ()


def _interval(problem: PointProblem) -> tuple[float, float]:
    """Choose the interval that is drawn."""
    low, high = min(problem.times), max(problem.times)
    if high > low:
        return low, high
    here = {name: float(column[0]) for name, column in move(problem).columns.items()}
    v, a = here["v"], here["a"]
    reach = 1.0
    if v > 0 and a > 0:
        reach = series_near(float(np.clip(v / a, 1e-9, 1e9)), up=False, series=(1.0, 2.0, 5.0))
    if (omega := abs(here.get("omega", 0.0))) > 0:  # a wheel: about as far as it turns by a half
        reach = series_near(float(np.clip(2.5 / omega, 1e-9, 1e9)), up=False, series=(1, 2, 5))
    shortest = max(1e-6 * reach, 1e-9 * abs(low))
    while reach > shortest and not _is_mild(problem, low - reach, low + reach):
        reach = series_near(0.99 * reach, up=False, series=(1.0, 2.0, 5.0))
    reach = reach if reach > shortest else 1.0
    return float(f"{low - reach:.12g}"), float(f"{low + reach:.12g}")


def _is_mild(problem: PointProblem, start: float, end: float) -> bool:
    """Return whether everything exists in an interval, and nothing grows out of all proportion."""
    columns = at(problem, np.linspace(start, end, 401)).columns
    for name in ("v", "a"):
        values = columns[name]
        missing = int(np.isnan(values).sum())
        if missing > 2 or np.nanmax(values, initial=0.0) > GREW * np.nanmean(values):
            return False
    return True
