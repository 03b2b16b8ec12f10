"""Ratios between axes that cross have sizes and no signs; those of parallel axes keep theirs."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    PlanRequest,
    SchemeData,
    SideView,
    Stroke,
    TrainMotion,
    answer,
    arrange,
    best_order,
    cli,
    derivation_derivation as derivation,
    gears_reader_load as load,
    gears_sheet_drawings,
    get_language,
    mesh_row,
    scheme_parts,
    solve_motion,
)
from trains import mesh, solved, told
from worked import PROBLEMS

SENTENCE = {"en": "is not defined: axes cross", "ru": "не определяется: на пути"}
SENSES = {"en": ("turn in the same sense", "turn in opposite senses"),
          "ru": ("вращаются в одну сторону", "вращаются в разные стороны")}  # fmt: skip

BEVEL = [mesh("1", "2", "bevel")]
LEFT = '{ of = ["1", "2"], kind = "worm", hand = "left" }'
PAIR = {"1": 20, "2": 50}
SET = {"1": 20, "2": 30, "3": 20}

Case = tuple[dict[str, int], list[str], str, str, Fraction | None]
TRAINS: dict[str, Case] = {
    # wheels, meshes, rest, the requested ratio, its value, or its size if it has no sign
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
        lines = [line.text for line in derivation(motion, get_language(lang))]
        assert any(SENTENCE[lang] in line for line in lines)
        assert not any(sense in line for line in lines for sense in SENSES[lang])


@each("name", [*SIGNED])
def test_a_ratio_of_parallel_axes_keeps_its_sign(name: str, tmp_path: Path) -> None:
    motion = solved(tmp_path, text_of(SIGNED[name]))
    *_, asked, value = SIGNED[name]
    assert answer(motion, asked).exact == value
    symbol = asked.split("^")[0].replace("U_", "").replace("_", "")
    lines = [line.text for line in derivation(motion, get_language("en"))]
    said = [line for line in lines if SENTENCE["en"] in line]
    assert not any(f"_{{{symbol}}}" in line for line in said)


def test_no_text_mentions_a_carrier_that_does_not_exist(tmp_path: Path) -> None:
    path = tmp_path / "train.toml"
    for name in ("bevel pair", "bevel, worm", "bevel pair, wheels"):
        path.write_text(f"[gears]\n{text_of(TRAINS[name])}", encoding="utf-8")
        for command in ("solve", "protocol"):
            run = CliRunner().invoke(cli, [command, str(path), "--lang", "ru"])
            assert run.exit_code == 0, run.output
            assert "водил" not in run.output
        run = CliRunner().invoke(cli, ["sheet", str(path), "--format", "svg", "-o", str(tmp_path)])
        assert run.exit_code == 0, run.output


# Senses on the scheme -----------------------------------------------------------------------------

NEAR = np.array([0.0, 0.0, 1.0])
"""Direction towards the viewer of the scheme, with x to the right and y upwards on it."""


def arrows(motion: TrainMotion) -> list[complex]:
    """Return from where to where the straight arrows of senses point, in the order of drawing."""
    scheme = SchemeData(motion, 1.0)
    side = SideView(arrange(scheme, best_order(scheme)), {})
    heads = [one for one in side.items() if isinstance(one, Stroke) and one.tag == "sense"]
    return [complex(one.points[-1] - one.points[0]) for one in heads]


def front_of(omega: np.ndarray) -> complex:
    """Return how the near side of a wheel moves that turns so, on the paper."""
    x, y, _ = np.cross(omega, NEAR)
    return complex(x, y)


@each("speed", [100, -100])
def test_arrows_of_a_bevel_pair_are_those_of_one_velocity_at_the_pitch_point(
    speed: int, tmp_path: Path
) -> None:
    """The level wheel turns about x; at the pitch point above it both have one velocity."""
    text = text_of(TRAINS["bevel pair"]).replace("100", str(speed))
    one, other = arrows(solved(tmp_path, text))
    level = np.array([float(np.sign(speed)), 0.0, 0.0])
    pitch = np.cross(level, np.array([0.0, 1.0, 0.0]))
    # The wheel is left of the other, whose axis is upright: ω × (−x) is the same velocity.
    across = next(turn * np.array([0.0, 1.0, 0.0]) for turn in (1, -1)
                  if np.allclose(np.cross([0.0, turn, 0.0], [-1.0, 0.0, 0.0]), pitch))  # fmt: skip
    for drawn, omega in ((one, level), (other, across)):
        due = front_of(omega)
        assert (drawn / abs(drawn) - due / abs(due)) == pytest.approx(0, abs=1e-9)


@each("hand, speed", [("right", 100), ("right", -100), ("left", 100), ("left", -100)])
def test_arrows_of_a_worm_are_those_of_its_hand(hand: str, speed: int, tmp_path: Path) -> None:
    """The worm below the wheel turns about z; a right-handed thread that turns so goes along z."""
    worm = f'{{ of = ["1", "2"], kind = "worm", hand = "{hand}" }}'
    motion = solved(tmp_path, told({"1": 2, "2": 50}, [worm], f"n = {{ 1 = {speed} }}"))
    (drawn,) = arrows(motion)
    advance = np.sign(speed) * (1 if hand == "right" else -1) * NEAR
    # The thread does not move along and pushes back the tooth at the lowest point of the wheel.
    tooth = -advance
    omega = next(np.array([turn, 0.0, 0.0]) for turn in (1.0, -1.0)
                 if np.allclose(np.cross([turn, 0.0, 0.0], [0.0, -1.0, 0.0]), tooth))  # fmt: skip
    due = front_of(omega)
    assert (drawn / abs(drawn) - due) == pytest.approx(0, abs=1e-9)


MIXED = """module = 4
wheels.1 = 20\nwheels.2 = 40\nwheels."2'" = 25\nwheels.3 = 30\nwheels."3'" = 18\nwheels.4 = 36
wheels."4'" = 2\nwheels.5 = 60\nwheels."5'" = 20\nwheels.6 = 25\nwheels.7 = 70\nwheels."7'" = 15
meshes = [{ of = [1, 2] }, { of = ["2'", 3], kind = "bevel" }, { of = ["3'", 4] },
  { of = ["4'", 5], kind = "worm" }, { of = ["5'", 6], carrier = "H" },
  { of = [6, 7], kind = "internal", carrier = "H" }, { of = ["7'", 8], kind = "rack" }]
