"""The text on a machine and its flywheel: given data and calculation (расчёт маховика)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from math import degrees, isinf, pi
from typing import TypeAlias

import numpy as np
from msgspec.structs import replace

from planmethod.construct.scale import Scale
from planmethod.note import formula
from planmethod.note.compared import ComparedNumber
from planmethod.note.document import GivenFact
from planmethod.note.narrate.forces.statement import load_facts, mass_lines
from planmethod.note.narrate.naming import scale_inscription
from planmethod.note.narrate.statement import angle_with_positions, given_facts, turns_symbol
from planmethod.note.numbers import format_column, half_up
from planmethod.note.series import compared_flywheel, compared_segment
from planmethod.note.wording import Language, MessageTable
from planmethod.problem.machine_records import ConstantMoment, WeightSigns
from planmethod.problem.model import Convention
from planmethod.solved.machine.chain import rotor_inertia
from planmethod.solved.machine.drawing import FlywheelDrawing
from planmethod.solved.machine.flywheel import (
    DISC_WIDTH,
    RIM_BORE,
    RIM_WIDTH,
    STEEL_FACTOR,
    Flywheel,
    FlywheelSizes,
    SpeedExtreme,
    adopted,
    density_of,
    machine_power,
    size_of,
)
from planmethod.solved.machine.runup import (
    MAX_CYCLES,
    STEADY_SPEED_TOLERANCE,
    RunUp,
    TimeMotion,
    run_up_of,
)
from planmethod.solved.reading import Reals

_Column: TypeAlias = tuple[str, str, list[str]]


class MachineNarrator:
    """Narrates a machine and the choice of its flywheel in a language (рассказ о маховике).

    Parameters
    ----------
    drawing : FlywheelDrawing
    language : Language
    """

    def __init__(self, drawing: FlywheelDrawing, language: Language) -> None:
        self.drawing, self.language, self.notation = drawing, language, language.notation
        self.flywheel: Flywheel = drawing.flywheel
        self.texts: MessageTable = language.machine
        resisting = self.flywheel.machine.constant is ConstantMoment.DRIVING
        self.changes, self.keeps = ("resisting", "driving")[:: 1 if resisting else -1]

    def letter(self, name: str) -> str:
        """Return the letters of a quantity."""
        return self.notation.symbol(name)

    @property
    def moment(self) -> str:
        """Letters of the moment that changes."""
        return self.letter(f"{self.changes} moment")

    @property
    def work(self) -> str:
        """Letters of its work."""
        return self.letter(f"{self.changes} work")

    def unit(self, name: str) -> str:
        """Return the letters of a unit."""
        return self.notation.units[name]

    def scale(self, letter: str, per_mm: float, unit: str) -> str:
        """Return the inscription of a scale; one that follows from others with four digits."""
        if letter in ("A", "T", "φ"):
            per_mm = float(f"{per_mm:.4g}")
        return scale_inscription(Scale(f"mu_{letter}", per_mm, unit), Convention.UNIT_PER_MM,
                                 self.notation)  # fmt: skip

    def _value(self, letter: str, per_mm: float, unit: str) -> str:
        """Return the value of a scale as it is inscribed."""
        return self.scale(letter, per_mm, unit).partition(" = ")[2]

    # Given and wanted ------------------------------------------------------------------------

    def given_facts(self) -> list[GivenFact]:
        """Return the given facts, without a position: the machine goes through all of them."""
        machine, problem = self.flywheel.machine, self.flywheel.problem
        assert problem.dynamics is not None
        _, *lines = given_facts(problem, self.language, [self.flywheel.turn.start_deg])
        lines += mass_lines(problem, self.language) + load_facts(problem, self.language)
        if machine.crank_inertia:
            inertia = self.notation.as_input(machine.crank_inertia)
            text = f"{self.letter('crank inertia')} = {inertia} {self.unit('kg·m²')}"
            lines.append(GivenFact(text, {"machine.J_crank": machine.crank_inertia}))
        lines.append(GivenFact(f"δ = {self.delta}", {"machine.delta": machine.delta}))
        if machine.efficiency is not None:
            value = self.notation.as_input(machine.efficiency)
            text = f"{self.texts.own_efficiency.format()} = {value}"
            lines.append(GivenFact(text, {"machine.efficiency": machine.efficiency}))
        lines += self._motors()
        speed = self.notation.computed(abs(problem.drive.rate))
        mean = self.texts["means"][machine.mean.value]
        text = f"{self.letter('mean speed')} = {mean.format()} = {speed} {self.unit('1/s')}"
        lines.append(GivenFact(text, {"machine.mean": machine.mean.value}))
        constant = f"{self.letter(f'{self.keeps} moment')} = const"
        lines.append(GivenFact(constant, {"machine.constant": machine.constant.value}))
        if machine.signs is WeightSigns.SOURCE:
            lines.append(GivenFact(self.texts.source_signs, {"machine.signs": "source"}))
        return lines

    def _motors(self) -> Iterator[GivenFact]:
        """Yield the motors to choose from."""
        notation = self.notation
        for motor in self.flywheel.machine.motors:
            power = f"{notation.as_input(motor.power / 1000.0)} {self.unit('kW')}"
            speed = f"{notation.as_input(motor.speed)} {self.unit('rev/min')}"
            inertia = f"{notation.as_input(motor.inertia)} {self.unit('kg·m²')}"
            text = self.texts["chain"]["given"].format(
                name=formula.escape(motor.name), power=power, n=speed, J=inertia
            )
            place = f"motors.{motor.name}"
            data: dict[str, object] = {
                f"{place}.power": motor.power,
                f"{place}.n": motor.speed,
                f"{place}.J": motor.inertia,
            }
            yield GivenFact(text, data)

    @property
    def delta(self) -> str:
        """Required coefficient of speed fluctuation, as ``1/n`` if n is an integer."""
        delta = self.flywheel.machine.delta
        inverse = 1.0 / delta
        if abs(inverse - round(inverse)) < 1e-9 * inverse:
            return formula.fraction("1", str(round(inverse)))
        return self.notation.as_input(delta)

    def unknowns(self) -> str:
        """Return the unknowns."""
        return self.texts.wanted.format(flywheel=self.letter("flywheel"))

    # Construction ----------------------------------------------------------------------------

    def by_method(self, key: str, **places: object) -> str:
        """Return what a key of the catalogue says of the file's method."""
        return str(self.texts[key][self.flywheel.machine.method.value]).format(**places)

    @property
    def tangent_positions(self) -> tuple[int, int]:
        """Numbers of the positions in which the tangents touch, or A and B are."""
        drawing, numbers = self.drawing, self.flywheel.turn.numbers(self.drawing.count)
        step, tangents = self.flywheel.cycle / drawing.count, drawing.points.tangents
        return numbers[round(tangents.at_max / step)], numbers[round(tangents.at_min / step)]

    @cached_property
    def segment(self) -> ComparedNumber:
        """KL or AB, mm."""
        return compared_segment(self.drawing)

    def _angle(self, value: float) -> str:
        return self.notation.number(f"{value:.2f}")

    def scale_formulas(self) -> list[str]:
        """Return the scales with numbers."""
        drawing, notation = self.drawing, self.notation
        scales, mm = drawing.scales, self.unit("mm")
        turn, pole = degrees(self.flywheel.cycle), notation.as_input(half_up(drawing.pole, 2))
        angles = [
            self._value("φ", degrees(scales.phi), "deg"), self._value("φ", scales.phi, "rad"),
        ]  # fmt: skip
        axis = formula.fraction(
            notation.as_input(turn), notation.as_input(half_up(drawing.length, 2))
        )
        lines = [" = ".join(["μ_{φ}", axis, *angles])]
        parts = f"{notation.as_input(scales.moment)}·{{}}{notation.computed(scales.phi)}"
        if self.flywheel.machine.pole_mm is None:
            above, below = notation.as_input(float(f"{scales.work:.4g}")), parts.format("")
            lines += [
                f"μ_{{A}} = μ_{{T}} = {self._value('A', scales.work, 'J')}",
                f"H_{{A}} = {formula.fraction('μ_{A}', 'μ_{M}·μ_{φ}')} = "
                f"{formula.fraction(above, below)} = {pole} {mm}",
            ]
        else:
            lines.append(
                f"μ_{{A}} = μ_{{T}} = μ_{{M}}·H_{{A}}·μ_{{φ}} = {parts.format(pole + '·')} = "
                + self._value("A", scales.work, "J")
            )
        return lines

    def sought_formulas(self) -> list[str]:
        """Return the angles of the tangents, or T_II with its ordinates and dT_I, with numbers."""
        omega = self.letter("mean speed")
        if self.drawing.by_mertsalov:
            return self._energies(omega)
        lines = []
        for name, factor, psi in zip(("max", "min"), "+−", self.drawing.psi, strict=True):
            tangent = self.notation.computed(float(np.tan(np.radians(psi))))
            sought = formula.fraction(f"μ_{{J}}·{omega}^{{2}}·(1 {factor} δ)", "2μ_{T}")
            lines.append(
                f"tg ψ_{{{name}}} = {sought} = {tangent}, ψ_{{{name}}} = {self._angle(psi)}°"
            )
        return lines

    def _energies(self, omega: str) -> list[str]:
        J, notation, mm = self.letter("reduced inertia"), self.notation, self.unit("mm")  # noqa: N806
        first, second = self.letter("first energy"), self.letter("second energy")
        work, start = self.drawing.scales.work, self.drawing.second_start
        speed = notation.computed(self.flywheel.middle_speed)
        shown = notation.as_input(float(f"{work:.4g}"))
        above = "" if not start else " − T_{0}"
        begins = f", T_{{0}} = {notation.short(start, 4)} {self.unit('J')}" if start else ""
        per_unit = notation.computed(self.flywheel.middle_speed**2 / (2.0 * work))
        factor = formula.fraction(f"{speed}^{{2}}", f"2·{shown}")
        less = f" − {notation.short(start / work, 4)}" if start else ""
        return [
            f"{second} = {formula.fraction(f'{J}·{omega}^{{2}}', '2')}{begins}",
            f"y_{{II}} = {formula.fraction(f'{second}{above}', 'μ_{T}')} = {factor}·{J}{less} = "
            f"{per_unit}·{J}{less}, {mm}",
            f"{first} = {self.letter('energy gain')} − {second}",
        ]

    def inertia_formula(self) -> str:
        """Return the flywheel by the construction, with numbers."""
        notation, segment = self.notation, self.drawing.construction.segment
        speed = notation.computed(self.flywheel.middle_speed)
        letters = formula.fraction(f"μ_{{T}}·{segment}", f"{self.letter('mean speed')}^{{2}}·δ")
        numbers = formula.fraction(
            f"{notation.computed(self.drawing.scales.work)}·{notation.measured(self.segment.read)}",
            f"{speed}^{{2}}·{notation.as_input(self.flywheel.machine.delta)}",
        )
        value = f"{notation.computed(self.inertia.read)} {self.unit('kg·m²')}"
        return f"{self.letter('flywheel')} = {letters} = {numbers} = {value}"

    @cached_property
    def inertia(self) -> ComparedNumber:
        """Flywheel by the construction beside the exact one, kg·m²."""
        return compared_flywheel(self.drawing)

    def largest_change(self) -> str:
        """Return the largest change of the flywheel's energy, of AB as it is measured."""
        value = self.notation.computed(self.drawing.scales.work * self.segment.read)
        symbol = self.letter("largest first energy")
        return f"{symbol} = μ_{{T}}·{self.drawing.construction.segment} = {value} {self.unit('J')}"

    def power_formulas(self) -> list[str]:
        """Return the mean power over the cycle, and that of the motor, with numbers."""
        flywheel, notation, watt = self.flywheel, self.notation, self.unit("W")
        power = machine_power(flywheel)
        minutes = 60 * flywheel.machine.turns
        turning = turns_symbol(flywheel.problem, self.language)
        n = notation.computed(flywheel.middle_speed * 30.0 / pi)
        work = notation.computed(flywheel.work_per_cycle)
        at_crank, at_motor = self.letter("power"), self.letter("motor power")
        lines = [
            f"{at_crank} = {formula.fraction(f'{self.work}·{turning}', str(minutes))} = "
            f"{formula.fraction(f'{work}·{n}', str(minutes))} = "
            f"{notation.computed(power.at_crank)} {watt}"
        ]
        if power.at_motor is None or power.efficiency is None:
            return lines
        share = notation.computed(power.efficiency)
        if len(power.parts) > 1:
            listed = "·".join(map(notation.computed, power.parts))
            lines.append(f"η = {self.texts.efficiencies.format()} = {listed} = {share}")
        lines.append(
            f"{at_motor} = {formula.fraction(at_crank, 'η')} = "
            f"{formula.fraction(notation.computed(power.at_crank), share)} = "
            f"{notation.computed(power.at_motor)} {watt}"
        )
        return lines

    def motor_choice(self) -> str:
        """Return the motor of the series that has the power; empty where none is sought."""
        rated = machine_power(self.flywheel).rated
        if rated is None:
            return ""
        power = f"{self.notation.as_input(rated / 1000.0)} {self.unit('kW')}"
        return self.texts.motor_chosen.format(power=power)

    def speed_extreme(self, extreme: SpeedExtreme) -> str:
        """Return the angle of the crank of an extreme speed."""
        phi = self.flywheel.turn.sense * degrees(extreme.rotation) + self.flywheel.turn.start_deg
        angle = self.texts.extreme.format(angle=self.notation.number(f"{phi % 360.0:.1f}"))
        return angle_with_positions(self.flywheel.problem, phi, angle, self.language)

    # Table -----------------------------------------------------------------------------------

    def columns(self) -> list[_Column]:
        """Return the table by positions: heads, units and cells of its columns, rich text."""
        flywheel, notation = self.flywheel, self.notation
        rows, lever = flywheel.rows, flywheel.lever(flywheel.machine.count)
        order = np.argsort(flywheel.turn.numbers(flywheel.machine.count)[:-1])

        def column(head: str, values: Reals, unit: str, digits: int = 4) -> _Column:
            values = values[order]
            peak = float(np.max(np.abs(values)))
            clean = np.where(np.abs(values) < 1e-9 * peak, 0.0, values)
            told = [notation.number(text) for text in format_column(clean.tolist(), digits)]
            return head, notation.in_head(unit), told

        energies = []
        if self.drawing.by_mertsalov:
            second = flywheel.links_energy(rows.inertia)
            energies = [
                column(self.letter("second energy"), second, "J"),
                column(self.letter("first energy"), rows.gain - second, "J"),
            ]
        return [
            (self.language.note.number, "", [str(k) for k in range(len(order))]),
            (
                f"φ_{{{flywheel.problem.drive.link}}}",
                notation.in_head("deg"),
                [*map(notation.crank_angle, rows.phi_deg[order].tolist())],
            ),
            column(self.moment, flywheel.sign * rows.moment, "N·m"),
            column(self.letter("moment by lever"), flywheel.sign * lever, "N·m"),
            column(self.work, rows.work, "J"),
            column(self.letter("energy gain"), rows.gain, "J"),
            column(self.letter("reduced inertia"), rows.inertia, "kg·m²"),
            *energies,
            column("dJ/dφ", rows.slope, "kg·m²"),
            column("ω", rows.omega, "1/s", 5),
            column("ε", rows.epsilon, "1/s²"),
        ]

    # Sizes -----------------------------------------------------------------------------------

    @cached_property
    def rotor(self) -> float:
        """Inertia of the rotor reduced to the crank, kg·m²; zero without ``[[motors]]``."""
        return rotor_inertia(self.flywheel)

    @property
    def made_inertia(self) -> float:
        """Inertia of the flywheel that is made, reduced to the crank, kg·m²: without the rotor."""
        return self.drawing.adopted - self.rotor

    @property
    def made_letter(self) -> str:
        """Its letter."""
        wheel = self.letter("flywheel")
        return f"J_{{{self.texts.rest}}}" if self.rotor else wheel

    @property
    def calculated(self) -> FlywheelSizes | None:
        """Sizes of the flywheel that is made, its diameter as the formula has it."""
        flywheel = self.flywheel
        return size_of(flywheel.machine.wheel, self.made_inertia, flywheel.middle_speed)

    @property
    def sizes(self) -> FlywheelSizes | None:
        """Sizes of the flywheel that is made: of the same inertia, its diameter round."""
        found = self.calculated
        return None if found is None else adopted(self.flywheel.machine.wheel, found)

    def on_shaft(self, ratio: float) -> FlywheelSizes | None:
        """Return the sizes of the flywheel on a shaft with a speed ratio to the crank."""
        flywheel = self.flywheel
        wheel = replace(flywheel.machine.wheel, ratio=ratio)
        found = size_of(wheel, self.made_inertia, flywheel.middle_speed)
        return None if found is None else adopted(wheel, found)

    def size_formulas(self) -> list[str]:
        """Return the formulas of the diameter, the mass and the width, with numbers."""
        found, sizes, wheel, notation = (
            self.calculated, self.sizes, self.flywheel.machine.wheel, self.notation,
        )  # fmt: skip
        assert found is not None and sizes is not None
        J, inertia = self.made_letter, notation.computed(sizes.inertia)  # noqa: N806
        J = J if wheel.ratio == 1.0 else f"J_{{{self.texts.own}}}"  # noqa: N806
        density, metre, kg = notation.computed(density_of(wheel)), self.unit("m"), self.unit("kg")
        hollow, share = bool(sizes.bore), notation.as_input(RIM_WIDTH if sizes.bore else DISC_WIDTH)
        if found.is_speed_limited:
            omega = self.letter("mean speed")
            turning = omega if wheel.ratio == 1.0 else f"{notation.as_input(wheel.ratio)}·{omega}"
            speeds = "v", turning
            numbers = (
                notation.as_input(wheel.greatest_speed),
                notation.computed(2 * found.speed / found.diameter),
            )
            diameter = " = ".join(formula.fraction(f"2·{a}", b) for a, b in (speeds, numbers))
        elif hollow or wheel.density is not None:
            rest = f"·(1 − {notation.as_input(RIM_BORE)}^{{4}})" if hollow else ""
            diameter = " = ".join(
                f"({formula.fraction(f'32·{a}', f'π·{share}·{b}{rest}')})^{{1/5}}"
                for a, b in ((J, "ρ"), (inertia, density))
            )
        else:
            factor = notation.as_input(STEEL_FACTOR)
            diameter = f"{factor}·{J}^{{1/5}} = {factor}·{inertia}^{{1/5}}"
        lines = [
            self.texts.diameter.format(
                formula=f"D = {diameter} = {notation.computed(found.diameter)} {metre}",
                value=f"D = {notation.as_input(sizes.diameter)} {metre}",
            )
        ]
        D, bore = notation.as_input(sizes.diameter), notation.as_input(round(sizes.bore, 6))  # noqa: N806
        if hollow:
            lines.append(f"D_{{1}} = {notation.as_input(RIM_BORE)}·D = {bore} {metre}")
        plus = ("D^{2} + D_{1}^{2}", f"{D}^{{2}} + {bore}^{{2}}")
        minus = (f"π·ρ·({plus[0].replace('+', '−')})",
                 f"π·{density}·({plus[1].replace('+', '−')})")  # fmt: skip
        if not hollow:
            plus, minus = ("D^{2}", f"{D}^{{2}}"), ("π·ρ·D^{2}", f"π·{density}·{D}^{{2}}")
        mass, width = (
            f"{notation.computed(sizes.mass)} {kg}",
            f"{notation.computed(sizes.width)} {metre}",
        )
        above = (f"8·{J}", f"8·{inertia}"), ("4·m", f"4·{notation.computed(sizes.mass)}")
        masses, widths = ("m", above[0], plus, mass), ("b", above[1], minus, width)
        for letter, tops, bottoms, value in (masses, widths):
            parts = (formula.fraction(*pair) for pair in zip(tops, bottoms, strict=True))
            lines.append(" = ".join([letter, *parts, value]))
        return lines

    def size_lines(self, sizes: FlywheelSizes) -> list[str]:
        """Return the sizes of a flywheel with numbers."""
        notation, metre = self.notation, self.unit("m")
        lines = [f"D = {notation.as_input(sizes.diameter)} {metre}"]
        if sizes.bore:
            lines.append(f"D_{{1}} = {notation.as_input(round(sizes.bore, 6))} {metre}")
        lines.append(f"b = {notation.computed(sizes.width)} {metre}")
        lines.append(f"m = {notation.computed(sizes.mass)} {self.unit('kg')}")
        lines.append(f"v = {notation.computed(sizes.speed)} {self.unit('m/s')}")
        if sizes.is_speed_limited:
            lines.append(self.speed_limit_text)
        return lines

    @property
    def speed_limit_text(self) -> str:
        """What limits the diameter: the permissible speed of the rim."""
        speed = self.notation.as_input(self.flywheel.machine.wheel.greatest_speed)
        return self.texts.held.format(speed=f"{speed} {self.unit('m/s')}")


