"""Pictures of a cam: diagrams, s over v_q with its region (рисунки кулачка).

Everything is millimetres of paper. A clockwise cam is drawn as the mirror image.
"""

# no messages: tags of dimensions

from __future__ import annotations

from cmath import exp
from collections.abc import Iterable, Sequence
from math import degrees, pi

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.cams.construction import CamConstruction
from planmethod.cams.design import is_plate
from planmethod.cams.laws import Reals
from planmethod.cams.model import MOVING, TURN, CamPhase, Complexes, Contact, Stretch
from planmethod.cams.scales import DWELL_LENGTH, PRESSURE_HEIGHT
from planmethod.cams.text import angle_symbol
from planmethod.construct.scale import series_near
from planmethod.construct.steps import IntersectLines, PointName
from planmethod.note.wording import Language
from planmethod.render.ink.drawing import Arc, Disc, Fill, Ink, Item, Pen, Stroke, shifted
from planmethod.render.ink.typeset import ink_bounds, typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.labels.label_column import merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.diagram import (
    Abscissae,
    Curve,
    Diagram,
    Ordinates,
    diagram_picture,
)
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import (
    DIMENSION,
    angle_dimension,
    arrowhead,
    dimension,
    fixed_pivot,
    revolute,
    unit,
)

NUMBER = 3.5  # mm: height of the numbers of positions
DOT = 0.6  # mm: radius of a drawn point
_BREAK = 1.4  # mm: white of the break of an axis
_BETWEEN = 8.0  # mm: between diagrams one below the other
_OVERSHOOT = 12.0  # mm: limiting lines go on beyond the axis
_ANGLE = 18.0  # mm: radius of the arc of an angle
_HATCH = 4.0  # mm: between the strokes of the region's edge


class CamView(Struct, frozen=True):
    """A construction as it is drawn."""

    built: CamConstruction
    language: Language
    letter: float

    @property
    def mirror(self) -> int:
        """-1 of a clockwise cam."""
        return self.built.design.problem.mirror

    def at(self, name: str) -> complex:
        """Return a point of the construction without errors of drawing, mm."""
        return complex(np.ravel(self.built.exact.value[PointName(name)])[0])

    def on_paper(self, points: Complexes | Iterable[complex]) -> tuple[complex, ...]:
        """Return points as they are drawn: mirrored where the cam turns clockwise."""
        return tuple(map(self.spot, points))

    def spot(self, point: complex) -> complex:
        """Return a point as it is drawn."""
        return complex(self.mirror * point.real, point.imag)

    @property
    def break_at(self) -> float:
        """Place of the break of the axis of angles, mm: within a long lower dwell."""
        last = self.built.design.problem.motions[-1]
        return degrees(last.start) / self.built.scales.degree + DWELL_LENGTH / 2

    @property
    def cut(self) -> float:
        """Length that is left out at the break, mm."""
        return self.built.scales.cut(self.built.design.problem)

    def curve(self, stretch: Stretch, phi: Reals, heights: Reals) -> list[list[complex]]:
        """Return the parts of a diagram over a smooth part, mm: two of a broken dwell."""
        across, middle = np.degrees(phi) / self.built.scales.degree, self.break_at
        if stretch.motion is not self.built.design.problem.last_dwell or not self.cut:
            return [[complex(x, y) for x, y in zip(across, heights, strict=True)]]
        ends = (float(across[0]), middle - _BREAK), (middle + _BREAK, float(across[-1]) - self.cut)
        return [[complex(x, float(heights[0])) for x in pair] for pair in ends]

    def break_items(self) -> list[Item]:
        """Return the sign of a break in the axis of angles."""
        if not self.cut:
            return []
        lean = complex(_BREAK, 3.0 * _BREAK)
        one, two = (self.break_at + side * _BREAK / 2 for side in (-1, 1))
        white = Fill((one - lean, two - lean, two + lean, one + lean), Ink.WHITE, tag="break")
        lines = (Stroke((at - lean, at + lean), Pen.THIN, tag="break") for at in (one, two))
        return [white, *lines]

    def label(self, text: str, at: complex, prefer: complex = 0j, *, size: float = 0.0) -> Label:
        """Return a label at a point of the construction."""
        place, way = self.spot(at), self.spot(prefer)
        height = size or self.letter
        return Label(typeset(text, height), place, prefer=way, gap=1.6, name=text, style=BUSY)


