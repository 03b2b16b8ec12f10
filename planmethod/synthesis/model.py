"""What a synthesis finds (синтез): the construction, the lengths, the mechanism that has them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import field
from typing import Any

import numpy as np

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import Trace, evaluate, limit_of
from planmethod.construct.program import Program
from planmethod.construct.steps import NumberName, PointName
from planmethod.errors import AssemblyError, ExitCode, PlanMethodError
from planmethod.record import dataclass
from planmethod.synthesis.board import MU, Board


class AskedError(PlanMethodError):
    """What is asked of a synthesis contradicts itself, or is not enough (неверный запрос)."""

    exit_code = ExitCode.USAGE


@dataclass(frozen=True, slots=True)
class Pose:
    """Position of the mechanism that the construction shows (положение).

    Attributes
    ----------
    links : tuple of tuples of PointName
    pins : tuple of PointName
    sliders : tuple of PointName
        Sliders of the guide of the frame.
    stones : tuple of (PointName, PointName)
        Stones, and the points that their slotted links start from.
    """

    links: tuple[tuple[str, ...], ...]
    pins: tuple[str, ...]
    sliders: tuple[str, ...] = ()
    stones: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class Table:
    """A table of the problem file: its head, the word for it in the comment, its lines."""

    head: str
    word: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Synthesis:
    """A construction, and the mechanism that it gives (синтез).

    Attributes
    ----------
    kind : str
    board : Board
    lengths : tuple of str
        Names of the lengths found or given, those of the problem file.
    pivots : tuple of str
        Fixed points; the first one is the origin of the problem file where ``moved``.
    poses : tuple of Pose
        The first one is drawn with main lines.
    asked : mapping
        What shall be measured back: ``K_v``, ``stroke``, ``swing``.
    output : str
        Point on the guide or output link whose extreme positions are measured.
    pressure : (str, str, str)
        Coupler or rod by its two points, and the pivot of the link that its head drives; empty for
        a guide along x. All empty: the stone on the slotted link, at whose pin it is 0.
    grashof : tuple of str
        Lengths of the input, the coupler, the output and the frame.
    tables : tuple of Table
        Of the problem file, but for the frame and the driver.
    guide : tuple of PointName
        A point that the guide of the frame passes through, if there is one.
    facts : mapping
        Further results for the record.
    """

    kind: str
    board: Board
    lengths: tuple[str, ...]
    pivots: tuple[str, ...]
    poses: tuple[Pose, ...]
    asked: Mapping[str, float]
    output: str
    pressure: tuple[str, str, str]
    grashof: tuple[str, ...]
    tables: tuple[Table, ...]
    guide: tuple[str, ...] = ()
    moved: bool = True
    driver: tuple[str, str] = ("O", "A")
    positions: tuple[float, ...] = ()
    facts: Mapping[str, Any] = field(default_factory=dict)

    @property
    def program(self) -> Program:
        """The construction."""
        return self.board.program()

    def exact(self, mu: float = 1.0) -> Trace:
        """Return the exact reading at a scale; at 1 millimetres of the paper stand for metres.

        Raises
        ------
        AssemblyError
            A step does not exist.
        """
        return read(self.board, mu)

    def metres(self) -> dict[str, float]:
        """Return the lengths of the mechanism, m."""
        return lengths_of(self.exact(), self.lengths)


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
        A step does not exist: told with its margin.
    """
    trace = evaluate(board.program(), scaled(board, mu), Float64())
    for step in board.steps:
        margin = trace.margin.get(step.out)
        if margin is not None and not margin > limit_of(step):
            told = board.said.get(step.out)
            raise AssemblyError(
                "There is no such mechanism: the construction ends where {} is to be "
                "found{}, margin {:.3g}. Change what is given.",
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
    AskedError
        The ratio is less than 1.
    """
    if ratio < 1.0:
        other = f"--K_v {1.0 / ratio:.10g}" if ratio > 0.0 else "1 or more"
        raise AskedError(
            "K_v = {:.10g} is less than 1, but it is the slow stroke's time over the "
            "quick one's. Give {}.",
            ratio,
            other,
        )
    return 180.0 * (ratio - 1.0) / (ratio + 1.0)


def chosen(asked: Mapping[str, Any], kind: str, *ways: str) -> str:
    """Return which of several sets of options is given, each written as ``K_v centres``.

    Raises
    ------
    AskedError
        None of them, or a mixture.
    """
    given = {name for name, value in asked.items() if value is not None}
    for way in ways:
        if given == set(way.split()):
            return way
    told = "; ".join(" ".join(f"--{name}" for name in way.split()) for way in ways)
    have = " ".join(f"--{name}" for name in sorted(given)) or "none of them"
    raise AskedError("{} is synthesized from: {}. Given: {}.", kind, told, have)


def ray_angle(origin: complex, towards: complex) -> float:
    """Return the direction of a ray, degrees from +x, 0 to 360."""
    return math.degrees(float(np.angle(towards - origin))) % 360.0
