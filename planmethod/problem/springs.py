"""``[[springs]]`` of a problem file: springs, gas struts and dampers (пружины, демпферы).

What a spring exerts on each moving link is a load of its own, which passes through the force
analysis as every other load.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import partial

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import keys
from planmethod.problem.dynamics import LoadScope, read_symbol
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.links import LinkText
from planmethod.problem.names import indexed, listed, nearest_name_hint
from planmethod.problem.records import Couple, Dynamics, Load, Spring, SpringEnd

_EXAMPLE = 'links = ["3", "0"], points = ["P", "S"], stiffness = 2000, length = 0.12'
_LINKS = 'links = ["3", "0"]'
_POINTS = 'points = ["P", "S"]'


def _for_example(text: str) -> str:
    return translate("For example: {}.", text)


def with_springs(node: FileNode, scope: LoadScope, dynamics: Dynamics) -> Dynamics:
    """Read ``[[springs]]`` and return the dynamics with the springs and their loads."""
    springs = node.attempt(partial(_read_springs, scope=scope, dynamics=dynamics)) or ()
    used = {load.name for load in dynamics.loads} | {spring.symbol for spring in springs}
    loads = (load for spring in springs for load in _loads(spring, used))
    return replace(dynamics, springs=springs, loads=(*dynamics.loads, *loads))


def _loads(spring: Spring, used: set[str]) -> Iterator[Load | Couple]:
    """Yield what a spring exerts on its moving links; the second load has a prime."""
    name = spring.symbol
    for number, link in enumerate(spring.links):
        if link == FRAME:
            continue
        end = SpringEnd(number)
        if spring.is_torsion:
            yield Couple(name, link, spring, end, path=spring.path)
        else:
            yield Load(name, link, str(spring.points[number]), spring, end, path=spring.path)
        name = _free(name, used)
        used.add(name)


def _free(name: str, used: Collection[str]) -> str:
    """Return the first name with primes that is free."""
    while name in used:
        name += "'"
    return name


def _read_springs(node: FileNode, scope: LoadScope, dynamics: Dynamics) -> tuple[Spring, ...]:
    node.tables(keys.SPRING_LIMIT, "{} springs, the limit is {}")
    names: list[str] = [load.name for load in dynamics.loads]
    for entry in node.entries():
        name = entry.read("name", partial(_read_name, names=names))
        names += [] if name is None else [name]
    found: list[Spring] = []
    for number, entry in enumerate(node.entries(), 1):
        spring = entry.attempt(partial(_read_spring, scope=scope))
        if spring is not None:
            letter = "M" if spring.is_torsion else "F"
            name = spring.name or _free(f"{letter}_{{s{number}}}", names)
            names.append(indexed(name))
            found.append(replace(spring, name=name))
    return tuple(found)


def _read_name(node: FileNode, names: Collection[str]) -> str:
    name = read_symbol(node)
    if name in names:
        hint = "Give it another letter."
        node.reject("another load or spring is named {}", name, hint=hint)
    return name


def _read_spring(node: FileNode, scope: LoadScope) -> Spring:
    found = node.record(
        Spring,
        example=_EXAMPLE,
        name=_unread_value,
        links=partial(_read_links, scope=scope),
        length=_read_reach,
        joint=FileNode.point_name,
        points=_unread_value,
        stops=_unread_value,
    )
    links = found.get("links")
    if "joint" in node:
        _check_torsion(node, links, scope)
    else:
        points = node.require(
            "points", partial(_read_ends, links=links, scope=scope), _for_example(_POINTS)
        )
        found["points"] = points
        if "angle" in node:
            hint = "Give the joint of a torsion spring, or the length of a straight one."
            node["angle"].note("valid only for a torsion spring", hint=hint)
    _check_size(node)
    if "stops" in node:
        found["stops"] = node.read("stops", partial(_read_stops, torsion="joint" in node))
    return node.build(Spring, {"name": "", **found, "path": node.path})


def _unread_value(node: FileNode) -> object:
    """Return the value, which is read where the links are known."""
    return node.value


def _read_links(node: FileNode, scope: LoadScope) -> tuple[str, str]:
    node.array("the names of two links", _for_example(_LINKS), low=2, high=2)

    known = (FRAME, *scope.links)

    def read(link: FileNode) -> str:
        if link.value in (FRAME, 0):
            return FRAME
        name = link.any_name("the name of a link", known)
        if scope.links and name not in scope.links:
            link.reject_unknown(name, known, "unknown link '{}'")
        return needed(scope.links.get(name)).name

    first, second = node.read_all(read)
    if first == second:
        hint = "Within one link it does nothing: its length is the same in every position."
        node.reject("a spring joins two different links", hint=hint)
    return first, second


def _read_ends(
    node: FileNode, links: tuple[str, str] | None, scope: LoadScope
) -> tuple[str | complex, ...]:
    """Read the ends of a straight spring: a point of each link, or a place on the frame."""
    node.array("a point of each of the two links", _for_example(_POINTS), low=2, high=2)
    chosen = iter(links or ())

    def read(point: FileNode) -> str | complex:
        link = next(chosen)
        if link != FRAME:
            return scope.point_of(point, scope.links[link])
        if isinstance(point.value, list):
            return point.place()
        return _fixed_point(point, scope)

    if links is None:
        return ()
    first, second = node.read_all(read)
    if first == second:
        hint = "Name two different points: the length of the spring is their distance."
        node.reject("both ends are at the point {}", first, hint=hint)
    return first, second


def _fixed_point(node: FileNode, scope: LoadScope) -> str:
    """Read the name of a point of the frame."""
    name = node.point_name()
    if name not in scope.fixed:
        known = translate("The points of the frame are {}.", listed(scope.fixed))
        hint = nearest_name_hint(name, scope.fixed, known)
        node.reject("the frame has no point '{}'", name, hint=hint)
    return name


def _check_torsion(node: FileNode, links: tuple[str, str] | None, scope: LoadScope) -> None:
    """Check the joint of a torsion spring, and that it has no key of a straight one."""
    for key in ("points", "length"):
        if key in node:
            hint = "A torsion spring has links, joint, stiffness and angle."
            node[key].note("not valid for a torsion spring", hint=hint)
    joint = node["joint"]
    if links is None or not joint.is_sound or not isinstance(joint.value, str):
        return

    def check(point: FileNode) -> None:
        for link in links:
            if link == FRAME:
                _fixed_point(point, scope)
                continue
            scope.point_of(point, scope.links[link])
            if not _has_axis(scope.links[link], scope):
                hint = "A torsion spring measures the angle between the axes of its links."
                point.reject("link {} has one point and no axis", link, hint=hint)

    joint.attempt(check)


def _has_axis(link: LinkText, scope: LoadScope) -> bool:
    """Return whether the places of points determine the direction of a link: its own or others'."""
    if len(link.points) > 1:
        return True
    if link.arc is None and link.slides is not None:
        host = scope.links.get(str(link.slides["on"].value))
        return host is None or len(host.points) > 1
    return any(
        one.slides is not None and one.slides["on"].value == link.name and len(one.points) > 1
        for one in scope.links.values()
    )


