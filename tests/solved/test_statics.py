"""Force analysis of random and worked mechanisms: against all links at once, power and energy."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from cases import each, sampled, some
from doors import (
    FRAME,
    Applied,
    Couple,
    Dynamics,
    Fixed,
    Load,
    LoadKind,
    ModelProblem as Problem,
    Solution,
    Statics,
    applied,
)
from full_system import (
    Acting,
    Answer,
    Joint,
    cross,
    loads_of,
    pose_of,
    power_of,
    slide_between,
    solve_all,
)
from loaded import loaded_problem
from moved import Move
from msgspec.structs import replace
from newton import Motion, solve as newton
from worked import problem_of

from benchmarks.generator import KINDS

SEEDS = range(some(200, few=25))
LIMIT = 1e-9

WORKED = ("levers/six-link", "levers/task12", "press/press")
AWAY = (0.0, 4.0, 133.0, -6.0)
"""Positions of the crank from the file's, degrees; all worked mechanisms reach them."""


@cache
def loaded(seed: int) -> Problem:
    return loaded_problem(seed)[0]


@cache
def solved(seed: int) -> Statics:
    return Statics(Solution(loaded(seed)))


@cache
def moving(seed: int) -> Motion:
    problem = loaded(seed)
    return newton(problem, problem.drive.positions[0], loaded_problem(seed)[1])


@cache
def acting(seed: int) -> list[Acting]:
    return loads_of(loaded(seed), moving(seed))


def joints_of(statics: Statics) -> list[Joint]:
    return [(r.joint, r.on, r.by) for r in statics.reactions]


@cache
def refereed(seed: int) -> Answer:
    joints = joints_of(solved(seed))
    return solve_all(loaded(seed), joints, pose_of(moving(seed)), acting(seed))


def largest(seed: int) -> float:
    """Largest force of a position, given or in a joint, N."""
    return max(refereed(seed).largest, *(float(abs(load.force)) for load in acting(seed)))


def powers(seed: int) -> float:
    """Sum of the powers of all loads without their signs, W."""
    return sum(map(abs, power_of(loaded(seed), moving(seed), acting(seed))))


# Random mechanisms -------------------------------------------------------------------------------


def test_every_dyad_and_driver_occurs() -> None:
    seen: Counter[str] = Counter()
    for seed in SEEDS:
        statics = solved(seed)
        seen["crank" if loaded(seed).drive.is_crank else "driving slider"] += 1
        seen.update(group.signature for group in statics.solution.structure.groups)
        loads = applied(statics.solution)
        acts = {(load.link, load.kind, load.point is None) for load in loads}
        links = loaded(seed).mechanism.links
        assert {(link, LoadKind.EXTERNAL, False) for link in links} <= acts
        seen.update(f"{kind.value}, couple: {couple}" for _, kind, couple in acts)
        dynamics = loaded(seed).dynamics
        assert dynamics is not None
        assert set(dynamics.masses) == set(links)
        seen.update(type(load.sense).__name__ for load in dynamics.loads)
        for joint in joints_of(statics):
            slide = slide_between(loaded(seed), joint)
            if slide is not None and FRAME not in joint:
                seen["guide on a moving link"] += 1
    kinds = [*KINDS, "crank", "driving slider", "guide on a moving link"]
    kinds += ["weight, couple: False", "inertia, couple: False", "inertia couple, couple: True"]
    kinds += ["external, couple: False", "external, couple: True", "Fixed", "Against", "NoneType"]
    assert {kind: seen[kind] for kind in kinds if seen[kind] < some(20, few=3)} == {}


@each("seed", sampled(SEEDS, 3))
def test_every_pair_has_one_reaction(seed: int) -> None:
    """In a hinge of k links the k - 1 pairs are connected and form no ring."""
    mechanism, joints = loaded(seed).mechanism, joints_of(solved(seed))
    assert len(set(joints)) == len(joints) == mechanism.lower_pairs
    assert 2 * len(joints) + 1 == 3 * len(mechanism.links)
    slides = [slide_between(loaded(seed), joint) for joint in joints]
    pairs = [(slide.slider, slide.host, slide.pin) for slide in slides if slide is not None]
    assert sorted(pairs) == sorted((p.slider, p.host, p.pin) for p in mechanism.prismatics)
    for hinge in mechanism.revolutes:
        together = {hinge.links[0]}
        mine = [
            {on, by}
            for (point, on, by), slide in zip(joints, slides, strict=True)
            if point == hinge.point and slide is None
        ]
        assert len(mine) == hinge.pairs
        for _ in mine:
            for pair in mine:
                together |= pair if pair & together else set()
        assert together == set(hinge.links)


