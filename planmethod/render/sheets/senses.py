"""Small pictures of senses (направления ω, ε и кориолисова ускорения).

A vector that is carried to its point shows how a link turns; a relative velocity that is turned by
90° in the sense of ω shows the direction of a Coriolis acceleration.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Sequence
from itertools import combinations
from math import radians

from planmethod.construct.steps import PointName
from planmethod.note.narrate.naming import point_name
from planmethod.plans.model import PlanKind
from planmethod.plans.motion.legs import Relative, Turning
from planmethod.problem.model import Slide
from planmethod.render.forces.cut import FreeBodyScheme, drawn_items, letters_of
from planmethod.render.ink.drawing import Disc, Ink, Item
from planmethod.render.ink.typeset import typeset, vector_markup
from planmethod.render.labels import Label
from planmethod.render.layout.block import Block, Column, Picture, Row, heading, make_alternatives
from planmethod.render.layout.groups import GAP
from planmethod.render.pictures.lettered import lettered
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.views import named, shown_position
from planmethod.render.symbols import SIZES, angle_of, turn_arrow, unit, vector_arrow
from planmethod.solved.solution import Solution

SENSE = "sense"
"""Tag of the vectors of these pictures, which are not to scale."""

_VECTOR = 18.0  # length of a vector, mm
_RADIUS = 9.0  # of a curved arrow, mm
_SIZE, _ARM = 40.0, 16.0  # largest size of a link, and least length of its arm, mm
_LEAST = 0.3  # mm: a shorter vector of a plan has no direction on the paper


def senses_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the pictures of one position, in several numbers of columns.

    Those of velocities show the senses of ω, those of accelerations the Coriolis accelerations and
    the senses of ε.
    """
    index, language = shown_position(solution, position_indices, style), style.language
    shown = [
        named(picture, language.sheets.sense_of.format(symbol=symbol), (), style)
        for symbol, picture in _pictures(solution, index, style)
    ]
    if not shown:
        return Column([])
    title = style.entry.title
    if len(solution.positions) > 1:
        title = language.sheets.of_position.format(
            title=title or language.sheets.senses, number=index
        )
    head = [heading(title, style.title)] if title else []
    ways = []
    for count in range(1, len(shown) + 1):
        rows = [Row(shown[k : k + count], GAP) for k in range(0, len(shown), count)]
        ways.append(ViewBlock(Column([*head, *rows], gap=GAP, align="centre"), "senses", None))
    return make_alternatives(ways)


def _pictures(solution: Solution, index: int, style: BlockStyle) -> Iterator[tuple[str, Picture]]:
    """Yield the pictures with the symbols whose senses they show."""
    kind, kinematics = style.entry.of, solution.construction.kinematics
    assert kind is not None
    if kind is PlanKind.ACCELERATION:
        for relative in kinematics.relatives.values():
            if relative.a_coriolis is not None and relative.a_start != relative.a_coriolis:
                yield from _coriolis(solution, index, relative, style)
    for (of, link), turning in kinematics.turnings.items():
        if of is kind:
            yield from _turning(solution, index, kind, link, turning, style)


class _SmallLink(FreeBodyScheme):
    """A link that is drawn at a part of the scale of the position plan (звено отдельно, мельче)."""

    part: float = 1.0

    @classmethod
    def drawn_small(
        cls, solution: Solution, index: int, height: float, link: str, arm: tuple[str, str]
    ) -> _SmallLink:
        """Return a link so small that its arm between two points still has room for arrows."""
        whole = cls(solution, index, height, links=(link,))
        whole.draw()
        ends = [end for parts in whole.segments.values() for part in parts for end in part]
        size = max((abs(p - q) for p, q in combinations(ends, 2)), default=0.0)
        reach = abs(whole.at(arm[1]) - whole.at(arm[0]))
        part = min(1.0, max(_SIZE / max(size, _SIZE), _ARM / max(reach, _LEAST)))
        return cls(solution, index, height, links=(link,), part=part)

    def at(self, point: str) -> complex:
        """Return the place of a point, mm."""
        return self.part * super().at(point)

    def _reaches(self, slide: Slide) -> tuple[float, float]:
        low, high = super()._reaches(slide)
        return self.part * low, self.part * high


