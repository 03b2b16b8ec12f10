"""Text on friction: circles and angles, the correction, efficiency, self-locking (трение)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from planmethod.mechanism.model import FRAME
from planmethod.note.document import Formula, Paragraph, Table, table_of_columns
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.forces.common import ForceContext
from planmethod.note.narrate.forces.statement import friction_facts
from planmethod.note.narrate.statement import point_name
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.plans.model import PlanKind
from planmethod.solved.efficiency import cycle_efficiency
from planmethod.solved.forces.friction import FrictionPair, friction_of


def headed(head: str) -> str:
    """Return a head of a table with a capital, if it is a word."""
    return head if head.startswith(("ρ", "φ")) else head[:1].upper() + head[1:]


class FrictionNarrator:
    """Narrates the friction of one position.

    Parameters
    ----------
    context : ForceContext
        Context of the forces without friction.
    sizes : bool
        Give the magnitude of the balancing force or moment, as equations beside it do, as long as
        friction does not reverse it; else give it with its sign.
    """

    def __init__(self, context: ForceContext, *, sizes: bool = False) -> None:
        self.sizes = sizes
        self.context, self.index = context, context.reading.index
        self.friction = friction_of(context.solution)
        self.texts, self.notation = context.language.friction, context.notation
        self.computed, self.units, self.symbol = context.computed, context.units, context.symbol

    def _per_cent(self, ratio: float) -> Rich:
        return f"{self.context.short(100.0 * ratio, 2)} %"

    # Pairs -----------------------------------------------------------------------------------

    def _between(self, pair: FrictionPair) -> str:
        between = "," if len(pair.on) > 1 or len(pair.by) > 1 else ""
        return f"{pair.on}{between}{pair.frame if pair.by == FRAME else pair.by}"

    def _force(self, pair: FrictionPair) -> Rich:
        """Return the letter of the reaction without friction."""
        return reaction_symbol(pair.on, pair.frame if pair.by == FRAME else pair.by)

    def reach(self, pair: FrictionPair) -> Rich:
        """Return the radius of the friction circle, or the angle of friction, with numbers."""
        index, f = self._between(pair), self.context.short(pair.f)
        if pair.slide is not None:
            phi = self.computed(pair.phi)
            arc, deg = self.texts.arctangent.format(), self.units["deg"]
            return f"φ_{{{index}}} = {arc} f = {arc} {f} = {phi}{deg}"
        rho, radius = self.computed(1e3 * pair.rho), self.context.short(1e3 * pair.radius)
        return f"ρ_{{{index}}} = f'·r = {f}·{radius} = {rho} {self.units['mm']}"

    def size(self, pair: FrictionPair) -> Rich:
        """Return the friction of a pair, computed from the forces without friction."""
        size = float(self.friction.rub(pair, self.friction.corrected)[self.index])
        symbol, force = self.symbol(pair.symbol), self._force(pair)
        letters, share = (
            ("f", pair.f) if pair.slide is not None else (f"ρ_{{{self._between(pair)}}}", pair.rho)
        )
        contact = self.friction.statics.contacts.get(pair.number)
        if contact is not None and contact.edges(self.index):
            force = f"(F^{{'}}_{{{self._between(pair)}}} + F^{{''}}_{{{self._between(pair)}}})"
        unit = self.units["N·m" if pair.slide is None else "N"]
        numbers = f"{self.context.short(share)}·{self.computed(size / share)}"
        return f"{symbol} = {letters}·{force} = {numbers} = {self.computed(size)} {unit}"

    def pair(self, pair: FrictionPair) -> Rich:
        """Return the sense of the relative motion and the effect of friction."""
        said, words, i = self.texts, self.context.note_texts, self.index
        rate, by = float(pair.rate[i]), pair.by
        sliding = pair.slide is not None
        frame, link = (said.on_frame, said.on_link) if sliding else (said.to_frame, said.to_link)
        facts = {
            "joint": point_name(pair.joint),
            "reach": self.reach(pair),
            "on": pair.on,
            "by": frame if by == FRAME else link.format(link=by),
            "size": self.size(pair),
        }
        if not pair.sense[i]:
            return said.still.format(**facts)
        if not sliding:
            sense, back = (words.ccw, words.cw) if rate > 0 else (words.cw, words.ccw)
            text = f"{self.computed(abs(rate))} {self.units['1/s']}"
            return said.turning.format(sense=sense, back=back, rate=text, **facts)
        ahead = complex(pair.direction[i]) * float(np.sign(rate))
        text = f"{self.computed(abs(rate))} {self.units['m/s']}"
        way, back = self.context.direction_phrase(ahead), self.context.direction_phrase(-ahead)
        return said.sliding.format(sense=way, back=back, rate=text, **facts)

    # Results ---------------------------------------------------------------------------------

    def columns(self) -> list[list[Rich]]:
        """Return the table of all pairs by columns: reactions thrice, and their friction."""
        friction, i = self.friction, self.index
        heads = self.context.language.friction["columns"]
        columns: list[list[Rich]] = [[head] for head in heads]
        for pair in friction.every:
            sizes = [
                abs(complex(friction.total(pair, forces)[i]))
                for forces in (friction.without, friction.corrected, friction.converged)
            ]
            rubs = [
                float(friction.rub(pair, forces)[i]) if pair.coefficient else np.nan
                for forces in (friction.corrected, friction.converged)
            ]
            cells = [
                point_name(pair.joint),
                self._dashed(pair),
                self.computed(1e3 * pair.rho) if pair.rho else "—",
                self.computed(pair.phi) if pair.phi else "—",
                *(self.computed(value) if np.isfinite(value) else "—" for value in (*sizes, *rubs)),
            ]
            for column, cell in zip(columns, cells, strict=True):
                column.append(cell)
        return columns

    def table(self) -> Table:
        """Return the table of the pairs."""
        return table_of_columns(self.columns(), repeated=2)

    def results(self) -> Iterator[Rich]:
        """Return lines on the balancing load, the remaining correction, efficiency, locking."""
        texts, friction, i = self.texts, self.friction, self.index
        once, jammed = friction.corrected, bool(friction.jammed[i])
        balancing = self.context.reading.balancing
        unit = self.units[balancing.unit]
        symbol = self.symbol(balancing.symbol)
        three = friction.without, once, friction.converged
        balances = [float(one.balance[i]) for one in three[: 2 if jammed else 3]]
        if self.sizes and max(balances) < 0:
            balances = [-value for value in balances]
        told = [f"{self.computed(value)} {unit}" for value in balances]
        facts = {"symbol": symbol, "without": told[0], "once": told[1]}
        if jammed:
            yield texts.balance_jammed.format(**facts)
            yield texts.jams
            return
        yield texts.balance.format(converged=told[2], **facts)
        change, reactions = float(friction.change[i]), float(friction.reaction_change[i])
        if np.isfinite(change):
            yield texts.change.format(
                balance=self._per_cent(change), reactions=self._per_cent(reactions), symbol=symbol
            )
        eta = float(friction.efficiency[i])
        if not np.isfinite(eta):
            yield texts.no_power
            return
        powers = [float(one.power[i]) for one in (friction.without, friction.converged)]
        ideal, real = (f"{self.computed(abs(power))}" for power in powers)
        drives = bool(friction.drives[i])
        loads = self.context.solution.problem.dynamics
        power = "N" if loads and any(one.name == "P" for one in loads.loads) else "P"
        letters = (f"{power}_{{0}}", power) if drives else (power, f"{power}_{{0}}")
        numbers = (ideal, real) if drives else (self.computed(-powers[1]), ideal)
        quotient = f"η = {fraction(*letters)} = {fraction(*numbers)} = {self.computed(eta)}"
        yield (texts.efficiency if drives else texts.efficiency_back).format(eta=quotient)
        if eta <= 0:
            yield texts.locks

    def cycle_lines(self) -> Iterator[Rich]:
        """Yield the efficiency of the cycle, where the mechanism can move through it."""
        found = cycle_efficiency(self.context.solution)
        if found is None:
            return
        if found.locked:
            first, last = (
                f"{self.notation.crank_angle(at)}{self.units['deg']}" for at in found.locked
            )
            yield self.texts.turn_jams.format(first=first, last=last)
            return
        joule = self.units["J"]
        drives, real = (
            found.ideal > 0,
            self.computed(found.real if found.ideal > 0 else -found.real),
        )
        if found.value is None:
            yield self.texts.turn_idle.format(real=f"{self.computed(found.real)} {joule}")
            return
        letters = fraction(*(("A_{0}", "A") if drives else ("A", "A_{0}")))
        ideal = self.computed(abs(found.ideal))
        numbers = fraction(*((ideal, real) if drives else (real, ideal)))
        yield self.texts.turn.format(
            eta=f"η = {letters} = {numbers} = {self.computed(found.value)}"
        )

    def given_lines(self) -> list[Rich]:
        """Return the coefficients and radii of the pairs, those alike once."""
        return [fact.text for fact in friction_facts(self.friction.statics, self.context.language)]

    def _dashed(self, pair: FrictionPair) -> str:
        return f"{pair.on}–{pair.frame if pair.by == FRAME else pair.by}"

    def nodes(self) -> Iterator[Paragraph | Formula]:
        """Yield the text of a sheet beside its pictures."""
        yield from map(Paragraph, self.results())
        yield from map(Paragraph, self.cycle_lines())

    def scaled(self, pair: FrictionPair) -> float:
        """Return the radius of a friction circle on the position plan, mm."""
        return pair.rho / self.context.solution.scales[PlanKind.POSITION].per_mm
