"""Derivation of ratios and speeds: every side of a formula has the value at its end."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from fractions import Fraction
from math import pi
from pathlib import Path

import pytest
from cases import each, some
from click.testing import CliRunner
from doors import (
    LANGUAGES_LANGUAGES as LANGUAGES,
    DerivationLine,
    PlanMethodError,
    ProblemError,
    RequestedQuantity,
    TrainMotion,
    by_speeds,
    by_velocities,
    cli,
    derivation_derivation as derivation,
    gears_derivation as module,
    gears_reader_load as load,
    get_language,
    solve_motion,
    train_facts,
)
from msgspec.structs import replace
from trains import MAKERS, Made, solved
from worked import PROBLEMS

FILES = sorted([*(PROBLEMS / "gears").glob("*.toml"), *(PROBLEMS / "gears/tasks").glob("*.toml")])
WORDS = get_language("ru")
SIDE = re.compile(r"(U)(?:\^\{\((\w+)\)\})?_\{([^}]*)\}|([znωr])_\{([^}]*)\}")


def told(motion: TrainMotion) -> list[str]:
    return [line.text for line in derivation(motion, WORDS)]


def value_of(side: str, motion: TrainMotion) -> float:
    """Return the value of a side of a formula, by the speeds and teeth of the train."""
    known, left, side = (
        motion.train.body_of,
        side,
        re.sub(r"\s*(?:мин⁻¹|с⁻¹|мин\^\{−1\}|с\^\{−1\})", "", side),
    )

    def put(found: re.Match[str]) -> str:
        kind, carrier, labels, letter, label = found.groups()
        if letter in ("z", "r"):
            return f"({motion.axes.sizes[label]})"
        if letter:
            return f"({motion.speeds[known[label]]})"
        parts = labels.split("-")
        cuts = [parts] if len(parts) == 2 else [
            [labels[:k], labels[k:]] for k in range(1, len(labels))
            if labels[:k] in known and labels[k:] in known
        ]  # fmt: skip
        assert kind == "U"
        one, other = (motion.speed(x, carrier) for x in cuts[0])
        return f"({one / other})"

    text = SIDE.sub(put, side)
    while "\\frac" in text:
        text = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"((\1)/(\2))", text)
    text = text.translate(str.maketrans("·−,", "*-.", "\u00a0"))
    text = re.sub(r"(\d)\s(?=\d{3})", r"\1", text)
    assert re.fullmatch(r"[-+*/().\d\s]+", text), (left, text)
    return float(eval(text))


def check(motion: TrainMotion) -> int:
    count = 0
    for line in derivation(motion, WORDS):
        text = line.text if line.is_formula else line.text.partition(": ")[2]
        sides = re.split(r" = ", re.sub(r".*?(?=[Unω][_^])", "", text, count=1))
        if len(sides) < 2 or "не влия" in line.text or "вращаются" in line.text:
            continue
        values = [value_of(side.rstrip("."), motion) for side in sides]
        assert values == pytest.approx([values[0]] * len(values), rel=6e-4), line.text
        count += 1
    return count


@each("path", FILES)
def test_every_side_is_worth_its_result(path: Path) -> None:
    motion = solve_motion(load(path))
    ratios = [name for name in motion.train.ask if name.startswith(("U", "n_", "omega_"))]
    assert check(motion) >= len(ratios) - len(motion.train.inputs)
    for lang in LANGUAGES:
        assert len(derivation(motion, get_language(lang))) == len(told(motion))


@pytest.mark.parametrize("maker", MAKERS, ids=lambda maker: maker.__name__)
def test_random_trains_are_derived_to_the_speeds_of_their_makers(
    maker: Callable[[random.Random], Made], tmp_path: Path
) -> None:
    """Ratios of all pairs: those of one input never fall back on the speeds.

    But for a planet of a closed differential, whose own speed no chain gives.
    """
    rng = random.Random(34)
    for _ in range(some(60, few=8)):
        made = maker(rng)
        motion = solved(tmp_path, made.text)
        moving = [b for b in motion.train.bodies if motion.speeds[b]]
        moving = [b for b in moving if b not in motion.roles.transverse]
        names = [f"U_{a}_{b}" for a in moving for b in moving if a != b]
        speeds = [f"{motion.train.unit}_{b}" for b in moving]
        asked = replace(motion, train=replace(motion.train, ask=(*names, *speeds)))
        assert check(asked) >= len(names) // 2
        lines = told(asked)
        if motion.structure.mobility == 1:
            planets = {one for own in motion.roles.planets.values() for one in own}
            known = [b for b in moving if b not in planets]
            by_itself = [by_speeds(asked, RequestedQuantity("U", (a, b)), WORDS)
                         for a in known for b in known if a != b]  # fmt: skip
            assert not set(by_itself) & set(lines)
        for body in moving:
            if body not in motion.train.inputs and body in made.speeds:
                line = next(x for x in lines if x.startswith(f"n_{{{body}}} = "))
                (last,) = [value_of(line.split(" = ")[-1], asked)]
                assert last == pytest.approx(float(made.speeds[body]), rel=6e-4)


@pytest.mark.parametrize(
    ("stem", "lines"),
    [
        ("gears-ex1", [
            "U_{15} = U_{12}·U_{2'-3}·U_{3'-4}·U_{45} = ",
            "= −\\frac{z_{2}·z_{3}·z_{5}}{z_{1}·z_{2'}·z_{3'}} = ",
            " = −\\frac{48·44·100}{16·20·20} = −33",
        ]),
        ("gears-ex2", [
            "U_{15} = U_{12}·U_{H5}",
            "\\frac{1}{1 − U^{(H)}_{53}} = \\frac{1}{1 + \\frac{z_{3}}{z_{5}}}",
            "U^{(H)}_{43} = \\frac{n_{4} − n_{H}}{n_{3} − n_{H}}",
        ]),
        ("gears-ex4", ["n_{4} = n_{H} + \\frac{n_{1} − n_{H}}{U^{(H)}_{14}} = "]),
        ("gears-ex5", ["U_{1H} = \\frac{U^{(H)}_{1'-3'} − 1}{U^{(H)}_{1'-3'}·U_{31} − 1}"]),
        ("gears-ex6", ["U_{1H} = U^{(H)}_{13}·(U_{3'-5} − 1) + 1", "= \\frac{79}{4} = 19,75"]),
        ("planetary-k10", ["ω_{4} = \\frac{ω_{1} − U^{(4)}_{13}·ω_{3}}{1 − U^{(4)}_{13}}"]),
    ],
)  # fmt: skip
def test_the_worked_examples_go_as_the_chapter_does(stem: str, lines: list[str]) -> None:
    whole = "\n".join(told(solve_motion(load(PROBLEMS / f"gears/{stem}.toml"))))
    for line in lines:
        assert line in whole


def test_k10_by_instantaneous_velocities() -> None:
    """The source's way 1: 70, 30, 20 and 24 cm/s; 25, 4 and 6 1/s."""
    motion = solve_motion(load(PROBLEMS / "gears/planetary-k10.toml"))
    lines = [line.text for line in by_velocities(motion, WORDS)]
    for wanted in (
        "v_{A} = ω_{1}·r_{1} = 10·7 = 70 см/с, влево",
        "v_{B} = ω_{3}·r_{3} = 10·3 = 30 см/с, вправо",
        "ω_{2} = \\frac{v_{A} + v_{B}}{AB} = \\frac{70 + 30}{4} = 25 с",
        "v_{O_{2}} = v_{A} − ω_{2}·AO_{2} = 70 − 25·2 = 20 см/с, влево",
        "O_{2} – середина AB, то же даёт v_{O_{2}} = \\frac{v_{A} − v_{B}}{2} = "
        "\\frac{70 − 30}{2} = 20 см/с, влево",
        "ω_{4} = \\frac{v_{O_{2}}}{r_{4}} = \\frac{20}{5} = 4 с",
        "v_{C} = ω_{4}·r_{5} = 4·6 = 24 см/с, влево",
        "ω_{6} = \\frac{v_{C}}{r_{6}} = \\frac{24}{4} = 6 с",
    ):
        assert any(line.startswith(wanted) for line in lines), wanted
    teeth = solve_motion(load(PROBLEMS / "gears/gears-ex4.toml"))
    assert by_velocities(teeth, WORDS) == []


