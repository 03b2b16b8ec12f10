"""Plans of a mechanism that is turned, mirrored, scaled, shifted, or driven backwards."""

from __future__ import annotations

import random
from functools import cache

import numpy as np
import numpy.typing as npt
import pytest
from cases import each, sampled, some
from doors import (
    MOTION,
    AssemblyRelation,
    ModelProblem as Problem,
    Rule,
    Solution,
    problem_loads as loads,
    verify,
)
from moved import Move
from msgspec.structs import replace
from worked import SIX, problem_of

from benchmarks.generator import random_problem

AWAY = (0.0, 4.0, 133.0, -6.0)
"""Positions of the crank from the file's, degrees; all six mechanisms reach them."""

LIMIT = 1e-9


@cache
def solved(name: str) -> Solution:
    problem = problem_of(name)
    phi = problem.drive.positions[0]
    return Solution(problem, positions=[phi + away for away in AWAY])


def places(solution: Solution) -> dict[str, complex]:
    return {name: complex(motion.place[0]) for name, motion in solution.points.items()}


def close(got: npt.ArrayLike, wanted: npt.ArrayLike, largest: float, what: object) -> None:
    error = float(np.max(np.abs(np.asarray(got) - np.asarray(wanted))))
    assert error <= LIMIT * largest, (what, error, largest)


def compare(before: Solution, after: Solution, move: Move) -> None:
    """Assert that every result went with the motion."""
    k = move.size
    assert list(after.points) == list(before.points)
    v = k * max(float(np.max(np.abs(p.velocity))) for p in before.points.values())
    a = k * max(float(np.max(np.abs(p.acceleration))) for p in before.points.values())
    size = k * max(float(np.max(np.abs(p.place))) for p in before.points.values())
    a = max(a, v * v / size)
    for name, was in before.points.items():
        now = after.points[name]
        moved = [move.place(complex(z)) for z in was.place]
        close(now.place, moved, max(size, abs(move.shift)), name)
        close(now.velocity, [move.vector(complex(z)) for z in was.velocity], v, name)
        close(now.acceleration, [move.vector(complex(z)) for z in was.acceleration], a, name)
    omega = max(float(np.max(np.abs(link.omega))) for link in before.links.values())
    epsilon = max(float(np.max(np.abs(link.epsilon))) for link in before.links.values())
    epsilon = max(epsilon, omega**2)
    for name, link in before.links.items():
        new = after.links[name]
        close(new.omega, move.sense * link.omega, omega, name)
        close(new.epsilon, move.sense * link.epsilon, epsilon, name)
        turn = np.asarray([move.angle(float(phi)) for phi in link.phi_deg]) - new.phi_deg
        close(np.remainder(turn + 180.0, 360.0), 180.0, 360.0, name)
    assert len(after.relatives) == len(before.relatives)
    for r, s in zip(before.relatives, after.relatives, strict=True):
        assert (r.point, r.of, r.to) == (s.point, s.of, s.to)
        close(s.velocity, [move.vector(complex(z)) for z in r.velocity], v, r.point)
        close(s.coriolis, [move.vector(complex(z)) for z in r.coriolis], a, r.point)
        close(s.acceleration, [move.vector(complex(z)) for z in r.acceleration], a, r.point)


MOVES = {
    "turned by 37": Move(degrees=37),
    "turned by 90": Move(degrees=90),
    "turned by 180": Move(degrees=180),
    "turned by -143": Move(degrees=-143),
    "mirrored in the x axis": Move(mirrors=True),
    "mirrored in the y axis": Move(degrees=180, mirrors=True),
    "mirrored in a line at 37": Move(degrees=74, mirrors=True),
    "a thousandth": Move(size=1e-3),
    "a thousand": Move(size=1e3),
    "shifted": Move(shift=3.1 - 7.7j),
    "all together": Move(degrees=37, size=1e3, mirrors=True, shift=120 + 45j),
}


@each("move", MOVES.values())
@pytest.mark.parametrize("name", SIX)
def test_results_go_with_the_mechanism(name: str, move: Move) -> None:
    before = solved(name)
    problem = move.problem(before.problem, near=places(before))
    positions = [move.angle(float(phi)) for phi in before.positions]
    after = Solution(problem, positions=positions)
    verify(after)
    compare(before, after, move)


@pytest.mark.parametrize("name", SIX)
def test_rules_in_words_hold_in_a_mirror(name: str) -> None:
    """In the x axis only above and below and the sides of a line are exchanged."""
    before = solved(name)
    above = {
        AssemblyRelation.ABOVE: AssemblyRelation.BELOW,
        AssemblyRelation.BELOW: AssemblyRelation.ABOVE,
    }
    move = Move(mirrors=True)
    problem = move.problem(before.problem)
    rules = tuple(replace(r, relation=above.get(r.relation, r.relation)) for r in problem.assembly)
    after = Solution(
        replace(problem, assembly=rules), positions=[-float(phi) for phi in before.positions]
    )
    compare(before, after, move)


