"""Two drivers of which outputs or loads determine positions and rates: against Newton's motion."""

from __future__ import annotations

import math
import random
from itertools import combinations

import pytest
from actuated import ends_of
from cases import each, sampled, some
from doors import (
    AssemblyError,
    Drive,
    ModelProblem as Problem,
    OutputPositionKind,
    OutputPositions,
    OutputRate,
    ProblemError,
    Solution,
    Statics,
    pose,
    problem_loads as loads,
    with_drives,
)
from full_system import Ends, check_reactions, loads_of, pose_of, solve_all
from msgspec.structs import replace
from newton import Motion
from texts import protocol
from two_driven import COUPLER_LOADS as LOADS, FIVE_BAR, two_driven

SEEDS = range(66000, 66000 + some(200, few=40))


def outputs_of(problem: Problem, motion: Motion) -> list[tuple[OutputPositions, OutputRate]]:
    """Return coordinates of moving points and angles of links, with their rates, as Newton has."""
    found = []
    for link in problem.mechanism.links:
        if link in problem.drive.links:
            continue
        for point in problem.bodies[link].points:
            at, speed, gain = (
                getattr(motion, part)[link, point]
                for part in ("position", "velocity", "acceleration")
            )
            for kind, axis in ((OutputPositionKind.X, "real"), (OutputPositionKind.Y, "imag")):
                values = [getattr(one, axis) for one in (at, speed, gain)]
                posed = OutputPositions(kind, point, (values[0],))
                found.append((posed, OutputRate(f"v{kind.value}_{point}", *values[1:])))
        if problem.bodies[link].axis is not None:
            posed = OutputPositions(
                OutputPositionKind.PHI, link, (math.degrees(motion.pose[link][2]),)
            )
            rates = motion.omega[link], motion.epsilon[link]
            found.append((posed, OutputRate(f"omega_{link}", *rates)))
    return found


def shares(problem: Problem, rate: OutputRate) -> list[float]:
    """Return the derivatives of an output by the coordinates of both drivers."""
    found = []
    drives = problem.drive.every
    for k in range(len(drives)):
        moved = [replace(one, rate=float(k == n), acceleration=0.0) for n, one in enumerate(drives)]
        solution = Solution(replace(with_drives(problem, moved), dynamics=None))
        if rate.kind == "omega":
            found.append(float(solution.links[rate.of].omega[0]))
        else:
            velocity = solution.points[rate.of].velocity[0]
            found.append(float(velocity.real if rate.kind == "vx" else velocity.imag))
    return found


def given_by_outputs(seed: int) -> tuple[Problem, Motion, int] | None:
    """Return a mechanism with two drivers whose outputs are given, and how many of them."""
    problem, motion = two_driven(seed)
    rng, count = random.Random(f"outputs {seed}"), 1 + seed % 2
    every = outputs_of(problem, motion)
    rng.shuffle(every)
    drives = problem.drive.every
    for chosen in combinations(every[:12], count):
        rows = [shares(problem, rate) for _, rate in chosen]
        if count == 1:
            rows.append([0.0, 1.0])
        (a, b), (c, d) = rows
        size = math.hypot(a, b) * math.hypot(c, d)
        if not size or abs(a * d - b * c) < 0.3 * size:
            continue
        given: list[Drive] = []
        for k, drive in enumerate(drives):
            if k < count:
                posed, rate = chosen[k]
                about = rng.uniform(-1.0, 1.0) if drive.is_crank else rng.uniform(-0.005, 0.005)
                posed = replace(posed, nearest_to=drive.positions[0] + about)
                drive = replace(drive, positions=(math.nan,), posed=posed, output_rate=rate)
            given.append(drive)
        return with_drives(problem, given), motion, count
    return None


def test_both_numbers_of_outputs_occur() -> None:
    counts = [found[2] for seed in SEEDS if (found := given_by_outputs(seed)) is not None]
    assert counts.count(1) >= 10
    assert counts.count(2) >= 10


@pytest.mark.dear
@each("seed", sampled(SEEDS, 8))
def test_positions_and_rates_are_those_of_newtons_motion(seed: int) -> None:
    found = given_by_outputs(seed)
    if found is None:
        return
    given, _, _ = found
    drives, known = pose(given).drive.every, two_driven(seed)[0].drive.every
    fastest = max(abs(one.rate) for one in known)
    most = max(fastest**2, *(abs(one.acceleration) for one in known))
    for one, other in zip(drives, known, strict=True):
        off = one.positions[0] - other.positions[0]
        assert abs(math.remainder(off, 360.0) if one.is_crank else off) <= 1e-9
        assert abs(one.rate - other.rate) <= 1e-9 * fastest
        assert abs(one.acceleration - other.acceleration) <= 1e-9 * most


