"""Causes of missing or doubtful results of a position: facts, and the sentence of each."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct import steps
from planmethod.construct.evaluate import Trace, limit_of
from planmethod.construct.program import Program
from planmethod.construct.steps import LineName, NumberName, PointName, Step, operands
from planmethod.errors import AssemblyError
from planmethod.languages import translate
from planmethod.plans.draft import Draft
from planmethod.plans.model import PlanKind, Start
from planmethod.problem.model import Coordinate, Problem
from planmethod.problem.names import format_length
from planmethod.solved.reading import Reading, Reals


class Place(Struct, frozen=True):
    """Position of the driving link (положение ведущего звена).

    Attributes
    ----------
    number : int
        Index among the requested positions, from 0.
    value : float
        Position of the driver, degrees, or m of a slider.
    coordinate : Coordinate
    unit : str
        Unit of the file's lengths.
    is_only : bool
        No other position was requested: its number is not informative.
    """

    number: int
    value: float
    coordinate: Coordinate
    unit: str
    is_only: bool

    @classmethod
    def of(cls, problem: Problem, positions: Reals, index: int) -> Place:
        """Return the position of an index, from 0."""
        value, alone = float(positions[index]) + 0.0, len(positions) == 1
        return cls(index, value, problem.drive.coordinate, problem.unit, alone)

    def numbered(self, number: int, count: int) -> Place:
        """Return the place with its index, from 0, among ``count`` positions."""
        return replace(self, number=number, is_only=count == 1)

    @property
    def driver(self) -> str:
        """Driver position as text: ``phi = 30 deg``."""
        return self.coordinate.format_value(self.value, self.unit)

    def __str__(self) -> str:
        if self.is_only:
            return translate("the position {}", self.driver)
        return translate("position {} ({})", self.number, self.driver)

    @property
    def at(self) -> str:
        """Place as text for the end of a clause."""
        if self.is_only:
            return translate(" at {}", self.driver)
        return translate(" at position {} ({})", self.number, self.driver)


class Cause(Enum):
    """Cause of a position without results: its sentence, and the part for this position only.

    In the sentence ``{at}`` and ``{this}`` are replaced by the position, ``{own}`` by the second
    text; ``{p}`` and ``{l}`` are the points and lengths of a `Failure`.
    """

    NOT_FINITE = ("{problem}: a value is not finite although every step exists.", "")
    NO_NUMBER = ("{This} is not a number.", "")
    AT_LIMIT = ("{This} is at the limit of the possible ones.", "")
    NO_DIRECTION = (
        "Cannot continue{at}: {p[0]} and {p[1]} coincide, so that the line {p[0]}{p[1]} has "
        "no direction. The mechanism is in a dead position there; choose another one.",
        "",
    )
    FORCES = (
        "Cannot close the force plan{at}: the mechanism is in a dead position, where no "
        "forces balance the loads. Choose another position.",
        "",
    )
    NO_ARM = (
        "Cannot balance the crank{at}: the balancing force at {out} points along the crank and has "
        "no arm. Give [balancing_force] another angle.",
        "",
    )
    SAME_ARCS = (
        "Cannot place {out}{at}: arcs from {p[0]} ({l[0]}) and {p[1]} ({l[1]}) coincide, "
        "because {p[0]} and {p[1]} are at one place. This dead position is a change point: "
        "the mechanism may continue either way. Choose another one.",
        "",
    )
    ARCS = (
        "Cannot place {out}{at}: arcs from {p[0]} ({l[0]}) and {p[1]} ({l[1]}) do not meet{own}.",
        ", |{p[0]}{p[1]}| = {l[2]}. Check l_{p[0]}{out}, l_{p[1]}{out}. The arcs miss by "
        "{l[3]}{turn}",
    )
    ARC = (
        "Cannot place {out}{at}: the arc from {p[0]} ({l[0]}) does not reach the guide of "
        "{out}. Check l_{p[0]}{out} and the place of the guide.{own}",
        " It misses by {l[1]}{turn}.",
    )
    TANGENT = (
        "Cannot turn the slotted link about {p[0]}{at}: its line is off {p[0]} by "
        "{l[0]}{own}. Check the offset.",
        ", but {p[1]} is only {l[1]} away",
    )
    GUIDES = (
        "Cannot place {out}{at}: its two guides are parallel. Choose another position, or "
        "check their angles.",
        "",
    )
    NO_ASSEMBLY = (
        "Cannot assemble links {out}{at}: in every position of their base link one of its "
        "three legs does not reach. Check the lengths, or choose another position.",
        "",
    )
    NOT_HELD = (
        "Cannot assemble links {out}{at}: the assembly that was chosen at {reach[0]} exists "
        "only from {reach[1]} to {reach[2]}, where it reaches dead positions. Request "
        "positions between them.",
        "",
    )
    LEGS = (
        "Cannot find the special point {out}{at}: the lines of two legs are parallel. "
        "Choose another position, or this one alone: then two other legs are used.",
        "",
    )
    RAYS = (
        "Cannot close the {plan} plan{at}: the rays that meet in {out} are parallel, "
        "because the mechanism is in a dead position, where the driver does not determine "
        "the velocities. Choose another position.",
        "",
    )
    SIMILAR = (
        "Cannot find {out} by similarity{at}: {p[0]} and {p[1]} of its triangle coincide. "
        "Choose another position.",
        "",
    )
    STEP = (
        "Step {out} is impossible{at}: two points that give a direction coincide there. "
        "Choose another position.",
        "",
    )
    COINCIDENT = (
        "{problem}: at {driver} both assemblies place {out} at one point: the mechanism is "
        "in a dead position, from which it may continue either way. Choose another "
        "position.",
        "",
    )
    NEITHER = (
        "'{out}' holds for neither assembly at {driver}: they miss it by {l[0]} and {l[1]}. "
        "Check the lengths or the rule assembly.{p[0]}.",
        "",
    )
    SPOILT_NEAR = (
        "{problem}: {this} is so near a dead position{own} that rounding spoils its "
        "results.{more} Choose a position further away.",
        " (margin {margin:.1e})",
    )
    SPOILT = (
        "{problem}: {this} depends on such small differences of large values that rounding "
        "spoils its results.{more} Choose a position further away.",
        "",
    )
    SPOILT_FORCES = (
        "{problem}: {this} is so near one in which no forces balance the loads{own} that "
        "rounding spoils its reactions and the balancing force or moment.{more} Choose a "
        "position further away.",
        " (margin {margin:.1e})",
    )


TURN = 360.0

NOT_REACHED = (
    Cause.ARCS,
    Cause.ARC,
    Cause.TANGENT,
    Cause.NO_ASSEMBLY,
    Cause.NOT_HELD,
    Cause.NEITHER,
    Cause.NO_NUMBER,
)
"""Causes of positions that the mechanism does not reach: the others are of dead ones."""

_SPOILT = (Cause.SPOILT_NEAR, Cause.SPOILT, Cause.SPOILT_FORCES)
"""Causes whose sentences count the other positions themselves."""


class Evenly(Struct, frozen=True):
    """Positions of the crank that divide its turns evenly (положения цикла).

    Attributes
    ----------
    first_angle : float
        The first one, degrees.
    count : int
        Positions of a turn.
    turns : int
        That they go over.
    """

    first_angle: float
    count: int
    turns: int

    def __str__(self) -> str:
        text = (
            " With [cycle] zero = {0:g}, count = {1}, or with --phi {0:g}:{2:g}:{3:g}, no "
            "position is a dead position."
        )
        return translate(
            text,
            self.first_angle,
            self.count,
            self.first_angle + TURN * self.turns,
            TURN / self.count,
        )


class Failure(Struct, frozen=True):
    """Failure of a position: the reason why it has no results (отказ).

    Attributes
    ----------
    out : str
        Letters of the point or line that cannot be found.
    points : tuple of str
        Points from which it should have been found.
    lengths : tuple of float
        Lengths in the sentence, m: radii, the distance of the centres, the missing length.
    over_cycle : tuple of float
        Largest missing length over a turn, m, and the crank's position there, degrees.
    reach : tuple of float
        Position in which an assembly was chosen, and its first and last position, degrees or m.
    plan : PlanKind
    margin : float
        Margin of the failed step.
    problem : str
        Name of the problem.
    same_count, other_count, count : int
        Numbers of other positions that fail for the same cause and for others, and of all
        positions.
    instead : Evenly or None
        Positions over the same turns that all have results, if the requested ones go round evenly.
    """

    cause: Cause
    place: Place
    out: str = ""
    points: tuple[str, ...] = ()
    lengths: tuple[float, ...] = ()
    over_cycle: tuple[float, ...] = ()
    reach: tuple[float, ...] = ()
    plan: PlanKind = PlanKind.POSITION
    margin: float = 1.0
    problem: str = ""
    same_count: int = 0
    other_count: int = 0
    count: int = 1
    instead: Evenly | None = None

    def numbered(self, number: int, count: int) -> Failure:
        """Return the failure with its position's index, from 0, among ``count`` positions."""
        return replace(self, place=self.place.numbered(number, count))

    @property
    def general(self) -> str:
        """Sentence that holds for every position with this failure."""
        return self._sentence("", translate("this position"), detailed=False)

    def __str__(self) -> str:
        more = "" if self.cause in _SPOILT else self._more()
        more += "" if self.instead is None else str(self.instead)
        return self._sentence(self.place.at, str(self.place), detailed=True) + more

    def _more(self) -> str:
        text = same_at(self.same_count, self.count)
        return text + other_failures(self.other_count)

    def _sentence(self, at: str, this: str, *, detailed: bool) -> str:
        sentence, own = self.cause.value
        facts = {
            "at": at,
            "this": this,
            "This": this[0].upper() + this[1:],
            "driver": self.place.driver,
            "out": self.out,
            "p": self.points,
            "l": [format_length(length, self.place.unit) for length in self.lengths],
            "plan": translate(self.plan.value),
            "margin": self.margin,
            "problem": self.problem,
            "turn": self._over_cycle(),
            "reach": [
                self.place.coordinate.format_value(at, self.place.unit, 6) for at in self.reach
            ],
            "more": translate(" The same holds for {} other positions.", self.same_count)
            if detailed and self.same_count
            else "",
        }
        return translate(sentence, **facts, own=translate(own, **facts) if detailed else "")

    def _over_cycle(self) -> str:
        if not self.over_cycle:
            return ""
        at = self.place.coordinate.format_value(self.over_cycle[1], self.place.unit)
        most = format_length(self.over_cycle[0], self.place.unit)
        return translate(", by {} at most over a turn (at {})", most, at)


