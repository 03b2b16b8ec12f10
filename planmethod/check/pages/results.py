"""``results.xlsx``: summary, answers, mistakes of the group, settings (ведомость)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planmethod.check.model import Checked, Diagnosis, KeyEntry, Sense, Verdict
from planmethod.check.pages.listing import codes_of
from planmethod.check.pages.speech import told
from planmethod.check.pages.workbook import Filled, add_sheet, new_workbook, saved
from planmethod.note.plaintext import plain_text
from planmethod.note.wording.check_model import CheckWording
from planmethod.note.wording.language import Language

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
RIGHT = (Verdict.OK, Verdict.NEAR, Verdict.INHERITED, Verdict.INCONSISTENT)
POINTS, SHARE, VALUE, LENGTH = "0.##", "0%", "0.0000", "0.0"


def results_xlsx(
    works: Sequence[Checked],
    words: Language,
    *,
    marks: Sequence[str] = (),
    settings: Mapping[str, str | float] | None = None,
) -> bytes:
    """Return the workbook of a group.

    Parameters
    ----------
    marks : sequence of str
        Of the works, one each; none where points are all there is.
    settings : mapping
        What the last sheet shows: settings of the run and its files.
    """
    say = words.check.results
    first, second, third, fourth = say.sheets
    verdicts = [words.check.verdicts[verdict.value] for verdict in Verdict]
    book = new_workbook()
    add_sheet(
        book,
        first,
        [*say.summary[:6], *verdicts, *say.summary[6:]],
        list(_summary(works, marks, words.check)),
        formats={2: POINTS, 3: POINTS, 4: SHARE},
    )
    add_sheet(
        book,
        second,
        say.answers,
        list(_answers(works, words)),
        frozen=3,
        formats={5: VALUE, 6: VALUE, 7: VALUE, 9: LENGTH, 10: LENGTH, 13: VALUE, 14: POINTS},
    )
    by_code = list(_by_code(works, words.check))
    add_sheet(book, third, say.by_code, by_code)
    add_sheet(
        book,
        third,
        say.by_answer,
        list(_by_answer(works)),
        formats={3: SHARE},
        row=len(by_code) + 3,
    )
    add_sheet(book, fourth, say.settings, list((settings or {}).items()))
    return saved(book)


def _summary(
    works: Sequence[Checked], marks: Sequence[str], say: CheckWording
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
            "; ".join(told_mistake(d, say) for d in checked.diagnosis),
            "; ".join(_notes(checked, say)),
        ]


def told_mistake(diagnosis: Diagnosis, say: CheckWording) -> str:
    """Return a mistake for a table: its code, its name, the answers where it begins."""
    names = [
        f"{code} {say.mistakes[code].name}" if code in say.mistakes else code
        for code in diagnosis.codes
    ]
    said = " / ".join(names) if names else say.results.unknown
    if names and not diagnosis.sure:
        said = f"{say.results.perhaps}: {said}"
    return f"{said} ({', '.join(diagnosis.roots)})" if diagnosis.roots else said


def _notes(checked: Checked, say: CheckWording) -> Iterator[str]:
    if checked.suspicious:
        yield say.results.suspicious
    if checked.by_hand or any(judged.by_hand for judged in checked.answers):
        yield say.results.by_hand
    if checked.remark:
        yield checked.remark
    for written in checked.work.remarks:
        yield f"{say.verdicts['unreadable']}: {written.where} {written.unreadable}"


def _answers(works: Sequence[Checked], words: Language) -> Iterator[list[Any]]:
    say = words.check
    for checked in works:
        for judged in checked.answers:
            key, written = judged.key, judged.written
            codes = " ".join(codes_of(checked, judged))
            wrong = "" if written is None else written.unreadable
            yield [
                checked.work.student,
                checked.variant,
                judged.id if key is None else key.label,
                Filled(say.verdicts[judged.verdict.value], COLOURS[judged.verdict]),
                judged.follows,
                judged.value if key is None else _size(judged.value, key),
                None if key is None else told(key.exact, key),
                judged.tolerance,
                "" if key is None else plain_text(words.say.units.get(key.unit, key.unit)),
                None if written is None else written.mm,
                None if key is None else key.mm,
                _sign(None if written is None else written.sense, say),
                _sign(None if key is None else key.sense, say),
                judged.local if key is None else _size(judged.local, key),
                judged.points,
                judged.of,
                judged.where,
                "; ".join(part for part in (codes, wrong, judged.remark) if part),
            ]


def _size(value: float | None, key: KeyEntry) -> float | None:
    return None if value is None else told(value, key)


def _sign(sense: Sense | None, say: CheckWording) -> str:
    return "" if sense is None else say.senses[sense.value][0]


def _by_code(works: Sequence[Checked], say: CheckWording) -> Iterator[list[Any]]:
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
        words = say.mistakes.get(code)
        yield [
            code or "—",
            say.results.unknown if words is None else words.name,
            len(sure.get(code, ())),
            len(perhaps.get(code, ())),
            ", ".join([*sure.get(code, ()), *(f"{who}?" for who in perhaps.get(code, ()))]),
        ]


def _by_answer(works: Sequence[Checked]) -> Iterator[list[Any]]:
    """Yield the answers by the share of right ones among those that were given."""
    labels: dict[str, str] = {}
    given: Counter[str] = Counter()
    right: Counter[str] = Counter()
    for checked in works:
        for judged in checked.answers:
            if judged.key is None:
                continue
            labels.setdefault(judged.id, judged.key.label)
            given[judged.id] += judged.verdict is not Verdict.BLANK
            right[judged.id] += judged.verdict in RIGHT
    for id, label in labels.items():
        share = right[id] / given[id] if given[id] else None
        yield [label, given[id], right[id], share]
