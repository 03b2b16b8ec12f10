"""Parts of a plan besides its steps: vectors, equations, segments, dimensions, assembly modes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from enum import Enum
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.construct.program import Builder
from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.problem.model import Convention, Problem


class PlanKind(Enum):
    """Kind of plan (вид плана)."""

    POSITION = "position"
    VELOCITY = "velocity"
    ACCELERATION = "acceleration"
    FORCE = "force"
    LEVER = "lever"

    __hash__ = object.__hash__  # an enumeration computes its hash from the name each time


class PlanFacts(Struct, frozen=True):
    """Properties of a kind of plan (масштаб, полюс и единица плана).

    Attributes
    ----------
    pole : str
        Letter of the pole; empty where a plan has none.
    letter : str
        Of the vectors: ``v``; the length of a link on the position plan.
    scale : str
        Name of the scale: ``mu_v``, in letters ``μ_{v}``.
    unit : str
        Unit of the value that a segment represents.
    prefix : str
        Beginning of the names of the plan's points in a program.
    """

    pole: str
    letter: str
    scale: str
    unit: str
    prefix: str = ""


FACTS: dict[PlanKind, PlanFacts] = {
    PlanKind.POSITION: PlanFacts("", "l", "mu_l", "m"),
    PlanKind.VELOCITY: PlanFacts("p", "v", "mu_v", "m/s", "v:"),
    PlanKind.ACCELERATION: PlanFacts("π", "a", "mu_a", "m/s²", "a:"),
    PlanKind.FORCE: PlanFacts("", "F", "mu_F", "N", "f:"),
    PlanKind.LEVER: PlanFacts("p", "v", "mu_v", "m/s", "f:"),
}
"""The one table of the kinds of plans."""

MOTION = (PlanKind.POSITION, PlanKind.VELOCITY, PlanKind.ACCELERATION)
"""Plans that every problem has, in the order in which they are drawn."""

RATES = MOTION[1:]
"""The plans among them whose vectors start from a pole."""


def is_primed(problem: Problem, kind: PlanKind) -> bool:
    """Return whether a plan's letters carry a prime: the acceleration plan of the mm/unit books."""
    return kind is PlanKind.ACCELERATION and problem.scales.convention is Convention.MM_PER_UNIT


def pole_letter(problem: Problem, kind: PlanKind) -> str:
    """Return the letter of a plan's pole: p, π; p′ for the latter in the mm/unit books."""
    return "p′" if is_primed(problem, kind) else FACTS[kind].pole


class VectorKind(Enum):
    """Kind of component that a vector of a plan represents (вид составляющей)."""

    ABSOLUTE = "absolute"  # from the pole: v_B, a_B (абсолютная)
    RELATIVE = "relative"  # v_CB, or the whole a_CB (относительная)
    NORMAL = "normal"  # a^n_CB (нормальное)
    TANGENTIAL = "tangential"  # a^tau_CB (касательное)
    CORIOLIS = "coriolis"  # a^k_B3B (кориолисово)
    SLIDING = "sliding"  # along a guide: v_B3B, a^r_B3B (относительная по направляющей)


class KnownParts(Enum):
    """Number of underlines of a term: which parts of it are known before the plan is drawn."""

    NONE = 0
    ONE = 1  # direction only: one line
    BOTH = 2  # magnitude and direction: two lines


class Relation(Enum):
    """Relation of a vector to a line that is already on the drawing."""

    PARALLEL = "along"  # ∥ (параллельно)
    PERPENDICULAR = "across"  # ⊥ (перпендикулярно)
    ANGLED = "angled"  # at an angle to it
    TOWARDS = "towards"  # along it, from the first point to the second
    ZERO = "still"  # no vector at all: = 0


class Direction(Struct, frozen=True):
    """Direction of a vector as it is known before the plan is drawn (направление вектора).

    Attributes
    ----------
    relation : Relation
    points : tuple of str
        Two points of the mechanism on the line; none where it is a guide.
    guide : str
        Name of the guide, or letters of a line of a link.
    angle : float
        From the line, degrees; zero but for ``ANGLED``.
    letters : tuple of str
        Letters of the points, where they are not the names.
    """

    relation: Relation
    points: tuple[str, ...] = ()
    guide: str = ""
    angle: float = 0.0
    letters: tuple[str, ...] = ()

    @property
    def ends(self) -> tuple[str, ...]:
        """The points by their letters."""
        return self.letters or self.points

    def lettered(self, letters: tuple[str, ...]) -> Direction:
        """Return the direction with other letters of its points."""
        return self if letters == self.points else replace(self, letters=letters)


