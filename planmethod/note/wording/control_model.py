"""What a language must be able to say of the norm control (слова нормоконтроля)."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class Said(Struct, frozen=True):
    """A remark in one language, templates of `str.format`.

    Besides its own places each may name ``place``, ``value`` and ``limit``. ``actions`` is what to
    do next; where it depends on the finding its fact ``advice`` is the key.
    """

    title: str
    what: str
    actions: Mapping[str, str]


class ControlWording(Struct, frozen=True, kw_only=True):
    """Remarks and the lines of the report in one language.

    Attributes
    ----------
    remarks : mapping
        By code.
    severities : mapping
        By the values of `planmethod.render.control.remarks.Severity`.
    place : str
        A place on the sheet.
    views : mapping
        Views and the rest of a sheet, by the names of `planmethod.render.ink.drawing.View`.
    pens, lines : mapping
        By the values of `planmethod.render.ink.drawing.Pen`: in what an inscription lies on, and
        lines with dashes, of which a remark may be made by themselves.
    things : mapping
        What an inscription lies on: a stroke, an arc, a filled area, a disc.
    sheet, clean, counts, position, numbers, action : str
        Lines of the report.
    """

    remarks: Mapping[str, Said]
    severities: Mapping[str, str]
    place: str
    views: Mapping[str, str]
    pens: Mapping[str, str]
    lines: Mapping[str, str]
    things: Mapping[str, str]
    sheet: str
    clean: str
    counts: str
    position: str
    numbers: str
    action: str
