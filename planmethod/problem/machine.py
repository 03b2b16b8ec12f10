"""``[machine]`` of a problem file: data for the choice of a flywheel (маховик)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from planmethod.languages import translate
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults
from planmethod.problem.flat_tables import read_flat
from planmethod.problem.formula import read_decimal
from planmethod.problem.machine_records import (
    ConstantMoment,
    FlywheelTask,
    KlossSection,
    LineSection,
    Machine,
    Motor,
    MotorSection,
)
from planmethod.problem.model import Drive

_EXAMPLE = '[machine] delta = "1/18", constant = "driving"'


def read_machine(
    faults: Faults, document: Mapping[str, Any], drive: Drive | None
) -> Machine | None:
    """Read ``[machine]``.

    Parameters
    ----------
    document : mapping
        The whole file.
    drive : Drive or None
        None when it could not be read: then it is not checked.

    Returns
    -------
    Machine or None
        None after noting a fault.
    """
    before = len(faults)
    table = fields.read_table(faults, "machine", document["machine"], _EXAMPLE)
    if table is None:
        return None
    hint = "The cycle of a machine is that of a driving crank: give it phi and n."
    fields.require_turning(
        faults, "machine", drive, hint, "Give its mean speed: [driver] n or omega."
    )
    if not document.get("loads"):
        faults.add("machine", "there are no [[loads]]", "A flywheel evens out their work.")
    own = {
        "delta": _read_delta,
        "cycle_deg": _read_cycle,
        "flywheel": _read_wheel,
        "motor": _read_motor,
    }
    found = read_flat(faults, "machine", table, Machine, own)
    found["stated_count"] = found.get("count")
    found.setdefault("count", round(found.get("cycle_deg", 360.0) / 30))
    if found.get("constant") is ConstantMoment.RESISTING:
        if "motor" in found:
            hint = 'Leave the motor out, or say constant = "driving".'
            message = "the loads drive already: the constant moment resists"
            faults.add("machine.motor", message, hint)
        if "brake" in found:
            hint = "A stop is that of a machine whose loads resist."
            faults.add("machine.brake", "the loads drive: no brake is known to stop them", hint)
    return None if len(faults) != before else Machine(**found)


def _read_cycle(faults: Faults, path: str, value: object) -> float | None:
    if fields.is_number(value) and value in (360, 720):
        return float(value)
    faults.expected(path, "360 or 720", value, "720 is for a four-stroke engine.")
    return None


def _read_delta(faults: Faults, path: str, entry: object) -> float | None:
    """Read the coefficient of speed fluctuation: a number, or a fraction such as ``"1/18"``."""
    value = entry
    if isinstance(value, str):
        top, slash, bottom = value.partition("/")
        one, other = read_decimal(top), read_decimal(bottom if slash else "1")
        value = float(one) / float(other) if one is not None and other else math.nan
    if not fields.is_number(value) or not math.isfinite(value):
        message = translate(
            'expected a number or a fraction such as "1/18", got {}', fields.show(entry)
        )
        faults.add(path, message, "A decimal fraction has a point: 0.05.")
        return None
    if not 0.0 < value < 1.0:
        hint = "delta = (omega_max - omega_min)/omega_mean: from 1/5 (pumps) to 1/300 (generators)."
        faults.add(
            path, translate("expected an irregularity between 0 and 1, got {:g}", value), hint
        )
        return None
    return float(value)


def _read_wheel(faults: Faults, path: str, value: object) -> FlywheelTask:
    table = fields.read_table(faults, path, value, 'flywheel = { shape = "rim", speed = 30 }')
    return FlywheelTask(**read_flat(faults, path, table or {}, FlywheelTask))


_MOTOR = "kloss = { M_max = 60, s_k = 0.15, n_sync = 150 }"


def _read_motor(faults: Faults, path: str, value: object) -> Motor | None:
    """Read a motor's characteristic, and reduce it to the crank."""
    before = len(faults)
    table = fields.read_table(faults, path, value, _MOTOR)
    if table is None:
        return None
    found = read_flat(faults, path, table, MotorSection)
    given = [form for form in keys.MOTOR_FORMS if form in found]
    if len(given) != 1 and set(table) <= {*keys.MOTOR_FORMS, "ratio"}:
        faults.add(
            path, "expected kloss or line, one of them", translate("For example: {}", _MOTOR)
        )
    if len(faults) != before:
        return None
    (form,) = given
    where = f"{path}.{form}"
    numbers = fields.read_table(faults, where, found[form], _MOTOR) or {}
    read = read_flat(faults, where, numbers, KlossSection if form == "kloss" else LineSection)
    ways = keys.MOTOR_FORMS[form]
    if len(faults) == before and set(numbers) not in map(set, ways):
        asked = translate(" or ").join(", ".join(names) for names in ways)
        message = translate(
            "expected {}; got {}", asked, ", ".join(numbers) or translate("nothing")
        )
        faults.add(where, message, "Give all.")
    if len(faults) != before:
        return None
    ratio = found.get("ratio", 1.0)
    if form == "kloss":
        return _kloss(faults, where, KlossSection(**read), ratio)
    return _line(faults, where, LineSection(**read), ratio)


def _kloss(faults: Faults, path: str, table: KlossSection, ratio: float) -> Motor | None:
    """Return the characteristic of Kloss's formula."""
    before = len(faults)
    slip = _nominal_slip(faults, path, table.n_nom, table.n_sync)
    idle = table.n_sync * math.pi / 30.0 / ratio
    if table.M_max:
        if table.s_k >= 10.0:
            message = translate("expected a slip up to 10, got {:g}", table.s_k)
            faults.add(f"{path}.s_k", message, "From 0.05 to 1.")
        moment, critical = table.M_max, table.s_k
    else:
        factor = table.overload
        if factor <= 1.0:
            hint = "lambda = M_max/M_nom, from 1.7 to 3."
            faults.add(f"{path}.lambda", translate("expected more than 1, got {:g}", factor), hint)
            return None
        moment = factor * table.P_nom / (table.n_nom * math.pi / 30.0)
        critical = slip * (factor + math.sqrt(factor * factor - 1.0))
    return None if len(faults) != before else Motor(idle, moment * ratio, critical)


def _line(faults: Faults, path: str, table: LineSection, ratio: float) -> Motor | None:
    """Return a straight characteristic."""
    slip = _nominal_slip(faults, path, table.n_nom, table.n_idle)
    if slip <= 0.0:
        return None
    moment = table.M_start or table.M_nom / slip
    return Motor(table.n_idle * math.pi / 30.0 / ratio, moment * ratio)


def _nominal_slip(faults: Faults, path: str, nominal: float, idle: float) -> float:
    """Return the slip of the nominal point, which must drive. Default: 1."""
    slip = 1.0 - nominal / idle
    if slip <= 0.0:
        hint = translate("Expected less than {:g} rev/min.", idle)
        faults.add(f"{path}.n_nom", translate("the motor is driven at {:g} rev/min", nominal), hint)
    return slip
