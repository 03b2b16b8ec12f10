"""The text of a run-up and a stop: the motor, times and angles, tables (разбег и останов)."""

from __future__ import annotations

from math import degrees, isinf, pi

from planmethod.note.narrate.machine import MachineTeller
from planmethod.note.numbers import alike
from planmethod.solved.machine.runup import MOST_CYCLES, NEAR, Course, RunUp, run_up_of

ROWS = 13
"""Rows of a table of a run-up or a stop."""


def asks_run_up(tell: MachineTeller) -> bool:
    """Whether the file has a motor or a brake."""
    machine = tell.flywheel.machine
    return machine.motor is not None or machine.brake is not None


def motor_line(tell: MachineTeller) -> list[str]:
    """Return the motor's characteristic with numbers."""
    motor, say = tell.flywheel.machine.motor, tell.say
    if motor is None:
        return []
    slip = motor.critical_slip
    said = tell.said.line if slip is None else tell.said.kloss
    places = {
        "M": tell.letter("motor moment"),
        "moment": f"{say.found(motor.moment)} {tell.unit('N·m')}",
        "slip": "" if slip is None else say.found(slip),
        "idle": f"{say.found(motor.idle)} {tell.unit('1/s')}",
    }
    return [said.format(**places)]


def run_up_lines(tell: MachineTeller) -> list[str]:
    """Return the run-up, the steady motion with the motor, and the stop, with numbers."""
    run, say, said = run_up_of(tell.flywheel), tell.say, tell.said
    lines = motor_line(tell)
    if tell.flywheel.machine.motor is not None:
        lines += _driven(run, tell)
    places = {
        "M": tell.letter("braking moment"),
        "brake": f"{say.given(run.machine.brake or 0.0)} {tell.unit('N·m')}",
    }
    if run.machine.motor is not None and run.failure is not None:
        return lines
    if run.stop is None:
        return [*lines, said.not_stopped.format(count=MOST_CYCLES)]
    template = said.braked if run.machine.brake else said.coasted
    return [*lines, template.format(**places, **_ends(run.stop, tell))]


def _ends(course: Course, tell: MachineTeller) -> dict[str, str]:
    turned = float(course.turned[-1])
    return {
        "time": f"{tell.say.found(float(course.time[-1]))} {tell.unit('s')}",
        "angle": tell.say.number(f"{degrees(turned):.1f}"),
        "turns": tell.say.number(f"{turned / (2.0 * pi):.2f}"),
    }


def _driven(run: RunUp, tell: MachineTeller) -> list[str]:
    say, said, failure = tell.say, tell.said, run.failure
    unit, per_second = tell.unit("kg·m²"), tell.unit("1/s")
    motor = run.machine.motor
    assert motor is not None
    if failure is not None:
        if isinf(failure.time):
            return [said.not_steady.format(count=MOST_CYCLES)]
        if failure.turned == 0.0:
            moment = float(tell.flywheel.moment.value([0.0])[0])
            places = {
                "M": tell.letter("motor moment"),
                "R": tell.moment,
                "motor": f"{say.found(motor.at(0.0))} {tell.unit('N·m')}",
                "resists": f"{say.found(moment)} {tell.unit('N·m')}",
            }
            return [said.stays.format(**places)]
        time = f"{say.found(failure.time)} {tell.unit('s')}"
        angle = say.number(f"{degrees(failure.turned):.1f}")
        return [said.stalled.format(time=time, angle=angle)]
    wheel = f"{tell.letter('flywheel')} = "
    fitted, wanted = tell.flywheel.fitted, run.wanted
    high, low = run.steady(fitted).extremes
    lines = [
        said.ran_up.format(
            J=f"{wheel}{say.found(fitted)} {unit}",
            near=say.given(100.0 * NEAR),
            **_ends(run.run_up, tell),
        ),
        said.steady.format(
            high=f"{say.found(high)} {per_second}",
            low=f"{say.found(low)} {per_second}",
            delta=say.number(f"{run.irregularity(fitted):.6f}"),
        ),
    ]
    if wanted is not None:
        found = f"{wheel}{say.found(wanted)} {unit}"
        delta = say.number(f"{run.machine.delta:.6f}")
        lines.append(said.by_motor.format(wanted=delta, J=found))
    return lines


def courses(tell: MachineTeller) -> list[tuple[str, Course]]:
    """Return what there is of run-up and stop, with its title."""
    run, found = run_up_of(tell.flywheel), []
    if run.machine.motor is not None and run.failure is None:
        found.append((tell.said.run_up_table, run.run_up))
    if run.stop is not None:
        found.append((tell.said.stop_table, run.stop))
    return found


def course_columns(course: Course, tell: MachineTeller) -> list[tuple[str, str, list[str]]]:
    """Return a run-up or a stop by even times: heads, units and cells of its columns."""
    time, turned, omega = course.rows(ROWS)
    columns = (("t", "s", time), ("φ", "deg", turned * 180.0 / pi), ("ω", "1/s", omega))
    return [
        (
            head,
            tell.say.in_head(unit),
            [tell.say.number(text) for text in alike(values.tolist(), 5)],
        )
        for head, unit, values in columns
    ]
