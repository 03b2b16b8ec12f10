"""Kinematic diagrams of the output, and any quantity of the motion over the turn."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from itertools import pairwise
from math import degrees, radians

import numpy as np
from msgspec import Struct

from planmethod.construct.arithmetic import Arithmetic, Float64, Number
from planmethod.construct.drafting import RulerArithmetic
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.program import Program
from planmethod.construct.scale import Scale, angle_scale, choose_scale, rounded
from planmethod.construct.steps import PointName
from planmethod.errors import AssemblyError
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.plans.diagrams import (
    DiagramAxes,
    DiagramBoard,
    DrawnDiagram,
    differentiate,
    integrate,
    repeated,
)
from planmethod.problem.machine_records import (
    OF_POINTS,
    OUTPUT,
    Differentiation,
    GraphQuantity,
    find_graph,
    graph_quantities,
    ratio_of,
)
from planmethod.problem.quantities import TURNINGS, QuantityKind
from planmethod.solved.errors.spread import Drafted, DrawnQuantity, Errors
from planmethod.solved.quantities import NOISE, UnknownQuantityError, solution_peak
from planmethod.solved.reading import Memoizing, Reals, memoized
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import CrankCycle, crank_cycle_of


def quantities_over(cycle: CrankCycle, labels: Iterable[str]) -> list[GraphQuantity]:
    """Return the quantities of some labels, in their order, each once.

    Raises
    ------
    UnknownQuantityError
    """
    velocity = cycle.unit.construction.kinematics.velocity
    points = [name for name, at in velocity.named.items() if velocity.point[at] != velocity.pole]
    crank = cycle.unit.problem.drive.link
    known = graph_quantities(points, _links(cycle), crank)
    found: dict[str, GraphQuantity] = {}
    for asked in labels:
        for label in usual_labels(cycle) if asked == OUTPUT else (asked,):
            one = find_graph(known, label)
            if one is None:
                from difflib import get_close_matches

                near = get_close_matches(label, known, 1)
                hint = translate("; did you mean {!r}?", near[0]) if near else "."
                usual = ", ".join(usual_labels(cycle))
                raise UnknownQuantityError(
                    "no quantity {!r} over the turn{} For example: {}.", label, hint, usual
                )
            found[one.label] = one
    return list(found.values())


def _links(cycle: CrankCycle) -> list[str]:
    return [link for link in cycle.unit.problem.mechanism.links if link != FRAME]


def usual_labels(cycle: CrankCycle) -> tuple[str, ...]:
    """Return the place of the output and its transfer functions."""
    output = cycle.output
    if output.slide is not None:
        kinds = (QuantityKind.PLACE, QuantityKind.TRANSFER, QuantityKind.TRANSFER_2)
        return tuple(kind.label(output.point, axis) for kind in kinds for axis in "xy")
    ratio = ratio_of(output.link, cycle.unit.problem.drive.link, _links(cycle))
    labels = ((QuantityKind.DIRECTION, output.link), (QuantityKind.RATIO, ratio),
              (QuantityKind.RATIO_2, output.link))  # fmt: skip
    return tuple(kind.label(of) for kind, of in labels)


def values_over(cycle: CrankCycle, quantity: GraphQuantity, positions: Reals) -> Reals:
    """Return a quantity in positions of the crank, SI; NaN where the mechanism is open.

    Angles, degrees, continue through whole turns from position to position. Rounding counts as 0.
    """
    with np.errstate(invalid="ignore"):
        made = _of_point if quantity.kind in OF_POINTS else _of_link
        values = made(cycle, quantity, positions)
        return np.where(
            np.abs(values) <= NOISE * natural_size_over(cycle, quantity.kind), 0.0, values
        )


LIKE = {
    QuantityKind.TRANSFER: (QuantityKind.VELOCITY, 1),
    QuantityKind.TRANSFER_2: (QuantityKind.ACCELERATION, 2),
    QuantityKind.RATIO: (QuantityKind.OMEGA, 1),
    QuantityKind.RATIO_2: (QuantityKind.EPSILON, 2),
}
"""Rates that transfer functions make, and the power of the rate of the driver in them."""


def natural_size_over(cycle: CrankCycle, kind: QuantityKind) -> float:
    """Return the size beside which a value of a kind is rounding, in every position."""
    if kind is QuantityKind.DIRECTION:
        return 1.0
    like, power = LIKE.get(kind, (kind, 0))
    return solution_peak(cycle.solution, like) / abs(cycle.solution.problem.drive.rate) ** power


def _of_point(cycle: CrankCycle, quantity: GraphQuantity, positions: Reals) -> Reals:
    reading, construction = cycle.read(positions), cycle.unit.construction
    kinematics, drive, kind = construction.kinematics, cycle.solution.problem.drive, quantity.kind
    at, *past = (kinematics.velocity.named[name] for name in quantity.key.names)
    if kind is QuantityKind.PLACE:
        place = reading.point(PointName(at[1])) + construction.draft.origin
        return np.asarray(place.real if quantity.axis == "x" else place.imag)
    first, second = (m.point[at] for m in (kinematics.velocity, kinematics.acceleration))
    one, two = reading.point(first), reading.point(second)
    for other in past:
        one = one - reading.point(kinematics.velocity.point[other])
        two = two - reading.point(kinematics.acceleration.point[other])
    vector = {
        QuantityKind.TRANSFER: one,
        QuantityKind.VELOCITY: one * drive.rate,
        QuantityKind.TRANSFER_2: two,
        QuantityKind.ACCELERATION: two * drive.rate**2 + one * drive.acceleration,
    }[kind]
    parts = {"x": vector.real, "y": vector.imag, "": np.abs(vector)}
    return np.asarray(parts[quantity.axis])


def _of_link(cycle: CrankCycle, quantity: GraphQuantity, positions: Reals) -> Reals:
    reading, construction = cycle.read(positions), cycle.unit.construction
    course = reading.line_vector(construction.draft.axes[quantity.of])
    there = np.isfinite(course)
    if quantity.kind is QuantityKind.DIRECTION:
        angle = np.angle(course)
        angle[there] = np.unwrap(angle[there])
        return np.degrees(angle)
    kinematics, drive = construction.kinematics, cycle.solution.problem.drive
    names = kinematics.omega.get(quantity.of), kinematics.epsilon.get(quantity.of)
    u, e = (np.zeros(len(positions)) if name is None else reading.number(name) for name in names)
    found = {
        QuantityKind.RATIO: u,
        QuantityKind.OMEGA: u * drive.rate,
        QuantityKind.RATIO_2: e,
        QuantityKind.EPSILON: e * drive.rate**2 + u * drive.acceleration,
    }[quantity.kind]
    return np.where(there, found, np.nan)


HEIGHT = 80.0
"""Intended height of the diagram of the path if the file gives no scale of lengths, mm."""

HEIGHTS = 80.0, 110.0
"""Heights that those of velocity and acceleration keep to, mm."""

POLE, FARTHEST = 36.0, 60.0
"""Pole distance where no scale sets it, and the largest one, mm."""

LOW, HIGH = 20.0, 120.0
"""Range of heights in which it is drawn in the scale of lengths, mm: as read from the scheme."""

_BETWEEN = 16.0  # mm of paper between two diagrams


def _height(values: Reals) -> float:
    """Return how high a curve is from its lowest to its highest place, zero among them."""
    return float(np.ptp(np.append(values[np.isfinite(values)], 0.0)))


def smooth(values: Reals, at: Reals) -> Reals:
    """Return the smooth curve through evenly spaced values: the cubic spline.

    Parameters
    ----------
    values : ndarray of shape (n,)
        Of a period; where some do not exist (NaN) the others have open curves, the natural ones.
    at : ndarray of shape (m,)
        Places, the values standing at 0, 1, ... n - 1.
    """
    n = len(values)
    there = np.isfinite(values)
    if not there.all():
        made = np.full(np.shape(at), np.nan)
        for run in np.split(np.arange(n), np.flatnonzero(np.diff(there.astype(int))) + 1):
            if there[run[0]] and len(run) > 1:
                inside = (at >= run[0]) & (at <= run[-1])
                # An odd curve about both ends is periodic, and has no bend there.
                ends = np.linspace(values[run[0]], values[run[-1]], len(run))
                odd = values[run] - ends
                whole = smooth(np.append(odd, -odd[-2:0:-1]), at[inside] - run[0])
                made[inside] = whole + np.interp(at[inside], run, ends)
        return made
    ring = np.eye(n)
    bends = np.linalg.solve(
        4 * ring + np.roll(ring, 1, 0) + np.roll(ring, -1, 0),
        6 * (np.roll(ring, 1, 0) - 2 * ring + np.roll(ring, -1, 0)) @ values,
    )
    k = np.floor(at).astype(int)
    t = at - k
    (y, m), (y1, m1) = ((values[i % n], bends[i % n]) for i in (k, k + 1))
    bend = ((1 - t) ** 3 - (1 - t)) * m / 6 + (t**3 - t) * m1 / 6
    return np.asarray((1 - t) * y + t * y1 + bend, dtype=float)


class Graph(Struct, frozen=True):
    """The construction of the diagrams of one way (построение диаграмм).

    Attributes
    ----------
    program : Program
    data : dict
    axes : tuple of DiagramAxes
        Of s, v and a.
    poles : tuple of PointName
        Of the diagrams of v and a.
    points : tuple of list of PointName
        n + 1 points of the path, n of v, n of a.
    at : tuple of Reals
        Their abscissae, mm.
    """

    program: Program
    data: dict[str, complex | float]
    axes: tuple[DiagramAxes, DiagramAxes, DiagramAxes]
    poles: tuple[PointName, PointName]
    points: tuple[list[PointName], list[PointName], list[PointName]]
    at: tuple[Reals, Reals, Reals]

    def ordinates(self, trace: Trace, number: int) -> Reals:
        """Return the ordinates of s, v or a (0, 1, 2), mm, as they are drawn."""
        origin = trace.value[self.axes[number].origin]
        drawn = [(trace.value[point] - origin).imag for point in self.points[number]]
        return np.array([float(np.reshape(y, -1)[0]) for y in drawn])


class Deviation(Struct, frozen=True):
    """Error relative to the exact diagram, mm: greatest and mean square (отклонение)."""

    maximum: float
    rms: float

    @classmethod
    def of(cls, drawn: Reals, exact: Reals) -> Deviation:
        """Compare ordinates with exact ones; missing ones are left out."""
        off = (drawn - exact)[np.isfinite(drawn - exact)]
        if not off.size:
            return cls(np.nan, np.nan)
        return cls(float(np.max(np.abs(off))), float(np.sqrt(np.mean(off**2))))


class Diagrams(Memoizing):
    """Diagrams of a turn.

    Parameters
    ----------
    cycle : CrankCycle
    count : int, optional
        Number of positions. Default: that of the problem.
    """

    def __init__(self, cycle: CrankCycle, count: int | None = None) -> None:
        super().__init__()
        self.cycle, self.task = cycle, cycle.task
        self.count = count or cycle.count

    # Exact ---------------------------------------------------------------------------------------

    @cached_property
    def _start(self) -> tuple[float, int]:
        """Value in position zero, and the sign of the way in which it changes from there."""
        turn = self.cycle
        zero = np.array([turn.zero])
        first, second = (float(rate[0]) for rate in turn.transfers(zero))
        way = second if abs(first) < 1e-9 * turn.fastest else turn.sense * first
        return float(turn.values(zero)[0]), -1 if way < 0 else 1

    def _at(self, fractions: Reals) -> Reals:
        """Return the driver positions after shares of the way; none at and beyond a limit."""
        inside = (self.cycle.range is None) | (fractions > 1e-9) & (fractions < 1 - 1e-9)
        return np.asarray(np.where(inside, self.cycle.at(fractions), np.nan))

    def path(self, fractions: Reals) -> Reals:
        """Return the path after shares of the way, m or radians."""
        start, sign = self._start
        return (
            sign * (self.cycle.values(self._at(fractions)) - start) / self.cycle.output.per_radian
        )

    def rates(self, fractions: Reals) -> tuple[Reals, Reals]:
        """Return both transfer functions of the path, m or 1 per radian of the crank's way."""
        one, two = self.cycle.transfers(self._at(fractions))
        _, sign = self._start
        return sign * self.cycle.sense * one, sign * two

    def speeds(self, fractions: Reals) -> tuple[Reals, Reals, Reals]:
        """Return velocity, acceleration, and its part of a crank that turns evenly, SI.

        a = s''·omega² + s'·epsilon, of which the diagrams have the first.
        """
        drive = self.cycle.solution.problem.drive
        one, two = self.rates(fractions)
        even = two * drive.rate**2
        return one * abs(drive.rate), even + one * self.cycle.sense * drive.acceleration, even

    def exact(self, fractions: Reals) -> tuple[Reals, Reals, Reals]:
        """Return the exact ordinates of s, v and a after shares of the way, mm."""
        one, two = self.rates(fractions)
        v, a = self.poles
        by = self.mu_phi * v / self.mu_s
        return self.path(fractions) / self.mu_s, one * by, two * by * self.mu_phi * a

    @cached_property
    def exact_curves(self) -> tuple[Reals, Reals, Reals]:
        """The exact ordinates of s, v and a through which the curves are drawn, mm."""
        return self.exact(self.fine)

    @cached_property
    def fractions(self) -> Reals:
        """Shares of the way of the positions, the first one again at the end.

        Of a range the last one is beyond its limit: there is none.
        """
        return (np.arange(self.count + 1) + self.cycle.first) / self.count

    @cached_property
    def middles(self) -> Reals:
        """Shares of the way of the middles of the intervals."""
        return self.fractions[:-1] + 0.5 / self.count

    @cached_property
    def fine(self) -> Reals:
        """Shares of the way that the curves are drawn through, from the first to the last."""
        return np.linspace(self.fractions[0], 1 - self.fractions[0], 360 * self.cycle.turns + 1)

    def x(self, fractions: Reals) -> Reals:
        """Return abscissae, mm from that of position 0."""
        return np.asarray(self.length * (fractions - self.fractions[0]), dtype=float)

    # Scales --------------------------------------------------------------------------------------

    @cached_property
    def _inverse(self) -> bool:
        return self.cycle.solution.problem.scales.in_mm_per_unit

    @cached_property
    def length(self) -> float:
        """Length of the axis of φ, mm: the file's, else at a round scale."""
        way = self.cycle.travel
        return self.task.length or way / angle_scale(way, mm_per_unit=self._inverse)

    @property
    def mu_phi(self) -> float:
        """Radians of the crank per mm."""
        return radians(self.cycle.travel) / self.length

    @cached_property
    def mu_s(self) -> float:
        """Scale of the path, m or radians per mm: the file's ``mu_l`` if the diagram then fits."""
        problem, output = self.cycle.solution.problem, self.cycle.output
        s, given = _height(self.path(self.fine)), problem.scales.mu_l
        asked = given is not None and not problem.scales.decided
        if given is not None and asked and output.slide is not None and LOW <= s / given <= HIGH:
            return given
        return choose_scale((s, 0.0), (HEIGHT, 1.0), mm_per_unit=self._inverse)

    @property
    def rate(self) -> float:
        """Angular velocity of the crank, 1/s, without its sense."""
        return abs(self.cycle.solution.problem.drive.rate)

    @cached_property
    def poles(self) -> tuple[float, float]:
        """Pole distances of both differentiations, mm: the file's, else from round scales."""
        pole, heights = self.task.pole, [_height(one) for one in self.rates(self.fine)]
        v = pole.v or self._pole(self.mu_s, self.rate, heights[0] * self.rate, HEIGHTS[0])
        mu_v = self._next_scale(self.mu_s, v)
        a = pole.a or self._pole(mu_v, self.rate, heights[1] * self.rate**2, HEIGHTS[1])
        return v, a

    def _pole(self, per_mm: float, rate: float, maximum: float, height: float) -> float:
        """Return the pole distance for the finest round scale of a derivative, mm.

        The derivative's height and the pole's distance are limited. ``per_mm`` is the scale of the
        differentiated diagram, ``maximum`` the height of the derivative in its unit.
        """
        if not rate or not maximum:
            return POLE
        needed = max(maximum / height, per_mm * rate / (self.mu_phi * FARTHEST))
        round_one = choose_scale((needed, 0.0), (1.0, 1.0), mm_per_unit=self._inverse)
        return per_mm * rate / (self.mu_phi * round_one)

    def _next_scale(self, per_mm: float, pole: float) -> float:
        """Return the scale of a diagram's derivative with a pole, units per mm."""
        return per_mm * self.rate / (self.mu_phi * pole)

    @property
    def mu_t(self) -> float | None:
        """Scale of time, seconds per mm; None if the crank is at rest."""
        return self.mu_phi / self.rate if self.rate else None

    @property
    def mu_v(self) -> float | None:
        """Scale of the velocity, m/s or 1/s per mm: mu_s omega / (mu_phi K)."""
        return rounded(self._next_scale(self.mu_s, self.poles[0])) if self.rate else None

    @property
    def mu_a(self) -> float | None:
        """Scale of the acceleration, m/s² or 1/s² per mm: mu_v omega / (mu_phi K)."""
        return None if self.mu_v is None else rounded(self._next_scale(self.mu_v, self.poles[1]))

    @property
    def scales(self) -> list[Scale]:
        """Scales of s, v, a and phi (degrees), those that there are."""
        turns = self.cycle.output.slide is None
        units = ("rad", "1/s", "1/s²") if turns else ("m", "m/s", "m/s²")
        found = [
            ("mu_s", self.mu_s, units[0]),
            ("mu_v", self.mu_v, units[1]),
            ("mu_a", self.mu_a, units[2]),
            ("mu_φ", rounded(degrees(self.mu_phi)), "deg"),
        ]
        return [Scale(name, mu, unit) for name, mu, unit in found if mu is not None]

    # Construction --------------------------------------------------------------------------------

    def graph(self, method: Differentiation) -> Graph:
        """Return the construction by chords, by tangents, or by chords of the drawn curve."""
        return self.compute_once(_graph, method)

    def drawn(self, method: Differentiation, arithmetic: Arithmetic | None = None) -> list[Reals]:
        """Return the ordinates of s, v and a as drawn by hand, mm; exact ones by default."""
        graph, arithmetic = self.graph(method), arithmetic or Float64()
        curve = {}
        if method is Differentiation.CURVE:  # through the points that this hand has found by chords
            _, v, _ = self.drawn(Differentiation.CHORDS, arithmetic)
            read = smooth(v, np.arange(self.count, dtype=float) - 0.5)
            curve = {f"v{k}": float(y) for k, y in enumerate(read)}
        trace = evaluate(graph.program, {**graph.data, **curve}, arithmetic)
        return [graph.ordinates(trace, number) for number in range(3)]

    @cached_property
    def curve(self) -> Reals:
        """The smooth curve through the velocities of the chords, read in the positions, mm."""
        _, v, _ = self.drawn(Differentiation.CHORDS)
        return smooth(v, np.arange(self.count, dtype=float) - 0.5)

    def integrated(self) -> Reals:
        """Return the path found from exact velocities by middle ordinates, mm; n + 1 ordinates."""
        board = DiagramBoard()
        over, axes = board.axes("v"), board.axes("s", -200j)
        at = self.x(self.fractions).tolist()
        _, v, _ = self.exact(self.middles)
        points = [
            board.plot(f"v {k}", over, x, board.known(f"v{k}", float(y)))
            for k, (x, y) in enumerate(zip(self.x(self.middles), v, strict=True))
        ]
        pole = board.pole(over, self.poles[0])
        made = integrate(board, DrawnDiagram(over, points), axes, at, pole=pole)
        trace = evaluate(board.b.program(), dict(board.data), Float64())
        return np.array([float(trace.value[point].imag) + 200.0 for point in made])

    # Plans ---------------------------------------------------------------------------------------

    @cached_property
    def plans(self) -> tuple[Deviation, Deviation] | None:
        """Errors of velocities and accelerations read from the plans, mm of the diagrams.

        None if there are no plans in some position, or the crank is at rest.
        """
        turn = self.cycle
        solution = turn.solution.with_positions(turn.at(self.fractions[:-1]).tolist()).filling(None)
        if self.mu_v is None or self.mu_a is None:
            return None
        exact = turn.output.rates(solution, solution.read(Float64()))
        of, kinds = turn.output.link, TURNINGS
        if turn.output.slide is not None:
            of, kinds = turn.output.point, (QuantityKind.VELOCITY, QuantityKind.ACCELERATION)
        try:
            read = [np.abs(solution.read_off(kind.label(of))) for kind in kinds]
        except AssemblyError:
            return None
        v, a = (np.abs(one) for one in exact)
        return Deviation.of(read[0] / self.mu_v, v / self.mu_v), Deviation.of(
            read[1] / self.mu_a, a / self.mu_a
        )


