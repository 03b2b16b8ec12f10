"""Small pictures of a layout: senses of ω and ε, Coriolis accelerations, links alone, triangles."""

from __future__ import annotations

import cmath

import pytest
from cases import each
from doors import (
    FRAME_FORMATS as FORMATS,
    SENSE,
    Arc,
    Drawing,
    Fill,
    Pen,
    Solution,
    Stroke,
    Text,
    force_reading,
    kinematics_sheets,
    lint,
    problem_loads as loads,
    read_composition,
)
from mechanisms import CRANK
from worked import problem_of

MECHANISMS = (
    *("levers/six-link", "levers/task-12", "linkages/ex1", "linkages/ex2", "linkages/ex3"),
    *("linkages/triad", "press/press"),
)
ONE = """
formats = ["A2", "A1", "A0"]
[[blocks]]
kind = "{kind}"
{keys}
[[blocks]]
kind = "results"
"""


def drawn(name: str, kind: str, *keys: str) -> Drawing:
    layout = read_composition(ONE.format(kind=kind, keys="\n".join(keys)), name="one.toml")
    (sheet,) = kinematics_sheets(problem_of(name), layout=layout)
    (fmt,) = (f for f in FORMATS.values() if (f.width, f.height) == (sheet.width, sheet.height))
    assert [finding.message for finding in lint(sheet.items, fmt.inner)] == []
    return sheet


def turns(sheet: Drawing) -> list[tuple[complex, int]]:
    """Return the centres and senses of the curved arrows: the head is at one end of the arc."""
    heads = [i for i in sheet.items if isinstance(i, Fill) and i.tag == SENSE]
    found = []
    for arc in (i for i in sheet.items if isinstance(i, Arc) and i.tag == SENSE):
        tips = [head.points[0] for head in heads]
        (tip, *_) = [p for p in tips if abs(abs(p - arc.centre) - arc.radius) < 0.05]
        turned = cmath.phase((tip - arc.centre) * cmath.exp(-0.5j * (arc.start + arc.end)))
        found.append((arc.centre, 1 if turned > 0 else -1))
    return found


def vectors(sheet: Drawing) -> list[tuple[complex, complex]]:
    """Return the starts and directions of the vectors."""
    strokes = [i for i in sheet.items if isinstance(i, Stroke) and i.tag == SENSE]
    return [(s.points[0], s.points[1] - s.points[0]) for s in strokes]


@each("name, of", [(n, of) for n in MECHANISMS for of in ("velocity", "acceleration")])
def test_a_carried_vector_turns_its_link_as_the_solution_says(name: str, of: str) -> None:
    sheet = drawn(name, "senses", f'of = "{of}"')
    solution = Solution(problem_of(name))
    kinematics = solution.construction.kinematics
    senses = [sense for _, sense in turns(sheet)]
    expected, coriolis = [], 0
    if of == "acceleration":
        for relative in kinematics.relatives.values():
            if relative.a_start != relative.a_coriolis and relative.a_coriolis is not None:
                expected.append(solution.links[relative.to].omega[0])
                coriolis += 1
    for kind, link in kinematics.turnings:
        if kind.value == of:
            motion = solution.links[link]
            expected.append((motion.omega if of == "velocity" else motion.epsilon)[0])
    assert expected
    assert senses == [1 if rate > 0 else -1 for rate in expected]
    arrows = vectors(sheet)
    for k in range(coriolis):
        (one, speed), (two, turned) = arrows[2 * k : 2 * k + 2]
        assert one == two
        angle = cmath.phase(turned / speed)
        assert angle == pytest.approx(senses[k] * cmath.pi / 2, abs=1e-6)
    for (centre, sense), (start, way) in zip(
        turns(sheet)[coriolis:], arrows[2 * coriolis :], strict=True
    ):
        assert ((start - centre).conjugate() * way).imag * sense > 0


@each("name", ["linkages/ex3", "press/press"])
def test_the_turned_coriolis_acceleration_has_the_letter_of_its_formula(name: str) -> None:
    """2·ω_3·v: the number of link 2, which turns with it, has no letter of its own."""
    sheet = drawn(name, "senses", 'of = "acceleration"')
    texts = [item for item in sheet.items if isinstance(item, Text)]
    centre, _ = turns(sheet)[0]
    letter = min((i for i in texts if i.text == "ω"), key=lambda one: abs(one.at - centre))
    others = (one for one in texts if one is not letter)
    assert min(others, key=lambda one: abs(one.at - letter.at)).text == "3"


@each("name", ["levers/six-link", "levers/task-12", "linkages/triad", "press/press"])
def test_the_plan_of_a_link_closes_with_its_inner_reaction(name: str) -> None:
    sheet = drawn(name, "link-plan")
    solution = Solution(problem_of(name))
    reading = force_reading(solution, 0)
    exact = {(one.on, one.by): abs(complex(one.force[0])) for one in reading.statics.reactions}
    measured = [
        (span.name, abs(span.end - span.start) * view.per_mm)
        for view in sheet.views
        for span in view.spans
    ]
    alone = [
        balance.links[0]
        for plan in reading.plans
        for balance in plan.balances
        if len(balance.links) == 1 < len(plan.links)
    ]
    assert len(alone) >= len(measured)
    parts = [i for i in sheet.items if i.tag.startswith("plan-force ")]
    tails = [i.points[0] for i in parts if isinstance(i, Stroke)]
    tips = [i.points[0] for i in parts if isinstance(i, Fill)]
    assert tails
    assert abs(sum(tips) - sum(tails)) < 0.5  # every plan closes
    for letters, force in measured:
        on, by = (str("₀₁₂₃₄₅₆₇₈₉".index(digit)) for digit in letters.removeprefix("F"))
        other = exact.get((on, by)) or exact[by, on]
        assert force == pytest.approx(other, rel=0.05)


def test_a_link_alone_shows_its_inner_reaction_and_no_other_link() -> None:
    texts = {i.text for i in drawn("levers/six-link", "link-cut").items if hasattr(i, "text")}
    assert {"Звено 2", "Звено 4"} <= texts
    assert "Звено 3" not in texts


@pytest.mark.parametrize("kind", ["scheme", "plan"])
def test_triangles_of_the_similarity_theorem_are_hatched_on_request(kind: str) -> None:
    keys = ['of = "velocity"'] if kind == "plan" else []
    plain = drawn("levers/six-link", kind, *keys)
    hatched = drawn("levers/six-link", kind, *keys, "hatched = true")

    def lines(sheet: Drawing) -> list[Stroke]:
        return [i for i in sheet.items if isinstance(i, Stroke) and i.pen is Pen.HATCH]

    more = lines(hatched)[: len(lines(hatched)) - len(lines(plain))]
    assert len(more) >= 5
    assert all(cmath.phase(s.points[1] - s.points[0]) == pytest.approx(cmath.pi / 4) for s in more)


def test_a_link_that_translates_in_a_position_has_no_triangle_to_hatch() -> None:
    """All its points have one velocity: where the crank is across the slide of its slider."""
    problem = loads(CRANK, name="own")
    assert kinematics_sheets(problem, layout="four-sheets", positions=[90.0])
