"""Forces are checked like motion: the reported bound holds, and spoilt results are rejected."""

from __future__ import annotations

import json
import random
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import each, sampled, some
from click.testing import CliRunner, Result
from doors import (
    DOWN,
    SCALE,
    UNIT_ROUNDOFF,
    UNIT_SCALES,
    Cause,
    Doubt,
    DoubtWarning,
    ModelProblem as Problem,
    Name,
    PlanMethodError,
    PositionError,
    Precise,
    Solution,
    Statics,
    cli,
    evaluate_evaluate as evaluate,
    impossible_steps,
    positions_examine as examine,
    problem_loads as loads,
    statics_of,
    verify,
    warnings,
)
from loaded import loaded_problem

import planmethod

ROD = """
[frame]
O = [0, 0]
guides.x-x = {{ through = "O", angle = 0 }}
guides.f-f = {{ through = [0, {height!r}], angle = 0 }}
[links.1]
points = ["O", "A"]
OA = 0.125
[links.3]
points = ["A", "E"]
AE = 0.375
[links.4]
points = ["E"]
slides = {{ on = "x-x" }}
[links.2]
points = ["E", "F"]
EF = 0.2
[links.5]
points = ["F"]
slides = {{ on = "f-f" }}
[driver]
link = "1"
phi = {phi}
omega = 3
epsilon = 0
[assembly]
E = "right of A"
F = "right of E"
[dynamics]
gravity = 9.81
[dynamics.links.1]
mass = 2
centre = "A"
inertia = 0.05
[[loads]]
link = "2"
at = "F"
force = 800
angle = 35
"""
"""A rod between two guides, which it is nearly square to: its forces grow, the motion is plain."""


def run(folder: Path, text: str, command: str) -> Result:
    """Run a command on a problem in a folder."""
    (folder / "rod.toml").write_text(text)
    words = [str(folder / word) if word.endswith((".toml", ".npz")) else word
             for word in command.split()]  # fmt: skip
    if words[0] in ("sheet", "live"):
        words += ["-o", str(folder)]
    return CliRunner().invoke(cli, ["--lang", "en", *words], catch_exceptions=False)


def rod(gap: float, phi: object = 20) -> str:
    return ROD.format(height=0.2 - gap, phi=phi)


def exact_values(statics: Statics, rng: random.Random) -> Mapping[Name, Any]:
    """Read the plans to fifty digits, every datum moved within its last rounding."""
    referee, data = Precise(50), statics.data({**UNIT_SCALES, SCALE: 1.0}, np.array([0]))
    exact = {*UNIT_SCALES, SCALE, *statics.solution.construction.draft.branches}

    def moved(value: float) -> Any:
        return referee.lift(value) * (1 + referee.lift(rng.uniform(-1, 1) * UNIT_ROUNDOFF))

    given = {}
    for name, column in data.items():
        value = np.ravel(column)[0].item()
        if name in exact or (name in statics.board.data and value == DOWN):
            given[name] = referee.lift(value)
        elif isinstance(value, complex):
            given[name] = referee.context.mpc(moved(value.real), moved(value.imag))
        else:
            given[name] = moved(value)
    return evaluate(statics.program, given, referee).value


def largest_error(statics: Statics, rng: random.Random) -> float:
    """Return the largest error of reactions and the balance, relative to the largest of a kind."""
    right, found = exact_values(statics, rng), statics.exact
    errors, sizes = [], []
    for reaction in statics.board.reactions:
        true = right[reaction.force.head] - right[reaction.force.tail]
        sizes.append(float(abs(true)))
        errors.append(float(abs(true - complex(found.vector(*reaction.force.ends)[0]))))
    true = right[statics.driving.balance]
    off = float(abs(true - float(found.number(statics.driving.balance)[0])))
    return max(max(errors) / max(sizes), off / float(abs(true)))


def at_the_limit(problem: Problem) -> list[float]:
    """Return positions nearer and nearer to where the mechanism can be assembled no longer."""

    def exists(at: float) -> bool:
        try:
            return bool((impossible_steps(Solution(problem, positions=[at])) < 0).all())
        except PlanMethodError:
            return False

    step = 1.0 if problem.drive.goes_round else 1e-3
    inside = float(problem.drive.positions[0])
    outside = next((x for x in inside + step * np.arange(400) if not exists(x)), None)
    if outside is None:
        return []
    inside = float(outside) - step
    for _ in range(60):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if exists(middle) else (inside, middle)
    return [x for k in range(2, 13, 2) if exists(x := inside - step * 10.0**-k)]


