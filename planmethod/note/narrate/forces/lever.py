"""The sentences of the Zhukovsky lever (рычаг Жуковского)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.narrate.forces.common import Telling
from planmethod.note.narrate.forces.formulas import signed_sum
from planmethod.note.narrate.forces.lever_lines import (
    both_balances,
    difference,
    expected,
    lever_arms,
    lever_equation,
    lever_unit,
    pair,
    shift_text,
)
from planmethod.note.narrate.forces.resultants import force_symbol
from planmethod.note.numbers import significant
from planmethod.note.plaintext import fixed, spoken
from planmethod.note.rounding import sigma_text
from planmethod.plans.model import PlanKind
from planmethod.solved.forces.lever import HungCouple, LeverReading


class LeverVoice:
    """Tells the lever of one position, which the driver must not stand in."""

    def __init__(self, telling: Telling) -> None:
        self.telling, self.reading = telling, telling.reading
        self.said, self.words = telling.said, telling.words
        self.lever = LeverReading(telling.reading, common=True)

    def items(self) -> Iterator[list[str]]:
        """Tell the steps."""
        pole = self.telling.names.pole(PlanKind.VELOCITY)
        yield [self.said.turned.format(pole=pole)]
        if not self.lever.forces and not self.lever.couples:
            symbol = self.telling.plain(self.reading.balancing_symbol)
            yield [self.said.no_work.format(symbol=symbol)]
            return
        yield self._hung()
        yield from self._pairs()
        arms = lever_arms(self.lever, self.telling.notation)
        if arms:
            yield [self.said.lever_arms.format(arms="; ".join(map(self.telling.plain, arms)))]
        yield [self.said.lever_sum, *self._equation()]
        yield self._compared()

    # Loads -----------------------------------------------------------------------------------

    def _hung(self) -> list[str]:
        """Tell which force goes to which point, and which go nowhere."""
        motion, names = self.telling.names.kin.velocity, self.telling.names
        at: dict[str, list[str]] = {}
        beside = {force_symbol(one.link): one for one in self.lever.shifts}
        for one in self.lever.forces:
            point = names.point(motion.point[motion.named[one.point]])
            if one.symbol in beside:
                point = self.telling.plain(beside[one.symbol].letters[1])
            at.setdefault(point, []).append(self.telling.plain(one.symbol))
        lines = []
        if at:
            told = (
                self.said.hung_at.format(symbols=", ".join(symbols), point=point)
                for point, symbols in at.items()
            )
            lines.append(self.said.hung.format(forces="; ".join(told)))
        for shift in self.lever.shifts:
            text = shift_text(self.lever, shift, self.telling.notation)
            lines.append(
                self.said.shift_on_lever.format(
                    point=self.telling.plain(shift.letters[1]),
                    force=self.telling.plain(force_symbol(shift.link)),
                    formula=self.telling.plain(text),
                )
            )
        hung = {one.symbol for one in self.lever.forces}
        still = [
            self.telling.plain(load.applied.name)
            for load in self.reading.statics.board.given
            if load.force is not None
            and load.applied.force[self.reading.index]
            and load.applied.name not in hung
        ]
        return lines + ([self.said.at_pole.format(symbols=", ".join(still))] if still else [])

    def _pairs(self) -> Iterator[list[str]]:
        """Tell how each couple stands on the lever."""
        lines = [self._pair(one) for one in self.lever.couples]
        hung = {one.symbol for one in self.lever.couples}
        for load in self.reading.statics.board.given:
            one = load.applied
            if load.couple is None or not one.couple[self.reading.index] or one.name in hung:
                continue
            lines.append(
                self.said.pair_still.format(symbol=self.telling.plain(one.name), link=one.link)
            )
        if lines:
            yield lines

    def _pair(self, one: HungCouple) -> str:
        told, symbol = pair(self.lever, one, self.telling.notation), self.telling.plain(one.symbol)
        if told.segment:
            names = self.telling.names
            assert one.ends is not None
            text = self.said.pair.format(
                symbol=symbol,
                length=self.telling.plain(told.letters.partition("/")[2]),
                ends=", ".join(map(names.point, one.ends)),
                segment=self.telling.plain(told.segment).replace(";  ", "; "),
            )
        else:
            text = self.said.pair_turning.format(
                symbol=symbol,
                letters=self.telling.plain(told.letters),
                size=self.telling.found(abs(one.moment)),
                numbers=self.telling.plain(told.numbers),
            )
        if one.symbol == self.reading.balancing_symbol or not one.lever_moment:
            return text + "."
        return text + self.said.pair_sense.format(sense=self.telling.sense(one.lever_moment))

    # Equation --------------------------------------------------------------------------------

    def _equation(self) -> list[str]:
        """Return the sum of moments, and what balances the driver with numbers."""
        symbol, balances = self.reading.balancing_symbol, both_balances(self.reading)
        value = balances[1]
        assert value is not None and self.reading.statics.lever is not None
        exact = self.telling.exactly(float(self.reading.statics.lever[self.reading.index]))
        unit = lever_unit(self.reading, self.telling.notation)
        end = "."
        if self.reading.balancing.turns and value:
            end = self.said.directed.format(sense=self.telling.sense(value))
        size = self.telling.notation.found(abs(value))
        letters = self.telling.notation.symbol(symbol)
        result = f"{letters} = {self._numbers()} = {size} {unit}"
        equation = lever_equation(self.lever, self.telling.notation)
        return [f"{self.telling.plain(equation)},", f"{self.telling.plain(result)}{exact}{end}"]

    def _numbers(self) -> str:
        """Return the sum of the known moments over the arm of what balances them."""
        say, symbol = self.telling.notation, self.reading.balancing_symbol
        terms, divisor, turn = [], "", 1.0
        for force in self.lever.forces:
            if force.symbol == symbol:
                divisor, turn = say.ruled(abs(force.arm)), -1.0 if force.arm > 0 else 1.0
            elif force.arm and force.size:
                terms.append((force.arm, f"{say.found(force.size)}·{say.ruled(abs(force.arm))}"))
        for couple in self.lever.couples:
            numbers = pair(self.lever, couple, say).numbers
            if couple.symbol == symbol:
                divisor, turn = numbers, -1.0 if couple.lever_moment > 0 else 1.0
            elif couple.lever_moment:
                text = f"{say.found(abs(couple.moment))}·{numbers}"
                terms.append((couple.lever_moment, text))
        said = signed_sum([(turn * moment, text) for moment, text in terms])
        over = f"({divisor})" if "/" in divisor else divisor
        return f"({said})/{over}" if " " in said else f"{said}/{over}"

    def _compared(self) -> list[str]:
        """Tell how far lever and force plans are apart, and what a drawing lets expect."""
        plans, value = both_balances(self.reading)
        assert value is not None
        unit = lever_unit(self.reading, self.telling.notation)
        share = difference(self.reading)
        found = self.telling.found
        decimals = len(significant(plans).partition(".")[2])  # of what it is the difference
        lines = [
            self.said.compared.format(
                symbol=self.telling.plain(self.reading.balancing_symbol),
                plans=f"{found(abs(plans))} {unit}",
                lever=f"{found(abs(value))} {unit}",
                difference=fixed(abs(value - plans), self.words, decimals),
                unit=unit,
                share="" if share is None else f" ({fixed(share, self.words, 1)} %)",
            )
        ]
        sigma = expected(self.reading)
        if sigma is not None:
            part = f" ({fixed(100.0 * sigma / abs(plans), self.words, 1)} %)" if plans else ""
            off = spoken(sigma_text(sigma), self.words)
            lines.append(self.said.expected.format(sigma=off, unit=unit, share=part))
        return lines
