"""Random mechanisms: plans against Newton's method and against differences."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import numpy.typing as npt
from cases import each, sampled, some
from doors import (
    FRAME,
    Float64,
    IntersectCircles,
    IntersectLineCircle,
    IntersectLines,
    ModelProblem as Problem,
    PlanKind,
    PointName,
    Solution,
    Touch,
    VectorKind,
    problem_loads as loads,
    verify,
)
from newton import Motion, Pose, solve as newton

from benchmarks.generator import random_problem

SEEDS = range(some(200, few=25))
UNIT_SCALES = {"mu_l": 1.0, "mu_v": 1.0, "mu_a": 1.0}


@cache
def made(seed: int) -> tuple[Problem, Pose]:
    text, pose = random_problem(seed)
    return loads(text, name=f"random-{seed}"), pose


@cache
def solved(seed: int) -> Solution:
    return Solution(made(seed)[0])


@cache
def refereed(seed: int) -> Motion:
    problem, pose = made(seed)
    return newton(problem, problem.drive.positions[0], pose)


def largest(seed: int) -> tuple[float, float, float, float]:
    """Largest velocity, acceleration, omega and epsilon of a mechanism of about a metre."""
    ref = refereed(seed)
    v = max(abs(value) for value in ref.velocity.values())
    omega = max(abs(value) for value in ref.omega.values())
    a = max([v * v, *(abs(value) for value in ref.acceleration.values())])
    epsilon = max([omega**2, *(abs(value) for value in ref.epsilon.values())])
    return v, a, max(omega, v), max(epsilon, a)


# Against Newton's method -------------------------------------------------------------------------


@each("seed", sampled(SEEDS, 3))
def test_all_points_agree_with_newtons_method(seed: int) -> None:
    solution, ref = solved(seed), refereed(seed)
    verify(solution)
    kin = solution.construction.kinematics
    v_size, a_size, _, _ = largest(seed)
    compared = set()
    for (link, place), where in ref.position.items():
        at = kin.velocity.point.get((link, place))
        if at is None:
            # Under a pin only, and no equation speaks of it.
            assert place not in solution.problem.bodies[link].points
            continue
        compared.add((link, place))
        accelerated = kin.acceleration.point[link, place]
        assert abs(solution.place(PointName(place))[0] - where) <= 1e-9
        v = solution.si.point(at)[0] - ref.velocity[link, place]
        a = solution.si.point(accelerated)[0] - ref.acceleration[link, place]
        assert abs(v) <= 1e-9 * v_size, (link, place)
        assert abs(a) <= 1e-9 * a_size, (link, place)
    bodies = solution.problem.bodies
    assert {(link, p) for link in bodies if link != FRAME for p in bodies[link].points} <= compared


@each("seed", sampled(SEEDS, 3))
def test_all_links_agree_with_newtons_method(seed: int) -> None:
    solution, ref = solved(seed), refereed(seed)
    _, _, omega_size, epsilon_size = largest(seed)
    for link, motion in solution.links.items():
        turned = math.radians(motion.phi_deg[0]) - ref.pose[link][2]
        assert abs(math.remainder(turned, math.tau)) <= 1e-9
        assert abs(motion.omega[0] - ref.omega[link]) <= 1e-9 * omega_size
        assert abs(motion.epsilon[0] - ref.epsilon[link]) <= 1e-9 * epsilon_size


@each("seed", sampled(SEEDS, 3))
def test_sliding_agrees_with_newtons_method(seed: int) -> None:
    """Relative velocity along the line; acceleration split into Coriolis' and the relative one."""
    solution, ref = solved(seed), refereed(seed)
    v_size, a_size, _, _ = largest(seed)
    slides = solution.problem.slides
    for r in solution.relatives:
        slide = slides.get(r.of) if r.of in slides and slides[r.of].host == r.to else slides[r.to]
        assert slide is not None
        assert {slide.slider, slide.host} == {r.of, r.to}
        host_angle = 0.0 if slide.host == FRAME else ref.pose[slide.host][2]
        u = np.exp(1j * (host_angle + math.radians(slide.angle)))
        omega = ref.omega.get(r.to, 0.0)
        assert abs((r.velocity[0] * u.conjugate()).imag) <= 1e-9 * v_size
        assert abs((r.acceleration[0] * u.conjugate()).imag) <= 1e-9 * a_size
        assert abs(r.coriolis[0] - 2j * omega * r.velocity[0]) <= 1e-9 * a_size
        pin = (slide.slider, slide.pin)
        under = (slide.host, slide.pin)
        if r.point == slide.pin and pin in ref.velocity and under in ref.velocity:
            sign = 1 if r.of == slide.slider else -1
            v = sign * (ref.velocity[pin] - ref.velocity[under])
            a = sign * (ref.acceleration[pin] - ref.acceleration[under])
            assert abs(r.velocity[0] - v) <= 1e-9 * v_size
            assert abs(r.coriolis[0] + r.acceleration[0] - a) <= 1e-9 * a_size


