"""The analytic method: its printed formulas, against plans, differences of places, and sympy."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import sampled
from doors import (
    STEPS,
    AnalyticAccount,
    Document,
    Solution,
    get_language,
    inlined,
)
from evaluated import texts_of

import planmethod
from benchmarks.generator import random_problem

LEVERS = Path("problems/levers")
STATIONS = np.array([-4, -3, -2, -1, 0, 1, 2, 3, 4])
FIRST = np.array([3, -32, 168, -672, 0, 672, -168, 32, -3]) / 840.0
SECOND = np.array([-9, 128, -1008, 8064, -14350, 8064, -1008, 128, -9]) / 5040.0
"""Weights of differences of the eighth order."""

ARITHMETIC: dict[str, Any] = {
    "cos": lambda angle: math.cos(math.radians(angle)),
    "sin": lambda angle: math.sin(math.radians(angle)),
    "atan2": lambda y, x: math.degrees(math.atan2(y, x)),
    "arccos": lambda value: math.degrees(math.acos(value)),
    "sqrt": math.sqrt,
}
FUNCTIONS = "cos|sin|atan2|arccos|sqrt"
SYMBOL = re.compile(r"[^\W\d_]+[′″]*_\{[^{}]*\}|Δ|\b[sva]\b")


def account_of(solution: Solution, lang: str = "en") -> tuple[AnalyticAccount, Document]:
    account = AnalyticAccount(solution, 0, get_language(lang), STEPS)
    return account, Document.of(account.chapter())


def python_of(side: str, letters: Callable[[str], str]) -> str:
    """Return a side of a formula as an expression of Python."""
    text = side.replace("√(", "sqrt(").replace("−", "-").replace("°", "").replace("; ", ", ")
    text = re.sub(r"(?<=\d),(?=\d)", ".", text)
    text = re.sub(r"·10\^\{(-?\d+)\}", r"e\1", text)
    text = re.sub(r"(cos|sin) (-?[^ ·/,)]+)", r"\1(\2)", text)
    text = SYMBOL.sub(lambda found: letters(found[0]), text)
    text = re.sub(r"\^\{(-?\d+)\}", r"**\1", text)
    return text.replace("·", "*")


def formulas_in(document: Document) -> list[tuple[str, list[str]]]:
    """Return the formulas that define letters: the letter, and the sides after it."""
    found = []
    for text in texts_of(document):
        first, *sides = inlined(text).rstrip(";.").split(" = ")
        if sides and re.fullmatch(SYMBOL, first) and re.match(r"−?\d", sides[-1]):
            found.append((first, sides))
    return found


def given_in(document: Document) -> dict[str, float]:
    (text,) = (text for text in texts_of(document) if text.startswith(("Given: ", "Дано: ")))
    facts = (fact.split(" = ") for fact in text.partition(": ")[2].rstrip(".").split("; "))
    return {letter: value_of(value) for letter, value in facts}


def value_of(side: str) -> float:
    """Return a number without its unit."""
    number = re.match(r"−?[\d.,]+(?:·10\^\{−?\d+\})?", side)
    assert number, side
    return float(eval(python_of(number[0], str)))


def differentiated(solution: Solution, step: float) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    """Return first and second derivatives of places and angles by the coordinate, by name."""
    crank = solution.problem.drive.is_crank
    way = STATIONS * step
    moved = solution.with_positions(solution.positions[0] + (np.degrees(way) if crank else way))
    rows: dict[str, Any] = {name: motion.place for name, motion in moved.points.items()}
    rows |= {
        f"φ_{{{link}}}": np.unwrap(np.radians(motion.phi_deg))
        for link, motion in moved.links.items()
    }
    first = {name: row @ FIRST / step for name, row in rows.items()}
    return first, {name: row @ SECOND / step**2 for name, row in rows.items()}


def close(one: complex, other: complex, size: float, within: float = 1e-9) -> None:
    assert abs(one - other) <= within * max(size, abs(other)), (one, other)


def compare(solution: Solution) -> None:
    """Assert that places, angles and derivatives are those of the mechanism."""
    account, _ = account_of(solution)
    points = {name: place for name, place in account.places.items() if name in solution.points}
    links = solution.problem.mechanism.links
    assert {p for link in links for p in solution.problem.bodies[link].points} <= set(points)
    first, second = differentiated(solution, 5e-4)
    sizes = [max(map(abs, table.values())) for table in (first, second)]
    sizes[1] = max(sizes)
    for name, place in points.items():
        at, v, a = (complex(x.value, y.value) for x, y in (place.at, *place.rates))
        close(at, complex(solution.points[name].place[0]), 1.0)
        close(v, first[name], sizes[0], 1e-7)
        close(a, second[name], sizes[1], 1e-5)
    for link, turn in account.turns.items():
        motion = solution.links[link]
        close(turn.angle.value, float(motion.phi_deg[0]), 180.0)
        close(turn.rates[0].value, first[f"φ_{{{link}}}"], sizes[0], 1e-7)
        close(turn.rates[1].value, second[f"φ_{{{link}}}"], sizes[1], 1e-5)
    # Differences lose digits near dead positions: the plans have the derivatives to more.
    _, rate, again = (float(np.ravel(one)[0]) for one in solution.driven)
    v_max = max(abs(motion.velocity[0]) for motion in solution.points.values())
    a_max = max(abs(motion.acceleration[0]) for motion in solution.points.values())
    a_max = max(a_max, v_max * abs(rate))
    for name, place in points.items():
        v, a = (complex(x.value, y.value) for x, y in place.rates)
        close(v * rate, complex(solution.points[name].velocity[0]), v_max)
        close(a * rate**2 + v * again, complex(solution.points[name].acceleration[0]), a_max)


@pytest.mark.parametrize("seed", sampled(range(60), 4))
def test_random_mechanisms_have_the_places_and_derivatives_of_their_motion(
    seed: int, tmp_path: Path
) -> None:
    text, _ = random_problem(seed)
    file = tmp_path / "random.toml"
    file.write_text(text, encoding="utf-8")
    compare(planmethod.solve(planmethod.load(file)))


@pytest.mark.parametrize("seed", sampled(range(100, 130), 5))
@pytest.mark.parametrize("lang", ["en", "ru"])
def test_printed_formulas_give_the_printed_values(seed: int, lang: str, tmp_path: Path) -> None:
    text, _ = random_problem(seed)
    file = tmp_path / "random.toml"
    file.write_text(text, encoding="utf-8")
    account, document = account_of(planmethod.solve(planmethod.load(file)), lang)
    given = given_in(document)
    assert given == pytest.approx({name: account.values[name] for name in given}, rel=2e-4)
    known = {name: account.values[name] for name in given}
    for letter, (in_letters, *in_numbers, printed) in formulas_in(document):
        value = evaluated(in_letters, known)
        digits = 2e-4 * abs(value) + (2e-6 if "°" in printed else 2e-9)
        assert value_of(printed) == pytest.approx(value, abs=digits), letter
        for side in in_numbers:
            angle = "atan2" in side or "arccos" in side
            within = 0.5 if angle else 1e-3 * size_of(side) + digits
            assert evaluated(side, {}) == pytest.approx(value, abs=within), (letter, side)
        known[letter] = value
    assert known == pytest.approx(account.values, rel=1e-9, abs=1e-10)


def evaluated(side: str, known: Mapping[str, Any], using: Mapping[str, Any] = ARITHMETIC) -> Any:
    """Return the value of a side of a formula, by the values of letters."""
    index = {name: f"_{k}" for k, name in enumerate(known)}
    names = {index[name]: value for name, value in known.items()}
    return eval(python_of(side, index.__getitem__), {**using, **names})


def size_of(side: str) -> float:
    """Return the sum of the sizes of the terms of a side in numbers."""
    text = re.sub("(?<!e)-", "+", python_of(side, str))
    # An angle has five digits, so a sine near zero has few.
    absolute = {**ARITHMETIC, "cos": lambda _: 1.0, "sin": lambda _: 1.0}
    return float(eval(text, absolute))


POSITIONS = re.compile(r"[xyslφδβdphk]_\{|a_\{\d\d\}|Δ")
"""Letters of positions; not of derivatives."""


@pytest.mark.dear
@pytest.mark.parametrize("task", ["task12", "task-1", "six-link"])
def test_printed_derivatives_are_those_of_sympy(task: str) -> None:
    """The printed places, as functions of the angle of the crank, are differentiated by sympy."""
    sympy = pytest.importorskip("sympy")
    turn = sympy.pi / 180
    using = {
        "cos": lambda angle: sympy.cos(angle * turn),
        "sin": lambda angle: sympy.sin(angle * turn),
        "atan2": lambda y, x: sympy.atan2(y, x) / turn,
        "arccos": lambda value: sympy.acos(value) / turn,
        "sqrt": sympy.sqrt,
    }
    account, document = account_of(planmethod.solve(planmethod.load(LEVERS / f"{task}.toml")))
    at, coordinate = sympy.Symbol("t"), account.coordinate
    known: dict[str, Any] = {name: account.values[name] for name in given_in(document)}
    start, known[coordinate] = known[coordinate], at
    for letter, (side, *_) in formulas_in(document):
        if POSITIONS.match(letter):
            known[letter] = evaluated(side, known, using)
    compared = 0
    for letter in known:
        kind, name = letter[0], letter[3:-1]
        if kind in "xy" and f"v_{{q{name}{kind}}}" in account.values:
            pair = f"v_{{q{name}{kind}}}", f"a_{{q{name}{kind}}}"
            scale = 1 / turn
        elif kind == "φ" and letter != coordinate:
            pair, scale = (f"u_{{{name}1}}", f"ε_{{q{name}}}"), sympy.Integer(1)
        else:
            continue
        once = sympy.diff(known[letter], at)
        for found, symbol in (
            (once * scale, pair[0]),
            (sympy.diff(once, at) * scale / turn, pair[1]),
        ):
            value = float(found.subs(at, start).evalf(30))
            assert value == pytest.approx(account.values[symbol], rel=1e-9, abs=1e-11), symbol
        compared += 1
    assert compared > 4


def test_the_task_of_the_textbook_has_the_printed_values() -> None:
    """Mathcad's sheet of levers-homework, section 3, task 12."""
    account, _ = account_of(planmethod.solve(planmethod.load(LEVERS / "task12.toml")))
    printed = {
        "φ_{3}": -2.78991, "x_{D}": 0.3997, "y_{D}": -0.11217, "x_{S3}": 0.05012,
        "v_{qDx}": 0.00239, "v_{qDy}": 0.04904, "u_{31}": 0.19638, "a_{qDx}": -0.01318,
        "a_{qS3y}": 0.02898, "ε_{q3}": -0.29206, "v_{D}": 0.58913, "a_{D}": 10.26494,
        "ε_{3}": -40.6825,
    }  # fmt: skip
    assert {name: account.values[name] for name in printed} == pytest.approx(printed, abs=6e-6)
