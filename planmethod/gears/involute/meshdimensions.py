"""Dimensions on the picture of a mesh (размеры на картине зацепления): p, s, e, h, c, r, breaks.

The pitch and its parts are placed along the reference circle of wheel 1 on the side without letters
of circles, the height of the tooth beside the teeth of wheel 2, the clearance on the line of
centres; the radii run from the centres, between the line of centres and the base radius.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import pi, sqrt
from typing import TypeAlias

import numpy as np

from planmethod.gears.involute.meshpicture import MeshView, draws_limit_point
from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.symbols import arrowhead
from planmethod.render.symbols.axes import wavy_line
from planmethod.render.symbols.dimensions import angle_dimension, dimension

Named: TypeAlias = list[tuple[str, complex, complex]]
"""Letters, their places, and their preferred sides."""

TAG = "dimension"

_DOWN = (9.0, 18.0)  # mm: from the root circle to the dimensions of s and e, and to that of p
_TAIL = 1.5  # mm: of an extension line beyond the dimension line
_HEIGHT_OFFSET = 4.0  # mm: from the outermost tooth to the dimension of its height
_BREAK = 16.0  # mm: length of a line of break
_HEAD = 2.5  # mm: arrowhead of a radius
_RADIUS_REACH = 3.6  # half pitches: distance of the tip radius from the line of centres, times 1.5
_NAMED = {"f": 0.55, "a": 0.4}  # places of letters along their radii
_OUT = 9.0  # mm: from the line of centres to the dimension of the clearance


def mesh_dimensions(view: MeshView, height: float) -> tuple[list[Item], list[Label]]:
    """Return the dimensions of a picture and their letters, of a height in mm."""
    items: list[Item] = []
    named: Named = []
    for parts, letters in (_pitch(view), _height(view), _clearance(view), *_radii(view)):
        items += parts
        named += letters
    for wheel in (0, 1):
        items += _breaks(view, wheel)
    labels = [
        Label(typeset(phrase, height), at, prefer=way, gap=1.2, name=f"size {phrase}", style=BUSY)
        for phrase, at, way in named
    ]
    return items, labels


def _radius(view: MeshView, wheel: int, name: str) -> float:
    return abs(view.solved.teeth[wheel].size(name)) / 2 * view.scale


def _pitch(view: MeshView) -> tuple[list[Item], Named]:
    """Return the pitch of wheel 1 along its reference circle, the thickness and the space in it."""
    tooth, centre = view.solved.teeth[0], view.centre(0)
    base, reference = tooth.size("d_b") / 2, tooth.size("d") / 2
    half = float(tooth.half(sqrt(reference**2 - base**2)))
    right, middle = view.axis(0, -1), view.axis(0)
    turns = (right - half, right + half, middle - half)
    low = _radius(view, 0, "d_f")
    items: list[Item] = []
    for turn, down in zip(turns, (_DOWN[1], _DOWN[0], _DOWN[1]), strict=True):
        way = complex(np.exp(1j * turn))
        ends = (centre + reference * view.scale * way, centre + (low - down - _TAIL) * way)
        items.append(Stroke(ends, Pen.THIN, tag=TAG))
    named: Named = []
    for letters, (start, end), down in (
        ("s_{1}", turns[:2], _DOWN[0]),
        ("e_{1}", turns[1:], _DOWN[0]),
        ("p", (turns[0], turns[2]), _DOWN[1]),
    ):
        items += angle_dimension(centre, low - down, start, end, tag=TAG)
        way = complex(np.exp(0.5j * (start + end)))
        named.append((letters, centre + (low - down) * way, -way))
    return items, named


def _height(view: MeshView) -> tuple[list[Item], Named]:
    """Return the height of a tooth of wheel 2, beside its teeth."""
    tooth = view.solved.teeth[1]
    ends = [_radius(view, 1, name) for name in ("d_a", "d_f")]
    beside = 3 * pi / tooth.z + _HEIGHT_OFFSET / min(ends)
    turn = view.axis(1) - tooth.side * beside
    way = complex(np.exp(1j * turn))
    start, end = (view.centre(1) + radius * way for radius in ends)
    items = dimension(start, end, 0j, tag=TAG)[2:]  # the circles are its extension lines
    return items, [("h", (start + end) / 2, -1 + 0j)]


def _clearance(view: MeshView) -> tuple[list[Item], Named]:
    """Return the clearance between the tips of wheel 1 and the roots of wheel 2."""
    tip = view.centre(0) - view.up(0) * _radius(view, 0, "d_a")
    root = view.centre(1) - view.up(1) * _radius(view, 1, "d_f")
    if abs(root - tip) < 1.0:
        return [], []
    items = dimension(tip, root, complex(_OUT), tag=TAG)
    return items, [("c", (tip + root) / 2 + _OUT, 1 + 1j)]


def _radii(view: MeshView) -> Iterator[tuple[list[Item], Named]]:
    """Yield the radii of the wheels whose centres are drawn: r_w, r_f, r_a, r_b.

    That of the base circle and the working one have their lines, to N and to P, the first where N
    is not too far away to be drawn; a ring has its centre on the side of the other wheel, where
    they would cover one another.
    """
    for wheel, tooth in enumerate(view.solved.teeth):
        if tooth.side < 0 or view.is_broken(wheel):
            continue
        centre, number = view.centre(wheel), wheel + 1
        foot = view.on_line(0.0 if wheel == 0 else float(view.solved.pair.line))
        turn = float(np.angle((foot - centre) / -centre))
        named: Named = [(f"r_{{w{number}}}", centre / 2, complex(-np.sign((foot - centre).real)))]
        if draws_limit_point(view, wheel):
            beside = (foot - centre) * 1j * np.sign(turn)
            named.append((f"r_{{b{number}}}", (centre + foot) / 2, beside))
        items: list[Item] = []
        for name, share in (("f", 1 / 3), ("a", 2 / 3)):
            least = min(share * abs(turn), _RADIUS_REACH * share * pi / tooth.z)
            way = -centre / abs(centre) * np.exp(1j * np.sign(turn) * least)
            tip = centre + _radius(view, wheel, f"d_{name}") * complex(way)
            items.append(Stroke((centre, tip), Pen.THIN, tag=TAG))
            items += arrowhead(tip, complex(way), length=_HEAD, tag=TAG)
            middle = centre + _NAMED[name] * (tip - centre)
            named.append((f"r_{{{name}{number}}}", middle, complex(way) * 1j * np.sign(turn)))
        yield items, named


def _breaks(view: MeshView, wheel: int) -> Iterator[Item]:
    """Yield the lines of break at both ends of the rim that is drawn."""
    tooth, radius = view.solved.teeth[wheel], _radius(view, wheel, "d_f")
    inward = -tooth.side * min(_BREAK, 0.5 * radius)
    for sense in (-1, 1):
        way = complex(np.exp(1j * (view.axis(wheel) + sense * 3 * pi / tooth.z)))
        start = view.centre(wheel) + radius * way
        yield from wavy_line(start, start + inward * way, tag="break")
