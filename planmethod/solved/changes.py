"""Change points: where a group may continue in either assembly mode (точка ветвления).

A mode is on one side of a line, and the side is data of its step. Where both modes meet in one
place and part again, a motion that continues smoothly changes sides; plans that keep the side go on
in the other branch of the motion.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import evaluate
from planmethod.construct.program import Program
from planmethod.construct.steps import PointName, Touch
from planmethod.mechanism.groups import AssurGroup
from planmethod.plans.draft import Draft
from planmethod.plans.motion.position import inner_point, outer_point, rpr_parts
from planmethod.solved.reading import Reals

Data = Callable[[Reals], dict[str, complex | float | Reals]]

TOUCHING = 1e-9
"""Squared distance of two modes, relative to the group's size, at which they coincide."""

SAMPLES = 721
"""Number of samples of the driver's range: every half degree of a turn."""

_ROUNDS, _PARTS = 8, 32  # the interval between two samples is subdivided again and again


def changes(
    draft: Draft,
    program: Program,
    data: Data,
    group: AssurGroup,
    low: float,
    high: float,
    *,
    around: bool = True,
) -> tuple[float, ...]:
    """Return the driver positions from ``low`` to ``high`` in which a group's modes coincide.

    Only positions that the driver can pass through are found: the group closes on both sides.

    Parameters
    ----------
    draft, program
        A position plan that has the group.
    data : callable
        Returns the plan's data at unit scales for some positions, ndarray of shape (n,).
    around : bool
        The driver goes round: every turn is sampled equally.
    """

    def mode_distance(positions: Reals) -> Reals:
        with np.errstate(all="ignore"):
            return _mode_distance(draft, program, data(positions), group, positions)

    count = (SAMPLES - 1) * max(round((high - low) / 360.0), 1) + 1 if around else SAMPLES
    looks = np.linspace(low, high, count)
    there = np.array([np.inf, *mode_distance(looks), np.inf])
    least = (there[1:-1] <= there[:-2]) & (there[1:-1] < there[2:])
    found = []
    for i in map(int, np.flatnonzero(least & (np.abs(there[1:-1]) < 0.1))):
        one, two = looks[max(i - 1, 0)], looks[min(i + 1, count - 1)]
        for _ in range(_ROUNDS):
            fine = np.linspace(one, two, _PARTS + 1)
            here = mode_distance(fine)
            k = int(np.nanargmin(here))
            one, two = fine[max(k - 1, 0)], fine[min(k + 1, _PARTS)]
        if abs(here[k]) <= TOUCHING:
            found.append(float(fine[k]))
    return tuple(found)


def _mode_distance(
    draft: Draft,
    program: Program,
    data: dict[str, complex | float | Reals],
    group: AssurGroup,
    positions: Reals,
) -> Reals:
    """Return the squared distance of both modes, relative to the group's size."""
    trace = evaluate(program, data, Float64())

    def gap(p: str, q: str) -> Reals:
        ends = trace.value[PointName(q)] - trace.value[PointName(p)]
        return np.asarray(np.abs(ends), dtype=float)

    if group.signature == "RPR":
        _, host, slider = rpr_parts(draft, group)
        p, q = outer_point(host), outer_point(slider)
        feet = [step.out for step in program.steps if isinstance(step, Touch) and step.source == q]
        span = gap(p, q)
        found = trace.margin[feet[0]] if feet else (span / np.max(span)) ** 2
    else:
        c = inner_point(group)
        found = trace.margin[PointName(c)]
        if group.signature == "RRR":
            # Of two equal arcs about one place it is the line of centres that has no direction.
            p, q = (outer_point(lead) for lead in group.legs)
            span = gap(p, q)
            found = np.where(span == 0, 0.0, found * (span / gap(p, c)) ** 2)
    return np.broadcast_to(np.asarray(found, dtype=float), positions.shape)
