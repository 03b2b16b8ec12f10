"""Draughtsmen: random and expected deviations of every stroke; the ruler (чертёжник)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cache, cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct, field

from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.dual import CauseRows, Dual, Duals, as_dual
from planmethod.construct.evaluate import evaluate
from planmethod.construct.program import Program


# no messages: mistakes in a program
class RulerArithmetic(Float64, Struct, frozen=True):
    """Draughtsman who draws exactly and reads with a ruler (чертёжник с линейкой).

    Every length read on the drawing is rounded to the nearest ``ruler`` step, ties away from zero
    as a person reads; values computed from it propagate along the construction. A protractor is
    divided into as many degrees as the ruler is into millimetres.

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

    def read_angle(self, out: str, degrees: Number) -> Number:
        """Return the angle rounded to the step of the protractor, in (-180, 180]."""
        read = self.ruled(degrees)
        return np.where(read <= -180.0, read + 360.0, read)


class Profile(Struct, frozen=True):
    """Drafting accuracy (точность построений): standard deviations.

    Attributes
    ----------
    name : str
    point : float, mm
        Placing of a point by each coordinate; of a ruler at a point.
    lay_off, measure : float, mm
        Laying off and reading of a length.
    parallel : float, degrees
        Transfer of a direction with the set square; setting of the protractor.
    ruler : float, mm
        Step to which lengths are read.
    """

    name: str
    point: float
    lay_off: float
    measure: float
    parallel: float
    ruler: float


PROFILES: dict[str, Profile] = {
    profile.name: profile
    for profile in (
        Profile("cad", 0.01, 0.01, 0.01, 0.01, 0.01),
        Profile("board", 0.25, 0.25, 0.25, 0.25, 0.5),
        Profile("coarse", 0.5, 0.5, 0.5, 0.5, 1.0),
    )
}
"""Drawing with CAD, carefully on a board (the default), and roughly."""


AS_SCALED: Mapping[str, Number] = MappingProxyType({})
"""Everything is drawn at the scale of its plan."""


class Pencil:
    """Strokes of a draughtsman; a class that mixes this with an arithmetic defines an error.

    Parameters
    ----------
    profile : Profile
    free : frozenset of str
        Given points without an error: the poles, which may be placed anywhere.
    enlargements : mapping of str to Number
        Enlargement of a step relative to its scale, by its name: an error on paper counts that many
        times less there.
    """

    def __init__(
        self,
        profile: Profile,
        free: frozenset[str] = frozenset(),
        enlargements: Mapping[str, Number] = AS_SCALED,
    ) -> None:
        self.profile, self.free, self.enlargements = profile, free, enlargements

    def error(self, out: str, sigma: float) -> Number:
        """Return the next error of a stroke: a real number of zero mean."""
        raise NotImplementedError

    def rounded(self, out: str, length: Number) -> Number:
        """Return a length rounded to the ruler's step."""
        raise NotImplementedError

    def _off(self, out: str, sigma: float) -> Number:
        """Return the next error of so much on paper, mm at the scale of the plan."""
        times = self.enlargements.get(out)
        error = self.error(out, sigma)
        return error if times is None else error / times

    def _spot(self, out: str) -> Number:
        sigma = self.profile.point
        return self._off(out, sigma) + self._off(out, sigma) * 1j

    def _unit_normal(self, direction: Number) -> Number:
        """Return the unit normal of a line; 0 if it has no direction, and needs none."""
        size = abs(direction)
        return self.unless_zero(size, direction * 1j / self.nonzero(size), direction * 0.0)

    def given_point(self, out: str, point: Number) -> Number:
        """Return a given point as pricked."""
        return point if out in self.free else point + self._spot(out)

    def line_through(self, out: str, tail: Number, vector: Number) -> tuple[Number, Number]:
        """Return a line as drawn with the ruler through its two points."""
        across = self._unit_normal(vector)
        one, two = self._off(out, self.profile.point), self._off(out, self.profile.point)
        return tail + across * one, vector + across * (two - one)

    def drawn(self, out: str, through: Number, direction: Number) -> tuple[Number, Number]:
        """Return a line as the set square draws it."""
        across = self._unit_normal(direction)
        turn = self.error(out, math.radians(self.profile.parallel))
        return through + across * self._off(out, self.profile.point), direction + direction * (
            turn * 1j
        )

    def arc(self, out: str, centre: Number, radius: Number) -> tuple[Number, Number]:
        """Return an arc as the compass draws it."""
        return centre + self._spot(out), radius + self._off(out, self.profile.lay_off)

    def pricked(self, out: str, point: Number) -> Number:
        """Return a point as pricked."""
        return point + self._spot(out)

    def laid_off_length(self, out: str, length: Number) -> Number:
        """Return a laid-off length and its deviation beside the line; a zero length has neither."""
        beside = self._off(out, self.profile.point) * 1j
        off = length + self._off(out, self.profile.lay_off) + beside
        return self.unless_zero(self.is_drawn(length), off, length)

    def read(self, out: str, length: Number) -> Number:
        """Return a length as it is read; a length that does not exist is not read."""
        seen = self.rounded(out, length + self._off(out, self.profile.measure))
        return self.unless_zero(self.is_drawn(length), seen, length)

    def read_angle(self, out: str, degrees: Number) -> Number:
        """Return an angle as it is read: the protractor is set, and its mark is read."""
        return self.rounded(out, degrees + self.error(out, self.profile.parallel))

    def is_drawn(self, length: Number) -> Number:
        """Return 0 if a length is certainly zero, whatever the errors before it, else 1."""
        raise NotImplementedError

    def nonzero(self, value: Number) -> Number:
        """Return the value with NaN in place of zero."""
        raise NotImplementedError

    def unless_zero(self, size: Number, value: Number, fallback: Number) -> Number:
        """Return ``fallback`` where ``size`` is zero, else ``value``."""
        raise NotImplementedError


