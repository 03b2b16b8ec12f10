"""Norm control of a problem's sheets: findings, and scales that would mend them, tried out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from planmethod.construct.drafting import PROFILES, Profile
from planmethod.construct.scale import series_near
from planmethod.errors import PlanMethodError
from planmethod.mechanism.structure import analyse
from planmethod.note.numbers import trimmed
from planmethod.problem.model import Convention, Problem
from planmethod.render.drawing import Bounds, Drawing, Span, Text, View
from planmethod.render.frame import FORMATS
from planmethod.render.lint import Finding
from planmethod.render.normcontrol import SHORTEST, inspect
from planmethod.render.sheets.composition.model import Composition
from planmethod.render.sheets.kinematics import kinematics_sheets
from planmethod.render.sheets.structure import structure_sheet

LARGEST = 20.0
"""A segment that so large a plan shows no better is nothing in that position."""

_KEYS = {"velocity": "mu_v", "acceleration": "mu_a"}


@dataclass(frozen=True, slots=True)
class Controlled:
    """One sheet and what the norm control says of it."""

    drawing: Drawing
    paper: str
    findings: tuple[Finding, ...]


def paper_of(drawing: Drawing) -> str:
    """Return the name of a sheet's format."""
    sizes = {(fmt.width, fmt.height): name for name, fmt in FORMATS.items()}
    return sizes[drawing.width, drawing.height]


def controlled_structure(
    problem: Problem, *, paper: str | None = None, fields: Mapping[str, str] | None = None
) -> list[Controlled]:
    """Draw the structural sheet and look it over."""
    drawing = structure_sheet(problem, analyse(problem.mechanism), paper=paper, fields=fields)
    return [Controlled(drawing, paper_of(drawing), tuple(inspect(drawing)))]


def controlled_kinematics(
    problem: Problem,
    *,
    paper: str | None = None,
    positions: Sequence[float] | None = None,
    profile: Profile = PROFILES["board"],
    fields: Mapping[str, str] | None = None,
    errors: bool = False,
    sigma: bool = False,
    layout: str | Path | Composition | None = None,
) -> list[Controlled]:
    """Draw the sheets of the kinematic analysis and look them over.

    Where segments of a plan are too short, the next scale of the series that makes them long enough
    is tried on the same paper, by drawing the sheets with it.

    Raises
    ------
    PlanMethodError
        When the sheets cannot be drawn.
    """

    def draw(asked: Problem, on: str | None) -> list[Drawing]:
        return kinematics_sheets(
            asked,
            paper=on,
            positions=positions,
            profile=profile,
            fields=fields,
            errors=errors,
            sigma=sigma,
            layout=layout,
        )

    drawings = draw(problem, paper)
    tried: dict[tuple[str, float], list[Drawing] | None] = {}

    def fits(finding: Finding, key: str, per_mm: float, times: float, view: View) -> bool:
        """Tell whether the plan, drawn with another scale, has no short segments on this paper."""
        name = paper_of(drawings[0])
        if not _has_room(view.box, times, FORMATS[name].inner):
            return False
        if (key, per_mm) not in tried:
            v, a = problem.scales.mu_v, problem.scales.mu_a
            v, a = (per_mm, a) if key == "mu_v" else (v, per_mm)
            other = replace(problem, scales=replace(problem.scales, mu_v=v, mu_a=a))
            try:
                tried[key, per_mm] = draw(other, name)
            except PlanMethodError:
                tried[key, per_mm] = None
        made = tried[key, per_mm]
        if made is None or len(made) != len(drawings) or _told(made) != _told(drawings):
            return False
        spans = _spans(made, finding)
        return bool(spans) and min(span.length for span in spans) >= SHORTEST - 1e-6

    def advised(finding: Finding, drawing: Drawing) -> Finding:
        if finding.code != "PM-D08" or finding.view not in _KEYS:
            return finding
        view = next(v for v in drawing.views if v.kind == finding.view)
        key, inverse = _KEYS[view.kind], problem.scales.convention is Convention.MM_PER_UNIT
        now = view.per_mm * finding.value / SHORTEST
        per_mm = 1.0 / series_near(1.0 / now, up=True) if inverse else series_near(now, up=False)
        written = trimmed(1.0 / per_mm if inverse else per_mm)
        times = view.per_mm / per_mm
        fitting = times <= LARGEST and fits(finding, key, per_mm, times, view)
        advice = {
            "advice": "scale" if fitting else "own" if times <= LARGEST else "nothing",
            "key": key,
            "scale": written,
            "paper": paper_of(drawing),
        }
        return replace(finding, facts={**finding.facts, **advice})

    return [
        Controlled(
            drawing,
            paper_of(drawing),
            tuple(advised(finding, drawing) for finding in inspect(drawing)),
        )
        for drawing in drawings
    ]


def _has_room(box: Bounds, times: float, inner: Bounds) -> bool:
    """Tell whether a view so many times larger can be on the paper at all.

    Its letters do not grow with it, so that a view a little too large is still drawn to see.
    """
    width, height = times * (box[2] - box[0]), times * (box[3] - box[1])
    room = (inner[2] - inner[0], inner[3] - inner[1])
    return 0.6 * width <= room[0] and 0.6 * height <= room[1]


def _told(drawings: Sequence[Drawing]) -> int:
    """Return how many calculations are beside the plans: a scale is not to push them out."""
    texts = (item for drawing in drawings for item in drawing.items if isinstance(item, Text))
    return sum(text.text.startswith("Расчёт") for text in texts)


def _spans(drawings: Sequence[Drawing], finding: Finding) -> list[Span]:
    return [
        span
        for drawing in drawings
        for view in drawing.views
        if view.kind == finding.view
        for span in view.spans
        if finding.position in (None, span.position)
    ]
