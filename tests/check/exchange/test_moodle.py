"""Questions for Moodle: read back by its grammar, every interval compared with the key."""

from __future__ import annotations

import html
import json
import math
import random
import re
import struct
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from cases import is_thinned
from click.testing import CliRunner
from doors import (
    DEFAULT,
    LINKAGES,
    WORDING_LANGUAGES as LANGUAGES,
    AnswerFormatter,
    Calculation,
    KeyEntry,
    QuizPart,
    Text,
    Variants,
    assigned,
    cli,
    describe,
    escaped,
    gaps_of as gaps_of_task,
    get_language,
    integer_points,
    key_of_task,
    key_record,
    kind_of,
    markup,
    moodle_xml,
    plain_text,
    question_of,
    task_of_problem,
    variant_names,
)
from embedded import Gap, Question, gaps_of, read_quiz
from msgspec.structs import replace
from worked import path_of

RU = get_language("ru")
FINE = 2e-3
"""Share of a tolerance that rounding may cost at either end."""


COUNT = 10 if is_thinned() else 30


def ex3_of_many(folder: Path) -> Path:
    """Return a file with variants of ex3: the angle, the crank and the rod differ in each."""
    text = path_of("linkages/ex3-variants").read_text("utf-8")
    head, _, tail = text.partition("[variants]")
    asked = tail[tail.index("[[answers]]") :]
    rng, rows = random.Random(7), []
    for number in range(1, COUNT + 1):
        phi = 5 * rng.randrange(2, 31)
        ab, de = 0.002 * rng.randrange(28, 36), 0.005 * rng.randrange(32, 41)
        rows.append(
            f'"{number}" = {{ driver.phi = {phi}, links.1.AB = {ab:.3f}, links.4.DE = {de:.3f} }}'
        )
    path = folder / "many.toml"
    path.write_text("\n".join([f"{head}[variants]", *rows, "", asked]), "utf-8")
    return path


@cache
def many(folder: Path) -> tuple[list[dict[str, Any]], list[Question]]:
    path = ex3_of_many(folder)
    out = folder / "many.xml"
    run = CliRunner().invoke(
        cli, ["check", "--key", str(path), "--moodle", str(out), "--json", "--lang", "ru"]
    )
    assert run.exit_code == 0, run.output
    keys = json.loads(run.stdout)
    [(category, questions)] = read_quiz(out.read_bytes()).items()
    assert category == "$course$/top/Рычажный механизм"
    return keys, questions


@pytest.fixture(scope="module")
def whole(
    tmp_path_factory: pytest.TempPathFactory,
) -> tuple[list[dict[str, Any]], list[Question]]:
    return many(tmp_path_factory.mktemp("moodle"))


def compare(answer: dict[str, Any], gap: Gap) -> None:
    """Probe the limits of the values that a gap accepts against the tolerance of the key."""
    value, per = float(answer["value"]) / float(answer["per"]), float(answer["per"])
    tolerance = float(answer["tolerance"]) / per
    value = (
        value
        if answer["signed"] and not answer["asks_sense"] and answer["sense"] is None
        else abs(value)
    )
    for side in (1, -1):
        assert gap.grade(value + side * tolerance * (1 - FINE))[0] == 1.0, (answer["id"], side)
    if answer["zero"]:
        assert gap.grade(0.0)[0] == 1.0
    elif answer["seen"]:
        for side in (1, -1):
            off, feedback = gap.grade(value + side * tolerance * (1 + FINE))
            assert off == pytest.approx(DEFAULT.near_share) and feedback, answer["id"]
            within = gap.grade(value + side * tolerance * DEFAULT.near * (1 - FINE))
            assert within[0] == pytest.approx(DEFAULT.near_share), answer["id"]
            beyond = gap.grade(value + side * tolerance * DEFAULT.near * (1 + FINE))
            assert beyond[0] == 0.0, answer["id"]
    else:
        spread = DEFAULT.k * float(answer["sigma"]) / per
        for side in (1, -1):
            assert gap.grade(value + side * spread * (1 - FINE))[0] == 1.0, answer["id"]
            assert gap.grade(value + side * spread * (1 + FINE))[0] == 0.0, answer["id"]


