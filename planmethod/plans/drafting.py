"""How far a drawn solution may be off: sigma of every result, and how results err together."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from planmethod.construct.arithmetic import Arithmetic, Number
from planmethod.construct.drafting import Counted, Propagated, Sampled
from planmethod.construct.dual import as_dual
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.program import Program
from planmethod.construct.steps import LayOff, Measure, MeasureAlong, Name, PointName, operands
from planmethod.errors import PlanMethodError
from planmethod.plans.build import measured_segments
from planmethod.plans.model import PlanKind
from planmethod.plans.solution import Complexes, Reals, Solution, plain

PLAN_OF = {
    **dict.fromkeys(("velocity", "v", "omega"), PlanKind.VELOCITY),
    **dict.fromkeys(("acceleration", "a", "epsilon", "ak", "ar"), PlanKind.ACCELERATION),
}
"""Plan that a quantity is taken from, by the beginning of its label."""

Key = TypeVar("Key", bound=str)

DRAWS = 4000
"""Random sheets where first order does not hold."""

STRAINED = 0.1
"""Sigma of a step's margin, in parts of it, from which first order is not believed."""

SHORT = 3.0
"""Sigmas that a length must have for first order to be believed."""

BLOCK = 32
"""Positions propagated in one go: their slopes by every stroke are kept for all steps."""

CENTRAL = (0.158655253931457, 0.841344746068543)
"""Quantiles of one sigma either side of the mean of a normal error."""


@dataclass(frozen=True, slots=True)
class Item:
    """A quantity that a drawing gives (величина чертежа).

    Attributes
    ----------
    label : str
        ``velocity.p-b`` (mm of the plan), ``x_B``, ``v_B``, ``a_B``, ``omega_2``, ``epsilon_2``,
        ``v_B3/2``, ``ak_B3/2``, ``ar_B3/2`` (SI).
    needs : tuple of Name
        Steps that it is taken from.
    take : callable
        The quantity from the readings of a trace; the same segment is read once.
    length : bool
        It is the length of a segment, which is never negative: near zero no error of it is normal.
    """

    label: str
    needs: tuple[Name, ...]
    take: Callable[[_Reading], Number]
    length: bool


class UnknownItemError(PlanMethodError, ValueError):
    """A covariance is asked of what a drawing does not give."""


class _Reading:
    """A trace and what is read off it: every segment once, as a person does."""

    def __init__(self, solution: Solution, trace: Trace, pencil: Arithmetic) -> None:
        self.trace, self.pencil = trace, pencil
        self._read: dict[tuple[PointName, PointName], Number] = {}
        self._computed: dict[tuple[PointName, PointName], Number] = {}
        for step in solution.construction.program.steps:
            if isinstance(step, Measure | MeasureAlong):
                self._read[step.tail, step.head] = abs(trace.value[step.out])
            elif isinstance(step, LayOff):
                self._computed[step.origin, step.out] = abs(trace.value[step.length])

    def length(self, tail: PointName, head: PointName) -> Number:
        """Return a segment as it is read on the drawing, mm."""
        if (tail, head) not in self._read:
            drawn = abs(self.trace.value[head] - self.trace.value[tail])
            self._read[tail, head] = self.pencil.read(f"{tail}-{head}", drawn)
        return self._read[tail, head]

    def known(self, tail: PointName, head: PointName) -> Number:
        """Return a segment as a person knows it: computed if it was laid off, else read, mm."""
        computed = self._computed.get((tail, head))
        return self.length(tail, head) if computed is None else computed


@dataclass(frozen=True, slots=True)
class Spread:
    """Drafting error of one quantity in every position (погрешность построения).

    Attributes
    ----------
    sigma : ndarray of shape (n,)
        One standard deviation, in the quantity's unit. Where it was drawn at random: half of the
        interval that holds the middle 68 % of the draws.
    drawn : ndarray of bool of shape (n,)
        First order does not hold there, and the sigma is that of random draws.
    """

    sigma: Reals
    drawn: npt.NDArray[np.bool_]


