from __future__ import annotations

from collections import Counter
from functools import cache

import numpy as np
import pytest
from cases import each, some
from doors import (
    FRAME,
    AssemblyRelation,
    ModelProblem as Problem,
    Revolute,
    analyse,
    problem_loads as loads,
)
from newton import NotClosedError, differentiate, residual, solve

from benchmarks.generator import random_problem

SEEDS = range(some(200, few=100))

Pose = dict[str, tuple[float, float, float]]


@cache
def made(seed: int) -> tuple[Problem, Pose]:
    text, pose = random_problem(seed)
    return loads(text, name=f"random-{seed}"), pose


@each("seed", SEEDS)
def test_the_file_closes_at_the_drawn_pose(seed: int) -> None:
    problem, pose = made(seed)
    (position,) = problem.drive.positions
    assert residual(problem, position, pose) < 1e-12
    found = solve(problem, position, pose)
    assert found.closing < 1e-12
    for link, wanted in pose.items():
        assert found.pose[link] == pytest.approx(wanted, abs=1e-10)


@each("seed", SEEDS)
def test_the_referee_agrees_with_differences_of_its_positions(seed: int) -> None:
    problem, pose = made(seed)
    (position,) = problem.drive.positions
    found = solve(problem, position, pose)
    velocity, acceleration = differentiate(problem, position, pose)
    v_size = max(abs(v) for v in found.velocity.values())
    a_size = max([v_size**2, *(abs(a) for a in found.acceleration.values())])
    for place in velocity:
        assert abs(velocity[place] - found.velocity[place]) < 3e-6 * v_size
        assert abs(acceleration[place] - found.acceleration[place]) < 3e-6 * a_size


def test_the_same_seed_gives_the_same_mechanism() -> None:
    assert random_problem(5) == random_problem(5)
    assert random_problem(5) != random_problem(6)


def test_everything_occurs_several_times() -> None:
    seen: Counter[str] = Counter()
    for seed in SEEDS:
        problem, _ = made(seed)
        structure = analyse(problem.mechanism)
        seen["crank" if problem.drive.is_crank else "driving slider"] += 1
        seen["hinge of three links"] += any(
            len(joint.links) > 2 for joint in problem.mechanism.revolutes
        )
        for rule in problem.assembly:
            seen[rule.relation.value] += 1
        for slide in problem.slides.values():
            seen["offset"] += slide.offset != 0
            seen["along two points"] += slide.towards is not None
        for group in structure.groups:
            seen[group.signature] += 1
            for joint in (*(lead.joint for lead in group.legs), *group.inner):
                if isinstance(joint, Revolute):
                    continue
                slide = problem.slides[joint.slider]
                outer = slide.slider not in group.links or slide.host not in group.links
                if not outer:
                    seen["inner, first slides"] += slide.slider == group.links[0]
                    seen["inner, last slides"] += slide.slider == group.links[1]
                elif slide.slider not in group.links:
                    seen["outer, the known link slides"] += 1
                else:
                    seen["outer, the group's link slides"] += 1
                    seen["guide on a moving link"] += slide.host != FRAME
                    seen["guide on the frame"] += slide.host == FRAME
    wanted = ["RRR", "RRP", "RPR", "PRP", "RPP", "crank", "driving slider", "hinge of three links"]
    wanted += ["inner, first slides", "inner, last slides", "offset", "along two points"]
    wanted += ["outer, the known link slides", "outer, the group's link slides"]
    wanted += [
        "guide on a moving link",
        "guide on the frame",
        *(where.value for where in AssemblyRelation),
    ]
    # No random dyad is a parallelogram by chance, or needs a rule of its side on its own bar.
    for side in (AssemblyRelation.PARALLEL, AssemblyRelation.TOWARDS, AssemblyRelation.AWAY):
        wanted.remove(side.value)
    assert {name: seen[name] for name in wanted if seen[name] < some(10, few=4)} == {}


def test_a_turning_guide_has_the_transport_acceleration_of_its_coincident_point() -> None:
    text = """
        title = "Кулиса"
        [frame]
        A = [0.0, 0.0]
        C = [0.0, -0.11]
        [links.1]
        points = ["A", "B"]
        AB = 0.064
        [links.2]
        points = ["B"]
        slides = { on = "3", along = "CD" }
        [links.3]
        points = ["C", "D"]
        CD = 0.22
        [driver]
        link = "1"
        phi = 20
        omega = 50
    """
    problem = loads(text, name="slotted")
    found = solve(problem, 20.0, {"1": (0, 0, 0.3), "2": (0.06, 0.02, 1.1), "3": (0, -0.11, 1.1)})
    omega, epsilon = found.omega["3"], found.epsilon["3"]
    arm = found.position["2", "B"] + 0.11j
    u = arm / abs(arm)
    relative = found.velocity["2", "B"] - found.velocity["3", "B"]
    assert found.velocity["3", "B"] == pytest.approx(1j * omega * arm)
    assert found.acceleration["3", "B"] == pytest.approx((1j * epsilon - omega**2) * arm)
    assert (relative / u).imag == pytest.approx(0, abs=1e-12)
    rest = found.acceleration["2", "B"] - found.acceleration["3", "B"] - 2j * omega * relative
    assert (rest / u).imag == pytest.approx(0, abs=1e-9)
    assert found.acceleration["1", "B"] == pytest.approx(-2500 * found.position["1", "B"])


def test_a_pose_that_cannot_be_assembled_is_rejected() -> None:
    text = """
        title = "Четырёхзвенник"
        [frame]
        A = [0.0, 0.0]
        D = [1.0, 0.0]
        [links.1]
        points = ["A", "B"]
        AB = 0.2
        [links.2]
        points = ["B", "C"]
        BC = 0.1
        [links.3]
        points = ["D", "C"]
        DC = 0.1
        [driver]
        link = "1"
        phi = 0
        omega = 1
    """
    problem = loads(text, name="short")
    with pytest.raises(NotClosedError):
        solve(problem, 0.0, dict.fromkeys("123", (0.1, 0.2, float(np.pi / 5))))
