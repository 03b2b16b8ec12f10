"""Numbers that carry their derivatives by many small causes: first-order propagation of errors.

A cause is a change of one datum (condition numbers) or one stroke of a pencil (drafting error).
The condition number of a result says how much the last bit of the data moves it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import reduce
from operator import attrgetter
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.construct.arithmetic import Exact, Number, unit_vectors
from planmethod.construct.evaluate import evaluate
from planmethod.construct.program import Program
from planmethod.construct.steps import Name

Slope = npt.NDArray[Any] | None


class CauseRows:
    """Sparse index of the causes that change a number: most strokes of a drawing do not.

    There is one object for each set of causes of a drawing, so that equal sets are the same object.

    Attributes
    ----------
    index : ndarray of shape (k,)
        The causes, in order.
    count : int
        Number of all causes.
    """

    __slots__ = ("_joined", "_known", "_mask", "count", "index")

    def __init__(self, mask: int, count: int, known: dict[int, CauseRows]) -> None:
        self._mask, self._known, self.count = mask, known, count
        self._joined: dict[int, tuple[CauseRows, Any, Any]] = {}
        bits = np.frombuffer(mask.to_bytes(count // 8 + 1, "little"), dtype=np.uint8)
        self.index = np.unpackbits(bits, bitorder="little").nonzero()[0]
        known[mask] = self

    def joined(self, other: CauseRows) -> tuple[CauseRows, Any, Any]:
        """Return the union of the causes, and the indices of each operand's causes in it."""
        if other._mask not in self._joined:
            mask = self._mask | other._mask
            both = self._known.get(mask) or CauseRows(mask, self.count, self._known)
            one, two = (both.index.searchsorted(rows.index) for rows in (self, other))
            self._joined[other._mask] = both, one, two
        return self._joined[other._mask]


class Dual:
    """A value in every position, and its slope by every cause (дуальное число).

    Attributes
    ----------
    value : ndarray of shape (n,) or ()
    part : ndarray of shape (m, n) or (m, 1), or None when no cause changes it
        Slopes by the causes of ``rows``, or by all.
    rows : CauseRows or None
    """

    __slots__ = ("part", "rows", "value")
    __array_ufunc__ = None

    def __init__(self, value: Number, slope: Slope = None, rows: CauseRows | None = None) -> None:
        self.value, self.part, self.rows = value, slope, rows

    @property
    def slope(self) -> Slope:
        """Slopes by all causes, shape (m, n) or (m, 1), or None when no cause changes it."""
        if self.part is None or self.rows is None:
            return self.part
        whole = np.zeros((self.rows.count, *self.part.shape[1:]), dtype=self.part.dtype)
        whole[self.rows.index] = self.part
        return whole

    def at(self, chosen: npt.NDArray[np.intp]) -> Dual:
        """Return a number of shape (n,) in some of its positions."""
        part = self.part
        if part is not None and part.shape[1] > 1:
            part = part[:, chosen]
        return Dual(self.value[chosen], part, self.rows)

    def __add__(self, other: Number) -> Dual:
        other = as_dual(other)
        return Dual(self.value + other.value, *_sum(self, None, other, None))

    __radd__ = __add__

    def __neg__(self) -> Dual:
        return self.scaled(-self.value, -1.0)

    def __sub__(self, other: Number) -> Dual:
        return self + -as_dual(other)

    def __rsub__(self, other: Number) -> Dual:
        return as_dual(other) + -self

    def __mul__(self, other: Number) -> Dual:
        other = as_dual(other)
        return Dual(self.value * other.value, *_sum(self, other.value, other, self.value))

    __rmul__ = __mul__

    def __truediv__(self, other: Number) -> Dual:
        other = as_dual(other)
        value = self.value / other.value
        slope, rows = _sum(self, None, other, -value)
        return Dual(value, _times(slope, 1.0 / other.value), rows)

    def __rtruediv__(self, other: Number) -> Dual:
        return as_dual(other) / self

    def __abs__(self) -> Dual:
        size = np.abs(self.value)
        unit = np.conjugate(self.value) / np.where(size == 0, 1.0, size)
        if self.part is None:
            return Dual(size)
        # |x| has no slope at 0: what it can change by at most is the slope's own size.
        part = np.where(size == 0, np.abs(self.part), (self.part * unit).real)
        return Dual(size, part, self.rows)

    def conjugate(self) -> Dual:
        """Return the complex conjugate."""
        return self._each(np.conjugate)

    @property
    def real(self) -> Dual:
        """Real part."""
        return self._each(attrgetter("real"))

    @property
    def imag(self) -> Dual:
        """Imaginary part."""
        return self._each(attrgetter("imag"))

    def _each(self, part: Callable[[Any], Any]) -> Dual:
        return Dual(part(self.value), None if self.part is None else part(self.part), self.rows)

    def scaled(self, value: Number, factor: Number) -> Dual:
        """Return a value whose slopes are these by a factor; None: as they are."""
        return Dual(value, _times(self.part, factor), self.rows)


def as_dual(value: Number) -> Dual:
    """Return a number as a dual one: a constant unless it is one already."""
    return value if isinstance(value, Dual) else Dual(value)


