"""Pages of a group: ``group.html``, ``results.xlsx``, statistics of marks and questions."""

from __future__ import annotations

import math
import statistics
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from planmethod.check.model import (
    Diagnosis,
    GradedAnswer,
    GradedSubmission,
    KeyEntry,
    Sense,
    Verdict,
)
from planmethod.check.pages.listing import codes_of
from planmethod.check.pages.remarks import PLACED, AnswerFormatter, displayed_value, quoted
from planmethod.note.document import (
    Chapter,
    Document,
    Figure,
    Node,
    Note,
    Paragraph,
    Title,
    plain_text,
    table_of,
)
from planmethod.note.formula import escape
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.html import html_document
from planmethod.note.writers.workbook import Filled, add_bars, add_sheet, new_workbook, saved
from planmethod.render.backends.view import DrawingView
from planmethod.render.ink.drawing import Drawing, Fill, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset

if TYPE_CHECKING:
    from openpyxl import Workbook


MIN_SUBMISSIONS = 3
"""Minimum number of submissions for a correlation."""

WEAK = 0.2
"""Discrimination below which a question does not separate strong students from weak ones."""


class QuestionStatistics(Struct, frozen=True):
    """Results of a group for one question (статистика вопроса).

    Attributes
    ----------
    label, symbol : str
        Letters as plain text, and as rich text.
    submissions : int
        Number of submissions in which it is graded.
    mean_fraction : float
        Mean share of its points, 0 to 1: the smaller, the harder.
    discrimination : float or None
        Correlation of its fraction with that of all other answers of a submission, -1 to 1; None
        for fewer than three submissions, or equal fractions.
    """

    label: str
    symbol: str
    submissions: int
    mean_fraction: float
    discrimination: float | None


class GroupStatistics(Struct, frozen=True):
    """Statistics of a group (статистика группы).

    Attributes
    ----------
    marks : tuple of (str, int)
        Number of submissions with each mark, the best first.
    fractions : tuple of float
        Fraction of the points of each submission, 0 to 1.
    questions : tuple of QuestionStatistics
        In the requested order.
    provisional : int
        How many marks may still change.
    """

    marks: tuple[tuple[str, int], ...]
    fractions: tuple[float, ...]
    questions: tuple[QuestionStatistics, ...]
    provisional: int = 0

    @property
    def mean(self) -> float:
        """Mean share of the points."""
        return statistics.fmean(self.fractions)

    @property
    def median(self) -> float:
        """Fraction of the points that half of the submissions reach."""
        return statistics.median(self.fractions)

    @property
    def deviation(self) -> float:
        """Standard deviation of the group's fractions (of a population, not a sample)."""
        return statistics.pstdev(self.fractions)


def statistics_of(
    works: Sequence[GradedSubmission], marks: Sequence[str], scale: Sequence[str]
) -> GroupStatistics | None:
    """Return the statistics of a group; None for fewer than two graded submissions.

    Parameters
    ----------
    marks : sequence of str
        Marks of the submissions, one each; empty for one that is not graded.
    scale : sequence of str
        All marks that there are, the best first.
    """
    judged = [(work, mark) for work, mark in zip(works, marks, strict=True) if work.of]
    if len(judged) < 2:
        return None
    order = list(dict.fromkeys([*scale, *(mark for _, mark in judged)]))
    given = [mark for _, mark in judged]
    found: dict[tuple[str, int], list[tuple[float, float | None]]] = {}
    symbols: dict[str, str] = {}
    for work, _ in judged:
        for one in work.answers:
            if one.key is None:
                continue
            symbols.setdefault(one.key.label, one.key.symbol)
            pairs = found.setdefault((one.key.label, one.key.position), [])
            if not one.is_open and one.of:
                rest = work.of - one.of
                others = (work.points - one.points) / rest if rest > 0 else None
                pairs.append((one.points / one.of, others))
    several = len({position for _, position in found}) > 1
    questions = tuple(
        QuestionStatistics(
            f"{label} [{position}]" if several else label,
            f"{symbols[label]} [{position}]" if several else symbols[label],
            len(pairs),
            statistics.fmean(own for own, _ in pairs),
            _correlation([(own, rest) for own, rest in pairs if rest is not None]),
        )
        for (label, position), pairs in found.items()
        if pairs
    )
    return GroupStatistics(
        tuple((mark, given.count(mark)) for mark in order),
        tuple(work.points / work.of for work, _ in judged),
        questions,
        sum(work.is_provisional for work, _ in judged),
    )


def _correlation(pairs: Sequence[tuple[float, float]]) -> float | None:
    """Return Pearson's correlation; None where it has no meaning."""
    if len(pairs) < MIN_SUBMISSIONS:
        return None
    own, rest = [one for one, _ in pairs], [one for _, one in pairs]
    if max(own) - min(own) < 1e-9 or max(rest) - min(rest) < 1e-9:
        return None
    found = statistics.correlation(own, rest)
    return found if math.isfinite(found) else None


