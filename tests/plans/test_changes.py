"""Change points: a warning where they are passed, and a branch of the motion kept on request."""

from __future__ import annotations

import math
import random
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from cases import some
from doors import (
    ModelProblem as Problem,
    PointName,
    Precise,
    ProblemError,
    Solution,
    Sweep,
    changed_branches,
    evaluate_evaluate as evaluate,
    problem_load as load,
    problem_loads as loads,
    read_parsed,
    sweep_variants,
    verify,
)

C = PointName("C")
CASES = Path(__file__).parents[1] / "data" / "cases"

FOUR_BAR = """
[frame]
A = [0.3, -0.2]
K = {k}
[links.1]
points = ["A", "B"]
AB = {ab!r}
[links.2]
points = ["B", "C", "E"]
BC = {bc!r}
E = {{ on = "BC", at = 0.1, across = 0.07 }}
[links.3]
points = ["K", "C"]
KC = {kc!r}
[driver]
link = "1"
phi = {phi!r}
omega = 10
[assembly]
C = {rule}
"""

SLIDER_CRANK = """
[frame]
A = [0, 0]
guides.g = {{ through = "A", angle = {angle!r} }}
[links.1]
points = ["A", "B"]
AB = {ab!r}
[links.2]
points = ["B", "C"]
BC = {ab!r}
[links.3]
points = ["C"]
slides = {{ on = "g" }}
[driver]
link = "1"
phi = {phi!r}
omega = 10
[assembly]
C = {rule}
"""


def four_bar(seed: int, rule: str, *, parallel: bool = False) -> tuple[Problem, list[float]]:
    """Return a four-bar with l1 + l0 = l2 + l3 or the like, and its change points in a turn."""
    rng = random.Random(seed)
    crank, wide = sorted(rng.uniform(0.1, 0.5) for _ in range(2))
    if parallel:
        frame, coupler, rocker, at = wide, wide, crank, [0.0, 180.0]
    elif seed % 2:
        coupler = rng.uniform(crank, wide)
        frame, rocker, at = wide, crank + wide - coupler, [180.0]  # A beyond B and K
    else:
        coupler, frame = crank + rng.uniform(0.05, 0.3), wide
        rocker, at = coupler + frame - crank, [0.0]
    turned = rng.uniform(-180, 180)
    k = 0.3 - 0.2j + frame * complex(math.cos(math.radians(turned)), math.sin(math.radians(turned)))
    phi = turned + rng.choice((60.0, -75.0, 110.0))
    text = FOUR_BAR.format(k=[k.real, k.imag], ab=crank, bc=coupler, kc=rocker, phi=phi, rule=rule)
    return loads(text, name="four-bar"), [(turned + x - phi) % 360 + phi for x in at]


def omegas(problem: Problem, positions: npt.ArrayLike) -> npt.NDArray[np.float64]:
    solution = Solution(problem, positions=np.asarray(positions, dtype=float).tolist())
    verify(solution)
    return np.asarray(solution.links["3"].omega if "3" in solution.links else 0.0)


def rule_of(seed: int, keep: str = "") -> str:
    side = "left" if random.Random(-seed).random() < 0.5 else "right"
    return f'{{ rule = "{side} of BK"{keep} }}'


@pytest.mark.parametrize("seed", range(8))
def test_a_passed_change_point_is_reported_with_its_angle(seed: int) -> None:
    problem, at = four_bar(seed, rule_of(seed))
    (start,) = problem.drive.positions
    inside = [place for place in at if start < place < start + 359]
    assert len(inside) == len(at)
    asked = [start, max(at) + 5]
    (said,) = map(str, changed_branches(Solution(problem, positions=asked)))
    for place in inside:
        told = [float(x) for x in said.partition("phi = ")[2].partition(" deg")[0].split(" and ")]
        assert min(abs(x - place) for x in told) < 2e-4
    assert changed_branches(Solution(problem, positions=[start, min(at) - 5])) == []
    assert changed_branches(Solution(problem)) == []


def test_a_mechanism_without_change_points_gives_no_warning() -> None:
    for seed in range(8):
        problem, _ = four_bar(seed, rule_of(seed))
        text = FOUR_BAR.format(
            k=[0.7, -0.1], ab=0.1, bc=0.3 + 0.01 * seed, kc=0.3, phi=20.0, rule=rule_of(seed)
        )
        problem = loads(text, name="crank-rocker")
        assert changed_branches(Solution(problem, positions=[20.0, 380.0])) == []


