"""Extreme positions by construction, and the numbered positions of the cycle."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from enum import Enum
from functools import cached_property
from math import atan2, degrees

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.drafting import RulerArithmetic
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.program import Builder, Program
from planmethod.construct.steps import LineSense, NumberName, PointName, Side
from planmethod.errors import LayoutError, PlanMethodError, ProblemError
from planmethod.languages import translate
from planmethod.mechanism.groups import AssurGroup, OuterLeg
from planmethod.mechanism.model import FRAME, Prismatic, Revolute
from planmethod.plans.draft import cis
from planmethod.plans.model import PlanKind
from planmethod.problem.faults import Faults
from planmethod.problem.file_node import FileNode
from planmethod.problem.machine import check_start
from planmethod.problem.machine_records import CycleTask, Zero
from planmethod.problem.model import SAME_DEG, Problem
from planmethod.problem.records import TurningSense
from planmethod.solved.errors.spread import Drafted, DrawnQuantity, Errors, number
from planmethod.solved.forces.laws import only_in_positions
from planmethod.solved.reading import Complexes, Reals, memoized
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import TURN, CrankCycle, crank_cycle_of
from planmethod.solved.turn.output import Strokes

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


MIN_POSITIONS = 6
"""Fewest positions of a turn that its diagrams can be drawn through."""


def number_positions(problem: Problem) -> Problem:
    """Return a problem with the positions that its ``[cycle]`` numbers.

    Raises
    ------
    PlanMethodError
        The driver gives no position, and the mechanism cannot be assembled or has no output; or the
        machine starts in another position than the cycle.
    """
    drive = problem.drive
    if problem.cycle is None or not drive.goes_round:
        return problem
    given = bool(np.isfinite(drive.positions).all())
    try:
        turn = CrankCycle(Solution(problem))
        positions = tuple(turn.positions.tolist())
        _ = turn.strokes if problem.cycle.working is not None else None  # may be a fault
    except ProblemError:
        raise
    except PlanMethodError:  # reported where the positions of the file are solved
        if not given:
            raise
        return problem
    machine = problem.machine
    if machine is not None:
        file = FileNode(Faults(), problem.source_table)
        if machine.start_deg is not None and isinstance(problem.cycle.zero, Zero):
            check_start(file["machine"], positions[0] % 360.0, machine.start_deg)
        if file.faults:
            raise ProblemError(problem.name, file.faults.listed)
        machine = replace(machine, start_deg=positions[0])
    if not given or len(drive.positions) > 1:
        judged = drive.assembly_positions or drive.positions
        drive = replace(drive, positions=positions, assembly_positions=judged)
    return replace(problem, drive=drive, machine=machine, numbered=positions)


def counting(problem: Problem, positions: Sequence[float]) -> Problem:
    """Return a problem whose cycle numbers these positions, so that a number names one of them.

    Numbers that the file gives, by ``[cycle]`` or ``[machine]``, are kept; if it gives none,
    equally spaced positions over a turn, or over the turns after which the motion repeats, are
    those of the cycle, in their order and starting from the first.

    Parameters
    ----------
    positions : sequence of float
        Degrees of the crank, two or more.

    Raises
    ------
    LayoutError
        The cycle has other positions.
    """
    count = len(positions)
    free = problem.cycle is None and problem.machine is None
    turns = Solution(problem).turns
    step = TURN * turns / count if positions[1] > positions[0] else -TURN * turns / count
    even = [positions[0] + step * k for k in range(count)]
    least = MIN_POSITIONS * turns
    if free and count >= least and not count % turns and _is_same(positions, even, turns):
        sense = TurningSense.CCW if step > 0 else TurningSense.CW
        own = CycleTask(zero=float(positions[0]), direction=sense, count=count // turns)
        counted = number_positions(replace(problem, cycle=own))
    else:
        counted = problem
    told = numbered_positions(Solution(counted)).tolist()
    if _is_same(positions, told, turns):
        return counted
    hint = (
        translate(
            "Name one position, or {0:|an even turn|even turns} of {1} and more: "
            "--phi {2:g}:{3:g}:30.",
            turns,
            MIN_POSITIONS,
            positions[0],
            positions[0] + TURN * turns,
        )
        if free
        else translate("Name one position, omit --phi, or give zero and count of [cycle].")
    )
    raise LayoutError(
        "{}: tables and diagrams of the cycle number {} positions from {:.5g}° on, but {} "
        "others from {:.5g}° on are requested: a number would refer to two positions. {}",
        problem.name,
        len(told),
        told[0] % (TURN * turns),
        count,
        positions[0],
        hint,
    )


def _is_same(some: Sequence[float], reference: Sequence[float], turns: int) -> bool:
    """Return whether positions over a number of turns are the same, in the same order."""
    if len(some) != len(reference):
        return False
    whole, apart = TURN * turns, np.subtract(some, reference)
    return bool((np.abs((apart + whole / 2) % whole - whole / 2) <= SAME_DEG).all())


def numbered_positions(solution: Solution) -> Reals:
    """Return the positions of the cycle in the order of their numbers, ndarray of shape (n,).

    Degrees of the crank, over both turns of a cycle of 720 degrees. Without ``[cycle]`` those of
    ``[machine]``, else a dozen from the extreme position on. Loads that the file gives for its
    positions only keep to these.

    Raises
    ------
    ProblemError
        The driver slides, or the mechanism has no output.
    """
    problem = solution.problem
    if problem.numbered:
        return np.array(problem.numbered)
    if problem.dynamics is not None and only_in_positions(problem.dynamics):
        return np.array(problem.drive.positions)
    return crank_cycle_of(solution).positions


def strokes_of(solution: Solution) -> Strokes | None:
    """Return the working and the idle stroke; None where the output has no two strokes."""
    return crank_cycle_of(solution).strokes