@pytest.mark.usefixtures("russian")
def test_variants_are_questions_of_one_category_and_all_intervals_are_the_keys(
    whole: tuple[list[dict[str, Any]], list[Question]],
) -> None:
    keys, questions = whole
    assert len(keys) == len(questions) == COUNT
    assert len({question.name for question in questions}) == COUNT
    compared = 0
    for key, question in zip(keys, questions, strict=True):
        assert str(question.name).endswith(f"Вариант {key['variant']}")
        numbers = iter(gap for gap in question.gaps if gap.kind == "NUMERICAL")
        senses = iter(gap for gap in question.gaps if gap.kind == "MULTICHOICE")
        for answer in key["answers"]:
            compare(answer, next(numbers))
            compared += 1
            if answer["asks_sense"]:
                right = [c.answer for c in next(senses).choices if c.fraction == 1.0]
                known = (
                    [" ".join(RU.check["senses"][answer["sense"]])] if answer["sense"] else right
                )
                assert right == known or answer["zero"], answer["id"]
        assert next(numbers, None) is None and next(senses, None) is None
    assert compared == COUNT * 19


def test_a_question_has_its_data_its_scheme_and_no_answer_in_its_text(
    whole: tuple[list[dict[str, Any]], list[Question]],
) -> None:
    _, questions = whole
    data = {
        found for q in questions for found in re.findall(r"φ<sub>1</sub> = \d+°.*?const", q.text)
    }
    assert len(data) == COUNT, "each has its own"
    for question in questions:
        [(name, png)] = question.files.items()
        assert f'src="@@PLUGINFILE@@/{name}"' in question.text and png[:4] == b"\x89PNG"
        width, height = struct.unpack(">II", png[16:24])
        assert 300 < width < 1200 and 200 < height < 1200
    assert len({question.files["scheme.png"] for question in questions}) > COUNT * 2 / 3


@pytest.mark.usefixtures("russian")
def test_a_mistake_that_has_a_name_gets_no_points_and_its_sentence(
    whole: tuple[list[dict[str, Any]], list[Question]],
) -> None:
    keys, questions = whole
    shown, named = 0, 0
    for key, question in zip(keys, questions, strict=True):
        numbers = [gap for gap in question.gaps if gap.kind == "NUMERICAL"]
        answers = {one["id"]: (one, gap) for one, gap in zip(key["answers"], numbers, strict=True)}
        one, gap = answers["ak_B3_B"]
        if not one["zero"] and one["seen"]:
            # The factor 2 left out: half of the Coriolis acceleration.
            fraction, feedback = gap.grade(one["value"] / 2)
            assert fraction == 0.0
            known = RU.check["mistakes"]["A3"]
            shown, named = (
                shown + 1,
                named + (markup(known.so) in feedback or known.name in feedback),
            )
    assert shown >= 0.3 * COUNT and named == shown, (shown, named)


def test_all_variants_have_the_same_gaps_though_a_value_is_zero_in_one(tmp_path: Path) -> None:
    text = path_of("linkages/ex3").read_text("utf-8").partition("[[answers]]")[0]
    asked = "".join(
        f'[[answers]]\nwhat = "{name}"\nsense = true\n' for name in ("omega 3", "v B3", "epsilon 3")
    )
    rows = "".join(
        f"[variants.{n}]\ndriver.phi = {phi}\n" for n, phi in enumerate((20, 90, 270), 1)
    )
    path = tmp_path / "zero.toml"
    path.write_text(text + asked + rows, "utf-8")
    variants = Variants(path)
    tasks = [variants.task(name) for name in variants.names]
    zero = [answer for task in tasks for answer in key_record(key_of_task(task))["answers"]]
    assert any(answer["zero"] for answer in zero) and not all(answer["zero"] for answer in zero)
    questions = [question_of(task, kind_of(path), RU) for task in tasks]
    [read] = read_quiz(moodle_xml(questions, RU)).values()
    kinds = {tuple((gap.kind, gap.points) for gap in one.gaps) for one in read}
    assert len(kinds) == 1 and len({tuple(gaps_of_task(task)) for task in tasks}) == 1
    for answer, gap in zip(
        zero, (gap for one in read for gap in one.gaps if gap.kind == "MULTICHOICE"), strict=True
    ):
        right = sum(choice.fraction == 1.0 for choice in gap.choices)
        assert right == len(gap.choices) if answer["zero"] else right < len(gap.choices)


