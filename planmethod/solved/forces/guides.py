"""Reactions of the guides in one position, as read by hand (реакции направляющих)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from msgspec import Struct

from planmethod.plans.forces.board import Reaction
from planmethod.plans.forces.polygons import CoupleOn, reaction_symbol
from planmethod.solved.forces.contact import EdgeForce, SlideReaction
from planmethod.solved.forces.reading import NEGLIGIBLE_FRACTION, ForceReading
from planmethod.solved.reading import memoized


class Guided(Struct, frozen=True, dict=True):
    """Reaction of one link of a prismatic pair on the other, in one position.

    Attributes
    ----------
    reading : ForceReading
    number : int
        Index of the reaction in the force analysis.
    on, by : str
        The link that the force acts on, and the link that exerts it.
    """

    reading: ForceReading
    number: int
    on: str
    by: str

    @property
    def contact(self) -> SlideReaction:
        """The pair in all positions."""
        return self.reading.statics.contacts[self.number]

    @property
    def reaction(self) -> Reaction:
        """The reaction as the force plans have it."""
        return self.reading.statics.board.reactions[self.number]

    @property
    def sense(self) -> int:
        """-1 if the force plans have the opposite reaction."""
        return 1 if self.on == self.reaction.on else -1

    @property
    def as_planned(self) -> Guided:
        """The same reaction as the force plans name it: distances and lengths have its letters."""
        return Guided(self.reading, self.number, self.reaction.on, self.reaction.by)

    def symbol(self, letter: str, primes: str = "") -> str:
        """Return a letter with the numbers of both links: ``l_{50}``, ``F^{'}_{50}``."""
        above = f"^{{{primes}}}" if primes else ""
        called = self.reading.solution.problem.mechanism.called
        return reaction_symbol(called(self.on), called(self.by), letter=letter + above)

    @cached_property
    def b(self) -> float | None:
        """Position of the force, m from the joint along the guide; None if there is no force."""
        if self.is_negligible:
            return None
        return (
            0.0
            if self.is_no_couple
            else float(self.contact.b(NEGLIGIBLE_FRACTION)[self.reading.index])
        )

    @property
    def is_negligible(self) -> bool:
        """True if the force is negligible beside the others."""
        size = abs(complex(self.contact.joint.force[self.reading.index]))
        return size <= NEGLIGIBLE_FRACTION * self.reading.peak

    @property
    def is_no_couple(self) -> bool:
        """True if the moment about the joint is negligible beside the others."""
        moment = abs(float(self.contact.joint.moment[self.reading.index]))
        return moment <= NEGLIGIBLE_FRACTION * self.reading.peak_moment

    @property
    def edges(self) -> tuple[EdgeForce, ...]:
        """Reactions at the edges where they act: ahead in the guide's direction, then behind."""
        edges = self.contact.edges(self.reading.index)
        return tuple(EdgeForce(edge.at, self.sense * edge.force) for edge in edges)

    # As read by hand -------------------------------------------------------------------------

    @property
    def read_force(self) -> float:
        """Size of the force as the ruler has it on the force plan, N."""
        return self.reading.read_size(self.reaction.force.ends)

    @property
    def read_moment(self) -> float:
        """Size of the moment about the joint, N·m."""
        assert self.reaction.couple is not None
        return abs(self.reading.read_number(self.reaction.couple))

    @property
    def is_read(self) -> bool:
        """True if the force is neither negligible nor zero on the paper."""
        return not self.is_negligible and self.read_force > 0

    @property
    def read_distance(self) -> float:
        """Distance of the read force from the joint, m."""
        return self.read_moment / self.read_force

    @property
    def centred(self) -> bool:
        """True if the middle of the contact lies across the guide from the joint."""
        middle = abs(float(self.contact.middle[self.reading.index]))
        return middle <= 1e-9 * (self.contact.length or 1.0)


@memoized
def guides(reading: ForceReading) -> Mapping[str, Guided]:
    """Return the reactions of the guides by the letter of the force, each way: ``F_{50}``."""
    found = {}
    called = reading.solution.problem.mechanism.called
    for number, contact in reading.statics.contacts.items():
        joint = contact.joint
        for on, by in ((joint.on, joint.by), (joint.by, joint.on)):
            found[reaction_symbol(called(on), called(by))] = Guided(reading, number, on, by)
    return found


def guide_of(reading: ForceReading, couple: CoupleOn) -> Guided | None:
    """Return the reaction of a guide whose moment a couple is."""
    matching = (one for one in guides(reading).values() if one.symbol("M") == couple.symbol)
    return next(matching, None)
