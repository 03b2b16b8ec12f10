"""The page of one student, and the student's numbers next to the exact ones (лист студента)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.model import GradedAnswer, GradedSubmission, Unread, Verdict
from planmethod.check.pages.overlay import LETTERING, STYLE, Overlay, OverlayView, overlays
from planmethod.check.pages.remarks import (
    PLACED,
    UNITS_ON_PLANS,
    AnswerFormatter,
    Remarks,
    displayed_value,
    is_extra,
    quote_unread,
    quoted,
)
from planmethod.languages import translate
from planmethod.note.compared import DASH, ComparedNumber
from planmethod.note.document import (
    Caption,
    Chapter,
    Document,
    Figure,
    Item,
    Node,
    Note,
    Paragraph,
    Table,
    Title,
    plain_text,
    table_of,
)
from planmethod.note.formula import capitalized, escape
from planmethod.note.numbers import trimmed
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.html import html_document
from planmethod.note.writers.pdf import pdf_document
from planmethod.problem.records import KindProblem
from planmethod.render.backends.pdf import registered
from planmethod.solved.solution import Solution

_FAINT = 1e-6
"""Fraction of a difference below which an exact value is zero: no percentage is shown."""


def compared_document(checked: Sequence[GradedSubmission], language: Language) -> Document:
    """Return tables, one for each submission: student's value, exact value, difference."""
    return Document.of(_compared_nodes(checked, language))


def _compared_nodes(checked: Sequence[GradedSubmission], language: Language) -> Iterator[Node]:
    speech = AnswerFormatter(language)
    texts: MessageTable = language.check["compared"]
    for one in checked:
        name = " ".join(filter(None, (quoted(one.work.student), one.variant)))
        if name:
            yield Caption(name)
        written = (judged for judged in one.answers if judged.written is not None)
        yield table_of(
            texts["columns"], (list(_compared_cells(judged, speech)) for judged in written)
        )
    yield Paragraph(texts.note)


def _compared_cells(answer: GradedAnswer, formatter: AnswerFormatter) -> Iterator[str]:
    key, value = answer.key, answer.value
    yield formatter.symbol(answer)
    yield formatter.student_value(answer) or DASH
    if key is None:
        yield from (DASH, DASH, DASH)
        return
    yield formatter.si(displayed_value(key.exact, key), key)
    if value is None:
        yield from (DASH, DASH)
        return
    one = ComparedNumber(displayed_value(key.exact, key), displayed_value(value, key))
    percent = replace(one, zero_limit=_FAINT * abs(one.off)).percent
    number = formatter.language.notation.number
    yield formatter.with_unit(number(trimmed(one.off / key.per, 2)), key)
    yield DASH if percent is None else number(trimmed(percent, 2))


LOSSLESS = (Unread.COLUMN, Unread.KEY, Unread.VERTEX, Unread.OPEN, *PLACED)
"""Reported faults that do not cost an answer: an unknown column, a vertex without a letter."""


def unread_lines(
    checked: Sequence[GradedSubmission], language: Language
) -> Iterator[tuple[str, bool]]:
    """Yield what could not be read, and whether an answer is lost by it."""
    speech = AnswerFormatter(language)
    for one in checked:
        if one.failure is not None:
            more = translate(" Its trace is in run.json.") if one.failure.trace else ""
            yield (
                translate("Not marked: {}: {}.{}", one.work.student, one.failure.message, more),
                True,
            )
        for judged in one.answers:
            if judged.verdict is not Verdict.UNREADABLE:
                continue
            reason = translate("the problem has no quantity {!r}", judged.id)
            if judged.written is not None and judged.written.unreadable:
                reason = speech.unread(judged.written)
            yield translate("Unreadable: {}: {}", judged.location or judged.id, reason), True
    for one in checked:
        for remark in one.work.remarks:
            aside = remark.reason in LOSSLESS
            text = "Not read: {}: {}" if aside else "Unreadable: {}: {}"
            text = "Drawing: {}: {}" if remark.reason in PLACED else text
            yield translate(text, remark.location, speech.unread(remark)), not aside


PAPER = (178.0, 92.0)
"""Room for the plans of a page, mm: the width of both side by side, the height of one."""

GAP = 4.0
"""Between plans side by side, mm."""

RIGHT_VALUES = (3, 4)
"""Columns of the answers with the right values."""