def angle(value: Number, minimum: float) -> Number:
    """Return the angle of a complex number, radians, with its slope if it is a dual one.

    A number not longer than ``minimum`` has no direction: its angle is NaN.
    """
    dual = as_dual(value)
    solid = np.where(np.abs(dual.value) > minimum, dual.value, np.nan)
    turn = np.angle(solid)
    if dual is not value:
        return turn
    with np.errstate(invalid="ignore"):
        return Dual(turn, None if dual.part is None else (dual.part / solid).imag, dual.rows)


def _times(slope: Slope, factor: Number) -> Slope:
    return slope if slope is None or factor is None else slope * factor


def _sum(one: Dual, by: Number, two: Dual, times: Number) -> tuple[Slope, CauseRows | None]:
    """Return the sum of the slopes of two numbers, each times its factor if any, and its rows.

    Adding to a missing row is skipped: the result equals that of all rows.
    """
    first, second = _times(one.part, by), _times(two.part, times)
    if first is None or second is None:
        return (second, two.rows) if first is None else (first, one.rows)
    if one.rows is two.rows:
        return first + second, one.rows
    assert one.rows is not None and two.rows is not None
    rows, mine, its = one.rows.joined(two.rows)
    if rows is not one.rows or first.shape[1] < second.shape[1] or first.dtype < second.dtype:
        first = _among(rows, mine, first, second)
    elif by is None:
        first = first.copy()
    first[its] += second
    return first, rows


def _among(rows: CauseRows, at: Any, slope: Any, like: Any) -> Any:
    """Return slopes expanded to more rows, with the shape and type needed beside another's."""
    shape = (len(rows.index), max(slope.shape[1], like.shape[1]))
    whole = np.zeros(shape, dtype=np.result_type(slope, like))
    whole[at] = slope
    return whole


def common_slopes(*numbers: Dual) -> tuple[list[Any], CauseRows | None]:
    """Return the slopes of numbers by common causes, 0 if a number has none, and these causes."""
    own = [number.rows for number in numbers if number.part is not None and number.rows is not None]
    rows = reduce(lambda one, two: one.joined(two)[0], own) if own else None
    slopes: list[Any] = []
    for number in numbers:
        part = number.part
        if part is not None and rows is not None and number.rows not in (None, rows):
            part = _among(rows, rows.joined(number.rows)[2], part, part)
        slopes.append(0.0 if part is None else part)
    return slopes, rows


class Duals(Exact):
    """Dual numbers over float64 arrays."""

    def lift(self, value: Number) -> Number:
        """Turn given data into a dual number."""
        return value if isinstance(value, Dual) else Dual(np.asarray(value))

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of a negative number."""
        value = as_dual(value)
        root = np.sqrt(np.maximum(value.value, 0.0))
        return value.scaled(root, 0.5 / np.where(root == 0, np.nan, root))

    def _each(self, ok: Number, value: Number, fallback: Number) -> Dual:
        value, fallback = as_dual(value), as_dual(fallback)
        chosen = np.where(ok, value.value, fallback.value)
        if value.part is None and fallback.part is None:
            return Dual(chosen)
        (one, two), rows = common_slopes(value, fallback)
        return Dual(chosen, np.where(ok, one, two), rows)

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value where the margin exceeds the limit, NaN elsewhere."""
        value, ok = as_dual(value), as_dual(margin).value > limit
        return value.scaled(np.where(ok, value.value, np.nan * value.value), None)

    def nonzero(self, value: Number) -> Number:
        """Return the value with NaN in place of zero."""
        value = as_dual(value)
        return value.scaled(np.where(value.value == 0, np.nan, value.value), None)

    def direction_margin(self, length: Number) -> Number:
        """Return 1.0 where a length is not zero, else 0.0."""
        return Dual(np.where(np.abs(as_dual(length).value) > 0, 1.0, 0.0))

    def unless_zero(self, size: Number, value: Number, fallback: Number) -> Number:
        """Return ``fallback`` where ``size`` is zero, else ``value``."""
        return self._each(as_dual(size).value == 0, fallback, value)

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        less = as_dual(one).value < as_dual(two).value
        return self._each(less, one, two), self._each(less, two, one)

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle."""
        degrees = as_dual(degrees)
        u = unit_vectors(degrees.value)
        return degrees.scaled(u, 1j * np.pi / 180 * u)

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, degrees in (-180, 180]."""
        turned = angle(as_dual(vector), 0.0) * (180.0 / np.pi)
        return turned.scaled(np.where(turned.value <= -180.0, 180.0, turned.value), None)


DIGITS = 50
"""Default number of decimal digits of the high-precision check."""


