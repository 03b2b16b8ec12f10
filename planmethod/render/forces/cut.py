"""Links with what acts on them: the scheme, a structural group, the driver (схемы нагружения).

A group is cut free at its outer joints: there the reactions stand for what was cut away.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.given import point_name
from planmethod.plans.forcereading import ForceReading
from planmethod.plans.polygons import CoupleOn, ForcePlan, Share
from planmethod.problem.model import Slide
from planmethod.render.block import Picture
from planmethod.render.drawing import Disc, Ink, Item
from planmethod.render.extent import lettered
from planmethod.render.forces.arrows import (
    Acting,
    Segment,
    Turning,
    couple_items,
    force_items,
    lay_forces,
)
from planmethod.render.labels import Label, segment_label
from planmethod.render.scheme import Scheme
from planmethod.render.symbols import SIZES, angle_of, before_links, revolute, slider
from planmethod.render.symbols.axes import axis_line
from planmethod.render.typeset import typeset

_AXIS = 26.0
"""Length of a cut guide's axis to both sides of the slider's pin, before ``factor``, mm."""


@dataclass(slots=True)
class Cut(Scheme):
    """Some links of a mechanism in one position, cut free from the others (группа отдельно)."""

    links: tuple[str, ...] = field(default=())

    def draw(self) -> None:
        """Draw the links and, of the pairs that were cut, what belongs to them."""
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
            self.bodies += slider(self.base(slide), angle=angle_of(u), factor=self.factor)
            return
        if block:
            self.bar(slide.slider, pin, self.base(slide))
        elif slider_is_here:
            reach = _AXIS * self.factor * u
            edge = SIZES.slider_length / 2 * self.factor * u
            for side in (-1, 1):
                self.guides += axis_line(pin + side * edge, pin + side * reach, tag="guide")
            self.axis_ends.append((slide.label, pin - reach, pin + reach))
            self.bodies += slider(pin, angle=angle_of(u), factor=self.factor, pen=self.pen)

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
                    self.joints.append(Disc(self.at(point), 0.8 * self.factor, Ink.BLACK))
                    named.add(point)
        self.named = sorted(named)


def _drawn(scheme: Scheme) -> list[Item]:
    scheme.draw()
    scheme.draw_joints()
    return [
        *scheme.guides,
        *before_links([*scheme.bodies, *scheme.lines, *scheme.corners, *scheme.joints]),
    ]


def _bars(scheme: Scheme) -> list[Segment]:
    return [part for parts in scheme.segments.values() for part in parts]


def _letters(scheme: Scheme, prefix: str, links: Iterable[str]) -> list[Label]:
    """Return the letters of the points, one for points that coincide, and the links' numbers."""
    height = scheme.letter_height
    spots: list[tuple[complex, list[str]]] = []
    for point in scheme.named:
        place = scheme.at(point)
        for other, names in spots:
            if abs(other - place) < 0.3:
                names.append(point_name(point))
                break
        else:
            spots.append((place, [point_name(point)]))
    gap = SIZES.joint / 2 * scheme.factor + 1.0
    labels = []
    for place, names in spots:
        lines = scheme.directions(place)
        prefer = -sum(lines, 0j) if lines else 1 + 1j
        name = f"{prefix}: point {names[0]}"
        inscription = typeset(", ".join(names), height)
        labels.append(Label(inscription, place, prefer=prefer, gap=gap, name=name))
    for link in links:
        parts = scheme.segments.get(link)
        if parts:
            start, end = max(parts, key=lambda part: abs(part[1] - part[0]))
            labels.append(segment_label(link, start, end, height))
        else:
            first = next(iter(scheme.solution.problem.bodies[link].points))
            labels.append(
                Label(typeset(link, height), scheme.at(first), gap=SIZES.slider_width * 0.6)
            )
    return labels


def _loaded_picture(
    scheme: Scheme,
    links: Iterable[str],
    forces: Sequence[Acting],
    couples: Sequence[Turning],
    prefix: str,
) -> Picture:
    items = _drawn(scheme)
    placed = lay_forces(forces, _bars(scheme), gap=SIZES.joint / 2 * scheme.factor + 0.5)
    arrows, labels = force_items(placed, scheme.letter_height, prefix)
    items += arrows
    turns, more = couple_items(couples, items, scheme.letter_height, prefix)
    items += turns
    return lettered(items, [*labels, *more, *_letters(scheme, prefix, links)])


@lru_cache(maxsize=32)
def loads_picture(reading: ForceReading, letter_height: float) -> Picture:
    """Return the whole scheme with the weights, inertia forces and couples, external loads, mm."""
    solution, index = reading.solution, reading.index
    scheme = Scheme(solution, index, letter_height)
    forces, couples = [], []
    named = reading.statics.board.kin.velocity.named
    for given in reading.statics.board.given:
        one = given.applied
        if one.point is not None:
            force = complex(one.force[index])
            if abs(force) > 1e-9 * reading.peak:
                place = reading.place(PointName(named[one.point][1]))
                forces.append(Acting(one.name, place, force))
        elif given.couple is not None:
            couple = CoupleOn(one.name, one.link, given.couple)
            if not reading.is_no_couple(couple):
                couples.append(_turning(reading, scheme, couple))
    return _loaded_picture(
        scheme, solution.problem.mechanism.links, forces, couples, f"loads {index}"
    )


@lru_cache(maxsize=64)
def cut_picture(reading: ForceReading, number: int, letter_height: float) -> Picture:
    """Return the links of a force plan cut free, with all that acts on them, mm."""
    plan = reading.plans[number]
    scheme = Cut(reading.solution, reading.index, letter_height, links=plan.links)
    forces = [
        Acting(edge.symbol, reading.place(edge.at), reading.force(edge))
        for edge in reading.shown(plan)
    ]
    # The found reactions first, where they have to be: across or along the link, at its end.
    order = sorted(range(len(forces)), key=lambda k: not _is_part(reading, plan, k))
    couples = [_turning(reading, scheme, couple) for couple in reading.couples(plan)]
    prefix = f"cut {reading.index} {number}"
    return _loaded_picture(scheme, plan.links, [forces[k] for k in order], couples, prefix)


def _is_part(reading: ForceReading, plan: ForcePlan, number: int) -> bool:
    return reading.shown(plan)[number].share is not Share.WHOLE


def _turning(reading: ForceReading, scheme: Scheme, couple: CoupleOn) -> Turning:
    """Return a couple as it is drawn: about its own place, else about the centre of mass."""
    sense = 1 if reading.number(couple.moment) > 0 else -1
    if couple.at is not None:
        return Turning(couple.symbol, reading.place(couple.at), sense)
    problem = scheme.solution.problem
    mass = problem.dynamics.masses.get(couple.on) if problem.dynamics is not None else None
    points = list(problem.bodies[couple.on].points)
    places = [scheme.at(point) for point in points]
    if mass is not None and mass.centre in points and couple.symbol.startswith("M_{Φ"):
        return Turning(couple.symbol, scheme.at(mass.centre), sense)
    return Turning(couple.symbol, sum(places) / len(places), sense)
