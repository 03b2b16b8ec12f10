"""What a published value is: the short grammar of ``what`` in ``[published]``."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from planmethod.problem.names import near, short


@dataclass(frozen=True, slots=True)
class Selector:
    """One quantity of a solved problem (величина).

    Attributes
    ----------
    kind : str
        A key of `QUANTITIES`.
    names : tuple of str
        Points, or one link; the pole of a plan is ``p``. Coincident points have the number of
        their link: ``B3`` is the point of link 3 under the pin B.
    over : Selector or None
        Divisor of a quotient such as ``vx D / omega 1``.
    """

    kind: str
    names: tuple[str, ...]
    over: Selector | None = None


QUANTITIES: Mapping[str, tuple[int, ...]] = {
    "x": (1,),
    "y": (1,),
    "v": (1, 2),
    "vx": (1,),
    "vy": (1,),
    "a": (1, 2),
    "ax": (1,),
    "ay": (1,),
    "an": (2,),
    "at": (2,),
    "vs": (2,),
    "ar": (2,),
    "ak": (2,),
    "phi": (1,),
    "omega": (1,),
    "epsilon": (1,),
    "length": (2,),
    "segment velocity": (2,),
    "segment acceleration": (2,),
}
"""Kinds of quantity and how many names each may have."""

LINK_KINDS = frozenset({"phi", "omega", "epsilon"})
POLE = "p"


class SelectorError(ValueError):
    """A selector cannot be understood; the message says why."""


def parse_selector(text: str) -> Selector:
    """Parse ``what``.

    Examples
    --------
    >>> parse_selector("v C B")
    Selector(kind='v', names=('C', 'B'), over=None)

    Raises
    ------
    SelectorError
    """
    above, slash, below = text.partition("/")
    first = _parse_one(above)
    if not slash:
        return first
    if "/" in below:
        raise SelectorError("expected one division at most")
    return Selector(first.kind, first.names, _parse_one(below))


def _parse_one(text: str) -> Selector:
    words = text.split()
    if words and words[0] == "segment":
        words[:2] = [" ".join(words[:2])]
    if not words:
        raise SelectorError('expected a quantity such as "v C", got nothing')
    kind, *names = words
    if kind not in QUANTITIES:
        guess = near(kind, QUANTITIES)
        tail = f" (the nearest is '{guess}')" if guess else ""
        raise SelectorError(f"unknown quantity '{short(kind)}'{tail}")
    counts = QUANTITIES[kind]
    if len(names) not in counts:
        wanted = " or ".join(map(str, counts))
        raise SelectorError(f"'{kind}' goes with {wanted} names, got {len(names)}")
    if len(set(names)) != len(names):
        raise SelectorError(f"'{kind}' needs two different names")
    return Selector(kind, tuple(names))


def unknown_names(selector: Selector, points: Collection[str], links: Collection[str]) -> list[str]:
    """Names of a selector that the mechanism does not have.

    Parameters
    ----------
    points : collection of str
        Points, coincident ones such as ``B3`` among them.
    """
    if selector.kind in LINK_KINDS:
        found = [name for name in selector.names if name not in links]
    else:
        extra = {POLE} if selector.kind.startswith("segment") else set()
        found = [name for name in selector.names if name not in points and name not in extra]
    return found + (unknown_names(selector.over, points, links) if selector.over else [])
