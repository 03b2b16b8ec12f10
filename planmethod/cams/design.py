"""The smallest cam within the allowed pressure angles (синтез кулачка), for every angle.

At each angle of the cam the permitted pressure angle confines the cam's axis to two half-planes, as
seen from the roller at its lowest place. Their boundaries are the limiting lines of the drawing.
For an oscillating follower the lines rotate with the arm. The permitted places are thus a convex
set, and the smallest cam has its axis at the point nearest to the roller. That point is found by
exchange: the nearest point of finitely many half-planes, then the angle at which a limit is
exceeded most, until none is. So the extremes are those over all angles, not over a grid.

Both signs of the pressure angle are limited: otherwise a return without a limit would request an
offset as large as the cam. If offset or centre distance is given, one number remains to be found.
Extremes are sought on each smooth part of a law, so that jumps are ends of parts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property, partial
from math import floor, sqrt, tan
from typing import NamedTuple, TypeAlias

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from planmethod.cams.laws import Reals
from planmethod.cams.model import (
    MOVING,
    TURN,
    CamGeometry,
    CamMotion,
    CamPhase,
    CamProblem,
    Closure,
    Complexes,
    Contact,
    Jump,
    Stretch,
)
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate

SAMPLES, FINER, REFINEMENTS = 257, 17, 12

RealFunction = Callable[[Reals], Reals]


def peak(of: RealFunction, start: float, end: float) -> tuple[float, float]:
    """Return the argument and the value of a smooth function's maximum on an interval.

    Every peak of the samples is refined, so that the greater of two nearly equal ones is found.
    """
    x = np.linspace(start, end, SAMPLES)
    with np.errstate(all="ignore"):
        y = np.nan_to_num(of(x), nan=-np.inf)
        padded = np.concatenate([[-np.inf], y, [-np.inf]])
        tops = np.flatnonzero((y >= padded[:-2]) & (y >= padded[2:]))
        tops = tops[np.argsort(-y[tops])][:8]
        low, high = x[np.maximum(tops - 1, 0)], x[np.minimum(tops + 1, SAMPLES - 1)]
        rows = np.arange(len(tops))
        best, value = x[tops], y[tops]
        for _ in range(REFINEMENTS):
            fine = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, FINER)
            found = np.nan_to_num(of(fine), nan=-np.inf)
            at = np.argmax(found, axis=1)
            better = found[rows, at] > value
            best = np.where(better, fine[rows, at], best)
            value = np.maximum(value, found[rows, at])
            low, high = fine[rows, np.maximum(at - 1, 0)], fine[rows, np.minimum(at + 1, FINER - 1)]
    k = int(np.argmax(value))
    return float(best[k]), float(value[k])


def nearest_to_origin(normals: Reals, bounds: Reals) -> Reals | None:
    """Return the point nearest to the origin with ``normals @ z <= bounds``, or None.

    The few binding ones are found one by one, the most violated first: a law of a hundred parts has
    thousands of them, and millions of corners.

    Parameters
    ----------
    normals : array of float, shape (n, 2)
    bounds : array of float, shape (n,)
    """
    length = np.hypot(*normals.T)
    unit, off = normals / length[:, None], bounds / length
    slack = 1e-12 * np.max(np.abs(off))
    point: Reals | None = np.zeros(2)
    binding: list[int] = []
    while point is not None:
        broken = unit @ point - off
        k = int(np.argmax(broken))
        if broken[k] <= slack:
            return point
        binding.append(k)
        point = _nearest_corner(unit[binding], off[binding], slack)
    return None


def _nearest_corner(unit: Reals, off: Reals, tolerance: float) -> Reals | None:
    """Return the nearest foot or corner of a few lines that keeps to all of them, or None."""
    i, j = np.triu_indices(len(unit), 1)
    det = unit[i, 0] * unit[j, 1] - unit[i, 1] * unit[j, 0]
    with np.errstate(all="ignore"):
        corners = np.array(
            [
                (off[i] * unit[j, 1] - off[j] * unit[i, 1]) / det,
                (unit[i, 0] * off[j] - unit[j, 0] * off[i]) / det,
            ]
        ).T
    tried = np.concatenate([unit * off[:, None], corners])
    tried = tried[np.all(np.isfinite(tried), axis=1)]
    kept = tried[np.all(tried @ unit.T <= off + tolerance, axis=1)]
    return np.asarray(kept[np.argmin(np.hypot(*kept.T))]) if len(kept) else None


def first_nonpositive(
    rough: Callable[[float], float], exact: Callable[[float], float], candidates: Reals
) -> float | None:
    """Return the first number at which a function is not positive; None if it is positive.

    Parameters
    ----------
    rough, exact : callable
        The function from below, and as it is: where the rough one is positive, so is the other.
    candidates : array of float
        Numbers in order, the steps of the search.
    """
    for k, x in enumerate(candidates):
        if rough(float(x)) > 0 or exact(float(x)) > 0:
            continue
        if not k:
            return float(x)
        low, high = float(candidates[k - 1]), float(x)
        above, below = exact(low), exact(high)
        for _ in range(100):  # regula falsi; an end that stays weighs half
            middle = high - below * (high - low) / (below - above)
            if not low < middle < high:
                break
            value = exact(middle)
            if value <= 0:
                high, below, above = middle, value, above / 2
            else:
                low, above, below = middle, value, below / 2
        return high
    return None


def minimize(
    of: Callable[[float], float], start: float, end: float, *, samples: int = 121
) -> float:
    """Return the minimizer of a function of one number, by finer and finer grids."""
    for _ in range(14):
        x = np.linspace(start, end, samples)
        k = int(np.argmin([of(float(one)) for one in x]))
        start, end, samples = x[max(k - 1, 0)], x[min(k + 1, samples - 1)], 9
    return float((start + end) / 2)


Flags: TypeAlias = NDArray[np.bool_]

ROUNDS = 40

OF_R_MIN, OF_RHO = 0.4, 0.8
"""Maximum ratios of a chosen roller's radius to r_min and to the minimum radius of curvature."""

