"""A measured drawing: letters at the vertices, segments and directions of its plans."""

# Cyrillic letters: the unit mm, as drawings of students write it

from __future__ import annotations

import math
import re
from cmath import phase
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.check.measured.drawing import (
    PLANS,
    PROFILE_BY_SUFFIX,
    DrawnLetters,
    DrawnLine,
    MeasuredDrawing,
    plan_of_layer,
)
from planmethod.check.measured.drawing_questions import list_drawing_items, vector_of
from planmethod.check.measured.files import read_dxf, read_svg
from planmethod.check.model import Submission, Unread, WrittenAnswer
from planmethod.check.questions import normalize
from planmethod.check.sheet import Sheet, single_point
from planmethod.check.submissions.cells import Cell, SubmissionError, mark_unreadable, read_number
from planmethod.check.submissions.gather import SubmissionDraft, scale_name
from planmethod.check.task import Task, TaskItem
from planmethod.construct.steps import PointName
from planmethod.plans.model import FACTS, RATES, PlanKind, Vector, pole_letter
from planmethod.problem.quantities import Sign

SNAP_MM = 0.3
"""Ends of lines nearer than this are one vertex."""

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
        met = sum(
            frozenset(where[letter] for letter in pair) in self.lines
            for pair in self.joined
            if pair <= where.keys()
        )
        return sum(self.distances[n][v] for n, v in at.items()) - JOINED * met


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


STEP_MM = 0.01
"""Resolution of a measured drawing, mm."""

PLAN_LINES = 400
"""Lines of both plans, those of arrowheads among them; a plan of a triad has some forty."""

STEP_DEG = 0.01
SAME_DEG = 2.0
"""Maximum difference of the rotations of vectors for the plan to be rotated as a whole."""

MIN_ROTATION_DEG = 5.0
MIN_LENGTH_MM = 5.0
DETAIL_MM = 20.0
"""Maximum distance between an enlarged detail and its scale, mm."""

MIN_ROTATED_VECTORS = 3
"""Minimum number of vectors of sufficient length that must be rotated equally."""

LIKE_DEG = 10.0
"""Half a turn is a mistake: the crank turned the other way. So near to it no drawing is put."""

READERS: Mapping[str, Callable[[Path], MeasuredDrawing]] = {".dxf": read_dxf, ".svg": read_svg}


class DetectedPlan(Struct):
    """One plan of a drawing with its letters (найденный план)."""

    kind: PlanKind
    vertices: Vertices
    at: dict[PointName, list[int]]
    """Vertices of a point of the plan: its own first, then those next to its letter."""
    ambiguous: frozenset[PointName] = frozenset()
    """Points whose letters may name another vertex."""

    def vector(self, tail: PointName, head: PointName) -> complex | None:
        """Return a segment as it is drawn, mm; between the vertices if no line joins them."""
        tails, heads = self.at.get(tail, []), self.at.get(head, [])
        if not tails or not heads:
            return None
        pairs = [(one, two) for one in tails for two in heads]
        drawn, longer = (
            [pair for pair in pairs if pair in lines or pair[::-1] in lines]
            for lines in (self.vertices.lines, self.vertices.longer)
        )
        one, two = (drawn or longer or pairs)[0]
        return self.vertices.places[two] - self.vertices.places[one]


def read_drawing(path: Path, layers: Mapping[str, str], task: Task) -> Submission:
    """Return the plans of a drawing as a submission: lengths in mm, directions in degrees.

    Parameters
    ----------
    layers : mapping of str to str
        Plan of each layer or colour; see `planmethod.check.measured.drawing`.
    task : Task
        Of the variant that is drawn.

    Raises
    ------
    WorksError
        The file cannot be read, or no layer of it is that of a plan.
    """
    drawing = READERS[path.suffix.lower()](path)
    draft = SubmissionDraft(path.stem, str(path), variant=task.variant)
    _read_scales(draft, drawing.inscriptions)
    hand = PROFILE_BY_SUFFIX[path.suffix.lower()]
    items = list_drawing_items(task)
    sheet = task.sheet(task.first, drawn=hand)
    found = {plan.kind: plan for plan in _plans(drawing, layers, sheet, draft, task.count)}
    for kind in RATES:
        if kind not in found and any(item.question.plan is kind for item in items):
            draft.remark(Unread.PLAN, FACTS[kind].pole, path.name)
    answers = list(_answers(items, sheet, found, draft, path.name))
    return replace(draft.build(), answers=tuple(answers), drawn=hand)


