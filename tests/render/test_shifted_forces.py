"""The sheet of the forces with one force of inertia: its shift drawn, arms to its line."""

from __future__ import annotations

import re
from functools import cache
from itertools import chain

import numpy as np
import pytest
from doors import (
    Drawing,
    DrawingItem as Item,
    ForceReading,
    LeverReading,
    QuantityValues,
    Severity,
    Solution,
    Stroke,
    View,
    get_language,
    inspect,
    kinematics_sheets,
    parse_quantity,
    statics_of,
)
from lettered import computed, lever_lines, load_lines, moment_lines
from loaded import with_resultant
from test_forces_sheet import arrows, as_on, couples, shown, views, within
from worked import drawn_sheets, problem_of

RU = get_language("ru")

SHIFTED = {"levers/six-link": "2", "press/press": "3"}
"""Worked problems, and the link whose force is shifted."""


@cache
def sheet_of(name: str) -> Drawing:
    (sheet,) = kinematics_sheets(with_resultant(problem_of(name)), layout="forces")
    return sheet


@cache
def reading_of(name: str) -> ForceReading:
    return ForceReading(as_on(sheet_of(name), with_resultant(problem_of(name))), 0)


def lines(items: list[Item], view: View, tag: str) -> list[Stroke]:
    found = within(items, view.box)
    return [item for item in found if isinstance(item, Stroke) and item.tag == tag]


def shift_and_force(name: str) -> tuple[float, complex]:
    """Return h, m, and Φ, N, from the motion alone."""
    problem = problem_of(name)
    assert problem.dynamics is not None
    mass = problem.dynamics.masses[SHIFTED[name]]
    assert mass.centre is not None
    solution = Solution(problem)
    a = complex(solution.points[mass.centre].acceleration[0])
    epsilon = float(solution.links[SHIFTED[name]].epsilon[0])
    return mass.inertia * abs(epsilon) / (mass.mass * abs(a)), -mass.mass * a


@pytest.mark.dear
@pytest.mark.parametrize("name", [*SHIFTED, "levers/task12", "press/press-stone"])
def test_norm_control_finds_no_errors(name: str) -> None:
    sheet = sheet_of(name)
    assert [f for f in inspect(sheet) if f.severity is Severity.ERROR] == []


@pytest.mark.parametrize("name", SHIFTED)
def test_the_drawn_shift_is_h_across_the_force(name: str) -> None:
    sheet, link = sheet_of(name), SHIFTED[name]
    h, force = shift_and_force(name)
    drawn = [
        (line, view)
        for view in views(sheet, "position")
        for line in lines(sheet.items, view, f"shift T_{{{link}}}")
    ]
    assert len(drawn) == 2  # the scheme with all loads, and the group
    for line, view in drawn:
        start, end = line.points
        assert abs(end - start) * view.per_mm == pytest.approx(h, rel=1e-6)
        assert abs(((end - start).conjugate() * force).real) < 1e-6 * abs(force)
        # The arrow lies on the line of action through T.
        tag = f"force Φ_{{{link}}}"
        (arrow,) = lines(sheet.items, view, tag)
        across = ((arrow.points[0] - end).conjugate() * force).imag / abs(force)
        assert abs(across) < 1e-6
        (action,) = lines(sheet.items, view, "line of action")
        assert action.points[0] == end
    (shift,) = reading_of(name).statics.board.shifts.values()
    read = abs(reading_of(name).read_number(shift.length))  # results of the formulas
    assert read == pytest.approx(h / drawn[0][1].per_mm, abs=0.3)
    assert f"= {read:.1f} мм".replace(".", ",") in shown(sheet)


@pytest.mark.parametrize("name", SHIFTED)
def test_the_couple_is_gone_and_the_others_stay(name: str) -> None:
    sheet, link = sheet_of(name), SHIFTED[name]
    there = set(chain.from_iterable(couples(sheet, view) for view in sheet.views))
    assert f"M_{{Φ{link}}}" not in there
    assert ("M_{Φ3}" in there) is (name == "levers/six-link")
    for view in views(sheet, "position")[:1]:
        assert f"Φ_{{{link}}}" in dict(arrows(sheet, view))