@pytest.mark.parametrize("parallel", [False, True])
@pytest.mark.parametrize("seed", range(8))
def test_a_continuous_motion_has_no_jump_where_a_kept_side_has_one(
    seed: int, parallel: bool
) -> None:
    kept, at = four_bar(seed, rule_of(seed), parallel=parallel)
    smooth, _ = four_bar(seed, rule_of(seed, ', keep = "continuous"'), parallel=parallel)
    assert omegas(kept, kept.drive.positions) == omegas(smooth, smooth.drive.positions)
    for place in at:
        around = [place - 0.02, place + 0.02]
        (before, after), (one, other) = omegas(smooth, around), omegas(kept, around)
        assert abs(after - before) < 0.01 * abs(other - one)


@pytest.mark.parametrize("seed", range(6))
def test_a_parallelogram_stays_one_and_goes_on_where_continuous_does(seed: int) -> None:
    problem, at = four_bar(seed, '{ keep = "parallel" }', parallel=True)
    around = [place + off for place in at for off in (-100.0, -20.0, -0.5, 0.5, 20.0, 100.0)]
    solution = Solution(problem, positions=around)
    verify(solution)
    motion = {name: solution.points[name].place for name in "ABCK"}
    drawn = motion["C"] - motion["K"] - motion["B"] + motion["A"]
    assert np.abs(drawn).max() < 1e-15
    assert solution.links["3"].omega == pytest.approx(10.0, rel=1e-9)
    assert changed_branches(solution) == []


@pytest.mark.parametrize("seed", range(some(6, few=2)))
def test_all_readings_of_a_position_agree_alone_and_together(seed: int) -> None:
    keep = ', keep = "continuous"'
    for problem, at in (
        four_bar(seed, rule_of(seed, keep)),
        four_bar(seed, rule_of(seed, keep), parallel=True),
        four_bar(seed, '{ keep = "parallel" }', parallel=True),
    ):
        asked = [place + off for place in at for off in (-710.0, -50.0, 9.0, 80.0, 370.0)]
        together = Solution(problem, positions=asked)
        swept = Sweep(problem, ["C", "omega_3"]).run(asked)
        assert swept[2] == pytest.approx(together.links["3"].omega, rel=1e-9)
        whole = Sweep(problem, ["C"]).run(np.repeat(asked, 30))  # in blocks, not in a line
        assert whole[0] == pytest.approx(np.repeat(together.points["C"].place.real, 30), abs=1e-14)
        for i, position in enumerate(asked):
            alone = Solution(problem, positions=[position])
            assert alone.points["C"].place[0] == together.points["C"].place[i]
            right = alone.construction.program.needed_for([C])
            data = {name: np.ravel(v)[0] for name, v in alone.data().items()}
            referee = Precise()
            read = evaluate(right, {n: referee.lift(v) for n, v in data.items()}, referee)
            place = complex(read.value[C]) + alone.construction.draft.origin
            assert abs(place - alone.points["C"].place[0]) < 1e-12
            hand = alone.ruler_reading.value[C] * alone.per_mm["mu_l"]
            assert abs(complex(np.ravel(hand)[0]) - place) < 1e-12


