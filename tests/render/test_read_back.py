"""One segment, one number: what the calculation says is what a ruler finds on the sheet."""

from __future__ import annotations

import re

import numpy as np
import pytest
from cases import thinned
from reading import Path, read_svg
from worked import PROBLEMS, SIX, problem_of

from planmethod.note.narrate.calculation import calculation
from planmethod.note.plaintext import plain_text
from planmethod.note.wording import language
from planmethod.plans.model import PlanKind
from planmethod.render.backends import render
from planmethod.render.sheets.kinematics import kinematics_sheets
from planmethod.solved.solution import Solution

LAID_OFF = re.compile(r"\(([^() ]+)\) = [^;]*?([\d.]+) мм")
READ = re.compile(r"μ_?[va]·\(([^()]+)\) = [\d./]+·([\d.]+)")
INVERSE = re.compile(r"= \(([^()]+)\)/μ_?[va] = ([\d.]+)/")  # where the scale is mm per unit
OTHERS = [
    f"{folder}/{path.stem}"
    for folder in ("levers", "linkages")
    for path in sorted((PROBLEMS / folder).glob("*.toml"))
    if not path.stem.endswith("variants") and f"{folder}/{path.stem}" not in SIX
]
CASES = [(name, layout) for name in SIX for layout in ("one-position", "homework")]
CASES += [(name, "one-position") for name in thinned(OTHERS, 12)]


@pytest.mark.parametrize(("name", "layout"), CASES)
def test_a_ruler_finds_on_the_sheet_what_the_calculation_says(name: str, layout: str) -> None:
    """The vectors are found in the SVG, from tail to tip, and compared with every number."""
    problem = problem_of(name)
    at = problem.drive.positions[:1]
    sheet = kinematics_sheets(problem, layout=layout, positions=at)[0]
    page = read_svg(render(sheet, "svg"))
    inked = np.array([z for path in page.items if isinstance(path, Path) for z in path.corners])
    solution, compared = Solution(problem, positions=at), 0
    for view in sheet.views:
        if view.kind == "position":
            continue
        on_sheet = {span.name: span for span in view.spans}
        for span in view.spans:
            if span.length > 1.0:
                for end in (span.start, span.end):
                    assert np.abs(inked - end).min() < 0.01
        if solution.scales[PlanKind(view.kind)].per_mm != pytest.approx(view.per_mm):
            continue  # grown: the calculation of that sheet is of its own scale
        for line in calculation(solution, PlanKind(view.kind), 0, language("ru")):
            said = plain_text(line).replace(",", ".")
            for letters, value in (
                *LAID_OFF.findall(said),
                *READ.findall(said),
                *INVERSE.findall(said),
            ):
                if letters in on_sheet:
                    span = on_sheet[letters]  # on an enlarged view the ruler is so much finer
                    length = float(value) * span.share
                    assert span.length == pytest.approx(length, abs=0.2501), said
                    compared += 1
    assert compared >= 5 or layout == "homework"
