"""A student's segments over the true plan (план студента поверх верного)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.model import Diagnosis, GradedAnswer, GradedSubmission, Verdict
from planmethod.construct.steps import PointName
from planmethod.note.narrate.naming import scale_inscription
from planmethod.note.wording import Language
from planmethod.plans.model import FACTS, RATES, PlanKind
from planmethod.render.backends import render
from planmethod.render.backends.canvas import Options, draw_sheet
from planmethod.render.backends.pdf import PageCanvas, registered
from planmethod.render.ink.drawing import Bounds, Drawing, Fill, Item, Pen, Stroke, shifted
from planmethod.render.ink.lettering import STYLES, OutlineLettering
from planmethod.render.ink.typeset import ink_bounds
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.planview import plan_picture, plan_places
from planmethod.render.symbols import vector_arrow
from planmethod.solved.reading import memoized
from planmethod.solved.solution import Solution

NOT_RIGHT = (Verdict.WRONG, Verdict.NEAR, Verdict.INHERITED)
MARGIN = 3.0
"""Room around everything, mm."""

LARGEST = 2.5
"""Length limit of a drawn segment, in sizes of the true plan: longer ones would dwarf it."""


class StudentSegment(Struct, frozen=True):
    """A segment as the student has it, mm of the drawing (отрезок студента).

    ``number`` is that of its answer in the table, None for a vector of a mistake's plan only.
    """

    tail: complex
    head: complex
    is_right: bool
    number: int | None

    @property
    def label_at(self) -> complex:
        """Position of its number: on the line, nearer to the head."""
        return self.tail + 0.62 * (self.head - self.tail)

    def items(self) -> list[Item]:
        """Return its ink: a line and an arrowhead."""
        return vector_arrow(self.tail, self.head)


class Overlay(Struct, frozen=True):
    """One plan with a student's segments.

    Attributes
    ----------
    kind : PlanKind
    index : int
        Position of the driver, from 0.
    drawing : Drawing
        The true plan.
    student_segments : tuple of Own
    bounds : Bounds
        Visible part of the drawing's plane, mm.
    scale : str
        Inscription of the scale, rich text.
    mistake : str
        Code of the mistake whose plan is shown; empty if there is none.
    """

    kind: PlanKind
    index: int
    drawing: Drawing
    student_segments: tuple[StudentSegment, ...]
    bounds: Bounds
    scale: str
    mistake: str = ""

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, mm."""
        left, low, right, high = self.bounds
        return right - left, high - low


def overlays(solution: Solution, checked: GradedSubmission, language: Language) -> list[Overlay]:
    """Return the plans of velocities and accelerations in the position where trouble begins."""
    index = _position(checked, len(solution.positions))
    made = (_overlay(solution, checked, kind, index, language) for kind in RATES)
    return [overlay for overlay in made if overlay is not None]


def _position(checked: GradedSubmission, count: int) -> int:
    """Return the drawn position: that of the first root, else of the first wrong answer."""
    roots = {id for diagnosis in checked.diagnosis for id in diagnosis.roots}
    told = [judged for judged in checked.answers if judged.key is not None]
    for chosen in (
        [judged for judged in told if judged.id in roots],
        [judged for judged in told if judged.verdict in NOT_RIGHT],
        told,
    ):
        for judged in chosen:
            if judged.key is not None and judged.key.position < count:
                return judged.key.position
    return 0


@memoized
def true_plan(solution: Solution, kind: PlanKind, index: int) -> tuple[Drawing, complex]:
    """Return a plan alone as a drawing, and the place of its pole there."""
    picture: Picture = plan_picture(solution, kind, index)
    pole = complex(MARGIN - picture.bounds[0], MARGIN - picture.bounds[1])
    drawing = Drawing(picture.width + 2 * MARGIN, picture.height + 2 * MARGIN)
    drawing.extend(shifted(picture.items, pole))
    return drawing, pole


@memoized
def ends_by_letters(solution: Solution, kind: PlanKind) -> Mapping[str, PointName]:
    """Return the points of a plan by their letters without markup: ``b3``, ``n_CB`` as ``nCB``."""
    plan = solution.construction.plan(kind)
    found: dict[str, PointName] = {}
    for point, letters in plan.letters.items():
        for letter in letters.split(", "):
            found.setdefault(_strip_markup(letter), point)
    assert plan.pole is not None
    found[FACTS[kind].pole] = found[str(plan.pole)[:1]] = plan.pole
    return found


def _strip_markup(letter: str) -> str:
    return letter.replace("_{", "").replace("_", "").rstrip("}")


