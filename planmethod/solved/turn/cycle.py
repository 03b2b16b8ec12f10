"""The turn of a crank (цикл): how far the mechanism assembles, extremes, phases, pressure angle.

Everything is read from the program itself, driven at one radian a second, so that velocities are
first and accelerations second transfer functions (аналоги); places where the output is at rest, or
where a group just closes, are roots of the program's values.
"""

# no messages: codes of JSON

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from functools import cached_property, partial
from math import isfinite

import numpy as np
from msgspec import Struct

from planmethod.construct.arithmetic import Float64
from planmethod.construct.curves import by_rows, root, roots, top, tops
from planmethod.construct.evaluate import TANGENT, evaluate
from planmethod.construct.steps import (
    IntersectCircles,
    IntersectLineCircle,
    Name,
    PointName,
    Touch,
    TriadPose,
)
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.plans.model import PlanKind
from planmethod.problem.machine_records import CycleTask, Zero
from planmethod.problem.model import Problem
from planmethod.problem.names import listed
from planmethod.solved.assembly_modes import drive_data
from planmethod.solved.reading import Flags, Memoizing, Reading, Reals, memoized, near_piece
from planmethod.solved.solution import Solution
from planmethod.solved.turn.output import (
    LONGER,
    SENSES,
    TOLD,
    Output,
    Strokes,
    by_loads,
    find_output,
    over_strokes,
    powers,
    pressure_on,
    sample_positions,
)

TURN = 360.0

MAX_TURNS = 6
"""Turns of the crank after which links that are not where they were do not come again."""

SAMPLES = 1440
"""Number of samples of a turn: every quarter of a degree."""

_SINGULAR_OFFSET = (
    0.0931  # degrees of the samples off round numbers, at which singular places are common
)
_SAME = 1e-9  # fraction of a stroke, or degrees, within which two extremes are equal
_ZERO_RATE = 1e-10  # fraction of the greatest rate below which the output is at rest
_NARROW = 0.05  # margin of a closing step that may vanish between two samples
_STEP = TURN / SAMPLES
_LEVEL, _MOST_TOPS = 0.01, 8  # degrees of pressure angle within which peaks are compared


class NoNumber(Enum):
    """Reason why a number of the cycle does not exist; the sentence of records."""

    PARTIAL = "the crank does not turn fully"
    NO_MOTION = "the output does not move"
    ROUND = "the output turns all round"
    NO_EXTREME = "the output does not turn back"
    SEVERAL = "the output reaches an end of its stroke more than once in a turn"
    NO_DYAD = "the output link does not close a dyad on the frame"
    NO_RATE = "the crank stands still"


class Extreme(Struct, frozen=True):
    """Extreme position (крайнее положение): crank, degrees, and value of the output, m or deg."""

    phi: float
    value: float


class PressureAnglePeak(Struct, frozen=True):
    """Greatest and least pressure angle, degrees, and where the crank then is, degrees."""

    maximum: float
    maximum_at: float
    minimum: float
    minimum_at: float


