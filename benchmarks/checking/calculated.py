"""Work without a drawing: gear trains and moving points, with a calculator (расчётные задачи)."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

from benchmarks.checking.hand import ImpossibleError, Student


def _teeth(student: Student) -> dict[str, float]:
    wheels = student.data["gears"]["wheels"]
    return {name: float(z["r"] if isinstance(z, dict) else z) for name, z in wheels.items()}


def _over(one: float, other: float) -> float:
    if abs(other) < 1e-12:
        raise ImpossibleError("a quotient by zero")
    return one / other


def _in_seconds(student: Student, key: str, speed: float) -> float:
    """Return ω of n."""
    if student.slips("n/60 for ω", key):
        return speed / 60
    if student.slips("n·9.55 for ω", key):
        return speed * 9.55
    if student.slips("n taken for ω at the end", key):
        return speed
    return student.hand.pi * speed / 30


def _stopped(student: Student, key: str, product: float, sign: float) -> float:
    """Return U_1H of a ratio with the carrier stopped, sign·product."""
    if student.slips("carrier forgotten in U", key):
        return sign * product
    if student.slips("sign of the stopped ratio", key):
        sign = -sign
    if student.slips("ratio inverted", key):
        product = _over(1, product)
    return 1 - sign * product


def _satellite(student: Student, key: str, carrier: float, sun: float, ratio: float) -> float:
    """Return n_2 by Willis: (n_2 − n_H) = −ratio·(n_1 − n_H)."""
    if student.slips("carrier forgotten in n₂", key):
        return -sun * ratio
    if student.slips("carrier added in n₂", key):
        return carrier - (sun + carrier) * ratio
    if student.slips("sign of a meshing in n₂", key):
        ratio = -ratio
    return carrier - (sun - carrier) * ratio


def planet_and_row(student: Student) -> None:
    """Calculate a planetary stage with a two-rim satellite, then a pair of wheels."""
    z, n = _teeth(student), float(student.data["gears"]["n"]["1"])
    student.say("W", 1)
    inner = z["2'"]
    if student.slips("another rim of the satellite", "U_1_H"):
        inner = z["2"] * z["2"] / z["2'"]  # z2' and z2 taken for each other
    u = student.say("U_1_H", _stopped(student, "U_1_H", z["2"] * z["3"] / (z["1"] * inner), -1))
    if student.slips("product instead of quotient for n_H", "n_H"):
        carrier = student.say("n_H", n * u)
    else:
        carrier = student.say("n_H", _over(n, u))
    rim = z["2"]
    if student.slips("another rim of the satellite", "n_2"):
        rim = z["2'"]
    student.say("n_2", _satellite(student, "n_2", carrier, n, z["1"] / rim))
    row = _over(z["5"], z["4"])
    if student.slips("ratio inverted", "U_4_5"):
        row = _over(1, row)
    sign = 1 if student.slips("sign of an external meshing", "U_4_5") else -1
    second = student.say("U_4_5", sign * row)
    if student.slips("ratios added", "U_1_5"):
        whole = student.say("U_1_5", u + second)
    else:
        whole = student.say("U_1_5", u * second)
    if student.hand.from_omega:
        speed = student.say("n_5", _over(carrier, second))
    else:
        speed = student.say("n_5", _over(n, whole))
    student.say("omega_5", _in_seconds(student, "omega_5", speed))


def two_rings(student: Student) -> None:
    """Calculate task 2.2.28: sun 1, satellite 2–2', fixed ring 3, moving ring 4."""
    z, n = _teeth(student), float(student.data["gears"]["n"]["1"])
    student.say("W", 1)
    u_sun = student.hand.calculate(_stopped(student, "U_1_4", z["3"] / z["1"], -1))
    carrier = _over(n, u_sun)
    rim, ring = z["2'"], z["4"]
    if student.slips("another rim of the satellite", "U_1_4"):
        rim = z["2"]
    back = _over(z["3"] * rim, z["2"] * ring)
    u_ring = student.hand.calculate(1 - back)
    whole = student.say("U_1_4", _over(u_sun, u_ring))
    student.say("n_H", carrier)
    student.say("n_4", _over(n, whole))
    ratio = z["1"] / z["2"]
    if student.slips("another rim of the satellite", "n_2"):
        ratio = z["1"] / z["2'"]
    student.say("n_2", _satellite(student, "n_2", student.said["n_H"].value, n, ratio))


