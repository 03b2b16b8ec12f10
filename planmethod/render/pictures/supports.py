"""Placement of supports and guides on a scheme; rods rigid with a block."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Sequence
from itertools import combinations
from math import pi, radians, sin, tau
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace
from shapely import LineString, MultiLineString, Point, Polygon, unary_union

from planmethod.render import symbols
from planmethod.render.ink.drawing import Fill, Item, Stroke
from planmethod.render.symbols import SIZES, fixed_pivots, support_half_width, unit

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry


DIRECTION_COSTS: tuple[tuple[complex, float], ...] = (
    (-1j, 0.0),
    (1j, 4.0),
    (-1 + 0j, 5.0),
    (1 + 0j, 5.0),
)
"""Directions from a pivot to its base, and their costs in mm of line under it."""

_LINE_GAP = 2.0  # mm: white wished between a support and a line
_SUPPORT_GAP = 0.5  # mm: the same between two supports, from either
_JOINED = 1.0  # cost of a common base instead of two
_OVERLAP = 10.0  # cost of two overlapping supports, plus 1 for each mm²
_ON_PIVOT = 30.0  # a base over another pivot
_MIN_HALF_WIDTH = 1.5  # mm: half the width of the narrowest support on a common base
_MAX_STEP = 6.0  # mm: largest difference of height of two pivots on one base
_SMALLER = 0.65  # size of supports that overlap nevertheless


class Support(Struct, frozen=True):
    """Pivots on one hatched base (опора).

    Attributes
    ----------
    places : tuple of complex, mm
        One pivot, or several on a common base.
    direction : complex
        From the pivots to the base, a unit vector.
    factor : float
        Size against the symbols of `SIZES`.
    """

    places: tuple[complex, ...]
    direction: complex
    factor: float = 1.0

    def items(self) -> list[Item]:
        """Return the legs and the hatched base; the joints are drawn over the links."""
        return fixed_pivots(self.places, direction=self.direction, factor=self.factor, joints=False)


def place_supports(
    pivots: Sequence[complex], drawn: Iterable[Item], *, factor: float = 1.0
) -> list[Support]:
    """Choose the supports of the pivots of a scheme (выбор опор).

    Parameters
    ----------
    pivots : sequence of complex, mm
        Distinct places.
    drawn : iterable of Item
        Drawn links and sliders, of which only lines count.
    factor : float
        Size of the symbols.

    Returns
    -------
    list of Support
        Each pivot is in one of them.
    """
    lines = _lines(drawn)
    ways = [
        {way: dislike + _under(lines, at, way, factor) for way, dislike in DIRECTION_COSTS}
        for at in pivots
    ]
    chosen = [min(own, key=lambda way: own[way]) for own in ways]
    for _ in range(2):
        for k, own in enumerate(ways):
            others = [j for j in range(len(pivots)) if j != k]

            def cost(direction: complex, k: int = k, other_pivots: list[int] = others) -> float:
                near = (
                    _against(pivots[k], direction, pivots[j], chosen[j], factor)
                    for j in other_pivots
                )
                return ways[k][direction] + sum(near)

            chosen[k] = min(own, key=cost)
    return _grouped(pivots, chosen, factor)


def free_sides(
    at: complex,
    drawn: Iterable[Item],
    *,
    angle: float,
    length: float,
    width: float = SIZES.slider_width,
    factor: float = 1.0,
) -> tuple[int, ...]:
    """Return the sides of a slider on which no lines cross a guide's plate.

    The arguments are those of `guide_plates`; both sides if neither is free, since a slider needs a
    guide.
    """
    lines = _lines(drawn)
    turn = cmath.exp(1j * radians(angle))
    half, edge = length / 2 * factor, width / 2 * factor
    deep = edge + SIZES.hatch_stroke * sin(pi / 4) * factor
    free = []
    for side in (1, -1):
        corners = [
            at + turn * (x + 1j * side * y)
            for x, y in ((-half, edge), (half, edge), (half, deep), (-half, deep))
        ]
        plate = Polygon([(p.real, p.imag) for p in corners]).buffer(0.4)
        if lines is None or not lines.intersects(plate):
            free.append(side)
    return tuple(free) or (1, -1)


def _lines(drawn: Iterable[Item]) -> BaseGeometry | None:
    paths = [
        [(p.real, p.imag) for p in ((*item.points, item.points[0]) if item.closed else item.points)]
        for item in drawn
        if isinstance(item, Stroke) and len(item.points) > 1
    ]
    return MultiLineString(paths) if paths else None


def _ground(at: complex, direction: complex, factor: float) -> BaseGeometry:
    """Return the area of a support: legs, base and hatching, from the edge of the joint on."""
    top = SIZES.joint * 0.8 * factor
    foot = SIZES.support_height * factor
    deep = foot + SIZES.hatch_stroke * sin(pi / 4) * factor
    base, neck = SIZES.base / 2 * factor, SIZES.joint * 0.4 * factor
    outline = ((top, -neck), (foot, -base), (deep, -base), (deep, base), (foot, base), (top, neck))
    corners = [at + direction * (x + 1j * y) for x, y in outline]
    return Polygon([(p.real, p.imag) for p in corners])


def _under(lines: BaseGeometry | None, at: complex, direction: complex, factor: float) -> float:
    """Return the length of lines under or near a support, mm."""
    if lines is None:
        return 0.0
    ground = _ground(at, direction, factor).buffer(_LINE_GAP * factor, quad_segs=2)
    return round(float(lines.intersection(ground).length), 3)


def _meet(
    one: complex, direction: complex, two: complex, other_direction: complex, factor: float
) -> float:
    """Return the overlap of two supports, mm²."""
    if abs(one - two) > 3 * SIZES.base * factor:
        return 0.0
    first = _ground(one, direction, factor).buffer(_SUPPORT_GAP, quad_segs=2)
    second = _ground(two, other_direction, factor).buffer(_SUPPORT_GAP, quad_segs=2)
    return float(first.intersection(second).area)


def _joinable(one: complex, two: complex, direction: complex, factor: float) -> bool:
    """Return whether two pivots can share a base."""
    step = abs(((one - two) * direction.conjugate()).real)
    foot = support_half_width((one, two), direction=direction, factor=factor)
    return step <= _MAX_STEP * factor and foot >= _MIN_HALF_WIDTH * factor


def _against(
    one: complex, direction: complex, two: complex, other_direction: complex, factor: float
) -> float:
    """Return the cost of two supports beside each other, mm of line."""
    area = _meet(one, direction, two, other_direction, factor)
    if direction == other_direction and _joinable(one, two, direction, factor):
        return _JOINED if area > 0.0 else 0.0
    joint = Point(two.real, two.imag).buffer(SIZES.joint * factor, quad_segs=4)
    if abs(one - two) < 3 * SIZES.base * factor and _ground(one, direction, factor).intersects(
        joint
    ):
        return _ON_PIVOT + area
    return _OVERLAP + area if area > 0.0 else 0.0


def _grouped(pivots: Sequence[complex], chosen: Sequence[complex], factor: float) -> list[Support]:
    """Join the pivots whose supports overlap, or make the supports smaller."""
    group = list(range(len(pivots)))
    small: set[int] = set()
    for i, j in combinations(range(len(pivots)), 2):
        if _meet(pivots[i], chosen[i], pivots[j], chosen[j], factor) <= 0.0:
            continue
        if chosen[i] == chosen[j] and _joinable(pivots[i], pivots[j], chosen[i], factor):
            old, new = group[j], group[i]
            group = [new if own == old else own for own in group]
        else:
            small |= {i, j}
    found = []
    for own in dict.fromkeys(group):
        members = [k for k in range(len(pivots)) if group[k] == own]
        size = factor * _SMALLER if small & set(members) else factor
        places = tuple(pivots[k] for k in members)
        found.append(Support(places, chosen[members[0]], size))
    return found


_MIN_PIECE = 0.5  # mm: shorter pieces of a rod beyond the edge of its block are not drawn


class BlockOutline(Struct, frozen=True):
    """Outline of a slider or stone on the paper: its middle, direction and sizes, mm."""

    middle: complex
    direction: complex
    length: float
    width: float

    @property
    def corners(self) -> tuple[complex, ...]:
        """Corners in order."""
        half, tall = self.direction * self.length / 2, 1j * self.direction * self.width / 2
        ways = (-half - tall, half - tall, half + tall, tall - half)
        return tuple(self.middle + way for way in ways)

    @property
    def axis(self) -> tuple[complex, complex]:
        """Ends of its middle line."""
        half = self.direction * self.length / 2
        return self.middle - half, self.middle + half

    @property
    def area(self) -> Polygon:
        """The rectangle."""
        return Polygon([(p.real, p.imag) for p in self.corners])

    def covers(self, block: BlockOutline) -> bool:
        """Return whether the middle of another block lies within this one."""
        way = (block.middle - self.middle) * self.direction.conjugate()
        return abs(way.real) < self.length / 2 and abs(way.imag) < self.width / 2


def welded(
    lines: Sequence[Item], tag: str, block: BlockOutline, factor: float
) -> tuple[list[Item], list[Item]]:
    """Return lines whose rods of one link end at the edge of its block, and the welds there.

    A rod that ends within the block, or goes on through it, is fixed to the edge by two wedges;
    within the block it is not drawn, since it would look hinged there.

    Parameters
    ----------
    lines : sequence of Item
        Those of a whole scheme; the rods have the ``tag``.
    """
    outline = block.area
    left: list[Item] = []
    welds: list[Item] = []
    for item in lines:
        if not isinstance(item, Stroke) or item.tag != tag:
            left.append(item)
            continue
        path = (*item.points, item.points[0]) if item.closed else item.points
        line = LineString([(p.real, p.imag) for p in path])
        rest = line.difference(outline)
        if item.closed or line.disjoint(outline) or rest.is_empty:
            left.append(item)
            continue
        for part in getattr(rest, "geoms", [rest]):
            points = tuple(complex(x, y) for x, y in part.coords)
            if part.length < _MIN_PIECE:
                continue
            left.append(replace(item, points=points))
            for at, away in ((points[0], points[1]), (points[-1], points[-2])):
                if outline.exterior.distance(LineString([(at.real, at.imag)] * 2)) < 1e-6:
                    welds += _wedges(block, at, away - at, factor, tag)
    return left, welds


def _wedges(block: BlockOutline, at: complex, away: complex, factor: float, tag: str) -> list[Item]:
    """Return the two filled wedges between a rod and the edge that it leaves.

    They end with the rod: beyond the joint at its end they would be on other links.
    """
    way = (at - block.middle) * block.direction.conjugate()
    beyond = abs(way.real) / block.length - abs(way.imag) / block.width
    edge = block.direction * 1j if beyond > 0 else block.direction
    half = block.width / 2 if beyond > 0 else block.length / 2
    aside = ((at - block.middle) * edge.conjugate()).real
    found: list[Item] = []
    for side in (-1, 1):
        # As wide as the edge on this side, but no wider than a rigid corner.
        room = min(half - side * aside, SIZES.corner * factor)
        if room > 0.3:
            point = at + unit(away) * min(room, abs(away))
            found.append(Fill((at, point, at + side * room * edge), tag=f"{_WELD}{tag}"))
    return found


_WELD = "weld of "
"""Beginning of the tag of a wedge between a rod and its block."""


def free_welds(corners: Iterable[Item], tag: str, barred: BaseGeometry) -> list[Item]:
    """Return corners without the wedges of a link that another link crosses.

    One wedge of a rod is enough; if both are crossed, both are left.
    """
    left: list[Item] = []
    wedges: dict[complex, list[Fill]] = {}
    for item in corners:
        if isinstance(item, Fill) and item.tag == f"{_WELD}{tag}":
            wedges.setdefault(item.points[0], []).append(item)
        else:
            left.append(item)
    for pair in wedges.values():
        shapes = [Polygon([(p.real, p.imag) for p in wedge.points]) for wedge in pair]
        free = [
            wedge
            for wedge, shape in zip(pair, shapes, strict=True)
            if shape.intersection(barred).length < _CLEAR
        ]
        left += free or pair
    return left


class Piece(Struct, frozen=True):
    """Part of a link that goes on through a joint in one piece: its place and two directions."""

    at: complex
    one: complex
    two: complex

    def side_of(self, lines: Sequence[complex]) -> tuple[complex, complex] | None:
        """Return the side with all other links, as directions counter-clockwise.

        The lower side if no lines leave it. None if they are on both sides, or where the side is
        too narrow to show a joint.
        """
        sides = [(self.one, self.two), (self.two, self.one)]
        for start, end in sorted(sides, key=lambda side: ((side[0] - side[1]) * 1j).imag):
            sweep = cmath.phase(end / start) % tau
            if sweep > _MIN_SIDE and all(cmath.phase(line / start) % tau < sweep for line in lines):
                return start, end
        return None


_MIN_SIDE = radians(100)  # least angle of a bend beside which half a joint is seen
_CLEAR = 0.5  # mm: white between a rigid corner and a line of another link
_STRAIGHT = sin(radians(4))  # sine of the angle of a bend that is not seen


def leaving(
    place: complex, parts: Iterable[tuple[complex, complex]]
) -> list[tuple[complex, float]]:
    """Return the directions in which lines leave a place or pass it, and how far they go, mm."""
    found = []
    for start, end in parts:
        for one, other in ((start, end), (end, start)):
            if abs(one - place) < 0.5:
                found.append((unit(other - one), abs(other - one)))
        inside = ((place - start) * (end - start).conjugate()).real
        off = abs(((place - start) * (end - start).conjugate()).imag)
        span = abs(end - start)
        if 0.5 * span < inside < span * (span - 0.5) and off < 0.5 * span:
            along = unit(end - start)
            found += [(along, abs(end - place)), (-along, abs(start - place))]
    return found


def obstacles(
    lines: Iterable[Item], blocks: Iterable[BlockOutline] = (), supports: Iterable[Support] = ()
) -> BaseGeometry:
    """Return what a rigid corner of a link must not touch: the other links and the frame."""
    ground = [item for support in supports for item in support.items()]
    drawn = _lines([*lines, *ground])
    shapes = [block.area.boundary for block in blocks]
    return unary_union([*shapes, *([] if drawn is None else [drawn])])


def rigid_arms(
    place: complex,
    parts: Sequence[tuple[complex, complex]],
    closed: Iterable[Sequence[complex]],
    blocks: Sequence[BlockOutline],
    barred: BaseGeometry,
    *,
    radius: float,
    factor: float,
    tag: str,
) -> tuple[list[Item], list[Piece]]:
    """Return how the lines of one link that meet in a place are shown to be one body.

    Lines that continue each other go through the joint in one piece. An angle has a filled corner
    if it is seen beside the joint of ``radius`` and touches no other link, which would look rigid
    too; else it goes through the joint in one piece. The sides of a closed polygon, and lines
    within a block of the link, need no sign; lines that begin beside a block are filled up to it.

    Parameters
    ----------
    parts : sequence of (complex, complex), mm
        Lines of the link.
    closed : iterable
        Its polygons.
    blocks : sequence of BlockOutline
        The blocks that it is rigid with.
    barred : geometry
        See `obstacles`.
    """
    spot = Point(place.real, place.imag)
    if any(block.area.distance(spot) < 1e-6 for block in blocks):
        return [], []
    arms: list[_Arm] = []
    for way, length in sorted(leaving(place, parts), key=lambda arm: -arm[1]):
        if all(abs(way - old.direction) > _STRAIGHT for old in arms):
            arms.append(_Arm(way, place, length, len(arms)))
    for block in blocks:
        if block.area.distance(spot) > radius + factor:
            continue
        # The line between joint and block is too short to be seen.
        into = [arm for arm in arms if abs(arm.direction - unit(block.middle - place)) < _STRAIGHT]
        foot = place + (block.middle - place) * (1 - block.width / 2 / abs(block.middle - place))
        ways = (block.direction, -block.direction) if into else ()
        arms += [_Arm(way, foot, block.length, into[0].body) for way in ways]
    for polygon in closed:
        sides = [
            arm.body
            for arm in arms
            for k, corner in enumerate(polygon)
            for next_corner in (polygon[k - 1], polygon[(k + 1) % len(polygon)])
            if abs(corner - place) < _CLEAR
            and abs(arm.direction - unit(next_corner - corner)) < _STRAIGHT
        ]
        _unite(arms, sides)
    marks: list[Item] = []
    pieces: list[Piece] = []
    pairs = sorted(
        combinations(arms, 2), key=lambda pair: -abs(pair[0].direction + pair[1].direction)
    )
    straight = [(a, b) for a, b in pairs if abs(a.direction + b.direction) < _STRAIGHT]
    for a, b in straight:
        if a.start == b.start == place:
            pieces.append(Piece(place, a.direction, b.direction))
            _unite(arms, [a.body, b.body])
    for a, b in pairs:
        if a.body != b.body:
            found = _corner_between(a, b, place, barred, radius=radius, factor=factor, tag=tag)
            if found is not None:
                marks.append(found)
                _unite(arms, [a.body, b.body])
    for a, b in reversed(pairs):
        if a.body != b.body and a.start == b.start == place:
            pieces.append(Piece(place, a.direction, b.direction))
            _unite(arms, [a.body, b.body])
    return marks, pieces


class _Arm(Struct):
    """Line of a link from a joint, or the edge of its block: direction, start, length, body."""

    direction: complex
    start: complex
    length: float
    body: int


def _unite(arms: Iterable[_Arm], numbers: Sequence[int]) -> None:
    """Make one body of some."""
    for arm in arms:
        if arm.body in numbers:
            arm.body = numbers[0]


def _corner_between(
    one: _Arm,
    two: _Arm,
    place: complex,
    barred: BaseGeometry,
    *,
    radius: float,
    factor: float,
    tag: str,
) -> Fill | None:
    """Return the filled corner between two arms, if it is seen and free."""
    ends = (place + arm.direction * arm.length for arm in (one, two))
    for mark in symbols.rigid_corner(place, *ends, factor=factor, radius=radius):
        if isinstance(mark, Fill):
            legs = [point - place for point in mark.points[1:]]
            around = (place, one.start, one.start + legs[0], two.start + legs[1], two.start)
            points = tuple(dict.fromkeys(around))
            area = Polygon([(p.real, p.imag) for p in points]).buffer(_CLEAR)
            seen = area.difference(Point(place.real, place.imag).buffer(radius + _CLEAR))
            if not seen.intersects(barred):
                return Fill(points, tag=tag)
    return None
