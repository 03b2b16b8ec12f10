"""Problem files of a command: reading them, acting on them, and reporting failures."""

from __future__ import annotations

import contextlib
import functools
import gc
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias, TypeVar, cast

import click
from msgspec import Struct

from planmethod.commands.output import is_terminal
from planmethod.errors import AssemblyError, ExitCode, PlanMethodError, ProblemError
from planmethod.languages import current_language, translate
from planmethod.options import UsageError

if TYPE_CHECKING:
    from planmethod.commands.processes import Outcome
    from planmethod.construct.drafting import Profile
    from planmethod.kind import ProblemKind
    from planmethod.options import Positions
    from planmethod.problem.model import Problem
    from planmethod.problem.records import KindProblem
    from planmethod.solved.machine.flywheel import Flywheel
    from planmethod.solved.solution import Solution

F = TypeVar("F", bound=Callable[..., Any])
T = TypeVar("T")


class LoadedProblem(Struct, frozen=True):
    """A problem that was read: its file, its kind (None for a linkage), what was read."""

    path: Path
    kind: ProblemKind[Any] | None
    problem: KindProblem

    @property
    def linkage(self) -> Problem:
        """The problem of a linkage."""
        return cast("Problem", self.problem)


_PLACES = " The places exist there: --ask positions."

AT_ONCE = 256
"""Problems that are acted on at once, where they can be."""

AT_ONCE_DRAWN = 16
"""The same where each is acted on alone: sheets of them are a few seconds of work."""

MANY = 6
"""Number of problems from which a command shows its progress."""


def fail(error: PlanMethodError, names: Sequence[str] = ()) -> None:
    """Print an error, with the name of its problem: see `named`."""
    click.echo(translate("Error: {}", named(str(error), names)), err=True)


def named(message: str, names: Sequence[str]) -> str:
    """Return a message with the first of some names of its problem before it, if it has none."""
    whole = (rf"(?<![\w-]){re.escape(name)}(?![\w-])" for name in names)
    if not names or any(re.search(name, message) for name in whole):
        return message
    return f"{names[0]}: {message}"


def names_of(path: Path, name: str, variant: str | None) -> Sequence[str]:
    """Return the names of a problem in messages; a variant's name differs from its file's."""
    return (str(path), name) if variant is None else (f"{name}-{variant}",)


@contextmanager
def of_file(path: Path, name: str) -> Iterator[None]:
    """Name the file in errors that are found late, as in all other faults."""
    try:
        yield
    except ProblemError as error:
        if error.source != name:
            raise
        raise type(error)(str(path), error.faults) from error
    except PlanMethodError as error:
        text = str(error)
        if text.startswith(f"{name}: "):
            error.args = (f"{path}{text.removeprefix(name)}",)
        raise


def guarded(command: F) -> F:
    """Turn the package's errors into a message and an exit code."""

    @functools.wraps(command)
    def wrapper(*args: Any, **kwargs: Any) -> Any:
        try:
            return command(*args, **kwargs)
        except PlanMethodError as error:
            fail(error)
            sys.exit(error.exit_code)

    return wrapper  # type: ignore[return-value]


def load(
    path: Path, variant: str | None, all_variants: bool, *, drawn: bool = True
) -> list[Problem]:
    """Read a problem file: one problem, or one for each variant, with its project's decisions.

    Sheet 1 is laid out to decide the scales; without ``drawn`` only the positions are decided.
    """
    found = []
    for problem in _read(path, variant, all_variants):
        if problem.project is not None:
            from planmethod.project.settle import in_positions, with_decisions

            with of_file(path, problem.name):
                problem = with_decisions(problem) if drawn else in_positions(problem)
        found.append(problem)
    if found and found[0].project is None:  # an author of [project] knows its use
        warn_of_unused_tables(found[0])
    return found


def load_unchanged(path: Path, variant: str | None) -> Problem:
    """Read a problem file unchanged."""
    (problem,) = _read(path, variant, all_variants=False)
    return problem


def _read(path: Path, variant: str | None, all_variants: bool) -> Iterator[Problem]:
    from planmethod.kinds import load_each
    from planmethod.problem.plausibility import unlikely

    with of_file(path, path.stem):
        for problem in load_each(path, variants_of(path, variant, all_variants)):
            for phrase in unlikely(problem):
                warn(problem, phrase)
            if problem.cycle is not None and problem.cycle.working is not None:
                _warn_of_working_stroke(problem)
            yield problem


