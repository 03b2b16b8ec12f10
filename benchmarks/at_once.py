"""The peer of the force plans: one linear system of all links, position by position."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.bench.measurements import ReadSpeed, clock, error_of, places
from planmethod.mechanism.model import FRAME
from planmethod.problem.model import Problem
from planmethod.solved.forces.statics import Statics, statics_of
from planmethod.solved.solution import Solution

Array = npt.NDArray[Any]


def readings(problem: Problem, counts: Sequence[int]) -> list[ReadSpeed]:
    """Time the linear system; it begins with a motion that is known."""
    found = []
    for count in counts:
        statics = statics_of(Solution(problem, positions=places(problem, count).tolist()))

        def at_once(s: Statics = statics) -> list[Array]:
            return all_at_once(s)

        name, error = "3n equations at once, NumPy, after the motion", error_of(statics, at_once())
        found.append(ReadSpeed(name, problem.name, count, clock(at_once).median, error))
    return found


def all_at_once(statics: Statics) -> list[Array]:
    """Return reactions and balance from the 3n equations of all links, position by position.

    The unknowns are those of the force plans, in their order; places, directions of the guides and
    loads are those of the solution.
    """
    solution = statics.solution
    links = {link: 3 * k for k, link in enumerate(solution.problem.mechanism.links)}
    count, size = len(solution.positions), 3 * len(links)
    matrix, right = np.zeros((count, size, size)), np.zeros((count, size))
    columns: list[tuple[int, Array | None]] = []  # first column of a reaction; its line, of a guide

    def put(column: int, on: str, by: str, force: Any, moment: Any) -> None:
        for link, sign in ((on, 1.0), (by, -1.0)):
            if link != FRAME:
                for k, part in enumerate((force.real, force.imag, moment)):
                    matrix[:, links[link] + k, column] += sign * part

    column = 0
    for reaction in statics.board.reactions:
        at = solution.place(reaction.force.at)
        line = _across(solution, reaction.on, reaction.by) if reaction.couple is not None else None
        columns.append((column, line))
        for force in (1.0 + 0j, 1j) if line is None else (line, 0j):
            moment = (at.conjugate() * force).imag if np.any(force) else 1.0
            put(column, reaction.on, reaction.by, np.asarray(force), moment)
            column += 1
    put(column, solution.problem.drive.link, FRAME, np.asarray(0j), 1.0)
    for given in statics.board.given:
        one = given.applied
        place = np.zeros(1) if one.point is None else solution.points[one.point].place
        moment = one.couple + (np.conj(place) * one.force).imag
        for k, part in enumerate((one.force.real, one.force.imag, moment)):
            right[:, links[one.link] + k] -= part
    values = np.linalg.solve(matrix, right[:, :, np.newaxis])[:, :, 0]
    found = [
        values[:, k] + 1j * values[:, k + 1] if line is None else values[:, k] * line
        for k, line in columns
    ]
    return [*found, values[:, -1]]


def _across(solution: Solution, one: str, two: str) -> Array:
    """Return the unit vector across the guide between two links."""
    slides = solution.problem.slides
    slide = slides[one] if one in slides and slides[one].host == two else slides[two]
    host = np.zeros(1) if slide.host == FRAME else solution.links[slide.host].phi_deg
    return np.exp(1j * np.radians(host + slide.angle)) * 1j
