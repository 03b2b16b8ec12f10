"""Force plans, guides' reactions and the lever of one position, read at their scales."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from math import copysign, isfinite
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Number
from planmethod.construct.scale import Scale
from planmethod.construct.steps import Name, NumberName, PointName
from planmethod.errors import Fault, ProblemError
from planmethod.plans.build import Quantity
from planmethod.plans.forces.board import SCALE, Force, ForceBoard, GivenLoad, Reaction
from planmethod.plans.forces.dyads import Driving
from planmethod.plans.forces.polygons import Component, CoupleOn, Edge, ForcePlan, reaction_symbol
from planmethod.plans.model import Ends, PlanKind
from planmethod.plans.motion.legs import MotionBoard, letter
from planmethod.problem.model import BalancingQuantity, Problem
from planmethod.problem.quantities import QuantityKey, QuantityKind
from planmethod.solved.forces.loads import applied
from planmethod.solved.forces.statics import (
    EdgeForce,
    Planned,
    SlideReaction,
    plan_forces,
    statics_of,
)
from planmethod.solved.quantities import Quantities
from planmethod.solved.reading import Memoizing, Reading, memoized
from planmethod.solved.solution import Solution

NEGLIGIBLE_FRACTION = 1e-7
"""Share of the largest force of a position below which a force is none."""


class ForceReading(Memoizing):
    """The forces of a solution in one position, as drawn and as read by hand.

    Parameters
    ----------
    solution : Solution
    index : int
        Which position.

    Raises
    ------
    ProblemError
        The problem file gives neither masses nor loads.
    """

    def __init__(self, solution: Solution, index: int) -> None:
        super().__init__()
        require_dynamics(solution.problem)
        self.solution, self.index = solution, index
        self.statics = statics_of(solution)
        self.plans: tuple[ForcePlan, ...] = tuple(self.statics.board.plans)

    @property
    def scale(self) -> Scale:
        """Scale of the force plans that have none of their own, N per mm."""
        return self.statics.scale

    def enlargement(self, number: int) -> float:
        """Return the enlargement of one of the plans relative to `scale`."""
        return float(self.statics.enlargements[number][self.index])

    def plan_scale(self, number: int) -> Scale:
        """Return the scale of one of the plans, N per mm."""
        return self.statics.plan_scale(number, self.index)

    def corner(self, number: int, point: PointName) -> complex:
        """Return a point of one of the plans as drawn by hand, mm; else the exact one."""
        drawn = self._column(self.statics.ruler_reading, point)
        return (drawn if math.isfinite(abs(drawn)) else self.end(point)) * self.enlargement(number)

    def drawn(self, number: int, edge: Edge) -> complex:
        """Return a force as its segment on one of the plans, mm."""
        return self.corner(number, edge.head) - self.corner(number, edge.tail)

    def _column(self, reading: Reading, name: PointName) -> complex:
        return complex(reading.point(name)[self.index])

    # Places, forces, couples -----------------------------------------------------------------

    def place(self, point: PointName) -> complex:
        """Return a place of the position plan, mm; those of shifted forces are among them."""
        return self._column(self._of_plan(point) or self.statics.paper, point)

    def _of_plan(self, point: PointName) -> Reading | None:
        """Return the position plan if it has a point."""
        return self.solution.paper if point in self.solution.paper.value else None

    def end(self, point: PointName) -> complex:
        """Return an end of a force plan, or a point of the lever, mm."""
        return self._column(self.statics.paper, point)

    def force(self, edge: Edge) -> complex:
        """Return a force, N."""
        return self.of_force(Force(edge.at, edge.tail, edge.head))

    def drawn_direction(self, force: Edge | Force) -> complex:
        """Return a force along its line as drawn by hand, mm; else along the exact one.

        A shifted force of inertia is drawn across its exact shift.
        """
        drawn = self.drawn_segment(*force.ends)
        shifted = any(shift.at == force.at for shift in self.statics.board.shifts.values())
        if drawn and math.isfinite(abs(drawn)) and not shifted:
            return drawn
        return self.of_force(Force(force.at, *force.ends))

    def of_force(self, force: Force) -> complex:
        """Return a force of the board, N."""
        si = self.statics.si
        return self._column(si, force.head) - self._column(si, force.tail)

    def drawn_segment(self, tail: PointName, head: PointName) -> complex:
        """Return a segment of a force plan, or of the lever, as drawn by hand, mm."""
        hand = self.statics.ruler_reading
        return self._column(hand, head) - self._column(hand, tail)

    def length(self, edge: Edge, number: int) -> float:
        """Return the length of a force on one of the plans, mm: laid off, or read."""
        length = abs(self.read_number(self.statics.board.segments.drawn(edge.ends)))
        return length * self.enlargement(number)

    def read(self, edge: Edge) -> float:
        """Return the size of a force as read by hand, N."""
        return self.read_size(edge.ends)

    def read_size(self, ends: Ends) -> float:
        """Return the size of the force that a segment shows, as read by hand, N."""
        return abs(self.read_number(self.statics.board.segments.known(ends)))

    def number(self, name: NumberName) -> float:
        """Return a moment, N·m, or another computed number."""
        return float(self.statics.si.number(name)[self.index])

    def read_number(self, name: NumberName) -> float:
        """Return a moment as computed by hand, N·m."""
        return float(self.statics.ruler_reading.number(name)[self.index])

    def read_product(self, powers: Iterable[tuple[NumberName, int]]) -> float:
        """Return a product of powers as computed by hand."""
        return math.prod(self.read_number(name) ** power for name, power in powers)

    def read_load(self, load: GivenLoad) -> float:
        """Return a given force as read by hand, N, or a couple as computed by hand, N·m."""
        if load.force is not None:
            return self.read_size(load.force.ends)
        assert load.couple is not None
        return self.read_number(load.couple)

    def arm(self, edge: Edge, about: PointName) -> float:
        """Return the arm of a force about a point as measured by hand, mm.

        Positive where the force turns counter-clockwise; 0 of a force through the point.
        """
        board = self.statics.board
        arm = board.arms.get((about, edge.at, board.segments.known(edge.ends)))
        return 0.0 if arm is None else self.read_number(arm)

    def turns(self, edge: Edge, about: PointName) -> bool:
        """Return whether a force turns its link counter-clockwise about a point."""
        lever = self.place(edge.at) - self.place(about)
        return (lever.conjugate() * self.drawn_segment(*edge.ends)).imag > 0

    @property
    def balancing(self) -> BalancingQuantity:
        """Balancing force or moment of the driving link."""
        return self.solution.problem.balancer

    @property
    def balancing_symbol(self) -> str:
        """Letter of the driving link's balancing force or moment."""
        return self.balancing.symbol

    @property
    def balancing_symbols(self) -> tuple[str, ...]:
        """Letters of the balancing forces or moments of all driving links, in their order."""
        problem = self.solution.problem
        others = (problem.balancer_of(other) for other in problem.drive.other_drives)
        return (self.balancing_symbol, *others)

    # Visible parts ---------------------------------------------------------------------------

    @cached_property
    def peak(self) -> float:
        """The largest force of the position, N."""
        edges = [edge for plan in self.plans for edge in (*plan.polygon, *plan.wholes)]
        return max((abs(self.force(edge)) for edge in edges), default=0.0)

    @cached_property
    def peak_moment(self) -> float:
        """The largest moment that counts beside the forces, N·m."""
        moments = [abs(self.number(one.moment)) for plan in self.plans for one in plan.couples]
        lengths = [length for _, _, length in self.solution.problem.lengths]
        return max([*moments, self.peak * max(lengths, default=0.0)])

    def is_negligible(self, edge: Edge) -> bool:
        """Return whether a force is negligible beside the others."""
        return abs(self.force(edge)) <= NEGLIGIBLE_FRACTION * self.peak

    def is_no_couple(self, couple: CoupleOn) -> bool:
        """Return whether a couple is negligible beside the others."""
        return abs(self.number(couple.moment)) <= NEGLIGIBLE_FRACTION * self.peak_moment

    def shown(self, plan: ForcePlan) -> list[Edge]:
        """Return the sides of a plan that are not negligible.

        If one component of a reaction is negligible, the other is shown as the whole reaction.
        """
        sides = [edge for edge in plan.polygon if not self.is_negligible(edge)]
        parts = [(edge.on, edge.at) for edge in sides if edge.component is not Component.TOTAL]
        return [
            replace(edge, component=Component.TOTAL)
            if parts.count((edge.on, edge.at)) == 1
            else edge
            for edge in sides
        ]

    def wholes(self, plan: ForcePlan) -> list[Edge]:
        """Return the reactions that are something and have two components."""
        parts = [(e.on, e.at) for e in self.shown(plan) if e.component is not Component.TOTAL]
        return [edge for edge in plan.wholes if (edge.on, edge.at) in parts]

    def inner(self, plan: ForcePlan) -> list[Edge]:
        """Return the reactions in the inner joints that are something."""
        return [edge for edge in plan.inner if not self.is_negligible(edge)]

    def couples(self, plan: ForcePlan) -> list[CoupleOn]:
        """Return the couples that are something."""
        return [couple for couple in plan.couples if not self.is_no_couple(couple)]


