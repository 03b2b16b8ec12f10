"""Remarks to a student, and the look of the page."""

from __future__ import annotations

import re
import shutil
import string
import subprocess
from collections.abc import Iterator
from html.parser import HTMLParser
from io import BytesIO
from pathlib import Path

import ex3_work
import numpy as np
import pytest
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    AnswerFormatter,
    Diagnosis,
    Figure,
    GradedAnswer,
    GradedSubmission,
    Page,
    Remarks,
    Sense,
    Submission,
    Unread,
    Variants,
    Verdict,
    WrittenAnswer,
    check,
    get_language,
    key_of_task,
    markup,
    overlays,
    student_document,
    student_html,
    student_page,
    student_pdf,
)
from msgspec.structs import replace
from PIL import Image
from worked import path_of

RU = get_language("ru")
CODES = [
    *(f"V{n}" for n in range(1, 7)),
    *(f"A{n}" for n in range(1, 7)),
    *(f"{letter}{n}" for letter in "NF" for n in range(1, 6)),
    *(f"S{n}" for n in range(1, 5)),
    *(f"{letter}{n}" for letter in "EZP" for n in (1, 2)),
    *("sign", "slip", "swap", "true_mm", "scale"),
]


def remarks(checked: GradedSubmission, lang: str = "ru") -> list[str]:
    return Remarks(AnswerFormatter(get_language(lang)), checked, ex3_work.SCALES).sentences()


def page_of(checked: GradedSubmission, lang: str = "ru") -> Page:
    return student_page(
        checked, ex3_work.solution(), get_language(lang), scales=ex3_work.SCALES, mark="4"
    )


def one(verdict: Verdict, number: int = 0, **told: object) -> GradedSubmission:
    """Return a work with one answer, judged so."""
    key = ex3_work.entries()[number]
    written = told.pop("written", WrittenAnswer(id=key.id, value=key.exact, mm=key.mm))
    judged = GradedAnswer(key.id, verdict, key, written, **{"of": 1.0, **told})  # type: ignore[arg-type]
    return replace(ex3_work.work(), answers=(judged,), diagnosis=(), points=judged.points, of=1.0)


def test_a_mistake_is_named_with_both_numbers_its_place_and_the_next_step() -> None:
    first, inherited, unseen = remarks(ex3_work.work())
    words = RU.check["mistakes"]["A1"]
    assert words.so in first and words.advice in first and "B3/2" in first
    assert "119,6" in first and "55,6\N{NO-BREAK SPACE}±" in first and "(119,3" in first
    assert RU.check["student"].kept in inherited and "ε_{3}, a_{D}, a_{E}" in inherited
    assert "ε_{4}" in unseen


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("code", CODES)
def test_every_mistake_has_its_sentence_in_every_language(code: str, lang: str) -> None:
    work = ex3_work.work()
    found = replace(work.diagnosis[0], codes=(code,))
    words = get_language(lang).check["mistakes"][code]
    first = remarks(replace(work, diagnosis=(found,)), lang)[0]
    assert words.so in first and words.advice in first
    assert words.advice.endswith(".") and not words.name.endswith(".")


def test_an_uncertain_diagnosis_is_called_a_guess() -> None:
    work = ex3_work.work()
    several = replace(work.diagnosis[0], codes=("A1", "A3"), sure=False)
    first = remarks(replace(work, diagnosis=(several,)))[0]
    assert all(RU.check["mistakes"][code].name in first for code in ("A1", "A3"))
    assert RU.check["mistakes"]["A1"].advice not in first
    unknown = remarks(replace(work, diagnosis=(Diagnosis((), False, ("a_B3",)),)))[0]
    assert "πb_{3}" in unknown and "не удалось" in unknown


def test_a_wrong_answer_without_a_diagnosis_is_not_passed_over() -> None:
    key = ex3_work.entries()[0]
    told = remarks(one(Verdict.WRONG, value=key.exact * 1.4))
    assert len(told) == 1 and "v_{B3}" in told[0] and "pb_{3}" in told[0]


def test_further_results_of_the_same_mistake_are_called_its_consequence() -> None:
    work = ex3_work.work()
    answers = tuple(
        replace(j, verdict=Verdict.WRONG, follows="") if j.id == "a_D" else j for j in work.answers
    )
    told = remarks(replace(work, answers=answers))
    assert RU.check["student"].follow.format(answers="a_{D}") in told