STEP = 0.0005
"""Radius of a chosen roller is a multiple of this, m."""


class Bound(NamedTuple):
    """A limiting line that binds: motion, angle of the cam (rad), side (+1: ϑ at its limit)."""

    motion: CamMotion
    phi: float
    sign: int

    @property
    def phase(self) -> CamPhase:
        """Whether the limit is that of the rise or of the return."""
        return self.motion.phase


class CamExtreme(NamedTuple):
    """An extreme value, and its angle of the cam, rad."""

    value: float
    phi: float


class Undercut(NamedTuple):
    """Undercut of a profile (подрез): the worst angle and the range, rad.

    ``rho``: radius of curvature of the theoretical profile there, m; ``point`` in the frame of the
    cam, m; ``outer``: on the outer side of a groove.
    """

    phi: float
    start: float
    end: float
    rho: float
    point: complex
    outer: bool


class CamDesign(Struct, frozen=True, dict=True):
    """A solved cam (решение): its sizes, extremes, faults.

    Raises
    ------
    ProblemError
        On first use: no place of the axis keeps the allowed angles; sizes do not go together.
    """

    problem: CamProblem

    # Places of the axis ---------------------------------------------------------------------------

    def velocity_end(self, motion: Reals) -> tuple[Complexes, Complexes]:
        """Return D from the roller at rest, m, and the rotation to an upright follower path.

        The frame is that of the follower: at rest it moves along +y; the pivot is at ``side·arm``.
        """
        one = self.problem
        s, v, _ = motion
        if not one.oscillates:
            return 1j * s - v, np.ones_like(s) + 0j
        side = self.side
        turn = np.exp(-1j * side * s / one.arm)
        return side * one.arm * (1 - turn) - v * turn, 1 / turn

    @property
    def side(self) -> int:
        """1 where an arm has its pivot on the right: it rises against the cam's turning."""
        return CamGeometry(self.problem, 1.0).side

    def half_planes(self, stretch: Stretch, phi: Reals, sign: int) -> tuple[Reals, Reals, Reals]:
        """Return a, b, c of ``a·x + b·y <= c`` for the axis at (x, y) from the roller at rest."""
        limit = self.problem.limit(stretch.phase)
        assert limit is not None
        end, turn = self.velocity_end(self.problem.on(stretch, phi))
        normal = np.conj(turn * (sign - 1j * tan(limit)))
        return normal.real, normal.imag, np.real(end * np.conj(normal))

    def limited(self) -> Iterator[tuple[Stretch, int]]:
        """Yield the smooth parts with a limit, and its side."""
        for stretch in self.problem.stretches:
            if stretch.phase in MOVING and self.problem.limit(stretch.phase) is not None:
                yield from ((stretch, 1), (stretch, -1))

    def _excess(self, x: float, y: float, stretch: Stretch, sign: int, phi: Reals) -> Reals:
        a, b, c = self.half_planes(stretch, phi, sign)
        return np.asarray((a * x + b * y - c) / np.hypot(a, b))

    def worst(self, x: float, y: float) -> tuple[float, list[tuple[Stretch, float, int]]]:
        """Return the excess of an axis over each limit, m, and the angle of its maximum."""
        found, most = [], -np.inf
        for stretch, sign in self.limited():
            excess = partial(self._excess, x, y, stretch, sign)
            phi, value = peak(excess, stretch.start, stretch.end)
            found.append((stretch, phi, sign))
            most = max(most, value)
        return most, found

    @cached_property
    def _sampled(self) -> list[tuple[Stretch, int, Reals]]:
        """The smooth parts with a limit, and the unit half-planes of their samples."""
        found = []
        for stretch, sign in self.limited():
            phi = np.linspace(stretch.start, stretch.end, SAMPLES)
            planes = np.array(self.half_planes(stretch, phi, sign))
            found.append((stretch, sign, planes / np.hypot(planes[0], planes[1])))
        return found

    def greatest_excess(self, x: float, y: float) -> float:
        """Return the greatest excess of `worst`, m, from the parts that may have it.

        Between samples a part exceeds its greatest sample by less than the greatest second
        difference of the samples.
        """
        rows = [x * a + y * b - c for _, _, (a, b, c) in self._sampled]
        tops = [float(np.max(row)) for row in rows]
        bends = [float(np.max(np.abs(np.diff(row, 2)))) for row in rows]
        limit, most = max(tops), -np.inf
        for (stretch, sign, _), top, bend in zip(self._sampled, tops, bends, strict=True):
            if top + bend >= limit:
                excess = partial(self._excess, x, y, stretch, sign)
                most = max(most, peak(excess, stretch.start, stretch.end)[1])
        return most

    @cached_property
    def axis(self) -> complex:
        """Place of the axis from the roller at rest, m: as given, else the nearest permissible."""
        one = self.problem
        if one.r_min is not None:
            return self._at_distance(one.r_min)
        if one.oscillates and one.centre is not None:
            return self._around_pivot(one.centre)
        if not one.oscillates and one.offset is not None:
            return self._under(one.offset)
        return self._nearest()

    def _nearest(self) -> complex:
        """Return the permissible place that is nearest to the roller at rest."""
        rows: list[tuple[float, ...]] = []
        for stretch, sign in self.limited():
            phi = np.linspace(stretch.start, stretch.end, 9)
            planes = self.half_planes(stretch, phi, sign)
            rows += [tuple(map(float, plane)) for plane in zip(*planes, strict=True)]
        place = 0j
        for _ in range(ROUNDS):
            table = np.array(rows)
            point = nearest_to_origin(table[:, :2], table[:, 2])
            if point is None:
                raise self._impossible()
            place = complex(float(point[0]), float(point[1]))
            most, worst = self.worst(place.real, place.imag)
            if most <= 1e-15 * self.problem.stroke:
                break
            for stretch, angle, sign in worst:
                plane = self.half_planes(stretch, np.array(angle), sign)
                rows.append(tuple(map(float, plane)))
        return place

    def _under(self, e: float) -> complex:
        """Return the highest permissible place at an offset of the follower's line."""

        def depth(stretch: Stretch, sign: int, phi: Reals) -> Reals:
            a, b, c = self.half_planes(stretch, phi, sign)
            return np.asarray((-a * e - c) / b)

        deep = max(
            peak(partial(depth, *one), one[0].start, one[0].end)[1] for one in self.limited()
        )
        return complex(-e, -max(deep, 0.0))

    def _around_pivot(self, centre: float) -> complex:
        """Return the permissible place nearest to the roller at a distance from the pivot."""
        pivot, side = self.side * self.problem.arm, self.side

        def at(delta: float) -> complex:
            return pivot - side * centre * complex(np.exp(1j * side * delta))

        def broken(delta: float) -> float:
            z = at(delta)
            return self.greatest_excess(z.real, z.imag)

        planes = [
            self.half_planes(one, np.linspace(one.start, one.end, 65), sign)
            for one, sign in self.limited()
        ]
        x, y, bound = (np.concatenate(part) for part in zip(*planes, strict=True))

        def roughly(delta: float) -> float:
            z = at(delta)
            return float(np.max(x * z.real + y * z.imag - bound))

        delta = first_nonpositive(roughly, broken, np.linspace(0.0, np.pi, 361)[1:-1])
        if delta is None:
            raise self._impossible()
        return at(delta)

    def _at_distance(self, r_min: float) -> complex:
        """Return the place at a distance from the roller: by offset or pivot, else the mildest."""
        one = self.problem
        if one.oscillates and one.centre is not None:
            arm, a = one.arm, one.centre
            delta = float(np.arccos((a * a + arm * arm - r_min**2) / (2 * a * arm)))
            return self.side * (arm - a * complex(np.exp(1j * self.side * delta)))
        if not one.oscillates and one.offset is not None:
            return complex(-one.offset, -sqrt(r_min**2 - one.offset**2))

        def broken(angle: float) -> float:
            return self.greatest_excess(r_min * np.cos(angle), r_min * np.sin(angle))

        angle = minimize(broken, -np.pi, 0.0)
        return r_min * complex(np.exp(1j * angle))

    def _impossible(self) -> ProblemError:
        message = translate(
            "no place of the axis keeps the allowed pressure angles at every position"
        )
        hint = "Allow greater angles, take a smaller swing, longer phases or another centre."
        return ProblemError(self.problem.name, [Fault("cam.pressure", message, hint)])

    # Sizes ----------------------------------------------------------------------------------------

    @cached_property
    def pitch_geometry(self) -> CamGeometry:
        """Geometry of the pitch curve, or of the cam under the flat face."""
        one = self.problem
        if one.contact is not Contact.FLAT:
            z = self.axis
            if one.oscillates:
                return CamGeometry(one, abs(z), centre=abs(z - self.side * one.arm))
            return CamGeometry(one, abs(z), e=-z.real)
        e = one.offset or 0.0
        if one.oscillates:
            assert one.centre is not None
            return CamGeometry(
                one, one.r_min or self._min_plate_distance(one.centre), centre=one.centre
            )
        if one.r_min is not None:
            return CamGeometry(one, one.r_min, e=e)
        found = self.highest(lambda stretch, phi: -np.sum(one.on(stretch, phi)[::2], axis=0))
        if found.value + one.min_radius <= 0:
            what = translate("any r_min leaves the profile convex")
            raise ProblemError(one.name, [Fault("cam.r_min", what, "Give r_min, or curvature.")])
        return CamGeometry(one, found.value + one.min_radius, e=e)

    def _min_plate_distance(self, centre: float) -> float:
        """Return the minimum distance of a swinging flat face for a convex enough profile."""
        one = self.problem

        def broken(delta: float) -> float:
            trial = CamGeometry(one, centre * np.sin(delta), centre=centre)
            return self.highest(
                lambda stretch, phi: one.min_radius - self._rho(trial, stretch, phi)
            ).value

        def roughly(delta: float) -> float:
            trial = CamGeometry(one, centre * np.sin(delta), centre=centre)
            rho = [
                np.min(self._rho(trial, part, np.linspace(part.start, part.end, 33)))
                for part in one.stretches
            ]
            return one.min_radius - float(min(rho))

        most = np.pi / 2 - one.stroke / one.arm
        delta = first_nonpositive(roughly, broken, np.linspace(0.0, most, 91)[1:-1])
        if delta is None:
            what = translate("no r_min keeps the profile convex under the plate")
            hint = "Increase centre, decrease the swing, or lengthen the phases."
            raise ProblemError(one.name, [Fault("cam.centre", what, hint)])
        return float(centre * np.sin(delta))

    def highest(self, of: Callable[[Stretch, Reals], Reals]) -> CamExtreme:
        """Return the greatest value of a function over the turn."""
        found = [
            (value, phi)
            for stretch in self.problem.stretches
            for phi, value in [peak(partial(of, stretch), stretch.start, stretch.end)]
        ]
        return CamExtreme(*max(found))

    def _rho(self, of: CamGeometry, stretch: Stretch, phi: Reals) -> Reals:
        with np.errstate(divide="ignore"):
            return 1 / of.points(phi, self.problem.on(stretch, phi)).curvature

    def _curvature(self, sign: int, stretch: Stretch, phi: Reals) -> Reals:
        return sign * self.pitch_geometry.points(phi, self.problem.on(stretch, phi)).curvature

    @cached_property
    def rho_min(self) -> CamExtreme:
        """Least radius of curvature of the convex theoretical profile, m; 0 at a corner."""
        if self.problem.contact is Contact.FLAT:
            low = self.highest(lambda stretch, phi: -self._rho(self.pitch_geometry, stretch, phi))
            return CamExtreme(-low.value, low.phi)
        for jump in self.problem.jumps:
            if jump.order == 1 and self._turns(jump) < 0:
                return CamExtreme(0.0, jump.phi)
        value, phi = self.highest(partial(self._curvature, 1))
        return CamExtreme(1 / value if value > 0 else float("inf"), phi)

    def _turns(self, jump: Jump) -> float:
        """Return the turn of the profile at a jump, rad; negative where it is convex."""
        phi = np.array(jump.phi)
        first, second = (
            self.pitch_geometry.points(phi, at).normal for at in (jump.before, jump.after)
        )
        return float(np.angle(second / first))

    @cached_property
    def hollow(self) -> CamExtreme:
        """Least radius of curvature of the concave theoretical profile, m; infinite without."""
        value, phi = self.highest(partial(self._curvature, -1))
        return CamExtreme(1 / value if value > 0 else float("inf"), phi)

    @cached_property
    def geometry(self) -> CamGeometry:
        """The cam with its roller."""
        one, bare = self.problem, self.pitch_geometry
        if one.contact is not Contact.ROLLER:
            return bare
        if one.roller is not None:
            return replace(bare, roller=one.roller)
        limits = [OF_RHO * self.rho_min.value]
        if one.closure is Closure.FORM:
            limits.append(OF_RHO * self.hollow.value)
        # A roller cannot roll over a corner: the undercut is reported then.
        most = min([OF_R_MIN * bare.r_min, *(limit for limit in limits if limit > 0)])
        return replace(bare, roller=floor(most / STEP + 1e-9) * STEP if most > 2 * STEP else most)

    def pressure(self, phase: CamPhase) -> CamExtreme:
        """Return the greatest size of the pressure angle of rise or return, rad."""
        return CamExtreme(*max(found for part, found in self._steepest if part is phase))

    @cached_property
    def _steepest(self) -> tuple[tuple[CamPhase, tuple[float, float]], ...]:
        """Greatest pressure angle of every part of the motion, and where it is, rad."""
        return tuple(
            (part.phase, peak(partial(self._pressure, part), part.start, part.end)[::-1])
            for part in self.problem.stretches
            if part.phase in MOVING
        )

    def _pressure(self, stretch: Stretch, phi: Reals) -> Reals:
        return np.abs(self.pitch_geometry.points(phi, self.problem.on(stretch, phi)).pressure)

    @cached_property
    def bounds(self) -> tuple[Bound, ...]:
        """The limiting lines that pass through the axis, at most two; none if none binds."""
        z = self.axis
        most = 1e-7 * abs(z)
        found: dict[complex, Bound] = {}
        for stretch, phi, sign in self.worst(z.real, z.imag)[1]:
            a, b, c = self.half_planes(stretch, np.array(phi), sign)
            size = float(np.hypot(a, b))
            if abs(float(a * z.real + b * z.imag - c)) < most * size:
                # Lines through one point that have one direction are one line.
                way = complex(a, b) / size
                known = next((one for one in found if abs(one - way) < 1e-5), way)
                found[known] = Bound(stretch.motion, phi, sign)
        return tuple(found.values())[:2]

    # Faults ---------------------------------------------------------------------------------------

    @cached_property
    def undercut(self) -> Undercut | None:
        """Undercut parts of the profile, which the roller, or the flat face, does not touch."""
        one, geometry = self.problem, self.geometry
        if one.contact is Contact.POINTED:
            return None
        rho, phi = self.rho_min
        if one.contact is Contact.FLAT:
            if rho >= -1e-12:
                return None
            return self._cut(phi, rho, False, lambda k: k < 0)
        size = geometry.roller
        if rho < size * (1 - 1e-12):
            return self._cut(phi, rho, False, lambda k: k * size > 1)
        hollow, phi = self.hollow
        if one.closure is Closure.FORM and hollow < size * (1 - 1e-12):
            return self._cut(phi, -hollow, True, lambda k: -k * size > 1)
        return None

    def _cut(
        self, phi: float, rho: float, outer: bool, is_cut: Callable[[Reals], Flags]
    ) -> Undercut:
        """Return an undercut with its range of angles."""
        offsets = np.linspace(0.0, np.pi, 20001)[1:]  # at phi itself the curvature may jump

        def reach(direction: int) -> float:
            cut = is_cut(self.geometry.at(phi + direction * offsets).curvature)
            return float(offsets[np.argmin(cut)]) if cut[0] else 0.0

        at = self.geometry.at(np.array([phi]))
        point = complex((at.outer if outer else at.actual)[0])
        return Undercut(phi, phi - reach(-1), phi + reach(1), rho, point, outer)


