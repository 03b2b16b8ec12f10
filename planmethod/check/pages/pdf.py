"""Documents of paragraphs and tables as PDF, in the project's own lettering (документы PDF)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from io import BytesIO
from typing import Any

from reportlab.lib import colors
from reportlab.lib.pagesizes import A4, landscape
from reportlab.lib.styles import ParagraphStyle
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.platypus import Paragraph, SimpleDocTemplate, Spacer, Table

from planmethod.check.pages.speech import clean, tagged
from planmethod.note.plaintext import plain_text
from planmethod.render.ink.lettering import STYLES, OutlineLettering

MM = 72.0 / 25.4
MARGIN = 12.0 * MM
LETTERING = OutlineLettering(STYLES["B-upright"])
GREY = colors.HexColor("#8a8a8a")
RULE = colors.HexColor("#bbbbbb")
HEAD = colors.HexColor("#f4f4f4")


@cache
def font() -> str:
    """Return the name of the lettering, registered when it is first asked for."""
    pdfmetrics.registerFont(TTFont(LETTERING.name, str(LETTERING.font_file)))
    return LETTERING.name


@cache
def style(size: float = 9.5, *, before: float = 0.0, right: bool = False) -> Any:
    """Return the style of a paragraph, sizes in points."""
    return ParagraphStyle(
        f"{size}-{before}-{right}",
        fontName=font(),
        bulletFontName=font(),
        fontSize=size,
        leading=size * 1.32,
        spaceBefore=before,
        alignment=2 if right else 0,
    )


def paragraph(rich: str, size: float = 9.5, *, before: float = 0.0, right: bool = False) -> Any:
    """Return a paragraph of rich text."""
    return Paragraph(_marked(rich, size), style(size, before=before, right=right))


def _marked(rich: str, size: float) -> str:
    """Return rich text with indices that keep clear of the line below."""
    text = tagged(rich)
    for tag, rise in (("sub", 0.16), ("sup", 0.38)):
        looks = f'rise="{rise * size:.2f}" size="{0.72 * size:.2f}"'
        text = text.replace(f"<{tag}>", f"<{tag} {looks}>")
    return text


def heading(rich: str) -> Any:
    """Return the heading of a part, which stays with what follows it."""
    made = paragraph(rich, 12.0, before=6.0)
    made.keepWithNext = True
    return made


def listed(sentences: Sequence[str], size: float = 9.5) -> list[Any]:
    """Return sentences as a list with dots."""
    bullet = ParagraphStyle(
        "listed", parent=style(size), leftIndent=10.0, bulletIndent=1.0, spaceAfter=1.5
    )
    return [Paragraph(_marked(s, bullet.fontSize), bullet, bulletText="•") for s in sentences]


def gap(points: float) -> Any:
    """Return empty room."""
    return Spacer(1.0, points)


def table(
    header: Sequence[str],
    rows: Sequence[Sequence[str]],
    widths: Sequence[float],
    *,
    right: Sequence[int] = (),
    fills: Sequence[tuple[int, int, str]] = (),
    size: float = 8.5,
) -> Any:
    """Return a table whose head stands on each of its pages.

    Parameters
    ----------
    widths : sequence of float
        Of the columns, mm.
    right : sequence of int
        Columns that are set to the right.
    fills : sequence of (column, row, colour)
        Cells with a ground, rows counted from 0 without the head.
    """
    cells = [[paragraph(cell, size) for cell in header]]
    cells += [
        [_cell(text, size, widths[i] * MM - 6.0, right=i in right) for i, text in enumerate(row)]
        for row in rows
    ]
    look: list[tuple[Any, ...]] = [
        ("FONTNAME", (0, 0), (-1, -1), font()),  # else Helvetica again
        ("GRID", (0, 0), (-1, -1), 0.4, RULE),
        ("BACKGROUND", (0, 0), (-1, 0), HEAD),
        ("FONTSIZE", (0, 0), (-1, -1), size),
        ("LEADING", (0, 0), (-1, -1), size * 1.32),
        ("VALIGN", (0, 0), (-1, -1), "TOP"),
        ("LEFTPADDING", (0, 0), (-1, -1), 3.0),
        ("RIGHTPADDING", (0, 0), (-1, -1), 3.0),
        ("TOPPADDING", (0, 0), (-1, -1), 1.0),
        ("BOTTOMPADDING", (0, 0), (-1, -1), 2.5),
    ]
    look += [("ALIGN", (column, 1), (column, -1), "RIGHT") for column in right]
    look += [
        ("BACKGROUND", (column, row + 1), (column, row + 1), colors.HexColor(colour))
        for column, row, colour in fills
    ]
    return Table(cells, colWidths=[w * MM for w in widths], repeatRows=1, style=look, hAlign="LEFT")


def _cell(rich: str, size: float, width: float, *, right: bool) -> Any:
    """Return a cell: a bare text where that will do, since paragraphs are slow."""
    text = plain_text(clean(rich))
    has_indices = "_" in text or "^" in text
    if has_indices or pdfmetrics.stringWidth(text, font(), size) > width:
        return paragraph(rich, size, right=right)
    return text


def document(
    story: Sequence[Any],
    title: str,
    *,
    wide: bool = False,
    foot: Callable[[int], str] | None = None,
) -> bytes:
    """Return a PDF of A4 pages; the same story gives the same bytes.

    Parameters
    ----------
    wide : bool
        Whether the pages lie.
    foot : callable, optional
        Takes the number of a page and returns the line at its foot.
    """
    file = BytesIO()

    def end(canvas: Any, pages: Any) -> None:
        if foot is not None:
            canvas.setFont(font(), 7.5)
            canvas.setFillColor(GREY)
            canvas.drawString(MARGIN, MARGIN * 0.55, foot(pages.page))

    made = SimpleDocTemplate(
        file,
        pagesize=landscape(A4) if wide else A4,
        leftMargin=MARGIN,
        rightMargin=MARGIN,
        topMargin=MARGIN,
        bottomMargin=MARGIN,
        title=title,
        author="planmethod",
        creator="planmethod",
        invariant=1,
        pageCompression=1,
        # Else a Helvetica that nobody uses stays in the file, not embedded.
        initialFontName=font(),
    )
    made.build(list(story), onFirstPage=end, onLaterPages=end)
    return file.getvalue()
