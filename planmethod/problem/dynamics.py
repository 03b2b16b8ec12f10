"""Loads and ``[dynamics]``, ``[balancing]``, ``[friction]``, ``[bearings]`` of a problem file."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from functools import partial
from typing import Any, NoReturn

from msgspec import Struct
from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import keys
from planmethod.problem.drive import require_turning
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.links import LinkText
from planmethod.problem.machine_records import CounterweightTask, Weighing
from planmethod.problem.model import MOTOR_DRIVES, Drive
from planmethod.problem.names import indexed, listed, nearest_name_hint, pair_name
from planmethod.problem.records import (
    GRAVITY,
    Against,
    BalancingForceTask,
    BearingSection,
    Couple,
    Dynamics,
    Fixed,
    FrictionTask,
    Load,
    LoadSize,
    Mass,
    PairFriction,
    SizeTable,
)
from planmethod.problem.sizes import LIKE, TURN, liken, read_phase, read_size

NAME_LIMIT = 40
_NAME_RE = r"(?:[^_^{}\\]|[_^](?:[^_^{}\\]|\{[^_^{}\\]+\}))+\Z"


class LoadScope(Struct, frozen=True):
    """Names that masses and loads may use.

    Attributes
    ----------
    links : mapping of str to LinkText
        Links as written; empty when none could be read.
    fixed : collection of str
        Points of the frame.
    drive : Drive or None
        None when it could not be read.
    cycle : float, degrees
        Period of a table over phi.
    """

    links: Mapping[str, LinkText]
    fixed: Collection[str]
    drive: Drive | None
    cycle: float = TURN

    def link_of(self, node: FileNode, verb: str) -> LinkText:
        """Read the name of a moving link; ``verb`` names their action in messages."""
        name = node.any_name("the name of a link", self.links)
        return self.find_link(node, name, verb)

    def find_link(self, node: FileNode, name: str, verb: str) -> LinkText:
        """Return a moving link by its name, which is the value of a node or its key."""
        if name == FRAME:
            hint = translate("Moving links {}: {}.", verb, listed(self.links))
            node.reject("0 is the frame (стойка), which does not move", hint=hint)
        if self.links and name not in self.links:
            node.reject_unknown(name, self.links, "unknown link '{}'")
        return needed(self.links.get(name))  # without links, that they are missing is a fault

    def point_of(self, node: FileNode, link: LinkText) -> str:
        """Read the name of a point of a link."""
        name = node.point_name()
        if name not in link.points and link.is_complete:
            self._reject_point(node, name, link)
        return name

    def _reject_point(self, node: FileNode, name: str, link: LinkText) -> NoReturn:
        others = [other.name for other in self.links.values() if name in other.points]
        points = translate("the points of link {} are {}", link.name, listed(link.points))
        if others:
            text = "{0} is a point of link{1:||s} {2}; {3}."
            hint = translate(text, name, len(others), listed(others), points)
        elif name in self.fixed:
            hint = translate("{} is a point of the frame; {}.", name, points)
        else:
            hint = nearest_name_hint(name, link.points, f"{points[:1].upper()}{points[1:]}.")
        node.reject("link {} has no point '{}'", link.name, name, hint=hint)


def read_loads(node: FileNode, scene: LoadScope) -> tuple[Load | Couple, ...]:
    """Read ``[[loads]]``, in file order."""
    node.tables(keys.LOAD_LIMIT, "{} loads, the limit is {}")
    names: list[str | None] = []
    for entry in node.entries():
        names.append(entry.read("name", partial(_read_name, names=names)))
    used = {name for name in names if name is not None}
    found: dict[int, Load | Couple] = {}
    for index, (entry, name) in enumerate(zip(node.entries(), names, strict=True)):
        load = entry.attempt(partial(_read_load, name=name, used=used, scene=scene))
        if load is not None:
            found[index] = load
            used.add(load.name)
    # the name of a faulty load is not unknown
    known: dict[str, object] = {name: None for name in names if name is not None}
    known |= {load.name: load.size for load in found.values()}
    for index, load in found.items():
        if isinstance(load.size, SizeTable) and load.size.like is not None:
            where = node[index] if "like" in node[index] else node[index]["force"]
            read = partial(liken, load_name=load.name, size=load.size, known=known)
            size = where.read("like", read)
            found[index] = load if size is None else replace(load, size=size)
    return tuple(found.values())


def read_symbol(node: FileNode) -> str:
    """Read the symbol of a load or a spring."""
    name = node.text(NAME_LIMIT)
    if not re.match(_NAME_RE, name):
        node.reject_value("a letter with its indices", "For example: F_{5}, P, M_{1}^{c}.")
    return indexed(name)


def _read_name(node: FileNode, names: list[str | None]) -> str:
    """Read a name, which must differ from those before it."""
    name = read_symbol(node)
    if name in names:
        hint = "Give it another letter."
        node.note("loads[{}] is also named {}", names.index(name), name, hint=hint)
    return name


def _default_name(letter: str, link: str, used: Collection[str]) -> str:
    """Return the first free name of a load: ``F_{5}``, ``F_{5}'``, ``F_{5}''``, ``F_{5}^{(3)}``."""
    stem = f"{letter}_{{{link}}}"
    for count in range(len(used) + 1):
        name = stem + ("'" * count if count < 3 else f"^{{({count})}}")
        if name not in used:
            return name
    raise AssertionError("the file has more names than loads")