def _graph(diagrams: Diagrams, method: Differentiation) -> Graph:
    board = DiagramBoard()
    exact = diagrams.exact_curves
    lows, highs = ([float(f(one)) for one in exact] for f in (np.nanmin, np.nanmax))
    down = [0.0]
    for low, high in zip(lows, highs[1:], strict=False):
        down.append(down[-1] + min(low, 0.0) - max(high, 0.0) - _BETWEEN)
    s, v, a = (board.axes(name, 1j * y) for name, y in zip("sva", down, strict=True))
    ends, middles = diagrams.x(diagrams.fractions), diagrams.x(diagrams.middles)
    path = _plot_path(board, s, ends, diagrams.exact(diagrams.fractions)[0])
    first, second = diagrams.poles
    poles = board.pole(v, first), board.pole(a, second)
    end = board.abscissa(v, float(ends[-1]))
    if method is Differentiation.TANGENTS:
        back = repeated(board, "s -1", path[-2], path[-1], path[0])
        pairs = list(zip([back, *path[:-2]], path[1:], strict=True))
        speed = differentiate(board, pairs, v, ends[:-1].tolist(), pole=poles[0])
        last = repeated(board, "v -1", speed[-1], end, v.origin)
        ahead = repeated(board, "v +1", speed[0], v.origin, end)
        pairs = list(zip([last, *speed[:-1]], [*speed[1:], ahead], strict=True))
        at = ends[:-1], ends[:-1]
    else:
        speed = differentiate(board, list(pairwise(path)), v, middles.tolist(), pole=poles[0])
        at = middles, ends[:-1]
        if method is Differentiation.CURVE:
            at = ends[:-1], middles
            speed = [
                board.plot(f"v curve {k}", v, float(x), board.known(f"v{k}", float(y)))
                for k, (x, y) in enumerate(zip(ends, diagrams.curve, strict=False))
            ]
            ahead = repeated(board, "v +1", speed[0], v.origin, end)
            pairs = list(zip(speed, [*speed[1:], ahead], strict=True))
        else:
            last = repeated(board, "v -1", speed[-1], end, v.origin)
            pairs = list(zip([last, *speed[:-1]], speed, strict=True))
    bend = differentiate(board, pairs, a, at[1].tolist(), pole=poles[1])
    return Graph(board.b.program(), board.data, (s, v, a), poles, (path, speed, bend), (ends, *at))


