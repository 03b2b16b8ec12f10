"""Structural pictures without scale (структурная схема, структурные группы).

Links are bars and rigid triangles, revolute pairs circles, prismatic pairs rectangles on bars, the
frame is hatched. A group taken apart keeps its outer joints open: a dashed stub shows where a link
outside the group goes on, with that link's number.
"""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import radians

from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME, Mechanism
from planmethod.mechanism.structure import Structure
from planmethod.render.block import Picture
from planmethod.render.chains import (
    Chain,
    Far,
    Pin,
    Shape,
    Slide,
    driver_chain,
    group_chain,
    mechanism_chain,
)
from planmethod.render.drawing import Arc, Item, Pen, Stroke
from planmethod.render.embedding import embed, places, turned_outwards
from planmethod.render.extent import ink_bounds
from planmethod.render.labels import Label, place_labels, segment_label
from planmethod.render.symbols import (
    SIZES,
    angle_of,
    arrowhead,
    fixed_pivot,
    guide_line,
    revolute,
    rigid_corner,
    slider,
    stiff_triangle,
    turn_arrow,
    unit,
)
from planmethod.render.typeset import typeset

MARGIN = 13.0
"""Room about the joints for symbols and letters, mm."""

LARGEST_STEP = 34.0
"""Greatest length of a grid unit, mm: a four-bar linkage should not fill a wall."""

STUB = 13.0
"""Length of the dashed stub of an open joint, mm."""

_DYADS: Mapping[str, tuple[complex, complex, complex]] = {
    # Outer joint, inner joint, outer joint: as every textbook draws the five kinds.
    "RRR": (0j, 1.1 + 1.3j, 2.2 + 0j),
    "RRP": (0j, 1.4 + 1.1j, 1.4 + 1.1j),
    "RPR": (0j, 0j, 2.2 + 0j),
    "PRP": (0j, 0j, 0j),
    "RPP": (0j, 0j, 0j),
}


def mechanism_picture(
    mechanism: Mechanism,
    structure: Structure,
    *,
    width: float,
    height: float,
    letter_height: float = 5.0,
    sense: int = 1,
) -> Picture:
    """Return the structural scheme of a mechanism (структурная схема), mm.

    Parameters
    ----------
    width, height : float, mm
        Room to fill; the picture is never larger than looks well.
    sense : int
        Of the driver's motion: +1 counter-clockwise or to the right, -1 the other way.
    """
    chain = mechanism_chain(mechanism, structure)
    at = _fitted(embed(chain.net), width, height)
    return _picture(chain, at, letter_height, mechanism.driver, sense)


def driver_picture(
    mechanism: Mechanism, *, width: float, height: float, letter_height: float = 5.0, sense: int = 1
) -> Picture:
    """Return the driver with the frame (первичный механизм), mm."""
    chain = driver_chain(mechanism)
    node = chain.net.nodes[0]
    reach = min(30.0, width - 2 * MARGIN, height - 2 * MARGIN)
    at = {node: 0j, f"{node}>": reach * cmath.exp(1j * radians(50))}
    return _picture(chain, at, letter_height, mechanism.driver, sense)


def group_picture(
    mechanism: Mechanism,
    group: AssurGroup,
    *,
    width: float,
    height: float,
    letter_height: float = 5.0,
) -> Picture:
    """Return a group taken apart (структурная группа), mm; outer joints open."""
    chain = group_chain(mechanism, group)
    found = _classical(chain, group) or embed(chain.net)
    at = _fitted(found, width - STUB, height - STUB)
    return _picture(chain, at, letter_height)


def _classical(chain: Chain, group: AssurGroup) -> dict[str, complex] | None:
    """Return the places that textbooks give to the joints of a group, grid units."""
    if len(group.links) == 2:
        return _dyad(chain)
    base = [shape for shape in chain.shapes if len(shape.outline) == 3 and not shape.on]
    bars = [shape for shape in chain.shapes if len(shape.outline) == 2 and not shape.on]
    if chain.slides or len(base) != 1 or len(base) + len(bars) != len(chain.shapes):
        return None
    corners = base[0].outline
    if any(pin.far is Far.OPEN for pin in chain.pins if pin.node in corners):
        return None
    # Three leads stand out from the corners of the base link (трёхповодковая группа).
    found: dict[str, complex] = {}
    for corner, turn in zip(corners, (215.0, 90.0, -35.0), strict=True):
        found[corner] = 0.85 * cmath.exp(1j * radians(turn))
        for bar in bars:
            if corner in bar.outline:
                end = next(node for node in bar.outline if node != corner)
                found[end] = 2.2 * cmath.exp(1j * radians(turn - 14.0))
    return found if set(found) == set(chain.net.nodes) else None


