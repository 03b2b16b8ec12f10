"""Variants of a problem as rows of one solution; a problem as a program with its numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.arguments import UnknownNameError, known
from planmethod.compiled import Array, Runner, write
from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.drafting import Profile, RulerArithmetic
from planmethod.construct.program import Program
from planmethod.construct.steps import (
    GivenNumber,
    IntersectCircles,
    IntersectLineCircle,
    Name,
    NumberName,
    Step,
)
from planmethod.errors import AssemblyError, PlanMethodError, ProblemError
from planmethod.plans.build import Construction, Quantity, build
from planmethod.plans.model import RATES, Choice
from planmethod.problem.model import Drive, Problem
from planmethod.problem.parameters import Parameter, Parameters
from planmethod.problem.quantities import QuantityKind
from planmethod.solved.assembly_modes import construct, construct_each, drive_data
from planmethod.solved.failures import failing
from planmethod.solved.legibility import SHORT, SMALL
from planmethod.solved.many.rows import LoadColumns, SweepRow, quantities_for, rows_of
from planmethod.solved.quantities import WARN_RELATIVE_ERROR, Quantities
from planmethod.solved.reading import Flags, Reading, Reals, driven, other_place
from planmethod.solved.selfcheck import changed_branches, flag_rejected
from planmethod.solved.solution import FEW_ROWS, Solution, at_positions, unit_rate_problem
from planmethod.solved.turn.determined import pose

if TYPE_CHECKING:
    from planmethod.solved.many.rows import Motion


class Batch(Solution):
    """Variants that are drawn by the same steps, each with its rows (варианты одной схемы).

    All values by positions have a row for each position of each variant, in order. They are NaN
    where a step is impossible.

    Parameters
    ----------
    problems : sequence of Problem
    constructions : sequence of Construction
        Of the problems; with the same steps.
    profile : Profile
    """

    def __init__(
        self, problems: Sequence[Problem], constructions: Sequence[Construction], profile: Profile
    ) -> None:
        positions = [place for problem in problems for place in problem.drive.positions]
        first = constructions[0]
        super().__init__(problems[0], positions=positions, profile=profile, construction=first)
        self.problems, self.constructions = problems, constructions
        counts = [len(problem.drive.positions) for problem in problems]
        self.rows = _rows(counts)
        self._counts, self._of = counts, np.repeat(np.arange(len(problems)), counts)

    def some(self, numbers: Sequence[int]) -> Batch:
        """Return a batch of some of the variants, which keep their own readings."""
        chosen = [self.problems[k] for k in numbers], [self.constructions[k] for k in numbers]
        found = Batch(*chosen, self.profile)
        found.solutions = [self.solutions[k] for k in numbers]
        return found

    def _inputs_at(self, chosen: npt.NDArray[np.intp] | slice) -> Mapping[str, Any]:
        """Return the given data of some rows, at unit scales."""
        return at_positions(self._inputs, chosen)

    @cached_property
    def _inputs(self) -> dict[str, Number]:
        each = zip(self.problems, self.constructions, self.rows, strict=True)
        own = [drive_data(p, made.draft, self.positions[rows]) for p, made, rows in each]
        return _columns(own, self._counts)

    def numbers_of(self, plan: Callable[[Construction], Mapping[str, float]]) -> dict[str, Number]:
        """Return the known numbers of the continued constructions, in every row."""
        return _columns([plan(made) for made in self.constructions], self._counts)

    def length(self, link: str, p: str, q: str) -> Reals:
        """Return the given distance of two points of a link in every row, m."""
        bodies = [problem.bodies[link].points for problem in self.problems]
        return np.repeat([abs(points[q] - points[p]) for points in bodies], self._counts)

    def variant_at(self, index: int) -> tuple[Solution, int]:
        """Return the solution of the variant that a row is of, and its position there."""
        k = int(self._of[index])
        return self.solutions[k], index - self.rows[k].start

    def at_unit_rate(self) -> Solution:
        """Return the same mechanisms, their drivers at one radian (or metre) a second."""
        problems, constructions = (
            [unit_rate_problem(problem) for problem in self.problems],
            self.constructions,
        )
        if self.problem.drive.acceleration:
            each = zip(problems, constructions, strict=True)
            constructions = [build(p, made.structure, made.draft.choice) for p, made in each]
        return Batch(problems, constructions, self.profile)

    # Readings --------------------------------------------------------------------------------

    @property
    def max_positions(self) -> int:
        """Largest number of positions of a variant."""
        return max(self._counts)

    @cached_property
    def si(self) -> Reading:
        """Exact reading at unit scales; NaN where a step is impossible."""
        return self.read(Float64())

    @cached_property
    def clean_variants(self) -> Flags:
        """Flags of the variants that are solved without any warning; shape (variants,)."""
        rows = failing(self.construction.program, self.si.trace, self.si.count) < 0
        rows &= ~flag_rejected(self)
        told = np.array([bool(rows[own].all()) for own in self.rows])
        for k in np.flatnonzero(told & (np.array(self._counts) > 1)):
            told[k] = not changed_branches(self.solutions[k])
        return told

    @property
    def kinds(self) -> list[tuple[object, ...] | None]:
        """Kinds of loads of the variants: those of one kind are planned in the same way.

        None for a variant that is not solved, or that has a warning.
        """
        good = self.clean_variants
        if self.problem.dynamics is None or not good.all():
            return [() if told else None for told in good.tolist()]
        kinds = [_loads_kind(one) for one, _ in self.parts]
        if len(set(kinds)) == 1 and kinds[0] is not None:
            from planmethod.solved.forces.statics import statics_of

            certain = statics_of(self).closes & (statics_of(self).bound <= WARN_RELATIVE_ERROR)
            return [kinds[0] if certain[own].all() else None for own in self.rows]
        return kinds

    @cached_property
    def solutions(self) -> list[Solution]:
        """Every variant's own solution: its exact reading is its rows of this one."""
        found = []
        for problem, made, own in zip(self.problems, self.constructions, self.rows, strict=True):
            one = Solution(problem, profile=self.profile, construction=made)
            one.si = self.si.part(own)
            one.extents = self.extents.part(made, one.si, own)
            found.append(one)
        return found

    @cached_property
    def parts(self) -> Sequence[tuple[Solution, slice]]:
        """Every variant's own solution, with its readings, and its rows."""
        for one, own in zip(self.solutions, self.rows, strict=True):
            one.paper = self.paper.part(own)
        return tuple(zip(self.solutions, self.rows, strict=True))

    @cached_property
    def per_mm(self) -> dict[str, Number]:
        """Unit per millimetre of each plan in every row, by its name in the program."""
        return _columns([one.per_mm for one in self.solutions], self._counts)

    @cached_property
    def ruler_arithmetic(self) -> RulerArithmetic:
        """Draughtsman with a ruler: in every row short segments are read as in its variant."""
        enlargements: dict[str, Number] = {}
        for k in np.flatnonzero(self._short):
            one, own = self.solutions[k], self.rows[k]
            one.paper = self.paper.part(own)
            for name, times in one.ruler_arithmetic.enlargements.items():
                enlargements.setdefault(name, np.ones(len(self.positions)))[own] = times
        return RulerArithmetic(self.profile.ruler, enlargements)

    @property
    def _short(self) -> Flags:
        """Flags of the variants that may need enlarged views, by an estimate; shape (variants,)."""
        found = np.zeros(len(self.positions), dtype=bool)
        for kind in RATES:
            ends = [(v.tail, v.head) for v in self.construction.plan(kind).vectors]
            for tail, head in ends:
                found |= np.abs(self.paper.point(head) - self.paper.point(tail)) < max(SHORT, SMALL)
        return np.array([bool(found[own].any()) for own in self.rows])


