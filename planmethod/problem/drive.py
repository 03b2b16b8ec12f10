"""Driver, assembly rules and scales of a problem file; positions given by the output."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping
from functools import partial

from msgspec import Struct
from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import keys
from planmethod.problem.faults import is_integer, is_number
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.formula import FormulaError, evaluate_arithmetic, read_decimal
from planmethod.problem.links import LinkText
from planmethod.problem.model import (
    ANYWHERE,
    MOTOR_DRIVES,
    AssemblyRelation,
    CamDrive,
    Convention,
    Drive,
    GearDrive,
    OutputPositionKind,
    OutputPositions,
    OutputRate,
    Rule,
    Scales,
)
from planmethod.problem.names import is_point_name, listed, nearest_name, split_pair
from planmethod.problem.output_rates import (
    effort_key,
    has_motor,
    is_output_rate,
    read_effort,
    read_output_rate,
)

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
_OUTPUT_EXAMPLES = '"extreme", "other extreme", "left extreme", "extreme left + 30", "B on OC"'


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
        node.reject("an angle must be between two links", hint="For example: phi_2_3 = 90")
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
            hint = (
                "Its rate gives a different speed in each position: write the others as variants."
            )
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
        node.reject_value("an extreme position", translate("Known: {}.", _OUTPUT_EXAMPLES))
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


Span = tuple[float, ...]


def read_drive(
    node: FileNode,
    links: Mapping[str, LinkText],
    fixed: Collection[str],
    hosts: Mapping[str, str],
    leading: GearDrive | CamDrive | None = None,
    numbered: int = 0,
) -> Drive | None:
    """Read ``[driver]``; ``hosts`` maps each slider to its host, ``leading`` its train or cam.

    ``numbered`` is the number of positions of ``[cycle]``: of a crank they override several that
    the driver lists, and replace missing ones.
    """
    node.table('[driver] link = "1", phi = 20, omega = 50')
    node.allow((*keys.DRIVER, *filter(is_posed, node.value), *filter(is_output_rate, node.value)))
    name: str | None = None
    if "link" not in node and has_motor(node):
        # Any link on the frame may be the first of the kinematics: the motor drives.
        name = next((one.name for one in links.values() if {*one.points} & {*fixed}), None)
    name = name or node.require(
        "link", lambda link: link.known_name("the name of a link", links, "unknown link '{}'"),
        lambda: translate("Name the driving link: {}.", listed(links)),
    )  # fmt: skip
    link = links[needed(name)]
    pivots = [point for point in link.points if point in fixed]
    if not pivots and hosts.get(link.name) != FRAME:
        if link.sound:
            hint = (
                "The driving link must turn about a fixed point ({}) or slide on a "
                "guide of the frame."
            )
            message = "link {} is not joined to the frame"
            node["link"].note(message, link.name, hint=translate(hint, listed(fixed)))
        return None
    if pivots and hosts.get(link.name) == FRAME:
        return None  # reported with the joints: pivoted to the frame and sliding on it at once
    is_crank = bool(pivots)
    _note_foreign_keys(node, link, crank=is_crank)
    posed = read_posed(node, link, links, fixed, crank=is_crank)
    counted = bool(numbered and is_crank)
    _note_missing_keys(node, crank=is_crank, counted=counted)
    geared, led = (None, None) if leading is None else _split(leading)
    lifted = "cam" in node
    if lifted:
        _check_follower(node, led, crank=is_crank)
    if is_crank:
        _check_crank_axis(link, pivots[0])
        positions = node.read("phi", partial(_read_positions, one=FileNode.angle))
        rate = _read_turning(node, geared)
        acceleration = _read_rate(node, "epsilon", "an angular acceleration in 1/s²")
    else:
        positions = node.read("s", partial(_read_positions, one=FileNode.coordinate))
        rate = _read_rate(node, "v", "a velocity in m/s")
        acceleration = _read_rate(node, "a", "an acceleration in m/s²")
    output_rate = read_output_rate(node, link, links, fixed, hosts)
    effort = _read_effort(node, output_rate, crank=is_crank)
    if output_rate is not None and output_rate.gain is None and has_motor(node):
        still = "epsilon" not in node and "a" not in node and effort is None
        output_rate = replace(output_rate, gain=0.0 if still else None)
    if output_rate is not None:
        rate = output_rate.rate  # until the mechanism is assembled
    if lifted:
        lowest = positions
        positions = node.read("cam", partial(_read_positions, one=FileNode.angle))
        if led is not None and lowest is not None:
            led = replace(led, lowest=lowest[0])
            rate = abs(led.n) * math.pi / 30.0
    if posed is not None:
        positions = (math.nan,) * len(posed.values)  # found when the mechanism is assembled
    judged: Span = ()
    if counted and posed is None and (positions is None or len(positions) > 1):
        judged = positions or ANYWHERE
        positions = (math.nan,) * numbered if positions or "phi" not in node else None
    node.require_sound()
    if positions is None or rate is None or acceleration is None:
        return None  # the train, the cam or the crank's own axis has a fault
    return Drive(
        link.name,
        pivots[0] if is_crank else None,
        positions,
        rate,
        acceleration,
        geared if is_crank else None,
        rate * 30.0 / math.pi if "n" in node else None,
        posed,
        judged,
        cam_drive=led,
        output_rate=output_rate,
        effort=effort,
    )


def _read_effort(node: FileNode, output_rate: OutputRate | None, *, crank: bool) -> float | None:
    """Read what drives; its accelerations follow from it."""
    rates = ["epsilon" if crank else "a", *(key for key in node.value if key.startswith("a_"))]
    rates += [output_rate.gain_key] if output_rate is not None else []
    return read_effort(node, crank=crank, rates=dict.fromkeys(rates))


def _note_foreign_keys(node: FileNode, link: LinkText, *, crank: bool) -> None:
    """Note the keys of a slider that a crank has, and those of a crank that a slider has."""
    own, other = (keys.CRANK, keys.SLIDER) if crank else (keys.SLIDER, keys.CRANK)
    kind = "a crank" if crank else "a driving slider"
    for key in node.value:
        if key in other and key not in own:
            hint = translate("Link {} is {}: {}.", link.name, kind, listed(own))
            node[key].note("not valid with {}", kind, hint=hint)


def _note_missing_keys(node: FileNode, *, crank: bool, counted: bool) -> None:
    """Note a missing position or rate, and rates that a cam or an actuator replaces."""
    lifted = "cam" in node
    acted = lifted or any(is_rate(key) or is_length(key) for key in node.value)
    for key in node.value:
        replaced = key in ("omega", "n", "train", "epsilon", "v", "a") or is_output_rate(key)
        if acted and replaced:
            node[key].note(_WITH_CAM if lifted else _ACTED)
    place = "phi" if crank else "s"
    if not counted and not any(map(is_place, node.value)):
        node.note_missing(place, _EXAMPLES[place])
    rates = ("omega", "n", "train") if crank else ("v",)
    is_given = effort_key(node, crank=crank) in node or any(map(is_output_rate, node.value))
    if not acted and not is_given and not any(rate in node for rate in rates):
        node.note_missing(rates[0], _EXAMPLES[rates[0]])


def _split(leading: GearDrive | CamDrive) -> tuple[GearDrive | None, CamDrive | None]:
    """Return the train, or the cam."""
    return (leading, None) if isinstance(leading, GearDrive) else (None, leading)


def _check_follower(node: FileNode, led: CamDrive | None, *, crank: bool) -> None:
    """Note why a cam's follower cannot drive: its kind, or several positions."""
    if led is not None and led.turns is not crank:
        what = "a translating follower moves a slider, an oscillating one a crank"
        node["cam"].note(what, hint="Change follower of [cam], or the driving link.")
    place = node["phi" if crank else "s"]
    if isinstance(place.value, list | Mapping):
        what = "one place is expected: that of the link while the follower is lowest"
        place.note(what, hint="Give the angles of the cam: cam = [0, 30, 60].")
    for other in ("stroke", "at", "root", *filter(is_posed, node.value)):
        if other in node:
            node[other].note(_WITH_CAM)