def _read_load(
    node: FileNode, name: str | None, used: Collection[str], scene: LoadScope
) -> Load | Couple:
    if "spring" in node:
        example = (
            '[[springs]] links = ["3", "0"], points = ["P", "S"], stiffness = 2000, length = 0.1'
        )
        hint = translate("For example: {}.", example)
        node["spring"].reject("a spring has a table of its own, [[springs]]", hint=hint)
    node.allow(keys.known("load"))
    link = node.require(
        "link", lambda link: scene.link_of(link, "carry loads"),
        lambda: translate("Name the link: {}.", listed(scene.links)),
    )  # fmt: skip
    size = node["couple" if "couple" in node else "force"]
    likened = {key: node.value[key] for key in keys.LIKE if key in node}
    if likened and ("force" in node or "couple" in node):
        hint = "Keep like and shift, or the size of the load."
        node[next(iter(likened))].note("the size of the load is also given", hint=hint)
    elif "like" in likened:
        size = node.with_value(likened)
    elif likened:
        node["shift"].reject("valid only with like", hint=LIKE)
    if "force" in node and "couple" in node:
        hint = "Write them as two [[loads]]."
        node["couple"].reject("force and couple are both given", hint=hint)
    if size.value is None:
        hint = 'For example: link = "5", at = "H", force = 6000, angle = -90.'
        if node.is_whole:
            node.note("expected force or couple, got neither", hint=hint)
        node.require_sound()
    read = _read_couple if "couple" in node else _read_force
    load = read(node, size, link, scene)
    letter = "F" if isinstance(load, Load) else "M"
    return replace(load, name=name or _default_name(letter, load.link, used))


def _read_force(node: FileNode, size: FileNode, link: LinkText | None, scene: LoadScope) -> Load:
    """Read a force; ``size`` is where its size is given."""
    at = None
    if link is not None:
        named, points = link.name, link.points
        hint = "Name the point of link {} where it acts: {}."
        read_point = partial(scene.point_of, link=link)
        at = node.require("at", read_point, lambda: translate(hint, named, listed(points)))
    fixed_point = at if at in scene.fixed else None
    sense: Fixed | Against | None = None
    if "angle" in node and "against" in node:
        hint = "A force has one direction: keep one of them."
        node["against"].note("angle and against are both given", hint=hint)
    elif "angle" in node:
        sense = node.read("angle", lambda angle: Fixed(angle.angle()))
    elif "against" in node:
        sense = node.read("against", partial(_read_against, expected="velocity"))
        if fixed_point is not None:
            hint = "Give the direction as an angle."
            message = "point {} is fixed and has no velocity"
            node["against"].note(message, fixed_point, hint=hint)
    elif node.is_whole:
        hint = 'Give angle = -90 (degrees from +x) or against = "velocity".'
        node.note("expected a direction, got neither angle nor against", hint=hint)
    read = partial(read_size, drive=scene.drive, turn=scene.cycle)
    force: LoadSize | None = size.attempt(read)
    phase = node.read("phases", partial(read_phase, drive=scene.drive, fixed_point=fixed_point))
    node.require_sound()
    assert force is not None and sense is not None, "no fault of it was noted"
    return Load("", needed(link).name, needed(at), force, sense, phase, node.path)


