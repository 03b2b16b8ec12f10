"""Variants read together give the same results as each read alone, to the last bit."""

import csv
import random
import re
import tomllib
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from cases import each, sampled, some, thinned
from click.testing import CliRunner
from doors import (
    DEFAULT,
    DRAFTING_PROFILES as PROFILES,
    Construction,
    GappedSweep,
    ModelProblem as Problem,
    PlanMethodError,
    Solution,
    Task,
    batch_records,
    cli as main,
    compute_keys,
    construct,
    construct_each,
    in_batches,
    key_of_task,
    key_record,
    load_each,
    loads_on,
    problem_loads as loads,
    record_in_columns,
    solved_arrays,
    swept_arrays,
    to_builtins,
    variant_names,
)

PROBLEMS = Path(__file__).parents[2] / "problems"
MORE = ("cycle", "machine", "dynamics", "loads", "balancing", "variants", "project", "gears")


def plain_files() -> list[Path]:
    """Return shipped problems with plans only."""
    files = sorted(PROBLEMS.glob("l*/*.toml"))
    return [file for file in files if not set(MORE) & tomllib.loads(file.read_text()).keys()]


def loaded_files() -> list[Path]:
    """Return shipped problems with loads whose pairs do not rub."""
    more = {*MORE} - {"dynamics", "loads", "variants"}
    found = []
    for file in sorted(PROBLEMS.glob("l*/*.toml")):
        table = tomllib.loads(file.read_text())
        if not more & table.keys() and "loads" in table and "friction" not in table:
            found.append(file)
    return found


def varied(file: Path, count: int) -> list[Problem]:
    """Return variants of a problem: lengths, masses and crank angles are off by a few percent.

    A figure keeps its crank angle, with which the angles in ``[drawn]`` are: with another one it
    may have a second mirror image, or contradict itself.
    """
    text = re.sub(r"(?ms)^\[variants\b.*?(?=^\[(?!variants)|\Z)", "", file.read_text())
    table = tomllib.loads(text)
    masses = table.get("dynamics", {}).get("links", {})
    spread = random.Random(file.name)
    rows = []
    for k in range(count):
        cells = [
            f"links.{link}.{key} = {value * spread.uniform(0.97, 1.03):.5g}"
            for link, keys in table["links"].items()
            for key, value in keys.items()
            if len(key) == 2 and type(value) in (int, float)
        ]
        cells += [
            f"dynamics.links.{link}.{key} = {value * spread.uniform(0.9, 1.1):.5g}"
            for link, keys in masses.items()
            for key, value in keys.items()
            if type(value) in (int, float)
        ]
        if "drawn" not in table and type(table["driver"].get("phi")) in (int, float):
            cells.append(f"driver.phi = {table['driver']['phi'] + spread.uniform(-20, 20):.4g}")
        rows.append(f'{text}\n[variants]\n"{k}" = {{ {", ".join(cells)} }}\n')
    return [loads(whole, name=file.stem, variant=str(k)) for k, whole in enumerate(rows)]


def encoded(record: Any) -> bytes:
    return msgspec.json.encode(to_builtins(record))


def together(problems: list[Problem]) -> dict[int, bytes]:
    found: dict[int, bytes] = {}
    for batch, members in in_batches(problems, PROFILES["board"]):
        records = map(encoded, batch_records(batch))
        found.update(zip(members, records, strict=True))
    return found


def drawn_as(made: Construction) -> list[object]:
    """Return the contents of a plan; numbers as texts, in which zeros have their signs."""
    draft = made.draft
    numbers = draft.numbers, draft.places, draft.choice, draft.branches, draft.origin
    plans = made.program.steps, made.plans, made.sections, made.legend, made.segments
    board = draft.axes, draft.placed, [*draft.marked], [*draft.read], draft.dimensions, draft.feet
    return [repr(numbers), *plans, *board, draft.letters, draft.plans, draft.special]


@each("file", sampled(thinned(plain_files() + loaded_files(), 2), 3))
def test_variants_planned_together_are_planned_as_alone(file: Path) -> None:
    problems = varied(file, 6)
    for problem, made in zip(problems, construct_each(problems), strict=True):
        if made is None:
            with pytest.raises(PlanMethodError):
                construct(problem)
        else:
            assert drawn_as(made) == drawn_as(construct(problem)), (file.name, problem.variant)


