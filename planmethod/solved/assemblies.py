"""Assemblies of a triad, and one of them over the positions (сборки группы III класса).

In one position: the base link is rotated as a virtual crank, two legs locate it, and the residual
of the third is a smooth function of the angle. Its zeros are bracketed, bisected and refined by
Newton's method. From position to position Newton's method starts from the extrapolated motion, with
steps as short as necessary.

The start of `TriadPose` in each position is interpolated between the places of a tracked assembly
(`TrackedAssembly`): it is data of the step, so every arithmetic finds the same pose. The
determinant of the lines of the three legs has one sign along an assembly, and is zero in a dead
position, where the assembly ends. The plans need nothing more: the point where the lines of two
legs meet (особая точка Ассура) moves as two rays say. There are three such points; the one nearest
to the link is used.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from msgspec import Struct

from planmethod.construct.arithmetic import Float64, Single
from planmethod.construct.evaluate import Trace, evaluate, place, solve_pose
from planmethod.construct.program import Program
from planmethod.construct.steps import Leg, PointName, TriadPose
from planmethod.errors import Fault
from planmethod.languages import translate
from planmethod.mechanism.groups import AssurGroup, Triad
from planmethod.plans.draft import Draft
from planmethod.plans.model import AssemblyMode, TrackedAssembly
from planmethod.plans.motion.position import axis_of_link, base_points
from planmethod.problem.model import AssemblyRelation, Rule
from planmethod.problem.names import format_place
from planmethod.solved.failures import Cause, Failure, Place, PositionError
from planmethod.solved.reading import Complexes, Reading, Reals
from planmethod.solved.rules import rule_text, score_of

SAMPLES = 1440
"""Number of samples of the virtual crank over a full turn."""

DEAD = 1e-7
"""Margin below which an assembly is in a dead position: two of them coincide there."""

_HALVINGS, _ROUNDS = 50, 12
Env: TypeAlias = dict[Any, Any]
Read: TypeAlias = Callable[[Reals], Trace]
"""Reads the plan up to a group in some positions."""


class Assembly(Struct, frozen=True):
    """One assembly (сборка): the pose of the base link.

    Its origin, m, the direction of its axis, degrees, and the margin.
    """

    origin: complex
    turn: float
    margin: float


def env_of(step: TriadPose, trace: Trace, index: int) -> Env:
    """Return the operands of a step in one position of a reading, in Python's own numbers."""
    one = Single()
    found: Env = {}
    names = [name for leg in step.legs for name in (leg.centre, leg.line, leg.radius, leg.angle)]
    names += [name for leg in step.legs for name in leg.at]
    for name in names:
        if name is None:
            continue
        value = trace.value[name]
        parts = value if isinstance(value, tuple) else (value,)
        alone = [one.lift(p[index] if np.ndim(p) else p) for p in parts]
        found[name] = tuple(alone) if isinstance(value, tuple) else alone[0]
    return found


def assemblies(step: TriadPose, env: Env) -> list[Assembly]:
    """Return every pose in which three legs hold a base link in one position, except dead ones.

    Parameters
    ----------
    env : dict
        Of `env_of`.
    """
    with np.errstate(all="ignore"):
        starts = _starts([_leg_condition(leg, env) for leg in step.legs])
        pose, margin, _ = _refine(step, env, *starts)
    size = sum(abs(place(leg.at, env)) for leg in step.legs)
    found: list[Assembly] = []
    for b, w, room in zip(*pose, margin, strict=True):
        same = any(
            abs(b - other.origin) + size * abs(w - np.exp(1j * np.radians(other.turn)))
            < DEAD * size
            for other in found
        )
        if room > DEAD and not same:
            found.append(Assembly(complex(b), float(np.degrees(np.angle(w))), float(room)))
    return sorted(found, key=lambda pose: pose.turn)


