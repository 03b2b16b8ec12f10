"""Forces of a solved problem: reactions, places of guides' reactions, lever (кинетостатика)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.arguments import number_of, of_type
from planmethod.construct.arithmetic import Arithmetic, Float64, Number, unit_vectors
from planmethod.construct.drafting import RulerArithmetic
from planmethod.construct.evaluate import evaluate
from planmethod.construct.program import Program
from planmethod.construct.scale import Scale, choose_scale
from planmethod.construct.steps import Name, NumberName, PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import Draft, cis
from planmethod.plans.forces.board import SCALE, Force, ForceBoard, Reaction
from planmethod.plans.forces.dyads import (
    Driving,
    drive_forces,
    group_forces,
    other_driver_forces,
)
from planmethod.plans.forces.laws import lay_off_loads
from planmethod.plans.forces.lever import Lever, Thrust, close_thrust, find_thrust, plan_lever
from planmethod.plans.forces.motor import MotorMoment, close_motor, find_motor, weigh_first_driver
from planmethod.plans.forces.polygons import Applied, ForcePlan, numbers_of
from planmethod.plans.model import FACTS, PlanKind
from planmethod.problem.model import Convention, Problem, Slide
from planmethod.problem.records import BearingSection, Dynamics
from planmethod.solved.failures import Cause, Failure, Place, PositionError, explain, failing
from planmethod.solved.forces.bound import ForceConditioning
from planmethod.solved.forces.loads import UnshiftedInertia, applied, shifted_inertia
from planmethod.solved.legibility import Box
from planmethod.solved.quantities import SPOILT
from planmethod.solved.reading import Complexes, Memoizing, Reading, Reals, driven, fixed
from planmethod.solved.solution import (
    EVERY,
    FEW_ROWS,
    UNIT_SCALES,
    Solution,
    at_positions,
    filled,
)

TIMES = (2.0, 2.5, 4.0, 5.0, 10.0)
"""Enlargements of a lever: those of GOST 2.302 as far as they are needed."""

FULL = 10.0
"""Maximum number of loads per square decimetre of the lever and its surroundings, for letters."""

FEW = 15
"""Number of loads that never overfill a lever: their arrows find other lines."""

PLACE: Box = (150.0, 120.0)
"""Width and height that the lever of a project may fill, mm, beside arrows and letters."""

_LETTER_MARGIN = 30.0  # mm around the lever for the letters
_LARGEST = 400.0  # mm that a lever drawn larger may be across


def lever_times(lever: Lever, paper: Reading, fills: Reals) -> Reals:
    """Return how many times larger than the plan the lever is drawn in each position, shape (n,).

    ``paper`` is the exact reading of the force plans, mm; ``fills`` are the times that it is larger
    anyway (`filling`), or one.
    """
    if len(lever.loads) <= FEW:
        return fills
    acting = np.zeros(paper.count)
    hung = [lever.pole]
    for load in lever.loads:
        one = load.load.applied
        acting += np.asarray(one.couple if load.at is None else one.force) != 0
        if load.at is not None:
            hung.append(load.at)
    width, height = _size(paper, hung)
    for times in TIMES:
        room = (fills * width + 2 * _LETTER_MARGIN) * (fills * height + 2 * _LETTER_MARGIN) / 1e4
        full = (acting > FEW) & (acting > FULL * room) & (times > fills)
        fills = np.where(full & (times * np.maximum(width, height) <= _LARGEST), times, fills)
    return fills


def filling(
    paper: Reading, plan: Sequence[PointName], per_mm: Sequence[float], *, mm_per_unit: bool
) -> Reals:
    """Return how many times larger than the plan a lever fills its place, shape (n,).

    ``plan`` are the points of the velocity plan, ``per_mm`` is its scale in every position. The
    lever has a scale of the series; one where the plan fills the place, or nothing moves.
    """
    found = []
    for width, height, own in zip(*_size(paper, plan), per_mm, strict=True):
        size = own * float(height), own * float(width)  # it is turned
        finer = choose_scale(size, PLACE, mm_per_unit=mm_per_unit) if any(size) else own
        found.append(max(own / finer, 1.0))
    return np.array(found)


def _size(paper: Reading, points: Sequence[PointName]) -> tuple[Reals, Reals]:
    """Return width and height of the box around points, mm."""
    at = np.asarray([np.broadcast_to(paper.point(one), paper.count) for one in points])
    return np.ptp(at.real, axis=0), np.ptp(at.imag, axis=0)


VANISHING = 1e-12
"""Fraction of a position's largest force below which a reaction is negligible."""

