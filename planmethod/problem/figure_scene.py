"""Data of a drawn position, and lines and arcs of its points (геометрические места)."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Mapping

from msgspec import Struct

from planmethod.mechanism.model import FRAME
from planmethod.problem.model import Body, DrawnFact, DrawnKind, FixedLine, Slide
from planmethod.problem.placement import heading


class Scene(Struct, frozen=True):
    """What a drawn position is built from.

    Attributes
    ----------
    points : mapping of str to (float or None, float or None), m
        Fixed points; None of a coordinate that is drawn.
    lines : mapping of str to FixedLine
        Guides, by the names that ``line_of`` gives their sliders.
    facts : tuple of DrawnFact
        What the figure shows, the angle of the driving crank among it.
    travel : (str, float) or None
        A driving slider and its place on its guide, m.
    unknown : tuple of str
        Fixed points, guides and driving link whose places or directions are sought.
    """

    links: Mapping[str, Body]
    slides: Mapping[str, Slide]
    points: Mapping[str, tuple[float | None, float | None]]
    lines: Mapping[str, FixedLine]
    line_of: Mapping[str, str]
    facts: tuple[DrawnFact, ...]
    travel: tuple[str, float] | None
    unknown: tuple[str, ...]

    def headings(self, fact: DrawnFact) -> tuple[float, ...]:
        """Return the headings of the lines of an angle in the axes of their links, degrees."""
        lines = fact.lines or (None,) * len(fact.of)
        bodies = (self.links[link].points for link in fact.of)
        return tuple(
            0.0 if line is None else heading(body[line[1]] - body[line[0]])
            for body, line in zip(bodies, lines, strict=True)
        )


class Locus(Struct, frozen=True):
    """A line or an arc on which a point must lie; ``by`` says which constraint gives it."""

    point: str
    by: str
    of: tuple[str, ...] = ()
    size: float = 0.0
    headings: tuple[float, ...] = ()

    @property
    def is_arc(self) -> bool:
        """Whether it is an arc."""
        return self.by in ("arc", "angle")


def find_loci(
    point: str,
    scene: Scene,
    *,
    placed: Container[str],
    directions: Container[str],
    has_course: Callable[[str], bool],
    has_base: Callable[[str], bool],
) -> Iterator[Locus]:
    """Yield the lines and arcs of a point that is not placed.

    Parameters
    ----------
    placed, directions : container of str
        Points that are built, and links of known direction.
    has_course, has_base : callable
        Whether the direction, and a point, of a guide is known.
    """
    if point in scene.points:
        for k, value in enumerate(scene.points[point]):
            if value is not None:
                yield Locus(point, "coordinate", ("xy"[k],), value)
    for slider, slide in scene.slides.items():
        name, host = scene.line_of.get(slider), scene.links[slide.host].points
        if name is not None and slide.pin == point:
            if has_course(name) and has_base(name):
                yield Locus(point, "guide", (slider,))
        elif name is not None and scene.lines[name].through == point:
            if has_course(name) and slide.pin in placed:
                yield Locus(point, "through", (slider,))
        elif name is None and slide.host in directions:
            there = [other for other in host if other in placed]
            if slide.pin == point and there:
                yield Locus(point, "slot", (slider, there[0]))
            elif point in host and slide.pin in placed and not there:
                yield Locus(point, "pin", (slider,))
    for link, body in scene.links.items():
        if link == FRAME or link in directions or point not in body.points:
            continue
        for other, place in body.points.items():
            size = abs(body.points[point] - place)
            if other in placed and size:
                yield Locus(point, "arc", (other,), size)
    yield from _angle_loci(point, scene, placed, directions)
    for fact in scene.facts:
        if fact.kind is DrawnKind.LENGTH and point in fact.of:
            other = fact.of[0] if point == fact.of[1] else fact.of[1]
            if other in placed:
                yield Locus(point, "arc", (other,), fact.value)


def _angle_loci(
    point: str, scene: Scene, placed: Container[str], directions: Container[str]
) -> Iterator[Locus]:
    """Yield the arcs of a point on a link whose angle to another one alone is known."""
    bodies = scene.links
    for fact in scene.facts:
        if fact.kind is not DrawnKind.BETWEEN or any(link in directions for link in fact.of):
            continue
        for sense in (1, -1):
            (one, two), headings = fact.of[::sense], scene.headings(fact)[::sense]
            pins = {*bodies[one].points} & {*bodies[two].points}
            if len(pins) != 1 or point not in bodies[two].points or point in pins:
                continue
            for other in bodies[one].points:
                if other in placed and other not in pins:
                    of = (other, one, two, *pins)
                    yield Locus(point, "angle", of, fact.value, headings)


def line_angles(degrees: float) -> tuple[float, ...]:
    """Return how far one axis may be turned from another at an unsigned angle of the two.

    The angle of the axes as the file directs them comes first, in both senses; then that of their
    lines, as a figure may show it.
    """
    found = (degrees, 360.0 - degrees, 180.0 - degrees, 180.0 + degrees)
    return tuple(dict.fromkeys(turn % 360.0 for turn in found))
