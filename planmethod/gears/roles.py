"""Roles of bodies in a train: central wheels, planets; the senses of bevel wheels (роли)."""

from __future__ import annotations

import math
from collections.abc import Mapping

from msgspec import Struct

from planmethod.errors import Fault
from planmethod.gears.model import Mesh, MeshKind, Train
from planmethod.languages import translate

Vector = tuple[float, float, float]


class Roles(Struct, frozen=True):
    """Roles of the bodies of a train (роли звеньев).

    Attributes
    ----------
    central, planets : mapping
        Central wheels and planets, by carrier.
    senses : mapping
        By bevel mesh: +1 where both wheels turn in the positive senses of their axes, else -1.
    transverse : frozenset of str
        Bodies whose axis is not parallel to the main one: their speeds are relative to their
        carrier, about their own axis.
    """

    central: Mapping[str, tuple[str, ...]]
    planets: Mapping[str, tuple[str, ...]]
    senses: Mapping[Mesh, int]
    transverse: frozenset[str]


def find_roles(train: Train) -> tuple[Roles, list[Fault]]:
    """Distinguish central wheels from planets, and give bevel wheels their senses.

    A wheel that meshes on a carrier is central if it is fixed, is an input, is coupled to something
    else (another carrier, a mesh of the frame), is a ring, is stated to be coaxial with a central
    body, or meshes only once there; the others are planets.
    """
    faults: list[Fault] = []
    central: dict[str, tuple[str, ...]] = {}
    satellites: dict[str, tuple[str, ...]] = {}
    for carrier in train.carriers:
        middle, around = _split(train, carrier)
        central[carrier], satellites[carrier] = tuple(middle), tuple(around)
        if not around:
            text = translate("no wheel on the carrier {} is a planet", carrier)
            faults.append(Fault("gears.meshes", text, "Name the carrier of each mesh, and check."))
    for mesh in train.meshes:
        if train.carrier(mesh) in train.ends(mesh):
            text = translate(
                "a wheel of {} is one body with the carrier {}", mesh.name, mesh.carrier
            )
            faults.append(Fault("gears.meshes", text, "It cannot roll on it: check bodies."))
    senses, across = _bevels(train, satellites, faults)
    return Roles(central, satellites, senses, across), faults


def _split(train: Train, carrier: str) -> tuple[list[str], list[str]]:
    own = [mesh for mesh in train.meshes if train.carrier(mesh) == carrier]
    ends = [body for mesh in own for body in train.ends(mesh)]
    elsewhere = {
        body for mesh in train.meshes if mesh not in own for body in train.ends(mesh)
    } | set(train.carriers)
    sure = {b for b in ends if b in train.fixed or b in elsewhere}
    sure |= {b for mesh in own if (b := _ring(train, mesh)) is not None}
    sure |= {b for b in ends if b in train.inputs and not _is_between(train, own, b, sure)}
    for group in train.coaxial:
        if carrier in group or sure & set(group):
            sure |= set(group) & set(ends)
    once = {body for body in ends if ends.count(body) == 1}
    for mesh in own:  # a planet that meshes only once
        one, other = train.ends(mesh)
        if {one, other} <= sure | once:
            once -= {next((body for body in (other, one) if body not in sure), "")}
    middle = [body for body in dict.fromkeys(ends) if body in sure | once]
    return middle, [body for body in dict.fromkeys(ends) if body not in middle]


def _is_between(train: Train, carrier_meshes: list[Mesh], body: str, sure: set[str]) -> bool:
    """Return whether a body meshes with several central bodies only: then it is a planet."""
    ends = [train.ends(mesh) for mesh in carrier_meshes]
    mates = {b for both in ends if body in both for b in both} - {body}
    once = {b for b in mates if sum(b in both for both in ends) == 1}
    return body not in sure and len(mates) > 1 and mates <= sure | once


