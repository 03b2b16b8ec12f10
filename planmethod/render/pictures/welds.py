"""Rods rigid with a block (жёсткое соединение стержня с ползуном)."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct
from msgspec.structs import replace
from shapely import LineString, Polygon

from planmethod.render import symbols
from planmethod.render.ink.drawing import Item, Stroke
from planmethod.render.symbols import SIZES, unit

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
    outline = Polygon([(p.real, p.imag) for p in block.corners])
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
                    welds += _wedges(block, at, unit(away - at), factor)
    return left, welds


def _wedges(block: BlockOutline, at: complex, away: complex, factor: float) -> list[Item]:
    """Return the two filled wedges between a rod and the edge that it leaves."""
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
            found += symbols.rigid_corner(
                at, at + 2 * room * away, at + 2 * side * room * edge, factor=factor
            )
    return found
