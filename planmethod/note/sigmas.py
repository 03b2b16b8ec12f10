"""Drafting errors as they are written: digits of a sigma, the mark of those found by draws."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from planmethod.note.numbers import significant

if TYPE_CHECKING:
    from planmethod.plans.drafting import Drafting

DRAWN = "*"
"""Mark of a sigma that was found by random draws, first order failing there."""

TWO_DIGITS = 2.95
"""Leading digits of an error up to which it has two significant digits, beyond them one."""


def _place(sigma: float) -> int:
    """Return the power of ten of the last digit that an error is written with."""
    power = math.floor(math.log10(sigma))
    return power - 1 if sigma / 10.0**power < TWO_DIGITS else power


def _plain(sigma: float) -> bool:
    """Tell whether an error is written without a power of ten."""
    return math.isfinite(sigma) and 1e-6 <= sigma < 1e6


def sigma_text(sigma: float) -> str:
    """Return an error with a decimal point: two digits when it begins with 1 or 2, else one.

    >>> [sigma_text(s) for s in (0.0881, 0.1416, 17.73, 430.0, 0.0)]
    ['0.09', '0.14', '18', '400', '0']
    """
    if sigma == 0.0 or not _plain(sigma):
        return significant(sigma, 2)
    place = _place(sigma)
    return f"{round(sigma, -place):.{max(0, -place)}f}"


def rounded_to(value: float, sigma: float) -> str:
    """Return a value up to the last digit of its error; to four digits when it has none.

    >>> rounded_to(3.9251, 0.0881), rounded_to(1234.5, 56.0)
    ('3.93', '1230')
    """
    if sigma == 0.0 or not _plain(sigma):
        return significant(value)
    place = _place(sigma)
    return f"{round(value, -place) + 0.0:.{max(0, -place)}f}"


def marked(drafting: Drafting, label: str, index: int) -> tuple[float, str]:
    """Return a quantity's sigma in one position and its mark, `DRAWN` or nothing.

    What the drawing does not give, as the ω of a link that does not turn, has no error.
    """
    spread = drafting.spreads.get(label)
    if spread is None:
        return 0.0, ""
    return float(spread.sigma[index]), DRAWN if spread.drawn[index] else ""


LABEL = {"v": "v", "a": "a", "ω": "omega", "ε": "epsilon"}
"""What the drafting errors call the quantities of the result tables."""


def label_of(symbol: str, name: str) -> str:
    """Return the label of a result: ``ω`` of link ``2`` is ``omega_2``."""
    return f"{LABEL[symbol]}_{name}"
