"""Four-bar by three positions of its coupler (по трём положениям шатуна): Burmester's first case.

The pivots of the frame are the centres of the circles through B1, B2, B3 and C1, C2, C3.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import isfinite
from typing import Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.steps import PointName
from planmethod.errors import AssemblyError
from planmethod.synthesis.model import (
    Board,
    FileTable,
    InputError,
    Pose,
    Synthesis,
    choose_option_set,
    lengths_of,
    place,
    read,
)

OPTIONS = ("positions", "coupler")
SIZES: Mapping[str, str] = {"coupler": "BC"}

LENGTHS = ("AB", "BC", "DC", "AD")

_RATIOS = tuple(0.1 * 1.1**k for k in range(48))
"""Lengths of a coupler that is not given, in spans of the positions, that are tried."""


def synthesize(options: Mapping[str, Any]) -> Synthesis:
    """Find the pivots of the frame, and the links.

    Parameters
    ----------
    options : mapping
        ``positions``: three of (xB, yB, angle of BC), m and degrees, or of (xB, yB, xC, yC), m;
        ``coupler`` BC with the former (m). Default: the one with the best transmission angle on
        the path.

    Raises
    ------
    InputError, AssemblyError
    """
    choose_option_set(options, "three-positions", "positions", "positions coupler")
    rows = options["positions"]
    if len(rows) != 3 or len({len(row) for row in rows}) != 1 or len(rows[0]) not in (3, 4):
        raise InputError(
            '--positions needs three rows x,y,angle or xB,yB,xC,yC, for instance "0,0,0; '
            '0.1,0.05,20; 0.25,0.05,50".'
        )
    b_points = [complex(row[0], row[1]) for row in rows]
    if len(rows[0]) == 4:
        if options["coupler"] is not None:
            raise InputError("--coupler follows from B and C: omit it, or give x,y,angle.")
        c_points = [complex(row[2], row[3]) for row in rows]
        spans = [abs(c - b) for b, c in zip(b_points, c_points, strict=True)]
        if max(spans) - min(spans) > 1e-9 * max(spans) or min(spans) == 0.0:
            text = ", ".join(f"{span:.10g}" for span in spans)
            raise InputError("The coupler is rigid, but B1C1, B2C2, B3C3 are {} m.", text)
        return _built(b_points, c_points)[0]
    turns = [np.exp(1j * np.radians(row[2])) for row in rows]
    if options["coupler"] is not None:
        return _built(b_points, _ends(b_points, turns, options["coupler"]))[0]
    made = list(_try_passage(b_points, turns))
    if not made:
        return _built(b_points, _ends(b_points, turns, 1.0))[0]
    return max(made, key=lambda one: one[1])[0]


def _ends(b_points: list[complex], turns: list[complex], coupler: float) -> list[complex]:
    return [b + coupler * turn for b, turn in zip(b_points, turns, strict=True)]


def _try_passage(
    b_points: list[complex], turns: list[complex]
) -> Iterator[tuple[Synthesis, float]]:
    span = max(abs(one - other) for one in b_points for other in b_points) or 1.0
    for ratio in _RATIOS:
        try:
            yield _built(b_points, _ends(b_points, turns, ratio * span))
        except AssemblyError:
            continue


def _centre(b: Board, name: str, points: list[complex], letter: str) -> PointName:
    """Draw the centre of the circle through three positions of a point."""
    one, two, three = points
    spread = max(abs(two - one), abs(three - two), abs(three - one))
    least = min(abs(two - one), abs(three - two), abs(three - one))
    if least <= 1e-9 * max(spread, abs(one)):
        raise AssemblyError(
            "Two of the positions {0}1, {0}2, {0}3 are the same ({1:.3g} m apart): give "
            "three different ones, or another point of the coupler.",
            letter,
            least,
        )
    sine = abs((np.conj(two - one) * (three - two)).imag) / (abs(two - one) * abs(three - two))
    if sine < 1e-9:
        raise AssemblyError(
            "{0}1, {0}2, {0}3 are on one line (sine {1:.3g}): the bisectors are "
            "parallel, {0} would need a straight guide instead of a pivot. Choose "
            "another point of the coupler: another length --coupler, or other B and C.",
            letter,
            sine,
        )
    made = [b.fixed(f"{letter}{k}", complex(at)) for k, at in enumerate(points, 1)]
    return b.circle_through(name, (made[0], made[1], made[2]))


def _built(b_points: list[complex], c_points: list[complex]) -> tuple[Synthesis, float]:
    """Draw the pivots of both points; return the mechanism and its worth."""
    b = Board()
    a = _centre(b, "A", b_points, "B")
    d = _centre(b, "D", c_points, "C")
    b.length_from("AB", b.measure("A B1", a, PointName("B1")))
    b.length_from("BC", b.measure("B1 C1", PointName("B1"), PointName("C1")))
    b.length_from("DC", b.measure("D C1", d, PointName("C1")))
    b.length_from("AD", b.measure("A D", a, d))
    trace = read(b)
    lengths = lengths_of(trace, LENGTHS)
    if lengths["AD"] <= 1e-9 * max(lengths.values()):
        raise AssemblyError(
            "A and D are the same point ({:.3g} m apart): the coupler turns about it "
            "through all three positions, one pivot is enough. Choose other points B and "
            "C.",
            lengths["AD"],
        )
    places = (place(trace, "A"), place(trace, "D"))
    way = passage(places[0], places[1], b_points, c_points)
    made = synthesis_of("three-positions", b, LENGTHS, way, (("A", "B"), ("D", "C")), places)
    if not isfinite(way.transmission):
        return made, -90.0
    return made, way.transmission - (0.0 if way.branch and way.order else 90.0)


def synthesis_of(
    kind: str,
    b: Board,
    names: tuple[str, ...],
    passage: Passage,
    letters: tuple[tuple[str, str], tuple[str, str]],
    places: tuple[complex, complex],
) -> Synthesis:
    """Return the mechanism of a four-bar that goes through three positions.

    Parameters
    ----------
    names : tuple of str
        Input, coupler, output, frame, as the problem file has them.
    passage : Passage
    letters : pairs of str
        Pivot and end of the input, and of the output.
    places : (complex, complex), m
        The two pivots.
    """
    (a, end), (d, other) = letters
    first, second = (a, end), (d, other)
    if passage.swapped:
        first, second = second, first
    input_, output = (f"{p}{q}" for p, q in (first, second))
    coupler = names[1]
    side = "left" if passage.side > 0 else "right"
    tables = (
        FileTable("links.1", "input", (f'points = ["{first[0]}", "{first[1]}"]',
                                   f'{input_} = "l_{input_}"')),
        FileTable("links.2", "coupler", (f'points = ["{coupler[0]}", "{coupler[1]}"]',
                                     f'{coupler} = "l_{coupler}"')),
        FileTable("links.3", "output", (f'points = ["{second[0]}", "{second[1]}"]',
                                    f'{output} = "l_{output}"')),
        FileTable("assembly", "assembly", (f'{second[1]} = "{side} of {first[1]}{second[0]}"',)),
    )  # fmt: skip
    poses = tuple(
        Pose(((a, f"{end}{k}", f"{other}{k}", d),), (f"{end}{k}", f"{other}{k}")) for k in (1, 2, 3)
    )
    return Synthesis(
        kind,
        b,
        names,
        (a, d),
        poses,
        {},
        "3",
        (first[1], second[1], second[0]),
        (input_, coupler, output, names[3]),
        tables,
        pivot_at_origin=False,
        driver=first,
        positions=passage.positions,
        facts={
            "driver": input_,
            "branch": passage.branch,
            "order": passage.order,
            "transmission_on_the_way_deg": (
                passage.transmission if isfinite(passage.transmission) else None
            ),
        },
    )


Reals = npt.NDArray[np.float64]

_PLACES = 721
"""Number of sampled positions of the driver on the path."""


class Passage(Struct, frozen=True):
    """Motion of a four-bar through three positions (проход через положения).

    Attributes
    ----------
    swapped : bool
        The second of the links on the frame drives.
    positions : tuple of float, degrees
        Of the driver, one after another in one sense where ``order`` holds.
    side : int
        +1: the joint of coupler and output is to the left of the line from the driver's end to the
        output's pivot, in the first position.
    branch : bool
        It passes through all three without being reassembled.
    order : bool
        It passes through them in order: 1, 2, 3.
    transmission : float, degrees
        Minimum angle between coupler and output on the path; NaN where the path is interrupted.
    """

    swapped: bool
    positions: tuple[float, ...]
    side: int
    branch: bool
    order: bool
    transmission: float


def passage(a: complex, d: complex, b: Sequence[complex], c: Sequence[complex]) -> Passage:
    """Return the passage of the four-bar A B C D, driven by the better link.

    Parameters
    ----------
    a, d : complex, m
        Pivots.
    b, c : sequence of complex, m
        The ends of the links on the frame in the three positions.
    """
    tried = (_driven(a, d, b, c, swapped=False), _driven(d, a, c, b, swapped=True))
    return max(
        tried,
        key=lambda way: (way.branch, way.order, np.nan_to_num(way.transmission), not way.swapped),
    )


def _driven(
    a: complex, d: complex, b: Sequence[complex], c: Sequence[complex], *, swapped: bool
) -> Passage:
    turns = [float(np.degrees(np.angle(p - a))) for p in b]
    sides = [1 if (np.conj(d - p) * (q - p)).imag > 0 else -1 for p, q in zip(b, c, strict=True)]
    found = []
    for way in (1.0, -1.0):
        steps = [(after - turns[0]) * way % 360.0 for after in turns]
        order = steps[1] < steps[2]
        reach = max(steps)
        angles = np.radians(turns[0] + way * reach * np.linspace(0.0, 1.0, _PLACES))
        ends = a + abs(b[0] - a) * np.exp(1j * angles)
        worst = _min_transmission_angle(np.abs(d - ends), abs(c[0] - b[0]), abs(c[0] - d))
        one_side = len(set(sides)) == 1 and bool(np.isfinite(worst))
        positions = tuple(turns[0] + way * step for step in steps)
        found.append(Passage(swapped, positions, sides[0], one_side, order, worst))
    return max(found, key=lambda p: (p.branch, p.order, np.nan_to_num(p.transmission)))


def _min_transmission_angle(distances: Reals, coupler: float, output: float) -> float:
    """Return the minimum angle between coupler and output, degrees; NaN where they do not meet.

    Parameters
    ----------
    distances : ndarray of shape (n,)
        From the pin of the driver to the pivot of the output.
    """
    cosine = (coupler**2 + output**2 - distances**2) / (2.0 * coupler * output)
    cosine = np.where(np.abs(np.abs(cosine) - 1.0) < 1e-12, np.sign(cosine), cosine)
    with np.errstate(invalid="ignore"):
        between = np.degrees(np.arccos(cosine))
    return float(np.min(np.minimum(between, 180.0 - between)))
