"""Problem files of a command: reading them, acting on them, and reporting failures."""

from __future__ import annotations

import contextlib
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
from planmethod.errors import ExitCode, PlanMethodError, ProblemError
from planmethod.languages import current_language, known_language, translate
from planmethod.options import ProblemChoice, UsageError, basename, message_name, warn_each

if TYPE_CHECKING:
    from planmethod.commands.processes import Outcome
    from planmethod.kind import ProblemKind
    from planmethod.problem.model import Problem
    from planmethod.problem.records import KindProblem

T = TypeVar("T")
P = TypeVar("P", bound="KindProblem")


class LoadedProblem(Struct, frozen=True):
    """A problem that was read: its file, its kind, what was read."""

    path: Path
    kind: ProblemKind[Any]
    problem: KindProblem

    @property
    def linkage(self) -> Problem:
        """The problem of a linkage."""
        return cast("Problem", self.problem)


class Loading(Struct, frozen=True):
    """How problem files are read.

    Attributes
    ----------
    kinds : bool
        Whether all kinds of problem are accepted; else every file is read as a linkage.
    drawn : bool
        Whether the scales of a project are needed, which take a second to decide.
    """

    kinds: bool = True
    drawn: bool = True


USUAL = Loading()
"""Of the commands that draw."""

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


def read_each(
    kind: ProblemKind[P], path: Path, variants: Callable[[], Iterable[str | None]]
) -> Iterator[P]:
    """Yield variants of a problem file unchanged; warnings about them are printed."""
    with of_file(path, path.stem):
        for problem in kind.load_each(path, variants()):
            warn_each(problem, kind.reading_warnings(problem))
            yield problem


def load(
    kind: ProblemKind[P],
    path: Path,
    variants: Callable[[], Iterable[str | None]],
    *,
    drawn: bool,
    round_to: str | None = None,
) -> list[P]:
    """Read variants of a problem file, with the decisions of its project.

    Sheet 1 is laid out to decide the scales; without ``drawn`` only the positions are decided.
    ``round_to`` is the step to which sizes by the coordinates of a figure are rounded.
    """
    found = []
    for problem in read_each(kind, path, variants):
        with of_file(path, problem.name):
            if round_to is not None:
                problem, changes = kind.rounded(problem, round_to)
                click.echo(translate("Note: {}: {}", message_name(problem), changes), err=True)
            found.append(kind.decided(problem, drawn=drawn))
    if found:
        warn_each(found[0], kind.unused_table_warnings(found[0]))
    return found


def variants_of(path: Path, choice: ProblemChoice) -> Sequence[str | None]:
    """Return the variants that are meant; None for the main part."""
    from planmethod.problem import variant_names

    if not choice.all_variants:
        return (choice.variant,)
    if choice.variant is not None:
        raise UsageError("give --variant or --all-variants, not both")
    return variant_names(path) or (None,)


def for_each_problem(
    choice: ProblemChoice,
    act: Callable[[LoadedProblem], T],
    *,
    jobs: int = 1,
    on_result: Callable[[T], object] | None = None,
    act_on_many: Callable[[Sequence[LoadedProblem]], dict[int, T]] | None = None,
    loading: Loading = USUAL,
) -> ExitCode:
    """Act on every problem; a faulty one is reported and the others go on.

    Parameters
    ----------
    act : callable
        Acts on one problem. Where there are jobs it is pickled: a function of a module, its
        arguments in `functools.partial`.
    jobs : int
        Number of processes; their output is printed here, in order, so that the outcome is the
        same.
    on_result : callable, optional
        Receives the result of every problem, in order.
    act_on_many : callable, optional
        Batch worker: acts on several problems at once and returns ``{index: result}``.
        The others are acted on one by one.

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

    return run_steps(choice, make_steps, on_result=on_result, loading=loading)


def act_by_kind(
    items: Sequence[LoadedProblem],
    act: Callable[[ProblemKind[Any], list[Any]], Mapping[int, T]],
) -> dict[int, T]:
    """Return the results of problems that are acted on together, those of each kind, by index."""
    found: dict[int, T] = {}
    for kind in dict.fromkeys(one.kind for one in items):
        own = [k for k, one in enumerate(items) if one.kind is kind]
        results = act(kind, [items[k].problem for k in own])
        found.update((own[k], result) for k, result in results.items())
    return found


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
    choice: ProblemChoice,
    make_steps: Callable[[list[LoadedProblem]], Iterator[Callable[[], T | None]]],
    *,
    on_result: Callable[[T], object] | None = None,
    loading: Loading = USUAL,
) -> ExitCode:
    """Read all problems and run the steps, one for each problem; failures are reported.

    Parameters
    ----------
    make_steps : callable
        Returns the callables to run in turn for the problems.
    """
    from planmethod.kinds import LINKAGES, kind_of

    codes: list[ExitCode] = []
    items: list[LoadedProblem] = []
    for path in choice.problems:
        try:
            kind = kind_of(path) if loading.kinds else LINKAGES
            variants = partial(variants_of, path, choice)
            found = load(kind, path, variants, drawn=loading.drawn, round_to=choice.round_to)
            items += [LoadedProblem(path, kind, problem) for problem in found]
        except PlanMethodError as error:
            codes.append(error.exit_code)
            fail(error)
    done = 0
    try:
        for one, step in zip(items, with_progress(make_steps(items), len(items)), strict=True):
            problem, is_one = one.problem, len(choice.problems) + len(items) == 2
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
                "Stopped: {} of {} problems are done; every file is complete.", done, len(items)
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


def with_progress(steps: Iterable[T], length: int) -> Iterator[T]:
    """Yield the steps, with a progress bar on a terminal if they take about a second."""
    if length < MANY or not is_terminal(sys.stderr):
        yield from steps
        return
    with click.progressbar(steps, length, label="planmethod", file=sys.stderr) as bar:
        yield from bar


def language_of(problem: KindProblem, named: str | None) -> str:
    """Return the output language of a problem.

    The user's choice, else that of ``[sheet]``, else that of messages.
    """
    return named or problem.sheet.lang or current_language()


def language_of_file(path: Path, named: str | None) -> str:
    """Return the output language of a problem file that may have faults."""
    from planmethod.problem.source import parse, read_source

    if named is not None:
        return named
    with contextlib.suppress(PlanMethodError):  # reported where the file is read as a problem
        sheet = parse(read_source(path), name=str(path)).get("sheet")
        if isinstance(sheet, dict):
            return known_language(str(sheet.get("lang", ""))) or current_language()
    return current_language()