def _overlay(
    solution: Solution, checked: GradedSubmission, kind: PlanKind, index: int, language: Language
) -> Overlay | None:
    drawing, pole = true_plan(solution, kind, index)
    at = plan_places(solution, kind, index)
    if max(abs(p - q) for p in at.values() for q in at.values()) < 1.0:
        return None  # no motion there
    mistaken = next((d for d in checked.diagnosis if d.sure and d.codes and d.places), None)
    scale = solution.plan_scale(kind, index)
    wrong_at = _mistaken_places(solution, kind, at, scale.per_mm, mistaken)
    room = LARGEST * max(drawing.width, drawing.height)
    own: list[StudentSegment] = []
    letters = ends_by_letters(solution, kind)
    for number, judged in enumerate(checked.answers, 1):
        if judged.key is None or judged.key.position != index:
            continue
        ends = _ends(judged, kind, letters)
        if ends is None or judged.value is None:
            continue
        is_right = judged.verdict not in NOT_RIGHT
        places = at if is_right or wrong_at is None else wrong_at
        length = abs(judged.value) / (1.0 if judged.key.unit == "mm" else scale.per_mm)
        if not 0.3 < length < room or ends[0] not in places or ends[1] not in places:
            continue
        along = places[ends[1]] - places[ends[0]]
        if abs(along) < 0.05:
            continue
        turned = -1.0 if judged.sense_right is False else 1.0
        tail = places[ends[0]] + pole
        own.append(
            StudentSegment(tail, tail + turned * length * along / abs(along), is_right, number)
        )
    if wrong_at is not None:
        own += _plan_of_mistake(solution, kind, at, wrong_at, pole)
    sheet = Fill((0j, complex(drawing.width, drawing.height)))
    bounds = ink_bounds([sheet, *(i for o in own for i in o.items())])
    return Overlay(
        kind,
        index,
        drawing,
        tuple(own),
        _widened(bounds, (0.0, 0.0, drawing.width, drawing.height)),
        scale_inscription(scale, solution.problem.scales.convention, language.notation),
        "" if wrong_at is None or mistaken is None else mistaken.codes[0],
    )


def _widened(bounds: Bounds, sheet: Bounds) -> Bounds:
    """Return bounds with room at the sides where something leaves the sheet."""
    room = [MARGIN * (abs(b - s) > 1e-9) for b, s in zip(bounds, sheet, strict=True)]
    return (
        bounds[0] - room[0],
        bounds[1] - room[1],
        bounds[2] + room[2],
        bounds[3] + room[3],
    )


def _ends(
    answer: GradedAnswer, kind: PlanKind, letters: Mapping[str, PointName]
) -> tuple[PointName, PointName] | None:
    """Return the ends of the segment that an answer measures directly; None if there is none.

    A number that follows from a segment (ω from v) is not as long as the student's segment.
    """
    key = answer.key
    if key is None or key.mm is None or key.scale != FACTS[kind].scale:
        return None
    if key.unit not in ("mm", FACTS[kind].unit):
        return None
    tail, _, head = key.segment.partition("-")
    found = letters.get(_strip_markup(tail)), letters.get(_strip_markup(head))
    return None if found[0] is None or found[1] is None else (found[0], found[1])


def _mistaken_places(
    solution: Solution,
    kind: PlanKind,
    at: Mapping[PointName, complex],
    per_mm: float,
    mistaken: Diagnosis | None,
) -> dict[PointName, complex] | None:
    """Return the places of a mistake's plan from its pole; None where it is the true one."""
    pole = str(solution.construction.plan(kind).pole)
    if mistaken is None or pole not in mistaken.places:
        return None
    start, found = mistaken.places[pole], mistaken.places
    moved = {p: (found[str(p)] - start) / per_mm for p in at if str(p) in found}
    size = max(abs(place) for place in at.values())
    apart = [abs(place - at[point]) for point, place in moved.items()]
    # NaN, an invisible difference, or one far beyond the paper: only the true plan is shown.
    return moved if all(0.0 <= gap < LARGEST * size for gap in apart) and max(apart) > 0.5 else None


def _plan_of_mistake(
    solution: Solution,
    kind: PlanKind,
    at: Mapping[PointName, complex],
    places: Mapping[PointName, complex],
    pole: complex,
) -> Iterator[StudentSegment]:
    """Yield the vectors of a mistake's plan that differ from those of the true one."""
    for vector in solution.construction.plan(kind).vectors:
        ends = vector.tail, vector.head
        if all(end in places for end in ends) and max(abs(places[e] - at[e]) for e in ends) > 0.3:
            yield StudentSegment(
                places[ends[0]] + pole, places[ends[1]] + pole, is_right=False, number=None
            )


LETTERING = OutlineLettering(STYLES["B-upright"])

STYLE = """
.true [class^=pen]{stroke:#9c9c9c}.true .ink-black{fill:#9c9c9c}.true .text{stroke:#5c5c5c}
.own{fill:none;stroke-width:.6}.right{stroke:#1f5fbf}.off{stroke:#c0271b;stroke-dasharray:2.4 1.2}
.own.head{stroke:none}.right.head{fill:#1f5fbf}.off.head{fill:#c0271b}
.mistaken{stroke-width:.35}
.tag{fill:#fff;stroke:#c0271b;stroke-width:.3}.number{font:600 4px sans-serif;fill:#c0271b;
text-anchor:middle;dominant-baseline:central}
"""
"""Style of plans on an HTML page."""

