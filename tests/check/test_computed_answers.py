"""Answers of trains and moving points: verdicts, named mistakes, inherited and missing values."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from doors import DEFAULT, GradedSubmission, Submission, Variants, WrittenAnswer, check, cli
from worked import PROBLEMS

TRAIN = PROBLEMS / "gears/gears-ex2.toml"
RIGHT = {"z_3": 80.0, "U_1_5": -2 / 15, "n_H": -75.0, "n_5": -375.0, "n_4": 125.0}
POINT = """[point]
x = "0.3*sin(2*t)"
y = "0.2*cos(2*t) + 0.1*t"
t = [0, 1]
"""


def checked(path: Path, told: dict[str, float], position: int | None = None) -> GradedSubmission:
    answers = tuple(WrittenAnswer(id=n, value=v, position=position) for n, v in told.items())
    return check(Variants(path, DEFAULT).task(None), Submission("s", answers))


def verdicts(one: GradedSubmission) -> dict[str, str]:
    return {a.id: a.verdict.value for a in one.answers if a.written is not None}


def codes(one: GradedSubmission) -> list[tuple[str, ...]]:
    return [diagnosis.codes for diagnosis in one.diagnosis]


@pytest.mark.parametrize(
    ("told", "wrong", "named"),
    [
        (RIGHT, {}, []),
        (RIGHT | {"n_5": 375.0}, {"n_5": "wrong"}, [("sign",)]),
        (RIGHT | {"z_3": 81.0}, {"z_3": "wrong"}, [()]),  # a count is right or wrong
        (RIGHT | {"n_5": -376.5}, {}, []),  # 0.4 %
        (RIGHT | {"n_5": -384.6}, {"n_5": "wrong"}, [()]),
        # The sign of the first mesh, with all that follows from it.
        (
            {"U_1_5": 2 / 15, "n_H": 75.0, "n_5": 375.0, "n_4": -125.0},
            {"U_1_5": "wrong", "n_H": "inherited", "n_5": "inherited", "n_4": "inherited"},
            [("G1",)],
        ),
        # z1/z2 of the first stage for z2/z1: n_H = -50*20/30.
        ({"n_H": -100 / 3, "n_5": -500 / 3}, {"n_H": "wrong", "n_5": "inherited"}, [("G2",)]),
        # U^H_53 = -4 for U_5H = 5: the carrier is left out.
        ({"n_H": -75.0, "n_5": 300.0}, {"n_5": "wrong"}, [("G3",)]),
        (RIGHT | {"n_5": -375 * math.pi / 30}, {"n_5": "wrong"}, [("S2",)]),
        # A slip with U that has no name: n_5 follows from it.
        (
            {"U_1_5": -0.17, "n_5": 50 / -0.17},
            {"U_1_5": "wrong", "n_5": "inherited"},
            [()],
        ),
        # n_5 is right, but not of this U.
        ({"U_1_5": -0.17, "n_5": -375.0}, {"U_1_5": "wrong", "n_5": "inconsistent"}, [()]),
    ],
)
def test_verdicts_of_a_train_and_its_mistakes_by_name(
    told: dict[str, float], wrong: dict[str, str], named: list[tuple[str, ...]]
) -> None:
    one = checked(TRAIN, told)
    assert verdicts(one) == {name: wrong.get(name, "ok") for name in told}
    assert codes(one) == named


def test_verdicts_of_a_point_and_its_mistakes_by_name(tmp_path: Path) -> None:
    path = tmp_path / "point.toml"
    path.write_text(POINT, encoding="utf-8")
    t = 1.0
    vx, vy = 0.6 * math.cos(2 * t), -0.4 * math.sin(2 * t) + 0.1
    ax, ay = -1.2 * math.sin(2 * t), -0.8 * math.cos(2 * t)
    v, a = math.hypot(vx, vy), math.hypot(ax, ay)
    tau, n = (vx * ax + vy * ay) / v, abs(vx * ay - vy * ax) / v
    right = {"v": v, "a": a, "a_tau": tau, "a_n": n, "rho": v * v / n}
    for told, off, named in (
        ({}, {}, []),
        (
            {"a_tau": n, "a_n": tau},
            {"a_tau": "wrong", "a_n": "inherited"},
            [("K1",)],
        ),
        ({"a_tau": a}, {"a_tau": "wrong"}, [("K2",)]),  # a_n may be by projections
        ({"v": v * v}, {"v": "wrong", "rho": "inconsistent"}, [("K3",)]),
        ({"v": abs(vx + vy)}, {"v": "wrong", "rho": "inconsistent"}, [("K4",)]),
        ({"rho": v / n}, {"rho": "wrong"}, [("K5",)]),
    ):
        one = checked(path, right | told, position=1)
        assert verdicts(one) == {name: off.get(name, "ok") for name in right}, told
        assert codes(one) == named
    # 2 degrees for 2 rad.
    c, s = math.cos(math.radians(2)), math.sin(math.radians(2))
    one = checked(path, {"v": math.hypot(0.6 * c, 0.1 - 0.4 * s)}, position=1)
    assert codes(one) == [("K6",)]


@pytest.mark.parametrize("t", [1.0, 0.7])
def test_mistakes_of_a_ring_on_a_turning_rod_are_named_and_followed(
    t: float, tmp_path: Path
) -> None:
    path = tmp_path / "rod.toml"
    names = ("vx", "vy", "v", "ax", "ay", "a", "a_tau", "a_n", "rho")
    asked = "answers = [" + ", ".join(f'{{ what = "{name}" }}' for name in names) + "]"
    law = f'r = "0.5 + 0.3*t^2"\nphi = "0.8*t^2"\nt = {t}\n'
    path.write_text(f"{asked}\n[point]\n{law}", encoding="utf-8")
    r, rate, phi, omega = 0.5 + 0.3 * t**2, 0.6 * t, 0.8 * t**2, 1.6 * t

    def told(angle: float, along: float, across: float, *, sign: float = 1.0) -> dict[str, float]:
        turn = cmath.rect(1.0, angle)
        v, a = complex(rate, r * omega) * turn, complex(along, across) * turn
        v = complex(rate * turn.real - sign * r * omega * turn.imag, v.imag)
        parts = v.conjugate() * a / abs(v)
        numbers = (v.real, v.imag, abs(v), a.real, a.imag, abs(a), parts.real, abs(parts.imag))
        return dict(zip(names, (*numbers, abs(v) ** 2 / abs(parts.imag)), strict=True))

    along, across, coriolis = 0.6 - r * omega**2, 1.6 * r + 2 * rate * omega, 2 * rate * omega
    assert set(verdicts(checked(path, told(phi, along, across))).values()) == {"ok"}
    for answers, code, root in (
        (told(math.radians(phi), along, across), "K6", "vx"),
        (told(phi, 0.6, across), "N2", "ax"),
        (told(phi, along, across - coriolis), "A1", "ax"),
        (told(phi, along, across - coriolis / 2), "A3", "ax"),
        (told(phi, along, across, sign=-1.0), "slip", "vx"),
    ):
        one = checked(path, answers)
        assert codes(one) == [(code,)]
        assert [name for name, judged in verdicts(one).items() if judged == "wrong"] == [root]


def run(*args: object) -> tuple[int, str]:
    done = CliRunner().invoke(cli, [str(arg) for arg in args])
    return done.exit_code, done.output


def test_files_and_contract_are_those_of_plans(tmp_path: Path) -> None:
    """Variants, units, senses, millimetres of the picture, key, form, pages, cells at fault."""
    path = tmp_path / "train.toml"
    text = (
        TRAIN.read_text(encoding="utf-8").partition("[published")[0]
        + """
