"""Velocity diagrams as a construction: exact values, readings, errors, protocol, audit."""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import mpmath
import pytest
from cases import each, some, thinned
from click.testing import CliRunner
from doors import (
    DRAFTING_PROFILES as PROFILES,
    ExitCode,
    GearDrawing,
    LayOffLength,
    TrainMotion,
    VelocityDiagramError,
    cli,
    draw,
    gears_construction_construct as construct,
    gears_reader_load as load,
    read,
    solve_motion,
)
from jets import adjudicate
from trains import MAKERS, bevel, solved
from worked import PROBLEMS

FILES = sorted((PROBLEMS / "gears").glob("*.toml"))
PLANAR = [maker for maker in MAKERS if maker is not bevel]
BOARD = PROFILES["board"]


def drawn_of(motion: TrainMotion) -> GearDrawing:
    picture = draw(motion)
    assert picture is not None
    return construct(motion, picture)


def trains(folder: Path) -> Iterator[TrainMotion]:
    """Yield the trains of the files that have pictures, and random ones."""
    tasks = sorted((PROBLEMS / "gears").glob("*/*.toml"))
    motions = [solve_motion(load(path)) for path in [*FILES, *thinned(tasks, 5)]]
    motions += [
        solved(folder, maker(random.Random(seed)).text)
        for seed in range(some(60, 4))
        for maker in PLANAR
    ]
    yield from (motion for motion in motions if draw(motion) is not None)


def test_the_construction_gives_the_fractions_and_the_ruler_is_within_its_errors(
    tmp_path: Path,
) -> None:
    for motion in trains(tmp_path):
        drawn = drawn_of(motion)
        seen, rays = read(drawn, BOARD), dict(drawn.diagrams.rays)
        for spot in drawn.spots:
            arrow = seen.point(spot.end) - seen.point(spot.base)
            assert abs(arrow - float(spot.speed)) < 1e-12 * 60
            assert seen.point(spot.base).imag == pytest.approx(float(spot.height), abs=1e-12)
        for body, name in drawn.segments.items():
            label = drawn.label(body).split(", ")[0]
            assert float(seen.exact.value[name]) == pytest.approx(
                float(rays[label]), rel=1e-12, abs=1e-10
            )
        for one in drawn.quantities:
            exact = float(one.exact)
            assert float(seen.exact.value[one.read]) == pytest.approx(exact, rel=1e-11, abs=1e-9)
            off = abs(float(seen.read.value[one.read]) - exact)
            assert off <= 3 * seen.sigma[one.read] + 1e-9, one.name
        read_on = drawn.read_on(seen.detail_views)
        for body, name in drawn.segments.items():
            length, got = (abs(float(trace.value[name])) for trace in (seen.exact, seen.read))
            assert (body in read_on) == (0.25 <= length < 5.0), length
            times = read_on[body].times if body in read_on else 1.0
            assert abs(got - length) * times <= BOARD.ruler / 2 + 1e-9
            assert body not in read_on or length * times >= 10.0
        on_views = drawn.spots_on(seen.detail_views)
        for spot in drawn.spots:
            if spot.read is not None:
                length, got = (abs(float(one.value[spot.read])) for one in (seen.exact, seen.read))
                assert (spot.end in on_views) == (0.25 <= length < 5.0), length
                times = on_views[spot.end].times if spot.end in on_views else 1.0
                assert abs(got - length) * times <= BOARD.ruler / 2 + 1e-9
        assert [knot.number for knot in seen.detail_views] == [*range(len(seen.detail_views))]
        for knot in seen.detail_views:
            across = [seen.point(end).real * knot.times for pair in knot.ends for end in pair]
            assert max(across) - min(across) <= 60.0 + 1e-9


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_fifty_digits_are_the_fractions(path: Path) -> None:
    motion = solve_motion(load(path))
    if draw(motion) is None:
        pytest.skip("no picture")
    drawn = drawn_of(motion)
    with mpmath.workdps(50):
        data = drawn.numbers() | {
            name: mpmath.mpf(value.numerator) / value.denominator
            for name, value in drawn.data.items()
        }
        trace = adjudicate(drawn.program, data)
        for one in drawn.quantities:
            if isinstance(one.exact, Fraction):
                due = mpmath.mpf(one.exact.numerator) / one.exact.denominator
                assert abs(trace.value[one.read] - due) <= mpmath.mpf(10) ** -44 * (1 + abs(due))


