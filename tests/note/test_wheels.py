"""Wheels and racks in the analytic method, protocols and given facts."""

from __future__ import annotations

import random

import pytest
from geared import KINDS, Model, masses

from planmethod.note.accounts.analytic import AnalyticAccount
from planmethod.note.accounts.voice import STEPS
from planmethod.note.document import Document
from planmethod.note.wording import get_language
from planmethod.problem import loads
from planmethod.solved.solution import Solution


def model_of(number: int) -> Model:
    rng = random.Random(100 + number)
    make, kind = KINDS[number]
    for _ in range(50):
        model = make(rng, kind)
        masses(rng, model)
        try:
            model.solve(4.0)
        except ArithmeticError:
            continue
        return model
    raise AssertionError("no mechanism was found")


@pytest.mark.parametrize("number", range(len(KINDS)))
@pytest.mark.parametrize("lang", ["en", "ru"])
def test_formulas_of_wheels_give_the_rates_of_the_plans(number: int, lang: str) -> None:
    solution = Solution(loads(model_of(number).toml([4.0]), name="wheels"))
    account = AnalyticAccount(solution, 0, get_language(lang), STEPS)
    Document.of(account.chapter())
    links = solution.problem.mechanism.links
    assert set(links) <= set(account.directions)
    for link in account.turns:
        motion = solution.links[link]
        for letter, values in (("ω", motion.omega), ("ε", motion.epsilon)):
            found = account.values.get(f"{letter}_{{{link}}}", 0.0)
            assert found == pytest.approx(values[0], rel=1e-8, abs=1e-8), (letter, link)
    for point, place in account.places.items():
        if point in solution.points:
            at = complex(*(one.value for one in place.at))
            assert at == pytest.approx(solution.points[point].place[0], abs=1e-9)
