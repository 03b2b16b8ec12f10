"""``[dynamics]``, ``[balancing]``, ``[balancing_force]``, ``[friction]``, ``[bearings]``.

Gravity, masses, moments of inertia; counterweights; what balances a crank; friction of the
pairs; bearings of a shaft.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import partial
from typing import Any

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem.drive import require_turning
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.forces import LoadScope, read_loads
from planmethod.problem.links import LinkText
from planmethod.problem.load_records import (
    GRAVITY,
    BalancingForceTask,
    BearingSection,
    Dynamics,
    FrictionTask,
    Mass,
    PairFriction,
)
from planmethod.problem.machine_records import CounterweightTask, Weighing
from planmethod.problem.model import Drive
from planmethod.problem.names import listed, nearest_name_hint, pair_name

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
        hint = translate("Leave it out for {}.", GRAVITY)
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
        hint = 'Say method = "partial", or leave the share out.'
        node["share"].note("everything is balanced in full", hint=hint)
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
    if "dynamics" not in file and "loads" not in file:
        node.note(message, hint=_MASSES)


def read_balancing_force(
    file: FileNode, links: Mapping[str, LinkText], drive: Drive | None
) -> BalancingForceTask | None:
    """Read ``[balancing_force]``; None where the crank has a fault."""
    node = file["balancing_force"]
    node.table(_PUSHED)
    _require_loads(file, node, "there are neither masses nor loads that it could balance")
    if drive is None or drive.link not in links:
        return None
    if drive.actuator is not None:
        hint = "Delete the table: what balances an actuator's mechanism is the force along it."
        node.reject("the actuator {} drives", "".join(drive.actuator), hint=hint)
    if drive.pivot is None:
        hint = "Delete the table: what balances a driving slider is a force along its guide."
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
    _require_loads(file, node, "there are neither masses nor loads that could press")
    if drive is not None and drive.is_at_rest:
        hint = "Give the driver a speed: friction acts against the motion."
        node.note("the driver stands, so friction has no sense", hint=hint)
    pairs = partial(_read_pairs, links=[*links, FRAME], points=points)
    found = node.record(FrictionTask, pairs=pairs)
    if node.is_sound and found.get("f_pin") and "radius" not in found:
        hint = translate("For example: {}", _FRICTION)
        message = "missing: the friction of a pin goes with its radius"
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
    _require_loads(file, node, "there are neither masses nor loads that they could carry")
    return found


def _read_places(node: FileNode) -> tuple[float, float]:
    hint = partial(translate, "For example: {}", _BEARINGS)
    node.array("two distances in metres", hint, low=2, high=2)
    one, two = node.read_all(lambda place: place.metres(low=-1e3, high=1e3))
    if one == two:
        node.reject("both bearings are at one place", hint="Two bearings hold a shaft apart.")
    return one, two
