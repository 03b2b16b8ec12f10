"""Results of each mistake, computed by hand: complex numbers and the formulas of the books."""

from __future__ import annotations

from cmath import exp
from collections.abc import Sequence
from functools import cache
from math import asin, pi, radians, sqrt

import pytest
from cases import each
from doors import (
    Explanation,
    Slip,
    Solution,
    Task,
    Verdict,
    WrittenAnswer,
    find_slips,
    grading_examine as examine,
    problem_loads as loads,
)
from planted import checked, exact, explanations, task_of, verdicts
from worked import PROBLEMS, problem_of


@cache
def every(name: str) -> list[Explanation]:
    return explanations(task_of(name))


def sizes(name: str, code: str, key: str, where: str | None = None) -> list[float]:
    """Return the size that a mistake gives a quantity, for each place where it can be made."""
    return [
        abs(one.values[key])
        for one in every(name)
        if one.code == code and where in (None, one.mistake_at)
    ]


# The slider-crank of the first example -----------------------------------------------------------

CRANK, ROD, OMEGA = 0.03, 0.1, -100.0
PIN = CRANK * exp(1j * radians(60.0))
ALONG = exp(-1j * asin(PIN.imag / ROD))
"""Direction of the rod from B to C; C is on the axis x."""
ACROSS = 1j * ALONG
V_B, A_B = 1j * OMEGA * PIN, -(OMEGA**2) * PIN


def on_axis(start: complex, way: complex, height: float = 0.0) -> complex:
    """Return the point of a line at a height over the axis x."""
    return start + way * (height - start.imag) / way.imag


V_C = on_axis(V_B, ACROSS)
V_CB = ((V_C - V_B) / ACROSS).real
OMEGA_2 = V_CB / ROD
NORMAL = -(OMEGA_2**2) * ROD * ALONG
A_C = on_axis(A_B + NORMAL, ACROSS)
AT_CB = ((A_C - A_B - NORMAL) / ACROSS).real


def test_the_right_answers_are_those_of_complex_numbers() -> None:
    right = exact(task_of("linkages/ex1"))
    assert right["v_C"] == pytest.approx(V_C.real)
    assert right["omega_2"] == pytest.approx(OMEGA_2)
    assert right["a_C"] == pytest.approx(A_C.real)
    assert right["epsilon_2"] == pytest.approx(AT_CB / ROD)


CORIOLIS = 2.0 * abs(OMEGA_2) * abs(V_C)

SPEEDS = (30.0 / pi, 1.0 / pi, 180.0 / pi, pi / 30.0, 0.5 / pi, (30.0 / pi) ** 2)

BY_HAND = (
    # code, where, quantity, possible values
    ("V1", None, "v_C", [on_axis(V_B, ALONG)]),  # v_CB along the rod
    ("V1", None, "omega_2", [(on_axis(V_B, ALONG) - V_B) / ROD]),
    ("V2", None, "v_C", [-V_C]),
    ("V5", None, "omega_2", [V_CB / 0.03, V_CB / 0.13]),  # by BD, by CD
    ("N1", "CB", "a_C", [on_axis(A_B - NORMAL, ACROSS)]),
    ("N1", "B", "a_C", [on_axis(-A_B + NORMAL, ACROSS)]),
    ("N2", "CB", "a_C", [on_axis(A_B, ACROSS)]),
    ("N2", "B", "a_C", [on_axis(NORMAL, ACROSS)]),
    ("N4", None, "a_C", [on_axis(A_B + NORMAL, ALONG)]),
    ("E2", None, "epsilon_2", [A_C / ROD, (A_C - A_B) / ROD]),
    ("sign", None, "omega_2", [OMEGA_2]),
    ("S1", "mu_v", "v_C", [V_C / 0.05 / 0.05]),
    ("S1", "mu_a", "a_C", [A_C / 5.0 / 5.0]),
    ("S3", "mu_v", "v_C", [V_C / 0.05 * 0.001, V_C / 0.05 * 5.0]),  # by mu_l, by mu_a
    ("S3", "mu_a", "a_C", [A_C / 5.0 * 0.001, A_C / 5.0 * 0.05]),
    ("S2", "1", "v_C", [V_C * f for f in SPEEDS]),
    ("S2", "l", "v_C", [V_C * 1000.0]),
    ("P1", "C", "v_C", [on_axis(V_B, 1j * -ALONG.conjugate())]),  # C to the left of B
)


@each("code, where, key, values", BY_HAND)
def test_a_mistake_of_the_slider_crank_gives_the_values_computed_by_hand(
    code: str, where: str | None, key: str, values: Sequence[complex]
) -> None:
    found = sizes("linkages/ex1", code, key, where)
    for value in values:
        assert min(abs(one - abs(value)) for one in found) < 1e-6 * abs(value), (code, found)
    for one in found:
        assert min(abs(one - abs(value)) for value in values) < 1e-6 * one, (code, one)


