"""Links with the forces on them: the scheme, a structural group, the driver (схемы нагружения).

A group is cut free at its outer joints: there reactions replace the links that were cut away.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations

from msgspec import field
from msgspec.structs import replace

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.statement import point_name
from planmethod.note.numbers import Notation
from planmethod.plans.forces.polygons import Component, CoupleOn, Edge, Moments
from planmethod.problem.model import Slide
from planmethod.render.forces.arms import ForceArm, arm_items, arms_of
from planmethod.render.forces.arrows import (
    Acting,
    CoupleArc,
    Segment,
    couple_items,
    force_items,
    lines_of,
    place_force_arrows,
)
from planmethod.render.forces.guides import (
    MAX_DISTANCE,
    Pressed,
    drawn_length,
    point_items,
    pressed,
    span_dimension,
)
from planmethod.render.forces.shifts import ShiftedForce, shift_items, shifted_forces_on
from planmethod.render.ink.drawing import Disc, Ink, Item
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.labels.merged_labels import merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.scheme import Scheme
from planmethod.render.pictures.schemeview import axis_labels
from planmethod.render.symbols import SIZES, angle_of, before_links, revolute, slider
from planmethod.render.symbols.axes import axis_line
from planmethod.solved.forces.guides import guides
from planmethod.solved.forces.reading import ForceReading
from planmethod.solved.reading import memoized

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
        for joint in self.solution.problem.mechanism.revolutes:
            here = [link for link in joint.links if link in self.links]
            if here:
                count = max(1, len(here) - 1)
                self.joints += revolute(self.at(joint.point), count=count, factor=self.factor)
                named.add(joint.point)
        for link in self.links:
            for point in self.solution.problem.bodies[link].points:
                if point not in named:
                    self.joints += self.mark(point)
                    named.add(point)
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
    spots = merge_letters((scheme.at(point), [point_name(point)]) for point in scheme.named)
    gap = SIZES.joint / 2 * scheme.factor + 1.0
    labels = []
    for place, names in spots:
        lines = scheme.directions(place)
        prefer = -sum(lines, 0j) if lines else 1 + 1j
        name = f"{prefix}: point {names[0]}"
        inscription = typeset(", ".join(names), height)
        labels.append(Label(inscription, place, prefer=prefer, gap=gap, name=name))
    return [*labels, *(scheme.link_label(link, SIZES.slider_width * 0.6) for link in links)]


def _loaded_picture(
    scheme: Scheme,
    links: Iterable[str],
    forces: Sequence[Acting],
    couples: Sequence[CoupleArc],
    shifted_forces: Sequence[ShiftedForce],
    prefix: str,
    notation: Notation,
    guided: Sequence[Pressed] = (),
    arms: Sequence[ForceArm] = (),
    special: Sequence[tuple[str, complex]] = (),
) -> Picture:
    items = [*drawn_items(scheme), *point_items(guided, scheme.factor)]
    items += [Disc(place, 0.8 * scheme.factor, Ink.BLACK) for _, place in special]
    bars = [part for parts in scheme.segments.values() for part in parts]
    bars += [shift.line for shift in shifted_forces]
    joints = [scheme.at(point) for point in scheme.named]
    placed = place_force_arrows(forces, bars, joints, gap=SIZES.joint / 2 * scheme.factor + 0.5)
    arrows, labels = force_items(placed, scheme.letter_height, prefix)
    lines, letters = shift_items(shifted_forces, placed, scheme.letter_height, prefix)
    measured, sizes = arm_items(arms, placed, scheme.letter_height, prefix, notation)
    items += [*lines, *measured, *arrows]
    turns, more = couple_items(couples, items, scheme.letter_height, prefix)
    items += turns
    labels += sizes
    for span in (one.span for one in guided if one.span is not None):
        drawn, letter = span_dimension(span, list(lines_of(items)), scheme.letter_height, prefix)
        items += drawn
        labels.append(letter)
    labels += [
        Label(typeset(name, scheme.letter_height), place, gap=1.5) for name, place in special
    ]
    axes = (replace(label, optional=True) for label in axis_labels(scheme))
    return lettered(items, [*labels, *more, *letters, *letters_of(scheme, prefix, links), *axes])


@memoized
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
    shifted_forces = shifted_forces_on(reading, links, notation)
    return _loaded_picture(
        scheme, links, forces, couples, shifted_forces, f"loads {index}", notation
    )


@memoized
def cut_picture(
    reading: ForceReading, number: int, letter_height: float, notation: Notation
) -> Picture:
    """Return the links of a force plan cut free, with all forces on them, mm."""
    plan = reading.plans[number]
    scheme = FreeBodyScheme(reading.solution, reading.index, letter_height, links=plan.links)
    prefix = f"cut {reading.index} {number}"
    return _cut(
        reading, scheme, reading.shown(plan), reading.couples(plan), prefix, notation, plan.moments
    )


@memoized
def inner_picture(
    reading: ForceReading, number: int, letter_height: float, notation: Notation
) -> tuple[str, Picture] | None:
    """Return a link of a dyad cut free at its inner guide too, and its picture, mm.

    None where the plan has no inner guide, or its reaction acts in the joint.
    """
    plan = reading.plans[number]
    inner = (g for g in guides(reading).values() if g.sense > 0 and {g.on, g.by} <= {*plan.links})
    guided = next(inner, None)
    if guided is None or guided.is_no_couple:
        return None
    link, reaction = guided.on, guided.reaction
    assert reaction.couple is not None
    (balance,) = (one for one in plan.balances if one.links == (link,))
    edges = [edge for edge in balance.edges if not reading.is_negligible(edge)]
    couples = [couple for couple in reading.couples(plan) if couple.on == link]
    couples.append(CoupleOn(guided.symbol("M"), link, reaction.couple, reaction.force.at))
    scheme = FreeBodyScheme(reading.solution, reading.index, letter_height, links=(link,))
    return link, _cut(reading, scheme, edges, couples, f"link {reading.index} {link}", notation)


def _cut(
    reading: ForceReading,
    scheme: FreeBodyScheme,
    edges: Sequence[Edge],
    couples: Sequence[CoupleOn],
    prefix: str,
    notation: Notation,
    equations: Sequence[Moments] = (),
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
    shown = sorted(edges, key=lambda edge: edge.component is Component.TOTAL)
    forces = [force for one in guided for force in one.forces]
    forces += [
        Acting(notation.symbol(edge.symbol), reading.place(edge.at), reading.drawn_direction(edge))
        for edge in shown
        if edge.symbol not in replaced
    ]
    turnings = [
        turning(reading, scheme, one, notation) for one in couples if one.symbol not in replaced
    ]
    shifted_forces = shifted_forces_on(reading, scheme.links, notation)
    arms = [arm for arm in arms_of(reading, equations, notation) if arm.symbol not in replaced]
    points = {one.point for one in reading.solution.construction.draft.special.values()}
    special = [
        (point_name(one.about), reading.place(one.about))
        for one in equations
        if one.about in points
    ]
    return _loaded_picture(
        scheme,
        scheme.links,
        forces,
        turnings,
        shifted_forces,
        prefix,
        notation,
        guided,
        arms,
        special,
    )


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