COLOURS: Mapping[Verdict, str] = {
    Verdict.OK: "D9EFDC",
    Verdict.INHERITED: "E6F4D8",
    Verdict.NEAR: "FDF3D3",
    Verdict.INCONSISTENT: "FDF3D3",
    Verdict.UNSEEN: "FDF3D3",
    Verdict.WRONG: "F8D3CE",
    Verdict.BLANK: "E4E4E4",
    Verdict.UNREADABLE: "D9D2E9",
}
POINTS, PERCENT, VALUE, LENGTH = "0.##", "0%", "0.0000", "0.0"


def results_xlsx(
    works: Sequence[GradedSubmission],
    language: Language,
    *,
    marks: Sequence[str] = (),
    settings: Mapping[str, str | float] | None = None,
    group: GroupStatistics | None = None,
) -> bytes:
    """Return the workbook of a group.

    Parameters
    ----------
    marks : sequence of str
        Marks of the submissions, one each; none if there are only points.
    settings : mapping
        What the last sheet shows: settings of the run and its files.
    group : GroupStatistics, optional
        Statistics for a separate sheet, with charts. Default: none.
    """
    texts: MessageTable = language.check["results"]
    first, second, third, fourth = texts["sheets"]
    verdicts = [language.check["verdicts"][verdict.value] for verdict in Verdict]
    book = new_workbook()
    add_sheet(
        book,
        first,
        [*texts["summary"][:6], *verdicts, *texts["summary"][6:]],
        list(_summary(works, marks, language)),
        formats={2: POINTS, 3: POINTS, 4: PERCENT},
    )
    add_sheet(
        book,
        second,
        texts["answers"],
        list(_answers(works, language)),
        frozen=3,
        formats={6: VALUE, 7: VALUE, 8: VALUE, 10: LENGTH, 11: LENGTH, 14: VALUE, 15: POINTS},
    )
    counted = list(by_code(works, language.check))
    add_sheet(book, third, texts["by_code"], counted)
    add_sheet(
        book,
        third,
        texts["by_answer"],
        list(_by_answer(works)),
        formats={3: PERCENT},
        row=len(counted) + 3,
    )
    if group is not None:
        _add_statistics(book, group, language)
    add_sheet(book, fourth, texts["settings"], list((settings or {}).items()))
    return saved(book)


def _add_statistics(book: Workbook, group: GroupStatistics, language: Language) -> None:
    """Add the sheet of the statistics: marks and questions, each with its picture."""
    texts: MessageTable = language.check["statistics"]
    rows: list[list[Any]] = [list(row) for row in group.marks]
    add_sheet(book, texts.sheet, texts["mark_columns"], rows, frozen=0)
    facts = [
        [texts.mean, group.mean],
        [texts.median, group.median],
        [texts.deviation, group.deviation],
    ]
    at = len(rows) + 3
    add_sheet(book, texts.sheet, [texts.facts_head, "%"], facts, formats={1: PERCENT}, row=at)
    asked = [
        [one.label, one.submissions, one.mean_fraction, one.discrimination]
        for one in group.questions
    ]
    below = at + len(facts) + 2
    formats = {2: PERCENT, 3: "0.00"}
    sheet = add_sheet(book, texts.sheet, texts["columns"], asked, formats=formats, row=below)
    last = below + len(asked)
    add_bars(sheet, texts.marks, (1, 2), (1, len(rows) + 1), "F1")
    add_bars(sheet, texts.shares, (1, 3), (below, last), "F12", lying=True)


def _summary(
    works: Sequence[GradedSubmission], marks: Sequence[str], language: Language
) -> Iterator[list[Any]]:
    for number, checked in enumerate(works):
        counts = Counter(judged.verdict for judged in checked.answers)
        yield [
            checked.work.student,
            checked.variant,
            checked.points,
            checked.of,
            checked.points / checked.of if checked.of else None,
            marks[number] if marks else None,
            *(Filled(counts[v], COLOURS[v]) if counts[v] else None for v in Verdict),
            list_mistakes(checked, language.check),
            "; ".join(_notes(checked, language)),
        ]


def list_mistakes(checked: GradedSubmission, texts: MessageTable) -> str:
    """Return the mistakes of a submission: codes and names, with the answers where they begin."""
    labels = _labels(checked)
    begins: dict[str, list[str]] = {}
    for diagnosis in checked.diagnosis:
        roots = (labels.get(root, root) for root in diagnosis.roots)
        begins.setdefault(_name(diagnosis, texts), []).extend(roots)
    return "; ".join(
        f"{name} ({', '.join(dict.fromkeys(roots))})" if roots else name
        for name, roots in begins.items()
    )


