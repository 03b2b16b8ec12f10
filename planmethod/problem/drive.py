"""Driver, assembly rules and scales of a problem file."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
from planmethod.problem.flat_tables import read_flat
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
from planmethod.problem.names import is_point_name, listed, nearest_name, segment, split_pair
from planmethod.problem.output_positions import is_length, is_place, is_posed, is_rate, read_posed

Span = tuple[float, ...]
ANGLES = ("phi", "cam")
"""Keys whose places are angles: a row of them may be a full turn."""


def read_drive(
    faults: Faults,
    table: object,
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
    before = len(faults)
    given = fields.read_table(faults, "driver", table, '[driver] link = "1", phi = 20, omega = 50')
    if given is None:
        return None
    posing = [key for key in given if is_posed(key)]
    given = fields.read_keys(faults, "driver", given, (*keys.DRIVER, *posing))
    # a misspelt key is reported once: the key it should have been is not called missing as well
    whole = len(faults) == before
    link = _read_link(faults, given, links)
    if link is None:
        return None
    pivots = [point for point in link.points if point in fixed]
    if not pivots and hosts.get(link.name) != FRAME:
        if link.sound:
            faults.add(
                "driver.link",
                translate("link {} is not joined to the frame", link.name),
                translate(
                    "A driver turns about a fixed point ({}) or slides on a guide of the frame.",
                    listed(fixed),
                ),
            )
        return None
    if pivots and hosts.get(link.name) == FRAME:
        return None  # reported with the joints: pivoted to the frame and sliding on it at once
    own, other = (keys.CRANK, keys.SLIDER) if pivots else (keys.SLIDER, keys.CRANK)
    kind = "a crank" if pivots else "a driving slider"
    for key in given:
        if key in other and key not in own:
            hint = translate("Link {} is {}: {}.", link.name, kind, listed(own))
            faults.add(f"driver.{key}", translate("does not go with {}", kind), hint)
    posed = read_posed(faults, given, link, links, fixed, crank=bool(pivots))
    counted = bool(numbered and pivots)
    required: tuple[str, ...] = () if any(map(is_place, given)) else ("phi" if pivots else "s",)
    if counted:
        required = ()
    lifted = "cam" in given
    acted = lifted or any(is_rate(key) or is_length(key) for key in given)
    if not pivots and not acted:
        required += ("v",)
    if pivots and not acted and not {"n", "train"} & {*given}:
        required += ("omega",)
    for key in given:
        if acted and key in ("omega", "n", "train", "epsilon", "v", "a"):
            faults.add(f"driver.{key}", _WITH_CAM if lifted else _ACTED)
    for key in required:
        if key not in given and whole:
            faults.add(f"driver.{key}", "missing", _EXAMPLES[key])
    geared, led = (None, None) if leading is None else _split(leading)
    if lifted:
        _check_follower(faults, given, led, crank=bool(pivots))
    if pivots:
        _check_crank_axis(faults, link, pivots[0])
        positions = _read_positions(faults, given, "phi")
        rate = _read_turning(faults, given, geared)
        acceleration = _read_rate(faults, given, "epsilon", "an angular acceleration in 1/s²")
    else:
        positions = _read_positions(faults, given, "s")
        rate = _read_rate(faults, given, "v", "a velocity in m/s")
        acceleration = _read_rate(faults, given, "a", "an acceleration in m/s²")
    if lifted:
        lowest, positions = positions, _read_positions(faults, given, "cam")
        if led is not None and lowest is not None:
            led = replace(led, lowest=lowest[0])
            rate = abs(led.n) * math.pi / 30.0
    if posed is not None:
        positions = (math.nan,) * len(posed.values)  # found when the mechanism is assembled
    judged: Span = ()
    if counted and posed is None and (positions is None or len(positions) > 1):
        judged = positions or ANYWHERE
        positions = (math.nan,) * numbered if positions or "phi" not in given else None
    if len(faults) != before or positions is None or rate is None or acceleration is None:
        return None
    turns = rate * 30.0 / math.pi if "n" in given else None
    pivot, geared = (pivots[0], geared) if pivots else (None, None)
    return Drive(
        link.name, pivot, positions, rate, acceleration, geared, turns, posed, judged, cam_drive=led
    )


def _split(leading: GearDrive | CamDrive) -> tuple[GearDrive | None, CamDrive | None]:
    """Return the train, or the cam."""
    return (leading, None) if isinstance(leading, GearDrive) else (None, leading)


def _check_follower(faults: Faults, table: Table, led: CamDrive | None, *, crank: bool) -> None:
    """Note why a cam's follower cannot drive: its kind, or several positions."""
    key = "phi" if crank else "s"
    if led is not None and led.turns is not crank:
        what = "a translating follower moves a slider, an oscillating one a crank"
        faults.add("driver.cam", what, "Change follower of [cam], or the driving link.")
    if isinstance(table.get(key), list | Mapping):
        what = "one place is expected: that of the link while the follower is lowest"
        faults.add(f"driver.{key}", what, "Give the angles of the cam: cam = [0, 30, 60].")
    for other in ("stroke", "at", "root", *filter(is_posed, table)):
        if other in table:
            faults.add(f"driver.{other}", _WITH_CAM)


