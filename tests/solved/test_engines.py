"""Engines of several cylinders against virtual work: each diagram from its own top dead centre."""

from __future__ import annotations

import random
from dataclasses import dataclass
from math import cos, pi, radians, sin

import numpy as np
import numpy.typing as npt
import pytest
from cases import each, some
from doors import (
    Flywheel,
    ProblemError,
    Solution,
    flywheel_of,
    number,
    problem_loads as loads,
    problem_template as template,
    statics_of,
)
from worked import ROOT, path_of

Reals = npt.NDArray[np.float64]
Rows = list[tuple[float, float]]


@dataclass
class Cylinder:
    """A cylinder: pin of the crank, rod, guide; ``carrier`` is the master rod's cylinder."""

    pin: float
    rod: float
    axis: float
    offset: float
    mass: float
    area: float
    carrier: int | None = None
    reach: float = 0.0
    bent: float = 0.0


@dataclass
class Engine:
    """An engine, by numbers alone: no step of any plan."""

    crank: float
    cylinders: list[Cylinder]
    strokes: list[Rows]
    shifts: list[float]
    zero: float
    sense: float

    @property
    def cycle(self) -> float:
        return pi * len(self.strokes)

    def motion(self, index: int, turned: Reals) -> tuple[Reals, Reals]:
        """Return the place of a piston along its guide from the crank's axis, and its rate."""
        one, angle = self.cylinders[index], self.zero + self.sense * turned
        pin = self.crank * np.exp(1j * (angle + one.pin))
        rate = 1j * self.sense * pin
        if one.carrier is not None:
            master = self.cylinders[one.carrier]
            start = self.crank * np.exp(1j * (angle + master.pin))
            end = self._end(master, start)
            moved = self._rate(master, start, 1j * self.sense * start, end)
            along = end - start
            turning = (moved - 1j * self.sense * start) / along
            arm = one.reach * np.exp(1j * one.bent) * along / abs(along)
            pin, rate = start + arm, 1j * self.sense * start + turning * arm
        end, way = self._end(one, pin), np.exp(1j * one.axis)
        moved = self._rate(one, pin, rate, end)
        return (end * way.conjugate()).real, (moved * way.conjugate()).real

    def _end(self, one: Cylinder, pin: npt.NDArray[np.complex128]) -> npt.NDArray[np.complex128]:
        way = np.exp(1j * one.axis)
        seen = pin * way.conjugate()
        along = seen.real + np.sqrt(one.rod**2 - (seen.imag - one.offset) ** 2)
        return np.asarray(way * (along + 1j * one.offset), dtype=complex)

    def _rate(
        self,
        one: Cylinder,
        pin: npt.NDArray[np.complex128],
        rate: npt.NDArray[np.complex128],
        end: npt.NDArray[np.complex128],
    ) -> npt.NDArray[np.complex128]:
        way, rod = np.exp(1j * one.axis), end - pin
        size = (rod * rate.conjugate()).real / (rod * way.conjugate()).real
        return np.asarray(size * way)

    def dead(self, number: int) -> list[tuple[float, bool]]:
        """Return the dead positions of a piston in the cycle, and whether they are top ones."""
        look = np.linspace(0.0, self.cycle, 721) + 1e-3
        rates = self.motion(number, look)[1]
        found = []
        for k in np.flatnonzero(np.sign(rates[1:]) != np.sign(rates[:-1])):
            low, high, up = look[k], look[k + 1], rates[k] > 0.0
            for _ in range(60):
                middle = (low + high) / 2.0
                goes_on = (self.motion(number, np.array([middle]))[1][0] > 0.0) == up
                low, high = (middle, high) if goes_on else (low, middle)
            found.append((float(low) % self.cycle, bool(up)))
        return found

    def began(self, number: int) -> tuple[float, bool]:
        """Return where the first listed stroke of a piston begins, and whether at its top."""

        def off(at: float, angle: float) -> float:
            ahead = (at - angle) % self.cycle
            return min(ahead, self.cycle - ahead)

        if number:
            first, kind = self.began(0)
            after = first + radians(self.shifts[number])
            return min((off(at, after), at, kind) for at, top in self.dead(number) if top == kind)[
                1:
            ]
        tops, bottoms = (
            min((off(at, 0.0), at) for at, top in self.dead(number) if top is kind)
            for kind in (True, False)
        )
        below = bottoms[0] < tops[0] - radians(30.0)
        return (bottoms[1], False) if below else (tops[1], True)

    def force(self, number: int, turned: Reals) -> Reals:
        """Return the force of the gas towards the crank."""
        first, _ = self.began(number)
        places = self.motion(number, np.array([at for at, _ in self.dead(number)]))[0]
        share = (places.max() - self.motion(number, turned)[0]) / np.ptp(places)
        marks = sorted((at - first + 1e-9) % self.cycle for at, _ in self.dead(number))
        stroke = np.searchsorted(marks, (turned - first) % self.cycle, side="right") - 1
        pressures = [np.interp(share, [at for at, _ in rows], [p for _, p in rows])
                     for rows in self.strokes]  # fmt: skip
        return self.cylinders[number].area * np.choose(stroke % len(self.strokes), pressures)

    def moment(self, turned: Reals) -> Reals:
        """Return the reduced moment, positive where it resists: virtual work."""
        return np.asarray(
            sum(self.force(k, turned) * self.motion(k, turned)[1]
                for k in range(len(self.cylinders)))
        )  # fmt: skip

    def inertia(self, turned: Reals) -> Reals:
        """Return the reduced moment of inertia of the pistons."""
        pairs = enumerate(self.cylinders)
        return np.asarray(sum(one.mass * self.motion(k, turned)[1] ** 2 for k, one in pairs))


