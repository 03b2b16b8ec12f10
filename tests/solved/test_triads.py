"""Triads, groups of class III: assemblies, motion and forces apart from the plans' own ways."""

from __future__ import annotations

import cmath
import math
import random
import re
from collections import Counter
from functools import cache
from typing import Any

import numpy as np
import pytest
from cases import each, sampled, some
from doors import (
    FRAME,
    Assembled,
    AssemblyError,
    Float64,
    ModelProblem as Problem,
    PointName,
    PositionError,
    Precise,
    ProblemError,
    Single,
    Solution,
    Statics,
    Sweep,
    add_group,
    analyse,
    assemblies,
    begin_positions,
    choose_modes,
    drive_data,
    env_of,
    problem_loads as loads,
    solve_pose,
    triad_of,
    verify,
)
from full_system import Answer, cross, loads_of, pose_of, slide_between, solve_all
from loaded import loaded_problem
from mechanisms import TRIAD
from msgspec.structs import replace
from newton import Motion, solve as newton

SEEDS = range(some(200, few=25))
LIMIT = 1e-9

TEXT = TRIAD + "[assembly]\n"


def fixture(rule: str = "B = { near = [0.2356, 0.0801] }", text: str = TEXT) -> Problem:
    return loads(text + rule, name="triad")


@pytest.mark.parametrize(
    ("near", "place", "numbers"),
    [
        ("0.24, 0.08", 0.235632 + 0.080103j, (1.832157, -12.149013, 73.67525, -281.00525)),
        ("0.11, 0.23", 0.109611 + 0.232919j, (0.211776, -0.559066, 8.30696, 23.33842)),
    ],
)
def test_both_printed_assemblies(
    near: str, place: complex, numbers: tuple[float, float, float, float]
) -> None:
    solution = Solution(fixture(f"B = {{ near = [{near}] }}"))
    point, link = solution.points["B"], solution.links["3"]
    assert abs(point.place[0] - place) < 1e-6
    found = abs(point.velocity[0]), link.omega[0], abs(point.acceleration[0]), link.epsilon[0]
    for value, printed in zip(found, numbers, strict=True):
        digits = len(repr(printed).split(".")[1])
        assert abs(value - printed) <= 0.51 * 10.0**-digits
    verify(solution)


# All assemblies -----------------------------------------------------------------------------------


def sextic(triad: list[tuple[complex, complex, float]]) -> list[tuple[complex, float]]:
    """Return every pose of a link whose places z are r from a, by the roots of one polynomial.

    With w the link's direction and 1/w its conjugate, the differences of the equations are linear
    in the origin and its conjugate: eliminating both leaves a polynomial in w.
    """
    poly = np.polynomial.Polynomial
    (z1, a1, r1), *others = triad
    assert z1 == 0
    rows = []
    for z, a, r in others:
        # (b + wz - a)(b' + z'/w - a') - r², less the first, times w.
        of_b = poly([z.conjugate(), a1.conjugate() - a.conjugate()])
        of_conjugate = poly([0, a1 - a, z])
        rest = poly([-a * z.conjugate(), 0, -z * a.conjugate()])
        rest += poly([0, abs(z) ** 2 + abs(a) ** 2 - abs(a1) ** 2 - r**2 + r1**2])
        rows.append((of_b, of_conjugate, rest))
    (p, q, s), (u, v, t) = rows
    det, b, c = p * v - q * u, q * t - s * v, s * u - p * t
    whole = (b - a1 * det) * (c - a1.conjugate() * det) - r1**2 * det * det
    found = []
    for w in map(complex, whole.roots()):
        if abs(abs(w) - 1) < 1e-5 and abs(det(w)) > 1e-9:
            origin, other = b(w) / det(w), c(w) / det(w)
            if abs(origin.conjugate() - other) < 1e-4:
                found.append((complex(origin), cmath.phase(w)))
    return found


def not_chosen(problem: Problem) -> Assembled:
    """Return the only group of a problem with nothing chosen."""
    (group,) = analyse(problem.mechanism).groups
    triad, draft = triad_of(group), begin_positions(problem, {})
    add_group(draft, group)
    assert triad is not None
    return Assembled(
        draft, draft.b.program(), lambda s: drive_data(problem, draft, s), group, triad
    )


