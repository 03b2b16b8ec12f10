"""Links with the forces on them: the scheme, a structural group, the driver."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from itertools import combinations

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.forces.loads import force_symbol, shift_symbol
from planmethod.note.narrate.naming import point_name, spot_letters
from planmethod.note.numbers import Notation, half_up
from planmethod.plans.forces.polygons import Component, CoupleOn, Edge, Moments
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Slide
from planmethod.render.forces.arrows import (
    Acting,
    CoupleArc,
    ForceArm,
    arm_items,
    arms_of,
    couple_items,
    distance,
    force_items,
    lines_of,
    on_action,
    place_force_arrows,
)
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.pens import drawn_once
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label, Segment
from planmethod.render.labels.label_column import merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.scheme import Scheme
from planmethod.render.pictures.schemeview import axis_labels
from planmethod.render.pictures.wheels import pole_items, wheel_items
from planmethod.render.symbols import (
    DIMENSION,
    SIZES,
    angle_of,
    before_links,
    dimension,
    revolute,
    slider,
    unit,
)
from planmethod.render.symbols.marks import axis_line
from planmethod.solved.forces.reading import ForceReading, Guided, guides
from planmethod.solved.solution import Solution

SHIFT = "shift"
"""First word of the tags of the lines; the second is the letter of the point."""

_MIN_SHIFT = 0.3  # mm: a nearer point coincides with the centre of mass
_MIN_WITH_MARK = 6.0  # mm: a shorter shift has no room for the mark of its right angle
_CORNER = 2.0  # side of that mark, mm


class ShiftedForce(Struct, frozen=True):
    """Force moved off the centre of mass: its letter, its point's letter, both places, mm.

    ``text`` is the inscription of the line between them.
    """

    force: str
    letter: str
    centre: complex
    at: complex
    text: str = ""

    @property
    def is_visible(self) -> bool:
        """True if there is a line to be drawn."""
        return abs(self.at - self.centre) >= _MIN_SHIFT

    @property
    def line(self) -> Segment:
        """The line from the centre of mass to the point of the force."""
        return self.centre, self.at


def shifted_forces_on(
    reading: ForceReading, links: Iterable[str], notation: Notation
) -> list[ShiftedForce]:
    """Return the visible shifts on some links."""
    found = []
    for link in links:
        shift = reading.statics.board.shifts.get(link)
        if shift is not None:
            centre, at = reading.place(shift.centre), reading.place(shift.at)
            read = abs(reading.read_number(shift.length))
            length = f"{notation.number(f'{half_up(read, 1):.1f}')} {notation.units['mm']}"
            text = f"{shift_symbol(link)} = {length}"
            found.append(ShiftedForce(force_symbol(link), shift.letter, centre, at, text))
    return [one for one in found if one.is_visible]


def shift_items(
    shifted_forces: Iterable[ShiftedForce],
    placed: Sequence[tuple[Acting, Segment]],
    height: float,
    prefix: str,
) -> tuple[list[Item], list[Label]]:
    """Return the lines of shifts, the lines of action as far as the arrows, points and letters.

    ``placed`` are the arrows of the forces.
    """
    items: list[Item] = []
    labels: list[Label] = []
    for one in shifted_forces:
        tag = f"{SHIFT} {one.letter}"
        items += [Stroke(one.line, Pen.THIN, tag=tag), Disc(one.at, 0.8, Ink.BLACK, tag=tag)]
        for force, arrow in placed:
            if force.symbol == one.force:
                ends = on_action(force, arrow)
                items += _line_of_action(one, min(ends, key=lambda end: abs(end - one.at)))
        labels += _letters(one, height, prefix)
    return items, labels


def _line_of_action(one: ShiftedForce, end: complex) -> list[Item]:
    """Return the line from the point of a force to its arrow, square to the shift."""
    along, back = end - one.at, one.centre - one.at
    items: list[Item] = [Stroke((one.at, end), Pen.THIN, tag="line of action")]
    if abs(back) >= _MIN_WITH_MARK:
        a, b = _CORNER * unit(along), _CORNER * unit(back)
        corner = (one.at + a, one.at + a + b, one.at + b)
        items.append(Stroke(corner, Pen.THIN, tag="right angle"))
    return items


def _letters(one: ShiftedForce, height: float, prefix: str) -> list[Label]:
    """Return the labels of the point and of the shift."""
    labels = [
        Label(
            typeset(one.letter, height),
            one.at,
            prefer=one.at - one.centre,
            gap=1.5,
            name=f"{prefix}: point {one.letter}",
            priority=2,
            style=BUSY,
        )
    ]
    if one.text:
        labels.append(
            Label(
                typeset(one.text, height),
                (one.centre + one.at) / 2,
                one.line,
                gap=1.0,
                name=f"{prefix}: {one.text}",
                style=BUSY,
            )
        )
    return labels


MAX_DISTANCE = 45.0
"""Distance from its joint up to which a reaction is drawn where it acts, mm."""

POINT = "point of a reaction"
"""Tag of the disc at such a place."""

_SHORTEST = 8.0  # of a slider that is drawn to scale, mm
_MIN_DIMENSION = 1.5  # mm: a distance below it is not dimensioned
_LEVELS = (9.0, 14.0, 19.0, 25.0, 31.0)  # from the guide to a dimension line, mm
_CLEAR = 2.5  # mm: a closer dimension line crowds a line of the drawing


def drawn_length(solution: Solution, slide: Slide, factor: float) -> float:
    """Return the drawn length of a slider, mm: to scale if it looks like one, else the symbol's."""
    if slide.length is not None:
        true = slide.length / solution.scales[PlanKind.POSITION].per_mm
        if _SHORTEST <= true <= 2 * MAX_DISTANCE:
            return true
    return SIZES.slider_length * factor