@each("seed", sampled(range(some(60, few=8)), 3))
def test_no_error_of_a_force_exceeds_the_reported_bound(seed: int) -> None:
    problem, _ = loaded_problem(seed)
    rng = random.Random(seed)
    for at in at_the_limit(problem):
        statics = Statics(Solution(problem, positions=[at]))
        if not statics.closes.all():
            continue
        bound, error = float(statics.bound[0]), largest_error(statics, rng)
        assert error <= bound, (at, error, bound)
        assert bound > 1e-9 or bound <= 2e3 * max(error, 1e-14)


def test_doubtful_forces_are_reported_where_the_motion_is_certain() -> None:
    solution = Solution(loads(rod(1e-12), name="rod"))
    assert not warnings(solution)
    (doubt,) = warnings(solution, forces=True)
    assert isinstance(doubt, Doubt) and doubt.forces and 1e-6 < doubt.bound < 1e-2
    assert "reactions" in str(doubt)
    # The reaction of the upper guide by hand: the load's part along the guides over a tiny arm.
    pushed = 800.0 * np.exp(1j * np.radians(35.0))
    side = (0.2**2 - (0.2 - 1e-12) ** 2) ** 0.5
    (upper,) = (r for r in statics_of(solution).reactions if (r.joint, r.on) == ("F", "5"))
    lifted = float(upper.force[0].imag) + pushed.imag
    assert lifted == pytest.approx(pushed.real * (0.2 - 1e-12) / side, rel=doubt.bound)


def test_a_program_in_python_is_warned_too() -> None:
    solution = Solution(loads(rod(1e-12), name="rod"))
    with pytest.warns(DoubtWarning, match="reactions and the balancing force or moment"):
        assert planmethod.statics(solution) is statics_of(solution)


def test_forces_spoilt_by_rounding_are_rejected_on_every_access() -> None:
    problem = loads(rod(1e-16), name="rod")
    solution = Solution(problem)
    verify(solution)
    for act in (
        lambda: verify(solution, forces=True),
        lambda: statics_of(solution).reactions,
        lambda: statics_of(solution).balance,
    ):
        with pytest.raises(PositionError) as told:
            act()
        assert told.value.failure.cause is Cause.SPOILT_FORCES
    gaps = examine(problem, np.array([20.0, 25.0]), forces=True).gaps
    assert gaps.count == 2 and gaps.moving.all()


@pytest.mark.parametrize(
    "command",
    [
        "solve rod.toml",
        "solve rod.toml --json",
        "solve rod.toml --csv",
        "solve rod.toml --npz a.npz",
        "solve rod.toml --ask forces",
        "protocol rod.toml",
        "sheet rod.toml --layout forces",
        "live rod.toml",
    ],
)
def test_every_command_reports_doubts_and_rejects_spoilt_forces(
    command: str, tmp_path: Path
) -> None:
    for gap, code, said in ((1e-12, 0, "are accurate to about"), (1e-16, 4, "rounding spoils its")):
        result = run(tmp_path, rod(gap), command)
        assert result.exit_code == code, result.output
        assert said in result.stderr


def test_the_record_has_the_bounds_and_the_referee_the_forces(tmp_path: Path) -> None:
    result = run(tmp_path, rod(1e-12), "solve rod.toml --json --referee")
    (entry,) = json.loads(result.stdout)["positions"]
    assert entry["bound"] < 1e-8 < 1e-6 < entry["forces"]["bound"] < 1e-2
    judged = entry["referee"]
    assert judged["forces_bound"] <= entry["forces"]["bound"]
    reaction = judged["results"]["F_F_5/0"]
    assert float(reaction["y"]) == pytest.approx(2.07e8, rel=1e-2)
    assert len(reaction["y"].replace(".", "")) >= 49
    assert {"M_dr", "M_lever", "F_O_1/0"} <= judged["results"].keys()


def test_a_partial_record_keeps_existing_results(tmp_path: Path) -> None:
    result = run(tmp_path, rod(1e-16, [20, 30]), "solve rod.toml --json --partial")
    entries = json.loads(result.stdout)["positions"]
    assert all(entry["points"]["E"]["v"] > 0 and "spoils" in entry["reason"] for entry in entries)
    assert not any("forces" in entry for entry in entries)
    text = rod(1e-12, [20, 30]).replace("AE = 0.375", "AE = 0.1")
    result = run(tmp_path, text, "solve rod.toml --json --partial --phi 20,90,30")
    first, dead, last = json.loads(result.stdout)["positions"]
    assert first["forces"]["reactions"] and first["reason"] is last["reason"] is None
    assert dead["points"] is dead["forces"] is dead["bound"] is None
    assert dead["phi_deg"] == 90.0 and "does not reach" in dead["reason"]