def other_failures(count: int) -> str:
    """Return that other positions fail for other causes, if any do."""
    return translate(" Other steps fail at {} positions.", count) if count else ""


def same_at(same: int, count: int) -> str:
    """Return a sentence on the other positions with the same failure; empty if there are none."""
    return translate(" The same holds at {} more of {} positions.", same, count) if same else ""


class PositionError(AssemblyError):
    """A position has no results; `failure` says why."""

    def __init__(self, failure: Failure) -> None:
        self.failure = failure
        super().__init__(str(failure))


class Doubt(Struct, frozen=True):
    """Position whose results are good to few digits (сомнительное положение).

    Attributes
    ----------
    near : bool
        The position is next to a dead one.
    margin : float
    bound : float
        Bound of the worst result's error, relative to the largest of its kind in the position: a
        result close to zero has no digits of its own.
    forces : bool
        The forces are accurate to few digits; else the motion.
    """

    place: Place
    near: bool
    margin: float
    bound: float
    forces: bool = False

    def __str__(self) -> str:
        nature = (
            translate("next to a dead position (margin {:.1e})", self.margin)
            if self.near
            else translate(
                "badly conditioned (its results depend on small differences of large values)"
            )
        )
        text = "{} is {}: its results are accurate to about {:.0e} of the largest of their kind."
        if self.forces:
            text = (
                "{} is {}: its reactions and the balancing force or moment are accurate to "
                "about {:.0e} of the largest of their kind."
            )
        return translate(text, self.place, nature, self.bound)


