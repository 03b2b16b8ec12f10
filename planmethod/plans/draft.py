"""The drawing board while a construction is being planned: placed points and drawn lines."""

from __future__ import annotations

import cmath
import copy
import math
from typing import NamedTuple

from planmethod.construct.program import Builder
from planmethod.construct.steps import LineName, LineSense, Name, NumberName, PointName, Side
from planmethod.mechanism.model import FRAME
from planmethod.plans.columns import each, entries, largest
from planmethod.plans.model import (
    AssemblyMode,
    Choice,
    Dimension,
    DimensionKind,
    PlanKind,
    Start,
    Turns,
)
from planmethod.problem.model import Body, Problem, Slide
from planmethod.problem.names import angle_lines

TINY = 1e-12
"""Share of a link's size below which an offset is rounding, not a dimension."""

RIGHT = 1e-9
"""Degrees between an angle and a multiple of the right one that are rounding."""

FLAT = 0.1
"""Sine of the angle of a triangle below which its sides do not give its corner well."""

MAX_ORIGIN_DISTANCE = 10.0
"""Distance from the origin, in sizes of a mechanism, from which places are counted from its own."""


def degrees(angle: complex) -> float:
    """Return the argument of a direction in degrees, exact on the axes."""
    return each(_degrees, angle)


def _degrees(angle: complex) -> float:
    if angle.imag == 0:
        return 0.0 if angle.real > 0 else 180.0
    if angle.real == 0:
        return math.copysign(90.0, angle.imag)
    return math.degrees(cmath.phase(angle))


def cis(angle: float) -> complex:
    """Return exp(i·angle) of an angle in degrees, exact at the quadrants."""
    return each(_cis, angle)


def _cis(angle: float) -> complex:
    quadrant = round(angle / 90.0)
    rest = math.radians(angle - 90.0 * quadrant)
    return (1, 1j, -1, -1j)[quadrant % 4] * complex(math.cos(rest), math.sin(rest))


class Track(NamedTuple):
    """Straight line that a point follows on another body, and the point it was drawn from."""

    origin: PointName
    line: LineName


class Special(NamedTuple):
    """Special point of a base link (особая точка Ассура): where the lines of two legs meet.

    ``lines`` are those of the three legs, each with two points to be drawn through; ``third`` is
    the leg whose line does not go through it.
    """

    point: PointName
    lines: tuple[LineName, LineName, LineName]
    third: int


class GivenArm(NamedTuple):
    """Side of a given angle that a protractor lays off on a link (плечо под углом).

    From ``vertex`` to ``end``, ``angle`` degrees from the line of the points ``of``, counted
    counter-clockwise, in (-180, 180).
    """

    vertex: str
    end: str
    of: tuple[str, str]
    angle: float