Masks = npt.NDArray[np.bool_]


def transverse_component(force: Complexes, direction: Complexes) -> Reals:
    """Return the component of forces to the left of unit vectors along the guide, N."""
    return np.asarray((direction.conjugate() * force).imag, dtype=float)


def distance(normal: Reals, moment: Reals, is_zero: Masks) -> Reals:
    """Return the position of a force along the guide, m; NaN where the force is zero.

    Parameters
    ----------
    normal : ndarray, N
        Force to the left of the guide's direction.
    moment : ndarray, N·m
        Counter-clockwise positive.
    is_zero : ndarray of bool
        True where the force is zero.

    Returns
    -------
    ndarray
        Positive in the guide's direction: there a force to the left turns counter-clockwise.
    """
    divisor = np.where(is_zero, 1.0, normal)
    return np.asarray(np.where(is_zero, np.nan, moment / divisor), dtype=float)


def edge_forces(normal: Reals, moment: Reals, length: float) -> tuple[Reals, Reals]:
    """Return the forces at both edges of a slider, N, to the left of the guide's direction.

    The first is at the edge in the guide's direction; ``moment`` is about the middle, N·m. They
    have the force for their sum and the moment for theirs.
    """
    half = normal / 2.0
    return half + moment / length, half - moment / length


class JointForce(Struct, frozen=True):
    """Reaction in a joint in every position (реакция), N and N·m, ndarrays of shape (n,).

    ``moment`` is about ``at`` (m, in the file's coordinates), counter-clockwise positive; zero in a
    revolute pair.
    """

    joint: str
    on: str
    by: str
    at: Complexes
    force: Complexes
    moment: Reals


class EdgeForce(Struct, frozen=True):
    """Reaction at an edge of a slider in one position: its place, m, and the force, N."""

    at: complex
    force: complex


class SlideReaction(Struct, frozen=True, dict=True):
    """Reaction of one prismatic pair and its slider in every position, ndarrays of shape (n,).

    Attributes
    ----------
    slide : Slide
    joint : JointForce
    direction : Complexes
        Unit vectors in the guide's direction.
    base : Complexes, m
        A point of the guide's line.
    middle : Reals, m
        Middle of the contact, from ``joint.at`` in the guide's direction: the pin of the slider, or
        the joint of the block through which it passes.
    largest : Reals, N
        Size of the largest force of each position.
    """

    slide: Slide
    joint: JointForce
    direction: Complexes
    base: Complexes
    middle: Reals
    largest: Reals

    @property
    def length(self) -> float | None:
        """Length of contact (длина ползуна), m, if it is given."""
        return self.slide.length

    @cached_property
    def normal(self) -> Reals:
        """Force to the left of the guide's direction, N."""
        return transverse_component(self.joint.force, self.direction)

    def b(self, fraction: float = VANISHING) -> Reals:
        """Return where the force acts, m from ``joint.at`` in the guide's direction.

        Not a number where the force is less than a ``fraction`` of the largest.
        """
        nothing = np.abs(self.joint.force) <= fraction * self.largest
        return distance(self.normal, self.joint.moment, nothing)

    def place(self, b: Reals) -> Complexes:
        """Return the places of the guide's line at distances from ``joint.at``, m."""
        foot = ((self.joint.at - self.base) * self.direction.conjugate()).real
        return np.asarray(self.base + self.direction * (foot + b), dtype=complex)

    @cached_property
    def at_edges(self) -> Masks:
        """True where two reactions at the edges act instead of one."""
        if self.length is None:
            return np.zeros(self.normal.shape, dtype=bool)
        moment = np.abs(self._about_middle)
        something = moment > VANISHING * self.largest * self.length
        return np.asarray(something & (moment > np.abs(self.normal) * self.length / 2.0))

    @property
    def _about_middle(self) -> Reals:
        return self.joint.moment - self.middle * self.normal

    def edges(self, index: int) -> tuple[EdgeForce, ...]:
        """Return the reactions at the edges in a position where they act, else none.

        The first is at the edge in the guide's direction.
        """
        if self.length is None or not self.at_edges[index]:
            return ()
        ends = self.place(self.middle + self.length / 2), self.place(self.middle - self.length / 2)
        forces = edge_forces(self.normal, self._about_middle, self.length)
        left = 1j * self.direction[index]
        return tuple(
            EdgeForce(complex(end[index]), complex(left * force[index]))
            for end, force in zip(ends, forces, strict=True)
        )


