"""Problem files that a command is given: read, acted on, and what is said when one fails."""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from planmethod.commands.output import is_terminal
from planmethod.errors import AssemblyError, ExitCode, PlanMethodError
from planmethod.kinds import Kind, KindProblem, kind_of
from planmethod.kinds import load as load_linkage
from planmethod.languages import say

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.options import Positions
    from planmethod.problem.model import Problem
    from planmethod.solved.solution import Solution

F = TypeVar("F", bound=Callable[..., Any])
T = TypeVar("T")

MANY = 6
"""Number of problems from which a command shows its progress."""


def fail(error: PlanMethodError) -> None:
    """Say what went wrong."""
    click.echo(say("Error: {}", error), err=True)


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


def load(path: Path, variant: str | None, all_variants: bool) -> list[Problem]:
    """Read a problem file: one problem, or one for each variant."""
    from planmethod.problem.unlikely import unlikely

    found = []
    for name in variants_of(path, variant, all_variants):
        found.append(load_linkage(path, variant=name))
        for said in unlikely(found[-1]):
            warn(found[-1], said)
    return found


def _load_other(
    kind: Kind, path: Path, variant: str | None, all_variants: bool
) -> list[KindProblem]:
    """Read the same of a problem that is no linkage."""
    return [kind.load(path, name) for name in variants_of(path, variant, all_variants)]


def variants_of(path: Path, variant: str | None, all_variants: bool) -> Sequence[str | None]:
    """Return the variants that are meant; None for the main part."""
    from planmethod.problem import variant_names

    if all_variants and variant is not None:
        raise click.UsageError(say("give --variant or --all-variants, not both"))
    return (variant_names(path) or (None,)) if all_variants else (variant,)


def each(
    paths: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    act: Callable[[Problem], None],
    other: Callable[[Kind, KindProblem], None] | None = None,
) -> ExitCode:
    """Act on every problem; a faulty one is reported and the others go on.

    Parameters
    ----------
    other : callable, optional
        Acts on problems that are no linkages (`planmethod.kinds`); without it they are faulty.

    Returns
    -------
    ExitCode
        Of the first error.
    """
    codes: list[ExitCode] = []

    def problems() -> Iterator[Callable[[], None]]:
        for path in paths:
            try:
                kind = None if other is None else kind_of(path)
                if kind is None or other is None:
                    for problem in load(path, variant, all_variants):
                        yield partial(act, problem)
                else:
                    for one in _load_other(kind, path, variant, all_variants):
                        yield partial(other, kind, one)
            except PlanMethodError as error:
                codes.append(error.exit_code)
                fail(error)

    found = list(problems())
    for step in watched(found):
        try:
            step()
        except PlanMethodError as error:
            codes.append(error.exit_code)
            fail(error)
    return codes[0] if codes else ExitCode.DONE


def finish(code: ExitCode) -> None:
    """End the command here if something failed."""
    if code is not ExitCode.DONE:
        sys.exit(code)


def refuse_plans(kind: Kind, **options: object) -> None:
    """Refuse options that only the plans of linkages have.

    Raises
    ------
    click.UsageError
        Naming the options that were given.
    """
    given = [f"--{name.replace('_', '-')}" for name, value in options.items() if value]
    if given:
        told = ", ".join(given)
        raise click.UsageError(
            say(
                "{}: only plans of linkages have such options; leave them out for [{}]",
                told,
                kind.table,
            )
        )


def watched(found: list[T]) -> Iterator[T]:
    """Yield what is to do, on a terminal with a bar when they are many (about a second of work)."""
    if len(found) < MANY or not is_terminal(sys.stderr):
        yield from found
        return
    with click.progressbar(found, label="planmethod", file=sys.stderr) as bar:
        yield from bar


def stem(problem: Problem | KindProblem) -> str:
    """Return what the files of a problem are called."""
    return problem.name if problem.variant is None else f"{problem.name}-{problem.variant}"


def warn(problem: Problem, said: object) -> None:
    """Say what a user should know of a problem's results: a sentence, or a record of one."""
    click.echo(say("Warning: {}: {}", problem.name, said), err=True)


def tell_changes(problem: Problem, phi: Positions | None) -> None:
    """Tell of change points between the positions of a problem that is solved elsewhere."""
    from planmethod.solved.selfcheck import changed_branches
    from planmethod.solved.solution import Solution

    way = None if phi is None else [float(phi.min()), float(phi.max())]
    for said in changed_branches(Solution(problem, positions=way)):
        warn(problem, said)


def solution_of(
    problem: Problem,
    phi: Positions | None,
    hand: Profile,
    *,
    hint: str = "",
    forces: bool = False,
) -> Solution:
    """Solve a problem, check the solution, and report the doubts about it.

    Parameters
    ----------
    hand : Profile
        Who draws the plans.
    hint : str
        What else can be asked where one of several positions is refused.
    forces : bool
        The forces must exist, too, where there are loads.
    """
    from planmethod.solved.selfcheck import changed_branches, verify, warnings
    from planmethod.solved.solution import Solution

    solution = Solution(problem, positions=None if phi is None else phi.tolist(), profile=hand)
    for said in changed_branches(solution):
        warn(problem, said)
    try:
        verify(solution)
        if forces and problem.dynamics is not None:
            from planmethod.solved.forces.statics import statics_of

            _ = statics_of(solution).si
    except AssemblyError as error:
        if len(solution.positions) < 2:
            raise
        raise AssemblyError(f"{error}{say(hint)}") from error
    for doubt in warnings(solution):
        warn(problem, doubt)
    return solution
