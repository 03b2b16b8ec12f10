"""``results.xlsx``: summary, answers, mistakes of the group, settings (ведомость)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from planmethod.check.model import (
    Diagnosis,
    GradedAnswer,
    GradedSubmission,
    KeyEntry,
    Sense,
    Verdict,
)
from planmethod.check.pages.answer_format import AnswerFormatter, displayed_value
from planmethod.check.pages.listing import codes_of
from planmethod.check.pages.statistics import GroupStatistics
from planmethod.note.plaintext import plain_text
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.workbook import Filled, add_bars, add_sheet, new_workbook, saved

if TYPE_CHECKING:
    from openpyxl import Workbook

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
        formats={5: VALUE, 6: VALUE, 7: VALUE, 9: LENGTH, 10: LENGTH, 13: VALUE, 14: POINTS},
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
        unread = AnswerFormatter(language).unread(written)
        yield f"{texts['verdicts']['unreadable']}: {written.location} {unread}"


def _answers(works: Sequence[GradedSubmission], language: Language) -> Iterator[list[Any]]:
    texts = language.check
    for checked in works:
        labels = _labels(checked)
        for judged in checked.answers:
            key, written = judged.key, judged.written
            codes = " ".join(codes_of(checked, judged))
            wrong = "" if written is None else AnswerFormatter(language).unread(written)
            yield [
                checked.work.student,
                checked.variant,
                judged.id if key is None else key.label,
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
