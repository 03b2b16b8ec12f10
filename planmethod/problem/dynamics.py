"""``[dynamics]`` and ``[balancing]``: gravity, masses, moments of inertia, counterweights."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from planmethod.languages import say
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
from planmethod.problem.forces import Scene, read_loads
from planmethod.problem.links import LinkText
from planmethod.problem.load_records import (
    GRAVITY,
    CounterweightTask,
    Dynamics,
    Machine,
    Mass,
    Weighing,
)
from planmethod.problem.model import Drive
from planmethod.problem.names import listed, near_hint, segment
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


_BALANCED = '[balancing] method = "full", radii = { 1 = 0.1, 3 = 0.08 }'


def read_balancing(
    faults: Faults,
    given: Mapping[str, Any],
    links: Collection[str],
    drive: Drive | None,
    dynamics: Dynamics | None,
) -> CounterweightTask | None:
    """Read ``[balancing]``; None after noting a fault.

    Parameters
    ----------
    given : mapping
        The whole file.
    links : collection of str
    drive, dynamics : Drive and Dynamics, or None
        None where the file has none of them, or they could not be read.
    """
    before = len(faults)
    table = fields.read_table(faults, "balancing", given["balancing"], _BALANCED)
    if table is None:
        return None
    body = fields.read_keys(faults, "balancing", table, keys.BALANCING)
    hint = "Counterweights stand on the links of a crank mechanism: give it phi and n."
    fields.require_turning(faults, "balancing", drive, hint, "Give its speed: [driver] n or omega.")
    if dynamics is None or not any(one.mass for one in dynamics.masses.values()):
        hint = 'Give them: [dynamics.links.2] mass = 3, centre = "S2".'
        faults.add("balancing", "no link has a mass", hint)
    method, share = Weighing.FULL, None
    if "method" in body:
        method = fields.read_member(faults, "balancing.method", body["method"], Weighing) or method
    if "share" in body:
        share = fields.read_number(
            faults, "balancing.share", body["share"], "a share from 0 to 1", low=0.0, high=1.0,
            hint="1/2 takes half of the force along the slide, and puts as much across it.",
        )  # fmt: skip
        if method is Weighing.FULL:
            hint = 'Say method = "partial", or leave the share out.'
            faults.add("balancing.share", "everything is balanced in full", hint)
    radii: dict[str, float] = {}
    path = "balancing.radii"
    for link, value in (
        fields.read_table(faults, path, body.get("radii", {}), _BALANCED) or {}
    ).items():
        where = f"{path}.{segment(link)}"
        if link not in links:
            hint = near_hint(link, links, say("There are {}.", listed(list(links))))
            faults.add(where, say("there is no link '{}'", link), hint)
            continue
        found = fields.read_number(faults, where, value, "a distance in metres", low=1e-6, high=1e4)
        if found is not None:
            radii[link] = found
    return None if len(faults) != before else CounterweightTask(method, share, radii)
