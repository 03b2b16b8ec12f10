"""Scheme of a train from the side, the axes level (кинематическая схема, вид сбоку)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from msgspec import Struct

from planmethod.construct.scale import series_near
from planmethod.gears.model import PARALLEL, GearProblem, MeshKind
from planmethod.gears.motion import ContactKind, ContactPoint, solve_motion
from planmethod.gears.scheme import (
    Arrangement,
    AxisPart,
    Rim,
    SchemeData,
    Stub,
    TransverseBody,
    Worm,
    arrange,
    best_order,
    scheme_parts,
)
from planmethod.render.ink.drawing import Arc, Disc, Drawing, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import ink_bounds, typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.layout.block import Row
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import (
    SIZES,
    before_links,
    ground_line,
    guide_plates,
    revolute,
    straight_arrow,
    turn_arrow,
    unit,
)
from planmethod.render.symbols.elements import (
    PITCH_POINT,
    bell_profile,
    ring_profile,
    wheel_profile,
)
from planmethod.render.symbols.marks import axis_line, centre_lines

STEP, INNER_STEP = 14.0, 10.0
"""Between two columns; between a column and its own web or arm, mm."""

SLOT = 13.0
"""Space of a bearing along the axis, mm."""

WALL = 1.7
"""From a shaft to the hollow one about it, mm."""

SENSE_OFFSET = 3.5
"""From a wheel to the arrow of its sense, mm."""

HALF_SENSE = 6.0
"""Half the length of such an arrow, mm."""

SENSE = "sense"

BUSH = 3.0
"""Half the length of a bush, and the overhang of a shaft beyond it, mm."""


class SideView(Struct, frozen=True, dict=True):
    """The side view of an arrangement; its main axis is level zero, its first station x = 0.

    Attributes
    ----------
    letters : mapping
        Letters of points of contact and axes.
    """

    arrangement: Arrangement
    letters: Mapping[ContactPoint, str]

    @cached_property
    def _gaps(self) -> Mapping[int, list[tuple[float, list[Stub]]]]:
        """By gap, the stubs of each axis in order, with its height."""
        found: dict[int, dict[float, list[Stub]]] = {}
        for stub in self.arrangement.stubs.values():
            height = round(self._height(stub.body), 6)
            found.setdefault(stub.gap, {}).setdefault(height, []).append(stub)
        return {
            gap: [(height, sorted(own, key=lambda s: s.rank)) for height, own in axes.items()]
            for gap, axes in found.items()
        }

    def _height(self, body: str) -> float:
        return self.arrangement.scheme.heights[body]

    def _gap_width(self, gap: int) -> float:
        """Return the width of a gap, mm."""
        stubs = max((len(own) for _, own in self._gaps.get(gap, ())), default=0)
        stations = self.arrangement.stations
        if gap in (-1, len(stations) - 1):
            return SLOT * stubs
        one, other = stations[gap], stations[gap + 1]
        own = one.column == other.column
        if own and (one.part is AxisPart.APEX or other.part is AxisPart.APEX or one.offset):
            return other.offset - one.offset
        return max(INNER_STEP if own else STEP, SLOT * stubs + 3.0)

    @cached_property
    def places(self) -> tuple[float, ...]:
        """Positions of the stations along the axes, mm."""
        places = [0.0]
        for gap in range(len(self.arrangement.stations) - 1):
            places.append(places[-1] + self._gap_width(gap))
        return tuple(places)

    def _slot(self, stub: Stub) -> float:
        """Return the position of the bearing of a stub, mm."""
        axes = self._gaps[stub.gap]
        own = next(stubs for _, stubs in axes if stub in stubs)
        room = self._gap_width(stub.gap)
        start = -room if stub.gap < 0 else self.places[stub.gap]
        return start + room * (own.index(stub) + 0.5) / len(own)

    def _ends(self, body: str) -> tuple[float, float]:
        """Return both ends of the shaft of a body, mm."""
        numbers = self.arrangement.at[body]
        ends = [self.places[k] for k in numbers]
        stub = self.arrangement.stubs.get(body)
        if stub is not None:
            slot = self._slot(stub)
            over = 0.0 if body in self.arrangement.scheme.motion.train.fixed else SLOT / 2 - 1.0
            ends += [slot - over, slot + over] if slot < ends[0] or slot > ends[-1] else [slot]
            if slot < ends[0]:
                ends.remove(slot + over)
        if body in self.arrangement.scheme.over:  # out of the bush of the carrier
            for k in numbers:
                if self.arrangement.stations[k].part is AxisPart.ARM:
                    ends += [self.places[k] - BUSH, self.places[k] + BUSH]
        elif self._bore(body):
            ends += [min(ends) - BUSH, max(ends) + BUSH] if stub is None else []
        return min(ends), max(ends)

    def _bore(self, body: str) -> float:
        """Return half the width of the hollow shaft of a body, 0 of a plain one, mm."""
        inner = self.arrangement.inner(body)
        return WALL + max(map(self._bore, inner)) if inner else 0.0

    # Items ---------------------------------------------------------------------------------------

    def items(self) -> list[Item]:
        """Return the lines."""
        shafts = [item for body in self.arrangement.reach for item in self._shaft(body)]
        stations = [item for k in range(len(self.places)) for item in self._station(k)]
        return before_links(
            [
                *self._axes(),
                *stations,
                *shafts,
                *self._wide(),
                *self._belts_racks_worms(),
                *self._dots(),
            ]
        )

    def _axes(self) -> Iterator[Item]:
        """Yield the axes where no shaft is on them."""
        levels: dict[float, list[tuple[float, float]]] = {}
        for body in self.arrangement.reach:
            levels.setdefault(round(self._height(body), 6), []).append(self._ends(body))
        for height, ends in levels.items():
            reached = min(ends)[1]
            for start, end in sorted(ends):
                if start > reached + 1.0:
                    yield from axis_line(complex(reached, height), complex(start, height))
                reached = max(reached, end)

    def _shaft(self, body: str) -> Iterator[Item]:
        height, (start, end) = self._height(body), self._ends(body)
        bore, tag = self._bore(body), f"link {body}"
        for level in (height - bore, height + bore) if bore else (height,):
            if end - start > 0.01:
                yield Stroke((complex(start, level), complex(end, level)), tag=tag)
        stub = self.arrangement.stubs.get(body)
        if stub is None:
            return
        at = complex(self._slot(stub), height)
        if body not in self.arrangement.scheme.motion.train.fixed:
            yield from guide_plates(at, length=SIZES.bearing, width=SIZES.shaft + 2 * bore)
            return
        side = 1 if at.real <= start + 0.01 else -1
        half = 1j * (SIZES.bearing / 2 + bore)
        yield from ground_line(at - half, at + half, side=side)

    def _station(self, number: int) -> Iterator[Item]:
        station, x = self.arrangement.stations[number], self.places[number]
        if station.transverse is not None:
            yield from self._transverse_items(station.transverse, x)
        if self._is_conic(number):
            return  # drawn with its mate
        if station.part is AxisPart.ARM:
            yield from self._arm(station.body, x)
        elif station.part is AxisPart.WEB:
            (ring,) = station.rims
            column = self._column(station.column)
            for way in ring.mesh_sides:
                yield from bell_profile(
                    complex(column, ring.centre),
                    ring.reach(way),
                    web=x - column,
                    side=way,
                    bore=self._bore(ring.body),
                    tag=f"link {ring.body}",
                )
        for rim in station.rims if station.part is AxisPart.RIMS else ():
            at = complex(x, rim.centre)
            if any(worm.is_level and worm.rim == rim for worm in self.arrangement.scheme.worms):
                continue
            if not rim.ring:
                ways = self._halves(number, rim)
                bore, tag = self._bore(rim.body), f"link {rim.body}"
                if not rim.reaches:
                    yield from wheel_profile(at, rim.radius, sides=ways, bore=bore, tag=tag)
                for way in ways if rim.reaches else ():
                    yield from wheel_profile(at, rim.reach(way), sides=(way,), bore=bore, tag=tag)
            elif rim.body in self.arrangement.scheme.motion.train.fixed:
                for way in rim.mesh_sides:
                    yield from ring_profile(at, rim.reach(way), support=4.0, side=way)

    def _is_conic(self, number: int) -> bool:
        column = self.arrangement.stations[number].column
        return column >= len(self.arrangement.scheme.columns)

    def _transverse_items(self, transverse: TransverseBody, x: float) -> Iterator[Item]:
        """Yield a transverse body, and the level bevel wheels that it meshes with."""
        column = next(s for s in self.arrangement.stations if s.transverse == transverse).column
        tag, levels = f"link {transverse.body}", []
        for station, at in zip(self.arrangement.stations, self.places, strict=True):
            if station.column != column or station.part is not AxisPart.RIMS:
                continue
            (rim,) = station.rims
            cone = next(c for c in transverse.cones if c.rim == rim)
            side = 1 if at > x else -1
            apex = complex(x, rim.centre)
            along = unit(complex(side * cone.radius, rim.radius))
            out = complex(along.imag * side, -along.real * side) * SIZES.mesh / 2
            touch = complex(at, rim.centre + rim.radius)
            bar = along * SIZES.teeth / 2
            bore = self._bore(rim.body)
            own = f"link {rim.body}"
            for way in (1, -1):
                level = [
                    apex + _mirrored(z - apex, way) for z in (touch + out - bar, touch + out + bar)
                ]
                foot = complex((touch + out).real, rim.centre + way * bore)
                yield Stroke(tuple(level), tag=own)
                yield Stroke((foot, apex + _mirrored(touch + out - apex, way)), tag=own)
                if abs(foot.real - at) > 0.01 and not bore:
                    yield Stroke((complex(at, rim.centre), foot), tag=own)
            height = (touch - out).imag
            levels.append(height)
            hub = WALL if transverse.carrier else 0.0
            for way in (1, -1):
                near = [touch - out + z - apex for z in (-bar, bar)]
                both = tuple(apex + complex(way * z.real, z.imag) for z in near)
                yield Stroke(both, tag=tag)
                rim_end = complex(x + way * abs((touch - out).real - x), height)
                yield Stroke((complex(x + way * hub, height), rim_end), tag=tag)
            if not transverse.carrier:
                yield from self._sense(rim, at + side * SENSE_OFFSET)
                if cone == transverse.cones[0]:
                    middle = complex(x - side * 0.5 * cone.radius, height - SENSE_OFFSET)
                    yield from self._transverse_sense(rim, side, middle, cone.radius)
        low, high = min(levels), max(levels)
        if transverse.carrier:
            for way in (1, -1):
                hub_x = x + way * WALL
                yield Stroke((complex(hub_x, low - BUSH), complex(hub_x, high + BUSH)), tag=tag)
            start = self._height(transverse.carrier) + self._bore(transverse.carrier)
            pin = (complex(x, start), complex(x, high + BUSH + 1.5))
            yield Stroke(pin, tag=f"link {transverse.carrier}")
        else:
            top = complex(x, high + SLOT / 2 + 2.0)
            yield Stroke((complex(x, low), top + 1j * SLOT / 2), tag=tag)
            yield from guide_plates(top, angle=90, length=SIZES.bearing, width=SIZES.shaft)

    def _belts_racks_worms(self) -> Iterator[Item]:
        """Yield belts, racks, and worms seen along their axes."""
        scheme = self.arrangement.scheme
        for mesh in scheme.motion.train.meshes:
            if mesh.kind in (MeshKind.BELT, MeshKind.CROSSED, MeshKind.CHAIN):
                column = self._column_with(mesh.first, mesh.second)
                rims = {rim.label: rim for rim in scheme.columns[column]}
                one, other = rims[mesh.first], rims[mesh.second]
                levels = [r.centre + w * r.radius for r in (one, other) for w in (1, -1)]
                for shift in (-1.5, 1.5):
                    x = self._column(column) + shift
                    yield Stroke((complex(x, min(levels)), complex(x, max(levels))), Pen.THIN)
            if mesh.kind is MeshKind.RACK:
                column = self._column_with(mesh.first)
                rim = next(r for r in scheme.columns[column] if r.label == mesh.first)
                at = complex(self._column(column), rim.centre - rim.radius - SIZES.mesh / 2)
                half, tag = SIZES.teeth / 2, f"link {mesh.second}"
                low = at - 4j
                yield Stroke((at - half, at + half, low + half, low - half), closed=True, tag=tag)
                yield from ground_line(low - half - 2.0, low + half + 2.0)
        for worm in scheme.worms:
            at, tag = self._worm(worm), f"link {worm.label}"
            yield Arc(at, worm.radius, pen=Pen.MAIN if worm.is_level else Pen.THIN, tag=tag)
            yield from centre_lines(at, worm.radius)
            if worm.is_level:
                yield from revolute(at)
                yield from self._thread(worm.rim)
            yield from self._sense(
                worm.rim, self._column(self._column_with(worm.rim.label)) - SENSE_OFFSET
            )
            speed = scheme.motion.speeds[scheme.motion.train.body_of[worm.label]]
            turned = (
                worm.radius - SENSE_OFFSET
                if worm.radius > 2 * SENSE_OFFSET
                else worm.radius + SENSE_OFFSET
            )
            yield from turn_arrow(
                at, turned, _sign(speed), middle=225.0, sweep=min(110.0, 900.0 / turned),
                tag=SENSE,
            )  # fmt: skip

    def _sense(self, rim: Rim, x: float) -> Iterator[Item]:
        """Yield the arrow of how the near side of a level wheel moves: down if it turns positively.

        A positive speed is then counter-clockwise seen from the right, and worm and wheel turn as
        the equation of their mesh has it.
        """
        speed = self.arrangement.scheme.motion.speeds[rim.body]
        middle = complex(x, rim.centre + 0.5 * rim.radius)
        half = -1j * _sign(speed) * min(HALF_SENSE, 0.35 * rim.radius)
        if speed:
            yield from straight_arrow(middle - half, middle + half, tag=SENSE)

    def _transverse_sense(
        self, rim: Rim, side: int, middle: complex, radius: float
    ) -> Iterator[Item]:
        """Yield the arrow of the wheel across: both arrows point to the pitch point, or from it.

        The near side of the level wheel, whose pitch point is above, moves down if it turns
        positively: from that point, which is on the given side of the wheel across.
        """
        speed = self.arrangement.scheme.motion.speeds[rim.body]
        half = -side * _sign(speed) * min(HALF_SENSE, 0.35 * radius)
        if speed:
            yield from straight_arrow(middle - half, middle + half, tag=SENSE)

    def _worm(self, worm: Worm) -> complex:
        """Return where the axis of a worm, or of its wheel, stands across the paper."""
        column = self._column_with(worm.rim.label)
        return complex(self._column(column), worm.rim.centre - worm.rim.radius - worm.radius)

    def _thread(self, rim: Rim) -> Iterator[Item]:
        """Yield a worm from the side: its outline with the turns of its thread."""
        at = complex(self._column(self._column_with(rim.label)), rim.centre)
        half = complex(rim.radius + 1.0, rim.radius - SIZES.mesh / 2)
        corners = (half, half.conjugate(), -half, -half.conjugate())
        yield Stroke(tuple(at + corner for corner in corners), closed=True, tag=f"link {rim.body}")
        for turn in (-0.7, -0.2, 0.3):
            low, high = complex(turn, -1), complex(turn + 0.4, 1)
            ends = (complex(z.real * half.real, z.imag * half.imag) for z in (low, high))
            yield Stroke(tuple(at + z for z in ends), Pen.THIN)

    def _column_with(self, *labels: str) -> int:
        return next(
            k
            for k, column in enumerate(self.arrangement.scheme.columns)
            if set(labels) <= {rim.label for rim in column}
        )

    def _column(self, column: int) -> float:
        return next(
            x
            for station, x in zip(self.arrangement.stations, self.places, strict=True)
            if station.part is AxisPart.RIMS and station.column == column
        )

    def _halves(self, number: int, rim: Rim) -> tuple[int, ...]:
        """Return which halves of a wheel are drawn: also the one that meshes with none, if free."""
        if len(rim.mesh_sides) == 2:
            return rim.mesh_sides
        way = -rim.mesh_sides[0]
        low, high = sorted((rim.centre, rim.centre + way * (rim.radius + SIZES.mesh)))
        others = (
            span
            for other in self.arrangement.stations[number].rims
            if other is not rim
            for span in other.spans()
        )
        taken = any(a < high and low < b for a, b in others)
        crossed = any(self.arrangement.crosses(number, low, high, rim.body))
        return rim.mesh_sides if taken or crossed else (*rim.mesh_sides, way)

    def _arm(self, carrier: str, x: float) -> Iterator[Item]:
        """Yield an arm with the bushes of the axes that it carries."""
        tag, foot = f"link {carrier}", self._height(carrier)
        bore = self._bore(carrier)
        for way in (1, -1):
            heights = sorted(
                {round(way * (h - foot), 6) for h in self.arrangement.arms(carrier)} - {0.0}
            )
            start = bore
            for up in (h for h in heights if h > 0):
                ends = (complex(x, foot + way * start), complex(x, foot + way * (up - WALL)))
                yield Stroke(ends, tag=tag)
                for level in (up - WALL, up + WALL):
                    at = complex(x, foot + way * level)
                    yield Stroke((at - BUSH + 0.5, at + BUSH - 0.5), tag=tag)
                start = up + WALL

    def _wide(self) -> Iterator[Item]:
        """Yield the rims of wheels that mesh in two columns: one wide wheel."""
        found: dict[str, list[tuple[float, Rim]]] = {}
        for station, x in zip(self.arrangement.stations, self.places, strict=True):
            for rim in station.rims if station.part is AxisPart.RIMS else ():
                found.setdefault(rim.label, []).append((x, rim))
        for label, places in found.items():
            for (x0, one), (x1, rim) in pairwise(places):
                inside = -1 if not rim.ring else 1
                for way in {*one.mesh_sides, *rim.mesh_sides}:
                    ends = [
                        complex(x, r.centre + way * (r.reach(way) + inside * SIZES.mesh / 2))
                        for x, r in ((x0, one), (x1, rim))
                    ]
                    yield Stroke(tuple(ends), tag=f"link {label}")

    # Points and letters --------------------------------------------------------------------------

    @cached_property
    def points(self) -> Mapping[ContactPoint, complex]:
        """Points of contact, and axes above and below the main one."""
        found: dict[ContactPoint, complex] = {}
        for mesh in self.arrangement.scheme.motion.train.meshes:
            if mesh.kind not in PARALLEL:
                continue
            for station, x in zip(self.arrangement.stations, self.places, strict=True):
                rims = {rim.label: rim for rim in station.rims if station.part is AxisPart.RIMS}
                if mesh.first in rims and mesh.second in rims:
                    own = rims[mesh.first]
                    other = rims[mesh.second]
                    levels = [
                        [r.centre + w * r.reach(w) for w in r.mesh_sides] for r in (own, other)
                    ]
                    level = min(levels[0], key=lambda a: min(abs(a - b) for b in levels[1]))
                    found[ContactPoint(ContactKind.PITCH, mesh.name)] = complex(x, level)
        for body in self.arrangement.reach:
            axis = ContactPoint(ContactKind.AXIS, body)
            if axis in self.letters:
                found[axis] = complex(self._ends(body)[1], self._height(body))
        return found

    def _dots(self) -> Iterator[Item]:
        for point, at in self.points.items():
            if point.kind is ContactKind.PITCH:
                yield Disc(at, PITCH_POINT, Ink.BLACK)

    def labels(self, height: float) -> Iterator[Label]:
        """Yield the numbers of wheels and carriers, and the letters of points of contact."""
        told: set[str] = set()
        for number, (station, x) in enumerate(
            zip(self.arrangement.stations, self.places, strict=True)
        ):
            if station.transverse is not None:
                yield from self._transverse_labels(station.transverse, x, height)
            if station.part is AxisPart.ARM:
                foot = self._height(station.body)
                near = min(self.arrangement.arms(station.body), key=lambda h: abs(h - foot))
                at = complex(x, (foot + near) / 2)
                yield self._label(station.body, at, 1, height)
            for rim in station.rims if station.part is AxisPart.RIMS else ():
                if rim.label in told:
                    continue
                told.add(rim.label)
                ways = rim.mesh_sides if rim.ring else self._halves(number, rim)
                way = ways[-1]
                at = complex(x, rim.centre + way * 0.6 * rim.radius)
                if rim.ring:
                    at = complex(x, rim.centre + way * (rim.reach(way) + SIZES.mesh / 2))
                yield self._label(rim.label, at, 1j * way if rim.ring else 1, height)
        train = self.arrangement.scheme.motion.train
        for mesh in train.meshes:
            if mesh.kind is MeshKind.RACK:
                column = self._column_with(mesh.first)
                rim = next(
                    r for r in self.arrangement.scheme.columns[column] if r.label == mesh.first
                )
                at = complex(self._column(column), rim.centre - rim.radius - 3.0)
                yield self._label(mesh.second, at + SIZES.teeth / 2, 1, height)
        for worm in self.arrangement.scheme.worms:
            yield self._label(worm.label, self._worm(worm) + worm.radius, 1, height)
        for point, at in self.points.items():
            if point in self.letters and point.kind is ContactKind.PITCH:
                letter, name = typeset(self.letters[point].upper(), height), f"at {point.name}"
                yield Label(letter, at, prefer=1 + 0.2j, gap=1.4, name=name, style=BUSY)

    def _transverse_labels(
        self, transverse: TransverseBody, x: float, height: float
    ) -> Iterator[Label]:
        for label in dict.fromkeys(cone.label for cone in transverse.cones):
            cone = next(c for c in transverse.cones if c.label == label)
            at = complex(x + 0.5 * cone.radius, cone.rim.centre + cone.rim.radius)
            yield self._label(label, at, 1j, height)
        if transverse.carrier:
            low = self._height(transverse.carrier)
            top = min(cone.rim.centre + cone.rim.radius for cone in transverse.cones)
            yield self._label(transverse.carrier, complex(x, (low + top) / 2), 1, height)

    def _label(self, text: str, at: complex, prefer: complex, height: float) -> Label:
        return Label(
            typeset(text, height), at, prefer=prefer, gap=1.2, priority=1, name=f"wheel {text}",
            style=BUSY,
        )  # fmt: skip

    def projections(self, x: float) -> Iterator[Item]:
        """Yield thin lines from the points to a vertical line."""
        seen: set[float] = set()
        for at in self.points.values():
            if round(at.imag, 3) not in seen:
                seen.add(round(at.imag, 3))
                yield Stroke((at, complex(x, at.imag)), Pen.THIN, tag="projection")


def _sign(speed: Fraction) -> int:
    return (speed > 0) - (speed < 0)


def _mirrored(vector: complex, side: int) -> complex:
    """Return a vector, or its mirror image in the level."""
    return vector if side > 0 else vector.conjugate()


HEIGHT, LETTERS, EDGE, BETWEEN = 110.0, 5.0, 6.0, 20.0
"""Target height of the scheme, height of its letters, margin around it, space of parts, mm."""


def draw_scheme(problem: GearProblem) -> Drawing | None:
    """Return the side view of a train, cropped to its content; None where none can be drawn.

    Where its axes are not in one plane, the views of its parts are side by side.
    """
    motion = solve_motion(problem)
    unit, parts = float(motion.train.unit_m), scheme_parts(motion)
    own = float(motion.train.picture.mu_l)
    wholes = [SchemeData(part, unit / own) for part in parts]
    if any(whole.undrawn for whole in wholes):
        return None
    orders = [best_order(whole) for whole in wholes]
    heights = [
        high - low
        for whole, order in zip(wholes, orders, strict=True)
        for _, low, _, high in [ink_bounds(SideView(arrange(whole, order), {}).items())]
    ]
    mu_l = series_near(own * max(heights) / HEIGHT, up=True)
    pictures = []
    for part, order in zip(parts, orders, strict=True):
        side = SideView(arrange(SchemeData(part, unit / mu_l), order), {})
        pictures.append(lettered(side.items(), list(side.labels(LETTERS))))
    row = Row(pictures, BETWEEN, "centre")
    drawing = Drawing(row.width + 2 * EDGE, row.height + 2 * EDGE, problem.title)
    drawing.extend(row.place(complex(EDGE, row.height + EDGE)))
    return drawing
