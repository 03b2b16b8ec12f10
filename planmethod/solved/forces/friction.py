"""Friction in the pairs: forces without it, with one correction, and converged (силы трения).

Friction is a load on both links of a pair: along a guide f·N, about a pin f′·r·F, against the
relative motion. The force plans are linear in these loads, so those that the reactions themselves
cause are found by Newton's method, along the path on which friction grows from zero: if the path
ends before the full friction is reached, no driving force overcomes it.

A solver for all links at once would be shorter, but would have no groups, plans or readings: with
friction as a load, every group that has force plans has them with friction, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import evaluate
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.plans.forces.board import SCALE
from planmethod.plans.forces.polygons import Applied, LoadKind, numbers_of, reaction_symbol
from planmethod.problem.model import Problem, Slide
from planmethod.problem.names import pair_name, segment
from planmethod.problem.records import FrictionTask, PairFriction
from planmethod.solved.forces.laws import ZERO_SPEED_FRACTION
from planmethod.solved.forces.reading import ForceReading
from planmethod.solved.forces.statics import (
    JointForce,
    SlideReaction,
    Statics,
    slide_between,
    statics_of,
)
from planmethod.solved.reading import Complexes, Flags, Memoizing, Reading, Reals, memoized
from planmethod.solved.solution import UNIT_SCALES, Solution

ZERO_POWER_FRACTION = 1e-9
"""Fraction of the largest power in the joints below which a power is zero."""

_STEPS, _ROUNDS, _CLOSE = 16, 40, 1e-13

Matrices = npt.NDArray[np.float64]


class FrictionPair(Struct, frozen=True):
    """A pair with friction in every position (пара с трением), ndarrays of shape (n,).

    Attributes
    ----------
    number : int
        Of its reaction, among those of the force analysis.
    name : str
        ``B 3-0``.
    joint, on, by : str
        As of the reaction.
    rubbed : (str, str)
        The links that rub: both of these, but the wheel in place of the link that replaces its
        contact.
    slide : Slide or None
        None of a turning pair.
    f : float
        Coefficient: f of a sliding pair, f′ of a turning one.
    radius : float, m
        Of the pin; 0 of a sliding pair.
    rate : Reals
        Of ``on`` relative to ``by``: angular velocity, 1/s, or velocity along the guide, m/s.
    sense : Reals
        Its sign; 0 where the links do not move on one another.
    direction : Complexes
        Unit vectors in the guide's direction; of a turning pair zero.
    offset : Reals, m
        How far the guide's line is to the left of the slider's pin.
    frame : str
        How the frame is printed.
    """

    number: int
    name: str
    joint: str
    on: str
    by: str
    rubbed: tuple[str, str]
    slide: Slide | None
    f: float
    radius: float
    rate: Reals
    sense: Reals
    direction: Complexes
    offset: Reals
    frame: str

    @property
    def rho(self) -> float:
        """Radius of the friction circle (радиус круга трения), m; 0 of a sliding pair."""
        return self.f * self.radius

    @property
    def phi(self) -> float:
        """Angle of friction (угол трения), degrees; 0 of a turning pair."""
        return float(np.degrees(np.arctan(self.f))) if self.slide is not None else 0.0

    @property
    def coefficient(self) -> float:
        """Friction for a newton of the reaction: f, or ρ, m."""
        return self.f if self.slide is not None else self.rho

    @property
    def symbol(self) -> str:
        """The role of its letter: ``friction force of 30``."""
        return self._symbol("moment" if self.slide is None else "force", *self.rubbed)

    def _symbol(self, kind: str, on: str, by: str) -> str:
        on, by = (self.frame if link == FRAME else link for link in (on, by))
        return reaction_symbol(on, by, letter=f"friction {kind} of ").replace("_{", "").rstrip("}")

    def loads(self, size: Reals) -> list[Applied]:
        """Return the loads of friction of a size, N or N·m, on both links, ``on`` first."""
        found, none = [], np.zeros(size.shape)
        nowhere = np.zeros(size.shape, dtype=complex)
        on, by = self.rubbed
        for link, other, way in ((on, by, -1.0), (by, on, 1.0)):
            if link == FRAME:
                continue
            turns = self._symbol("moment", link, other)
            signed, kind = way * self.sense * size, LoadKind.FRICTION
            if self.slide is None:
                found.append(Applied(turns, link, None, nowhere, signed, kind))
                continue
            name = self._symbol("force", link, other)
            found.append(Applied(name, link, self.joint, signed * self.direction, none, kind))
            if np.any(self.offset):
                couple = -signed * self.offset
                found.append(Applied(turns, link, None, nowhere, couple, kind))
        return found


class RubbedForces(Struct, frozen=True):
    """Forces with friction in every position (силы с учётом трения), ndarrays of shape (n,).

    Attributes
    ----------
    friction : Reals, shape (k, n)
        Size of the friction of each pair, N or N·m.
    reactions : list of Complexes
        All reactions in the order of the force analysis, N: those of guides across them.
    moments : list of Reals
        Their moments about the places where the plans have them, N·m; zero in turning pairs.
    balance : Reals
        Balance of the driver, N·m or N.
    power : Reals, W
        Power of the driver; of several, of all together.
    other_balances : dict of str to Reals
        Balances of the other driving links, N·m or N.
    """

    friction: Reals
    reactions: list[Complexes]
    moments: list[Reals]
    balance: Reals
    power: Reals
    other_balances: dict[str, Reals]


class Friction(Memoizing):
    """Force analysis with friction of a solution (силовой расчёт с учётом трения).

    Parameters
    ----------
    solution : Solution
        Of a problem with ``[friction]``, whose driver moves.

    Attributes
    ----------
    every : list of FrictionPair
        All pairs in the order of the force analysis: friction in one changes the reactions of the
        others.
    pairs : list of FrictionPair
        Those of them that have friction.
    """

    def __init__(self, solution: Solution) -> None:
        super().__init__()
        self.solution, self.statics = solution, statics_of(solution)
        dynamics = solution.problem.dynamics
        assert dynamics is not None and dynamics.friction is not None
        _reject_unknown(solution.problem, dynamics.friction, self.statics.reactions)
        self.every = [
            _rubbing(solution, dynamics.friction, number, joint)
            for number, joint in enumerate(self.statics.reactions)
        ]
        self.pairs = [pair for pair in self.every if pair.coefficient]
        self._planned = self._with(np.ones((len(self.pairs), len(solution.positions))))

    def _with(self, sizes: Reals) -> Statics:
        rubbing = [
            one for pair, size in zip(self.pairs, sizes, strict=True) for one in pair.loads(size)
        ]
        return Statics(self.solution, rubbing)

    # Linear in friction ----------------------------------------------------------------------

    def _read(self, sizes: Reals) -> Reading:
        """Read the plans with friction of given sizes, shape (k, n)."""
        board = self._planned.board
        scales = {**UNIT_SCALES, SCALE: 1.0}
        data, names = (
            {**self.solution.data(scales, slice(None)), **board.data},
            dict(board.changing),
        )
        for pair, size in zip(self.pairs, sizes, strict=True):
            for load in pair.loads(size):
                data.update(zip(names[load.name], numbers_of(load), strict=True))
        trace = evaluate(self._planned.program, data, Float64())
        return Reading(trace, len(self.solution.positions))

    def _values(self, reading: Reading) -> tuple[Complexes, Reals, Reals]:
        """Return the reactions and their moments (m, n); power and the balances (1 + d, n)."""
        forces, moments = [], []
        for one in self._planned.board.reactions:
            forces.append(reading.vector(*one.force.ends))
            none = np.zeros(len(self.solution.positions))
            moments.append(none if one.couple is None else reading.number(one.couple))
        driving, rate = self._planned.driving, self.statics.driving_rate
        balance = reading.number(driving.balance)
        pushes = balance if driving.moment is None else reading.number(driving.moment)
        others = [reading.number(one.balance) for one in self._planned.other_driving]
        power = pushes * rate + sum(
            value * one.rate
            for value, one in zip(others, self.solution.problem.drive.other_drives, strict=True)
        )
        return np.asarray(forces), np.asarray(moments), np.asarray((power, balance, *others))

    @cached_property
    def _linear(self) -> tuple[list[npt.NDArray[np.complex128]], float]:
        """Return values without friction, then what each friction of one unit adds."""
        k, n = len(self.pairs), len(self.solution.positions)
        unit = max(float(self.statics.largest_forces.max(initial=0.0)), 1e-300)
        reads = [self._values(self._read(np.zeros((k, n))))]
        for number in range(k):
            sizes = np.zeros((k, n))
            sizes[number] = unit * self.pairs[number].coefficient
            reads.append(self._values(self._read(sizes)))
        whole = [np.concatenate([np.asarray(part, dtype=complex) for part in one]) for one in reads]
        per = [unit * pair.coefficient for pair in self.pairs]
        return [
            whole[0],
            *((one - whole[0]) / size for one, size in zip(whole[1:], per, strict=True)),
        ], unit

    def _at(self, sizes: Reals) -> npt.NDArray[np.complex128]:
        base, *added = self._linear[0]
        return base + sum((one * size for one, size in zip(added, sizes, strict=True)), 0 * base)

    def _pressing(self, sizes: Reals) -> tuple[Reals, Matrices]:
        """Return the pressing force of each pair, N, (k, n), and its derivatives, (n, k, k)."""
        values, added = self._at(sizes), self._linear[0][1:]
        pressed = np.zeros(sizes.shape)
        slopes = np.zeros((sizes.shape[1], len(self.pairs), len(self.pairs)))
        for row, pair in enumerate(self.pairs):
            force = values[pair.number]
            size = np.abs(force)
            way = np.where(size > 0, force / np.where(size > 0, size, 1.0), 0.0)
            turned = np.array([(way.conjugate() * one[pair.number]).real for one in added])
            contact = self.statics.contacts.get(pair.number)
            if contact is not None and contact.length is not None:
                # Both edges together: |F/2 + M/a| + |F/2 - M/a|, M about the middle.
                moment = self._about_middle(pair, contact, values)
                edges = 2.0 * np.abs(moment) / contact.length
                more = [self._about_middle(pair, contact, one) for one in added]
                slope = 2.0 * np.sign(moment) * np.array(more) / contact.length
                size, turned = (
                    np.where(edges > size, edges, size),
                    np.where(edges > size, slope, turned),
                )
            pressed[row], slopes[:, row, :] = size, turned.T
        return pressed, slopes

    def _about_middle(
        self, pair: FrictionPair, contact: SlideReaction, values: npt.NDArray[np.complex128]
    ) -> Reals:
        """Return the moment of a guide about the middle of its slider, N·m."""
        moment = values[len(self.statics.reactions) + pair.number].real
        normal = (contact.direction.conjugate() * values[pair.number]).imag
        return np.asarray(moment - contact.middle * normal, dtype=float)

    # Once, and converged ---------------------------------------------------------------------

    @cached_property
    def _coefficients(self) -> Reals:
        """Friction per newton of the pressing force, shape (k, n): zero where nothing moves."""
        return np.array([pair.coefficient * np.abs(pair.sense) for pair in self.pairs]).reshape(
            len(self.pairs), len(self.solution.positions)
        )

    @cached_property
    def _first(self) -> Reals:
        """Friction of the reactions without friction, shape (k, n)."""
        return self._coefficients * self._pressing(np.zeros(self._coefficients.shape))[0]

    @cached_property
    def _grown(self) -> tuple[Reals, Flags]:
        """Return friction of its own reactions, and where there is none such."""
        sizes, (k, n) = np.zeros(self._coefficients.shape), self._coefficients.shape
        jammed, own = np.zeros(n, dtype=bool), np.eye(k)
        scale = np.maximum(self._first.max(axis=0, initial=0.0), 1e-300)
        for step in range(1, _STEPS + 1):
            shares = self._coefficients * (step / _STEPS)
            for _ in range(_ROUNDS):
                pressed, slopes = self._pressing(sizes)
                jacobian = own - shares.T[:, :, np.newaxis] * slopes
                off = sizes - shares * pressed
                going = ~jammed & (np.abs(off).max(axis=0, initial=0.0) > _CLOSE * scale)
                jammed |= np.linalg.det(jacobian) <= 0.0
                going &= ~jammed
                if not going.any():
                    break
                change = np.linalg.solve(jacobian[going], off.T[going][:, :, np.newaxis])
                sizes[:, going] -= change[:, :, 0].T
            else:
                jammed |= np.abs(off).max(axis=0, initial=0.0) > 1e-9 * scale
        jammed |= (sizes < -1e-9 * scale).any(axis=0)
        sizes[:, jammed] = np.nan
        return sizes, jammed

    @property
    def jammed(self) -> Flags:
        """True where no driving force overcomes the friction (заклинивание), shape (n,)."""
        return self._grown[1]

    def _forces(self, sizes: Reals) -> RubbedForces:
        values, count = self._at(sizes), len(self.statics.reactions)
        moments = [one.real for one in values[count : 2 * count]]
        power, balance, *balances = (one.real for one in values[2 * count :])
        links = self.solution.problem.drive.links[1:]
        others = dict(zip(links, balances, strict=True))
        return RubbedForces(sizes, list(values[:count]), moments, balance, power, others)

    @cached_property
    def without(self) -> RubbedForces:
        """Forces of ideal pairs."""
        return self._forces(np.zeros(self._coefficients.shape))

    @cached_property
    def corrected(self) -> RubbedForces:
        """Forces with the friction that those of ideal pairs cause: one correction."""
        return self._forces(self._first)

    @cached_property
    def converged(self) -> RubbedForces:
        """Forces with the friction that they cause themselves; NaN where they are jammed."""
        return self._forces(self._grown[0])

    @cached_property
    def drawn(self) -> Statics:
        """The force plans with one correction, as they are drawn."""
        return self._with(self._first)

    def rub(self, pair: FrictionPair, forces: RubbedForces) -> Reals:
        """Return the size of the friction of a pair, N or N·m: zero if it has none."""
        if not pair.coefficient:
            return np.zeros(len(self.solution.positions))
        return np.asarray(forces.friction[self.pairs.index(pair)])

    def total(self, pair: FrictionPair, forces: RubbedForces) -> Complexes:
        """Return the whole reaction of a pair, N: that across a guide and the friction along it."""
        along = pair.sense * pair.direction * self.rub(pair, forces)
        return np.asarray(forces.reactions[pair.number] - along, dtype=complex)

    # Remaining effects -----------------------------------------------------------------------

    @cached_property
    def change(self) -> Reals:
        """Relative difference of one correction from the converged balance; NaN for no balance."""
        once, end = self.corrected.balance, self.converged.balance
        there = np.abs(self.converged.power) > ZERO_POWER_FRACTION * self.scale
        return np.where(there, np.abs(end - once) / np.where(there, np.abs(end), 1.0), np.nan)

    @cached_property
    def reaction_change(self) -> Reals:
        """The same of the reactions: the largest change, as a part of the largest reaction."""
        changes, sizes = [np.zeros(self.jammed.shape)], [np.full(self.jammed.shape, 1e-300)]
        for one, end in zip(self.corrected.reactions, self.converged.reactions, strict=True):
            changes.append(np.abs(end - one))
            sizes.append(np.abs(end))
        return np.asarray(np.max(changes, axis=0) / np.max(sizes, axis=0))

    @cached_property
    def scale(self) -> Reals:
        """Power that the largest force has with the fastest point, W, shape (n,)."""
        speeds = [np.abs(point.velocity) for point in self.solution.points.values()]
        return np.asarray(self.statics.largest_forces * np.max(speeds, axis=0) + 1e-300)

    @property
    def drives(self) -> Flags:
        """True where the driver drives the loads, not the reverse."""
        return self.without.power > 0

    @cached_property
    def efficiency(self) -> Reals:
        """Efficiency of the position (мгновенный КПД), shape (n,).

        If the driver drives, its power without friction over that with it; 0 if it is jammed. If
        the loads drive it, the inverse ratio: then it is negative if they cannot. NaN if there is
        no power.
        """
        ideal, real = self.without.power, np.where(self.jammed, np.inf, self.converged.power)
        there = np.abs(ideal) > ZERO_POWER_FRACTION * self.scale
        with np.errstate(divide="ignore", invalid="ignore"):
            found = np.where(self.drives, ideal / real, real / ideal)
        return np.where(there, found, np.nan)

    @cached_property
    def locks(self) -> Flags:
        """True where the mechanism locks itself (самоторможение): efficiency zero or negative."""
        return self.jammed | (self.efficiency <= 0)


def friction_of(solution: Solution) -> Friction:
    """Return the friction of a solution, computed at the first call."""
    return solution.compute_once(Friction)


class RubbedReading(ForceReading):
    """The forces of a position with one correction for friction, as they are drawn."""

    def __init__(self, solution: Solution, index: int) -> None:
        super().__init__(solution, index)
        self.friction = friction_of(solution)
        self.statics = self.friction.drawn
        self.plans = tuple(self.statics.board.plans)


@memoized
def rubbed_reading(solution: Solution, index: int) -> RubbedReading:
    """Return the forces of a position with friction; cached, since several views show them."""
    return RubbedReading(solution, index)


# Pairs -------------------------------------------------------------------------------------------


class PairData(NamedTuple):
    """Friction data of a pair in a file: its name, coefficient, radius of the pin, m."""

    name: str
    slides: bool
    f: float
    radius: float

    @property
    def rubs(self) -> bool:
        """True if the pair has friction."""
        return bool(self.f if self.slides else self.f * self.radius)


def pair_data(problem: Problem, task: FrictionTask, joint: JointForce) -> PairData:
    """Return a file's friction data of a pair; a sliding one has no radius."""
    slides, name = slide_between(problem, joint) is not None, _name(joint)
    if rolls(problem, joint):
        return PairData(name, slides, 0.0, 0.0)
    own = task.pairs.get(name, PairFriction())
    f = own.f if own.f is not None else task.f if slides else task.f_pin
    radius = task.radius if own.radius is None else own.radius
    return PairData(name, slides, f, 0.0 if slides else radius)