SMALLEST = 0.42
"""Scale factor below which plans are placed one under the other."""


class AnswerLine(Struct, frozen=True):
    """One answer in the table, rich text."""

    cells: tuple[str, ...]
    verdict: Verdict


class Page(Struct, frozen=True):
    """Contents of a student's page, rich text.

    Attributes
    ----------
    title, subtitle : str
    facts : tuple of str
        Student, variant, points, mark.
    counted : str
    remarks, redraw : tuple of str
    lines : tuple of AnswerLine
    plans : tuple of Overlay
    captions : tuple of str
        Of the plans, one each.
    legend, tolerance : str
        Tolerance: the text beneath the answers.
    lang : str
    values : bool
        Whether the right values are shown.
    """

    title: str
    subtitle: str
    facts: tuple[str, ...]
    counted: str
    remarks: tuple[str, ...]
    redraw: tuple[str, ...]
    lines: tuple[AnswerLine, ...]
    plans: tuple[Overlay, ...]
    captions: tuple[str, ...]
    legend: str
    tolerance: str
    lang: str
    values: bool = True

    def scale_factors(self) -> list[float]:
        """Return by how much each plan is shrunk.

        They are side by side, equally reduced, or one under the other if that were too small.
        """
        width, height = PAPER
        sizes = [plan.size for plan in self.plans]
        if not sizes:
            return []
        whole = sum(w for w, _ in sizes)
        both = min(1.0, (width - GAP * (len(sizes) - 1)) / whole, *(height / h for _, h in sizes))
        if both >= SMALLEST:
            return [both] * len(sizes)
        return [min(1.0, width / w, height / h) for w, h in sizes]


def student_document(page: Page, solved: Solution | KindProblem, language: Language) -> Document:
    """Return the page as a document."""
    return Document.of(_page_nodes(page, solved, language))


def student_html(page: Page, solved: Solution | KindProblem, language: Language) -> str:
    """Return the page as one HTML file."""
    written = student_document(page, solved, language)
    return html_document(written, title=page.facts[0], lang=page.lang, style=STYLE)


def student_pdf(page: Page, solved: Solution | KindProblem, language: Language) -> bytes:
    """Return the page as PDF, with the name of the student at the foot of each sheet."""
    whose = plain_text(page.facts[0])
    texts: MessageTable = language.check["student"]
    return pdf_document(
        student_document(page, solved, language),
        language,
        title=whose,
        font=registered(LETTERING),
        footer=lambda number: texts.page.format(student=whose, page=number),
    )


def _page_nodes(page: Page, solved: Solution | KindProblem, language: Language) -> Iterator[Node]:
    texts: MessageTable = language.check["student"]
    yield Title(page.title)
    yield Paragraph(page.subtitle)
    yield Caption(" · ".join(page.facts))
    yield Paragraph(page.counted)
    yield Chapter(texts.remarks, numbered=False)
    yield from map(Item, page.remarks)
    if page.redraw:
        yield Chapter(texts.redraw, numbered=False)
        yield from map(Item, page.redraw)
    yield Chapter(texts.answers, numbered=False)
    columns = [n for n in range(len(texts["columns"])) if page.values or n not in RIGHT_VALUES]
    yield Table(
        tuple(texts["columns"][n] for n in columns),
        tuple(tuple(line.cells[n] for n in columns) for line in page.lines),
        names=len(columns),
        right=tuple(columns.index(n) for n in (0, 4) if n in columns),
        tones=tuple(line.verdict.value for line in page.lines),
        toned=columns.index(5),
    )
    yield Note(page.tolerance)
    if isinstance(solved, Solution) and page.plans:
        yield Chapter(texts.plans, numbered=False)
        for plan, share, caption in zip(
            page.plans, page.scale_factors(), page.captions, strict=True
        ):
            yield Figure(OverlayView(plan, share, solved), caption)
        if page.legend:
            yield Note(page.legend)