def _plot_path(board: DiagramBoard, axes: DiagramAxes, at: Reals, path: Reals) -> list[PointName]:
    """Plot a path read on the scheme: the distance of the output from its position zero."""
    up = board.known("90", 90.0)
    places = [board.take_point(f"scheme {k}", complex(-100.0, y)) for k, y in enumerate(path)]
    zero = board.take_point("scheme zero", -100.0 + 0j) if path[0] else places[0]
    along = board.b.at_angle(zero, None, up)
    return [
        board.plot(f"s {k}", axes, float(x), board.b.measure_along(f"|s {k}|", zero, place, along))
        for k, (x, place) in enumerate(zip(at, places, strict=True))
    ]


def deviations(
    diagrams: Diagrams, methods: Sequence[Differentiation], arithmetic: Arithmetic | None = None
) -> dict[tuple[Differentiation, str], Deviation]:
    """Return the errors of v and a by some methods, drawn by hand, or exactly."""
    found = {}
    for way in methods:
        graph, drawn = diagrams.graph(way), diagrams.drawn(way, arithmetic)
        for number, letter in ((1, "v"), (2, "a")):
            at = graph.at[number] / diagrams.length + diagrams.fractions[0]
            exact = diagrams.exact(at)[number]
            found[way, letter] = Deviation.of(drawn[number], exact)
    return found


