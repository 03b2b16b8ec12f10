"""Forces of mechanisms that an actuator drives: against all links at once, and by virtual work."""

from __future__ import annotations

from collections import Counter
from functools import cache

import numpy as np
import pytest
from actuated import actuated_problem
from cases import each, sampled, some
from doors import (
    FRAME,
    CamDrive,
    Friction,
    FrictionTask,
    ModelProblem as Problem,
    ProblemError,
    ProjectTask,
    Solution,
    Statics,
    cut_picture,
    cycle_forces_of,
    driven_by,
    force_reading,
    get_language,
    lever_picture,
    pose,
    problem_loads as loads,
    settle,
)
from full_system import (
    Acting,
    Answer,
    Ends,
    cross,
    loads_of,
    pose_of,
    power_of,
    slide_between,
    solve_all,
)
from msgspec.structs import replace
from newton import Motion, solve as newton
from texts import protocol

SEEDS = range(46000, 46000 + some(240, few=24))
LIMIT = 1e-9

SCISSOR = """units = "mm"
[frame]
O = [0, 0]
guides.floor = { through = "O", angle = 0 }
[links.1]
points = ["O", "M", "B", "P"]
OM = 500
OB = 1000
M = { on = "OB", at = 500 }
P = { on = "OB", at = 200 }
[links.2]
points = ["A", "M", "E", "Q"]
AE = 1000
M = { on = "AE", at = 500 }
Q = { on = "AE", at = 700 }
[links.3]
points = ["A"]
slides = { on = "floor" }
CYLINDER[driver]
link = "1"
PQ = 400
v_PQ = 20
root = "near 52"
[assembly]
A = "right of O"
[dynamics]
gravity = 0
[[loads]]
link = "1"
at = "B"
force = 1000
angle = -90
[[loads]]
link = "2"
at = "E"
force = 1000
angle = -90
"""
CYLINDER = """[links.4]
points = ["P"]
slides = { on = "5", through = "Q" }
[links.5]
points = ["Q"]
"""


def stands(seed: int) -> bool:
    return seed % 4 == 3


@cache
def drawn(seed: int) -> tuple[Problem, Motion, Ends]:
    problem, start, ends = actuated_problem(seed, triad=seed % 5 == 0, stands=stands(seed))
    return problem, newton(problem, problem.drive.positions[0], start), ends


@cache
def solved(seed: int) -> Statics:
    return Statics(Solution(drawn(seed)[0]))


@cache
def acting(seed: int) -> list[Acting]:
    problem, motion, _ = drawn(seed)
    return loads_of(problem, motion)


@cache
def refereed(seed: int) -> Answer:
    problem, motion, ends = drawn(seed)
    joints = [(r.joint, r.on, r.by) for r in solved(seed).reactions]
    return solve_all(problem, joints, pose_of(motion), acting(seed), ends=ends)


def largest(seed: int) -> float:
    """Largest force, N."""
    answer = refereed(seed)
    return float(max(answer.largest, *(abs(load.force) for load in acting(seed))))


def test_every_kind_of_actuator_occurs() -> None:
    seen: Counter[str] = Counter()
    for seed in SEEDS:
        problem, _, ((_, one), (_, two)) = drawn(seed)
        seen["own links" if one == "101" else "only a distance"] += 1
        seen["from the frame" if FRAME in (one, two) else "between moving links"] += 1
        seen["crank" if problem.drive.is_crank else "slider"] += 1
        seen["a triad"] += any(
            len(group.links) > 2 for group in solved(seed).solution.structure.groups
        )
    assert len(seen) == 7
    assert min(seen.values()) >= some(20, few=1)


@each("seed", sampled(SEEDS, 3))
def test_all_forces_are_those_of_all_links_at_once(seed: int) -> None:
    problem, motion, _ = drawn(seed)
    limit, answer = LIMIT * largest(seed), refereed(seed)
    assert abs(solved(seed).balance[0] - answer.balance) <= limit
    for r in solved(seed).reactions:
        joint = (r.joint, r.on, r.by)
        force, moment = answer.joints[joint]
        assert abs(r.force[0] - force) <= limit, joint
        slide, found = slide_between(problem, joint), r.moment[0]
        if slide is not None:
            found += cross(r.at[0] - motion.position[slide.slider, slide.pin], r.force[0])
        assert abs(found - moment) <= limit, joint


