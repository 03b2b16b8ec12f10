"""Forces over the course of the driver, and the efficiency of a cycle (силы за цикл, КПД)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from math import ceil, inf, lcm

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.errors import Fault, LayoutError, ProblemError
from planmethod.languages import translate
from planmethod.problem.model import MOTOR_DRIVES
from planmethod.solved.forces.friction import ZERO_POWER_FRACTION, friction_of
from planmethod.solved.forces.laws import only_in_positions
from planmethod.solved.forces.reading import NEGLIGIBLE_FRACTION, require_dynamics
from planmethod.solved.forces.statics import JointForce, statics_of
from planmethod.solved.many.positions import impossible_steps
from planmethod.solved.reading import Complexes, Memoizing, Reals, memoized
from planmethod.solved.solution import Solution

_SAME = 1e-6  # degrees within which positions are one
_PARTS_OF_SLIDER_STEP = 12  # parts of a step of a driving slider
_MAX_POINTS = 720  # points of a line

_SAG = 1.5e-3  # of the largest value: a corner of a curve that goes further out is seen
_HALVINGS = 6
_ADDED = 400  # positions more, at the most


class DriverPath(Struct, frozen=True, dict=True):
    """Driver positions along a smooth curve (ход начального звена).

    A full turn in equal steps is closed; other positions are joined from the first to the last.
    Positions over several turns are mapped to one.

    Attributes
    ----------
    step : float, degrees
        Greatest step of a crank between points of the line.
    min_steps : int
        Minimum number of steps of the curve.
    turns : int
        Turns of a crank after which everything repeats: two for loads over 720 degrees; more if the
        links are then not where they were.
    """

    solution: Solution
    step: float = 3.0
    min_steps: int = 1
    turns: int = 1

    @property
    def _turn(self) -> float:
        turns = lcm(self.turns, self.solution.closing_turns)
        return self.solution.problem.drive.coordinate.turn * turns

    @property
    def falling(self) -> bool:
        """True if positions fall in the order of their numbers."""
        asked = self.solution.positions
        return len(asked) > 1 and bool(asked[1] < asked[0])

    @cached_property
    def distinct_positions(self) -> Reals:
        """Distinct requested positions in order."""
        # Not np.unique: with it numpy.ma is imported.
        asked = np.asarray(sorted(set(self.solution.positions.tolist())))
        if len(asked) < 2 or np.ptp(asked) <= self._turn + _SAME:
            return asked
        return np.unique(asked[0] + np.round((asked - asked[0]) % self._turn, 9) % self._turn)

    @cached_property
    def drawn(self) -> Reals:
        """Distinct requested positions in order; in a closed path number 0 is at both ends."""
        drawn = self.distinct_positions
        if not self.closed:
            return drawn
        if self.falling:
            return np.insert(drawn, 0, drawn[-1] - self._turn)
        return np.append(drawn, drawn[0] + self._turn)

    @cached_property
    def positions(self) -> Reals:
        """Driver positions, including the requested ones, in order, ndarray of shape (n,)."""
        drawn = self.drawn
        if len(drawn) < 2:
            return drawn
        gaps = np.diff(drawn)
        if self.solution.problem.drive.goes_round:
            whole = float(gaps.sum())
            step = max(min(self.step, whole / self.min_steps), whole / _MAX_POINTS)
            counts = [max(1, ceil(gap / step - 1e-9)) for gap in gaps]
        else:
            parts = max(_PARTS_OF_SLIDER_STEP, ceil(self.min_steps / len(gaps)))
            counts = [max(1, min(parts, _MAX_POINTS // len(gaps)))] * len(gaps)
        lines = [
            start + gap * np.arange(count) / count
            for start, gap, count in zip(drawn[:-1], gaps, counts, strict=True)
        ]
        return np.concatenate([*lines, drawn[-1:]])

    @cached_property
    def closed(self) -> bool:
        """True if the requested positions go all round."""
        if self.solution.problem.drive.other_drives:
            return False  # the other drivers are not where they were
        drawn = self.distinct_positions
        gaps = np.diff(np.append(drawn, drawn[:1] + self._turn))
        return len(drawn) > 2 and bool(np.ptp(gaps) < 1e-6)


def without_corners(
    positions: Reals,
    rows: Complexes,
    read: Callable[[Reals], Complexes],
    jumps: npt.NDArray[np.bool_] | None = None,
) -> tuple[Reals, Complexes, npt.NDArray[np.bool_]]:
    """Return a curve with positions between those where its chords would show corners.

    Parameters
    ----------
    positions : ndarray of shape (m,)
        Driver positions, in order.
    rows : ndarray of shape (k, m)
        Ends of vectors there, NaN where there are none; each row is a curve.
    read : callable
        Returns the rows of other positions; of one curve its values.
    jumps : ndarray of shape (m - 1,)
        Intervals of positions in which some value jumps: they are not smoothed.
    """
    jumps = np.zeros(len(positions) - 1, dtype=bool) if jumps is None else jumps
    largest = np.nanmax(np.abs(rows), axis=1, initial=0.0)
    least = _SAG * np.where(largest > 0.0, largest, np.inf)[:, np.newaxis]
    most = len(positions) + _ADDED
    for _ in range(_HALVINGS):
        corners = (_sags(rows) > least).any(axis=0) & ~jumps[1:] & ~jumps[:-1]
        halved = np.zeros(len(jumps), dtype=bool)
        halved[1:] |= corners
        halved[:-1] |= corners
        where = np.flatnonzero(halved)
        if not where.size or len(positions) + where.size > most:
            break
        between = (positions[where] + positions[where + 1]) / 2
        rows = np.insert(rows, where + 1, np.atleast_2d(read(between)), axis=1)
        positions = np.insert(positions, where + 1, between)
        jumps = np.insert(jumps, where + 1, False)
    return positions, rows, jumps


def _sags(rows: Complexes) -> Reals:
    """Return how far every inner point of curves is from the line of its neighbours."""
    before, chord = rows[:, :-2], rows[:, 2:] - rows[:, :-2]
    length = np.maximum(np.abs(chord), 1e-300)
    across = np.abs(((rows[:, 1:-1] - before) * chord.conj()).imag) / length
    return np.asarray(np.nan_to_num(across), dtype=float)


COUNT = 360
"""Positions of a turn."""


class CycleEfficiency(Struct, frozen=True):
    """Efficiency of a whole cycle (КПД за цикл), or why it has none.

    Attributes
    ----------
    value : float or None
    ideal, real : float, J
        Work of the driver without friction and with it.
    locked : tuple of float, degrees
        First and last position of a part of the cycle that is jammed; empty of none.
    """

    value: float | None
    ideal: float = 0.0
    real: float = 0.0
    locked: tuple[float, ...] = ()


@memoized
def cycle_efficiency(solution: Solution, count: int = COUNT) -> CycleEfficiency | None:
    """Return the efficiency of the cycle of a crank; None where it cannot be moved through one.

    Parameters
    ----------
    count : int
        Positions of a turn.
    """
    problem = solution.problem
    assert problem.dynamics is not None
    if (
        not problem.drive.goes_round
        or problem.drive.actuator
        or problem.drive.motor
        or problem.drive.other_drives
        or only_in_positions(problem.dynamics)
    ):
        return None
    turned = 360.0 * solution.turns
    whole = count * solution.turns
    grid = float(solution.positions[0]) + turned * (np.arange(whole) + 0.5) / whole
    moved = solution.with_positions(grid.tolist())
    if (impossible_steps(moved) >= 0).any() or not statics_of(moved).closes.all():
        return None
    found = friction_of(moved)
    step = float(np.radians(turned)) / len(grid) / abs(problem.drive.rate)
    ideal = float(found.without.power.sum() * step)
    if found.jammed.any():
        at = grid[found.jammed]
        return CycleEfficiency(None, ideal, inf, (float(at[0]), float(at[-1])))
    real = float(found.converged.power.sum() * step)
    if abs(ideal) <= ZERO_POWER_FRACTION * float(found.scale.sum() * step):
        return CycleEfficiency(None, ideal, real)
    return CycleEfficiency(ideal / real if ideal > 0 else real / ideal, ideal, real)


STEP, LEAST = 1.0, 120
"""Step of the crank, degrees, and minimum number of steps: corners are invisible on the paper."""

STEEP = 0.02
"""Relative change of a quantity between two positions above which it is examined."""

TIMES = 4.0
"""Factor by which such a change must exceed those around it."""

_AROUND = 4  # steps to both sides that a step is compared with
_PARTS_OF_SUSPECT_STEP = 32  # parts that a suspected step is cut into
_ROUNDS = 3

Rows = npt.NDArray[np.complex128]


class Piece(Struct, frozen=True):
    """Part of a curve without a jump or a gap: positions and values, ndarrays of shape (m,).

    It may be a single position, such as a dead one in which a resistance is zero.
    """

    positions: Reals
    values: Complexes


class ReactionPeak(Struct, frozen=True):
    """Largest size of a reaction, N, and the driver position where it is.

    ``is_limit``: next to a jump it is only come near to, and may not be there in the position.
    """

    size: float
    position: float
    is_limit: bool


class CycleForces(Memoizing):
    """Reactions and the balance over the driver's cycle (реакции за цикл).

    Parameters
    ----------
    solution : Solution
        Several positions of a problem with ``[dynamics]``.

    Attributes
    ----------
    joints : list of JointForce
        The reactions in the requested positions; a curve is identified by its index among them.
    smooth : bool
        False if a load is known only in the file's positions: then curves are chords.
    positions : ndarray of shape (m,)
        Driver positions, including the requested ones.
    """

    def __init__(self, solution: Solution) -> None:
        super().__init__()
        self.solution = solution
        turns = solution.turns
        self.course = DriverPath(solution, step=STEP, min_steps=LEAST, turns=turns)
        self.joints: list[JointForce] = statics_of(solution).reactions
        assert solution.problem.dynamics is not None
        self.smooth = not only_in_positions(solution.problem.dynamics)
        if self.smooth:
            positions, rows, jumps = self._with_jumps(self.course.positions)
            found = without_corners(positions, rows, self._read, jumps)
        else:
            found = (
                self.course.drawn,
                self._position_values(),
                np.zeros(len(self.course.drawn) - 1, bool),
            )
        self.positions, self._rows, self._jumps = found

    def _position_values(self) -> Rows:
        """Return the values of the requested positions, in the order of `DriverPath.drawn`."""
        s = self.solution
        order = np.unique(s.positions, return_index=True)[1]
        if self.course.closed:
            ends = (order[-1:], order) if self.course.falling else (order, order[:1])
            order = np.concatenate(ends)
        rows = [*(joint.force for joint in statics_of(s).reactions), statics_of(s).balance]
        return np.array([np.asarray(row, dtype=complex)[order] for row in rows])

    def _read(self, positions: Reals) -> Rows:
        """Return `_computed`, once for the solution at all scales: sheets try several of them."""
        known = self.solution.origin.compute_once(_rows)
        key = positions.tobytes()
        if key not in known:
            known[key] = self._computed(positions)
        return known[key]

    def _computed(self, positions: Reals) -> Rows:
        """Return all reactions and the balance, shape (k, m); NaN where there is none."""
        able = np.arange(len(positions))
        made = self._solved(positions)
        there = impossible_steps(made) < 0
        if not there.all():
            able, made = able[there], self._solved(positions[there])
        if able.size and not statics_of(made).closes.all():
            there = statics_of(made).closes
            able, made = able[there], self._solved(positions[able[there]])
        rows = np.full((len(self.joints) + 1, len(positions)), np.nan, dtype=complex)
        if able.size:
            statics = statics_of(made)
            for k, joint in enumerate(statics.reactions):
                rows[k, able] = joint.force
            rows[-1, able] = statics.balance
        return rows

    def _solved(self, positions: Reals) -> Solution:
        s = self.solution
        return s.with_positions(positions.tolist()).drawn_at(s.scales)

    # Jumps -----------------------------------------------------------------------------------

    @cached_property
    def _peaks(self) -> Reals:
        """Largest force and largest balance among the requested positions, for every row."""
        statics = statics_of(self.solution)
        forces = max((float(np.max(np.abs(j.force))) for j in self.joints), default=0.0)
        balance = float(np.max(np.abs(statics.balance)))
        return np.array([*([forces or 1.0] * len(self.joints)), balance or 1.0])[:, np.newaxis]

    def _steps(self, rows: Rows) -> Reals:
        """Return by how much the most changing quantity changes, as a part of its largest value."""
        steps = np.max(np.abs(np.diff(rows / self._peaks, axis=1)), axis=0)
        return np.asarray(np.nan_to_num(steps), dtype=float)

    def _with_jumps(self, positions: Reals) -> tuple[Reals, Rows, npt.NDArray[np.bool_]]:
        """Return positions, values, and between which of them something jumps."""
        rows = self._read(positions)
        steps = self._steps(rows)
        steep = np.flatnonzero((steps > STEEP) & (steps > TIMES * _around(steps)))
        low, high = positions[steep], positions[steep + 1]
        for _ in range(_ROUNDS if steep.size else 0):
            low, high = self._narrowed(low, high)
        if steep.size:
            ends = self._read(np.column_stack((low, high)).ravel())
            real = self._steps(ends)[::2] > steps[steep] / 2
            added = np.column_stack((low[real], high[real])).ravel()
            rows = np.concatenate((rows, ends[:, np.repeat(real, 2)]), axis=1)
            positions = np.concatenate((positions, added))
            low = low[real]
        positions, first = np.unique(positions, return_index=True)
        return positions, rows[:, first], np.isin(positions[:-1], low)

    def _narrowed(self, low: Reals, high: Reals) -> tuple[Reals, Reals]:
        """Return of every interval the part in which the most happens."""
        grid = low + (high - low) * np.linspace(0.0, 1.0, _PARTS_OF_SUSPECT_STEP + 1)[:, np.newaxis]
        grid = grid.T  # (intervals, parts + 1)
        rows = self._read(grid.ravel()).reshape(len(self._peaks), *grid.shape)
        change = np.abs(np.diff(rows / self._peaks[:, :, np.newaxis], axis=2))
        where = np.argmax(np.nan_to_num(np.max(change, axis=0)), axis=1)
        lines = np.arange(len(low))
        return grid[lines, where], grid[lines, where + 1]

    # Curves ----------------------------------------------------------------------------------

    def force(self, number: int) -> list[Piece]:
        """Return the curve of a reaction, N, by its number among ``joints``."""
        return list(self._pieces(self._rows[number]))

    @property
    def balance(self) -> list[Piece]:
        """Curve of the driver's balance, N·m or N (a real number as a complex one)."""
        return list(self._pieces(self._rows[-1]))

    def peak(self, number: int) -> ReactionPeak:
        """Return the largest size of a reaction and where it is."""
        sizes = np.nan_to_num(np.abs(self._rows[number]), nan=-1.0)
        k = int(np.argmax(sizes))
        near = self._jumps[max(k - 1, 0) : k + 1]
        return ReactionPeak(float(sizes[k]), float(self.positions[k]), bool(near.any()))

    def is_negligible(self, number: int) -> bool:
        """Return whether a reaction is negligible beside the largest one in all positions."""
        largest = float(self._peaks[0, 0])
        return self.peak(number).size <= NEGLIGIBLE_FRACTION * largest

    def _pieces(self, row: Complexes) -> Iterator[Piece]:
        ends = np.flatnonzero(self._jumps) + 1
        for part in np.split(np.arange(len(row)), ends):
            gone = np.isnan(row[part])
            for run in np.split(part, np.flatnonzero(gone)):
                kept = run[~np.isnan(row[run])]
                if kept.size:
                    yield Piece(self.positions[kept], row[kept])