def _labels(checked: GradedSubmission) -> dict[str, str]:
    return {judged.id: judged.key.label for judged in checked.answers if judged.key is not None}


def _name(diagnosis: Diagnosis, texts: MessageTable) -> str:
    results: MessageTable = texts["results"]
    names = [
        # Mistakes of the catalogue bear a code; those of writing, "sign", have their name alone.
        " ".join([*[code] * code[-1].isdigit(), texts["mistakes"][code].name])
        if code in texts["mistakes"]
        else code
        for code in diagnosis.codes
    ]
    if not names:
        return results.unknown
    return " / ".join(names) if diagnosis.sure else f"{results.perhaps}: {' / '.join(names)}"


def _notes(checked: GradedSubmission, language: Language) -> Iterator[str]:
    texts = language.check
    if checked.failure is not None:
        yield texts["results"].failure.format(why=checked.failure.message)
    if checked.is_provisional:
        yield texts["results"].open.format(count=len(checked.open))
    if checked.suspicious:
        yield texts["results"].suspicious
    if checked.similar_students:
        yield texts["results"].alike.format(students=", ".join(checked.similar_students))
    if checked.is_manual or any(judged.is_manual for judged in checked.answers):
        yield texts["results"].by_hand
    if checked.remark:
        yield checked.remark
    for written in checked.work.remarks:
        unread = f"{written.location} {AnswerFormatter(language).unread(written)}"
        placed = written.reason in PLACED
        yield unread if placed else f"{texts['verdicts']['unreadable']}: {unread}"


def _answers(works: Sequence[GradedSubmission], language: Language) -> Iterator[list[Any]]:
    texts = language.check
    for checked in works:
        labels, formatter = _labels(checked), AnswerFormatter(language)
        for judged in checked.answers:
            key, written = judged.key, judged.written
            codes = " ".join(codes_of(checked, judged))
            wrong = "" if written is None else formatter.unread(written)
            yield [
                checked.work.student,
                checked.variant,
                judged.id if key is None else key.label,
                "" if key is None else plain_text(formatter.in_words(key)),
                Filled(texts["verdicts"][judged.verdict.value], COLOURS[judged.verdict]),
                labels.get(judged.follows, judged.follows),
                judged.value if key is None else _size(judged.value, key),
                None if key is None else displayed_value(key.exact, key),
                judged.tolerance,
                "" if key is None else plain_text(language.notation.units.get(key.unit, key.unit)),
                None if written is None else written.mm,
                None if key is None else key.mm,
                _sign(None if written is None else written.sense, texts),
                _sign(None if key is None else key.sense, texts),
                judged.local if key is None else _size(judged.local, key),
                judged.points,
                judged.of,
                judged.location,
                "; ".join(part for part in (codes, wrong, judged.remark) if part),
            ]


def _size(value: float | None, key: KeyEntry) -> float | None:
    return None if value is None else displayed_value(value, key)


def _sign(sense: Sense | None, texts: MessageTable) -> str:
    return "" if sense is None else texts["senses"][sense.value][0]


def by_code(works: Sequence[GradedSubmission], texts: MessageTable) -> Iterator[list[Any]]:
    """Yield the mistakes by how many made them, a student once for each."""
    sure: dict[str, list[str]] = {}
    perhaps: dict[str, list[str]] = {}
    for checked in works:
        seen: set[str] = set()
        for diagnosis in checked.diagnosis:
            for code in diagnosis.codes or ("",):
                if code not in seen:
                    seen.add(code)
                    known = sure if diagnosis.sure or not code else perhaps
                    known.setdefault(code, []).append(checked.work.student)
    codes = {*sure, *perhaps}
    for code in sorted(codes, key=lambda c: (-len(sure.get(c, ())), -len(perhaps.get(c, ())), c)):
        words = texts["mistakes"].get(code)
        yield [
            code or "—",
            texts["results"].unknown if words is None else words.name,
            len(sure.get(code, ())),
            len(perhaps.get(code, ())),
            ", ".join([*sure.get(code, ()), *(f"{who}?" for who in perhaps.get(code, ()))]),
        ]


def _by_answer(works: Sequence[GradedSubmission]) -> Iterator[list[Any]]:
    """Yield the answers: how many gave them, how many got points, which share of the points."""
    found: dict[str, list[GradedAnswer]] = {}
    for checked in works:
        for judged in checked.answers:
            is_told = judged.verdict is not Verdict.BLANK and not judged.is_open
            if judged.key is not None and is_told:
                found.setdefault(judged.key.label, []).append(judged)
    for label, given in found.items():
        of = sum(judged.of for judged in given)
        share = sum(judged.points for judged in given) / of if of else None
        yield [label, len(given), sum(judged.points > 0 for judged in given), share]


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