_ACTED = "does not go with an actuator, whose rate drives"
_WITH_CAM = "does not go with a cam, whose follower drives"


def _read_link(faults: Faults, table: Table, links: Mapping[str, LinkText]) -> LinkText | None:
    if "link" not in table:
        faults.add("driver.link", "missing", translate("Name the driving link: {}.", listed(links)))
        return None
    value = table["link"]
    if not isinstance(value, str):
        hint = translate('Write link = "{}".', value) if isinstance(value, int) else ""
        faults.expected("driver.link", "the name of a link", value, hint)
        return None
    name = value if value in links else fields.unmask(faults, "driver.link", value)
    if name not in links:
        fields.report_unknown(faults, "driver.link", name, links, message="unknown link '{}'")
        return None
    return links[name]


def _check_crank_axis(faults: Faults, link: LinkText, pivot: str) -> None:
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
    faults.add(
        f"{link.path}.{first.key}",
        translate(
            "the own axis of the crank starts at {}, phi is measured at the pivot {}",
            first.a,
            pivot,
        ),
        hint,
    )


def _read_positions(faults: Faults, table: Table, key: str) -> Span | None:
    path = f"driver.{key}"
    if key not in table:
        return None
    value = table[key]
    if isinstance(value, list):
        if not value:
            faults.add(path, "expected at least one position, got an empty list")
            return None
        if exceeds_position_limit(faults, path, len(value)):
            return None
        read = [_read_position(faults, f"{path}[{i}]", item, key) for i, item in enumerate(value)]
        kept = [item for item in read if item is not None]
        return tuple(kept) if len(kept) == len(read) else None
    if isinstance(value, Mapping):
        return _read_span(faults, path, value, key)
    one = _read_position(faults, path, value, key)
    return None if one is None else (one,)


def _read_position(faults: Faults, path: str, value: object, key: str) -> float | None:
    if not fields.is_number(value) and not isinstance(value, str) and "[" not in path:
        want = "a number, a list, or { from, to, step } or { from, count }"
        faults.expected(path, want, value)
        return None
    return (
        fields.read_angle(faults, path, value)
        if key in ANGLES
        else fields.read_coordinate(faults, path, value)
    )


def exceeds_position_limit(faults: Faults, path: str, count: int) -> bool:
    """Return whether there are more positions than a file may have, noting the fault."""
    if count <= keys.POSITION_LIMIT:
        return False
    shown = f"{count}" if count < 10**9 else "over a billion"
    faults.add(path, translate("{} positions, the limit is {}", shown, keys.POSITION_LIMIT))
    return True


