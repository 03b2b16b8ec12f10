"""Picture of the cutting of a wheel by a rack (картина станочного зацепления).

The machine pitch point P₀ is the origin, the wheel is below it and the rack above, its tooth to the
right of P₀ with a flank through it. The space to the left shows earlier and later positions of the
rack relative to the wheel: flank and fillet are their envelope. The profile is drawn by its
formulas, so the positions of the rack verify it: they must touch it. Millimetres of paper.
"""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Iterator
from math import pi

import numpy as np
from msgspec import Struct

from planmethod.gears.involute.geometry import Points, RackCutting
from planmethod.gears.involute.meshpicture import CURVE, POINTS, nearest_scale
from planmethod.note.wording import Language
from planmethod.render.ink.drawing import Arc, Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, SERIES, Label
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import (
    angle_dimension,
    arrowhead,
    dimension,
    dimension_tag,
    straight_arrow,
    unit,
)
from planmethod.render.symbols.marks import axis_line

ENVELOPE = "rack position"
"""Tag of the rack's tooth in successive positions."""

POSITIONS = 17
"""Positions of the rack that are drawn in a space."""

_HIGHEST = 50.0  # mm: height of a tooth at most
_OVER = 12.0  # mm: overhang of lines
_DOT = 0.8
_MERGED = 0.6  # mm: nearer lines are one


class CuttingView(Struct, frozen=True):
    """Placement of the picture on the paper; ``scale`` is millimetres of paper for one."""

    cutting: RackCutting
    scale: float

    @property
    def centre(self) -> complex:
        """Centre of the wheel."""
        return -1j * self.cutting.radius * self.scale

    @property
    def pitch(self) -> float:
        """Pitch of the rack."""
        return self.cutting.pitch * self.scale

    def size(self, name: str) -> float:
        """Return the radius of a circle of the wheel by its name in `Pair`."""
        return self.cutting.tooth.size(name) / 2 * self.scale

    def angle(self, number: float) -> float:
        """Return the direction of a tooth's axis; number 0 is to the left of P₀, rad."""
        cutting = self.cutting
        return pi / 2 + cutting.at_pole / cutting.radius + (1 + 2 * number) * pi / cutting.tooth.z

    def of_wheel(self, points: Points | complex, number: int = 0) -> Points:
        """Return points of a tooth of the wheel where they are on the paper."""
        turn = np.exp(1j * self.angle(number))
        return np.asarray(self.centre + self.scale * np.asarray(points) * turn)

    def of_rack(self, points: Points, number: int = 0) -> Points:
        """Return points of the rack as it stands; its tooth number 0 is to the right of P₀."""
        along = 1j * (self.cutting.at_pole + number * self.cutting.pitch)
        return np.asarray(1j * (points + along) * self.scale)

    def of_line(self, rho: float) -> complex:
        """Return a point of the machine line of action, by its distance from N."""
        return 1j * self.scale * self.cutting.on_line(rho)

    def level(self, height: float, left: float, right: float) -> tuple[complex, complex]:
        """Return the ends of a line along the rack at a height above P₀, modules of the rack."""
        y = height * self.cutting.m * self.scale
        return complex(left, y), complex(right, y)


def cutting_view(cutting: RackCutting, width: float, height: float) -> CuttingView:
    """Return the placement that fills an area best, in a scale of GOST 2.302."""
    rack, tooth = cutting.tooth.pair.rack, cutting.tooth
    high = (tooth.size("d_a") - tooth.size("d_f")) / 2
    tall = 4.0 * (rack.ha + rack.c) * cutting.m + abs(cutting.displacement)
    wide = 3.3 * cutting.pitch
    most = min(_HIGHEST / high, (width - 70.0) / wide, (height - 45.0) / tall)
    return CuttingView(cutting, nearest_scale(max(most, 1e-9)))


def cutting_picture(view: CuttingView, language: Language, letter: float) -> Picture:
    """Return the picture with its letters; ``letter`` is their height, mm."""
    items: list[Item] = []
    for number in (-1, 0, 1):
        items += _tooth(view, number)
    items += _positions(view)
    items += _rack(view)
    items += _circles(view)
    items += _line_of_action(view)
    labels = [*_points(view, letter), *_circle_letters(view, letter)]
    for drawn, label in _dimensions(view, language, letter):
        items += drawn
        labels.append(label)
    return lettered(items, labels)