def random_triad(seed: int) -> tuple[Problem, list[tuple[complex, complex, float]]]:
    """Return a mechanism with a triad of hinges that is assembled, and its legs by places."""
    rng = random.Random(f"triad {seed}")

    def somewhere() -> complex:
        return complex(rng.uniform(-1, 1), rng.uniform(-1, 1))

    while True:
        o, a, e, f, b, c, d = (somewhere() for _ in range(7))
        far = min(abs(p - q) for p, q in ((o, a), (a, b), (e, c), (f, d), (b, c), (b, d), (c, d)))
        if far > 0.15:
            break
    side = "left" if ((c - b).conjugate() * (d - b)).imag > 0 else "right"
    text = f"""
    title = "III"
    [frame]
    O = [{o.real!r}, {o.imag!r}]
    E = [{e.real!r}, {e.imag!r}]
    F = [{f.real!r}, {f.imag!r}]
    [links.1]
    points = ["O", "A"]
    OA = {abs(a - o)!r}
    [links.2]
    points = ["A", "B"]
    AB = {abs(b - a)!r}
    [links.3]
    points = ["B", "C", "D"]
    BC = {abs(c - b)!r}
    BD = {abs(d - b)!r}
    CD = {abs(d - c)!r}
    D.side = "{side} of BC"
    [links.4]
    points = ["E", "C"]
    EC = {abs(c - e)!r}
    [links.5]
    points = ["F", "D"]
    FD = {abs(d - f)!r}
    [driver]
    link = "1"
    phi = {math.degrees(cmath.phase(a - o))!r}
    omega = 1
    [assembly]
    B = {{ near = [{b.real!r}, {b.imag!r}] }}
    """
    w = (c - b) / abs(c - b)
    turned = (d - b) / w
    legs = [(0j, a, abs(b - a)), (abs(c - b) + 0j, e, abs(c - e)), (turned, f, abs(d - f))]
    return loads(text, name=f"triad-{seed}"), legs


@each("seed", sampled(range(some(200, few=40)), 3))
def test_all_assemblies_are_those_of_the_sextic(seed: int) -> None:
    problem, legs = random_triad(seed)
    made = not_chosen(problem)
    at = np.asarray(problem.drive.positions)
    ours = assemblies(made.step, env_of(made.step, made.read(at), 0))
    theirs = sextic(legs)
    assert len(ours) % 2 == 0
    assert len(ours) == len(theirs)
    for origin, turn in theirs:
        apart = [
            abs(pose.origin + made.draft.origin - origin)
            + abs(cmath.rect(1, math.radians(pose.turn)) - cmath.rect(1, turn))
            for pose in ours
        ]
        assert min(apart) < 1e-6


def test_there_are_triads_with_two_four_and_six_assemblies() -> None:
    seen = Counter(len(sextic(random_triad(seed)[1])) for seed in range(40))
    assert set(seen) >= {2, 4}


def test_without_a_rule_all_assemblies_are_named() -> None:
    problem = fixture("")
    with pytest.raises(ProblemError) as caught:
        choose_modes(problem, analyse(problem.mechanism))
    (fault,) = caught.value.faults
    assert "can be assembled in 4 ways at phi = 50 deg" in fault.message
    for place in ("0.1096, 0.2329", "0.2065, 0.1546", "0.2356, 0.0801", "0.2381, 0.03163"):
        assert f"({place})" in fault.message
    assert "near = [0.1096, 0.2329]" in fault.hint


def test_another_rule_distinguishes_the_assembly_if_one_alone_satisfies_it() -> None:
    chosen = Solution(fixture('D = "right of F"\nC = "above E"\nB = { near = [0.3, 0] }'))
    assert chosen.points["D"].place[0].real > 0.16
    with pytest.raises(ProblemError, match="does not distinguish the assemblies"):
        Solution(fixture('B = "above A"'))


# Over the positions -------------------------------------------------------------------------------


def test_an_assembly_ends_in_dead_positions_and_they_are_named() -> None:
    solution = Solution(fixture(), positions=[33.0, 45.0, 57.0])
    verify(solution)
    with pytest.raises(PositionError, match=r"only from phi = 32\.8569 deg to phi = 57\.3086 deg"):
        _ = Solution(fixture(), positions=[20.0]).si