def rolls(problem: Problem, joint: JointForce) -> bool:
    """Return whether the links of a joint roll on each other, so that it has no friction.

    In the pole of a mesh nothing slides. A link in place of a contact has no pairs in fact but that
    with the others on the axle of the wheel.
    """
    ends = {joint.on, joint.by}
    contacts = (mesh for mesh in problem.mechanism.rolling if mesh.carrier in ends)
    return any(mesh.pole == joint.joint for mesh in problem.meshes) or any(
        ends <= {*mesh.joined} for mesh in contacts
    )


def _rubbed(problem: Problem, joint: JointForce) -> tuple[str, str]:
    """Return the links of a joint, a wheel in place of the link that replaces its contact."""
    wheels = {
        mesh.carrier: next(link for link in mesh.links if link != FRAME)
        for mesh in problem.mechanism.rolling
    }
    return wheels.get(joint.on, joint.on), wheels.get(joint.by, joint.by)


def _name(joint: JointForce) -> str:
    return pair_name(joint.joint, joint.on, joint.by)


def _rubbing(
    solution: Solution, task: FrictionTask, number: int, joint: JointForce
) -> FrictionPair:
    problem = solution.problem
    slide = slide_between(problem, joint)
    name, _, f, radius = pair_data(problem, task, joint)
    shape = solution.positions.shape
    if slide is None:
        on, by = _rubbed(problem, joint)
        rate = _omega(solution, on) - _omega(solution, by)
        fastest = np.max([np.abs(link.omega) for link in solution.links.values()], axis=0)
        along, beside = np.zeros(shape, dtype=complex), np.zeros(shape)
    else:
        contact = statics_of(solution).contacts[number]
        along = contact.direction
        relative = _velocity(solution, joint.on, joint.at) - _velocity(solution, joint.by, joint.at)
        rate = (along.conjugate() * relative).real
        speeds = [np.abs(point.velocity) for point in solution.points.values()]
        fastest = np.max(speeds, axis=0)
        pin = solution.points[slide.pin].place
        beside = (along.conjugate() * (contact.base - pin)).imag
        beside = np.where(np.abs(beside) < 1e-12, 0.0, beside)
    sense = np.where(np.abs(rate) > ZERO_SPEED_FRACTION * fastest, np.sign(rate), 0.0)
    return FrictionPair(
        number, name, joint.joint, joint.on, joint.by, _rubbed(problem, joint), slide, f, radius,
        rate, sense, along, beside, problem.mechanism.called(FRAME),
    )  # fmt: skip


