"""Construction of a moving point: the drawn interval, and each moment as a program of steps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from math import degrees
from typing import Any, TypeAlias

import numpy as np
from msgspec import Struct, field
from msgspec.structs import replace
from numpy.typing import NDArray

from planmethod.construct.arithmetic import Arithmetic, Float64
from planmethod.construct.drafting import Profile, RulerArithmetic, sigmas
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.program import Builder, Program
from planmethod.construct.scale import Scale, series_near
from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.moving.motion import Law, Motion, PointProblem, Reals, Undefined, move
from planmethod.note.compared import Series, measured_series

Complexes: TypeAlias = NDArray[np.complexfloating[Any, Any]]

DENSE = 4000
"""Number of sampled moments of the interval."""

BEND = np.radians(2.0)
"""Turn of the tangent between two points of a drawn curve."""

LEAST, MOST = 300, 1500
"""Points of a drawn curve."""

GREW = 6.0
"""Maximum ratio of velocity and acceleration to their means in an automatic interval."""

MAX_EXTENT_RATIO = 4.0
"""Extent of a curve, in usual extents, beyond which it is cut: it has a pole there."""

CORNER = np.radians(40.0)
"""Turn between two chords of a drawn curve from which it has a corner there: a cusp."""

MARKS = 10
"""Parts that an interval is divided into by numbered instants."""

MAX_MARKS = 25
MAX_SHOWN_MOMENTS = 3
"""Most moments of the file that have their vectors drawn."""


class DrawnInterval(Struct, frozen=True, eq=False):
    """The drawn part of a motion (показанный участок).

    Attributes
    ----------
    interval : (float, float), s
    path : Motion
        Moments along the drawn curves.
    marks : Motion
        The numbered instants; those of the file are among them, unless they are very many.
    shown : tuple of int
        Numbers of the instants that have vectors drawn; the first of them is explained in full.
    """

    interval: tuple[float, float]
    path: Motion
    marks: Motion
    shown: tuple[int, ...]

    def curves(self, x: str, y: str) -> Iterator[Complexes]:
        """Yield the smooth parts of a curve, SI: it breaks at poles and at corners."""
        places = places_of(self.path, x, y)
        places = np.where(self._is_undrawn(x, y), np.nan, places)
        for part in np.split(places, np.flatnonzero(np.isnan(places))):
            part = part[~np.isnan(part)]
            steps = np.diff(part)
            turns = np.abs(np.angle(steps[1:] * np.conj(steps[:-1])))
            ends = [0, *(np.flatnonzero(turns > CORNER) + 1), len(part) - 1]
            for start, end in pairwise(ends):
                if end > start:
                    yield part[start : end + 1]

    def numbered(self, x: str, y: str) -> Complexes:
        """Return the numbered instants on a curve, SI; NaN where it is cut."""
        places = places_of(self.marks, x, y)
        middle, reach = self._drawn_region(x, y)
        return np.where(np.abs(places - middle) > reach, np.nan, places)

    def unbroken(self, x: str, y: str, first: int, last: int) -> bool:
        """Return whether a curve runs without a break between two numbered instants."""
        start, end = (self.marks.columns["t"][k] for k in (first, last))
        times = self.path.columns["t"]
        return not self._is_undrawn(x, y)[(start <= times) & (times <= end)].any()

    def _is_undrawn(self, x: str, y: str) -> NDArray[np.bool_]:
        """Return where along the path a curve is not drawn: undefined, or near a pole."""
        places = places_of(self.path, x, y)
        middle, reach = self._drawn_region(x, y)
        lost: NDArray[np.bool_] = ~(np.abs(places - middle) <= reach)
        return lost

    def _drawn_region(self, x: str, y: str) -> tuple[complex, float]:
        """Return the middle of a curve, and the distance from it to which it is drawn, SI."""
        places = places_of(self.path, x, y)
        there = places[~np.isnan(places)]
        if not len(there):
            return 0j, 0.0
        middle = complex(np.median(there.real), np.median(there.imag))
        return middle, MAX_EXTENT_RATIO * float(np.percentile(np.abs(there - middle), 75))


def places_of(motion: Motion, x: str, y: str) -> Complexes:
    """Return two columns of a motion as complex numbers, SI."""
    found: Complexes = motion.columns[x] + 1j * motion.columns[y]
    return found


def drawn_interval(problem: PointProblem) -> DrawnInterval:
    """Return the part of a motion that is drawn.

    The file's ``show``, or from its first to its last moment; about a single moment an interval in
    which the velocity changes by about itself, within which everything exists.

    Raises
    ------
    ProblemError
        The point is nowhere in the interval.
    """
    interval = problem.show or _interval(problem)
    dense = at(problem, np.linspace(*interval, DENSE + 1))
    if np.isnan(dense.columns["x"]).all():
        phrase = translate(
            "the point has no position from t = {:g} s to {:g} s", interval[0], interval[1]
        )
        hint = "Give an interval in which the formulas have values: show = [0, 1]."
        raise ProblemError(problem.name, [Fault("point.show", phrase, hint)])
    ways = [places_of(dense, f"{plan}x", f"{plan}y") for plan in "va"]
    turned = max(map(_total_turning, [*ways, np.diff(ways[1])]))
    count = int(np.clip(turned / BEND, LEAST, MOST))
    numbered = _marks(problem, interval)
    grid = np.linspace(*interval, count + 1)
    apart = np.min(np.abs(grid[:, None] - numbered[None, :]), axis=1, initial=np.inf)
    times = np.sort(np.concatenate([numbered, grid[apart > 0.1 * (grid[1] - grid[0])]]))
    marks = at(problem, numbered)
    return DrawnInterval(interval, at(problem, times), marks, _shown_instants(problem, marks))


def _total_turning(directions: Complexes) -> float:
    """Return the total turning of a direction, radians; a cusp or a break adds nothing."""
    directions = directions[~np.isnan(directions)]
    turns = np.abs(np.angle(directions[1:] * np.conj(directions[:-1])))
    return float(np.sum(turns[turns < CORNER]))


def at(problem: PointProblem, times: Reals) -> Motion:
    """Return the motion at other moments than the file's."""
    told = dict(zip(problem.times, problem.blur, strict=True))
    moments = tuple(float(t) for t in times)
    return move(replace(problem, times=moments, blur=tuple(told.get(t, 0.0) for t in moments)))


