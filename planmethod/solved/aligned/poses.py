"""Poses for evaluating ranks: the problem's sizes closed by Newton's method, group by group.

Groups of any class close here, and assembly rules are not used: a rank in a general position does
not depend on the assembly. If there are no sizes, or none that close, joints and lines are placed
at random.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Sequence
from math import isfinite, pi, radians
from random import Random

from msgspec import Struct

from planmethod.mechanism.groups import AssurGroup, Joint, links_of
from planmethod.mechanism.model import FRAME, HigherPair, Mechanism, Prismatic, Revolute
from planmethod.mechanism.structure import Structure
from planmethod.problem.model import Drive, Problem, Slide

STEP, STEPS = radians(15.3), 24
"""Between two poses of a sweep (no divisor of a right angle), and how many there are at most."""

STARTS, ELSEWHERE, TRIES, ITERATIONS = 16, 4, 3, 14
"""Numbers of random starts of all groups at the requested position of the driver and at another
one, of starts of each group, and of Newton iterations."""

STEP_RATIO = 0.6
"""Share of the step of a driver by which the next one of a file moves, against its sense."""

CLOSED = 1e-10
"""Gap at which a group counts as closed, in parts of the mechanism's size or radians."""


class PlanePose(Struct, frozen=True):
    """Places of the points, and a point and the direction of every slide (положение), m.

    ``random``: not that of the file's sizes.
    """

    mechanism: Mechanism
    places: dict[str, complex]
    lines: dict[Prismatic, tuple[complex, complex]]
    random: bool = False

    def line(self, joint: Joint | HigherPair) -> tuple[complex, complex]:
        """Return a point and the direction of a joint: 0 of a hinge, the normal of profiles."""
        if isinstance(joint, Prismatic):
            return self.lines[joint]
        if isinstance(joint, Revolute):
            return self.places[joint.point], 0j
        of = self.mechanism
        ends = [self.places[pin.point] for pin in of.revolutes if joint.by in pin.links]
        if len(ends) == 2:
            return ends[0], (ends[1] - ends[0]) / abs(ends[1] - ends[0])
        at, along = next(line for pair, line in self.lines.items() if pair.slider == joint.by)
        return at, 1j * along


Links = dict[str, tuple[complex, complex]]
"""Origin and direction of the own axis of each link that stands."""


def poses(problem: Problem, structure: Structure) -> list[PlanePose]:
    """Return poses of a sweep of the driver, starting with that of the file's first position.

    If the mechanism does not close there, another position is first; if it closes nowhere, the
    poses are random.
    """
    made = _Sizes(problem, structure).swept() if problem.bodies else []
    return made or [_random_pose(problem.mechanism, Random(seed)) for seed in (1, 2, 3)]