def require_dynamics(problem: Problem) -> None:
    """Reject a problem without masses and loads.

    Raises
    ------
    ProblemError
    """
    if problem.dynamics is None:
        hint = "Give the masses in [dynamics] and the loads in [[loads]]."
        fault = Fault("dynamics", "missing, so forces cannot be analysed", hint)
        raise ProblemError(problem.name, [fault])


@memoized
def force_reading(solution: Solution, index: int) -> ForceReading:
    """Return the forces of a position; cached, since several views of a sheet show them."""
    return ForceReading(solution, index)


class Guided(Struct, frozen=True, dict=True):
    """Reaction of one link of a prismatic pair on the other, in one position.

    Attributes
    ----------
    reading : ForceReading
    number : int
        Index of the reaction in the force analysis.
    on, by : str
        The link that the force acts on, and the link that exerts it.
    """

    reading: ForceReading
    number: int
    on: str
    by: str

    @property
    def contact(self) -> SlideReaction:
        """The pair in all positions."""
        return self.reading.statics.contacts[self.number]

    @property
    def reaction(self) -> Reaction:
        """The reaction as the force plans have it."""
        return self.reading.statics.board.reactions[self.number]

    @property
    def sense(self) -> int:
        """-1 if the force plans have the opposite reaction."""
        return 1 if self.on == self.reaction.on else -1

    @property
    def as_planned(self) -> Guided:
        """The same reaction as the force plans name it: distances and lengths have its letters."""
        return Guided(self.reading, self.number, self.reaction.on, self.reaction.by)

    def symbol(self, letter: str, primes: str = "") -> str:
        """Return a letter with the numbers of both links: ``l_{50}``, ``F^{'}_{50}``."""
        above = f"^{{{primes}}}" if primes else ""
        called = self.reading.solution.problem.mechanism.called
        return reaction_symbol(called(self.on), called(self.by), letter=letter + above)

    @cached_property
    def b(self) -> float | None:
        """Position of the force, m from the joint along the guide; None if there is no force."""
        if self.is_negligible:
            return None
        return (
            0.0
            if self.is_no_couple
            else float(self.contact.b(NEGLIGIBLE_FRACTION)[self.reading.index])
        )

    @property
    def is_negligible(self) -> bool:
        """True if the force is negligible beside the others."""
        size = abs(complex(self.contact.joint.force[self.reading.index]))
        return size <= NEGLIGIBLE_FRACTION * self.reading.peak

    @property
    def is_no_couple(self) -> bool:
        """True if the moment about the joint is negligible beside the others."""
        moment = abs(float(self.contact.joint.moment[self.reading.index]))
        return moment <= NEGLIGIBLE_FRACTION * self.reading.peak_moment

    @property
    def edges(self) -> tuple[EdgeForce, ...]:
        """Reactions at the edges where they act: ahead in the guide's direction, then behind."""
        edges = self.contact.edges(self.reading.index)
        return tuple(EdgeForce(edge.at, self.sense * edge.force) for edge in edges)

    # As read by hand -------------------------------------------------------------------------

    @property
    def read_force(self) -> float:
        """Size of the force as the ruler has it on the force plan, N."""
        return self.reading.read_size(self.reaction.force.ends)

    @property
    def read_moment(self) -> float:
        """Size of the moment about the joint, N·m."""
        assert self.reaction.couple is not None
        return abs(self.reading.read_number(self.reaction.couple))

    @property
    def is_read(self) -> bool:
        """True if the force is neither negligible nor zero on the paper."""
        return not self.is_negligible and self.read_force > 0

    @property
    def read_distance(self) -> float:
        """Distance of the read force from the joint, m."""
        return self.read_moment / self.read_force

    @property
    def centred(self) -> bool:
        """True if the middle of the contact lies across the guide from the joint."""
        middle = abs(float(self.contact.middle[self.reading.index]))
        return middle <= 1e-9 * (self.contact.length or 1.0)


