"""Values of the requested quantities of a solved train (значения искомых величин)."""

from __future__ import annotations

from fractions import Fraction

from msgspec import Struct

from planmethod.gears.asked import SoughtQuantity, parse
from planmethod.gears.axes import cannot_mesh
from planmethod.gears.conditions import satellites_held
from planmethod.gears.linear import solve
from planmethod.gears.model import PARALLEL, Mesh
from planmethod.gears.motion import TrainMotion, mesh_row


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
        return _exact(name, share) if share is not None else _none(name, "efficiency")
    if asked.kind == "k":
        body = motion.train.body_of[asked.labels[0]]
        most = satellites_held(motion, body) if body in motion.train.carriers else None
        return _exact(name, Fraction(most)) if most is not None else _none(name, "satellites")
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


def _none(name: str, reason: str, label: str = "") -> Answer:
    return Answer(name, None, reason=reason, label=label)


def _ratio(motion: TrainMotion, name: str, asked: SoughtQuantity) -> Answer:
    one, other = asked.labels
    for label in asked.labels:
        if motion.train.body_of[label] in motion.train.racks:
            return _none(name, "rack", label)
    below = motion.speed(other, asked.carrier)
    if not below:
        return _none(name, "zero", other)
    ratio = motion.speed(one, asked.carrier) / below
    return _exact(name, ratio if motion.has_sign(one, other) else abs(ratio))


def _speed(motion: TrainMotion, name: str, asked: SoughtQuantity) -> Answer:
    (label,) = asked.labels
    speed = motion.speed(label, asked.carrier)
    rack = motion.train.body_of[label] in motion.train.racks
    if rack != (asked.kind == "v"):
        return _none(name, "rack", label)
    if rack:
        metres = rack_speed(motion, label)
        return _none(name, "module") if metres is None else Answer(name, metres, None, "m/s")
    if asked.kind == motion.train.unit:
        return _exact(name, speed, motion.train.units[0])
    return Answer(name, float(speed) * motion.train.factor, None, motion.train.units[1])


def rack_speed(motion: TrainMotion, label: str) -> float | None:
    """Return the speed of a rack, m/s; None where the module is not given."""
    train = motion.train
    if train.toothed and train.module is None:
        return None
    return float(motion.speed(label) * train.unit_m) * train.rate


def _size(motion: TrainMotion, name: str, asked: SoughtQuantity) -> Answer:
    """Return teeth, a radius or a centre distance, mm."""
    train, sizes, heights = motion.train, motion.axes.sizes, motion.axes.heights
    label = asked.labels[0]
    if asked.kind == "r" and label in train.arms:
        return _exact(name, train.arms[label] * 1000, "mm")
    if asked.kind != "a_w" and label not in sizes:
        return _none(name, "wheel", label)
    if asked.kind == "z":
        return _exact(name, sizes[label]) if train.counted(label) else _none(name, "teeth")
    if train.toothed and train.module is None and (asked.kind == "a_w" or train.counted(label)):
        return _none(name, "module")
    if asked.kind == "r":
        return _exact(name, motion.axes.radii[label] * train.unit_m * 1000, "mm")
    one, other = (train.body_of[x] for x in asked.labels)
    if one not in heights or other not in heights:
        return _none(name, "wheel", label)
    mesh = _between(motion, one, other)
    apart = abs(heights[one] - heights[other]) if mesh is None else motion.axes.apart[mesh.name]
    if mesh is not None and cannot_mesh(motion.axes, mesh):
        return _none(name, "wheel", label)
    apart *= train.unit_m * 1000
    if not motion.axes.shifted:
        return _exact(name, apart, "mm")
    return Answer(name, float(apart), None, "mm")


def _between(motion: TrainMotion, one: str, other: str) -> Mesh | None:
    """Return the mesh whose axes are those of two bodies, with shifts if there is one so."""
    axis = motion.axes.axis_of
    found = [
        mesh
        for mesh in motion.train.meshes
        if mesh.kind in PARALLEL
        and {axis[body] for body in motion.train.ends(mesh)} == {axis[one], axis[other]}
    ]
    own = [mesh for mesh in found if {one, other} == set(motion.train.ends(mesh))]
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
                turned = [b for b in (one, other) if b not in motion.roles.across]
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
            _goes_forward(motion, mesh, found.values[name])
            for mesh, name in zip(train.meshes, forces, strict=True)
        ]
        if seen == forward:
            power_in = turn * motion.speeds[source]
            share = -found.values["out"] * motion.speeds[output] / power_in
            return share if share > 0 else None
        forward = seen
    return None


def _goes_forward(motion: TrainMotion, mesh: Mesh, force: Fraction) -> bool:
    """Return whether power flows from the first wheel of a mesh to the second, on the carrier."""
    row = mesh_row(motion.train, motion.roles, motion.axes, mesh)
    one = motion.train.ends(mesh)[0]
    speed = motion.speed(one, motion.train.carrier(mesh))
    return force * row[one] * speed <= 0
