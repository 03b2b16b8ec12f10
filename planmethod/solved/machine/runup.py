"""Run-up by a motor, the steady motion that it keeps, and the stop (разбег, останов).

With z = omega²/2 and the angle turned as the argument the equation of motion is dz/dphi =
(M_motor(omega) - M - z·dJ/dphi)/(J_f + J), dt/dphi = 1/omega. Dormand and Prince's steps of order 5
with their own error of order 4 are taken in cells of the cycle that end where a moment jumps; M, J
and dJ/dphi of the cells are read once, and a cell with too large an error is halved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from itertools import pairwise
from math import inf, pi, sqrt
from typing import TypeAlias

import numpy as np
from msgspec import Struct

from planmethod.construct.curves import hermite, joined, roots_between, turning_points
from planmethod.solved.machine.flywheel import Flywheel
from planmethod.solved.reading import Memoizing, Reals, memoized

STEADY_SPEED_TOLERANCE = 0.01
"""A run-up is over where the speed differs so much, as a share, from the steady motion's there."""

MAX_CYCLES = 600
"""Cycles after which a run-up that is not steady, or a crank that does not stop, is given up."""

_CELL = 2.0 * pi / 240.0  # rad
_TOLERANCE = 1e-10
_HALVINGS = 44
_SLOW = 1e-9  # rad: the rotation of a crank after the first step from rest

