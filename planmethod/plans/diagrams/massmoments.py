"""The polygon of vectors m·r that a counterweight closes (многоугольник статических моментов)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from msgspec import Struct

from planmethod.construct.program import Program
from planmethod.construct.steps import NumberName, PointName
from planmethod.plans.diagrams.board import DiagramBoard


class MassMoments(Struct, frozen=True):
    """The polygon as steps.

    Attributes
    ----------
    program, data : Program and mapping
    corners : tuple of PointName
        From the first corner on; the counterweight's vector goes from the last to the first.
    moment, mass : NumberName
        m·r of the counterweight, kg·m, and its mass, kg.
    """

    program: Program
    data: Mapping[str, complex | float]
    corners: tuple[PointName, ...]
    moment: NumberName
    mass: NumberName


def build(vectors: Sequence[complex], per_mm: float, radius: float) -> MassMoments:
    """Draw the polygon (построить многоугольник).

    Parameters
    ----------
    vectors : sequence of complex, kg·m
        From the line of the link, which is horizontal on the paper.
    per_mm : float, kg·m/mm
    radius : float, m
        Position of the counterweight.
    """
    board = DiagramBoard()
    b, mu = board.b, board.known("mu", per_mm)
    corners = [board.take_point("P", 0j)]
    for k, vector in enumerate(vectors, 1):
        size = b.compute(f"y {k}", (board.known(f"mr {k}", abs(vector)), 1), (mu, -1))
        angle = board.known(f"angle {k}", float(np.degrees(np.angle(vector))))
        corners.append(
            b.lay_off_length(f"P{k}", corners[-1], b.at_angle(corners[-1], None, angle), size)
        )
    closing = b.measure("closing", corners[-1], corners[0])
    moment = b.compute("mr", (closing, 1), (mu, 1))
    mass = b.compute("m", (moment, 1), (board.known("r", radius), -1))
    return MassMoments(b.program(), board.data, tuple(corners), moment, mass)