@each("seed", sampled(SEEDS, 3))
def test_its_power_is_that_of_the_loads(seed: int) -> None:
    statics = solved(seed)
    if stands(seed):
        assert statics.lever is None
        return
    problem, motion, ((one, _), (two, _)) = drawn(seed)
    places = {point: (z, 0j) for point, z in problem.bodies[FRAME].points.items()}
    for link in problem.mechanism.links:
        for point in problem.bodies[link].points:
            if point not in places:
                places[point] = motion.position[link, point], motion.velocity[link, point]
    apart, rate = (places[two][k] - places[one][k] for k in (0, 1))
    grows = (rate * apart.conjugate()).real / abs(apart)
    powers = power_of(problem, motion, acting(seed))
    limit = LIMIT * sum(map(abs, powers))
    assert abs(sum(powers) + statics.balance[0] * grows) <= limit
    assert statics.lever is not None
    assert abs(statics.lever[0] - statics.balance[0]) * abs(grows) <= limit


@each("seed", [seed for seed in SEEDS if not stands(seed)][: some(60, few=6)])
def test_friction_is_carried_by_the_actuator(seed: int) -> None:
    """Friction as a load on both links of a pair, and the power that is lost."""
    problem, motion, ends = drawn(seed)
    assert problem.dynamics is not None
    task = FrictionTask(f=0.05, f_pin=0.05, radius=0.01)
    rubbed = replace(problem, dynamics=replace(problem.dynamics, friction=task))
    friction = Friction(Solution(rubbed))
    if friction.jammed.any():
        pytest.skip("friction grows without limit")
    forces, joints = friction.converged, [(r.joint, r.on, r.by) for r in solved(seed).reactions]
    loaded, lost = list(acting(seed)), 0.0
    for pair, size in zip(friction.pairs, forces.friction, strict=True):
        lost += float(size[0] * abs(pair.rate[0]))
        pressed = abs(forces.reactions[pair.number][0]) if pair.sense[0] else 0.0
        assert size[0] == pytest.approx(pair.coefficient * pressed, rel=1e-9, abs=1e-9)
        for one in pair.loads(size):
            at = 0j if one.point is None else motion.position[one.link, one.point]
            loaded.append(Acting(one.link, one.force[0], at, one.couple[0]))
    answer = solve_all(problem, joints, pose_of(motion), loaded, ends=ends)
    limit = LIMIT * max(largest(seed), answer.largest)
    assert abs(forces.balance[0] - answer.balance) <= limit
    powers = power_of(problem, motion, acting(seed))
    assert forces.power[0] == pytest.approx(lost - sum(powers), rel=1e-8, abs=1e-8)


@pytest.mark.parametrize("own", [True, False])
@pytest.mark.parametrize("rate", [20, 0])
def test_the_cylinder_of_a_scissor_lift(own: bool, rate: int) -> None:
    """By hand: 2·1000·|v_B|/v_PQ, and each support has half of the weight."""
    text = SCISSOR.replace("CYLINDER", CYLINDER if own else "").replace("= 20\n", f"= {rate}\n")
    statics = Statics(Solution(pose(loads(text, name="scissor"))))
    forces = {(r.joint, r.on, r.by): r.force[0] for r in statics.reactions}
    assert statics.balance[0] == pytest.approx(4216.370213557839, rel=1e-12)
    assert statics.moment is None
    for support in (("O", "1", FRAME), ("A", "3", FRAME)):
        assert forces[support] == pytest.approx(1000j, rel=1e-9, abs=1e-9)
    if own:  # its pins have its force
        pins = [abs(forces["P", "4", "1"]), abs(forces["Q", "5", "2"])]
        assert pins == pytest.approx([statics.balance[0]] * 2, rel=1e-12)
        assert abs(forces["P", "4", "5"]) < 1e-9
    assert np.isfinite(statics.ruler_reading.number(statics.driving.balance)).all()


