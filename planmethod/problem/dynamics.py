"""``[dynamics]``, ``[balancing]``, ``[balancing_force]``, ``[friction]``, ``[bearings]``.

Gravity, masses, moments of inertia; counterweights; what balances a crank; friction of the
pairs; bearings of a shaft.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import partial
from typing import Any

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import fields
from planmethod.problem.fields import Faults, Table
from planmethod.problem.flat_tables import CustomReader, read_flat
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
from planmethod.problem.machine_records import CounterweightTask, Machine, Weighing
from planmethod.problem.model import Drive
from planmethod.problem.names import listed, nearest_name_hint, pair_name, segment
from planmethod.problem.sizes import TURN

_EXAMPLE = '[dynamics.links.2] mass = 40, centre = "S2", inertia = 2'


def read_dynamics(
    faults: Faults,
    document: Mapping[str, Any],
    links: Mapping[str, LinkText],
    fixed: Collection[str],
    drive: Drive | None,
    machine: Machine | None = None,
) -> Dynamics | None:
    """Read ``[dynamics]`` and ``[[loads]]``.

    Parameters
    ----------
    document : mapping
        The whole file.
    fixed : collection of str
        Points of the frame.
    drive : Drive or None
        None when it could not be read: then it is not checked.
    machine : Machine or None
        Its cycle is the period of tables over phi.

    Returns
    -------
    Dynamics or None
        None when the file has neither.
    """
    if "dynamics" not in document and "loads" not in document:
        return None
    scene = LoadScope(links, fixed, drive, TURN if machine is None else machine.cycle_deg)
    found: dict[str, Any] = {"gravity": 0.0, "masses": {}}
    if "dynamics" in document:
        table = fields.read_table(faults, "dynamics", document["dynamics"], _EXAMPLE)
        own: dict[str, CustomReader] = {
            "gravity": _read_gravity,
            "links": partial(_read_masses, scene=scene),
        }
        found |= {"gravity": GRAVITY} | read_flat(faults, "dynamics", table or {}, Dynamics, own)
    return Dynamics(loads=read_loads(faults, document.get("loads", []), scene), **found)


def _read_gravity(faults: Faults, path: str, value: object) -> float:
    if value is False:
        return 0.0
    if value is True:
        faults.add(
            path,
            "expected a number in m/s² or false, got the boolean true",
            translate("Leave it out for {}.", GRAVITY),
        )
        return 0.0
    what = "an acceleration of free fall in m/s²"
    return fields.read_number(faults, path, value, what, low=0.0, high=1e4) or 0.0


def _read_masses(faults: Faults, path: str, table: object, scene: LoadScope) -> dict[str, Mass]:
    masses: dict[str, Mass] = {}
    for key, value in (fields.read_table(faults, path, table, _EXAMPLE) or {}).items():
        where = f"{path}.{segment(key)}"
        link = scene.find_link(faults, where, key, "have mass")
        body = fields.read_table(faults, where, value, 'mass = 40, centre = "S2", inertia = 2')
        if link is None or body is None:
            continue
        if link.name in masses:
            faults.add(
                where,
                translate("the mass of link {} is given twice", link.name),
                "Keep one of them.",
            )
            continue
        mass = _read_mass(faults, where, body, link, scene)
        if mass is not None:
            masses[link.name] = mass
    return masses


def _read_mass(
    faults: Faults, path: str, body: Table, link: LinkText, scene: LoadScope
) -> Mass | None:
    before = len(faults)
    own = {"centre": partial(scene.find_point, link=link)}
    found = read_flat(faults, path, body, Mass, own)
    if len(faults) == before and "centre" not in found:
        if len(link.points) == 1:
            found["centre"] = link.points[0]
        elif found.get("mass") and link.is_complete:
            hint = translate(
                "Name the centre of mass among the points of link {} ({}), or give the link "
                "another point there.",
                link.name,
                listed(link.points),
            )
            faults.add(f"{path}.centre", "missing", hint)
    return None if len(faults) != before else Mass(**found)


_BALANCED = '[balancing] method = "full", radii = { 1 = 0.1, 3 = 0.08 }'


def read_balancing(
    faults: Faults,
    document: Mapping[str, Any],
    links: Collection[str],
    drive: Drive | None,
    dynamics: Dynamics | None,
) -> CounterweightTask | None:
    """Read ``[balancing]``; None after noting a fault.

    Parameters
    ----------
    document : mapping
        The whole file.
    links : collection of str
    drive, dynamics : Drive and Dynamics, or None
        None where the file has none of them, or they could not be read.
    """
    before = len(faults)
    table = fields.read_table(faults, "balancing", document["balancing"], _BALANCED)
    if table is None:
        return None
    hint = "Counterweights are on the links of a crank mechanism: give it phi and n."
    fields.require_turning(faults, "balancing", drive, hint, "Give its speed: [driver] n or omega.")
    if dynamics is None or not any(one.mass for one in dynamics.masses.values()):
        hint = 'Give them: [dynamics.links.2] mass = 3, centre = "S2".'
        faults.add("balancing", "no link has a mass", hint)
    found = read_flat(
        faults, "balancing", table, CounterweightTask, {"radii": partial(_read_radii, links=links)}
    )
    if "share" in table and found.get("method", Weighing.FULL) is Weighing.FULL:
        hint = 'Say method = "partial", or leave the share out.'
        faults.add("balancing.share", "everything is balanced in full", hint)
    return None if len(faults) != before else CounterweightTask(**found)


def _read_radii(
    faults: Faults, path: str, value: object, links: Collection[str]
) -> dict[str, float]:
    """Read distances by link, m."""
    radii: dict[str, float] = {}
    for link, distance in (fields.read_table(faults, path, value, _BALANCED) or {}).items():
        where = f"{path}.{segment(link)}"
        if link not in links:
            hint = nearest_name_hint(link, links, translate("There are {}.", listed(list(links))))
            faults.add(where, translate("link '{}' does not exist", link), hint)
            continue
        found = fields.read_metres(faults, where, distance, low=1e-6, high=1e4)
        if found is not None:
            radii[link] = found
    return radii


_PUSHED = '[balancing_force] at = "A"'


def read_balancing_force(
    faults: Faults, document: Mapping[str, Any], links: Mapping[str, LinkText], drive: Drive | None
) -> BalancingForceTask | None:
    """Read ``[balancing_force]``; None after noting a fault.

    Parameters
    ----------
    document : mapping
        The whole file.
    """
    path, before = "balancing_force", len(faults)
    table = fields.read_table(faults, path, document[path], _PUSHED)
    if table is None:
        return None
    if "dynamics" not in document and "loads" not in document:
        faults.add(path, "there are neither masses nor loads that it could balance", _MASSES)
    if drive is None or drive.link not in links:
        return None
    if drive.actuator is not None:
        hint = "Delete the table: what balances an actuator's mechanism is the force along it."
        faults.add(path, translate("the actuator {} drives", "".join(drive.actuator)), hint)
        return None
    if drive.pivot is None:
        hint = "Delete the table: what balances a driving slider is a force along its guide."
        faults.add(path, translate("link {} slides and has no turn", drive.link), hint)
        return None
    crank = links[drive.link]
    others = [point for point in crank.points if point != drive.pivot]

    def point(faults: Faults, path: str, value: object) -> str | None:
        name = LoadScope(links, (), drive).find_point(faults, path, value, crank)
        if name == drive.pivot:
            hint = translate("Name another point of link {}: {}.", drive.link, listed(others))
            faults.add(
                path, translate("point {} is the axis: there a force has no arm", name), hint
            )
        return name

    found = read_flat(faults, path, table, BalancingForceTask, {"at": point}, example=_PUSHED)
    return None if len(faults) != before else BalancingForceTask(**found)


_MASSES = 'Give them: [dynamics.links.2] mass = 3, centre = "S2".'
_FRICTION = "[friction] f = 0.1, f_pin = 0.1, radius = 0.01"


def read_friction(
    faults: Faults,
    document: Mapping[str, Any],
    links: Collection[str],
    drive: Drive | None,
    points: Collection[str],
) -> FrictionTask | None:
    """Read ``[friction]``; None after noting a fault.

    Parameters
    ----------
    document : mapping
        The whole file.
    points : collection of str
        Every point of the mechanism.
    """
    path, before = "friction", len(faults)
    table = fields.read_table(faults, path, document[path], _FRICTION)
    if table is None:
        return None
    if "dynamics" not in document and "loads" not in document:
        faults.add(path, "there are neither masses nor loads that could press", _MASSES)
    if drive is not None and drive.is_at_rest:
        hint = "Give the driver a speed: friction acts against the motion."
        faults.add(path, "the driver stands, so friction has no sense", hint)
    own = {"pairs": partial(_read_pairs, links=[*links, FRAME], points=points)}
    found = read_flat(faults, path, table, FrictionTask, own)
    if len(faults) == before and found.get("f_pin") and "radius" not in found:
        hint = translate("For example: {}", _FRICTION)
        faults.add(f"{path}.radius", "missing: the friction of a pin goes with its radius", hint)
    return None if len(faults) != before else FrictionTask(**found)


def _read_pairs(
    faults: Faults, path: str, value: object, links: Collection[str], points: Collection[str]
) -> dict[str, PairFriction]:
    """Read the pairs that have friction of their own, by joint and links in order."""
    pairs: dict[str, PairFriction] = {}
    example = 'friction.pairs."B 3-0" = { f = 0.2 }'
    for name, body in (fields.read_table(faults, path, value, example) or {}).items():
        where = f"{path}.{segment(name)}"
        joint, _, both = name.partition(" ")
        one, _, other = both.partition("-")
        for known, wanted, message in (
            (points, joint, "point '{}' does not exist"),
            (links, one, "link '{}' does not exist"),
            (links, other, "link '{}' does not exist"),
        ):
            if wanted not in known:
                hint = nearest_name_hint(wanted, known, translate("For example: {}", example))
                faults.add(where, translate(message, wanted), hint)
                break
        else:
            table = fields.read_table(faults, where, body, example)
            if table is not None:
                pairs[pair_name(joint, one, other)] = PairFriction(
                    **read_flat(faults, where, table, PairFriction)
                )
    return pairs


_BEARINGS = "[bearings.O] at = [-0.04, 0.06]"


def read_bearings(
    faults: Faults, document: Mapping[str, Any], turning: Collection[str]
) -> dict[str, BearingSection]:
    """Read ``[bearings]``, by joint.

    Parameters
    ----------
    document : mapping
        The whole file.
    turning : collection of str
        Points of the frame about which a link turns.
    """
    found: dict[str, BearingSection] = {}
    shafts = fields.read_table(faults, "bearings", document["bearings"], _BEARINGS)
    for joint, body in (shafts or {}).items():
        where = f"bearings.{segment(joint)}"
        if joint not in turning:
            hint = nearest_name_hint(
                joint, turning, translate("Shafts are in {}.", listed(list(turning)))
            )
            faults.add(where, translate("no link turns about a fixed point '{}'", joint), hint)
            continue
        table = fields.read_table(faults, where, body, _BEARINGS)
        before = len(faults)
        own = {"at": _read_places}
        read = read_flat(faults, where, table or {}, BearingSection, own, example=_BEARINGS)
        if table is not None and len(faults) == before:
            found[joint] = BearingSection(**read)
    if "dynamics" not in document and "loads" not in document:
        faults.add("bearings", "there are neither masses nor loads that they could carry", _MASSES)
    return found


def _read_places(faults: Faults, path: str, value: object) -> tuple[float, float] | None:
    if not isinstance(value, list) or len(value) != 2:
        faults.expected(
            path, "two distances in metres", value, translate("For example: {}", _BEARINGS)
        )
        return None
    one, two = (
        fields.read_metres(faults, f"{path}[{k}]", each, low=-1e3, high=1e3)
        for k, each in enumerate(value)
    )
    if one is None or two is None:
        return None
    if one == two:
        faults.add(path, "both bearings are at one place", "Two bearings hold a shaft apart.")
        return None
    return one, two