def test_a_coriolis_acceleration_of_a_fixed_guide_lifts_the_end_off_it() -> None:
    """2ω₂·v_C across the guide, to one side of it."""
    (wrong,) = sizes("linkages/ex1", "A6", "a_C")
    ends = [on_axis(A_B + NORMAL, ACROSS, height) for height in (CORIOLIS, -CORIOLIS)]
    assert min(abs(wrong - size) for end in ends for size in (abs(end), abs(end.real))) < 1e-6


# The slotted links -------------------------------------------------------------------------------


def test_the_mistakes_of_a_slotted_link_are_products_of_its_right_answers() -> None:
    right = exact(task_of("linkages/ex3"))
    omega, v_b, v_b3 = right["omega_3"], right["v_B"], right["v_B3"]
    arm = v_b3 / omega
    for code, key, where, values in (
        ("V4", "v_B3", None, [v_b]),  # the sliding forgotten: B₃ has the velocity of the pin
        ("V4", "omega_3", None, [v_b / arm]),
        # By CD, by the distance AC, by the millimetres of the drawing: 2 mm of the link each.
        ("V5", "omega_3", "3", [v_b3 / 0.22, v_b3 / 0.11, omega * 0.002]),
        ("A1", "ak_B3_B", None, [0.0, right["ak_B3_B"]]),  # not computed; not laid off
        ("A2", "ak_B3_B", None, [right["ak_B3_B"]]),
        ("A3", "ak_B3_B", None, [right["ak_B3_B"] / 2.0]),
        ("A4", "ak_B3_B", None, [2.0 * omega * v_b, 2.0 * omega * v_b3]),
        ("E2", "epsilon_3", "3", [right["a_B3"] / arm]),
        ("true_mm", "omega_3", None, [omega * 2.0]),  # 1 mm of the drawing is 2 mm
    ):
        found = sizes("linkages/ex3", code, key, where)
        assert sorted({round(one, 6) for one in found}) == pytest.approx(
            sorted({round(abs(value), 6) for value in values}), abs=2e-6
        ), code
    (back,) = (one.values["ak_B3_B"] for one in every("linkages/ex3") if one.code == "A2")
    assert back == pytest.approx(-right["ak_B3_B"])


def test_the_mistakes_of_the_forces_are_sums_of_the_acting_forces() -> None:
    """Task 12: 5 of 30 kg moves upright, J₁ = 0.2 with ε₁ = 7, g = 9.8; F_43 has all of 5."""
    right = exact(task_of("levers/task12"))
    couple = 0.2 * 7.0
    upright = 2000.0 + 30.0 * 9.8 + 30.0 * right["a_E"]
    assert right["F_4_3"] == pytest.approx(abs(upright))
    pin, pivot, weight = right["F_2_1"], right["F_1_0"], 2.0 * 9.8  # a triangle of forces
    slant = (pin**2 + weight**2 - pivot**2) / (2.0 * pin * weight)
    lighter = sqrt(pin**2 + 2.0**2 - 2.0 * pin * 2.0 * slant)
    for code, where, key, values in (
        ("F1", "5", "F_4_3", [upright - 2.0 * 30.0 * right["a_E"]]),  # Φ along the acceleration
        ("F2", "1", "balance", [right["balance"] - couple, right["balance"] - 2.0 * couple]),
        ("F3", "5", "F_4_3", [upright - 30.0 * 9.8, upright - 30.0 * (9.8 - 1.0)]),
        ("F3", "1", "F_1_0", [right["F_2_1"], lighter]),
        ("F5", "F_{12}", "balance", [right["balance"] - 2.0 * (right["balance"] - couple)]),
    ):
        found = sizes("levers/task12", code, key, where)
        if code in ("F2", "F3"):  # in one equation or plan, too
            found = [one for one in found if min(abs(one - abs(v)) for v in values) < 1e-2]
            found = [*{round(one, 3): one for one in found}.values()]
        assert sorted(found) == pytest.approx(sorted(map(abs, values)), rel=1e-5), (code, where)


