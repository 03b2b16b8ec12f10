"""Forces in sweeps against `Statics` of solutions: values, names, requests, missing forces."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from functools import cache
from typing import Any

import mechanisms
import numpy as np
import numpy.typing as npt
import pytest
from cases import each, sampled, some
from doors import (
    BLOCKS_BLOCK as BLOCK,
    CHUNK,
    FEW,
    AssemblyError,
    GappedSweep,
    ModelProblem as Problem,
    ProblemError,
    Solution,
    Statics,
    Sweep,
    UnknownQuantityError,
    problem_load as load,
    problem_loads as loads,
    sweep_variants,
)
from loaded import loaded_problem
from msgspec.structs import replace
from worked import DEAD, every_file, path_of

from benchmarks.generator import KINDS

Array = npt.NDArray[Any]

FILES = [path for path in every_file() if load(path).dynamics is not None]
SEEDS = range(some(60, few=9))

CHANGING = """
[dynamics.links.1]
mass = 3
centre = "B"
inertia = 0.1
[dynamics.links.2]
mass = 2
centre = "S2"
inertia = 0.3
[[loads]]
link = "2"
at = "S2"
force = { over = "phi", values = [[20, 5], [200, -7]], interpolation = "linear" }
against = "velocity"
[[loads]]
name = "P"
link = "3"
at = "C"
force = { over = "x", values = [[0.21, 5], [0.32, -7]], interpolation = "linear" }
angle = 33
phases = { moving = "left" }
[[loads]]
link = "2"
couple = 4
against = "rotation"
phases = { phi = [200, 100], turning = "cw" }
[[loads]]
link = "1"
couple = -3
phases = { phi = [45.5, 100.5] }
[[loads]]
link = "2"
at = "B"
force = 8
angle = 60
"""

BY_POSITION = """
[[loads]]
link = "1"
couple = { over = "position", values = [1, 5, 2, 7] }
"""

SLIDING = """
[dynamics.links.2]
mass = 2
centre = "B"
inertia = 0.3
[[loads]]
link = "3"
at = "C"
force = { over = "s", values = [[0.3, 5], [0.35, -7]], interpolation = "linear" }
angle = 20
[[loads]]
link = "1"
couple = 4
against = "rotation"
"""


def expected(statics: Statics) -> Iterator[tuple[str, str, Array]]:
    """Yield label, row and values of all forces of a solution."""
    for planned, r in zip(statics.board.reactions, statics.reactions, strict=True):
        label, row = f"{r.joint}_{r.on}/{r.by}", f"{r.joint}.{r.on}-{r.by}"
        yield f"F_{label}", f"F.{row}.x", r.force.real
        yield f"F_{label}", f"F.{row}.y", r.force.imag
        yield f"F_{label}", f"F.{row}", np.abs(r.force)
        if planned.couple is not None:
            yield f"M_{label}", f"M.{row}", r.moment
    balancing = statics.solution.problem.drive.balancing
    letter, quantity = "M" if balancing.turns else "F", balancing.quantity
    yield f"{letter}_dr", f"driving.{quantity}", statics.balance
    if statics.lever is not None:
        yield f"{letter}_lever", f"lever.{quantity}", statics.lever


def agree(problem: Problem, positions: Array, asked: tuple[str, ...] = ("forces",)) -> Sweep:
    """Assert that a sweep has all forces of a solution, to rounding."""
    statics = Statics(Solution(problem, positions=positions.tolist()))
    sweep = Sweep(problem, asked)
    wanted = list(expected(statics))
    forces = [row for row in sweep.rows if row.label[:2] in ("F_", "M_")]
    assert [(row.label, row.name) for row in forces] == [(label, name) for label, name, _ in wanted]
    found = sweep.table(positions)
    sizes = [np.abs(r.force) + np.abs(r.moment) for r in statics.reactions]
    sizes += [np.abs(statics.balance), *(np.abs(g.applied.force) for g in statics.board.given)]
    big = np.max(sizes, axis=0)
    for _, name, values in wanted:
        assert found[name].shape == positions.shape
        assert (np.abs(found[name] - values) <= 1e-11 * big).all(), name
    return sweep


def about(problem: Problem, count: int) -> Array:
    """Return positions about the one of the file."""
    drive = problem.drive
    reach = 0.1 if drive.is_crank else 1e-4
    return drive.positions[0] + np.linspace(-reach, reach, count)


@cache
def changing() -> Problem:
    return loads(mechanisms.CRANK + CHANGING, name="changing")


# Values -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
@pytest.mark.parametrize("count", [1, FEW + 1])
def test_forces_of_the_files(path: Any, count: int) -> None:
    agree(load(path), about(load(path), count))


def test_every_dyad_and_driver_is_swept() -> None:
    seen: Counter[str] = Counter()
    for seed in SEEDS:
        problem = loaded_problem(seed)[0]
        seen["crank" if problem.drive.is_crank else "slider"] += 1
        seen.update(g.signature for g in Solution(problem, positions=[]).structure.groups)
        columns = Sweep(problem, ["forces"]).loads
        seen["against a motion"] += columns is not None and columns.need_motion
    wanted = (*KINDS, "crank", "slider", "against a motion")
    assert {kind: seen[kind] for kind in wanted if seen[kind] < some(5, few=2)} == {}


@each("seed", sampled(SEEDS, 3))
def test_forces_of_random_mechanisms(seed: int) -> None:
    problem = loaded_problem(seed)[0]
    agree(problem, about(problem, 3))
    agree(problem, about(problem, FEW + 3))


@pytest.mark.parametrize("count", [7, 361])
def test_loads_that_differ_from_position_to_position(count: int) -> None:
    sweep = agree(changing(), np.linspace(0.25, 359.75, count))
    assert sweep.loads is not None
    assert len(sweep.loads.names) == 6  # two forces with directions, two couples
    assert sweep.loads.need_motion


def test_loads_over_the_place_of_a_driving_slider() -> None:
    problem = loads(mechanisms.SLIDER + SLIDING, name="slider")
    sweep = agree(problem, np.linspace(0.28, 0.37, 101))
    assert [row.name for row in sweep.rows][-2:] == ["driving.force", "lever.force"]


@pytest.mark.parametrize("text", ["", CHANGING], ids=["steady", "changing"])
def test_a_driver_at_rest(text: str) -> None:
    """Without a lever."""
    still = mechanisms.CRANK.replace("omega = 10", "omega = 0") + (text or "[dynamics]\n")
    sweep = agree(loads(still, name="still"), np.linspace(10.0, 80.0, 50))
    assert "lever.moment" not in [row.name for row in sweep.rows]


def test_no_loads_are_no_forces() -> None:
    """A file with an empty `[dynamics]`: all forces are zero, in the shape of other results."""
    problem = loads(mechanisms.CRANK + "[dynamics]\n", name="idle")
    for count in (3, 100):
        found = Sweep(problem, ["forces"]).run(np.linspace(10.0, 80.0, count))
        assert found.shape[1] == count
        assert not found.any()


@pytest.mark.parametrize("problem", ["task12", "changing"])
def test_blocks_are_the_positions_one_by_one(problem: str) -> None:
    mine = changing() if problem == "changing" else load(path_of("levers/task12"))
    sweep = Sweep(mine, ["F_B_2/1", "M_dr"])
    positions = np.linspace(0.2, 359.8, 2 * BLOCK + 3)
    whole = sweep.run(positions)
    size = np.abs(whole).max(axis=1)
    for k in (0, BLOCK - 1, BLOCK, 2 * BLOCK - 1, 2 * BLOCK, 2 * BLOCK + 2):
        alone = Statics(Solution(mine, positions=[float(positions[k])]))
        wanted = {name: values[0] for _, name, values in expected(alone)}
        for row, found, limit in zip(sweep.rows, whole[:, k], size, strict=True):
            assert abs(found - wanted[row.name]) <= 1e-12 * limit, (k, row.name)


def test_a_load_over_positions_is_known_there_only() -> None:
    problem = loads(mechanisms.CRANK + BY_POSITION, name="by-position")
    agree(problem, np.array([0.0, 90.0, 180.0, 270.0]))
    agree(problem, np.array([270.0, 90.0]))
    assert Sweep(problem, ["v_C"]).run([33.0]).shape == (2, 1)
    with pytest.raises(ProblemError, match="phi = 33 deg is not one of them"):
        Sweep(problem, ["M_dr"]).run([0.0, 33.0])


# Requested quantities -----------------------------------------------------------------------------


def test_forces_are_among_other_results_in_the_requested_order() -> None:
    sweep = Sweep(changing(), ["M_dr", "v_C", "F_C_2/3", "B", "M_C_3/0"])
    names = [row.name for row in sweep.rows]
    force = ["F.C.2-3.x", "F.C.2-3.y", "F.C.2-3"]
    assert names == ["driving.moment", "C.vx", "C.vy", *force, "B.x", "B.y", "M.C.3-0"]
    positions = np.linspace(0.0, 350.0, 90)
    whole = Sweep(changing(), forces=True).table(positions)
    for name, values in zip(names, sweep.run(positions), strict=True):
        assert values == pytest.approx(whole[name], rel=1e-11, abs=1e-12 * np.abs(values).max())


def test_everything_is_the_motion_and_then_the_forces() -> None:
    problem = changing()
    motion = [row.name for row in Sweep(problem).rows]
    forces = [row.name for row in Sweep(problem, ["forces"]).rows]
    assert [row.name for row in Sweep(problem, forces=True).rows] == motion + forces
    assert len(set(motion + forces)) == len(motion + forces)
    swept = GappedSweep(problem, np.array([10.0, 20.0]))
    assert swept.names == tuple(motion + forces)
    ex1 = load(path_of("linkages/ex1"))
    assert GappedSweep(ex1, np.array([10.0])).names == tuple(row.name for row in Sweep(ex1).rows)


def test_a_force_alone_needs_fewer_steps() -> None:
    problem = load(path_of("levers/six-link"))
    some = Sweep(problem, ["F_H_4/2"])
    assert some.steps < Sweep(problem, ["forces"]).steps
    assert some.program == some.program.needed_for([step.out for step in some.program.steps])


@pytest.mark.parametrize(
    ("label", "hint"),
    [
        ("F_C_3/2", "did you mean 'F_C_2/3'?"),
        ("F_C_2-3", "did you mean 'F_C_2/3'?"),
        ("M_C_0/3", "did you mean 'M_C_3/0'?"),
        ("Mdr", "did you mean 'M_dr'?"),
        ("force", "did you mean 'forces'?"),
    ],
)
def test_an_unknown_force_comes_with_the_nearest(label: str, hint: str) -> None:
    with pytest.raises(UnknownQuantityError, match="Known: A, v_A") as caught:
        Sweep(changing(), ["v_C", label])
    assert hint in str(caught.value)


@pytest.mark.parametrize("label", ["forces", "F_B_2/1", "M_dr", "F_lever"])
def test_a_problem_without_loads_has_no_forces(label: str) -> None:
    problem = load(path_of("linkages/ex1"))
    with pytest.raises(UnknownQuantityError, match=r"the problem has no loads.*\[dynamics\]"):
        Sweep(problem, ["v_B", label])
    with pytest.raises(UnknownQuantityError, match="no result 'v_X'") as caught:
        Sweep(problem, ["v_X"])
    assert "forces" not in str(caught.value)


@pytest.mark.parametrize("label", ["centre x 1 3", "centre distance 1 3 B", "centre v B"])
def test_centres_are_printed_by_another_option(label: str) -> None:
    with pytest.raises(UnknownQuantityError, match="solve --centres --csv"):
        Sweep(load(path_of("linkages/ex1")), ["v_B", label])


def test_forces_of_variants_are_those_of_each_alone() -> None:
    problem = load(path_of("levers/task12"))
    assert not [name for name in Sweep(problem, ["M_dr"]).parameters if ":" in name]
    sweep = Sweep(problem, ["M_dr"], varied=["omega_1"])
    rate = sweep.parameters["omega_1"]
    found = sweep.run([10.0, 40.0], {"omega_1": np.array([[rate], [2.0 * rate]])})
    drive = replace(problem.drive, rate=2.0 * rate)
    faster = replace(problem, drive=drive)
    _, both = sweep_variants([problem, faster], [10.0, 40.0], ["M_dr"])
    for values in (found, both):
        for k, one in enumerate((problem, faster)):
            assert values[:, k] == pytest.approx(Sweep(one, ["M_dr"]).run([10.0, 40.0]), rel=1e-11)


# Where forces do not exist ------------------------------------------------------------------------


def at_dead(more: str) -> Sweep:
    return Sweep(loads(DEAD + more, name="dead"), ["C", "F_C_2/3", "F_B_2/1", "M_dr"])


COUPLE = '[[loads]]\nlink = "3"\ncouple = 5\n'
MASS = '[dynamics.links.3]\nmass = 2\ncentre = "C"\n'


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (COUPLE, "Cannot close the force plan at position 7 (phi = 180 deg): the mechanism is"),
        (MASS + COUPLE, "Cannot close the velocity plan at position 7 (phi = 180 deg)"),
        (COUPLE + 'against = "rotation"\n', "Cannot close the velocity plan at position 7"),
        (COUPLE + "phases = { phi = [0, 190] }\n", "Cannot close the force plan at position 7"),
    ],
)
@pytest.mark.parametrize("count", [3, FEW + 3])
def test_forces_end_where_a_mechanism_is_dead(more: str, said: str, count: int) -> None:
    """Places exist there; a load that depends on the motion needs its plans, too."""
    sweep = at_dead(more)
    positions = np.linspace(90.0, 270.0, count)
    out, failed = np.empty((len(sweep.rows), count)), np.empty(count, np.int16)
    sweep.run(positions, out=out, failed=failed)
    dead = positions == 180.0
    assert dead.sum() == 1
    assert (failed >= 0).tolist() == dead.tolist()
    assert np.isfinite(out[:2]).all()
    assert (np.isnan(out[2:]) == dead).all()
    assert sweep.explain(180.0, number=7).startswith(said)
    assert sweep.explain(90.0) == ""
    with pytest.raises(AssemblyError):
        _ = Statics(Solution(sweep.problem, positions=[180.0])).si


BESIDE = """
[links.4]
points = ["B", "E"]
BE = 2.0
[links.5]
points = ["G", "E"]
GE = 2.5
[[loads]]
link = "5"
at = "E"
force = 7
"""


@pytest.mark.parametrize(("way", "exists"), [("angle = 30", True), ('against = "velocity"', False)])
def test_a_load_against_a_motion_needs_the_whole_motion(way: str, exists: bool) -> None:
    """Standstill is judged against the largest speed, here that of another, dead group."""
    text = DEAD.replace("D = [3.0, 0.0]", "D = [3.0, 0.0]\nG = [-1.0, 2.5]")
    problem = loads(f'{text}E = "left of BG"\n{BESIDE}{way}\n', name="beside")
    sweep = Sweep(problem, ["F_G_5/0", "E"])
    for positions in (np.array([90.0, 180.0, 120.0]), np.linspace(90.0, 270.0, FEW + 3)):
        found = sweep.table(positions)
        dead = positions == 180.0
        assert np.isfinite(found["E.x"]).all()
        assert np.isnan(found["F.G.5-0"]).tolist() == (dead & (not exists)).tolist()
    assert ("Cannot close the velocity plan" in sweep.explain(180.0)) is not exists


def test_one_by_one_in_line_finds_the_dead_position_too() -> None:
    sweep = at_dead(COUPLE)
    assert np.isnan(sweep.run([180.0])[2:]).all()
    assert np.isfinite(sweep.run([180.0])[:2]).all()


def test_chunks_of_a_sweep_know_their_loads() -> None:
    positions = np.linspace(0.0, 360.0, CHUNK + 5)
    swept = GappedSweep(changing(), positions, ["M_dr"])
    parts = [swept.fill(np.empty((1, p.stop - p.start)), p) for p in swept.parts()]
    assert len(parts) == 2
    whole = Sweep(changing(), ["M_dr"]).run(positions)
    assert np.concatenate(parts, axis=1) == pytest.approx(whole, rel=1e-12, abs=1e-12)
