"""What the norm control says (замечания нормоконтроля): codes, severities, filled in sentences."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

from planmethod.note.plaintext import plain_text
from planmethod.note.wording import language
from planmethod.paper import FORMATS
from planmethod.render.control.words import thing_text

Segments: TypeAlias = tuple[tuple[str, float], ...]
"""Letters and lengths of segments, mm."""

Facts: TypeAlias = Mapping[str, str | float | Segments]
"""What fills the places of a remark's templates; numbers are written as the language does."""


class Severity(StrEnum):
    """How grave a finding is: an error is a fault of the drawing, a warning is advice."""

    ERROR = "error"
    WARNING = "warning"


class Remark(NamedTuple):
    """One code: how grave, and in which unit its numbers are (код замечания)."""

    severity: Severity
    unit: str


_ERROR, _WARNING = Severity.ERROR, Severity.WARNING

REMARKS: Mapping[str, Remark] = MappingProxyType(
    {
        "PM-D01": Remark(_ERROR, "mm²"),
        "PM-D02": Remark(_ERROR, "mm"),
        "PM-D03": Remark(_ERROR, "mm"),
        "PM-D04": Remark(_ERROR, "mm"),
        "PM-D05": Remark(_ERROR, "mm"),
        "PM-D06": Remark(_ERROR, ""),
        "PM-D07": Remark(_ERROR, "mm"),
        "PM-D08": Remark(_WARNING, "mm"),
        "PM-D09": Remark(_ERROR, ""),
        "PM-D10": Remark(_WARNING, "%"),
        "PM-D11": Remark(_ERROR, "mm"),
        "PM-D12": Remark(_WARNING, "mm"),
        "PM-D13": Remark(_ERROR, "mm"),
    }
)
"""Every code."""


def number_text(value: float, lang: str, decimals: int | None = None) -> str:
    """Return a number with the decimal sign of a language."""
    text = f"{value:g}" if decimals is None else f"{value:.{decimals}f}"
    return text.replace(".", language(lang).say.decimal)


def unit_text(unit: str, lang: str) -> str:
    """Return a unit of a remark in a language."""
    return plain_text(language(lang).say.units.get(unit, unit))


def limit_text(limit: float, lang: str) -> str:
    """Return a limit, no more than two digits after the decimal sign and no zeros."""
    return number_text(round(limit, 2), lang)


def unlike(value: float, limit: float, lang: str, decimals: int) -> str:
    """Return a number with as many decimals, up to three, as tell it from a limit."""
    while decimals < 3 and round(value, decimals) == round(limit, decimals):
        decimals += 1
    return number_text(value, lang, decimals)


def place_text(where: complex, lang: str) -> str:
    """Return a place on the sheet: ``(50.0, 50.0) mm``, ``(50,0; 50,0) мм``."""
    x, y = (number_text(part, lang, 1) for part in (where.real, where.imag))
    return language(lang).control.place.format(x=x, y=y)


def paper_text(name: str, lang: str) -> str:
    """Return the name of a format as a language writes it: ``А3 (книжная)``."""
    words = language(lang).frame
    paper = FORMATS[name].written(words.paper)
    return words.portrait.format(paper=paper) if name.endswith(":portrait") else paper


def _fact(fact: str | float | Segments, limit: float, lang: str) -> str:
    if isinstance(fact, str):
        return paper_text(fact, lang) if fact in FORMATS else fact
    if isinstance(fact, tuple):
        mm = unit_text("mm", lang)
        return ", ".join(f"{name} {unlike(length, limit, lang, 1)} {mm}" for name, length in fact)
    return number_text(fact, lang)


def _filled(
    template: str, where: complex, value: float, limit: float, facts: Facts, lang: str
) -> str:
    places = {key: _fact(fact, limit, lang) for key, fact in facts.items()}
    if "thing" in places:
        places["thing"] = thing_text(places["thing"], language(lang).control)
    places |= {
        "place": place_text(where, lang),
        "value": number_text(value, lang, 2),
        "limit": limit_text(limit, lang),
    }
    return template.format_map(places)


def what(
    code: str, where: complex, value: float, limit: float, facts: Facts, *, lang: str = "en"
) -> str:
    """Return what a finding says, where and with which numbers."""
    return _filled(language(lang).control.remarks[code].what, where, value, limit, facts, lang)


def action(
    code: str, where: complex, value: float, limit: float, facts: Facts, *, lang: str = "en"
) -> str:
    """Return what to do about a finding."""
    said = language(lang).control.remarks[code]
    template = said.actions[str(facts.get("advice", ""))]
    return _filled(template, where, value, limit, facts, lang)
