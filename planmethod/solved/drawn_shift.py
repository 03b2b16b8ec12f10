"""How far points are from the coordinates of their figure (отклонение от рисунка)."""

# no messages: numbers

from __future__ import annotations

from planmethod.construct.steps import PointName
from planmethod.problem.model import Problem
from planmethod.solved.solution import Solution

LEAST = 1e-9
"""Smallest distance that is reported, relative to the size of the figure."""


def shifts(problem: Problem) -> dict[str, float]:
    """Return how far points are from their coordinates, m, in the position of the figure.

    Sizes that were rounded, or given otherwise within the tolerance of a figure, move them.

    Raises
    ------
    PlanMethodError
        The mechanism cannot be assembled there.
    """
    figure = problem.drawn
    if figure is None or figure.shown is None or figure.shown.position is None:
        return {}
    places = figure.shown.places
    first = next(iter(places.values()))
    extent = max(abs(place - first) for place in places.values())
    solved = Solution(problem, positions=[figure.shown.position])
    known = solved.construction.draft.points()
    found = {}
    for name, place in places.items():
        if name in known:
            off = abs(complex(solved.place(PointName(name))[0]) - place)
            if off > LEAST * extent:
                found[name] = off
    return found