def in_batches(problems: Sequence[Problem], profile: Profile) -> list[tuple[Batch, list[int]]]:
    """Return batches of variants that are drawn by the same steps, and their indices.

    Variants with warnings and variants unlike all others are in none of them: each must be solved
    alone.
    """
    plain = [k for k, problem in enumerate(problems) if _is_basic(problem)]
    made = dict(zip(plain, construct_each([problems[k] for k in plain]), strict=True))
    alike: dict[tuple[Any, ...], list[int]] = {}
    for k, construction in made.items():
        if construction is not None and construction.draft.origin == 0:
            alike.setdefault(_kind(problems[k], construction), []).append(k)
    found: list[tuple[Batch, list[int]]] = []
    for members in alike.values():
        waiting = [members]
        while waiting:
            kept = waiting.pop()
            if len(kept) < 2:
                continue
            chosen = [made[k] for k in kept]
            batch = Batch([problems[k] for k in kept], [c for c in chosen if c], profile)
            kinds = batch.kinds
            parts = [
                [k for k, own in zip(kept, kinds, strict=True) if own == kind]
                for kind in dict.fromkeys(kinds)
                if kind is not None
            ]
            if parts == [kept]:
                found.append((batch, kept))
            else:
                waiting += parts[::-1]
    return found


def _is_basic(problem: Problem) -> bool:
    """Return whether a problem consists only of plans of a few positions."""
    more = (problem.cycle, problem.machine, problem.balancing)
    rubs = problem.dynamics is not None and problem.dynamics.friction is not None
    whole = not rubs and not problem.is_project and not any(part is not None for part in more)
    return whole and len(problem.drive.positions) <= FEW_ROWS


