"""Compared numbers of a cycle and a machine: extremes, flywheel, counterweights (сравнение)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planmethod.note.compared import ComparedNumber

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.solved.machine.balancing import Balancing
    from planmethod.solved.machine.drawing import FlywheelDrawing
    from planmethod.solved.turn.construction import ExtremesConstruction


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
