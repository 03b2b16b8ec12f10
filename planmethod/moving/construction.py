"""Construction of a moving point at one moment, as a program of steps (построение точки).

Velocity and acceleration are laid off by their components from two poles; their lengths, the
projections of the acceleration on tangent and normal, and the radius of curvature are read off.
The readings are those of every construction: exact, with a ruler, and with a pencil (sigma).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import degrees
from typing import Any

import numpy as np
from msgspec import Struct, field

from planmethod.construct.arithmetic import Arithmetic, Float64
from planmethod.construct.drafting import Profile, sigmas
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.program import Builder, Program
from planmethod.construct.ruler import RulerArithmetic
from planmethod.construct.scale import Scale
from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.moving.interval import DrawnInterval
from planmethod.moving.model import Law, PointProblem
from planmethod.moving.motion import Motion, Undefined
from planmethod.note.compared import Series, measured_series

READ = ("v", "a", "a_tangential", "a_normal", "rho")
"""Columns of the record that are read off the drawing."""

POLES = {"v": PointName("p"), "a": PointName("π")}
"""Poles of the two plans."""

FREE = frozenset(POLES.values())
"""Points of arbitrary position."""


class ConstructionVector(Struct, frozen=True):
    """Vector of a construction: rich symbol, ends, which plan it is of, and whether it is whole.

    A part is a component or a projection of the whole one.
    """

    symbol: str
    tail: PointName
    head: PointName
    plan: str
    is_resultant: bool = False


class MomentConstruction(Struct, frozen=True):
    """Construction of one moment (построение).

    Attributes
    ----------
    program, data
        The steps, and what they take as given: mm, degrees, SI.
    scales : mapping
        By ``l``, ``v``, ``a``.
    vectors : tuple of ConstructionVector
    letters : mapping
        What points and numbers are called, rich text.
    results : mapping
        By columns of `READ`: the numbers that are found.
    """

    program: Program
    data: Mapping[str, Any]
    scales: Mapping[str, Scale]
    vectors: tuple[ConstructionVector, ...]
    letters: Mapping[str, str]
    results: Mapping[str, NumberName]

    def read(self, arithmetic: Arithmetic | None = None) -> Trace:
        """Return the values of every step; default: float64."""
        return evaluate(self.program, self.data, arithmetic or Float64())

    def ruled(self, ruler: float) -> dict[str, float]:
        """Return the results as a ruler of this step, mm, gives them."""
        trace = self.read(RulerArithmetic(ruler=ruler))
        return {key: float(trace.value[name]) for key, name in self.results.items()}

    def sigma(self, profile: Profile) -> dict[str, float]:
        """Return the drafting errors of the results, one standard deviation."""
        found = sigmas(self.program, self.data, profile, FREE)
        return {key: float(found[name][0]) for key, name in self.results.items()}


class _Draft(Struct):
    """Construction in the making."""

    scales: Mapping[str, Scale]
    b: Builder = field(default_factory=Builder)
    data: dict[str, Any] = field(default_factory=dict)
    vectors: list[ConstructionVector] = field(default_factory=list)
    letters: dict[str, str] = field(default_factory=dict)

    def take_point(self, name: str, letter: str = "") -> PointName:
        self.data[name], self.letters[name] = 0j, letter or name
        return self.b.take_point(name)

    def known(self, name: str, value: float, letter: str = "") -> NumberName:
        self.data[name], self.letters[name] = float(value), letter or name
        return self.b.known(name)

    def ray(self, name: str, through: PointName, angle: float) -> LineName:
        return self.b.at_angle(through, None, self.known(name, angle))

    def lay_off_vector(
        self, plan: str, symbol: str, value: float, origin: PointName, line: LineName
    ) -> PointName:
        """Lay a vector off along a line through its tail, at its scale."""
        size = self.known(symbol, value, symbol)
        length = self.b.compute(f"{symbol}, mm", (size, 1), factor=1 / self.scales[plan].per_mm)
        self.letters[length] = symbol
        head = self.b.lay_off_length(f"{symbol}:", origin, line, length)
        self.letters[head] = symbol
        self.vectors.append(ConstructionVector(symbol, origin, head, plan))
        return head

    def chain(
        self, plan: str, base: LineName, parts: Sequence[tuple[str, float, bool]], at: PointName
    ) -> PointName:
        """Lay parts off one after another: symbol, value, whether across the base line."""
        for symbol, value, across in parts:
            draw = self.b.perpendicular if across else self.b.parallel
            at = self.lay_off_vector(plan, symbol, value, at, draw(at, base))
        return at

    def result(self, out: str, symbol: str, plan: str, length: NumberName) -> NumberName:
        self.letters[out] = symbol
        return self.b.compute(out, (length, 1), factor=self.scales[plan].per_mm)

    def close_plan(self, plan: str, head: PointName) -> NumberName:
        """Close a plan: the vector from its pole, measured."""
        pole = POLES[plan]
        self.vectors.append(ConstructionVector(plan, pole, head, plan, is_resultant=True))
        self.letters[head] = plan if plan == "v" else "a"
        length = self.b.measure(f"{pole}{plan}", pole, head)
        self.letters[length] = length
        return self.result(plan, plan, plan, length)


def construct(
    problem: PointProblem, motion: Motion, k: int, scales: Mapping[str, Scale]
) -> MomentConstruction | None:
    """Return the construction of moment ``k``; None where the velocity does not exist.

    Parameters
    ----------
    scales : mapping
        By ``l``, ``v``, ``a``.
    """
    why = motion.reasons[k]
    if why in (Undefined.POSITION, Undefined.VELOCITY):
        return None
    value = {name: float(column[k]) for name, column in motion.columns.items()}
    draft = _Draft(scales)
    b, results = draft.b, dict[str, NumberName]()
    pole = draft.take_point(POLES["v"])
    if problem.law is Law.ROLLING and not np.isnan(value["xP"]):
        head = _rolling_velocity(draft, problem, value, pole)
    else:
        angle, parts = _velocity_parts(problem, value)
        head = draft.chain("v", draft.ray("angle", pole, angle), parts, pole)
    results["v"] = draft.close_plan("v", head)
    if why is not Undefined.ACCELERATION:
        origin = draft.take_point(POLES["a"])
        at = origin
        for name, angle, parts in _acceleration_parts(problem, value):
            at = draft.chain("a", draft.ray(name, origin, angle), parts, at)
        results["a"] = draft.close_plan("a", at)
        if why is not Undefined.REST:
            tangent = b.parallel(origin, b.join(pole, head))
            foot = b.intersect_lines("n", tangent, b.perpendicular(at, tangent))
            along = b.measure_along("πn", origin, foot, tangent)
            results["a_tangential"] = draft.result("a_tangential", "a^{τ}", "a", along)
            across = b.measure("na", foot, at)
            results["a_normal"] = draft.result("a_normal", "a^{n}", "a", across)
            powers = ((results["v"], 2), (results["a_normal"], -1))
            results["rho"] = b.compute("rho", *powers)
            draft.letters |= {"rho": "ρ", "n": "n", "πn": "πn", "na": "na"}
            draft.vectors += [
                ConstructionVector(symbol, tail, tip, "a")
                for symbol, tail, tip in (("a^{τ}", origin, foot), ("a^{n}", foot, at))
                if problem.law is not Law.NATURAL
            ]
    found = tuple(draft.vectors)
    return MomentConstruction(b.program(), draft.data, scales, found, draft.letters, results)


_Parts = list[tuple[str, float, bool]]


def _velocity_parts(problem: PointProblem, value: Mapping[str, float]) -> tuple[float, _Parts]:
    """Return the angle of the base line, degrees, and the parts of the velocity."""
    match problem.law:
        case Law.POLAR:
            parts = [("v_{r}", value["v_r"], False), ("v_{φ}", value["v_phi"], True)]
            return degrees(value["phi"]), parts
        case Law.NATURAL:
            # Along the path as it runs, which is that of growing s.
            turn = _heading(problem, value)
            sign = np.sign(np.cos(turn) * value["vx"] + np.sin(turn) * value["vy"])
            return degrees(turn), [("v_{τ}", float(sign) * value["v"], False)]
        case _:
            return 0.0, [("v_{x}", value["vx"], False), ("v_{y}", value["vy"], True)]


def _heading(problem: PointProblem, value: Mapping[str, float]) -> float:
    """Return the direction of a natural path, radians."""
    if problem.radius is None:
        return 0.0
    return float(np.arctan2(value["y"], value["x"]) + np.pi / 2)


def _acceleration_parts(
    problem: PointProblem, value: Mapping[str, float]
) -> list[tuple[str, float, _Parts]]:
    """Return base lines by name and angle, degrees, and the components along and across them."""
    match problem.law:
        case Law.POLAR:
            angle, r = degrees(value["phi"]), value["r"]
            if not r:
                radial = [("a_{r}", value["a_r"], False), ("a_{φ}", value["a_phi"], True)]
                return [("angle of a", angle, radial)]
            # The ray is the moving frame: it turns, and the point slides along it.
            inward = -(value["v_phi"] ** 2) / r
            coriolis = 2 * value["v_r"] * value["v_phi"] / r
            parts = [
                ("a^{n}_{e}", inward, False),
                ("a^{τ}_{e}", value["a_phi"] - coriolis, True),
                ("a_{r}", value["a_r"] - inward, False),
                ("a_{k}", coriolis, True),
            ]
            return [("angle of a", angle, parts)]
        case Law.NATURAL:
            turn = _heading(problem, value)
            unit = np.exp(-1j * turn) * complex(value["ax"], value["ay"])
            parts = [("a^{τ}", float(unit.real), False), ("a^{n}", float(unit.imag), True)]
            return [("angle of a", degrees(turn), parts)]
        case Law.ROLLING:
            wheel = problem.wheel
            assert wheel is not None
            omega, epsilon = value["omega"], value["epsilon"]
            turn, centre = 0.0, [("a^{τ}_{C}", -wheel.radius * epsilon, False)]
            if "omega_H" in value:  # the centre goes round the origin
                turn = float(np.arctan2(value["yC"], value["xC"]) + np.pi / 2)
                span = abs(complex(value["xC"], value["yC"]))
                centre = [
                    ("a^{τ}_{C}", span * value["epsilon_H"], False),
                    ("a^{n}_{C}", span * value["omega_H"] ** 2, True),
                ]
            arm = degrees(value["phi"]) + wheel.angle
            own = [
                ("a^{n}_{MC}", -(omega**2) * wheel.r, False),
                ("a^{τ}_{MC}", epsilon * wheel.r, True),
            ]
            return [("angle of C", degrees(turn), centre), ("angle of MC", arm, own)]
        case _:
            return [
                ("angle of a", 0.0, [("a_{x}", value["ax"], False), ("a_{y}", value["ay"], True)])
            ]


def _rolling_velocity(
    draft: _Draft, problem: PointProblem, value: Mapping[str, float], pole: PointName
) -> PointName:
    """Find the velocity of a point of a rolling wheel by the instantaneous centre P.

    The wheel is drawn to scale; the velocity is ω·PM across PM, and PM is read.
    """
    wheel, b = problem.wheel, draft.b
    assert wheel is not None
    per_mm = draft.scales["l"].per_mm
    touch = draft.take_point("P")
    up = complex(value["xC"] - value["xP"], value["yC"] - value["yP"])
    sizes = (("CP", abs(up)), ("CM", wheel.r))
    lengths = [
        b.compute(f"{name}, mm", (draft.known(name, size), 1), factor=1 / per_mm)
        for name, size in sizes
    ]
    normal = draft.ray("angle of CP", touch, float(np.degrees(np.angle(up))))
    centre = b.lay_off_length("C", touch, normal, lengths[0])
    arm = draft.ray("angle of CM", centre, float(np.degrees(value["phi"])) + wheel.angle)
    point = b.lay_off_length("M", centre, arm, lengths[1])
    draft.letters |= {"C": "C", "M": "M", "PM": "PM", "CP, mm": "CP", "CM, mm": "CM"}
    reach = b.measure("PM", touch, point)
    omega = draft.known("omega", value["omega"], "ω")
    length = b.compute("v, mm", (omega, 1), (reach, 1), factor=per_mm / draft.scales["v"].per_mm)
    draft.letters[length] = "v"
    return b.lay_off_length("v:", pole, b.perpendicular(pole, b.join(touch, point)), length)


# The drawn hodograph ------------------------------------------------------------------------------


class ChordReading(Struct, frozen=True):
    """Accelerations that the drawn hodograph of the velocity gives (ускорения по годографу).

    The chord between the instants before and after replaces the tangent: their difference is the
    error of the method, shown beside that of the drawing.

    Attributes
    ----------
    at : tuple of int
        Numbers of the instants.
    series : Series
        The accelerations in these instants.
    """

    at: tuple[int, ...]
    series: Series


def read_hodograph(course: DrawnInterval, scale: Scale, profile: Profile) -> ChordReading:
    """Read accelerations off a hodograph of the velocity, by chords of neighbouring instants."""
    column = course.marks.columns
    count = len(column["t"])
    inner = [k for k in range(1, count - 1) if course.unbroken("vx", "vy", k - 1, k + 1)]
    if not inner:
        return ChordReading((), measured_series("a", "m/s²", (), (), ()))
    k, b, zeros = np.array(inner), Builder(), np.zeros(len(inner))
    data: dict[str, Any] = {"p": zeros + 0j, "angle": zeros}
    axis = b.at_angle(b.take_point("p"), None, b.known("angle"))
    ends = []
    for name, index in (("before", k - 1), ("after", k + 1)):
        data |= {f"{name} {c}": column[f"v{c}"][index] / scale.per_mm for c in "xy"}
        foot = b.lay_off_length(f"{name}:", POLES["v"], axis, b.known(f"{name} x"))
        line = b.perpendicular(foot, axis)
        ends.append(b.lay_off_length(name, foot, line, b.known(f"{name} y")))
    data["time"] = column["t"][k + 1] - column["t"][k - 1]
    chord = b.measure("chord", *ends)
    found = b.compute("a", (chord, 1), (b.known("time"), -1), factor=scale.per_mm)
    program = b.program()
    read = evaluate(program, data, RulerArithmetic(ruler=profile.ruler)).value[found]
    sigma = sigmas(program, data, profile, FREE)[found]
    return ChordReading(tuple(inner), measured_series("a", "m/s²", column["a"][k], read, sigma))
