"""Remarks of the norm control (замечания нормоконтроля): codes, severities, findings, sentences."""

# no messages: mistakes in a program

from __future__ import annotations

import re
from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

from msgspec import Struct

from planmethod.note.document import plain_text
from planmethod.note.wording import MessageTable, get_language
from planmethod.paper import FORMATS
from planmethod.render.ink.drawing import Pen

Segments: TypeAlias = tuple[tuple[str, float], ...]
"""Letters and lengths of segments, mm."""

Facts: TypeAlias = Mapping[str, str | float | Segments]
"""Values for the templates of a remark; numbers are formatted for the language."""


class Severity(StrEnum):
    """Severity of a finding: an error is a fault of the drawing, a warning is advice."""

    ERROR = "error"
    WARNING = "warning"


class Remark(NamedTuple):
    """One code: its severity and the unit of its numbers (код замечания)."""

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
        "PM-D14": Remark(_WARNING, "mm"),
        "PM-D15": Remark(_WARNING, "mm"),
        "PM-D16": Remark(_WARNING, "mm"),
        "PM-D17": Remark(_WARNING, ""),
        "PM-D18": Remark(_WARNING, "%"),
        "PM-D19": Remark(_WARNING, "%"),
        "PM-D20": Remark(_WARNING, "mm"),
        "PM-D21": Remark(_WARNING, "mm"),
        "PM-D22": Remark(_ERROR, "mm"),
        "PM-D23": Remark(_WARNING, "mm"),
        "PM-D24": Remark(_WARNING, ""),
    }
)
"""Every code."""


def number_text(value: float, lang: str, decimals: int | None = None) -> str:
    """Return a number with the decimal sign of a language."""
    text = f"{value:g}" if decimals is None else f"{value:.{decimals}f}"
    return text.replace(".", get_language(lang).notation.decimal)


def unit_text(unit: str, lang: str) -> str:
    """Return a unit of a remark in a language."""
    return plain_text(get_language(lang).notation.units.get(unit, unit))


def limit_text(limit: float, lang: str) -> str:
    """Return a limit, no more than two digits after the decimal sign and no zeros."""
    return number_text(round(limit, 2), lang)


def format_distinct(value: float, limit: float, lang: str, decimals: int) -> str:
    """Return a number with as many decimals, up to three, as distinguish it from a limit."""
    while decimals < 3 and round(value, decimals) == round(limit, decimals):
        decimals += 1
    return number_text(value, lang, decimals)


def place_text(place: complex, lang: str) -> str:
    """Return a place on the sheet: ``(50.0, 50.0) mm``, ``(50,0; 50,0) мм``."""
    x, y = (number_text(part, lang, 1) for part in (place.real, place.imag))
    return get_language(lang).control.place.format(x=x, y=y)


def paper_text(name: str, lang: str) -> str:
    """Return the name of a format as a language writes it: ``А3 (книжная)``."""
    texts = get_language(lang).frame
    paper = FORMATS[name].written(texts.paper)
    return texts.portrait.format(paper=paper) if name.endswith(":portrait") else paper


def _fact(fact: str | float | Segments, limit: float, lang: str) -> str:
    if isinstance(fact, str):
        return paper_text(fact, lang) if fact in FORMATS else fact
    if isinstance(fact, tuple):
        mm = unit_text("mm", lang)
        return ", ".join(
            f"{name} {format_distinct(length, limit, lang, 1)} {mm}" for name, length in fact
        )
    return number_text(fact, lang)


def obstacle_text(name: str, texts: MessageTable) -> str:
    """Return the name of an obstacle (``stroke main``), or of a line by itself (``line axis``)."""
    kind, _, rest = name.partition(" ")
    # The names of pens may have a space, as may the tags that follow them.
    pen = max((p for p in Pen if f"{rest} ".startswith(f"{p.value} ")),
              key=lambda p: len(p.value), default=None)  # fmt: skip
    tag = rest if pen is None else rest[len(pen.value) :].strip()
    said = _tag_text(tag, texts["tags"])
    text = f" ({said})" if said else ""
    if kind == "line":
        assert pen is not None, f"a line without a pen: {name}"
        line: str = texts["lines"][pen.value]
        return line + text
    thing: str = texts["things"][kind]
    return thing.format(pen="" if pen is None else texts["pens"][pen.value]) + text


def _tag_text(tag: str, words: Mapping[str, str]) -> str:
    """Return the tag of an item in a language: ``кривая M``; letters only where it has no words."""
    for tagged in sorted(words, key=len, reverse=True):
        if f"{tag} ".startswith(f"{tagged} "):
            return f"{words[tagged]}{tag[len(tagged) :]}"
    return " ".join(word for word in tag.split() if not re.fullmatch("[a-z-]{2,}", word))


class Finding(Struct, frozen=True):
    """One finding of the norm control (замечание).

    Attributes
    ----------
    code : str
        One of `REMARKS`.
    place : complex, mm
        Place on the sheet, from its lower left corner.
    value, limit : float
        Measured and permitted value: mm, mm² for overlaps, per cent for unused paper.
    facts : mapping
        Further values for the sentences of the code.
    view : str
        Kind of the view with the finding, ``stamp``, or empty.
    position : int, optional
        Number of the position whose plan has the finding.
    """

    code: str
    place: complex
    value: float
    limit: float
    facts: Facts
    view: str = ""
    position: int | None = None

    @property
    def severity(self) -> Severity:
        """Severity by its code."""
        return REMARKS[self.code].severity

    @property
    def message(self) -> str:
        """Fault, place and numbers in English."""
        return self.describe("en")

    def describe(self, lang: str) -> str:
        """Return the fault, its place and numbers in a language."""
        return self._filled(get_language(lang).control["remarks"][self.code].what, lang)

    def action(self, lang: str) -> str:
        """Return the advice of the finding in a language."""
        actions = get_language(lang).control["remarks"][self.code]["actions"]
        return self._filled(actions[str(self.facts.get("advice", ""))], lang)

    def _filled(self, template: str, lang: str) -> str:
        places = {"scales": "[scales]"}
        places |= {key: _fact(fact, self.limit, lang) for key, fact in self.facts.items()}
        if "thing" in places:
            places["thing"] = obstacle_text(places["thing"], get_language(lang).control)
        places |= {
            "place": place_text(self.place, lang),
            "value": number_text(self.value, lang, 2),
            "limit": limit_text(self.limit, lang),
        }
        return template.format_map(places)
