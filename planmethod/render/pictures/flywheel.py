"""The diagrams of a flywheel as they are constructed: moment, work, energy, inertia (диаграммы)."""

# no messages: tags of items

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np

from planmethod.construct.scale import series_near
from planmethod.construct.steps import PointName
from planmethod.note.narrate.machine import MachineNarrator
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import DIMENSION, dimension, straight_arrow
from planmethod.solved.legibility import RATIOS
from planmethod.solved.machine.drawing import FlywheelDrawing

POLE = "pole of the moments"
"""Tag of the pole of the diagram of moments."""

_BEYOND, _TICK = 10.0, 1.2  # mm: an axis beyond its diagram, a tick
_POINT = 0.7  # mm: radius of a point of a diagram
_FINE = 8  # pieces of a smooth line between two points
_READABLE = 25.0  # mm: a narrower energy-mass curve is shown enlarged
_WIDEST, _ABOVE = 130.0, 26.0  # mm: width of the enlarged curve; distance from the diagram
_STEP = 0.01  # rad: between points of an exact curve


def construction_picture(
    drawing: FlywheelDrawing, narrator: MachineNarrator, letter: float
) -> Picture:
    """Return the diagrams of the construction, mm; ``letter`` is the height of its letters."""
    return _Sketch(drawing, narrator, letter).picture()