class OmittedWarnings(Struct, frozen=True):
    """Number of further doubtful positions, among all."""

    more: int
    count: int

    def __str__(self) -> str:
        return translate("{} more of {} positions are affected, less badly.", self.more, self.count)


class Passed(Struct, frozen=True):
    """Change points that a group passes between the requested positions (точка ветвления).

    Attributes
    ----------
    places : tuple of float
        Positions of the driver, degrees, or m of a slider.
    unit : str
        Unit of the file's lengths.
    point : str
        Inner joint that a rule of ``[assembly]`` may name; empty if no rule helps.
    parallel : bool
        The group closes a parallelogram.
    """

    links: tuple[str, ...]
    places: tuple[float, ...]
    coordinate: Coordinate
    unit: str
    point: str = ""
    parallel: bool = False

    def __str__(self) -> str:
        places = translate(" and ").join(
            dict.fromkeys(
                self.coordinate.format_value(round(at, 4) + 0.0, self.unit, 10)
                for at in self.places
            )
        )
        text = translate(
            "links {} pass a change point at {}, from which the mechanism may continue "
            "either way: the side that was chosen in the first position is kept, so that "
            "one branch of the motion passes into another there.",
            ", ".join(self.links),
            places,
        )
        c = self.point
        ways = [translate('{} = {{ keep = "parallel" }} for the parallelogram', c)] * self.parallel
        smooth = (
            '{} = {{ near = [x, y], keep = "continuous" }} for the motion that continues smoothly'
        )
        ways += [translate(smooth, c)]
        return translate("{} In [assembly] give {}.", text, ", ".join(ways)) if c else text


