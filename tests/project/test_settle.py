"""Decisions on a project, made once: positions, the calculated one, scales, strokes."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
import worked
from doors import (
    MAX_SIDE,
    PART_KINDS,
    TURN_SMALL as SMALL,
    Drawing,
    ModelProblem as Problem,
    PartName,
    PlanKind,
    ProblemError,
    Project,
    ProjectTask,
    SizeTable,
    Solution,
    Text,
    crank_cycle_of,
    external,
    fingerprint_of,
    hodograph,
    kinds_load as load,
    loaded_positions,
    next_scale,
    numbered_set,
    part_drawings,
    problem_loads as loads,
    project_record,
    settle,
    with_decisions,
)
from msgspec.structs import replace

FILES = Path(__file__).parents[1] / "data" / "projects"


def file_of(name: str) -> Path:
    return FILES / f"{name}.toml"


def problem_of(name: str) -> Problem:
    return load(file_of(name))


def project_of(name: str) -> Project:
    return worked.project_of(file_of(name))


def scaled(name: str) -> Problem:
    """Return a problem at the scales of its project: given, they are not searched again."""
    return replace(problem_of(name), scales=project_of(name).scales)


@cache
def sheets_of(name: str) -> list[list[Drawing]]:
    project = project_of(name)
    return [part_drawings(project, part, {}) for part in project.parts]


# Positions ---------------------------------------------------------------------------------------


def test_positions_are_those_of_the_cycle_numbered_from_0() -> None:
    project = project_of("shaper")
    turn = crank_cycle_of(project.solution)
    assert project.positions == pytest.approx(tuple(turn.positions))
    assert project.problem.drive.positions == project.positions
    assert len(project.positions) == 6
    assert turn.ends is not None
    starts = {round(end.phi % 360.0, 6) for end in turn.ends}
    assert round(project.positions[0] % 360.0, 6) in starts


def test_the_flywheel_begins_where_position_0_is() -> None:
    machine = project_of("shaper").problem.machine
    assert machine is not None
    assert (machine.start_deg, machine.count) == (project_of("shaper").positions[0], 6)


def test_a_cycle_of_two_turns_has_the_positions_of_both() -> None:
    project = project_of("engine")
    assert len(project.positions) == 8
    ends = project.positions[0], project.positions[4]
    assert abs(ends[1] - ends[0]) == pytest.approx(360.0)


def test_positions_of_the_file_that_go_round_are_the_cycle() -> None:
    project = project_of("crusher")
    assert [at % 360.0 for at in project.positions] == pytest.approx([0.0, 90.0, 180.0, 270.0])
    assert project.problem.cycle is not None


def test_a_homework_of_one_position_is_a_project_of_that_position() -> None:
    project = project_of("homework")
    assert (project.positions, project.calculated) == ((60.0,), 0)
    assert project.strokes is None
    assert [part.name for part in project.parts] == [PartName.KINEMATICS]


def test_the_way_of_assembly_is_that_of_the_file() -> None:
    """The rules of the file hold for its own positions, not for the first one of the cycle."""
    asked = problem_of("crusher")
    one, two = (
        Solution(asked, positions=[30.0]),
        project_of("crusher").solution.with_positions([30.0]),
    )
    assert one.place("D")[0] == pytest.approx(two.place("D")[0])  # type: ignore[arg-type]


# The calculated position -------------------------------------------------------------------------


def test_the_calculated_position_is_the_requested_one() -> None:
    assert project_of("shaper").calculated == 4


def test_phi_is_the_calculated_position_if_it_is_one_of_them() -> None:
    problem = scaled("shaper")
    at = project_of("shaper").positions[2]
    drive = replace(
        problem.drive, positions=(at - 360.0,), assembly_positions=problem.drive.positions
    )
    found = settle(replace(problem, drive=drive, project=None))
    assert found.calculated == 2


def test_else_a_load_acts_in_the_calculated_position() -> None:
    found = settle(replace(scaled("shaper"), project=None))
    acting = loaded_positions(found.solution)
    assert found.calculated in acting
    assert len(acting) < len(found.positions)


def test_the_load_of_the_calculated_position_is_considerable() -> None:
    """The gas force of an engine falls to a hundredth of its maximum during the stroke."""
    found = settle(replace(scaled("engine"), project=None))
    (gas,) = (
        np.abs(one.force)
        for one in external(found.solution, found.problem.dynamics, "3")  # type: ignore[arg-type]
        if one.name == "P"
    )
    (load,) = found.problem.dynamics.loads  # type: ignore[union-attr]
    assert isinstance(load.size, SizeTable)
    largest = max(map(abs, load.size.values))
    assert gas[[*loaded_positions(found.solution)]].min() >= largest / 3.0
    assert gas.min() < largest / 3.0


def test_a_position_that_there_is_not_is_a_fault_of_the_file() -> None:
    task = ProjectTask(calculated=6)
    with pytest.raises(
        ProblemError,
        match=r"project\.calculated: position 6 does not exist\. Of 6 positions .* 5\.",
    ):
        settle(replace(scaled("shaper"), project=task))


# Scales and strokes ------------------------------------------------------------------------------


def test_every_sheet_has_the_scales_of_the_project() -> None:
    project = project_of("shaper")
    keys = {"position": "mu_l", "velocity": "mu_v", "acceleration": "mu_a", "forces": "mu_F"}
    found: dict[str, set[float]] = {key: set() for key in keys.values()}
    for part, drawings in zip(project.parts, sheets_of("shaper"), strict=True):
        for view in [view for one in drawings for view in one.views if part.name not in PART_KINDS]:
            if view.kind in keys:
                found[keys[view.kind]].add(view.per_mm)
    assert found == {key: {getattr(project.scales, key)} for key in found}


def test_the_calculated_position_has_the_same_readings_alone_and_among_all() -> None:
    project = project_of("shaper")
    for label in project.solution.legend:
        among, alone = project.solution.read_off(label), project.loaded.read_off(label)
        assert among[project.calculated] == pytest.approx(alone[0], nan_ok=True)


def test_scales_of_the_file_are_kept() -> None:
    problem = problem_of("homework")
    asked = replace(problem, scales=replace(problem.scales, mu_l=0.0025, mu_v=0.02, mu_a=0.4))
    assert settle(asked).scales == replace(asked.scales, decided=True)


def test_the_working_stroke_is_that_of_the_load() -> None:
    strokes = project_of("shaper").strokes
    assert strokes is not None
    assert strokes.by == "load P"
    assert strokes.working_deg > strokes.idle_deg  # the load acts on the slow stroke
    assert strokes.K_v == pytest.approx(strokes.working_deg / strokes.idle_deg)


# Outputs -----------------------------------------------------------------------------------------


def test_a_settled_problem_stays_as_it_is() -> None:
    problem = project_of("shaper").problem
    assert with_decisions(problem) is problem
    assert with_decisions(problem_of("homework")).calculated is None  # it has no [project]


@pytest.mark.parametrize("line", ['sources = ["Frolov"]', "analytic = true", "theory = true"])
def test_keys_of_the_note_do_not_make_a_project(line: str) -> None:
    """Its scales, its sheets and its forms stay as they were; a decision makes a project."""
    text = file_of("homework").read_text("utf-8")
    plain, noted = (loads(f"{text}\n{more}\n", name="my") for more in ("", f"[project]\n{line}"))
    decided = loads(f"{text}\n[project]\n{line}\ncalculated = 0\n", name="my")
    assert with_decisions(noted) is noted
    assert not noted.is_project and decided.is_project and not plain.is_project
    assert fingerprint_of(noted) == fingerprint_of(plain) != fingerprint_of(decided)
    assert fingerprint_of(decided) == fingerprint_of(
        loads(f"{text}\n[project]\ncalculated = 0\n", name="my")
    )
    assert loads(f"{text}\n[project]\n", name="my").is_project


@pytest.mark.parametrize("name", ["shaper", "engine"])
def test_hodographs_have_the_scale_of_the_plans_or_are_larger(name: str) -> None:
    solution = project_of(name).solution
    for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION):
        made, common = hodograph(solution, kind, 60.0), solution.scales[kind]
        widths = [np.ptp([part.real, part.imag], axis=1).max() for part in made.parts]
        assert made.scale == hodograph(solution, kind, 90.0).scale  # that of the sheet in the note
        assert MAX_SIDE / 2.5 <= max(widths) <= MAX_SIDE
        at_common = max(widths) * made.scale.per_mm / common.per_mm
        if SMALL * MAX_SIDE <= at_common <= MAX_SIDE:
            assert made.scale == common
        else:  # the next larger one would not fit
            finer = next_scale(made.scale.per_mm, finer=True)
            assert max(widths) * made.scale.per_mm / finer > MAX_SIDE


def test_places_are_written_within_a_turn() -> None:
    told = project_record(project_of("engine"), (), "engine")
    places = [one["phi_deg"] for one in told["positions"]]
    assert all(0.0 <= place < 360.0 for place in places)
    assert places[4:] == places[:4]


def test_sheets_are_numbered_as_one_set() -> None:
    sheets = [
        one for some in numbered_set(project_of("shaper"), sheets_of("shaper")) for one in some
    ]
    numbers = [
        [
            item.text
            for item in sheet.items
            if isinstance(item, Text) and item.text.isdigit() and item.tag.startswith("stamp")
        ]
        for sheet in sheets
    ]
    first, *later = numbers
    assert first == ["1", str(len(sheets))]
    assert later == [[str(k)] for k in range(2, len(sheets) + 1)]


def test_small_paper_takes_more_sheets_at_the_same_scales() -> None:
    problem = problem_of("crusher")
    project = settle(replace(problem, sheet=replace(problem.sheet, paper="A2")))
    sheets = part_drawings(project, project.parts[0], {})
    assert len(sheets) > 1
    assert {(sheet.width, sheet.height) for sheet in sheets} == {(594.0, 420.0)}
    plans = [view for sheet in sheets for view in sheet.views if view.kind == "velocity"]
    assert {view.per_mm for view in plans} == {project.scales.mu_v}


def test_parts_are_those_that_project_selects() -> None:
    problem = scaled("shaper")
    some = replace(problem, project=ProjectTask(parts=("kinematics", "gears")))
    found = settle(some, file_of("shaper"))
    assert [part.name for part in found.parts] == [PartName.KINEMATICS, PartName.GEARS]


def test_a_train_is_read_from_a_file_beside_the_project(tmp_path: Path) -> None:
    text = file_of("homework").read_text("utf-8")
    train = file_of("shaper").read_text("utf-8")
    gears = train[train.index("[gears]") : train.index("[stamp]")]
    (tmp_path / "my.toml").write_text(text + '\n[project]\ngears = "train.toml"\n', "utf-8")
    (tmp_path / "train.toml").write_text('title = "Редуктор"\n' + gears, "utf-8")
    path = tmp_path / "my.toml"
    found = settle(load(path), path).part(PartName.GEARS)
    assert found is not None
    assert found.problem.title == "Редуктор"


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (
            'parts = ["gears"]',
            "project.parts: the file has no part 'gears'. It has kinematics, note.",
        ),
        ('gears = "none.toml"', "project.gears: none.toml is not in the folder of this file"),
        ('gears = "my.toml"', "project.gears: my.toml has no table [gears]"),
        ('meshing = "my.toml"', "project.meshing: my.toml has no table [meshing]"),
    ],
)
def test_a_part_that_there_is_not_is_a_fault_of_the_file(
    line: str, said: str, tmp_path: Path
) -> None:
    path = tmp_path / "my.toml"
    text = file_of("homework").read_text("utf-8") + f"\n[project]\n{line}\n"
    path.write_text(text, "utf-8")
    with pytest.raises(ProblemError) as error:
        settle(load(path), path)
    assert said in str(error.value) and len(error.value.faults) == 1


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ('gears = "../train.toml"', "project.gears: expected the name of a problem file"),
        ('parts = ["sheets"]', "project.parts: unknown part 'sheets'"),
        ('sources = "Frolov"', "project.sources: expected a list of books"),
        ("sources = [1987]", "project.sources[0]: expected a string"),
        (f"sources = {['x' * 401]}", "the text has 401 characters, the limit is 400"),
        (f"sources = {[str(k) for k in range(61)]}", "the list has 61 books, the limit is 60"),
        ("calculated = -1", "project.calculated"),
        ("position = 4", "project.position"),
    ],
)
def test_faults_of_the_table_are_reported(line: str, said: str) -> None:
    text = file_of("homework").read_text("utf-8") + f"\n[project]\n{line}\n"
    with pytest.raises(ProblemError) as error:
        loads(text, name="my")
    assert said in str(error.value)
