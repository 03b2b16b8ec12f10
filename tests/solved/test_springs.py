"""Springs and dampers: against all links at once, statics of textbooks, and balances of energy."""

from __future__ import annotations

import json
import math
import random
from functools import cache

import numpy as np
import pytest
from cases import each, sampled, some
from doors import (
    Flywheel,
    Friction,
    ModelProblem as Problem,
    ProblemError,
    Solution,
    SpringState,
    Statics,
    Sweep,
    cycle_statement,
    get_language,
    problem_loads as loads,
    solution_record,
    spring_states,
    table_text,
)
from full_system import loads_of, pose_of, power_of, solve_all, springs_of
from newton import Motion
from sprung import sprung_problem

from benchmarks.rebuilt import table_of

SEEDS = range(some(200, few=40))
LIMIT = 1e-9


@cache
def sprung(seed: int) -> tuple[Problem, Motion, Statics]:
    problem, motion = sprung_problem(seed)
    return problem, motion, Statics(Solution(problem))


# Random mechanisms -------------------------------------------------------------------------------


@each("seed", sampled(SEEDS, 40))
def test_reactions_and_balance_are_those_of_all_links_at_once(seed: int) -> None:
    problem, motion, statics = sprung(seed)
    acting = loads_of(problem, motion)
    assert sum(1 for _ in springs_of(problem, motion)) >= 2
    joints = [(r.joint, r.on, r.by) for r in statics.reactions]
    answer = solve_all(problem, joints, pose_of(motion), acting)
    largest = max(answer.largest, *(abs(load.force) for load in acting))
    for reaction, joint in zip(statics.reactions, joints, strict=True):
        assert abs(reaction.force[0] - answer.joints[joint][0]) <= LIMIT * largest, joint
    powers = sum(map(abs, power_of(problem, motion, acting)))
    limit = LIMIT * powers / abs(problem.drive.rate)
    assert abs(statics.balance[0] - answer.balance) <= limit
    assert statics.lever is not None
    assert abs(statics.lever[0] - statics.balance[0]) <= limit


@each("seed", sampled(SEEDS, 5))
def test_a_preload_of_the_spring_s_own_force_changes_nothing(seed: int) -> None:
    problem, _, statics = sprung(seed)
    state = next(s for s in spring_states(statics.solution) if s.spring.length is not None)
    force = float(state.force[0]) + state.spring.damping * float(state.rate[0])
    table = dict(problem.source_table)
    entries = [dict(entry) for entry in table["springs"]]
    for entry in entries:
        if entry.get("length") == state.spring.length:
            del entry["length"]
            entry["preload"] = force
    changed = read({**table, "springs": entries})
    other = Statics(Solution(changed))
    assert abs(other.balance[0] - statics.balance[0]) <= LIMIT * abs(statics.balance[0])


def read(table: dict[str, object]) -> Problem:
    return loads(table_text(table), name="changed")


# Power --------------------------------------------------------------------------------------------

RUBBED = {"f": 0.02, "f_pin": 0.02, "radius": 0.001}


def energy_rate(problem: Problem, motion: Motion) -> float:
    """Return d(kinetic energy)/dt by Newton's motion, W."""
    assert problem.dynamics is not None
    found = 0.0
    for link, mass in problem.dynamics.masses.items():
        found += mass.inertia * motion.omega[link] * motion.epsilon[link]
        if mass.centre is not None:
            v, a = (one[link, mass.centre] for one in (motion.velocity, motion.acceleration))
            found += mass.mass * (v.conjugate() * a).real
    return found


@each("seed", sampled(SEEDS, 40))
def test_the_powers_of_all_forces_are_the_rate_of_the_kinetic_energy(seed: int) -> None:
    """Driver, weights, loads, springs, dampers and friction; inertia is on the other side."""
    problem, motion, _ = sprung(seed)
    assert problem.dynamics is not None
    rubbed = read({**problem.source_table, "friction": RUBBED})
    still = [one for one in loads_of(problem, motion) if one.couple or one.force]
    acting = power_of(problem, motion, still)
    inertia = energy_rate(problem, motion)
    friction = Friction(Solution(rubbed))
    if friction.jammed[0]:
        return
    taken = sum(
        float(friction.rub(pair, friction.converged)[0] * abs(pair.rate[0]))
        for pair in friction.every
    )
    driven = float(friction.converged.power[0])
    # `loads_of` has the inertia forces among the loads: their power is that of -dT/dt.
    size = sum(map(abs, acting)) + abs(inertia) + abs(driven) + taken
    without = sum(acting) + inertia
    assert abs(driven + without - taken - inertia) <= LIMIT * size
    assert taken >= 0.0