TURNING = TEXT.replace("OA = 0.06", "OA = 0.01").replace("phi = 50", "phi = [50, 140, 290]")


@pytest.mark.parametrize(("phi", "count"), [(57.3, 4), (57.30856, 4), (57.32, 2)])
def test_two_assemblies_next_to_each_other_are_distinguished(phi: float, count: int) -> None:
    """They become one in the dead position, at 57.308569 degrees."""
    made = not_chosen(fixture())
    env = env_of(made.step, made.read(np.array([phi])), 0)
    assert len(assemblies(made.step, env)) == count


def test_an_assembly_does_not_pass_into_the_one_that_it_meets() -> None:
    """The determinant of the legs' lines has one sign along it, to its very ends."""
    problem = fixture()
    made = not_chosen(problem)
    (closing,) = choose_modes(problem, analyse(problem.mechanism)).values()
    path, signs = closing.tracked, set()
    for k, at in enumerate(path.places):
        env = env_of(made.step, made.read(np.array([at])), 0)
        start: dict[Any, float] = dict(
            zip(made.step.start, (path.x[k], path.y[k], path.turn[k]), strict=True)
        )
        _, _, det = solve_pose(made.step, {**env, **start}, Single(), 1)
        signs.add(np.sign(det))
    assert len(signs) == 1


def test_a_turning_crank_keeps_its_assembly_and_comes_back() -> None:
    problem = fixture("B = { near = [0.2, 0.05] }", TURNING)
    way = np.arange(50.0, 50.0 + 720.0, 1.5)
    solution = Solution(problem, positions=way.tolist())
    place = solution.points["B"].place
    step = np.abs(np.diff(place)) / np.abs(solution.points["A"].velocity[:-1])
    assert step.max() < 10 * np.median(step)  # nowhere does it leap
    half = len(way) // 2
    assert np.abs(place[half:] - place[:half]).max() < 1e-12


def test_positions_alone_and_in_a_batch_and_in_any_order_are_the_same() -> None:
    problem = fixture("B = { near = [0.2, 0.05] }", TURNING)
    way = [400.0, 3.0, -100.0, 222.0]
    whole = Solution(problem, positions=way)
    for k, position in enumerate(way):
        alone = Solution(problem, positions=[position])
        assert alone.points["B"].place[0] == whole.points["B"].place[k]


@pytest.mark.parametrize("native", [False, True])
def test_a_sweep_gives_the_results_of_the_positions(native: bool) -> None:
    problem = fixture("B = { near = [0.2, 0.05] }", TURNING)
    way = np.linspace(0.0, 360.0, 5000)
    sweep = Sweep(problem, native=native)
    solution = Solution(problem, positions=way[::100].tolist())
    found = sweep.table(way)
    assert np.abs(found["B.x"][::100] - solution.points["B"].place.real).max() < 1e-13
    exact = solution.points["B"].acceleration
    off = np.abs(found["B.ax"][::100] - exact.real).max()
    assert off < 1e-10 * np.abs(exact).max()
    few = sweep.table(way[:7])
    assert np.abs(few["C.vy"] - found["C.vy"][:7]).max() < 1e-13
    gone = Sweep(fixture(), native=native).table(np.array([20.0, 50.0]))
    assert np.isnan(gone["B.x"]).tolist() == [True, False]
    assert "32.8569" in Sweep(fixture()).explain(20.0)


def test_the_referee_has_the_same_to_fifty_digits() -> None:
    """The legs are as long as given, to the digits of the referee, between two looks as well."""
    solution = Solution(fixture(), positions=[51.37])
    referee = Precise(50)
    exact = solution.read(referee).value
    for p, q, length in (("A", "B", "l_AB"), ("E", "C", "l_EC"), ("F", "D", "l_FD")):
        told = referee.lift(solution.construction.draft.numbers[length])
        assert abs(abs(exact[PointName(q)] - exact[PointName(p)]) - told) < 1e-48
    float64 = solution.read(Float64()).value
    assert abs(complex(exact[PointName("B")]) - complex(float64[PointName("B")][0])) < 1e-15


