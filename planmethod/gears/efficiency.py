"""Efficiency of a train from those of its stages, by the powers (КПД по методу мощностей)."""

from __future__ import annotations

from fractions import Fraction

from planmethod.gears.linear import solve
from planmethod.gears.model import Mesh
from planmethod.gears.motion import Motion, mesh_row


def efficiency(motion: Motion) -> Fraction | None:
    """Return the efficiency from the input to the output by the powers of the stages.

    The tooth forces are in equilibrium on every body; in each mesh the power seen from the carrier
    comes out less than it goes in. None where an efficiency or the output is not given, W is not
    1, or the train locks itself.
    """
    train = motion.train
    if train.output is None or motion.structure.mobility != 1 or len(train.inputs) != 1:
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
        rows[train.output]["out"] = Fraction(1)
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
            share = -found.values["out"] * motion.speeds[train.output] / power_in
            return share if share > 0 else None
        forward = seen
    return None


def _goes_forward(motion: Motion, mesh: Mesh, force: Fraction) -> bool:
    """Whether power goes from the first wheel of a mesh to the second, seen from the carrier."""
    row = mesh_row(motion.train, motion.roles, motion.axes, mesh)
    one = motion.train.ends(mesh)[0]
    speed = motion.speed(one, motion.train.carrier(mesh))
    return force * row[one] * speed <= 0