@memoized
def guides(reading: ForceReading) -> Mapping[str, Guided]:
    """Return the reactions of the guides by the letter of the force, each way: ``F_{50}``."""
    found = {}
    called = reading.solution.problem.mechanism.called
    for number, contact in reading.statics.contacts.items():
        joint = contact.joint
        for on, by in ((joint.on, joint.by), (joint.by, joint.on)):
            found[reaction_symbol(called(on), called(by))] = Guided(reading, number, on, by)
    return found


def guide_of(reading: ForceReading, couple: CoupleOn) -> Guided | None:
    """Return the reaction of a guide whose moment a couple is."""
    matching = (one for one in guides(reading).values() if one.symbol("M") == couple.symbol)
    return next(matching, None)


_Own: TypeAlias = tuple[
    float,
    tuple[complex, complex] | None,
    tuple[PointName, PointName] | None,
    tuple[str, str] | None,
    float,
]


class LeverForce(Struct, frozen=True):
    """Force on the lever: letter, where it hangs (mm from the pole), N, and its arm, mm.

    The arm is the measured one, positive where the force turns counter-clockwise; ``size`` is the
    force as read by hand, N. ``point`` is the point of the mechanism where it acts. The arm is
    measured from the place ``about``, which for a pair of forces is the place of the other.
    """

    symbol: str
    at: complex
    force: complex
    arm: float
    size: float
    point: str
    about: complex = 0j


