"""The numbers of the result tables follow from the solution: places, senses, sizes, directions."""

from __future__ import annotations

import re
from collections.abc import Iterator
from io import BytesIO

import numpy as np
import openpyxl
import pytest
from cases import each
from doors import (
    PlanKind,
    Solution,
    Table,
    crank_cycle_of,
    drawn_forces,
    get_language,
    note_document,
    numbers_workbook,
    plain_document,
    quantities_over,
    result_columns,
    results_document,
    settle,
    size_label,
    statics_of,
    values_over,
)
from texts import protocol, result_tables
from worked import problem_of

from planmethod import loads

EN = get_language("en")
TURN = {"counter-clockwise": 1.0, "clockwise": -1.0, "—": 0.0}
CASES = (
    ("press/press", None),
    ("press/press", (99.0, 150.0, 219.0)),
    ("levers/task12", None),
    ("linkages/ex3", (20.0, 260.0)),
)


def tables_of(solution: Solution) -> dict[str, list[Table]]:
    """Return the tables by their first head, one for each position."""
    found: dict[str, list[Table]] = {}
    for node in results_document(solution, EN).nodes:
        if isinstance(node, Table):
            key = f"{node.head[0]} {node.head[-1]}" if node.head[0] == "vector" else node.head[0]
            if node.head[1].startswith("v, "):
                key = "sliding"
            found.setdefault(key, []).append(node)
    return found


def rows_of(table: Table) -> Iterator[list[str]]:
    for row in table.rows:
        yield [cell.replace("−", "-") for cell in row]


def is_told(cell: str, value: float) -> bool:
    """Return whether a cell is a number rounded to its last digit."""
    if cell == "—":
        return True
    room = 0.501 * 10.0 ** -len(cell.partition(".")[2]) if "e" not in cell else 1e-3 * abs(value)
    return abs(float(cell) - value) <= max(room, 1e-9)


@each("name, positions", CASES)
def test_points_and_links_have_their_places_sizes_and_senses(
    name: str, positions: tuple[float, ...] | None
) -> None:
    solution = Solution(problem_of(name), positions=positions)
    tables = tables_of(solution)
    turned = set()
    for index, (points, links) in enumerate(zip(tables["point"], tables["link"], strict=True)):
        for point, x, y, v, _, a, _ in rows_of(points):
            moving = solution.points[solution.problem.names_of_letters.get(point, point)]
            place = complex(moving.place[index])
            assert is_told(x, place.real) and is_told(y, place.imag), point
            assert is_told(v, abs(complex(moving.velocity[index]))), point
            assert is_told(a, abs(complex(moving.acceleration[index]))), point
        for link, _, omega, _, sense, epsilon, _, way in rows_of(links):
            turning = solution.links[link]
            rates = float(turning.omega[index]), float(turning.epsilon[index])
            for cell, told, rate in zip((omega, epsilon), (sense, way), rates, strict=True):
                assert is_told(cell, rate), (link, cell, rate)
                if abs(rate) > 1e-9:
                    assert TURN[told] == np.sign(rate), (link, told, rate)
                turned.add(told)
    assert len(tables["point"]) == len(solution.positions)
    assert {"clockwise", "counter-clockwise"} <= turned


@each("name, positions", CASES)
def test_vectors_have_the_segments_that_are_read_and_their_results(
    name: str, positions: tuple[float, ...] | None
) -> None:
    solution = Solution(problem_of(name), positions=positions)
    tables = tables_of(solution)
    quantities = {one.symbol: one for one in solution.legend.values()}
    checked = 0
    for key, found in tables.items():
        if not key.startswith("vector"):
            continue
        kind = PlanKind.ACCELERATION if "²" in key else PlanKind.VELOCITY
        for index, table in enumerate(found):
            scale = solution.plan_scale(kind, index)
            for symbol, _, exact, read, value in rows_of(table):
                mm = float(read) * scale.per_mm
                assert float(value) == pytest.approx(mm, rel=6e-4), symbol
                if symbol in quantities:
                    size = abs(float(solution.exact(quantities[symbol])[index]))
                    assert is_told(exact, size / scale.per_mm), symbol
                    checked += 1
    assert checked > 8