_ACTED = "not valid with an actuator, because its rate drives"
_WITH_CAM = "not valid with a cam, because its follower drives"


def _check_crank_axis(link: LinkText, pivot: str) -> None:
    """Reject a crank whose own axis, which phi turns, does not start at the pivot."""
    if not link.lengths or link.slides is not None:
        return
    first = link.lengths[0]
    if first.a == pivot:
        return
    if first.b == pivot:
        hint = translate(
            "Write {}{} instead of {}: from the pivot outwards.", pivot, first.a, first.key
        )
    else:
        hint = translate("Write the length that starts at the pivot {} first.", pivot)
    message = "the own axis of the crank starts at {}, phi is measured at the pivot {}"
    link.node[first.key].note(message, first.a, pivot, hint=hint)


def _read_positions(node: FileNode, one: Callable[[FileNode], float]) -> Span:
    """Read positions: a number, a list, or a row; ``one`` reads one of them."""
    if isinstance(node.value, list):
        if not node.value:
            node.reject("expected at least one position, got an empty list")
        require_positions(node, len(node.value))
        return node.read_all(one)
    if isinstance(node.value, Mapping):
        return _read_span(node, one)
    if not is_number(node.value) and not isinstance(node.value, str):
        node.reject_value("a number, a list, or { from, to, step } or { from, count }")
    return (one(node),)


