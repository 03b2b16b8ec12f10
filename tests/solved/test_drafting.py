"""Drafting errors: first order against random sheets, and against geometry."""

from __future__ import annotations

import math
import re
from functools import cache
from inspect import signature
from pathlib import Path

import numpy as np
import pytest
from doors import (
    DRAFTING_PROFILES as PROFILES,
    DRAWS,
    MAX_MARGIN_SIGMA,
    SPREAD_SHORT as SHORT,
    Builder,
    Counted,
    Drafting,
    DrawnKind,
    Float64,
    PlanKind,
    Profile,
    Program,
    Propagated,
    Sampled,
    Scales,
    Solution,
    UnknownItemError,
    as_dual,
    causes_of,
    drafting_of,
    drawn_forces,
    evaluate_evaluate as evaluate,
    problem_load as load,
    problem_loads as loads,
    root_of,
    statics_of,
)
from msgspec.structs import replace
from worked import PROBLEMS, SIX, problem_of

ROOT = Path(__file__).parents[2]
DOCS = (ROOT / "docs" / "explanation" / "drafting-errors.md").read_text("utf-8")
CASES = ROOT / "tests" / "data" / "cases"


@cache
def drawn(name: str, profile: str) -> Solution:
    return Solution(problem_of(name), profile=PROFILES[profile])


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("name", SIX)
def test_first_order_agrees_with_random_sheets(name: str, profile: str) -> None:
    """Wherever a result is longer than three sigmas and first order is not given up."""
    drafting = drafting_of(drawn(name, profile))
    sheets = drafting.sample(0, draws=DRAWS, seed=11)
    compared = 0
    for label, spread in drafting.spreads.items():
        sigma = float(spread.sigma[0])
        values = sheets[label]
        short = drafting.items[label].kind is DrawnKind.LENGTH and values.mean() < SHORT * sigma
        if sigma == 0 or short or spread.drawn[0]:
            continue
        compared += 1
        assert 0.9 < sigma / float(np.std(values)) < 1.1, label
    if (name, profile) != ("levers/six-link", "coarse"):  # its arcs meet too flatly for that hand
        assert compared > 0.8 * sum(s.sigma[0] > 0 for s in drafting.spreads.values())


def test_twelve_positions_too() -> None:
    problem = load(PROBLEMS / "linkages/ex3.toml")
    solution = Solution(problem, positions=list(range(0, 360, 30)))
    drafting = drafting_of(solution)
    checked = given_up = 0
    for i in range(12):
        sheets = drafting.sample(i, draws=DRAWS, seed=5)
        for label, spread in drafting.spreads.items():
            sigma = float(spread.sigma[i])
            if spread.drawn[i]:
                given_up += 1
            elif sigma > 0:
                checked += 1
                assert 0.9 < sigma / float(np.std(sheets[label])) < 1.1, (i, label)
    assert checked > 500
    assert 0 < given_up < checked / 10  # near the poles of a plan segments get short


@pytest.mark.parametrize("name", ["linkages/ex3", "press/press"])
def test_where_first_order_is_given_up_sigma_is_that_of_the_sheets(name: str) -> None:
    """The fine ruler here rounds no length: the quantiles of rounded lengths jump."""
    solution = Solution(problem_of(name), positions=list(range(0, 360, 30)), ruler=1e-6)
    drafting = Drafting(solution, draws=4000, seed=3)
    found = []
    for label, spread in drafting.spreads.items():
        for i in np.flatnonzero(spread.drawn):
            low, high = np.quantile(drafting.sample(int(i))[label], [0.158655, 0.841345])
            found.append(spread.sigma[i] / ((high - low) / 2))
    assert len(found) >= 15
    assert max(np.abs(np.log(found))) < 0.1