class Precise(Exact):
    """Numbers of mpmath, one position at a time.

    It has its own context, so that a precision set elsewhere does not change its results.

    Parameters
    ----------
    digits : int
        Decimal digits carried.
    """

    __slots__ = ("_right", "context", "digits")

    def __init__(self, digits: int = DIGITS) -> None:
        from mpmath import MPContext

        self.digits = digits
        self.context: Any = MPContext()
        self.context.dps = digits
        self._right = self.context.pi / 180

    def lift(self, value: Number) -> Number:
        """Turn given data, binary fractions taken as they are, into a number of the context."""
        return self.context.convert(value.item() if hasattr(value, "item") else value)

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of a negative number."""
        return self.context.sqrt(value) if value > 0 else self.context.zero

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value if ``margin > limit``, else NaN."""
        return value if margin > limit else value * self.context.nan

    def nonzero(self, value: Number) -> Number:
        """Return the value, NaN in place of zero."""
        return self.context.nan if value == 0 else value

    def direction_margin(self, length: Number) -> Number:
        """Return 1 if a length is not zero, else 0."""
        return self.context.one if length != 0 else self.context.zero

    def unless_zero(self, size: Number, value: Number, fallback: Number) -> Number:
        """Return ``fallback`` if ``size`` is zero, else ``value``."""
        return fallback if size == 0 else value

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        return (one, two) if one < two else (two, one)

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle; exact at quadrants."""
        quadrant = int(self.context.nint(degrees / 90))
        cosine, sine = self.context.cos_sin((degrees - 90 * quadrant) * self._right)
        return self.context.mpc(cosine, sine) * (1, 1j, -1, -1j)[quadrant % 4]

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, degrees in (-180, 180]."""
        return self.context.atan2(vector.imag, vector.real) / self._right


UNIT_ROUNDOFF = 2.0**-53
"""u: half the distance of 1 to the next float64."""

Reals = npt.NDArray[np.float64]


def as_scalar(value: Number) -> Number:
    """Return a point or a number unchanged, and for a line its direction as a unit vector."""
    if not isinstance(value, tuple):
        return value
    along = value[1]
    span = abs(along)
    if isinstance(span, Dual | np.ndarray | np.generic) or span != 0:
        return along / span
    return along * float("nan")  # mpmath divides by no zero


def _causes(data: Mapping[str, Number], exact: Collection[str]) -> list[tuple[str, complex]]:
    """Return (datum, direction) of every coordinate that rounding may move."""
    causes: list[tuple[str, complex]] = []
    for name, value in data.items():
        if name in exact:
            continue
        array = np.asarray(value)
        if np.any(np.real(array) != 0):
            causes.append((name, 1.0))
        if np.iscomplexobj(array) and np.any(np.imag(array) != 0):
            causes.append((name, 1j))
    return causes


def _part(value: Number, direction: complex) -> Number:
    """Return the coordinate of a datum along a direction, as a vector along it."""
    return np.real(value) if direction == 1.0 else 1j * np.imag(value)


def reach(
    program: Program, data: Mapping[str, Number], exact: Collection[str] = ()
) -> dict[Name, Reals]:
    """Return the reach of every result of a program, to first order in float64.

    Of a line it is the reach of its unit direction.

    Parameters
    ----------
    program : Program
    data : mapping
        Scalars or ndarrays of shape (n,).
    exact : collection of str
        Data that carry no rounding: the scales.

    Returns
    -------
    dict of name to ndarray of shape (n,) or (1,)
        In the result's own unit.
    """
    causes = _causes(data, exact)
    lifted: dict[str, Number] = {}
    for name, value in data.items():
        mine = [(i, way) for i, (cause, way) in enumerate(causes) if cause == name]
        if not mine:
            lifted[name] = value
            continue
        row = np.atleast_1d(np.asarray(value))
        slope = np.zeros((len(causes), len(row)), dtype=row.dtype)
        for i, way in mine:
            slope[i] = _part(row, way)
        lifted[name] = Dual(row, slope)
    trace = evaluate(program, lifted, Duals())
    with np.errstate(all="ignore"):  # a line of zero length, which no result depends on
        return {name: _reach(as_dual(as_scalar(value))) for name, value in trace.value.items()}


def _reach(value: Dual) -> Reals:
    size = np.abs(np.atleast_1d(value.value))
    if value.slope is not None:
        size = size + np.abs(value.slope).sum(axis=0)
    return np.asarray(size, dtype=float)


def measured_reach(
    program: Program, data: Mapping[str, Any], precise: Precise, exact: Collection[str] = ()
) -> dict[Name, tuple[Number, Number]]:
    """Return value and reach of every result of one position, both in multiprecision.

    Each datum is moved by a relative step of ten to the minus third of the number of digits, which
    leaves two thirds of them true in the quotient.

    Parameters
    ----------
    data : mapping
        Scalars.
    """
    step = precise.context.mpf(10) ** -(precise.digits // 3)
    lifted = {name: precise.lift(value) for name, value in data.items()}
    names = {name: as_scalar(v) for name, v in evaluate(program, lifted, precise).value.items()}
    total = {name: abs(value) for name, value in names.items()}
    for name, way in _causes(data, exact):
        part = lifted[name].real if way == 1.0 else 1j * lifted[name].imag
        moved = evaluate(program, {**lifted, name: lifted[name] + part * step}, precise)
        for result, value in names.items():
            total[result] += abs(as_scalar(moved.value[result]) - value) / step
    return {name: (value, total[name]) for name, value in names.items()}
