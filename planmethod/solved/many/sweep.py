"""Any number of positions in one call: a program compiled once, run in blocks (развёртка)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from planmethod.compiled import FEW, Array, Runner, write
from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import evaluate
from planmethod.construct.steps import Name
from planmethod.errors import PlanMethodError
from planmethod.plans.closing import Start
from planmethod.plans.legend import ZERO, Quantity, QuantityKind
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Problem
from planmethod.solved.closings import drive_data
from planmethod.solved.driving import driven
from planmethod.solved.failures import Cause, Failure, Place
from planmethod.solved.impossible import explain, failing
from planmethod.solved.labelled import quantities_for
from planmethod.solved.many.rows import SweepRow, rows_of
from planmethod.solved.quantities import Quantities
from planmethod.solved.reading import Reading
from planmethod.solved.solution import UNIT_SCALES, Solution

if TYPE_CHECKING:
    from planmethod.solved.many.loads import LoadColumns


class SweepError(PlanMethodError, ValueError):
    """Parameters or variants that one sweep cannot hold."""


class Sweep:
    """Results of a problem in any number of positions (развёртка по положениям).

    The program is cut down to what is asked, compiled once, and run in blocks that stay in the
    cache: memory holds the answers, not the steps.

    Parameters
    ----------
    problem : Problem
    asked : iterable of str, optional
        Labels of results (``v_E``, ``omega_3``, ``F_B_2/1``), or ``positions``, ``velocities``,
        ``accelerations``, ``forces``, ``units``; everything of the motion when absent.
    varied : sequence of str
        Known numbers that `run` will be given: ``l_BC``, ``omega_1``; see `parameters`. They are
        numbers of the construction: a third point keeps its coordinates along and across its link
        (``x_D``, ``y_D``) when a length of the link is varied, and a length must stay positive.
    dtype : dtype
        float64; float32 is for pictures only.
    forces : bool
        Where nothing is asked by name: everything of the forces, too.
    drawn : sequence of Name
        Points and numbers of the plans that are results as well, SI, each as ``.x`` and ``.y``:
        ``v:c.x``; places as they lie on their plan.
    native : bool, optional
        Compile the tape with the system's C compiler now (True), or never use such code (False).
        When absent, it is used for thousands of positions if it was compiled before, and compiled
        where that pays (`Runner`). Without a compiler, with ``PLANMETHOD_NATIVE=0`` and in float32
        NumPy gives the same numbers to rounding; `uncompiled` says why.

    Attributes
    ----------
    rows : tuple of SweepRow
    parameters : dict
        Every known number of the motion and its value, SI and degrees.
    forces : bool
        Forces are among the results.
    branches : dict
        Closings that go on through change points, by the number that tells their side.
    loads : LoadColumns or None
        Loads that must be told for every position.
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
        asked = (asked,) if isinstance(asked, str) else None if asked is None else tuple(asked)
        varied = (varied,) if isinstance(varied, str) else tuple(varied)
        self._made_of = (problem, asked, varied, dtype, forces, tuple(drawn), native)
        self.problem = problem
        if np.dtype(dtype) not in (np.dtype(np.float64), np.dtype(np.float32)):
            raise SweepError(f"a sweep is float64 or float32, not {np.dtype(dtype).name}")
        solution = Solution(problem, positions=[])
        results = quantities_for(solution, asked, forces=forces)
        chosen = results.choose(asked)
        self.forces = any(result.kind.is_force for result in chosen)
        self.loads = self._changing(solution, results)
        # Loads against a motion are known only where all steps of that motion exist.
        moved = _motion(results) if self.loads is not None and self.loads.need_motion else []
        self._draft = results.draft
        self.program = results.program.needed_for([*(r.name for r in (*chosen, *moved)), *drawn])
        self.steps = len(self.program.steps)
        self.driver = problem.drive.coordinate.name
        self._followed = problem.drive.given if problem.drive.followed is not None else ()
        data = drive_data(problem, results.draft, np.zeros(1))
        data.update(results.numbers)
        self.constants: dict[str, complex | float] = {
            name: complex(value) if np.iscomplexobj(value) else float(np.asarray(value).real)
            for name, value in data.items()
            if name != self.driver and name not in (*results.draft.branches, *self._followed)
        }
        own = drive_data(problem, solution.construction.draft, np.zeros(1))
        self.branches = results.draft.branches
        self.parameters: dict[str, float] = {
            name: value
            for name, value in self.constants.items()
            if isinstance(value, float) and name in own and name not in (*UNIT_SCALES, ZERO)
        }
        self._check(varied)
        self.varied = tuple(varied)
        fixed = {name: v for name, v in self.constants.items() if name not in self.varied}
        given = (*self._followed, *self.branches, *(() if self.loads is None else self.loads.names))
        inputs = (self.driver, *self.varied, *given)
        written = write(self.program, fixed, inputs, solution.construction.parts)
        self.rows, refs, depends = rows_of(chosen, written, results.draft.origin, moved, drawn)
        self._runner = Runner(written, refs, depends, dtype=dtype, native=native)

    def __reduce__(self) -> tuple[object, ...]:
        """Return what another process makes it of: it is compiled there anew."""
        return _made_again, self._made_of

    def _changing(self, solution: Solution, results: Quantities) -> LoadColumns | None:
        """Return the loads that must be told for every position; None if there are none."""
        if not (self.forces and results.changing):
            return None
        from planmethod.solved.many.loads import LoadColumns

        motion: list[Sweep] = []

        def swept(positions: Array) -> dict[str, Array]:
            if not motion:
                motion.append(Sweep(self.problem))
            return motion[0].table(positions)

        return LoadColumns(self.problem, solution.construction, results.changing, swept)

    @property
    def operations(self) -> int:
        """Real operations for one position, after folding."""
        return self._runner.operations

    @property
    def live(self) -> int:
        """Most numbers of a position that are in use at a time."""
        return self._runner.live

    @property
    def uncompiled(self) -> str:
        """Why there is no machine code; empty if there is."""
        return self._runner.uncompiled

    def _check(self, varied: Sequence[str]) -> None:
        unknown = [name for name in varied if name not in self.parameters]
        if unknown:
            known = ", ".join(sorted(self.parameters))
            raise SweepError(f"no parameter {', '.join(unknown)} to vary. Known: {known}.")
        if varied and any(isinstance(branch, Start) for branch in self.branches.values()):
            raise SweepError(
                "the assembly of a group of class III was followed with these sizes, and others "
                "may have another: sweep every value alone"
            )
        if varied and self.branches:
            raise SweepError(
                'parameters move the change points of keep = "continuous": sweep every value alone'
            )
        if varied and self.forces:
            raise SweepError(
                "parameters are varied for results of the motion only: ask for no forces, or sweep "
                "every value alone"
            )

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
            When the shapes do not go together.
        """
        angle = np.asarray(positions, dtype=self._runner.dtype)
        # Alone they are of one shape: there is nothing to be looked at.
        if not (self.varied or parameters) and angle.ndim == 1 and out is None and failed is None:
            found = self._runner.few(lambda: [angle, *self._loaded(angle)], len(angle))
            if found is not None:
                return found
        parameters = parameters or {}
        if set(parameters) != set(self.varied):
            raise SweepError(f"run() takes the parameters {', '.join(self.varied) or '(none)'}")
        extra = [np.asarray(parameters[name], dtype=self._runner.dtype) for name in self.varied]
        shape = self._shape(angle, extra, out, failed)
        if out is None:
            if self.varied and len(shape) == 1 and failed is None:
                found = self._runner.few(lambda: [angle, *extra], shape[0])
                if found is not None:
                    return found
            out = np.empty((len(self.rows), *shape), self._runner.dtype)
        self._runner.expect(math.prod(shape))
        if len(shape) == 2 and (self.branches or self.loads):  # known for one row of positions
            for i, here in enumerate(angle):
                columns = [here, *self._loaded(here)]
                self._runner.run(columns, out[:, i], None if failed is None else failed[i])
            return out
        self._runner.run([angle, *extra, *self._loaded(angle)], out, failed)
        return out

    def bind(
        self,
        positions: npt.ArrayLike,
        parameters: Mapping[str, npt.ArrayLike] | None = None,
        *,
        out: Array | None = None,
        failed: npt.NDArray[np.int16] | None = None,
    ) -> Callable[[], Array]:
        """Return a function that does `run` for these arrays: all is prepared and checked now.

        An array of float64 is read anew at every call, so that new positions and parameters are
        written into it. For few positions that are asked again and again: the tape is compiled if
        it can be.

        Returns
        -------
        callable
            Of nothing; it fills ``out`` (and ``failed``) and returns it, the same array every time.
        """
        angle = np.asarray(positions, dtype=self._runner.dtype)
        given = {k: np.asarray(v, dtype=self._runner.dtype) for k, v in (parameters or {}).items()}
        filled = self.run(angle, given, out=out, failed=failed)
        out = np.array(filled, order="C") if out is None else out
        self._runner.compile()
        if not self._runner.takes(out, failed) or (out.ndim == 3 and self.branches):
            return lambda: self._again(angle, given, out, failed)
        loaded = self._loaded(angle)
        columns = [angle, *(given[name] for name in self.varied), *loaded]
        call = self._runner.bound(columns, out, failed)
        if not loaded:

            def bound() -> Array:
                call()
                return out

            return bound

        def bound_loads() -> Array:
            for column, value in zip(loaded, self._loaded(angle), strict=True):
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

    def _loaded(self, positions: Array) -> list[Array]:
        """Return the columns that differ from position to position: cam, branches and loads."""
        motion = driven(self.problem.drive, positions) if self._followed else ()
        columns = [np.asarray(one) for one in motion]
        columns += [closing.branch(positions) for closing in self.branches.values()]
        if self.loads is not None:
            columns += self.loads.at(positions)
        return [column.astype(self._runner.dtype) for column in columns]

    def _shape(
        self, angle: Array, extra: list[Array], out: Array | None, failed: Array | None
    ) -> tuple[int, ...]:
        """Return the shape of the positions with their parameters, the buffers being of it."""
        try:
            shape = np.broadcast_shapes(angle.shape, *(value.shape for value in extra))
        except ValueError:
            told = ", ".join(f"{n} {v.shape}" for n, v in zip(self.varied, extra, strict=True))
            raise SweepError(
                f"positions of shape {angle.shape} do not go with parameters of shape {told}"
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
        """Return the results by the names of their rows."""
        found = self.run(positions, parameters)
        return {row.name: values for row, values in zip(self.rows, found, strict=True)}

    @property
    def guards(self) -> list[tuple[Name, PlanKind]]:
        """Step and plan of every margin that is watched, by the numbers of `reason`."""
        plans = self._draft.plans
        return [(step, plans.get(step, PlanKind.POSITION)) for step in self._runner.guards]

    def javascript(self) -> str:
        """Return the source of a function of JavaScript: of a position, branches and loads.

        It returns the results of one position in the order of the rows; see `Runner.javascript`.
        """
        return self._runner.javascript()

    def reason(self, guard: int) -> str:
        """Return the step behind a guard's number; empty for -1, which no guard has."""
        return "" if guard < 0 else str(self._runner.guards[guard])

    def explain(self, position: float, *, number: int | None = None) -> str:
        """Return why a position is impossible, in the words and numbers of the drawing.

        Parameters
        ----------
        number : int, optional
            Number of the position, from 0, for the message; without it, it is the only one.

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
        at = np.array([position], dtype=float)
        if not np.isfinite(position):
            return Failure(Cause.NO_NUMBER, Place.of(self.problem, at, 0))
        data: dict[str, Any] = {**self.constants, self.driver: at}
        if self._followed:
            data.update(zip(self._followed, driven(self.problem.drive, at), strict=True))
        data.update({name: closing.branch(at) for name, closing in self.branches.items()})
        if self.loads is not None:
            data.update(zip(self.loads.names, self.loads.at(at), strict=True))
        reading = Reading(evaluate(self.program, data, Float64()), 1)
        if failing(self.program, reading.trace, 1)[0] < 0:
            return None
        return explain(self._draft, self.program, reading, at)


def _made_again(
    problem: Problem,
    asked: Iterable[str] | None,
    varied: Sequence[str],
    dtype: npt.DTypeLike,
    forces: bool,
    drawn: Sequence[Name],
    native: bool | None,
) -> Sweep:
    return Sweep(
        problem, asked, varied=varied, dtype=dtype, forces=forces, drawn=drawn, native=native
    )


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
        When the variants are not built by the same steps, or a fixed point moves.
    """
    labels = None if asked is None else tuple(asked)
    each = [Sweep(problem, labels) for problem in problems]
    first = each[0]
    if any(sweep.forces for sweep in each):
        raise SweepError("variants are swept together without forces: sweep each alone")
    for other in each[1:]:
        if other.branches != first.branches:
            raise SweepError("the variants do not have the same change points: sweep each alone")
        if other.program != first.program:
            raise SweepError(
                f"{_named(other.problem)} is not built by the same steps as "
                f"{_named(first.problem)}: sweep it alone"
            )
    differing = {
        name
        for other in each[1:]
        for name, value in other.constants.items()
        if value != first.constants[name]
    }
    moved = sorted(name for name in differing if name not in first.parameters)
    if moved:
        raise SweepError(f"the variants differ in the places of {', '.join(moved)}: sweep each")
    varied = sorted(differing)
    values = {name: np.array([[s.parameters[name]] for s in each]) for name in varied}
    whole = Sweep(first.problem, labels, varied=varied)
    angle = np.asarray(positions, dtype=float)
    if not varied:
        one = whole.run(angle)
        return whole.rows, np.repeat(one[:, np.newaxis], len(each), axis=1)
    return whole.rows, whole.run(angle, values)


def _named(problem: Problem) -> str:
    return problem.name + (f" ({problem.variant})" if problem.variant else "")


def _motion(results: Quantities) -> list[Quantity]:
    """Return the results that loads may depend on: places, velocities, rotations."""
    kinds = (QuantityKind.PLACE, QuantityKind.VELOCITY, QuantityKind.OMEGA)
    return [result for result in results.all if result.kind in kinds]