def differential(student: Student) -> None:
    """Calculate the scheme of K10: ring 1, satellite 2 and sun 3 on carrier 4; 5 on it drives 6."""
    r, omega = _teeth(student), student.data["gears"]["omega"]
    ring, sun = float(omega["1"]), float(omega["3"])
    student.say("W", 2)
    if student.slips("sign of a given speed", "omega_4"):
        sun = -sun
    bottom = r["1"] + r["3"]
    if student.slips("another rim of the satellite", "omega_4"):
        bottom = r["1"] + r["2"]
    carrier = _over(ring * r["1"] + sun * r["3"], bottom)
    if student.slips("mean of two speeds", "omega_4"):
        carrier = (ring + sun) / 2
    carrier = student.say("omega_4", carrier)
    ratio = r["1"] / r["2"]
    if student.slips("ratio inverted", "omega_2"):
        ratio = 1 / ratio
    if student.slips("carrier forgotten in n₂", "omega_2"):
        planet = ring * ratio
    elif student.hand.from_omega:
        planet = carrier - (sun - carrier) * r["3"] / r["2"]
    else:
        planet = carrier + (ring - carrier) * ratio
    student.say("omega_2", planet)
    step = _over(r["5"], r["6"])
    if student.slips("ratio inverted", "omega_6"):
        step = 1 / step
    if student.slips("sign of an internal meshing", "omega_6"):
        step = -step
    student.say("omega_6", carrier * step)


# Moving points -------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Jet:
    """A value with its first and second derivatives by time (значение с производными)."""

    value: float
    first: float = 0.0
    second: float = 0.0

    def __add__(self, other: Jet | float) -> Jet:
        two = _jet(other)
        return Jet(self.value + two.value, self.first + two.first, self.second + two.second)

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.first, -self.second)

    def __sub__(self, other: Jet | float) -> Jet:
        return self + -_jet(other)

    def __rsub__(self, other: float) -> Jet:
        return -self + other

    def __mul__(self, other: Jet | float) -> Jet:
        two = _jet(other)
        return Jet(
            self.value * two.value,
            self.first * two.value + self.value * two.first,
            self.second * two.value + 2 * self.first * two.first + self.value * two.second,
        )

    __rmul__ = __mul__

    def __truediv__(self, other: Jet | float) -> Jet:
        return self * _jet(other).through(lambda x: 1 / x, lambda x: -1 / x**2, lambda x: 2 / x**3)

    def __rtruediv__(self, other: float) -> Jet:
        return _jet(other) / self

    def __pow__(self, power: int) -> Jet:
        return math.prod([self] * power, start=Jet(1.0))

    def through(self, *of: Callable[[float], float]) -> Jet:
        """Return a function of this, given with its two derivatives."""
        f, df, ddf = (one(self.value) for one in of)
        return Jet(f, df * self.first, ddf * self.first**2 + df * self.second)


def _jet(number: Jet | float) -> Jet:
    return number if isinstance(number, Jet) else Jet(number)


