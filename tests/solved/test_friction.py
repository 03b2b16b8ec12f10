"""Friction: against all links and all friction at once by Newton's method, energy, wedges."""

from __future__ import annotations

import cmath
import math
from functools import cache

import numpy as np
import numpy.typing as npt
import pytest
from cases import each, sampled, some
from doors import (
    FRAME,
    Friction,
    FrictionTask,
    ModelProblem as Problem,
    PairFriction,
    ProblemError,
    Solution,
    cycle_efficiency,
    friction_of,
    problem_loads as loads,
)
from full_system import Acting, Joint, cross, loads_of, pose_of, slide_between
from loaded import loaded_problem
from msgspec.structs import replace
from newton import Motion, solve as newton
from two_driven import two_driven
from worked import problem_of

Values = npt.NDArray[np.float64]


def rubbed(problem: Problem, task: FrictionTask) -> Problem:
    assert problem.dynamics is not None
    return replace(problem, dynamics=replace(problem.dynamics, friction=task))


TASK = FrictionTask(f=0.1, f_pin=0.12, radius=0.01)


class Referee:
    """Equilibrium of all links with friction, from Newton's motion, without plans.

    The unknowns are two forces of a hinge, the force across a guide and a moment about its pin, and
    what drives. Friction follows from them and is on both links of its pair.
    """

    def __init__(self, problem: Problem, joints: list[Joint], motion: Motion) -> None:
        self.problem, self.joints, self.motion, self.pose = problem, joints, motion, pose_of(motion)
        dynamics = problem.dynamics
        assert dynamics is not None and dynamics.friction is not None
        self.task = dynamics.friction
        self.row = {link: 3 * i for i, link in enumerate(problem.mechanism.links)}
        self.given = self._sum(loads_of(problem, motion))

    def _sum(self, acting: list[Acting]) -> Values:
        found = np.zeros(3 * len(self.row))
        for one in acting:
            if one.link != FRAME:
                moment = cross(one.at, one.force) + one.couple
                k = self.row[one.link]
                found[k : k + 3] += (one.force.real, one.force.imag, moment)
        return found

    def _rate(self, link: str) -> float:
        return 0.0 if link == FRAME else self.motion.omega[link]

    def _speed(self, link: str, at: complex) -> complex:
        if link == FRAME:
            return 0j
        point = next(iter(self.problem.bodies[link].points))
        arm = at - self.motion.position[link, point]
        return self.motion.velocity[link, point] + 1j * self.motion.omega[link] * arm

    def acting(self, x: Values) -> list[Acting]:
        """Everything that the unknowns do, friction with it."""
        found = []
        for k, (point, on, by) in enumerate(self.joints):
            slide, (one, two) = slide_between(self.problem, (point, on, by)), x[2 * k : 2 * k + 2]
            if slide is None:
                at, force, couple = self.pose.place(on, point), complex(one, two), 0.0
                rate = self._rate(on) - self._rate(by)
                couple = -np.sign(rate) * self.task.f_pin * self.task.radius * abs(force)
            else:
                u = self.pose.along(slide)
                at = self.pose.place(slide.slider, slide.pin)
                sliding = (u.conjugate() * (self._speed(on, at) - self._speed(by, at))).real
                pressed = abs(one)
                if slide.length is not None:
                    pressed = max(pressed, 2.0 * abs(two) / slide.length)
                rub = -np.sign(sliding) * self.task.f * pressed
                force = 1j * u * one + rub * u
                # Friction is on the line of the guide, the moment about the pin is of the rest.
                couple = two + cross(1j * u * -slide.offset, rub * u)
            found += [Acting(on, force, at, couple), Acting(by, -force, at, -couple)]
        drives = self.problem.drive.every
        for drive, value in zip(drives, x[-len(drives) :], strict=True):
            if drive.pivot is not None:
                found.append(Acting(drive.link, 0j, 0j, float(value)))
                continue
            slide = self.problem.slides[drive.link]
            at = self.pose.place(slide.slider, slide.pin)
            found.append(Acting(drive.link, value * self.pose.along(slide), at, 0.0))
        return found

    def residual(self, x: Values) -> Values:
        return self.given + self._sum(self.acting(x))

    def solve(self, start: Values) -> Values:
        x, size = start.astype(float), float(np.max(np.abs(self.given))) + 1.0
        for _ in range(100):
            off = self.residual(x)
            if np.max(np.abs(off)) < 1e-12 * size:
                return x
            steps = 1e-6 * (np.abs(x) + 1e-3 * size)
            columns = [
                (self.residual(x + h * e) - self.residual(x - h * e)) / (2 * h)
                for h, e in zip(steps, np.eye(len(x)), strict=True)
            ]
            x = x - np.linalg.solve(np.array(columns).T, off)
        return x


