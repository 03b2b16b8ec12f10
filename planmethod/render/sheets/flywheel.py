"""Blocks of the flywheel's sheet: diagrams as constructed, table, the wheel (лист 3)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np

from planmethod.construct.scale import Scale, choose_scale
from planmethod.construct.steps import PointName
from planmethod.errors import LayoutError
from planmethod.note.narrate.given import point_name
from planmethod.note.narrate.machine import MachineTeller
from planmethod.problem.load_records import Load, Shape, Table
from planmethod.record import dataclass
from planmethod.render.ink.drawing import Arc, Disc, Ink, Item, Pen, Span, Stroke
from planmethod.render.ink.extent import ink_bounds
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.layout.block import Block, Column, Picture, Row, heading, paragraph
from planmethod.render.layout.equations import formula_block
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.pictures.diagram import Abscissae, Curve, Ordinates, diagram_picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.results import table_width
from planmethod.render.sheets.texts import stated
from planmethod.render.sheets.views import Viewed, named
from planmethod.render.symbols import arrowhead, hatch
from planmethod.solved.forces.loads import external
from planmethod.solved.machine.drawing import FlywheelDrawing, drawing_of
from planmethod.solved.machine.flywheel import Flywheel, flywheel_of
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution

_BEYOND, _HEAD, _TICK = 10.0, 4.0, 1.2  # mm: an axis beyond its diagram, its arrowhead, a tick
_POINT = 0.7  # mm: radius of a point of a diagram
_FINE = 8  # pieces of a smooth line between two points
_STEP = 0.01  # rad: between points of an exact curve


def _drawing(solution: Solution) -> FlywheelDrawing:
    problem = solution.problem
    if problem.machine is None:
        raise LayoutError(
            "{}: a layout with a flywheel needs [machine] in the problem file. For "
            'example: [machine] delta = "1/18".',
            problem.name,
        )
    return drawing_of(flywheel_of(solution), solution.profile)


def _teller(solution: Solution, manner: Manner) -> MachineTeller:
    return MachineTeller(_drawing(solution), manner.words)


# Texts -------------------------------------------------------------------------------------------


def statement_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return "Дано" of the machine, and "Определить"."""
    tell = _teller(solution, manner)
    asked = manner.words.sheets.wanted.format(wanted=tell.wanted())
    return stated(tell.given(), asked, manner)