def _refine(step: TriadPose, env: Env, b: Complexes, turn: Reals) -> tuple[Any, Any, Any]:
    x, y, angle = step.start
    data = {name: np.asarray(value) for name, value in env.items() if not isinstance(value, tuple)}
    lines = {name: tuple(map(np.asarray, v)) for name, v in env.items() if isinstance(v, tuple)}
    whole = {**data, **lines, x: b.real, y: b.imag, angle: np.degrees(turn)}
    return solve_pose(step, whole, Float64(), _ROUNDS)


def _leg_condition(leg: Leg, env: Env) -> Callable[[Reals], tuple[Any, Any, Any, Any]]:
    """Return the constraint of a leg on the origin at a given angle of the link.

    Either a distance from a centre (centre, radius), or a coordinate along a normal (normal,
    coordinate); the other two are None.
    """
    z = place(leg.at, env)

    def condition(turn: Reals) -> tuple[Any, Any, Any, Any]:
        w = np.exp(1j * turn)
        if leg.line is not None:
            p, u = env[leg.line]
            normal = np.broadcast_to(1j * u / abs(u), w.shape)
            return None, None, normal, (normal.conjugate() * (p - w * z)).real
        centre = env[leg.centre] - w * z
        if leg.radius is not None:
            return centre, env[leg.radius], None, None
        angle = 0.0 if leg.angle is None else env[leg.angle]
        normal = w * (1j * np.exp(1j * np.radians(angle)))
        return None, None, normal, (normal.conjugate() * centre).real

    return condition


class _CrankTrial(Struct, frozen=True):
    """Residuals and places at some angles of the virtual crank.

    ``off``: residual of the third leg; ``places``: possible places of the origin.
    """

    off: Reals
    places: list[Complexes]


def _try_crank(
    conditions: list[Callable[[Reals], tuple[Any, Any, Any, Any]]], turn: Reals
) -> _CrankTrial:
    """Turn the virtual crank: two circles have a straight line in common, and all is linear."""
    circle: tuple[Any, Any] | None = None
    rows: list[tuple[Any, Any]] = []
    for ask in conditions:
        centre, radius, normal, along = ask(turn)
        if normal is not None:
            rows.append((normal, along))
        elif circle is None:
            circle = centre, radius
        else:
            apart = centre - circle[0]
            power = abs(centre) ** 2 - abs(circle[0]) ** 2 - radius**2 + circle[1] ** 2
            rows.append((apart, power / 2))
    (m, f), (n, g) = rows[:2]
    det = (m.conjugate() * n).imag
    point = -1j * (f * n - g * m)  # by the determinant
    if circle is None:
        o, h = rows[2]
        return _CrankTrial(
            np.asarray((o.conjugate() * point).real - h * det), [np.asarray(point / det)]
        )
    centre, radius = circle
    places = [point / det]
    for normal, along in rows:
        long = abs(normal)
        leg = (along - (normal.conjugate() * centre).real) / long
        half = np.sqrt(np.maximum(radius**2 - leg**2, 0.0))
        places += [centre + normal / long * (leg + side * 1j * half) for side in (1, -1)]
    return _CrankTrial(np.asarray(abs(point - centre * det) ** 2 - (radius * det) ** 2), places)


def _starts(conditions: list[Any]) -> tuple[Complexes, Reals]:
    """Return places and angles near every assembly, also near those that nearly are one."""
    looks = 0.3 + np.linspace(0.0, 2 * np.pi, SAMPLES + 1)
    off = _try_crank(conditions, looks).off
    size = np.abs(off)
    crossed = np.flatnonzero(np.sign(off[:-1]) != np.sign(off[1:]))
    low, high = looks[crossed], looks[crossed + 1]
    sign = np.sign(off[crossed])
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        before = np.sign(_try_crank(conditions, middle).off) == sign
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    # A double zero is a minimum that touches zero, or crosses it twice between two samples.
    around = np.concatenate([size[-2:-1], size, size[1:2]])
    least = np.flatnonzero((size <= around[:-2]) & (size <= around[2:]))
    step = looks[1] - looks[0]
    fine = (looks[least][:, None] + np.linspace(-step, step, 33)).ravel()
    turns = np.concatenate([(low + high) / 2, fine])
    places = _try_crank(conditions, turns).places
    everywhere = [np.broadcast_to(p, turns.shape) for p in places]
    return np.concatenate(everywhere), np.tile(turns, len(everywhere))


