"""The two legs of every dyad (поводки), on the velocity and acceleration plans."""

from __future__ import annotations

from itertools import islice

from msgspec import Struct, field

from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import Draft
from planmethod.plans.model import (
    FACTS,
    ZERO_VECTOR,
    Direction,
    KnownParts,
    PlanKind,
    Relation,
    Segments,
    Vector,
    VectorEquation,
    VectorKind,
    perpendicular_to,
    pole_letter,
    towards,
)
from planmethod.problem.model import Problem, Slide

UNKNOWN_KINDS = (VectorKind.RELATIVE, VectorKind.SLIDING)
"""Components that end in a middle joint: from the pole they are its absolute vector as well."""


def letter(point: str) -> str:
    """Return the plan's letter of a mechanism point in rich text: B3 gives ``b_{3}``.

    A point P (or Π) would have the pole's letter: it keeps its own as an index, ``p_{P}``.
    """
    head, tail = point[:1].lower(), point[1:]
    if head in "pπ" and not tail:
        return f"{head}_{{{point}}}"
    return f"{head}_{{{tail}}}" if tail else head


def _number(vector: Vector) -> str:
    """Return the name of the number that a vector represents: ``v_CB``."""
    return vector.symbol.replace("^{", "").replace("_{", "_").replace("}", "")


