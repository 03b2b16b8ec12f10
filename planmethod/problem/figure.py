"""A drawn position, built point by point from the data of a figure (построение по рисунку).

The figure of a task shows angles and distances in place of fixed points. From the points that are
known, the others follow by the draughtsman's constructions: a length laid off in a known
direction, and the intersection of two lines or arcs. A point that is joined to others by links of
known direction is sought together with them: the lines and arcs of all are carried to one of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, product
from typing import Any, TypeAlias

import numpy as np

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import PARALLEL, evaluate
from planmethod.construct.program import Builder
from planmethod.construct.steps import Join, LineName, LineSense, Name, NumberName, PointName, Side
from planmethod.mechanism.model import FRAME
from planmethod.problem.figure_scene import Locus, Scene, find_loci, line_angles
from planmethod.problem.model import DrawnDirection, DrawnKind, Slide
from planmethod.problem.placement import heading, rotation

BRANCH_LIMIT = 4096
"""Most mirror images that are tried."""

FORWARD = (1.0, -1.0)

Values: TypeAlias = Mapping[Name, Any]
"""Values of the steps in all mirror images, shape (n,), as a trace has them."""


Hop: TypeAlias = tuple[str, str, str]
"""A link of known direction, and two of its points: from the first to the second."""


class Figure:
    """Steps by which a drawn position is built.

    Attributes
    ----------
    numbers, places : dict
        Data of the steps, m and degrees.
    choices : dict of NumberName to tuple of float
        Numbers of which the figure leaves several: a side, a sense of an angle.
    placed : dict of str to None
        Points that are built.
    turned : dict of str to DrawnDirection
        Links whose direction is known, with the source of it.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.b = Builder()
        self.numbers: dict[str, float] = {}
        self.places: dict[str, complex] = {}
        self.choices: dict[NumberName, tuple[float, ...]] = {}
        self.placed: dict[str, None] = {}
        self.turned: dict[str, DrawnDirection] = {}
        self.line_turns: dict[str, str | tuple[str, str]] = {}  # a slider, or two points
        self.bases: dict[str, PointName] = {}
        self.directions: dict[LineName, DrawnDirection] = {}
        self._auxiliary = 0
        for name, (x, y) in scene.points.items():
            if x is not None and y is not None:
                self.places[name] = complex(x, y)
                self.b.take_point(name)
                self.placed[name] = None

    # The search ------------------------------------------------------------------------------

    def build(self) -> list[str]:
        """Build as much as possible; return what of the unknown is not found.

        The steps continue with the other points: they distinguish mirror images.
        """
        while True:
            if (
                self._turn_links()
                or self._resolve_lines()
                or self._place()
                or self._turn_by_angle()
            ):
                continue
            if len(self.images) * 2 > BRANCH_LIMIT or not self._meet():
                break
        return [name for name in self.scene.unknown if not self.has(name)]

    def has(self, unknown: str) -> bool:
        """Return whether a fixed point, a guide or the driving link is found."""
        scene = self.scene
        if unknown in scene.points:
            return unknown in self.placed
        if unknown in scene.lines:
            line = scene.lines[unknown]
            return self._line_turned(unknown) and (
                line.through is not None or self.guide_base(unknown) is not None
            )
        return unknown in self.turned

    @property
    def images(self) -> list[tuple[float, ...]]:
        """Values of the choices in every mirror image."""
        return list(product(*self.choices.values()))

    def values(self) -> Values:
        """Return the values of all steps in every mirror image."""
        images = self.images
        rows = np.array(images, dtype=float).reshape(len(images), len(self.choices))
        data: dict[str, Any] = {**self.numbers, **self.places}
        data.update(zip(self.choices, rows.T, strict=True))
        return evaluate(self.b.program(), data, Float64()).value

    # Directions ------------------------------------------------------------------------------

    def _turn(self, link: str, by: str, *of: str, angle: NumberName | None = None) -> bool:
        self.turned[link] = DrawnDirection(link, by, of, angle)
        return True

    def _turn_links(self) -> bool:
        """Find the direction of a link that needs no choice."""
        scene = self.scene
        for fact in scene.facts:
            if fact.kind is DrawnKind.PHI and fact.of[0] not in self.turned:
                (link,), angle = fact.of, self.number(fact.key, fact.value)
                self.turned[link] = DrawnDirection(
                    link, "phi", (), angle, self.scene.headings(fact), fact.names
                )
                return True
        for slider, slide in scene.slides.items():
            if slide.host == FRAME:
                line = scene.line_of[slider]
                if slider not in self.turned and self._line_turned(line):
                    return self._turn(slider, "guide", line)
            elif slider not in self.turned and slide.host in self.turned:
                return self._turn(slider, "host", slide.host)
            elif slide.host not in self.turned and slider in self.turned:
                return self._turn(slide.host, "slider", slider)
        for link, body in scene.links.items():
            if link == FRAME or link in self.turned:
                continue
            here = [point for point in body.points if point in self.placed]
            pairs = [
                pair for pair in combinations(here, 2) if len({*map(body.points.get, pair)}) > 1
            ]
            if pairs:
                own = [pair for pair in pairs if body.axis is not None and {*pair} == {*body.axis}]
                p, q = (
                    body.axis
                    if own and body.axis
                    else max(
                        pairs, key=lambda pair: abs(body.points[pair[1]] - body.points[pair[0]])
                    )
                )
                return self._turn(link, "points", p, q)
        return self._turn_slots()

    def _turn_slots(self) -> bool:
        """Find the direction of a slotted link from its point on the slot and the pin in it."""
        for slider, slide in self.scene.slides.items():
            host = self.scene.links[slide.host].points
            if slide.host == FRAME or slide.host in self.turned or slide.pin not in self.placed:
                continue
            along = rotation(slide.angle)
            for point, place in host.items():
                reach = (slide.base - place) / along
                if point not in self.placed or abs(reach.imag + slide.offset) > 1e-9 * _size(host):
                    continue
                sense = self.number(f"sense_{slide.host}", 0.0)
                sole = len(self.scene.links[slider].points) == 1 and len(host) > 1
                if not (sole and reach.real >= 0):
                    sense = self.choice(f"sense_{slider}", (0.0, 180.0))
                return self._turn(slide.host, "slot", slider, point, angle=sense)
        return False

    def _turn_by_angle(self) -> bool:
        """Find the direction of a link by its unsigned angle to one of known direction."""
        for fact in self.scene.facts:
            if fact.kind is not DrawnKind.BETWEEN:
                continue
            for sense in (1, -1):
                one, two = fact.of[::sense]
                if one in self.turned and two not in self.turned:
                    names, headings = fact.names[::sense], self.scene.headings(fact)[::-sense]
                    angle = self.choice("_".join(("phi", *names)), line_angles(fact.value))
                    self.turned[two] = DrawnDirection(
                        two, "between", (one,), angle, headings, names
                    )
                    return True
        return False

    def axis(self, link: str, through: PointName) -> LineName:
        """Draw the direction of a link's own axis through a point."""
        return self._side(link, through, 0.0)

    def _side(self, link: str, through: PointName, course: float) -> LineName:
        """Draw a line of a link through a point, at an angle to its own axis, degrees."""
        line, turn = self._known_line(link, through), self.turned[link]
        if rest := (course - turn.headings[0]) % 360.0:
            return self.b.at_angle(through, line, self.number(f"angle_{link}", rest))
        return line

    def _known_line(self, link: str, through: PointName) -> LineName:
        """Draw the line of a link whose direction is known through a point."""
        turn, b = self.turned[link], self.b
        line: LineName
        match turn.by:
            case "phi":
                assert turn.angle is not None
                line = b.at_angle(through, None, turn.angle)
            case "between":
                assert turn.angle is not None
                other = self._side(turn.of[0], through, turn.headings[1])
                line = b.at_angle(through, other, turn.angle)
            case "guide":
                line = self.guide_direction(turn.of[0], through)
            case "host":
                line = self._at(link, through, self.axis(turn.of[0], through), 1.0, link)
            case "slider":
                line = self._at(link, through, self.axis(turn.of[0], through), -1.0, turn.of[0])
            case "points":
                p, q = turn.of
                body = self.scene.links[link].points
                line = self._draw_turned(link, through, p, q, -heading(body[q] - body[p]))
            case _:
                slider, point = turn.of
                slide = self.scene.slides[slider]
                assert turn.angle is not None
                line = b.join(PointName(point), PointName(slide.pin))
                line = b.at_angle(through, line, turn.angle)
                if slide.angle:
                    line = b.at_angle(through, line, self.number(f"angle_{slider}", -slide.angle))
        self.directions.setdefault(line, turn)
        return line

    def _at(
        self, link: str, through: PointName, line: LineName, sign: float, slider: str
    ) -> LineName:
        """Draw a line at the angle of a slide to another one."""
        angle = sign * self.scene.slides[slider].angle
        if not angle:
            return self.b.parallel(through, line) if self._starts(line) != through else line
        return self.b.at_angle(through, line, self.number(f"angle_{link}", angle))

    def _draw_turned(self, link: str, through: PointName, p: str, q: str, angle: float) -> LineName:
        line = self.b.join(PointName(p), PointName(q))
        if angle:
            return self.b.at_angle(through, line, self.number(f"angle_{p}{q}", angle))
        return line if through == p else self.b.parallel(through, line)

    def _starts(self, line: LineName) -> PointName:
        step = next(step for step in reversed(self.b.steps) if step.out == line)
        return step.tail if isinstance(step, Join) else PointName(getattr(step, "through", ""))

    # Guides ----------------------------------------------------------------------------------

    def _line_turned(self, name: str) -> bool:
        line = self.scene.lines[name]
        if line.towards is not None:
            return line.through in self.placed and line.towards in self.placed
        return line.angle is not None or name in self.line_turns

    def guide_direction(self, name: str, through: PointName) -> LineName:
        """Draw the direction of a guide through a point."""
        line, by = self.scene.lines[name], self.line_turns.get(name)
        if line.towards is not None and line.through is not None:
            by = (line.through, line.towards)
        if isinstance(by, tuple):
            joined = self.b.join(PointName(by[0]), PointName(by[1]))
            return joined if by[0] == through else self.b.parallel(through, joined)
        if by is not None:
            return self.axis(by, through)
        assert line.angle is not None
        found = self.b.at_angle(through, None, self.number(f"angle_{name}", line.angle))
        self.directions.setdefault(found, DrawnDirection(name, "line", (), None))
        return found

    def guide_base(self, name: str) -> PointName | None:
        """Return a point of a guide, if one is known."""
        line = self.scene.lines[name]
        if line.through is not None:
            return PointName(line.through) if line.through in self.placed else None
        if name not in self.bases:
            x, y = line.base
            if x is None or y is None:
                return None
            self.places[f"{name}:0"] = complex(x, y)
            self.bases[name] = self.b.take_point(f"{name}:0")
        return self.bases[name]

    def _resolve_lines(self) -> bool:
        """Find the direction or a point of a guide by a slider on it."""
        for slider, slide in self.scene.slides.items():
            name = self.scene.line_of.get(slider)
            if name is None:
                continue
            line = self.scene.lines[name]
            there, base = slide.pin in self.placed, self.guide_base(name)
            if not self._line_turned(name) and line.towards is None:
                if slider in self.turned:
                    self.line_turns[name] = slider
                    return True
                if there and base is not None and base != slide.pin and not slide.offset:
                    self.line_turns[name] = (base, slide.pin)
                    return True
            if self._line_turned(name) and there and base is None and line.through is None:
                self.bases[name] = self._base_by(name, slide)
                return True
        return False

    def _base_by(self, name: str, slide: Slide) -> PointName:
        """Find a point of a guide under the pin, at the coordinate that is known."""
        pin = PointName(slide.pin)
        foot = self._lay_off_offset(pin, self.guide_direction(name, pin), -slide.offset, slide.pin)
        for k, value in enumerate(self.scene.lines[name].base):
            if value is not None:
                start = f"{name}:{'xy'[k]}"
                level = self._level(start, k, value)
                return self.b.intersect_lines(f"{name}:0", self.guide_direction(name, foot), level)
        return foot

    def _level(self, start: str, k: int, value: float) -> LineName:
        """Draw the line of all points that have a coordinate, x (0) or y (1)."""
        if start not in self.places:
            self.places[start] = value * (1.0, 1j)[k]
            self.b.take_point(start)
        return self.b.at_angle(
            PointName(start), None, self.number("upright" if k == 0 else "level", 90.0 * (1 - k))
        )

    def _lay_off_offset(
        self, start: PointName, line: LineName, offset: float, of: str
    ) -> PointName:
        """Lay an offset off to the left of a line."""
        if not offset:
            return start
        across = self.b.perpendicular(start, line)
        return self.b.lay_off_length(self._name(of), start, across, self.number(f"e_{of}", offset))

    # Points ----------------------------------------------------------------------------------

    def _place(self) -> bool:
        """Place the points of a link of known direction from one of them."""
        if self.scene.travel is not None:
            slider, travel = self.scene.travel
            slide, name = self.scene.slides[slider], self.scene.line_of[slider]
            base = self.guide_base(name)
            if slide.pin not in self.placed and base is not None and self._line_turned(name):
                line = self.guide_direction(name, base)
                at = slide.pin if not slide.offset else self._name(slide.pin)
                foot = self.b.lay_off_length(at, base, line, self.number("s", travel))
                if slide.offset:
                    across = self.b.perpendicular(foot, line)
                    offset = self.number(f"e_{slide.pin}", slide.offset)
                    self.b.lay_off_length(slide.pin, foot, across, offset)
                self.placed[slide.pin] = None
                return True
        for link in self.turned:
            points = self.scene.links[link].points
            here = [point for point in points if point in self.placed]
            rest = [point for point in points if point not in self.placed]
            if here and rest:
                self._lay_off_side(link, here[0], rest[0], PointName(here[0]), rest[0])
                self.placed[rest[0]] = None
                return True
        return False

    def _lay_off_side(self, link: str, p: str, q: str, start: PointName, out: str) -> PointName:
        """Lay off the distance of two points of a link of known direction."""
        points = self.scene.links[link].points
        w = points[q] - points[p]
        if not w:
            return self.b.lay_off_length(
                out, start, self.axis(link, start), self.number("zero", 0.0)
            )
        size, course = abs(w), heading(w)
        if (course - self.turned[link].headings[0]) % 360.0 == 180.0:
            line = self._known_line(link, start)
            return self.b.lay_off_length(out, start, line, self.number(f"-l_{p}{q}", -size))
        line = self._side(link, start, course)
        return self.b.lay_off_length(out, start, line, self.number(f"l_{p}{q}", size))

    def _name(self, of: str) -> PointName:
        self._auxiliary += 1
        return PointName(f"{of}~{self._auxiliary}")

    def _meet(self) -> bool:
        """Place a point where two lines or arcs meet, those with the fewest mirror images first."""
        found: list[tuple[int, Locus, Locus, dict[str, tuple[Hop, ...]]]] = []
        for cluster in self._clusters():
            loci = [locus for point in cluster for locus in self._loci(point)]
            for one, two in combinations(loci, 2):
                arcs = one.is_arc + two.is_arc
                same = one.point == two.point and one.by == two.by and one.of == two.of
                if (arcs and same) or one == two:
                    continue
                first, second = (one, two) if two.is_arc or not one.is_arc else (two, one)
                paths = self._find_paths(first.point, cluster)
                if arcs == 0 and self._are_parallel(first, second, paths):
                    continue
                found.append((arcs, first, second, paths))
        if not found:
            return False
        _, first, second, paths = min(found, key=lambda pair: pair[0])
        out = first.point
        if not second.is_arc:
            one_line, two_line = self._line(first, ()), self._line(second, paths[second.point])
            self.b.intersect_lines(out, one_line, two_line)
        elif not first.is_arc:
            line = self._line(first, ())
            centre, radius = self._arc(second, paths[second.point])
            side = self.choice(f"side_{out}", FORWARD)
            self.b.intersect_line_circle(out, line, centre, radius, LineSense.FORWARD, side)
        else:
            one_arc, two_arc = self._arc(first, ()), self._arc(second, paths[second.point])
            side = self.choice(f"side_{out}", FORWARD)
            self.b.intersect_circles(out, *one_arc, *two_arc, Side.LEFT, side)
        self.placed[out] = None
        return True

    def _are_parallel(
        self, first: Locus, second: Locus, paths: Mapping[str, tuple[Hop, ...]]
    ) -> bool:
        """Return whether two lines have one direction in every mirror image."""
        kept = self.b.copy(), dict(self.numbers), dict(self.places), self._auxiliary
        bases, directions = dict(self.bases), dict(self.directions)
        one, two = self._line(first, ()), self._line(second, paths[second.point])
        values = self.values()
        u, v = values[one][1], values[two][1]
        sine = np.abs((np.conj(u) * v).imag) / np.abs(u) / np.abs(v)
        self.b, self.numbers, self.places, self._auxiliary = kept
        self.bases, self.directions = bases, directions
        return not np.any(sine > max(PARALLEL, 1e-9))

    def _clusters(self) -> list[list[str]]:
        """Return the points that are not placed, in lists that links of known direction join."""
        names = [
            *self.scene.points,
            *(p for body in self.scene.links.values() for p in body.points),
        ]
        rest = [name for name in dict.fromkeys(names) if name not in self.placed]
        clusters: list[list[str]] = []
        while rest:
            cluster = [rest.pop(0)]
            for point in cluster:
                for _, other in self._hops(point):
                    if other in rest:
                        rest.remove(other)
                        cluster.append(other)
            clusters.append(cluster)
        return clusters

    def _hops(self, point: str) -> Iterator[tuple[str, str]]:
        """Yield the links of known direction from a point that is not placed, and their points."""
        for link in self.turned:
            points = self.scene.links[link].points
            if point in points:
                yield from ((link, other) for other in points if other != point)

    def _find_paths(self, start: str, cluster: Sequence[str]) -> dict[str, tuple[Hop, ...]]:
        """Return the hops from every point of a cluster to one of them."""
        paths: dict[str, tuple[Hop, ...]] = {start: ()}
        front = [start]
        for point in front:
            for link, other in self._hops(point):
                if other not in paths and other in cluster:
                    paths[other] = ((link, other, point), *paths[point])
                    front.append(other)
        return paths

    def _loci(self, point: str) -> Iterator[Locus]:
        return find_loci(
            point,
            self.scene,
            placed=self.placed,
            directions=self.turned,
            has_course=self._line_turned,
            has_base=lambda name: self.guide_base(name) is not None,
        )

    def _measure_chord(self, locus: Locus) -> NumberName:
        """Draw two links at their angle, in any place, and measure the distance of their ends."""
        start, one, two, pin = locus.of
        bodies, end, b = self.scene.links, locus.point, self.b
        near = bodies[one].points[start] - bodies[one].points[pin]
        far = bodies[two].points[end] - bodies[two].points[pin]
        before, after = (heading(near) - locus.headings[0], heading(far) - locus.headings[1])
        line = b.at_angle(PointName(start), None, self.number("level", 0.0))
        at = b.lay_off_length(
            self._name(pin), PointName(start), line, self.number(f"l_{start}{pin}", abs(near))
        )
        found = tuple((180.0 - before + after + turn) % 360.0 for turn in line_angles(locus.size))
        if before % 180.0 == 0.0 and after % 180.0 == 0.0:  # the other sense gives the same length
            found = tuple(dict.fromkeys(min(turn, 360.0 - turn) for turn in found))
        angle = self.choice(f"phi_{one}_{two}", found)
        turned = b.at_angle(at, line, angle)
        size = self.number(f"l_{pin}{end}", abs(far))
        top = b.lay_off_length(self._name(end), at, turned, size)
        return b.measure(f"|{start}–{top}|", PointName(start), top)

    def _arc(self, locus: Locus, path: Sequence[Hop]) -> tuple[PointName, NumberName]:
        if locus.by == "angle":
            radius = self._measure_chord(locus)
            return self._carry(PointName(locus.of[0]), path), radius
        (centre,) = locus.of
        radius = self.number(f"l_{centre}{locus.point}", locus.size)
        return self._carry(PointName(centre), path), radius

    def _carry(self, point: PointName, path: Sequence[Hop]) -> PointName:
        """Carry a point by the links that join the point it is of to another one."""
        for link, p, q in path:
            point = self._lay_off_side(link, p, q, point, self._name(q))
        return point

    def _line(self, locus: Locus, path: Sequence[Hop]) -> LineName:
        """Draw the line of a point, carried along."""
        base, line = self._own_line(locus)
        carried = self._carry(base, path)
        return line if carried == base else self.b.parallel(carried, line)

    def _own_line(self, locus: Locus) -> tuple[PointName, LineName]:
        scene = self.scene
        if locus.by == "coordinate":
            k = "xy".index(locus.of[0])
            start = f"{locus.point}:{locus.of[0]}"
            return PointName(start), self._level(start, k, locus.size)
        slider = locus.of[0]
        slide, name = scene.slides[slider], scene.line_of.get(slider, "")
        if locus.by == "guide":
            base = self.guide_base(name)
            assert base is not None
            foot = self._lay_off_offset(
                base, self.guide_direction(name, base), slide.offset, slide.pin
            )
            return foot, self.guide_direction(name, foot)
        if locus.by == "through":
            pin = PointName(slide.pin)
            foot = self._lay_off_offset(
                pin, self.guide_direction(name, pin), -slide.offset, slide.pin
            )
            return foot, self.guide_direction(name, foot)
        along, host = rotation(slide.angle), scene.links[slide.host].points
        known = locus.of[1] if locus.by == "slot" else locus.point
        aside = (host[known] - slide.base - 1j * along * slide.offset) / along
        start = PointName(known) if locus.by == "slot" else PointName(slide.pin)
        line = self._slot(slide, start)
        offset = -aside.imag if locus.by == "slot" else aside.imag
        offset = 0.0 if abs(offset) <= 1e-12 * _size(host) else offset
        foot = self._lay_off_offset(start, line, offset, slide.pin)
        return foot, self._slot(slide, foot)

    def _slot(self, slide: Slide, through: PointName) -> LineName:
        """Draw the direction of a slide line of a link through a point."""
        line = self.axis(slide.host, through)
        if not slide.angle:
            return line
        return self.b.at_angle(through, line, self.number(f"angle_{slide.slider}", slide.angle))

    # Numbers ---------------------------------------------------------------------------------

    def number(self, name: str, value: float) -> NumberName:
        """Take a number as known, once; another value gets another name."""
        return self.b.known_once(self.numbers, name, value)

    def choice(self, name: str, values: tuple[float, ...]) -> NumberName:
        """Take a number of which the figure leaves several."""
        number = self.b.known(name)
        self.choices[number] = values
        return number


def _size(points: Mapping[str, complex]) -> float:
    return max((abs(place) for place in points.values()), default=0.0) or 1.0
