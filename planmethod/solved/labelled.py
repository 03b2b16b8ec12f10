"""Quantities that labels name: forces are planned only where a label needs them."""

from __future__ import annotations

import re
from collections.abc import Iterable

from planmethod.plans.legend import TRANSFERS, QuantityKind
from planmethod.solved.quantities import Quantities, UnknownQuantityError, quantities_of
from planmethod.solved.solution import Solution

TRANSFER = re.compile("|".join(f"{kind.letter}_" for kind in TRANSFERS)).match
"""Pattern of labels of transfer functions, which are planned only if one is requested."""


def quantities_for(
    solution: Solution, labels: Iterable[str] | None, *, forces: bool = False
) -> Quantities:
    """Return the quantities that include all labelled ones: forces are planned only if needed.

    Parameters
    ----------
    labels : iterable of str, optional
        Default: everything of the motion.
    forces : bool
        If no labels are given: everything of the forces, too.

    Raises
    ------
    UnknownQuantityError
        A force of a problem without masses and loads is requested.
    """
    quantities = quantities_of(solution.construction)
    if labels is not None:
        labels = tuple(labels)
        if any(label == "transfers" or TRANSFER(label) for label in labels):
            quantities = quantities_of(solution.construction, transfers=True)
    other = () if labels is None else [label for label in labels if not quantities.find(label)]
    if not (other or (forces and labels is None)):
        return quantities
    if solution.problem.dynamics is not None:
        from planmethod.solved.forces.quantities import with_forces

        return with_forces(solution, quantities)
    letters = {kind.letter for kind in QuantityKind if kind.is_force}
    for label in other:
        if label == "forces" or label.partition("_")[0] in letters:
            raise UnknownQuantityError(
                "no result {!r}: the problem has no loads. Give the masses in [dynamics] and "
                "the loads in [[loads]].",
                label,
            )
    return quantities
