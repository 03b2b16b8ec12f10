"""Reduced moments and inertia of a machine (приведённые моменты сил и момент инерции).

The loads on the links are reduced to the crank by powers, their inertia by kinetic energies, both
with the velocities of the plans. A moment is positive where it resists the turning of the crank.
"""

from __future__ import annotations

import numpy as np
from msgspec import Struct

from planmethod.construct.curves import Piecewise, resolved
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.problem.machine_records import Machine, WeightSigns
from planmethod.problem.records import Spring
from planmethod.solved.cycle_motion import CycleMotion, MotionState
from planmethod.solved.forces.laws import MotionValues, breaks
from planmethod.solved.forces.loads import external, power
from planmethod.solved.reading import Reals

NEVER = 1e-12
"""Fraction of the largest power below which a load does no work."""


class Reduced(Struct, frozen=True):
    """Quantities reduced to the crank, in some positions, ndarrays of shape (n,).

    Attributes
    ----------
    loads : mapping of str to ndarray, N·m
        Reduced moment of each external load by its name; positive where it resists.
    weights : ndarray, N·m
        That of all weights, with the sign in which they are added.
    links : mapping of str to ndarray, kg·m²
        Share of each link that has mass in the reduced moment of inertia.
    inertia : ndarray, kg·m²
        The whole of it, that on the crank with it.
    slope : ndarray, kg·m²
        Its derivative by the angle turned, rad.
    """

    loads: dict[str, Reals]
    weights: Reals
    links: dict[str, Reals]
    inertia: Reals
    slope: Reals

    @property
    def moment(self) -> Reals:
        """Total reduced moment, N·m."""
        return np.asarray(sum(self.loads.values(), self.weights), dtype=float)


def reduce(motion: MotionValues, machine: Machine) -> Reduced:
    """Reduce loads, weights and masses to the crank, which turns evenly (привести к кривошипу).

    Parameters
    ----------
    motion : MotionValues
        With a driver that does not speed up.
    """
    problem = motion.problem
    drive, dynamics = problem.drive, problem.dynamics
    assert dynamics is not None, "a machine has loads"
    speed = abs(drive.rate)
    nothing = np.zeros(motion.positions.shape)
    loads = {
        one.name: -power(motion, one) / speed
        for link in problem.mechanism.links
        for one in external(motion, dynamics, link)
    }
    weights, growth, links = nothing, nothing, {}
    for link, mass in dynamics.masses.items():
        turning = motion.links[link]
        links[link] = mass.inertia * turning.omega**2 / speed**2
        growth = growth + mass.inertia * turning.omega * turning.epsilon
        if mass.centre is None or not mass.mass:
            continue
        centre = motion.points[mass.centre]
        weights = weights + mass.mass * dynamics.gravity * centre.velocity.imag / speed
        links[link] = links[link] + mass.mass * np.abs(centre.velocity) ** 2 / speed**2
        growth = growth + mass.mass * (centre.velocity.conjugate() * centre.acceleration).real
    if machine.signs is WeightSigns.SOURCE:
        weights = -weights
    inertia = np.asarray(sum(links.values(), nothing), dtype=float) + machine.crank_inertia
    return Reduced(loads, weights, links, inertia, 2.0 * growth / speed**3)


def reduced_curves(cycle_motion: CycleMotion, machine: Machine) -> Piecewise:
    """Return moment, inertia and its slope over the cycle as polynomials of the angle of rotation.

    Raises
    ------
    ProblemError
        A load is known in the positions of the file only, or never works.
    """
    problem = cycle_motion.problem
    dynamics = problem.dynamics
    assert dynamics is not None
    own = [breaks(cycle_motion, load) for load in dynamics.loads]
    cuts = [cycle_motion.curve.edges, *own]
    edges = np.unique(np.concatenate(cuts))
    edges = edges[np.append(True, np.diff(edges) > 1e-12)]
    edges[0], edges[-1] = 0.0, cycle_motion.cycle
    names = [load.name for load in dynamics.loads]

    def stacked(motion: MotionState) -> Reals:
        found = reduce(motion, machine)
        nothing = np.zeros(motion.positions.shape)
        moments = [found.loads.get(name, nothing) for name in names]
        return np.stack([*moments, found.weights, found.inertia, found.slope], axis=1)

    def read(rotation: Reals) -> Reals:
        return stacked(cycle_motion.at(rotation))

    largest = np.max(np.abs(stacked(cycle_motion.sampled)), axis=0)
    largest[:-2] = float(np.max(largest[:-2]))
    made = resolved(read, edges, np.where(largest > 0.0, largest, 1.0))
    peaks = np.max(np.abs(made(made.samples)), axis=0)
    for load, peak in zip(dynamics.loads, peaks[:-3], strict=True):
        idle = peak <= NEVER * peaks[:-2].max()
        if idle and not isinstance(load.size, Spring):  # one end of a spring may be at rest
            text = translate("{} does no work: its power is 0 over the whole cycle", load.name)
            hint = "Check its point, its direction and its phases."
            raise ProblemError(problem.name, [Fault(load.path, text, hint)])
    sums = np.zeros((len(peaks), 3))
    sums[:-2, 0] = sums[-2, 1] = sums[-1, 2] = 1.0
    return Piecewise(made.edges, made.terms @ sums)
