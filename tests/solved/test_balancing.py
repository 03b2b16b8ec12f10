"""Static balancing: the inertia left by counterweights, and their masses."""

from __future__ import annotations

import json

import numpy as np
import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    DRAFTING_PROFILES as PROFILES,
    Balancing,
    ProblemError,
    Solution,
    balancing_record,
    cli,
    problem_load as load,
    problem_loads as loads,
)
from worked import path_of

BAR = path_of("machines/balanced-fourbar").read_text("utf-8")
CRANK = path_of("machines/balanced-crank").read_text("utf-8")


def balanced(text: str, variant: str | None = None) -> Balancing:
    return Balancing(loads(text, name="balanced", variant=variant))


@each(
    "text",
    [
        BAR,
        CRANK,
        BAR.replace("at = 0.16 }", "at = 0.16, across = 0.07 }"),  # beside the line of the rod
        BAR.replace("n = 300", "n = -300").replace('B = "above A"', 'B = "below A"'),
        CRANK.replace('on = "AB", at = 0.16', 'on = "AB", at = -0.05, across = 0.02'),
    ],
)
def test_full_balancing_leaves_no_force(text: str) -> None:
    made = balanced(text)
    before, after = made.largest
    assert before > 100.0
    assert after < 1e-10 * before
    centre = made.centres(360)[1]
    assert float(np.max(np.abs(centre - centre[0]))) < 1e-13


def test_counterweights_are_those_of_the_textbook() -> None:
    first, second = balanced(BAR).counterweights
    # m_2A = 3.6·(0.36 - 0.16)/0.36 = 2, m_2B = 1.6
    assert first.mass * 0.1 == pytest.approx(1.2 * 0.04 + 2.0 * 0.12)
    assert second.mass * 0.12 == pytest.approx(2.8 * 0.13 + 1.6 * 0.28)
    assert first.angle_deg == pytest.approx(180.0)
    rod, crank = balanced(CRANK).counterweights
    assert rod.mass * 0.24 == pytest.approx((1.6 + 2.8) * 0.36)
    assert crank.mass * 0.2 == pytest.approx(1.2 * 0.04 + (3.6 + 2.8 + rod.mass) * 0.12)


def test_half_of_the_slider_is_the_first_harmonic_of_a_central_crank() -> None:
    half, harmonic = (balanced(CRANK, name) for name in ("half", "harmonic"))
    assert half.counterweights[0].moment == pytest.approx(harmonic.counterweights[0].moment)
    force = half.forces(720)[1]
    turned = np.exp(-2j * np.pi * np.arange(720) / 720)
    assert abs(np.mean(force * turned)) < 1e-9
    # the force of the centre of mass's own acceleration, differenced from its place
    before, moment = half.forces(3600)[0], half.centres(3600)[0] * half.mass_before
    step = 2 * np.pi / 3600 / abs(half.problem.drive.rate)
    second = (np.roll(moment, 1) + np.roll(moment, -1) - 2 * moment) / step**2
    assert np.max(np.abs(before + second)) < 1e-4 * half.largest[0]


@each(
    "message, change",
    {
        "link 2 cannot have a counterweight. Counterweights are on 1 and 3": (
            "{ 1 = 0.1, 3",
            "{ 2",
        ),
        "link '4' does not exist": ("{ 1 = 0.1, 3", "{ 4"),
        "everything is fully balanced": ('"full"', '"full"\nshare = 0.5'),
        "link 3 is a rocker: a share refers to a slider's mass": (
            '"full"',
            '"partial"\nshare = 0.5',
        ),
        "balancing.method: expected 'full' or 'partial'": ('"full"', '"whole"'),
        "balancing: the crank does not move": ("n = 300", "n = 0"),
        "no link has a mass": (BAR[BAR.index("[dynamics") : BAR.index("[balancing]")], ""),
    }.items(),
)
def test_a_mechanism_that_cannot_be_balanced_is_reported(
    message: str, change: tuple[str, str]
) -> None:
    assert change[0] in BAR
    with pytest.raises(ProblemError) as told:
        balanced(BAR.replace(*change))
    assert message in str(told.value)


def test_six_links_are_reported() -> None:
    text = path_of("linkages/ex3").read_text("utf-8").partition("[variants")[0]
    text += '\n[dynamics.links.4]\nmass = 1\ncentre = "D"\n[balancing]\n'
    with pytest.raises(ProblemError, match="neither a four-bar nor a slider-crank"):
        balanced(text)


def test_the_record_and_the_sheet() -> None:
    problem = load(path_of("machines/balanced-fourbar"))
    record = balancing_record(Solution(problem, profile=PROFILES["board"]))
    json.dumps(record, allow_nan=False)
    assert record["structure"] == "four-bar"
    assert record["rod"] == {"link": "2", "A": pytest.approx(2.0), "B": pytest.approx(1.6)}
    assert [one["mr"] for one in record["counterweights"]] == pytest.approx([0.288, 0.812])
    assert record["counterweights"][1]["mr_read"] == pytest.approx(0.81)
    path = str(path_of("machines/balanced-fourbar"))
    lint = CliRunner().invoke(cli, ["lint", path, "--layout", "balancing"])
    assert lint.exit_code == 0, lint.output