def test_variants_that_close_to_other_sides_are_planned_in_parts() -> None:
    text = (PROBLEMS / "linkages" / "ex3.toml").read_text("utf-8")
    rows = {"low": "driver.phi = 20", "short": "links.4.DE = 0.01", "near": "frame.C = [0, 0.05]"}
    text += "".join(f"\n[variants.{name}]\n{own}\n" for name, own in rows.items())
    problems = [loads(text, name="ex3", variant=name) for name in rows]
    low, short, near = construct_each(problems)
    assert short is None and low is not None and near is not None
    for made, problem in ((low, problems[0]), (near, problems[2])):
        assert drawn_as(made) == drawn_as(construct(problem))


@each("file", sampled(thinned(plain_files(), 4), 3))
def test_a_variant_among_others_has_the_bytes_of_one_alone(file: Path) -> None:
    problems = varied(file, 8)
    for k, text in together(problems).items():
        assert text == encoded(record_in_columns(Solution(problems[k]))), (file.name, k)


@each("file", sampled(thinned(loaded_files(), 9), 2))
def test_a_variant_with_loads_has_among_others_the_bytes_of_one_alone(file: Path) -> None:
    problems = varied(file, 6)
    found = together(problems)
    assert len(found) > 2, file.name
    for k, text in found.items():
        assert text == encoded(record_in_columns(Solution(problems[k]))), (file.name, k)


def test_loads_that_one_has_and_another_has_not_make_batches_of_their_own() -> None:
    file = PROBLEMS / "levers" / "task-1.toml"
    problems = list(load_each(file, variant_names(file)))
    batches = in_batches(problems, PROFILES["board"])
    assert sorted(k for _, members in batches for k in members) == list(range(len(problems)))
    for batch, members in batches:
        kinds = {loads_on(Solution(problems[k])).kind for k in members}
        assert kinds == {loads_on(batch.solutions[0]).kind}
    assert len(batches) > 1


def loaded(file: Path) -> dict[str, Any]:
    with np.load(file) as arrays:
        return dict(arrays)


def test_arrays_of_many_variants_are_those_of_each_alone(tmp_path: Path) -> None:
    for name in ("levers/task-1", "levers/task-54"):
        file = PROBLEMS / f"{name}.toml"
        target = tmp_path / "all.npz"
        arguments = ["solve", str(file), "--npz", str(target)]
        assert CliRunner().invoke(main, [*arguments, "--all-variants"]).exit_code == 0
        whole = loaded(target)
        variants = variant_names(file)
        names = [one.partition(":")[2] for one in whole if one.startswith(f"{variants[0]}:")]
        for variant in variants:
            assert CliRunner().invoke(main, [*arguments, "--variant", variant]).exit_code == 0
            alone = loaded(target)
            assert list(alone) == names
            for array in names:
                among = whole[f"{variant}:{array}"]
                assert (among.dtype, among.tobytes()) == (
                    alone[array].dtype,
                    alone[array].tobytes(),
                )


def test_arrays_of_few_positions_are_those_of_a_sweep() -> None:
    for name in ("linkages/ex3", "levers/task-1", "levers/task-12"):
        (problem,) = load_each(PROBLEMS / f"{name}.toml", (None,))
        swept = GappedSweep(problem, np.array(problem.drive.positions))
        expected = dict(swept_arrays(swept))
        found = dict(solved_arrays(Solution(problem)).named(""))
        assert list(found) == list(expected)
        for array, values in expected.items():
            assert found[array].dtype == values.dtype
            if values.dtype.kind == "f":
                assert np.allclose(found[array], values, rtol=1e-9, atol=1e-9), (name, array)


@each("file", sampled(thinned([PROBLEMS / "linkages" / "ex3.toml", *loaded_files()], 12), 2))
def test_the_key_of_a_variant_is_the_same_among_others_and_alone(file: Path) -> None:
    problems = varied(file, 4)
    found = compute_keys(in_batches(problems, PROFILES["board"]), DEFAULT)
    assert len(found) > 1, file.name
    for k, key in found.items():
        alone = key_of_task(Task(Solution(problems[k])))
        assert key_record(key) == key_record(alone), (file.name, k)


