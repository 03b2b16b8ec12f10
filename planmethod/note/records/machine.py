"""Machine-readable records of a machine with its flywheel, and of static balancing."""

from __future__ import annotations

from math import degrees, isinf, pi
from typing import Any

import numpy as np

from planmethod.construct.drafting import Profile
from planmethod.note.accounts.drive_chain import shaft_record
from planmethod.note.narrate.balancing import COUNT
from planmethod.note.numbers import record_float
from planmethod.note.series import compared_flywheel, compared_moment
from planmethod.problem.machine_records import Quadrature
from planmethod.solved.machine.balancing import SAMPLES, balancing_of
from planmethod.solved.machine.chain import check_module, machine_chain, rotor_inertia
from planmethod.solved.machine.drawing import FlywheelDrawing, drawing_of, split
from planmethod.solved.machine.flywheel import (
    Flywheel,
    SpeedExtreme,
    adopted,
    machine_power,
    size_of,
)
from planmethod.solved.machine.runup import MAX_CYCLES, RunUp, TimeMotion, run_up_of
from planmethod.solved.reading import Complexes
from planmethod.solved.solution import Solution


def machine_record(flywheel: Flywheel, profile: Profile) -> dict[str, Any]:
    """Return the data of a machine as plain data, SI, full precision.

    Moments are positive where they resist; speeds and the derivative of the inertia are along the
    turning of the crank. A flywheel that is not needed is null, and ``reason`` says so.
    """
    machine, rows, middle = flywheel.machine, flywheel.rows, flywheel.middle_speed
    drawing = drawing_of(flywheel, profile)
    highest, lowest = flywheel.integrated
    lever = flywheel.lever(machine.count)
    rotor = rotor_inertia(flywheel)  # a part of J_f that is not made
    sizes = size_of(machine.wheel, flywheel.exact.inertia - rotor, middle)
    told = size_of(machine.wheel, drawing.adopted - rotor, middle)
    wheel = None if told is None else adopted(machine.wheel, told)
    columns = {
        "phi_deg": rows.phi_deg,
        "M": rows.moment,
        "A": rows.work,
        "dT": rows.gain,
        "J": rows.inertia,
        "dJ": rows.slope,
        "omega": rows.omega,
        "epsilon": rows.epsilon,
        "M_lever": lever,
    }
    half = flywheel.problem.drive.rate**2 / 2.0
    terms = {
        "M_loads": rows.parts.loads,
        "T_links": {link: half * share for link, share in rows.parts.links.items()},
    }
    columns |= {"M_weights": rows.parts.weights, "T": half * rows.inertia}
    if drawing.by_mertsalov:
        second = flywheel.links_energy(rows.inertia)
        columns |= {"T_II": second, "dT_I": rows.gain - second}
    power = machine_power(flywheel)
    return {
        "delta": machine.delta,
        "mean": machine.mean.value,
        "constant": machine.constant.value,
        "signs": machine.signs.value,
        "cycle_deg": machine.cycle_deg,
        "phi_0_deg": record_float(flywheel.turn.start_deg),
        "omega_mean": record_float(middle),
        "M_constant": record_float(flywheel.constant),
        "work_per_turn": record_float(flywheel.work_per_cycle / machine.turns),
        "work_per_cycle": record_float(flywheel.work_per_cycle),
        "power": {
            "crank": record_float(power.at_crank),
            **{
                name: None if value is None else record_float(value)
                for name, value in (
                    ("efficiency", power.efficiency),
                    ("motor", power.at_motor),
                    ("rated", power.rated),
                )
            },
        },
        "positions": [
            {
                "number": number,
                **{name: record_float(column[k]) for name, column in columns.items()},
                **{
                    name: {key: record_float(one[k]) for key, one in own.items()}
                    for name, own in terms.items()
                },
            }
            for number, k in sorted(
                (number, k) for k, number in enumerate(flywheel.turn.numbers(machine.count)[:-1])
            )
        ],
        "J_f": _inertias(flywheel, drawing),
        "omega_max": _extreme(flywheel, highest),
        "omega_min": _extreme(flywheel, lowest),
        "delta_reached": record_float(flywheel.delta_reached),
        **_segment(drawing),
        "scales": {
            "mu_phi": record_float(drawing.scales.phi),
            "mu_M": record_float(drawing.scales.moment),
            "mu_A": record_float(drawing.scales.work),
            "mu_T": record_float(drawing.scales.work),
            "mu_J": record_float(drawing.scales.inertia),
            "pole_mm": record_float(drawing.pole),
        },
        "flywheel": None
        if sizes is None or wheel is None
        else {
            "shape": sizes.shape.value,
            "J": record_float(sizes.inertia),
            "D": record_float(sizes.diameter),
            **({"D_1": record_float(sizes.bore)} if sizes.bore else {}),
            "m": record_float(sizes.mass),
            "b": record_float(sizes.width),
            "rim_speed": record_float(sizes.speed),
            "held_by_speed": sizes.is_speed_limited,
            "adopted": {
                "J": record_float(wheel.inertia),
                "D": record_float(wheel.diameter),
                **({"D_1": record_float(wheel.bore)} if wheel.bore else {}),
                "m": record_float(wheel.mass),
                "b": record_float(wheel.width),
                "rim_speed": record_float(wheel.speed),
            },
        },
        **_chain(flywheel),
        **run_up_record(flywheel),
    }


