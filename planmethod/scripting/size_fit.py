"""Sizes that give a mechanism its strokes, ratios, values, points of a path (подбор размеров).

Newton's method for as many sizes as targets, Gauss's for more of them: the targets are linearised
by differences, `numpy.linalg.lstsq` gives the step, and it is shortened until the mechanism
assembles and comes closer.
"""

# no messages: for programs in Python

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Generic, Protocol, TypeVar

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.arguments import known
from planmethod.errors import ArgumentError, PlanMethodError
from planmethod.mechanism.model import FRAME
from planmethod.problem.machine_records import CycleTask
from planmethod.problem.model import Problem
from planmethod.solved.many.columns import swept_columns
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import CrankCycle

REACHED = 1e-9
"""Relative error up to which a target is reached."""

MOST_STEPS = 60
_DIFFERENCE = 1e-5  # part of a size by which it is moved to find how the targets change
_LONGEST, _SHORTEST = 0.3, 1e-3  # steps, as parts of the sizes and of the whole step
_OF_CYCLE = ("stroke", "K_v", "pressure")
_OF_TURN = ("max", "min", "mean")
_SAMPLES = 720  # positions of a turn in which a quantity is sampled
_NEARER = 24  # positions to each side, among which an extreme is sought again
_TIMES = 4  # such searches: an extreme is flat, so its value has all digits then


class Varying(Protocol):
    """A mechanism whose numbers can be changed: `planmethod.Mechanism`."""

    @property
    def problem(self) -> Problem:
        """The problem that it is."""
        ...

    def with_(self: M, numbers: Mapping[str, Any] | None = None, /, **named: Any) -> M:
        """Return it with other numbers."""
        ...


M = TypeVar("M", bound=Varying)


class FitError(PlanMethodError):
    """No sizes reach the targets of a mechanism."""


class Characteristic(Struct, frozen=True):
    """One number by which a mechanism is described: ``stroke(E)``, ``v_E(30)``.

    ``quantity`` is ``stroke``, ``K_v``, ``pressure`` (greatest pressure angle, degrees), or that of
    a position; ``of`` is the point or the link, or the position of the driver. It is ``max``,
    ``min`` or ``mean`` of a quantity over the turn of the crank; ``of`` is the quantity then.
    """

    quantity: str
    of: str

    @classmethod
    def of_name(cls, name: str) -> Characteristic:
        """Read a name.

        Raises
        ------
        ArgumentError
        """
        found = re.fullmatch(r"([^()]+)\(([^()]+)\)", name.strip())
        quantity, of = (part.strip() for part in found.groups()) if found else ("", "")
        words = (*_OF_CYCLE, *_OF_TURN)
        if not (quantity and of) or (quantity not in words and not _is_number(of)):
            raise ArgumentError(
                "{!r} is not a characteristic. Write stroke(E), K_v(E), pressure(E), max(v_E), "
                "min(x_E), mean(omega_3), or a quantity in a position, v_E(30).",
                name,
            )
        return cls(quantity, of)

    def __str__(self) -> str:
        return f"{self.quantity}({self.of})"


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def characteristics(problem: Problem, names: Iterable[str]) -> dict[str, float]:
    """Return characteristics of a mechanism by name, SI and degrees.

    Raises
    ------
    FitError
        The mechanism has no such number.
    UnknownNameError, UnknownQuantityError
        There is no such point, link or quantity.
    """
    names = list(names)
    asked = {name: Characteristic.of_name(name) for name in names}
    cycles: dict[str, CrankCycle] = {}
    found: dict[str, float] = {}
    turned = {name: one for name, one in asked.items() if one.quantity in _OF_TURN}
    found |= _of_turn(problem, turned)
    asked = {name: one for name, one in asked.items() if name not in turned}
    placed = [one for one in asked.values() if one.quantity not in _OF_CYCLE]
    positions = sorted({float(one.of) for one in placed})
    columns = swept_columns(problem, positions, {one.quantity for one in placed}) if placed else {}
    for name, one in asked.items():
        if one.quantity in _OF_CYCLE:
            if one.of not in cycles:
                cycles[one.of] = _cycle(problem, one.of)
            found[name] = _of_cycle(cycles[one.of], one)
        else:
            found[name] = float(columns[one.quantity][positions.index(float(one.of))])
            if np.isnan(found[name]):
                raise FitError("{} does not exist: the mechanism cannot be assembled.", name)
    return {name: found[name] for name in names}


