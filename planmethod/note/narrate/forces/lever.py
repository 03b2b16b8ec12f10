"""The Zhukovsky lever: its formulas and sentences (рычаг Жуковского)."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite
from typing import Literal, TypeAlias

from msgspec import Struct

from planmethod.construct.steps import NumberName
from planmethod.note.compared import percent_text, sigma_text
from planmethod.note.formula import fraction
from planmethod.note.narrate.forces.loads import ForceContext, arm_symbol, force_symbol
from planmethod.note.narrate.naming import point_name, scale_inscription
from planmethod.note.numbers import MINUS, decimals_of, signed_sum
from planmethod.note.series import lever_beside_plans
from planmethod.plans.forces.lever import Trial
from planmethod.plans.forces.motor import MotorMoment
from planmethod.plans.model import PlanKind
from planmethod.solved.forces.reading import LeverCouple, LeverReading, LeverSegment, LeverShift


class PairText(Struct, frozen=True):
    """A couple on the lever: in letters, in numbers, and the source of the numbers.

    ``letters`` is ``(bc)/l_{BC}``, ``numbers`` ``73,0/0,3``; ``segment`` gives both lengths, and
    ``length`` is the letter of the second: both are empty where the lever has no segment of the
    link.
    """

    letters: str
    numbers: str
    segment: str = ""
    length: str = ""


def thrust_lines(context: ForceContext) -> list[str]:
    """Return how the force of an actuator is found, which the force plans take as known."""
    statics, texts = context.reading.statics, context.texts
    thrust = statics.thrust
    if statics.motor is not None:
        return _motor_lines(context, statics.motor)
    if thrust is None:
        return []
    symbol, called = context.symbol(context.reading.balancing_symbol), statics.board.called
    first, second = map(point_name, thrust.ends)
    one, two = map(called, thrust.links)
    facts = {"symbol": symbol, "first": first, "second": second, "one": one, "two": two}
    facts["line"] = first + second
    if thrust.trial is None:
        if not isfinite(context.reading.read_number(thrust.value)):
            return []
        teller = LeverNarrator(context)
        formula = teller.result() if teller.lever.forces else f"{symbol} = 0"
        return [texts.thrust_by_lever.format(formula=formula, **facts)]
    facts |= _trial_facts(context, thrust.trial, thrust.value, "N")
    return [texts.thrust_by_trial.format(**facts)]


def _motor_lines(context: ForceContext, motor: MotorMoment) -> list[str]:
    """Return how the moment of a motor between moving links is found."""
    texts, symbol = context.texts, context.symbol(context.reading.balancing_symbol)
    one, two = map(context.reading.statics.board.called, motor.links)
    facts = {"symbol": symbol, "one": one, "two": two}
    if motor.trial is not None:
        facts |= _trial_facts(context, motor.trial, motor.value, "N·m")
        return [texts.motor_by_trial.format(**facts)]
    if not isfinite(context.reading.read_number(motor.value)):
        return []
    teller = LeverNarrator(context)
    acting = teller.lever.forces or teller.lever.couples
    formula = teller.result() if acting else f"{symbol} = 0"
    return [texts.motor_by_lever.format(formula=formula, **facts)]


def _trial_facts(
    context: ForceContext, trial: Trial, value: NumberName, unit: str
) -> dict[str, str]:
    """Return the numbers of a trial, and the formula of the load that drives."""
    turns = context.solution.problem.drive.is_crank
    own, left = context.units[unit], context.units["N·m" if turns else "N"]
    names = {
        "without": trial.without, "tried": trial.tried, "given": trial.effect, "value": value,
    }  # fmt: skip
    numbers = {
        key: context.computed(context.reading.read_number(name)) for key, name in names.items()
    }
    product = fraction(f"{numbers['tried']}·({numbers['without']})", numbers["given"])
    symbol = context.symbol(context.reading.balancing_symbol)
    return {
        "formula": f"{symbol} = {MINUS}{product} = {numbers['value']} {own}",
        "without": f"{numbers['without']} {left}",
        "given": f"{numbers['given']} {left}",
        "tried": f"{numbers['tried']} {own}",
    }


LeverPart: TypeAlias = Literal["plan", "forces", "couples", "arms", "sum"]
"""Part of the lever that a step draws: the turned plan, the forces, couples, arms; a sum: none."""


class LeverNarrator:
    """Narrates the lever of one position, in which the driver must not be at rest."""

    def __init__(self, context: ForceContext) -> None:
        self.context, self.reading, self.texts = context, context.reading, context.texts
        self.names, self.computed = context.names, context.computed
        self.measured, self.notation = context.measured, context.notation
        self.lever = LeverReading(context.reading)
        self.unit = context.units[context.reading.balancing.unit]
        self.balancing = context.symbol(context.reading.balancing_symbol)
        series = lever_beside_plans(context.reading.statics)
        assert series is not None
        self.compared = series[context.reading.index]

    # Formulas --------------------------------------------------------------------------------

    def equation(self) -> str:
        """Return the sum of the moments about the pole in letters, each with its sign."""
        symbol = self.context.symbol
        forces = [(one.arm, symbol(one.symbol)) for one in self.lever.forces if one.arm]
        terms = [(arm, f"{name}·{arm_symbol(name)}") for arm, name in forces]
        terms += [
            (one.lever_moment, f"{symbol(one.symbol)}·{self._pair(one).letters}")
            for one in self.lever.couples
        ]
        return f"ΣM_{{p}} = {signed_sum(terms)} = 0"

    def arms(self) -> str:
        """Return the arms of the forces that have one, without their unit; empty if none has."""
        found = ((self.context.symbol(o.symbol), abs(o.arm)) for o in self.lever.forces if o.arm)
        return "; ".join(f"{arm_symbol(name)} = {self.measured(arm)}" for name, arm in found)

    def _pair(self, one: LeverSegment) -> PairText:
        """Return a couple, or what else goes with ω, by the ends of its link's segment."""
        names = self.names
        if one.ends is None or one.joints is None or not set(one.ends) <= set(names.letters):
            omega, per_mm = one.ratio * self.lever.per_mm, self.lever.per_mm
            letters, scale = f"ω_{{{one.link}}}", "μ_{v}"
            is_inverse = names.is_inverse_scale()
            letters = f"{letters}·{scale}" if is_inverse else fraction(letters, scale)
            return PairText(
                letters, self.context.scaled(self.context.short(omega), per_mm, back=True)
            )
        letters, length = f"({names.segment(*one.ends)})", f"l_{{{self._joints(one, *one.joints)}}}"
        segment, link = (
            self.measured(one.ratio * one.joint_distance),
            self.context.short(one.joint_distance),
        )
        units = self.context.units
        text = f"{letters} = {segment} {units['mm']}; {length} = {link} {units['m']}"
        return PairText(fraction(letters, length), fraction(segment, link), text, length)

    def _joints(self, one: LeverSegment, first: str, second: str) -> str:
        """Return two joints in the order in which their distance is given."""
        problem = self.context.solution.problem
        given = {name for _, name, _ in problem.lengths}
        on_link = {first, second} <= set(problem.bodies[one.link].points)
        return first + second if on_link and second + first not in given else second + first

    def segments(self) -> list[str]:
        """Return the segments and lengths that place couples on the lever, each once."""
        on_links = (*self.lever.couples, *self.lever.shifts)
        told = (self._pair(one).segment for one in on_links)
        return [text for text in dict.fromkeys(told) if text]

    def shift(self, one: LeverShift) -> str:
        """Return the distance of a shifted force from the centre of mass on the lever."""
        told = self._pair(one)
        formula = f"{one.symbol}·{told.letters} = {self.computed(one.shift)}·{told.numbers}"
        length = self.notation.number(f"{one.shift * one.ratio:.1f}")
        return f"({''.join(one.letters)}) = {formula} = {length} {self.context.units['mm']}"

    def lines(self) -> list[str]:
        """Return the moments about the pole, the arms, what balances them, the discrepancy."""
        texts, number = self.context.language.sheets, self.notation.number
        if not self.lever.forces and not self.lever.couples:
            return [texts.lever_no_work.format(symbol=self.balancing)]
        arms, lines = self.arms(), [self.equation()]
        lines += [f"{arms} {self.context.units['mm']}"] if arms else []
        lines += [text.replace("; ", ";  ") for text in self.segments()]
        lines += [self.shift(one) for one in self.lever.shifts]
        lines.append(texts.lever_found.format(symbol=self.balancing, **self._both()))
        one = self.compared
        if one.percent is not None:
            lines.append(
                texts.lever_difference.format(share=number(percent_text(one.percent_size)))
            )
            if isfinite(one.sigma):
                off = f"{number(sigma_text(one.sigma))} {self.unit}"
                lines.append(texts.lever_expected.format(sigma=off))
        return lines

    def _both(self) -> dict[str, str]:
        """Return what balances the driver by both methods."""
        told = {"plans": self.compared.exact, "lever": self.compared.read}
        return {by: f"{self.computed(abs(each))} {self.unit}" for by, each in told.items()}

    # Sentences -------------------------------------------------------------------------------

    def steps(self) -> Iterator[tuple[LeverPart, list[str]]]:
        """Yield the steps, each with the part of the drawing that it describes."""
        turned = self.texts.turned.format(pole=self.names.pole(PlanKind.VELOCITY))
        yield "plan", [turned, *self.larger()]
        if not self.lever.forces and not self.lever.couples:
            yield "sum", [self.texts.no_work.format(symbol=self.balancing)]
            return
        yield "forces", self._hung()
        for lines in self._pairs():
            yield "couples", lines
        arms = self.arms()
        if arms:
            yield "arms", [self.texts.lever_arms.format(arms=arms)]
        yield "sum", [self.texts.lever_sum, *self._equation()]
        yield "sum", self._compared()

    def larger(self) -> list[str]:
        """Return at which scale the lever is drawn, where that is not the velocity plan's."""
        if self.lever.times == 1.0:
            return []
        convention = self.context.solution.problem.scales.convention
        scale = scale_inscription(self.lever.scale, convention, self.notation)
        return [self.texts.larger.format(scale=scale)]

    def _hung(self) -> list[str]:
        """Return the point at which each force is applied, and the forces at the pole."""
        motion = self.names.kinematics.velocity
        at: dict[str, list[str]] = {}
        beside = {force_symbol(one.link): one for one in self.lever.shifts}
        for one in self.lever.forces:
            point = self.names.point(motion.point[motion.named[one.point]])
            if one.symbol in beside:
                point = beside[one.symbol].letters[1]
            at.setdefault(point, []).append(self.context.symbol(one.symbol))
        lines = []
        if at:
            told = (
                self.texts.hung_at.format(symbols=", ".join(symbols), point=point)
                for point, symbols in at.items()
            )
            lines.append(self.texts.hung.format(forces="; ".join(told)))
        if (ends := self.reading.statics.driving.between) is not None and len(at) > 0:
            points = ", ".join(self.names.point(motion.point[motion.named[end]]) for end in ends)
            lines.append(self.texts.hung_pair.format(symbol=self.balancing, points=points))
        lines += [
            self.texts.shift_on_lever.format(
                point=shift.letters[1], force=force_symbol(shift.link), formula=self.shift(shift)
            )
            for shift in self.lever.shifts
        ]
        hung = {one.symbol for one in self.lever.forces}
        still = [
            load.applied.name
            for load in self.reading.statics.board.given
            if load.force is not None
            and load.applied.force[self.reading.index]
            and load.applied.name not in hung
        ]
        return lines + ([self.texts.at_pole.format(symbols=", ".join(still))] if still else [])

    def _pairs(self) -> Iterator[list[str]]:
        """Yield how each couple is applied to the lever."""
        lines = [self._couple_text(one) for one in self.lever.couples]
        hung = {one.symbol for one in self.lever.couples}
        for load in self.reading.statics.board.given:
            one = load.applied
            if load.couple is None or not one.couple[self.reading.index] or one.name in hung:
                continue
            lines.append(self.texts.pair_still.format(symbol=one.name, link=one.link))
        if lines:
            yield lines

    def _couple_text(self, one: LeverCouple) -> str:
        pair, symbol = self._pair(one), self.context.symbol(one.symbol)
        if pair.segment:
            assert one.ends is not None
            text = self.texts.pair.format(
                symbol=symbol,
                length=pair.length,
                ends=", ".join(map(self.names.point, one.ends)),
                segment=pair.segment,
            )
        else:
            size = self.context.known(abs(one.moment))
            text = self.texts.pair_turning.format(
                symbol=symbol, letters=pair.letters, size=size, numbers=pair.numbers
            )
        if symbol == self.balancing or not one.lever_moment:
            return text + "."
        return text + self.texts.pair_sense.format(sense=self.context.sense(one.lever_moment))

    def _equation(self) -> list[str]:
        """Return the sum of moments, and what balances the driver with numbers."""
        value = self.compared.read
        assert self.reading.statics.lever is not None
        exact = self.context.exactly(float(self.reading.statics.lever[self.reading.index]))
        end = "."
        if self.reading.balancing.turns and value:
            end = self.texts.directed.format(sense=self.context.sense(value))
        return [f"{self.equation()},", f"{self.result()}{exact}{end}"]

    def result(self) -> str:
        """Return what balances the driver, with numbers."""
        value = self.computed(abs(self.compared.read))
        return f"{self.balancing} = {self._numbers()} = {value} {self.unit}"

    def _numbers(self) -> str:
        """Return the sum of the known moments over the arm of the balancing force."""
        symbol = self.reading.balancing_symbol
        terms, divisor, turn = [], "", 1.0
        balancing: list[tuple[float, str]] = []  # two couples of a motor between moving links
        for force in self.lever.forces:
            if force.symbol == symbol:
                divisor, turn = self.measured(abs(force.arm)), -1.0 if force.arm > 0 else 1.0
            elif force.arm and force.size:
                text = f"{self.context.known(force.size)}·{self.measured(abs(force.arm))}"
                terms.append((force.arm, text))
        for couple in self.lever.couples:
            numbers = self._pair(couple).numbers
            if couple.symbol == symbol:
                balancing.append((couple.lever_moment, numbers))
            elif couple.lever_moment:
                text = f"{self.context.known(abs(couple.moment))}·{numbers}"
                terms.append((couple.lever_moment, text))
        if balancing:
            turn = -1.0 if sum(moment for moment, _ in balancing) > 0 else 1.0
            divisor = signed_sum([(-turn * moment, text) for moment, text in balancing])
        phrase = signed_sum([(turn * moment, text) for moment, text in terms])
        return fraction(phrase or "0", divisor)  # in an extreme position all moments may be zero

    def _compared(self) -> list[str]:
        """Return the difference of lever and force plans, and the one expected of a drawing."""
        one, number = self.compared, self.notation.number
        decimals = decimals_of(one.exact_text)  # those of the compared value
        lines = [
            self.texts.compared.format(
                symbol=self.balancing,
                **self._both(),
                difference=number(f"{abs(one.off):.{decimals}f}"),
                unit=self.unit,
                share=""
                if one.percent is None
                else f" ({number(percent_text(one.percent_size))} %)",
            )
        ]
        if isfinite(one.sigma):
            part = "" if one.expected is None else f" ({number(percent_text(one.expected))} %)"
            off = number(sigma_text(one.sigma))
            lines.append(self.texts.expected.format(sigma=off, unit=self.unit, share=part))
        return lines