def test_forces_on_a_lever_that_was_not_turned_have_the_other_arms() -> None:
    """Z1: each force has the moment F×v in place of F·v; couples keep theirs."""
    solution = Solution(problem_of("levers/task12"))
    points, links = solution.points, solution.links
    forces = {
        "S5": -1j * (2000.0 + 30.0 * 9.8) - 30.0 * complex(points["S5"].acceleration[0]),
        "S3": -1j * 5.0 * 9.8 - 5.0 * complex(points["S3"].acceleration[0]),
    }
    couples = -0.3 * float(links["3"].epsilon[0]) * float(links["3"].omega[0]) / 12.0 - 1.4
    moments = [
        force * complex(points[at].velocity[0]).conjugate() / 12.0 for at, force in forces.items()
    ]
    right = exact(task_of("levers/task12"))
    assert abs(sum(m.real for m in moments) + couples) == pytest.approx(right["lever"])
    across = sum(m.imag for m in moments)
    (found,) = sizes("levers/task12", "Z1", "lever")
    assert min(abs(found - abs(sign * across + couples)) for sign in (1.0, -1.0)) < 1e-6


def test_an_arm_measured_along_a_force_takes_its_other_component_of_the_velocity() -> None:
    """F4; vertical forces on link 5, which moves vertically, have none then: they are left out.

    On a plan turned by 90° the moment of F at the end of v is the real part of F times the
    conjugate of v; the moment by the component along F is minus its imaginary part.
    """
    points = Solution(problem_of("levers/task12")).points
    right = exact(task_of("levers/task12"))["lever"]
    for code, at, force in (
        ("F6", "S5", -2000j),
        ("F3", "S5", -1j * 30.0 * 9.8),
        ("F6", "S5", -30.0 * complex(points["S5"].acceleration[0])),
        ("F4", "S3", -1j * 5.0 * 9.8),
        ("F4", "S3", -5.0 * complex(points["S3"].acceleration[0])),
    ):
        found = sizes("levers/task12", code, "lever")
        moment = force * complex(points[at].velocity[0]).conjugate() / 12.0
        left = abs(right + moment.real + moment.imag)
        assert min(abs(one - left) for one in found) < 1e-6, (at, left, found)


def test_couples_put_on_the_lever_as_they_are_have_lost_their_arm_over_the_length() -> None:
    """Z2: M in place of M·(bc)/l; at 100 mm/(m/s) a millimetre of the lever is 0.01 m/s."""
    right = exact(task_of("levers/task12"))
    couples = {right["omega_3"]: -0.3 * right["epsilon_3"], 12.0: -0.2 * 7.0}
    whole = sum(couple * omega for omega, couple in couples.items()) / 12.0
    bare = sum(couples.values()) * 0.01 / 12.0
    (found,) = sizes("levers/task12", "Z2", "lever")
    assert found == pytest.approx(right["lever"] + whole - bare)


# Slips with one number ---------------------------------------------------------------------------


def slips_of(key: str, value: float, mm: float | None = None, raw: str = "") -> list[Slip]:
    """Return the slips that may have been made with one answer of the third example."""
    task = task_of("linkages/ex3")
    item = next(one for one in task.usual() if one.id == key)
    written = WrittenAnswer(id=key, value=value, step=0.01, mm=mm, mm_step=0.5, raw=raw)
    return list(find_slips(task.sheet(0), examine(task, task.sheet(0), item, written)))


ARM = 0.18
V_ED = 1.6322

SLIPS = (
    # code, where, answer, value written, mm, value given by the slip, tolerance
    ("S1", "mu_v", "v_E", 1570.0, 78.5, 78.5 / 0.05, 1e-6),
    ("S3", "mu_v", "v_E", 78.5, 78.5, 78.5 * 1.0, 1e-6),  # by mu_a = 1
    ("S3", "mu_v", "v_E", 0.157, 78.5, 78.5 * 0.002, 1e-6),  # by mu_l
    ("S2", "", "v_E", 3915.7, None, 3915.7, 1e-3),  # mm/s
    ("S2", "", "omega_4", 9.068 * 30.0 / pi, None, 9.068 * 30.0 / pi, 1e-3),  # rev/min
    ("S4", "", "v_E", 0.39157, None, 0.39157, 1e-3),
    ("S4", "", "v_E", 9.316, None, 9.316, 0.02),  # 3.916 with its digits swapped
    ("V6", "p-d", "v_E", 3.405, None, 3.405, 1e-3),
    ("slip", "v·l ≠ v/l", "omega_4", V_ED * ARM, None, V_ED * ARM, 1e-3),
    ("slip", "l/v ≠ v/l", "omega_4", ARM / V_ED, None, ARM / V_ED, 1e-3),
)


@each("code, where, key, value, mm, given, near", SLIPS)
def test_a_slip_gives_the_number_that_was_written(
    code: str, where: str, key: str, value: float, mm: float | None, given: float, near: float
) -> None:
    raw = f"{value:g}"
    found = [abs(one.value) for one in slips_of(key, value, mm, raw) if one.code == code
             and one.mistake_at == where]  # fmt: skip
    assert found
    assert min(abs(one / given - 1.0) for one in found) < near, (code, found)