def test_each_verdict_has_its_remark() -> None:
    key = ex3_work.entries()[0]
    near = remarks(one(Verdict.NEAR, value=key.exact * 1.04, points=0.7))
    assert "0,7 из 1" in near[0]
    assert (
        "из ваших предыдущих"
        in remarks(one(Verdict.INCONSISTENT, value=key.exact, local=3.0, points=1.0))[0]
    )
    slipped = remarks(one(Verdict.WRONG, value=4.49, slip=True))
    assert "44,87 мм · 0,05 = 2,243" in " ".join(slipped).replace("\N{NO-BREAK SPACE}", " ")
    (turning,) = (entry for entry in ex3_work.entries() if entry.id == "epsilon_3")
    written = WrittenAnswer(id=turning.id, value=1.2 * turning.exact, mm=40.0)
    told = one(Verdict.WRONG, value=written.value, written=written, slip=True)
    answer = replace(told.answers[0], id=turning.id, key=replace(turning, mm=50.0))
    own = AnswerFormatter(RU).si(0.8 * abs(turning.exact), turning)  # a^τ, and that over l
    (told_of_it,) = remarks(replace(told, answers=(answer,)))
    assert RU.check["student"].recompute.format(local=own) in told_of_it
    blank = remarks(one(Verdict.BLANK, written=None))
    assert blank == [RU.check["student"].blank.format(answers="v_{B3}")]
    raw = WrittenAnswer(
        id="v_B3",
        raw="семь",
        location="Ответы!D12",
        unreadable="x",
        reason=Unread.NUMBER,
        fault="семь",
    )
    unread = remarks(one(Verdict.UNREADABLE, written=raw))[0]
    assert "«семь»" in unread and "Ответы!D12" in unread
    wrong_way = WrittenAnswer(id="v_B3", value=key.exact, sense=Sense.RIGHT)
    assert (
        "←" in remarks(one(Verdict.WRONG, value=key.exact, written=wrong_way, sense_right=False))[0]
    )
    silent = remarks(one(Verdict.OK, value=key.exact, points=0.7))
    assert silent == [RU.check["student"].no_sense.format(answers="v_{B3}")]
    assert remarks(one(Verdict.OK, value=key.exact, points=1.0)) == [RU.check["student"].all_right]


def test_points_lost_by_inheriting_are_reported() -> None:
    work = ex3_work.work()
    half = tuple(
        replace(j, points=0.5) if j.verdict is Verdict.INHERITED else j for j in work.answers
    )
    assert "1,5 из 3" in remarks(replace(work, answers=half))[1]


def test_an_unreadable_entry_beside_the_answers_is_reported() -> None:
    work = ex3_work.work()
    scale = WrittenAnswer(location="group.csv:7", unreadable="x", reason=Unread.SCALE, fault="два")
    told = remarks(replace(work, work=replace(work.work, remarks=(scale,))))
    assert "«два»" in told[-2] and "(group.csv:7)" in told[-2]


def test_redrawing_begins_where_the_trouble_begins() -> None:
    lines = Remarks(AnswerFormatter(RU), ex3_work.work(), ex3_work.SCALES).redraw()
    assert len(lines) == 1 and "πb_{3}" in lines[0] and "55,6" in lines[0]


def test_a_number_that_follows_from_a_segment_needs_no_redrawing() -> None:
    key = replace(ex3_work.entries()[1], mm=44.9, scale="mu_v", segment="p-b3")
    judged = GradedAnswer(
        key.id, Verdict.WRONG, key, WrittenAnswer(id=key.id), value=-15.5, sense_right=False
    )
    work = replace(ex3_work.work(), answers=(judged,), diagnosis=())
    assert Remarks(AnswerFormatter(RU), work, ex3_work.SCALES).redraw() == []
    turned = one(Verdict.WRONG, value=ex3_work.entries()[0].exact, sense_right=False)
    assert Remarks(AnswerFormatter(RU), turned, ex3_work.SCALES).redraw() == []


