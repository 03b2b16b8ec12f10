"""Mistakes as rewrites of the program: their results, and the places where they can be made."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from doors import (
    Explanation,
    Float64,
    NumberName,
    PointName,
    Verdict,
    evaluate_evaluate as evaluate,
    key_of_task,
    substituted,
)
from planted import checked, exact, explanations, task_of, verdicts
from worked import SIX


def by_code(name: str, code: str) -> list[Explanation]:
    return [e for e in explanations(task_of(name)) if e.code == code]


def flat(value: object) -> list[complex]:
    parts = value if isinstance(value, tuple) else (value,)
    return [complex(np.ravel(np.asarray(part))[0]) for part in parts]


def place(explanation: Explanation, name: str) -> complex:
    return complex(explanation.trace.value[PointName(name)])


CODES = {
    "linkages/ex3": "V1 V2 V3 V4 V5 A1 A2 A3 A4 A5 A6 N1 N2 N3 N4 E2 sign slip S1 S2 S3 true_mm P1",
    "linkages/ex1": "V1 V2 V3 V5 A6 N1 N2 N3 N4 E2 sign slip S1 S2 S3 P1",
    "levers/task12": "V2 V3 V4 V5 A1 A2 A3 A4 A5 N1 N2 N3 E2 sign slip S1 S2 S3 true_mm P1 F1 F2 "
    "F3 F4 F5 F6 Z1 Z2",
}


@pytest.mark.parametrize("name", CODES)
def test_every_mistake_that_can_be_made_is_tried(name: str) -> None:
    assert {e.code for e in explanations(task_of(name))} == set(CODES[name].split())


def test_the_plan_is_linear_in_the_coriolis_acceleration() -> None:
    """Reversed, none, half, right: b₃ of the acceleration plan moves in equal steps."""
    none, half, back = (by_code("linkages/ex3", code)[0] for code in ("A1", "A3", "A2"))
    right = complex(task_of("linkages/ex3").sheet(0).exact_trace.value[PointName("a:B3")])
    step = right - place(half, "a:B3")
    assert abs(step) > 10
    assert place(none, "a:B3") == pytest.approx(right - 2 * step)
    assert place(back, "a:B3") == pytest.approx(right - 4 * step)


def test_an_outward_normal_component_leaves_the_tangential_one_of_a_slotted_link() -> None:
    """N1 at ex3's link 3: a_B3 and its tangential part keep their sizes (CHECKING, N1)."""
    (wrong,) = (e for e in by_code("linkages/ex3", "N1") if e.mistake_at == "B3C")
    right = exact(task_of("linkages/ex3"))
    for name in ("a_B3", "epsilon_3", "at_B3_C"):
        assert abs(wrong.values[name]) == pytest.approx(abs(right[name]))
    assert abs(wrong.values["a_E"]) > 1.1 * abs(right["a_E"])


def test_the_driver_the_other_way_turns_velocities_and_leaves_accelerations() -> None:
    for name in ("linkages/ex1", "linkages/ex3"):
        (wrong,) = by_code(name, "V2")
        for key, value in exact(task_of(name)).items():
            assert abs(wrong.values[key]) == pytest.approx(abs(value)), key
            if key.startswith("omega"):
                assert wrong.values[key] == pytest.approx(-value)


def test_the_omega_of_the_crank_brings_its_sense_into_the_coriolis_acceleration_or_not() -> None:
    """A5 by its size alone and as the vector 2ω₁×v_r: two where ω₁ and ω₂ are of two senses."""
    for name, key, ratio in (
        ("linkages/ex3", "ak_B3_B", [50 / 15.476709]),
        ("levers/six-link", "ak_H_H2", [20 / 8.122472, -20 / 8.122472]),
    ):
        right = exact(task_of(name))[key]
        assert [e.values[key] / right for e in by_code(name, "A5")] == pytest.approx(ratio)


def test_a_point_divided_from_the_wrong_end_on_both_plans_is_one_mistake() -> None:
    both = next(
        e
        for e in by_code("levers/six-link", "V3")
        if e.mistake_at == "H2" and e.change and len(e.change.steps) == 2
    )
    values = {name: abs(both.values[name]) for name in ("v_H2", "v_H", "a_H2")}
    (found,) = checked("levers/six-link", **values).diagnosis
    assert (found.codes, found.sure, found.mistake_at) == (("V3",), True, "H2")


def test_the_whole_is_recognized_in_place_of_its_part_and_a_small_product_from_zero() -> None:
    """Crosshead, rod 0.3 m: a_CB = 1.325 for a^τ_CB = 1.159 (N5); v·l and v²·l for aⁿ (N3).

    v·l is also, to a ruler, the segment of aⁿ at the scale of velocities (S3).
    """
    for codes, values in (
        (("N5",), {"at_C_B": 1.325, "epsilon_2": 4.418, "an_C_B": 0.643, "a_C": 1.724}),
        (("N3", "S3"), {"omega_2": 1.464, "an_C_B": 0.1317}),
        (("N3",), {"omega_2": 1.464, "an_C_B": 0.0579}),
    ):
        (found,) = checked("levers/crosshead", **values).diagnosis
        assert (found.codes, found.sure) == (codes, len(codes) == 1)