class MotionBoard(Struct):
    """One plan being planned (план скоростей или ускорений в работе).

    Attributes
    ----------
    point : dict of (link, place) to PointName
        Plan point of a link's point; ``place`` names a point of the position plan.
    named : dict of str to (str, str)
        Published points: point name to (link, place).
    alias : set of (link, place)
        Points of a link that does not turn: they share the plan point of its first point.
    segments : Segments
        Their values are in m/s or m/s².
    moving : dict of link to list of str
        Places of a link that the plan has, in the order they came.
    usual : dict of PointName to str
        First letters of the points without those of the source, by which records know segments.
    """

    kind: PlanKind
    draft: Draft
    pole: PointName
    segments: Segments
    point: dict[tuple[str, str], PointName] = field(default_factory=dict)
    named: dict[str, tuple[str, str]] = field(default_factory=dict)
    moving: dict[str, list[str]] = field(default_factory=dict)
    alias: set[tuple[str, str]] = field(default_factory=set)
    letters: dict[PointName, list[str]] = field(default_factory=dict)
    usual: dict[PointName, str] = field(default_factory=dict)
    vectors: list[Vector] = field(default_factory=list)
    equations: list[VectorEquation] = field(default_factory=list)
    _drawn: dict[tuple[PointName, PointName], int] = field(default_factory=dict)
    _read: tuple[int, int] = (0, 0)  # vectors and names that have been read off

    @classmethod
    def start(cls, kind: PlanKind, draft: Draft) -> MotionBoard:
        """Put the pole down: the fixed points are there."""
        pole = draft.b.take_point(FACTS[kind].prefix + "0")
        draft.places[pole] = 0j
        motion = cls(kind, draft, pole, Segments(draft.b, draft.b.known(FACTS[kind].scale)))
        for point in draft.problem.bodies[FRAME].points:
            motion.add_point(FRAME, point, pole, show=bool(motion.sharers(point, FRAME)))
        return motion

    def name(self, point: str) -> str:
        """Return the plan's name of a point."""
        name = FACTS[self.kind].prefix + point
        self.draft.letters[PointName(name)] = point.lower()
        return name

    def sharers(self, point: str, link: str) -> list[str]:
        """Return the other links that a point is a revolute joint of."""
        return [other for other in self.draft.links_of.get(point, ()) if other != link]

    def add_point(
        self, link: str, place: str, at: PointName, *, name: str | None = None, show: bool = True
    ) -> PointName:
        """Note where a link's point is on the plan; a shared joint is noted for all its links."""
        name = name or place
        links = [link, *self.sharers(place, link)] if name == place else [link]
        for each in links:
            if (each, place) not in self.point:
                self.point[each, place] = at
                self.moving.setdefault(each, []).append(place)
        self.named.setdefault(name, (link, place))
        if show:
            shown = self.letters.setdefault(at, [])
            written = [self.written(name, each) for each in links]
            shown += [one for one in dict.fromkeys(map(letter, written)) if one not in shown]
            self.usual.setdefault(at, letter(name))
        return at

    def label(self, link: str, place: str) -> str:
        """Return the name of a link's point at a place: ``B3`` if it is under another's pin."""
        bodies = self.draft.problem.bodies
        if place in bodies[link].points or self.draft.is_special(link, place):
            return place
        name = f"{place}{link}"
        return f"{place}({link})" if name in self.draft.links_of else name

    def written(self, name: str, link: str = "") -> str:
        """Return the letter of a point: of a link's own, or by the name that quantities have."""
        problem = self.draft.problem
        own = {name: place for name, (place, of) in problem.letters.points.items() if of == link}
        return next(
            (one for one in own if problem.names_of_letters[one] == name), problem.lettered(name)
        )

    def direction_across(self, link: str, place: str, joint: str) -> Direction:
        """Return the direction across the arm of a link."""
        line_letter = self.draft.problem.letters.line_letter
        return perpendicular_to(place, joint).lettered(
            (line_letter(link, place), line_letter(link, joint))
        )

    def direction_inwards(self, link: str, place: str, joint: str) -> Direction:
        """Return the direction along the arm of a link to its joint."""
        line_letter = self.draft.problem.letters.line_letter
        return towards(place, joint).lettered((line_letter(link, place), line_letter(link, joint)))

    # Segments --------------------------------------------------------------------------------

    def size(self, of: tuple[str, str]) -> NumberName | None:
        """Return the number of the speed (acceleration) of a link's point; None for a fixed one."""
        at = self.point[of]
        return None if at == self.pole else self.segments.values[self.pole, at]

    def read_off(self) -> None:
        """Read every vector and every point that has not been read or laid off yet."""
        for vector in islice(self.vectors, self._read[0], None):
            self.segments.value(vector.tail, vector.head, _number(vector))
        for name, at in islice(self.named.items(), self._read[1], None):
            if self.point[at] != self.pole:
                number = f"{FACTS[self.kind].letter}_{name}"
                self.segments.value(self.pole, self.point[at], number)
        self._read = len(self.vectors), len(self.named)

    # Vectors ---------------------------------------------------------------------------------

    def add(self, vector: Vector) -> Vector:
        """Draw a vector once; a segment from the pole is the absolute vector of its end."""
        ends = (vector.tail, vector.head)
        drawn = self._drawn.get(ends)
        if drawn is None:
            if vector.tail != vector.head:
                self._drawn[ends] = len(self.vectors)
                self.vectors.append(vector)
        elif vector.kind is VectorKind.ABSOLUTE and self.vectors[drawn].kind in UNKNOWN_KINDS:
            self.vectors[drawn] = vector
        return vector

    def absolute(
        self, name: str, at: PointName, known: KnownParts = KnownParts.BOTH, link: str = ""
    ) -> Vector:
        """Return the vector of a point from the pole; ``link`` is whose letter it has."""
        direction = ZERO_VECTOR if at == self.pole else None
        symbol = f"{FACTS[self.kind].letter}_{{{self.written(name, link)}}}"
        return self.add(Vector(symbol, VectorKind.ABSOLUTE, self.pole, at, known, direction))


def plan_letter(motion: MotionBoard, point: PointName) -> str:
    """Return the letter of a plan point without markup: ``b3``, ``n_CB``, ``p``."""
    if point == motion.pole:
        return pole_letter(motion.draft.problem, motion.kind)
    first = motion.usual.get(point) or motion.letters.get(point, [str(point)])[0]
    head, brace, tail = first.partition("_{")
    if not brace:
        return first
    tail = tail.rstrip("}")
    return f"{head}_{tail}" if head in ("n", "k") else f"{head}{tail}"