@each("seed", sampled(range(40), 10))
def test_the_reduced_moment_and_the_flywheel_of_random_sprung_four_bars(seed: int) -> None:
    """M·ω is the power of all loads; a turn's work of the constant moment is theirs."""
    rng = random.Random(f"machine {seed}")
    text = HINGE.replace("phi = { from = 0, count = 720 }", "phi = 0")
    text += f"[dynamics]\ngravity = 9.81\n[dynamics.links.3]\nmass = {rng.uniform(1, 3)!r}\n"
    text += 'centre = "B"\n[dynamics.links.2]\nmass = 1\ncentre = "A"\ninertia = 0.01\n'
    text += '[machine]\ndelta = "1/20"\n[[loads]]\nlink = "3"\ncouple = 40\n'
    text += 'against = "rotation"\n[[springs]]\nlinks = ["2", "0"]\npoints = ["B", '
    text += f"[{rng.uniform(-0.2, 0)!r}, {rng.uniform(-0.3, -0.1)!r}]]\n"
    text += f"stiffness = {rng.uniform(10, 400)!r}\nlength = {rng.uniform(0, 0.4)!r}\n"
    text += f'damping = {rng.uniform(0, 40)!r}\n[[springs]]\nlinks = ["3", "2"]\njoint = "B"\n'
    text += f"stiffness = {rng.uniform(0, 3)!r}\nangle = {rng.uniform(-90, 90)!r}\n"
    machine = Flywheel(loads(text + f"damping = {rng.uniform(0, 1)!r}\n", name="machine"))
    solution, reduced = machine.solved(360), machine.reduced(360)
    straight, spiral = spring_states(solution)
    powers = straight.force * straight.rate + spiral.force * spiral.rate
    powers -= 40.0 * np.abs(solution.links["3"].omega)
    weights = [9.81 * problem_mass(machine, link) * solution.points[at].velocity.imag
               for link, at in (("3", "B"), ("2", "A"))]  # fmt: skip
    powers -= np.sum(weights, axis=0)
    assert np.allclose(reduced.moment * 3.0, -powers, atol=1e-9 * np.max(np.abs(powers)))
    energy = sum(reduced.links.values()) * 9.0 / 2
    still = [0.5 * problem_mass(machine, link) * np.abs(solution.points[at].velocity) ** 2
             for link, at in (("3", "B"), ("2", "A"))]  # fmt: skip
    still.append(0.005 * solution.links["2"].omega ** 2)
    assert np.allclose(energy, np.sum(still, axis=0), rtol=1e-9)
    # The exact integral of the damped turn is that of the samples: they are periodic.
    lost = np.mean(powers + 40.0 * np.abs(solution.links["3"].omega)) / 3.0
    rest = machine.constant + lost
    assert rest == pytest.approx(np.mean(40.0 * np.abs(solution.links["3"].omega)) / 3, rel=1e-3)


def problem_mass(machine: Flywheel, link: str) -> float:
    dynamics = machine.problem.dynamics
    assert dynamics is not None
    return dynamics.masses[link].mass


# Statics of textbooks ----------------------------------------------------------------------------

PRESS = """
[frame]
A = [0, 0]
guides.y-y = {{ through = "A", angle = 90 }}
[links.1]
points = ["A", "B"]
AB = {length}
[links.2]
points = ["B", "C"]
BC = {length}
[links.3]
points = ["C"]
slides = {{ on = "y-y" }}
[driver]
link = "1"
phi = {phi!r}
omega = 1
[assembly]
C = "above B"
[[loads]]
link = "1"
at = "B"
force = {force}
angle = 90
[[springs]]
name = "F_{{c}}"
links = ["0", "3"]
points = ["A", "C"]
stiffness = {stiffness}
length = {free}
"""


@pytest.mark.parametrize(("force", "free", "stiffness"), [(200.0, 0.3, 1000.0), (80.0, 0.5, 400.0)])
def test_the_two_bar_frame_of_beer_and_johnston_is_in_equilibrium(
    force: float, free: float, stiffness: float
) -> None:
    """Vector Mechanics, virtual work: sin θ = (P + 2kh)/(4kl), the spring has P/2, pulling."""
    length = 0.4
    angle = math.asin((force + 2 * stiffness * free) / (4 * stiffness * length))
    text = PRESS.format(
        length=length, phi=math.degrees(angle), force=force, stiffness=stiffness, free=free
    )
    solution = Solution(loads(text, name="beer"))
    (state,) = spring_states(solution)
    assert state.force[0] == pytest.approx(-force / 2, rel=1e-9)
    assert Statics(solution).balance[0] == pytest.approx(0.0, abs=1e-9 * force * length)