def contacts(
    solution: Solution, reactions: Sequence[JointForce], largest: Reals
) -> Mapping[int, SlideReaction]:
    """Return the prismatic pairs by the numbers of their reactions.

    Parameters
    ----------
    largest : ndarray of shape (n,), N
        Size of the largest force of each position.
    """
    return {
        number: _contact(solution, slide, joint, largest)
        for number, joint in enumerate(reactions)
        for slide in [slide_between(solution.problem, joint)]
        if slide is not None
    }


def slide_between(problem: Problem, joint: JointForce) -> Slide | None:
    """Return the line on which one link of a joint slides on the other; None for a hinge."""
    for slider, host in ((joint.on, joint.by), (joint.by, joint.on)):
        slide = problem.slides.get(slider)
        if slide is not None and slide.host == host and slide.pin == joint.joint:
            return slide
    return None


def _contact(solution: Solution, slide: Slide, joint: JointForce, largest: Reals) -> SlideReaction:
    along = _directions(solution, slide)
    if slide.through is not None:
        base = solution.place(PointName(slide.through))
    else:
        base = np.full(along.shape, slide.base)
    centre = base if solution.problem.is_block(slide) else solution.place(PointName(slide.pin))
    middle = ((centre - joint.at) * along.conjugate()).real
    return SlideReaction(slide, joint, along, base, middle, largest)


def _directions(solution: Solution, slide: Slide) -> Complexes:
    if slide.host == FRAME:
        return np.full(solution.positions.shape, cis(slide.angle), dtype=complex)
    turned = solution.links[slide.host].phi_deg
    return np.asarray(unit_vectors(turned + slide.angle))


UNIT = FACTS[PlanKind.FORCE].unit
COMMON_BOX: Box = (100.0, 100.0)
"""Box that the largest of all force plans fills at the common scale, mm."""

PLAN_BOX: Box = (200.0, 150.0)
"""Box that each force plan of a group fills if drawn at its own scale, mm."""

LAST_BOX: Box = (140.0, 100.0)
"""Box of the driving link's plan, which closes with one force, mm."""

FAINT = 1e-6
"""Fraction of its size in its largest position below which a plan is negligible."""


class Planned(Struct, frozen=True):
    """Force plans of a problem as steps that continue its kinematics (планы сил).

    ``lever`` is None if the driver is at rest; ``thrust`` is the force of an actuator, ``motor``
    the moment of a motor between moving links.
    """

    board: ForceBoard
    driving: Driving
    lever: Lever | None
    thrust: Thrust | None = None
    motor: MotorMoment | None = None
    other_drivings: tuple[Driving, ...] = ()