ROWS = 13
"""Rows of a table of a run-up or a stop."""


def has_run_up(narrator: MachineNarrator) -> bool:
    """Return whether the file has a motor or a brake."""
    machine = narrator.flywheel.machine
    return machine.motor is not None or machine.brake is not None


def motor_line(narrator: MachineNarrator) -> list[str]:
    """Return the motor's characteristic with numbers."""
    motor, notation = narrator.flywheel.machine.motor, narrator.notation
    if motor is None:
        return []
    slip = motor.critical_slip
    phrase = narrator.texts.line if slip is None else narrator.texts.kloss
    places = {
        "M": narrator.letter("motor moment"),
        "moment": f"{notation.computed(motor.moment)} {narrator.unit('N·m')}",
        "slip": "" if slip is None else notation.computed(slip),
        "idle": f"{notation.computed(motor.idle)} {narrator.unit('1/s')}",
    }
    return [phrase.format(**places)]


def run_up_lines(narrator: MachineNarrator) -> list[str]:
    """Return the run-up, the steady motion with the motor, and the stop, with numbers."""
    run, notation, texts = run_up_of(narrator.flywheel), narrator.notation, narrator.texts
    lines = motor_line(narrator)
    if narrator.flywheel.machine.motor is not None:
        lines += _driven(run, narrator)
    places = {
        "M": narrator.letter("braking moment"),
        "brake": f"{notation.as_input(run.machine.brake or 0.0)} {narrator.unit('N·m')}",
    }
    if run.machine.motor is not None and run.failure is not None:
        return lines
    if run.stop is None:
        return [*lines, texts.not_stopped.format(count=MAX_CYCLES)]
    template = texts.braked if run.machine.brake else texts.coasted
    return [*lines, template.format(**places, **_ends(run.stop, narrator))]


