"""Command ``check``: one student, a group, the key; its output, files and exit codes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from doors import cli
from worked import path_of

EX3 = str(path_of("linkages/ex3"))
TASK12 = str(path_of("levers/task12"))
VARIANTS = str(path_of("levers/task12-variants"))

WORK: dict[str, Any] = {
    "schema": 1,
    "student": "s02",
    "problem": "ex3",
    "variant": None,
    "scales": {"mu_l": 0.002, "mu_v": 0.05, "mu_a": 1.0},
    "ruler_mm": 0.5,
    "answers": [
        {"id": "v_B3", "what": "v B3", "value": 2.25, "unit": "m/s", "mm": 45.0, "segment": "p b3"},
        {"what": "omega 3", "value": 15.5, "unit": "1/s", "sense": "ccw"},
        {"id": "v_B3/2", "value": 2.275},
    ],
}
KEYS = {
    "id",
    "verdict",
    "from",
    "value",
    "exact",
    "tolerance",
    "mm",
    "exact_mm",
    "points",
    "where",
}


def run(*words: str) -> Result:
    return CliRunner().invoke(cli, ["check", *words])


def written(folder: Path, work: object, name: str = "work.json") -> str:
    path = folder / name
    path.write_text(work if isinstance(work, str) else json.dumps(work), encoding="utf-8")
    return str(path)


def told(result: Result) -> Any:
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


def test_one_student_is_a_list_of_one_object_of_the_contract(tmp_path: Path) -> None:
    (found,) = told(run(EX3, written(tmp_path, WORK), "--json"))
    assert {"student", "variant", "answers", "diagnosis", "points", "of"} <= set(found)
    assert (found["student"], found["variant"], found["diagnosis"]) == ("s02", None, [])
    for answer in found["answers"]:
        assert set(answer) >= KEYS
    by_id = {answer["id"]: answer for answer in found["answers"]}
    for name in ("v_B3", "omega_3", "v_B3/2"):
        assert by_id[name]["verdict"] == "ok"
        assert abs(by_id[name]["value"] - by_id[name]["exact"]) <= by_id[name]["tolerance"]
    assert by_id["v_B3"]["mm"] == 45.0
    assert by_id["v_B3"]["exact_mm"] == pytest.approx(44.868197)
    assert by_id["v_E"]["verdict"] == "blank"  # an answer is required
    assert found["points"] == 3.0


def test_a_group_is_a_list_and_each_student_has_a_variant_and_scales(tmp_path: Path) -> None:
    rows = [
        "студент;вариант;величина;значение;ед.;мм;направление",
        "Иванов;А;mu_v;0,02;;;",
        "Иванов;А;v D;0,74;м/с;;",
        "Петров;Е;omega 3;2,4;1/с;;против часовой",
        "=Сидоров;Щ;v D;1;м/с;;",
    ]
    path = tmp_path / "group.csv"
    path.write_bytes("\n".join(rows).encode("cp1251"))
    result = run(VARIANTS, str(path), "--json")
    assert result.exit_code == 1  # there is no variant Щ
    found = json.loads(result.stdout)
    assert [one["student"] for one in found] == ["Иванов", "Петров", "=Сидоров"]
    assert [one["variant"] for one in found] == ["А", "Е", "Щ"]
    assert found[2]["answers"][0]["verdict"] == "unreadable"
    assert "group.csv:5" in result.stderr


def test_files_of_a_group_and_grading_again_give_the_same_bytes(tmp_path: Path) -> None:
    work = written(tmp_path, {**WORK, "student": "=HYPERLINK(1)"})
    out = tmp_path / "out"
    assert run(EX3, work, "-o", str(out)).exit_code == 0
    files = {path: path.read_bytes() for path in sorted(out.rglob("*")) if path.is_file()}
    names = [path.relative_to(out).as_posix() for path in files]
    assert {"results.xlsx", "results.csv", "run.json", "overrides.csv"} <= set(names)
    assert [name for name in names if name.startswith("pages/")] == [
        "pages/HYPERLINK-1.html",
        "pages/HYPERLINK-1.pdf",
    ]
    assert run(EX3, work, "-o", str(out)).exit_code == 0
    assert {path: path.read_bytes() for path in files} == files


def test_marks_set_by_hand_survive(tmp_path: Path) -> None:
    work = written(tmp_path, WORK)
    override = "student;id;points;remark\ns02;v_E;1;показано у доски\ns99;;5;\n"
    path = written(tmp_path, override, "overrides.csv")
    result = run(EX3, work, "--json", "--overrides", path)
    (found,) = told(result)
    assert found["points"] == 4.0
    assert "overrides.csv:3" in result.stderr.replace(", row ", ":")


@pytest.mark.usefixtures("russian")
def test_the_key_is_printed_and_written_for_every_variant(tmp_path: Path) -> None:
    result = run("--key", VARIANTS, EX3, "-o", str(tmp_path))
    assert result.exit_code == 0, result.output
    assert {path.name for path in tmp_path.iterdir()} == {
        "task12-variants-key.pdf",
        "task12-variants-key.xlsx",
        "ex3-key.pdf",
        "ex3-key.xlsx",
    }
    assert "44,9" in result.stdout


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        ((EX3,), 2, "name a WORK"),
        ((EX3, "nobody.json"), 2, "nobody.json"),
        (("nobody.toml", "WORK"), 2, ""),
        ((EX3, "WORK", "--all-variants"), 2, "--key"),
        ((EX3, "BAD"), 2, "bad.json"),
        ((EX3, "WORK", "--settings", "nobody.toml"), 2, "nobody.toml"),
        (("--key", "nobody.toml"), 3, "nobody.toml"),
    ],
)
def test_an_impossible_request_gives_one_message(
    words: tuple[str, ...], code: int, said: str, tmp_path: Path
) -> None:
    paths = {"WORK": written(tmp_path, WORK), "BAD": written(tmp_path, "{", "bad.json")}
    result = run(*(paths.get(word, word) for word in words), "-o", str(tmp_path / "out"))
    assert result.exit_code in ({code, 3} if words[0] == "nobody.toml" else {code}), result.output
    assert said in result.output
    assert "Traceback" not in result.output
    assert not (tmp_path / "out").exists()


def test_another_problem_is_warned_of_and_an_unknown_quantity_is_unreadable(tmp_path: Path) -> None:
    work = {
        **WORK,
        "problem": "ex1",
        "answers": [{"what": "v Q", "value": 1}, {"id": "zz", "mm": 3}],
    }
    result = run(TASK12, written(tmp_path, work), "--json")
    assert result.exit_code == 1
    assert "ex1" in result.stderr
    (found,) = json.loads(result.stdout)
    assert [a["verdict"] for a in found["answers"][:2]] == ["unreadable"] * 2
    assert {a["verdict"] for a in found["answers"][2:]} == {"blank"}


def test_several_processes_give_the_same(tmp_path: Path) -> None:
    rows = ["student;what;value"]
    rows += [
        f"s{n};{what};{value * (1 + n / 50)}"
        for n in range(6)
        for what, value in (("v D", 0.589), ("omega 3", 2.356), ("a D", 10.26))
    ]
    path = written(tmp_path, "\n".join(rows), "group.csv")
    assert told(run(TASK12, path, "--json")) == told(run(TASK12, path, "--json", "--jobs", "2"))


def test_an_unreadable_table_is_reported_with_its_columns(tmp_path: Path) -> None:
    """Before: exit code 0, and two pages of blanks."""
    path = written(tmp_path, "Студент;Скорость;Ускорение\nИ;3,2;160\n", "group.csv")
    result = run(EX3, path, "-o", str(tmp_path / "out"))
    assert result.exit_code == 1
    assert "Скорость, Ускорение" in result.stderr


def test_one_work_and_many_are_lists(tmp_path: Path) -> None:
    one = written(tmp_path, WORK)
    two = written(tmp_path, {**WORK, "student": "s03"}, "two.json")
    assert [w["student"] for w in told(run(EX3, one, "--json"))] == ["s02"]
    assert [w["student"] for w in told(run(EX3, one, two, "--json"))] == ["s02", "s03"]