def student_page(
    checked: GradedSubmission,
    solved: Solution | KindProblem,
    language: Language,
    *,
    scales: Mapping[str, float],
    mark: str = "",
    values: bool = True,
) -> Page:
    """Return the page of a submission.

    Parameters
    ----------
    solved : Solution or KindProblem
        For a problem without plans the page has none.
    scales : mapping of str to float
        Those of the key, unit per mm.
    mark : str
        Empty where points are all there is.
    values : bool
        Whether the right values, and the true plans, are shown.
    """
    speech = AnswerFormatter(language)
    texts: MessageTable = language.check["student"]
    solution = solved if isinstance(solved, Solution) else None
    problem = solved.problem if isinstance(solved, Solution) else solved
    remarks = Remarks(speech, checked, scales, values)
    facts = [f"{texts.student}: {quoted(checked.work.student)}"]
    if checked.variant:
        facts.append(f"{texts.variant}: {quoted(checked.variant)}")
    facts.append(
        texts.points.format(points=speech.points(checked.points), of=speech.points(checked.of))
    )
    if mark:
        facts.append(texts.mark.format(mark=mark))
    plans = overlays(solution, checked, language) if solution is not None and values else []
    positions = 1 if solution is None else len(solution.positions)
    requested = [judged for judged in checked.answers if not is_extra(judged)]
    right = sum(judged.points > 0.0 for judged in requested)
    tolerance = texts.computed if solution is None else texts.tolerance
    tolerance = texts.tolerance_drawn if checked.work.drawn == "cad" else tolerance
    if not values:
        tolerance = texts.undecided if checked.open else texts.no_values
    return Page(
        title=texts.title,
        subtitle=escape(problem.title or problem.name),
        facts=tuple(facts),
        counted=texts.counted.format(right=right, count=len(requested)),
        remarks=tuple(remarks.sentences()),
        redraw=tuple(remarks.redraw()),
        lines=tuple(lines(checked.answers, speech)),
        plans=tuple(plans),
        captions=tuple(_caption(plan, positions, language) for plan in plans),
        legend=_legend(plans, language),
        tolerance=tolerance,
        lang=language.lang,
        values=values,
    )


def lines(answers: Sequence[GradedAnswer], formatter: AnswerFormatter) -> list[AnswerLine]:
    """Return the answers as rows of the table with the heads ``check.student.columns``."""
    symbols = {judged.id: formatter.symbol(judged) for judged in answers}
    return [
        AnswerLine((str(number), *_answer_cells(judged, formatter, symbols)), judged.verdict)
        for number, judged in enumerate(answers, 1)
    ]


def _answer_cells(
    answer: GradedAnswer, formatter: AnswerFormatter, symbols: Mapping[str, str]
) -> tuple[str, ...]:
    key, written, texts = answer.key, answer.written, formatter.texts
    own = formatter.student_value(answer)
    if answer.verdict is Verdict.UNREADABLE and written is not None:
        own = texts["student"].quoted.format(text=quote_unread(written))
    verdict = texts["verdicts"][answer.verdict.value]
    if answer.follows in symbols:
        verdict = texts["student"].source.format(source=symbols[answer.follows])
    return (
        formatter.symbol(answer),
        own or "—",
        "—" if key is None else formatter.right(key, answer.tolerance),
        _lengths(answer, formatter),
        verdict,
        texts["student"].extra
        if is_extra(answer)
        else texts["student"].share.format(
            points=formatter.points(answer.points), of=formatter.points(answer.of)
        ),
    )


def _lengths(answer: GradedAnswer, formatter: AnswerFormatter) -> str:
    """Return the student's millimetres next to the true ones."""
    key, written = answer.key, answer.written
    own = None if written is None else written.mm
    true = None if key is None else key.mm
    follows = key is not None and key.unit not in UNITS_ON_PLANS
    if own is None and (true is None or follows):
        return ""
    shown = "—" if own is None else formatter.number(own)
    return f"{shown} / {'—' if true is None else formatter.mm(true, unit=False)}"


def _caption(plan: Overlay, positions: int, language: Language) -> str:
    texts: MessageTable = language.check["student"]
    name = texts["plan_names"][plan.kind.value]
    caption = texts.plan_title.format(plan=capitalized(name), scale=plan.scale)
    if positions > 1:
        caption += f", {texts.position.format(position=plan.index)}"
    return caption


def _legend(plans: Sequence[Overlay], language: Language) -> str:
    texts: MessageTable = language.check["student"]
    if not any(plan.student_segments for plan in plans):
        return ""
    if all(own.is_right for plan in plans for own in plan.student_segments):
        return texts.legend_right
    code = next((plan.mistake for plan in plans if plan.mistake), "")
    if code in language.check["mistakes"]:
        return texts.legend_mistake.format(name=language.check["mistakes"][code].name)
    return texts.legend
