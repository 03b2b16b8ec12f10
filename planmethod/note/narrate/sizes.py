"""Letters of distances between fixed points and guides: a, b, c of the source (размеры стойки)."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct

from planmethod.mechanism.model import FRAME
from planmethod.note.document import input_text
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import Formulas
from planmethod.note.numbers import signed_sum
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Problem, Size

AXES = ("x", "y")

Coordinate = tuple[str, str]
"""Axis, and the name of a fixed point or a guide."""


class GivenSize(Struct, frozen=True):
    """A distance that has a letter (размер).

    Attributes
    ----------
    symbol : str
        In rich text.
    size : Size
    metres : float
        Its magnitude.
    sign : int
        -1 if the second place has the smaller coordinate.
    """

    symbol: Rich
    size: Size
    metres: float
    sign: int


def given_sizes(problem: Problem) -> tuple[GivenSize, ...]:
    """Return the distances that have letters, in their order; none that is zero."""
    found = []
    for letter, size in problem.letters.sizes.items():
        way = coordinate(problem, size.axis, size.second)
        way -= coordinate(problem, size.axis, size.first)
        if way:
            found.append(GivenSize(symbol_of(letter), size, abs(way), 1 if way > 0 else -1))
    return tuple(found)


def symbol_of(letter: str) -> Rich:
    """Return a letter of a size with its index: ``a_1`` and ``a1`` are ``a_{1}``."""
    head, tail = letter[:1], letter[1:].removeprefix("_")
    return f"{head}_{{{tail}}}" if tail else head


def shown_name(problem: Problem, name: str) -> str:
    """Return the reader's name of a fixed point or a guide."""
    return problem.guide_name(name) if name in problem.guides else name


def coordinate(problem: Problem, axis: str, name: str) -> float:
    """Return a coordinate of a fixed point or of the base of a guide, m."""
    points = problem.bodies[FRAME].points
    place = points[name] if name in points else problem.guides[name][1]
    return place.real if axis == "x" else place.imag


def coordinate_letters(problem: Problem) -> Mapping[Coordinate, Rich]:
    """Return the coordinates that follow from sizes, in letters: ``−a_{1} − b_{1}``.

    Keys have the reader's names. Coordinates are counted from places where they are zero.
    """
    sizes = given_sizes(problem)
    names = (*problem.bodies[FRAME].points, *problem.guides)
    found: dict[Coordinate, tuple[tuple[float, Rich], ...]] = {
        (axis, name): () for axis in AXES for name in names if not coordinate(problem, axis, name)
    }
    while True:
        more = {}
        for one in sizes:
            ends = (one.size.axis, one.size.first), (one.size.axis, one.size.second)
            for (start, end), sign in zip((ends, ends[::-1]), (one.sign, -one.sign), strict=True):
                if start in found and end not in found:
                    more[end] = (*found[start], (sign, one.symbol))
        if not more:
            return {
                (axis, shown_name(problem, name)): signed_sum(terms)
                for (axis, name), terms in found.items()
                if terms
            }
        found |= more


def laid_off_sizes(formulas: Formulas) -> list[Rich]:
    """Return the sentence with the sizes on the drawing, mm; none if no size has a letter."""
    problem, texts, found = formulas.solution.problem, formulas.texts, []
    for one in given_sizes(problem):
        length = one.metres / formulas.per_mm(PlanKind.POSITION)
        found.append(
            texts["size"][one.size.axis].format(
                length=f"{one.symbol} = {input_text(length, texts, 4)} {texts['units']['mm']}",
                first=shown_name(problem, one.size.first),
                second=shown_name(problem, one.size.second),
            )
        )
    return [texts.lay_off_sizes.format(sizes="; ".join(found))] if found else []