def plan_forces(
    solution: Solution,
    draft: Draft,
    loads: Iterable[Applied],
    single: Mapping[str, Applied] = MappingProxyType({}),
    *,
    hung: bool = True,
) -> Planned:
    """Plan the forces of a solution on a draft of its construction, from the last group on.

    Parameters
    ----------
    draft : Draft
        Construction that is continued.
    loads : iterable of Applied
        Loads on the links other than the reactions.
    single : mapping of str to Applied
        Couples that the inertia force of their link includes, by link.
    hung : bool
        The loads act on the lever, too: not those of friction, which act on both links of a pair.
    """
    start = len(draft.b.steps)
    board = ForceBoard(draft, solution.construction.kinematics, _dynamics(solution))
    lay_off_loads(board, loads, single)
    thrust, motor, drive = None, None, solution.problem.drive
    if drive.motor is not None:
        motor = find_motor(board, solution.structure.groups, hung=hung and not drive.other_drives)
    elif drive.actuator is not None:
        thrust = find_thrust(board, solution.structure.groups, hung=hung and not drive.other_drives)
    for group in reversed(solution.structure.groups):
        group_forces(board, group)
    other_drivings = [other_driver_forces(board, other) for other in drive.other_drives]
    if motor is not None:
        driving, lever = close_motor(board, motor)
    elif thrust is not None:
        driving, lever = close_thrust(board, thrust)
    else:
        driving = drive_forces(board)
        lever = plan_lever(board, driving, other_drivings) if hung else None
    if other_drivings and hung and (motor or thrust):
        lever = weigh_first_driver(board, driving, other_drivings)
    draft.note_plan(PlanKind.FORCE, start)
    return Planned(board, driving, lever, thrust, motor, tuple(other_drivings))


class Loads(Struct, frozen=True):
    """Loads on the links, and the inertia forces that include their couples (нагрузки).

    ``single`` are those couples by link; ``unshifted`` the links that keep theirs.
    """

    applied: tuple[Applied, ...]
    single: Mapping[str, Applied] = {}
    unshifted: tuple[UnshiftedInertia, ...] = ()

    @property
    def kind(self) -> tuple[object, ...]:
        """Key that loads planned in the same way have in common."""
        named = ((one.name, one.link, one.point, one.kind) for one in self.applied)
        return (*named, *self.single)


def loads_on(solution: Solution, rubbing: Sequence[Applied] = ()) -> Loads:
    """Return the loads of a problem, those of friction last.

    Raises
    ------
    ProblemError
        As of `applied`.
    """
    found = (*applied(solution), *rubbing)
    dynamics = solution.problem.dynamics
    if dynamics is None or not dynamics.resultant:
        return Loads(found)
    return Loads(found, *shifted_inertia(solution, found))


def _combined_loads(solution: Solution) -> Loads:
    """Return the loads of variants that are planned in the same way, for all their positions."""
    each = [one.compute_once(loads_on) for one, _ in solution.parts]
    counts = [len(one.positions) for one, _ in solution.parts]
    alike = zip(*(one.applied for one in each), strict=True)
    found = tuple(_concatenate(of_all, counts) for of_all in alike)
    first, single = each[0], {}
    for link, couple in first.single.items():
        single[link] = next(
            joined for one, joined in zip(first.applied, found, strict=True) if one is couple
        )
    return Loads(found, single, first.unshifted)


def _concatenate(loads: Sequence[Applied], counts: Sequence[int]) -> Applied:
    told = zip(*map(numbers_of, loads), strict=True)
    return replace(
        loads[0],
        force=np.concatenate([one.force for one in loads]),
        couple=np.concatenate([one.couple for one in loads]),
        steady=None,
        numbers=tuple(
            np.concatenate([np.full(n, value) for n, value in zip(counts, values, strict=True)])
            for values in told
        ),
    )


