"""The drawing board of the force plans: loads laid off, chained and weighed (силовой расчёт).

A force is a segment of a plan and the place on the position plan where it acts; a couple is a
number, N·m. Places are those of the position plan, so arms are measured where a textbook does.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from planmethod.construct.arithmetic import Number
from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import Draft
from planmethod.plans.forces.loads import Applied, LoadKind, Shift, free_letter, numbers_of
from planmethod.plans.forces.polygons import CoupleOn, Edge, ForcePlan, reaction_symbol
from planmethod.plans.model import FORCE_PREFIX
from planmethod.plans.motion.leads import Kinematics
from planmethod.problem.load_records import Mass

SCALE = "mu_F"


@dataclass(frozen=True, slots=True)
class Force:
    """Force on a link (сила): where it acts, its segment on a force plan, and its letter.

    ``read`` is a force that a plan has found: who uses it reads its length with the ruler.
    """

    at: PointName
    tail: PointName
    head: PointName
    symbol: str = ""
    read: bool = False

    def reversed(self, symbol: str = "") -> Force:
        """Return the force that acts back."""
        return replace(self, tail=self.head, head=self.tail, symbol=symbol)


@dataclass(frozen=True, slots=True)
class Given:
    """Load that does not come from a joint, as the plan has it; a force or a couple."""

    applied: Applied
    force: Force | None
    couple: NumberName | None


@dataclass(frozen=True, slots=True)
class Reaction:
    """What one link of a joint does to the other (реакция в кинематической паре).

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


