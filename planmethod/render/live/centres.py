"""Instant centres on the page of a moving mechanism (мгновенные центры), as numbers of its tape."""

# no messages: numbers of a page

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any

from planmethod.compiled import Ref, javascript_function
from planmethod.mechanism.model import FRAME
from planmethod.note.tables.centres import centre_symbol
from planmethod.plans.build import Construction
from planmethod.problem.model import Problem
from planmethod.solved.centres import Centres, Pair, find_centres
from planmethod.solved.many.rows import TapeMotion
from planmethod.solved.solution import Solution


class LiveCentres:
    """Centres of all links, homogeneous: x, y, w of each, 0 of w at infinity.

    Parameters
    ----------
    shown : Solution
        Its first position determines the joints and Kennedy's lines.

    Attributes
    ----------
    pairs : tuple of (str, str)
        Links of each centre.
    marked : dict of int to str
        Numbers of those that are neither joints nor slides, with their symbols.
    lines : list of list of int
        Kennedy's lines, each by the numbers of its three centres.
    """

    def __init__(self, shown: Solution) -> None:
        found: Centres = find_centres(shown)
        self.pairs: tuple[Pair, ...] = tuple(found.centres)
        self._points = [found.centres[pair].point for pair in self.pairs]
        self.marked = {
            number: centre_symbol(shown, *pair)
            for number, pair in enumerate(self.pairs)
            if not (found.centres[pair].point or found.centres[pair].slide)
        }
        numbers = {frozenset(pair): number for number, pair in enumerate(self.pairs)}
        threes = {
            frozenset((*pair, by)): None
            for pair, centre in found.centres.items()
            for by in centre.by
        }
        self.lines = [
            [numbers[frozenset(pair)] for pair in combinations(sorted(three), 2)]
            for three in threes
        ]

    def javascript(self, problem: Problem, construction: Construction, rows: Sequence[str]) -> str:
        """Return the source of ``centres(x, out)``: three numbers of every centre.

        Parameters
        ----------
        rows : sequence of str
            Names of the outputs ``out`` of the program, the motion among them.
        """
        motion = TapeMotion(problem, construction, rows)
        told: list[Ref] = []
        for pair, point in zip(self.pairs, self._points, strict=True):
            if point:
                place = motion.points[point].place
                told += [*_parts(place), 1.0]
                continue
            (first, second), (one, other) = zip(
                *(_motion(problem, motion, link) for link in pair), strict=True
            )
            told += [*_parts(second - first), _parts(other - one)[0]]
        outputs = ["x", *(f"out[{number}]" for number in range(len(rows)))]
        return javascript_function("centres(x, out)", motion.tape, told, outputs)

    def data(self) -> dict[str, Any]:
        """Return what the script needs beside the numbers."""
        return {"marked": list(self.marked), "lines": self.lines}


def _motion(problem: Problem, motion: TapeMotion, link: str) -> tuple[Any, Any]:
    """Return the motion of a link: its centre times ω, and ω."""
    if link == FRAME:
        return 0.0, 0.0
    point = next(one for one in problem.bodies[link].points if one in motion.points)
    there, omega = motion.points[point], motion.links[link].omega
    return 1j * there.velocity + omega * there.place, omega


def _parts(value: Any) -> tuple[Ref, Ref]:
    return value.re, 0.0 if value.im is None else value.im
