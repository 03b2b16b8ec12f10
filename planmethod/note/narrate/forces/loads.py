"""The loads of a position and friction in sentences: weights, inertia, circles (нагрузки)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import isclose, isfinite, prod

import numpy as np
from msgspec.structs import replace

from planmethod.construct.steps import Compute, Name, NumberName, Step
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.note.document import (
    Equation,
    Formula,
    Paragraph,
    Table,
    closed,
    computed_text,
    input_text,
    table_of_columns,
)
from planmethod.note.formula import Rich, capitalized, fraction
from planmethod.note.narrate.equations import Directed, numbered, term_of
from planmethod.note.narrate.forces.springs import SpringNarrator
from planmethod.note.narrate.forces.statement import friction_facts
from planmethod.note.narrate.naming import (
    Formulas,
    Names,
    point_name,
    scale_inscription,
)
from planmethod.note.numbers import is_noise, significant, trimmed
from planmethod.note.wording import Language, MessageTable
from planmethod.plans.forces.board import GivenLoad
from planmethod.plans.forces.polygons import (
    Applied,
    Balance,
    Edge,
    LoadKind,
    Moments,
    Shift,
    reaction_symbol,
)
from planmethod.plans.model import KnownParts, PlanKind
from planmethod.problem.quantities import QuantityKind
from planmethod.problem.records import Against, BearingSection, Mass
from planmethod.solved.cycle_forces import cycle_efficiency
from planmethod.solved.forces.friction import FrictionPair, friction_of
from planmethod.solved.forces.loads import Hindrance, UnshiftedInertia, farthest
from planmethod.solved.forces.reading import ForceReading
from planmethod.solved.forces.statics import JointForce, Statics
from planmethod.solved.quantities import solution_peak
from planmethod.solved.solution import Solution


def shift_symbol(link: str) -> str:
    """Return the letter of a shift in rich text: ``h_{2}``."""
    return f"h_{{{link}}}"


def force_symbol(link: str) -> str:
    """Return the letter of a link's force of inertia in rich text: ``Φ_{2}``."""
    return f"Φ_{{{link}}}"


def shift_lines(statics: Statics, texts: MessageTable, index: int | None = None) -> list[str]:
    """Return where the shifted forces act, as rich text; in one position with its exact h."""
    lines = []
    for shift in statics.board.shifts.values():
        phrase = texts.resultant_shift.format(
            force=force_symbol(shift.link), point=shift.letter, couple=shift.moment.name
        )
        if index is not None:
            length = abs(float(statics.si.number(shift.length)[index]))
            unit = texts["units"]["m"]
            phrase += f": {shift_symbol(shift.link)} = {input_text(length, texts, 4)} {unit}"
        lines.append(f"{phrase}.")
    return lines


def unshifted_lines(statics: Statics, texts: MessageTable) -> list[str]:
    """Return which links keep the couple, and why, as rich text; the same for all positions."""
    return [_unshifted_line(statics, one, texts) for one in statics.unshifted]


def _unshifted_line(statics: Statics, one: UnshiftedInertia, texts: MessageTable) -> str:
    text = {
        Hindrance.NO_FORCE: texts.resultant_no_force,
        Hindrance.FAINT: texts.resultant_faint,
        Hindrance.TOO_LONG: texts.resultant_far,
    }[one.hindrance]
    return text.format(
        link=one.link,
        force=force_symbol(one.link),
        couple=one.moment.name,
        shift=shift_symbol(one.link),
        value=input_text(one.reach, texts, 4),
        limit=input_text(farthest(statics.solution.problem), texts, 4),
    )


QUARTERS = {0.0: "way_right", 90.0: "way_up", 180.0: "way_left", 270.0: "way_down"}
STRAIGHT = 1e-6
"""Degrees by which a direction may differ from the vertical or horizontal that it is called."""


