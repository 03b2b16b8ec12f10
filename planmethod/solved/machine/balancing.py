"""Static balancing of a four-bar and a slider-crank by counterweights (уравновешивание).

The rod is replaced by two masses in its pins, statically: m_A = m·(1 - w), m_B = m·w, where w is
the centre of mass on the line from A to B, 0 in A and 1 in B. With w a complex number this holds
for a centre beside the line, too (Berkof and Lowen's independent vectors). The counterweight of a
link then closes the polygon of vectors m·r of the masses on its axis, and the centre of all masses
is at rest. A slider-crank has a counterweight on the rod first, which brings rod and slider to the
pin.

Source: Артоболевский, Теория механизмов и машин, гл. 13.
"""

from __future__ import annotations

from functools import cached_property
from math import degrees

import numpy as np
from msgspec import Struct

from planmethod.construct.arithmetic import Float64
from planmethod.construct.drafting import Profile, RulerArithmetic
from planmethod.construct.evaluate import evaluate
from planmethod.construct.scale import choose_scale
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.plans.diagrams import MassMoments, build_mass_moments
from planmethod.problem.machine_records import Weighing
from planmethod.problem.model import Problem
from planmethod.solved.cycle_motion import CycleMotion
from planmethod.solved.reading import Complexes, Memoizing, Reading, Reals, memoized
from planmethod.solved.solution import Solution

FOUR_BAR, SLIDER_CRANK = "four-bar", "slider-crank"

SAMPLES = 3600
"""Positions of a turn of which the largest force is."""

LONGEST = 80.0
"""Length of the longest vector of a polygon, mm."""


class Counterweight(Struct, frozen=True):
    """A counterweight and what it balances (противовес).

    Attributes
    ----------
    link, pivot, pin : str
        The link, the pin that its moment is about, and the other end of the line of the link.
    terms : tuple of (str, complex), kg·m
        Vectors m·r that it balances with their letters, from the line of the link.
    length, radius : float, m
        Of the line, and where the counterweight stands.
    """

    link: str
    pivot: str
    pin: str
    terms: tuple[tuple[str, complex], ...]
    length: float
    radius: float

    @property
    def moment(self) -> complex:
        """m·r of the counterweight, kg·m, from the line of the link."""
        return -sum((value for _, value in self.terms), 0j)

    @property
    def mass(self) -> float:
        """Mass, kg."""
        return abs(self.moment) / self.radius

    @property
    def place(self) -> complex:
        """Its position, as a fraction of the link's line from the pivot; 0 if there is none."""
        size = abs(self.moment)
        return self.moment / size * self.radius / self.length if size else 0j

    @property
    def angle_deg(self) -> float:
        """Direction from the line of the link, degrees from 0 to 360."""
        return float(degrees(np.angle(self.place)) % 360.0)


