"""Sweeps against solutions: any number of positions, few and many, alone and in variants."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from cases import each, sampled, some
from doors import (
    BLOCKS_BLOCK as BLOCK,
    FEW,
    AssemblyError,
    ModelProblem as Problem,
    Solution,
    Sweep,
    SweepError,
    SweepRow,
    UnknownQuantityError,
    problem_load as load,
    problem_loads as loads,
    sweep_variants,
)
from worked import DEAD, every_file, path_of

from benchmarks.generator import random_problem

FILES = [path.stem for path in every_file()]
SEEDS = range(some(60, few=20))
NAMES = [*FILES, *(f"random-{seed}" for seed in SEEDS), *(f"whole-{seed}" for seed in SEEDS)]
TURNS = [name for name in FILES if name != "six-link"]
"""Files whose mechanism can be assembled in every position."""

Array = npt.NDArray[np.float64]


def in_whole_numbers(text: str) -> str:
    """Return a problem with lengths of whole metres and whole degrees: many numbers are equal."""

    def rounded(number: re.Match[str]) -> str:
        key, factor = number[1] or "", 1.0 if number[1] else 100.0
        return f"{key}{round(float(number[2]) * factor) or 1}.0"

    return re.sub(r"((?:angle|phi|n|omega|epsilon)\s*=\s*)?(-?\d+\.\d+(?:e-?\d+)?)", rounded, text)


@cache
def problem_of(name: str) -> Problem:
    kind, _, seed = name.partition("-")
    if kind == "random":
        return loads(random_problem(int(seed))[0], name=name)
    if kind == "whole":
        return loads(in_whole_numbers(random_problem(int(seed))[0]), name=name)
    return load(next(path for path in every_file() if path.stem == name))


@cache
def sweep_of(name: str) -> Sweep:
    try:
        return Sweep(problem_of(name))
    except AssemblyError:
        pytest.skip("cannot be assembled in whole numbers")


def near(name: str, count: int) -> Array:
    """Return positions about the one of the file."""
    drive = problem_of(name).drive
    reach = 3.0 if drive.is_crank else 1e-3
    return drive.positions[0] + np.linspace(-reach, reach, count)


def failures(sweep: Sweep, positions: Array) -> tuple[Array, npt.NDArray[np.int16]]:
    out = np.empty((len(sweep.rows), len(positions)))
    failed = np.empty(len(positions), np.int16)
    return sweep.run(positions, out=out, failed=failed), failed


def expected(solution: Solution) -> Iterator[tuple[str, str, Array]]:
    """Yield the kind, the row and its values of a solution."""
    for name, point in solution.points.items():
        for kind, suffix, vector in (
            ("place", "", point.place),
            ("velocity", "v", point.velocity),
            ("acceleration", "a", point.acceleration),
        ):
            yield kind, f"{name}.{suffix}x", vector.real
            yield kind, f"{name}.{suffix}y", vector.imag
    for name, link in solution.links.items():
        yield "direction", f"{name}.phi_deg", link.phi_deg
        yield "omega", f"{name}.omega", link.omega
        yield "epsilon", f"{name}.epsilon", link.epsilon


# Against solutions --------------------------------------------------------------------------------


@each("name", NAMES)
def test_a_sweep_gives_the_results_of_a_solution(name: str) -> None:
    sweep, positions = sweep_of(name), near(name, 2 * FEW)
    found, failed = failures(sweep, positions)
    able = failed < 0
    if not able.any():
        pytest.skip("cannot be assembled in whole numbers")
    solution = Solution(problem_of(name), positions=positions[able].tolist())
    assert solution.margin.min() > 0  # and does not refuse
    rows = {row.name: values[able] for row, values in zip(sweep.rows, found, strict=True)}
    largest: dict[str, Array] = {}
    wanted = list(expected(solution))
    for kind, _, values in wanted:
        largest[kind] = np.maximum(largest.get(kind, np.zeros(values.shape)), np.abs(values))
    # Accelerations may all be zero while links turn.
    largest["epsilon"] = np.maximum(largest["epsilon"], largest["omega"] ** 2)
    largest["acceleration"] = np.maximum(
        largest["acceleration"], largest["omega"] * largest["velocity"]
    )
    loss = {"place": 1, "direction": 1, "velocity": 2, "omega": 2}
    for kind, row, values in wanted:
        if row not in rows:  # a link that only slides, a crank that turns evenly
            assert kind in ("omega", "epsilon") and not values.any(), row
            continue
        apart = rows[row] - values
        size = largest[kind]
        if kind == "direction":
            apart, size = np.remainder(apart + 180.0, 360.0) - 180.0, np.full(size.shape, 180.0)
        bound = 2e-15 / np.minimum(solution.margin, 0.1) ** loss.get(kind, 3)
        assert (np.abs(apart) <= bound * size).all(), row


@each("name", NAMES)
def test_a_sweep_finds_the_same_positions_impossible(name: str) -> None:
    """A solution refuses those, and no others."""
    sweep = sweep_of(name)
    far = near(name, 1)[0] + np.linspace(-60.0, 60.0, 7) * (
        1.0 if problem_of(name).drive.is_crank else 1e-2
    )
    _, failed = failures(sweep, far)
    for position, guard in zip(far.tolist(), failed, strict=True):
        said = sweep.explain(position, number=8)
        assert bool(said) == (guard >= 0)
        alone = Solution(problem_of(name), positions=[position])
        if guard < 0:
            assert alone.margin[0] > 0
        else:
            assert sweep.reason(guard)
            with pytest.raises(AssemblyError):
                _ = alone.si


@each("seed", sampled(SEEDS, 3))
def test_directions_are_above_minus_180_degrees(seed: int) -> None:
    """A link along the negative axis has one direction, in one position and in many."""
    name = f"random-{seed}"
    sweep, positions = sweep_of(name), near(name, 2 * FEW)
    turning = [k for k, row in enumerate(sweep.rows) if row.name.endswith(".phi_deg")]
    for values in (sweep.run(positions), sweep.run(positions[:FEW])):
        found = values[turning][np.isfinite(values[turning])]
        assert ((found > -180.0) & (found <= 180.0)).all()


# Few and many -------------------------------------------------------------------------------------


@each("name", NAMES)
def test_a_line_of_python_gives_the_results_of_blocks(name: str) -> None:
    sweep, positions = sweep_of(name), near(name, FEW)
    blocks, failed = failures(sweep, positions)
    positions, blocks = positions[failed < 0], blocks[:, failed < 0]
    line = sweep.run(positions)
    assert line.shape == blocks.shape
    if line.size:
        np.testing.assert_array_max_ulp(line, blocks, maxulp=4)


@pytest.mark.parametrize("count", [0, 1, 2, FEW, FEW + 1, BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK])
def test_borders_of_blocks(count: int) -> None:
    """Each of n positions has its result, for any n."""
    sweep = sweep_of("ex3")
    positions = np.linspace(0.0, 359.0, count)
    found, failed = failures(sweep, positions)
    assert found.shape == (len(sweep.rows), count) == sweep.run(positions).shape
    assert (failed == -1).all()
    assert np.isfinite(found).all()
    largest = np.abs(sweep.run(np.arange(0.0, 360.0, 0.5))).max(axis=1, keepdims=True)
    for start in {0, max(count - 2, 0), min(count, BLOCK - 1)}:
        alone = sweep.run(positions[start : start + 2])
        assert (np.abs(found[:, start : start + 2] - alone) <= 1e-14 * largest).all()
    assert (np.abs(sweep.run(positions) - found) <= 1e-14 * largest).all()


@pytest.mark.parametrize("name", TURNS)
def test_equal_steps_give_the_results_of_any_order(name: str) -> None:
    sweep = sweep_of(name)
    positions = np.arange(0.0, 360.0, 0.03)
    order = np.random.default_rng(1).permutation(len(positions))
    equal, back = sweep.run(positions), np.empty((len(sweep.rows), len(positions)))
    back[:, order] = sweep.run(positions[order])
    largest = dict[str, float]()  # of a vector: one of its projections may be zero throughout
    for row, one in zip(sweep.rows, equal, strict=True):
        vector = row.name.rstrip("xy")
        largest[vector] = max(largest.get(vector, 0.0), float(np.nanmax(np.abs(one))))
    for row, one, other in zip(sweep.rows, equal, back, strict=True):
        apart = one - other
        if row.name.endswith("phi_deg"):
            apart = np.remainder(apart + 180.0, 360.0) - 180.0
        assert (np.isnan(one) == np.isnan(other)).all(), row.name
        assert np.nanmax(np.abs(apart)) <= 4e-15 * largest[row.name.rstrip("xy")], row.name


def test_nearly_equal_steps_are_distinguished_from_equal_ones() -> None:
    sweep = sweep_of("ex1")
    positions = np.arange(0.0, 90.0, 0.1)
    positions[450] += 1e-6
    row = [row.name for row in sweep.rows].index("1.phi_deg")
    assert sweep.run(positions)[row] == pytest.approx(positions, rel=0, abs=1e-13)


# Buffers and types --------------------------------------------------------------------------------


def test_results_go_into_a_buffer() -> None:
    sweep, positions = sweep_of("ex3"), np.arange(0.0, 360.0, 1.0)
    wanted = sweep.run(positions)
    out = np.full((len(sweep.rows), len(positions)), np.nan)
    assert sweep.run(positions, out=out) is out
    assert (out == wanted).all()
    wide = np.full((len(sweep.rows), len(positions) + 5), 7.0)
    sweep.run(positions, out=wide[:, 3:-2])
    assert (wide[:, 3:-2] == wanted).all()
    assert (wide[:, [0, 1, 2, -2, -1]] == 7.0).all()


def test_the_input_is_left_alone() -> None:
    sweep = sweep_of("ex3")
    for count in (3, 300):
        positions = np.linspace(0.0, 90.0, count)
        before = positions.copy()
        sweep.run(positions)
        assert (positions == before).all()
        positions.flags.writeable = False
        sweep.run(positions)
        sweep.run(positions.tolist())


@pytest.mark.parametrize("name", FILES)
def test_single_precision_is_good_for_pictures(name: str) -> None:
    problem, positions = problem_of(name), near(name, 500)
    single, double = Sweep(problem, dtype=np.float32).run(positions), sweep_of(name).run(positions)
    assert single.dtype == np.float32
    able = np.isfinite(double).all(axis=0)
    for row, one, two in zip(sweep_of(name).rows, single[:, able], double[:, able], strict=True):
        assert np.abs(one - two).max() <= 2e-3 * max(np.abs(two).max(), 1.0), row.name


def test_a_table_is_by_name() -> None:
    table = sweep_of("ex1").table([30.0])
    solution = Solution(problem_of("ex1"), positions=[30.0])
    assert table["B.x"] == pytest.approx(solution.points["B"].place.real)
    assert table["2.omega"] == pytest.approx(solution.links["2"].omega)


# Requested quantities -----------------------------------------------------------------------------


def test_a_request_needs_fewer_steps_and_keeps_its_order() -> None:
    sweep = Sweep(problem_of("ex3"), ["omega_3", "v_E", "B"])
    assert sweep.rows == (
        SweepRow("3.omega", "omega_3"),
        SweepRow("E.vx", "v_E"),
        SweepRow("E.vy", "v_E"),
        SweepRow("B.x", "B"),
        SweepRow("B.y", "B"),
    )
    whole = sweep_of("ex3")
    assert sweep.steps < whole.steps
    positions = np.arange(0.0, 360.0, 7.0)
    rows = {row.name: values for row, values in zip(whole.rows, whole.run(positions), strict=True)}
    for row, values in zip(sweep.rows, sweep.run(positions), strict=True):
        assert values == pytest.approx(rows[row.name], rel=1e-12, abs=1e-14), row.name


@pytest.mark.parametrize("asked", [["A"], ["v_A"], ["omega_1"], ["phi_5"], ["A", "B"], []])
@pytest.mark.parametrize("count", [0, 1, FEW, FEW + 1])
def test_immobile_quantities_may_be_requested(asked: list[str], count: int) -> None:
    found = Sweep(problem_of("ex3"), asked).run(np.linspace(0.0, 9.0, count))
    assert found.shape[1] == count
    assert np.isfinite(found).all()
    if asked == ["omega_1"]:
        assert (found == 50.0).all()
    if asked == ["A"]:
        assert (found == 0.0).all()


def test_an_unknown_result_comes_with_the_nearest() -> None:
    with pytest.raises(UnknownQuantityError, match=r"no result 'v_EE'; did you mean 'v_E'\?"):
        Sweep(problem_of("ex3"), ["v_EE"])


@each("name", NAMES)
def test_rows_have_names_of_their_own(name: str) -> None:
    names = [row.name for row in sweep_of(name).rows]
    assert len(set(names)) == len(names)


def test_units_are_directions() -> None:
    table = Sweep(problem_of("ex3"), ["u_2", "phi_2"]).table(np.arange(0.0, 360.0, 1.0))
    angle = np.radians(table["2.phi_deg"])
    assert table["2.cos"] == pytest.approx(np.cos(angle), abs=1e-14)
    assert table["2.sin"] == pytest.approx(np.sin(angle), abs=1e-14)


# Variants -----------------------------------------------------------------------------------------

VARIED = ("l_AB", "l_DE", "omega_1")


def separate(values: dict[str, float], positions: Array) -> Array:
    """Sweep a problem file that has the varied numbers."""
    text = path_of("linkages/ex3").read_text("utf-8")
    for name, value in values.items():
        key = name.removeprefix("l_") if name.startswith("l_") else "omega"
        text, found = re.subn(rf"(?m)^({key} = )[\d.]+", rf"\g<1>{value!r}", text, count=1)
        assert found, key
    return Sweep(loads(text, name="ex3")).run(positions)


def values_of(count: int) -> dict[str, Array]:
    rng = np.random.default_rng(count)
    known = sweep_of("ex3").parameters
    return {name: known[name] * rng.uniform(0.9, 1.1, count) for name in VARIED}


@pytest.mark.parametrize("count", [3, FEW + 3])
def test_parameters_of_every_position(count: int) -> None:
    """Shape (n,): each position has parameters of its own."""
    sweep, values = Sweep(problem_of("ex3"), varied=VARIED), values_of(count)
    positions = np.linspace(10.0, 200.0, count)
    found = sweep.run(positions, values)
    assert found.shape == (len(sweep.rows), count)
    for k in (0, 1, count - 1):
        one = {name: float(value[k]) for name, value in values.items()}
        wanted = separate(one, positions[k : k + 1])[:, 0]
        assert found[:, k] == pytest.approx(wanted, rel=1e-11, abs=1e-12)


@pytest.mark.parametrize("count", [3, FEW + 3])
def test_parameters_of_every_variant(count: int) -> None:
    """Shape (v, 1): every variant in every position."""
    sweep, values = Sweep(problem_of("ex3"), varied=VARIED), values_of(4)
    positions = np.linspace(10.0, 200.0, count)
    found = sweep.run(positions, {name: value[:, None] for name, value in values.items()})
    assert found.shape == (len(sweep.rows), 4, count)
    for k in range(4):
        wanted = separate({name: float(value[k]) for name, value in values.items()}, positions)
        assert found[:, k] == pytest.approx(wanted, rel=1e-11, abs=1e-12)


def test_parameters_of_all_shapes_go_together() -> None:
    sweep, values = Sweep(problem_of("ex3"), varied=VARIED), values_of(4)
    column, positions = values["l_AB"][:, None], np.linspace(10.0, 200.0, 50)
    known = sweep.parameters
    wanted = sweep.run(
        positions,
        {"l_AB": column, "l_DE": np.full((4, 1), known["l_DE"]), "omega_1": np.full((4, 1), 3.0)},
    )
    for rate in (3.0, np.full(50, 3.0), np.full((1, 1), 3.0), np.full((4, 50), 3.0), np.full(1, 3)):
        given: dict[str, Any] = {"l_AB": column, "l_DE": known["l_DE"], "omega_1": rate}
        assert (sweep.run(positions, given) == wanted).all()
    one = sweep.run([10.0], {"l_AB": values["l_AB"], "l_DE": known["l_DE"], "omega_1": 3.0})
    assert one == pytest.approx(wanted[:, :, 0], rel=1e-12, abs=1e-13)


def test_failures_of_variants() -> None:
    sweep = Sweep(problem_of("ex1"), varied=["l_BC"])
    length = sweep.parameters["l_BC"]
    positions, lengths = np.array([0.0, 90.0]), np.array([[length], [1e-3 * length]])
    out, failed = np.empty((len(sweep.rows), 2, 2)), np.empty((2, 2), np.int16)
    sweep.run(positions, {"l_BC": lengths}, out=out, failed=failed)
    assert failed[0].tolist() == [-1, -1]
    assert (failed[1] >= 0).any()
    assert np.isnan(out[:, failed >= 0]).any()


def test_parameters_that_do_not_fit() -> None:
    problem = problem_of("ex3")
    with pytest.raises(SweepError, match="no parameter l_XY to vary"):
        Sweep(problem, varied=["l_XY"])
    with pytest.raises(SweepError, match="takes the parameters l_AB"):
        Sweep(problem, varied=["l_AB"]).run([1.0])
    with pytest.raises(SweepError, match=r"takes the parameters \(none\)"):
        Sweep(problem).run([1.0], {"l_AB": 1.0})
    with pytest.raises(SweepError, match="shape"):
        Sweep(problem).run(1.0)


VARIANTS = """
[variants]
one = { driver.omega = 40, links.4.DE = 0.17 }
two = { driver.omega = -60 }
three = { links.1.AB = 0.06, links.3.CD = 0.2 }
"""


def variants() -> list[Problem]:
    text = re.sub(r"(?ms)^\[published.*", "", path_of("linkages/ex3").read_text("utf-8")) + VARIANTS
    return [loads(text, name="ex3", variant=name) for name in ("one", "two", "three")]


@pytest.mark.parametrize("count", [2, 100])
def test_variants_of_one_problem_are_one_sweep(count: int) -> None:
    problems, positions = variants(), np.linspace(0.0, 300.0, count)
    rows, found = sweep_variants(problems, positions, ["v_E", "omega_4", "E"])
    assert [row.name for row in rows] == ["E.vx", "E.vy", "4.omega", "E.x", "E.y"]
    assert found.shape == (5, 3, count)
    for k, problem in enumerate(problems):
        wanted = Sweep(problem, ["v_E", "omega_4", "E"]).run(positions)
        assert found[:, k] == pytest.approx(wanted, rel=1e-11, abs=1e-13)


def test_variants_that_differ_only_in_the_requested_position_give_equal_results() -> None:
    path = path_of("levers/task12-variants")
    problems = [load(path, variant=name) for name in "АБВ"]
    _, found = sweep_variants(problems, [10.0, 20.0])
    assert found.shape[1:] == (3, 2)
    assert (found[:, :1] == found).all()


def test_variants_of_other_mechanisms_are_rejected() -> None:
    with pytest.raises(SweepError, match="not built by the same steps as ex1"):
        sweep_variants([problem_of("ex1"), problem_of("ex3")], [0.0])


def test_variants_may_have_their_fixed_points_elsewhere() -> None:
    text = path_of("linkages/ex1").read_text("utf-8")
    moved = loads(re.sub(r"(?m)^A = \[.*\]", "A = [0.01, 0.0]", text), name="ex1")
    problems = [problem_of("ex1"), moved]
    _, found = sweep_variants(problems, [0.0, 20.0])
    for k, problem in enumerate(problems):
        assert found[:, k] == pytest.approx(Sweep(problem).run([0.0, 20.0]), rel=1e-12, abs=1e-13)


# Impossible positions -----------------------------------------------------------------------------


@pytest.mark.parametrize("count", [12, 500])
def test_impossible_positions_are_empty_and_reported(count: int) -> None:
    """The six-link mechanism closes in a part of the turn."""
    sweep, positions = sweep_of("six-link"), np.linspace(0.0, 360.0, count, endpoint=False)
    found, failed = failures(sweep, positions)
    assert 0 < (failed >= 0).sum() < count
    again = sweep.run(positions)
    assert np.array_equal(np.isnan(again), np.isnan(found))
    for row, values in zip(sweep.rows, found, strict=True):
        if row.name.startswith("B.") or row.name == "1.omega":
            assert np.isfinite(values).all()  # the crank turns on
        if row.name.startswith("C."):
            assert np.array_equal(np.isnan(values), failed >= 0)
    bad = int(np.flatnonzero(failed >= 0)[0])
    assert sweep.reason(failed[bad]) == "C"
    said = sweep.explain(float(positions[bad]), number=bad + 1)
    assert said.startswith(f"Cannot place C at position {bad + 1} (phi = {positions[bad]:g} deg)")
    assert sweep.explain(float(positions[failed < 0][0])) == ""


def test_a_request_fails_only_where_its_operands_do() -> None:
    """The crank of the six-link mechanism has places even where the other links have none."""
    positions = np.arange(0.0, 360.0, 0.5)
    for asked, can_fail in ((["B", "v_B"], False), (["C"], True), (["B", "omega_3"], True)):
        found, failed = failures(Sweep(problem_of("six-link"), asked), positions)
        assert (failed >= 0).any() == can_fail
        assert np.isnan(found).any() == can_fail


def test_places_exist_in_a_dead_position_and_velocities_do_not() -> None:
    """At 180 degrees the connecting rod and the rocker are in one line."""
    problem = loads(DEAD, name="dead")
    for count in (1, FEW + 1):
        places = Sweep(problem, ["C", "phi_3"]).run(np.full(count, 180.0))
        assert (np.abs(places[0] - 0.5) + np.abs(places[1]) < 1e-6).all()
        assert np.isnan(Sweep(problem, ["omega_3"]).run(np.full(count, 180.0))).all()
    assert "dead position" in Sweep(problem, ["omega_3"]).explain(180.0)
    assert Sweep(problem, ["C"]).explain(180.0) == ""


def test_positions_that_are_no_numbers_are_empty() -> None:
    sweep = sweep_of("ex3")
    row = [row.name for row in sweep.rows].index("B.x")
    with np.errstate(all="ignore"):
        for count in (3, 300):
            positions = np.linspace(0.0, 90.0, count)
            positions[1] = np.nan
            found = sweep.run(positions)
            assert np.isnan(found[row, 1])
            assert np.isfinite(found[:, np.arange(count) != 1]).all()
