"""Quantities over the turn, against solutions in the same positions and against differences."""

from __future__ import annotations

import numpy as np
import pytest
from cases import each
from doors import (
    CrankCycle,
    QuantityKind,
    Solution,
    UnknownQuantityError,
    graph_quantities,
    kinds_load as load,
    quantities_over,
    usual_labels,
    values_over,
)
from msgspec.structs import replace
from worked import path_of

FILES = ("linkages/ex3", "linkages/ex1", "levers/six-link", "levers/task-22")
RATES = ((20.0, 0.0), (-5.0, 13.0))


def turn_of(name: str, rate: float, acceleration: float) -> CrankCycle:
    problem = load(path_of(name))
    assert problem is not None
    drive = replace(problem.drive, rate=rate, acceleration=acceleration)
    return CrankCycle(Solution(replace(problem, drive=drive, dynamics=None)))


@each("name", FILES)
def test_every_quantity_is_that_of_a_solution(name: str) -> None:
    for rate, acceleration in RATES:
        turn = turn_of(name, rate, acceleration)
        at = turn.positions[:5]
        solved = turn.solution.with_positions(at.tolist())
        links = [link for link in solved.links if link != "0"]
        for one in graph_quantities(solved.points, links, turn.unit.problem.drive.link).values():
            found = values_over(turn, one, at)
            motion = solved.points.get(one.of)
            vectors = {} if motion is None else {
                QuantityKind.PLACE: motion.place,
                QuantityKind.VELOCITY: motion.velocity,
                QuantityKind.ACCELERATION: motion.acceleration,
            }  # fmt: skip
            if one.kind in vectors:
                vector = vectors[one.kind]
                for past in map(solved.points.__getitem__, one.key.names[1:]):
                    gone = {"v": past.velocity, "a": past.acceleration}[one.kind.word]
                    vector = vector - gone
                expected = {"": np.abs(vector), "x": vector.real, "y": vector.imag}[one.axis]
            elif one.kind in (QuantityKind.OMEGA, QuantityKind.EPSILON):
                expected = getattr(solved.links[one.of], one.kind.word)
            elif one.kind is QuantityKind.DIRECTION:
                turned = (found - solved.links[one.of].phi_deg + 180.0) % 360.0 - 180.0
                assert np.abs(turned).max() < 1e-9
                assert np.abs(np.diff(found)).max() < 180.0
                continue
            else:
                continue
            assert found == pytest.approx(expected, rel=1e-10, abs=1e-10), one.label


@each("name", FILES)
def test_analogues_are_differences_of_places(name: str) -> None:
    turn, step = turn_of(name, 20.0, 0.0), 2.0**-9
    middle = float(turn.positions[3])
    at = middle + np.degrees(step * np.arange(-2, 3))
    one = np.array([1, -8, 0, 8, -1]) / 12.0 / step
    two = np.array([-1, 16, -30, 16, -1]) / 12.0 / step**2
    links = [link for link in turn.unit.problem.mechanism.links if link != "0"]
    crank = turn.unit.problem.drive.link
    moving = [p for k in links for p in turn.unit.problem.bodies[k].points]
    known = graph_quantities(moving, links, crank)
    for quantity in known.values():
        place = {
            QuantityKind.TRANSFER: quantity.axis,
            QuantityKind.TRANSFER_2: quantity.axis,
            QuantityKind.RATIO: "phi",
            QuantityKind.RATIO_2: "phi",
        }
        base = place.get(quantity.kind, "")
        if not base:
            continue
        row = values_over(turn, known[f"{base}_{quantity.of}"], at)
        row = np.radians(row) if base == "phi" else row
        weights = one if quantity.kind.order == 1 else two
        found = values_over(turn, quantity, np.array([middle]))[0]
        assert found == pytest.approx(float(row @ weights), rel=1e-6, abs=2e-6), quantity.label


def test_labels_are_those_of_points_and_links() -> None:
    turn = turn_of("linkages/ex3", 20.0, 0.0)
    assert [q.label for q in quantities_over(turn, ["u_31", "output", "u_31"])] == [
        "u_31",
        *usual_labels(turn),
    ]
    with pytest.raises(UnknownQuantityError, match="did you mean 'v_q_D'"):
        quantities_over(turn, ["v_qz_D"])