@pytest.mark.parametrize("lang", LANGUAGES)
def test_two_exchanged_numbers_are_put_right_by_their_lengths_and_nothing_is_drawn_again(
    lang: str,
) -> None:
    task = Variants(path_of("linkages/ex3")).task(None)
    right = {entry.id: entry for entry in key_of_task(task).entries}
    put = {**{id: id for id in right}, "v_B3": "v_D", "v_D": "v_B3"}
    answers = tuple(
        WrittenAnswer(id=id, value=right[there].exact, sense=right[id].sense, step=1e-6)
        for id, there in put.items()
    )
    found = check(task, Submission("s", answers))
    shown = Remarks(AnswerFormatter(get_language(lang)), found, ex3_work.SCALES)
    [first, *others] = shown.sentences()
    measured = get_language(lang).notation.measured
    lengths = [measured(round(right[id].mm or 0.0, 1)) for id in ("v_B3", "v_D")]
    assert all(letters in first for letters in ("v_{B3}", "v_{D}", "pb_{3}", "pd", *lengths))
    assert not any("v_{D}" in told for told in others) and shown.redraw() == []
    secret = replace_values(shown)
    assert not any(length in secret.sentences()[0] for length in lengths)


def replace_values(shown: Remarks) -> Remarks:
    """Return the remarks of a page without the right values."""
    return Remarks(shown.formatter, shown.checked, shown.scales, values=False)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_an_answer_that_is_not_requested_is_marked_so_wherever_it_is_shown(lang: str) -> None:
    key = ex3_work.entries()[0]
    extra = GradedAnswer(key.id, Verdict.WRONG, key, WrittenAnswer(id=key.id), value=9.0)
    work = ex3_work.work()
    work = replace(work, answers=(*work.answers[1:], extra), diagnosis=())
    page, words = page_of(work, lang), get_language(lang).check["student"].extra
    assert any(words in remark and "v_{B3}" in remark for remark in page.remarks)
    assert [words in line.cells[-1] for line in page.lines] == [*[False] * 8, True]
    counted = get_language(lang).check["student"].counted
    assert page.counted == counted.format(right=7, count=8)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_legend_says_nothing_of_red_where_all_is_right(lang: str) -> None:
    words = get_language(lang).check["student"]
    right = one(Verdict.OK, value=ex3_work.entries()[0].exact, points=1.0)
    assert page_of(right, lang).legend == words.legend_right
    wrong = one(Verdict.WRONG, value=1.4 * ex3_work.entries()[0].exact)
    assert page_of(wrong, lang).legend == words.legend


def test_one_possible_cause_is_not_one_of_several() -> None:
    work = ex3_work.work()
    perhaps = replace(work.diagnosis[0], codes=("A1",), sure=False)
    first = remarks(replace(work, diagnosis=(perhaps,)))[0]
    start = RU.check["student"].one_of.partition("{")[0]
    words = RU.check["mistakes"]["A1"]
    assert start not in first and words.name in first and words.advice in first


@pytest.mark.parametrize("lang", LANGUAGES)
def test_of_another_variant_nothing_else_is_said(lang: str) -> None:
    work = ex3_work.work()
    everything = tuple(judged.id for judged in work.answers)
    other = Diagnosis(("P2",), True, everything, "7")
    slipped = tuple(replace(judged, slip=True) for judged in work.answers)
    work = replace(work, answers=slipped, diagnosis=(other,))
    [told] = remarks(work, lang)
    words = get_language(lang).check["student"]["mistake_here"]
    assert words["P2"].format(where="7") in told and words["link"].format(where="7") not in told
    assert Remarks(AnswerFormatter(get_language(lang)), work, ex3_work.SCALES).redraw() == []


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("code", ["S2", "true_mm"])
def test_the_place_of_a_unit_of_length_is_in_words(code: str, lang: str) -> None:
    work = ex3_work.work()
    found = replace(work.diagnosis[0], codes=(code,), mistake_at="l")
    assert "(l)" not in remarks(replace(work, diagnosis=(found,)), lang)[0]


def test_products_of_a_plan_whose_scale_is_the_mistake_are_not_each_a_slip() -> None:
    work = ex3_work.work()
    slipped = tuple(replace(j, slip=True) if j.key and j.key.scale else j for j in work.answers)
    scale = Diagnosis(("S3",), True, ("a_B3",), "mu_a")
    told = " ".join(remarks(replace(work, answers=slipped, diagnosis=(scale,))))
    assert "a_{D}: " not in told and "v_{D}: " in told
    assert RU.check["student"]["mistake_here"]["S3"].format(where="μ_{a}") in told


