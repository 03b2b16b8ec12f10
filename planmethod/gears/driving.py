"""The speed that a train gives to the crank of a linkage (привод кривошипа)."""

from __future__ import annotations

from msgspec.structs import replace

from planmethod.errors import ProblemError
from planmethod.gears.answers import efficiency
from planmethod.gears.meshes import read_label
from planmethod.gears.model import GearProblem, Train
from planmethod.gears.motion import solve_motion
from planmethod.gears.reader import read_train
from planmethod.gears.sheet_texts import train_facts
from planmethod.note.document import GivenFact
from planmethod.note.wording import Language
from planmethod.problem.file_node import FileNode
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


def driven(file: FileNode) -> GearDrive:
    """Solve the train of a linkage's file for the body that turns with the crank.

    That body is ``train`` of ``[driver]``.
    """
    train, label = read_train(file["gears"]), file["driver"]["train"]
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
    return TrainOutput(body, inputs, train.unit, ratio, rate, efficient, train=train)