LAMP = """
[frame]
O = [0, 0]
[links.1]
points = ["O", "S", "P"]
OS = 0.5
P = { on = "OS", at = 0.12 }
[driver]
link = "1"
phi = { from = 10, to = 170, step = 20 }
omega = 1
[dynamics]
[dynamics.links.1]
mass = 2
centre = "S"
[[springs]]
links = ["1", "0"]
points = ["P", [0, 0.2]]
stiffness = STIFFNESS
length = 0
"""


def test_a_spring_of_no_free_length_balances_an_arm_at_every_angle() -> None:
    """Carwardine's lamp (GB 404615): k·a·b = m·g·l balances the weight at all angles."""
    stiffness = 2 * 9.81 * 0.5 / (0.12 * 0.2)
    statics = Statics(Solution(loads(LAMP.replace("STIFFNESS", repr(stiffness)), name="lamp")))
    assert np.max(np.abs(statics.balance)) <= 1e-9 * 2 * 9.81 * 0.5


# Energy ------------------------------------------------------------------------------------------

HINGE = """
[frame]
O = [0, 0]
D = [0.3, 0]
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B"]
AB = 0.28
[links.3]
points = ["D", "B"]
DB = 0.2
[driver]
link = "1"
phi = { from = 0, count = 720 }
omega = 3
[assembly]
B = "left of AD"
"""
STRUT = """
[[springs]]
name = "F1"
links = ["2", "0"]
points = ["B", [0.1, -0.15]]
stiffness = 2000
length = 0.2
"""
SPIRAL = """
[[springs]]
links = ["2", "3"]
joint = "B"
stiffness = 15
angle = 40
"""


def statics_with(*springs: str) -> Statics:
    return Statics(Solution(loads(HINGE + "".join(springs), name="hinge")))


def test_springs_do_no_work_in_a_turn_and_the_crank_gives_what_they_store() -> None:
    statics = statics_with(STRUT, SPIRAL)
    straight, spiral = spring_states(statics.solution)
    stored = 1000 * straight.deflection**2 + 7.5 * spiral.deflection**2
    phi = np.radians(statics.solution.positions)
    spectrum = np.fft.rfft(stored)
    slope = np.fft.irfft(1j * np.arange(len(spectrum)) * spectrum, len(phi))
    size = np.max(np.abs(statics.balance))
    assert np.max(np.abs(statics.balance - slope)) <= 1e-9 * size
    assert abs(np.mean(statics.balance)) <= 1e-9 * size


def test_a_damper_takes_what_the_crank_gives() -> None:
    statics = statics_with(STRUT.replace("stiffness = 2000\nlength = 0.2", "damping = 150"))
    (state,) = spring_states(statics.solution)
    assert np.allclose(statics.balance * 3.0, 150 * state.rate**2, rtol=1e-9, atol=1e-12)


def test_the_rate_is_the_derivative_of_the_length() -> None:
    for state in spring_states(statics_with(STRUT, SPIRAL).solution):
        spectrum = np.fft.rfft(state.deflection)
        count = len(state.deflection)
        slope = 3.0 * np.fft.irfft(1j * np.arange(len(spectrum)) * spectrum, count)
        assert np.allclose(slope, state.rate, rtol=0, atol=1e-9 * np.max(np.abs(state.rate)))


def test_the_order_of_the_ends_changes_no_force() -> None:
    swapped = STRUT.replace('["2", "0"]', '["0", "2"]').replace(
        '["B", [0.1, -0.15]]', '[[0.1, -0.15], "B"]'
    )
    one, other = statics_with(STRUT), statics_with(swapped)
    assert np.array_equal(one.balance, other.balance)
    first, second = (spring_states(s.solution)[0] for s in (one, other))
    assert np.array_equal(first.force, second.force)


# Preload and stops -------------------------------------------------------------------------------


def test_a_preload_is_the_force_in_the_first_position_of_the_file() -> None:
    text = HINGE + STRUT.replace("length = 0.2", "preload = 70")
    at = Solution(loads(text, name="hinge"), positions=[0.0, 100.0])
    (state,) = spring_states(at)
    assert state.force[0] == pytest.approx(70.0, rel=1e-12)
    alone = spring_states(at.with_positions([100.0]))[0]
    assert alone.force[0] == state.force[1]


def test_a_strut_without_stiffness_has_a_constant_force() -> None:
    text = HINGE + STRUT.replace("stiffness = 2000\nlength = 0.2", "preload = 400")
    (state,) = spring_states(Solution(loads(text, name="hinge")))
    assert isinstance(state, SpringState)
    assert np.all(state.force == 400.0)


