"""Drawing of the construction (чертёж): scale, the ruler's readings, their errors, record."""

from __future__ import annotations

import cmath
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import pairwise
from math import tau
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct import steps
from planmethod.construct.drafting import Profile, RulerArithmetic
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.scale import choose_scale, series_near
from planmethod.construct.steps import LineName, NumberName, PointName, result_kind
from planmethod.note.compared import Series, measured_series
from planmethod.note.numbers import finite_or_none
from planmethod.solved.errors.spread import Drafted, DrawnKind, DrawnQuantity, Errors, number
from planmethod.solved.reading import memoized
from planmethod.solved.solution import Solution
from planmethod.synthesis import synthesize
from planmethod.synthesis.model import NO_LETTERS, Synthesis, place, scaled

BOXES = ((170.0, 222.0), (330.0, 130.0))
"""Boxes for the points of a construction on A3, portrait and landscape, mm."""

FREE = "UVWXYTSRQ"
"""Letters of auxiliary points whose own ones the file has for other points."""

MAX_DISTANCE_RATIO = 1.2
"""Distance of a centre from the rest, in sizes of the rest, beyond which it is not drawn."""


class Drawn(Struct, frozen=True, dict=True):
    """A construction on paper.

    Attributes
    ----------
    synthesis : Synthesis
    profile : Profile
        Accuracy of the drafting.
    scale : float, optional, m per mm
        Its scale, if it is not to be chosen.
    letters : mapping
        Letters of the file for those of the construction.
    """

    synthesis: Synthesis
    profile: Profile
    scale: float | None = None
    letters: Mapping[str, str] = NO_LETTERS

    @cached_property
    def shown_letters(self) -> Mapping[str, str]:
        """Letters to be shown for those of the construction: an auxiliary point has a free one."""
        own = self.synthesis.letters
        taken = {self.letters.get(one, one) for one in own}
        points = [step.out for step in self.synthesis.board.steps if result_kind(step) is PointName]
        others = {point[0] for point in points if point[0].isupper() and not point.startswith(own)}
        free = (one for one in FREE if one not in taken and one not in others)
        return {**self.letters, **{one: next(free) for one in sorted(others & taken)}}

    @cached_property
    def points_on_sheet(self) -> tuple[str, ...]:
        """Points on the sheet: those of the mechanism, and others not too far away."""
        made, exact = self.synthesis, self.synthesis.exact()
        own = {p for pose in made.poses for link in pose.links for p in link} | {*made.pivots}
        own |= {*made.guide}
        places = np.array([place(exact, p) for p in own])
        middle = complex(places.real.max() + places.real.min(),
                         places.imag.max() + places.imag.min()) / 2  # fmt: skip
        size = float(np.max(np.abs(places - middle)))
        others = [
            str(step.out)
            for step in made.board.steps
            if result_kind(step) is PointName and step.out not in made.board.marks
        ]
        near = [
            p
            for p in others
            if p in own or abs(place(exact, p) - middle) <= MAX_DISTANCE_RATIO * size
        ]
        return tuple(near)

    @cached_property
    def mu(self) -> float:
        """Scale, m per mm: of the two boxes the one that gives the larger drawing."""
        if self.scale is not None:
            return self.scale
        left, low, right, high = self.extent(self.synthesis.exact())
        return min(choose_scale((right - left, high - low), box) for box in BOXES)

    def extent(self, exact: Trace) -> tuple[float, float, float, float]:
        """Return the box around the drawing, including arcs, in the unit of a reading."""
        places = np.array([place(exact, p) for p in self.points_on_sheet])
        for centre, *points in self.synthesis.board.circles:
            if {centre, *points} <= {*self.points_on_sheet}:
                middle, radius, start, sweep = arc_over(exact, centre, points)
                turns = start + sweep * np.linspace(0.0, 1.0, 37)
                places = np.append(places, middle + radius * np.exp(1j * turns))
        xs, ys = places.real, places.imag
        return float(xs.min()), float(ys.min()), float(xs.max()), float(ys.max())

    @cached_property
    def paper(self) -> Trace:
        """Exact reading, mm."""
        return self.synthesis.exact(self.mu)

    @cached_property
    def ruler_reading(self) -> Trace:
        """Reading with the ruler."""
        data = scaled(self.synthesis.board, self.mu)
        return evaluate(self.synthesis.program, data, RulerArithmetic(ruler=self.profile.ruler))

    @cached_property
    def sigma(self) -> dict[str, float]:
        """Standard deviations of the lengths, m."""
        made = self.synthesis
        names = [NumberName(f"l {name}") for name in made.lengths]
        items = tuple(DrawnQuantity(n, (n,), number(n), DrawnKind.LENGTH) for n in names)
        data: Any = scaled(made.board, self.mu)
        drawing = Drafted(made.program, lambda _: data, 1, self.profile, frozenset(), items)
        spreads = Errors(drawing).spreads
        return {
            name: float(spreads[str(full)].sigma[0])
            for name, full in zip(made.lengths, names, strict=True)
        }

    def read(self, name: str) -> float:
        """Return a length of the mechanism as the ruler has it, m."""
        return float(self.ruler_reading.value[NumberName(f"l {name}")])

    @property
    def series(self) -> list[Series]:
        """Lengths of the mechanism."""
        return [
            measured_series(name, "m", [exact], [self.read(name)], [self.sigma[name]])
            for name, exact in self.synthesis.metres().items()
        ]

    def coarser(self) -> Drawn:
        """Return the same at the next scale of the series."""
        return replace(self, scale=series_near(1.01 * self.mu, up=True))

    def distance_along(self, line: LineName, point: PointName) -> float:
        """Return the distance of a point along a line from the line's own point, mm."""
        start, course = (complex(value) for value in self.paper.value[line])
        return float(((place(self.paper, point) - start) / course).real * abs(course))

    def on_line(self) -> dict[LineName, list[PointName]]:
        """Return the points on every drawn line that determine its extent."""
        found: dict[LineName, list[PointName]] = {}
        for step in self.synthesis.board.steps:
            match step:
                case steps.Join(out, tail, head):
                    found[out] = [tail, head]
                case steps.IntersectLines(out, first, second):
                    found[first].append(out)
                    found[second].append(out)
                case steps.IntersectLineCircle(out, line) | steps.LayOffLength(out, _, line):
                    found[line].append(out)
                case steps.GivenPoint() | steps.IntersectCircles():
                    pass
                case _ if result_kind(step) is LineName:
                    found[LineName(step.out)] = [step.through]  # type: ignore[union-attr]
                case _:
                    pass
        return found