class Ray(Struct, frozen=True):
    """Half of a vector equation: the start and direction of a leg's line on the plan (луч).

    Attributes
    ----------
    start : PointName
        Plan point from which the line of the unknown component is drawn.
    line : LineName
        That line.
    terms : tuple of Vector
        Terms of the equation laid off before the line.
    unknown : (symbol, VectorKind, Direction)
        Component found along the line.
    name : str
        Name of the number read along the line, signed along it.
    points : (str, str) or ()
        The two points of a link whose relative motion the component is.
    """

    start: PointName
    line: LineName
    terms: tuple[Vector, ...]
    unknown: tuple[str, VectorKind, Direction]
    name: str
    points: tuple[str, ...] = ()

    def close(self, motion: MotionBoard, head: PointName) -> Vector:
        """Return the unknown component, its end being found."""
        symbol, kind, direction = self.unknown
        ends = self.start, head
        return motion.add(Vector(symbol, kind, *ends, KnownParts.ONE, direction, self.points))


class Relative(Struct):
    """Motion of a point of one link relative to the coincident point of another.

    The velocity is from ``start`` to ``head`` on the velocity plan; on the acceleration plan the
    Coriolis component is from ``a_start`` to ``a_coriolis`` and the relative one from there to
    ``a_head``.
    """

    point: str
    of: str
    to: str
    speed: NumberName
    start: PointName
    head: PointName
    a_start: PointName | None = None
    a_coriolis: PointName | None = None
    a_head: PointName | None = None

    @property
    def name(self) -> str:
        """Name of the sliding that its quantities describe: ``B3/2``."""
        return f"{self.point}{self.of}/{self.to}"

    def label(self, letter: str) -> str:
        """Return the label of one of its quantities: ``v_B3/2``, ``ak_B3/2``."""
        return f"{letter}_{self.name}"


class Turning(Struct, frozen=True):
    """Segment of a plan from which a link's angular velocity or acceleration was read.

    ``arm`` are the factors of the length between the joint and the place, m.
    """

    start: PointName
    head: PointName
    joint: str
    place: str
    arm: tuple[tuple[NumberName, int], ...]


class Kinematics(Struct):
    """Angular motion of the links, shared by both plans (угловые скорости и ускорения).

    A link is in ``omega`` only when it turns; it is in ``epsilon`` only when its angular
    acceleration is not zero by nature (a crank at constant speed has none).
    """

    draft: Draft
    velocity: MotionBoard
    acceleration: MotionBoard
    omega: dict[str, NumberName] = field(default_factory=dict)
    epsilon: dict[str, NumberName] = field(default_factory=dict)
    relatives: dict[tuple[str, str, str], Relative] = field(default_factory=dict)
    turnings: dict[tuple[PlanKind, str], Turning] = field(default_factory=dict)

    def motion(self, kind: PlanKind) -> MotionBoard:
        """Return the velocity plan, or the acceleration plan if that is the kind."""
        return self.acceleration if kind is PlanKind.ACCELERATION else self.velocity

    def rates(self, kind: PlanKind) -> dict[str, NumberName]:
        """Return how fast the links turn by a plan: omega of velocities, epsilon of the others."""
        return self.omega if kind is PlanKind.VELOCITY else self.epsilon

    def note_common_rotation(self, link: str, with_link: str) -> None:
        """Note that a prismatic pair gives two links the same rotation."""
        for table in (self.omega, self.epsilon):
            if with_link in table:
                table[link] = table[with_link]


class Arm(Struct, frozen=True):
    """Segment of a link from a joint to a place, and how its length is known.

    ``length`` holds factors of a length in metres: a given ``l_BC``, or the millimetres read on the
    drawing times ``mu_l``.
    """

    line: LineName
    length: tuple[tuple[NumberName, int], ...]


