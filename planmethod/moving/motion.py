"""A moving point: formulas of time, their derivatives, velocity, acceleration, curvature."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import Enum
from types import MappingProxyType
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from planmethod.construct.arithmetic import Jet
from planmethod.note.formula import Rich
from planmethod.problem.faults import is_number
from planmethod.problem.file_node import FileNode
from planmethod.problem.formula import LENGTH_LIMIT, FormulaError, FormulaKind, Operation, Parser
from planmethod.problem.model import Scales
from planmethod.problem.names import describe_lookalikes, fold, lookalikes, short
from planmethod.problem.records import KindProblem

ANGULAR = ("sin", "cos", "tg", "ctg")
"""Names of the functions of angles."""


class TimeFunction(Struct, frozen=True):
    """A function of time (формула).

    Attributes
    ----------
    text : str
        As the file has it.
    operations : tuple of Operation
        In the order in which they are carried out, operands before what joins them.
    """

    text: str
    operations: tuple[Operation, ...]

    @property
    def is_constant(self) -> bool:
        """True if it does not contain time."""
        return all(operation.kind is not FormulaKind.TIME for operation in self.operations)

    @property
    def in_degrees(self) -> TimeFunction:
        """The function on a calculator that is set to degrees."""
        told = (
            replace(one, name=f"{one.name} deg") if one.name in ANGULAR else one
            for one in self.operations
        )
        return replace(self, operations=tuple(told))


def read_formula(node: FileNode, *, constant: bool = False) -> TimeFunction:
    """Read a formula, or a number in its place.

    Parameters
    ----------
    constant : bool
        It may not contain time.
    """
    text = node.value
    if is_number(text):
        text = repr(text)
        if len(text) > LENGTH_LIMIT or text.strip("-") in ("inf", "nan"):
            node.reject("expected a finite number, got {}", short(text))
    if not isinstance(text, str):
        node.reject_value("a formula", 'For example: "3*t*exp(t/2)".')
    if len(text) > LENGTH_LIMIT:
        message = "the formula has {} characters, the limit is {}"
        node.reject(message, len(text), LENGTH_LIMIT)
    if lookalikes(text):
        node.note(describe_lookalikes(text), hint="Type formulas in the Latin layout.")
    try:
        formula = TimeFunction(text, tuple(Parser(fold(text)).parse()))
    except FormulaError as error:
        node.reject(str(error), hint=error.hint)
    if constant and not formula.is_constant:
        hint = 'For example: "pi/2".'
        node.reject("expected a number or a formula without t", hint=hint)
    return formula


class Law(Enum):
    """Form in which the motion of a point is stated (способ задания движения)."""

    COORDINATES = "coordinates"
    POLAR = "polar"
    NATURAL = "natural"
    ROLLING = "rolling"


FORMULAS: Mapping[Law, tuple[str, ...]] = {
    Law.COORDINATES: ("x", "y"),
    Law.POLAR: ("r", "phi"),
    Law.NATURAL: ("s",),
    Law.ROLLING: ("phi",),
}
"""Keys of the formulas that state a motion."""


class Wheel(Struct, frozen=True):
    """Wheel that rolls without slipping and carries the point (катящееся колесо).

    Attributes
    ----------
    radius : float, m
    r : float, m
        Distance of the point from the centre.
    angle : float, degrees
        From the x axis to the point, seen from the centre, where phi is 0.
    track : float, m
        Radius of the fixed circle about the origin that it rolls on from outside; negative: within;
        0: it rolls on the x axis. At phi = 0 the wheel is above the origin, or below it when inside
        a circle.
    arm : float, m
        Of the carrier about the origin with the wheel's centre at its end, for a planet that
        a train rotates by a law of its own (``theta``); 0: the wheel rolls.
    """

    radius: float
    r: float
    angle: float
    track: float
    arm: float = 0.0


class PointProblem(KindProblem, frozen=True, kw_only=True):
    """A moving point (движущаяся точка).

    Attributes
    ----------
    law : Law
    formulas : mapping of str to TimeFunction
        By the keys of `FORMULAS`; metres, radians, seconds.
    radius : float or None, m
        Of the circle along which a natural motion runs, counter-clockwise from (radius, 0) about
        the origin; None along the x axis.
    wheel : Wheel or None
        What carries the point; phi is then how far it has turned, counter-clockwise.
    times : tuple of float, s
    blur : tuple of float
        Relative errors of the times in float64; 0 where it represents them exactly.
    show : (float, float) or None, s
        The interval that is drawn.
    """

    law: Law
    formulas: Mapping[str, TimeFunction]
    radius: float | None
    wheel: Wheel | None
    times: tuple[float, ...]
    blur: tuple[float, ...]
    show: tuple[float, float] | None
    scales: Scales


Reals = NDArray[np.float64]

ROUNDOFF = 2.0**-53
FUNCTION_ROUNDOFF = 8 * ROUNDOFF
"""Bound of the relative error of NumPy's functions."""