class DimensionSpan(Struct, frozen=True):
    """Distance to be dimensioned: its letter, and its ends on the guide, mm."""

    symbol: str
    start: complex
    end: complex


class Pressed(Struct, frozen=True):
    """Reaction of a guide as it is drawn, in place of a force at the joint and a couple.

    Attributes
    ----------
    replaced : frozenset of str
        Letters of the force and of the couple.
    forces : tuple of Acting
    points : tuple of complex, mm
        Where they act.
    span : DimensionSpan or None
    """

    replaced: frozenset[str]
    forces: tuple[Acting, ...]
    points: tuple[complex, ...]
    span: DimensionSpan | None


def pressed(
    reading: ForceReading, links: Collection[str], bars: Sequence[Segment], factor: float
) -> list[Pressed]:
    """Return the reactions of the guides, on links cut free, that do not act in their joints.

    A reaction that acts too far away to be drawn there is left out, and so is a couple whose slider
    has no known edges: both stay a force and a couple.
    """
    found = []
    for guided in guides(reading).values():
        if guided.on in links and guided.by not in links and not guided.is_no_couple:
            one = _at_edges(guided, factor) or _at_point(guided, bars, factor)
            found += [] if one is None else [one]
    return found


def _origin(guided: Guided) -> complex:
    """Return the place from which distances along the guide count, mm.

    A slider is drawn at its pin; on the link that carries the line, at the foot of the pin.
    """
    reading, contact = guided.reading, guided.contact
    place = reading.place(guided.reaction.force.at)
    if guided.on == contact.slide.slider:
        return place
    line = complex(contact.direction[reading.index])
    arm = complex(contact.joint.at[reading.index] - contact.base[reading.index])
    off = (arm * line.conjugate()).imag / _per_mm(guided)
    return place - 1j * line * off


def _per_mm(guided: Guided) -> float:
    return guided.reading.solution.scales[PlanKind.POSITION].per_mm


def _replaced(guided: Guided) -> frozenset[str]:
    return frozenset(guided.symbol(letter) for letter in "FM")


def _face(factor: float) -> float:
    """Return the white between a place on the guide and an arrow at the face of the slider, mm."""
    return SIZES.slider_width / 2 * factor + 0.5


