"""Published values (напечатанные значения) and the short grammar of their ``what``."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from enum import Enum
from functools import partial
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import keys
from planmethod.problem.common import Published
from planmethod.problem.file_node import FileNode, is_integer, needed
from planmethod.problem.names import (
    indexed,
    listed,
    nearest_name,
    nearest_name_hint,
    short,
)

if TYPE_CHECKING:
    from planmethod.problem.load_records import Dynamics


class Selector(Struct, frozen=True):
    """One quantity of a solved problem (величина).

    Attributes
    ----------
    kind : str
        A key of `QUANTITIES` or of `FORCES`.
    names : tuple of str
        Points, or one link; the pole of a plan is ``p``. Coincident points have the number of
        their link: ``B3`` is the point of link 3 under the pin B. For a force: by the
        `NameRole` of each.
    over : Selector or None
        Divisor of a quotient such as ``vx D / omega 1``.
    """

    kind: str
    names: tuple[str, ...]
    over: Selector | None = None


ANALOGUES = ("x1", "y1", "x2", "y2", "phi1", "phi2")
"""First and second derivatives by the coordinate of the driver (аналоги), as JSON has them."""

TRANSFERS = ("v_q", "a_q", "u", "epsilon_q")
"""Transfer functions as the plans give them: of a point, of two links, of a link."""

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
    **dict.fromkeys(ANALOGUES, (1,)),
    **dict.fromkeys(TRANSFERS, (1,)),
    "u": (2,),
}
"""Kinds of quantity of the motion, and how many names each may have."""

LINK_KINDS = frozenset({"phi", "omega", "epsilon", "phi1", "phi2", "u", "epsilon_q"})
POLE = "p"


class NameRole(Enum):
    """Role of a name of a force."""

    LINK = "link"
    BODY = "body"  # a link, or the frame
    POINT = "point"
    LOAD = "load"  # an external load, by its letter in the file


_ON_BY = (NameRole.BODY, NameRole.BODY)
_LINE = (NameRole.POINT, NameRole.POINT)

FORCES: Mapping[str, tuple[tuple[NameRole, ...], ...]] = {
    "F": (_ON_BY,),
    "Ft": ((*_ON_BY, *_LINE),),
    "Fn": ((*_ON_BY, *_LINE),),
    "M": (_ON_BY,),
    "weight": ((NameRole.LINK,),),
    "inertia": ((NameRole.LINK,),),
    "inertia couple": ((NameRole.LINK,),),
    "shift": ((NameRole.LINK,),),
    "load": ((NameRole.LOAD,),),
    "angle F": (_ON_BY,),
    "angle inertia": ((NameRole.LINK,),),
    "angle load": ((NameRole.LOAD,),),
    "arm F": ((*_ON_BY, NameRole.POINT),),
    "arm weight": ((NameRole.LINK, NameRole.POINT),),
    "arm inertia": ((NameRole.LINK, NameRole.POINT),),
    "arm load": ((NameRole.LOAD, NameRole.POINT),),
    "balance": ((), (NameRole.POINT,)),
    "lever": ((), (NameRole.POINT,)),
}
"""Kinds of quantity of the force analysis, and what the names of each are, in every form it has."""

MACHINE: Mapping[str, int] = {
    "machine M": 1,
    "machine J": 1,
    "machine T": 1,
    "machine energy": 2,
    "machine constant": 0,
    "machine omega": 0,
    "machine delta": 0,
    "machine mu_phi": 0,
    "machine mu_A": 0,
    "machine psi_max": 0,
    "machine psi_min": 0,
    "machine KL": 0,
    "machine AB": 0,
    "machine J_f": 0,
    "machine D": 0,
    "machine m": 0,
    "machine b": 0,
}
"""Kinds of quantity of a machine and its flywheel, and how many names each has: a link, and last
the number of a position of ``[machine]``."""

_PAIRED = frozenset(kind.split()[0] for kind in (*QUANTITIES, *FORCES, *MACHINE) if " " in kind)
"""First words of the kinds that have two; ``inertia`` alone is a kind as well."""

_ABOUT = "about"


class SelectorError(ValueError):
    """A selector cannot be parsed; the message has the reason."""


def parse_selector(text: str) -> Selector:
    """Parse ``what``.

    Examples
    --------
    >>> parse_selector("v C B")
    Selector(kind='v', names=('C', 'B'), over=None)
    >>> parse_selector("arm weight 2 about C")
    Selector(kind='arm weight', names=('2', 'C'), over=None)

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
    second = _parse_one(below)
    if first.kind in MACHINE or second.kind in MACHINE:
        raise SelectorError("quantities of the flywheel cannot be divided")
    return Selector(first.kind, first.names, second)


