"""Candidates just at the limits of the sieve: each side of one, and alone as among others."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from doors import (
    DEFAULT,
    MIN_LENGTH_MM,
    MIN_MARGIN,
    ModelProblem as Problem,
    QuantityKey,
    RejectionReason,
    Solution,
    parse_quantity,
    screen_linkages,
)
from worked import PROBLEMS

from planmethod import loads

TEXT = (PROBLEMS / "linkages" / "ex1.toml").read_text("utf-8").partition("[stamp]")[0]


def linkage(omega: float = -100.0, phi: float = 60.0, rod: float = 0.1) -> Problem:
    text = TEXT.replace("omega = -100", f"omega = {omega!r}").replace("phi = 60", f"phi = {phi!r}")
    return loads(text.replace("BC = 0.1\n", f"BC = {rod!r}\n"), name=f"{omega} {phi} {rod}")


@cache
def v_b() -> QuantityKey:
    return parse_quantity("v B")


def reasons(problems: list[Problem]) -> list[RejectionReason | None]:
    """Return why each is rejected; what does not assemble well is so alone, too."""
    asked = [(v_b(), 0, "v_B")]
    found = screen_linkages(problems, asked, DEFAULT)
    kept = {k for _, members in found.batches for k in members} | {*found.solutions}
    assert kept.isdisjoint(found.rejections)
    assert kept | {*found.rejections} == {*range(len(problems))}
    for k, problem in enumerate(problems):
        among = found.rejections.get(k)
        alone = screen_linkages([problem], asked, DEFAULT).rejections.get(0)
        assert alone == among or (among is not None and among.reason is RejectionReason.SHORT)
    return [
        found.rejections[k].reason if k in found.rejections else None for k in range(len(problems))
    ]


def test_a_segment_is_long_enough_from_the_limit_on() -> None:
    """v_B = 0.03 m · ω at 0.05 m/s in a millimetre: 5 mm at 8.33 1/s."""
    limit = MIN_LENGTH_MM * 0.05 / 0.03
    shares = (0.5, 0.99, 1.01, 2.0)
    problems = [linkage(omega=-limit * share) for share in shares]
    short = [one is RejectionReason.SHORT for one in reasons(problems)]
    assert short == [True, True, False, False]


def test_a_position_is_judged_by_its_least_margin_on_both_sides_of_the_limit() -> None:
    """The rod is shortened until its circle nearly touches the line of the slider."""
    rods = [float(rod) for rod in np.geomspace(0.0262, 0.05, 8)]
    problems = [linkage(phi=60.0, rod=rod) for rod in rods]
    margins = [float(np.min(Solution(one).margin)) for one in problems]
    assert margins == sorted(margins) and margins[0] < MIN_MARGIN < margins[-1]
    found = reasons(problems)
    assert [one is RejectionReason.MARGIN for one in found] == [x < MIN_MARGIN for x in margins]
    k = sum(x < MIN_MARGIN for x in margins)
    low, high = rods[k - 1], rods[k]
    for _ in range(14):
        middle = (low + high) / 2
        is_low = float(np.min(Solution(linkage(rod=middle)).margin)) < MIN_MARGIN
        low, high = (middle, high) if is_low else (low, middle)
    assert high - low < 1e-6
    below, above = reasons([linkage(rod=low), linkage(rod=high)])
    assert below is RejectionReason.MARGIN and above is not RejectionReason.MARGIN


def test_the_margin_of_a_slider_is_the_square_of_the_sine_between_rod_and_guide() -> None:
    """Where the rod is nearly across the guide the margin is nearly 0."""
    for rod in (0.027, 0.03, 0.05, 0.1):
        rise = 0.03 * np.sin(np.pi / 3) / rod
        found = float(np.min(Solution(linkage(rod=rod)).margin))
        assert found == pytest.approx(1.0 - rise * rise, rel=1e-6)
