"""Springs and dampers drawn on a scheme (пружины и демпферы на схеме)."""

# no messages: tags of items

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.forces.springs import spring_letters
from planmethod.problem.model import Problem
from planmethod.problem.records import Spring
from planmethod.render.ink.drawing import Item
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.symbols.marks import unit
from planmethod.render.symbols.springs import (
    WIDTH,
    damper,
    spring,
    spring_and_damper,
    torsion_damper,
    torsion_spring,
)
from planmethod.solved.solution import Solution


class Scheme(Protocol):
    """What springs need of the scheme that they are drawn on."""

    solution: Solution
    letter_height: float

    @property
    def factor(self) -> float:
        """Size of the symbols."""
        ...

    def at(self, point: str) -> complex:
        """Return the place of a point on the paper, mm."""
        ...

    def axis(self, link: str) -> complex:
        """Return the direction of a link's own axis, a unit vector."""
        ...

    def clearance(self, place: complex) -> float:
        """Return the distance of a place from the nearest link, mm."""
        ...

    def free_direction(self, place: complex) -> complex:
        """Return the direction of a pivot's support."""
        ...


def springs_in(problem: Problem) -> tuple[Spring, ...]:
    """Return the springs of a problem."""
    return () if problem.dynamics is None else problem.dynamics.springs


def fixed_end(problem: Problem, one: Spring) -> complex | None:
    """Return the place of the end of a straight spring on the frame, m; None without one."""
    if one.is_torsion or FRAME not in one.links:
        return None
    point = one.points[one.links.index(FRAME)]
    return point if isinstance(point, complex) else problem.bodies[FRAME].points[point]


def on_paper(solution: Solution, place: complex) -> complex:
    """Return a place of the frame, m, on the paper, mm."""
    return complex((place - solution.construction.draft.origin) / solution.per_mm["mu_l"])


def anchors(solution: Solution) -> dict[complex, str]:
    """Return the places, mm, where the frame holds springs and no link, and their letters."""
    problem = solution.problem
    joints, fixed = problem.mechanism.revolutes, problem.bodies[FRAME].points
    pivots = {fixed[joint.point] for joint in joints if joint.links[0] == FRAME}
    places = (fixed_end(problem, one) for one in springs_in(problem))
    letters = {place: name for name, place in fixed.items()}
    return {
        on_paper(solution, place): letters.get(place, "")
        for place in places
        if place is not None and place not in pivots
    }


def spring_ends(scheme: Scheme, one: Spring) -> tuple[complex, complex]:
    """Return the ends of a straight spring on the paper, mm."""
    fixed = fixed_end(scheme.solution.problem, one)
    first, second = (
        on_paper(scheme.solution, fixed)
        if link == FRAME and fixed is not None
        else scheme.at(str(point))
        for link, point in zip(one.links, one.points, strict=True)
    )
    return first, second


def straight_items(
    one: Spring, start: complex, end: complex, factor: float, tag: str, middle: float = 0.5
) -> list[Item]:
    """Return the symbol of a straight spring or damper between two places, mm.

    ``middle`` is the part of the way where its coils are.
    """
    if abs(end - start) < WIDTH * factor:
        return []
    elastic = one.stiffness or one.preload is not None
    draw = spring if not one.damping else spring_and_damper if elastic else damper
    return draw(start, end, factor=factor, tag=tag, middle=middle)


_MIDDLES = (0.5, 0.4, 0.6, 0.33, 0.67)
"""Places of the coils, parts of the length, the best first."""


def _middle(scheme: Scheme, start: complex, end: complex) -> float:
    """Return the part of a spring's length at which its coils are free of links and pivots."""
    joints = [scheme.at(joint.point) for joint in scheme.solution.problem.mechanism.revolutes]

    def clearance(part: float) -> float:
        places = [start + (end - start) * (part + off) for off in (-0.1, 0.0, 0.1)]
        near = min(abs(place - joint) for place in places for joint in joints)
        links = min(scheme.clearance(place) for place in places)
        return min(near - _PIVOT, links, _CLEARANCE * scheme.factor)

    return max(_MIDDLES, key=lambda part: (clearance(part), -abs(part - 0.5)))


_CLEARANCE = WIDTH
"""Distance of coils from links that is enough, mm."""

_PIVOT = 4.0
"""Reach of a joint and its support, mm."""


def spring_items(scheme: Scheme, one: Spring, number: int) -> list[Item]:
    """Return the symbol of a spring in the position of a scheme."""
    tag, factor = f"spring {number}", scheme.factor
    if not one.is_torsion:
        start, end = spring_ends(scheme, one)
        return straight_items(one, start, end, factor, tag, _middle(scheme, start, end))
    at, (first, second) = scheme.at(str(one.joint)), (_leaving(scheme, one, k) for k in range(2))
    if not one.stiffness and one.preload is None:
        return torsion_damper(at, factor=factor, tag=tag)
    return torsion_spring(at, first, second, factor=factor, tag=tag)


def _leaving(scheme: Scheme, one: Spring, number: int) -> complex:
    """Return the direction of a link of a torsion spring from the joint, a unit vector."""
    link, at = one.links[number], scheme.at(str(one.joint))
    if link == FRAME:
        return scheme.free_direction(at)
    places = [scheme.at(point) for point in scheme.solution.problem.bodies[link].points]
    far = max(places, key=lambda place: abs(place - at))
    return unit(far - at) if abs(far - at) > 0.5 else scheme.axis(link)


def spring_labels(scheme: Scheme) -> Iterator[Label]:
    """Yield the letters of the springs: of their stiffness, or of the damping alone."""
    problem = scheme.solution.problem
    for number, one in enumerate(springs_in(problem), 1):
        stiffness, _, damping, _ = spring_letters(problem, one)
        letter = damping if one.damping and not one.stiffness else stiffness
        text = typeset(letter, scheme.letter_height)
        if one.is_torsion:
            at, gap, way = scheme.at(str(one.joint)), 8.0 * scheme.factor, 1 + 1j
        else:
            start, end = spring_ends(scheme, one)
            at = start + (end - start) * _middle(scheme, start, end)
            gap, way = WIDTH * scheme.factor, 1j * unit(end - start)
        yield Label(text, at, prefer=way, gap=gap, priority=2, name=f"spring {number}")
