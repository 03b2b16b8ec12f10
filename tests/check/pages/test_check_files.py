"""Files of a checked group: overrides, hidden names, names of files, the record of the run."""

from __future__ import annotations

import contextlib
import json
from pathlib import Path

import ex3_work
import pytest
from doors import (
    GradedSubmission,
    GradingRun,
    Key,
    OverridesError,
    PlanMethodError,
    Settings,
    anonymous,
    apply_overrides,
    file_names,
    hidden_name,
    read_overrides,
    run_record,
    settings_rows,
    write_all,
)
from hypothesis import given, strategies as st
from worked import path_of, problem_of

HEAD = "student;id;points;remark\n"


def written(out: Path, checked: list[GradedSubmission], lang: str = "ru") -> dict[str, bytes]:
    key = Key(problem_of("linkages/ex3"), None, ex3_work.entries(), ex3_work.SCALES, {})
    files = write_all(
        out, checked, {None: key}, GradingRun(Settings(), [path_of("linkages/ex3")], lang)
    )
    return {str(path.relative_to(out)): path.read_bytes() for path in files.paths}


def test_grading_again_gives_the_same_bytes(tmp_path: Path) -> None:
    works = [ex3_work.work("s01"), ex3_work.work("Иванов Пётр")]
    first = written(tmp_path / "a", works)
    assert set(first) == {
        "results.xlsx", "results.csv", "run.json", "group.html", "overrides.csv",
        "pages/s01.html", "pages/s01.pdf", "pages/Иванов-Пётр.html", "pages/Иванов-Пётр.pdf",
    }  # fmt: skip
    assert written(tmp_path / "b", works) == first
    assert written(tmp_path / "a", works) == first
    run = json.loads(first["run.json"])
    assert run["settings"]["policy"] == "construction" and len(run["inputs"][0]["sha256"]) == 64


def test_overrides_of_the_instructor_are_left_alone(tmp_path: Path) -> None:
    mine = (HEAD + "s01;a_B3;1;списано с доски\n").encode()
    (tmp_path / "overrides.csv").write_bytes(mine)
    written(tmp_path, [ex3_work.work("s01")])
    assert (tmp_path / "overrides.csv").read_bytes() == mine


def read(
    tmp_path: Path, text: str, encoding: str = "utf-8-sig"
) -> tuple[GradedSubmission, tuple[str, ...]]:
    path = tmp_path / "overrides.csv"
    path.write_bytes(text.encode(encoding))
    works, unused = apply_overrides([ex3_work.work("s01")], read_overrides(path))
    return works[0], unused


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1251"])
def test_points_and_remarks_by_hand_are_taken(tmp_path: Path, encoding: str) -> None:
    checked, unused = read(tmp_path, HEAD + "s01;a_B3;0,5;чертёж верный\nnobody;;3;\n", encoding)
    judged = next(j for j in checked.answers if j.id == "a_B3")
    assert (judged.points, judged.remark, judged.is_manual) == (0.5, "чертёж верный", True)
    assert checked.points == pytest.approx(8.5) and unused == ("overrides.csv:3",)


def test_points_of_a_whole_work_count_last(tmp_path: Path) -> None:
    checked, _ = read(tmp_path, "student,id,points,remark\ns01,,3,поздно сдано\ns01,a_B3,1,\n")
    assert (checked.points, checked.remark, checked.is_manual) == (3.0, "поздно сдано", True)


def test_a_remark_alone_leaves_the_points(tmp_path: Path) -> None:
    checked, _ = read(tmp_path, HEAD + "s01;;;молодец\n")
    assert (checked.points, checked.is_manual) == (8.0, False)


@pytest.mark.parametrize(
    "text",
    [
        "a;b\n1;2\n",
        HEAD + "s01;;много;\n",
        HEAD + ";;1;\n",
        HEAD + "s01;;-1;\n",
        HEAD + "s01;;nan;\n",
    ],
)
def test_a_faulty_file_of_overrides_is_reported_with_its_row(tmp_path: Path, text: str) -> None:
    with pytest.raises(OverridesError, match=r"overrides\.csv"):
        read(tmp_path, text)


@given(st.binary(max_size=300))
def test_no_bytes_of_an_overrides_file_break_anything(
    tmp_path_factory: pytest.TempPathFactory, data: bytes
) -> None:
    path = tmp_path_factory.getbasetemp() / "overrides.csv"
    path.write_bytes(data)
    with contextlib.suppress(PlanMethodError):
        apply_overrides([ex3_work.work("s01")], read_overrides(path))


def test_a_missing_file_of_overrides_means_no_overrides(tmp_path: Path) -> None:
    assert read_overrides(tmp_path / "absent.csv") == ()
    with pytest.raises(OverridesError):
        read_overrides(tmp_path)


def test_hidden_names_are_nowhere(tmp_path: Path) -> None:
    works = anonymous([ex3_work.work("Иванов Пётр")], "salt")
    files = written(tmp_path, works)
    stem = hidden_name("Иванов Пётр", "salt")
    assert f"pages/{stem}.html" in files and hidden_name("Иванов Пётр", "other") != stem
    for data in files.values():
        assert "Иванов".encode() not in data
    assert works[0].answers[0].location == f"{stem}.json"


def test_files_of_works_are_named_by_number_if_names_are_hidden(tmp_path: Path) -> None:
    (tmp_path / "13-Иванов-Пётр.json").write_bytes(b"[]")
    inputs = [path_of("linkages/ex3"), tmp_path / "13-Иванов-Пётр.json"]
    names = [
        run_record(GradingRun(Settings(), inputs, "ru", hidden), 1) for hidden in (False, True)
    ]
    shown, told = ([one["name"] for one in record["inputs"]] for record in names)
    assert (shown[1], told) == ("13-Иванов-Пётр.json", ["ex3.toml", "works-1.json"])
    assert "works-1.json" in settings_rows(names[1])


@given(st.lists(st.text(max_size=60), max_size=8))
def test_names_of_files_are_safe_and_differ(students: list[str]) -> None:
    names = file_names(students)
    assert len({name.casefold() for name in names}) == len(students)
    for name in names:
        assert name not in (".", "..") and not set(name) & set('/\\:*?"<>|\0\n')
        assert Path("pages", f"{name}.html").parent == Path("pages")
        assert len(f"{name}.html".encode()) < 255 and name.strip(" .") == name


@pytest.mark.parametrize("student", ["con", "NUL", "com1.txt", "../../etc/passwd", "", "..", "a/b"])
def test_reserved_names_and_paths_do_no_harm(student: str) -> None:
    (name,) = file_names([student])
    assert name.split(".")[0].lower() not in ("con", "nul", "com1") and "/" not in name and name
