"""The key for machines (ключ для программ)."""

from __future__ import annotations

from typing import Any

from planmethod.check.key import Key
from planmethod.check.model import KeyEntry
from planmethod.check.pages.answer_format import displayed_value
from planmethod.note.numbers import finite_or_none


def key_record(key: Key) -> dict[str, Any]:
    """Return the key of one variant as plain data: SI, degrees, mm; None for missing values."""
    return {
        "problem": key.problem.name,
        "variant": key.variant,
        "scales": dict(key.scales),
        "answers": [_answer(entry) for entry in key.entries],
        "hidden": {code: list(places) for code, places in key.hidden.items()},
    }


def _answer(entry: KeyEntry) -> dict[str, Any]:
    return {
        "id": entry.id,
        "what": entry.what,
        "letters": entry.label,
        "value": finite_or_none(displayed_value(entry.exact, entry)),
        "unit": entry.unit,
        "tolerance": finite_or_none(entry.tolerance),
        "mm": None if entry.mm is None else finite_or_none(entry.mm),
        "segment": entry.segment or None,
        "sense": None if entry.sense is None else entry.sense.value,
        "position": entry.position,
        "points": entry.points,
        "asks_sense": entry.asks_sense,
        "signed": entry.signed,
        "sigma": finite_or_none(entry.sigma),
        "seen": entry.is_visible,
        "zero": entry.zero,
        "asked": entry.requested_unit or None,
        "per": entry.per,
        "hidden": list(entry.hidden),
    }
