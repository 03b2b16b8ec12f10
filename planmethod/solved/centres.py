"""Instant centres of a linkage by Kennedy's lines, and velocities by them (мгновенные центры).

A centre is a homogeneous vector (x, y, w): the point (x, y)/w, at infinity where w is 0. So a slide
is a centre like any other, and a line is the cross product of two centres. A motion is such a
vector, too, its centre times ω: motions of links add as vectors do.

Three links have their three centres on one line (Kennedy's theorem). A centre is where two such
lines meet; of several the pair that meets most squarely is taken. Centres that no two lines give,
as in groups of class III, follow from the velocities of the plan. Wheels in mesh have theirs in the
pole, a wheel that rolls in the contact; the link that replaces a contact is none of the mechanism.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from planmethod.arguments import known, number_of
from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.solved.solution import Solution

Homogeneous: TypeAlias = NDArray[np.float64]
"""A centre or a motion: x, y, w, shape (3,)."""

Pair: TypeAlias = tuple[str, str]

SQUARE = (1e-4, 1e-8)
"""Least sine of the angle of two lines that give a centre: of the first search, of the second."""

AT_INFINITY = 1e-9
"""Part of the size of a centre below which its w is 0: at infinity."""


class Centre(Struct, frozen=True):
    """Instant centre of the motion of one link relative to another (мгновенный центр).

    Attributes
    ----------
    links : (str, str)
        In the order of the file, the frame first.
    at : complex, m
        NaN at infinity, or where the links do not move relative to one another.
    towards : complex
        Unit direction in which a centre at infinity lies; NaN of others.
    point : str
        Joint that it is; empty if it is none.
    pole : str
        Pole of a mesh, or contact of a wheel that rolls, that it is; empty if it is none.
    slide : str
        Line of the slide to which its direction is perpendicular; empty if there is none.
    by : tuple of str
        Links whose centres with both give the two lines; empty for joints, poles, slides, and
        centres from velocities.
    """

    links: Pair
    at: complex
    towards: complex
    point: str = ""
    slide: str = ""
    by: tuple[str, ...] = ()
    pole: str = ""

    @property
    def is_infinite(self) -> bool:
        """True if it is at infinity."""
        return bool(np.isnan(self.at) and not np.isnan(self.towards))


class CentreMotion(Struct, frozen=True):
    """Motion of a link, from its centres: the angular velocity, 1/s, and its centre (движение)."""

    link: str
    omega: float
    twist: tuple[float, float, float]

    def velocity(self, place: complex) -> complex:
        """Return the velocity of a point of the link, m/s, from its place, m."""
        x, y, w = self.twist
        return 1j * (w * place - complex(x, y))


class Centres(Struct, frozen=True):
    """All instant centres in one position, and the motions that they give.

    Attributes
    ----------
    links : tuple of str
        The frame first.
    centres : mapping of (str, str) to Centre
    motions : mapping of str to CentreMotion
    """

    links: tuple[str, ...]
    centres: Mapping[Pair, Centre]
    motions: Mapping[str, CentreMotion]

    def of(self, first: str, second: str) -> Centre:
        """Return the centre of two links, in any order.

        Raises
        ------
        UnknownNameError
            There is no such link.
        """
        pair = (known("link", one, self.links) for one in (first, second))
        return self.centres[ordered(self.links, *pair)]

    def __repr__(self) -> str:
        return f"Centres(links {', '.join(self.links)}: {len(self.centres)} centres)"


def ordered(links: tuple[str, ...], first: str, second: str) -> Pair:
    """Return two links in their order."""
    if links.index(first) > links.index(second):
        return second, first
    return first, second


def find_centres(solution: Solution, index: int = 0) -> Centres:
    """Return all instant centres of a linkage in one position, and the velocities by them.

    Parameters
    ----------
    index : int
        Number of the position.

    Raises
    ------
    PositionError
        The mechanism does not exist there.
    """
    number_of("position", index, len(solution.positions))
    search = _Search(solution, index)
    search.run()
    return Centres(search.links, search.named(), search.motions())


class _Search:
    """Centres in the making: lengths are in sizes of the mechanism about its middle."""

    def __init__(self, solution: Solution, index: int) -> None:
        self.solution, self.index = solution, index
        mechanism = solution.problem.mechanism
        contacts = {mesh.carrier for mesh in mechanism.rolling}
        self.links = (FRAME, *(link for link in mechanism.links if link not in contacts))
        places = np.array([one.place[index] for one in solution.points.values()])
        self.middle = complex(np.mean(places))
        self.size = float(np.max(np.abs(places - self.middle))) or 1.0
        self.found: dict[Pair, Homogeneous] = {}
        self.by: dict[Pair, tuple[str, ...]] = {}
        self.points: dict[Pair, str] = {}
        self.poles: dict[Pair, str] = {}
        self.slides: dict[Pair, str] = {}
        self.moved = {FRAME: np.zeros(3)} | {
            link: self._plan_motion(solution.at_unit_rate(), link) for link in self.links[1:]
        }

    def _plan_motion(self, solution: Solution, link: str) -> Homogeneous:
        """Return the motion of a link by the plan of velocities."""
        point = next(one for one in solution.problem.bodies[link].points if one in solution.points)
        motion, omega = solution.points[point], solution.links[link].omega[self.index]
        place = (motion.place[self.index] - self.middle) / self.size
        pole = 1j * motion.velocity[self.index] / self.size + omega * place
        return np.array([pole.real, pole.imag, omega])

    def run(self) -> None:
        """Find the centres of joints, poles and slides, then those by lines, then the others."""
        problem = self.solution.problem
        for joint in problem.mechanism.revolutes:
            links = [link for link in joint.links if link in self.links]
            for one, other in combinations(links, 2):
                self._mark(ordered(self.links, one, other), joint.point, self.points)
        for mesh in problem.meshes:
            self._mark(ordered(self.links, *mesh.mesh.links), mesh.pole, self.poles)
        for slide in problem.slides.values():
            if slide.slider not in self.links:
                continue
            pair = ordered(self.links, slide.slider, slide.host)
            turn = np.radians(self.solution.links[slide.slider].phi_deg[self.index])
            self.found[pair] = np.array([-np.sin(turn), np.cos(turn), 0.0])
            self.slides[pair] = slide.label
            self.points.pop(pair, None)
        for least in SQUARE:
            while any(self._by_lines(pair, least) for pair in self._unknown()):
                pass
        for pair in self._unknown():
            one, other = pair
            relative = self.moved[other] - self.moved[one]
            size = float(np.linalg.norm(relative))
            most = max(float(np.linalg.norm(self.moved[link])) for link in pair)
            if size > AT_INFINITY * most:
                self.found[pair] = relative / size

    def _mark(self, pair: Pair, name: str, names: dict[Pair, str]) -> None:
        """Take a named point of the plan for a centre that is not found yet."""
        if pair not in self.found:
            near = (self.solution.place(PointName(name))[self.index] - self.middle) / self.size
            self.found[pair] = _unit(np.array([near.real, near.imag, 1.0]))
            names[pair] = name

    def _unknown(self) -> Iterator[Pair]:
        pairs = combinations(self.links, 2)
        return iter([pair for pair in pairs if pair not in self.found])

    def _by_lines(self, pair: Pair, least: float) -> bool:
        """Find a centre by the two lines that meet most squarely, and return whether they exist."""
        lines: dict[str, Homogeneous] = {}
        for third in self.links:
            if third in pair:
                continue
            ends = [self.found.get(ordered(self.links, one, third)) for one in pair]
            if ends[0] is None or ends[1] is None:
                continue
            line = np.cross(ends[0], ends[1])
            if (size := float(np.linalg.norm(line))) > least:
                lines[third] = line / size
        best, by = least, ("", "")
        for one, other in combinations(lines, 2):
            meet = np.cross(lines[one], lines[other])
            if (size := float(np.linalg.norm(meet))) > best:
                best, by = size, (one, other)
        if not by[0]:
            return False
        self.found[pair] = _unit(np.cross(lines[by[0]], lines[by[1]]))
        self.by[pair] = by
        return True

    def named(self) -> dict[Pair, Centre]:
        """Return the centres in metres."""
        return {
            pair: self._centre(pair, self.found.get(pair)) for pair in combinations(self.links, 2)
        }

    def _centre(self, pair: Pair, vector: Homogeneous | None) -> Centre:
        nothing = complex(np.nan, np.nan)
        at = towards = nothing
        if vector is not None:
            x, y, w = map(float, vector)
            if abs(w) > AT_INFINITY * np.hypot(x, y):
                at = self.middle + self.size * complex(x, y) / w
            else:
                towards = complex(x, y) / abs(complex(x, y))
        point, slide = self.points.get(pair, ""), self.slides.get(pair, "")
        by, pole = self.by.get(pair, ()), self.poles.get(pair, "")
        return Centre(pair, at, towards, point, slide, by, pole)

    def motions(self) -> dict[str, CentreMotion]:
        """Return the motions: that of the driver is given, the others follow by the centres.

        The motion of a link less that of a known one is along their centre: of all known links that
        one is taken which determines it best.
        """
        driver = self.solution.problem.mechanism.driver
        found = {FRAME: np.zeros(3), driver: self._plan_motion(self.solution, driver)}
        while True:
            best = max(
                (one for link in self.links if link not in found for one in self._by(link, found)),
                key=lambda one: one[0],
                default=None,
            )
            if best is None:
                break
            found[best[1]] = best[2]
        return {link: self._motion(link, twist) for link, twist in found.items() if link != FRAME}

    def _by(
        self, link: str, known: Mapping[str, Homogeneous]
    ) -> Iterator[tuple[float, str, Homogeneous]]:
        """Yield the motion of a link by each known one, with the sine that determines it."""
        own = self.found.get((FRAME, link))
        if own is None:  # at rest
            yield 2.0, link, np.zeros(3)
            return
        for other, motion in known.items():
            between = self.found.get(ordered(self.links, link, other))
            if other == FRAME or between is None:
                continue
            sine = float(np.linalg.norm(np.cross(own, between)))
            if sine > SQUARE[-1]:
                table = np.array([own, -between]).T
                (size, _), *_ = np.linalg.lstsq(table, motion, rcond=None)
                yield sine, link, size * own

    def _motion(self, link: str, twist: Homogeneous) -> CentreMotion:
        x, y, w = map(float, twist)
        pole = self.size * complex(x, y) + w * self.middle
        return CentreMotion(link, w, (pole.real, pole.imag, w))


def _unit(vector: Homogeneous) -> Homogeneous:
    return np.asarray(vector / np.linalg.norm(vector))
