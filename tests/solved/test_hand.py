"""The draughtsman with a ruler: every read segment, and the chain that follows from it."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest
from cases import each, sampled, some
from doors import (
    MOTION,
    Compute,
    Name,
    NumberName,
    PlanKind,
    PointName,
    Solution,
    problem_loads as loads,
)
from worked import SIX, exact_values, problem_of

from benchmarks.generator import random_problem


@cache
def drawn(name: str, ruler: float) -> Solution:
    return Solution(problem_of(name), ruler=ruler)


@cache
def read(name: str, ruler: float, kind: PlanKind) -> dict[str, float]:
    return {s.name: float(s.read[0]) for s in drawn(name, ruler).segments(kind)}


def omega_of(solution: Solution, link: str) -> float:
    return float(solution.read_off(f"omega_{link}")[0])


def epsilon_of(solution: Solution, link: str) -> float:
    return float(solution.read_off(f"epsilon_{link}")[0])


def rule(length: float, step: float = 1.0) -> float:
    """Round a length as a person reads: to the nearest mark, from half a step on upwards."""
    return math.copysign(math.floor(abs(length) / step + 0.5) * step, length)


def meet(p: complex, u: complex, q: complex, v: complex) -> complex:
    """Return the intersection of the line from p along u with the line from q along v."""
    return p + u * (((q - p).conjugate() * v).imag / (u.conjugate() * v).imag)


V, A = PlanKind.VELOCITY, PlanKind.ACCELERATION
SIX_LINK = exact_values()["levers/six-link"]


def test_the_first_example_with_a_ruler_of_1_mm() -> None:
    """The textbook's chain: segments to the millimetre, later values computed from them.

    l_AB = 0.03, l_BC = 0.1, phi = 60°, omega = -100; mu_v = 0.05, mu_a = 5.
    """
    b = cmath.rect(0.03, math.radians(60))
    c = b.real + math.sqrt(0.1**2 - b.imag**2)
    bc = (c - b) / abs(c - b)
    # Velocity plan: pb = 100·0.03/0.05 = 60 mm, then c on the horizontal and across BC.
    pb = 60.0 * (-1j) * b / abs(b)
    pc = meet(0j, 1 + 0j, pb, 1j * bc)
    assert (rule(abs(pb)), rule(abs(pc)), rule(abs(pc - pb))) == (60, 60, 31)
    omega2 = 31 * 0.05 / 0.1
    # d divides bc as on the link: bd/bc = 0.03/0.1, with the read 31 mm: bd = 9.3 mm.
    pd = pb - 9.3 * (pc - pb) / abs(pc - pb)
    # Acceleration plan: pi-b = 100²·0.03/5 = 60 mm; the normal one from the read omega2.
    ab = -60.0 * b / abs(b)
    normal = omega2**2 * 0.1 / 5
    n = ab - normal * bc
    ac = meet(0j, 1 + 0j, n, 1j * bc)
    tangential = rule(abs(ac - n))
    wanted_v = {"p-b": 60.0, "p-c": 60.0, "b-c": 31.0, "p-d": rule(abs(pd))}
    assert read("linkages/ex1", 1.0, V) == wanted_v
    got = read("linkages/ex1", 1.0, A)
    assert got["π-b"] == 60.0
    assert got["b-n_CB"] == pytest.approx(normal, rel=1e-12)  # computed, laid off, not read
    assert got["n_CB-c"] == tangential
    assert got["π-c"] == rule(abs(ac))
    results = drawn("linkages/ex1", 1.0).read_off
    assert results("omega_2")[0] == pytest.approx(15.5, rel=1e-14)
    assert results("epsilon_2")[0] == pytest.approx(tangential * 5 / 0.1, rel=1e-14)
    assert results("v_C")[0] == pytest.approx(60 * 0.05)
    assert results("a_C")[0] == pytest.approx(rule(abs(ac)) * 5)
    assert results("v_D")[0] == pytest.approx(rule(abs(pd)) * 0.05)
    # The same for d' of the acceleration plan, from the read b'c'.
    d = ab - 0.3 * rule(abs(ac - ab)) * (ac - ab) / abs(ac - ab)
    assert got["π-d"] == rule(abs(d))


def test_the_normal_component_follows_from_the_read_omega() -> None:
    """Not from the exact one: 15.5² and 15.5334² differ in the third digit."""
    solution = drawn("linkages/ex1", 1.0)

    def length(values: Mapping[Name, Any]) -> float:
        return float(np.ravel(values[NumberName("|a:n_CB|")])[0])

    assert length(solution.ruler_reading.value) == pytest.approx(15.5**2 * 0.1 / 5, rel=1e-14)
    exact = 15.5334111923549**2 * 0.1 / 5
    assert length(solution.paper.value) == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize("step", [1.0, 0.5])
def test_the_third_example(step: float) -> None:
    """Slotted link: BC is read on the drawing, omega3 from pb3, Coriolis from omega3 and b-b3.

    mu_l = 0.002, mu_v = 0.05, mu_a = 1.
    """

    def mark(length: float) -> float:
        return rule(length, step)

    b, c = cmath.rect(32.0, math.radians(20)), -55j
    read_cb = mark(abs(b - c))
    u = (b - c) / abs(b - c)
    # Velocity: pb = 50·0.064/0.05 = 64 mm.
    pb = 64.0 * 1j * b / abs(b)
    pb3 = meet(pb, u, 0j, 1j * u)
    across, along = mark((pb3 * (1j * u).conjugate()).real), mark((pb3 - pb).real / u.real)
    omega3 = across * 0.05 / (read_cb * 0.002)
    sliding = along * 0.05  # v_B3B along CD
    # d beyond b3: pd = read pb3 · 110 / read CB
    pd = pb3 / abs(pb3) * mark(abs(pb3)) * 110 / read_cb
    d = c + 110 * u
    e = d.real + math.sqrt(90.0**2 - d.imag**2)
    w = (e - d) / 90.0
    pe = meet(0j, 1 + 0j, pd, 1j * w)
    omega4 = mark(((pe - pd) * (1j * w).conjugate()).real) * 0.05 / 0.18
    got = read("linkages/ex3", step, V)
    assert got["p-b"] == 64.0
    assert got["p-b3"] == mark(abs(pb3)) == abs(across)
    assert got["b-b3"] == abs(along)
    assert got["p-d"] == pytest.approx(abs(pd), rel=1e-12)  # computed and laid off
    assert got["d-e"] == mark(abs(pe - pd))
    assert got["p-e"] == mark(abs(pe))
    # Acceleration: pi-b = 50²·0.064 = 160 mm.
    ab = -160.0 * b / abs(b)
    k = ab + 2 * omega3 * sliding * 1j * u
    n = -(omega3**2) * read_cb * 0.002 * u
    ab3 = meet(k, u, n, 1j * u)
    epsilon3 = mark(((ab3 - n) * (1j * u).conjugate()).real) / (read_cb * 0.002)
    ad = ab3 / abs(ab3) * mark(abs(ab3)) * 110 / read_cb
    n4 = ad - omega4**2 * 0.18 * w
    ae = meet(0j, 1 + 0j, n4, 1j * w)
    epsilon4 = mark(((ae - n4) * (1j * w).conjugate()).real) / 0.18
    got = read("linkages/ex3", step, A)
    assert got["π-b"] == 160.0
    assert got["b-k_B3B"] == pytest.approx(abs(k - ab), rel=1e-12)  # laid off, not read
    assert got["π-n_B3C"] == pytest.approx(abs(n), rel=1e-12)
    assert got["k_B3B-b3"] == mark(abs(ab3 - k))
    assert got["n_B3C-b3"] == mark(abs(ab3 - n))
    assert got["π-b3"] == mark(abs(ab3))
    assert got["π-d"] == pytest.approx(abs(ad), rel=1e-12)
    assert got["d-n_ED"] == pytest.approx(abs(n4 - ad), rel=1e-12)
    assert got["n_ED-e"] == mark(abs(ae - n4))
    assert got["π-e"] == mark(abs(ae))
    hand = drawn("linkages/ex3", step)
    links = {link: (omega_of(hand, link), epsilon_of(hand, link)) for link in hand.links}
    assert links["3"] == pytest.approx((omega3, epsilon3), rel=1e-12)
    assert links["2"] == links["3"]
    assert links["4"] == pytest.approx((omega4, epsilon4), rel=1e-12)
    assert links["5"] == (0.0, 0.0)
    labels = ("v_B3/2", "ak_B3/2", "ar_B3/2")
    sliding_v, coriolis, relative = (float(hand.read_off(label)[0]) for label in labels)
    assert sliding_v == pytest.approx(abs(sliding))
    assert coriolis == pytest.approx(abs(2 * omega3 * sliding))
    assert relative == pytest.approx(mark(abs(ab3 - k)))


@pytest.mark.parametrize("step", [2.0, 0.5])
def test_a_coincident_point_found_by_similarity(step: float) -> None:
    """H2 of the six-link mechanism: BH is not given, so it is read on the drawing."""
    at = {name: 250 * complex(p["x"], p["y"]) for name, p in SIX_LINK["points"].items()}
    pb = 60.0 * -1j * at["B"] / abs(at["B"])
    pc = meet(pb, 1j * (at["C"] - at["B"]), 0j, 1j * (at["C"] - at["D"]))
    turn = (at["H"] - at["B"]) / (at["C"] - at["B"])
    arm = rule(abs(at["H"] - at["B"]), step) / 75.0
    bc = (pc - pb) / abs(pc - pb) * rule(abs(pc - pb), step)
    h2 = pb + bc * arm * turn / abs(turn)
    h = meet(h2, at["H"] - at["C"], 0j, 1j)
    got = read("levers/six-link", step, V)
    assert got["p-h2"] == rule(abs(h2), step)
    assert got["h2-h"] == rule(abs(h - h2), step)
    assert got["p-h"] == rule(abs(h), step)
    trace = drawn("levers/six-link", step).ruler_reading.value
    assert complex(np.ravel(trace[PointName("v:H2")])[0]) == pytest.approx(h2, rel=1e-9)
    assert complex(np.ravel(trace[PointName("v:H")])[0]) == pytest.approx(h, rel=1e-9)


def test_the_textbooks_numbers_of_the_third_example_come_out() -> None:
    """A ruler of 1 mm gives its BC of 72 mm, its 46 mm of b-b3 and its 160 of a_B."""
    got = read("linkages/ex3", 1.0, PlanKind.POSITION)
    assert got["B-C"] == 72.0
    assert read("linkages/ex3", 1.0, V)["b-b3"] == 46.0
    assert read("linkages/ex3", 1.0, A)["π-b"] == 160.0


def laid_off(name: str, kind: PlanKind) -> set[str]:
    """Return the segments of a plan that are computed: by omega and length, or by similarity."""
    construction = drawn(name, 1.0).construction
    return {
        segment.name
        for segment in construction.segments
        if segment.kind is kind and isinstance(construction.step(segment.length), Compute)
    }


@pytest.mark.parametrize("ruler", [0.1, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("name", SIX)
def test_read_segments_are_marks_of_the_ruler(name: str, ruler: float) -> None:
    """All segments but those computed and laid off: they are known, and are not read."""
    step = Fraction(str(ruler))
    solution = drawn(name, ruler)
    lengths = {(one.kind, one.name): one.length for one in solution.construction.segments}
    for kind in (V, A):
        for segment in solution.segments(kind):
            assert segment.read[0] >= 0
            if segment.name in laid_off(name, kind):
                continue
            # On an enlarged view the marks are closer by its factor.
            read = segment.read[0] * solution.ruler_arithmetic.enlargements.get(
                lengths[kind, segment.name], 1.0
            )
            marks = round(read / ruler)
            assert read == pytest.approx(float(marks * step), abs=1e-12), segment.name


@pytest.mark.parametrize("name", SIX)
def test_the_drawing_is_read_to_half_a_mark(name: str) -> None:
    """Lengths of the links are laid off exactly; lengths read on the drawing are rounded."""
    solution = drawn(name, 0.5)
    given = {
        frozenset((p, q))
        for body in solution.problem.bodies.values()
        for p in body.points
        for q in body.points
    }
    for segment in solution.segments(PlanKind.POSITION):
        assert abs(segment.read[0] - segment.exact[0]) <= 0.25 + 1e-9
        if frozenset(segment.name.split("-")) not in given:
            assert segment.read[0] == rule(float(segment.exact[0]), 0.5), segment.name


@pytest.mark.parametrize("name", SIX)
def test_laid_off_segments_follow_from_the_readings(name: str) -> None:
    """Every normal component is omega²·l/mu with the hand's omega; Coriolis' is 2·omega·v/mu."""
    solution = drawn(name, 1.0)
    mu = solution.scales[A].per_mm
    omega = {link: omega_of(solution, link) for link in solution.links}
    lengths = read(name, 1.0, A)
    for r in solution.construction.kinematics.relatives.values():
        v, k = (float(solution.read_off(r.label(letter))[0]) for letter in ("v", "ak"))
        turning = omega.get(r.to, 0.0)
        assert k == pytest.approx(2 * abs(turning) * v, rel=1e-12, abs=1e-12)
    normals = [value for segment, value in lengths.items() if segment.split("-")[1][:2] == "n_"]
    trace, draft = solution.ruler_reading.value, solution.construction.draft
    read_arms = {
        float(np.ravel(trace[draft.measured_before(p, q)])[0])
        * solution.scales[PlanKind.POSITION].per_mm
        for p, q in draft.read
    }
    arms = {
        link: {
            *(abs(p - q) for p in body.points.values() for q in body.points.values() if p != q),
            *read_arms,
        }
        for link, body in solution.problem.bodies.items()
    }
    for normal in normals:
        able = [omega[link] ** 2 * arm / mu for link in omega for arm in arms[link]]
        assert any(normal == pytest.approx(value, rel=1e-9) for value in able)


@pytest.mark.parametrize("name", SIX)
def test_results_of_the_hand_are_its_segments_times_the_scale(name: str) -> None:
    solution = drawn(name, 0.5)
    for kind, letter in ((V, "v"), (A, "a")):
        mu = solution.scales[kind].per_mm
        lengths = read(name, 0.5, kind)
        pole = "p" if kind is V else "π"
        for point in solution.points:
            value = float(solution.read_off(f"{letter}_{point}")[0])
            length = lengths.get(f"{pole}-{point[0].lower()}{point[1:]}")
            if length is not None:
                assert value == pytest.approx(length * mu, rel=1e-14)


@each("seed", sampled(range(0, some(200, few=80), 4), 3))
def test_a_fine_ruler_reads_the_exact_plan(seed: int) -> None:
    """A ruler of a nanometre gives the exact values: it adds rounding only."""
    problem = loads(random_problem(seed)[0], name=f"random-{seed}")
    fine = Solution(problem, ruler=1e-6)
    margin = float(fine.margin[0])
    v = max(float(abs(p.velocity[0])) for p in fine.points.values())
    a = max([v * v, *(float(abs(p.acceleration[0])) for p in fine.points.values())])
    for name, point in fine.points.items():
        speed, acceleration = (fine.read_off(f"{letter}_{name}")[0] for letter in "va")
        assert abs(speed - abs(point.velocity[0])) <= 1e-5 * v / min(margin, 1.0)
        assert abs(acceleration - abs(point.acceleration[0])) <= 1e-5 * a / min(margin, 1.0)


@pytest.mark.parametrize("name", SIX)
def test_signs_of_the_hand_are_those_of_the_exact_plan(name: str) -> None:
    solution = drawn(name, 0.5)
    for link, exact in solution.links.items():
        assert np.sign(omega_of(solution, link)) == np.sign(exact.omega[0])
        assert np.sign(epsilon_of(solution, link)) == np.sign(exact.epsilon[0])


def test_a_ruler_does_not_change_the_exact_plan() -> None:
    fine, coarse = drawn("linkages/ex3", 0.1), drawn("linkages/ex3", 5.0)
    for kind in MOTION:
        for one, two in zip(fine.segments(kind), coarse.segments(kind), strict=True):
            assert (one.name, *one.exact) == (two.name, *two.exact)


def test_several_positions_are_read_one_by_one() -> None:
    positions = [20.0, 45.0, 200.0]
    problem = problem_of("linkages/ex3")
    batch = Solution(problem, positions=positions)
    for i, phi in enumerate(positions):
        one = Solution(problem, positions=[phi])
        for kind in MOTION:
            for many, single in zip(batch.segments(kind), one.segments(kind), strict=True):
                assert (many.exact[i], many.read[i]) == (single.exact[0], single.read[0])
        for label in (f"{rate}_{link}" for rate in ("omega", "epsilon") for link in batch.links):
            assert batch.read_off(label)[i] == one.read_off(label)[0]
