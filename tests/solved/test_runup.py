"""Run-up, steady motion with a motor and stop: against the equation of motion over time."""

from __future__ import annotations

import json
from collections.abc import Callable
from math import pi

import numpy as np
import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    DRAFTING_PROFILES as PROFILES,
    STEADY_SPEED_TOLERANCE,
    Flywheel,
    ProblemError,
    RunUp,
    StalledError,
    cli,
    machine_record,
    problem_load as load,
    problem_loads as loads,
)
from worked import path_of

PRESS = path_of("press/flywheel").read_text("utf-8").partition("[variants")[0]


def press(motor: str, brake: str = "20") -> RunUp:
    text = PRESS.replace("count = 12", f"count = 12\nmotor = {motor}\nbrake = {brake}")
    return RunUp(Flywheel(loads(text, name="press")))


def over_time(
    run: RunUp, omega: float, pull: Callable[[float], float], steps: int, until: float
) -> tuple[float, float]:
    """Return angle and speed after a time by Runge and Kutta's steps of angle and speed."""
    wheel = run.flywheel
    # tables of the cycle, fine enough that straight lines between their rows do
    grid = np.linspace(0.0, wheel.cycle, 40_001)
    columns = [c.value(grid) for c in (wheel.moment, wheel.inertia, wheel.slope)]

    def rate(state: np.ndarray[tuple[int], np.dtype[np.float64]]) -> tuple[float, float]:
        turned, speed = state
        moment, mass, slope = (np.interp(turned % wheel.cycle, grid, c) for c in columns)
        pushed = pull(speed) - moment - speed**2 * slope / 2.0
        return speed, float(pushed / (wheel.steady_inertia + mass))

    state, step = np.array([0.0, omega]), until / steps
    for _ in range(steps):
        one = np.array(rate(state))
        two = np.array(rate(state + step / 2 * one))
        three = np.array(rate(state + step / 2 * two))
        four = np.array(rate(state + step * three))
        state = state + step / 6 * (one + 2 * two + 2 * three + four)
    return float(state[0]), float(state[1])


def test_run_up_and_stop_are_those_of_the_equation_of_motion() -> None:
    run = RunUp(Flywheel(load(path_of("press/flywheel"), variant="motor")))
    motor = run.machine.motor
    assert motor is not None
    course = run.run_up
    turned, omega = over_time(run, 0.0, motor.at, 1500, float(course.time[-1]))
    assert turned == pytest.approx(float(course.rotation[-1]), rel=2e-5)
    assert omega == pytest.approx(float(course.omega[-1]), rel=2e-5)
    steady = run.steady(run.flywheel.steady_inertia)
    there = steady.at(np.mod(course.rotation[-1:], 2 * pi))[0]
    assert abs(float(course.omega[-1] / there[0]) - 1.0) == pytest.approx(
        STEADY_SPEED_TOLERANCE, rel=0.1
    )
    stop = run.stop
    assert stop is not None
    turned, omega = over_time(run, float(stop.omega[0]), lambda _: -20.0, 500, float(stop.time[-1]))
    assert turned == pytest.approx(float(stop.rotation[-1]), rel=1e-4)
    assert abs(omega) < 2e-3


def test_a_flywheel_for_a_motor_keeps_delta() -> None:
    run = press("{ line = { M_start = 60, n_idle = 145 } }")
    assert run.required_inertia is not None
    assert run.irregularity(run.required_inertia) == pytest.approx(1 / 18, abs=1e-9)
    steady = run.steady(run.required_inertia)
    assert steady.half[0] == pytest.approx(steady.half[-1], rel=1e-11)
    # the motor's work in a cycle is that of the loads
    at = np.linspace(0.0, run.flywheel.cycle, 4001)
    motor = run.machine.motor
    assert motor is not None
    moments = np.array([motor.at(speed) for speed in steady.at(at)[0].tolist()])
    done = np.sum(np.diff(at) * (moments[1:] + moments[:-1]) / 2)
    assert done == pytest.approx(run.flywheel.work_per_cycle, rel=1e-5)


def test_the_plate_of_a_motor_gives_its_characteristic() -> None:
    plate = "{ kloss = { P_nom = 1100, n_nom = 920, n_sync = 1000, lambda = 2.2 }, ratio = 7 }"
    motor = press(plate).machine.motor
    assert motor is not None
    nominal = 920 * pi / 30 / 7
    assert motor.at(nominal) == pytest.approx(1100 / nominal)
    assert motor.moment == pytest.approx(2.2 * 1100 / nominal)
    assert motor.at(motor.idle * (1 - (motor.critical_slip or 0))) == pytest.approx(motor.moment)
    assert motor.at(motor.idle) == 0.0


def test_a_motor_that_is_too_weak_is_reported() -> None:
    weak = press("{ line = { M_start = 3, n_idle = 145 } }")
    assert isinstance(weak.failure, StalledError)
    assert weak.failure.rotation > 0.0
    assert weak.stop is None
    coasts = press("{ line = { M_start = 60, n_idle = 145 } }", "0")
    assert coasts.stop is not None
    assert coasts.stop.time[-1] > 3.0


@each(
    "message, motor",
    {
        "machine.motor: expected kloss or line, one of them": "{}",
        "expected M_max, s_k, n_sync or P_nom, n_nom, n_sync, lambda; got M_max": (
            "{ kloss = { M_max = 5 } }"
        ),
        "the motor is driven at 1500 rev/min": (
            "{ line = { M_nom = 5, n_nom = 1500, n_idle = 1500 } }"
        ),
        "machine.motor.kloss.lambda: expected more than 1, got 1": (
            "{ kloss = { P_nom = 5, n_nom = 900, n_sync = 1000, lambda = 1 } }"
        ),
        "machine.motor.klos: unknown key. Did you mean 'kloss'?": "{ klos = 1 }",
        "machine.motor.line: expected a table": "{ line = 5 }",
        "machine.motor: expected a table": "5",
    }.items(),
)
def test_wrong_motors_are_reported(message: str, motor: str) -> None:
    with pytest.raises(ProblemError) as told:
        press(motor)
    assert message in str(told.value)


def test_the_record_and_the_sheet_have_run_up_and_stop() -> None:
    path = str(path_of("press/flywheel"))
    wheel = Flywheel(load(path_of("press/flywheel"), variant="motor"))
    record = machine_record(wheel, PROFILES["board"])
    json.dumps(record, allow_nan=False)
    assert record["run_up"]["time"] == pytest.approx(record["run_up"]["table"][-1]["t"])
    assert record["stop"]["table"][-1]["omega"] == 0.0
    assert record["motor"]["J_f"] < record["J_f"]["exact"]
    lint = CliRunner().invoke(cli, ["lint", path, "--variant", "motor", "--layout", "run-up"])
    assert lint.exit_code == 0, lint.output