def calculation_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the formulas of the construction, the exact flywheel, and what lies between them."""
    tell = _teller(solution, manner)
    height, width = manner.text(manner.sizes.text), manner.width(manner.sizes.column)
    blocks: list[Block] = [heading(manner.entry.title or tell.said.calculation, height)]
    blocks += [formula_block(line, height, width=width) for line in tell.formulas()]
    blocks += [paragraph(line, height, width) for line in tell.conclusions()]
    return Column(blocks, gap=2.5)


# Diagrams of the construction --------------------------------------------------------------------


@dataclass(frozen=True)
class _DiagramsViewed(Viewed):
    """The diagrams of the construction, with KL and the pole distance as measured segments."""

    ends: tuple[tuple[str, complex, complex], ...]
    corner: complex

    def spans(self, items: Sequence[Item]) -> Iterable[Span]:
        """Return KL and H."""
        marks = [item.centre for item in items if isinstance(item, Disc) and item.tag == "K"]
        for by in (mark - self.corner for mark in marks[:1]):
            yield from (Span(name, None, tail + by, head + by) for name, tail, head in self.ends)


def diagrams_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Viewed:
    """Return moment, work, energy, inertia and energy-mass as they are constructed."""
    drawing, tell = _drawing(solution), _teller(solution, manner)
    picture = _Sketch(drawing, tell, manner.letter).picture()
    scales, made = drawing.scales, drawing.made
    told = "; ".join(
        (
            tell.scale("M", scales.moment, "N·m"),
            tell.scale("φ", scales.phi, "rad"),
            tell.scale("A", scales.work, "J"),
            tell.scale("T", scales.work, "J"),
            tell.scale("J", scales.inertia, "kg·m²"),
        )
    )
    block = named(picture, manner.entry.title or tell.said.diagrams, [told], manner)
    ends = [drawing.exact.point(name)[0] for name in (made.upper, made.lower, made.pole)]
    upper, lower, pole = (complex(end) for end in ends)
    foot = complex(drawing.exact.point(made.axes["M"].origin)[0])
    spans = (("KL", lower, upper), ("H", pole, foot))
    return _DiagramsViewed(block, "flywheel", Scale("mu_M", scales.moment, "N·m"), spans, upper)


class _Sketch:
    """Draws the diagrams, mm of the construction."""

    def __init__(self, drawing: FlywheelDrawing, tell: MachineTeller, letter: float) -> None:
        self.drawing, self.tell, self.height = drawing, tell, letter
        self.made, self.size = drawing.made, max(2.5, 0.7 * letter)
        self.items: list[Item] = []
        self.labels: list[Label] = []

    def at(self, name: PointName) -> complex:
        return complex(self.drawing.exact.point(name)[0])

    def places(self, names: Sequence[PointName]) -> list[complex]:
        return [self.at(name) for name in names]

    def picture(self) -> Picture:
        made, tell = self.made, self.tell
        length = self.drawing.flywheel.machine.turn_mm
        feet = {key: self.at(axes.origin) for key, axes in made.axes.items()}
        units = {"M": tell.moment + f", {tell.unit('N·m')}", "A": f"A, {tell.unit('J')}",
                 "T": f"{tell.letter('energy gain')}, {tell.unit('J')}",
                 "J": f"{tell.letter('reduced inertia')}, {tell.unit('kg·m²')}"}  # fmt: skip
        points = {"M": made.moments, "A": made.work, "T": made.energies, "J": made.inertias}
        for key, names in points.items():
            ordinates = [z.imag - feet[key].imag for z in self.places(names)]
            if key == "M":
                ordinates += [z.imag - feet[key].imag for z in self.places(made.middles)]
            self._axes(feet[key], length, ordinates, units[key], "φ")
            self._numbers(key, feet[key], ordinates)
        self._moment(feet["M"])
        self._work(feet["A"])
        self._energies(feet["T"])
        self._inertia(feet)
        self._energy_mass(feet["E"])
        return lettered(self.items, self.labels)

    # Parts -----------------------------------------------------------------------------------

    def _thin(self, *points: complex, pen: Pen = Pen.THIN) -> None:
        self.items.append(Stroke(points, pen, tag="diagram construction"))

    def _axes(
        self,
        foot: complex,
        right: float,
        ordinates: Sequence[float],
        up: str,
        across: str,
        *,
        left: bool = False,
    ) -> None:
        """Draw the axes of a diagram; ``left``: the name of the ordinates is left of them."""
        low, high = min([0.0, *ordinates]), max([0.0, *ordinates])
        tip, top = foot + right + _BEYOND, foot + 1j * (high + _BEYOND)
        self.items += [
            Stroke((foot, tip - _HEAD / 2), Pen.THIN, tag="diagram axis"),
            Stroke((foot + 1j * low, top - 1j * _HEAD / 2), Pen.THIN, tag="diagram axis"),
            *arrowhead(tip, 1 + 0j, length=_HEAD, tag="diagram axis"),
            *arrowhead(top, 1j, length=_HEAD, tag="diagram axis"),
        ]
        self._label(across, tip - 2.0, -1j, f"axis {up}", large=True)
        name = typeset(up, self.height)
        beside = -name.width - 3.0 if left else 2.5
        self.items += name.at(top + complex(beside, -self.height))

    def _numbers(self, key: str, foot: complex, ordinates: Sequence[float]) -> None:
        count = self.drawing.count
        step = self.drawing.flywheel.machine.turn_mm / count
        every = next(n for n in (1, 2, 3, 4, 6, 12, count) if n * step >= 3.0 * self.size)
        for k in range(count + 1):
            place = foot + k * step
            self.items.append(
                Stroke((place - 1j * _TICK, place + 1j * _TICK), Pen.THIN, tag="diagram axis")
            )
            if k % every == 0:
                side = -1j if ordinates[k] >= 0.0 else 1j
                self._label(str(k), place, side, f"{key}: position {k}")

    def _label(
        self, text: str, at: complex, prefer: complex, name: str, *, large: bool = False
    ) -> None:
        size = self.height if large else self.size
        self.labels.append(
            Label(typeset(text, size), at, prefer=prefer, gap=1.4, name=f"flywheel {name}",
                  priority=int(large), manner=BUSY)
        )  # fmt: skip

    def _curve(self, parts: Iterable[Sequence[complex]], letter: str, pen: Pen = Pen.MAIN) -> None:
        self.items += [Stroke(tuple(part), pen, tag=f"diagram curve {letter}") for part in parts]

    def _dots(self, places: Sequence[complex]) -> None:
        self.items += [Disc(place, _POINT, Ink.BLACK, "diagram point") for place in places]

    def _moment(self, foot: complex) -> None:
        flywheel, drawing = self.drawing.flywheel, self.drawing
        scales, made = drawing.scales, self.made
        pieces: list[list[complex]] = []
        edges = flywheel.moment.edges
        for low, high in pairwise(edges.tolist()):
            at = np.linspace(low, high, max(int((high - low) / _STEP), 1) + 1)
            inside = np.clip(at, low + 1e-9, high - 1e-9)
            heights = flywheel.sign * flywheel.moment.value(inside) / scales.moment
            piece = [foot + complex(t / scales.phi, y) for t, y in zip(at, heights, strict=True)]
            if pieces and abs(pieces[-1][-1] - piece[0]) < 0.05:
                pieces[-1] += piece[1:]
            else:
                pieces.append(piece)
        self._curve(pieces, "M")
        self._dots(self.places(made.moments))
        pole = self.at(made.pole)
        length = flywheel.machine.turn_mm
        cuts = []
        for k in range(drawing.count):
            cut = self.at(PointName(f"A cut {k}"))
            cuts.append(cut)
            self._thin(pole, cut)
        for place in self.places(made.middles):
            self._thin(complex(place.real, foot.imag), place)
            self._thin(complex(foot.real, place.imag), place)
        self._dots([pole])
        self._label("P", pole, -1.0, "pole", large=True)
        self._dimension(complex(pole.real, foot.imag), foot, min(z.imag for z in cuts) - 6.0, "H")
        constant = float(drawing.points.work[-1]) / flywheel.cycle / scales.moment
        level = foot + 1j * constant
        self._thin(level, level + length, pen=Pen.HIDDEN)
        keeps = self.tell.letter(f"{self.tell.keeps} moment")
        self._label(keeps, level + 0.9 * length, 1j, "constant", large=True)

    def _dimension(self, tail: complex, head: complex, low: float, letter: str) -> None:
        """Draw a dimension along +x, at a height."""
        low = min(low, tail.imag - 6.0)
        one, two = complex(tail.real, low), complex(head.real, low)
        self._thin(tail, one - 2j)
        self._thin(head, two - 2j)
        self._thin(one, two)
        self.items += [*arrowhead(one, -1 + 0j, length=3.0), *arrowhead(two, 1 + 0j, length=3.0)]
        text = typeset(letter, self.size)
        self.items += text.at((one + two) / 2 + complex(-text.width / 2, 1.0))

    def _work(self, foot: complex) -> None:
        places = self.places(self.made.work)
        self._curve([places], "A")
        self._dots(places)
        self._curve([(places[0], places[-1])], "straight", Pen.MAIN)
        third = len(places) // 3
        along = places[0] + (places[-1] - places[0]) * 0.62
        side = 1j if (places[third] - places[0]).imag < (along - places[0]).imag / 2 else -1j
        self._label(
            self.tell.letter(f"{self.tell.keeps} work"), along, side, "straight", large=True
        )
        k = 2 * len(places) // 3
        self._label(self.tell.work, places[k], -side, "work", large=True)
        for k in range(1, len(places) - 1):
            level = self.at(PointName(f"D {k}"))
            self._thin(level, places[k])
            self._label(f"{k}''", places[k], 1j if places[k].imag > level.imag else -1j, f"A {k}")

    def _energies(self, foot: complex) -> None:
        places = self.places(self.made.energies)
        self._curve([_smooth(places)], "T")
        self._dots(places)
        for place in places[1:-1]:
            self._thin(complex(place.real, foot.imag), place)

    def _inertia(self, feet: dict[str, complex]) -> None:
        made = self.made
        places = self.places(made.inertias)
        self._curve([_smooth(places)], "J")
        self._dots(places)
        turned, curve = self.places(made.turned), self.places(made.curve)
        corner = complex(feet["E"].real, feet["J"].imag)
        reach = max((spot - corner).real for spot in turned) + 6.0
        self._thin(corner, corner + reach * (1 + 1j))
        self._label("45°", corner + reach * (1 + 1j), 1.0, "45")
        for place, spot, point in zip(places, turned, curve, strict=False):
            self._thin(complex(place.real, feet["J"].imag), place)
            self._thin(place, spot)
            self._thin(spot, point)
        for place, point in zip(self.places(made.energies), curve, strict=False):
            self._thin(place, point)

    def _energy_mass(self, foot: complex) -> None:
        made, tell = self.made, self.tell
        curve = self.places(made.curve)
        width = max((z - foot).real for z in curve)
        upper, lower = self.at(made.upper), self.at(made.lower)
        heights = [(z - foot).imag for z in (*curve, upper, lower)]
        up = f"{tell.letter('energy gain')}, {tell.unit('J')}"
        self._axes(foot, width + 8.0, heights, up, tell.letter("reduced inertia"), left=True)
        self._curve([_smooth([*curve, curve[0]])], "E")
        self._dots(curve)
        every = max(1, self.drawing.count // 12)
        middle = sum(curve) / len(curve)
        for k, place in enumerate(curve):
            if k % every == 0:
                self._label(str(k), place, place - middle, f"E {k}")
        tangents = ((upper, "K", "max", 0), (lower, "L", "min", 1))
        step = self.drawing.flywheel.cycle / self.drawing.count
        found = self.drawing.points.tangents
        for cut, letter, name, number in tangents:
            at = found.at_max if number == 0 else found.at_min
            touch = curve[round(at / step)]
            way = touch - cut
            if abs(way) < 1e-9:
                way = 10.0 * complex(1.0, np.tan(np.radians(self.drawing.psi[number])))
            beyond = touch + way / abs(way) * 15.0
            self.items.append(Stroke((cut, beyond), Pen.MAIN, tag="diagram tangent"))
            self.items.append(Disc(cut, _POINT, Ink.BLACK, letter))
            self._label(letter, cut, -1.0, letter, large=True)
            psi = f"ψ_{{{name}}} = {tell._angle(self.drawing.psi[number])}°"
            self._label(psi, beyond, 1j if number == 0 else 1.0, f"psi {name}")


def _smooth(places: Sequence[complex]) -> list[complex]:
    """Return a smooth line through points (Catmull and Rom's): closed if it ends where it began."""
    closed = abs(places[0] - places[-1]) < 1e-9
    before = places[-2] if closed else 2 * places[0] - places[1]
    after = places[1] if closed else 2 * places[-1] - places[-2]
    ends = [before, *places, after]
    line: list[complex] = []
    for k in range(1, len(ends) - 2):
        a, b, c, d = ends[k - 1 : k + 3]
        for part in range(_FINE):
            t = part / _FINE
            line.append(
                b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))
            )
    return [*line, places[-1]]