class LeverSegment(Struct, frozen=True):
    """A segment of the lever that represents a link.

    ``segment`` is the segment of the plan, mm, that represents the link, ``ends`` are its points,
    ``joints`` those of the link, ``joint_distance`` is their distance as read by hand, m.
    ``ratio`` is the link's |omega| as read by hand over the plan's scale, mm/m.
    """

    symbol: str
    link: str
    ratio: float
    segment: tuple[complex, complex] | None
    ends: tuple[PointName, PointName] | None
    joints: tuple[str, str] | None
    joint_distance: float


class LeverCouple(LeverSegment, frozen=True):
    """Couple on the lever: its letter, its link, and its moment about the pole, N·mm.

    ``moment`` is that on the link as read by hand, N·m.
    """

    moment: float
    lever_moment: float


class LeverShift(LeverSegment, frozen=True):
    """Shift h of a force of inertia on the lever: from the centre of mass s to the point t, mm.

    ``letters`` are those of s and t, in rich text; ``line`` is where they are. ``shift`` is h as
    read by hand, m.
    """

    letters: tuple[str, str]
    line: tuple[complex, complex]
    shift: float


class LeverReading:
    """The lever of one position.

    Parameters
    ----------
    reading : ForceReading

    Attributes
    ----------
    times : float
        How many times larger than the velocity plan it is drawn.
    scale : Scale
        That of its segments.
    forces : list of LeverForce
        Forces that do work; last the balancing one of a driving slider.
    couples : list of LeverCouple
        Couples that do work; last the balancing one of a crank, as found by hand on the lever.
    shifts : list of LeverShift
        Of the forces of inertia that are moved off the centre of mass.
    """

    def __init__(self, reading: ForceReading) -> None:
        solution, index = reading.solution, reading.index
        assert reading.statics.lever_plan is not None
        self.reading = reading
        self.times = float(reading.statics.lever_times[index])
        own = solution.plan_scale(PlanKind.VELOCITY, index)
        self.scale = replace(own, per_mm=own.per_mm / self.times)
        self.per_mm = self.scale.per_mm
        self.forces: list[LeverForce] = []
        self.couples: list[LeverCouple] = []
        self.shifts: list[LeverShift] = []
        pole = reading.statics.lever_plan.pole
        for hung in reading.statics.lever_plan.loads:
            given, at, one = hung.load, hung.at, hung.load.applied
            if at is None or hung.arm is None:
                assert given.couple is not None
                if abs(reading.number(given.couple)) > 1e-9 * reading.peak_moment:
                    moment = reading.read_number(given.couple)
                    self.couples.append(self._couple(one.name, one.link, moment))
                continue
            force, place = complex(one.force[index]), self._hung(at, pole)
            if abs(force) > 1e-9 * reading.peak:
                assert given.force is not None and one.point is not None
                way = reading.drawn_direction(given.force)
                force = way * (abs(force) / abs(way))
                size, arm = reading.read_load(given), reading.read_number(hung.arm) * self.times
                self.forces.append(LeverForce(one.name, place, force, arm, size, one.point))
                self._shift(given, place)
        self._balance(reading.statics.lever_plan.balance)

    def _balance_others(self) -> None:
        """Apply the balances of other driving links, as the force plans give them."""
        reading, problem = self.reading, self.reading.solution.problem
        motion = reading.solution.construction.kinematics.velocity
        both = zip(problem.drive.other_drives, reading.statics.other_driving, strict=True)
        for other, driving in both:
            symbol = problem.balancer_of(other)
            if driving.force is None:
                moment = reading.read_number(driving.balance)
                self.couples.append(self._couple(symbol, other.link, moment))
            elif force := reading.of_force(driving.force):
                pin = str(driving.force.at)
                place = self.place(motion.point[other.link, pin])
                size = abs(reading.read_number(driving.balance))
                arm = _moment_arm(place, force)
                self.forces.append(LeverForce(symbol, place, force, arm, size, pin))

    def _balance(self, balance: NumberName) -> None:
        self._balance_others()
        reading, drive = self.reading, self.reading.solution.problem.drive
        pushing = reading.statics.driving.force
        if reading.statics.driving.between is not None:
            self._push(reading.statics.driving)
            return
        if (links := reading.statics.driving.motor) is not None:
            moment = reading.read_number(balance)
            for link, one in zip(links, (-moment, moment), strict=True):
                if link in reading.solution.construction.kinematics.omega:
                    self.couples.append(self._couple(reading.balancing_symbol, link, one))
            return
        if pushing is None:
            if self.forces or self.couples:  # where they cancel, too
                moment = reading.read_number(balance)
                self.couples.append(self._couple(reading.balancing_symbol, drive.link, moment))
            return
        motion = reading.solution.construction.kinematics.velocity
        pin = str(pushing.at)
        force = reading.of_force(pushing)
        if force:
            place = self.place(motion.point[drive.link, pin])
            # Its arm is the driver's own velocity, laid off and not measured, if it is along that.
            arm, size = _moment_arm(place, force), abs(reading.read_number(balance))
            measured = reading.statics.lever_plan.arm if reading.statics.lever_plan else None
            if measured is not None:
                arm = copysign(reading.read_number(measured) * self.times, arm)
            self.forces.append(LeverForce(reading.balancing_symbol, place, force, arm, size, pin))

    def _push(self, driving: Driving) -> None:
        """Apply the force of an actuator at both its ends: the second has the arm of the pair."""
        reading, hung = self.reading, self.reading.statics.lever_plan
        assert driving.between is not None and driving.force is not None
        assert hung is not None and hung.arm is not None
        force, motion = reading.of_force(driving.force), self._motion
        if not force or not (self.forces or self.couples):
            return
        size = abs(reading.read_number(hung.balance))
        arm = reading.read_number(hung.arm) * self.times
        arm = -arm if reading.number(driving.balance) < 0 else arm
        one, two = (self.place(motion.point[motion.named[end]]) for end in driving.between)
        symbol, (first, second) = reading.balancing_symbol, driving.between
        self.forces.append(LeverForce(symbol, one, -force, 0.0, size, first))
        self.forces.append(LeverForce(symbol, two, force, arm, size, second, one))

    @property
    def _motion(self) -> MotionBoard:
        return self.reading.solution.construction.kinematics.velocity

    def place(self, point: PointName) -> complex:
        """Return a point of the velocity plan on the lever as drawn by hand, mm from the pole."""
        solution, index = self.reading.solution, self.reading.index
        drawn, exact = (r.point(point)[index] for r in (solution.ruler_reading, solution.paper))
        return 1j * self.times * complex(drawn if isfinite(abs(drawn)) else exact)

    def _hung(self, at: PointName, pole: PointName) -> complex:
        """Return the place of a force as drawn by hand, mm from the pole; else the exact place."""
        drawn = self.reading.drawn_segment(pole, at)
        return self.times * (drawn if isfinite(abs(drawn)) else self.reading.end(at))

    def _couple(self, symbol: str, link: str, moment: float) -> LeverCouple:
        turned = -moment * self._omega(link) / self.per_mm
        return LeverCouple(symbol, link, *self._on(link), moment, turned)

    def _shift(self, load: GivenLoad, place: complex) -> None:
        """Note the shift of a force that acts beside its centre of mass."""
        link = load.applied.link
        shift = self.reading.statics.board.shifts.get(link)
        if shift is None or load.force is None or load.force.at != shift.at:
            return
        assert load.applied.point is not None
        motion = self.reading.solution.construction.kinematics.velocity
        centre = self.place(motion.point[motion.named[load.applied.point]])
        letters = letter(load.applied.point), f"t{shift.letter[1:]}"
        mu_l = self.reading.solution.scales[PlanKind.POSITION].per_mm
        length, line = abs(self.reading.read_number(shift.length)) * mu_l, (centre, place)
        self.shifts.append(
            LeverShift(f"h_{{{link}}}", link, *self._on(link), letters, line, length)
        )

    def _omega(self, link: str) -> float:
        """Return the angular velocity of a link as read by hand, 1/s."""
        solution = self.reading.solution
        name = solution.construction.kinematics.omega[link]
        return float(solution.ruler_reading.number(name)[self.reading.index])

    def _on(self, link: str) -> _Own:
        """Return the ratio of a link, its segment on the plan, its ends and their joints."""
        solution = self.reading.solution
        kinematics = solution.construction.kinematics
        ends, joints, length = None, None, 0.0
        for (kind, other), turning in kinematics.turnings.items():
            if kind is PlanKind.VELOCITY and kinematics.omega.get(other) == kinematics.omega.get(
                link
            ):
                ends = (turning.start, turning.head)
                joints = (str(turning.joint), str(turning.place))
                length = self.reading.read_product(turning.arm)
        pivots = {one.link: one.pivot for one in solution.problem.drive.other_drives}
        pivots[solution.problem.drive.link] = solution.problem.drive.pivot
        if ends is None and (pivot := pivots.get(link)) is not None:
            ends, joints = self._crank(link, pivot)
            own = solution.problem.bodies[link].points
            length = abs(own[joints[1]] - own[joints[0]])
        segment = None if ends is None else (self.place(ends[0]), self.place(ends[1]))
        return abs(self._omega(link)) / self.per_mm, segment, ends, joints, length

    def _crank(self, link: str, pivot: str) -> tuple[tuple[PointName, PointName], tuple[str, str]]:
        """Return the pole and the point of the crank's end, and the crank's points."""
        solution = self.reading.solution
        motion = solution.construction.kinematics.velocity
        own = solution.problem.bodies[link].points
        pin = next(point for point in own if point != pivot)
        return (motion.pole, motion.point[link, pin]), (pivot, pin)


