"""Reduction to the crank and static balancing, term by term (приведение, уравновешивание)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TypeAlias

import numpy as np
from msgspec import Struct

from planmethod.note.formula import Rich, capitalized, fraction
from planmethod.note.narrate.forces.statement import largest_symbol
from planmethod.note.narrate.machine import MachineNarrator
from planmethod.note.numbers import MINUS, format_column
from planmethod.note.series import compared_moment
from planmethod.note.wording import Language
from planmethod.problem.machine_records import WeightSigns
from planmethod.problem.records import Spring, largest_size
from planmethod.solved.forces.loads import external, power
from planmethod.solved.machine.balancing import Balancing, balancing_of
from planmethod.solved.reading import Complexes, Reals
from planmethod.solved.solution import Solution

_Column: TypeAlias = tuple[str, str, list[str]]

_ZERO_RATIO = 1e-9  # share of the largest value of a column below which a value is rounded zero


class ReducedTerm(Struct, frozen=True):
    """One force or couple that is reduced to the crank (слагаемое приведённого момента).

    Attributes
    ----------
    name : str
    point : str or None
        Point of action of a force; None for a couple.
    link : str
    size : Complexes
        Force, N, or couple, N·m (a real number as a complex one), in every position.
    speed : Complexes
        Velocity of the point, m/s, or angular velocity, 1/s.
    moment : Reals, N·m
        Its moment reduced to the crank, positive where it resists.
    counted : float
        -1 where the file has weights added with the other sign.
    """

    name: str
    point: str | None
    link: str
    size: Complexes
    speed: Complexes
    moment: Reals
    counted: float = 1.0


class ReductionNarrator:
    """Narrates the reduction of the loads and masses of a machine to its crank."""

    def __init__(self, narrator: MachineNarrator) -> None:
        self.narrator, self.notation, self.flywheel = narrator, narrator.notation, narrator.flywheel
        flywheel = self.flywheel
        self.problem, self.count = flywheel.problem, flywheel.machine.count
        self.motion = flywheel.solved(self.count)
        self.order = np.argsort(flywheel.turn.numbers(self.count)[:-1])
        self.omega = f"ω_{{{self.problem.drive.link}}}"
        self.terms = [*self._loads(), *self._weights()]

    @cached_property
    def _peaks(self) -> dict[str, float]:
        """The largest size of each load of the file, N or N·m; springs have none."""
        dynamics = self.problem.dynamics
        assert dynamics is not None
        loads = (load for load in dynamics.loads if not isinstance(load.size, Spring))
        return {load.name: abs(largest_size(load.size)) for load in loads}

    def _loads(self) -> Iterator[ReducedTerm]:
        dynamics = self.problem.dynamics
        assert dynamics is not None
        rate = abs(self.problem.drive.rate)
        for link in self.problem.mechanism.links:
            for one in external(self.motion, dynamics, link):
                moment = -power(self.motion, one) / rate
                if one.point is None:
                    turning = self.motion.links[link].omega
                    size, speed = (np.asarray(x, dtype=complex) for x in (one.couple, turning))
                else:
                    size, speed = one.force, self.motion.points[one.point].velocity
                yield ReducedTerm(one.name, one.point, link, size, speed, moment)

    def _weights(self) -> Iterator[ReducedTerm]:
        dynamics, rate = self.problem.dynamics, abs(self.problem.drive.rate)
        assert dynamics is not None
        sign = -1.0 if self.flywheel.machine.signs is WeightSigns.SOURCE else 1.0
        for link, mass in dynamics.masses.items():
            if mass.centre is None or not mass.mass or not dynamics.gravity:
                continue
            speed = self.motion.points[mass.centre].velocity
            weight = mass.mass * dynamics.gravity
            moment = sign * weight * speed.imag / rate
            if np.abs(speed).max() > _ZERO_RATIO * rate:
                size = np.full(speed.shape, -1j * weight)
                yield ReducedTerm(f"G_{{{link}}}", mass.centre, link, size, speed, moment, sign)

    # Moments ---------------------------------------------------------------------------------

    def _format_column(self, values: Reals, digits: int = 4) -> list[str]:
        values = values[self.order]
        peak = float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
        clean = np.where(np.abs(values) < _ZERO_RATIO * peak, 0.0, values)
        told = iter(format_column(clean[np.isfinite(clean)].tolist(), digits))
        return [
            "—" if np.isnan(one) else self.notation.number(next(told)) for one in clean.tolist()
        ]

    def _column(self, head: Rich, values: Reals, unit: str, digits: int = 4) -> _Column:
        return (
            head,
            self.notation.in_head(unit) if unit else "",
            self._format_column(values, digits),
        )

    def _speed(self, term: ReducedTerm) -> Rich:
        return f"ω_{{{term.link}}}" if term.point is None else f"v_{{{term.point}}}"

    def _angle(self, term: ReducedTerm) -> Rich:
        return f"α_{{{_index_text(term.name)}}}"

    def _number_columns(self) -> Iterator[_Column]:
        yield self.narrator.language.note.number, "", [str(k) for k in range(len(self.order))]

    def moments(self) -> list[_Column]:
        """Return the table of the reduced moment: loads, velocities, angles, reduced moments."""
        columns, speeds = [*self._number_columns()], set[str]()
        for term in self.terms:
            size = np.abs(term.size)
            peak = self._peaks.get(term.name, float(size.max()))
            if float(np.ptp(size)) > _ZERO_RATIO * peak:
                if term.name in self._peaks:
                    most = largest_symbol(term.name)
                    columns.append(self._column(fraction(term.name, most), size / peak, ""))
                columns.append(self._column(term.name, size, "N·m" if term.point is None else "N"))
            speed = self._speed(term)
            if speed not in speeds:
                speeds.add(speed)
                value = term.speed.real if term.point is None else np.abs(term.speed)
                columns.append(self._column(speed, value, "1/s" if term.point is None else "m/s"))
            if term.point is not None:
                columns.append(self._column(self._angle(term), self.angle(term), "deg"))
        sign = self.flywheel.sign
        for term in self.terms:
            head = f"M_{{{_index_text(term.name)}}}"
            columns.append(self._column(head, sign * term.moment, "N·m"))
        columns.append(self._column(self.narrator.moment, sign * self.flywheel.rows.moment, "N·m"))
        return columns

    @staticmethod
    def angle(term: ReducedTerm) -> Reals:
        """Return the angle between a force and the velocity, degrees; NaN where either is zero."""
        size, speed = np.abs(term.size), np.abs(term.speed)
        there = (size > _ZERO_RATIO * size.max()) & (speed > _ZERO_RATIO * speed.max())
        turned = np.abs(np.degrees(np.angle(term.size * term.speed.conjugate())))
        return np.where(there, np.round(turned, 9), np.nan)

    def moment_formula(self) -> Rich:
        """Return the reduced moment with its terms."""
        text = ""
        for term in self.terms:
            factors = [term.name, self._speed(term)]
            factors += [] if term.point is None else [f"cos {self._angle(term)}"]
            # A resisting load has a negative power, and counts as positive.
            minus = (term.counted > 0) is (self.flywheel.sign > 0)
            sign = MINUS if minus else "+"
            text += f" {sign} {'·'.join(factors)}" if text or minus else "·".join(factors)
        text = text.strip()
        text = f"{MINUS}{text[2:]}" if text.startswith(f"{MINUS} ") else text
        return f"{self.narrator.moment} = {fraction(text, self.omega)}"

    # Energies --------------------------------------------------------------------------------

    def energies(self) -> dict[str, Reals]:
        """Return the kinetic energies by link, J, the crank's including the parts on it."""
        half = self.problem.drive.rate**2 / 2.0
        found = {link: half * share for link, share in self.flywheel.rows.parts.links.items()}
        crank, own = self.problem.drive.link, self.flywheel.machine.crank_inertia
        if own:
            mine = found.pop(crank, np.zeros(self.motion.positions.shape)) + half * own
            found = {crank: mine, **found}
        return {link: energy for link, energy in found.items() if np.any(energy)}

    def energy_columns(self) -> list[_Column]:
        """Return the table of the energies and of the reduced moment of inertia."""
        columns = [*self._number_columns()]
        for link, energy in self.energies().items():
            columns.append(self._column(f"T_{{{link}}}", energy, "J"))
        rows, half = self.flywheel.rows, self.problem.drive.rate**2 / 2.0
        columns.append(self._column("T", rows.inertia * half, "J"))
        columns.append(self._column(self.narrator.letter("reduced inertia"), rows.inertia, "kg·m²"))
        return columns

    def energy_formulas(self) -> list[Rich]:
        """Return the energies of the links, their sum and the reduced moment of inertia."""
        dynamics, lines = self.problem.dynamics, []
        assert dynamics is not None
        links = list(self.energies())
        for link in links:
            parts, mass = [], dynamics.masses.get(link)
            omega = f"ω_{{{link}}}^{{2}}"
            centre = None if mass is None or not mass.mass else mass.centre
            if centre is not None and np.any(self.motion.points[centre].velocity):
                parts.append(fraction(f"m_{{{link}}}·v_{{{centre}}}^{{2}}", "2"))
            if mass is not None and mass.inertia and np.any(self.motion.links[link].omega):
                parts.append(fraction(f"J_{{S{link}}}·{omega}", "2"))
            if link == self.problem.drive.link and self.flywheel.machine.crank_inertia:
                parts.append(fraction(f"{self.narrator.letter('crank inertia')}·{omega}", "2"))
            lines.append(f"T_{{{link}}} = {' + '.join(parts)}")
        lines.append(f"T = {' + '.join(f'T_{{{link}}}' for link in links)}")
        inertia = self.narrator.letter("reduced inertia")
        return [*lines, f"{inertia} = {fraction('2T', f'{self.omega}^{{2}}')}"]


