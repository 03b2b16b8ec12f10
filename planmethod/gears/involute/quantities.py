"""A pair solved: its quantities with their values, formulas with numbers, limits (решение)."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi, sin

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.gears.angles import involute
from planmethod.gears.involute.blocking import LimitKind, ProfileShiftLimit, limits
from planmethod.gears.involute.formulas import RING_FORMULAS, GearSize, Unit, sizes_of
from planmethod.gears.involute.generation import RackCutting
from planmethod.gears.involute.profile import LineOfAction, Tooth
from planmethod.gears.involute.sizes import MeshingProblem, Pair, Reals
from planmethod.note.numbers import Notation, trimmed
from planmethod.note.wording import Language

_SIGNED = ("x_sum", "a", "a_w", "y", "delta_y")
_SIGNED_2 = ("z", "x", "d", "d_b", "d_w", "d_a", "d_f", "rho_a", "rho_p", "rho_l", "rho_low")
"""Quantities that are negative in `Pair` for an internal pair, and for its wheel 2."""


_ANGLES = ("alpha_w", "alpha_a", "beta", "alpha_t", "beta_b")
"""Quantities that `Pair` has in radians."""


class SizedQuantity(Struct, frozen=True):
    """A quantity with its value: one, or those of both wheels."""

    quantity: GearSize
    values: tuple[float, ...]

    def format_values(self, notation: Notation) -> list[str]:
        """Return the values as text, a dash for a value that does not exist."""
        places = self.quantity.unit.places
        return [
            notation.number(f"{value + 0.0:.{places}f}") if np.isfinite(value) else "—"
            for value in self.values
        ]


class SolvedMeshing:
    """A pair solved: its sizes, its teeth, its line of action, its limits (решение)."""

    def __init__(self, problem: MeshingProblem) -> None:
        self.problem = problem
        self.pair = pair = Pair.of(problem)
        self.teeth = (Tooth(pair, 0), Tooth(pair, 1))
        self.cuttings = tuple(RackCutting(t) if t.side > 0 else None for t in self.teeth)
        self.contact = LineOfAction.of(*self.teeth)
        self.limits = limits(problem.tip, problem.overlap, internal=bool(problem.cutter))

    @property
    def epsilon_beta(self) -> float:
        """Overlap ratio ε_β (коэффициент осевого перекрытия); 0 where the width is not known."""
        return (self.problem.width or 0.0) * sin(self.pair.beta) / (pi * self.pair.m)

    def _value(self, key: str) -> Reals:
        problem, pair, rack = self.problem, self.pair, self.pair.rack
        own = {
            "m": pair.m,
            "alpha": np.degrees(rack.alpha),
            "ha": rack.ha,
            "c": rack.c,
            "rho_f": rack.rho,
            "inv_alpha": involute(pair.alpha_t),
            "z": np.array(pair.z, dtype=float),
            "W": pair.base_tangent,
            "rho_low": np.array([tooth.rho_low for tooth in self.teeth]),
            "g_alpha": pair.rho_a[0] - pair.rho_p[0],
            "epsilon_alpha": pair.epsilon,
            "epsilon_active": self.contact.overlap(pair),
            "width": np.nan if problem.width is None else problem.width,
            "epsilon_beta": self.epsilon_beta,
            "epsilon_gamma": float(pair.epsilon) + self.epsilon_beta,
        }
        found = own[key] if key in own else getattr(pair, key)
        if key in _SIGNED_2:
            found = found * np.array([1, pair.side])
        elif key in _SIGNED:
            found = found * pair.side
        return np.asarray(np.degrees(found) if key in _ANGLES else found)

    def sized_quantities(
        self,
    ) -> tuple[list[SizedQuantity], list[SizedQuantity], list[SizedQuantity]]:
        """Return the quantities of the pair, of both wheels, and of their contact."""
        one, two, three = (
            [
                SizedQuantity(q, tuple(float(v) for v in np.atleast_1d(self._value(q.key))))
                for q in group
            ]
            for group in sizes_of(self.problem)
        )
        if self.problem.cutter:
            at = next(k for k, t in enumerate(one) if t.quantity.key == "x_sum")
            one[at] = replace(one[at], quantity=replace(one[at].quantity, symbol="x_{d}"))
        return one, two, three

    def fields(self, notation: Notation) -> dict[str, str]:
        """Return the numbers that formulas are filled with, by their names; ``x1`` of a wheel."""
        rack, alpha_w = self.pair.rack, float(self.pair.alpha_w)
        alpha_t, beta = self.pair.alpha_t, self.pair.beta
        values = {
            "h_l": rack.straight,
            "rad_alpha": alpha_t,
            "tan_alpha": np.tan(rack.alpha),
            "tan_t": np.tan(alpha_t),
            "cos": np.cos(alpha_t),
            "cos_n": np.cos(rack.alpha),
            "sin": np.sin(alpha_t),
            "cos_beta": np.cos(beta),
            "sin_beta": np.sin(beta),
            "cos_w": np.cos(alpha_w),
            "sin_w": np.sin(alpha_w),
        }
        if self.problem.cutter:
            pair = self.pair
            values |= {"a_w0": float(pair.a_w0), "d_a0": pair.d_a0}
            values |= {"sin_w0": np.sin(pair.alpha_w0), "sin_a0": np.sin(pair.alpha_a0)}
        for group in self.sized_quantities():
            for one in group:
                ends = ("",) if len(one.values) == 1 else ("1", "2")
                values |= {one.quantity.key + e: v for e, v in zip(ends, one.values, strict=True)}
        for k, angle in enumerate(self.pair.alpha_a):
            values[f"inv_alpha_a{k + 1}"] = float(involute(angle))
            values[f"tan_alpha_a{k + 1}"] = np.tan(angle)
            values[f"cos_beta_a{k + 1}"] = float(self.pair.s_na[k] / self.pair.s_a[k])
        angle = {"angle": "α_{tw}" if beta else "α_{w}"}
        return angle | {
            name: f"({shown})" if value < 0 else shown
            for name, value in values.items()
            for shown in [notation.number(trimmed(float(value), 6))]
        }

    def formulas(self, language: Language) -> Iterator[tuple[str, str]]:
        """Yield keys and formulas with their numbers and results, rich text, in order."""
        notation, fields = language.notation, self.fields(language.notation)
        tan = language.meshing.tan
        for group in self.sized_quantities():
            for one in group:
                q = one.quantity
                for k, shown in enumerate(one.format_values(notation)) if q.formula else ():
                    if not np.isfinite(one.values[k]) and self.problem.cutter:
                        continue  # a ring has no least shift
                    own, other = ("1", "2") if k == 0 else ("2", "1")

                    def substitute(text: str, index: str = own, mate: str = other) -> str:
                        text = text.replace("#", index).replace("@", mate)
                        return text.replace("0,5", notation.number("0.5"))

                    unit = "°" if q.unit is Unit.DEGREE else ""
                    unit = f" {language.meshing['units']['mm']}" if q.unit is Unit.MM else unit
                    ring = (
                        RING_FORMULAS.get(q.key, (None, None))[k] if self.problem.cutter else None
                    )
                    formula, filled = ring or (q.formula, q.numbers)
                    letters = substitute(formula).replace("{tan}", tan)
                    numbers = substitute(filled).format_map(fields | {"tan": tan})
                    yield q.key, f"{substitute(q.symbol)} = {letters} = {numbers} = {shown}{unit}"

    def evaluated_limits(self) -> Iterator[tuple[ProfileShiftLimit, float, float]]:
        """Yield every limit with the value compared with it, and its bound.

        The contact ratio is that of the teeth as cut. Radii of a ring are negative.
        """
        for one in self.limits:
            if not (one.hard and one.kind in (LimitKind.TIP, LimitKind.OVERLAP)):
                value = float(one.value(self.pair))
                if one.kind is LimitKind.OVERLAP:
                    value = self.contact.overlap(self.pair)
                yield one, value, float(one.bound(self.pair))

    def standard_values(
        self, limit: ProfileShiftLimit, value: float, bound: float
    ) -> tuple[float, float]:
        """Return value and bound with the signs of the standard: radii of a ring are positive."""
        if limit.kind is LimitKind.INTERFERENCE and limit.wheel == 1:
            return self.pair.side * value, self.pair.side * bound
        return value, bound

    def sentences(self, language: Language) -> list[tuple[ProfileShiftLimit, bool, str]]:
        """Return every limit, whether it is met, and its sentence as rich text."""
        texts, found = language.meshing, []
        for one, value, bound in self.evaluated_limits():
            number = "" if one.wheel is None else str(one.wheel + 1)
            shown = {
                k: language.notation.number(f"{v + 0.0:.3f}")
                for k, v in zip(
                    ("value", "bound"), self.standard_values(one, value, bound), strict=True
                )
            }
            holds = value >= bound
            turned = self.standard_values(one, 1.0, 1.0)[0] < 0
            sign = ("≤" if turned else "≥") if holds else (">" if turned else "<")
            name = one.kind.value
            if self.pair.beta and one.kind is LimitKind.TIP:
                name = "tip_helical"
            text = texts["conditions"][name].format(wheel=number, sign=sign, **shown)
            found.append((one, holds, text))
        return found
