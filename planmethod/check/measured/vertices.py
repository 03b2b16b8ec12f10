"""Vertices of a plan and their letters (вершины плана и их буквы)."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.check.measured.drawing import DrawnLetters, DrawnLine
from planmethod.check.questions import normalize

SNAP_MM = 0.3
"""Ends of lines nearer than this are one vertex."""

BESIDE_MM = 4.0
"""Maximum distance of a vector from a longer one of its line beside which it is drawn."""

NEAR_MM, NEAR_HEIGHTS = 5.0, 4.0
"""Maximum distance of a letter from its vertex: millimetres, or heights of the letter if more."""

STRAIGHT = 2e-3
"""Maximum bend between lines that continue each other, radians."""

BARB_MM, BARB_SINE = 6.0, 0.6
"""Strokes of an arrowhead: maximum length, and maximum sine of their angle."""

MIDDLE_WEIGHT = 0.1
"""Weight of the distance to the middle of a letter, relative to that to its box."""

JOINED = 4.0
"""Bonus, mm, for two letters joined by a line like the vectors of the plan."""

DOUBT = 0.5
"""Cost difference of two placements, mm, below which a letter is ambiguous."""

ROUNDS = 100

_SEPARATORS = re.compile(r"[,;≡=\s]+")


class Vertices(Struct):
    """Vertices of a plan and their letters (вершины плана).

    Attributes
    ----------
    places : list of complex
        mm.
    lines : list of (int, int)
        Vertices that a line joins, from the first to the second.
    longer : list of (int, int)
        The same of lines that go straight on from one another.
    by_letter : dict of str to int
        Vertex by its letter, as `normalize` has it.
    unlabelled : dict of str to list of int
        Vertices without a letter that have this one next to them: where a line ends that does not
        meet the others.
    unlettered : list of int
        Vertices without a nearby letter.
    inner : set of int
        Vertices from which a line goes straight on.
    ambiguous : list of str
        Letters that may as well name another vertex.
    """

    places: list[complex]
    lines: list[tuple[int, int]]
    longer: list[tuple[int, int]] = field(default_factory=list)
    by_letter: dict[str, int] = field(default_factory=dict)
    unlabelled: dict[str, list[int]] = field(default_factory=dict)
    unlettered: list[int] = field(default_factory=list)
    inner: set[int] = field(default_factory=set)
    ambiguous: list[str] = field(default_factory=list)


def letters_in(text: str) -> list[str]:
    """Return the letters of an inscription: ``p, a, c`` and ``e ≡ d`` are several."""
    return [letter for letter in map(normalize, _SEPARATORS.split(text)) if letter]


def without_barbs(lines: Sequence[DrawnLine]) -> list[DrawnLine]:
    """Return lines without the strokes of arrowheads: two short ones to both sides of a tip."""
    left = list(lines)
    for shaft in lines:
        for tip, tail in ((shaft.end, shaft.start), (shaft.start, shaft.end)):
            along = (tip - tail) / shaft.length
            sides: dict[bool, DrawnLine] = {}
            for stroke in left:
                off = _from(stroke, tip)
                if off is None or stroke.length > min(BARB_MM, shaft.length / 2):
                    continue
                way = off * along.conjugate() / stroke.length
                if way.real < 0 and 0 < abs(way.imag) < BARB_SINE:
                    sides[way.imag > 0] = stroke
            if len(sides) == 2:
                ends = [tip + (_from(s, tip) or 0j) for s in sides.values()]
                left = [s for s in left if s not in sides.values() and not _joins(s, ends)]
    return left


def _from(line: DrawnLine, place: complex) -> complex | None:
    """Return where a line leads from a place; None if it does not end there."""
    if abs(line.start - place) < SNAP_MM:
        return line.end - line.start
    return line.start - line.end if abs(line.end - place) < SNAP_MM else None


def _joins(line: DrawnLine, ends: Sequence[complex]) -> bool:
    """Return whether a line closes the triangle of an arrowhead."""
    own = (line.start, line.end)
    return all(min(abs(end - place) for place in own) < SNAP_MM for end in ends)


def find_parts(lines: Sequence[DrawnLine], max_gap: float = SNAP_MM) -> list[list[DrawnLine]]:
    """Return connected lines, part by part; ``max_gap`` is in mm."""
    parts: list[list[DrawnLine]] = []
    for line in lines:
        meets = [part for part in parts if any(_gap(line, other) < max_gap for other in part)]
        parts = [part for part in parts if part not in meets]
        parts.append([line, *(other for part in meets for other in part)])
    return parts


def _gap(one: DrawnLine, two: DrawnLine) -> float:
    """Return the least distance of an end of one of two lines from the other, mm."""
    return min(
        _distance(end, line)
        for line, other in ((one, two), (two, one))
        for end in (other.start, other.end)
    )


def _distance(place: complex, line: DrawnLine) -> float:
    along = (line.end - line.start) / line.length
    on = (place - line.start) * along.conjugate()
    return abs(complex(on.real - min(max(on.real, 0.0), line.length), on.imag))


def align_parallel(lines: Sequence[DrawnLine]) -> list[DrawnLine]:
    """Return lines with those that are drawn beside a longer one moved onto it.

    Vectors on one line would hide one another, and are drawn apart (условно разнесены).
    """
    parts = find_parts(lines)
    if len(parts) == 1:
        return list(lines)
    aligned: list[DrawnLine] = []
    for part in parts:
        others = [line for other in parts if other is not part for line in other]
        shifts = [shift for line in others if (shift := _shift_onto(part, line)) is not None]
        shift = min(shifts, key=abs, default=0j)
        aligned += [replace(line, start=line.start + shift, end=line.end + shift) for line in part]
    return aligned


def _shift_onto(part: Sequence[DrawnLine], line: DrawnLine) -> complex | None:
    """Return the shift of a part onto a line beside it; None if it is not parallel or not near."""
    along = (line.end - line.start) / line.length
    ways = [(one.end - one.start) / along for one in part]
    if any(abs(way.imag) > STRAIGHT * abs(way.real) for way in ways):
        return None
    ends = [(end - line.start) / along for one in part for end in (one.start, one.end)]
    low, high = min(end.real for end in ends), max(end.real for end in ends)
    if high - low > line.length or low > line.length or high < 0 or abs(ends[0].imag) > BESIDE_MM:
        return None
    return -1j * ends[0].imag * along


def vertices_of(lines: Iterable[DrawnLine], marks: Iterable[complex] = ()) -> Vertices:
    """Return the ends of lines as vertices, those together that meet."""
    found = Vertices([], [])

    def at(place: complex) -> int:
        for number, other in enumerate(found.places):
            if abs(other - place) < SNAP_MM:
                return number
        found.places.append(place)
        return len(found.places) - 1

    for line in lines:
        ends = at(line.start), at(line.end)
        if ends[0] != ends[1]:
            found.lines.append(ends)
    for mark in marks:
        at(mark)
    _lengthen(found)
    return found


def _lengthen(vertices: Vertices) -> None:
    """Add the joined line for lines that continue each other straight."""
    seen: set[tuple[int, int]] = set()
    for middle in range(len(vertices.places)):
        whole = [*vertices.lines, *vertices.longer]
        ends = [one if two == middle else two for one, two in whole if middle in (one, two)]
        for number, one in enumerate(ends):
            for two in ends[:number]:
                way = (vertices.places[one] - vertices.places[middle]) / (
                    vertices.places[middle] - vertices.places[two]
                )
                if way.real > 0 and abs(way.imag) < STRAIGHT * way.real:
                    vertices.inner.add(middle)
                    if (pair := (min(one, two), max(one, two))) not in seen:
                        seen.add(pair)
                        vertices.longer.append(pair)


class _Placing:
    """Placement of inscriptions at vertices: by distance, and by the lines of the plan."""

    def __init__(
        self,
        vertices: Vertices,
        inscriptions: Sequence[tuple[DrawnLetters, list[str]]],
        joined: Collection[frozenset[str]],
    ) -> None:
        self.lines = {frozenset(pair) for pair in (*vertices.lines, *vertices.longer)}
        self.joined = joined
        self.letters = [letters for _, letters in inscriptions]
        self.distances: list[dict[int, float]] = []
        for text, _ in inscriptions:
            near = max(NEAR_MM, NEAR_HEIGHTS * text.high)
            found = (
                (v, text.distance_to(at), abs(text.at - at)) for v, at in enumerate(vertices.places)
            )
            self.distances.append(
                {v: apart + MIDDLE_WEIGHT * far for v, apart, far in found if apart < near}
            )
        self.at: dict[int, int] = {}

    def place(self) -> None:
        """Give inscriptions their vertices, the nearest first; then better ones while there are."""
        pairs = sorted(
            (d, n, v) for n, found in enumerate(self.distances) for v, d in found.items()
        )
        for _, number, vertex in pairs:
            if number not in self.at and vertex not in self.at.values():
                self.at[number] = vertex
        for _ in range(ROUNDS):
            better = [self._worse(at) for at in self._alternatives()]
            least = min(better, key=lambda pair: pair[0], default=(0.0, self.at))
            if least[0] > -1e-9:
                return
            self.at = least[1]

    def find_ambiguous(self) -> set[int]:
        """Return the inscriptions for which another placement is nearly as good."""
        found: set[int] = set()
        for at in self._alternatives():
            if self._worse(at)[0] < DOUBT:
                found |= {number for number, vertex in at.items() if self.at[number] != vertex}
        return found

    def _alternatives(self) -> Iterator[dict[int, int]]:
        """Yield placings with two inscriptions exchanged, or one by a free vertex."""
        taken = {vertex: number for number, vertex in self.at.items()}
        for number, vertex in self.at.items():
            for to in self.distances[number]:
                other = taken.get(to)
                if other is None:
                    yield {**self.at, number: to}
                elif other < number and vertex in self.distances[other]:
                    yield {**self.at, number: to, other: vertex}

    def _worse(self, at: dict[int, int]) -> tuple[float, dict[int, int]]:
        return self._cost(at) - self._cost(self.at), at

    def _cost(self, at: Mapping[int, int]) -> float:
        where = {letter: at[n] for n in at for letter in self.letters[n]}
        met = {
            frozenset(where[letter] for letter in pair)
            for pair in self.joined
            if pair <= where.keys()
        }
        return sum(self.distances[n][v] for n, v in at.items()) - JOINED * len(met & self.lines)


def letter(
    vertices: Vertices,
    texts: Iterable[DrawnLetters],
    known: Collection[str],
    joined: Collection[frozenset[str]] = (),
) -> Vertices:
    """Give vertices their letters.

    A letter whose vertex is taken is added there if it is nearly as close; the remaining vertices
    are identified by the nearest letter.

    Parameters
    ----------
    joined : collection of pairs
        Letters that vectors of such a plan join, whatever they measure.
    """
    told = [(text, letters_in(text.text)) for text in texts]
    told = [(text, letters) for text, letters in told if letters and {*letters} <= {*known}]
    placing = _Placing(vertices, told, joined)
    placing.place()
    given = dict(placing.at)
    taken = {vertex: number for number, vertex in given.items()}
    for number, found in enumerate(placing.distances):  # two inscriptions at one vertex
        for vertex, apart in sorted(found.items(), key=lambda pair: pair[1])[:1]:
            other = taken.get(vertex)
            most = 0.0 if other is None else placing.distances[other][vertex] + told[number][0].high
            if number not in given and apart < most:
                given[number] = vertex
    doubtful = placing.find_ambiguous()
    for number, vertex in given.items():
        for name in told[number][1]:
            vertices.by_letter.setdefault(name, vertex)
            if number in doubtful:
                vertices.ambiguous.append(name)
    for vertex in range(len(vertices.places)):
        if vertex in taken:
            continue
        beside = [
            (found[vertex], n) for n, found in enumerate(placing.distances) if vertex in found
        ]
        if not beside:
            if vertex not in vertices.inner:
                vertices.unlettered.append(vertex)
            continue
        for name in told[min(beside)[1]][1]:
            vertices.unlabelled.setdefault(name, []).append(vertex)
    return vertices
