"""``group.html``: marks, questions and mistakes of a group (лист группы)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from planmethod.check.model import GradedSubmission
from planmethod.check.pages.answer_format import quoted
from planmethod.check.pages.results import by_code
from planmethod.check.pages.statistics import WEAK, GroupStatistics
from planmethod.note.document import (
    Chapter,
    Document,
    Figure,
    Node,
    Note,
    Paragraph,
    Title,
    table_of,
)
from planmethod.note.formula import escape
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.html import html_document
from planmethod.render.backends.view import DrawingView
from planmethod.render.ink.drawing import Drawing, Fill, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset

LETTERS, BAR, STEP, LONGEST, EDGE = 3.5, 2.5, 6.5, 90.0, 2.0
"""Height of letters, of a bar, from bar to bar, the longest bar, white round all, mm."""

COMMONEST = 10
"""Maximum number of mistakes shown, the commonest first."""


def group_html(
    statistics: GroupStatistics, works: Sequence[GradedSubmission], title: str, language: Language
) -> str:
    """Return the page of a group as one HTML file."""
    texts: MessageTable = language.check["statistics"]
    written = Document.of(_nodes(statistics, works, title, language))
    return html_document(written, title=texts.title, lang=language.lang)


def _nodes(
    statistics: GroupStatistics, works: Sequence[GradedSubmission], title: str, language: Language
) -> Iterator[Node]:
    texts: MessageTable = language.check["statistics"]
    yield Title(f"{texts.title}. {escape(title)}")
    yield Paragraph(
        texts.facts.format(
            count=len(statistics.fractions),
            mean=percent(statistics.mean, language),
            median=percent(statistics.median, language),
            deviation=percent(statistics.deviation, language),
        )
    )
    yield Chapter(texts.marks)
    counted = [(escape(mark) or "—", float(count), str(count)) for mark, count in statistics.marks]
    yield Figure(DrawingView(bars(counted)))
    if statistics.provisional:
        yield Note(texts.provisional.format(count=statistics.provisional))
    yield Chapter(texts.questions)
    shares = [
        (language.notation.symbol(q.symbol), q.mean_fraction, percent(q.mean_fraction, language))
        for q in statistics.questions
    ]
    yield Figure(DrawingView(bars(shares, maximum=1.0)), texts.shares)
    yield table_of(
        texts["columns"],
        (
            (
                language.notation.symbol(one.symbol),
                str(one.submissions),
                percent(one.mean_fraction, language),
                number(one.discrimination, language),
            )
            for one in statistics.questions
        ),
    )
    yield Note(texts.note.format(weak=language.notation.number(f"{WEAK:g}")))
    mistakes = [row for row in by_code(works, language.check) if row[2] or row[3]][:COMMONEST]
    if mistakes:
        yield Chapter(texts.mistakes)
        results: MessageTable = language.check["results"]
        yield table_of(
            results["by_code"],
            ([escape(str(cell)) for cell in row[:4]] + [quoted_all(row[4])] for row in mistakes),
            names=len(results["by_code"]),
        )


def quoted_all(students: str) -> str:
    """Return the names of students as rich text, each cut to a length that fits a line."""
    return ", ".join(quoted(name) for name in students.split(", "))


def percent(fraction: float, language: Language) -> str:
    """Return a share in per cent."""
    return f"{language.notation.number(f'{100.0 * fraction:.0f}')} %"


def number(value: float | None, language: Language) -> str:
    """Return a number to two digits; a dash for None."""
    return "—" if value is None else language.notation.number(f"{value:.2f}")


def bars(rows: Sequence[tuple[str, float, str]], *, maximum: float | None = None) -> Drawing:
    """Return horizontal bars, from the top down.

    Parameters
    ----------
    rows : sequence of (str, float, str)
        Letters on the left as rich text, length, and text on the right.
    maximum : float, optional
        Value of the longest bar. Default: the largest of the rows.
    """
    most = maximum or max((length for _, length, _ in rows), default=0.0) or 1.0
    left = [typeset(text, LETTERS) for text, _, _ in rows]
    right = [typeset(told, LETTERS) for _, _, told in rows]
    start = EDGE + max(one.width for one in left) + 3.0
    items: list[Item] = []
    height = STEP * len(rows) + 2 * EDGE
    for row, (text, (_, length, _), told) in enumerate(zip(left, rows, right, strict=True)):
        middle = height - EDGE - STEP * (row + 0.5)
        end = start + LONGEST * length / most
        base = 1j * (middle - LETTERS / 2)
        items += text.at(start - 3.0 + base, anchor="right")
        if length > 0:
            low, high = middle - BAR / 2, middle + BAR / 2
            corners = (
                complex(start, low),
                complex(end, low),
                complex(end, high),
                complex(start, high),
            )
            items.append(Fill(corners))
        items += told.at(end + 2.0 + base)
    axis = (complex(start, EDGE), complex(start, height - EDGE))
    items.append(Stroke(axis, Pen.THIN))
    width = start + LONGEST + 2.0 + max(one.width for one in right) + EDGE
    drawing = Drawing(width, height, "")
    drawing.extend(items)
    return drawing
