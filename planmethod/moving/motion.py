"""Motion of a point from its law: velocity, acceleration, their parts, radius of curvature."""

from __future__ import annotations

from enum import Enum

import numpy as np
from msgspec import Struct

from planmethod.construct.jet import Jet
from planmethod.moving.model import Law, PointProblem, Wheel
from planmethod.moving.series import CALLS, ROUNDOFF, Bounded, Reals, bounded, evaluate, length
from planmethod.note.formula import Rich


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