class Propagated(Pencil, Duals):
    """Errors carried to first order: each stroke is a separate cause.

    Parameters
    ----------
    causes : int
        How many errors the construction has, as `Counted` finds.
    """

    def __init__(
        self,
        profile: Profile,
        free: frozenset[str],
        causes: int,
        enlargements: Mapping[str, Number] = AS_SCALED,
    ) -> None:
        super().__init__(profile, free, enlargements)
        self.causes = causes
        self.of: list[str] = []
        self._known: dict[int, CauseRows] = {}

    nonzero = Duals.nonzero
    unless_zero = Duals.unless_zero

    def error(self, out: str, sigma: float) -> Number:
        """Return a dual number that only its own cause changes."""
        self.of.append(out)
        return self.caused(len(self.of) - 1, sigma)

    def caused(self, cause: int, sigma: float) -> Dual:
        """Return the zero that one cause changes."""
        rows = self._known.get(1 << cause) or CauseRows(1 << cause, self.causes, self._known)
        return Dual(np.zeros(1), np.full((1, 1), sigma), rows)

    def is_drawn(self, length: Number) -> Number:
        """Return 0 where a length is zero and no error changes it."""
        value = as_dual(length)
        fixed = np.asarray(value.value) == 0
        if value.part is not None:
            fixed = fixed & np.all(value.part == 0, axis=0)
        return Dual(np.where(fixed, 0.0, 1.0))

    def rounded(self, out: str, length: Number) -> Number:
        """Return a length with the error of rounding, which is spread evenly over a step."""
        return as_dual(length) + self._off(out, self.profile.ruler / math.sqrt(12.0))


class Counted(Pencil, Float64):
    """Exact strokes; the errors are only counted."""

    def __init__(self, profile: Profile, free: frozenset[str] = frozenset()) -> None:
        super().__init__(profile, free)
        self.causes = 0

    nonzero = Float64.nonzero
    unless_zero = Float64.unless_zero

    def error(self, out: str, sigma: float) -> Number:
        """Count an error and return none."""
        self.causes += 1
        return 0.0

    def is_drawn(self, length: Number) -> Number:
        """Return 1: whatever it is, its errors are counted."""
        return 1.0

    def rounded(self, out: str, length: Number) -> Number:
        """Count the rounding and return the length."""
        self.causes += 1
        return length