def _tooth(view: CuttingView, number: int) -> Iterator[Item]:
    """Yield a tooth as the rack leaves it, its tip and its root."""
    tooth, tag = view.cutting.tooth, f"{CURVE} cut"
    turn = view.angle(number)
    fillet, flank = tooth.fillet_points(POINTS), tooth.flank_points(POINTS)
    for curve in (fillet, flank, fillet.conj(), flank.conj()):
        yield Stroke(tuple(view.of_wheel(curve, number).tolist()), tag=tag, smooth=True)
    root, top = phase(complex(fillet[0])), phase(complex(flank[-1]))
    for start, end in ((-pi / tooth.z, root), (-root, pi / tooth.z)):
        if end - start > 1e-9:
            yield Arc(view.centre, view.size("d_f"), turn + start, turn + end, tag=tag)
    if top < -1e-6:
        reach = abs(complex(flank[-1])) * view.scale
        yield Arc(view.centre, reach, turn + top, turn - top, tag=tag)


def _positions(view: CuttingView) -> Iterator[Item]:
    """Yield the rack's tooth in its successive positions, as far as it is in the wheel."""
    cutting = view.cutting
    outline = cutting.rack_tooth(POINTS)
    fine = np.interp(
        np.linspace(0, len(outline) - 1, 12 * len(outline)), range(len(outline)), outline
    )
    tip = cutting.tooth.size("d_a") / 2 + 0.15 * cutting.m
    for shift in cutting.shifts(POSITIONS):
        placed = cutting.to_wheel(fine, float(shift))
        inside = np.flatnonzero(np.abs(placed) <= tip)
        if len(inside) > 1:
            points = view.of_wheel(placed[inside[0] : inside[-1] + 1], 1)
            yield Stroke(tuple(points.tolist()), Pen.THIN, tag=ENVELOPE)


def _ends(view: CuttingView) -> tuple[float, float]:
    """Return the extent of the rack to the left and to the right."""
    return -1.75 * view.pitch, 1.25 * view.pitch


def _rack(view: CuttingView) -> Iterator[Item]:
    """Yield the rack as it stands, its lines and the sense in which it moves."""
    (left, right), outline = _ends(view), view.cutting.rack_tooth(POINTS)
    # Along the rack is to the left on the paper.
    teeth = [view.of_rack(outline[::-1], number) for number in (2, 1, 0, -1)]
    whole = np.concatenate([teeth[0], *(one[1:] for one in teeth[1:])])
    edges = np.array([left, right])
    cut = np.interp(edges, whole.real, whole.imag)
    inner = whole[(whole.real > left) & (whole.real < right)]
    points = [complex(left, cut[0]), *inner.tolist(), complex(right, cut[1])]
    yield Stroke(tuple(points), tag="rack")
    rack, x = view.cutting.tooth.pair.rack, view.cutting.displacement / view.cutting.m
    yield from axis_line(*view.level(x, left - _OVER, right + _OVER), tag="rack line")
    if abs(x) * view.cutting.m * view.scale > _MERGED:
        start, end = view.level(0.0, left - _OVER, right + _OVER)
        yield from axis_line(start, end, 0j, tag="rack line")
    low = view.level(x - rack.ha, left - _OVER / 2, right + 2 * _OVER)
    yield Stroke(low, Pen.THIN, tag="boundary line")
    high = (x + rack.ha + rack.c) * view.cutting.m * view.scale + 4.0
    yield from straight_arrow(
        complex(0.3 * view.pitch, high), complex(-0.1 * view.pitch, high), tag="sense"
    )


def _circle_pens(view: CuttingView) -> list[tuple[str, Pen]]:
    """Return the circles that are drawn with their pens: the base circle where it is near."""
    tooth = view.size("d_a") - view.size("d_f")
    is_near = view.size("d_f") - view.size("d_b") < 0.6 * tooth
    near = [("d_b", Pen.THIN)] if is_near else []
    return [("d_f", Pen.THIN), *near, ("d", Pen.AXIS), ("d_a", Pen.THIN)]


def _arc(view: CuttingView, radius: float) -> tuple[float, float]:
    """Return both ends of an arc of a circle; at the left it is extended to its letters."""
    z = view.cutting.tooth.z
    return (
        max(view.angle(-1) - pi / z - 2 * _OVER / radius, -pi / 2),
        min(view.angle(1) + pi / z + 1.2 * _OVER / radius, 3 * pi / 2),
    )


