"""Reading of a third point of a link: on a side, along a line, from a point, by an angle."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import partial

from planmethod.languages import translate
from planmethod.problem import keys
from planmethod.problem.file_node import FileNode, LazyText
from planmethod.problem.model import PointForm
from planmethod.problem.names import listed

FormReader = Callable[[FileNode, str, Collection[str], LazyText], PointForm]
"""Of the table of a point, its name, the points of its link and their owner."""


def read_form(node: FileNode, point: str, points: Collection[str], owner: LazyText) -> PointForm:
    """Read the table of a third point.

    Parameters
    ----------
    points : collection of str
        Of the link.
    owner : str or callable
        Of the points.
    """
    node.allow(keys.POINT)
    kinds = [kind for kind in keys.POINT_FORMS if kind in node]
    if len(kinds) != 1:
        got = translate("got {}", translate(" and ").join(kinds)) if kinds else "got none of them"
        hint = translate('For example: {} = {{ on = "BC", at = 0.1, across = 0 }}', point)
        node.reject("expected one of side, on, from, vertex, {}", got, hint=hint)
    (kind,) = kinds
    allowed = keys.POINT_FORMS[kind]
    for key in node.value:
        if key not in allowed:
            hint = translate("With '{}' go {}.", kind, listed(allowed))
            node[key].note("does not go with '{}'", kind, hint=hint)
    return _READERS[kind](node, point, points, owner)


def _read_side(node: FileNode, point: str, points: Collection[str], owner: LazyText) -> PointForm:
    side = node["side"]
    words = side.value.split() if isinstance(side.value, str) else []
    words = [side.unmask(word) for word in words]
    if len(words) != 3 or words[0] not in ("left", "right") or words[1] != "of":
        side.reject_value('"left of BC" or "right of BC"')
    line = side.split_line(words[2], owner, points)
    if point in line:
        side.reject("the line {} goes through {} itself", words[2], point)
    return PointForm("side", line=line, left=words[0] == "left")


def _read_on(node: FileNode, point: str, points: Collection[str], owner: LazyText) -> PointForm:
    line = node.read("on", lambda on: on.line_of(owner, points))
    at, across = _read_along(node)
    if line is not None and point in line:
        node["on"].note("the line {} is named by {} itself", "".join(line), point)
    values = {"line": line, "at": at, "lateral_offset": across}
    return node.build(partial(PointForm, "on"), values)


def _read_from(node: FileNode, point: str, points: Collection[str], owner: LazyText) -> PointForm:
    start = node.read("from", lambda start: start.point_of(owner, points))
    at, across = _read_along(node)
    if start == point:
        node["from"].note("{} cannot be measured from itself", point)
    values = {"point": start, "at": at, "lateral_offset": across}
    return node.build(partial(PointForm, "from"), values)


def _read_along(node: FileNode) -> tuple[float | None, float | None]:
    """Read where a point is, along a line and across it."""
    at = node.require("at", FileNode.coordinate)
    return at, node.read("across", FileNode.coordinate, 0.0)


def _read_vertex(node: FileNode, point: str, points: Collection[str], owner: LazyText) -> PointForm:
    vertex = node.read("vertex", lambda vertex: vertex.point_of(owner, points))
    ray = node.require("ray", lambda ray: ray.line_of(owner, points))
    angle = node.require("angle", FileNode.angle)
    distance = node.read("distance", FileNode.length)
    if vertex is not None and ray is not None and (ray[0] != vertex or point in ray):
        message = "expected a ray from {} to another point of the link, got '{}'"
        node["ray"].note(message, vertex, "".join(ray))
    values = {"point": vertex, "line": ray, "angle": angle, "distance": distance}
    return node.build(partial(PointForm, "vertex"), values)


_READERS: dict[str, FormReader] = {
    "side": _read_side,
    "on": _read_on,
    "from": _read_from,
    "vertex": _read_vertex,
}