def pose_for(solution: Solution) -> dict[str, tuple[float, float, float]]:
    """Pose to start Newton's method from."""
    found = {}
    for link, motion in solution.links.items():
        body = solution.problem.bodies[link].points
        point, local = next(iter(body.items()))
        turned = math.radians(float(motion.phi_deg[0]))
        origin = complex(solution.points[point].place[0]) - local * cmath.rect(1.0, turned)
        found[link] = (origin.real, origin.imag, turned)
    return found


def compared(problem: Problem, motion: Motion, found: Friction) -> float:
    """Return how far converged forces are from the referee's, over the largest."""
    joints = [(r.joint, r.on, r.by) for r in found.statics.reactions]
    referee = Referee(problem, joints, motion)
    x: list[float] = []
    forces = zip(found.converged.reactions, found.converged.moments, strict=True)
    for joint, (reaction, moment) in zip(joints, forces, strict=True):
        slide, force = slide_between(problem, joint), complex(reaction[0])
        if slide is None:
            x += [force.real, force.imag]
            continue
        across = 1j * complex(referee.pose.along(slide))
        # The plans have the moment of a bar in a block about the block, the referee about the pin.
        shift = referee.pose.place(slide.slider, slide.pin) - complex(
            found.statics.reactions[joints.index(joint)].at[0]
        )
        x += [(force / across).real, float(moment[0]) - cross(shift, force)]
    balances = (found.converged.balance, *found.converged.other_balances.values())
    start = np.array([*x, *(float(one[0]) for one in balances)])
    solved, k = referee.solve(np.zeros(len(start))), len(x)
    off = np.abs(solved[:k] - start[:k])
    big = float(np.max(np.abs(solved[:k])))
    drives = np.abs(solved[k:] - start[k:]) / np.maximum(np.abs(solved[k:]), 1e-3 * big)
    return max(float(np.max(off)) / big, float(np.max(drives)))


@pytest.mark.parametrize(
    "name", ["levers/crosshead", "levers/six-link", "levers/task12", "press/press"]
)
@pytest.mark.parametrize("away", [0.0, 4.0, -6.0])
def test_worked_mechanisms_against_all_links_at_once(name: str, away: float) -> None:
    problem = rubbed(problem_of(name), TASK)
    dynamics = problem.dynamics
    assert dynamics is not None
    if name == "press/press":  # its load is a table
        problem = replace(problem, dynamics=replace(dynamics, loads=()))
    asked = problem.drive.positions[0] + away
    solution = Solution(problem, positions=[asked])
    found = friction_of(solution)
    assert not found.jammed.any()
    motion = newton(problem, asked, pose_for(solution))
    assert compared(problem, motion, found) < 1e-9


@cache
def random_friction(seed: int) -> tuple[Problem, Motion, Friction]:
    problem, pose = loaded_problem(seed)
    problem = rubbed(problem, TASK)
    motion = newton(problem, problem.drive.positions[0], pose)
    return problem, motion, friction_of(Solution(problem))


SEEDS = range(some(200, few=40))


def test_random_mechanisms_against_all_links_at_once() -> None:
    taken = 0
    for seed in (seeds := sampled(SEEDS, 2)):
        problem, motion, found = random_friction(seed)
        if found.jammed[0]:
            continue
        taken += 1
        assert compared(problem, motion, found) < 1e-7, seed
    assert taken > 0.8 * len(seeds)


@each("seed", sampled(SEEDS, 3))
def test_the_driver_supplies_the_friction_losses(seed: int) -> None:
    _, _, found = random_friction(seed)
    for forces in (found.corrected, found.converged):
        lost = sum(
            size * abs(pair.rate) for pair, size in zip(found.pairs, forces.friction, strict=True)
        )
        off = forces.power - found.without.power - lost
        assert found.jammed[0] or abs(off[0]) <= 1e-9 * found.scale[0]
    assert np.isnan(found.efficiency[0]) or found.efficiency[0] <= 1 + 1e-12


TWO = range(63000, 63000 + some(200, few=40))


@cache
def friction_of_two(seed: int) -> tuple[Problem, Motion, Friction]:
    problem, motion = two_driven(seed)
    problem = rubbed(problem, TASK)
    return problem, motion, friction_of(Solution(problem))


def test_two_drivers_with_friction_against_all_links_at_once() -> None:
    taken = 0
    for seed in (seeds := sampled(TWO, 2)):
        problem, motion, found = friction_of_two(seed)
        if found.jammed[0]:
            continue
        taken += 1
        assert compared(problem, motion, found) < 1e-7, seed
    assert taken > 0.7 * len(seeds)


