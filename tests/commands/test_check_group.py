"""Command ``check`` of a group: a failure in one work, or one file, stops no other."""

from __future__ import annotations

import csv
import io
import json
import os
import signal
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from doors import check, check_files, check_group, check_submissions, cli, student_page, student_pdf
from worked import path_of

EX3 = str(path_of("linkages/ex3"))
GOOD = "student;what;value;unit\nПетров П.П.;v B;3,2;м/с\nПетров П.П.;v E;3,9;м/с\n"
THREE = "student;what;value;unit\n" + "".join(
    f"{name};v B;{value};м/с\n" for name, value in (("one", "3,2"), ("two", "3,2"), ("bad", "9"))
)


def run(*words: str) -> Result:
    return CliRunner().invoke(cli, ["--lang", "en", "check", *words])


def put(folder: Path, name: str, data: str | bytes) -> str:
    (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())
    return str(folder / name)


def record(out: Path) -> Any:
    return json.loads((out / "run.json").read_text("utf-8"))


def book(out: Path) -> dict[str, dict[str, str]]:
    rows = csv.DictReader(io.StringIO((out / "gradebook.csv").read_text("utf-8")))
    return {row["Student"]: row for row in rows}


def words_of(out: Path) -> bytes:
    """Return all that is in the files of a folder, archives and workbooks unpacked."""
    found = []
    for path in sorted(out.rglob("*")):
        found.append(str(path.relative_to(out)).encode())
        if path.suffix in (".xlsx", ".zip"):
            with zipfile.ZipFile(path) as archive:
                for name in archive.namelist():
                    found += [name.encode(), archive.read(name)]
        elif path.is_file():
            found.append(path.read_bytes())
    return b"\n".join(found)


# A fault in one work -------------------------------------------------------------------------


def failing(act: Callable[..., Any], how: Callable[[], None]) -> Callable[..., Any]:
    """Return a check that fails of the work of somebody."""

    def checked(task: Any, work: Any) -> Any:
        if work.student == "bad":
            how()
        return act(task, work)

    return checked


def raised() -> None:
    raise KeyError("asked124")


