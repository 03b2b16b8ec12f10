"""Extreme positions on the scheme (крайние положения): their construction, stroke and swing."""

from __future__ import annotations

from math import radians

import numpy as np

from planmethod.note.narrate.cycle import radius_names
from planmethod.plans.draft import cis
from planmethod.render.ink.drawing import Arc, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.pictures.paths import Paths
from planmethod.render.pictures.senses import ends_of, nearness
from planmethod.render.symbols import angle_dimension, dimension
from planmethod.solved.turn.construction import PRIMES, ExtremesConstruction, Locus

EXTREME = "extreme position"
"""Tag of the lines of its construction."""

STROKE = "stroke"
"""Tag of the dimension of the stroke or the swing."""

_NOTCH = 7.0  # mm of an arc to both sides of the line that it cuts
_RIGHT = 2.5  # mm: sides of the sign of a right angle
_LEVELS = np.arange(12.0, 60.0, 3.0)  # mm from the guide to the dimension of the stroke
_CLEAR = 2.5  # mm: a closer dimension line crowds a line of the scheme


def construction_items(
    construction: ExtremesConstruction, height: float
) -> tuple[list[Item], list[Label]]:
    """Return thin lines and the names of the radii, mm of the scheme.

    The links drawn in these positions are the radii and tangents themselves.
    """
    items: list[Item] = []
    labels: list[Label] = []
    pivot = construction.place(construction.pivot)
    crank, total, less = radius_names(construction)
    for k, prime in enumerate(PRIMES):
        pin, end = (
            construction.place(f"{construction.pin}{prime}"),
            construction.place(f"{construction.end}{prime}"),
        )
        if construction.locus is Locus.TANGENTS:
            centre = construction.place(construction.centre)
            along, inward = ((p - pin) / abs(p - pin) for p in (centre, pivot))
            corner = (along * _RIGHT, (along + inward) * _RIGHT, inward * _RIGHT)
            items.append(Stroke(tuple(pin + one for one in corner), Pen.THIN, tag=EXTREME))
            name, ends = crank, (pivot, pin)
        else:
            radius, turn = abs(end - pivot), float(np.angle(end - pivot))
            half = min(_NOTCH / radius, radians(30.0))
            items.append(Arc(pivot, radius, turn - half, turn + half, Pen.THIN, EXTREME))
            name = total if construction.sum_arcs[k] else less
            ends = (pivot + 0.25 * (end - pivot), end)
        if k and construction.locus is Locus.TANGENTS:
            continue  # both radii are the crank's
        labels.append(
            Label(typeset(name, height), sum(ends) / 2, segment=ends, gap=0.8,
                  prefer=1j * (ends[1] - ends[0]), name=f"{EXTREME} {k}", style=BUSY)
        )  # fmt: skip
    return items, labels


def stroke_items(
    paths: Paths, ends: tuple[complex, complex], lines: list[Item], height: float
) -> tuple[list[Item], list[Label]]:
    """Return the dimension of the output's stroke H or swing ψ, and its letter.

    ``ends`` are its point in the extreme positions, mm of the scheme; the dimension is placed where
    it crosses the fewest lines.
    """
    output = paths.output
    assert output is not None
    link, point = output
    slide = next((s for s in paths.solution.problem.slides.values() if s.slider == link), None)
    there = ends_of(lines)
    steps = np.linspace(0.0, 1.0, 15)
    if slide is not None:
        outs = np.concatenate([_LEVELS, -_LEVELS]) * 1j * cis(slide.angle)
        places = ends[0] + (ends[1] - ends[0]) * steps + outs[:, None]
        costs = nearness(places, there, _CLEAR).sum(axis=1) + 0.05 * np.abs(outs)
        out = complex(outs[int(np.argmin(costs))])
        along = (ends[0] + out, ends[1] + out)
        label = Label(typeset("H", height), sum(along) / 2, along, out, gap=0.8, priority=3,
                      name=f"{STROKE} H", style=BUSY)  # fmt: skip
        return dimension(*ends, out, tag=STROKE), [label]
    centre = paths.pivot(point)
    assert centre is not None
    turns = np.unwrap(np.angle(paths.of(point) - centre))
    low, high = float(turns.min()), float(turns.max())
    radii = np.linspace(0.3, 0.75, 10) * abs(ends[0] - centre)
    places = centre + radii[:, None] * np.exp(1j * (low + (high - low) * steps))
    best = float(radii[int(np.argmin(nearness(places, there, _CLEAR).sum(axis=1)))])
    middle = cis(float(np.degrees(low + high)) / 2)
    label = Label(typeset("ψ", height), centre + best * middle, prefer=middle, gap=0.8, priority=3,
                  name=f"{STROKE} ψ", style=BUSY)  # fmt: skip
    return angle_dimension(centre, best, low, high, tag=STROKE), [label]