class Bounded:
    """Values and how far each may be off, to first order (число с границей погрешности).

    Attributes
    ----------
    value, radius : array of float
        Shapes broadcast against each other.
    """

    __slots__ = ("radius", "value")
    __array_ufunc__ = None

    def __init__(self, value: Any, radius: Any = 0.0) -> None:
        self.value: Any = np.asarray(value, dtype=np.float64)
        self.radius: Any = np.asarray(radius, dtype=np.float64)

    def __neg__(self) -> Bounded:
        return Bounded(-self.value, self.radius)

    def __add__(self, other: Any) -> Bounded:
        other = bounded(other)
        value = self.value + other.value
        return Bounded(value, self.radius + other.radius + ROUNDOFF * np.abs(value))

    __radd__ = __add__

    def __sub__(self, other: Any) -> Bounded:
        return self + -bounded(other)

    def __rsub__(self, other: Any) -> Bounded:
        return bounded(other) + -self

    def __mul__(self, other: Any) -> Bounded:
        other = bounded(other)
        value = self.value * other.value
        spread = np.abs(self.value) * other.radius + np.abs(other.value) * self.radius
        return Bounded(value, spread + ROUNDOFF * np.abs(value))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Bounded:
        """Divide; NaN where the divisor may be zero."""
        other = bounded(other)
        by = np.where(np.abs(other.value) <= other.radius, np.nan, other.value)
        value = self.value / by
        spread = (self.radius + np.abs(value) * other.radius) / np.abs(by)
        return Bounded(value, spread + ROUNDOFF * np.abs(value))

    def __rtruediv__(self, other: Any) -> Bounded:
        quotient: Bounded = bounded(other) / self
        return quotient

    def __abs__(self) -> Bounded:
        return Bounded(np.abs(self.value), self.radius)

    def rounded_to_zero(self) -> Bounded:
        """Return the values with exact zeros where they are zero within the bound of rounding.

        A value that is infinite, or has an infinite bound, is NaN.
        """
        value = np.where(np.isfinite(self.value + self.radius), self.value, np.nan)
        nothing = np.abs(value) <= self.radius
        return Bounded(np.where(nothing, 0.0, value), np.where(nothing, 0.0, self.radius))


def bounded(value: Any) -> Bounded:
    """Return a number as it is, or given data as exact."""
    return value if isinstance(value, Bounded) else Bounded(value)


def length(x: Bounded, y: Bounded) -> Bounded:
    """Return the length of a vector; zero exactly where both components are."""
    value = np.hypot(x.value, y.value)
    size = np.where(value == 0.0, 1.0, value)
    spread = (np.abs(x.value) * x.radius + np.abs(y.value) * y.radius) / size
    return Bounded(value, spread + FUNCTION_ROUNDOFF * value)


Derivatives = tuple[Any, Any, Any, Any]
"""A function and its first three derivatives, at given values."""


def evaluate(formula: TimeFunction, times: Reals, *, blur: Reals | float = 0.0) -> Jet:
    """Return the values of a formula, its rates and the rates of those.

    Parameters
    ----------
    times : array of float, shape (n,)
    blur : array of float, shape (n,), or float
        Relative errors of the times; 0 where they are exact.

    Returns
    -------
    Jet
        Of `Bounded` parts; NaN or infinite where the formula has no value.
    """
    stack: list[tuple[Jet, bool]] = []
    with np.errstate(all="ignore"):
        for operation in formula.operations:
            match operation.kind:
                case FormulaKind.NUMBER | FormulaKind.CONSTANT:
                    is_exact = operation.kind is FormulaKind.NUMBER and operation.is_exact
                    radius = 0.0 if is_exact else ROUNDOFF * operation.value
                    stack.append((Jet(Bounded(operation.value, radius)), True))
                case FormulaKind.TIME:
                    now = Bounded(times, blur * np.abs(times))
                    stack.append((Jet(now, Bounded(1.0), Bounded(0.0)), False))
                case FormulaKind.MINUS:
                    jet, is_constant = stack.pop()
                    stack.append((-jet, is_constant))
                case FormulaKind.CALL:
                    jet, is_constant = stack.pop()
                    stack.append(({**CALLS, **DEGREES}[operation.name](jet), is_constant))
                case _:
                    (right, of_right), (left, of_left) = stack.pop(), stack.pop()
                    made = _joined(operation.kind, left, right, steady=of_right)
                    stack.append((made, of_left and of_right))
    ((jet, _),) = stack
    return Jet(*(_spread(part, times) for part in jet.parts()))


