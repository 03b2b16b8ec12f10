"""``[[motors]]`` of a problem file: the motors that a machine may have (каталог двигателей)."""

from __future__ import annotations

from planmethod.problem import keys
from planmethod.problem.file_node import FileNode
from planmethod.problem.machine_records import ConstantMoment
from planmethod.problem.motor_records import CatalogueMotor

_EXAMPLE = 'name = "112M4", power = 5500, n = 1430, J = 0.0123'


def read_motors(file: FileNode, constant: ConstantMoment | None) -> tuple[CatalogueMotor, ...]:
    """Read the motors of which one is chosen, in the order of the file."""
    node = file["motors"]
    if constant is ConstantMoment.RESISTING:
        hint = 'Omit the motors, or write constant = "driving".'
        node.reject("the loads drive already: the constant moment resists", hint=hint)
    node.tables(keys.MOTOR_LIMIT, "{} motors, the limit is {}")
    motors = node.read_all(_read_motor)
    names = [motor.name for motor in motors]
    for number, entry in enumerate(node.entries()):
        if names[number] in names[:number]:
            hint = "Give each motor its own name."
            entry["name"].note("another motor is named {}", names[number], hint=hint)
    node.require_sound()
    return motors


def _read_motor(node: FileNode) -> CatalogueMotor:
    found = node.record(CatalogueMotor, example=_EXAMPLE)
    motor = node.build(CatalogueMotor, found)
    if motor.synchronous is not None and motor.speed >= motor.synchronous:
        message = "expected less than the synchronous speed, {:g} rev/min, got {:g}"
        node["n"].reject(message, motor.synchronous, motor.speed, hint="Exchange n and n_sync.")
    return motor
