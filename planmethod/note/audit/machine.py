"""Correct values for those a source prints of a machine and its flywheel (проверка маховика)."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace

from planmethod.note.compared_machine import compared_flywheel, compared_segment
from planmethod.note.numbers import is_negligible
from planmethod.problem.machine_records import FlywheelMethod, Quadrature, WeightSigns
from planmethod.problem.model import Problem
from planmethod.problem.selector import Selector
from planmethod.solved.machine.drawing import drawing_of
from planmethod.solved.machine.flywheel import Flywheel, flywheel_of, touching
from planmethod.solved.machine.sizes import size_of
from planmethod.solved.selectors.steps import NoValue, NoValueError
from planmethod.solved.solution import Solution


def machine_value(solution: Solution, selector: Selector) -> tuple[float, float | None]:
    """Return a quantity of a machine: exactly, SI and degrees, and as the construction is read.

    Raises
    ------
    NoValueError
        The file has no machine, or the machine no such position.
    """
    if solution.problem.machine is None:
        raise NoValueError(NoValue.NO_MACHINE)
    flywheel = flywheel_of(solution)
    drawing, kind = drawing_of(flywheel, solution.profile), selector.kind.partition(" ")[2]
    if selector.names:
        return _in_position(flywheel, kind, selector.names), None
    for name, compare in (
        (drawing.construction.segment, compared_segment),
        ("J_f", compared_flywheel),
    ):
        if kind == name:
            both = compare(drawing)
            return both.exact, both.read
    values = {
        "constant": flywheel.constant,
        "omega": flywheel.middle_speed,
        "delta": flywheel.machine.delta,
        "mu_phi": drawing.scales.phi,
        "mu_A": drawing.scales.work,
    }
    if not drawing.by_mertsalov:
        values |= {"psi_max": drawing.psi[0], "psi_min": drawing.psi[1]}
    sizes = size_of(flywheel.machine.wheel, flywheel.exact.inertia, flywheel.middle_speed)
    if sizes is not None:
        values |= {"D": sizes.diameter, "m": sizes.mass, "b": sizes.width}
    if kind not in values:
        raise NoValueError(NoValue.NO_QUANTITY)
    return values[kind], None


def _in_position(flywheel: Flywheel, kind: str, names: tuple[str, ...]) -> float:
    number = int(names[-1])
    if number >= flywheel.machine.count:
        raise NoValueError(NoValue.NO_POSITION)
    rows, half = flywheel.rows, flywheel.problem.drive.rate**2 / 2.0
    if kind == "energy":
        nothing = 0.0 * rows.inertia  # of a link without mass
        column = rows.parts.links.get(names[0], nothing) * half
    else:
        column = {"M": rows.moment, "J": rows.inertia, "T": rows.inertia * half}[kind]
    value = float(column[number])
    return 0.0 if is_negligible(value, float(np.max(np.abs(column))) * 1e-7) else value


def chain(problem: Problem) -> list[tuple[str, float]]:
    """Return the way from the printed flywheel to the exact one, an error less at each step.

    Returns
    -------
    list of (str, float)
        Names of the steps, keys of ``chain_steps``, and J_f of each, kg·m²; empty where the file
        does not print M and J of all positions of its table.
    """
    machine = problem.machine
    if machine is None:
        return []
    printed = {item.what: item.value for item in problem.published}
    count = machine.count
    tables = [[printed.get(f"machine {kind} {k}") for k in range(count)] for kind in ("M", "J")]
    moments, inertias = ([x for x in column if x is not None] for column in tables)
    if len(moments) != count or len(inertias) != count:
        return []
    source, true = (
        Flywheel(replace(problem, machine=replace(machine, signs=signs)))
        for signs in (WeightSigns.SOURCE, WeightSigns.TRUE)
    )
    speed = printed.get("machine omega", source.middle_speed)
    delta = printed.get("machine delta", machine.delta)
    exact = true.reduced(count).inertia
    mertsalov = machine.method is FlywheelMethod.MERTSALOV

    def polygon(column: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> float:
        """Return the flywheel of printed moments by trapezoids, with the printed numbers."""
        step = true.cycle / count
        closed = np.append(moments, moments[0])
        work = true.sign * np.append(0.0, np.cumsum(closed[1:] + closed[:-1]) * step / 2.0)
        turned = np.asarray(step * np.arange(count + 1), dtype=float)
        gain = true.sign * (work[-1] / true.cycle * turned - work)
        around = np.append(column, column[0])
        slopes = (1.0, 1.0) if mertsalov else (1.0 + delta, 1.0 - delta)
        return touching(turned, gain, around, slopes, speed, delta).inertia

    def by_points(wheel: Flywheel, number: int) -> float:
        slopes = wheel.usual_slopes
        return wheel.by_points(number, Quadrature.TRAPEZOID, slopes).tangents.inertia

    found, by = [], "_mertsalov" if mertsalov else ""
    segment = "machine AB" if mertsalov else "machine KL"
    if {segment, "machine mu_A"} <= printed.keys():
        cut = printed[segment] * printed["machine mu_A"]
        found.append((f"printed{by}", cut / (speed**2 * delta)))
    usual = true.tangents(*true.usual_slopes, true.middle_speed)
    return [
        *found,
        (f"tables{by}", polygon(np.array(inertias))),
        ("inertia", polygon(exact)),
        ("moments", by_points(source, count)),
        ("signs", by_points(true, count)),
        ("positions", by_points(true, 2 * count)),
        ("curve", usual.inertia),
        (f"exact{by}", true.exact.inertia),
    ]