def _of_turn(problem: Problem, characteristics: Mapping[str, Characteristic]) -> dict[str, float]:
    """Return extremes and means over the turn of the crank."""
    if not characteristics:
        return {}
    drive = problem.drive
    if not drive.revolves:
        raise FitError("{} does not exist: no crank turns.", next(iter(characteristics)))
    whole = 360.0 * Solution(problem).closing_turns
    grid = drive.positions[0] + np.arange(_SAMPLES) * whole / _SAMPLES
    columns = swept_columns(problem, grid, {one.of for one in characteristics.values()})
    found: dict[str, float] = {}
    for name, one in characteristics.items():
        if one.of not in columns:
            raise ArgumentError("{!r}: {} has several numbers. Name one of them: {}.",
                                name, one.of, ", ".join(columns))  # fmt: skip
        values = columns[one.of]
        if not np.isfinite(values).all():
            raise FitError("{} does not exist: the crank does not turn fully.", name)
        if one.quantity == "mean":  # exact but for rounding: the values are periodic
            found[name] = float(values.mean())
            continue
        sign = 1.0 if one.quantity == "max" else -1.0
        at, step = float(grid[np.argmax(sign * values)]), whole / _SAMPLES
        for _ in range(_TIMES):
            near = at + np.linspace(-step, step, 2 * _NEARER + 1)
            values = swept_columns(problem, near, [one.of])[one.of]
            at, step = float(near[np.argmax(sign * values)]), step / _NEARER
        found[name] = float(sign * np.max(sign * values))
    return found


def _cycle(problem: Problem, output: str) -> CrankCycle:
    guided = [slide.pin for slide in problem.slides.values() if slide.host == FRAME]
    links = [link for link in problem.mechanism.links if link != problem.drive.link]
    known("output", output, [*guided, *links])
    return CrankCycle(Solution(replace(problem, cycle=CycleTask(output=output))))


def _of_cycle(cycle: CrankCycle, one: Characteristic) -> float:
    value: float | None
    if one.quantity == "stroke":
        value, why = cycle.stroke, cycle.why_no_stroke
    elif one.quantity == "K_v":
        strokes = cycle.strokes
        value, why = None if strokes is None else strokes.K_v, cycle.why_no_ratio
    else:
        peak = cycle.pressure
        value, why = None if peak is None else peak.maximum, None
    if value is None:
        raise FitError("{} does not exist{}.", str(one), f": {why.value}" if why else "")
    return value


