"""Heads of columns: which field, which quantity, in which unit (шапка таблицы)."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from planmethod.check.works.cells import read_name
from planmethod.check.works.gather import scale_name
from planmethod.check.works.units import read_unit
from planmethod.check.works.vocabulary import HEADS, MM, key
from planmethod.pattern import pattern
from planmethod.record import dataclass

ASPECTS = ("value", "mm", "sense", "unit", "segment")
"""What of an answer may stand in a column of its own."""

_PLAN_LENGTHS = ("length", "segment", "arm", "shift")
_LAST_WORD = pattern(r"(.*\S)\s+(\S+)\Z")
_QUANTITY = pattern("[A-Za-zΑ-ωϕ]")


@dataclass(frozen=True, slots=True)
class Head:
    """What stands in a column (столбец).

    Attributes
    ----------
    field : str
        One of the fields of `HEADS`; empty for what nobody knows.
    name : str
        Quantity, of which ``field`` is an aspect; or scale, where ``field`` is ``scale``.
    unit : str
        Of the numbers below that have none of their own.
    """

    field: str = ""
    name: str = ""
    unit: str = ""


@lru_cache(maxsize=4096)
def read_head(text: str) -> Head:
    """Return what a head says by itself: ``мм``, ``Значение, м/с``, ``μ_v, (м/с)/мм``."""
    for base, suffix in ((text, ""), *_parted(text)):
        if suffix and not read_unit(suffix):
            continue
        name = key(base) or base
        if scale := scale_name(base):
            return Head("scale", scale, suffix)
        field = "mm" if HEADS.get(name) == "segment" and suffix in MM else HEADS.get(name, "")
        if field:
            return Head(field, unit="" if field == "mm" else suffix)
    return Head()


@lru_cache(maxsize=4096)
def read_quantity(text: str) -> Head:
    """Return the quantity of a column and what of it stands there: ``v_B3 (мм)``, ``v_B3, м/с``."""
    if read_name(text)[0]:
        return Head("value", text)
    match = _LAST_WORD.match(text)
    if match and (aspect := read_aspect(match[2])):
        return _of_aspect(match[1].rstrip(",;: "), aspect)
    for base, suffix in _parted(text):
        if aspect := read_aspect(suffix):
            return _of_aspect(base, aspect)
        if read_unit(suffix):
            return Head("value", base, suffix)
    # Words without a letter of the plans: a mark, a signature.
    return Head("value", text) if _QUANTITY.search(text) and len(text) <= 60 else Head()


def read_aspect(text: str) -> str:
    """Return the aspect of an answer that a word names, or nothing."""
    field = HEADS.get(key(text), "")
    return field if field in ASPECTS else ""


def _of_aspect(name: str, aspect: str) -> Head:
    if aspect == "mm" and read_name(name)[0].split(" ")[0] in _PLAN_LENGTHS:
        return Head("value", name, "mm")  # what is asked is itself a length on a plan
    return Head(aspect, name)


def _parted(text: str) -> Iterator[tuple[str, str]]:
    """Yield a head and what may be its unit: from behind each of its commas and brackets."""
    for mark in re.finditer(r"[,;(\[]", text):
        suffix = text[mark.start() :].strip(" ,;[]")
        if suffix.startswith("(") and suffix.find(")") == len(suffix) - 1:
            suffix = suffix[1:-1]
        if base := text[: mark.start()].strip():
            yield base, suffix.strip()