# Which of them is meant ---------------------------------------------------------------------------


class Assembled(Struct, frozen=True):
    """A triad drawn up to its group, before an assembly is chosen (группа, ещё не собранная).

    Attributes
    ----------
    draft, program
        Of the position plan up to the group.
    data : callable
        Returns the plan's data at unit scales for some positions, ndarray of shape (n,).
    """

    draft: Draft
    program: Program
    data: Callable[[Reals], dict[str, Any]]
    group: AssurGroup
    triad: Triad

    @property
    def point(self) -> str:
        """Point of the base link that distinguishes the assemblies."""
        return base_points(self.draft.problem, self.triad)[0]

    @property
    def step(self) -> TriadPose:
        """The step that holds the base link."""
        steps = (step for step in self.program.steps if isinstance(step, TriadPose))
        return next(step for step in steps if step.out == axis_of_link(self.triad.base))

    def read(self, positions: Reals) -> Trace:
        """Read the plan in some positions."""
        return evaluate(self.program, self.data(positions), Float64())

    def posed(self, position: float, pose: Assembly) -> Reading:
        """Read the plan in one position with the group in a certain pose."""
        at = np.array([position])
        told = (pose.origin.real, pose.origin.imag, pose.turn)
        names = (f"start_{what}_{self.triad.base}" for what in ("x", "y", "turn"))
        data = {**self.data(at), **{n: np.array([v]) for n, v in zip(names, told, strict=True)}}
        return Reading(evaluate(self.program, data, Float64()), 1)


def choose(
    assembled: Assembled, rules: list[Rule], positions: Reals
) -> tuple[AssemblyMode, list[Fault]]:
    """Return the tracked assembly of a triad that its rules select, and the faults of the rules.

    Raises
    ------
    PositionError
        The triad cannot be assembled in any requested position.
    """
    problem, trace = assembled.draft.problem, assembled.read(positions)
    found = (
        assemblies(assembled.step, env_of(assembled.step, trace, k)) for k in range(len(positions))
    )
    index, poses = next(((k, poses) for k, poses in enumerate(found) if poses), (-1, []))
    if not poses:
        place = Place.of(problem, positions, 0)
        links, count = ", ".join(assembled.group.links), len(positions)
        raise PositionError(
            Failure(Cause.NO_ASSEMBLY, place, links, same_count=count - 1, count=count)
        )
    start = float(positions[index])
    readings = [assembled.posed(start, pose) for pose in poses]
    left = list(range(len(poses)))
    for rule in (rule for rule in rules if rule.relation is not AssemblyRelation.NEAR):
        left = [k for k in left if score_of(rule, assembled.draft, readings[k])[0] > 0]
    for rule in (rule for rule in rules if rule.relation is AssemblyRelation.NEAR and left):
        left = [max(left, key=lambda k: float(score_of(rule, assembled.draft, readings[k])[0]))]
    point = rules[0].point if rules else assembled.point
    places = [complex(one.point(PointName(point))[0]) + assembled.draft.origin for one in readings]
    if len(left) != 1:
        at = Place.of(problem, positions, index).driver
        return AssemblyMode(), [
            _ambiguity_fault(assembled, rules, point, [places[k] for k in left] or places, at)
        ]
    (k,) = left
    sizes = [abs(length) for _, _, length in problem.lengths]
    reach = (min(positions) - sum(sizes), max(positions) + sum(sizes))
    turn = problem.drive.coordinate.turn
    path = track_assembly(assembled.step, assembled.read, start, poses[k], reach, turn)
    others = tuple(place for number, place in enumerate(places) if number != k)
    return AssemblyMode(start=start, tracked=path, other_places=others, point=point), []