class ForceContext:
    """Context shared by the narrators of the force analysis: a reading, names, a language.

    Given values and those of tables are exact; all others are read by hand: arms measured with the
    ruler, forces read on one plan and carried over into the next.
    """

    def __init__(self, reading: ForceReading, formulas: Formulas) -> None:
        self.reading, self.solution, self.formulas = reading, reading.solution, formulas
        self.names: Names = formulas.names
        self.note_texts, self.language, self.notation = (
            formulas.texts,
            formulas.language,
            formulas.notation,
        )
        self.texts, self.units = self.language.forces, self.notation.units
        self.computed, self.short, self.measured = (
            self.notation.computed,
            self.notation.short,
            self.notation.measured,
        )
        self.symbol = self.notation.symbol
        self.step: dict[Name, Step] = {s.out: s for s in reading.statics.program.steps}
        self.numbers: Mapping[Balance | Moments, int] = {}

    def sense(self, value: float) -> str:
        """Return the sense of a moment."""
        return self.note_texts.ccw if value > 0 else self.note_texts.cw

    def exactly(self, value: float) -> str:
        """Return the exact value in brackets."""
        return self.formulas.exactly(abs(value))

    def scaled(self, text: str, per_mm: float, *, back: bool = False) -> str:
        """Return millimetres times the scale of their drawing, or over it: ``70,0·250``.

        ``back``: convert to millimetres there.
        """
        is_inverse = self.names.is_inverse_scale()
        scale = self.short(1.0 / per_mm if is_inverse else per_mm)
        return f"{text}·{scale}" if is_inverse is back else fraction(text, scale)

    def known(self, value: float) -> str:
        """Return a force or couple that a formula goes on from, four digits of it at most.

        An exact product of fewer digits, of a mass or a measured length, has no zeros at its end.
        """
        text = trimmed(value, 4)
        is_exact = isfinite(value) and isclose(float(text), value, rel_tol=1e-9)
        return self.notation.number(text) if is_exact else self.computed(value)

    def on_drawing(self, text: str) -> str:
        """Return millimetres of the position plan as metres."""
        return self.scaled(text, self.formulas.per_mm(PlanKind.POSITION))

    def direction_phrase(self, vector: complex) -> str:
        """Return the phrase for the direction of a vector."""
        angle = float(np.degrees(np.angle(vector))) % 360.0
        for quarter, phrase in QUARTERS.items():
            if abs((angle - quarter + 180.0) % 360.0 - 180.0) < STRAIGHT:
                return str(getattr(self.texts, phrase))
        return self.texts.way_angle.format(angle=self.short(angle, 4))

    def base(self, edge: Edge) -> str:
        """Return the line that defines the direction of a force: ``BC`` of ``∥ BC``."""
        assert edge.direction is not None
        return self.names.base(edge.direction)


def balance_edges(balance: Balance, context: ForceContext) -> tuple[Edge, ...]:
    """Return the forces on a link or a group, without known ones that are zero."""
    return tuple(
        edge
        for edge in balance.edges
        if edge.known is not KnownParts.BOTH or not context.reading.is_negligible(edge)
    )


def balance_equation(balance: Balance, context: ForceContext, directed: Directed) -> Equation:
    """Return the sum of the forces on a link or a group, of those of `balance_edges`."""
    terms = (
        term_of(replace(edge, symbol=context.symbol(edge.symbol)), directed)
        for edge in balance_edges(balance, context)
    )
    name = f"Σ_{{{','.join(balance.links)}}}\\bar{{F}}"
    return Equation(tuple(terms), name=name, number=numbered(context.numbers.get(balance, 0)))


def lettered(reading: ForceReading, language: Language) -> ForceContext:
    """Return the shared context of the narrators for a sheet."""
    names = Names(reading.solution, language.note, on_sheet=True)
    return ForceContext(reading, Formulas(reading.solution, names, reading.index))


def _has_few_digits(value: float) -> bool:
    """Return whether a factor was given or measured: a computed one has more digits."""
    return isclose(float(trimmed(value, 5)), value, rel_tol=1e-9)


