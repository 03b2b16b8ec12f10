"""Force plans of a triad: moments about the special point give one reaction (метод Риттера).

The legs' own moments give the tangential components, as in a dyad. Two of the remaining reactions
act along lines through the special point: the moment of the whole group about it contains only the
third. Then one force plan of the group closes, and the legs' plans in it give the inner reactions.
"""

from __future__ import annotations

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.mechanism.groups import AssurGroup, Joint, OuterLeg, Triad
from planmethod.mechanism.model import Prismatic
from planmethod.plans.forces.board import (
    Force,
    ForceBoard,
    guide_edge,
    guide_reaction,
    of_guide,
    pressed_block,
)
from planmethod.plans.forces.polygons import (
    Balance,
    Components,
    CoupleOn,
    Edge,
    ForcePlan,
    Moments,
    as_known,
    back,
    reaction_edge,
    reaction_symbol,
)
from planmethod.plans.model import Ends, KnownParts
from planmethod.plans.motion.groups import leg_place
from planmethod.plans.motion.legs import arm, track_direction
from planmethod.plans.motion.position import outer_point, slide_of
from planmethod.problem.model import Slide


class _Leg(Struct):
    """A leg on its way through the force plan.

    Attributes
    ----------
    line : LineName
        Of the force by which it holds the base link.
    loads : list of Edge
        As they are laid off.
    parts, value : Components, NumberName
        Of a leg with two hinges, its outer reaction and the tangential share of that, N.
    passed : NumberName
        Moment that a sliding block passes on to the base link, N·m.
    tangent_ends, outer, inner : (PointName, PointName)
        Ends of that share, of the outer reaction and of the base link's reaction, on the leg.
    """

    board: ForceBoard
    outer_leg: OuterLeg
    joint: Joint
    line: LineName
    loads: list[Edge] = field(default_factory=list)
    parts: Components | None = None
    value: NumberName | None = None
    passed: NumberName | None = None
    tangent_ends: Ends = (PointName(""), PointName(""))
    outer: Ends = (PointName(""), PointName(""))
    inner: Ends = (PointName(""), PointName(""))

    @property
    def link(self) -> str:
        return self.outer_leg.link

    @property
    def place(self) -> PointName:
        """Place where the leg holds the base link."""
        return PointName(leg_place(self.outer_leg, self.joint))

    @property
    def is_sliding_block(self) -> bool:
        """True if it holds the base link by a guide."""
        return isinstance(self.joint, Prismatic)

    @property
    def slide(self) -> Slide:
        """The line of its prismatic pair."""
        return slide_of(
            self.board.draft, self.joint if self.is_sliding_block else self.outer_leg.joint
        )

    @property
    def slides(self) -> bool:
        """True if its outer joint is a guide."""
        return isinstance(self.outer_leg.joint, Prismatic)

    def weigh(self) -> None:
        """Find the tangential share: the moment of the loads about the inner joint."""
        if self.is_sliding_block or self.slides:
            return
        board, outer = self.board, outer_point(self.outer_leg)
        lever = arm(board.draft, self.link, outer, self.place)
        over = tuple((name, -power) for name, power in lever.length)
        moment = board.moment((self.link,), self.place)
        self.value = board.draft.b.compute(board.name("t"), (moment, 1), *over)
        by, ends = board.called(self.outer_leg.to), (outer, str(self.place))
        self.parts = Components(self.outer_leg, by, PointName(outer), ends, lever.length)

    def tangent(self, origin: PointName) -> PointName:
        """Lay the tangential share off; return its end."""
        if self.value is None or self.parts is None:
            return origin
        b = self.board.draft.b
        line = b.join(*map(PointName, self.parts.line))
        name, across = self.board.name("t"), b.perpendicular(origin, line)
        end = self.board.segments.lay_off_vector(name, origin, across, self.value)
        self.tangent_ends = (origin, end)
        return end

    def lay_off_known(self, start: PointName) -> tuple[PointName, PointName]:
        """Lay off known forces; return the end of the loads and the start of the unknown reaction.

        A sliding block passes the unknown reaction on unchanged: its loads are drawn beside it.
        """
        after = self.board.chain(start, self.link, self.loads)
        return after, start if self.is_sliding_block else self.tangent(after)

    def moments(self, about: PointName) -> list[NumberName | None]:
        """Return the moments of its known forces about the special point, N·m."""
        board, b = self.board, self.board.draft.b
        forces = board.forces.get(self.link, ())
        if (
            self.is_sliding_block
        ):  # it passes on its own moment, and a force through the special point
            self.passed = board.moment((self.link,), self.place)
            return [self.passed]
        if self.slides:  # the guide takes the moment of its loads, which therefore act in the hinge
            return [board.moment_of(replace(force, at=self.place), about) for force in forces]
        assert self.value is not None and self.parts is not None
        terms = [board.moment_of(force, about) for force in forces]
        terms += board.couples.get(self.link, ())
        away = b.measure_along(board.name("h"), about, self.parts.at, self.line)
        powers = ((self.value, 1), (away, 1), (board.draft.mu_l, 1))
        return [*terms, b.compute(board.name("M"), *powers)]

    def weighed(self, about: PointName) -> list[Edge]:
        """Return the links and point of these moments, with their arms measured."""
        if self.is_sliding_block:
            return []
        if self.slides:
            return [replace(edge, at=self.place) for edge in self.loads]
        assert self.value is not None and self.parts is not None
        board = self.board
        turned = board.draft.b.measure_arm(
            board.name("h"), about, self.parts.at, *self.tangent_ends
        )
        board.arms[about, self.parts.at, self.value] = turned
        return [*self.loads, self.tangential]

    @property
    def tangential(self) -> Edge:
        """The share that moments have found."""
        assert self.parts is not None
        return self.parts.tangential(*self.tangent_ends)

    def sides(self, normal: Ends) -> tuple[Edge, ...]:
        """Return the outer reaction in the plan; ``normal`` are the ends of the found component."""
        if self.parts is not None:
            return self.tangential, self.parts.normal(*normal)
        if self.slides:
            return (guide_edge(self.board, self.outer_leg, *self.outer),)
        by, at = self.board.called(self.outer_leg.to), self.place
        return (reaction_edge(self.link, by, at, *self.outer),)

    def inner_edge(self, base: str) -> Edge:
        """Return the base link's reaction on it."""
        direction = None
        if self.is_sliding_block:
            direction = track_direction(self.slide, self.board.draft.problem, perpendicular=True)
        return reaction_edge(self.link, base, self.place, *self.inner, direction)

    def react(self, base: str) -> tuple[Moments, CoupleOn | None]:
        """Note the reactions in both joints; return the moments of the leg, and of its guide."""
        board = self.board
        known = board.couples_on(self.link)
        inner, loads = self.inner_edge(base), self.loads
        if self.slides:
            outer, force = Force(self.place, *self.outer), self.inner_edge(base)
            guide = guide_reaction(board, self.outer_leg, outer, force)
            board.react(self.place, self.link, base, Force(self.place, *self.inner), inner=True)
            return of_guide(guide, [*loads, inner], known), guide
        at = PointName(outer_point(self.outer_leg))
        board.react(at, self.link, self.outer_leg.to, Force(at, *self.outer))
        if self.parts is not None:
            board.react(self.place, self.link, base, Force(self.place, *self.inner), inner=True)
            links, arm_of = (self.link,), self.parts.arm
            return Moments(
                links, self.place, tuple(loads), known, self.tangential, arm=arm_of
            ), None
        pressed = Force(at, *self.inner)
        if self.slide.slider == base:
            return pressed_block(board, self.slide, pressed.reversed(), loads), None
        couple = board.negative(board.moment((self.link,), at))
        held = board.react_guide(self.slide.pin, self.link, base, pressed, couple, inner=True)
        return of_guide(held, loads, known), None


