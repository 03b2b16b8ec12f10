"""Projections of forces: their values are the forces of the plans, their formulas give them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from cases import sampled
from doors import (
    STEPS,
    AnalyticAccount,
    Document,
    ForceProjections,
    Solution,
    get_language,
    inlined,
    problem_loads as loads,
    statics_of,
)
from evaluated import texts_of
from loaded import loaded_problem
from mechanisms import CRANK
from test_analytic import ARITHMETIC, python_of
from worked import PROBLEMS, problem_of

FILES = ["levers/six-link", "levers/task12", "press/press", "press/press-stone", "levers/crosshead"]
TASKS = sorted((PROBLEMS / "levers").glob("task-*.toml"))


def compare(solution: Solution) -> int:
    """Assert that every reaction and what balances the driver are those of the force analysis."""
    account = AnalyticAccount(solution, 0, get_language("en"), STEPS)
    list(account.nodes())
    if not all(link in account.directions for link in solution.problem.mechanism.links):
        return 0
    told = ForceProjections(account)
    list(told.nodes())
    statics, called = statics_of(solution), solution.problem.mechanism.called
    peak, found = statics.largest(0), 0
    for one in statics.reactions:
        on, by = called(one.on), called(one.by)
        comma = "," if len(on) > 1 or len(by) > 1 else ""
        for sign, name in ((1, f"F_{{{on}{comma}{by}}}"), (-1, f"F_{{{by}{comma}{on}}}")):
            if name in told.forces:
                x, y = told.forces[name]
                assert abs(complex(x.value, y.value) - sign * complex(one.force[0])) <= 1e-6 * peak
                found += 1
    balance = get_language("en").notation.symbol(solution.problem.balancer.symbol)
    if balance in told.couples:
        moment = float(statics.balance[0])
        assert told.couples[balance].value == pytest.approx(moment, rel=1e-6, abs=1e-6 * peak)
        found += 1
    return found


@pytest.mark.parametrize("name", FILES)
def test_worked_mechanisms_have_the_forces_of_their_plans(name: str) -> None:
    assert compare(Solution(problem_of(name))) >= 4


@pytest.mark.parametrize("path", sampled(TASKS, 8), ids=lambda path: Path(path).stem)
def test_tasks_have_the_forces_of_their_plans(path: Path) -> None:
    assert compare(Solution(loads(path.read_text("utf-8"), name=path.stem))) >= 3


@pytest.mark.parametrize("seed", sampled(range(40), 4))
def test_random_mechanisms_have_the_forces_of_their_plans(seed: int) -> None:
    compare(Solution(loaded_problem(seed)[0]))


@pytest.mark.parametrize("name", FILES[:3])
@pytest.mark.parametrize("lang", ["en", "ru"])
def test_every_sum_in_letters_is_zero(name: str, lang: str) -> None:
    """ΣX, ΣY and ΣM are evaluated as they are printed, with the values of their letters."""
    solution = Solution(problem_of(name))
    account = AnalyticAccount(solution, 0, get_language(lang), STEPS)
    list(account.nodes())
    told = ForceProjections(account)
    document = Document.of(told.nodes())
    values = {
        **account.values,
        **{k: one.value for k, one in {**told.sizes, **told.couples}.items()},
    }
    letters = sorted(values, key=len, reverse=True)
    every, count = "|".join(map(re.escape, letters)), 0
    for text in texts_of(document):
        found = re.fullmatch(r"Σ(?:X|Y|M_\{\w+\}) = (.*) = 0[;.]", inlined(text))
        if found is None:
            continue
        numbers = re.sub(every, lambda one: f"({values[one[0]]!r})", found[1])
        terms = python_of(numbers, str)
        size = max(abs(float(one)) for one in re.findall(r"\d+\.\d+", terms))
        assert abs(eval(terms, {"__builtins__": {}}, ARITHMETIC)) <= 1e-6 * max(size, 1.0)
        count += 1
    assert count >= 9


@pytest.mark.parametrize("lang", ["en", "ru"])
def test_the_opposite_of_a_zero_is_a_zero(lang: str) -> None:
    """The rod of this task is not loaded across itself: F_45x and its opposites are zero."""
    solution = Solution(problem_of("levers/task12"))
    account = AnalyticAccount(solution, 0, get_language(lang), STEPS)
    list(account.nodes())
    texts = list(texts_of(Document.of(ForceProjections(account).nodes())))
    assert [text for text in texts if text.startswith("F_{43x} = −F_{45x} = 0 ")]
    assert not [text for text in texts if "−0 " in text]


UPRIGHT = CRANK.replace("angle = 0", "angle = 90").replace("right of B", "above B")


@pytest.mark.parametrize("text", [CRANK.replace("from = 0", "from = 90"), UPRIGHT])
def test_a_zero_at_the_head_of_a_formula_has_no_sign(text: str) -> None:
    """The crank is across the slide: b_1 = 0 and u_21 = −b_1/Δ, or s_3 = −p_3 + … of p_3 = 0."""
    account = AnalyticAccount(Solution(loads(text, name="own")), 0, get_language("en"), STEPS)
    told = map(inlined, texts_of(Document.of(account.chapter())))
    assert not [one for one in told if re.search(r"= −0(?![.\d])", one)]
