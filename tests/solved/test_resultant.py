"""One force of inertia: the same reactions from a shifted line, and where it cannot be drawn."""

from __future__ import annotations

from collections import Counter
from functools import cache

import numpy as np
import pytest
from cases import each, some
from doors import (
    Complexes,
    GivenLoad,
    Hindrance,
    LoadKind,
    NumberName,
    PlanKind,
    PointName,
    ReadingReals as Reals,
    Shift,
    Solution,
    Statics,
    drawn_forces,
    problem_loads as loads,
    size_label,
)
from full_system import cross
from loaded import loaded_problem, with_resultant
from mechanisms import CRANK, SLIDER
from newton import solve as newton
from worked import problem_of

SEEDS = range(some(200, few=25))
LIMIT = 1e-9

SHIPPED = ("levers/six-link", "levers/task12", "press/press", "press/press-stone")
AWAY = {
    "levers/six-link": [140.0, 150.0, 160.0],
    "levers/task12": [5.0 + 30.0 * k for k in range(12)],
    "press/press": [8.918918918919 + 30.0 * k for k in range(12)],
    "press/press-stone": [8.918918918919 + 30.0 * k for k in range(12)],
}


@cache
def both(which: int | str) -> tuple[Statics, Statics]:
    """Return the statics with couples of inertia, and those with single forces."""
    problem = loaded_problem(which)[0] if isinstance(which, int) else problem_of(which)
    positions = AWAY[which] if isinstance(which, str) else None
    one, other = problem, with_resultant(problem)
    return (
        Statics(Solution(one, positions=positions)),
        Statics(Solution(other, positions=positions)),
    )


def place(statics: Statics, point: PointName) -> Complexes:
    return statics.si.point(point)


def number(statics: Statics, name: NumberName) -> Reals:
    return statics.si.number(name)


def of_kind(statics: Statics, kind: LoadKind) -> dict[str, GivenLoad]:
    """Return the loads of a kind by their links."""
    return {g.applied.link: g for g in statics.board.given if g.applied.kind is kind}


def single(text: str, base: str) -> Statics:
    """Return the statics of a mechanism with more text and a single resultant inertia force."""
    return Statics(Solution(loads(f"{base}[dynamics]\nresultant = true\n{text}", name="one")))


# The same forces ---------------------------------------------------------------------------------


@each("which", [*SHIPPED, *SEEDS])
def test_reactions_and_balance_are_those_with_couples(which: int | str) -> None:
    couples, shifted = both(which)
    big = max(float(np.max(np.abs(r.force))) for r in couples.reactions)
    for one, other in zip(couples.reactions, shifted.reactions, strict=True):
        assert (one.joint, one.on, one.by) == (other.joint, other.on, other.by)
        assert np.max(np.abs(one.force - other.force)) <= LIMIT * big
        assert np.max(np.abs(one.moment - other.moment)) <= LIMIT * big
    size = float(np.max(np.abs(couples.balance)))
    assert np.max(np.abs(couples.balance - shifted.balance)) <= LIMIT * size
    assert shifted.lever is not None
    assert np.max(np.abs(shifted.lever - shifted.balance)) <= LIMIT * size


@each("which", [*SHIPPED, *SEEDS])
def test_the_force_turns_about_the_centre_as_the_couple_does(which: int | str) -> None:
    """T is across the force from S; the couple is not among the loads any more."""
    couples, shifted = both(which)
    moments = of_kind(couples, LoadKind.INERTIA_COUPLE)
    acting = of_kind(shifted, LoadKind.INERTIA)
    left = set(of_kind(shifted, LoadKind.INERTIA_COUPLE))
    shifts = shifted.board.shifts
    assert left == set(moments) - set(shifts)
    assert {one.link for one in shifted.unshifted} <= left
    for link, shift in shifts.items():
        force = acting[link]
        assert force.force is not None and force.force.at == shift.at
        vector = place(shifted, force.force.head) - place(shifted, force.force.tail)
        arm = place(shifted, shift.at) - place(shifted, shift.centre)
        size = np.max(np.abs(moments[link].applied.couple)) + np.max(np.abs(vector * arm))
        assert np.max(np.abs(cross(arm, vector) - moments[link].applied.couple)) <= LIMIT * size
        assert np.max(np.abs((np.conj(arm) * vector).real)) <= LIMIT * size


