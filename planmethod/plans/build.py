"""Construction of a problem as one program, and every quantity once with its step."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property

from msgspec import Struct, field

from planmethod.construct.program import Program
from planmethod.construct.steps import Compute, LayOffLength, Name, NumberName, PointName, Step
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.mechanism.structure import Structure
from planmethod.plans.draft import Draft
from planmethod.plans.model import FACTS, MOTION, RATES, Choice, Plan, PlanKind
from planmethod.plans.motion.groups import drive_motion, group_motion
from planmethod.plans.motion.legs import Kinematics, MotionBoard, Turning, plan_letter
from planmethod.plans.motion.position import place_driver, place_frame, place_group
from planmethod.problem.machine_records import ratio_of
from planmethod.problem.model import Problem
from planmethod.problem.quantities import OF_PLANS, QuantityKey, QuantityKind

ZERO = "0"
"""Name of the number zero, which no object of a problem can have."""


def plan_of(kind: QuantityKind) -> PlanKind:
    """Return the plan on which a quantity is found."""
    return PlanKind.FORCE if kind.is_force and not kind.is_length_on_paper else MOTION[kind.order]


MOTION_KINDS = tuple(
    kind
    for plan in RATES
    for kind in (QuantityKind.VELOCITY, QuantityKind.ACCELERATION, *OF_PLANS)
    if plan_of(kind) is plan
)
"""Kinds of quantities of points and links that the plans give, in the order in which tables have
them."""


def kinds_on(plan: PlanKind) -> tuple[QuantityKind, ...]:
    """Return the quantities among them that a plan gives."""
    return tuple(kind for kind in MOTION_KINDS if plan_of(kind) is plan)


class Quantity(Struct, frozen=True):
    """One quantity of a solved problem (величина).

    Attributes
    ----------
    kind : QuantityKind
    name : Name
        Step that makes it: a point of a plan (its vector is from the pole), a number, or for a
        direction the line of the link's own axis; `ZERO` if it is zero by nature.
    of : str
        Point, link, or pair; of a reaction its joint and links, ``B_2/1`` (on link 2 from 1).
    size : NumberName or None
        Number that the drawing gives for it; None for places and directions.
    row : str
        Beginning of the names of its columns, if not ``of``: ``F.B.2-1``.
    shown : str
        Symbol as rich text, if not the letter of its kind with ``of`` as an index.
    opposite : str
        Symbol of the opposite reaction.
    named : QuantityKey or None
        Its name, if it is not its kind and ``of``.
    """

    kind: QuantityKind
    name: Name
    of: str
    size: NumberName | None = None
    row: str = ""
    shown: str = ""
    opposite: str = ""
    named: QuantityKey | None = None

    @property
    def key(self) -> QuantityKey:
        """Its name."""
        return self.named or QuantityKey(self.kind, (self.of,))

    @property
    def label(self) -> str:
        """Label by which it is requested.

        ``B`` (a place), ``v_B``, ``a_B``, ``phi_2``, ``omega_2``, ``epsilon_2``, ``v_B3/2``,
        ``ak_B3/2``, ``ar_B3/2``; ``u_2``, the direction ``phi_2`` as a unit vector. Transfer
        functions are ``v_q_B``, ``u_21``, ``a_q_B``, ``epsilon_q_2``. Of forces
        ``F_B_2/1``, ``M_B_2/1`` (its moment), ``M_dr`` or ``F_dr``, ``M_lever`` or ``F_lever``.
        """
        return self.kind.label(self.of, self.named.axis if self.named else "")

    @property
    def symbol(self) -> str:
        """Symbol as rich text: ``ω_{2}``."""
        letter = self.kind.symbol
        return self.shown or (f"{letter}_{{{self.of}}}" if letter else self.of)

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of its columns in a table of numbers: ``B.vx``, ``B.vy``; ``v_B3/2``."""
        if self.named and self.named.axis:
            return (self.label,)
        stem = self.row or self.of
        return tuple(stem + end for end in self.kind.columns) or (self.label,)