def _dyad(chain: Chain) -> dict[str, complex] | None:
    """Return the places of a dyad's joints, from the left to the right."""
    joints: tuple[Pin | Slide, ...] = (*chain.pins, *chain.slides)
    outer = [joint for joint in joints if joint.far is Far.OPEN]
    inner = next(joint for joint in joints if joint.far is Far.CHAIN)
    if len(outer) != 2 or len({joint.node for joint in outer}) != 2:
        return None
    outer.sort(key=lambda joint: isinstance(joint, Slide))
    first, last = outer
    if isinstance(inner, Pin) and inner.node not in (first.node, last.node):
        top = 1.1 + 1.25j if isinstance(last, Pin) else 1.2 + 1.0j
        return places(chain.net, {first.node: 0j, inner.node: top, last.node: 2.3 + 0j})
    if isinstance(inner, Pin):
        # The inner pin stands on one slider or on both.
        own = first if inner.node == first.node else last
        other = last if own is first else first
        return places(chain.net, {own.node: 1.0 + 0j, other.node: (0j if other is first else 2.5)})
    if inner.node in (first.node, last.node):
        return places(chain.net, {first.node: 0j, last.node: 1.5 + 1.2j})
    free = [node for node in chain.net.nodes if node not in (first.node, last.node)]
    found = {first.node: 0j, last.node: 2.2 + 0j}
    found |= dict.fromkeys(free, 1.1 + 1.1j)
    return places(chain.net, found)


def _fitted(found: Mapping[str, complex], width: float, height: float) -> dict[str, complex]:
    """Stretch places in grid units to a room in mm, a little more one way than the other."""
    xs, ys = [z.real for z in found.values()], [z.imag for z in found.values()]
    wide, tall = max(max(xs) - min(xs), 0.5), max(max(ys) - min(ys), 0.5)
    across = min(LARGEST_STEP, (width - 2 * MARGIN) / wide)
    up = min(LARGEST_STEP, (height - 2 * MARGIN) / tall)
    across, up = min(across, 1.3 * up), min(up, 1.3 * across)
    low = min(ys)
    return {name: complex(z.real * across, (z.imag - low) * up) for name, z in found.items()}


def _picture(
    chain: Chain,
    at: Mapping[str, complex],
    letter_height: float,
    driver: str = "",
    sense: int = 1,
) -> Picture:
    draft = _Draft(chain, at, letter_height)
    for shape in chain.shapes:
        draft.draw_shape(shape)
    for slide in chain.slides:
        draft.draw_slide(slide)
    for pin in chain.pins:
        draft.draw_pin(pin)
    if driver:
        draft.draw_motion(driver, sense)
    return draft.picture()


