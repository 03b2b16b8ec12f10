"""Construction of a problem: position, velocity and acceleration plans as one program."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

from msgspec import Struct, field

from planmethod.construct.program import Program
from planmethod.construct.steps import Name, PointName, Step
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.structure import Structure
from planmethod.plans.assembly_mode import Choice
from planmethod.plans.draft import Draft
from planmethod.plans.legend import PlanSegment, Quantity, motion_quantities, plan_segments
from planmethod.plans.model import Plan, PlanKind
from planmethod.plans.motion.board import MotionBoard
from planmethod.plans.motion.dyads import drive_motion, group_motion
from planmethod.plans.motion.legs import Kinematics
from planmethod.plans.motion.position import place_driver, place_frame, place_group
from planmethod.problem.model import Problem


class Section(Struct, frozen=True):
    """Steps of one structural group on one plan (раздел построения).

    ``group`` is None for the driver; the frame has a section of its own on the position plan only.
    """

    kind: PlanKind
    group: AssurGroup | None
    steps: tuple[Step, ...]
    frame: bool = False


class Construction(Struct, frozen=True, dict=True):
    """A problem's program and the meaning of its names.

    Attributes
    ----------
    structure : Structure
        Groups of the mechanism, in the order of which the plans are drawn.
    program : Program
        Steps of all three plans; a reading keeps the steps that it needs.
    draft : Draft
        Known numbers and given places of the data.
    kinematics : Kinematics
        Names of angular velocities and accelerations and of relative motions.
    plans : tuple of Plan
        Velocity and acceleration plan.
    sections : tuple of Section
        The program cut where one group ends and the next begins.
    legend : tuple of Quantity
        Quantities of the motion, in the order of the plans.
    segments : tuple of PlanSegment
        Segments that are measured on the plans.
    """

    structure: Structure
    program: Program
    draft: Draft
    kinematics: Kinematics
    plans: tuple[Plan, Plan]
    sections: tuple[Section, ...]
    legend: tuple[Quantity, ...]
    segments: tuple[PlanSegment, ...]

    def step(self, name: Name) -> Step:
        """Return the step that makes a name."""
        return self._steps_by_name[name]

    @cached_property
    def _steps_by_name(self) -> dict[Name, Step]:
        return {step.out: step for step in self.program.steps}

    @property
    def parts(self) -> dict[Name, int]:
        """Number of the group that a step of the position plan places, from 0 of the frame."""
        placed = (section for section in self.sections if section.kind is PlanKind.POSITION)
        return {step.out: k for k, section in enumerate(placed) for step in section.steps}

    def plan(self, kind: PlanKind) -> Plan:
        """Return the velocity or the acceleration plan."""
        return next(plan for plan in self.plans if plan.kind is kind)


class _Cutter(Struct):
    """Cut the growing list of steps into sections."""

    draft: Draft
    start: int = 0
    sections: list[Section] = field(default_factory=list)

    def cut(self, kind: PlanKind, group: AssurGroup | None = None, *, frame: bool = False) -> None:
        steps = tuple(self.draft.b.steps[self.start :])
        self.sections.append(Section(kind, group, steps, frame))
        self.start = self.draft.note_plan(kind, self.start)


def begin_positions(problem: Problem, choice: Choice) -> Draft:
    """Plan the position plan of the driver: groups are added to it one by one."""
    draft = Draft(problem, choice)
    _positions(draft, (), _Cutter(draft))
    return draft


def add_group(draft: Draft, group: AssurGroup) -> None:
    """Add a group to a position plan that has the links it is joined to."""
    cutter = _Cutter(draft, len(draft.b.steps))
    place_group(draft, group)
    cutter.cut(PlanKind.POSITION, group)


def _positions(draft: Draft, groups: Iterable[AssurGroup], cutter: _Cutter) -> None:
    place_frame(draft)
    cutter.cut(PlanKind.POSITION, frame=True)
    place_driver(draft)
    cutter.cut(PlanKind.POSITION)
    for group in groups:
        place_group(draft, group)
        cutter.cut(PlanKind.POSITION, group)


def build(problem: Problem, structure: Structure, choice: Choice) -> Construction:
    """Plan all three plans, group by group in the order of kinematic analysis."""
    draft = Draft(problem, choice)
    cutter = _Cutter(draft)
    _positions(draft, structure.groups, cutter)
    velocity = MotionBoard.start(PlanKind.VELOCITY, draft)
    acceleration = MotionBoard.start(PlanKind.ACCELERATION, draft)
    kinematics = Kinematics(draft, velocity, acceleration)
    for motion in (velocity, acceleration):
        drive_motion(kinematics, motion)
        cutter.cut(motion.kind)
        for group in structure.groups:
            group_motion(kinematics, motion, group)
            cutter.cut(motion.kind, group)
    legend = tuple(motion_quantities(kinematics, draft))
    segments = tuple(plan_segments(draft, (velocity, acceleration)))
    plans = (_plan(velocity), _plan(acceleration))
    sections = tuple(cutter.sections)
    return Construction(
        structure, draft.b.program(), draft, kinematics, plans, sections, legend, segments
    )


def _plan(motion: MotionBoard) -> Plan:
    letters: dict[PointName, str] = {}
    for at, shown in motion.letters.items():
        letters[at] = ", ".join(shown)
    return Plan(motion.kind, motion.pole, letters, tuple(motion.vectors), tuple(motion.equations))