def killed() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.parametrize(("how", "jobs"), [(raised, "1"), (raised, "2"), (killed, "2")])
def test_an_internal_error_in_one_work_stops_no_other(
    how: Callable[[], None], jobs: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Before: exit code 5, and no mark of anybody."""
    own = tmp_path / "out"
    monkeypatch.setattr(check_group, "check", failing(check, how))
    path = put(tmp_path, "group.csv", THREE)
    result = run(EX3, path, "-o", str(own), "--jobs", jobs, "--gradebook")
    assert result.exit_code == 1, result.output
    assert "Not marked: bad: " in result.stderr and "Traceback" not in result.output
    marks = book(own)
    assert (marks["bad"]["Mark"], marks["bad"]["Grade of 100"]) == ("not marked", "")
    assert marks["bad"]["Feedback"].startswith("not marked: ")
    assert marks["one"]["Points"] == marks["two"]["Points"] == "1"
    assert {path.stem for path in (own / "pages").iterdir()} == {"one", "two"}
    (told,) = record(own)["failures"]
    assert told["student"] == "bad"
    if how is raised:
        assert "asked124" in told["why"] and 'File "planmethod/check/checking.py"' in told["trace"]
        told = run(EX3, path, "--json")
        assert told.exit_code == 1, (told.output, told.exception)
        (failure,) = [one["failure"] for one in json.loads(told.stdout) if one["failure"]]
        assert "Traceback" in failure["trace"]


def test_a_page_that_cannot_be_made_stops_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = check_files
    made = student_page

    def page(checked: Any, *args: Any, **more: Any) -> Any:
        if checked.work.student == "bad":
            raise ZeroDivisionError
        return made(checked, *args, **more)

    monkeypatch.setattr(files, "student_page", page)
    out = tmp_path / "out"
    result = run(EX3, put(tmp_path, "group.csv", THREE), "-o", str(out), "--gradebook")
    assert result.exit_code == 1 and "No page: bad: " in result.stderr
    assert book(out)["bad"]["Mark"] == "2" and [*record(out)["pages"]] == ["one", "two"]
    assert record(out)["failures"][0]["trace"].endswith("ZeroDivisionError\n")


def test_an_unsolvable_variant_costs_the_others_no_points(tmp_path: Path) -> None:
    text = Path(EX3).read_text("utf-8")
    problem = put(tmp_path, "ex3.toml", text + "\n[variants.1]\n[variants.2]\nlinks.1.OA = 9\n")
    rows = "student;variant;what;value;unit\none;1;v B;3,2;м/с\ntwo;2;v B;3,2;м/с\n"
    path = put(tmp_path, "group.csv", rows)
    result = run(problem, path, "-o", str(tmp_path / "out"), "--gradebook")
    assert result.exit_code == 1, result.output
    assert "Not marked: two: " in result.stderr
    assert book(tmp_path / "out")["one"]["Points"] == "1"
    assert record(tmp_path / "out")["failures"][0]["trace"] == ""
    alone = put(tmp_path, "alone.csv", "student;variant;what;value\ntwo;2;v B;3,2\n")
    assert run(problem, alone, "-o", str(tmp_path / "none")).exit_code in (3, 4)
    assert not (tmp_path / "none").exists()


# A file that cannot be read ------------------------------------------------------------------


def bad_files(folder: Path) -> list[str]:
    (folder / "works").mkdir()
    os.mkfifo(folder / "pipe.csv")
    return [
        put(folder, "truncated.json", '{"student": "a", "answers": ['),
        put(folder, "empty.json", ""),
        put(folder, "none.json", "[]"),
        put(folder, "broken.xlsx", b"PK\x03\x04 broken"),
        put(folder, "nul.csv", b"student;what;value\na;v B;3\0\n"),
        put(folder, "head.csv", "student;what;value\n"),
        put(folder, "no-lines.dxf", "0\nSECTION\n"),
        put(folder, "other.docx", b"PK"),
        str(folder / "works"),
        str(folder / "pipe.csv"),
        str(folder / "nobody.csv"),
    ]


def test_a_file_that_cannot_be_read_stops_no_other(tmp_path: Path) -> None:
    good, bad, out = put(tmp_path, "good.csv", GOOD), bad_files(tmp_path), tmp_path / "out"
    result = run(EX3, *bad[:5], good, *bad[5:], "-o", str(out), "--gradebook")
    assert result.exit_code == 1, result.output
    for path in bad:
        assert f"Error: {path}: " in result.stderr
    assert [*book(out)] == ["Петров П.П."] and book(out)["Петров П.П."]["Points"] == "2"
    assert [one["name"] for one in record(out)["unread"]] == [Path(path).name for path in bad]
    assert [one["name"] for one in record(out)["inputs"]] == ["ex3.toml", "good.csv"]


def test_if_no_file_can_be_read_no_file_is_written(tmp_path: Path) -> None:
    bad, out = bad_files(tmp_path), tmp_path / "out"
    result = run(EX3, *bad, "-o", str(out))
    assert result.exit_code == 2 and not out.exists()
    assert all(f"Error: {path}: " in result.stderr for path in bad)


def test_an_internal_error_in_a_file_stops_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    works = check_submissions
    read = works.read_works

    def faulty(path: Path) -> Any:
        if path.name == "bad.csv":
            raise IndexError("9")
        return read(path)

    monkeypatch.setattr(works, "read_works", faulty)
    paths, out = [put(tmp_path, name, GOOD) for name in ("bad.csv", "good.csv")], tmp_path / "out"
    result = run(EX3, *paths, "-o", str(out))
    assert result.exit_code == 1 and "bad.csv: an internal error" in result.stderr
    assert "IndexError: 9" in record(out)["unread"][0]["trace"]


def test_an_unreadable_work_of_a_list_stops_no_other(tmp_path: Path) -> None:
    answers = [{"what": "v B", "value": "3,2"}]
    works = [
        {"student": "one", "answers": answers},
        {"student": "two", "answers": "many"},
        7,
        {"student": "three", "schema": 9, "answers": []},
    ]
    path, out = put(tmp_path, "works.json", json.dumps(works)), tmp_path / "out"
    result = run(EX3, path, "-o", str(out), "--gradebook")
    assert result.exit_code == 1
    assert {name: row["Mark"] for name, row in book(out).items()} == {
        "one": "2", "two": "not marked", "works [2]": "not marked", "three": "not marked",
    }  # fmt: skip


# Unreadable entries --------------------------------------------------------------------------

ASKED = ("v B", "v B3", "v D", "v E", "omega 3", "a B", "a B3", "epsilon 3")


def table(written: str, right: int = 2) -> str:
    values = ("3,2", "2,24")
    rows = [f"s;{what};{values[n] if n < right else written}" for n, what in enumerate(ASKED)]
    return "\n".join(["student;what;value", *rows, ""])


def share(result: Result) -> float:
    (found,) = json.loads(result.stdout)
    return float(found["points"] / found["of"])


@pytest.mark.parametrize("written", ["x", "2 или 3", "1/2", "3,2 кг", "1,2·103", "=A1+"])
def test_an_unreadable_answer_never_raises_a_mark(written: str, tmp_path: Path) -> None:
    """Before: two right answers and 18 × "x" were 2 of 2, and the best mark."""
    path, blank = put(tmp_path, "x.csv", table(written)), put(tmp_path, "y.csv", table(""))
    result, other = run(EX3, path, "--json"), run(EX3, blank, "--json")
    assert result.exit_code == 1 and other.exit_code == 0
    assert share(result) == share(other)
    assert json.loads(result.stdout)[0]["provisional"] is True
    assert json.loads(other.stdout)[0]["provisional"] is False


def test_an_answer_beside_one_that_cannot_be_read_counts_once(tmp_path: Path) -> None:
    rows = table("", right=2) + "s;v B;x\ns;v E;x\ns;v E;y\n"
    (found,) = json.loads(run(EX3, put(tmp_path, "x.csv", rows), "--json").stdout)
    (blank,) = json.loads(run(EX3, put(tmp_path, "y.csv", table("")), "--json").stdout)
    assert (found["points"], found["of"]) == (blank["points"], blank["of"])


@pytest.mark.parametrize(
    "written",
    ["?", "-", "—", "...", "не решал", "Не решала", "нет ответа", "н/д", "n/a", "не знаю", "/"],
)
def test_an_entry_meaning_no_answer_is_blank(written: str, tmp_path: Path) -> None:
    result = run(EX3, put(tmp_path, "x.csv", table(written)), "--json")
    assert result.exit_code == 0, result.stderr
    (found,) = json.loads(result.stdout)
    assert not found["provisional"] and found["points"] == 2.0
    assert {one["verdict"] for one in found["answers"]} <= {"ok", "unseen", "blank"}


def test_a_mark_with_open_answers_is_provisional_until_the_instructor_has_looked(
    tmp_path: Path,
) -> None:
    path, out = put(tmp_path, "x.csv", table("x")), tmp_path / "out"
    first = run(EX3, path, "-o", str(out), "--gradebook")
    assert first.exit_code == 1
    assert "Provisional: s: mark 2" in first.stderr
    page = (out / "pages/s.html").read_text("utf-8")
    assert "Mark: 2 (provisional)" in page and "until then it counts as no answer" in page
    assert book(out)["s"]["Mark"] == "2 (provisional)"
    assert book(out)["s"]["Feedback"].startswith("provisional; answers that cannot be read")
    assert b"2 (provisional)" in words_of(out)
    with zipfile.ZipFile(out / "feedback.zip") as archive:
        assert "(provisional)" in archive.read("s/s.html").decode()
    by_hand = out / "overrides.csv"
    rows = by_hand.read_text("utf-8-sig").splitlines()
    assert rows[0] == "student;id;points;remark;of;written;where"
    assert rows[1] == "s;v_D;;;1;x;x.csv:4, value" and len(rows) == 7
    # Unchanged rows have no effect; filled in, they apply.
    again = run(EX3, path, "-o", str(out), "--gradebook")
    assert book(out)["s"]["Mark"] == "2 (provisional)" and again.stderr == first.stderr
    decided = [rows[0], *(row.replace(";;;", ";0,5;;") for row in rows[1:])]
    by_hand.write_text("\n".join(decided), "utf-8")
    last = run(EX3, path, "-o", str(out), "--gradebook")
    assert "Provisional" not in last.stderr and "Warning" not in last.stderr
    assert book(out)["s"]["Mark"] == "2" and book(out)["s"]["Points"] == "5"
    assert by_hand.read_text("utf-8") == "\n".join(decided)  # it is the instructor's now
    assert "The instructor has looked: 0.5 of 1 points." in (out / "pages/s.html").read_text()


def test_points_of_the_whole_work_decide_all_open_answers(tmp_path: Path) -> None:
    path = put(tmp_path, "x.csv", table("x"))
    hand = put(tmp_path, "hand.csv", "student;id;points\ns;;5\n")
    result = run(EX3, path, "--json", "--overrides", hand)
    assert not json.loads(result.stdout)[0]["provisional"] and "Provisional" not in result.stderr


def test_an_answer_given_twice_is_decided_once(tmp_path: Path) -> None:
    path = put(tmp_path, "x.csv", "student;what;value\ns;v B;9\ns;v B;8\n")
    hand = put(tmp_path, "hand.csv", "student;id;points\ns;v_B;1\n")
    result = run(EX3, path, "--json", "--overrides", hand)
    (found,) = json.loads(result.stdout)
    assert found["points"] == 1.0 and not found["provisional"]


def test_rows_for_open_answers_go_into_a_file_of_the_instructors_without_harm(
    tmp_path: Path,
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    mine = "id,student,points,remark\nv_B,s,1,списано\n"
    put(out, "overrides.csv", mine.encode("cp1251"))
    path = put(tmp_path, "x.csv", table("x"))
    for _ in range(2):
        assert run(EX3, path, "-o", str(out)).exit_code == 1
        lines = (out / "overrides.csv").read_text("utf-8-sig").splitlines()
        assert lines[:2] == mine.splitlines() and lines[2] == "v_D,s,," and len(lines) == 8


# The right values ----------------------------------------------------------------------------

WORK = {
    "student": "s",
    "answers": [
        {"what": "v B3", "value": 2.65},
        {"what": "v B", "value": 3.27},
        {"what": "omega 3", "value": 15.5, "sense": "cw"},
        {"what": "v E", "value": 3.9},
        {"what": "epsilon 3", "value": 99},
    ],
}


@pytest.mark.parametrize(
    ("values", "written", "shown"),
    [
        ("", None, True), ("", "x", False), ("always", "x", True), ("decided", None, True),
        ("decided", "x", False), ("never", None, False), ("never", "x", False),
    ],
)  # fmt: skip
def test_right_values_are_on_a_page_if_the_settings_allow_it(
    values: str, written: str | None, shown: bool, tmp_path: Path
) -> None:
    answers = [*WORK["answers"], {"what": "v D", "value": written}]
    path = put(tmp_path, "s.json", json.dumps({**WORK, "answers": answers}))
    rules = put(tmp_path, "rules.toml", f'values = "{values}"\n' if values else "")
    out = tmp_path / "out"
    run(EX3, path, "-o", str(out), "--settings", rules)
    page = (out / "pages/s.html").read_text("utf-8")
    rights = ("±", "<svg", "right is", "Right", "2.24", "44.9", "should be")
    assert [word in page for word in rights] == [shown] * len(rights)
    hand = put(tmp_path, "hand.csv", "student;id;points\ns;v_D;1\n")
    run(EX3, path, "-o", str(out), "--settings", rules, "--overrides", hand)
    decided = values != "never"
    assert ("±" in (out / "pages/s.html").read_text("utf-8")) is decided


# The folder of a run -------------------------------------------------------------------------


def test_hidden_names_are_nowhere_in_a_reused_folder(tmp_path: Path) -> None:
    path = put(tmp_path, "Иванов.csv", table("x").replace("s;", "Иванов П.;") + "Петров;v B;3\n")
    out = tmp_path / "out"
    assert run(EX3, path, "-o", str(out), "--gradebook").exit_code == 1
    assert "Иванов".encode() in words_of(out) and "Петров".encode() in words_of(out)
    result = run(EX3, path, "-o", str(out), "--anonymize", "--salt", "w")
    assert result.exit_code == 1
    there = words_of(out)
    assert "Иванов".encode() not in there and "Петров".encode() not in there
    assert not (out / "gradebook.csv").exists() and not (out / "feedback.zip").exists()
    assert len([*(out / "pages").iterdir()]) == 4
    # The present rows of overrides apply, too, and name no student.
    by_hand = out / "overrides.csv"
    by_hand.write_text(by_hand.read_text("utf-8-sig").replace(";;;", ";1;;"), "utf-8")
    assert "Provisional" not in run(EX3, path, "-o", str(out), "--anonymize", "--salt", "w").stderr
    assert "Иванов" not in run(EX3, path, "--json", "--anonymize").stdout


def test_names_are_not_hidden_beside_a_file_of_the_instructors_that_has_them(
    tmp_path: Path,
) -> None:
    path, out = put(tmp_path, "g.csv", GOOD), tmp_path / "out"
    run(EX3, path, "-o", str(out))
    mine = "student;id;points;remark\nПетров П.П.;v_B;0;\n"
    put(out, "overrides.csv", mine)
    before = words_of(out)
    result = run(EX3, path, "-o", str(out), "--anonymize")
    assert result.exit_code == 2 and "overrides.csv names 1 student," in result.output
    assert words_of(out) == before
    moved = str((out / "overrides.csv").rename(tmp_path / "mine.csv"))
    result = run(EX3, path, "-o", str(out), "--anonymize", "--overrides", moved)
    assert result.exit_code == 0 and "Петров".encode() not in words_of(out)


def test_a_run_removes_only_files_that_it_wrote(tmp_path: Path) -> None:
    out = tmp_path / "out"
    three, good = put(tmp_path, "three.csv", THREE), put(tmp_path, "good.csv", GOOD)
    run(EX3, three, "-o", str(out), "--gradebook")
    put(out, "notes.txt", "mine")
    put(out / "pages", "mine.html", "mine")
    put(out / "pages", "two.html", "changed")
    result = run(EX3, good, "-o", str(out))
    assert result.exit_code == 0 and f"{Path('pages') / 'two.html'} was changed" in result.stderr
    there = {path.relative_to(out).as_posix() for path in out.rglob("*") if path.is_file()}
    assert there == {
        "results.csv", "results.xlsx", "run.json", "overrides.csv", "notes.txt",
        "pages/mine.html", "pages/two.html", "pages/Петров-П.П.html", "pages/Петров-П.П.pdf",
    }  # fmt: skip


def test_a_stopped_run_owns_the_files_that_it_wrote(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files, out = check_files, tmp_path / "out"
    path = put(tmp_path, "three.csv", THREE)

    def stopped(*_: Any, **__: Any) -> bytes:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        pdf, count = student_pdf, [0]

        def second(*args: Any) -> bytes:
            count[0] += 1
            return stopped() if count[0] == 2 else pdf(*args)

        patch.setattr(files, "student_pdf", second)
        run(EX3, path, "-o", str(out))
    put(out / "pages", ".planmethod-0a1b2c3d4e5f.tmp", "two")
    assert (out / "pages/one.html").exists() and not (out / "pages/bad.html").exists()
    run(EX3, path, "-o", str(out), "--anonymize")
    assert all(page.stem.startswith("s-") for page in (out / "pages").iterdir())


@pytest.mark.parametrize("name", ["../kept", "/tmp/kept", "pages/../../kept", "a/b/c", "run.json"])
def test_a_forged_record_removes_no_file_elsewhere(name: str, tmp_path: Path) -> None:
    out, kept = tmp_path / "out", put(tmp_path, "kept", "mine")
    out.mkdir()
    put(out, "run.json", json.dumps({"files": {name: None, "overrides.csv": None}}))
    put(out, "overrides.csv", "student;id;points\n")
    assert run(EX3, put(tmp_path, "good.csv", GOOD), "-o", str(out)).exit_code == 0
    assert Path(kept).read_text() == "mine"
    assert (out / "overrides.csv").read_text() == "student;id;points\n"
    assert record(out)["works"] == 1


@pytest.mark.parametrize("text", ["", "[]", '{"files": 3}', '{"files": {"a": {}}}', "[" * 9999])
def test_no_record_stops_a_run(text: str, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    put(out, "run.json", text)
    assert run(EX3, put(tmp_path, "good.csv", GOOD), "-o", str(out)).exit_code == 0
