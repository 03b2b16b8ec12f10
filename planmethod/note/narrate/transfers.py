"""Text on transfer functions, with the segments that give them (передаточные функции)."""

from __future__ import annotations

from collections import Counter

from planmethod.construct.steps import Compute, GivenNumber, NumberName, Step, Total
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.naming import Formulas, Names
from planmethod.plans.build import Quantity
from planmethod.plans.model import PlanKind
from planmethod.problem.quantities import QuantityKind
from planmethod.solved.quantities import Transfers

ORDERS = {
    PlanKind.VELOCITY: (QuantityKind.TRANSFER, QuantityKind.RATIO),
    PlanKind.ACCELERATION: (QuantityKind.TRANSFER_2, QuantityKind.RATIO_2),
}
"""Kinds of transfer functions by the plan that gives them."""


def even_letter(names: Names, point: str) -> Rich:
    """Return the end of a point's acceleration without the part of ε₁: ``c_{q}``."""
    motion = names.kinematics.acceleration
    letter = names.point(motion.point[motion.named[point]])
    return f"{letter[:-1]}q}}" if letter.endswith("}") else f"{letter}_{{q}}"


class TransferNarrator:
    """Narrates the transfer functions of one position.

    Parameters
    ----------
    formulas : Formulas
        Of the position.
    transfers : Transfers
        Of the same solution.
    """

    def __init__(self, formulas: Formulas, transfers: Transfers) -> None:
        self.position_formulas, self.transfers, self.index = formulas, transfers, formulas.index
        self.crank = transfers.solution.problem.drive.link
        self._made: dict[NumberName, Step] = {NumberName(s.out): s for s in transfers.added}
        self._own = {NumberName(q.name): q for q in transfers.quantities}

    def formulas(self, plan: PlanKind, *, senses: bool = True) -> list[Rich]:
        """Return the formulas of the quantities from a plan, with senses of turning or without."""
        return [self._formula(some, senses=senses) for some in self._grouped(plan)]

    def senses(self, plan: PlanKind) -> list[Rich]:
        """Return the senses of turning of links from a plan: ``u_21 – against link 1``."""
        told = []
        for quantities in self._grouped(plan):
            sense = self._sense(quantities[0])
            if sense:
                told.append(f"{' = '.join(q.symbol for q in quantities)} – {sense}")
        return told

    def _grouped(self, plan: PlanKind) -> list[list[Quantity]]:
        """Return the quantities from a plan, always equal ones together."""
        kinematics, found = self.transfers.steps.kinematics, dict[object, list[Quantity]]()
        motion = kinematics.motion(plan)
        for quantity in self.transfers.some(*ORDERS[plan]):
            alike: object = quantity.of
            if quantity.kind in (QuantityKind.TRANSFER, QuantityKind.TRANSFER_2):
                alike = motion.point[motion.named[quantity.of]]
            else:
                link = self._link(quantity)
                alike = kinematics.omega.get(link), kinematics.epsilon.get(link)
            found.setdefault((quantity.kind, alike), []).append(quantity)
        return list(found.values())

    @staticmethod
    def _link(quantity: Quantity) -> str:
        return str(quantity.name).removeprefix("u_").removeprefix("epsilon_q_")

    def _formula(self, quantities: list[Quantity], *, senses: bool) -> Rich:
        formulas, quantity = self.position_formulas, quantities[0]
        read, exact = self._values(NumberName(quantity.name))
        turns = quantity.kind in (QuantityKind.RATIO, QuantityKind.RATIO_2)
        unit = "" if turns else formulas.unit(quantity.kind.unit)
        if not isinstance(self._made[NumberName(quantity.name)], Total):  # of numbers with signs
            read, exact = abs(read), abs(exact)
        bare = formulas.notation.short(read, 4)
        sides = dict.fromkeys((self._meant(quantity), *self._sides(quantity)))
        shown = [side for side in sides if side and side != bare]
        parts = [*(q.symbol for q in quantities), *shown, f"{bare} {unit}".rstrip()]
        text = " = ".join(parts) + formulas.exactly(exact, unit)
        sense = self._sense(quantity) if senses else ""
        return f"{text}, {sense}" if sense else text

    def _sense(self, quantity: Quantity) -> Rich:
        """Return the sense of a ratio against the crank, or of an ε_q; empty for others."""
        read, _ = self._values(NumberName(quantity.name))
        forms = {
            QuantityKind.RATIO: ("transfer_along", "transfer_against"),
            QuantityKind.RATIO_2: ("ccw", "cw"),
        }
        if quantity.kind not in forms or not read:
            return ""
        return str(self.position_formulas.texts[forms[quantity.kind][read < 0]]).format(
            link=self.crank
        )

    def _values(self, name: NumberName) -> tuple[float, float]:
        """Return a number as the hand has it, and as it is exactly."""
        both = (self.transfers.ruler_reading, self.transfers.paper)
        read, exact = (float(reading.number(name)[self.index]) for reading in both)
        return read, exact

    def _meant(self, quantity: Quantity) -> Rich:
        """Return the quotient that defines a transfer function, v_C/ω_1; empty with ε₁."""
        omega = f"ω_{{{self.crank}}}"
        of = self.transfers.solution.problem.lettered(quantity.of)
        even = self.transfers.steps.even
        if quantity.kind is QuantityKind.TRANSFER:
            return fraction(f"v_{{{of}}}", omega)
        if quantity.kind is QuantityKind.RATIO:
            return fraction(f"ω_{{{self._link(quantity)}}}", omega)
        letter = "a" if quantity.kind is QuantityKind.TRANSFER_2 else "ε"
        return fraction(f"{letter}_{{{of}}}", f"{omega}^{{2}}") if even else ""

    def _sides(self, quantity: Quantity) -> tuple[str, ...]:
        """Return a transfer function in symbols and in numbers."""
        made = self._made[NumberName(quantity.name)]
        if isinstance(made, Total):
            return self._angular_analogue(quantity)
        assert isinstance(made, Compute)
        powers: Counter[NumberName] = Counter()
        for name, power in made.powers:  # of the crank's pin (pa) is over (pa)
            powers[name] += power
        factors = [(*self._factor(name), power, False) for name, power in powers.items() if power]
        # The length of the crank stands before the segments, as in the textbook.
        return self.position_formulas.fraction(
            sorted(factors, key=lambda one: one[0].startswith("("))
        )

    def _factor(self, name: NumberName) -> tuple[str, float]:
        value = abs(self._values(name)[0])
        made = self._made.get(name)
        if made is None:
            return self.position_formulas.names.symbol(name), value
        if isinstance(made, GivenNumber):  # a length that no plan needs
            letter, _, index = name.partition("_")
            return f"{letter}_{{{index}}}", value
        names = self.position_formulas.names
        end = even_letter(names, str(name).strip("|").removeprefix("a_q_"))
        return f"({names.pole(PlanKind.ACCELERATION)}{end})", value

    def _angular_analogue(self, quantity: Quantity) -> tuple[str, ...]:
        """Return ε_q with an accelerated crank: the rest of a link's ε over the square of ω₁."""
        kinematics, notation = self.transfers.steps.kinematics, self.position_formulas.notation
        link, crank = quantity.of, self.crank
        omega = kinematics.omega[crank]
        own = kinematics.epsilon.get(link)
        u = next(q for n, q in self._own.items() if str(n) == f"u_{link}")
        numbers = [
            self._values(n)[0] for n in (own, NumberName(u.name), kinematics.epsilon[crank]) if n
        ]
        texts = [f"({notation.short(n)})" if n < 0 else notation.short(n) for n in numbers]
        minus = " − " if own else "−"
        above = f"ε_{{{link}}}{minus}" if own else minus
        letters = fraction(f"{above}{u.symbol}·ε_{{{crank}}}", f"ω_{{{crank}}}^{{2}}")
        lead = f"{texts[0]}{minus}" if own else minus
        square = f"{notation.short(abs(self._values(omega)[0]))}^{{2}}"
        return letters, fraction(f"{lead}{texts[-2]}·{texts[-1]}", square)

    def crank_acceleration_lines(self) -> list[Rich]:
        """Return how the part of the crank's ε, if any, is subtracted on the acceleration plan.

        A formula without its full stop, and a sentence.
        """
        transfers, steps = self.transfers, self.transfers.steps
        every = transfers.some(QuantityKind.TRANSFER_2)
        points = [quantity for quantity in every if not steps.of_crank(quantity.of)]
        if steps.even or not points:
            return []
        v, a = steps.kinematics.velocity, steps.kinematics.acceleration
        names, crank = self.position_formulas.names, self.crank
        times = NumberName(f"times_q_{points[0].of}")
        letters = self.position_formulas.fraction(
            [
                (f"ε_{{{crank}}}", abs(self._values(steps.kinematics.epsilon[crank])[0]), 1, False),
                (names.symbol(v.segments.scale), self.position_formulas.per_mm(v.kind), 1, True),
                (f"ω_{{{crank}}}", abs(self._values(steps.omega)[0]), -1, False),
                (names.symbol(a.segments.scale), self.position_formulas.per_mm(a.kind), -1, True),
            ]
        )
        sign = self._values(times)[0]
        return [
            " = ".join(("k", *letters, self.position_formulas.notation.short(abs(sign), 4))),
            self.position_formulas.texts["transfer_carried"][
                "with" if sign > 0 else "against"
            ].format(
                ends=", ".join(
                    dict.fromkeys(
                        f"({names.point(a.point[a.named[q.of]])}{even_letter(names, q.of)})"
                        f" = k·({names.pole(v.kind)}{names.point(v.point[v.named[q.of]])})"
                        for q in points
                    )
                )
            ),
        ]