ZERO_VECTOR = Direction(Relation.ZERO)


def perpendicular_to(p: str, q: str) -> Direction:
    """Return the direction across the line of two points: ``⊥ BC``."""
    return Direction(Relation.PERPENDICULAR, (p, q))


def towards(p: str, q: str) -> Direction:
    """Return the direction from a point to another: ``C → B``."""
    return Direction(Relation.TOWARDS, (p, q))


class Vector(Struct, frozen=True):
    """One term of a vector equation and the segment of the plan that shows it.

    Attributes
    ----------
    symbol : str
        Letter and indices in the markup of rich text: ``v_{CB}``, ``a^{n}_{CB}``.
    tail, head : PointName
        Plan points of the segment (equal letters where the vector is zero by nature).
    direction : Direction or None
        Parts of it known before the plan is drawn, written under the term.
    points : (str, str) or ()
        The two points of a link whose relative motion it is, by the names that quantities have.
    """

    symbol: str
    kind: VectorKind
    tail: PointName
    head: PointName
    known: KnownParts
    direction: Direction | None = None
    points: tuple[str, ...] = ()


COMPONENTS = (VectorKind.NORMAL, VectorKind.TANGENTIAL, VectorKind.CORIOLIS)
"""Kinds of vectors that are components on every plan."""


def is_component(vector: Vector, kind: PlanKind) -> bool:
    """Return whether a vector of a plan is a component, which is drawn thin."""
    return vector.kind in COMPONENTS or (
        vector.kind is VectorKind.SLIDING and kind is PlanKind.ACCELERATION
    )


class VectorEquation(Struct, frozen=True):
    """``left = right[0] + right[1] + ...`` (векторное уравнение)."""

    left: Vector
    right: tuple[Vector, ...]


class Plan(Struct, frozen=True):
    """One plan for all positions (план); its steps are in the program of the solution.

    Attributes
    ----------
    pole : PointName or None
        None for the position plan.
    letters : mapping of PointName to str
        Rich-text letter of every plan point that is drawn: ``b``, ``b_{3}``, ``n_{CB}``, ``k``.
    vectors : tuple of Vector
        Every segment drawn and measured, each once.
    equations : tuple of VectorEquation
        In the order of solving.
    """

    kind: PlanKind
    pole: PointName | None
    letters: Mapping[PointName, str]
    vectors: tuple[Vector, ...]
    equations: tuple[VectorEquation, ...] = ()


class DimensionKind(Enum):
    """Kind of a given number (вид размера); the value is the beginning of its name."""

    LENGTH = "l_"  # distance of two points
    ALONG = "x_"  # from a point along a line
    ACROSS = "y_"  # and across it
    OFFSET = "e_"  # of a point from a guide
    ANGLE = "angle_"  # of a link or of a guide, degrees
    TRAVEL = "s"  # of the driving slider


class Dimension(Struct, frozen=True):
    """Given number of a construction, in metres or in millimetres of the drawing (размер).

    Attributes
    ----------
    kind : DimensionKind
    of : tuple of str
        Points that it places or lies between; the link or guide that an angle turns.
    letters : str
        What its length on the drawing is called.
    """

    kind: DimensionKind
    of: tuple[str, ...]
    letters: str


Ends: TypeAlias = tuple[PointName, PointName]