def arm(draft: Draft, link: str, joint: str, place: str) -> Arm:
    """Return the arm of a link from one of its joints to a place on the drawing."""
    line = draft.b.join(PointName(joint), PointName(place))
    if {joint, place} <= set(draft.problem.bodies[link].points):
        return Arm(line, ((draft.length(link, joint, place), 1),))
    return Arm(line, ((draft.measured(joint, place), 1), (draft.mu_l, 1)))


def _inverse(powers: tuple[tuple[NumberName, int], ...]) -> tuple[tuple[NumberName, int], ...]:
    return tuple((name, -power) for name, power in powers)


def revolute_ray(
    kinematics: Kinematics, motion: MotionBoard, link: str, joint: str, place: str
) -> Ray:
    """Return the ray of a leg with a revolute outer joint (вращательный поводок).

    ``place`` is the middle point's place on the drawing.
    """
    b = kinematics.draft.b
    start = motion.point[link, joint]
    lever = arm(kinematics.draft, link, joint, place)
    name = motion.label(link, place)
    both, shown = f"{name}{joint}", f"{motion.written(name, link)}{motion.written(joint, link)}"
    terms: list[Vector] = [motion.absolute(joint, start, link=link)]
    points = name, joint
    if motion.kind is PlanKind.VELOCITY:
        line = b.perpendicular(start, lever.line)
        return Ray(
            start,
            line,
            tuple(terms),
            (f"v_{{{shown}}}", VectorKind.RELATIVE, motion.direction_across(link, place, joint)),
            f"v_{both}",
            points,
        )
    end = _normal(kinematics, motion, link, (joint, place), start, lever)
    symbol = f"a^{{n}}_{{{shown}}}"
    direction = motion.direction_inwards(link, place, joint)
    normal = Vector(symbol, VectorKind.NORMAL, start, end, KnownParts.BOTH, direction, points)
    terms.append(motion.add(normal))
    line = b.perpendicular(end, lever.line)
    across = motion.direction_across(link, place, joint)
    unknown = (f"a^{{τ}}_{{{shown}}}", VectorKind.TANGENTIAL, across)
    return Ray(end, line, tuple(terms), unknown, f"at_{both}", points)


def _normal(
    kinematics: Kinematics,
    motion: MotionBoard,
    link: str,
    ends: tuple[str, str],
    start: PointName,
    lever: Arm,
) -> PointName:
    """Lay off the normal component omega²·l from the place towards the joint."""
    b, (joint, place) = kinematics.draft.b, ends
    n = motion.name(f"n_{motion.label(link, place)}{joint}")
    inward = b.parallel(start, b.join(PointName(place), PointName(joint)))
    label = motion.label(link, place)
    value = motion.segments.compute(
        f"an_{label}{joint}", (kinematics.omega[link], 2), *lever.length
    )
    shown = f"{motion.written(label, link)}{motion.written(joint, link)}"
    motion.letters.setdefault(PointName(n), [f"n_{{{shown}}}"])
    motion.usual[PointName(n)] = f"n_{{{label}{joint}}}"
    return motion.segments.lay_off_vector(n, start, inward, value)


def slot_name(slide: Slide) -> str:
    """Return the name of a guide that joins no two letters, by its slider: ``n_{2}–n_{2}``."""
    return f"n_{{{slide.slider}}}–n_{{{slide.slider}}}"


def offset_name(slide: Slide, problem: Problem) -> str:
    """Return the name of a pin's distance from its guide: ``e_{C}``.

    A pin at distances from several guides has them by its sliders: ``e_{C2}``, ``e_{C3}``.
    """
    pins = [other.pin for other in problem.slides.values() if other.offset]
    return f"e_{{{slide.pin}{slide.slider if pins.count(slide.pin) > 1 else ''}}}"


def has_slot_name(slide: Slide, problem: Problem) -> bool:
    """Return whether a guide on a moving link joins no two letters: pin and point lie beside it.

    One that runs along or across the axis of its link is named by that.
    """
    told = slide.host == FRAME or slide.through is None or slide.towards is not None
    squared = problem.bodies[slide.host].axis is not None and slide.angle % 180 in (0, 90)
    return not told and bool(slide.offset) and not squared


