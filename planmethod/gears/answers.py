"""Values of the requested quantities of a solved train (значения искомых величин)."""

from __future__ import annotations

from fractions import Fraction

from msgspec import Struct

from planmethod.gears.axes import cannot_mesh
from planmethod.gears.conditions import max_planets
from planmethod.gears.linear import solve
from planmethod.gears.model import PARALLEL, Mesh
from planmethod.gears.motion import TrainMotion, mesh_row
from planmethod.gears.requested_quantities import RequestedQuantity, parse


class Answer(Struct, frozen=True):
    """The value of a quantity (значение).

    Attributes
    ----------
    value : float or None
        None where it does not exist.
    exact : Fraction or None
        Where it is a fraction.
    reason : str
        Why there is no value: ``zero``, ``module``, ``rack``, ``satellites``, ``efficiency``.
    """

    name: str
    value: float | None
    exact: Fraction | None = None
    unit: str = ""
    reason: str = ""
    label: str = ""


def answer(motion: TrainMotion, name: str) -> Answer:
    """Return the value of a requested quantity."""
    asked = parse(name, tuple(motion.train.body_of))
    plain = {
        "W": motion.structure.mobility,
        "q": motion.structure.spatial,
    }
    if asked.kind in plain:
        return _exact(name, Fraction(plain[asked.kind]))
    if asked.kind == "U":
        return _ratio(motion, name, asked)
    if asked.kind in ("n", "omega", "v"):
        return _speed(motion, name, asked)
    if asked.kind == "eta":
        share = efficiency(motion)
        return _exact(name, share) if share is not None else no_answer(name, "efficiency")
    if asked.kind == "k":
        body = motion.train.body_of[asked.labels[0]]
        most = max_planets(motion, body) if body in motion.train.carriers else None
        return _exact(name, Fraction(most)) if most is not None else no_answer(name, "satellites")
    return _size(motion, name, asked)


def named(motion: TrainMotion) -> list[str]:
    """Return the names of the speeds of all bodies, and of the requested quantities."""
    train = motion.train
    racks = (train.body_of[x] in train.racks for x in train.numbers)
    letters = ("v" if is_rack else train.unit for is_rack in racks)
    speeds = (f"{letter}_{x}" for letter, x in zip(letters, train.numbers, strict=True))
    return list(dict.fromkeys([*speeds, *train.ask]))


def _exact(name: str, value: Fraction, unit: str = "") -> Answer:
    return Answer(name, float(value), value, unit)


def no_answer(name: str, reason: str, label: str = "") -> Answer:
    """Return the record of a quantity without a value, and the reason."""
    return Answer(name, None, reason=reason, label=label)


def _ratio(motion: TrainMotion, name: str, quantity: RequestedQuantity) -> Answer:
    one, other = quantity.labels
    for label in quantity.labels:
        if motion.train.body_of[label] in motion.train.racks:
            return no_answer(name, "rack", label)
    below = motion.speed(other, quantity.carrier)
    if not below:
        return no_answer(name, "zero", other)
    ratio = motion.speed(one, quantity.carrier) / below
    return _exact(name, ratio if motion.has_sign(one, other) else abs(ratio))


def _speed(motion: TrainMotion, name: str, quantity: RequestedQuantity) -> Answer:
    (label,) = quantity.labels
    speed = motion.speed(label, quantity.carrier)
    rack = motion.train.body_of[label] in motion.train.racks
    if rack != (quantity.kind == "v"):
        return no_answer(name, "rack", label)
    if rack:
        metres = rack_speed(motion, label)
        return no_answer(name, "module") if metres is None else Answer(name, metres, None, "m/s")
    if quantity.kind == motion.train.unit:
        return _exact(name, speed, motion.train.units[0])
    return Answer(name, float(speed) * motion.train.factor, None, motion.train.units[1])


def rack_speed(motion: TrainMotion, label: str) -> float | None:
    """Return the speed of a rack, m/s; None where the module is not given."""
    train = motion.train
    if train.toothed and train.module is None:
        return None
    return float(motion.speed(label) * train.unit_m) * train.rate