def first_alone(problem: Problem) -> Solution:
    """Return the solution in which the first driver moves and the second stands."""
    one, two = (replace(drive, rate=0.0, acceleration=0.0) for drive in problem.drive.every)
    moved = with_drives(problem, [replace(one, rate=1.0), two])
    return Solution(replace(moved, dynamics=None))


def between_links(seed: int) -> tuple[Problem, Motion, tuple[str, str]] | None:
    """Return a mechanism with loads, a motor between two of its links, and a second driver."""
    problem, motion = two_driven(seed)
    alone, rates = first_alone(problem).links, motion.omega
    size = max(abs(float(one.omega[0])) for one in alone.values())
    pairs = [
        (one, two)
        for one, two in combinations(problem.mechanism.links, 2)
        if size and abs(float(alone[two].omega[0] - alone[one].omega[0])) > 0.1 * size
        and abs(rates[two] - rates[one]) > 0.1 * max(map(abs, rates.values()))
    ]  # fmt: skip
    if not pairs:
        return None
    links = random.Random(f"motor {seed}").choice(pairs)
    name = "_".join(links)
    posed = OutputPositions(OutputPositionKind.BETWEEN, name, (math.nan,))
    rate = OutputRate(f"omega_{name}", rates[links[1]] - rates[links[0]], 0.0)
    drive = replace(problem.drive, posed=posed, output_rate=rate)
    return replace(problem, drive=drive), motion, links


def between_points(seed: int) -> tuple[Problem, Motion, Ends] | None:
    """Return a mechanism with loads, an actuator between two points, and a second driver."""
    problem, motion = two_driven(seed)
    ends = ends_of(problem, motion, random.Random(f"actuator {seed}"))
    if ends is None:
        return None
    names = ends[0][0], ends[1][0]
    alone = first_alone(problem).points
    (p, v), (q, w) = ((alone[end].place[0], alone[end].velocity[0]) for end in names)
    size = max(abs(one.velocity[0]) for one in alone.values())
    if abs(((w - v) * (q - p).conjugate()).real) < 0.1 * size * abs(q - p):
        return None
    posed = OutputPositions(OutputPositionKind.LENGTH, "".join(names), (math.nan,))
    # Its rate only has to be that of no resting actuator.
    drive = replace(problem.drive, posed=replace(posed, rates=(1.0, 0.0)))
    return replace(problem, drive=drive), motion, ends


@each("seed", sampled(SEEDS, 5))
@pytest.mark.parametrize("way", ["motor", "actuator"])
def test_all_forces_are_those_of_all_links_at_once(seed: int, way: str) -> None:
    motor, ends = None, None
    if way == "motor":
        if (turned := between_links(seed)) is None:
            return
        problem, motion, motor = turned
    else:
        if (pushed := between_points(seed)) is None:
            return
        problem, motion, ends = pushed
    statics = Statics(Solution(problem))
    joints, acting = [(r.joint, r.on, r.by) for r in statics.reactions], loads_of(problem, motion)
    answer = solve_all(problem, joints, pose_of(motion), acting, ends=ends, motor=motor)
    limit = 1e-9 * max(answer.largest, *(abs(load.force) for load in acting))
    check_reactions(problem, statics, motion, answer, limit)
    size = max(1.0, *(abs(place) for place in motion.position.values()))
    assert abs(statics.balance[0] - answer.balance) <= limit * size
    assert statics.lever is not None
    assert abs(statics.lever[0] - statics.balance[0]) <= 1e-7 * (abs(answer.balance) + limit)
    other = problem.drive.other_drives[0]
    force, moment = answer.joints[f"driver {other.link}", other.link, "0"]
    second = statics.other_balances[other.link][0]
    if other.is_crank:
        assert abs(second - moment) <= limit * size
    else:
        along = pose_of(motion).along(problem.slides[other.link])
        assert abs(second - (force * complex(along).conjugate()).real) <= limit


@each("seed", sampled(SEEDS, 5))
def test_a_load_on_a_driver_gives_the_acceleration_that_it_balances(seed: int) -> None:
    """The loads of Newton's accelerations give these accelerations."""
    problem, _ = two_driven(seed)
    statics = Statics(Solution(problem))
    other = problem.drive.other_drives[0]
    efforts = [statics.balance[0], statics.other_balances[other.link][0]]
    chosen = [(0,), (1,), (0, 1)][seed % 3]
    given = [
        replace(drive, acceleration=0.0, effort=float(efforts[k])) if k in chosen else drive
        for k, drive in enumerate(problem.drive.every)
    ]
    found = pose(with_drives(problem, given)).drive.every
    for one, known in zip(found, problem.drive.every, strict=True):
        size = max(abs(drive.acceleration) + drive.rate**2 for drive in problem.drive.every)
        assert abs(one.acceleration - known.acceleration) <= 1e-8 * size