def _moment_arm(place: complex, force: complex) -> float:
    """Return the arm of a force at a place about the origin, positive counter-clockwise."""
    return (place.conjugate() * force).imag / abs(force) if abs(force) else 0.0


def force_row(reaction: Reaction) -> str:
    """Return the column name of a reaction: ``F.B.2-1``, on link 2 from link 1."""
    return f"F.{reaction.joint}.{reaction.on}-{reaction.by}"


def moment_row(reaction: Reaction) -> str:
    """Return the column name of a reaction's moment: ``M.B.2-1``."""
    return f"M.{reaction.joint}.{reaction.on}-{reaction.by}"


def with_forces(solution: Solution, results: Quantities) -> Quantities:
    """Return the results of a solution and those of its force plans, in N and N·m.

    The positions of the solution do not matter: values that vary with them are left open.

    Raises
    ------
    ProblemError
        As of `loads.applied`.
    """
    planned = plan_forces(solution, results.draft.copy(), applied(solution))
    board = planned.board
    found = (*_reactions(board), *_balances(planned))
    changing = tuple(board.changing)
    open_names = {name for _, names in changing for name in names}
    known = {
        name: _to_builtin(value) for name, value in board.data.items() if name not in open_names
    }
    return replace(
        results,
        program=board.draft.b.program(),
        numbers={**board.draft.numbers, **known, SCALE: 1.0},
        all=(*results.all, *found),
        draft=board.draft,
        changing=changing,
    )