class _Sizes(Struct):
    """A problem being closed."""

    problem: Problem
    structure: Structure
    size: float = 1.0

    def __post_init__(self) -> None:
        points = [abs(z) for body in self.problem.bodies.values() for z in body.points.values()]
        bases = [abs(slide.base) + abs(slide.offset) for slide in self.problem.slides.values()]
        self.size = max([*points, *bases]) or 1.0

    def swept(self) -> list[PlanePose]:
        drive, rng = self.problem.drive, Random(1)
        asked = drive.assembly_positions or drive.positions
        sought = not isfinite(asked[0])  # an output determines a position not found yet
        if sought:
            asked = (0.0,)
        if drive.cam_drive is not None:  # positions are of the cam: it is moved from its lowest
            asked = (drive.cam_drive.lowest,)
        first = [radians(p) if drive.is_crank else p for p in asked]
        reach = max(first) - min(first) if len(first) > 1 else self.size
        step = STEP if drive.is_crank else reach / STEPS
        others = [first[0] + 3.7 * k * step for k in range(1, 10)]
        if sought:
            first = []
        for start in [*first[:1], *others, *first]:
            begun = self._closed(start, rng, STARTS if start in first else ELSEWHERE)
            if begun is None:
                continue
            found = [begun]
            for way in (1, -1):  # as far as it goes, to both sides of the start
                last = begun
                for k in range(1, STEPS):
                    after = self._closed(start + way * k * step, rng, 1, last)
                    if after is None or len(found) == STEPS:
                        break
                    found.append(after)
                    last = after
            return [self._pose(links) for links in found]
        return []

    def _drivers(self, position: float) -> Links:
        """Return all driving links, the first one in a position; the others move by a share of it.

        Equal steps of all would keep a symmetric mechanism in special positions.
        """
        links = Links()
        way = position - self._first(self.problem.drive)
        for number, drive in enumerate(self.problem.drive.every):
            at = self._first(drive) + way * (-STEP_RATIO) ** number
            links[drive.link] = self._driver(drive, at)
        return links

    def _first(self, drive: Drive) -> float:
        """Return the first position of a driver, rad or m; 0 if an output determines it."""
        place = (drive.assembly_positions or drive.positions)[0]
        if drive.cam_drive is not None:  # positions are of the cam
            return drive.cam_drive.lowest
        if not isfinite(place):
            return 0.0
        return radians(place) if drive.is_crank else place

    def _driver(self, drive: Drive, position: float) -> tuple[complex, complex]:
        bodies = self.problem.bodies
        if drive.pivot is not None:
            turn = cmath.exp(1j * position)
            points = bodies[drive.link].points
            return bodies[FRAME].points[drive.pivot] - turn * points[drive.pivot], turn
        slide = self.problem.slides[drive.link]
        turn = cmath.exp(1j * radians(slide.angle))
        pin = slide.base + turn * complex(position, slide.offset)
        return pin - turn * bodies[drive.link].points[slide.pin], turn

    def _closed(
        self, position: float, rng: Random, starts: int, last: Links | None = None
    ) -> Links | None:
        """Return the links at a position of the driver, near those of the last one, if any."""
        for _ in range(starts):  # again from the first group: a later one may not close on another
            links = {FRAME: (0j, 1 + 0j), **self._drivers(position)}
            if all(self._joined(group, links, rng, last) for group in self.structure.groups):
                return links
        return None

    def _joined(self, group: AssurGroup, links: Links, rng: Random, last: Links | None) -> bool:
        """Close a group on the known links, begun near the last pose or at random."""
        for _ in range(1 if last else TRIES):
            start = self._random(group, links, rng) if last is None else last
            numbers = [
                number
                for origin, turn in (start[link] for link in group.links)
                for number in (origin.real, origin.imag, cmath.phase(turn))
            ]
            if self._close(group, links, numbers):
                return True
        return False

    def _random(self, group: AssurGroup, links: Links, rng: Random) -> Links:
        """Return the links of a group laid from joint to joint, those of its own at random."""
        size, bodies = self.size, self.problem.bodies
        places: dict[str, complex] = {}
        for joint, one, _ in group_pairs(group):
            name = joint.point if isinstance(joint, Revolute) else joint.pin
            if one in links and isinstance(joint, Revolute):
                origin, turn = links[one]
                places[name] = origin + turn * bodies[one].points[name]
            near = links[group.legs[0].to][0]
            away = complex(rng.uniform(-size, size), rng.uniform(-size, size))
            places.setdefault(name, near + away)
        found = {}
        for link in group.links:
            own = [(places[name], at) for name, at in bodies[link].points.items() if name in places]
            turn = cmath.exp(1j * rng.uniform(-pi, pi))
            if len(own) > 1 and own[1][1] != own[0][1] and own[1][0] != own[0][0]:
                span = (own[1][0] - own[0][0]) / (own[1][1] - own[0][1])
                turn = span / abs(span)
            at, local = own[0] if own else (complex(rng.uniform(-size, size)), 0j)
            found[link] = (at - turn * local, turn)
        return found

    def _close(self, group: AssurGroup, known: Links, start: list[float]) -> bool:
        """Close a group by Newton's method and add its links to the known; False if it fails."""
        outer = {lead.to: known[lead.to] for lead in group.legs}

        def posed_links(q: Sequence[float]) -> Links:
            own = {
                link: (complex(q[3 * i], q[3 * i + 1]), cmath.exp(1j * q[3 * i + 2]))
                for i, link in enumerate(group.links)
            }
            return {**outer, **own}

        q = _newton(lambda q: self._gaps(group, posed_links(q)), start, self.size)
        if q is None:
            return False
        known.update(posed_links(q))
        return True

    def _gaps(self, group: AssurGroup, links: Links) -> list[float]:
        found: list[float] = []
        bodies = self.problem.bodies
        for joint, one, other in group_pairs(group):
            if isinstance(joint, Revolute):
                ends = [links[x][0] + links[x][1] * bodies[x].points[joint.point]
                        for x in (one, other)]  # fmt: skip
                gap = ends[0] - ends[1]
                found += [gap.real, gap.imag]
                continue
            slide = self._slide(joint)
            foot, along = self._line(slide, links)
            pin = self._pin(slide, links)
            turned = cmath.phase(links[slide.slider][1] * along.conjugate())
            found += [((pin - foot) * along.conjugate()).imag - slide.offset, self.size * turned]
        return found

    def _slide(self, joint: Prismatic) -> Slide:
        return self.problem.slides[joint.slider]

    def _line(self, slide: Slide, links: Links) -> tuple[complex, complex]:
        origin, turn = links[slide.host]
        return origin + turn * slide.base, turn * cmath.exp(1j * radians(slide.angle))

    def _pin(self, slide: Slide, links: Links) -> complex:
        origin, turn = links[slide.slider]
        return origin + turn * self.problem.bodies[slide.slider].points[slide.pin]

    def _pose(self, links: Links) -> PlanePose:
        mechanism = self.problem.mechanism
        places = {}
        for joint in mechanism.revolutes:
            origin, turn = links[joint.links[0]]
            at = self.problem.bodies[joint.links[0]].points[joint.point]
            places[joint.point] = origin + turn * at
        lines = {}
        for pair in mechanism.prismatics:
            slide = self._slide(pair)
            along = self._line(slide, links)[1]
            lines[pair] = (self._pin(slide, links) - 1j * along * slide.offset, along)
        return PlanePose(mechanism, places, lines)


