"""Ruler readings of a construction beside the exact values (снятые величины)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from msgspec import Struct

from planmethod.cams.construction import CamConstruction
from planmethod.cams.divisions import motion_in_division
from planmethod.cams.model import Contact
from planmethod.cams.text import MM
from planmethod.construct.drafting import Profile
from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import NumberName
from planmethod.note.compared import Series, measured_series
from planmethod.note.document import Table, table_of
from planmethod.note.formula import Rich
from planmethod.note.rounding import sigma_text
from planmethod.note.wording import Language
from planmethod.solved.reading import Reals

SYMBOLS = {"r_min": "r_{min}", "e": "e", "centre_distance": "a"}


class CamReadings(Struct, frozen=True, dict=True):
    """Ruler readings of a construction beside the exact values (снятые величины)."""

    built: CamConstruction
    language: Language
    profile: Profile

    @cached_property
    def ruled(self) -> Trace:
        """The numbers as the ruler gives them."""
        return self.built.ruled(self.profile.ruler)

    @cached_property
    def sigma(self) -> Mapping[str, float]:
        """Drafting errors of the numbers."""
        return self.built.sigma(self.profile)

    def number(self, name: str, *, exact: bool = False) -> float:
        """Return a number of the construction."""
        trace: Any = self.built.exact if exact else self.ruled
        return float(np.ravel(trace.value[NumberName(name)])[0])

    def series(
        self, symbol: Rich, names: Sequence[str], exact: Sequence[float] | Reals, per_mm: float
    ) -> Series:
        """Return numbers of the construction beside the exact ones, mm of the cam.

        ``per_mm``: what a unit of the construction is worth, m.
        """
        read, sigma = (
            [MM * per_mm * value for value in values]
            for values in (map(self.number, names), (self.sigma[name] for name in names))
        )
        return measured_series(symbol, "mm", exact, read, sigma)

    def sizes(self) -> list[Series]:
        """Return the sizes read off the region."""
        design, symbols = self.built.design, dict(SYMBOLS)
        if design.problem.contact is Contact.FLAT:
            symbols["r_min"] = "r_{0}"
        geometry = design.geometry
        exact = {"r_min": geometry.r_min, "e": geometry.e, "centre_distance": geometry.centre}
        return [
            self.series(symbols[name], [of], [MM * exact[name]], 1.0)
            for name, of in self.built.results.items()
        ]

    def path(self) -> Series:
        """Return the follower's motion s in the divisions, read off the diagram."""
        built = self.built
        names = [f"s_{{{node.number}}}" for node in built.nodes]
        exact = [MM * float(motion_in_division(built.design.problem, n)[0]) for n in built.nodes]
        return self.series("s", names, exact, built.scales.s)

    def radii(self) -> Series:
        """Return the radii of the profile in the divisions."""
        names = [f"R_{{{node.number}}}" for node in self.built.nodes]
        per_mm = self.built.scales.profile
        exact = MM * per_mm * np.abs(self.built.exact_points())
        return self.series("R", names, exact, per_mm)

    def table(self) -> Table:
        """Return the sizes read off the region beside the exact ones, mm."""
        numbers = self.language.notation.numbers
        rows = ([one.symbol, *numbers(*one[0].texts)] for one in self.sizes())
        return table_of(self.language.cam["region_heads"], rows)

    def off(self, trace: Trace) -> float:
        """Return the maximum deviation of a reading's profile from the exact one, mm of the cam."""
        places = [
            np.ravel(trace.value[NumberName(f"B_{{{node.number}}}")])[0]
            for node in self.built.nodes
        ]
        most = np.max(np.abs(np.array(places) - self.built.exact_points()))
        return float(most * self.built.scales.profile * MM)

    def deviation(self) -> Rich:
        """Return the text on the deviation of the drawn profile from the exact one."""
        notation = self.language.notation
        return self.language.cam.deviation.format(
            most=notation.number(f"{self.off(self.ruled):.2f}"),
            method=notation.number(f"{self.off(self.built.exact):.2f}"),
            sigma=notation.number(sigma_text(max(self.radii().sigma))),
        )