def test_a_computed_value_is_recomputed_not_looked_for_on_the_plan() -> None:
    entries = key_of_task(Variants(path_of("linkages/ex3")).task(None)).entries
    computed = {entry.id for entry in entries if entry.computed}
    assert {"an_B3_C", "ak_B3_B", "a_B"} <= computed
    assert not computed & {"v_B3", "at_B3_C", "a_B3", "v_D", "omega_3", "epsilon_3"}
    for entry in entries:
        if not entry.segment or entry.unit not in ("m/s", "m/s²"):
            continue
        judged = GradedAnswer(
            entry.id, Verdict.WRONG, entry, WrittenAnswer(id=entry.id), value=7 * entry.exact
        )
        [told] = remarks(replace(ex3_work.work(), answers=(judged,), diagnosis=(), of=1.0))
        is_drawn = RU.check["student"].unknown.partition("{")[0] in told
        assert is_drawn is not entry.computed, entry.id


# The picture --------------------------------------------------------------------------------------


def test_segments_are_on_the_plan_with_the_students_lengths() -> None:
    velocity, acceleration = overlays(ex3_work.solution(), ex3_work.work(), RU)
    assert (
        all(own.is_right for own in velocity.student_segments)
        and len(velocity.student_segments) == 3
    )
    by_number = {own.number: own for own in acceleration.student_segments}
    assert not by_number[5].is_right
    assert abs(by_number[5].head - by_number[5].tail) == pytest.approx(119.64, abs=0.1)
    assert acceleration.mistake == "A1" and any(
        own.number is None for own in acceleration.student_segments
    )
    left, low, right, high = acceleration.bounds
    for own in acceleration.student_segments:
        assert left <= own.head.real <= right and low <= own.head.imag <= high


def test_the_plan_of_the_mistake_gives_the_direction() -> None:
    work = ex3_work.work()
    bare = replace(work, diagnosis=(replace(work.diagnosis[0], places={}),))
    drawn, plain = (overlays(ex3_work.solution(), w, RU)[1] for w in (work, bare))
    here, there = (
        next(o for o in plan.student_segments if o.number == 5) for plan in (drawn, plain)
    )
    assert abs(here.head - here.tail) == pytest.approx(abs(there.head - there.tail))
    assert abs(here.head - there.head) > 20.0
    assert not plain.mistake and all(own.number for own in plain.student_segments)


def test_absurd_numbers_leave_the_plan_to_be_seen() -> None:
    work = ex3_work.work()
    absurd = tuple(replace(j, value=v) for j, v in zip(work.answers, _odd(), strict=False))
    for plan in overlays(ex3_work.solution(), replace(work, answers=absurd), RU):
        assert max(plan.size) < 1500.0


@pytest.mark.parametrize("value", [1e300, -1e300, float("nan"), float("inf"), 5e-324, 0.0])
def test_absurd_numbers_break_no_page(value: float) -> None:
    work = ex3_work.work()
    answers = tuple(
        replace(j, value=value, local=value, tolerance=abs(value), slip=True) for j in work.answers
    )
    page = page_of(replace(work, answers=answers, points=value, of=value))
    assert student_pdf(page, ex3_work.solution(), RU) and student_html(
        page, ex3_work.solution(), RU
    )


def _odd() -> Iterator[float | None]:
    yield from (1e300, float("nan"), float("inf"), -1e9, 0.0, None, 1e-300, 1e6, -0.0)


def test_a_wrong_sense_is_drawn_the_other_way() -> None:
    key = ex3_work.entries()[0]
    right, turned = (
        overlays(ex3_work.solution(), one(Verdict.WRONG, value=key.exact, sense_right=s), RU)[0]
        for s in (True, False)
    )
    assert (
        abs(
            right.student_segments[0].head
            - right.student_segments[0].tail
            + turned.student_segments[0].head
            - turned.student_segments[0].tail
        )
        < 1e-9
    )


# Files --------------------------------------------------------------------------------------------


