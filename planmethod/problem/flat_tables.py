"""Read flat tables by the declarations of their keys (`planmethod.problem.key_types`)."""

# Cyrillic letters: type Б of the lettering in a problem file

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeAlias, assert_never

from planmethod.languages import translate
from planmethod.problem import fields
from planmethod.problem.fields import Faults, Table
from planmethod.problem.key_types import (
    AngleKey,
    ChoiceKey,
    CustomKey,
    FlagKey,
    FlatField,
    IntegerKey,
    NumberKey,
    TextKey,
    WordKey,
    declared,
)
from planmethod.problem.names import fold, nearest_name_hint

CustomReader: TypeAlias = Callable[[Faults, str, Any], object]
"""Reads the value of a key: faults, path, value; None after noting a fault."""

_CHOICE_LIMIT = 40


def read_flat(
    faults: Faults,
    path: str,
    table: Table,
    record: type[object],
    readers: Mapping[str, CustomReader] | None = None,
    *,
    without: Collection[str] = (),
    example: str = "",
) -> dict[str, Any]:
    """Read a flat table.

    Parameters
    ----------
    record : type
        Its fields declare the keys of the table (`declared`).
    readers : mapping of str to callable, optional
        Readers of the table's custom keys; values of custom keys without a reader are returned
        unchanged.
    without : collection of str
        Keys of the record that this table does not have.
    example : str
        Shown where a required key is missing that has no hint of its own.

    Returns
    -------
    dict of str to object
        Values by the fields of the record: of the keys that are given and have no fault.
    """
    known = [one for one in declared(record) if one.name not in without]
    before = len(faults)
    given = fields.read_keys(faults, path, table, (one.name for one in known))
    # a misspelt key is reported once: the key it should have been is not called missing as well
    whole = len(faults) == before
    found: dict[str, Any] = {}
    for one in known:
        where = f"{path}.{one.name}"
        if one.name not in given:
            if one.key.required and whole:
                hint = translate("For example: {}", example) if example else one.key.missing
                faults.add(where, "missing", hint)
            continue
        reader = (readers or {}).get(one.name)
        read = reader(faults, where, given[one.name]) if reader else None
        value = read if reader else _read_key(faults, where, given[one.name], one)
        if value is not None:
            found[one.field] = value
    return found


def _read_key(faults: Faults, path: str, value: object, one: FlatField) -> object:
    match one.key:
        case NumberKey() as key:
            return _read_number(faults, path, value, key)
        case IntegerKey() as key:
            return fields.read_integer(faults, path, value, key.low, key.high)
        case AngleKey():
            return fields.read_angle(faults, path, value)
        case FlagKey():
            return fields.read_flag(faults, path, value)
        case TextKey() as key:
            return fields.read_text(faults, path, value, limit=key.limit)
        case WordKey():
            return fields.read_member(faults, path, value, one.kind)
        case ChoiceKey() as key:
            return read_choice(faults, path, value, key.words)
        case CustomKey():
            return value
        case _:
            assert_never(one.key)


_KINDS = {"a radius": "distance", "a distance": "distance"}


def _read_number(faults: Faults, path: str, value: object, key: NumberKey) -> float | None:
    if key.unit == "m" and faults.unit != "m":
        kind = _KINDS.get(key.noun, "length")
        return fields.read_metres(
            faults, path, value, kind, low=key.low, high=key.high, positive=key.positive
        )
    if key.low == 0.0 and key.unbounded and fields.is_number(value) and value < 0:
        faults.add(path, translate("expected {}, 0 or greater, got {:g}", key.expected, value))
        return None
    return fields.read_number(
        faults, path, value, key.expected,  # translated where it is a fault
        low=key.low, high=key.high, positive=key.positive, hint=key.hint,
    )  # fmt: skip


def read_choice(faults: Faults, path: str, value: object, known: Collection[str]) -> str | None:
    """Read one of a few words, in either alphabet and case."""
    text = fields.read_text(faults, path, value, limit=_CHOICE_LIMIT)
    if text is None:
        return None
    word = chosen(text, known)
    if word is None:
        faults.expected(
            path, translate("one of {}", ", ".join(known)), value, nearest_name_hint(text, known)
        )
    return word


def chosen(text: str, known: Collection[str]) -> str | None:
    """Return the word that a text matches, in either alphabet and case, or None.

    Type Б of the lettering is called B in Latin letters.

    Examples
    --------
    >>> chosen("2А", ("1", "2a"))
    '2a'
    """
    word = fold(text.replace("Б", "B")).replace(" ", "").casefold()
    return next((name for name in known if name.replace(" ", "").casefold() == word), None)
