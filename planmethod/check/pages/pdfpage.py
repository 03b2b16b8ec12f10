"""A student's page as PDF (лист студента в PDF)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from reportlab.lib import colors

from planmethod.check.model import Verdict
from planmethod.check.pages.overlay import Overlay
from planmethod.check.pages.pdf import LETTERING, MARGIN, MM, NOTE, Document
from planmethod.check.pages.student import GAP, Page
from planmethod.note.plaintext import plain_text
from planmethod.note.wording import Language, Words
from planmethod.render.backends.canvas import Options, draw_sheet
from planmethod.render.backends.pdf import PdfCanvas, registered
from planmethod.render.ink.drawing import Fill, Ink, Pen, Stroke
from planmethod.render.ink.lettering import OutlineLettering

GROUNDS = {
    Verdict.OK: colors.HexColor("#e5f2e7"),
    Verdict.INHERITED: colors.HexColor("#e5f2e7"),
    Verdict.NEAR: colors.HexColor("#fdf3d3"),
    Verdict.INCONSISTENT: colors.HexColor("#fdf3d3"),
    Verdict.UNSEEN: colors.HexColor("#fdf3d3"),
    Verdict.WRONG: colors.HexColor("#fbe3e0"),
    Verdict.BLANK: colors.HexColor("#ececec"),
    Verdict.UNREADABLE: colors.HexColor("#ececec"),
}
"""Grounds of the cells that name a verdict: they only repeat what the word says."""

VERDICT_COLUMN = 5
WIDTHS = (8.0, 20.0, 32.0, 41.0, 29.0, 37.0, 18.0)
RIGHT = colors.HexColor("#1f5fbf")
OFF = colors.HexColor("#c0271b")
DASHES = (2.4, 1.2)
CAPTION = 16.0
"""Room for the caption of a plan, points."""


def pdf_page(page: Page, words: Language) -> bytes:
    """Return the page of a student as PDF."""
    say: Words = words.check["student"]
    whose = plain_text(page.facts[0])
    pdf = Document(whose, foot=lambda number: say.page.format(student=whose, page=number))
    pdf.paragraph(page.title, 16.0)
    pdf.paragraph(page.subtitle)
    pdf.gap(3.0)
    pdf.paragraph(" · ".join(page.facts), 11.0)
    pdf.paragraph(page.counted)
    pdf.heading(say.remarks)
    pdf.listed(page.remarks)
    if page.redraw:
        pdf.heading(say.redraw)
        pdf.listed(page.redraw)
    pdf.heading(say.answers)
    pdf.table(
        say["columns"],
        [line.cells for line in page.lines],
        WIDTHS,
        right=(0, 4),
        grounds=[GROUNDS[line.verdict] for line in page.lines],
        ground_column=VERDICT_COLUMN,
    )
    pdf.paragraph(page.tolerance, NOTE)
    if page.plans:
        rows = page.rows()
        heights = [max(plan.size[1] * factor for plan, factor, _ in row) * MM for row in rows]
        pdf.heading(say.plans, heights[0] + CAPTION)
        for row, height in zip(rows, heights, strict=True):
            pdf.need(height + CAPTION)
            _draw_plans(pdf, row, height)
        pdf.paragraph(page.legend, NOTE)
    return pdf.close()


def _draw_plans(pdf: Document, row: Sequence[tuple[Overlay, float, str]], height: float) -> None:
    """Draw plans side by side, each with its caption."""
    sheet, x = pdf.sheet, MARGIN
    pdf.gap(height + CAPTION)
    for plan, factor, caption in row:
        unit = factor * MM
        sheet.saveState()
        sheet.translate(x, pdf.y + CAPTION)
        sheet.scale(unit, unit)
        sheet.translate(-plan.bounds[0], -plan.bounds[1])
        draw_sheet(plan.drawing, PlanCanvas(sheet))
        _draw_own(sheet, plan)
        sheet.restoreState()
        pdf.caption(caption, x, pdf.y + 4.0, plan.size[0] * unit)
        x += (plan.size[0] * factor + GAP) * MM


class PlanCanvas(PdfCanvas):
    """Draws a plan in grey on a page that is there already."""

    def __init__(self, sheet: Any) -> None:
        super().__init__(Options())
        self._pdf = sheet

    def open(self, width: float, height: float, title: str, lettering: OutlineLettering) -> None:
        """Take the lettering."""
        self._font, self._lettering = registered(lettering), lettering
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
            sheet.setFont(registered(LETTERING), 4.6)
            sheet.drawCentredString(at.real, at.imag - 1.55, str(own.number))
