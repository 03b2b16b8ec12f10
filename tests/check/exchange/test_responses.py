"""Exports of a learning management system, and the files returned to it."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from zipfile import ZipFile

import pytest
from click.testing import CliRunner, Result
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    GradedSubmission,
    Sense,
    Submission,
    SubmissionsSubmissionError as SubmissionError,
    Variants,
    cli,
    feedback_zip,
    gaps_of,
    get_language,
    gradebook_csv,
    is_export,
    read_columns,
    read_responses,
)
from worked import path_of

EX3 = path_of("linkages/ex3-variants")
MOODLE = {
    "ru": [
        "Фамилия",
        "Имя",
        "Адрес электронной почты",
        "Состояние",
        "Оценка/10,00",
        "Вопрос 1",
        "Ответ 1",
    ],
    "en": [
        "Last name",
        "First name",
        "Email address",
        "Status",
        "Grade/10.00",
        "Question 1",
        "Response 1",
    ],
}
PART = {"ru": "часть", "en": "part"}


def written(path: Path, rows: Sequence[Sequence[str]], delimiter: str = ",") -> Path:
    with path.open("w", encoding="utf-8-sig", newline="") as file:
        csv.writer(file, delimiter=delimiter).writerows(rows)
    return path


def run(*words: object, lang: str = "ru") -> Result:
    return CliRunner().invoke(cli, ["--lang", lang, "check", *(str(word) for word in words)])


def told(answers: Mapping[int, str], count: int, part: str) -> str:
    return "; ".join(f"{part} {n}: {answers.get(n, '')}" for n in range(1, count + 1))


def exact(variant: str, lang: str) -> str:
    """The right answers of a variant in one cell, as Moodle puts them together."""
    task = Variants(EX3).task(variant)
    items = {(item.name, item.position): item for item in task.list_items()}
    answers = {}
    for number, gap in enumerate(gaps_of(task), 1):
        value = task.sheet(0).exact_answers[items[gap.id, gap.position].question.id]
        senses = get_language(lang).check["senses"]
        turned = " ".join(senses["ccw" if value > 0 else "cw"])
        answers[number] = turned if gap.sense else f"{abs(value):.4g}".replace(".", ",")
    return told(answers, len(answers), PART[lang])


@pytest.mark.parametrize("lang", LANGUAGES)
def test_an_export_of_moodle_is_read_with_its_variants_and_judged(
    tmp_path: Path, lang: str
) -> None:
    word = get_language(lang).check["key"].variant
    rows = [
        MOODLE[lang],
        [
            "Иванов",
            "Иван",
            "i@x.ru",
            "",
            "9,00",
            f"Механизм. {word.format(variant=3)} Дано",
            exact("3", lang),
        ],
        [
            "Петров",
            "Пётр",
            "p@x.ru",
            "",
            "1,00",
            f"Механизм. {word.format(variant=1)} Дано",
            exact("3", lang),
        ],
        ["Иванов", "Иван", "j@x.ru", "", "0,00", f"Механизм. {word.format(variant=2)} Дано", "-"],
        ["Среднее", "", "", "", "5,00", "", ""],
    ]
    path = written(tmp_path / "responses.csv", rows)
    assert is_export(path)
    done = run(EX3, path, "--json")
    assert done.exit_code == 0, done.output
    works = json.loads(done.stdout)
    assert [(w["student"], w["variant"]) for w in works] == [
        ("Иванов Иван", "3"), ("Петров Пётр", "1"), ("Иванов Иван (j@x.ru)", "2"),
    ]  # fmt: skip
    assert works[0]["points"] == works[0]["of"] == 19.0, "every gap is read, to the last"
    assert works[1]["points"] < 10 and works[2]["points"] == 0


def test_a_later_attempt_counts(tmp_path: Path) -> None:
    row = ["Иванов", "Иван", "i@x.ru", "", "", "Вариант 3"]
    path = written(
        tmp_path / "r.csv",
        [MOODLE["ru"], [*row, told({1: "1"}, 3, "часть")], [*row, told({1: "2,5"}, 3, "часть")]],
    )
    [work] = read_responses(
        path, {}, ("3",), lambda _: gaps_of(Variants(EX3).task("3"))
    ).submissions
    assert [a.value for a in work.answers if a.value is not None] == [2.5]


def test_columns_follow_the_map(tmp_path: Path) -> None:
    rows = [
        ["Фамилия", "Имя", "Вар", "Ответ 1", "Ответ 2", "Куда"],
        ["Сидорова", "Анна", "2", "244,2", "15,37", "против часовой стрелки"],
    ]
    path = written(tmp_path / "g.csv", rows, ";")
    pairs = ["Вар=variant", "Ответ 1=v_B3, см/с", "Ответ 2=omega_3", "Куда=omega_3 направление"]
    toml = tmp_path / "map.toml"
    toml.write_text("\n".join(f'"{p.split("=")[0]}" = "{p.split("=")[1]}"' for p in pairs), "utf-8")
    for columns in (pairs, [str(toml)]):
        found = read_responses(path, read_columns(columns), ("1", "2"), lambda _: [])
        [work] = found.submissions
        assert (work.student, work.variant, found.addresses) == ("Сидорова Анна", "2", {})
        [v, omega] = work.answers
        assert v.value == pytest.approx(2.442) and (omega.value, omega.sense) == (15.37, Sense.CCW)
    done = run(EX3, path, *(f"--columns={pair}" for pair in pairs), "-o", tmp_path / "out")
    assert done.exit_code == 0, done.output
    assert (tmp_path / "out" / "gradebook.csv").is_file()


def test_a_column_for_each_gap_needs_no_map(tmp_path: Path) -> None:
    train = path_of("gears/gears-ex2")
    gaps = gaps_of(Variants(train).task(None))
    heads = ["Фамилия", *(f"Ответ {n}" for n in range(1, len(gaps) + 1))]
    path = written(tmp_path / "t.csv", [heads, ["Ли", *("1" for _ in gaps)]])
    [work] = read_responses(path, {}, (), lambda _: gaps).submissions
    assert [answer.id for answer in work.answers] == [gap.id for gap in gaps]


@pytest.mark.parametrize("lang", LANGUAGES)
def test_an_export_that_cannot_be_understood_is_reported_in_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, lang: str
) -> None:
    two = written(tmp_path / "two.csv", [["Фамилия", "Ответ 1", "Ответ 2"], ["Ли", "1", "2"]])
    none = written(tmp_path / "none.csv", [["Фамилия", "v_B3"], ["Ли", "1"]])
    bad = tmp_path / "bad.toml"
    bad.write_text('"Ответ 1" = 1', "utf-8")
    cases = (
        ((EX3, two), "2"),
        ((EX3, two, "--columns", "Ответ 7=v_B3"), "Ответ 7"),
        ((EX3, none, "--columns", "Ответ 1=v_B3"), "v_B3"),
        ((EX3, two, "--columns", "Ответ 1=чушь"), "чушь"),
        ((EX3, two, "--columns", bad), "Ответ 1"),
        ((EX3, two, "--columns", tmp_path / "absent.toml"), "absent"),
        ((EX3, two, "--moodle", tmp_path / "x.xml"), "--moodle"),
    )
    for words, said in cases:
        done = run(*words, lang=lang)
        assert done.exit_code == 2, (words, done.output)
        assert said in done.output and "Traceback" not in done.output


def test_the_gradebook_has_points_of_a_hundred_and_no_formulas() -> None:
    works = [
        GradedSubmission(Submission("=cmd()", ()), "1", (), points=9.5, of=19.0, remark="+1"),
        GradedSubmission(Submission("Ли", ()), None, (), points=0.0, of=0.0),
    ]
    text = gradebook_csv(works, ["3", ""], {"Ли": "li@x.ru"}, get_language("ru")).decode()
    rows = list(csv.DictReader(io.StringIO(text)))
    assert [row["Студент"] for row in rows] == ["'=cmd()", "Ли"]
    assert [row["Оценка из 100"] for row in rows] == ["50.00", ""]
    assert [row["Адрес электронной почты"] for row in rows] == ["", "li@x.ru"]
    assert rows[0]["Отзыв"] == "'+1" and (rows[0]["Баллы"], rows[0]["из"]) == ("9.5", "19")
    assert "почты" not in gradebook_csv(works, ["3", ""], {}, get_language("ru")).decode()


def test_pages_are_zipped_by_student_and_names_are_hidden_on_request(tmp_path: Path) -> None:
    rows = [MOODLE["ru"], ["Ли", "Анна", "li@x.ru", "", "", "Вариант 3", exact("3", "ru")]]
    path = written(tmp_path / "r.csv", rows)
    for extra in ((), ("--anonymize", "--salt", "x")):
        out = tmp_path / f"out{len(extra)}"
        done = run(EX3, path, "-o", out, *extra)
        assert done.exit_code == 0, done.output
        names = ZipFile(out / "feedback.zip").namelist()
        grades = (out / "gradebook.csv").read_text("utf-8")
        assert len(names) == 2 and {Path(name).suffix for name in names} == {".html", ".pdf"}
        assert all(name.startswith("Ли-Анна/Ли-Анна.") for name in names) is not bool(extra)
        assert ("li@x.ru" in grades, "Ли" in grades) == (not extra, not extra)
        again = feedback_zip([], [])
        assert ZipFile(io.BytesIO(again)).namelist() == []


def test_other_groups_have_a_gradebook_on_request(tmp_path: Path) -> None:
    group = tmp_path / "ex3.csv"
    lines = (EX3.parent.parent / "groups" / "ex3.csv").read_text("utf-8-sig").splitlines()
    group.write_text("\n".join(lines[:60]), "utf-8")  # of the first three students
    assert not is_export(group)
    assert run(EX3, group, "-o", tmp_path / "a").exit_code == 0
    assert not (tmp_path / "a" / "gradebook.csv").exists()
    assert run(EX3, group, "-o", tmp_path / "b", "--gradebook").exit_code == 0
    grades = (tmp_path / "b" / "gradebook.csv").read_text("utf-8")
    answers = (tmp_path / "b" / "results.csv").read_text("utf-8-sig")
    rows = list(csv.DictReader(io.StringIO(grades)))
    results = list(csv.DictReader(io.StringIO(answers), delimiter=";"))
    assert [row["Студент"] for row in rows] == list(
        dict.fromkeys(row["student"] for row in results)
    )


def test_a_gap_without_a_question_is_skipped(tmp_path: Path) -> None:
    path = written(tmp_path / "r.csv", [["Фамилия", "Ответ 1"], ["Ли", "часть 1: 3; часть 99: 5"]])
    [work] = read_responses(path, {}, (), lambda _: gaps_of(Variants(EX3).task("1"))).submissions
    assert [answer.value for answer in work.answers] == [3.0]
    with pytest.raises(SubmissionError):
        read_columns([str(tmp_path / "gone.toml")])


def test_a_variant_is_not_taken_for_one_with_the_same_beginning_of_its_name(tmp_path: Path) -> None:
    texts = (
        "Вариант 12 Дано",
        "Вариант 1 Дано",
        "Вариант 1.",
        "Вариант 123 Дано",
        "Variant 12",
        "Вариант 1-а",
    )
    rows = [["Ли", f"{n}@x.ru", text, "часть 1: 3"] for n, text in enumerate(texts)]
    path = written(tmp_path / "r.csv", [["Фамилия", "Email address", "Вопрос 1", "Ответ 1"], *rows])
    found = read_responses(path, {}, ("1", "12", "1-а"), lambda _: gaps_of(Variants(EX3).task("1")))
    assert [work.variant for work in found.submissions] == ["12", "1", "1", None, "12", "1-а"]
    assert len({work.student for work in found.submissions}) == 6