def test_parallel_legs_have_another_special_point() -> None:
    """Legs 2 and 4 are parallel: the point is of two others, and the numbers are Newton's."""
    text = TEXT.replace("E = [0.30, 0.02]", "E = [0.16, -0.05]")
    b, a = 0.03 + 0.2j, 0.06 * cmath.rect(1, math.radians(50))
    e = b + 0.16 - (b - a) / abs(b - a) * 0.15
    text = text.replace("E = [0.16, -0.05]", f"E = [{e.real!r}, {e.imag!r}]")
    text = text.replace("AB = 0.20", f"AB = {abs(b - a)!r}")
    d = 0.16 * cmath.rect(1, math.radians(0)) + b
    assert abs(abs(d - e) - 0.15) < 1e-12
    along = (0.14**2 - 0.13**2 + 0.16**2) / 0.32
    corner = b + along + 1j * math.sqrt(0.14**2 - along**2)
    f = corner + 0.14 * cmath.rect(1, 0.4)
    text = text.replace("F = [0.16, 0.30]", f"F = [{f.real!r}, {f.imag!r}]")
    solution = Solution(fixture(f"B = {{ near = [{b.real}, {b.imag}] }}", text))
    assert solution.construction.draft.special["3"].third != 2
    verify(solution)
    assert abs(solution.points["B"].place[0] - b) < 1e-9


# Random mechanisms with legs of all kinds ---------------------------------------------------------


@cache
def solved(seed: int) -> Statics:
    return Statics(Solution(loaded_problem(seed, triad=True)[0]))


@cache
def moving(seed: int) -> Motion:
    problem, pose = loaded_problem(seed, triad=True)
    return newton(problem, problem.drive.positions[0], pose)


@cache
def refereed(seed: int) -> Answer:
    problem, joints = solved(seed).solution.problem, solved(seed).reactions
    named = [(r.joint, r.on, r.by) for r in joints]
    return solve_all(problem, named, pose_of(moving(seed)), loads_of(problem, moving(seed)))


def test_every_kind_of_leg_occurs() -> None:
    seen: Counter[str] = Counter()
    for seed in SEEDS:
        structure = solved(seed).solution.structure
        for group in structure.groups:
            triad = triad_of(group)
            if triad is not None:
                seen[group.signature] += 1
    assert len(seen) >= 5
    assert sum(seen.values()) == len(SEEDS)


@each("seed", sampled(SEEDS, 3))
def test_motion_is_that_of_newtons_method(seed: int) -> None:
    solution, ref = solved(seed).solution, moving(seed)
    reading, kin = solution.si, solution.construction.kinematics
    origin = solution.construction.draft.origin
    sizes = [
        max(map(abs, found.values())) for found in (ref.position, ref.velocity, ref.acceleration)
    ]
    for link, point in ref.position:
        if (link, point) not in kin.velocity.point:
            continue
        place = reading.value[PointName(point)] + origin
        velocity = reading.value[kin.velocity.point[link, point]]
        acceleration = reading.value[kin.acceleration.point[link, point]]
        found = place, velocity, acceleration
        wanted = ref.position, ref.velocity, ref.acceleration
        for mine, theirs, size in zip(found, wanted, sizes, strict=True):
            assert abs(mine - theirs[link, point]) < LIMIT * size, (link, point)
    fastest = max(sizes[1], *map(abs, ref.omega.values()))  # of about a metre
    for link, omega in ref.omega.items():
        assert abs(solution.links[link].omega[0] - omega) < LIMIT * fastest


@each("seed", sampled(SEEDS, 3))
def test_reactions_are_those_of_all_links_at_once(seed: int) -> None:
    statics, ref = solved(seed), refereed(seed)
    problem = statics.solution.problem
    peak = max(ref.largest, *(float(abs(one.force)) for one in loads_of(problem, moving(seed))))
    for r in statics.reactions:
        force, moment = ref.joints[r.joint, r.on, r.by]
        assert abs(r.force[0] - force) <= LIMIT * peak, r.joint
        slide = slide_between(problem, (r.joint, r.on, r.by))
        if slide is not None:
            pin = moving(seed).position[slide.slider, slide.pin]
            about_pin = r.moment[0] + cross(r.at[0] - pin, r.force[0])
            assert abs(about_pin - moment) <= LIMIT * peak, r.joint


