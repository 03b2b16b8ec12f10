"""Every kind of selector of forces against numbers worked out by hand, and the audit of forces."""

from __future__ import annotations

from functools import cache
from math import atan2, degrees, hypot, pi, sqrt

import pytest
from cases import each
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    Audited,
    AuditVerdict,
    ModelProblem as Problem,
    NoValue,
    NoValueError,
    QuantityKind,
    QuantityValues,
    Solution,
    audit,
    drawn_forces,
    get_language,
    parse_quantity,
    problem_loads as loads,
    source_force_scale,
    statics_of,
)
from loaded import with_resultant
from msgspec.structs import replace
from slotted import KULISA, SCALES, R, problem_of
from worked import problem_of as worked

LOADS = """
[dynamics]
gravity = 10
[dynamics.links.3]
mass = 2
centre = "D"
inertia = 0.5
[[loads]]
name = "P"
link = "3"
at = "D"
force = 100
angle = -45
[[loads]]
name = "M_{2}"
link = "2"
couple = 4
"""
"""The slotted link at 45 degrees with a transverse force at its end, and a couple on its block."""

MU_F = 2.0


def loaded(*entries: str, driver: str = "omega = 10") -> Problem:
    text = KULISA.replace("omega = 10", driver) + SCALES + LOADS
    return loads("\n".join([text, "[published]", *entries]), name="kulisa")


@cache
def kulisa() -> QuantityValues:
    return QuantityValues(Solution(loaded(), ruler=0.5), 0, MU_F)


# Across the kulisa: the load, the inertia of a^t = 3 and the weight; along it: a^n = 7.5.
ACROSS = 100 + 6 + 20 * R
ALONG = 15 - 20 * R
PRESSURE = (0.3 * ACROSS + 5 - 4) / (0.2 * R)  # moments of the block and the slotted link about C
INERTIA = hypot(15, 6)

EXACT = {
    "weight 3": 20.0,
    "weight 2": 0.0,
    "inertia 3": INERTIA,
    "inertia 1": 0.0,
    "inertia couple 3": 5.0,
    "load P": 100.0,
    "load M_{2}": 4.0,
    "shift 3": 5 / INERTIA / 0.002,
    "F 2 1": PRESSURE,
    "F 1 2": PRESSURE,
    "F 3 2": PRESSURE,
    "F 3 0": hypot(ALONG, PRESSURE - ACROSS),
    "F 0 3": hypot(ALONG, PRESSURE - ACROSS),
    "F 1 0": PRESSURE,
    "Ft 2 1 C D": PRESSURE,
    "Fn 2 1 C D": 0.0,
    "Ft 3 0 C B3": PRESSURE - ACROSS,
    "Fn 3 0 C D": ALONG,
    "Fn 2 1 A B": PRESSURE * R,
    "M 2 3": 4.0,
    "M 3 2": 4.0,
    "M 2 1": 0.0,
    "M 2 3 / F 2 3": 4 / PRESSURE,
    "angle F 3 2": 135.0,
    "angle F 2 3": 315.0,
    "angle inertia 3": degrees(pi / 4 + atan2(-6, 15)),
    "angle load P": 315.0,
    "arm weight 3 about C": 150 * R,
    "arm weight 3 about D": 0.0,
    "arm inertia 3 about C": 150 * 6 / INERTIA,
    "arm load P about C": 150.0,
    "arm F 1 2 about A": 50 * R,
    "arm F 2 1 about C": 100 * R,
    "arm F 3 2 about C": 100 * R + 500 * 4 / PRESSURE,  # the couple shifts the line of action
    "balance": 0.1 * R * PRESSURE,
    "balance B": R * PRESSURE,
    "lever": 0.1 * R * PRESSURE,
    "lever B": R * PRESSURE,
    "balance / F 2 1": 0.1 * R,
}


@each("what, value", EXACT.items())
def test_exact_values_of_forces(what: str, value: float) -> None:
    assert kulisa().exact(parse_quantity(what)) == pytest.approx(value, rel=1e-12, abs=1e-11)


def test_every_force_is_tested() -> None:
    wanted = {kind for kind in QuantityKind if kind.is_force and kind.word}
    assert {parse_quantity(name).kind for name in EXACT} == wanted


def test_a_force_that_is_zero_by_nature_is_exactly_zero() -> None:
    for what in ("Fn 2 1 C D", "M 2 1", "weight 2"):
        assert kulisa().exact(parse_quantity(what)) == 0.0


