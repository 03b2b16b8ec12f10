"""A mechanism of another program: points of one position, and rigid bodies that join them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NoReturn

from msgspec import Struct

from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate

SIZE_LIMIT = 1_000_000
"""Characters of a file; an ordinary mechanism has a few thousand."""

MEMBER_LIMIT = 200
"""Bodies of a file, and points."""


class ForeignBody(Struct, frozen=True):
    """A rigid body (звено): its name in the other program, and its points."""

    name: str
    points: tuple[str, ...]


class ForeignSlide(Struct, frozen=True):
    """A prismatic joint (поступательная пара).

    Attributes
    ----------
    pin : str
        Point that stays on the line.
    body : str
        Body that slides without turning; empty for a block pinned to the others.
    host : str
        Body that has the line; empty for the frame.
    guide_points : tuple of str
        Two points of the host on the line; empty if ``angle`` gives it through the pin.
    angle : float
        Of the line from the x axis in this position, degrees.
    """

    pin: str
    body: str = ""
    host: str = ""
    guide_points: tuple[str, ...] = ()
    angle: float = 0.0


class ForeignDriver(Struct, frozen=True):
    """The driving body (начальное звено): ``omega``, 1/s, of a body; ``v``, m/s, of a slide."""

    body: str = ""
    pin: str = ""
    omega: float | None = None
    v: float | None = None


class ForeignMechanism(Struct, frozen=True):
    """A mechanism in one position (механизм другой программы).

    Attributes
    ----------
    points : mapping of str to complex
        In ``unit``: ``m``, ``cm``, ``mm`` or ``in``.
    fixed : frozenset of str
        Points of the frame.
    remarks : tuple of str
        What the reader did not understand, or had to assume.
    """

    program: str
    title: str
    unit: str
    points: Mapping[str, complex]
    fixed: frozenset[str]
    rigid_bodies: tuple[ForeignBody, ...]
    slides: tuple[ForeignSlide, ...]
    driver: ForeignDriver
    remarks: tuple[str, ...] = ()


def reject(source: str, message: str, *facts: object, hint: str = "") -> NoReturn:
    """Raise the fault of a file of another program.

    Raises
    ------
    ProblemError
    """
    raise ProblemError(source, [Fault("", translate(message, *facts), hint)])


def finite(source: str, value: Any, quantity: str) -> float:
    """Return a number of a file.

    Raises
    ------
    ProblemError
        It is not a finite number.
    """
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        reject(source, "{} is not a number: {!r}", quantity, str(value)[:40])
    try:
        number = float(value)
    except (ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number) or abs(number) > 1e9:
        reject(source, "{} is not a number: {!r}", quantity, str(value)[:40])
    return number