def _spread(part: Any, times: Reals) -> Bounded:
    one = bounded(part)
    shape = times.shape
    return Bounded(np.broadcast_to(one.value, shape), np.broadcast_to(one.radius, shape))


def _joined(kind: FormulaKind, left: Jet, right: Jet, *, steady: bool) -> Jet:
    if kind is FormulaKind.ADD:
        return left + right
    if kind is FormulaKind.SUBTRACT:
        return left - right
    if kind is FormulaKind.MULTIPLY:
        return left * right
    if kind is FormulaKind.DIVIDE:
        return left / right
    return _raised(left, right.value) if steady else CALLS["exp"](right * CALLS["ln"](left))


def _raised(base: Jet, power: Bounded) -> Jet:
    """Return a jet to a constant power; a negative base has whole powers only."""
    exponent = float(power.value)
    if exponent == np.rint(exponent) or not power.radius:
        power = Bounded(exponent)

    def derivatives(x: Any) -> Derivatives:
        found, factor = [], 1.0
        for k in range(4):
            found.append(factor * x ** (exponent - k) if factor else 0.0 * x)
            factor *= exponent - k
        return found[0], found[1], found[2], found[3]

    made = _composed(base, derivatives, edge=True)
    if power.radius:
        size = np.abs(bounded(base.value).value)
        slope = float(power.radius) * (np.abs(np.log(np.where(size == 0.0, 1.0, size))) + 1.0)
        for part in made.parts():
            part.radius = part.radius + slope * np.abs(part.value)
    return made


def _composed(inner: Jet, derivatives: Callable[[Any], Derivatives], *, edge: bool = False) -> Jet:
    """Return a function of a jet, by the rule of the chain; ``edge``: its domain ends at zero."""
    f, f1, f2 = (bounded(part) for part in inner.parts())
    f = f.rounded_to_zero() if edge else f
    d = derivatives(f.value)

    def part(k: int) -> Bounded:
        moved = np.where(f.radius == 0.0, 0.0, np.abs(d[k + 1]) * f.radius)
        return Bounded(d[k], moved + FUNCTION_ROUNDOFF * np.abs(d[k]))

    return Jet(part(0), part(1) * f1, part(2) * f1 * f1 + part(1) * f2)


# Functions: x are values, what comes back the function and three derivatives -------------------


def _sin(x: Any) -> Derivatives:
    s, c = np.sin(x), np.cos(x)
    return s, c, -s, -c


def _cos(x: Any) -> Derivatives:
    s, c = np.sin(x), np.cos(x)
    return c, -s, -c, s


def _sin_deg(x: Any) -> Derivatives:
    return _sin(np.radians(x))


def _cos_deg(x: Any) -> Derivatives:
    return _cos(np.radians(x))


def _exp(x: Any) -> Derivatives:
    y = np.exp(x)
    return y, y, y, y


def _ln(x: Any) -> Derivatives:
    x = np.where(x > 0.0, x, np.nan)
    return np.log(x), 1.0 / x, -1.0 / x**2, 2.0 / x**3


def _sqrt(x: Any) -> Derivatives:
    y = np.sqrt(x)
    return y, 0.5 / y, -0.25 / y**3, 0.375 / y**5


def _sh(x: Any) -> Derivatives:
    s, c = np.sinh(x), np.cosh(x)
    return s, c, s, c


def _ch(x: Any) -> Derivatives:
    s, c = np.sinh(x), np.cosh(x)
    return c, s, c, s


