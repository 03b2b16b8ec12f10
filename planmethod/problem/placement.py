"""Placement of the points of a link in its own axes, from lengths, sides and angles."""

from __future__ import annotations

import cmath
import math

from planmethod.languages import translate
from planmethod.problem.file_node import FileNode
from planmethod.problem.links import Length, LinkText
from planmethod.problem.model import Body, PointForm
from planmethod.problem.names import UNITS, format_length, listed

COLLINEAR = 1e-9
"""Relative tolerance within which two distances place a point on the line."""

AGREE = 1e-6
"""Relative tolerance within which a redundant length must agree with the others."""


def rotation(angle_deg: float) -> complex:
    """Return the unit vector at an angle in degrees, exact on the axes."""
    quarter, rest = divmod(angle_deg % 360.0, 90.0)
    turned = 1j ** int(quarter)
    # multiplying by 1 + 0j would keep the value but could flip the sign of a zero
    return turned if rest == 0 else turned * cmath.rect(1.0, math.radians(rest))


def heading(vector: complex) -> float:
    """Direction of a vector in degrees, exact on the axes (-180, 180]."""
    if vector.imag == 0:
        return 0.0 if vector.real >= 0 else 180.0
    if vector.real == 0:
        return 90.0 if vector.imag > 0 else -90.0
    return math.degrees(cmath.phase(vector))


def place_points(link: LinkText) -> Body | None:
    """Place every point of a link in the link's own axes; None after noting a fault."""
    return _Placement(link).solve() if link.points else None


