"""Findings of the norm control as text and as a record (отчёт нормоконтроля)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from planmethod.note.wording import get_language
from planmethod.render.control.remarks import (
    REMARKS,
    Finding,
    Severity,
    format_distinct,
    limit_text,
    paper_text,
    unit_text,
)
from planmethod.render.sheets.controlled import CheckedSheet


def counted(sheets: Sequence[CheckedSheet], severity: Severity) -> int:
    """Return the number of findings of a severity."""
    return sum(f.severity is severity for sheet in sheets for f in sheet.findings)


def control_text(name: str, sheets: Sequence[CheckedSheet], lang: str = "ru") -> str:
    """Return the findings of a problem's sheets as lines for a terminal.

    Raises
    ------
    UnknownLanguageError
        When the language is unknown.
    """
    texts, lines = get_language(lang).control, []
    for number, sheet in enumerate(sheets, 1):
        paper = paper_text(sheet.paper, lang)
        head = texts.sheet.format(number=number, count=len(sheets), paper=paper)
        errors, warnings = (counted([sheet], severity) for severity in Severity)
        text = texts.counts.format(errors=errors, warnings=warnings)
        lines.append(f"{name}: {head}: {text if sheet.findings else texts.clean}")
        for finding in sheet.findings:
            lines += _lines(finding, lang)
    return "\n".join(lines)


def _lines(finding: Finding, lang: str) -> list[str]:
    texts, unit = get_language(lang).control, unit_text(REMARKS[finding.code].unit, lang)
    place = texts["views"][finding.view]
    if finding.position is not None:
        place += texts.position.format(number=finding.position)
    if unit:
        value = format_distinct(finding.value, finding.limit, lang, 2)
        limit = limit_text(finding.limit, lang)
        place += texts.numbers.format(value=value, limit=limit, unit=unit)
    return [
        f"  {finding.code} {texts['severities'][finding.severity.value]}: {place}",
        f"    {finding.describe(lang)}.",
        f"    {texts.action.format(action=finding.action(lang))}",
    ]


def control_record(
    name: str, variant: str | None, kind: str, sheets: Sequence[CheckedSheet], lang: str = "ru"
) -> dict[str, Any]:
    """Return the findings of a problem's sheets as one object for JSON."""
    return {
        "schema": 1,
        "problem": name,
        "variant": variant,
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
        "title": get_language(lang).control["remarks"][finding.code].title,
        "what": finding.describe(lang),
        "where": {
            "view": finding.view or "sheet",
            "position": finding.position,
            "x": finding.place.real,
            "y": finding.place.imag,
        },
        "value": finding.value,
        "limit": finding.limit,
        "unit": remark.unit,
        "action": finding.action(lang),
        "facts": dict(finding.facts),
    }