def _read_span(faults: Faults, path: str, table: Table, key: str) -> Span | None:
    """Read a row of positions: ``{ from, count }`` is a full turn."""
    before = len(faults)
    given = fields.read_keys(faults, path, table, keys.SPAN)
    if len(faults) != before:
        return None
    names = set(given)
    full_turn = names == {"from", "count"} and key in ANGLES
    if not full_turn and names not in ({"from", "to", "count"}, {"from", "to", "step"}):
        ways = "{ from, to, step } or { from, to, count }"
        if key in ANGLES:
            ways = translate("{{ from, count }} (a full turn), {}", ways)
        faults.add(path, translate("expected {}, got {{ {} }}", ways, listed(given)))
        return None
    start = _read_position(faults, f"{path}.from", given["from"], key)
    end = 0.0 if full_turn else _read_position(faults, f"{path}.to", given["to"], key)
    return spread(faults, path, given, start, end, full_turn=full_turn)


def spread(
    faults: Faults,
    path: str,
    table: Table,
    start: float | None,
    end: float | None,
    *,
    full_turn: bool = False,
) -> Span | None:
    """Return the row from one place to another by its ``count`` or ``step``; None after a fault."""
    if "count" in table:
        count = table["count"]
        least = 1 if full_turn else 2
        if not isinstance(count, int) or isinstance(count, bool) or count < least:
            faults.expected(f"{path}.count", translate("a whole number from {}", least), count)
            return None
        if exceeds_position_limit(faults, f"{path}.count", count) or start is None or end is None:
            return None
        if full_turn:
            return tuple(start + 360.0 * k / count for k in range(count))
        return tuple(start + (end - start) * k / (count - 1) for k in range(count))
    step = fields.read_number(faults, f"{path}.step", table["step"], "a step", low=-1e6, high=1e6)
    if start is None or end is None or step is None:
        return None
    if step == 0 or (end - start) / step < 0:
        faults.add(
            f"{path}.step",
            translate("the step {:g} does not lead from {:g} to {:g}", step, start, end),
        )
        return None
    # a step of 0.1 must reach its end in spite of rounding
    last = math.floor((end - start) / step + 1e-9) if (end - start) / step < 1e9 else 10**9
    if exceeds_position_limit(faults, path, last + 1):
        return None
    return tuple(start + step * k for k in range(last + 1))


def _read_rate(faults: Faults, table: Table, key: str, expected: str) -> float | None:
    """Read a rate; zero when it is not given."""
    return fields.read_number(faults, f"driver.{key}", table.get(key, 0.0), expected)


def _read_turning(faults: Faults, table: Table, geared: GearDrive | None) -> float | None:
    """Angular velocity, 1/s, from omega, n or the train."""
    if "cam" in table or any(map(is_length, table)):
        return 0.0  # found with the position, or by the cam
    one, *others = [key for key in ("omega", "n", "train") if key in table] or ["omega"]
    for other in others:
        faults.add(
            f"driver.{other}",
            translate("{} and {} are both given", one, other),
            "Keep one of them.",
        )
    if others:
        return None
    if "train" in table:
        return None if geared is None else geared.rate
    if "n" in table:
        turns = _read_rate(faults, table, "n", "a rotational speed in rev/min")
        return None if turns is None else turns * math.pi / 30.0
    return _read_rate(faults, table, "omega", "an angular velocity in 1/s")


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
    faults: Faults,
    table: object,
    moving: Collection[str],
    fixed: Collection[str],
) -> tuple[Rule, ...]:
    """Read ``[assembly]``: one rule for each point.

    Parameters
    ----------
    moving, fixed : collection of str
        Points of the moving links and of the frame.
    """
    entries = fields.read_table(faults, "assembly", table, 'E = "right of D"')
    if entries is None:
        return ()
    rules: list[Rule] = []
    known = list(dict.fromkeys([*moving, *fixed]))
    for key, value in entries.items():
        path = f"assembly.{segment(key)}"
        name = fields.unmask(faults, path, key)
        if name in fixed:
            faults.add(
                path, translate("point {} is fixed", name), "Rules are for points that move."
            )
            continue
        if name not in moving:
            fields.report_unknown(faults, path, name, moving, message="unknown point '{}'")
            continue
        rule = _read_rule(faults, path, name, value, known)
        if rule is not None:
            rules.append(rule)
    return tuple(rules)


