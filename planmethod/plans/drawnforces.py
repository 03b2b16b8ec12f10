"""Force plans as a hand draws them: what the ruler gives, and how far it may be off.

The errors of position and acceleration plans go on into the force plans: it is one program.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from planmethod.construct.arithmetic import Number
from planmethod.construct.drafting import Counted, Propagated, Sampled
from planmethod.construct.dual import as_dual
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.plans.solution import Reals

if TYPE_CHECKING:
    from planmethod.plans.statics import Statics

BLOCK = 64
"""Positions whose drafting errors are carried at once."""


@dataclass(frozen=True, slots=True)
class Balances:
    """What balances the driver by the force plans and by the lever, N·m or N, shape (n,)."""

    plans: Reals
    lever: Reals

    def share(self, index: int) -> float | None:
        """Return how far the lever is from the force plans, per cent; None where those give 0."""
        plans, lever = float(self.plans[index]), float(self.lever[index])
        return 100.0 * abs(lever - plans) / abs(plans) if plans else None


class DrawnForces:
    """Force plans of a draughtsman (планы сил на бумаге).

    Parameters
    ----------
    statics : Statics
        Its solution names the hand and its profile.
    """

    def __init__(self, statics: Statics) -> None:
        self.statics, self.solution = statics, statics.solution
        poles = {str(plan.pole) for plan in self.solution.construction.plans}
        # The poles may stand anywhere: they cannot be off.
        self._free = frozenset(poles | {str(start) for start in statics.board.starts})

    def _taken(self, trace: Trace, pencil: Any) -> dict[str, Number]:
        """Return reactions (by their number), balances and their difference from a trace."""
        statics = self.statics
        with np.errstate(all="ignore"):
            taken: dict[str, Number] = {"plans": statics.balance_in(trace, pencil)}
            for k, reaction in enumerate(statics.board.reactions):
                force = trace.value[reaction.force.head] - trace.value[reaction.force.tail]
                length = pencil.read(f"reaction {k}", abs(force))
                taken[str(k)] = length * statics.scale.per_mm
            if statics.hung is not None:
                taken["lever"] = trace.value[statics.hung.balance]
                taken["difference"] = taken["lever"] - taken["plans"]
        return taken

    def _draw(self, pencil: Any, chosen: npt.NDArray[np.intp]) -> dict[str, Number]:
        data = self.statics.data(self.statics.per_mm, chosen)
        return self._taken(evaluate(self.statics.program, data, pencil), pencil)

    @cached_property
    def _sigmas(self) -> Mapping[str, Reals]:
        """One sigma of everything that is taken, to first order, by its label."""
        profile, count = self.solution.profile, len(self.solution.positions)
        counted = Counted(profile, self._free)
        self._draw(counted, np.zeros(1, dtype=int))
        parts: list[dict[str, Reals]] = []
        for start in range(0, count, BLOCK):
            chosen = np.arange(start, min(start + BLOCK, count))
            taken = self._draw(Propagated(profile, self._free, counted.causes), chosen)
            parts.append({label: _sigma(value, len(chosen)) for label, value in taken.items()})
        return {label: np.concatenate([part[label] for part in parts]) for label in parts[0]}

    @cached_property
    def _by_hand(self) -> dict[str, Reals]:
        shape = self.solution.positions.shape
        return {
            label: np.broadcast_to(np.asarray(value, dtype=float), shape)
            for label, value in self._taken(self.statics.by_hand, self.solution.hand).items()
        }

    def read(self, number: int) -> Reals:
        """Return the size of a reaction as the ruler gives it, N, shape (n,)."""
        return self._by_hand[str(number)]

    def sigma(self, number: int) -> Reals:
        """Return one sigma of the size of a reaction, N, shape (n,)."""
        return self._sigmas[str(number)]

    @property
    def balance(self) -> Reals:
        """What balances the driver by the force plans, as the ruler gives it, N·m or N."""
        return self._by_hand["plans"]

    @property
    def balances(self) -> Balances | None:
        """The same by the force plans and by the lever; None where the driver stands."""
        if "lever" not in self._by_hand:
            return None
        return Balances(self.balance, self._by_hand["lever"])

    @property
    def discrepancy_sigma(self) -> Reals | None:
        """Expected size of lever minus force plans: one sigma, N·m or N; shape (n,).

        None where the driver stands.
        """
        return self._sigmas.get("difference")

    def sample(self, index: int, *, draws: int, seed: int = 1) -> dict[str, Reals]:
        """Return one position from random sheets: arrays of shape (draws,).

        The labels are the numbers of the reactions, ``plans``, ``lever`` and ``difference``.
        """
        pencil = Sampled(self.solution.profile, self._free, draws, seed)
        return {
            label: np.broadcast_to(np.asarray(value, dtype=float), (draws,))
            for label, value in self._draw(pencil, np.array([index])).items()
        }


def _sigma(value: Number, count: int) -> Reals:
    slope = as_dual(value).slope
    squares = np.zeros((1, 1)) if slope is None else slope**2
    return np.broadcast_to(np.sqrt(np.sum(squares, axis=0)), (count,))