def _at_edges(guided: Guided, factor: float) -> Pressed | None:
    edges = guided.edges
    if not edges:
        return None
    reading, contact = guided.reading, guided.contact
    along = complex(contact.direction[reading.index])
    middle = float(contact.middle[reading.index]) / _per_mm(guided)
    half = drawn_length(reading.solution, contact.slide, factor) / 2
    places = tuple(_origin(guided) + along * (middle + side * half) for side in (1, -1))
    forces = tuple(
        Acting(guided.symbol("F", primes), place, edge.force, gap=_face(factor))
        for primes, place, edge in zip(("'", "''"), places, edges, strict=True)
    )
    span = DimensionSpan(guided.as_planned.symbol("a"), places[1], places[0])
    return Pressed(_replaced(guided), forces, places, span)


def _at_point(guided: Guided, bars: Sequence[Segment], factor: float) -> Pressed | None:
    if guided.b is None:
        return None
    reading, contact = guided.reading, guided.contact
    origin = _origin(guided)
    shift = guided.b / _per_mm(guided)
    place = origin + complex(contact.direction[reading.index]) * shift
    if abs(shift) > MAX_DISTANCE and all(distance(place, bar) > 1.0 for bar in bars):
        return None
    force = guided.sense * complex(contact.joint.force[reading.index])
    acting = Acting(guided.symbol("F"), place, force, gap=_face(factor))
    span = (
        DimensionSpan(guided.as_planned.symbol("l"), origin, place)
        if abs(shift) >= _MIN_DIMENSION
        else None
    )
    return Pressed(_replaced(guided), (acting,), (place,), span)


# Dimensions --------------------------------------------------------------------------------------


def point_items(ones: Iterable[Pressed], factor: float) -> list[Item]:
    """Return the marks where reactions act."""
    return [Disc(place, 0.7 * factor, Ink.BLACK, tag=POINT) for one in ones for place in one.points]


def span_dimension(
    span: DimensionSpan, lines: Sequence[Segment], height: float, prefix: str
) -> tuple[list[Item], Label]:
    """Return a dimension along a guide on its freer side, and its letter (размер).

    Parameters
    ----------
    lines : sequence of Segment
        Lines already drawn, which the dimension keeps clear of.
    """
    along = unit(span.end - span.start)
    out = min(
        (side * 1j * along * level for level in _LEVELS for side in (1, -1)),
        key=lambda out: _dimension_cost(span, out, lines),
    )
    start, end = span.start + out, span.end + out
    tag = f"{DIMENSION} {span.symbol}"
    items = dimension(span.start, span.end, out, gap=_face(1.0), tag=tag)
    label = Label(
        typeset(span.symbol, height),
        (start + end) / 2,
        (start, end),
        prefer=out,
        gap=0.8,
        priority=2,
        name=f"{prefix}: {tag}",
    )
    return items, label


def _dimension_cost(span: DimensionSpan, out: complex, lines: Iterable[Segment]) -> float:
    """Return the cost of a dimension line among other lines; a nearer one costs less."""
    start, end = span.start + out, span.end + out
    places = [start + (end - start) * k / 6 for k in range(-2, 9)]
    places += [foot + out * k / 4 for foot in (span.start, span.end) for k in (2, 3, 4)]
    near = sum(min(distance(p, line) for line in lines) < _CLEAR for p in places) if lines else 0
    return near + 0.1 * abs(out)


_AXIS = 26.0
"""Length of a cut guide's axis to both sides of the slider's pin, before ``factor``, mm."""

_AXIS_EXTENSION = 10.0
"""Least length of it beyond the slider, mm."""

_POINT_EXTENSION = 5.0
"""Length of it beyond the place of a reaction, mm."""


