"""From a drawn mechanism to the text of its problem file and the pose the file means."""

from __future__ import annotations

import cmath
import copy
import math
import random
from dataclasses import dataclass, field

FRAME = "0"


@dataclass
class Line:
    """Line of a prismatic pair on its host, with its direction in the drawn pose.

    ``base`` is a point of the host or, on the frame, a place.
    """

    host: str
    u: complex
    base: str | complex
    towards: str = ""


@dataclass
class Link:
    """Link with its points (a slider's pin first) and the line it slides on."""

    name: str
    points: list[str] = field(default_factory=list)
    line: Line | None = None


@dataclass
class Draft:
    """Drawn mechanism: places of all points in parts of the box, links, rules."""

    place: dict[str, complex] = field(default_factory=dict)
    fixed: list[str] = field(default_factory=list)
    links: dict[str, Link] = field(default_factory=dict)
    rules: list[tuple[str, str | complex]] = field(default_factory=list)
    slotted: list[tuple[str, str, str, str]] = field(default_factory=list)
    pivot: str = ""
    driver: str = "1"
    known: list[str] = field(default_factory=list)

    def copy(self) -> Draft:
        """Return a deep copy."""
        return copy.deepcopy(self)

    def add(self, *points: str) -> Link:
        """Add the next link."""
        link = Link(str(len(self.links) + 1), list(points))
        self.links[link.name] = link
        return link

    def slide(self, slider: Link, line: Line) -> None:
        """Let a link slide on a line."""
        slider.line = line

    def holders(self, point: str) -> frozenset[str]:
        """Links that have a point, the frame among them."""
        found = {name for name, link in self.links.items() if point in link.points}
        return frozenset(found | ({FRAME} if point in self.fixed else set()))

    def is_bare_host(self, name: str) -> bool:
        """Return whether a link has no axis other than the line that it carries."""
        link = self.links[name]
        carries = any(other.line and other.line.host == name for other in self.links.values())
        return carries and len(link.points) == 1 and link.line is None


