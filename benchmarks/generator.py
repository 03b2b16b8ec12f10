"""Random mechanisms, pose first: joints are drawn in a box, the problem file follows from them.

The pose is there before the lengths, so the mechanism certainly assembles. It is a crank or a
driving slider with one to three dyads of any kind, each hanging on random links drawn before it;
a prismatic pair is written either way (the group's link slides on the known one, or carries the
line that the known one slides on).
"""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from benchmarks.generator_text import FRAME, Draft, Line, Link, TextBuilder

KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP")

TRIADS = (
    ("RR", "RR", "RR"),
    ("RR", "RR", "PR"),
    ("RR", "PR", "PR"),
    ("RR", "RR", "RP"),
    ("RR", "PR", "RP"),
    ("PR", "PR", "RP"),
    ("RR", "RP", "RP"),
)
"""Legs of a triad: outer and inner joint of each."""

SINE = 0.25
"""Least sine of the angle at which the lines of a group meet: a worse one is near a dead point."""

NEAR = 0.12
"""Least distance between points, in parts of the box."""

Pose = dict[str, tuple[float, float, float]]


class _Unlucky(Exception):  # noqa: N818  a draw to be repeated, no error
    """A draw that makes a poor mechanism."""


def random_problem(seed: int, *, triad: bool = False) -> tuple[str, Pose]:
    """Draw a mechanism.

    Parameters
    ----------
    seed : int
        The same seed gives the same mechanism.
    triad : bool
        One of its groups is a triad (группа III класса).

    Returns
    -------
    text : str
        Problem file.
    pose : dict
        x, y in m of the origin and direction in radians of the own axis of every moving link, at
        the file's only position.
    """
    rng = random.Random(seed)
    while True:
        try:
            return _Drawing(rng).make(triad=triad)
        except _Unlucky:
            continue


@dataclass
class _Lead:
    """Outer joint of a group: a point of a known link, or a line."""

    to: str
    point: str = ""
    holders: frozenset[str] = frozenset()


