"""Random geared linkages with a full system of their own: motion by Newton, forces by bodies."""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Callable, Sequence

import numpy as np
from msgspec import Struct, field


class Taylor:
    """A number with its first and second derivative by time."""

    def __init__(self, a: complex, b: complex = 0, c: complex = 0) -> None:
        self.parts = (complex(a), complex(b), complex(c))

    def __add__(self, other: Taylor | complex) -> Taylor:
        o = other if isinstance(other, Taylor) else Taylor(other)
        return Taylor(*(x + y for x, y in zip(self.parts, o.parts, strict=True)))

    __radd__ = __add__

    def __neg__(self) -> Taylor:
        return self * -1

    def __sub__(self, other: Taylor | complex) -> Taylor:
        return self + (-other)

    def __mul__(self, other: Taylor | complex) -> Taylor:
        o = other if isinstance(other, Taylor) else Taylor(other)
        (a, b, c), (x, y, z) = self.parts, o.parts
        return Taylor(a * x, a * y + b * x, a * z + 2 * b * y + c * x)

    __rmul__ = __mul__

    def conjugate(self) -> Taylor:
        return Taylor(*(x.conjugate() for x in self.parts))

    def turned(self) -> Taylor:
        """Return exp(i·self)."""
        a, b, c = self.parts
        u = cmath.exp(1j * a)
        return Taylor(u, 1j * b * u, (1j * c - b * b) * u)


class Wheels(Struct):
    """Two wheels: links, centres, ratio of the second to the first relative to the carrier."""

    links: tuple[str, str]
    centres: tuple[str, str]
    carrier: str
    kind: str
    radii: tuple[float, float]
    alpha: float = 20.0
    slide: int = -1
    offset: float = 0.0