@each("name, positions", [case for case in CASES if case[0] != "linkages/ex3"])
def test_reactions_have_their_sizes_directions_and_couples(
    name: str, positions: tuple[float, ...] | None
) -> None:
    solution = Solution(problem_of(name), positions=positions)
    statics = statics_of(solution)
    for index, table in enumerate(tables_of(solution)["joint"]):
        rows = list(rows_of(table))[: len(statics.reactions)]
        for (_, links, force, read, phi, moment, _), joint in zip(
            rows, statics.reactions, strict=True
        ):
            value = complex(joint.force[index])
            assert links.startswith(joint.on), links
            assert is_told(force, abs(value)), links
            assert is_told(read, abs(float(drawn_forces(statics).read(size_label(joint))[index])))
            if phi != "—":
                off = float(phi) - float(np.degrees(np.angle(value)))
                assert abs((off + 180.0) % 360.0 - 180.0) < 0.0051, (links, phi)
            assert is_told(moment, float(joint.moment[index])), links


PARALLELOGRAM = """
[frame]
A = [0, 0]
D = ["drawn", 0]
[drawn]
phi_3 = {phi}
[links.1]
points = ["A", "B"]
AB = {crank}
[links.2]
points = ["B", "C"]
BC = {rod}
[links.3]
points = ["D", "C"]
DC = {crank}
[driver]
link = "1"
phi = {phi}
omega = {omega}
[assembly]
C = "above D"
D = "right of A"
"""


@each("crank, rod, phi, omega", [(0.06, 0.15, 90, 50), (0.1, 0.1, 90, 150), (0.07, 0.11, 35, 190)])
def test_zeros_of_a_parallelogram_are_told_as_zeros(
    crank: float, rod: float, phi: float, omega: float
) -> None:
    """Differences of equal terms are zeros: beside ω² an angular acceleration of 1e-12 is nothing.

    All angular accelerations are of that kind, so that the largest of them says nothing.
    """
    text = PARALLELOGRAM.format(crank=crank, rod=rod, phi=phi, omega=omega)
    solution = Solution(loads(text, name="parallelogram"))
    noise = [abs(solution.links[link].epsilon[0]) for link in "23"]
    assert 0.0 < max(noise) < 1e-9  # what float64 leaves
    ((links,),) = [tables_of(solution)["link"]]
    told = {str(row[0]): [str(cell) for cell in row[1:]] for row in links.rows}
    assert told["2"][1:] == ["0", "0", "—", "0", "0", "—"]
    assert told["3"][3:] == ["counter-clockwise", "0", "0", "—"]
    columns = {one.head: one.cells for one in result_columns(solution, [0], EN)}
    for symbol in ("ω_{2}", "ε_{2}", "ε_{3}"):
        (cell,) = columns[symbol]
        assert (cell.text, cell.sense or 0) == ("0", 0)


INERTIA = """
[dynamics.links.2]
mass = 3
centre = "C"
inertia = 0.006
"""


FAST = (
    PARALLELOGRAM.format(crank=0.1, rod=0.1, phi=90, omega=1500)
    .replace("phi = 90\n", "phi = { from = 7, count = 12 }\n")
    .replace("phi_3 = 90", "phi_1 = 90\nphi_3 = 90")
    .replace('C = "above D"', 'C = { keep = "parallel" }')
)
"""A parallelogram of twelve positions, so fast that its noise is above 1e-12."""


def test_no_position_of_a_parallelogram_has_noise() -> None:
    """Tables of twelve positions, and every line of a protocol, the couples of inertia too."""
    solution = Solution(loads(FAST + INERTIA, name="parallelogram"))
    noise = np.abs(solution.links["2"].epsilon)
    assert 1e-12 < noise.max() < 1e-6
    index = int(noise.argmax())
    for told in (result_tables(solution, "en"), protocol(solution, lang="en", position=index)):
        assert not re.search(r"10⁻(?!³)", told)
    assert "M_Φ2 does not act in this position" in told


def test_no_part_of_the_project_of_a_parallelogram_has_noise() -> None:
    """Its note, the table of the turn in it, the greatest differences, and the workbook."""
    project = settle(loads(FAST, name="parallelogram"))
    assert not re.search(r"10⁻[⁶⁷⁸⁹¹]", plain_document(note_document(project, EN), EN))
    every = openpyxl.load_workbook(BytesIO(numbers_workbook(project))).worksheets
    cells = [cell.value for sheet in every for row in sheet.iter_rows() for cell in row]
    numbers = [abs(cell) for cell in cells if isinstance(cell, float) and cell]
    assert len(numbers) > 150
    assert min(numbers) > 1e-7
    turn = crank_cycle_of(project.solution)
    for one in quantities_over(turn, ["epsilon_3", "epsilon_2", "omega_2"]):
        assert not values_over(turn, one, turn.positions).any()