@pytest.mark.parametrize("size", [1e-3, 1e3])
@pytest.mark.parametrize("name", SIX)
def test_the_drawing_of_a_scaled_mechanism_is_the_same(name: str, size: float) -> None:
    """The scales chosen for a plan, or given with it, go with its size: the paper is the same."""
    before = Solution(problem_of(name))
    after = Solution(Move(size=size).problem(before.problem))
    for kind in MOTION:
        assert after.scales[kind].per_mm == pytest.approx(before.scales[kind].per_mm * size)
        pairs = zip(before.segments(kind), after.segments(kind), strict=True)
        for was, now in pairs:
            assert was.name == now.name
            close(now.exact, was.exact, 200.0, was.name)


def driven(problem: Problem, times: float) -> Problem:
    """Time runs ``times`` as fast; backwards when negative."""
    drive = problem.drive
    return replace(
        problem,
        drive=replace(drive, rate=times * drive.rate, acceleration=times**2 * drive.acceleration),
    )


@pytest.mark.parametrize("times", [-1.0, 3.0, -0.001])
@pytest.mark.parametrize("name", SIX)
def test_the_driver_reversed_or_at_another_speed(name: str, times: float) -> None:
    """Velocities go with the rate, accelerations with its square; places stay, bit for bit."""
    before = solved(name)
    after = Solution(driven(before.problem, times), positions=before.positions.tolist())
    for point, was in before.points.items():
        now = after.points[point]
        assert (now.place == was.place).all()
        v = max(float(np.max(np.abs(p.velocity))) for p in before.points.values())
        a = max(float(np.max(np.abs(p.acceleration))) for p in before.points.values())
        close(now.velocity, times * was.velocity, abs(times) * v, point)
        close(now.acceleration, times**2 * was.acceleration, times**2 * a, point)
    for link, turning in before.links.items():
        omega = max(float(np.max(np.abs(it.omega))) for it in before.links.values())
        epsilon = max(float(np.max(np.abs(it.epsilon))) for it in before.links.values())
        epsilon = max(epsilon, omega**2)
        close(after.links[link].omega, times * turning.omega, abs(times) * omega, link)
        close(after.links[link].epsilon, times**2 * turning.epsilon, times**2 * epsilon, link)
    for r, s in zip(before.relatives, after.relatives, strict=True):
        close(s.velocity, times * r.velocity, abs(times) * v, r.point)
        close(s.coriolis, times**2 * r.coriolis, times**2 * a, r.point)
        close(s.acceleration, times**2 * r.acceleration, times**2 * a, r.point)


@pytest.mark.parametrize("name", SIX)
def test_a_driver_at_rest_gives_zero_velocities(name: str) -> None:
    """Velocities are zero; accelerations are the velocities of a driver with this speed."""
    problem = problem_of(name)
    still = Solution(replace(problem, drive=replace(problem.drive, rate=0.0, acceleration=-4.0)))
    going = Solution(replace(problem, drive=replace(problem.drive, rate=-4.0, acceleration=0.0)))
    for point, motion in still.points.items():
        assert (motion.velocity == 0).all()
        v = going.points[point].velocity
        close(motion.acceleration, v, max(float(np.max(np.abs(v))), 1e-3), point)
    for link, turning in still.links.items():
        assert (turning.omega == 0).all()
        close(turning.epsilon, going.links[link].omega, 10.0, link)


@each("seed", sampled(range(some(60, few=30)), 3))
def test_random_mechanisms_go_with_a_random_motion(seed: int) -> None:
    rng = random.Random(f"motion {seed}")
    problem = loads(random_problem(seed)[0], name=f"random-{seed}")
    before = Solution(problem)
    move = Move(
        degrees=rng.uniform(-180, 180),
        size=10 ** rng.uniform(-3, 3),
        mirrors=rng.random() < 0.5,
        shift=complex(rng.uniform(-5, 5), rng.uniform(-5, 5)),
    )
    after = Solution(move.problem(problem, near=places(before)))
    compare(before, after, move)


def test_the_helper_moves_rules() -> None:
    """A rule near a place moves with the place; a mirror exchanges the sides of a line."""
    move = Move(degrees=90, mirrors=True, shift=1 + 0j)
    problem = replace(
        problem_of("linkages/ex1"),
        assembly=(
            Rule("C", AssemblyRelation.NEAR, (), 2 + 3j),
            Rule("C", AssemblyRelation.LEFT_OF, ("A", "B")),
        ),
    )
    near, side = move.problem(problem).assembly
    assert near.at == 1j * (2 - 3j) + 1
    assert side.relation is AssemblyRelation.RIGHT_OF
