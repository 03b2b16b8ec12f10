"""Forces over the path of the driver: requested positions, curves between them, jumps, gaps."""

from __future__ import annotations

import numpy as np
import pytest
from doors import (
    Complexes,
    CycleForces,
    DriverPath,
    PlanMethodError,
    ReadingReals as Reals,
    Solution,
    statics_of,
    without_corners,
)
from loaded import loaded_problem
from worked import path_of, problem_of

from planmethod import loads

TURN = [30.0 * k for k in range(12)]
RESISTANCE = "force = 2000 # Н\nangle = -90"


def task12(extra: str) -> Solution:
    """Return a whole turn of task 12 whose resistance has something more."""
    text = path_of("levers/task12").read_text("utf-8")
    assert text.count(RESISTANCE) == 1
    return Solution(loads(text.replace(RESISTANCE, extra), name="task12"), positions=TURN)


def exactly(solution: Solution, position: float) -> Solution:
    return Solution(solution.problem, positions=[position])


def sampled(cycle: CycleForces) -> list[tuple[float, complex]]:
    return [
        (float(p), complex(v))
        for piece in cycle.balance
        for p, v in zip(piece.positions, piece.values, strict=True)
    ]


@pytest.mark.parametrize("name", ["levers/task12", "press/press", "press/press-stone"])
def test_curves_go_through_the_requested_positions_and_are_exact_between(name: str) -> None:
    solution = Solution(problem_of(name), positions=[12.0 + phi for phi in TURN])
    cycle = CycleForces(solution)
    assert cycle.smooth and cycle.course.closed
    for number, joint in enumerate(cycle.joints):
        (piece,) = cycle.force(number)
        assert piece.positions[0] == 12.0 and piece.positions[-1] == 372.0
        assert np.diff(piece.positions).max() <= 1.0 + 1e-9
        at = {float(p): complex(v) for p, v in zip(piece.positions, piece.values, strict=True)}
        largest = max(abs(one.force).max() for one in cycle.joints)
        for position, force in zip(solution.positions, joint.force, strict=True):
            assert at[float(position)] == pytest.approx(complex(force), abs=1e-12 * largest)
        assert at[372.0] == pytest.approx(at[12.0], abs=1e-9 * largest)
        k = len(piece.positions) // 3
        alone = statics_of(exactly(solution, float(piece.positions[k]))).reactions[number]
        assert piece.values[k] == pytest.approx(complex(alone.force[0]), abs=1e-9 * largest)


def test_a_load_with_a_phase_leaves_gaps_where_it_begins_and_ends() -> None:
    cycle = CycleForces(task12(f"{RESISTANCE}\nphases = {{ phi = [100.5, 203.25] }}"))
    pieces = cycle.balance
    assert len(pieces) == 3
    for (before, after), jump in zip(
        [(pieces[0], pieces[1]), (pieces[1], pieces[2])], (100.5, 203.25), strict=True
    ):
        assert before.positions[-1] <= jump <= after.positions[0]
        assert after.positions[0] - before.positions[-1] < 1e-3
        # By the change of the load: other changes are negligible in so small a step.
        with_load, without = (
            statics_of(exactly(task12(text), jump)).balance[0]
            for text in (RESISTANCE, RESISTANCE.replace("2000", "0"))
        )
        change = abs(after.values[0] - before.values[-1])
        assert change == pytest.approx(abs(with_load - without), rel=1e-3)


def test_a_step_of_a_table_jumps_and_its_slopes_do_not() -> None:
    step = (
        'angle = -90\nforce = { over = "phi", interpolation = "KIND", '
        "values = [[0, 0], [45, 2000], [46, 1000], [300, 0]] }"
    )
    jumps = [
        piece.positions[0] for piece in CycleForces(task12(step.replace("KIND", "step"))).balance
    ]
    assert jumps == pytest.approx([0.0, 45.0, 46.0, 300.0], abs=1e-3)
    assert len(CycleForces(task12(step.replace("KIND", "linear"))).balance) == 1


def test_a_resistance_that_turns_is_a_position_alone() -> None:
    """A load against the velocity is zero in the dead position, and large on both sides of it."""
    text = f"force = 2000\nagainst = {chr(34)}velocity{chr(34)}"
    problem = task12(text).problem
    speed = [
        complex(exactly(task12(text), phi).points["E"].velocity[0]).imag for phi in (200.0, 300.0)
    ]
    assert speed[0] * speed[1] < 0
    low, high = 200.0, 300.0
    for _ in range(60):
        middle = (low + high) / 2
        sign = complex(Solution(problem, positions=[middle]).points["E"].velocity[0]).imag
        low, high = (middle, high) if sign * speed[0] > 0 else (low, middle)
    cycle = CycleForces(Solution(problem, positions=[200.0, 240.0, low, 280.0, 300.0]))
    pieces = [piece for piece in cycle.balance if piece.positions[0] <= low <= piece.positions[-1]]
    assert len(cycle.balance) in (2, 3) and pieces
    turning = cycle.balance[1 if len(cycle.balance) == 3 else 0]
    assert turning.positions[-1] == pytest.approx(low, abs=1e-3)
    peak = cycle.peak(0)
    sizes = [abs(v) for piece in cycle.force(0) for v in piece.values]
    assert peak.size == max(sizes)


