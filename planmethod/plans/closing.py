"""Which way the groups of a mechanism close (способы сборки групп)."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt
from msgspec import Struct


class Closing(Struct, frozen=True):
    """In which of its two ways a group closes (способ сборки).

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
    turn : float
        After which the changes come again: 360 of a crank; of a slider out of all reach.
    """

    side: int = 1
    parallel: bool = False
    start: float = 0.0
    changes: tuple[float, ...] = ()
    turn: float = 1e12

    def branch(self, positions: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Return +1 where the side is the first one, else -1; it depends on the position alone."""
        passed = np.zeros(np.shape(positions))
        for change in self.changes:
            for sign, place in ((1, positions), (-1, np.asarray(self.start))):
                passed += sign * np.floor((place - change) / self.turn)
        return np.where(passed % 2 == 0, 1.0, -1.0)


Choice = Mapping[tuple[str, ...], Closing]
"""Closing of each group that has two, by its links."""