class FreeBodyScheme(Scheme):
    """Some links of a mechanism in one position, cut free from the others (группа отдельно).

    The axis of a cut guide goes at least ``reach`` mm to both sides of the slider's pin.
    """

    links: tuple[str, ...] = field(default=())
    reach: float = 0.0

    def draw(self) -> None:
        """Draw the links and their halves of the pairs that were cut."""
        problem = self.solution.problem
        self.guides += wheel_items(self, self.links)
        for link in self.links:
            self.draw_link(link)
        slides = sorted(problem.slides.values(), key=lambda slide: slide.host != FRAME)
        for slide in slides:
            ends = (slide.slider in self.links, slide.host in self.links)
            if all(ends):
                self.draw_slider(slide)
            elif any(ends):
                self._cut_slide(slide, slider_is_here=ends[0])

    def _cut_slide(self, slide: Slide, *, slider_is_here: bool) -> None:
        """Draw one half of a prismatic pair: the block, or the bar without a block."""
        u, pin = self.line_direction(slide), self.at(slide.pin)
        block = self.solution.problem.is_block(slide)
        if block and not slider_is_here:
            self.slider_items += self._body(slide, self.base(slide))
            return
        if block:
            self.bar(slide.slider, pin, self.base(slide))
        elif slider_is_here:
            half = drawn_length(self.solution, slide, self.factor) / 2
            edge = half * u
            reach = max(_AXIS * self.factor, half + _AXIS_EXTENSION, self.reach) * u
            for side in (-1, 1):
                self.guides += axis_line(pin + side * edge, pin + side * reach, tag="guide")
            name = self.solution.problem.guide_name(slide.label)
            self.axis_ends.append((name, pin - reach, pin + reach))
            self._name_slot(slide, pin - reach, pin + reach)
            self.slider_items += self._body(slide, pin)

    def _body(self, slide: Slide, middle: complex) -> list[Item]:
        """Return the slider of a cut pair, in its true length where that can be drawn."""
        length = drawn_length(self.solution, slide, self.factor) / self.factor
        angle = angle_of(self.line_direction(slide))
        return slider(middle, angle=angle, length=length, factor=self.factor, pen=self.pen)

    def draw_joints(self) -> None:
        """Draw joints without the frame, and the other points of the links."""
        named: set[str] = set()
        self.mark_bends(self.links)
        for joint in self.solution.problem.mechanism.revolutes:
            here = [link for link in joint.links if link in self.links]
            if here:
                place, count = self.at(joint.point), max(1, len(here) - 1)
                self.joints += revolute(place, count=count, factor=self.factor)
                for link in here:
                    self.joints += self.pieces_over(link, place)
                named.add(joint.point)
        for link in self.links:
            for point in self.solution.problem.bodies[link].points:
                if point not in named:
                    self.joints += self.mark(point)
                    named.add(point)
        for pole, dot in pole_items(self, self.links).items():
            self.joints += dot
            named.add(pole)
        self.named = sorted(named)


def drawn_items(scheme: Scheme) -> list[Item]:
    """Return the links of a scheme, drawn."""
    scheme.draw()
    scheme.draw_joints()
    return [
        *scheme.guides,
        *before_links([*scheme.slider_items, *scheme.lines, *scheme.corners, *scheme.joints]),
    ]


def letters_of(scheme: Scheme, prefix: str, links: Iterable[str]) -> list[Label]:
    """Return the letters of the points, one for points that coincide, and the links' numbers."""
    height = scheme.letter_height
    spots = merge_letters(
        (scheme.at(point), [spot_letters(scheme.solution.problem, point, tuple(links))])
        for point in scheme.named
    )
    gap = SIZES.joint / 2 * scheme.factor + 1.0
    labels = []
    for place, names in spots:
        lines = scheme.directions(place)
        prefer = -sum(lines, 0j) if lines else 1 + 1j
        name = f"{prefix}: point {names[0]}"
        inscription = typeset(", ".join(names), height)
        labels.append(Label(inscription, place, prefer=prefer, gap=gap, name=name))
    return [*labels, *(scheme.link_label(link, SIZES.slider_width * 0.6) for link in links)]


class _DrawnLoads(Struct, frozen=True):
    """Loads as they are drawn on a scheme.

    Attributes
    ----------
    guided : sequence of Pressed
        Reactions of guides.
    arms : sequence of ForceArm
        Arms of the forces about the centres of moments.
    special : sequence of (str, complex)
        Letters and places, mm, of special points among these centres.
    """

    forces: Sequence[Acting]
    couples: Sequence[CoupleArc]
    shifted_forces: Sequence[ShiftedForce]
    guided: Sequence[Pressed] = ()
    arms: Sequence[ForceArm] = ()
    special: Sequence[tuple[str, complex]] = ()


