"""The tabular method: the train turned as one, then its carrier held (табличный метод)."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from planmethod.errors import PlanMethodError
from planmethod.gears.motion import Motion, mesh_row
from planmethod.record import dataclass


@dataclass(frozen=True, slots=True)
class Turns:
    """The table of one carrier (таблица вращений).

    Attributes
    ----------
    carrier : str
    started : tuple of str
        Bodies that are turned while the carrier is held; the others follow by the stages.
    together, held : mapping
        By body: speeds of the locked train, and those with the carrier held. Their sum is the
        speed; of a body across the main axis that is its own turning, with the carrier it has none.
    """

    carrier: str
    started: tuple[str, ...]
    together: Mapping[str, Fraction]
    held: Mapping[str, Fraction]


def tabular(motion: Motion) -> tuple[Turns, ...]:
    """Make the tables of all carriers that may turn, and compare their sums with the speeds.

    Raises
    ------
    PlanMethodError
        A sum is not the speed that the mesh equations give: a mistake of ours.
    """
    return tuple(
        _table(motion, carrier)
        for carrier in motion.train.carriers
        if carrier not in motion.train.fixed
    )


def _table(motion: Motion, carrier: str) -> Turns:
    train, roles = motion.train, motion.roles
    central = roles.central[carrier]
    bodies = (*central, *roles.satellites[carrier])
    locked = motion.speeds[carrier]
    together = {b: Fraction(0) if b in roles.across else locked for b in bodies}
    sources = sorted(bodies, key=lambda b: (b not in train.fixed, b not in train.inputs))
    held: dict[str, Fraction] = {}
    started = []
    for source in sources:
        if source in held:
            continue
        started.append(source)
        held[source] = motion.speeds[source] - together[source]
        for _ in train.meshes:
            _follow(motion, carrier, held)
    for body in bodies:
        if together[body] + held[body] != motion.speeds[body]:
            raise PlanMethodError(
                "the tabular method gives {} the speed {}, the mesh equations {}; please "
                "report the problem file",
                body,
                together[body] + held[body],
                motion.speeds[body],
            )
    return Turns(
        carrier, tuple(started), {carrier: locked} | together, {carrier: Fraction(0)} | held
    )


def _follow(motion: Motion, carrier: str, held: dict[str, Fraction]) -> None:
    """Carry the turning on through each mesh that has one end turned already."""
    train = motion.train
    for mesh in train.meshes:
        if train.carrier(mesh) != carrier:
            continue
        row = mesh_row(train, motion.roles, motion.axes, mesh)
        for near, far in (train.ends(mesh), train.ends(mesh)[::-1]):
            if near in held and far not in held:
                held[far] = -held[near] * row[near] / row[far]