def test_a_steep_force_is_no_jump() -> None:
    """Task 12 goes near a dead position: its forces rise ten times within thirty degrees."""
    solution = Solution(problem_of("levers/task12"), positions=TURN)
    balance = [value.real for _, value in sampled(CycleForces(solution))]
    assert np.abs(np.diff(balance)).max() > 0.02 * np.abs(balance).max()
    assert len(CycleForces(solution).balance) == 1


def test_a_load_known_in_its_positions_only_has_chords() -> None:
    values = [100.0 * k for k in range(12)]
    text = f'angle = -90\nforce = {{ over = "position", values = {values} }}'
    whole = path_of("levers/task12").read_text("utf-8").replace(RESISTANCE, text)
    problem = loads(whole.replace("phi = 245 ", "phi = { from = 0, count = 12 } "), name="task12")
    solution = Solution(problem)
    cycle = CycleForces(solution)
    assert not cycle.smooth
    (piece,) = cycle.balance
    assert piece.positions.tolist() == [*TURN, 360.0]
    assert piece.values.real.tolist() == [
        *statics_of(solution).balance,
        statics_of(solution).balance[0],
    ]


def test_positions_between_that_do_not_exist_are_gaps() -> None:
    """The six-link mechanism closes from 130° to 305° only: between 305° and 490° it does not."""
    solution = Solution(problem_of("levers/six-link"), positions=[280.0, 300.0, 500.0, 520.0])
    before, after = CycleForces(solution).balance
    assert 300.0 <= before.positions[-1] < after.positions[0] <= 500.0
    for position in (before.positions[-1] + 2.0, after.positions[0] - 2.0):
        with pytest.raises(PlanMethodError):
            _ = statics_of(exactly(solution, float(position))).balance


@pytest.mark.parametrize("seed", range(12))
def test_random_mechanisms(seed: int) -> None:
    """Ranges around the pose, falling as well: a slider drives some of them."""
    problem, _ = loaded_problem(seed)
    drive = problem.drive
    step = (
        2.0
        if drive.is_crank
        else 0.01 * max((length for _, _, length in problem.lengths), default=0.1)
    )
    asked = [float(drive.positions[0]) - k * step for k in range(4)]
    try:
        solution = Solution(problem, positions=asked)
        balance = statics_of(solution).balance
    except PlanMethodError:
        pytest.skip("the mechanism does not reach so far from its pose")
    cycle = CycleForces(solution)
    assert not cycle.course.closed
    found = dict(sampled(cycle))
    for position, value in zip(asked, balance, strict=True):
        assert found[position] == pytest.approx(value, rel=1e-9, abs=1e-9 * np.abs(balance).max())


def test_the_course_keeps_the_requested_positions() -> None:
    solution = Solution(problem_of("levers/task12"), positions=[10.0, 10.0, 40.0, 25.0])
    course = DriverPath(solution, step=1.0, min_steps=120)
    assert course.drawn.tolist() == [10.0, 25.0, 40.0] and not course.closed
    assert set(course.drawn) <= set(course.positions)
    assert len(course.positions) == 121


@pytest.mark.parametrize("name", ["levers/task-49", "levers/task-1"])
def test_a_curve_has_no_corner_that_is_seen(name: str) -> None:
    """Halfway between its points a reaction is on the chord, to a thousandth of its largest."""
    cycle = CycleForces(Solution(problem_of(name), positions=TURN))
    halves = np.unique((cycle.positions[1:] + cycle.positions[:-1]) / 2)
    between = statics_of(cycle.solution.with_positions(halves.tolist())).reactions
    for number, joint in enumerate(between):
        (piece,) = cycle.force(number)
        start, chord = piece.values[:-1], np.diff(piece.values)
        off = np.abs(((joint.force - start) * chord.conj()).imag) / np.maximum(np.abs(chord), 1e-9)
        assert off.max() < 1e-3 * np.abs(piece.values).max()


def spike(positions: Reals) -> Complexes:
    """Return a hodograph that turns round within a degree, at 100.4."""
    return np.exp(1j * np.arctan((positions - 100.4) / 0.4))[np.newaxis]


def test_positions_are_added_at_the_corners_alone() -> None:
    even = np.linspace(0.0, 360.0, 361)
    positions, rows, jumps = without_corners(even, spike(even), spike)
    assert set(even) < set(positions) and len(jumps) == len(positions) - 1
    added = np.setdiff1d(positions, even)
    assert 10 < len(added) < 150 and np.abs(added - 100.4).max() < 15.0
    way, chord = spike((positions[1:] + positions[:-1]) / 2)[0] - rows[0, :-1], np.diff(rows[0])
    assert (np.abs((way * chord.conj()).imag) / np.abs(chord)).max() < 1e-3


def test_no_position_is_added_at_a_jump() -> None:
    even = np.linspace(0.0, 360.0, 361)
    jump = np.where(even < 180.0, 1.0 + 0j, 5j)[np.newaxis]
    positions, _, jumps = without_corners(even, jump, spike, np.abs(np.diff(jump[0])) > 1.0)
    assert np.array_equal(positions, even) and jumps.sum() == 1