@dataclass(slots=True)
class _Draft:
    """Picture being drawn: lines, sliders over them, joints on top (чертёж цепи)."""

    chain: Chain
    at: Mapping[str, complex]
    letter_height: float
    grounds: list[Item] = field(default_factory=list)
    arms: list[Item] = field(default_factory=list)
    stones: list[Item] = field(default_factory=list)
    lines: list[Item] = field(default_factory=list)
    joints: list[Item] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    segments: list[tuple[str, complex, complex]] = field(default_factory=list)

    # Links -----------------------------------------------------------------------------------

    def draw_shape(self, shape: Shape) -> None:
        """Draw a link: a bar, a rigid polygon, and the parts that run through stones."""
        link, at = shape.link, self.at
        if len(shape.outline) == 2:
            start, end = (at[node] for node in shape.outline)
            # The line of an arm ends at the edge of the stone that it carries.
            carried = any(
                slide.stone == link and not slide.pinned and slide.node in shape.outline
                for slide in self.chain.slides
            )
            target = self.arms if carried else self.lines
            target.append(Stroke((start, end), tag=f"link {link}"))
            self.segments.append((link, start, end))
        elif shape.outline:
            ring = turned_outwards(shape.outline, at)
            corners = [at[node] for node in ring]
            self.arms += stiff_triangle(*corners, hatched=True)
            sides = zip(corners, [*corners[1:], corners[0]], strict=True)
            self.segments += [(link, a, b) for a, b in sides]
        for start_node, stone in shape.tips:
            start, through = at[start_node], at[stone]
            tip = through + unit(through - start) * (SIZES.slider_length / 2 + 5.0)
            self.lines.append(Stroke((start, tip), tag=f"link {link}"))
            self.segments.append((link, start, tip))
            others = [at[node] for node in shape.outline if node != start_node]
            others += [at[other] for _, other in shape.tips if other != stone]
            if others:
                self.lines += rigid_corner(start, through, others[0])

    def directions(self, place: complex, link: str | None = None) -> list[complex]:
        """Return the directions in which lines (of one link) leave a place, or pass it."""
        found = []
        for owner, start, end in self.segments:
            if link is not None and owner != link:
                continue
            span = abs(end - start)
            along = (end - start) / span
            foot = ((place - start) * along.conjugate()).real
            if abs(start + along * foot - place) > 0.5 or not -0.5 < foot < span + 0.5:
                continue
            if foot > 0.5:
                found.append(-along)
            if foot < span - 0.5:
                found.append(along)
        return found

    # Sliders ---------------------------------------------------------------------------------

    def draw_slide(self, slide: Slide) -> None:
        """Draw a stone and what it slides on."""
        place = self.at[slide.node]
        if slide.bar:
            along = self.directions(place, slide.bar)
            turn = along[0] if along else 1 + 0j
        else:
            turn = self._cross_direction(place, slide)
        size = 0.85 if slide.bar else 1.0
        self.stones += slider(place, angle=angle_of(turn), factor=size)
        half = SIZES.slider_length / 2 * size
        if slide.far is Far.FRAME:
            reach = half + 6.0
            self.grounds += guide_line(place, before=reach, after=reach)
            edge = place + reach - 1j * SIZES.slider_width / 2
            self._number(FRAME, edge, 1 + 0j, gap=1.2)
        elif slide.far is Far.OPEN:
            reach = half + 9.0
            for way in (turn, -turn):
                ends = (place + way * half, place + way * reach)
                self.grounds.append(Stroke(ends, Pen.HIDDEN, tag="open"))
            self._number(slide.to, place + turn * reach, turn, gap=1.2)
        if slide.text:
            self._letter(slide.text, place, 1j if turn.imag == 0 else 1 + 0j, gap=5.2)
        if not self.chain.shape(slide.stone).outline and not self.chain.shape(slide.stone).tips:
            away = 1j * turn if (1j * turn).imag >= 0 else -1j * turn
            self._number(slide.stone, place, away + 0.6 * turn, gap=5.2)

    def _cross_direction(self, place: complex, slide: Slide) -> complex:
        """Return the direction of a guide: level, or upright if a bar leaves along the level."""
        if slide.far is Far.FRAME:
            return 1 + 0j
        level = max((abs(u.real) for u in self.directions(place)), default=0.0)
        return 1j if level > 0.9 else 1 + 0j

    # Joints ----------------------------------------------------------------------------------

    def draw_pin(self, pin: Pin) -> None:
        """Draw a revolute joint with its support or its open end."""
        place = self.at[pin.node]
        busy = self.directions(place)
        busy += [
            way
            for slide in self.chain.slides
            if slide.node == pin.node and not slide.bar
            for way in (1 + 0j, -1 + 0j)
        ]
        if pin.far is Far.FRAME:
            down = _freest(busy, (-1j, -1 + 0j, 1 + 0j))
            self.grounds += fixed_pivot(place, direction=down)
            along = down * 1j
            along = along if along.real > 0 or (along.real == 0 and along.imag > 0) else -along
            foot = place + down * SIZES.support_height + along * SIZES.base / 2
            self._number(FRAME, foot, along, gap=1.2)
        elif pin.far is Far.OPEN:
            way = _freest(busy, tuple(cmath.exp(1j * radians(15 * k)) for k in range(24)))
            if len(busy) == 1:
                # The link goes on as one would expect: bent a little from the line of the lead.
                way = -busy[0] * cmath.exp(1j * radians(35 if busy[0].real < 0 else -35))
            end = place + way * STUB
            self.grounds.append(Stroke((place, end), Pen.HIDDEN, tag="open"))
            self.segments.append(("", place, end))
            self._number(pin.to, end, way, gap=0.8)
        self.joints += revolute(place)
        for k in range(1, pin.count):
            # GOST 2.770 shows a joint of several pairs by circles about one another.
            self.joints.append(Arc(place, SIZES.joint / 2 + 1.1 * k, pen=Pen.THIN))
        lines = self.directions(place)
        away = -sum(lines, 0j)
        stone = any(slide.node == pin.node for slide in self.chain.slides)
        self._letter(pin.text, place, away if abs(away) > 0.3 else 1j, gap=5.5 if stone else 2.8)

    # Motion and inscriptions -----------------------------------------------------------------

    def draw_motion(self, driver: str, sense: int) -> None:
        """Show what the driver is told to do: an arrow of ω or v."""
        for pin in self.chain.pins:
            if driver in pin.links and pin.far is Far.FRAME:
                place = self.at[pin.node]
                way = next(iter(self.directions(place, driver)), 1j)
                arrow = turn_arrow(place, 9.0, sense, middle=angle_of(way), sweep=80)
                self.grounds += arrow
                tail = place + 9.0 * way * cmath.exp(-1j * radians(40 * sense))
                self.labels.append(
                    Label(
                        typeset(f"ω_{{{driver}}}", self.letter_height),
                        tail,
                        prefer=tail - place,
                        gap=0.8,
                    )
                )
                return
        for slide in self.chain.slides:
            if slide.stone == driver and slide.far is Far.FRAME:
                start = self.at[slide.node] + 1j * (SIZES.slider_width / 2 + 3.0) - 7.0 * sense
                end = start + 14.0 * sense
                self.grounds.append(Stroke((start, end - 3.0 * sense), Pen.THIN))
                self.grounds += arrowhead(end, end - start, length=3.5, width=1.3)
                mark = typeset(f"v_{{{driver}}}", self.letter_height)
                self.labels.append(Label(mark, end, prefer=end - start, gap=1.0))

    def _number(self, link: str, place: complex, prefer: complex, *, gap: float) -> None:
        mark = typeset(link, self.letter_height)
        self.labels.append(Label(mark, place, prefer=prefer, gap=gap))

    def _letter(self, text: str, place: complex, prefer: complex, *, gap: float) -> None:
        mark = typeset(text, self.letter_height)
        self.labels.append(Label(mark, place, prefer=prefer, gap=gap, priority=1))

    def picture(self) -> Picture:
        """Number the links and put all inscriptions down."""
        longest: dict[str, tuple[complex, complex]] = {}
        for link, start, end in self.segments:
            old = longest.get(link)
            if link and (old is None or abs(end - start) > abs(old[1] - old[0]) + 1e-6):
                longest[link] = (start, end)
        for link, (start, end) in longest.items():
            self.labels.append(segment_label(link, start, end, self.letter_height))
        items = [*self.grounds, *self.arms, *self.stones, *self.lines, *self.joints]
        left, low, right, high = ink_bounds(items)
        room = (left - MARGIN, low - MARGIN, right + MARGIN, high + MARGIN)
        for placed in place_labels(self.labels, items, room):
            items += placed.items()
        return Picture(tuple(items), ink_bounds(items))


def _freest(busy: list[complex], choices: tuple[complex, ...]) -> complex:
    """Return the first of the directions that is as far as can be from all busy ones."""

    def room(way: complex) -> float:
        return round(min([abs(cmath.phase(u / way)) for u in busy] or [3.2]), 3)

    if choices[0] == -1j and room(choices[0]) > radians(50):
        return choices[0]
    return max(choices, key=room)