def _kind(problem: Problem, construction: Construction) -> tuple[Any, ...]:
    """Return the key that problems with the same steps and names have in common."""
    bodies = tuple((link, tuple(body.points)) for link, body in problem.bodies.items())
    draft = construction.draft
    given = tuple(draft.numbers), tuple(draft.places), tuple(draft.branches)
    rates = problem.drive.rate == 0, problem.drive.acceleration == 0
    several = len(problem.drive.positions) > 1
    kind = construction.program.steps, bodies, given, construction.segments, rates, several
    dynamics = problem.dynamics
    if dynamics is None:
        return kind
    # Guides and bearings are looked up by number; a force pushes along its own line.
    shared = tuple(problem.slides.items()), tuple(dynamics.bearings.items()), problem.drive.pushed
    return (*kind, tuple(dynamics.masses), dynamics.resultant, shared)


def _loads_kind(solution: Solution) -> tuple[object, ...] | None:
    from planmethod.solved.forces.statics import loads_on

    try:
        return solution.compute_once(loads_on).kind
    except PlanMethodError:
        return None  # it says why when it is solved alone


def _rows(counts: Sequence[int]) -> list[slice]:
    """Return the rows of each variant, given their numbers of positions, in order."""
    return [slice(start, end) for start, end in pairwise(np.cumsum([0, *counts]).tolist())]


def _columns(mappings: Sequence[Mapping[str, Number]], counts: Sequence[int]) -> dict[str, Number]:
    """Return numbers of variants as columns with a row for each of their positions."""
    found: dict[str, Number] = {}
    for name in mappings[0]:
        values = [one[name] for one in mappings]
        if any(np.ndim(value) for value in values):
            pairs = zip(values, counts, strict=True)
            found[name] = np.concatenate([np.broadcast_to(v, (n,)) for v, n in pairs])
        else:
            found[name] = np.repeat(values, counts)
    return found


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
        """Names of the values that a cam's follower or another driver gives in every position."""
        return _inputs_by_position(self.problem.drive)

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs that vary with the position, besides the driver's coordinate."""
        loads = () if self.loads is None else self.loads.names
        return (*self.follower_names, *self.results.draft.branches, *loads)

    def at(self, positions: Array) -> list[Array]:
        """Return the columns of `inputs` in some positions: cam, branches and loads."""
        drive = self.problem.drive
        motion = driven(drive, positions) if drive.cam_drive is not None else ()
        columns = [np.asarray(one) for one in motion]
        columns += [other_place(drive, other, positions) for other in drive.other_drives]
        columns += [one.branch(positions) for one in self.results.draft.branches.values()]
        return columns if self.loads is None else columns + self.loads.at(positions)

    @property
    def kind(self) -> tuple[object, ...]:
        """Key that cases on one tape have in common."""
        return self.program.steps, self.results.draft.origin, self.inputs, tuple(self.constants)


SIDE = "side_"
"""What the number of a point's side begins with, where sides are inputs: +1, or -1 of the other."""


def with_sides(case: Case) -> Case:
    """Return a case whose groups close on either side, by numbers that are inputs.

    Each is +1, the side of the case, or -1, the other one. Where a group passes change points, its
    number in each position is there already.
    """
    steps: list[Step] = []
    numbers: dict[str, float] = {}
    for step in case.program.steps:
        if isinstance(step, IntersectCircles | IntersectLineCircle) and step.branch is None:
            name = NumberName(f"{SIDE}{step.out}")
            numbers[name] = 1.0
            steps += [GivenNumber(name), replace(step, branch=name)]
        else:
            steps.append(step)
    return replace(case, program=Program(tuple(steps)), constants={**case.constants, **numbers})


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
        problem = solution.problem
        return LoadColumns(problem, solution.construction, results.changing, self.motion(problem))


def _inputs_by_position(drive: Drive) -> tuple[str, ...]:
    """Return the inputs that vary with the position of the driver, besides it."""
    places = [other.program_inputs[0] for other in drive.other_drives]
    return (*(drive.program_inputs if drive.cam_drive is not None else ()), *places)


def _constants(problem: Problem, results: Quantities) -> dict[str, complex | float]:
    draft, drive = results.draft, problem.drive
    data = drive_data(problem, draft, np.zeros(1))
    data.update(results.numbers)
    followed = _inputs_by_position(drive)
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
        self, cases: Sequence[Case], which: Array, inputs: Mapping[str, Array]
    ) -> list[Array]:
        """Return the inputs that are numbers: ``inputs``, others of the cases ``which``."""
        found: list[Array] = []
        for name in self.free:
            if name in inputs:
                values = inputs[name]
            else:
                values = np.array([one.constants[name] for one in cases])[which]
            found += [values.real, values.imag] if np.iscomplexobj(values) else [values]
        return [column.astype(self.runner.dtype, copy=False) for column in found]


