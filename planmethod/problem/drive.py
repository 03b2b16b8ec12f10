"""Driver, assembly rules and scales of a problem file."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from functools import partial

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import keys
from planmethod.problem.file_node import FileNode, is_integer, is_number, needed
from planmethod.problem.links import LinkText
from planmethod.problem.model import (
    ANYWHERE,
    AssemblyRelation,
    CamDrive,
    Convention,
    Drive,
    GearDrive,
    Rule,
    Scales,
)
from planmethod.problem.names import is_point_name, listed, nearest_name, split_pair
from planmethod.problem.output_positions import is_length, is_place, is_posed, is_rate, read_posed

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
    node.allow((*keys.DRIVER, *filter(is_posed, node.value)))
    name = node.require(
        "link", lambda link: link.known_name("the name of a link", links, "unknown link '{}'"),
        lambda: translate("Name the driving link: {}.", listed(links)),
    )  # fmt: skip
    link = links[needed(name)]
    pivots = [point for point in link.points if point in fixed]
    if not pivots and hosts.get(link.name) != FRAME:
        if link.sound:
            hint = "A driver turns about a fixed point ({}) or slides on a guide of the frame."
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
    )


def _note_foreign_keys(node: FileNode, link: LinkText, *, crank: bool) -> None:
    """Note the keys of a slider that a crank has, and those of a crank that a slider has."""
    own, other = (keys.CRANK, keys.SLIDER) if crank else (keys.SLIDER, keys.CRANK)
    kind = "a crank" if crank else "a driving slider"
    for key in node.value:
        if key in other and key not in own:
            hint = translate("Link {} is {}: {}.", link.name, kind, listed(own))
            node[key].note("does not go with {}", kind, hint=hint)


def _note_missing_keys(node: FileNode, *, crank: bool, counted: bool) -> None:
    """Note a missing position or rate, and rates that a cam or an actuator replaces."""
    lifted = "cam" in node
    acted = lifted or any(is_rate(key) or is_length(key) for key in node.value)
    for key in node.value:
        if acted and key in ("omega", "n", "train", "epsilon", "v", "a"):
            node[key].note(_WITH_CAM if lifted else _ACTED)
    place = "phi" if crank else "s"
    if not counted and not any(map(is_place, node.value)):
        node.note_missing(place, _EXAMPLES[place])
    rates = ("omega", "n", "train") if crank else ("v",)
    if not acted and not any(rate in node for rate in rates):
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


_ACTED = "does not go with an actuator, whose rate drives"
_WITH_CAM = "does not go with a cam, whose follower drives"


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
        hint = translate("Put first the length that starts at the pivot {}.", pivot)
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
    elif not drive.is_crank:
        node.note("link {} slides and has no turn", drive.link, hint=slides)
    elif drive.is_at_rest:
        node.note("the crank stands", hint=hint_at_rest)


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
            rule.reject("point {} is fixed", point, hint="Rules are for points that move.")
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
        node.reject("'{}' does not go with the line {}", side, name, hint=hint)
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
            node[first[0]].reject("a parallelogram has one closing", hint="Delete this key.")
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