def _th(x: Any) -> Derivatives:
    y, w = np.tanh(x), 1.0 / np.cosh(x) ** 2
    return y, w, -2.0 * y * w, w * (6.0 * y**2 - 2.0)


def _arcsin(x: Any) -> Derivatives:
    w = 1.0 / np.sqrt((1.0 - x) * (1.0 + x))
    return np.arcsin(x), w, x * w**3, w**3 + 3.0 * x**2 * w**5


def _arccos(x: Any) -> Derivatives:
    _, one, two, three = _arcsin(x)
    return np.arccos(x), -one, -two, -three


def _arctg(x: Any) -> Derivatives:
    w = 1.0 / (1.0 + x**2)
    return np.arctan(x), w, -2.0 * x * w**2, (6.0 * x**2 - 2.0) * w**3


def _abs(jet: Jet) -> Jet:
    """Return the absolute value; where that has a corner, no rates."""
    f = bounded(jet.value)
    sign = np.where(np.abs(f.value) <= f.radius, np.nan, np.sign(f.value))
    return Jet(abs(f), jet.rate * Bounded(sign), jet.acceleration * Bounded(sign))


def _call(derivatives: Callable[[Any], Derivatives], *, edge: bool = False) -> Callable[[Jet], Jet]:
    return lambda jet: _composed(jet, derivatives, edge=edge)


CALLS: Mapping[str, Callable[[Jet], Jet]] = MappingProxyType(
    {
        "sin": _call(_sin),
        "cos": _call(_cos),
        "tg": lambda jet: _composed(jet, _sin) / _composed(jet, _cos),
        "ctg": lambda jet: _composed(jet, _cos) / _composed(jet, _sin),
        "arcsin": _call(_arcsin),
        "arccos": _call(_arccos),
        "arctg": _call(_arctg),
        "exp": _call(_exp),
        "ln": _call(_ln, edge=True),
        "lg": lambda jet: _composed(jet, _ln, edge=True) / Bounded(np.log(10.0), ROUNDOFF * 4),
        "sqrt": _call(_sqrt, edge=True),
        "sh": _call(_sh),
        "ch": _call(_ch),
        "th": _call(_th),
        "abs": _abs,
    }
)
"""Functions of jets by the names of `planmethod.problem.formula.FUNCTIONS`."""

DEGREES: Mapping[str, Callable[[Jet], Jet]] = MappingProxyType(
    {
        "sin deg": lambda jet: _composed(jet, _sin_deg),
        "cos deg": lambda jet: _composed(jet, _cos_deg),
        "tg deg": lambda jet: _composed(jet, _sin_deg) / _composed(jet, _cos_deg),
        "ctg deg": lambda jet: _composed(jet, _cos_deg) / _composed(jet, _sin_deg),
    }
)
"""Functions of a calculator set to degrees, differentiated as if of radians."""


class Undefined(Enum):
    """Why a quantity does not exist at a moment (причина)."""

    POSITION = "position undefined"
    VELOCITY = "velocity undefined"
    ACCELERATION = "acceleration undefined"
    REST = "at rest"
    STRAIGHT = "straight"


COLUMNS = (
    "t",
    "x",
    "y",
    "vx",
    "vy",
    "v",
    "ax",
    "ay",
    "a",
    "a_tangential",
    "a_normal",
    "rho",
)
POLAR = ("r", "phi", "v_r", "v_phi", "a_r", "a_phi")
"""Further columns of a motion in polar coordinates; phi in radians."""
ROLLED = ("phi", "omega", "epsilon", "xC", "yC", "xP", "yP", "omega_H", "epsilon_H")
"""Further columns of a point on a wheel: phi in radians; its centre C; the instantaneous centre of
velocities P (мгновенный центр скоростей), where it touches its track; for a centre that moves
round the origin, the rates of the arm to it."""


class PointQuantity(Struct, frozen=True):
    """Quantity of a moving point (величина): its symbol, and its unit of SI."""

    symbol: Rich
    unit: str


