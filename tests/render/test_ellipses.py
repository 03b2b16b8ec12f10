"""Ellipses of the drafting error: their geometry, their places, their inscription."""

from __future__ import annotations

from functools import cache
from math import exp

import numpy as np
import pytest
from doors import (
    DRAFTING_PROFILES as PROFILES,
    MOTION,
    SIGMAS,
    TAG,
    Pen,
    PictureStyle,
    PlanKind,
    PointName,
    Solution,
    Stroke,
    Text,
    drafting_of,
    ellipse,
    ellipse_inscription,
    error_ellipses,
    get_language,
    half_axes,
    plan_picture,
    scheme_picture,
    text_corners,
)
from hypothesis import example, given, settings, strategies as st
from test_sheets import MANY
from worked import SIX, problem_of

RU = get_language("ru")

FINITE = st.floats(-20.0, 20.0, allow_nan=False)


@cache
def solved(name: str, profile: str = "board", *, many: bool = False) -> Solution:
    positions = MANY[name] if many else None
    return Solution(problem_of(name), positions=positions, profile=PROFILES[profile])


def place(solution: Solution, point: str, index: int) -> complex:
    return complex(solution.paper.point(PointName(point))[index])


def middle(stroke: Stroke) -> complex:
    return sum(stroke.points, 0j) / len(stroke.points)


def spread(stroke: Stroke) -> np.ndarray:
    """Return the covariance that an ellipse shows: of points spread evenly by its parameter."""
    off = np.asarray(stroke.points) - middle(stroke)
    rows = np.array([off.real, off.imag])
    return np.asarray(2 * rows @ rows.T / len(off) / SIGMAS**2)


# Geometry -----------------------------------------------------------------------------------------


@given(FINITE, FINITE, FINITE, FINITE)
@example(0.0, 0.0, 0.0, 2.6466636334761894e-129)
def test_half_axes_are_roots_of_the_eigenvalues(a: float, b: float, c: float, d: float) -> None:
    root = np.array([[a, b], [c, d]])
    covariance = root @ root.T
    size = float(np.abs(root).max()) or 1.0
    values, vectors = np.linalg.eigh(covariance)
    long, short, turn = half_axes(covariance)
    assert long**2 == pytest.approx(values[1], abs=1e-9 * size**2)
    assert short**2 == pytest.approx(values[0], abs=1e-9 * size**2)
    if values[1] - values[0] > 1e-3 * size**2:
        along = np.array([np.cos(turn), np.sin(turn)])
        assert abs(along @ vectors[:, 1]) == pytest.approx(1.0, abs=1e-6)


@given(FINITE, FINITE, FINITE)
@settings(max_examples=30)
def test_every_point_of_an_ellipse_is_as_many_sigmas_off(a: float, b: float, c: float) -> None:
    root = np.array([[abs(a) + 1.0, 0.0], [b, abs(c) + 1.0]])
    covariance = root @ root.T
    stroke = ellipse(3 - 2j, covariance)
    assert stroke.closed
    inverse = np.linalg.inv(covariance)
    for point in stroke.points:
        off = np.array([(point - (3 - 2j)).real, (point - (3 - 2j)).imag])
        assert off @ inverse @ off == pytest.approx(SIGMAS**2, rel=1e-6)


# On the views -------------------------------------------------------------------------------------


@pytest.mark.parametrize("many", [False, True])
@pytest.mark.parametrize("name", SIX)
def test_every_ellipse_is_that_of_a_point(name: str, many: bool) -> None:
    """An ellipse is around a lettered point and shows the covariance there."""
    solution = solved(name, many=many)
    for kind in MOTION:
        for index in range(len(solution.positions)):
            view = error_ellipses(solution, kind, index)
            if kind is PlanKind.POSITION:
                points = set(solution.points)
            else:
                points = set(solution.construction.plan(kind).letters)
            assert view.enlarged == 1 or kind is PlanKind.POSITION
            for stroke in view.strokes:
                near = [
                    drafting_of(solution).ellipse(PointName(p), index)
                    for p in points
                    if p in solution.paper.value
                    and abs(place(solution, p, index) - middle(stroke)) < 1e-6
                ]
                shown = spread(stroke) / view.enlarged**2
                assert any(np.allclose(shown, each, rtol=1e-6, atol=1e-9) for each in near)


@pytest.mark.parametrize("name", SIX)
def test_every_letter_point_has_its_ellipse(name: str) -> None:
    """On a board no ellipse of the worked examples is thinner than the pen."""
    solution = solved(name)
    for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION):
        plan = solution.construction.plan(kind)
        view = error_ellipses(solution, kind, 0)
        assert not view.has_oversized
        assert not view.undefined
        for point in plan.letters:
            covariance = drafting_of(solution).ellipse(point, 0)
            if point != plan.pole and covariance.any():
                at = place(solution, point, 0)
                assert any(abs(middle(stroke) - at) < 0.05 for stroke in view.strokes)


