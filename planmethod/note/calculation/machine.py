"""The flywheel of a machine as a calculation, by positions (расчёт маховика по положениям).

The moment and the inertia reduced to the crank follow from the velocities of the chapter on motion,
work by trapezoids between positions. The program itself integrates between positions, too: its
values are beside those of the table.
"""

# no messages: formulas

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, pi

import numpy as np

from planmethod.note.calculation.expression import (
    Accumulated,
    Call,
    Name,
    Number,
    Operation,
)
from planmethod.note.calculation.model import CalculationBuilder
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.balancing import ReducedTerm, ReductionNarrator
from planmethod.note.narrate.machine import MachineNarrator
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language
from planmethod.problem.machine_records import Quadrature, WheelShape
from planmethod.solved.machine.flywheel import RIM_BORE, Flywheel, density_of, machine_power
from planmethod.solved.reading import Reals


class FlywheelChapter:
    """Writes the flywheel into a calculation that has the motion in the same positions.

    Parameters
    ----------
    narrator : MachineNarrator
    builder : CalculationBuilder
    language : Language
    """

    def __init__(
        self, narrator: MachineNarrator, builder: CalculationBuilder, language: Language
    ) -> None:
        self.narrator, self.builder, self.language = narrator, builder, language
        self.flywheel: Flywheel = narrator.flywheel
        self.texts, self.units = language.calculation, language.notation.units
        self.problem = self.flywheel.problem
        self.omega = f"|ω_{{{self.problem.drive.link}}}|"
        self.count = self.flywheel.machine.count

    def write(self) -> None:
        """Write the reduction, the work, the flywheel, its sizes and the power."""
        self.builder.add_heading(self.texts.reduction.format())
        self._moments()
        self._energies()
        self.builder.add_heading(self.texts.work.format())
        self._work()
        self.builder.add_heading(self.texts.flywheel.format())
        self._flywheel()
        self._sizes()
        self._power()

    # Reduction ---------------------------------------------------------------------------------

    def _speed(self, point: str, axis: str) -> Rich:
        """Return the letter of a projection of a velocity; empty where it is always zero."""
        symbol = f"v_{{{point}{axis}}}"
        return symbol if symbol in self.builder.symbols else ""

    def _force(self, term: ReducedTerm, axis: str, values: Reals) -> Rich:
        """Return the letter of a projection of a load, which is given by positions."""
        head, brace, tail = term.name.rpartition("_{")
        symbol = (
            f"{head}_{{{tail.removesuffix('}')}{axis}}}" if brace else f"{term.name}_{{{axis}}}"
        )
        known = self.builder.symbols.get(symbol)
        if known is not None and np.array_equal(
            np.broadcast_to(self.builder.values[known], values.shape), values
        ):
            return symbol
        if self._is_size(term.name, values):
            signs = [term.name if value >= 0.0 else f"{MINUS}{term.name}" for value in values]
            self.builder.row(symbol, signs, values.tolist(), self.units["N"])
            return symbol
        if np.ptp(values) == 0.0:
            self.builder.add_input(symbol, float(values[0]), self.units["N"])
        else:
            self.builder.value(symbol, values.tolist(), self.units["N"],
                               self.texts.by_position.format(), is_input=True)  # fmt: skip
        return symbol

    def _is_size(self, symbol: Rich, values: Reals) -> bool:
        """Return whether values are those of a known load with signs."""
        known = self.builder.symbols.get(symbol)
        if known is None:
            return False
        size = np.broadcast_to(self.builder.values[known], values.shape)
        near = 1e-12 * float(np.max(np.abs(size)))
        return bool(np.all(np.abs(np.abs(values) - np.abs(size)) <= near))

    def _weight(self, link: str) -> Rich:
        dynamics = self.problem.dynamics
        assert dynamics is not None
        self._mass(link)
        self.builder.add_input("g", dynamics.gravity, self.units["m/s²"])
        return f"m_{{{link}}}·g"

    def _mass(self, link: str) -> Rich:
        dynamics = self.problem.dynamics
        assert dynamics is not None
        symbol = f"m_{{{link}}}"
        self.builder.add_input(symbol, dynamics.masses[link].mass, self.units["kg"])
        return symbol

    def _power_of(self, term: ReducedTerm) -> Rich:
        """Return the power of a load in letters, as it resists."""
        if term.point is None:
            name = self.builder.symbols.get(term.name)
            if name is None or not np.array_equal(
                np.broadcast_to(self.builder.values[name], term.size.shape), term.size.real
            ):
                symbol = f"{term.name}"
                if np.ptp(term.size.real) == 0.0:
                    self.builder.add_input(symbol, float(term.size.real[0]), self.units["N·m"])
                else:
                    self.builder.value(symbol, term.size.real.tolist(), self.units["N·m"],
                                       self.texts.by_position.format(), is_input=True)  # fmt: skip
            return f"{MINUS}{term.name}·ω_{{{term.link}}}"
        if term.name == f"G_{{{term.link}}}" and not np.any(term.size.real):
            speed = self._speed(term.point, "y")
            sign = "" if term.counted > 0 else MINUS
            return f"{sign}{self._weight(term.link)}·{speed}" if speed else ""
        parts = [
            f"{self._force(term, axis, values)}·{speed}"
            for axis, values in (("x", term.size.real), ("y", term.size.imag))
            if np.any(np.abs(values) > 1e-12 * np.max(np.abs(term.size)))
            and (speed := self._speed(term.point, axis))
        ]
        return f"{MINUS}({' + '.join(parts)})" if parts else ""

    def _moments(self) -> None:
        sign, letters = self.flywheel.sign, list[Rich]()
        for term in ReductionNarrator(self.narrator).terms:
            power = self._power_of(term)
            symbol = f"M_{{{term.name.replace('_{', '').replace('^{', '').replace('}', '')}}}"
            if not power:
                continue
            whole = fraction(power, self.omega)
            self.builder.row(symbol, whole if sign > 0 else f"{MINUS}{whole}",
                             sign * term.moment, self.units["N·m"])  # fmt: skip
            letters.append(symbol)
        self.builder.row(self.narrator.moment, " + ".join(letters),
                         sign * self.flywheel.rows.moment, self.units["N·m"])  # fmt: skip

    def _energies(self) -> None:
        dynamics, kgm2 = self.problem.dynamics, self.units["kg·m²"]
        assert dynamics is not None
        links, crank = list[Rich](), self.problem.drive.link
        rows = self.flywheel.rows
        for link, share in rows.parts.links.items():
            mass, parts = dynamics.masses[link], list[Rich]()
            if mass.mass and mass.centre is not None:
                squares = [f"{v}^{{2}}" for axis in "xy" if (v := self._speed(mass.centre, axis))]
                if squares:
                    parts.append(f"{self._mass(link)}·({' + '.join(squares)})")
            turning = f"ω_{{{link}}}"
            if mass.inertia and turning in self.builder.symbols:
                self.builder.add_input(f"J_{{S{link}}}", mass.inertia, kgm2)
                parts.append(f"J_{{S{link}}}·{turning}^{{2}}")
            if parts:
                symbol = f"J_{{r{link}}}"
                self.builder.row(symbol, fraction(" + ".join(parts), f"ω_{{{crank}}}^{{2}}"),
                                 share, kgm2)  # fmt: skip
                links.append(symbol)
        own = self.flywheel.machine.crank_inertia
        if own:
            symbol = self.narrator.letter("crank inertia")
            self.builder.add_input(symbol, own, kgm2)
            links.append(symbol)
        if links:
            letters = self.narrator.letter("reduced inertia")
            self.builder.row(letters, " + ".join(links), rows.inertia, kgm2)

    # Work --------------------------------------------------------------------------------------

    def _name(self, symbol: Rich) -> Name:
        return Name(self.builder.symbols[symbol])

    def _exact(self, symbol: Rich) -> Rich:
        """Return the letter of the program's value of a quantity."""
        return self._indexed(symbol, self.texts.exact)

    @staticmethod
    def _indexed(symbol: Rich, word: str) -> Rich:
        head, brace, tail = symbol.rpartition("_{")
        index = f"{tail.removesuffix('}')}, " if brace else ""
        return f"{head if brace else symbol}_{{{index}{word}}}"

    def _work(self) -> None:
        builder, flywheel, narrator = self.builder, self.flywheel, self.narrator
        self.points = flywheel.by_points(self.count, Quadrature.TRAPEZOID, flywheel.exact_slopes)
        points, joule = self.points, self.units["J"]
        builder.add_input("φ_{c}", degrees(flywheel.cycle), "°", self.texts.cycle.format())
        builder.formula("n_{φ}", Call("count", (self._name(narrator.moment),)), self.count)
        step = builder.formula("Δφ", fraction("φ_{c}·π", "180·n_{φ}"),
                               flywheel.cycle / self.count, self.units["rad"])  # fmt: skip
        builder.value("k", range(self.count), "", self.language.note.number)
        moment = self._name(narrator.moment)
        area = Accumulated(moment, Name(step.name))
        work = builder.row(narrator.work, area, points.work[:-1], joule,
                           self.texts.trapezoids.format())  # fmt: skip
        whole = Operation(
            "+", Call("last", (Name(work.name),)),
            Operation("*", Operation("/", Operation(
                "+", Call("last", (moment,)), Call("first", (moment,))), Number(2.0)),
                Name(step.name)),
        )  # fmt: skip
        builder.formula("A_{c}", whole, float(points.work[-1]), joule, self.texts.of_cycle.format())
        kept = narrator.letter(f"{narrator.keeps} moment")
        builder.formula(kept, fraction("A_{c}", "n_{φ}·Δφ"),
                        float(points.work[-1]) / flywheel.cycle, self.units["N·m"])  # fmt: skip
        gain = f"{kept}·k·Δφ − {narrator.work}"
        builder.row(narrator.letter("energy gain"),
                    gain if flywheel.sign > 0 else f"{narrator.work} − {kept}·k·Δφ",
                    points.gain[:-1].tolist(), joule)  # fmt: skip
        exact = self.texts.integrated.format()
        builder.value(self._exact(narrator.work), flywheel.rows.work.tolist(), joule, exact)
        builder.value(
            self._exact(narrator.letter("energy gain")), flywheel.rows.gain.tolist(), joule, exact
        )

    def _flywheel(self) -> None:
        builder, flywheel, narrator = self.builder, self.flywheel, self.narrator
        kgm2, joule = self.units["kg·m²"], self.units["J"]
        speed, inertia = narrator.letter("mean speed"), narrator.letter("reduced inertia")
        gain = narrator.letter("energy gain")
        builder.add_input("δ", flywheel.machine.delta)
        if flywheel.middle_speed == abs(self.problem.drive.rate):
            builder.formula(speed, self.omega, flywheel.middle_speed, self.units["1/s"])
        else:
            builder.value(speed, flywheel.middle_speed, self.units["1/s"],
                          self.texts.mean_in_time.format())  # fmt: skip
        points, found = self.points, list[Rich]()
        ends = zip(("max", "min"), "KL", "+−", flywheel.exact_slopes, strict=True)
        for name, end, sign, slope in ends:
            symbol = f"E_{{{name}}}"
            half = fraction(f"(1 {sign} {fraction('δ', '2')})^{{2}}·{speed}^{{2}}", "2")
            values = points.gain - slope * flywheel.middle_speed**2 / 2.0 * points.inertia
            letters = f"{gain} − {half}·{inertia}" if inertia in builder.symbols else gain
            row = builder.row(symbol, letters, values[:-1].tolist(), joule)
            extreme = f"T_{{{end}}}"
            value = points.tangents.upper if name == "max" else points.tangents.lower
            builder.formula(extreme, Call(name, (Name(row.name),)), value, joule)
            found.append(extreme)
        wheel = narrator.letter("flywheel")
        builder.formula(wheel, fraction(" − ".join(found), f"{speed}^{{2}}·δ"),
                        points.tangents.inertia, kgm2, self.texts.by_table.format())  # fmt: skip
        builder.value(self._exact(wheel), flywheel.exact.inertia, kgm2,
                      self.texts.exact_flywheel.format())  # fmt: skip

    def _sizes(self) -> None:
        builder, wheel, sizes = self.builder, self.flywheel.machine.wheel, self.narrator.sizes
        if sizes is None:
            return
        builder.add_heading(self.texts.sizes.format())
        builder.add_input("ρ", density_of(wheel), self.units["kg/m³"])
        own = self._indexed(self.narrator.letter("flywheel"), self.texts.taken)
        builder.value(own, sizes.inertia, self.units["kg·m²"],
                                self.texts.adopted.format(), is_input=True)  # fmt: skip
        metre, hollow = self.units["m"], wheel.shape is not WheelShape.DISC
        builder.value("D", sizes.diameter, metre, self.texts.round.format(), is_input=True)
        bore = ""
        if hollow:
            builder.formula("D_{1}", f"{RIM_BORE}·D", sizes.bore, metre)
            bore = "D_{1}^{2}"
        builder.formula("m_{m}", fraction(f"8·{own}", f"D^{{2}} + {bore}" if bore else "D^{2}"),
                        sizes.mass, self.units["kg"])  # fmt: skip
        area = f"(D^{{2}} − {bore})" if bore else "D^{2}"
        builder.formula("b", fraction("4·m_{m}", f"π·ρ·{area}"), sizes.width, metre)
        speed = self.narrator.letter("mean speed")
        ratio = "" if wheel.ratio == 1.0 else f"{wheel.ratio!r}·"
        builder.formula("v_{D}", fraction(f"{ratio}{speed}·D", "2"), sizes.speed,
                        self.units["m/s"])  # fmt: skip

    def _power(self) -> None:
        builder, power, watt = self.builder, machine_power(self.flywheel), self.units["W"]
        builder.add_heading(self.texts.power.format())
        speed, crank = self.narrator.letter("mean speed"), self.narrator.letter("power")
        value = float(self.points.work[-1]) * self.flywheel.middle_speed / self.flywheel.cycle
        builder.formula(crank, fraction(f"A_{{c}}·{speed}", "n_{φ}·Δφ"), value, watt,
                        self.texts.by_table.format())  # fmt: skip
        builder.value(self._exact(crank), power.at_crank, watt, self.texts.integrated.format())
        if power.efficiency is not None and power.at_motor is not None:
            builder.add_input("η", power.efficiency)
            motor = self.narrator.letter("motor power")
            builder.formula(motor, fraction(crank, "η"), value / power.efficiency, watt)


def turns_through(positions: Sequence[float], flywheel: Flywheel) -> bool:
    """Return whether positions of the crank are those of the flywheel's table."""
    own = flywheel.turn.phi(flywheel.even_rotations(flywheel.machine.count))
    if len(own) != len(positions):
        return False
    off = (np.asarray(positions) - own + 180.0) % 360.0 - 180.0
    return bool(np.all(np.abs(off) < 1e-9 * 180.0 / pi))