@pytest.mark.parametrize("name", SHIFTED)
def test_moments_have_the_arm_of_the_shifted_line(name: str) -> None:
    reading, link = reading_of(name), SHIFTED[name]
    told = [line for plan in reading.plans for line in moment_lines(reading, plan)]
    assert not any(f"M_{{Φ{link}}}" in line for line in told)
    pivot = {"2": "C", "3": "O3"}[link]
    hand = QuantityValues(reading.solution)
    arm = hand.read(parse_quantity(f"arm inertia {link} about {pivot}"))
    (line,) = (line for line in told if line.startswith("h_") and f"h_{{Φ{link}}} = " in line)
    written = re.search(rf"h_{{Φ{link}}} = ([\d,]+)", line)
    assert written is not None
    assert float(written[1].replace(",", ".")) == pytest.approx(arm)
    for text in told:
        match = re.match(r"^\S+ = (.*\d.*) = ([\d,]+) (?:Н|Н·м)$", text)
        if match:
            value = float(match[2].replace(",", "."))
            assert computed(match[1]) == pytest.approx(value, rel=5e-3)


@pytest.mark.parametrize("name", SHIFTED)
def test_the_arm_is_that_of_force_and_couple(name: str) -> None:
    """Moment of Φ at S and of M_Φ about a point, over Φ."""
    link, mu_l = SHIFTED[name], reading_of(name).solution.scales
    pivot = {"2": "C", "3": "O3"}[link]
    plain = Solution(problem_of(name), scales=mu_l)
    given = {g.applied.name: g.applied for g in statics_of(plain).board.given}
    force = given[f"Φ_{{{link}}}"]
    assert force.point is not None
    arm = plain.points[force.point].place - plain.points[pivot].place
    moment = (np.conj(arm) * force.force).imag + given[f"M_{{Φ{link}}}"].couple
    expected = abs(float(moment[0])) / abs(complex(force.force[0]))
    shifted = QuantityValues(reading_of(name).solution)
    found = shifted.exact(parse_quantity(f"arm inertia {link} about {pivot}"))
    per_mm = next(iter(mu_l.values())).per_mm
    assert found * per_mm == pytest.approx(expected, rel=1e-9)


def test_texts_describe_the_shift_and_the_remaining_couple() -> None:
    loads = load_lines(reading_of("levers/six-link"))
    h, _ = shift_and_force("levers/six-link")
    (line,) = (line for line in loads if line.startswith("h_{2} = M_{Φ2}/Φ_{2} = "))
    assert line.endswith(" м")
    numbers, value = line.split(" = ")[2:]
    assert float(value[:-2].replace(",", ".")) == pytest.approx(computed(numbers), rel=5e-4)
    assert computed(numbers) == pytest.approx(h, rel=2e-2)  # from readings to half a millimetre
    assert any(line.startswith("M_{Φ2} = J_{S2}·ε_{2} = ") for line in loads)
    text = shown(sheet_of("levers/six-link"))
    assert "приложена в точке" in text
    assert "у звена 1 нет силы инерции" in text
    task = sheet_of("levers/task12")
    assert "больше наибольшего размера механизма" in shown(task)
    (plain,) = drawn_sheets("levers/task12", layout="forces")
    assert "больше наибольшего размера механизма" not in shown(plain)


@pytest.mark.parametrize("name", SHIFTED)
def test_the_lever_has_the_force_beside_the_centre_of_mass(name: str) -> None:
    reading, link = reading_of(name), SHIFTED[name]
    same = reading.solution.scales
    fine = ForceReading(Solution(with_resultant(problem_of(name)), ruler=1e-7, scales=same), 0)
    lever, (exact,) = LeverReading(reading), LeverReading(fine).shifts
    (shift,) = lever.shifts
    h, _ = shift_and_force(name)
    omega = float(reading.solution.links[link].omega[0])
    assert abs(exact.line[1] - exact.line[0]) * lever.per_mm == pytest.approx(h * abs(omega), 1e-6)
    length = abs(shift.line[1] - shift.line[0])
    (hung,) = (force for force in lever.forces if force.symbol == f"Φ_{{{link}}}")
    assert hung.at == shift.line[1]
    (told,) = (line for line in lever_lines(reading) if line.startswith(f"(s_{{{link}}}t_"))
    read = float(told.rpartition(" = ")[2].removesuffix(" мм").replace(",", "."))
    assert read == pytest.approx(length, abs=0.06)  # drawn as it is computed
    *_, view = views(sheet_of(name), "velocity")
    (line,) = lines(sheet_of(name).items, view, f"shift t_{{{link}}}")
    assert abs(line.points[1] - line.points[0]) == pytest.approx(length, rel=1e-6)


@pytest.mark.parametrize("name", SHIFTED)
def test_the_lever_is_in_balance(name: str) -> None:
    reading = ForceReading(Solution(with_resultant(problem_of(name)), ruler=1e-7), 0)
    lever = LeverReading(reading)
    moments = [abs(one.force) * one.arm for one in lever.forces]
    moments += [one.lever_moment for one in lever.couples]
    assert sum(moments) == pytest.approx(0.0, abs=1e-6 * max(map(abs, moments)))