# Diagrams -----------------------------------------------------------------------------------------


def diagrams_picture(view: CamView) -> Picture:
    """Return the diagrams of a_q, v_q, s and of the pressure angle, one below the other."""
    parts = [_diagram(view, k) for k in range(3)]
    if view.built.design.problem.contact is not Contact.FLAT:
        parts.append(_pressure(view))
    items: list[Item] = []
    level, right, left = 0.0, 0.0, 0.0
    for part in parts:
        drop = level - part.bounds[3]
        items += shifted(part.items, 1j * drop)
        level = drop + part.bounds[1] - _BETWEEN
        left, right = min(left, part.bounds[0]), max(right, part.bounds[2])
    drawn = _phases(view, level + _BETWEEN)
    return Picture((*items, *drawn), (left, ink_bounds(drawn)[1], right, 0.0))


def _phases(view: CamView, level: float) -> list[Item]:
    """Return the phase angles along the axis of angles, below the diagrams."""
    problem, items = view.built.design.problem, list[Item]()
    for part in problem.motions:
        x = [degrees(phi) / view.built.scales.degree for phi in (part.start, part.end)]
        x[1] -= view.cut if part is problem.last_dwell else 0.0
        symbol = angle_symbol(problem, part, view.language)
        name = typeset(symbol, view.letter)
        tag = f"{DIMENSION} {part.phase.value if problem.has_one_lift else symbol} of the diagrams"
        line = level - view.letter - 4.0
        one, two = (complex(place, level) for place in x)
        items += dimension(one, two, 1j * (line - level), tag=tag)
        # Where the line is too short for it, the letter is below, clear of its neighbours.
        is_wide = x[1] - x[0] > name.width + 2.0
        base = line + 1.0 + name.descent if is_wide else line - 1.5 - name.ascent
        items += name.at(complex((x[0] + x[1] - name.width) / 2, base), label=tag)
    return items


def _angle_axis(view: CamView) -> Abscissae:
    nodes, per = view.built.nodes, view.built.scales.degree
    spots = merge_letters((complex(degrees(n.phi) / per), [str(n.number)]) for n in nodes)
    at, numbers = [place.real for place, _ in spots], [", ".join(own) for _, own in spots]
    end = 360.0 / per - view.cut
    if at[-1] < end - 1e-6:
        at, numbers = [*at, end], [*numbers, "0"]
    return Abscissae("φ", tuple(at), tuple(numbers))


def _curve(view: CamView, row: int, per_mm: float) -> Curve:
    """Return the exact curve of s, v_q or a_q, broken where it jumps."""
    problem = view.built.design.problem
    parts: list[list[complex]] = []
    for stretch in problem.stretches:
        phi = np.linspace(stretch.start, stretch.end, 61)
        for points in view.curve(stretch, phi, problem.on(stretch, phi)[row] / per_mm):
            if parts and abs(parts[-1][-1] - points[0]) < 1e-6:
                parts[-1] += points[1:]
            else:
                parts.append(points)
    return Curve("", tuple(map(tuple, parts)))