def _to_builtin(value: Number) -> complex | float:
    return complex(value) if np.iscomplexobj(value) else float(value)


def _reactions(board: ForceBoard) -> Iterator[Quantity]:
    b = board.draft.b
    for reaction in board.reactions:
        force, on, by = reaction.force, reaction.on, reaction.by
        vector = b.carry(board.name("R"), board.pole, force.tail, force.head)
        told: list[tuple[QuantityKind, Name, str]] = [
            (QuantityKind.REACTION, vector, force_row(reaction))
        ]
        if reaction.couple is not None:
            told.append((QuantityKind.MOMENT, reaction.couple, moment_row(reaction)))
        for kind, name, row in told:
            shown = reaction_symbol(on, board.called(by), letter=kind.letter)
            back = f"{kind.letter}_{reaction.joint}_{by}/{on}"
            yield Quantity(
                kind, name, f"{reaction.joint}_{on}/{by}", row=row, shown=shown, opposite=back,
                named=QuantityKey(kind, (on, by)),
            )  # fmt: skip


def _balances(planned: Planned) -> Iterator[Quantity]:
    """Yield the balance of the driver, by the force plans and by the lever."""
    balancing = planned.board.draft.problem.balancer
    kind = QuantityKind.MOMENT if balancing.turns else QuantityKind.THRUST
    row = balancing.quantity
    key = QuantityKey(QuantityKind.BALANCE, ())
    yield Quantity(kind, planned.driving.balance, "dr", row=f"driving.{row}", named=key)
    if planned.lever is not None:
        key = QuantityKey(QuantityKind.LEVER, ())
        yield Quantity(kind, planned.lever.balance, "lever", row=f"lever.{row}", named=key)