def engine(seed: int) -> tuple[Engine, str]:
    """Return a random engine of 1 to 4 cylinders and its file."""
    rng = random.Random(f"engine {seed}")
    count, kind = 1 + seed % 4, ("line", "v", "boxer", "articulated")[seed // 4 % 4]
    four = rng.random() < 0.7
    crank, way = rng.uniform(0.03, 0.08), radians(rng.uniform(0.0, 360.0))
    vee = radians(rng.choice((45.0, 60.0, 72.0, 90.0)))
    cylinders: list[Cylinder] = []
    for k in range(count):
        rod = crank * rng.uniform(3.2, 4.5)
        offset = crank * rng.choice((0.0, rng.uniform(-0.3, 0.3)))
        mass, area = rng.uniform(0.3, 2.0), 0.005
        pin, axis = 2.0 * pi * k / count, way
        if kind == "v":
            pin, axis = pi * (k // 2), way + vee * (k % 2)
        elif kind == "boxer":
            pin, axis = pi * (k % 2), way + pi * (k % 2)
        one = Cylinder(pin, rod, axis, offset, mass, area)
        if kind == "articulated" and k:
            one = Cylinder(0.0, rod, way + vee * k, offset, mass, area, 0, 0.25 * crank,
                           vee * k * 0.9)  # fmt: skip
            one.rod = cylinders[0].rod - one.reach
        cylinders.append(one)
    rows = [
        [(0.0, 18e5), (0.06, 32e5), (0.2, 14e5), (0.55, 5e5), (1.0, 1.5e5)],
        [(0.0, 0.1e5), (0.5, 0.2e5), (1.0, 1.5e5)],
        [(0.0, 0.1e5), (0.15, -0.1e5), (1.0, -0.12e5)],
        [(0.0, 18e5), (0.1, 7e5), (0.45, 1.8e5), (1.0, -0.12e5)],
    ]
    strokes = rows if four else [rows[0], rows[3]]
    sense = rng.choice((1.0, -1.0))
    made = Engine(crank, cylinders, strokes, [0.0] * count, 0.0, sense)
    first = next(at for at, top in made.dead(0) if top)
    # position 0 at the top of the first piston, before or after it, or at its bottom
    made.zero = sense * (first + rng.choice((0.0, 0.0, 0.6, -0.9, pi))) % (2.0 * pi)
    start, kind_of_first = made.began(0)
    if not kind_of_first:  # the first listed stroke leads up: that of compression
        made.strokes = [strokes[-1], *strokes[:-1]]
    for k in range(1, count):
        turns = [np.degrees((at - start) % made.cycle) for at, top in made.dead(k)
                 if top == kind_of_first]  # fmt: skip
        near = rng.choice(turns) + rng.uniform(-15.0, 15.0)
        made.shifts[k] = round(float(near % np.degrees(made.cycle)), 3)
    return made, _text(made)


def _text(made: Engine) -> str:
    frame, links, assembly, tables = ["O = [0, 0]"], [], [], []
    carried = [one for one in made.cylinders if one.carrier is None]
    pins = [f"A{k}" for k, one in enumerate(made.cylinders) if one.carrier is None]
    crank = [f'[links.1]\npoints = ["O", {", ".join(f"{p!r}" for p in pins)}]']
    for k, (pin, one) in enumerate(zip(pins, carried, strict=True)):
        crank.append(f"O{pin} = {made.crank!r}" if not k else "")
        if k:
            at, across = made.crank * cos(one.pin), made.crank * sin(one.pin)
            crank.append(f'{pin} = {{ on = "O{pins[0]}", at = {at!r}, across = {across!r} }}')
    for k, one in enumerate(made.cylinders):
        base = complex(1j * one.offset * np.exp(1j * one.axis))
        frame.append(f"G{k} = [{base.real!r}, {base.imag!r}]")
        axis = np.degrees(one.axis)
        frame.append(f'guides.g{k} = {{ through = "G{k}", angle = {float(axis)!r} }}')
        pin = f"A{k}" if one.carrier is None else f"C{k}"
        points, extra = [f'"{pin}"', f'"B{k}"'], []
        for j, other in enumerate(made.cylinders):
            if other.carrier == k:
                arm = other.reach * np.exp(1j * other.bent)
                points.append(f'"C{j}"')
                extra.append(f'C{j} = {{ on = "{pin}B{k}", at = {float(arm.real)!r}, '
                             f'across = {float(arm.imag)!r} }}')  # fmt: skip
        links.append(f"[links.{2 * k + 2}]\npoints = [{', '.join(points)}]\n{pin}B{k} = {one.rod!r}"
                     + "".join(f"\n{line}" for line in extra))  # fmt: skip
        links.append(f'[links.{2 * k + 3}]\npoints = ["B{k}"]\nslides = {{ on = "g{k}" }}')
        assembly.append(f"B{k} = {{ near = {_near(made, k)} }}")
        tables.append(f"[dynamics.links.{2 * k + 3}]\nmass = {one.mass!r}")
    for k, one in enumerate(made.cylinders):
        size = f'force = {{ like = "P0", shift = {made.shifts[k]!r} }}'
        if not k:
            rows = [[list(row) for row in rows] for rows in made.strokes]
            size = f'force = {{ law = "indicator", area = {one.area!r}, strokes = {rows!r} }}'
        angle = float(np.degrees(one.axis)) % 360.0 - 180.0
        tables.append(f'[[loads]]\nname = "P{k}"\nlink = "{2 * k + 3}"\nat = "B{k}"\n'
                      f"angle = {angle!r}\n{size}")  # fmt: skip
    crank_text = "\n".join(crank).replace("'", '"')
    zero = float(np.degrees(made.zero))
    return "\n".join([
        "[frame]", *frame, crank_text, *links,
        f'[driver]\nlink = "1"\nphi = {zero!r}\nomega = {100.0 * made.sense!r}',
        "[assembly]", *assembly, "[dynamics]\ngravity = 0", *tables,
        f'[machine]\ndelta = 0.01\nconstant = "resisting"\nphi_0 = {zero!r}\n'
        f"cycle_deg = {round(np.degrees(made.cycle))}\nJ_crank = 0.0",
    ])  # fmt: skip


def _near(made: Engine, number: int) -> list[float]:
    one = made.cylinders[number]
    along = made.motion(number, np.zeros(1))[0][0]
    place = np.exp(1j * one.axis) * (along + 1j * one.offset)
    return [float(place.real), float(place.imag)]


def compared(seed: int) -> float:
    """Return how far moments and inertia are from those of virtual work, as shares."""
    made, text = engine(seed)
    wheel = Flywheel(loads(text, name=f"engine-{seed}"))
    turned = np.random.default_rng(seed).uniform(0.0, made.cycle, 200)
    exact = made.moment(turned)
    size = float(np.abs(exact).max())
    worst = float(np.abs(wheel.moment.value(turned) - exact).max()) / size
    even = wheel.even_rotations(24)
    inside = np.array([min(abs(t - at) % pi for k in range(len(made.cylinders))
                           for at, _ in made.dead(k)) > 1e-6 for t in even])  # fmt: skip
    at_plans = [wheel.reduced(24).moment, wheel.lever(24)]
    for found in at_plans:
        worst = max(worst, float(np.abs(found - made.moment(even))[inside].max()) / size)
    mass = made.inertia(turned)
    return max(worst, float((np.abs(wheel.inertia.value(turned) - mass) / mass.max()).max()))


@each("seed", range(some(20, 4)))
def test_engines_of_one_to_four_cylinders_are_those_of_virtual_work(seed: int) -> None:
    assert compared(seed) < 1e-9


# An engine in line with its cranks opposite ------------------------------------------------------

IN_LINE = (ROOT / "tests/data/turn/two-cylinders.toml").read_text("utf-8")
TOLD = IN_LINE[IN_LINE.rindex("force.law") : IN_LINE.index("[machine]")]
"""The second diagram as the file has it: in position 0 its piston begins the compression."""
SAME = 'like = "P3"\nshift = 180\n'


def in_line(second: str) -> Solution:
    return Solution(number(loads(IN_LINE.replace(TOLD, second + "\n"), name="in-line")))


@each("second", [TOLD, SAME, 'force = { like = "P3", shift = 180 }'])
def test_a_second_cylinder_counts_from_its_own_top_dead_centre(second: str) -> None:
    solution = in_line(second)
    rows = flywheel_of(solution).rows
    assert abs(abs(rows.moment[7]) - 475.6) < 0.05
    (of_axis,) = (one.force for one in statics_of(solution).reactions if one.joint == "O")
    assert abs(abs(of_axis[11]) - 3065.0) < 0.5


def test_a_diagram_of_both_sides_is_that_of_its_top_wherever_position_0_is() -> None:
    """A compressor whose position 0 is at the bottom has the strokes in the other order."""
    text = path_of("machines/compressor").read_text("utf-8")
    rows = text[text.index("strokes = [") : text.index("[machine]")].splitlines()
    other = text.replace(rows[1], "FIRST").replace(rows[2], rows[1]).replace("FIRST", rows[2])
    for sides in ("", "sides = 2\narea_2 = 0.02\n"):
        one, two = (
            Flywheel(loads(told.replace("strokes =", f"{sides}strokes ="), name="two"))
            for told in (text, other.replace("phi_0 = 0\n", "phi_0 = 180\n"))
        )
        at = np.linspace(0.01, pi - 0.01, 100)
        assert np.allclose(one.moment.value(at + pi), two.moment.value(at), rtol=0, atol=1e-9)
        assert np.allclose(one.moment.value(at), two.moment.value(at + pi), rtol=0, atol=1e-9)
        assert np.allclose(one.reduced(12).moment[1:6], two.reduced(12).moment[7:], atol=1e-9)


FAULTS = {
    "loads[1].like: unknown load 'P_{9}'. Did you mean 'P_{3}'?": 'like = "P9"\nshift = 180',
    "loads[1].like: load P_{5} cannot refer to itself in like": 'like = "P5"\nshift = 180',
    "loads[1].like: load P_{6} uses like = P_{3}, too": SAME.replace("P3", "P6")
    + '\n[[loads]]\nname = "P6"\nlink = "5"\nat = "D"\nangle = 0\nlike = "P3"\nshift = 0',
    "loads[1].like: load P_{6} is not an indicator diagram": SAME.replace("P3", "P6")
    + '\n[[loads]]\nname = "P6"\nlink = "5"\nat = "D"\nangle = 0\nforce = 5',
    "loads[1].shift: missing": 'like = "P3"',
    "loads[1].shift: expected from 0 to less than 720 degrees, got 720": SAME.replace("180", "720"),
    "loads[1].force.shift: expected from 0 to less than 720 degrees, got -1": (
        'force = { like = "P3", shift = -1 }'
    ),
    "loads[1].force.area: not valid with like": 'force = { like = "P3", shift = 0, area = 1 }',
    "loads[1].shift: valid only with like": "shift = 180",
    "loads[1].like: the size of the load is also given": SAME + "\nforce = 3",
    "it begins one 180, 540 degrees after it. Give one of these angles": SAME.replace("180", "90"),
}


@each("message, second", FAULTS.items())
def test_a_faulty_reference_to_a_diagram_is_reported(message: str, second: str) -> None:
    with pytest.raises(ProblemError) as told:
        flywheel_of(in_line(second))
    assert message in str(told.value)


def test_the_template_shows_a_second_cylinder() -> None:
    text = template("engine")
    start = text.index("#   [links.4]")
    block = text[start : text.index("[machine]")]
    text = text.replace(block, block.replace("\n#   ", "\n").removeprefix("#   "))
    text = text.replace('points = ["O", "A"]\n', 'points = ["O", "A", "C"]\n')
    text = text.replace("OA = 0.045\n", "OA = 0.045\nOC = 0.045\nangle.AOC = 180\n")
    text = text.replace('B = "above A"\n', 'B = "above A"\nD = "above C"\n')
    made, one = (Flywheel(number(loads(t, name="engine"))) for t in (text, template("engine")))
    at = np.linspace(0.0, 4 * pi, 50)[1:-1] + 0.01
    late = np.mod(at - pi, 4 * pi)
    weights = np.abs(made.moment.value(at) - one.moment.value(at) - one.moment.value(late))
    assert float(weights.max()) < 1.0  # of links 4 and 5 alone, whose diagram is that of link 3
