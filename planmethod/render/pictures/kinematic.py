"""Kinematic diagrams under one another on one axis of φ, with poles and rays (диаграммы)."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.scale import Scale
from planmethod.construct.steps import PointName
from planmethod.note.narrate.cycle import output_symbol
from planmethod.note.numbers import Notation
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke, shifted
from planmethod.render.ink.typeset import ink_bounds, typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.diagram import Abscissae, Curve, Diagram, Ordinates, diagram_picture
from planmethod.solved.reading import Complexes, Reals
from planmethod.solved.turn.diagrams import Diagrams, Graph, smooth

POINT_TAG = "diagram point"
"""Tag of a found point of a diagram, followed by the diagram: ``diagram point v``."""

EXACT = "exact"
"""Letter of the thin exact curves in their tags."""

_NUMBERED = 12  # largest number of positions with numbers on rays and all axes
_DIAGRAM_GAP = 4.0  # mm between two diagrams
_CLEAR = 3.2  # mm between numbers of rays on the axis


def kinematic_picture(diagrams: Diagrams, letter_height: float, notation: Notation) -> Picture:
    """Return the three diagrams, mm; the origin is that of the path.

    The points have the places of the construction over their axes.
    """
    way = diagrams.task.differentiation
    graph = diagrams.graph(way)
    trace = evaluate(graph.program, dict(graph.data), Float64())
    pictures = [
        diagram_picture(
            Diagram(
                _x_axis(diagrams, numbered=not number or diagrams.count <= _NUMBERED),
                Ordinates(f"{symbol}, {notation.units[unit]}", scale.per_mm, notation),
                _curves(diagrams, graph, trace, number),
                construction=_construction(graph, trace, number),
                labels=_letters(diagrams, graph, trace, number, letter_height) if number else (),
            ),
            letter_height=letter_height,
            name=f"diagram {'sva'[number]}",
        )
        for number, (symbol, unit, scale) in enumerate(_axes(diagrams))
    ]
    items: list[Item] = []
    low = 0.0
    for number, picture in enumerate(pictures):
        moved = 0.0 if not number else low - _DIAGRAM_GAP - picture.bounds[3]
        items += shifted(picture.items, 1j * moved)
        low = moved + picture.bounds[1]
    return Picture(tuple(items), ink_bounds(items))


def _axes(diagrams: Diagrams) -> Iterator[tuple[str, str, Scale]]:
    """Yield symbol, unit and scale of each ordinate."""
    scales = {scale.symbol: scale for scale in diagrams.scales}
    symbol = output_symbol(diagrams.cycle.output)
    index = symbol.partition("_")[2]
    letters = ("φ", "ω", "ε") if diagrams.cycle.output.slide is None else ("s", "v", "a")
    for letter, name in zip(letters, ("mu_s", "mu_v", "mu_a"), strict=True):
        if name in scales:
            yield f"{letter}_{index}", scales[name].unit, scales[name]


def _x_axis(diagrams: Diagrams, *, numbered: bool) -> Abscissae:
    """Return the axis of φ; with many positions only the first diagram has numbers."""
    # In a range the axis ends with its last position.
    at = diagrams.x(diagrams.fractions)[: None if diagrams.cycle.range is None else -1]
    names = diagrams.cycle.numbers
    numbers = [str(names[k % diagrams.count]) if numbered else "" for k in range(len(at))]
    return Abscissae("φ", tuple(at.tolist()), tuple(numbers))


def _parts(x: Reals, y: Reals) -> tuple[tuple[complex, ...], ...]:
    """Return a curve's unbroken parts."""
    good = np.isfinite(y)
    cuts = np.flatnonzero(np.diff(good.astype(int))) + 1
    runs = np.split(np.arange(len(x)), cuts)
    return tuple(
        tuple(complex(x[k], y[k]) for k in run) for run in runs if good[run[0]] and len(run) > 1
    )


def _places(graph: Graph, trace: Trace, number: int) -> Complexes:
    """Return the points of a diagram from the crossing of its axes."""
    origin = trace.value[graph.axes[number].origin]
    return np.array([complex(trace.value[p] - origin) for p in graph.points[number]])


def _curves(diagrams: Diagrams, graph: Graph, trace: Trace, number: int) -> list[Curve]:
    """Return the curve drawn through the found points, and the exact one."""
    x, exact = diagrams.x(diagrams.fine), diagrams.exact_curves[number]
    if not number:
        return [Curve("", _parts(x, exact))]
    found = _places(graph, trace, number)
    step = diagrams.length / diagrams.count
    drawn = smooth(found.imag, (x - graph.at[number][0]) / step)
    return [Curve("", _parts(x, drawn)), Curve("", _parts(x, exact), Pen.THIN)]


def _construction(graph: Graph, trace: Trace, number: int) -> list[Item]:
    """Return chords of the path, or pole, rays and step lines, and the found points."""
    axes = graph.axes[number]
    origin = complex(trace.value[axes.origin])
    there = [(k, complex(p)) for k, p in enumerate(_places(graph, trace, number)) if np.isfinite(p)]
    items: list[Item] = []
    for _, place in there:
        foot = complex(place.real, 0.0)
        items.append(Stroke((foot, place), Pen.PALE, tag="diagram upright"))
    if number:
        pole = complex(trace.value[graph.poles[number - 1]]) - origin
        items.append(Stroke((pole, 0j), Pen.THIN, tag="diagram ray"))
        for k, place in there:
            cut = complex(trace.value[PointName(f"{axes.name} cut {k}")]) - origin
            items.append(Stroke((pole, cut), Pen.THIN, tag="diagram ray"))
            items.append(Stroke((cut, place), Pen.PALE, tag="diagram step"))
        items.append(Disc(pole, 0.8, Ink.BLACK, "diagram pole"))
    else:
        for (_, tail), (_, head) in pairwise(there):
            items.append(Stroke((tail, head), Pen.THIN, tag="diagram chord"))
    dots = (Disc(place, 0.7, Ink.BLACK, f"{POINT_TAG} {axes.name}") for _, place in there)
    return [*items, *dots]


def _letters(
    diagrams: Diagrams, graph: Graph, trace: Trace, number: int, height: float
) -> list[Label]:
    """Return the letter of the pole, and the numbers of the rays where there is space.

    A ray has the number of its position; a ray of an interval, that of its last position.
    """
    axes, letter = graph.axes[number], "sva"[number]
    origin = complex(trace.value[axes.origin])
    pole = complex(trace.value[graph.poles[number - 1]]) - origin
    labels = [
        Label(
            typeset(f"P_{{{number}}}", height),
            pole,
            prefer=-1 + 0j,
            gap=1.5,
            priority=2,
            name=f"diagram {letter}: pole",
        )
    ]
    if len(graph.points[number]) > _NUMBERED:
        return labels
    size, taken = max(2.5, 0.5 * height), [0.0]
    names, first = diagrams.cycle.numbers, float(diagrams.x(diagrams.fractions)[0])
    ends = int(graph.at[number][0] - first > 1e-6 * diagrams.length)
    for k in range(len(graph.points[number])):
        name = names[(k + ends) % diagrams.count]
        cut = complex(trace.value[PointName(f"{axes.name} cut {k}")]) - origin
        if np.isfinite(cut) and min(abs(cut.imag - y) for y in taken) > _CLEAR:
            taken.append(cut.imag)
            ray = pole + (cut - pole) * 0.86
            labels.append(
                Label(typeset(str(name), size), ray, prefer=1j * (cut - pole), gap=0.4,
                      name=f"diagram {letter}: ray {name}", style=BUSY)
            )  # fmt: skip
    return labels
