"""State of the velocity and acceleration plans while they are being planned.

Plan points are kept by (link, place): a point shared by links has one plan point, and where two
links coincide at a place but move differently, the place of the second carries its link's number
(``B3`` is the point of link 3 under pin B).
"""

from __future__ import annotations

from itertools import islice

from msgspec import Struct, field

from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import Draft
from planmethod.plans.model import (
    FACTS,
    ZERO_VECTOR,
    Direction,
    KnownParts,
    PlanKind,
    Vector,
    VectorEquation,
    VectorKind,
    pole_letter,
)
from planmethod.plans.segments import Segments

UNKNOWN_KINDS = (VectorKind.RELATIVE, VectorKind.SLIDING)
"""Components that end in a middle joint: from the pole they are its absolute vector as well."""


def letter(point: str) -> str:
    """Return the plan's letter of a mechanism point in rich text: B3 gives ``b_{3}``.

    A point P (or Π) would have the pole's letter: it keeps its own as an index, ``p_{P}``.
    """
    head, tail = point[:1].lower(), point[1:]
    if head in "pπ" and not tail:
        return f"{head}_{{{point}}}"
    return f"{head}_{{{tail}}}" if tail else head


def _number(vector: Vector) -> str:
    """Return the name of the number that a vector represents: ``v_CB``."""
    return vector.symbol.replace("^{", "").replace("_{", "_").replace("}", "")


class MotionBoard(Struct):
    """One plan being planned (план скоростей или ускорений в работе).

    Attributes
    ----------
    point : dict of (link, place) to PointName
        Plan point of a link's point; ``place`` names a point of the position plan.
    named : dict of str to (str, str)
        Published points: point name to (link, place).
    alias : set of (link, place)
        Points of a link that does not turn: they share the plan point of its first point.
    segments : Segments
        Their values are in m/s or m/s².
    moving : dict of link to list of str
        Places of a link that the plan has, in the order they came.
    """

    kind: PlanKind
    draft: Draft
    pole: PointName
    segments: Segments
    point: dict[tuple[str, str], PointName] = field(default_factory=dict)
    named: dict[str, tuple[str, str]] = field(default_factory=dict)
    moving: dict[str, list[str]] = field(default_factory=dict)
    alias: set[tuple[str, str]] = field(default_factory=set)
    letters: dict[PointName, list[str]] = field(default_factory=dict)
    vectors: list[Vector] = field(default_factory=list)
    equations: list[VectorEquation] = field(default_factory=list)
    _drawn: dict[tuple[PointName, PointName], int] = field(default_factory=dict)
    _read: tuple[int, int] = (0, 0)  # vectors and names that have been read off

    @classmethod
    def start(cls, kind: PlanKind, draft: Draft) -> MotionBoard:
        """Put the pole down: the fixed points are there."""
        pole = draft.b.take_point(FACTS[kind].prefix + "0")
        draft.places[pole] = 0j
        motion = cls(kind, draft, pole, Segments(draft.b, draft.b.known(FACTS[kind].scale)))
        for point in draft.problem.bodies[FRAME].points:
            motion.add_point(FRAME, point, pole, show=bool(motion.sharers(point, FRAME)))
        return motion

    def name(self, point: str) -> str:
        """Return the plan's name of a point."""
        name = FACTS[self.kind].prefix + point
        self.draft.letters[PointName(name)] = point.lower()
        return name

    def sharers(self, point: str, link: str) -> list[str]:
        """Return the other links that a point is a revolute joint of."""
        return [other for other in self.draft.links_of.get(point, ()) if other != link]

    def add_point(
        self, link: str, place: str, at: PointName, *, name: str | None = None, show: bool = True
    ) -> PointName:
        """Note where a link's point is on the plan; a shared joint is noted for all its links."""
        name = name or place
        links = [link, *self.sharers(place, link)] if name == place else [link]
        for each in links:
            if (each, place) not in self.point:
                self.point[each, place] = at
                self.moving.setdefault(each, []).append(place)
        self.named.setdefault(name, (link, place))
        if show:
            shown = self.letters.setdefault(at, [])
            if letter(name) not in shown:
                shown.append(letter(name))
        return at

    def label(self, link: str, place: str) -> str:
        """Return the name of a link's point at a place: ``B3`` if it is under another's pin."""
        bodies = self.draft.problem.bodies
        if place in bodies[link].points or self.draft.is_special(link, place):
            return place
        name = f"{place}{link}"
        return f"{place}({link})" if name in self.draft.links_of else name

    # Segments --------------------------------------------------------------------------------

    def size(self, of: tuple[str, str]) -> NumberName | None:
        """Return the number of the speed (acceleration) of a link's point; None for a fixed one."""
        at = self.point[of]
        return None if at == self.pole else self.segments.values[self.pole, at]

    def read_off(self) -> None:
        """Read every vector and every point that has not been read or laid off yet."""
        for vector in islice(self.vectors, self._read[0], None):
            self.segments.value(vector.tail, vector.head, _number(vector))
        for name, at in islice(self.named.items(), self._read[1], None):
            if self.point[at] != self.pole:
                number = f"{FACTS[self.kind].letter}_{name}"
                self.segments.value(self.pole, self.point[at], number)
        self._read = len(self.vectors), len(self.named)

    # Vectors ---------------------------------------------------------------------------------

    def add(self, vector: Vector) -> Vector:
        """Draw a vector once; a segment from the pole is the absolute vector of its end."""
        ends = (vector.tail, vector.head)
        drawn = self._drawn.get(ends)
        if drawn is None:
            if vector.tail != vector.head:
                self._drawn[ends] = len(self.vectors)
                self.vectors.append(vector)
        elif vector.kind is VectorKind.ABSOLUTE and self.vectors[drawn].kind in UNKNOWN_KINDS:
            self.vectors[drawn] = vector
        return vector

    def absolute(self, name: str, at: PointName, known: KnownParts = KnownParts.BOTH) -> Vector:
        """Return the vector of a point from the pole."""
        direction = ZERO_VECTOR if at == self.pole else None
        symbol = f"{FACTS[self.kind].letter}_{{{name}}}"
        return self.add(Vector(symbol, VectorKind.ABSOLUTE, self.pole, at, known, direction))


def plan_letter(motion: MotionBoard, point: PointName) -> str:
    """Return the letter of a plan point without markup: ``b3``, ``n_CB``, ``p``."""
    if point == motion.pole:
        return pole_letter(motion.draft.problem, motion.kind)
    first = motion.letters.get(point, [str(point)])[0]
    head, brace, tail = first.partition("_{")
    if not brace:
        return first
    tail = tail.rstrip("}")
    return f"{head}_{tail}" if head in ("n", "k") else f"{head}{tail}"


class Ray(Struct, frozen=True):
    """Half of a vector equation: the start and direction of a leg's line on the plan (луч).

    Attributes
    ----------
    start : PointName
        Plan point from which the line of the unknown component is drawn.
    line : LineName
        That line.
    terms : tuple of Vector
        Terms of the equation laid off before the line.
    unknown : (symbol, VectorKind, Direction)
        Component found along the line.
    name : str
        Name of the number read along the line, signed along it.
    """

    start: PointName
    line: LineName
    terms: tuple[Vector, ...]
    unknown: tuple[str, VectorKind, Direction]
    name: str

    def close(self, motion: MotionBoard, head: PointName) -> Vector:
        """Return the unknown component, its end being found."""
        symbol, kind, direction = self.unknown
        return motion.add(Vector(symbol, kind, self.start, head, KnownParts.ONE, direction))