class Sampled(Pencil, Float64):
    """Every stroke drawn at random, many times over (метод Монте-Карло).

    Parameters
    ----------
    draws : int
        How many sheets are drawn: the length of every array.
    seed : int
        The same seed draws the same sheets.
    """

    def __init__(
        self,
        profile: Profile,
        free: frozenset[str],
        draws: int,
        seed: int,
        enlargements: Mapping[str, Number] = AS_SCALED,
    ) -> None:
        super().__init__(profile, free, enlargements)
        self.draws, self._seed = draws, seed
        self._hand = RulerArithmetic(ruler=profile.ruler, enlargements=enlargements)

    nonzero = Float64.nonzero
    unless_zero = Float64.unless_zero

    @cached_property
    def _random(self) -> np.random.Generator:
        return np.random.default_rng(self._seed)

    def error(self, out: str, sigma: float) -> npt.NDArray[np.float64]:
        """Return normal errors."""
        return np.asarray(self._random.normal(0.0, sigma, self.draws))

    def is_drawn(self, length: Number) -> Number:
        """Return 0 if a length is zero on every sheet."""
        return 1.0 if np.any(length) else 0.0

    def rounded(self, out: str, length: Number) -> Number:
        """Return the length rounded to the step of the ruler."""
        return self._hand.read(out, length)


LATTICE_SIZE, _TURN = 509, 77
"""Sheets that are spread evenly, a prime; and by which power they go round (решётка Коробова)."""


class LatticeSampled(Sampled):
    """Strokes spread evenly over their distribution, rounding included, as to first order.

    A lattice of Korobov (Коробов, 1959): for a few errors it gives as much information as 4000
    random sheets. Each requested error is the next coordinate of its points.
    """

    def __init__(
        self,
        profile: Profile,
        free: frozenset[str] = frozenset(),
        enlargements: Mapping[str, Number] = AS_SCALED,
    ) -> None:
        super().__init__(profile, free, LATTICE_SIZE, 0, enlargements)
        self._asked = 0

    def _next(self) -> npt.NDArray[np.intp]:
        """Return a permutation of the sheets: the next coordinate of the lattice."""
        self._asked += 1
        return np.arange(LATTICE_SIZE) * pow(_TURN, self._asked - 1, LATTICE_SIZE) % LATTICE_SIZE

    def error(self, out: str, sigma: float) -> npt.NDArray[np.float64]:
        """Return normal errors."""
        return sigma * _normal()[self._next()]

    def normals(self, count: int) -> npt.NDArray[np.float64]:
        """Return standard normal numbers of shape (count, EVEN)."""
        return np.array([self.error("", 1.0) for _ in range(count)])

    def rounded(self, out: str, length: Number) -> Number:
        """Return the length off by up to half a step."""
        off = self.profile.ruler * ((self._next() + 0.5) / LATTICE_SIZE - 0.5)
        return length + off / self.enlargements.get(out, 1.0)


@cache
def _normal() -> npt.NDArray[np.float64]:
    """Return the standard normal numbers at the middles of equal shares."""
    sizes = np.linspace(-4.0, 4.0, 4001)
    shares = [(1.0 + math.erf(size / math.sqrt(2.0))) / 2.0 for size in sizes]
    return np.interp((np.arange(LATTICE_SIZE) + 0.5) / LATTICE_SIZE, shares, sizes)


_COUNTED: dict[tuple[Program, frozenset[str]], int] = {}
_MAX_COUNTED = 256


def causes_of(program: Program, data: Callable[[], Mapping[str, Any]], free: frozenset[str]) -> int:
    """Return the number of errors of a construction, which depends only on its steps and ``free``.

    ``data`` returns the data of some position; it is called if they have not been counted before.
    """
    key = (program, free)
    known = _COUNTED.get(key)
    if known is not None:
        return known
    counted = Counted(PROFILES["board"], free)
    evaluate(program, data(), counted)
    if len(_COUNTED) >= _MAX_COUNTED:
        _COUNTED.clear()
    _COUNTED[key] = counted.causes
    return counted.causes


def sigmas(
    program: Program,
    data: Mapping[str, Any],
    profile: Profile,
    free: frozenset[str],
    enlargements: Mapping[str, Number] = AS_SCALED,
) -> dict[str, npt.NDArray[np.float64]]:
    """Return how far the numbers of a drawing may be off, by first order, shapes (n,).

    ``free``: points that may be placed anywhere; ``enlargements``: enlargement of each step.
    """
    causes = causes_of(program, lambda: data, free)
    trace = evaluate(program, data, Propagated(profile, free, causes, enlargements))
    found: dict[str, npt.NDArray[np.float64]] = {}
    for name, value in trace.value.items():
        if isinstance(value, tuple) or np.iscomplexobj(as_dual(value).value):
            continue
        slope = as_dual(value).slope
        zero = np.zeros(np.shape(np.atleast_1d(as_dual(value).value)))
        found[name] = zero if slope is None else zero + np.sqrt(np.sum(np.abs(slope) ** 2, axis=0))
    return found
