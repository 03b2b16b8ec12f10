"""``[machine]`` of a problem file: data for the choice of a flywheel (маховик)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

from planmethod.languages import translate
from planmethod.problem import keys
from planmethod.problem.drive import require_turning
from planmethod.problem.file_node import FileNode, is_number, show
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

R = TypeVar("R")

_EXAMPLE = '[machine] delta = "1/18", constant = "driving"'


def read_machine(file: FileNode, drive: Drive | None) -> Machine:
    """Read ``[machine]``; ``drive`` is None where it has a fault of its own."""
    node = file["machine"]
    node.table(_EXAMPLE)
    hint = "The cycle of a machine is that of a driving crank: give it phi and n."
    require_turning(node, drive, hint, "Give its mean speed: [driver] n or omega.")
    if not file["loads"].value:
        node.note("there are no [[loads]]", hint="A flywheel evens out their work.")
    found = node.record(
        Machine,
        delta=_read_delta,
        cycle_deg=_read_cycle,
        flywheel=_read_flywheel,
        motor=_read_motor,
    )
    found["stated_count"] = found.get("count")
    found.setdefault("count", round(found.get("cycle_deg", 360.0) / 30))
    if found.get("constant") is ConstantMoment.RESISTING:
        if "motor" in found:
            hint = 'Leave the motor out, or say constant = "driving".'
            message = "the loads drive already: the constant moment resists"
            node["motor"].note(message, hint=hint)
        if "brake" in found:
            hint = "A stop is that of a machine whose loads resist."
            message = "the loads drive: no brake is known to stop them"
            node["brake"].note(message, hint=hint)
    return node.build(Machine, found)


def _read_cycle(node: FileNode) -> float:
    if not is_number(node.value) or node.value not in (360, 720):
        node.reject_value("360 or 720", "720 is for a four-stroke engine.")
    return float(node.value)


def _read_delta(node: FileNode) -> float:
    """Read the coefficient of speed fluctuation: a number, or a fraction such as ``"1/18"``."""
    value = node.value
    if isinstance(value, str):
        top, slash, bottom = value.partition("/")
        one, other = read_decimal(top), read_decimal(bottom if slash else "1")
        value = float(one) / float(other) if one is not None and other else math.nan
    if not is_number(value) or not math.isfinite(value):
        message = 'expected a number or a fraction such as "1/18", got {}'
        node.reject(message, show(node.value), hint="A decimal fraction has a point: 0.05.")
    if not 0.0 < value < 1.0:
        hint = "delta = (omega_max - omega_min)/omega_mean: from 1/5 (pumps) to 1/300 (generators)."
        node.reject("expected an irregularity between 0 and 1, got {:g}", value, hint=hint)
    return float(value)


def _read_flywheel(node: FileNode) -> FlywheelTask:
    node.table('flywheel = { shape = "rim", speed = 30 }')
    return node.build(FlywheelTask, node.record(FlywheelTask))


_MOTOR = "kloss = { M_max = 60, s_k = 0.15, n_sync = 150 }"


def _read_motor(node: FileNode) -> Motor:
    """Read a motor's characteristic, and reduce it to the crank."""
    node.table(_MOTOR)
    found = node.record(MotorSection)
    forms = [form for form in keys.MOTOR_FORMS if form in found]
    if len(forms) != 1 and node.is_whole:
        hint = translate("For example: {}", _MOTOR)
        node.reject("expected kloss or line, one of them", hint=hint)
    node.require_sound()
    characteristic, ratio = node[forms[0]], found.get("ratio", 1.0)
    characteristic.table(_MOTOR)
    if forms == ["kloss"]:
        return _kloss(characteristic, ratio)
    return _line(characteristic, ratio)


def _read_numbers(node: FileNode, record: Callable[..., R]) -> R:
    """Read the numbers of a characteristic, in one of the ways in which it may be given."""
    found = node.record(record)  # type: ignore[arg-type]
    node.require_sound()
    ways = keys.MOTOR_FORMS[str(node.key)]
    if set(node.value) not in map(set, ways):
        wanted = translate(" or ").join(", ".join(names) for names in ways)
        given = ", ".join(node.value) or translate("nothing")
        node.reject("expected {}; got {}", wanted, given, hint="Give all.")
    return record(**found)


def _kloss(node: FileNode, ratio: float) -> Motor:
    """Return the characteristic of Kloss's formula."""
    table = _read_numbers(node, KlossSection)
    slip = _nominal_slip(node, table.n_nom, table.n_sync)
    if table.M_max:
        if table.s_k >= 10.0:
            message = "expected a slip up to 10, got {:g}"
            node["s_k"].note(message, table.s_k, hint="From 0.05 to 1.")
        moment, critical = table.M_max, table.s_k
    else:
        factor = table.overload
        if factor <= 1.0:
            hint = "lambda = M_max/M_nom, from 1.7 to 3."
            node["lambda"].reject("expected more than 1, got {:g}", factor, hint=hint)
        moment = factor * table.P_nom / (table.n_nom * math.pi / 30.0)
        critical = slip * (factor + math.sqrt(factor * factor - 1.0))
    node.require_sound()
    return Motor(table.n_sync * math.pi / 30.0 / ratio, moment * ratio, critical)


def _line(node: FileNode, ratio: float) -> Motor:
    """Return a straight characteristic."""
    table = _read_numbers(node, LineSection)
    slip = _nominal_slip(node, table.n_nom, table.n_idle)
    node.require_sound()
    moment = table.M_start or table.M_nom / slip
    return Motor(table.n_idle * math.pi / 30.0 / ratio, moment * ratio)


def _nominal_slip(node: FileNode, nominal: float, idle: float) -> float:
    """Return the slip of the nominal point, which must drive. Default: 1."""
    slip = 1.0 - nominal / idle
    if slip <= 0.0:
        hint = translate("Expected less than {:g} rev/min.", idle)
        node["n_nom"].note("the motor is driven at {:g} rev/min", nominal, hint=hint)
    return slip
