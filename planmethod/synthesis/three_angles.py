"""Four-bar by three pairs of angles of the links on the frame (по трём парам углов).

Freudenstein's equation K1 cos ψ - K2 cos φ + K3 = cos(φ - ψ), K1 = d/a, K2 = d/c, is linear in K1,
K2, K3: three pairs determine them, and with the frame d the crank a. The rest is drawn by inversion
(метод обращения движения): seen from the rocker, the crank's end is on a circle about B1.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from msgspec.structs import replace

from planmethod.errors import AssemblyError
from planmethod.synthesis.model import (
    Board,
    InputError,
    Synthesis,
    choose_option_set,
    lengths_of,
    place,
    read,
)
from planmethod.synthesis.three_positions import passage, synthesis_of

OPTIONS = ("angles", "centres")
SIZES: Mapping[str, str] = {"centres": "OC"}

LENGTHS = ("OA", "AB", "CB", "OC")


def synthesize(options: Mapping[str, Any]) -> Synthesis:
    """Find the four-bar O A B C whose links OA and CB are in three pairs of directions.

    Parameters
    ----------
    options : mapping
        ``angles``: three of (φ of OA, ψ of CB), degrees from OC; ``centres`` OC, m, default: 1.

    Raises
    ------
    InputError, AssemblyError
    """
    choose_option_set(options, "three-angles", "angles", "angles centres")
    rows, frame = options["angles"], options["centres"] or 1.0
    if len(rows) != 3 or any(len(row) != 2 for row in rows):
        raise InputError('--angles needs three pairs a,b, for instance "40,60; 65,75; 90,95".')
    phi, psi = np.radians(np.array(rows, dtype=float)).T
    system = np.column_stack((np.cos(psi), -np.cos(phi), np.ones(3)))
    size = float(np.linalg.cond(system))
    if not size < 1e12:
        raise AssemblyError(
            "The three equations of Freudenstein depend on one another (condition "
            "{:.3g}): two pairs are the same, or all of one angle. Give three different "
            "pairs.",
            size,
        )
    k1, k2, k3 = np.linalg.solve(system, np.cos(phi - psi))
    for name, value in (("OA", k1), ("CB", k2)):
        if abs(value) < 1e-9:
            raise AssemblyError(
                "OC/{0} = {1:.3g}: {0} would be infinite, as for a slider. Give other pairs.",
                name,
                value,
            )
    crank = frame / k1
    b = Board()
    o = b.fixed("O", 0j)
    axis = b.ray(o, None, 0.0)
    c = b.lay_off_length("C", o, axis, b.length("OC", frame))
    arm = b.length("OA", abs(crank))
    found = {"k1": float(k1), "k2": float(k2), "k3": float(k3)}
    b.phrases[arm] = ("freudenstein", {**found, "tail": "O", "head": "A"})
    half_turn = 0.0 if crank > 0.0 else 180.0
    ends = [
        b.lay_off_length(f"A{k}", o, b.ray(o, axis, float(np.degrees(angle)) + half_turn), arm)
        for k, angle in enumerate(phi, 1)
    ]
    turned = [ends[0]]
    for k in (1, 2):
        # CA rotated back about C with the rocker, so that the rocker is as in position 1.
        back = float(np.degrees(psi[0] - psi[k]))
        radius = b.measure(f"C A{k + 1}", c, ends[k])
        ray = b.ray(c, b.join(c, ends[k]), back)
        turned.append(b.lay_off_length(f"A{k + 1}'", c, ray, radius))
    first = b.circle_through("B1", (turned[0], turned[1], turned[2]))
    output = b.measure("C B1", c, first)
    b.length_from("CB", output)
    b.length_from("AB", b.measure("A1 B1", ends[0], first))
    for k in (1, 2):
        turn = float(np.degrees(psi[k] - psi[0]))
        b.lay_off_length(f"B{k + 1}", c, b.ray(c, b.join(c, first), turn), output)
    trace = read(b)
    lengths = lengths_of(trace, LENGTHS)
    if lengths["AB"] <= 1e-9 * frame:
        raise AssemblyError("AB = {:.3g} m: the coupler has no length.", lengths["AB"])
    a_points, b_points = (
        [place(trace, f"{letter}{k}") for k in (1, 2, 3)] for letter in ("A", "B")
    )
    way = passage(0j, complex(frame), a_points, b_points)
    made = synthesis_of(
        "three-angles", b, LENGTHS, way, (("O", "A"), ("C", "B")), (0j, complex(frame))
    )
    # A negative length is laid off backwards: the angle is that of the link produced.
    backwards = [name for name, value in (("OA", k1), ("CB", k2)) if value < 0.0]
    return replace(made, facts={**made.facts, "backwards": backwards})