def _read_scales(draft: SubmissionDraft, texts: Sequence[DrawnLetters]) -> None:
    """Read the scales written on the drawing: ``μ_v = 0,05 (м/с)/мм``."""
    for text in texts:
        name, equal, value = text.text.partition("=")
        scale = scale_name(name) if equal else ""
        if not scale or scale in draft.scales:
            continue
        if per_unit := re.match(r"\s*([\d.,]{1,20})\s*(?:mm|мм)\s*/", value):
            number = read_number(per_unit[1])  # millimetres of a unit: the other convention
            value = f"{1.0 / number.value!r}" if number is not None and number.value else value
        draft.set_scale(scale, Cell(value.strip(), f"{Path(draft.location).name}"), "")


# Which lines are a plan ----------------------------------------------------------------------


def _plans(
    drawing: MeasuredDrawing,
    layers: Mapping[str, str],
    sheet: Sheet,
    draft: SubmissionDraft,
    count: int,
) -> Iterator[DetectedPlan]:
    own: dict[PlanKind, list[DrawnLine]] = {kind: [] for kind in RATES}
    mixed: list[DrawnLine] = []
    for line in drawing.lines:
        plan = plan_of_layer(layers, line.layer, line.colour)
        if plan == PLANS:
            mixed.append(line)
        elif plan:
            own[PlanKind(plan)].append(line)
    if not mixed and not any(own.values()):
        shown = ", ".join(dict.fromkeys(line.layer for line in drawing.lines)) or "—"
        raise SubmissionError(
            "{}: no layer contains a plan. Layers with lines: {}. Name one: --layer "
            "NAME=velocity, NAME=acceleration, or NAME=plans for both plans.",
            drawing.path,
            shown[:300],
        )
    if len(mixed) + sum(map(len, own.values())) > PLAN_LINES:
        raise SubmissionError(
            "{}: over {} lines are plans. Name their layers.", drawing.path, PLAN_LINES
        )
    parts: dict[PlanKind, list[list[DrawnLine]]] = {kind: [] for kind in RATES}
    for part in _without_details(_parts(without_barbs(mixed)), drawing.inscriptions):
        kind = _kind_of(part, drawing.inscriptions)
        if kind is not None:
            parts[kind].append(part)
    for kind in RATES:
        told = [
            part
            for part in _parts(without_barbs(own[kind]))
            if _kind_of(part, drawing.inscriptions)
        ]
        several = parts[kind] if len(parts[kind]) > 1 else told
        lines = [*own[kind], *(line for part in parts[kind] for line in part)]
        if len(several) > 1:  # one for each position
            at = sheet.questions.position
            lines = _in_order(several)[at] if len(several) == count else []
            if not lines:
                where = f"{Path(draft.location).name}, {FACTS[kind].pole}"
                draft.remark(Unread.SEVERAL, str(len(several)), where)
        if lines:
            marks = [
                at
                for at, layer, colour in drawing.points
                if plan_of_layer(layers, layer, colour) == kind.value
            ]
            yield _lettered(kind, without_barbs(lines), marks, drawing.inscriptions, sheet, draft)


def _without_details(
    parts: Sequence[list[DrawnLine]], texts: Sequence[DrawnLetters]
) -> list[list[DrawnLine]]:
    """Return parts without the enlarged details, marked by a text like ``Б (10:1)``."""
    left = list(parts)
    for text in texts:
        if re.search(r"\(\d{1,3}:1\)", text.text):
            apart = [
                min(text.distance_to(end) for line in part for end in (line.start, line.end))
                for part in left
            ]
            if min(apart, default=DETAIL_MM) < DETAIL_MM:
                del left[apart.index(min(apart))]
    return left