def _ends(course: TimeMotion, narrator: MachineNarrator) -> dict[str, str]:
    turned = float(course.rotation[-1])
    return {
        "time": f"{narrator.notation.computed(float(course.time[-1]))} {narrator.unit('s')}",
        "angle": narrator.notation.number(f"{degrees(turned):.1f}"),
        "turns": narrator.notation.number(f"{turned / (2.0 * pi):.2f}"),
    }


def _driven(run: RunUp, narrator: MachineNarrator) -> list[str]:
    notation, texts, failure = narrator.notation, narrator.texts, run.failure
    unit, per_second = narrator.unit("kg·m²"), narrator.unit("1/s")
    motor = run.machine.motor
    assert motor is not None
    if failure is not None:
        if isinf(failure.time):
            return [texts.not_steady.format(count=MAX_CYCLES)]
        if failure.rotation == 0.0:
            moment = float(narrator.flywheel.moment.value([0.0])[0])
            places = {
                "M": narrator.letter("motor moment"),
                "R": narrator.moment,
                "motor": f"{notation.computed(motor.at(0.0))} {narrator.unit('N·m')}",
                "resists": f"{notation.computed(moment)} {narrator.unit('N·m')}",
            }
            return [texts.stays.format(**places)]
        time = f"{notation.computed(failure.time)} {narrator.unit('s')}"
        angle = notation.number(f"{degrees(failure.rotation):.1f}")
        return [texts.stalled.format(time=time, angle=angle)]
    wheel = f"{narrator.letter('flywheel')} = "
    fitted, wanted = narrator.flywheel.steady_inertia, run.required_inertia
    high, low = run.steady(fitted).extremes
    lines = [
        texts.ran_up.format(
            J=f"{wheel}{notation.computed(fitted)} {unit}",
            near=notation.as_input(100.0 * STEADY_SPEED_TOLERANCE),
            **_ends(run.run_up, narrator),
        ),
        texts.steady.format(
            high=f"{notation.computed(high)} {per_second}",
            low=f"{notation.computed(low)} {per_second}",
            delta=notation.number(f"{run.irregularity(fitted):.6f}"),
        ),
    ]
    if wanted is not None:
        found = f"{wheel}{notation.computed(wanted)} {unit}"
        delta = notation.number(f"{run.machine.delta:.6f}")
        lines.append(texts.by_motor.format(wanted=delta, J=found))
    return lines


def courses(narrator: MachineNarrator) -> list[tuple[str, TimeMotion]]:
    """Return run-up and stop, as far as they exist, with their titles."""
    run, found = run_up_of(narrator.flywheel), []
    if run.machine.motor is not None and run.failure is None:
        found.append((narrator.texts.run_up_table, run.run_up))
    if run.stop is not None:
        found.append((narrator.texts.stop_table, run.stop))
    return found


def course_columns(
    course: TimeMotion, narrator: MachineNarrator
) -> list[tuple[str, str, list[str]]]:
    """Return a run-up or a stop by even times: heads, units and cells of its columns."""
    time, turned, omega = course.rows(ROWS)
    columns = (("t", "s", time), ("φ", "deg", turned * 180.0 / pi), ("ω", "1/s", omega))
    return [
        (
            head,
            narrator.notation.in_head(unit),
            [narrator.notation.number(text) for text in format_column(values.tolist())],
        )
        for head, unit, values in columns
    ]