def _parse_one(text: str) -> Selector:
    words = text.split()
    if not words:
        raise SelectorError('expected a quantity such as "v C", got nothing')
    kind, names = _kind(words)
    if kind in MACHINE:
        counts: tuple[int, ...] = (MACHINE[kind],)
    else:
        counts = QUANTITIES.get(kind) or tuple(len(form) for form in FORCES[kind])
    if kind.startswith("arm "):
        if names[-2:-1] != [_ABOUT]:
            raise SelectorError(translate("'{}' ends with '{}' and a point", kind, _ABOUT))
        del names[-2]
    if len(names) not in counts:
        wanted = translate(" or ").join(map(str, counts))
        told = "'{0}' takes {1} name{2:||s}, got {3}"
        raise SelectorError(translate(told, kind, wanted, 1 if wanted == "1" else 2, len(names)))
    selector = Selector(kind, tuple(names))
    if kind in FORCES:
        indices = (indexed(n) if role is NameRole.LOAD else n for n, role in roles(selector))
        selector = Selector(kind, tuple(indices))
    for pair in _must_differ(selector):
        if len(set(pair)) != len(pair):
            raise SelectorError(translate("'{}' needs two different names", kind))
    return selector


def _kind(words: list[str]) -> tuple[str, list[str]]:
    """Split the words of a quantity into its kind, of one word or two, and its names."""
    first = words[0]
    for size in (2, 1) if first in _PAIRED else (1,):
        kind = " ".join(words[:size])
        if kind in QUANTITIES or kind in FORCES or kind in MACHINE:
            return kind, words[size:]
    known = [*QUANTITIES, *FORCES, *MACHINE]
    unknown = " ".join(words[:2]) if first in _PAIRED else first
    guess = nearest_name(unknown, known)
    tail = translate(" (the nearest is '{}')", guess) if guess else ""
    raise SelectorError(translate("unknown quantity '{}'{}", short(unknown), tail))


def _must_differ(selector: Selector) -> list[tuple[str, ...]]:
    """Return the groups of names that must differ within the group: points, and links."""
    if selector.kind in QUANTITIES:
        return [selector.names]
    if selector.kind in MACHINE:
        return []
    told = roles(selector)
    bodies = tuple(name for name, role in told if role is NameRole.BODY)
    return [bodies, tuple(name for name, role in told if role is NameRole.POINT)]


def roles(selector: Selector) -> list[tuple[str, NameRole]]:
    """Return the names of a force, and their roles."""
    form = next(form for form in FORCES[selector.kind] if len(form) == len(selector.names))
    return list(zip(selector.names, form, strict=True))


def is_force(selector: Selector) -> bool:
    """Return whether a quantity, or its divisor, is of the force analysis."""
    own = selector.kind in FORCES or selector.kind in MACHINE
    return own or (selector.over is not None and is_force(selector.over))


