"""Numbers of a cam that students answer, and typical mistakes (величины, ошибки)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property, partial
from math import degrees, isfinite
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from planmethod.cams.construction import CamConstruction, construct
from planmethod.cams.design import CamDesign
from planmethod.cams.model import CamPhase, CamProblem, Contact
from planmethod.cams.reader import PLACED, SIZE_NAMES
from planmethod.cams.sheet import sheet_scales
from planmethod.errors import ProblemError
from planmethod.problem.question_quantities import AnswerValue, Mistaken, QuantityReader

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile

SYMBOLS = {
    "r_min": "r_{min}", "e": "e", "centre_distance": "a", "roller": "r_{p}", "theta_max": "ϑ_{max}",
    "theta_max_return": "ϑ_{max}", "rho_min": "ρ_{min}", "s": "s", "v_q": "v_{q}", "a_q": "a_{q}",
    "theta": "ϑ",
}  # fmt: skip
SIGNED = ("e", "v_q", "a_q", "theta")
PER_DEGREE = np.pi / 180
POWERS = {"v_q": 1, "a_q": 2}


class CamQuantities:
    """Quantities of a cam for questions (`QuestionQuantities`)."""

    def __init__(self, problem: CamProblem) -> None:
        self.problem, self.count = problem, problem.count
        self.design = CamDesign(problem)
        self.names = tuple(n for n in (*SIZE_NAMES, *PLACED) if self._of(n, 0) is not None)

    def quantity(self, name: str, position: int) -> AnswerValue | None:
        """Return a quantity by its name in ``[[answers]]``."""
        value = self._of(name, position)
        if value is None:
            return None
        unit = "deg" if name.startswith("theta") else "m"
        return AnswerValue(SYMBOLS[name], unit, value, signed=name in SIGNED)

    def _of(self, name: str, position: int) -> float | None:
        return value_of(self.design, name, position)

    @cached_property
    def built(self) -> CamConstruction:
        """The construction at the scales of the sheet."""
        return construct(self.design, sheet_scales(self.problem))

    def read_off(self, name: str, position: int, profile: Profile) -> tuple[float, float] | None:
        """Return its segment on the drawing, mm, and one sigma of the reading."""
        built, value = self.built, self._of(name, position)
        if value is None:
            return None
        if name in built.results:
            per_mm, of = built.scales.region, str(built.results[name])
            return abs(value) / per_mm, self._sigma(profile)[of]
        if name not in ("s", "v_q"):
            return None
        phi = self.problem.angles()[position]
        node = min(built.nodes, key=lambda one: abs(one.phi - phi))
        per_mm = float(getattr(built.scales, name[0]))
        return abs(value) / per_mm, per_mm * self._sigma(profile)[f"{name[0]}_{{{node.number}}}"]

    def _sigma(self, profile: Profile) -> Mapping[str, float]:
        if profile not in self._sigmas:
            self._sigmas[profile] = self.built.sigma(profile)
        return self._sigmas[profile]

    @cached_property
    def _sigmas(self) -> dict[Profile, Mapping[str, float]]:
        return {}

    def mistaken(self) -> Iterator[Mistaken]:
        """Yield the usual mistakes: limits, dwell, law, sign of e, degrees."""
        one = self.problem
        rise, back = one.allowed
        if back is not None and back != rise:
            yield from self._another_cam("Q1", replace(one, allowed=(back, rise)))
        if one.phases[1] > 0:
            first, upper, second, lower = one.phases
            yield from self._another_cam(
                "Q2", replace(one, phases=(first, 0.0, second, lower + upper))
            )
        if one.laws[0] != one.laws[1]:
            yield from self._another_cam("Q3", replace(one, laws=(one.laws[0], one.laws[0])))
        if not one.oscillates and self.design.pitch_geometry.e and one.contact is not Contact.FLAT:
            given = replace(
                one, r_min=self.design.pitch_geometry.r_min, offset=-self.design.pitch_geometry.e
            )
            yield from self._another_cam("Q4", given)
        yield Mistaken("Q5", "", self._in_degrees)

    def _another_cam(self, code: str, problem: CamProblem) -> Iterator[Mistaken]:
        """Yield a mistake that results in another cam, if that exists."""
        take: QuantityReader = partial(value_of, CamDesign(problem))
        try:
            take("r_min", 0)
        except ProblemError:
            return
        yield Mistaken(code, "", take)

    def _in_degrees(self, name: str, position: int) -> float | None:
        value = self._of(name, position)
        return None if value is None else value * PER_DEGREE ** POWERS.get(name, 0)

    def derive_values(self, name: str, answers: Mapping[str, float]) -> Iterator[tuple[float, str]]:
        """Yield nothing: no number of a cam follows from another one alone."""
        yield from ()


def value_of(design: CamDesign, name: str, position: int) -> float | None:
    """Return a quantity of a cam, m or degrees; None if it is unknown."""
    problem, geometry = design.problem, design.geometry
    if name in PLACED:
        phi = problem.angles()[position : position + 1]
        moved = problem.at(phi)
        if name == "theta":
            flat = problem.contact is Contact.FLAT
            return None if flat else degrees(float(geometry.points(phi, moved).pressure[0]))
        return float(moved[("s", "v_q", "a_q").index(name), 0])
    flat = problem.contact is Contact.FLAT
    phase = CamPhase.RISE if name == "theta_max" else CamPhase.RETURN
    found: dict[str, Callable[[], float | None]] = {
        "r_min": lambda: geometry.r_min,
        "e": lambda: None if problem.oscillates or flat else geometry.e,
        "centre_distance": lambda: geometry.centre or None,
        "roller": lambda: geometry.roller or None,
        "rho_min": lambda: design.rho_min.value if isfinite(design.rho_min.value) else None,
        "theta_max": lambda: None if flat else degrees(design.pressure(phase).value),
        "theta_max_return": lambda: None if flat else degrees(design.pressure(phase).value),
    }
    return found[name]() if name in found else None