class Drafting:
    """Drafting errors of a solution (погрешности построения).

    Parameters
    ----------
    solution : Solution
        Drawn by the hand of its profile.
    draws, seed : int
        Of the random sheets.
    """

    def __init__(self, solution: Solution, *, draws: int = DRAWS, seed: int = 1) -> None:
        self.solution, self.profile = solution, solution.profile
        self.draws, self.seed = draws, seed
        self.items: dict[str, Item] = {item.label: item for item in _items(solution)}
        self._free = frozenset(str(plan.pole) for plan in solution.construction.plans)

    # First order -----------------------------------------------------------------------------

    @cached_property
    def _first(self) -> _First:
        count = len(self.solution.positions)
        counted = Counted(self.profile, self._free)
        self._take(counted, np.zeros(1, dtype=int))
        parts = [
            self._propagate(np.arange(start, min(start + BLOCK, count)), counted.causes)
            for start in range(0, count, BLOCK)
        ]
        return _First(
            _joined([part.values for part in parts]),
            _joined([part.slopes for part in parts]),
            _joined([part.margins for part in parts]),
            _joined([part.margin_slopes for part in parts]),
            _joined([part.points for part in parts]),
            parts[0].strokes,
        )

    def _data(self, chosen: npt.NDArray[np.intp]) -> dict[str, Number]:
        return self.solution.data(self.solution.per_mm, chosen)

    def _take(self, pencil: Any, chosen: npt.NDArray[np.intp]) -> tuple[Trace, dict[str, Number]]:
        """Draw the construction with a pencil and take every quantity off it."""
        trace = evaluate(self.solution.construction.program, self._data(chosen), pencil)
        reading = _Reading(self.solution, trace, pencil)
        with np.errstate(all="ignore"):
            return trace, {item.label: item.take(reading) for item in self.items.values()}

    def _propagate(self, chosen: npt.NDArray[np.intp], causes: int) -> _First:
        pencil = Propagated(self.profile, self._free, causes)
        trace, taken = self._take(pencil, chosen)
        count = len(chosen)

        def column(value: Number) -> Any:
            return np.broadcast_to(np.atleast_1d(as_dual(value).value), (count,))

        def slopes(value: Number) -> Any:
            slope = as_dual(value).slope
            return np.broadcast_to(0.0 if slope is None else slope, (causes, count))

        return _First(
            {label: column(value) for label, value in taken.items()},
            {label: slopes(value) for label, value in taken.items()},
            {name: column(margin) for name, margin in trace.margin.items()},
            {name: slopes(margin) for name, margin in trace.margin.items()},
            {name: slopes(trace.value[name]) for name in self._plan_points()},
            pencil.of,
        )

    def _plan_points(self) -> list[PointName]:
        ends = {
            end
            for plan in self.solution.construction.plans
            for vector in plan.vectors
            for end in (vector.tail, vector.head)
        }
        here = {PointName(point) for point in self.solution.construction.draft.points()}
        return sorted(ends | here)

    # Where first order does not hold ---------------------------------------------------------

    @cached_property
    def _strained(self) -> dict[Name, npt.NDArray[np.bool_]]:
        """Steps whose margin is not much larger than its own error, position by position."""
        first = self._first
        return {
            name: ~(_sigma(first.margin_slopes[name]) <= STRAINED * np.abs(margin))
            for name, margin in first.margins.items()
        }

    @cached_property
    def spreads(self) -> Mapping[str, Spread]:
        """Drafting error of every quantity, by its label."""
        never = np.zeros(self.solution.positions.shape, dtype=bool)
        sigmas, drawn = {}, {}
        ancestors = _ancestors(self.solution.construction.program)
        for label, item in self.items.items():
            sigma = _sigma(self._first.slopes[label])
            doubtful = ~np.isfinite(sigma)
            if item.length:
                doubtful = doubtful | ((sigma > 0) & (self._first.values[label] < SHORT * sigma))
            for step in {step for name in item.needs for step in ancestors[name]}:
                doubtful = doubtful | self._strained.get(step, never)
            sigmas[label], drawn[label] = sigma, doubtful
        for label in self.items:
            kind = PLAN_OF.get(label.split(".")[0].split("_")[0])
            if kind is not None:  # a plan without any vector is drawn by nobody
                absent = self._absent[kind]
                sigmas[label] = np.where(absent, 0.0, sigmas[label])
                drawn[label] = drawn[label] & ~absent
        for i in np.flatnonzero(np.any(list(drawn.values()), axis=0)):
            sampled = self.sample(int(i))
            for label, doubtful in drawn.items():
                if doubtful[i]:
                    low, high = _middle(sampled[label])
                    sigmas[label][i] = (high - low) / 2
        return {label: Spread(sigmas[label], drawn[label]) for label in self.items}

    @cached_property
    def _absent(self) -> dict[PlanKind, npt.NDArray[np.bool_]]:
        """Positions in which a plan has no vector."""
        solution, still = self.solution, np.zeros(self.solution.positions.shape)
        found = {}
        for plan in solution.construction.plans:
            ends = [
                (solution.complexes(solution.paper, end) for end in (v.tail, v.head))
                for v in plan.vectors
            ]
            longest = np.max([still, *(np.abs(head - tail) for tail, head in ends)], axis=0)
            found[plan.kind] = np.asarray(longest == 0)
        return found

    def sample(
        self, index: int, *, draws: int | None = None, seed: int | None = None
    ) -> dict[str, Reals]:
        """Return every quantity of one position from random sheets: arrays of shape (draws,)."""
        count = self.draws if draws is None else draws
        seed = (self.seed if seed is None else seed) * 1_000_003 + index
        pencil = Sampled(self.profile, self._free, count, seed)
        _, taken = self._take(pencil, np.array([index]))
        return {
            label: np.broadcast_to(np.asarray(value, dtype=float), (count,))
            for label, value in taken.items()
        }

    # Together --------------------------------------------------------------------------------

    def covariance(self, labels: Iterable[str], index: int = 0) -> Reals:
        """Return the covariance matrix of some quantities in one position, to first order.

        Returns
        -------
        ndarray of shape (k, k)
            In products of the quantities' units.

        Raises
        ------
        UnknownItemError
        """
        asked = list(labels)
        self._check(asked)
        rows = np.array([self._first.slopes[label][:, index] for label in asked])
        return np.asarray(rows @ rows.T, dtype=float)

    def _check(self, labels: list[str]) -> None:
        unknown = [label for label in labels if label not in self.items]
        if unknown:
            raise UnknownItemError(
                f"a drawing does not give {', '.join(unknown)}. Known: {', '.join(self.items)}."
            )

    def ellipse(self, point: PointName, index: int) -> Reals:
        """Return the covariance of a point on its plan, mm², ndarray of shape (2, 2)."""
        if point not in self._first.points:
            raise UnknownItemError(
                f"no plan has a point {point}. Known: {', '.join(sorted(self._first.points))}."
            )
        slope = self._first.points[point][:, index]
        rows = np.array([slope.real, slope.imag])
        return np.asarray(rows @ rows.T, dtype=float)

    def causes(self, label: str, index: int = 0) -> list[tuple[str, float]]:
        """Return the steps by their share of a quantity's variance, the largest first."""
        self._check([label])
        slope = self._first.slopes[label][:, index] ** 2
        shares: dict[str, float] = {}
        for step, part in zip(self._first.strokes, slope, strict=True):
            shares[step] = shares.get(step, 0.0) + float(part)
        total = sum(shares.values()) or 1.0
        ordered = sorted(shares.items(), key=lambda pair: -pair[1])
        return [(step, part / total) for step, part in ordered if part > 0]