def _read_rule(
    faults: Faults, path: str, point: str, value: object, known: list[str]
) -> Rule | None:
    if isinstance(value, Mapping):
        return _read_rule_table(faults, path, point, value, known)
    want = '"right of D", "left of CB", "above D" or { near = [x, y] }'
    if not isinstance(value, str) or len(value) > 80:
        faults.expected(path, want, value)
        return None
    words = [fields.unmask(faults, path, word) for word in value.split()]
    if len(words) == 3 and words[1] == ("from" if words[0] == "away" else "of"):
        del words[1]
    if len(words) != 2 or words[0] not in _POINT_WORDS:
        guess = nearest_name(words[0], _POINT_WORDS) if words else None
        meant = {"right": "right of", "left": "left of", "away": "away from"}.get(
            guess or "", guess
        )
        hint = translate('Write "{} {}".', meant, words[-1]) if guess and guess != words[0] else ""
        faults.expected(path, want, value, hint)
        return None
    side, name = words
    if is_point_name(name):
        ref = fields.read_known_point(faults, path, name, known, of="the mechanism")
        if ref == point:
            faults.add(path, translate("{} cannot be compared with itself", point))
            return None
        return None if ref is None else Rule(point, _POINT_WORDS[side], (ref,))
    if split_pair(name) is None:
        faults.expected(path, want, value)
        return None
    line = fields.read_line_name(faults, path, name, known, of="the mechanism")
    if line is None:
        return None
    if side not in _LINE_WORDS:
        hint = translate("A point is above or below one point: {} {}.", side, line[1])
        faults.add(path, translate("'{}' does not go with the line {}", side, name), hint)
        return None
    if point in line:
        faults.add(path, translate("the line {} goes through {} itself", name, point))
        return None
    return Rule(point, _LINE_WORDS[side], line)


def _read_rule_table(
    faults: Faults, path: str, point: str, value: Mapping[str, object], known: list[str]
) -> Rule | None:
    given = fields.read_keys(faults, path, value, keys.RULE)
    keep = given.get("keep")
    if "keep" in given and keep not in keys.ASSEMBLY_FLAGS:
        wanted = translate(" or ").join(f'"{word}"' for word in keys.ASSEMBLY_FLAGS)
        faults.expected(f"{path}.keep", wanted, keep)
        return None
    first = [key for key in ("near", "rule") if key in given]
    if keep == "parallel":
        if first:
            faults.add(f"{path}.{first[0]}", "a parallelogram has one closing", "Delete this key.")
            return None
        return Rule(point, AssemblyRelation.PARALLEL)
    if len(first) != 1:
        said = "give near or rule, not both" if first else "missing"
        faults.add(
            f"{path}.near", said, translate("For example: {} = {{ near = [0.1, 0.2] }}", point)
        )
        return None
    if "rule" in given:
        phrase = given["rule"]
        if isinstance(phrase, Mapping):
            faults.expected(f"{path}.rule", "a phrase", phrase)
            return None
        found = _read_rule(faults, f"{path}.rule", point, phrase, known)
    else:
        at = fields.read_place(faults, f"{path}.near", given["near"])
        found = None if at is None else Rule(point, AssemblyRelation.NEAR, at=at)
    return None if found is None else replace(found, continuous=keep is not None)


def read_scales(faults: Faults, table: object) -> Scales:
    """Read ``[scales]``; the result is unit per millimetre whichever convention the file has."""
    entries = fields.read_table(faults, "scales", table, "mu_l = 0.002")
    if not entries:
        return Scales()
    found = read_flat(faults, "scales", entries, Scales)
    if found.get("convention") is Convention.MM_PER_UNIT:
        found |= {key: 1.0 / found[key] for key in found if key.startswith("mu_")}
    return Scales(**found)
