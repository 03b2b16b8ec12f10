"""Points of action of the guides' reactions: sums, signs, and all links at once as a check."""

from __future__ import annotations

import random
import re
from functools import cache

import numpy as np
import pytest
from cases import each, sampled, some
from doors import (
    ModelProblem as Problem,
    Solution,
    Statics,
    contact_distance as distance,
    edge_forces,
    problem_loads as loads,
    transverse_component,
)
from full_system import cross, loads_of, pose_of, slide_between, solve_all
from loaded import loaded_text
from newton import solve as newton
from worked import path_of

from benchmarks.generator import Pose, random_problem

SEEDS = range(some(120, few=40))
LIMIT = 1e-9
TIGHT = 1e-12
HERE = np.zeros(1, dtype=bool)


def one(value: complex) -> np.ndarray[tuple[int], np.dtype[np.complex128]]:
    return np.array([value], dtype=complex)


# Formulas ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("along", "force", "normal"),
    [(1, 7j, 7), (1, -7j, -7), (-1, 7j, -7), (1j, -7, 7), (1j, 7, -7), (0.6 + 0.8j, -4 + 3j, 5)],
)
def test_a_force_counts_to_the_left_of_the_guide(
    along: complex, force: complex, normal: float
) -> None:
    assert transverse_component(one(force), one(along))[0] == pytest.approx(normal, abs=1e-15)


@pytest.mark.parametrize(
    ("normal", "moment", "b"), [(5, 10, 2), (5, -10, -2), (-5, 10, -2), (-5, -10, 2), (5, 0, 0)]
)
def test_ahead_on_the_guide_a_force_to_the_left_turns_counter_clockwise(
    normal: float, moment: float, b: float
) -> None:
    found = distance(np.array([normal]), np.array([moment]), HERE)
    assert found[0] == b
    assert cross(b * (1 + 0j), normal * 1j) == moment


def test_a_moment_without_a_force_acts_nowhere() -> None:
    found = distance(np.array([0.0, 1e-14, 2.0]), np.ones(3), np.array([True, True, False]))
    assert np.isnan(found[:2]).all()
    assert found[2] == 0.5


@each("seed", range(50))
def test_forces_at_the_edges_have_the_sums_of_the_reaction(seed: int) -> None:
    rng = random.Random(seed)
    normal, moment = rng.uniform(-1e3, 1e3), rng.uniform(-50.0, 50.0)
    length = rng.uniform(1e-3, 1.0)
    first, second = edge_forces(np.array([normal]), np.array([moment]), length)
    size = abs(first[0]) + abs(second[0])
    assert abs(first[0] + second[0] - normal) <= TIGHT * size
    assert abs((first[0] - second[0]) * length / 2 - moment) <= TIGHT * size * length
    beyond = abs(moment) > abs(normal) * length / 2
    assert (first[0] * second[0] < 0) == beyond


def test_a_moment_alone_is_a_pair_of_forces() -> None:
    first, second = edge_forces(np.zeros(1), np.array([-6.0]), 0.2)
    assert (first[0], second[0]) == (-30.0, 30.0)


# Random mechanisms -------------------------------------------------------------------------------


@cache
def guided_problem(seed: int) -> tuple[Problem, Pose]:
    """Return a random loaded mechanism in which every slider has a length."""
    text, pose = random_problem(seed)
    size = max(0.1, *(max(abs(x), abs(y)) for x, y, _ in pose.values()))
    rng = random.Random(f"lengths {seed}")
    text = loaded_text(text, pose, random.Random(f"loads {seed}"))

    def longer(match: re.Match[str]) -> str:
        return f"{match[1]}, length = {size * rng.uniform(0.01, 2.0)!r} }}"

    return loads(re.sub(r"(slides = \{[^}\n]*?) \}", longer, text), name=f"guided-{seed}"), pose


