"""Digits of an error, and of a value beside its error (округление)."""

from __future__ import annotations

import math

from planmethod.note.numbers import ZERO_TOLERANCE, significant

TWO_DIGITS = 2.95
"""Leading digits of an error up to which it has two significant digits, beyond them one."""


def _place(sigma: float) -> int:
    """Return the power of ten of the last digit that an error is written with."""
    power = math.floor(math.log10(sigma))
    return power - 1 if sigma / 10.0**power < TWO_DIGITS else power


def _needs_no_exponent(sigma: float) -> bool:
    """Return whether an error is written without a power of ten."""
    return math.isfinite(sigma) and 1e-6 <= sigma < 1e6


def sigma_text(sigma: float, *, zero_limit: float = ZERO_TOLERANCE) -> str:
    """Return an error with a decimal point: two digits when it begins with 1 or 2, else one.

    >>> [sigma_text(s) for s in (0.0881, 0.1416, 17.73, 430.0, 0.0)]
    ['0.09', '0.14', '18', '400', '0']
    """
    if sigma == 0.0 or not _needs_no_exponent(sigma):
        return significant(sigma, 2, zero_limit=zero_limit)
    place = _place(sigma)
    return f"{round(sigma, -place):.{max(0, -place)}f}"


def rounded_to(value: float, sigma: float, *, zero_limit: float = ZERO_TOLERANCE) -> str:
    """Return a value up to the last digit of its error; to four digits when it has none.

    >>> rounded_to(3.9251, 0.0881), rounded_to(1234.5, 56.0)
    ('3.93', '1230')
    """
    if sigma == 0.0 or not _needs_no_exponent(sigma):
        return significant(value, zero_limit=zero_limit)
    place = _place(sigma)
    return f"{round(value, -place) + 0.0:.{max(0, -place)}f}"


def as_long(text: str, value: float, sigma: float) -> str:
    """Return the text of an exact value with no fewer decimals than its error has."""
    longer = rounded_to(value, sigma) if value and sigma else text
    return longer if len(longer.partition(".")[2]) > len(text.partition(".")[2]) else text
