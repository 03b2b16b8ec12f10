"""Sheet 1 of a coursework: diagrams where the construction has them, and the whole sheet."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from cases import some
from doors import (
    AXIS,
    DRAFTING_PROFILES as PROFILES,
    EXTREME,
    PAPER_FORMATS as FORMATS,
    POINT_TAG,
    VIEW_KINDS,
    CycleTask,
    Diagrams,
    Differentiation,
    Disc,
    LayoutError,
    PoleDistances,
    Sampled,
    Solution,
    Stroke,
    composition,
    crank_cycle_of,
    cycle_record,
    diagrams_of,
    evaluate_evaluate as evaluate,
    extreme_construction,
    get_language,
    kinematic_picture,
    kinematics_sheets,
    lint,
    numbering,
    sigmas,
)
from msgspec.structs import replace
from texts import cycle_protocol
from worked import SIX, drawn_sheets, problem_of, solved_while

RU = get_language("ru")


@cache
def press(**asked: object) -> Solution:
    task = CycleTask("B", **asked)  # type: ignore[arg-type]
    return Solution(replace(problem_of("press/press"), cycle=task))


def diagrams(solution: Solution) -> Diagrams:
    found = diagrams_of(solution)
    assert found is not None
    return found


def test_the_points_of_the_diagrams_are_at_their_values() -> None:
    solution = press()
    told = cycle_record(solution)["diagrams"]
    items = kinematic_picture(diagrams(solution), 3.5, RU.notation).items
    levels = [
        item.points[0].imag
        for item in items
        if isinstance(item, Stroke) and item.tag == AXIS and item.points[0].real == 0
        and item.points[0].imag == item.points[1].imag
    ]  # fmt: skip
    for letter, key, start in (("v", "v_chord_mm", 7.5), ("a", "a_chord_mm", 0.0)):
        found = [
            i.centre for i in items if isinstance(i, Disc) and i.tag == f"{POINT_TAG} {letter}"
        ]
        level = min(levels, key=lambda y: abs(found[0].imag - told[key][0] - y))
        assert [p.imag - level for p in found] == pytest.approx(told[key], abs=1e-9)
        assert [p.real for p in found] == pytest.approx([start + 15.0 * k for k in range(12)])


@pytest.mark.parametrize("way", Differentiation)
def test_every_ray_is_parallel_to_its_chord(way: Differentiation) -> None:
    """The intercept of a ray over the pole distance is the slope of the path."""
    made = diagrams(press(differentiation=way, pole=PoleDistances(v=30.0)))
    s, v, _ = made.drawn(way)
    chords = np.diff(s) / 15.0
    tangents = (s[(np.arange(12) + 1) % 12] - s[(np.arange(12) - 1) % 12]) / 30.0
    expected = {
        Differentiation.CHORDS: 30.0 * chords,
        Differentiation.TANGENTS: 30.0 * tangents,
        Differentiation.CURVE: made.curve,
    }
    assert v == pytest.approx(expected[way], abs=1e-9)


def test_sigmas_of_the_ordinates_are_those_of_random_sheets() -> None:
    made = diagrams(press())
    graph = made.graph(Differentiation.CHORDS)
    pencil = Sampled(PROFILES["board"], frozenset(str(axes.origin) for axes in graph.axes), 4000, 3)
    trace = evaluate(graph.program, dict(graph.data), pencil)
    for number, sigma in enumerate(sigmas(made, Differentiation.CHORDS), 1):
        origin = trace.value[graph.axes[number].origin]
        drawn = [np.std((trace.value[p] - origin).imag) for p in graph.points[number]]
        assert sigma == pytest.approx(drawn, rel=0.06)


def test_the_protocol_has_poles_and_scales_in_both_languages() -> None:
    solution = press()
    for lang, words in (
        ("ru", ("Из полюса P_v (K₁ = 19,5 мм)", "по хордам")),
        ("en", ("From the pole", "from O₃ tangents to the circle of the radius l_O1A")),
    ):
        text = cycle_protocol(solution, lang)
        assert all(word in text for word in words), text
        assert "0.547" in text or "0,547" in text  # the greatest deviation of v by chords


@pytest.mark.parametrize("name", ["press/press", *SIX[: some(len(SIX), 0)]])
def test_the_sheet_is_one_a1_without_a_fault(name: str) -> None:
    (sheet,) = drawn_sheets(name, layout="coursework")
    fmt = FORMATS["A1"]
    assert (sheet.width, sheet.height) == (fmt.width, fmt.height)
    assert [f"{finding.code} {finding.message}" for finding in lint(sheet.items, fmt.inner)] == []
    assert {"position", "velocity", "acceleration", "diagram"} <= {v.kind for v in sheet.views}
    drawn = [item for item in sheet.items if item.tag == EXTREME]
    made = extreme_construction(Solution(problem_of(name)))
    assert len(drawn) == (0 if made is None else 2)


def test_of_one_position_its_own_plans_are_shown() -> None:
    (sheet,) = drawn_sheets("press/press", [30], layout="coursework")
    kinds = [view.kind for view in sheet.views]
    assert set(kinds) <= set(VIEW_KINDS)
    (plan,) = (view for view in sheet.views if view.kind == "acceleration")
    assert {span.position for span in plan.spans} <= {0, None} and plan.spans


EVEN = [float(phi) for phi in range(0, 360, 30)]


@pytest.mark.dear
@pytest.mark.parametrize("name", ["press/press", *SIX[: some(len(SIX), 1)]])
@pytest.mark.parametrize("sense", [1, -1])
def test_a_number_names_one_position_of_the_sheet(
    name: str, sense: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = [50.0 + sense * phi for phi in EVEN]
    _, solution = solved_while(
        lambda: kinematics_sheets(problem_of(name), positions=asked, layout="coursework"),
        monkeypatch,
    )
    assert solution.positions.tolist() == asked
    assert crank_cycle_of(solution).positions == pytest.approx(np.array(asked), abs=1e-9)
    assert solution.problem.numbered == pytest.approx(tuple(asked), abs=1e-9)


def test_positions_that_the_cycle_does_not_number_are_rejected() -> None:
    problem = problem_of("press/press")
    for asked in ([20.0, 140.0, 260.0], [0.0, 10.0, 90.0], EVEN[:6]):
        with pytest.raises(LayoutError, match="a number would refer to two positions") as told:
            kinematics_sheets(problem, positions=asked, layout="coursework")
        assert "an even turn" in str(told.value)
    numbered = numbering.number_positions(replace(problem, cycle=CycleTask("B", zero=10.0)))
    with pytest.raises(LayoutError, match=r"give zero and count of \[cycle\]"):
        kinematics_sheets(numbered, positions=EVEN, layout="coursework")
    own = [phi + 10.0 for phi in EVEN]
    assert numbering.counting(numbered, own) is numbered
    assert numbering.counting(numbered, [phi - 360.0 for phi in own]) is numbered


def test_chosen_plans_are_the_requested_ones() -> None:
    coursework = composition("coursework", "ru")

    def shown(**asked: object) -> list[int]:
        blocks = tuple(replace(one, **asked) if one.kind == "chosen-plans" else one
                       for one in coursework.blocks)  # fmt: skip
        layout = replace(coursework, blocks=blocks)
        (sheet,) = kinematics_sheets(problem_of("linkages/ex1"), layout=layout)
        (view,) = (view for view in sheet.views if view.kind == "acceleration")
        return sorted({span.position for span in view.spans if span.position is not None})

    assert len(shown()) > 2  # as many as fit
    assert shown(positions=(2, 8)) == [2, 8]
    assert shown(positions=(0, 4, 5, 9)) == [0, 4, 5, 9]
    with pytest.raises(LayoutError, match="the last of 12 positions is 11"):
        shown(positions=(3, 12))
