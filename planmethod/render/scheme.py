"""Kinematic scheme of a mechanism drawn to scale, with its symbols (план положения механизма)."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.given import point_name, solution_peak
from planmethod.note.numbers import is_nothing
from planmethod.plans.draft import cis
from planmethod.plans.solution import Solution
from planmethod.problem.model import Slide
from planmethod.render.block import Picture
from planmethod.render.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.extent import lettered
from planmethod.render.labels import Label, segment_label
from planmethod.render.symbols import (
    SIZES,
    angle_of,
    fixed_pivot,
    guide_plates,
    revolute,
    rigid_corner,
    slider,
    stiff_triangle,
    stone,
    turn_arrow,
    unit,
)
from planmethod.render.typeset import typeset

OVERHANG = 5.0
"""How far a bar goes on beyond the stone that slides on it, mm."""


@dataclass(slots=True)
class Scheme:
    """One mechanism being drawn in one position (схема).

    ``bodies``, ``lines``, ``corners`` and ``joints`` are drawn in this order: the sliders lie under
    the links that reach their pins, the joints cover the lines they join.
    """

    solution: Solution
    index: int
    letter_height: float
    pen: Pen = Pen.MAIN
    guides: list[Item] = field(default_factory=list)
    bodies: list[Item] = field(default_factory=list)
    lines: list[Item] = field(default_factory=list)
    corners: list[Item] = field(default_factory=list)
    joints: list[Item] = field(default_factory=list)
    arrows: list[Item] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    segments: dict[str, list[tuple[complex, complex]]] = field(default_factory=dict)
    axis_ends: list[tuple[str, complex, complex]] = field(default_factory=list)

    @property
    def factor(self) -> float:
        """Size of the symbols: smaller on small sheets."""
        return min(1.0, self.letter_height / 5.0 + 0.1)

    def at(self, point: str) -> complex:
        """Return the place of a point on the paper, mm."""
        trace = self.solution.paper
        return complex(self.solution.complexes(trace, PointName(point))[self.index])

    def axis(self, link: str) -> complex:
        """Return the direction of a link's own axis, a unit vector."""
        if link == FRAME:
            return 1 + 0j
        return cis(float(self.solution.links[link].phi_deg[self.index]))

    def line_direction(self, slide: Slide) -> complex:
        """Return the direction of a slide line, a unit vector."""
        return self.axis(slide.host) * cis(slide.angle)

    def base(self, slide: Slide) -> complex:
        """Return the base point of a slide line on the paper, mm."""
        if slide.through is not None:
            return self.at(slide.through)
        return self.at(f"{slide.label}:0")

    # Links -----------------------------------------------------------------------------------

    def bar(self, link: str, start: complex, end: complex) -> None:
        """Draw a straight part of a link."""
        if abs(end - start) > 0.1:
            self.lines.append(Stroke((start, end), self.pen, tag=f"link {link}"))
            self.segments.setdefault(link, []).append((start, end))

    def draw_link(self, link: str) -> None:
        """Draw the lines of a link through its points and along the lines it carries."""
        problem = self.solution.problem
        body = problem.bodies[link].points
        ends = [(z, self.at(name)) for name, z in body.items()]
        carried = [s for s in problem.slides.values() if s.host == link]
        own = [s for s in carried if not self._is_block(s)]
        size = max((abs(z - ends[0][0]) for z, _ in ends), default=0.0)
        collinear = [(z, p) for z, p in ends if abs((z - ends[0][0]).imag) <= 1e-9 * size]
        corners = [(z, p) for z, p in ends if (z, p) not in collinear]
        along = sorted(collinear, key=lambda pair: pair[0].real)
        if len(along) > 1:
            self.bar(link, along[0][1], along[-1][1])
        for z, p in corners:
            self._corner(link, z, p, along)
        for slide in own:
            self._slot(link, slide, along)

    def _corner(
        self, link: str, z: complex, place: complex, along: list[tuple[complex, complex]]
    ) -> None:
        """Join a point off the axis to the link: as a stiff triangle, or by a rigid arm."""
        inside = along[0][0].real < z.real < along[-1][0].real
        if len(along) > 1 and inside and abs(z.imag) > 0.15 * (along[-1][0] - along[0][0]).real:
            self.lines += stiff_triangle(
                along[0][1], along[-1][1], place, factor=self.factor, pen=self.pen
            )
            self.segments.setdefault(link, []).append((along[0][1], place))
            return
        nearest = min(along, key=lambda pair: abs(pair[0] - z))
        self.bar(link, nearest[1], place)
        for other in along:
            if other != nearest and self.pen is Pen.MAIN:
                self.corners += rigid_corner(nearest[1], place, other[1], factor=self.factor)
                break

    def _slot(self, link: str, slide: Slide, along: list[tuple[complex, complex]]) -> None:
        """Draw the line that a link carries, as far as the stone on it and a little beyond."""
        u = self.line_direction(slide)
        start = self.base(slide)
        reach = ((self.foot(slide) - start) * u.conjugate()).real
        beyond = (7.0 + OVERHANG) * self.factor
        # A link has one length: as far as the stone goes in any position of the sheet.
        ways = self._reaches(slide)
        marks = [0.0, *(way + math.copysign(beyond, way if way else 1.0) for way in ways)]
        if slide.angle in (0.0, 180.0) and len(along) > 1:
            on_axis = [((p - start) * u.conjugate()).real for _, p in along]
            marks += [min(on_axis), max(on_axis)]
        low, high = min(marks), max(marks)
        if slide.angle in (0.0, 180.0) and len(along) > 1:
            old = (min(on_axis), max(on_axis))
            if low < old[0] - 0.1:
                self.bar(link, start + u * low, start + u * old[0])
            if high > old[1] + 0.1:
                self.bar(link, start + u * old[1], start + u * high)
            return
        self.bar(link, start + u * low, start + u * high)
        for _, place in along:
            if abs(place - start) > 1.0 and self.pen is Pen.MAIN:
                self.corners += rigid_corner(start, place, start + u * reach, factor=self.factor)
                break

    def _reaches(self, slide: Slide) -> tuple[float, float]:
        """Return the least and the greatest place of a stone along its line in all positions."""
        s = self.solution
        turns = np.array([cis(float(a)) for a in s.links[slide.host].phi_deg]) * cis(slide.angle)
        pins = s.complexes(s.paper, PointName(slide.pin))
        bases = s.complexes(s.paper, PointName(slide.through or f"{slide.label}:0"))
        along = ((pins - bases) * turns.conjugate()).real
        return float(along.min()), float(along.max())

    def foot(self, slide: Slide) -> complex:
        """Return the foot of the pin on the slide line: the pin itself when there is no offset."""
        u, start = self.line_direction(slide), self.base(slide)
        return start + u * ((self.at(slide.pin) - start) * u.conjugate()).real

    # Sliders ---------------------------------------------------------------------------------

    def _is_block(self, slide: Slide) -> bool:
        """Tell whether the host is a block through which the slider, a bar, passes."""
        bodies = self.solution.problem.bodies
        return (
            slide.host != FRAME
            and len(bodies[slide.host].points) == 1
            and len(bodies[slide.slider].points) > 1
        )

    def draw_slider(self, slide: Slide) -> None:
        """Draw the rectangle of a prismatic pair and the guide that it runs on."""
        u = self.line_direction(slide)
        pin, angle = self.at(slide.pin), angle_of(u)
        if self._is_block(slide):
            block = self.base(slide)
            reach = block + unit(block - pin) * (7.0 + OVERHANG) * self.factor
            far = max(
                (self.at(p) for p in self.solution.problem.bodies[slide.slider].points),
                key=lambda p: ((p - pin) * unit(block - pin).conjugate()).real,
            )
            if ((far - reach) * unit(block - pin).conjugate()).real < 0:
                self.bar(slide.slider, far, reach)
            self.bodies += slider(block, angle=angle, factor=self.factor, pen=self.pen)
            return
        if slide.host == FRAME:
            self._frame_guide(slide, u)
            self.bodies += slider(pin, angle=angle, factor=self.factor, pen=self.pen)
            return
        foot = self.foot(slide)
        slides = self.solution.problem.slides.values()
        inside = any(s.host == FRAME and s.pin == slide.pin for s in slides)
        self.bodies += stone(
            foot, angle=angle, factor=self.factor, pen=self.pen, pin=False, inside=inside
        )
        if abs(foot - pin) > 0.2:
            self.bar(slide.slider, foot, pin)

    def _frame_guide(self, slide: Slide, u: complex) -> None:
        """Draw the axis of a fixed guide over the slider's way and the hatched plates at it."""
        foot, pin, start = self.foot(slide), self.at(slide.pin), self.base(slide)
        angle = angle_of(u)
        way = [((p - start) * u.conjugate()).real for p in self._way(slide)]
        way += [
            ((self.at(p) - start) * u.conjugate()).real
            for p in self.solution.problem.bodies[slide.slider].points
        ]
        half = 22.0 * self.factor
        low, high = min(way) - half, max(way) + half
        offset = pin - foot
        self.guides.append(
            Stroke((start + u * low + offset, start + u * high + offset), Pen.AXIS, tag="guide")
        )
        length, width = SIZES.slider_length + 8.0, SIZES.slider_width + 1.6
        self.bodies += guide_plates(
            pin, angle=angle, length=length, width=width, factor=self.factor, pen=self.pen
        )
        self.axis_ends.append((slide.label, start + u * low + offset, start + u * high + offset))

    def letter_axes(self) -> None:
        """Letter the ends of the guides' axes, but for an end that lies on a link."""
        for label, low, high in self.axis_ends:
            names = label.split("-")
            if len(names) != 2:
                continue
            ends = [(names[0], low, low - high), (names[1], high, high - low)]
            free = [self._clearance(place) for _, place, _ in ends]
            for (text, place, away), room in zip(ends, free, strict=True):
                if room > 4.0 or room == max(free):
                    self.labels.append(
                        Label(typeset(text, self.letter_height), place, prefer=away, gap=1.0)
                    )

    def _clearance(self, place: complex) -> float:
        """Return how far a place is from the nearest link, mm."""
        room = math.inf
        for parts in self.segments.values():
            for start, end in parts:
                along = end - start
                part = ((place - start) * along.conjugate()).real / abs(along) ** 2
                room = min(room, abs(place - start - along * min(1.0, max(0.0, part))))
        return room

    def _way(self, slide: Slide) -> list[complex]:
        """Return the places of a slider's pin in every position of the sheet, mm."""
        places = self.solution.complexes(self.solution.paper, PointName(slide.pin))
        return [complex(p) for p in places]

    # Joints and inscriptions -----------------------------------------------------------------

    def draw_joints(self) -> None:
        """Draw pivots, joints and the other points of the links, and letter them."""
        problem = self.solution.problem
        named: set[str] = set()
        for joint in problem.mechanism.revolutes:
            place = self.at(joint.point)
            if joint.links[0] == FRAME:
                self.joints += fixed_pivot(
                    place, direction=self._free_direction(place), factor=self.factor
                )
            else:
                self.joints += revolute(place, factor=self.factor, pen=self.pen)
            named.add(joint.point)
        for link, body in problem.bodies.items():
            for point in body.points:
                if link != FRAME and point not in named:
                    self.joints.append(Disc(self.at(point), 0.8 * self.factor, Ink.BLACK))
                    named.add(point)
        for point in sorted(named):
            self.labels.append(
                Label(
                    typeset(point_name(point), self.letter_height),
                    self.at(point),
                    prefer=self._away(point),
                    gap=1.5 * self.factor + 1.2,
                    priority=1,
                    name=f"point {point}",
                )
            )

    def _directions(self, place: complex) -> list[complex]:
        """Return the directions in which lines leave a place."""
        out = []
        for parts in self.segments.values():
            for start, end in parts:
                for one, other in ((start, end), (end, start)):
                    if abs(one - place) < 0.5:
                        out.append(unit(other - one))
                inside = ((place - start) * (end - start).conjugate()).real
                off = abs(((place - start) * (end - start).conjugate()).imag)
                span = abs(end - start)
                if 0.5 * span < inside < span * (span - 0.5) and off < 0.5 * span:
                    out += [unit(end - start), unit(start - end)]
        return out

    def _free_direction(self, place: complex) -> complex:
        """Return where a pivot's support disturbs the links least; down if it can be."""
        feet = (0.5 * SIZES.support_height, SIZES.support_height + 2.0)

        def room(way: complex) -> float:
            lines = min([*(abs(cmath.phase(u / way)) for u in self._directions(place)), 1.2])
            clear = min(self._clearance(place + way * foot * self.factor) for foot in feet)
            return round(lines / 1.2, 3) + round(min(1.0, clear / (6.0 * self.factor)), 3)

        return max((-1j, 1j, -1 + 0j, 1 + 0j), key=room)

    def _away(self, point: str) -> complex:
        lines = self._directions(self.at(point))
        return -sum(lines, 0j) if lines else 1 + 1j

    def letter_links(self) -> None:
        """Put the links' numbers down, and circular arrows for the senses of omega and epsilon."""
        small = self.letter_height
        for link in self.solution.problem.mechanism.links:
            parts = self.segments.get(link)
            text = link
            if parts:
                start, end = max(parts, key=lambda part: abs(part[1] - part[0]))
                self.labels.append(segment_label(text, start, end, small, gap=1.2))
            else:
                first = next(iter(self.solution.problem.bodies[link].points))
                self.labels.append(
                    Label(typeset(text, small), self.at(first), gap=5.5 * self.factor)
                )
            self._senses(link)

    def _senses(self, link: str) -> None:
        motion = self.solution.links[link]
        problem = self.solution.problem
        body = problem.bodies[link].points
        if link in problem.slides and len(body) == 1:
            return  # the stone turns with the link that it slides on: one arrow for both
        pivot = next((p for p in body if p in problem.bodies[FRAME].points), None)
        parts = self.segments.get(link)
        if not parts:
            return
        start, end = max(parts, key=lambda part: abs(part[1] - part[0]))
        if pivot is not None:
            centre = self.at(pivot)
            other = end if abs(end - centre) > abs(start - centre) else start
            radius = max(10.0 * self.factor, min(20.0 * self.factor, 0.6 * abs(other - centre)))
        else:
            centre, other, radius = start + 0.4 * (end - start), end, 8.0 * self.factor
        turn = angle_of(other - centre)
        for symbol, value, shift in (
            ("ω", float(motion.omega[self.index]), 0.0),
            ("ε", float(motion.epsilon[self.index]), 3.5 * self.factor),
        ):
            if is_nothing(value, solution_peak(self.solution, symbol)):
                continue
            sense = 1 if value > 0 else -1
            middle, sweep = turn, 70.0
            arrow = turn_arrow(
                centre,
                radius + shift,
                sense,
                middle=middle,
                sweep=sweep,
                length=3.5 * self.factor,
                width=1.3 * self.factor,
                tag=f"{symbol} {link}",
            )
            self.arrows += arrow
            tail = centre + (radius + shift) * cis(middle - sense * sweep / 2)
            self.labels.append(
                Label(
                    typeset(f"{symbol}_{{{link}}}", self.letter_height),
                    tail,
                    prefer=tail - centre,
                    gap=0.8,
                    name=f"{symbol} {link}",
                )
            )

    def draw_angle(self) -> None:
        """Show the crank's angle phi from the horizontal."""
        drive = self.solution.problem.drive
        if drive.pivot is None:
            return
        phi = float(self.solution.positions[self.index]) % 360.0
        if phi < 8 or phi > 352:
            return
        centre, radius = self.at(drive.pivot), 6.0 * self.factor + 2
        support = angle_of(self._free_direction(centre)) % 360.0
        if support < phi:
            radius = (SIZES.support_height + SIZES.hatch_stroke + 4.0) * self.factor
            pins = [self.at(p) for p in self.solution.problem.bodies[drive.link].points]
            if max(abs(pin - centre) for pin in pins) < radius + 4.0:
                return  # no room for an arc around the support: the statement tells the angle
        self.guides.append(Stroke((centre, centre + radius + 6), Pen.THIN, tag="phi"))
        self.guides += turn_arrow(
            centre, radius, 1, middle=phi / 2, sweep=phi, length=2.5, width=1.0, tag="phi"
        )
        self.labels.append(
            Label(
                typeset(
                    f"φ_{{{drive.link}}}",
                    0.7 * self.letter_height if self.letter_height > 5 else 3.5,
                ),
                centre + radius * cis(phi / 2),
                prefer=cis(phi / 2),
                gap=1.0,
                name="phi",
            )
        )

    def draw(self) -> None:
        """Draw links, sliders and joints."""
        problem = self.solution.problem
        for link in problem.mechanism.links:
            self.draw_link(link)
        # A stone pinned to a slider of the frame lies on it.
        for slide in sorted(problem.slides.values(), key=lambda slide: slide.host != FRAME):
            self.draw_slider(slide)