[[answers]]
what = "n_5"
sense = true
letters = "n₅"
[[answers]]
what = "omega_5"
[[answers]]
what = "n_4"
form = "mm"
[variants.A]
gears.n = { 1 = 60 }
[variants.B]
gears.n = { 1 = 90 }
"""
    )
    path.write_text(text, encoding="utf-8")
    out, works = tmp_path / "out", tmp_path / "g.csv"
    works.write_text(
        "студент;вариант;величина;значение;единица;мм;направление\n"
        "1;A;n5;450;об/мин;;по часовой стрелке\n1;A;omega_5;-450;об/мин;;\n1;A;n_4;150;;40;\n"
        "2;B;n₅;-450;;;\n2;B;omega_5;-70,7;м/с;;\n",
        encoding="utf-8",
    )
    code, said = run("check", path, works, "--json")
    assert code == 1, said
    one, two = json.loads(said[: said.rindex("]") + 1])
    by_id: dict[str, Any] = {answer["id"]: answer for answer in one["answers"]}
    assert [by_id[name]["verdict"] for name in ("n5", "omega_5")] == ["ok", "ok"]
    assert by_id["n_4"]["exact_mm"] == pytest.approx(30.0)
    assert by_id["n_4"]["tolerance"] > 0.05 * 150  # of drawing, not of calculation
    assert [answer["verdict"] for answer in two["answers"]] == ["wrong", "unreadable", "blank"]
    assert [diagnosis["codes"] for diagnosis in two["diagnosis"]] == [["P2"]]
    assert "omega_5" in said or "м/с" in said
    for args in (("check", "--key", path), ("form", path, "--variant", "A")):
        code, said = run(*args, "-o", out)
        assert code == 0, said
    code, said = run("check", path, works, "-o", out)
    assert (code, len(list((out / "pages").iterdir()))) == (1, 4), said


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('[[answers]]\nwhat = "n_9"\n', "answers[0].what"),
        ('[[answers]]\nwhat = "U_1_3"\n', "U_1_3 has no value"),
        ('[[answers]]\nwhat = "U_1_5"\nsense = true\n', "has no sense"),
    ],
)
def test_an_answer_that_cannot_be_required_is_a_fault_of_the_file(
    tmp_path: Path, text: str, told: str
) -> None:
    path = tmp_path / "train.toml"
    path.write_text(TRAIN.read_text(encoding="utf-8") + text, encoding="utf-8")
    code, said = run("check", "--key", path, "-o", tmp_path)
    assert code == 3
    assert told in said


RIMS = """
[gears]
wheels = { 1 = 24, 2 = 36, "2'" = 30, 3 = 90, 4 = 20, 5 = 45 }
meshes = [
  { of = [1, 2], kind = "external", carrier = "H" },
  { of = ["2'", 3], kind = "internal", carrier = "H" },
  { of = [4, 5], kind = "external" },
]
bodies = [["H", "4"]]
fixed = ["3"]
n = { 1 = 1450 }
ask = ["U_1_H", "n_H", "n_2", "U_4_5", "U_1_5", "n_5"]
"""


def test_all_that_follows_from_a_wrong_rim_keeps_its_points(tmp_path: Path) -> None:
    """Rim 2 for 2': U_1H = 1 + 36·90/(24·36), then U_15 = U_1H·U_45 and Willis by n_H."""
    path = tmp_path / "rims.toml"
    path.write_text(RIMS, "utf-8")
    ratio = 1.0 + 90.0 / 24.0
    carrier = 1450.0 / ratio
    values = {"U_1_H": ratio, "n_H": carrier, "n_2": carrier * (1.0 - 90.0 / 36.0)}
    values |= {"U_4_5": -2.25, "U_1_5": -2.25 * ratio, "n_5": -carrier / 2.25}
    one = checked(path, values)
    assert [found.codes for found in one.diagnosis] == [("G4",)]
    assert {answer.id for answer in one.answers if answer.points < answer.of} == {"U_1_H"}