def require_positions(node: FileNode, count: int) -> None:
    """Make sure that there are no more positions than a file may have."""
    if count > keys.POSITION_LIMIT:
        shown = f"{count}" if count < 10**9 else "over a billion"
        node.reject("{} positions, the limit is {}", shown, keys.POSITION_LIMIT)


def _read_span(node: FileNode, one: Callable[[FileNode], float]) -> Span:
    """Read a row of positions: ``{ from, count }`` is a full turn."""
    node.allow(keys.SPAN)
    node.require_sound()
    names, turns = set(node.value), one is FileNode.angle
    full_turn = names == {"from", "count"} and turns
    if not full_turn and names not in ({"from", "to", "count"}, {"from", "to", "step"}):
        ways = "{ from, to, step } or { from, to, count }"
        if turns:
            ways = translate("{{ from, count }} (a full turn), {}", ways)
        node.reject("expected {}, got {{ {} }}", ways, listed(node.value))
    return read_row(node, one, full_turn=full_turn)


def _read_step(node: FileNode) -> float:
    return node.number("a step", -1e6, 1e6)


def read_row(
    node: FileNode,
    one: Callable[[FileNode], float],
    step_of: Callable[[FileNode], float] = _read_step,
    *,
    full_turn: bool = False,
) -> Span:
    """Read the row from one place to another, by its ``count`` or ``step``.

    ``one`` reads a place, ``step_of`` a step.
    """
    start, end = node.read("from", one), node.read("to", one, 0.0)
    if "count" in node:
        count = needed(node.read("count", partial(_read_count, least=1 if full_turn else 2)))
        start, end = needed(start), needed(end)
        if full_turn:
            return tuple(start + 360.0 * k / count for k in range(count))
        return tuple(start + (end - start) * k / (count - 1) for k in range(count))
    step = node.read("step", step_of)
    start, end, step = needed(start), needed(end), needed(step)
    if step == 0 or (end - start) / step < 0:
        node["step"].reject("the step {:g} does not lead from {:g} to {:g}", step, start, end)
    # a step of 0.1 must reach its end in spite of rounding
    last = math.floor((end - start) / step + 1e-9) if (end - start) / step < 1e9 else 10**9
    require_positions(node, last + 1)
    return tuple(start + step * k for k in range(last + 1))


def _read_count(node: FileNode, least: int) -> int:
    if not is_integer(node.value) or node.value < least:
        node.reject_value(translate("a whole number from {}", least))
    require_positions(node, node.value)
    return node.value


def _read_rate(node: FileNode, key: str, expected: str) -> float | None:
    """Read a rate; zero when it is not given."""
    return node.read(key, lambda rate: rate.number(expected), 0.0)


def _read_turning(node: FileNode, geared: GearDrive | None) -> float | None:
    """Angular velocity, 1/s, from omega, n or the train."""
    if "cam" in node or any(map(is_length, node.value)):
        return 0.0  # found with the position, or by the cam
    one, *others = [key for key in ("omega", "n", "train") if key in node] or ["omega"]
    for other in others:
        node[other].note("{} and {} are both given", one, other, hint="Keep one of them.")
    if others:
        return None
    if "train" in node:
        return None if geared is None else geared.rate
    if "n" in node:
        turns = _read_rate(node, "n", "a rotational speed in rev/min")
        return None if turns is None else turns * math.pi / 30.0
    return _read_rate(node, "omega", "an angular velocity in 1/s")


def require_turning(node: FileNode, drive: Drive | None, slides: str, hint_at_rest: str) -> None:
    """Note that a table needs a rotating crank, with a hint for the actual driver."""
    if drive is None:
        return
    if drive.cam_drive is not None:
        what = "a cam's follower moves link {}, which does not turn all round"
        node.note(what, drive.link, hint=slides)
    elif drive.actuator is not None:
        what = "the actuator {} moves link {}, which does not turn all round"
        node.note(what, "".join(drive.actuator), drive.link, hint=slides)
    elif drive.motor is not None:
        node.note(MOTOR_DRIVES, *drive.motor, drive.link, hint=slides)
    elif not drive.is_crank:
        node.note("link {} slides and has no turn", drive.link, hint=slides)
    elif drive.is_at_rest:
        node.note("the crank does not move", hint=hint_at_rest)


