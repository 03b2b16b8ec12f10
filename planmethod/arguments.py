"""Validation of arguments that a Python program passes (аргументы)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from numbers import Real
from operator import index
from reprlib import Repr
from types import UnionType
from typing import TYPE_CHECKING, Any, TypeVar

from planmethod.errors import ArgumentError

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

T = TypeVar("T")

_SHORT = Repr()
_SHORT.maxstring = _SHORT.maxother = 60


def describe(value: object) -> str:
    """Return a short description: a number, a text or a short list itself, else its type."""
    if value is None or isinstance(value, (str, Real, list, tuple)):
        return _SHORT.repr(value)
    return type(value).__name__


def of_type(argument: str, value: object, kind: type[T] | UnionType, home: str = "") -> T:
    """Return a value of a type; ``home`` is what makes one.

    Raises
    ------
    ArgumentError
    """
    if isinstance(value, kind):
        return value
    name = getattr(kind, "__name__", kind)
    if not home:
        raise ArgumentError("{}: expected {}, got {}.", argument, name, describe(value))
    raise ArgumentError(
        "{}: expected {}, got {}. {} returns one.", argument, name, describe(value), home
    )


def text(argument: str, value: object) -> str:
    """Return a text.

    Raises
    ------
    ArgumentError
    """
    if isinstance(value, str):
        return value
    raise ArgumentError("{}: expected a string, got {}.", argument, describe(value))


def texts(argument: str, value: object) -> tuple[str, ...]:
    """Return texts; one alone is a list of one.

    Raises
    ------
    ArgumentError
    """
    if isinstance(value, str):
        return (value,)
    try:
        found: tuple[Any, ...] = tuple(value)  # type: ignore[arg-type]
    except TypeError:
        found = (value,)
    if all(isinstance(one, str) for one in found):
        return found
    raise ArgumentError("{}: expected a list of strings, got {}.", argument, describe(value))


def chosen(argument: str, value: object, among: Iterable[str]) -> str:
    """Return one of some names.

    Raises
    ------
    ArgumentError
    """
    names = tuple(among)
    if isinstance(value, str) and value in names:
        return value
    known = ", ".join(names)
    raise ArgumentError(
        "{}: {} does not exist. Choose one of: {}.", argument, describe(value), known
    )


def numbers(argument: str, value: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return numbers as an array of its own, shape (n,).

    Raises
    ------
    ArgumentError
    """
    found = reals(argument, value)
    if found.ndim == 1:
        return found.copy()
    raise ArgumentError(
        "{}: expected a list of numbers, got {}. Write one number as a list, too: [30].",
        argument,
        describe(value),
    )


def reals(
    argument: str, value: npt.ArrayLike, dtype: npt.DTypeLike = "float64"
) -> npt.NDArray[Any]:
    """Return numbers as an array of a type, of whatever shape; an array of it is itself.

    Raises
    ------
    ArgumentError
    """
    import numpy as np  # a train has no arrays

    try:
        found = np.asarray(value)
        # Of objects those that are fractions, or integers beyond 64 bits.
        if found.dtype.kind in "iuf" or all(isinstance(one, Real) for one in found.flat):
            return found.astype(dtype, copy=False)
    except (TypeError, ValueError, OverflowError):
        pass
    raise ArgumentError(
        "{}: expected a list of numbers, got {}. Write one number as a list, too: [30].",
        argument,
        describe(value),
    )


def above_zero(argument: str, value: object) -> float:
    """Return a finite number above zero.

    Raises
    ------
    ArgumentError
    """
    if isinstance(value, Real) and not isinstance(value, bool):
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if 0.0 < number < math.inf:
            return number
    raise ArgumentError("{}: expected a number above 0, got {}.", argument, describe(value))


def number_of(argument: str, value: object, count: int) -> int:
    """Return the index of one of several items, from 0.

    Raises
    ------
    ArgumentError
    """
    if not isinstance(value, bool):
        try:
            found = index(value)  # type: ignore[arg-type]
        except TypeError:
            found = -1
        if 0 <= found < count:
            return found
    if not count:
        raise ArgumentError("{}: there is none, got {}.", argument, describe(value))
    raise ArgumentError(
        "{}: expected a whole number from 0 to {}, got {}.", argument, count - 1, describe(value)
    )


class UnknownNameError(ArgumentError, KeyError):
    """A result is requested by an unknown name."""

    __str__ = Exception.__str__  # KeyError quotes it


def known(kind: str, name: object, among: Iterable[str]) -> str:
    """Return the name of one of those that there are; ``kind``: ``point``, ``link``.

    Raises
    ------
    UnknownNameError
    """
    if isinstance(name, str) and name in among:
        return name
    raise UnknownNameError(
        "{} {} does not exist. Known: {}.", kind, describe(name), ", ".join(among)
    )


class Named(dict[str, T]):
    """Results by name; an unknown name is reported with the known ones.

    Parameters
    ----------
    results : dict
    kind : str
        What they are of, as a message has it: ``point``.
    """

    def __init__(self, results: dict[str, T], kind: str) -> None:
        super().__init__(results)
        self.kind = kind

    def __getitem__(self, name: str) -> T:
        """Return the result of a name.

        Raises
        ------
        UnknownNameError
        """
        try:
            return super().__getitem__(name)
        except TypeError:  # not a text
            return self.__missing__(name)

    def __missing__(self, name: object) -> T:
        known(self.kind, name, self)
        raise AssertionError(name)

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the parts to rebuild it in another process."""
        return Named, (dict(self), self.kind)