def _loaded_picture(
    scheme: Scheme, links: Iterable[str], loads: _DrawnLoads, prefix: str, notation: Notation
) -> Picture:
    guided, shifted_forces = loads.guided, loads.shifted_forces
    items = [*drawn_items(scheme), *point_items(guided, scheme.factor)]
    items += [Disc(place, 0.8 * scheme.factor, Ink.BLACK) for _, place in loads.special]
    bars = [part for parts in scheme.segments.values() for part in parts]
    bars += [shift.line for shift in shifted_forces]
    joints = [scheme.at(point) for point in scheme.named]
    gap = SIZES.joint / 2 * scheme.factor + 0.5
    placed = place_force_arrows(loads.forces, bars, joints, gap=gap)
    arrows, labels = force_items(placed, scheme.letter_height, prefix)
    lines, letters = shift_items(shifted_forces, placed, scheme.letter_height, prefix)
    measured, sizes = arm_items(loads.arms, placed, scheme.letter_height, prefix, notation)
    items += [*lines, *measured, *arrows]
    turns, more = couple_items(loads.couples, items, scheme.letter_height, prefix)
    items += turns
    labels += sizes
    for span in (one.span for one in guided if one.span is not None):
        drawn, letter = span_dimension(span, list(lines_of(items)), scheme.letter_height, prefix)
        items += drawn
        labels.append(letter)
    labels += [
        Label(typeset(name, scheme.letter_height), place, gap=1.5) for name, place in loads.special
    ]
    axes = (replace(label, optional=True) for label in axis_labels(scheme))
    return lettered(items, [*labels, *more, *letters, *letters_of(scheme, prefix, links), *axes])


@drawn_once
def loads_picture(reading: ForceReading, letter_height: float, notation: Notation) -> Picture:
    """Return the whole scheme with the weights, inertia forces and couples, external loads, mm."""
    solution, index = reading.solution, reading.index
    scheme = Scheme(solution, index, letter_height)
    forces, couples = [], []
    for given in reading.statics.board.given:
        one = given.applied
        if given.force is not None:
            force = complex(one.force[index])
            if abs(force) > 1e-9 * reading.peak:
                forces.append(Acting(one.name, reading.place(given.force.at), force))
        elif given.couple is not None:
            couple = CoupleOn(one.name, one.link, given.couple)
            if not reading.is_no_couple(couple):
                couples.append(turning(reading, scheme, couple, notation))
    links = solution.problem.mechanism.links
    loads = _DrawnLoads(forces, couples, shifted_forces_on(reading, links, notation))
    return _loaded_picture(scheme, links, loads, f"loads {index}", notation)


@drawn_once
def cut_picture(
    reading: ForceReading, number: int, letter_height: float, notation: Notation
) -> Picture:
    """Return the links of a force plan cut free, with all forces on them, mm."""
    plan = reading.plans[number]
    scheme = FreeBodyScheme(reading.solution, reading.index, letter_height, links=plan.links)
    prefix = f"cut {reading.index} {number}"
    acting = _ActingOn(reading.shown(plan), reading.couples(plan), plan.moments)
    return _cut(reading, scheme, acting, prefix, notation)


@drawn_once
def inner_picture(
    reading: ForceReading, number: int, letter_height: float, notation: Notation
) -> tuple[str, Picture] | None:
    """Return a link of a dyad cut free at its inner guide too, and its picture, mm.

    None where the plan has no inner guide, or its reaction acts in the joint.
    """
    guided = _inner_guide(reading, number)
    if guided is None or guided.is_no_couple:
        return None
    return guided.on, link_picture(reading, number, guided.on, letter_height, notation)


def _inner_guide(reading: ForceReading, number: int) -> Guided | None:
    """Return the reaction of the guide between the links of a dyad, if it has one."""
    links = {*reading.plans[number].links}
    inner = (g for g in guides(reading).values() if g.sense > 0 and {g.on, g.by} <= links)
    return next(inner, None)


