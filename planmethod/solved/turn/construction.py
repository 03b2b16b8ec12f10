"""Extreme positions by construction (построение крайних положений): arcs l ± r, tangents.

The dyad that joins the crank with the frame turns back where crank and rod lie in one line, so that
arcs of l + r and l - r about the crank's pivot cut the guide or the rocker's circle; a slotted link
turns back where it touches the circle of the crank. The construction counts if it gives the roots
of the output's velocity; of other mechanisms these alone are known.

Source: Артоболевский, Теория механизмов и машин; Попов, Курсовое проектирование по ТММ.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from enum import Enum
from functools import cached_property
from math import atan2, degrees

import numpy as np
from msgspec import Struct

from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.program import Builder, Program
from planmethod.construct.ruler import RulerArithmetic
from planmethod.construct.steps import LineSense, NumberName, PointName, Side
from planmethod.mechanism.groups import AssurGroup, OuterLeg
from planmethod.mechanism.model import FRAME, Prismatic, Revolute
from planmethod.plans.draft import cis
from planmethod.plans.model import PlanKind
from planmethod.solved.errors.drawing import Drafted, DrawnQuantity, number
from planmethod.solved.errors.spread import Errors
from planmethod.solved.reading import Complexes, memoized
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import TURN, CrankCycle, crank_cycle_of

PRIMES = ("′", "″")
"""Primes of the extreme positions, in the order of the angle from 0 to 360 degrees."""

_AGREE = 1e-6  # degrees within which a constructed position is the root


class Locus(Enum):
    """Path of the rod's end, or the point from which the crank's circle is touched."""

    GUIDE = "guide"
    CIRCLE = "circle"
    TANGENTS = "tangents"


class ExtremesConstruction(Struct, frozen=True, dict=True):
    """The construction of both extreme positions, in millimetres of the scheme.

    Attributes
    ----------
    cycle : CrankCycle
    solution : Solution
        Whose scheme it is drawn on.
    locus : Locus
    link : str
        That turns back: slider, rocker or slotted link.
    pivot, pin : str
        Of the crank.
    end : str
        End of the rod; of tangents the pin.
    centre : str
        Pivot of the rocker or slotted link; empty of a guide.
    program : Program
    data : dict
    phi : tuple of (float, float), degrees
        The exact positions of the crank.
    sum_arcs : tuple of (bool, bool)
        Which arc is of l + r; of tangents none.
    """

    cycle: CrankCycle
    solution: Solution
    locus: Locus
    link: str
    pivot: str
    pin: str
    end: str
    centre: str
    program: Program
    data: dict[str, complex | float]
    phi: tuple[float, float]
    sum_arcs: tuple[bool, bool]

    @property
    def is_rod_longer(self) -> bool:
        """True if the rod is longer than the crank."""
        return self.length("l") > self.length("r")

    @cached_property
    def exact(self) -> Trace:
        """Exact reading, mm."""
        return evaluate(self.program, self.data, Float64())

    @cached_property
    def read(self) -> Trace:
        """Reading with the ruler, mm."""
        return evaluate(self.program, self.data, RulerArithmetic(ruler=self.solution.profile.ruler))

    def place(self, name: str) -> complex:
        """Return a point of the exact reading, mm."""
        return complex(self.exact.value[PointName(name)])

    def length(self, name: str) -> float:
        """Return a number of the exact reading, mm."""
        return float(self.exact.value[NumberName(name)])

    def angle(self, trace: Trace, name: str) -> float:
        """Return a direction from its measured x and y, degrees from 0 to 360."""
        x, y = (float(trace.value[NumberName(f"{name} {axis}")]) for axis in "xy")
        return degrees(atan2(y, x)) % TURN

    def stroke(self, trace: Trace) -> float:
        """Return the stroke of the link, m, or its swing, degrees."""
        if self.locus is Locus.GUIDE:
            per_mm = self.solution.scales[PlanKind.POSITION].per_mm
            return float(trace.value[NumberName("H")]) * per_mm
        one, two = (self.angle(trace, f"{self.centre}{self.end}{p}") for p in PRIMES)
        return abs((one - two + TURN / 2) % TURN - TURN / 2)

    @cached_property
    def sigma(self) -> tuple[float, float, float]:
        """One sigma of both angles of the crank, degrees, and of the stroke, m or degrees."""
        ends = [(self.pivot, f"{self.pin}{p}") for p in PRIMES]
        items = [DrawnQuantity(f"phi{k}", tuple(map(PointName, pair)), self._off(*pair))
                 for k, pair in enumerate(ends)]  # fmt: skip
        if self.locus is Locus.GUIDE:
            items.append(DrawnQuantity("H", (NumberName("H"),), number(NumberName("H"))))
        else:
            names = [f"{self.end}{p}" for p in PRIMES]
            one, two = (self._off(self.centre, name) for name in names)
            needs = tuple(map(PointName, (self.centre, *names)))
            items.append(DrawnQuantity("H", needs, lambda trace: one(trace) - two(trace)))
        drawing = Drafted(
            self.program, lambda _: dict(self.data), 1, self.solution.profile, frozenset(),
            tuple(items),
        )  # fmt: skip
        spreads = Errors(drawing).spreads
        found = [float(spreads[name].sigma[0]) for name in ("phi0", "phi1", "H")]
        unit = self.solution.scales[PlanKind.POSITION].per_mm
        last = found[2] * unit if self.locus is Locus.GUIDE else degrees(found[2])
        return degrees(found[0]), degrees(found[1]), last

    def _off(self, centre: str, name: str) -> Callable[[Trace], Number]:
        """Return a function that reads the rotation of a ray about a centre, radians."""
        ray = self.place(name) - self.place(centre)
        back = -1j / ray
        ends = PointName(centre), PointName(name)
        return lambda trace: ((trace.value[ends[1]] - trace.value[ends[0]]) * back).real

    def off(self, k: int) -> float:
        """Return by how much the ruler's reading of a crank's angle is off the root, degrees."""
        name = f"{self.pivot}{self.pin}{PRIMES[k]}"
        turned = self.angle(self.read, name) - self.angle(self.exact, name)
        return (turned + TURN / 2) % TURN - TURN / 2


def _dyads(solution: Solution) -> Iterator[tuple[AssurGroup, OuterLeg, OuterLeg]]:
    """Yield the dyads that join the crank to the frame: their legs on them, in this order."""
    for group in solution.structure.groups:
        by = {lead.to: lead for lead in group.legs}
        drive = solution.problem.drive.link
        if group.class_number == 2 and by.keys() == {FRAME, drive}:
            yield group, by[drive], by[FRAME]


@memoized
def extreme_construction(solution: Solution) -> ExtremesConstruction | None:
    """Return the construction of the extreme positions; None where there is none that is known."""
    turn = crank_cycle_of(solution)
    if turn.ends is None:
        return None
    whole = turn.period
    phi = sorted((end.phi for end in turn.ends), key=lambda phi: round(phi % whole, 9) % whole)
    for dyad in _dyads(solution):
        made = _built(turn, solution, dyad, (phi[0], phi[1]))
        if made is None:
            continue
        crank = _ray(turn, made.phi, made.pivot, made.pin)
        found = [made.place(f"{made.pin}{p}") - made.place(made.pivot) for p in PRIMES]
        off = np.degrees(np.angle(np.array(found) / crank))
        if np.abs(off).max() < _AGREE:  # nowhere where it is not a number
            return made
    return None


def _ray(cycle: CrankCycle, phi: tuple[float, float], tail: str, head: str) -> Complexes:
    """Return a vector of the mechanism in both positions, m."""
    return cycle.read(phi).vector(PointName(tail), PointName(head))


def _built(
    cycle: CrankCycle,
    solution: Solution,
    dyad: tuple[AssurGroup, OuterLeg, OuterLeg],
    phi: tuple[float, float],
) -> ExtremesConstruction | None:
    group, own, other = dyad
    problem, per_mm = solution.problem, solution.scales[PlanKind.POSITION].per_mm
    pivot, inner = problem.drive.pivot, group.inner[0]
    if pivot is None or not isinstance(own.joint, Revolute):
        return None
    pin, outer = own.joint.point, other.joint
    paper = solution.paper
    b, data = Builder(), dict[str, complex | float]()

    def take_point(name: str) -> PointName:
        data[name] = complex(paper.point(PointName(name))[0])
        return b.take_point(name)

    def known(name: str, value: float) -> NumberName:
        data[name] = value
        return b.known(name)

    def span(link: str, one: str, two: str) -> float:
        points = problem.bodies[link].points
        return abs(points[two] - points[one]) / per_mm

    def left(tail: str, normal: Complexes, head: str) -> list[bool]:
        rays = _ray(cycle, phi, tail, head)
        return [bool(one > 0) for one in (np.conj(normal) * rays).imag]

    o = take_point(pivot)
    radius = span(problem.drive.link, pivot, pin)
    r = known("r", radius)
    x = b.at_angle(o, None, known("0", 0.0))
    axes = {"x": x, "y": b.perpendicular(o, x)}
    centre, end, far = "", pin, (False, False)
    if isinstance(inner, Prismatic) and isinstance(outer, Revolute):
        locus, centre = Locus.TANGENTS, outer.point
        c = take_point(centre)
        sides = left(pivot, _ray(cycle, phi, pivot, centre), pin)
        for prime, side in zip(PRIMES, sides, strict=True):
            b.touch(f"{pin}{prime}", o, r, c, Side.LEFT if side else Side.RIGHT)
    elif isinstance(inner, Revolute):
        end = inner.point
        rod = span(own.link, pin, end)
        near, long = abs(rod - radius), rod + radius
        if near < 1e-9 * long:  # no arc
            return None
        there = np.abs(_ray(cycle, phi, pivot, end)) / per_mm
        far = (bool(there[0] > rod), bool(there[1] > rod))
        minus = b.compute("-", (r if rod > radius else known("l", rod), 1), factor=-1.0)
        longer = known("l", rod) if rod > radius else r
        arcs = {
            True: b.total("l+r", r, NumberName("l")),
            False: b.total("l-r", longer, minus),
        }
        if isinstance(outer, Revolute):
            locus, centre = Locus.CIRCLE, outer.point
            c, arm = take_point(centre), known("c", span(other.link, centre, end))
            sides = left(pivot, _ray(cycle, phi, pivot, centre), end)
            ends = [
                b.intersect_circles(f"{end}{p}", o, arcs[is_far], c, arm,
                               Side.LEFT if side else Side.RIGHT)
                for p, is_far, side in zip(PRIMES, far, sides, strict=True)
            ]  # fmt: skip
        else:
            locus, slide = Locus.GUIDE, problem.slides[outer.slider]
            if slide.pin != end:
                return None
            along = cis(slide.angle)
            base = slide.base + 1j * slide.offset * along - cycle.unit.construction.draft.origin
            data["guide"] = base / per_mm
            line = b.at_angle(b.take_point("guide"), None, known("angle", slide.angle))
            sides = left(pivot, np.array([along / 1j] * 2), end)
            ends = [
                b.intersect_line_circle(f"{end}{p}", line, o, arcs[is_far],
                                   LineSense.FORWARD if side else LineSense.BACKWARD)
                for p, is_far, side in zip(PRIMES, far, sides, strict=True)
            ]  # fmt: skip
            b.measure("H", *ends)
        for p, is_far, at in zip(PRIMES, far, ends, strict=True):
            way = LineSense.FORWARD if is_far or radius > rod else LineSense.BACKWARD
            b.intersect_line_circle(f"{pin}{p}", b.join(o, at), o, r, way)
    else:
        return None
    for p in PRIMES:
        for name, line in axes.items():
            b.measure_along(f"{pivot}{pin}{p} {name}", o, PointName(f"{pin}{p}"), line)
            if centre:
                at, tail = PointName(f"{end}{p}"), PointName(centre)
                b.measure_along(f"{centre}{end}{p} {name}", tail, at, b.parallel(tail, line))
    return ExtremesConstruction(
        cycle, solution, locus, other.link, pivot, pin, end, centre, b.program(), data, phi, far
    )