# Against differences of the plans' own positions --------------------------------------------------

STEP = 1e-3
"""Motion of the fastest link between two positions, radians or metres."""


def timed(seed: int, count: int) -> tuple[list[float], float]:
    """Positions of the driver at the times ``-count·h .. count·h``, and h."""
    drive = made(seed)[0].drive
    _, _, omega, epsilon = largest(seed)
    h = STEP / max(omega, math.sqrt(epsilon))
    result = []
    for k in range(-count, count + 1):
        moved = drive.rate * k * h + drive.acceleration * (k * h) ** 2 / 2
        away = math.degrees(moved) if drive.is_crank else moved
        result.append(drive.positions[0] + away)
    return result, h


def differences(
    rows: npt.NDArray[np.complex128] | npt.NDArray[np.float64], h: float
) -> tuple[complex, complex]:
    """First and second derivative in the middle, of the fourth order."""
    a, b, c, d, e = rows
    return (
        complex((8 * (d - b) - (e - a)) / (12 * h)),
        complex((16 * (d + b) - (e + a) - 30 * c) / (12 * h * h)),
    )


def errors_of_differences(seed: int) -> tuple[float, float]:
    """Differences between plans and first and second derivatives, in parts of the largest value."""
    problem, _ = made(seed)
    positions, h = timed(seed, 2)
    around = Solution(problem, positions=positions)
    v_size, a_size, omega_size, epsilon_size = largest(seed)
    first, second = [0.0], [0.0]
    for name, motion in around.points.items():
        link, place = around.construction.kinematics.velocity.named[name]
        if place not in problem.bodies[link].points:
            continue  # a coincident point changes on its link from position to position
        v, a = differences(motion.place, h)
        first.append(abs(v - motion.velocity[2]) / v_size)
        second.append(abs(a - motion.acceleration[2]) / a_size)
    for turning in around.links.values():
        phi = np.unwrap(np.radians(turning.phi_deg))
        omega, epsilon = differences(phi, h)
        first.append(abs(omega - turning.omega[2]) / omega_size)
        second.append(abs(epsilon - turning.epsilon[2]) / epsilon_size)
    return max(first), max(second)


@each("seed", sampled(SEEDS, 3))
def test_motion_is_the_derivative_of_the_positions(seed: int) -> None:
    """The limits allow for rounding over h and h², 1e-16/h² is 1e-10."""
    first, second = errors_of_differences(seed)
    assert first <= 1e-9
    assert second <= 1e-7


# Batches -----------------------------------------------------------------------------------------


@each("seed", SEEDS[::2])
def test_a_batch_is_the_positions_one_by_one(seed: int) -> None:
    problem, _ = made(seed)
    positions, _ = timed(seed, 3)
    batch = Solution(problem, positions=positions)
    for i, position in enumerate(positions):
        one = Solution(problem, positions=[position])
        for name, value in batch.si.value.items():
            alone = one.si.value[name]
            pairs = zip(value, alone, strict=True) if isinstance(value, tuple) else [(value, alone)]
            for many, single in pairs:
                assert np.ravel(np.broadcast_to(many, (7,)))[i] == np.ravel(single)[0], name


@each("seed", SEEDS[::5])
def test_scales_and_segments_of_a_position_do_not_depend_on_the_arithmetic(seed: int) -> None:
    """Paper and SI are one plan: a segment times its scale is the vector."""
    solution = solved(seed)
    for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION):
        plan, per_mm = solution.construction.plan(kind), solution.scales[kind].per_mm
        size = largest(seed)[0 if kind is PlanKind.VELOCITY else 1]
        for vector, segment in zip(plan.vectors, solution.segments(kind), strict=True):
            tail = solution.si.point(vector.tail)
            head = solution.si.point(vector.head)
            assert abs(abs(head - tail)[0] - segment.exact[0] * per_mm) <= 1e-12 * size