def track_direction(slide: Slide, problem: Problem, *, perpendicular: bool = False) -> Direction:
    """Return the direction of a slide line: ``∥ x-x``, ``∥ CB``, or ``⊥ BC``.

    ``perpendicular`` asks for the direction across the line. A line on a moving link is named by
    its point and the pin when the pin is on it, else by the link's own axis where it runs along or
    across that, else by a name of its own.
    """
    along, beside = Relation.PARALLEL, Relation.PERPENDICULAR
    if perpendicular:
        along, beside = beside, along
    axis = problem.bodies[slide.host].axis
    if slide.host == FRAME or slide.through is None:
        return Direction(along, guide=problem.guide_name(slide.label))
    if slide.towards is not None and slide.offset:
        return Direction(along, (slide.through, slide.towards))
    if has_slot_name(slide, problem):
        return Direction(along, guide=slot_name(slide))
    if not slide.offset or axis is None:
        pin = problem.letters.line_letter(slide.host, slide.pin)
        return Direction(along, (slide.through, slide.pin)).lettered((slide.through, pin))
    return Direction(along if slide.angle % 180 == 0 else beside, axis)


def prismatic_ray(
    kinematics: Kinematics, motion: MotionBoard, slide: Slide, of: str, to: str, place: str
) -> Ray:
    """Return the ray of a link that slides on another (поступательный поводок).

    ``of`` is the link whose point is sought at ``place``, ``to`` the link it slides on.
    """
    b = kinematics.draft.b
    guide = kinematics.draft.direction(slide)
    start = plan_point_at(kinematics, motion, to, place)
    base = (
        motion.label(to, place)
        if to != FRAME
        else f"{place}{kinematics.draft.problem.mechanism.frame}"
    )
    if (to, place) in motion.alias:
        base = motion.moving[to][0]  # the whole link moves so: its first letter represents it
    name = motion.label(of, place)
    both, shown = f"{name}{base}", f"{motion.written(name, of)}{motion.written(base, to)}"
    problem = kinematics.draft.problem
    direction = track_direction(slide, problem)
    symbol = FACTS[motion.kind].letter
    terms: list[Vector] = [motion.absolute(base, start, link=to)]
    if motion.kind is PlanKind.VELOCITY:
        line = b.parallel(start, guide)
        unknown = (f"{symbol}_{{{shown}}}", VectorKind.SLIDING, direction)
        return Ray(start, line, tuple(terms), unknown, f"v_{place}{of}/{to}")
    relative = kinematics.relatives[place, of, to]
    relative.a_start = relative.a_coriolis = start
    end = start
    if to in kinematics.omega:
        corner = motion.name(f"k_{both}")
        powers = ((kinematics.omega[to], 1), (relative.speed, 1))
        # v_rel turned by 90 degrees along omega: the signs of both are in the product.
        value = motion.segments.compute(f"ak_{place}{of}/{to}", *powers, factor=2.0)
        end = motion.segments.lay_off_vector(corner, start, b.perpendicular(start, guide), value)
        relative.a_coriolis = end
        motion.letters.setdefault(end, [f"k_{{{shown}}}"])
        motion.usual[end] = f"k_{{{both}}}"
        turned = Vector(
            f"a^{{k}}_{{{shown}}}",
            VectorKind.CORIOLIS,
            start,
            end,
            KnownParts.BOTH,
            track_direction(slide, problem, perpendicular=True),
        )
        terms.append(motion.add(turned))
    line = b.parallel(end, guide)
    unknown = (f"a^{{r}}_{{{shown}}}", VectorKind.SLIDING, direction)
    return Ray(end, line, tuple(terms), unknown, f"ar_{place}{of}/{to}")