class PlanSegment(Struct, frozen=True):
    """Segment of a plan that is measured on paper (отрезок плана).

    Attributes
    ----------
    kind : PlanKind
    name : str
        ``p-b3``.
    length : NumberName
        What the draughtsman knows of it, mm: laid off, or read.
    drawn : NumberName
        What the ruler gives on the finished drawing, mm; the same where it was read.
    """

    kind: PlanKind
    name: str
    length: NumberName
    drawn: NumberName

    @property
    def label(self) -> str:
        """Label of its drafting error: ``velocity.p-b3``."""
        return f"{self.kind.value}.{self.name}"


def motion_quantities(kinematics: Kinematics, draft: Draft) -> Iterator[Quantity]:
    """Yield the quantities of the motion: of points, links and sliding.

    Parameters
    ----------
    draft : Draft
        Receives the own axes of links that have no line yet.
    """
    velocity, acceleration = kinematics.velocity, kinematics.acceleration
    zero = draft.known(ZERO, 0.0)
    for name, at in velocity.named.items():
        letter = draft.problem.lettered(name)
        yield Quantity(QuantityKind.PLACE, PointName(at[1]), name, shown=letter)
        for motion, kind in (
            (velocity, QuantityKind.VELOCITY),
            (acceleration, QuantityKind.ACCELERATION),
        ):
            shown = "" if letter == name else f"{kind.symbol}_{{{letter}}}"
            yield Quantity(kind, motion.point[at], name, motion.size(at) or zero, shown=shown)
    for link in draft.problem.mechanism.links:
        axis = draft.axis(link)
        yield Quantity(QuantityKind.DIRECTION, axis, link)
        yield Quantity(QuantityKind.UNIT, axis, link)
        omega, epsilon = kinematics.omega.get(link, zero), kinematics.epsilon.get(link, zero)
        yield Quantity(QuantityKind.OMEGA, omega, link, omega)
        yield Quantity(QuantityKind.EPSILON, epsilon, link, epsilon)
    values = acceleration.segments.values
    for r in kinematics.relatives.values():
        assert r.a_start is not None and r.a_coriolis is not None and r.a_head is not None
        pair = tuple(velocity.label(link, r.point) for link in (r.of, r.to))
        sliding = (
            (QuantityKind.SLIDING, r.speed),
            # A guide that does not turn makes no Coriolis acceleration.
            (QuantityKind.CORIOLIS, values.get((r.a_start, r.a_coriolis), zero)),
            (QuantityKind.RELATIVE, values[r.a_coriolis, r.a_head]),
        )
        for kind, size in sliding:
            yield Quantity(kind, size, r.name, size, named=QuantityKey(kind, pair))


def plan_segments(draft: Draft, motions: tuple[MotionBoard, MotionBoard]) -> Iterator[PlanSegment]:
    """Yield the segments that are measured on the plans; adds the readings of those laid off."""
    b = draft.b
    computed = {step.out for step in b.steps if isinstance(step, Compute)}
    steps = [step for step in b.steps if isinstance(step, LayOffLength)]
    laid = {frozenset((step.origin, step.out)): step.length for step in steps}
    for p, q in draft.segments():
        drawn = draft.measured(p, q)
        length = laid.get(frozenset((PointName(p), PointName(q))), drawn)
        yield PlanSegment(PlanKind.POSITION, f"{p}-{q}", length, drawn)
    for motion in motions:
        for vector in motion.vectors:
            ends = (vector.tail, vector.head)
            length = motion.segments.drawn(ends)
            drawn = b.measure(f"{length} drawn", *ends) if length in computed else length
            tail, head = (plan_letter(motion, end) for end in ends)
            yield PlanSegment(motion.kind, f"{tail}-{head}", length, drawn)


Powers = tuple[tuple[NumberName, int], ...]


