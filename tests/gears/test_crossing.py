"""Ratios between axes that cross have sizes and no signs; those of parallel axes keep theirs."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

from cases import each
from click.testing import CliRunner
from trains import mesh, solved, told

from planmethod.cli import cli
from planmethod.gears.answers import answer
from planmethod.gears.derivation import derivation
from planmethod.note.wording import LANGUAGES, language

SENTENCE = {"en": "is not defined: axes cross", "ru": "не определяется: на пути"}
SENSES = {"en": ("turn in the same sense", "turn in opposite senses"),
          "ru": ("вращаются в одну сторону", "вращаются в разные стороны")}  # fmt: skip

BEVEL = [mesh("1", "2", "bevel")]
LEFT = '{ of = ["1", "2"], kind = "worm", hand = "left" }'
PAIR = {"1": 20, "2": 50}
SET = {"1": 20, "2": 30, "3": 20}

Case = tuple[dict[str, int], list[str], str, str, Fraction | None]
TRAINS: dict[str, Case] = {
    # wheels, meshes, rest, the ratio asked, its value; of one without a sign its size
    "bevel pair": (PAIR, BEVEL, "", "U_1_2", Fraction(5, 2)),
    "worm": ({"1": 2, "2": 50}, [mesh("1", "2", "worm")], "", "U_1_2", Fraction(25)),
    "left worm": ({"1": 2, "2": 50}, [LEFT], "", "U_1_2", Fraction(25)),
    "bevel, worm": (
        {**PAIR, "2'": 2, "3": 60}, [*BEVEL, mesh("2'", "3", "worm")], "", "U_1_3", Fraction(75)
    ),
    "two worms": (
        {"1": 2, "2": 50, "2'": 1, "3": 40}, [LEFT, mesh("2'", "3", "worm")], "", "U_1_3",
        Fraction(1000),
    ),
    "wheels, bevel pair": (
        {**PAIR, "2'": 20, "3": 30}, [mesh("1", "2"), mesh("2'", "3", "bevel")], "", "U_1_3",
        Fraction(15, 4),
    ),
    "bevel pair, wheels": (
        {**PAIR, "2'": 20, "3": 30}, [*BEVEL, mesh("2'", "3")], "", "U_1_3", Fraction(15, 4)
    ),
    "worm, planetary set": (
        {"1": 2, "2": 94, "2'": 20, "3": 30, "4": 80},
        [mesh("1", "2", "worm"), mesh("2'", "3", "external", "H"), mesh("3", "4", "internal", "H")],
        'fixed = ["4"]', "U_1_H", Fraction(235),
    ),
    "satellite of a bevel set": (
        SET, [mesh("1", "2", "bevel", "H"), mesh("2", "3", "bevel", "H")], 'fixed = ["3"]',
        "U_1_2^H", Fraction(3, 2),
    ),
}  # fmt: skip

SIGNED: dict[str, Case] = {
    "wheels before a bevel pair": (
        {**PAIR, "2'": 20, "3": 30}, [mesh("1", "2"), mesh("2'", "3", "bevel")], "", "U_1_2",
        Fraction(-5, 2),
    ),
    "wheels behind a bevel pair": (
        {**PAIR, "2'": 20, "3": 30}, [*BEVEL, mesh("2'", "3")], "", "U_2_3", Fraction(-3, 2)
    ),
    "double bevel": (SET, [*BEVEL, mesh("2", "3", "bevel")], "", "U_1_3", Fraction(-1)),
    "bevel differential": (
        SET, [mesh("1", "2", "bevel", "H"), mesh("2", "3", "bevel", "H")], "", "U_1_3^H",
        Fraction(-1),
    ),
    "bevel planetary set": (
        SET, [mesh("1", "2", "bevel", "H"), mesh("2", "3", "bevel", "H")], 'fixed = ["3"]',
        "U_1_H", Fraction(2),
    ),
    "planetary set behind a worm": (
        {"1": 2, "2": 94, "2'": 20, "3": 30, "4": 80},
        [mesh("1", "2", "worm"), mesh("2'", "3", "external", "H"), mesh("3", "4", "internal", "H")],
        'fixed = ["4"]', "U_2_H", Fraction(5),
    ),
    "crossed belt before a worm": (
        {"1": 20, "2": 40, "2'": 2, "3": 40}, [mesh("1", "2", "crossed belt"),
                                               mesh("2'", "3", "worm")],
        "", "U_1_2", Fraction(-2),
    ),
}  # fmt: skip


def text_of(case: Case) -> str:
    wheels, meshes, rest, name, _ = case
    inputs = "{ 1 = 100, H = 20 }" if "differential" in rest or name == "U_1_3^H" else "{ 1 = 100 }"
    return told(wheels, meshes, f'{rest}\nn = {inputs}\nask = ["{name}", "n_2"]')


@each("name", [*TRAINS])
def test_a_ratio_between_crossing_axes_is_a_size(name: str, tmp_path: Path) -> None:
    motion = solved(tmp_path, text_of(TRAINS[name]))
    *_, asked, size = TRAINS[name]
    assert answer(motion, asked).exact == size
    for lang in LANGUAGES:
        lines = [line.text for line in derivation(motion, language(lang))]
        assert any(SENTENCE[lang] in line for line in lines)
        assert not any(sense in line for line in lines for sense in SENSES[lang])


@each("name", [*SIGNED])
def test_a_ratio_of_parallel_axes_keeps_its_sign(name: str, tmp_path: Path) -> None:
    motion = solved(tmp_path, text_of(SIGNED[name]))
    *_, asked, value = SIGNED[name]
    assert answer(motion, asked).exact == value
    symbol = asked.split("^")[0].replace("U_", "").replace("_", "")
    lines = [line.text for line in derivation(motion, language("en"))]
    said = [line for line in lines if SENTENCE["en"] in line]
    assert not any(f"_{{{symbol}}}" in line for line in said)


def test_nothing_speaks_of_a_carrier_that_is_not_there(tmp_path: Path) -> None:
    path = tmp_path / "train.toml"
    for name in ("bevel pair", "bevel, worm", "bevel pair, wheels"):
        path.write_text(f"[gears]\n{text_of(TRAINS[name])}", encoding="utf-8")
        for command in ("solve", "protocol"):
            run = CliRunner().invoke(cli, [command, str(path), "--lang", "ru"])
            assert run.exit_code == 0, run.output
            assert "водил" not in run.output
        run = CliRunner().invoke(cli, ["sheet", str(path), "--format", "svg", "-o", str(tmp_path)])
        assert run.exit_code == 0, run.output
