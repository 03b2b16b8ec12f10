"""Picture of two wheels in mesh with its dimensions (картина зацепления)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, pi, sin, sqrt
from typing import TypeAlias

import numpy as np
from msgspec import Struct

from planmethod.gears.involute.geometry import Points, Tooth
from planmethod.gears.involute.results import SolvedMeshing
from planmethod.note.wording import Language
from planmethod.render.ink.drawing import Arc, Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import ink_bounds, typeset
from planmethod.render.labels import BUSY, SERIES, Label
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import DIMENSION, arrowhead, turn_arrow
from planmethod.render.symbols.marks import (
    angle_dimension,
    axis_line,
    centre_lines,
    dimension,
    kinked_line,
    wavy_line,
)

POINTS = 61
"""Points of a flank and of a fillet."""

CURVE = "profile"
"""Tag of flanks and fillets, with the number of the wheel."""

HIGH, LEAST = 70.0, 40.0
"""Largest height of a tooth, and the height below which the centres are left out, mm."""

SCALES = (
    *(1 / k for k in (1000, 800, 500, 400, 200, 100, 75, 50, 40, 25, 20, 15, 10, 5, 4, 2.5, 2)),
    *(1.0, 2.0, 2.5, 4.0, 5.0, 10.0, 20.0, 40.0, 50.0),
    *(100.0, 200.0, 500.0, 1000.0),
)
"""Scales of GOST 2.302, millimetres of paper for one."""

_BAND = 2.0  # mm: width of the hatched band of an active flank
_DOT = 1.0  # mm: radius of a point's dot
_DISTANCE = f"{DIMENSION} a_w"
_SHORTEST = 150.0  # mm: length of a broken line of centres
_DISTANCE_OFFSET = 22.0  # mm: from the circles to the dimension of the centre distance
_OVER = 14.0  # mm: overhang of circles and lines beyond the teeth


class MeshView(Struct, frozen=True):
    """Placement of the picture on the paper (масштаб картины).

    Attributes
    ----------
    scale : float
        Millimetres of paper for one of the wheels.
    reach : (float, float), mm
        Distances of the centres below and above P as drawn: shortened where the line of centres
        is broken.
    """

    solved: SolvedMeshing
    scale: float
    reach: tuple[float, float]

    @property
    def radii(self) -> tuple[float, float]:
        """Working radii on the paper, mm."""
        one, two = (abs(tooth.size("d_w")) / 2 * self.scale for tooth in self.solved.teeth)
        return one, two

    def centre(self, wheel: int) -> complex:
        """Return where the centre of a wheel is, drawn or not."""
        return self.up(wheel) * self.radii[wheel]

    def is_broken(self, wheel: int) -> bool:
        """Return whether the line to the centre of a wheel is broken."""
        return self.reach[wheel] < self.radii[wheel] - 1e-9

    def drawn_centre(self, wheel: int) -> complex:
        """Return where the centre of a wheel is drawn."""
        return self.up(wheel) * self.reach[wheel]

    def up(self, wheel: int) -> complex:
        """Return the direction from P to the centre of a wheel; to that of a ring downwards."""
        return 1j if wheel and self.solved.pair.side > 0 else -1j

    def axis(self, wheel: int, number: int = 0) -> float:
        """Return the direction of a tooth's axis; number 0 touches the other wheel in P, rad."""
        tooth = self.solved.teeth[wheel]
        rho = tooth.size("d_b") / 2 * np.tan(float(self.solved.pair.alpha_w))
        start = float(np.angle(-self.up(wheel)))
        return start + tooth.side * float(tooth.half(rho)) + 2 * pi * number / tooth.z

    def placed(self, points: Points | complex, wheel: int, number: int = 0) -> Points:
        """Return points of a tooth where they are on the paper."""
        turn = np.exp(1j * self.axis(wheel, number))
        return np.asarray(self.centre(wheel) + self.scale * np.asarray(points) * turn)

    @property
    def action_direction(self) -> complex:
        """Direction of the line of action, from N₁ to N₂."""
        alpha_w = float(self.solved.pair.alpha_w)
        return complex(cos(alpha_w), sin(alpha_w))

    def on_line(self, rho: float) -> complex:
        """Return the point of the line of action at a radius of curvature of wheel 1, mm."""
        start = -self.radii[0] * self.action_direction.imag
        return self.action_direction * (start + rho * self.scale)

    @property
    def half_width(self) -> float:
        """Extent of the teeth to the left and right of P, mm."""
        wide = 0.0
        for wheel, tooth in enumerate(self.solved.teeth):
            corners = [abs(tooth.size("d_f")) / 2 * np.exp(-1j * pi / tooth.z)]
            corners += [complex(tooth.flank(tooth.rho_high))]
            both = np.array([*corners, *np.conj(corners)])
            for number in (-1, 1):
                wide = max(wide, float(np.max(np.abs(self.placed(both, wheel, number).real))))
        return wide


