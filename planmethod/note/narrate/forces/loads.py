"""The sentences of the loads of a position: weights, inertia, external forces (нагрузки)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.narrate.forces.common import Telling, closed
from planmethod.note.narrate.forces.formulas import load_formula, shift_formulas
from planmethod.note.plaintext import given
from planmethod.plans.forces.board import Given
from planmethod.plans.forces.loads import LoadKind, Shift
from planmethod.problem.load_records import Against, Mass
from planmethod.problem.model import Convention


class LoadVoice:
    """Tells what acts on the links beside the reactions."""

    def __init__(self, telling: Telling) -> None:
        self.telling, self.reading = telling, telling.reading
        self.said, self.words = telling.said, telling.words

    def scale(self) -> str:
        """Return the scale of the force plans."""
        newton, mm = self.words.units["N"], self.words.units["mm"]
        scale = self.reading.scale.per_mm
        if self.telling.solution.problem.scales.convention is Convention.MM_PER_UNIT:
            return f"μ_F = {given(1.0 / scale, self.words)} {mm}/{newton}"
        return f"μ_F = {given(scale, self.words)} {newton}/{mm}"

    def link(self, link: str) -> list[str]:
        """Tell the loads of a link."""
        lines = list(self._loads(link))
        if not lines:
            return [self.said.unloaded.format(link=link)]
        return [self.said.of_link.format(link=link), *closed(lines)]

    def _loads(self, link: str) -> Iterator[str]:
        dynamics = self.telling.solution.problem.dynamics
        assert dynamics is not None
        own = [load for load in self.reading.statics.board.given if load.applied.link == link]
        mass = dynamics.masses.get(link)
        for kind in (LoadKind.WEIGHT, LoadKind.INERTIA, LoadKind.INERTIA_COUPLE, LoadKind.EXTERNAL):
            found = [text for load in own if load.applied.kind is kind for text in self._told(load)]
            yield from found
            if mass is not None and not found and not self._is_shifted(link, kind):
                yield from self._none(link, mass, kind)

    def _is_shifted(self, link: str, kind: LoadKind) -> bool:
        return kind is LoadKind.INERTIA_COUPLE and link in self.reading.statics.board.shifts

    def _told(self, load: Given) -> list[str]:
        """Tell a load; of a shifted force of inertia, which couple it stands for and where."""
        one = load.applied
        shift = self.reading.statics.board.shifts.get(one.link)
        if one.kind is not LoadKind.INERTIA or shift is None:
            return [self._load(load)]
        return [self._load(load), *self._shift(load, shift)]

    def _shift(self, load: Given, shift: Shift) -> list[str]:
        couple = float(shift.moment.couple[self.reading.index])
        if not couple:
            return []
        plain, one = self.telling.plain, load.applied
        moment, formula = shift_formulas(self.reading, load, shift, self.telling.notation)
        epsilon = plain(f"ε_{{{one.link}}}")
        turning = self.said.inertia_couple.format(
            formula=plain(moment), exact="", sense=self.telling.sense(couple), epsilon=epsilon
        )
        length = abs(self.reading.read_number(shift.length))
        laid = self.said.shift.format(
            formula=plain(formula),
            length=plain(self.telling.notation.short(round(length, 2))),
            centre=one.point,
            acceleration=f"a_{one.point}",
            force=plain(one.name),
            point=plain(shift.letter),
            couple=plain(shift.moment.name),
        )
        return [turning, laid]

    def _none(self, link: str, mass: Mass, kind: LoadKind) -> Iterator[str]:
        """Tell an inertia force or couple that is none by nature."""
        if kind is LoadKind.INERTIA and mass.mass:
            symbol = self.telling.plain(f"Φ_{{{link}}}")
            yield self.said.inertia_zero.format(symbol=symbol, point=mass.centre)
        if kind is LoadKind.INERTIA_COUPLE and mass.inertia:
            symbol, epsilon = (
                self.telling.plain(f"M_{{Φ{link}}}"),
                self.telling.plain(f"ε_{{{link}}}"),
            )
            yield self.said.inertia_couple_zero.format(symbol=symbol, epsilon=epsilon)

    def _load(self, load: Given) -> str:
        one, index, said = load.applied, self.reading.index, self.said
        force, couple = complex(one.force[index]), float(one.couple[index])
        value = couple if one.point is None else abs(force)
        if not value:
            return said.absent.format(symbol=self.telling.plain(one.name))
        read = abs(self.reading.read_load(load))
        is_exact = self.telling.found(read) == self.telling.found(abs(value))
        common = {"point": one.point, "exact": "" if is_exact else self.telling.exactly(value)}
        if one.kind is LoadKind.EXTERNAL:
            return self._external(load, force, couple)
        common["formula"] = self.telling.plain(
            load_formula(self.reading, one, read, self.telling.notation)
        )
        match one.kind:
            case LoadKind.WEIGHT:
                return said.weight.format(**common)
            case LoadKind.INERTIA:
                shifted = one.link in self.reading.statics.board.shifts
                template = said.inertia_shifted if shifted else said.inertia
                return template.format(acceleration=f"a_{one.point}", **common)
            case LoadKind.INERTIA_COUPLE:
                sense = self.telling.sense(couple)
                epsilon = self.telling.plain(f"ε_{{{one.link}}}")
                return said.inertia_couple.format(sense=sense, epsilon=epsilon, **common)

    def _external(self, load: Given, force: complex, couple: float) -> str:
        symbol = self.telling.plain(load.applied.name)
        if load.applied.point is not None:
            size = f"{self.telling.found(abs(force))} {self.words.units['N']}"
            point, way = load.applied.point, self.telling.way(force) + self._resisting(load)
            return self.said.force.format(symbol=symbol, size=size, point=point, way=way)
        size = f"{self.telling.found(abs(couple))} {self.words.units['N·m']}"
        return self.said.couple.format(symbol=symbol, size=size, sense=self.telling.sense(couple))

    def _resisting(self, load: Given) -> str:
        """Tell of a force that it is against the velocity of its point; of others nothing."""
        dynamics, one = self.telling.solution.problem.dynamics, load.applied
        assert dynamics is not None and one.point is not None
        given_so = [other for other in dynamics.loads if other.name == one.name]
        if not any(isinstance(other.sense, Against) for other in given_so):
            return ""
        velocity = complex(self.telling.solution.points[one.point].velocity[self.reading.index])
        force = complex(one.force[self.reading.index])
        is_against = (force * velocity.conjugate()).real < 0
        template = self.said.against if is_against else self.said.along
        return template.format(point=one.point)