def _ambiguity_fault(
    assembled: Assembled, rules: list[Rule], point: str, places: list[complex], at: str
) -> Fault:
    """Return the fault of rules that do not select one of several assemblies."""
    unit = assembled.draft.problem.unit
    told = [f"({format_place(place, unit)})" for place in places]
    facts = (
        ", ".join(assembled.group.links),
        len(told),
        at,
        point,
        translate(" or ").join(told),
        translate(unit),
    )
    if rules:
        phrase = translate(" and ").join(rule_text(rule, unit) for rule in rules)
        text = translate(
            "'{}' does not distinguish the assemblies of links {}, of which there are {} at "
            "{}: with {} at {} {}",
            phrase,
            *facts,
        )
    else:
        text = translate(
            "links {} can be assembled in {} ways at {}, with {} at {} {}, and no rule selects one",
            *facts,
        )
    hint = translate(
        "Add {} = {{ near = [{}] }} to [assembly], or another of these places",
        point,
        told[0].strip("()"),
    )
    return Fault(f"assembly.{point}", text, hint)


def best_third(assembled: Assembled, positions: Reals) -> int:
    """Return the leg to leave out: the special point of the other two stays nearest to the link.

    ``assembled`` has its assembly chosen.
    """
    trace = assembled.read(positions)
    lines = assembled.draft.special[assembled.triad.base].lines
    about = trace.value[PointName(assembled.point)]
    far = []
    with np.errstate(all="ignore"):
        for third in range(3):
            (p, u), (q, v) = (trace.value[line] for k, line in enumerate(lines) if k != third)
            across = (np.conj(u) * v).imag
            point = p + u * ((np.conj(q - p) * v).imag / across)
            away = np.abs(point - about)
            held = np.broadcast_to(np.isfinite(about), positions.shape)
            away = np.broadcast_to(np.where(np.isfinite(away), away, np.inf), positions.shape)
            far.append(float(np.max(away[held], initial=0.0)))
    return min((2, 1, 0), key=far.__getitem__)


# Over the positions -------------------------------------------------------------------------------

_LONGEST = 1.0
"""Maximum step of a crank, degrees."""

_SHORTEST = 1e-7
"""Fraction of that step at which the motion is considered to have ended."""

_MAX_DEVIATION = 0.02
"""Greatest deviation of Newton's method from the extrapolated motion, radians and sizes."""

_MAX_DISTANCE = 1e3
"""Greatest distance that a base link may move away, in its sizes: a guide is not endless."""

_TURNS = 6
"""Number of turns after which each of six assemblies repeats, if they pass into one another."""