@each("seed", sampled(TWO, 3))
def test_two_drivers_together_supply_the_friction_losses(seed: int) -> None:
    problem, _, found = friction_of_two(seed)
    (other,) = problem.drive.other_drives
    for forces in (found.corrected, found.converged):
        lost = sum(
            size * abs(pair.rate) for pair, size in zip(found.pairs, forces.friction, strict=True)
        )
        given = forces.balance * problem.drive.rate + forces.other_balances[other.link] * other.rate
        assert found.jammed[0] or abs(given - forces.power)[0] <= 1e-9 * found.scale[0]
        assert found.jammed[0] or abs(given - found.without.power - lost)[0] <= (
            1e-9 * found.scale[0]
        )


WEDGE = """
[frame]
O = [0.0, 0.0]
guides.x-x = { through = [0.0, 0.0], angle = 0 }
guides.y-y = { through = [0.0, 0.0], angle = 90 }
[links.1]
points = ["A"]
slides = { on = "x-x" }
[links.2]
points = ["A", "B"]
AB = 1.0
[links.3]
points = ["B"]
slides = { on = "y-y" }
[driver]
link = "1"
s = %r
v = %r
a = 0
[assembly]
B = "near 0 1"
[dynamics]
gravity = false
[[loads]]
link = "3"
at = "B"
force = 100.0
angle = -90
[friction]
f = 0.2
"""


def wedge(beta: float, *, inwards: bool) -> Friction:
    """A rod at an angle over the x guide, degrees, pushed under a load on the y guide."""
    text = WEDGE % (math.cos(math.radians(beta)), -0.1 if inwards else 0.1)
    return friction_of(
        Solution(loads(text.replace('"near 0 1"', "{ near = [0.0, 1.0] }"), name="wedge"))
    )


PHI = math.degrees(math.atan(0.2))


@each("beta", [15.0, 30.0, 60.0, 85.0])
def test_the_force_of_a_wedge(beta: float) -> None:
    """H = P·ctg(β - φ) upwards, P·ctg(β + φ) down."""
    lift, fall = wedge(beta, inwards=True), wedge(beta, inwards=False)
    up, down = (100.0 / math.tan(math.radians(beta + way)) for way in (-PHI, PHI))
    assert lift.converged.balance[0] == pytest.approx(-up, rel=1e-12)
    assert fall.converged.balance[0] == pytest.approx(-down, rel=1e-9, abs=1e-9)
    ideal = 100.0 / math.tan(math.radians(beta))
    assert lift.efficiency[0] == pytest.approx(ideal / up, rel=1e-12)
    assert fall.efficiency[0] == pytest.approx(down / ideal, rel=1e-9, abs=1e-9)
    assert lift.drives[0]
    assert not fall.drives[0]


def test_a_wedge_locks_itself() -> None:
    assert wedge(PHI - 0.5, inwards=True).jammed[0]
    assert not wedge(PHI + 0.5, inwards=True).locks[0]
    assert wedge(90.0 - PHI + 0.5, inwards=False).locks[0]
    assert not wedge(90.0 - PHI - 0.5, inwards=False).locks[0]
    assert wedge(PHI - 0.5, inwards=True).efficiency[0] == 0.0


def test_without_friction_results_are_unchanged() -> None:
    problem = rubbed(problem_of("levers/task12"), FrictionTask())
    found = friction_of(Solution(problem))
    assert not found.pairs
    assert found.converged.balance == found.statics.balance
    assert found.efficiency[0] == 1.0


def test_a_pair_may_have_friction_of_its_own() -> None:
    alone = rubbed(problem_of("levers/task12"), FrictionTask(pairs={"E 5-0": PairFriction(f=0.1)}))
    found = friction_of(Solution(alone, positions=[75.0]))
    assert [(pair.name, pair.f) for pair in found.pairs] == [("E 5-0", 0.1)]
    lost = 0.1 * abs(found.converged.reactions[found.pairs[0].number]) * abs(found.pairs[0].rate)
    assert found.converged.power - found.without.power == pytest.approx(lost)


def test_friction_in_a_pair_that_does_not_exist_is_rejected() -> None:
    problem = rubbed(
        problem_of("levers/crosshead"), FrictionTask(pairs={"C 1-0": PairFriction(f=0.1)})
    )
    with pytest.raises(ProblemError, match=r"C 1-0"):
        friction_of(Solution(problem))


def test_the_plans_with_friction_are_the_numbers() -> None:
    found = friction_of(Solution(rubbed(problem_of("levers/task12"), TASK)))
    for drawn, once in zip(found.drawn.reactions, found.corrected.reactions, strict=True):
        assert np.abs(drawn.force - once).max() < 1e-9
    assert found.drawn.balance == pytest.approx(found.corrected.balance)


def test_efficiency_of_a_turn_is_that_of_many_positions() -> None:
    solution = Solution(rubbed(problem_of("press/press"), TASK))
    one, two = (cycle_efficiency(solution, count) for count in (360, 720))
    assert one is not None and two is not None and one.value is not None and two.value is not None
    assert 0 < one.value < 1
    assert one.value == pytest.approx(two.value, rel=1e-3)