def _in_order(parts: Sequence[list[DrawnLine]]) -> list[list[DrawnLine]]:
    """Return plans as they are read: row by row, from the left."""
    boxes = [(part, [end for line in part for end in (line.start, line.end)]) for part in parts]
    rows: list[list[tuple[float, list[DrawnLine]]]] = []
    low = -math.inf
    for part, ends in sorted(boxes, key=lambda box: -max(end.imag for end in box[1])):
        top, bottom = (take(end.imag for end in ends) for take in (max, min))
        if not rows or (top + bottom) / 2 < low:
            rows.append([])
            low = bottom
        rows[-1].append((min(end.real for end in ends), part))
    return [part for row in rows for _, part in sorted(row, key=lambda pair: pair[0])]


def _parts(lines: Sequence[DrawnLine]) -> list[list[DrawnLine]]:
    """Return lines that hang together, part by part."""
    parts: list[list[DrawnLine]] = []
    for line in lines:
        meets = [part for part in parts if any(_touch(line, other) for other in part)]
        parts = [part for part in parts if part not in meets]
        parts.append([line, *(other for part in meets for other in part)])
    return parts


def _touch(one: DrawnLine, two: DrawnLine) -> bool:
    return any(
        _distance(end, line) < SNAP_MM
        for line, other in ((one, two), (two, one))
        for end in (other.start, other.end)
    )


def _distance(place: complex, line: DrawnLine) -> float:
    along = (line.end - line.start) / line.length
    on = (place - line.start) * along.conjugate()
    return abs(complex(on.real - min(max(on.real, 0.0), line.length), on.imag))


def _kind_of(part: Sequence[DrawnLine], texts: Sequence[DrawnLetters]) -> PlanKind | None:
    """Return which plan it is by the letter of its pole: p, or π and p′ of the accelerations."""
    vertices = vertices_of(part)
    poles = [text for text in texts if letters_in(text.text)[:1] in (["p"], ["π"])]
    near = letter(vertices, poles, {"p", "π", *(x for t in poles for x in letters_in(t.text))})
    if "π" in near.by_letter:
        return PlanKind.ACCELERATION
    if "p" not in near.by_letter:
        return None
    place = near.places[near.by_letter["p"]]
    text = min(
        (t for t in poles if "p" in letters_in(t.text)), key=lambda t: t.distance_to(place)
    ).text
    return PlanKind.ACCELERATION if text[1:2] in ("'", "′", "’") else PlanKind.VELOCITY


def _lettered(
    kind: PlanKind,
    lines: Sequence[DrawnLine],
    marks: Sequence[complex],
    texts: Sequence[DrawnLetters],
    sheet: Sheet,
    draft: SubmissionDraft,
) -> DetectedPlan:
    known = sheet.questions.lettered(kind)
    plan = sheet.questions.construction.plan(kind)
    of = {at: name for name, at in known.items()}
    joined = {
        frozenset((of[v.tail], of[v.head])) for v in plan.vectors if {v.tail, v.head} <= {*of}
    }
    vertices = letter(vertices_of(lines, marks), texts, known, joined)
    pole = plan.pole
    at: dict[PointName, list[int]] = {}
    for name, vertex in vertices.by_letter.items():
        at.setdefault(known[name], []).append(vertex)
    where = f"{Path(draft.location).name}, {FACTS[kind].pole}"
    for name, beside in vertices.unlabelled.items():
        at.setdefault(known[name], []).extend(beside)
        for vertex in (one for one in beside if one not in vertices.inner):
            draft.remark(Unread.OPEN, f"{name}: {_format_point(vertices.places[vertex])}", where)
    if pole is not None and pole not in at and len(marks) == 1:  # a point without a letter
        at[pole] = [v for v, place in enumerate(vertices.places) if abs(place - marks[0]) < SNAP_MM]
        vertices.unlettered = [vertex for vertex in vertices.unlettered if vertex not in at[pole]]
    for vertex in vertices.unlettered:
        draft.remark(Unread.VERTEX, _format_point(vertices.places[vertex]), where)
    doubtful = frozenset(known[name] for name in vertices.ambiguous)
    return DetectedPlan(
        kind, vertices, {name: list(dict.fromkeys(v)) for name, v in at.items()}, doubtful
    )