def _circles(view: CuttingView) -> Iterator[Item]:
    """Yield the circles of the wheel along its teeth and the axis through P₀."""
    for name, pen in _circle_pens(view):
        radius = view.size(name)
        yield Arc(view.centre, radius, *_arc(view, radius), pen, tag="circle")
    top = (view.cutting.tooth.pair.rack.ha + 1.5) * view.cutting.m * view.scale
    low = min(view.size("d_f") - view.size("d") - 1.4 * _OVER, -_visible_depth(view) - _OVER)
    yield from axis_line(complex(0, low), complex(0, top), 0j, tag="line of centres")
    yield Disc(0j, _DOT, Ink.BLACK)


def _visible_depth(view: CuttingView) -> float:
    """Return the distance of the point N below P₀; 0 where it is too far to be shown."""
    depth = -view.of_line(0.0).imag
    return depth if depth < 1.2 * (view.size("d_a") - view.size("d_f")) else 0.0


def _line_of_action(view: CuttingView) -> Iterator[Item]:
    """Yield the machine line of action: thick from where cutting begins to where it ends."""
    cutting = view.cutting
    low, high = max(cutting.boundary, 0.0), cutting.tooth.rho_high
    start, end = view.of_line(low), view.of_line(high)
    first = min(cutting.boundary, 0.0) if _visible_depth(view) else cutting.boundary
    beyond = unit(end - start) * _OVER / 2
    yield Stroke((view.of_line(first) - beyond, start), Pen.THIN, tag="line of action")
    yield Stroke((start, end), Pen.MAIN, tag="active line")
    yield Stroke((end, end + beyond), Pen.THIN, tag="line of action")
    if _visible_depth(view):
        foot = view.of_line(0.0)
        inward = unit(view.centre - foot)
        yield Stroke((foot, foot + 1.5 * _OVER * inward), Pen.THIN, tag="base radius")
        one, two = unit(beyond) * 3.0, inward * 3.0
        yield Stroke((foot + one, foot + one + two, foot + two), Pen.THIN, tag="right angle")
        yield Disc(foot, _DOT, Ink.BLACK)
    yield Disc(view.of_line(cutting.boundary), _DOT, Ink.BLACK)
    cut = _cut_point(view)
    if cut is not None:
        yield Disc(cut, _DOT, Ink.BLACK)


def _cut_point(view: CuttingView) -> complex | None:
    """Return where the fillet cuts the involute off on the left flank of a tooth, if it does."""
    tooth = view.cutting.tooth
    if not tooth.is_cut:
        return None
    return complex(view.of_wheel(tooth.flank(tooth.rho_low).conj(), 0))


# Dimensions and letters ---------------------------------------------------------------------------


def _dimensions(
    view: CuttingView, language: Language, letter: float
) -> Iterator[tuple[list[Item], Label]]:
    """Yield dimensions with their labels: p, h, c, x·m, s, e."""
    cutting, scale = view.cutting, view.scale
    rack, tooth = cutting.tooth.pair.rack, cutting.tooth
    x, number = cutting.displacement / cutting.m, tooth.wheel + 1
    left, right = _ends(view)
    flank = view.of_rack(np.array([cutting.displacement + 0.25j * cutting.pitch]))[0]

    def equation(symbol: str, value: float) -> str:
        return f"{symbol} = {language.notation.number(f'{value:.3f}')}"

    lift = 1j * ((rack.ha + rack.c + x) * cutting.m * scale + 9.0 - flank.imag)
    one, two = complex(flank), complex(flank) + view.pitch
    text, along = equation("p", cutting.pitch), (one + lift, two + lift)
    yield (
        dimension(one, two, lift, gap=1.0, tag=dimension_tag(text)),
        Label(typeset(text, letter), sum(along) / 2, along, 1j, 1.0, name=dimension_tag(text)),
    )
    low, high = (view.level(x - part, right, right)[0] for part in (rack.ha + rack.c, rack.ha))
    text = equation("c", rack.c * cutting.m)
    yield (
        dimension(low, high, complex(_OVER), tag=dimension_tag(text)),
        Label(typeset(text, letter), low + _OVER, prefer=1 - 1j, gap=2.0, name=dimension_tag(text),
              style=BUSY),
    )  # fmt: skip
    if abs(cutting.displacement) * scale > _MERGED:
        low, high = (view.level(part, left, left)[0] for part in (0.0, x))
        text = equation(f"x_{{{number}}}·m", cutting.displacement)
        yield (
            dimension(low, high, complex(-0.6 * _OVER), tag=dimension_tag(text)),
            Label(typeset(text, letter), high - 0.6 * _OVER, prefer=-1 + 1j, gap=2.0,
                  name=dimension_tag(text), style=BUSY),
        )  # fmt: skip
    for name, value, start, end in _arcs(view):
        text = equation(f"{name}_{{{number}}}", value)
        drawn, middle = _arc_dimension(view, start, end, dimension_tag(text))
        away = unit(view.centre - middle)
        yield (
            drawn,
            Label(typeset(text, letter), middle, prefer=away, name=dimension_tag(text), style=BUSY),
        )
    if not tooth.pair.beta:  # the tip of a helical wheel's rack is not an arc
        text = equation("ρ_{f}", rack.rho * cutting.m)
        drawn, centre = _tip_radius(view, dimension_tag(text))
        yield (
            drawn,
            Label(
                typeset(text, letter), centre, prefer=1 + 1j, name=dimension_tag(text), style=BUSY
            ),
        )
    text = equation(f"h_{{{number}}}", (tooth.size("d_a") - tooth.size("d_f")) / 2)
    yield _height(view, text, letter, dimension_tag(text))