_NODES = (0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0)
_STAGES = (
    (1 / 5,),
    (3 / 40, 9 / 40),
    (44 / 45, -56 / 15, 32 / 9),
    (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
    (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
    (35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84),
)
_ERROR = (71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40)

Pull: TypeAlias = Callable[[float], float]
_Values: TypeAlias = list[list[float]]


class StalledError(Exception):
    """The crank is at rest; with the angle turned until then and the time, rad and s."""

    def __init__(self, rotation: float, time: float) -> None:
        super().__init__()
        self.rotation, self.time = rotation, time


class TimeMotion(Struct, frozen=True):
    """Motion by steps: ndarrays of shape (n,), rad, z in 1/s², s, and dz/dphi on both sides."""

    rotation: Reals
    half: Reals
    time: Reals
    after: Reals
    before: Reals

    @property
    def omega(self) -> Reals:
        """The speeds, 1/s, ndarray of shape (n,)."""
        return np.sqrt(2.0 * self.half)

    def at(self, rotation: Reals) -> tuple[Reals, Reals]:
        """Return the speed and the time at angles turned, ndarrays of their shape."""
        k = np.clip(
            np.searchsorted(self.rotation, rotation, side="right") - 1, 0, len(self.half) - 2
        )
        step = self.rotation[k + 1] - self.rotation[k]
        share = (rotation - self.rotation[k]) / step
        slopes = step * self.after[k], step * self.before[k + 1]
        half = hermite(self.half[k], self.half[k + 1], *slopes, share)
        spent = self.time[k + 1] - self.time[k]  # the limit keeps it rising at rest
        with np.errstate(divide="ignore"):
            one, two = (np.minimum(step / self.omega[j], 3.0 * spent) for j in (k, k + 1))
        time = hermite(self.time[k], self.time[k + 1], one, two, share)
        return np.sqrt(2.0 * np.maximum(half, 0.0)), np.asarray(time, dtype=float)

    def rotation_at(self, time: Reals) -> Reals:
        """Return the angles turned at times, ndarray of shape (n,)."""
        ends = (np.full(len(time), self.rotation[k]) for k in (0, -1))
        return roots_between(lambda at: self.at(at)[1] - time[:, np.newaxis], *ends)

    def rows(self, count: int) -> tuple[Reals, Reals, Reals]:
        """Return time, angle turned and speed at equally spaced times, with the ends."""
        time = np.linspace(0.0, self.time[-1], count)
        turned = np.append(self.rotation_at(time[:-1]), self.rotation[-1])
        omega = self.at(turned)[0]
        if self.rotation[0] == _SLOW:  # from rest
            turned[0] = omega[0] = 0.0
        omega[omega < 1e-9 * float(np.max(omega))] = 0.0
        return time, turned, omega

    @property
    def extremes(self) -> tuple[float, float]:
        """The greatest and the least speed."""
        found = [float(self.half[0])]
        for k, step in enumerate(np.diff(self.rotation).tolist()):
            ends = float(self.half[k]), float(self.half[k + 1])
            slopes = step * float(self.after[k]), step * float(self.before[k + 1])
            found += [hermite(*ends, *slopes, x) for x in turning_points(*ends, *slopes)]
        return sqrt(2.0 * max(found)), sqrt(2.0 * min(found))


class RunUp(Memoizing):
    """Run-up, steady motion and stop of a machine with its flywheel.

    Parameters
    ----------
    flywheel : Flywheel
    """

    def __init__(self, flywheel: Flywheel) -> None:
        super().__init__()
        self.flywheel, self.machine = flywheel, flywheel.machine
        self.curves = joined([flywheel.moment, flywheel.inertia, flywheel.slope])
        edges = self.curves.edges
        cuts = [
            np.linspace(low, high, max(round((high - low) / _CELL), 1) + 1)[:-1]
            for low, high in pairwise(edges.tolist())
        ]
        ends = np.append(np.concatenate(cuts), edges[-1])
        values = self._read(ends[:-1, np.newaxis], ends[1:, np.newaxis])
        grouped = [values[k : k + len(_NODES)] for k in range(0, len(values), len(_NODES))]
        self._cells = list(zip(ends[:-1].tolist(), ends[1:].tolist(), grouped, strict=True))
        self.size = flywheel.middle_speed**2 / 2.0

    def _read(self, low: float | Reals, high: float | Reals) -> _Values:
        """Return M, J and its slope at the nodes of cells, a hair inside of them."""
        inside = np.clip(_NODES, 1e-12, 1.0 - 1e-12)
        return self.curves(np.ravel(low + (high - low) * inside)).tolist()  # type: ignore[no-any-return]

    # The equation of motion ------------------------------------------------------------------

    def _steps(
        self, z: float, pull: Pull, inertia: float, start: float = 0.0, time: float = 0.0
    ) -> Iterator[tuple[float, float, float, float, float]]:
        """Yield after every step the angle, z, the time, and dz/dphi before and after it.

        Raises
        ------
        StalledError
            The crank comes to rest.
        """
        first = True
        turns, cycle = 0, self.flywheel.cycle
        while True:
            for low, high, values in self._cells:
                parts = [(max(low, start) if first else low, high, 0)]
                first = False
                while parts:
                    one, two, level = parts.pop()
                    read = values if (one, two) == (low, high) else self._read(one, two)
                    found = _step(z, pull, inertia, read, two - one, self.size)
                    if found is None and level >= _HALVINGS:
                        push = (pull(sqrt(2.0 * z)) - read[0][0] - z * read[0][2]) / (
                            inertia + read[0][1]
                        )
                        rest = -z / push if push < 0.0 else 0.0
                        raise StalledError(
                            cycle * turns + one + rest, time + 2.0 * rest / sqrt(2.0 * z)
                        )
                    if found is None:
                        middle = (one + two) / 2.0
                        parts += [(middle, two, level + 1), (one, middle, level + 1)]
                        continue
                    z, spent, before, after = found
                    time += spent
                    yield cycle * turns + two, z, time, before, after
            turns += 1

    def _integrate(
        self,
        z: float,
        pull: Pull,
        inertia: float,
        over: Callable[[float, float], bool],
        *,
        stops: bool = False,
    ) -> TimeMotion:
        """Return the motion from a half square of speed, until a cycle of some z is the last."""
        start = time = 0.0
        if not z:
            moment, mass, _ = self._cells[0][2][0]
            rising = (pull(0.0) - moment) / (inertia + mass)
            if rising <= 0.0:
                raise StalledError(0.0, 0.0)
            z, start, time = rising * _SLOW, _SLOW, sqrt(2.0 * _SLOW / rising)
        rows = [(start, z, time, 0.0, 0.0)]
        cycle, begun, done = self.flywheel.cycle, z, 1
        try:
            for row in self._steps(z, pull, inertia, start, time):
                rows.append(row)
                if row[0] > cycle * done - 1e-9:
                    if over(begun, row[1]) or done >= MAX_CYCLES:
                        break
                    begun, done = row[1], done + 1
        except StalledError as end:
            if not stops:
                raise
            push = rows[-1][4]
            rows = [row for row in rows if row[0] < end.rotation - 1e-13]
            rows.append((end.rotation, 0.0, end.time, push, push))
        turned, halves, times, before, after = np.array(rows).T
        return TimeMotion(turned, halves, times, np.append(before[1:], 0.0), after)

    # With the motor --------------------------------------------------------------------------

    def _motor(self, omega: float) -> float:
        assert self.machine.motor is not None, "a motor is given"
        return self.machine.motor.at(omega)

    @cached_property
    def starting(self) -> TimeMotion:
        """The run-up from rest in position 0, some cycles long, until the cycles are equal.

        Raises
        ------
        StalledError
        """
        return self._integrate(0.0, self._motor, self.flywheel.steady_inertia, _is_steady)

    @cached_property
    def failure(self) -> StalledError | None:
        """Stall of the motor under the load with the flywheel; None if it does not stall.

        A motion that is not steady after `MAX_CYCLES` has an endless time.
        """
        try:
            last = float(self.starting.rotation[-1]) / self.flywheel.cycle
            self.steady(self.flywheel.steady_inertia)
        except StalledError as stalled:
            return stalled
        return StalledError(inf, inf) if last > MAX_CYCLES - 0.5 else None

    @memoized
    def steady(self, inertia: float) -> TimeMotion:
        """Return a cycle of the steady motion with a flywheel, kg·m².

        Raises
        ------
        StalledError
            The motor does not hold the load.
        """
        speed = 0.99 * self.machine.motor.idle if self.machine.motor is not None else 0.0
        now = min(self.size, speed**2 / 2.0)
        if inertia == self.flywheel.steady_inertia:
            now = float(self.starting.half[-1])
        previous: tuple[float, float] | None = None
        for _ in range(60):
            course = self._integrate(now, self._motor, inertia, lambda *_: True)
            gap = float(course.half[-1]) - now
            if abs(gap) <= 1e-12 * now:
                break
            slope = 0.0
            if previous is not None and now != previous[0]:
                slope = (gap - previous[1]) / (now - previous[0])
            previous = now, gap
            now = now - gap / slope if slope < -0.05 and now > gap / slope else now + gap
        return course

    def irregularity(self, inertia: float) -> float:
        """Return delta of the steady motion with a flywheel, kg·m²."""
        high, low = self.steady(inertia).extremes
        return 2.0 * (high - low) / (high + low)

    @cached_property
    def required_inertia(self) -> float | None:
        """The flywheel with which the motor keeps delta exactly, kg·m²; None if none is needed."""
        delta, own = self.machine.delta, float(np.mean(self.curves(self.curves.samples)[:, 1]))

        def excess_uniformity(inertia: float) -> float:
            """Return how much evener the motion is than it must be, nearly linear in J_f."""
            return delta / self.irregularity(inertia) - 1.0

        now = excess_uniformity(self.flywheel.steady_inertia)
        at, last = self.flywheel.steady_inertia, -own
        gap = -1.0  # without any mass
        for _ in range(40):
            if abs(now) < 1e-11:
                break
            at, last = at - now * (at - last) / (now - gap), at
            gap = now
            if at <= 0.0:
                if excess_uniformity(0.0) >= 0.0:
                    return None
                at = last / 2.0
            try:
                now = excess_uniformity(at)
            except StalledError:  # so little mass that the load stops it: as if far too uneven
                now = -0.5
        return at

    @cached_property
    def run_up(self) -> TimeMotion:
        """The run-up until the speed is within `STEADY_SPEED_TOLERANCE` of the steady motion's.

        Raises
        ------
        StalledError
        """
        whole, steady = self.starting, self.steady(self.flywheel.steady_inertia)
        rounds = np.mod(whole.rotation, self.flywheel.cycle)
        off = whole.omega / steady.at(rounds)[0] - 1.0
        late = np.flatnonzero(np.abs(off) > STEADY_SPEED_TOLERANCE)
        last = min(int(late[-1]) + 1 if late.size else 0, len(off) - 1)
        kept = slice(0, max(last, 1) + 1)
        return TimeMotion(
            whole.rotation[kept], whole.half[kept], whole.time[kept],
            whole.after[kept], whole.before[kept],
        )  # fmt: skip

    @cached_property
    def stop(self) -> TimeMotion | None:
        """The stop from the steady motion in position 0, by the brake and the loads.

        None where the crank still turns after `MAX_CYCLES`, or the motor does not hold the load.
        """
        wheel = self.flywheel
        if self.machine.motor is not None and self.failure is not None:
            return None
        if self.machine.motor is None:
            omega = float(wheel.speeds(np.zeros(1))[0][0])
        else:
            omega = float(self.steady(wheel.steady_inertia).omega[0])
        brake = self.machine.brake or 0.0
        never: Callable[[float, float], bool] = lambda *_: False  # noqa: E731
        found = self._integrate(
            omega**2 / 2.0, lambda _: -brake, wheel.steady_inertia, never, stops=True
        )
        return found if found.omega[-1] < 1e-6 * omega else None


@memoized
def run_up_of(flywheel: Flywheel) -> RunUp:
    """Return the run-up and the stop of a machine, made at the first call."""
    return RunUp(flywheel)


def _is_steady(start: float, ended: float) -> bool:
    return abs(ended - start) <= 1e-4 * ended


def _step(
    z: float, pull: Pull, inertia: float, values: _Values, step: float, size: float
) -> tuple[float, float, float, float] | None:
    """Return z, the time of a step and dz/dphi at both ends; None where the step errs too much."""
    push: list[float] = []
    slow: list[float] = []

    def stage(at: float, node: int) -> None:
        moment, mass, slope = values[node]
        omega = sqrt(2.0 * at)
        push.append((pull(omega) - moment - at * slope) / (inertia + mass))
        slow.append(1.0 / omega)

    stage(z, 0)
    after = z
    for number, weights in enumerate(_STAGES, 1):
        after = z + step * sum(w * k for w, k in zip(weights, push, strict=True))
        if after <= 0.0:
            return None
        stage(after, min(number, 5))
    time = step * sum(w * k for w, k in zip(_STAGES[-1], slow, strict=False))
    wrong = step * sum(w * k for w, k in zip(_ERROR, push, strict=True))
    late = step * sum(w * k for w, k in zip(_ERROR, slow, strict=True))
    if abs(wrong) > _TOLERANCE * max(after, 1e-6 * size):
        return None
    if abs(late) > 1e2 * _TOLERANCE / sqrt(2.0 * size):
        return None
    return after, time, push[0], push[-1]
