"""Transfer functions through segments of plans, against positions that are differentiated."""

from __future__ import annotations

import numpy as np
import pytest
from cases import each
from doors import (
    Float64,
    ModelProblem as Problem,
    PointName,
    Solution,
    Sweep,
    drafting_of,
    kinds_load as load,
    problem_loads as loads,
    transfers_of,
)
from msgspec.structs import replace
from worked import path_of

from benchmarks.generator import random_problem

FILES = ("linkages/ex1", "linkages/ex3", "levers/six-link", "levers/task-22", "press/press")
RATES = ((20.0, 0.0), (-7.0, 0.0), (5.0, 11.0), (-5.0, 13.0))
STEP = 2.0**-11
"""Step of the crank angle, radians."""


def problem_of(name: str) -> Problem:
    if name.isdecimal():
        return loads(random_problem(int(name))[0], name=name)
    problem = load(path_of(name))
    assert problem is not None
    return problem


def differentiated(problem: Problem, at: float) -> dict[str, tuple[complex, complex]]:
    """Return first and second derivatives of places, and of directions of links, by the angle."""
    turns = np.radians(at) + STEP * np.arange(-3, 4)
    solution = Solution(replace(problem, dynamics=None), positions=np.degrees(turns).tolist())
    reading = solution.read(Float64())
    kin, draft = solution.construction.kinematics, solution.construction.draft
    rows = {n: reading.point(PointName(place)) for n, (_, place) in kin.velocity.named.items()}
    for link in problem.mechanism.links:
        course = reading.line_vector(draft.axes[link])
        rows[f"link {link}"] = np.unwrap(np.angle(course)).astype(complex)
    one = np.array([-1, 9, -45, 0, 45, -9, 1]) / 60.0 / STEP
    two = np.array([2, -27, 270, -490, 270, -27, 2]) / 180.0 / STEP**2
    return {name: (complex(row @ one), complex(row @ two)) for name, row in rows.items()}


@each("name", [*FILES, *map(str, range(12))])
def test_they_are_the_derivatives_of_positions(name: str) -> None:
    problem = problem_of(name)
    if not problem.drive.is_crank:
        return
    at = float(problem.drive.positions[0])
    known = differentiated(problem, at)
    for rate, acceleration in RATES:
        drive = replace(problem.drive, rate=rate, acceleration=acceleration)
        found = Sweep(replace(problem, drive=drive, dynamics=None), ["transfers"]).table([at])
        largest = [max(abs(pair[k]) for pair in known.values()) for k in (0, 1)]
        for label, values in found.items():
            kind, _, of = label.rpartition("_")
            order = kind in ("a_q", "epsilon_q")
            if kind in ("v_q", "a_q"):
                if not any(of in body.points for body in problem.bodies.values()):
                    continue  # a coincident point stays under its pin
                expected = abs(known[of][order])
            elif kind in ("u", "epsilon_q"):
                link = of if order else of.partition("/")[0] if "/" in of else of[:-1]
                expected = known[f"link {link}"][order].real
            else:
                continue
            assert values[0] == pytest.approx(expected, rel=1e-6, abs=1e-7 * largest[order])


def test_the_hand_takes_them_from_segments_with_their_sigma() -> None:
    problem = problem_of("levers/six-link")
    solution = Solution(problem)
    transfers, drafted = transfers_of(solution), drafting_of(solution).spreads
    assert transfers is not None
    quantities = {quantity.label: quantity for quantity in transfers.quantities}
    read = {s.name: float(s.read[0]) for kind in solution.scales for s in solution.segments(kind)}
    expected = {
        "v_q_C": 0.1 * read["p-c"] / read["p-b"],
        "u_21": -0.1 / 0.3 * read["b-c"] / read["p-b"],
        "u_31": 0.1 / 0.15 * read["p-c"] / read["p-b"],
    }
    omega = problem.drive.rate
    for label, value in expected.items():
        assert transfers.read_off(quantities[label])[0] == pytest.approx(value, rel=1e-12)
        own = {"v_q_C": "v_C", "u_21": "omega_2", "u_31": "omega_3"}[label]
        sigma = drafted[label].sigma[0]
        assert sigma == pytest.approx(drafted[own].sigma[0] / abs(omega), rel=1e-9)
        assert abs(value - transfers.exact(quantities[label])[0]) < 3 * sigma


def test_there_are_none_without_a_rotating_crank() -> None:
    problem = problem_of("levers/six-link")
    still = replace(problem, drive=replace(problem.drive, rate=0.0, acceleration=0.0))
    assert transfers_of(Solution(replace(still, dynamics=None))) is None