class TextBuilder:
    """Writer of one problem file."""

    def __init__(self, draft: Draft, rng: random.Random) -> None:
        self.draft = draft
        self.rng = rng
        self.size = rng.choice((0.1, 0.25, 1.0))
        self.place = {name: self.size * z for name, z in draft.place.items()}
        self.axis: dict[str, complex] = {}
        self.origin: dict[str, str] = {}
        self.first: dict[str, tuple[str, str]] = {}

    def build(self) -> tuple[str, dict[str, tuple[float, float, float]]]:
        """Return the text and the pose."""
        self._choose_axes()
        parts = [f'title = "Случайный механизм"\n\n{self._frame()}']
        parts += [self._link(link) for link in self.draft.links.values()]
        parts.append(self._driver())
        self._tell_sides()
        if self.draft.rules:
            lines = [f"{point} = {self._rule(rule)}" for point, rule in self.draft.rules]
            parts.append("\n".join(["[assembly]", *lines, ""]))
        pose = {}
        for name in self.draft.links:
            z = self.place[self.origin[name]]
            pose[name] = (z.real, z.imag, cmath.phase(self.axis[name]))
        return "\n".join(parts), pose

    def _tell_sides(self) -> None:
        """Write the sides of a slotted link's points where its line does not determine them."""
        place = self.draft.place
        for slider, host, joint, other in self.draft.slotted:
            line, points = self.draft.links[slider].line, self.draft.links[host].points
            assert line is not None
            base = place[line.base] if isinstance(line.base, str) else line.base
            runs_on = ((base - place[other]) * line.u.conjugate()).real >= 0
            untold = [] if runs_on else [point for point in points if point != other]
            if not runs_on or len(points) == 1:
                untold += [point for point in self.draft.links[slider].points if point != joint]
            self.draft.rules += [(point, place[point]) for point in untold[:1]]

    def _choose_axes(self) -> None:
        """Own axis of every link: its slide, its first length, or the line it carries."""
        for link in self.draft.links.values():
            self.origin[link.name] = link.points[0]
            if link.line is not None:
                self.axis[link.name] = link.line.u
            elif len(link.points) > 1:
                pair = self.rng.sample(link.points, 2)
                if link.name == self.draft.driver:  # phi is measured at the pivot
                    pair = link.points[:2]
                self.first[link.name] = (pair[0], pair[1])
                self.origin[link.name] = pair[0]
                along = self.place[pair[1]] - self.place[pair[0]]
                self.axis[link.name] = along / abs(along)
            else:
                carried = [
                    other.line.u
                    for other in self.draft.links.values()
                    if other.line is not None and other.line.host == link.name
                ]
                self.axis[link.name] = carried[0]

    def _frame(self) -> str:
        lines = ["[frame]"]
        lines += [f"{p} = {_pair(self.place[p])}" for p in self.draft.fixed]
        for link in self.draft.links.values():
            line = link.line
            if line is None or line.host != FRAME:
                continue
            base = line.base
            through = f'"{base}"' if isinstance(base, str) else _pair(self.size * base)
            angle = _degrees(line.u)
            lines.append(f"guides.g{link.name} = {{ through = {through}, angle = {angle!r} }}")
        return "\n".join(lines) + "\n"

    def _link(self, link: Link) -> str:
        lines = [f"[links.{link.name}]"]
        listed = ", ".join(f'"{p}"' for p in link.points)
        lines.append(f"points = [{listed}]")
        if link.line is not None:
            lines.append(f"slides = {{ {self._slide(link, link.line)} }}")
            placed = [link.points[0]]
        elif link.name in self.first:
            a, b = self.first[link.name]
            lines.append(f"{a}{b} = {abs(self.place[b] - self.place[a])!r}")
            placed = [a, b]
        else:
            placed = [link.points[0]]
        for point in link.points:
            if point not in placed:
                lines += self._third(link, point, placed)
                placed.append(point)
        return "\n".join(lines) + "\n"

    def _third(self, link: Link, point: str, placed: list[str]) -> list[str]:
        """Place a point of a link in one of the ways that the file format has."""
        z = self.place[point]
        way = self.rng.choice(("from", "on", "side", "vertex"))
        if way == "from" or len(placed) < 2:
            start = self.rng.choice(placed)
            local = (z - self.place[start]) * self.axis[link.name].conjugate()
            return [f'{point} = {{ from = "{start}", {_along(local)} }}']
        a, b = self.rng.sample(placed, 2)
        p, along = self.place[a], self.place[b] - self.place[a]
        local = (z - p) / along * abs(along)
        reach = abs(z - p)
        if way == "side" and abs(local.imag) > 0.3 * max(reach, abs(along)):
            side = "left" if local.imag > 0 else "right"
            return [
                f"{a}{point} = {reach!r}",
                f"{b}{point} = {abs(z - self.place[b])!r}",
                f'{point} = {{ side = "{side} of {a}{b}" }}',
            ]
        if way == "vertex":
            angle = _degrees(local)
            tail = f'vertex = "{a}", ray = "{a}{b}", angle = {angle!r}'
            if self.rng.random() < 0.5:
                return [f"{a}{point} = {reach!r}", f"{point} = {{ {tail} }}"]
            return [f"{point} = {{ {tail}, distance = {reach!r} }}"]
        return [f'{point} = {{ on = "{a}{b}", {_along(local)} }}']

    def _slide(self, link: Link, line: Line) -> str:
        base = self._base(line)
        offset = ((self.place[link.points[0]] - base) * line.u.conjugate()).imag
        tail = f", offset = {offset!r}" if abs(offset) > 1e-12 else ""
        if line.host == FRAME:
            return f'on = "g{link.name}"{tail}'
        if line.towards:
            return f'on = "{line.host}", along = "{line.base}{line.towards}"{tail}'
        text = f'on = "{line.host}", through = "{line.base}"'
        sliders = [k for k, v in self.draft.links.items() if v.line and v.line.host == line.host]
        if self.draft.is_bare_host(line.host) and link.name == sliders[0]:
            return text + tail
        turning = 1 + 0j if self._only_translates(line.host) else self.axis[line.host]
        return f"{text}, angle = {_degrees(line.u * turning.conjugate())!r}{tail}"

    def _base(self, line: Line) -> complex:
        base = line.base
        return self.place[base] if isinstance(base, str) else self.size * base

    def _only_translates(self, name: str) -> bool:
        """Return whether only slides join a link to the frame: its angles are then from +x."""
        line = self.draft.links[name].line
        return line is not None and (line.host == FRAME or self._only_translates(line.host))

    def _driver(self) -> str:
        draft, rng = self.draft, self.rng
        lines = ["[driver]", f'link = "{draft.driver}"']
        link = draft.links[draft.driver]
        rate = rng.choice((-1, 1)) * rng.uniform(2.0, 20.0)
        if link.line is None:
            lines.append(f"phi = {_degrees(self.axis[draft.driver])!r}")
            if rng.random() < 0.3:
                lines.append(f"n = {rate * 30 / math.pi!r}")
            else:
                lines.append(f"omega = {rate!r}")
            if rng.random() < 0.6:
                lines.append(f"epsilon = {rng.uniform(-100.0, 100.0)!r}")
        else:
            base = self._base(link.line)
            s = ((self.place[link.points[0]] - base) * link.line.u.conjugate()).real
            lines += [f"s = {s!r}", f"v = {self.size * rate!r}"]
            if rng.random() < 0.6:
                lines.append(f"a = {self.size * rng.uniform(-100.0, 100.0)!r}")
        return "\n".join(lines) + "\n"

    def _rule(self, rule: str | complex) -> str:
        if isinstance(rule, str):
            return f'"{rule}"'
        return f"{{ near = {_pair(self.size * rule)} }}"


def _degrees(u: complex) -> float:
    return math.degrees(cmath.phase(u))


def _pair(z: complex) -> str:
    return f"[{z.real!r}, {z.imag!r}]"


def _along(local: complex) -> str:
    across = "" if abs(local.imag) < 1e-12 else f", across = {local.imag!r}"
    return f"at = {local.real!r}{across}"