def _format_point(place: complex) -> str:
    return f"({place.real:.1f}; {place.imag:.1f})"


# What is measured ----------------------------------------------------------------------------


def _answers(
    items: Sequence[TaskItem],
    sheet: Sheet,
    plans: Mapping[PlanKind, DetectedPlan],
    draft: SubmissionDraft,
    name: str,
) -> Iterator[WrittenAnswer]:
    missing: dict[tuple[str, PlanKind], None] = {}
    turns = {kind: _rotations(plan, sheet) for kind, plan in plans.items()}
    both = _common_rotation([turn for own in turns.values() for turn in own])
    turned = {kind: both or _common_rotation(own) for kind, own in turns.items()}
    for kind, turn in turned.items():
        if turn:
            draft.remark(Unread.TURNED, f"{turn:.1f}°", f"{name}, {FACTS[kind].pole}")
    for item in items:
        question = vector_of(sheet, item.question)
        plan = None if question.plan is None else plans.get(question.plan)
        if plan is None or question.plan is None or question.ends is None:
            continue
        vector = plan.vector(*question.ends)
        if vector is None:
            for end in question.ends:
                if end not in plan.at:
                    missing.setdefault((_letters(sheet, question.plan, end), question.plan))
            continue
        where = f"{name}, {item.id}"
        if doubtful := plan.ambiguous.intersection(question.ends):
            shown = ", ".join(sorted(_letters(sheet, question.plan, end) for end in doubtful))
            base = WrittenAnswer(id=item.id, position=item.position)
            yield mark_unreadable(Unread.DOUBT, shown, where, base=base)
            continue
        if item.question.sign is not Sign.ANGLE:
            mm = round(abs(vector), 2)
            yield WrittenAnswer(
                id=item.id, mm=mm, mm_step=STEP_MM, raw=f"{mm:g}", location=where,
                position=item.position,
            )  # fmt: skip
        elif abs(vector) > SNAP_MM:
            degrees = math.degrees(phase(vector * question.direction_sign)) - turned[question.plan]
            value = round((degrees + 180.0) % 360.0 - 180.0, 2)
            yield WrittenAnswer(
                id=item.id, value=value, unit="°", step=STEP_DEG, raw=f"{value:g}°", location=where,
                position=item.position,
            )  # fmt: skip
    for letters, kind in missing:
        draft.remark(Unread.LETTER, letters, f"{name}, {FACTS[kind].pole}")


def _letters(sheet: Sheet, kind: PlanKind, point_name: PointName) -> str:
    plan = sheet.questions.construction.plan(kind)
    if point_name == plan.pole:
        return pole_letter(sheet.questions.solution.problem, kind)
    return normalize(plan.letters.get(point_name, str(point_name)))


def _rotations(plan: DetectedPlan, sheet: Sheet) -> list[float]:
    """Return by how many degrees the vectors of a plan are turned."""
    turns: list[float] = []
    value = sheet.exact_trace.value
    for tail, head in dict.fromkeys((v.tail, v.head) for v in _vectors(sheet, plan.kind)):
        drawn = plan.vector(tail, head)
        if drawn is None or tail not in value or head not in value:
            continue
        exact = single_point(value[head]) - single_point(value[tail])
        if min(abs(drawn), abs(exact)) > MIN_LENGTH_MM:
            turns.append(math.degrees(phase(drawn / exact)))
    return turns


def _vectors(sheet: Sheet, kind: PlanKind) -> Sequence[Vector]:
    return sheet.questions.construction.plan(kind).vectors


def _common_rotation(turns: Sequence[float]) -> float:
    """Return by how many degrees vectors are turned as a whole; 0 where they are not."""
    if len(turns) < MIN_ROTATED_VECTORS:
        return 0.0
    off = [(turn - turns[0] + 180.0) % 360.0 - 180.0 for turn in turns]
    mean = (turns[0] + math.fsum(off) / len(off) + 180.0) % 360.0 - 180.0
    alike = max(off) - min(off) < SAME_DEG
    return mean if alike and MIN_ROTATION_DEG < abs(mean) < 180.0 - LIKE_DEG else 0.0
