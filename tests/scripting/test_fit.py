"""Sizes that reach the targets of a mechanism, and targets that no sizes reach."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from cases import each
from doors import ArgumentError, FitError, UnknownNameError, UnknownQuantityError
from pressed import press

import planmethod as pm


def four_bar(**sizes: Any) -> pm.Mechanism:
    m = pm.Mechanism("four-bar").frame(A=(0, 0), D=(0.3, 0)).drive("1", omega=10)
    m.link("1", A="B", length=0.1).link("2", B="C", length=0.25).link("3", C="D", length=0.2)
    return m.assemble(C="left of AD").with_(sizes)


def drag_link() -> pm.Mechanism:
    """Return a four-bar whose rocker goes all the way round."""
    return four_bar(AB=0.25, BC=0.28, CD=0.3, D=(0.1, 0))


def test_the_slotted_lever_has_the_sizes_of_the_formulas() -> None:
    """The angle between the extremes is 180° (K - 1)/(K + 1); its half has the sine AB / AC."""
    found = press().with_(DE=0.5).fit({"AB", "CD"}, {"stroke(E)": 0.2, "K_v(E)": 1.3})
    half = np.pi / 2 * (1.3 - 1) / (1.3 + 1)
    assert found.is_reached and found.error < 1e-9
    assert found.numbers["l_AB"] == pytest.approx(0.11 * np.sin(half), rel=1e-9)
    assert found.numbers["l_CD"] == pytest.approx(0.1 / np.sin(half), rel=1e-9)
    again = found.mechanism.characteristics("stroke(E)", "K_v(E)", "stroke(3)")
    assert again["stroke(E)"] == pytest.approx(0.2, rel=1e-9)
    assert again["stroke(3)"] == pytest.approx(np.degrees(2 * half), rel=1e-9)
    assert found.mechanism.to_dict()["links"]["1"]["AB"] == found.numbers["l_AB"]


def test_a_target_that_no_size_reaches_is_said_with_numbers() -> None:
    """The rod DE is too short for the lever that the ratio and the stroke need."""
    found = press().fit({"AB", "CD"}, {"stroke(E)": 0.2, "K_v(E)": 1.3})
    assert not found.is_reached
    message = r"No sizes were found for stroke\(E\) = 0.2, K_v\(E\) = 1.3; the nearest: l_AB = 0.0"
    with pytest.raises(FitError, match=message):
        _ = found.mechanism
    values = found.nearest.characteristics("stroke(E)", "K_v(E)")
    assert values == found.values
    assert found.error == pytest.approx(
        max(abs(values["stroke(E)"] / 0.2 - 1), abs(values["K_v(E)"] / 1.3 - 1))
    )


def test_points_of_a_path_give_the_sizes_that_drew_it() -> None:
    drawn = four_bar(AB=0.09, BC=0.26, CD=0.21)
    positions = [0.0, 60.0, 120.0, 180.0, 240.0]
    path = drawn.solve(positions).points["C"].place
    targets = {f"C({at:g})": place for at, place in zip(positions, path, strict=True)}
    found = four_bar().fit(["AB", "BC", "CD"], targets)
    assert found.is_reached and len(found.values) == 10
    assert [*found.numbers.values()] == pytest.approx([0.09, 0.26, 0.21], rel=1e-7)


def test_more_targets_than_sizes_have_the_least_squares() -> None:
    """The sum of squares over one size, beside it on both sides, is larger."""
    targets = {"omega_3(30)": -0.9, "omega_3(150)": 3.2, "omega_3(270)": -1.0}
    found = four_bar().fit(["CD"], targets)
    assert found.is_reached and found.error > 1e-3

    def squares(length: float) -> float:
        values = four_bar(CD=length).characteristics(*targets)
        return sum((values[name] / own - 1) ** 2 for name, own in targets.items())

    least = squares(found.numbers["l_CD"])
    assert least < squares(found.numbers["l_CD"] * 1.001)
    assert least < squares(found.numbers["l_CD"] * 0.999)


def test_extremes_and_means_over_the_turn_are_those_of_formulas() -> None:
    """A slider-crank: x = r·cos φ + √(l² - r²·sin² φ), from l - r to l + r."""
    m = pm.Mechanism("slider-crank").frame(A=(0, 0), guides={"x-x": ("A", 0)}).drive("1", omega=3)
    m.link("1", A="B", length=0.1).link("2", B="C", length=0.4).slider("3", on="x-x", at="C")
    m.assemble(C="right of B")
    found = m.characteristics("max(x_C)", "min(x_C)", "mean(omega_2)", "max(C.vx)", "mean(x_C)")
    assert list(found) == ["max(x_C)", "min(x_C)", "mean(omega_2)", "max(C.vx)", "mean(x_C)"]
    assert found["max(x_C)"] == pytest.approx(0.5, rel=1e-12)
    assert found["min(x_C)"] == pytest.approx(0.3, rel=1e-12)
    assert abs(found["mean(omega_2)"]) < 1e-12
    phi = np.radians(np.linspace(200.0, 350.0, 200001))
    root = np.sqrt(0.16 - 0.01 * np.sin(phi) ** 2)
    speed = -0.3 * np.sin(phi) - 0.03 * np.sin(phi) * np.cos(phi) / root
    assert found["max(C.vx)"] == pytest.approx(speed.max(), rel=1e-9)
    every = np.radians(np.arange(720) / 2)
    x = 0.1 * np.cos(every) + np.sqrt(0.16 - 0.01 * np.sin(every) ** 2)
    assert found["mean(x_C)"] == pytest.approx(x.mean(), rel=1e-12)


def test_the_fastest_speed_of_the_turn_is_a_target() -> None:
    found = press().with_(DE=0.5).fit({"AB"}, {"max(v_E)": 8.0})
    assert found.is_reached
    speeds = found.mechanism.solve(np.arange(0.0, 360.0, 0.05)).to_columns(["v_E"])["v_E"]
    assert speeds.max() == pytest.approx(8.0, rel=1e-6)
    assert speeds.max() <= 8.0 * (1 + 1e-9)


def test_a_quantity_in_a_position_is_that_of_the_solution() -> None:
    m = press()
    found = m.characteristics("v_E(30)", "x_E(120)", "E.vx(30)")
    columns = m.solve([30.0, 120.0]).to_columns(["v_E", "x_E", "vx_E"])
    assert found["v_E(30)"] == columns["v_E"][0] and found["x_E(120)"] == columns["x_E"][1]
    assert found["E.vx(30)"] == columns["vx_E"][0]


@each(
    "ask, error",
    [
        (lambda m: m.characteristics("stroke"), ArgumentError),
        (lambda m: m.characteristics("v_E(fast)"), ArgumentError),
        (lambda m: m.characteristics("stroke(Q)"), UnknownNameError),
        (lambda m: m.characteristics("v_Q(30)"), UnknownQuantityError),
        (lambda _: drag_link().characteristics("stroke(3)"), FitError),
        (lambda m: m.with_(DE=0.1).characteristics("x_E(90)"), FitError),
        (lambda m: m.with_(DE=0.1).characteristics("max(x_E)"), FitError),
        (lambda m: m.characteristics("max(E)"), ArgumentError),
        (lambda m: m.characteristics("mean(v_Q)"), UnknownQuantityError),
        (lambda m: m.fit(["AX"], {"stroke(E)": 1}), UnknownNameError),
        (lambda m: m.fit([], {"stroke(E)": 1}), ArgumentError),
        (lambda m: m.fit(["AB"], {}), ArgumentError),
    ],
)
def test_what_a_mechanism_does_not_have_is_reported(ask: Any, error: type[Exception]) -> None:
    with pytest.raises(error):
        ask(press())