def triad_forces(board: ForceBoard, group: AssurGroup, triad: Triad) -> None:
    """Find the reactions in all joints of a triad."""
    b, base, special = board.draft.b, triad.base, board.draft.special[triad.base]
    order = (*(k for k in range(3) if k != special.third), special.third)
    one, two, three = legs = tuple(_Leg(board, *triad.legs[k], special.lines[k]) for k in order)
    for leg in legs:
        leg.weigh()
    start = board.start()
    held, away = _ritter(board, base, legs, special.point)
    if one.is_sliding_block:
        first, after = board.back(start, one.link, one.loads), start
    else:
        first = one.tangent(start)
        after = board.chain(first, one.link, one.loads)
    own: list[Edge] = []
    based = board.chain(after, base, own)
    loaded, begin = three.lay_off_known(based)
    end = board.segments.lay_off_vector(board.name("n"), begin, b.parallel(begin, three.line), held)
    # A guide's whole reaction is this segment: the next step needs its size.
    for table in (board.segments.values, board.segments.lengths):
        table[begin, end] = b.compute(board.name("|n|"), (table[begin, end], 1), size=True)
    turned = b.measure_arm(board.name("h"), special.point, three.place, begin, end)
    board.arms[special.point, three.place, board.segments.values[begin, end]] = turned
    last, opened = two.lay_off_known(end)
    meeting = b.intersect_lines(
        board.name("x"), b.parallel(start, one.line), b.parallel(opened, two.line)
    )
    one.outer, one.inner = (meeting, first), (after, meeting)
    two.outer, two.inner = (last, meeting), (meeting, end)
    three.outer, three.inner = (loaded, end), (end, based)
    third = three.sides((begin, end))
    if not three.is_sliding_block:  # otherwise the plan of the sliding block finds it
        third = tuple(replace(edge, known=KnownParts.BOTH) for edge in third)
    sides = [one.sides((meeting, start))[::-1], two.sides((opened, meeting)), third]
    polygon = (
        *sides[0],
        *one.loads,
        *own,
        *three.loads,
        *sides[2],
        *two.loads,
        *sides[1],
    )
    inner = [leg.inner_edge(base) for leg in legs]
    found = sides[2][-1]
    if three.is_sliding_block:  # the laid-off force is the sliding block's force on the base link
        inner[2] = replace(back(inner[2], base), direction=inner[2].direction)
        found = inner[2]
    couples = board.couples_on(base, *(leg.link for leg in legs if leg.parts is not None))
    couples += tuple(
        CoupleOn(
            reaction_symbol(base, leg.link, letter="M"),
            base,
            leg.passed,
            leg.place,
        )
        for leg in legs
        if leg.passed is not None
    )
    known = board.couples_on(*group.links)
    weighed = tuple(edge for leg in legs for edge in leg.weighed(special.point))
    about_special = Moments(
        tuple(
            link
            for link in group.links
            if not any(leg.link == link and leg.is_sliding_block for leg in legs)
        ),
        special.point,
        (*weighed, *own),
        couples,
        replace(found, at=three.place),
        arm=((away, 1), (board.draft.mu_l, 1)),
    )
    wholes = tuple(leg.parts.total(*leg.outer) for leg in legs if leg.parts is not None)
    told = [leg.react(base) for leg in legs]
    shares = tuple(one for one, _ in told if one.force is not None)
    guides = tuple(one for one, _ in told if one.force is None)
    balances = [
        Balance((leg.link,), (*map(as_known, side), *leg.loads, leg.inner_edge(base)))
        for leg, side in zip(legs, sides, strict=True)
    ]
    if three.is_sliding_block:
        known_first = as_known(three.inner_edge(base)), *three.loads, *third
        balances = [Balance((three.link,), known_first), *balances[:2]]
    board.read_off(
        ForcePlan(
            group.links,
            polygon,
            wholes,
            tuple(inner),
            (Balance(group.links, polygon), *balances),
            (*shares, about_special, *guides),
            (*known, *(guide for _, guide in told if guide is not None)),
        )
    )


def _ritter(
    board: ForceBoard, base: str, legs: tuple[_Leg, ...], about: PointName
) -> tuple[NumberName, NumberName]:
    """Return the force along the last leg's line, N, and its distance from the special point, mm.

    The lines of the other legs go through the special point.
    """
    b, third = board.draft.b, legs[-1]
    terms: list[NumberName | None] = [
        board.moment_of(force, about) for force in board.forces.get(base, ())
    ]
    terms += board.couples.get(base, ())
    for leg in legs:
        terms += leg.moments(about)
    moment = b.total(board.name("M"), *(term for term in terms if term is not None))
    # Positive to the left of the line: there a force along it turns clockwise.
    across = b.perpendicular(about, third.line)
    away = b.measure_along(board.name("h"), about, third.place, across)
    value = b.compute(board.name("n"), (moment, 1), (away, -1), (board.draft.mu_l, -1))
    return value, away