class TransferSteps:
    """Steps of the transfer functions, which continue those of the plans.

    Parameters
    ----------
    kinematics : Kinematics
        Of a mechanism with a crank.
    draft : Draft
        Construction that is continued.
    by_values : bool
        Computed from the velocities and rates found from the segments, v_C/ω₁, not from the
        segments: the numbers are the same but follow substituted values.

    Attributes
    ----------
    pin : str
        Point of the crank with whose segments all others are compared; empty if there is none.
    """

    def __init__(self, kinematics: Kinematics, draft: Draft, *, by_values: bool = False) -> None:
        self.kinematics, self.draft, self.b, self.by_values = kinematics, draft, draft.b, by_values
        self.drive = draft.problem.drive
        assert self.drive.pivot is not None
        points = draft.problem.bodies[self.drive.link].points
        self.pin = next((p for p in points if points[p] != points[self.drive.pivot]), "")
        self.omega = kinematics.omega[self.drive.link]
        self.even = self.drive.acceleration == 0.0
        self._made: dict[tuple[str, PlanKind], NumberName] = {}

    @property
    def normal(self) -> PointName:
        """End of the normal acceleration of the crank's pin on the plan, ``n_A``."""
        motion = self.kinematics.acceleration
        if self.even:
            return motion.point[self.drive.link, self.pin]
        return PointName(f"{FACTS[motion.kind].prefix}n_{self.pin}{self.drive.pivot}")

    def per_mm(self, kind: PlanKind) -> Powers:
        """Return the value of a millimetre of a plan, as factors: l_OA/(pa), l_OA/(πn_A)."""
        motion, power = self.kinematics.motion(kind), self.order(kind)
        if not self.pin:
            return ((motion.segments.scale, 1), (self.omega, -power))
        assert self.drive.pivot is not None
        end = self.normal if power == 2 else motion.point[self.drive.link, self.pin]
        length = self.draft.length(self.drive.link, self.drive.pivot, self.pin)
        return ((length, 1), (motion.segments.drawn((motion.pole, end)), -1))

    @staticmethod
    def order(kind: PlanKind) -> int:
        """Return of which order the derivatives are that a plan gives."""
        return 1 if kind is PlanKind.VELOCITY else 2

    def of_point(self, point: str, kind: PlanKind) -> NumberName:
        """Return v_q or a_q of a named point, m."""
        if (f"point {point}", kind) not in self._made:
            self._made[f"point {point}", kind] = self._of_point(point, kind)
        return self._made[f"point {point}", kind]

    def _of_point(self, point: str, kind: PlanKind) -> NumberName:
        motion = self.kinematics.motion(kind)
        head, name = motion.point[motion.named[point]], f"{FACTS[kind].letter}_q_{point}"
        if head == motion.pole:
            return self.draft.known(ZERO, 0.0)
        if self.by_values and (kind is PlanKind.VELOCITY or self.even):
            power, value = self.order(kind), motion.segments.known((motion.pole, head))
            return self.b.compute(name, (value, 1), (self.omega, -power), size=True)
        if kind is PlanKind.VELOCITY or self.even:
            length = motion.segments.drawn((motion.pole, head))
        elif self.of_crank(point):
            assert self.drive.pivot is not None
            place = motion.named[point][1]
            radius = self.draft.length(self.drive.link, self.drive.pivot, place)
            return self.b.compute(name, (radius, 1))
        else:
            head = self.uniform_end(point)
            length = self.b.measure(f"|{name}|", motion.pole, head)
        return self.b.compute(name, (length, 1), *self.per_mm(kind), size=True)

    def of_crank(self, point: str) -> bool:
        """Return whether a named point is on the crank itself: its a_q is its radius."""
        link, place = self.kinematics.velocity.named[point]
        return link == self.drive.link and place in self.draft.problem.bodies[link].points

    def uniform_end(self, point: str) -> PointName:
        """Carry the part of the crank's ε off the end of an acceleration: -v_q·ε, along (pc)."""
        v, a = self.kinematics.velocity, self.kinematics.acceleration
        tail, head = v.pole, v.point[v.named[point]]
        epsilon = self.kinematics.epsilon[self.drive.link]
        times = self.b.compute(
            f"times_q_{point}",
            *((v.segments.scale, 1), (epsilon, 1), (self.omega, -1), (a.segments.scale, -1)),
            factor=-1.0,
        )
        length = None if head == tail else v.segments.drawn((tail, head))
        out = f"{FACTS[a.kind].prefix}{point}_q"
        return self.b.carry(out, a.point[a.named[point]], tail, head, length, times=times)

    def of_link(self, link: str, kind: PlanKind) -> NumberName:
        """Return u or ε_q of a link, with its sign: positive in the sense of growing φ."""
        if (link, kind) not in self._made:
            self._made[link, kind] = self._of_link(link, kind)
        return self._made[link, kind]

    def _of_link(self, link: str, kind: PlanKind) -> NumberName:
        first = kind is PlanKind.VELOCITY
        name = f"u_{link}" if first else f"epsilon_q_{link}"
        if first or self.even:
            rates = self.kinematics.rates(kind)
            if link not in rates:
                return self.draft.known(ZERO, 0.0)
            turning = None if self.by_values else self.turning(link, kind)
            if turning is None:  # it turns as the crank, if not
                return self.b.compute(name, (rates[link], 1), (self.omega, -self.order(kind)))
            length = self.kinematics.motion(kind).segments.drawn((turning.start, turning.head))
            inverse = tuple((factor, -power) for factor, power in turning.arm)
            return self.b.compute(name, (length, 1), *self.per_mm(kind), *inverse)
        own, crank = self.kinematics.epsilon.get(link), self.kinematics.epsilon[self.drive.link]
        u = self.of_link(link, PlanKind.VELOCITY)
        terms = [self.b.compute(f"{name}*", (u, 1), (crank, 1), (self.omega, -2), factor=-1.0)]
        if own is not None:
            terms.insert(0, self.b.compute(f"{name}**", (own, 1), (self.omega, -2)))
        return self.b.total(name, *terms)

    def turning(self, link: str, kind: PlanKind) -> Turning | None:
        """Return the segment that gives a link's rotation; None if it turns with the crank."""
        rates = self.kinematics.rates(kind)
        if rates[link] == rates.get(self.drive.link):
            return None
        for (of, other), turning in self.kinematics.turnings.items():
            if of is kind and rates[other] == rates[link]:
                return turning
        return None


