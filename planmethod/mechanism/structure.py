"""Structure of a mechanism from its links and joints alone (структурный анализ)."""

from __future__ import annotations

from dataclasses import dataclass

from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import Mechanism


@dataclass(frozen=True, slots=True)
class Structure:
    """Result of the structural analysis (структурный анализ).

    Attributes
    ----------
    mobility : int
        W = 3n - 2p1 - p2 by Chebyshev.
    moving_links, lower_pairs, higher_pairs : int
        n, p1, p2.
    spatial_mobility : int
        W of the spatial scheme, 6n - 5p1 (Malyshev).
    redundant : int
        q = W0 + W_M - W_spatial (избыточные связи), W0 the number of drivers, W_M local mobility.
    class_number : int
        Highest class of the groups; 1 when there is none.
    groups : tuple of AssurGroup
        In the order of kinematic analysis; force analysis goes the other way.
    formula : str
        ``I(0,1) → II(2,3) → II(4,5)``.
    """

    mobility: int
    moving_links: int
    lower_pairs: int
    higher_pairs: int
    spatial_mobility: int
    redundant: int
    class_number: int
    groups: tuple[AssurGroup, ...]
    formula: str


def analyse(mechanism: Mechanism) -> Structure:
    """Decompose a mechanism into its driver and Assur groups."""
    raise NotImplementedError