@each("seed", sampled(SEEDS, 3))
def test_reactions_are_those_of_all_links_at_once(seed: int) -> None:
    """Kinematics and loads, too, are found apart from the plans."""
    limit = LIMIT * largest(seed)
    for r in solved(seed).reactions:
        joint = (r.joint, r.on, r.by)
        force, moment = refereed(seed).joints[joint]
        assert abs(r.force[0] - force) <= limit, joint
        slide = slide_between(loaded(seed), joint)
        if slide is None:
            assert r.moment[0] == 0.0
            assert abs(r.at[0] - moving(seed).position[r.on, r.joint]) <= LIMIT
        else:
            pin = moving(seed).position[slide.slider, slide.pin]
            about_pin = r.moment[0] + cross(r.at[0] - pin, r.force[0])
            assert abs(about_pin - moment) <= limit, joint


@each("seed", sampled(SEEDS, 3))
def test_the_balance_is_that_of_all_links_at_once(seed: int) -> None:
    limit = LIMIT * powers(seed) / abs(loaded(seed).drive.rate)
    assert abs(solved(seed).balance[0] - refereed(seed).balance) <= limit


@each("seed", sampled(SEEDS, 3))
def test_the_lever_is_the_balance(seed: int) -> None:
    statics = solved(seed)
    limit = LIMIT * powers(seed) / abs(loaded(seed).drive.rate)
    assert statics.lever is not None
    assert abs(statics.lever[0] - statics.balance[0]) <= limit


@each("seed", sampled(SEEDS, 3))
def test_virtual_power_is_zero(seed: int) -> None:
    """Newton's velocities; d'Alembert's forces are among the loads."""
    given = sum(power_of(loaded(seed), moving(seed), acting(seed)))
    balance = solved(seed).balance[0] * loaded(seed).drive.rate
    assert abs(given + balance) <= LIMIT * powers(seed)


@each("seed", sampled(SEEDS, 3))
def test_applied_loads_are_those_of_newtons_motion(seed: int) -> None:
    """Their sum on every link, and its moment about the origin."""
    solution = solved(seed).solution
    for link in loaded(seed).mechanism.links:
        mine = [load for load in applied(solution) if load.link == link]
        force = sum(load.force[0] for load in mine)
        moment = sum(_moment(solution, load) for load in mine)
        theirs = [load for load in acting(seed) if load.link == link]
        assert abs(force - sum(load.force for load in theirs)) <= LIMIT * largest(seed)
        turning = sum(cross(load.at, load.force) + load.couple for load in theirs)
        assert abs(moment - turning) <= LIMIT * largest(seed)


def _moment(solution: Solution, load: Applied) -> float:
    if load.point is None:
        return float(load.couple[0])
    return float(cross(solution.points[load.point].place[0], load.force[0]))


# Equilibrium, batches ----------------------------------------------------------------------------


@cache
def worked(name: str) -> Statics:
    """The press in its twelve positions, the others in those of `AWAY`."""
    problem = problem_of(name)
    away = [30.0 * k for k in range(12)] if name == "press/press" else AWAY
    phi = problem.drive.positions[0]
    return Statics(Solution(problem, positions=[phi + turn for turn in away]))


@pytest.mark.parametrize("name", WORKED)
def test_every_link_is_in_equilibrium(name: str) -> None:
    """Each pair counts on both its links, once with each sign (третий закон Ньютона)."""
    statics = worked(name)
    solution, loads = statics.solution, applied(statics.solution)
    drive = solution.problem.drive
    big = max(float(np.max(np.abs(r.force))) for r in statics.reactions)
    for link in solution.problem.mechanism.links:
        force = np.zeros(len(solution.positions), dtype=complex)
        moment = np.zeros(len(solution.positions))
        for r in statics.reactions:
            sign = (link == r.on) - (link == r.by)
            force += sign * r.force
            moment += sign * (cross(r.at, r.force) + r.moment)
        for load in loads:
            if load.link == link:
                force += load.force
                arm = 0j if load.point is None else solution.points[load.point].place
                moment += cross(arm, load.force) + load.couple
        if link == drive.link:
            moment += statics.balance
        assert np.max(np.abs(force)) <= 1e-11 * big, link
        assert np.max(np.abs(moment)) <= 1e-11 * big, link


