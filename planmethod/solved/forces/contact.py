"""Position of a guide's reaction, and the forces at the edges of a slider (направляющая).

A prismatic pair has a force F across its guide and a moment M about a joint of the slider. Together
they equal one force at the distance b = M/F from that joint. A slider of length a can exert it only
within a/2 of its middle. Further out the force is the resultant of two opposite forces at the
edges; a moment alone is a couple of them.

Source: the homework guide's section 1, on the forces in lower pairs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.arithmetic import unit_vectors
from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import cis
from planmethod.problem.model import Problem, Slide
from planmethod.solved.reading import Complexes, Reals
from planmethod.solved.solution import Solution

VANISHING = 1e-12
"""Fraction of a position's largest force below which a reaction is negligible."""

Masks = npt.NDArray[np.bool_]


def transverse_component(force: Complexes, direction: Complexes) -> Reals:
    """Return the component of forces to the left of unit vectors along the guide, N."""
    return np.asarray((direction.conjugate() * force).imag, dtype=float)


def distance(normal: Reals, moment: Reals, is_zero: Masks) -> Reals:
    """Return the position of a force along the guide, m; NaN where the force is zero.

    Parameters
    ----------
    normal : ndarray, N
        Force to the left of the guide's direction.
    moment : ndarray, N·m
        Counter-clockwise positive.
    is_zero : ndarray of bool
        True where the force is zero.

    Returns
    -------
    ndarray
        Positive in the guide's direction: there a force to the left turns counter-clockwise.
    """
    divisor = np.where(is_zero, 1.0, normal)
    return np.asarray(np.where(is_zero, np.nan, moment / divisor), dtype=float)


def edge_forces(normal: Reals, moment: Reals, length: float) -> tuple[Reals, Reals]:
    """Return the forces at both edges of a slider, N, to the left of the guide's direction.

    The first is at the edge in the guide's direction; ``moment`` is about the middle, N·m. They
    have the force for their sum and the moment for theirs.
    """
    half = normal / 2.0
    return half + moment / length, half - moment / length


class JointForce(Struct, frozen=True):
    """Reaction in a joint in every position (реакция), N and N·m, ndarrays of shape (n,).

    ``moment`` is about ``at`` (m, in the file's coordinates), counter-clockwise positive; zero in a
    revolute pair.
    """

    joint: str
    on: str
    by: str
    at: Complexes
    force: Complexes
    moment: Reals


class EdgeForce(Struct, frozen=True):
    """Reaction at an edge of a slider in one position: its place, m, and the force, N."""

    at: complex
    force: complex


class SlideReaction(Struct, frozen=True, dict=True):
    """Reaction of one prismatic pair and its slider in every position, ndarrays of shape (n,).

    Attributes
    ----------
    slide : Slide
    joint : JointForce
    direction : Complexes
        Unit vectors in the guide's direction.
    base : Complexes, m
        A point of the guide's line.
    middle : Reals, m
        Middle of the contact, from ``joint.at`` in the guide's direction: the pin of the slider, or
        the joint of the block through which it passes.
    largest : Reals, N
        Size of the largest force of each position.
    """

    slide: Slide
    joint: JointForce
    direction: Complexes
    base: Complexes
    middle: Reals
    largest: Reals

    @property
    def length(self) -> float | None:
        """Length of contact (длина ползуна), m, if it is given."""
        return self.slide.length

    @cached_property
    def normal(self) -> Reals:
        """Force to the left of the guide's direction, N."""
        return transverse_component(self.joint.force, self.direction)

    def b(self, fraction: float = VANISHING) -> Reals:
        """Return where the force acts, m from ``joint.at`` in the guide's direction.

        Not a number where the force is less than a ``fraction`` of the largest.
        """
        nothing = np.abs(self.joint.force) <= fraction * self.largest
        return distance(self.normal, self.joint.moment, nothing)

    def place(self, b: Reals) -> Complexes:
        """Return the places of the guide's line at distances from ``joint.at``, m."""
        foot = ((self.joint.at - self.base) * self.direction.conjugate()).real
        return np.asarray(self.base + self.direction * (foot + b), dtype=complex)

    @cached_property
    def at_edges(self) -> Masks:
        """True where two reactions at the edges act instead of one."""
        if self.length is None:
            return np.zeros(self.normal.shape, dtype=bool)
        moment = np.abs(self._about_middle)
        something = moment > VANISHING * self.largest * self.length
        return np.asarray(something & (moment > np.abs(self.normal) * self.length / 2.0))

    @property
    def _about_middle(self) -> Reals:
        return self.joint.moment - self.middle * self.normal

    def edges(self, index: int) -> tuple[EdgeForce, ...]:
        """Return the reactions at the edges in a position where they act, else none.

        The first is at the edge in the guide's direction.
        """
        if self.length is None or not self.at_edges[index]:
            return ()
        ends = self.place(self.middle + self.length / 2), self.place(self.middle - self.length / 2)
        forces = edge_forces(self.normal, self._about_middle, self.length)
        left = 1j * self.direction[index]
        return tuple(
            EdgeForce(complex(end[index]), complex(left * force[index]))
            for end, force in zip(ends, forces, strict=True)
        )


def contacts(
    solution: Solution, reactions: Sequence[JointForce], largest: Reals
) -> Mapping[int, SlideReaction]:
    """Return the prismatic pairs by the numbers of their reactions.

    Parameters
    ----------
    largest : ndarray of shape (n,), N
        Size of the largest force of each position.
    """
    return {
        number: _contact(solution, slide, joint, largest)
        for number, joint in enumerate(reactions)
        for slide in [slide_between(solution.problem, joint)]
        if slide is not None
    }


def slide_between(problem: Problem, joint: JointForce) -> Slide | None:
    """Return the line on which one link of a joint slides on the other; None for a hinge."""
    for slider, host in ((joint.on, joint.by), (joint.by, joint.on)):
        slide = problem.slides.get(slider)
        if slide is not None and slide.host == host and slide.pin == joint.joint:
            return slide
    return None


def _contact(solution: Solution, slide: Slide, joint: JointForce, largest: Reals) -> SlideReaction:
    along = _directions(solution, slide)
    if slide.through is not None:
        base = solution.place(PointName(slide.through))
    else:
        base = np.full(along.shape, slide.base)
    centre = base if solution.problem.is_block(slide) else solution.place(PointName(slide.pin))
    middle = ((centre - joint.at) * along.conjugate()).real
    return SlideReaction(slide, joint, along, base, middle, largest)


def _directions(solution: Solution, slide: Slide) -> Complexes:
    if slide.host == FRAME:
        return np.full(solution.positions.shape, cis(slide.angle), dtype=complex)
    turned = solution.links[slide.host].phi_deg
    return np.asarray(unit_vectors(turned + slide.angle))
