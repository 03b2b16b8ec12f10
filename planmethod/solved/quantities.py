"""Every quantity of a construction by its label, and the program that makes it (величины)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from msgspec import Struct

from planmethod.construct.program import Program
from planmethod.construct.steps import NumberName
from planmethod.errors import PlanMethodError
from planmethod.languages import translate
from planmethod.plans.build import Construction
from planmethod.plans.draft import Draft
from planmethod.plans.legend import TRANSFERS, Quantity, QuantityKind
from planmethod.plans.transfers import transfer_quantities

BY_NAME = (QuantityKind.UNIT, QuantityKind.CORIOLIS, QuantityKind.RELATIVE, *TRANSFERS)
"""Kinds of quantities that are given only when requested by name."""

ACCELERATIONS = (QuantityKind.ACCELERATION, QuantityKind.CORIOLIS, QuantityKind.RELATIVE)
"""Kinds of accelerations, m/s²."""


class UnknownQuantityError(PlanMethodError, ValueError):
    """The problem does not have a requested quantity."""


class Quantities(Struct, frozen=True):
    """All quantities of a construction, and the program that makes them.

    Attributes
    ----------
    program : Program
        The construction's, and the own axes of links that it has no line for.
    numbers : mapping
        Known numbers of the program; for forces also the starts of their plans.
    all : tuple of Quantity
        Points in the order of the plans: place, velocity, acceleration; then links; then forces.
    draft : Draft
        Draft of the program.
    changing : tuple of (str, tuple of NumberName)
        Loads that differ from position to position, by name, and the known numbers of each.
    """

    program: Program
    numbers: Mapping[str, complex | float]
    all: tuple[Quantity, ...]
    draft: Draft
    changing: tuple[tuple[str, tuple[NumberName, ...]], ...] = ()

    def choose(self, labels: Iterable[str] | None) -> tuple[Quantity, ...]:
        """Return the results of some labels, in their order; for None all that have columns.

        ``positions``, ``velocities``, ``accelerations``, ``forces``, ``transfers`` and ``units``
        select the whole group.

        Raises
        ------
        UnknownQuantityError
        """
        if labels is None:
            return tuple(result for result in self.all if result.kind not in BY_NAME)
        chosen: dict[str, Quantity] = {}
        for label in labels:
            chosen.update((result.label, result) for result in self._named(label))
        return tuple(chosen.values())

    def find(self, label: str) -> Sequence[Quantity]:
        """Return the results of a label or a column name; none if it is unknown."""
        if label in QUANTITY_GROUPS:
            return [result for result in self.all if result.kind in QUANTITY_GROUPS[label]]
        found = [result for result in self.all if result.label == label]
        return found or [result for result in self.all if label in result.columns]

    def _named(self, label: str) -> Sequence[Quantity]:
        found = self.find(label)
        if not found:
            known = [result.label for result in self.all]
            known += [word for word in QUANTITY_GROUPS if self.find(word)]
            # For a reaction, the opposite one is meant before any other with the same spelling.
            near = [result.label for result in self.all if result.opposite == label]
            from difflib import get_close_matches

            near = near or get_close_matches(label, known, 1)
            hint = translate("; did you mean {!r}?", near[0]) if near else "."
            raise UnknownQuantityError("no result {!r}{} Known: {}.", label, hint, ", ".join(known))
        return found


def natural_size(kind: QuantityKind, largest: Mapping[QuantityKind, Any]) -> Any:
    """Return the size with which a result of a kind is compared, given the largest of each kind.

    Accelerations may all be zero while links turn: omega squared, and omega times the largest
    velocity, are what they are made of. Coriolis' and the relative one are terms of accelerations,
    and small against those. Numbers or arrays alike.
    """
    turning = largest[QuantityKind.OMEGA]
    if kind is QuantityKind.EPSILON:
        return np.maximum(largest[kind], turning**2)
    if kind in ACCELERATIONS:
        whole = np.maximum(largest[kind], largest[QuantityKind.ACCELERATION])
        return np.maximum(whole, turning * largest[QuantityKind.VELOCITY])
    return largest[kind]


QUANTITY_GROUPS = {
    "positions": (QuantityKind.PLACE, QuantityKind.DIRECTION),
    "velocities": (QuantityKind.VELOCITY, QuantityKind.OMEGA, QuantityKind.SLIDING),
    "accelerations": (QuantityKind.ACCELERATION, QuantityKind.EPSILON),
    "forces": tuple(kind for kind in QuantityKind if kind.is_force),
    "units": (QuantityKind.UNIT,),
    "transfers": TRANSFERS,
}
"""Groups of results that can be requested at once."""


def quantities_of(construction: Construction, *, transfers: bool = False) -> Quantities:
    """Return every quantity of a construction, with transfer functions if requested."""
    draft, found = construction.draft.copy(), construction.legend
    if transfers:
        found = (*found, *transfer_quantities(construction.kinematics, draft))
    return Quantities(draft.b.program(), draft.numbers, found, draft)
