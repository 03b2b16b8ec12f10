"""A gear train as a calculation: equations of the meshes, speeds, ratios (расчёт передачи)."""

# no messages: formulas

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import numpy as np
from msgspec.structs import replace

from planmethod.gears.model import COUNTS, GearProblem, Mesh, RequestedQuantity, parse
from planmethod.gears.motion import TrainMotion, mesh_row, solve_motion
from planmethod.note.calculation.expression import Expression, Name, Negative, Number, Operation
from planmethod.note.calculation.model import CalculationBuilder, Equations, Quantity
from planmethod.note.formula import Rich, fraction
from planmethod.note.wording import Language

_MINUTE = "1/min"


def train_chapter(problem: GearProblem, builder: CalculationBuilder, language: Language) -> None:
    """Write the chapter: sizes are given, speeds solve the equations of the meshes.

    Raises
    ------
    ProblemError
        As `solve_motion`.
    """
    _Train(solve_motion(problem), builder, language).write()


class _Train:
    """Writes one train."""

    def __init__(
        self, motion: TrainMotion, builder: CalculationBuilder, language: Language
    ) -> None:
        self.motion, self.train = motion, motion.train
        self.builder, self.language, self.texts = builder, language, language.calculation
        self.units: Mapping[str, Rich] = language.notation.units
        self.unit = self.units[_MINUTE if self.train.unit == "n" else "1/s"]
        self.sizes: dict[str, Name] = {}

    def write(self) -> None:
        self._sizes()
        self.builder.add_heading(self.texts.equations.format())
        self._speeds()
        self._ratios()
        self.builder.close(self.texts.train.format())

    def _sizes(self) -> None:
        train = self.train
        for label, size in self.motion.axes.sizes.items():
            if label not in train.wheels and label not in train.arms:
                continue
            counted = label in train.wheels and train.counted(label)
            remark = self.texts.chosen if label in train.unknown else ""
            symbol = f"z_{{{label}}}"
            if not counted or size.denominator != 1:
                symbol, remark = f"r_{{{label}}}", self.texts.size
            if not any(label in (mesh.first, mesh.second) for mesh in train.meshes):
                continue
            one = self.builder.add_input(symbol, float(size), remark=remark)
            self.sizes[label] = Name(one.name)

    def _row(self, mesh: Mesh) -> dict[str, Expression]:
        """Return the coefficients of a mesh: each is linear in both sizes."""
        motion, train = self.motion, self.train
        axes, labels = motion.axes, (mesh.first, mesh.second)

        def row(first: int, second: int) -> dict[str, Fraction]:
            own = dict(zip(labels, (Fraction(first), Fraction(second)), strict=True))
            sizes = replace(axes, sizes={**axes.sizes, **own}, radii={**axes.radii, **own})
            return mesh_row(train, motion.roles, sizes, mesh)

        steady, by_first, by_second = row(0, 0), row(1, 0), row(0, 1)
        whole = mesh_row(train, motion.roles, motion.axes, mesh)
        found: dict[str, Expression] = {}
        for body, value in whole.items():
            terms: list[Expression] = []
            for label, one in zip(labels, (by_first, by_second), strict=True):
                share = one.get(body, Fraction(0)) - steady.get(body, Fraction(0))
                name = self.sizes.get(label)
                if share and name is not None:
                    terms.append(_scaled(share, name))
            if terms and not steady.get(body):
                made = terms[0]
                for term in terms[1:]:
                    made = _sum(made, term)
                found[body] = made
            else:
                found[body] = Number(float(value))
        return found

    def _speeds(self) -> None:
        train, motion, builder = self.train, self.motion, self.builder
        moving = [body for body in train.bodies if body not in train.fixed]
        rows: list[tuple[str, dict[str, Expression], Expression, list[float]]] = []
        for mesh in train.meshes:
            exact = mesh_row(train, motion.roles, motion.axes, mesh)
            numbers = [float(exact.get(body, 0)) for body in moving]
            name = self.texts.mesh.format(name=mesh.name)
            rows.append((name, self._row(mesh), Number(0.0), numbers))
        for body, speed in train.inputs.items():
            if body in train.fixed:
                continue
            one = builder.add_input(f"{train.letter}_{{{body}}}^{{0}}", float(speed), self.unit,
                                self.texts.input)  # fmt: skip
            numbers = [float(body == other) for other in moving]
            rows.append((self.texts.input, {body: Number(1.0)}, Name(one.name), numbers))
        chosen = _independent([numbers for *_, numbers in rows], len(moving))
        unknowns = [
            Quantity(builder.new_name(symbol), symbol, self.unit, (float(speed),), (None,))
            for symbol, speed in (
                (f"{train.letter}_{{{body}}}", motion.speeds[body]) for body in moving
            )
        ]
        kept = [rows[k] for k in chosen]
        equations = Equations(
            tuple(name for name, *_ in kept),
            tuple(tuple(row.get(body, Number(0.0)) for body in moving) for _, row, *_ in kept),
            tuple(right for _, _, right, _ in kept),
            tuple(unknowns),
        )
        builder.add_equations(equations)
        for body in train.fixed:
            builder.value(f"{train.letter}_{{{body}}}", 0.0, self.unit, self.texts.given)
        if train.unit == "n":
            builder.add_heading(self.texts.speeds.format())
            for body in moving:
                if body not in train.racks:
                    turning = float(motion.speeds[body]) * np.pi / 30.0
                    builder.formula(f"ω_{{{body}}}", fraction(f"π·n_{{{body}}}", "30"), turning,
                                    self.units["1/s"])  # fmt: skip

    def _ratios(self) -> None:
        known = tuple(self.train.body_of)
        asked = [parse(name, known) for name in dict.fromkeys(self.train.ask)]
        ratios = [one for one in asked if one.kind == "U" and len(one.labels) == COUNTS["U"]]
        if ratios:
            self.builder.add_heading(self.texts.ratios.format())
        for one in ratios:
            self._ratio(one)

    def _ratio(self, one: RequestedQuantity) -> None:
        train, motion = self.train, self.motion
        speeds = [motion.speed(label, one.carrier) for label in one.labels]
        if not speeds[1] or {train.body_of[label] for label in one.labels} & train.racks:
            return
        sides = []
        for label in one.labels:
            body = train.body_of[label]
            letters = f"{train.letter}_{{{body}}}"
            if one.carrier is not None and body not in motion.roles.transverse:
                letters += f" − {train.letter}_{{{train.body_of[one.carrier]}}}"
            sides.append(letters)
        value, letters = speeds[0] / speeds[1], fraction(*sides)
        if not motion.has_sign(*one.labels):
            value, letters = abs(value), f"|{letters}|"
        self.builder.formula(one.symbol, letters, float(value))


def _scaled(factor: Fraction, name: Name) -> Expression:
    if factor == 1:
        return name
    if factor == -1:
        return Negative(name)
    return Operation("*", Number(float(factor)), name)


def _sum(one: Expression, two: Expression) -> Expression:
    if isinstance(two, Negative):
        return Operation("-", one, two.of)
    return Operation("+", one, two)


def _independent(rows: list[list[float]], count: int) -> list[int]:
    """Return the numbers of rows that determine all unknowns, each of which adds something."""
    chosen: list[int] = []
    for k in range(len(rows)):
        tried = np.array([rows[one] for one in (*chosen, k)])
        if np.linalg.matrix_rank(tried) == len(tried):
            chosen.append(k)
        if len(chosen) == count:
            break
    return chosen