@pytest.mark.parametrize(
    ("name", "starts"),
    [("gears-ex1", ("1",)), ("gears-ex4", ("1", "H")), ("gears-ex6", ("3",))],
)
def test_one_vector_is_laid_off_for_each_degree_of_freedom(
    name: str, starts: tuple[str, ...]
) -> None:
    """One vector for each degree of freedom; example 6 does not close from its input."""
    drawn = drawn_of(solve_motion(load(PROBLEMS / f"gears/{name}.toml")))
    assert (drawn.starts, drawn.calculated) == (starts, ())
    laid = [s for s in drawn.program.steps if isinstance(s, LayOffLength) and "laid" in s.length]
    assert len(laid) == len(starts)
    assert ("input" in drawn.data) == (name == "gears-ex6")


COUPLED = """wheels = { 1 = 20, 2 = 40, 3 = 100, 4 = 20, 5 = 40, 6 = 100 }
meshes = [{ of = [1, 2], carrier = "H" }, { of = [2, 3], kind = "internal", carrier = "H" },
 { of = [4, 5], carrier = "K" }, { of = [5, 6], kind = "internal", carrier = "K" }]
bodies = [["1", "4"], ["3", "K"]]
fixed = ["6"]
n = { 1 = 100 }
"""


def test_a_speed_that_does_not_follow_is_marked_as_calculated(tmp_path: Path) -> None:
    two_inputs = COUPLED.replace('fixed = ["6"]\n', "").replace("{ 1 = 100 }", "{ H = 5, 6 = 100 }")
    for text in (COUPLED, two_inputs):
        drawn = drawn_of(solved(tmp_path, text))
        seen = read(drawn, BOARD)
        assert set(drawn.lines) >= {"1", "2", "K", "5", "H"}
        assert seen.sigma
        alone = len(drawn.starts) == 1
        told = set() if alone else set(drawn.starts) - set(drawn.motion.train.inputs)
        assert set(drawn.calculated) == told


def test_a_wrong_construction_is_detected(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn = drawn_of(solve_motion(load(FILES[0])))
    monkeypatch.setitem(drawn.data, "mu", drawn.data["mu"] * 2)
    with pytest.raises(VelocityDiagramError, match="mesh equations"):
        read(drawn, BOARD)


# Commands -----------------------------------------------------------------------------------------


def run(*args: str) -> str:
    done = CliRunner().invoke(cli, args)
    assert done.exit_code == ExitCode.DONE, done.output
    return done.stdout


def file(name: str) -> str:
    return str(PROBLEMS / f"gears/{name}.toml")


@pytest.mark.usefixtures("russian")
def test_the_protocol_describes_every_point_line_and_reading() -> None:
    words = ("protocol", file("gears-ex2"), "--lang", "ru")
    told = run(*words)
    for said in (
        "Соединяем точки o₁' и a: прямая 1",
        "прямая 2, H — картина скоростей звена 2, H",
        "(o5) = −187,5 мм",
        "U_H5 = (o2, H)/(o5) = 0,200",
        "U^H_5-4 = −3/2",
    ):
        assert said in told, said
    assert "The diagram is drawn starting from 3" in run(
        "protocol", file("gears-ex6"), "--lang", "en"
    )
    coarse = run(*words, "--profile", "coarse", "--ruler", "2")
    assert "(o1) = 26,0 мм" in coarse
    assert coarse != told


@pytest.mark.parametrize(
    ("name", "row"),
    [
        (
            "gears-ex2",
            "| n_5 | мин⁻¹ | −384.6 | −375.00 | −375.00 | −9.6 | 2.56 | — | **differs**",
        ),
        ("gears-ex4", "| n_4 | мин⁻¹ | 531.2 | 530.92 |"),
        ("gears-ex6", "| U_1_H |  | −7.75 | 19.750 |"),
        ("planetary-k10", "| omega_2 | с⁻¹ | 24 | 25.000 |"),
    ],
)
def test_the_audit_names_the_errors_of_the_sources(name: str, row: str) -> None:
    told = run("audit", file(name), "--lang", "en")
    assert row in told
    assert sum("**differs**" in line for line in told.splitlines() if line[0:2] == "| ") == 1


@each(
    "words",
    ["sheet --phi 3", "sheet --errors", "sheet --layout homework", "lint --structure",
     "lint --sigma", "protocol --position 2", "protocol --phi 3"],
)  # fmt: skip
def test_options_of_plans_are_rejected(words: str) -> None:
    command, *options = words.split()
    done = CliRunner().invoke(cli, [command, file("gears-ex1"), *options])
    assert done.exit_code == ExitCode.USAGE
    assert options[0] in done.output
    assert "[gears]" in done.output
