"""Quantities of points and links that have graphs over the turn, by label (графики).

The labels are those of ``--ask``, and components: ``x_C``, ``phi_3``, ``v_q_C``, ``v_qx_C``,
``u_31``, ``omega_3``, ``ay_D``.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from msgspec import Struct

OF_POINTS = {"x": "m", "y": "m", "v_q": "m", "v": "m/s", "a_q": "m", "a": "m/s²"}
"""Kinds of quantities of points and their units; of vectors the size, and both components."""

OF_LINKS = {"phi": "deg", "u": "", "omega": "1/s", "epsilon_q": "", "epsilon": "1/s²"}
"""Kinds of quantities of links and their units; none of a ratio."""

OUTPUT = "output"
"""Stands for the place of the output and its transfer functions."""

_SIGNS = {"phi": "φ", "omega": "ω", "epsilon": "ε", "epsilon_q": "ε"}


class GraphQuantity(Struct, frozen=True):
    """A quantity that is shown over the turn (величина графика).

    Attributes
    ----------
    label : str
    kind : str
        A key of `OF_POINTS` or of `OF_LINKS`.
    axis : str
        ``x``, ``y`` of a component; empty for a magnitude, and for a scalar.
    of : str
        The point, or the link.
    symbol : str
        Rich text.
    """

    label: str
    kind: str
    axis: str
    of: str
    symbol: str

    @property
    def unit(self) -> str:
        """Unit in SI, degrees of angles; empty of a ratio."""
        return {**OF_POINTS, **OF_LINKS}[self.kind]

    @property
    def family(self) -> str:
        """Key of its diagram: coordinates share one, others one for each letter."""
        return "x" if self.kind == "y" else self.kind


def graph_quantities(
    points: Iterable[str], links: Collection[str], crank: str
) -> dict[str, GraphQuantity]:
    """Return every quantity that has a graph over the turn, by its label.

    Parameters
    ----------
    points, links : iterables of str
        Of the moving links.
    crank : str
        The driving link, of which transfer functions are 1 and 0.
    """
    found: list[GraphQuantity] = []
    for point in points:
        for kind in OF_POINTS:
            head, _, of = kind.partition("_")
            for axis in ("",) if kind in "xy" else ("", "x", "y"):
                symbol = f"{head}_{{{of}{point}{axis}}}"
                found.append(GraphQuantity(f"{kind}{axis}_{point}", kind, axis, point, symbol))
    for link in links:
        for kind in OF_LINKS:
            if link == crank and kind in ("u", "epsilon_q"):
                continue
            of = ratio_of(link, crank, links) if kind == "u" else link
            index = f"q{link}" if kind == "epsilon_q" else of
            symbol = f"{_SIGNS.get(kind, kind)}_{{{index}}}"
            found.append(GraphQuantity(f"{kind}_{of}", kind, "", link, symbol))
    return {one.label: one for one in found}


def ratio_of(link: str, crank: str, links: Collection[str]) -> str:
    """Return the index of a ratio: ``21``; ``12/1`` where that is ambiguous."""
    plain = f"{link}{crank}"
    return plain if len(plain) == 2 and plain not in links else f"{link}/{crank}"
