"""The velocity diagrams as one construction, and the values read from it (построение картин).

The axis of contact points, ``yy``, is vertical, velocities are laid off to the right of it. The
velocity of a body is a straight line over it; a body's line is drawn as soon as two of its points
are known, and gives all its other points. Rays parallel to the lines, from the pole to a level line
at the pole distance, cut off segments proportional to the speeds of the bodies.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import combinations

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.drafting import Profile, RulerArithmetic, sigmas
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.program import Builder, Program
from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.errors import PlanMethodError
from planmethod.gears.model import parse
from planmethod.gears.motion import (
    ContactKind,
    ContactPoint,
    TrainMotion,
    VelocityDiagrams,
    carrier_of,
)
from planmethod.languages import translate
from planmethod.note.compared import ComparedNumber
from planmethod.solved.legibility import SHORT, WIDEST, DetailView, min_enlarged, ratio_for

LETTERS = "abcdefghklmnqrstuvwxz"
"""Letters of contact points, in the order of the meshes; ``p`` is the pole."""

SELF_CHECK_TOLERANCE = 1e-6
"""Difference of the construction from the mesh equations that is a fault, not rounding."""

AXIS_FOOT, POLE = PointName("o'"), PointName("p")
"""Foot of the main axis on ``yy``, and the pole of the rays: both may be placed anywhere."""

RAY_ORIGIN = PointName("o")
"""Point below the pole on the level line, from which the segments of the rays are read."""


class VelocityDiagramError(PlanMethodError):
    """The diagrams contradict the mesh equations: an internal error (самопроверка)."""


class DrawnPoint(Struct, frozen=True):
    """A point of the linear velocity diagram (точка картины).

    Attributes
    ----------
    contact : ContactPoint
    letter : str
        Rich text.
    base, end : PointName
        Its place on ``yy``, and the end of its velocity.
    bodies : tuple of str
        Bodies that have this velocity there.
    height, speed : Fraction, mm
    plotted, read : NumberName or None
        Its segment as laid off, or as read; both None where it is zero.
    """

    contact: ContactPoint
    letter: str
    base: PointName
    end: PointName
    bodies: tuple[str, ...]
    height: Fraction
    speed: Fraction
    plotted: NumberName | None = None
    read: NumberName | None = None


class MeasuredQuantity(Struct, frozen=True):
    """A quantity measured on the diagrams (снятая величина).

    Attributes
    ----------
    name : str
        Requested name: ``n_5``, ``U_1_5^H``.
    exact : Fraction or float
        A float where it is not a fraction: 1/s from rev/min.
    read : NumberName
    rays : tuple of str
        Bodies whose rays it is computed from.
    """

    name: str
    exact: Fraction | float
    read: NumberName
    rays: tuple[str, ...]


class GearDrawing(Struct, frozen=True):
    """Both diagrams as steps (построение).

    Attributes
    ----------
    data : mapping
        Lengths in mm, angles in degrees, scales; exact.
    starts : tuple of str
        Bodies whose speed is laid off; ``calculated`` are those of them that are not inputs while
        all inputs together would not determine the diagram.
    lines, rays : mapping
        By body: its line, the end of its ray.
    segments : mapping
        By body: its segment on the line of the rays, as read.
    mu : NumberName
        Scale of the rays: given, or computed from the ray of an input.
    """

    motion: TrainMotion
    diagrams: VelocityDiagrams
    program: Program
    data: Mapping[str, Fraction]
    starts: tuple[str, ...]
    calculated: tuple[str, ...]
    spots: tuple[DrawnPoint, ...]
    lines: Mapping[str, LineName]
    rays: Mapping[str, PointName]
    segments: Mapping[str, NumberName]
    mu: NumberName
    quantities: tuple[MeasuredQuantity, ...]

    def label(self, body: str) -> str:
        """Return the name of a body's line: all the numbers of the body."""
        train = self.motion.train
        return ", ".join(label for label in train.numbers if train.body_of[label] == body)

    def read_on(self, detail_views: Iterable[DetailView]) -> dict[str, DetailView]:
        """Return the bodies whose segments are read on enlarged views, and on which."""
        ends = {end: detail_view for detail_view in detail_views for _, end in detail_view.ends}
        return {body: ends[end] for body, end in self.rays.items() if end in ends}

    def spots_on(self, detail_views: Iterable[DetailView]) -> dict[PointName, DetailView]:
        """Return the ends of linear velocities that are read on enlarged views, and on which."""
        ends = {pair: detail_view for detail_view in detail_views for pair in detail_view.ends}
        pairs = {spot.end: (spot.base, spot.end) for spot in self.spots}
        return {end: ends[pair] for end, pair in pairs.items() if pair in ends}

    def numbers(self) -> dict[str, Number]:
        """Return the data as floats."""
        return {name: float(value) for name, value in self.data.items()} | {AXIS_FOOT: 0j, POLE: 0j}