LEGEND = {
    "t": PointQuantity("t", "s"),
    "x": PointQuantity("x", "m"),
    "y": PointQuantity("y", "m"),
    "vx": PointQuantity("v_{x}", "m/s"),
    "vy": PointQuantity("v_{y}", "m/s"),
    "v": PointQuantity("v", "m/s"),
    "ax": PointQuantity("a_{x}", "m/s²"),
    "ay": PointQuantity("a_{y}", "m/s²"),
    "a": PointQuantity("a", "m/s²"),
    "a_tangential": PointQuantity("a^{τ}", "m/s²"),
    "a_normal": PointQuantity("a^{n}", "m/s²"),
    "rho": PointQuantity("ρ", "m"),
    "s": PointQuantity("s", "m"),
    "r": PointQuantity("r", "m"),
    "phi": PointQuantity("φ", "rad"),
    "v_r": PointQuantity("v_{r}", "m/s"),
    "v_phi": PointQuantity("v_{φ}", "m/s"),
    "a_r": PointQuantity("a_{r}", "m/s²"),
    "a_phi": PointQuantity("a_{φ}", "m/s²"),
    "omega": PointQuantity("ω", "1/s"),
    "epsilon": PointQuantity("ε", "1/s²"),
    "xC": PointQuantity("x_{C}", "m"),
    "yC": PointQuantity("y_{C}", "m"),
    "xP": PointQuantity("x_{P}", "m"),
    "yP": PointQuantity("y_{P}", "m"),
    "omega_H": PointQuantity("ω_{H}", "1/s"),
    "epsilon_H": PointQuantity("ε_{H}", "1/s²"),
    "theta": PointQuantity("θ", "rad"),
}
"""Columns of the record and of tables, and formulas of the file."""


class Motion(Struct, frozen=True, eq=False):
    """Motion of a point at all its moments (движение точки).

    Attributes
    ----------
    columns : dict of str to array of float, shape (n,)
        SI, radians; NaN where a quantity does not exist. A value that is zero within the
        bound of rounding is zero. ``a_tangential`` is positive where the point speeds up.
    reasons : tuple of (Undefined or None)
        Why something does not exist, at every moment.
    """

    columns: dict[str, Reals]
    reasons: tuple[Undefined | None, ...]

    def values_at(self, k: int) -> dict[str, float]:
        """Return the values of the columns at a moment, by its number."""
        return {name: float(column[k]) for name, column in self.columns.items()}


def move(problem: PointProblem) -> Motion:
    """Return the motion of a point at the moments of its file."""
    times = np.array(problem.times)
    with np.errstate(all="ignore"):
        x, y, others = _coordinates(problem, times)
        parts = [bounded(part).rounded_to_zero() for part in (x.value, y.value)]
        rates = [bounded(part).rounded_to_zero() for part in (x.rate, y.rate)]
        bends = [bounded(part).rounded_to_zero() for part in (x.acceleration, y.acceleration)]
        speed, size = length(*rates), length(*bends)
        (vx, vy), (ax, ay) = rates, bends
        along = ((vx * ax + vy * ay) / speed).rounded_to_zero()
        cross = abs(vx * ay - vy * ax).rounded_to_zero()
        across = cross / speed
        rho = speed / across * speed
        found = [*parts, vx, vy, speed, ax, ay, size, along, across, rho]
        columns = {"t": times, **_reals(COLUMNS[1:], found)}
        columns |= others
    return Motion(_mask_partial_vectors(columns), _reasons(columns))


LARGEST = 1e60
"""Limit above which a number of a motion is undefined: its powers must be finite, too."""


def _reals(names: tuple[str, ...], values: list[Bounded]) -> dict[str, Reals]:
    pairs = zip(names, values, strict=True)
    return {name: np.where(abs(one.value) < LARGEST, one.value, np.nan) for name, one in pairs}


_LEVELS = {
    Undefined.POSITION: (("x", "y"), ("r", "phi")),
    Undefined.VELOCITY: (("vx", "vy", "v"), ("v_r", "v_phi")),
    Undefined.ACCELERATION: (
        ("ax", "ay", "a", "a_tangential", "a_normal", "rho"),
        ("a_r", "a_phi"),
    ),
}


def _mask_partial_vectors(columns: dict[str, Reals]) -> dict[str, Reals]:
    """Make all components of a vector NaN where one is: a vector exists or does not."""
    lost = np.zeros(len(columns["t"]), dtype=bool)
    told = dict(columns)
    for own, polar in _LEVELS.values():
        lost = lost | np.isnan(columns[own[0]]) | np.isnan(columns[own[1]])
        for name in (*own, *polar):
            if name in told:
                told[name] = np.where(lost, np.nan, columns[name])
    return told