def test_links_of_all_dyads_and_drivers_have_their_force_shifted() -> None:
    seen: Counter[str] = Counter()
    for seed in SEEDS:
        statics = both(seed)[1]
        groups = {link: g.signature for g in statics.solution.structure.groups for link in g.links}
        seen.update(groups.get(link, "driver") for link in statics.board.shifts)
        seen.update(one.hindrance.value for one in statics.unshifted)
    kinds = ["RRR", "RRP", "PRP", "RPR", "RPP", "driver", *(why.value for why in Hindrance)]
    assert {kind: seen[kind] for kind in kinds if seen[kind] < some(20, few=2)} == {}


@each("seed", SEEDS[::10])
def test_on_the_lever_the_force_acts_at_the_velocity_of_its_point(seed: int) -> None:
    """The velocity of T as a point of its link, from Newton's motion."""
    problem, pose = loaded_problem(seed)
    statics = both(seed)[1]
    assert statics.lever_plan is not None
    motion = newton(problem, problem.drive.positions[0], pose)
    for hung in statics.lever_plan.loads:
        given, at = hung.load, hung.at
        shift = statics.board.shifts.get(given.applied.link)
        if shift is None or given.force is None or given.force.at != shift.at:
            continue
        assert at is not None and given.applied.point is not None
        link, point = given.applied.link, given.applied.point
        arm = place(statics, shift.at)[0] - place(statics, shift.centre)[0]
        velocity = motion.velocity[link, point] + 1j * motion.omega[link] * arm
        found = place(statics, at)[0] - place(statics, statics.lever_plan.pole)[0]
        assert abs(found - 1j * velocity) <= LIMIT * max(1.0, abs(velocity))


# By hand -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["levers/six-link", "press/press"])
def test_the_hand_lays_off_its_computed_lengths_and_reads_other_numbers(name: str) -> None:
    couples, shifted = both(name)
    solution = shifted.solution
    (shift,) = shifted.board.shifts.values()
    dynamics = solution.problem.dynamics
    assert dynamics is not None
    mass = dynamics.masses[shift.link]
    assert mass.centre is not None
    acceleration = solution.read_off(f"a_{mass.centre}")
    epsilon = solution.read_off(f"epsilon_{shift.link}")
    metres = mass.inertia * np.abs(epsilon) / (mass.mass * acceleration)
    laid = np.abs(shifted.ruler_reading.number(shift.length))
    per_mm = solution.scales[PlanKind.POSITION].per_mm
    assert laid * per_mm == pytest.approx(metres, rel=1e-12)
    one, other = drawn_forces(couples), drawn_forces(shifted)
    apart = np.abs(one.read("lever") - other.read("lever"))
    assert np.any(apart > 0)
    spread = np.abs(couples.balance) * 0.2 + 3.0 * np.asarray(other.discrepancy_sigma)
    assert np.all(apart <= spread)


@pytest.mark.parametrize("which", [*SHIPPED, *SEEDS[::20]])
def test_sigmas_are_finite_and_of_the_same_order(which: int | str) -> None:
    couples, shifted = both(which)
    one, other = drawn_forces(couples).discrepancy_sigma, drawn_forces(shifted).discrepancy_sigma
    assert one is not None and other is not None
    assert np.all(np.isfinite(other))
    assert np.all(other < 5.0 * one)
    for joint in shifted.reactions:
        assert np.all(np.isfinite(drawn_forces(shifted).spreads[size_label(joint)].sigma))


def test_the_predicted_sigma_is_that_of_random_sheets() -> None:
    statics = both("press/press")[1]
    told = drawn_forces(statics).discrepancy_sigma
    assert told is not None
    for index in (0, 4, 7):
        drawn = drawn_forces(statics).sample(index, draws=4000)["difference"]
        low, high = np.percentile(drawn, [15.87, 84.13])
        sigma = float(told[index])
        assert (high - low) / 2 == pytest.approx(sigma, rel=0.08)


# Without a resultant -----------------------------------------------------------------------------


def reasons(statics: Statics) -> dict[str, Hindrance]:
    return {one.link: one.hindrance for one in statics.unshifted}