def close(
    kinematics: Kinematics,
    motion: MotionBoard,
    links: tuple[str, str],
    place: str,
    rays: tuple[Ray, Ray],
) -> PointName:
    """Intersect the rays of two legs: the plan point of the middle joint, and its equations."""
    owner = links[0]
    name = motion.label(owner, place)
    # The meeting is counted along the first line: from the pole, what moves along a guide of the
    # frame does so exactly.
    first, second = rays if rays[1].start != motion.pole else rays[::-1]
    head = kinematics.draft.b.intersect_lines(motion.name(name), first.line, second.line)
    motion.add_point(owner, place, head, name=name)
    for ray in rays:
        unknown = ray.close(motion, head)
        left = motion.absolute(name, head, KnownParts.NONE, owner)
        motion.equations.append(VectorEquation(left, (*ray.terms, unknown)))
    return head


def read_turning(
    kinematics: Kinematics, motion: MotionBoard, link: str, joint: str, place: str, ray: Ray
) -> None:
    """Read the angular velocity (or acceleration) of a link off its closed ray."""
    b = kinematics.draft.b
    head = motion.point[link, place]
    lever = arm(kinematics.draft, link, joint, place)
    kinematics.turnings[motion.kind, link] = Turning(ray.start, head, joint, place, lever.length)
    value = motion.segments.read_signed(ray.start, head, ray.line, ray.name)
    powers = ((value, 1), *_inverse(lever.length))
    if motion.kind is PlanKind.VELOCITY:
        kinematics.omega[link] = b.compute(f"omega_{link}", *powers)
    else:
        kinematics.epsilon[link] = b.compute(f"epsilon_{link}", *powers)


def read_sliding(
    kinematics: Kinematics, motion: MotionBoard, of: str, to: str, place: str, ray: Ray
) -> None:
    """Read the relative motion off a closed ray."""
    head = motion.point[of, place]
    value = motion.segments.read_signed(ray.start, head, ray.line, ray.name)
    if motion.kind is PlanKind.ACCELERATION:
        kinematics.relatives[place, of, to].a_head = head
        return
    kinematics.relatives[place, of, to] = Relative(place, of, to, value, ray.start, head)


def plan_point_at(kinematics: Kinematics, motion: MotionBoard, link: str, place: str) -> PointName:
    """Return the plan point of the point of a link that is at ``place`` on the drawing.

    By similarity from two known points; by turning about one known point when the link's angular
    velocity is known; at once when the link does not turn.
    """
    known = motion.point.get((link, place))
    if known is not None:
        return known
    if link == FRAME:
        return motion.pole
    body = kinematics.draft.problem.bodies[link].points
    here = motion.moving[link]
    if link not in kinematics.omega:
        at = motion.point[link, here[0]]
        motion.alias.add((link, place))
        return motion.add_point(link, place, at, name=motion.label(link, place), show=place in body)
    name = motion.label(link, place)
    pair = _spread(motion, link)
    if pair is not None:
        p, q = pair
        at = _similar(kinematics, motion, link, (p, q), place)
    else:
        at = rotate_about(kinematics, motion, link, here[0], place)
    return motion.add_point(link, place, at, name=name)


def _similar(
    kinematics: Kinematics, motion: MotionBoard, link: str, known: tuple[str, str], place: str
) -> PointName:
    """Find a point by similarity; its distances from the two known points are computed."""
    b, name, segments = kinematics.draft.b, motion.name(motion.label(link, place)), motion.segments
    one, two = motion.point[link, known[0]], motion.point[link, known[1]]
    side, span = segments.length(one, two), _on_drawing(kinematics.draft, link, *known)
    arm = _on_drawing(kinematics.draft, link, known[0], place)
    first = b.compute(f"|{name}|", (side, 1), (arm, 1), (span, -1))
    segments.lengths[one, PointName(name)] = first
    if not kinematics.draft.in_line(
        link, *known, place
    ):  # then the corner of a triangle, by two arcs
        other = _on_drawing(kinematics.draft, link, known[1], place)
        second = b.compute(f"|{name}|*", (side, 1), (other, 1), (span, -1))
        segments.lengths[two, PointName(name)] = second
    given = kinematics.draft.problem.bodies[link].points
    return b.similar(
        name,
        (one, two),
        (PointName(known[0]), PointName(known[1]), PointName(place)),
        side,
        span=None if set(known) <= set(given) else span,
        arm=None if {known[0], place} <= set(given) else arm,
    )