def _size(motion: TrainMotion, name: str, quantity: RequestedQuantity) -> Answer:
    """Return teeth, a radius or a centre distance, mm."""
    train, sizes, heights = motion.train, motion.axes.sizes, motion.axes.heights
    label = quantity.labels[0]
    if quantity.kind == "r" and label in train.arms:
        return _exact(name, train.arms[label] * 1000, "mm")
    if quantity.kind != "a_w" and label not in sizes:
        return no_answer(name, "wheel", label)
    if quantity.kind == "z":
        return _exact(name, sizes[label]) if train.counted(label) else no_answer(name, "teeth")
    if train.toothed and train.module is None and (quantity.kind == "a_w" or train.counted(label)):
        return no_answer(name, "module")
    if quantity.kind == "r":
        return _exact(name, motion.axes.radii[label] * train.unit_m * 1000, "mm")
    one, other = (train.body_of[x] for x in quantity.labels)
    if one not in heights or other not in heights:
        return no_answer(name, "wheel", label)
    mesh = _between(motion, one, other)
    apart = abs(heights[one] - heights[other]) if mesh is None else motion.axes.distances[mesh.name]
    if mesh is not None and cannot_mesh(motion.axes, mesh):
        return no_answer(name, "wheel", label)
    apart *= train.unit_m * 1000
    if not motion.axes.shifted:
        return _exact(name, apart, "mm")
    return Answer(name, float(apart), None, "mm")


def _between(motion: TrainMotion, first: str, second: str) -> Mesh | None:
    """Return the mesh whose axes are those of two bodies, with shifts if there is one so."""
    axis = motion.axes.axis_of
    found = [
        mesh
        for mesh in motion.train.meshes
        if mesh.kind in PARALLEL
        and {axis[body] for body in motion.train.ends(mesh)} == {axis[first], axis[second]}
    ]
    own = [mesh for mesh in found if {first, second} == set(motion.train.ends(mesh))]
    return next(iter([*own, *found]), None)


def efficiency(motion: TrainMotion, output: str | None = None) -> Fraction | None:
    """Return the efficiency from the input to the output by the powers of the stages.

    The output is a body of the train. Default: that of its file.

    The tooth forces are in equilibrium on every body; in each mesh the output power relative to
    the carrier is less than the input power. None where an efficiency or the output is not given,
    W is not 1, or the train locks itself.
    """
    train = motion.train
    output = output or train.output
    if output is None or motion.structure.mobility != 1 or len(train.inputs) != 1:
        return None
    if output in train.inputs or output in train.fixed or not motion.speeds.get(output):
        return None
    if not all(train.inputs.values()) or any(mesh.eta is None for mesh in train.meshes):
        return None
    (source,) = train.inputs
    turn = 1 if motion.speeds[source] > 0 else -1  # the torque of the input drives
    loose = [body for body in train.bodies if body not in train.fixed]
    forces = [f"mesh {mesh.name}" for mesh in train.meshes]
    forward = [True] * len(forces)
    for _ in range(2 * len(forces) + 2):
        rows: dict[str, dict[str, Fraction]] = {body: {} for body in loose}
        for mesh, name, is_forward in zip(train.meshes, forces, forward, strict=True):
            row = mesh_row(train, motion.roles, motion.axes, mesh)
            one, other = train.ends(mesh)
            loss = mesh.eta or Fraction(1)
            kept = loss if is_forward else 1 / loss
            torque = {one: row[one], other: row[other] * kept}
            carrier = train.carrier(mesh)
            if carrier is not None:
                turned = [b for b in (one, other) if b not in motion.roles.transverse]
                torque[carrier] = -sum((torque[b] for b in turned), Fraction(0))
            for body, value in torque.items():
                if body in rows:
                    rows[body][name] = rows[body].get(name, Fraction(0)) + value
        rows[output]["out"] = Fraction(1)
        right = {body: Fraction(-turn if body == source else 0) for body in loose}
        found = solve([*forces, "out"], [(rows[body], right[body]) for body in loose])
        if found.free or not found.consistent:
            return None
        seen = [
            _is_forward(motion, mesh, found.values[name])
            for mesh, name in zip(train.meshes, forces, strict=True)
        ]
        if seen == forward:
            power_in = turn * motion.speeds[source]
            share = -found.values["out"] * motion.speeds[output] / power_in
            return share if share > 0 else None
        forward = seen
    return None


def _is_forward(motion: TrainMotion, mesh: Mesh, force: Fraction) -> bool:
    """Return whether power flows from the first wheel of a mesh to the second, on the carrier."""
    row = mesh_row(motion.train, motion.roles, motion.axes, mesh)
    one = motion.train.ends(mesh)[0]
    speed = motion.speed(one, motion.train.carrier(mesh))
    return force * row[one] * speed <= 0
