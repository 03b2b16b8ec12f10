"""Any number of positions in one call: a program compiled once, run in blocks (развёртка)."""

# no messages: for programs in Python

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.arguments import Named, known, number_of, numbers, of_type, reals, texts
from planmethod.compiled import FEW, Array, Runner
from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import evaluate
from planmethod.construct.steps import Name, PointName
from planmethod.plans.build import plan_of
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Problem
from planmethod.solved.assembly_modes import keeps_modes, reject_ambiguous
from planmethod.solved.failures import (
    Cause,
    Failure,
    Place,
    explain,
    failing,
)
from planmethod.solved.many.positions import blocks
from planmethod.solved.many.rows import SweepRow
from planmethod.solved.many.variants import (
    Case,
    CaseTape,
    SweepError,
    SweepTask,
    Varied,
    with_sides,
)
from planmethod.solved.reading import Reading

if TYPE_CHECKING:
    from planmethod.solved.many.rows import Motion


_AT_ONCE = 2**16
"""Positions of all variants together that are run in one go."""


class SweepTable(Named[Array]):
    """Results of a sweep by the names of their rows; rows of a label can be read together."""

    def __init__(self, columns: dict[str, Array], rows: Sequence[SweepRow]) -> None:
        super().__init__(columns, "result")
        self.rows = tuple(rows)

    def __missing__(self, name: object) -> Array:
        label = known("result", name, [*self, *(row.label for row in self.rows)])
        parts = [self[row.name] for row in self.rows if row.label == label]
        found: Array = parts[0] if len(parts) == 1 else parts[0] + 1j * parts[1]
        return found

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the arguments for rebuilding it in another process."""
        return SweepTable, (dict(self), self.rows)


class DraggedTape(Struct, frozen=True):
    """A tape whose every number may be changed by hand (лента для перетаскивания).

    Attributes
    ----------
    runner : Runner
        Writes the tape. Its inputs are the driver's coordinate, ``free`` (two for a place) and
        ``inputs``, which differ from position to position.
    guards : tuple of (Name, PlanKind)
        Step and plan of every margin that is watched.
    slopes : mapping
        How each parameter of the file changes numbers of the program.
    case : Case
        With the values of the file.
    """

    runner: Runner
    free: tuple[str, ...]
    inputs: tuple[str, ...]
    guards: tuple[tuple[Name, PlanKind], ...]
    slopes: Mapping[str, Mapping[str, complex | float]]
    case: Case


class Sweep:
    """Results of a problem in any number of positions (развёртка по положениям).

    The program is reduced to the requested results, compiled once, and run in blocks that stay in
    the cache: memory holds the results, not the steps.

    Parameters
    ----------
    problem : Problem
    asked : iterable of str, optional
        Labels of results (``v_E``, ``omega_3``, ``F_B_2/1``), or ``positions``, ``velocities``,
        ``accelerations``, ``forces``, ``units``. Default: everything of the motion.
    varied : sequence of str
        Numbers of the file that `run` will be given: ``l_BC``, ``omega_1``, ``x_C``; see
        `parameters`, or dotted keys, ``links.2.D.at``. The results are those of the file with these
        numbers: dependent values, such as a side of a triangle or the assembly of a group, follow
        as they do when a file is read. A rate, a length, a place have no extra cost. Where other
        numbers follow from sizes in no straight line, or another assembly may follow, the file is
        read again for each set, which takes some milliseconds.
    dtype : dtype
        float64; float32 is for pictures only.
    forces : bool
        If no labels are given: everything of the forces, too.
    drawn : sequence of Name
        Points and numbers of the plans that are results as well, SI, each as ``.x`` and ``.y``:
        ``v:c.x``; places as they lie on their plan.
    native : bool, optional
        Compile the tape with the system's C compiler now (True), or never use such code (False).
        Default: it is used for thousands of positions if it was compiled before, and compiled where
        that pays (`Runner`). Without a compiler, with ``PLANMETHOD_NATIVE=0`` and in float32 NumPy
        gives the same numbers to rounding; `uncompiled` is the reason.

    Attributes
    ----------
    rows : tuple of SweepRow
    parameters : dict
        Every number that the file gives and that can be varied, and its value, SI and degrees:
        lengths ``l_AB`` (of slots ``e_B``), third points of links along and across them ``x_D``,
        ``y_D`` (``x_B_D`` of one counted from B), fixed points and guides ``x_O``, ``y_O``,
        ``x_x-x``, angles ``angle_x-x``, ``angle_3``, ``angle_BAD``, rates ``omega_1``,
        ``epsilon_1``, ``v``, ``a``; if forces are requested also masses and moments of inertia
        ``m_2``, ``J_2``, ``g``, loads by their name ``F_5`` and ``angle_F_5``.
    forces : bool
        Forces are among the results.
    branches : dict
        Assembly modes that continue through change points, by the number that gives their side.
    loads : LoadColumns or None
        Loads that must be given for every position.
    steps : int
        Steps of the program that are needed.

    Raises
    ------
    StructureError, ProblemError, AssemblyError, UnknownQuantityError, SweepError

    Examples
    --------
    >>> import numpy as np
    >>> import planmethod
    >>> problem = planmethod.load("problems/linkages/ex3.toml")
    >>> table = planmethod.Sweep(problem, ["omega_3"]).table(np.linspace(0.0, 360.0, 10_001))
    >>> print(f"{table['3.omega'].min():.3f} to {table['3.omega'].max():.3f} 1/s")
    -69.565 to 18.391 1/s
    """

    def __init__(
        self,
        problem: Problem,
        asked: Iterable[str] | None = None,
        *,
        varied: Sequence[str] = (),
        dtype: npt.DTypeLike = np.float64,
        forces: bool = False,
        drawn: Sequence[Name] = (),
        native: bool | None = None,
    ) -> None:
        self.problem = of_type("problem", problem, Problem, "planmethod.load()")
        asked = None if asked is None else texts("asked", asked)
        varied, drawn = texts("varied", varied), [PointName(one) for one in texts("drawn", drawn)]
        self._made_of = (problem, asked, varied, dtype, forces, drawn, native)
        number = _of(dtype)
        if number is None or number not in (np.dtype(np.float64), np.dtype(np.float32)):
            asked_for = dtype if number is None else number
            raise SweepError(f"a sweep is float64 or float32, not {asked_for}")
        self._settings: tuple[Any, bool | None] = np.dtype(dtype), native
        self._drawn = tuple(drawn)
        task = SweepTask(asked, forces, self._drawn, _motion_of)
        self._case = task.of(problem)
        self.forces = any(result.kind.is_force for result in self._case.chosen)
        self.loads, self._draft = self._case.loads, self._case.results.draft
        self.program, self.constants = self._case.program, self._case.constants
        self.branches = self._draft.branches
        self._untold = any(closing.only_at for closing in self._draft.choice.values())
        plans = {plan_of(result.kind) for result in self._case.chosen}
        if self._untold and plans != {PlanKind.POSITION}:
            reject_ambiguous(problem, self._draft)
        self.steps = len(self.program.steps)
        self.driver = problem.drive.coordinate.name
        self.varied = varied
        self._varied = Varied(self._case, task, varied)
        self.parameters = self._varied.offered
        self._tape = self._written(self._case, self._varied.probed())
        self._tapes = {self._case.kind: self._tape}
        self._met: dict[Name, int] = {}  # guards that only other cases have
        self.rows = self._tape.rows

    def __reduce__(self) -> tuple[object, ...]:
        """Return how another process rebuilds the sweep: it is compiled there again."""
        return _rebuild, self._made_of

    def _written(self, case: Case, free: Sequence[str]) -> CaseTape:
        dtype, native = self._settings
        return CaseTape(case, free, self._drawn, dtype, native)

    @property
    def runner(self) -> Runner:
        """What runs the tape."""
        return self._tape.runner

    @property
    def operations(self) -> int:
        """Real operations for one position, after folding."""
        return self.runner.operations

    @property
    def live(self) -> int:
        """Most numbers of a position that are in use at a time."""
        return self.runner.live

    @property
    def uncompiled(self) -> str:
        """Reason why there is no machine code; empty if there is some."""
        return self.runner.uncompiled

    def run(
        self,
        positions: npt.ArrayLike,
        parameters: Mapping[str, npt.ArrayLike] | None = None,
        *,
        out: Array | None = None,
        failed: npt.NDArray[np.int16] | None = None,
    ) -> Array:
        """Return the results of some positions.

        Parameters
        ----------
        positions : ndarray of shape (n,)
            phi in degrees, or s in metres; angles of a cam that drives, degrees.
        parameters : mapping of str to ndarray of shape (n,), (v, 1) or scalar, optional
            Values of `varied`. Of shape (v, 1) they make v variants of every position.
        out : ndarray of shape (k, ...), optional
            Buffer for the results; a fresh one costs more time than the arithmetic.
        failed : ndarray of int16 of the shape of the positions, optional
            Filled with -1, or with the number of the first impossible step's guard (`reason`).

        Returns
        -------
        ndarray of shape (k, n), or (k, v, n) for variants
            NaN where a step that the result depends on is impossible.

        Raises
        ------
        SweepError
            The shapes do not match.
        """
        angle = reals("positions", positions, self.runner.dtype)
        parameters = {} if parameters is None else of_type("parameters", parameters, Mapping)
        if self._untold:
            reject_ambiguous(self.problem, self._draft, angle)
        # A single variant has one shape: nothing needs to be checked.
        if not (self.varied or parameters) and angle.ndim == 1 and out is None and failed is None:
            found = self.runner.few(lambda: [angle, *self._position_columns(angle)], len(angle))
            if found is not None:
                return found
        if set(parameters) != set(self.varied):
            raise SweepError(f"run() takes the parameters {', '.join(self.varied) or '(none)'}")
        # A size goes into a file, which is double precision in any sweep.
        given = {name: reals(name, parameters[name]) for name in self.varied}
        shape = self._shape(angle, list(given.values()), out, failed)
        rates = {own: given[name] for name, own in self._varied.rates.items()}
        sizes = [given[name] for name in self._varied.sizes]
        if (
            sizes
            and (found := self._run_straight(angle, shape, sizes, rates, out, failed)) is not None
        ):
            return found
        cases, which = self._cases(sizes)
        return self._run(angle, shape, cases, which, rates, out, failed)

    def _run_straight(
        self,
        angle: Array,
        shape: tuple[int, ...],
        sizes: Sequence[Array],
        rates: Mapping[str, Array],
        out: Array | None,
        failed: npt.NDArray[np.int16] | None,
    ) -> Array | None:
        """Run sizes as inputs of the tape; None if the file must be read with each set of them."""
        own_shape = np.broadcast_shapes(*(value.shape for value in sizes))
        columns = np.stack([np.broadcast_to(value, own_shape).ravel() for value in sizes])
        numbers = self._varied.straight(columns)
        if numbers is None:
            return None
        more = [name for name in numbers if name not in self._tape.free]
        if more:
            self._tape = self._written(self._case, (*self._tape.free, *more))
            self._tapes[self._case.kind] = self._tape
        kept = keeps_modes(self._case.construction, numbers, columns.shape[1])
        given = {name: value.reshape(own_shape) for name, value in numbers.items()}
        alone, none = [self._case], np.zeros((), np.intp)
        inputs = [angle, *self._tape.columns(alone, none, {**rates, **given})]
        found = self._run_inputs(inputs, shape, out, failed)
        if kept.all():
            return found
        # Another assembly, or a first position that does not exist: the file is read with these.
        odd = ~np.broadcast_to(kept.reshape(own_shape), shape)
        other = [np.broadcast_to(value, shape)[odd] for value in sizes]
        wide = {name: np.broadcast_to(rate, shape)[odd] for name, rate in rates.items()}
        gaps = None if failed is None else np.empty(int(odd.sum()), failed.dtype)
        cases, which = self._cases(other)
        here = np.broadcast_to(angle, shape)[odd]
        found[:, odd] = self._run(here, here.shape, cases, which, wide, None, gaps)
        if failed is not None and gaps is not None:
            failed[odd] = gaps
        return found

    def _run_inputs(
        self,
        inputs: Sequence[Array],
        shape: tuple[int, ...],
        out: Array | None,
        failed: npt.NDArray[np.int16] | None,
    ) -> Array:
        """Run the tape; several variants at once, since those of few positions are mostly calls."""
        if out is None:
            out = np.empty((len(self.rows), *shape), self.runner.dtype)
        self.runner.expect(math.prod(shape))
        if len(shape) == 1 or self.runner.accepts(out, failed):
            self.runner.run(inputs, out, failed)
            return out
        wide = [np.broadcast_to(column, shape) for column in inputs]
        for part in blocks(shape[0], max(1, _AT_ONCE // max(1, shape[1]))):
            here = [column[part].ravel() for column in wide]
            gaps = None if failed is None else np.empty(here[0].shape, failed.dtype)
            values = np.empty((len(out), *here[0].shape), out.dtype)
            self.runner.run(here, values, gaps)
            out[:, part] = values.reshape(out[:, part].shape)
            if failed is not None and gaps is not None:
                failed[part] = gaps.reshape(failed[part].shape)
        return out

    def _run(
        self,
        angle: Array,
        shape: tuple[int, ...],
        cases: Sequence[Case],
        which: Array,
        rates: Mapping[str, Array],
        out: Array | None,
        failed: npt.NDArray[np.int16] | None,
    ) -> Array:
        """Run cases in some positions; ``which`` and ``rates`` go together with ``shape``."""
        tapes = self._case_tapes(cases)
        alike = len(set(map(id, tapes))) == 1
        if out is None and alike and tapes[0] is self._tape and not self._case.inputs:
            columns = self._tape.columns(cases, which, rates)
            few = None
            if failed is None and len(shape) == 1:
                few = self.runner.few(lambda: [angle, *columns], shape[0])
            if few is not None:
                return few
        if out is None:
            out = np.empty((len(self.rows), *shape), self.runner.dtype)
        self.runner.expect(math.prod(shape))
        one = len(cases) == 1 and len(shape) == 1
        if alike and (one or not self._case.inputs):
            columns = tapes[0].columns(cases, which, rates)
            told = self._typed(cases[0].at(angle)) if self._case.inputs else []
            tapes[0].runner.run([angle, *columns, *told], out, failed)
            self._number_guards(tapes[0], failed)
            return out
        whole = np.broadcast_to(angle, shape).ravel()
        of = np.broadcast_to(which, shape).ravel()
        wide = {name: np.broadcast_to(rate, shape).ravel() for name, rate in rates.items()}
        gaps = None if failed is None else np.empty(whole.shape, failed.dtype)
        values = np.empty((len(self.rows), len(whole)), self.runner.dtype)
        # Values that vary with the position are known for the positions of one case.
        apart = list(range(len(cases))) if self._case.inputs else [id(tape) for tape in tapes]
        for part in dict.fromkeys(apart):
            mine = np.array([own == part for own in apart])
            first, at = int(np.flatnonzero(mine)[0]), np.flatnonzero(mine[of])
            tape, here = tapes[first], whole[at]
            columns = tape.columns(cases, of[at], {n: rate[at] for n, rate in wide.items()})
            told = self._typed(cases[first].at(here))
            found = np.empty((len(self.rows), len(at)), self.runner.dtype)
            codes = None if gaps is None else np.empty(len(at), gaps.dtype)
            tape.runner.run([here, *columns, *told], found, codes)
            self._number_guards(tape, codes)
            values[:, at] = found
            if gaps is not None and codes is not None:
                gaps[at] = codes
        out[...] = values.reshape(out.shape)
        if failed is not None and gaps is not None:
            failed[...] = gaps.reshape(failed.shape)
        return out

    def _run_variants(
        self, problems: Sequence[Problem], positions: npt.ArrayLike
    ) -> tuple[tuple[SweepRow, ...], Array]:
        """Return the rows and the results of variants, shape (k, v, n)."""
        cases = [self._varied.task.of(problem) for problem in problems]
        for case in cases:
            if case.program.steps != self.program.steps:
                raise SweepError(
                    "{} is not built by the same steps as {}: sweep it separately",
                    _named(case.problem),
                    _named(self.problem),
                )
        angle, which = np.asarray(positions, dtype=float), np.arange(len(cases))[:, np.newaxis]
        shape = (len(cases), len(angle))
        return self.rows, self._run(angle, shape, cases, which, {}, None, None)

    def _cases(self, sizes: list[Array]) -> tuple[list[Case], Array]:
        """Return the distinct cases of some sizes, and the index of each entry's case."""
        if not sizes:
            return [self._case], np.zeros((), np.intp)
        shape = np.broadcast_shapes(*(value.shape for value in sizes))
        columns = np.stack([np.broadcast_to(value, shape).ravel() for value in sizes])
        unlike, which = np.unique(columns, axis=1, return_inverse=True)
        cases = self._varied.cases(list(self._varied.sizes.values()), unlike)
        return cases, which.reshape(shape)

    def _case_tapes(self, cases: Sequence[Case]) -> list[CaseTape]:
        """Return the tape of every case; a number in which cases differ becomes an input of it."""
        alike: dict[tuple[object, ...], list[Case]] = {}
        kinds = [self._case.kind if one is self._case else one.kind for one in cases]
        for one, kind in zip(cases, kinds, strict=True):
            alike.setdefault(kind, []).append(one)
        for kind, members in alike.items():
            tape = self._tapes.get(kind) or self._written(
                members[0], list(self._varied.rates.values())
            )
            more = tape.lacks(members)
            if more:
                tape = self._written(tape.case, (*tape.free, *more))
            if tape.rows != self.rows:
                raise SweepError(
                    "{} has additional results ({}): sweep it separately",
                    members[0].variation or _named(members[0].problem),
                    ", ".join({row.label: "" for row in tape.rows if row not in self.rows}),
                )
            self._tapes[kind] = tape
        self._tape = self._tapes[self._case.kind]
        return [self._tapes[kind] for kind in kinds]

    def _number_guards(self, tape: CaseTape, failed: npt.NDArray[np.int16] | None) -> None:
        """Give the guards of another tape the numbers by which `reason` knows them."""
        if failed is None or tape is self._tape or not (failed >= 0).any():
            return
        mine = {step: number for number, step in enumerate(self.runner.guards)}
        numbers = [
            mine.get(step, len(mine) + self._met.setdefault(step, len(self._met)))
            for step in tape.runner.guards
        ]
        bad = failed >= 0
        failed[bad] = np.array(numbers)[failed[bad]]

    def bind(
        self,
        positions: npt.ArrayLike,
        parameters: Mapping[str, npt.ArrayLike] | None = None,
        *,
        out: Array | None = None,
        failed: npt.NDArray[np.int16] | None = None,
    ) -> Callable[[], Array]:
        """Return a function that does `run` for these arrays: all is prepared and checked now.

        An array of float64 is read at every call, so that new positions and parameters are written
        into it. Intended for few positions that are computed repeatedly: the tape is compiled if
        possible.

        Returns
        -------
        callable
            Function without arguments; it fills ``out`` (and ``failed``) and returns it, the same
            array every time.
        """
        angle = reals("positions", positions, self.runner.dtype)
        sizes = {} if parameters is None else of_type("parameters", parameters, Mapping)
        given = {name: reals(name, value) for name, value in sizes.items()}
        filled = self.run(angle, given, out=out, failed=failed)
        out = np.array(filled, order="C") if out is None else out
        self.runner.compile()
        apart = bool(self._varied.sizes) or (out.ndim == 3 and bool(self._case.inputs))
        if apart or not self.runner.accepts(out, failed):
            return lambda: self._again(angle, given, out, failed)
        told = self._position_columns(angle)
        rates = {own: given[name] for name, own in self._varied.rates.items()}
        numbers = self._tape.columns([self._case], np.zeros((), np.intp), rates)
        call = self.runner.bound([angle, *numbers, *told], out, failed)
        if not told:

            def bound() -> Array:
                call()
                return out

            return bound

        def bound_loads() -> Array:
            for column, value in zip(told, self._position_columns(angle), strict=True):
                column[...] = value
            call()
            return out

        return bound_loads

    def _again(
        self, angle: Array, parameters: Mapping[str, Array], out: Array, failed: Array | None
    ) -> Array:
        """Run into a buffer, few positions as one line of Python."""
        if failed is None and out.ndim == 2 and out.shape[1] <= FEW:
            out[...] = self.run(angle, parameters)
            return out
        return self.run(angle, parameters, out=out, failed=failed)

    def _position_columns(self, positions: Array) -> list[Array]:
        """Return the columns that differ from position to position: cam, branches and loads."""
        return self._typed(self._case.at(positions))

    def _typed(self, columns: Sequence[Array]) -> list[Array]:
        return [column.astype(self.runner.dtype) for column in columns]

    def _shape(
        self, angle: Array, extra: list[Array], out: Array | None, failed: Array | None
    ) -> tuple[int, ...]:
        """Return the shape of the positions with their parameters, the buffers being of it."""
        try:
            shape = np.broadcast_shapes(angle.shape, *(value.shape for value in extra))
        except ValueError:
            text = ", ".join(f"{n} {v.shape}" for n, v in zip(self.varied, extra, strict=True))
            raise SweepError(
                f"positions of shape {angle.shape} do not go with parameters of shape {text}"
            ) from None
        if len(shape) not in (1, 2):
            raise SweepError(
                f"positions and parameters make an array of shape {shape}; positions are of shape "
                "(n,), parameters of shape (n,), (v, 1) or one number"
            )
        for name, buffer, wanted in (
            ("out", out, (len(self.rows), *shape)),
            ("failed", failed, shape),
        ):
            if buffer is not None and getattr(buffer, "shape", None) != wanted:
                given = getattr(buffer, "shape", type(buffer).__name__)
                raise SweepError(f"{name} must be an array of shape {wanted}, got {given}")
        if failed is not None and not np.issubdtype(failed.dtype, np.signedinteger):
            raise SweepError(f"failed must be of a signed integer type, got {failed.dtype}")
        return shape

    def table(
        self, positions: npt.ArrayLike, parameters: Mapping[str, npt.ArrayLike] | None = None
    ) -> dict[str, Array]:
        """Return the results by the names of their rows, and by their labels.

        ``3.omega`` and ``omega_3`` are the same; a vector such as ``v_E`` has the rows ``E.vx`` and
        ``E.vy`` and is itself complex.
        """
        found = self.run(positions, parameters)
        rows = {row.name: values for row, values in zip(self.rows, found, strict=True)}
        return SweepTable(rows, self.rows)

    @property
    def guards(self) -> list[tuple[Name, PlanKind]]:
        """Step and plan of every margin that is watched, by the numbers of `reason`."""
        return self._plans_of(self._guards)

    def _plans_of(self, guards: Iterable[Name]) -> list[tuple[Name, PlanKind]]:
        plans = self._draft.plans
        return [(step, plans.get(step, PlanKind.POSITION)) for step in guards]

    @property
    def _guards(self) -> tuple[Name, ...]:
        return (*self.runner.guards, *self._met)

    def javascript(self) -> str:
        """Return the source of a function of JavaScript: of a position, branches and loads.

        It returns the results of one position in the order of the rows; see `Runner.javascript`.
        """
        return self.runner.javascript()

    def dragged(self) -> DraggedTape:
        """Return the tape with all that was varied, and the side of each group, as its inputs."""
        case = with_sides(self._case)
        sides = tuple(name for name in case.constants if name not in self._case.constants)
        tape = self._written(case, (*self._varied.probed(), *sides))
        guards = tuple(self._plans_of(tape.runner.guards))
        slopes = self._varied.slopes
        return DraggedTape(tape.runner, tape.free, self._case.inputs, guards, slopes, case)

    def reason(self, guard: int) -> str:
        """Return the step behind a guard's number; empty for -1, which no guard has."""
        if isinstance(guard, int | np.integer) and guard == -1:
            return ""
        return str(self._guards[number_of("guard", guard, len(self._guards))])

    def explain(self, position: float, *, number: int | None = None) -> str:
        """Return why a position is impossible, in the words and numbers of the drawing.

        Parameters
        ----------
        number : int, optional
            Number of the position, from 0, for the message. Default: it is the only one.

        Returns
        -------
        str
            Empty if every step that the sweep needs exists there.
        """
        found = self.failure(position)
        if found is not None and number is not None:
            found = found.numbered(number, 0)
        return "" if found is None else str(found)

    def failure(self, position: float) -> Failure | None:
        """Return why a position is impossible; None if every step that is needed exists there."""
        at = numbers("position", [position])
        if not np.isfinite(position):
            return Failure(Cause.NO_NUMBER, Place.of(self.problem, at, 0))
        told = zip(self._case.inputs, self._case.at(at), strict=True)
        data: dict[str, Any] = {**self.constants, self.driver: at, **dict(told)}
        reading = Reading(evaluate(self.program, data, Float64()), 1)
        if failing(self.program, reading.trace, 1)[0] < 0:
            return None
        return explain(self._draft, self.program, reading, at)