class GearReading(Struct, frozen=True):
    """The construction drawn and read (чтение построения).

    Attributes
    ----------
    exact : Trace
        In float64.
    read : Trace
        With the ruler.
    sigma : mapping
        Drafting errors of the numbers, one standard deviation.
    detail_views : tuple of DetailView
        Short segments, which are drawn once more, larger, and read there: those of the rays first,
        then linear velocities.
    """

    exact: Trace
    read: Trace
    sigma: Mapping[str, float]
    detail_views: tuple[DetailView, ...] = ()

    def point(self, name: PointName) -> complex:
        """Return a point, mm."""
        return complex(self.exact.value[name])

    def compared(self, name: NumberName) -> ComparedNumber:
        """Return a number of the construction, compared."""
        exact, read = (float(one.value[name]) for one in (self.exact, self.read))
        return ComparedNumber(exact, read, self.sigma[name])


def read(drawn: GearDrawing, profile: Profile) -> GearReading:
    """Draw the construction, and read it with the ruler of a draughtsman.

    Raises
    ------
    PictureError
        The construction does not give the fractions of the mesh equations.
    """
    program, data = drawn.program, drawn.numbers()
    exact = evaluate(program, data, Float64())
    knots = _find_detail_views(drawn, exact, min_enlarged(profile.ruler))
    knots += _linear_detail_views(drawn, exact, min_enlarged(profile.ruler), len(knots))
    enlarged: dict[str, Number] = {
        str(drawn.segments[body]): detail_view.times
        for body, detail_view in drawn.read_on(knots).items()
    }
    on_views = drawn.spots_on(knots)
    enlarged |= {str(one.read): on_views[one.end].times for one in drawn.spots
                 if one.end in on_views}  # fmt: skip
    found = sigmas(program, data, profile, frozenset((str(AXIS_FOOT), str(POLE))), enlarged)
    sigma = {name: float(one[0]) for name, one in found.items()}
    for one in drawn.quantities:
        got, due = float(exact.value[one.read]), float(one.exact)
        if not abs(got - due) <= SELF_CHECK_TOLERANCE * max(1.0, abs(due)):
            text = translate(
                "the velocity diagrams give {} = {:.12g}, the mesh equations {:.12g}",
                one.name,
                got,
                due,
            )
            raise VelocityDiagramError("{}. Please report the problem file.", text)
    hand = RulerArithmetic(profile.ruler, enlarged)
    return GearReading(exact, evaluate(program, data, hand), sigma, knots)


def _find_detail_views(
    drawn: GearDrawing, exact: Trace, min_length: float
) -> tuple[DetailView, ...]:
    """Return the segments of rays from ``min_length`` to `SHORT`, mm, by their views."""
    foot = complex(exact.value[RAY_ORIGIN])
    ends = {end: complex(exact.value[end]) - foot for end in drawn.rays.values()}
    short = [end for end, way in ends.items() if min_length <= abs(way) < SHORT]
    found: list[DetailView] = []
    for end in sorted(short, key=lambda one: abs(ends[one])):
        times = ratio_for(abs(ends[end]))
        for k, detail_view in enumerate(found):
            own = (*(pair[1] for pair in detail_view.ends), end)
            across = [0.0, *(ends[one].real for one in own)]
            if (max(across) - min(across)) * detail_view.times <= WIDEST:
                middle = foot + (max(across) + min(across)) / 2
                found[k] = replace(
                    detail_view, centre=middle, ends=(*detail_view.ends, (RAY_ORIGIN, end))
                )
                break
        else:
            middle = foot + ends[end] / 2
            number, initials = len(found), _initials(drawn)
            found.append(DetailView(number, middle, times, ((RAY_ORIGIN, end),), initials))
    return tuple(found)


def _initials(drawn: GearDrawing) -> frozenset[str]:
    """Return the letters that name no view: those of points and lines."""
    letters = (spot.letter[0].upper() for spot in drawn.spots)
    return frozenset({"O", "P", *letters, *(label[0] for label in drawn.lines)})


