"""The sentences of the loads of a position: weights, inertia, external forces (нагрузки)."""

# no messages: mistakes in a program

from __future__ import annotations

from collections.abc import Iterator

from planmethod.construct.steps import Compute, NumberName
from planmethod.note.formula import fraction
from planmethod.note.narrate.forces.common import ForceContext, closed
from planmethod.note.narrate.forces.resultants import shift_symbol
from planmethod.note.narrate.scales import scale_inscription
from planmethod.plans.forces.board import GivenLoad
from planmethod.plans.forces.loads import Applied, LoadKind, Shift
from planmethod.plans.model import PlanKind
from planmethod.problem.load_records import Against, Mass


class LoadNarrator:
    """Tells what acts on the links beside the reactions."""

    def __init__(self, context: ForceContext) -> None:
        self.context, self.reading = context, context.reading
        self.texts, self.units = context.texts, context.units
        self.short, self.computed = context.short, context.computed

    # Formulas --------------------------------------------------------------------------------

    def formulas(self) -> list[str]:
        """Return the weights and the inertia forces and couples with their formulas.

        A force of inertia that also replaces its couple has couple and shift beside it.
        """
        lines, index, board = [], self.reading.index, self.reading.statics.board
        for load in board.given:
            one = load.applied
            if one.kind is LoadKind.EXTERNAL or not (one.force[index] or one.couple[index]):
                continue
            lines.append(self.formula(load))
            shift = board.shifts.get(one.link) if one.kind is LoadKind.INERTIA else None
            if shift is not None and shift.moment.couple[index]:
                lines += self.shifted(load, shift)
        return lines

    def formula(self, load: GivenLoad) -> str:
        """Return a weight, an inertia force or couple: ``Φ_{2} = m_{2}·a_{S2} = 40·68,5``..."""
        segments, couple = self.reading.statics.board.segments, load.couple
        made = segments.known(load.force.ends) if load.force is not None else couple
        assert made is not None
        return self._product(load.applied, made)

    def shifted(self, force: GivenLoad, shift: Shift) -> list[str]:
        """Return the couple that a shifted force of inertia replaces, and the shift."""
        size, moment = self.reading.read_load(force), self.reading.read_number(shift.couple)
        metres = self.context.formulas.per_mm(PlanKind.POSITION) * self.reading.read_number(
            shift.length
        )
        letters = f"{shift_symbol(shift.link)} = {fraction(shift.moment.name, force.applied.name)}"
        numbers, found = (
            fraction(self.computed(abs(moment)), self.computed(abs(size))),
            self.computed(abs(metres)),
        )
        text = f"{letters} = {numbers} = {found} {self.units['m']}"
        return [self._product(shift.moment, shift.couple), text]

    def _product(self, one: Applied, number: NumberName) -> str:
        dynamics = self.context.solution.problem.dynamics
        assert dynamics is not None
        mass, inertia = f"m_{{{one.link}}}", f"J_{{S{one.link}}}"
        letters = {
            LoadKind.WEIGHT: f"{mass}·g",
            LoadKind.INERTIA: f"{mass}·a_{{{dynamics.masses[one.link].centre}}}",
            LoadKind.INERTIA_COUPLE: f"{inertia}·ε_{{{one.link}}}",
        }[one.kind]
        step = self.context.step[number]
        assert isinstance(step, Compute)
        factors = (self.short(abs(self.reading.read_number(name))) for name, _ in step.powers)
        unit, size = self.units["N" if one.point else "N·m"], self.reading.read_number(number)
        return f"{one.name} = {letters} = {'·'.join(factors)} = {self.computed(abs(size))} {unit}"

    # Sentences -------------------------------------------------------------------------------

    def scale(self) -> str:
        """Return the scale of the force plans."""
        convention = self.context.solution.problem.scales.convention
        return scale_inscription(self.reading.scale, convention, self.context.notation)

    def link(self, link: str) -> list[str]:
        """Return the text on the loads of a link."""
        lines = list(self._loads(link))
        if not lines:
            return [self.texts.unloaded.format(link=link)]
        return [self.texts.of_link.format(link=link), *closed(lines)]

    def _loads(self, link: str) -> Iterator[str]:
        dynamics = self.context.solution.problem.dynamics
        assert dynamics is not None
        own = [load for load in self.reading.statics.board.given if load.applied.link == link]
        mass = dynamics.masses.get(link)
        for kind in (LoadKind.WEIGHT, LoadKind.INERTIA, LoadKind.INERTIA_COUPLE, LoadKind.EXTERNAL):
            found = [
                text for load in own if load.applied.kind is kind for text in self._load_lines(load)
            ]
            yield from found
            if mass is not None and not found and not self._is_shifted(link, kind):
                yield from self._zero_inertia(link, mass, kind)

    def _is_shifted(self, link: str, kind: LoadKind) -> bool:
        return kind is LoadKind.INERTIA_COUPLE and link in self.reading.statics.board.shifts

    def _load_lines(self, load: GivenLoad) -> list[str]:
        """Return the text on a load; for a shifted force of inertia, its couple and place too."""
        one = load.applied
        shift = self.reading.statics.board.shifts.get(one.link)
        if one.kind is not LoadKind.INERTIA or shift is None:
            return [self._load(load)]
        return [self._load(load), *self._shift(load, shift)]

    def _shift(self, load: GivenLoad, shift: Shift) -> list[str]:
        couple = float(shift.moment.couple[self.reading.index])
        if not couple:
            return []
        one, (moment, formula) = load.applied, self.shifted(load, shift)
        turning = self.texts.inertia_couple.format(
            formula=moment, exact="", sense=self.context.sense(couple), epsilon=f"ε_{{{one.link}}}"
        )
        length = abs(self.reading.read_number(shift.length))
        laid = self.texts.shift.format(
            formula=formula,
            length=self.short(round(length, 2)),
            centre=one.point,
            acceleration=f"a_{{{one.point}}}",
            force=one.name,
            point=shift.letter,
            couple=shift.moment.name,
        )
        return [turning, laid]

    def _zero_inertia(self, link: str, mass: Mass, kind: LoadKind) -> Iterator[str]:
        """Yield the statement that an inertia force or couple is always zero."""
        if kind is LoadKind.INERTIA and mass.mass:
            yield self.texts.inertia_zero.format(symbol=f"Φ_{{{link}}}", point=mass.centre)
        if kind is LoadKind.INERTIA_COUPLE and mass.inertia:
            yield self.texts.inertia_couple_zero.format(
                symbol=f"M_{{Φ{link}}}", epsilon=f"ε_{{{link}}}"
            )

    def _load(self, load: GivenLoad) -> str:
        one, index, texts = load.applied, self.reading.index, self.texts
        force, couple = complex(one.force[index]), float(one.couple[index])
        value = couple if one.point is None else abs(force)
        if not value:
            return texts.absent.format(symbol=one.name)
        read = abs(self.reading.read_load(load))
        is_exact = self.computed(read) == self.computed(abs(value))
        common = {"point": one.point, "exact": "" if is_exact else self.context.exactly(value)}
        if one.kind is LoadKind.EXTERNAL:
            return self._external(load, force, couple)
        common["formula"] = self.formula(load)
        match one.kind:
            case LoadKind.WEIGHT:
                return texts.weight.format(**common)
            case LoadKind.INERTIA:
                shifted = one.link in self.reading.statics.board.shifts
                template = texts.inertia_shifted if shifted else texts.inertia
                return template.format(acceleration=f"a_{{{one.point}}}", **common)
            case LoadKind.INERTIA_COUPLE:
                sense = self.context.sense(couple)
                epsilon = f"ε_{{{one.link}}}"
                return texts.inertia_couple.format(sense=sense, epsilon=epsilon, **common)
            case LoadKind.FRICTION:
                raise AssertionError("forces of friction are told by themselves")

    def _external(self, load: GivenLoad, force: complex, couple: float) -> str:
        symbol = load.applied.name
        if load.applied.point is not None:
            size = f"{self.computed(abs(force))} {self.units['N']}"
            point, way = (
                load.applied.point,
                self.context.direction_phrase(force) + self._resisting(load),
            )
            return self.texts.force.format(symbol=symbol, size=size, point=point, way=way)
        size = f"{self.computed(abs(couple))} {self.units['N·m']}"
        return self.texts.couple.format(symbol=symbol, size=size, sense=self.context.sense(couple))

    def _resisting(self, load: GivenLoad) -> str:
        """Return the phrase for a force opposed to the velocity of its point; else nothing."""
        dynamics, one = self.context.solution.problem.dynamics, load.applied
        assert dynamics is not None and one.point is not None
        given_so = [other for other in dynamics.loads if other.name == one.name]
        if not any(isinstance(other.sense, Against) for other in given_so):
            return ""
        velocity = complex(self.context.solution.points[one.point].velocity[self.reading.index])
        force = complex(one.force[self.reading.index])
        is_against = (force * velocity.conjugate()).real < 0
        template = self.texts.against if is_against else self.texts.along
        return template.format(point=one.point)