# By hand ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("what", ["F 2 1", "F 3 0", "Ft 3 0 C D", "Fn 3 0 C D", "F 1 0"])
def test_a_force_is_read_off_its_plan_with_the_ruler(what: str) -> None:
    selector = parse_quantity(what)
    steps = kulisa().read(selector) / (0.5 * MU_F)  # type: ignore[operator]
    assert steps == pytest.approx(round(steps), abs=1e-9)
    assert steps * 0.5 * MU_F == pytest.approx(kulisa().exact(selector), rel=0.02, abs=1)


def test_a_value_that_was_laid_off_is_not_read_again() -> None:
    """The tangential reaction is its moment over the arm CB, which was read 70.5 mm."""
    at = kulisa()
    assert at.read(parse_quantity("load P")) == 100.0
    assert at.read(parse_quantity("weight 3")) == 20.0
    steps = at.read(parse_quantity("Ft 2 1 C D")) / (0.5 * MU_F)  # type: ignore[operator]
    assert abs(steps - round(steps)) > 0.01
    assert steps * 0.5 * MU_F == pytest.approx(PRESSURE, rel=0.02)


def test_inertia_follows_from_the_acceleration_read() -> None:
    at = kulisa()
    a_d, epsilon = at.read(parse_quantity("a D")), at.read(parse_quantity("epsilon 3"))
    assert a_d is not None
    assert epsilon is not None
    assert at.read(parse_quantity("inertia 3")) == pytest.approx(2 * a_d, rel=1e-12)
    assert at.read(parse_quantity("inertia couple 3")) == pytest.approx(0.5 * epsilon, rel=1e-12)


def test_arms_are_read_off_the_drawing() -> None:
    read = {name: kulisa().read(parse_quantity(name)) for name in EXACT if name.startswith("arm w")}
    assert read == {"arm weight 3 about C": pytest.approx(106.0), "arm weight 3 about D": 0.0}


def test_the_hands_balance_is_that_of_its_plans() -> None:
    solution = Solution(loaded(), ruler=0.5)
    own = QuantityValues(solution)
    hand = drawn_forces(statics_of(solution))
    assert own.read(parse_quantity("balance")) == hand.read("balance")[0]
    assert own.read(parse_quantity("lever")) == hand.read("lever")[0]


def test_an_angle_of_a_force_is_read_with_a_protractor() -> None:
    key = parse_quantity("angle F 2 1")
    assert kulisa().read(key) == pytest.approx(kulisa().exact(key), abs=1.0)


def test_the_shift_is_the_constructed_one() -> None:
    """Exact and by hand; the press prints H = 83.4 mm at 0.002 m/mm."""
    problem = with_resultant(worked("press/press"))
    scales = replace(problem.scales, mu_l=0.002)
    solution = Solution(replace(problem, scales=scales))
    (shift,) = statics_of(solution).board.shifts.values()
    quantities, selector = QuantityValues(solution), parse_quantity("shift 3")
    exact = statics_of(solution).paper.point(shift.at) - solution.paper.point(shift.centre)
    assert quantities.exact(selector) == pytest.approx(abs(complex(exact[0])), rel=1e-9)
    laid = statics_of(solution).ruler_reading.number(shift.length)
    assert quantities.read(selector) == pytest.approx(abs(float(laid[0])), rel=1e-9)
    assert abs(complex(exact[0])) == pytest.approx(83.4, abs=0.5)


def test_arms_are_those_of_the_shifted_line() -> None:
    """Φ turns about C by 0.3·6 N·m, and as much as its couple, 0.4·10."""
    text = KULISA + SCALES + LOADS.replace("inertia = 0.5", "inertia = 0.4\n")
    single = QuantityValues(Solution(with_resultant(loads(text, name="kulisa"))))
    arm = single.exact(parse_quantity("arm inertia 3 about C"))
    assert arm == pytest.approx((0.3 * 6 + 4) / INERTIA / 0.002, rel=1e-9)
    assert single.exact(parse_quantity("inertia couple 3")) == pytest.approx(4.0)
    # With 5 N·m the shift is longer than the kulisa: the force stays at D.
    far = QuantityValues(Solution(with_resultant(loaded())))
    assert far.exact(parse_quantity("arm inertia 3 about C")) == pytest.approx(
        0.3 * 6 / INERTIA / 0.002, rel=1e-9
    )


# Missing quantities ----------------------------------------------------------------------------

SLIDER = """
title = "Кулиса"
[frame]
A = [0, 0]
C = [0.2, 0.1]
guides.x-x = { through = "A", angle = 0 }
[links.1]
points = ["B"]
slides = { on = "x-x" }
[links.2]
points = ["B", "D"]
BD = 0.15
[links.3]
points = ["C", "D"]
CD = 0.15
[driver]
link = "1"
s = 0
v = 1
[assembly]
D = "above B"
[[loads]]
name = "P"
link = "1"
at = "B"
force = 30
angle = 180
"""


