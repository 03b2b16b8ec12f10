"""One segment, one number: the calculation has the length that a ruler finds on the sheet."""

from __future__ import annotations

import re

import numpy as np
import pytest
from cases import thinned
from doors import (
    ARM,
    Drawing,
    ForceReading,
    PlanKind,
    Stroke,
    View,
    calculation,
    drawn_edges,
    get_language,
    kinematics_sheets,
    plain_text,
    pose,
    render,
)
from lettered import closing_lines, lever_lines, moment_lines
from reading import Path, read_svg
from worked import PROBLEMS, SIX, problem_of, solved_while

from benchmarks.sheets import positions_of

LAID_OFF = re.compile(r"\(([^() ]+)\) = [^;]*?([\d.]+) мм")
READ = re.compile(r"μ_?[va]·\(([^()]+)\) = [\d./]+·([\d.]+)")
INVERSE = re.compile(r"= \(([^()]+)\)/μ_?[va] = ([\d.]+)/")  # where the scale is mm per unit
OTHERS = [
    f"{folder}/{path.stem}"
    for folder in ("levers", "linkages")
    for path in sorted((PROBLEMS / folder).glob("*.toml"))
    if not path.stem.endswith("variants") and f"{folder}/{path.stem}" not in SIX
]
LOADED = [name for name in OTHERS if problem_of(name).dynamics is not None]
CASES = [(name, layout) for name in SIX for layout in ("one-position", "homework")]
CASES += [(name, "one-position") for name in thinned(OTHERS, 12)]