def test_a_position_beyond_the_stops_is_a_fault_with_its_numbers() -> None:
    text = HINGE + STRUT.strip() + "\nstops = [0.2, 0.3]\n"
    solution = Solution(loads(text, name="hinge"))
    with pytest.raises(
        ProblemError, match=r"F1 is at 0\.\d+ m in the position .*0\.2 m and 0\.3 m"
    ):
        Statics(solution).balance  # noqa: B018


# Through the program ------------------------------------------------------------------------------


def test_a_sweep_has_the_forces_of_the_solution_and_none_beyond_the_stops() -> None:
    text = HINGE + STRUT.strip() + "\ndamping = 90\nstops = [0.2, 0.35]\n" + SPIRAL
    problem = loads(text, name="hinge")
    swept = Sweep(problem, ["M_dr"], forces=True)
    every = np.arange(0.0, 360.0, 15.0)
    found = swept.run(every)[-1]
    free = loads(text.replace("stops = [0.2, 0.35]", ""), name="free")
    solution = Solution(free, positions=every)
    lengths = spring_states(solution)[0].size
    inside = (lengths >= 0.2) & (lengths <= 0.35)
    assert 0 < inside.sum() < len(every)
    assert np.array_equal(np.isfinite(found), inside)
    assert np.allclose(found[inside], Statics(solution).balance[inside], rtol=1e-9)


def test_the_statement_has_every_key_of_the_springs() -> None:
    table = HINGE + STRUT.strip() + "\ndamping = 90\nstops = [0.1, 0.5]\n" + SPIRAL
    problem = loads(table, name="hinge")
    written = [dict(entry) for entry in problem.source_table["springs"]]
    written[1]["name"] = "M_{s2}"
    for lang in ("ru", "en"):
        facts = cycle_statement(Solution(problem), get_language(lang))
        mine = [fact for fact in facts if any(key.startswith("springs") for key in fact.data)]
        assert table_of(mine)["springs"] == written


def test_the_record_has_each_spring_under_its_name_in_the_file() -> None:
    problem = loads(HINGE + STRUT.replace("F1", "strut") + SPIRAL, name="hinge")
    whole = solution_record(Solution(problem, positions=[40.0]))
    record = json.loads(json.dumps(whole["positions"]))[0]["forces"]["springs"]
    assert [one["name"] for one in record] == ["strut", "M_{s2}"]
    state, spiral = spring_states(Solution(problem, positions=[40.0]))
    assert record[0]["length"] == state.size[0] and record[0]["force"] == state.force[0]
    assert record[1]["moment"] == spiral.force[0]


def test_springs_leave_the_driving_moment_of_a_machine_and_dampers_raise_it() -> None:
    """The constant moment of a turn works as much as the loads: a spring stores, a damper takes."""
    text = "\n".join(
        (
            HINGE.replace("phi = { from = 0, count = 720 }", "phi = 0"),
            '[dynamics]\n[dynamics.links.3]\nmass = 2\ncentre = "B"\n[machine]\ndelta = "1/20"',
            '[[loads]]\nlink = "3"\ncouple = 5\nagainst = "rotation"\n',
        )
    )
    bare, sprung, damped = (
        Flywheel(loads(text + more, name="machine"))
        for more in ("", STRUT + SPIRAL, STRUT.strip() + "\ndamping = 90\n")
    )
    assert sprung.constant == pytest.approx(bare.constant, rel=1e-9)
    (state,) = spring_states(statics_with(STRUT).solution)
    lost = 90 * float(np.mean(state.rate**2)) / 3.0
    assert damped.constant == pytest.approx(bare.constant + lost, rel=1e-9)


def test_a_torsion_spring_on_a_crank_that_turns_fully_jumps_half_a_turn_from_its_rest() -> None:
    """Its moment is that of the nearest turn: over a whole turn it does no work."""
    spiral = '\n[[springs]]\nlinks = ["0", "1"]\njoint = "O"\nstiffness = 3\nangle = 30\n'
    statics = statics_with(spiral)
    (state,) = spring_states(statics.solution)
    away = np.remainder(statics.solution.positions - 30.0 + 180.0, 360.0) - 180.0
    assert np.allclose(np.abs(state.deflection), np.abs(np.radians(away)), atol=1e-12)
    text = HINGE.replace("phi = { from = 0, count = 720 }", "phi = 0")
    text += '[machine]\ndelta = "1/20"\n[[loads]]\nlink = "3"\ncouple = 5\nagainst = "rotation"\n'
    masses = '[dynamics]\n[dynamics.links.3]\nmass = 2\ncentre = "B"\n'
    bare, wound = (Flywheel(loads(text + masses + more, name="machine")) for more in ("", spiral))
    assert wound.constant == pytest.approx(bare.constant, rel=1e-9)
