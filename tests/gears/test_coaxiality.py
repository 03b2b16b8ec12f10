"""Unknown teeth derived from coaxiality, stages of a train, mobility of trains in space."""

from __future__ import annotations

import random
import re
from fractions import Fraction
from pathlib import Path

import pytest
from cases import each, some
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    conditions,
    derived_teeth,
    gears_reader_load as load,
    get_language,
    sentence,
    solve_motion,
    stages_of,
    train_facts,
)
from trains import row_of, solved, told
from worked import PROBLEMS

FILES = sorted((PROBLEMS / "gears").rglob("*.toml"))
UNKNOWN = [file for file in FILES if load(file).train.unknown]


def lines(text: Path | str, lang: str = "ru", folder: Path | None = None) -> list[str]:
    if isinstance(text, Path):
        motion = solve_motion(load(text))
    else:
        assert folder is not None
        motion = solved(folder, text)
    return [line.text for line in derived_teeth(motion, get_language(lang))]


def results(derived: list[str]) -> dict[str, Fraction]:
    """Return the sizes by their last lines, and compute each from the numbers of its sum."""
    found = {}
    for line in derived:
        match = re.fullmatch(r"[zr]_{([\w']+)} = (.*)", line)
        if match is None:
            continue
        *_, numbers, value = re.sub(r" м$", "", match[2]).split(" = ")
        plain = re.sub(r"\\frac{(.*)}{(.*)}", r"(\1)/(\2)", numbers)
        plain = plain.replace("−", "-").replace("·", "*").replace(",", ".")
        plain = re.sub(r"\d+(?:\.\d+)?", lambda one: f"F('{one[0]}')", plain)
        assert eval(plain, {"F": Fraction}) == Fraction(value.replace(",", "."))
        found[match[1]] = Fraction(value.replace(",", "."))
    return found


def test_example_1_is_derived_as_in_the_textbook() -> None:
    assert lines(PROBLEMS / "gears" / "gears-ex1.toml") == [
        "Условие соосности (колёса 1, 3): r_{w1} + r_{w2} = r_{w3} + r_{w2'}",
        r"\frac{m·z_{1}}{2} + \frac{m·z_{2}}{2} = \frac{m·z_{3}}{2} + \frac{m·z_{2'}}{2}",
        "Модули одинаковы, m/2 сокращается: z_{1} + z_{2} = z_{3} + z_{2'}",
        "z_{2'} = z_{1} + z_{2} − z_{3} = 16 + 48 − 44 = 20",
        "Условие соосности (колёса 3', 5): r_{w3'} + 2·r_{w4} = r_{w5}",
        "z_{3'} + 2·z_{4} = z_{5}",
        "z_{5} = z_{3'} + 2·z_{4} = 20 + 2·40 = 100",
    ]


@each("file", UNKNOWN)
def test_every_unknown_size_of_the_shipped_trains_is_derived(file: Path) -> None:
    motion = solve_motion(load(file))
    for lang in LANGUAGES:
        found = results(lines(file, lang))
        assert found == {label: motion.axes.sizes[label] for label in motion.train.unknown}
        facts = [fact.text for fact in train_facts(motion, get_language(lang))]
        for label in motion.train.unknown:  # the answer is not among the given data
            assert not any(fact.startswith(f"z_{{{label}}} =") for fact in facts)


def test_any_size_of_random_sets_is_derived(tmp_path: Path) -> None:
    for seed in range(some(60, 12)):
        rng = random.Random(seed)
        wheels, meshes, _ = row_of(rng)
        label = rng.choice([*wheels])
        rest = f'coaxial = [["1", "3"]]\nunknown = ["{label}"]\nn = {{ 1 = 1, H = 2 }}'
        given = {x: z for x, z in wheels.items() if x != label}
        motion = solved(tmp_path, told(given, meshes, rest))
        derived = [line.text for line in derived_teeth(motion, get_language("en"))]
        assert results(derived) == {label: wheels[label]}


