"""Machine-readable record of run-up and stop: ``motor``, ``run_up``, ``stop`` of ``machine``."""

from __future__ import annotations

from math import degrees, isinf, pi
from typing import Any

from planmethod.note.numbers import plain
from planmethod.solved.machine.flywheel import Flywheel
from planmethod.solved.machine.runup import MOST_CYCLES, Course, RunUp, run_up_of

_ROWS = 25


def run_up_record(flywheel: Flywheel) -> dict[str, Any]:
    """Return motor, run-up and stop, SI and degrees; null where the file has neither of them.

    What cannot be has ``time`` null, and ``reason`` says why.
    """
    machine = flywheel.machine
    if machine.motor is None and machine.brake is None:
        return {"motor": None, "run_up": None, "stop": None}
    run = run_up_of(flywheel)
    why = _why(run) if machine.motor is not None else ""
    never = why or f"the crank still turns after {MOST_CYCLES} cycles: give [machine] brake"
    stop = _told(run.stop, flywheel, never)
    if machine.motor is None:
        return {"motor": None, "run_up": None, "stop": stop | {"brake": machine.brake or 0.0}}
    motor: dict[str, Any] = {
        "kind": "line" if machine.motor.critical_slip is None else "kloss",
        "omega_idle": plain(machine.motor.idle),
        "moment": plain(machine.motor.moment),
        "s_k": machine.motor.critical_slip,
    }
    names = ("omega_max", "omega_min", "omega_mean", "delta", "J_f")
    if why:
        motor |= {**dict.fromkeys(names), "reason": why}
    else:
        high, low = run.steady(flywheel.fitted).extremes
        even = run.irregularity(flywheel.fitted)
        wanted = run.wanted
        values = (high, low, (high + low) / 2.0, even, wanted)
        motor |= {
            name: None if value is None else plain(value)
            for name, value in zip(names, values, strict=True)
        }
        if wanted is None:
            motor["reason"] = "the machine is even enough without a flywheel"
    return {
        "motor": motor,
        "run_up": _told(None if why else run.run_up, flywheel, why),
        "stop": stop | {"brake": machine.brake or 0.0},
    }


def _why(run: RunUp) -> str:
    failure, motor = run.failure, run.machine.motor
    assert motor is not None
    if failure is None:
        return ""
    if isinf(failure.time):
        return f"the motion is not steady after {MOST_CYCLES} cycles"
    if not failure.turned:
        resists = float(run.flywheel.moment.value([0.0])[0])
        return (
            f"the motor does not start the machine: at rest it has {motor.at(0.0):.6g} N·m, "
            f"position 0 resists with {resists:.6g} N·m"
        )
    return (
        f"the motor does not hold the load: the crank stands at {failure.time:.6g} s, "
        f"{degrees(failure.turned):.6g} degrees from position 0; give it more moment"
    )


def _told(course: Course | None, flywheel: Flywheel, reason: str) -> dict[str, Any]:
    if course is None:
        return {"time": None, "turned_deg": None, "turns": None, "table": [], "reason": reason}
    time, turned, omega = (column.tolist() for column in course.rows(_ROWS))
    phi = flywheel.turn.phi(course.rows(_ROWS)[1]).tolist()
    return {
        "time": plain(course.time[-1]),
        "turned_deg": plain(degrees(turned[-1])),
        "turns": plain(turned[-1] / (2.0 * pi)),
        "table": [
            {"t": plain(t), "turned_deg": plain(degrees(a)), "phi_deg": plain(p), "omega": plain(w)}
            for t, a, p, w in zip(time, turned, phi, omega, strict=True)
        ],
    }