def _chain(flywheel: Flywheel) -> dict[str, Any]:
    """Return motors, stages and both shafts of the flywheel; nothing without ``[[motors]]``."""
    chain = machine_chain(flywheel, flywheel.exact.inertia)
    if chain is None:
        return {}
    chosen = chain.chosen
    return {
        "chain": {
            "motors": [
                {
                    "name": one.motor.name,
                    "power": one.motor.power,
                    "n": one.motor.speed,
                    "n_sync": one.motor.synchronous,
                    "J": one.motor.inertia,
                    "ratio": record_float(one.ratio),
                    "n_crank": None if one.speed is None else record_float(one.speed),
                    "enough_power": one.is_strong,
                    "suitable": one.is_suitable,
                }
                for one in chain.offers
            ],
            "chosen": None if chosen is None else chosen.motor.name,
            "n_crank": record_float(chain.crank_speed),
            "ratio": None if chain.ratio is None else record_float(chain.ratio),
            "stages": [
                {
                    "wheels": list(labels),
                    "z": list(teeth),
                    "module_mm": None if module is None else record_float(module * 1000),
                    "row": None if module is None else check_module(module).row or None,
                }
                for labels, teeth, module in chain.stages
            ],
            "J_rotor": record_float(chain.rotor),
            "slow": shaft_record(chain.slow),
            "fast": shaft_record(chain.fast),
            "flywheel_on": None
            if chain.lighter is None
            else "fast"
            if chain.lighter is chain.fast
            else "slow",
        }
    }


def _segment(drawing: FlywheelDrawing) -> dict[str, float]:
    """Return the segment that the flywheel is found by, and its ends over the axis, mm."""
    made, exact = drawing.construction, drawing.exact
    corner = exact.point(made.axes["T_I" if drawing.by_mertsalov else "E"].origin)[0]
    angles = {} if drawing.by_mertsalov else {"max": drawing.psi[0], "min": drawing.psi[1]}
    ends = zip(made.letters, (made.upper, made.lower), strict=True)
    return {
        **{f"psi_{name}_deg": record_float(psi) for name, psi in angles.items()},
        f"{made.segment}_mm": record_float(exact.number(made.segment)[0]),
        **{
            f"{letter}_mm": record_float((exact.point(end)[0] - corner).imag)
            for letter, end in ends
        },
    }