class Segments(Struct):
    """Segments of one plan, or of plans with one scale.

    Attributes
    ----------
    b : Builder
    scale : NumberName
        Scale of the plan.
    prefix : str
        Beginning of the names of its values.
    lengths : dict of (PointName, PointName) to NumberName
        Length of a segment, mm.
    values : dict of (PointName, PointName) to NumberName
        Value of a segment, in the unit of the plan: computed before it was laid off, or from its
        length. Lengths and values are signed if a segment lies on a line along which the sign is
        needed.
    """

    b: Builder
    scale: NumberName
    prefix: str = ""
    lengths: dict[Ends, NumberName] = field(default_factory=dict)
    values: dict[Ends, NumberName] = field(default_factory=dict)
    _measured: set[NumberName] = field(default_factory=set)

    def on(self, b: Builder) -> Segments:
        """Return the same segments for a construction that continues from here."""
        return replace(
            self,
            b=b,
            lengths=dict(self.lengths),
            values=dict(self.values),
            _measured=set(self._measured),
        )

    def compute(
        self, name: str, *powers: tuple[NumberName, int], factor: float = 1.0, size: bool = False
    ) -> NumberName:
        """Compute a number under an unused name."""
        name = self.prefix + name
        while self.b.has(name):
            name += "*"
        return self.b.compute(name, *powers, factor=factor, size=size)

    def length(self, tail: PointName, head: PointName) -> NumberName:
        """Return the length of a segment, mm; it is measured if it is not known yet."""
        if (tail, head) in self.lengths or (head, tail) in self.lengths:
            return self.drawn((tail, head))
        name = self.b.measure(f"|{tail}–{head}|", tail, head)
        self.lengths[tail, head] = name
        self._measured.add(name)
        return name

    def value(self, tail: PointName, head: PointName, name: str) -> NumberName:
        """Return the value of a segment; ``name`` is used if the value is new."""
        if (tail, head) in self.values or (head, tail) in self.values:
            return self.known((tail, head))
        length = self.length(tail, head)
        self.values[tail, head] = self.compute(name, (self.scale, 1), (length, 1))
        return self.values[tail, head]

    def read(self, ends: Ends) -> NumberName | None:
        """Return the ruler's reading of a segment, mm; None if it was laid off."""
        length = self.length(*ends)
        return length if length in self._measured else None

    def drawn(self, ends: Ends) -> NumberName:
        """Return the length of a segment that has been drawn and read, mm."""
        return self.lengths[ends] if ends in self.lengths else self.lengths[ends[::-1]]

    def known(self, ends: Ends) -> NumberName:
        """Return the value of a segment that has been drawn and read."""
        return self.values[ends] if ends in self.values else self.values[ends[::-1]]

    def read_signed(
        self, tail: PointName, head: PointName, line: LineName, name: str
    ) -> NumberName:
        """Read a segment along its line, with a sign, and return its value."""
        length = self.b.measure_along(f"|{tail}–{head}|{line}", tail, head, line)
        value = self.compute(name, (self.scale, 1), (length, 1))
        self.lengths[tail, head], self.values[tail, head] = length, value
        self._measured.add(length)
        return value

    def lay_off_vector(
        self, out: str, start: PointName, line: LineName, value: NumberName
    ) -> PointName:
        """Lay off a vector of a computed size along a line."""
        length = self.b.compute(f"|{out}|", (value, 1), (self.scale, -1))
        end = self.b.lay_off_length(out, start, line, length)
        self.lengths[start, end], self.values[start, end] = length, value
        return end

    def same(self, tail: PointName, head: PointName, of: Ends) -> None:
        """Note that a segment is another one, carried to its place."""
        self.lengths[tail, head] = self.drawn(of)
        self.values[tail, head] = self.known(of)


Reals: TypeAlias = npt.NDArray[np.float64]


class TrackedAssembly(Struct, frozen=True):
    """Assembly of a triad, tracked from a chosen position (сборка группы III класса).

    No formula gives it: it is continued from one position to the next. Interpolation between two
    tracked positions is a good enough start for Newton's method.

    Attributes
    ----------
    places : tuple of float
        Positions of the driver, rising, degrees or m.
    x, y : tuple of float
        Coordinates of the base link's origin, m.
    turn : tuple of float
        Direction of its axis, degrees.
    period : float
        Period of the driver's motion after which the assembly repeats; 0 if it does not. Outside
        the positions there is no such assembly.
    """

    places: tuple[float, ...] = (0.0,)
    x: tuple[float, ...] = (math.nan,)
    y: tuple[float, ...] = (math.nan,)
    turn: tuple[float, ...] = (math.nan,)
    period: float = 0.0

    def at(self, coordinate: str, positions: Reals) -> Reals:
        """Return ``x``, ``y`` or ``turn``, shape (n,); NaN where there is no such assembly."""
        low, high = self.places[0], self.places[-1]
        here = np.asarray(positions, dtype=float)
        if self.period:
            here = low + np.mod(here - low, self.period)
        found = np.interp(here, self.places, getattr(self, coordinate))
        return np.where((here < low) | (here > high), np.nan, found)