def test_a_slip_is_that_of_the_result_in_which_it_was_made() -> None:
    task = task_of("linkages/ex1")
    explained = task.explanations(task.sheet(0))
    change = next(one.change for one in every("linkages/ex1") if one.change is not None)
    for item in ("1", "2", "1"):
        made = explained.of_slip(change, "v C", item)
        assert made is not None and made.first_answers == (item,)


def test_a_load_left_out_or_reversed_in_one_place_leaves_the_others_as_they_are() -> None:
    """Task 12: loads of 5 in F_43 and on the lever; the couples of 1 and 3 on the lever, too."""
    right = exact(task_of("levers/task12"))
    loads = {"F_{5}": 2000.0, "Φ_{5}": 30.0 * right["a_E"], "G_{5}": 30.0 * 9.8}
    power = {"1": -0.2 * 7.0, "3": -0.3 * right["epsilon_3"] * right["omega_3"] / 12.0}
    for where, moment in power.items():
        found = sizes("levers/task12", "F2", "lever", where)
        for value in (right["lever"] + moment, right["lever"] + 2.0 * moment):
            assert min(abs(one - value) for one in found) < 1e-6, where
    for where, load in loads.items():
        code, at = ("F3", "5") if where == "G_{5}" else ("F6", where)
        found = sizes("levers/task12", code, "F_4_3", at)
        assert min(abs(one - abs(right["F_4_3"] - load)) for one in found) < 1e-6, where
    found = sizes("levers/task12", "F6", "F_4_3", "F_{5}")  # upward everywhere
    assert min(abs(one - abs(right["F_4_3"] - 4000.0)) for one in found) < 1e-6
    (grams,) = sizes("levers/task12", "S2", "F_4_3", "m")
    assert grams == pytest.approx(abs(2000.0 + 1000.0 * (right["F_4_3"] - 2000.0)))


def test_a_crank_of_twice_its_length_doubles_velocities_and_perhaps_its_acceleration() -> None:
    right = exact(task_of("linkages/ex1"))
    pairs = {
        (round(e.values["v_B"] / right["v_B"], 6), round(e.values["a_B"] / right["a_B"], 6))
        for e in every("linkages/ex1")
        if e.code == "slip"
    }
    assert {(2.0, 1.0), (2.0, 2.0), (0.5, 1.0), (0.5, 0.5)} <= pairs


def test_a_resistance_goes_with_a_driver_that_turns_the_other_way() -> None:
    """V2: the balance is that of the file with the other sense of ω₁."""
    (back,) = (e for e in every("levers/task-16") if e.code == "V2")
    text = (PROBLEMS / "levers/task-16.toml").read_text("utf-8")
    (line,) = (row for row in text.splitlines() if row.startswith("omega = "))
    other = loads(text.replace(line, line.replace("= ", "= -", 1)), name="task-16")
    theirs = exact(Task(Solution(other)))
    assert back.values["balance"] == pytest.approx(theirs["balance"])


def test_a_resistance_turns_with_the_motion_at_another_angle_of_the_crank() -> None:
    """P1: where the output moves back, the balance is that of the file with this angle."""
    text = (PROBLEMS / "levers/task-27.toml").read_text("utf-8")
    (line,) = (row for row in text.splitlines() if row.startswith("phi = "))
    phi = float(line.removeprefix("phi = ").split("#")[0])
    other = loads(text.replace(line, f"phi = {-phi % 360}", 1), name="task-27")
    theirs = exact(Task(Solution(other)))
    assert any(
        one.values == pytest.approx(theirs) for one in every("levers/task-27") if one.code == "P1"
    )


def test_the_force_plan_has_the_inertia_force_that_the_student_computed() -> None:
    """Φ₅ is half too much: F_43 follows from it, and keeps its points."""
    right = exact(task_of("levers/task12"))
    more = 30.0 * 0.5 * right["a_E"]
    told = checked(
        "levers/task12", inertia_5=30.0 * 1.5 * right["a_E"], F_4_3=right["F_4_3"] + more
    )
    assert verdicts(told)["inertia_5"] is Verdict.WRONG
    assert verdicts(told)["F_4_3"] is Verdict.INHERITED


def test_the_mass_of_another_link_in_an_inertia_force_is_told() -> None:
    """Φ₅ with the 5 kg of link 3: from the student's own acceleration, to its digits."""
    right = abs(exact(task_of("levers/task12"))["a_E"])
    told = checked("levers/task12", a_E=round(right, 1), inertia_5=5.0 * round(right, 1))
    (diagnosis,) = told.diagnosis
    assert diagnosis.codes == ("slip",)
    assert diagnosis.mistake_at == "m_{3} ≠ m_{5}"
