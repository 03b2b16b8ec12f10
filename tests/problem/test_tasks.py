"""The shipped tasks: index, texts to start from, and that each is solved and drawn."""

from __future__ import annotations

import json
import re
from functools import partial
from pathlib import Path

import pytest
from cases import each, sampled, some, thinned
from click.testing import CliRunner, Result
from doors import (
    LANGUAGES_LANGUAGES as LANGUAGES,
    LINKAGE,
    Faults,
    FileNode,
    ProblemProblem as Problem,
    Severity,
    ShippedTask,
    Solution,
    Text,
    apply_variant,
    cli,
    controlled_kinematics,
    get_language,
    groups_of,
    home,
    kinds_load as load,
    kinematics_sheets,
    parse_quantity,
    read_variants,
    source_parse as parse,
    statics_of,
    tasks,
    text_for,
    variant_names,
    verify,
)
from worked import ROOT, every_task

from benchmarks.tasks import document, index, index_text

TASKS = {task.name: task for task in tasks()}


def run(*words: str) -> Result:
    return CliRunner().invoke(cli, list(words))


def test_the_index_and_the_documents_are_those_of_the_files() -> None:
    """``make tasks`` rewrites them; the pictures are compared with --thorough."""
    fresh = index()
    assert index_text(fresh) == (home() / "index.json").read_text("utf-8")
    told = (ROOT / "docs" / "reference" / "tasks.md").read_text("utf-8")
    for task in fresh:
        assert f"[{task.name}](../../problems/{task.file})" in told
    drawn = {f"{task.structure}.svg" for task in fresh if task.kind == LINKAGE}
    assert {path.name for path in (ROOT / "docs" / "reference" / "tasks").iterdir()} == drawn
    if some(1, few=0):
        for path, data in document(fresh).items():
            assert (ROOT / path).read_bytes() == data


@each("task", [task for task in TASKS.values() if task.variants])
def test_a_variant_is_written_into_the_text(task: ShippedTask) -> None:
    table = parse(task.text, name=task.file)
    overrides = read_variants(FileNode(Faults(), table))
    for variant in thinned(task.variants, 3):
        text = text_for(task, variant)
        due = apply_variant(table, overrides[variant])
        made = {**parse(text, name=task.file)}
        for written in (due, made):
            written.pop("variants", None)
            written.pop("published", None)
        assert made == due
        assert "#:schema" not in text
        assert text.count("#") >= task.text.count("#") // 2  # the remarks stay


@each("path", sampled(thinned(every_task(), 9), 3))
def test_tasks_are_solved_in_all_variants(path: Path) -> None:
    for variant in (None, *variant_names(path)):
        solution = Solution(load(path, variant=variant))
        verify(solution)
        if solution.problem.dynamics is not None:
            assert statics_of(solution).si
    text = path.read_text("utf-8")
    assert re.search(r"задани[ея] № \d+|задача 2\.1\.\d+", text)
    assert "# Определить" in text


@each("path", sampled(thinned(every_task(), 35), 3))
def test_sheets_of_tasks_have_no_errors(path: Path) -> None:
    """In one position and in several; with --thorough each variant, and all positions at once."""
    names = variant_names(path)
    problem = load(path)
    own = [at for name in names for at in load(path, variant=name).drive.positions]
    many = sorted(own or [problem.drive.positions[0] + step for step in (0, 5, 10)])
    asked: list[tuple[Problem, list[float] | None]] = [
        *((load(path, variant=name), None) for name in thinned((None, *names), 7)),
        *((problem, row) for row in thinned((many[:3], many, many[:1]), 3)),
    ]
    for one, positions in asked:
        for sheet in controlled_kinematics(one, partial(kinematics_sheets, positions=positions)):
            assert not [f for f in sheet.findings if f.severity is Severity.ERROR]