def nearest_scale(limit: float) -> float:
    """Return the largest scale of GOST 2.302 that is not larger than ``limit``."""
    return max((scale for scale in SCALES if scale <= limit * (1 + 1e-9)), default=SCALES[0])


def view_for(solved: SolvedMeshing, width: float, height: float) -> MeshView:
    """Return the placement of a pair that fills an area best, in a scale of GOST 2.302.

    The whole pair is shown where its teeth are then high enough; else the line of centres is
    broken and the teeth are as high as `HIGH`.
    """
    pair = solved.pair
    tooth = max(abs(float(d)) for d in (pair.d_a - pair.d_f) / 2)
    unit = MeshView(solved, 1.0, (1e9, 1e9))
    wide = 2 * unit.half_width
    ring = pair.cutter != 0
    tall = max(abs(float(d)) for d in pair.d_w) / 2 if ring else float(pair.a_w)
    whole = nearest_scale((height - 4 * _OVER) / tall)
    scale = min(whole, nearest_scale(max(width - 2 * _DISTANCE_OFFSET - 4 * _OVER, 20.0) / wide))
    if scale * tooth >= LEAST:
        most = nearest_scale(HIGH / tooth)
        scale = min(scale, most)
        return MeshView(solved, scale, MeshView(solved, scale, (0.0, 0.0)).radii)
    limit = min(HIGH / tooth, max(width - 2 * _DISTANCE_OFFSET - 4 * _OVER, 20.0) / wide)
    scale = nearest_scale(limit)
    one, two = MeshView(solved, scale, (0.0, 0.0)).radii
    room = height - 4 * _OVER
    if ring:
        below = one if one <= room - _SHORTEST else min(one, 0.55 * room)
        return MeshView(solved, scale, (below, min(two, room)))
    if one + two <= room:
        return MeshView(solved, scale, (one, two))
    is_whole = min(one, two) <= room - _SHORTEST
    below = room / 2 if not is_whole else one if one <= two else room - two
    return MeshView(solved, scale, (below, min(two, room - below)))


def meshing_picture(
    view: MeshView,
    language: Language,
    letter: float,
    sizes: Sequence[Item] = (),
    named: Sequence[Label] = (),
) -> Picture:
    """Return the picture with its letters; ``letter`` is their height, mm.

    ``sizes`` and ``named`` are dimensions and their letters.
    """
    items: list[Item] = []
    for wheel, tooth in enumerate(view.solved.teeth):
        items += _circles(view, wheel)
        for number in (-1, 0, 1):
            items += _tooth(view, tooth, wheel, number)
        items += _active(view, tooth, wheel)
    items += _line_of_action(view)
    items += _centres(view)
    items += _angle(view)
    items += sizes
    items += _distance(view, ink_bounds(items)[0] - _DISTANCE_OFFSET, language, letter)
    return lettered(items, [*_letters(view, letter), *_circle_letters(view, letter), *named])


# Teeth --------------------------------------------------------------------------------------------


def _tooth(view: MeshView, tooth: Tooth, wheel: int, number: int) -> Iterator[Item]:
    """Yield a tooth from the middle of a space to that of the next: arcs, fillets, flanks."""
    turn, centre = view.axis(wheel, number), view.centre(wheel)
    tag = f"{CURVE} {wheel + 1}"
    fillet, flank = tooth.fillet_points(POINTS), tooth.flank_points(POINTS)
    for curve in (fillet, flank, fillet.conj(), flank.conj()):
        yield Stroke(tuple(view.placed(curve, wheel, number).tolist()), tag=tag, smooth=True)
    root = float(np.angle(fillet[0]))
    low = abs(tooth.size("d_f")) / 2 * view.scale
    for start, end in ((-pi / tooth.z, root), (-root, pi / tooth.z)):
        if end - start > 1e-9:
            yield Arc(centre, low, turn + start, turn + end, tag=tag)
    top = float(np.angle(flank[-1]))
    if top < -1e-6:
        yield Arc(centre, abs(flank[-1]) * view.scale, turn + top, turn - top, tag=tag)