@dataclass
class _Drawing:
    """Mechanism while it is drawn."""

    rng: random.Random
    draft: Draft = field(default_factory=Draft)
    names: Iterator[str] = field(default_factory=lambda: iter("ABCDEFGHIJKLMNOPQRSTUVWXYZ"))

    def make(self, *, triad: bool = False) -> tuple[str, Pose]:
        rng = self.rng
        if triad:  # P, Q, S are reserved for loaded points
            self.names = iter("ABCDEFGHIJKLMNORTUVWXYZ")
        self._draw_driver()
        count = rng.randint(1, 3)
        triads = {rng.randrange(count := min(count, 2))} if triad else set()
        for number in range(count):
            for _ in range(40):
                saved = self.draft.copy()
                try:
                    self._draw_group("triad" if number in triads else rng.choice(KINDS))
                    break
                except _Unlucky:
                    self.draft = saved
            else:
                raise _Unlucky
        for link in self.draft.links.values():
            if rng.random() < 0.3:
                self._new_point(link.name, link.points)
        return TextBuilder(self.draft, rng).build()

    # Places

    def _somewhere(self, near: complex | None = None) -> complex:
        """Return a place in the box, not too close to any point there is."""
        for _ in range(60):
            z = complex(self.rng.uniform(-1, 1), self.rng.uniform(-1, 1))
            if near is not None:
                z = near + 0.7 * z
            if all(abs(z - other) >= NEAR for other in self.draft.place.values()):
                return z
        raise _Unlucky

    def _name(self, z: complex) -> str:
        point = next(self.names, "")
        if not point:
            raise _Unlucky
        self.draft.place[point] = z
        return point

    def _new_point(self, link: str, points: list[str], *, z: complex | None = None) -> str:
        if z is None:
            z = self._somewhere(self.draft.place[points[0]] if points and link != FRAME else None)
        name = self._name(z)
        points.append(name)
        return name

    def _direction(self) -> complex:
        """Direction of a line, often a multiple of 90 degrees."""
        if self.rng.random() < 0.4:
            return 1j ** self.rng.randrange(4)
        return cmath.rect(1.0, self.rng.uniform(-math.pi, math.pi))

    # Driver

    def _draw_driver(self) -> None:
        draft, rng = self.draft, self.rng
        link = draft.add()
        if rng.random() < 0.75:
            pivot = self._new_point(FRAME, draft.fixed, z=0j)
            link.points.append(pivot)
            self._new_point(link.name, link.points)
            draft.pivot = pivot
        else:
            u = self._direction()
            pin = self._new_point(link.name, link.points)
            draft.slide(link, self._frame_line(u, draft.place[pin]))

    # Leads

    def _choose_known(self, banned: frozenset[str] = frozenset()) -> str:
        """Choose a link to attach to; the driver and later links more often than the frame."""
        known = [name for name in (FRAME, *self.draft.known) if name not in banned]
        if not known:
            raise _Unlucky
        if FRAME in known and self.rng.random() < 0.3:
            return FRAME
        return self.rng.choice(known)

    def _revolute(self, banned: frozenset[str] = frozenset()) -> _Lead:
        draft, rng = self.draft, self.rng
        to = self._choose_known(banned)
        points = draft.fixed if to == FRAME else draft.links[to].points
        old = [p for p in points if not draft.holders(p) & banned and p != draft.pivot]
        again = old and rng.random() < 0.6
        point = rng.choice(old) if again else self._new_point(to, points)
        return _Lead(to, point, draft.holders(point))

    def _frame_line(self, u: complex, pin: complex) -> Line:
        """Guide of the frame in a direction, through the pin, aside from it, or at a point."""
        draft, rng = self.draft, self.rng
        if draft.fixed and rng.random() < 0.5:
            base: str | complex = rng.choice(draft.fixed)
        elif rng.random() < 0.5:
            base = pin + u * rng.uniform(-0.5, 0.5)
        else:
            base = pin + u * complex(rng.uniform(-0.5, 0.5), rng.uniform(-0.2, 0.2))
        return Line(FRAME, u, base)

    def _line_on(self, host: str, pin: complex, *, points: list[str] | None = None) -> Line:
        """Line of a link with a direction still free."""
        draft, rng = self.draft, self.rng
        if host == FRAME:
            return self._frame_line(self._direction(), pin)
        points = draft.links[host].points if points is None else points
        if len(points) > 1 and rng.random() < 0.5:
            start, end = rng.sample(points, 2)
            u = draft.place[end] - draft.place[start]
            return Line(host, u / abs(u), start, end)
        return Line(host, self._direction(), rng.choice(points))

    def _prismatic(self, own: Link, pin: str, banned: frozenset[str]) -> tuple[complex, str]:
        """Join a link of the group with a known link by a slide.

        Returns the direction of the line and the known link. The pin is the point of the group's
        link that slides. Where the known link may become a slider, the pair is written the other
        way in half the cases.
        """
        draft, rng = self.draft, self.rng
        able = [
            name
            for name, link in draft.links.items()
            if name not in banned | {own.name, draft.driver} and link.line is None
        ]
        able = [name for name in able if not draft.is_bare_host(name) and name in draft.known]
        if able and rng.random() < 0.6:
            slider = draft.links[rng.choice(able)]
            line = self._own_line(own)
            rng.shuffle(slider.points)
            draft.slide(slider, line)
            return line.u, slider.name
        to = self._choose_known(banned)
        line = self._line_on(to, draft.place[pin])
        draft.slide(own, line)
        return line.u, to

    def _own_line(self, own: Link) -> Line:
        """Line carried by a link of the group: given a second point, or its only axis."""
        if len(own.points) == 1 and self.rng.random() < 0.7:
            self._new_point(own.name, own.points)
        return self._line_on(own.name, 0j, points=own.points)

    # Groups

    def _draw_group(self, kind: str) -> None:
        self.draft.known = [*self.draft.links]
        known_points = self._known_points()
        draw: dict[str, Callable[[], tuple[str, complex] | None]] = {
            "RRR": self._rrr,
            "RRP": self._rrp,
            "RPR": self._rpr,
            "PRP": self._prp,
            "RPP": self._rpp,
            "triad": self._triad,
        }
        choice = draw[kind]()
        if choice is not None:
            self._write_rule(*choice, known_points)

    def _known_points(self) -> list[str]:
        draft = self.draft
        return [*draft.fixed, *(p for link in draft.links.values() for p in link.points)]

    def _rrr(self) -> tuple[str, complex]:
        draft = self.draft
        one = self._revolute()
        two = self._revolute(self._not_beside(one))
        b, d = draft.place[one.point], draft.place[two.point]
        a, e = draft.add(one.point), draft.add(two.point)
        c = self._name(self._somewhere())
        a.points.append(c)
        e.points.append(c)
        z = draft.place[c]
        _demand(abs(((b - z).conjugate() * (d - z)).imag) >= SINE * abs(b - z) * abs(d - z))
        return c, d + ((z - d) / (b - d)).conjugate() * (b - d)

    def _rrp(self) -> tuple[str, complex]:
        draft = self.draft
        one = self._revolute()
        a, e = draft.add(one.point), draft.add()
        c = self._name(self._somewhere())
        a.points.append(c)
        e.points.append(c)
        u, _ = self._prismatic(e, c, self._not_beside(one))
        b, z = draft.place[one.point], draft.place[c]
        along = ((z - b) * u.conjugate()).real
        _demand(abs(along) >= SINE * abs(z - b))
        return c, z - 2 * along * u

    def _rpr(self) -> tuple[str, complex] | None:
        draft, rng = self.draft, self.rng
        one = self._revolute()
        two = self._revolute(self._not_beside(one))
        a, e = draft.add(one.point), draft.add(two.point)
        slider, host = (a, e) if rng.random() < 0.5 else (e, a)
        b, d = draft.place[slider.points[0]], draft.place[host.points[0]]
        gap = b - d
        if rng.random() < 0.4:  # the line of centres, as in textbooks
            u = gap / abs(gap) * rng.choice((1, -1))
        else:
            u = gap / abs(gap) * cmath.rect(1.0, rng.uniform(-1.3, 1.3)) * rng.choice((1, -1))
        way = rng.randrange(3)
        if way == 0:
            self._new_point(host.name, host.points, z=d + u * rng.uniform(0.3, 1.2))
            line = Line(host.name, u, *host.points)
        else:
            if way == 1:
                self._new_point(host.name, host.points)
            line = Line(host.name, u, rng.choice(host.points))
        draft.slide(slider, line)
        w = gap * u.conjugate()
        _demand(abs(w.real) >= SINE * abs(gap))
        if w.real > 0 and rng.random() < 0.5:
            draft.slotted.append((slider.name, host.name, slider.points[0], host.points[0]))
            return None
        turned = w / complex(-w.real, w.imag)
        if len(host.points) > 1 and rng.random() < 0.6:
            return host.points[1], d + (draft.place[host.points[1]] - d) * turned
        point = self._new_point(slider.name, slider.points)
        if rng.random() < 0.5:  # the pin, which is the first point, need not be the outer joint
            slider.points.reverse()
        return point, b + (draft.place[point] - b) * turned

    def _prp(self) -> None:
        draft = self.draft
        a, e = draft.add(), draft.add()
        c = self._name(self._somewhere())
        a.points.append(c)
        e.points.append(c)
        u, to = self._prismatic(a, c, frozenset({e.name}))
        w, _ = self._prismatic(e, c, frozenset({a.name, to}))
        _demand(abs((u.conjugate() * w).imag) >= SINE)

    def _rpp(self) -> None:
        draft, rng = self.draft, self.rng
        one = self._revolute()
        a, e = draft.add(one.point), draft.add()
        pin = self._new_point(e.name, e.points)
        u, _ = self._prismatic(e, pin, self._not_beside(one) | {a.name})
        if e.line is None and (len(e.points) == 1 or rng.random() < 0.5):
            line = self._own_line(a)
            draft.slide(e, line)
        else:
            line = self._line_on(e.name, 0j, points=e.points)
            if rng.random() < 0.3 and e.line is not None:
                self._new_point(e.name, e.points)
            draft.slide(a, line)
        _demand(abs((u.conjugate() * line.u).imag) >= SINE)

    def _triad(self) -> None:
        """Hold a base link by three legs, each with a hinge and another hinge or a guide."""
        draft, rng = self.draft, self.rng
        base = draft.add()
        lines: list[tuple[complex, complex]] = []
        hung: list[tuple[str, str]] = []
        for kind in rng.choice(TRIADS):
            if kind == "PR":
                a, c = draft.add(), self._name(self._somewhere())
                a.points.append(c)
                base.points.append(c)
                u, to = self._prismatic(a, c, frozenset({base.name}))
                lines.append((draft.place[c], 1j * u))
                hung.append((to, ""))
                continue
            lead = self._revolute()
            a = draft.add(lead.point)
            hung.append((lead.to, lead.point))
            at = draft.place[lead.point]
            if kind == "RR":
                c = self._name(self._somewhere())
                a.points.append(c)
                base.points.append(c)
                lines.append((at, (draft.place[c] - at) / abs(draft.place[c] - at)))
            else:
                block = base.line is None and rng.random() < 0.3
                host, slider = (a, base) if block else (base, a)
                if not host.points or len(host.points) == 1:
                    self._new_point(host.name, host.points)
                if not slider.points:
                    self._new_point(slider.name, slider.points)
                line = self._line_on(host.name, 0j, points=host.points)
                draft.slide(slider, line)
                lines.append((at, 1j * line.u))
        while len(base.points) < 2:
            self._new_point(base.name, base.points)
        _demand(len({to for to, _ in hung}) > 1)
        points = [point for _, point in hung if point]
        _demand(len(set(points)) == len(points))
        about = draft.place[base.points[0]]
        rows = [[u.real, u.imag, ((p - about).conjugate() * u).imag] for p, u in lines]
        (a1, b1, c1), (a2, b2, c2), (a3, b3, c3) = rows
        det = a1 * (b2 * c3 - b3 * c2) - b1 * (a2 * c3 - a3 * c2) + c1 * (a2 * b3 - a3 * b2)
        _demand(abs(det) >= SINE / 2)
        z = draft.place[base.points[0]]
        draft.rules.append((base.points[0], z + cmath.rect(1e-4, rng.uniform(-math.pi, math.pi))))

    def _not_beside(self, lead: _Lead) -> frozenset[str]:
        """Return the links that the other leg may not join: they would form one rigid body."""
        driver = {self.draft.driver} if lead.point == self.draft.pivot else set()
        return lead.holders | {lead.to} | driver

    # Rule of assembly

    def _write_rule(self, point: str, mirror: complex, known: list[str]) -> None:
        """Write an assembly rule that holds for the chosen assembly and not for the other one."""
        draft, rng = self.draft, self.rng
        z = draft.place[point]
        phrases: list[str | complex] = []
        gap = z - mirror
        ways = (("right of", 1), ("left of", -1), ("above", -1j), ("below", 1j))
        known = [name for name in known if name != point]
        for name in known:
            for words, turn in ways:
                here = ((z - draft.place[name]) * turn).real
                if 0.02 < here < (gap * turn).real - 0.02:
                    phrases.append(f"{words} {name}")
        lines: list[str | complex] = []
        for start in known:
            for end in known:
                along = draft.place[end] - draft.place[start]
                if start == end or abs(along) < NEAR:
                    continue
                here = ((z - draft.place[start]) / along).imag * abs(along)
                more = (gap / along).imag * abs(along)
                if 0.02 < here < more - 0.02:
                    lines.append(f"left of {start}{end}")
                elif -0.02 > here > more + 0.02:
                    lines.append(f"right of {start}{end}")
        off = z + cmath.rect(0.1 * abs(gap), rng.uniform(-math.pi, math.pi))
        near: list[str | complex] = [off] if abs(gap) > 0.05 else []
        able = [said for said in (phrases, lines, near) if said]
        if not able:
            raise _Unlucky
        draft.rules.append((point, rng.choice(rng.choice(able))))


def _demand(good: bool) -> None:
    if not good:
        raise _Unlucky