def _ring(train: Train, mesh: Mesh) -> str | None:
    """Return the body of the wheel with internal teeth, where its size is known."""
    if mesh.kind is not MeshKind.INTERNAL:
        return None
    one, other = (train.wheels[label].size for label in (mesh.first, mesh.second))
    if one is None or other is None:
        return None
    return train.ends(mesh)[0 if one > other else 1]


# Bevel wheels ------------------------------------------------------------------------------------


def _bevels(
    train: Train, planets: Mapping[str, tuple[str, ...]], faults: list[Fault]
) -> tuple[dict[Mesh, int], frozenset[str]]:
    """Give every bevel mesh its sense, by the directions of the axes from the apex.

    The contact point P has one velocity, seen from the carrier: with axes that point from the
    apex to the wheels, the wheels turn in opposite senses of them. Where no axes are given, the
    first wheel in mesh with a planet is below it on the main axis, the next above.
    """
    around = {body for bodies in planets.values() for body in bodies}
    main = _main_axis(train, around)
    across: dict[str, bool] = {}
    above: dict[tuple[str, str], bool] = {}
    senses: dict[Mesh, int] = {}
    for mesh in train.meshes:
        if mesh.kind is not MeshKind.BEVEL:
            continue
        one, other = train.ends(mesh)
        turned = _is_transverse(train, mesh, main, across, around)
        across.setdefault(one, turned)
        across.setdefault(other, not turned)
        if across[one] == across[other]:
            text = translate(
                "the axes of {} and {} are parallel, they cannot be bevel", mesh.first, mesh.second
            )
            faults.append(Fault("gears.meshes", text))
            continue
        axial, crossing = (other, one) if across[one] else (one, other)
        below = not any(c == crossing and up is False for (_, c), up in above.items())
        above.setdefault((axial, crossing), not below)
        senses[mesh] = -1 if above[axial, crossing] else 1
        given = [train.wheels[label].axis for label in (mesh.first, mesh.second)]
        label = mesh.second if across[one] else mesh.first
        axis = train.wheels[label].axis
        if axis is not None:
            senses[mesh] = -(_sign(axis, main) or 1)
        across_axis = given[0] if across[one] else given[1]
        if across_axis is not None:
            senses[mesh] *= 1 if across_axis > (0.0, 0.0, 0.0) else -1
    return senses, frozenset(body for body, is_across in across.items() if is_across)


def _is_transverse(
    train: Train,
    mesh: Mesh,
    main: Vector,
    transverse: Mapping[str, bool],
    around: set[str],
) -> bool:
    """Return whether the first wheel of a bevel mesh is transverse to the main axis."""
    ends = train.ends(mesh)
    axes = [train.wheels[label].axis for label in (mesh.first, mesh.second)]
    for body, axis, flip in zip(ends, axes, (False, True), strict=True):
        if body in transverse:
            return transverse[body] != flip
        if axis is not None:
            return (_sign(axis, main) == 0) != flip
    return ends[0] in around and ends[1] not in around


def _main_axis(train: Train, around: set[str]) -> Vector:
    """Return the direction of the main axis, z upwards unless a central wheel has another."""
    wheels = [
        train.wheels[label]
        for mesh in sorted(train.meshes, key=lambda mesh: mesh.carrier is None)
        if mesh.kind is MeshKind.BEVEL
        for label in (mesh.first, mesh.second)
    ]
    axes = [w.axis for w in wheels if w.axis is not None and train.body_of[w.label] not in around]
    if not axes:
        return 0.0, 0.0, 1.0
    x, y, z = axes[0]
    return axes[0] if (z, x, y) > (0.0, 0.0, 0.0) else (-x, -y, -z)


def _sign(axis: Vector, main: Vector) -> int:
    """Return +1 for an axis along the main one, -1 for one against it, 0 for one across."""
    along = sum(a * b for a, b in zip(axis, main, strict=True))
    size = math.hypot(*axis) * math.hypot(*main)
    return 0 if abs(along) < (1 - 1e-9) * size else (1 if along > 0 else -1)