class Draft:
    """State of a construction being planned (черновик построения).

    Points of the position plan carry the mechanism's own names, so a point shared by links is
    placed once. Given lengths are known in metres (``l_BC``) and computed to millimetres of the
    drawing (``|BC|``), as the textbook does.

    Attributes
    ----------
    numbers : dict
        Values of the Known numbers in their own units; the scales are added by the reading.
    places : dict
        Places of the Given points, m, counted from ``origin``.
    branches : dict
        Assembly modes by the known number that gives their side in each position, and triad
        assemblies by the numbers that locate them.
    origin : complex, m
        Zero, except for a mechanism far from the origin of its file: coordinates relative to its
        own origin keep the digits of its links.
    placed : dict of str to tuple of str
        Points of each link that the position plan has.
    marked : dict of str to None
        All of them, in the order in which they were placed.
    links_of : dict of str to list of str
        Links that have a point.
    axes : dict of str to LineName
        Own axis of a link whose direction is not given by two of its points.
    angles : dict of str to NumberName
        Angles of the own axes of wheels that meshes turn, counted on over whole turns, degrees.
    read : dict of (str, str) to None
        Distances that are read on the drawing because no length is given, in order.
    dimensions : dict of NumberName to Dimension
        Meaning of the known numbers of the data, and of the corresponding lengths on the drawing.
    feet : dict of PointName to str
        Feet of offsets, and the point that each is of.
    special : dict of str to Special
        Special point of a base link.
    plans : dict of Name to PlanKind
        Plan that a step belongs to.
    letters : dict of PointName to str
        Letters of points of the velocity and acceleration plans that are known beforehand.
    """

    def __init__(self, problem: Problem, choice: Choice) -> None:
        self.problem, self.choice = problem, choice
        self.b = Builder()
        self.numbers: dict[str, float] = {}
        self.places: dict[str, complex] = {}
        self.branches: dict[str, AssemblyMode | Start | Turns] = {}
        self.placed: dict[str, tuple[str, ...]] = {}
        self.marked: dict[str, None] = {}
        self.links_of = _links_of_points(problem)
        self.axes: dict[str, LineName] = {}
        self.angles: dict[str, NumberName] = {}
        self.mu_l = self.b.known("mu_l")
        self.origin = _origin(problem)
        self.read: dict[tuple[str, str], None] = {}
        self.laid_off: dict[tuple[str, str], NumberName] = {}  # radii to poles, mm
        self.dimensions: dict[NumberName, Dimension] = {}
        self._lengths: set[tuple[str, ...]] = set()  # given, as they are written
        self.feet: dict[PointName, str] = {}
        self.special: dict[str, Special] = {}
        self.plans: dict[Name, PlanKind] = {}
        self.letters: dict[PointName, str] = {}

    def copy(self) -> Draft:
        """Return an independent copy of the draft that continues from here."""
        other = copy.copy(self)
        other.b = self.b.copy()
        other.numbers, other.places = dict(self.numbers), dict(self.places)
        other.branches, other.letters = dict(self.branches), dict(self.letters)
        other.axes, other.plans, other.read = dict(self.axes), dict(self.plans), dict(self.read)
        other.laid_off = dict(self.laid_off)
        other.dimensions, other.feet = dict(self.dimensions), dict(self.feet)
        other.marked, other._lengths = dict(self.marked), set(self._lengths)
        other.special = dict(self.special)
        other.angles = dict(self.angles)
        other.placed = dict(self.placed)
        return other

    def of_variant(self, number: int, problem: Problem, choice: Choice) -> Draft:
        """Return the draft of one of the problems that were planned together, for reading.

        What is drawn is shared with the others: who continues takes a copy.
        """
        other = copy.copy(self)
        other.problem, other.choice = problem, choice
        other.numbers, other.places = entries(self.numbers, number), entries(self.places, number)
        return other

    def note_plan(self, kind: PlanKind, start: int) -> int:
        """Note the plan of the steps from a number on; return how many there are by now."""
        self.plans.update((step.out, kind) for step in self.b.steps[start:])
        return len(self.b.steps)

    # Numbers -------------------------------------------------------------------------------

    def known(self, name: str, value: float) -> NumberName:
        """Take a number of the data as known, once; another value gets another name."""
        return self.b.known_once(self.numbers, name, value)

    def dimension(self, kind: DimensionKind, value: float, *of: str, host: str = "") -> NumberName:
        """Take a dimension as known, m or degrees; ``host`` is the link it is counted from."""
        letters = "".join(of) + host
        whole = kind.value + letters
        name = self.known(whole, value)
        shown = letters if kind is DimensionKind.LENGTH else whole
        self.dimensions[name] = Dimension(kind, of, shown + name[len(whole) :])
        if kind is DimensionKind.LENGTH and name == whole:
            self._lengths.add(of)
        return name

    def has_length(self, p: str, q: str) -> bool:
        """Return whether the distance of two points is given, in this order."""
        return (p, q) in self._lengths

    def branch(self, point: str, mode: AssemblyMode) -> NumberName | None:
        """Return the number that gives a point's side in each position; None if it is fixed."""
        if not mode.changes:
            return None
        name = f"branch_{point}"
        self.branches[name] = mode
        return self.b.known(name)

    def length(self, link: str, p: str, q: str) -> NumberName:
        """Return the given distance of two points of a link, m."""
        points = self.problem.bodies[link].points
        if self.has_length(q, p):
            p, q = q, p
        return self.dimension(DimensionKind.LENGTH, abs(points[q] - points[p]), p, q)

    def measured(self, p: str, q: str) -> NumberName:
        """Return the distance of two places read on the drawing, mm."""
        p, q = sorted((p, q))
        if (p, q) in self.laid_off:
            return self.laid_off[p, q]
        if (p, q) in self.read:
            return self.measured_before(p, q)
        self.read[p, q] = None
        return self.b.measure(f"({p}{q})", PointName(p), PointName(q))

    def measured_before(self, p: str, q: str) -> NumberName:
        """Return the distance of two places that has been read."""
        p, q = sorted((p, q))
        return NumberName(f"({p}{q})")

    def segments(self) -> tuple[tuple[str, str], ...]:
        """Return the segments worth reading: given lengths, and distances that are not given."""
        pairs: list[tuple[str, str]] = []
        for link, body in self.problem.bodies.items():
            if link == FRAME:
                continue
            points = list(body.points)
            first = body.axis[0] if body.axis else points[0]
            pairs.extend((first, other) for other in points if other != first)
        pairs.extend(self.read)
        unique = {frozenset(pair): pair for pair in reversed(pairs)}
        return tuple(reversed(unique.values()))

    def drawn(self, metres: NumberName) -> NumberName:
        """Return a known length in millimetres of the drawing."""
        dimension = self.dimensions[metres]
        name = NumberName(f"|{dimension.letters}|")
        if name in self.dimensions:
            return name
        self.dimensions[name] = dimension
        return self.b.compute(name, (metres, 1), (self.mu_l, -1))

    def is_special(self, link: str, place: str) -> bool:
        """Return whether a place is the special point of a base link."""
        return link in self.special and self.special[link].point == place

    def size(self, link: str) -> float:
        """Return the extent of a link, m, with which offsets are compared."""
        points = list(self.problem.bodies[link].points.values())
        return largest([abs(p - points[0]) for p in points])

    # Points and lines of the position plan ---------------------------------------------------

    def mark_placed(self, point: str) -> PointName:
        """Note that the plan has a point: on every link that shares it."""
        for link in self.links_of.get(point, ()):
            here = self.placed.get(link, ())
            if point not in here:
                self.placed[link] = (*here, point)
                self.marked[point] = None
        return PointName(point)

    def points(self) -> set[str]:
        """Return the names of all points placed so far."""
        return set(self.marked)

    def line_at_angle(self, line: LineName, through: PointName, angle: float, of: str) -> LineName:
        """Return a line through a point at an angle (degrees) to another, that a link has."""
        if angle == 0:
            return self.b.parallel(through, line)
        if angle == 90:
            return self.b.perpendicular(through, line)
        return self.b.at_angle(through, line, self.dimension(DimensionKind.ANGLE, angle, of))

    def axis(self, link: str) -> LineName:
        """Return a line with the direction of a link's own axis."""
        if link in self.axes:
            return self.axes[link]
        points = self.problem.bodies[link].points
        p, q = self.reference(link)
        beta = degrees(points[q] - points[p])
        line = self.b.join(PointName(p), PointName(q))
        if beta != 0:
            line = (
                self.b.join(PointName(q), PointName(p))
                if abs(beta) == 180
                else self.line_at_angle(line, PointName(p), -beta, link)
            )
        self.axes[link] = line
        return line

    def reference(self, link: str) -> tuple[str, str]:
        """Return the two placed points of a link that determine its direction best."""
        body, here = self.problem.bodies[link], self.placed[link]
        if body.axis is not None and set(body.axis) <= set(here):
            return body.axis
        pairs = [(p, q) for i, p in enumerate(here) for q in here[i + 1 :]]
        return max(pairs, key=lambda pair: abs(body.points[pair[1]] - body.points[pair[0]]))

    def locate(self, link: str, point: str) -> PointName:
        """Place a point of a link whose direction is known, from its coordinates."""
        if point in self.placed.get(link, ()):
            return PointName(point)
        if (arm := self._arm(link, point)) is not None:
            return self._lay_off_arm(link, arm)
        if (known := self._corners(link, point)) is not None:
            return self._strike(link, point, known)
        body = self.problem.bodies[link]
        here = self.placed[link]
        if len(here) > 1 and any(body.points[p] != body.points[here[0]] for p in here):
            p, q = self.reference(link)
            unit = body.points[q] - body.points[p]
            unit /= abs(unit)
            line = self.b.join(PointName(p), PointName(q))
        else:
            p, unit, line = here[0], 1 + 0j, self.axis(link)
        w = (body.points[point] - body.points[p]) * unit.conjugate()
        return self.lay_off_coordinates(point, PointName(p), line, w, self.size(link))

    def lay_off_coordinates(
        self, point: str, origin: PointName, line: LineName, w: complex, size: float
    ) -> PointName:
        """Lay off ``w.real`` along a line and ``w.imag`` across it, m; note the point as placed."""
        across = abs(w.imag) > TINY * size
        at = origin
        if abs(w.real) > TINY * size or not across:
            length = self.drawn(
                self.dimension(DimensionKind.ALONG, w.real, point)
                if across or w.real < 0
                else self.dimension(DimensionKind.LENGTH, w.real, origin, point)
            )
            at = self.b.lay_off_length(
                self._name_foot(point) if across else point, origin, line, length
            )
        if across:
            length = self.drawn(self.dimension(DimensionKind.ACROSS, w.imag, point))
            at = self.b.lay_off_length(point, at, self.b.perpendicular(at, line), length)
        return self.mark_placed(point)

    def place_rest(self, link: str) -> None:
        """Place every point of a link that the plan does not have yet.

        The points from which an arm is laid off come before its end, in any order of the file.
        """
        body = self.problem.bodies[link]
        ends = {arm.end for arm in _arms(body)}
        ends |= {point for point, form in body.forms.items() if form.kind == "side"}
        while rest := [p for p in body.points if not self._has(link, p)]:
            ready = (p for p in rest if self._arm(link, p) or self._corners(link, p))
            plain = (p for p in rest if p not in ends)
            self.locate(link, next(ready, None) or next(plain, rest[0]))

    def _has(self, link: str, *points: str) -> bool:
        """Return whether the plan has points of a link."""
        return set(points) <= set(self.placed.get(link, ()))

    def _arm(self, link: str, point: str) -> GivenArm | None:
        """Return the arm that ends in a point, if it can be laid off by now."""
        arms = (arm for arm in _arms(self.problem.bodies[link]) if arm.end == point)
        return next((arm for arm in arms if self._has(link, arm.vertex, *arm.of)), None)

    def _corners(self, link: str, point: str) -> tuple[str, str] | None:
        """Return the corners of a triangle that give its third one by its sides, if they are there.

        Not of a flat one, in which the arcs only touch.
        """
        body = self.problem.bodies[link]
        for top, form in body.forms.items():
            if form.kind != "side" or point not in (corners := (*form.line, top)):
                continue
            p, q = (one for one in corners if one != point)
            span, side = (body.points[one] - body.points[p] for one in (q, point))
            aside = (side * span.conjugate()).imag
            if self._has(link, p, q) and abs(aside) > FLAT * abs(span) * abs(side):
                return p, q
        return None

    def _strike(self, link: str, point: str, known: tuple[str, str]) -> PointName:
        """Meet arcs with the sides of a triangle about two of its corners; note it as placed."""
        p, q = known
        points = self.problem.bodies[link].points
        aside = ((points[point] - points[p]) * (points[q] - points[p]).conjugate()).imag
        radii = [self.drawn(self.length(link, one, point)) for one in known]
        side = Side.LEFT if aside > 0 else Side.RIGHT
        self.b.intersect_circles(point, PointName(p), radii[0], PointName(q), radii[1], side)
        return self.mark_placed(point)

    def _lay_off_arm(self, link: str, arm: GivenArm) -> PointName:
        """Lay a length off at its given angle; note its end as placed."""
        vertex, (p, q) = PointName(arm.vertex), arm.of
        line = self.line_at_angle(
            self.b.join(PointName(p), PointName(q)), vertex, arm.angle, arm.end
        )
        length = self.drawn(self.length(link, arm.vertex, arm.end))
        self.b.lay_off_length(arm.end, vertex, line, length)
        return self.mark_placed(arm.end)

    def _name_foot(self, of: str) -> PointName:
        """Return the name of the next foot of an offset of a point."""
        foot = PointName(f"{of}~{len(self.feet) + 1}")
        self.feet[foot] = of
        return foot

    def in_line(self, link: str, *places: str) -> bool:
        """Return whether places of a link lie on one line in all positions of sliders on it."""
        body, lines = self.problem.bodies[link].points, []
        for place in places:
            if place in body:
                continue
            slides = (s for s in self.problem.slides.values() if (s.host, s.pin) == (link, place))
            slide = next(slides, None)
            if slide is None:
                return False
            along = cis(slide.angle)
            lines.append((slide.base + 1j * along * slide.offset, along))
        fixed = [body[place] for place in places if place in body]
        if not lines:
            far = max(fixed, key=lambda z: abs(z - fixed[0]))
            lines.append((fixed[0], far - fixed[0]))
        start, along = lines[0]
        off = [abs(((z - start) * along.conjugate()).imag) for z in fixed]
        return len(lines) == 1 and largest(off) <= TINY * self.size(link) * abs(along)

    # Slide lines -----------------------------------------------------------------------------

    def base(self, slide: Slide) -> PointName:
        """Return the plan's point that a slide line passes through."""
        if slide.through is not None:
            return self.locate(slide.host, slide.through)
        name = f"{slide.label}:0"
        if name not in self.places:
            self.places[name] = slide.base - self.origin
            return self.b.take_point(name)
        return PointName(name)

    def line(self, slide: Slide) -> LineName:
        """Return the directed slide line, its host being placed."""
        base = self.base(slide)
        if slide.host == FRAME:
            angle = self.dimension(DimensionKind.ANGLE, slide.angle, slide.label)
            return self.b.at_angle(base, None, angle)
        if slide.towards is not None:
            return self.b.join(base, self.locate(slide.host, slide.towards))
        from_x = self.angle_from_x(slide)
        if from_x is not None:
            angle = self.dimension(DimensionKind.ANGLE, from_x, slide.slider)
            return self.b.at_angle(base, None, angle)
        return self.line_at_angle(self.axis(slide.host), base, slide.angle, slide.slider)

    def angle_from_x(self, slide: Slide) -> float | None:
        """Return the angle of a slide line from +x where its host does not turn, degrees.

        The angle as the file gives it keeps digits that two angles in a row would lose. None where
        the host turns, or where set squares draw the line along or across the host's own.
        """
        if slide.angle % 90 == 0 or slide.towards is not None or slide.host == FRAME:
            return None
        angle, link = slide.angle, slide.host
        while link != FRAME:
            carrier = self.problem.slides.get(link)
            if carrier is None:
                return None
            angle, link = angle + carrier.angle, carrier.host
        return angle

    def path(self, slide: Slide, known: str, point: str) -> Track:
        """Return the line that a point of one body of a prismatic pair follows on the other.

        ``known`` is the body that the plan has; the pair may be written either way round.
        """
        if known == slide.host:
            base, line, other = self.base(slide), self.line(slide), slide.slider
            across = slide.offset + self.problem.bodies[other].points[point].imag
        else:
            base, other = PointName(slide.pin), slide.host
            line = self.b.parallel(base, self.axis(known))
            z = self.problem.bodies[other].points[point]
            across = ((z - slide.base) * cis(-slide.angle)).imag - slide.offset
        size = max(self.size(slide.slider), self.size(slide.host))
        if abs(across) <= TINY * size:
            return Track(base, line)
        length = self.drawn(self.dimension(DimensionKind.OFFSET, across, point, host=known))
        foot = self.b.lay_off_length(
            self._name_foot(point), base, self.b.perpendicular(base, line), length
        )
        return Track(foot, self.b.parallel(foot, line))

    def direction(self, slide: Slide) -> LineName:
        """Return a line along a slide line, whichever of its two bodies the plan placed first."""
        return self.axis(slide.slider) if slide.host != FRAME else self.line(slide)

    def turn_with(self, slide: Slide, known: str, at: PointName) -> None:
        """Note the direction of the body that a prismatic pair turns together with ``known``."""
        from_x = self.angle_from_x(slide)
        if known == slide.host and from_x is not None:
            angle = self.dimension(DimensionKind.ANGLE, from_x, slide.slider)
            self.axes[slide.slider] = self.b.at_angle(at, None, angle)
        elif known == slide.host:
            self.axes[slide.slider] = (
                self.b.parallel(at, self.line(slide))
                if known == FRAME or self.placed.get(known)
                else self.line_at_angle(self.axis(known), at, slide.angle, slide.slider)
            )
        else:
            self.axes[slide.host] = self.line_at_angle(
                self.axis(known), at, -slide.angle, slide.host
            )

    def transverse_offset(self, slide: Slide, host_point: str, slider_point: str) -> float:
        """Return the signed distance of the slider's point to the left of the host's point, m."""
        z_host = self.problem.bodies[slide.host].points[host_point]
        z_slider = self.problem.bodies[slide.slider].points[slider_point]
        value = slide.offset + z_slider.imag - ((z_host - slide.base) * cis(-slide.angle)).imag
        size = max(self.size(slide.host), self.size(slide.slider))
        return value if abs(value) > TINY * size else 0.0