def _read_couple(node: FileNode, size: FileNode, link: LinkText | None, scene: LoadScope) -> Couple:
    for key, why in (
        ("at", "A couple acts on the whole link."),
        ("angle", "A couple is counter-clockwise when positive."),
    ):
        if key in node:
            node[key].note("not valid for a couple", hint=why)
    sense = node.read("against", partial(_read_against, expected="rotation"))
    read = partial(read_size, drive=scene.drive, couple=True, turn=scene.cycle)
    couple: LoadSize | None = size.attempt(read)
    phase = node.read("phases", partial(read_phase, drive=scene.drive, couple=True))
    node.require_sound()
    assert couple is not None, "no fault of it was noted"
    return Couple("", needed(link).name, couple, sense, phase, node.path)


def _read_against(node: FileNode, expected: str) -> Against:
    word = node.word(("velocity", "rotation"))
    if word != expected:
        node.reject("expected '{}', got '{}'", expected, word, hint=_AGAINST[expected])
    return Against()


_AGAINST = {
    "velocity": "A force acts against the velocity of its point.",
    "rotation": "A couple acts against the rotation of its link.",
}


_EXAMPLE = '[dynamics.links.2] mass = 40, centre = "S2", inertia = 2'
_MASS = 'mass = 40, centre = "S2", inertia = 2'
_MASSES = 'Give them: [dynamics.links.2] mass = 3, centre = "S2".'
_BALANCED = '[balancing] method = "full", radii = { 1 = 0.1, 3 = 0.08 }'
_PUSHED = '[balancing_force] at = "A"'
_FRICTION = "[friction] f = 0.1, f_pin = 0.1, radius = 0.01"
_PAIR = 'friction.pairs."B 3-0" = { f = 0.2 }'
_BEARINGS = "[bearings.O] at = [-0.04, 0.06]"


def read_dynamics(file: FileNode, scene: LoadScope) -> Dynamics:
    """Read ``[dynamics]`` and ``[[loads]]``."""
    found: dict[str, Any] = {"gravity": 0.0, "masses": {}}
    if "dynamics" in file:
        table = file.read("dynamics", partial(_read_dynamics, scene=scene))
        found |= {"gravity": GRAVITY} | (table or {})
    return Dynamics(loads=file.read("loads", partial(read_loads, scene=scene)) or (), **found)


def _read_dynamics(node: FileNode, scene: LoadScope) -> dict[str, Any]:
    node.table(_EXAMPLE)
    masses = partial(_read_masses, scene=scene)
    return node.record(Dynamics, gravity=_read_gravity, links=masses)


def _read_gravity(node: FileNode) -> float:
    if node.value is True:
        hint = translate("Omit this key for {}.", GRAVITY)
        node.reject("expected a number in m/s² or false, got the boolean true", hint=hint)
    if node.value is False:
        return 0.0
    return node.number("an acceleration of free fall in m/s²", 0.0, 1e4)


def _read_masses(node: FileNode, scene: LoadScope) -> dict[str, Mass]:
    node.table(_EXAMPLE)
    masses: dict[str, Mass] = {}
    for entry in node.entries():
        link = entry.attempt(partial(_read_carrier, scene=scene))
        mass = entry.attempt(partial(_read_mass, link=link, known=masses, scene=scene))
        if link is not None and mass is not None:
            masses[link.name] = mass
    return masses


