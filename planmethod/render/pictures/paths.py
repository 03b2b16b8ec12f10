"""Paths of the points between the drawn positions (траектории) and the extreme positions."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from functools import cached_property
from math import tau

import numpy as np
from msgspec import Struct

from planmethod.construct.arithmetic import Float64
from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import cis
from planmethod.render.ink.drawing import Arc, Item, Pen, Stroke
from planmethod.solved.cycle_forces import DriverPath
from planmethod.solved.failures import PositionError
from planmethod.solved.reading import Complexes, Reals
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import crank_cycle_of

TRAJECTORY = "trajectory"
"""Tag of the line that a point moves along: ``trajectory B``."""

AWAY = 0.5
"""Extent of a point's line beyond its drawn positions, relative to their size.

Further off the line would fit no sheet: a dead position lies between two drawn ones. Then it ends
within `NEAR`, and where the point is so fast that its places are further apart than this.
"""

NEAR = 0.1
"""The same for a line that is broken off."""

_ROUND = 0.05  # mm between a line and its curve, from which corners are seen
_FINER = 32  # parts of a step at most
_AT_PLACE = 0.1  # mm from a drawn place: the line is at it
_FLAT = 0.02  # mm off its chord: a straight line on the paper
_MIN_ROUNDNESS = (
    0.05  # area of a closed line over that of a circle as long: it has no inside below that
)


class Paths(Struct, frozen=True, dict=True):
    """Paths of the points of a mechanism between the positions of a solution."""

    solution: Solution

    @cached_property
    def driver_path(self) -> DriverPath:
        """The driver positions that the lines go through."""
        return DriverPath(self.solution)

    @cached_property
    def _trace(self) -> dict[str, Complexes]:
        """Places of all points, NaN where the mechanism cannot be assembled, mm."""
        return self._places_at(self.driver_path.positions)

    @cached_property
    def _fine_trace(self) -> dict[str, Complexes]:
        """The same with shorter steps where a point is so fast that its line would have corners."""
        positions = self.driver_path.positions
        curved = [way for p, way in self._trace.items() if not self._is_arc(p, way)]
        if len(positions) < 3 or not curved:
            return self._trace
        bends = np.abs([np.diff(places, 2) for places in curved]) / 8.0
        off = np.max(np.where(np.isnan(bends), 0.0, bends), axis=0)
        parts = np.clip(np.ceil(np.sqrt(off / _ROUND)), 1, _FINER).astype(int)
        counts = np.maximum([1, *parts], [*parts, 1])  # of the steps on both sides of a place
        if counts.max() == 1:
            return self._trace
        steps = zip(positions[:-1], np.diff(positions), counts, strict=True)
        lines = [start + step * np.arange(count) / count for start, step, count in steps]
        return self._places_at(np.concatenate([*lines, positions[-1:]]))

    def _places_at(self, positions: Reals) -> dict[str, Complexes]:
        """Return the places of all points at driver positions, mm."""
        s = self.solution
        between = self._solution_between(positions).drawn_at(s.scales)
        trace = between.read(Float64(), between.per_mm)
        points = {p for body in between.problem.bodies.values() for p in body.points}
        return {point: trace.point(PointName(point)) for point in points}

    def _solution_between(self, positions: Reals) -> Solution:
        """Return the mechanism in positions between those of the solution.

        Several drivers move evenly from one position to the next one.
        """
        s = self.solution
        if not s.problem.drive.other_drives:
            return s.with_positions(positions.tolist())
        order = np.argsort(s.positions, kind="stable")
        own = [np.interp(positions, s.positions[order], one[order]) for one in s.places[1:]]
        return s.in_places([positions, *own])

    def of(self, point: str) -> Complexes:
        """Return the places of a point, mm, ndarray of shape (n,)."""
        return self._trace[point]

    def pivot(self, point: str) -> complex | None:
        """Return the fixed point about which a point turns at a constant distance, mm."""
        bodies = self.solution.problem.bodies
        for link, body in bodies.items():
            if link == FRAME or point not in body.points:
                continue
            for fixed in body.points:
                if fixed in bodies[FRAME].points:
                    return complex(self.of(fixed)[0])
        return None

    def _is_arc(self, point: str, places: Complexes) -> bool:
        """Return whether a point describes an arc, or a circle, in one piece."""
        return self.pivot(point) is not None and not np.isnan(places).any()

    # Lines -----------------------------------------------------------------------------------

    def lines(self, point: str, shown: Complexes, joints: Complexes) -> list[Item]:
        """Return the thin line that a point moves along: circle, arc or smooth curve.

        A point that moves in a straight line has none: the axis of its guide shows it. Where the
        point goes far beyond the ``shown`` places, of shape (n,) in mm, the line breaks off. An
        open line and the parts of a broken one end at places of the point itself, ``joints``,
        of shape (m,).
        """
        places = self._fine_trace[point]
        tag = f"{TRAJECTORY} {point}"
        pivot = self.pivot(point)
        if pivot is not None and self._is_arc(point, places):
            return _arc(places, pivot, tag)
        middle = complex(_middle(shown.real), _middle(shown.imag))
        wide, high = float(np.ptp(shown.real)), float(np.ptp(shown.imag))
        size, off = max(wide, high), places - middle
        beyond = np.maximum(np.abs(off.real) - wide / 2, np.abs(off.imag) - high / 2)
        if (beyond > AWAY * size).any():
            steps = np.abs(np.diff(places, append=places[-1:]))
            places = np.where((beyond > NEAR * size) | (steps > NEAR * size), np.nan, places)
        gaps, closed = np.isnan(places), self.driver_path.closed
        if gaps.any() and closed:  # no part begins where the turn does
            places = np.roll(places[:-1], -int(np.argmax(gaps[:-1])))
        parts = _unbroken(places)
        if gaps.any() or not closed:
            parts = [_between(part, joints) for part in parts]
        return [
            Stroke(tuple(complex(p) for p in part), Pen.THIN, tag=tag)
            for part in parts
            if len(part) > 1 and not _is_straight(part)
        ]

    def outward(self, point: str, places: Sequence[complex]) -> list[complex]:
        """Return the preferred directions of a point's labels at some of its places.

        Normal to the line that it moves along: out of a closed one, on the convex side of an open
        one. All on the same side, so that they read as a series; 0 where the side does not matter.
        """
        way = self.of(point)
        way = way[~np.isnan(way)]
        pivot = self.pivot(point)
        if pivot is not None:
            return [place - pivot for place in places]
        if len(way) < 3 or _is_straight(way):
            return [0j for _ in places]
        ring = np.append(way, way[0])
        area = float(np.sum((np.conj(ring[:-1]) * ring[1:]).imag)) / 2
        length = float(np.sum(np.abs(np.diff(ring))))
        if self.driver_path.closed and abs(area) > _MIN_ROUNDNESS * length**2 / (2 * tau):
            side = -1j if area > 0 else 1j
        else:
            bend = float(np.sum((np.conj(np.diff(way)[:-1]) * np.diff(way)[1:]).imag))
            side = -1j if bend > 0 else 1j
        found = []
        for place in places:
            k = int(np.argmin(np.abs(way - place)))
            along = way[min(k + 1, len(way) - 1)] - way[max(k - 1, 0)]
            found.append(complex(along) * side)
        return found

    # Extreme positions -----------------------------------------------------------------------

    @cached_property
    def output(self) -> tuple[str, str] | None:
        """Last link of the groups that is joined with the frame, and its moving point."""
        s = self.solution
        if s.problem.cycle is not None:
            output = crank_cycle_of(s).output
            return output.link, output.point
        bodies, fixed = s.problem.bodies, s.problem.bodies[FRAME].points
        on_frame = {
            slide.slider: slide for slide in s.problem.slides.values() if slide.host == FRAME
        }
        for group in reversed(s.structure.groups):
            for link in reversed(group.links):
                if link in on_frame:
                    return link, on_frame[link].pin
                points = bodies[link].points
                if any(p in fixed for p in points) and any(p not in fixed for p in points):
                    return link, next(p for p in points if p not in fixed)
        return None

    @cached_property
    def extremes(self) -> tuple[float, ...]:
        """Driver positions at which the output link reverses (крайние положения), at most two.

        The furthest in each direction, in the order of the driver's motion; empty if the link
        rotates fully, does not reverse within the drawn positions, is too far away in one, or
        reverses where another group does not assemble.
        """
        s, found = self.solution, self._turning_positions()
        if not found:
            return ()
        try:
            shown = s.with_positions([*s.positions.tolist(), *found]).extents.on_scheme
        except PositionError:
            return ()
        return found if shown[len(s.positions) :].all() else ()

    def _turning_positions(self) -> tuple[float, ...]:
        """Return the driver positions at which the output link reverses, however far it is."""
        if self.output is None or self.solution.problem.drive.other_drives:
            return ()  # the output of several drivers reverses wherever these make it
        if self.driver_path.closed and self.solution.problem.drive.goes_round:
            turn = crank_cycle_of(self.solution)
            whole = turn.period
            return tuple(sorted(round(end.phi % whole, 9) % whole for end in turn.ends or ()))
        link, point = self.output
        places = self.of(point)
        if np.isnan(places).any() or len(places) < 5:
            return ()
        slide = next((s for s in self.solution.problem.slides.values() if s.slider == link), None)
        if slide is not None and slide.host == FRAME:
            reach = (places * np.conj(cis(slide.angle))).real
        else:
            pivot = self.pivot(point)
            assert pivot is not None
            reach = np.unwrap(np.angle(places - pivot))
            if np.ptp(reach) > 0.999 * tau:
                return ()
        found = {self._turn(reach, int(np.argmin(reach))), self._turn(reach, int(np.argmax(reach)))}
        return tuple(sorted(position for position in found if position is not None))

    def _turn(self, reach: Reals, k: int) -> float | None:
        """Return the driver position of an extreme near the one numbered ``k``."""
        if k in (0, len(reach) - 1):
            return None
        before, after = k - 1, k + 1
        a, b, c = float(reach[before]), float(reach[k]), float(reach[after])
        bend = a - 2 * b + c
        if abs(bend) < 1e-12:
            return None
        step = float(self.driver_path.positions[1] - self.driver_path.positions[0])
        # The vertex of the parabola through three places.
        return float(self.driver_path.positions[k]) + step * (a - c) / (2 * bend)


def _middle(values: Reals) -> float:
    return float(np.min(values) + np.max(values)) / 2


def _unbroken(places: Complexes) -> list[Complexes]:
    """Return the parts of a line between the positions that do not exist."""
    gaps = np.flatnonzero(np.isnan(places))
    return [part[~np.isnan(part)] for part in np.split(places, gaps)]


def _between(part: Complexes, joints: Complexes) -> Complexes:
    """Return a part of a line from the first to the last of some places on it."""
    off = np.abs(part[:, None] - joints).min(axis=1)
    at = np.flatnonzero(off < _AT_PLACE)
    return part[at[0] : at[-1] + 1] if at.size else part[:0]


def _is_straight(places: Complexes) -> bool:
    far = places[int(np.argmax(np.abs(places - places[0])))] - places[0]
    if abs(far) < 2 * _FLAT:
        return True
    return bool(np.max(np.abs(((places - places[0]) * np.conj(far)).imag)) / abs(far) < _FLAT)


def _arc(places: Complexes, pivot: complex, tag: str) -> list[Item]:
    """Return the circle, or its arc, that a point describes about a fixed point."""
    radius = float(np.mean(np.abs(places - pivot)))
    if radius < _FLAT:
        return []
    turn = np.unwrap(np.angle(places - pivot))
    low, high = float(turn.min()), float(turn.max())
    if high - low > tau - 1e-6:
        return [Arc(pivot, radius, pen=Pen.THIN, tag=tag)]
    if (high - low) * radius < 2 * _FLAT:
        return []
    low = cmath.phase(cmath.exp(1j * low))
    return [Arc(pivot, radius, low, low + float(np.ptp(turn)), Pen.THIN, tag)]
