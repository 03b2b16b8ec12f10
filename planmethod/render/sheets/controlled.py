"""Norm control of a problem's sheets: findings, scales that would fix them, the report."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import product
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.scale import series_near
from planmethod.errors import PlanMethodError
from planmethod.note.numbers import trimmed
from planmethod.note.wording import get_language
from planmethod.problem.model import Convention, Problem
from planmethod.render.control.remarks import (
    REMARKS,
    Finding,
    Severity,
    format_distinct,
    limit_text,
    paper_text,
    unit_text,
)
from planmethod.render.control.sheet import LARGEST, SHORTEST, inspect
from planmethod.render.frame import FORMATS
from planmethod.render.ink.drawing import Bounds, Drawing, Span, View
from planmethod.render.sheets.kinematics import kinematics_sheets
from planmethod.render.sheets.structure import structure_sheet
from planmethod.solved.assembly_modes import structure_of

KEYS = {"velocity": "mu_v", "acceleration": "mu_a", "forces": "mu_F"}
"""Keys of ``[scales]`` by the kind of view."""


class CheckedSheet(Struct, frozen=True):
    """One sheet and its findings of the norm control."""

    drawing: Drawing
    paper: str
    findings: tuple[Finding, ...]


def paper_of(drawing: Drawing) -> str:
    """Return the name of a sheet's format."""
    sizes = {(fmt.width, fmt.height): name for name, fmt in FORMATS.items()}
    return sizes[drawing.width, drawing.height]


def controlled_structure(
    problem: Problem, *, paper: str | None = None, fields: Mapping[str, str] | None = None
) -> list[CheckedSheet]:
    """Draw the structural sheet and check it."""
    drawing = structure_sheet(problem, structure_of(problem), paper=paper, fields=fields)
    return check_drawings([drawing])


def check_drawings(drawings: Sequence[Drawing], scales: str = "[scales]") -> list[CheckedSheet]:
    """Check sheets without trying other scales. ``scales`` is their key in the file."""
    own = {} if scales == "[scales]" else {"scales": scales}

    def find_all(drawing: Drawing) -> tuple[Finding, ...]:
        return tuple(replace(one, facts={**one.facts, **own}) for one in inspect(drawing))

    return [CheckedSheet(one, paper_of(one), find_all(one)) for one in drawings]


def controlled_kinematics(
    problem: Problem, draw: Callable[..., list[Drawing]] = kinematics_sheets
) -> list[CheckedSheet]:
    """Draw the sheets of the kinematic analysis and check them.

    ``draw`` is `kinematics_sheets`, with its options bound.
    Where segments of a plan are too short, the next scale of the series that makes them long enough
    is tried on the same paper, by drawing the sheets with it.

    Raises
    ------
    PlanMethodError
        When the sheets cannot be drawn.
    """
    drawings = draw(problem)
    trial = _Trial(problem, drawings, partial(draw, advised=False))
    return [
        CheckedSheet(
            drawing,
            paper_of(drawing),
            tuple(trial.advised(finding) for finding in inspect(drawing)),
        )
        for drawing in drawings
    ]


