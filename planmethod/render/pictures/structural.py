"""Structural pictures without scale (структурная схема, структурные группы).

Links are bars and rigid triangles, revolute pairs circles, prismatic pairs rectangles on bars, the
frame is hatched; links that replace a higher pair are dashed. A group taken apart keeps its outer
joints open: a dashed stub shows a link outside the group, with its number.
"""

from __future__ import annotations

import cmath
from collections.abc import Collection, Mapping
from functools import lru_cache
from itertools import pairwise
from math import radians
from types import MappingProxyType

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME, Mechanism, Revolute
from planmethod.mechanism.structure import Structure
from planmethod.render import symbols
from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.ink.typeset import ink_bounds, typeset
from planmethod.render.labels import Label, place_labels, segment_label
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.chains import (
    Chain,
    DrawnSlide,
    JointEnd,
    Pin,
    Shape,
    driver_chain,
    embed,
    group_chain,
    mechanism_chain,
    sort_around,
    textbook_places,
)
from planmethod.render.symbols import SIZES
from planmethod.solved.aligned.schemes import AlignedGroup, MovablePair, SelfAligning

MARGIN = 13.0
"""Margin around the joints for symbols and letters, mm."""

LARGEST_STEP = 42.0
"""Default greatest length of a grid unit, mm."""

SMALLEST_STEP = 8.0
"""Least length of a grid unit, mm: below it the symbols would overlap."""

STUB = 13.0
"""Length of the dashed stub of an open joint, mm."""


class SchemeArea(Struct, frozen=True):
    """Area that a structural scheme fills, ``width`` by ``height`` mm, and its letters.

    ``largest`` is the greatest length of a grid unit, mm: in a large area a simple mechanism does
    not fill it.
    """

    width: float
    height: float
    letter_height: float = 5.0
    largest: float = LARGEST_STEP


class Mobile(Struct, frozen=True):
    """Classes of the pairs of a scheme (подвижности пар), and how they are printed.

    Attributes
    ----------
    pairs : tuple of MovablePair
        Pairs of the picture: of the mechanism, or of a group.
    links : frozenset of str
        Moving links of the picture.
    scheme : mapping of str to str
        Class of every pair by its key.
    printed : mapping of str to str
        Classes in the letters of a language: ``3s`` is 3с in Russian.
    """

    pairs: tuple[MovablePair, ...]
    links: frozenset[str]
    scheme: Mapping[str, str]
    printed: Mapping[str, str]

    @classmethod
    def of(cls, aligned: SelfAligning, printed: Mapping[str, str]) -> Mobile:
        """Return the classes of the first scheme of a mechanism."""
        links = frozenset(link for pair in aligned.pairs for link in pair.links) - {FRAME}
        return cls(aligned.pairs, links, aligned.schemes[0], printed)

    def of_group(self, group: AlignedGroup) -> Mobile:
        """Return it for a group taken apart."""
        return replace(self, pairs=group.pairs, links=frozenset(group.links))

    def turning(self, links: Collection[str], point: str) -> list[str]:
        """Return the classes of the turning pairs of links at a point."""
        return [
            self.scheme[pair.key]
            for pair in self.pairs
            if isinstance(pair.joint, Revolute) and pair.joint.point == point
            if self.links.intersection(pair.links) <= {*links}
        ]

    def sliding(self, links: Collection[str]) -> str:
        """Return the class of the sliding pair of links; only links of the picture count."""
        return next(
            self.scheme[pair.key]
            for pair in self.pairs
            if not isinstance(pair.joint, Revolute)
            if self.links.intersection(pair.links) == self.links.intersection(links)
        )

    def mark(self, text: str, classes: Collection[str]) -> str:
        """Return a letter with the classes of its changed pairs."""
        told = [self.printed[name] for name in classes if name[0] != "1"]
        if not told:
            return text
        return f"{text}\u00a0({', '.join(told)})" if text else f"({', '.join(told)})"


def mechanism_picture(
    mechanism: Mechanism,
    structure: Structure,
    area: SchemeArea,
    *,
    senses: Mapping[str, int] | None = None,
    mobile: Mobile | None = None,
) -> Picture:
    """Return the structural scheme of a mechanism (структурная схема), mm.

    Parameters
    ----------
    senses : mapping of str to int, optional
        Sense of the motion of each driving link: 1 counter-clockwise or to the right, -1 otherwise.
        Default: 1.
    mobile : Mobile, optional
        Classes of the pairs in a scheme without redundant constraints. Default: hinges and sliders.
    """
    chain, found = _embed_mechanism(mechanism, structure)
    senses = senses or dict.fromkeys(mechanism.drivers, 1)
    return _fit_picture(chain, found, area, senses, mobile)