def _read_carrier(node: FileNode, scene: LoadScope) -> LinkText:
    """Return the link whose mass a table has."""
    name = str(node.key)
    name = name if name in scene.links else node.unmask(name)
    return scene.find_link(node, name, "have mass")


def _read_mass(
    node: FileNode, link: LinkText | None, known: Collection[str], scene: LoadScope
) -> Mass:
    node.table(_MASS)
    link = needed(link)
    if link.name in known:
        hint = "Keep one of them."
        node.reject("the mass of link {} is given twice", link.name, hint=hint)
    found = node.record(Mass, centre=partial(scene.point_of, link=link))
    node.require_sound()
    if "centre" not in found and len(link.points) == 1:
        found["centre"] = link.points[0]
    elif "centre" not in found and found.get("mass") and link.is_complete:
        hint = (
            "Name the centre of mass among the points of link {} ({}), or give the link "
            "another point there."
        )
        hint = translate(hint, link.name, listed(link.points))
        node["centre"].reject("missing", hint=hint)
    return Mass(**found)


def read_balancing(
    node: FileNode, links: Collection[str], drive: Drive | None, dynamics: Dynamics | None
) -> CounterweightTask:
    """Read ``[balancing]``.

    Parameters
    ----------
    links : collection of str
    drive, dynamics : Drive and Dynamics, or None
        None where the file has none of them, or they could not be read.
    """
    node.table(_BALANCED)
    hint = "Counterweights are on the links of a crank mechanism: give it phi and n."
    require_turning(node, drive, hint, "Give its speed: [driver] n or omega.")
    if dynamics is None or not any(one.mass for one in dynamics.masses.values()):
        node.note("no link has a mass", hint=_MASSES)
    found = node.record(CounterweightTask, radii=partial(_read_radii, links=links))
    if "share" in node and found.get("method", Weighing.FULL) is Weighing.FULL:
        hint = 'Write method = "partial", or omit the share.'
        node["share"].note("everything is fully balanced", hint=hint)
    return node.build(CounterweightTask, found)


def _read_radii(node: FileNode, links: Collection[str]) -> dict[str, float]:
    """Read distances by link, m."""

    def read_radius(radius: FileNode) -> float:
        hint = partial(translate, "There are {}.", listed(links))
        _require_known(radius, str(radius.key), links, "link '{}' does not exist", hint)
        return radius.metres(low=1e-6, high=1e4)

    node.table(_BALANCED)
    return node.read_each(read_radius)


def _require_known(
    node: FileNode, name: str, known: Collection[str], message: str, hint: Callable[[], str]
) -> None:
    """Make sure that there is something of a name; ``hint`` is for one that is near to none."""
    if name not in known:
        node.reject(message, name, hint=nearest_name_hint(name, known, hint()))


def _require_loads(file: FileNode, node: FileNode, message: str) -> None:
    """Make sure that the file has forces for a table."""
    if {"dynamics", "loads", "springs"}.isdisjoint(file.value):
        node.note(message, hint=_MASSES)


def read_balancing_force(
    file: FileNode, links: Mapping[str, LinkText], drive: Drive | None
) -> BalancingForceTask | None:
    """Read ``[balancing_force]``; None where the crank has a fault."""
    node = file["balancing_force"]
    node.table(_PUSHED)
    _require_loads(file, node, "the file has no masses and no loads to balance")
    if drive is None or drive.link not in links:
        return None
    if drive.actuator is not None:
        hint = "Delete the table: a force along the actuator balances its mechanism."
        node.reject("the actuator {} drives", "".join(drive.actuator), hint=hint)
    if drive.motor is not None:
        hint = "Delete the table: the moment of the motor balances its mechanism."
        node.reject(MOTOR_DRIVES, *drive.motor, drive.link, hint=hint)
    if drive.pivot is None:
        hint = "Delete the table: a force along its guide balances a driving slider."
        node.reject("link {} slides and has no turn", drive.link, hint=hint)
    crank, scene = links[drive.link], LoadScope(links, (), drive)

    def read_point(point: FileNode) -> str:
        name = scene.point_of(point, crank)
        if name == drive.pivot:
            others = listed(other for other in crank.points if other != drive.pivot)
            hint = translate("Name another point of link {}: {}.", drive.link, others)
            point.reject("point {} is the axis: there a force has no arm", name, hint=hint)
        return name

    found = node.record(BalancingForceTask, example=_PUSHED, at=read_point)
    return node.build(BalancingForceTask, found)