class Model(Struct):
    """A mechanism by the places of its points in one assembled position."""

    links: dict[str, dict[str, complex]]
    joints: list[tuple[str, str, str]]  # point, link, link
    slides: list[tuple[str, str, complex, complex]] = field(default_factory=list)
    wheels: list[Wheels] = field(default_factory=list)
    masses: dict[str, tuple[float, float]] = field(default_factory=dict)
    rules: dict[str, str] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)
    omega: float = 3.0
    epsilon: float = 4.0

    @property
    def moving(self) -> list[str]:
        return [link for link in self.links if link != "0"]

    def axis(self, link: str) -> float:
        """Return the angle of the own axis of a link in the assembled position."""
        if link == "0":
            return 0.0
        for slider, _, _, along in self.slides:
            if slider == link:
                return cmath.phase(along)
        places = [*self.links[link].values()]
        return cmath.phase(places[1] - places[0]) if len(places) > 1 else 0.0

    def start(self) -> list[float]:
        found = []
        for link in self.moving:
            z = next(iter(self.links[link].values()))
            found += [z.real, z.imag, self.axis(link)]
        return found

    def local(self, link: str, point: str) -> complex:
        if link == "0":
            return self.links["0"][point]
        origin = next(iter(self.links[link].values()))
        return (self.links[link][point] - origin) * cmath.exp(-1j * self.axis(link))

    # Motion --------------------------------------------------------------------------------

    def gaps(self, q: Sequence[Taylor], phi: Taylor) -> list[Taylor]:
        """Return all constraints, in terms of origins and angles of the links."""
        at = {link: (q[3 * k] + q[3 * k + 1] * 1j, q[3 * k + 2])
              for k, link in enumerate(self.moving)}  # fmt: skip
        at["0"] = (Taylor(0), Taylor(0))

        def place(link: str, local: complex) -> Taylor:
            z, turn = at[link]
            return z + turn.turned() * local

        def real(x: Taylor) -> Taylor:
            return (x + x.conjugate()) * 0.5

        def imag(x: Taylor) -> Taylor:
            return (x - x.conjugate()) * -0.5j

        found = []
        for point, one, two in self.joints:
            gap = place(one, self.local(one, point)) - place(two, self.local(two, point))
            found += [real(gap), imag(gap)]
        ways = []
        for slider, host, base, along in self.slides:
            u = along * cmath.exp(-1j * self.axis(host))
            foot = self._inside(host, base)
            pin = next(iter(self.links[slider]))
            away = place(slider, self.local(slider, pin)) - place(host, foot)
            seen = (at[host][1].turned() * u).conjugate() * away
            first = (self.links[slider][pin] - base) * along.conjugate()
            kept = self.axis(slider) - self.axis(host)
            found += [imag(seen) - first.imag, at[slider][1] - at[host][1] - kept]
            ways.append(real(seen) - first.real)
        for pair in self.wheels:
            a, b = (at[x][1] - self.axis(x) for x in pair.links)
            c = at[pair.carrier][1] - self.axis(pair.carrier)
            if pair.slide >= 0:
                sign = 1 if self.slides[pair.slide][0] == pair.links[1] else -1
                found.append(a - c + ways[pair.slide] * (sign / pair.offset))
                continue
            k = pair.radii[0] / pair.radii[1] * (1 if pair.kind == "internal" else -1)
            found.append(b - c - (a - c) * k)
        found.append(at["1"][1] - phi)
        return found

    def _inside(self, link: str, place: complex) -> complex:
        if link == "0":
            return place
        origin = next(iter(self.links[link].values()))
        return (place - origin) * cmath.exp(-1j * self.axis(link))

    def solve(self, degrees: float) -> tuple[list[float], list[float], list[float]]:
        """Return places, rates and accelerations of all links, followed from the start."""
        q, first = self.start(), self.axis("1")
        steps = max(int(abs(degrees)), 1)
        for k in range(steps + 1):
            phi = first + math.radians(degrees) * k / steps
            for _ in range(30):
                now = self.gaps([Taylor(x) for x in q], Taylor(phi))
                f = [x.parts[0].real for x in now]
                change = np.linalg.solve(self.jacobian(q), f)
                q = [a - b for a, b in zip(q, change, strict=True)]
                if max(abs(change)) < 1e-14:
                    break
            else:
                raise ArithmeticError("no solution")
        j = self.jacobian(q)
        right = np.zeros(len(q))
        right[-1] = self.omega
        rates = np.linalg.solve(j, right)
        path = [Taylor(a, b) for a, b in zip(q, rates, strict=True)]
        turned = Taylor(phi, self.omega, self.epsilon)
        gaps = self.gaps(path, turned)
        return q, list(rates), list(np.linalg.solve(j, [-x.parts[2].real for x in gaps]))

    def jacobian(self, q: Sequence[float]) -> np.ndarray:
        columns = []
        for i in range(len(q)):
            path = [Taylor(a, float(i == k)) for k, a in enumerate(q)]
            columns.append([x.parts[1].real for x in self.gaps(path, Taylor(0))])
        return np.array(columns).T

    # Forces --------------------------------------------------------------------------------

    def forces(self, q: list[float], a: list[float]) -> dict[tuple[str, str, str], complex]:
        """Return the reactions (joint, on, by), and the driving moment under ("M", "1", "")."""
        index = {link: 3 * k for k, link in enumerate(self.moving)}

        def world(link: str, local: complex) -> complex:
            if link == "0":
                return local
            k = index[link]
            return complex(q[k], q[k + 1]) + local * cmath.exp(1j * q[k + 2])

        size = len(q)
        right = np.zeros(size)
        for link, (mass, inertia) in self.masses.items():
            k = index[link]
            acceleration = complex(a[k], a[k + 1])
            force = -mass * acceleration - 9.81j * mass  # the centre is the origin of the link
            right[k : k + 3] -= [force.real, force.imag, -inertia * a[k + 2]]

        def column(
            on: str, by: str, at: complex, force: complex, couple: float = 0.0
        ) -> np.ndarray:
            made = np.zeros(size)
            for link, sign in ((on, 1), (by, -1)):
                if link == "0" or not link:
                    continue
                k = index[link]
                arm = at - complex(q[k], q[k + 1])
                moment = (arm.conjugate() * force).imag + couple
                made[k : k + 3] += sign * np.array([force.real, force.imag, moment])
            return made

        columns: list[np.ndarray] = []
        names: list[tuple[str, str, str, complex]] = []
        for point, one, two in self.joints:
            at = world(one, self.local(one, point))
            for unit in (1, 1j):
                columns.append(column(one, two, at, unit))
                names.append((point, one, two, unit))
        for slider, host, _, along in self.slides:
            pin = next(iter(self.links[slider]))
            at = world(slider, self.local(slider, pin))
            turned = 0.0 if host == "0" else q[index[host] + 2] - self.axis(host)
            across = along * 1j * cmath.exp(1j * turned)
            columns += [column(slider, host, at, across), column(slider, host, at, 0, 1.0)]
            names += [(pin, slider, host, across), ("", "", "", 0)]
        first = len(columns)
        for pair in self.wheels:
            columns.append(np.zeros(size))
            names.append(("W", *pair.links, 0))
        columns.append(column("1", "", 0, 0, 1.0))
        names.append(("M", "1", "", 1))
        for signs in range(2 ** len(self.wheels)):
            for n, pair in enumerate(self.wheels):
                sign = 1 if signs >> n & 1 else -1
                at, force = self._teeth(pair, world, q, index, sign)
                columns[first + n] = column(*pair.links, at, force)
                names[first + n] = ("W", *pair.links, force)
            found = np.linalg.solve(np.array(columns).T, right)
            if all(
                found[first + n] * (1 if signs >> n & 1 else -1) >= -1e-9
                for n in range(len(self.wheels))
            ):
                break
        total: dict[tuple[str, str, str], complex] = {}
        for (joint, on, by, unit), value in zip(names, found, strict=True):
            total[joint, on, by] = total.get((joint, on, by), 0) + unit * value
        return total

    def _teeth(
        self, pair: Wheels, world: Callable[[str, complex], complex], q: list[float],
        index: dict[str, int], sign: int,
    ) -> tuple[complex, complex]:  # fmt: skip
        """Return the pole and the force on the first wheel for one newton along the pitch line."""
        one = pair.links[0]
        if pair.slide >= 0:
            centre = world(one, self.local(one, pair.centres[0]))
            _, host, _, along = self.slides[pair.slide]
            turned = 0.0 if host == "0" else q[index[host] + 2] - self.axis(host)
            pole = centre + 1j * along * cmath.exp(1j * turned) * pair.offset
        else:
            ends = [
                world(x, self.local(x, c)) for x, c in zip(pair.links, pair.centres, strict=True)
            ]
            centre = ends[0]
            reach = pair.radii[0]
            if pair.kind == "internal" and pair.radii[0] < pair.radii[1]:
                reach = -reach
            pole = centre + (ends[1] - centre) / abs(ends[1] - centre) * reach
        inward = (centre - pole) / abs(centre - pole)
        apart = 1.0
        if pair.kind == "internal" and pair.radii[0] > pair.radii[1]:
            apart = -1.0  # the first wheel is the ring: teeth push it out
        slope = math.tan(math.radians(pair.alpha))
        return pole, inward * (1j + sign * apart * slope)

    # The file ------------------------------------------------------------------------------

    def toml(self, positions: Sequence[float]) -> str:
        def number(x: float) -> str:
            return repr(float(x))

        text = ['title = "x"', "[frame]"]
        text += [f"{p} = [{number(z.real)}, {number(z.imag)}]" for p, z in self.links["0"].items()]
        guides = {}
        for k, (slider, host, base, along) in enumerate(self.slides):
            if host == "0":
                tilt = number(math.degrees(cmath.phase(along)))
                through = f"[{number(base.real)}, {number(base.imag)}]"
                text.append(f"guides.g{k} = {{ through = {through}, angle = {tilt} }}")
                guides[slider] = f"g{k}"
        for link in self.moving:
            points = [*self.links[link]]
            listed = ", ".join(f'"{p}"' for p in points)
            text += [f"[links.{link}]", f"points = [{listed}]"]
            if len(points) > 1:
                a, b = points[:2]
                text.append(f"{a}{b} = {number(abs(self.links[link][b] - self.links[link][a]))}")
            for extra in points[2:]:
                z = self.local(link, extra)
                text.append(f'{extra} = {{ on = "{a}{b}", at = {number(z.real)},'
                            f" across = {number(z.imag)} }}")  # fmt: skip
            for slider, host, base, along in self.slides:
                if slider != link:
                    continue
                pin = self.links[link][points[0]]
                offset = ((pin - base) * along.conjugate()).imag
                if host == "0":
                    text.append(f'slides = {{ on = "{guides[link]}", offset = {number(offset)} }}')
                else:
                    through = next(iter(self.links[host]))
                    angle = math.degrees(cmath.phase(along) - self.axis(host))
                    place = f"angle = {number(angle)}, offset = {number(offset)}"
                    text.append(f'slides = {{ on = "{host}", through = "{through}", {place} }}')
        text += self.lines
        text += ["[driver]", 'link = "1"', f"omega = {self.omega}", f"epsilon = {self.epsilon}"]
        first = math.degrees(self.axis("1"))
        text.append(f"phi = [{', '.join(number(first + x) for x in positions)}]")
        text.append("[assembly]")
        text += [f'{point} = "{rule}"' for point, rule in self.rules.items()]
        text += ["[dynamics]", "gravity = 9.81"]
        for link, (mass, inertia) in self.masses.items():
            origin = next(iter(self.links[link]))
            text += [f"[dynamics.links.{link}]", f"mass = {mass}", f'centre = "{origin}"',
                     f"inertia = {inertia}"]  # fmt: skip
        return "\n".join(text)


