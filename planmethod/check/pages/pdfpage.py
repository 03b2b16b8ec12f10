"""A student's page as PDF (лист студента в PDF)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from reportlab.lib import colors
from reportlab.platypus import Flowable, KeepTogether

from planmethod.check.model import Verdict
from planmethod.check.pages import pdf
from planmethod.check.pages.overlay import Overlay
from planmethod.check.pages.student import Page
from planmethod.note.plaintext import plain_text
from planmethod.note.wording.language import Language
from planmethod.render.backends.canvas import Options, draw_sheet
from planmethod.render.backends.pdf import PdfCanvas, _registered
from planmethod.render.ink.drawing import Fill, Ink, Pen, Stroke
from planmethod.render.ink.lettering import OutlineLettering

GROUNDS = {
    Verdict.OK: "#e5f2e7",
    Verdict.INHERITED: "#e5f2e7",
    Verdict.NEAR: "#fdf3d3",
    Verdict.INCONSISTENT: "#fdf3d3",
    Verdict.UNSEEN: "#fdf3d3",
    Verdict.WRONG: "#fbe3e0",
    Verdict.BLANK: "#ececec",
    Verdict.UNREADABLE: "#ececec",
}
"""Grounds of the cells that name a verdict: they only repeat what the word says."""

VERDICT_COLUMN = 5
WIDTHS = (8.0, 20.0, 35.0, 44.0, 24.0, 35.0, 18.0)
RIGHT = colors.HexColor("#1f5fbf")
OFF = colors.HexColor("#c0271b")
DASHES = (2.4, 1.2)


def pdf_page(page: Page, words: Language) -> bytes:
    """Return the page of a student as PDF."""
    say = words.check.student
    story: list[Any] = [pdf.paragraph(page.title, 16.0), pdf.gap(2.0)]
    story += [pdf.paragraph(page.subtitle), pdf.paragraph(" · ".join(page.facts), 11.0, before=4.0)]
    story += [pdf.paragraph(page.counted), pdf.heading(say.remarks), *pdf.listed(page.remarks)]
    if page.redraw:
        story += [pdf.heading(say.redraw), *pdf.listed(page.redraw)]
    fills = [(VERDICT_COLUMN, row, GROUNDS[line.verdict]) for row, line in enumerate(page.lines)]
    rows = [line.cells for line in page.lines]
    story += [
        pdf.heading(say.answers),
        pdf.table(say.columns, rows, WIDTHS, right=(0, 4), fills=fills),
        pdf.paragraph(say.tolerance, 8.0),
    ]
    if page.plans:
        drawn: list[Any] = [pdf.heading(say.plans)]
        factors = page.factors()
        if factors[0] == factors[-1] and sum(p.size[0] for p in page.plans) * factors[0] < 184.0:
            drawn.append(Plans(page.plans, factors, page.captions))
        else:
            drawn += [
                Plans([plan], [factor], [caption])
                for plan, factor, caption in zip(page.plans, factors, page.captions, strict=True)
            ]
        drawn.append(pdf.paragraph(page.legend, 8.0))
        story.append(KeepTogether(drawn))
    whose = plain_text(page.facts[0])
    return pdf.document(story, whose, foot=lambda n: say.page.format(student=whose, page=n))


class Plans(Flowable):  # type: ignore[misc]
    """Plans side by side with a student's segments, each with its caption (планы)."""

    def __init__(
        self, plans: Sequence[Overlay], factors: Sequence[float], captions: Sequence[str]
    ) -> None:
        super().__init__()
        self._plans = list(zip(plans, factors, captions, strict=True))

    def wrap(self, width: float, _height: float) -> tuple[float, float]:
        """Return the room that is taken, points."""
        return width, max(p.size[1] * factor for p, factor, _ in self._plans) * pdf.MM + 16.0

    def draw(self) -> None:
        """Draw at the place that the page gives."""
        sheet, x = self.canv, 0.0
        for plan, factor, caption in self._plans:
            unit = factor * pdf.MM
            sheet.saveState()
            sheet.translate(x, 14.0)
            sheet.scale(unit, unit)
            sheet.translate(-plan.bounds[0], -plan.bounds[1])
            draw_sheet(plan.drawing, PlanCanvas(sheet))
            _draw_own(sheet, plan)
            sheet.restoreState()
            told = pdf.paragraph(caption, 8.0)
            told.wrapOn(sheet, plan.size[0] * unit, 20.0)
            told.drawOn(sheet, x, 1.0)
            x += plan.size[0] * unit + 4.0 * pdf.MM


class PlanCanvas(PdfCanvas):
    """Draws a plan in grey on a page that is there already."""

    def __init__(self, sheet: Any) -> None:
        super().__init__(Options())
        self._pdf = sheet

    def open(self, width: float, height: float, title: str, lettering: OutlineLettering) -> None:
        """Take the lettering."""
        self._font, self._lettering = _registered(lettering), lettering
        self._pdf.setLineJoin(1)

    def _take_pen(self, pen: Pen) -> None:
        super()._take_pen(pen)
        self._pdf.setStrokeGray(0.61)

    def _take_ink(self, ink: Ink) -> None:
        self._pdf.setFillGray(1.0 if ink is Ink.WHITE else 0.5)


def _draw_own(sheet: Any, plan: Overlay) -> None:
    for own in plan.own:
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
    for own in plan.own:
        if own.number is not None and not own.is_right:
            at = own.label_at
            sheet.setFillColor(colors.white)
            sheet.setStrokeColor(OFF)
            sheet.setLineWidth(0.3)
            sheet.circle(at.real, at.imag, 3.0, fill=1)
            sheet.setFillColor(OFF)
            sheet.setFont(pdf.font(), 4.6)
            sheet.drawCentredString(at.real, at.imag - 1.55, str(own.number))
