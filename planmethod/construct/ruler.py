"""Draughtsman who draws exactly and reads with a ruler (чертёжник с линейкой)."""

# no messages: mistakes in a program

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from msgspec import Struct, field

from planmethod.construct.arithmetic import Float64, Number


class RulerArithmetic(Float64, Struct, frozen=True):
    """Draughtsman who draws exactly and reads with a ruler (чертёжник с линейкой).

    Every length read on the drawing is rounded to the nearest ``ruler`` step, ties away from zero
    as a person reads; values computed from it propagate along the construction.

    Attributes
    ----------
    ruler : float, mm
        Step of the ruler (цена деления).
    enlargements : mapping of str to Number
        Enlargement of a length relative to its scale, by its name: it is read on an enlarged view
        or on a plan with its own scale, where the ruler's step is that many times finer.
    """

    ruler: float = 0.5
    enlargements: Mapping[str, Number] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not (math.isfinite(self.ruler) and self.ruler > 0):
            raise ValueError(f"ruler step must be positive, got {self.ruler}")

    def ruled(self, length: Number) -> Number:
        """Return the length rounded to the ruler step, keeping its sign."""
        return np.sign(length) * np.floor(np.abs(length) / self.ruler + 0.5) * self.ruler

    def read(self, out: str, length: Number) -> Number:
        """Return the length rounded to the ruler step, which is finer where it is enlarged."""
        times = self.enlargements.get(out)
        return self.ruled(length) if times is None else self.ruled(length * times) / times
