"""Tables of many positions and of a turn: each column agrees with its head and unit."""

from __future__ import annotations

import re

import numpy as np
import pytest
from cases import each
from doors import CycleTask, Solution, cycle_columns, diagrams_of, drafting_of, get_language
from msgspec.structs import replace
from texts import result_tables
from worked import problem_of


def number(text: str) -> float:
    plain = text.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-"))
    return float(plain.replace("·10", "e").replace(",", "."))


@each("name", ["linkages/ex3", "linkages/ex2"])
def test_columns_of_many_positions_are_those_of_their_heads(name: str) -> None:
    solution = Solution(problem_of(name), positions=[20.0 + 45.0 * k for k in range(8)])
    text = result_tables(solution, "en")
    lines, seen = re.sub(r"\n[^\n]*read off(.|\n)*?\n\n", "\n\n", text).splitlines(), set()
    for at, line in enumerate(lines):
        if not re.match(r"No\. +φ", line):
            continue
        heads = re.split(r" {2,}", line.strip())
        for i, row in enumerate(lines[at + 2 : at + 10]):
            for head, cell in zip(heads[2:], row.split()[2:], strict=True):
                letter, _, of = head.partition("_")
                if letter in "xyva" and of in solution.points:
                    point = solution.points[of]
                    place = complex(point.place[i])
                    exact = {"x": place.real, "y": place.imag,
                             "v": abs(complex(point.velocity[i])),
                             "a": abs(complex(point.acceleration[i]))}[letter]  # fmt: skip
                    assert number(cell) == pytest.approx(exact, rel=2e-3, abs=2e-4), (head, i)
                    seen.add(letter)
    assert seen >= {"x", "y", "v"}


@each("name", ["linkages/ex3", "linkages/ex2"])
def test_printed_places_give_links_their_lengths(name: str) -> None:
    """The crank's pin by its angle: x = l cos φ, y = l sin φ from the pivot."""
    problem = problem_of(name)
    solution = Solution(problem, positions=[20.0 + 45.0 * k for k in range(8)])
    pivot, pin = problem.drive.pivot, next(
        p for p in problem.bodies[problem.drive.link].points if p != problem.drive.pivot
    )  # fmt: skip
    assert pivot is not None
    letter = problem.lettered(pin)
    origin = complex(problem.bodies["0"].points[pivot])
    length = abs(complex(solution.points[pin].place[0]) - origin)
    lines = result_tables(solution, "en").splitlines()
    at = next(k for k, line in enumerate(lines) if f"x_{letter}" in line.split())
    heads = re.split(r" {2,}", lines[at].strip())
    for i, row in enumerate(lines[at + 2 : at + 10]):
        cells = dict(zip(heads, row.split(), strict=True))
        due = origin + length * np.exp(1j * np.radians(solution.positions[i]))
        told = complex(number(cells[f"x_{letter}"]), number(cells[f"y_{letter}"]))
        assert told == pytest.approx(due, abs=2e-4)


def test_the_columns_of_a_turn_are_derivatives_of_one_another() -> None:
    """v is how the path grows with time, a how v does; the transfer functions, with the angle."""
    problem = problem_of("press/press")
    diagrams = diagrams_of(Solution(replace(problem, cycle=CycleTask("B", count=24))))
    assert diagrams is not None
    omega = abs(problem.drive.rate)
    columns = {
        head: (unit, cells) for head, unit, cells in cycle_columns(diagrams, get_language("en"))
    }
    path, v_q, a_q, v, a = list(columns)[2:]
    assert [columns[head][0] for head in (path, v_q, a_q, v, a)] == ["m", "m", "m", "m/s", "m/s²"]
    assert (v_q[0], a_q[0], v[0], a[0]) == ("v", "a", "v", "a")

    def values(head: str) -> np.ndarray:
        return np.array([number(cell) for cell in columns[head][1]])

    step = 2 * np.pi / 24 / omega
    for whole, rate, scale in ((path, v, 1.0), (v, a, 1.0), (path, v_q, omega), (v_q, a_q, omega)):
        one, two = values(whole), values(rate)
        middle = (np.roll(one, -1) - np.roll(one, 1)) / (2 * step) / scale
        room = 0.12 * np.abs(two).max()
        assert np.abs(middle - two).max() < room, (whole, rate)
    assert values(v) == pytest.approx(values(v_q) * omega, rel=5e-3, abs=2e-3)
    assert values(a) == pytest.approx(values(a_q) * omega**2, rel=5e-3, abs=5e-3)


@each("name", ["linkages/ex3", "levers/task12"])
def test_the_causes_of_an_error_are_listed_the_largest_first(name: str) -> None:
    solution = Solution(problem_of(name))
    errors = drafting_of(solution)
    for label in ("v_B", "v_C", "v_E", "omega_2", "omega_3"):
        if label not in errors.items or errors.spreads[label].drawn[0]:
            continue
        shares = [share for _, share in errors.causes(label)]
        if not shares:
            continue  # no construction leads to it
        assert shares == sorted(shares, reverse=True)
        assert sum(shares) == pytest.approx(1.0)
    text = result_tables(solution, "en", sigma=True)
    told = re.findall(r"^ +(\d+) %  ", text, re.M)
    assert 1 <= len(told) <= 3
    parts = [int(part) for part in told]
    assert parts == sorted(parts, reverse=True)
    assert sum(parts) <= 101
