"""Faults of a file, all reported at once (сбор ошибок), and values of TOML in messages."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeGuard

from planmethod.errors import Fault
from planmethod.languages import translate
from planmethod.problem.names import short

FAULT_LIMIT = 100
"""More faults than this are counted, not listed."""


class Faults:
    """Collect the faults of a file, so that all are reported at once (сбор ошибок).

    Attributes
    ----------
    unit : str
        Unit of the lengths of the file, a key of `UNITS`.
    names : mapping
        Values that numbers of the file may name, in its unit: results of `[synthesis]`.
    stated : dict of str to str
        Arithmetic in place of a number, as written, by path.
    vanished : dict of str to float
        Numbers that are read as zero, by path: speeds, forces and the like, of which that matters.
    places : set of str
        Paths with a fault, and the paths of everything that they are in.
    """

    def __init__(self) -> None:
        self.unit = "m"
        self.names: Mapping[str, float] = {}
        self.stated: dict[str, str] = {}
        self.vanished: dict[str, float] = {}
        self.places: set[str] = set()
        self._found: list[Fault] = []
        self.count = 0

    def copy(self) -> Faults:
        """Return an independent copy."""
        other = Faults()
        other.unit, other.names, other.stated = self.unit, self.names, dict(self.stated)
        other.vanished, other.places = dict(self.vanished), set(self.places)
        other._found, other.count = list(self._found), self.count
        return other

    def __bool__(self) -> bool:
        return self.count > 0

    def add(self, fault: Fault) -> None:
        """Note a fault; the same fault is noted only once."""
        if fault in self._found:
            return
        self.count += 1
        if self.count <= FAULT_LIMIT:
            self._found.append(fault)

    @property
    def listed(self) -> tuple[Fault, ...]:
        """Faults in the order of finding."""
        left = self.count - len(self._found)
        if left <= 0:
            return tuple(self._found)
        return (*self._found, Fault("", translate("and {} more faults", left), "Fix these first."))


def show(value: object) -> str:
    """Describe a TOML value for a message: ``the string 'abc'``, ``the integer 3``, ``a table``."""
    if isinstance(value, bool):
        return translate("the boolean {}", str(value).lower())
    if isinstance(value, str):
        return translate("the string {!r}", short(value))
    if isinstance(value, int):
        return translate("the integer {}", value) if abs(value) < 10**15 else "a huge integer"
    if isinstance(value, float):
        return translate("the number {:g}", value)
    if isinstance(value, Mapping):
        return "a table"
    if isinstance(value, list):
        return translate("a list of {}", len(value)) if value else "an empty list"
    return "a date or time"


def is_number(value: object) -> TypeGuard[int | float]:
    """Return whether a TOML value is a number (a boolean is not)."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def is_integer(value: object) -> TypeGuard[int]:
    """Return whether a TOML value is a whole number (a boolean is not)."""
    return isinstance(value, int) and not isinstance(value, bool)