PLOTTER = FIVE_BAR.replace("phi = 70\nomega = 10", "x_C = 0.15\nvx_C = 0.1\nax_C = 0").replace(
    "phi = 40\nomega = -15\nepsilon = 5", "y_C = 0.3\nvy_C = -0.2\nay_C = 0"
)
POSED = PLOTTER.replace('link = "1"\nx_C', 'link = "1"\nroot = "near 100"\nx_C')


def test_a_plotter_moves_its_pen_as_given() -> None:
    point = Solution(pose(loads(POSED, name="plotter"))).points["C"]
    assert point.place[0] == pytest.approx(0.15 + 0.3j, abs=1e-12)
    assert point.velocity[0] == pytest.approx(0.1 - 0.2j, abs=1e-12)
    assert abs(point.acceleration[0]) < 1e-11


def test_a_plotter_draws_the_points_of_a_list() -> None:
    rates = {"vx_C = 0.1\nax_C = 0": "omega = 1", "vy_C = -0.2\nay_C = 0": "omega = 1"}
    text = POSED
    for old, new in rates.items():
        text = text.replace(old, new)
    text = text.replace("x_C = 0.15", "x_C = [0.15, 0.2, 0.25]")
    text = text.replace("y_C = 0.3", "y_C = [0.3, 0.3, 0.32]")
    places = Solution(pose(loads(text, name="plotter"))).points["C"].place
    assert [*places] == pytest.approx([0.15 + 0.3j, 0.2 + 0.3j, 0.25 + 0.32j], abs=1e-12)


@pytest.mark.parametrize("lang", ["en", "ru"])
@pytest.mark.parametrize(
    "first",
    [
        'phi_2_3 = 100\nomega_2_3 = 2\nroot = "near 70"',
        'AB = 0.45\nv_AB = 0.1\nroot = "near 70"',
        "phi = 70\nn = 60",
        "phi = 70\nomega = 10\ntorque = 3",
    ],
)
def test_a_protocol_has_all_drivers(first: str, lang: str) -> None:
    text = FIVE_BAR.replace("phi = 70\nomega = 10", first)
    solution = Solution(pose(loads(text + LOADS, name="five-bar")))
    shown = " ".join(protocol(solution, lang=lang).split())
    assert "φ₄ = 40°" in shown
    assert "ω₄ = −15" in shown or "ω₄ = −15".replace("−", "-") in shown


@pytest.mark.parametrize(
    ("old", "new", "path"),
    [
        ("x_C = 0.15", "stroke = 0.5", "drivers[0].stroke"),
        ('root = "near 100"\nx_C = 0.15', 'at = "extreme left"', "drivers[0].at"),
        ('root = "near 100"', 'root = "going right"', "drivers[0].root"),
        ("x_C = 0.15", "x_C = [0.15, 0.2]", "drivers[1].y_C"),
        ('link = "4"', 'link = "1"', "drivers[1].link"),
        ("vx_C = 0.1\nax_C = 0", "train = 1", "drivers[0].train"),
    ],
)
def test_a_fault_names_its_key(old: str, new: str, path: str) -> None:
    with pytest.raises(ProblemError) as caught:
        loads(POSED.replace(old, new, 1), name="plotter")
    assert path in [fault.path for fault in caught.value.faults]


def test_several_positions_are_named_with_the_next_step() -> None:
    with pytest.raises(ProblemError, match=r"x_C = 150 mm, y_C = 300 mm|near") as caught:
        pose(loads(PLOTTER, name="plotter"))
    (fault,) = caught.value.faults
    assert "near" in str(fault.hint)


def test_a_place_out_of_reach_is_told() -> None:
    with pytest.raises(AssemblyError, match=r"not reached together"):
        pose(loads(POSED.replace("y_C = 0.3", "y_C = 0.9"), name="plotter"))


def test_the_speed_of_a_point_without_a_guide_has_no_components() -> None:
    text = POSED.replace("vx_C = 0.1\nax_C = 0", "v_C = 0.1")
    with pytest.raises(ProblemError, match=r"two components"):
        pose(loads(text, name="plotter"))


def test_outputs_that_say_the_same_determine_no_rates() -> None:
    text = POSED.replace("vy_C = -0.2\nay_C = 0", "vx_C = 0.1\nax_C = 0")
    with pytest.raises(AssemblyError, match=r"do not determine the rates"):
        pose(loads(text, name="plotter"))


def test_two_motors_have_no_force_plans() -> None:
    text = FIVE_BAR.replace("phi = 70\nomega = 10", "AB = 0.4\nv_AB = 0.1")
    text = text.replace("phi = 40\nomega = -15\nepsilon = 5", "phi_2_3 = 100\nomega_2_3 = 1")
    with pytest.raises(ProblemError, match=r"no force plans"):
        loads(text + LOADS, name="five-bar")
