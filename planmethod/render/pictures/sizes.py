"""Dimensions of the frame on a scheme, with the letters of the source (размеры стойки)."""

from __future__ import annotations

from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.sizes import GivenSize, given_sizes, shown_name
from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.pictures.scheme import Scheme
from planmethod.render.symbols import dimension, dimension_tag

_OFF = 10.0  # mm from the scheme to the first dimension line
_SPACING = 9.0  # mm between dimension lines
_CLEAR = 1.5  # mm of white at a place from which an extension line runs


def size_dimensions(
    scheme: Scheme, corner: complex, height: float
) -> tuple[list[Item], list[Label]]:
    """Return the dimensions outside the drawn scheme, and their letters.

    Distances along x are below its lower right ``corner`` and those along y at its right; those
    that do not overlap share a line. ``height`` is that of the letters, mm.
    """
    drawn, labels, used = list[Item](), list[Label](), dict[str, list[tuple[float, float, int]]]()
    for one in given_sizes(scheme.solution.problem):
        first, second = (_place(scheme, one, name) for name in (one.size.first, one.size.second))
        if first is None or second is None:
            continue
        level = corner - 1j * _OFF if one.size.axis == "x" else corner + _OFF
        taken = used.setdefault(one.size.axis, [])
        low, high = sorted(_coordinate(place, one) for place in (first, second))
        step = 0
        while any(row == step and a < high and low < b for a, b, row in taken):
            step += 1
        taken.append((low, high, step))
        drawn_, label = _dimension(one, (first, second), level, step, height)
        drawn += drawn_
        labels.append(label)
    return drawn, labels


def _coordinate(place: complex, one: GivenSize) -> float:
    return place.real if one.size.axis == "x" else place.imag


def _place(scheme: Scheme, one: GivenSize, name: str) -> complex | None:
    """Return the place of a fixed point, or the end of a drawn guide's axis by the dimension."""
    problem = scheme.solution.problem
    if name in problem.bodies[FRAME].points:
        return scheme.at(name)
    shown = shown_name(problem, name)
    ends = [end for label, *both in scheme.axis_ends if label == shown for end in both]
    return min(ends, key=lambda end: end.imag if one.size.axis == "x" else -end.real, default=None)


def _dimension(
    one: GivenSize, places: tuple[complex, complex], level: complex, step: int, height: float
) -> tuple[list[Item], Label]:
    """Return a dimension with its extension lines, and its letter."""
    tag = dimension_tag(one.symbol)
    if one.size.axis == "x":
        out, at = -1j, [complex(place.real, level.imag - step * _SPACING) for place in places]
    else:
        out, at = 1 + 0j, [complex(level.real + step * _SPACING, place.imag) for place in places]
    items = dimension(at[0], at[1], out * 1e-9, tag=tag)[2:]
    for place, end in zip(places, at, strict=True):
        items.append(Stroke((place + out * _CLEAR, end + out * _CLEAR), Pen.THIN, tag=tag))
    beside = 1j if one.size.axis == "x" else -1 + 0j  # above the line, or left of it
    label = Label(
        typeset(one.symbol, height), sum(at) / 2, (at[0], at[1]), beside, gap=0.8, priority=2,
        name=tag,
    )  # fmt: skip
    return items, label