def test_errors_are_spread_alike_for_any_rotation_of_the_eigenvectors(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The last bit decides their signs, and any turn where two eigenvalues are equal."""
    luck = np.random.default_rng(3)
    slopes = luck.normal(size=(3, 4, 9))
    slopes[1, 2:] = slopes[1, :2]  # of rank 2
    spread = slopes @ np.swapaxes(slopes, 1, 2)
    spread[2] = np.eye(4)
    roots = root_of(spread)
    assert roots @ roots == pytest.approx(spread, abs=1e-9)
    solve = np.linalg.eigh

    def turned(matrices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        size, ways = solve(matrices)
        ways[0] *= [1, -1, -1, 1]
        ways[2] = ways[2] @ np.linalg.qr(luck.normal(size=(4, 4)))[0]
        return size, ways

    monkeypatch.setattr(np.linalg, "eigh", turned)
    assert root_of(spread) == pytest.approx(roots, abs=1e-12)


# Single strokes -----------------------------------------------------------------------------------

PROFILE = Profile("test", 0.2, 0.3, 0.15, 0.5, 0.5)
FREE = frozenset({"P", "Q"})


def sigma_of(program: Program, out: str, **data: complex | float) -> complex:
    """Sigmas of the two coordinates of a point, as one complex number."""
    counted = Counted(PROFILE, FREE)
    evaluate(program, data, counted)
    pencil = Propagated(PROFILE, FREE, counted.causes)
    value = as_dual(evaluate(program, data, pencil).value[out])  # type: ignore[index]
    assert value.slope is not None
    slope = value.slope[:, 0]
    return complex(math.sqrt(float((slope.real**2).sum())), math.sqrt(float((slope.imag**2).sum())))


@pytest.mark.parametrize("name", SIX)
def test_the_number_of_errors_depends_only_on_the_steps_and_free_points(name: str) -> None:
    """The number is the same in a position that cannot be assembled as in one that can."""
    drawing = drafting_of(drawn(name, "board")).drawing
    data = drawing.data(np.zeros(1, dtype=int))
    nowhere = {key: np.asarray(value) * math.nan for key, value in data.items()}
    for free in (drawing.free, frozenset[str]()):
        counts = set()
        for profile, given in (("cad", data), ("board", data), ("board", nowhere)):
            counted = Counted(PROFILES[profile], free)
            evaluate(drawing.program, given, counted)
            counts.add(counted.causes)
        assert counts == {causes_of(drawing.program, lambda: data, free)}


def test_a_length_laid_off_along_a_line_at_an_angle() -> None:
    b = Builder()
    p, angle, length = b.take_point("P"), b.known("angle"), b.known("length")
    b.lay_off_length("X", p, b.at_angle(p, None, angle), length)
    sigma = sigma_of(b.program(), "X", P=0j, angle=0.0, length=80.0)
    assert sigma.real == pytest.approx(PROFILE.lay_off)
    turned = 80.0 * math.radians(PROFILE.parallel)
    assert sigma.imag == pytest.approx(math.hypot(turned, PROFILE.point))


def test_a_read_length() -> None:
    b = Builder()
    p, q = b.take_point("P"), b.take_point("Q")
    b.measure("pq", p, q)
    sigma = sigma_of(b.program(), "pq", P=0j, Q=40 + 30j).real
    assert sigma == pytest.approx(math.hypot(PROFILE.measure, PROFILE.ruler / math.sqrt(12)))


def test_the_error_of_a_line_through_two_points_depends_on_its_length() -> None:
    b = Builder()
    p, q, length = b.take_point("P"), b.take_point("Q"), b.known("length")
    b.lay_off_length("X", p, b.join(p, q), length)
    sigma = sigma_of(b.program(), "X", P=0j, Q=40 + 0j, length=120.0)
    # Turned by either end, three times as far as they are apart; and pricked beside the line.
    assert sigma.imag == pytest.approx(PROFILE.point * math.sqrt(3**2 + 3**2 + 1), rel=1e-9)


@pytest.mark.parametrize("gamma", [90.0, 45.0, 30.0, 20.0, 10.0])
def test_lines_that_meet_at_an_angle(gamma: float) -> None:
    """Sigma along line 1: sqrt(s2² + s1²·cos²γ)/sin γ, and the prick of the point."""
    b = Builder()
    p, q = b.take_point("P"), b.take_point("Q")
    zero, angle = b.known("zero"), b.known("angle")
    b.intersect_lines("X", b.at_angle(p, None, zero), b.at_angle(q, None, angle))
    g, t1, t2 = math.radians(gamma), 60.0, 40.0
    data: dict[str, complex | float] = {
        "P": 0j, "Q": t1 - t2 * complex(math.cos(g), math.sin(g)), "zero": 0.0, "angle": gamma,
    }  # fmt: skip
    sigma = sigma_of(b.program(), "X", **data)
    turn = math.radians(PROFILE.parallel)
    s1, s2 = (math.hypot(PROFILE.point, t * turn) for t in (t1, t2))
    along = math.sqrt(s2**2 + (s1 * math.cos(g)) ** 2) / math.sin(g)
    assert sigma.real == pytest.approx(math.hypot(along, PROFILE.point), rel=1e-9)
    assert sigma.imag == pytest.approx(math.hypot(s1, PROFILE.point), rel=1e-9)


def test_no_laid_off_value_has_an_error() -> None:
    b = Builder()
    p, angle, length = b.take_point("P"), b.known("angle"), b.known("length")
    b.lay_off_length("X", p, b.at_angle(p, None, angle), length)
    data: dict[str, complex | float] = {"P": 0j, "angle": 0.0, "length": 0.0}
    sampled = Sampled(PROFILE, FREE, 50, 1)
    found = evaluate(b.program(), data, sampled).value
    assert np.all(found["X"].real == 0)  # type: ignore[index]


def test_a_drawing_without_errors_is_the_exact_plan() -> None:
    still = Profile("still", 0.0, 0.0, 0.0, 0.0, 1e-9)
    solution = Solution(problem_of("linkages/ex3"), profile=still)
    sheets = drafting_of(solution).sample(0, draws=3)
    exact = {s.name: s.exact[0] for s in solution.segments(PlanKind.VELOCITY)}
    for name, value in exact.items():
        assert sheets[f"velocity.{name}"] == pytest.approx([value] * 3, abs=1e-7)
    counted = Counted(still)
    trace = evaluate(
        solution.construction.program,
        {**solution.data(solution.per_mm, np.array([0]))},
        counted,
    )
    assert counted.causes > 80
    for point in solution.points:
        if point in trace.value:
            exact_place = evaluate(
                solution.construction.program,
                {**solution.data(solution.per_mm, np.array([0]))},
                Float64(),
            ).value[point]  # type: ignore[index]
            assert trace.value[point] == pytest.approx(exact_place)  # type: ignore[index]
            break


# Together -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["linkages/ex3", "levers/six-link", "press/press"])
def test_covariance_agrees_with_random_sheets(name: str) -> None:
    drafting = drafting_of(drawn(name, "cad"))
    labels = [label for label in drafting.items if label.startswith(("v_", "omega_"))]
    labels = [label for label in labels if drafting.spreads[label].sigma[0] > 0][:6]
    matrix = drafting.covariance(labels)
    sheets = drafting.sample(0, draws=20_000, seed=2)
    drawn_matrix = np.cov(np.array([sheets[label] for label in labels]))
    sigma = np.sqrt(np.diag(matrix))
    assert np.allclose(matrix, matrix.T)
    assert np.max(np.abs(matrix - drawn_matrix) / np.outer(sigma, sigma)) < 0.05
    assert np.all(np.linalg.eigvalsh(matrix) > -1e-12 * sigma.max() ** 2)
    assert sigma == pytest.approx([drafting.spreads[label].sigma[0] for label in labels])


def test_a_quantity_read_once_has_one_reading_error() -> None:
    """omega_4 follows from the read ed: the two are wholly correlated."""
    solution = drawn("linkages/ex3", "board")
    kin = solution.construction.kinematics
    turning = kin.turnings[PlanKind.VELOCITY, "4"]
    read = kin.velocity.segments.drawn((turning.start, turning.head))
    segment = next(each for each in solution.construction.segments if each.drawn == read)
    assert one_error(drafting_of(solution), segment.label, "omega_4")


def test_a_result_by_similarity_errs_with_its_side() -> None:
    """v_S3 is v_D·CS3/CD: the point s3 is laid off, without another reading."""
    assert one_error(drafting_of(drawn("levers/task12", "board")), "v_D", "v_S3")


def one_error(drafting: Drafting, one: str, other: str) -> bool:
    """Return whether two quantities are wholly correlated."""
    (a, both), (_, b) = drafting.covariance([one, other])
    return bool(a > 0 and abs(both) == pytest.approx(math.sqrt(a * b), rel=1e-9))


def test_shares_of_the_causes_make_up_the_whole() -> None:
    drafting = drafting_of(drawn("linkages/ex3", "board"))
    causes = drafting.causes("v_E")
    assert sum(share for _, share in causes) == pytest.approx(1.0)
    assert [share for _, share in causes] == sorted((s for _, s in causes), reverse=True)


def test_a_more_accurate_drawing_has_smaller_errors() -> None:
    for name in SIX:
        cad, board, coarse = (
            drafting_of(drawn(name, p)).spreads for p in ("cad", "board", "coarse")
        )
        for label, spread in board.items():
            if spread.sigma[0] > 0 and not (spread.drawn[0] or coarse[label].drawn[0]):
                assert cad[label].sigma[0] < spread.sigma[0] < coarse[label].sigma[0]


def test_quantities_that_a_drawing_does_not_give_are_rejected() -> None:
    with pytest.raises(UnknownItemError, match="does not give v_Z"):
        drafting_of(drawn("linkages/ex1", "board")).covariance(["v_Z"])


def test_ellipse_of_a_point_of_a_plan() -> None:
    solution = drawn("linkages/ex3", "board")
    plan = solution.construction.plan(PlanKind.VELOCITY)
    head = solution.construction.kinematics.velocity.point["4", "E"]
    matrix = drafting_of(solution).ellipse(head, 0)
    assert plan.pole is not None
    at = complex(solution.paper.point(head)[0])
    unit = np.array([at.real, at.imag]) / abs(at)
    # Along the segment from the pole the point errs as the segment does, but for the reading.
    read = math.hypot(solution.profile.measure, solution.profile.ruler / math.sqrt(12))
    sigma = drafting_of(solution).spreads["velocity.p-e"].sigma[0]
    assert math.sqrt(unit @ matrix @ unit + read**2) == pytest.approx(sigma, rel=1e-9)


# The numbers are documented -----------------------------------------------------------------------


def rows_of(heading: str) -> list[list[str]]:
    """Return the rows of the table below a heading of the documentation, without markup."""
    part = DOCS.partition(f"## {heading}\n")[2].partition("\n## ")[0]
    rows = [re.split(r"\s*\|\s*", line)[1:-1] for line in part.splitlines() if line[:1] == "|"]
    return rows[2:]


def test_the_documented_profiles_are_those_of_the_code() -> None:
    told = {
        row[0].strip("`"): Profile(row[0].strip("`"), *map(float, row[1:6]))
        for row in rows_of("Profiles")
    }
    assert told == PROFILES


class Told(Counted):
    """A pencil that records the parameters of each stroke's error."""

    def __init__(self) -> None:
        super().__init__(Profile("told", 2.0, 3.0, 5.0, math.degrees(7.0), 11.0))
        self.by: list[str] = []

    def error(self, out: str, sigma: float) -> float:
        names = {2.0: "point", 3.0: "lay_off", 5.0: "measure", 7.0: "parallel"}
        self.by.append(names[round(sigma, 12)])
        return 0.0

    def rounded(self, out: str, length: float) -> float:
        self.by.append("ruler")
        return length


def test_the_documented_strokes_make_the_documented_errors() -> None:
    for _, name, errors in rows_of("Strokes"):
        pencil = Told()
        stroke = getattr(pencil, name.strip("`"))
        stroke("x", *[1.0] * (len(signature(stroke).parameters) - 1))
        assert sorted(pencil.by) == sorted(re.findall(r"`(\w+)`", errors)), name
    assert f"not {1 / MAX_MARGIN_SIGMA:g} times".replace("10", "ten") in DOCS
    assert f"shorter than {SHORT:g} of its sigmas" in DOCS
    assert f"of {DRAWS} random drawings" in DOCS


# Values without a construction -------------------------------------------------------------------


def test_sigma_exists_wherever_the_exact_value_does() -> None:
    """S3 is at its own pivot: a line through both has no direction, and it is not needed."""
    # At a scale where no other segment is nearly zero.
    scales = Scales(mu_l=0.002, mu_v=0.01, mu_a=0.4)
    solution = Solution(replace(load(CASES / "point-at-pivot.toml"), scales=scales))
    for errors in (drafting_of(solution), drawn_forces(statics_of(solution))):
        for label, spread in errors.spreads.items():
            assert np.isfinite(spread.sigma).all(), label
            if not label.endswith(("S3", "CS3")) and "s3" not in label:
                assert not spread.drawn.any(), label
    text = (CASES / "point-at-pivot.toml").read_text("utf-8")
    text = text.replace('S3 = { from = "C", at = 0 }\n', "").replace('["C", "S3"]', '["C"]')
    other = loads(text.replace('centre = "S3"', 'centre = "C"'), name="pivot")
    pivot = Solution(replace(other, scales=scales))
    whole = drawn_forces(statics_of(solution)).spreads
    for label, spread in drawn_forces(statics_of(pivot)).spreads.items():
        assert spread.sigma == pytest.approx(whole[label].sigma), label
