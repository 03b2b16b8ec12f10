"""Result of a synthesis (синтез): the construction, the lengths, their mechanism."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np
from msgspec import Struct, field

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import Trace, evaluate, limit_of
from planmethod.construct.program import Builder, Program
from planmethod.construct.steps import LineName, LineSense, Name, NumberName, PointName, Side
from planmethod.errors import AssemblyError, ExitCode, PlanMethodError

StepPhrase: TypeAlias = tuple[str, Mapping[str, str | float]]
"""Key of a sentence in ``steps`` of the texts, and its arguments: points by name, and numbers."""

NO_LETTERS: Mapping[str, str] = MappingProxyType({})

_POINT = r"[A-Z][0-9]*"

MU = NumberName("mu_l")
"""The scale, m per mm."""


class Board(Builder):
    """Drawing board of a synthesis: the steps with their data (чертёжная доска, построение).

    The verbs are those of `Builder`; their sentences and the shown elements are stored with the
    steps. Lengths are given in metres and laid off at the scale ``mu_l``.

    Attributes
    ----------
    data : dict
        Given points (m) and numbers (m, degrees) by their names; without the scale.
    phrases : dict
        Sentence that replaces a step's own; None where another sentence covers the step.
    marks : set of PointName
        Auxiliary points, which have no letter.
    sizes : dict
        Names of the lengths of the mechanism that are computed.
    circles : list of tuple of PointName
        Centres of circles that are shown, and points on each: of several the arc over them.
    """

    data: dict[str, complex | float] = field(default_factory=dict)
    phrases: dict[Name, StepPhrase | None] = field(default_factory=dict)
    marks: set[PointName] = field(default_factory=set)
    sizes: dict[NumberName, str] = field(default_factory=dict)
    circles: list[tuple[PointName, ...]] = field(default_factory=list)

    def fixed(self, name: str, place: complex) -> PointName:
        """Mark a given point, m."""
        self.data[name] = place
        return self.take_point(name)

    def _scale(self) -> NumberName:
        if not any(step.out == MU for step in self.steps):
            self.known(MU)
        return MU

    def length(self, name: str, metres: float) -> NumberName:
        """Take a length as given, m, and return it as it is laid off, mm."""
        self._scale()
        self.data[f"l {name}"] = metres
        return self.compute(name, (self.known(f"l {name}"), 1), (MU, -1))

    def angle(self, name: str, degrees: float) -> NumberName:
        """Take an angle as given, degrees."""
        if name not in self.data:
            self.data[name] = degrees
            self.known(name)
        return NumberName(name)

    def ray(self, through: PointName, to: LineName | None, degrees: float) -> LineName:
        """Draw a line at an angle, degrees from ``to`` or +x."""
        return self.at_angle(through, to, self.angle(f"{degrees!r} deg", degrees))

    def length_from(
        self, name: str, *read: NumberName, factor: float = 1.0, size: bool = True
    ) -> NumberName:
        """Compute a length of the mechanism from readings: their sum times a factor, m."""
        whole = read[0] if len(read) == 1 else self.total(f"sum {name}", *read)
        powers = ((whole, 1), (self._scale(), 1))
        length = self.compute(f"l {name}", *powers, factor=factor, size=size)
        self.sizes[length] = name
        return length

    def half_sum(self, one: NumberName, second: NumberName, names: tuple[str, str]) -> NumberName:
        """Compute half the sum and half the difference of two readings; return the latter, mm.

        ``names`` are those of the lengths of the mechanism that they are.
        """
        minus = self.compute(f"minus {second}", (second, 1), factor=-1.0)
        self.length_from(names[0], one, second, factor=0.5)
        less = self.total(f"less {names[1]}", one, minus)
        half = self.compute(f"half {names[1]}", (less, 1), factor=0.5)
        self.length_from(names[1], half)
        return half

    def bisector(self, tail: PointName, head: PointName) -> LineName:
        """Draw the perpendicular bisector of a segment with two pairs of arcs."""
        span = self.measure(f"{tail} {head}", tail, head)
        marks = [
            self.intersect_circles(f"mark {tail} {head} {side.value}", tail, span, head, span, side)
            for side in (Side.RIGHT, Side.LEFT)
        ]
        self.marks |= {*marks}
        line = self.join(*marks)
        self.phrases |= dict.fromkeys((span, *marks))
        self.phrases[line] = ("bisector", {"tail": tail, "head": head})
        return line

    def inscribed(self, centre: str, chord: tuple[PointName, PointName], angle: float,
                  side: Side) -> tuple[PointName, NumberName]:  # fmt: skip
        """Draw the arc from which a chord is seen at an angle, on one side of it.

        Parameters
        ----------
        chord : (PointName, PointName)
        angle : float, degrees
            Between 0 and 180.
        side : Side
            Side of the directed chord with the points of the arc.

        Returns
        -------
        PointName, NumberName
            Its centre and radius, mm.
        """
        tail, head = chord
        ray = self.ray(tail, self.join(tail, head), side.value * (90.0 - angle))
        at = self.intersect_lines(centre, ray, self.bisector(tail, head))
        radius = self.measure(f"{centre} {tail}", at, tail)
        self.circles.append((at, tail, head, PointName("O")))
        self.phrases |= {radius: None, ray: None}
        ends = {"tail": tail, "head": head, "centre": centre}
        self.phrases[at] = ("inscribed", {**ends, "angle": angle, "rest": abs(90.0 - angle)})
        return at, radius

    def second_intersection(
        self, out: str, point: PointName, line: LineName, centre: PointName
    ) -> PointName:
        """Find the second intersection of a line and a circle from the first, without a reading."""
        foot = self.intersect_lines(f"mark {out}", line, self.perpendicular(centre, line))
        self.marks.add(foot)
        self.phrases[foot] = None
        return self.carry(out, foot, point, foot)

    def circle_through(
        self, centre: str, points: tuple[PointName, PointName, PointName]
    ) -> PointName:
        """Find the centre of the circle through three points."""
        one, two, three = points
        at = self.intersect_lines(centre, self.bisector(one, two), self.bisector(two, three))
        self.circles.append((at, *points))
        self.phrases[at] = ("centre", {"centre": centre, "points": ", ".join(points)})
        return at

    def opposite(
        self, out: str, pivot: PointName, pin: PointName, arm: NumberName, direction: LineSense
    ) -> PointName:
        """Mark the end of a crank that is in one line with a coupler: towards its pin, or away."""
        return self.intersect_line_circle(out, self.join(pivot, pin), pivot, arm, direction)


class InputError(PlanMethodError):
    """The options of a synthesis are contradictory or insufficient (неверный запрос)."""

    exit_code = ExitCode.USAGE


class OptionSetError(InputError):
    """The options given are none of the sets from which a kind is synthesized."""

    option_sets: tuple[tuple[str, ...], ...] = ()


class Pose(Struct, frozen=True):
    """Position of the mechanism that the construction shows (положение).

    Attributes
    ----------
    links : tuple of tuples of PointName
    pins : tuple of PointName
    sliders : tuple of PointName
        Sliders of the guide of the frame.
    stones : tuple of (PointName, PointName)
        Sliding blocks, and the starting points of their slotted links.
    """

    links: tuple[tuple[str, ...], ...]
    pins: tuple[str, ...]
    sliders: tuple[str, ...] = ()
    stones: tuple[tuple[str, str], ...] = ()


class FileTable(Struct, frozen=True):
    """A table of the problem file: its head, the word for it in the comment, its lines."""

    head: str
    word: str
    lines: tuple[str, ...]


class Synthesis(Struct, frozen=True):
    """A construction, and the mechanism that it gives (синтез).

    Attributes
    ----------
    kind : str
    board : Board
    lengths : tuple of str
        Names of the lengths found or given, those of the problem file.
    pivots : tuple of str
        Fixed points; the first one is the origin of the problem file where ``pivot_at_origin``.
    poses : tuple of Pose
        The first one is drawn with main lines.
    targets : mapping
        Targets for the verification: ``K_v``, ``stroke``, ``swing``.
    output : str
        Point on the guide or output link whose extreme positions are measured.
    pressure : (str, str, str)
        Coupler or rod by its two points, and the pivot of the link that its head drives; empty for
        a guide along x. All empty: the sliding block on the slotted link, at whose pin it is 0.
    grashof : tuple of str
        Lengths of the input, the coupler, the output and the frame.
    tables : tuple of FileTable
        Of the problem file, but for the frame and the driver.
    guide : tuple of PointName
        A point that the guide of the frame passes through, if there is one.
    facts : mapping
        Further results for the record.
    theta : (str, str, str)
        Vertex of the angle between the dead positions and a point on each of its sides; empty where
        there is none.
    options : mapping
        Those from which it was made.
    """

    kind: str
    board: Board
    lengths: tuple[str, ...]
    pivots: tuple[str, ...]
    poses: tuple[Pose, ...]
    targets: Mapping[str, float]
    output: str
    pressure: tuple[str, str, str]
    grashof: tuple[str, ...]
    tables: tuple[FileTable, ...]
    guide: tuple[str, ...] = ()
    pivot_at_origin: bool = True
    driver: tuple[str, str] = ("O", "A")
    positions: tuple[float, ...] = ()
    facts: Mapping[str, Any] = field(default_factory=dict)
    theta: tuple[str, ...] = ()
    options: Mapping[str, Any] = NO_LETTERS

    @property
    def program(self) -> Program:
        """The construction."""
        return self.board.program()

    def exact(self, mu: float = 1.0) -> Trace:
        """Return the exact reading at a scale; at 1 millimetres of the paper represent metres.

        Raises
        ------
        AssemblyError
            A step does not exist.
        """
        return read(self.board, mu)

    def metres(self) -> dict[str, float]:
        """Return the lengths of the mechanism, m."""
        return lengths_of(self.exact(), self.lengths)

    @property
    def letters(self) -> tuple[str, ...]:
        """Points of the mechanism, with the letters of the construction."""
        ends = [re.findall(_POINT, name) for name in self.lengths]
        return tuple(dict.fromkeys([*self.pivots, *(point for pair in ends for point in pair)]))

    @property
    def theta_deg(self) -> float | None:
        """Angle between the dead positions, degrees; None where no ratio K_v is given."""
        ratio = self.targets.get("K_v")
        return None if ratio is None else angle_of_ratio(ratio)

    def values(self, letters: Mapping[str, str] = NO_LETTERS) -> dict[str, float]:
        """Return what a problem file may name, m and degrees: sizes, pivots, the driver's angles.

        Parameters
        ----------
        letters : mapping
            Other letters for those of the construction.
        """
        exact = self.exact()
        found = {size_name(name, letters): size for name, size in self.metres().items()}
        origin = place(exact, self.pivots[0]) if self.pivot_at_origin else 0j
        for pivot in self.pivots[1 if self.pivot_at_origin else 0 :]:
            at = place(exact, pivot) - origin
            shown = letters.get(pivot, pivot)
            found |= {f"x_{shown}": at.real + 0.0, f"y_{shown}": at.imag + 0.0}
        found |= {f"phi_{k}": phi for k, phi in enumerate(self.positions, 1)}
        if not self.positions:
            pivot, pin = self.driver
            found["phi_0"] = ray_angle(place(exact, pivot), place(exact, pin))
        return found if self.theta_deg is None else {**found, "theta": self.theta_deg}


def size_name(size: str, letters: Mapping[str, str] = NO_LETTERS) -> str:
    """Return the name of a size of the mechanism in a problem file: ``l_OA``; ``e`` of an offset.

    Parameters
    ----------
    letters : mapping
        Other letters for those of the construction.
    """
    if size == "e":
        return size
    ends = re.findall(_POINT, size)
    return f"l_{''.join(letters.get(end, end) for end in ends)}"


def lengths_of(trace: Trace, names: tuple[str, ...]) -> dict[str, float]:
    """Return lengths of a reading at scale 1, m."""
    return {name: float(trace.value[NumberName(f"l {name}")]) for name in names}


def scaled(board: Board, mu: float) -> dict[str, Any]:
    """Return the data of a construction at a scale, m per mm."""
    points = {k: v / mu for k, v in board.data.items() if isinstance(v, complex)}
    return {**board.data, **points, MU: mu}


def read(board: Board, mu: float = 1.0) -> Trace:
    """Read a construction exactly.

    Raises
    ------
    AssemblyError
        A step does not exist: reported with its margin.
    """
    trace = evaluate(board.program(), scaled(board, mu), Float64())
    for step in board.steps:
        margin = trace.margin.get(step.out)
        if margin is not None and not margin > limit_of(step):
            told = board.phrases.get(step.out)
            raise AssemblyError(
                "No such mechanism exists: the construction fails where {} is to be "
                "found{}, margin {:.3g}. Change the given data.",
                step.out,
                "" if told is None else f" ({told[0]})",
                float(margin),
            )
    return trace


def place(trace: Trace, name: str) -> complex:
    """Return a point of a reading."""
    return complex(trace.value[PointName(name)])


def angle_of_ratio(ratio: float) -> float:
    """Return the angle between the extreme positions for a ratio K_v, degrees.

    Raises
    ------
    InputError
        The ratio is less than 1.
    """
    if ratio < 1.0:
        other = f"--K_v {1.0 / ratio:.10g}" if ratio > 0.0 else "1 or more"
        raise InputError(
            "K_v = {:.10g} is less than 1, but it is the slow stroke's time over the "
            "quick one's. Give {}.",
            ratio,
            other,
        )
    return 180.0 * (ratio - 1.0) / (ratio + 1.0)


def choose_option_set(options: Mapping[str, Any], kind: str, *ways: str) -> str:
    """Return the given one of several sets of options, each written as ``K_v centres``.

    Raises
    ------
    InputError
        None of them, or a mixture.
    """
    given = {name for name, value in options.items() if value is not None}
    for way in ways:
        if given == set(way.split()):
            return way
    text = "; ".join(" ".join(f"--{name}" for name in way.split()) for way in ways)
    have = " ".join(f"--{name}" for name in sorted(given)) or "none of them"
    error = OptionSetError("{} is synthesized from: {}. Given: {}.", kind, text, have)
    error.option_sets = tuple(tuple(way.split()) for way in ways)
    raise error


def ray_angle(origin: complex, towards: complex) -> float:
    """Return the direction of a ray, degrees from +x, 0 to 360."""
    return math.degrees(float(np.angle(towards - origin))) % 360.0