def _linear_detail_views(
    drawn: GearDrawing, exact: Trace, min_length: float, first: int
) -> tuple[DetailView, ...]:
    """Return the linear velocities from ``min_length`` to `SHORT`, mm, by their views."""
    found: list[DetailView] = []
    for spot in drawn.spots:
        start, end = (complex(exact.value[name]) for name in (spot.base, spot.end))
        if spot.read is not None and min_length <= abs(end - start) < SHORT:
            times, pair = ratio_for(abs(end - start)), (spot.base, spot.end)
            number, middle = first + len(found), (start + end) / 2
            found.append(DetailView(number, middle, times, (pair,), _initials(drawn)))
    return tuple(found)


def construct(motion: TrainMotion, diagrams: VelocityDiagrams) -> GearDrawing:
    """Return the construction of the velocity diagrams of a train."""
    return _Drawing(motion, diagrams).construction()


class _Drawing:
    """A construction while it is made."""

    def __init__(self, motion: TrainMotion, diagrams: VelocityDiagrams) -> None:
        self.motion, self.diagrams = motion, diagrams
        self.builder = Builder()
        self.data: dict[str, Fraction] = {}
        self.feet: dict[Fraction, PointName] = {}
        self.lines: dict[str, LineName] = {}
        train, scale = motion.train, motion.train.unit_m / diagrams.mu_l
        used = {body for mesh in train.meshes for body in train.ends(mesh)} | set(train.carriers)
        self.heights = {b: self.motion.axes.heights[b] * scale for b in train.bodies if b in used}
        self.over = {body: carrier_of(self.motion, body) for body in self.heights}
        self.points = {
            one.at: (one.height_mm, self._bodies_of_point(one.at)) for one in diagrams.contacts
        }
        self.speeds = {one.at: one.speed_mm for one in diagrams.contacts}
        self.plotted: dict[ContactPoint, NumberName] = {}
        self.ends: dict[ContactPoint, PointName] = {}

    def _bodies_of_point(self, point: ContactPoint) -> tuple[str, ...]:
        """Return the bodies that have one velocity at a point."""
        if point.kind is ContactKind.PITCH:
            train = self.motion.train
            return train.ends(next(mesh for mesh in train.meshes if mesh.name == point.of))
        over = self.over[point.of]
        return (point.of,) if over is None else (point.of, over)

    def construction(self) -> GearDrawing:
        builder, train = self.builder, self.motion.train
        origin = builder.take_point(AXIS_FOOT)
        self.base = builder.at_angle(origin, None, self._known("level", Fraction(0)))
        self.axis = builder.perpendicular(origin, self.base)
        self.feet[Fraction(0)] = origin
        for name, (height, _) in self.points.items():
            if height not in self.feet:
                letter = f"{self._letter(name)}'"
                length = self._known(f"height {letter}", height)
                self.feet[height] = builder.lay_off_length(letter, origin, self.axis, length)
        starts = self._starts()
        self._place_fixed_bodies(train.fixed)
        for start in starts:
            self._spread()
            if start not in self.lines:
                self._plot_speed(start)
        self._spread()
        spots = tuple(self._spot(name) for name in self.points)
        rays, segments = self._rays()
        inputs = [body for body in train.inputs if body in self.lines]
        calculated = () if len(starts) == self._mobility() == 1 else set(starts) - set(inputs)
        mu = self._scale(starts, inputs, segments)
        found = tuple(self._measured_quantities(mu, segments))
        return GearDrawing(
            self.motion, self.diagrams, builder.program(), self.data, starts,
            tuple(body for body in starts if body in calculated), spots, self.lines, rays,
            segments, mu, found,
        )  # fmt: skip

    def _known(self, name: str, value: Fraction) -> NumberName:
        self.data[name] = value
        return self.builder.known(name)

    def _mobility(self) -> int:
        return self.motion.structure.mobility

    def _letter(self, point: ContactPoint) -> str:
        if point.kind is ContactKind.AXIS:
            return f"o_{{{point.of}}}"
        number = [mesh.name for mesh in self.motion.train.meshes].index(point.of)
        turn, place = divmod(number, len(LETTERS))
        return LETTERS[place] + (f"_{{{turn}}}" if turn else "")

    # Lines ---------------------------------------------------------------------------------------

    def _known_at(
        self, body: str, ends: Collection[ContactPoint]
    ) -> dict[Fraction, ContactPoint | None]:
        """Return the heights at which the velocity of a body is known, each with its contact.

        None represents its own axis, where that is fixed.
        """
        known: dict[Fraction, ContactPoint | None] = {}
        if self.over[body] is None:
            known[self.heights[body]] = None
        for name, (height, bodies) in self.points.items():
            if body in bodies and name in ends:
                known.setdefault(height, name)
        return known

    def _is_at_rest(self, point: ContactPoint, lines: Collection[str]) -> bool:
        """Return whether a point belongs to a fixed body, or to a fixed axis."""
        _, bodies = self.points[point]
        fixed = self.motion.train.fixed
        return any(body in fixed and body in lines for body in bodies) or (
            point.kind is ContactKind.AXIS and len(bodies) == 1
        )

    def _closes(self, starts: Sequence[str]) -> int:
        """Return the number of bodies that have lines when some speeds are laid off."""
        lines = {*self.motion.train.fixed, *starts}
        ends: set[ContactPoint] = set()
        count = -1
        while count != len(lines):
            count = len(lines)
            for name, (_, bodies) in self.points.items():
                if any(body in lines for body in bodies) or self._is_at_rest(name, lines):
                    ends.add(name)
            lines |= {b for b in self.heights if len(self._known_at(b, ends)) > 1}
        return sum(body in lines for body in self.heights)

    def _starts(self) -> tuple[str, ...]:
        """Choose bodies whose lines are laid off: the inputs where the picture closes with them."""
        train, count = self.motion.train, self._mobility()
        fixed = train.fixed
        inputs = [b for b in train.inputs if b in self.heights and b not in fixed]
        able = [b for b in self.heights if self.over[b] is None and b not in fixed and self._arm(b)]
        ordered = [*(b for b in inputs if b in able), *(b for b in able if b not in inputs)]
        whole = len(self.heights)
        for tried in combinations(ordered, count) if count < 3 else ():
            if self._closes(tried) == whole:
                return tried
        chosen = tuple(b for b in inputs if b in able)[:count]
        while self._closes(chosen) < whole and len(chosen) < len(ordered):
            more = [b for b in ordered if b not in chosen]
            chosen = (*chosen, max(more, key=lambda b: self._closes((*chosen, b))))
        return chosen

    def _arm(self, body: str) -> ContactPoint | None:
        """Return the contact of a body that is farthest from its axis."""
        own = [
            (abs(height - self.heights[body]), name)
            for name, (height, bodies) in self.points.items()
            if body in bodies and height != self.heights[body]
        ]
        return max(own, key=lambda one: one[0])[1] if own else None

    def _place_fixed_bodies(self, fixed: frozenset[str]) -> None:
        for body in self.heights:
            if body in fixed:
                self.lines[body] = self.axis
        for name, (height, _) in self.points.items():
            if self._is_at_rest(name, self.lines):
                self.ends[name] = self.feet[height]

    def _plot_speed(self, body: str) -> None:
        name = self._arm(body)
        assert name is not None
        height, letter = self.points[name][0], self._letter(name)
        if name not in self.ends:
            length = self.plotted[name] = self._known(f"laid {letter}", self.speeds[name])
            level = self.builder.parallel(self.feet[height], self.base)
            self.ends[name] = self.builder.lay_off_length(letter, self.feet[height], level, length)

    def _spread(self) -> None:
        """Draw the line of every body that has two points, and take its other points off it."""
        count = -1
        while count != len(self.lines):
            count = len(self.lines)
            for body in self.heights:
                known = self._known_at(body, self.ends)
                if body in self.lines or len(known) < 2:
                    continue
                low, high = min(known), max(known)
                ends = [self._end(known[height], height) for height in (low, high)]
                self.lines[body] = self.builder.join(ends[0], ends[1])
                for name, (height, bodies) in self.points.items():
                    if body in bodies and name not in self.ends:
                        level = self.builder.parallel(self.feet[height], self.base)
                        letter = self._letter(name)
                        self.ends[name] = self.builder.intersect_lines(
                            letter, level, self.lines[body]
                        )

    def _end(self, name: ContactPoint | None, height: Fraction) -> PointName:
        if name is not None:
            return self.ends[name]
        if height not in self.feet:  # a fixed axis without a contact of its own
            letter = f"o_{{{len(self.feet)}}}'"
            length = self._known(f"height {letter}", height)
            self.feet[height] = self.builder.lay_off_length(letter, AXIS_FOOT, self.axis, length)
        return self.feet[height]

    def _spot(self, name: ContactPoint) -> DrawnPoint:
        """Read a segment of the linear velocity diagram."""
        (height, bodies), end = self.points[name], self.ends[name]
        foot, letter, read = self.feet[height], self._letter(name), None
        laid = self.plotted.get(name)
        if end != foot and laid is None:
            read = self.builder.measure_along(f"read {letter}", foot, end, self.base)
        return DrawnPoint(name, letter, foot, end, bodies, height, self.speeds[name], laid, read)

    # Rays ----------------------------------------------------------------------------------------

    def _rays(self) -> tuple[dict[str, PointName], dict[str, NumberName]]:
        builder = self.builder
        pole = builder.take_point(POLE)
        down = builder.parallel(pole, self.axis)
        far = self._known("pole distance", -self.diagrams.pole_mm)
        foot = builder.lay_off_length(str(RAY_ORIGIN), pole, down, far)
        level = builder.parallel(foot, self.base)
        rays: dict[str, PointName] = {}
        segments: dict[str, NumberName] = {}
        for body, line in self.lines.items():
            if body in self.motion.train.fixed:
                continue
            ray = builder.parallel(pole, line)
            rays[body] = builder.intersect_lines(f"ray {body}", ray, level)
            segments[body] = builder.measure_along(f"segment {body}", foot, rays[body], self.base)
        return rays, segments

    def _scale(
        self, starts: Sequence[str], inputs: Sequence[str], segments: Mapping[str, NumberName]
    ) -> NumberName:
        """Return the scale of the rays: chosen, or by the input where another body is laid off."""
        quick = [body for body in inputs if self.motion.speeds[body]]
        if len(starts) == self._mobility() == 1 and quick and starts[0] not in inputs:
            speed = self._known("input", self.motion.speeds[quick[0]])
            return self.builder.compute("mu", (speed, 1), (segments[quick[0]], -1))
        return self._known("mu", self.diagrams.turn_per_mm)

    def _measured_quantities(
        self, mu: NumberName, segments: Mapping[str, NumberName]
    ) -> list[MeasuredQuantity]:
        train, speeds = self.motion.train, self.motion.speeds
        unit, found = train.unit, {}
        for label in train.numbers:
            body = train.body_of[label]
            if body in segments:
                number = self.builder.compute(f"{unit}_{label}", (mu, 1), (segments[body], 1))
                found[str(number)] = MeasuredQuantity(
                    f"{unit}_{label}", speeds[body], number, (body,)
                )
        for name in dict.fromkeys(train.ask):
            asked = parse(name, tuple(train.body_of))
            if asked.kind not in ("U", "n", "omega") or name in found:
                continue
            carrier = None if asked.carrier is None else train.body_of[asked.carrier]
            parts = [
                self._relative_segment(train.body_of[x], carrier, segments) for x in asked.labels
            ]
            exact = [self.motion.speed(label, asked.carrier) for label in asked.labels]
            if None in parts or (asked.kind == "U" and not exact[1]):
                continue
            rays = (*(train.body_of[x] for x in asked.labels), *([carrier] if carrier else []))
            powers = [(part, 1) for part in parts if part is not None]
            value: Fraction | float
            factor = 1.0
            if asked.kind == "U":
                powers[1] = (powers[1][0], -1)
                value = exact[0] / exact[1]
            else:
                powers.append((mu, 1))
                other = asked.kind != unit
                factor = train.factor if other else 1.0
                value = float(exact[0]) * factor if other else exact[0]
            number = self.builder.compute(name, *powers, factor=factor)
            found[name] = MeasuredQuantity(name, value, number, rays)
        return list(found.values())

    def _relative_segment(
        self, body: str, carrier: str | None, segments: Mapping[str, NumberName]
    ) -> NumberName | None:
        """Return the segment of a body minus that of a carrier; None if both are fixed."""
        if carrier is None or carrier not in segments:
            return segments.get(body)
        back = NumberName(f"less {carrier}")
        if back not in [step.out for step in self.builder.steps]:
            self.builder.compute(str(back), (segments[carrier], 1), factor=-1.0)
        if body not in segments:
            return back
        total = NumberName(f"segment {body} to {carrier}")
        if total not in [step.out for step in self.builder.steps]:
            self.builder.total(str(total), segments[body], back)
        return total
