"""Whole turns of the links whose angles a mesh needs, and the period of its wheel (обороты)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import partial
from itertools import pairwise
from math import inf, isfinite

import numpy as np
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.evaluate import evaluate
from planmethod.construct.steps import NumberName
from planmethod.mechanism.groups import AssurGroup
from planmethod.plans.draft import Draft
from planmethod.plans.model import AssemblyMode, Turns, assembly_period
from planmethod.plans.motion.meshes import mesh_of
from planmethod.solved.reading import Reals

SAMPLES = 1440
"""Number of samples of a turn of the driver: no link turns by a half between two of them."""

HALVINGS = 60
"""Bisections of the interval in which the angle that is read jumps, down to the last bit."""

DENOMINATOR = 400
"""Greatest number of turns of the driver after which a wheel may stand as before."""

Data = Callable[[Draft, Reals], Mapping[str, Number]]


def count_turns(
    plan: Callable[[AssemblyMode], Draft], group: AssurGroup, data: Data, start: float
) -> AssemblyMode:
    """Return the mode of a wheel or a rack: whole turns of the links whose angles are read.

    A protractor reads an angle within a turn, but the other wheel of a pair turns in proportion to
    the whole one. The turns are counted from the first position of the file, in which the link is
    less than half a turn from the assembled position.

    Parameters
    ----------
    plan : callable
        Returns the position plan with the group in a mode.
    data : callable
        Returns the data of a plan in positions of the driver.
    start : float
        The first position of the file.
    """
    draft = plan(AssemblyMode(start=start))
    drive = draft.problem.drive
    turn = 360.0 if drive.goes_round else 0.0
    settled = {links: one for links, one in draft.choice.items() if links != group.links}
    period = assembly_period(settled, turn) if turn else 0.0
    if not isfinite(period):
        period = turn
    low, high = start, start + period
    if not period:
        reach = sum(abs(length) for _, _, length in draft.problem.lengths)
        if drive.is_crank:
            reach = 360.0
        low, high = start - reach, start + reach

    def read(name: str, at: Draft, positions: Reals) -> Reals:
        trace = evaluate(at.b.program(), data(at, positions), Float64())
        return np.broadcast_to(np.asarray(trace.value[NumberName(name)], float), positions.shape)

    found: dict[tuple[str, str], Turns] = {}
    count = SAMPLES * max(round(period / 360.0), 1) + 1
    mesh = mesh_of(draft.problem, group)
    for link in mesh.mesh.joined:
        name = f"angle_{mesh.pole}_{link}"
        if draft.b.has(name):
            places = np.linspace(low, high, count)
            ask = partial(read, name, draft)
            found[mesh.pole, link] = _counted(ask, places, period, start)
    mode = AssemblyMode(start=start, turns=found)
    (link,) = group.links
    body = draft.problem.bodies[link].points
    if not period or len({*body.values()}) == 1 or mesh.is_rack:
        return mode
    ends = np.array([low, low + period])
    first, last = read(f"phi_{link}", plan(mode), ends)
    if not np.isfinite(last - first):
        return mode
    net = float(last - first) / 360.0
    whole = Fraction(net).limit_denominator(DENOMINATOR)
    exact = abs(net - whole) <= 1e-9 * max(1.0, abs(net))
    return replace(mode, period_of_wheels=period * whole.denominator if exact else inf)


def _counted(read: Callable[[Reals], Reals], places: Reals, period: float, start: float) -> Turns:
    """Return the turns by the jumps of an angle that is read within (-180, 180] degrees."""
    values = read(places)
    able = np.flatnonzero(np.isfinite(values))
    jumps: list[float] = []
    counts = [0]
    for i, k in pairwise(able):
        step = values[k] - values[i]
        if abs(step) <= 180.0:
            continue
        one, two = float(places[i]), float(places[k])
        for _ in range(HALVINGS):
            middle = (one + two) / 2.0
            (value,) = read(np.array([middle]))
            one, two = (middle, two) if abs(value - values[i]) <= 180.0 else (one, middle)
        jumps.append(two)
        counts.append(counts[-1] - (1 if step > 0 else -1))
    at = counts[int(np.searchsorted(jumps, start, side="right"))]
    shifted = tuple(count - at for count in counts)
    return Turns(tuple(jumps), shifted, period, counts[-1] if period else 0, float(places[0]))