def unknown_names(
    selector: Selector,
    points: Collection[str],
    links: Collection[str],
    loads: Collection[str] = (),
) -> list[str]:
    """Names of a selector that the mechanism does not have.

    Parameters
    ----------
    points : collection of str
        Points, coincident ones such as ``B3`` among them.
    loads : collection of str
        Letters of the external loads.
    """
    if selector.kind in MACHINE:
        found = [name for name in selector.names[:-1] if name not in links]
        found += [name for name in selector.names[-1:] if not name.isdecimal()]
    elif selector.kind in FORCES:
        known = {
            NameRole.LINK: links,
            NameRole.BODY: {*links, FRAME},
            NameRole.POINT: points,
            NameRole.LOAD: loads,
        }
        found = [name for name, role in roles(selector) if name not in known[role]]
    elif selector.kind in LINK_KINDS:
        found = [name for name in selector.names if name not in links]
    else:
        extra = {POLE} if selector.kind.startswith("segment") else set()
        found = [name for name in selector.names if name not in points and name not in extra]
    return found + (unknown_names(selector.over, points, links, loads) if selector.over else [])


def read_published(
    node: FileNode,
    check: Callable[[FileNode, str], str],
    *,
    positions: int = 0,
    example: str = 'value = 3, unit = "м/с", what = "v B"',
    without: Collection[str] = (),
) -> tuple[Published, ...]:
    """Read ``[published."name"]``.

    Parameters
    ----------
    check : callable
        Gets ``what`` (with an empty text where it is absent) and the name, notes faults of the
        quantity, and returns ``what`` as outputs have it.
    positions : int
        How many there are; 0 when not known.
    example, without
        An entry, and the keys that one may not have.
    """

    def read_entry(entry: FileNode) -> Published | None:
        name = str(entry.key)
        table = entry.attempt(lambda entry: entry.table(example))
        entry.check_text(name, _PUBLISHED_NAME_LIMIT)
        needed(table)
        position = partial(read_position, positions=positions)
        given = entry.record(Published, without=without, position=position)
        what = entry["what"].with_value(given.get("what", ""))
        given["what"] = check(what, name)
        return Published(name, **given) if "value" in given else None

    node.table(f'[published."v_B"] {example}')
    node.require_at_most(keys.PUBLISHED_LIMIT, "{} values, the limit is {}")
    return tuple(node.read_each(read_entry).values())


_PUBLISHED_NAME_LIMIT = 80


def read_position(node: FileNode, positions: int) -> int:
    """Read the number of a driver position, from 0; ``positions`` is 0 when not known."""
    if not is_integer(node.value) or node.value < 0:
        node.reject_value("a whole number from 0")
    if positions and node.value >= positions:
        hint = "The first position is 0."
        node.reject("position {} of {}", node.value, positions, hint=hint)
    return node.value


def check_quantity(
    node: FileNode,
    quantity: str,
    points: Collection[str],
    links: Collection[str],
    dynamics: Dynamics | None,
) -> Selector | None:
    """Parse a quantity that a node has, and check its names; None where it cannot be parsed.

    Parameters
    ----------
    points, links : collections of str
        Names of the mechanism, with those of coincident points; empty when it could not be read.
    """
    try:
        selector = parse_selector(quantity)
    except SelectorError as error:
        node.note(str(error), hint='For example: "v C", "an C B", "omega 2", "F 2 1".')
        return None
    if not points or not links:
        return selector
    if is_force(selector) and dynamics is None:
        message = "'{}' is of the force analysis, and the file has no masses and no loads"
        node.note(message, short(quantity), hint="Give [dynamics] or [[loads]].")
        return selector
    loads = [load.name for load in dynamics.loads] if dynamics else []
    for name in unknown_names(selector, points, links, loads):
        known = [translate("Points: {}", listed(points))]
        if is_force(selector):
            known += [translate("links: {}", listed(links))]
            known += [translate("loads: {}", listed(loads))] if loads else []
        hint = nearest_name_hint(name, [*points, *links, *loads], f"{'; '.join(known)}.")
        node.note("the mechanism has no '{}'", name, hint=hint)
    return selector


def read_tables(file: FileNode) -> dict[str, Any]:
    """Take over the tables that later parts read, checking no more than their TOML type."""
    found = {key: file.read(key, FileNode.table) for key in keys.OF_KINDS}
    return {key: table for key, table in found.items() if table is not None}