def ghost(solution: Solution, index: int, letter_height: float) -> list[Item]:
    """Return the mechanism in another position: pale lines only."""
    scheme = Scheme(solution, index, letter_height, pen=Pen.PALE)
    for link in solution.problem.mechanism.links:
        scheme.draw_link(link)
    return scheme.lines


@lru_cache(maxsize=64)
def scheme_picture(
    solution: Solution, index: int, *, letter_height: float = 5.0, overlay: tuple[int, ...] = ()
) -> Picture:
    """Return the scheme in one position as a picture, mm.

    The positions of ``overlay`` are there in pale lines, the driver's pin numbered.
    """
    scheme = Scheme(solution, index, letter_height)
    scheme.draw()
    scheme.draw_joints()
    scheme.letter_axes()
    scheme.letter_links()
    scheme.draw_angle()
    ghosts: list[Item] = []
    for other in overlay:
        if other != index:
            ghosts += ghost(solution, other, letter_height)
    scheme.labels += _numbers(solution, letter_height, overlay)
    items = [
        *ghosts,
        *scheme.guides,
        *scheme.bodies,
        *scheme.lines,
        *scheme.corners,
        *scheme.joints,
        *scheme.arrows,
    ]
    return lettered(items, scheme.labels)


def _numbers(solution: Solution, letter_height: float, overlay: tuple[int, ...]) -> list[Label]:
    """Return the numbers of the positions at the driver's pin."""
    drive = solution.problem.drive
    if drive.pivot is None:
        return []
    body = solution.problem.bodies[drive.link].points
    pin = next(p for p in body if p != drive.pivot)
    places = solution.complexes(solution.paper, PointName(pin))
    centre = complex(solution.complexes(solution.paper, PointName(drive.pivot))[0])
    return [
        Label(
            typeset(str(number), min(letter_height, 3.5)),
            complex(place),
            prefer=complex(place) - centre,
            gap=1.5,
            name=f"position {number}",
        )
        for number, place in enumerate(places)
        if number in overlay
    ]