def test_three_hundred_variants_have_the_bytes_of_each_alone() -> None:
    for name in sampled(["linkages/ex3", "levers/task-54"], 2):
        file = PROBLEMS / f"{name}.toml"
        problems = varied(file, 300)
        found = together(problems)
        assert len(found) > 290, file.name
        for k in list(found)[:: 300 // some(300, 15)]:
            assert found[k] == encoded(record_in_columns(Solution(problems[k]))), (file.name, k)


def test_most_variants_are_read_together_in_any_order() -> None:
    problems = varied(PROBLEMS / "linkages" / "ex3.toml", 12)
    assert len(together(problems)) == 12
    found, turned = together(problems), together(problems[::-1])
    assert [turned[11 - k] for k in range(12)] == [found[k] for k in range(12)]


EX3 = (PROBLEMS / "linkages" / "ex3.toml").read_text().replace("phi = 160", "phi = 20")
MIXED = """
[variants]
"1" = { driver.phi = 30 }
"2" = { links.4.DE = 0.01 }
"3" = { driver.phi = 50, driver.epsilon = 10 }
"4" = { driver.phi = 60 }
"5" = { driver.phi = 70, driver.epsilon = -10 }
"6" = { driver.phi = [20, 80], links.3.CD = 0.21 }
"7" = { driver.phi = [20, 90] }
"""


def test_one_that_cannot_be_assembled_is_named_and_the_others_go_on(tmp_path: Path) -> None:
    file = tmp_path / "mixed.toml"
    file.write_text(EX3 + MIXED)
    run = CliRunner().invoke(main, ["solve", str(file), "--all-variants", "--json", "--lang", "en"])
    assert run.exit_code == 4, run.stderr
    assert run.stderr.count("mixed-2: ") == 1
    records = msgspec.json.decode(run.stdout)
    assert [one["variant"] for one in records] == ["1", "3", "4", "5", "6", "7"]
    assert list(map(len, (one["positions"] for one in records))) == [1, 1, 1, 1, 2, 2]
    alone = ["solve", str(file), "--json", "--variant"]
    for one in records:
        run = CliRunner().invoke(main, [*alone, one["variant"]])
        assert msgspec.json.decode(run.stdout) == one


def test_doubtful_variants_give_the_same_warnings_as_alone(tmp_path: Path) -> None:
    # The arc of the first touches the guide but for 2e-13 m: next to a dead position.
    near = {"8": "links.4.DE = 0.090171477781", "9": "driver.phi = 35", "10": "driver.phi = 36"}
    file = tmp_path / "doubt.toml"
    rows = "\n".join(f'"{k}" = {{ {v} }}' for k, v in near.items())
    file.write_text(EX3 + "\n[variants]\n" + rows + "\n")
    arguments = ["solve", str(file), "--json", "--lang", "en"]
    both = CliRunner().invoke(main, [*arguments, "--all-variants"])
    assert both.stderr.count("Warning: ") == 1
    each_alone = [CliRunner().invoke(main, [*arguments, "--variant", k]) for k in near]
    assert sorted(both.stderr.splitlines()) == sorted(
        line for run in each_alone for line in run.stderr.splitlines()
    )


def test_a_table_has_the_rows_of_each_alone(tmp_path: Path) -> None:
    file = tmp_path / "mixed.toml"
    lines = [line for line in MIXED.splitlines() if "DE" not in line and "epsilon" not in line]
    file.write_text(EX3 + "\n".join(lines) + "\n")
    whole = CliRunner().invoke(main, ["solve", str(file), "--all-variants", "--csv"])
    head, *rows = csv.reader(whole.stdout.splitlines())
    assert head[:3] == ["problem", "variant", "position"]
    for variant in ("1", "4", "6", "7"):
        alone = CliRunner().invoke(main, ["solve", str(file), "--csv", "--variant", variant])
        own = [row for row in rows if row[1] == variant]
        names, *cells = csv.reader(alone.stdout.splitlines())
        assert [[row[head.index(name)] for name in names] for row in own] == cells