def _warn_of_working_stroke(problem: Problem) -> None:
    """Warn of a working stroke on which the loads do not do their work."""
    from planmethod.note.document import plain_text
    from planmethod.solved.solution import Solution
    from planmethod.solved.turn.cycle import crank_cycle_of

    with contextlib.suppress(PlanMethodError):  # reported where the positions are solved
        turn = crank_cycle_of(Solution(problem))
        loads, strokes = turn.contradicting, turn.strokes
        if loads is not None and strokes is not None and problem.cycle is not None:
            text = translate(
                '[cycle] working = "{}" makes the stroke of {:.2f}° the working one, and the work '
                "of {} is done on the other one, of {:.2f}°. Mend one of them.",
                getattr(problem.cycle.working, "value", ""),
                strokes.working_deg,
                plain_text(loads.partition(" ")[2]),
                strokes.idle_deg,
            )
            warn(problem, text)


def warn_of_unused_tables(problem: Problem) -> None:
    """Warn of tables of other kinds of problem in a linkage's file, which are not used."""
    for table in problem.tables:
        if table == "point":
            warn(problem, "[point] is left out; give it a file of its own.")
        elif {"gears": problem.drive.gear_drive, "cam": problem.drive.cam_drive}.get(table) is None:
            warn(problem, translate("[{}] is left out; planmethod project draws it.", table))


def _load_other(
    kind: ProblemKind[Any], path: Path, variant: str | None, all_variants: bool
) -> list[KindProblem]:
    """Read problems of another kind likewise."""
    return [kind.load(path, name) for name in variants_of(path, variant, all_variants)]


def variants_of(path: Path, variant: str | None, all_variants: bool) -> Sequence[str | None]:
    """Return the variants that are meant; None for the main part."""
    from planmethod.problem import variant_names

    if all_variants and variant is not None:
        raise UsageError("give --variant or --all-variants, not both")
    return (variant_names(path) or (None,)) if all_variants else (variant,)


def for_each_problem(
    paths: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    act: Callable[[LoadedProblem], T],
    *,
    kinds: bool = True,
    jobs: int = 1,
    on_result: Callable[[T], object] | None = None,
    act_on_many: Callable[[Sequence[LoadedProblem]], dict[int, T]] | None = None,
    drawn: bool = True,
) -> ExitCode:
    """Act on every problem; a faulty one is reported and the others go on.

    Parameters
    ----------
    act : callable
        Acts on one problem. Where there are jobs it is pickled: a function of a module, its
        arguments in `functools.partial`.
    kinds : bool
        Whether problems of other kinds are accepted, too; else they are faulty.
    jobs : int
        Number of processes; their output is printed here, in order, so that the outcome is the
        same.
    on_result : callable, optional
        Receives the result of every problem, in order.
    act_on_many : callable, optional
        Batch worker: acts on several problems at once and returns ``{index: result}``.
        The others are acted on one by one.
    drawn : bool
        Whether the scales of a project are needed, which take a second to decide.

    Returns
    -------
    ExitCode
        Of the first error.
    """

    def make_steps(items: list[LoadedProblem]) -> Iterator[Callable[[], T | None]]:
        # Problems of the same name write the same files: the last one wins, as in one process.
        if jobs == 1 or len({basename(one.problem) for one in items}) < max(2, len(items)):
            if len(items) > AT_ONCE:
                gc.freeze()  # problems live to the end: do not scan them
            for start in range(0, len(items), AT_ONCE):
                block = items[start : start + AT_ONCE]
                with gc_paused():  # results of a block live to its end
                    found = act_on_many(block) if act_on_many is not None and len(block) > 1 else {}
                for k, one in enumerate(block):
                    yield partial(found.pop, k) if k in found else partial(act, one)
                if len(items) > AT_ONCE:
                    gc.collect()  # solutions have cycles: a block of them is 100 MB
        else:
            yield from _in_chunks(act, act_on_many, items, jobs)

    return run_steps(
        paths, variant, all_variants, make_steps, kinds=kinds, on_result=on_result, drawn=drawn
    )


def of_linkages(
    items: Sequence[LoadedProblem], build: Callable[[list[Problem]], Mapping[int, T]]
) -> dict[int, T]:
    """Return the results of the linkages among problems, made together, by index."""
    linkages = [k for k, one in enumerate(items) if one.kind is None]
    if not linkages:
        return {}
    return {linkages[k]: one for k, one in build([items[k].linkage for k in linkages]).items()}


@contextmanager
def gc_paused() -> Iterator[None]:
    """Pause the garbage collector."""
    was = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was:
            gc.enable()