class Start(Struct, frozen=True):
    """One of the numbers that locate an assembly (``x``, ``y`` or ``turn``)."""

    tracked: TrackedAssembly
    coordinate: str

    @property
    def values(self) -> tuple[float, ...]:
        """Values in the tracked positions."""
        found: tuple[float, ...] = getattr(self.tracked, self.coordinate)
        return found

    def branch(self, positions: Reals) -> Reals:
        """Return the value in some positions of the driver, m or degrees."""
        return self.tracked.at(self.coordinate, positions)


class Turns(Struct, frozen=True):
    """Whole turns of a link, added to the angle that a protractor reads (полные обороты).

    Attributes
    ----------
    places : tuple of float
        Positions of the driver, rising, in which the angle that is read jumps.
    counts : tuple of int
        Whole turns before the first of them, between them, and after the last one.
    period : float
        Period of the driver after which ``per_period`` turns are added; 0 if it has none.
    per_period : int
    """

    places: tuple[float, ...] = ()
    counts: tuple[int, ...] = (0,)
    period: float = 0.0
    per_period: int = 0
    low: float = 0.0

    def branch(self, positions: Reals) -> Reals:
        """Return the degrees to be added in some positions of the driver."""
        here = np.asarray(positions, dtype=float)
        whole = np.zeros(here.shape)
        if self.period:
            whole = np.floor((here - self.low) / self.period)
            here = here - whole * self.period
        found = np.asarray(self.counts)[np.searchsorted(self.places, here, side="right")]
        return np.asarray(360.0 * (found + whole * self.per_period), dtype=float)


class AssemblyMode(Struct, frozen=True):
    """Assembly mode of a group: which of its two ways it closes (способ сборки).

    Attributes
    ----------
    side : int
        +1 or -1, in all positions unless it changes.
    parallel : bool
        The group closes a parallelogram, on no side of its line of centres for good.
    start : float
        Driver position that ``side`` belongs to, degrees or m.
    changes : tuple of float
        Change points: driver positions in which a motion that goes on smoothly changes sides.
    period : float
        After which the changes come again: 360 of a crank; of a slider out of all reach.
    tracked : TrackedAssembly
        Of a triad, the assembly that is meant; ``other_places`` are the places of ``point`` in the
        rest, m, at ``start``.
    third : int
        Of a triad, the leg whose line does not go through the special point that is used.
    only_at : tuple of float
        The only driver positions in which the mode is known, because both modes coincide there;
        empty if it is known in all.
    turns : mapping of (str, str) to Turns
        Of a wheel, the whole turns of links whose angles are read, by mesh and link.
    period_of_wheels : float
        Of a wheel, degrees of the driver after which it stands as before; 0 for each turn of it.
    """

    side: int = 1
    parallel: bool = False
    start: float = 0.0
    changes: tuple[float, ...] = ()
    period: float = 1e12
    tracked: TrackedAssembly = TrackedAssembly()
    third: int = 2
    other_places: tuple[complex, ...] = ()
    point: str = ""
    only_at: tuple[float, ...] = ()
    turns: Mapping[tuple[str, str], Turns] = field(default_factory=dict)
    period_of_wheels: float = 0.0

    def branch(self, positions: Reals) -> Reals:
        """Return +1 where the side is the first one, else -1; it depends on the position alone."""
        passed = np.zeros(np.shape(positions))
        for change in self.changes:
            for sign, place in ((1, positions), (-1, np.asarray(self.start))):
                passed += sign * np.floor((place - change) / self.period)
        return np.where(passed % 2 == 0, 1.0, -1.0)


Choice = Mapping[tuple[str, ...], AssemblyMode]


def assembly_period(choice: Choice, turn: float) -> float:
    """Return the degrees of the driver after which all groups close as before.

    A group that passes an odd number of change points in its own period is then in its other mode,
    and in the first one after two periods. Infinite if a group never closes as before.

    Parameters
    ----------
    turn : float, degrees
        Period of the driver itself.
    """
    found = 1
    for one in choice.values():
        period = turn
        if one.changes:
            period = one.period * (1 + len(one.changes) % 2)
        if one.tracked != AssemblyMode().tracked:
            period = one.tracked.period
        if one.period_of_wheels:
            period = one.period_of_wheels
        if not period or not math.isfinite(period):
            return math.inf
        found = math.lcm(found, max(round(period / turn), 1))
    return turn * found


"""Assembly mode of each group that has two, by its links."""