class SizeFit(Generic[M]):
    """Sizes that were sought, and how near they come (подобранные размеры).

    Attributes
    ----------
    numbers : dict of str to float
        The sizes, SI and degrees.
    targets, values : dict of str to float
        Required and reached values.
    error : float
        Largest difference relative to its target (to one for a target of zero).
    is_reached : bool
        The targets are met; of more targets than sizes, that no other sizes near by come closer.
    nearest : Mechanism
        With these sizes, whether they reach the targets or not.

    Examples
    --------
    >>> import planmethod
    >>> m = planmethod.Mechanism.from_file("problems/linkages/ex3.toml").with_(DE=0.5)
    >>> m.fit(["AB", "CD"], {"stroke(E)": 0.2, "K_v(E)": 1.3})
    Fit(l_AB = 0.0223802, l_CD = 0.491507: stroke(E) = 0.2, K_v(E) = 1.3)
    """

    def __init__(
        self,
        nearest: M,
        numbers: Mapping[str, float],
        targets: Mapping[str, float],
        values: Mapping[str, float],
        *,
        is_stationary: bool,
    ) -> None:
        self.nearest, self.numbers = nearest, dict(numbers)
        self.targets, self.values = dict(targets), dict(values)
        self.error = float(np.abs(_errors(targets, values)).max())
        more = len(targets) > len(numbers)
        self.is_reached = self.error <= REACHED or (more and is_stationary)

    @property
    def mechanism(self) -> M:
        """The mechanism with these sizes.

        Raises
        ------
        FitError
            They do not reach the targets.
        """
        if not self.is_reached:
            raise FitError("{}", self._summary())
        return self.nearest

    def _summary(self) -> str:
        sizes = ", ".join(f"{name} = {own:g}" for name, own in self.numbers.items())
        met = ", ".join(f"{name} = {own:g}" for name, own in self.values.items())
        if self.is_reached:
            return f"{sizes}: {met}"
        wanted = ", ".join(f"{name} = {own:g}" for name, own in self.targets.items())
        return f"No sizes were found for {wanted}; the nearest: {sizes} with {met}."

    def __repr__(self) -> str:
        return f"Fit({self._summary()})"


def _errors(targets: Mapping[str, float], values: Mapping[str, float]) -> Reals:
    return np.array([(values[name] - own) / (abs(own) or 1.0) for name, own in targets.items()])


def fit_sizes(mechanism: M, start: Mapping[str, float], targets: Mapping[str, float]) -> SizeFit[M]:
    """Return the sizes of a mechanism that meet targets, from some sizes on.

    Parameters
    ----------
    start : mapping of str to float
        The sizes by name, SI and degrees.
    targets : mapping of str to float
        By the names of `characteristics`.

    Raises
    ------
    PlanMethodError
        The mechanism does not assemble, or lacks a characteristic, with the sizes at the start.
    """
    names, x = list(start), np.array(list(start.values()))
    whole = float(np.abs(x).max()) or 1.0
    scale = np.where(np.abs(x) > 1e-9 * whole, np.abs(x), whole)

    def tried(sizes: Reals) -> dict[str, float]:
        other = mechanism.with_(dict(zip(names, sizes.tolist(), strict=True)))
        return characteristics(other.problem, targets)

    def errors(sizes: Reals) -> Reals | None:
        try:
            return _errors(targets, tried(sizes))
        except PlanMethodError:
            return None

    now, slope = _errors(targets, tried(x)), np.full(len(x), np.inf)
    for _ in range(MOST_STEPS):
        if np.abs(now).max() <= REACHED / 100:
            break
        matrix = _jacobian(errors, x, scale, now)
        slope = matrix.T @ now
        step = np.linalg.lstsq(matrix, -now, rcond=1e-9)[0]
        share = min(1.0, _LONGEST / (np.abs(step).max() or 1.0))
        closer = None
        while share > _SHORTEST and closer is None:
            found = errors(x + share * step * scale)
            if found is not None and found @ found < now @ now:
                closer = found
            else:
                share /= 2
        if closer is None:
            break
        x, now = x + share * step * scale, closer
    numbers = dict(zip(names, x.tolist(), strict=True))
    still = bool(np.abs(slope).max() <= 1e-6 * (np.abs(now).max() or 1.0))
    return SizeFit(mechanism.with_(numbers), numbers, targets, tried(x), is_stationary=still)


def _jacobian(errors: Callable[[Reals], Reals | None], x: Reals, scale: Reals, now: Reals) -> Reals:
    """Return how the errors change with each size, relative to its scale; zero where unknown."""
    matrix = np.zeros((len(now), len(x)))
    for k in range(len(x)):
        by = np.zeros(len(x))
        by[k] = _DIFFERENCE * scale[k]
        ahead, back = errors(x + by), errors(x - by)
        width = (ahead is not None) + (back is not None)
        if width:
            ahead, back = now if ahead is None else ahead, now if back is None else back
            matrix[:, k] = (ahead - back) / (width * _DIFFERENCE)
    return matrix