def run_steps(
    paths: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    make_steps: Callable[[list[LoadedProblem]], Iterator[Callable[[], T | None]]],
    *,
    kinds: bool,
    on_result: Callable[[T], object] | None = None,
    drawn: bool = True,
) -> ExitCode:
    """Read all problems and run the steps, one for each problem; failures are reported.

    Parameters
    ----------
    make_steps : callable
        Returns the callables to run in turn for the problems.
    kinds : bool
        Whether problems of other kinds are accepted, too.
    """
    from planmethod.kinds import kind_of

    codes: list[ExitCode] = []
    items: list[LoadedProblem] = []
    for path in paths:
        try:
            kind = kind_of(path) if kinds else None
            if kind is None:
                found = load(path, variant, all_variants, drawn=drawn)
                items += [LoadedProblem(path, None, problem) for problem in found]
            else:
                others = _load_other(kind, path, variant, all_variants)
                items += [LoadedProblem(path, kind, one) for one in others]
        except PlanMethodError as error:
            codes.append(error.exit_code)
            fail(error)
    done = 0
    try:
        for one, step in zip(items, with_progress(make_steps(items), len(items)), strict=True):
            problem, is_one = one.problem, len(paths) + len(items) == 2
            names = () if is_one else names_of(one.path, problem.name, problem.variant)
            try:
                with of_file(one.path, problem.name):
                    value = step()
                if on_result is not None and value is not None:
                    on_result(value)
            except PlanMethodError as error:
                codes.append(error.exit_code)
                fail(error, names)
            except click.UsageError as error:
                raise click.UsageError(named(error.message, names), error.ctx) from error
            done += 1
    except KeyboardInterrupt:
        if len(items) > 1:
            text = translate(
                "Stopped: {} of {} problems are done; every file is whole.", done, len(items)
            )
            click.echo(f"\n{text}", err=True)
            sys.exit(130)
        raise
    return codes[0] if codes else ExitCode.DONE


# Processes ---------------------------------------------------------------------------------------


BatchAction: TypeAlias = Callable[[Sequence[LoadedProblem]], dict[int, Any]]
"""Batch worker: acts on several problems at once; see `for_each_problem`."""


def _in_chunks(
    act: Callable[[LoadedProblem], T],
    act_on_many: BatchAction | None,
    items: list[LoadedProblem],
    jobs: int,
) -> Iterator[Callable[[], T | None]]:
    """Yield a callable for the result of every problem; chunks of them go to several processes.

    The problems of a chunk whose process was killed are retried one by one.
    """
    from planmethod.commands.processes import in_processes, split_into_chunks

    parts = split_into_chunks(items, jobs, AT_ONCE if act_on_many is not None else AT_ONCE_DRAWN)
    act_on = partial(_act_on_chunk, act=act, act_on_many=act_on_many)
    for part, outcome in zip(parts, in_processes(act_on, parts, jobs), strict=True):
        if outcome is not None:
            yield from (own.result for own in outcome.result() or ())
        elif len(part) == 1:
            yield partial(raise_killed, part[0])
        else:
            for one, own in zip(part, in_processes(act, part, jobs), strict=True):
                yield partial(raise_killed, one) if own is None else own.result


def _act_on_chunk(
    part: Sequence[LoadedProblem],
    act: Callable[[LoadedProblem], T],
    act_on_many: BatchAction | None,
) -> list[Outcome[T]]:
    """Act on a chunk of problems, together where possible."""
    from planmethod.commands.processes import Outcome, captured

    with gc_paused():
        found = act_on_many(part) if act_on_many is not None and len(part) > 1 else {}
    return [
        Outcome(value=found[k]) if k in found else captured(partial(act, one))
        for k, one in enumerate(part)
    ]


def raise_killed(one: LoadedProblem) -> NoReturn:
    """Raise the error that every process of a problem was killed.

    Raises
    ------
    PlanMethodError
    """
    raise PlanMethodError(
        "{}: its process was killed twice; perhaps it needs more memory than is available. "
        "Request fewer positions at once.",
        message_name(one.problem),
    )


def finish(code: ExitCode) -> None:
    """End the command here if something failed."""
    if code is not ExitCode.DONE:
        sys.exit(code)


def reject_plan_options(kind: ProblemKind[Any], **options: object) -> None:
    """Reject options that only the plans of linkages have.

    Raises
    ------
    click.UsageError
        Naming the options that were given.
    """
    given = [f"--{name.replace('_', '-')}" for name, value in options.items() if value]
    if given:
        text = ", ".join(given)
        raise UsageError(
            "{}: only plans of linkages have such options; leave them out for [{}]",
            text,
            kind.table,
        )


