"""A sweep over a number of the file equals the file with that number, or is rejected by name."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import some, thinned
from doors import (
    ModelProblem as Problem,
    Parameters,
    PlanMethodError,
    Sweep,
    SweepError,
    Varied,
    kinds_load as load,
    kinds_loads as loads,
    pose,
    toml_of,
    without_variants,
)
from msgspec.structs import replace
from worked import PROBLEMS, every_file, path_of

from benchmarks.generator import random_problem

SHIPPED = [*every_file()]
SEEDS = range(7000, 7000 + some(60, few=2))


def texts() -> list[tuple[str, str]]:
    """Every problem by its name; the shipped ones first."""
    found = [(path.stem, path.read_text("utf-8")) for path in SHIPPED]
    return [*found, *((f"random-{seed}", random_problem(seed)[0]) for seed in SEEDS)]


def the_file_with(text: str, name: str, key: tuple[str | int, ...], value: Any) -> Problem:
    """Return a problem whose file has another number, by way of a variant."""
    problem = loads(text, name=name)
    if isinstance(key[-1], int):  # of a place that is a list
        place: Any = problem.source_table
        for part in key[:-1]:
            place = place[part]
        value = [value if k == key[-1] else old for k, old in enumerate(place)]
        key = key[:-1]
    variants = toml_of({"own": {".".join(map(str, key)): value}})
    whole = f"{without_variants(text).rstrip()}\n\n{variants}"
    return loads(whole, name=name, variant="own")


def test_a_sweep_with_a_number_is_the_file_with_it() -> None:
    """Places, velocities, accelerations, relative motion and forces, both ways from the file."""
    equal = refused = 0
    for number, (name, text) in enumerate(thinned(texts(), 9)):
        try:
            problem = loads(text, name=name)
        except PlanMethodError:
            continue  # of those that cannot be assembled
        forces, known = problem.dynamics is not None, Parameters(problem, pose)
        positions = np.array(problem.drive.positions[:2])
        names = list(Sweep(problem, forces=forces).parameters)
        for one in thinned(names[number % 5 :] or names, 5):
            sweep, own = Sweep(problem, forces=forces, varied=[one]), known.by_name[one]
            for value in (1.01 * own.value or 0.01, 0.99 * own.value or -0.01):
                try:
                    found = sweep.run(positions, {one: value})
                except SweepError as error:
                    assert f"{one} = {value:g}" in str(error), (name, one)
                    refused += 1
                    continue
                try:
                    other = the_file_with(text, name, own.key, value * own.per)
                    wanted = Sweep(other, forces=forces).run(positions)
                except PlanMethodError:
                    assert np.isnan(found).any(), (name, one, value)
                    continue
                assert found == pytest.approx(wanted, rel=1e-9, abs=1e-9, nan_ok=True), (name, one)
                equal += 1
    assert equal > 15 and equal > 10 * refused


def problem_of(name: str) -> Problem:
    return load(path_of(name))


def test_sides_of_a_triangle_move_its_point() -> None:
    """The point D of the rocker is placed by two sides: both are given, its coordinates are not."""
    problem = problem_of("linkages/ex2")
    sweep = Sweep(problem, ["v_D"], varied=["l_CD"])
    assert "x_D" not in sweep.parameters and "y_D" not in sweep.parameters
    step = 1e-6
    around = sweep.run(np.full(2, 30.0), {"l_CD": 0.11 + np.array([-step, step])})
    moved = np.hypot(*(around[:, 1] - around[:, 0])) / (2 * step)
    files = [
        Sweep(the_file_with(path_of("linkages/ex2").read_text("utf-8"), "ex2", key, 0.11 + by),
              ["v_D"]).run([30.0])[:, 0]
        for key in [("links", "3", "CD")] for by in (-step, step)
    ]  # fmt: skip
    assert moved == pytest.approx(np.hypot(*(files[1] - files[0])) / (2 * step), rel=1e-6)
    assert moved > 1.0
    with pytest.raises(SweepError, match="no parameter y_D to vary"):
        Sweep(problem, varied=["y_D"])


def test_a_parallelogram_stays_one_or_is_rejected() -> None:
    problem = problem_of("linkages/2.1.6")
    known = Sweep(problem).parameters
    names = [name for name in known if name.startswith("l_")]
    crank = next(n for n in names if n.startswith("l_O"))
    alike = [n for n in names if known[n] == known[crank]]
    with pytest.raises(SweepError, match=f"with {crank} = .* no parallelogram|parallelogram"):
        Sweep(problem, varied=[crank]).run([20.0], {crank: 1.01 * known[crank]})
    both = Sweep(problem, varied=alike).run([20.0], {n: 1.01 * known[n] for n in alike})
    assert np.isfinite(both).all()


def test_sizes_take_the_shapes_that_positions_go_with() -> None:
    """Each position has its own size, or each variant, beside a rate; few positions and many."""
    problem = problem_of("linkages/ex2")
    sweep = Sweep(problem, ["v_D", "a_B"], varied=["l_CD", "omega_1", "x_C"])
    sizes, rates = np.array([0.11, 0.112, 0.108]), np.array([40.0, 30.0, 20.0])
    one = [
        sweep.run([30.0 + k], {"l_CD": d, "omega_1": w, "x_C": 0.19 + 0.001 * k})[:, 0]
        for k, (d, w) in enumerate(zip(sizes, rates, strict=True))
    ]
    places = 0.19 + 0.001 * np.arange(3)
    each = sweep.run(30.0 + np.arange(3), {"l_CD": sizes, "omega_1": rates, "x_C": places})
    assert each == pytest.approx(np.array(one).T, rel=1e-13)
    wide = sweep.run(
        np.linspace(30.0, 32.0, 50),
        {"l_CD": sizes[:, None], "omega_1": rates[:, None], "x_C": places[:, None]},
    )
    assert wide.shape == (4, 3, 50)
    assert wide[:, 0, 0] == pytest.approx(one[0], rel=1e-12)
    assert wide[:, 2, -1] == pytest.approx(one[2], rel=1e-12)


def test_an_acceleration_that_the_file_leaves_out_has_steps_of_its_own() -> None:
    text = path_of("linkages/ex3").read_text("utf-8")
    bare = loads(text.replace("epsilon = 0\n", ""), name="ex3")
    sweep = Sweep(bare, ["a_B"], varied=["epsilon_1"])
    assert "epsilon_1" not in sweep.parameters
    found = sweep.run([20.0, 20.0], {"epsilon_1": np.array([0.0, 300.0])})
    for column, value in zip(found.T, (0, 300), strict=True):
        own = loads(text.replace("epsilon = 0\n", f"epsilon = {value}\n"), name="ex3")
        assert column == pytest.approx(Sweep(own, ["a_B"]).run([20.0])[:, 0], rel=1e-12)


def test_a_replaced_value_of_a_problem_is_not_varied() -> None:
    problem = problem_of("linkages/ex3")
    other = replace(problem, drive=replace(problem.drive, rate=1.0))
    found = Sweep(other, ["v_B"], varied=["l_AB"]).run([20.0], {"l_AB": 0.05})
    assert np.hypot(*found[:, 0]) == pytest.approx(0.05, rel=1e-12)
    with pytest.raises(SweepError, match=r"driver.omega.* drive was replaced"):
        Sweep(other, ["v_B"], varied=["omega_1"])


def test_an_assembly_is_chosen_again_for_each_size() -> None:
    """With keep = "continuous" and in groups of class III, too."""
    folder = Path(path_of("linkages/ex3")).parent
    problem = load(folder / "triad.toml")
    name = next(n for n in Sweep(problem).parameters if n.startswith("l_"))
    value = 1.004 * Sweep(problem).parameters[name]
    key = Parameters(problem, pose).by_name[name].key
    text = (folder / "triad.toml").read_text("utf-8")
    other = the_file_with(text, "triad", key, value * Parameters(problem, pose).by_name[name].per)
    at = np.array(problem.drive.positions)
    found = Sweep(problem, ["positions"], varied=[name]).run(at, {name: value})
    assert found == pytest.approx(Sweep(other, ["positions"]).run(at), rel=1e-9, abs=1e-9)


def test_sizes_that_are_inputs_give_what_a_reading_with_each_gives(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Lengths and places as inputs of the tape, against the file read with every set of them."""
    rng, together, apart = np.random.default_rng(54), 0, 0
    for path in thinned(sorted(PROBLEMS.glob("l*/*.toml")), 12):
        try:
            problem = load(path)
            names = [n for n in Sweep(problem).parameters if n[:2] in ("l_", "x_", "y_", "e_")]
        except PlanMethodError:
            continue
        names = list(rng.permutation(names)[:3])
        forces = problem.dynamics is not None
        positions = np.array(problem.drive.positions[:2])
        known = Sweep(problem, forces=forces).parameters
        sizes = {
            name: (known[name] * (1 + 0.03 * rng.standard_normal(16)))[:, np.newaxis]
            for name in names
        }
        found: list[Any] = []
        for quick in (True, False):
            with monkeypatch.context() as patch:
                if not quick:
                    patch.setattr(Varied, "straight", lambda *_: None)
                sweep = Sweep(problem, forces=forces, varied=names)
                failed = np.empty((16, len(positions)), np.int16)
                try:
                    values = sweep.run(positions, sizes, failed=failed)
                except SweepError as error:
                    found.append(str(error))
                    continue
                found.append((values, np.where(failed < 0, -1, 0)))
                if quick:
                    columns = np.array([own[:, 0] for own in sizes.values()])
                    told = sweep._varied.straight(columns)
                    together, apart = together + (told is not None), apart + (told is None)
        if isinstance(found[1], str):
            assert found[0] == found[1], path
            continue
        (quickly, gaps), (slowly, other) = found
        size = np.nanmax(np.abs(slowly), axis=(1, 2), initial=1e-9, keepdims=True)
        assert (np.isnan(quickly) == np.isnan(slowly)).all(), path
        assert np.nanmax(np.abs(quickly - slowly) / size, initial=0.0) < 1e-12, path
        assert (gaps == other).all(), path
    assert together > 5 and apart