def arm_symbol(symbol: str) -> str:
    """Return the letter of a force's arm: ``h_{G2}`` of ``G_{2}``."""
    return f"h_{{{re.sub(r'[_^{},]', '', symbol)}}}"


def bearing_text(
    solution: Solution, joint: JointForce, shared: BearingSection, force: float, texts: MessageTable
) -> Rich:
    """Return the load of each bearing from a reaction, N, with numbers."""
    called, z = solution.problem.mechanism.called, shared.plane
    (first, second), parts = shared.at, []
    symbol = reaction_symbol(called(joint.on), called(joint.by))
    length = input_text(abs(second - first), texts)
    for primes, share, arm in zip(
        ("'", "''"), shared.load_fractions, (abs(second - z), abs(z - first)), strict=True
    ):
        name = reaction_symbol(called(joint.on), called(joint.by), letter=f"F^{{{primes}}}")
        numbers = fraction(f"{computed_text(force, texts)}·{input_text(arm, texts)}", length)
        size = f"{computed_text(abs(share) * force, texts)} {texts['units']['N']}"
        back = texts.bearing_back.format(symbol=symbol) if share < 0 else ""
        parts.append(f"{name} = {numbers} = {size}{back}")
    return texts.bearings.format(
        joint=point_name(joint.joint), symbol=symbol, first=parts[0], second=parts[1]
    )


def redundant(links: int) -> int:
    """Return q of a group of n links whose pairs have one freedom each; 0 for a driver.

    Across the plane a link has three equations, and a pair three unknowns: the force along the axis
    of its hinge and two moments. A group of n links has 3n/2 pairs.
    """
    return 3 * links // 2 if links > 1 else 0