def _rebuild(
    problem: Problem,
    quantities: Iterable[str] | None,
    varied: Sequence[str],
    dtype: npt.DTypeLike,
    forces: bool,
    drawn: Sequence[Name],
    native: bool | None,
) -> Sweep:
    return Sweep(
        problem, quantities, varied=varied, dtype=dtype, forces=forces, drawn=drawn, native=native
    )


def _of(dtype: npt.DTypeLike) -> np.dtype[Any] | None:
    try:
        return np.dtype(dtype) if dtype is not None else None
    except (TypeError, ValueError, AttributeError):
        return None


def sweep_variants(
    problems: Sequence[Problem], positions: npt.ArrayLike, asked: Iterable[str] | None = None
) -> tuple[tuple[SweepRow, ...], Array]:
    """Return the results of several variants of one problem in the same positions.

    Variants that are built by the same steps and differ in numbers only go through one compiled
    program.

    Returns
    -------
    rows : tuple of SweepRow
    values : ndarray of shape (k, v, n)

    Raises
    ------
    SweepError
        When the variants are not built by the same steps.
    """
    return Sweep(problems[0], asked)._run_variants(problems, positions)


def _named(problem: Problem) -> str:
    return problem.name + (f" ({problem.variant})" if problem.variant else "")


def _motion_of(problem: Problem) -> Motion:
    """Return a sweep of a problem's motion, made at the first call."""
    made: list[Sweep] = []

    def swept(positions: Array) -> dict[str, Array]:
        if not made:
            made.append(Sweep(problem))
        return made[0].table(positions)

    return swept