@each("lang", LANGUAGES)
def test_a_scheme_with_several_readings_is_marked_but_not_on_a_sheet(lang: str) -> None:
    """Marked in the list, in ``solve`` with the other readings, in JSON; only for these tasks."""
    several = [name for name, task in TASKS.items() if task.reading]
    assert len([name for name in several if name.startswith("levers-")]) == 19
    assert len([name for name in several if name.startswith("linkages-")]) == 39
    assert len([name for name in several if name.startswith("gears-")]) == 31
    said = get_language(lang).tasks
    listed = run("tasks", "--lang", lang).output
    starred = re.findall(r"(?m)^  (\S+) .*\*$", listed)
    assert sorted(starred) == sorted(several)
    assert said.readings in listed
    assert said.readings not in run("tasks", "--search", "К11", "--lang", lang).output
    for name in ("levers-3", "gears-2-2-090"):
        path = str(home() / TASKS[name].file)
        told = " ".join(run("solve", path, "--lang", lang).output.split())
        others = parse(TASKS[name].text, name=name)["other_readings"]
        assert said.reading in told
        assert said.other_readings.format(others="; ".join(others)) in told
        record = json.loads(run("solve", path, "--json").stdout)
        assert (record["reading"], record["other_readings"]) == ("one of several", others)
    plain = str(home() / TASKS["levers-13"].file)
    assert said.reading[:20] not in run("solve", plain, "--lang", lang).output
    assert "reading" not in json.loads(run("solve", plain, "--json").stdout)
    for sheet in controlled_kinematics(load(home() / TASKS["levers-3"].file)):
        texts = [item.text for item in sheet.drawing.items if isinstance(item, Text)]
        assert not [text for text in texts if "прочтени" in text]


@each("path", [path for path in every_task() if path.stem.startswith("task-")])
def test_lever_tasks_require_motion_and_with_masses_forces(path: Path) -> None:
    """The list is the same in all variants."""
    problem = load(path)
    kinds = [parse_quantity(one.what).word for one in problem.answers]
    assert {"v", "a", "omega", "epsilon"} <= set(kinds)
    assert ({"F", "balance"} <= set(kinds)) == (problem.dynamics is not None)
    asked = {one.what for one in problem.answers}
    sliders = ["0", *(link for link, slide in problem.slides.items() if slide.host == "0")]
    alike = {p for link in sliders for p in problem.bodies[link].points}
    for p in {p for body in problem.bodies.values() for p in body.points} - alike:
        assert {f"v {p}", f"a {p}"} <= asked
    for link in sliders[1:]:
        assert any({f"v {p}", f"a {p}"} <= asked for p in problem.bodies[link].points)
    assert all(one.sense for one in problem.answers if one.what.startswith(("omega", "epsilon")))


@each("path", thinned([path for path in every_task() if path.stem.startswith("task-")], 33))
def test_keys_of_lever_tasks_are_made_for_all_variants(path: Path, tmp_path: Path) -> None:
    told = run("check", "--key", str(path), "-o", str(tmp_path), "--lang", "ru")
    assert told.exit_code == 0, told.output
    assert all(f"\n      {name}  " in told.output for name in variant_names(path))


def test_the_list_is_filtered_by_structure_and_words() -> None:
    listed = run("tasks", "--group", "ВВВ+rpr").output
    assert "levers-38" in listed
    assert "levers-13" not in listed
    found = json.loads(run("tasks", "--search", "кулиса плечо", "--json").stdout)["tasks"]
    assert "levers-13" in [task["name"] for task in found]
    assert all(set(task) >= {"title", "source", "groups", "variants"} for task in found)
    assert len(json.loads(run("tasks", "--json").stdout)["tasks"]) == len(TASKS)
    assert groups_of("RRR + PRR") == ("RRR", "RRP")
    assert run("tasks", "--group", "RRX").exit_code == 2


def test_a_task_is_written_to_start_from(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("new", "levers-13", "my.toml", "--variant", "Б").exit_code == 0
    mine = load(Path("my.toml"))
    assert mine.drive.positions == (120,)
    assert variant_names(Path("my.toml")) == ()
    assert run("new", "linkages-2.1.20").exit_code == 0
    assert load(Path("linkages-2.1.20.toml")).drive.positions == (30, 120, 180)
    for words in (["levers-1300"], ["levers-13", "--variant", "Ё"], ["four-bar", "--variant", "Б"]):
        assert run("new", *words).exit_code == 2