def test_a_segment_as_long_as_another_of_the_student_is_that_one_read() -> None:
    """Crosshead: a^τ_CB is the student's own a_C, 3 % off the right one."""
    right = exact(task_of("levers/crosshead"))
    told = {key: right[key] for key in ("omega_2", "an_C_B", "a_C", "at_C_B", "epsilon_2")}
    own = 1.03 * right["a_C"]
    told |= {"a_C": own, "at_C_B": own, "epsilon_2": own / 0.3}
    (found,) = checked("levers/crosshead", **told).diagnosis
    assert (found.codes, found.sure, found.roots) == (("N5",), True, ("at_C_B",))


def test_a_scale_forgotten_once_is_named() -> None:
    task = task_of("levers/crosshead")
    right, scales = dict(exact(task)), task.sheet(0).scales
    for key, scale in (("v_C", "mu_v"), ("a_C", "mu_a")):
        assert scales[scale] not in (1.0, *(scales[other] for other in scales if other != scale))
        (found,) = checked(
            "levers/crosshead", **right | {key: right[key] / scales[scale]}
        ).diagnosis
        assert (found.codes, found.sure, found.mistake_at) == (("scale",), True, scale)


def test_a_scale_forgotten_at_several_places_beside_another_mistake_is_counted_once() -> None:
    task = task_of("levers/six-link")
    right, mu_v = dict(exact(task)), task.sheet(0).scales["mu_v"]
    wrong = {"v_C": right["v_C"] / mu_v, "v_S2": right["v_S2"] / mu_v, "a_C": 1.7 * right["a_C"]}
    found = checked("levers/six-link", **right | wrong)
    assert (("scale",), True, ("v_C",)) in [(d.codes, d.sure, d.roots) for d in found.diagnosis]
    assert sum(d.codes == ("scale",) for d in found.diagnosis) == 1
    assert verdicts(found)["v_S2"] is Verdict.INHERITED


def test_answers_of_zero_are_judged() -> None:
    right = dict(exact(task_of("linkages/ex3")))
    for zeros in (["v_E_D", "omega_4"], ["omega_3", "omega_4"], ["v_D", "v_E", "a_B"]):
        found = checked("linkages/ex3", **right | dict.fromkeys(zeros, 0.0) | {"v_B3": 0.03})
        assert found.failure is None
        assert verdicts(found)["v_B3"] is Verdict.WRONG


def test_rev_per_min_for_radians_grows_velocities_once_and_accelerations_twice() -> None:
    wrong, right = by_code("linkages/ex3", "S2")[0], exact(task_of("linkages/ex3"))
    factor = 30 / np.pi
    assert wrong.values["v_D"] == pytest.approx(right["v_D"] * factor)
    assert wrong.values["a_D"] == pytest.approx(right["a_D"] * factor**2)


def test_weights_forgotten_change_forces_alone() -> None:
    right = exact(task_of("levers/task12"))
    for wrong in by_code("levers/task12", "F3"):
        for name, value in right.items():
            if not name.startswith("F_") and name not in ("balance", "lever"):
                assert wrong.values[name] == value, name
    whole = [e for e in by_code("levers/task12", "F3") if not e.mistake_at]
    # Only F_45 balances G5 = 294 N: without the weight, its 1991 N change by 294 N.
    change = abs(whole[0].values["F_4_3"] - right["F_4_3"])
    assert change == pytest.approx(30 * 9.8)


@pytest.mark.parametrize("name", SIX)
def test_own_numbers_put_in_are_the_program_with_them_substituted(name: str) -> None:
    """`Sheet.replayed` equals `substituted`, in Python's own numbers, by the recomputed values."""
    task = task_of(name)
    task.usual()
    sheet = task.sheet(0)
    names = [q.name for q in sheet.requested if q.name is not None and q.name != "0"][::3]
    right = {name: float(np.reshape(sheet.exact_trace.value[name], -1)[0]) for name in names}
    own: Mapping[NumberName, tuple[float, bool]] = {
        name: (value * 1.1, True) for name, value in right.items()
    }
    local, trace = sheet.replayed(own)
    program = substituted(sheet.program, own)
    put: dict[str, object] = {str(name): np.array([value]) for name, (value, _) in own.items()}
    data = {**sheet.data, **put}
    expected = evaluate(program, data, Float64())
    for step in sheet.program.steps:
        one, two = (flat(t.value[step.out]) for t in (trace, expected))
        np.testing.assert_allclose(one, two, rtol=1e-9, atol=1e-9)
    first = min(own, key=lambda name: sheet.order[name])
    assert local[first] == pytest.approx(right[first])


def test_the_key_lists_segments_as_long_as_the_right_one() -> None:
    """pb₃ = 44.9 mm and bb₃ = 45.6 mm in the third example cannot be distinguished."""
    hidden = key_of_task(task_of("linkages/ex3")).hidden
    assert "v_B3: b-b3" in hidden["V6"]
    assert not any(place.startswith("v_E:") for place in hidden["V6"])