class Contradiction(Struct, frozen=True):
    """Two ways to find a motion that give different results: an internal error (противоречие).

    Attributes
    ----------
    quantity : str
        ``length``, ``velocity`` or ``acceleration``
    point, about, link : str
        The point, the one it moves about, and the link.
    error, size : float
        The difference, and the largest value of its kind, SI.
    """

    problem: str
    place: Place
    quantity: str
    point: str
    about: str
    link: str
    error: float
    size: float

    def numbered(self, number: int, count: int) -> Contradiction:
        """Return the contradiction with its position's index, from 0, among ``count`` positions."""
        return replace(self, place=self.place.numbered(number, count))

    def __str__(self) -> str:
        text = (
            "{}: the {} of {} about {} on link {} is off by {:.3g} (largest value "
            "{:.3g}){}. This is an internal error of planmethod: please report it."
        )
        facts = (self.problem, translate(self.quantity), self.point, self.about, self.link)
        return translate(text, *facts, self.error, self.size, self.place.at)


def failing(program: Program, trace: Trace, count: int) -> npt.NDArray[np.int64]:
    """Return for each position the number of the first step that fails, or -1.

    Returns
    -------
    ndarray of shape (count,)
    """
    first = np.full(count, -1)
    for number, step in enumerate(program.steps):
        if step.out not in trace.margin:
            continue
        margin = np.broadcast_to(np.asarray(trace.margin[step.out], dtype=float), (count,))
        first[(first < 0) & ~(margin > limit_of(step))] = number
    return first


def explain(
    draft: Draft,
    program: Program,
    reading: Reading,
    positions: Reals,
    read_at: Callable[[Reals], Reading] | None = None,
) -> Failure:
    """Return which step fails at the first position that fails, with its numbers.

    Parameters
    ----------
    draft : Draft
        From which the program comes.
    reading : Reading
        At unit scales.
    read_at : callable, optional
        Reads the same in other positions: with it, arcs that do not meet are measured over a turn.
    """
    problem = draft.problem
    first = failing(program, reading.trace, reading.count)
    bad = np.flatnonzero(first >= 0)
    if not bad.size:
        place = Place.of(problem, positions, 0)
        return Failure(Cause.NOT_FINITE, place, problem=problem.name)
    index = int(bad[0])
    step = program.steps[int(first[index])]
    alike = int((first == first[index]).sum()) - 1

    def real(key: NumberName) -> float:
        return float(reading.number(key)[index])

    def point(key: PointName) -> complex:
        return complex(reading.point(key)[index])

    place = Place.of(problem, positions, index)
    ends = _without_length(step, program, point)
    if ends is not None:
        found = Failure(Cause.NO_DIRECTION, place, points=ends)
    else:
        found = _failure(step, place, draft, real, point)
    if found.cause in (Cause.ARCS, Cause.ARC):
        miss = float(_misses(step, reading)[index])
        found = replace(found, lengths=(*found.lengths, miss))
        if read_at is not None and problem.drive.goes_round:
            over_turn = np.nan_to_num(_misses(step, read_at(_TURN)), nan=-np.inf)
            k = int(np.argmax(over_turn))
            if over_turn[k] >= miss:  # or all of it lies between the degrees
                found = replace(found, over_cycle=(float(over_turn[k]), float(_TURN[k])))
    return replace(found, same_count=alike, other_count=bad.size - 1 - alike, count=len(positions))


