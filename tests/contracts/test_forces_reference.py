"""Reactions and balancing moments of the textbooks' mechanisms against exact values."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

import pytest
from doors import JointForce, Solution, Statics, analyse
from worked import ROOT, problem_of

LIMIT = 1e-9

NAMES = ("levers/six-link", "levers/task12", "press/press", "press/press-stone")


@cache
def exact(name: str) -> dict[str, Any]:
    values: dict[str, Any] = json.loads((ROOT / "tests/data/forces.json").read_text("utf-8"))[name]
    return values


@cache
def statics(name: str) -> Statics:
    return Statics(Solution(problem_of(name)))


def between(name: str, on: str, by: str) -> tuple[JointForce, int]:
    """Return the reaction of two links, and -1 if the plans have the one that acts back."""
    (found,) = (r for r in statics(name).reactions if {r.on, r.by} == {on, by})
    return found, 1 if found.on == on else -1


def test_the_other_reading_has_the_other_group() -> None:
    kinds = {
        name: [group.signature for group in analyse(problem.mechanism).groups]
        for name in NAMES
        for problem in [statics(name).solution.problem]
    }
    assert kinds["press/press"] == ["RPR", "RRP"]
    assert kinds["press/press-stone"] == ["RPR", "PRP"]


@pytest.mark.parametrize("name", NAMES)
def test_every_reaction_is_the_exact_one(name: str) -> None:
    wanted = exact(name)["reactions"]
    assert len(wanted) == len(statics(name).reactions)
    forces = [abs(complex(w["fx"], w["fy"])) for w in wanted]
    points = statics(name).solution.points
    for one, size in zip(wanted, forces, strict=True):
        found, sign = between(name, one["on"], one["by"])
        force = sign * complex(found.force[0])
        error = abs(force - complex(one["fx"], one["fy"]))
        assert error <= LIMIT * (size or max(forces)), (one["about"], one["on"], one["by"])
        arm = complex(found.at[0] - points[one["about"]].place[0])
        moment = sign * float(found.moment[0]) + (arm.conjugate() * force).imag
        # Moments that are zero: to a share of the largest force on an arm of a decimetre.
        largest = abs(one["moment"]) or 0.1 * max(forces)
        assert abs(moment - one["moment"]) <= LIMIT * largest, (one["about"], one["on"], one["by"])


@pytest.mark.parametrize("name", NAMES)
def test_the_balancing_moment_is_the_exact_one(name: str) -> None:
    wanted = exact(name)["drive"]
    assert statics(name).balance[0] == pytest.approx(wanted, rel=LIMIT)
    lever = statics(name).lever
    assert lever is not None
    assert lever[0] == pytest.approx(wanted, rel=LIMIT)
    assert lever[0] == pytest.approx(statics(name).balance[0], rel=1e-12)
