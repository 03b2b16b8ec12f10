"""Findings of the norm control as text and as a record (отчёт нормоконтроля)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from planmethod.problem.model import Problem
from planmethod.render.control.remarks import (
    LANGUAGES,
    REMARKS,
    SEVERITIES,
    UNITS,
    Severity,
    UnknownRemarkError,
    limit_text,
    russian_paper,
    unlike,
)
from planmethod.render.control.texts import Finding
from planmethod.render.control.words import PLACES
from planmethod.render.sheets.controlled import Controlled

_SHEET = {"ru": "лист {number} из {count}, {paper}", "en": "sheet {number} of {count}, {paper}"}
_CLEAN = {"ru": "замечаний нет", "en": "no findings"}
_COUNTS = {
    "ru": "ошибок {errors}, предупреждений {warnings}",
    "en": "errors {errors}, warnings {warnings}",
}
_POSITION = {"ru": ", положение {number}", "en": ", position {number}"}
_NUMBERS = {
    "ru": "; {value} {unit}, предел {limit} {unit}",
    "en": "; {value} {unit}, limit {limit} {unit}",
}
_NEXT = {"ru": "Что делать: ", "en": "Next: "}


def counted(sheets: Sequence[Controlled], severity: Severity) -> int:
    """Return how many findings of a severity there are."""
    return sum(f.severity is severity for sheet in sheets for f in sheet.findings)


def control_text(name: str, sheets: Sequence[Controlled], lang: str = "ru") -> str:
    """Return the findings of a problem's sheets as lines for a terminal.

    Raises
    ------
    UnknownRemarkError
        When nobody speaks the language here.
    """
    if lang not in LANGUAGES:
        raise UnknownRemarkError(
            f"No remarks in the language {lang!r}. Choose one of: {', '.join(LANGUAGES)}."
        )
    lines: list[str] = []
    for number, sheet in enumerate(sheets, 1):
        paper = russian_paper(sheet.paper) if lang == "ru" else sheet.paper
        head = _SHEET[lang].format(number=number, count=len(sheets), paper=paper)
        errors, warnings = (counted([sheet], severity) for severity in Severity)
        told = _COUNTS[lang].format(errors=errors, warnings=warnings)
        lines.append(f"{name}: {head}: {told if sheet.findings else _CLEAN[lang]}")
        for finding in sheet.findings:
            lines += _lines(finding, lang)
    return "\n".join(lines)


def _lines(finding: Finding, lang: str) -> list[str]:
    unit = UNITS[lang][REMARKS[finding.code].unit]
    place = PLACES[lang][finding.view]
    if finding.position is not None:
        place += _POSITION[lang].format(number=finding.position)
    if unit:
        value = unlike(finding.value, finding.limit, lang, 2)
        limit = limit_text(finding.limit, lang)
        place += _NUMBERS[lang].format(value=value, limit=limit, unit=unit)
    return [
        f"  {finding.code} {SEVERITIES[lang][finding.severity]}: {place}",
        f"    {finding.what(lang)}.",
        f"    {_NEXT[lang]}{finding.action(lang)}",
    ]


def control_record(
    problem: Problem, kind: str, sheets: Sequence[Controlled], lang: str = "ru"
) -> dict[str, Any]:
    """Return the findings of a problem's sheets as one object for JSON."""
    return {
        "schema": 1,
        "problem": problem.name,
        "variant": problem.variant,
        "kind": kind,
        "errors": counted(sheets, Severity.ERROR),
        "warnings": counted(sheets, Severity.WARNING),
        "sheets": [
            {
                "number": number,
                "paper": sheet.paper,
                "findings": [_finding_record(finding, lang) for finding in sheet.findings],
            }
            for number, sheet in enumerate(sheets, 1)
        ],
    }


def _finding_record(finding: Finding, lang: str) -> dict[str, Any]:
    remark = REMARKS[finding.code]
    return {
        "code": finding.code,
        "severity": finding.severity.value,
        "title": remark.said[lang].title,
        "what": finding.what(lang),
        "where": {
            "view": finding.view or "sheet",
            "position": finding.position,
            "x": finding.where.real,
            "y": finding.where.imag,
        },
        "value": finding.value,
        "limit": finding.limit,
        "unit": remark.unit,
        "action": finding.action(lang),
        "facts": dict(finding.facts),
    }