class _Path(Struct):
    """Poses of a motion so far, and its continuation (путь сборки)."""

    step: TriadPose
    read: Read
    size: float
    places: list[float]
    origins: list[complex]
    turns: list[float]
    det: float = 0.0

    def envs(self, positions: Reals) -> list[Env]:
        """Return the operands of the legs in some positions."""
        trace = self.read(positions)
        return [env_of(self.step, trace, k) for k in range(len(positions))]

    def step_to(self, goal: float, env: Env) -> bool:
        """Step to a position where the same assembly is near the extrapolated motion."""
        b, angle, patience = self.origins[-1], self.turns[-1], 5.0
        if len(self.places) > 1:
            share = (goal - self.places[-1]) / (self.places[-1] - self.places[-2])
            b += (b - self.origins[-2]) * share
            angle, patience = angle + (angle - self.turns[-2]) * share, 1.0
        x, y, t = self.step.start
        try:
            (found, w), room, det = solve_pose(
                self.step, {**env, x: b.real, y: b.imag, t: angle}, Single(), 4
            )
        except (ZeroDivisionError, OverflowError):
            return False
        turned = float(np.degrees(np.angle(w * np.exp(-1j * np.radians(angle)))))
        away = abs(found - self.origins[0])
        off = abs(found - b) / (self.size + away) + abs(np.radians(turned))
        near = away < _MAX_DISTANCE * self.size and off < patience * _MAX_DEVIATION
        if not (room > 0 and near and det * (self.det or det) > 0):
            return False
        self.places.append(goal)
        self.origins.append(complex(found))
        self.turns.append(angle + turned)
        self.det = float(det)
        return True

    def advance_to(self, goal: float, env: Env) -> bool:
        """Come to a position by as many steps as that needs; stop where the motion ends."""
        if self.step_to(goal, env):
            return True
        whole = goal - self.places[-1]
        stride = whole / 4
        while self.places[-1] != goal:
            here = self.places[-1]
            middle = goal if abs(goal - here) <= 1.5 * abs(stride) else here + stride
            if self.step_to(middle, self.envs(np.array([middle]))[0]):
                stride *= 2
                continue
            stride /= 4
            if abs(stride) < _SHORTEST * abs(whole):
                return False
        return True

    def is_closed(self) -> bool:
        """Return whether the pose is the first one again."""
        turned = (self.turns[-1] - self.turns[0] + 180.0) % 360.0 - 180.0
        return abs(self.origins[-1] - self.origins[0]) < 1e-6 * self.size and abs(turned) < 1e-4


def track_assembly(
    step: TriadPose,
    read: Read,
    start: float,
    pose: Assembly,
    limits: tuple[float, float],
    turn: float,
) -> TrackedAssembly:
    """Track an assembly from a position to both sides, until it ends or repeats.

    Parameters
    ----------
    start : float
        Position of the driver, degrees or m.
    limits : (float, float)
        Range of a slider.
    turn : float
        Period of the driver: 360, or infinite.
    """
    crank = bool(np.isfinite(turn))
    low, high = (start - _TURNS * turn, start + _TURNS * turn) if crank else limits
    looks = round(turn / _LONGEST) if crank else SAMPLES
    pace = turn / looks if crank else (high - low) / looks
    (env,) = [env_of(step, read(np.array([start])), 0)]
    size = sum(abs(place(leg.at, env)) for leg in step.legs)
    ways = []
    with np.errstate(all="ignore"):
        for sense, limit in ((1, high), (-1, low)):
            path = _Path(step, read, size, [start], [pose.origin], [pose.turn])
            path.step_to(start, env)  # which sign its determinant has
            del path.places[1:], path.origins[1:], path.turns[1:]
            count = int(abs(limit - start) / pace + 1e-9)
            goals = [start + sense * pace * k for k in range(1, 1 + count)]
            for number, goal in enumerate(goals):
                if number % _CHUNK == 0:
                    ready = path.envs(np.array(goals[number : number + _CHUNK]))
                if not path.advance_to(goal, ready[number % _CHUNK]):
                    break
                if crank and (number + 1) % looks == 0 and path.is_closed():
                    closed = path.places[-1] - start
                    return _table(path, _Path(step, read, size, [start], [0j], [0.0]), closed)
            ways.append(path)
    span = ways[0].places[-1] - ways[1].places[-1]
    return _table(ways[0], ways[1], turn if span < turn and crank else 0.0)


_CHUNK = 60  # positions that are read at once


def _table(forward: _Path, back: _Path, period: float = 0.0) -> TrackedAssembly:
    def joined(forth: list[float], before: list[float]) -> tuple[float, ...]:
        return (*before[:0:-1], *forth)

    return TrackedAssembly(
        joined(forward.places, back.places),
        joined([b.real for b in forward.origins], [b.real for b in back.origins]),
        joined([b.imag for b in forward.origins], [b.imag for b in back.origins]),
        joined(forward.turns, back.turns),
        period,
    )
