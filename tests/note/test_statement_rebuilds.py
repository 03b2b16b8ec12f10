"""The mechanism can be rebuilt from the statement alone, and its text agrees with its data."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import each, sampled, some
from doors import (
    LINKAGES,
    DimensionKind,
    ForceReading,
    GivenFact,
    Language,
    ModelProblem as Problem,
    Names,
    Notation,
    PlanMethodError,
    SizeTable,
    Solution,
    TrainOutput,
    arithmetic,
    cycle_statement,
    drawn,
    friction_of,
    get_language,
    kind_of,
    load_each,
    statement,
    statement_given_facts as given_facts,
    statics_of,
    wording,
)

from benchmarks.generator import random_problem
from benchmarks.rebuilt import printed, rebuilt
from planmethod import loads

ROOT = Path(__file__).parents[2]
TEMPLATE = ROOT / "planmethod/problem/templates/project.toml"
NOT_REBUILT = ("five-bar", "geared-five-bar", "rolling-wheel")
"""Two drivers by outputs and wheels on links: `benchmarks.rebuilt` does not write their tables."""
FILES = [
    path
    for path in sorted((ROOT / "problems").rglob("*.toml"))
    if kind_of(path) is LINKAGES and path.stem not in NOT_REBUILT
]
STATED = [
    path
    for path in sorted((ROOT / "tests" / "problem" / "statement").glob("*.toml"))
    if not path.stem.endswith("-fault")
]
PROJECTS = [ROOT / "tests/data/projects/rubbing.toml"]
RU, EN = get_language("ru"), get_language("en")
SAME = 1e-9


def assert_same(problem: Problem, again: Problem, positions: Sequence[float]) -> None:
    one = Solution(problem).with_positions([*positions])
    two = Solution(again).with_positions([*positions])
    size = max(float(np.nanmax(np.abs(point.place))) for point in one.points.values())
    assert {*one.points} == {*two.points}
    for name, point in one.points.items():
        assert np.allclose(point.place, two.points[name].place, rtol=0, atol=SAME * size), name
    assert again.drive.rate == pytest.approx(problem.drive.rate, rel=SAME)
    assert again.drive.acceleration == pytest.approx(problem.drive.acceleration, rel=SAME)


def assert_printed(problem: Problem, facts: Sequence[GivenFact], say: Notation) -> None:
    """Assert that every number of the data is in its text, to the last digit, with its sense.

    A word may give the sign, as for a distance to one side or the other.
    """
    stated = problem.stated
    for fact in facts:
        told = [*printed(fact.text)]
        for key, value in fact.data.items():
            if key == "judged":
                continue
            if any(
                arithmetic(stated[k], say) in fact.text for k in (key, f"{key}[0]") if k in stated
            ):
                continue
            values = value if isinstance(value, list) else [value]
            numbers = [v for v in values if isinstance(v, float)]
            if len(numbers) > 6 and len({*np.diff(numbers).round(9)}) == 1:
                numbers = [numbers[0], numbers[1] - numbers[0]]
            for number in numbers:
                if is_said_in_words(key, number):
                    continue
                if key.startswith("gears.") and key.endswith(".m"):
                    number /= 1000.0  # a module is in mm, lengths of a text are in metres
                assert any(
                    abs(abs(number) % 360.0 - abs(shown) % 360.0) <= 0.51 * last + 1e-12
                    or abs(abs(number) - abs(shown)) <= 0.51 * last
                    for shown, last in told
                ), f"{key} = {number}: {fact.text}"


def is_said_in_words(key: str, number: float) -> bool:
    """Return whether words give a number: level, upright, square to, const, the origin."""
    if key.endswith(".angle"):
        return number % 90.0 == 0
    return key in ("driver.epsilon", "machine.delta") or number == 0.0


def facts_of(problem: Problem, words: Language, positions: Sequence[float]) -> list[GivenFact]:
    return [drawn(problem, words), *given_facts(problem, words, positions)]


@each("number, path", enumerate(FILES + STATED))
def test_every_problem_is_rebuilt_from_its_stated_data(number: int, path: Path) -> None:
    """In ``make test`` every other problem is stated in Russian, the others in English."""
    languages = (RU, EN) if number % 2 else (EN, RU)
    for problem in load_each(path, [None]):
        for words in sampled(languages, 2):
            facts = facts_of(problem, words, problem.drive.positions)
            assert_same(problem, rebuilt(facts), problem.drive.positions)
            assert_printed(problem, facts, words.notation)


@each("path", [path for path in FILES if "[variants" in path.read_text("utf-8")])
def test_every_variant_is_rebuilt(path: Path) -> None:
    (problem,) = load_each(path, [None])
    for one in load_each(path, problem.variants[:: some(1, 7)] if problem.variants else []):
        facts = facts_of(one, RU, one.drive.positions)
        assert_same(one, rebuilt(facts), one.drive.positions)
        assert_printed(one, facts, RU.notation)


@each("train", ("n = { 1 = -960 }", "omega = { 1 = -100 }"))
def test_a_linkage_driven_by_a_train_is_rebuilt_with_its_teeth(train: str) -> None:
    text = TEMPLATE.read_text("utf-8").replace("n = { 1 = -960 }", train)
    problem = loads(text, name="driven")
    for words in (RU, EN):
        facts = facts_of(problem, words, problem.drive.positions)
        again = rebuilt(facts)
        assert_same(problem, again, problem.drive.positions)
        (one, two) = (x.drive.gear_drive for x in (problem, again))
        assert isinstance(one, TrainOutput) and isinstance(two, TrainOutput)
        assert (two.ratio, two.inputs) == (one.ratio, one.inputs)
        assert (two.train.wheels, two.train.meshes) == (one.train.wheels, one.train.meshes)
        # ω of wheel 1 is not that of the crank.
        letters = [fact.text.partition(" = ")[0] for fact in facts if " = " in fact.text]
        assert len({*letters}) == len(letters)


@each("seed", sampled(range(some(300, 25)), 2))
def test_random_mechanisms_are_rebuilt(seed: int) -> None:
    for triad in (False, True):
        try:
            problem = loads(random_problem(seed, triad=triad)[0], name=f"random {seed}")
        except PlanMethodError:
            continue
        facts = facts_of(problem, EN, problem.drive.positions)
        assert_same(problem, rebuilt(facts), problem.drive.positions)
        assert_printed(problem, facts, EN.notation)


@each("seed", (104003, 104004, 104007, 104009, 104011, 104042))
def test_a_name_of_the_statement_and_the_calculation_has_one_value(seed: int) -> None:
    """A point at distances from two guides has two names of them, by its sliders."""
    problem = loads(random_problem(seed, triad=seed == 104007)[0], name=f"random {seed}")
    facts = facts_of(problem, RU, problem.drive.positions)
    given = [part.split(" = ") for fact in facts for part in fact.text.split("; ") if " = " in part]
    assert len({name for name, *_ in given}) == len(given)
    values: dict[str, set[float]] = {}
    for fact in facts:
        if fact.text.startswith("e_"):
            (value,) = fact.data.values()
            assert isinstance(value, float)
            values.setdefault(fact.text.split(" = ")[0], set()).add(round(abs(value), 9))
    solution = Solution(problem)
    names, draft = Names(solution, wording("ru")), solution.construction.draft
    for number, dimension in draft.dimensions.items():
        if dimension.kind is DimensionKind.OFFSET and number in draft.numbers:
            value = round(abs(draft.numbers[number]), 9)
            values.setdefault(names.symbol(number), set()).add(value)
    assert all(len(of) == 1 for of in values.values()), values


@each("path", FILES[::5])
def test_other_positions_keep_the_way_it_is_assembled(path: Path) -> None:
    (problem,) = load_each(path, [None])
    if not problem.drive.is_crank:
        return
    solution = Solution(problem).with_positions(
        [problem.drive.positions[0] + 3.0 * k for k in range(1, 9)]
    )
    again = rebuilt(facts_of(problem, RU, solution.positions.tolist()))
    assert_same(problem, again, solution.positions.tolist())


def test_a_position_of_the_assembly_that_is_not_drawn_is_said_to_be_none_of_the_drawing() -> None:
    (problem,) = load_each(ROOT / "problems/linkages/ex3.toml", [None])
    (phi,) = problem.drive.positions

    def told(positions: Sequence[float]) -> list[str]:
        texts = [fact.text for fact in given_facts(problem, RU, positions)]
        return [text for text in texts if text.startswith("сборка")]

    assert told([phi]) == []
    for near in (phi, phi + 0.004, phi + 360.0):  # also as rounded, and in the next turn
        (one,) = told([near, phi + 30.0])
        assert "на чертеже" not in one
    (one,) = told([phi + 30.0, phi + 60.0])
    assert one.endswith("(на чертеже нет)")


def assert_rubbed(one: Solution, two: Solution) -> None:
    """Friction and bearings of both are the same."""
    mine, again = one.problem.dynamics, two.problem.dynamics
    assert mine is not None and again is not None
    assert again.bearings == mine.bearings
    pairs = [
        [(pair.name, pair.f, pair.radius) for pair in friction_of(solution).pairs]
        if dynamics.friction is not None
        else []
        for solution, dynamics in ((one, mine), (two, again))
    ]
    assert pairs[0] == pairs[1]


@each("path", sampled([p for p in FILES if "[dynamics" in p.read_text("utf-8")] + PROJECTS, 2))
def test_forces_follow_from_the_statement_of_a_position(path: Path) -> None:
    (problem,) = load_each(path, [None])
    solution = Solution(problem)
    reading = ForceReading(solution, 0)
    facts = [drawn(problem, RU), *statement(reading, RU)]
    other = ForceReading(Solution(rebuilt(facts)), 0)
    one, two = reading.statics, other.statics
    size = float(np.abs(one.largest_forces[0]))
    assert_rubbed(solution, other.solution)
    assert two.balance[0] == pytest.approx(one.balance[0], rel=SAME, abs=SAME * size)
    for mine, again in zip(one.reactions, two.reactions, strict=True):
        assert again.force[0] == pytest.approx(mine.force[0], abs=SAME * size)


def has_table(problem: Problem) -> bool:
    loads = () if problem.dynamics is None else problem.dynamics.loads
    return any(isinstance(load.size, SizeTable) for load in loads)


TABLED = [
    *(path for path in FILES if "[[loads]]" in path.read_text("utf-8")),
    *(ROOT / "tests/data/projects" / f"{name}.toml" for name in ("shaper", "engine")),
]


def test_forces_of_a_cycle_follow_from_the_rows_of_its_loads() -> None:
    problems = [one for path in TABLED for one in load_each(path, [None]) if has_table(one)]
    assert len(problems) >= 7
    for problem in problems:
        solution = Solution(problem).with_positions(
            [*(problem.numbered or problem.drive.positions)]
        )
        facts = [drawn(problem, RU), *cycle_statement(solution, RU)]
        for fact in facts:
            for rows in nested(fact.data):
                assert_listed(rows, fact.text)
        if any("machine.cycle_deg" in fact.data for fact in facts):
            assert problem.machine is not None  # a machine has a δ, forces do not depend on it
            facts.append(GivenFact("", {"machine.delta": problem.machine.delta}))
        again = Solution(rebuilt(facts)).with_positions(solution.positions.tolist())
        one, two = (statics_of(of).balance for of in (solution, again))
        assert two == pytest.approx(one, abs=SAME * np.abs(one).max())


def nested(data: Mapping[str, Any]) -> list[list[Any]]:
    """Return the tables among the data of a fact: rows, those of strokes one after another."""
    tables = [value for value in data.values() if isinstance(value, list)]
    return [table for table in tables if table and isinstance(table[0], list)]


def assert_listed(rows: Sequence[Any], text: str) -> None:
    """Assert that the text has every row in order: its place, its size; pressures in MPa."""
    flat = [x for one in rows for x in (one if isinstance(one[0], list) else [one])]
    pairs = re.findall(r"\((−?[\d,]+);\s(−?[\d,]+)\)", text)
    said = [[float(x.replace(",", ".").replace("−", "-")) for x in pair] for pair in pairs]
    scale = 1e-6 if "p, МПа" in text else 1.0
    assert len(said) == len(flat)
    assert np.allclose(said, np.array(flat) * [1.0, scale], rtol=1e-4, atol=0.0)