@pytest.mark.parametrize("name", WORKED)
def test_the_lever_is_the_balance_in_every_position(name: str) -> None:
    statics = worked(name)
    assert statics.lever is not None
    size = float(np.max(np.abs(statics.balance)))
    assert np.max(np.abs(statics.lever - statics.balance)) <= 1e-11 * size


def assert_same(one: Statics, i: int, other: Statics, k: int) -> None:
    for r, s in zip(one.reactions, other.reactions, strict=True):
        assert (r.joint, r.on, r.by) == (s.joint, s.on, s.by)
        assert (r.at[i], r.force[i], r.moment[i]) == (s.at[k], s.force[k], s.moment[k])
    assert one.balance[i] == other.balance[k]
    assert one.lever is not None
    assert other.lever is not None
    assert one.lever[i] == other.lever[k]


@pytest.mark.parametrize("name", WORKED)
def test_a_batch_is_the_positions_one_by_one(name: str) -> None:
    whole = worked(name)
    for i, position in enumerate(whole.solution.positions[:4]):
        alone = Statics(Solution(whole.solution.problem, positions=[position]))
        assert_same(whole, i, alone, 0)


@each("seed", SEEDS[::20])
def test_a_batch_of_a_random_mechanism(seed: int) -> None:
    drive = loaded(seed).drive
    step = 0.01 if drive.is_crank else 1e-5
    positions = [drive.positions[0] + k * step for k in (1, 0, -1)]
    whole = Statics(Solution(loaded(seed), positions=positions))
    for i, position in enumerate(positions):
        assert_same(whole, i, Statics(Solution(loaded(seed), positions=[position])), 0)
    assert_same(whole, 1, solved(seed), 0)


@each("seed", SEEDS[::20])
def test_the_solution_stays_as_it_is(seed: int) -> None:
    """Forces may be computed twice, and before or after the motion."""
    solution = Solution(loaded(seed))
    program = solution.construction.program
    first, second = Statics(solution), Statics(solution)
    assert first.program == second.program
    assert solution.construction.draft.b.program() == program
    assert_same(first, 0, second, 0)
    assert_same(first, 0, solved(seed), 0)
    for link, motion in solved(seed).solution.links.items():
        assert (solution.links[link].phi_deg == motion.phi_deg).all()


# Dependence of the forces ------------------------------------------------------------------------


def dynamics_of(problem: Problem) -> Dynamics:
    assert problem.dynamics is not None
    return problem.dynamics


def compare(before: Statics, after: Statics, move: Move, force: float = 1.0) -> None:
    """Assert that the forces went with a motion, and became ``force`` times as large."""
    big = force * max(float(np.max(np.abs(r.force))) for r in before.reactions)
    turn = force * move.size * move.sense
    size = big * move.size
    for r, s in zip(before.reactions, after.reactions, strict=True):
        assert (r.joint, r.on, r.by) == (s.joint, s.on, s.by)
        away = force * move.vector(1 + 0j) * (np.conj(r.force) if move.mirrors else r.force)
        away = away / move.size
        assert np.max(np.abs(s.force - away)) <= LIMIT * big, r.joint
        assert np.max(np.abs(s.moment - turn * r.moment)) <= LIMIT * size, r.joint
    crank = before.solution.problem.drive.is_crank
    balance = (turn if crank else force) * before.balance
    assert np.max(np.abs(after.balance - balance)) <= LIMIT * (size if crank else big)
    assert after.lever is not None
    assert np.max(np.abs(after.lever - after.balance)) <= LIMIT * (size if crank else big)


def sized(dynamics: Dynamics, size: float) -> Dynamics:
    """Gravity and forces ``size`` times as large, couples and inertia as its square."""
    return replace(
        dynamics,
        gravity=size * dynamics.gravity,
        masses={k: replace(m, inertia=m.inertia * size**2) for k, m in dynamics.masses.items()},
        loads=tuple(
            replace(load, size=load.size * (size if isinstance(load, Load) else size**2))
            for load in dynamics.loads
            if isinstance(load.size, float | int)
        ),
    )