_TURN = np.arange(0.0, 360.0)  # where arcs are measured that do not meet, degrees


def _misses(step: Step, reading: Reading) -> Reals:
    """Return by how much two arcs, or an arc and a line, miss each other, m, shape (n,).

    NaN where a line has no direction or an earlier step found no point.
    """
    with np.errstate(invalid="ignore"):
        if isinstance(step, steps.IntersectLineCircle):
            start, along = reading.value[step.line]
            away = reading.point(step.centre) - start
            distance = np.abs((np.conj(along / np.abs(along)) * away).imag)
            return np.asarray(distance - reading.number(step.radius))
        assert isinstance(step, steps.IntersectCircles)
        one, two = reading.number(step.radius1), reading.number(step.radius2)
        gap = np.abs(reading.point(step.centre2) - reading.point(step.centre1))
        return np.asarray(np.maximum(gap - one - two, np.abs(one - two) - gap))


def _without_length(
    step: Step, program: Program, point: Callable[[PointName], complex]
) -> tuple[PointName, PointName] | None:
    """Return two points that coincide and should have given a line of a step its direction."""
    made = {other.out: other for other in program.steps}
    for name, kind in operands(step):
        line = made[name]
        while kind is LineName and not isinstance(line, steps.Join):
            if (
                not isinstance(line, steps.Parallel | steps.Perpendicular | steps.AtAngle)
                or line.to is None
            ):
                break
            line = made[line.to]
        if isinstance(line, steps.Join) and point(line.tail) == point(line.head):
            return line.tail, line.head
    return None


def _failure(
    step: Step,
    place: Place,
    draft: Draft,
    real: Callable[[NumberName], float],
    point: Callable[[PointName], complex],
) -> Failure:
    plan = draft.plans.get(step.out, PlanKind.POSITION)
    if plan is PlanKind.FORCE:
        if (pushes := draft.letters.get(PointName(step.out))) is not None:
            return Failure(Cause.NO_ARM, place, pushes)
        return Failure(Cause.FORCES, place)
    letter = draft.letters.get(PointName(step.out), str(step.out))
    match step:
        case steps.IntersectCircles(out, a, r, b, q, _):
            gap, one, two = abs(point(b) - point(a)), real(r), real(q)
            cause = Cause.SAME_ARCS if gap == 0 and one == two else Cause.ARCS
            return Failure(cause, place, out, (a, b), (one, two, gap))
        case steps.IntersectLineCircle(out, _, a, r, _):
            return Failure(Cause.ARC, place, out, (a,), (real(r),))
        case steps.Touch(_, a, r, b, _):
            return Failure(Cause.TANGENT, place, "", (a, b), (real(r), abs(point(b) - point(a))))
        case steps.TriadPose():
            start = draft.branches[step.start[2]]
            assert isinstance(start, Start)
            links, closing = next(
                (links, one) for links, one in draft.choice.items() if one.tracked is start.tracked
            )
            reach = (closing.start, *(start.tracked.places[k] for k in (0, -1)))
            return Failure(Cause.NOT_HELD, place, ", ".join(links), reach=reach)
        case steps.IntersectLines(out) if any(one.point == out for one in draft.special.values()):
            return Failure(Cause.LEGS, place, out)
        case steps.IntersectLines():
            cause = Cause.GUIDES if plan is PlanKind.POSITION else Cause.RAYS
            return Failure(cause, place, letter, plan=plan)
        case steps.Similar(_, _, _, _, one, two):
            return Failure(Cause.SIMILAR, place, letter, (one, two))
        case _:
            return Failure(Cause.STEP, place, step.out)