def read_friction(
    file: FileNode, links: Collection[str], drive: Drive | None, points: Collection[str]
) -> FrictionTask:
    """Read ``[friction]``; ``points`` are all of the mechanism."""
    node = file["friction"]
    node.table(_FRICTION)
    _require_loads(file, node, "the file has no masses and no loads that cause friction")
    if drive is not None and all(one.is_at_rest for one in drive.every):
        ends = "".join(drive.actuator or ())
        hint = translate("Give the driver a speed: friction acts against the motion.")
        message = translate(
            "the driving link does not move, so the direction of friction is undefined"
        )
        if ends:
            hint = translate("For example: driver.v_{} = 0.1. Friction acts against it.", ends)
            message = translate(
                "the actuator {} does not move, so the direction of friction is undefined", ends
            )
        node.note(message, hint=hint)
    pairs = partial(_read_pairs, links=[*links, FRAME], points=points)
    found = node.record(FrictionTask, pairs=pairs)
    if node.is_sound and found.get("f_pin") and "radius" not in found:
        hint = translate("For example: {}", _FRICTION)
        message = "missing: the friction of a pin depends on its radius"
        node["radius"].reject(message, hint=hint)
    return node.build(FrictionTask, found)


def _read_pairs(
    node: FileNode, links: Collection[str], points: Collection[str]
) -> dict[str, PairFriction]:
    """Read the pairs that have friction of their own, by joint and links in order."""

    def read_pair(pair: FileNode) -> tuple[str, PairFriction]:
        joint, one, other = _split_pair(str(pair.key))
        hint = partial(translate, "For example: {}", _PAIR)
        _require_known(pair, joint, points, "point '{}' does not exist", hint)
        for link in (one, other):
            _require_known(pair, link, links, "link '{}' does not exist", hint)
        pair.table(_PAIR)
        friction = pair.build(PairFriction, pair.record(PairFriction))
        return pair_name(joint, one, other), friction

    node.table(_PAIR)
    return dict(node.read_each(read_pair).values())


def _split_pair(name: str) -> tuple[str, str, str]:
    """Return the joint and the links of a pair by its name: ``B 3-0``."""
    joint, _, both = name.partition(" ")
    one, _, other = both.partition("-")
    return joint, one, other


def read_bearings(file: FileNode, turning: Collection[str]) -> dict[str, BearingSection]:
    """Read ``[bearings]``, by joint: a point of the frame about which a link turns."""

    def read_shaft(shaft: FileNode) -> BearingSection:
        _require_known(
            shaft, str(shaft.key), turning, "no link turns about a fixed point '{}'",
            partial(translate, "Shafts are in {}.", listed(turning)),
        )  # fmt: skip
        shaft.table(_BEARINGS)
        found = shaft.record(BearingSection, example=_BEARINGS, at=_read_places)
        return shaft.build(BearingSection, found)

    node = file["bearings"]
    node.table(_BEARINGS)
    found = node.read_each(read_shaft)
    _require_loads(file, node, "the file has no masses and no loads for them to carry")
    return found


def _read_places(node: FileNode) -> tuple[float, float]:
    hint = partial(translate, "For example: {}", _BEARINGS)
    node.array("two distances in metres", hint, low=2, high=2)
    one, two = node.read_all(lambda place: place.metres(low=-1e3, high=1e3))
    if one == two:
        node.reject(
            "both bearings are at the same place",
            hint="The two bearings of a shaft must be at different places.",
        )
    return one, two
