"""Counterweights as a calculation: masses in pins, vectors m·r, main vector (уравновешивание).

A vector m·r has its components along the line of its link and across it. The one across is left
out where all centres of mass are on the lines.
"""

# no messages: formulas

from __future__ import annotations

from cmath import phase
from math import degrees
from typing import NamedTuple

import numpy as np

from planmethod.note.calculation.model import CalculationBuilder
from planmethod.note.formula import Rich, fraction, root
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language
from planmethod.problem.machine_records import Weighing
from planmethod.solved.machine.balancing import SLIDER_CRANK, Balancing, Counterweight
from planmethod.solved.solution import Solution

_ZERO = 1e-12
"""Part of a vector below which a component is what rounding leaves of zero."""


class _Vector(NamedTuple):
    """Components along a line and across it, in letters; an empty one is zero."""

    parallel: Rich
    normal: Rich = ""

    def times(self, first: Rich = "", last: Rich = "") -> _Vector:
        """Return the product with numbers, which are written before and behind."""
        factors = ((first, _closed(part), last) if part else () for part in self)
        return _Vector(*("·".join(filter(None, told)) for told in factors))


def _closed(letters: Rich) -> Rich:
    return f"({letters})" if letters.startswith(MINUS) else letters


class BalancingChapter:
    """Writes the counterweights into a calculation that has the motion.

    Parameters
    ----------
    solution : Solution
        In the positions of the chapter.
    balancing : Balancing
    builder : CalculationBuilder
    language : Language
    """

    def __init__(
        self,
        solution: Solution,
        balancing: Balancing,
        builder: CalculationBuilder,
        language: Language,
    ) -> None:
        self.solution, self.made, self.builder = solution, balancing, builder
        self.texts, self.units = language.calculation, language.notation.units
        self.moments: dict[str, _Vector] = {}

    def write(self) -> None:
        """Write the masses of the rod, each counterweight, and the main vector of inertia."""
        made = self.made
        if made.dynamics.masses.get(made.rod) and any(made.rod_masses):
            self.builder.add_heading(self.texts.rod_masses.format(link=made.rod))
            self._rod_masses()
        for one in made.counterweights:
            self.builder.add_heading(self.texts.counterweight.format(link=one.link))
            self._counterweight(one)
        self.builder.add_heading(self.texts.shaking_force.format())
        self._whole_mass()
        self._main_vectors()

    # Letters -----------------------------------------------------------------------------------

    def _mass(self, link: str) -> Rich:
        """Return the letter of the mass of a link; empty of a link without mass."""
        mass = self.made.dynamics.masses.get(link)
        if mass is None or not mass.mass:
            return ""
        symbol = f"m_{{{link}}}"
        self.builder.add_input(symbol, mass.mass, self.units["kg"])
        return symbol

    def _length(self, link: str, start: str, end: str) -> Rich:
        points = self.made.problem.bodies[link].points
        symbol = f"l_{{{start}{end}}}"
        self.builder.add_input(symbol, abs(points[end] - points[start]), self.units["m"])
        return symbol

    def _to_centre(self, link: str, start: str, end: str) -> _Vector:
        """Return the vector from a pin to the centre of mass, along the line of the link."""
        mass, made = self.made.dynamics.masses[link], self.made
        points = made.problem.bodies[link].points
        share = made.centre_on_line(link, start, end)
        size = abs(share * (points[end] - points[start]))
        if not size:
            return _Vector("")
        symbol = f"l_{{{start}{mass.centre}}}"
        self.builder.add_input(symbol, size, self.units["m"])
        if abs(share.imag) <= _ZERO * abs(share):
            return _Vector(symbol if share.real > 0.0 else f"{MINUS}{symbol}")
        angle = f"β_{{{mass.centre}}}"
        self.builder.add_input(angle, degrees(phase(share)), "°", self.texts.from_line.format())
        return _Vector(f"{symbol}·cos {angle}", f"{symbol}·sin {angle}")

    def _named(self, symbol: Rich, letters: _Vector, value: complex, unit: Rich) -> _Vector:
        """Define the components of a vector; of one along the line alone, one number."""
        if not letters.normal:
            if not letters.parallel:
                return letters
            self.builder.formula(symbol, letters.parallel, value.real, unit)
            return _Vector(symbol)
        found = []
        parts = zip("xy", letters, (value.real, value.imag), strict=True)
        for axis, part, size in parts:
            component = f"{symbol.removesuffix('}')}{axis}}}"
            self.builder.formula(component, part or "0", size, unit)
            found.append(component)
        return _Vector(*found)

    # Counterweights ----------------------------------------------------------------------------

    def _rod_masses(self) -> None:
        made, kg = self.made, self.units["kg"]
        rod, one, two = made.rod, made.crank_pin, made.rod_pin
        mass, near, far = self._mass(rod), *made.rod_masses
        share = self._to_centre(rod, one, two)
        over = self._length(rod, one, two)
        parts = (fraction(f"{mass}·{_closed(part)}", over) if part else "" for part in share)
        self.far = self._named(f"m_{{{rod}{two}}}", _Vector(*parts), far, kg)
        along = f"{mass} {MINUS} {self.far.parallel}" if self.far.parallel else mass
        across = f"{MINUS}{self.far.normal}" if self.far.normal else ""
        self.near = self._named(f"m_{{{rod}{one}}}", _Vector(along, across), near, kg)

    def _terms(self, one: Counterweight) -> list[_Vector]:
        """Return the vectors m·r that a counterweight balances, as `Balancing` adds them."""
        made, found = self.made, list[_Vector]()
        if one.link != made.rod and (mass := self._mass(one.link)):
            found.append(self._to_centre(one.link, one.pivot, one.pin).times(mass))
        length = self._length(one.link, one.pivot, one.pin)
        rod, last = self._mass(made.rod), self._mass(made.last)
        near, far = (self.near, self.far) if rod else (_Vector(""), _Vector(""))
        partial = made.task.method is Weighing.PARTIAL
        if made.structure == SLIDER_CRANK and not partial:
            if one.link == made.rod:
                return [far.times(last=length), _Vector(last).times(last=length)]
            moved = " + ".join(filter(None, (rod, last, f"m'_{{{made.rod}}}")))
            return [*found, _Vector(f"({moved})·{length}")]
        if one.link != made.crank:
            return [*found, far.times(last=length)]
        found.append(near.times(last=length))
        if partial and made.task.share is not None:
            self.builder.add_input("k", made.task.share, "", self.texts.share_of_moved.format())
            along = " + ".join(filter(None, (far.parallel, last)))
            found.append(_Vector(f"k·({along})·{length}" if along else "",
                                 f"k·{far.normal}·{length}" if far.normal else ""))  # fmt: skip
        elif partial and one.terms and one.terms[-1][0].startswith("I_"):
            value = one.terms[-1][1]
            parts = []
            for axis, size in (("x", value.real), ("y", value.imag)):
                symbol = f"I_{{1{axis}}}"
                parts.append(symbol if abs(size) > _ZERO * abs(value) else "")
                if parts[-1]:
                    self.builder.value(symbol, size, self._kgm, self.texts.first_harmonic.format())
            found.append(_Vector(*parts))
        return found

    @property
    def _kgm(self) -> Rich:
        return self.units["kg·m"]

    def _counterweight(self, one: Counterweight) -> None:
        builder, link = self.builder, one.link
        terms = self._terms(one)
        along, across = (" + ".join(filter(None, parts)) for parts in zip(*terms, strict=True))
        moment = self._named(f"D_{{{link}}}", _Vector(along, across), -one.moment, self._kgm)
        self.moments[link] = moment
        radius, metre = f"r'_{{{link}}}", self.units["m"]
        if link in self.made.task.radii:
            builder.add_input(radius, one.radius, metre)
        else:
            builder.formula(radius, self._length(link, one.pivot, one.pin), one.radius, metre)
        if not moment.parallel:
            builder.value(f"m'_{{{link}}}", 0.0, self.units["kg"], self.texts.no_counterweight)
            return
        size = f"|{moment.parallel}|"
        if moment.normal:
            size = root(f"{moment.parallel}^{{2}} + {moment.normal}^{{2}}")
        builder.formula(f"m'_{{{link}}}", fraction(size, radius), one.mass, self.units["kg"])
        back = f"{MINUS}{moment.normal}" if moment.normal else "0"
        builder.formula(f"α'_{{{link}}}", f"atan2({back}; {MINUS}{moment.parallel})",
                        one.angle_deg, "°", self.texts.from_line.format())  # fmt: skip

    # Main vector -------------------------------------------------------------------------------

    def _whole_mass(self) -> None:
        made = self.made
        letters = [symbol for link in made.dynamics.masses if (symbol := self._mass(link))]
        letters += [f"m'_{{{one.link}}}" for one in made.counterweights]
        self.builder.formula("m_{Σ}", " + ".join(letters), made.mass_after, self.units["kg"])

    def _acceleration(self, point: str, axis: str) -> Rich:
        """Return the letter of a component of an acceleration; empty where it is always zero."""
        symbol = f"a_{{{point}{axis}}}"
        return symbol if symbol in self.builder.symbols else ""

    def _main_vectors(self) -> None:
        made, builder, newton = self.made, self.builder, self.units["N"]
        before, after, *_ = made.vectors_of(self.solution)
        parts: dict[str, tuple[Rich, Rich]] = {}
        for axis, values in (("x", before.real), ("y", before.imag)):
            letters = "".join(
                f" {MINUS} {self._mass(link)}·{acceleration}"
                for link, mass in made.dynamics.masses.items()
                if mass.mass
                and mass.centre is not None
                and (acceleration := self._acceleration(mass.centre, axis))
            )
            first = f"F_{{0{axis}}}"
            builder.row(first, _headed(letters), values.tolist(), newton)
            parts[axis] = first, f"F_{{{axis}}}"
        for axis, values in (("x", after.real), ("y", after.imag)):
            first, second = parts[axis]
            letters = first + "".join(
                self._weight_inertia(one, axis) for one in made.counterweights
            )
            self._residual(second, letters, values.tolist(), float(np.max(np.abs(before))))
        for number, symbol in enumerate(("F_{0}", "F")):
            x, y = (parts[axis][number] for axis in "xy")
            values = np.abs((before, after)[number]).tolist()
            letters = root(f"{x}^{{2}} + {y}^{{2}}")
            self._residual(symbol, letters, values, float(np.max(np.abs(before))))

    def _residual(self, symbol: Rich, letters: Rich, values: list[float], peak: float) -> None:
        """Write a row that may be what rounding leaves of zero: then the formula's value is it."""
        builder, newton = self.builder, self.units["N"]
        if max(map(abs, values)) <= 1e-9 * peak:
            builder.derived(symbol, letters, len(values), newton)
        else:
            builder.row(symbol, letters, values, newton)

    def _weight_inertia(self, one: Counterweight, axis: str) -> Rich:
        """Return the inertia of a counterweight: it is beyond the pivot, against D."""
        moment = self.moments[one.link]
        if not moment.parallel:
            return ""
        length, text = self._length(one.link, one.pivot, one.pin), ""
        if pivot := self._acceleration(one.pivot, axis):
            text += f" {MINUS} m'_{{{one.link}}}·{pivot}"
        # D·(a_pin − a_pivot) as a product of complex numbers
        pieces = {
            "x": ((moment.parallel, "x", "+"), (moment.normal, "y", MINUS)),
            "y": ((moment.parallel, "y", "+"), (moment.normal, "x", "+")),
        }
        for part, other, sign in pieces[axis]:
            pin, pivot = (self._acceleration(point, other) for point in (one.pin, one.pivot))
            if part and (pin or pivot):
                difference = f"({pin or '0'} {MINUS} {pivot})" if pivot else pin
                text += f" {sign} {fraction(f'{part}·{difference}', length)}"
        return text


def _headed(letters: Rich) -> Rich:
    """Return a sum of subtracted terms, without a blank behind its first sign."""
    return letters.replace(f" {MINUS} ", MINUS, 1) if letters else "0"
