"""Rows of a sweep: the numbers on a tape that form a result, its loads, its labels."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cached_property
from typing import assert_never

from msgspec import Struct

from planmethod.compiled import PiecewiseTape, Ref, Symbol, Tape, TapeProgram, javascript_function
from planmethod.construct.arithmetic import Number
from planmethod.construct.steps import Name, NumberName
from planmethod.plans.build import Construction, Quantity
from planmethod.plans.forces.polygons import numbers_of
from planmethod.plans.model import FACTS, PlanKind
from planmethod.problem.model import Problem
from planmethod.problem.quantities import CENTRES, TRANSFERS, Measure, QuantityKey, QuantityKind
from planmethod.problem.records import Load
from planmethod.solved.forces.laws import GivenLoads, needs_motion
from planmethod.solved.forces.loads import changing
from planmethod.solved.quantities import Quantities, UnknownQuantityError, key_of, quantities_of
from planmethod.solved.reading import Memoizing, Reals
from planmethod.solved.solution import LinkMotion, PointMotion, Solution

FORCES = FACTS[PlanKind.FORCE].prefix


class SweepRow(Struct, frozen=True):
    """One row of a sweep's output.

    Attributes
    ----------
    name : str
        ``B.x``, ``B.vy``, ``2.phi_deg``, ``2.cos``, ``2.omega``, ``F.B.2-1.x``: the columns of
        ``solve --csv``.
    label : str
        Label of its result: ``B``, ``v_B``, ``phi_2``.
    is_force : bool
        True for a force or a moment.
    """

    name: str
    label: str
    is_force: bool = False


def rows_of(
    chosen: Sequence[Quantity],
    written: TapeProgram,
    origin: complex,
    load_motion: Sequence[Quantity] = (),
    drawn: Sequence[Name] = (),
) -> tuple[tuple[SweepRow, ...], list[Ref], list[frozenset[int]]]:
    """Return the rows of some results: their names, their numbers on the tape, their guards.

    Parameters
    ----------
    origin : complex, m
        From which the places on the tape count.
    load_motion : sequence of Result
        Quantities on which the loads, and so all forces, depend.
    drawn : sequence of Name
        Points and numbers of the plans that are rows as well.
    """
    loaded = frozenset[int]().union(*(written.depends[result.name] for result in load_motion))
    rows: list[SweepRow] = []
    refs: list[Ref] = []
    depends: list[frozenset[int]] = []
    for result in chosen:
        parts = list(_parts(result, written))
        if result.kind is QuantityKind.PLACE:
            here = zip(parts, (origin.real, origin.imag), strict=True)
            parts = [written.tape.add(part, at) for part, at in here]
        rows += [SweepRow(name, result.label, result.kind.is_force) for name in result.columns]
        refs += parts
        mine = written.depends[result.name]
        depends += [mine | loaded if result.kind.is_force else mine] * len(parts)
    for name in drawn:
        place: Symbol = written.value[name]
        rows += [SweepRow(f"{name}.{axis}", name) for axis in "xy"]
        refs += [place.re, 0.0 if place.im is None else place.im]
        mine = written.depends[name]
        depends += [mine | loaded if name.startswith(FORCES) else mine] * 2
    return tuple(rows), refs, depends


def _parts(result: Quantity, written: TapeProgram) -> Iterator[Ref]:
    """Yield the numbers of the tape that a result consists of, one for each column."""
    value, tape = written.value[result.name], written.tape
    along: Symbol = value[1] if isinstance(value, tuple) else value
    x, y = along.re, 0.0 if along.im is None else along.im
    match result.kind.measure:
        case Measure.NUMBER:
            yield x
        case Measure.ANGLE:
            yield tape.add_node("degrees", tape.add_node("atan2", y, x))
        case Measure.PLACE | Measure.VECTOR:
            yield from (x, y)
            if len(result.columns) > 2:
                yield abs(along).re
        case Measure.DIRECTION:
            along = along / abs(along)
            yield from (along.re, 0.0 if along.im is None else along.im)
        case never:
            assert_never(never)


Motion = Callable[[Reals], dict[str, Reals]]
"""Rows of a sweep of the motion by their names, in some positions."""


class SweptMotion:
    """Motion of a mechanism from a sweep, for `loads`: NaN where it does not exist."""

    def __init__(
        self, problem: Problem, construction: Construction, positions: Reals, motion: Motion
    ) -> None:
        self.problem, self.construction, self.positions = problem, construction, positions
        self._motion = motion

    @cached_property
    def _rows(self) -> dict[str, Reals]:
        return self._motion(self.positions)

    @cached_property
    def points(self) -> dict[str, PointMotion]:
        """Motion of every named point."""
        rows = self._rows
        return {
            name: PointMotion(
                *(
                    rows[f"{name}.{letter}x"] + 1j * rows[f"{name}.{letter}y"]
                    for letter in ("", "v", "a")
                )
            )
            for name in self.construction.kinematics.velocity.named
        }

    @cached_property
    def links(self) -> dict[str, LinkMotion]:
        """Motion of every moving link."""
        rows = self._rows
        return {
            link: LinkMotion(
                *(rows[f"{link}.{quantity}"] for quantity in ("phi_deg", "omega", "epsilon"))
            )
            for link in self.problem.mechanism.links
        }


class TapeMotion(Memoizing):
    """Motion as numbers of a tape, for `laws`: its inputs are the driver and rows of a sweep.

    Parameters
    ----------
    rows : sequence of str
        Names of the rows, in the order of the inputs after the driver's position.
    """

    def __init__(self, problem: Problem, construction: Construction, rows: Sequence[str]) -> None:
        super().__init__()
        self.problem, self.construction = problem, construction
        self.tape = Tape()
        self.arithmetic = PiecewiseTape(self.tape)
        self._inputs = {name: number for number, name in enumerate(rows, 1)}
        self.positions: Number = self.arithmetic.input(0)

    def _real(self, row: str) -> Number:
        return self.arithmetic.input(self._inputs[row])

    def _vector(self, row: str) -> Number:
        return self._real(f"{row}x") + 1j * self._real(f"{row}y")

    @cached_property
    def points(self) -> dict[str, PointMotion]:
        """Motion of every named point."""
        return {
            name: PointMotion(*(self._vector(f"{name}.{letter}") for letter in ("", "v", "a")))
            for name in self.construction.kinematics.velocity.named
        }

    @cached_property
    def links(self) -> dict[str, LinkMotion]:
        """Motion of every moving link."""
        return {
            link: LinkMotion(
                *(self._real(f"{link}.{row}") for row in ("phi_deg", "omega", "epsilon"))
            )
            for link in self.problem.mechanism.links
        }


class LoadColumns:
    """Loads of a problem that differ from position to position.

    Parameters
    ----------
    problem : Problem
    construction : Construction
    loads : sequence of (str, tuple of NumberName)
        Names, and the known numbers of a program that depend on each.
    motion : callable
        Function that sweeps the motion; called only for loads that depend on it.

    Attributes
    ----------
    names : tuple of NumberName
        Inputs of the program.
    loads : tuple of str
        Names of the loads, in the order of the inputs: two of a force, one of a couple.
    need_motion : bool
        True if some load depends on the motion.
    """

    def __init__(
        self,
        problem: Problem,
        construction: Construction,
        loads: Sequence[tuple[str, tuple[NumberName, ...]]],
        motion: Motion,
    ) -> None:
        self.problem, self.construction, self._motion = problem, construction, motion
        self._loads = tuple(loads)
        self.names = tuple(name for _, names in loads for name in names)
        self.loads = tuple(name for name, _ in loads)
        mine, dynamics = {name for name, _ in loads}, problem.dynamics
        assert dynamics is not None
        self.need_motion = any(needs_motion(load) for load in dynamics.loads if load.name in mine)

    def at(self, positions: Reals) -> list[Reals]:
        """Return the columns of the inputs in some positions, ndarrays of shape (n,).

        Raises
        ------
        ProblemError
            A load is known only in the file's positions, and others are requested.
        """
        moved = SweptMotion(self.problem, self.construction, positions, self._motion)
        found = changing(moved)
        return [number for name, _ in self._loads for number in numbers_of(found[name])]

    def javascript(self, rows: Sequence[str]) -> str:
        """Return the source of ``loads(x, out)``: the inputs in a position, by rows of the motion.

        Parameters
        ----------
        rows : sequence of str
            Names of the outputs ``out`` of the program, the motion among them.
        """
        motion = TapeMotion(self.problem, self.construction, rows)
        given, ar = GivenLoads(motion, motion.arithmetic), motion.arithmetic
        assert self.problem.dynamics is not None
        own = {load.name: load for load in self.problem.dynamics.loads}
        told: list[Ref] = []
        for name in self.loads:
            value = given.value(own[name])
            if isinstance(own[name], Load):
                told += [ar.degrees(ar.angle(value)).re, abs(value).re]
            else:
                told.append(value.re)
        outputs = ["x", *(f"out[{number}]" for number in range(len(rows)))]
        return javascript_function("loads(x, out)", motion.tape, told, outputs)


def relative_motions(
    solution: Solution, quantities: Quantities, keys: Iterable[QuantityKey]
) -> Quantities:
    """Return quantities with those of two points; a name that has none adds none."""
    from planmethod.solved.quantity_steps import NoValueError, QuantitySteps

    steps, more = QuantitySteps(solution, draft=quantities.draft), []
    for key in keys:
        with suppress(NoValueError):  # the label is reported as unknown
            more.append(steps.relative_motion(key))
    return Quantities(steps.b.program(), steps.draft.numbers, (*quantities.all, *more), steps.draft)


def quantities_for(
    solution: Solution, labels: Iterable[str] | None, *, forces: bool = False
) -> Quantities:
    """Return the quantities that include all labelled ones: forces are planned only if needed.

    Parameters
    ----------
    labels : iterable of str, optional
        Default: everything of the motion.
    forces : bool
        If no labels are given: everything of the forces, too.

    Raises
    ------
    UnknownQuantityError
        A force of a problem without masses and loads is requested.
    """
    quantities = quantities_of(solution.construction)
    keys: dict[str, QuantityKey | None] = {}
    if labels is not None:
        labels, names = tuple(labels), solution.problem.names_of_letters
        keys = {label: key_of(label, names) for label in labels}
        kinds = {key.kind for key in keys.values() if key and not key.is_analogue}
        if "transfers" in labels or not kinds.isdisjoint(TRANSFERS):
            quantities = quantities_of(solution.construction, transfers=True)
    other = [label for label in keys if not quantities.find(label)]
    if unknown := [key for label in other if (key := keys[label]) and not key.is_loaded]:
        quantities = relative_motions(solution, quantities, unknown)
        other = [label for label in other if not quantities.find(label)]
    for label in other:
        if (key := keys[label]) and key.kind in CENTRES:
            raise UnknownQuantityError(
                "no result {!r}: centres differ by position. `solve --centres --csv` writes them; "
                "`solve --compare` compares yours.",
                label,
            )
    if not (other or (forces and labels is None)):
        return quantities
    if solution.problem.dynamics is not None:
        from planmethod.solved.forces.reading import with_forces

        return with_forces(solution, quantities)
    letters = (QuantityKind.REACTION.letter, QuantityKind.MOMENT.letter)
    for label in other:
        key = keys[label]
        if label == "forces" or label.partition("_")[0] in letters or (key and key.is_loaded):
            raise UnknownQuantityError(
                "no result {!r}: the problem has no loads. Give the masses in [dynamics] and "
                "the loads in [[loads]].",
                label,
            )
    return quantities