def _active(view: MeshView, tooth: Tooth, wheel: int) -> Iterator[Item]:
    """Yield the hatched band along the flank that takes part in the mesh (активный профиль)."""
    contact, line = view.solved.contact, float(view.solved.pair.line)
    ends = (contact.start, contact.end)
    low, high = ends if wheel == 0 else (line - ends[1], line - ends[0])
    if high <= low:
        return
    rho = np.linspace(low, high, POINTS)
    points = tooth.flank(rho)
    roll = np.arctan(2 * rho / tooth.size("d_b"))
    feet = abs(tooth.size("d_b")) / 2 * np.exp(1j * (np.angle(points) + tooth.side * roll))
    gone = tooth.side * (feet - points)
    inward = gone / np.maximum(np.abs(gone), 1e-12) * _BAND / view.scale
    if tooth.side < 0:  # the other flank of a ring's tooth touches
        points, inward = points.conj(), inward.conj()
    outer = view.placed(points, wheel)
    inner = view.placed(points + inward, wheel)
    tag = "active flank"
    yield Stroke(tuple(inner.tolist()), Pen.THIN, tag=tag, smooth=True)
    way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(outer)))])
    marks = np.linspace(0.0, way[-1], max(2, round(way[-1] / _BAND)))
    for at in marks:
        start, end = np.interp(at, way, outer), np.interp(at, way, inner)
        yield Stroke((complex(start), complex(end)), Pen.HATCH, tag=tag)


def _circles(view: MeshView, wheel: int) -> Iterator[Item]:
    """Yield arcs of the circles of a wheel along its three teeth and beyond, on one side more."""
    for radius, pen, _ in _circle_sizes(view, wheel):
        start, end = _arc_ends(view, wheel, radius)
        yield Arc(view.centre(wheel), radius, start, end, pen, tag="circle")


def _circle_sizes(view: MeshView, wheel: int) -> list[tuple[float, Pen, str]]:
    """Return radii on the paper, pens and letters of the circles of a wheel, from inside."""
    tooth, number = view.solved.teeth[wheel], wheel + 1
    told = [
        ("d_f", Pen.THIN, f"d_{{f{number}}}"),
        ("d_b", Pen.THIN, f"d_{{b{number}}}"),
        ("d", Pen.AXIS, f"d_{{{number}}}"),
        ("d_w", Pen.AXIS, f"d_{{w{number}}}"),
        ("d_a", Pen.THIN, f"d_{{a{number}}}"),
    ]
    found: list[tuple[float, Pen, str]] = []
    for name, pen, letters in told:
        radius = abs(tooth.size(name)) / 2 * view.scale
        if view.is_broken(wheel) and view.radii[wheel] - radius > view.reach[wheel] - 5 * _OVER:
            continue  # the base circle of a large wheel is beyond the break
        same = next((k for k, one in enumerate(found) if abs(one[0] - radius) < 0.1), None)
        if same is None:
            found.append((radius, pen, letters))
        else:
            before = found[same]
            found[same] = (before[0], before[1], f"{before[2]} = {letters}")
    return found


def _arc_ends(view: MeshView, wheel: int, radius: float) -> tuple[float, float]:
    """Return both ends of an arc: it is extended on the side of its letters."""
    z = view.solved.teeth[wheel].z
    middle = view.axis(wheel)
    half = min(3 * pi / z + 0.4 * _OVER / radius, pi)
    more = min(3 * pi / z + 2.2 * _OVER / radius, pi)
    # Letters of wheel 1 on the left (its axis leans to the left), those of wheel 2 on the right.
    if view.solved.teeth[wheel].side < 0:
        return middle - more, middle + half
    return middle - half, middle + more


# Lines --------------------------------------------------------------------------------------------


def _line_of_action(view: MeshView) -> Iterator[Item]:
    """Yield the line of action with its active part, and the common tangent in P."""
    contact = view.solved.contact
    start, end = (_visible_end(view, wheel) for wheel in (0, 1))
    for wheel, tip in ((0, start), (1, end)):
        beyond = view.action_direction * (-_OVER if wheel == 0 else _OVER) / 2
        yield Stroke((tip, tip + beyond), Pen.THIN, tag="line of action")
        if draws_limit_point(view, wheel):
            foot = view.drawn_centre(wheel)
            if view.is_broken(wheel):
                way = view.centre(wheel) - tip
                foot = tip + way / abs(way) * min(2.5 * _OVER, abs(way))
            yield Stroke((tip, foot), Pen.THIN, tag="base radius")
            yield from _square(tip, view.action_direction * (1 if wheel == 0 else -1), foot - tip)
    a, b = view.on_line(contact.start), view.on_line(contact.end)
    yield Stroke((start, a), Pen.THIN, tag="line of action")
    yield Stroke((a, b), Pen.MAIN, tag="active line")
    yield Stroke((b, end), Pen.THIN, tag="line of action")
    wide = _angle_radius(view) + _OVER
    yield Stroke((complex(-0.5 * wide), complex(wide)), Pen.THIN, tag="tangent")


