"""Positions given by the output: ``x_B``, ``phi_3``, ``phi_2_3``, a stroke fraction, ..."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from functools import partial

from msgspec import Struct
from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.problem import keys
from planmethod.problem.file_node import FileNode, is_integer, needed
from planmethod.problem.formula import FormulaError, evaluate_arithmetic, read_decimal
from planmethod.problem.links import LinkText
from planmethod.problem.model import OutputPositionKind, OutputPositions
from planmethod.problem.names import split_pair

_READERS: Mapping[str, Callable[[FileNode], float]] = {
    "x": FileNode.coordinate,
    "y": FileNode.coordinate,
    "phi": FileNode.angle,
    "stroke": lambda node: node.number("a share of the stroke", 0.0, 1.0, hint=""),
}
_SIDE = "|".join(keys.EXTREMES)
_ON = r"(\S+) on (\S+)\Z"
_AT = rf"(?:(other|{_SIDE}) )?extreme(?: ({_SIDE}))?(?: ?([-+−].*))?\Z"
_ROOT = 'For example: x_B = 0.12, root = "going right".'
_EXAMPLES = '"extreme", "other extreme", "left extreme", "extreme left + 30", "B on OC"'


def is_posed(key: str) -> bool:
    """Return whether a driver key gives a position by a point or a link: ``x_B``, ``phi_3``."""
    kind, line, name = key.partition("_")
    if not line:
        return is_length(key)
    return bool(name) and (kind in keys.POSED or is_rate(key))


def is_length(key: str) -> bool:
    """Return whether a key of the driver is the length of an actuator: ``DE``."""
    return key[:1].isupper() and split_pair(key) is not None


def is_rate(key: str) -> bool:
    """Return whether a key of the driver is a rate of an actuator: ``v_DE``, ``a_DE``."""
    return key[:2] in ("v_", "a_") and split_pair(key[2:]) is not None


def is_place(key: str) -> bool:
    """Return whether a driver key gives its position: such a key replaces the others."""
    return key in keys.PLACES or (is_posed(key) and not is_rate(key))


def read_posed(
    node: FileNode,
    link: LinkText,
    links: Mapping[str, LinkText],
    fixed: Collection[str],
    *,
    crank: bool,
) -> OutputPositions | None:
    """Read the quantity that gives the positions in place of the driver's coordinate.

    None where there is no such key, or after a fault.

    Parameters
    ----------
    node : FileNode
        ``[driver]``.
    """
    foreign = "s" if crank else "phi"  # reported as what does not go with the driver
    first, *others = [key for key in node.value if is_place(key) and key != foreign] or [""]
    for key in others:
        node[key].note("{} and {} both give the position", first, key, hint="Keep one of them.")
    found: OutputPositions | None = None
    root: tuple[str, float | None, int] = ("", None, 0)
    if first and first not in ("phi", "s"):
        kind, _, name = first.partition("_")
        points = [point for one in links.values() for point in one.points]
        if is_length(first):
            found = _read_actuator(node, first, [*fixed, *points], crank=crank)
        else:
            moving = [point for point in points if point not in fixed]
            names = _Names(links, dict.fromkeys(moving), fixed)
            read = partial(_read, kind=kind, name=name, names=names, crank=crank)
            found = node.read(first, read)
        way = found.by.value if found else "length" if is_length(first) else kind
        root = node.read("root", partial(_read_root, kind=way, crank=crank), root) or root
        if kind == "phi" and name == link.name:
            hint = translate("Write phi = ..., the angle of link {} itself.", name)
            node[first].note("link {} drives", name, hint=hint)
    for key in node.value:
        if is_rate(key) and key[2:] != first:
            hint = translate("Give the length itself: {} = 0.4.", key[2:])
            node[key].note("is the rate of {}, which gives no position", key[2:], hint=hint)
    counted = first == "at" and (found is None or found.by is not OutputPositionKind.LINE)
    if "root" in node and (first in ("", "phi", "s") or counted):
        node["root"].note("is valid only with a position given by the output", hint=_ROOT)
    if found is None or others:
        return None
    going, near, number = root
    return replace(found, going=going, nearest_to=near, number=number)


class _Names(Struct, frozen=True):
    """Names of links, moving points and points of the frame."""

    links: Collection[str]
    moving: Collection[str]
    fixed: Collection[str]


def _read(node: FileNode, kind: str, name: str, names: _Names, *, crank: bool) -> OutputPositions:
    known = names.links if kind == "phi" else names.moving
    phrase = "unknown link '{}'" if kind == "phi" else "unknown moving point '{}'"
    pair = name.split("_") if kind == "phi" else [name]
    for one in pair if name else ():
        if one not in known:
            node.reject_unknown(one, known, phrase)
    if len(pair) > 2 or len({*pair}) < len(pair):
        node.reject("an angle is between two links", hint="For example: phi_2_3 = 90")
    if kind in ("stroke", "at") and not crank:
        hint = "Give x_B, y_B or phi_1 of a link."
        node.reject("a driving slider has no turn", hint=hint)
    values = node.value if isinstance(node.value, list) else [node.value]
    if not 1 <= len(values) <= keys.POSITION_LIMIT:
        message = "expected from 1 to {} positions, got {}"
        node.reject(message, keys.POSITION_LIMIT, len(values))
    if kind != "at":
        by = OutputPositionKind.BETWEEN if len(pair) == 2 else OutputPositionKind(kind)
        read = _read_between if len(pair) == 2 else _READERS[kind]
        return OutputPositions(by, name, node.read_one_or_all(read))
    if all(isinstance(value, str) and " on " in value for value in values):
        lines = node.read_one_or_all(partial(_read_on, names=names))
        return OutputPositions(OutputPositionKind.LINE, name, (0.0,) * len(lines), lines)
    extremes, degrees = zip(*node.read_one_or_all(_read_extreme), strict=True)
    return OutputPositions(OutputPositionKind(kind), name, degrees, extremes)


def _read_between(node: FileNode) -> float:
    degrees = node.angle()
    if not 0.0 <= degrees <= 180.0:
        node.reject_value("an angle of two links from 0 to 180 degrees")
    return degrees


def _read_on(node: FileNode, names: _Names) -> str:
    """Read ``B on OC``: a moving point, and the line of two others that it is on."""
    match = re.match(_ON, " ".join(node.value.split()))
    if match is None:
        node.reject_value("a point on a line", 'For example: at = "B on OC"')
    points = dict.fromkeys([*names.fixed, *names.moving])
    name = node.check_point_name(match[1])
    node.check_owned(name, "the mechanism", points, near=True)
    line = node.split_line(match[2], "the mechanism", points)
    if name in line:
        node.reject("the line {} goes through {} itself", match[2], name)
    if {name, *line} <= {*names.fixed}:
        node.reject("point {} is fixed", name, hint="Name a point that moves.")
    return f"{name} on {''.join(line)}"


def _read_actuator(
    node: FileNode, pair: str, points: Collection[str], *, crank: bool
) -> OutputPositions | None:
    """Read an actuator (гидроцилиндр): the distance of two points, and its rate."""

    def read_length(length: FileNode) -> float:
        known = dict.fromkeys(points)
        ends = length.attempt(lambda key: key.split_line(pair, "the mechanism", known))
        if isinstance(length.value, list):
            hint = "Its rate makes another speed in each: write the others as variants."
            length.reject("an actuator has one position", hint=hint)
        metres = length.length()
        needed(ends)
        return metres

    length = node.read(pair, read_length)
    speed = node.require(
        f"v_{pair}", lambda rate: rate.number("a velocity in m/s"),
        translate("How fast {} grows, m/s.", pair),
    )  # fmt: skip
    gain = node.read(f"a_{pair}", lambda rate: rate.number("an acceleration in m/s²"), 0.0)
    if length is None or speed is None or gain is None:
        return None
    return OutputPositions(OutputPositionKind.LENGTH, pair, (length,), rates=(speed, gain))


def _read_extreme(node: FileNode) -> tuple[str, float]:
    """Read ``extreme left + 30``: the extreme, and the angle after it, degrees."""
    value = node.value
    match = re.match(_AT, " ".join(value.split())) if isinstance(value, str) else None
    if match is None or (match[1] and match[2]):
        node.reject_value("an extreme position", translate("Known: {}.", _EXAMPLES))
    after = 0.0
    if match[3]:
        try:
            after = evaluate_arithmetic(match[3].rstrip(" °"))
        except FormulaError as error:
            node.reject("expected degrees after the extreme, got {!r}: {}", match[3], error)
    return match[1] or match[2] or "", node.with_value(after).angle()


def _read_root(node: FileNode, kind: str, *, crank: bool) -> tuple[str, float | None, int]:
    """Read the choice among several positions: ``going right``, ``near 40``, or its number."""
    if kind == "at":
        return "", None, 0
    if is_integer(node.value) and node.value > 0:
        return "", None, node.value
    words = node.value.split() if isinstance(node.value, str) else []
    ways = keys.GOING.get(kind, ())
    if len(words) == 2 and words[0] == "going" and words[1] in ways:
        return words[1], None, 0
    if len(words) == 2 and words[0] == "near":
        number = read_decimal(words[1])
        if number is not None:
            place = node.with_value(float(number))
            return "", place.angle() if crank else place.coordinate(), 0
    example = translate('"near {}" or a number from 1', 40 if crank else 0.1)
    if ways:
        example = translate('"going {}", "going {}", {}', *ways, example)
    return node.reject_value(example)
