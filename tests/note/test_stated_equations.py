"""Equations as a file wants them: joint ones hold on plans, numbers run through."""

from __future__ import annotations

import re

import pytest
from cases import sampled, some
from doors import (
    RATES,
    KnownParts,
    Solution,
    StatedEquation,
    Text,
    VectorKind,
    kinematics_sheets,
    problem_loads as loads,
    stated_equations,
)
from msgspec.structs import replace
from protocols import flat, worked
from texts import protocol
from worked import SIX

from benchmarks.generator import random_problem

SEEDS = range(some(60, few=16))


def wanting(solution: Solution, **sheet: bool) -> Solution:
    """Return a solution whose file has keys of ``[sheet]``."""
    problem = solution.problem
    return Solution(replace(problem, sheet=replace(problem.sheet, **sheet)))


def equations_of(solution: Solution) -> list[StatedEquation]:
    problem, construction = solution.problem, solution.construction
    return [one for kind in RATES for one in stated_equations(construction, problem, kind)]


def every() -> list[Solution]:
    random = [
        Solution(loads(random_problem(seed, triad=seed % 4 == 3)[0], name="random"))
        for seed in sampled(SEEDS, 4)
    ]
    return [*random, *map(worked, SIX), worked("linkages/triad")]


def test_joint_equations_hold_on_the_plans_and_have_two_unknowns() -> None:
    joint, kinds = 0, set()
    for solution in every():
        own = wanting(solution, joint_equations=True)
        for one in equations_of(own):
            sides = [
                sum(complex(own.si.point(v.head)[0] - own.si.point(v.tail)[0]) for v in side)
                for side in (one.left, one.right)
            ]
            size = max(abs(side) for side in sides)
            assert abs(sides[0] - sides[1]) <= 1e-9 * size + 1e-12
            if one.is_joint:
                joint += 1
                terms = (*one.left, *one.right)
                assert sum(term.known is KnownParts.ONE for term in terms) == 2
                assert all(term.known is not KnownParts.NONE for term in terms)
                kinds |= {term.kind for term in terms}
    assert joint > 20
    assert kinds >= {VectorKind.CORIOLIS, VectorKind.TANGENTIAL, VectorKind.SLIDING}


def test_a_group_of_class_three_keeps_its_equations_and_the_protocol_says_why() -> None:
    plain = worked("linkages/triad")
    own = wanting(plain, joint_equations=True)
    assert equations_of(own) == equations_of(plain)
    for lang, said in (("ru", "относится к III классу"), ("en", "is of class III")):
        assert flat(protocol(own, lang=lang)).count(said) == 2
        assert said not in flat(protocol(plain, lang=lang))


@pytest.mark.parametrize("lang", ["ru", "en"])
def test_the_equations_of_the_book(lang: str) -> None:
    own = wanting(worked("levers/six-link"), joint_equations=True, equation_numbers=True)
    text = flat(protocol(own, lang=lang))
    for equation in (
        "v_C = v_B + v_CB (1)",
        "v_H = v_L + v_HL (2)",
        "aⁿ_CD + a^τ_CD = aⁿ_B + a^τ_B + aⁿ_CB + a^τ_CB (4)",
        "a_H = a_L + aᵏ_HL + aʳ_HL (5)",
    ):
        assert equation in text
    assert "v_CD" not in text and "HH6 =" not in text
    solved, by = {"ru": ("решено уравнение (4).", "по уравнению (8)"),
                  "en": ("This solves equation (4).", "by equation (8)")}[lang]  # fmt: skip
    assert solved in text and by in text


@pytest.mark.parametrize("name", ["levers/six-link", "levers/task12", "press/press"])
@pytest.mark.parametrize("joint", [False, True])
def test_numbers_run_through_velocities_accelerations_and_forces(name: str, joint: bool) -> None:
    own = wanting(worked(name), joint_equations=joint, equation_numbers=True)
    lines = protocol(own).splitlines()
    # An equation ends in its number; so does no sentence.
    printed = [int(found[1]) for line in lines
               if (found := re.search(r"(?:=.*|0,|0\.|\w)  +\((\d+)\)$", line))]  # fmt: skip
    assert printed == list(range(1, len(printed) + 1))
    assert len(printed) > 10
    referred = re.findall(r"уравнени[ею]\S* \((\d+)\)", flat("\n".join(lines)))
    assert {int(one) for one in referred} <= {*printed}


def test_without_the_keys_there_is_neither() -> None:
    text = protocol(worked("levers/six-link"))
    assert "(1)\n" not in text
    assert "v_CD" in text


def test_sheets_have_the_numbers_of_the_protocol() -> None:
    own = wanting(worked("levers/six-link"), joint_equations=True, equation_numbers=True).problem
    shown = []
    for layout in (None, "forces"):
        (sheet,) = kinematics_sheets(own, layout=layout)
        found = [
            re.search(r"\((\d+)\)$", item.text) for item in sheet.items if isinstance(item, Text)
        ]
        shown.append(sorted(int(one[1]) for one in found if one))
    assert shown == [[1, 2, 3, 4, 5], [6, 7, 8, 9, 10, 11, 12, 13]]
