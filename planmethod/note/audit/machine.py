"""What a source prints of a machine and its flywheel, as it should be (проверка маховика)."""

from __future__ import annotations

import numpy as np

from planmethod.note.numbers import is_nothing
from planmethod.problem.selector import Selector
from planmethod.solved.machine.drawing import drawing_of
from planmethod.solved.machine.flywheel import Flywheel, flywheel_of
from planmethod.solved.machine.sizes import size_of
from planmethod.solved.selected.asking import NoAnswer, UnansweredError
from planmethod.solved.solution import Solution


def machine_value(solution: Solution, selector: Selector) -> tuple[float, float | None]:
    """Return a quantity of a machine: exactly, SI and degrees, and as the construction is read.

    Raises
    ------
    UnansweredError
        The file has no machine, or the machine no such position.
    """
    if solution.problem.machine is None:
        raise UnansweredError(NoAnswer.NO_MACHINE)
    flywheel = flywheel_of(solution)
    drawing, kind = drawing_of(flywheel, solution.profile), selector.kind.partition(" ")[2]
    if selector.names:
        return _in_position(flywheel, kind, selector.names), None
    if kind == "KL":
        readings = drawing.exact, drawing.by_hand
        exact, read = (float(reading.number(drawing.made.KL)[0]) for reading in readings)
        return exact, read
    if kind == "J_f":
        return flywheel.exact.inertia, drawing.read_inertia
    values = {
        "constant": flywheel.constant,
        "mu_phi": drawing.scales.phi,
        "mu_A": drawing.scales.work,
        "psi_max": drawing.psi[0],
        "psi_min": drawing.psi[1],
    }
    sizes = size_of(flywheel.machine.wheel, flywheel.exact.inertia, flywheel.middle_speed)
    if sizes is not None:
        values |= {"D": sizes.diameter, "m": sizes.mass, "b": sizes.width}
    if kind not in values:
        raise UnansweredError(NoAnswer.NO_WHAT)
    return values[kind], None


def _in_position(flywheel: Flywheel, kind: str, names: tuple[str, ...]) -> float:
    number = int(names[-1])
    if number >= flywheel.machine.count:
        raise UnansweredError(NoAnswer.NO_POSITION)
    rows, half = flywheel.rows, flywheel.problem.drive.rate**2 / 2.0
    if kind == "energy":
        nothing = 0.0 * rows.inertia  # of a link without mass
        column = rows.parts.links.get(names[0], nothing) * half
    else:
        column = {"M": rows.moment, "J": rows.inertia, "T": rows.inertia * half}[kind]
    value = float(column[number])
    return 0.0 if is_nothing(value, float(np.max(np.abs(column))) * 1e-7) else value