def _diagram(view: CamView, k: int) -> Picture:
    """Return the diagram of a_q, v_q or s with its integration construction."""
    name, row = "avs"[k], 2 - k
    built, scales = view.built, view.built.scales
    origin = view.at(f"O_{name}")
    per_mm = float(getattr(scales, name))
    construction: list[Item] = view.break_items()
    labels: list[Label] = []
    if k < 2:
        pole = view.at(f"π_{name}") - origin
        heads = ("m", "n")[k]
        made = {step.out for step in built.program.steps}
        ends = {
            round(view.at(point).imag - origin.imag, 6)
            for node in built.nodes
            if (point := f"{heads}_{{{node.number}}}") in made
        }
        construction += [Stroke((pole, 1j * y), Pen.THIN, tag="aid") for y in sorted(ends)]
        construction += [
            Stroke((pole, 0j), Pen.THIN, tag="aid"), Disc(pole, DOT, Ink.BLACK, tag="pole"),
        ]  # fmt: skip
        labels.append(
            Label(typeset(f"π_{{{name}}}", view.letter), pole, prefer=-1 + 0j, gap=1.6, priority=2,
                  name=f"pole {name}")
        )  # fmt: skip
    if k:
        letter = "VS"[k - 1]
        for node in built.nodes:
            point = f"{letter}_{{{node.number}}}"
            if any(
                isinstance(step, IntersectLines) and step.out == point
                for step in built.program.steps
            ):
                place = view.at(point) - origin
                construction.append(Disc(place, DOT, Ink.BLACK, tag="drawn"))
    symbol = {"a": "a_{q}", "v": "v_{q}", "s": "s"}[
        name
    ] + f", {view.language.notation.units['mm']}"
    return diagram_picture(
        Diagram(
            _angle_axis(view),
            Ordinates(symbol, 1000.0 * per_mm, view.language.notation),
            [_curve(view, row, per_mm)],
            construction=construction,
            labels=labels,
        ),
        letter_height=view.letter,
        name=f"cam {name}",
    )


def _pressure(view: CamView) -> Picture:
    """Return the diagram of the pressure angle with the allowed values."""
    design, per = view.built.design, view.built.scales.degree
    problem = design.problem
    phi = [np.linspace(one.start, one.end, 61) for one in problem.stretches]
    values = [
        np.degrees(design.geometry.points(x, problem.on(one, x)).pressure)
        for one, x in zip(problem.stretches, phi, strict=True)
    ]
    per_mm = _per_mm(values, PRESSURE_HEIGHT / per)
    found = [
        tuple(part)
        for stretch, x, y in zip(problem.stretches, phi, values, strict=True)
        for part in view.curve(stretch, x, y / per_mm)
    ]
    curves = [Curve("ϑ", tuple(found))]
    for phase in MOVING:
        limit = problem.limit(phase)
        if limit is None:
            continue
        height = (1 if phase is CamPhase.RISE else -1) * degrees(limit) / per_mm
        lines = tuple(
            tuple(complex(degrees(x) / per, height) for x in (one.start, one.end))
            for one in problem.moving
            if one.phase is phase
        )
        curves.append(Curve(view.language.cam["limits"][phase.value].format(), lines, Pen.HIDDEN))
    ordinates = Ordinates("ϑ, °", per_mm, view.language.notation)
    pressure = Diagram(_angle_axis(view), ordinates, curves, construction=view.break_items())
    return diagram_picture(pressure, letter_height=view.letter, name="cam pressure")


def _per_mm(values: Sequence[Reals], height: float) -> float:
    return series_near(max(float(np.max(np.abs(y))) for y in values) / max(height, 20.0), up=True)


# Region -------------------------------------------------------------------------------------------