def asked(problem: Problem, what: str) -> float:
    return QuantityValues(Solution(problem)).exact(parse_quantity(what))


def test_a_driving_slider_is_balanced_along_its_guide() -> None:
    slider = loads(SLIDER, name="slider")
    assert asked(slider, "balance") == pytest.approx(30.0)
    assert asked(slider, "lever") == pytest.approx(30.0)
    with pytest.raises(NoValueError) as caught:
        asked(slider, "balance B")
    assert caught.value.reason is NoValue.NO_LINK


@pytest.mark.parametrize(
    ("problem", "what", "why"),
    [
        (problem_of(), "F 2 1", NoValue.NO_FORCES),
        (loaded(), "F 1 3", NoValue.NO_JOINT),
        (loaded(), "angle inertia 1", NoValue.NO_DIRECTION),
        (loaded(), "arm load M_{2} about C", NoValue.NO_DIRECTION),
        (loaded(), "arm F 1 0 about Q", NoValue.NO_POINT),
        (loaded(), "shift 1", NoValue.ZERO_DIVISOR),
        (loaded(), "balance D", NoValue.NO_LINK),
        (loaded(), "F 1 0 / weight 1", NoValue.ZERO_DIVISOR),
        (loaded(driver="omega = 0"), "lever", NoValue.AT_REST),
    ],
)
def test_missing_quantities_of_forces_have_a_reason(
    problem: Problem, what: str, why: NoValue
) -> None:
    with pytest.raises(NoValueError) as caught:
        asked(problem, what)
    assert caught.value.reason is why
    assert all(get_language(lang).audit["whys"][why.value] for lang in LANGUAGES)


def test_a_zero_force_has_no_direction() -> None:
    text = KULISA + LOADS.replace("force = 100", "force = 0").replace("mass = 2", "mass = 0")
    still = loads(text.replace("inertia = 0.5", "").replace("couple = 4", "couple = 0"), name="k")
    assert asked(still, "F 3 0") == 0.0
    for what in ("angle F 3 0", "arm F 3 0 about A"):
        with pytest.raises(NoValueError) as caught:
            asked(still, what)
        assert caught.value.reason is NoValue.NO_DIRECTION


# Audit -----------------------------------------------------------------------------------------


def test_millimetres_of_a_force_and_of_its_angle() -> None:
    problem = loaded(
        'f = { value = 320, unit = "Н", per_mm = 2, what = "F 2 1" }',
        'a = { value = 136, unit = "град", what = "angle F 3 2" }',
        'h = { value = 105, unit = "мм", per_mm = 1, what = "arm weight 3 about C" }',
    )
    assert source_force_scale(problem) == MU_F
    force, angle, arm = audit(problem)
    assert force.mm == pytest.approx((320 - PRESSURE) / 2)
    assert angle.mm == pytest.approx(pi / 180 * PRESSURE / 2)
    assert arm.mm == pytest.approx(105 - 150 * R)
    assert (angle.verdict, arm.verdict) == (AuditVerdict.DIFFERS, AuditVerdict.DIFFERS)


def test_without_a_scale_of_the_source_an_angle_has_no_millimetres() -> None:
    force, angle = audit(
        loaded(
            'f = { value = 320, unit = "Н", what = "F 2 1" }',
            'a = { value = 134, unit = "град", what = "angle F 3 2" }',
        )
    )
    assert (force.mm, angle.mm) == (None, None)
    assert force.read is not None


def test_radians_and_true_lengths() -> None:
    turned, true, part = audit(
        loaded(
            f'a = {{ value = {3 * pi / 4 - 2 * pi}, unit = "рад", what = "angle F 3 2" }}',
            'h = { value = 0.21, unit = "м", per_mm = 0.002, what = "arm weight 3 about C" }',
            'l = { value = 0.14, unit = "м", what = "length C B3" }',
        )
    )
    assert turned.difference == pytest.approx(0.0, abs=1e-9)
    assert true.exact == pytest.approx(0.3 * R)
    assert true.read == pytest.approx(0.212)
    assert true.mm == pytest.approx((0.21 - 0.3 * R) / 0.002)
    assert part.exact == pytest.approx(0.2 * R)
    assert part.read == pytest.approx(0.141)


def test_true_lengths_need_no_scale() -> None:
    entry = 'h = { value = 0.21, unit = "м", what = "arm weight 3 about C" }'
    drawn = 'd = { value = 106, unit = "мм", what = "arm weight 3 about C" }'
    text = KULISA + LOADS + f"[published]\n{entry}\n{drawn}\n"
    found: list[Audited] = audit(loads(text, name="kulisa"))
    assert found[0].exact == pytest.approx(0.15 * sqrt(2))
    assert found[1].reason is NoValue.NO_SCALE