class Balancing(Memoizing):
    """A mechanism and the counterweights that balance it.

    Parameters
    ----------
    problem : Problem
        With ``[balancing]``.

    Raises
    ------
    ProblemError
        The mechanism is neither a four-bar nor a slider-crank, or a radius is of another link.
    AssemblyError
        When the mechanism cannot be assembled all round.
    """

    def __init__(self, problem: Problem) -> None:
        super().__init__()
        assert problem.balancing is not None, "there is no [balancing]"
        assert problem.dynamics is not None, "links have masses"
        self.problem, self.task, self.dynamics = problem, problem.balancing, problem.dynamics
        self.turn = CycleMotion(problem)
        self._name()
        rod = self._mass(self.rod)
        self.share = self.centre_on_line(self.rod, self.crank_pin, self.rod_pin) if rod else 0j
        self.rod_masses = rod * (1.0 - self.share), rod * self.share
        self.counterweights = self._weigh()
        may = (self.crank, self.rod if self.rocker_pivot is None else self.last)
        for link in self.task.radii:
            if link not in may:
                hint = translate("Counterweights are on {}.", translate(" and ").join(may))
                raise self._fault(
                    f"radii.{link}", translate("link {} cannot have a counterweight", link), hint
                )

    def _fault(self, key: str, message: str, hint: str) -> ProblemError:
        path = f"balancing.{key}" if key else "balancing"
        return ProblemError(self.problem.name, [Fault(path, message, hint)])

    def _name(self) -> None:
        """Find the links and pins: O, A, B, and C where the last link is a rocker."""
        problem, bodies = self.problem, self.problem.bodies
        fixed, crank, pivot = bodies[FRAME].points, problem.drive.link, problem.drive.pivot
        others = [link for link in problem.mechanism.links if link != crank]
        assert pivot is not None, "a crank drives"
        for rod, last in (others, others[::-1]) if len(others) == 2 else ():
            pins = [p for p in bodies[rod].points if p in bodies[crank].points and p not in fixed]
            ends = [p for p in bodies[rod].points if p in bodies[last].points and p not in fixed]
            rockers = [p for p in bodies[last].points if p in fixed]
            slide = problem.slides.get(last)
            slides = slide is not None and slide.host == FRAME
            if rod in problem.slides or len(pins) != 1 or len(ends) != 1 or pins == ends:
                continue
            if slides or (rockers and last not in problem.slides):
                self.crank, self.rod, self.last = crank, rod, last
                self.pivot, self.crank_pin, self.rod_pin = pivot, pins[0], ends[0]
                self.rocker_pivot = None if slides else rockers[0]
                return
        raise self._fault(
            "",
            translate(
                "the mechanism of links {} is neither a four-bar nor a slider-crank",
                ", ".join(problem.mechanism.links),
            ),
            "Counterweights are found for a crank, a rod, and a rocker or a slider on the frame.",
        )

    @property
    def structure(self) -> str:
        """The kind of the mechanism."""
        return SLIDER_CRANK if self.rocker_pivot is None else FOUR_BAR

    def _mass(self, link: str) -> float:
        found = self.dynamics.masses.get(link)
        return 0.0 if found is None else found.mass

    def _line(self, link: str, start: str, end: str) -> complex:
        points = self.problem.bodies[link].points
        return points[end] - points[start]

    def centre_on_line(self, link: str, start: str, end: str) -> complex:
        """Return the centre of mass of a link as a part of its line."""
        centre = self.dynamics.masses[link].centre
        assert centre is not None, "what has mass has a centre"
        return self._line(link, start, centre) / self._line(link, start, end)

    # Counterweights --------------------------------------------------------------------------

    def _weigh(self) -> list[Counterweight]:
        o, a, b, c = self.pivot, self.crank_pin, self.rod_pin, self.rocker_pivot
        near, far = self.rod_masses
        crank, rod = abs(self._line(self.crank, o, a)), abs(self._line(self.rod, a, b))

        def weight(
            link: str, pivot: str, pin: str, length: float, *terms: tuple[str, complex]
        ) -> Counterweight:
            own = []
            if self._mass(link) and link != self.rod:
                share = self.centre_on_line(link, pivot, pin)
                letter = self.dynamics.masses[link].centre
                own = [(f"m_{{{link}}} r_{{{letter}}}", self._mass(link) * share * length)]
            every = tuple(term for term in (*own, *terms) if term[1])
            radius = self.task.radii.get(link, length)
            return Counterweight(link, pivot, pin, every, length, radius)

        at_pin = (f"m_{{{self.rod}{a}}} l_{{{o}{a}}}", near * crank)
        if self.task.method is Weighing.PARTIAL:
            bare = weight(self.crank, o, a, crank, at_pin)
            if self.task.share is None:
                rest = ("I_{1}/ω^{2}", self._first_harmonic(crank) + bare.moment)
                if abs(rest[1]) < 1e-12 * abs(bare.moment):
                    return [bare]
            elif c is not None:
                raise self._fault(
                    "share",
                    translate("link {} is a rocker: a share refers to a slider's mass", self.last),
                    "Omit the share: then the crank balances the first harmonic.",
                )
            else:
                moved = far + self._mass(self.last)
                letters = f"m_{{{self.rod}{b}}} + m_{{{self.last}}}"
                rest = (f"k·({letters}) l_{{{o}{a}}}", self.task.share * moved * crank)
            return [weight(self.crank, o, a, crank, at_pin, rest)]
        if c is not None:
            length = abs(self._line(self.last, c, b))
            carried = (f"m_{{{self.rod}{b}}} l_{{{c}{b}}}", far * length)
            return [
                weight(self.crank, o, a, crank, at_pin),
                weight(self.last, c, b, length, carried),
            ]
        own = (f"m_{{{self.rod}{b}}} l_{{{a}{b}}}", far * rod)
        slider = (f"m_{{{self.last}}} l_{{{a}{b}}}", complex(self._mass(self.last) * rod))
        on_rod = weight(self.rod, a, b, rod, own, slider)
        whole = self._mass(self.rod) + self._mass(self.last) + on_rod.mass
        letters = f"m_{{{self.rod}}} + m_{{{self.last}}} + m'_{{{self.rod}}}"
        carried = (f"({letters}) l_{{{o}{a}}}", complex(whole * crank))
        return [on_rod, weight(self.crank, o, a, crank, carried)]

    def _first_harmonic(self, crank: float) -> complex:
        """Return m·r in the crank's pin that has the force's harmonic turning with the crank."""
        turned = np.linspace(0.0, 2.0 * np.pi, 720, endpoint=False)
        solved = self.turn.solved(turned)
        pin = solved.points[self.crank_pin].acceleration
        harmonic = np.mean(self._unbalanced(solved)[0] / -pin)
        return complex(harmonic) * crank

    # Forces ----------------------------------------------------------------------------------

    def _unbalanced(self, solved: Solution) -> tuple[Complexes, Complexes]:
        """Return the main vector of the inertia of the links, N, and sum m·r, kg·m, shape (n,)."""
        force = np.zeros(solved.positions.shape, dtype=complex)
        moment = np.zeros(solved.positions.shape, dtype=complex)
        for one in self.dynamics.masses.values():
            if one.mass and one.centre is not None:
                force = force - one.mass * solved.points[one.centre].acceleration
                moment = moment + one.mass * solved.points[one.centre].place
        return force, moment

    def vectors_of(self, solved: Solution) -> tuple[Complexes, Complexes, Complexes, Complexes]:
        """Return the main vector of inertia before and after, N, and the centre of masses, m.

        Parameters
        ----------
        solved : Solution
            In n positions, of which all four have the shape (n,).
        """
        before, moment = self._unbalanced(solved)
        after, shifted = before, moment
        for one in self.counterweights:
            pivot, pin = solved.points[one.pivot], solved.points[one.pin]
            along = pin.acceleration - pivot.acceleration
            after = after - one.mass * (pivot.acceleration + one.place * along)
            shifted = shifted + one.mass * (pivot.place + one.place * (pin.place - pivot.place))
        return before, after, moment / self.mass_before, shifted / self.mass_after

    @memoized
    def _read(self, count: int) -> tuple[Complexes, Complexes, Complexes, Complexes]:
        return self.vectors_of(self.turn.solved(2.0 * np.pi * np.arange(count) / count))

    def forces(self, count: int) -> tuple[Complexes, Complexes]:
        """Return the main vector of inertia before and after, N, in even positions, shape (n,)."""
        return self._read(count)[:2]

    def centres(self, count: int) -> tuple[Complexes, Complexes]:
        """Return the centre of all masses before and after, m, in even positions, shape (n,)."""
        return self._read(count)[2:]

    def phi(self, count: int) -> Reals:
        """Return the angles of the crank in even positions, degrees."""
        return self.turn.phi(2.0 * np.pi * np.arange(count) / count)

    @property
    def mass_before(self) -> float:
        """Mass of the links, kg."""
        return sum(one.mass for one in self.dynamics.masses.values())

    @property
    def mass_after(self) -> float:
        """Mass of the links and the counterweights, kg."""
        return self.mass_before + sum(one.mass for one in self.counterweights)

    @cached_property
    def largest(self) -> tuple[float, float]:
        """The largest force before and after, N."""
        before, after = self.forces(SAMPLES)
        return float(np.max(np.abs(before))), float(np.max(np.abs(after)))

    # Polygons --------------------------------------------------------------------------------

    @memoized
    def polygon(self, number: int, profile: Profile) -> tuple[MassMoments, float, Reading, Reading]:
        """Return the polygon of m·r of a counterweight: its scale, exactly and as drawn."""
        one = self.counterweights[number]
        vectors = [value for _, value in one.terms]
        size = max([abs(value) for value in vectors], default=1.0)
        per_mm = choose_scale((size, 0.0), (LONGEST, 1.0))
        made = build_mass_moments(vectors, per_mm, one.radius)
        exact = Reading(evaluate(made.program, made.data, Float64()), 1)
        read = Reading(evaluate(made.program, made.data, RulerArithmetic(ruler=profile.ruler)), 1)
        return made, per_mm, exact, read


@memoized
def balancing_of(solution: Solution) -> Balancing:
    """Return the balancing of a solution's problem, made at the first call."""
    return Balancing(solution.problem)