class _Strict(HTMLParser):
    """Checks that tags are closed, and collects items that would be loaded or run."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.bad: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in ("meta", "br"):
            self.open.append(tag)
        if tag in ("script", "link", "iframe", "object", "img", "base", "form"):
            self.bad.append(tag)
        self.bad += [n for n, v in attrs if n.startswith("on") or n in ("src", "href")]
        self.bad += [v for n, v in attrs if n == "xlink:href" and v and not v.startswith("#")]

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_html_is_complete_and_neither_loads_nor_runs_anything(lang: str) -> None:
    name = "<script>alert(1)</script><img src=x onerror=y>\x00"
    work = ex3_work.work(name)
    text = student_html(page_of(work, lang), ex3_work.solution(), get_language(lang))
    reader = _Strict()
    reader.feed(text)
    assert not reader.open and not reader.bad
    assert "\x00" not in text and "<script" not in text and text.count("<svg") == 2


def test_no_verdict_is_shown_by_colour_alone() -> None:
    work = ex3_work.work()
    text = student_html(page_of(work), ex3_work.solution(), RU)
    for judged in work.answers:
        row = re.search(rf'<tr class="{judged.verdict.value}">.*?</tr>', text)
        assert row and re.search("верно|следует|чертёж|нет|не прочитано", row[0])
    assert "stroke-dasharray" in text


def test_plans_are_figures_in_pixels_too() -> None:
    written = student_document(page_of(ex3_work.work()), ex3_work.solution(), RU)
    views = [node.view for node in written.nodes if isinstance(node, Figure)]
    assert views
    for view in views:
        pixels = np.asarray(Image.open(BytesIO(view.png(50.8))))
        width, height = view.size
        assert pixels.shape[:2] == pytest.approx((2 * height, 2 * width), abs=1.0)
        assert pixels.min() < 100


def test_a_students_text_is_shown_literally() -> None:
    for name in ("Иванов_", "a_{b", "x^", "\\frac"):
        text = student_html(page_of(ex3_work.work(name)), ex3_work.solution(), RU)
        assert f">{name}" in text or f" {name}" in text


def test_only_indices_become_tags() -> None:
    assert markup("v_{B3} <b> a^{τ}") == "v<sub>B3</sub> &lt;b&gt; a<sup>τ</sup>"
    assert "<script>" not in markup("x_{<script>}")


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_pdf_is_the_same_each_time_and_embeds_its_letters(lang: str) -> None:
    page = page_of(ex3_work.work(), lang)
    data = student_pdf(page, ex3_work.solution(), get_language(lang))
    assert data == student_pdf(page, ex3_work.solution(), get_language(lang)) and data.startswith(
        b"%PDF"
    )
    assert b"Helvetica" not in data and b"PlanmethodGOST" in data


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="poppler is absent")
def test_the_text_of_the_pdf_can_be_searched(tmp_path: Path) -> None:
    work = ex3_work.work("Щукина Ёлка " + "длинное" * 30)
    (tmp_path / "s.pdf").write_bytes(student_pdf(page_of(work), ex3_work.solution(), RU))
    done = subprocess.run(
        ["pdftotext", "-layout", str(tmp_path / "s.pdf"), "-"], capture_output=True, timeout=60
    )
    text = done.stdout.decode()
    assert "Щукина Ёлка" in text and "Кориолиса" in text and "неверно" in text


def test_a_long_work_continues_on_further_pages() -> None:
    work = ex3_work.work()
    many = replace(work, answers=work.answers * 20)
    data = student_pdf(page_of(many), ex3_work.solution(), RU)
    assert data.count(b"/Type /Page\n") + data.count(b"/Type /Page ") >= 4


def _texts(words: object) -> Iterator[str]:
    if isinstance(words, str):
        yield words
    elif isinstance(words, tuple):
        for word in words:
            yield from _texts(word)
    elif isinstance(words, dict):
        for word in words.values():
            yield from _texts(word)


def test_languages_have_the_same_places_in_their_sentences() -> None:
    def places(lang: str) -> list[set[str]]:
        parse = string.Formatter().parse
        return [
            {name for _, name, _, _ in parse(re.sub(r"[_^]\{[^{}]*\}", "", text)) if name}
            for text in _texts(get_language(lang).check)
        ]

    first, *others = (places(lang) for lang in LANGUAGES)
    assert all(other == first for other in others)