def side(p: str, q: str, places: dict[str, complex], c: complex) -> str:
    """Return the rule of a point that lies beside a line of two others."""
    turn = ((places[q] - places[p]).conjugate() * (c - places[p])).imag
    return f"{'left' if turn > 0 else 'right'} of {p}{q}"


def somewhere(rng: random.Random, size: float = 1.0) -> complex:
    return complex(rng.uniform(-size, size), rng.uniform(-size, size))


def masses(rng: random.Random, model: Model) -> None:
    model.masses = {link: (round(rng.uniform(0.5, 4), 2), round(rng.uniform(0.01, 0.2), 3))
                    for link in model.moving if link != "1"}  # fmt: skip


def phi_text(model: Model, *links: str) -> str:
    return f"phi = [{', '.join(repr(math.degrees(model.axis(link))) for link in links)}]"


def five_bar(rng: random.Random, kind: str) -> Model:
    """Return two geared cranks that a dyad joins."""
    o, d = 0j, complex(rng.uniform(0.8, 1.5), rng.uniform(-0.3, 0.3))
    share = rng.uniform(0.25, 0.7)
    radii = (abs(d) * share, abs(d) * (1 - share))
    if kind == "internal":
        radii = (abs(d) * (1 + share), abs(d) * share)
        radii = radii if rng.random() < 0.5 else radii[::-1]
    a, b = (
        o + 0.3 * cmath.exp(1j * rng.uniform(-3, 3)),
        d + 0.3 * cmath.exp(1j * rng.uniform(-3, 3)),
    )
    middle, across = (a + b) / 2, 1j * (b - a) / abs(b - a)
    c = middle + across * rng.choice((-1, 1)) * rng.uniform(0.7, 1.2)
    model = Model(
        {"0": {"O": o, "D": d}, "1": {"O": o, "A": a}, "2": {"A": a, "C": c},
         "3": {"C": c, "B": b}, "4": {"D": d, "B": b}},
        [("O", "1", "0"), ("D", "4", "0"), ("A", "2", "1"), ("B", "3", "4"), ("C", "2", "3")],
        wheels=[Wheels(("1", "4"), ("O", "D"), "0", kind, radii)],
        rules={"C": side("A", "B", {"A": a, "B": b}, c)},
    )  # fmt: skip
    model.lines = ["[[meshes]]", 'links = ["1", "4"]', 'centres = ["O", "D"]', f'kind = "{kind}"',
                   f"r = [{radii[0]!r}, {radii[1]!r}]", phi_text(model, "1", "4")]  # fmt: skip
    return model