def _index_text(name: str) -> str:
    """Return a letter as used in an index: ``G3`` of ``G_{3}``."""
    return name.replace("_{", "").replace("^{", "").replace("}", "")


COUNT = 12
"""Positions of the table."""


class BalancingNarrator:
    """Narrates the balancing of a solution in a language."""

    def __init__(self, solution: Solution, language: Language) -> None:
        self.balancing: Balancing = balancing_of(solution)
        self.profile, self.language, self.notation = solution.profile, language, language.notation
        self.texts = language.machine

    def unit(self, name: str) -> str:
        """Return the letters of a unit."""
        return self.notation.units[name]

    def _amount(self, value: float, unit: str) -> str:
        return f"{self.notation.computed(value)} {self.unit(unit)}"

    def lines(self) -> list[str]:
        """Return all of it with numbers, a sentence each."""
        made, texts = self.balancing, self.texts
        method = texts["weighings"][made.task.method.value]
        if made.task.share is not None:
            method += f", k = {self.notation.as_input(made.task.share)}"
        lines = [capitalized(f"{texts['structures'][made.structure]}, {method}")]
        a, b = made.crank_pin, made.rod_pin
        places = {"link": made.rod, "A": a, "B": b}
        if abs(made.share.imag) > 1e-9 * max(abs(made.share), 1.0):
            lines.append(texts.off_line.format(**places))
        elif any(made.rod_masses):
            one, two = (
                f"m_{{{made.rod}{pin}}} = {self._amount(mass.real, 'kg')}"
                for pin, mass in zip((a, b), made.rod_masses, strict=True)
            )
            lines.append(texts.substituted.format(**places, one=one, two=two))
        for number, one_weight in enumerate(made.counterweights):
            if not one_weight.mass:
                lines.append(texts.no_weight.format(link=one_weight.link))
                continue
            both = compared_moment(made, number, self.profile)
            text = texts.weight.format(
                link=one_weight.link,
                terms=" + ".join(name.replace(" ", "\u00a0") for name, _ in one_weight.terms),
                moment=self._amount(both.exact, "kg·m"),
                radius=f"{self.notation.as_input(one_weight.radius)} {self.unit('m')}",
                mass=self._amount(one_weight.mass, "kg"),
                angle=self.notation.number(f"{one_weight.angle_deg:.1f}"),
                line=one_weight.pivot + one_weight.pin,
            )
            lines.append(
                f"{text} ({texts.measured.format(moment=self._amount(both.read, 'kg·m'))})"
            )
        return [*lines, *self._result_lines()]

    def _result_lines(self) -> list[str]:
        made, texts = self.balancing, self.texts
        before, after = made.largest
        after = 0.0 if after < _ZERO_RATIO * before else after
        lines = [
            texts.force_falls.format(
                before=self._amount(before, "N"), after=self._amount(after, "N")
            )
        ]
        centres = made.centres(360)
        spread = [_spread(column) for column in centres]
        masses = {
            "bare": self._amount(made.mass_before, "kg"),
            "whole": self._amount(made.mass_after, "kg"),
        }
        if spread[1] > _ZERO_RATIO * spread[0]:
            ways = (self._amount(value, "m") for value in spread)
            places = dict(zip(("before", "after"), ways, strict=True))
            return [*lines, texts.centre_moves.format(**places, **masses)]
        x, y = float(centres[1][0].real), float(centres[1][0].imag)
        size = abs(complex(x, y)) * 1e-9
        place = {
            "x": self.notation.computed(x if abs(x) > size else 0.0),
            "y": self.notation.computed(y if abs(y) > size else 0.0),
        }
        return [*lines, texts.centre_stands.format(**place, unit=self.unit("m"), **masses)]

    def columns(self) -> list[_Column]:
        """Return the main vector by positions: heads, units and cells of its columns."""
        made = self.balancing
        turn = [f"{round(phi % 360.0, 1) % 360.0:.1f}" for phi in made.phi(COUNT).tolist()]
        found: list[_Column] = [
            (self.language.note.number, "", [str(k) for k in range(COUNT)]),
            (f"φ_{{{made.crank}}}", "deg", [self.notation.number(a) for a in turn]),
        ]
        size = made.largest[0]
        for letters, force in zip(("F_{0}", "F"), made.forces(COUNT), strict=True):
            parts = (("^{x}", force.real), ("^{y}", force.imag), ("", np.abs(force)))
            for index, values in parts:
                clean = np.where(np.abs(values) < _ZERO_RATIO * size, 0.0, values)
                head = letters.replace("F", f"F{index}", 1)
                told = [self.notation.number(text) for text in format_column(clean.tolist())]
                found.append((head, "N", told))
        return found

    def weights(self) -> list[_Column]:
        """Return the counterweights as columns."""
        some = [one for one in self.balancing.counterweights if one.mass]

        def column(head: str, unit: str, values: list[float]) -> _Column:
            return head, unit, [self.notation.computed(value) for value in values]

        return [
            (self.texts.weights_table, "", [one.link for one in some]),
            column("m·r", "kg·m", [abs(one.moment) for one in some]),
            column("r", "m", [one.radius for one in some]),
            column("m", "kg", [one.mass for one in some]),
            ("α", "deg", [self.notation.number(f"{one.angle_deg:.1f}") for one in some]),
        ]


def _spread(column: Complexes) -> float:
    """Return the diagonal of the box that a point moves in."""
    return float(np.hypot(np.ptp(column.real), np.ptp(column.imag)))
