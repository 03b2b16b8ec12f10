"""How tidy placed labels are: what the size of letters is chosen by."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from planmethod.render.labels.candidates import crossed
from planmethod.render.labels.model import Placed

# How many leader lines that cross are as bad as
_BROKEN = 2  # a label that breaks thin lines
_OVER = 100  # a label over something


def crossed_leaders(placed: Sequence[Placed]) -> int:
    """Return how many pairs of leader lines cross."""
    leaders = [label.leader for label in placed if label.leader is not None]
    return crossed([np.asarray([(z.real, z.imag) for z in leader]) for leader in leaders])


def untidiness(placed: Sequence[Placed]) -> int:
    """Return what is to be least: crossed leader lines, and labels that are not free."""
    unfree = sum(0 if label.free else _BROKEN if label.ground else _OVER for label in placed)
    return unfree + crossed_leaders(placed)