@memoized
def deviations_by_hand(
    diagrams: Diagrams, methods: tuple[Differentiation, ...]
) -> tuple[dict[tuple[Differentiation, str], Deviation], ...]:
    """Return the errors of v and a by some methods: drawn exactly, and read with the ruler."""
    hand = RulerArithmetic(ruler=diagrams.cycle.solution.profile.ruler)
    return deviations(diagrams, methods), deviations(diagrams, methods, hand)


@memoized
def sigmas(diagrams: Diagrams, method: Differentiation) -> tuple[Reals, Reals]:
    """Return one sigma of the drafting error of every ordinate of v and a, mm, ndarrays (n,).

    The path is read on the scheme and laid off; rays, step lines and uprights are drawn. The smooth
    curve of `Differentiation.CURVE` is taken as exact.
    """
    graph = diagrams.graph(method)
    items = [
        DrawnQuantity(f"{axes.name} {k}", (point, axes.origin), _ordinate(point, axes.origin))
        for axes, points in zip(graph.axes[1:], graph.points[1:], strict=True)
        for k, point in enumerate(points)
    ]
    drawing = Drafted(
        graph.program,
        lambda chosen: dict(graph.data),
        1,
        diagrams.cycle.solution.profile,
        frozenset(str(axes.origin) for axes in graph.axes),
        tuple(items),
    )
    spreads = Errors(drawing).spreads
    v, a = (
        np.array([float(spreads[f"{axes.name} {k}"].sigma[0]) for k in range(len(points))])
        for axes, points in zip(graph.axes[1:], graph.points[1:], strict=True)
    )
    return v, a


def _ordinate(point: PointName, origin: PointName) -> Callable[[Trace], Number]:
    return lambda trace: (trace.value[point] - trace.value[origin]).imag


def diagrams_of(solution: Solution) -> Diagrams:
    """Return the diagrams of a mechanism; cached independently of the scales of its plans."""
    return _diagrams(solution.origin)


@memoized
def _diagrams(solution: Solution) -> Diagrams:
    return Diagrams(crank_cycle_of(solution))
