"""Limits of every declared key: at a limit it is read, just beyond it a fault names both limits."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import inf, nextafter

import pytest
from cases import each
from doors import (
    AngleKey,
    Faults,
    FileNode,
    FlagKey,
    IntegerKey,
    NumberKey,
    TextKey,
    declared,
    keys,
)


def read(record: type[object], name: str, value: object) -> tuple[dict[str, object], str]:
    """Return the values read from a table of one key, and the fault of that key."""
    faults = Faults()
    found = FileNode(faults, {name: value}, "table").record(record)
    own = [str(one) for one in faults.listed if one.path == f"table.{name}"]
    assert len(own) <= 1
    return found, "".join(own)


def numbers(text: str) -> list[float]:
    return [float(one) for one in re.findall(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?", text)]


DECLARED = [(table, one) for table in keys.FLAT for one in declared(keys.FLAT[table])]


@each("table", keys.FLAT)
def test_a_number_is_read_at_its_limits_and_refused_just_beyond(table: str) -> None:
    record = keys.FLAT[table]
    for one in declared(record):
        if not isinstance(one.key, NumberKey | IntegerKey):
            continue
        low, high = one.key.low, one.key.high
        positive = isinstance(one.key, NumberKey) and one.key.positive
        inside = [high, *([] if positive and low <= 0 else [low])]
        for value in inside:
            found, fault = read(record, one.name, value)
            assert (fault, found.get(one.field)) == ("", value), one.name
            if isinstance(one.key, NumberKey):
                assert isinstance(found[one.field], float)
        step = 1 if isinstance(one.key, IntegerKey) else None
        above = high + step if step else nextafter(high, inf)
        below = low - step if step else nextafter(low, -inf) if low else -1e-6
        for value in (above, below):
            found, fault = read(record, one.name, value)
            assert not found and fault, (one.name, value)
            said = numbers(fault.split(": ", 1)[1])
            if value == above or not (positive or low == 0.0):
                shown = [float(f"{limit:g}") if not step else limit for limit in (low, high)]
                assert said[:2] == shown, fault
                assert said[2] == pytest.approx(value, rel=1e-5, abs=1e-9), fault
            else:
                assert any(x == pytest.approx(value, rel=1e-5) for x in said), fault
        if positive:
            assert "greater than 0" in read(record, one.name, 0)[1]
            assert "greater than 0" in read(record, one.name, -1)[1]


def others(kind: type[object]) -> Iterator[tuple[type[object], str, str, int]]:
    for table, one in DECLARED:
        if isinstance(one.key, kind):
            yield keys.FLAT[table], one.name, one.field, getattr(one.key, "limit", 0)


def test_a_text_is_read_up_to_its_limit_and_a_flag_without_quotes_only() -> None:
    seen = 0
    for record, name, field, limit in others(TextKey):
        assert read(record, name, "a" * limit) == ({field: "a" * limit}, "")
        found, fault = read(record, name, "a" * (limit + 1))
        assert not found and {limit, limit + 1} <= set(numbers(fault)), fault
        seen += 1
    for record, name, field, _ in others(FlagKey):
        assert read(record, name, True) == ({field: True}, "")
        assert read(record, name, False) == ({field: False}, "")
        assert "Write it without quotes" in read(record, name, "true")[1]
        assert "true or false" in read(record, name, 1)[1]
        seen += 1
    assert seen > 5


def test_an_angle_is_read_within_the_same_limits_in_every_table() -> None:
    for record, name, field, _ in others(AngleKey):
        found, fault = read(record, name, 1.5)
        assert found == {field: 1.5} and not fault
        refused = read(record, name, 1e12)[1]
        low, high, *_ = numbers(refused.split(": ", 1)[1])
        assert low == -high
        for sign in (1, -1):
            assert read(record, name, sign * high) == ({field: sign * high}, "")
            assert read(record, name, sign * nextafter(high, inf))[1]


def test_a_required_key_that_is_missing_is_the_only_fault_of_an_empty_table() -> None:
    for record in keys.FLAT.values():
        faults = Faults()
        FileNode(faults, {}, "table").record(record)
        due = [f"table.{one.name}" for one in declared(record) if one.key.required]
        assert [one.path for one in faults.listed] == due
        faults = Faults()
        FileNode(faults, {"nonsense_key": 1}, "table").record(record)
        assert [one.path for one in faults.listed] == ["table.nonsense_key"] or not declared(record)