class _Sketch:
    """Draws the diagrams, mm of the construction."""

    def __init__(self, drawing: FlywheelDrawing, narrator: MachineNarrator, letter: float) -> None:
        self.drawing, self.narrator, self.height = drawing, narrator, letter
        self.made, self.size = drawing.construction, max(2.5, 0.7 * letter)
        self.items: list[Item] = []
        self.labels: list[Label] = []

    def at(self, name: PointName) -> complex:
        return complex(self.drawing.exact.point(name)[0])

    def places(self, names: Sequence[PointName]) -> list[complex]:
        return [self.at(name) for name in names]

    def picture(self) -> Picture:
        made, narrator = self.made, self.narrator
        length = self.drawing.length
        feet = {key: self.at(axes.origin) for key, axes in made.axes.items()}
        units = {"M": f"{narrator.moment}, {narrator.unit('N·m')}",
                 "A": f"A, {narrator.unit('J')}",
                 "T": f"{narrator.letter('energy gain')}, {narrator.unit('J')}",
                 "J": f"{narrator.letter('reduced inertia')}, {narrator.unit('kg·m²')}",
                 "T_II": f"{narrator.letter('second energy')}, {narrator.unit('J')}",
                 "T_I": f"{narrator.letter('first energy')}, {narrator.unit('J')}"}  # fmt: skip
        points = {"M": made.moments, "A": made.work, "T": made.energies, "J": made.inertias}
        if self.drawing.by_mertsalov:
            points |= {"T_II": made.second, "T_I": made.curve}
        for key, names in points.items():
            ordinates = [z.imag - feet[key].imag for z in self.places(names)]
            if key == "M":
                ordinates += [z.imag for piece in self._moment_curve(0j) for z in piece]
            self._axes(feet[key], length, ordinates, units[key], "φ")
            self._numbers(key, feet[key], ordinates)
        self._moment(feet["M"])
        self._work(feet["A"])
        self._ordinates("T", made.energies[1:-1], made.energies, feet["T"])
        if self.drawing.by_mertsalov:
            for key in ("J", "T_II", "T_I"):
                self._ordinates(key, points[key], points[key], feet[key])
            self._differences(feet)
        else:
            self._inertia(feet)
            self._energy_mass(feet["E"])
        return lettered(self.items, self.labels)

    # Parts -----------------------------------------------------------------------------------

    def _thin_line(self, *points: complex, pen: Pen = Pen.THIN) -> None:
        self.items.append(Stroke(points, pen, tag="diagram construction"))

    def _axes(
        self,
        origin: complex,
        right: float,
        ordinates: Sequence[float],
        y_name: str,
        x_name: str,
        *,
        left: bool = False,
    ) -> None:
        """Draw the axes of a diagram; ``left``: the name of the ordinates is left of them."""
        low, high = min([0.0, *ordinates]), max([0.0, *ordinates])
        tip, top = origin + right + _BEYOND, origin + 1j * (high + _BEYOND)
        self.items += [
            *straight_arrow(origin, tip, tag="diagram axis"),
            *straight_arrow(origin + 1j * low, top, tag="diagram axis"),
        ]
        self._label(x_name, tip - 2.0, -1j, f"axis {y_name}", large=True)
        name = typeset(y_name, self.height)
        beside = -name.width - 3.0 if left else 2.5
        self.items += name.at(top + complex(beside, -self.height))

    def _numbers(self, key: str, origin: complex, ordinates: Sequence[float]) -> None:
        count = self.drawing.count
        step = self.drawing.length / count
        every = next(n for n in (1, 2, 3, 4, 6, 12, count) if n * step >= 3.0 * self.size)
        for k, number in enumerate(self.drawing.flywheel.turn.numbers(count)):
            place = origin + k * step
            self.items.append(
                Stroke((place - 1j * _TICK, place + 1j * _TICK), Pen.THIN, tag="diagram axis")
            )
            if k % every == 0:
                side = -1j if ordinates[k] >= 0.0 else 1j
                self._label(str(number), place, side, f"{key}: position {number}")

    def _label(
        self, text: str, at: complex, prefer: complex, name: str, *, large: bool = False
    ) -> None:
        size = self.height if large else self.size
        self.labels.append(
            Label(typeset(text, size), at, prefer=prefer, gap=1.4, name=f"flywheel {name}",
                  priority=int(large), style=BUSY)
        )  # fmt: skip

    def _curve(self, parts: Iterable[Sequence[complex]], letter: str, pen: Pen = Pen.MAIN) -> None:
        self.items += [Stroke(tuple(part), pen, tag=f"diagram curve {letter}") for part in parts]

    def _dots(self, places: Sequence[complex]) -> None:
        self.items += [Disc(place, _POINT, Ink.BLACK, "diagram point") for place in places]

    def _moment_curve(self, origin: complex) -> list[list[complex]]:
        """Return the pieces of the curve of the moment, between its jumps."""
        flywheel, scales = self.drawing.flywheel, self.drawing.scales
        pieces: list[list[complex]] = []
        edges = flywheel.moment.edges
        for low, high in pairwise(edges.tolist()):
            at = np.linspace(low, high, max(int((high - low) / _STEP), 1) + 1)
            inside = np.clip(at, low + 1e-9, high - 1e-9)
            heights = flywheel.sign * flywheel.moment.value(inside) / scales.moment
            piece = [origin + complex(t / scales.phi, y) for t, y in zip(at, heights, strict=True)]
            if pieces and abs(pieces[-1][-1] - piece[0]) < 0.05:
                pieces[-1] += piece[1:]
            else:
                pieces.append(piece)
        return pieces

    def _moment(self, origin: complex) -> None:
        flywheel, drawing = self.drawing.flywheel, self.drawing
        scales, made = drawing.scales, self.made
        pieces = self._moment_curve(origin)
        self._curve(pieces, "M")
        for before, after in pairwise(pieces):
            if abs(after[0].real - before[-1].real) < 0.1:
                self.items.append(Stroke((before[-1], after[0]), Pen.THIN, tag="diagram curve M"))
        self._dots(self.places(made.moments))
        pole = self.at(made.pole)
        length = drawing.length
        cuts = []
        for k in range(drawing.count):
            cut = self.at(PointName(f"A cut {k}"))
            cuts.append(cut)
            self._thin_line(pole, cut)
        for place in self.places(made.middles):
            self._thin_line(complex(place.real, origin.imag), place)
            self._thin_line(complex(origin.real, place.imag), place)
        self.items.append(Disc(pole, _POINT, Ink.BLACK, POLE))
        self._label("P", pole, -1.0, "pole", large=True)
        below = min(z.imag for z in cuts) - 6.0
        self._dimension(complex(pole.real, origin.imag), origin, below, "H_{A}")
        constant = float(drawing.points.work[-1]) / flywheel.cycle / scales.moment
        level = origin + 1j * constant
        self._thin_line(level, level + length, pen=Pen.HIDDEN)
        keeps = self.narrator.letter(f"{self.narrator.keeps} moment")
        self._label(keeps, level + 0.9 * length, 1j, "constant", large=True)

    def _dimension(self, tail: complex, head: complex, low: float, letter: str) -> None:
        """Draw a dimension along +x, at a height."""
        low = min(low, tail.imag - 6.0)
        tag, text = f"{DIMENSION} {letter}", typeset(letter, self.size)
        for place in (tail, head):
            self._thin_line(place, complex(place.real, low))
        one, two = complex(tail.real, low), complex(head.real, low)
        self.items += dimension(one, two, -1e-9j, tag=tag)
        above = 1.0 + 0.5 * self.size * ("_" in letter)  # an index hangs below its letter
        self.items += text.at((one + two) / 2 + complex(-text.width / 2, above), label=tag)

    def _work(self, origin: complex) -> None:
        places = self.places(self.made.work)
        self._curve([places], "A")
        self._dots(places)
        self._curve([(places[0], places[-1])], "straight", Pen.MAIN)
        third = len(places) // 3
        along = places[0] + (places[-1] - places[0]) * 0.62
        side = 1j if (places[third] - places[0]).imag < (along - places[0]).imag / 2 else -1j
        self._label(
            self.narrator.letter(f"{self.narrator.keeps} work"), along, side, "straight", large=True
        )
        k = 2 * len(places) // 3
        self._label(self.narrator.work, places[k], -side, "work", large=True)
        numbers = self.drawing.flywheel.turn.numbers(self.drawing.count)
        for k in range(1, len(places) - 1):
            level, number = self.at(PointName(f"D {k}")), numbers[k]
            self._thin_line(level, places[k])
            side = 1j if places[k].imag > level.imag else -1j
            self._label(f"{number}''", places[k], side, f"A {number}")

    def _ordinates(
        self, key: str, upright: Sequence[PointName], names: Sequence[PointName], origin: complex
    ) -> None:
        """Draw a smooth curve through points, with the ordinates of some of them."""
        places = self.places(names)
        self._curve([_smooth(places)], key)
        self._dots(places)
        for place in self.places(upright):
            self._thin_line(complex(place.real, origin.imag), place)

    def _differences(self, feet: dict[str, complex]) -> None:
        """Mark the highest and the lowest point of dT_I, and AB between their levels."""
        made, foot = self.made, feet["T_I"]
        ends = self.at(made.upper), self.at(made.lower)
        right = foot.real + self.drawing.length + 2.0 * _BEYOND
        for letter, end, side in zip(made.letters, ends, (1j, -1j), strict=True):
            self._thin_line(end, complex(right + 2.0, end.imag))
            self.items.append(Disc(end, 1.5 * _POINT, Ink.BLACK, letter))
            self._label(letter, end, side, letter, large=True)
        high, low = (complex(right, end.imag) for end in ends)
        self.items += dimension(low, high, 1e-9 + 0j)[2:]
        self._label(made.segment, (high + low) / 2, 1.0, made.segment, large=True)
        start = self.drawing.second_start
        for key, energy in (("T_II", start), ("T_I", -start)) if start else ():
            text = f"{self.narrator.notation.short(energy, 4)} {self.narrator.unit('J')}"
            self._label(text, feet[key], -1.0, f"start of {key}")

    def _inertia(self, feet: dict[str, complex]) -> None:
        made = self.made
        places = self.places(made.inertias)
        self._curve([_smooth(places)], "J")
        self._dots(places)
        turned, curve = self.places(made.diagonal), self.places(made.curve)
        corner = complex(feet["E"].real, feet["J"].imag)
        reach = max((spot - corner).real for spot in turned) + 6.0
        self._thin_line(corner, corner + reach * (1 + 1j))
        self._label("45°", corner + reach * (1 + 1j), 1.0, "45")
        for place, spot, point in zip(places, turned, curve, strict=False):
            self._thin_line(complex(place.real, feet["J"].imag), place)
            self._thin_line(place, spot)
            self._thin_line(spot, point)
        for place, point in zip(self.places(made.energies), curve, strict=False):
            self._thin_line(place, point)

    def _energy_mass(self, origin: complex) -> None:
        made, narrator = self.made, self.narrator
        curve = self.places(made.curve)
        width = max((z - origin).real for z in curve)
        upper, lower = self.at(made.upper), self.at(made.lower)
        heights = [(z - origin).imag for z in (*curve, upper, lower)]
        up = f"{narrator.letter('energy gain')}, {narrator.unit('J')}"
        self._axes(origin, width + 8.0, heights, up, narrator.letter("reduced inertia"), left=True)
        self._curve([_smooth([*curve, curve[0]])], "E")
        self._dots(curve)
        every = max(1, self.drawing.count // 12)
        middle = sum(curve) / len(curve)
        numbers = self.drawing.flywheel.turn.numbers(self.drawing.count)
        if self._enlarge(origin + 1j * max(heights), curve, numbers):
            numbers = numbers[:1]
        told: list[complex] = []
        for k, (place, number) in enumerate(zip(curve, numbers, strict=False)):
            clear = all(abs(place - other) > self.size for other in told)
            if k % every == 0 and clear:  # of close points only the first has a number
                told.append(place)
                self._label(str(number), place, place - middle, f"E {number}")
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
            psi = f"ψ_{{{name}}} = {narrator._angle(self.drawing.psi[number])}°"
            self._label(psi, beyond, 1j if number == 0 else 1.0, f"psi {name}")

    def _enlarge(self, below: complex, curve: Sequence[complex], numbers: Sequence[int]) -> bool:
        """Draw a small loop again, enlarged above itself; return whether there is space for it.

        The axis of the inertia under it does not begin at zero, as its heading states.
        """
        width, height = (float(np.ptp([part(z) for z in curve])) for part in (np.real, np.imag))
        if min(width, height) >= _READABLE or max(width, height) < _POINT:
            return False
        top = max(self.at(name).imag for name in (*self.made.moments, *self.made.work))
        room = top + _BEYOND - below.imag - _ABOVE - 3.5 * self.height
        fitting = [n for n in RATIOS if n * width <= _WIDEST and n * height <= room]
        if not fitting:
            return False
        times, notation, narrator = fitting[-1], self.narrator.notation, self.narrator
        low = complex(min(z.real for z in curve), min(z.imag for z in curve))
        corner = below + complex(_BEYOND, _ABOVE)
        larger = [corner + times * (z - low) for z in curve]
        self.items.append(
            Stroke(tuple(_smooth([*larger, larger[0]])), Pen.MAIN, tag="diagram enlarged")
        )
        self.items += [Disc(place, _POINT, Ink.BLACK, "diagram enlarged") for place in larger]
        middle, named = sum(larger) / len(larger), list[complex]()
        for place, number in zip(larger, numbers, strict=False):
            if all(abs(place - other) > self.size for other in named):
                named.append(place)
                self._label(str(number), place, place - middle, f"enlarged {number}")
        level = corner.imag - 8.0
        end = corner.real + times * width + _BEYOND
        start = complex(corner.real - _BEYOND, level)
        self.items += straight_arrow(start, complex(end, level), tag="diagram axis")
        self._label(
            narrator.letter("reduced inertia"), complex(end - 2.0, level), -1j, "enlarged J"
        )
        inertia = self.drawing.points.inertia
        first, last = float(np.min(inertia)), float(np.max(inertia))
        step = series_near((last - first) / 3.0, up=True)
        for n in range(int(np.ceil(first / step)), int(np.floor(last / step)) + 1):
            x = corner.real + times * (n * step - first) / self.drawing.scales.inertia
            self._thin_line(complex(x, level - _TICK), complex(x, level + _TICK))
            told = notation.as_input(float(f"{n * step:.6g}"))
            self._label(told, complex(x, level), -1j, f"enlarged J {n}")
        text = narrator.texts.loop.format(
            times=notation.as_input(times),
            letter=narrator.letter("reduced inertia"),
            unit=narrator.unit("kg·m²"),
        )
        heading = complex(corner.real - _BEYOND, corner.imag + times * height + 2.5 * self.height)
        self.items += typeset(text, self.size).at(heading)
        return True


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