def planet(rng: random.Random, kind: str) -> Model:
    """Return a crank with a planet on a fixed wheel, whose point moves a slider."""
    a = 0.4 * cmath.exp(1j * rng.uniform(-3, 3))
    share = rng.uniform(0.3, 0.6)
    radii = (
        (0.4 * (1 + share), 0.4 * share) if kind == "internal" else (0.4 * share, 0.4 * (1 - share))
    )
    b = a + rng.uniform(0.05, 0.2) * cmath.exp(1j * rng.uniform(-3, 3))
    along = cmath.exp(1j * rng.uniform(-0.6, 0.6))
    base = complex(0, rng.uniform(-0.1, 0.1))
    c = base + along * rng.uniform(1.5, 2)
    model = Model(
        {"0": {"O": 0j}, "1": {"O": 0j, "A": a}, "2": {"A": a, "B": b}, "3": {"B": b, "C": c},
         "4": {"C": c}},
        [("O", "1", "0"), ("A", "2", "1"), ("B", "3", "2"), ("C", "3", "4")],
        slides=[("4", "0", base, along)],
        wheels=[Wheels(("0", "2"), ("O", "A"), "1", kind, radii)],
        rules={"C": "right of B"},
    )  # fmt: skip
    model.lines = ["[[meshes]]", 'links = ["0", "2"]', 'centres = ["O", "A"]', f'kind = "{kind}"',
                   f"r = [{radii[0]!r}, {radii[1]!r}]", phi_text(model, "0", "2", "1")]  # fmt: skip
    return model


