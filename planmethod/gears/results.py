"""Numbers of a train for others: audit, students' quantities, the crank's speed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property, partial
from typing import TYPE_CHECKING

from msgspec.structs import replace

from planmethod.construct.drafting import PROFILES
from planmethod.errors import ProblemError
from planmethod.gears.construction import construct, read
from planmethod.gears.meshes import read_label
from planmethod.gears.model import (
    GearProblem,
    RequestedQuantityError,
    Train,
    parse,
)
from planmethod.gears.motion import TrainMotion, draw, rows_of, solve_motion, speeds_by
from planmethod.gears.reader import read_train
from planmethod.gears.relations import relations_of
from planmethod.gears.sheet_texts import train_facts
from planmethod.gears.solution import answer, efficiency
from planmethod.note.audit import Audited
from planmethod.note.document import GivenFact
from planmethod.note.wording import Language
from planmethod.problem.file_node import FileNode
from planmethod.problem.model import GearDrive, GearStage
from planmethod.problem.names import segment
from planmethod.problem.records import AnswerValue, Mistaken, Relations
from planmethod.solved.quantity_steps import NoValue

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile


def audited(problem: GearProblem, ruler: float) -> list[Audited]:
    """Compare every printed value with the exact one, and with that read from the diagrams.

    Parameters
    ----------
    problem : GearProblem
    ruler : float, mm

    Raises
    ------
    ProblemError
        The train cannot be, or its inputs do not fit.
    """
    asked = (*problem.train.ask, *(one.what for one in problem.published))
    motion = solve_motion(replace(problem, train=replace(problem.train, ask=asked)))
    picture, found = draw(motion), {}
    if picture is not None:
        drawn = construct(motion, picture)
        seen = read(drawn, replace(PROFILES["board"], ruler=ruler))
        found = {one.name: float(seen.read.value[one.read]) for one in drawn.quantities}
    told = []
    for one in problem.published:
        exact = answer(motion, one.what)
        why = NoValue.ZERO_DIVISOR if exact.reason == "zero" else None
        if exact.value is None and why is None:
            why = NoValue.NO_LINK
        told.append(Audited(one, exact.value, found.get(one.what), reason=why))
    return told


COUNTS = ("W", "q", "z", "k")
SPEEDS = ("n", "omega")
NEAR = 0.05

Rows = list[dict[str, Fraction]]
"""Equations of the meshes, in their order."""


class TrainQuantities:
    """Quantities of a train for questions (`QuestionQuantities`)."""

    count = 1

    def __init__(self, problem: GearProblem) -> None:
        self.motion = solve_motion(problem)
        train = self.motion.train
        speeds = (
            f"{train.unit}_{body}"
            for body in train.bodies
            if body not in {*train.fixed, *train.inputs, *train.racks}
        )
        names = train.ask or tuple(speeds)
        self.names = tuple(name for name in names if self.quantity(name, 0) is not None)
        self._known = tuple(train.body_of)

    def quantity(self, name: str, position: int) -> AnswerValue | None:
        """Return a quantity by its name of ``ask``; None where it has no value."""
        try:
            kind = parse(name, tuple(self.motion.train.body_of)).kind
            found = answer(self.motion, name)
        except RequestedQuantityError:
            return None
        if found.value is None:
            return None
        own = parse(name, tuple(self.motion.train.body_of)).symbol
        return AnswerValue(
            own, found.unit, found.value, turns=kind in SPEEDS, is_integer=kind in COUNTS
        )

    def read_off(self, name: str, position: int, profile: Profile) -> tuple[float, float] | None:
        """Return the segment of a speed on the diagram, mm, and one sigma of its reading."""
        picture = draw(self.motion)
        if picture is None:
            return None
        train = replace(self.motion.train, ask=(name,))
        drawn = construct(replace(self.motion, train=train), picture)
        found = next((one for one in drawn.quantities if one.name == name), None)
        if found is None:
            return None
        segment = drawn.segments.get(found.rays[0]) if len(found.rays) == 1 else None
        seen = read(drawn, profile)
        mm = math.nan if segment is None else abs(float(seen.exact.value[segment]))
        return mm, seen.sigma[found.read]

    # Mistakes --------------------------------------------------------------------------------

    @cached_property
    def _rows(self) -> Rows:
        return rows_of(self.motion.train, self.motion.roles, self.motion.axes)

    def mistaken(self) -> Iterator[Mistaken]:
        """Yield the usual mistakes: signs, ratios, carriers, teeth, units."""
        for code, where, rows in self._miswritten():
            motion = self._motion_by(rows)
            if motion is not None:
                yield Mistaken(code, where, partial(_value, motion))
        yield Mistaken("G2", "U", self._inverted)
        yield Mistaken("G3", "U", self._without_carrier)
        factors = {"n": math.pi / 30, "omega": 30 / math.pi}
        yield Mistaken("S2", "", partial(self._scaled, factors))
        yield Mistaken("S2", "", partial(self._scaled, {k: 1 / v for k, v in factors.items()}))
        if self.motion.train.unit == "n":  # n/60, 9.55·n
            for factor in (0.5 / math.pi, (30 / math.pi) ** 2):
                yield Mistaken("S2", "", partial(self._scaled, {"omega": factor}))

    def _miswritten(self) -> Iterator[tuple[str, str, Rows]]:
        train, roles = self.motion.train, self.motion.roles
        rows = self._rows
        for at, mesh in enumerate(train.meshes):
            one, other = train.ends(mesh)
            carrier = train.carrier(mesh)
            first, second = rows[at][one], rows[at][other]

            def written(
                x: Fraction,
                y: Fraction,
                at: int = at,
                of: tuple[str, str, str | None] = (one, other, carrier),
            ) -> Rows:
                row = {of[0]: x, of[1]: y}
                if of[2] is not None:
                    own = [v for body, v in row.items() if body not in roles.transverse]
                    row[of[2]] = row.get(of[2], Fraction(0)) - sum(own, Fraction(0))
                return [*rows[:at], row, *rows[at + 1 :]]

            yield "G1", mesh.name, written(first, -second)
            if one not in train.racks and other not in train.racks:
                turn = 1 if first * second > 0 else -1
                yield "G2", mesh.name, written(abs(second), turn * abs(first))
        for carrier in train.carriers:
            yield "G3", carrier, self._swapped_carrier_rows(carrier)
        sizes = self.motion.axes.sizes
        for label in sizes:
            twin = f"{label}'"
            if twin in sizes and sizes[twin] != sizes[label]:
                there, back = {label: sizes[twin]}, {twin: sizes[label]}
                for some in (there | back, there, back):
                    axes = replace(self.motion.axes, sizes={**sizes, **some})
                    yield "G4", f"{label}, {twin}", rows_of(train, roles, axes)

    def _swapped_carrier_rows(self, carrier: str) -> Rows:
        """Return the equations with the carrier in the ring's place, as if U^H were U."""
        train, roles = self.motion.train, self.motion.roles
        still = next((body for body in roles.central[carrier] if body in train.fixed), None)
        found = []
        for mesh, row in zip(train.meshes, self._rows, strict=True):
            if train.carrier(mesh) == carrier:
                ends = {body: row[body] for body in train.ends(mesh)}
                row = {carrier if body == still else body: value for body, value in ends.items()}
            found.append(row)
        return found

    def _motion_by(self, rows: Rows) -> TrainMotion | None:
        """Return the motion from other equations; None where they determine none."""
        found = speeds_by(self.motion.train, rows)
        if found.free or not found.consistent:
            return None
        return replace(self.motion, speeds=found.values)

    def _inverted(self, name: str, position: int) -> float | None:
        found = self.quantity(name, position)
        if found is None or not (parse(name, self._known).kind == "U" and found.value):
            return None
        return 1 / found.value

    def _without_carrier(self, name: str, position: int) -> float | None:
        """Take U^H_1k for U_1k where a carrier is left out of account."""
        own = _value(self.motion, name, position)
        asked = parse(name, self._known)
        if asked.kind != "U":
            return own
        train, (one, other) = self.motion.train, asked.labels
        if asked.carrier is not None:
            return _value(self.motion, f"U_{one}_{other}", position)
        for carrier in train.carriers:
            if carrier not in (train.body_of[one], train.body_of[other]):
                held = _value(self.motion, f"{name}^{carrier}", position)
                if held is not None and held != own:
                    return held
        return own

    def _scaled(self, factors: Mapping[str, float], name: str, position: int) -> float | None:
        own = _value(self.motion, name, position)
        return own if own is None else own * factors.get(name.partition("_")[0], 1.0)

    def relations(self, names: Sequence[str], position: int) -> Relations:
        """Return the relations of ratios and speeds, by stages and by Willis."""
        return relations_of(self.motion, names)


