"""A group of submissions checked against the variants of one problem (проверка группы)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, cast

from msgspec import Struct
from msgspec.structs import replace

from planmethod.arguments import of_type
from planmethod.check.batch import batch_tasks
from planmethod.check.calculation import Calculation
from planmethod.check.checking import check, failure_of, unknown_variant, unmarked
from planmethod.check.key import Key, key_of_task
from planmethod.check.letters import normalize
from planmethod.check.marks import DEFAULT, Settings
from planmethod.check.model import CheckFailure, GradedSubmission, Submission
from planmethod.check.task import Task
from planmethod.construct.drafting import PROFILES
from planmethod.errors import PlanMethodError
from planmethod.kind import ProblemKind
from planmethod.kinds import kind_of, load
from planmethod.problem import Problem, variant_names
from planmethod.problem.common import KindProblem
from planmethod.project.settle import with_decisions
from planmethod.solved.many.variants import in_batches
from planmethod.solved.selfcheck import verify
from planmethod.solved.solution import Solution

FEW = 2
"""Number of variants up to which each is solved with its first submission."""

_UNKNOWN = "\n"
"""Stands for a variant that the file has not: no name has it."""


def key_of_problem(kind: ProblemKind[Any] | None, problem: KindProblem, settings: Settings) -> Key:
    """Return the key of a problem; its kind is None for a linkage."""
    return key_of_task(task_of_problem(kind, problem, settings))


def task_of_problem(
    kind: ProblemKind[Any] | None, problem: KindProblem, settings: Settings
) -> Task:
    """Return a problem with its requested items; its kind is None for a linkage."""
    if kind is None:
        return Task(_verified(Solution(cast("Problem", problem))), settings)
    return Calculation(kind, problem, settings)


def _verified(solution: Solution) -> Solution:
    """Return a solution after verifying its motion: a key is made from it."""
    verify(solution)
    return solution


class Variants:
    """Variants of a problem file, each solved when it is first needed.

    Parameters
    ----------
    path : Path
    settings : Settings
    default : str, optional
        Variant of the submissions that name none.
    """

    def __init__(
        self, path: Path, settings: Settings = DEFAULT, default: str | None = None
    ) -> None:
        path = Path(of_type("path", path, str | Path))
        self.path, self.settings, self.default = path, settings, default
        self.names: tuple[str, ...] = tuple(variant_names(path))
        self._tasks: dict[str | None, Task] = {}
        self._forms = {normalize(name): name for name in self.names}

    def task(self, name: str | None) -> Task:
        """Return the task of a variant, or of the file itself.

        Raises
        ------
        PlanMethodError
            When the problem cannot be solved.
        """
        if name not in self._tasks:
            kind = kind_of(self.path)
            if kind is not None:
                problem = kind.load(self.path, name)
                self._tasks[name] = Calculation(kind, problem, self.settings, self._all)
            else:
                solution = _verified(Solution(with_decisions(load(self.path, variant=name))))
                self._tasks[name] = Task(solution, self.settings, self._all)
        return self._tasks[name]

    def solve_in_batch(self, names: Iterable[str | None]) -> None:
        """Solve several variants in one batch, if their plans and requested items are the same."""
        if kind_of(self.path) is not None:
            return
        problems = []
        for name in dict.fromkeys(names):
            if name not in self._tasks:
                with suppress(PlanMethodError):  # it says why when it is needed
                    problems.append(load(self.path, variant=name))
        with suppress(Exception):  # then each is solved alone; faults go to its submissions
            for batch, _ in in_batches(problems, PROFILES["board"]):
                for task in batch_tasks(batch, self.settings, self._all):
                    self._tasks[task.variant] = task

    def _all(self) -> Iterator[Task]:
        for name in self.names or (None,):
            yield self.task(name)

    def name_of(self, submission: Submission) -> str | None:
        """Return the variant of a submission; None for the file itself.

        Raises
        ------
        KeyError
            When the file has no such variant.
        """
        if not submission.variant:
            return self.default
        if submission.variant in self.names:
            return submission.variant
        if not self.names:
            return None
        return self._forms[normalize(submission.variant)]


class CheckedGroup(Struct, frozen=True):
    """Graded submissions with the keys used for them."""

    checked: tuple[GradedSubmission, ...]
    keys: dict[str | None, Key]


def check_works(variants: Variants, works: Sequence[Submission]) -> Iterator[GradedSubmission]:
    """Yield the submissions, each checked by its own variant, independently of the others.

    One that fails, or whose variant cannot be solved, is not marked; `failure` gives the reason.

    Examples
    --------
    >>> from pathlib import Path
    >>> from planmethod.check.submissions import read_works
    >>> variants = Variants(Path("problems/linkages/ex3-variants.toml"))
    >>> works = read_works(Path("problems/groups/ex3.csv"))
    >>> for one in check_works(variants, works[:3]):
    ...     print(f"{one.work.student}: {one.points:g} of {one.of:g}")
    Абрамова Дарья: 19 of 19
    Белов Никита: 17.7 of 19
    Васильев Олег: 19 of 19
    """
    of_type("variants", variants, Variants)
    for work in of_type("works", works, Sequence, "read_works()"):
        of_type("works", work, Submission, "read_works()")
    named = [_named(variants, work) for work in works]
    if len(set(named)) > FEW:
        variants.solve_in_batch(name for name in named if name is not _UNKNOWN)
    for work, name in zip(works, named, strict=True):
        yield unknown_variant(work) if name is _UNKNOWN else _grade(variants, work, name)


def _grade(variants: Variants, submission: Submission, name: str | None) -> GradedSubmission:
    """Check a submission; a fault in it, or in its variant, does not affect others."""
    if submission.failure:
        return unmarked(submission, name, CheckFailure(submission.failure.rstrip(".")))
    try:
        return check(variants.task(name), submission)
    except PlanMethodError as error:
        return unmarked(submission, name, CheckFailure(str(error).rstrip(".")))
    except MemoryError:
        raise
    except Exception as error:  # an internal error: the others are still graded
        return unmarked(submission, name, failure_of(error))


def _named(variants: Variants, submission: Submission) -> str | None:
    try:
        return variants.name_of(submission)
    except KeyError:
        return _UNKNOWN


def keys_of(variants: Variants, checked: Sequence[GradedSubmission]) -> dict[str | None, Key]:
    """Return the keys of the submissions' variants, for all quantities that they answer."""
    found: dict[str | None, Key] = {}
    names = dict.fromkeys(work.variant for work in checked)
    for name in (name for name in names if name is None or name in variants.names):
        try:
            task = variants.task(name).copy_for_submission()
        except PlanMethodError:
            continue  # said of its works
        items = {(item.id, item.position): item for item in task.usual()}
        for one in checked:
            if one.variant != name:
                continue
            for judged in one.answers:
                if judged.key is not None and judged.written is not None:
                    item = task.find(judged.written)
                    items.setdefault(
                        (item.name, item.position), replace(item, id=item.name, points=0.0)
                    )
        for asked in (tuple(items.values()), task.usual()):
            with suppress(Exception):  # extra answers must not block any page
                found[name] = key_of_task(task, asked)
                break
    return found