@drawn_once
def link_picture(
    reading: ForceReading, number: int, link: str, letter_height: float, notation: Notation
) -> Picture:
    """Return a link of a group cut free in its inner joint, too, mm."""
    plan, guided = reading.plans[number], _inner_guide(reading, number)
    (balance,) = (one for one in plan.balances if one.links == (link,))
    edges = [edge for edge in balance.edges if not reading.is_negligible(edge)]
    couples = [couple for couple in reading.couples(plan) if couple.on == link]
    if guided is not None and guided.on == link and not guided.is_no_couple:
        reaction = guided.reaction
        assert reaction.couple is not None
        couples.append(CoupleOn(guided.symbol("M"), link, reaction.couple, reaction.force.at))
    scheme = FreeBodyScheme(reading.solution, reading.index, letter_height, links=(link,))
    prefix = f"link {reading.index} {link}"
    return _cut(reading, scheme, _ActingOn(edges, couples), prefix, notation)


class _ActingOn(Struct, frozen=True):
    """Forces and couples on links cut free, and the equations of moments about their points."""

    edges: Sequence[Edge]
    couples: Sequence[CoupleOn]
    equations: Sequence[Moments] = ()


def _cut(
    reading: ForceReading,
    scheme: FreeBodyScheme,
    acting: _ActingOn,
    prefix: str,
    notation: Notation,
) -> Picture:
    guided = pressed(reading, scheme.links, _link_lines(reading, scheme.links), scheme.factor)
    # The axis of a guide reaches the place of its reaction; a link that does so needs no axis.
    spans = [abs(one.span.end - one.span.start) for one in guided if one.span is not None]
    scheme.reach = max(
        (span + _POINT_EXTENSION for span in spans if span <= MAX_DISTANCE), default=0.0
    )
    replaced = {symbol for one in guided for symbol in one.replaced}
    # Components of reactions first, for their places are fixed: across or along the link, at its
    # end.
    shown = sorted(acting.edges, key=lambda edge: edge.component is Component.TOTAL)
    forces = [force for one in guided for force in one.forces]
    forces += [
        Acting(notation.symbol(edge.symbol), reading.place(edge.at), reading.drawn_direction(edge))
        for edge in shown
        if edge.symbol not in replaced
    ]
    turnings = [
        turning(reading, scheme, one, notation)
        for one in acting.couples
        if one.symbol not in replaced
    ]
    shifted_forces = shifted_forces_on(reading, scheme.links, notation)
    equations = acting.equations
    arms = [arm for arm in arms_of(reading, equations, notation) if arm.symbol not in replaced]
    points = {one.point for one in reading.solution.construction.draft.special.values()}
    special = [
        (point_name(one.about), reading.place(one.about))
        for one in equations
        if one.about in points
    ]
    loads = _DrawnLoads(forces, turnings, shifted_forces, guided, arms, special)
    return _loaded_picture(scheme, scheme.links, loads, prefix, notation)


def _link_lines(reading: ForceReading, links: Iterable[str]) -> list[Segment]:
    """Return the lines of links between any two of their points, mm."""
    bodies = reading.solution.problem.bodies
    places = [[reading.place(PointName(p)) for p in bodies[link].points] for link in links]
    return [pair for ends in places for pair in combinations(ends, 2)]


def turning(
    reading: ForceReading, scheme: Scheme, couple: CoupleOn, notation: Notation
) -> CoupleArc:
    """Return the arc of a couple: about its own place, otherwise about the centre of mass."""
    sense, symbol = 1 if reading.number(couple.moment) > 0 else -1, notation.symbol(couple.symbol)
    if couple.at is not None:
        return CoupleArc(symbol, reading.place(couple.at), sense)
    problem = scheme.solution.problem
    mass = problem.dynamics.masses.get(couple.on) if problem.dynamics is not None else None
    points = list(problem.bodies[couple.on].points)
    places = [scheme.at(point) for point in points]
    if mass is not None and mass.centre in points and couple.symbol.startswith("M_{Φ"):
        return CoupleArc(symbol, scheme.at(mass.centre), sense)
    return CoupleArc(symbol, sum(places) / len(places), sense)