def _on_drawing(draft: Draft, link: str, p: str, q: str) -> NumberName:
    """Return the distance of two places of a link on the drawing, mm: given, or read."""
    if {p, q} <= set(draft.problem.bodies[link].points):
        return draft.drawn(draft.length(link, p, q))
    return draft.measured(p, q)


def _spread(motion: MotionBoard, link: str) -> tuple[str, str] | None:
    """Return two known places of a link far enough apart to compare by, the given ones first."""
    body = motion.draft.problem.bodies[link].points
    here = motion.moving[link]
    given = [place for place in here if place in body]
    pairs = [(p, q) for i, p in enumerate(given) for q in given[i + 1 :] if body[p] != body[q]]
    if pairs:
        return max(pairs, key=lambda pair: abs(body[pair[1]] - body[pair[0]]))
    found = [place for place in here if place not in body]
    return (given[0], found[0]) if given and found else None


def rotate_about(
    kinematics: Kinematics, motion: MotionBoard, link: str, joint: str, place: str
) -> PointName:
    """Lay off the motion of a place about a known point of a link whose turning is known."""
    b = kinematics.draft.b
    start = motion.point[link, joint]
    lever = arm(kinematics.draft, link, joint, place)
    label = motion.label(link, place)
    out = motion.name(label)
    fixed = start == motion.pole
    both = label if fixed else f"{label}{joint}"
    shown = motion.written(label, link) + ("" if fixed else motion.written(joint, link))
    terms = [] if fixed else [motion.absolute(joint, start, link=link)]
    if motion.kind is PlanKind.VELOCITY:
        value = motion.segments.compute(f"v_{both}", (kinematics.omega[link], 1), *lever.length)
        head = motion.segments.lay_off_vector(out, start, b.perpendicular(start, lever.line), value)
        direction = motion.direction_across(link, place, joint)
        kind = VectorKind.ABSOLUTE if fixed else VectorKind.RELATIVE
        turning = Vector(
            f"v_{{{shown}}}", kind, start, head, KnownParts.BOTH, direction, (label, joint)
        )
        last = motion.add(turning)
        if not fixed:
            left = motion.absolute(label, head, KnownParts.NONE, link)
            motion.equations.append(VectorEquation(left, (*terms, last)))
        return head
    if link in kinematics.epsilon:
        end = _normal(kinematics, motion, link, (joint, place), start, lever)
        value = motion.segments.compute(f"at_{both}", (kinematics.epsilon[link], 1), *lever.length)
        head = motion.segments.lay_off_vector(out, end, b.perpendicular(end, lever.line), value)
    else:
        inward = b.parallel(start, b.join(PointName(place), PointName(joint)))
        value = motion.segments.compute(f"an_{both}", (kinematics.omega[link], 2), *lever.length)
        head = end = motion.segments.lay_off_vector(out, start, inward, value)
    normal = Vector(
        f"a^{{n}}_{{{shown}}}",
        VectorKind.NORMAL,
        start,
        end,
        KnownParts.BOTH,
        motion.direction_inwards(link, place, joint),
        (label, joint),
    )
    if end != head or not fixed:
        terms.append(motion.add(normal))
    else:
        terms.append(normal)
    if end != head:
        symbol, direction = f"a^{{τ}}_{{{shown}}}", motion.direction_across(link, place, joint)
        tangential = Vector(
            symbol, VectorKind.TANGENTIAL, end, head, KnownParts.BOTH, direction, (label, joint)
        )
        terms.append(motion.add(tangential))
    left = motion.absolute(label, head, KnownParts.NONE, link)
    motion.equations.append(VectorEquation(left, tuple(terms)))
    return head