@each("seed", sampled(SEEDS, 3))
def test_the_lever_is_the_balance(seed: int) -> None:
    """Virtual work: the velocities alone, without any reaction."""
    statics = solved(seed)
    assert statics.lever is not None
    rate = abs(statics.solution.problem.drive.rate)
    loads = loads_of(statics.solution.problem, moving(seed))
    fast = max(map(abs, moving(seed).velocity.values()))
    size = sum(float(abs(one.force)) * fast + float(abs(one.couple)) * fast for one in loads) / rate
    assert abs(statics.lever[0] - statics.balance[0]) <= LIMIT * size
    assert abs(statics.balance[0] - refereed(seed).balance) <= LIMIT * size


def test_forces_of_the_printed_mechanism_hold_to_the_last_digits() -> None:
    loads_text = """
[dynamics.links.2]
mass = 1.2
centre = "B"
inertia = 0.004
[dynamics.links.3]
mass = 2
centre = "C"
inertia = 0.006
[[loads]]
link = "3"
at = "D"
force = 100
angle = -70
[[loads]]
link = "5"
couple = 3
"""
    problem = fixture("B = { near = [0.2356, 0.0801] }\n[dynamics]" + loads_text)
    statics = Statics(Solution(problem))
    at = newton(problem, 50.0, pose_of_solution(statics.solution))
    named = [(r.joint, r.on, r.by) for r in statics.reactions]
    ref = solve_all(problem, named, pose_of(at), loads_of(problem, at))
    for r in statics.reactions:
        assert abs(r.force[0] - ref.joints[r.joint, r.on, r.by][0]) <= 1e-12 * ref.largest
    assert abs(statics.balance[0] - ref.balance) <= 1e-12 * abs(ref.balance)
    assert statics.lever is not None
    assert abs(statics.lever[0] - statics.balance[0]) <= 1e-12 * abs(ref.balance)


def pose_of_solution(solution: Solution) -> dict[str, tuple[float, float, float]]:
    """Return where Newton's method begins."""
    found = {}
    for link in solution.problem.mechanism.links:
        body = solution.problem.bodies[link].points
        origin = next(point for point, z in body.items() if z == 0)
        place, turn = solution.points[origin].place[0], solution.links[link].phi_deg[0]
        found[link] = place.real, place.imag, math.radians(turn)
    return found


# Mechanisms that are still rejected ---------------------------------------------------------------


CLASS_IV = """
title = "IV"
[frame]
A = [0.0, 0.0]
G = [0.5, 0.0]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C", "F"]
BC = 0.2
BF = 0.25
CF = 0.15
F.side = "right of BC"
[links.3]
points = ["C", "D"]
CD = 0.2
[links.4]
points = ["D", "E", "G"]
GD = 0.22
GE = 0.2
DE = 0.12
E.side = "left of GD"
[links.5]
points = ["E", "F"]
EF = 0.22
[driver]
link = "1"
phi = 60
omega = 10
"""


def test_sizes_of_a_triad_are_those_of_a_file() -> None:
    """The special point that is drawn stays the same one, whichever is the best with a size."""
    at = np.array([60.0, 62.0])
    sweep = Sweep(fixture(), ["positions", "velocities"], varied=["l_AB"])
    found = sweep.table(at, {"l_AB": 1.01 * sweep.parameters["l_AB"]})
    length = re.search(r"(?m)^AB = (.*)$", TEXT)
    assert length is not None
    own = fixture(text=TEXT.replace(length[0], f"AB = {1.01 * float(length[1])!r}"))
    wanted = Sweep(own, ["positions", "velocities"]).table(at)
    alike = [name for name in found if name in wanted]
    assert len(alike) > 30
    for name in alike:
        assert found[name] == pytest.approx(wanted[name], rel=1e-9, abs=1e-9, nan_ok=True), name


_PLACES = {
    "A": 0j, "B": 0.1 + 0j, "C": 0.3 + 0.1j, "D": 0.28 - 0.12j, "E": 0.5 + 0.12j, "F": 0.47 - 0.1j,
    "G": 0.6 + 0j, "H": 0.8 + 0.13j, "I": 0.83 - 0.1j, "J": 1.0 + 0.1j, "K": 1.05 - 0.12j,
    "L": 1.2 + 0j, "M": 0.68 - 0.2j,
}  # fmt: skip


