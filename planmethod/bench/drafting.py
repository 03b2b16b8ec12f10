"""First-order drafting errors against random sheets, problem by problem."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec import Struct

from planmethod.construct.drafting import PROFILES, Profile
from planmethod.problem.model import Problem
from planmethod.solved.errors.drawing import DrawnKind
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.errors.spread import SHORT
from planmethod.solved.solution import Solution

DRAWS = 4000
SEED = 11


class Compared(Struct, frozen=True):
    """One problem drawn by one hand.

    Attributes
    ----------
    compared : int
        Quantities for which first order is valid and which are longer than three sigmas.
    minimum, maximum : float
        First-order sigma over the standard deviation of random sheets, over those quantities.
    nonlinear, short : int
        Quantities with the sigma of the sheets, first order being invalid; quantities
        shorter than three sigmas.
    """

    problem: str
    profile: str
    compared: int
    minimum: float
    maximum: float
    nonlinear: int
    short: int


def compare(problem: Problem, profile: Profile, *, draws: int = DRAWS) -> Compared:
    """Compare both ways of finding the drafting errors in every position of a problem."""
    solution = Solution(problem, profile=profile)
    drafting = drafting_of(solution)
    ratios: list[float] = []
    given_up = short = 0
    for i in range(len(solution.positions)):
        sheets = drafting.sample(i, draws=draws, seed=SEED)
        for label, spread in drafting.spreads.items():
            sigma, values = float(spread.sigma[i]), sheets[label]
            if sigma == 0:
                continue
            if (
                drafting.items[label].kind is DrawnKind.LENGTH
                and float(np.mean(values)) < SHORT * sigma
            ):
                short += 1
            elif spread.drawn[i]:
                given_up += 1
            else:
                ratios.append(sigma / float(np.std(values)))
    name = problem.name + (f" ({problem.variant})" if problem.variant else "")
    least, most = (min(ratios), max(ratios)) if ratios else (float("nan"), float("nan"))
    return Compared(name, profile.name, len(ratios), least, most, given_up, short)


def compare_all(problems: Sequence[Problem]) -> list[Compared]:
    """Compare every problem drawn by every hand."""
    return [compare(problem, profile) for problem in problems for profile in PROFILES.values()]
