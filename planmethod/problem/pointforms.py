"""Reading of a third point of a link: on a side, along a line, from a point, by an angle."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from planmethod.languages import translate
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
from planmethod.problem.model import PointForm
from planmethod.problem.names import listed


def read_form(
    faults: Faults,
    path: str,
    point: str,
    value: Table,
    points: Collection[str],
    of: fields.Owner,
) -> PointForm | None:
    """Read the table of a third point; None after noting a fault.

    Parameters
    ----------
    points : collection of str
        Of the link.
    of : callable
        Returns the owner of the points.
    """
    table = fields.read_keys(faults, path, value, keys.POINT)
    kinds = [kind for kind in keys.POINT_FORMS if kind in table]
    if len(kinds) != 1:
        got = translate("got {}", translate(" and ").join(kinds)) if kinds else "got none of them"
        hint = translate('For example: {} = {{ on = "BC", at = 0.1, across = 0 }}', point)
        faults.add(path, translate("expected one of side, on, from, vertex, {}", got), hint)
        return None
    (kind,) = kinds
    allowed = keys.POINT_FORMS[kind]
    for key in table:
        if key not in allowed:
            hint = translate("With '{}' go {}.", kind, listed(allowed))
            faults.add(f"{path}.{key}", translate("does not go with '{}'", kind), hint)
    return _READERS[kind](faults, path, point, table, points, of)


def _need(faults: Faults, path: str, table: Table, *names: str) -> bool:
    missing = [name for name in names if name not in table]
    for name in missing:
        faults.add(f"{path}.{name}", "missing")
    return not missing


def _read_side(
    faults: Faults, path: str, point: str, table: Table, points: Collection[str], of: fields.Owner
) -> PointForm | None:
    value = table["side"]
    where = f"{path}.side"
    words = value.split() if isinstance(value, str) else []
    words = [fields.unmask(faults, where, word) for word in words]
    if len(words) != 3 or words[0] not in ("left", "right") or words[1] != "of":
        faults.expected(where, '"left of BC" or "right of BC"', value)
        return None
    line = fields.read_line_name(faults, where, words[2], points, of=of)
    if line is None:
        return None
    if point in line:
        faults.add(where, translate("the line {} goes through {} itself", words[2], point))
        return None
    return PointForm("side", line=line, left=words[0] == "left")


def _read_along(faults: Faults, path: str, table: Table) -> tuple[float, float] | None:
    if not _need(faults, path, table, "at"):
        return None
    at = fields.read_coordinate(faults, f"{path}.at", table["at"])
    across = fields.read_coordinate(faults, f"{path}.across", table.get("across", 0.0))
    return None if at is None or across is None else (at, across)


def _read_on(
    faults: Faults, path: str, point: str, table: Table, points: Collection[str], of: fields.Owner
) -> PointForm | None:
    line = fields.read_line_name(faults, f"{path}.on", table["on"], points, of=of)
    along = _read_along(faults, path, table)
    if line is None or along is None:
        return None
    if point in line:
        faults.add(
            f"{path}.on", translate("the line {} is named by {} itself", "".join(line), point)
        )
        return None
    return PointForm("on", line=line, at=along[0], lateral_offset=along[1])


def _read_from(
    faults: Faults, path: str, point: str, table: Table, points: Collection[str], of: fields.Owner
) -> PointForm | None:
    start = fields.read_known_point(faults, f"{path}.from", table["from"], points, of=of)
    along = _read_along(faults, path, table)
    if start is None or along is None:
        return None
    if start == point:
        faults.add(f"{path}.from", translate("{} cannot be measured from itself", point))
        return None
    return PointForm("from", point=start, at=along[0], lateral_offset=along[1])


def _read_vertex(
    faults: Faults, path: str, point: str, table: Table, points: Collection[str], of: fields.Owner
) -> PointForm | None:
    vertex = fields.read_known_point(faults, f"{path}.vertex", table["vertex"], points, of=of)
    if not _need(faults, path, table, "ray", "angle"):
        return None
    ray = fields.read_line_name(faults, f"{path}.ray", table["ray"], points, of=of)
    angle = fields.read_angle(faults, f"{path}.angle", table["angle"])
    distance: Any = table.get("distance")
    if distance is not None:
        distance = fields.read_length(faults, f"{path}.distance", distance)
        if distance is None:
            return None
    if vertex is None or ray is None or angle is None:
        return None
    if ray[0] != vertex or point in ray:
        faults.add(
            f"{path}.ray",
            translate(
                "expected a ray from {} to another point of the link, got '{}'",
                vertex,
                "".join(ray),
            ),
        )
        return None
    return PointForm("vertex", point=vertex, line=ray, angle=angle, distance=distance)


_READERS = {
    "side": _read_side,
    "on": _read_on,
    "from": _read_from,
    "vertex": _read_vertex,
}
