"""A plan with a student's segments, drawn on a page (план на листе студента)."""

# no messages: SVG

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.pages.overlay import Overlay, true_plan
from planmethod.plans.model import PlanKind
from planmethod.render.backends import render
from planmethod.render.backends.canvas import Options, draw_sheet
from planmethod.render.backends.pdf import PageCanvas, registered
from planmethod.render.ink.drawing import Fill, Ink, Pen, Stroke, shifted
from planmethod.render.ink.lettering import STYLES, OutlineLettering
from planmethod.solved.reading import memoized
from planmethod.solved.solution import Solution

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

RIGHT, OFF = "#1f5fbf", "#c0271b"
DASHES = (2.4, 1.2)


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

    def _set_ink(self, ink: Ink) -> None:
        self._pdf.setFillGray(1.0 if ink is Ink.WHITE else 0.5)


def _draw_student(sheet: Any, plan: Overlay) -> None:
    for own in plan.student_segments:
        colour = RIGHT if own.is_right else OFF
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
            sheet.setStrokeColor(OFF)
            sheet.setLineWidth(0.3)
            sheet.circle(at.real, at.imag, 3.0, fill=1)
            sheet.setFillColor(OFF)
            sheet.setFont(registered(LETTERING), 4.6)
            sheet.drawCentredString(at.real, at.imag - 1.55, str(own.number))