def _omega(solution: Solution, link: str) -> Reals:
    return np.zeros(solution.positions.shape) if link == FRAME else solution.links[link].omega


def _velocity(solution: Solution, link: str, at: Complexes) -> Complexes:
    """Return the velocity of a link at a place, m/s."""
    if link == FRAME:
        return np.zeros(solution.positions.shape, dtype=complex)
    point = solution.points[next(iter(solution.problem.bodies[link].points))]
    return np.asarray(point.velocity + 1j * solution.links[link].omega * (at - point.place))


def _reject_unknown(problem: Problem, task: FrictionTask, joints: Sequence[JointForce]) -> None:
    """Reject friction of a pair that does not exist.

    Raises
    ------
    ProblemError
    """
    there = {_name(joint): joint for joint in joints}
    able = [name for name, joint in there.items() if not rolls(problem, joint)]
    faults = [
        Fault(
            f"friction.pairs.{segment(name)}",
            translate("in the pair '{}' nothing slides", name)
            if name in there
            else translate("the mechanism has no pair '{}'", name),
            translate("Its pairs: {}.", ", ".join(able))
            if name not in there
            else translate("Pairs with friction: {}.", ", ".join(able)),
        )
        for name in task.pairs
        if name not in able
    ]
    if faults:
        raise ProblemError(problem.name, faults)
