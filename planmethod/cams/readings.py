"""Ruler readings of a construction beside the exact values (снятые величины)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Any

import numpy as np
from msgspec import Struct

from planmethod.cams.construction import CamConstruction
from planmethod.cams.model import Contact
from planmethod.cams.text import MM
from planmethod.construct.drafting import Profile
from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import NumberName
from planmethod.note.compared import ComparedNumber
from planmethod.note.document import Table, table_of
from planmethod.note.formula import Rich
from planmethod.note.rounding import sigma_text
from planmethod.note.wording import Language

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

    def compare_sizes(self) -> Iterator[tuple[str, ComparedNumber]]:
        """Yield the sizes read off the region beside the exact ones, mm."""
        geometry = self.built.design.geometry
        exact = {
            "r_min": geometry.r_min, "e": geometry.e, "centre_distance": geometry.centre,
        }  # fmt: skip
        for name, of in self.built.results.items():
            yield name, ComparedNumber(MM * exact[name], MM * self.number(of), MM * self.sigma[of])

    def table(self) -> Table:
        """Return the sizes read off the region beside the exact ones, mm."""
        notation, rows, symbols = self.language.notation, [], dict(SYMBOLS)
        if self.built.design.problem.contact is Contact.FLAT:
            symbols["r_min"] = "r_{0}"
        for name, one in self.compare_sizes():
            read, sigma = notation.number(one.read_text), notation.number(one.sigma_text)
            rows.append((symbols[name], notation.computed(one.exact), read, sigma))
        return table_of(self.language.cam["region_heads"], rows)

    def off(self, trace: Trace) -> float:
        """Return the maximum deviation of a reading's profile from the exact one, mm of the cam."""
        places = [
            np.ravel(trace.value[NumberName(f"B_{{{node.number}}}")])[0]
            for node in self.built.nodes
        ]
        most = np.max(np.abs(np.array(places) - self.built.exact_points()))
        return float(most * self.built.scales.profile * MM)

    @property
    def _widest(self) -> float:
        """The greatest drafting error of a radius, mm of the drawing."""
        return max(self.sigma[f"R_{{{node.number}}}"] for node in self.built.nodes)

    def deviation(self) -> Rich:
        """Return the text on the deviation of the drawn profile from the exact one."""
        notation = self.language.notation
        return self.language.cam.deviation.format(
            most=notation.number(f"{self.off(self.ruled):.2f}"),
            method=notation.number(f"{self.off(self.built.exact):.2f}"),
            sigma=notation.number(sigma_text(MM * self.built.scales.profile * self._widest)),
        )