def test_a_size_that_changes_the_assembly_is_read_alone() -> None:
    """C is to the right of B in the first position with some lengths on the other side only."""
    text = (
        '[frame]\nA = [0, 0]\nD = [0.3, 0]\n[links.1]\npoints = ["A", "B"]\nAB = 0.1\n'
        '[links.2]\npoints = ["B", "C"]\nBC = 0.25\n[links.3]\npoints = ["C", "D"]\nCD = 0.2\n'
        '[driver]\nlink = "1"\nphi = 60\nomega = 1\n[assembly]\nC = "left of AD"\n'
    )
    problem = loads(text, name="four-bar")
    places = np.linspace(0.2, 0.44, 25)[:, np.newaxis]
    sweep = Sweep(problem, ["C", "omega_3"], varied=["x_D", "l_CD"])
    found = sweep.run([60.0, 200.0], {"x_D": places, "l_CD": np.full((25, 1), 0.21)})
    for k, own in enumerate(places[:, 0].tolist()):
        file = text.replace("[0.3, 0]", f"[{own!r}, 0]").replace("CD = 0.2", "CD = 0.21")
        try:
            wanted = Sweep(loads(file, name="four-bar"), ["C", "omega_3"]).run([60.0, 200.0])
        except PlanMethodError:
            assert np.isnan(found[:, k]).any()
            continue
        assert found[:, k] == pytest.approx(wanted, rel=1e-12, abs=1e-12, nan_ok=True), own


def test_each_position_has_its_own_size_as_an_input() -> None:
    problem = problem_of("linkages/ex3")
    lengths = np.linspace(0.05, 0.08, 30)
    positions = np.linspace(0.0, 300.0, 30)
    sweep = Sweep(problem, ["v_E"], varied=["l_AB"])
    found = sweep.run(positions, {"l_AB": lengths})
    for k in (0, 13, 29):
        alone = sweep.run(positions[[k]], {"l_AB": lengths[[k]]})
        assert found[:, [k]] == pytest.approx(alone, rel=1e-12)