def _dynamics(solution: Solution) -> Dynamics | None:
    """Return the masses of a problem; of many variants numbers of every position."""
    dynamics = solution.problem.dynamics
    if dynamics is None or len(solution.parts) == 1:
        return dynamics
    own = [one.problem.dynamics for one, _ in solution.parts]
    counts = [len(one.positions) for one, _ in solution.parts]
    masses = {}
    for link, mass in dynamics.masses.items():
        here = [one.masses[link] for one in own if one is not None]
        kilograms = np.repeat([one.mass for one in here], counts)
        inertia = np.repeat([one.inertia for one in here], counts)
        masses[link] = replace(mass, mass=kilograms, inertia=inertia)
    gravity = np.repeat([one.gravity for one in own if one is not None], counts)
    return replace(dynamics, gravity=gravity, masses=masses)


class Statics(Memoizing):
    """Force analysis of a solution (силовой расчёт).

    Parameters
    ----------
    solution : Solution
        Of a problem with ``[dynamics]``; every group must be a dyad.
    rubbing : sequence of Applied
        Forces and couples of friction, in addition to the other loads; then there is no lever.

    Attributes
    ----------
    unshifted : tuple of UnshiftedInertia
        Links that keep the couple of inertia although the file asks for the single resultant.
    """

    def __init__(self, solution: Solution, rubbing: Sequence[Applied] = ()) -> None:
        super().__init__()
        self.solution = solution
        several = len(solution.parts) > 1
        loads = _combined_loads(solution) if several else loads_on(solution, rubbing)
        self.unshifted = loads.unshifted
        draft = solution.construction.draft.copy()
        planned = plan_forces(solution, draft, loads.applied, loads.single, hung=not rubbing)
        self.board, self.driving, self.lever_plan = planned.board, planned.driving, planned.lever
        self.thrust, self.motor = planned.thrust, planned.motor
        self.other_driving = planned.other_drivings
        self.program: Program = self.board.draft.b.program().needed_for(self._needed_names())

    @property
    def driving_balances(self) -> list[NumberName]:
        """Balances of all driving links."""
        return [one.balance for one in (self.driving, *self.other_driving)]

    def _needed_names(self) -> list[Name]:
        asked: list[Name] = []
        for shift in self.board.shifts.values():
            asked += [shift.at, shift.length, shift.couple]
        for reaction in self.board.reactions:
            asked += [reaction.force.at, reaction.force.tail, reaction.force.head]
            asked += [reaction.couple] if reaction.couple is not None else []
        asked += self.driving_balances
        asked += [self.driving.moment] if self.driving.moment is not None else []
        asked += [*self.board.segments.values.values(), *self.board.segments.lengths.values()]
        asked += self.board.arms.values()
        asked.append(self.board.scale)
        return asked + (
            [self.lever_plan.balance, self.lever_plan.difference] if self.lever_plan else []
        )

    def read(self, arithmetic: Arithmetic, scales: Mapping[str, Number]) -> Reading:
        """Read the force plans in an arithmetic, at scales of all plans (units per mm)."""
        trace = evaluate(self.program, self.data(scales, EVERY), arithmetic)
        return Reading(trace, len(self.solution.positions))

    def data(
        self, scales: Mapping[str, Number], chosen: npt.NDArray[np.intp] | slice
    ) -> dict[str, Number]:
        """Return the data of the program at given scales, for some positions."""
        own, count = at_positions(self.board.data, chosen), len(self.solution.positions[chosen])
        if count <= FEW_ROWS or len(self.solution.parts) > 1:
            own = filled(own, count)
        return {**self.solution.data(scales, chosen), **own}

    @cached_property
    def si(self) -> Reading:
        """Exact reading at unit scale: one newton per millimetre of a force plan.

        Raises
        ------
        PositionError
            Where a force plan does not close, or rounding spoils its forces.
        """
        problem, at = self.solution.problem, self.solution.positions
        if not self.closes.all():
            raise PositionError(explain(self.board.draft, self.program, self.exact, at))
        spoilt = np.flatnonzero(~(self.bound <= SPOILT))
        if spoilt.size:
            i, others = int(spoilt[0]), spoilt.size - 1
            here, margin = Place.of(problem, at, i), float(self.margin[i])
            cause, name = Cause.SPOILT_FORCES, problem.name
            raise PositionError(
                Failure(cause, here, margin=margin, problem=name, same_count=others)
            )
        return self.exact

    @cached_property
    def exact(self) -> Reading:
        """The same, NaN in positions where a force plan does not close."""
        self.solution.si  # noqa: B018 - an impossible position must be reported first
        return self.read(Float64(), {**UNIT_SCALES, SCALE: 1.0})

    @cached_property
    def failing(self) -> npt.NDArray[np.int64]:
        """Number of the first step that fails in each position, or -1; shape (n,)."""
        return failing(self.program, self.exact.trace, len(self.solution.positions))

    @property
    def closes(self) -> npt.NDArray[np.bool_]:
        """True where the force plans close, shape (n,)."""
        return np.asarray(self.failing < 0)

    @cached_property
    def bound(self) -> Reals:
        """Bound of the relative error of the worst force, (n,): see `ForceConditioning.bound`."""
        return self._conditioning.bound()

    @cached_property
    def margin(self) -> Reals:
        """Least margin of all steps, shape (n,)."""
        return self._conditioning.margin

    @property
    def _conditioning(self) -> ForceConditioning:
        scales = {**UNIT_SCALES, SCALE: 1.0}
        return ForceConditioning(
            self.solution,
            self.board,
            self.driving,
            self.lever_plan,
            self.program,
            self.exact,
            self.closes,
            lambda chosen: self.data(scales, chosen),
        )

    def _vector(self, force: Force) -> Complexes:
        return fixed(self.si.vector(*force.ends) + 0.0)

    def _number(self, name: NumberName | None) -> Reals:
        if name is None:
            return fixed(np.zeros(self.solution.positions.shape))
        return fixed(self.si.number(name) + 0.0)  # a zero force is 0.0, not -0.0

    @cached_property
    def reactions(self) -> list[JointForce]:
        """Reactions in all joints, each once: the action of ``by`` on ``on``."""
        return [self._joint(reaction) for reaction in self.board.reactions]

    def _joint(self, reaction: Reaction) -> JointForce:
        return JointForce(
            reaction.joint,
            reaction.on,
            reaction.by,
            self.solution.place(reaction.force.at),
            self._vector(reaction.force),
            self._number(reaction.couple),
        )

    @cached_property
    def contacts(self) -> Mapping[int, SlideReaction]:
        """The reactions of the guides, by their numbers: where they act."""
        return contacts(self.solution, self.reactions, self.largest_forces)

    @cached_property
    def balance(self) -> Reals:
        """Balance of the driver: moment on a crank, N·m; force at its point or on a slider, N."""
        return self._number(self.driving.balance)

    @cached_property
    def other_balances(self) -> dict[str, Reals]:
        """Balance of each other driving link: moment on a crank, N·m, force on a slider, N."""
        others = self.solution.problem.drive.other_drives
        balances = (self._number(one.balance) for one in self.other_driving)
        return {other.link: one for other, one in zip(others, balances, strict=True)}

    @cached_property
    def moment(self) -> Reals | None:
        """Balancing moment on the crank, N·m, also with a balancing force; None for a slider."""
        return None if self.driving.moment is None else self._number(self.driving.moment)

    @cached_property
    def driving_rate(self) -> Reals | float:
        """Rate whose product with the balance is power: 1/s for a moment, m/s for a force."""
        drive = self.solution.problem.drive
        if drive.motor is not None:
            first, second = (self.solution.links[link].omega for link in drive.motor)
            return np.asarray(second - first, dtype=float)
        if drive.actuator is None:
            return driven(drive, self.solution.positions)[1]
        one, two = (self.solution.points[end] for end in drive.actuator)
        apart = two.place - one.place
        relative = (two.velocity - one.velocity) * apart.conjugate()
        return np.asarray(relative.real / np.abs(apart), dtype=float)

    @cached_property
    def lever(self) -> Reals | None:
        """Balance by the Zhukovsky lever; None if the driver is at rest."""
        return None if self.lever_plan is None else self._number(self.lever_plan.balance)

    def lever_at(self, index: int) -> Lever | None:
        """Return the lever of a position; None if the driver is at rest in it."""
        number_of("position", index, len(self.solution.positions))
        rates = np.broadcast_to(self.solution.driven[1], self.solution.positions.shape)
        return self.lever_plan if rates[index] else None

    @cached_property
    def largest_forces(self) -> Reals:
        """Size of the largest force of each position, load or reaction, N."""
        forces = [joint.force for joint in self.reactions]
        forces += [given.applied.force for given in self.board.given]
        none = np.zeros(self.solution.positions.shape)
        return fixed(np.asarray(np.max([none, *(np.abs(f) + none for f in forces)], axis=0)))

    def largest(self, index: int) -> float:
        """Return the size of the largest force of a position, load or reaction, N."""
        count = len(self.solution.positions)
        return float(self.largest_forces[number_of("position", index, count)])

    # Drawn -----------------------------------------------------------------------------------

    @property
    def scale(self) -> Scale:
        """Scale of the force plans (масштаб сил): the file's, or one of the series for all."""
        return self._scales[0]

    @cached_property
    def _scales(self) -> list[Scale]:
        return [self._scale(one, own) for one, own in self.solution.parts]

    @cached_property
    def mu(self) -> Number:
        """The same in N per mm; of many variants in every position."""
        found = [scale.per_mm for scale in self._scales]
        if len(found) == 1:
            return found[0]
        return np.repeat(found, [len(one.positions) for one, _ in self.solution.parts])

    def _scale(self, one: Solution, rows: slice) -> Scale:
        """Return the scale of the force plans of one mechanism, which has some positions."""
        scales = one.problem.scales
        if scales.mu_F is not None:
            return Scale(SCALE, scales.mu_F, UNIT)
        if PlanKind.FORCE in one.scales:
            return one.scales[PlanKind.FORCE]
        whole = [max(float(size[k][rows].max()) for size in self._sizes) for k in (0, 1)]
        inverse = scales.convention is Convention.MM_PER_UNIT
        box = whole[0], whole[1]
        return Scale(SCALE, choose_scale(box, COMMON_BOX, mm_per_unit=inverse), UNIT)

    def extent(self, plan: ForcePlan) -> Box:
        """Return width and height of a plan in the position in which it is widest, N."""
        width, height = self._extents(plan)
        return float(width.max()), float(height.max())

    @cached_property
    def _sizes(self) -> list[tuple[Reals, Reals]]:
        return [self._extents(plan) for plan in self.board.plans]

    def _extents(self, plan: ForcePlan) -> tuple[Reals, Reals]:
        """Return width and height of a plan in every position, N, shape (n,)."""
        ends = {end for edge in plan.polygon for end in (edge.tail, edge.head)}
        places = np.asarray([self.si.point(end) for end in sorted(ends)])
        return np.ptp(places.real, axis=0), np.ptp(places.imag, axis=0)

    @cached_property
    def plan_scales(self) -> list[Reals]:
        """Scale of each plan, by positions, N per mm, shape (n,): one that the file gives is all's.

        Negligible plans have the common one.
        """
        found = [np.full(len(self.solution.positions), self.mu) for _ in self.board.plans]
        for one, rows in self.solution.parts:
            if one.problem.scales.mu_F is not None:
                continue
            inverse = one.problem.scales.convention is Convention.MM_PER_UNIT
            for own, (width, height) in zip(found, self._sizes, strict=True):
                room = LAST_BOX if own is found[-1] else PLAN_BOX
                _enlarge(own[rows], (width[rows], height[rows]), room, inverse=inverse)
        return found

    @cached_property
    def enlargements(self) -> list[Reals]:
        """Enlargement of each plan relative to `scale`, by positions, shape (n,)."""
        return [self.mu / own for own in self.plan_scales]

    def plan_scale(self, number: int, index: int) -> Scale:
        """Return the scale at which one of the plans is drawn in a position."""
        number_of("plan", number, len(self.plan_scales))
        number_of("position", index, len(self.solution.positions))
        return Scale(SCALE, float(self.plan_scales[number][index]), UNIT)

    @cached_property
    def ruler_arithmetic(self) -> RulerArithmetic:
        """Arithmetic that reads each force on the first plan that has it, at that plan's scale."""
        segments, own = self.board.segments, self.solution.ruler_arithmetic
        enlargements: dict[str, Number] = {}
        for plan, share in zip(self.board.plans, self.enlargements, strict=True):
            for edge in plan.reactions:
                enlargements.setdefault(segments.drawn(edge.ends), share)
        if self.lever_plan is not None and (self.lever_times > 1.0).any():
            arms = [load.arm for load in self.lever_plan.loads] + [self.lever_plan.arm]
            enlargements |= {arm: self.lever_times for arm in arms if arm is not None}
        return replace(own, enlargements={**own.enlargements, **enlargements})

    @cached_property
    def lever_times(self) -> Reals:
        """Enlargement of the lever relative to the velocity plan, shape (n,)."""
        assert self.lever_plan is not None
        solution, fills = self.solution, np.ones(self.paper.count)
        if solution.problem.calculated is not None:  # a project's, at scales of all positions
            motion, kind = solution.construction.kinematics.velocity, PlanKind.VELOCITY
            # The force plans need not have every point of the velocity plan.
            fills = filling(
                solution.paper,
                (motion.pole, *motion.point.values()),
                [solution.plan_scale(kind, k).per_mm for k in range(self.paper.count)],
                mm_per_unit=solution.problem.scales.in_mm_per_unit,
            )
        return lever_times(self.lever_plan, self.paper, fills)

    @property
    def per_mm(self) -> dict[str, Number]:
        """Unit per millimetre of all plans, by the name that the program has for it."""
        return {**self.solution.per_mm, SCALE: self.mu}

    @cached_property
    def paper(self) -> Reading:
        """Exact reading at the scales of the drawings: millimetres of the plans."""
        return self.read(Float64(), self.per_mm)

    @cached_property
    def ruler_reading(self) -> Reading:
        """Reading with a ruler, along the draughtsman's own chain."""
        return self.read(self.ruler_arithmetic, self.per_mm)


def _enlarge(scales: Reals, sizes: tuple[Reals, Reals], space: Box, *, inverse: bool) -> None:
    """Give a plan its own scales in the positions of a mechanism in which it is not negligible."""
    size = np.maximum(*sizes)
    for index in np.flatnonzero(size > FAINT * np.max(size, initial=0.0)):
        box = float(sizes[0][index]), float(sizes[1][index])
        scales[index] = choose_scale(box, space, mm_per_unit=inverse)


def statics_of(solution: Solution) -> Statics:
    """Return the force analysis of a solution, made at the first call."""
    return of_type("solution", solution, Solution, "planmethod.solve()").compute_once(Statics)


def bearings_of(statics: Statics, joint: JointForce) -> BearingSection | None:
    """Return the two bearings that share the reaction of a shaft; None where the file has none."""
    dynamics = statics.solution.problem.dynamics
    if dynamics is None or FRAME not in (joint.on, joint.by):
        return None
    slides = joint.joint in {slide.pin for slide in statics.solution.problem.slides.values()}
    return None if slides else dynamics.bearings.get(joint.joint)
