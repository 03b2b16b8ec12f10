"""A measured drawing: its plans, their segments and directions as answers."""

# Cyrillic letters: the unit mm and the word variant, as drawings of students write them

from __future__ import annotations

import math
import re
import statistics
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path

from msgspec import Struct
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
from planmethod.check.measured.placement import (
    Placement,
    find_placements,
    has_usual_letters,
    list_other_units,
)
from planmethod.check.measured.vertices import (
    BESIDE_MM,
    SNAP_MM,
    Vertices,
    align_parallel,
    find_parts,
    letter,
    letters_in,
    vertices_of,
    without_barbs,
)
from planmethod.check.model import Submission, Unread, WrittenAnswer
from planmethod.check.questions import normalize
from planmethod.check.sheet import Sheet, single_point
from planmethod.check.submissions.cells import Cell, SubmissionError, mark_unreadable, read_number
from planmethod.check.submissions.gather import SubmissionDraft, scale_name
from planmethod.check.task import Task, TaskItem
from planmethod.construct.steps import PointName
from planmethod.plans.model import FACTS, RATES, PlanKind, pole_letter
from planmethod.problem.quantities import Sign

STEP_MM = 0.01
"""Resolution of a measured drawing, mm."""

PLAN_LINES = 400
"""Lines of both plans, those of arrowheads among them; a plan of a triad has some forty."""

STEP_DEG = 0.01
MIN_LENGTH_MM = 5.0
"""Minimum length of a vector that shows how its plan is placed."""

SAME_SIZE = 0.03
"""Relative difference of sizes from which a drawing may be in another unit."""

_VARIANT = re.compile(
    r"(?<![^\W_])(?:вариант|вар|variant|var)[\s._:№#=-]*([^\W_][^\s_,;()]*)", re.IGNORECASE
)
DETAIL_MM = 20.0
"""Maximum distance between an enlarged detail and its scale, mm."""

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


def open_drawing(path: Path) -> MeasuredDrawing:
    """Return the lines and inscriptions of a drawing.

    Raises
    ------
    WorksError
        The file cannot be read.
    """
    return READERS[path.suffix.lower()](path)


def variant_of(drawing: MeasuredDrawing, names: Collection[str]) -> str | None:
    """Return the variant that is written on a drawing, else in the name of its file.

    Raises
    ------
    WorksError
        The problem has variants, and not this one.
    """
    known = {normalize(name): name for name in names}
    for text in (*(text.text for text in drawing.inscriptions), drawing.path.stem):
        if names and (told := _VARIANT.search(text)):
            if (name := known.get(normalize(told[1]))) is None:
                raise SubmissionError(
                    "{}: the problem has no variant {!r}.", drawing.path, told[1][:60]
                )
            return name
    return None


def read_drawing(drawing: MeasuredDrawing, layers: Mapping[str, str], task: Task) -> Submission:
    """Return the plans of a drawing as a submission: lengths in mm, directions in degrees.

    If the letters or the plans have an impossible size in the stated unit, it may be another one.

    Parameters
    ----------
    layers : mapping of str to str
        Plan of each layer or colour; see `planmethod.check.measured.drawing`.
    task : Task
        Of the variant that is drawn.

    Raises
    ------
    WorksError
        No layer is that of a plan.
    """
    work, factor = _measure(drawing, layers, task)
    if abs(factor - 1.0) < SAME_SIZE:
        return work
    fitting: list[tuple[bool, float, Submission]] = []
    for unit, other in list_other_units(drawing):
        found, factor = _measure(other, layers, task)
        fitting.append((abs(factor - 1.0) >= SAME_SIZE, unit, found))
    other_size, unit, found = min(fitting, default=(True, 0.0, work), key=lambda one: one[0])
    if not unit or (other_size and has_usual_letters(drawing)):
        return work
    remark = mark_unreadable(Unread.DRAWING_UNIT, f"{unit:g}", drawing.path.name)
    return replace(found, remarks=(*found.remarks, remark))


def _measure(
    drawing: MeasuredDrawing, layers: Mapping[str, str], task: Task
) -> tuple[Submission, float]:
    """Return the answers of a drawing, and the size of its plans relative to the exact ones."""
    path = drawing.path
    draft = SubmissionDraft(path.stem, str(path), variant=task.variant)
    _read_scales(draft, drawing.inscriptions)
    hand = PROFILE_BY_SUFFIX[path.suffix.lower()]
    items = list_drawing_items(task)
    sheet = task.sheet(task.first, draft.scales, drawn=hand)
    found = {plan.kind: plan for plan in _plans(drawing, layers, sheet, draft, task.count)}
    for kind in RATES:
        if kind not in found and any(item.question.plan is kind for item in items):
            draft.remark(Unread.PLAN, FACTS[kind].pole, path.name)
    vectors = {kind: list(_vectors(plan, sheet)) for kind, plan in found.items()}
    placements = find_placements(vectors)
    _remark_placements(draft, placements, path.name)
    answers = list(_answers(items, sheet, found, placements, draft, path.name))
    sizes = [abs(drawn / exact) for pairs in vectors.values() for drawn, exact in pairs]
    return (
        replace(draft.build(), answers=tuple(answers), drawn=hand),
        statistics.median(sizes) if sizes else math.inf,
    )


def _vectors(plan: DetectedPlan, sheet: Sheet) -> Iterator[tuple[complex, complex]]:
    """Yield the vectors of a plan that are long enough, as drawn and as they are exactly."""
    value = sheet.exact_trace.value
    own = sheet.questions.construction.plan(plan.kind).vectors
    for tail, head in dict.fromkeys((vector.tail, vector.head) for vector in own):
        drawn = plan.vector(tail, head)
        if drawn is not None and tail in value and head in value:
            exact = single_point(value[head]) - single_point(value[tail])
            if min(abs(drawn), abs(exact)) > MIN_LENGTH_MM:
                yield drawn, exact


def _remark_placements(
    draft: SubmissionDraft, placements: Mapping[PlanKind, Placement], name: str
) -> None:
    if any(placement.mirrored for placement in placements.values()):
        draft.remark(Unread.MIRRORED, "", name)
        return
    for kind, placement in placements.items():
        if placement.turn_deg:
            draft.remark(Unread.TURNED, f"{placement.turn_deg:.1f}°", f"{name}, {FACTS[kind].pole}")


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
    for kind, lines in own.items():
        own[kind] = align_parallel(without_barbs(lines))
    found = find_parts(align_parallel(without_barbs(mixed)), BESIDE_MM)
    for part in _without_details(found, drawing.inscriptions):
        pole = _kind_of(part, drawing.inscriptions)
        if pole is not None:
            parts[pole].append(part)
    for kind in RATES:
        told = [part for part in find_parts(own[kind]) if _kind_of(part, drawing.inscriptions)]
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
            yield _lettered(kind, lines, marks, drawing.inscriptions, sheet, draft)


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
    names: dict[PointName, list[str]] = {}
    for name, point in known.items():
        names.setdefault(point, []).append(name)
    joined = {
        frozenset(pair)
        for v in plan.vectors
        for pair in product(names.get(v.tail, ()), names.get(v.head, ()))
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
    placements: Mapping[PlanKind, Placement],
    draft: SubmissionDraft,
    name: str,
) -> Iterator[WrittenAnswer]:
    missing: dict[tuple[str, PlanKind], None] = {}
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
            placement = placements[question.plan]
            value = round(placement.direction(vector * question.direction_sign), 2)
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