def _value(motion: TrainMotion, name: str, position: int) -> float | None:
    return answer(motion, name).value


class TrainOutput(GearDrive, frozen=True, kw_only=True):
    """Body of a train that turns the crank of a linkage, with its train.

    Attributes
    ----------
    train : Train
    """

    train: Train

    def given_facts(self, language: Language) -> list[GivenFact]:
        """Return the given facts of the train, and which of its bodies drives the crank.

        Wheels are numbered like links, so speeds and fixed bodies are said to be the train's.
        """
        sheet, letter = language.gears["sheet"], "n" if self.train.unit == "n" else "ω"
        wheels = {
            f"gears.{self.train.unit}.{segment(label)}": label
            for label, _ in self.inputs
            if label.isdigit()
        }
        facts = []
        for fact in train_facts(solve_motion(GearProblem(name="", train=self.train)), language):
            key, text = next(iter(fact.data), ""), fact.text
            if key in wheels:
                speed = text.split(" = ")[1]
                text = sheet["of_wheel"].format(letter=letter, label=wheels[key], speed=speed)
            elif key == "gears.fixed":
                text = sheet["fixed"]["of_train"].format(labels=", ".join(sorted(self.train.fixed)))
            facts.append(replace(fact, text=text))
        return facts


def driven(file: FileNode, driver: FileNode) -> GearDrive:
    """Solve the train of a linkage's file for the body that turns with a crank.

    That body is ``train`` of the driver.
    """
    train, label = read_train(file["gears"]), driver["train"]
    body = read_label(label, tuple(train.body_of))
    if train.body_of[body] in train.racks:
        label.reject("{} is a rack, it does not turn", body)
    try:
        motion = solve_motion(GearProblem(name="", train=train))
    except ProblemError as error:
        file.reject_all(error.faults)
    speed = motion.speed(body)
    inputs = tuple((name, float(value)) for name, value in train.inputs.items())
    ratio = None
    if len(inputs) == 1 and speed and inputs[0][0] not in train.racks:
        ratio = motion.speeds[inputs[0][0]] / speed
        ratio = ratio if motion.has_sign(inputs[0][0], body) else abs(ratio)
    share = efficiency(motion, train.body_of[body])
    efficient = None if share is None else float(share)
    rate = float(speed) * train.rate
    stages = tuple(_stages(motion))
    return TrainOutput(body, inputs, train.unit, ratio, rate, efficient, stages, train=train)


def _stages(motion: TrainMotion) -> Iterator[GearStage]:
    """Yield the meshes of a train with the teeth of their wheels and their module."""
    train, sizes = motion.train, motion.axes.sizes

    def teeth(label: str) -> int | None:
        size = sizes.get(label)
        is_whole = size is not None and train.counted(label) and size.denominator == 1
        return int(size) if size is not None and is_whole else None

    for mesh in train.meshes:
        pair = mesh.first, mesh.second
        modules = [train.module_of(label) for label in pair if label in train.wheels]
        count = (teeth(pair[0]), teeth(pair[1]))
        yield GearStage(pair, count, modules[0] if modules and any(count) else None)
