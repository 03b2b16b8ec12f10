"""``group.html``: marks, questions and mistakes of a group (лист группы)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from planmethod.check.model import CheckedWork
from planmethod.check.pages.results import by_code
from planmethod.check.pages.speech import quoted
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
from planmethod.note.wording import Language, Words
from planmethod.note.writers.html import html_document
from planmethod.render.backends.view import DrawingView
from planmethod.render.ink.drawing import Drawing, Fill, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset

LETTERS, BAR, STEP, LONGEST, EDGE = 3.5, 2.5, 6.5, 90.0, 2.0
"""Height of letters, of a bar, from bar to bar, the longest bar, white round all, mm."""

COMMONEST = 10
"""Maximum number of mistakes shown, the commonest first."""


def group_html(
    found: GroupStatistics, works: Sequence[CheckedWork], title: str, words: Language
) -> str:
    """Return the page of a group as one HTML file."""
    say: Words = words.check["statistics"]
    written = Document.of(_nodes(found, works, title, words))
    return html_document(written, title=say.title, lang=words.lang)


def _nodes(
    found: GroupStatistics, works: Sequence[CheckedWork], title: str, words: Language
) -> Iterator[Node]:
    say: Words = words.check["statistics"]
    yield Title(f"{say.title}. {escape(title)}")
    yield Paragraph(
        say.facts.format(
            count=len(found.shares),
            mean=percent(found.mean, words),
            median=percent(found.median, words),
            deviation=percent(found.deviation, words),
        )
    )
    yield Chapter(say.marks)
    counted = [(escape(mark) or "—", float(count), str(count)) for mark, count in found.marks]
    yield Figure(DrawingView(bars(counted)))
    if found.provisional:
        yield Note(say.provisional.format(count=found.provisional))
    yield Chapter(say.questions)
    shares = [
        (words.say.symbol(q.symbol), q.share, percent(q.share, words)) for q in found.questions
    ]
    yield Figure(DrawingView(bars(shares, whole=1.0)), say.shares)
    yield table_of(
        say["columns"],
        (
            (
                words.say.symbol(one.symbol),
                str(one.asked),
                percent(one.share, words),
                number(one.discrimination, words),
            )
            for one in found.questions
        ),
    )
    yield Note(say.note.format(weak=words.say.number(f"{WEAK:g}")))
    mistakes = [row for row in by_code(works, words.check) if row[2] or row[3]][:COMMONEST]
    if mistakes:
        yield Chapter(say.mistakes)
        results: Words = words.check["results"]
        yield table_of(
            results["by_code"],
            ([escape(str(cell)) for cell in row[:4]] + [quoted_all(row[4])] for row in mistakes),
            names=len(results["by_code"]),
        )


def quoted_all(students: str) -> str:
    """Return the names of students as rich text, each cut to a length that fits a line."""
    return ", ".join(quoted(name) for name in students.split(", "))


def percent(share: float, words: Language) -> str:
    """Return a share in per cent."""
    return f"{words.say.number(f'{100.0 * share:.0f}')} %"


def number(value: float | None, words: Language) -> str:
    """Return a number to two digits; a dash for None."""
    return "—" if value is None else words.say.number(f"{value:.2f}")


def bars(rows: Sequence[tuple[str, float, str]], *, whole: float | None = None) -> Drawing:
    """Return horizontal bars, from the top down.

    Parameters
    ----------
    rows : sequence of (str, float, str)
        Letters on the left as rich text, length, and text on the right.
    whole : float, optional
        Value of the longest bar. Default: the largest of the rows.
    """
    most = whole or max((length for _, length, _ in rows), default=0.0) or 1.0
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
