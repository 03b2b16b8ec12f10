"""Tolerance of an answer: from the construction, with a floor and a cap (допуск ответа)."""

from __future__ import annotations

import math

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.marks import Settings
from planmethod.check.questions import Question
from planmethod.check.sheet import Sheet
from planmethod.problem.quantities import TURNINGS, QuantityKind, Sign

LONG_MM = 100.0
"""Length on the drawing of a link that turns too little to be measured."""

SHORT = 3.0
"""Sigmas below which a quantity is too short to be measured."""

FOLDED = 1.7
"""Factor for lengths about zero, which have no sign: the middle 68 % of them are closer."""


class Tolerance(Struct, frozen=True):
    """Permitted deviation of an answer (допуск).

    Attributes
    ----------
    exact : float
    sigma : float
    spread : float
        k times sigma.
    minimum : float
        The tolerance is not below it.
    maximum : float
        The tolerance is not above it.
    is_visible : bool
        Whether the drawing can show the answer.
    zero : bool
        Too short to be measured.
    per_mm : float
        Value of a millimetre of the plan; 0 if unknown.
    """

    exact: float
    sigma: float
    spread: float
    minimum: float
    maximum: float
    is_visible: bool
    zero: bool
    per_mm: float

    def tolerance(self, step: float = 0.0) -> float:
        """Return the tolerance of an answer written to a step of its last digit."""
        own = max(math.hypot(self.spread, step / 2), self.minimum)
        return own if self.zero else min(own, self.maximum)

    def allows(self, off: float, size: float, step: float = 0.0, times: float = 1.0) -> bool:
        """Return whether an answer is close enough; for zero, also one of that size."""
        tolerance = self.tolerance(step) * times
        return off <= tolerance * (1 + 1e-9) or (self.zero and size <= tolerance)


def limit_of(
    sheet: Sheet, question: Question, settings: Settings, fixed: float | None
) -> Tolerance:
    """Return the tolerance of an answer.

    Parameters
    ----------
    fixed : float or None
        Fraction of the answer that the task itself permits; it overrides all else.
    """
    exact, sigma = sheet.exact_answers[question.id], sheet.sigma(question)
    length, size = sheet.length(question), abs(exact)
    per_mm = 1.0 if question.is_mm else sheet.scales.get(question.scale, 0.0)
    if question.key.kind in TURNINGS:  # a zero one counts as that of a long link
        per_mm = size / length if length else _rate_per_mm(sheet, question)
    spread = settings.k * sigma
    turned = question.sign is Sign.ANGLE
    whole = math.degrees(1.0) if turned else size  # of an angle, a share of a radian
    most = settings.cap * whole
    least = min(max(settings.floor_mm * per_mm, settings.floor_share * whole), most)
    zero = not turned and (size < SHORT * sigma or not size)
    if zero:
        least = max(settings.floor_mm * per_mm, 1e-9)
        if question.sign is Sign.SIZE:
            spread = max(spread, FOLDED * spread - size)
    own = Tolerance(exact, sigma, spread, least, most, zero or spread <= most, zero, per_mm)
    if zero:
        return own
    if fixed is not None:
        return _flat(own, fixed * whole)
    flat, tolerance = settings.department * whole, own.tolerance()
    wider = settings.policy == "wider" and flat > tolerance
    stricter = settings.policy == "stricter" and flat < tolerance
    return _flat(own, flat) if wider or stricter or settings.policy == "department" else own


def _rate_per_mm(sheet: Sheet, question: Question) -> float:
    plan = "mu_v" if question.key.kind is QuantityKind.OMEGA else "mu_a"
    return sheet.scales[plan] / (LONG_MM * sheet.scales["mu_l"])


def _flat(limit: Tolerance, tolerance: float) -> Tolerance:
    """Return a limit with the department's own tolerance, whatever the drawing can show."""
    return replace(limit, spread=tolerance, minimum=tolerance, maximum=math.inf, is_visible=True)