class CrankCycle(Memoizing):
    """The cycle of a mechanism with a crank.

    Parameters
    ----------
    solution : Solution
    sampled : sequence of float, optional
        Positions that are sampled beside the even ones, degrees: in each stroke that may be short.

    Raises
    ------
    ProblemError
        The driver slides, or the mechanism has no output.
    """

    def __init__(self, solution: Solution, sampled: Sequence[float] = ()) -> None:
        super().__init__()
        self._also = sampled
        problem = solution.problem
        if problem.drive.other_drives:
            message = translate(
                "a cycle is a turn of one crank, but links {} drive", listed(problem.drive.links)
            )
            hint = "Draw single positions (--layout one-position), or fix all drivers but one."
            raise ProblemError(problem.name, [Fault("drivers", message, hint)])
        if not problem.drive.goes_round:
            raise ProblemError(
                problem.name,
                [
                    Fault(
                        "cycle",
                        translate(
                            "the driver, link {}, slides: it has no turn", problem.drive.link
                        ),
                        "A cycle is a turn of a crank",
                    )
                ],
            )
        if not isfinite(solution.closes_after):
            message = translate(
                "the links are not where they were after {} turns of the crank", MAX_TURNS
            )
            hint = "Request positions instead of a cycle: phi = [...] in [driver]"
            raise ProblemError(problem.name, [Fault("cycle", message, hint)])
        self.solution = solution
        self.task = task_of(problem)
        self.sense = -1 if problem.drive.rate < 0 else 1
        self.unit = solution.with_positions(problem.drive.positions).at_unit_rate()
        self.output: Output = find_output(self.unit)

    @property
    def _start_positions(self) -> tuple[float, ...]:
        """Positions that are sampled first: in them the assembly modes are chosen."""
        drive = self.solution.problem.drive
        return drive.assembly_positions or drive.positions

    @property
    def period(self) -> float:
        """Degrees of the crank after which the links are where they were: a turn, or some."""
        return TURN * round(self.solution.closes_after)

    # Readings ------------------------------------------------------------------------------------

    def read(self, positions: Reals | Sequence[float]) -> Reading:
        """Return the exact reading at unit scales and one radian a second; gaps are NaN."""
        at = np.asarray(positions, dtype=float)
        draft = self.unit.construction.draft
        data = drive_data(self.unit.problem, draft, at)
        return Reading(evaluate(self.unit.construction.program, data, Float64()), len(at))

    def rate(self, positions: Reals) -> Reals:
        """Return the first transfer function of the output, in its own unit per radian."""
        return self.output.rates(self.unit, self.read(positions))[0]

    # Range ---------------------------------------------------------------------------------------

    @cached_property
    def _closing_steps(self) -> list[tuple[tuple[str, ...], Name]]:
        """Steps of the position plan that may lack an intersection, by the links of their group."""
        return [
            (section.group.links if section.group else (), step.out)
            for section in self.unit.construction.sections
            if section.kind is PlanKind.POSITION
            for step in section.steps
            if isinstance(step, IntersectCircles | IntersectLineCircle | Touch | TriadPose)
        ]

    def _closed(self, reading: Reading) -> Flags:
        """Return in which positions every point of the position plan has its place."""
        able = np.ones(reading.count, dtype=bool)
        for name in self.unit.construction.draft.points():
            able &= np.isfinite(reading.point(PointName(name)))
        return able

    def _margin(self, name: Name, positions: Reals) -> Reals:
        """Return the margin of a step; negative if an earlier step fails already."""
        margin = np.asarray(self.read(positions).trace.margin[name], dtype=float)
        margin = np.broadcast_to(margin, positions.shape)
        return np.where(np.isnan(margin), -1.0, margin)

    def _short(self, name: Name, positions: Reals) -> Reals:
        """Return the negative margin of a step."""
        return -self._margin(name, positions)

    @cached_property
    def _sampled(self) -> tuple[Reals, Reading, Flags]:
        """Sampled positions, a turn from the first requested one that exists."""
        asked = np.asarray(self._start_positions)
        there = np.flatnonzero(self._closed(self.read(asked)))
        start = float(asked[there[0]]) if there.size else float(asked[0])
        looks = start + _SINGULAR_OFFSET + np.arange(0.0, self.period, _STEP)
        # A closing step that fails only between two samples: where its margin is smallest.
        reading, more = self.read(looks), list(self._also)
        for _, name in self._closing_steps:
            margin = np.broadcast_to(
                np.asarray(reading.trace.margin[name], dtype=float), looks.shape
            )
            before, after = np.roll(margin, 1), np.roll(margin, -1)
            least = (margin > 0) & (margin < _NARROW) & (margin <= before) & (margin < after)
            for k in np.flatnonzero(least):
                at, size = top(partial(self._short, name), looks[k] - _STEP, looks[k] + _STEP)
                if size > -TANGENT:
                    more.append(at)
        if more:
            looks = np.sort([*looks, *((np.array(more) - looks[0]) % self.period + looks[0])])
            reading = self.read(looks)
        return looks, reading, self._closed(reading)

    @cached_property
    def range(self) -> tuple[float, float] | None:
        """Driver positions between which the mechanism assembles, degrees; None: a full turn.

        The range that contains the first requested position that exists.
        """
        looks, _, able = self._sampled
        if able.all():
            return None
        back = int(np.flatnonzero(~able[::-1])[0])  # going back from the start, over the end
        ahead = int(np.flatnonzero(~able)[0])
        high = self._limit(looks[ahead - 1] if ahead else looks[0] - _SINGULAR_OFFSET, looks[ahead])
        whole = self.period
        inside = looks[len(looks) - back] - whole if back else looks[0] - _SINGULAR_OFFSET
        low = self._limit(inside, looks[len(looks) - 1 - back] - whole)
        return low, high

    def _limit(self, inside: float, outside: float) -> float:
        """Return the position between two where the mechanism just closes."""
        failing = [n for _, n in self._closing_steps if self._margin(n, np.array([outside]))[0] < 0]
        if failing:
            return root(lambda p: self._margin(failing[0], p), inside, outside)

        def able(positions: Reals) -> Reals:
            return np.where(self._closed(self.read(positions)), 1.0, -1.0)

        return root(able, inside, outside)

    def stopping(self, limit: float) -> tuple[str, ...]:
        """Return the links of the group that does not close beyond a limit of the range."""
        assert self.range is not None
        outside = np.array([limit + (1e-3 if limit == self.range[1] else -1e-3)])
        return next(
            (own for own, name in self._closing_steps if self._margin(name, outside)[0] < 0), ()
        )

    @cached_property
    def tightest(self) -> tuple[tuple[str, ...], float] | None:
        """Links of the group that is most critical to close in a turn, and where, degrees."""
        looks, reading, _ = self._sampled
        found = []
        for own, name in self._closing_steps:
            margin = np.broadcast_to(np.asarray(reading.trace.margin[name], float), looks.shape)
            k = int(np.argmin(margin))
            found.append((float(margin[k]), own, float(looks[k])))
        return min(found)[1:] if found else None

    # Output --------------------------------------------------------------------------------------

    @cached_property
    def _continuous_range(self) -> tuple[Reals, Reals, Reals]:
        """Consecutive existing positions, values (an angle continues), first transfer functions."""
        looks, _, able = self._sampled
        if self.range is not None:
            low, high = self.range
            looks = looks[able]
            looks = np.where(looks > high, looks - self.period, looks)
            looks = np.sort([low, *looks[(looks > low) & (looks < high)], high])
        else:
            looks = np.append(looks, looks[0] + self.period)
        reading = self.read(looks)
        value = self.output.value(self.unit, reading)
        if self.output.slide is None:
            good = np.isfinite(value)
            value[good] = np.degrees(np.unwrap(np.radians(value[good])))
        return looks, value, self.output.rates(self.unit, reading)[0]

    @cached_property
    def gain(self) -> float:
        """Growth of the value in a period, degrees for an output that goes round; else 0."""
        if self.output.slide is not None or self.range is not None:
            return 0.0
        _, value, _ = self._continuous_range
        return float(np.round((value[-1] - value[0]) / TURN) * TURN)

    def values(self, positions: Reals) -> Reals:
        """Return the value of the output, m or degrees; an angle continues that of the range."""
        value = self.output.value(self.unit, self.read(positions))
        if self.output.slide is not None:
            return value
        looks, course, _ = self._continuous_range
        turns = np.floor((positions - looks[0]) / self.period)
        turns = turns if self.range is None else 0.0 * positions
        good = np.isfinite(course)
        near = np.interp(positions - self.period * turns, looks[good], course[good])
        return value + TURN * np.round((near - value) / TURN) + turns * self.gain

    def transfers(self, positions: Reals) -> tuple[Reals, Reals]:
        """Return both transfer functions of the output: m, or 1, per radian of the crank."""
        return self.output.rates(self.unit, self.read(positions))

    @cached_property
    def fastest(self) -> float:
        """Greatest first transfer function of the output."""
        rates = np.abs(self._continuous_range[2])
        return float(np.max(rates[np.isfinite(rates)], initial=0.0))

    @cached_property
    def is_stationary(self) -> bool:
        """True if the output does not move at all."""
        size = max((abs(length) for *_, length in self.unit.problem.lengths), default=1.0)
        return self.fastest <= _ZERO_RATE * (size if self.output.slide is not None else 1.0)

    @cached_property
    def turnings(self) -> list[Extreme]:
        """Extreme positions in the order of the angle, within the course."""
        if self.is_stationary:
            return []
        found = roots(self.rate, self._continuous_range[0])
        found = found[np.abs(self.rate(found)) < 1e-6 * self.fastest]
        drive = self.unit.problem.drive
        places = np.array([near_piece(drive, at) for at in found.tolist()])
        return [
            Extreme(float(p), float(v)) for p, v in zip(places, self.values(places), strict=True)
        ]

    def _distance_to(self, start: float, phi: float) -> float:
        """Return the rotation of the crank from one position to another in its sense, degrees."""
        way = self.sense * (phi - start)
        if self.range is not None:
            return way
        way %= self.period
        return 0.0 if self.period - way < _SAME else way

    @cached_property
    def ends(self) -> tuple[Extreme, Extreme] | None:
        """The extreme from which the quicker stroke starts, and the other one."""
        found = self.turnings
        if len(found) < 2 or self.gain:
            return None
        values = np.array([one.value for one in found])
        near = _SAME * float(np.ptp(values))
        highs = [e for e in found if e.value >= values.max() - near]
        lows = [e for e in found if e.value <= values.min() + near]
        pairs = [(a, b) for high in highs for low in lows for a, b in ((high, low), (low, high))]
        if self.range is not None:
            pairs = [(a, b) for a, b in pairs if self._distance_to(a.phi, b.phi) > 0]
        # Strokes as long as each other: the one from the greater value.
        return min(
            pairs,
            key=lambda p: (round(self._distance_to(p[0].phi, p[1].phi), 7), -p[0].value, p[0].phi),
        )

    @property
    def ends_from_zero(self) -> tuple[Extreme, Extreme]:
        """Both ends of the stroke, that which ``zero`` names first; there must be a stroke."""
        assert self.ends is not None
        one, two = self.ends
        is_other, zero = self.task.zero is Zero.OTHER, self.task.zero
        if zero in (Zero.WORKING, Zero.USUAL) and (strokes := self.strokes) is not None:
            # Strokes of an indicator count from position 0, so they cannot determine it.
            circular = strokes.by != TOLD and over_strokes(self.solution.problem)
            is_known = strokes.by != LONGER and not circular
            is_other = (zero is Zero.WORKING or is_known) and strokes.start_deg == two.phi
        return (two, one) if is_other else (one, two)

    @cached_property
    def why_no_stroke(self) -> NoNumber | None:
        """Reason why the output has no stroke between two extremes."""
        if self.is_stationary:
            return NoNumber.NO_MOTION
        if self.gain:
            return NoNumber.ROUND
        if self.ends is not None:
            return None
        return NoNumber.NO_EXTREME if self.range is None else NoNumber.PARTIAL

    @cached_property
    def stroke(self) -> float | None:
        """Stroke H, m, or swing psi, degrees (ход, угол размаха); over a range its whole extent."""
        if self.range is not None and not self.is_stationary:
            places = np.array([*self.range, *(one.phi for one in self.turnings)])
            values = self.values(places)
            return float(np.nanmax(values) - np.nanmin(values))
        if self.ends is None:
            return 0.0 if self.is_stationary else None
        return abs(self.ends[0].value - self.ends[1].value)

    @cached_property
    def strokes(self) -> Strokes | None:
        """Both strokes with the working one; None if the output does not have two.

        Raises
        ------
        ProblemError
            The output moves on neither stroke as ``[cycle] working`` specifies.
        """
        if self.ends is None or self.range is not None:
            return None
        quick = self._distance_to(self.ends[0].phi, self.ends[1].phi)
        told = self._specified_stroke()
        found = (told, TOLD) if told is not None else self._loaded_stroke(quick)
        # Of equal strokes the one from the greater value.
        is_first, by = found or (quick >= self.period / 2 - _SAME, LONGER)
        working, idle = (quick, self.period - quick)[:: 1 if is_first else -1]
        ratio = max(working, idle) / min(working, idle)
        start = self.ends[0 if is_first else 1].phi
        return Strokes(working, idle, None if self.why_no_ratio else ratio, by, start)

    @property
    def contradicting(self) -> str | None:
        """Loads that work on the other stroke than ``[cycle] working`` specifies, if given."""
        told = self._specified_stroke()
        if told is None or self.ends is None or self.range is not None:
            return None
        loaded = self._loaded_stroke(self._distance_to(self.ends[0].phi, self.ends[1].phi))
        return loaded[1] if loaded is not None and loaded[0] is not told else None

    def _loaded_stroke(self, quick: float) -> tuple[bool, str] | None:
        """Return whether the loads work on the quicker stroke, and which do; None if none does."""
        assert self.ends is not None
        start = self.ends[0].phi
        positions = sample_positions(self.solution.problem, start, self.turns)
        if not positions.size:
            return None
        ahead = (self.sense * (positions - start)) % self.period
        return by_loads(powers(self.solution, start, positions), ahead < quick)

    def _specified_stroke(self) -> bool | None:
        """Return whether the quicker stroke moves as ``[cycle] working`` specifies, if given."""
        sense, problem = self.task.working, self.solution.problem
        if sense is None or self.ends is None:
            return None
        one, two = self.ends
        way, size = two.value - one.value, abs(two.value - one.value)
        if sense in SENSES:
            place = self.read([one.phi, two.phi]).point(PointName(self.output.point))
            moved = complex(place[1] - place[0])
            size, way = abs(moved), (moved * SENSES[sense].conjugate()).real
        elif self.output.slide is None:
            way = -way if sense.value == "cw" else way
        else:
            size = np.inf
        if abs(way) > 1e-6 * size:
            return way > 0.0
        message = translate("{} does not move in this direction on either stroke", self.output.name)
        hint = "Give its direction: left, right, up or down; ccw or cw for a link that turns."
        raise ProblemError(problem.name, [Fault("cycle.working", message, hint)])

    @cached_property
    def why_no_ratio(self) -> NoNumber | None:
        """Reason why there is no K_v."""
        if self.ends is None or self.range is not None:
            return self.why_no_stroke or NoNumber.PARTIAL
        ends = [value for end in self.ends or () for value in (end.value,)]
        near = _SAME * abs(ends[0] - ends[1])
        at_ends = [e for e in self.turnings if min(abs(e.value - v) for v in ends) <= near]
        return NoNumber.SEVERAL if len(at_ends) > 2 else None

    # Position zero -------------------------------------------------------------------------------

    @cached_property
    def zero(self) -> float:
        """Position zero, degrees: an extreme from 0 on within a period, or the given angle."""
        asked, first = self.task.zero, float(self._start_positions[0])
        if self.range is not None:
            first = float(self.positions[0])
        if not isinstance(asked, Zero):
            if self.range is None:
                return asked
            low, high = self.range
            found = asked + TURN * round(((low + high) / 2 - asked) / TURN)
            return found if low <= found <= high else first
        if self.ends is None:
            single = self.turnings
            found = single[0].phi if single else first
        else:
            found = self.ends_from_zero[0].phi
        if self.range is not None:
            return found
        return 0.0 if self.period - found % self.period < _SAME else found % self.period

    @cached_property
    def is_zero_specified(self) -> bool:
        """True if position zero is as requested: the extreme exists, or the angle is the same."""
        if isinstance(self.task.zero, Zero):
            return self.ends is not None
        return not (self.zero - self.task.zero) % TURN

    @property
    def turns(self) -> int:
        """Turns of the crank in a cycle: two of a machine of 720 degrees, or of the motion."""
        return 1 if self.range else self.solution.turns

    @property
    def count(self) -> int:
        """Positions of the cycle."""
        return self.task.count * self.turns

    @property
    def is_against(self) -> bool:
        """True if positions are numbered against the rotation of the crank."""
        return self.task.is_against(self.sense)

    @cached_property
    def positions(self) -> Reals:
        """Positions of the cycle in the order of their numbers, ndarray of shape (count,).

        For a crank that does not turn fully, positions within its range, without the limits.
        """
        numbers = np.arange(self.count)
        if self.is_against:
            numbers = -numbers if self.range is None else numbers[::-1]
        return self.at((numbers + self.first) / self.count)

    @property
    def numbers(self) -> list[int]:
        """Numbers of the positions as the crank comes through them from position 0, or a limit."""
        numbers = list(range(self.count))
        if not self.is_against:
            return numbers
        return numbers[::-1] if self.range is not None else [0, *numbers[:0:-1]]

    @property
    def travel(self) -> float:
        """Range of the crank, degrees: a turn or two, or its limits."""
        return TURN * self.turns if self.range is None else self.range[1] - self.range[0]

    @property
    def first(self) -> float:
        """Offset of position 0 from the start, in intervals: half of one from a limit."""
        return 0.0 if self.range is None else 0.5

    def at(self, fractions: Reals) -> Reals:
        """Return the driver positions after shares of the way from zero, or from a limit, on."""
        start = self.zero if self.range is None else self.range[:: self.sense][0]
        return start + self.sense * self.travel * fractions

    @cached_property
    def extremes(self) -> list[Extreme]:
        """All extreme positions, from position zero on in the sense of the driver."""
        ahead = [(self._distance_to(self.zero, one.phi), one.value) for one in self.turnings]
        return [Extreme(self.zero + self.sense * way, value) for way, value in sorted(ahead)]

    # Pressure angle ------------------------------------------------------------------------------

    @cached_property
    def pressure(self) -> PressureAnglePeak | None:
        """Greatest and least pressure angle on the output link, and where; None: has no meaning."""
        told = pressure_on(self.unit, self.output)
        if told is None:
            return None

        def angle(positions: Reals) -> Reals:
            return told(self.read(positions))

        looks = self._continuous_range[0][: -1 if self.range is None else None]
        values = angle(looks)
        if not np.isfinite(values).any():
            return None
        limits = self.range or (-np.inf, np.inf)
        found = []
        for sign in (1.0, -1.0):
            signed = np.where(np.isnan(values), -np.inf, sign * values)
            padded = np.pad(signed, 1, mode="wrap" if self.range is None else "edge")
            peaks = (signed >= padded[:-2]) & (signed >= padded[2:])
            near = np.flatnonzero(peaks & (signed >= signed.max() - _LEVEL))[:_MOST_TOPS]

            def size(positions: Reals, sign: float = sign) -> Reals:
                return sign * angle(positions)

            ends = (np.clip(looks[near] + step, *limits) for step in (-_STEP, _STEP))
            extreme = np.array([one.phi for one in self.turnings])
            at, sizes = map(np.append, tops(by_rows(size), *ends), (extreme, size(extreme)))
            most = float(np.max(sizes))
            alike = at[sizes >= most - _SAME]
            # Of several places with one value the one that lasts longest, starting from zero.
            flat = np.round(np.nan_to_num(size(alike - 1.0) + size(alike + 1.0), nan=-TURN), 6)
            ways = [self._distance_to(self.zero, float(at)) for at in alike[flat == flat.max()]]
            found += [sign * most, self.zero + self.sense * min(ways)]
        return PressureAnglePeak(*found)


def task_of(problem: Problem) -> CycleTask:
    """Return the task of the cycle; if there is no ``[cycle]``, that of the machine's positions."""
    machine = problem.machine
    if problem.cycle is not None or machine is None:
        return problem.cycle or CycleTask()
    start = problem.drive.positions[0] if machine.start_deg is None else machine.start_deg
    return CycleTask(zero=start, count=round(machine.count / machine.turns))


def crank_cycle_of(solution: Solution) -> CrankCycle:
    """Return the cycle of a solution's mechanism; cached independently of the scales."""
    return _crank_cycle(solution.origin)


@memoized
def _crank_cycle(solution: Solution) -> CrankCycle:
    return CrankCycle(solution)