def design_of(problem: CamProblem) -> CamDesign:
    """Return the design of a cam, made at the first call: each of its extremes is sought once."""
    found: CamDesign = vars(problem).setdefault("design", CamDesign(problem))
    return found


class CamNode(Struct, frozen=True):
    """A division of the axis of angles (точка деления): its number, motion and angle, rad.

    ``starts`` and ``ends``: it is the first or the last one of its motion.
    """

    number: int
    motion: CamMotion
    phi: float
    starts: bool
    ends: bool


def ends(problem: CamProblem, stretch: Stretch) -> Reals:
    """Return s, v_q, a_q along a smooth part, its ends from within, shape (3, 33)."""
    return problem.on(stretch, np.linspace(stretch.start, stretch.end, 33))


def outline(design: CamDesign) -> Complexes:
    """Return the theoretical profile and the outer side of a groove, in the frame of the cam, m."""
    at = design.geometry.at(np.linspace(0.0, TURN, 721))
    return np.concatenate([at.theoretical, at.outer])


def is_plate(design: CamDesign) -> bool:
    """Return whether the follower is flat-faced."""
    return design.problem.contact is Contact.FLAT


def nodes_of(problem: CamProblem) -> tuple[CamNode, ...]:
    """Return the divisions of rises and returns, numbered; a dwell has none of its own.

    The first one begins the turn, in a dwell, too. Two motions without a dwell between them share
    one, unless v_q jumps there: the second begins with another velocity.
    """
    found: list[CamNode] = []
    broken = [jump.phi for jump in problem.jumps if jump.order == 1]
    first, last = problem.motions[0], problem.motions[-1]
    if first.phase not in MOVING:
        found.append(CamNode(0, first, 0.0, starts=True, ends=True))
    before: CamMotion | None = None
    for motion in problem.motions:
        if motion.phase in MOVING:
            has_jump = any(abs(phi - motion.start) < 1e-9 for phi in broken)
            is_shared = before is not None and before.phase in MOVING and not has_jump
            for k in range(is_shared, problem.parts + 1):
                phi = motion.start + motion.length * k / problem.parts
                is_end = k == problem.parts
                found.append(CamNode(len(found), motion, phi, starts=k == 0, ends=is_end))
        before = motion
    if last.phase in MOVING:
        found.pop()  # the next turn begins
    return tuple(found)


def stretch_of(problem: CamProblem, node: CamNode) -> Stretch:
    """Return the smooth part that a division ends, of the first one of a phase that it begins."""
    own = [one for one in problem.stretches if one.motion == node.motion]
    return next(one for one in own if node.starts or node.phi <= one.end + 1e-9)


def motion_in_division(problem: CamProblem, node: CamNode) -> Reals:
    """Return s, v_q, a_q in a division, m, from within its phase."""
    return problem.on(stretch_of(problem, node), np.array(node.phi))


def step_between(problem: CamProblem, start: float, end: float) -> float:
    """Return the height of the step that replaces a_q between two divisions, m.

    The rectangle has the area under a_q: so the chords of v_q end on its curve.
    """
    gained = 0.0
    for one in problem.stretches:
        low, high = max(start, one.start), min(end, one.end)
        if low < high:
            before, after = problem.on(one, np.array([low, high]))[1]
            gained += after - before
    return float(gained / (end - start))
