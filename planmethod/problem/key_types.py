"""Declaration of the keys of flat tables (описание ключей) by the record of a table.

A field of such a record is annotated with a key: ``Annotated[float, NumberKey("mass", ...)]``. The
reader of the table (`planmethod.problem.file_node`), its keys (`planmethod.problem.keys`), its
part of ``schema.json`` and its rows in the references follow from that (``make schema``). The
default of the field holds where the file lacks the key.

A sentence is the Markdown of the reference: it begins with a small letter and has no full stop;
unit, bounds and default follow it.
"""

from __future__ import annotations

from collections.abc import Iterator
from types import NoneType
from typing import Any, TypeAlias, get_args, get_type_hints

from msgspec import Struct

LENGTH_HINT = "Check the unit: the file is in SI units and degrees."


class DeclaredKey(Struct, frozen=True, kw_only=True):
    """Common attributes of keys of every type.

    Attributes
    ----------
    name : str
        Name in the file; empty where it is that of the field.
    required : bool
    missing : str
        Hint where the file lacks a required key.
    more : str
        Text of the reference after unit, bounds and default, with its punctuation.
    absent : str
        Default in words; empty where it is the default of the field.
    """

    name: str = ""
    required: bool = False
    missing: str = ""
    more: str = ""
    absent: str = ""


class NumberKey(DeclaredKey, frozen=True):
    """A number within bounds.

    Attributes
    ----------
    noun : str
        Expected value, without its unit: ``a density``.
    unit : str
        Empty of a number without dimension.
    positive : bool
        Zero and negative numbers are reported as such, before the bounds are checked.
    hint : str
        Hint for a number out of bounds.
    """

    sentence: str
    noun: str = "a number"
    unit: str = ""
    low: float = -1e9
    high: float = 1e9
    positive: bool = False
    hint: str = LENGTH_HINT

    @property
    def expected(self) -> str:
        """Expected value, with its unit."""
        return f"{self.noun} in {self.unit}" if self.unit else self.noun

    @property
    def unbounded(self) -> bool:
        """True if the upper bound only rejects values that are impossible in a machine."""
        return self.high >= 1e9


class IntegerKey(DeclaredKey, frozen=True):
    """A whole number within bounds."""

    sentence: str
    low: int
    high: int


class AngleKey(DeclaredKey, frozen=True):
    """An angle, degrees."""

    sentence: str


class FlagKey(DeclaredKey, frozen=True):
    """``true`` or ``false``."""

    sentence: str


class TextKey(DeclaredKey, frozen=True):
    """A line of text of at most ``limit`` characters."""

    sentence: str
    limit: int


class WordKey(DeclaredKey, frozen=True):
    """A word of the enumeration that the field has."""

    sentence: str


class ChoiceKey(DeclaredKey, frozen=True):
    """One of some words, in either alphabet and case."""

    sentence: str
    words: tuple[str, ...]


class CustomKey(DeclaredKey, frozen=True):
    """A value with a reader of its own in its table."""

    sentence: str


FlatKey: TypeAlias = (
    NumberKey | IntegerKey | AngleKey | FlagKey | TextKey | WordKey | ChoiceKey | CustomKey
)


class FlatField(Struct, frozen=True):
    """A field of the record of a table with its key.

    Attributes
    ----------
    field, name : str
        Its names in the record and in the file.
    key : FlatKey
    kind : type
        Type of the value.
    """

    field: str
    name: str
    key: FlatKey
    kind: type[Any]


_DECLARED: dict[type[object], tuple[FlatField, ...]] = {}


def declared(record: type[object]) -> tuple[FlatField, ...]:
    """Return the fields of a record that are keys of a table, in their order."""
    if record not in _DECLARED:
        _DECLARED[record] = tuple(_declared(record))
    return _DECLARED[record]


def _declared(record: type[object]) -> Iterator[FlatField]:
    for field, hint in get_type_hints(record, include_extras=True).items():
        for key in getattr(hint, "__metadata__", ()):
            kinds = [kind for kind in get_args(hint.__origin__) if kind is not NoneType]
            kind = kinds[0] if kinds else hint.__origin__
            yield FlatField(field, key.name or field, key, kind)
