"""Assembly modes of the groups of a mechanism (способы сборки групп)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from msgspec import Struct

Reals: TypeAlias = npt.NDArray[np.float64]


class TrackedAssembly(Struct, frozen=True):
    """Assembly of a triad, tracked from a chosen position (сборка группы III класса).

    No formula gives it: it is continued from one position to the next. Interpolation between two
    tracked positions is a good enough start for Newton's method.

    Attributes
    ----------
    places : tuple of float
        Positions of the driver, rising, degrees or m.
    x, y : tuple of float
        Coordinates of the base link's origin, m.
    turn : tuple of float
        Direction of its axis, degrees.
    period : float
        Period of the driver's motion after which the assembly repeats; 0 if it does not. Outside
        the positions there is no such assembly.
    """

    places: tuple[float, ...] = (0.0,)
    x: tuple[float, ...] = (math.nan,)
    y: tuple[float, ...] = (math.nan,)
    turn: tuple[float, ...] = (math.nan,)
    period: float = 0.0

    def at(self, coordinate: str, positions: Reals) -> Reals:
        """Return ``x``, ``y`` or ``turn``, shape (n,); NaN where there is no such assembly."""
        low, high = self.places[0], self.places[-1]
        here = np.asarray(positions, dtype=float)
        if self.period:
            here = low + np.mod(here - low, self.period)
        found = np.interp(here, self.places, getattr(self, coordinate))
        return np.where((here < low) | (here > high), np.nan, found)


class Start(Struct, frozen=True):
    """One of the numbers that locate an assembly (``x``, ``y`` or ``turn``)."""

    tracked: TrackedAssembly
    coordinate: str

    @property
    def values(self) -> tuple[float, ...]:
        """Values in the tracked positions."""
        found: tuple[float, ...] = getattr(self.tracked, self.coordinate)
        return found

    def branch(self, positions: Reals) -> Reals:
        """Return the value in some positions of the driver, m or degrees."""
        return self.tracked.at(self.coordinate, positions)


class AssemblyMode(Struct, frozen=True):
    """Assembly mode of a group: which of its two ways it closes (способ сборки).

    Attributes
    ----------
    side : int
        +1 or -1, in all positions unless it changes.
    parallel : bool
        The group closes a parallelogram, on no side of its line of centres for good.
    start : float
        Driver position that ``side`` belongs to, degrees or m.
    changes : tuple of float
        Change points: driver positions in which a motion that goes on smoothly changes sides.
    period : float
        After which the changes come again: 360 of a crank; of a slider out of all reach.
    tracked : TrackedAssembly
        Of a triad, the assembly that is meant; ``other_places`` are the places of ``point`` in the
        rest, m, at ``start``.
    third : int
        Of a triad, the leg whose line does not go through the special point that is used.
    only_at : tuple of float
        The only driver positions in which the mode is known, because both modes coincide there;
        empty if it is known in all.
    """

    side: int = 1
    parallel: bool = False
    start: float = 0.0
    changes: tuple[float, ...] = ()
    period: float = 1e12
    tracked: TrackedAssembly = TrackedAssembly()
    third: int = 2
    other_places: tuple[complex, ...] = ()
    point: str = ""
    only_at: tuple[float, ...] = ()

    def branch(self, positions: Reals) -> Reals:
        """Return +1 where the side is the first one, else -1; it depends on the position alone."""
        passed = np.zeros(np.shape(positions))
        for change in self.changes:
            for sign, place in ((1, positions), (-1, np.asarray(self.start))):
                passed += sign * np.floor((place - change) / self.period)
        return np.where(passed % 2 == 0, 1.0, -1.0)


Choice = Mapping[tuple[str, ...], AssemblyMode]


def assembly_period(choice: Choice, turn: float) -> float:
    """Return the degrees of the driver after which all groups close as before.

    A group that passes an odd number of change points in its own period is then in its other mode,
    and in the first one after two periods. Infinite if a group never closes as before.

    Parameters
    ----------
    turn : float, degrees
        Period of the driver itself.
    """
    found = 1
    for one in choice.values():
        period = turn
        if one.changes:
            period = one.period * (1 + len(one.changes) % 2)
        if one.tracked != AssemblyMode().tracked:
            period = one.tracked.period
        if not period:
            return math.inf
        found = math.lcm(found, max(round(period / turn), 1))
    return turn * found


"""Assembly mode of each group that has two, by its links."""
