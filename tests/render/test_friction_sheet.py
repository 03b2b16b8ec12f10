"""The sheet, the protocol and the record of the forces with friction."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from cases import each
from doors import (
    CIRCLE,
    CONE,
    MIN_RADIUS,
    Arc,
    ProblemError,
    Solution,
    Stroke,
    csv_columns,
    forces_columns,
    friction_narrator,
    friction_picture,
    get_language,
    is_enlarged,
    problem_load as load,
    problem_loads as loads,
    rubbed_reading,
    solution_record as record,
)
from worked import path_of

TEXT = path_of("machines/rubbing-crank").read_text("utf-8")
SAY = get_language("ru").notation


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
    assert circle.radius == pytest.approx(MIN_RADIUS, rel=0.01)
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


GUIDE = """
[frame]
O = [0, 0]
guides.x-x = {{ through = "O", angle = 0 }}
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B", "S"]
AB = 0.4
S = {{ on = "AB", at = 0.15 }}
[links.3]
points = ["B"]
slides = {{ on = "x-x" }}
[driver]
link = "1"
phi = {phi}
omega = 12
epsilon = 5
[assembly]
B = "right of A"
[dynamics]
gravity = 9.81
[dynamics.links.1]
mass = 1
centre = "A"
inertia = 0.01
[dynamics.links.2]
mass = 2
centre = "S"
inertia = 0.03
[dynamics.links.3]
mass = 3
centre = "B"
[[loads]]
link = "3"
at = "B"
force = 60
angle = 160
[friction]
f = {f}
"""


def by_hand(solution: Solution, f: float) -> dict[str, complex]:
    """Solve nine equations of three links, with the friction of the guide by its own force."""
    places = {name: complex(solution.points[name].place[0]) for name in "OABS"}
    a, b, s = (places[name] - places["O"] for name in "ABS")
    moved = {name: complex(solution.points[name].acceleration[0]) for name in "ABS"}
    turned = {link: float(solution.links[link].epsilon[0]) for link in "12"}
    way = np.sign(solution.points["B"].velocity[0].real)
    push = 60.0 * np.exp(1j * np.radians(160.0))

    def arm(at: complex) -> tuple[float, float]:
        return -at.imag, at.real  # of the moment of (1, 0) and (0, 1)

    rub = 0.0
    for _ in range(200):
        # O on 1 (x, y), A on 2, B on 2, the guide on 3 (y, moment), moment on 1.
        matrix, right = np.zeros((9, 9)), np.zeros(9)
        given = {
            0: (1.0, moved["A"], a, 0.01 * turned["1"]),
            3: (2.0, moved["S"], s, 0.03 * turned["2"]),
            6: (3.0, moved["B"], b, 0.0),
        }
        for row, (mass, acceleration, at, couple) in given.items():
            inertia = mass * acceleration + 9.81j * mass
            right[row : row + 2] = inertia.real, inertia.imag
            right[row + 2] = couple + (at.conjugate() * inertia).imag
        right[6] -= push.real - rub * way
        right[7] -= push.imag
        right[8] -= (b.conjugate() * (push - rub * way)).imag
        for row, column, at, sign in ((0, 0, 0j, 1), (0, 2, a, -1), (3, 2, a, 1), (3, 4, b, 1),
                                      (6, 4, b, -1)):  # fmt: skip
            matrix[row, column] = matrix[row + 1, column + 1] = sign
            matrix[row + 2, column : column + 2] = sign * np.array(arm(at))
        matrix[2, 8] = 1.0
        matrix[7, 6], matrix[8, 6], matrix[8, 7] = 1.0, b.real, 1.0
        x = np.linalg.solve(matrix, right)
        rub = f * abs(x[6])
    whole = {name: complex(x[k], x[k + 1]) for name, k in (("O", 0), ("A", 2), ("B", 4))}
    return {**whole, "guide": complex(-rub * way, x[6]), "moment": complex(x[8])}


def test_friction_in_a_guide_is_shown_for_every_reaction() -> None:
    phi, sheet = 70.0, dict[str, dict[str, Any]]()
    solution = Solution(loads(GUIDE.format(phi=phi, f=0.34), name="guide"))
    (entry,) = record(solution)["positions"]
    still, right = by_hand(solution, 0.0), by_hand(solution, 0.34)
    for pair in entry["forces"]["friction"]["pairs"]:
        name = "guide" if "phi_deg" in pair else pair["joint"]
        sheet[name], end = pair, pair["converged"]
        assert pair["f_without"] == pytest.approx(abs(still[name]), rel=1e-9)
        on = {"O": "1", "A": "2", "B": "2", "guide": "3"}[name]  # of the equations
        told = complex(end["fx"], end["fy"]) * (1 if pair["on"] == on else -1)
        assert told == pytest.approx(right[name], rel=1e-9)
    assert len(sheet) == 4
    driving = entry["forces"]["friction"]["driving"]["converged"]["moment"]
    assert driving == pytest.approx(right["moment"].real, rel=1e-9)
    columns = csv_columns(solution)
    for pair in sheet.values():
        column = f"F.{pair['joint']}.{pair['on']}-{pair['from']}.rubbed"
        assert columns[column][0] == pytest.approx(pair["converged"]["f"], rel=1e-12)
        assert abs(pair["f_without"] / pair["converged"]["f"] - 1) > 0.01
    assert [name for name in columns if name.startswith("friction.")] == ["friction.B.3-0"]
    table = friction_narrator(solution, get_language("en"), 0).table()
    assert len(table.rows) == 4
    several = Solution(loads(GUIDE.format(phi="[10, 70, 130, 190]", f=0.34), name="guide"))
    heads = [head for head, *_ in forces_columns(several, get_language("en").note)]
    assert sum(head.endswith("with friction") for head in heads) == 5


def test_the_spreadsheet_has_the_converged_values(solution: Solution) -> None:
    columns = csv_columns(solution)
    assert columns["efficiency"][0] == pytest.approx(0.9454, abs=1e-4)
    assert columns["driving.force.rubbed"][0] > columns["driving.force"][0]
    assert columns["friction.B.3-0"][0] == pytest.approx(27.49, abs=0.01)
    assert columns["driving.moment"][0] == pytest.approx(0.1 * columns["driving.force"][0])


@each(
    "table, told",
    [
        ("f = -1", "from 0 to 10.*number like"),
        ("f_pin = 0.1", "depends on its radius"),
        ('pairs."B 9-0" = { f = 1 }', "link '9' does not exist"),
        ('pairs."X 3-0" = { f = 1 }', "point 'X' does not exist"),
        ('pairs."B 3-0" = 1', "expected"),
    ],
)
def test_friction_that_cannot_be(table: str, told: str) -> None:
    text = TEXT[: TEXT.index("[friction]")]
    with pytest.raises(ProblemError, match=told):
        loads(f"{text}\n[friction]\n{table}\n", name="faulty")


def test_a_driver_at_rest_has_no_sense_of_friction() -> None:
    with pytest.raises(ProblemError, match="direction of friction is undefined"):
        loads(TEXT.replace("omega = 10 ", "omega = 0 "), name="still")