def _reasons(columns: dict[str, Reals]) -> tuple[Undefined | None, ...]:
    def is_missing(*names: str) -> Reals:
        missing: Reals = np.any([np.isnan(columns[name]) for name in names], axis=0)
        return missing

    cases = {
        Undefined.POSITION: is_missing("x", "y"),
        Undefined.VELOCITY: is_missing("vx", "vy"),
        Undefined.ACCELERATION: is_missing("ax", "ay"),
        Undefined.REST: columns["v"] == 0.0,
        Undefined.STRAIGHT: is_missing("rho"),
    }
    return tuple(
        next((why for why, is_so in cases.items() if is_so[k]), None)
        for k in range(len(columns["t"]))
    )


def _coordinates(problem: PointProblem, times: Reals) -> tuple[Jet, Jet, dict[str, Reals]]:
    """Return x and y, and the further columns of a motion that is stated otherwise."""
    read = {
        key: evaluate(formula, times, blur=np.array(problem.blur))
        for key, formula in problem.formulas.items()
    }
    match problem.law:
        case Law.COORDINATES:
            return read["x"], read["y"], {}
        case Law.POLAR:
            r, phi = read["r"], read["phi"]
            return *_to_cartesian(r, phi), _reals(POLAR, _polar(r, phi))
        case Law.NATURAL:
            s = read["s"]
            if problem.radius is None:
                zeros = Bounded(np.zeros_like(times))
                return s, Jet(zeros, zeros, zeros), {}
            turned = s / Bounded(problem.radius)
            return *_to_cartesian(Jet(_file_number(problem.radius)), turned), {}
        case Law.ROLLING:
            assert problem.wheel is not None
            return _rolled(problem.wheel, read["phi"], read.get("theta"))


def _file_number(value: float) -> Bounded:
    """Return a number of the file with the bound of its rounding to float64."""
    return Bounded(value, ROUNDOFF * abs(value))


def _to_cartesian(r: Jet, angle: Jet) -> tuple[Jet, Jet]:
    return r * CALLS["cos"](angle), r * CALLS["sin"](angle)


def _rolled(wheel: Wheel, phi: Jet, theta: Jet | None) -> tuple[Jet, Jet, dict[str, Reals]]:
    """Return x and y of a point of a wheel, and the columns `ROLLED`.

    The arc that a wheel has rolled off is as long as that of the track: with the track's radius ρ
    (negative within it) the centre has turned by φR/(R + ρ).
    """
    radius, nothing = _file_number(wheel.radius), Jet(Bounded(np.zeros_like(phi.value.value)))
    if wheel.track:
        span = radius + _file_number(wheel.track)
        start = _file_number(np.copysign(np.pi / 2, wheel.track))
        theta = phi * radius / Jet(span) + Jet(start)
        centre, touch = (
            _to_cartesian(Jet(abs(span)), theta),
            _to_cartesian(Jet(_file_number(abs(wheel.track))), theta),
        )
    elif theta is not None:
        centre = _to_cartesian(Jet(_file_number(wheel.arm)), theta)
        # v_C is across CP and ω·CP long.
        touch = (
            Jet(centre[0].value - centre[1].rate / phi.rate),
            Jet(centre[1].value + centre[0].rate / phi.rate),
        )
    else:
        centre, touch = (-phi * radius, nothing + Jet(radius)), (-phi * radius, nothing)
    arm = _to_cartesian(
        Jet(_file_number(wheel.r)), phi + Jet(_file_number(np.radians(wheel.angle)))
    )
    told = [phi.value, phi.rate, phi.acceleration, *(part.value for part in (*centre, *touch))]
    if theta is not None:
        told += [theta.rate, theta.acceleration]
    found = [bounded(part).rounded_to_zero() for part in told]
    columns = _reals(ROLLED[: len(found)], found)
    return centre[0] + arm[0], centre[1] + arm[1], columns


def _polar(r: Jet, phi: Jet) -> list[Bounded]:
    """Return the radial and transverse parts: r', r·φ', r'' − r·φ'², r·φ'' + 2·r'·φ'."""
    found = [
        r.value,
        phi.value,
        r.rate,
        r.value * phi.rate,
        r.acceleration - r.value * phi.rate * phi.rate,
        r.value * phi.acceleration + 2.0 * r.rate * phi.rate,
    ]
    return [bounded(one).rounded_to_zero() for one in found]