def test_a_slider_on_a_guide_of_the_frame_is_no_cylinder() -> None:
    """It acts on the first link with its end, the rod: the pin carries the load of the slider."""
    text = """
[frame]
O = [0.0, 0.0]
Q = [1.0, 0.0]
guides.x-x = { through = "O", angle = 0 }
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B"]
AB = 0.3
[links.3]
points = ["B"]
slides = { on = "x-x" }
[driver]
link = "1"
QB = 0.65
v_QB = 0.1
root = 1
[assembly]
B = "right of A"
[dynamics]
[[loads]]
link = "3"
at = "B"
force = 1000
angle = 0
"""
    statics = Statics(Solution(pose(loads(text, name="slider"))))
    forces = {(r.joint, r.on, r.by): r.force[0] for r in statics.reactions}
    assert statics.balance[0] == pytest.approx(1000.0, rel=1e-12)
    assert forces["B", "2", "3"] == pytest.approx(1000.0, rel=1e-12)
    assert abs(forces["A", "2", "1"]) < 1e-9


@pytest.mark.parametrize(
    ("table", "path"),
    [
        ('[machine]\ndelta = "1/18"', "machine"),
        ('[balancing_force]\nat = "B"', "balancing_force"),
        ("[balancing]\n", "balancing"),
    ],
)
def test_tables_for_a_rotating_crank_are_rejected(table: str, path: str) -> None:
    with pytest.raises(ProblemError) as caught:
        loads(SCISSOR.replace("CYLINDER", "") + table, name="scissor")
    told = [fault for fault in caught.value.faults if fault.path == path]
    assert told
    assert "actuator PQ" in told[0].message


def test_no_turn_and_no_project_is_made_of_it() -> None:
    problem = replace(drawn(SEEDS[0])[0], project=ProjectTask())
    for ask in (settle, lambda one: cycle_forces_of(Solution(one, positions=[1.0, 2.0]))):
        with pytest.raises(ProblemError, match="actuator"):
            ask(problem)


def test_friction_wants_the_speed_of_the_actuator_itself() -> None:
    rubs = SCISSOR.replace("CYLINDER", "") + "[friction]\nf = 0.1\n"
    assert loads(rubs, name="scissor").dynamics is not None
    with pytest.raises(ProblemError, match=r"actuator PQ does not move.*v_PQ = 0\.1"):
        loads(rubs.replace("v_PQ = 20", "v_PQ = 0"), name="scissor")


def test_the_actuator_is_named_as_driver_if_another_quantity_gives_the_position() -> None:
    actuated = loads(SCISSOR.replace("CYLINDER", ""), name="scissor")
    told = SCISSOR.replace("CYLINDER", "").replace("PQ = 400\nv_PQ = 20", "phi_2_3 = 60\nomega = 1")
    posed = loads(told, name="scissor")
    lifted = CamDrive(turns=True, n=60.0, pieces=())
    followed = replace(posed, drive=replace(posed.drive, posed=None, cam_drive=lifted))
    said = {
        lang: [[*driven_by(one, get_language(lang).note)] for one in (actuated, posed, followed)]
        for lang in ("en", "ru")
    }
    for none, by_position, by_cam in said.values():
        assert none == []
        assert len(by_position) == len(by_cam) == 1
    assert "phi_2_3, but link 1 drives" in said["en"][1][0]
    assert "follower drives link 1" in said["en"][2][0]
    assert "[balancing_force]" in said["en"][2][0]


@each("seed", sampled(SEEDS[:: some(1, few=4)], 3))
def test_actuator_force_is_reported_and_drawn_wherever_it_acts(seed: int) -> None:
    """The protocol, and the sheet's lever, cut groups and plans, of any mechanism with one."""
    statics, (_, _, ((one, _), (two, _))) = solved(seed), drawn(seed)
    text = " ".join(protocol(statics.solution, lang="en").split())
    assert f"The actuator {one}{two} drives the mechanism" in text
    assert statics.thrust is not None
    for link, force in statics.thrust.pushes:
        assert f"The actuator {one}{two} acts on link {link} at point {force.at} with" in text
        assert sum(force.at == edge.at for p in statics.board.plans for edge in p.polygon) >= 1
    assert ("are a pair of forces" in text) is not stands(seed)
    assert ("a tried force of" in text) is stands(seed)
    reading, say = force_reading(statics.solution, 0), get_language("en").notation
    for number in range(len(reading.plans)):
        cut_picture(reading, number, 3.5, say)
    if not stands(seed):
        lever_picture(reading, 3.5, say)