def _turning(
    solution: Solution, index: int, kind: PlanKind, link: str, turning: Turning, style: BlockStyle
) -> Iterator[tuple[str, Picture]]:
    """Yield a link with the vector that turns it, carried to its point, and its curved arrow."""
    vector = _segment(solution, index, turning.start, turning.head)
    if abs(vector) < _LEAST:
        return
    height, letter = style.letter, "ω" if kind is PlanKind.VELOCITY else "ε"
    scheme = _SmallLink.drawn_small(solution, index, height, link, (turning.joint, turning.place))
    items, prefix = drawn_items(scheme), f"sense {letter} {link}"
    joint, place = scheme.at(turning.joint), scheme.at(turning.place)
    arm = place - joint
    sense = 1 if (arm.conjugate() * vector).imag > 0 else -1
    labels = letters_of(scheme, prefix, (link,))
    for name, at in ((turning.joint, joint), (turning.place, place)):
        if all(abs(scheme.at(other) - at) > _LEAST for other in scheme.named):
            items.append(Disc(at, 0.8 * scheme.factor, Ink.BLACK))
            labels.append(Label(typeset(point_name(name), height), at, gap=1.5))
    symbol = f"{letter}_{{{link}}}"
    ends, gap = (turning.start, turning.head), SIZES.joint / 2 * scheme.factor
    arrow = _arrow(solution, kind, ends, place, unit(vector), height, gap)
    middle = angle_of(arm) + 65.0 * sense
    curve = _curve(joint, sense, middle, symbol, height)
    for drawn, label in (arrow, curve):
        items += drawn
        labels.append(label)
    yield symbol, lettered(items, labels)


def _coriolis(
    solution: Solution, index: int, relative: Relative, style: BlockStyle
) -> Iterator[tuple[str, Picture]]:
    """Yield a relative velocity and the Coriolis acceleration, 90° from it in the sense of ω."""
    assert relative.a_start is not None
    assert relative.a_coriolis is not None
    ends = (relative.a_start, relative.a_coriolis)
    turned = _segment(solution, index, *ends)
    along = _segment(solution, index, relative.start, relative.head)
    if min(abs(turned), abs(along)) < _LEAST:
        return
    sense, height = 1 if (along.conjugate() * turned).imag > 0 else -1, style.letter
    speed = (relative.start, relative.head)
    # The letter of the formula: links that turn together have one number.
    omega = solution.construction.kinematics.omega[relative.to].partition("_")[2]
    parts = [
        _arrow(solution, PlanKind.VELOCITY, speed, 0j, unit(along), height),
        _arrow(solution, PlanKind.ACCELERATION, ends, 0j, unit(turned), height),
        _curve(0j, sense, angle_of(along) + 45.0 * sense, f"ω_{{{omega}}}", height, 60.0),
    ]
    items = [item for drawn, _ in parts for item in drawn]
    picture = lettered([*items, Disc(0j, 0.7, Ink.BLACK)], [label for _, label in parts])
    yield _symbol(solution, PlanKind.ACCELERATION, ends), picture


def _segment(solution: Solution, index: int, tail: PointName, head: PointName) -> complex:
    """Return a segment of a plan in a position, mm."""
    return complex(solution.paper.point(head)[index] - solution.paper.point(tail)[index])


def _symbol(solution: Solution, kind: PlanKind, ends: tuple[PointName, PointName]) -> str:
    """Return the letters of the vector of a segment, with its bar."""
    vectors = solution.construction.plan(kind).vectors
    return next(vector_markup(v.symbol) for v in vectors if (v.tail, v.head) == ends)


def _arrow(
    solution: Solution,
    kind: PlanKind,
    ends: tuple[PointName, PointName],
    start: complex,
    direction: complex,
    height: float,
    gap: float = 0.0,
) -> tuple[list[Item], Label]:
    """Return a vector from a place, not to scale, and its name; it begins ``gap`` mm off."""
    symbol, tip = _symbol(solution, kind, ends), start + _VECTOR * direction
    items = vector_arrow(start + gap * direction, tip, tag=SENSE)
    name = f"sense {symbol}"
    label = Label(typeset(symbol, height), (start + tip) / 2, (start, tip), gap=1.0, name=name)
    return items, label


def _curve(
    centre: complex, sense: int, middle: float, symbol: str, height: float, sweep: float = 90.0
) -> tuple[list[Item], Label]:
    """Return a curved arrow about a place, its middle at an angle, degrees, and its letter."""
    items = turn_arrow(centre, _RADIUS, sense, middle=middle, sweep=sweep, tag=SENSE)
    way = cmath.rect(1.0, radians(middle))
    at = centre + _RADIUS * way
    return items, Label(typeset(symbol, height), at, prefer=way, gap=1.2, name=f"sense {symbol}")