@each("seed", sampled(SEEDS, 3))
def test_reactions_act_where_all_links_at_once_have_them(seed: int) -> None:
    problem, pose = guided_problem(seed)
    statics = Statics(Solution(problem))
    motion = newton(problem, problem.drive.positions[0], pose)
    given = loads_of(problem, motion)
    joints = [(r.joint, r.on, r.by) for r in statics.reactions]
    answer = solve_all(problem, joints, pose_of(motion), given)
    limit = LIMIT * max(answer.largest, *(float(abs(load.force)) for load in given))
    slides = {k for k, joint in enumerate(joints) if slide_between(problem, joint) is not None}
    assert set(statics.contacts) == slides
    for number, contact in statics.contacts.items():
        joint = joints[number]
        force, moment = answer.joints[joint]
        slide = contact.slide
        pin = motion.position[slide.slider, slide.pin]
        along = pose_of(motion).along(slide)
        b = float(contact.b()[0])
        if np.isnan(b):
            assert abs(force) <= limit
        else:
            place = complex(contact.place(contact.b())[0])
            assert abs(cross(place - pin, force) - moment) <= limit * max(1.0, abs(place - pin))
            arm = (place - contact.joint.at[0]) * along.conjugate()
            assert arm.real == pytest.approx(b, rel=LIMIT, abs=LIMIT)
        middle = pin
        if problem.is_block(slide):
            middle = motion.position[slide.host, next(iter(problem.bodies[slide.host].points))]
        assert slide.length is not None
        turning = moment + cross(pin - middle, force)
        reach = abs(force) * slide.length / 2
        edges = contact.edges(0)
        if abs(abs(turning) - reach) > limit:
            assert bool(edges) == (abs(turning) > reach)
        if edges:
            assert abs(sum(edge.force for edge in edges) - force) <= limit
            sums = sum(cross(edge.at - pin, edge.force) for edge in edges)
            assert abs(sums - moment) <= limit
            assert (edges[0].at - edges[1].at) / along == pytest.approx(slide.length, rel=LIMIT)
            half = (edges[0].at + edges[1].at) / 2 - middle
            assert abs((half * along.conjugate()).real) <= LIMIT
            assert (edges[0].force.conjugate() * edges[1].force).real < 0


def test_both_cases_and_all_pairs_occur() -> None:
    edges, within, blocks, offsets = 0, 0, 0, 0
    for seed in SEEDS:
        problem, _ = guided_problem(seed)
        for contact in Statics(Solution(problem)).contacts.values():
            edges += bool(contact.edges(0))
            within += not contact.edges(0)
            blocks += problem.is_block(contact.slide)
            offsets += contact.slide.offset != 0
    assert min(edges, within) >= some(20, few=10)
    assert min(offsets, blocks) >= some(5, few=2)


# Worked problems ---------------------------------------------------------------------------------


def test_the_crosshead_bears_within_and_then_at_its_edges() -> None:
    """The force of 1000 N acts 12 mm above the axis; the slider is 80 mm long."""
    problem = loads(path_of("levers/crosshead").read_text("utf-8"), name="crosshead")
    statics = Statics(Solution(problem, positions=[90.0, 150.0]))
    ((number, contact),) = statics.contacts.items()
    normal = statics.reactions[number].force.imag
    assert contact.b() == pytest.approx(-12.0 / normal, rel=TIGHT)
    assert contact.at_edges.tolist() == [False, True]
    ahead, behind = contact.edges(1)
    assert ahead.force.imag == pytest.approx(normal[1] / 2 - 12.0 / 0.08, rel=TIGHT)
    assert behind.force.imag == pytest.approx(normal[1] / 2 + 12.0 / 0.08, rel=TIGHT)
    pin = statics.solution.points["C"].place[1]
    assert ahead.at - pin == pytest.approx(0.04, abs=TIGHT)
    assert behind.at - pin == pytest.approx(-0.04, abs=TIGHT)


def test_a_guide_without_a_force_bears_at_both_edges() -> None:
    """All forces of the group are vertical, so the vertical guide has a moment alone."""
    text = path_of("levers/task12").read_text("utf-8")
    text = text.replace('{ on = "y-y" }', '{ on = "y-y", length = 0.3 }')
    statics = Statics(Solution(loads(text, name="task12")))
    (contact,) = (one for one in statics.contacts.values() if one.length is not None)
    assert np.isnan(contact.b()[0])
    moment = contact.joint.moment[0]
    ahead, behind = contact.edges(0)
    assert ahead.at - behind.at == pytest.approx(0.3j, rel=TIGHT)
    assert ahead.force == pytest.approx(-moment / 0.3, rel=TIGHT)  # upwards, left is -x
    assert behind.force == -ahead.force