def transfer_quantities(kinematics: Kinematics, draft: Draft) -> Iterator[Quantity]:
    """Yield the transfer functions of all moving points and links; none for a driving slider.

    Parameters
    ----------
    draft : Draft
        Gets their steps.
    """
    drive, problem = draft.problem.drive, draft.problem
    if not drive.revolves:
        return
    steps, orders = TransferSteps(kinematics, draft), (PlanKind.VELOCITY, PlanKind.ACCELERATION)
    moving = [
        n
        for n, at in kinematics.velocity.named.items()
        if kinematics.velocity.point[at] != kinematics.velocity.pole
    ]
    driven = [link for link in problem.mechanism.links if link not in (drive.link, FRAME)]
    for kind, of in zip(orders, (QuantityKind.TRANSFER, QuantityKind.TRANSFER_2), strict=True):
        for point in moving:
            name = steps.of_point(point, kind)
            shown = f"{FACTS[kind].letter}_{{q{problem.lettered(point)}}}"
            yield Quantity(of, name, point, name, shown=shown)
    for link in driven:
        name, pair = steps.of_link(link, orders[0]), ratio_of(link, drive.link, driven)
        key = QuantityKey(QuantityKind.RATIO, (link, drive.link))
        yield Quantity(QuantityKind.RATIO, name, pair, name, named=key)
    for link in driven:
        name = steps.of_link(link, orders[1])
        yield Quantity(QuantityKind.RATIO_2, name, link, name, shown=f"ε_{{q{link}}}")


class Section(Struct, frozen=True):
    """Steps of one structural group on one plan (раздел построения).

    ``group`` is None for the driver; the frame has a section of its own on the position plan only.
    """

    kind: PlanKind
    group: AssurGroup | None
    steps: tuple[Step, ...]
    frame: bool = False