def coupler(rng: random.Random, _: str) -> Model:
    """Return a wheel on a rod that turns a wheel on the crank's axis, which moves a dyad."""
    d, a = complex(1, 0), 0.3 * cmath.exp(1j * rng.uniform(-3, 3))
    b = complex(rng.uniform(0.6, 1.1), rng.choice((-1, 1)) * rng.uniform(0.5, 0.8))
    share = rng.uniform(0.3, 0.7)
    radii = (0.3 * share, 0.3 * (1 - share))
    e = 0.2 * cmath.exp(1j * rng.uniform(-3, 3))
    g = complex(-1, rng.uniform(-0.3, 0.3))
    f = (e + g) / 2 + 1j * (g - e) / abs(g - e) * rng.uniform(0.4, 0.7)
    model = Model(
        {"0": {"O": 0j, "D": d, "G": g}, "1": {"O": 0j, "A": a}, "2": {"A": a, "B": b},
         "3": {"D": d, "B": b}, "4": {"O": 0j, "E": e}, "5": {"E": e, "F": f},
         "6": {"G": g, "F": f}},
        [("O", "1", "0"), ("A", "2", "1"), ("D", "3", "0"), ("B", "2", "3"), ("O", "4", "0"),
         ("E", "5", "4"), ("G", "6", "0"), ("F", "5", "6")],
        wheels=[Wheels(("2", "4"), ("A", "O"), "1", "external", radii)],
        rules={"B": side("A", "D", {"A": a, "D": d}, b), "F": side("E", "G", {"E": e, "G": g}, f)},
    )  # fmt: skip
    model.lines = ["[[meshes]]", 'links = ["2", "4"]', 'centres = ["A", "O"]',
                   f"r = [{radii[0]!r}, {radii[1]!r}]", phi_text(model, "2", "4", "1")]  # fmt: skip
    return model


def rack_rod(rng: random.Random, _: str) -> Model:
    """Return a rod with a rack that a block keeps at a wheel on the frame."""
    a, d = 0.2 * cmath.exp(1j * rng.uniform(-3, 3)), complex(rng.uniform(0.7, 1), 0)
    r = rng.uniform(0.05, 0.12) * rng.choice((-1, 1))
    tilt = math.asin(-r / abs(d - a))  # the pitch line passes the centre d at the distance r
    along = (d - a) / abs(d - a) * cmath.exp(1j * tilt)
    p = a + along * 1.6
    e = d + 0.2 * cmath.exp(1j * rng.uniform(-3, 3))
    offset = ((d - a) * along.conjugate()).imag
    model = Model(
        {"0": {"O": 0j, "D": d}, "1": {"O": 0j, "A": a}, "2": {"A": a, "P": p}, "3": {"D": d},
         "4": {"D": d, "E": e}},
        [("O", "1", "0"), ("A", "2", "1"), ("D", "3", "0"), ("D", "4", "0")],
        slides=[("3", "2", a, along)],
        wheels=[Wheels(("4", "2"), ("D", "A"), "3", "rack", (abs(offset), 0.0), slide=0,
                       offset=-offset)],
    )  # fmt: skip
    way = ((d - a) * along.conjugate()).real
    model.lines = ["[[meshes]]", 'links = ["4", "2"]', 'centres = ["D", "A"]', 'kind = "rack"',
                   f"r = [{abs(offset)!r}]", phi_text(model, "4", "3"), f"s = {way!r}"]  # fmt: skip
    return model


def driven_rack(rng: random.Random, _: str) -> Model:
    """Return a rocker with a wheel that moves a rack."""
    d, a = complex(1, 0.1), 0.25 * cmath.exp(1j * rng.uniform(-3, 3))
    b = complex(rng.uniform(0.8, 1.1), rng.uniform(0.5, 0.8))
    along, r = cmath.exp(1j * rng.uniform(-3, 3)), rng.uniform(0.1, 0.2)
    sign = rng.choice((-1, 1))
    base = d + 1j * along * r * sign
    k = base + along * rng.uniform(-0.3, 0.3)
    model = Model(
        {"0": {"O": 0j, "D": d}, "1": {"O": 0j, "A": a}, "2": {"A": a, "B": b},
         "3": {"D": d, "B": b}, "4": {"K": k}},
        [("O", "1", "0"), ("A", "2", "1"), ("D", "3", "0"), ("B", "2", "3")],
        slides=[("4", "0", base, along)],
        wheels=[Wheels(("3", "4"), ("D", "K"), "0", "rack", (r, 0.0), slide=0, offset=r * sign)],
        rules={"B": side("A", "D", {"A": a, "D": d}, b)},
    )  # fmt: skip
    way = ((k - base) * along.conjugate()).real
    model.lines = ["[[meshes]]", 'links = ["3", "4"]', 'centres = ["D", "K"]', 'kind = "rack"',
                   f"r = [{r!r}]", phi_text(model, "3"), f"s = {way!r}"]  # fmt: skip
    return model


KINDS = [
    (five_bar, "external"), (five_bar, "internal"), (planet, "external"), (planet, "internal"),
    (coupler, ""), (rack_rod, ""), (driven_rack, ""),
]  # fmt: skip