def test_the_expected_share_of_random_drawings_falls_into_an_ellipse() -> None:
    solution = solved("linkages/ex3")
    drawn = drafting_of(solution).sample(0, draws=20_000)
    mu = solution.scales[PlanKind.POSITION].per_mm
    view = error_ellipses(solution, PlanKind.POSITION, 0)
    for point in "BDE":
        at = place(solution, point, 0)
        (stroke,) = (s for s in view.strokes if abs(middle(s) - at) < 1e-6)
        off = np.array([drawn[f"x_{point}"], drawn[f"y_{point}"]]) / mu
        off -= np.array([[at.real], [at.imag]])
        inverse = np.linalg.inv(spread(stroke) / view.enlarged**2)
        inside = np.einsum("in,ij,jn->n", off, inverse, off) <= SIGMAS**2
        assert inside.mean() == pytest.approx(1 - exp(-(SIGMAS**2) / 2), abs=0.01)


def test_an_ellipse_thinner_than_the_pen_is_not_drawn() -> None:
    solution = solved("linkages/ex1", "cad")
    for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION):
        assert error_ellipses(solution, kind, 0).strokes == ()
        (line,) = ellipse_inscription(solution, kind, [0], RU)
        assert "тоньше линий" in line
        assert "САПР" in line


def test_an_ellipse_larger_than_half_the_plan_is_mentioned_but_not_drawn() -> None:
    solution, kind = solved("levers/six-link", many=True), PlanKind.ACCELERATION
    for index in range(12):
        view = error_ellipses(solution, kind, index)
        told = "эллипсы больше половины плана не показаны"
        assert (told in ellipse_inscription(solution, kind, [index], RU)) == view.has_oversized
    assert any(error_ellipses(solution, kind, index).has_oversized for index in range(12))


def test_dashed_are_the_points_where_first_order_does_not_hold() -> None:
    """Near its dead position the slider of the six-link cannot be found by first order."""
    solution = solved("levers/six-link", many=True)
    for index in range(12):
        view = error_ellipses(solution, PlanKind.POSITION, index)
        at = place(solution, "H", index)
        pens = {stroke.pen for stroke in view.strokes if abs(middle(stroke) - at) < 1e-6}
        drawn = any(drafting_of(solution).spreads[f"{axis}_H"].drawn[index] for axis in "xy")
        assert pens == {Pen.HIDDEN if drawn else Pen.THIN}
        told = "штриховые: первый порядок неверен"
        assert (told in ellipse_inscription(solution, PlanKind.POSITION, [index], RU)) == drawn


def test_a_short_segment_alone_does_not_make_its_end_dashed() -> None:
    """The slotted link of ex3 stops at 270°: b b3 is zero, but b3 is known as well as ever."""
    solution = solved("linkages/ex3", many=True)
    assert drafting_of(solution).spreads["velocity.b-b3"].drawn[9]
    assert not error_ellipses(solution, PlanKind.VELOCITY, 9).has_nonlinear


def test_the_inscription_names_factor_and_profile() -> None:
    assert ellipse_inscription(solved("linkages/ex3"), PlanKind.VELOCITY, [0], RU) == [
        "Эллипсы погрешностей построения (2σ), чертёжная доска"
    ]
    assert ellipse_inscription(solved("linkages/ex3", "coarse"), PlanKind.VELOCITY, [0], RU) == [
        "Эллипсы погрешностей построения (2σ), грубо"
    ]
    assert ellipse_inscription(solved("linkages/ex3"), PlanKind.POSITION, [0], RU) == [
        "Эллипсы погрешностей построения (2σ), увеличено 5:1, чертёжная доска"
    ]


# Pictures -----------------------------------------------------------------------------------------


def inside(stroke: Stroke, point: complex) -> bool:
    off = point - middle(stroke)
    covariance = spread(stroke)
    row = np.array([off.real, off.imag])
    return bool(row @ np.linalg.inv(covariance) @ row < SIGMAS**2 * 0.999)


@pytest.mark.parametrize("name", SIX)
def test_ellipses_are_part_of_the_picture_and_letters_stay_out_of_them(name: str) -> None:
    solution = solved(name)
    pictures = [
        plan_picture(solution, kind, 0, PictureStyle(errors=True))
        for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION)
    ]
    pictures.append(scheme_picture(solution, 0, PictureStyle(errors=True)))
    for picture in pictures:
        left, low, right, high = picture.bounds
        ellipses = [item for item in picture.items if isinstance(item, Stroke) and item.tag == TAG]
        assert ellipses
        for stroke in ellipses:
            assert all(left <= p.real <= right and low <= p.imag <= high for p in stroke.points)
        letters = [item for item in picture.items if isinstance(item, Text)]
        for stroke in ellipses:
            if half_axes(spread(stroke))[1] > 1e-3:
                corners = (corner for text in letters for corner in text_corners(text))
                assert not any(inside(stroke, corner) for corner in corners)


@pytest.mark.parametrize("kind", [PlanKind.VELOCITY, PlanKind.ACCELERATION])
def test_a_plan_without_ellipses_has_no_inscription_of_them(kind: PlanKind) -> None:
    picture = plan_picture(solved("linkages/ex3"), kind, 0)
    assert not [item for item in picture.items if getattr(item, "tag", "") == TAG]
