"""Formulas beside the plans: their results are right, and the protocol has the same ones."""

from __future__ import annotations

import re

import pytest
from cases import each, sampled, some
from doors import (
    Compute,
    ForceReading,
    Formulas,
    Names,
    PlanKind,
    QuantityKind,
    Solution,
    calculation,
    get_language,
    inlined,
    plain_text,
    reported_quantities,
)
from lettered import computed, force_lines
from loaded import loaded_problem
from protocols import LANGUAGES, drawn, worked
from texts import protocol
from worked import PROBLEMS, SIX, every_file

from benchmarks.generator import random_problem
from planmethod import loads

NAMES = [path.relative_to(PROBLEMS).with_suffix("") for path in every_file()]
SEEDS = range(some(60, few=8))
PLANS = (PlanKind.VELOCITY, PlanKind.ACCELERATION)


def lines_of(solution: Solution, lang: str) -> list[str]:
    """Return the formulas of both plans, those of one line each for itself."""
    lines = [line for kind in PLANS for line in calculation(solution, kind, 0, get_language(lang))]
    return [part for line in lines for part in line.split(";  ")]


def assert_computes(lines: list[str], lang: str, *, exactly: bool = False) -> int:
    """Check to four digits of the numbers put in, of a difference too; return the count.

    ``exactly``: the printed numbers come to the printed digits of the result.
    """
    count, decimal = 0, get_language(lang).notation.decimal
    for line in map(inlined, lines):
        *_, numbers, result = ["", *line.split(" = ")]
        letters = re.search(r"[^\W\d]", re.sub(r"\^\{.*?\}", "", numbers))
        if "∼" in line or " " not in result or not numbers or letters:
            continue  # of one number, or equal to another quantity
        found, told = computed(result.partition(" ")[0], decimal), computed(numbers, decimal)
        size = computed(re.sub(r"(?<!\{)−", "+", numbers), decimal)
        decimals = len(re.sub(r"[^\d,.].*", "", result).partition(decimal)[2])
        near = 0.502 * 10.0**-decimals if exactly and "·10^" not in result else 1.2e-3 * size
        near = 0.5 * 10 ** (len(str(int(found))) - 4) if exactly and found >= 1e4 else near
        told = told if found < 0 else abs(told)  # the rate of a wheel has its sign
        assert told == pytest.approx(found, abs=near + 1e-12), line
        count += 1
    return count


@each("lang", LANGUAGES)
@each("name", NAMES)
def test_every_formula_gives_its_printed_result(name: str, lang: str) -> None:
    assert assert_computes(lines_of(worked(str(name)), lang), lang, exactly=True) >= 8


@each("lang", LANGUAGES)
@each("seed", sampled(SEEDS, 3))
def test_every_formula_of_a_random_mechanism_gives_its_printed_result(seed: int, lang: str) -> None:
    assert assert_computes(lines_of(drawn(seed), lang), lang, exactly=True) >= 3


def test_a_number_has_the_same_digits_in_every_formula() -> None:
    again = 0
    for seed in (0, 3, 6):
        told: dict[str, str] = {}
        for line in map(inlined, lines_of(drawn(seed), "ru")):
            *sides, result = line.split(" = ")
            letters, numbers = [re.split(r"[·/]", side) for side in ["", "", *sides][-2:]]
            for letter, number in zip(letters, numbers, strict=False):
                bare, used = letter.strip("()"), number.strip("()")
                if re.match(r"[vaωε][_^]", bare) and len(sides) > 2 and bare in told:
                    again += 1
                    assert used == told[bare], line
            found = re.match(r"[\d,]+(?= )", result)
            told |= {side.strip("()"): found[0] for side in sides[:-2] or sides if found}
    assert again >= 4


@each("seed", sampled(SEEDS, 3))
def test_printed_numbers_are_those_of_the_construction(seed: int) -> None:
    solution = drawn(seed)
    formulas = Formulas(solution, Names(solution, get_language("ru").note, on_sheet=True), 0)
    for name, step in formulas.names.step.items():
        if isinstance(step, Compute) and formulas.readable(step.out):
            value = abs(formulas.number(step.out))
            assert formulas.magnitude(step.out) == pytest.approx(value, rel=0.03, abs=0.06), name


@each("lang", LANGUAGES)
@each("name", NAMES)
def test_and_every_formula_of_forces(name: str, lang: str) -> None:
    if worked(str(name)).problem.dynamics is None:
        pytest.skip("no forces")
    assert assert_computes(force_lines(ForceReading(worked(str(name)), 0), lang), lang) >= 10


@each("seed", sampled(SEEDS, 3))
def test_of_any_loaded_mechanism_too(seed: int) -> None:
    solution = Solution(loaded_problem(seed)[0])
    assert assert_computes(force_lines(ForceReading(solution, 0), "ru"), "ru") >= 5


@each("lang", LANGUAGES)
@each("name", SIX)
def test_the_protocol_has_the_formulas_of_the_sheet(name: str, lang: str) -> None:
    """Only the letters of points differ: the protocol writes them on one line."""

    def bare(text: str) -> str:
        return re.sub(r"[–\s]", "", plain_text(text)).translate(_LOWERED)

    solution = worked(name)
    text = bare(protocol(solution, lang=lang))
    for line in map(inlined, lines_of(solution, lang)):
        *symbols, _ = line.split(" = ")
        letters = [side for side in symbols if re.search(r"[^\W\d]", side)]
        if len(letters) > 1 and "_" in letters[-1]:
            assert bare(f"= {letters[-1]} =") in text, line


_LOWERED = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")


@each("seed", sampled(SEEDS, 3))
def test_every_value_of_the_plans_is_in_a_formula(seed: int) -> None:
    """Vectors laid off, vectors read, and angular velocities and accelerations of links."""
    solution = drawn(seed)
    names, lines = Names(solution, get_language("ru").note, on_sheet=True), lines_of(solution, "ru")
    symbols = {part for line in lines for part in line.split(" = ")[:-1]}
    for motion in (names.kinematics.velocity, names.kinematics.acceleration):
        for ends, number in motion.segments.values.items():
            vector = names.vector(*ends)
            own = {names.symbol(number), *([vector.symbol] if vector else [])}
            assert own & symbols or not isinstance(names.step[number], Compute), number
    for quantity in reported_quantities(solution, QuantityKind.OMEGA, QuantityKind.EPSILON):
        assert quantity.symbol in symbols, quantity.symbol


@pytest.mark.parametrize(("seed", "alike"), [(97005, "3"), (97015, "345"), (97019, "3")])
def test_links_in_guides_on_the_crank_turn_with_it_in_the_calculation(
    seed: int, alike: str
) -> None:
    solution = Solution(loads(random_problem(seed)[0], name="random"))
    for letter, label, kind in zip("ωε", ("omega", "epsilon"), PLANS, strict=True):
        lines = [inlined(line) for line in calculation(solution, kind, 0, get_language("ru"))]
        links = [link for line in lines for link in re.findall(rf"{letter}_{{(\d)}} = ", line)
                 if f"= {letter}_{{1}} = " in line and link != "1"]  # fmt: skip
        assert links == [*alike]
        value = abs(float(solution.exact(solution.legend[f"{label}_1"])[0]))
        for line in lines:
            if f"= {letter}_{{1}} = " in line:
                told = line.rpartition(" = ")[2].partition(" ")[0].replace(",", ".")
                assert float(told) == pytest.approx(value, rel=1e-3)
                assert ("часовой стрелк" in line) == bool(value)