def region_picture(view: CamView) -> Picture | None:
    """Return s over v_q with limiting lines and the axis; None if no axis is constructed."""
    built = view.built
    if not built.results:
        return None
    made = {step.out for step in built.program.steps}
    swung, plate = "O_{2}" in made, is_plate(built.design)
    start = view.at("B")
    ends = np.array([view.at(f"D_{{{node.number}}}") for node in built.nodes])
    items: list[Item] = [
        Stroke(view.on_paper(part), Pen.MAIN, tag="velocity ends", smooth=True)
        for part in _region_curve(view)
    ]
    labels: list[Label] = []
    for node, end in zip(built.nodes, ends, strict=True):
        foot = view.at(f"B_{{{node.number}}}'")
        if abs(end - foot) > DOT:
            items.append(Stroke(view.on_paper((foot, end)), Pen.THIN, tag="aid"))
        items.append(Disc(view.spot(end), DOT, Ink.BLACK, tag="drawn"))
        if node.number % 2 == 0 and abs(end - foot) > 4.0:
            labels.append(view.label(str(node.number), end, end - foot, size=NUMBER))
    if not (plate and swung):
        labels.append(view.label("B", start, 1 - 1j))
    axis = view.at("O_{1}") if "O_{1}" in made else None
    if swung:
        items += _arm_lines(view, labels)
    else:
        top = max(ends.imag.max(), 0.0) + _OVERSHOOT
        items.append(Stroke(view.on_paper((start - 4j, start + 1j * top)), Pen.AXIS, tag="line"))
        items += arrowhead(view.spot(start + 1j * (top + 3.0)), 1j, tag="line")
        labels.append(view.label("s", start + 1j * top, 1 + 0j))
    for number, k in built.drawn.items():
        items += _limit_line(view, number, k, axis)
        if not plate and axis is not None:
            items += _limit_angle(view, number, k, axis, labels)
    if plate and axis is not None:
        foot, pivot = view.at("K"), view.at("O_{2}")
        items.append(Stroke(view.on_paper((pivot, axis)), Pen.THIN, tag="line"))
        items.append(Stroke(view.on_paper((axis, foot)), Pen.MAIN, tag="r_min"))
        items.append(Stroke(view.on_paper((pivot, foot)), Pen.THIN, tag="line"))
        if "G" in made:
            items.append(Stroke(view.on_paper((view.at("G"), axis)), Pen.THIN, tag="limit"))
        items += revolute(view.spot(axis), factor=0.8)
        labels.append(view.label("O_{1}", axis, -1j))
        labels.append(view.label("K", foot, 1j))
        labels.append(view.label("r_{0}", (axis + foot) / 2, foot - pivot))
        labels.append(view.label("a", (axis + pivot) / 2, -1j))
        return lettered(items, labels)
    if plate:
        foot = view.at("K")
        name = "r_{0} − ρ" if built.design.problem.min_radius else "r_{0}"
        tag = f"{DIMENSION} {name} of the region"
        items += dimension(view.spot(foot), view.spot(start), 12.0 + 0j, tag=tag)
        labels += [view.label("K", foot, -1 - 1j)]
        of = view.label(name, (foot + start) / 2 + 12.0 * view.mirror, 1 + 0j)
        labels.append(replace(of, name=tag))
        return lettered(items, labels)
    if axis is not None:
        items.append(Stroke(view.on_paper((axis, start)), Pen.MAIN, tag="r_min"))
        items += revolute(view.spot(axis), factor=0.8)
        labels += [view.label("O_{1}", axis, -1 - 1j)]
        middle = (axis + start) / 2
        labels.append(view.label("r_{min}", middle, (start - axis) * 1j))
        if "E" in made and abs(view.at("E") - axis) > 3.0:
            low = min(axis.imag, view.at("E").imag)
            gap = complex(0.0, low - 9.0 - axis.imag)
            tag = f"{DIMENSION} e of the region"
            items += dimension(view.spot(axis), view.spot(view.at("E")), gap, tag=tag)
            items.append(Stroke(view.on_paper((start - 4j, view.at("E"))), Pen.THIN, tag="line"))
            of = view.label("e", (axis + view.at("E")) / 2 + gap, 1j)
            labels.append(replace(of, name=tag))
    return lettered(items, labels)


def _region_curve(view: CamView) -> list[Complexes]:
    """Return the exact curve of the ends D, mm, broken where it jumps."""
    design, mm = view.built.design, view.built.scales.region
    parts: list[Complexes] = []
    for stretch in design.problem.stretches:
        if stretch.phase not in MOVING:
            continue
        moved = design.problem.on(stretch, np.linspace(stretch.start, stretch.end, 61))
        if not is_plate(design):
            found = design.velocity_end(moved)[0]
        elif design.problem.oscillates:
            arm, side = design.problem.arm, design.side
            s, v, a = moved / arm
            ray = np.exp(-1j * side * s)
            found = side * arm + arm * ray * (1j * a / (1 + side * v) - side * (1 + 2 * side * v))
        else:
            found = moved[2] + 1j * moved[0]
        parts.append(found / mm)
    return parts