# Further diagrams --------------------------------------------------------------------------------


def speed_diagram(solution: Solution, indices: Sequence[int], manner: Manner) -> Viewed:
    """Return by how much the speed of the steady motion differs from the mean one."""
    tell, flywheel = _teller(solution, manner), flywheel_of(solution)
    width, height = _diagram_room(manner)
    at = np.linspace(0.0, flywheel.cycle, 721)
    omega = flywheel.speeds(np.append(at[:-1], 0.0))[0] - flywheel.middle_speed
    per_mm = choose_scale((0.0, float(np.ptp(omega))), (1.0, height))
    across = flywheel.cycle / width
    places = tuple(complex(t / across, y / per_mm) for t, y in zip(at, omega, strict=True))
    count = flywheel.machine.count
    marks = tuple(width * k / count for k in range(count + 1))
    unit = tell.unit("1/s")
    picture = diagram_picture(
        Abscissae("φ", marks, tuple(map(str, range(count + 1)))),
        Ordinates(f"ω − {tell.letter('mean speed')}, {unit}", per_mm, tell.say),
        [Curve("", (places,))],
        letter_height=manner.letter,
        name="speed",
    )
    scale = Scale("mu_ω", per_mm, "1/s")
    told = [tell.scale("ω", per_mm, "1/s")]
    return Viewed(named(picture, manner.entry.title or tell.said.speed, told, manner),
                  "diagram", scale)  # fmt: skip