def _iv(links: str, fixed: str, slider: str = "") -> str:
    """Return a file of the links, each by its points, in the places above; link 1 drives."""
    lines = ['title = "IV"', "[frame]"]
    lines += [f"{p} = [{_PLACES[p].real}, {_PLACES[p].imag}]" for p in fixed]
    for number, points in enumerate(links.split(), 1):
        lines += [f"[links.{number}]", f"points = {list(points)}".replace("'", '"')]
        if len(points) == 1:
            lines.append(slider)
        pairs = [(p, q) for k, q in enumerate(points) for p in points[:k]]
        lines += [f"{p}{q} = {abs(_PLACES[p] - _PLACES[q])!r}" for p, q in pairs]
        if len(points) == 3:
            a, b, c = (_PLACES[p] for p in points)
            side = "left" if ((b - a).conjugate() * (c - a)).imag > 0 else "right"
            lines.append(f'{points[2]}.side = "{side} of {points[:2]}"')
    return "\n".join([*lines, '[driver]\nlink = "1"', "phi = 0", "omega = 10", ""])


@pytest.mark.parametrize(
    ("links", "fixed", "slider", "refused", "able"),
    [
        # Driven from its other end it is a triad: link 2 on the legs 1, 3 and 4.
        ("AB BCD CE DF GEF", "AG", "", "class 4, order 2 (links 2, 3, 4, 5)", "5"),
        (
            "AB BCD C DF GEF",
            "AG",
            'slides = { on = "5", along = "EF" }',
            "class 4, order 2 (links 2, 3, 4, 5)",
            "5",
        ),
        # In a row they are triads from the far end; side by side one of class IV is left.
        ("AB BCD CE DF GEF FHI HJ IK LJK", "AGL", "", "class 4, order 2 (links 2, 3, 4, 5)", "9"),
        ("AB BCD CE DF GEF BHI HJ IK LJK", "AGL", "", "class 4, order 2 (links 2, 3, 4, 5)", ""),
    ],
)
def test_groups_of_class_four_are_rejected_with_the_reason(
    links: str, fixed: str, slider: str, refused: str, able: str
) -> None:
    problem = loads(_iv(links, fixed, slider), name="iv")
    with pytest.raises(AssemblyError) as caught:
        Solution(problem)
    text, mechanism = str(caught.value), problem.mechanism
    assert refused in text
    assert ("if link" in text) == bool(able) and (
        "No driving link joined to the frame" in text
    ) != bool(able)
    assert f"if link {able} drives" in text or not able
    for link in (x for x in mechanism.links if any({FRAME, x} <= {*j.links}
                 for j in mechanism.revolutes)):  # fmt: skip
        groups = analyse(replace(mechanism, driver=link)).groups
        built = all(group.class_number == 2 or triad_of(group) for group in groups)
        assert built == (link == able), (link, groups)
    if (
        able == "5" and not slider
    ):  # a triad does close where link 5 drives, in the places of the file
        turned = _iv(links, fixed).replace('link = "1"', f'link = "{able}"')
        phi = math.degrees(cmath.phase(_PLACES["E"] - _PLACES["G"]))
        turned = turned.replace("phi = 0", f"phi = {phi!r}")
        solution = Solution(loads(f"{turned}[assembly]\nB = {{ near = [0.1, 0.0] }}", name="iii"))
        assert abs(solution.points["B"].place[0] - _PLACES["B"]) < 1e-9
        verify(solution)


def test_an_error_names_the_links_that_may_drive_and_never_leads_in_a_circle() -> None:
    with pytest.raises(AssemblyError) as caught:
        Solution(loads(CLASS_IV, name="iv"))
    assert "class 4, order 2 (links 2, 3, 4, 5)" in str(caught.value)
    assert "link 4" in str(caught.value)
    other = CLASS_IV.replace('link = "1"\n', 'link = "4"\n')
    try:
        Solution(loads(other, name="other"))
    except AssemblyError as error:
        assert "driv" not in str(error)
    except ProblemError as error:  # it falls into dyads, whose assembly rules are missing
        assert "close in two ways" in str(error) or "assembled" in str(error)