RIGHT_COLOUR, OFF_COLOUR = "#1f5fbf", "#c0271b"
DASHES = (2.4, 1.2)


# no messages: SVG
class OverlayView(Struct, frozen=True):
    """An overlay, shrunk by a factor, as a figure of a document."""

    plan: Overlay
    factor: float
    solution: Solution

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, mm."""
        width, height = self.plan.size
        return width * self.factor, height * self.factor

    def svg(self) -> str:
        """Return the plan in grey and the student's segments over it."""
        plan = self.plan
        left, _, _, high = plan.bounds
        width, height = plan.size
        wide, tall = self.size
        own = "".join(_student_svg(plan))
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
            f'role="img" width="{wide:.2f}mm" height="{tall:.2f}mm" '
            f'viewBox="{left:.2f} {plan.drawing.height - high:.2f} {width:.2f} {height:.2f}">'
            f'<g class="true">{true_svg(self.solution, plan.kind, plan.index)}</g>{own}</svg>'
        )

    def draw(self, canvas: Any) -> None:
        """Draw the same on a canvas of reportlab."""
        canvas.scale(self.factor, self.factor)
        canvas.translate(-self.plan.bounds[0], -self.plan.bounds[1])
        draw_sheet(self.plan.drawing, _GreyCanvas(canvas))
        _draw_student(canvas, self.plan)

    def png(self, dpi: float) -> bytes:
        """Return both as black pixels: the student's segments are the thick lines."""
        plan = self.plan
        width, height = plan.size
        left, low, _, _ = plan.bounds
        own = [item for one in plan.student_segments for item in one.items()]
        items = list(shifted([*plan.drawing.items, *own], -complex(left, low)))
        drawing = replace(plan.drawing, width=width, height=height, items=items, views=[])
        return render(drawing, "png", options=Options(dpi=dpi * self.factor))


@memoized
def true_svg(solution: Solution, kind: PlanKind, index: int) -> str:
    """Return the contents of the SVG of a plan alone."""
    text = render(true_plan(solution, kind, index)[0], "svg").decode("utf-8")
    start = text.index(">", text.index("<svg")) + 1
    return text[start : text.rindex("</svg>")]


# no messages: SVG
def _student_svg(plan: Overlay) -> Iterator[str]:
    def path(points: tuple[complex, ...]) -> str:
        return "M" + "L".join(f"{p.real:.2f} {plan.drawing.height - p.imag:.2f}" for p in points)

    for own in plan.student_segments:
        kind = "right" if own.is_right else "off" if own.number else "off mistaken"
        for item in own.items():
            if isinstance(item, Stroke):
                yield f'<path class="own {kind}" d="{path(item.points)}"/>'
            elif isinstance(item, Fill):
                yield f'<path class="own head {kind}" d="{path(item.points)}Z"/>'
    for own in plan.student_segments:
        if own.number is not None and not own.is_right:
            x, y = own.label_at.real, plan.drawing.height - own.label_at.imag
            yield f'<circle class="tag" cx="{x:.2f}" cy="{y:.2f}" r="3"/>'
            yield f'<text class="number" x="{x:.2f}" y="{y:.2f}">{own.number}</text>'


class _GreyCanvas(PageCanvas):
    """Draws a plan in grey."""

    def _set_pen(self, pen: Pen) -> None:
        super()._set_pen(pen)
        self._pdf.setStrokeGray(0.61)

    def _set_ink(self, colour: tuple[int, int, int]) -> None:
        self._pdf.setFillGray(1.0 if min(colour) == 255 else 0.5)


def _draw_student(sheet: Any, plan: Overlay) -> None:
    for own in plan.student_segments:
        colour = RIGHT_COLOUR if own.is_right else OFF_COLOUR
        sheet.setStrokeColor(colour)
        sheet.setFillColor(colour)
        sheet.setDash([] if own.is_right else DASHES)
        sheet.setLineWidth(0.6 if own.is_right or own.number else 0.35)
        for item in own.items():
            if isinstance(item, Stroke | Fill):
                path = sheet.beginPath()
                path.moveTo(item.points[0].real, item.points[0].imag)
                for point in item.points[1:]:
                    path.lineTo(point.real, point.imag)
                fill = isinstance(item, Fill)
                sheet.drawPath(path, stroke=int(not fill), fill=int(fill))
    sheet.setDash([])
    for own in plan.student_segments:
        if own.number is not None and not own.is_right:
            at = own.label_at
            sheet.setFillColor("#ffffff")
            sheet.setStrokeColor(OFF_COLOUR)
            sheet.setLineWidth(0.3)
            sheet.circle(at.real, at.imag, 3.0, fill=1)
            sheet.setFillColor(OFF_COLOUR)
            sheet.setFont(registered(LETTERING), 4.6)
            sheet.drawCentredString(at.real, at.imag - 1.55, str(own.number))