TOOTHED = """
[gears]
module = 2
wheels = { 1 = 20, 2 = 40, "2'" = 15, 3 = 60, 4 = 20, 5 = 40, 6 = 100 }
meshes = [
  { of = [1, 2] }, { of = ["2'", 3] }, { of = [4, 5], carrier = "H" },
  { of = [5, 6], kind = "internal", carrier = "H" },
]
bodies = [["2", "2'"], ["3", "4"]]
fixed = [6]
"""


@each("given", ["omega = { 1 = 100 }", "n = { 1 = 955 }"])
def test_wheels_by_teeth_go_by_velocities_to_instant_centres(given: str, tmp_path: Path) -> None:
    """By hand: v_C = 2.5·ω_1 mm/s on the pitch circle of 4; the planet rolls about D on ring 6."""
    path = tmp_path / "toothed.toml"
    path.write_text(f"{TOOTHED}{given}\n", "utf-8")
    motion = solve_motion(load(path))
    lines = [line.text for line in by_velocities(motion, get_language("en"))]
    omega = 100.0 if given.startswith("omega") else 955 * pi / 30
    carrier = omega * (20 / 40) * (15 / 60) * 20 / (20 + 100)
    assert any(line.startswith("ω_{H} = ") and f" {carrier:.6g} " in line for line in lines)
    planet = next(line for line in lines if "P_{5}" in line)
    assert planet.endswith("CP_{5} = \\frac{v_{C}}{ω_{5}} = 0.08 m")  # to ring 6, which is at rest
    assert ("\\frac{π·n_{1}}{30}" in "".join(lines)) == given.startswith("n ")


