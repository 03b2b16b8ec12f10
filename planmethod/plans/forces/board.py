"""The drawing board of the force plans: loads laid off, chained, weighed; legs of a group."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from itertools import count

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Number
from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.mechanism.groups import OuterLeg
from planmethod.mechanism.model import FRAME, Revolute
from planmethod.plans.draft import Draft
from planmethod.plans.forces.polygons import (
    Applied,
    Components,
    CoupleOn,
    Edge,
    ForcePlan,
    Moments,
    Shift,
    as_known,
    reaction_edge,
    reaction_symbol,
)
from planmethod.plans.model import FACTS, Ends, PlanKind, Segments
from planmethod.plans.motion.legs import Kinematics, arm, track_direction
from planmethod.plans.motion.position import outer_point, slide_of
from planmethod.problem.model import Slide
from planmethod.problem.records import Dynamics

SCALE = FACTS[PlanKind.FORCE].scale
PREFIX = FACTS[PlanKind.FORCE].prefix


def symbol_letters(symbol: str) -> str:
    """Return the letters of a symbol in the form used in names of numbers: ``F_21``."""
    return symbol.replace("^{", "").replace("_{", "_").replace("}", "")


class Force(Struct, frozen=True):
    """Force on a link (сила): its point of action, its segment on a force plan and its letter."""

    at: PointName
    tail: PointName
    head: PointName
    symbol: str = ""

    @property
    def ends(self) -> Ends:
        """The segment."""
        return self.tail, self.head

    def reversed(self, symbol: str = "") -> Force:
        """Return the force that acts back."""
        return replace(self, tail=self.head, head=self.tail, symbol=symbol)


class GivenLoad(Struct, frozen=True):
    """Load that does not come from a joint, as the plan has it; a force or a couple.

    ``letters`` are those of the numbers that it is computed from, in rich text.
    """

    applied: Applied
    force: Force | None
    couple: NumberName | None
    letters: Mapping[NumberName, str] = {}


class Reaction(Struct, frozen=True):
    """Reaction of one link of a joint on the other (реакция в кинематической паре).

    Attributes
    ----------
    joint : str
        The point of a revolute pair; the pin of the slider of a prismatic one.
    on, by : str
        The link that the force acts on, and the link that exerts it.
    force : Force
    couple : NumberName or None
        Moment about the place of the force, N·m; None in a revolute pair.
    """

    joint: str
    on: str
    by: str
    force: Force
    couple: NumberName | None = None


class ForceBoard:
    """State of the force plans while they are being planned (планы сил в работе).

    ``forces`` and ``couples`` hold the loads on every link so far: its own loads, and the reactions
    of the groups joined to it. ``symbols`` are the letters of the couples; ``shifts`` are the
    inertia forces, by link, that include their couples. ``arms`` are the measured arms: about a
    point, of a force at a place and of a size. ``changing`` are loads that differ from position to
    position, by name, with the known numbers that hold them. ``starts`` are the pole and the first
    points of the plans and of the lever, in this order; ``loose`` are those of trial plans.
    """

    def __init__(
        self, draft: Draft, kinematics: Kinematics, dynamics: Dynamics | None = None
    ) -> None:
        self.draft, self.kinematics, self.dynamics = draft, kinematics, dynamics
        self.data: dict[str, Number] = {}
        self.forces: dict[str, list[Force]] = {}
        self.couples: dict[str, list[NumberName]] = {}
        self.given: list[GivenLoad] = []
        self.reactions: list[Reaction] = []
        self.plans: list[ForcePlan] = []
        self.symbols: dict[NumberName, str] = {}
        self.shifts: dict[str, Shift] = {}
        self.starts: list[PointName] = []
        self.loose: list[PointName] = []
        self.arms: dict[tuple[PointName, PointName, NumberName], NumberName] = {}
        self.changing: list[tuple[str, tuple[NumberName, ...]]] = []
        self._moments: dict[tuple[PointName, PointName, Ends], NumberName] = {}
        self._data: dict[str, NumberName] = {}
        self._counted = count(1)
        self.segments = Segments(draft.b, draft.b.known(SCALE), PREFIX)
        self.accelerations = kinematics.acceleration.segments.on(draft.b)
        self.pole = self.start()

    def trial(self) -> ForceBoard:
        """Return a separate board for trial loads."""
        tried = copy(self)
        tried.forces = {link: [*forces] for link, forces in self.forces.items()}
        tried.couples = {link: [*couples] for link, couples in self.couples.items()}
        tried.reactions, tried.plans, tried.starts = [], [], self.loose
        tried.symbols, tried.arms, tried._moments = dict(self.symbols), dict(self.arms), {}
        tried.segments = self.segments.on(self.draft.b)
        return tried

    @property
    def scale(self) -> NumberName:
        """Scale of all force plans, N per mm."""
        return self.segments.scale

    def name(self, hint: str) -> str:
        """Return an unused name."""
        return f"{PREFIX}{hint}{next(self._counted)}"

    def known(self, hint: str, value: Number) -> NumberName:
        """Take numbers of all positions as known."""
        name = self.draft.b.known(self.name(hint))
        self.data[name] = value
        return name

    def datum(self, letter: str, hint: str, value: Number) -> NumberName:
        """Take a number of the data as known, once, by its letter in rich text, ``m_{2}``."""
        if letter not in self._data:
            self._data[letter] = self.known(hint, value)
        return self._data[letter]

    def letter_of(self, name: NumberName) -> str:
        """Return the letter of a number of the data, in rich text; empty of another number."""
        return next((letter for letter, own in self._data.items() if own == name), "")

    def start(self) -> PointName:
        """Put down the first point of a force plan."""
        point = self.draft.b.take_point(self.name("o"))
        self.data[point] = 0j
        self.starts.append(point)
        return point

    # Plans -----------------------------------------------------------------------------------

    def chain(self, start: PointName, link: str, into: list[Edge]) -> PointName:
        """Lay the forces on a link off one after another, and return where they end.

        The laid off edges are put ``into`` a list.
        """
        for force in self.forces.get(link, ()):
            end = self._transfer_force(start, force.tail, force.head)
            self.segments.same(start, end, force.ends)
            into.append(Edge(force.symbol, link, force.at, start, end))
            start = end
        return start

    def back(self, end: PointName, link: str, into: list[Edge]) -> PointName:
        """Return where the forces on a link start that end in a point."""
        for force in self.forces.get(link, ()):
            start = self._transfer_force(end, force.head, force.tail)
            self.segments.same(start, end, force.ends)
            into.insert(0, Edge(force.symbol, link, force.at, start, end))
            end = start
        return end

    def _transfer_force(self, origin: PointName, tail: PointName, head: PointName) -> PointName:
        """Return the end of a force that is transferred to another point.

        A force from another plan is read there and laid off here.
        """
        length = self.segments.read((tail, head))
        return self.draft.b.carry(self.name("c"), origin, tail, head, length)

    def couples_on(self, *links: str) -> tuple[CoupleOn, ...]:
        """Return the couples on links so far, with their letters."""
        return tuple(
            CoupleOn(self.symbols[name], link, name)
            for link in links
            for name in self.couples.get(link, ())
        )

    def moment(self, links: Sequence[str], about: PointName, *others: Force) -> NumberName:
        """Return the moment of all loads on links, and of other forces, about a point, N·m."""
        b = self.draft.b
        terms = []
        for link in links:
            terms += [self.moment_of(force, about) for force in self.forces.get(link, ())]
            terms += self.couples.get(link, ())
        terms += [self.moment_of(force, about) for force in others]
        return b.total(self.name("M"), *(term for term in terms if term is not None))

    def moment_of(self, force: Force, about: PointName) -> NumberName | None:
        """Return the moment of a force about a point, N·m; None if the force acts in the point."""
        if force.at == about:
            return None
        b, key = self.draft.b, (about, force.at, force.ends)
        if key not in self._moments:
            size = self.size(force)
            arm = b.measure_arm(self.name("h"), about, force.at, *force.ends)
            self.arms[about, force.at, size] = arm
            powers = ((arm, 1), (size, 1), (self.draft.mu_l, 1))
            self._moments[key] = b.compute(self.name("M"), *powers)
        return self._moments[key]

    def size(self, force: Force) -> NumberName:
        """Return the size of a force, N: computed, or read off the plan that found it."""
        return self.segments.value(*force.ends, symbol_letters(force.symbol) or "F")

    def negative(self, number: NumberName) -> NumberName:
        """Return a number with the other sign."""
        return self.draft.b.compute(self.name("-"), (number, 1), factor=-1.0)

    def lay_off_tangential(
        self,
        origin: PointName,
        line: LineName,
        moment: NumberName,
        arm: tuple[tuple[NumberName, int], ...],
    ) -> PointName:
        """Lay off a tangential component: a moment over an arm, across a line."""
        over = tuple((name, -power) for name, power in arm)
        value = self.draft.b.compute(self.name("t"), (moment, 1), *over)
        across = self.draft.b.perpendicular(origin, line)
        return self.segments.lay_off_vector(self.name("t"), origin, across, value)

    def read_off(self, plan: ForcePlan) -> None:
        """Add a plan; every force that it finds is read."""
        for edge in plan.reactions:
            self.segments.value(edge.tail, edge.head, symbol_letters(edge.symbol))
        self.plans.append(plan)

    def called(self, link: str) -> str:
        """Return how a link is printed."""
        return self.draft.problem.mechanism.called(link)

    def react(
        self,
        joint: str,
        on: str,
        by: str,
        force: Force,
        couple: NumberName | None = None,
        *,
        inner: bool = False,
    ) -> None:
        """Note a reaction and its opposite on the link that exerts it.

        ``couple`` is about the place of ``force``. ``inner`` reactions act between links that are
        both done with.
        """
        force = replace(force, symbol=reaction_symbol(on, self.called(by)))
        self.size(force)
        self.reactions.append(Reaction(joint, on, by, force, couple))
        if couple is not None:
            self.symbols[couple] = reaction_symbol(on, self.called(by), letter="M")
        if by != FRAME and not inner:
            self.forces.setdefault(by, []).append(force.reversed(reaction_symbol(by, on)))
            if couple is not None:
                opposite = self.negative(couple)
                self.symbols[opposite] = reaction_symbol(by, on, letter="M")
                self.couples.setdefault(by, []).append(opposite)

    def react_guide(
        self, pin: str, on: str, by: str, force: Force, couple: NumberName, *, inner: bool = False
    ) -> CoupleOn:
        """Note the reaction of a guide: a force and its moment about the place of the force."""
        self.react(pin, on, by, force, couple, inner=inner)
        return CoupleOn(self.symbols[couple], on, couple, force.at)


def tangent(
    board: ForceBoard, leg: OuterLeg, origin: PointName, middle: PointName
) -> tuple[PointName, Components | None]:
    """Lay off the tangential reaction of a revolute leg: its moment about the middle joint.

    A guide has none: its reaction is across it.
    """
    if not isinstance(leg.joint, Revolute):
        return origin, None
    outer = outer_point(leg)
    lever = arm(board.draft, leg.link, outer, middle)
    moment = board.moment((leg.link,), middle)
    end = board.lay_off_tangential(origin, lever.line, moment, lever.length)
    return end, Components(
        leg, board.called(leg.to), PointName(outer), (outer, str(middle)), lever.length
    )


def guide_reaction(board: ForceBoard, leg: OuterLeg, force: Force, inner: Edge) -> CoupleOn:
    """Note the reaction of a guide: its moment about the pin balances those of all other forces.

    ``inner`` is the reaction of the middle joint on the slider.
    """
    pin = PointName(slide_of(board.draft, leg.joint).pin)
    acting = Force(inner.at, *inner.ends, inner.symbol)
    couple = board.negative(board.moment((leg.link,), pin, acting))
    return board.react_guide(pin, leg.link, leg.to, replace(force, at=pin), couple)


def guide_edge(board: ForceBoard, leg: OuterLeg, tail: PointName, head: PointName) -> Edge:
    """Return the reaction of a guide, which is across it."""
    slide = slide_of(board.draft, leg.joint)
    direction = track_direction(slide, board.draft.problem, perpendicular=True)
    return reaction_edge(
        leg.link, board.called(leg.to), PointName(slide.pin), tail, head, direction
    )


def of_guide(couple: CoupleOn, edges: Sequence[Edge], known: tuple[CoupleOn, ...]) -> Moments:
    """Return the moments about the pin of a slider, which give the moment of its guide."""
    assert couple.at is not None
    return Moments((couple.on,), couple.at, tuple(map(as_known, edges)), known, couple=couple)


def pressed_block(board: ForceBoard, slide: Slide, force: Force, loads: Sequence[Edge]) -> Moments:
    """Note the reaction of a block on the bar through it, by the moments about its own joint."""
    known = board.couples_on(slide.host)
    held = board.negative(board.moment((slide.host,), force.at))
    board.react_guide(slide.pin, slide.slider, slide.host, force, board.negative(held), inner=True)
    symbol = reaction_symbol(slide.host, slide.slider, letter="M")
    couple = CoupleOn(symbol, slide.host, held, force.at)
    return of_guide(couple, loads, known)
