"""The speed that a train gives to the crank of a linkage (привод кривошипа)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from msgspec.structs import replace

from planmethod.errors import ProblemError
from planmethod.gears.answers import efficiency
from planmethod.gears.meshes import read_label
from planmethod.gears.model import GearProblem, Train
from planmethod.gears.motion import solve_motion
from planmethod.gears.reader import read_train
from planmethod.gears.sheet_texts import train_facts
from planmethod.languages import translate
from planmethod.note.document import GivenFact
from planmethod.note.wording import Language
from planmethod.problem.fields import Faults
from planmethod.problem.model import GearDrive
from planmethod.problem.names import segment


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


def driven(faults: Faults, table: Mapping[str, Any], label: object) -> GearDrive | None:
    """Solve the train of a linkage's file for the body that turns with the crank.

    Parameters
    ----------
    table : mapping
        ``[gears]``.
    label : object
        ``train`` of ``[driver]``.

    Returns
    -------
    Geared or None
        None where the train or the label is faulty; ``faults`` say why.
    """
    train = read_train(faults, table)
    if train is None:
        return None
    body = read_label(faults, "driver.train", label, tuple(train.body_of))
    if body is None:
        return None
    if train.body_of[body] in train.racks:
        faults.add("driver.train", translate("{} is a rack, it does not turn", body))
        return None
    try:
        motion = solve_motion(GearProblem(name="", train=train))
    except ProblemError as error:
        for fault in error.faults:
            faults.add(fault.path, fault.message, fault.hint)
        return None
    speed = motion.speed(body)
    inputs = tuple((name, float(value)) for name, value in train.inputs.items())
    ratio = None
    if len(inputs) == 1 and speed and inputs[0][0] not in train.racks:
        ratio = motion.speeds[inputs[0][0]] / speed
        ratio = ratio if motion.has_sign(inputs[0][0], body) else abs(ratio)
    share = efficiency(motion, train.body_of[body])
    efficient = None if share is None else float(share)
    rate = float(speed) * train.rate
    return TrainOutput(body, inputs, train.unit, ratio, rate, efficient, train=train)