def _marks(problem: PointProblem, interval: tuple[float, float]) -> Reals:
    """Return the numbered instants: a row of the file's, or round ones with the file's."""
    own = np.unique([t for t in problem.times if interval[0] <= t <= interval[1]])
    if len(own) > MAX_SHOWN_MOMENTS:
        return own[:: -(-len(own) // MAX_MARKS)]
    step = series_near((interval[1] - interval[0]) / MARKS, up=True)
    slack = 1e-6 * step
    first, last = np.ceil((interval[0] - slack) / step), np.floor((interval[1] + slack) / step)
    round_ones = np.array([float(f"{k * step:.12g}") + 0.0 for k in np.arange(first, last + 1)])
    apart = [t for t in round_ones if not len(own) or np.min(np.abs(own - t)) > 0.2 * step]
    return np.sort(np.concatenate([own, apart]))


def _shown_instants(problem: PointProblem, marks: Motion) -> tuple[int, ...]:
    """Return the instants that have vectors: the file's, of a long row one in the middle of it."""
    times = marks.columns["t"]
    if len(set(problem.times)) <= MAX_SHOWN_MOMENTS:
        found = [k for t in problem.times for k in np.flatnonzero(times == t)]
        return tuple(dict.fromkeys(int(k) for k in found))
    whole = [k for k, why in enumerate(marks.reasons) if why is None]
    some = whole or [k for k, why in enumerate(marks.reasons) if why is not Undefined.POSITION]
    return (some[len(some) // 3],) if some else ()


def _interval(problem: PointProblem) -> tuple[float, float]:
    """Choose the interval that is drawn."""
    low, high = min(problem.times), max(problem.times)
    if high > low:
        return low, high
    here = {name: float(column[0]) for name, column in move(problem).columns.items()}
    v, a = here["v"], here["a"]
    reach = 1.0
    if v > 0 and a > 0:
        reach = series_near(float(np.clip(v / a, 1e-9, 1e9)), up=False, series=(1.0, 2.0, 5.0))
    if (omega := abs(here.get("omega", 0.0))) > 0:  # a wheel: about as far as it turns by a half
        reach = series_near(float(np.clip(2.5 / omega, 1e-9, 1e9)), up=False, series=(1, 2, 5))
    shortest = max(1e-6 * reach, 1e-9 * abs(low))
    while reach > shortest and not _is_mild(problem, low - reach, low + reach):
        reach = series_near(0.99 * reach, up=False, series=(1.0, 2.0, 5.0))
    reach = reach if reach > shortest else 1.0
    return float(f"{low - reach:.12g}"), float(f"{low + reach:.12g}")


def _is_mild(problem: PointProblem, start: float, end: float) -> bool:
    """Return whether everything exists in an interval, and nothing grows out of all proportion."""
    columns = at(problem, np.linspace(start, end, 401)).columns
    for name in ("v", "a"):
        values = columns[name]
        missing = int(np.isnan(values).sum())
        if missing > 2 or np.nanmax(values, initial=0.0) > GREW * np.nanmean(values):
            return False
    return True


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
    value = motion.values_at(k)
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