class Construction(Struct, frozen=True, dict=True):
    """A problem's program and the meaning of its names.

    Attributes
    ----------
    structure : Structure
        Groups of the mechanism, in the order of which the plans are drawn.
    program : Program
        Steps of all three plans; a reading keeps the steps that it needs.
    draft : Draft
        Known numbers and given places of the data.
    kinematics : Kinematics
        Names of angular velocities and accelerations and of relative motions.
    plans : tuple of Plan
        Velocity and acceleration plan.
    sections : tuple of Section
        The program cut where one group ends and the next begins.
    legend : tuple of Quantity
        Quantities of the motion, in the order of the plans.
    segments : tuple of PlanSegment
        Segments that are measured on the plans.
    """

    structure: Structure
    program: Program
    draft: Draft
    kinematics: Kinematics
    plans: tuple[Plan, Plan]
    sections: tuple[Section, ...]
    legend: tuple[Quantity, ...]
    segments: tuple[PlanSegment, ...]

    def step(self, name: Name) -> Step:
        """Return the step that makes a name."""
        return self._steps_by_name[name]

    @cached_property
    def _steps_by_name(self) -> dict[Name, Step]:
        return {step.out: step for step in self.program.steps}

    @property
    def parts(self) -> dict[Name, int]:
        """Number of the group that a step of the position plan places, from 0 of the frame."""
        placed = (section for section in self.sections if section.kind is PlanKind.POSITION)
        return {step.out: k for k, section in enumerate(placed) for step in section.steps}

    def plan(self, kind: PlanKind) -> Plan:
        """Return the velocity or the acceleration plan."""
        return next(plan for plan in self.plans if plan.kind is kind)


class _Cutter(Struct):
    """Cut the growing list of steps into sections."""

    draft: Draft
    start: int = 0
    sections: list[Section] = field(default_factory=list)

    def cut(self, kind: PlanKind, group: AssurGroup | None = None, *, frame: bool = False) -> None:
        steps = tuple(self.draft.b.steps[self.start :])
        self.sections.append(Section(kind, group, steps, frame))
        self.start = self.draft.note_plan(kind, self.start)


def begin_positions(problem: Problem, choice: Choice) -> Draft:
    """Plan the position plan of the driver: groups are added to it one by one."""
    draft = Draft(problem, choice)
    _positions(draft, (), _Cutter(draft))
    return draft


def add_group(draft: Draft, group: AssurGroup) -> None:
    """Add a group to a position plan that has the links it is joined to."""
    cutter = _Cutter(draft, len(draft.b.steps))
    place_group(draft, group)
    cutter.cut(PlanKind.POSITION, group)


def _positions(draft: Draft, groups: Iterable[AssurGroup], cutter: _Cutter) -> None:
    place_frame(draft)
    cutter.cut(PlanKind.POSITION, frame=True)
    place_driver(draft)
    cutter.cut(PlanKind.POSITION)
    for group in groups:
        place_group(draft, group)
        cutter.cut(PlanKind.POSITION, group)


def build(problem: Problem, structure: Structure, choice: Choice) -> Construction:
    """Plan all three plans, group by group in the order of kinematic analysis."""
    draft = Draft(problem, choice)
    cutter = _Cutter(draft)
    _positions(draft, structure.groups, cutter)
    velocity = MotionBoard.start(PlanKind.VELOCITY, draft)
    acceleration = MotionBoard.start(PlanKind.ACCELERATION, draft)
    kinematics = Kinematics(draft, velocity, acceleration)
    for motion in (velocity, acceleration):
        drive_motion(kinematics, motion)
        cutter.cut(motion.kind)
        for group in structure.groups:
            group_motion(kinematics, motion, group)
            cutter.cut(motion.kind, group)
    legend = tuple(motion_quantities(kinematics, draft))
    segments = tuple(plan_segments(draft, (velocity, acceleration)))
    plans = (_plan(velocity), _plan(acceleration))
    sections = tuple(cutter.sections)
    return Construction(
        structure, draft.b.program(), draft, kinematics, plans, sections, legend, segments
    )


def _plan(motion: MotionBoard) -> Plan:
    letters: dict[PointName, str] = {}
    for at, shown in motion.letters.items():
        letters[at] = ", ".join(shown)
    return Plan(motion.kind, motion.pole, letters, tuple(motion.vectors), tuple(motion.equations))