# no messages: reasons in JSON
def _inertias(flywheel: Flywheel, drawing: FlywheelDrawing) -> dict[str, Any]:
    """Return the flywheel by every way, kg·m²; null where none is needed."""
    machine, middle = flywheel.machine, flywheel.middle_speed
    delta, both = machine.delta, compared_flywheel(drawing)
    slopes = {
        "wittenbauer": (1.0 + delta, 1.0 - delta),
        "mertsalov": (1.0, 1.0),
        "J_ignored": (0.0, 0.0),
    }
    usual = flywheel.usual_slopes

    def positive_or_none(value: float) -> float | None:
        return record_float(value) if value > 0.0 else None

    points = {
        f"{name}_{count}": positive_or_none(flywheel.by_points(count, way, usual).tangents.inertia)
        for count in dict.fromkeys((machine.count, 12, 24, 36))
        for name, way in (("middle", Quadrature.MIDDLE), ("trapezoid", Quadrature.TRAPEZOID))
    }
    parts = split(drawing)
    reason = "" if both.exact > 0.0 else "the machine is even enough without a flywheel"
    return {
        "exact": positive_or_none(both.exact),
        **({"reason": reason} if reason else {}),
        **{
            name: positive_or_none(flywheel.tangents(*pair, middle).inertia)
            for name, pair in slopes.items()
        },
        "construction": positive_or_none(drawing.inertia),
        "n": machine.count,
        "method": machine.method.value,
        "ordinates": machine.ordinates.value,
        "read": positive_or_none(both.read),
        "sigma": record_float(both.sigma),
        "by_points": points,
        "split": {
            "slopes": record_float(parts.slopes),
            "method": record_float(parts.method),
            "positions": record_float(parts.positions),
            "pencil": record_float(parts.pencil),
        },
    }


def _extreme(flywheel: Flywheel, extreme: SpeedExtreme) -> dict[str, float]:
    position = extreme.rotation / flywheel.cycle * flywheel.machine.count
    phi = flywheel.turn.phi(np.array([extreme.rotation]))[0]
    return {
        "value": record_float(extreme.value),
        "phi_deg": record_float(phi),
        "position": record_float(position),
    }


_ROWS = 25


# no messages: reasons in JSON
def run_up_record(flywheel: Flywheel) -> dict[str, Any]:
    """Return motor, run-up and stop, SI and degrees; null where the file has neither of them.

    What cannot be has ``time`` null, and ``reason`` says why.
    """
    machine = flywheel.machine
    if machine.motor is None and machine.brake is None:
        return {"motor": None, "run_up": None, "stop": None}
    run = run_up_of(flywheel)
    why = _failure_text(run) if machine.motor is not None else ""
    never = why or f"the crank still turns after {MAX_CYCLES} cycles: give [machine] brake"
    stop = _time_record(run.stop, flywheel, never)
    if machine.motor is None:
        return {"motor": None, "run_up": None, "stop": stop | {"brake": machine.brake or 0.0}}
    motor: dict[str, Any] = {
        "kind": "line" if machine.motor.critical_slip is None else "kloss",
        "omega_idle": record_float(machine.motor.idle),
        "moment": record_float(machine.motor.moment),
        "s_k": machine.motor.critical_slip,
    }
    names = ("omega_max", "omega_min", "omega_mean", "delta", "J_f")
    if why:
        motor |= {**dict.fromkeys(names), "reason": why}
    else:
        high, low = run.steady(flywheel.steady_inertia).extremes
        even = run.irregularity(flywheel.steady_inertia)
        wanted = run.required_inertia
        values = (high, low, (high + low) / 2.0, even, wanted)
        motor |= {
            name: None if value is None else record_float(value)
            for name, value in zip(names, values, strict=True)
        }
        if wanted is None:
            motor["reason"] = "the machine is even enough without a flywheel"
    return {
        "motor": motor,
        "run_up": _time_record(None if why else run.run_up, flywheel, why),
        "stop": stop | {"brake": machine.brake or 0.0},
    }


