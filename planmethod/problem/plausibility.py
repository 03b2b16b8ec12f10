"""Valid but unlikely data, reported as warnings (сомнительные данные)."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem.model import ANYWHERE, SAME_DEG, Problem
from planmethod.problem.names import format_length
from planmethod.problem.placement import rotation

LONGEST, SHORTEST = 20.0, 0.0005
"""Lengths of links beyond which metres are unlikely, m."""

FASTEST = 10_000.0
"""Speed of a crank beyond which 1/s or rev/min is unlikely, rev/min."""


def unlikely(problem: Problem) -> Iterator[str]:
    """Yield unlikely data of a problem, with the numbers and the likely intention."""
    lengths = [(link, key, value) for link, key, value in problem.lengths if value > 0]
    longest = max(lengths, key=lambda one: one[2], default=None)
    if longest is not None and not SHORTEST <= longest[2] <= LONGEST:
        link, key, value = longest
        text = (
            "{} = {} is the longest link, which is unlikely. The unit of the file's lengths "
            'is at its top: units = "m", "cm", "mm" or "in".'
        )
        yield translate(text, f"links.{link}.{key}", format_length(value, problem.unit))
    drive = problem.drive
    speed = abs(drive.rate) * 30 / pi
    if drive.revolves and speed > FASTEST:
        text = "the crank makes {:.0f} rev/min (omega = {:g} 1/s). Give rev/min as n, 1/s as omega."
        yield translate(text, speed, drive.rate)
    for path, number in problem.vanished.items():
        yield translate("{} = {:g} is read as zero: check its power of ten.", path, number)
    yield from _short_rods(problem)
    yield from _weightless(problem)
    yield from _outranked(problem)


def _weightless(problem: Problem) -> Iterator[str]:
    """Yield warnings of a force analysis with no inertia at all, or with massless listed links."""
    dynamics = problem.dynamics
    if dynamics is None:
        return
    nothing = [link for link, one in dynamics.masses.items() if not one.mass and not one.inertia]
    if len(nothing) == len(dynamics.masses):
        yield translate(
            "no link has a mass or a moment of inertia, so the forces come from the loads "
            "only. Give masses in [dynamics.links.2]."
        )
        return
    for link in nothing:
        text = "dynamics.links.{0}: link {0} has neither a mass nor a moment of inertia."
        yield translate(text, link)


def _outranked(problem: Problem) -> Iterator[str]:
    """Yield a warning of listed driver positions that ``[cycle]`` overrides."""
    listed, numbered = problem.drive.assembly_positions, problem.numbered
    if numbered and problem.drive.posed is None and len(problem.drive.positions) == 1:
        yield from _numberless(problem, problem.drive.positions[0])
        return
    if not numbered or not listed or listed == ANYWHERE:
        return
    apart = [abs((a - b + 180.0) % 360.0 - 180.0) for a, b in zip(listed, numbered, strict=False)]
    if len(listed) == len(numbered) and max(apart) <= SAME_DEG:
        return
    text = (
        "driver.phi lists {} positions from {} to {}, [cycle] numbers {} from {} to {}, and "
        "these are used. Delete phi of [driver], or [cycle]; --phi requests other "
        "positions."
    )
    ends = ([f"{one:.5g}°" for one in (way[0], way[-1])]
            for way in (listed, [*map(problem.display_position, numbered)]))  # fmt: skip
    (one, two), (first, last) = ends
    yield translate(text, len(listed), one, two, len(numbered), first, last)


def _numberless(problem: Problem, position: float) -> Iterator[str]:
    """Yield that a single position of the driver is none of those of ``[cycle]``."""
    apart = [abs((position - one + 180.0) % 360.0 - 180.0) for one in problem.numbered]
    nearest = min(range(len(apart)), key=apart.__getitem__)
    if apart[nearest] <= SAME_DEG:
        return
    text = (
        "driver.phi = {:.5g}° is not one of the {} positions of [cycle]; the nearest is "
        "position {} at {}°. Write phi = {}, or delete phi: then all outputs have the "
        "positions of [cycle]."
    )
    near = f"{problem.display_position(problem.numbered[nearest]):.5g}"
    yield translate(text, position, len(apart), nearest, near, near)


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
                text = (
                    "the rod {0}{1} ({2}) is shorter than the eccentricity of the guide of {1} "
                    "({3}): the crank cannot turn fully."
                )
                lengths = (format_length(length, problem.unit) for length in (rod, off))
                yield translate(text, pin, slide.pin, *lengths)


def names_results(problem: Problem) -> bool:
    """Return whether a number of the file names a result of its synthesis, or equals one."""
    task = problem.synthesis
    if task is None:
        return False
    lengths = [metres for _, _, metres in problem.lengths]
    equal = any(abs(one - two) <= 1e-6 * one for one in lengths for two in task.values.values())
    return equal or any(map(task.is_named_in, problem.stated.values()))
