"""Transfer functions through segments of the plans: v_q, u, a_q, ε_q (передаточные функции).

For a crank OA they are v_qC = l_OA·(pc)/(pa) and u_31 = (l_OA/l_CD)·(pc)/(pa); of the second order
a_qC = l_OA·(πc)/(πn_A), from the acceleration plan without the crank's own ε. Only the end of that
last vector needs an additional measurement; everything else is on the plans already.

Source: the homework guide, section 2.1, step 5.
"""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.construct.steps import NumberName, PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import Draft
from planmethod.plans.legend import ZERO, Quantity, QuantityKind
from planmethod.plans.model import FACTS, PlanKind
from planmethod.plans.motion.board import MotionBoard
from planmethod.plans.motion.legs import Kinematics, Turning
from planmethod.problem.graphs import ratio_of

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
        motion, power = self._motion(kind), self.order(kind)
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

    def _motion(self, kind: PlanKind) -> MotionBoard:
        return (
            self.kinematics.velocity if kind is PlanKind.VELOCITY else self.kinematics.acceleration
        )

    def of_point(self, point: str, kind: PlanKind) -> NumberName:
        """Return v_q or a_q of a named point, m."""
        if (f"point {point}", kind) not in self._made:
            self._made[f"point {point}", kind] = self._of_point(point, kind)
        return self._made[f"point {point}", kind]

    def _of_point(self, point: str, kind: PlanKind) -> NumberName:
        motion = self._motion(kind)
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
            length = self._motion(kind).segments.drawn((turning.start, turning.head))
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
            yield Quantity(of, name, point, name, shown=f"{FACTS[kind].letter}_{{q{point}}}")
    for link in driven:
        name, pair = steps.of_link(link, orders[0]), ratio_of(link, drive.link, driven)
        yield Quantity(QuantityKind.RATIO, name, pair, name)
    for link in driven:
        name = steps.of_link(link, orders[1])
        yield Quantity(QuantityKind.RATIO_2, name, link, name, shown=f"ε_{{q{link}}}")
