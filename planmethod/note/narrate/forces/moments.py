"""The equations of moments of one force plan, and where the forces of its guides act (моменты)."""

# no messages: mistakes in a program

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from msgspec import Struct

from planmethod.note.document import closed
from planmethod.note.formula import fraction
from planmethod.note.narrate.equations import last_number, marked
from planmethod.note.narrate.forces.loads import ForceContext, arm_symbol
from planmethod.note.narrate.naming import point_name
from planmethod.note.numbers import MINUS, signed_sum
from planmethod.plans.forces.board import Force
from planmethod.plans.forces.polygons import (
    Balance,
    Component,
    CoupleOn,
    Edge,
    ForcePlan,
    Moments,
)
from planmethod.plans.model import Direction, PlanKind, Relation
from planmethod.solved.forces.reading import Guided, guide_of

SIDES = ("right", "up", "left", "down")
CANCELLED = 1e-9
"""Fraction of the largest value of a position below which known moments are said to cancel."""


def number_equations(context: ForceContext) -> None:
    """Give the equations of force plans numbers, if the file wants them."""
    problem, every = context.solution.problem, list[Balance | Moments]()
    if not problem.sheet.equation_numbers:
        return
    for plan in context.reading.plans:
        texts = MomentNarrator(context, plan)
        every += plan.balances
        every += (one for one in in_order(plan) if texts.equation_text(one) is not None)
    first = last_number(context.solution.construction, problem) + 1
    context.numbers = {one: number for number, one in enumerate(every, first)}


def in_order(plan: ForcePlan) -> list[Moments]:
    """Return the equations of moments of a plan in their order: those of forces first."""
    return sorted(plan.moments, key=lambda one: one.force is None)


class MomentText(Struct, frozen=True):
    """Text of an equation of moments (уравнение моментов).

    Attributes
    ----------
    equation : str
        In letters, the unknown with its actual sign.
    arms : tuple of str
        ``h_{G2} = 20,5`` each, mm; none where no force has an arm.
    length : str
        The arm of the unknown force where it is measured, m; else empty.
    result : str
        The resulting force or couple with numbers; empty where it is zero.
    value : float
        Moment of the unknown as read by hand, N·m or N times the arm's length; positive
        counter-clockwise.
    """

    equation: str
    arms: tuple[str, ...] = ()
    length: str = ""
    result: str = ""
    value: float = 0.0