@pytest.mark.parametrize(("name", "layout"), CASES)
def test_a_ruler_on_the_sheet_reads_the_calculated_values(
    name: str, layout: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The vectors are found in the SVG, from tail to tip, and compared with every number."""
    problem = pose(problem_of(name))
    at = problem.drive.positions[:1]
    (sheet, *_), solution = solved_while(
        lambda: kinematics_sheets(problem, layout=layout, positions=at), monkeypatch
    )
    page = read_svg(render(sheet, "svg"))
    inked = np.array([z for path in page.items if isinstance(path, Path) for z in path.corners])
    compared = 0
    for view in sheet.views:
        if view.kind == "position":
            continue
        on_sheet = {span.name: span for span in view.spans}
        for span in view.spans:
            if span.length > 1.0:
                for end in (span.start, span.end):
                    assert np.abs(inked - end).min() < 0.01
        assert solution.scales[PlanKind(view.kind)].per_mm == pytest.approx(view.per_mm)
        for line in calculation(solution, PlanKind(view.kind), 0, get_language("ru")):
            said = plain_text(line).replace(",", ".")
            for letters, value in (
                *LAID_OFF.findall(said),
                *READ.findall(said),
                *INVERSE.findall(said),
            ):
                if letters in on_sheet:
                    span = on_sheet[letters]  # on an enlarged view the ruler is so much finer
                    length = float(value) * span.magnification
                    # The ruler reads to half a division; the number is printed to its last digit.
                    digit = 10.0 ** -len(value.partition(".")[2]) * span.magnification
                    assert span.length == pytest.approx(length, abs=0.2501 + digit / 2), said
                    compared += 1
    assert compared >= 5 or layout == "homework"


MANY: list[tuple[str, int, str | None]] = [
    (name, count, None) for name in (*thinned(SIX, 3), *thinned(OTHERS, 40)) for count in (3, 12)
]
MANY += [("press/press", 12, "coursework"), ("press/press", 12, "coursework-12")]
MANY += [("levers/task-49", 3, "compact")]
MANY += [(name, 1, "compact") for name in thinned(OTHERS, 60)]


@pytest.mark.dear
@pytest.mark.parametrize(("name", "count", "layout"), MANY)
def test_a_ruler_finds_it_in_each_of_many_positions(
    name: str, count: int, layout: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The calculation of each position has the scale at which its plan is drawn."""
    problem = problem_of(name)
    at = positions_of(problem, count)
    sheets, solution = solved_while(
        lambda: kinematics_sheets(problem, positions=at, layout=layout), monkeypatch
    )
    compared = 0
    for view in (view for sheet in sheets for view in sheet.views if view.kind != "position"):
        for index in {span.position or 0 for span in view.spans}:
            if solution.margin[index] < 1e-6:
                continue  # dead: a scale of 10¹² (m/s²)/mm
            # The magnification is that of the view, related to the common scale of the plans.
            coarser = solution.plan_scale(PlanKind(view.kind), index).per_mm / view.per_mm
            on_sheet = {span.name: span for span in view.spans if (span.position or 0) == index}
            for line in calculation(solution, PlanKind(view.kind), index, get_language("ru")):
                said = plain_text(line).replace(",", ".")
                laid_off = LAID_OFF.findall(said)  # follows from values read and rounded
                for letters, value in laid_off + READ.findall(said):
                    if letters in on_sheet:
                        span = on_sheet[letters]
                        said_mm = float(value) * span.magnification * coarser
                        most = max(0.2501, 0.015 * said_mm * ((letters, value) in laid_off))
                        assert span.length == pytest.approx(said_mm, abs=most), said
                        compared += 1
    assert compared >= 5 * count


FORCES = re.compile(r"([FФR]\S*) = ([\d.]+)[·/]")
ARMS = re.compile(r"h_(\S+) = ([\d.]+)")


FORCED = [(name, 1) for name in ("levers/six-link", *thinned(LOADED, 18))]
FORCED += [(name, 3) for name in ("press/press", *thinned(LOADED, len(LOADED))[1:])]


@pytest.mark.dear
@pytest.mark.parametrize(("name", "count"), FORCED)
def test_a_ruler_finds_the_forces_and_their_arms_on_links_and_lever(
    name: str, count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On the sheet of forces of each position, in the SVG: every number that a hand reads there."""
    problem = problem_of(name)
    at = positions_of(problem, count)
    sheets, solution = solved_while(
        lambda: kinematics_sheets(problem, layout="forces", positions=at), monkeypatch
    )
    assert len(sheets) == count
    for index, sheet in enumerate(sheets):
        assert _compared_forces(sheet, ForceReading(solution, index)) >= 5


def _compared_forces(sheet: Drawing, reading: ForceReading) -> int:
    """Compare forces and arms of a sheet with the calculation, return how many."""
    assert sheet.width in (594, 841)  # forces of few links are on A2
    page = read_svg(render(sheet, "svg"))
    inked = np.array([z for path in page.items if isinstance(path, Path) for z in path.corners])
    plans = [view for view in sheet.views if view.kind == "forces"]
    cuts = [view for view in sheet.views if view.kind == "position"][1:]
    arms = [i for i in sheet.items if isinstance(i, Stroke) and i.tag.startswith(f"{ARM} ")]
    compared, drawn = 0, iter(plans)

    def compare(text: str, said: float, start: complex, end: complex) -> None:
        nonlocal compared
        assert max(np.abs(inked - place).min() for place in (start, end)) < 0.01
        assert abs(end - start) == pytest.approx(said, abs=0.2501), text
        compared += 1

    def compare_arms(text: str, view: View) -> None:
        left, low, right, high = view.box
        here = [
            arm.points
            for arm in arms
            if left <= arm.points[0].real <= right and low <= arm.points[0].imag <= high
        ]
        for _, value in ARMS.findall(plain_text(text).replace(",", ".")):
            if float(value) > 3.5:
                nearest = min(here, key=lambda p: abs(abs(p[1] - p[0]) - float(value)))
                compare(text, float(value), *nearest)

    for number, plan in enumerate(reading.plans):
        for line in moment_lines(reading, plan):
            compare_arms(line, cuts[number])
        if not drawn_edges(reading, number):
            continue
        on_sheet = {span.name: span for span in next(drawn).spans}
        for line in closing_lines(reading, number):
            for letters, value in FORCES.findall(plain_text(line).replace(",", ".")):
                if letters in on_sheet:
                    span = on_sheet[letters]
                    compare(line, float(value), span.start, span.end)
    if reading.statics.lever_plan is not None:
        *_, view = (view for view in sheet.views if view.kind == "velocity")  # the lever
        for line in lever_lines(reading):
            compare_arms(line, view)
    return compared