@memoized
def construction_of(solution: Solution) -> Drawn:
    """Return the construction of ``[synthesis]`` of a problem, which it must have."""
    task = solution.problem.synthesis
    assert task is not None
    return Drawn(synthesize(task.kind, task.data), solution.profile, letters=task.letters)


def arc_over(
    trace: Trace, centre: str, points: Sequence[str]
) -> tuple[complex, float, float, float]:
    """Return the shortest arc over points of a circle: centre, radius, start and sweep, radians.

    Of one point: the whole circle.
    """
    middle = place(trace, centre)
    turns = sorted(cmath.phase(place(trace, p) - middle) for p in points)
    gaps = [(after - turn) % tau for turn, after in pairwise([*turns, turns[0]])] or [0.0]
    k = max(range(len(gaps)), key=gaps.__getitem__)
    radius = abs(place(trace, points[0]) - middle)
    return middle, radius, turns[(k + 1) % len(turns)], tau - gaps[k]


def file_record(solution: Solution, checks: Mapping[str, Any]) -> dict[str, Any]:
    """Return the synthesis of a file: its record, the letters of the file, θ, and its results.

    ``values`` are those that numbers of the file may name, m and degrees.
    """
    drawn, task = construction_of(solution), solution.problem.synthesis
    assert task is not None
    return {
        **synthesis_record(drawn, checks),
        "points": {one: task.letters.get(one, one) for one in drawn.synthesis.letters},
        "theta_deg": drawn.synthesis.theta_deg,
        "values": drawn.synthesis.values(task.letters),
    }


def synthesis_record(drawn: Drawn, checks: Mapping[str, Any]) -> dict[str, Any]:
    """Return lengths (m), checks (m, degrees), and the results of a drawing by hand."""
    made, lengths = drawn.synthesis, drawn.series
    return {
        "kind": made.kind,
        "given": {name: value for name, value in made.options.items() if value is not None},
        "lengths": made.metres(),
        "checks": dict(checks),
        "drawing": {
            "mu_l": drawn.mu,
            "read": {one.symbol: finite_or_none(one.read[0]) for one in lengths},
            "sigma": {one.symbol: finite_or_none(one.sigma[0]) for one in lengths},
        },
    }