_EXAMPLES = {
    "phi": "For example: phi = 30",
    "s": "For example: s = 0.05",
    "omega": "Give omega in 1/s, or n in rev/min.",
    "v": "Give it in m/s.",
}

_POINT_WORDS = {
    "right": AssemblyRelation.RIGHT,
    "left": AssemblyRelation.LEFT,
    "above": AssemblyRelation.ABOVE,
    "below": AssemblyRelation.BELOW,
    "towards": AssemblyRelation.TOWARDS,
    "away": AssemblyRelation.AWAY,
}
_LINE_WORDS = {"left": AssemblyRelation.LEFT_OF, "right": AssemblyRelation.RIGHT_OF}


def read_assembly(
    node: FileNode, moving: Collection[str], fixed: Collection[str]
) -> tuple[Rule, ...]:
    """Read ``[assembly]``: one rule for each point.

    Parameters
    ----------
    moving, fixed : collection of str
        Points of the moving links and of the frame.
    """
    node.table('E = "right of D"')
    known = list(dict.fromkeys([*moving, *fixed]))

    def read_rule(rule: FileNode) -> Rule:
        point = rule.unmask(str(rule.key))
        if point in fixed:
            rule.reject("point {} is fixed", point, hint="Rules apply to points that move.")
        if point not in moving:
            rule.reject_unknown(point, moving, "unknown point '{}'")
        return _read_rule(rule, point, known)

    return tuple(node.read_each(read_rule).values())


_RULE = '"right of D", "left of CB", "above D" or { near = [x, y] }'


def _read_rule(node: FileNode, point: str, known: list[str]) -> Rule:
    if isinstance(node.value, Mapping):
        return _read_rule_table(node, point, known)
    if not isinstance(node.value, str) or len(node.value) > 80:
        node.reject_value(_RULE)
    words = [node.unmask(word) for word in node.value.split()]
    if len(words) == 3 and words[1] == ("from" if words[0] == "away" else "of"):
        del words[1]
    if len(words) != 2 or words[0] not in _POINT_WORDS:
        guess = nearest_name(words[0], _POINT_WORDS) if words else None
        meant = {"right": "right of", "left": "left of", "away": "away from"}.get(
            guess or "", guess
        )
        hint = translate('Write "{} {}".', meant, words[-1]) if guess and guess != words[0] else ""
        node.reject_value(_RULE, hint)
    side, name = words
    if is_point_name(name):
        node.check_owned(name, "the mechanism", known, near=True)
        if name == point:
            node.reject("{} cannot be compared with itself", point)
        return Rule(point, _POINT_WORDS[side], (name,))
    if split_pair(name) is None:
        node.reject_value(_RULE)
    line = node.split_line(name, "the mechanism", known)
    if side not in _LINE_WORDS:
        hint = translate("A point is above or below one point: {} {}.", side, line[1])
        node.reject("'{}' is not valid for the line {}", side, name, hint=hint)
    if point in line:
        node.reject("the line {} goes through {} itself", name, point)
    return Rule(point, _LINE_WORDS[side], line)


def _read_rule_table(node: FileNode, point: str, known: list[str]) -> Rule:
    node.allow(keys.RULE)
    keep = node["keep"].value
    if "keep" in node and keep not in keys.ASSEMBLY_FLAGS:
        wanted = translate(" or ").join(f'"{word}"' for word in keys.ASSEMBLY_FLAGS)
        node["keep"].reject_value(wanted)
    first = [key for key in ("near", "rule") if key in node]
    if keep == "parallel":
        if first:
            node[first[0]].reject("a parallelogram has one assembly", hint="Delete this key.")
        return Rule(point, AssemblyRelation.PARALLEL)
    if len(first) != 1:
        hint = translate("For example: {} = {{ near = [0.1, 0.2] }}", point)
        node["near"].reject("give near or rule, not both" if first else "missing", hint=hint)
    if "rule" in node:
        phrase = node["rule"]
        if isinstance(phrase.value, Mapping):
            phrase.reject_value("a phrase")
        found = _read_rule(phrase, point, known)
    else:
        found = Rule(point, AssemblyRelation.NEAR, at=node["near"].place())
    return replace(found, continuous=keep is not None)


def read_scales(node: FileNode) -> Scales:
    """Read ``[scales]``; the result is unit per millimetre whichever convention the file has."""
    node.table("mu_l = 0.002")
    found = node.record(Scales)
    if found.get("convention") is Convention.MM_PER_UNIT:
        found |= {key: 1.0 / found[key] for key in found if key.startswith("mu_")}
    return Scales(**found)