def _check_size(node: FileNode) -> None:
    """Check that a spring has a size, and one rest."""
    torsion = "joint" in node
    rest = "angle" if torsion else "length"
    if not node.is_whole:
        return
    if not any(key in node for key in ("stiffness", "damping", "preload")):
        text = "expected stiffness, damping or preload, got none of them"
        node.note(text, hint=_for_example(_EXAMPLE))
        return
    stiff = "stiffness" in node and node["stiffness"].value != 0
    if rest in node and "preload" in node:
        hint = "The preload is the force in the first position; it replaces the free length."
        if torsion:
            hint = "The preload is the moment in the first position; it replaces the angle of rest."
        node["preload"].note("{} is also given", rest, hint=hint)
    elif stiff and rest not in node and "preload" not in node:
        hint = "Give the free length of the spring in metres, or its preload in newtons."
        if torsion:
            hint = "Give the angle of rest in degrees, or the preload in newton metres."
        node.note_missing(rest, hint)
    elif rest in node and not stiff:
        hint = "Give the stiffness, for example: stiffness = 2000."
        node[rest].note("{} has no effect without stiffness", rest, hint=hint)


def _read_stops(node: FileNode, *, torsion: bool) -> tuple[float, float]:
    expected = "two angles in degrees" if torsion else "two lengths"
    node.array(expected, _for_example("stops = [0.1, 0.3]"), low=2, high=2)
    low, high = node.read_all(FileNode.angle if torsion else _read_reach)
    if low >= high:
        node.reject("the first stop must be less than the second one", hint="Exchange them.")
    return low, high


def _read_reach(node: FileNode) -> float:
    return node.metres("length", low=0.0)
