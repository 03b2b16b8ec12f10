"""The sheet, the protocol and the record of the forces with friction."""

from __future__ import annotations

import numpy as np
import pytest
from cases import each
from worked import path_of

from planmethod.errors import ProblemError
from planmethod.note.records.solution import record
from planmethod.note.records.spreadsheet import csv_columns
from planmethod.note.wording import language
from planmethod.problem import load, loads
from planmethod.render.forces.friction import CIRCLE, CONE, LEAST, friction_picture, is_enlarged
from planmethod.render.ink.drawing import Arc, Stroke
from planmethod.solved.forces.friction import rubbed_reading
from planmethod.solved.solution import Solution

TEXT = path_of("machines/rubbing-crank").read_text("utf-8")
SAY = language("ru").say


@pytest.fixture(scope="module")
def solution() -> Solution:
    return Solution(load(path_of("machines/rubbing-crank")))


def test_a_reaction_touches_its_circle(solution: Solution) -> None:
    reading = rubbed_reading(solution, 0)
    assert is_enlarged(reading)
    picture = friction_picture(reading, 0, 5.0, SAY)
    (circle,) = [
        item for item in picture.items if isinstance(item, Arc) and item.tag.startswith(CIRCLE)
    ]
    assert circle.radius == pytest.approx(LEAST, rel=0.01)
    shafts = [
        item for item in picture.items if isinstance(item, Stroke) and item.tag == "force R_{21}"
    ]
    tail, head = max((s.points for s in shafts), key=lambda ends: abs(ends[-1] - ends[0]))[:2]
    along = (head - tail) / abs(head - tail)
    arm = ((circle.centre - tail) * along.conjugate()).imag
    assert abs(arm) == pytest.approx(circle.radius, rel=0.05)
    # It turns link 2 about the pin against the turning relative to the crank.
    pair = next(one for one in reading.friction.pairs if one.name == "A 1-2")
    turns = ((tail - circle.centre).conjugate() * along).imag
    assert np.sign(turns) == -pair.sense[0]


def test_a_reaction_of_a_guide_is_on_its_cone(solution: Solution) -> None:
    reading = rubbed_reading(solution, 0)
    picture = friction_picture(reading, 0, 5.0, SAY)
    sides = [
        item.points[1] - item.points[0]
        for item in picture.items
        if isinstance(item, Stroke) and item.tag.startswith(CONE)
    ]
    turned = sorted(np.degrees(np.angle(side / sides[0])) for side in sides[1:])
    assert turned == pytest.approx([-5.7106, 5.7106], abs=1e-3)


def test_the_record_has_both_corrections(solution: Solution) -> None:
    made = record(solution)
    friction = made["positions"][0]["forces"]["friction"]
    driving = friction["driving"]
    once, end = driving["once"]["force"], driving["converged"]["force"]
    assert friction["change"]["force"] == pytest.approx(abs(end - once) / abs(end))
    assert 0 < friction["change"]["force"] < 0.005
    assert friction["efficiency"] == pytest.approx(
        driving["without"]["power"] / driving["converged"]["power"]
    )
    assert not friction["self_locking"]
    guide = next(one for one in friction["pairs"] if one["pair"] == "B 3-0")
    assert guide["phi_deg"] == pytest.approx(np.degrees(np.arctan(0.1)))
    assert guide["converged"]["fx"] == pytest.approx(
        -np.sign(guide["rate"]) * guide["converged"]["friction"]
    )
    crank = next(one for one in friction["pairs"] if one["pair"] == "O 1-0")
    assert crank["rho"] == pytest.approx(0.12 * 0.02)
    turn = made["friction"]["turn"]
    assert turn["efficiency"] == pytest.approx(turn["work_without"] / turn["work"])
    assert turn["work_without"] == pytest.approx(4 * 0.1 * 1000, rel=1e-3)  # P over both strokes


def test_the_spreadsheet_has_what_converged(solution: Solution) -> None:
    columns = csv_columns(solution)
    assert columns["efficiency"][0] == pytest.approx(0.9454, abs=1e-4)
    assert columns["driving.force.rubbed"][0] > columns["driving.force"][0]
    assert columns["friction.B.3-0"][0] == pytest.approx(27.49, abs=0.01)
    assert columns["driving.moment"][0] == pytest.approx(0.1 * columns["driving.force"][0])


@each(
    "table, told",
    [
        ("f = -1", "from 0 to 10.*number like"),
        ("f_pin = 0.1", "goes with its radius"),
        ('pairs."B 9-0" = { f = 1 }', "no link '9'"),
        ('pairs."X 3-0" = { f = 1 }', "no point 'X'"),
        ('pairs."B 3-0" = 1', "expected"),
    ],
)
def test_friction_that_cannot_be(table: str, told: str) -> None:
    text = TEXT[: TEXT.index("[friction]")]
    with pytest.raises(ProblemError, match=told):
        loads(f"{text}\n[friction]\n{table}\n", name="faulty")


def test_a_driver_that_stands_has_no_sense_of_friction() -> None:
    with pytest.raises(ProblemError, match="no sense"):
        loads(TEXT.replace("omega = 10 ", "omega = 0 "), name="still")