def driver_picture(
    mechanism: Mechanism, driver: str, area: SchemeArea, *, sense: int = 1
) -> Picture:
    """Return a driver with the frame (первичный механизм), mm."""
    chain = driver_chain(mechanism, driver)
    node = chain.graph.nodes[0]
    reach = min(38.0, area.width - 2 * MARGIN, area.height - 2 * MARGIN)
    at = {node: 0j, f"{node}>": reach * cmath.exp(1j * radians(50))}
    return _picture(chain, at, area.letter_height, {driver: sense})


def group_picture(
    mechanism: Mechanism, group: AssurGroup, area: SchemeArea, *, mobile: Mobile | None = None
) -> Picture:
    """Return a group taken apart (структурная группа), mm; outer joints open.

    ``mobile``: with the classes of its pairs in a scheme without redundant constraints.
    """
    chain, found = _embed_group(mechanism, group)
    return _fit_picture(chain, found, area, mobile=mobile)


@lru_cache(maxsize=16)
def _embed_mechanism(
    mechanism: Mechanism, structure: Structure
) -> tuple[Chain, Mapping[str, complex]]:
    """Return the chain of a mechanism and its places, cached for several sizes of a sheet."""
    chain = mechanism_chain(mechanism, structure)
    return chain, embed(chain.graph)


@lru_cache(maxsize=64)
def _embed_group(mechanism: Mechanism, group: AssurGroup) -> tuple[Chain, Mapping[str, complex]]:
    """Return the chain of a group and its places."""
    chain = group_chain(mechanism, group)
    return chain, textbook_places(chain) or embed(chain.graph)


def _fit_picture(
    chain: Chain,
    grid_places: Mapping[str, complex],
    area: SchemeArea,
    senses: Mapping[str, int] = MappingProxyType({}),
    mobile: Mobile | None = None,
) -> Picture:
    """Stretch places in grid units so that the picture with its letters fills an area, mm."""
    xs, ys = [z.real for z in grid_places.values()], [z.imag for z in grid_places.values()]
    wide, tall = max(max(xs) - min(xs), 1e-3), max(max(ys) - min(ys), 1e-3)
    about = (2 * MARGIN, 2 * MARGIN)  # estimated extent of symbols and letters
    for _ in range(3):
        across = min(area.largest, max(SMALLEST_STEP, (area.width - about[0]) / wide))
        up = min(area.largest, max(SMALLEST_STEP, (area.height - about[1]) / tall))
        across, up = min(across, 1.3 * up), min(up, 1.3 * across)
        at = {name: complex(z.real * across, z.imag * up) for name, z in grid_places.items()}
        made = _picture(chain, at, area.letter_height, senses, mobile)
        if made.width <= area.width and made.height <= area.height:
            break
        about = (made.width - across * wide + 0.5, made.height - up * tall + 0.5)
    return made


def _picture(
    chain: Chain,
    at: Mapping[str, complex],
    letter_height: float,
    senses: Mapping[str, int] = MappingProxyType({}),
    mobile: Mobile | None = None,
) -> Picture:
    draft = _Draft(chain, at, letter_height, mobile)
    for shape in chain.shapes:
        draft.draw_shape(shape)
    for slide in chain.slides:
        draft.draw_slide(slide)
    for pin in chain.pins:
        draft.draw_pin(pin)
    for driver, sense in senses.items():
        draft.draw_motion(driver, sense)
    return draft.picture()