def test_shipped_problems_that_keep_couples() -> None:
    assert reasons(both("levers/six-link")[1]) == {"1": Hindrance.NO_FORCE, "3": Hindrance.NO_FORCE}
    task = both("levers/task12")[1]
    assert reasons(task) == {"1": Hindrance.NO_FORCE, "3": Hindrance.TOO_LONG}
    assert task.board.shifts == {}
    assert reasons(both("press/press")[1]) == {}
    far = next(one for one in task.unshifted if one.hindrance is Hindrance.TOO_LONG)
    couple = of_kind(task, LoadKind.INERTIA_COUPLE)["3"].applied.couple
    force = of_kind(task, LoadKind.INERTIA)["3"].applied.force
    expected = np.max(np.abs(couple) / np.abs(force))
    assert far.reach == pytest.approx(expected)
    assert far.reach > 0.35  # |D S3|, the largest length


def test_shifts_that_are_not_requested_are_not_reported() -> None:
    couples = both("levers/six-link")[0]
    assert (couples.unshifted, couples.board.shifts) == ((), {})


ROD = '[dynamics.links.2]\nmass = 4\ncentre = "{}"\ninertia = 0.01\n'


def test_a_centre_of_mass_without_acceleration_is_no_dead_position() -> None:
    """The pin of a slider that is driven evenly: the rod turns unevenly about it."""
    statics = single(ROD.format("C"), SLIDER)
    assert reasons(statics) == {"2": Hindrance.FAINT}
    assert all(np.all(np.isfinite(r.force)) for r in statics.reactions)
    couple = of_kind(statics, LoadKind.INERTIA_COUPLE)["2"].couple
    assert couple is not None
    assert np.all(np.abs(number(statics, couple)) > 1e-4)


def test_an_acceleration_that_the_ruler_does_not_see_is_no_divisor() -> None:
    scales = "[scales]\nmu_a = {}\n"
    fine = single(ROD.format("S2") + scales.format("0.5"), CRANK)
    assert list(fine.board.shifts) == ["2"]
    coarse = single(ROD.format("S2") + scales.format("100"), CRANK)
    assert reasons(coarse) == {"2": Hindrance.FAINT}
    assert np.all(np.isfinite(drawn_forces(coarse).read("balance")))


def test_one_position_takes_the_shift_from_all() -> None:
    """ε over a of S2 is 5.22 1/m at 90 degrees: with J/m = 0.075 m² h is 0.39 m, and BC 0.3 m."""
    text = ROD.format("S2").replace("0.01", "0.3") + "[dynamics]\nresultant = true\n"
    problem = loads(CRANK + text, name="one")
    kept: dict[tuple[float, ...], dict[str, Hindrance]] = {}
    for positions in ((0.0, 30.0), (90.0,), (0.0, 30.0, 90.0)):
        statics = Statics(Solution(problem, positions=positions))
        kept[positions] = reasons(statics)
        assert set(statics.board.shifts) == {"2"} - set(kept[positions])
    assert kept == {
        (0.0, 30.0): {},
        (90.0,): {"2": Hindrance.TOO_LONG},
        (0.0, 30.0, 90.0): {"2": Hindrance.TOO_LONG},
    }


def test_a_crank_is_shifted_when_it_turns_unevenly() -> None:
    crank = '[dynamics.links.1]\nmass = 3\ncentre = "B"\ninertia = 0.05\n'
    even = single(crank, CRANK)
    assert (even.board.shifts, even.unshifted) == ({}, ())
    uneven = CRANK.replace("omega = 10", "omega = 10\nepsilon = 40")
    statics = single(crank, uneven)
    length = np.abs(number(statics, statics.board.shifts["1"].length))
    assert length == pytest.approx(0.05 * 40 / (3 * np.hypot(0.1 * 100, 0.1 * 40)))


def test_links_that_do_not_turn_and_drivers_at_rest_have_no_couple_to_shift() -> None:
    slider = "[dynamics.links.3]\nmass = 3\ninertia = 5\n"
    assert single(slider, CRANK).unshifted == ()
    stands = single(ROD.format("S2"), CRANK.replace("omega = 10", "omega = 0"))
    assert (stands.board.shifts, stands.unshifted) == ({}, ())


def test_the_point_has_a_letter_of_its_own() -> None:
    shift: Shift = single(ROD.format("S2"), CRANK).board.shifts["2"]
    assert shift.letter == "T_{2}"
    taken = CRANK.replace("S2", "T2")
    assert single(ROD.format("T2"), taken).board.shifts["2"].letter == "T_{2'}"