def no_position(number: int, problem: KindProblem, count: int) -> UsageError:
    """Return the error of a position that a problem does not have."""
    return UsageError(
        "--position {}: the last of {} is {}", number, message_name(problem), count - 1
    )


def with_progress(steps: Iterable[T], length: int) -> Iterator[T]:
    """Yield the steps, with a progress bar on a terminal if they take about a second."""
    if length < MANY or not is_terminal(sys.stderr):
        yield from steps
        return
    with click.progressbar(steps, length, label="planmethod", file=sys.stderr) as bar:
        yield from bar


def basename(problem: KindProblem) -> str:
    """Return the base name of the files of a problem."""
    return problem.name if problem.variant is None else f"{problem.name}-{problem.variant}"


def message_name(problem: KindProblem) -> str:
    """Return the name of a problem in messages: its file, or the file's name with the variant."""
    return problem.source_file if problem.variant is None else basename(problem)


def language_of(problem: KindProblem, named: str | None) -> str:
    """Return the output language of a problem.

    The user's choice, else that of ``[sheet]``, else that of messages.
    """
    return named or problem.sheet.lang or current_language()


def language_of_file(path: Path, named: str | None) -> str:
    """Return the output language of a problem file that may have faults."""
    from planmethod.languages import known_language
    from planmethod.problem.source import parse, read_source

    if named is not None:
        return named
    with contextlib.suppress(PlanMethodError):  # reported where the file is read as a problem
        sheet = parse(read_source(path), name=str(path)).get("sheet")
        if isinstance(sheet, dict):
            return known_language(str(sheet.get("lang", ""))) or current_language()
    return current_language()


def warn(problem: Problem, message: object) -> None:
    """Print a warning about a problem's results: a sentence, or a record of one."""
    click.echo(translate("Warning: {}: {}", message_name(problem), message), err=True)


def warn_of_wide_flywheel(wheel: Flywheel) -> None:
    """Warn of a flywheel that is wide for its diameter."""
    from planmethod.solved.machine.sizes import too_wide

    said = too_wide(wheel.machine.wheel, wheel.exact.inertia, wheel.middle_speed)
    if said is not None:
        warn(wheel.problem, said)


def warn_of_change_points(problem: Problem, phi: Positions | None) -> None:
    """Warn of change points between the positions of a problem that is solved elsewhere."""
    from planmethod.solved.selfcheck import changed_branches
    from planmethod.solved.solution import Solution

    way = None if phi is None else [float(phi.min()), float(phi.max())]
    for said in changed_branches(Solution(problem, positions=way)):
        warn(problem, said)


def warn_of_accuracy(
    problem: Problem, positions: Sequence[float] | None = None, *, forces: bool = True
) -> None:
    """Warn of positions with few digits, for a problem that is solved elsewhere.

    Impossible or rejected positions are reported where it is solved.
    """
    from planmethod.solved.selfcheck import warnings
    from planmethod.solved.solution import Solution

    with contextlib.suppress(PlanMethodError):
        for doubt in warnings(Solution(problem, positions=positions), forces=forces):
            warn(problem, doubt)


def solution_of(
    problem: Problem,
    phi: Positions | None,
    profile: Profile,
    *,
    hint: str = "",
    forces: bool = False,
    machine: bool = False,
) -> Solution:
    """Solve a problem, check the solution, and print its warnings.

    Parameters
    ----------
    profile : Profile
        Accuracy of drawing the plans.
    hint : str
        Alternative to suggest where one of several positions is rejected.
    forces : bool
        The forces must exist, too, where there are loads.
    machine : bool
        The flywheel is checked as well.
    """
    from planmethod.solved.failures import Cause, PositionError
    from planmethod.solved.selfcheck import changed_branches, verify, warnings
    from planmethod.solved.solution import Solution

    solution = Solution(problem, positions=None if phi is None else phi.tolist(), profile=profile)
    for said in changed_branches(solution):
        warn(problem, said)
    try:
        verify(solution, forces=forces)
    except AssemblyError as error:
        if hint and isinstance(error, PositionError) and error.failure.cause is Cause.RAYS:
            hint = f"{translate(_PLACES)}{translate(hint) if len(solution.positions) > 1 else ''}"
        elif len(solution.positions) < 2:
            raise
        else:
            hint = translate(hint)
        raise AssemblyError(f"{error}{hint}") from error
    for doubt in warnings(solution, forces=forces):
        warn(problem, doubt)
    if machine and problem.machine is not None:
        from planmethod.solved.machine.flywheel import flywheel_of

        warn_of_wide_flywheel(flywheel_of(solution))
    return solution