@dataclass(frozen=True, slots=True)
class _First:
    """First order: values, their slopes by cause (m, n), and the strokes behind the causes."""

    values: dict[str, Reals]
    slopes: dict[str, Reals]
    margins: dict[Name, Reals]
    margin_slopes: dict[Name, Reals]
    points: dict[PointName, Complexes]
    strokes: list[str]


def _joined(parts: list[dict[Key, Any]]) -> dict[Key, Any]:
    """Return blocks of positions as one."""
    return {key: np.concatenate([part[key] for part in parts], -1) for key in parts[0]}


def _sigma(slopes: Reals) -> Reals:
    return np.asarray(np.sqrt((slopes**2).sum(axis=0)), dtype=float)


def _middle(values: Reals) -> tuple[float, float]:
    """Return the ends of the middle 68 % of what was drawn and could be."""
    able = values[np.isfinite(values)]
    if not able.size:
        return 0.0, float("nan")
    low, high = np.quantile(able, CENTRAL)
    return float(low), float(high)


def _ancestors(program: Program) -> dict[Name, frozenset[Name]]:
    """Return for every step the steps that it depends on, itself among them."""
    found: dict[Name, frozenset[Name]] = {}
    for step in program.steps:
        above = frozenset[Name]().union(*(found[name] for name, _ in operands(step)))
        found[step.out] = above | {step.out}
    return found


