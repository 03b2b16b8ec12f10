"""One numbering of the positions of a cycle, one working stroke, for all outputs."""

from __future__ import annotations

import re
from math import radians

import numpy as np
import pytest
from click.testing import CliRunner
from doors import (
    ANYWHERE,
    DRAFTING_PROFILES as PROFILES,
    STEPS,
    CycleMotion,
    Drawing,
    Flywheel,
    MachineAccount,
    MachineNarrator,
    ModelProblem as Problem,
    ProblemError,
    Solution,
    Text,
    angle_with_positions,
    cli,
    crank_cycle_of,
    cycle_forces_of,
    cycle_record,
    diagrams_of,
    drawing_of,
    get_language,
    kinds_loads as loads,
    kinematics_sheets,
    numbered_positions,
    strokes_of,
    unlikely,
)
from msgspec.structs import replace
from worked import ROOT

FILES = ROOT / "tests/data/turn"
SHAPER, ENGINE, CRUSHER, EPSILON = (
    (FILES / f"{name}.toml").read_text("utf-8")
    for name in ("shaper", "engine", "crusher", "epsilon")
)
PHI = re.compile(r"(?m)^phi = .*\n")
PRESS = (ROOT / "problems/press/flywheel.toml").read_text("utf-8")


def sheet_texts(sheet: Drawing) -> list[str]:
    return [item.text.strip() for item in sheet.items if isinstance(item, Text)]


def read(text: str, *changes: tuple[str, str]) -> Problem:
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    return loads(text, name="cycle")


def without_phi(text: str) -> str:
    assert PHI.search(text)
    return PHI.sub("", text)


# Positions ---------------------------------------------------------------------------------------


def test_without_phi_the_positions_of_a_file_are_those_of_its_cycle() -> None:
    problem = read(without_phi(SHAPER))
    assert (
        problem.drive.positions == problem.numbered and problem.drive.assembly_positions == ANYWHERE
    )
    assert np.diff(problem.numbered) == pytest.approx([30.0] * 11)
    assert problem.numbered[0] == pytest.approx(197.999, abs=1e-3)
    assert not list(unlikely(problem))


def test_positions_that_the_driver_lists_are_outranked_with_one_warning() -> None:
    problem, alone = read(SHAPER), read(without_phi(SHAPER))
    assert problem.drive.positions == pytest.approx(alone.numbered, abs=1e-9)
    (said,) = unlikely(problem)
    for part in ("12 positions from 0° to 330°", "12 from 198° to 168°", "Delete phi"):
        assert part in said
    same = read(SHAPER, ("phi = { from = 0,", "phi = { from = 198.0,"))
    assert not list(unlikely(same)) and same.drive.positions == pytest.approx(alone.numbered)


def test_a_single_position_stays_and_the_sheets_of_the_cycle_have_the_cycle() -> None:
    problem = read(SHAPER, ("phi = { from = 0, count = 12 }", "phi = 70"))
    assert problem.drive.positions == (70.0,)
    assert numbered_positions(Solution(problem)) == pytest.approx(
        read(without_phi(SHAPER)).numbered, abs=1e-9
    )
    (sheet,) = kinematics_sheets(problem, layout="forces-cycle")
    assert {"198", "228", "168"} <= set(sheet_texts(sheet))


def test_a_single_position_that_the_cycle_has_not_is_warned_of() -> None:
    for phi, warned in (("70", True), ("48", False), ("408.05", False), ("48.2", True)):
        problem = read(SHAPER, ("phi = { from = 0, count = 12 }", f"phi = {phi}"))
        said = [str(one) for one in unlikely(problem)]
        assert bool(said) is warned, phi
        near = "position 7 at 48°" if phi == "48.2" else "position 8 at 78°"
        assert all(part in text for part in (f"phi = {phi}° ", near) for text in said)


@pytest.mark.parametrize("with_cycle", [True, False])
def test_the_layouts_of_the_cycle_have_the_same_positions(with_cycle: bool) -> None:
    """Without [cycle] the machine determines position 0, otherwise the extreme position does."""
    text = without_phi(SHAPER) if with_cycle else SHAPER[: SHAPER.index("[cycle]")]
    if not with_cycle:
        text += SHAPER[SHAPER.index("[dynamics.links.1]") :].replace(
            "[machine]", "[machine]\nphi_0 = 198"
        )
    problem = read(text)
    solution = Solution(problem)
    positions = numbered_positions(solution)
    assert positions == pytest.approx(198.0 + 30.0 * np.arange(12), abs=2e-3)
    assert crank_cycle_of(solution).positions == pytest.approx(positions)
    wheel = Flywheel(problem)
    assert wheel.turn.start_deg == pytest.approx(positions[0])
    assert wheel.rows.phi_deg == pytest.approx(positions)