def group_pairs(group: AssurGroup) -> list[tuple[Joint, str, str]]:
    """Return the pairs of a group with their links: a joint of k links of it has several."""
    found = [(lead.joint, lead.to, lead.link) for lead in group.legs]
    for joint in group.inner:
        first, *others = [link for link in links_of(joint) if link in group.links]
        found += [(joint, first, other) for other in others]
    return found


def _newton(
    gaps: Callable[[Sequence[float]], list[float]], start: list[float], size: float
) -> list[float] | None:
    q = start
    for _ in range(ITERATIONS):
        values = gaps(q)
        if max(map(abs, values)) < CLOSED * size:
            return q
        columns = []
        for i, number in enumerate(q):
            h = 1e-7 * (1.0 if i % 3 == 2 else size)
            moved = gaps([*q[:i], number + h, *q[i + 1 :]])
            columns.append([(a - b) / h for a, b in zip(moved, values, strict=True)])
        change = _solved(columns, values, size)
        if change is None:
            return None
        q = [a - b for a, b in zip(q, change, strict=True)]
    return None


def _solved(columns: list[list[float]], right: list[float], size: float) -> list[float] | None:
    """Solve a small system by Gauss, given its columns; None where it is singular."""
    n = len(right)
    rows = [[*(column[i] for column in columns), right[i]] for i in range(n)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        head = rows[k]
        if abs(head[k]) < 1e-12 * size:
            return None
        for row in rows[k + 1 :]:
            share = row[k] / head[k]
            if share:
                row[k:] = [a - share * b for a, b in zip(row[k:], head[k:], strict=True)]
    found = [0.0] * n
    for k in range(n - 1, -1, -1):
        rest = sum(rows[k][i] * found[i] for i in range(k + 1, n))
        found[k] = (rows[k][n] - rest) / rows[k][k]
    return found


def _random_pose(mechanism: Mechanism, rng: Random) -> PlanePose:
    """Return joints and lines at random; a slider's line passes through its pin."""
    names = [joint.point for joint in mechanism.revolutes]
    names += [pair.pin for pair in mechanism.prismatics if pair.pin not in names]
    places = {name: complex(rng.uniform(-1, 1), rng.uniform(-1, 1)) for name in names}
    lines = {
        pair: (places[pair.pin], cmath.exp(1j * rng.uniform(0, pi)))
        for pair in mechanism.prismatics
    }
    return PlanePose(mechanism, places, lines, random=True)
