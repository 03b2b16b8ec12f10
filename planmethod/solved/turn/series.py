"""Any quantity of the motion over the turn: places, analogues, velocities (величины за цикл)."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from planmethod.construct.steps import PointName
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem.graphs import OF_POINTS, OUTPUT, GraphQuantity, graph_quantities, ratio_of
from planmethod.solved.quantities import UnknownQuantityError
from planmethod.solved.reading import Reals
from planmethod.solved.turn.cycle import CrankCycle


def quantities_over(cycle: CrankCycle, labels: Iterable[str]) -> list[GraphQuantity]:
    """Return the quantities of some labels, in their order, each once.

    Raises
    ------
    UnknownQuantityError
    """
    velocity = cycle.unit.construction.kinematics.velocity
    points = [name for name, at in velocity.named.items() if velocity.point[at] != velocity.pole]
    crank = cycle.unit.problem.drive.link
    known = graph_quantities(points, _links(cycle), crank)
    found: dict[str, GraphQuantity] = {}
    for asked in labels:
        for label in usual_labels(cycle) if asked == OUTPUT else (asked,):
            if label not in known:
                from difflib import get_close_matches

                near = get_close_matches(label, known, 1)
                hint = translate("; did you mean {!r}?", near[0]) if near else "."
                usual = ", ".join(usual_labels(cycle))
                raise UnknownQuantityError(
                    "no quantity {!r} over the turn{} For example: {}.", label, hint, usual
                )
            found[label] = known[label]
    return list(found.values())


def _links(cycle: CrankCycle) -> list[str]:
    return [link for link in cycle.unit.problem.mechanism.links if link != FRAME]


def usual_labels(cycle: CrankCycle) -> tuple[str, ...]:
    """Return the place of the output and its transfer functions."""
    output = cycle.output
    if output.slide is not None:
        kinds = ("x", "y", "v_qx", "v_qy", "a_qx", "a_qy")
        return tuple(f"{kind}_{output.point}" for kind in kinds)
    ratio = ratio_of(output.link, cycle.unit.problem.drive.link, _links(cycle))
    return f"phi_{output.link}", f"u_{ratio}", f"epsilon_q_{output.link}"


def values_over(cycle: CrankCycle, quantity: GraphQuantity, positions: Reals) -> Reals:
    """Return a quantity in positions of the crank, SI; NaN where the mechanism is open.

    Angles, degrees, continue through whole turns from position to position.
    """
    with np.errstate(invalid="ignore"):
        made = _of_point if quantity.kind in OF_POINTS else _of_link
        return made(cycle, quantity, positions)


def _of_point(cycle: CrankCycle, quantity: GraphQuantity, positions: Reals) -> Reals:
    reading, construction = cycle.read(positions), cycle.unit.construction
    kinematics, drive, kind = construction.kinematics, cycle.solution.problem.drive, quantity.kind
    at = kinematics.velocity.named[quantity.of]
    if kind in "xy":
        place = reading.point(PointName(at[1])) + construction.draft.origin
        return np.asarray(place.real if kind == "x" else place.imag)
    first, second = (m.point[at] for m in (kinematics.velocity, kinematics.acceleration))
    one, two = reading.point(first), reading.point(second)
    vector = {
        "v_q": one,
        "v": one * drive.rate,
        "a_q": two,
        "a": two * drive.rate**2 + one * drive.acceleration,
    }[kind]
    parts = {"x": vector.real, "y": vector.imag, "": np.abs(vector)}
    return np.asarray(parts[quantity.axis])


def _of_link(cycle: CrankCycle, quantity: GraphQuantity, positions: Reals) -> Reals:
    reading, construction = cycle.read(positions), cycle.unit.construction
    course = reading.line_vector(construction.draft.axes[quantity.of])
    there = np.isfinite(course)
    if quantity.kind == "phi":
        angle = np.angle(course)
        angle[there] = np.unwrap(angle[there])
        return np.degrees(angle)
    kinematics, drive = construction.kinematics, cycle.solution.problem.drive
    names = kinematics.omega.get(quantity.of), kinematics.epsilon.get(quantity.of)
    u, e = (np.zeros(len(positions)) if name is None else reading.number(name) for name in names)
    found = {
        "u": u,
        "omega": u * drive.rate,
        "epsilon_q": e,
        "epsilon": e * drive.rate**2 + u * drive.acceleration,
    }[quantity.kind]
    return np.where(there, found, np.nan)