class _Trial:
    """Scales that would make short segments long enough, tried by drawing the sheets with them.

    Parameters
    ----------
    problem : Problem
    drawings : list of Drawing
        Its present sheets.
    draw : callable
        Draws a problem on the ``paper`` of that name.
    """

    def __init__(
        self,
        problem: Problem,
        drawings: list[Drawing],
        draw: Callable[..., list[Drawing]],
    ) -> None:
        self.problem, self.drawings, self.draw = problem, drawings, draw
        self.paper = paper_of(drawings[0])
        self._tried: dict[tuple[str, float], list[Drawing] | None] = {}

    def advised(self, finding: Finding) -> Finding:
        """Return a finding of short segments with the scale that fixes it.

        All plans of a kind share a scale: for several plans in a position, such as force plans, the
        scale that fixes all is given, if any, otherwise the one for the plan itself.
        """
        if finding.code != "PM-D08" or finding.view not in KEYS:
            return finding
        key = KEYS[finding.view]
        views = _views(self.drawings, finding.view)
        number = next(k for k, view in enumerate(views) if _has(view, finding))
        own = views[number : number + 1]
        now = own[0].per_mm / _spans(own, finding)[0].magnification
        per_mm, written = self._sufficient_scale(now, finding.value)
        advice = "nothing"
        if now / per_mm <= LARGEST:
            advice = "own"
            # At another scale the hand draws a segment a little longer or shorter.
            groups = ((views, slice(None)), (own, slice(number, number + 1)))
            for (group, chosen), sure in product(groups, (1.0, 0.95)):
                found = _spans(group, finding)
                spans = [span for span in found if span.length * LARGEST >= SHORTEST]
                least = min(span.length for span in spans)
                wanted, text = self._sufficient_scale(now, sure * least)
                names = frozenset(span.name for span in spans)
                if self._scale_fits(finding, key, wanted, chosen, names):
                    advice, written = "scale", text
                    break
        facts = {"advice": advice, "key": key, "scale": written, "paper": self.paper}
        return replace(finding, facts={**finding.facts, **facts})

    def _sufficient_scale(self, per_mm: float, length: float) -> tuple[float, str]:
        """Return the coarsest scale of the series that makes a segment long enough, and its text.

        The scale is in unit per mm, the text as the file has it.
        """
        now = per_mm * length / SHORTEST
        if self.problem.scales.convention is Convention.MM_PER_UNIT:
            times = series_near(1.0 / now, up=True)
            return 1.0 / times, trimmed(times)
        scale = series_near(now, up=False)
        return scale, trimmed(scale)

    def _scale_fits(
        self, finding: Finding, key: str, per_mm: float, chosen: slice, names: frozenset[str]
    ) -> bool:
        """Return whether at another scale the named segments of plans are long enough, and fit."""
        views = _views(self.drawings, finding.view)
        inner = FORMATS[self.paper].inner
        if not all(_view_fits(view, view.per_mm / per_mm, inner) for view in views):
            return False
        made = self._drawn(key, per_mm)
        # A scale must not displace the blocks beside the plans.
        if made is None or _list_omissions(made) != _list_omissions(self.drawings):
            return False
        found = _spans(_views(made, finding.view)[chosen], finding)
        lengths = [span.length for span in found if span.name in names]
        return bool(lengths) and min(lengths) >= SHORTEST - 1e-6

    def _drawn(self, key: str, per_mm: float) -> list[Drawing] | None:
        """Return the sheets with another scale, or None where they cannot be drawn."""
        if (key, per_mm) not in self._tried:
            named: dict[str, Any] = {key: per_mm}
            scales = replace(self.problem.scales, **named)
            try:
                made = self.draw(replace(self.problem, scales=scales), paper=self.paper)
            except PlanMethodError:
                made = None
            self._tried[key, per_mm] = made
        return self._tried[key, per_mm]


def _views(drawings: Sequence[Drawing], kind: str) -> list[View]:
    return [view for drawing in drawings for view in drawing.views if view.kind == kind]


def _has(view: View, finding: Finding) -> bool:
    """Return whether a finding of short segments belongs to a view."""
    spans = _spans([view], finding)
    return any((span.start + span.end) / 2 == finding.place for span in spans)


def _view_fits(view: View, times: float, inner: Bounds) -> bool:
    """Return whether a view enlarged ``times`` can be on the paper at all.

    Its letters do not grow with it: for one plan only the segments are compared, for plans in rows
    the whole view, which is drawn for a trial even if a little too large.
    """
    (left, low, right, high), much = view.box, 0.6
    if len({span.position for span in view.spans}) == 1:
        ends = [end for span in view.spans for end in (span.start, span.end)]
        left, right = min(p.real for p in ends), max(p.real for p in ends)
        low, high, much = min(p.imag for p in ends), max(p.imag for p in ends), 1.0
    width, height = much * times * (right - left), much * times * (high - low)
    return width <= inner[2] - inner[0] and height <= inner[3] - inner[1]


def _list_omissions(drawings: Sequence[Drawing]) -> list[bool]:
    """Return for each sheet whether blocks were left out."""
    return [drawing.has_omissions for drawing in drawings]


def _spans(views: Sequence[View], finding: Finding) -> list[Span]:
    """Return the measured segments of views in the position of a finding."""
    return [
        span for view in views for span in view.spans if finding.position in (None, span.position)
    ]


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