def test_a_machine_and_its_cycle_cannot_contradict_each_other() -> None:
    for line, fault in (
        ("phi_0 = 10", "machine.phi_0: 10 deg, and position 0 of [cycle] is at 198.00 deg"),
        ("phi_0 = 198.05", ""),
    ):
        changed = without_phi(SHAPER).replace("[machine]", f"[machine]\n{line}")
        if fault:
            with pytest.raises(ProblemError) as caught:
                read(changed)
            assert fault in str(caught.value)
        else:
            read(changed)
    with pytest.raises(ProblemError, match=r"machine.count: 12 positions .* 8 of a turn"):
        read(without_phi(SHAPER), ('zero = "extreme"', "count = 8"))
    alone = read(without_phi(SHAPER), ("count = 12", "count = 24"), ('zero = "extreme"\n', ""))
    assert len(alone.numbered) == 24
    followed = read(without_phi(SHAPER), ("count = 12", ""), ('zero = "extreme"', "count = 8"))
    assert followed.machine is not None and followed.machine.count == 8
    told = read(
        without_phi(SHAPER), ('zero = "extreme"\n', ""), ("[machine]", "[machine]\nphi_0 = 15")
    )
    assert told.numbered[0] == 15.0


def test_positions_are_numbered_against_the_crank_if_the_file_requires_it() -> None:
    problem = read(without_phi(SHAPER), ('zero = "extreme"', 'zero = "extreme"\ndirection = "cw"'))
    assert np.diff(problem.numbered) == pytest.approx([-30.0] * 11)
    told = cycle_record(Solution(problem))
    ahead = cycle_record(Solution(read(without_phi(SHAPER))))
    assert told["velocity"][1:] == pytest.approx(ahead["velocity"][:0:-1], abs=1e-9)
    assert told["working_deg"] == pytest.approx(ahead["working_deg"])
    wheel = Flywheel(problem)
    assert wheel.turn.numbers(12) == [0, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0]
    phi = dict(zip(wheel.turn.numbers(12), wheel.rows.phi_deg, strict=False))
    for number, position in enumerate(problem.numbered):
        assert (phi[number] - position) % 360.0 == pytest.approx(0.0, abs=1e-9) or number == 0


@pytest.mark.parametrize("method", ["wittenbauer", "mertsalov"])
def test_the_points_a_flywheel_is_found_by_have_the_numbers_of_the_sheet(method: str) -> None:
    machine = ("[machine]", f'[machine]\nmethod = "{method}"')
    against = ('zero = "extreme"', 'zero = "extreme"\ndirection = "cw"')
    wheels = (Flywheel(read(without_phi(SHAPER), machine, *more)) for more in ((), (against,)))
    ahead, back = (
        MachineNarrator(drawing_of(wheel, PROFILES["board"]), get_language("en"))
        for wheel in wheels
    )
    assert any(ahead.tangent_positions)
    assert back.tangent_positions == tuple(-number % 12 for number in ahead.tangent_positions)
    told = " ".join(map(repr, MachineAccount(back, STEPS).inertia()))
    for number in back.tangent_positions:
        assert re.search(rf"(points|position|and) {number}\b", told)


def test_protocol_counts_positions_from_0(tmp_path: object) -> None:
    path = str(FILES / "shaper.toml")
    run = CliRunner().invoke(cli, ["protocol", path, "--position", "11", "--lang", "en"])
    assert run.exit_code == 0 and "φ₁ = 168°" in run.stdout
    first = CliRunner().invoke(cli, ["protocol", path, "--lang", "en"])
    assert "φ₁ = 198°" in first.stdout
    assert CliRunner().invoke(cli, ["protocol", path, "--position", "12"]).exit_code == 2
    other = CliRunner().invoke(cli, ["protocol", path, "--phi", "40", "--lang", "en"])
    assert "φ₁ = 40°" in other.stdout


# Two turns ---------------------------------------------------------------------------------------