def mirrored(dynamics: Dynamics, move: Move) -> Dynamics:
    """Apply a motion to fixed directions and couples; it must leave gravity unchanged."""

    def moved(load: Load | Couple) -> Load | Couple:
        if isinstance(load, Load) and isinstance(load.sense, Fixed):
            return replace(load, sense=Fixed(move.angle(load.sense.angle)))
        if isinstance(load, Couple) and load.sense is None and isinstance(load.size, float | int):
            return replace(load, size=move.sense * load.size)
        return load

    return replace(dynamics, loads=tuple(moved(load) for load in dynamics.loads))


def after(before: Statics, move: Move, dynamics: Dynamics) -> Statics:
    solution = before.solution
    places = {name: complex(motion.place[0]) for name, motion in solution.points.items()}
    problem = replace(move.problem(solution.problem, near=places), dynamics=dynamics)
    crank = problem.drive.is_crank
    asked = [move.angle(float(p)) if crank else move.size * float(p) for p in solution.positions]
    return Statics(Solution(problem, positions=asked))


ACROSS = Move(degrees=180, mirrors=True)
"""The mirror that leaves gravity unchanged: left and right are exchanged."""

SOME = SEEDS[::12]


@each("seed", SOME)
@each("size", [1e-3, 1e3])
def test_a_mechanism_of_another_size(seed: int, size: float) -> None:
    before, move = solved(seed), Move(size=size)
    compare(before, after(before, move, sized(dynamics_of(loaded(seed)), size)), move, size)


@each("seed", SOME)
def test_a_mirrored_mechanism(seed: int) -> None:
    before = solved(seed)
    compare(before, after(before, ACROSS, mirrored(dynamics_of(loaded(seed)), ACROSS)), ACROSS)


@pytest.mark.parametrize("name", WORKED[:2])
def test_the_worked_mechanisms_mirrored(name: str) -> None:
    before = worked(name)
    dynamics = mirrored(dynamics_of(before.solution.problem), ACROSS)
    compare(before, after(before, ACROSS, dynamics), ACROSS)


@each("seed", SOME)
def test_a_mechanism_turned_without_gravity(seed: int) -> None:
    problem = replace(loaded(seed), dynamics=replace(dynamics_of(loaded(seed)), gravity=0.0))
    before, move = Statics(Solution(problem)), Move(degrees=37.0, shift=0.3 - 0.2j)
    compare(before, after(before, move, mirrored(dynamics_of(problem), move)), move)


def against_nothing(dynamics: Dynamics) -> Dynamics:
    loads = [load for load in dynamics.loads if load.sense is None or isinstance(load.sense, Fixed)]
    return replace(dynamics, loads=tuple(loads))


@each("seed", SOME)
def test_the_driver_reversed(seed: int) -> None:
    """Accelerations stay, so do the forces, but for resistances."""
    problem = replace(loaded(seed), dynamics=against_nothing(dynamics_of(loaded(seed))))
    backwards = replace(problem, drive=replace(problem.drive, rate=-problem.drive.rate))
    compare(Statics(Solution(problem)), Statics(Solution(backwards)), Move())


def with_loads(problem: Problem, dynamics: Dynamics | None) -> Statics:
    return Statics(Solution(replace(problem, dynamics=dynamics)))


@each("seed", SOME)
def test_forces_of_masses_and_loads_add_up(seed: int) -> None:
    problem, dynamics = loaded(seed), dynamics_of(loaded(seed))
    whole = solved(seed)
    masses = with_loads(problem, replace(dynamics, loads=()))
    loads = with_loads(problem, replace(dynamics, masses={}))
    for r, one, two in zip(whole.reactions, masses.reactions, loads.reactions, strict=True):
        assert abs(one.force[0] + two.force[0] - r.force[0]) <= LIMIT * largest(seed)
        assert abs(one.moment[0] + two.moment[0] - r.moment[0]) <= LIMIT * largest(seed)
    total = masses.balance[0] + loads.balance[0]
    assert abs(total - whole.balance[0]) <= LIMIT * powers(seed) / abs(problem.drive.rate)


@each("seed", SOME)
def test_without_loads_there_are_no_reactions(seed: int) -> None:
    for dynamics in (None, Dynamics(9.81, {}, ())):
        statics = with_loads(loaded(seed), dynamics)
        for r in statics.reactions:
            assert (r.force == 0).all()
            assert (r.moment == 0).all()
        assert statics.balance[0] == 0
        assert statics.lever is not None
        assert statics.lever[0] == 0