def undetermined(groups: Iterable[AssurGroup], texts: MessageTable) -> Iterator[Rich]:
    """Describe the reaction components in the groups that statics leaves undetermined."""
    named: dict[int, list[str]] = {}
    for group in groups:
        named.setdefault(len(group.links), []).append("–".join(group.links))
    for n, same in named.items():
        if not (q := redundant(n)):  # a wheel on its hinge
            continue
        template = texts.undetermined if len(same) > 1 else texts.undetermined_one
        yield template.format(
            groups=", ".join(same), equations=3 * n, unknowns=3 * (3 * n // 2), q=q
        )


# no messages: mistakes in a program
class LoadNarrator:
    """Tells what acts on the links beside the reactions."""

    def __init__(self, context: ForceContext) -> None:
        self.context, self.reading = context, context.reading
        self.texts, self.units = context.texts, context.units
        self.short, self.computed = context.short, context.computed

    # Formulas --------------------------------------------------------------------------------

    def formulas(self) -> list[list[str]]:
        """Return the weights, inertia forces and couples with their formulas, link by link.

        A force of inertia that also replaces its couple has couple and shift beside it.
        """
        found: dict[str, list[str]] = {}
        index, board = self.reading.index, self.reading.statics.board
        for load in board.given:
            one = load.applied
            if not load.letters or not (one.force[index] or one.couple[index]):
                continue
            lines = found.setdefault(one.link, [])
            lines.append(self.formula(load))
            shift = board.shifts.get(one.link) if one.kind is LoadKind.INERTIA else None
            if shift is not None and shift.moment.couple[index]:
                lines += self.shifted(load, shift)
        return list(found.values())

    def formula(self, load: GivenLoad) -> str:
        """Return a weight, an inertia force or couple: ``Φ_{2} = m_{2}·a_{S2} = 40·68,5``..."""
        segments, couple = self.reading.statics.board.segments, load.couple
        made = segments.known(load.force.ends) if load.force is not None else couple
        assert made is not None
        return self._product(load.applied, made, load.letters)

    def shifted(self, force: GivenLoad, shift: Shift) -> list[str]:
        """Return the couple that a shifted force of inertia replaces, and the shift."""
        size, moment = self.reading.read_load(force), self.reading.read_number(shift.couple)
        metres = self.context.formulas.per_mm(PlanKind.POSITION) * self.reading.read_number(
            shift.length
        )
        letters = f"{shift_symbol(shift.link)} = {fraction(shift.moment.name, force.applied.name)}"
        numbers, found = (
            fraction(self.context.known(abs(moment)), self.context.known(abs(size))),
            self.computed(abs(metres)),
        )
        text = f"{letters} = {numbers} = {found} {self.units['m']}"
        return [self._product(shift.moment, shift.couple, shift.letters), text]

    def _product(self, one: Applied, number: NumberName, known: Mapping[NumberName, str]) -> str:
        """Return a load with the letters and the numbers of the step that computes it."""
        step = self.context.step[number]
        assert isinstance(step, Compute)
        letters = (known[name] for name, _ in step.powers)
        factors = [abs(self.reading.read_number(name)) for name, _ in step.powers]
        unit, size = self.units["N" if one.point else "N·m"], self.reading.read_number(number)
        told = f"{'·'.join(letters)} = {'·'.join(self._factors(factors, abs(size)))}"
        return f"{one.name} = {told} = {self.context.known(abs(size))} {unit}"

    def _factors(self, factors: Sequence[float], size: float) -> Iterator[str]:
        """Return the factors with the fewest digits that give the printed product."""
        if not isfinite(size):  # a factor is not readable on its plan
            return map(self.short, factors)
        wanted = significant(size)
        for digits in (3, 4):
            texts = [trimmed(one, None if _has_few_digits(one) else digits) for one in factors]
            if significant(prod(map(float, texts))) == wanted:
                return map(self.context.notation.number, texts)
        return map(self.short, factors)

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
        if not value or self._is_noise(load):
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

    def _is_noise(self, load: GivenLoad) -> bool:
        """Return whether a couple of inertia is of an angular acceleration that is rounding."""
        one, solution = load.applied, self.context.solution
        if one.kind is not LoadKind.INERTIA_COUPLE:
            return False
        epsilon = float(solution.links[one.link].epsilon[self.reading.index])
        return is_noise(epsilon, solution_peak(solution, QuantityKind.EPSILON))

    def _external(self, load: GivenLoad, force: complex, couple: float) -> str:
        symbol, solution = load.applied.name, self.context.solution
        narrator = SpringNarrator(solution.problem, self.context.language)
        formula = narrator.formula(solution, load.applied, self.reading.index)
        symbol = f"{symbol} = {formula}" if formula else symbol
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


def headed(head: str) -> str:
    """Return a head of a table with a capital, if it is a word."""
    return head if head.startswith(("ρ", "φ")) else capitalized(head)


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
        rate, (on, by) = float(pair.rate[i]), pair.rubbed
        sliding = pair.slide is not None
        frame, link = (said.on_frame, said.on_link) if sliding else (said.to_frame, said.to_link)
        facts = {
            "joint": point_name(pair.joint),
            "reach": self.reach(pair),
            "on": on,
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
        balancing, problem = self.context.reading.balancing, self.context.solution.problem
        symbol = self.symbol(balancing.symbol)
        three = (friction.without, once, friction.converged)[: 2 if jammed else 3]
        rows = [(symbol, balancing.unit, [float(one.balance[i]) for one in three])]
        for other in problem.drive.other_drives:
            values = [float(one.other_balances[other.link][i]) for one in three]
            own = self.symbol(problem.balancer_of(other))
            rows.append((own, other.balancing.unit, values))
        for letter, unit, values in rows:
            away = -1.0 if self.sizes and max(values) < 0 else 1.0
            told = [f"{self.computed(away * value)} {self.units[unit]}" for value in values]
            facts = {"symbol": letter, "without": told[0], "once": told[1]}
            template = texts.balance_jammed if jammed else texts.balance
            yield template.format(converged=told[-1], **facts)
        if jammed:
            yield texts.jams
            return
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
        several = texts.efficiency_several if drives else texts.efficiency_back_several
        one = texts.efficiency if drives else texts.efficiency_back
        yield (several if problem.drive.other_drives else one).format(eta=quotient)
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