# Closing of the plans -----------------------------------------------------------------------------


def distance(solution: Solution, point: PointName, line: tuple[object, object]) -> float:
    """Largest distance of a point of the paper from a line, mm."""
    p, u = (np.asarray(end, dtype=complex) for end in line)
    gap = solution.paper.point(point) - p
    return float(np.max(np.abs((gap * np.conj(u)).imag / np.abs(u))))


@each("seed", sampled(SEEDS, 3))
def test_both_rays_end_in_the_point_where_they_meet(seed: int) -> None:
    solution = solved(seed)
    meetings = [s for s in solution.construction.program.steps if isinstance(s, IntersectLines)]
    for step in meetings:
        for line in (step.first, step.second):
            assert distance(solution, step.out, solution.paper.value[line]) < 1e-9, step.out


@each("seed", sampled(SEEDS, 3))
def test_vector_equations_close(seed: int) -> None:
    solution = solved(seed)

    def at(point: PointName) -> complex:
        return complex(solution.paper.point(point)[0])

    for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION):
        plan = solution.construction.plan(kind)
        assert plan.pole is not None
        assert plan.equations
        for equation in plan.equations:
            assert equation.left.tail == plan.pole
            total = sum(at(term.head) - at(term.tail) for term in equation.right)
            gap = total - (at(equation.left.head) - at(equation.left.tail))
            assert abs(gap) < 1e-9, equation.left.symbol


@each("seed", sampled(SEEDS, 3))
def test_components_have_their_directions(seed: int) -> None:
    """Normal along the link, tangential across it, as long as by Newton's omega and epsilon."""
    solution, ref = solved(seed), refereed(seed)
    kin = solution.construction.kinematics
    v_size, a_size, _, _ = largest(seed)

    def vector(tail: PointName, head: PointName) -> complex:
        si = solution.si
        return complex(si.point(head)[0] - si.point(tail)[0])

    for (kind, link), turning in kin.turnings.items():
        arm = vector(PointName(turning.joint), PointName(turning.place))
        unknown = vector(turning.start, turning.head)
        if kind is PlanKind.VELOCITY:
            assert abs(unknown - 1j * ref.omega[link] * arm) <= 1e-9 * v_size
        else:
            assert abs(unknown - 1j * ref.epsilon[link] * arm) <= 1e-9 * a_size
    plan = solution.construction.plan(PlanKind.ACCELERATION)
    arms = [
        (link, vector(PointName(t.joint), PointName(t.place)))
        for (kind, link), t in kin.turnings.items()
        if kind is PlanKind.ACCELERATION
    ]
    wanted = [-(ref.omega[link] ** 2) * arm for link, arm in arms]
    normals = [vector(v.tail, v.head) for v in plan.vectors if v.kind is VectorKind.NORMAL]
    for normal in wanted:
        if abs(normal) > 1e-9 * a_size:
            assert min(abs(normal - drawn) for drawn in normals) <= 1e-9 * a_size


@each("seed", sampled(SEEDS, 3))
def test_an_assembly_keeps_its_side_all_round(seed: int) -> None:
    """In a whole turn (or stroke) the group stays on its side in the file's position."""
    problem, _ = made(seed)
    first = problem.drive.positions[0]
    if problem.drive.is_crank:
        positions = [first, *(first + 5.0 * k for k in range(1, 72))]
    else:
        positions = [first, *(first + 0.05 * k for k in range(-40, 41))]
    around = Solution(problem, positions=positions)
    trace = around.read(Float64(), UNIT_SCALES)
    assert around.construction.program == solved(seed).construction.program
    for step in around.construction.program.steps:
        if isinstance(step, IntersectCircles):
            c1, c2 = trace.point(step.centre1), trace.point(step.centre2)
            side = ((c2 - c1).conj() * (trace.point(step.out) - c1)).imag
        elif isinstance(step, Touch):
            c1, c2 = trace.point(step.centre), trace.point(step.source)
            side = ((c2 - c1).conj() * (trace.point(step.out) - c1)).imag
        elif isinstance(step, IntersectLineCircle):
            _, u = trace.value[step.line]
            side = (np.conj(u) * (trace.point(step.out) - trace.point(step.centre))).real
        else:
            continue
        chosen = step.sense.value if isinstance(step, IntersectLineCircle) else step.side.value
        assert side[0] * chosen > 0
        there = np.isfinite(side)
        assert (side[there] * chosen > -1e-9).all(), step.out
