"""Graphical differentiation and integration with a pole (графическое дифференцирование).

Differentiation: a ray from the pole parallel to the chord (or the tangent) of a diagram cuts off K
times the slope on the axis of ordinates; a line from there along the axis of abscissae meets the
upright of the place. Integration goes the same way back: the ray from the pole to the mean ordinate
of an interval gives the slope of the chord below.

With scales mu_y of the ordinates and mu_x of the abscissae, units per mm, and the pole distance K,
mm: the differentiated diagram has mu_y/(mu_x·K), the integrated one mu_y·mu_x·K.

Source: курсовое проектирование по ТММ, section 1.6 of the press coursework (method of chords).
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

from planmethod.construct.steps import PointName
from planmethod.plans.diagrams.board import DiagramAxes, DiagramBoard


class Integration(Enum):
    """Ordinate that represents an interval (способ графического интегрирования)."""

    MIDDLE = "middle ordinates"
    TRAPEZOIDS = "trapezoids"


def differentiate(
    board: DiagramBoard,
    pairs: Sequence[tuple[PointName, PointName]],
    axes: DiagramAxes,
    at: Sequence[float],
    *,
    pole: PointName,
) -> list[PointName]:
    """Draw the derivative of a diagram, one ordinate for every chord.

    Parameters
    ----------
    pairs : sequence of (PointName, PointName)
        Ends of the chords: neighbours for the method of chords, and for the method of tangents the
        neighbours on both sides, whose chord the tangent between them is drawn parallel to.
    axes : DiagramAxes
        Of the derivative.
    at : sequence of float, mm
        Abscissa of every ordinate.
    pole : PointName
        Pole of the derivative's axes: `DiagramBoard.pole`.
    """
    b, made = board.b, []
    for k, ((tail, head), x) in enumerate(zip(pairs, at, strict=True)):
        ray = b.parallel(pole, b.join(tail, head))
        cut = b.intersect_lines(f"{axes.name} cut {k}", ray, axes.y_axis)
        line = b.parallel(cut, axes.x_axis)
        made.append(b.intersect_lines(f"{axes.name} {k}", line, board.upright(axes, x)))
    return made


def repeated(
    board: DiagramBoard, name: str, diagram_point: PointName, end: PointName, start: PointName
) -> PointName:
    """Return a point of a periodic diagram a period earlier: moved as ``end`` is to ``start``."""
    return board.b.carry(name, start, end, diagram_point)


def integrate(
    board: DiagramBoard,
    curve: Sequence[PointName],
    over: DiagramAxes,
    axes: DiagramAxes,
    at: Sequence[float],
    *,
    pole: PointName,
    method: Integration = Integration.MIDDLE,
) -> list[PointName]:
    """Draw the integral of a diagram from its first abscissa on.

    Parameters
    ----------
    curve : sequence of PointName
        Points of the diagram: over the middles of the n intervals for middle ordinates, over all
        their n + 1 ends for trapezoids.
    over : DiagramAxes
        Axes of that diagram.
    axes : DiagramAxes
        Of the integral, which starts on its axis of abscissae.
    at : sequence of float, mm
        Abscissae of the n + 1 ends, in order.
    pole : PointName
        Pole of ``over``: `DiagramBoard.pole`.

    Returns
    -------
    list of PointName
        n + 1 points of the integral; their ordinates are areas over the pole distance, mm.
    """
    b = board.b
    points = [board.abscissa(axes, at[0])]
    for k in range(len(at) - 1):
        if method is Integration.MIDDLE:
            mean = curve[k]
        else:
            middle = board.upright(over, (at[k] + at[k + 1]) / 2)
            mean = b.intersect_lines(
                f"{axes.name} mean {k}", b.join(curve[k], curve[k + 1]), middle
            )
        cut = b.intersect_lines(f"{axes.name} cut {k}", b.parallel(mean, over.x_axis), over.y_axis)
        chord = b.parallel(points[-1], b.join(pole, cut))
        points.append(
            b.intersect_lines(f"{axes.name} {k + 1}", chord, board.upright(axes, at[k + 1]))
        )
    return points
