"""Variants of a problem: dotted keys laid over the main part of the file (варианты)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planmethod.problem import keys
from planmethod.problem.fields import FAULT_LIMIT, Faults, read_table
from planmethod.problem.links import read_label
from planmethod.problem.names import (
    fold,
    is_point_name,
    joined,
    near,
    segment,
    split_pair,
)

Path = tuple[str, ...]

_FREE = ("dynamics", "loads", "gears", "point")
"""Tables whose keys later parts check."""

_MOTION = ("frame", "links", "driver", "assembly")
"""Tables on which the published values depend."""


def read_variants(faults: Faults, table: Mapping[str, Any]) -> dict[str, dict[Path, Any]]:
    """Return the overrides of every variant, by path; unknown paths are faults."""
    entries = read_table(faults, "variants", table.get("variants", {})) or {}
    found: dict[str, dict[Path, Any]] = {}
    if len(entries) > keys.VARIANT_LIMIT:
        faults.add("variants", f"{len(entries)} variants, the limit is {keys.VARIANT_LIMIT}")
        return found
    for name, body in entries.items():
        path = f"variants.{segment(name)}"
        if not read_label(faults, path, name, "variant"):
            continue
        found[name] = {}
        inner: set[Path] = set()
        overrides = read_table(faults, path, body, "driver.phi = 120")
        if overrides is None:
            continue
        for where, value in _overrides(table, overrides, ()):
            prefixes = [where[:depth] for depth in range(1, len(where))]
            if where in found[name] or where in inner or any(p in found[name] for p in prefixes):
                faults.add(joined(path, *map(segment, where)), "this value is overridden twice")
            elif _check_path(faults, path, table, where):
                found[name][where] = value
                inner.update(prefixes)
    return found


def _overrides(
    base: Mapping[str, Any], table: Mapping[str, Any], before: Path
) -> Iterator[tuple[Path, Any]]:
    """Yield every path of an override table; ``"driver.phi"`` in quotes means two parts."""
    for key, value in table.items():
        whole = (*before, key)
        parts = whole if _get(base, whole) is not None else (*before, *key.split("."))
        under = _get(base, parts)
        if isinstance(value, Mapping) and isinstance(under, Mapping) and not _is_leaf(parts):
            yield from _overrides(base, value, parts)
        else:
            yield parts, value


def _is_leaf(path: Path) -> bool:
    """Whether a table at this path is one value: spans of positions and places."""
    return path[:-1] == ("driver",) or (path[:1] == ("assembly",) and len(path) > 1)


def _get(base: object, path: Path) -> Any:
    for part in path:
        if not isinstance(base, Mapping):
            return None
        base = base.get(part)
    return base


def _known_under(path: Path) -> tuple[str, ...]:
    """Keys that may be added to the table at a path although the main part lacks them."""
    if not path:
        return tuple(key for key in keys.TOP if key != "variants")
    first = path[0]
    if first == "links":
        return {2: keys.LINK, 3: keys.SLIDES if path[2:] == ("slides",) else keys.POINT}.get(
            len(path), ()
        )
    if first == "frame":
        return {1: keys.FRAME, 3: keys.GUIDE}.get(len(path), ())
    if first == "published":
        return keys.PUBLISHED if len(path) == 2 else ()
    if first == "driver" and len(path) == 2:
        return keys.SPAN
    return keys.KNOWN.get(first, ()) if len(path) == 1 else ()


def _may_add(path: Path) -> bool:
    """Whether a name of the file's own may be added at this path: a point, a length, a rule."""
    parent, key = path[:-1], fold(path[-1])
    if len(parent) == 2 and parent[0] == "links":
        return is_point_name(key) or split_pair(key) is not None
    if parent in (("frame",), ("assembly",)):
        return is_point_name(key)
    return parent in (("frame", "guides"), ("published",))


def _check_path(faults: Faults, path: str, base: Mapping[str, Any], where: Path) -> bool:
    shown = joined(path, *map(segment, where))
    if where[0] == "variants":
        faults.add(shown, "a variant cannot hold variants")
        return False
    if where[0] in _FREE:
        return True
    for depth in range(1, len(where) + 1):
        part, parent = where[:depth], where[: depth - 1]
        known = _known_under(parent)
        if _get(base, part) is not None or part[-1] in known or _may_add(part):
            continue
        table = _get(base, parent)
        names = [*(table if isinstance(table, Mapping) else ()), *known]
        guess = near(part[-1], names) if faults.count < FAULT_LIMIT else None
        dotted = ".".join(where[:depth])
        hint = f"Did you mean '{'.'.join((*parent, guess))}'?" if guess else ""
        faults.add(shown, f"the file has no '{dotted}' to override", hint)
        return False
    return True


def apply_variant(table: Mapping[str, Any], overrides: Mapping[Path, Any]) -> dict[str, Any]:
    """Lay the overrides of a variant over the main part; the table itself is left as it is.

    Published values belong to the main part: a variant that moves otherwise has only its own.
    """
    result = dict(table)
    if any(path[0] in _MOTION for path in overrides):
        result.pop("published", None)
    for path, value in overrides.items():
        level = result
        for part in path[:-1]:
            below = level.get(part)
            level[part] = dict(below) if isinstance(below, Mapping) else {}
            level = level[part]
        level[path[-1]] = value
        if path == ("driver", "n"):
            level.pop("omega", None)
        elif path == ("driver", "omega"):
            level.pop("n", None)
    return result
