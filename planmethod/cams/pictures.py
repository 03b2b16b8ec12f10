"""Pictures of a cam: diagrams, s over v_q with its region, the profile (рисунки кулачка).

Everything is millimetres of paper. A clockwise cam is drawn as the mirror image.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import degrees

import numpy as np
from msgspec import Struct

from planmethod.cams.construction import CamConstruction
from planmethod.cams.design import CamNode, is_plate
from planmethod.cams.model import TURN, CamPhase, Closure, Complexes, Contact, Reals
from planmethod.construct.scale import series_near
from planmethod.construct.steps import IntersectLines, PointName
from planmethod.note.wording import Language
from planmethod.render.ink.drawing import Arc, Disc, Ink, Item, Pen, Stroke, shifted
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.diagram import (
    Abscissae,
    Curve,
    Diagram,
    Mark,
    Ordinates,
    diagram_picture,
    mark_items,
)
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import arrowhead, fixed_pivot, guide_plates, revolute, turn_arrow
from planmethod.render.symbols.marks import dimension

PROFILE = "cam profile"
"""Tag of the actual profile; the theoretical one is ``cam profile theoretical``."""

POINTS = 721
_SMALL = 2.5  # mm: numbers of positions
_BETWEEN = 8.0  # mm: between diagrams one below the other
_DOT = 0.6
_OVERSHOOT = 12.0  # mm: limiting lines go on beyond the axis
_ROD_LENGTH = 34.0  # mm: of a translating follower
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
    return Picture(tuple(items), (left, level + _BETWEEN, right, 0.0))


def _angle_axis(view: CamView) -> Abscissae:
    nodes, per = view.built.nodes, view.built.scales.degree
    at = [degrees(node.phi) / per for node in nodes]
    end = 360.0 / per
    numbers = [str(node.number) for node in nodes]
    if at[-1] < end - 1e-6:
        at, numbers = [*at, end], [*numbers, "0"]
    return Abscissae("φ", tuple(at), tuple(numbers))


def _curve(view: CamView, row: int, per_mm: float) -> Curve:
    """Return the exact curve of s, v_q or a_q, broken where it jumps."""
    problem, per = view.built.design.problem, view.built.scales.degree
    parts: list[list[complex]] = []
    for stretch in problem.stretches:
        phi = np.linspace(stretch.start, stretch.end, 61)
        values = problem.on(stretch, phi)[row] / per_mm
        points = [complex(degrees(x) / per, y) for x, y in zip(phi, values, strict=True)]
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
    construction: list[Item] = []
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
            Stroke((pole, 0j), Pen.THIN, tag="aid"), Disc(pole, _DOT, Ink.BLACK, tag="pole"),
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
                construction.append(Disc(place, _DOT, Ink.BLACK, tag="drawn"))
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
    found: list[tuple[complex, ...]] = []
    phi = [np.linspace(one.start, one.end, 61) for one in problem.stretches]
    values = [
        np.degrees(design.geometry.points(x, problem.on(one, x)).pressure)
        for one, x in zip(problem.stretches, phi, strict=True)
    ]
    per_mm = _per_mm(values, 40.0 / per)
    for x, y in zip(phi, values, strict=True):
        found.append(
            tuple(complex(degrees(a) / per, b / per_mm) for a, b in zip(x, y, strict=True))
        )
    curves = [Curve("ϑ", tuple(found))]
    for phase in (CamPhase.RISE, CamPhase.RETURN):
        limit = problem.limit(phase)
        if limit is None:
            continue
        sign = 1 if phase is CamPhase.RISE else -1
        start, end = problem.starts[phase], problem.starts[phase] + problem.length(phase)
        height = sign * degrees(limit) / per_mm
        line = tuple(complex(degrees(x) / per, height) for x in (start, end))
        curves.append(Curve(view.language.cam["limits"][phase.value].format(), (line,), Pen.HIDDEN))
    pressure = Diagram(_angle_axis(view), Ordinates("ϑ, °", per_mm, view.language.notation), curves)
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
        if abs(end - foot) > _DOT:
            items.append(Stroke(view.on_paper((foot, end)), Pen.THIN, tag="aid"))
        items.append(Disc(view.spot(end), _DOT, Ink.BLACK, tag="drawn"))
        if node.number % 2 == 0 and abs(end - foot) > 4.0:
            labels.append(view.label(str(node.number), end, end - foot, size=_SMALL))
    if not (plate and swung):
        labels.append(view.label("B", start, 1 - 1j))
    axis = view.at("O_{1}") if "O_{1}" in made else None
    if swung:
        items += _arm_lines(view, labels)
    else:
        top = max(ends.imag.max(), 0.0) + _OVERSHOOT
        items.append(Stroke(view.on_paper((start - 4j, start + 1j * top)), Pen.AXIS, tag="line"))
        items += arrowhead(view.spot(start + 1j * (top + 3.0)), 1j, length=3.5, tag="line")
        labels.append(view.label("s", start + 1j * top, 1 + 0j))
    for number, k in built.drawn.items():
        items += _limit_line(view, number, k, axis)
        if not plate and axis is not None:
            sign = view.language.cam["limits"][built.bounds[number].phase.value].format()
            end = view.at(f"D_{{{k}}}")
            labels.append(
                view.label(f"90° − {sign.strip('−')}", 0.6 * axis + 0.4 * end, end - start)
            )
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
        items += dimension(view.spot(foot), view.spot(start), 12.0 + 0j, tag="dimension")
        name = "r_{0} − ρ" if built.design.problem.min_radius else "r_{0}"
        labels += [view.label("K", foot, -1 - 1j)]
        labels.append(view.label(name, (foot + start) / 2 + 12.0 * view.mirror, 1 + 0j))
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
            items += dimension(view.spot(axis), view.spot(view.at("E")), gap, tag="dimension")
            items.append(Stroke(view.on_paper((start - 4j, view.at("E"))), Pen.THIN, tag="line"))
            labels.append(view.label("e", (axis + view.at("E")) / 2 + gap, 1j))
    return lettered(items, labels)


def _region_curve(view: CamView) -> list[Complexes]:
    """Return the exact curve of the ends D, mm, broken where it jumps."""
    design, mm = view.built.design, view.built.scales.region
    parts: list[Complexes] = []
    for stretch in design.problem.stretches:
        if stretch.phase not in (CamPhase.RISE, CamPhase.RETURN):
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
    items += fixed_pivot(view.spot(pivot), factor=0.8)
    labels.append(view.label("O_{2}", pivot, 1 + 1j))
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


# Profile ------------------------------------------------------------------------------------------


def profile_picture(view: CamView) -> Picture:
    """Return the profile with the follower at rest, and inverted positions thin."""
    design, mm = view.built.design, view.built.scales.profile
    problem, geometry = design.problem, design.geometry
    phi = np.linspace(0.0, TURN, POINTS)[:-1]
    at = geometry.at(phi)
    flat = problem.contact is Contact.FLAT
    items: list[Item] = []
    labels: list[Label] = []
    size = geometry.r_min / mm
    items.append(Arc(0j, size, pen=Pen.THIN, tag="base circle"))
    if abs(geometry.e) / mm > 1.0 and not flat:
        items.append(Arc(0j, abs(geometry.e) / mm, pen=Pen.THIN, tag="offset circle"))
    if problem.oscillates:
        items.append(Arc(0j, geometry.centre / mm, pen=Pen.THIN, tag="centres"))
    for node in view.built.nodes:
        items += _inverted(view, node, labels)
    if problem.contact is Contact.ROLLER:
        theoretical = view.on_paper(at.theoretical / mm)
        items.append(Stroke(theoretical, Pen.AXIS, closed=True, tag=f"{PROFILE} theoretical"))
    sides = (at.actual, at.outer) if problem.closure is Closure.FORM else (at.actual,)
    for side in sides:
        items.append(Stroke(view.on_paper(side / mm), Pen.MAIN, closed=True, tag=PROFILE))
    items += _follower(view, labels)
    if (cut := design.undercut) is not None:
        items += mark_items(Mark.CROSS, view.spot(cut.point / mm))
        labels.append(view.label("ρ_{min}", cut.point / mm, cut.point))
    items += fixed_pivot(0j, factor=0.9)
    labels.append(view.label("O", 0j, -1 - 0.4j))
    arrow = min(0.6 * size, 14.0)
    if arrow > 5.0:
        items += turn_arrow(0j, arrow, view.mirror, middle=90.0)
        labels.append(view.label("ω", 1j * arrow, 1j))
    return lettered(items, labels)


def _inverted(view: CamView, node: CamNode, labels: list[Label]) -> list[Item]:
    """Return a position of inverted motion: the follower's line, its roller, its number."""
    k, problem, geometry = node.number, view.built.design.problem, view.built.design.geometry
    point = view.at(f"B_{{{k}}}")
    mm = view.built.scales.profile
    flat = problem.contact is Contact.FLAT
    if problem.oscillates:
        origin = view.at(f"C_{{{k}}}")
        out = origin
    else:
        origin = view.at(f"K_{{{k}}}")
        out = point + (point - origin) / max(abs(point - origin), 1e-9) * 4.0
    items: list[Item] = []
    if flat and not problem.oscillates:
        along = 1j * origin / max(abs(origin), 1e-9)
        half = max(abs(view.at(f"B_{{{one.number}}}") - view.at(f"K_{{{one.number}}}"))
                   for one in view.built.nodes) + 3.0  # fmt: skip
        items.append(Stroke(view.on_paper((origin - along * half, origin + along * half)), Pen.THIN,
                            tag="inverted"))  # fmt: skip
        out = origin
    else:
        end = point if problem.oscillates else out
        items.append(Stroke(view.on_paper((origin, end)), Pen.THIN, tag="inverted"))
    if geometry.roller:
        items.append(Arc(view.spot(point), geometry.roller / mm, pen=Pen.THIN, tag="roller"))
    items.append(Disc(view.spot(point), _DOT, Ink.BLACK, tag="drawn"))
    labels.append(view.label(str(k), out if k else point, out, size=_SMALL))
    return items