_STRAIGHT = 1e-13
"""Part of a number by which it may be off its straight line: rounding."""


class Lines(Struct, frozen=True):
    """Numbers of the program that follow sizes in straight lines, between the sizes' limits.

    ``numbers`` has the value of each with the sizes of the file, and its slopes by the sizes.
    """

    low: Array
    high: Array
    numbers: Mapping[str, tuple[complex | float, Array]]


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
        self._lines: Lines | None = None
        if not names:
            return
        found = {name: self.parameters.find(name) for name in names}
        unknown = [name for name, one in found.items() if one is None]
        if unknown:
            known = ", ".join(self.offered)
            follows = [name for name in unknown if name in case.constants]
            if follows:
                raise SweepError(
                    "{} follows from other numbers of the file and cannot be varied "
                    "separately. Known: {}.",
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
        return list({name: None for slopes in self.slopes.values() for name in slopes})

    @cached_property
    def slopes(self) -> Mapping[str, Mapping[str, complex | float]]:
        """How each parameter changes numbers of the program, near the file's value.

        None of them where the file cannot be read with another value, or is built by other steps.
        """
        found: dict[str, dict[str, complex | float]] = {
            name: {own: 1.0} for name, own in self.rates.items()
        }
        own = self.case.constants
        for name, one in self.sizes.items():
            found[name], value = {}, 1.001 * one.value or 0.001
            try:
                near = self.cases([one], np.array([[value]]))[0]
            except (SweepError, UnknownNameError):  # the latter: of a step that is drawn
                continue
            if near.kind == self.case.kind:
                found[name] = {
                    number: (v - own[number]) / (value - one.value)
                    for number, v in near.constants.items()
                    if v != own[number]
                }
        return found

    def straight(self, values: Array) -> Mapping[str, Array] | None:
        """Return the numbers of the program with sizes, if they follow these in straight lines.

        A length or a place is such a number itself; the height of a triangle is not. The file is
        read with the least and the largest of each size, and with one set of them.

        Parameters
        ----------
        values : ndarray of shape (sizes, count)

        Returns
        -------
        mapping of str to ndarray of shape (count,), or None
            Those that differ from the file's; None if the file must be read with each sample.
        """
        sizes = list(self.sizes.values())
        start = np.array([[one.value] for one in sizes])
        signed = np.array([one.key[0] != "frame" for one in sizes])
        few = values.shape[1] <= 4 * len(sizes)
        if few or self.case.inputs or not (values[signed] * start[signed] > 0).all():
            return None
        low, high = values.min(axis=1), values.max(axis=1)
        if self._lines is None or (low < self._lines.low).any() or (high > self._lines.high).any():
            self._lines = self._lines_between(values, start, low, high)
        lines, away = self._lines, values - start
        return None if lines is None else {n: v + s @ away for n, (v, s) in lines.numbers.items()}

    def _lines_between(self, values: Array, start: Array, low: Array, high: Array) -> Lines | None:
        count, own = len(values), self.case.constants
        far = np.argmax(np.sum(np.abs(values / np.where(start, start, 1.0) - 1.0), axis=0))
        tried = np.repeat(start, 2 * count + 1, axis=1)
        for k in range(count):
            tried[k, 2 * k : 2 * k + 2] = low[k], high[k]
        tried[:, -1] = values[:, far]
        try:
            cases = self.cases(list(self.sizes.values()), tried)
        except SweepError:  # the sizes are read one by one, and the faulty one is named
            return None
        if any(one.kind[1:] != self.case.kind[1:] for one in cases):
            return None
        numbers: dict[str, tuple[complex | float, Array]] = {}
        width = np.where(high > low, high - low, 1.0)
        for name, value in own.items():
            found = np.array([one.constants[name] for one in cases])
            slopes = (found[1:-1:2] - found[:-1:2]) / width
            lone = (high == low) & (low != start[:, 0])
            slopes[lone] = (found[:-1:2] - value)[lone] / (low - start[:, 0])[lone]
            line = value + slopes @ (tried - start)
            if (np.abs(line - found) > _STRAIGHT * np.abs(found).max()).any():
                return None
            if (found != value).any():
                numbers[name] = value, slopes
        return Lines(low, high, numbers)

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
        for problem, made, named in zip(problems, construct_each(problems), told, strict=True):
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