def test_different_modules_do_not_cancel(tmp_path: Path) -> None:
    """30 and 30 teeth of 2 mm reach as far as 12 and 28 of 3 mm."""
    wheels, meshes = {"1": 30, "2": 30, "2'": 12}, ["{ of = [1, 2] }", '{ of = ["2\'", 3] }']
    rest = 'coaxial = [["1", "3"]]\nunknown = ["3"]\nn = { 1 = 1 }\n'
    rest += 'module = { "1-2" = 2, "2\'-3" = 3 }'
    motion = solved(tmp_path, told(wheels, meshes, rest))
    *_, rows, last = (line.text for line in derived_teeth(motion, get_language("en")))
    assert "do not cancel: m_{1}·z_{1} + m_{2}·z_{2} = m_{3}·z_{3} + m_{2'}·z_{2'}" in rows
    assert last.endswith(r" = \frac{2·30 + 2·30 − 3·12}{3} = 28")


def test_radii_have_no_module(tmp_path: Path) -> None:
    text = "wheels = { 1 = { r = 0.02 }, 3 = { r = 0.08 } }\n"
    text += 'meshes = [{ of = [1, 2] }, { of = [2, 3], kind = "internal" }]\n'
    motion = solved(tmp_path, f'{text}unknown = ["2"]\ncoaxial = [["1", "3"]]\nn = {{ 1 = 1 }}')
    derived = [line.text for line in derived_teeth(motion, get_language("ru"))]
    assert derived[-1] == r"r_{2} = \frac{r_{3} − r_{1}}{2} = \frac{0,08 − 0,02}{2} = 0,03 м"
    assert not any("m" in line for line in derived)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("gears-ex1", "ступеней 5 − 1 = 4; механизм четырёхступенчатый: первая ступень – "
                      "от колеса 1 к колесу 2; вторая ступень – от колеса 2' к колесу 3;"),
        ("gears-ex2", "ступеней 3 − 1 = 2; механизм двухступенчатый: первая ступень (не "
                      "планетарная) – от колеса 1 к колесу 2; вторая ступень (планетарная) – "
                      "от водила H к колесу 5"),
        ("gears-ex3", "третья ступень (планетарная) – от водила H к колесу 6; четвёртая ступень "
                      "(не планетарная) – от колеса 6' к колесу 7"),
    ],
)  # fmt: skip
def test_stages_are_those_of_the_textbook(name: str, said: str) -> None:
    (text,) = stages_of(solve_motion(load(PROBLEMS / "gears" / f"{name}.toml")), get_language("ru"))
    assert said in text


@pytest.mark.parametrize("name", ["gears-ex4", "gears-ex5", "gears-ex6", "planetary-k10"])
def test_differentials_have_no_stages(name: str) -> None:
    motion = solve_motion(load(PROBLEMS / "gears" / f"{name}.toml"))
    assert not stages_of(motion, get_language("ru"))


SET = """wheels = {{ 1 = {}, 2 = {}, "2'" = {}, 3 = {} }}
meshes = [{{ of = [1, 2], carrier = "H" }}, {{ of = ["2'", 3], kind = "internal", carrier = "H" }}]
fixed = ["3"]\nn = {{ 1 = 1 }}\nsatellites = 3\n"""


def test_assembly_and_neighbourhood_show_where_their_numbers_come_from(tmp_path: Path) -> None:
    motion = solved(tmp_path, SET.format(24, 36, 20, 80))
    one, two = (
        sentence(c, get_language("en"))
        for c in conditions(motion)
        if c.name in ("assembly", "neighbourhood")
    )
    formula = "(z_1·z_2' + z_2·z_3)/(gcd(z_2, z_2')·k) = (24·20 + 36·80)/(4·3) = 840/3 = 280"
    assert formula in one
    assert two.endswith("(z_2 + 2)/(z_1 + z_2) = (36 + 2)/(24 + 36) = 0.6333")


@pytest.mark.parametrize("kind", ["bevel", "worm"])
def test_mobility_of_crossing_axes_is_that_of_somov_and_malyshev(kind: str, tmp_path: Path) -> None:
    text = f'wheels = {{ 1 = 2, 2 = 40 }}\nmeshes = [{{ of = [1, 2], kind = "{kind}" }}]\n'
    structure = solved(tmp_path, f"{text}n = {{ 1 = 1 }}").structure
    assert structure.is_spatial
    assert structure.mobility == 6 * 2 - 5 * 2 - 1  # teeth touch at a point
