"""``[machine]`` of a problem file: what the choice of a flywheel needs (маховик)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from enum import Enum
from typing import Any, TypeVar

from planmethod.languages import say
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
from planmethod.problem.load_records import (
    Machine,
    Mean,
    Method,
    Motor,
    Ordinates,
    Shape,
    Side,
    Signs,
    Wheel,
)
from planmethod.problem.model import Drive

M = TypeVar("M", bound=Enum)

_EXAMPLE = '[machine] delta = "1/18", constant = "driving"'
_MOST = 72
"""Positions of a construction: what can be drawn on a sheet."""


def read_machine(faults: Faults, given: Mapping[str, Any], drive: Drive | None) -> Machine | None:
    """Read ``[machine]``.

    Parameters
    ----------
    given : mapping
        The whole file.
    drive : Drive or None
        None when it could not be read: then nothing is asked of it.

    Returns
    -------
    Machine or None
        None after noting a fault.
    """
    before = len(faults)
    table = fields.read_table(faults, "machine", given["machine"], _EXAMPLE)
    if table is None:
        return None
    body = fields.read_keys(faults, "machine", table, keys.MACHINE)
    hint = "The cycle of a machine is that of a driving crank: give it phi and n."
    fields.require_turning(
        faults, "machine", drive, hint, "Give its mean speed: [driver] n or omega."
    )
    if not given.get("loads"):
        faults.add("machine", "there are no [[loads]]", "A flywheel evens out their work.")
    delta = _read_delta(faults, body, whole=len(faults) == before)
    cycle = body.get("cycle_deg", 360)
    if not fields.is_number(cycle) or cycle not in (360, 720):
        hint = "720 is for a four-stroke engine."
        faults.expected("machine.cycle_deg", "360 or 720", cycle, hint)
        cycle = 360
    count = fields.read_whole(
        faults, "machine.count", body.get("count", round(cycle / 30)), 4, _MOST
    )
    start = fields.read_angle(faults, "machine.phi_0", body["phi_0"]) if "phi_0" in body else None

    def number(key: str, default: float, what: str, low: float, high: float) -> float:
        value = body.get(key, default)
        found = fields.read_number(faults, f"machine.{key}", value, what, low=low, high=high)
        return default if found is None else found

    def word(key: str, default: M) -> M:
        if key not in body:
            return default
        return fields.read_member(faults, f"machine.{key}", body[key], type(default)) or default

    def scale(key: str, unit: str) -> float | None:
        return number(key, 1.0, say("a scale in {}", unit), 1e-12, 1e12) if key in body else None

    side = word("constant", Side.DRIVING)
    motor = _read_motor(faults, body["motor"]) if "motor" in body else None
    if motor is not None and side is Side.RESISTING:
        hint = 'Leave the motor out, or say constant = "driving".'
        faults.add("machine.motor", "the loads drive already: the constant moment resists", hint)
    brake = number("brake", 0.0, "a moment in N·m", 0.0, 1e12) if "brake" in body else None
    if brake is not None and side is Side.RESISTING:
        hint = "A stop is that of a machine whose loads resist."
        faults.add("machine.brake", "the loads drive: no brake is known to stop them", hint)
    made = Machine(
        delta=delta or 0.5,
        mean=word("mean", Mean.HALF_SUM),
        constant=side,
        cycle_deg=float(cycle),
        crank_inertia=number("J_crank", 0.0, "a moment of inertia in kg·m²", 0.0, 1e12),
        count=count or 12,
        pole_mm=number("pole_mm", 30.0, "a distance in mm", 5.0, 500.0),
        turn_mm=number("turn_mm", 240.0, "a length in mm", 60.0, 1000.0),
        mu_M=scale("mu_M", "N·m/mm"),
        mu_J=scale("mu_J", "kg·m²/mm"),
        signs=word("signs", Signs.TRUE),
        ordinates=word("ordinates", Ordinates.MIDDLE),
        method=word("method", Method.WITTENBAUER),
        start_deg=start,
        wheel=_read_wheel(faults, body.get("flywheel", {})),
        motor=motor,
        brake=brake,
    )
    return None if len(faults) != before else made


def _read_delta(faults: Faults, body: Table, *, whole: bool) -> float | None:
    """Read the irregularity: a number, or a fraction such as ``"1/18"``."""
    if "delta" not in body:
        if whole:
            faults.add("machine.delta", "missing", 'Give the irregularity: delta = "1/18".')
        return None
    value, path = body["delta"], "machine.delta"
    if isinstance(value, str):
        top, slash, bottom = value.partition("/")
        try:
            value = float(top) / float(bottom) if slash else float(top)
        except (ValueError, ZeroDivisionError):
            value = math.nan
    if not fields.is_number(value) or not math.isfinite(value):
        message = say(
            'expected a number or a fraction such as "1/18", got {}', fields.show(body["delta"])
        )
        faults.add(path, message, "A decimal fraction has a point: 0.05.")
        return None
    if not 0.0 < value < 1.0:
        hint = "delta = (omega_max - omega_min)/omega_mean: from 1/5 (pumps) to 1/300 (generators)."
        faults.add(path, say("expected an irregularity between 0 and 1, got {:g}", value), hint)
        return None
    return float(value)


def _read_wheel(faults: Faults, value: object) -> Wheel:
    path = "machine.flywheel"
    table = fields.read_table(faults, path, value, 'flywheel = { shape = "rim", speed = 30 }')
    body = fields.read_keys(faults, path, table or {}, keys.FLYWHEEL)
    found: dict[str, Any] = {}
    if "shape" in body:
        found["shape"] = (
            fields.read_member(faults, f"{path}.shape", body["shape"], Shape) or Shape.DISC
        )
    for key, what, low, high in (
        ("density", "a density in kg/m³", 100.0, 3e4),
        ("speed", "a speed in m/s", 0.1, 1e3),
        ("ratio", "a ratio of speeds", 1e-3, 1e3),
    ):
        if key in body:
            found[key] = fields.read_number(
                faults, f"{path}.{key}", body[key], what, low=low, high=high
            )
    return Wheel(**{key: item for key, item in found.items() if item is not None})


_MOTOR = "kloss = { M_max = 60, s_k = 0.15, n_sync = 150 }"


def _read_motor(faults: Faults, value: object) -> Motor | None:
    """Read a motor's characteristic, and reduce it to the crank."""
    before, path = len(faults), "machine.motor"
    body = fields.read_keys(
        faults, path, fields.read_table(faults, path, value, _MOTOR) or {}, keys.MOTOR
    )
    given = [form for form in keys.MOTOR_FORMS if form in body]
    if len(faults) == before and len(given) != 1:
        faults.add(path, "expected kloss or line, one of them", say("For example: {}", _MOTOR))
    ratio = fields.read_number(
        faults, f"{path}.ratio", body.get("ratio", 1.0), "a ratio of speeds", low=1e-3, high=1e3
    )
    if len(faults) != before:
        return None
    (form,) = given
    where = f"{path}.{form}"
    table = fields.read_table(faults, where, body[form], _MOTOR)
    known = fields.read_keys(
        faults, where, table or {}, keys.KLOSS if form == "kloss" else keys.LINE
    )
    ways = keys.MOTOR_FORMS[form]
    way = next((names for names in ways if set(names) == set(known)), None)
    if len(faults) == before and way is None:
        asked = say(" or ").join(", ".join(names) for names in ways)
        faults.add(
            where,
            say("expected {}; got {}", asked, ", ".join(known) or say("nothing")),
            "Give all.",
        )
    found = {
        key: fields.read_number(faults, f"{where}.{key}", item, "a number", low=1e-9, high=1e9)
        for key, item in known.items()
    }
    if len(faults) != before or ratio is None:
        return None
    n = {key: item for key, item in found.items() if item is not None}
    idle = n["n_sync"] if form == "kloss" else n["n_idle"]
    slip = 1.0 - n.get("n_nom", 0.0) / idle
    if slip <= 0.0:
        hint = say("Expected less than {:g} rev/min.", idle)
        faults.add(f"{where}.n_nom", say("the motor is driven at {:g} rev/min", n["n_nom"]), hint)
    factor = n.get("lambda", 2.0)
    if factor <= 1.0:
        hint = "lambda = M_max/M_nom, from 1.7 to 3."
        faults.add(f"{where}.lambda", say("expected more than 1, got {:g}", factor), hint)
    if not 0.0 < n.get("s_k", 0.5) < 10.0:
        faults.add(
            f"{where}.s_k", say("expected a slip up to 10, got {:g}", n["s_k"]), "From 0.05 to 1."
        )
    if len(faults) != before:
        return None
    speed = math.pi / 30.0
    critical = None
    if form == "line":
        moment = n["M_start"] if "M_start" in n else n["M_nom"] / slip
    elif "M_max" in n:
        moment, critical = n["M_max"], n["s_k"]
    else:
        moment = factor * n["P_nom"] / (n["n_nom"] * speed)
        critical = slip * (factor + math.sqrt(factor * factor - 1.0))
    return Motor(idle * speed / ratio, moment * ratio, critical)
