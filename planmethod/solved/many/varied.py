"""Cases of a sweep: a problem as a program with its numbers, the file with others (случаи).

Values that follow from a size, such as the height of a triangle or the assembly of a group, follow
as they do where the file has that size: each case is the file read again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.arguments import known
from planmethod.compiled import Array, Runner, write
from planmethod.construct.program import Program
from planmethod.construct.steps import Name
from planmethod.errors import AssemblyError, PlanMethodError, ProblemError
from planmethod.plans.assembly_mode import Choice
from planmethod.plans.build import Construction, build
from planmethod.plans.legend import Quantity, QuantityKind
from planmethod.problem.model import Problem
from planmethod.problem.parameters import Parameter, Parameters
from planmethod.solved.assembly_modes import construct, drive_data
from planmethod.solved.driving import driven
from planmethod.solved.labelled import quantities_for
from planmethod.solved.many.rows import SweepRow, rows_of
from planmethod.solved.many.variants import constructed
from planmethod.solved.quantities import Quantities
from planmethod.solved.solution import Solution
from planmethod.solved.turn.posed import pose

if TYPE_CHECKING:
    from planmethod.solved.many.loads import LoadColumns, Motion


class SweepError(PlanMethodError, ValueError):
    """Parameters or variants that one sweep cannot hold."""


class Case(Struct, frozen=True, eq=False):
    """Problem of a sweep: the program of the requested results, and its numbers (случай).

    Attributes
    ----------
    problem : Problem
    construction : Construction
    results : Quantities
    chosen, load_motion : tuple of Quantity
        Requested results, and additional ones on which loads depend.
    program : Program
        Steps that are needed.
    constants : mapping
        Data that are the same in every position.
    loads : LoadColumns or None
        Loads that must be given for every position.
    variation : str
        Changed numbers of the file, if any: ``l_AB = 0.3``.
    """

    problem: Problem
    construction: Construction
    results: Quantities
    chosen: tuple[Quantity, ...]
    load_motion: tuple[Quantity, ...]
    program: Program
    constants: Mapping[str, complex | float]
    loads: LoadColumns | None
    variation: str = ""

    @property
    def follower_names(self) -> tuple[str, ...]:
        """Names of the values that a cam's follower gives in every position."""
        drive = self.problem.drive
        return drive.program_inputs if drive.cam_drive is not None else ()

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs that vary with the position, besides the driver's coordinate."""
        loads = () if self.loads is None else self.loads.names
        return (*self.follower_names, *self.results.draft.branches, *loads)

    def at(self, positions: Array) -> list[Array]:
        """Return the columns of `inputs` in some positions: cam, branches and loads."""
        motion = driven(self.problem.drive, positions) if self.follower_names else ()
        columns = [np.asarray(one) for one in motion]
        columns += [one.branch(positions) for one in self.results.draft.branches.values()]
        return columns if self.loads is None else columns + self.loads.at(positions)

    @property
    def kind(self) -> tuple[object, ...]:
        """Key that cases on one tape have in common."""
        return self.program.steps, self.results.draft.origin, self.inputs, tuple(self.constants)