n = { 1 = 1500, H = 3 }
"""


def test_axes_in_several_planes_are_drawn_part_by_part(tmp_path: Path) -> None:
    """Every mesh is in one view, and its bodies turn there as the equations have it."""
    motion = solved(tmp_path, MIXED)
    parts = scheme_parts(motion)
    names = [[own.name for own in part.train.meshes] for part in parts]
    assert names == [["1-2", "2'-3"], ["3'-4", "4'-5"], ["5'-6", "6-7", "7'-8"]]
    for part in parts:
        assert not SchemeData(part, 1.0).undrawn
        assert part.speeds == motion.speeds
        for own in part.train.meshes:
            row, whole = (mesh_row(m.train, m.roles, m.axes, own) for m in (part, motion))
            assert {b: v for b, v in row.items() if v} == {b: v for b, v in whole.items() if v}


@each("name", sorted((PROBLEMS / "gears").rglob("*.toml")))
def test_shipped_trains_are_one_part(name: Path) -> None:
    motion = solve_motion(load(name))
    assert scheme_parts(motion) == (motion,)


def test_the_sheet_draws_every_wheel_of_a_train_in_several_planes(tmp_path: Path) -> None:
    path = tmp_path / "mixed.toml"
    path.write_text(f"[gears]\n{MIXED}", encoding="utf-8")
    (sheet,) = gears_sheet_drawings(load(path), PlanRequest())
    tags = {item.tag for item in sheet.items if hasattr(item, "tag")}
    drawn = {tag.removeprefix("link ") for tag in tags if tag.startswith("link ")}
    assert set(solved(tmp_path, MIXED).train.bodies) <= drawn
