"""Structure of a mechanism from its links and joints alone (структурный анализ)."""

from __future__ import annotations

from msgspec import Struct

from planmethod.errors import StructureError
from planmethod.mechanism.decompose import Node, blocks
from planmethod.mechanism.groups import AssurGroup, joints_of_links, make_group
from planmethod.mechanism.mobility import reject_immovable, reject_unbalanced
from planmethod.mechanism.model import FRAME, Mechanism

DRIVER_COUNT = 1
"""Number of drivers W0 (число начальных звеньев)."""


class Structure(Struct, frozen=True):
    """Result of the structural analysis (структурный анализ).

    Attributes
    ----------
    mobility : int
        W = 3n - 2p1 - p2 by Chebyshev.
    moving_links, lower_pairs, higher_pairs : int
        n, p1, p2 of the mechanism with its higher pairs and rollers, not of that which replaces it.
    spatial_mobility : int
        W of the spatial scheme, 6n - 5p1 - 2p4 (Somov and Malyshev); profiles touch along a line.
    redundant : int
        q = W0 + W_M - W_spatial (избыточные связи), W0 the number of drivers.
    local_mobility : int
        W_M, rollers that turn about themselves (местные подвижности).
    class_number : int
        Highest class of the groups; 1 when there is none.
    groups : tuple of AssurGroup
        In the order of kinematic analysis.
    formula : str
        ``I(0,1) → II(2,3) → II(4,5)``.
    """

    mobility: int
    moving_links: int
    lower_pairs: int
    higher_pairs: int
    spatial_mobility: int
    redundant: int
    local_mobility: int
    class_number: int
    groups: tuple[AssurGroup, ...]
    formula: str

    @property
    def force_order(self) -> tuple[AssurGroup, ...]:
        """Groups in the order of force analysis (порядок силового расчёта): the last first."""
        return self.groups[::-1]

    def group_of(self, link: str) -> AssurGroup | None:
        """Group that a link belongs to; None for the driver and the frame."""
        return next((group for group in self.groups if link in group.links), None)


def analyse(mechanism: Mechanism) -> Structure:
    """Decompose a mechanism into its driver and Assur groups (структурный анализ по Ассуру).

    Links (three unknowns each) and shared moving points (two each) on one side, points of links and
    prismatic pairs (two equations each) on the other make a square system as soon as frame and
    driver are known. The irreducible blocks of its Dulmage-Mendelsohn decomposition are the Assur
    groups. A point shared by k links is closed by the group that can reach it first, and links of
    later groups are joined to it.

    Parameters
    ----------
    mechanism : Mechanism
        One driver, joined with the frame by one pair.

    Returns
    -------
    Structure
        Groups in the order of kinematic analysis, groups that do not depend on each other in file
        order.

    Raises
    ------
    StructureError
        If links are not connected with the frame, the driver is not joined with it, W is not 1,
        prismatic pairs alone close a contour, or a part is overconstrained while another is loose.
    """
    reject_immovable(mechanism)
    reject_unbalanced(mechanism)
    groups = _groups(mechanism)
    high = len(mechanism.higher)
    local = sum(pair.roller != "" for pair in mechanism.higher)
    n, p1 = len(mechanism.links) - high + local, mechanism.lower_pairs - 2 * high + local
    spatial = 6 * n - 5 * p1 - 2 * high
    parts = [f"I({mechanism.frame},{mechanism.driver})"]
    parts += [f"{roman(group.class_number)}({','.join(group.links)})" for group in groups]
    return Structure(
        mobility=3 * n - 2 * p1 - high,
        moving_links=n,
        lower_pairs=p1,
        higher_pairs=high,
        spatial_mobility=spatial,
        redundant=DRIVER_COUNT + local - spatial,
        local_mobility=local,
        class_number=max((group.class_number for group in groups), default=1),
        groups=groups,
        formula=" → ".join(parts),
    )


def roman(number: int) -> str:
    """Roman numeral of a class (римская цифра)."""
    text = ""
    for value, sign in ((50, "L"), (40, "XL"), (10, "X"), (9, "IX"), (5, "V"), (4, "IV"), (1, "I")):
        text += sign * (number // value)
        number %= value
    return text


def _groups(mechanism: Mechanism) -> tuple[AssurGroup, ...]:
    """Blocks of the system of links and moving points that remain when the driver is known."""
    given = (FRAME, mechanism.driver)
    size: dict[Node, int] = {
        ("link", link): 3 for link in mechanism.links if link != mechanism.driver
    }
    rank = {node: i for i, node in enumerate(size)}
    equations: list[tuple[Node, ...]] = []
    for revolute in mechanism.revolutes:
        point: tuple[Node, ...] = (("point", revolute.point),)
        if any(link in given for link in revolute.links):
            point = ()
        else:
            size[point[0]] = 2
        for link in revolute.links:
            if link not in given:
                equations += [(("link", link), *point)] * 2
    for pair in mechanism.prismatics:
        ends = tuple(("link", link) for link in (pair.slider, pair.host) if link not in given)
        if ends:
            equations += [ends] * 2
    found = blocks(equations, size, rank)
    if found is None:  # the balance of links and pairs has been proved before
        raise StructureError("The links and pairs of the mechanism do not balance")
    groups = []
    order = {link: i for i, link in enumerate(mechanism.links)}
    joints_of, known = joints_of_links(mechanism), {link: i for i, link in enumerate(given)}
    for block in found:
        links = [str(node[1]) for node in block if isinstance(node, tuple) and node[0] == "link"]
        if links:  # otherwise a point that a known link carries to later groups
            links.sort(key=order.__getitem__)
            groups.append(make_group(joints_of, links, known))
            known |= {link: len(known) + i for i, link in enumerate(links)}
    return tuple(groups)
