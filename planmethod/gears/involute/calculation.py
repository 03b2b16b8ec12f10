"""Two wheels in mesh as a calculation, by the formulas of the protocol (расчёт зацепления)."""

# no messages: formulas

from __future__ import annotations

from math import degrees, pi

import numpy as np

from planmethod.gears.involute.formulas import RING_FORMULAS, Unit
from planmethod.gears.involute.geometry import MeshingProblem
from planmethod.gears.involute.results import SizedQuantity, SolvedMeshing
from planmethod.note.calculation.model import CalculationBuilder
from planmethod.note.formula import Rich, fraction
from planmethod.note.wording import Language

_INPUT_KEYS = ("m", "alpha", "ha", "c", "rho_f", "z", "x", "beta", "width")
ITERATIONS = 6
"""Of Newton's method, which doubles the right digits with each."""


def meshing_chapter(
    problem: MeshingProblem, builder: CalculationBuilder, language: Language
) -> None:
    """Write the chapter: every size of the pair by its formula; α_w by iteration."""
    _Pair(SolvedMeshing(problem), builder, language).write()


class _Pair:
    """Writes one pair."""

    def __init__(
        self, solved: SolvedMeshing, builder: CalculationBuilder, language: Language
    ) -> None:
        self.solved, self.builder, self.language = solved, builder, language
        self.problem, self.texts = solved.problem, language.calculation
        self.mm = language.notation.units["mm"]
        self.transverse = "α_{t}" if self.problem.beta else "α"

    def write(self) -> None:
        groups = [one for group in self.solved.sized_quantities() for one in group]
        for one in groups:
            if one.quantity.key in _INPUT_KEYS:
                self._write_input(one)
        rack = self.solved.pair.rack
        self.builder.add_input("h_{l}^{*}", rack.straight)
        if self.problem.cutter:
            self.builder.add_input("z_{0}", self.problem.cutter)
        for one in groups:
            key = one.quantity.key
            if key in _INPUT_KEYS:
                continue
            if key == "alpha_w":
                self._iteration(one.quantity.symbol, self._symbol_of(groups, "inv_alpha_w"),
                                one.values[0])  # fmt: skip
                continue
            if key == "d_a" and self.problem.cutter:
                self._cutter()
            if key == "s_na":
                self._tip_helix()
            for k in range(len(one.values)):
                self._size(one, k)
        self.builder.close(self.texts.meshing.format())

    @staticmethod
    def _symbol_of(groups: list[SizedQuantity], key: str) -> Rich:
        return next(one.quantity.symbol for one in groups if one.quantity.key == key)

    def _unit(self, one: SizedQuantity) -> Rich:
        unit = one.quantity.unit
        return self.mm if unit is Unit.MM else "°" if unit is Unit.DEGREE else ""

    def _symbol(self, one: SizedQuantity, k: int) -> Rich:
        return one.quantity.symbol.replace("#", "12"[k])

    def _write_input(self, one: SizedQuantity) -> None:
        chosen = self.problem.chosen and one.quantity.key == "x"
        for k, value in enumerate(one.values):
            if np.isfinite(value):
                self.builder.add_input(self._symbol(one, k), value, self._unit(one),
                                   self.texts.chosen if chosen else "")  # fmt: skip

    def _size(self, one: SizedQuantity, k: int) -> None:
        value, size = one.values[k], one.quantity
        if not np.isfinite(value):
            return
        own, other = ("1", "2") if k == 0 else ("2", "1")
        ring = RING_FORMULAS.get(size.key, (None, None))[k] if self.problem.cutter else None
        letters = (ring[0] if ring else size.formula).replace("#", own).replace("@", other)
        symbol = self._symbol(one, k)
        if not letters:
            self.builder.value(symbol, value, self._unit(one), self.texts.computed)
            return
        if size.key == "inv_alpha":
            self.builder.in_radians = frozenset({self.builder.symbols[self.transverse]})
        self.builder.formula(symbol, letters.replace("{tan}", "tan"), value, self._unit(one))
        self.builder.in_radians = frozenset()

    def _iteration(self, symbol: Rich, involute: Rich, value: float) -> None:
        """Write an angle by its involute: the first guess by its cube root, then by Newton."""
        builder, stem = self.builder, symbol.removesuffix("}")
        target = float(builder.values[builder.symbols[involute]])
        angle = (3.0 * target) ** (1.0 / 3.0)
        letters = fraction(f"180·(3·{involute})^{{{fraction('1', '3')}}}", "π")
        for k in range(ITERATIONS):
            last = f"{stem},{k}}}"
            builder.formula(last, letters, degrees(angle), "°", self.texts.iteration)
            above = f"180·(inv({last}) − {involute})"
            letters = f"{last} − {fraction(above, f'π·tan^{{2}}{last}')}"
            angle -= (np.tan(angle) - angle - target) / np.tan(angle) ** 2
        builder.formula(symbol, letters, value, "°")

    def _cutter(self) -> None:
        """Write the sizes of the cutter of the ring and of its mesh with the ring."""
        builder, pair = self.builder, self.solved.pair
        builder.formula("d_{a0}", "m·(z_{0} + 2·(h_{a}^{*} + c^{*}))", pair.d_a0, self.mm)
        builder.formula("α_{a0}", "arccos(\\frac{m·z_{0}·cos α}{d_{a0}})",
                        degrees(pair.alpha_a0), "°")  # fmt: skip
        alpha = float(pair.alpha_w0)
        builder.formula("inv α_{w0}", "inv α + \\frac{2·x_{2}·tan α}{z_{2} − z_{0}}",
                        float(np.tan(alpha) - alpha))  # fmt: skip
        self._iteration("α_{w0}", "inv α_{w0}", degrees(alpha))
        builder.formula("a_{w0}", "\\frac{m·(z_{2} − z_{0})·cos α}{2·cos α_{w0}}",
                        float(pair.a_w0), self.mm)  # fmt: skip

    def _tip_helix(self) -> None:
        """Write the helix angles at the tips, which the normal thickness needs."""
        pair = self.solved.pair
        for k, wheel in enumerate("12"):
            lean = np.arctan(pair.d_a[k] / pair.d[k] * np.tan(pair.beta))
            self.builder.formula(
                f"β_{{a{wheel}}}", f"arctan(\\frac{{d_{{a{wheel}}}·tan β}}{{d_{{{wheel}}}}})",
                float(lean) * 180.0 / pi, "°",
            )  # fmt: skip
