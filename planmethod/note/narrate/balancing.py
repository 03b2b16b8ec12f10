"""The text of static balancing: substituted masses, counterweights, forces (уравновешивание)."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from planmethod.note.compared_machine import compared_moment
from planmethod.note.numbers import format_column
from planmethod.note.wording import Language
from planmethod.solved.machine.balancing import Balancing, balancing_of
from planmethod.solved.reading import Complexes
from planmethod.solved.solution import Solution

COUNT = 12
"""Positions of the table."""

_ZERO_RATIO = 1e-9  # share of the force before that counts as none after

_Column: TypeAlias = tuple[str, str, list[str]]


class BalancingNarrator:
    """Narrates the balancing of a solution in a language."""

    def __init__(self, solution: Solution, language: Language) -> None:
        self.balancing: Balancing = balancing_of(solution)
        self.profile, self.language, self.notation = solution.profile, language, language.notation
        self.texts = language.machine

    def unit(self, name: str) -> str:
        """Return the letters of a unit."""
        return self.notation.units[name]

    def _amount(self, value: float, unit: str) -> str:
        return f"{self.notation.computed(value)} {self.unit(unit)}"

    def lines(self) -> list[str]:
        """Return all of it with numbers, a sentence each."""
        made, texts = self.balancing, self.texts
        method = texts["weighings"][made.task.method.value]
        if made.task.share is not None:
            method += f", k = {self.notation.as_input(made.task.share)}"
        lines = [f"{texts['structures'][made.structure]}, {method}"]
        lines[0] = lines[0][:1].upper() + lines[0][1:]
        a, b = made.crank_pin, made.rod_pin
        places = {"link": made.rod, "A": a, "B": b}
        if abs(made.share.imag) > 1e-9 * max(abs(made.share), 1.0):
            lines.append(texts.off_line.format(**places))
        elif any(made.rod_masses):
            one, two = (
                f"m_{{{made.rod}{pin}}} = {self._amount(mass.real, 'kg')}"
                for pin, mass in zip((a, b), made.rod_masses, strict=True)
            )
            lines.append(texts.substituted.format(**places, one=one, two=two))
        for number, one_weight in enumerate(made.counterweights):
            if not one_weight.mass:
                lines.append(texts.no_weight.format(link=one_weight.link))
                continue
            both = compared_moment(made, number, self.profile)
            text = texts.weight.format(
                link=one_weight.link,
                terms=" + ".join(name.replace(" ", "\u00a0") for name, _ in one_weight.terms),
                moment=self._amount(both.exact, "kg·m"),
                radius=f"{self.notation.as_input(one_weight.radius)} {self.unit('m')}",
                mass=self._amount(one_weight.mass, "kg"),
                angle=self.notation.number(f"{one_weight.angle_deg:.1f}"),
                line=one_weight.pivot + one_weight.pin,
            )
            lines.append(
                f"{text} ({texts.measured.format(moment=self._amount(both.read, 'kg·m'))})"
            )
        return [*lines, *self._result_lines()]

    def _result_lines(self) -> list[str]:
        made, texts = self.balancing, self.texts
        before, after = made.largest
        after = 0.0 if after < _ZERO_RATIO * before else after
        lines = [
            texts.force_falls.format(
                before=self._amount(before, "N"), after=self._amount(after, "N")
            )
        ]
        centres = made.centres(360)
        spread = [_spread(column) for column in centres]
        masses = {
            "bare": self._amount(made.mass_before, "kg"),
            "whole": self._amount(made.mass_after, "kg"),
        }
        if spread[1] > _ZERO_RATIO * spread[0]:
            ways = (self._amount(value, "m") for value in spread)
            places = dict(zip(("before", "after"), ways, strict=True))
            return [*lines, texts.centre_moves.format(**places, **masses)]
        x, y = float(centres[1][0].real), float(centres[1][0].imag)
        size = abs(complex(x, y)) * 1e-9
        place = {
            "x": self.notation.computed(x if abs(x) > size else 0.0),
            "y": self.notation.computed(y if abs(y) > size else 0.0),
        }
        return [*lines, texts.centre_stands.format(**place, unit=self.unit("m"), **masses)]

    def columns(self) -> list[_Column]:
        """Return the main vector by positions: heads, units and cells of its columns."""
        made = self.balancing
        turn = [f"{round(phi % 360.0, 1) % 360.0:.1f}" for phi in made.phi(COUNT).tolist()]
        found: list[_Column] = [
            (self.language.note.number, "", [str(k) for k in range(COUNT)]),
            (f"φ_{{{made.crank}}}", "deg", [self.notation.number(a) for a in turn]),
        ]
        size = made.largest[0]
        for letters, force in zip(("F_{0}", "F"), made.forces(COUNT), strict=True):
            parts = (("^{x}", force.real), ("^{y}", force.imag), ("", np.abs(force)))
            for index, values in parts:
                clean = np.where(np.abs(values) < _ZERO_RATIO * size, 0.0, values)
                head = letters.replace("F", f"F{index}", 1)
                told = [self.notation.number(text) for text in format_column(clean.tolist())]
                found.append((head, "N", told))
        return found

    def weights(self) -> list[_Column]:
        """Return the counterweights as columns."""
        some = [one for one in self.balancing.counterweights if one.mass]

        def column(head: str, unit: str, values: list[float]) -> _Column:
            return head, unit, [self.notation.computed(value) for value in values]

        return [
            (self.texts.weights_table, "", [one.link for one in some]),
            column("m·r", "kg·m", [abs(one.moment) for one in some]),
            column("r", "m", [one.radius for one in some]),
            column("m", "kg", [one.mass for one in some]),
            ("α", "deg", [self.notation.number(f"{one.angle_deg:.1f}") for one in some]),
        ]


def _spread(column: Complexes) -> float:
    """Return the diagonal of the box that a point moves in."""
    return float(np.hypot(np.ptp(column.real), np.ptp(column.imag)))