def _diagram_room(manner: Manner) -> tuple[float, float]:
    column = manner.width(manner.sizes.column)
    return 0.75 * column, 0.22 * column


def load_diagrams(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the forces that change, over the strokes of their points, one beside another."""
    tell, flywheel = _teller(solution, manner), flywheel_of(solution)
    width, height = _diagram_room(manner)
    dynamics = solution.problem.dynamics
    assert dynamics is not None
    blocks: list[Block] = []
    turned = _fine(flywheel)
    moved = flywheel.turn.at(turned)
    for load in dynamics.loads:
        if not isinstance(load, Load) or not isinstance(load.size, Table):
            continue
        (force,) = (one.force for one in external(moved, dynamics, load.link)
                    if one.name == load.name)  # fmt: skip
        way = flywheel.turn.course(load.at)
        along = (moved.points[load.at].place * way.conjugate()).real
        stroke = float(np.ptp(along))
        # from the end where position 0 is, or nearer to
        start = along.min() if along[0] - along.min() <= along.max() - along[0] else along.max()
        share = np.abs(along - start) / stroke
        values = (force * way.conjugate()).real
        if values[int(np.argmax(np.abs(values)))] < 0.0:
            values = -values
        per_mm = choose_scale((0.0, float(np.ptp(np.append(values, 0.0)))), (1.0, height))
        mu_s = choose_scale((stroke, 0.0), (0.7 * width, 1.0))
        places = tuple(
            complex(s * stroke / mu_s, y / per_mm) for s, y in zip(share, values, strict=True)
        )
        name = point_name(load.at)
        picture = diagram_picture(
            Abscissae(f"s_{{{name}}}", (0.0, stroke / mu_s), ("0", "H")),
            Ordinates(f"{load.name}, {tell.unit('N')}", per_mm, tell.say),
            [Curve("", (places,))],
            letter_height=manner.letter,
            name=f"load {load.name}",
        )
        metres = f"{tell.say.found(stroke)} {tell.unit('m')}"
        told = "; ".join(
            (
                tell.said.over_stroke.format(stroke=metres),
                tell.scale("F", per_mm, "N"),
                tell.scale("s", mu_s, "m"),
            )
        )
        title = manner.entry.title or tell.said.load.format(name=load.name, point=name)
        blocks.append(named(picture, title, [told], manner))
    return (
        Row(blocks[:2], gap=12.0, align="bottom") if blocks else Picture((), (0.0, 0.0, 0.0, 0.0))
    )


def _fine(flywheel: Flywheel) -> Reals:
    """Return angles turned from which a curve of a load is drawn: both sides of every jump."""
    edges = flywheel.moment.edges
    inside = [
        np.linspace(low + 1e-7, high - 1e-7, max(int((high - low) / 0.02), 2))
        for low, high in pairwise(edges.tolist())
    ]
    return np.concatenate(inside)


# Table -------------------------------------------------------------------------------------------


def machine_table(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return what is reduced to the crank, work, energy and speed by positions."""
    tell = _teller(solution, manner)
    height = manner.text(min(manner.sizes.text, 3.5))
    columns = [
        TableColumn(head, tuple(cells), unit=unit, least=8.0)
        for head, unit, cells in tell.columns()
    ]
    title = manner.entry.title or tell.said.table
    table = table_block(columns, height, max_width=table_width(manner), leading=2, title=title,
                        row_height=max(6.0, 2.0 * height))  # fmt: skip
    note = tell.said.lever_agrees.format(lever=tell.letter("moment by lever"))
    return Column([table, paragraph(note, height, table.width)], gap=3.0)


# The wheel ---------------------------------------------------------------------------------------


def wheel_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the flywheel in section and from the side, with its dimensions."""
    tell = _teller(solution, manner)
    sizes = tell.sizes
    height = manner.text(manner.sizes.text)
    if sizes is None:
        return paragraph(tell.conclusions()[0], height, manner.width(manner.sizes.column))
    scale = choose_scale((sizes.diameter, 0.0), (0.3 * manner.width(manner.sizes.column), 1.0))
    radius, half = sizes.diameter / 2.0 / scale, sizes.width / 2.0 / scale
    bore = sizes.bore / 2.0 / scale or 0.12 * radius
    middle = complex(radius + half + 16.0, 0.0)
    items: list[Item] = [Arc(middle, radius), Arc(middle, bore)]
    for sign in (1.0, -1.0):
        ring = (complex(-half, sign * bore), complex(half, sign * bore),
                complex(half, sign * radius), complex(-half, sign * radius))  # fmt: skip
        items += [Stroke(ring, Pen.MAIN, closed=True), *hatch(ring)]
    if sizes.shape is Shape.DISC:
        items += [Stroke((complex(x, -bore), complex(x, bore)), Pen.MAIN) for x in (-half, half)]
    reach = radius + 4.0
    items += [
        Stroke((complex(-half - 8.0, 0.0), complex(half + 8.0, 0.0)), Pen.AXIS),
        Stroke((middle - reach, middle + reach), Pen.AXIS),
        Stroke((middle - 1j * reach, middle + 1j * reach), Pen.AXIS),
    ]
    size = max(3.5, height)
    items += _measure(complex(-half, -radius), complex(half, -radius), -9j, "b", size)
    if sizes.bore:
        aside = -10.0 - 2.5 * size  # beside the other diameter, inside of it
        items += _measure(complex(-half, -radius), complex(-half, radius), aside, "D", size)
        items += _measure(complex(-half, -bore), complex(-half, bore), -10.0, "D_{1}", size)
    else:
        items += _measure(complex(-half, -radius), complex(-half, radius), -10.0, "D", size)
    picture = Picture(tuple(items), ink_bounds(items))
    told = ["; ".join(tell.size_lines(sizes))]
    lines = paragraph(told[0], height, manner.width(manner.sizes.column))
    title = manner.entry.title or tell.said.sizes[sizes.shape.value]
    return named(picture, title, [tell.scale("l", scale, "m"), lines], manner)


def _measure(one: complex, two: complex, aside: complex, letter: str, size: float) -> list[Item]:
    """Return a dimension with its extension lines; ``aside`` is where it stands."""
    beyond = aside / abs(aside) * 2.0
    tail, head = one + aside, two + aside
    way = (head - tail) / abs(head - tail)
    outside = abs(head - tail) < 12.0
    items: list[Item] = [
        Stroke((one, tail + beyond), Pen.THIN),
        Stroke((two, head + beyond), Pen.THIN),
        Stroke((tail - 7.0 * way, head + 7.0 * way) if outside else (tail, head), Pen.THIN),
        *arrowhead(tail, way if outside else -way, length=3.0),
        *arrowhead(head, -way if outside else way, length=3.0),
    ]
    text, middle = typeset(letter, size), (tail + head) / 2.0
    if abs(way.imag) > 0.5:  # left of an upright dimension, off its middle where axes go
        place = middle + complex(-text.width - 1.2, 0.25 * abs(head - tail))
    elif outside:
        place = head + complex(8.5, -size / 2.0)
    else:
        place = middle + complex(-text.width / 2.0, 1.2)
    return [*items, *text.at(place)]