class SweepTask(Struct, frozen=True):
    """Request of a sweep, independent of the numbers.

    Attributes
    ----------
    labels : tuple of str or None
    forces : bool
    drawn : tuple of Name
    motion : callable
        Returns the sweep of a problem's motion.
    """

    labels: tuple[str, ...] | None
    forces: bool
    drawn: tuple[Name, ...]
    motion: Callable[[Problem], Motion]

    def of(self, problem: Problem, construction: Construction | None = None) -> Case:
        """Return the case of a problem."""
        solution = Solution(problem, positions=[], construction=construction)
        results = quantities_for(solution, self.labels, forces=self.forces)
        chosen = results.choose(self.labels)
        loads = self._loads(solution, results, chosen)
        # Loads against a motion are known only where all steps of that motion exist.
        moved = _motion(results) if loads is not None and loads.need_motion else ()
        names = [result.name for result in (*chosen, *moved)]
        made = {step.out for step in results.program.steps} if self.drawn else set()
        for name in self.drawn:
            known("plan", name, made)
        program = results.program.needed_for([*names, *self.drawn])
        constants = _constants(problem, results)
        return Case(
            problem, solution.construction, results, chosen, moved, program, constants, loads
        )

    def like(self, case: Case, problem: Problem, construction: Construction) -> Case:
        """Return the case of a problem; one with the steps of another has only new numbers."""
        whole = case.loads is None and not any(one.kind.is_force for one in case.chosen)
        draft, known = construction.draft, case.results
        whole = whole and tuple(draft.numbers) == tuple(known.numbers)
        if not whole or construction.program.steps != case.construction.program.steps:
            return self.of(problem, construction)
        own = Quantities(known.program, draft.numbers, known.all, draft)
        constants = _constants(problem, own)
        return Case(
            problem, construction, own, case.chosen, case.load_motion, case.program, constants, None
        )

    def _loads(
        self, solution: Solution, results: Quantities, chosen: Sequence[Quantity]
    ) -> LoadColumns | None:
        """Return the loads that must be given for every position; None if there are none."""
        if not (results.changing and any(result.kind.is_force for result in chosen)):
            return None
        from planmethod.solved.many.loads import LoadColumns

        problem = solution.problem
        return LoadColumns(problem, solution.construction, results.changing, self.motion(problem))


def _constants(problem: Problem, results: Quantities) -> dict[str, complex | float]:
    draft, drive = results.draft, problem.drive
    data = drive_data(problem, draft, np.zeros(1))
    data.update(results.numbers)
    followed = drive.program_inputs if drive.cam_drive is not None else ()
    return {
        name: complex(value) if np.iscomplexobj(value) else float(np.asarray(value).real)
        for name, value in data.items()
        if name != drive.coordinate.name and name not in (*draft.branches, *followed)
    }


def _motion(results: Quantities) -> tuple[Quantity, ...]:
    """Return the results that loads may depend on: places, velocities, rotations."""
    kinds = (QuantityKind.PLACE, QuantityKind.VELOCITY, QuantityKind.OMEGA)
    return tuple(result for result in results.all if result.kind in kinds)


class CaseTape:
    """Cases of one kind written on one tape: numbers in which they differ are inputs (лента).

    Parameters
    ----------
    case : Case
        The first of them.
    free : sequence of str
        Numbers that are inputs.
    drawn : sequence of Name
    dtype : dtype
    native : bool or None
    """

    def __init__(
        self,
        case: Case,
        free: Sequence[str],
        drawn: Sequence[Name],
        dtype: np.dtype[np.floating],
        native: bool | None,
    ) -> None:
        self.case, self.free = case, tuple(free)
        fixed = {name: v for name, v in case.constants.items() if name not in self.free}
        inputs = [case.problem.drive.coordinate.name]
        for name in self.free:
            place = isinstance(case.constants[name], complex)
            inputs += [f"{name}.x", f"{name}.y"] if place else [name]
        written = write(case.program, fixed, (*inputs, *case.inputs), case.construction.parts)
        origin = case.results.draft.origin
        self.rows: tuple[SweepRow, ...]
        self.rows, refs, depends = rows_of(case.chosen, written, origin, case.load_motion, drawn)
        self.runner = Runner(written, refs, depends, dtype=dtype, native=native)

    def lacks(self, cases: Sequence[Case]) -> list[str]:
        """Return the numbers that are not inputs and in which cases differ from the first one."""
        mine = self.case.constants
        return [
            name
            for name, value in mine.items()
            if name not in self.free and any(one.constants[name] != value for one in cases)
        ]

    def columns(
        self, cases: Sequence[Case], which: Array, rates: Mapping[str, Array]
    ) -> list[Array]:
        """Return the inputs that are numbers: rates as they are, others of the cases ``which``."""
        found: list[Array] = []
        for name in self.free:
            if name in rates:
                found.append(rates[name])
                continue
            values = np.array([one.constants[name] for one in cases])[which]
            found += [values.real, values.imag] if np.iscomplexobj(values) else [values]
        return [column.astype(self.runner.dtype, copy=False) for column in found]