def test_points_of_senses_and_numbers_keep_the_shares_of_the_department() -> None:
    entry = KeyEntry("v", "v", "v", "m/s", 1.0, 0.0, 0.1)
    assert integer_points([QuizPart(entry, 1.0), QuizPart(entry, 2.0)]) == [1, 2]
    assert integer_points([QuizPart(entry, 0.7), QuizPart(entry, 0.3)]) == [7, 3]
    assert integer_points([QuizPart(entry, 0.75), QuizPart(entry, 0.0)]) == [3, 0]


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize(
    "name", ["gears/gears-ex2", "gears/gears-ex5", "levers/task12", "point/k11-01"]
)
def test_trains_forces_and_points_are_compared_as_well(name: str, lang: str) -> None:
    path = path_of(name)
    kind, variants = kind_of(path), variant_names(path)
    variant = variants[0] if variants else None
    task = Variants(path).task(variant)
    words = get_language(lang)
    question = question_of(task, kind, words)
    [[back]] = read_quiz(moodle_xml([question], words)).values()
    numbers = iter(gap for gap in back.gaps if gap.kind == "NUMERICAL")
    answers = key_record(key_of_task(task))["answers"]
    assert answers
    for answer in answers:
        if isinstance(task, Calculation):
            compare_computed(answer, next(numbers))
        else:
            compare(answer, next(numbers))
    assert next(numbers, None) is None
    assert bool(back.files) is (name != "point/k11-01")


KINDS = (
    "gears/gears-ex2",
    "gears/gears-ex5",
    "levers/task12",
    "linkages/ex3-variants",
    "point/k11-01",
    "press/press",
)


def three_digits(value: float, mark: str) -> str:
    """Return a number as a student writes it: 1,23 or 1.23, never 1e+03."""
    size = math.floor(math.log10(abs(value))) if value else 0
    return f"{value:.{max(0, 2 - size)}f}".replace(".", mark)


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", KINDS)
def test_a_student_who_answers_right_gets_everything_and_one_who_is_wrong_nothing(
    name: str, lang: str
) -> None:
    path = path_of(name)
    kind, words, group = kind_of(path), get_language(lang), Variants(path)
    names = group.names or (None,)
    tasks = [group.task(variant) for variant in names]
    [read] = read_quiz(moodle_xml([question_of(t, kind, words) for t in tasks], words)).values()
    for task, question in zip(tasks, read, strict=True):
        key = {(one.id, one.position): one for one in key_of_task(task).entries}
        gaps = zip(gaps_of_task(task), question.gaps, strict=True)
        for number, (gap_name, gap) in enumerate(gaps):
            entry = key[gap_name.id, gap_name.position]
            if gap_name.sense:
                right = [c for c in gap.choices if c.fraction == 1.0]
                assert right and all(c.fraction in (0.0, 1.0) for c in gap.choices)
                continue
            unsigned = entry.asks_sense or not entry.signed
            value = (abs(entry.exact) if unsigned else entry.exact) / entry.per
            written = three_digits(value, ",."[number % 2])
            assert gap.grade(float(written.replace(",", ".")))[0] == 1.0, (entry.id, written)
            if not entry.zero and entry.is_visible:
                off = 40.0 * max(entry.tolerance / entry.per, abs(value))
                assert gap.grade(value + off)[0] == 0.0, entry.id


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", KINDS)
def test_the_text_defines_the_mechanism_and_says_what_is_asked_in_what_unit(
    name: str, lang: str
) -> None:
    path = path_of(name)
    kind, words, group = kind_of(path), get_language(lang), Variants(path)
    task = group.task(group.names[0] if group.names else None)
    question = question_of(task, kind, words)
    [[read]] = read_quiz(moodle_xml([question], words)).values()
    texts, text = words.check["exchange"], html.unescape(read.text)
    assert all(html.unescape(markup(f.text)) in text for f in question.given_facts if f.text)
    assert question.given_facts and texts.how in text
    assert (texts.how_sense in text) is any(gap.kind == "MULTICHOICE" for gap in read.gaps)
    drawn = any(part.entry.sigma for part in question.parts)
    assert (texts.accepted in text) is drawn
    assert drawn or re.search(r"0[.,]5 %", text)
    for entry in key_of_task(task).entries:
        own = describe(entry, plain_text(words.notation.symbol(entry.symbol)), words)
        assert own and f">{own}, " in text, own
    for part in question.parts:
        unit = html.unescape(markup(AnswerFormatter(words).unit(part.entry)))
        assert unit in text, unit
    if name != "point/k11-01":
        [png] = read.files.values()
        assert png[:4] == b"\x89PNG" and "<img" in read.text