@each("turn", [(5, 7), (-3, 20), (0, 12), (30, 4), (12, 12)])
def test_the_velocities_go_where_the_speeds_turn(turn: tuple[int, int], tmp_path: Path) -> None:
    """A wheel at rest, a carrier that turns back, points that pass each other."""
    text = (PROBLEMS / "gears/planetary-k10.toml").read_text("utf-8")
    body = text.partition("[gears]\n")[2].partition("[published")[0]
    one, three = turn
    motion = solved(tmp_path, body.replace("{ 1 = 10, 3 = -10 }", f"{{ 1 = {one}, 3 = {three} }}"))
    lines = [line.text for line in by_velocities(motion, WORDS)][1:]
    for line in lines:
        numbers = line.split(" = ")[2:]
        read = [value_of(re.sub(r" [мс]\S*.*| \(.*", "", side), motion) for side in numbers]
        assert read == pytest.approx([read[0]] * len(read), abs=6e-4), line
        if line.startswith("ω"):
            label = line.partition("{")[2].partition("}")[0]
            exact = float(motion.speeds[motion.train.body_of[label]])
            assert read[-1] == pytest.approx(abs(exact), abs=6e-4)
            senses = {1: "против часовой", 0: "с", -1: "по часовой"}
            assert senses[(exact > 0) - (exact < 0)] in line
    assert {f"ω_{{{x}}}" for x in "246"} <= {line.partition(" = ")[0] for line in lines}


def test_a_derivation_that_contradicts_the_meshes_is_a_fault(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    motion = solve_motion(load(PROBLEMS / "gears/gears-ex2.toml"))
    wrong = replace(motion, speeds={**motion.speeds, "5": Fraction(7)})
    with pytest.raises(PlanMethodError, match="derivation gives"):
        derivation(wrong, WORDS)
    assert module.find_path([], "1", "2") == []


@pytest.mark.parametrize("lang", LANGUAGES)
def test_solve_protocol_and_sheet_show_the_derivation(lang: str, tmp_path: Path) -> None:
    path = str(PROBLEMS / "gears/gears-ex6.toml")
    for words in (["solve", path], ["protocol", path]):
        done = CliRunner().invoke(cli, [*words, "--lang", lang])
        assert "U_1H = U^(H)₁₃·(U_3'-5 − 1) + 1" in " ".join(done.output.split())
    assert isinstance(
        derivation(solve_motion(load(Path(path))), get_language(lang))[0], DerivationLine
    )


def test_radii_in_centimetres_are_as_in_the_textbook(tmp_path: Path) -> None:
    """K10 with r_4 = 5 cm, which the wheels confirm: all numbers are those printed there."""
    text = (PROBLEMS / "gears/planetary-k10.toml").read_text("utf-8")
    path = tmp_path / "k10.toml"
    path.write_text(text, encoding="utf-8")
    motion, language = solve_motion(load(path)), get_language("ru")
    facts = [fact.text for fact in train_facts(motion, language)]
    assert [f for f in facts if f.startswith("r")] == [
        f"r_{{{k}}} = {r} см" for k, r in zip("123456", (7, 2, 3, 5, 6, 4), strict=True)
    ]
    told = "\n".join(line.text for line in by_velocities(motion, language))
    for formula in (
        "10·7 = 70 см/с, влево", "10·3 = 30 см/с, вправо", r"\frac{70 + 30}{4} = 25",
        "70 − 25·2 = 20 см/с, влево", r"\frac{20}{5} = 4", "4·6 = 24 см/с", r"\frac{24}{4} = 6",
    ):  # fmt: skip
        assert formula in told
    path.write_text(path.read_text("utf-8").replace("4 = { r = 5 }", "4 = { r = 6 }"), "utf-8")
    with pytest.raises(ProblemError, match=r"r_4 = 0\.06 m, and the axis of 2 is 0\.05 m"):
        solve_motion(load(path))
