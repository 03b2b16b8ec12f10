"""``[balancing]`` of a problem file: static balancing by counterweights (уравновешивание)."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from planmethod.languages import say
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults
from planmethod.problem.load_records import CounterweightTask, Dynamics, Weighing
from planmethod.problem.model import Drive
from planmethod.problem.names import listed, near_hint, segment

_EXAMPLE = '[balancing] method = "full", radii = { 1 = 0.1, 3 = 0.08 }'


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
    table = fields.read_table(faults, "balancing", given["balancing"], _EXAMPLE)
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
        fields.read_table(faults, path, body.get("radii", {}), _EXAMPLE) or {}
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
