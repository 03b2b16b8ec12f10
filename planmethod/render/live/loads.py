"""Loads that differ from position to position, as data for the page."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from planmethod.problem.load_records import (
    Couple,
    Fixed,
    Interpolation,
    Load,
    Over,
    SizeTable,
    TurningSense,
)
from planmethod.problem.model import Problem
from planmethod.problem.placement import rotation
from planmethod.solved.course.motion import CycleMotion
from planmethod.solved.forces.loads import MOTION_DIRECTIONS, in_time


def cycle_deg(problem: Problem) -> float:
    """Return the period of the motion and the loads, degrees."""
    dynamics, machine = problem.dynamics, problem.machine
    tables = [load.size for load in dynamics.loads] if dynamics is not None else []
    turns = [table.turn for table in tables if isinstance(table, SizeTable)]
    if machine is not None and any(isinstance(table, SizeTable) for table in tables):
        turns.append(machine.cycle_deg)
    return max([360.0, *turns])


def moving_loads(
    problem: Problem, names: Iterable[str], points: Iterable[str], row: Mapping[str, int]
) -> dict[str, Any]:
    """Return some loads, and their common data.

    Parameters
    ----------
    names : iterable of str
        Names of the loads.
    points : iterable of str
        Points whose velocities determine where the loads act.
    row : mapping of str to int
        Outputs of the tape by their columns.
    """
    assert problem.dynamics is not None
    numbers = {load.name: k for k, load in enumerate(problem.dynamics.loads)}
    bodies = (problem.bodies[link] for link in problem.mechanism.links)
    return {
        "list": [_load(problem, numbers[name], row) for name in names],
        "speeds": [row[f"{point}.vx"] for point in points],
        "omegas": [row[f"{link}.omega"] for link in problem.mechanism.links],
        "reach": max(abs(z) for body in bodies for z in body.points.values()) or 1.0,
        "positions": list(problem.drive.positions),
    }


def _load(problem: Problem, index: int, row: Mapping[str, int]) -> dict[str, Any]:
    assert problem.dynamics is not None
    load = problem.dynamics.loads[index]
    size, phase = load.size, load.phase
    data: dict[str, Any] = {"omega": row[f"{load.link}.omega"]}
    if isinstance(size, SizeTable):
        if size.over in (Over.PATH, Over.STROKES):
            turn = CycleMotion(problem)
            data["stroke"], size = _stroke(turn, index), in_time(turn.first, size, index)
        data["over"], data["step"] = size.over.value, size.interpolation is Interpolation.STEP
        data["at"], data["values"] = list(size.at), list(size.values)
        data["turn"] = size.turn
    else:
        data["size"] = size
    if phase is not None:
        data["spans"] = [list(span) for span in phase.phi]
        if phase.moving is not None:
            ahead = MOTION_DIRECTIONS[phase.moving]
            data["ahead"] = [ahead.real, ahead.imag]
        if phase.turning is not None:
            data["turning"] = 1 if phase.turning is TurningSense.CCW else -1
    match load:
        case Load():
            data["place"], data["speed"] = row[f"{load.at}.x"], row[f"{load.at}.vx"]
            if isinstance(load.sense, Fixed):
                along = rotation(load.sense.angle)
                data["along"] = [along.real, along.imag]
        case Couple():
            data["against"] = load.sense is not None
    return data


def _stroke(turn: CycleMotion, index: int) -> dict[str, Any]:
    stroke = turn.stroke_of(index)
    arc: dict[str, Any] = {}
    if stroke.centre is not None:
        arc = {"centre": [stroke.centre.real, stroke.centre.imag], "swing": stroke.swing}
    return {
        **arc,
        "back": int(stroke.back),
        "start": [stroke.start.real, stroke.start.imag],
        "towards": [stroke.towards.real, stroke.towards.imag],
        "dead": stroke.dead.tolist(),
        "first": turn.start_deg,
        "sense": turn.sense,
        "cycle": turn.cycle,
    }