def _tip_radius(view: CuttingView, tag: str) -> tuple[list[Item], complex]:
    """Return the radius of the rack's tips on the bottom of the space to the right, its centre.

    The space is as round as the tooth, and has white above it.
    """
    cutting = view.cutting
    rack = cutting.tooth.pair.rack
    centre = complex(-rack.corner.imag, pi / 2 - rack.corner.real)
    way = rect(rack.rho, -(pi / 2 - rack.alpha) / 2)  # to the middle of the arc
    ends = [cutting.displacement + at * cutting.m for at in (centre, centre + way)]
    start, tip = (complex(at) for at in view.of_rack(np.array(ends), -1))
    line = Stroke((start, tip), Pen.THIN, tag=tag)
    return [line, *arrowhead(tip, tip - start, tag=tag)], start


def _arcs(view: CuttingView) -> Iterator[tuple[str, float, float, float]]:
    """Yield the thickness of the tooth and the width of the space on the pitch circle."""
    tooth, step = view.cutting.tooth, 2 * pi / view.cutting.tooth.z
    half = tooth.size("s") / tooth.size("d")
    right = view.angle(-1)
    yield "s", tooth.size("s"), right - half, right + half
    yield "e", view.cutting.pitch - tooth.size("s"), right + half, right + step - half


def _arc_dimension(
    view: CuttingView, low: float, high: float, tag: str
) -> tuple[list[Item], complex]:
    """Return an arc with arrowheads below the root circle, and its middle."""
    radius, items = view.size("d_f") - 9.0, list[Item]()
    for turn in (low, high):
        way = complex(np.exp(1j * turn))
        start, end = view.centre + way * view.size("d"), view.centre + way * (radius - 1.5)
        items.append(Stroke((start, end), Pen.THIN, tag="extension"))
    items += angle_dimension(view.centre, radius, low, high, tag=tag)
    return items, view.centre + radius * complex(np.exp(0.5j * (low + high)))


def _height(view: CuttingView, text: str, letter: float, tag: str) -> tuple[list[Item], Label]:
    """Return the height of the tooth between the circles, along a radius at their right end."""
    low, high = view.size("d_f"), view.size("d_a")
    turn = _arc(view, high)[0] + 3.0 / high
    way = complex(np.exp(1j * turn))
    one, two = view.centre + low * way, view.centre + high * way
    label = Label(typeset(text, letter), (one + two) / 2, prefer=1 + 0j, name=tag, style=BUSY)
    return dimension(one, two, 0j, tag=tag)[2:], label


def _points(view: CuttingView, letter: float) -> Iterator[Label]:
    number = view.cutting.tooth.wheel + 1
    named = [("P_{0}", 0j, 1 - 1j), ("B_{l}", view.of_line(view.cutting.boundary), -1 - 0.3j)]
    if _visible_depth(view):
        named.append((f"N_{{{number}}}", view.of_line(0.0), -0.3 - 1j))
    cut = _cut_point(view)
    if cut is not None:
        named.append(("U", cut, -1 - 1j))
    for letters, at, way in named:
        yield Label(typeset(letters, letter), at, prefer=way, gap=2.0, name=letters, style=BUSY)


def _circle_letters(view: CuttingView, letter: float) -> Iterator[Label]:
    """Yield the letters of the circles at the left ends of their arcs."""
    number = view.cutting.tooth.wheel + 1
    for name, _ in _circle_pens(view):
        radius, index = view.size(name), name.removeprefix("d").removeprefix("_")
        at = view.centre + radius * complex(np.exp(1j * _arc(view, radius)[1]))
        text = f"d_{{{index}{number}}}"
        yield Label(typeset(text, letter), at, prefer=-1 + 0j, gap=1.0, name=text,
                    style=SERIES, series="cut circles")  # fmt: skip
