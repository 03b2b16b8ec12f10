"""Links, sliders and joints of a mechanism drawn to scale with the symbols of kinematic schemes."""

# no messages: tags of items

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from msgspec import Struct, field
from numpy.typing import NDArray

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME, Revolute
from planmethod.note.narrate.stated_links import offset_slide
from planmethod.plans.draft import cis
from planmethod.plans.motion.legs import has_slot_name, slot_name
from planmethod.problem.model import Slide
from planmethod.render import symbols
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label, segment_label
from planmethod.render.pictures.lettered import reject_oversized
from planmethod.render.pictures.springs import anchors, spring_items, springs_in
from planmethod.render.pictures.supports import (
    BlockOutline,
    Piece,
    Support,
    free_sides,
    free_welds,
    leaving,
    obstacles,
    place_supports,
    rigid_arms,
    welded,
)
from planmethod.render.pictures.wheels import contacts, pole_items, wheel_items
from planmethod.render.symbols import SIZES
from planmethod.render.symbols.marks import axis_line
from planmethod.solved.solution import Solution

AXIS = 15.0
"""Length of a guide's axis beyond the slider before ``factor``, mm."""

OVERHANG = 5.0
"""Extension of a bar beyond the stone that slides on it, mm."""


def extent(solution: Solution, positions: Sequence[int]) -> tuple[float, float, float, float]:
    """Return left, low, right, high of all points in some positions, mm."""
    names = solution.construction.draft.points()
    points = np.array([solution.paper.point(PointName(name)) for name in names])
    at = points[:, positions] if len(points) else np.zeros((1, 1), complex)
    return at.real.min(), at.imag.min(), at.real.max(), at.imag.max()


_OFF = 0.3  # mm: a point further from a line than this is off it
_AT_JOINT = 0.05  # mm: a line or its end at a smaller distance is at a joint


def off_segment(place: complex, start: complex, end: complex) -> float:
    """Return how far a place is from a segment, mm."""
    along = end - start
    part = ((place - start) * along.conjugate()).real / abs(along) ** 2
    return abs(place - start - along * min(1.0, max(0.0, part)))