def _arms(body: Body) -> list[GivenArm]:
    """Return the arms that a link's angles define, except those drawn with set squares."""
    told = [
        (form.line, (form.point, name))
        for name, form in body.forms.items()
        if form.kind == "vertex"
    ]
    told += [lines for letters in body.angles if (lines := angle_lines(letters)) is not None]
    found = []
    for one, two in told:
        for of, arm in ((one, two), (two, one)):
            for vertex, end in (arm, arm[::-1]):
                side, across = (body.points[b] - body.points[a] for a, b in (of, (vertex, end)))
                if end in of or not side or not across:
                    continue
                angle = round(degrees(across / side), 12)  # as it is given
                if abs((angle + 45.0) % 90.0 - 45.0) > RIGHT:
                    found.append(GivenArm(vertex, end, of, angle))
    return found


def _links_of_points(problem: Problem) -> dict[str, list[str]]:
    """Return the links that have a point, by its name."""
    found: dict[str, list[str]] = {}
    for link, body in problem.bodies.items():
        for point in body.points:
            found.setdefault(point, []).append(link)
    return found


def _origin(problem: Problem) -> complex:
    """Return the origin of coordinates: zero, or a fixed place of a mechanism far from it."""
    fixed = list(problem.bodies[FRAME].points.values())
    fixed += [slide.base for slide in problem.slides.values() if slide.host == FRAME]
    sizes = [abs(place - fixed[0]) for place in fixed] + [abs(m) for _, _, m in problem.lengths]
    return fixed[0] if abs(fixed[0]) > MAX_ORIGIN_DISTANCE * largest(sizes) else 0j


def side(sign: float) -> Side:
    """Return LEFT for a positive sign."""
    return Side.LEFT if sign > 0 else Side.RIGHT


def line_sense(sign: float) -> LineSense:
    """Return FORWARD for a positive sign."""
    return LineSense.FORWARD if sign > 0 else LineSense.BACKWARD