def test_a_cycle_of_two_turns_has_the_positions_and_the_forces_of_both() -> None:
    problem = read(without_phi(ENGINE))
    assert problem.numbered == pytest.approx([90.0 - 30.0 * k for k in range(24)])
    forces = cycle_forces_of(Solution(problem))
    number = next(k for k, joint in enumerate(forces.joints) if {joint.on, joint.by} == {"2", "3"})
    assert forces.course.closed and np.ptp(forces.positions) == pytest.approx(720.0)
    assert forces.peak(number).size == pytest.approx(11170, abs=5)
    one = cycle_forces_of(Solution(problem, positions=[90.0 - 30.0 * k for k in range(12, 24)]))
    assert one.peak(number).size < 6000
    told = cycle_record(Solution(problem))
    assert len(told["positions_deg"]) == len(told["velocity"]) == 24
    assert told["velocity"][12:] == pytest.approx(told["velocity"][:12], abs=1e-9)
    diagrams = diagrams_of(Solution(problem))
    assert diagrams.x(diagrams.fractions)[-1] * diagrams.mu_phi == pytest.approx(radians(720))


def test_angles_of_two_turns_are_written_within_one_and_the_number_distinguishes_the_turn() -> None:
    problem = read(without_phi(ENGINE))
    shown = [problem.display_position(position) for position in problem.numbered]
    assert shown[:6] == [90.0, 60.0, 30.0, 0.0, 330.0, 300.0]
    assert shown[12:] == shown[:12]
    words = get_language("en")
    places = [
        (-270.0, "(position 12)"),
        (90.0, "(position 0)"),
        (67.0, "between positions 0 and 1"),
    ]
    for position, said in places:
        assert said in angle_with_positions(problem, position, "φ = 90°", words)
    (sheet,) = kinematics_sheets(problem, layout="forces-cycle")
    assert {"= 90° (положение 12)", "= 67° (между положениями 0 и 1)"} <= {*sheet_texts(sheet)}
    assert angle_with_positions(read(without_phi(SHAPER)), 228.0, "φ = 228°", words) == "φ = 228°"


def test_a_warning_of_outranked_positions_has_angles_within_a_turn() -> None:
    (said,) = unlikely(read(ENGINE))
    assert "from 90° to 120°" in said and "-600" not in said


def test_the_cycle_of_a_machine_ends_with_position_0() -> None:
    wheel = Flywheel(read(without_phi(SHAPER)))
    assert wheel.turn.numbers(12) == [*range(12), 0]
    (sheet,) = kinematics_sheets(read(without_phi(SHAPER)), layout="flywheel")
    labels = [item.tag for item in sheet.items if isinstance(item, Text)]
    assert not any("position 12" in label for label in labels)


def test_the_table_of_a_driving_machine_has_its_letter_and_sign() -> None:
    flywheel = Flywheel(read(without_phi(ENGINE)))
    tell = MachineNarrator(drawing_of(flywheel, PROFILES["board"]), get_language("ru"))
    heads = [head for head, _, _ in tell.columns()]
    assert tell.moment in heads and heads[3] == "M^{Ж}"
    cells = dict(zip(heads, (cells for _, _, cells in tell.columns()), strict=True))
    assert cells[tell.moment][1].startswith("389") and cells["M^{Ж}"] == cells[tell.moment]
    assert cells[heads[1]][:4] == ["90", "60", "30", "0"]


# Strokes -----------------------------------------------------------------------------------------


def test_the_working_stroke_is_the_one_that_the_load_resists() -> None:
    shaper = strokes_of(Solution(read(without_phi(SHAPER))))
    assert shaper is not None and shaper.by == "load P"
    assert (shaper.working_deg, shaper.idle_deg) == pytest.approx((216.0, 144.0), abs=0.01)
    assert shaper.K_v == pytest.approx(1.5, abs=1e-3)
    press = strokes_of(Solution(read(PRESS + '\n[cycle]\noutput = "B"\n')))
    assert press is not None and press.by == "load P"
    assert press.working_deg == pytest.approx(162.2, abs=0.05)
    assert press.K_v == pytest.approx(1.22, abs=1e-3)


