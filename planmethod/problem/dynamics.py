"""``[dynamics]`` of a problem file: gravity, masses, centres of mass, moments of inertia."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from planmethod.languages import say
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
from planmethod.problem.forces import Scene, read_loads
from planmethod.problem.links import LinkText
from planmethod.problem.load_records import GRAVITY, Dynamics, Machine, Mass
from planmethod.problem.model import Drive
from planmethod.problem.names import listed, segment
from planmethod.problem.sizes import TURN

_EXAMPLE = '[dynamics.links.2] mass = 40, centre = "S2", inertia = 2'


def read_dynamics(
    faults: Faults,
    given: Mapping[str, Any],
    links: Mapping[str, LinkText],
    fixed: Collection[str],
    drive: Drive | None,
    machine: Machine | None = None,
) -> Dynamics | None:
    """Read ``[dynamics]`` and ``[[loads]]``.

    Parameters
    ----------
    given : mapping
        The whole file.
    fixed : collection of str
        Points of the frame.
    drive : Drive or None
        None when it could not be read: then nothing is asked of it.
    machine : Machine or None
        After whose cycle tables over phi repeat.

    Returns
    -------
    Dynamics or None
        None when the file has neither.
    """
    if "dynamics" not in given and "loads" not in given:
        return None
    scene = Scene(links, fixed, drive, TURN if machine is None else machine.cycle_deg)
    gravity, masses, resultant = 0.0, {}, False
    if "dynamics" in given:
        table = fields.read_table(faults, "dynamics", given["dynamics"], _EXAMPLE)
        known = fields.read_keys(faults, "dynamics", table or {}, keys.DYNAMICS)
        gravity = _read_gravity(faults, known.get("gravity", GRAVITY))
        masses = _read_masses(faults, known.get("links", {}), scene)
        asked = fields.read_flag(faults, "dynamics.resultant", known.get("resultant", False))
        resultant = bool(asked)
    return Dynamics(gravity, masses, read_loads(faults, given.get("loads", []), scene), resultant)


def _read_gravity(faults: Faults, value: object) -> float:
    path = "dynamics.gravity"
    if value is False:
        return 0.0
    if value is True:
        faults.add(
            path,
            "expected a number in m/s² or false, got the boolean true",
            say("Leave it out for {}.", GRAVITY),
        )
        return 0.0
    what = "an acceleration of free fall in m/s²"
    return fields.read_number(faults, path, value, what, low=0.0, high=1e4) or 0.0


def _read_masses(faults: Faults, table: object, scene: Scene) -> dict[str, Mass]:
    path = "dynamics.links"
    masses: dict[str, Mass] = {}
    for key, value in (fields.read_table(faults, path, table, _EXAMPLE) or {}).items():
        where = f"{path}.{segment(key)}"
        link = scene.find_link(faults, where, key, "have mass")
        body = fields.read_table(faults, where, value, 'mass = 40, centre = "S2", inertia = 2')
        if link is None or body is None:
            continue
        if link.name in masses:
            faults.add(
                where, say("the mass of link {} is given twice", link.name), "Keep one of them."
            )
            continue
        mass = _read_mass(faults, where, body, link, scene)
        if mass is not None:
            masses[link.name] = mass
    return masses


def _read_mass(faults: Faults, path: str, body: Table, link: LinkText, scene: Scene) -> Mass | None:
    before = len(faults)
    given = fields.read_keys(faults, path, body, keys.MASS)
    whole = len(faults) == before
    mass = _read_amount(faults, f"{path}.mass", given.get("mass", 0.0), "a mass in kg")
    inertia = _read_amount(
        faults, f"{path}.inertia", given.get("inertia", 0.0), "a moment of inertia in kg·m²"
    )
    centre = None
    if "centre" in given:
        centre = scene.find_point(faults, f"{path}.centre", given["centre"], link)
    elif len(link.points) == 1:
        centre = link.points[0]
    elif mass and whole and link.whole:
        faults.add(
            f"{path}.centre",
            "missing",
            say(
                "Name the centre of mass among the points of link {} ({}), or give the link "
                "another point there.",
                link.name,
                listed(link.points),
            ),
        )
    if len(faults) != before or mass is None or inertia is None:
        return None
    return Mass(mass, centre, inertia)


def _read_amount(faults: Faults, path: str, value: object, what: str) -> float | None:
    if fields.is_number(value) and value < 0:
        faults.add(path, say("expected {}, 0 or greater, got {:g}", what, value))
        return None
    return fields.read_number(faults, path, value, what, low=0.0, high=1e12)