def compare_computed(answer: dict[str, Any], gap: Gap) -> None:
    value, per = float(answer["value"]), float(answer["per"])
    tolerance = float(answer["tolerance"])
    for side in (1, -1):
        assert gap.grade((value + side * tolerance * (1 - FINE)) / per)[0] == 1.0, answer["id"]
        off = gap.grade((value + side * tolerance * (1 + FINE)) / per)[0]
        assert off < 1.0, answer["id"]


def test_a_negative_ratio_does_not_pass_with_the_other_sign() -> None:
    path = path_of("gears/gears-ex2")
    kind = kind_of(path)
    question = question_of(task_of_problem(kind, kind.load(path, None), DEFAULT), kind, RU)
    part = next(p for p in question.parts if p.entry.exact < 0 and p.entry.signed)
    [[back]] = read_quiz(moodle_xml([question], RU)).values()
    gap = back.gaps[question.parts.index(part)]
    assert gap.grade(part.entry.exact)[0] == 1.0 and gap.grade(-part.entry.exact)[0] == 0.0


@pytest.mark.parametrize(
    "text", ["a}b", "a#b", "a\\}b", "{1:NUMERICAL:=1}", "&#35; &amp; <b>", "\\#", "a\\"]
)
def test_any_text_of_feedback_is_read_back_unchanged(text: str) -> None:
    gaps, rest = gaps_of("x {1:NUMERICAL:=1:0.1#" + escaped(text) + "~%0%2:0.1#z} y")
    assert [c.feedback for c in gaps[0].choices] == [text, "z"] and rest == "x {#1} y"


def test_braces_of_a_title_open_no_gap() -> None:
    path = path_of("gears/gears-ex2")
    kind = kind_of(path)
    question = question_of(task_of_problem(kind, kind.load(path, None), DEFAULT), kind, RU)
    evil = replace(question, title="a/b {1:NUMERICAL:=5:1} ]]> <i>")
    [(category, [back])] = read_quiz(moodle_xml([evil], RU)).items()
    assert len(back.gaps) == len(question.parts) and back.name == evil.title
    assert category == "$course$/top/a//b {1:NUMERICAL:=5:1} ]]> <i>"


def test_wrong_intervals_do_not_overlap_each_other_or_the_right_one(
    whole: tuple[list[dict[str, Any]], list[Question]],
) -> None:
    for question in whole[1]:
        for gap in question.gaps:
            if gap.kind != "NUMERICAL":
                continue
            right = [c for c in gap.choices if c.fraction]
            wrong = sorted((c for c in gap.choices if not c.fraction), key=lambda c: c.value)
            for one, other in pairwise(wrong):
                room = one.margin + other.margin
                assert other.value - one.value >= room * (1 - 2 * FINE), (one, other)
            for one in wrong:
                for c in right:
                    room = (c.margin + one.margin) * (1 - 2 * FINE)
                    assert abs(one.value - c.value) >= room, (one, c)
                assert abs(one.value - right[0].value) >= 2 * right[0].margin * (1 - FINE), one


def test_the_scheme_and_the_data_do_not_show_the_answers() -> None:
    task = Variants(path_of("linkages/ex3")).task(None)
    letters = {item.text for item in assigned(task.solution).items if isinstance(item, Text)}
    assert "ω" in letters and "ε" not in letters
    assert [item.text for item in assigned(task.solution).items if isinstance(item, Text)].count(
        "ω"
    ) == 1
    path = path_of("gears/gears-ex2")
    kind = kind_of(path)
    facts = [fact.text for fact in kind.given_facts(kind.load(path, None), RU)]
    assert "z_{1} = 30" in facts
    assert [fact for fact in facts if fact.startswith("z_{3}")] == ["z_{3} — из соосности"]


def test_an_angle_is_right_a_whole_turn_off_and_mistakes_of_numbers_keep_their_signs(
    tmp_path: Path,
) -> None:
    head = path_of("linkages/ex3").read_text("utf-8").partition("[[answers]]")[0]
    path = tmp_path / "angle.toml"
    asked = '[[answers]]\nwhat = "v B3"\nsense = "angle"\n[[answers]]\nwhat = "vx B3"\n'
    path.write_text(head + asked, "utf-8")
    question = question_of(Variants(path).task(None), LINKAGES, RU)
    [[back]] = read_quiz(moodle_xml([question], RU)).values()
    [_, angle, across] = back.gaps
    value = question.parts[1].entry.exact
    assert [angle.grade(value + turn)[0] for turn in (0, 360, -360, 180)] == [1, 1, 1, 0]
    assert question.parts[2].entry.exact < 0
    assert any(c.value < 0 for c in across.choices if not c.fraction)
