"""Which steps of a program belong to which plan and which structural group."""

from __future__ import annotations

from dataclasses import dataclass

from planmethod.construct.steps import Step
from planmethod.errors import ProgramError
from planmethod.mechanism.groups import AssurGroup
from planmethod.plans.build import Construction
from planmethod.plans.draft import Draft
from planmethod.plans.groups import drive_motion, group_motion
from planmethod.plans.leads import Kinematics
from planmethod.plans.model import PlanKind
from planmethod.plans.motion import Motion
from planmethod.plans.position import place_driver, place_frame, place_group


@dataclass(frozen=True, slots=True)
class Section:
    """Steps of one structural group on one plan (раздел протокола).

    ``group`` is None for the driver; the frame has a section of its own on the position plan only.
    """

    kind: PlanKind
    group: AssurGroup | None
    steps: tuple[Step, ...]
    frame: bool = False


def sections(construction: Construction, groups: tuple[AssurGroup, ...]) -> list[Section]:
    """Return the program cut where one group ends and the next begins.

    The construction is planned once more, group by group, and the number of steps is noted after
    each: a plan's steps are made by its groups in turn and nothing else tells them apart.

    Raises
    ------
    ProgramError
        When planning again gives other steps.
    """
    old = construction.draft
    draft = Draft(old.problem, old.choice)
    steps = draft.b.steps
    marks: list[tuple[PlanKind, AssurGroup | None, bool, int]] = []

    def mark(kind: PlanKind, group: AssurGroup | None = None, *, frame: bool = False) -> None:
        marks.append((kind, group, frame, len(steps)))

    place_frame(draft)
    mark(PlanKind.POSITION, frame=True)
    place_driver(draft)
    mark(PlanKind.POSITION)
    for each in groups:
        place_group(draft, each)
        mark(PlanKind.POSITION, each)
    velocity = Motion.start(PlanKind.VELOCITY, draft)
    acceleration = Motion.start(PlanKind.ACCELERATION, draft)
    kin = Kinematics(draft, velocity, acceleration)
    for motion in (velocity, acceleration):
        drive_motion(kin, motion)
        mark(motion.kind)
        for each in groups:
            group_motion(kin, motion, each)
            mark(motion.kind, each)
    if tuple(steps) != construction.program.steps:
        raise ProgramError("The construction planned again differs from the solved one")
    result, start = [], 0
    for kind, group, frame, end in marks:
        result.append(Section(kind, group, tuple(steps[start:end]), frame))
        start = end
    return result