class Varied:
    """Numbers of the file that a sweep varies (что варьируется).

    Parameters
    ----------
    case : Case
        With the numbers of the file.
    task : SweepTask
    names : sequence of str

    Attributes
    ----------
    rates : dict of str to str
        Rates of the driver by the names under which they are varied: they are inputs as they are.
    sizes : dict of str to Parameter
        All other ones: the file is read again with them.

    Raises
    ------
    SweepError
    """

    def __init__(self, case: Case, task: SweepTask, names: Sequence[str]) -> None:
        self.case, self.task = case, task
        self.parameters = Parameters(case.problem, pose)
        forces = any(one.kind.is_force for one in case.chosen)
        self.offered = {
            name: one.value
            for name, one in self.parameters.by_name.items()
            if forces or one.part != "dynamics"
        }
        self.rates: dict[str, str] = {}
        self.sizes: dict[str, Parameter] = {}
        if not names:
            return
        found = {name: self.parameters.find(name) for name in names}
        unknown = [name for name, one in found.items() if one is None]
        if unknown:
            known = ", ".join(self.offered)
            follows = [name for name in unknown if name in case.constants]
            if follows:
                raise SweepError(
                    "{} follows from other numbers of the file and cannot be varied alone. "
                    "Known: {}.",
                    ", ".join(follows),
                    known,
                )
            raise SweepError("no parameter {} to vary. Known: {}.", ", ".join(unknown), known)
        own = [one for one in found.values() if one is not None]
        if len({one.key for one in own}) < len(own):
            raise SweepError("two of the parameters {} are the same number", ", ".join(names))
        try:
            self.parameters.check(own)
        except ProblemError as error:
            raise SweepError(str(error)) from error
        for name, one in found.items():
            assert one is not None
            # A zero rate leaves steps out.
            if one.part == "drive" and one.value and not forces and one.name in case.constants:
                self.rates[name] = one.name
            else:
                self.sizes[name] = one

    def probed(self) -> list[str]:
        """Return the numbers of the program that each size alone changes, near the file's value."""
        found = dict.fromkeys(self.rates.values())
        for one in self.sizes.values():
            try:
                near = self.cases([one], np.array([[1.001 * one.value or 0.001]]))[0]
            except SweepError:
                continue
            if near.kind == self.case.kind:
                own = self.case.constants
                found |= {name: None for name, v in near.constants.items() if v != own[name]}
        return list(found)

    def cases(self, sizes: Sequence[Parameter], values: Array) -> list[Case]:
        """Return the case of every column of values, shape (sizes, cases).

        Raises
        ------
        SweepError
            The file is faulty with these numbers.
        """
        told = [
            ", ".join(f"{one.name} = {v:g}" for one, v in zip(sizes, column, strict=True))
            for column in values.T.tolist()
        ]
        problems = []
        for column, named in zip(values.T.tolist(), told, strict=True):
            try:
                problems.append(self.parameters.read(dict(zip(sizes, column, strict=True))))
            except (ProblemError, AssemblyError) as error:
                raise SweepError("with {} the file is rejected. {}", named, str(error)) from error
        found = []
        for problem, made, named in zip(problems, constructed(problems), told, strict=True):
            try:
                built = self._with_special_points(made or self._unclosed(problem))
                case = self.task.like(self.case, problem, built)
            except ProblemError as error:
                raise SweepError("with {} the file is rejected. {}", named, str(error)) from error
            found.append(replace(case, variation=named))
        return found

    def _with_special_points(self, construction: Construction) -> Construction:
        """Return a construction with the special points of the first one, not with better ones."""
        mine, choice = self.case.construction.draft.choice, construction.draft.choice
        kept = {
            links: replace(closing, third=mine[links].third) for links, closing in choice.items()
        }
        if kept == choice:
            return construction
        return build(construction.draft.problem, construction.structure, kept)

    def _unclosed(self, problem: Problem) -> Construction:
        """Return the construction of a problem that the positions of the file do not close."""
        try:
            return construct(problem)
        except AssemblyError:  # the steps exist and show in which positions they fail
            mine = self.case.construction
            choice: Choice = mine.draft.choice
            return build(problem, mine.structure, choice)
