"""Loads that differ from position to position, as columns of numbers that a sweep is given."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

from planmethod.construct.steps import NumberName
from planmethod.plans.build import Construction
from planmethod.plans.forces.loads import numbers_of
from planmethod.problem.model import Problem
from planmethod.solved.forces.loads import changing, needs_motion
from planmethod.solved.reading import Reals
from planmethod.solved.solution import LinkMotion, PointMotion

Motion = Callable[[Reals], dict[str, Reals]]
"""Rows of a sweep of the motion by their names, in some positions."""


class SweptMotion:
    """Motion of a mechanism from a sweep, for `loads`: NaN where it does not exist."""

    def __init__(
        self, problem: Problem, construction: Construction, positions: Reals, motion: Motion
    ) -> None:
        self.problem, self.construction, self.positions = problem, construction, positions
        self._motion = motion

    @cached_property
    def _rows(self) -> dict[str, Reals]:
        return self._motion(self.positions)

    @cached_property
    def points(self) -> dict[str, PointMotion]:
        """Motion of every named point."""
        rows = self._rows
        return {
            name: PointMotion(
                *(
                    rows[f"{name}.{letter}x"] + 1j * rows[f"{name}.{letter}y"]
                    for letter in ("", "v", "a")
                )
            )
            for name in self.construction.kinematics.velocity.named
        }

    @cached_property
    def links(self) -> dict[str, LinkMotion]:
        """Motion of every moving link."""
        rows = self._rows
        return {
            link: LinkMotion(
                *(rows[f"{link}.{quantity}"] for quantity in ("phi_deg", "omega", "epsilon"))
            )
            for link in self.problem.mechanism.links
        }


class LoadColumns:
    """Loads of a problem that differ from position to position.

    Parameters
    ----------
    problem : Problem
    construction : Construction
    loads : sequence of (str, tuple of NumberName)
        Names, and the known numbers of a program that depend on each.
    motion : callable
        Function that sweeps the motion; called only for loads that depend on it.

    Attributes
    ----------
    names : tuple of NumberName
        Inputs of the program.
    loads : tuple of str
        Names of the loads, in the order of the inputs: two of a force, one of a couple.
    need_motion : bool
        True if some load depends on the motion.
    """

    def __init__(
        self,
        problem: Problem,
        construction: Construction,
        loads: Sequence[tuple[str, tuple[NumberName, ...]]],
        motion: Motion,
    ) -> None:
        self.problem, self.construction, self._motion = problem, construction, motion
        self._loads = tuple(loads)
        self.names = tuple(name for _, names in loads for name in names)
        self.loads = tuple(name for name, _ in loads)
        mine, dynamics = {name for name, _ in loads}, problem.dynamics
        assert dynamics is not None
        self.need_motion = any(needs_motion(load) for load in dynamics.loads if load.name in mine)

    def at(self, positions: Reals) -> list[Reals]:
        """Return the columns of the inputs in some positions, ndarrays of shape (n,).

        Raises
        ------
        ProblemError
            A load is known only in the file's positions, and others are requested.
        """
        moved = SweptMotion(self.problem, self.construction, positions, self._motion)
        found = changing(moved)
        return [number for name, _ in self._loads for number in numbers_of(found[name])]