def _visible_end(view: MeshView, wheel: int) -> complex:
    """Return the end of the line of action, N₁ or N₂; a nearer point where it is far away."""
    full = view.on_line(0.0 if wheel == 0 else float(view.solved.pair.line))
    if wheel and view.solved.pair.side < 0:  # N₂ of a ring is beyond N₁
        return view.action_direction * _farthest(view)
    if draws_limit_point(view, wheel):
        return full
    return full / abs(full) * _farthest(view)


def draws_limit_point(view: MeshView, wheel: int) -> bool:
    """Return whether N₁ or N₂ is drawn, and with it the base radius of its wheel."""
    if wheel and view.solved.pair.side < 0:
        return False
    full = view.on_line(0.0 if wheel == 0 else float(view.solved.pair.line))
    return abs(full) <= _farthest(view)


def _farthest(view: MeshView) -> float:
    contact = view.solved.contact
    active = max(abs(view.on_line(contact.start)), abs(view.on_line(contact.end)))
    return max(1.6 * view.half_width, active + _OVER)


def _square(corner: complex, one: complex, two: complex) -> Iterator[Item]:
    """Yield the mark of a right angle."""
    one, two = one / abs(one) * 4.0, two / abs(two) * 4.0
    yield Stroke((corner + one, corner + one + two, corner + two), Pen.THIN, tag="right angle")


def _centres(view: MeshView) -> Iterator[Item]:
    """Yield the line of centres, the centres and the senses of rotation."""
    for wheel in (0, 1):
        centre, way = view.drawn_centre(wheel), view.up(wheel)
        if view.is_broken(wheel):
            gap = centre - way * 2.5 * _OVER
            yield from axis_line(0j, gap + 0j, tag="line of centres")
            yield from kinked_line(gap - 10.0, gap + 10.0)
            yield from kinked_line(gap + way * 4.0 - 10.0, gap + way * 4.0 + 10.0)
            yield from axis_line(gap + way * 4.0, centre + way * 8.0, centre, tag="line of centres")
        elif wheel or view.solved.pair.side > 0:  # else it is on that of the ring
            yield from axis_line(0j, centre + way * 8.0, centre, tag="line of centres")
        yield from centre_lines(centre, 5.0, directions=(1 + 0j,))
        yield Disc(centre, _DOT, Ink.BLACK)
        yield from turn_arrow(
            centre, 11.0, 1 if way == 1j else -1, middle=90.0 if way == 1j else -90.0
        )
    yield Disc(0j, _DOT, Ink.BLACK)


def _distance(view: MeshView, x: float, language: Language, letter: float) -> Iterator[Item]:
    """Yield the dimension of the centre distance at an abscissa (межосевое расстояние)."""
    low, high = view.drawn_centre(0), view.drawn_centre(1)
    yield from dimension(low, high, complex(x - low.real), gap=6.0, tag=_DISTANCE)
    shown = language.notation.number(f"{abs(float(view.solved.pair.a_w)):.3f}")
    text = typeset(f"a_{{w}} = {shown}", letter)
    at = complex(x - text.descent - 1.2, (low.imag + high.imag) / 2)
    yield from text.at(at, anchor="centre", angle=90.0, label=_DISTANCE)


def _angle_radius(view: MeshView) -> float:
    end = abs(_visible_end(view, 1)) - 14.0
    return min(view.half_width + 1.2 * _OVER, end)


def _angle(view: MeshView) -> Iterator[Item]:
    """Yield the dimension of the working angle between the tangent and the line of action."""
    radius, angle = _angle_radius(view), float(view.solved.pair.alpha_w)
    yield from angle_dimension(0j, radius, 0.0, angle, tag=f"{DIMENSION} α_w")


# Letters ------------------------------------------------------------------------------------------


