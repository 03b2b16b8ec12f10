"""Data that can be read but are probably not meant: told as warnings (сомнительные данные)."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

from planmethod.mechanism.model import FRAME
from planmethod.problem.bodies import rotation
from planmethod.problem.model import Problem

LONGEST, SHORTEST = 20.0, 0.0005
"""Lengths of links beyond which metres are hardly meant, m."""

FASTEST = 10_000.0
"""Speed of a crank beyond which 1/s or rev/min is hardly meant, rev/min."""


def unlikely(problem: Problem) -> Iterator[str]:
    """Yield what is probably not meant in a problem, with its numbers and what may be meant."""
    lengths = [(link, key, value) for link, key, value in problem.lengths if value > 0]
    longest = max(lengths, key=lambda one: one[2], default=None)
    if longest is not None and longest[2] > LONGEST:
        link, key, value = longest
        yield (
            f"links.{link}.{key} = {value:g} m. Lengths are in metres: are {value:g} mm meant, "
            f"{value / 1000:g} m?"
        )
    elif longest is not None and longest[2] < SHORTEST:
        link, key, value = longest
        yield f"links.{link}.{key} = {value:g} m is the longest link. Lengths are in metres."
    drive = problem.drive
    speed = abs(drive.rate) * 30 / pi
    if drive.is_crank and speed > FASTEST:
        yield (
            f"the crank makes {speed:.0f} rev/min (omega = {drive.rate:g} 1/s). "
            "Give rev/min as n, 1/s as omega."
        )
    yield from _short_rods(problem)


def _short_rods(problem: Problem) -> Iterator[str]:
    """Yield rods of slider-cranks that are shorter than the eccentricity of their guide."""
    drive, fixed = problem.drive, problem.bodies[FRAME].points
    if drive.pivot is None:
        return
    crank = problem.bodies[drive.link].points.keys() - fixed.keys()
    for slide in problem.slides.values():
        if slide.host != FRAME:
            continue
        way = (fixed[drive.pivot] - slide.base) * rotation(slide.angle).conjugate()
        off = abs(way.imag - slide.offset)
        for link, body in problem.bodies.items():
            pins = crank & body.points.keys()
            if link in (FRAME, drive.link) or slide.pin not in body.points or not pins:
                continue
            pin = min(pins)
            rod = abs(body.points[slide.pin] - body.points[pin])
            if rod < off:
                yield (
                    f"the rod {pin}{slide.pin} ({rod:g} m) is shorter than the eccentricity of "
                    f"the guide of {slide.pin} ({off:g} m): the crank cannot turn fully."
                )