@each("seed", SOME)
def test_a_driver_at_rest_is_balanced_all_the_same(seed: int) -> None:
    """Statics in the proper sense: weights and loads, no inertia, and no lever without speed."""
    problem = loaded(seed)
    problem = replace(
        problem,
        drive=replace(problem.drive, rate=0.0, acceleration=0.0),
        dynamics=against_nothing(dynamics_of(problem)),
    )
    statics = Statics(Solution(problem))
    assert statics.lever is None
    motion = newton(problem, problem.drive.positions[0], loaded_problem(seed)[1])
    loads = loads_of(problem, motion)
    answer = solve_all(problem, joints_of(statics), pose_of(motion), loads)
    big = max(answer.largest, *(abs(load.force) for load in loads))
    for r in statics.reactions:
        assert abs(r.force[0] - answer.joints[r.joint, r.on, r.by][0]) <= LIMIT * big
    assert abs(statics.balance[0] - answer.balance) <= LIMIT * big


# Energy ------------------------------------------------------------------------------------------

NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)


def kinetic_energy(solution: Solution) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    energy = np.zeros(len(solution.positions))
    for link, mass in dynamics_of(solution.problem).masses.items():
        energy += mass.inertia * solution.links[link].omega ** 2 / 2
        if mass.centre is not None:
            energy += mass.mass * np.abs(solution.points[mass.centre].velocity) ** 2 / 2
    return energy


def works(problem: Problem, start: float, end: float) -> dict[str, float]:
    """Work of the balancing moment, the weights and the other loads from phi to phi, J."""
    phi = (start + end) / 2 + (end - start) / 2 * NODES
    statics = Statics(Solution(problem, positions=phi.tolist()))
    solution = statics.solution
    time = np.radians(end - start) / problem.drive.rate / 2 * WEIGHTS
    found = defaultdict(float, balance=float(time @ (statics.balance * problem.drive.rate)))
    for load in applied(solution):
        if load.point is not None:
            power = (np.conj(load.force) * solution.points[load.point].velocity).real
        else:
            power = load.couple * solution.links[load.link].omega
        found[load.kind.value] += float(time @ power)
    return found


def theorem(problem: Problem, corners: Sequence[float]) -> None:
    """Assert the theorem of kinetic energy between corners, and over the whole turn they make."""
    energy = kinetic_energy(Solution(problem, positions=list(corners)))
    assert energy[-1] == pytest.approx(energy[0], rel=1e-9)
    total: dict[str, float] = defaultdict(float)
    for k, (start, end) in enumerate(pairwise(corners)):
        found = works(problem, start, end)
        size = sum(map(abs, found.values()))
        work = found["balance"] + found["weight"] + found["external"]
        assert abs(work - (energy[k + 1] - energy[k])) <= 1e-9 * size
        inertia = found["inertia"] + found["inertia couple"]
        assert abs(inertia + (energy[k + 1] - energy[k])) <= 1e-9 * size
        for kind, part in found.items():
            total[kind] += part
    assert total["external"] < 0
    assert abs(total["weight"]) <= 1e-9 * abs(total["external"])
    assert total["balance"] == pytest.approx(-total["external"], rel=1e-9)


def test_kinetic_energy_of_the_press_over_a_turn() -> None:
    """The driving moment gives back over a turn what the punch takes; its table has corners."""
    table = [158.918918918919 + 30.0 * k for k in range(4)]
    corners = [*table, *(table[-1] + 45.0 * k for k in range(1, 7))]
    assert corners[-1] == pytest.approx(table[0] + 360.0)
    theorem(problem_of("press/press"), corners)


def test_kinetic_energy_of_a_slotted_link_over_a_turn() -> None:
    """At a constant speed; a couple resists the crank, for the force on link 5 takes no work."""
    problem = problem_of("levers/task12")
    dynamics = dynamics_of(problem)
    brake = Couple("M", "1", -3.0)
    problem = replace(
        problem,
        drive=replace(problem.drive, acceleration=0.0),
        dynamics=replace(dynamics, loads=(*dynamics.loads, brake)),
    )
    theorem(problem, [245.0 + 30.0 * k for k in range(13)])