def _letters(view: MeshView, height: float) -> list[Label]:
    contact = view.solved.contact
    named: list[tuple[str, complex, complex]] = [
        ("P", 0j, -1 + 0j),
        ("A", view.on_line(contact.start), -1j),
        ("B", view.on_line(contact.end), 1j),
        ("O_{1}", view.drawn_centre(0), 1 - 0.3j),
        ("O_{2}", view.drawn_centre(1), 1 + 0.3j),
    ]
    named += [
        (
            f"N_{{{wheel + 1}}}",
            _visible_end(view, wheel),
            view.action_direction * (1 if wheel else -1),
        )
        for wheel in (0, 1)
        if draws_limit_point(view, wheel)
    ]
    labels = [
        Label(typeset(letters, height), at, prefer=way, gap=2.0, name=letters, style=BUSY)
        for letters, at, way in named
    ]
    middle = _angle_radius(view) * np.exp(0.5j * float(view.solved.pair.alpha_w))
    angle = "α_{tw}" if view.solved.pair.beta else "α_{w}"
    labels.append(
        Label(typeset(angle, height), complex(middle), prefer=1 + 0j, name=f"{DIMENSION} α_w")
    )
    for wheel in (0, 1):
        at = view.drawn_centre(wheel) + 11 * view.up(wheel)
        sign = typeset(f"ω_{{{wheel + 1}}}", height)
        labels.append(Label(sign, at, prefer=1 + 0j, gap=3.0, name=f"ω_{wheel + 1}", style=BUSY))
    return labels


def _circle_letters(view: MeshView, height: float) -> list[Label]:
    """Return the letters of the circles at the ends of their arcs."""
    labels = []
    for wheel in (0, 1):
        for radius, _, letters in _circle_sizes(view, wheel):
            start, end = _arc_ends(view, wheel, radius)
            end = end if view.solved.teeth[wheel].side > 0 else start
            at = view.centre(wheel) + radius * np.exp(1j * end)
            away = -1 + 0j if wheel == 0 else 1 + 0j
            labels.append(
                Label(
                    typeset(letters, height),
                    complex(at),
                    prefer=away,
                    gap=1.0,
                    name=f"{letters}",
                    style=SERIES,
                    series=f"circles {wheel + 1}",
                )
            )
    return labels


Named: TypeAlias = list[tuple[str, complex, complex]]
"""Letters, their places, and their preferred sides."""

_DOWN = (9.0, 18.0)  # mm: from the root circle to the dimensions of s and e, and to that of p
_TAIL = 1.5  # mm: of an extension line beyond the dimension line
_HEIGHT_OFFSET = 4.0  # mm: from the outermost tooth to the dimension of its height
_BREAK = 16.0  # mm: length of a line of break
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
        Label(
            typeset(phrase, height),
            at,
            prefer=way,
            gap=1.2,
            name=f"{DIMENSION} {phrase}",
            style=BUSY,
        )
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
        items.append(Stroke(ends, Pen.THIN, tag="extension"))
    named: Named = []
    for letters, (start, end), down in (
        ("s_{1}", turns[:2], _DOWN[0]),
        ("e_{1}", turns[1:], _DOWN[0]),
        ("p", (turns[0], turns[2]), _DOWN[1]),
    ):
        items += angle_dimension(centre, low - down, start, end, tag=f"{DIMENSION} {letters}")
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
    # The circles are its extension lines.
    items = dimension(start, end, 0j, tag=f"{DIMENSION} h")[2:]
    return items, [("h", (start + end) / 2, -1 + 0j)]


def _clearance(view: MeshView) -> tuple[list[Item], Named]:
    """Return the clearance between the tips of wheel 1 and the roots of wheel 2."""
    tip = view.centre(0) - view.up(0) * _radius(view, 0, "d_a")
    root = view.centre(1) - view.up(1) * _radius(view, 1, "d_f")
    if abs(root - tip) < 1.0:
        return [], []
    items = dimension(tip, root, complex(_OUT), tag=f"{DIMENSION} c")
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
            letters = f"r_{{{name}{number}}}"
            items.append(Stroke((centre, tip), Pen.THIN, tag=f"{DIMENSION} {letters}"))
            items += arrowhead(tip, complex(way), tag=f"{DIMENSION} {letters}")
            middle = centre + _NAMED[name] * (tip - centre)
            named.append((letters, middle, complex(way) * 1j * np.sign(turn)))
        yield items, named


def _breaks(view: MeshView, wheel: int) -> Iterator[Item]:
    """Yield the lines of break at both ends of the rim that is drawn."""
    tooth, radius = view.solved.teeth[wheel], _radius(view, wheel, "d_f")
    inward = -tooth.side * min(_BREAK, 0.5 * radius)
    for sense in (-1, 1):
        way = complex(np.exp(1j * (view.axis(wheel) + sense * 3 * pi / tooth.z)))
        start = view.centre(wheel) + radius * way
        yield from wavy_line(start, start + inward * way, tag="break")
