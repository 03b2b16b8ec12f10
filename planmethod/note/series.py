"""Series of compared numbers: of plans, forces, machines."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from planmethod.note.compared import ComparedNumber, Series
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.solved.errors.forces import (
    BALANCE,
    DIFFERENCE,
    LEVER,
    angle_label,
    drawn_forces,
    moment_label,
    size_label,
)
from planmethod.solved.forces.statics import VANISHING

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.solved.forces.statics import JointForce, Statics
    from planmethod.solved.machine.balancing import Balancing
    from planmethod.solved.machine.drawing import FlywheelDrawing
    from planmethod.solved.reading import Flags, Reals
    from planmethod.solved.turn.extremes import ExtremesConstruction


def size_series(statics: Statics, joint: JointForce) -> Series:
    """Return the size of a reaction, zero where it is negligible."""
    symbol = reaction_symbol(joint.on, statics.board.called(joint.by))
    exact = np.where(vanishing(statics, joint), 0.0, np.abs(joint.force))
    return _series(statics, size_label(joint), symbol, "N", exact)


def angle_series(statics: Statics, joint: JointForce) -> Series:
    """Return the direction of a reaction, NaN where it is negligible. Angles have no Δ."""
    angle = np.degrees(np.angle(joint.force)) % 360.0
    exact = np.where(vanishing(statics, joint), np.nan, angle)
    return _series(statics, angle_label(joint), "φ", "deg", exact)


def vanishing(statics: Statics, joint: JointForce) -> Flags:
    """Return where a reaction is negligible beside the largest force, and has no direction."""
    return np.asarray(np.abs(joint.force) <= VANISHING * statics.largest_forces)


def moment_series(statics: Statics, joint: JointForce) -> Series | None:
    """Return the moment of a reaction in a prismatic pair; None in another pair."""
    label = moment_label(joint)
    if label not in drawn_forces(statics).items:
        return None
    return _series(statics, label, "M", "N·m", joint.moment, turns=True)


def balance_series(statics: Statics) -> Series:
    """Return what balances the driver, by the force plans."""
    return _balance(statics, BALANCE, statics.balance)


def lever_series(statics: Statics) -> Series | None:
    """Return what balances the driver, by the lever; None if the driver is at rest."""
    return None if statics.lever is None else _balance(statics, LEVER, statics.lever)


def lever_beside_plans(statics: Statics) -> Series | None:
    """Return the result of the lever beside that of the force plans, both as read by hand.

    Its error is that of their difference. None if the driver is at rest.
    """
    lever, plans = lever_series(statics), balance_series(statics)
    if lever is None:
        return None
    return Series(
        lever.symbol, lever.unit, plans.read, lambda: lever.read,
        lambda: drawn_forces(statics).spreads[DIFFERENCE], lever.turns,
    )  # fmt: skip


def _balance(statics: Statics, label: str, exact: Reals) -> Series:
    balancing = statics.solution.problem.balancer
    return _series(statics, label, balancing.symbol, balancing.unit, exact, turns=balancing.turns)


def _series(
    statics: Statics, label: str, symbol: str, unit: str, exact: Reals, *, turns: bool = False
) -> Series:
    return Series(
        symbol, unit, exact, lambda: drawn_forces(statics).read(label),
        lambda: drawn_forces(statics).spreads[label], turns, label=label,
    )  # fmt: skip


def compared_extremes(construction: ExtremesConstruction) -> list[ComparedNumber]:
    """Return both angles of the crank in the extreme positions, degrees."""
    return [
        ComparedNumber(phi, phi + construction.off(k), construction.sigma[k])
        for k, phi in enumerate(construction.phi)
    ]


def compared_stroke(construction: ExtremesConstruction) -> ComparedNumber:
    """Return the stroke of the link, m, or its swing, degrees."""
    exact, read = map(construction.stroke, (construction.exact, construction.read))
    return ComparedNumber(exact, read, construction.sigma[2])


def compared_flywheel(drawing: FlywheelDrawing) -> ComparedNumber:
    """Return the flywheel by the construction beside that of the exact motion, kg·m²."""
    return ComparedNumber(drawing.flywheel.exact.inertia, drawing.read_inertia, drawing.sigma)


def compared_segment(drawing: FlywheelDrawing) -> ComparedNumber:
    """Return the segment that the flywheel is found by, KL or AB, mm."""
    name = drawing.construction.segment
    exact, read = (float(one.number(name)[0]) for one in (drawing.exact, drawing.ruler_reading))
    return ComparedNumber(exact, read, float(drawing.errors.spreads[name].sigma[0]))


def compared_moment(balancing: Balancing, number: int, profile: Profile) -> ComparedNumber:
    """Return m·r of a counterweight by its polygon, kg·m."""
    polygon, _, _, reading = balancing.polygon(number, profile)
    exact = abs(balancing.counterweights[number].moment)
    return ComparedNumber(exact, float(reading.number(polygon.moment)[0]))