class MomentNarrator:
    """Narrates the equations of moments of one force plan."""

    def __init__(self, context: ForceContext, plan: ForcePlan) -> None:
        self.context, self.plan = context, plan
        self.reading, self.texts, self.units = context.reading, context.texts, context.units
        self.computed, self.short, self.symbol = context.computed, context.short, context.symbol
        self.statics = context.reading.statics

    # Equations -------------------------------------------------------------------------------

    def equation_text(self, equation: Moments) -> MomentText | None:
        """Return the text of an equation of moments; None where there is no couple to find."""
        reading, edge, couple = self.reading, equation.force, equation.couple
        forces = [
            (self.symbol(known.symbol), reading.read(known), reading.arm(known, equation.about))
            for known in equation.edges
            if not reading.is_negligible(known)
        ]
        forces = [(name, size, arm) for name, size, arm in forces if size and arm]
        couples = [
            (self.symbol(known.symbol), reading.read_number(known.moment))
            for known in equation.couples
            if not reading.is_no_couple(known)
        ]
        head = f"ΣM_{{{equation.about}}}"
        if self.context.names.on_sheet:  # where no sentence names the links
            head = f"Σ_{{{','.join(equation.links)}}}M_{{{point_name(str(equation.about))}}}"
        arm, length, measured = "", "", ""
        if edge is not None:
            symbol, unit, nothing, value = (
                self.symbol(edge.symbol),
                "N",
                reading.is_negligible(edge),
                reading.read(edge),
            )
            peak, turn = reading.peak, 1.0 if reading.turns(edge, equation.about) else -1.0
            arm, length, measured = self._arm(equation, edge)
        elif couple is None:
            return self._checked(head, forces, couples)
        else:
            symbol, unit, nothing = self.symbol(couple.symbol), "N·m", reading.is_no_couple(couple)
            value, peak, turn = reading.read_number(couple.moment), reading.peak_moment, 1.0
        if nothing and not forces and not couples:
            return None if edge is None else MomentText(f"{head} = 0: {symbol} = 0")
        cancel, value = abs(value) <= CANCELLED * peak, 0.0 if nothing else turn * value
        letters = [(a, f"{name}·{arm_symbol(name)}") for name, _, a in forces]
        letters += [(moment, name) for name, moment in couples]
        letters.append((value, "·".join(filter(None, (symbol, arm)))))
        numbers = self._numbers(forces, couples, 1.0 if value < 0 else -1.0)
        if length:
            numbers = fraction(numbers, length)
        result = f"= {self.computed(abs(value))} {self.units[unit]}" if value else "≈ 0"
        return MomentText(
            f"{head} = {signed_sum(letters)} = 0",
            tuple(f"{arm_symbol(n)} = {self.context.measured(abs(a))}" for n, _, a in forces),
            measured,
            f"{symbol} = {numbers} {'= 0' if cancel and not value else result}"
            if forces or couples
            else f"{symbol} ≈ 0",
            value,
        )

    def _checked(
        self,
        head: str,
        forces: Sequence[tuple[str, float, float]],
        couples: Sequence[tuple[str, float]],
    ) -> MomentText | None:
        """Return an equation without an unknown: the residual of the moments, N·m."""
        if not forces and not couples:
            return None
        letters = [(a, f"{name}·{arm_symbol(name)}") for name, _, a in forces]
        letters += [(moment, name) for name, moment in couples]
        metres = self.context.formulas.per_mm(PlanKind.POSITION)
        left = sum(size * arm * metres for _, size, arm in forces)
        left += sum(moment for _, moment in couples)
        numbers = self._numbers(forces, couples, 1.0)
        return MomentText(
            f"{head} = {signed_sum(letters)}",
            tuple(f"{arm_symbol(n)} = {self.context.measured(abs(a))}" for n, _, a in forces),
            "",
            f"{head} = {numbers} = {self.computed(left)} {self.units['N·m']}",
            left,
        )

    def _arm(self, equation: Moments, edge: Edge) -> tuple[str, str, str]:
        """Return the letters and the length, m, of the arm of a tangential component.

        The third is how it was measured, where no given length determines it.
        """
        read, (first, *more) = self.reading.read_product(equation.arm), equation.arm
        metres = self.short(abs(read))
        if edge.is_aslant:
            letters = arm_symbol(self.symbol(edge.symbol))
            ruled = self.context.measured(abs(self.reading.read_number(first[0])))
            text = f"{letters} = {self.context.on_drawing(ruled)} = {metres} {self.units['m']}"
            return letters, metres, text
        given = self.statics.board.letter_of(first[0])
        if given:
            return given, metres, ""
        if not more:
            return self.context.names.symbol(first[0]), metres, ""
        letters = f"l_{{{edge.at}{equation.about}}}"
        own = Direction(Relation.PERPENDICULAR, (str(equation.about), str(edge.at)))
        if (
            edge.component is not Component.TANGENTIAL and edge.direction != own
        ):  # not across its arm
            letters = arm_symbol(edge.symbol)
        read = abs(self.reading.read_number(first[0]))
        length = self.context.on_drawing(self.context.measured(read))
        return letters, metres, f"{letters} = {length} = {metres} {self.units['m']}"

    def _numbers(
        self,
        forces: Sequence[tuple[str, float, float]],
        couples: Sequence[tuple[str, float]],
        turn: float,
    ) -> str:
        """Return the known moments with numbers, those of forces in one bracket."""
        terms: list[tuple[float, str]] = []
        if forces:
            inside = signed_sum(
                [
                    (turn * arm, f"{self.context.known(size)}·{self.context.measured(abs(arm))}")
                    for _, size, arm in forces
                ]
            )
            inside = f"({inside})" if len(forces) > 1 or inside.startswith(MINUS) else inside
            terms.append((1.0, self.context.on_drawing(inside)))
        terms += [(turn * moment, self.context.known(abs(moment))) for _, moment in couples]
        return signed_sum(terms)

    def lines(self, equation: Moments) -> list[str]:
        """Return an equation of moments, its arms and its result; empty where all is zero."""
        told = self.equation_text(equation)
        if told is None:
            return []
        arms = f"{'; '.join(told.arms)} {self.units['mm']}" if told.arms else ""
        whole = marked(told.equation, self.context.numbers.get(equation))
        return [line for line in (whole, arms, told.length, told.result) if line]

    def _sum(self, equation: Moments, text: MomentText) -> list[str]:
        """Return the sum of moments in letters and the arms."""
        template = self.texts.moments_link if len(equation.links) == 1 else self.texts.moments_links
        lines = [
            template.format(links=", ".join(equation.links), point=equation.about),
            marked(
                text.equation + ("," if text.result else "."), self.context.numbers.get(equation)
            ),
        ]
        if text.arms:
            lines.append(self.texts.arms.format(arms="; ".join(text.arms)))
        return [*lines, *([f"{text.length};"] if text.length else [])]

    def before(self) -> Iterator[tuple[Moments, list[str]]]:
        """Yield the moment equations of a component or a balanced crank, before the plan."""
        for equation in self.plan.moments:
            if equation.force is not None:
                yield equation, self._component_lines(equation, equation.force)
            elif equation.couple is not None and self._is_balancing(equation.couple):
                yield equation, self._balancing_lines(equation, equation.couple)
            elif equation.couple is None and (told := self.equation_text(equation)) is not None:
                lines = [*self._sum(equation, told), f"{told.result} ≈ 0."]
                yield equation, [*lines, self.texts.in_balance]

    def _is_balancing(self, couple: CoupleOn) -> bool:
        return couple.moment in self.statics.driving_balances

    def _component_lines(self, equation: Moments, edge: Edge) -> list[str]:
        told, point = self.equation_text(equation), equation.about
        assert told is not None
        lines = self._sum(equation, told)
        if not told.result:
            return [*lines, self.texts.no_moments.format(point=point)]
        if not told.value:
            return [*lines, f"{told.result}."]
        sense = self.context.sense(told.value)
        exact = self.context.exactly(abs(self.reading.force(edge)))
        symbol = self.symbol(edge.symbol)
        turns = self.texts.turns.format(symbol=symbol, link=edge.on, point=point, sense=sense)
        return [*lines, f"{told.result}{exact}.", turns]

    def _balancing_lines(self, equation: Moments, couple: CoupleOn) -> list[str]:
        told = self.equation_text(equation)
        if told is None:
            zero = f"{self.symbol(couple.symbol)} = 0."
            return [self.texts.no_moments.format(point=equation.about), zero]
        return [*self._sum(equation, told), self._couple_text(told, couple)]

    def _couple_text(self, text: MomentText, couple: CoupleOn) -> str:
        """Return a found couple with numbers, its exact value and its sense."""
        if not text.value:
            return f"{text.result}."
        exact = self.context.exactly(self.reading.number(couple.moment))
        sense = self.texts.directed.format(sense=self.context.sense(text.value))
        return f"{text.result}{exact}{sense}"

    # Guides ----------------------------------------------------------------------------------

    def guides(self) -> Iterator[tuple[Moments, list[str]]]:
        """Yield the moments of the guides and the points of action of their forces."""
        for equation in self.plan.moments:
            couple = equation.couple
            if couple is not None and not self._is_balancing(couple):
                yield equation, self._guide(equation, couple)

    def _guide(self, equation: Moments, couple: CoupleOn) -> list[str]:
        texts, guided = self.texts, guide_of(self.reading, couple)
        assert guided is not None, "a couple that a plan finds is the driver's or a guide's"
        symbols = {"moment": guided.symbol("M"), "force": guided.symbol("F")}
        symbols["point"] = str(equation.about)
        told = self.equation_text(equation)
        if told is None:
            return [texts.guide_through.format(link=", ".join(equation.links), **symbols)]
        lines = [*self._sum(equation, told), self._couple_text(told, couple)]
        if not told.value:
            return [*lines, texts.guide_cancelled.format(**symbols)]
        edges = self._edges(guided)
        if guided.is_read:
            pressing = guided.reaction.force
            pressing = pressing if guided.sense > 0 else pressing.reversed()
            symbols |= {"formula": self._place(guided), "side": self._side(pressing, told.value)}
            lines.append(texts.guide_at.format(**symbols))
        else:
            lines.append(
                texts.guide_couple.format(sign="=" if guided.is_negligible else "≈", **symbols)
            )
        head = texts.guide_edges if guided.is_read else texts.guide_pair
        return [*lines, *([head, *closed(edges)] if edges else [])]

    def _side(self, force: Force, moment: float) -> str:
        """Return on which side of its joint a force acts."""
        away = -1j * self.reading.drawn_segment(force.tail, force.head) * moment
        quarter = round(float(np.degrees(np.angle(away))) / 90.0) % 4
        return str(getattr(self.texts, f"side_{SIDES[quarter]}"))

    def places(self) -> list[str]:
        """Return the distance from its joint at which each guide's reaction acts.

        For a slider that bears at its edges, also the forces there.
        """
        found = (guide_of(self.reading, one.couple) for one in self.plan.moments if one.couple)
        here = [guided for guided in found if guided is not None]
        in_joints = [one.as_planned.symbol("l") for one in here if one.is_no_couple and one.is_read]
        lines = [f"{' = '.join(in_joints)} = 0"] if in_joints else []
        for one in here:
            if not one.is_no_couple:
                lines += [*([self._place(one)] if one.is_read else []), *self._edges(one)]
        return lines

    def _place(self, guided: Guided) -> str:
        """Return the distance from its joint at which the reaction of a guide acts."""
        letters = fraction(guided.symbol("M"), guided.symbol("F"))
        numbers = fraction(self.computed(guided.read_moment), self.computed(guided.read_force))
        found = f"{self.computed(guided.read_distance)} {self.units['m']}"
        return f"{guided.as_planned.symbol('l')} = {letters} = {numbers} = {found}"

    def _edges(self, guided: Guided) -> list[str]:
        """Return what acts at the edges of a slider that does not reach as far as the resultant.

        Of a reaction without a force it is the couple that is left.
        """
        length = guided.contact.length
        if length is None or not guided.edges:
            return []
        if not guided.is_read:
            names = " = ".join(guided.as_planned.symbol("F", primes) for primes in ("'", "''"))
            formula = fraction(guided.symbol("M"), guided.as_planned.symbol("a"))
            numbers = fraction(self.computed(guided.read_moment), self.short(length))
            found = self.computed(guided.read_moment / length)
            return [f"{names} = {formula} = {numbers} = {found} {self.units['N']}"]
        force, distance = guided.read_force, guided.read_distance
        if not guided.centred or distance <= length / 2:
            return []
        arm, a, f = (guided.symbol(letter) for letter in "laF")
        half = self.short(length / 2)
        lines = [f"{arm} > {fraction(a, '2')} = {half} {self.units['m']}"]
        stronger = abs(guided.edges[0].force) > abs(guided.edges[1].force)
        for primes, is_near in (("'", stronger), ("''", not stronger)):
            sign = "+" if is_near else MINUS
            size = force * (distance + (length if is_near else -length) / 2) / length
            numbers = f"{self.computed(force)}·({self.computed(distance)} {sign} {half})"
            letters = fraction(f"{f}·({arm} {sign} {fraction(a, '2')})", a)
            formula = f"{letters} = {fraction(numbers, self.short(length))}"
            name = guided.symbol("F", primes)
            lines.append(f"{name} = {formula} = {self.computed(size)} {self.units['N']}")
        return lines
