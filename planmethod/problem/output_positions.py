"""Positions given by the output: ``x_B``, ``phi_3``, ``phi_2_3``, a stroke fraction, ..."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from functools import partial

from planmethod.languages import translate
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
from planmethod.problem.formula import FormulaError, evaluate_arithmetic, read_decimal
from planmethod.problem.links import LinkText
from planmethod.problem.model import OutputPositionKind, OutputPositions
from planmethod.problem.names import split_pair

_READERS: Mapping[str, Callable[[Faults, str, object], float | None]] = {
    "x": fields.read_coordinate,
    "y": fields.read_coordinate,
    "phi": fields.read_angle,
    "stroke": partial(
        fields.read_number, expected="a share of the stroke", low=0.0, high=1.0, hint=""
    ),
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
    faults: Faults,
    table: Table,
    link: LinkText,
    links: Mapping[str, LinkText],
    fixed: Collection[str],
    *,
    crank: bool,
) -> OutputPositions | None:
    """Read the quantity that gives the positions in place of the driver's coordinate.

    None where there is no such key, or after a fault.
    """
    foreign = "s" if crank else "phi"  # reported as what does not go with the driver
    first, *others = [key for key in table if is_place(key) and key != foreign] or [""]
    for key in others:
        phrase = translate("{} and {} both give the position", first, key)
        faults.add(f"driver.{key}", phrase, "Keep one of them.")
    found = None
    if first and first not in ("phi", "s"):
        kind, _, name = first.partition("_")
        if is_length(first):
            found = _read_actuator(faults, table, first, links, fixed, crank=crank)
        else:
            found = _read(faults, table, kind, name, links, fixed, crank=crank)
        if kind == "phi" and name == link.name:
            hint = translate("Write phi = ..., the angle of link {} itself.", name)
            faults.add(f"driver.{first}", translate("link {} drives", name), hint)
    for key in table:
        if is_rate(key) and key[2:] != first:
            hint = translate("Give the length itself: {} = 0.4.", key[2:])
            faults.add(
                f"driver.{key}",
                translate("is the rate of {}, which gives no position", key[2:]),
                hint,
            )
    counted = first == "at" and (found is None or found.by is not OutputPositionKind.LINE)
    if "root" in table and (first in ("", "phi", "s") or counted):
        faults.add("driver.root", "is valid only with a position given by the output", _ROOT)
    return None if others else found


def _read(
    faults: Faults,
    table: Table,
    kind: str,
    name: str,
    links: Mapping[str, LinkText],
    fixed: Collection[str],
    *,
    crank: bool,
) -> OutputPositions | None:
    path = f"driver.{kind}_{name}" if name else f"driver.{kind}"
    moving = [p for one in links.values() for p in one.points if p not in fixed]
    known: Collection[str] = links if kind == "phi" else dict.fromkeys(moving)
    phrase = "unknown link '{}'" if kind == "phi" else "unknown moving point '{}'"
    pair = name.split("_") if kind == "phi" else [name]
    for one in pair if name else ():
        if one not in known:
            fields.report_unknown(faults, path, one, known, message=phrase)
            return None
    if len(pair) > 2 or len({*pair}) < len(pair):
        faults.add(path, "an angle is between two links", "For example: phi_2_3 = 90")
        return None
    if kind in ("stroke", "at") and not crank:
        faults.add(path, "a driving slider has no turn", "Give x_B, y_B or phi_1 of a link.")
        return None
    value = table[f"{kind}_{name}" if name else kind]
    items = value if isinstance(value, list) else [value]
    if not items or len(items) > keys.POSITION_LIMIT:
        faults.add(
            path,
            translate("expected from 1 to {} positions, got {}", keys.POSITION_LIMIT, len(items)),
        )
        return None
    values: list[float] = []
    extremes: list[str] = []
    by = OutputPositionKind.BETWEEN if len(pair) == 2 else OutputPositionKind(kind)
    if kind == "at" and all(isinstance(item, str) and " on " in item for item in items):
        by = OutputPositionKind.LINE
    for index, item in enumerate(items):
        where = f"{path}[{index}]" if isinstance(value, list) else path
        if by is OutputPositionKind.LINE:
            line = _read_on(faults, where, item, moving, fixed)
            extremes += [line or ""]
            number = 0.0 if line else None
        elif kind == "at":
            told = _read_extreme(faults, where, item)
            number = None if told is None else told[1]
            extremes += [] if told is None else [told[0]]
        else:
            number = _READERS[kind](faults, where, item)
            if (
                by is OutputPositionKind.BETWEEN
                and number is not None
                and not 0.0 <= number <= 180.0
            ):
                faults.expected(where, "an angle of two links from 0 to 180 degrees", item)
        values += [] if number is None else [number]
    kind = by.value if by is OutputPositionKind.BETWEEN or by is OutputPositionKind.LINE else kind
    going, near, chosen = _read_root(faults, kind, table.get("root"), crank=crank)
    if len(values) != len(items):
        return None
    return OutputPositions(by, name, tuple(values), tuple(extremes), going, near, number=chosen)


def _read_on(
    faults: Faults, path: str, value: object, moving: Collection[str], fixed: Collection[str]
) -> str | None:
    """Read ``B on OC``: a moving point, and the line of two others that it is on."""
    match = re.match(_ON, " ".join(value.split())) if isinstance(value, str) else None
    if match is None:
        faults.expected(path, "a point on a line", value, 'For example: at = "B on OC"')
        return None
    points = dict.fromkeys([*fixed, *moving])
    name = fields.read_known_point(faults, path, match[1], points, of="the mechanism")
    line = fields.read_line_name(faults, path, match[2], points, of="the mechanism")
    if name is None or line is None:
        return None
    if name in line:
        faults.add(path, translate("the line {} goes through {} itself", match[2], name))
        return None
    if {name, *line} <= {*fixed}:
        faults.add(path, translate("point {} is fixed", name), "Name a point that moves.")
        return None
    return f"{name} on {''.join(line)}"


def _read_actuator(
    faults: Faults,
    table: Table,
    pair: str,
    links: Mapping[str, LinkText],
    fixed: Collection[str],
    *,
    crank: bool,
) -> OutputPositions | None:
    """Read an actuator (гидроцилиндр): the distance of two points, and its rate."""
    before = len(faults)
    known = dict.fromkeys([*fixed, *(p for one in links.values() for p in one.points)])
    ends = fields.read_line_name(faults, f"driver.{pair}", pair, known, of="the mechanism")
    if isinstance(table[pair], list):
        hint = "Its rate makes another speed in each: write the others as variants."
        faults.add(f"driver.{pair}", "an actuator has one position", hint)
        return None
    length = fields.read_length(faults, f"driver.{pair}", table[pair])
    rates = [
        fields.read_number(faults, f"driver.{key}", table.get(key, 0.0), what)
        for key, what in (
            (f"v_{pair}", "a velocity in m/s"),
            (f"a_{pair}", "an acceleration in m/s²"),
        )
    ]
    if f"v_{pair}" not in table:
        faults.add(f"driver.v_{pair}", "missing", translate("How fast {} grows, m/s.", pair))
    _, near, number = _read_root(faults, "length", table.get("root"), crank=crank)
    if ends is None or length is None or len(faults) != before:
        return None
    speed, gain = (rate or 0.0 for rate in rates)
    return OutputPositions(
        OutputPositionKind.LENGTH, pair, (length,), (), "", near, (speed, gain), number
    )


def _read_extreme(faults: Faults, path: str, value: object) -> tuple[str, float] | None:
    """Read ``extreme left + 30``: the extreme, and the angle after it, degrees."""
    match = re.match(_AT, " ".join(value.split())) if isinstance(value, str) else None
    if match is None or (match[1] and match[2]):
        faults.expected(path, "an extreme position", value, translate("Known: {}.", _EXAMPLES))
        return None
    after = 0.0
    if match[3]:
        try:
            after = evaluate_arithmetic(match[3].rstrip(" °"))
        except FormulaError as error:
            faults.add(
                path, translate("expected degrees after the extreme, got {!r}: {}", match[3], error)
            )
            return None
    degrees = fields.read_angle(faults, path, after)
    return None if degrees is None else (match[1] or match[2] or "", degrees)


def _read_root(
    faults: Faults, kind: str, value: object, *, crank: bool
) -> tuple[str, float | None, int]:
    """Read the choice among several positions: ``going right``, ``near 40``, or its number."""
    if value is None or kind == "at":
        return "", None, 0
    if isinstance(value, int) and not isinstance(value, bool) and value > 0:
        return "", None, value
    words = value.split() if isinstance(value, str) else []
    ways = keys.GOING.get(kind, ())
    if len(words) == 2 and words[0] == "going" and words[1] in ways:
        return words[1], None, 0
    if len(words) == 2 and words[0] == "near":
        read = fields.read_angle if crank else fields.read_coordinate
        number = read_decimal(words[1])
        if number is not None:
            return "", read(faults, "driver.root", float(number)), 0
    example = translate('"near {}" or a number from 1', 40 if crank else 0.1)
    if ways:
        example = translate('"going {}", "going {}", {}', *ways, example)
    faults.expected("driver.root", example, value)
    return "", None, 0