@pytest.mark.parametrize(("way", "working"), [("left", 216.0), ("right", 144.0)])
def test_the_file_outranks_the_load(way: str, working: float) -> None:
    found = strokes_of(
        Solution(read(without_phi(SHAPER), ('zero = "extreme"', f'working = "{way}"')))
    )
    assert found is not None and found.by == "[cycle] working"
    assert found.working_deg == pytest.approx(working, abs=0.01)


def test_without_loads_the_longer_stroke_works() -> None:
    problem = replace(read(without_phi(SHAPER)), dynamics=None, machine=None)
    found = strokes_of(Solution(problem))
    assert found is not None and found.by == "longer stroke"
    assert found.working_deg == pytest.approx(216.0, abs=0.01)


def test_zero_may_be_where_the_working_stroke_starts() -> None:
    problem = read(without_phi(SHAPER), ('"extreme"', '"working"'))
    found = strokes_of(Solution(problem))
    assert found is not None and problem.numbered[0] == pytest.approx(found.start_deg)
    assert problem.numbered[0] == pytest.approx(342.0, abs=0.01)


def test_without_zero_position_0_starts_the_working_stroke_where_it_is_known() -> None:
    line = 'zero = "extreme"\n'
    assert read(without_phi(SHAPER), (line, "")).numbered[0] == pytest.approx(342.0, abs=0.01)
    right = read(without_phi(SHAPER), (line, 'working = "right"\n'))
    assert right.numbered[0] == pytest.approx(198.0, abs=0.01)
    alone = without_phi(SHAPER)[: without_phi(SHAPER).index("[dynamics.links.1]")]
    assert read(alone, (line, "")).numbered[0] == pytest.approx(198.0, abs=0.01)
    assert read(without_phi(SHAPER)).numbered[0] == pytest.approx(198.0, abs=0.01)


def test_a_cycle_without_a_count_has_as_many_positions_as_the_driver() -> None:
    six = ("count = 12 }", "count = 6 }")
    assert len(read(SHAPER, six, ('constant = "driving"\ncount = 12', "")).numbered) == 6
    assert len(read(SHAPER, six, ('constant = "driving"\ncount = 12', "count = 8")).numbered) == 8
    half = ("phi = { from = 0, count = 12 }", "phi = { from = 0, to = 150, step = 30 }")
    assert len(read(SHAPER, half).numbered) == 12


def test_a_driving_load_works_where_it_gives_the_most() -> None:
    found = strokes_of(Solution(read(without_phi(ENGINE))))
    assert found is not None and found.by == "load P"
    assert found.start_deg % 360.0 == pytest.approx(90.0)


def test_a_sense_that_the_output_has_not_is_a_fault() -> None:
    with pytest.raises(ProblemError, match=r"cycle.working: C slides: it does not turn"):
        read(SHAPER, ('zero = "extreme"', 'working = "ccw"'))
    with pytest.raises(ProblemError, match=r"C does not move in this direction on either stroke"):
        read(SHAPER, ('zero = "extreme"', 'working = "up"'))


# Accelerations -----------------------------------------------------------------------------------


def test_with_an_epsilon_the_table_and_the_sheet_have_both_parts() -> None:
    problem = read(EPSILON)
    told = cycle_record(Solution(problem))
    assert told["acceleration"][2] == pytest.approx(55.60, abs=0.01)
    assert told["acceleration_even"][2] == pytest.approx(23.53, abs=0.01)
    at = Solution(problem, positions=[told["positions_deg"][2]])
    assert abs(at.points["E"].acceleration[0]) == pytest.approx(told["acceleration"][2], abs=1e-9)
    (sheet,) = kinematics_sheets(problem, layout="coursework")
    texts = sheet_texts(sheet)
    assert {"23,53", "55,60"} <= set(texts)
    assert any("показано ускорение при постоянной" in text for text in texts)


# Loads over an arc -------------------------------------------------------------------------------


def test_a_load_over_the_path_of_a_rocker_is_over_its_arc() -> None:
    table = 'force = { law = "table", values = [[89.68, 0], [264.8, 40000]] }'
    ramp = 'force = { law = "path", values = [[0, 0], [1, 40000]] }'
    problem = read(CRUSHER, (table, ramp))
    stroke = CycleMotion(problem).stroke("K")
    assert np.degrees(stroke.swing) == pytest.approx(-3.7117, abs=1e-3)
    work = 0.5 * 40000 * abs(stroke.swing) * 0.6
    assert Flywheel(problem).work_per_cycle == pytest.approx(work, rel=1e-9)