def test_one_change_point_in_a_turn_brings_the_branch_back_after_two() -> None:
    problem, at = four_bar(1, rule_of(1, ', keep = "continuous"'))
    assert len(at) == 1
    (start,) = problem.drive.positions
    places = Solution(problem, positions=[start + 360 * n for n in range(-2, 3)]).points["C"].place
    other = abs(places[1] - places[2])
    assert other > 0.01
    assert abs(places - places[2]) == pytest.approx([0, other, 0, other, 0], abs=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_a_slider_crank_of_equal_links_goes_through_its_pivot(seed: int) -> None:
    rng = random.Random(seed)
    angle, ab = rng.uniform(-180, 180), rng.uniform(0.05, 0.4)
    way = complex(math.cos(math.radians(angle)), math.sin(math.radians(angle)))
    near = 2 * ab * math.cos(math.radians(30)) * way
    given = {"angle": angle, "ab": ab, "phi": angle + 30}
    rule = f"{{ near = [{near.real!r}, {near.imag!r}]"
    smooth = loads(SLIDER_CRANK.format(rule=rule + ', keep = "continuous" }', **given), name="s")
    kept = loads(SLIDER_CRANK.format(rule=rule + " }", **given), name="s")
    asked = np.array([30.0, 80.0, 100.0, 200.0, 265.0, 275.0, 330.0, 700.0])
    places = Solution(smooth, positions=(angle + asked).tolist()).points["C"].place
    assert np.abs(places - 2 * ab * np.cos(np.radians(asked)) * way).max() < 1e-12
    (said,) = map(str, changed_branches(Solution(kept, positions=(angle + asked).tolist())))
    assert "links 2, 3 pass a change point" in said and 'keep = "continuous"' in said
    assert changed_branches(Solution(smooth, positions=(angle + asked).tolist())) == []


def test_a_pin_passing_through_the_pivot_of_its_slotted_link_is_reported() -> None:
    text = (CASES / "arm-nothing.toml").read_text("utf-8").replace("0.1005", "0.1")
    problem = loads(text.replace("phi = 0", "phi = 300"), name="through")
    (said,) = map(str, changed_branches(Solution(problem, positions=[420.0])))
    assert "links 2, 3 pass a change point at phi = 360 deg" in said
    assert "[assembly]" not in said


def test_the_parallelogram_of_the_cases() -> None:
    problem = load(CASES / "parallelogram.toml")
    assert omegas(problem, [170.0, 190.0]) == pytest.approx([20.0, -10.0], abs=0.1)
    (said,) = map(str, changed_branches(Solution(problem, positions=[170.0, 190.0])))
    assert "links 2, 3 pass a change point at phi = 180 deg" in said
    assert 'C = { keep = "parallel" }' in said and 'keep = "continuous"' in said
    text = (CASES / "parallelogram.toml").read_text("utf-8")
    for rule in ('keep = "parallel"', 'near = [0.35, 0.0866], keep = "continuous"'):
        kept = loads(text.replace("near = [0.35, 0.0866]", rule), name="parallelogram")
        assert omegas(kept, [170.0, 190.0]) == pytest.approx([20.0, 20.0], rel=1e-12)


# Faults -------------------------------------------------------------------------------------------


def faulty(problem: Problem) -> str:
    with pytest.raises(ProblemError) as caught:
        Solution(problem)
    (fault,) = caught.value.faults
    return str(fault)


def test_a_linkage_that_is_not_a_parallelogram_cannot_be_kept_parallel() -> None:
    text = FOUR_BAR.format(
        k=[0.7, -0.2], ab=0.1, bc=0.41, kc=0.1, phi=20.0, rule='{ keep = "parallel" }'
    )
    assert faulty(loads(text, name="near")) == (
        "assembly.C.keep: the opposite sides of a parallelogram are equal, but here AB = "
        "0.1 m and KC = 0.1 m; AK = 0.4 m and BC = 0.41 m. Correct the lengths, or give "
        'keep = "continuous" with a rule for the required assembly'
    )
    text = SLIDER_CRANK.format(angle=0, ab=0.1, phi=30, rule='{ keep = "parallel" }')
    assert faulty(loads(text, name="slider")) == (
        "assembly.C.keep: links 2, 3 are not two sides of a quadrilateral of four joints. "
        'Omit keep = "parallel", and give a rule for the required assembly'
    )


def test_a_slotted_link_keeps_its_side() -> None:
    text = (CASES / "arm-nothing.toml").read_text("utf-8")
    rule = 'D = { rule = "left of C", keep = "continuous" }'
    assert faulty(loads(text.replace('D = "left of C"', rule), name="slotted")) == (
        "assembly.D.keep: links 2, 3 close by a slotted link, which keeps its side. Omit keep = "
        '"continuous"'
    )


def test_lengths_move_the_change_points() -> None:
    """A motion that continues through change points has those of its own lengths."""
    problem, _ = four_bar(1, rule_of(1, ', keep = "continuous"'))
    other, _ = four_bar(3, rule_of(3, ', keep = "continuous"'))
    at = np.linspace(0.0, 700.0, 60)
    _, found = sweep_variants([problem, other], at)
    for k, one in enumerate((problem, other)):
        alone = Sweep(one).run(at)
        assert found[:, k] == pytest.approx(alone, rel=1e-9, abs=1e-9, nan_ok=True)
    given = {
        **problem.source_table,
        "links": {**problem.source_table["links"], "2": dict(problem.source_table["links"]["2"])},
    }
    given["links"]["2"]["BC"] *= 1.004
    moved = Sweep(read_parsed(given, source="x", name="x"), ["C", "v_C"]).run(at)
    swept = Sweep(problem, ["C", "v_C"], varied=["l_BC"])
    found = swept.run(at, {"l_BC": 1.004 * swept.parameters["l_BC"]})
    assert found == pytest.approx(moved, rel=1e-9, abs=1e-9, nan_ok=True)