@dataclass(slots=True)
class Board:
    """State of the force plans while they are being planned (планы сил в работе).

    ``forces`` and ``couples`` hold what acts on every link so far: its own loads, and what the
    groups that hang on it do to it. ``symbols`` are the letters of the couples; ``shifts`` are the
    forces of inertia, by link, that stand for their couples as well. ``changing`` are loads that
    differ from position to position, by name, with the known numbers that hold them.
    """

    draft: Draft
    kin: Kinematics
    data: dict[str, Number] = field(default_factory=dict)
    forces: dict[str, list[Force]] = field(default_factory=dict)
    couples: dict[str, list[NumberName]] = field(default_factory=dict)
    given: list[Given] = field(default_factory=list)
    reactions: list[Reaction] = field(default_factory=list)
    plans: list[ForcePlan] = field(default_factory=list)
    symbols: dict[NumberName, str] = field(default_factory=dict)
    shifts: dict[str, Shift] = field(default_factory=dict)
    starts: list[PointName] = field(default_factory=list)
    changing: list[tuple[str, tuple[NumberName, ...]]] = field(default_factory=list)
    scale: NumberName = field(init=False)
    pole: PointName = field(init=False)
    _count: int = 0

    def __post_init__(self) -> None:
        self.scale = self.draft.b.known(SCALE)
        self.pole = self.start()

    def name(self, hint: str) -> str:
        """Return a name that nothing has."""
        self._count += 1
        return f"{FORCE_PREFIX}{hint}{self._count}"

    def known(self, hint: str, value: Number) -> NumberName:
        """Take numbers of all positions as known."""
        name = self.draft.b.known(self.name(hint))
        self.data[name] = value
        return name

    def start(self) -> PointName:
        """Put down the first point of a force plan."""
        point = self.draft.b.given(self.name("o"))
        self.data[point] = 0j
        self.starts.append(point)
        return point

    # Loads -----------------------------------------------------------------------------------

    def load(
        self, masses: Mapping[str, Mass], applied: Iterable[Applied], single: Mapping[str, Applied]
    ) -> None:
        """Lay off what acts on the links beside the reactions.

        ``single`` are the couples of inertia, by link, that the shifted force stands for.
        """
        for one in applied:
            if one is single.get(one.link):
                continue
            if one.point is None:
                couple = self._couple(masses, one)
                self.couples.setdefault(one.link, []).append(couple)
                self.symbols[couple] = one.name
                self.given.append(Given(one, None, couple))
                continue
            link, place = self.kin.velocity.named[one.point]
            at = PointName(place)
            if one.kind is LoadKind.INERTIA:
                mass = self._mass(masses, one)
                tail, head = self._inertia(mass, link, place)
                if one.link in single:
                    at = self._shifted(masses, single[one.link], mass, link, place)
            else:
                tail, head = self._laid_off(one)
            force = Force(at, tail, head, one.name)
            self.forces.setdefault(one.link, []).append(force)
            self.given.append(Given(one, force, None))

    def _couple(self, masses: Mapping[str, Mass], one: Applied) -> NumberName:
        if one.kind is LoadKind.INERTIA_COUPLE and one.link in self.kin.epsilon:
            inertia = self.known("J", masses[one.link].inertia)
            turning = self.kin.epsilon[one.link]
            return self.draft.b.compute(self.name("M"), (inertia, 1), (turning, 1), factor=-1.0)
        (size,) = numbers_of(one)
        couple = self.known("M", size)
        if one.steady is None:
            self.changing.append((one.name, (couple,)))
        return couple

    def _mass(self, masses: Mapping[str, Mass], one: Applied) -> NumberName:
        return self.known("m", masses[one.link].mass)

    def _inertia(self, mass: NumberName, link: str, place: str) -> tuple[PointName, PointName]:
        """Carry the acceleration of the centre of mass over, turned back: Φ = -m·a."""
        motion, b = self.kin.acceleration, self.draft.b
        times = b.compute(
            self.name("k"), (mass, 1), (motion.scale, 1), (self.scale, -1), factor=-1.0
        )
        head = motion.point[link, place]
        return self.pole, b.carry(self.name("F"), self.pole, motion.pole, head, times, read=True)

    def _shifted(
        self, masses: Mapping[str, Mass], couple: Applied, mass: NumberName, link: str, place: str
    ) -> PointName:
        """Lay h = M_Φ/Φ off from the centre of mass, across its acceleration, and note the end."""
        motion, b, centre = self.kin.acceleration, self.draft.b, PointName(place)
        head = motion.point[link, place]
        moment = self._couple(masses, couple)
        read = b.measure(self.name("a"), motion.pole, head)
        force = ((mass, -1), (read, -1), (motion.scale, -1))
        length = b.compute(self.name("h"), (moment, 1), *force, (self.draft.mu_l, -1))
        # Φ is against the acceleration: to the left of that it turns as a positive M_Φ does.
        across = b.perpendicular(centre, b.join(motion.pole, head))
        at = b.lay_off(self.name("T"), centre, across, length)
        letter = free_letter("T", couple.link, self.draft.problem)
        self.shifts[couple.link] = Shift(letter, couple, moment, centre, at, length)
        return at

    def _laid_off(self, one: Applied) -> tuple[PointName, PointName]:
        turned, size = numbers_of(one)
        angle, newtons = self.known("angle", turned), self.known("F", size)
        if one.steady is None:
            self.changing.append((one.name, (angle, newtons)))
        b = self.draft.b
        line = b.at_angle(self.pole, None, angle)
        length = b.compute(self.name("l"), (newtons, 1), (self.scale, -1))
        return self.pole, b.lay_off(self.name("F"), self.pole, line, length)

    # Plans -----------------------------------------------------------------------------------

    def chain(self, start: PointName, link: str, into: list[Edge]) -> PointName:
        """Lay the forces on a link off one after another, and return where they end.

        The laid off edges are put ``into`` a list.
        """
        for force in self.forces.get(link, ()):
            end = self.draft.b.carry(self.name("c"), start, force.tail, force.head, read=force.read)
            into.append(Edge(force.symbol, link, force.at, start, end))
            start = end
        return start

    def back(self, end: PointName, link: str, into: list[Edge]) -> PointName:
        """Return where the forces on a link start that end in a point."""
        for force in self.forces.get(link, ()):
            start = self.draft.b.carry(self.name("c"), end, force.head, force.tail, read=force.read)
            into.insert(0, Edge(force.symbol, link, force.at, start, end))
            end = start
        return end

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
        """Return the moment of a force about a point, N·m; None of one that acts in the point."""
        if force.at == about:
            return None
        b = self.draft.b
        area = b.moment(self.name("h"), about, force.at, force.tail, force.head, read=force.read)
        return b.compute(self.name("M"), (area, 1), (self.scale, 1), (self.draft.mu_l, 1))

    def negative(self, number: NumberName) -> NumberName:
        """Return a number with the other sign."""
        return self.draft.b.compute(self.name("-"), (number, 1), factor=-1.0)

    def across(
        self,
        origin: PointName,
        line: LineName,
        moment: NumberName,
        arm: tuple[tuple[NumberName, int], ...],
    ) -> PointName:
        """Lay off a tangential component: a moment over an arm, across a line."""
        b = self.draft.b
        over = tuple((name, -power) for name, power in arm)
        length = b.compute(self.name("t"), (moment, 1), *over, (self.scale, -1))
        return b.lay_off(self.name("t"), origin, b.perpendicular(origin, line), length)

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
        """Note a reaction, and what it does to the link that exerts it.

        ``couple`` is about the place of ``force``. ``inner`` reactions act between links that are
        both done with.
        """
        force = replace(force, symbol=reaction_symbol(on, by), read=True)
        self.reactions.append(Reaction(joint, on, by, force, couple))
        if couple is not None:
            self.symbols[couple] = reaction_symbol(on, by, letter="M")
        if by != FRAME and not inner:
            self.forces.setdefault(by, []).append(force.reversed(reaction_symbol(by, on)))
            if couple is not None:
                opposite = self.negative(couple)
                self.symbols[opposite] = reaction_symbol(by, on, letter="M")
                self.couples.setdefault(by, []).append(opposite)

    def press(
        self, pin: str, on: str, by: str, force: Force, couple: NumberName, *, inner: bool = False
    ) -> CoupleOn:
        """Note the reaction of a guide: a force and its moment about the place of the force."""
        self.react(pin, on, by, force, couple, inner=inner)
        return CoupleOn(self.symbols[couple], on, couple, force.at)
