"""The sentences of the equations of moments, and of what they find (уравнения моментов)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from planmethod.note.narrate.forces.common import Telling, closed
from planmethod.note.narrate.forces.guides import edge_lines
from planmethod.note.narrate.forces.moment_lines import MomentText, moment_text
from planmethod.plans.forces.board import Force
from planmethod.plans.forces.polygons import CoupleOn, Edge, ForcePlan, Moments
from planmethod.solved.forces.guides import Guided, guide_of

SIDES = ("right", "up", "left", "down")


class MomentVoice:
    """Tells the equations of moments of one force plan."""

    def __init__(self, telling: Telling, plan: ForcePlan) -> None:
        self.telling, self.plan = telling, plan
        self.reading, self.said = telling.reading, telling.said
        self.statics = telling.reading.statics

    def _moment(self, equation: Moments) -> MomentText | None:
        head = f"ΣM_{{{equation.about}}}"
        return moment_text(self.reading, equation, self.telling.notation, head)

    def _sum(self, equation: Moments, told: MomentText) -> list[str]:
        """Return the sum of moments in letters and the arms."""
        template = self.said.moments_link if len(equation.links) == 1 else self.said.moments_links
        lines = [
            template.format(links=", ".join(equation.links), point=equation.about),
            self.telling.plain(told.equation) + ("," if told.result else "."),
        ]
        if told.arms:
            lines.append(self.said.arms.format(arms="; ".join(map(self.telling.plain, told.arms))))
        if told.length:
            lines.append(f"{self.telling.plain(told.length)};")
        return lines

    def before(self) -> Iterator[list[str]]:
        """Tell the moments that give a component, or balance a crank: before the plan is drawn."""
        for equation in self.plan.moments:
            if equation.force is not None:
                yield self._component(equation, equation.force)
            elif equation.couple is not None and self._is_balancing(equation.couple):
                yield self._balancing(equation, equation.couple)

    def _is_balancing(self, couple: CoupleOn) -> bool:
        return couple.moment == self.statics.driving.balance

    def _component(self, equation: Moments, edge: Edge) -> list[str]:
        told, point = self._moment(equation), equation.about
        assert told is not None
        lines = self._sum(equation, told)
        if not told.result:
            return [*lines, self.said.no_moments.format(point=point)]
        if not told.value:
            return [*lines, f"{self.telling.plain(told.result)}."]
        symbol, sense = self.telling.plain(edge.symbol), self.telling.sense(told.value)
        exact = self.telling.exactly(abs(self.reading.force(edge)))
        turns = self.said.turns.format(symbol=symbol, link=edge.on, point=point, sense=sense)
        return [*lines, f"{self.telling.plain(told.result)}{exact}.", turns]

    def _balancing(self, equation: Moments, couple: CoupleOn) -> list[str]:
        told = self._moment(equation)
        if told is None:
            zero = f"{self.telling.plain(couple.symbol)} = 0."
            return [self.said.no_moments.format(point=equation.about), zero]
        return [*self._sum(equation, told), self._couple(told, couple)]

    def _couple(self, told: MomentText, couple: CoupleOn) -> str:
        """Return a found couple with numbers, its exact value and its sense."""
        if not told.value:
            return f"{self.telling.plain(told.result)}."
        exact = self.telling.exactly(self.reading.number(couple.moment))
        sense = self.said.directed.format(sense=self.telling.sense(told.value))
        return f"{self.telling.plain(told.result)}{exact}{sense}"

    def guides(self) -> Iterator[list[str]]:
        """Tell the moments of the guides and where their forces act."""
        for equation in self.plan.moments:
            couple = equation.couple
            if couple is not None and not self._is_balancing(couple):
                yield self._guide(equation, couple)

    def _guide(self, equation: Moments, couple: CoupleOn) -> list[str]:
        said, point = self.said, str(equation.about)
        guided = guide_of(self.reading, couple)
        assert guided is not None, "a couple that a plan finds is the driver's or a guide's"
        moment, force = (self.telling.plain(guided.symbol(letter)) for letter in "MF")
        symbols = {"moment": moment, "force": force, "point": point}
        told = self._moment(equation)
        if told is None:
            links = ", ".join(equation.links)
            return [said.guide_through.format(link=links, **symbols)]
        lines = [*self._sum(equation, told), self._couple(told, couple)]
        if not told.value:
            return [*lines, said.guide_cancelled.format(**symbols)]
        size = guided.read_force
        if guided.is_none or not size:
            sign = "=" if guided.is_none else "≈"
            lines.append(said.guide_couple.format(sign=sign, **symbols))
            return [*lines, *self._edges(guided, said.guide_pair)]
        pressing = guided.reaction.force
        pressing = pressing if guided.sense > 0 else pressing.reversed()
        symbols["arm"] = self.telling.plain(guided.own.symbol("l"))
        lines.append(self._acts(pressing, told.value, size, symbols))
        return [*lines, *self._edges(guided, said.guide_edges)]

    def _edges(self, guided: Guided, head: str) -> list[str]:
        """Tell what acts at the edges of a slider that is too short for the resultant."""
        formulas = [self.telling.plain(line) for line in edge_lines(guided, self.telling.notation)]
        return [head, *closed(formulas)] if formulas else []

    def _acts(self, force: Force, moment: float, size: float, symbols: dict[str, str]) -> str:
        """Tell where on its guide a force acts."""
        say = self.telling.notation
        numbers = f"{say.found(abs(moment))}/{say.found(size)}"
        away = -1j * self.reading.by_hand(force.tail, force.head) * moment
        quarter = round(float(np.degrees(np.angle(away))) / 90.0) % 4
        distance = f"{say.found(abs(moment) / size)} {say.units['m']}"
        return self.said.guide_at.format(
            numbers=self.telling.plain(numbers),
            distance=self.telling.plain(distance),
            side=getattr(self.said, f"side_{SIDES[quarter]}"),
            **symbols,
        )