# no messages: reasons in JSON
def _failure_text(run: RunUp) -> str:
    failure, motor = run.failure, run.machine.motor
    assert motor is not None
    if failure is None:
        return ""
    if isinf(failure.time):
        return f"the motion is not steady after {MAX_CYCLES} cycles"
    if not failure.rotation:
        resists = float(run.flywheel.moment.value([0.0])[0])
        return (
            f"the motor does not start the machine: at rest it has {motor.at(0.0):.6g} N·m, "
            f"position 0 resists with {resists:.6g} N·m"
        )
    return (
        f"the motor does not hold the load: the crank stands at {failure.time:.6g} s, "
        f"{degrees(failure.rotation):.6g} degrees from position 0; give it more moment"
    )


def _time_record(course: TimeMotion | None, flywheel: Flywheel, reason: str) -> dict[str, Any]:
    if course is None:
        return {"time": None, "turned_deg": None, "turns": None, "table": [], "reason": reason}
    time, turned, omega = (column.tolist() for column in course.rows(_ROWS))
    phi = flywheel.turn.phi(course.rows(_ROWS)[1]).tolist()
    return {
        "time": record_float(course.time[-1]),
        "turned_deg": record_float(degrees(turned[-1])),
        "turns": record_float(turned[-1] / (2.0 * pi)),
        "table": [
            {
                "t": record_float(t),
                "turned_deg": record_float(degrees(a)),
                "phi_deg": record_float(p),
                "omega": record_float(w),
            }
            for t, a, p, w in zip(time, turned, phi, omega, strict=True)
        ],
    }


def balancing_record(solution: Solution) -> dict[str, Any]:
    """Return masses, counterweights, forces and centres, SI and degrees.

    Masses in the pins of a rod whose centre of mass is off their line are null.
    """
    made = balancing_of(solution)
    before, after = made.forces(COUNT)
    off_line = abs(made.share.imag) > 1e-9 * max(abs(made.share), 1.0)
    weights = []
    for number, one in enumerate(made.counterweights):
        both = compared_moment(made, number, solution.profile)
        weights.append(
            {
                "link": one.link,
                "about": one.pivot,
                "line": one.pivot + one.pin,
                "terms": {name: _vector(value) for name, value in one.terms},
                "mr": record_float(both.exact),
                "mr_read": record_float(both.read),
                "r": record_float(one.radius),
                "m": record_float(one.mass),
                "angle_deg": record_float(one.angle_deg),
            }
        )
    return {
        "structure": made.structure,
        "method": made.task.method.value,
        "share": made.task.share,
        "rod": {
            "link": made.rod,
            **{
                pin: None if off_line else record_float(mass.real)
                for pin, mass in zip((made.crank_pin, made.rod_pin), made.rod_masses, strict=True)
            },
            **({"reason": "its centre of mass is off the line of its pins"} if off_line else {}),
        },
        "counterweights": weights,
        "mass": {"before": record_float(made.mass_before), "after": record_float(made.mass_after)},
        "force": {
            name: _largest(column, made.phi(SAMPLES))
            for name, column in zip(("before", "after"), made.forces(SAMPLES), strict=True)
        },
        "centre": {
            name: {
                "x": [record_float(np.min(column.real)), record_float(np.max(column.real))],
                "y": [record_float(np.min(column.imag)), record_float(np.max(column.imag))],
            }
            for name, column in zip(("before", "after"), made.centres(SAMPLES), strict=True)
        },
        "positions": [
            {"phi_deg": record_float(phi), "before": _vector(one), "after": _vector(two)}
            for phi, one, two in zip(made.phi(COUNT), before, after, strict=True)
        ],
    }


def _vector(value: complex) -> dict[str, float]:
    return {"x": record_float(value.real), "y": record_float(value.imag)}


def _largest(column: Complexes, phi: Any) -> dict[str, float]:
    at = int(np.argmax(np.abs(column)))
    return {"max": record_float(abs(column[at])), "phi_deg": record_float(phi[at])}