class _Draft(Struct):
    """Picture being drawn: lines, sliders over them, joints on top (чертёж цепи)."""

    chain: Chain
    at: Mapping[str, complex]
    letter_height: float
    mobile: Mobile | None = None
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
                slide.block == link and not slide.pinned and slide.node in shape.outline
                for slide in self.chain.slides
            )
            target = self.arms if carried else self.lines
            pen = Pen.HIDDEN if link in self.chain.replacing else Pen.MAIN
            target.append(Stroke((start, end), pen, tag=f"link {link}"))
            stops = [start, *([at[shape.on]] if shape.on else []), end]
            self.segments += [(link, a, b) for a, b in pairwise(stops)]
        elif shape.outline:
            ring = sort_around(shape.outline, at)
            corners = [at[node] for node in ring]
            # Hatched under the stones; the outline reaches the pins on stones.
            *hatching, outline = symbols.rigid_polygon(*corners, hatched=True)
            self.arms += hatching
            own = any(
                slide.block == link and slide.node in shape.outline for slide in self.chain.slides
            )
            (self.arms if own else self.lines).append(outline)
            sides = zip(corners, [*corners[1:], corners[0]], strict=True)
            self.segments += [(link, a, b) for a, b in sides]
        for start_node, stone in shape.tips:
            start, through = at[start_node], at[stone]
            tip = through + symbols.unit(through - start) * (SIZES.slider_length / 2 + 5.0)
            # Above the stone that slides on it, below a stone that it carries.
            near = through - symbols.unit(through - start) * SIZES.slider_length / 2
            self.arms.append(Stroke((start, near), tag=f"link {link}"))
            self.lines.append(Stroke((near, tip), tag=f"link {link}"))
            self.segments.append((link, start, tip))
            others = [at[node] for node in shape.outline if node != start_node]
            others += [at[other] for _, other in shape.tips if other != stone]
            if others:
                self.lines += symbols.rigid_corner(start, through, others[0])

    def directions(self, place: complex, link: str | None = None) -> list[complex]:
        """Return the directions of lines (of one link) that leave or pass a place."""
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

    def draw_slide(self, slide: DrawnSlide) -> None:
        """Draw a stone and its guide."""
        place = self.at[slide.node]
        if slide.bar:
            along = self.directions(place, slide.bar)
            turn = along[0] if along else 1 + 0j
        else:
            turn = self._cross_direction(place, slide)
        size = 0.85 if slide.bar else 1.0
        text, name = slide.text, ""
        if self.mobile is not None:
            name = self.mobile.sliding((slide.block, slide.bar))
            text = self.mobile.mark(text, (name,))
        angle = symbols.angle_of(turn)
        ground = slide.joint_end is JointEnd.FRAME
        self.stones += symbols.mobile_slider(place, name, angle=angle, factor=size, ground=ground)
        half = SIZES.slider_length / 2 * size
        if slide.joint_end is JointEnd.FRAME:
            reach = half + 6.0
            self.grounds += symbols.guide_line(place, before=reach, after=reach)
            edge = place + reach - 1j * SIZES.slider_width / 2
            self._number(slide.to, edge, 1 + 0j, gap=1.2)
        elif slide.joint_end is JointEnd.OPEN:
            reach = half + 9.0
            for way in (turn, -turn):
                ends = (place + way * half, place + way * reach)
                self.grounds.append(Stroke(ends, Pen.HIDDEN, tag="open"))
            self._number(f"({slide.to})", place + turn * reach, turn, gap=1.2)
        if text:
            if slide.joint_end is JointEnd.FRAME:
                self._letter(text, place - half, -1 + 0j, gap=1.2)
            else:
                lines = -sum(self.directions(place), 0j)
                self._letter(text, place, lines if abs(lines) > 0.3 else 1j * turn, gap=5.4)
        if not self.chain.shape(slide.block).outline and not self.chain.shape(slide.block).tips:
            if slide.joint_end is JointEnd.FRAME:
                self._number(slide.block, place + half, 1 + 0j, gap=1.2)
            else:
                # Beside an end of the stone, away from its letter.
                lean = -sum(self.directions(place), 0j)
                end = -turn if (lean * turn.conjugate()).real > 0 else turn
                away = 1j * turn if (1j * turn).imag >= 0 else -1j * turn
                self._number(slide.block, place + end * 3.0, end + 1.6 * away, gap=4.0)

    def _cross_direction(self, place: complex, slide: DrawnSlide) -> complex:
        """Return the direction of a guide: level, or upright if a bar leaves along the level."""
        if slide.joint_end is JointEnd.FRAME:
            return 1 + 0j
        opened = [other for other in self.chain.slides if other.joint_end is JointEnd.OPEN]
        if len(opened) == 2 and opened[0] is slide:
            return 1j  # two parallel guides would let the group slip
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
        if pin.joint_end is JointEnd.FRAME:
            down = _freest(busy, (-1j, -1 + 0j, 1 + 0j))
            self.grounds += symbols.fixed_pivot(place, direction=down)
            along = down * 1j
            along = along if along.real > 0 or (along.real == 0 and along.imag > 0) else -along
            foot = place + down * SIZES.support_height + along * SIZES.base / 2
            self._number(pin.to, foot, along, gap=1.2)
        elif pin.joint_end is JointEnd.OPEN:
            way = _freest(busy, tuple(cmath.exp(1j * radians(15 * k)) for k in range(24)))
            if len(busy) == 1:
                # Bent a little from the line of the leg, and upright: groups are side by side.
                bends = [-busy[0] * cmath.exp(1j * radians(turn)) for turn in (35, -35)]
                way = max(bends, key=lambda bend: round(abs(bend.imag), 6))
            on_stone = any(slide.node == pin.node for slide in self.chain.slides)
            end = place + way * (STUB + (4.0 if on_stone else 0.0))
            self.grounds.append(Stroke((place, end), Pen.HIDDEN, tag="open"))
            self.segments.append(("", place, end))
            self._number(f"({pin.to})", end, way, gap=0.8)
        lines = self.directions(place)
        away = -sum(lines, 0j)
        text = pin.text
        if self.mobile is None:
            self.joints += symbols.revolute(place, count=pin.count)
        else:
            found = self.mobile.turning(pin.links, pin.node)
            text = self.mobile.mark(text, found)
            opening = lines[-1] if lines else 1j
            self.joints += symbols.revolute(place, count=pin.count)[: 2 * (pin.count - 1)]
            self.joints += symbols.mobile_revolute(place, max(found), opening=opening)
        stone = any(slide.node == pin.node for slide in self.chain.slides)
        self._letter(text, place, away if abs(away) > 0.3 else 1j, gap=5.5 if stone else 2.8)

    # Motion and inscriptions -----------------------------------------------------------------

    def draw_motion(self, driver: str, sense: int) -> None:
        """Show the given motion of the driver: an arrow of ω or v."""
        for pin in self.chain.pins:
            if driver in pin.links and pin.joint_end is JointEnd.FRAME:
                place = self.at[pin.node]
                way = next(iter(self.directions(place, driver)), 1j)
                # Ahead of the crank, so that the arrow does not cross it; outside a stone.
                stone = any(slide.node == pin.node for slide in self.chain.slides)
                middle = way * cmath.exp(1j * radians((-48 if stone else 48) * sense))
                radius = 13.0 if stone else 10.0
                self.grounds += symbols.turn_arrow(
                    place, radius, sense, middle=symbols.angle_of(middle), sweep=76
                )
                tail = place + radius * middle
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
            if slide.block == driver and slide.joint_end is JointEnd.FRAME:
                place = self.at[slide.node]
                # Over the half of the slider that the link on its pin leaves free.
                lean = sum(self.directions(place), 0j).real
                middle = place - (7.5 if lean >= 0 else -7.5) + 1j * (SIZES.slider_width / 2 + 3.0)
                middle = middle if self.directions(place) else middle + 7.5
                start, end = middle - 6.0 * sense, middle + 6.0 * sense
                self.grounds += symbols.straight_arrow(start, end)
                mark = typeset(f"v_{{{driver}}}", self.letter_height)
                self.labels.append(Label(mark, end, prefer=end - start, gap=1.0))

    def _number(self, link: str, place: complex, prefer: complex, *, gap: float) -> None:
        mark = typeset(link, self.letter_height)
        self.labels.append(Label(mark, place, prefer=prefer, gap=gap))

    def _letter(self, text: str, place: complex, prefer: complex, *, gap: float) -> None:
        mark = typeset(text, self.letter_height)
        self.labels.append(Label(mark, place, prefer=prefer, gap=gap, priority=1))

    def picture(self) -> Picture:
        """Return the picture with the links numbered and all inscriptions placed."""
        longest: dict[str, tuple[complex, complex]] = {}
        for link, start, end in self.segments:
            old = longest.get(link)
            if link and (old is None or abs(end - start) > abs(old[1] - old[0]) + 1e-6):
                longest[link] = (start, end)
        for link, (start, end) in longest.items():
            self.labels.append(segment_label(link, start, end, self.letter_height))
        items = symbols.before_links(
            [*self.grounds, *self.arms, *self.stones, *self.lines, *self.joints]
        )
        left, low, right, high = ink_bounds(items)
        room = (left - MARGIN, low - MARGIN, right + MARGIN, high + MARGIN)
        for placed in place_labels(self.labels, items, room):
            items += placed.items()
        return Picture(tuple(items), ink_bounds(items))


def _freest(busy: list[complex], choices: tuple[complex, ...]) -> complex:
    """Return the first of the directions that are furthest from all busy ones."""

    def clearance(direction: complex) -> float:
        return round(min([abs(cmath.phase(u / direction)) for u in busy] or [3.2]), 3)

    if choices[0] == -1j and clearance(choices[0]) > radians(50):
        return choices[0]
    return max(choices, key=clearance)