def _functions(unit: float) -> dict[str, Callable[[Jet], Jet]]:
    """Return the functions of formulas; sines of so many radians for 1.

    A student differentiates on paper by the rules for radians, and presses the keys of a
    calculator that may take degrees.
    """

    def sine(x: float) -> float:
        return math.sin(x * unit)

    def cosine(x: float) -> float:
        return math.cos(x * unit)

    def tangent(x: float) -> float:
        return math.tan(x * unit)

    return {
        "sin": lambda x: x.through(sine, cosine, lambda v: -sine(v)),
        "cos": lambda x: x.through(cosine, lambda v: -sine(v), lambda v: -cosine(v)),
        "tan": lambda x: x.through(
            tangent, lambda v: cosine(v) ** -2, lambda v: 2 * tangent(v) * cosine(v) ** -2
        ),
        "exp": lambda x: x.through(math.exp, math.exp, math.exp),
        "sinh": lambda x: x.through(math.sinh, math.cosh, math.sinh),
        "cosh": lambda x: x.through(math.cosh, math.sinh, math.cosh),
        "log": lambda x: x.through(math.log, lambda v: 1 / v, lambda v: -1 / v**2),
        "sqrt": lambda x: x.through(
            math.sqrt, lambda v: 0.5 / math.sqrt(v), lambda v: -0.25 * v**-1.5
        ),
    }


_SAFE = re.compile(r"sinh|cosh|sin|cos|tan|exp|log|sqrt|[0-9t+\-*/^(). ]")


def coordinate(text: str, t: float, *, unit: float = 1.0) -> Jet:
    """Return a coordinate of the data at a time, with its derivatives."""
    if _SAFE.sub("", text):
        raise ValueError(text)
    names = {"__builtins__": {}, **_functions(unit), "t": Jet(t, 1.0)}
    return _jet(eval(text.replace("^", "**"), names))


def moving_point(student: Student) -> None:
    """Calculate velocity, acceleration, its parts and the radius for given x(t) and y(t)."""
    told = student.data["point"]
    t, at = float(told["t"]), {}
    for axis in "xy":
        unit = 1.0
        if re.search(r"(sin|cos|tan)\(", told[axis]) and student.slips(
            "degrees for radians", f"v{axis}", f"a{axis}", everywhere=True
        ):
            unit = math.pi / 180
        at[axis] = coordinate(told[axis], t, unit=unit)
    vx, vy = (_part(student, f"v{axis}", at[axis].first) for axis in "xy")
    speed = math.hypot(vx, vy)
    if student.slips("sum of components", "v"):
        speed = abs(vx) + abs(vy)
    speed = student.say("v", speed)
    ax, ay = (_part(student, f"a{axis}", at[axis].second) for axis in "xy")
    whole = math.hypot(ax, ay)
    if student.slips("sum of components", "a"):
        whole = abs(ax) + abs(ay)
    if student.slips("one component left out", "a"):
        whole = abs(ax)
    whole = student.say("a", whole)
    tangential = _over(vx * ax + vy * ay, speed)
    if student.slips("sign inside a_τ", "a_tau"):
        tangential = _over(vx * ax - vy * ay, speed)
    if student.slips("a_τ divided by a", "a_tau"):
        tangential = _over(vx * ax + vy * ay, whole)
    tangential = student.say("a_tau", tangential)
    if student.slips("aⁿ = a − a_τ", "a_n"):
        normal = whole - abs(tangential)
    elif student.slips("aⁿ with plus under the root", "a_n"):
        normal = math.hypot(whole, tangential)
    elif student.hand.from_omega:
        normal = _over(abs(vx * ay - vy * ax), speed)
    else:
        normal = math.sqrt(max(0.0, whole**2 - tangential**2))
    normal = student.say("a_n", normal)
    if student.slips("ρ from the whole acceleration", "rho"):
        radius = _over(speed**2, whole)
    elif student.slips("ρ without the square", "rho"):
        radius = _over(speed, normal)
    else:
        radius = _over(speed**2, normal)
    student.say("rho", radius)


def _part(student: Student, key: str, value: float) -> float:
    """Write a component, which may get a wrong sign or lose a factor of the inner function."""
    if student.slips("sign of a derivative", key):
        value = -value
    if student.slips("half of a derivative's term lost", key):
        value /= 2
    return student.say(key, value)