def _arm_lines(view: CamView, labels: list[Label]) -> list[Item]:
    """Return the positions of the arm with its pivot."""
    pivot = view.at("O_{2}")
    items: list[Item] = []
    for node in view.built.nodes:
        items.append(
            Stroke(view.on_paper((pivot, view.at(f"B_{{{node.number}}}'"))), Pen.THIN, tag="arm")
        )
    ends = np.array([view.at(f"B_{{{node.number}}}'") for node in view.built.nodes]) - pivot
    if np.ptp(np.abs(ends)) < 1e-6:  # the zero of v_q
        turns = np.unwrap(np.angle([view.spot(end) for end in ends]))
        low, high = float(turns.min()), float(turns.max())
        items.append(Arc(view.spot(pivot), float(abs(ends[0])), low, high, Pen.THIN, "arm"))
    items += fixed_pivot(view.spot(pivot), factor=0.8)
    labels.append(view.label("O_{2}", pivot, 1 + 1j))
    return items


def _limit_angle(
    view: CamView, number: int, k: int, axis: complex, labels: list[Label]
) -> list[Item]:
    """Return the arc of the angle between a limiting line and the direction of v_q, its size."""
    end, foot = view.at(f"D_{{{k}}}"), view.at(f"B_{{{k}}}'")
    way = unit(axis - end)
    across = unit(foot - end)
    is_beyond = (across * way.conjugate()).real < 0
    across *= -1 if is_beyond else 1
    radius = min(_ANGLE, 0.6 * abs(axis - end))
    low, high = sorted(float(np.angle(view.spot(side))) for side in (across, way))
    if high - low > pi:
        low, high = high, low + TURN
    sign = view.language.cam["limits"][view.built.bounds[number].phase.value].format()
    text = f"90° − {sign.strip('−')}"
    tag = f"{DIMENSION} {number}: {text}"
    items = angle_dimension(view.spot(end), radius, low, high, tag=tag)
    if is_beyond or abs(foot - end) < radius:
        line = view.on_paper((end, end + across * (radius + 2.0)))
        items.append(Stroke(line, Pen.THIN, tag="line"))
    middle = exp(0.5j * (low + high))
    at = view.spot(end) + radius * middle
    labels.append(Label(typeset(text, view.letter), at, prefer=middle, gap=1.4, name=tag,
                        style=BUSY))  # fmt: skip
    return items


def _limit_line(view: CamView, number: int, k: int, axis: complex | None) -> list[Item]:
    """Return a limiting line with hatching on the side that is not permitted."""
    end, plate = view.at(f"D_{{{k}}}"), is_plate(view.built.design)
    if plate and axis is not None:
        pivot = view.at("O_{2}")
        far = end + _OVERSHOOT * (end - pivot) / abs(end - pivot)
        return [Stroke(view.on_paper((pivot, far)), Pen.THIN, tag="limit")]
    tip = view.at("K") if plate else axis
    assert tip is not None
    way = (tip - end) / abs(tip - end) if abs(tip - end) > 1e-6 else -1j
    last = tip + (2.0 if plate else 3.0) * _OVERSHOOT * way
    first = end - _OVERSHOOT * way
    items: list[Item] = [Stroke(view.on_paper((first, last)), Pen.THIN, tag="limit")]
    if plate:
        return items
    bound = view.built.bounds[number]
    # Beyond the axis lies the region; on its edge it is hatched towards the inside.
    inside = (-1j if bound.sign > 0 else 1j) * way
    steps = int(2.6 * _OVERSHOOT / _HATCH)
    for step in range(1, steps + 1):
        at = tip + way * step * _HATCH
        items.append(Stroke(view.on_paper((at, at + (inside + way) * 2.0)), Pen.HATCH, tag="limit"))
    return items
