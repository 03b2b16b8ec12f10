"""The construction as it is drawn (чертёж): its scale, the ruler's readings, their errors."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from planmethod.construct.drafting import Profile
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.hand import Hand
from planmethod.construct.scale import choose_scale
from planmethod.construct.steps import (
    Given,
    Join,
    LayOff,
    LineName,
    MeetCircles,
    MeetLineCircle,
    MeetLines,
    NumberName,
    PointName,
    makes,
)
from planmethod.solved.errors.drawing import Drafted, DrawnKind, DrawnQuantity, number
from planmethod.solved.errors.spread import Errors
from planmethod.synthesis.model import Synthesis, place, scaled

BOXES = ((172.0, 200.0), (330.0, 110.0))
"""Boxes that the points of a construction shall fill on A3: standing and lying, mm."""

FAR = 1.2
"""A centre further from the rest than so many of its sizes is left off the sheet."""


@dataclass(frozen=True)
class Drawn:
    """A construction on paper.

    Attributes
    ----------
    synthesis : Synthesis
    profile : Profile
        Who draws it.
    """

    synthesis: Synthesis
    profile: Profile

    @cached_property
    def shown(self) -> tuple[str, ...]:
        """Points that are on the sheet: those of the mechanism, and others not too far off."""
        made, exact = self.synthesis, self.synthesis.exact()
        own = {p for pose in made.poses for link in pose.links for p in link} | {*made.pivots}
        own |= {*made.guide}
        places = np.array([place(exact, p) for p in own])
        middle = complex(places.real.max() + places.real.min(),
                         places.imag.max() + places.imag.min()) / 2  # fmt: skip
        size = float(np.max(np.abs(places - middle)))
        others = [
            str(step.out)
            for step in made.board.steps
            if makes(step) is PointName and not str(step.out).startswith("mark ")
        ]
        near = [p for p in others if p in own or abs(place(exact, p) - middle) <= FAR * size]
        return tuple(near)

    @cached_property
    def mu(self) -> float:
        """Scale, m per mm: of the two boxes the one that gives the larger drawing."""
        places = np.array([place(self.synthesis.exact(), p) for p in self.shown])
        extent = (float(np.ptp(places.real)), float(np.ptp(places.imag)))
        return min(choose_scale(extent, box) for box in BOXES)

    @cached_property
    def paper(self) -> Trace:
        """Exact reading, mm."""
        return self.synthesis.exact(self.mu)

    @cached_property
    def by_hand(self) -> Trace:
        """Reading with the ruler."""
        data = scaled(self.synthesis.board, self.mu)
        return evaluate(self.synthesis.program, data, Hand(ruler=self.profile.ruler))

    @cached_property
    def sigma(self) -> dict[str, float]:
        """Standard deviations of the lengths, m."""
        made = self.synthesis
        names = [NumberName(f"l {name}") for name in made.lengths]
        items = tuple(DrawnQuantity(n, (n,), number(n), DrawnKind.LENGTH) for n in names)
        data: Any = scaled(made.board, self.mu)
        drawing = Drafted(made.program, lambda _: data, 1, self.profile, frozenset(), items)
        spreads = Errors(drawing).spreads
        return {
            name: float(spreads[str(full)].sigma[0])
            for name, full in zip(made.lengths, names, strict=True)
        }

    def read(self, name: str) -> float:
        """Return a length of the mechanism as the ruler has it, m."""
        return float(self.by_hand.value[NumberName(f"l {name}")])

    def on_line(self) -> dict[LineName, list[PointName]]:
        """Return the points that lie on every line that is drawn, and at which it is drawn."""
        found: dict[LineName, list[PointName]] = {}
        for step in self.synthesis.board.steps:
            match step:
                case Join(out, tail, head):
                    found[out] = [tail, head]
                case MeetLines(out, first, second):
                    found[first].append(out)
                    found[second].append(out)
                case MeetLineCircle(out, line) | LayOff(out, _, line):
                    found[line].append(out)
                case Given() | MeetCircles():
                    pass
                case _ if makes(step) is LineName:
                    found[LineName(step.out)] = [step.through]  # type: ignore[union-attr]
                case _:
                    pass
        return found
