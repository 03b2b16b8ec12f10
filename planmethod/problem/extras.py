"""Published values, and the tables that later parts read."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from planmethod.languages import say
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults
from planmethod.problem.flat import read_flat
from planmethod.problem.head import Published
from planmethod.problem.names import listed, near_hint, segment, short
from planmethod.problem.selector import (
    Selector,
    SelectorError,
    is_force,
    parse_selector,
    unknown_names,
)

if TYPE_CHECKING:
    from planmethod.problem.load_records import Dynamics

TABLE_KEYS = ("gears", "point", "meshing")


def read_published(
    faults: Faults,
    table: object,
    check: Callable[[str, str, str], str],
    *,
    positions: int = 0,
    example: str = 'value = 3, unit = "м/с", what = "v B"',
    without: Collection[str] = (),
) -> tuple[Published, ...]:
    """Read ``[published."name"]``.

    Parameters
    ----------
    check : callable
        Gets the path, ``what`` (empty where it is absent) and the name, notes faults of the
        quantity, and returns ``what`` as outputs have it.
    positions : int
        How many there are; 0 when not known.
    example, without
        An entry, and the keys that one may not have.
    """
    entries = fields.read_table(faults, "published", table, f'[published."v_B"] {example}') or {}
    if faults.beyond("published", "{} values, the limit is {}", len(entries), keys.PUBLISHED_LIMIT):
        return ()
    own = {"position": partial(read_position, positions=positions)}
    found: list[Published] = []
    for name, entry in entries.items():
        path = f"published.{segment(name)}"
        body = fields.read_table(faults, path, entry, example)
        if fields.read_text(faults, path, name, limit=80) is None or body is None:
            continue
        given = read_flat(faults, path, body, Published, own, without=without)
        given["what"] = check(f"{path}.what", given.get("what", ""), name)
        if "value" in given:
            found.append(Published(name, **given))
    return tuple(found)


def read_position(faults: Faults, path: str, value: object, positions: int) -> int | None:
    """Read which position of the driver is meant, from 0; ``positions`` is 0 when not known."""
    if value is None:
        return None
    if not isinstance(value, int) or isinstance(value, bool) or value < 0:
        faults.expected(path, "a whole number from 0", value)
        return None
    if positions and value >= positions:
        faults.add(path, say("position {} of {}", value, positions), "The first position is 0.")
        return None
    return value


def check_what(
    faults: Faults,
    path: str,
    what: str,
    points: Collection[str],
    links: Collection[str],
    dynamics: Dynamics | None,
) -> Selector | None:
    """Parse ``what`` and check its names; None where it cannot be parsed.

    Parameters
    ----------
    points, links : collections of str
        Names of the mechanism, with those of coincident points; empty when it could not be read.
    """
    try:
        selector = parse_selector(what)
    except SelectorError as error:
        faults.add(path, str(error), 'For example: "v C", "an C B", "omega 2", "F 2 1".')
        return None
    if not points or not links:
        return selector
    if is_force(selector) and dynamics is None:
        faults.add(
            path,
            say(
                "'{}' is of the force analysis, and the file has no masses and no loads",
                short(what),
            ),
            "Give [dynamics] or [[loads]].",
        )
        return selector
    loads = [load.name for load in dynamics.loads] if dynamics else []
    for name in unknown_names(selector, points, links, loads):
        known = [say("Points: {}", listed(points))]
        if is_force(selector):
            known += [say("links: {}", listed(links))]
            known += [say("loads: {}", listed(loads))] if loads else []
        hint = near_hint(name, [*points, *links, *loads], f"{'; '.join(known)}.")
        faults.add(path, say("the mechanism has no '{}'", name), hint)
    return selector


def read_tables(faults: Faults, table: Mapping[str, Any]) -> dict[str, Any]:
    """Take over the tables that later parts read, checking no more than their TOML type."""
    found: dict[str, Any] = {}
    for key in TABLE_KEYS:
        if key not in table:
            continue
        value = fields.read_table(faults, key, table[key])
        if value is not None:
            found[key] = value
    return found