def _rows(origin: Solution) -> dict[bytes, Rows]:
    """Return the store of reactions and balances of a solution, by the bytes of the positions."""
    return {}


def _around(steps: Reals) -> Reals:
    """Return the middle one of the steps around each step."""
    if not steps.size:
        return steps
    padded = np.pad(steps, _AROUND, mode="reflect" if len(steps) > _AROUND else "edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * _AROUND + 1)
    return np.asarray(np.median(windows, axis=1), dtype=float)


@memoized
def cycle_forces_of(solution: Solution) -> CycleForces:
    """Return the forces over the cycle of a solution; cached, since several views show them.

    Raises
    ------
    ProblemError
        The problem file gives neither masses nor loads, or an actuator drives.
    LayoutError
        There is only one position.
    """
    require_dynamics(solution.problem)
    if (ends := solution.problem.drive.actuator) is not None:
        what = (
            "the actuator {} drives link {}, and forces over a turn of that link are not available"
        )
        hint = (
            "Request single positions: --phi 40,50, or variants with other lengths of the actuator."
        )
        fault = Fault("driver", translate(what, "".join(ends), solution.problem.drive.link), hint)
        raise ProblemError(solution.problem.name, [fault])
    if (links := solution.problem.drive.motor) is not None:
        message = translate(MOTOR_DRIVES, *links, solution.problem.drive.link)
        fault = Fault("driver", message, solution.problem.drive.motor_hint)
        raise ProblemError(solution.problem.name, [fault])
    if len(solution.positions) < 2:
        raise LayoutError(
            "{}: a layout with forces over the cycle needs several positions, but 1 is "
            "requested. Request more: --phi 0:360:30, or phi = {{ from = 0, count = 12 }} "
            "in [driver].",
            solution.problem.name,
        )
    return CycleForces(solution)
