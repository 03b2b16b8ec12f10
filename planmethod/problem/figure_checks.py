"""Numbers that a drawn position has twice, compared with the figure (избыточные размеры)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.steps import PointName
from planmethod.languages import translate
from planmethod.problem.figure import Figure, Values
from planmethod.problem.file_node import FileNode
from planmethod.problem.model import DrawnFact, DrawnKind
from planmethod.problem.placement import rotation

ANGLE_TOLERANCE = 0.5
"""Degrees by which an angle that the figure gives once more may differ, as it is rounded."""

LENGTH_TOLERANCE = 0.005
"""Share by which a length that it gives once more may differ."""

SAME = 1e-9
"""Share of the figure's size within which two places are one, and a coordinate is zero."""

Reals: TypeAlias = npt.NDArray[np.float64]

PlaceValues: TypeAlias = dict[tuple[str, ...], Any]
"""Values of the unknown places, m and degrees, by their paths in the file."""


def extent(figure: Figure, values: Values, k: int) -> float:
    """Return the size of the figure in a mirror image, m."""
    places = [complex(values[PointName(p)][k]) for p in figure.placed]
    places = [place for place in places if place == place]
    return max(abs(one - places[0]) for one in places) or 1.0


class Check(Struct, frozen=True):
    """A number that the figure need not give, and what the others give, by mirror image.

    ``is_supplement`` where an angle is not that of the axes, but of their lines.
    """

    node: FileNode
    name: str
    given_value: float
    drawn_values: Reals
    unit: str
    off: Reals
    is_supplement: npt.NDArray[np.bool_] | None = None

    @property
    def is_consistent(self) -> npt.NDArray[np.bool_]:
        """Where they agree; a place that is not built contradicts nothing."""
        return ~(self.off > 1.0)


class FigureChecks:
    """Comparison of a built figure with the numbers that it did not need.

    Parameters
    ----------
    file : FileNode
        The whole problem file.
    values : Values
        Those of the steps, shape (n,) in the n mirror images.
    axes : mapping of str to LineName
        Lines of the links' own axes.
    """

    def __init__(
        self, file: FileNode, figure: Figure, values: Values, axes: Mapping[str, Any]
    ) -> None:
        self.file, self.figure, self.scene = file, figure, figure.scene
        self.values = values
        self.size = max(extent(figure, values, k) for k in range(len(figure.images)))
        self.directions = {link: self._direction(link, line) for link, line in axes.items()}

    def find(self) -> Iterator[Check]:
        """Yield the numbers that can be compared with the figure."""
        yield from self._facts()
        yield from self._lengths()
        yield from self._coordinates()
        yield from self._offsets()

    def _facts(self) -> Iterator[Check]:
        values, directions = self.values, self.directions
        for fact in self.scene.facts:
            node = self.file["drawn"][fact.key]
            if fact.kind is DrawnKind.LENGTH and {*fact.of} <= {*self.figure.placed}:
                found = np.abs(np.subtract(*(values[PointName(p)] for p in fact.of)))
                yield self._length(node, "".join(fact.of), fact.value, found)
            elif fact.kind is DrawnKind.PHI and fact.of[0] in directions:
                (course,) = self.scene.headings(fact)
                found = np.degrees(np.angle(directions[fact.of[0]] * rotation(course)))
                off = np.abs((found - fact.value + 180.0) % 360.0 - 180.0)
                yield Check(node, fact.key, fact.value, found, "deg", off / ANGLE_TOLERANCE)
            elif fact.kind is DrawnKind.BETWEEN and {*fact.of} <= {*directions}:
                yield self._between(node, fact)

    def _lengths(self) -> Iterator[Check]:
        values = self.values
        for link, body in self.scene.links.items():
            here = [p for p in body.points if p in self.figure.placed]
            for p, q in pairwise(here):
                given = abs(body.points[q] - body.points[p])
                found = np.abs(values[PointName(q)] - values[PointName(p)])
                if given:
                    node = self.file["links"][link]
                    yield self._length(node, f"l_{p}{q}", given, found)

    def _coordinates(self) -> Iterator[Check]:
        frame, values, size = self.file["frame"], self.values, self.size
        for name, place in self.scene.points.items():
            for axis, value, part in zip("xy", place, (np.real, np.imag), strict=True):
                if name in self.figure.placed and value is not None:
                    found = part(values[PointName(name)])
                    off = np.abs(found - value) / (LENGTH_TOLERANCE * size)
                    yield Check(frame[name], f"{axis}_{name}", value, found, "m", off)

    def _offsets(self) -> Iterator[Check]:
        scene, values, size = self.scene, self.values, self.size
        for slider, slide in scene.slides.items():
            line = scene.line_of.get(slider)
            ready = line is not None and slide.pin in self.figure.placed and line in scene.lines
            if ready and line is not None and self.figure.has(line):
                base, direction = self.figure.guide_base(line), self._guide(line)
                if base is None or direction is None:
                    continue
                reach = (values[PointName(slide.pin)] - values[base]) / direction
                off = np.abs(reach.imag - slide.offset) / (LENGTH_TOLERANCE * size)
                name = translate("the distance of {} from its guide", slide.pin)
                node = self.file["links"][slider]
                yield Check(node, name, slide.offset, reach.imag, "m", off)

    def _guide(self, name: str) -> Any:
        """Return the direction of a guide as the frame has it; None where sliders give it."""
        line = self.scene.lines[name]
        if line.angle is None or line.towards is not None:
            return None
        return np.exp(1j * np.radians(line.angle))

    def _direction(self, link: str, line: Any) -> Any:
        """Return the direction of a link: of two points that are placed, else of its axis."""
        points, values = self.scene.links[link].points, self.values
        here = [p for p in points if p in self.figure.placed]
        pairs = [(p, q) for i, p in enumerate(here) for q in here[i + 1 :]]
        pairs = [(p, q) for p, q in pairs if points[p] != points[q]]
        if not pairs:
            return values[line][1]
        p, q = max(pairs, key=lambda pair: abs(points[pair[1]] - points[pair[0]]))
        return (values[PointName(q)] - values[PointName(p)]) / (points[q] - points[p])

    def _between(self, node: FileNode, fact: DrawnFact) -> Check:
        """Compare the angle of two links: of their axes, or of the lines of these."""
        one, two = (
            self.directions[link] * rotation(course)
            for link, course in zip(fact.of, self.scene.headings(fact), strict=True)
        )
        found = np.abs(np.degrees(np.angle(two / one)))
        direct, turned = np.abs(found - fact.value), np.abs(180.0 - found - fact.value)
        off = np.minimum(direct, turned) / ANGLE_TOLERANCE
        return Check(node, fact.key, fact.value, found, "deg", off, turned < direct)

    def _length(self, node: FileNode, name: str, length: float, drawn_lengths: Reals) -> Check:
        off = np.abs(drawn_lengths - length) / (LENGTH_TOLERANCE * length)
        return Check(node, name, length, drawn_lengths, "m", off)