def _items(solution: Solution) -> Iterable[Item]:
    """Yield every quantity that the drawing gives."""
    construction = solution.construction
    mu = {kind: scale.per_mm for kind, scale in solution.scales.items()}
    for kind in PlanKind:
        for name, tail, head in _segment_ends(solution, kind):
            yield Item(f"{kind.value}.{name}", (tail, head), _segment(tail, head), True)
    kin = construction.kinematics
    for name, at in kin.velocity.named.items():
        place = PointName(at[1])
        origin, mu_l = construction.draft.origin, mu[PlanKind.POSITION]
        for axis, part in (("x", "real"), ("y", "imag")):
            take = _coordinate(place, mu_l, part, getattr(origin, part))
            yield Item(f"{axis}_{name}", (place,), take, False)
        for letter, motion in (("v", kin.velocity), ("a", kin.acceleration)):
            ends = (motion.pole, motion.point[at])
            yield Item(f"{letter}_{name}", ends, _length(*ends, mu[motion.kind]), True)
    for table in (kin.omega, kin.epsilon):
        word = "omega" if table is kin.omega else "epsilon"
        for link, number in table.items():
            yield Item(f"{word}_{link}", (number,), _number(number), False)
    for r in kin.relatives.values():
        assert r.a_start is not None and r.a_turned is not None and r.a_head is not None
        told = str(r.speed).removeprefix("v_")
        for letter, kind, tail, head in (
            ("v", PlanKind.VELOCITY, r.start, r.head),
            ("ak", PlanKind.ACCELERATION, r.a_start, r.a_turned),
            ("ar", PlanKind.ACCELERATION, r.a_turned, r.a_head),
        ):
            yield Item(f"{letter}_{told}", (tail, head), _length(tail, head, mu[kind]), True)


def _segment_ends(solution: Solution, kind: PlanKind) -> list[tuple[str, PointName, PointName]]:
    """Return the segments of a plan by name, as `Solution.segments` has them."""
    if kind is PlanKind.POSITION:
        pairs = measured_segments(solution.problem, solution.construction.draft)
        return [(f"{p}-{q}", PointName(p), PointName(q)) for p, q in pairs]
    plan = solution.construction.plan(kind)
    return [(f"{plain(plan, v.tail)}-{plain(plan, v.head)}", v.tail, v.head) for v in plan.vectors]


def _segment(tail: PointName, head: PointName) -> Callable[[_Reading], Number]:
    return lambda reading: reading.length(tail, head)


def _length(tail: PointName, head: PointName, mu: float) -> Callable[[_Reading], Number]:
    if tail == head:
        return lambda reading: np.zeros(1)
    return lambda reading: reading.known(tail, head) * mu


def _coordinate(
    place: PointName, mu: float, part: str, origin: float
) -> Callable[[_Reading], Number]:
    return lambda reading: getattr(reading.trace.value[place], part) * mu + origin


def _number(name: Name) -> Callable[[_Reading], Number]:
    return lambda reading: reading.trace.value[name]