class _Placement:
    """Worksheet of one link: points placed so far, in working axes."""

    def __init__(self, link: LinkText) -> None:
        self.link = link
        self.placed: dict[str, complex] = {}
        self.failed: set[str] = set(link.faulty)
        self.agrees = True
        self.base: Length | None = None
        # a slider and a one-point link have no letters for their axis: it is the line itself
        self.axis = link.lengths[0] if link.lengths and link.slides is None else None

    def _note(self, node: FileNode, message: str, *facts: object, hint: str = "") -> None:
        """Note that the data of the link do not place its points."""
        node.note(message, *facts, hint=hint)
        self.agrees = False

    def _fail(
        self, point: str, node: FileNode, message: str, *facts: object, hint: str = ""
    ) -> None:
        """Note that the data of a point contradict each other."""
        self._note(node, message, *facts, hint=hint)
        self.failed.add(point)

    @property
    def unit(self) -> str:
        """Unit of the lengths of the file."""
        return self.link.node.faults.unit

    def solve(self) -> Body | None:
        link = self.link
        if self.axis is None:
            self.placed[link.points[0]] = 0j
        else:
            # working axes: a length between points that have no form of their own
            formed = link.forms.keys() | link.faulty
            free = (n for n in link.lengths if n.a not in formed and n.b not in formed)
            self.base = next(free, self.axis)
            self.placed[self.base.a] = 0j
            self.placed[self.base.b] = complex(self.base.value)
        self._reject_double_places()
        self._place_all()
        self._report_unplaced()
        if set(self.placed) != set(link.points):
            return None
        points = self._in_link_axes()
        self._check_lengths(points)
        if not self.agrees:
            return None
        placed = {name: points[name] for name in link.points}
        angles = {angle.key: angle.value for angle in link.angles}
        arc = link.arc[1] if link.arc else None
        return Body(placed, self._axis_letters(), dict(link.forms), angles, arc)

    def _axis_letters(self) -> tuple[str, str] | None:
        if self.axis is not None:
            return self.axis.a, self.axis.b
        if self.link.slides is not None:
            return None
        first = self.link.points[0]
        for name, form in self.link.forms.items():
            if (
                form.kind == "from"
                and form.point == first
                and form.lateral_offset == 0
                and form.at != 0
            ):
                return (first, name) if form.at > 0 else (name, first)
        return None

    def _direction(self) -> complex | None:
        """Own axis in the working axes; None while its letters are not placed."""
        if self.axis is None:
            return 1 + 0j
        start, end = self.placed.get(self.axis.a), self.placed.get(self.axis.b)
        return None if start is None or end is None else _unit(end - start)

    def _reject_double_places(self) -> None:
        for name, form in self.link.forms.items():
            if name in self.placed and form.kind != "side":
                why = (
                    translate("it is an end of {}", self.base.key)
                    if self.base
                    else "it is the origin"
                )
                hint = "Remove the table, or list another length or point first."
                message = "the place of point {} is known already: {}"
                self._note(self.link.node[name], message, name, why, hint=hint)

    def _place_all(self) -> None:
        while True:
            done = self.placed.keys() | self.failed
            pending = [point for point in self.link.points if point not in done]
            if not pending:
                return
            moved = False
            for point in pending:
                place = self._place(point)
                if place is not None:
                    self.placed[point] = place
                moved = moved or place is not None or point in self.failed
            if not moved and not (self.link.slides is not None and self._place_on_axis(pending)):
                return

    def _place_on_axis(self, pending: list[str]) -> bool:
        """Place a point of a slider along its axis by one length, if nothing else does."""
        for point in pending:
            known = self._distances(point)
            if point not in self.link.forms and known:
                other, length = known[0]
                self.placed[point] = self.placed[other] + length.value
                return True
        return False

    def _distances(self, point: str) -> list[tuple[str, Length]]:
        """Placed points whose distance from a point is given."""
        pairs = ((length.opposite_end(point), length) for length in self.link.lengths_of(point))
        return [(other, length) for other, length in pairs if other in self.placed]

    def _place(self, point: str) -> complex | None:
        """Place of a point; None while what it depends on is not placed, or after a fault."""
        form = self.link.forms.get(point)
        if form is None or form.kind == "side":
            place = self._by_angle(point, form)
            return self._by_distances(point, form) if place is None else place
        if form.kind == "from":
            direction, start = self._direction(), self.placed.get(form.point)
            if direction is None or start is None:
                return None
            return start + complex(form.at, form.lateral_offset) * direction
        start, end = (self.placed.get(name) for name in form.line)
        if start is None or end is None:
            return None
        if start == end:
            self._fail(
                point, self.link.node[point], "{} and {} coincide and give no line", *form.line
            )
            return None
        if form.kind == "on":
            return start + complex(form.at, form.lateral_offset) * _unit(end - start)
        distance = form.distance
        if distance is None:
            given = [n for n in self.link.lengths_of(point) if n.opposite_end(point) == form.point]
            if not given:
                hint = "Give distance = ..., or the length {}{} of the link."
                hint = translate(hint, form.point, point)
                self._fail(point, self.link.node[point]["distance"], "missing", hint=hint)
                return None
            distance = given[0].value
        return start + distance * _unit(end - start) * rotation(form.angle)

    def _by_angle(self, point: str, form: PointForm | None) -> complex | None:
        """Place a point by its distance from a point and the angle of the line to it."""
        for angle in self.link.angles:
            for line, other, degrees in (
                (angle.two, angle.one, angle.value),
                (angle.one, angle.two, -angle.value),
            ):
                vertex = line[0] if line[1] == point else line[1]
                start, end = (self.placed.get(name) for name in other)
                known = [length for at, length in self._distances(point) if at == vertex]
                if point not in line or not known or start is None or end is None or start == end:
                    continue
                if form is not None:  # a side determines the sense of the angle
                    degrees = abs(degrees) if form.left else -abs(degrees)
                sense = 1.0 if line[1] == point else -1.0
                turned = _unit(end - start) * rotation(degrees)
                return self.placed[vertex] + sense * known[0].value * turned
        return None

    def _by_distances(self, point: str, form: PointForm | None) -> complex | None:
        known = self._distances(point)
        if len(known) < 2:
            return None
        (one, r1), (two, r2) = known[:2]
        p, q = self.placed[one], self.placed[two]
        d = abs(q - p)
        a, b = r1.value, r2.value
        size = max(a, b, d)
        slack = COLLINEAR * size
        said = [format_length(length, self.unit, 6) for length in (a, b, d)]
        given = f"{r1.key} = {said[0]}, {r2.key} = {said[1]}, |{one}{two}| = {said[2]}"
        if d <= slack or d > a + b + slack or d < abs(a - b) - slack:
            message = "the triangle {}{}{} cannot be closed: {}"
            self._fail(
                point, self.link.node[r2.key], message, one, two, point, given,
                hint="Check these lengths.",
            )  # fmt: skip
            return None
        along = _unit(q - p)
        if abs(a + b - d) <= slack:
            return p + a * along
        if abs(abs(a - b) - d) <= slack:
            return p + (a if a > b else -a) * along
        if form is None:
            hint = 'Give the side: {}.side = "left of {}{}" (or right).'
            hint = translate(hint, point, one, two)
            self._fail(point, self.link.node[point], "two places satisfy {}", given, hint=hint)
            return None
        start, end = (self.placed.get(name) for name in form.line)
        if start is None or end is None:
            return None
        x = (d + (a - b) * ((a + b) / d)) / 2
        small, big = min(a, b), max(a, b)
        gap = d - big
        room = (small - gap) * (small + gap) * ((d + (big - small)) / d) * ((d + (big + small)) / d)
        y = math.sqrt(max(0.0, room)) / 2
        fits = [
            place
            for place in (p + complex(x, y) * along, p + complex(x, -y) * along)
            if (_signed_area(place, start, end) > 0) == form.left
        ]
        if len(fits) != 1:
            text = "both possible places of {} are {}"
            if not fits:
                text = "neither of the two places of {} is {}"
            side = translate("left of {}" if form.left else "right of {}", "".join(form.line))
            hint = translate("Name the side of the line {}{}.", one, two)
            node = self.link.node[point]["side"]
            self._fail(point, node, text, point, side, hint=hint)
            return None
        return fits[0]

    def _report_unplaced(self) -> None:
        link = self.link
        if not link.sound or self.failed:
            return  # the cause is reported already
        for point in link.points:
            if point in self.placed:
                continue
            known = self._distances(point)
            bases = [name for name in self.placed if name != point]
            line = "".join(bases[:2]) if len(bases) > 1 else ""
            example = f'{point} = {{ on = "{line}", at = ... }}' if line else ""
            form = link.forms.get(point)
            if form is not None and form.kind != "side":
                message = "point {} is measured from points that are not placed"
                hint = "Points must not be measured from one another in a circle."
                self._note(link.node[point], message, point, hint=hint)
            elif known:
                self._report_one_length(point, bases, *known[0])
            else:
                first = bases[0] if bases else link.points[0]
                tail = translate(" or {}", example) if example else ""
                hint = translate("Add its lengths ({}{} = ...){}.", first, point, tail)
                message = "point {} is not placed: no length leads to it from {}"
                self._note(link.node["points"], message, point, listed(bases), hint=hint)

    def _report_one_length(self, point: str, bases: list[str], start: str, length: Length) -> None:
        """Note a point with one length, which usually is on the line of two others."""
        more = next((base for base in bases if base != start), None)
        hint = translate("Add a second distance.")
        if more is not None:
            node = self.link.node[length.key]
            stated = node.faults.stated.get(node.path)
            at = length.value * UNITS[self.unit]
            hint = translate(
                'If it is on {0}{1}, write {2} = {{ on = "{0}{1}", at = {3} }}; otherwise '
                'add {1}{2} and {2}.side = "left of {0}{1}", or angle.{1}{0}{2}.',
                start,
                more,
                point,
                f"{at:.10g}" if stated is None else f'"{stated}"',
            )
        message = "point {} is not placed: only {} is given"
        self._note(self.link.node["points"], message, point, length.key, hint=hint)

    def _in_link_axes(self) -> dict[str, complex]:
        if self.axis is None or self.axis is self.base:
            return self.placed
        origin, direction = self.placed[self.axis.a], self._direction()
        assert direction is not None
        size = max(abs(z - origin) for z in self.placed.values())
        turned: dict[str, complex] = {}
        for name, place in self.placed.items():
            z = (place - origin) * direction.conjugate()
            # turning leaves a trace of rounding on points of the axis
            turned[name] = complex(z.real) if abs(z.imag) <= 1e-14 * size else z
        turned[self.axis.a] = 0j
        turned[self.axis.b] = complex(self.axis.value)
        return turned

    def _check_lengths(self, points: dict[str, complex]) -> None:
        for angle in self.link.angles:
            one, two = (points[line[1]] - points[line[0]] for line in (angle.one, angle.two))
            got = heading(two / one) if one and two else math.nan
            sided = any(form.kind == "side" for form in self.link.forms.values())
            missed = abs(got) - abs(angle.value) if sided else got - angle.value
            if not abs((missed + 180.0) % 360.0 - 180.0) <= AGREE * 180.0:
                message = "{} = {:g} degrees, but the other data of the link make it {:g}"
                hint = "Angles count counter-clockwise from the first line: correct one of them."
                node = self.link.node["angle"][angle.key]
                self._note(node, message, angle.key, angle.value, got, hint=hint)
        for length in self.link.lengths:
            got = abs(points[length.a] - points[length.b])
            if abs(got - length.value) > AGREE * max(got, length.value):
                message = "{} = {}, but the other data of the link put {} and {} {} apart"
                own, other = (format_length(one, self.unit, 6) for one in (length.value, got))
                self._note(
                    self.link.node[length.key], message,
                    length.key, own, length.a, length.b, other,
                    hint="Remove or correct one of them.",
                )  # fmt: skip


def _unit(vector: complex) -> complex:
    return complex(math.copysign(1.0, vector.real)) if vector.imag == 0 else vector / abs(vector)


def _signed_area(place: complex, start: complex, end: complex) -> float:
    """Signed area: positive when a place is to the left of a directed line."""
    return ((place - start) * (end - start).conjugate()).imag