class Scheme(Struct):
    """One mechanism being drawn in one position (схема).

    ``slider_items``, ``lines``, ``corners`` and ``joints`` are drawn in this order: sliders are
    under the links that reach their pins, joints cover the lines that they join.
    """

    solution: Solution
    index: int
    letter_height: float
    pen: Pen = Pen.MAIN
    guides: list[Item] = field(default_factory=list)
    slider_items: list[Item] = field(default_factory=list)
    lines: list[Item] = field(default_factory=list)
    corners: list[Item] = field(default_factory=list)
    joints: list[Item] = field(default_factory=list)
    named: list[str] = field(default_factory=list)
    segments: dict[str, list[tuple[complex, complex]]] = field(default_factory=dict)
    axis_ends: list[tuple[str, complex, complex]] = field(default_factory=list)
    slot_ends: list[tuple[str, complex, complex]] = field(default_factory=list)
    supports: list[Support] = field(default_factory=list)
    blocks: list[BlockOutline] = field(default_factory=list)
    own_blocks: list[tuple[str, BlockOutline]] = field(default_factory=list)
    pieces: dict[str, list[Piece]] = field(default_factory=dict)

    @property
    def factor(self) -> float:
        """Size of the symbols: smaller on small sheets."""
        return min(1.0, self.letter_height / 5.0 + 0.1)

    def at(self, point: str) -> complex:
        """Return the place of a point on the paper, mm."""
        trace = self.solution.paper
        return complex(trace.point(PointName(point))[self.index])

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
        """Draw the lines of a link through its points and along the lines it carries.

        A centre of mass is not part of the outline: off the lines it is connected by a thin line.
        """
        problem = self.solution.problem
        body, centres = problem.bodies[link].points, problem.centres
        firm = {name: z for name, z in body.items() if name not in centres} or body
        ends = [(z, self.at(name)) for name, z in firm.items()]
        carried = [s for s in problem.slides.values() if s.host == link]
        own = [s for s in carried if not self.solution.problem.is_block(s)]
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
        if self.pen is Pen.MAIN:
            for name in body.keys() - firm.keys():
                self._lead(link, self.at(name), [place for _, place in ends])

    def _lead(self, link: str, centre: complex, joints: Sequence[complex]) -> None:
        """Connect a centre of mass that lies off the lines of its link to the nearest joint."""
        parts = self.segments.get(link, ())
        if all(off_segment(centre, *part) > _OFF for part in parts) or not parts:
            nearest = min(joints, key=lambda place: abs(place - centre))
            if abs(nearest - centre) > _OFF:
                self.lines.append(Stroke((nearest, centre), Pen.THIN, tag=f"centre of {link}"))

    def _corner(
        self, link: str, z: complex, place: complex, axis_points: list[tuple[complex, complex]]
    ) -> None:
        """Join a point off the axis to the link by a rigid triangle or a rigid arm."""
        inside = axis_points[0][0].real < z.real < axis_points[-1][0].real
        if (
            len(axis_points) > 1
            and inside
            and abs(z.imag) > 0.15 * (axis_points[-1][0] - axis_points[0][0]).real
        ):
            corners = (axis_points[0][1], axis_points[-1][1], place)
            tag = f"link {link}"
            self.lines += symbols.rigid_polygon(*corners, factor=self.factor, pen=self.pen, tag=tag)
            self.segments.setdefault(link, []).append((axis_points[0][1], place))
            return
        nearest = min(axis_points, key=lambda pair: abs(pair[0] - z))
        self.bar(link, nearest[1], place)

    def _slot(self, link: str, slide: Slide, axis_points: list[tuple[complex, complex]]) -> None:
        """Draw the line that a link carries, to a little beyond the stone on it."""
        u = self.line_direction(slide)
        start = self.base(slide)
        reach = ((self.slide_point(slide) - start) * u.conjugate()).real
        beyond = (7.0 + OVERHANG) * self.factor
        # A link has one length: to the furthest stone of all positions of the sheet. In positions
        # behind the main one it is drawn to its stone, or long ends would hide the rest.
        ways = self._reaches(slide) if self.pen is Pen.MAIN else (reach,)
        marks = [0.0, *(way + math.copysign(beyond, way if way else 1.0) for way in ways)]
        if slide.angle in (0.0, 180.0) and len(axis_points) > 1:
            on_axis = [((p - start) * u.conjugate()).real for _, p in axis_points]
            marks += [min(on_axis), max(on_axis)]
        low, high = min(marks), max(marks)
        if slide.angle in (0.0, 180.0) and len(axis_points) > 1:
            old = (min(on_axis), max(on_axis))
            if low < old[0] - 0.1:
                self.bar(link, start + u * low, start + u * old[0])
            if high > old[1] + 0.1:
                self.bar(link, start + u * old[1], start + u * high)
            return
        self.bar(link, start + u * low, start + u * high)
        self._name_slot(slide, start + u * low, start + u * high)

    def _name_slot(self, slide: Slide, low: complex, high: complex) -> None:
        """Record the ends of a guide on a moving link that has a name of its own."""
        if self.pen is Pen.MAIN and has_slot_name(slide, self.solution.problem):
            self.slot_ends.append((slot_name(slide), low, high))

    @property
    def _drawn_positions(self) -> NDArray[np.bool_]:
        """True in the positions that the scheme shows, and in this one."""
        drawn = self.solution.extents.on_scheme.copy()
        drawn[self.index] = True
        return drawn

    def _reaches(self, slide: Slide) -> tuple[float, float]:
        """Return the least and the greatest place of a stone along its line, as drawn."""
        s = self.solution
        turns = np.array([cis(float(a)) for a in s.links[slide.host].phi_deg]) * cis(slide.angle)
        pins = s.paper.point(PointName(slide.pin))
        bases = s.paper.point(PointName(slide.through or f"{slide.label}:0"))
        along = ((pins - bases) * turns.conjugate()).real[self._drawn_positions]
        return float(along.min()), float(along.max())

    def slide_point(self, slide: Slide) -> complex:
        """Return the foot of the pin on the slide line: the pin itself without an offset."""
        u, start = self.line_direction(slide), self.base(slide)
        return start + u * ((self.at(slide.pin) - start) * u.conjugate()).real

    # Sliders ---------------------------------------------------------------------------------

    def draw_slider(self, slide: Slide) -> None:
        """Draw the rectangle of a prismatic pair and the guide that it runs on."""
        u = self.line_direction(slide)
        pin = self.at(slide.pin)
        if self.solution.problem.is_block(slide):
            base = self.base(slide)
            block = pin + u * ((base - pin) * u.conjugate()).real
            self._rod(slide, block)
            self._add_block(
                BlockOutline(block, u, *self._sized(SIZES.slider_length, SIZES.slider_width))
            )
            if abs(block - base) > 0.2:
                self.bar(slide.host, block, base)
                self._weld(slide.host)
            return
        if slide.host == FRAME:
            self._frame_guide(slide, u)
            self._add_block(
                BlockOutline(pin, u, *self._sized(SIZES.slider_length, SIZES.slider_width))
            )
            self._weld(slide.slider)
            return
        foot = self.slide_point(slide)
        # A stone on another block is smaller, so that both are seen.
        whole = BlockOutline(foot, u, *self._sized(*symbols.sliding_block_size()))
        inside = any(one.covers(whole) for one in self.blocks)
        self._add_block(
            BlockOutline(foot, u, *self._sized(*symbols.sliding_block_size(inside=inside)))
        )
        self.slider_items.append(Stroke(self.blocks[-1].axis, self.pen))
        if abs(foot - pin) > 0.2:
            self.bar(slide.slider, foot, pin)
        self._weld(slide.slider)

    def _rod(self, slide: Slide, block: complex) -> None:
        """Draw the straight rod of a link that passes through a block, to a little beyond it.

        It is on the line of the pin; a point of the link beside that line is no end of the rod.
        """
        pin, link = self.at(slide.pin), slide.slider
        along = symbols.unit(block - pin)
        reach = abs(block - pin) + (7.0 + OVERHANG) * self.factor
        points = [self.at(name) for name in self.solution.problem.bodies[link].points]
        ways = [(place - pin) * along.conjugate() for place in points]
        far = max(way.real for way in ways if abs(way.imag) < _OFF)
        if far >= reach:
            return
        low, high = pin + along * far, pin + along * reach
        self.bar(link, low, high)
        self._name_slot(slide, low, high)

    def _sized(self, length: float, width: float) -> tuple[float, float]:
        return length * self.factor, width * self.factor

    def _add_block(self, block: BlockOutline) -> None:
        """Draw a block, white inside: over the guides, but over no other block."""
        fill, outline = symbols.slider(
            block.middle, angle=symbols.angle_of(block.direction),
            length=block.length, width=block.width, pen=self.pen,
        )  # fmt: skip
        self.slider_items.insert(0, fill)
        self.slider_items.append(outline)
        self.blocks.append(block)

    def _weld(self, link: str) -> None:
        """Fix the rods of a link to the last drawn block, which is rigid with it."""
        if self.pen is Pen.MAIN:
            tag, block = f"link {link}", self.blocks[-1]
            self.lines, welds = welded(self.lines, tag, block, self.factor)
            self.corners += welds
            self.own_blocks.append((link, block))

    def _frame_guide(self, slide: Slide, u: complex) -> None:
        """Draw the axis of a fixed guide over the slider's travel, and its hatched plates."""
        foot, pin, start = self.slide_point(slide), self.at(slide.pin), self.base(slide)
        angle = symbols.angle_of(u)
        # The places of the pin in every position of the sheet, and of the slider's points.
        pins = self.solution.paper.point(PointName(slide.pin))
        ends = [complex(p) for p in pins[self._drawn_positions]]
        ends += [self.at(p) for p in self.solution.problem.bodies[slide.slider].points]
        way = [((p - start) * u.conjugate()).real for p in ends]
        edge = SIZES.slider_length / 2 * self.factor
        half = edge + AXIS * self.factor
        low, high = min(way) - half, max(way) + half
        offset = pin - foot
        # Two lines, since each begins with a stroke at the edge of the slider.
        for end, side in ((low, -edge), (high, edge)):
            self.guides += axis_line(pin + u * side, start + u * end + offset, tag="guide")
        length = SIZES.slider_length + 8.0
        sides = free_sides(pin, self.lines, angle=angle, length=length, factor=self.factor)
        self.slider_items += symbols.guide_plates(
            pin, angle=angle, length=length, sides=sides, factor=self.factor, pen=self.pen
        )
        problem = self.solution.problem
        if abs(offset) > 0.2 and offset_slide(slide.label, problem) is None:
            self.guides += axis_line(start + u * low, start + u * high, tag="guide")
            offset = 0j  # the letters belong to the given line
        name = problem.guide_name(slide.label)
        self.axis_ends.append((name, start + u * low + offset, start + u * high + offset))

    def clearance(self, place: complex) -> float:
        """Return the distance of a place from the nearest link, mm."""
        room = math.inf
        for parts in self.segments.values():
            for start, end in parts:
                room = min(room, off_segment(place, start, end))
        return room

    def longest(self, link: str) -> tuple[complex, complex] | None:
        """Return the longest straight part of a link, if it has one."""
        parts = self.segments.get(link, [])
        return max(parts, key=lambda part: abs(part[1] - part[0]), default=None)

    def link_label(self, link: str, gap: float) -> Label:
        """Return the number of a link: along it, or at its only point with ``gap`` mm."""
        part = self.longest(link)
        if part is not None:
            return segment_label(link, *part, self.letter_height)
        first = next(iter(self.solution.problem.bodies[link].points))
        return Label(typeset(link, self.letter_height), self.at(first), gap=gap)

    # Joints and inscriptions -----------------------------------------------------------------

    def draw_joints(self) -> None:
        """Draw pivots, joints and the other points of the links."""
        problem = self.solution.problem
        named: set[str] = set()
        joints = problem.mechanism.revolutes
        replacing = contacts(problem)
        pivots = [
            self.at(joint.point)
            for joint in joints
            if joint.links[0] == FRAME and not {*joint.links[1:]} <= replacing
        ]
        held = anchors(self.solution)
        pivots += held
        self.supports = place_supports(
            pivots, [*self.lines, *self.slider_items], factor=self.factor
        )
        for support in self.supports:
            self.joints += support.items()
        self.mark_bends(list(problem.mechanism.links))
        for place, letter in held.items():
            self.joints += symbols.revolute(place, factor=self.factor, pen=self.pen)
            named.update([letter] if letter else ())
        for joint in joints:
            place = self.at(joint.point)
            self.joints += self.joint_items(joint, place)
            named.add(joint.point)
        for link, body in problem.bodies.items():
            for point in body.points:
                if link != FRAME and point not in named:
                    self.joints += self.mark(point)
                    named.add(point)
        for pole, dot in pole_items(self).items():
            self.joints += dot
            named.add(pole)
        self.named = sorted(named)

    def mark(self, point: str) -> list[Item]:
        """Return the mark of a point that is not a joint; a centre of mass has its own symbol."""
        if point in self.solution.problem.centres:
            return symbols.mass_centre(self.at(point), factor=self.factor)
        return [Disc(self.at(point), 0.8 * self.factor, Ink.BLACK)]

    def mark_bends(self, links: Sequence[str]) -> None:
        """Show at the bends of links that their lines are rigid: see `rigid_arms`."""
        problem = self.solution.problem
        hinges = {
            self.at(joint.point): SIZES.joint / 2 + SIZES.ring * (self._pairs(joint) - 1)
            for joint in problem.mechanism.revolutes
            if self._pairs(joint)
        }
        for link in links:
            parts = self.segments.get(link, [])
            tag, own = f"link {link}", [block for of, block in self.own_blocks if of == link]
            lines = [one for one in self.lines if one.tag.startswith("link ") and one.tag != tag]
            blocks = [block for block in self.blocks if block not in own]
            others = obstacles(lines, blocks, self.supports)
            self.corners = free_welds(self.corners, tag, obstacles(lines))
            closed = [
                one.points
                for one in self.lines
                if isinstance(one, Stroke) and one.closed and one.tag == tag
            ]
            ends = [end for part in parts for end in part]
            places = [p for p in hinges if any(off_segment(p, *part) < _AT_JOINT for part in parts)]
            for end in ends:
                if all(abs(end - place) > _AT_JOINT for place in places):
                    places.append(end)
            for place in places:
                radius = (hinges.get(place, 0.8)) * self.factor
                corners, pieces = rigid_arms(
                    place, parts, closed, own, others, radius=radius, factor=self.factor, tag=tag
                )
                if self.pen is Pen.MAIN:
                    self.corners += corners
                if place in hinges:
                    self.pieces.setdefault(link, []).extend(pieces)

    def _pairs(self, joint: Revolute) -> int:
        """Return the number of pairs that a joint shows: wheels in contact have none."""
        return joint.pairs - len(contacts(self.solution.problem) & {*joint.links})

    def joint_items(self, joint: Revolute, place: complex) -> list[Item]:
        """Return a joint; a link that passes through it is drawn in one piece."""
        passing = [(link, piece) for link in joint.links for piece in self.passing(link, place)]
        count = self._pairs(joint)
        if len(passing) == 1 and count == 1:
            ((link, piece),) = passing
            arc = piece.side_of(self._leaves([one for one in joint.links if one != link], place))
            if arc is not None:
                return symbols.revolute_on(
                    place, arc[0], arc[1], factor=self.factor, pen=self.pen, tag=f"link {link}"
                )
        items = symbols.revolute(place, count=count, factor=self.factor, pen=self.pen)
        return [*items, *(item for link in joint.links for item in self.pieces_over(link, place))]

    def pieces_over(self, link: str, place: complex) -> list[Item]:
        """Return the parts of a link that go on through a joint, to be drawn over it."""
        found: list[Item] = []
        for one in self.passing(link, place):
            start, end = (place + way * SIZES.joint / 2 * self.factor for way in (one.one, one.two))
            bent = (place,) if abs(one.one + one.two) > 1e-6 else ()
            found.append(Stroke((start, *bent, end), self.pen, tag=f"link {link}"))
        return found

    def passing(self, link: str, place: complex) -> list[Piece]:
        """Return the parts of a link that go on through a joint, once `mark_bends` found them."""
        return [one for one in self.pieces.get(link, ()) if abs(one.at - place) < _AT_JOINT]

    def _leaves(self, links: Sequence[str], place: complex) -> list[complex]:
        """Return the directions of links, or the frame's support, from a joint: unit vectors."""
        ground = [self.free_direction(place)] if FRAME in links else []
        return ground + self.directions(place, links)

    def directions(self, place: complex, links: Sequence[str] | None = None) -> list[complex]:
        """Return the directions in which lines, or those of some links, leave a place."""
        shown = self.segments if links is None else [one for one in links if one in self.segments]
        return [way for link in shown for way, _ in leaving(place, self.segments[link])]

    def free_direction(self, place: complex) -> complex:
        """Return the direction of a pivot's support, once `draw_joints` has chosen it."""
        ways = (s.direction for s in self.supports for p in s.places if abs(p - place) < 0.01)
        return next(ways, -1j)

    def draw(self) -> None:
        """Draw links, sliders and joints."""
        problem = self.solution.problem
        reject_oversized(*extent(self.solution, [self.index]))
        self.guides += wheel_items(self)
        replacing = contacts(problem)
        for link in problem.mechanism.links:
            if link not in replacing:
                self.draw_link(link)
        # A stone pinned to a slider of the frame lies on it.
        for slide in sorted(problem.slides.values(), key=lambda slide: slide.host != FRAME):
            if slide.slider not in replacing:
                self.draw_slider(slide)
        for number, spring in enumerate(springs_in(problem), 1):
            self.guides += spring_items(self, spring, number)