def _follower(view: CamView, labels: list[Label]) -> list[Item]:
    """Return the follower at rest, thick."""
    design, mm = view.built.design, view.built.scales.profile
    problem, geometry = design.problem, design.geometry
    at = geometry.at(np.array([0.0]))
    point = view.spot(complex(at.roller[0]) / mm)
    items: list[Item] = []
    if problem.oscillates:
        pivot = view.spot(geometry.pivot / mm)
        end = point
        if problem.contact is Contact.FLAT:
            way = (point - pivot) / abs(point - pivot)
            end = pivot + way * problem.arm / mm
        items.append(Stroke((pivot, end), Pen.MAIN, tag="follower"))
        items += fixed_pivot(pivot, factor=0.9)
        labels.append(view.label("O_{2}", geometry.pivot / mm, 1 + 1j))
    else:
        foot = point
        if problem.contact is Contact.FLAT:
            foot = complex(view.mirror * geometry.e / mm, point.imag)
            nodes = view.built.nodes
            half = max(abs(view.at(f"B_{{{k.number}}}") - view.at(f"K_{{{k.number}}}"))
                       for k in nodes) + 3.0  # fmt: skip
            items.append(Stroke((foot - half, foot + half), Pen.MAIN, tag="follower"))
        stem = _ROD_LENGTH + problem.stroke / mm
        items.append(Stroke((foot, foot + 1j * stem), Pen.MAIN, tag="follower"))
        items += guide_plates(foot + 1j * (stem - 9.0), angle=90.0, width=4.0)
    if geometry.roller:
        items += [Disc(point, geometry.roller / mm), Arc(point, geometry.roller / mm, tag="roller")]
        items += revolute(point, factor=0.7)
    return items
